"""Responses in the plane: the path as on a map."""

from __future__ import annotations

from typing import overload

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure, FigureBase
from matplotlib.text import OffsetFrom

from .. import _core
from .._core import GroundMotion, PlanarResponse
from .figures import Place, given_or_new
from .panels import shade_sticks
from .styles import AT_RIGHT, BLUE, GRAY, INK, VERMILION, put_title, style
from .trajectory import sticks, window
from .words import describe, digits, in_places, unit_for, with_remark


@overload
def plot_planar_response(
    response: PlanarResponse,
    figure: None = None,
    title: str | None = None,
    *,
    time: tuple[float, float] | None = None,
) -> Figure: ...
@overload
def plot_planar_response(
    response: PlanarResponse,
    figure: Place,
    title: str | None = None,
    *,
    time: tuple[float, float] | None = None,
) -> Place: ...
def plot_planar_response(
    response: PlanarResponse,
    figure: FigureBase | None = None,
    title: str | None = None,
    *,
    time: tuple[float, float] | None = None,
) -> FigureBase:
    """Plot the path of a response in the plane as on a map, and its components over time.

    On the map the axis of the ground motion points upward and the transverse direction, 90 degrees
    clockwise from it, to the right; an arrow shows north if the orientation of the ground motion is
    an azimuth. The map marks the start, the places at which the slider came to rest, the peak with
    its time, and the residual; a circular stop near the path is a circle. The panels below show
    both components of the displacement; they shade the sticks.

    Parameters
    ----------
    response : PlanarResponse
        The result of `integrate` for a `PlanarSlider`.
    figure : matplotlib Figure or SubFigure, optional
        Where to draw; default: a new figure of 7 x 8.5 inches.
    title : str, optional
        Default: the name of the ground motion.
    time : tuple of float, optional
        Begin and end of the part of the panels to draw [s], such as (0, 25); default: all of the
        response. The map has the whole path.

    Returns
    -------
    matplotlib Figure or SubFigure
        With these axes: the map, the displacement along the axis, and that along the transverse
        direction.

    Raises
    ------
    ValueError
        A time that does not begin before it ends, or lies outside the response.
    """
    begin, finish = window("plot_planar_response", response, time)
    with style():
        figure = given_or_new(figure, 7, 8.5)
        plan, axis, transverse = figure.subplots(3, height_ratios=(3.2, 1, 1))
        transverse.sharex(axis)
        t, place = path_of(response)
        length, unit = unit_for(response.peak)
        below = with_remark(describe(response.slider.along_axis), response)
        put_title(plan, response.motion, title, below)
        _draw_map(plan, response, place, length, unit)
        spans = sticks(response)
        for k, (panel, name) in enumerate(((axis, "axis"), (transverse, "transverse"))):
            shade_sticks(panel, spans)
            panel.plot(t, place[:, k] * length, color=BLUE, linewidth=1.1)
            panel.axhline(0, color=GRAY, linewidth=0.6, zorder=0)
            panel.set_ylabel(f"{name}\n[{unit}]")
            if response.peak > 0:
                panel.plot(
                    response.peak_time,
                    response.peak_displacement[k] * length,
                    "o",
                    color=VERMILION,
                    markersize=4,
                    zorder=4,
                )
            else:
                panel.set_ylim(-1, 1)
            end = float(np.interp(finish, t, place[:, k]))
            at = "residual" if response.at_rest else "still sliding, at"
            panel.annotate(
                f"{at if finish >= t[-1] else 'here at'}\n"
                f"{in_places(end, response.peak, length)} {unit}",
                (1, end * length),
                **{**AT_RIGHT, "xycoords": ("axes fraction", "data")},
                va="center",
                color=BLUE,
            )
        axis.set_xlim(begin, finish)
        axis.tick_params(labelbottom=False)
        transverse.set_xlabel("time [s]")
        figure.align_ylabels([axis, transverse])
    return figure


