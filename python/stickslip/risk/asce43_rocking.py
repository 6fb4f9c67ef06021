"""The estimate of ASCE 43-05 for the rocking of unanchored equipment."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .._core import STANDARD_GRAVITY, GroundMotion, RockingBlock, SlenderBlock, response_spectrum

__all__ = ["ASCE43RockingEstimate", "asce43_rocking"]

_ANGLES = 800  # of the search, up to twice alpha
_LOWEST = 0.05  # frequency [Hz]


@dataclass(frozen=True)
class ASCE43RockingEstimate:
    """The estimate of ASCE 43-05 for rocking, as `asce43_rocking` returns it.

    Not verified against the standard.

    Attributes
    ----------
    rotation : float
        Best estimate of the peak rotation [rad]; 0 if the block does not rock, infinite if the
        spectrum exceeds the capacity at all rotations.
    rotation_ratio : float
        The same over alpha.
    overturns : bool
        Whether it exceeds alpha.
    frequency : float or None
        f_e, the effective frequency at this rotation [Hz].
    damping_ratio : float
        beta_e, of the impacts.
    """

    rotation: float
    rotation_ratio: float
    overturns: bool
    frequency: float | None
    damping_ratio: float

    def __repr__(self) -> str:
        place = "" if self.frequency is None else f" at {self.frequency:.4g} Hz"
        overturns = ", overturns" if self.overturns else ""
        return (
            f"<ASCE43RockingEstimate: {self.rotation:.4g} rad ({self.rotation_ratio:.4g} alpha)"
            f"{overturns}{place}, {100 * self.damping_ratio:.4g} % damped>"
        )


def asce43_rocking(
    block: RockingBlock | SlenderBlock, motion: GroundMotion
) -> ASCE43RockingEstimate:
    """Estimate the peak rotation of an unanchored block by ASCE 43-05, appendix A.

    Not verified against the standard: the formulas are from secondary sources, and agree with a
    derivation from the energy of the block. With a = tan(alpha), the height h of the center of mass
    and the moment of inertia I about a corner::

        f_1 = cos(theta) + a sin(theta),  C_I = I/(m h^2),  C_R = 1 - 2 a^2/C_I
        beta_e = gamma/sqrt(4 pi^2 + gamma^2),  gamma = -2 ln(C_R)
        f_e = sqrt(2 g (f_1 - 1)/(C_I theta^2 h))/(2 pi)
        S_a(f_e, beta_e) = 2 g (f_1 - 1)/theta

    for the smallest theta; S_a is the pseudo-acceleration along the axis. Vertical motion, which
    the standard includes by a factor, is left out, and so are slip and a measured restitution.

    Parameters
    ----------
    block : RockingBlock or SlenderBlock
        A `SlenderBlock` is taken as uniform.
    motion : GroundMotion
        The motion of the floor.

    Returns
    -------
    ASCE43RockingEstimate

    Raises
    ------
    TypeError
        An argument of another type.
    ValueError
        A block too squat to rock on after an impact, C_R <= 0.

    Notes
    -----
    The angle is found on a grid of alpha / 400 above 0.05 Hz and by bisection; two crossings
    within one step are missed.

    Examples
    --------
    >>> import stickslip as ss
    >>> quake = ss.HarmonicMotion(amplitude=4, omega=9, duration=20).sampled(0.01)
    >>> e = ss.asce43_rocking(ss.RockingBlock(width=0.6, height=2), quake)
    >>> e.overturns, round(e.rotation_ratio, 2)
    (False, 0.35)
    """
    if not isinstance(block, (RockingBlock, SlenderBlock)):
        raise TypeError(
            "asce43_rocking: block must be a RockingBlock or a SlenderBlock, got"
            f" {type(block).__name__}"
        )
    if not isinstance(motion, GroundMotion):
        raise TypeError(
            f"asce43_rocking: motion must be a GroundMotion, got {type(motion).__name__}"
        )
    alpha = min(block.alpha, block.alpha_left)
    slope = math.tan(alpha)
    if isinstance(block, RockingBlock):
        height = block.center[1]
        inertia = 1 + slope**2 + (block.gyration_radius / height) ** 2
    else:
        height = 0.75 * STANDARD_GRAVITY / block.p**2 * math.cos(alpha)
        inertia = 4 / 3 * (1 + slope**2)
    kept = 1 - 2 * slope**2 / inertia
    if not kept > 0:
        raise ValueError(
            f"asce43_rocking: the block is too squat to rock on after an impact: C_R = {kept:.4g}"
            " must be positive"
        )
    gamma = -2 * math.log(kept)
    damping = gamma / math.hypot(2 * math.pi, gamma)

    def lift(theta: NDArray[np.float64]) -> NDArray[np.float64]:  # f_1 - 1
        return slope * np.sin(theta) - 2 * np.sin(theta / 2) ** 2

    def frequency(theta: NDArray[np.float64]) -> NDArray[np.float64]:
        square = 2 * STANDARD_GRAVITY * lift(theta) / (inertia * theta**2 * height)
        return np.sqrt(square) / (2 * math.pi)

    def excess(theta: NDArray[np.float64]) -> NDArray[np.float64]:
        demand = response_spectrum(
            motion, 1 / frequency(theta), damping, kind="pseudo_acceleration"
        )
        capacity = 2 * STANDARD_GRAVITY * lift(theta) / theta
        return np.asarray(demand.values) - capacity

    angles = 2 * alpha * np.arange(1, _ANGLES) / _ANGLES
    angles = angles[frequency(angles) > _LOWEST]
    above = excess(angles) >= 0
    rocks = motion.peak_acceleration > STANDARD_GRAVITY * slope
    changes = np.flatnonzero(above[1:] != above[:-1])
    if not rocks or not (changes.size or above[0]):
        return ASCE43RockingEstimate(0.0, 0.0, False, None, damping)
    if not changes.size:
        return ASCE43RockingEstimate(math.inf, math.inf, True, None, damping)
    first = int(changes[0])
    low, high = float(angles[first]), float(angles[first + 1])
    while high - low > 1e-12 * alpha:
        middle = (low + high) / 2
        if (excess(np.array([middle]))[0] >= 0) == above[first]:
            low = middle
        else:
            high = middle
    return ASCE43RockingEstimate(
        rotation=high,
        rotation_ratio=high / alpha,
        overturns=high > alpha,
        frequency=float(frequency(np.array([high]))[0]),
        damping_ratio=damping,
    )
