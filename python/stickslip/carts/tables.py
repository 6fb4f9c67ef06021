"""Tables of the responses of carts."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

from .._core import CartResponse, build_info
from .._tables import dataset_of, frame_of, history, html_table, json_text, write_csv
from .._text import printable
from .casters import swivels

_UNITS = {
    "time": "s",
    "ground_acceleration_axis": "m/s^2",
    "ground_acceleration_transverse": "m/s^2",
    "vertical_ground_acceleration": "m/s^2",
    "displacement_axis": "m",
    "displacement_transverse": "m",
    "velocity_axis": "m/s",
    "velocity_transverse": "m/s",
    "yaw": "rad",
    "yaw_rate": "rad/s",
}


def _columns(response: CartResponse) -> tuple[dict[str, NDArray[Any]], dict[str, str]]:
    """The time and the histories of a response, and their units."""
    columns = {
        name: history(response, name)
        for name in _UNITS
        if name != "vertical_ground_acceleration" or response.motion.vertical is not None
    }
    headings = {f"heading_{i}": one for i, one in zip(swivels(response.cart), response.heading)}
    units = {name: _UNITS[name] for name in columns} | dict.fromkeys(headings, "rad")
    return columns | headings, units


def to_dataframe(response: CartResponse) -> Any:
    """The histories as a pandas DataFrame; see `CartResponse.to_dataframe`."""
    return frame_of(*_columns(response), "CartResponse.to_dataframe", index="time")


def to_csv(response: CartResponse, path: str | os.PathLike[str]) -> Path:
    """Write the histories to a file; see `CartResponse.to_csv`."""
    return write_csv(*_columns(response), path)


def to_xarray(response: CartResponse) -> Any:
    """The histories as an xarray Dataset; see `CartResponse.to_xarray`."""
    attrs = {
        "cart": repr(response.cart),
        "motion": response.motion.name,
        "peak": response.peak,
        "peak_units": "m",
        "peak_outline": response.peak_outline,
        "peak_outline_units": "m",
    }
    return dataset_of(*_columns(response), "CartResponse.to_xarray", attrs)


_RESULTS = (
    *("peak", "peak_time", "peak_yaw", "peak_outline", "peak_outline_time", "peak_corner"),
    *("reach_outline", "residual", "residual_yaw", "time_moving", "rests", "at_rest", "margin"),
    "remark",
)


def to_json(response: CartResponse) -> str:
    """The results and histories as JSON; see `CartResponse.to_json`."""
    columns, units = _columns(response)
    document = {
        "stickslip": build_info()["version"],
        "cart": repr(response.cart),
        "motion": response.motion.name,
        "components": response.components,
        **{name: getattr(response, name) for name in _RESULTS},
        "units": units,
        **columns,
        "events": response.events,
    }
    return json_text(document)


def response_html(response: CartResponse) -> str:
    """A table of the main results of a response."""
    x, y = response.residual
    low_x, low_y, high_x, high_y = response.reach_outline
    rows = [
        ("cart", repr(response.cart)),
        ("ground motion", printable(response.motion.name) or repr(response.motion)),
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
    if response.remark:
        rows.append(("remark", response.remark))
    return html_table("Response of a cart", [], rows)
