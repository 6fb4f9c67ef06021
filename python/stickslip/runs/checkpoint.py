"""The file from which a run resumes."""

from __future__ import annotations

import os
import sys
import time
import warnings
from abc import ABC, abstractmethod
from collections.abc import Callable
from pathlib import Path
from typing import Any, ClassVar, Generic

from .._files import check_writable
from .error import Results, RunError

__all__ = ["Checkpoint"]


class Checkpoint(ABC, Generic[Results]):
    """The file that saves the progress of a run; inactive if no file is given."""

    error: ClassVar[type[RunError[Any]]]

    def __init__(self, file: str | os.PathLike[str] | None, every: float) -> None:
        if not every >= 0:
            raise ValueError(
                f"{self.error._who}: checkpoint_every must be at least 0, got {every} s"
            )
        self.file = None if file is None else Path(os.fspath(file))
        self.every = every
        self.saved = time.monotonic()
        self.warned = False
        if self.file is not None:
            check_writable(self.file)

    @abstractmethod
    def write(self, file: Path, results: Results) -> None:
        """Write results to the file, whole or not at all."""

    def found(self) -> Path | None:
        """The file, if it is there to resume from."""
        return self.file if self.file is not None and self.file.exists() else None

    def save_if_due(self, so_far: Callable[[], Results]) -> None:
        """Save if `every` seconds have passed; after a failure, warn once and retry later."""
        if self.file is None or time.monotonic() - self.saved < self.every:
            return
        try:
            self.write(self.file, so_far())
        except OSError as error:
            if not self.warned:
                self.warned = True
                warnings.warn(
                    f"{self.error._who}: cannot write checkpoint '{self.file}': {error}; the run"
                    f" continues and retries every {self.every:g} s",
                    RuntimeWarning,
                    stacklevel=_level_of_caller(),
                )
        self.saved = time.monotonic()

    def save(self, results: Results) -> None:
        """Save the final state; an error carries the results."""
        if self.file is None:
            return
        try:
            self.write(self.file, results)
        except OSError as error:
            raise self.error._of_checkpoint(self.file, error, results) from error


def _level_of_caller() -> int:
    """The `stacklevel` at which the function that calls this sees the caller of the package."""
    package = __name__.partition(".")[0]
    frame = sys._getframe(1)
    level = 1
    while frame.f_back and frame.f_globals.get("__name__", "").partition(".")[0] == package:
        frame, level = frame.f_back, level + 1
    return level
