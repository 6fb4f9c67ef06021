"""Spectra of the two horizontal components of a station, for all directions of the axis."""

from __future__ import annotations

import os
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._core import (
    CartResponse,
    GroundMotion,
    PlanarResponse,
    _PlanarFloorMotion,
    response_spectrum,
)
from .._numbers import real
from .._tabular import Tabular
from .tables import SPECTRUM_UNITS

__all__ = ["RotD", "rotd"]

_ANGLES = 180  # at steps of 1 degree; half a turn more gives the same magnitudes


class RotD(Tabular):
    """Percentiles of a spectrum over the direction of the axis, as `rotd` returns them.

    Attributes
    ----------
    kind : str
        Kind of the values, as for `response_spectrum`.
    periods : ndarray, shape (P,)
        Periods [s]; 0 is the peak ground acceleration.
    damping : float
        Ratio of critical damping.
    rotd00, rotd50, rotd100 : ndarray, shape (P,)
        Minimum, median and maximum over the angles [m/s^2, m/s or m].
    angle100 : ndarray, shape (P,)
        Angle of the maximum from the axis toward the transverse component [degrees].
    values : ndarray, shape (180, P)
        The spectrum at each angle: 0, 1, ..., 179 degrees.
    """

    def __init__(
        self, kind: str, periods: NDArray[Any], damping: float, values: NDArray[Any]
    ) -> None:
        self.kind, self.periods, self.damping, self.values = kind, periods, damping, values
        self.rotd00, self.rotd50, self.rotd100 = (self.percentile(p) for p in (0, 50, 100))
        self.angle100: NDArray[np.float64] = values.argmax(axis=0).astype(float)

    def percentile(self, nn: float) -> NDArray[np.float64]:
        """RotDnn: the percentile over the angles.

        Parameters
        ----------
        nn : float
            From 0 to 100.

        Returns
        -------
        ndarray, shape (P,)
        """
        found: NDArray[np.float64] = np.percentile(self.values, nn, axis=0)
        return found

    def __repr__(self) -> str:
        return f"<RotD: {self.kind}, {len(self.periods)} periods, damping {self.damping:g}>"

    def _table(self) -> tuple[Mapping[str, NDArray[Any]], Mapping[str, str]]:
        names = ("rotd00", "rotd50", "rotd100")
        columns = {"period": self.periods, **{name: getattr(self, name) for name in names}}
        units = {"period": "s", "angle100": "degrees"} | dict.fromkeys(
            names, SPECTRUM_UNITS[self.kind]
        )
        return {**columns, "angle100": self.angle100}, units


def rotd(
    station: GroundMotion | PlanarResponse | CartResponse,
    periods: ArrayLike = 0.0,
    damping: float = 0.05,
    *,
    kind: Literal[
        "pseudo_acceleration", "pseudo_velocity", "displacement", "velocity", "acceleration"
    ] = "pseudo_acceleration",
) -> RotD:
    """Compute RotD50, RotD100 and other percentiles of a spectrum over all horizontal directions.

    The two horizontal components are rotated in steps of 1 degree from 0 to 179 degrees; each
    period has its own distribution over the angles; RotDnn is its nn-th percentile (Boore 2010).

    Parameters
    ----------
    station : GroundMotion, PlanarResponse or CartResponse
        A ground motion with a `transverse` component, as `read_station` returns it. A response in
        the plane gives floor spectra: those of the sliding mass, from its absolute acceleration. So
        does that of a cart, of its center of mass.
    periods : float or array_like, shape (P,)
        Undamped natural periods [s], as for `response_spectrum`. The default, 0, gives the peak
        ground acceleration.
    damping : float, optional
        Ratio of critical damping, at least 0 and below 2.
    kind : str, optional
        As for `response_spectrum`.

    Returns
    -------
    RotD

    Raises
    ------
    ValueError
        A motion without a transverse component; a period, damping ratio or kind not allowed; a
        response that is truncated.

    Notes
    -----
    At each angle the spectrum is that of `response_spectrum`, a maximum in continuous time, to
    round-off. The maximum over all directions exceeds RotD100 by less than 0.004 %: where the
    response is largest it varies at least as slowly with the angle as a cosine, and no direction is
    further than 0.5 degrees from one of the steps. The cost is that of 180 spectra. The
    acceleration of a mass that slides in the plane is divided into straight segments, as
    `response_spectrum` says, whose number sets the cost.

    References
    ----------
    D. M. Boore, Orientation-independent, nongeometric-mean measures of seismic intensity from two
    horizontal components of motion, Bull. Seism. Soc. Am. 100 (2010), 1830-1835.

    Examples
    --------
    >>> import stickslip as ss
    >>> station = ss.GroundMotion([0, 3, -3, 0], dt=0.1, transverse=[0, 4, -4, 0])
    >>> round(float(ss.rotd(station).rotd100[0]), 3)  # sqrt(3^2 + 4^2), at 53 degrees
    5.0
    """
    if np.ndim(damping):
        got = "several" if np.size(damping) else "none"
        raise ValueError(f"rotd: damping must be one number, got {got}")
    damping = real(damping, "rotd: damping")
    if isinstance(station, (PlanarResponse, CartResponse)):
        floor = _PlanarFloorMotion(station)

        def at(angle: int) -> Any:
            return floor.spectrum(angle, periods, damping, kind)

    elif not isinstance(station, GroundMotion):
        raise TypeError(
            "rotd: station must be a GroundMotion, a PlanarResponse or a CartResponse, got"
            f" {type(station).__name__}"
        )
    elif station.transverse is None:
        raise ValueError(f"rotd: '{station.name}' needs a transverse component, it has none")
    else:

        def at(angle: int) -> Any:
            return response_spectrum(station.rotated(angle), periods, damping, kind=kind)

    first = at(0)  # raises for invalid arguments
    with ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        rest = list(pool.map(at, range(1, _ANGLES)))
    values = np.array([one.values for one in (first, *rest)])
    return RotD(kind, np.array(first.periods), float(damping), values)
