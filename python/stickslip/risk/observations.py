"""The responses of a sweep by intensity measure, record and draw, for fits of fragility."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from .._core import GroundMotion, to_vector
from .._numbers import real
from ..motions.intensity import LEVEL_UNITS, level_of
from ..sweeps.table import SweepTable

__all__ = ["Event", "Measure", "Observations", "impact", "measured", "observe", "records_of"]


class Event(Enum):
    """An event whose probability a fragility curve gives, in place of a threshold."""

    impact = "impact"

    def __repr__(self) -> str:
        return self.value


impact = Event.impact

# Columns of numbers that no displacement grows with.
_NO_INTENSITIES = ("year", "stripe", "factor", "sa_period", "latitude", "longitude", "dt")

Measure: TypeAlias = str | Callable[[GroundMotion], float]


@dataclass(frozen=True, eq=False)
class Observations:
    """Responses, and what a fit needs to know about them.

    Attributes
    ----------
    im : ndarray, shape (M,)
        Intensity measure of each motion, positive.
    im_name, im_unit : str
    record : ndarray of int, shape (M,)
        Number of the record of each motion, from 0 to R - 1.
    displacement : ndarray, shape (J, M, P)
        Of each draw, motion and polarity [m]; NaN for failures. With `impact` 1 for a response that
        hits a stop, otherwise 0.
    thresholds : tuple of float or Event
    """

    im: NDArray[np.float64]
    im_name: str
    im_unit: str
    im_period: float | None
    record: NDArray[np.intp]
    displacement: NDArray[np.float64]
    thresholds: tuple[float | Event, ...]

    @property
    def levels(self) -> NDArray[np.float64]:
        """Values of which a response exceeds the threshold if it lies above."""
        return np.array([0.5 if isinstance(one, Event) else one for one in self.thresholds])

    @property
    def labels(self) -> tuple[str, ...]:
        """The thresholds as text."""
        return tuple(
            "impact" if isinstance(one, Event) else f"{one:.6g} m" for one in self.thresholds
        )


def measured(table: SweepTable, im: Measure, who: str) -> tuple[NDArray[np.float64], str, str]:
    """The intensity measure of each motion, its name and its unit.

    Raises
    ------
    ValueError
        A measure that the table lacks, or that is not positive and finite for each motion.
    """
    if not callable(im) and not isinstance(im, str):
        raise TypeError(
            f"{who}: im must be the name of a column or a function of a motion, got"
            f" {type(im).__name__}"
        )
    if callable(im):
        if not table.motions:
            raise ValueError(
                f"{who}: a function of a motion needs the ground motions, which a table from a file"
                " lacks; give the suite a column before the sweep: suite.with_metadata({'sa': ...})"
            )
        name = getattr(im, "__name__", "im")
        name, unit = ("im" if name == "<lambda>" else name), ""
        values = np.array([real(im(motion), f"{who}: im of a motion") for motion in table.motions])
    else:
        name, unit = str(im), LEVEL_UNITS.get(str(im), "")
        column = table.metadata.get(name)
        if column is not None and column.dtype.kind in "iuf":
            values = np.array(column, float)
        elif name in LEVEL_UNITS and name != "sa_g" and table.motions:
            values = np.array([level_of(motion, name) for motion in table.motions])
        else:
            numbers = [
                n
                for n, c in table.metadata.items()
                if c.dtype.kind in "iuf" and n not in _NO_INTENSITIES
            ]
            if table.motions:
                numbers += [n for n in LEVEL_UNITS if n != "sa_g" and n not in numbers]
            raise ValueError(
                f"{who}: im must be a column with numbers, which '{name}' is not, or a function of"
                f" a motion; the table has {', '.join(numbers) or 'none'}"
            )
    stripe = table.metadata.get("stripe")
    known = stripe is not None and stripe.dtype.kind in "iuf"
    if known and np.allclose(values, stripe, rtol=1e-9, atol=0):  # type: ignore[arg-type]
        values = np.array(stripe, float)  # without the round-off of scaling
    wrong = np.flatnonzero(~(np.isfinite(values) & (values > 0)))
    if wrong.size:
        raise ValueError(
            f"{who}: {name} must be positive and finite for each motion, got {values[wrong[0]]:g}"
            f" for '{table.records[wrong[0]]}'"
        )
    return values, name, unit


def records_of(table: SweepTable) -> NDArray[np.intp]:
    """The number of the record of each motion, by the column `record` if there is one."""
    names = table.metadata.get("record")
    if names is None:
        return np.arange(len(table.records))
    return np.unique(names, return_inverse=True)[1].reshape(-1)


def observe(
    table: SweepTable,
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
    values, name, unit = measured(table, im, who)
    period = table.metadata.get("sa_period") if name == "sa_g" else None
    given: tuple[Any, ...] = (
        (thresholds,)
        if isinstance(thresholds, Event) or np.ndim(thresholds) == 0  # type: ignore[arg-type]
        else tuple(thresholds)  # type: ignore[arg-type]
    )
    if not given:
        raise ValueError(f"{who}: needs at least one threshold, got an empty list")
    if any(isinstance(one, Event) for one in given):
        if len(given) > 1:
            raise ValueError(f"{who}: impact is a threshold on its own, got {len(given)}")
        limits: tuple[float | Event, ...] = given
        response = _hit(table, who)
    else:
        limits = tuple(to_vector(given, f"{who}: thresholds").tolist())
        response = np.abs(getattr(table, _quantity(table, quantity, who)))
        _check_thresholds(table, limits, quantity, who)
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
        im=values,
        im_name=name,
        im_unit=unit,
        im_period=None if period is None else float(period[0]),
        record=records_of(table),
        displacement=response,
        thresholds=limits,
    )


def _quantity(table: SweepTable, quantity: str, who: str) -> str:
    if quantity not in ("peak", "residual", "sliding_distance"):
        raise ValueError(
            f"{who}: quantity must be 'peak', 'residual' or 'sliding_distance', got {quantity!r}"
        )
    return quantity


def _hit(table: SweepTable, who: str) -> NDArray[np.float64]:
    """1 for each response that hits a stop, 0 for the others, NaN for failures."""
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
    table: SweepTable, thresholds: tuple[Any, ...], quantity: str, who: str
) -> None:
    for one in thresholds:
        if not (np.isfinite(one) and one > 0):
            raise ValueError(f"{who}: a threshold must be positive and finite, got {one:g} m")
    if np.any(np.diff(thresholds) <= 0):
        raise ValueError(f"{who}: thresholds must increase, got {', '.join(map(str, thresholds))}")
    nearest = table.stop_distance.min()
    if quantity != "sliding_distance" and thresholds[-1] >= nearest:
        raise ValueError(
            f"{who}: no displacement exceeds {thresholds[-1]:g} m, because a stop is at"
            f" {nearest:g} m; thresholds=ss.impact is the probability of hitting it"
        )
