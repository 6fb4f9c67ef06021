"""Displacements of many sliders and records."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Sequence
from typing import Any, overload

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure, FigureBase

from .._text import printable
from .figures import Place, one_panel
from .styles import COLORS, INK, PALE, plain_ticks, style, wrapped


@overload
def plot_sweep(
    table: Any,
    quantity: str = "peak",
    *,
    against: str | None = None,
    ax: None = None,
    title: str | None = None,
) -> Figure: ...
@overload
def plot_sweep(
    table: Any,
    quantity: str = "peak",
    *,
    against: str | None = None,
    ax: Axes,
    title: str | None = None,
) -> Axes: ...
def plot_sweep(
    table: Any,
    quantity: str = "peak",
    *,
    against: str | None = None,
    ax: Axes | None = None,
    title: str | None = None,
) -> FigureBase | Axes:
    """Plot the table of a sweep, as `SweepTable.plot` does.

    Parameters
    ----------
    table : SweepTable
    quantity, against, ax, title : optional
        As for `SweepTable.plot`.

    Returns
    -------
    matplotlib Figure or Axes
        The axes if they were given, otherwise the new figure.

    Raises
    ------
    ValueError
        As `SweepTable.plot` does.
    """
    name, curves = _curves(table, against)
    if len(curves) > len(COLORS):
        raise ValueError(
            f"plot_sweep: draws at most {len(COLORS)} combinations of the other parameters, got"
            f" {len(curves)}; fix some of them"
        )
    heading = quantity.replace("_", " ")
    samples = len(table.records) * len(table.polarity)
    quantiles = 100 * table.quantile([0.05, 0.16, 0.5, 0.84, 0.95], quantity)
    values = 100 * np.abs(getattr(table, quantity))
    axis = {"mu": "coefficient of friction [\N{MINUS SIGN}]", "period": "period [s]"}
    alone = len(curves) == 1
    shown_values = quantiles[1:4][np.isfinite(quantiles[1:4]) & (quantiles[1:4] > 0.01)]
    # down to 0.1 mm, which is no displacement
    log = bool(shown_values.size and shown_values.max() > 10 * shown_values.min())

    def line(y: np.ndarray) -> np.ndarray:
        """What a line shows: it ends at 0, which a log axis cannot show."""
        return np.where(y > 0, y, np.nan) if log else y

    with style():
        figure, axes = one_panel("plot_sweep", None, ax, 7, 4.5)
        for (label, x, places), color in zip(curves, COLORS):
            marker = "o" if len(places) == 1 or not name else None
            if len(table.records) == 1:  # the polarities of one record, without statistics
                _draw_polarities(axes, table, x, line(values[places, 0]), color, label, marker)
                continue
            lowest, low, middle, high, highest = quantiles[:, places]
            if not name:  # sliders in no order, which lines would suggest
                if samples <= _THIN_LINES:
                    thin = line(values[places]).reshape(len(places), -1)
                    axes.plot(x, thin, ".", color="#c4c4c4", markersize=3)
                axes.errorbar(
                    *(x, middle, (middle - low, high - middle)),
                    fmt="o",
                    color=color,
                    capsize=5,
                    linewidth=1.5,
                    label=f"median, 16 and 84 % of {samples:,} histories",
                )
                continue
            if alone and samples <= _THIN_LINES:
                thin = line(values[places]).reshape(len(places), -1)
                axes.plot(x, thin, color="#c4c4c4", linewidth=0.5, alpha=min(1, 40 / samples + 0.2))
            elif alone:  # this many lines would hide the band and each other
                outer = {"color": color, "alpha": 0.12, "linewidth": 0}
                axes.fill_between(x, lowest, highest, label="5 to 95 %", **outer)
            axes.fill_between(
                x,
                low,
                high,
                color=color,
                alpha=0.25,
                linewidth=0,
                label="16 to 84 %" if alone else None,
            )
            shown = f"median of {samples:,} histories"
            axes.plot(
                x, line(middle), color=color, linewidth=2, label=label or shown, marker=marker
            )
        axes.set_xlabel(axis.get(name, name))
        axes.set_ylabel(
            f"{heading}{' displacement' if quantity != 'sliding_distance' else ''} [cm]"
        )
        axes.grid(color=PALE, linewidth=0.6)
        axes.set_axisbelow(True)
        x = np.concatenate([x for _, x, _ in curves])
        if name and x.min() > 0 and x.max() > 5 * x.min():
            axes.set_xscale("log")
            plain_ticks(axes, x)
        if log:
            axes.set_yscale("log")
            top = np.nanmax(values) if len(table.records) == 1 or alone else None
            axes.set_ylim(shown_values.min() / 2, 2 * (top or shown_values.max()))
            axes.yaxis.set_major_formatter(lambda value, _: f"{value:g}")
        else:
            axes.set_ylim(bottom=0)
        if name:
            axes.margins(x=0)
        else:
            _name_sliders(axes, table.sliders)
        records = f"{len(table.records):,} records" if len(table.records) > 1 else table.records[0]
        heading = printable(title if title is not None else f"Sliding in {records}")
        axes.set_title(wrapped(axes, heading))
        for text in axes.legend(fontsize=8).get_texts():
            text.set_parse_math(False)
        axes.title.set_parse_math(False)
    return figure if ax is None else ax


_THIN_LINES = 200  # number of histories up to which each is a line


def _curves(table: Any, against: str | None) -> tuple[str, list[tuple[str, Any, Any]]]:
    """The parameter on the horizontal axis, and label, x and sliders of each curve.

    A list without a parameter that has numbers is one curve over the numbers of the sliders.
    """
    numeric = any(column.dtype.kind in "biuf" for column in table.parameters.values())
    if against is None and not numeric:
        places = np.arange(len(table.sliders))
        return "", [("", places + 1, places)]
    curves = list(table.curves(against))
    column = table.parameters[curves[0][0]]
    return curves[0][0], [(label, column[places], places) for _, label, places in curves]


def _draw_polarities(
    axes: Axes, table: Any, x: Any, values: np.ndarray, color: str, label: str, marker: str | None
) -> None:
    """The polarities of one record: the second is dashed, or without a line if it is the same."""
    same = values.shape[1] == 2 and np.allclose(
        values[:, 0], values[:, 1], rtol=1e-6, equal_nan=True
    )
    for p, polarity in enumerate(table.polarity[:1] if same else table.polarity):
        words = "recorded and reversed" if same else polarity
        shown = ", ".join(part for part in (label, words) if part)
        line = "" if marker else "--" if p else "-"
        axes.plot(x, values[:, p], line, color=color, label=shown, linewidth=1.5, marker=marker)


def _name_sliders(axes: Axes, sliders: Sequence[str]) -> None:
    """Write the sliders below the axis if there is room, otherwise their numbers."""
    if len(sliders) > 12:
        axes.set_xlabel("slider, by its place in the list")
        return
    short = [
        re.sub(r"\d+\.\d{5,}", lambda number: f"{float(number[0]):.4g}", printable(slider))
        for slider in sliders
    ]
    names = [textwrap.fill(slider, 24, break_long_words=False) for slider in short]
    slanted = {"rotation": 30, "ha": "right"} if len(sliders) > 3 else {}
    ticks = axes.set_xticks(range(1, len(sliders) + 1), names, fontsize=7, **slanted)
    for tick in ticks:
        tick.label1.set_parse_math(False)
    axes.set_xlim(0.5, len(sliders) + 0.5)


@overload
def plot_friction_sweep(
    mu: Sequence[float],
    displacement: Sequence[Sequence[float]],
    names: Sequence[str],
    highlight: Sequence[str] = (),
    figure: None = None,
    *,
    ax: None = None,
) -> Figure: ...
@overload
def plot_friction_sweep(
    mu: Sequence[float],
    displacement: Sequence[Sequence[float]],
    names: Sequence[str],
    highlight: Sequence[str] = (),
    *,
    figure: Place,
    ax: None = None,
) -> Place: ...
@overload
def plot_friction_sweep(
    mu: Sequence[float],
    displacement: Sequence[Sequence[float]],
    names: Sequence[str],
    highlight: Sequence[str] = (),
    figure: None = None,
    *,
    ax: Axes,
) -> Axes: ...
def plot_friction_sweep(
    mu: Sequence[float],
    displacement: Sequence[Sequence[float]],
    names: Sequence[str],
    highlight: Sequence[str] = (),
    figure: FigureBase | None = None,
    *,
    ax: Axes | None = None,
) -> FigureBase | Axes:
    """Plot displacements over the coefficient of friction for many records, on log axes.

    Parameters
    ----------
    mu : array_like, shape (M,)
        Coefficients of friction, positive and increasing.
    displacement : array_like, shape (R, M)
        Peak displacements [m]; a line ends at 0, which a log axis cannot show.
    names : sequence of str, length R
        The records.
    highlight : sequence of str, optional
        Names of the records to draw in color and to label, at most six.
    figure : matplotlib Figure or SubFigure, optional
        Where to draw; default: a new figure of 7 x 5 inches.
    ax : matplotlib Axes, optional
        Where to draw, instead of `figure`.

    Returns
    -------
    matplotlib Figure, SubFigure or Axes
        The axes if they were given, otherwise the figure.

    Raises
    ------
    ValueError
        Shapes that do not match; both figure and ax.
    """
    mu, displacement = np.asarray(mu, float), np.asarray(displacement, float)
    if displacement.shape != (len(names), len(mu)):
        raise ValueError(
            f"plot_friction_sweep: displacement must have shape ({len(names)}, {len(mu)}), "
            f"got {displacement.shape}"
        )
    floor = 0.01  # [cm]; to an engineer, 0.1 mm is no displacement
    lines = 100 * displacement
    lifted = sorted(
        (i for i, name in enumerate(names) if name in set(highlight)), key=lambda i: -lines[i, 0]
    )
    with style():
        figure, axes = one_panel("plot_friction_sweep", figure, ax, 7, 5)
        for line in np.delete(lines, lifted, axis=0):
            axes.plot(mu, line, color="#c4c4c4", linewidth=0.8)
        for i, color in zip(lifted, COLORS):
            axes.plot(mu, lines[i], color=color, linewidth=1.5, label=printable(names[i]))
        median = np.median(lines, axis=0)
        axes.plot(mu, median, color=INK, linewidth=3, label=f"median of {len(names)} records")
        axes.set(xscale="log", xlim=(mu[0], mu[-1]))
        axes.set_yscale("log", nonpositive="mask")  # a line ends where a block does not slip
        axes.set_ylim(floor, max(2 * lines.max(), 10 * floor))
        plain_ticks(axes, mu)
        axes.yaxis.set_major_formatter(lambda value, _: f"{value:g}")
        axes.grid(color=PALE, linewidth=0.6)
        axes.set_axisbelow(True)
        axes.set_xlabel("coefficient of friction [\N{MINUS SIGN}]")
        axes.set_ylabel("peak relative displacement [cm]")
        axes.set_title(f"How far a block slides in {len(names)} earthquake records")
        for text in axes.legend(loc="lower left", fontsize=8).get_texts():
            text.set_parse_math(False)  # a dollar sign in a file name is literal
    return figure if ax is None else ax
