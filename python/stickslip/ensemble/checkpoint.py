"""The file from which a run resumes."""

from __future__ import annotations

import os
import time
import warnings
from collections.abc import Callable
from pathlib import Path

from .._core import Ensemble
from .._files import check_writable
from .error import EnsembleError
from .files import load, save


class Checkpoint:
    """The file that saves the progress of a run; inactive if no file is given."""

    def __init__(self, file: str | os.PathLike[str] | None, every: float) -> None:
        if not every >= 0:
            raise ValueError(f"run_ensemble: checkpoint_every must be at least 0, got {every} s")
        self.file = None if file is None else Path(os.fspath(file))
        self.every = every
        self.saved = time.monotonic()
        self.warned = False
        if self.file is not None:
            check_writable(self.file)

    def load(self, asked: range) -> Ensemble | None:
        """Load the members that it holds; ValueError if the run does not ask for some of them."""
        if self.file is None or not self.file.exists():
            return None
        kept = load(self.file)
        for begin, end in kept.member_ranges:
            if begin < asked.start or end > asked.stop:
                raise ValueError(
                    f"run_ensemble: checkpoint '{self.file}' must hold members of this run only,"
                    f" {asked.start} to {asked.stop - 1} ({len(asked)}), got {kept.members}"
                    f" members, including {begin} to {end - 1}"
                )
        return kept

    def save_if_due(self, so_far: Callable[[], Ensemble]) -> None:
        """Save if `every` seconds have passed; after a failure, warn once and retry later."""
        if self.file is None or time.monotonic() - self.saved < self.every:
            return
        try:
            save(so_far(), self.file)
        except OSError as error:
            if not self.warned:
                self.warned = True
                warnings.warn(
                    f"run_ensemble: cannot write checkpoint '{self.file}': {error}; the run"
                    f" continues and retries every {self.every:g} s",
                    RuntimeWarning,
                    stacklevel=2,
                )
        self.saved = time.monotonic()

    def save(self, ensemble: Ensemble) -> None:
        """Save the final state; an error carries the ensemble."""
        if self.file is None:
            return
        try:
            save(ensemble, self.file)
        except OSError as error:
            raise EnsembleError(
                f"run_ensemble: cannot write checkpoint '{self.file}': {error}; .partial has the"
                f" {ensemble.members} members that are done",
                range(0),
                ensemble,
            ) from error
