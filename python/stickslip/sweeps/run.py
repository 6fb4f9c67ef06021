"""`sweep`, on threads or on any executor."""

from __future__ import annotations

import math
import operator
import os
import time
import warnings
from collections.abc import Iterable, Sequence
from concurrent.futures import Executor
from typing import Any, Literal, SupportsIndex, overload

import numpy as np
from numpy.typing import ArrayLike

from .. import _core
from .._core import (
    Cart,
    EquipmentOnFloor,
    FlexibleSlope,
    FrictionLaw,
    GroundMotion,
    IsolatedStructure,
    PlanarSlider,
    RockingBlock,
    SlenderBlock,
    Slider,
)
from .._units import warn_of_units
from ..carts.sweep import CartTable, Walls, sweep_carts
from ..ensemble.random_headings import Carts
from ..ensemble.random_slider import Random
from ..ensemble.sources import check_directions
from ..motions.suite import Suite
from ..rocking.sweep import AnyBlock, RockingTable, sweep_blocks
from ..runs import parts
from ..runs.outcomes import SYSTEMS, first_of, same_kind
from ..runs.progress import Progress, shown
from .checkpoint import Checkpoint
from .parameter_grid import AnySwept, Grid
from .table import POLARITIES, SweepTable, parameters_of

Polarity = Literal["both", "recorded", "reversed"]

_STRUCTURES = (IsolatedStructure, EquipmentOnFloor, FlexibleSlope)
_SLIDERS = (*_STRUCTURES, PlanarSlider, Slider, FrictionLaw)
_PARTS = 64  # number of parts of the records for an executor


