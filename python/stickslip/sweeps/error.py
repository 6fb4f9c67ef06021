"""The error of an interrupted sweep."""

from __future__ import annotations

from .table import SweepTable


class SweepError(RuntimeError):
    """A part of a sweep failed in its executor, or its checkpoint could not be written.

    `__cause__` is the exception raised there.

    Attributes
    ----------
    records : range
        The records of the part that failed; empty if the checkpoint failed.
    partial : SweepTable
        The results so far; NaN where there are none.
    """

    def __init__(self, message: str, records: range, partial: SweepTable) -> None:
        super().__init__(message)
        self.records = records
        self.partial = partial

    def __reduce__(self) -> tuple[type[SweepError], tuple[str, range, SweepTable]]:
        return type(self), (str(self), self.records, self.partial)
