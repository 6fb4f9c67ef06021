"""Structures: shapes of modes, and responses with the peaks of the floors by height."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, overload

import numpy as np
from matplotlib.figure import Figure, FigureBase
from numpy.typing import NDArray

from .._core import Ensemble, StructureResponse
from .._tables import has_drifts, has_floors
from .figures import Place, new_figure
from .styles import BLUE, COLORS, GRAY, VERMILION, put_figure_title, put_title, style
from .words import describe_ensemble, unit_for

_BANDS = (0.05, 0.16, 0.5, 0.84, 0.95)


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
        acceleration and, if its influence is ones, largest drift by floor.
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
            number = np.arange(1, len(floors.peak_acceleration) + 1)
            panels = [(floors.peak_acceleration, "largest absolute acceleration [m/s²]")]
            if has_drifts(response):
                length, unit = unit_for(float(floors.peak_drift.max()))
                panels.append((floors.peak_drift * length, f"largest drift [{unit}]"))
            for k, (values, name) in enumerate(panels):
                panel = figure.add_subplot(grid[1, k] if len(panels) > 1 else grid[1, :])
                panel.plot(values, number, "o-", color=VERMILION, markersize=4)
                panel.set_xlim(left=0)
                panel.set_yticks(number[:: 1 + len(number) // 12])
                panel.set_xlabel(name)
                panel.set_ylabel("floor")
        return figure


@overload
def plot_floors(
    peaks: Ensemble | Sequence[StructureResponse], figure: None = None, title: str | None = None
) -> Figure: ...
@overload
def plot_floors(
    peaks: Ensemble | Sequence[StructureResponse], figure: Place, title: str | None = None
) -> Place: ...
def plot_floors(
    peaks: Ensemble | Sequence[StructureResponse],
    figure: FigureBase | None = None,
    title: str | None = None,
) -> FigureBase:
    """Plot the peaks of the floors by height, with their quantiles over members or records.

    Up to 50 responses are also drawn as thin lines.

    Parameters
    ----------
    peaks : Ensemble or list of StructureResponse
        Of structures with floors, at least two: an ensemble, or the responses to several records.
    figure : matplotlib Figure or SubFigure, optional
        Where to draw; default: a new figure of 7 x 4 inches.
    title : str, optional
        Default: the number of members, and the structure; or the number of responses.

    Returns
    -------
    matplotlib Figure or SubFigure
        With axes for the largest absolute acceleration, from the base up, and the largest drift:
        the median, and bands from the 16 % to the 84 % and from the 5 % to the 95 % quantile.

    Raises
    ------
    ValueError
        Sliders; structures without floors, with different numbers of them, or with an influence
        that is not ones; fewer than two members or responses.
    TypeError
        An item that is not a StructureResponse.
    """
    if isinstance(peaks, Ensemble):
        heading = describe_ensemble(peaks)
        accelerations = peaks.peak_floor_acceleration.values
        drifts, base = peaks.peak_floor_drift.values, peaks.peak_base_acceleration
        thin = False
        _require_some(*accelerations.shape)
    else:
        accelerations, drifts, base = _peaks_of(peaks)
        heading = f"{len(peaks)} responses"
        thin = len(peaks) <= 50
    length, unit = unit_for(float(drifts.max()))
    with style():
        figure = figure or new_figure(7, 4)
        put_figure_title(figure, title or heading)
        for panel, values, first, name in zip(
            figure.subplots(1, 2),
            (np.column_stack([base, accelerations]), drifts * length),
            (0, 1),
            ("largest absolute acceleration [m/s²]", f"largest drift [{unit}]"),
        ):
            number = np.arange(first, accelerations.shape[1] + 1)
            bands = np.quantile(values, _BANDS, axis=0, method="inverted_cdf")
            for low, high, opacity, label in (
                (0, 4, 0.15, "5 to 95 %"),
                (1, 3, 0.3, "16 to 84 %"),
            ):
                panel.fill_betweenx(
                    number,
                    bands[low],
                    bands[high],
                    color=BLUE,
                    alpha=opacity,
                    linewidth=0,
                    label=label,
                )
            panel.plot(bands[2], number, "o-", color=BLUE, markersize=4, label="median")
            if thin:
                panel.plot(values.T, number, color=GRAY, linewidth=0.4, zorder=1)
            panel.set_xlim(left=0)
            panel.set_yticks(number[:: 1 + len(number) // 12])
            panel.set_xlabel(name)
            panel.set_ylabel("floor")
        figure.axes[-1].legend(loc="best", fontsize=8)
        return figure


def _require_some(members: int, floors: int) -> None:
    if floors == 0:
        raise ValueError(
            "plot_floors: the structure has no floors; give Structure.from_modes the shapes"
        )
    if members < 2:
        raise ValueError(f"plot_floors: needs at least two members or responses, got {members}")


def _peaks_of(
    responses: Sequence[StructureResponse],
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Accelerations and drifts of the floors, shape (responses, floors), and of the base."""
    if not isinstance(responses, Sequence):
        raise TypeError(
            "plot_floors: needs an Ensemble or a list of StructureResponse, got"
            f" {type(responses).__name__}"
        )
    for i, one in enumerate(responses):
        if not isinstance(one, StructureResponse):
            raise TypeError(
                f"plot_floors: item {i} must be a StructureResponse, got {type(one).__name__}"
            )
    counts = [len(one.floors.peak_acceleration) if has_floors(one) else 0 for one in responses]
    if len(set(counts)) > 1:
        odd = next(i for i, count in enumerate(counts) if count != counts[0])
        raise ValueError(
            "plot_floors: structures must have the same number of floors, got"
            f" {counts[0]} and, in response {odd}, {counts[odd]}"
        )
    _require_some(len(responses), min(counts, default=1))
    return (
        np.array([one.floors.peak_acceleration for one in responses]),
        np.array([one.floors.peak_drift for one in responses]),
        np.array([one.peak_base_acceleration for one in responses]),
    )


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
