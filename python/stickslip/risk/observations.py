"""The responses of a sweep by intensity measure, record and draw, for fits of fragility."""

from __future__ import annotations

import re
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from .._core import GroundMotion, to_vector
from .._numbers import real
from ..carts.sweep import CartTable
from ..motions.intensity import DIRECTIONS, LEVEL_UNITS, level_of
from ..rocking.sweep import RockingTable
from ..sweeps.table import SweepTable

__all__ = [
    "DemandTable",
    "Event",
    "Measure",
    "Observations",
    "impact",
    "measured",
    "observe",
    "overturning",
    "records_of",
]


class Event(Enum):
    """An event whose probability a fragility curve gives, in place of a threshold."""

    impact = "impact"
    overturning = "overturning"

    def __repr__(self) -> str:
        return self.value


impact = Event.impact
overturning = Event.overturning

# Columns of numbers that no displacement grows with.
_NO_INTENSITIES = ("year", "stripe", "factor", "sa_period", "latitude", "longitude", "dt")

_FUNCTION = "function of the motion"
_SPECTRAL = re.compile(r"sa(?:_g)?\(\s*(\d*\.?\d+(?:e-?\d+)?)\s*s?\s*\)", re.IGNORECASE)

DemandTable: TypeAlias = SweepTable | RockingTable | CartTable
Measure: TypeAlias = str | Callable[[GroundMotion], float]


@dataclass(frozen=True, eq=False)
class Observations:
    """Responses, and what a fit needs to know about them.

    Attributes
    ----------
    im : ndarray, shape (M,)
        Intensity measure of each motion, positive.
    im_name, im_unit, im_directions : str
    record : ndarray of int, shape (M,)
        Number of the record of each motion, from 0 to R - 1.
    demand : ndarray, shape (J, M, P)
        Of each draw, motion and polarity, in `unit`: NaN for failures, infinite for a block that
        overturns. With `impact` 1 for a response that hits a stop or a wall, otherwise 0; with
        `overturning` for a block that overturns.
    unit : str
    thresholds : tuple of float or Event
    """

    im: NDArray[np.float64]
    im_name: str
    im_unit: str
    im_period: float | None
    im_directions: str
    record: NDArray[np.intp]
    demand: NDArray[np.float64]
    unit: str
    thresholds: tuple[float | Event, ...]

    @property
    def levels(self) -> NDArray[np.float64]:
        """Values of which a response exceeds the threshold if it lies above."""
        return np.array([0.5 if isinstance(one, Event) else one for one in self.thresholds])

    @property
    def labels(self) -> tuple[str, ...]:
        """The thresholds as text."""
        return tuple(
            one.value if isinstance(one, Event) else f"{one:.6g} {self.unit}"
            for one in self.thresholds
        )


class Measured(NamedTuple):
    """An intensity measure of each motion."""

    values: NDArray[np.float64]
    name: str
    unit: str
    period: float | None = None
    directions: str = ""  # over which it is taken; unknown of columns and functions of users


def measured(table: DemandTable, im: Measure, who: str) -> Measured:
    """The intensity measure of each motion.

    Raises
    ------
    ValueError
        A measure that the table lacks, or that is not positive and finite for each motion.
    """
    if callable(im):
        found = _by_function(table, im, who)
    elif isinstance(im, str):
        found = _by_name(table, im, who)
    else:
        raise TypeError(
            f"{who}: im must be the name of a column or a function of a motion, got"
            f" {type(im).__name__}"
        )
    wrong = np.flatnonzero(~(np.isfinite(found.values) & (found.values > 0)))
    if wrong.size:
        raise ValueError(
            f"{who}: {found.name} must be positive and finite for each motion, got"
            f" {found.values[wrong[0]]:g} for '{table.records[wrong[0]]}'"
        )
    stripe = _numbers(table, "stripe")
    if stripe is not None and np.allclose(found.values, stripe, rtol=1e-9, atol=0):
        return found._replace(values=stripe)  # without the round-off of scaling
    return found


def _by_function(table: DemandTable, im: Callable[[GroundMotion], float], who: str) -> Measured:
    if not table.motions:
        raise ValueError(
            f"{who}: a function of a motion needs the ground motions, which a table from a file"
            " lacks; give the suite a column before the sweep: suite.with_metadata({'sa': ...})"
        )
    name = getattr(im, "__name__", "<lambda>")
    values = np.array([real(im(motion), f"{who}: im of a motion") for motion in table.motions])
    return Measured(values, _FUNCTION if name == "<lambda>" else name, "")


