"""Pictures in a common style; needs matplotlib (``pip install stickslip[plot]``).

Pictures of one panel are drawn into ``ax=``, pictures of several into ``figure=``, a Figure or
SubFigure, and return what they were given: so they fit into a figure that `plt.subplots` made.
Without either they make a new matplotlib Figure and return it: a notebook shows it, `save` or its
own `savefig` writes it. If pyplot was imported and has windows, plt.show() shows it too; otherwise
pyplot is not touched. The colors are those of Okabe and Ito, which color-blind readers can
distinguish, also in grayscale print.
"""

from __future__ import annotations

import io
import json
import os
import re
import sys
import textwrap
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, Protocol, TypeVar, overload

import numpy as np

try:
    import matplotlib
    from matplotlib.axes import Axes
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure, FigureBase
    from matplotlib.font_manager import FontProperties
    from matplotlib.textpath import text_to_path
except ImportError as error:
    raise ImportError(
        "stickslip.plotting: plots need matplotlib, which is missing; pip install stickslip[plot]"
    ) from error

from . import _core
from ._core import (
    STANDARD_GRAVITY,
    Ensemble,
    Estimate,
    GroundMotion,
    HarmonicMotion,
    Moments,
    Response,
    ResponseSpectrum,
)
from ._files import replacing
from ._text import printable
from .ensemble.tables import impact_probabilities

__all__ = [
    "plot_comparison",
    "plot_ensemble",
    "plot_friction_sweep",
    "plot_ground_motion",
    "plot_hysteresis",
    "plot_response",
    "plot_response_spectrum",
    "plot_responses",
    "plot_sweep",
    "save",
    "sticks",
    "style",
    "without_contact",
]

_Place = TypeVar("_Place", bound=FigureBase)

INK, GRAY, PALE = "#222222", "#8a8a8a", "#e6e6e6"
BLUE, VERMILION, GREEN = "#0072b2", "#d55e00", "#009e73"
COLORS = (BLUE, VERMILION, GREEN, "#cc79a7", "#e69f00", "#56b4e9")
SUFFIXES = (".png", ".pdf", ".svg")
_LIFTED = 1e-4  # [m]; smaller gaps have no panel


def style() -> Any:
    """The style of the library's pictures, as a context: ``with style(): ...``."""
    return matplotlib.rc_context(
        {
            "font.size": 9,
            "axes.titlesize": 10,
            "axes.titleweight": "bold",
            "axes.titlelocation": "left",
            "axes.labelcolor": INK,
            "axes.edgecolor": GRAY,
            "axes.linewidth": 0.8,
            "axes.spines.top": False,
            "axes.spines.right": False,
            "axes.unicode_minus": True,
            "axes.prop_cycle": matplotlib.cycler(color=COLORS),
            "text.color": INK,
            "xtick.color": GRAY,
            "ytick.color": GRAY,
            "xtick.labelcolor": INK,
            "ytick.labelcolor": INK,
            "lines.linewidth": 1.1,
            "lines.solid_capstyle": "round",
            "legend.frameon": False,
            "savefig.dpi": 140,
            "pdf.fonttype": 42,
            "svg.hashsalt": "stickslip",
        }
    )


# Backends in which plt.show() shows nothing, or repeats what a notebook shows anyway.
_WITHOUT_WINDOWS = (
    *("agg", "cairo", "pdf", "pgf", "ps", "svg", "template", "inline"),
    "module://matplotlib_inline.backend_inline",
)


class _Picture(Figure):
    """A figure that a notebook shows even if pyplot was never imported."""

    def _repr_png_(self) -> bytes:
        return _render(self, "png")


def save(figure: Figure, file: str | os.PathLike[str]) -> Path:
    """Write a figure to a file, whole or not at all.

    Symbolic links are followed; an existing file keeps its mode.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    file : path-like
        The suffix, .png, .pdf or .svg, determines the format.

    Returns
    -------
    Path

    Raises
    ------
    ValueError
        An unknown suffix.
    OSError
        The folder is missing or cannot be written; the file is read-only or not a regular file.
    """
    path = Path(file)
    content = _render(figure, check_suffix(path))
    with replacing(path) as stream:
        stream.write(content)
    return path


def check_suffix(file: Path) -> str:
    """The format 'png', 'pdf' or 'svg' from a file's suffix; ValueError for other suffixes."""
    if file.suffix.lower() not in SUFFIXES:
        raise ValueError(f"plot: the file must end in {', '.join(SUFFIXES)}, got '{file}'")
    return file.suffix.lower()[1:]


def sticks(response: Response) -> np.ndarray:
    """The intervals in which the slider stuck.

    Parameters
    ----------
    response : Response

    Returns
    -------
    ndarray, shape (S, 2)
        Begin and end of each stick [s], sorted by time; the last may end with the response.
    """
    events = response.events
    kinds, times = events["kind"], events["time"]
    begins = np.append(response.time[0], times[kinds == "arrest"])
    ends = np.append(times[kinds == "breakaway"], times[-1])[: len(begins)]
    spans = np.column_stack([begins, ends])
    return spans[ends > begins]


def without_contact(response: Response) -> np.ndarray:
    """When nothing pressed the slider on the ground.

    Parameters
    ----------
    response : Response

    Returns
    -------
    ndarray, shape (S, 2)
        Begin and end [s], in order of time: of each flight, or with ``contact='clipped'`` of each
        time in which the ground fell faster than the slider. The last may end with the response.
    """
    events = response.events
    end = events["time"][-1]
    if response.contact == "flight":
        begins = events["time"][events["kind"] == "liftoff"]
        ends = np.append(events["time"][events["kind"] == "landing"], end)[: len(begins)]
        return np.column_stack([begins, ends])
    t = response.time
    if response.motion.interpolation == "constant":
        falls = np.append(_pressing(response, t[:-1]) < 0, False)
        edges = np.flatnonzero(np.diff(np.concatenate([[False], falls])))
        return np.column_stack([t[edges[::2]], t[edges[1::2]]])
    pressing = _pressing(response, t)
    falls = pressing < 0
    edges = np.flatnonzero(falls[1:] != falls[:-1])  # N is a straight line from one to the next
    before, after = pressing[edges], pressing[edges + 1]
    crossings = t[edges] + (t[edges + 1] - t[edges]) * before / (before - after)
    crossings = np.concatenate([t[:1][falls[:1]], crossings, t[-1:][falls[-1:]]])
    return crossings.reshape(-1, 2)


