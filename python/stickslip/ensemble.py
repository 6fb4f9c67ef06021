"""Ensembles: many members of a random excitation, on threads, on any executor, with progress.

Members are simulated and summed in blocks, and the sums merge in an order that the members' numbers
fix. So it matters to no bit of an answer who simulated what, and when: threads, processes, a
cluster, a run that was broken off and gone on with.
"""

from __future__ import annotations

import io
import json
import math
import operator
import os
import sys
import time
import warnings
import zipfile
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Protocol, SupportsIndex, TypeAlias

import numpy as np

from . import _core
from ._core import (
    Caster,
    Coulomb,
    Ensemble,
    GaussianExcitation,
    GroundMotion,
    PoissonPulses,
    Slider,
    ViscousSlider,
)
from ._files import check_regular, check_writable, replacing

__all__ = ["EnsembleError", "Excitation", "run_ensemble"]


class Excitation(Protocol):
    """A random source of ground motions of somebody's own, as `run_ensemble` takes it.

    It may have `dt` as well [s]: between the times of the statistics, where its motions have
    samples. It is asked by several threads, one at a time; to go to other processes it must pickle.
    """

    @property
    def duration(self) -> float:
        """Of each motion [s], positive."""

    @property
    def configuration(self) -> Any:
        """All that the motions depend on, as JSON knows it: only what has the same is merged."""

    def sample(self, *, seed: int, member: int) -> GroundMotion:
        """The motion of that name, the same for ever."""


_AnySlider: TypeAlias = Slider | Coulomb | Caster | ViscousSlider
_AnyExcitation: TypeAlias = GaussianExcitation | PoissonPulses | Excitation
_Progress: TypeAlias = Callable[[int, int], object]


class EnsembleError(RuntimeError):
    """A part of an ensemble failed in its executor, or its checkpoint could not be written.

    `__cause__` is the exception raised there.

    Attributes
    ----------
    members : range
        Those that the part was to simulate; none if it was the checkpoint.
    partial : Ensemble
        What was done; also in the checkpoint, unless that could not be written.
    """

    def __init__(self, message: str, members: range, partial: Ensemble) -> None:
        super().__init__(message)
        self.members = members
        self.partial = partial

    def __reduce__(self) -> tuple[type[EnsembleError], tuple[str, range, Ensemble]]:
        return type(self), (str(self), self.members, self.partial)


