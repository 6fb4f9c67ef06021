"""`run_ensemble`, on threads or on any executor."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from typing import TYPE_CHECKING, Any, SupportsIndex, cast, overload

from .. import _core
from .._core import Cart, Ensemble, GroundMotion
from .._numbers import whole_number
from .._units import warn_of_units
from ..runs.parts import check_executor
from ..runs.progress import Progress, shown
from .checkpoint import Checkpoint
from .parts import Parts
from .sources import AnyMotions, AnySliders, Blocks, check_directions

if TYPE_CHECKING:
    from ..carts.ensemble import CartEnsemble
    from ..carts.sweep import Walls
    from ..rocking.ensemble import RockingEnsemble
    from .random_headings import Carts


@overload
def run_ensemble(
    sliders: Carts,
    motions: AnyMotions,
    *,
    members: SupportsIndex,
    seed: SupportsIndex,
    first_member: SupportsIndex = 0,
    threads: SupportsIndex | None = None,
    settle: bool = False,
    walls: Walls | None = None,
    progress: bool | Progress | None = None,
) -> CartEnsemble: ...
@overload
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
    contact: str | None = None,
    velocity_spectrum: bool = True,
    ground_acceleration: bool = False,
    progress: bool | Progress | None = None,
    executor: Executor | None = None,
    checkpoint: str | os.PathLike[str] | None = None,
    checkpoint_every: float = 30.0,
) -> Ensemble: ...
@overload
def run_ensemble(
    sliders: Blocks,
    motions: AnyMotions,
    *,
    members: SupportsIndex,
    seed: SupportsIndex,
    first_member: SupportsIndex = 0,
    threads: SupportsIndex | None = None,
    settle: bool = False,
    progress: bool | Progress | None = None,
) -> RockingEnsemble: ...
def run_ensemble(
    sliders: AnySliders | Blocks | Carts,
    motions: AnyMotions,
    *,
    members: SupportsIndex,
    seed: SupportsIndex,
    first_member: SupportsIndex = 0,
    threads: SupportsIndex | None = None,
    dt: float | None = None,
    settle: bool = False,
    contact: str | None = None,
    velocity_spectrum: bool = True,
    ground_acceleration: bool = False,
    walls: Walls | None = None,
    progress: bool | Progress | None = None,
    executor: Executor | None = None,
    checkpoint: str | os.PathLike[str] | None = None,
    checkpoint_every: float = 30.0,
) -> Ensemble | RockingEnsemble | CartEnsemble:
    """Simulate many members and compute statistics of their responses.

    x'' + resist sgn(x') + c x' + wn^2 x = -n(t), from rest at x = 0; thesis 4.4, 5.4. A member is a
    slider and a ground motion n(t), determined by seed and member number; each is solved as by
    `integrate`.

    Parameters
    ----------
    sliders : Slider, PlanarSlider, friction law, structure, a list of these, Drawn, Random, ...
        A law alone is a slider without spring and damper. From a list of m sliders, member i takes
        number i modulo m; from `Drawn(list)`, a random one. `Random` has random parameters. For
        your own source see `stickslip.ensemble.SliderSource`. With `PlanarSlider` all members slide
        in the plane, under ground motions with a transverse component, and statistics are those of
        vectors (see `Ensemble`). With `IsolatedStructure`, `EquipmentOnFloor` or `FlexibleSlope`
        all members are structures with the same number of floors: statistics are those of the
        sliding interface, and of the peaks on the floors. A structure slides without friction
        where it would lose contact.
    motions : GaussianExcitation, PoissonPulses, WithTransverse, WithVertical, GroundMotion, ...
        A random source, `WithVertical` also with a vertical component, `WithTransverse` with a
        second horizontal one, which sliders on one axis do not feel; or a record, a list of records
        or `Drawn`. Records may differ in length and time step: from a list of n, member i takes
        number i modulo n; from `Drawn(list)`, a random one. For your own source see
        `stickslip.ensemble.Excitation`. If durations differ, there are no statistics by time:
        `Ensemble.time` is empty.
    members : int
        Number of members, at least 1; at least 2 for standard errors.
    seed : int
        From 0 to 2^64 - 1.
    first_member : int, optional
        Number of the first member, a multiple of `Ensemble.block`, which is 64 unless the motions
        are long. Default 0.
    threads : int, optional
        Maximum number of threads, at least 1; default: all cores.
    dt : float, optional
        Time step of the statistics [s], a multiple of the step of the motions. Default: that step,
        or 1/512 of the duration if they have none in common. ValueError if durations differ.
    settle : bool, optional
        Continue each member under zero ground acceleration until the slider comes to rest, so that
        peaks and residuals are final. A slider without friction never does: ConvergenceError.
    contact : 'flight' or 'clipped', optional
        What sliders do when they lose contact with the ground, see `integrate`; default: 'flight'.
        Structures are always clipped: ValueError for 'flight'.
    velocity_spectrum : bool, optional
        Also estimate the spectral density of the velocity, if durations are equal: one FFT for each
        member. Ignored for sliders in the plane.
    ground_acceleration : bool, optional
        Also compute mean and variance of the ground acceleration by time, if durations are equal;
        this makes each motion a second time. Not with sliders in the plane.
    walls : sequence, optional
        With carts, walls whose clearance is asked, see `integrate`.
    progress : bool or callable, optional
        None: a bar of tqdm on stderr once the run has taken two seconds, if stderr is a terminal or
        a notebook. True: a bar from the start, anywhere. False: none. A callable gets the numbers
        of members done and in total, about ten times a second.
    executor : concurrent.futures.Executor, optional
        Where to run, with one thread for each part: a ProcessPoolExecutor, Dask's
        `Client.get_executor()`, mpi4py's MPIPoolExecutor. It is not shut down. Parts start small
        and grow until they take a second.
    checkpoint : path-like, optional
        A file that saves progress: written every `checkpoint_every` seconds, at the end, and when
        the run is interrupted. If it exists, the run resumes from it. If it cannot be written
        during the run, as on a full disk, the run warns once (RuntimeWarning), continues and
        retries.
    checkpoint_every : float, optional
        Time between checkpoints [s], at least 0; default 30.

    Returns
    -------
    Ensemble
        Identical to the last bit for any threads, executor and parts, and for a resumed run. With
        a `SlenderBlock` or a `RockingBlock`, a list of them or a `Random` that makes them, a
        `RockingEnsemble`, of probabilities of overturning; with a `Cart`, a list of them or
        `Cart.with_random_headings`, a `CartEnsemble`; `dt`, `contact`, `velocity_spectrum`,
        `ground_acceleration`, `executor` and `checkpoint` are then refused.

    Raises
    ------
    ValueError
        A value out of range; parameters of `Random` that the law rejects (names the member and the
        value); an empty list; ground motions of which some, but not all, are known to point up or
        down; sliders in the plane with `ground_acceleration`, or under a ground motion without a
        transverse component (names the member); a checkpoint that is damaged, of another
        configuration (names the difference), or with members outside the run; structures with
        different numbers of floors.
    TypeError
        An argument of the wrong type.
    OverflowError
        Displacements or velocities beyond 1e34 [m, m/s], whose statistics could leave the range of
        doubles; names the member or block.
    ConvergenceError
        A member does not settle; names it.
    EnsembleError
        A part failed in the executor, and parts that had not begun are canceled; or the checkpoint
        could not be written when the run ended or was interrupted. `partial` has the members that
        are done.
    OSError
        Before the run: the checkpoint cannot be read, or is not a writable regular file.
    KeyboardInterrupt
        Within a second of Ctrl-C.

    Warns
    -----
    PlausibilityWarning
        No member of a run under records slips, but some would if the accelerations were in g.

    Notes
    -----
    Times on one thread, including motions and statistics (2.5 GHz, AVX2). Under Gaussian
    excitation: 6 to 7 ns per sample for Coulomb friction without a spring, 9 for spring and damper
    without friction, 70 for casters. Under pulses: 10 ns per step for Coulomb friction. The
    velocity spectrum: 2 ns per sample. Other sliders, lists, random sliders and vertical motion: as
    for `integrate`, plus some 10 ns; in the plane 1 to 2 us per sample of sliding. Memory: 16 bytes
    per member, and 1 kB per thread and time of the statistics; above 2^24 members, peaks are
    counted in bins. A call takes 0.1 ms and copies a list of records; so does each part on an
    executor.

    References
    ----------
    Thesis 4.4, 5.4; P. Pebay, Formulas for robust, one-pass parallel computation of covariances and
    arbitrary-order statistical moments, SAND2008-6212 (2008).
    """
    from ..carts.ensemble import run_carts
    from ..rocking.ensemble import run_blocks
    from ..runs.outcomes import SYSTEMS, first_of

    total = whole_number(members, "run_ensemble: members", 1)
    first = whole_number(first_member, "run_ensemble: first_member", 0)
    count = 0 if threads is None else whole_number(threads, "run_ensemble: threads", 1, 2**16)
    check_executor("run_ensemble", executor, None if threads is None else count)
    key = whole_number(seed, "run_ensemble: seed", 0)
    if isinstance(one := first_of(sliders, key, first), SYSTEMS):
        carts = isinstance(one, Cart)
        for name, given in (
            ("dt", dt is not None),
            ("contact", contact is not None),
            ("velocity_spectrum", not velocity_spectrum),
            ("ground_acceleration", ground_acceleration),
            ("executor", executor is not None),
            ("checkpoint", checkpoint is not None),
            ("walls", walls is not None and not carts),
        ):
            if given:
                to = "carts" if carts else "blocks that rock"
                raise ValueError(f"run_ensemble: {name} does not apply to {to}")
        how: dict[str, Any] = {"members": total, "first_member": first, "seed": key}
        how |= {"settle": settle, "threads": count}
        with shown(progress, "run_ensemble", "member") as show:
            if carts:
                return run_carts(sliders, motions, walls=walls, show=show, **how)
            return run_blocks(sliders, motions, show=show, **how)
    if walls is not None:
        raise ValueError("run_ensemble: walls are for carts")
    options = {
        "seed": key,
        "dt": 0.0 if dt is None else _positive("dt", dt),
        "settle": settle,
        "contact": contact,
        "velocity_spectrum": velocity_spectrum,
        "ground_acceleration": ground_acceleration,
    }
    sliders = cast("AnySliders", sliders)
    if isinstance(motions, Sequence):
        records = [motion for motion in motions if isinstance(motion, GroundMotion)]
        check_directions(records, "run_ensemble")
    keeper = Checkpoint(checkpoint, checkpoint_every)
    start = keeper.load(range(first, first + total))
    with shown(progress, "run_ensemble", "member") as show:
        try:
            if executor is None:
                whole = _run_here(
                    sliders, motions, options, first, total, count, start, show, keeper
                )
            else:
                parts = Parts(executor, sliders, motions, options, first, total, start, keeper)
                whole = parts.run(show)
        except ValueError as error:
            if start is None:
                raise
            raise ValueError(f"run_ensemble: with checkpoint '{checkpoint}': {error}") from error
    keeper.save(whole)
    if whole.members <= 2**20 and not whole.has_floors and not whole.peak.any():
        warn_of_units("run_ensemble", sliders, motions, options["seed"])
    return whole


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
    def report(done: int, total: int, so_far: Callable[[], Ensemble]) -> None:
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
        progress=report,
        interrupted=interrupted,
        **options,
    )