@overload
def plot_response(
    response: Response,
    figure: None = None,
    title: str | None = None,
    *,
    time: tuple[float, float] | None = None,
) -> Figure: ...
@overload
def plot_response(
    response: Response,
    figure: _Place,
    title: str | None = None,
    *,
    time: tuple[float, float] | None = None,
) -> _Place: ...
def plot_response(
    response: Response,
    figure: FigureBase | None = None,
    title: str | None = None,
    *,
    time: tuple[float, float] | None = None,
) -> FigureBase:
    """Plot ground acceleration, velocity and displacement of a response, one above the other.

    The first panel shows the accelerations that friction can resist as a band: a slider at rest
    stays at rest while the ground acceleration is between -level_forward - wn^2 x and
    level_backward - wn^2 x, where x is the current displacement. The second panel shades the
    sticks; the third marks peak and residual, and draws stops near the displacement as lines. If
    the slider settled after the last sample, the picture shows that tail too. Under vertical
    motion a fourth panel shows the normal force, and a fifth the gap between slider and ground if
    it exceeds 0.1 mm at a sample; both shade the times without contact.

    Parameters
    ----------
    response : Response
        The result of `integrate`.
    figure : matplotlib Figure or SubFigure, optional
        Where to draw; default: a new figure 7 inches wide, and 6 inches high with three panels.
    title : str, optional
        Default: the name of the ground motion.
    time : tuple of float, optional
        Begin and end of the part to draw [s], such as (0, 25); default: all of the response. The
        peak is marked if it lies in this part.

    Returns
    -------
    matplotlib Figure or SubFigure
        With these axes: ground acceleration [g], relative velocity, relative displacement; then
        normal force over the weight [g] and gap, if drawn.

    Raises
    ------
    ValueError
        A time that does not begin before it ends, or lies outside the response.
    """
    begin, end = _window("plot_response", response, time)
    lifted = response.contact == "flight" and response.gap.max() > _LIFTED
    more = 0 if "vertical" not in response.components else 2 if lifted else 1
    with style():
        figure = figure or new_figure(7, 6 + 1.4 * more)
        ground, speed, way, *below = figure.subplots(
            3 + more, sharex=True, height_ratios=(1, 1, 1.25, 0.8, 0.8)[: 3 + more]
        )
        path = _path(response)
        t, x, v = (history[_within(path[0], begin, end)] for history in path)
        length, unit = _unit(np.abs(x).max())
        fast, fast_unit = _unit(np.abs(v).max())

        _title(ground, response.motion, title, _describe(response.slider))
        _draw_ground(ground, response, begin, end)
        lower, upper = _held(response, t, x)
        if "liftoff" in response.events["kind"]:  # nothing holds a slider in flight
            flies = _normal(response, t) == 0
            lower, upper = np.where(flies, np.nan, lower), np.where(flies, np.nan, upper)
        if not (np.isinf(lower).any() or np.isinf(upper).any()):
            ground.fill_between(t, lower, upper, color=BLUE, alpha=0.12, linewidth=0, zorder=0)
        for bound, edge in ((lower, "forward"), (upper, "backward")):
            if not np.isinf(bound).any():
                ground.plot(t, bound, color=BLUE, linewidth=0.9, label=f"slip level {edge}")
        _note_levels(ground, response)

        spans = sticks(response)
        speed.broken_barh(
            np.column_stack([spans[:, 0], np.diff(spans)[:, 0]]),
            (0, 1),
            transform=speed.get_xaxis_transform(),
            color=PALE,
            linewidth=0,
            zorder=0,
            label="stuck",
        )
        speed.plot(t, v * fast, color=INK, linewidth=0.9)
        if not v.any():
            speed.set_ylim(-1, 1)
        speed.set_ylabel(f"relative velocity\n[{fast_unit}/s]")
        if _has_friction(response.slider):
            speed.annotate("shaded:\nstuck", (1, 0.5), **_AT_RIGHT, va="center", color=GRAY)

        way.plot(t, x * length, color=BLUE, linewidth=1.4)
        way.axhline(0, color=GRAY, linewidth=0.6, zorder=0)
        way.set_ylabel(f"relative displacement\n[{unit}]")
        way.set_xlim(begin, end)
        _mark_peak(way, t, x * length, unit, np.abs(path[1]).max() * length)
        _mark_end(way, response, t, x, length, unit, end)
        _draw_stops(way, response, length, np.abs(x).max())
        if below:
            _draw_normal_force(below[0], response, begin, end)
        if lifted:
            _draw_gap(below[1], response, begin, end)
        figure.axes[-1].set_xlabel("time [s]")
        figure.align_ylabels()
    return figure


def _draw_stops(axes: Axes, response: Response, length: float, largest: float) -> None:
    stops = response.slider.stops
    if stops is None:
        return
    near = [
        place * length
        for place in (stops.gap, -stops.backward)
        if abs(place) <= 1.25 * largest  # else the motion would be drawn small
    ]
    low, high = axes.get_ylim()
    room = 0.14 * (high - low)
    axes.set_ylim(min([low, *(y - room for y in near)]), max([high, *(y + room for y in near)]))
    for y in near:
        axes.axhline(y, color=INK, linewidth=1.2, label="stop", zorder=1)
        axes.annotate(
            f"stop {_digits(y)} {_unit_of(length)}",
            (1, y),
            xycoords=("axes fraction", "data"),
            xytext=(-3, -2 if y < 0 else 2),  # beyond the stop, where nothing moves
            textcoords="offset points",
            ha="right",
            va="top" if y < 0 else "bottom",
            fontsize=8,
        )


def _shade_without_contact(axes: Axes, response: Response, begin: float, end: float) -> None:
    spans = np.clip(without_contact(response), begin, end)
    spans = spans[spans[:, 1] > spans[:, 0]]
    if len(spans):
        axes.broken_barh(
            np.column_stack([spans[:, 0], np.diff(spans)[:, 0]]),
            (0, 1),
            transform=axes.get_xaxis_transform(),
            color=VERMILION,
            alpha=0.25,
            linewidth=0,
            zorder=0,
            label="without contact",
        )
    if len(spans) and np.diff(spans).max() > 0.001 * (end - begin):  # else too narrow to be seen
        axes.annotate(
            "shaded:\nwithout\ncontact", (1, 0.5), **_AT_RIGHT, va="center", color=VERMILION
        )
    elif len(spans):
        count = f"{len(spans):,} {'time' if len(spans) == 1 else 'times'}"
        axes.annotate(
            f"no contact\n{count}, for\n{_digits(1e3 * np.diff(spans).max())} ms\nat most",
            (1, 0.5),
            **_AT_RIGHT,
            va="center",
            color=VERMILION,
        )