def run_ensemble(
    slider: _AnySlider,
    excitation: _AnyExcitation,
    *,
    members: SupportsIndex,
    seed: SupportsIndex,
    first_member: SupportsIndex = 0,
    threads: SupportsIndex | None = None,
    dt: float | None = None,
    settle: bool = False,
    velocity_spectrum: bool = True,
    progress: bool | _Progress = False,
    executor: Executor | None = None,
    checkpoint: str | os.PathLike[str] | None = None,
    checkpoint_every: float = 30.0,
) -> Ensemble:
    """Slides through many members of a random excitation and takes their statistics.

    x'' + level(x) sgn(x') + wn^2 x = -n(t), n(t) the motion `excitation.sample(seed, member)`, from
    rest at x = 0; thesis 4.4, 5.4. Each member is solved as by `integrate`.

    Parameters
    ----------
    slider : Slider, Coulomb, Caster or ViscousSlider
        What slides; a law alone is a slider without a spring.
    excitation : GaussianExcitation, PoissonPulses or Excitation
        A source of ground motions; of your own, see `stickslip.ensemble.Excitation`.
    members : int
        How many, at least 1; for standard errors at least 2.
    seed : int
        From 0 to 2^64 - 1.
    first_member : int, optional
        Its number, a multiple of `Ensemble.block`, which is 64 unless the motions are long.
    threads : int, optional
        At most so many, at least 1; as many as the machine has, if not given.
    dt : float, optional
        Between the times of the statistics [s], a multiple of the excitation's own; that itself, if
        not given, or 1/512 of the duration where it has none.
    settle : bool, optional
        Residuals and peaks after the slider has come to rest without ground acceleration, which a
        ViscousSlider never does: ValueError.
    velocity_spectrum : bool, optional
        The velocity's spectral density too, at an FFT a member.
    progress : bool or callable, optional
        True: a bar on stderr (a line at each tenth where that is no terminal). A callable is called
        with the members done and to do, ten times a second or so.
    executor : concurrent.futures.Executor, optional
        Where to run, with one thread for each part: a ProcessPoolExecutor, Dask's
        `Client.get_executor()`, mpi4py's MPIPoolExecutor. It is not shut down. Parts begin small
        and grow until they take a second.
    checkpoint : path-like, optional
        A file that keeps what is done: written every `checkpoint_every` seconds, at the end, and
        where the run is broken off. If it is there already, the run resumes from it. If it cannot
        be written during the run, as on a full disk, the run warns once (RuntimeWarning), continues
        and retries.
    checkpoint_every : float, optional
        [s], at least 0.

    Returns
    -------
    Ensemble
        The same bits for any threads, executor and parts, and for a run that was gone on with.

    Raises
    ------
    ValueError
        A value out of its range; a checkpoint that is damaged, of another configuration (says what
        differs), or that holds members not asked for.
    TypeError
        An argument of the wrong type.
    OverflowError
        Displacements or velocities beyond 1e34 [m, m/s], whose statistics could leave the range of
        doubles; says which member or block.
    ConvergenceError
        A member does not settle; says which.
    EnsembleError
        A part failed in the executor, and what had not begun is cancelled; or the checkpoint could
        not be written when the run ended or was interrupted. `partial` has what was done.
    OSError
        Before the run: the checkpoint cannot be read, or is not a regular file that may be written.
    KeyboardInterrupt
        Within a second of Ctrl-C.

    Notes
    -----
    On one thread, the motions and the statistics included (2.5 GHz, AVX2): without a spring,
    Coulomb friction takes 6 to 7 ns a sample, viscous sliders 9 and casters 70 under Gaussian
    excitation, Coulomb friction 10 ns a step under pulses, the velocity's spectrum 2 ns a sample;
    others take what `integrate` takes, and some 10 ns. Memory: 16 bytes a member, and for each
    thread 1 kB a time; above 2^24 members peaks are counted in bins. A call costs 0.1 ms.

    References
    ----------
    Thesis 4.4, 5.4; P. Pebay, Formulas for robust, one-pass parallel computation of covariances and
    arbitrary-order statistical moments, SAND2008-6212 (2008).
    """
    total = _whole("members", members, 1)
    first = _whole("first_member", first_member, 0)
    count = 0 if threads is None else _whole("threads", threads, 1, 2**16)
    if executor is not None and threads is not None:
        raise ValueError(
            f"run_ensemble: give threads or executor, whose parts have one thread, got threads ="
            f" {count} with {type(executor).__name__}"
        )
    if executor is not None and not hasattr(executor, "submit"):
        raise TypeError(
            "run_ensemble: executor must be a concurrent.futures.Executor, got"
            f" {type(executor).__name__}"
        )
    options = {
        "seed": _whole("seed", seed, 0),
        "dt": 0.0 if dt is None else _positive("dt", dt),
        "settle": settle,
        "velocity_spectrum": velocity_spectrum,
    }
    keeper = _Checkpoint(checkpoint, checkpoint_every)
    start = keeper.load(range(first, first + total))
    with _shown(progress) as show:
        try:
            if executor is None:
                whole = _run_here(
                    slider, excitation, options, first, total, count, start, show, keeper
                )
            else:
                parts = _Parts(executor, slider, excitation, options, first, total, start)
                whole = parts.run(show, keeper)
        except ValueError as error:
            if start is None:
                raise
            raise ValueError(f"run_ensemble: with checkpoint '{checkpoint}': {error}") from error
    keeper.save(whole)
    return whole


def _whole(name: str, value: SupportsIndex, least: int, most: int = 2**64 - 1) -> int:
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"run_ensemble: {name} must be a whole number, got {value!r}") from None
    if not least <= number <= most:
        bound = f"at least {least}" if number < least else f"at most {most}"
        raise ValueError(f"run_ensemble: {name} must be {bound}, got {number}")
    return number


