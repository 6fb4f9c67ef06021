"""Modes of structures, and tables of their responses."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ._core import StructureResponse, build_info
from ._optional import optional
from ._tables import (
    Columns,
    frame_of,
    has_drifts,
    has_floors,
    html_table,
    json_text,
    loop_rows,
    write_csv,
)
from ._tabular import Tabular
from ._text import printable

if TYPE_CHECKING:
    from matplotlib.figure import Figure, FigureBase


@dataclass(frozen=True, eq=False)
class Modes(Tabular):
    """The modes of a structure on a fixed base, in order of frequency.

    Attributes
    ----------
    frequencies : ndarray, shape (n,)
        w [rad/s]; 0 for a rigid-body mode.
    damping_ratios : ndarray, shape (n,)
        Diagonal of the modal damping, divided by 2 w.
    participation : ndarray, shape (n,)
        shape' M influence [kg^(1/2)]; with `from_modes`, the square roots of the mass fractions.
    effective_masses : ndarray, shape (n,)
        participation squared [kg]; with `from_modes`, the mass fractions.
    shapes : ndarray, shape (floors, n)
        One column per mode, with shape' M shape = 1.

    Notes
    -----
    Objects compare by content. Tables have one row per mode, counted from 1: columns `mode`,
    `frequency` [rad/s], `period` [s], `damping_ratio`, `participation`, `effective_mass` and
    `cumulative_mass`, the fraction of the mass of all modes up to this one.
    """

    frequencies: NDArray[np.float64]
    damping_ratios: NDArray[np.float64]
    participation: NDArray[np.float64]
    effective_masses: NDArray[np.float64]
    shapes: NDArray[np.float64]
    _index = "mode"

    def __repr__(self) -> str:
        count = len(self.frequencies)
        first = f", first period {self.periods.max():.4g} s" if count else ""
        return f"<Modes: {count} mode{'' if count == 1 else 's'}{first}>"

    @property
    def periods(self) -> NDArray[np.float64]:
        """2 pi / w [s], shape (n,); infinite for a rigid-body mode."""
        with np.errstate(divide="ignore"):
            return 2 * np.pi / self.frequencies

    def _table(self) -> tuple[Columns, dict[str, str]]:
        mass = self.effective_masses
        columns = {
            "mode": np.arange(1, len(mass) + 1),
            "frequency": self.frequencies,
            "period": self.periods,
            "damping_ratio": self.damping_ratios,
            "participation": self.participation,
            "effective_mass": mass,
            "cumulative_mass": np.cumsum(mass) / np.sum(mass),
        }
        return columns, {"frequency": "rad/s", "period": "s"}

    def plot(self, *, figure: FigureBase | None = None, title: str | None = None) -> Figure:
        """Plot the shapes of the first modes by height.

        Parameters
        ----------
        figure : matplotlib Figure or SubFigure, optional
            Where to draw; default: a new figure.
        title : str, optional
            Default: none.

        Returns
        -------
        matplotlib Figure or SubFigure

        Raises
        ------
        ValueError
            The structure was made by `from_modes` without shapes.
        """
        from .plotting import plot_modes

        return plot_modes(self, figure, title)


_HISTORIES = {
    "ground_acceleration": "m/s^2",
    "displacement": "m",
    "velocity": "m/s",
    "base_acceleration": "m/s^2",
    "demand": "m/s^2",
    "force": "m/s^2",
}


def _columns(
    response: StructureResponse,
) -> tuple[dict[str, NDArray[Any]], dict[str, str]]:
    """The time and the histories of a response, and their units."""
    ground = np.zeros(len(response.time))
    ground[: len(response.motion.acceleration)] = response.motion.acceleration
    columns = {"time": response.time, "ground_acceleration": ground}
    columns |= {n: getattr(response, n) for n in _HISTORIES if n != "ground_acceleration"}
    units = {"time": "s"} | _HISTORIES
    if response.temperature is not None:
        columns["temperature"] = response.temperature
        units["temperature"] = "degC"
    if has_floors(response):
        floors = response.floors
        for i in range(floors.displacement.shape[1]):
            for name, values, unit in (
                ("displacement", floors.displacement, "m"),
                ("acceleration", floors.acceleration, "m/s^2"),
            ):
                columns[f"floor_{i + 1}_{name}"] = values[:, i]
                units[f"floor_{i + 1}_{name}"] = unit
    return columns, units


def to_dataframe(response: StructureResponse) -> Any:
    """The histories as a pandas DataFrame; see `StructureResponse.to_dataframe`."""
    return frame_of(*_columns(response), "StructureResponse.to_dataframe", index="time")


def to_csv(response: StructureResponse, path: str | os.PathLike[str]) -> Path:
    """Write the histories to a file; see `StructureResponse.to_csv`."""
    return write_csv(*_columns(response), path)


def to_xarray(response: StructureResponse) -> Any:
    """The histories as an xarray Dataset; see `StructureResponse.to_xarray`."""
    xarray = optional("xarray", "tables", "StructureResponse.to_xarray")
    columns, units = _columns(response)
    at = columns.pop("time")
    variables: dict[str, Any] = {
        name: ("time", values, {"units": units[name]})
        for name, values in columns.items()
        if not name.startswith("floor_")
    }
    coords: dict[str, Any] = {"time": ("time", at, {"units": "s"})}
    if has_floors(response):
        floors = response.floors
        histories = {"displacement": "m", "acceleration": "m/s^2"}
        if has_drifts(response):
            histories["drift"] = "m"
        for name, unit in histories.items():
            values = getattr(floors, name)
            variables[f"floor_{name}"] = (("time", "floor"), values, {"units": unit})
        coords["floor"] = ("floor", np.arange(1, floors.displacement.shape[1] + 1))
    return xarray.Dataset(
        variables,
        coords=coords,
        attrs={
            "system": repr(response.system),
            "motion": response.motion.name,
            "peak": response.peak,
            "peak_units": "m",
            "residual": response.residual,
            "residual_units": "m",
        },
    )


def response_html(response: StructureResponse) -> str:
    """A table of the main results of a response."""
    rows = [
        ("structure", repr(response.system)),
        ("ground motion", printable(response.motion.name) or repr(response.motion)),
        ("peak displacement", f"{response.peak:.4g} m"),
        (
            "residual displacement" if response.at_rest else "displacement at the end, sliding",
            f"{response.residual:.4g} m",
        ),
        ("slips", f"{response.slips:,}"),
        ("time sliding", f"{response.time_sliding:.4g} s"),
        ("peak acceleration of the base", f"{response.peak_base_acceleration:.4g} m/s²"),
    ]
    if has_floors(response):
        largest = response.floors.peak_acceleration
        rows.append(
            (
                "largest floor acceleration",
                f"{largest.max():.4g} m/s², floor {largest.argmax() + 1}",
            )
        )
    if has_drifts(response):
        largest = response.floors.peak_drift
        rows.append(("largest drift", f"{largest.max():.4g} m, floor {largest.argmax() + 1}"))
    if response.temperature is not None:
        rows.append(("highest temperature", f"{response.temperature.max():.4g} °C, at samples"))
    if len(response.impacts):
        rows.append(("impacts on stops", f"{len(response.impacts):,}"))
    rows += loop_rows(response)
    if response.remark:
        rows.append(("remark", response.remark))
    return html_table("Response of a structure", [], rows)


_RESULTS = (
    *("peak", "residual", "sliding_distance", "at_rest", "settled", "margin"),
    *("peak_base_acceleration", "peak_base_shear"),
)


def to_json(response: StructureResponse) -> str:
    """The results and histories as JSON; see `StructureResponse.to_json`."""
    columns, units = _columns(response)
    document = {
        "stickslip": build_info()["version"],
        "system": repr(response.system),
        "motion": response.motion.name,
        "components": response.components,
        **{name: getattr(response, name) for name in _RESULTS},
        "units": units,
        **columns,
        "events": response.events,
    }
    if has_floors(response):
        document["peak_floor_acceleration"] = response.floors.peak_acceleration
    if has_drifts(response):
        document["peak_drift"] = response.floors.peak_drift
    return json_text(document)