def _draw_normal_force(axes: Axes, response: Response, begin: float, end: float) -> None:
    edges = without_contact(response).ravel()
    t = np.concatenate([response.time, edges, np.nextafter(edges, -np.inf)])  # a landing is a jump
    t = np.sort(t[t >= response.time[0]])
    t = t[_within(t, begin, end)]
    held = response.motion.interpolation == "constant"
    axes.plot(
        t,
        _normal(response, t) / STANDARD_GRAVITY,
        color=INK,
        linewidth=0.6,
        drawstyle="steps-post" if held else "default",
    )
    _shade_without_contact(axes, response, begin, end)
    axes.set_ylim(bottom=0)
    axes.set_ylabel("normal force\n[g]")


def _draw_gap(axes: Axes, response: Response, begin: float, end: float) -> None:
    inside = _within(response.time, begin, end)
    t, gap = response.time[inside], response.gap[inside]
    length, unit = _unit(gap.max())
    axes.plot(t, gap * length, color=INK, linewidth=0.9)
    _shade_without_contact(axes, response, begin, end)
    axes.set_ylim(bottom=0)
    axes.set_ylabel(f"gap to the ground\n[{unit}]")


@overload
def plot_responses(
    responses: Sequence[Response], labels: Sequence[str] | None = None, figure: None = None
) -> Figure: ...
@overload
def plot_responses(
    responses: Sequence[Response], labels: Sequence[str] | None = None, *, figure: _Place
) -> _Place: ...
def plot_responses(
    responses: Sequence[Response],
    labels: Sequence[str] | None = None,
    figure: FigureBase | None = None,
) -> FigureBase:
    """Plot the displacements of several sliders under the same ground motion in one panel.

    Parameters
    ----------
    responses : sequence of Response
        At least one, all to the same ground motion.
    labels : sequence of str, optional
        A label for each response; default: the slip level of its slider.
    figure : matplotlib Figure or SubFigure, optional
        Where to draw; default: a new figure of 7 x 5 inches.

    Returns
    -------
    matplotlib Figure or SubFigure
        With two axes: ground acceleration [g], relative displacement.

    Raises
    ------
    ValueError
        No response, different ground motions, or the wrong number of labels.
    """
    if not responses:
        raise ValueError("plot_responses: needs at least one response, got none")
    if any(
        not np.array_equal(r.motion.acceleration, responses[0].motion.acceleration)
        or not np.array_equal(r.motion.time, responses[0].motion.time)
        for r in responses[1:]
    ):
        raise ValueError("plot_responses: all responses must be to the same ground motion")
    if labels is None:
        labels = [_describe(r.slider) for r in responses]
    if len(labels) != len(responses):
        raise ValueError(
            f"plot_responses: needs a label for each of {len(responses)} responses, got"
            f" {len(labels)}"
        )
    with style():
        figure = figure or new_figure(7, 5)
        ground, way = figure.subplots(2, sharex=True, height_ratios=(1, 1.7))
        length, unit = _unit(max(r.peak for r in responses))
        _title(ground, responses[0].motion)
        end = max(r.events["time"][-1] for r in responses)
        _draw_ground(ground, responses[0], responses[0].time[0], end)
        for i, (response, label) in enumerate(zip(responses, labels)):
            color = COLORS[i % len(COLORS)]
            dashes = ("-", "--", ":")[i // len(COLORS) % 3]
            t, x, _ = _path(response)
            for bound in _held(response, t, x):
                if np.isfinite(bound).all():
                    ground.plot(t, bound, color=color, linestyle=dashes, linewidth=0.8)
            way.plot(
                t,
                x * length,
                color=color,
                linestyle=dashes,
                label=_wrap(
                    f"{label}: peak {_digits(response.peak * length)} {unit}, "
                    f"{'residual' if response.at_rest else 'still sliding at'} "
                    f"{_places(response.residual, response.peak, length)} {unit}",
                    0.9 * _room(way),
                    9,
                ),
            )
            _dot_at_right(way, response.residual * length, color)
        way.axhline(0, color=GRAY, linewidth=0.6, zorder=0)
        way.set_ylabel(f"relative displacement\n[{unit}]")
        way.set_xlabel("time [s]")
        way.set_xlim(responses[0].time[0], end)
        way.legend(loc="upper center", bbox_to_anchor=(0.5, -0.2), alignment="left")
        figure.align_ylabels()
    return figure


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
        figure, axes = _one_panel("plot_ground_motion", None, ax, 7, 2.5)
        t, n = motion.time, motion.acceleration / STANDARD_GRAVITY
        held = motion.interpolation == "constant"
        axes.plot(t, n, color=INK, linewidth=0.6, drawstyle="steps-post" if held else "default")
        acting = n[:-1] if held else n
        peak = int(np.abs(acting).argmax())
        axes.plot(t[peak], n[peak], "o", color=VERMILION, markersize=4)
        axes.annotate(
            f"PGA {_digits(abs(n[peak]))} g",
            (t[peak], n[peak]),
            xytext=(5, 0),
            textcoords="offset points",
            va="center",
            fontsize=8,
        )
        axes.set(xlabel="time [s]", ylabel="ground acceleration [g]", xlim=(t[0], t[-1]))
        _title(axes, motion, title)
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
        Default: 'Elastic response spectrum'.

    Returns
    -------
    matplotlib Figure or Axes
        The axes if they were given, otherwise the new figure.
    """
    with style():
        figure, axes = _one_panel("plot_response_spectrum", None, ax, 6, 4)
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
        if _is_geometric(spectrum.periods[order]):
            axes.set_xscale("log")
            _plain_ticks(axes, spectrum.periods)
        axes.grid(color=PALE, linewidth=0.6)
        axes.set_axisbelow(True)
        axes.set_title(_wrapped(axes, title or "Elastic response spectrum"))
        axes.legend(fontsize=8)
    return figure if ax is None else ax


def _is_geometric(x: np.ndarray) -> bool:
    """Whether increasing values are spaced geometrically, over more than a factor of two."""
    if len(x) < 3 or x[0] <= 0 or x[-1] <= 2 * x[0]:
        return False
    steps = np.diff(np.log(x))
    return bool(np.ptp(steps) < 0.01 * steps.mean())


def _plain_ticks(axes: Axes, x: np.ndarray) -> None:
    """Label a log axis with 1, 2 and 5 times the powers of ten within the range of x."""
    steps = [m * 10.0**e for e in range(-6, 7) for m in (1, 2, 5)]
    ticks = [m for m in steps if x.min() * (1 - 1e-9) <= m <= x.max() * (1 + 1e-9)]
    axes.set_xticks(ticks, [f"{m:g}" for m in ticks])
    axes.minorticks_off()


@overload
def plot_hysteresis(
    response: Response,
    figure: None = None,
    title: str | None = None,
    *,
    ax: None = None,
    time: tuple[float, float] | None = None,
) -> Figure: ...
@overload
def plot_hysteresis(
    response: Response,
    figure: _Place,
    title: str | None = None,
    *,
    ax: None = None,
    time: tuple[float, float] | None = None,
) -> _Place: ...
@overload
def plot_hysteresis(
    response: Response,
    figure: None = None,
    title: str | None = None,
    *,
    ax: Axes,
    time: tuple[float, float] | None = None,
) -> Axes: ...
def plot_hysteresis(
    response: Response,
    figure: FigureBase | None = None,
    title: str | None = None,
    *,
    ax: Axes | None = None,
    time: tuple[float, float] | None = None,
) -> FigureBase | Axes:
    """Plot the force between the mass and the ground over the displacement.

    The force is friction + damper + spring over the weight: per unit mass, in g. If there is a
    spring, the picture shows the secant of the loop with the largest displacement, with
    `Response.effective_period` and `effective_damping`.

    Parameters
    ----------
    response : Response
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
    begin, end = _window("plot_hysteresis", response, time)
    with style():
        figure, axes = _one_panel("plot_hysteresis", figure, ax, 6, 4.5)
        times, x, force = _force_path(response)
        inside = (times >= begin) & (times <= end)
        x, force = x[inside], force[inside]
        length, unit = _unit(response.peak)
        axes.plot(x * length, force / STANDARD_GRAVITY, color=BLUE, linewidth=0.9)
        axes.axhline(0, color=GRAY, linewidth=0.6, zorder=0)
        axes.axvline(0, color=GRAY, linewidth=0.6, zorder=0)
        axes.set_xlabel(f"relative displacement [{unit}]")
        axes.set_ylabel("force per unit mass [g]")
        _title(axes, response.motion, title, _describe(response.slider))
        try:
            period, damping = response.effective_period, response.effective_damping
        except ValueError:
            pass  # there is no loop
        else:
            reach = np.array([-response.peak, response.peak])
            secant = (2 * np.pi / period) ** 2 * reach / STANDARD_GRAVITY
            label = f"effective period {_digits(period)} s, damping {_digits(100 * damping)} %"
            axes.plot(reach * length, secant, color=VERMILION, linestyle="--", label=label)
            low, high = axes.get_ylim()
            axes.set_ylim(low, high + 0.12 * (high - low))  # room for the legend
            axes.legend(loc="upper left", fontsize=8)
    return figure if ax is None else ax


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
    with style():
        figure, axes = _one_panel("plot_sweep", None, ax, 7, 4.5)
        for (label, x, places), color in zip(curves, COLORS):
            marker = "o" if len(places) == 1 or not name else None
            if len(table.records) == 1:  # the polarities of one record, without statistics
                _draw_polarities(axes, table, x, values[places, 0], color, label, marker)
                continue
            lowest, low, middle, high, highest = quantiles[:, places]
            if not name:  # sliders in no order, which lines would suggest
                if samples <= _THIN_LINES:
                    thin = values[places].reshape(len(places), -1)
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
                thin = values[places].reshape(len(places), -1)
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
            axes.plot(x, middle, color=color, linewidth=2, label=label or shown, marker=marker)
        axes.set_xlabel(axis.get(name, name))
        axes.set_ylabel(
            f"{heading}{' displacement' if quantity != 'sliding_distance' else ''} [cm]"
        )
        axes.grid(color=PALE, linewidth=0.6)
        axes.set_axisbelow(True)
        x = np.concatenate([x for _, x, _ in curves])
        if name and x.min() > 0 and x.max() > 5 * x.min():
            axes.set_xscale("log")
            _plain_ticks(axes, x)
        shown_values = quantiles[1:4][np.isfinite(quantiles[1:4]) & (quantiles[1:4] > 0.01)]
        if shown_values.size and shown_values.max() > 10 * shown_values.min():
            axes.set_yscale("log")  # down to 0.1 mm, which is no displacement
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
        axes.set_title(_wrapped(axes, heading))
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
    figure: _Place,
    ax: None = None,
) -> _Place: ...
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
    lines = np.maximum(100 * displacement, 1e-9)  # blocks that do not slip are below the axis
    lifted = sorted(
        (i for i, name in enumerate(names) if name in set(highlight)), key=lambda i: -lines[i, 0]
    )
    with style():
        figure, axes = _one_panel("plot_friction_sweep", figure, ax, 7, 5)
        for line in np.delete(lines, lifted, axis=0):
            axes.plot(mu, line, color="#c4c4c4", linewidth=0.8)
        for i, color in zip(lifted, COLORS):
            axes.plot(mu, lines[i], color=color, linewidth=1.5, label=printable(names[i]))
        median = np.median(lines, axis=0)
        axes.plot(mu, median, color=INK, linewidth=3, label=f"median of {len(names)} records")
        axes.set(xscale="log", yscale="log", xlim=(mu[0], mu[-1]))
        axes.set_ylim(floor, max(2 * lines.max(), 10 * floor))
        ticks = [m for m in (0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 1) if mu[0] <= m <= mu[-1]]
        axes.set_xticks(ticks, [f"{m:g}" for m in ticks])
        axes.minorticks_off()
        axes.yaxis.set_major_formatter(lambda value, _: f"{value:g}")
        axes.grid(color=PALE, linewidth=0.6)
        axes.set_axisbelow(True)
        axes.set_xlabel("coefficient of friction [\N{MINUS SIGN}]")
        axes.set_ylabel("peak relative displacement [cm]")
        axes.set_title(f"How far a block slides in {len(names)} earthquake records")
        for text in axes.legend(loc="lower left", fontsize=8).get_texts():
            text.set_parse_math(False)  # a dollar sign in a file name is literal
    return figure if ax is None else ax


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
        Place among the theories of the plot, from 0; styles repeat after 210.
    """
    colors = (*COLORS, "#882255", "#999933", "#332288", "#661100")  # four of Tol's muted ones
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
def plot_comparison(
    comparison: _Comparison, figure: _Place, title: str | None = None
) -> _Place: ...
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
        With two axes: variance of x, variance of x'.
    """
    e = comparison.ensemble
    with style():
        figure = figure or new_figure(9, 4.4)
        _entitle(figure, title or _describe_ensemble(e))
        for axes, name, part in zip(
            figure.subplots(1, 2),
            ("displacement_variance", "velocity_variance"),
            ("displacement", "velocity"),
        ):
            variance, error = getattr(e, name), getattr(e, name + "_error")
            factor, unit = _unit(np.sqrt(variance.max()))
            _band(axes, e.time, variance * factor**2, error * factor**2, INK)
            axes.lines[-1].set_label("simulation")
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
            is_said = part == "velocity" and not e.stationary.is_stationary
            _note(axes, "not shown to be stationary" if is_said else "")
        figure.axes[0].legend(loc="upper left", fontsize=8)
    return figure


