"""What tables show of the response of a cart."""

from __future__ import annotations

from .._core import CartResponse
from .._responses import VERTICAL, Described, History, ground_motion_row
from .casters import swivels

__all__ = ["describe"]

_CENTER = "of the center of mass relative to the ground"
_ACCELERATION = "absolute acceleration of the center of mass"
_HISTORIES = (
    History("ground_acceleration_axis", "m/s^2", "ground acceleration, axis component"),
    History("ground_acceleration_transverse", "m/s^2", "ground acceleration, transverse component"),
    VERTICAL,
    History("displacement_axis", "m", f"displacement {_CENTER}, axis component"),
    History("displacement_transverse", "m", f"displacement {_CENTER}, transverse component"),
    History("velocity_axis", "m/s", f"velocity {_CENTER}, axis component"),
    History("velocity_transverse", "m/s", f"velocity {_CENTER}, transverse component"),
    History("acceleration_axis", "m/s^2", f"{_ACCELERATION}, axis component"),
    History("acceleration_transverse", "m/s^2", f"{_ACCELERATION}, transverse component"),
    History("yaw", "rad", "yaw, positive from the axis toward the transverse direction"),
    History("yaw_rate", "rad/s", "rate of the yaw"),
)


def describe(response: CartResponse) -> Described:
    """What tables show of a response."""
    lifted = response.motion.vertical is not None
    headings = (
        History(f"heading_{i}", "rad", f"heading of caster {i} relative to the cart", values)
        for i, values in zip(swivels(response.cart), response.heading)
    )
    return Described(
        system="cart",
        title="Response of a cart",
        histories=(
            *(one for one in _HISTORIES if lifted or one is not VERTICAL),
            *headings,
        ),
        results=(
            *("peak", "peak_time", "peak_yaw", "peak_outline", "peak_outline_time", "peak_corner"),
            *("reach_outline", "residual", "residual_yaw", "time_moving", "rests", "at_rest"),
            *("margin", "remark"),
        ),
        attributes={"peak": "m", "peak_outline": "m"},
        rows=_rows,
    )


def _rows(response: CartResponse) -> list[tuple[str, str]]:
    x, y = response.residual
    low_x, low_y, high_x, high_y = response.reach_outline
    return [
        ("cart", repr(response.cart)),
        ground_motion_row(response),
        ("peak displacement of the center of mass", f"{response.peak:.4g} m"),
        ("peak displacement of a corner", f"{response.peak_outline:.4g} m"),
        ("swept by the outline", f"{high_x - low_x:.4g} m x {high_y - low_y:.4g} m"),
        ("peak yaw", f"{response.peak_yaw:.4g} rad"),
        (
            "residual displacement" if response.at_rest else "displacement at the end, moving",
            f"({x:.4g}, {y:.4g}) m, yaw {response.residual_yaw:.4g} rad",
        ),
        ("time moving", f"{response.time_moving:.4g} s"),
        ("dissipated by friction", f"{response.energy.dissipated:.4g} m²/s²"),
        ("margin of the nearest decision", f"{response.margin:.3g}"),
    ]
