"""Progress of a run on stderr."""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, TypeAlias

Progress: TypeAlias = Callable[[int, int], object]


@contextmanager
def shown(
    progress: bool | Progress, who: str = "run_ensemble", things: str = "members"
) -> Iterator[Progress]:
    if callable(progress):
        yield progress
    elif progress not in (True, False, None):
        raise TypeError(f"{who}: progress must be True, False or callable, got {progress!r}")
    elif progress and sys.stderr is not None:
        bar = _bar(things)
        try:
            yield bar
        finally:
            bar.close()
    else:
        yield lambda done, total: None


def _bar(things: str) -> _Bar | _Tqdm:
    """The bar of tqdm in notebooks and terminals if tqdm is installed; otherwise our own."""
    if sys.stderr.isatty() or _in_notebook():
        try:
            return _Tqdm(things)
        except ImportError:
            pass
    return _Bar(things)


def _in_notebook() -> bool:
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython else None
    return type(shell).__name__ == "ZMQInteractiveShell"


class _Tqdm:
    """A progress bar of tqdm, which also works in notebooks."""

    def __init__(self, things: str) -> None:
        from tqdm.auto import tqdm  # type: ignore[import-untyped, unused-ignore]

        self.tqdm = tqdm
        self.unit = things.removesuffix("s")
        self.bar: Any = None

    def __call__(self, done: int, total: int) -> None:
        if self.bar is None:  # members from a checkpoint do not count for the speed
            self.bar = self.tqdm(
                total=total,
                initial=done,
                unit=self.unit,
                unit_scale=total >= 100_000,  # "1.23M of 3.00M"; smaller numbers are exact
                file=sys.stderr,
            )
        self.bar.update(done - self.bar.n)

    def close(self) -> None:
        if self.bar is not None:
            self.bar.close()


class _Bar:
    """The progress in one line of stderr, or in several lines if that is not a terminal."""

    def __init__(self, things: str) -> None:
        self.things = things
        self.stream = sys.stderr
        self.in_place = self.stream.isatty()
        self.began: tuple[float, int] | None = None  # [s], things
        self.tenths = 0
        self.width = 0

    def __call__(self, done: int, total: int) -> None:
        now = time.monotonic()
        if self.began is None:  # members from a checkpoint do not count for the speed
            self.began = now, done
        seconds, fresh = now - self.began[0], done - self.began[1]
        line = f"{done:,} of {total:,} {self.things}"
        if seconds > 0 and fresh > 0:
            speed = fresh / seconds
            left = (total - done) / speed
            line += f", {_round(speed)}/s, " + (
                f"{_span(left)} left" if done < total else _span(seconds)
            )
        if self.in_place:
            filled = 24 * done // total
            line = f"[{'#' * filled}{'.' * (24 - filled)}] {100 * done // total:3d} %  {line}"
            self.stream.write("\r" + line.ljust(self.width))
            self.width = len(line)
        elif 10 * done // total > self.tenths:
            self.tenths = 10 * done // total
            self.stream.write(f"{100 * done // total:3d} %  {line}\n")
        self.stream.flush()

    def close(self) -> None:
        if self.width:
            self.stream.write("\n")
            self.stream.flush()


def _round(speed: float) -> str:
    """Round to two digits or so, such as 210,000."""
    step = 10 ** max(0, math.floor(math.log10(max(speed, 1))) - 1)
    return f"{round(speed / step) * step:,}" if speed >= 10 else f"{speed:.2g}"


def _span(seconds: float) -> str:
    if seconds < 100:
        return f"{seconds:.1f} s" if seconds < 10 else f"{seconds:.0f} s"
    minutes = round(seconds / 60)
    return f"{minutes} min" if minutes < 100 else f"{minutes // 60} h {minutes % 60:02d} min"
