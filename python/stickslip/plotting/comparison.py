"""Theory and simulation."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol, overload

import numpy as np
from matplotlib.figure import Figure, FigureBase

from .._core import Ensemble, Moments
from .figures import Place, given_or_new
from .styles import COLORS, GRAY, INK, draw_band, put_figure_title, put_note, style
from .words import describe_ensemble, unit_for


class _Comparison(Protocol):
    """The attributes of a `Comparison` that are plotted."""

    time: np.ndarray
    ensemble: Ensemble
    theories: Mapping[str, Moments]


def _theory_style(place: int) -> dict[str, Any]:
    """Color, dashes and marker of a theory in a plot: ten colors, and no two theories are alike.

    Parameters
    ----------
    place : int
        Place among the theories of the plot, from 0; styles repeat after 231.
    """
    colors = (*COLORS, "#882255", "#999933", "#332288", "#661100", "#888888")  # mostly Tol's muted
    return {
        "color": colors[place % len(colors)],
        "linestyle": ("--", "-.", ":")[place % 3],
        "marker": "osD^vPX"[place % 7],
        "markersize": 3.5,
        "markevery": (place % 4, 4),
    }


@overload
def plot_comparison(
    comparison: _Comparison, figure: None = None, title: str | None = None
) -> Figure: ...
@overload
def plot_comparison(comparison: _Comparison, figure: Place, title: str | None = None) -> Place: ...
def plot_comparison(
    comparison: _Comparison, figure: FigureBase | None = None, title: str | None = None
) -> FigureBase:
    """Plot the variances over time: the ensemble with its errors, and each theory as a line.

    Bands are plus and minus two standard errors.

    Parameters
    ----------
    comparison : Comparison
        The result of `compare`.
    figure : matplotlib Figure or SubFigure, optional
        Where to draw; default: a new figure of 9 x 4.4 inches.
    title : str, optional
        Default: the number of members, and the slider.

    Returns
    -------
    matplotlib Figure or SubFigure
        With two axes: variance of x, variance of x'. In the plane each has a band for either
        component.
    """
    e = comparison.ensemble
    with style():
        figure = given_or_new(figure, 9, 4.4)
        put_figure_title(figure, title or describe_ensemble(e))
        for axes, name, part in zip(
            figure.subplots(1, 2),
            ("displacement_variance", "velocity_variance"),
            ("displacement", "velocity"),
        ):
            variance, error = getattr(e, name), getattr(e, name + "_error")
            factor, unit = unit_for(np.sqrt(variance.max()))
            names = ("simulation",)
            if e.in_plane:
                names = ("simulation, axis", "simulation, transverse")
            for label, color, value, width in zip(
                names, (INK, GRAY), np.atleast_2d(variance.T), np.atleast_2d(error.T)
            ):
                draw_band(axes, e.time, value * factor**2, width * factor**2, color)
                axes.lines[-1].set_label(label)
            for i, (theory, moments) in enumerate(comparison.theories.items()):
                axes.plot(
                    moments.time,
                    getattr(moments, name) * factor**2,
                    label=theory,
                    **_theory_style(i),
                )
            unit = unit if part == "displacement" else f"({unit}/s)"
            axes.set_ylabel(f"variance of {part} [{unit}\N{SUPERSCRIPT TWO}]")
            axes.set_xlabel("time [s]")
            axes.set_xlim(0, comparison.time[-1])
            axes.set_ylim(bottom=0)
            is_said = part == "velocity" and not (e.in_plane or e.stationary.is_stationary)
            put_note(axes, "not shown to be stationary" if is_said else "")
        figure.axes[0].legend(loc="upper left", fontsize=8)
    return figure