def _positive(name: str, value: float) -> float:
    if not (0 < value < math.inf):
        raise ValueError(f"run_ensemble: {name} must be positive and finite, got {value} s")
    return float(value)


def _run_here(
    slider: _AnySlider,
    excitation: _AnyExcitation,
    options: dict[str, Any],
    first: int,
    members: int,
    threads: int,
    start: Ensemble | None,
    show: _Progress,
    keeper: _Checkpoint,
) -> Ensemble:
    def heartbeat(done: int, total: int, so_far: Callable[[], Ensemble]) -> None:
        show(done, total)
        keeper.save_if_due(so_far)

    def interrupted(so_far: Callable[[], Ensemble]) -> None:
        if keeper.file is not None:
            keeper.save(so_far())

    return _core.run_ensemble(
        slider,
        excitation,
        members=members,
        first_member=first,
        threads=threads,
        start=start,
        heartbeat=heartbeat,
        interrupted=interrupted,
        **options,
    )


# ---- executors


def _run_part(
    slider: _AnySlider,
    excitation: _AnyExcitation,
    options: dict[str, Any],
    first: int,
    members: int,
) -> tuple[Ensemble, float]:
    """A part, and how long it took [s]; a function of the module, so that it pickles."""
    began = time.perf_counter()
    part = _core.run_ensemble(
        slider,
        excitation,
        members=members,
        first_member=first,
        threads=1,
        start=None,
        heartbeat=None,
        interrupted=None,
        **options,
    )
    return part, time.perf_counter() - began


