"""The error of an interrupted sweep."""

from __future__ import annotations

from ..runs.error import RunError
from .table import SweepTable


class SweepError(RunError[SweepTable]):
    """A part of a sweep failed in its executor, or its checkpoint could not be written.

    `__cause__` is the exception raised there.

    Attributes
    ----------
    records : range
        The records of the part that failed; empty if the checkpoint failed.
    partial : SweepTable
        The results so far; NaN where there are none.
    """

    _who, _things = "sweep", "records"

    records: range

    @classmethod
    def _done(cls, partial: SweepTable) -> int:
        return int(partial.done.sum())
