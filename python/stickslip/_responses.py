"""Responses as tables: for pandas and xarray, in CSV files, JSON and notebooks.

Each function here is the method of that name of the responses of all systems. What differs between
systems, the function `describe` of a module of each tells as `Described`; see `_MODULES`.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ._core import (
    CartResponse,
    PlanarResponse,
    Response,
    RockingResponse,
    StructureResponse,
    build_info,
)
from ._optional import optional
from ._tables import frame_of, html_table, json_text, write_csv
from ._text import printable

if TYPE_CHECKING:
    from typing import TypeAlias

    from numpy.typing import NDArray

    AnyResponse: TypeAlias = (
        Response | PlanarResponse | StructureResponse | CartResponse | RockingResponse
    )

__all__ = [
    "GROUND",
    "TEMPERATURE",
    "VERTICAL",
    "Described",
    "History",
    "ground_motion_row",
    "loop_rows",
    "response_html",
    "to_csv",
    "to_dataframe",
    "to_json",
    "to_xarray",
]

# Imported on first use.
_MODULES: dict[type, str] = {
    Response: "._slider_responses",
    PlanarResponse: "._slider_responses",
    StructureResponse: "._structure_responses",
    CartResponse: ".carts.responses",
    RockingResponse: ".rocking.responses",
}


class History(NamedTuple):
    """A history of a response: the attribute of this name, unless values are given.

    `<vector>_axis` and `<vector>_transverse` are the components of an attribute, and names with
    `ground_acceleration` those of the ground motion.
    """

    name: str
    unit: str
    description: str
    values: NDArray[Any] | None = None


_TIME = History("time", "s", "time")
GROUND = History("ground_acceleration", "m/s^2", "ground acceleration")
VERTICAL = History(
    "vertical_ground_acceleration", "m/s^2", "vertical ground acceleration, positive upward"
)
TEMPERATURE = History("temperature", "degC", "temperature of the sliding surface")


@dataclass(frozen=True)
class Described:
    """What the tables of a response show.

    Attributes
    ----------
    system : str
        The attribute with what responds; also its name in JSON and in a Dataset.
    title : str
        Of the table in a notebook.
    histories : sequence of History
        In all tables, after the time.
    results : sequence of str
        The attributes in JSON.
    attributes : mapping of str to str
        The attributes that a Dataset has, with their units.
    rows : callable
        Makes the rows of the table in a notebook, without the remark.
    floor_columns : sequence of History
        In all tables but a Dataset, after the others.
    floors : sequence of History
        In a Dataset in their place, over time and floor.
    floor_peaks : mapping
        At the end of JSON.
    """

    system: str
    title: str
    histories: Sequence[History]
    results: Sequence[str]
    attributes: Mapping[str, str]
    rows: Callable[[Any], list[tuple[str, str]]]
    floor_columns: Sequence[History] = ()
    floors: Sequence[History] = ()
    floor_peaks: Mapping[str, NDArray[np.float64]] = field(default_factory=dict)


def to_dataframe(response: AnyResponse) -> Any:
    """The histories as a pandas DataFrame over time."""
    return frame_of(*_table(response), _method(response, "to_dataframe"), index="time")


def to_xarray(response: AnyResponse) -> Any:
    """The histories as an xarray Dataset over time and, of a structure, the floors."""
    xarray = optional("xarray", "tables", _method(response, "to_xarray"))
    told = _described(response)

    def variables(histories: Iterable[History], *over: str) -> dict[str, Any]:
        return {
            one.name: (
                over,
                _values(response, one),
                {"long_name": one.description} | ({"units": one.unit} if one.unit else {}),
            )
            for one in histories
        }

    coordinates = variables([_TIME], "time")
    for one in told.floors[:1]:
        numbers = np.arange(1, _values(response, one).shape[1] + 1)
        coordinates["floor"] = ("floor", numbers, {"long_name": "floor, from 1, the lowest"})
    attributes = {
        told.system: repr(getattr(response, told.system)),
        "motion": response.motion.name,
    }
    for name, unit in told.attributes.items():
        value = getattr(response, name)
        attributes[name] = "" if value is None else value
        if unit:
            attributes[f"{name}_units"] = unit
    return xarray.Dataset(
        variables(told.histories, "time") | variables(told.floors, "time", "floor"),
        coordinates,
        attributes,
    )


def to_csv(response: AnyResponse, path: str | os.PathLike[str]) -> Path:
    """Write the histories to a file."""
    return write_csv(*_table(response), path)


def to_json(response: AnyResponse) -> str:
    """The results and histories as JSON."""
    told = _described(response)
    columns, units = _table(response)
    document = {
        "stickslip": build_info()["version"],
        told.system: repr(getattr(response, told.system)),
        "motion": response.motion.name,
        "components": response.components,
        **{name: getattr(response, name) for name in told.results},
        "units": {name: unit for name, unit in units.items() if unit},
        **columns,
        "events": response.events,
        **told.floor_peaks,
    }
    return json_text(document)


def response_html(response: AnyResponse) -> str:
    """A table of the main results, for notebooks."""
    told = _described(response)
    rows = told.rows(response)
    if response.remark:
        rows.append(("remark", response.remark))
    return html_table(told.title, [], rows)


def ground_motion_row(response: AnyResponse) -> tuple[str, str]:
    """The name of the ground motion as a row of a table in a notebook."""
    return "ground motion", printable(response.motion.name) or repr(response.motion)


def loop_rows(response: Response | StructureResponse) -> list[tuple[str, str]]:
    """Effective period and damping as rows of a table; none without a loop."""
    try:
        return [
            ("effective period", f"{response.effective_period:.4g} s"),
            ("effective damping", f"{100 * response.effective_damping:.3g} %"),
        ]
    except ValueError:
        return []


_COMPONENTS = ("axis", "transverse")


def _described(response: AnyResponse) -> Described:
    """What the module of its system tells of a response."""
    module = next(name for kind, name in _MODULES.items() if isinstance(response, kind))
    described: Described = import_module(module, __package__).describe(response)
    return described


def _method(response: AnyResponse, name: str) -> str:
    return f"{type(response).__name__}.{name}"


def _table(response: AnyResponse) -> tuple[dict[str, NDArray[Any]], dict[str, str]]:
    """The time and the histories, and their units."""
    told = _described(response)
    histories = (_TIME, *told.histories, *told.floor_columns)
    columns = {one.name: _values(response, one) for one in histories}
    return columns, {one.name: one.unit for one in histories}


def _values(response: AnyResponse, history: History) -> NDArray[Any]:
    """A writable copy of the values of a history."""
    name = history.name
    if history.values is not None:
        return np.array(history.values)
    if "ground_acceleration" in name:
        ground = np.zeros(response.time.size)
        motion = response.motion
        which = next((c for c in ("vertical", "transverse") if c in name), "acceleration")
        ground[: len(motion)] = getattr(motion, which)
        return ground
    vector, _, component = name.rpartition("_")
    if component in _COMPONENTS:
        return np.array(getattr(response, vector)[:, _COMPONENTS.index(component)])
    return np.array(getattr(response, name))
