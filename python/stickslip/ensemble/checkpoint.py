"""The file from which a run resumes."""

from __future__ import annotations

from pathlib import Path

from .._core import Ensemble
from ..runs import checkpoint
from .error import EnsembleError
from .files import load, save


class Checkpoint(checkpoint.Checkpoint[Ensemble]):
    """The file that saves the progress of an ensemble: the ensemble itself."""

    error = EnsembleError

    def load(self, asked: range) -> Ensemble | None:
        """Load the members that it holds; ValueError if the run does not ask for some of them."""
        file = self.found()
        if file is None:
            return None
        kept = load(file)
        for begin, end in kept.member_ranges:
            if begin < asked.start or end > asked.stop:
                raise ValueError(
                    f"run_ensemble: checkpoint '{file}' must hold members of this run only,"
                    f" {asked.start} to {asked.stop - 1} ({len(asked)}), got {kept.members}"
                    f" members, including {begin} to {end - 1}"
                )
        return kept

    def write(self, file: Path, results: Ensemble) -> None:
        save(results, file)
