"""The error of a sweep that broke off."""

from __future__ import annotations

from .table import SweepTable


class SweepError(RuntimeError):
    """A part of a sweep failed in its executor, or its checkpoint could not be written.

    `__cause__` is the exception raised there.

    Attributes
    ----------
    records : range
        Those of the part; none if it was the checkpoint.
    partial : SweepTable
        What was done; NaN where nothing was.
    """

    def __init__(self, message: str, records: range, partial: SweepTable) -> None:
        super().__init__(message)
        self.records = records
        self.partial = partial

    def __reduce__(self) -> tuple[type[SweepError], tuple[str, range, SweepTable]]:
        return type(self), (str(self), self.records, self.partial)