@overload
def sweep(  # type: ignore[overload-overlap]
    sliders: Carts,
    motions: GroundMotion | Sequence[GroundMotion],
    *,
    scale: ArrayLike | None = None,
    walls: Walls | None = None,
    members: SupportsIndex | None = None,
    seed: SupportsIndex | None = None,
    stratified: bool = False,
    polarity: Polarity = "both",
    settle: bool = False,
    threads: SupportsIndex | None = None,
    progress: bool | Progress | None = None,
) -> CartTable: ...
@overload
def sweep(
    sliders: AnySwept | Sequence[AnySwept] | Random,
    motions: GroundMotion | Sequence[GroundMotion],
    *,
    members: SupportsIndex | None = None,
    seed: SupportsIndex | None = None,
    stratified: bool = False,
    polarity: Polarity = "both",
    settle: bool = False,
    contact: Literal["flight", "clipped"] | None = None,
    threads: SupportsIndex | None = None,
    progress: bool | Progress | None = None,
    executor: Executor | None = None,
    checkpoint: str | os.PathLike[str] | None = None,
    checkpoint_every: float = 30.0,
) -> SweepTable: ...
@overload
def sweep(
    sliders: AnyBlock | Sequence[SlenderBlock] | Sequence[RockingBlock],
    motions: GroundMotion | Sequence[GroundMotion],
    *,
    scale: ArrayLike | None = None,
    polarity: Polarity = "both",
    settle: bool = False,
    threads: SupportsIndex | None = None,
    progress: bool | Progress | None = None,
) -> RockingTable: ...
def sweep(
    sliders: AnySwept
    | AnyBlock
    | Carts
    | Sequence[AnySwept]
    | Sequence[SlenderBlock]
    | Sequence[RockingBlock]
    | Random,
    motions: GroundMotion | Sequence[GroundMotion],
    *,
    scale: ArrayLike | None = None,
    walls: Walls | None = None,
    members: SupportsIndex | None = None,
    seed: SupportsIndex | None = None,
    stratified: bool = False,
    polarity: Polarity = "both",
    settle: bool = False,
    contact: Literal["flight", "clipped"] | None = None,
    threads: SupportsIndex | None = None,
    progress: bool | Progress | None = None,
    executor: Executor | None = None,
    checkpoint: str | os.PathLike[str] | None = None,
    checkpoint_every: float = 30.0,
) -> SweepTable | RockingTable | CartTable:
    """Integrate many sliders under many ground motions, from rest at x = 0.

    x'' + resist sgn(x') + c x' + wn^2 x = -n(t), thesis (4.51) to (4.53), (2.44), (2.50), (4.2);
    each combination is solved as by `integrate`. Sliders in the plane start from rest at r = 0.
    Structures move, too: x is that of their interface.

    Parameters
    ----------
    sliders : Slider, friction law, PlanarSlider, structure, list of these, or Random
        Sliders with any laws, all on one axis, all in the plane, or all structures
        (`IsolatedStructure`, `EquipmentOnFloor`, `FlexibleSlope`); `grid` makes lists. Of a
        `Random`, `members` sliders are drawn, the same for every record.
    motions : GroundMotion, Suite or list of GroundMotion
        Records, which may differ in length and time step. In the plane they need a transverse
        component, as `read_station` and ``Suite.read(..., stations=True)`` give them.
    scale : float or array_like, optional
        With blocks that rock and carts, factors of the ground motions, finite and at least 0;
        default: 1.
    walls : sequence, optional
        With carts, walls whose clearance is asked, see `integrate`.
    members, seed : int, optional
        Number of sliders to draw from a `Random`, at least 1, and the seed, from 0 to 2^64 - 1;
        both are needed with a `Random`. Slider i equals ``sliders.sample(seed=seed, member=i)``.
    stratified : bool, optional
        Draw a Latin hypercube from a `Random`; see `Random.draw`.
    polarity : {'both', 'recorded', 'reversed'}
        Both n(t) and -n(t), n(t) only, or -n(t) only. In the plane -n(t) reverses both horizontal
        components; on level ground the response is then the mirror image, computed once.
    settle : bool, optional
        Continue under zero ground acceleration after each record until the slider rests, so that
        residuals are final.
    contact : {'flight', 'clipped'}, optional
        What a slider does when it loses contact with the ground, see `integrate`; default:
        'flight'. Structures are always clipped: ValueError for 'flight'.
    threads : int, optional
        Maximum number of threads, at least 1; default: all cores.
    progress : bool or callable, optional
        None: a bar of tqdm on stderr once the run has taken two seconds, if stderr is a terminal or
        a notebook. True: a bar from the start, anywhere. False: none. A callable gets the numbers
        of combinations done and in total, about ten times a second.
    executor : concurrent.futures.Executor, optional
        Where to run, with one thread for each part of the records: a ProcessPoolExecutor, Dask's
        `Client.get_executor()`, mpi4py's MPIPoolExecutor. It is not shut down.
    checkpoint : path-like, optional
        A file that saves progress: written every `checkpoint_every` seconds, at the end, and when
        the run is interrupted. If it exists, the run resumes from it.
    checkpoint_every : float, optional
        Time between checkpoints [s], at least 0; default 30.

    Returns
    -------
    SweepTable
        Arrays over [slider, record, polarity]; identical to the last bit for any threads, executor
        and parts, and for a resumed run. With a `SlenderBlock` or a `RockingBlock`, a list of them
        or a `Random` that makes them, a `RockingTable` over [block, record, scale, polarity]; with
        a `Cart`, likewise a `CartTable`; `contact`, `executor` and `checkpoint` are then refused.

    Raises
    ------
    ValueError
        An empty list; ground motions of which some, but not all, are known to point up or down; a
        value out of range; a checkpoint that is damaged or of another sweep.
    TypeError
        An argument of the wrong type; sliders on one axis, sliders in the plane and structures
        together.
    SweepError
        A part failed in the executor; or the checkpoint could not be written at the end. `partial`
        has the results so far.
    OSError
        Before the run: the checkpoint cannot be read, or is not a writable regular file.
    KeyboardInterrupt
        Within a second of Ctrl-C.

    Warns
    -----
    RuntimeWarning
        Combinations failed: a slider that does not come to rest, a motion beyond the range of
        doubles, a slider in the plane under a motion without a transverse component. They are NaN,
        and `SweepTable.failures` says why. Other combinations continue.
    PlausibilityWarning
        No combination slips, but some would if the accelerations were in g.

    Notes
    -----
    For Coulomb friction, with or without a higher static friction, without spring, damper and
    stops, under records with even steps, each vector lane integrates one slip level, exact to
    round-off, 1e-13 of the scale of x; this takes 0.05 to 0.3 ns per sample and slider, where
    `integrate` takes 12 to 40. Slopes and vertical motion take half as long again. On level ground
    without vertical motion, other sliders on friction that is constant or linear in the distance
    slid, with spring, damper and stops, and pendulums with several surfaces, also take vector
    lanes, in which only segments with events are integrated one by one: 1 to 7 ns, to 1e-12 of the
    scale of x, unless the motion amplifies round-off, as many bounces do. All other combinations
    use `integrate`, one by one on all threads, as do those in which the normal force reaches zero,
    and sliders in the plane. A slider that resists equally in both directions is integrated once
    for both polarities. Releases the interpreter lock.

    A structure whose interface is stuck moves as if it could not slide, but for the decay of what
    its slips have left. Structures that differ in their slider alone, and slopes that differ in
    `ky_g` alone, share that motion, with bounds of its demand: only slips are integrated one by
    one, and results equal those of `integrate` to 1e-12 of the largest displacement, with
    stops to 1e-9. This needs even steps, classical damping and equipment without mass.
    """
    given = _drawn(sliders, members, seed, stratified)
    other = isinstance(first_of(given), SYSTEMS)
    these: list[Any] = _systems(given) if other else _sliders(given)
    if not isinstance(motions, (GroundMotion, Iterable)):
        raise TypeError(
            "sweep: motions must be a GroundMotion, a Suite or a list of GroundMotion, got"
            f" {type(motions).__name__}"
        )
    those = [motions] if isinstance(motions, GroundMotion) else list(motions)
    if polarity not in ("both", *POLARITIES):
        raise ValueError(
            f"sweep: polarity must be 'recorded', 'reversed' or 'both', got {polarity!r}"
        )
    count = 0 if threads is None else operator.index(threads)
    if threads is not None and not 1 <= count <= 2**16:
        raise ValueError(f"sweep: threads must be from 1 to 65536, got {count}")
    parts.check_executor("sweep", executor, None if threads is None else count)
    for kind, listed in (("slider", these), ("ground motion", those)):
        if not listed:
            raise ValueError(f"sweep: needs at least one {kind}, got an empty list")
    for i, motion in enumerate(those):
        if not isinstance(motion, GroundMotion):
            raise TypeError(
                f"sweep: motions[{i}] must be a GroundMotion, got {type(motion).__name__}"
            )
    check_directions(those, "sweep")
    signs = POLARITIES if polarity == "both" else (polarity,)
    varied = getattr(given, "parameters", {})
    if other:
        carts = isinstance(these[0], Cart)
        for name, value in (
            ("contact", contact),
            ("executor", executor),
            ("checkpoint", checkpoint),
            ("walls", None if carts else walls),
        ):
            if value is not None:
                to = "carts" if carts else "blocks that rock"
                raise ValueError(f"sweep: {name} does not apply to {to}")
        args = these, varied, those, _metadata(motions), scale, signs, settle, count
        with shown(progress, "sweep", "combination") as show:
            return sweep_carts(*args, show, walls) if carts else sweep_blocks(*args, show)
    if scale is not None:
        raise ValueError(
            "sweep: scale is for blocks that rock and carts; scale the motions: 2 * motion"
        )
    if walls is not None:
        raise ValueError("sweep: walls are for carts")
    contact = _core._contact_of(contact, "sweep", isinstance(these[0], _STRUCTURES))
    table = SweepTable.empty(
        sliders=[repr(s) for s in these],
        parameters=parameters_of(these, varied),
        records=[m.name or f"record {i}" for i, m in enumerate(those)],
        metadata=_metadata(motions),
        polarity=signs,
        settle=settle,
        contact=contact,
        has_stops=any(getattr(_interface(s), "stops", None) is not None for s in these),
        planar=isinstance(these[0], PlanarSlider),
    )
    how = {"polarity": polarity, "settle": settle, "contact": contact}
    with shown(progress, "sweep", "combination") as show:
        if executor is None and checkpoint is None:
            result = _core.sweep(these, those, threads=count, progress=show, **how)
            table.put(range(len(those)), result)
        else:
            keeper = Checkpoint(checkpoint, checkpoint_every, these, those, how)
            keeper.load(table)
            if executor is None:
                _run_here(these, those, how, count, table, keeper, show)
            else:
                _Parts(executor, these, those, how, table, keeper).run(show)
            keeper.save(table)
    table.motions = tuple(those)
    table.remark = _linear_remark(table, these)
    if table.failures:
        first = table.failures[0]
        warnings.warn(
            f"sweep: {len(table.failures)} of {table.peak.size} combinations failed and are NaN;"
            f" the first, slider {first.slider} under record {first.record} {first.polarity}:"
            f" {first.message}",
            RuntimeWarning,
            stacklevel=2,
        )
    elif not table.peak.any() and not isinstance(these[0], _STRUCTURES):
        table.remark = warn_of_units("sweep", these, those)
    return table


