"""Fragility curves, hazard curves, and design charts of sliding."""

from __future__ import annotations

from typing import Any, overload

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure, FigureBase

from ..motions.intensity import OF_DIRECTIONS
from .figures import one_panel
from .styles import COLORS, GRAY, put_title_over, style, wrapped

MEASURES = {
    "pga_g": "peak ground acceleration",
    "pgv": "peak ground velocity",
    "arias": "Arias intensity",
    "cav": "cumulative absolute velocity",
    "sa_g": "pseudo-acceleration",
}

_STUCK = 1e-3  # [cm]; a line in a logarithmic scale ends there


def measure_label(of: Any) -> str:
    """The label of an axis of the intensity measure of a Fragility."""
    at = f" at {of.im_period:g} s" if of.im_period is not None else ""
    name = OF_DIRECTIONS.get(of.im_directions, "") + MEASURES.get(of.im, of.im)
    return name + at + (f" [{of.im_unit}]" if of.im_unit else "")


def _plot_known(axes: Axes, x: Any, y: Any, known: tuple[float, float], **style: Any) -> None:
    """A curve, solid at known values of x and dashed beyond them."""
    low, high = known
    label = style.pop("label")
    inside = (x >= low) & (x <= high)
    axes.plot(x[inside], y[inside], label=label, **style)
    for beyond in (x <= x[inside][0], x >= x[inside][-1]) if inside.any() else (x == x,):
        axes.plot(x[beyond], y[beyond], linestyle="--", **style)


def _explain_dashes(axes: Axes) -> None:
    axes.plot([], [], color=GRAY, linestyle="--", label="beyond the ground motions")


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
    im = np.union1d(fragility.grid(), fragility.im_range)
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
            _plot_known(axes, im, curves[i], fragility.im_range, color=color, label=label)
            if len(levels) <= 50:
                axes.plot(levels, fractions[i], "o", color=color, markersize=4)
        _explain_dashes(axes)
        axes.set_xscale("log")
        axes.set_ylim(0, 1)
        axes.set_xlabel(measure_label(fragility))
        axes.set_ylabel("probability of exceedance")
        axes.legend(title=fragility.quantity.replace("_", " "), loc="upper left")
        if title:
            axes.set_title(wrapped(axes, title))
    return figure if ax is None else axes


@overload
def plot_exceedances(exceedances: Any, *, ax: None = None, title: str | None = ...) -> Figure: ...
@overload
def plot_exceedances(exceedances: Any, *, ax: Axes, title: str | None = ...) -> Axes: ...
def plot_exceedances(
    exceedances: Any, *, ax: Axes | None = None, title: str | None = None
) -> FigureBase | Axes:
    """Plot which intensities contribute to each rate, as `Exceedances.plot` does.

    Parameters
    ----------
    exceedances : Exceedances
    ax, title : optional
        As for `Exceedances.plot`.

    Returns
    -------
    matplotlib Figure or Axes
        The axes if they were given, otherwise the new figure.
    """
    f, hazard = exceedances.fragility, exceedances.hazard
    im = np.geomspace(min(f.grid()[0], hazard.im[0]), max(f.grid()[-1], hazard.im[-1]), 400)
    middle = np.sqrt(im[1:] * im[:-1])
    parts = f.probability(middle) * -np.diff(hazard.at(im)) / np.diff(np.log(im))
    with style():
        figure, axes = one_panel("plot_exceedances", None, ax, 7, 4.5)
        for i, (label, rate) in enumerate(zip(f.labels, exceedances.rate)):
            color = COLORS[i % len(COLORS)]
            axes.fill_between(middle, parts[i] / rate, color=color, alpha=0.2, linewidth=0)
            name = f"{label}: {rate:.2g} per year"
            _plot_known(axes, middle, parts[i] / rate, f.im_range, color=color, label=name)
        for end in hazard.im[[0, -1]]:
            axes.axvline(end, color=GRAY, linewidth=0.8, linestyle=":")
        _explain_dashes(axes)
        axes.set_xscale("log")
        axes.set_ylim(bottom=0)
        axes.set_xlabel(measure_label(f))
        axes.set_ylabel("contribution to the rate, per unit of ln IM")
        axes.legend(title=f.quantity.replace("_", " "), loc="upper right")
        if title:
            axes.set_title(wrapped(axes, title))
    return figure if ax is None else axes


@overload
def plot_design_chart(
    chart: Any, quantity: str = ..., *, ax: None = None, title: str | None = ...
) -> Figure: ...
@overload
def plot_design_chart(
    chart: Any, quantity: str = ..., *, ax: Axes, title: str | None = ...
) -> Axes: ...
def plot_design_chart(
    chart: Any, quantity: str = "peak", *, ax: Axes | None = None, title: str | None = None
) -> FigureBase | Axes:
    """Plot displacements against the coefficient of friction, as `DesignChart.plot` does.

    Parameters
    ----------
    chart : DesignChart
    quantity, ax, title : optional
        As for `DesignChart.plot`.

    Returns
    -------
    matplotlib Figure or Axes
        The axes if they were given, otherwise the new figure.

    Raises
    ------
    ValueError
        Another quantity; more than six levels.
    """
    if quantity not in ("peak", "residual"):
        raise ValueError(
            f"plot_design_chart: quantity must be 'peak' or 'residual', got {quantity!r}"
        )
    if len(chart.levels) > len(COLORS):
        raise ValueError(
            f"plot_design_chart: draws at most {len(COLORS)} levels, got {len(chart.levels)}"
        )
    values = 100 * getattr(chart, quantity)
    middle = int(np.argmin(np.abs(chart.percentiles - 50)))
    unit = {"pga_g": "g", "pgv": "m/s"}[chart.measure]
    shares = ", ".join(f"{p:g}" for p in chart.percentiles)
    over = OF_DIRECTIONS.get(chart.directions, "")
    ends = (values <= _STUCK).any()
    with style():
        figure, axes = one_panel("plot_design_chart", None, ax, 7, 4.5)
        for i, (level, color) in enumerate(zip(chart.levels, COLORS)):
            for p in range(len(chart.percentiles)):
                y = np.where(values[p, i] > _STUCK, values[p, i], np.nan)
                label = f"{level:g} {unit}" if p == middle else None
                width = 1.6 if p == middle else 0.7
                axes.plot(chart.mu, y, color=color, linewidth=width, label=label)
        axes.set_yscale("log")
        axes.set_xlabel("coefficient of friction [\N{MINUS SIGN}]")
        axes.set_ylabel(f"{over}{quantity} displacement [cm]: {shares} %")
        axes.legend(title=MEASURES[chart.measure])
        put_title_over(
            axes,
            f"{quantity} displacement of a block under scaled records".capitalize(),
            title,
            "a line ends where the block does not slide" if ends else "",
        )
    return figure if ax is None else axes
