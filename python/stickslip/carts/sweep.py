"""Many carts under many ground motions and scales of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core
from .._core import Cart, GroundMotion
from .._tables import Columns
from ..runs.outcomes import OutcomeTable, sweep_outcomes
from ..runs.progress import Progress

Walls: TypeAlias = "Sequence[tuple[Sequence[float], Sequence[float]]]"  # points, directions

_UNITS = {
    "peak": "m",
    "peak_yaw": "rad",
    "peak_outline": "m",
    "residual": "m",
    "residual_yaw": "rad",
    "rests": "",
    "margin": "",
    "clearance": "m",
    "hit_time": "s",
    "hit_speed": "m/s",
}


def columns_of(outcomes: Any) -> tuple[dict[str, NDArray[Any]], dict[str, str]]:
    """The columns of results, one for each component and each wall, and their units."""
    columns: dict[str, NDArray[Any]] = {}
    units: dict[str, str] = {}
    for name, unit in _UNITS.items():
        values = getattr(outcomes, name)
        if values.ndim == outcomes.margin.ndim:
            found = {name: values}
        else:
            parts = ("axis", "transverse") if name == "residual" else range(values.shape[-1])
            found = {f"{name}_{part}": values[..., i] for i, part in enumerate(parts)}
        columns |= {column: part.ravel() for column, part in found.items()}
        if unit:
            units |= dict.fromkeys(found, unit)
    return columns, units


class CartFailure(NamedTuple):
    """A combination without a result, and why."""

    cart: int
    record: int
    scale: float
    polarity: str
    message: str


class CartTable(OutcomeTable):
    """What many carts did under many ground motions, as `sweep` returns it.

    Arrays have the shape (carts, records, scales, polarities). Where a combination failed, they are
    NaN and counts 0.

    Attributes
    ----------
    peak, peak_yaw, peak_outline : ndarray
        As of `CartResponse` [m], [rad], [m].
    residual : ndarray
        Displacement at the end [m], with a last axis of 2 components.
    residual_yaw : ndarray
        Change of the yaw at the end [rad].
    rests : ndarray of int
    margin : ndarray
        As of `CartResponse`.
    clearance, hit_time, hit_speed : ndarray
        As of `Clearance` [m], [s], [m/s], with a last axis over the walls; NaN without a hit.
    carts : tuple of Cart
    walls : tuple
    parameters : dict of ndarray
        By name, the parameters that `grid` varied or that were drawn, for each cart.
    records : tuple of str
        Names of the ground motions.
    metadata : dict of ndarray
        Columns of the suite, with a value for each record.
    scale : ndarray
        Factors of the ground motions.
    polarity : tuple of str
        'recorded', 'reversed', or both: the signs of both horizontal components.
    motions : tuple of GroundMotion
        The ground motions.
    settle : bool
        Whether each run continued until the cart came to rest.
    failures : tuple of CartFailure

    Notes
    -----
    Objects compare by content; they can be copied and pickled. Tables have a row for each
    combination: `cart` and its parameters, `record` and its metadata, `scale`, `polarity`, and the
    results.
    """

    planar = True
    _kind = "cart"
    _failure = CartFailure

    carts: tuple[Cart, ...]
    walls: Walls
    peak: NDArray[np.float64]
    peak_yaw: NDArray[np.float64]
    peak_outline: NDArray[np.float64]
    residual: NDArray[np.float64]
    residual_yaw: NDArray[np.float64]
    rests: NDArray[np.int64]
    margin: NDArray[np.float64]
    clearance: NDArray[np.float64]
    hit_time: NDArray[np.float64]
    hit_speed: NDArray[np.float64]

    def _table(self) -> tuple[Columns, Mapping[str, str]]:
        columns, units = columns_of(self)
        return self._axes() | columns, units

    def __repr__(self) -> str:
        text = f"<CartTable: {self._size()}"
        if not np.isnan(self.peak_outline).all():
            text += f"; peaks of the outline up to {np.nanmax(self.peak_outline):.3g} m"
        return text + ">"


def sweep_carts(
    carts: Sequence[Cart],
    parameters: Mapping[str, ArrayLike],
    motions: Sequence[GroundMotion],
    metadata: Mapping[str, ArrayLike],
    scale: ArrayLike | None,
    polarity: Sequence[str],
    settle: bool,
    threads: int,
    show: Progress | None,
    walls: Walls | None,
) -> CartTable:
    """The table of carts; see `stickslip.sweep`."""
    table = sweep_outcomes(
        CartTable,
        _core.sweep_carts,
        carts,
        parameters,
        motions,
        metadata,
        scale,
        polarity,
        settle,
        walls=walls or (),
        threads=threads,
        progress=show,
    )
    table.walls = tuple(walls or ())
    return table
