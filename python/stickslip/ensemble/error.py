"""The error of an interrupted run."""

from __future__ import annotations

import pickle

from .._core import Ensemble


class EnsembleError(RuntimeError):
    """A part of an ensemble failed in its executor, or its checkpoint could not be written.

    `__cause__` is the exception raised there.

    Attributes
    ----------
    members : range
        The members of the part that failed; empty if the checkpoint failed.
    partial : Ensemble
        The members that are done; also in the checkpoint, unless that could not be written.
    """

    def __init__(self, message: str, members: range, partial: Ensemble) -> None:
        super().__init__(message)
        self.members = members
        self.partial = partial

    def __reduce__(self) -> tuple[type[EnsembleError], tuple[str, range, Ensemble]]:
        return type(self), (str(self), self.members, self.partial)


def how_to_pickle(error: BaseException) -> str:
    """What to do about a law of a lambda or a local function, which no other process can get."""
    is_of_pickle = isinstance(error, pickle.PicklingError) or "pickle" in str(error)
    return " (define the functions of laws in a module, not in place)" if is_of_pickle else ""
