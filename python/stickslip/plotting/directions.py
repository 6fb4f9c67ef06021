"""Sliding along all horizontal directions, as on a map."""

from __future__ import annotations

from typing import Any, overload

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure, FigureBase

from .._text import printable
from .figures import check_axes, new_figure
from .styles import BLUE, GRAY, INK, PALE, VERMILION, style, wrapped
from .words import digits


@overload
def plot_orientations(table: Any, ax: None = None, title: str | None = None) -> Figure: ...
@overload
def plot_orientations(table: Any, ax: Axes, title: str | None = None) -> Axes: ...
def plot_orientations(
    table: Any, ax: Axes | None = None, title: str | None = None
) -> FigureBase | Axes:
    """Plot the table of `orientations`, as `Orientations.plot` does.

    Parameters
    ----------
    table : Orientations
    ax, title : optional
        As for `Orientations.plot`.

    Returns
    -------
    matplotlib Figure or Axes
        The axes if they were given, otherwise the new figure.
    """
    with style():
        if ax is None:
            figure = new_figure(5, 5)
            axes: Any = figure.add_subplot(projection="polar")
        else:
            check_axes(ax)
            axes = ax
        polar = axes.name == "polar"
        degrees, curves = _whole_turn(table) if polar else _sorted(table)
        x = np.radians(degrees) if polar else degrees
        names = (("peak", INK), ("residual", BLUE))
        for (name, color), values in zip(names, curves):
            marker = "o" if len(degrees) == 1 else None
            label = "peak [cm]" if name == "peak" else "residual, magnitude [cm]"
            width = 1.6 if name == "peak" else 0.9  # both are visible where they are equal
            axes.plot(x, 100 * values, color=color, marker=marker, linewidth=width, label=label)
        most, middle = table.rotd100, table.rotd50
        if np.isfinite(most.peak):
            around = np.linspace(0, 2 * np.pi, 361) if polar else x[[0, -1]]
            axes.plot(
                around,
                np.full(len(around), 100 * middle.peak),
                color=GRAY,
                linestyle="--",
                linewidth=0.8,
                label=f"RotD50 of the peak, {digits(100 * middle.peak)} cm",
            )
            at = most.peak_degrees
            axes.plot(
                np.radians(at) if polar else at,
                100 * most.peak,
                "o",
                color=VERMILION,
                markersize=5,
                label=f"RotD100, {digits(100 * most.peak)} cm at {at:g}\N{DEGREE SIGN}",
            )
        if polar:
            axes.set_theta_zero_location("N")
            axes.set_theta_direction(-1)
            ahead = ("N", "E", "S", "W") if table.from_north else ("axis", "transverse", "", "")
            axes.set_xticks(np.radians([0, 90, 180, 270]), ahead)
            axes.set_rlabel_position(45)
            axes.set_ylim(bottom=0)
            axes.grid(color=PALE, linewidth=0.6)
            axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.06), ncols=2, fontsize=8)
        else:
            what = "azimuth" if table.from_north else "angle from the axis, clockwise"
            axes.set(xlabel=f"{what} [degrees]", ylabel="displacement [cm]")
            axes.set_ylim(bottom=0)
            axes.grid(color=PALE, linewidth=0.6)
            axes.legend(fontsize=8)
        axes.set_axisbelow(True)
        name = title or printable(table.station) or "station"
        axes.set_title(wrapped(axes, name), parse_math=bool(title), pad=14 if polar else None)
    return figure if ax is None else ax


def _sorted(table: Any) -> tuple[Any, tuple[Any, Any]]:
    order = np.argsort(table.degrees, kind="stable")
    return table.degrees[order], (table.peak[order], np.abs(table.residual)[order])


def _whole_turn(table: Any) -> tuple[Any, tuple[Any, Any]]:
    """Directions from 0 to 360 degrees; with the opposite ones if those are alike. A curve through
    directions at regular steps around the whole turn is closed, and others have a gap."""
    degrees = np.mod(table.degrees, 360)
    peak, residual = table.peak, np.abs(table.residual)
    if table.mirrored:
        degrees = np.concatenate([degrees, np.mod(degrees + 180, 360)])
        peak, residual = np.tile(peak, 2), np.tile(residual, 2)
    degrees, first = np.unique(degrees, return_index=True)
    peak, residual = peak[first], residual[first]
    if len(degrees) < 2:
        return degrees, (peak, residual)
    degrees = np.append(degrees, degrees[0] + 360)
    peak, residual = np.append(peak, peak[0]), np.append(residual, residual[0])
    steps = np.diff(degrees)
    gaps = np.flatnonzero(steps > 1.5 * np.median(steps)) + 1
    fill = [np.insert(one, gaps, np.nan) for one in (peak, residual)]
    return np.insert(degrees, gaps, np.nan), (fill[0], fill[1])
