"""Ground motions and their response spectra."""

from __future__ import annotations

from typing import overload

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure, FigureBase

from .._core import STANDARD_GRAVITY, GroundMotion, ResponseSpectrum
from .._text import printable
from .figures import one_panel
from .styles import (
    INK,
    PALE,
    VERMILION,
    is_geometric,
    plain_ticks,
    put_title,
    put_title_over,
    style,
)
from .words import digits


@overload
def plot_ground_motion(
    motion: GroundMotion, ax: None = None, title: str | None = None
) -> Figure: ...
@overload
def plot_ground_motion(motion: GroundMotion, ax: Axes, title: str | None = None) -> Axes: ...
def plot_ground_motion(
    motion: GroundMotion, ax: Axes | None = None, title: str | None = None
) -> FigureBase | Axes:
    """Plot the ground acceleration over time, and mark its peak.

    Parameters
    ----------
    motion : GroundMotion
    ax : matplotlib Axes, optional
        Where to draw; default: a new figure of 7 x 2.5 inches.
    title : str, optional
        Default: the name of the ground motion.

    Returns
    -------
    matplotlib Figure or Axes
        The axes if they were given, otherwise the new figure.
    """
    with style():
        figure, axes = one_panel("plot_ground_motion", None, ax, 7, 2.5)
        t, n = motion.time, motion.acceleration / STANDARD_GRAVITY
        held = motion.interpolation == "constant"
        axes.plot(t, n, color=INK, linewidth=0.6, drawstyle="steps-post" if held else "default")
        acting = n[:-1] if held else n
        peak = int(np.abs(acting).argmax())
        axes.plot(t[peak], n[peak], "o", color=VERMILION, markersize=4)
        axes.annotate(
            f"PGA {digits(abs(n[peak]))} g",
            (t[peak], n[peak]),
            xytext=(5, 0),
            textcoords="offset points",
            va="center",
            fontsize=8,
        )
        axes.set(xlabel="time [s]", ylabel="ground acceleration [g]", xlim=(t[0], t[-1]))
        put_title(axes, motion, title)
    return figure if ax is None else ax


_SPECTRUM_LABELS = {
    "pseudo_acceleration": "pseudo-acceleration [g]",
    "pseudo_velocity": "pseudo-velocity [m/s]",
    "displacement": "relative displacement [m]",
    "velocity": "relative velocity [m/s]",
    "acceleration": "absolute acceleration [g]",
}


@overload
def plot_response_spectrum(
    spectrum: ResponseSpectrum, ax: None = None, title: str | None = None
) -> Figure: ...
@overload
def plot_response_spectrum(
    spectrum: ResponseSpectrum, ax: Axes, title: str | None = None
) -> Axes: ...
def plot_response_spectrum(
    spectrum: ResponseSpectrum, ax: Axes | None = None, title: str | None = None
) -> FigureBase | Axes:
    """Plot a response spectrum over the period, with a line for each damping ratio.

    Accelerations are drawn in g. Periods are drawn in increasing order, on a log axis if they are
    spaced geometrically, as by `np.geomspace`.

    Parameters
    ----------
    spectrum : ResponseSpectrum
    ax : matplotlib Axes, optional
        Where to draw; default: a new figure of 6 x 4 inches.
    title : str, optional
        Default: 'Elastic response spectrum'. The name of the spectrum is below it.

    Returns
    -------
    matplotlib Figure or Axes
        The axes if they were given, otherwise the new figure.
    """
    with style():
        figure, axes = one_panel("plot_response_spectrum", None, ax, 6, 4)
        order = np.argsort(spectrum.periods, kind="stable")
        factor = 1 / STANDARD_GRAVITY if spectrum.kind.endswith("acceleration") else 1.0
        for zeta, values in zip(spectrum.damping, np.atleast_2d(spectrum.values)):
            axes.plot(
                spectrum.periods[order],
                factor * values[order],
                marker="o" if len(order) == 1 else None,
                label=f"{100 * zeta:g} % damping",
            )
        axes.set(xlabel="period [s]", ylabel=_SPECTRUM_LABELS[spectrum.kind])
        axes.set_ylim(bottom=0)
        if len(order) > 1:
            axes.set_xlim(spectrum.periods.min(), spectrum.periods.max())
        if is_geometric(spectrum.periods[order]):
            axes.set_xscale("log")
            plain_ticks(axes, spectrum.periods)
        axes.grid(color=PALE, linewidth=0.6)
        axes.set_axisbelow(True)
        put_title_over(axes, "Elastic response spectrum", title, printable(spectrum.name))
        axes.legend(fontsize=8)
    return figure if ax is None else ax
