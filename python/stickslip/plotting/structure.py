"""Structures: shapes of modes, and responses with the peaks of the floors by height."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, overload

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure, FigureBase
from numpy.typing import NDArray

from .._core import (
    STANDARD_GRAVITY,
    Ensemble,
    EquipmentOnFloor,
    FlexibleSlope,
    StructureResponse,
)
from .._structure_responses import has_drifts, has_floors
from .figures import Place, given_or_new
from .panels import draw_stops, mark_end, mark_peak, near_stops, shade_sticks
from .styles import BLUE, COLORS, GRAY, VERMILION, put_figure_title, put_title, style
from .trajectory import sticks, window
from .words import describe_ensemble, describe_system, unit_for, with_remark

_BANDS = (0.05, 0.16, 0.5, 0.84, 0.95)
_ACCELERATION, _DRIFT = "largest absolute acceleration [g]", "largest drift [mm]"


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

    The first panel shades the sticks, marks peak and residual, and draws stops near the
    displacement as lines; the remark of the response is over it. Of equipment, the floor that it
    stands on is marked.

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
        acceleration [g], from the base up, or from the ground where equipment slides on a floor,
        and, if its influence is ones, largest drift [mm] by floor. A `FlexibleSlope` has no floors.
    """
    system = response.system
    slope = isinstance(system, FlexibleSlope)  # its column has a top, but no floors
    floors = response.floors if has_floors(response) and not slope else None
    with style():
        figure = given_or_new(figure, 7, 5.5 if floors is not None else 3)
        if floors is None:
            top = figure.subplots()
        else:
            grid = figure.add_gridspec(2, 2, height_ratios=(1, 1.3))
            top = figure.add_subplot(grid[0, :])
        _draw_interface(top, response, title)
        if floors is not None:
            lowest = "ground" if isinstance(system, EquipmentOnFloor) else "base"
            peaks = np.append(response.peak_base_acceleration, floors.peak_acceleration)
            panels = [(0, peaks / STANDARD_GRAVITY, _ACCELERATION)]
            if has_drifts(response):
                panels.append((1, floors.peak_drift * 1e3, _DRIFT))
            for k, (first, values, name) in enumerate(panels):
                panel = figure.add_subplot(grid[1, k] if len(panels) > 1 else grid[1, :])
                number = np.arange(first, len(peaks))
                panel.plot(values, number, "o-", color=VERMILION, markersize=4, clip_on=False)
                _set_floors(panel, number, name, lowest)
                if isinstance(system, EquipmentOnFloor) and first == 0:
                    panel.annotate(
                        "equipment",
                        (values[system.floor], system.floor),
                        xytext=(-7, 0),
                        textcoords="offset points",
                        ha="right",
                        va="center",
                        fontsize=8,
                    )
        return figure


def _draw_interface(axes: Axes, response: StructureResponse, title: str | None) -> None:
    """Draw the displacement of the interface with its sticks, stops, peak, residual and remark."""
    below = with_remark(describe_system(response.system), response)
    put_title(axes, response.motion, title, below)
    curve = response._curve()
    t, x = curve["time"], curve["displacement"]
    length, unit = unit_for(response.peak)
    begin, end = window("plot_structure_response", response, None)
    slope = isinstance(response.system, FlexibleSlope)
    stops = [] if slope else near_stops(response.system.slider, response.peak)
    stops = [length * y for y in stops]
    shade_sticks(axes, sticks(response))
    axes.axhline(0, color=GRAY, linewidth=0.6, zorder=0)
    axes.plot(t, x * length, color=BLUE)
    axes.set_xlim(begin, end)
    mark_peak(axes, t, x * length, unit, response.peak * length, stops)
    mark_end(axes, response, t, x, length, unit, end)
    draw_stops(axes, stops, unit, t[np.abs(x).argmax()])
    axes.set_xlabel("time [s]; shaded: stuck")
    axes.set_ylabel(f"{'sliding' if slope else 'relative'} displacement\n[{unit}]")


def _set_floors(axes: Axes, number: NDArray[np.int_], name: str, lowest: str) -> None:
    """Set axes of values by floor, with room for the dots at their ends; floor 0 is `lowest`."""
    axes.set_xlim(left=0)
    axes.set_ylim(number[0] - 0.25, number[-1] + 0.25)
    ticks = number[:: 1 + len(number) // 12]
    axes.set_yticks(ticks, [f"{k}" if k else lowest for k in ticks])
    axes.set_xlabel(name)
    axes.set_ylabel("floor")


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
        With axes for the largest absolute acceleration [g], from the base up, and the largest drift
        [mm]: the median, and bands from the 16 % to the 84 % and from the 5 % to the 95 % quantile.

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
        kind = peaks.configuration["slider"]
        on_ground, slope = "equipment_on_floor" in kind, "flexible_slope" in kind
    else:
        accelerations, drifts, base = _peaks_of(peaks)
        heading = f"{len(peaks)} responses"
        thin = len(peaks) <= 50
        on_ground, slope = (
            isinstance(peaks[0].system, kind) for kind in (EquipmentOnFloor, FlexibleSlope)
        )
    with style():
        figure = given_or_new(figure, 7, 4)
        put_figure_title(figure, title or heading)
        for panel, values, first, name in zip(
            figure.subplots(1, 2),
            (np.column_stack([base, accelerations]) / STANDARD_GRAVITY, drifts * 1e3),
            (0, 1),
            (_ACCELERATION, _DRIFT),
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
            panel.plot(
                bands[2], number, "o-", color=BLUE, markersize=4, label="median", clip_on=False
            )
            if thin:
                panel.plot(values.T, number, color=GRAY, linewidth=0.4, zorder=1)
            _set_floors(panel, number, name, "ground" if on_ground else "base")
            if slope:
                panel.set(ylabel="", yticks=number, yticklabels=["base", "top"][first:])
        above = {"loc": "lower right", "bbox_to_anchor": (1, 1), "ncols": 3}
        figure.axes[-1].legend(**above, fontsize=8)
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
        figure = given_or_new(figure, 4, 4)
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
