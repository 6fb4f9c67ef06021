"""Forces over displacements."""

from __future__ import annotations

from typing import overload

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure, FigureBase

from .._core import (
    STANDARD_GRAVITY,
    MultiPendulum,
    Response,
    StructureResponse,
)
from .figures import Place, one_panel
from .pendulum import name_regimes, sliding_surfaces
from .styles import BLUE, GRAY, VERMILION, put_title, style
from .trajectory import window
from .words import describe, describe_system, digits, unit_for


@overload
def plot_hysteresis(
    response: Response | StructureResponse,
    figure: None = None,
    title: str | None = None,
    *,
    ax: None = None,
    time: tuple[float, float] | None = None,
) -> Figure: ...
@overload
def plot_hysteresis(
    response: Response | StructureResponse,
    figure: Place,
    title: str | None = None,
    *,
    ax: None = None,
    time: tuple[float, float] | None = None,
) -> Place: ...
@overload
def plot_hysteresis(
    response: Response | StructureResponse,
    figure: None = None,
    title: str | None = None,
    *,
    ax: Axes,
    time: tuple[float, float] | None = None,
) -> Axes: ...
def plot_hysteresis(
    response: Response | StructureResponse,
    figure: FigureBase | None = None,
    title: str | None = None,
    *,
    ax: Axes | None = None,
    time: tuple[float, float] | None = None,
) -> FigureBase | Axes:
    """Plot the force between the mass and the ground over the displacement.

    The force is friction + damper + spring over the weight: per unit mass, in g. Of a structure it
    is that of its sliding interface, such as an isolation layer, over the weight of the reference
    mass. If there is a spring, the picture shows the secant of the loop with the largest
    displacement, with `effective_period` and `effective_damping` of the response. In the loops of a
    `MultiPendulum`, numbers beside the lines name the surfaces that slide, from bottom to top; each
    set of them is named once, where it slides all the way from one sample to the next.

    Parameters
    ----------
    response : Response or StructureResponse
        The result of `integrate`.
    figure : matplotlib Figure or SubFigure, optional
        Where to draw; default: a new figure of 6 x 4.5 inches.
    title : str, optional
        Default: the name of the ground motion.
    ax : matplotlib Axes, optional
        Where to draw, instead of `figure`.
    time : tuple of float, optional
        Begin and end of the part to draw [s], such as (0, 25); default: all of the response. The
        secant is that of the whole response.

    Returns
    -------
    matplotlib Figure, SubFigure or Axes
        The axes if they were given, otherwise the figure.

    Raises
    ------
    ValueError
        Both figure and ax; a time that does not begin before it ends, or lies outside the response.
    """
    begin, end = window("plot_hysteresis", response, time)
    with style():
        figure, axes = one_panel("plot_hysteresis", figure, ax, 6, 4.5)
        curve = response._curve()
        curve = curve[(curve["time"] >= begin) & (curve["time"] <= end)]
        x, force = curve["displacement"], curve["force"]
        length, unit = unit_for(response.peak)
        axes.plot(x * length, force / STANDARD_GRAVITY, color=BLUE, linewidth=0.9)
        law = response.slider.law if isinstance(response, Response) else None
        if isinstance(response, Response) and isinstance(law, MultiPendulum):
            shown = (response.time >= begin) & (response.time <= end)
            sliding = sliding_surfaces(law, response)[shown[1:] & shown[:-1]]
            at_samples = response.displacement[shown], response.force[shown]
            name_regimes(axes, at_samples[0] * length, at_samples[1] / STANDARD_GRAVITY, sliding)
        axes.axhline(0, color=GRAY, linewidth=0.6, zorder=0)
        axes.axvline(0, color=GRAY, linewidth=0.6, zorder=0)
        axes.set_xlabel(f"relative displacement [{unit}]")
        axes.set_ylabel("force per unit mass [g]")
        put_title(axes, response.motion, title, _what_slides(response))
        if found := _secant(response):
            period, damping = found
            reach = np.array([-response.peak, response.peak])
            secant = (2 * np.pi / period) ** 2 * reach / STANDARD_GRAVITY
            label = f"effective period {digits(period)} s, damping {digits(100 * damping)} %"
            axes.plot(reach * length, secant, color=VERMILION, linestyle="--", label=label)
            low, high = axes.get_ylim()
            axes.set_ylim(low, high + 0.12 * (high - low))  # room for the legend
            axes.legend(loc="upper left", fontsize=8)
    return figure if ax is None else ax


def _what_slides(response: Response | StructureResponse) -> str:
    if isinstance(response, Response):
        return describe(response.slider)
    return describe_system(response.system)


def _secant(response: Response | StructureResponse) -> tuple[float, float] | None:
    """Period [s] and damping ratio of the largest loop; None without one."""
    try:
        return response.effective_period, response.effective_damping
    except ValueError:
        return None
