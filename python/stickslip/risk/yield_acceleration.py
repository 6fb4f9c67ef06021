"""The yield acceleration of a slope."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .._numbers import reals

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = ["yield_acceleration"]


def yield_acceleration(
    *,
    slope_degrees: ArrayLike,
    factor_of_safety: ArrayLike | None = None,
    friction_angle_degrees: ArrayLike | None = None,
    cohesion: ArrayLike | None = None,
    unit_weight: ArrayLike | None = None,
    depth: ArrayLike | None = None,
) -> Any:
    """Compute the yield acceleration of a slope, as a fraction of g.

    From the static factor of safety FS and the slope angle beta (Newmark 1965)::

        ky = (FS - 1) sin(beta)

    or from the strength of an infinite slope under horizontal shaking, with the friction angle phi,
    the cohesion c, the unit weight gamma and the vertical depth t of the slip surface::

        ky = tan(phi - beta) + c / (gamma t cos(beta)^2 (1 + tan(phi) tan(beta)))

    Parameters
    ----------
    slope_degrees : float or array_like
        Angle of the slope beta [degrees], from 0 to below 90; above 0 with a factor of safety.
    factor_of_safety : float or array_like, optional
        Static factor of safety FS, positive. Give this or the strength.
    friction_angle_degrees : float or array_like, optional
        Friction angle phi [degrees], from 0 to below 90.
    cohesion : float or array_like, optional
        c [Pa], at least 0. Default: 0. It needs `unit_weight` and `depth`.
    unit_weight : float or array_like, optional
        Unit weight of the soil gamma [N/m^3], positive. Only c / gamma matters: kPa with kN/m^3
        give the same.
    depth : float or array_like, optional
        Vertical depth of the slip surface t [m], positive: the thickness normal to the slope,
        divided by cos(beta).

    Returns
    -------
    float, or ndarray if an argument is an array
        ky [g]; the arguments broadcast. Zero or less means that the slope fails without an
        earthquake: friction laws reject it.

    Raises
    ------
    TypeError
        Neither or both of the factor of safety and the strength; a cohesion without the unit weight
        and the depth.
    ValueError
        An argument out of its range, or not a finite number.

    Notes
    -----
    The second form is exact for an infinite slope without pore pressure. The first one takes the
    acceleration parallel to the slope; with FS = tan(phi) / tan(beta) it exceeds tan(phi - beta) by
    the factor (1 + tan(phi) tan(beta)) cos(beta), 1.08 for phi = 30 and beta = 15 degrees.

    References
    ----------
    N. M. Newmark, Effects of earthquakes on dams and embankments, Geotechnique 15 (1965), 139-160.

    Examples
    --------
    >>> import stickslip as ss
    >>> round(ss.yield_acceleration(factor_of_safety=1.5, slope_degrees=15), 4)
    0.1294
    >>> strength = ss.Random(
    ...     ss.yield_acceleration,
    ...     slope_degrees=20,
    ...     friction_angle_degrees=ss.Normal(32, 2, low=25),
    ... )
    >>> slopes = ss.Random(ss.Coulomb, mu=strength, backward=float("inf"))  # a law for each member
    """
    of_soil = {"cohesion": cohesion, "unit_weight": unit_weight, "depth": depth}
    given = [name for name, value in of_soil.items() if value is not None]
    if (factor_of_safety is None) == (friction_angle_degrees is None):
        raise TypeError(
            "yield_acceleration: needs either factor_of_safety or friction_angle_degrees, got"
            f" {'neither' if factor_of_safety is None else 'both'}"
        )
    if factor_of_safety is not None:
        if given:
            raise TypeError(
                f"yield_acceleration: {given[0]} belongs to friction_angle_degrees, got it with"
                " factor_of_safety"
            )
        slope = np.radians(_within("slope_degrees", slope_degrees, 0, 90, strict=True))
        safety = _within("factor_of_safety", factor_of_safety, 0, np.inf, strict=True)
        return _plain((safety - 1) * np.sin(slope))
    if given and len(given) < len(of_soil):
        missing = next(name for name in of_soil if name not in given)
        raise TypeError(f"yield_acceleration: {given[0]} needs {missing}, which is missing")
    slope = np.radians(_within("slope_degrees", slope_degrees, 0, 90))
    friction = np.radians(_within("friction_angle_degrees", friction_angle_degrees, 0, 90))
    ky = np.tan(friction - slope)
    if given:
        weight = _within("unit_weight", unit_weight, 0, np.inf, strict=True)
        stress = weight * _within("depth", depth, 0, np.inf, strict=True)
        along = np.cos(slope) ** 2 * (1 + np.tan(friction) * np.tan(slope))
        ky = ky + _within("cohesion", cohesion, 0, np.inf) / (stress * along)
    return _plain(ky)


def _within(
    name: str, given: Any, low: float, high: float, strict: bool = False
) -> NDArray[np.float64]:
    """The values as an array, each at least `low` (above it if strict) and below `high`."""
    values = reals(given, f"yield_acceleration: {name}")
    wrong = ~(np.isfinite(values) & (values < high) & (values > low if strict else values >= low))
    if wrong.any():
        bounds = f"{'above' if strict else 'at least'} {low}"
        bounds += " and finite" if high == np.inf else f" and below {high}"
        raise ValueError(
            f"yield_acceleration: {name} must be {bounds}, got {values[wrong].flat[0]}"
        )
    return values


def _plain(value: Any) -> Any:
    """A number instead of an array without dimensions."""
    return float(value) if np.ndim(value) == 0 else value
