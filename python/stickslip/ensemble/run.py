"""`run_ensemble`, on threads or on any executor."""

from __future__ import annotations

import math
import operator
import os
from collections.abc import Callable
from concurrent.futures import Executor
from typing import Any, SupportsIndex

from .. import _core
from .._core import Ensemble
from .checkpoint import Checkpoint
from .parts import Parts
from .progress import Progress, shown
from .sources import AnyMotions, AnySliders


def run_ensemble(
    sliders: AnySliders,
    motions: AnyMotions,
    *,
    members: SupportsIndex,
    seed: SupportsIndex,
    first_member: SupportsIndex = 0,
    threads: SupportsIndex | None = None,
    dt: float | None = None,
    settle: bool = False,
    contact: str = "flight",
    velocity_spectrum: bool = True,
    ground_acceleration: bool = False,
    progress: bool | Progress = False,
    executor: Executor | None = None,
    checkpoint: str | os.PathLike[str] | None = None,
    checkpoint_every: float = 30.0,
) -> Ensemble:
    """Slides through many members and takes their statistics.

    x'' + resist sgn(x') + c x' + wn^2 x = -n(t), from rest at x = 0; thesis 4.4, 5.4. A member is a
    slider and a ground motion n(t), made from its number; each is solved as by `integrate`.

    Parameters
    ----------
    sliders : Slider, friction law, a list of these, Drawn, Random or SliderSource
        What slides; a law alone is a slider without spring and damper. Of a list of m sliders
        member i has the one at i modulo m, of `Drawn(list)` one drawn at random; `Random` has
        random parameters. A source of your own: `stickslip.ensemble.SliderSource`.
    motions : GaussianExcitation, PoissonPulses, GroundMotion or list of it, Drawn or Excitation
        What the ground does: a random source; or records, of different lengths and time steps, of
        which member i has the one at i modulo n, or of `Drawn(list)` one drawn at random. A source
        of your own: `stickslip.ensemble.Excitation`. Where durations differ, there are no
        statistics by time: `Ensemble.time` is empty.
    members : int
        How many, at least 1; for standard errors at least 2.
    seed : int
        From 0 to 2^64 - 1.
    first_member : int, optional
        Its number, a multiple of `Ensemble.block`, which is 64 unless the motions are long.
    threads : int, optional
        At most so many, at least 1; as many as the machine has, if not given.
    dt : float, optional
        Between the times of the statistics [s], a multiple of the motions' own; that itself, if not
        given, or 1/512 of the duration where they have none in common. ValueError where durations
        differ.
    settle : bool, optional
        Residuals and peaks after the slider has come to rest without ground acceleration, which
        it never does without friction: ConvergenceError.
    contact : 'flight' or 'clipped', optional
        What sliders do where the ground falls away from under them; see `integrate`.
    velocity_spectrum : bool, optional
        The velocity's spectral density too, at an FFT a member, where durations are the same.
    ground_acceleration : bool, optional
        Mean and variance of the ground acceleration by time too, where durations are the same: each
        motion is made once more for it.
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
        A value out of its range; parameters of `Random` that the law refuses (says which member and
        value); an empty list; a checkpoint that is damaged, of another configuration (says what
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
    Coulomb friction takes 6 to 7 ns a sample, spring and damper without friction 9 and casters 70
    under Gaussian excitation, Coulomb friction 10 ns a step under pulses, the velocity's spectrum 2
    ns a sample; others, and lists and random sliders, take what `integrate` takes, and some 10 ns.
    Memory: 16 bytes a member, and for each thread 1 kB a time; above 2^24 members peaks are counted
    in bins. A call costs 0.1 ms, and copies a list of records; so does each part that goes to an
    executor.

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
        "contact": contact,
        "velocity_spectrum": velocity_spectrum,
        "ground_acceleration": ground_acceleration,
    }
    keeper = Checkpoint(checkpoint, checkpoint_every)
    start = keeper.load(range(first, first + total))
    with shown(progress) as show:
        try:
            if executor is None:
                whole = _run_here(
                    sliders, motions, options, first, total, count, start, show, keeper
                )
            else:
                parts = Parts(executor, sliders, motions, options, first, total, start)
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
    sliders: AnySliders,
    motions: AnyMotions,
    options: dict[str, Any],
    first: int,
    members: int,
    threads: int,
    start: Ensemble | None,
    show: Progress,
    keeper: Checkpoint,
) -> Ensemble:
    def heartbeat(done: int, total: int, so_far: Callable[[], Ensemble]) -> None:
        show(done, total)
        keeper.save_if_due(so_far)

    def interrupted(so_far: Callable[[], Ensemble]) -> None:
        if keeper.file is not None:
            keeper.save(so_far())

    return _core.run_ensemble(
        sliders,
        motions,
        members=members,
        first_member=first,
        threads=threads,
        start=start,
        heartbeat=heartbeat,
        interrupted=interrupted,
        **options,
    )
