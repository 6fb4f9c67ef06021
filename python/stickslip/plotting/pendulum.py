"""Pictures of pendulums with several surfaces."""

from __future__ import annotations

from typing import overload

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure, FigureBase
from matplotlib.patheffects import withStroke
from numpy.typing import NDArray

from .._core import MultiPendulum, PendulumLoop, Response
from .figures import one_panel
from .styles import BLUE, COLORS, GRAY, VERMILION, style


@overload
def plot_pendulum_loop(loop: PendulumLoop, ax: None = None, title: str | None = None) -> Figure: ...
@overload
def plot_pendulum_loop(loop: PendulumLoop, ax: Axes, title: str | None = None) -> Axes: ...
def plot_pendulum_loop(
    loop: PendulumLoop, ax: Axes | None = None, title: str | None = None
) -> FigureBase | Axes:
    """Plot the force of a bearing under an imposed displacement, with its corners.

    At a corner an element joins the motion, comes to its stop, or the path turns. Numbers beside
    the lines name the surfaces that slide, from bottom to top; each set of them is named once.

    Parameters
    ----------
    loop : PendulumLoop
    ax : matplotlib Axes, optional
        Where to draw; default: a new figure of 6 x 4 inches.
    title : str, optional
        Default: 'Force under an imposed displacement'.

    Returns
    -------
    matplotlib Figure or Axes
        The axes if they were given, otherwise the new figure.
    """
    with style():
        figure, axes = one_panel("plot_pendulum_loop", None, ax, 6, 4)
        x, force = loop.corners.T
        axes.plot(100 * x, force, color=BLUE)
        axes.plot(100 * x, force, "o", color=VERMILION, markersize=3.5)
        name_regimes(axes, 100 * x, force, loop.moving[:-1])
        axes.axhline(0, color=GRAY, linewidth=0.6)
        axes.axvline(0, color=GRAY, linewidth=0.6)
        axes.set_xlabel("displacement [cm]")
        axes.set_ylabel("force over weight [-]")
        axes.set_title(title or "Force under an imposed displacement")
    return figure if ax is None else axes


def sliding_surfaces(law: MultiPendulum, response: Response) -> NDArray[np.bool_]:
    """Which surfaces of a pendulum slide from each sample to the next, from bottom to top.

    Elements that slide together turn by equal angles, or slide equal distances if they are flat.
    Where those that have moved did not, the regime changed between the two samples, and no surface
    is named.

    Parameters
    ----------
    law : MultiPendulum
    response : Response
        Of a slider with that law.

    Returns
    -------
    ndarray, shape (samples - 1, surfaces)
    """
    radii = law.element_radii
    ways = np.diff(response.elements.displacement)
    turns = ways / np.where(np.isfinite(radii), radii, 1)[:, np.newaxis]
    least = np.where(ways != 0, turns, np.inf).min(axis=0)
    most = np.where(ways != 0, turns, -np.inf).max(axis=0)
    together = most - least <= 1e-9 * np.abs(most)  # round-off is far below
    slid = np.abs(np.diff(response.surfaces.displacement))
    return (together & (slid > 1e-9 * slid.max(axis=0))).T


def name_regimes(
    axes: Axes, x: NDArray[np.float64], force: NDArray[np.float64], sliding: NDArray[np.bool_]
) -> None:
    """Name each set of surfaces once, beside a long line on which it slides far from the center.

    Parameters
    ----------
    axes : matplotlib Axes
    x, force : ndarray, shape (N,)
        The ends of the lines, in the units of the axes.
    sliding : ndarray, shape (N - 1, surfaces)
        The surfaces that slide along each line.
    """
    named = {""}
    for i in np.argsort(-np.abs(np.diff(x**2)), kind="stable"):
        name = " ".join(str(k + 1) for k in np.flatnonzero(sliding[i]))
        if name in named:
            continue
        named.add(name)
        middle = ((x[i] + x[i + 1]) / 2, (force[i] + force[i + 1]) / 2)
        text = axes.annotate(name, middle, (4, -10), textcoords="offset points", fontsize=8)
        text.set_path_effects([withStroke(linewidth=2.5, foreground="white")])
    if len(named) > 1:
        axes.annotate(
            "numbers: the surfaces that slide,\ncounted from the bottom",
            (1, 0),
            xytext=(-3, 3),
            xycoords="axes fraction",
            textcoords="offset points",
            ha="right",
            va="bottom",
            color=GRAY,
            fontsize=8,
        )


@overload
def plot_surfaces(response: Response, ax: None = None, title: str | None = None) -> Figure: ...
@overload
def plot_surfaces(response: Response, ax: Axes, title: str | None = None) -> Axes: ...
def plot_surfaces(
    response: Response, ax: Axes | None = None, title: str | None = None
) -> FigureBase | Axes:
    """Plot the displacement of each surface of a `MultiPendulum` over time, from bottom to top.

    Parameters
    ----------
    response : Response
        Of a `MultiPendulum`.
    ax : matplotlib Axes, optional
        Where to draw; default: a new figure of 7 x 3.5 inches.
    title : str, optional
        Default: 'Displacement of the surfaces'.

    Returns
    -------
    matplotlib Figure or Axes
        The axes if they were given, otherwise the new figure.

    Raises
    ------
    ValueError
        The response of another slider.
    """
    motions = response.surfaces
    with style():
        figure, axes = one_panel("plot_surfaces", None, ax, 7, 3.5)
        dashes = ("-", "--", "-.", ":")
        for k, values in enumerate(np.asarray(motions.displacement)):
            axes.plot(
                response.time,
                100 * values,
                color=COLORS[k % len(COLORS)],
                linestyle=dashes[k % len(dashes)],
                linewidth=1.1,
                label=f"surface {k + 1}, peak {100 * motions.peak[k]:.3g} cm",
            )
        axes.set_xlabel("time [s]")
        axes.set_ylabel("displacement [cm]")
        axes.set_title(title or "Displacement of the surfaces")
        axes.legend()
    return figure if ax is None else axes
