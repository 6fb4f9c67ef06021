"""Tables of the responses of blocks that rock."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

from .._core import RockingBlock, RockingResponse, build_info
from .._tables import dataset_of, frame_of, history, html_table, json_text, write_csv
from .._text import printable

_UNITS = {
    "time": "s",
    "ground_acceleration": "m/s^2",
    "vertical_ground_acceleration": "m/s^2",
    "rotation": "rad",
    "rate": "rad/s",
    "displacement": "m",
    "top_displacement": "m",
}


def _columns(response: RockingResponse) -> tuple[dict[str, NDArray[Any]], dict[str, str]]:
    """The time and the histories of a response, and their units."""

    names = ["ground_acceleration"]
    if response.motion.vertical is not None:
        names.append("vertical_ground_acceleration")
    columns = {"time": response.time, **{name: history(response, name) for name in names}}
    columns |= {"rotation": response.rotation, "rate": response.rate}
    if isinstance(response.block, RockingBlock):
        columns |= {
            "displacement": response.displacement,
            "top_displacement": response.top_displacement,
        }
    return columns, {name: _UNITS[name] for name in columns}


def to_dataframe(response: RockingResponse) -> Any:
    """The histories as a pandas DataFrame; see `RockingResponse.to_dataframe`."""
    return frame_of(*_columns(response), "RockingResponse.to_dataframe", index="time")


def to_csv(response: RockingResponse, path: str | os.PathLike[str]) -> Path:
    """Write the histories to a file; see `RockingResponse.to_csv`."""
    return write_csv(*_columns(response), path)


def to_xarray(response: RockingResponse) -> Any:
    """The histories as an xarray Dataset; see `RockingResponse.to_xarray`."""
    attrs = {
        "block": repr(response.block),
        "motion": response.motion.name,
        "peak_rotation": response.peak_rotation,
        "peak_rotation_units": "rad",
        "overturned": response.overturned or "",
    }
    return dataset_of(*_columns(response), "RockingResponse.to_xarray", attrs)


_OF_RIGID = ("residual", "sliding_distance", "time_sliding", "liftoffs", "impacts_with_slip")
_RESULTS = (
    *("peak_rotation", "peak_time", "peak_rotation_ratio", "overturned", "overturned_at"),
    *("impacts", "uplifts", "time_rocking", "at_rest", "margin", "condition", "remark"),
)


def to_json(response: RockingResponse) -> str:
    """The results and histories as JSON; see `RockingResponse.to_json`."""
    columns, units = _columns(response)
    names = (*_RESULTS, *(_OF_RIGID if isinstance(response.block, RockingBlock) else ()))
    document = {
        "stickslip": build_info()["version"],
        "block": repr(response.block),
        "motion": response.motion.name,
        "components": response.components,
        **{name: getattr(response, name) for name in names},
        "units": units,
        **columns,
        "events": response.events,
    }
    return json_text(document)


def response_html(response: RockingResponse) -> str:
    """A table of the main results of a response."""
    if response.overturned:
        outcome = ("overturned", f"to the {response.overturned}")
        when = ("certain at", f"{response.overturned_at:.4g} s")
    else:
        ratio = f"{response.peak_rotation_ratio:.4g} alpha"
        outcome = ("peak rotation", f"{response.peak_rotation:.4g} rad, {ratio}")
        when = ("time of the peak", f"{response.peak_time:.4g} s")
    rows = [
        ("block", repr(response.block)),
        ("ground motion", printable(response.motion.name) or repr(response.motion)),
        outcome,
        when,
        ("impacts", f"{response.impacts:,}"),
        ("time rocking", f"{response.time_rocking:.4g} s"),
        ("margin of the nearest decision", f"{response.margin:.3g}"),
    ]
    if isinstance(response.block, RockingBlock):
        rows += [
            ("displacement of the base at the end", f"{response.residual:.4g} m"),
            ("path slipped", f"{response.sliding_distance:.4g} m"),
        ]
    else:
        rows.append(("condition", f"{response.condition:.3g}"))
    if response.remark:
        rows.append(("remark", response.remark))
    return html_table("Response of a block that rocks", [], rows)
