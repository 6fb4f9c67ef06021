"""Statistics of ensembles."""

from __future__ import annotations

from typing import overload

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure, FigureBase

from .._core import Ensemble
from ..ensemble.tables import impact_probabilities
from .figures import Place, given_or_new
from .styles import BLUE, GRAY, PALE, VERMILION, draw_band, put_figure_title, put_note, style
from .words import describe_ensemble, digits, unit_for, with_error


@overload
def plot_ensemble(ensemble: Ensemble, figure: None = None, title: str | None = None) -> Figure: ...
@overload
def plot_ensemble(ensemble: Ensemble, figure: Place, title: str | None = None) -> Place: ...
def plot_ensemble(
    ensemble: Ensemble, figure: FigureBase | None = None, title: str | None = None
) -> FigureBase:
    """Plot the variances over time, the distribution of the peaks, and the velocity spectrum.

    Bands are plus and minus two standard errors; for the distribution, 95 % confidence bounds. If
    the durations of the ground motions differ, only the peaks are plotted.

    Parameters
    ----------
    ensemble : Ensemble
        The result of `run_ensemble`, with at least two members.
    figure : matplotlib Figure or SubFigure, optional
        Where to draw; default: a new figure of 9 x 6 inches.
    title : str, optional
        Default: the number of members, and the slider.

    Returns
    -------
    matplotlib Figure or SubFigure
        With axes for the variance of x, the probability of exceedance of the peak, the variance of
        x', and the spectral density of x' if the ensemble has it. Of sliders in the plane: for the
        variances of both components of r, their covariance, and the probability of exceedance.

    Raises
    ------
    ValueError
        Fewer than two members.
    """
    e, t = ensemble, ensemble.time
    if e.in_plane and t.size:
        return _plot_in_plane(e, figure, title)
    if t.size == 0:
        with style():
            figure = given_or_new(figure, 6, 4)
            put_figure_title(figure, title or describe_ensemble(e))
            _draw_peaks(figure.subplots(), e)
        return figure
    s = e.stationary
    has_spectrum = e.configuration["velocity_spectrum"]
    with style():
        figure = given_or_new(figure, 9, 6)
        layout = [["way", "peaks"], ["speed", "spectrum" if has_spectrum else "peaks"]]
        axes = figure.subplot_mosaic(layout)
        way, speed, peaks = axes["way"], axes["speed"], axes["peaks"]
        put_figure_title(figure, title or describe_ensemble(e))

        variance, error = e.displacement_variance, e.displacement_variance_error
        length, unit = unit_for(np.sqrt(variance.max()))
        draw_band(way, t, variance * length**2, error * length**2, BLUE)
        growth = s.growth_rate
        central = (t >= s.begin) & (t <= s.end)
        middle = t[central].mean(), variance[central].mean()
        line = middle[1] + growth.value * (np.array([s.begin, s.end]) - middle[0])
        way.plot([s.begin, s.end], line * length**2, color=VERMILION, linestyle="--")
        put_note(way, f"grows by {with_error(growth, length**2)} {unit}\N{SUPERSCRIPT TWO}/s")
        way.set_ylabel(f"variance of displacement\n[{unit}\N{SUPERSCRIPT TWO}]")

        variance, error = e.velocity_variance, e.velocity_variance_error
        fast, fast_unit = unit_for(np.sqrt(variance.max()))
        square = f"({fast_unit}/s)\N{SUPERSCRIPT TWO}"
        draw_band(speed, t, variance * fast**2, error * fast**2, BLUE)
        level = s.velocity_variance
        speed.plot([s.begin, s.end], [level.value * fast**2] * 2, color=VERMILION, linestyle="--")
        what = "stationary" if s.is_stationary else "not stationary:"
        if s.remark.startswith("cannot tell"):
            what = "perhaps stationary:"
        put_note(speed, f"{what} {with_error(level, fast**2)} {square}")
        speed.set_ylabel(f"variance of velocity\n[{square}]")
        for panel in (way, speed):
            panel.set(xlim=(t[0], t[-1]), xlabel="time [s]")
            panel.set_ylim(bottom=0)

        _draw_peaks(peaks, e)
        if has_spectrum:
            _draw_spectrum(axes["spectrum"], e, fast, fast_unit)
        figure.align_ylabels()
    return figure


