"""Response spectra, with those of the floors of structures."""

from __future__ import annotations

import operator
from typing import TYPE_CHECKING, Any, Literal, SupportsIndex, overload

from .. import _core
from .._core import (
    CartResponse,
    EquipmentOnFloor,
    FlexibleSlope,
    GroundMotion,
    IsolatedStructure,
    PlanarResponse,
    Response,
    ResponseSpectrum,
    StructureResponse,
    integrate,
)
from .._core import _ground_motion as ground_motion
from .records import changed

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from .intensity import SuiteSpectra
    from .suite import Suite

__all__ = ["response_spectrum"]

_Kind = Literal[
    "pseudo_acceleration", "pseudo_velocity", "displacement", "velocity", "acceleration"
]


@overload
def response_spectrum(
    motion: GroundMotion | Response | PlanarResponse | StructureResponse | CartResponse,
    periods: ArrayLike,
    damping: ArrayLike = 0.05,
    *,
    kind: _Kind = "pseudo_acceleration",
    direction: float = 0.0,
    floor: SupportsIndex | None = None,
) -> ResponseSpectrum: ...
@overload
def response_spectrum(
    motion: Suite,
    periods: ArrayLike,
    damping: ArrayLike = 0.05,
    *,
    kind: _Kind = "pseudo_acceleration",
) -> SuiteSpectra: ...
def response_spectrum(
    motion: GroundMotion | Response | PlanarResponse | StructureResponse | CartResponse | Suite,
    periods: ArrayLike,
    damping: ArrayLike = 0.05,
    *,
    kind: _Kind = "pseudo_acceleration",
    direction: float = 0.0,
    floor: SupportsIndex | None = None,
) -> ResponseSpectrum | SuiteSpectra:
    """Compute the elastic response spectrum of a ground motion, or of a response: a floor spectrum.

    Each linear oscillator x'' + 2 zeta wn x' + wn^2 x = -n(t), wn = 2 pi / T, is at rest when the
    motion begins. The value is the largest magnitude over all time, in continuous time, not only at
    the samples. Between samples the response is exact, for linear and constant interpolation and
    any ratio of T to the time step. After the last sample n is zero; the maximum includes the free
    vibration that follows.

    Parameters
    ----------
    motion : GroundMotion, Response, PlanarResponse, StructureResponse, CartResponse or Suite
        A suite gives the spectra of all its ground motions, as `SuiteSpectra`. A response excites
        the oscillators with the absolute acceleration of the sliding mass along x, including its
        jumps where a slip begins, reverses or stops. An impact on a stop, and the friction impulse
        of a landing, change the velocity of the mass at once: each oscillator gets that jump as an
        impulse. That of a cart is of its center of mass. Settle the response, otherwise the floor
        motion ends with the record. `rotd` gives the spectra of a station, of a response in the
        plane or of a cart in all directions. The response of a structure gives those of its floors,
        see `floor`.
    periods : float or array_like, shape (P,)
        Undamped natural periods T [s], in any order: each from 1e-6 to 1e6, or 0, a rigid
        oscillator, which gives the PGA as acceleration and 0 otherwise.
    damping : float or array_like, shape (D,), optional
        Ratio of critical damping zeta, at least 0 and below 2; 5 % is 0.05.
    kind : str, optional
        'pseudo_acceleration', wn^2 max |x| [m/s^2]; 'pseudo_velocity', wn max |x| [m/s];
        'displacement', max |x| [m], relative to the ground; 'velocity', max |x'| [m/s], relative to
        the ground; 'acceleration', max |x'' + n| [m/s^2], absolute.
    direction : float, optional
        Horizontal direction of the oscillators, clockwise from the axis of the motion [degrees]: 90
        is the transverse component. Other values than 0 need a ground motion with a transverse
        component, or a response in the plane or of a cart.
    floor : int, optional
        Floor of a `StructureResponse` on which the oscillators stand, counted from 1, the lowest; 0
        is what the structure stands on. Default: the sliding mass, which is the base of an
        `IsolatedStructure` and of a coupled `FlexibleSlope`, and the equipment of an
        `EquipmentOnFloor`.

    Returns
    -------
    ResponseSpectrum, or SuiteSpectra of a suite

    Raises
    ------
    ValueError
        A period, a damping ratio or a kind that is not allowed (names its index); a truncated
        response; an acceleration at period 0 of a response with impacts, which is infinite; a floor
        that does not exist, of a structure without floors, or of something else than a structure; a
        structure that feels impacts on stops; the sliding mass of a decoupled analysis.

    Warns
    -----
    PlausibilityWarning
        A period of 60 s or more, which may be in ms.

    Notes
    -----
    Accurate to round-off: some 1e-15 times the square root of the number of samples, and times the
    radians in a time step if these exceed 1. If the ground velocity of a record does not end at
    zero, the ground keeps this velocity, and oscillators of long period continue to the
    displacement x' / wn: correct the baseline first.

    The same accuracy holds for a response with a constant slip level on one axis, without spring
    and damper. Other responses are approximated by straight segments of the acceleration, which is
    as exact as `integrate`. Their error is at most 1e-6 of its maximum e, which changes a
    pseudo-acceleration by at most 1e-6 e coth(pi zeta / (2 sqrt(1 - zeta^2))): 13e-6 e at 5 %.
    After an impact, the pseudo-acceleration of a stiff oscillator grows as 2 pi / T: at periods
    below the duration of a real contact it depends on that contact, which is not in the model.

    Of a structure only the accelerations at the samples of the response are used, with straight
    lines between them; for a base that slides, also its velocities there and its peak. This is an
    approximation. Beside the same ground motions with 4 times as many samples (four records and a
    pulse, dt = 0.01 s; a building of three stories on isolators, equipment on its third floor, a
    slope; damping 5 %) pseudo-accelerations differ by at most

    ======================  ============  ===============  ==============
    oscillators on          T >= 10 dt    5 dt to 10 dt    2 dt to 5 dt
    ======================  ============  ===============  ==============
    the sliding base        5 %           9 %              44 %
    floors of the building  4 %           10 %             16 %
    the top of the slope    9 %           5 %              8 %
    the equipment           0.7 %         3 %              1.1 %
    ======================  ============  ===============  ==============

    Where the structure follows the ground without sliding below it, such as the base of equipment,
    the spectrum is exact. The errors of floors fall with the square of the time step: give the
    response to `quake.resampled(quake.dt / 4)`. The equipment is slid again under the motion of its
    floor, so that its jumps and impacts are where they belong. Floors continue to vibrate after the
    interface has settled, and what follows the last sample is left out: append zeros to the ground
    motion if that matters.

    100 periods of 10,000 samples take some 2 ms with even times (AVX-512), and up to 15 ms for
    white noise at critical damping. Uneven times take some 0.3 us for each period, damping ratio
    and change of the time step.

    References
    ----------
    N. C. Nigam, P. C. Jennings, Bull. Seism. Soc. Am. 59 (1969), 909-922, for the response at the
    samples.

    Examples
    --------
    >>> import stickslip as ss
    >>> building = ss.Structure.shear_building(masses=[1], stiffnesses=[400], damping_ratio=0.05)
    >>> quake = ss.GroundMotion([0, 3, -3, 0, 2, 0], dt=0.2)
    >>> r = ss.integrate(ss.IsolatedStructure(ss.Coulomb(mu=0.1), building, base_mass=1), quake)
    >>> base, top = (ss.response_spectrum(r, 0.3, floor=i).values[0] for i in (0, 1))
    >>> bool(base > 0 and top > 0)
    True
    """
    spectrum: Any = _core.response_spectrum
    found: ResponseSpectrum | SuiteSpectra
    if isinstance(motion, StructureResponse):
        if direction != 0:
            raise ValueError(
                "response_spectrum: direction needs a ground motion or a response with two"
                " horizontal components"
            )
        felt = _sliding_mass(motion) if floor is None else _floor(motion, floor)
        found = spectrum(felt, periods, damping, kind=kind)
    elif floor is not None:
        raise ValueError(
            "response_spectrum: floor needs the response of a structure, got a"
            f" {type(motion).__name__}"
        )
    else:
        found = spectrum(motion, periods, damping, kind=kind, direction=direction)
    return found


