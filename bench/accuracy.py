"""Errors of other programs against `integrate`, and their times in turns with it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import stickslip as ss
from measure import UNRELIABLE, Timing, take_turns

OURS = "stickslip"
SLIDES = 0.01  # [m]; motions with a smaller peak do not count

# Peak and displacement at the end [m]; in the plane the latter is a pair.
Answer = tuple[float, "float | np.ndarray"]
Program = Callable[[ss.GroundMotion], Answer]


@dataclass(frozen=True)
class Errors:
    """Of the peak and the final displacement, over the exact peak; NaN where a step diverged."""

    peak: np.ndarray
    final: np.ndarray

    @property
    def largest(self) -> float:
        return float(max(self.peak.max(), self.final.max()))

    def __str__(self) -> str:
        cells = [
            f"{100 * f(e[~np.isnan(e)]):9.2g}"
            for e in (self.peak, self.final)
            for f in (np.median, np.max)
        ]
        diverged = np.isnan(self.peak).sum()
        return " ".join(cells) + (f"   {diverged} diverged" if diverged else "")


def errors(motions: Sequence[ss.GroundMotion], exact: Program, program: Program) -> Errors:
    peaks, finals = [], []
    for motion in motions:
        peak, final = exact(motion)
        if peak < SLIDES:
            continue
        found = program(motion)
        peaks.append(abs(found[0] - peak) / peak)
        finals.append(float(np.linalg.norm(np.subtract(found[1], final))) / peak)
    return Errors(np.array(peaks), np.array(finals))


def all_errors(
    programs: Mapping[str, Program], motions: Sequence[ss.GroundMotion]
) -> dict[str, Errors]:
    """Those of every program but ours, printed as they are found."""
    found = {}
    for name, program in programs.items():
        if name != OURS:
            found[name] = here = errors(motions, programs[OURS], program)
            print(f"{name:36} {here}   {len(here.peak)} motions", flush=True)
    return found


def times(
    programs: Mapping[str, Program],
    motions: Sequence[ss.GroundMotion],
    rounds: int,
    repeats: int,
) -> dict[str, Timing]:
    """In turns; ours `repeats` times over in its turn, as it is so short."""
    items = sum(map(len, motions))

    def work(program: Program, count: int) -> Callable[[], object]:
        return lambda: [program(motion) for _ in range(count) for motion in motions]

    works = {}
    for name, program in programs.items():
        count = repeats if name == OURS else 1
        works[name] = (work(program, count), items * count)
    return take_turns(works, rounds)


def print_times(rows: Mapping[str, Timing]) -> None:
    print(f"{'ns per sample':36} {'median':>9} {'spread':>7} {'ratio':>9}")
    for name, timing in rows.items():
        print(f"{name:36} {timing} {timing.ratio(rows[OURS]):9.3g}")
    if not all(t.reliable for t in rows.values()):
        print(UNRELIABLE)