def _plot_in_plane(e: Ensemble, figure: FigureBase | None, title: str | None) -> FigureBase:
    """Plot the variances and the covariance of the displacement vector, and the peaks."""
    t = e.time
    with style():
        figure = given_or_new(figure, 9, 4)
        put_figure_title(figure, title or describe_ensemble(e))
        variances, peaks = figure.subplots(1, 2)
        length, unit = unit_for(np.sqrt(e.displacement_variance.max()))
        for i, (name, color) in enumerate((("axis", BLUE), ("transverse", VERMILION))):
            value, error = e.displacement_variance[:, i], e.displacement_variance_error[:, i]
            draw_band(variances, t, value * length**2, error * length**2, color)
            variances.lines[-1].set_label(name)
        value, error = e.displacement_covariance, e.displacement_covariance_error
        draw_band(variances, t, value * length**2, error * length**2, GRAY)
        variances.lines[-1].set_label("covariance")
        variances.legend()
        variances.set_ylabel(f"variance of displacement\n[{unit}\N{SUPERSCRIPT TWO}]")
        variances.set(xlim=(t[0], t[-1]), xlabel="time [s]")
        _draw_peaks(peaks, e)
    return figure


def _draw_peaks(axes: Axes, ensemble: Ensemble) -> None:
    """Draw the fraction of members that exceed a peak, on a log axis, and mark quantiles."""
    e, n = ensemble, ensemble.members
    marks = [p for p in (0.5, 0.9, 0.99, 0.999, 0.9999) if n * (1 - p) >= 5]
    quantiles = [e.quantile(p) for p in marks]
    highest = e.quantile(1 - 0.5 / n).value
    length, unit = unit_for(highest)
    axes.set(yscale="log", xlabel=f"peak displacement [{unit}]", ylabel="probability of exceedance")
    axes.set_ylim(0.5 / n, 1.3)
    if highest == 0:
        axes.annotate("none slips", (0.5, 0.5), xycoords="axes fraction", ha="center", color=GRAY)
        return
    levels = np.linspace(0, highest, 121)[:-1]
    shares = []
    for level in levels:
        try:
            shares.append(e.exceedance(level))
        except ValueError:  # beyond the smallest gap of a stop
            break
    levels = levels[: len(shares)]
    low, value, high = np.array([(s.low, s.value, s.high) for s in shares]).T
    x = levels * length
    axes.fill_between(x, np.maximum(low, 1e-12), high, color=BLUE, alpha=0.25, linewidth=0)
    axes.plot(x, value, color=BLUE)
    axes.set_xlim(0, highest * length)
    for p, q in zip(marks, quantiles):
        if q.value in (0, highest) or (len(levels) < 120 and q.value > levels[-1]):
            continue
        axes.plot(q.value * length, 1 - p, "o", color=VERMILION, markersize=5, zorder=4)
        name, at_left = "median" if p == 0.5 else f"{100 * p:g} %", q.value > 0.7 * highest
        axes.annotate(
            f"{name}: {digits(q.value * length)} {unit}",
            (q.value * length, 1 - p),
            xytext=(-8, -8) if at_left else (7, 3),
            textcoords="offset points",
            ha="right" if at_left else "left",
            color=VERMILION,
            fontsize=8,
        )
    hits = impact_probabilities(e).get("impact_probability")
    hit = f"{100 * hits.value:.3g} % hit a stop" if hits else ""
    put_note(axes, hit, "band: 95 % confidence")
    axes.grid(color=PALE, linewidth=0.6)
    axes.set_axisbelow(True)


def _draw_spectrum(axes: Axes, ensemble: Ensemble, fast: float, fast_unit: str) -> None:
    """Draw the velocity spectrum up to the frequency below which 99.5 % of it lies."""
    s = ensemble.velocity_spectrum
    draw_band(axes, s.omega, s.density * fast**2, s.error * fast**2, BLUE)
    whole = np.cumsum(s.density)
    end = np.searchsorted(whole, 0.995 * whole[-1]) if whole[-1] > 0 else len(whole) - 1
    axes.set_xlim(0, s.omega[max(end, 1)])
    axes.set_ylim(bottom=0)
    put_note(axes, "")
    axes.set_xlabel("angular frequency [rad/s]")
    axes.set_ylabel(
        f"two-sided density of velocity\n[({fast_unit}/s)\N{SUPERSCRIPT TWO} per rad/s]"
    )