def _floor(
    response: StructureResponse, floor: SupportsIndex, *, vertical: bool = False
) -> GroundMotion:
    """The absolute acceleration of a floor, along straight lines; after the last sample it is zero.

    Parameters
    ----------
    response : StructureResponse
    floor : int
        0 is the base.
    vertical : bool, optional
        Whether the vertical ground motion comes with it.
    """
    import numpy as np

    from .._structure_responses import has_floors

    system, motion = response.system, response.motion
    if response.truncated:
        raise ValueError(
            "response_spectrum: the samples of the response must reach the final rest, but they are"
            " truncated; extend the ground motion"
        )
    # An impact changes the velocity of the floors at once, but not below equipment without mass.
    if len(response.impacts) and not (isinstance(system, EquipmentOnFloor) and system.mass == 0):
        raise ValueError(
            "response_spectrum: impacts on stops are impulses on the structure, which samples of"
            " its acceleration do not contain"
        )
    if not isinstance(floor, SupportsIndex):
        raise TypeError(f"response_spectrum: floor must be an integer, got {floor!r}")
    floor = operator.index(floor)
    if floor == 0 and not _base_slides(response):
        return changed(motion, name=f"base, {motion.name}".rstrip(", "))
    times = response.time
    if not (np.diff(times) > 0).all():
        raise ValueError(
            "response_spectrum: samples of a structure do not show what happens at a jump of the"
            f" ground motion between two samples of equal time, as '{motion.name}' has; give one"
            " with increasing times"
        )
    if floor == 0:
        times, acceleration = _with_midpoints(response)
    elif not has_floors(response):
        raise ValueError(
            f"response_spectrum: the structure has no floors, got floor={floor}; give"
            " Structure.from_modes the shapes"
        )
    else:
        every = response.floors.acceleration
        if not 1 <= floor <= every.shape[1]:
            raise ValueError(
                f"response_spectrum: floor must be from 0, the base, to {every.shape[1]}, got"
                f" {floor}"
            )
        acceleration = every[:, floor - 1]
    step = motion.dt and motion.dt * (len(response.time) - 1) / (len(times) - 1)
    options: dict[str, Any] = {"dt": step} if step else {"times": times}
    if vertical and motion.vertical is not None:
        options["vertical"] = np.zeros(len(acceleration))
        options["vertical"][: len(motion)] = motion.vertical
    name = f"floor {floor}" if floor else "base"
    return ground_motion(acceleration, name=f"{name}, {motion.name}".rstrip(", "), **options)