def _by_name(table: DemandTable, im: str, who: str) -> Measured:
    spectral = _SPECTRAL.fullmatch(im)
    name, period = ("sa_g", float(spectral[1])) if spectral else (im, None)
    unit = LEVEL_UNITS.get(name, "")
    striped = _striped(table)
    if striped is not None and name == striped.name and period in (None, striped.period):
        return striped
    column = None if spectral else _numbers(table, name)
    if name != "pga_g" and column is not None:
        return Measured(column, name, unit, _period(table, name))
    directions = _directions(table)
    if name == "pga_g" and column is not None and directions == "axis":
        return Measured(column, name, unit, None, directions)
    if name in LEVEL_UNITS and (name != "sa_g" or spectral) and table.motions:
        values = np.array([level_of(m, name, period, 0.05, directions) for m in table.motions])
        return Measured(values, name, unit, period, directions)
    if name == "pga_g" and column is not None:
        raise ValueError(
            f"{who}: the {directions} of pga_g needs the ground motions, which a table from a file"
            " lacks; scale pairs by stripes, or give the suite a column before the sweep:"
            " suite.with_metadata({'pga': ...})"
        )
    numbers = [n for n in table.metadata if n not in _NO_INTENSITIES]
    numbers = [n for n in numbers if _numbers(table, n) is not None]
    if table.motions:
        numbers += [n for n in LEVEL_UNITS if n != "sa_g" and n not in numbers] + ["sa(period)"]
    raise ValueError(
        f"{who}: im must be a column with numbers, which '{im}' is not, or a function of a motion;"
        f" the table has {', '.join(numbers) or 'none'}"
    )


def _numbers(table: DemandTable, name: str) -> NDArray[np.float64] | None:
    """A column of numbers, or None."""
    column = table.metadata.get(name)
    return None if column is None or column.dtype.kind not in "iuf" else np.array(column, float)


def _period(table: DemandTable, name: str) -> float | None:
    """The period of a column, which stripes of pseudo-accelerations state."""
    at = _numbers(table, "sa_period") if name == "sa_g" else None
    return None if at is None else float(at[0])


def _directions(table: DemandTable) -> str:
    """What the measures of the motions are of: those of stripes, otherwise RotD50 in the plane."""
    stated = table.metadata.get("directions")
    if stated is not None:
        return next((one for one in stated.tolist() if one in DIRECTIONS), "axis")
    pairs = not table.motions or any(m.transverse is not None for m in table.motions)
    return "rotd50" if table.planar and pairs else "axis"


def _striped(table: DemandTable) -> Measured | None:
    """The measure of which stripes are levels, or None."""
    stripe = _numbers(table, "stripe")
    if stripe is None:
        return None
    for name in ("pgv", "arias", "sa_g"):
        if np.array_equal(stripe, table.metadata.get(name, ())):
            about = (LEVEL_UNITS[name], _period(table, name), _directions(table))
            return Measured(stripe, name, *about)
    if "directions" in table.metadata:
        return Measured(stripe, "pga_g", LEVEL_UNITS["pga_g"], None, _directions(table))
    return None  # a column `pga_g` holds it


def records_of(table: DemandTable) -> NDArray[np.intp]:
    """The number of the record of each motion, by the column `record` if there is one."""
    names = table.metadata.get("record")
    if names is None:
        return np.arange(len(table.records))
    return np.unique(names, return_inverse=True)[1].reshape(-1)


def observe(
    table: DemandTable,
    im: Measure,
    thresholds: float | Event | Sequence[float | Event],
    quantity: str,
    who: str,
) -> Observations:
    """The responses of a table.

    Raises
    ------
    ValueError
        An intensity measure, thresholds or a quantity that cannot be used.
    """
    found = measured(table, im, who)
    given: tuple[Any, ...] = (
        (thresholds,)
        if isinstance(thresholds, Event) or np.ndim(thresholds) == 0  # type: ignore[arg-type]
        else tuple(thresholds)  # type: ignore[arg-type]
    )
    if not given:
        raise ValueError(f"{who}: needs at least one threshold, got an empty list")
    if any(isinstance(one, Event) for one in given):
        if len(given) > 1:
            raise ValueError(f"{who}: {given[0]!r} is a threshold on its own, got {len(given)}")
        limits: tuple[float | Event, ...] = given
        unit = ""
        response = (_fell if given[0] is overturning else _hit)(table, who)
    else:
        limits = tuple(to_vector(given, f"{who}: thresholds").tolist())
        name, unit = _quantity(table, quantity, who)
        response = np.abs(_of_one_scale(table, getattr(table, name), who))
        _check_thresholds(table, limits, quantity, unit, who)
    failed = int(np.isnan(response).sum())
    if failed == response.size:
        raise ValueError(f"{who}: all {failed} responses failed")
    if failed:
        warnings.warn(
            f"{who}: {failed} of {response.size} responses failed and are left out",
            RuntimeWarning,
            stacklevel=3,
        )
    return Observations(
        im=found.values,
        im_name=found.name,
        im_unit=found.unit,
        im_period=found.period,
        im_directions=found.directions,
        record=records_of(table),
        demand=response,
        unit=unit,
        thresholds=limits,
    )