@overload
def plot_ensemble(ensemble: Ensemble, figure: None = None, title: str | None = None) -> Figure: ...
@overload
def plot_ensemble(ensemble: Ensemble, figure: _Place, title: str | None = None) -> _Place: ...
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
        x', and the spectral density of x' if the ensemble has it.

    Raises
    ------
    ValueError
        Fewer than two members.
    """
    e, t = ensemble, ensemble.time
    if t.size == 0:
        with style():
            figure = figure or new_figure(6, 4)
            _entitle(figure, title or _describe_ensemble(e))
            _draw_peaks(figure.subplots(), e)
        return figure
    s = e.stationary
    has_spectrum = e.configuration["velocity_spectrum"]
    with style():
        figure = figure or new_figure(9, 6)
        layout = [["way", "peaks"], ["speed", "spectrum" if has_spectrum else "peaks"]]
        axes = figure.subplot_mosaic(layout)
        way, speed, peaks = axes["way"], axes["speed"], axes["peaks"]
        _entitle(figure, title or _describe_ensemble(e))

        variance, error = e.displacement_variance, e.displacement_variance_error
        length, unit = _unit(np.sqrt(variance.max()))
        _band(way, t, variance * length**2, error * length**2, BLUE)
        growth = s.growth_rate
        central = (t >= s.begin) & (t <= s.end)
        middle = t[central].mean(), variance[central].mean()
        line = middle[1] + growth.value * (np.array([s.begin, s.end]) - middle[0])
        way.plot([s.begin, s.end], line * length**2, color=VERMILION, linestyle="--")
        _note(way, f"grows by {_with_error(growth, length**2)} {unit}\N{SUPERSCRIPT TWO}/s")
        way.set_ylabel(f"variance of displacement\n[{unit}\N{SUPERSCRIPT TWO}]")

        variance, error = e.velocity_variance, e.velocity_variance_error
        fast, fast_unit = _unit(np.sqrt(variance.max()))
        square = f"({fast_unit}/s)\N{SUPERSCRIPT TWO}"
        _band(speed, t, variance * fast**2, error * fast**2, BLUE)
        level = s.velocity_variance
        speed.plot([s.begin, s.end], [level.value * fast**2] * 2, color=VERMILION, linestyle="--")
        what = "stationary" if s.is_stationary else "not stationary:"
        if s.remark.startswith("cannot tell"):
            what = "perhaps stationary:"
        _note(speed, f"{what} {_with_error(level, fast**2)} {square}")
        speed.set_ylabel(f"variance of velocity\n[{square}]")
        for panel in (way, speed):
            panel.set(xlim=(t[0], t[-1]), xlabel="time [s]")
            panel.set_ylim(bottom=0)

        _draw_peaks(peaks, e)
        if has_spectrum:
            _draw_spectrum(axes["spectrum"], e, fast, fast_unit)
        figure.align_ylabels()
    return figure


_AT_RIGHT = {
    "xycoords": "axes fraction",
    "xytext": (6, 0),
    "textcoords": "offset points",
    "ha": "left",
    "fontsize": 8,
    "annotation_clip": False,
}


def new_figure(width: float, height: float) -> Figure:
    """An empty figure of a given size [inches].

    If pyplot has windows, plt.show() shows the figure; otherwise pyplot does not know it.
    """
    options: dict[str, Any] = {"figsize": (width, height), "layout": "constrained", "dpi": 100}
    pyplot = sys.modules.get("matplotlib.pyplot")
    if pyplot is not None and matplotlib.get_backend().lower() not in _WITHOUT_WINDOWS:
        return pyplot.figure(FigureClass=_Picture, **options)
    figure = _Picture(**options)
    FigureCanvasAgg(figure)
    return figure


def _one_panel(
    who: str, figure: FigureBase | None, ax: Axes | None, width: float, height: float
) -> tuple[FigureBase, Axes]:
    """The figure and axes of a one-panel picture: those given, or new ones."""
    if ax is not None:
        if figure is not None:
            raise ValueError(f"{who}: give figure or ax, got both")
        return ax.figure, ax
    figure = figure or new_figure(width, height)
    return figure, figure.subplots()


def _render(figure: Figure, kind: str) -> bytes:
    buffer = io.BytesIO()
    undated = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}.get(kind)
    with style():
        figure.savefig(buffer, format=kind, metadata=undated)
    return buffer.getvalue()


def _path(response: Response) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Times [s], displacements [m] and velocities [m/s] to draw: samples, events and the tail.

    Between the events of the tail they follow a cubic through x and x', which is exact without
    spring and damper.
    """
    events, last = response.events, response.time[-1]
    t = np.concatenate([response.time, events["time"]])
    x = np.concatenate([response.displacement, events["displacement"]])
    v = np.concatenate([response.velocity, events["velocity"]])
    order = np.argsort(t, kind="stable")
    t, x, v = t[order], x[order], v[order]
    knots = np.flatnonzero((t[:-1] >= last) & (np.diff(t) > 0))
    s = np.linspace(0, 1, 33)[1:-1]
    pieces = [
        (
            t[k] + h * s,
            x[k] + (x[k + 1] - x[k]) * (3 - 2 * s) * s**2
            + h * s * (1 - s) * (v[k] * (1 - s) - v[k + 1] * s),
            v[k] * (1 - s) * (1 - 3 * s) + v[k + 1] * s * (3 * s - 2)
            + 6 * s * (1 - s) * (x[k + 1] - x[k]) / h,
        )
        for k, h in ((k, t[k + 1] - t[k]) for k in knots)
    ]  # fmt: skip
    where = np.repeat(knots + 1, len(s))
    if not pieces:
        return t, x, v
    dense = (np.concatenate(column) for column in zip(*pieces))
    return tuple(np.insert(a, where, b) for a, b in zip((t, x, v), dense))