def _systems(given: Any) -> list[Any]:
    these = [given] if isinstance(given, SYSTEMS) else list(given)
    same_kind(these, "sweep")
    return these


def _interface(swept: AnySwept) -> Any:
    """What slides: the slider of a structure."""
    return getattr(swept, "slider", swept)


def _linear_remark(table: SweepTable, sliders: Sequence[AnySwept]) -> str:
    """`Response.remark` on the slider that leaves its linear range by the largest peak; or ''."""
    peaks = np.nan_to_num(table.peak).max(axis=(1, 2))
    found = {}
    for i, one in enumerate(sliders):
        if remark := _core._linear_remark(_interface(one), peaks[i]):
            found[i] = remark
    if not found:
        return ""
    worst = max(found, key=lambda i: peaks[i])
    return f"{len(found)} of {len(sliders)} sliders: as slider {worst}, {found[worst]}"


def _kind(swept: AnySwept) -> str:
    if isinstance(swept, _STRUCTURES):
        return "structures"
    return "in the plane" if isinstance(swept, PlanarSlider) else "on one axis"


def _metadata(motions: Any) -> dict[str, Any]:
    """The columns of a suite, with the PGA."""
    return {**motions.metadata, "pga_g": motions.pga_g} if isinstance(motions, Suite) else {}


