"""A run in parts, on an executor."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ProcessPoolExecutor, wait
from multiprocessing.reduction import ForkingPickler
from typing import Any, Generic, TypeVar

from .checkpoint import Checkpoint
from .error import Results
from .progress import Progress

__all__ = ["Parts", "check_executor"]

_Result = TypeVar("_Result")  # of a part


def check_executor(who: str, executor: Executor | None, threads: int | None) -> None:
    """Reject an executor beside threads, and what is no executor."""
    if executor is not None and threads is not None:
        raise ValueError(
            f"{who}: give threads or executor, whose parts have one thread, got threads ="
            f" {threads} with {type(executor).__name__}"
        )
    if executor is not None and not hasattr(executor, "submit"):
        raise TypeError(
            f"{who}: executor must be a concurrent.futures.Executor, got {type(executor).__name__}"
        )


def _unpickled(task: bytes) -> Any:
    """Do in another process what was pickled for it."""
    work, arguments = ForkingPickler.loads(task)
    return work(*arguments)


class Parts(ABC, Generic[Results, _Result]):
    """The parts of a run, whose results are taken as they arrive.

    Parameters
    ----------
    executor : Executor
    so_far
        The results, to which those of the parts are added.
    keeper : Checkpoint
    """

    def __init__(self, executor: Executor, so_far: Results, keeper: Checkpoint[Results]) -> None:
        self.executor = executor
        self.so_far = so_far
        self.keeper = keeper
        self.flying: dict[Future[_Result], Sequence[int]] = {}

    @abstractmethod
    def feed(self) -> None:
        """Submit parts: all, or as many as may be under way."""

    @abstractmethod
    def take(self, part: Sequence[int], result: _Result) -> None:
        """Add the result of a part to the results."""

    @abstractmethod
    def progress(self) -> tuple[int, int]:
        """How much is done, and of how much."""

    def submit(self, part: Sequence[int], work: Callable[..., _Result], *arguments: Any) -> None:
        """Submit a part."""
        try:
            if isinstance(self.executor, ProcessPoolExecutor):
                # Where a pool itself fails to pickle a task, its shutdown may never return.
                task = bytes(ForkingPickler.dumps((work, arguments)))
                future: Future[_Result] = self.executor.submit(_unpickled, task)
            else:
                future = self.executor.submit(work, *arguments)
        except Exception as error:  # such as from a pool whose processes are gone
            raise self.keeper.error._of_part(part, error, self.so_far) from error
        self.flying[future] = part

    def run(self, show: Progress) -> Results:
        """Run all parts; if one fails, take the others that arrived, cancel the rest and save."""
        try:
            self.feed()
            while self.flying:
                finished, _ = wait(self.flying, timeout=0.1, return_when=FIRST_COMPLETED)
                self._take_all(finished)
                show(*self.progress())
                self.keeper.save_if_due(lambda: self.so_far)
                self.feed()
        except BaseException:
            for future in self.flying:
                future.cancel()
            self.keeper.save(self.so_far)
            raise
        show(*self.progress())
        return self.so_far

    def _take_all(self, finished: Iterable[Future[_Result]]) -> None:
        failed: list[tuple[Sequence[int], Exception]] = []
        for future in finished:
            part = self.flying.pop(future)
            try:
                result = future.result()
            except Exception as reason:
                failed.append((part, reason))
            else:
                self.take(part, result)
        for part, error in sorted(failed, key=lambda one: one[0][0]):
            raise self.keeper.error._of_part(part, error, self.so_far) from error
