"""The error of an interrupted run."""

from __future__ import annotations

from .._core import Ensemble
from ..runs.error import RunError


class EnsembleError(RunError[Ensemble]):
    """A part of an ensemble failed in its executor, or its checkpoint could not be written.

    `__cause__` is the exception raised there.

    Attributes
    ----------
    members : range
        The members of the part that failed; empty if the checkpoint failed.
    partial : Ensemble
        The members that are done; also in the checkpoint, unless that could not be written.
    """

    _who, _things = "run_ensemble", "members"

    members: range

    @classmethod
    def _done(cls, partial: Ensemble) -> int:
        return partial.members
