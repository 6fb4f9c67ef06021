"""Structures: shapes of modes, and responses with the peaks of the floors by height."""

from __future__ import annotations

from typing import Any, overload

import numpy as np
from matplotlib.figure import Figure, FigureBase

from .._core import StructureResponse
from .._tables import has_floors
from .figures import Place, new_figure
from .styles import BLUE, COLORS, GRAY, VERMILION, put_title, style
from .words import unit_for


@overload
def plot_structure_response(
    response: StructureResponse, figure: None = None, title: str | None = None
) -> Figure: ...
@overload
def plot_structure_response(
    response: StructureResponse, figure: Place, title: str | None = None
) -> Place: ...
def plot_structure_response(
    response: StructureResponse, figure: FigureBase | None = None, title: str | None = None
) -> FigureBase:
    """Plot the displacement of the sliding interface, and the peaks of the floors by height.

    Parameters
    ----------
    response : StructureResponse
    figure : matplotlib Figure or SubFigure, optional
        Where to draw; default: a new figure of 7 x 5.5 inches, or 7 x 3 without floors.
    title : str, optional
        Default: the name of the ground motion.

    Returns
    -------
    matplotlib Figure or SubFigure
        With these axes: displacement over time and, if the structure has floors, largest absolute
        acceleration and largest drift by floor.
    """
    floors = response.floors if has_floors(response) else None
    with style():
        figure = figure or new_figure(7, 5.5 if floors is not None else 3)
        if floors is None:
            top = figure.subplots()
        else:
            grid = figure.add_gridspec(2, 2, height_ratios=(1, 1.3))
            top = figure.add_subplot(grid[0, :])
        put_title(top, response.motion, title)
        length, unit = unit_for(response.peak)
        top.axhline(0, color=GRAY, linewidth=0.6, zorder=0)
        top.plot(response.time, response.displacement * length, color=BLUE)
        top.set_xlabel("time [s]")
        top.set_ylabel(f"displacement of the interface\n[{unit}]")
        if floors is not None:
            number = np.arange(1, len(floors.peak_drift) + 1)
            drift_length, drift_unit = unit_for(float(floors.peak_drift.max()))
            for k, (values, name) in enumerate(
                (
                    (floors.peak_acceleration, "largest absolute acceleration [m/s²]"),
                    (floors.peak_drift * drift_length, f"largest drift [{drift_unit}]"),
                )
            ):
                panel = figure.add_subplot(grid[1, k])
                panel.plot(values, number, "o-", color=VERMILION, markersize=4)
                panel.set_xlim(left=0)
                panel.set_yticks(number[:: 1 + len(number) // 12])
                panel.set_xlabel(name)
                panel.set_ylabel("floor")
        return figure


def plot_modes(modes: Any, figure: FigureBase | None = None, title: str | None = None) -> Figure:
    """Plot the shapes of the first six modes by floor, each with its period.

    Parameters
    ----------
    modes : Modes
        Of `Structure.modes`.
    figure : matplotlib Figure or SubFigure, optional
        Where to draw; default: a new figure of 4 x 4 inches.
    title : str, optional

    Returns
    -------
    matplotlib Figure or SubFigure

    Raises
    ------
    ValueError
        There are no shapes.
    """
    if modes.shapes.size == 0:
        raise ValueError(
            "plot_modes: the structure has no shapes; give Structure.from_modes the shapes"
        )
    with style():
        figure = figure or new_figure(4, 4)
        axes = figure.subplots()
        axes.axvline(0, color=GRAY, linewidth=0.6, zorder=0)
        floor = np.arange(len(modes.shapes) + 1)
        for j, color in zip(range(modes.shapes.shape[1]), COLORS):
            shape = np.append(0, modes.shapes[:, j])
            largest = shape[np.argmax(np.abs(shape))]
            axes.plot(
                shape / largest,
                floor,
                "o-",
                color=color,
                markersize=3,
                label=f"{j + 1}: {modes.periods[j]:.3g} s",
            )
        axes.set_yticks(floor[:: 1 + len(floor) // 12])
        axes.set_xlabel("shape, divided by its largest value")
        axes.set_ylabel("floor")
        axes.legend(title="mode: period", fontsize=8)
        if title:
            axes.set_title(title)
        return figure  # type: ignore[return-value]