class _Parts:
    """The members of a run, cut in parts that go to an executor, and merged as they come back.

    A part is 2^k blocks on a multiple of 2^k, which the sums merge to one set. Its size follows
    from the time that those before it took, and falls towards the end, so that all end together.
    """

    SECONDS = 1.0  # that a part is to take
    MEMORY = 2**29  # bytes that results may take which have not been merged yet
    MOST = 1024  # parts under way

    def __init__(
        self,
        executor: Executor,
        slider: _AnySlider,
        excitation: _AnyExcitation,
        options: dict[str, Any],
        first: int,
        members: int,
        start: Ensemble | None,
    ) -> None:
        self.executor = executor
        self.what = (slider, excitation, options)
        self.members = members
        self.whole = _core.run_nothing(slider, excitation, first_member=first, **options)
        self.block = self.whole.block
        if start is not None:
            self.whole.merge(start)
        self.gaps = self._gaps(first, first + members)
        self.todo = sum(map(len, self.gaps))
        self.flying: dict[Future[tuple[Ensemble, float]], range] = {}
        self.size = 1  # blocks in the next part
        self.window = 8  # parts under way; opens with each that comes back
        times = len(self.whole.time)
        self.bytes_of_part = 8 * times * (13 if options["velocity_spectrum"] else 12)

    def run(self, show: _Progress, keeper: _Checkpoint) -> Ensemble:
        try:
            while self.gaps or self.flying:
                while self.gaps and len(self.flying) < self.window:
                    self._submit()
                finished, _ = wait(self.flying, timeout=0.1, return_when=FIRST_COMPLETED)
                self._take(finished)
                show(self.members - self.todo, self.members)
                keeper.save_if_due(lambda: self.whole)
        except BaseException:
            for future in self.flying:
                future.cancel()
            keeper.save(self.whole)
            raise
        show(self.members, self.members)
        return self.whole

    def _gaps(self, first: int, past: int) -> list[range]:
        """The members that are not there yet, the last first."""
        gaps, at = [], first
        for begin, end in self.whole.member_ranges:
            if at < min(begin, past):
                gaps.append(range(at, min(begin, past)))
            at = max(at, end)
        if at < past:
            gaps.append(range(at, past))
        for gap in gaps:
            if gap.start % self.block:
                raise ValueError(
                    f"run_ensemble: what is to be gone on from ends at member {gap.start}, within"
                    f" a block of {self.block}"
                )
        return gaps[::-1]

    def _submit(self) -> None:
        fair = max(1, sum(map(len, self.gaps)) // self.block // 16)
        gap = self.gaps.pop()
        place = gap.start // self.block
        size = min(self.size, place & -place or self.size, 1 << fair.bit_length() - 1)
        part = gap[: size * self.block]
        try:
            future = self.executor.submit(_run_part, *self.what, part.start, len(part))
        except Exception as error:  # as of a pool whose processes are gone
            raise self._failed(part, error) from error
        self.flying[future] = part
        if len(part) < len(gap):
            self.gaps.append(gap[len(part) :])

    def _take(self, finished: set[Future[tuple[Ensemble, float]]]) -> None:
        failed: list[tuple[range, BaseException]] = []
        for future in finished:
            members = self.flying.pop(future)
            try:
                part, seconds = future.result()
            except Exception as error:
                failed.append((members, error))
                continue
            self.whole.merge(part)
            self.todo -= len(members)
            blocks = -(-len(members) // self.block)
            wanted = max(1, int(blocks * self.SECONDS / max(seconds, 1e-3)))
            self.size = min(4 * self.size, 1 << wanted.bit_length() - 1)
            room = self.MEMORY // (self.bytes_of_part + 16 * self.size * self.block)
            self.window = max(4, min(self.window + 1, room, self.MOST))
        for members, error in failed:
            raise self._failed(members, error) from error

    def _failed(self, members: range, error: BaseException) -> EnsembleError:
        return EnsembleError(
            f"run_ensemble: members {members[0]} to {members[-1]} failed in the executor:"
            f" {type(error).__name__}: {error}; .partial has the {self.whole.members} members that"
            " are done",
            members,
            self.whole,
        )


# ---- progress


@contextmanager
def _shown(progress: bool | _Progress) -> Iterator[_Progress]:
    if callable(progress):
        yield progress
    elif progress not in (True, False, None):
        raise TypeError(f"run_ensemble: progress must be True, False or callable, got {progress!r}")
    elif progress and sys.stderr is not None:
        bar = _Bar()
        try:
            yield bar
        finally:
            bar.close()
    else:
        yield lambda done, total: None


class _Bar:
    """How far a run has come, in one line of stderr, or in lines where that is no terminal."""

    def __init__(self) -> None:
        self.stream = sys.stderr
        self.in_place = self.stream.isatty()
        self.began: tuple[float, int] | None = None  # [s], members
        self.tenths = 0
        self.width = 0

    def __call__(self, done: int, total: int) -> None:
        now = time.monotonic()
        if self.began is None:  # what a checkpoint had is no speed
            self.began = now, done
        seconds, fresh = now - self.began[0], done - self.began[1]
        line = f"{done:,} of {total:,} members"
        if seconds > 0 and fresh > 0:
            speed = fresh / seconds
            left = (total - done) / speed
            line += f", {_round(speed)}/s, " + (
                f"{_span(left)} left" if done < total else _span(seconds)
            )
        if self.in_place:
            filled = 24 * done // total
            line = f"[{'#' * filled}{'.' * (24 - filled)}] {100 * done // total:3d} %  {line}"
            self.stream.write("\r" + line.ljust(self.width))
            self.width = len(line)
        elif 10 * done // total > self.tenths:
            self.tenths = 10 * done // total
            self.stream.write(f"{100 * done // total:3d} %  {line}\n")
        self.stream.flush()

    def close(self) -> None:
        if self.width:
            self.stream.write("\n")
            self.stream.flush()


def _round(speed: float) -> str:
    """Two digits or so, as 210,000."""
    step = 10 ** max(0, math.floor(math.log10(max(speed, 1))) - 1)
    return f"{round(speed / step) * step:,}" if speed >= 10 else f"{speed:.2g}"


def _span(seconds: float) -> str:
    if seconds < 100:
        return f"{seconds:.1f} s" if seconds < 10 else f"{seconds:.0f} s"
    minutes = round(seconds / 60)
    return f"{minutes} min" if minutes < 100 else f"{minutes // 60} h {minutes % 60:02d} min"


# ---- files

_FORMAT = "stickslip ensemble 1"
_ABOUT = frozenset(("format", "library"))
_NAMES = _ABOUT | {
    *("configuration", "dt", "times", "velocity_spectrum"),
    *("level", "number", "count", "sums", "cut_block", "cut_size"),
    *("kept_block", "kept_size", "peak", "residual", "bin", "bin_count"),
}


class _Checkpoint:
    """The file that keeps what is done, if there is to be one."""

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
        """The members it holds; ValueError if some are not among those asked for."""
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
        """Save once every `every` seconds; a failure is retried after as long."""
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
        """Save for the last time; an error carries the ensemble."""
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


def save(ensemble: Ensemble, file: str | os.PathLike[str]) -> None:
    """What `Ensemble.save` does, which see."""
    state = ensemble.__getstate__()
    state["configuration"] = json.dumps(state["configuration"])
    with replacing(file) as stream:
        np.savez(stream, format=_FORMAT, library=_core.__version__, **state)


def load(file: str | os.PathLike[str]) -> Ensemble:
    """What `Ensemble.load` does, which see."""
    path = Path(os.fspath(file))

    def refuse(what: str) -> ValueError:
        return ValueError(f"Ensemble.load: '{path}' {what}")

    check_regular(path)
    with path.open("rb") as stream:
        if stream.read(4) != b"PK\x03\x04":
            raise refuse("is no ensemble: not a NumPy archive (.npz)")
        try:
            archive = zipfile.ZipFile(stream)
        except zipfile.BadZipFile as error:
            raise refuse("is truncated or damaged: its table of contents is missing") from error
        except Exception as error:  # what the table says is nonsense, in whatever way
            raise refuse(f"is damaged: {error}") from error
        try:
            entries = _entries(archive, path.stat().st_size)
            about = {name: _array(archive, entries[name]) for name in _ABOUT if name in entries}
        except Exception as error:
            raise refuse(f"is damaged: {error}") from error
        if not str(about.get("format")).startswith("stickslip ensemble "):
            raise refuse(f"is no ensemble: it holds {', '.join(sorted(entries)) or 'nothing'}")
        if str(about["format"]) != _FORMAT:
            raise refuse(
                f"is of format '{about['format']}', of stickslip {about.get('library')}; this is"
                f" stickslip {_core.__version__}, which reads '{_FORMAT}'"
            )
        if entries.keys() != _NAMES:
            odd = ", ".join(sorted(entries.keys() ^ _NAMES))
            raise refuse(f"does not hold what an ensemble does: missing or unknown {odd}")
        try:
            state = {name: _array(archive, entries[name]) for name in _NAMES - _ABOUT}
        except Exception as error:
            raise refuse(f"is damaged: {error}") from error
    ensemble = Ensemble.__new__(Ensemble)
    try:
        plain = {name: array.item() if array.ndim == 0 else array for name, array in state.items()}
        plain["configuration"] = [tuple(entry) for entry in json.loads(plain["configuration"])]
        ensemble.__setstate__(plain)
    except (RuntimeError, TypeError, ValueError) as error:
        raise refuse(f"does not hold what an ensemble does: {error}") from error
    return ensemble


def _entries(archive: zipfile.ZipFile, size: int) -> dict[str, zipfile.ZipInfo]:
    """The entries of an archive by name; ValueError if they take more memory than the file."""
    entries = {info.filename.removesuffix(".npy"): info for info in archive.infolist()}
    if len(entries) < len(archive.infolist()):
        raise ValueError("two entries have one name")
    for name, info in entries.items():
        if info.compress_type != zipfile.ZIP_STORED or info.file_size != info.compress_size:
            raise ValueError(f"{name} must not be compressed")
    if sum(info.file_size for info in entries.values()) > size:
        raise ValueError("its entries overlap")
    return entries


def _array(archive: zipfile.ZipFile, entry: zipfile.ZipInfo) -> np.ndarray:
    """The array of an entry; an error if its checksum or size is wrong."""
    content = archive.read(entry)
    stream = io.BytesIO(content)
    if np.lib.format.read_magic(stream) != (1, 0):
        raise ValueError(f"{entry.filename} is no array of format 1.0")
    shape, is_fortran, dtype = np.lib.format.read_array_header_1_0(stream)
    array = np.frombuffer(content, dtype, offset=stream.tell())
    return array.reshape(shape, order="F" if is_fortran else "C")
