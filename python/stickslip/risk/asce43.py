"""The estimate of ASCE 43-05 for the sliding of unanchored equipment."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .._core import STANDARD_GRAVITY, GroundMotion, response_spectrum
from .._numbers import real

__all__ = ["ASCE43Estimate", "asce43"]

DAMPING = 0.1
LOWEST, HIGHEST = 0.02, 1000.0  # frequencies of the search [Hz]
_LEVEL, _FREQUENCY = 1e-6, 1e-7  # relative tolerances
_NARROWEST = 1e-9  # ratio of frequencies less 1, of intervals that are not split
_PARTS, _AT_ONCE = 4, 32  # of an interval; intervals split in a round
_SPACING = 0.05  # of the first grid, in ln f
_BLOCKS = 8  # of this grid; those above the first frequency that reaches c_s are left out
_ANGLES = 16  # directions over half a turn, before they are refined


@dataclass(frozen=True)
class ASCE43Estimate:
    """The estimate of ASCE 43-05, as `asce43` returns it.

    Attributes
    ----------
    displacement : float
        Best estimate of the sliding displacement delta_s [m]; 0 if c_s is never reached.
    frequency : float or None
        f_es, the lowest frequency at which the spectrum reaches c_s [Hz]; None if it never does.
    reached : bool
        Whether the spectrum reaches c_s.
    mu : float
        Coefficient of friction.
    effective_mu : float
        mu_e, reduced by the vertical acceleration.
    sliding_acceleration : float
        c_s [m/s^2].
    peak_vertical_acceleration : float
        A_v [m/s^2]; 0 without a vertical component.
    spectrum : str
        The spectrum used: that along the axis, or the largest over all horizontal directions.
    edition : str
        The edition of the standard.
    """

    displacement: float
    frequency: float | None
    reached: bool
    mu: float
    effective_mu: float
    sliding_acceleration: float
    peak_vertical_acceleration: float
    spectrum: str
    edition: str = "ASCE/SEI 43-05, appendix A"

    def __repr__(self) -> str:
        place = f"at {self.frequency:.4g} Hz" if self.reached else "never reached"
        return (
            f"<ASCE43Estimate: {self.displacement:.4g} m, c_s {self.sliding_acceleration:.4g} m/s^2"
            f" {place}, {self.spectrum}, {self.edition}>"
        )


def asce43(*, mu: float, motion: GroundMotion) -> ASCE43Estimate:
    """Estimate the sliding displacement of unanchored equipment by ASCE 43-05, appendix A.

    With the peak vertical acceleration A_v::

        mu_e = mu (1 - 0.4 A_v / g)          (A-1)
        c_s = 2 mu_e g                       (A-2)
        delta_s = c_s / (2 pi f_es)^2        (A-3)

    f_es is the lowest frequency from 0.02 Hz at which the pseudo-acceleration at 10 % damping
    reaches c_s. The form of (A-3) is unverified: we know it from secondary sources.

    Parameters
    ----------
    mu : float
        Coefficient of static friction, positive.
    motion : GroundMotion
        The motion of the floor. With a transverse component, the pseudo-acceleration is the largest
        over all horizontal directions (vector spectral acceleration). Without a vertical component
        A_v = 0.

    Returns
    -------
    ASCE43Estimate

    Raises
    ------
    TypeError
        `motion` is not a GroundMotion.
    ValueError
        mu is not positive and finite; a vertical acceleration of 2.5 g or more, at which mu_e
        vanishes.

    Notes
    -----
    The frequency is accurate to 1e-6, and no crossing is missed, however narrow: at no lower
    frequency from 0.02 Hz does the pseudo-acceleration exceed c_s by more than 1e-6 of it.
    Between the frequencies that are computed, this follows from a bound on the rate at which a
    spectrum can change; see the page on ASCE 43. The search ends at 1000 Hz: a displacement that it
    leaves out is below c_s / (2 pi 1000 Hz)^2, less than 1 um for c_s up to 4 g.

    A component of 10,000 samples takes some 20 ms, and two components some 0.3 s.

    References
    ----------
    ASCE/SEI 43-05, Seismic design criteria for structures, systems, and components in nuclear
    facilities, American Society of Civil Engineers (2005), appendix A.

    Examples
    --------
    >>> import stickslip as ss
    >>> quake = ss.HarmonicMotion(amplitude=4, omega=6, duration=20).sampled(0.01)
    >>> e = ss.asce43(mu=0.5, motion=quake)
    >>> e.reached, round(e.frequency, 3), round(e.displacement, 3)
    (True, 0.792, 0.396)
    """
    if not isinstance(motion, GroundMotion):
        raise TypeError(f"asce43: motion must be a GroundMotion, got {type(motion).__name__}")
    mu = real(mu, "asce43: mu")
    if not (math.isfinite(mu) and mu > 0):
        raise ValueError(f"asce43: mu must be positive and finite, got {mu}")
    vertical = 0.0 if motion.vertical is None else float(np.abs(motion.vertical).max())
    effective = mu * (1 - 0.4 * vertical / STANDARD_GRAVITY)
    if not effective > 0:
        raise ValueError(
            "asce43: the peak vertical acceleration must be below 2.5 g, where the effective"
            f" coefficient of friction vanishes, got {vertical / STANDARD_GRAVITY:.4g} g"
        )
    level = 2 * effective * STANDARD_GRAVITY
    flat = motion.transverse is None
    spectrum = _one_direction(motion) if flat else _all_directions(motion)
    frequency = _lowest_reach(spectrum, level)
    reached = frequency is not None
    return ASCE43Estimate(
        displacement=level / (2 * math.pi * frequency) ** 2 if frequency else 0.0,
        frequency=frequency,
        reached=reached,
        mu=float(mu),
        effective_mu=effective,
        sliding_acceleration=level,
        peak_vertical_acceleration=vertical,
        spectrum=f"10 % damped, {'along the axis' if flat else 'largest over directions'}",
    )


# ---- the spectrum


class _Values(NamedTuple):
    """A spectrum at some frequencies [m/s^2]."""

    lower: NDArray[np.float64]  # bounds of the pseudo-acceleration
    upper: NDArray[np.float64]
    velocity: NDArray[np.float64]  # 2 pi f times a bound of the relative velocity


_Spectrum = Callable[[NDArray[np.float64], float], _Values]  # of frequencies and c_s


def _values(motion: GroundMotion, frequency: Any, kind: Any) -> NDArray[np.float64]:
    return np.asarray(response_spectrum(motion, 1 / frequency, DAMPING, kind=kind).values)


def _one_direction(motion: GroundMotion) -> _Spectrum:
    def at(frequency: NDArray[np.float64], level: float) -> _Values:
        a = _values(motion, frequency, "pseudo_acceleration")
        return _Values(a, a, 2 * math.pi * frequency * _values(motion, frequency, "velocity"))

    return at


def _all_directions(motion: GroundMotion) -> _Spectrum:
    """The largest over all directions.

    The path of the oscillator lies within the supporting lines of each direction that is computed:
    its spectrum is their distance. The corners of this polygon are upper bounds, which meet the
    lower bound when a supporting line through the farthest corner touches the path. Only the
    frequencies whose bounds are on both sides of the level need that.
    """
    angles = np.arange(_ANGLES) * (180 / _ANGLES)
    turned = [motion.rotated(angle) for angle in angles]
    components = [motion.component("axis"), motion.component("transverse")]

    def at(frequency: NDArray[np.float64], level: float) -> _Values:
        supports = np.array([_values(one, frequency, "pseudo_acceleration") for one in turned])
        lower, upper = supports.max(axis=0), _corners(angles, supports)[0].max(axis=0)
        for i in np.flatnonzero((lower < level) & (upper >= level)):
            lower[i], upper[i] = _farthest(motion, frequency[i], level, angles, supports[:, i])
        velocity = np.hypot(*(_values(one, frequency, "velocity") for one in components))
        return _Values(lower, upper, 2 * math.pi * frequency * velocity)

    return at


def _corners(angles: NDArray[Any], supports: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
    """Largest distance between each supporting line and the next, and its angle [degrees].

    The lines are along the first axis, over half a turn. Where their corner is not between them,
    the distance is that of the farther line.
    """
    width = np.radians(np.diff(angles, append=angles[0] + 180))
    width = width.reshape(-1, *(1,) * (supports.ndim - 1))
    following = np.concatenate([supports[1:], supports[:1]])
    beside = np.arctan2(following - supports * np.cos(width), supports * np.sin(width))
    between = (beside > 0) & (beside < width)
    distance = np.where(between, supports / np.cos(beside), np.maximum(supports, following))
    return distance, (angles.reshape(width.shape) + np.degrees(beside))


def _farthest(
    motion: GroundMotion,
    frequency: float,
    level: float,
    angles: NDArray[Any],
    supports: NDArray[np.float64],
) -> tuple[float, float]:
    """Bounds of the largest spectrum over all directions, on one side of the level if possible."""
    while True:
        distance, angle = _corners(angles, supports)
        k = int(distance.argmax())
        lower, upper = float(supports.max()), float(distance[k])
        if lower >= level or upper < level or upper <= lower * (1 + _LEVEL / 2):
            return lower, upper
        there = _values(motion.rotated(angle[k]), frequency, "pseudo_acceleration")
        angles = np.concatenate([angles[: k + 1], angle[k : k + 1], angles[k + 1 :]])
        supports = np.concatenate([supports[: k + 1], there, supports[k + 1 :]])


# ---- the search

# Rates at which a (pseudo-acceleration) and b (velocity times 2 pi f) can change with ln f:
# |a'| <= alpha b, |b'| <= beta a + gamma b; see docs/asce43.md.
_ROOT = math.sqrt(1 - DAMPING**2)
_DECAY = math.exp(-math.pi * DAMPING / _ROOT)  # of half a period
_OF_FORCE = (1 + _DECAY) / (1 - _DECAY)
_OF_RATE = 2 * math.exp(-DAMPING * math.acos(DAMPING) / _ROOT) / (1 - _DECAY)
_ALPHA = 2 * (_OF_RATE + DAMPING * _OF_FORCE)
_BETA, _GAMMA = 2 * _OF_RATE, 1 + 2 * DAMPING * _OF_RATE
_SPLIT = math.sqrt(_GAMMA**2 / 4 + _ALPHA * _BETA)


def _largest_nearby(a: Any, b: Any, distance: Any) -> Any:
    """Bound of the pseudo-acceleration up to a distance in ln f: a' = alpha b, b' = ... solved."""
    swell = np.exp(_GAMMA / 2 * distance)
    even, odd = np.cosh(_SPLIT * distance), np.sinh(_SPLIT * distance) / _SPLIT
    return swell * (a * (even - _GAMMA / 2 * odd) + b * _ALPHA * odd)


def _lowest_reach(spectrum: _Spectrum, level: float) -> float | None:
    """The lowest frequency at which a spectrum reaches a level, or None."""
    count = math.ceil(math.log(HIGHEST / LOWEST) / _SPACING) + 1
    blocks: list[tuple[NDArray[np.float64], ...]] = []
    for block in np.array_split(np.geomspace(LOWEST, HIGHEST, count), _BLOCKS):
        blocks.append((block, *spectrum(block, level)))
        if (blocks[-1][1] >= level).any():
            break
    f, lower, upper, velocity = (np.concatenate(parts) for parts in zip(*blocks))
    while True:
        reach = np.flatnonzero(lower >= level)
        last = int(reach[0]) + 1 if reach.size else f.size
        f, lower, upper, velocity = (x[:last] for x in (f, lower, upper, velocity))
        width = np.diff(np.log(f))
        left = _largest_nearby(upper[:-1], velocity[:-1], width / 2)
        right = _largest_nearby(upper[1:], velocity[1:], width / 2)
        open_ = (np.maximum(left, right) >= level * (1 + _LEVEL)) & (width > _NARROWEST)
        if reach.size and open_.size:
            open_[-1] &= width[-1] > _FREQUENCY
        at = np.flatnonzero(open_)[:_AT_ONCE]
        if not at.size:
            return float(f[-1]) if reach.size else None
        parts = np.arange(1, _PARTS) / _PARTS
        new = (f[at, None] * np.exp(width[at, None] * parts)).ravel()
        found = spectrum(new, level)
        order = np.argsort(np.append(f, new), kind="stable")
        f = np.append(f, new)[order]
        lower, upper, velocity = (
            np.append(old, now)[order] for old, now in zip((lower, upper, velocity), found)
        )
