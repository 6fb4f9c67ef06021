"""Fragility curves, hazard curves, and design charts of sliding."""

from __future__ import annotations

from typing import Any, overload

from matplotlib.axes import Axes
from matplotlib.figure import Figure, FigureBase

from .figures import one_panel
from .styles import COLORS, style, wrapped

MEASURES = {
    "pga_g": "peak ground acceleration",
    "pgv": "peak ground velocity",
    "arias": "Arias intensity",
    "cav": "cumulative absolute velocity",
    "sa_g": "pseudo-acceleration",
}


def measure_label(name: str, unit: str, period: float | None = None) -> str:
    """The label of an axis of an intensity measure."""
    at = f" at {period:g} s" if period is not None else ""
    return MEASURES.get(name, name) + at + (f" [{unit}]" if unit else "")


@overload
def plot_fragility(
    fragility: Any, *, level: float | None = ..., ax: None = None, title: str | None = ...
) -> Figure: ...
@overload
def plot_fragility(
    fragility: Any, *, level: float | None = ..., ax: Axes, title: str | None = ...
) -> Axes: ...
def plot_fragility(
    fragility: Any,
    *,
    level: float | None = 0.9,
    ax: Axes | None = None,
    title: str | None = None,
) -> FigureBase | Axes:
    """Plot fragility curves, as `Fragility.plot` does.

    Parameters
    ----------
    fragility : Fragility
    level, ax, title : optional
        As for `Fragility.plot`.

    Returns
    -------
    matplotlib Figure or Axes
        The axes if they were given, otherwise the new figure.
    """
    im = fragility.grid()
    curves = fragility.probability(im)
    levels, fractions = fragility.fractions()
    bands = None if level is None else fragility.bands(level, im)
    with style():
        figure, axes = one_panel("plot_fragility", None, ax, 7, 4.5)
        for i, label in enumerate(fragility.labels):
            color = COLORS[i % len(COLORS)]
            if bands is not None:
                axes.fill_between(
                    im, bands.low[i], bands.high[i], color=color, alpha=0.2, linewidth=0
                )
            axes.plot(im, curves[i], color=color, label=label)
            if len(levels) <= 50:
                axes.plot(levels, fractions[i], "o", color=color, markersize=4)
        axes.set_xscale("log")
        axes.set_ylim(0, 1)
        axes.set_xlabel(measure_label(fragility.im, fragility.im_unit, fragility.im_period))
        axes.set_ylabel("probability of exceedance")
        axes.legend(title=fragility.quantity.replace("_", " "), loc="upper left")
        if title:
            axes.set_title(wrapped(axes, title))
    return figure if ax is None else axes