def _draw_map(
    plan: Axes, response: PlanarResponse, place: np.ndarray, length: float, unit: str
) -> None:
    """Draw the path with the axis upward and the transverse direction to the right."""
    right, up = place[:, 1] * length, place[:, 0] * length
    plan.plot(right, up, color=BLUE, linewidth=1.0, label="path")
    plan.plot(right[0], up[0], "+", color=INK, markersize=9, zorder=3, label="start")

    events = response.events
    rests = events["displacement"][events["kind"] == "arrest"] * length
    if len(rests):
        plan.plot(
            rests[:, 1],
            rests[:, 0],
            "o",
            color=INK,
            markerfacecolor="white",
            markersize=3.5,
            markeredgewidth=0.8,
            linestyle="none",
            zorder=3,
            label="rests",
        )
    draw_stop(plan, response, length)
    end = response.residual * length
    name = "residual" if response.at_rest else "still sliding"
    distance = in_places(float(np.hypot(*response.residual)), response.peak, length)
    plan.plot(
        end[1], end[0], "o", color=BLUE, markersize=6, zorder=4, label=f"{name}, {distance} {unit}"
    )
    if response.peak > 0:
        peak = response.peak_displacement * length
        toward = response.peak_azimuth
        where = "" if toward is None else f", toward {toward:.0f}\N{DEGREE SIGN}"
        plan.plot(
            peak[1],
            peak[0],
            "o",
            color=VERMILION,
            markersize=6,
            zorder=5,
            label=f"peak {digits(response.peak * length)} {unit}\n"
            f"at {digits(response.peak_time)} s{where}",
        )
        make_square(plan)
    else:
        plan.annotate("never slips", (0.5, 0.6), xycoords="axes fraction", ha="center", color=GRAY)
        plan.set(xlim=(-1, 1), ylim=(-1, 1))
    plan.set_aspect("equal", adjustable="box", anchor="W")
    downhill = ", downhill" if response.slider.slope_degrees > 0 else ""
    name_directions(plan, response.motion, unit, downhill)
    legend = plan.legend(loc="upper left", bbox_to_anchor=(1, 0.82), fontsize=8, borderaxespad=0.4)
    legend.set_in_layout(False)  # there is room at the right of the square


def draw_stop(plan: Axes, response: PlanarResponse, length: float) -> None:
    """Draw a circular stop that the path comes near; else the path would be drawn small."""
    stops = response.slider.stops
    if stops is not None and response.peak > stops.gap / 1.25:
        turn = np.linspace(0, 2 * np.pi, 361)
        gap = stops.gap * length
        plan.plot(gap * np.cos(turn), gap * np.sin(turn), color=INK, linewidth=1.2, label="stop")


def name_directions(plan: Axes, motion: GroundMotion, unit: str, downhill: str = "") -> None:
    """Name the axes of a map, with their azimuths and an arrow to the north if they are known."""
    azimuth = _core._azimuth_of(motion.orientation)
    sides = ("", "") if azimuth is None else (_toward(azimuth), _toward(azimuth + 90))
    plan.set_ylabel(f"along the axis{sides[0]}{downhill} [{unit}]")
    plan.set_xlabel(f"transverse{sides[1]} [{unit}]")
    plan.axhline(0, color=GRAY, linewidth=0.5, zorder=0)
    plan.axvline(0, color=GRAY, linewidth=0.5, zorder=0)
    if azimuth is not None:
        _draw_north(plan, azimuth)


def make_square(plan: Axes) -> None:
    """Give both directions of the map the same range, around what is drawn."""
    low, high = (np.array(bound) for bound in (plan.dataLim.min, plan.dataLim.max))
    center, half = (low + high) / 2, 0.54 * max(high - low)
    plan.set(xlim=(center[0] - half, center[0] + half), ylim=(center[1] - half, center[1] + half))


def _toward(azimuth: float) -> str:
    return f", azimuth {azimuth % 360:.4g}\N{DEGREE SIGN}"


def _draw_north(plan: Axes, azimuth: float) -> None:
    """Draw an arrow to the north at the right of the map, whose upward direction is `azimuth`."""
    turn = np.radians(-azimuth)  # of north, clockwise from upward
    toward = np.array([np.sin(turn), np.cos(turn)])
    center = np.array([34, -30])  # [points] from the upper right corner
    at = {"xycoords": "axes fraction", "textcoords": "offset points", "annotation_clip": False}
    corner = OffsetFrom(plan, (1, 1))  # in points from it
    plan.annotate(
        "",
        xy=tuple(center + 15 * toward),
        xytext=tuple(center - 15 * toward),
        xycoords=corner,
        textcoords=corner,
        arrowprops={"arrowstyle": "-|>", "color": INK},
        annotation_clip=False,
    )
    plan.annotate("N", (1, 1), xytext=tuple(center + 23 * toward), ha="center", va="center", **at)


def path_of(response: PlanarResponse) -> tuple[np.ndarray, np.ndarray]:
    """Times [s] and displacements [m] to draw: samples, events, the tail, and the curve between.

    Where the slider moves, up to 31 points, 100,000 in all, are between any two of them.
    """
    events = response.events
    t = np.unique(np.concatenate([response.time, events["time"]]))
    last = events["time"][-1]  # it is at rest after it
    moves = ~response.at(np.minimum((t[:-1] + t[1:]) / 2, last))["stuck"]
    parts = int(np.clip(100_000 // max(moves.sum(), 1), 2, 32))
    between = t[:-1][moves, None] + np.diff(t)[moves, None] * np.arange(1, parts) / parts
    t = np.sort(np.concatenate([t, between.ravel()]))
    return t, response.at(np.minimum(t, last))["displacement"]