# What a table holds that thresholds may be of, by the name of the quantity: its attribute and unit.
_SLIDING = {name: (name, "m") for name in ("peak", "residual", "sliding_distance")}
_ROCKING = {"peak": ("peak_rotation_ratio", "alpha")}
_ROLLING = {"peak": ("peak", "m"), "peak_outline": ("peak_outline", "m")}


def _quantity(table: DemandTable, quantity: str, who: str) -> tuple[str, str]:
    """The attribute of a table, and its unit."""
    known = _SLIDING
    if not isinstance(table, SweepTable):
        known = _ROCKING if isinstance(table, RockingTable) else _ROLLING
    if quantity not in known:
        names = ", ".join(map(repr, known))
        raise ValueError(f"{who}: quantity must be one of {names}, got {quantity!r}")
    return known[quantity]


def _of_one_scale(table: DemandTable, values: NDArray[Any], who: str) -> NDArray[Any]:
    """Values of shape (draws, motions, polarities, ...)."""
    if isinstance(table, SweepTable):
        return values
    if len(table.scale) != 1:
        raise ValueError(
            f"{who}: needs a sweep with one scale, got {len(table.scale)}; scale the records:"
            " suite.stripes(pga_g=[0.1, 0.2, 0.4])"
        )
    return values[:, :, 0]


def _fell(table: DemandTable, who: str) -> NDArray[np.float64]:
    """1 for each response that overturns, 0 for the others, NaN for failures."""
    if not isinstance(table, RockingTable):
        raise ValueError(f"{who}: overturning needs a sweep of blocks that rock")
    fell = np.where(np.isnan(table.peak_rotation), np.nan, table.overturned != 0)
    return _of_one_scale(table, fell, who)


def _hit(table: DemandTable, who: str) -> NDArray[np.float64]:
    """1 for each response that hits a stop or a wall, 0 for the others, NaN for failures."""
    if isinstance(table, RockingTable):
        raise ValueError(
            f"{who}: a block has no stop: thresholds are of |theta|/alpha, or ss.overturning"
        )
    if isinstance(table, CartTable):
        if not len(table.walls):
            raise ValueError(f"{who}: impact needs a sweep of carts with walls, and it has none")
        reached = np.isfinite(table.hit_time).any(axis=-1)
        return _of_one_scale(table, np.where(np.isnan(table.peak), np.nan, reached), who)
    without = int((~np.isfinite(table.stop_distance)).sum())
    if without == table.stop_distance.size:
        raise ValueError(f"{who}: impact needs sliders with stops, and none has any")
    if without:
        raise ValueError(
            f"{who}: impact needs sliders with stops, and {without} of {table.stop_distance.size}"
            " have none: leave them out of the sweep"
        )
    if table.planar:
        hit = table.impacts > 0
    else:
        hit = (table.impacts_forward > 0) | (table.impacts_backward > 0)
    return np.where(np.isnan(table.peak), np.nan, hit.astype(float))


def _check_thresholds(
    table: DemandTable, thresholds: tuple[Any, ...], quantity: str, unit: str, who: str
) -> None:
    for one in thresholds:
        if not (np.isfinite(one) and one > 0):
            raise ValueError(f"{who}: thresholds must be positive and finite, got {one:g} {unit}")
    if np.any(np.diff(thresholds) <= 0):
        raise ValueError(f"{who}: thresholds must increase, got {', '.join(map(str, thresholds))}")
    if not isinstance(table, SweepTable):
        return
    nearest = table.stop_distance.min()
    if quantity != "sliding_distance" and thresholds[-1] >= nearest:
        raise ValueError(
            f"{who}: no displacement exceeds {thresholds[-1]:g} m, because a stop is at"
            f" {nearest:g} m; thresholds=ss.impact is the probability of hitting it"
        )
