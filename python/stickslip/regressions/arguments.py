"""The arguments of regressions: names and units of the papers, checks, measures of records."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._core import (
    STANDARD_GRAVITY,
    GroundMotion,
    _check_unit,
    response_spectrum,
    strong_motion,
)
from .._numbers import reals
from ..motions.suite import Suite

__all__ = ["MEASURES", "OF_MOTION", "UNITS", "checked", "measured", "spectral"]

UNITS = {
    **dict.fromkeys(("ky", "pga", "Sa"), "g"),
    "pgv": "cm/s",
    "Ia": "m/s",
    **dict.fromkeys(("Ts", "Tm", "T"), "s"),
}

# Of a record, beside Sa, whose period the model sets.
MEASURES: dict[str, Callable[[Any], Any]] = {
    "pga": lambda measures: measures.peak_acceleration / STANDARD_GRAVITY,
    "pgv": lambda measures: 100 * measures.peak_velocity,
    "Ia": lambda measures: measures.arias_intensity,
    "Tm": lambda measures: measures.mean_period,
}

# A motion for which one of these is 0 moves nothing.
OF_MOTION = frozenset(("pga", "pgv", "Ia", "Sa"))

# In the table of plausible ranges.
_QUANTITIES = {
    "ky": "yield acceleration",
    **dict.fromkeys(("pga", "Sa"), "ground acceleration in g"),
    "pgv": "ground velocity in cm/s",
    "Ia": "Arias intensity",
}


def checked(who: str, given: dict[str, ArrayLike], stacklevel: int) -> dict[str, NDArray[Any]]:
    """The arguments as arrays; each positive and finite, Ts and measures of the motion also 0.

    Warns of other units.
    """
    arrays = {}
    for name, value in given.items():
        array = reals(value, f"{who}: {name}")
        or_zero = name == "Ts" or name in OF_MOTION
        wrong = ~np.isfinite(array) | ((array < 0) if or_zero else (array <= 0))
        if wrong.any():
            rule = "at least 0" if or_zero else "positive"
            unit = f" {UNITS[name]}" if name in UNITS else ""
            index = [int(i) for i in np.argwhere(wrong)[0]]
            where = f" at index {index[0] if len(index) == 1 else tuple(index)}" if index else ""
            reason = (
                ": a slope that yields at 0 or less fails without an earthquake"
                if name == "ky" and np.isfinite(array[wrong].flat[0])
                else ""
            )
            raise ValueError(
                f"{who}: {name} must be {rule} and finite, got"
                f" {array[wrong].flat[0]}{unit}{where}{reason}"
            )
        arrays[name] = array
    for name in filter(_QUANTITIES.get, arrays):
        _check_unit(_QUANTITIES[name], who, name, arrays[name].ravel(), stacklevel)
    try:
        np.broadcast_shapes(*(array.shape for array in arrays.values()))
    except ValueError:
        shapes = ", ".join(f"{name} {array.shape}" for name, array in arrays.items())
        raise ValueError(f"{who}: the arguments must broadcast, got the shapes {shapes}") from None
    return arrays


def measured(motion: GroundMotion | Suite, names: Iterable[str], dimensions: int) -> dict[str, Any]:
    """Intensity measures of a record; of a suite along a first axis, before `dimensions` others."""
    wanted = list(names)
    if not wanted:
        return {}
    measures: Any = strong_motion(motion)
    if isinstance(motion, GroundMotion):
        return {name: MEASURES[name](measures) for name in wanted}
    shape = (len(motion),) + (1,) * dimensions
    return {name: MEASURES[name](measures).reshape(shape) for name in wanted}


def spectral(
    motion: GroundMotion | Suite, period: NDArray[np.float64], dimensions: int
) -> NDArray[np.float64]:
    """Pseudo-acceleration at 5 % damping [g] at each period; 0 gives the PGA."""
    periods, places = np.unique(period, return_inverse=True)
    values = np.asarray(response_spectrum(motion, periods, 0.05).values) / STANDARD_GRAVITY
    found = values[..., places.reshape(period.shape)]
    if isinstance(motion, GroundMotion):
        return found
    return found.reshape((len(motion), *(1,) * (dimensions - period.ndim), *period.shape))
