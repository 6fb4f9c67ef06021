"""What tables show of the response of a slider, on one axis and in the plane."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ._core import PlanarResponse, Response
from ._responses import (
    GROUND,
    TEMPERATURE,
    VERTICAL,
    Described,
    History,
    ground_motion_row,
    loop_rows,
)

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

__all__ = ["describe"]

# Each has two components in the plane.
_VECTORS = (
    GROUND,
    History("displacement", "m", "displacement relative to the ground"),
    History("velocity", "m/s", "velocity relative to the ground"),
    History("acceleration", "m/s^2", "absolute acceleration of the mass"),
    History("friction", "m/s^2", "friction force per unit mass"),
    History("spring", "m/s^2", "spring force per unit mass"),
    History("damper", "m/s^2", "damper force per unit mass"),
    History("force", "m/s^2", "sum of friction, spring and damper force per unit mass"),
)
# Where the normal force is not the weight: under vertical motion, the last also on a slope.
_LIFTING = (
    VERTICAL,
    History("gap", "m", "gap between slider and ground"),
    History("normal_force", "m/s^2", "normal force per unit mass"),
)
_STUCK = History("stuck", "", "whether the slider sticks")


def describe(response: Response | PlanarResponse) -> Described:
    """What tables show of a response."""
    in_plane = isinstance(response, PlanarResponse)
    place = ("peak_time", "peak_displacement", "peak_azimuth") if in_plane else ()
    return Described(
        system="slider",
        title="Response in the plane" if in_plane else "Response",
        histories=_histories(response),
        results=("contact", "peak", *place, "residual", "sliding_distance", "at_rest"),
        attributes={"peak": "m", "residual": "m"},
        rows=_rows,
    )


def _histories(response: Response | PlanarResponse) -> tuple[History, ...]:
    vectors: tuple[History, ...] = _VECTORS
    if isinstance(response, PlanarResponse):
        vectors = tuple(
            History(f"{name}_{component}", unit, f"{description}, {component} component")
            for name, unit, description, _ in _VECTORS
            for component in ("axis", "transverse")
        )
    first = 2 if response.slider.slope_degrees > 0 else 3
    if "vertical" in response.components:
        first = 0
    heated = [] if response.temperature is None else [TEMPERATURE]
    return (*vectors, *_LIFTING[first:], *heated, _STUCK)


def _rows(response: Response | PlanarResponse) -> list[tuple[str, str]]:
    energy = response.energy
    rows = [
        ("slider", repr(response.slider)),
        ground_motion_row(response),
        ("peak displacement", _peak_text(response)),
        (
            "residual displacement" if response.at_rest else "displacement at the end, sliding",
            _meters(response.residual),
        ),
        ("sliding distance", f"{response.sliding_distance:.4g} m"),
        ("slips", f"{response.slips:,}"),
        ("time sliding", f"{response.time_sliding:.4g} s"),
        ("dissipated by friction", f"{energy.dissipated:.4g} m²/s²"),
    ]
    radius = response.slider.radius
    if radius is not None:
        rows.insert(1, ("radius, period", f"{radius:.4g} m, {response.slider.period:.4g} s"))
    if response.slider.damping > 0:
        rows.append(("dissipated by the damper", f"{energy.damped:.4g} m²/s²"))
    if response.slider.stops is not None:
        rows.append(("impacts on stops", f"{len(response.impacts):,}"))
        rows.append(("lost in impacts", f"{energy.impact:.4g} m²/s²"))
    if "vertical" in response.components:
        flights = (response.events["kind"] == "liftoff").sum()
        rows.append(("contact with the ground", f"{response.contact}, {flights:,} flights"))
    return rows + loop_rows(response) if isinstance(response, Response) else rows


def _meters(displacement: float | NDArray[np.float64]) -> str:
    """A displacement, or both components of one."""
    if isinstance(displacement, float):
        return f"{displacement:.4g} m"
    return f"({displacement[0]:.4g}, {displacement[1]:.4g}) m"


def _peak_text(response: Response | PlanarResponse) -> str:
    text = _meters(response.peak)
    if isinstance(response, PlanarResponse) and response.peak_azimuth is not None:
        text += f", toward azimuth {response.peak_azimuth:.0f}\N{DEGREE SIGN}"
    return text