def _force_path(response: Response) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Times [s], displacements [m], forces [m/s^2]: at samples, and on both sides of events."""
    slider, events = response.slider, response.events
    t, x, v = (events[name] for name in ("time", "displacement", "velocity"))
    ways = np.sign(np.diff(x))  # of slips between events; 0 for sticks
    slid = _slid(response, t)

    # An impact keeps the velocity before it.
    rebound = -slider.stops.restitution if slider.stops is not None else 1.0
    v_after = np.where(events["kind"] == "impact", rebound * v, v)

    def force(k: np.ndarray, way: np.ndarray, velocity: np.ndarray) -> np.ndarray:
        at, speed, far = x[k], velocity[k], slid[k]
        weight = _normal(response, t[k]) / STANDARD_GRAVITY
        friction = [
            w * slider.resist(one, abs(u), backward=w < 0, sliding_distance=d, temperature=warm)
            for one, u, w, d, warm in zip(
                at.tolist(), speed.tolist(), way.tolist(), far.tolist(), _warm(response, t[k])
            )
        ]
        spring = slider.natural_frequency**2 * at * (weight if slider.pendulum else 1)
        return np.array(friction) * weight + slider.damping * speed + spring

    ends, begins = np.flatnonzero(ways) + 1, np.flatnonzero(ways)
    times = np.concatenate([t[ends], t[begins], response.time])
    places = np.concatenate([x[ends], x[begins], response.displacement])
    forces = np.concatenate(
        [
            force(ends, ways[ends - 1], v),
            force(begins, ways[begins], v_after),
            response.force,
        ]
    )
    order = np.argsort(times, kind="stable")
    return times[order], places[order], forces[order]


def _at(response: Response, t: np.ndarray, component: str) -> np.ndarray:
    """A component of the ground acceleration at given times [m/s^2]; 0 after its end."""
    motion = response.motion
    samples = getattr(motion, component, None)
    if samples is None:
        return np.zeros(np.shape(t))
    if motion.interpolation == "linear":
        return np.interp(t, motion.time, samples, right=0)
    after = np.searchsorted(motion.time, t, "right") - 1
    return np.where(t < motion.time[-1], samples[np.minimum(after, len(samples) - 1)], 0)


def _pressing(response: Response, t: np.ndarray) -> np.ndarray:
    """N at given times [m/s^2], also where it is negative."""
    if isinstance(response.motion, HarmonicMotion):
        return np.full(np.shape(t), STANDARD_GRAVITY)
    slope = np.radians(response.slider.slope_degrees)
    heavy = STANDARD_GRAVITY + _at(response, t, "vertical")
    return heavy * np.cos(slope) + _at(response, t, "acceleration") * np.sin(slope)


def _normal(response: Response, t: np.ndarray) -> np.ndarray:
    """Normal force per unit mass at given times [m/s^2], 0 in flight."""
    normal = _pressing(response, t)
    changes = response.events[np.isin(response.events["kind"], ("liftoff", "landing"))]
    flies = np.searchsorted(changes["time"], t, "right") % 2 == 1
    return np.where(flies, 0, np.maximum(normal, 0))


def _slid(response: Response, t: np.ndarray) -> np.ndarray:
    """Sliding distance [m] at given times, exact at samples and events."""
    times, x, _ = _path(response)
    slid = np.append(0, np.cumsum(np.abs(np.diff(x))))
    before = max(response.state.sliding_distance - response.sliding_distance, 0)
    return before + np.interp(t, times, slid)


def _warm(response: Response, t: np.ndarray) -> list[float | None]:
    """Surface temperature [degrees Celsius] at given times, where friction depends on it."""
    celsius = response.temperature
    if celsius is None:
        return [None] * t.size
    warm: list[float | None] = np.interp(t, response.time, celsius).tolist()
    return warm


def _held(response: Response, t: np.ndarray, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Bounds [g] of the ground acceleration that friction resists at rest, at displacements x [m].

    On a slope, bounds of its horizontal part, which changes the normal force. Without friction the
    bounds are infinite, so that nothing is drawn.
    """
    slider = response.slider
    if not _has_friction(slider):
        return np.full(x.shape, -np.inf), np.full(x.shape, np.inf)
    spring = slider.natural_frequency**2 * x
    slope = np.radians(slider.slope_degrees)
    sin, cos = np.sin(slope), np.cos(slope)
    up = 0 if isinstance(response.motion, HarmonicMotion) else _at(response, t, "vertical")
    heavy = np.maximum(STANDARD_GRAVITY + up, 0)
    if slider.pendulum:
        spring = spring * heavy / STANDARD_GRAVITY
    slid = _slid(response, t)
    forward, backward = (
        np.array(
            [
                slider.hold(at, backward=back, sliding_distance=far, temperature=warm)
                for at, far, warm in zip(x.tolist(), slid.tolist(), _warm(response, t))
            ]
        )
        / STANDARD_GRAVITY
        for back in (False, True)
    )
    lower = (heavy * (sin - forward * cos) - spring) / (cos + forward * sin)
    # Uphill, friction may resist any ground acceleration.
    gives = np.isfinite(backward) & (np.where(np.isfinite(backward), backward, 0) * sin < cos)
    level = np.where(gives, backward, 0)
    upper = np.where(gives, (heavy * (sin + level * cos) - spring) / (cos - level * sin), np.inf)
    return lower / STANDARD_GRAVITY, upper / STANDARD_GRAVITY