def _base_slides(response: StructureResponse) -> bool:
    system = response.system
    return isinstance(system, IsolatedStructure) or (
        isinstance(system, FlexibleSlope) and system.method == "coupled"
    )


def _with_midpoints(response: StructureResponse) -> tuple[NDArray[Any], NDArray[Any]]:
    """Times and accelerations of a base that slides, with a value between any two samples.

    The acceleration jumps between samples. The value makes the velocities at the samples exact, but
    for those where it would exceed the peak.
    """
    import numpy as np

    times, a, motion = response.time, response.base_acceleration, response.motion
    steps = np.diff(times)
    ground = np.zeros(len(steps))  # its mean over each step
    n = motion.acceleration
    ground[: len(n) - 1] = n[:-1] if motion.interpolation == "constant" else (n[:-1] + n[1:]) / 2
    mean = np.diff(response.velocity) / steps + ground
    peak = response.peak_base_acceleration
    between = np.clip(2 * mean - (a[:-1] + a[1:]) / 2, -peak, peak)
    where = range(1, len(a))
    return np.insert(times, where, times[:-1] + steps / 2), np.insert(a, where, between)


def _sliding_mass(response: StructureResponse) -> GroundMotion | Response:
    """What slides: the base, or equipment, which its floor moves."""
    if _base_slides(response):
        return _floor(response, 0)
    system = response.system
    if not isinstance(system, EquipmentOnFloor):
        raise ValueError(
            "response_spectrum: the block of a decoupled analysis is not part of the column; give"
            " floor"
        )
    _, _, displacement, velocity, settle, distance, heat = response.__getstate__()
    return integrate(
        system.slider,
        _floor(response, system.floor, vertical=True),
        displacement=displacement,
        velocity=velocity,
        settle=settle,
        contact="clipped",
        sliding_distance=distance,
        heat=heat,
    )
