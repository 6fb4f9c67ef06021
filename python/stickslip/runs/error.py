"""The error of an interrupted run."""

from __future__ import annotations

import os
import pickle
from collections.abc import Sequence
from typing import Any, ClassVar, Generic, TypeVar

__all__ = ["Results", "RunError"]

Results = TypeVar("Results")
_Error = TypeVar("_Error", bound="RunError[Any]")


class RunError(RuntimeError, Generic[Results]):
    """A part of a run failed in its executor, or its checkpoint could not be written.

    Parameters
    ----------
    message : str
    part : range
        What the part had to do; empty if the checkpoint failed.
    partial
        The results so far.
    """

    _who: ClassVar[str]  # the function that runs
    _things: ClassVar[str]  # what it is done for, and the attribute that has those of the part

    def __init__(self, message: str, part: range, partial: Results) -> None:
        super().__init__(message)
        setattr(self, self._things, part)
        self.partial = partial

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (str(self), getattr(self, self._things), self.partial)

    @classmethod
    def _done(cls, partial: Results) -> int:
        """How many things are in the results so far."""
        raise NotImplementedError

    @classmethod
    def _of_part(
        cls: type[_Error], part: Sequence[int], error: BaseException, partial: Any
    ) -> _Error:
        """The error of a part that failed with another one."""
        return cls(
            f"{cls._who}: {cls._things} {part[0]} to {part[-1]} failed in the executor:"
            f" {type(error).__name__}: {error}{_how_to_pickle(error)}; {cls._kept(partial)}",
            range(part[0], part[-1] + 1),
            partial,
        )

    @classmethod
    def _of_checkpoint(
        cls: type[_Error], file: str | os.PathLike[str] | None, error: OSError, partial: Any
    ) -> _Error:
        """The error of a checkpoint that cannot be written."""
        return cls(
            f"{cls._who}: cannot write checkpoint '{file}': {error}; {cls._kept(partial)}",
            range(0),
            partial,
        )

    @classmethod
    def _kept(cls, partial: Any) -> str:
        return f".partial has the {cls._done(partial)} {cls._things} that are done"


def _how_to_pickle(error: BaseException) -> str:
    """What to do about a law of a lambda or a local function, which no other process can get."""
    is_of_pickle = isinstance(error, pickle.PicklingError) or "pickle" in str(error)
    return " (define the functions of laws in a module, not in place)" if is_of_pickle else ""