def _window(who: str, response: Response, time: tuple[float, float] | None) -> tuple[float, float]:
    """The begin and end of the part of a response to draw [s]."""
    first, last = (
        float(response.time[0]),
        float(max(response.time[-1], response.events["time"][-1])),
    )
    if time is None:
        return first, last
    try:
        begin, end = map(float, time)
    except (TypeError, ValueError):
        raise TypeError(
            f"{who}: time must be a begin and an end [s], such as (0, 25), got {time!r}"
        ) from None
    if not first <= begin < end or not begin < last:
        raise ValueError(
            f"{who}: time must be a begin and a later end within {first:g} to {last:g} s, got"
            f" {begin:g}, {end:g}"
        )
    return begin, min(end, last)


def _within(t: np.ndarray, begin: float, end: float) -> slice:
    """The part of sorted times from `begin` to `end`, and one more on either side."""
    first = int(np.searchsorted(t, begin, "right")) - 1
    return slice(max(first, 0), int(np.searchsorted(t, end)) + 1)


def _draw_ground(axes: Axes, response: Response, begin: float, end: float) -> None:
    motion = response.motion
    t = np.append(motion.time, [motion.time[-1], max(end, motion.time[-1])])
    n = np.append(motion.acceleration, [0, 0]) / STANDARD_GRAVITY
    inside = _within(t, begin, end)
    axes.plot(
        t[inside],
        n[inside],
        color=INK,
        linewidth=0.6,
        drawstyle="default" if motion.interpolation == "linear" else "steps-post",
    )
    axes.set_ylabel("ground acceleration\n[g]")


def _note_levels(axes: Axes, response: Response) -> None:
    """Label the slip levels at the right edge, at the height where they end."""
    slider, x = response.slider, response.residual
    if not _has_friction(slider):
        return
    end = response.events["time"][-1:]
    (lower,), (upper,) = _held(response, end, np.array([x]))
    (slid,) = _slid(response, end).tolist()
    (warm,) = _warm(response, end)
    ahead, back = (
        slider.hold(x, backward=b, sliding_distance=slid, temperature=warm) / STANDARD_GRAVITY
        for b in (False, True)
    )
    kinetic = slider.resist(x, sliding_distance=slid, temperature=warm) / STANDARD_GRAVITY
    name = "static level" if ahead > kinetic else "slip level"
    if ahead == back:
        notes = [(name, ahead, (lower + upper) / 2, "center")]
    elif np.isinf(back):
        notes = [(name, ahead, lower, "center")]
    else:
        notes = [("backward", back, upper, "bottom"), ("forward", ahead, lower, "top")]
    for name, level, height, side in notes:
        axes.annotate(
            f"{name}\n{_digits(level)} g",
            (1, height),
            **{**_AT_RIGHT, "xycoords": ("axes fraction", "data")},
            va=side,
            color=BLUE,
        )