def _drawn(
    sliders: Any, members: SupportsIndex | None, seed: SupportsIndex | None, stratified: bool
) -> Any:
    """The sliders, drawn if they are random."""
    if isinstance(sliders, Random):
        if members is None or seed is None:
            raise ValueError(
                "sweep: a Random needs members, the number of sliders to draw, and seed, as in"
                " members=100, seed=1"
            )
        return Grid(*sliders.draw(members, seed=seed, stratified=stratified))
    if members is not None or seed is not None or stratified:
        raise ValueError(
            f"sweep: members, seed and stratified are for a Random, got {type(sliders).__name__}"
        )
    return sliders


def _sliders(given: Any) -> list[AnySwept]:
    if isinstance(given, _SLIDERS):
        return [given]
    if not isinstance(given, Iterable):
        raise TypeError(
            "sweep: sliders must be a Slider, a friction law, a PlanarSlider, a structure, a list"
            f" or a Random, got {type(given).__name__}"
        )
    these = list(given)
    for i, one in enumerate(these):
        if not isinstance(one, _SLIDERS):
            raise TypeError(
                f"sweep: sliders[{i}] must be a Slider, friction law, PlanarSlider or structure,"
                f" got {type(one).__name__}"
            )
    kinds = [_kind(one) for one in these]
    if len(set(kinds)) > 1:
        odd = next(i for i, kind in enumerate(kinds) if kind != kinds[0])
        raise TypeError(
            "sweep: sliders must all move on one axis, all in the plane, or all be structures;"
            f" sliders[0] is of type {type(these[0]).__name__}, sliders[{odd}] of type"
            f" {type(these[odd]).__name__}; run two sweeps"
        )
    return Grid(these) if isinstance(given, Grid) else these


def _run_here(
    sliders: list[AnySwept],
    motions: list[GroundMotion],
    how: dict[str, Any],
    threads: int,
    table: SweepTable,
    keeper: Checkpoint,
    show: Progress,
) -> None:
    """Process the records in parts, which double until one takes half a second."""
    size = 1
    todo = [i for i in range(len(motions)) if not table.done[i]]
    try:
        while todo:
            part, todo = todo[:size], todo[size:]
            began = time.monotonic()
            result = _core.sweep(
                sliders, [motions[i] for i in part], threads=threads, progress=None, **how
            )
            table.put(part, result)
            show(_combinations(table), table.peak.size)
            keeper.save_if_due(lambda: table)
            if time.monotonic() - began < 0.5:
                size *= 2
    except BaseException:
        keeper.save(table)
        raise


def _combinations(table: SweepTable) -> int:
    return int(table.done.sum()) * (table.peak.size // len(table.records))


def _run_part(
    sliders: list[AnySwept], motions: list[GroundMotion], how: dict[str, Any]
) -> dict[str, Any]:
    """Run a part. A module function, so that it pickles."""
    return _core.sweep(sliders, motions, threads=1, progress=None, **how)


class _Parts(parts.Parts[SweepTable, dict[str, Any]]):
    """The records of a sweep, in a fixed number of parts."""

    def __init__(
        self,
        executor: Executor,
        sliders: list[AnySwept],
        motions: list[GroundMotion],
        how: dict[str, Any],
        table: SweepTable,
        keeper: Checkpoint,
    ) -> None:
        super().__init__(executor, table, keeper)
        self.what = (sliders, motions, how)
        self.todo = [i for i in range(len(motions)) if not table.done[i]]

    def feed(self) -> None:
        sliders, motions, how = self.what
        todo, self.todo = self.todo, []
        size = max(1, math.ceil(len(todo) / _PARTS))
        for k in range(0, len(todo), size):
            part = todo[k : k + size]
            self.submit(part, _run_part, sliders, [motions[i] for i in part], how)

    def take(self, part: Sequence[int], result: dict[str, Any]) -> None:
        self.so_far.put(part, result)

    def progress(self) -> tuple[int, int]:
        return _combinations(self.so_far), self.so_far.peak.size
