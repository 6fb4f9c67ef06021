"""Progress of a run on stderr, by tqdm."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, TypeAlias

Progress: TypeAlias = Callable[[int, int], object]

_DELAY = 2.0  # [s], after which a run shows a bar that nobody asked for
_LINES = 10.0  # [s], between lines that are not on a screen


@contextmanager
def shown(progress: bool | Progress | None, who: str, unit: str) -> Iterator[Progress]:
    """What to call with the numbers done and in total: a bar, the caller's function, or nothing.

    None: a bar on a terminal or in a notebook if the run takes longer than two seconds.
    """
    if callable(progress):
        yield progress
        return
    if progress not in (True, False, None):
        raise TypeError(f"{who}: progress must be True, False or callable, got {progress!r}")
    seen = on_screen()
    if sys.stderr is None or not (seen if progress is None else progress):
        yield lambda done, total: None
        return
    bar = _Bar(
        unit=unit,
        file=sys.stderr,
        delay=_DELAY if progress is None else 0,
        mininterval=0.1 if seen else _LINES,
        dynamic_ncols=seen,
    )
    try:
        yield bar
    finally:
        bar.close()


def on_screen() -> bool:
    """Whether stderr is a terminal, or the output of a cell in a notebook."""
    return sys.stderr is not None and (sys.stderr.isatty() or _in_notebook())


def _in_notebook() -> bool:
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython else None
    return type(shell).__name__ == "ZMQInteractiveShell"


class _Bar:
    """A bar of tqdm that begins with the first call."""

    def __init__(self, **options: Any) -> None:
        self.options = options
        self.bar: Any = None

    def __call__(self, done: int, total: int) -> None:
        if self.bar is None:
            from tqdm.auto import tqdm  # type: ignore[import-untyped, unused-ignore]

            self.bar = tqdm(
                total=total,
                initial=done,  # members from a checkpoint do not count for the speed
                unit_scale=total >= 100_000,  # "1.23M of 3.00M"; smaller numbers are exact
                **self.options,
            )
        self.bar.update(done - self.bar.n)

    def close(self) -> None:
        if self.bar is not None:
            self.bar.close()