def _mark_peak(axes: Axes, t: np.ndarray, x: np.ndarray, unit: str, peak: float) -> None:
    """Fit the vertical axis to the displacements, and mark the peak if it is among them."""
    at = np.argmax(np.abs(x))
    up = x[at] >= 0
    low, high = x.min(), x.max()
    height = high - low or 1
    axes.set_ylim(low - height * (0.07 if up else 0.18), high + height * (0.18 if up else 0.07))
    if x[at] == 0:
        axes.set_ylim(-1, 1)
        text = "does not move here" if peak else "never slips"
        axes.annotate(text, (0.5, 0.6), xycoords="axes fraction", ha="center", color=GRAY)
        return
    begin, end = axes.get_xlim()
    if abs(x[at]) < peak or not begin <= t[at] <= end:
        return
    place = (t[at] - begin) / (end - begin)
    axes.plot(t[at], x[at], "o", color=VERMILION, markersize=5, zorder=4)
    axes.annotate(
        f"peak {_digits(abs(x[at]))} {unit} at {_digits(t[at])} s",
        (t[at], x[at]),
        xytext=(0, 7 if up else -7),
        textcoords="offset points",
        ha="left" if place < 0.2 else "right" if place > 0.8 else "center",
        va="bottom" if up else "top",
        color=VERMILION,
        fontsize=8,
    )


def _mark_end(
    axes: Axes,
    response: Response,
    t: np.ndarray,
    x: np.ndarray,
    length: float,
    unit: str,
    end: float,
) -> None:
    """Mark the residual at the right edge; where the slider moves later, the displacement there."""
    events = response.events
    later = (events["kind"] == "breakaway") & (events["time"] >= end)
    if later.any() or np.interp(end, t, x) != response.residual:
        value, name = float(np.interp(end, t, x)), "here at"
    else:
        value, name = response.residual, "residual" if response.at_rest else "still sliding, at"
    _dot_at_right(axes, value * length, BLUE)
    axes.annotate(
        f"{name}\n{_places(value, response.peak, length)} {unit}",
        (1, value * length),
        **{**_AT_RIGHT, "xycoords": ("axes fraction", "data")},
        va="center",
        color=BLUE,
    )


def _dot_at_right(axes: Axes, x: float, color: str) -> None:
    """Draw a dot on the right edge, wherever the time axis ends."""
    edge = axes.get_yaxis_transform()
    axes.plot(1, x, "o", color=color, markersize=5, clip_on=False, zorder=4, transform=edge)


def _title(axes: Axes, motion: GroundMotion, title: str | None = None, below: str = "") -> None:
    name = title or printable(motion.name) or "ground motion"
    # A caller's title may contain math; a dollar sign in a file name is literal.
    below = _wrap(below, _room(axes), 8)
    pad = 6 + 12 * len(below.splitlines()) if below else None
    name = name if title and "$" in title else _wrapped(axes, name)
    axes.set_title(name, pad=pad, parse_math=bool(title))
    axes.annotate(
        below,
        (0, 1),
        xytext=(0, 6),
        xycoords="axes fraction",
        textcoords="offset points",
        fontsize=8,
    )


def _room(axes: Axes) -> float:
    """The width of a panel [points], before a layout engine has widened it."""
    return float(72 * axes.bbox.width / axes.figure.dpi)


def _wrapped(axes: Axes, title: str) -> str:
    """A title in lines that fit over a panel."""
    return _wrap(title, _room(axes), matplotlib.rcParams["axes.titlesize"], "bold")


def _wrap(text: str, room: float, size: float, weight: str = "normal") -> str:
    """Text in lines of at most `room` points; words that are longer are divided."""
    font = FontProperties(family=matplotlib.rcParams["font.family"], size=size, weight=weight)

    def width(line: str) -> float:
        return float(text_to_path.get_text_width_height_descent(line, font, False)[0])

    if "\n" in text:
        return "\n".join(_wrap(line, room, size, weight) for line in text.splitlines())
    lines, line = [], ""
    for word in text.split():
        joined = f"{line} {word}" if line else word
        if line and width(joined) > room:
            lines.append(line)
            joined = word
        while len(joined) > 1 and width(joined) > room:  # a word that is too long
            fits = next(
                n for n in range(len(joined) - 1, 0, -1) if n == 1 or width(joined[:n]) <= room
            )
            lines.append(joined[:fits])
            joined = joined[fits:]
        line = joined
    return "\n".join([*lines, line])


def _has_friction(slider: Any) -> bool:
    return bool(slider.hold() > 0 or slider.hold(backward=True) > 0)


def _describe(slider: Any) -> str:
    """A short description of a slider, such as 'slip level 0.06 g, period 3 s'."""
    return ", ".join(_in_words(json.loads(_core.describe_slider(slider))))


def _in_words(slider: Mapping[str, Any]) -> list[str]:
    """The same of its configuration, as ensembles keep it."""
    words = [*_law_in_words(slider)]
    if "reach" in slider:
        words.append(f"caster, reach {_digits(slider['reach'] * 100)} cm")
        if "rolling" in slider:
            words.append(f"of it rolling {_in_g(slider['rolling'])}")
    if "damping" in slider:
        words.append(f"viscous damping {_digits(slider['damping'])} 1/s")
    if slider.get("natural_frequency"):
        period = f"period {_digits(2 * np.pi / slider['natural_frequency'])} s"
        words.append(f"pendulum, {period}" if "pendulum" in slider else period)
    if "slope_degrees" in slider:
        words.append(f"slope {_digits(slider['slope_degrees'])}\N{DEGREE SIGN}")
    if "one_way" in slider:
        words.append("one way")
    if "stops" in slider:
        ahead, back, restitution = slider["stops"]
        places = f"{_digits(ahead * 100)} cm" if ahead is not None else ""
        if back != ahead:
            sides = ((ahead, "forward"), (back, "backward"))
            places = ", ".join(f"{_digits(d * 100)} cm {side}" for d, side in sides if d)
        words.append(f"stops at {places}, restitution {_digits(restitution)}")
    return words


