"""The parts of a run on an executor."""

from __future__ import annotations

import time
from collections.abc import Sequence
from concurrent.futures import Executor
from typing import Any

from .. import _core
from .._core import Ensemble
from ..runs import parts
from .checkpoint import Checkpoint
from .sources import AnyMotions, AnySliders


def _run_part(
    sliders: AnySliders,
    motions: AnyMotions,
    options: dict[str, Any],
    first: int,
    members: int,
) -> tuple[Ensemble, float]:
    """Run a part; return it and the time it took [s]. A module function, so that it pickles."""
    began = time.perf_counter()
    part = _core.run_ensemble(
        sliders,
        motions,
        members=members,
        first_member=first,
        threads=1,
        start=None,
        progress=None,
        interrupted=None,
        **options,
    )
    return part, time.perf_counter() - began


class Parts(parts.Parts[Ensemble, tuple[Ensemble, float]]):
    """The members of a run, split into parts for an executor, which are merged as they arrive.

    A part is 2^k blocks that begin at a multiple of 2^k, which the sums merge to one set. Its size
    follows from the time that earlier parts took, and decreases towards the end, so that all parts
    end at about the same time.
    """

    SECONDS = 1.0  # target time of a part
    MEMORY = 2**29  # maximum bytes of results that are not merged yet
    MOST = 1024  # maximum number of submitted parts

    def __init__(
        self,
        executor: Executor,
        sliders: AnySliders,
        motions: AnyMotions,
        options: dict[str, Any],
        first: int,
        members: int,
        start: Ensemble | None,
        keeper: Checkpoint,
    ) -> None:
        whole = _core.run_nothing(sliders, motions, first_member=first, **options)
        super().__init__(executor, whole, keeper)
        self.what = (sliders, motions, options)
        self.members = members
        self.block = whole.block
        if start is not None:
            whole.merge(start)
        self.gaps = self._gaps(first, first + members)
        self.todo = sum(map(len, self.gaps))
        self.size = 1  # blocks in the next part
        self.window = 8  # number of submitted parts; grows with each that arrives
        times = len(whole.time)
        sums = 12 + options["velocity_spectrum"] + 4 * options["ground_acceleration"]
        if whole.in_plane:
            sums = 48
        self.bytes_of_part = 8 * times * sums

    def feed(self) -> None:
        while self.gaps and len(self.flying) < self.window:
            self._submit_next()

    def progress(self) -> tuple[int, int]:
        return self.members - self.todo, self.members

    def take(self, part: Sequence[int], result: tuple[Ensemble, float]) -> None:
        ensemble, seconds = result
        self.so_far.merge(ensemble)
        self.todo -= len(part)
        blocks = -(-len(part) // self.block)
        wanted = max(1, int(blocks * self.SECONDS / max(seconds, 1e-3)))
        self.size = min(4 * self.size, 1 << wanted.bit_length() - 1)
        room = self.MEMORY // (self.bytes_of_part + 16 * self.size * self.block)
        self.window = max(4, min(self.window + 1, room, self.MOST))

    def _gaps(self, first: int, past: int) -> list[range]:
        """The members that are missing, the last first."""
        gaps, at = [], first
        for begin, end in self.so_far.member_ranges:
            if at < min(begin, past):
                gaps.append(range(at, min(begin, past)))
            at = max(at, end)
        if at < past:
            gaps.append(range(at, past))
        for gap in gaps:
            if gap.start % self.block:
                raise ValueError(
                    f"run_ensemble: a resumed ensemble must end on a block boundary, ends at member"
                    f" {gap.start}, within a block of {self.block}"
                )
        return gaps[::-1]

    def _submit_next(self) -> None:
        fair = max(1, sum(map(len, self.gaps)) // self.block // 16)
        gap = self.gaps.pop()
        place = gap.start // self.block
        size = min(self.size, place & -place or self.size, 1 << fair.bit_length() - 1)
        part = gap[: size * self.block]
        self.submit(part, _run_part, *self.what, part.start, len(part))
        if len(part) < len(gap):
            self.gaps.append(gap[len(part) :])