def _law_in_words(law: Mapping[str, Any]) -> Iterator[str]:
    if isinstance(law.get("static"), list):
        yield from _both_ways("static level", *law["static"])
    if law["law"] == "VelocityDependent":
        yield f"slip level {_in_g(law['slow'])} slow, {_in_g(law['fast'])} fast"
    elif law["law"] == "Stribeck":
        yield f"slip level {_in_g(law['static'])} at rest, {_in_g(law['kinetic'])} fast"
    elif law["law"] == "KumarFriction":
        pressure = f"{_digits(law['static_pressure'] / 1e6)} MPa"
        yield f"mu {_digits(law['mu_ref'])} at reference, {pressure}, heated"
    elif law["law"] == "Degrading":
        yield f"slip level {_in_g(law['levels'][0])}"
        if len(law["levels"]) > 1:
            length, unit = _unit(law["distances"][-1])
            distance = f"{_digits(law['distances'][-1] * length)} {unit}"
            yield f"{_in_g(law['levels'][-1])} after {distance}"
        if law["backward"] != law["levels"]:
            yield "different backward"
    elif "slip_level" not in law:
        yield "law from functions"
    elif law["slip_level"] == 0 == law.get("backward", 0):
        yield "no friction"
    else:
        yield from _both_ways(
            "slip level", law["slip_level"], law.get("backward", law["slip_level"])
        )


def _both_ways(name: str, ahead: float | None, back: float | None) -> Iterator[str]:
    yield f"{name} {_in_g(ahead)}" + ("" if back in (ahead, None) else " forward")
    if back != ahead:
        yield "never backward" if back is None else f"{_in_g(back)} backward"


def _in_g(level: float | None) -> str:
    return "infinite" if level is None else f"{_digits(level / STANDARD_GRAVITY)} g"


def _band(axes: Axes, x: np.ndarray, y: np.ndarray, error: np.ndarray, color: str) -> None:
    """Draw a line in a band of plus and minus two standard errors."""
    axes.fill_between(x, y - 2 * error, y + 2 * error, color=color, alpha=0.25, linewidth=0)
    axes.plot(x, y, color=color)


def _note(axes: Axes, text: str, band: str = "band: two standard errors") -> None:
    """Write a line of text and an explanation of the band above the panel."""
    above = {"xycoords": "axes fraction", "textcoords": "offset points", "fontsize": 8}
    axes.annotate(text, (0, 1), xytext=(0, 4), color=VERMILION, **above)
    axes.annotate(band, (1, 1), xytext=(0, 4), color=GRAY, ha="right", **above)


def _draw_peaks(axes: Axes, ensemble: Ensemble) -> None:
    """Draw the fraction of members that exceed a peak, on a log axis, and mark quantiles."""
    e, n = ensemble, ensemble.members
    marks = [p for p in (0.5, 0.9, 0.99, 0.999, 0.9999) if n * (1 - p) >= 5]
    quantiles = [e.quantile(p) for p in marks]
    highest = e.quantile(1 - 0.5 / n).value
    length, unit = _unit(highest)
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
            f"{name}: {_digits(q.value * length)} {unit}",
            (q.value * length, 1 - p),
            xytext=(-8, -8) if at_left else (7, 3),
            textcoords="offset points",
            ha="right" if at_left else "left",
            color=VERMILION,
            fontsize=8,
        )
    hits = impact_probabilities(e).get("impact_probability")
    hit = f"{100 * hits.value:.3g} % hit a stop" if hits else ""
    _note(axes, hit, "band: 95 % confidence")
    axes.grid(color=PALE, linewidth=0.6)
    axes.set_axisbelow(True)


def _draw_spectrum(axes: Axes, ensemble: Ensemble, fast: float, fast_unit: str) -> None:
    """Draw the velocity spectrum up to the frequency below which 99.5 % of it lies."""
    s = ensemble.velocity_spectrum
    _band(axes, s.omega, s.density * fast**2, s.error * fast**2, BLUE)
    whole = np.cumsum(s.density)
    end = np.searchsorted(whole, 0.995 * whole[-1]) if whole[-1] > 0 else len(whole) - 1
    axes.set_xlim(0, s.omega[max(end, 1)])
    axes.set_ylim(bottom=0)
    _note(axes, "")
    axes.set_xlabel("angular frequency [rad/s]")
    axes.set_ylabel(
        f"two-sided density of velocity\n[({fast_unit}/s)\N{SUPERSCRIPT TWO} per rad/s]"
    )


def _with_error(estimate: Estimate, factor: float) -> str:
    """'12.34 ± 0.21': the error to two digits, the value to the same decimal place."""
    value, error = factor * estimate.value, factor * estimate.error
    if not error > 0:
        return _digits(value)
    places = max(0, 1 - int(np.floor(np.log10(error))))
    text = f"{value:.{places}f} \N{PLUS-MINUS SIGN} {error:.{places}f}"
    return text.replace("-", "\N{MINUS SIGN}")


def _entitle(figure: FigureBase, title: str) -> None:
    title = _wrap(title, 0.97 * 72 * figure.bbox.width / figure.dpi, 10, "bold")
    figure.suptitle(title, x=0.01, ha="left", fontsize=10, fontweight="bold")


def _describe_ensemble(ensemble: Ensemble) -> str:
    """A title such as '10,000 members of 60 s, slip level 0.2 g'."""
    configuration, times = ensemble.configuration, ensemble.time
    slider, excitation = configuration["slider"], configuration["excitation"]
    words = [f"{ensemble.members:,} members" + (f" of {times[-1]:.4g} s" if times.size else "")]
    if isinstance(excitation, dict) and excitation.get("excitation") == "WithVertical":
        words.append("vertical motion")
    if not isinstance(slider, dict):  # the configuration of a user-defined source
        pass
    elif "random" in slider:
        words.append("random sliders")
    elif "one_of" in slider:
        words.append(f"{len(slider['one_of'])} sliders")
    elif "law" in slider:
        words += _in_words(slider)
    return ", ".join(words)


def _unit(largest: float) -> tuple[float, str]:
    """The number of units in a meter, and the unit, for lengths up to `largest` [m]."""
    return (1e3, "mm") if 0 < largest < 0.01 else (1e2, "cm") if largest < 10 else (1, "m")


def _unit_of(length: float) -> str:
    """The unit of which `length` are a meter."""
    return {1e3: "mm", 1e2: "cm", 1: "m"}[length]


def _places(value: float, peak: float, length: float) -> str:
    """A displacement [m] in units, to three digits, but at most to 1/10,000 of the peak."""
    digits = _digits(value * length)
    if not peak > 0:
        return digits
    places = max(0, 3 - int(np.floor(np.log10(peak * length))))
    if len(digits.partition(".")[2]) <= places and "e" not in digits:
        return digits
    return f"{round(value * length, places) + 0.0:.{places}f}".replace("-", "\N{MINUS SIGN}")


def _digits(value: float) -> str:
    """Three significant digits, with a true minus sign."""
    return f"{value:#.3g}".rstrip(".").replace("-", "\N{MINUS SIGN}")
