"""The panels of a response."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from .._core import STANDARD_GRAVITY, Response, StructureResponse
from .styles import AT_RIGHT, BLUE, GRAY, INK, PALE, VERMILION, dot_at_right
from .trajectory import has_friction, slip_bounds, within, without_contact
from .words import digits, in_places, unit_for


def draw_ground(axes: Axes, response: Response, begin: float, end: float) -> None:
    motion = response.motion
    t = np.append(motion.time, [motion.time[-1], max(end, motion.time[-1])])
    n = np.append(motion.acceleration, [0, 0]) / STANDARD_GRAVITY
    inside = within(t, begin, end)
    axes.plot(
        t[inside],
        n[inside],
        color=INK,
        linewidth=0.6,
        drawstyle="default" if motion.interpolation == "linear" else "steps-post",
    )
    axes.set_ylabel("ground acceleration\n[g]")


def note_levels(axes: Axes, response: Response) -> None:
    """Label the slip levels at the right edge, at the height where they end."""
    slider, last = response.slider, response._curve()[-1:]
    if not has_friction(slider):
        return
    (lower,), (upper,) = slip_bounds(slider, last)
    ahead, back = (float(last[name][0]) / STANDARD_GRAVITY for name in ("hold", "hold_backward"))
    warm = None if response.temperature is None else float(response.temperature[-1])
    slid = response.state.sliding_distance
    kinetic = slider.resist(response.residual, sliding_distance=slid, temperature=warm)
    kinetic /= STANDARD_GRAVITY
    name = "static level" if ahead > kinetic else "slip level"
    if ahead == back:
        notes = [(name, ahead, (lower + upper) / 2, "center")]
    elif np.isinf(back):
        notes = [(name, ahead, lower, "center")]
    else:
        notes = [("backward", back, upper, "bottom"), ("forward", ahead, lower, "top")]
    for name, level, height, side in notes:
        axes.annotate(
            f"{name}\n{digits(level)} g",
            (1, height),
            **{**AT_RIGHT, "xycoords": ("axes fraction", "data")},
            va=side,
            color=BLUE,
        )


def mark_peak(
    axes: Axes, t: np.ndarray, x: np.ndarray, unit: str, peak: float, stops: Sequence[float] = ()
) -> None:
    """Fit the vertical axis to the displacements, and mark the peak if it is among them.

    Its text is beyond the peak, and beyond a stop that is near it.
    """
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
    beyond = max(
        (abs(y) for y in stops if (y >= 0) == up and abs(y - x[at]) < height / 4), default=0
    )
    beyond = max(beyond, abs(x[at]))
    axes.annotate(
        f"peak {digits(abs(x[at]))} {unit} at {digits(t[at])} s",
        (t[at], beyond if up else -beyond),
        xytext=(0, 7 if up else -7),
        textcoords="offset points",
        ha="left" if place < 0.2 else "right" if place > 0.8 else "center",
        va="bottom" if up else "top",
        color=VERMILION,
        fontsize=8,
    )


def mark_end(
    axes: Axes,
    response: Response | StructureResponse,
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
    dot_at_right(axes, value * length, BLUE)
    axes.annotate(
        f"{name}\n{in_places(value, response.peak, length)} {unit}",
        (1, value * length),
        **{**AT_RIGHT, "xycoords": ("axes fraction", "data")},
        va="center",
        color=BLUE,
    )


def near_stops(slider: Any, largest: float) -> list[float]:
    """The stops [m] that a displacement of up to `largest` comes near; others would shrink it."""
    if slider.stops is None:
        return []
    places = (slider.stops.gap, -slider.stops.backward)
    return [place for place in places if abs(place) <= 1.25 * largest]


def draw_stops(axes: Axes, stops: Sequence[float], unit: str, peak_time: float) -> None:
    """Draw stops as lines, named at the left or right edge, away from the peak."""
    low, high = axes.get_ylim()
    room = 0.14 * (high - low)
    axes.set_ylim(min([low, *(y - room for y in stops)]), max([high, *(y + room for y in stops)]))
    begin, end = axes.get_xlim()
    left = peak_time > (begin + end) / 2
    for y in stops:
        axes.axhline(y, color=INK, linewidth=1.2, label="stop", zorder=1)
        axes.annotate(
            f"stop {digits(y)} {unit}",
            (0 if left else 1, y),
            xycoords=("axes fraction", "data"),
            xytext=(3 if left else -3, -2 if y < 0 else 2),  # beyond the stop, where nothing moves
            textcoords="offset points",
            ha="left" if left else "right",
            va="top" if y < 0 else "bottom",
            fontsize=8,
        )


def shade_sticks(axes: Axes, spans: np.ndarray) -> None:
    """Shade the intervals in which the slider sticks."""
    axes.broken_barh(
        np.column_stack([spans[:, 0], np.diff(spans)[:, 0]]),
        (0, 1),
        transform=axes.get_xaxis_transform(),
        color=PALE,
        linewidth=0,
        zorder=0,
        label="stuck",
    )


def draw_normal_force(
    axes: Axes, response: Response, curve: np.ndarray, begin: float, end: float
) -> None:
    axes.plot(curve["time"], curve["normal"] / STANDARD_GRAVITY, color=INK, linewidth=0.6)
    _shade_without_contact(axes, response, begin, end)
    axes.set_ylim(bottom=0)
    axes.set_ylabel("normal force\n[g]")


def draw_gap(axes: Axes, response: Response, begin: float, end: float) -> None:
    inside = within(response.time, begin, end)
    t, gap = response.time[inside], response.gap[inside]
    length, unit = unit_for(gap.max())
    axes.plot(t, gap * length, color=INK, linewidth=0.9)
    _shade_without_contact(axes, response, begin, end)
    axes.set_ylim(bottom=0)
    axes.set_ylabel(f"gap to the ground\n[{unit}]")


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
            "shaded:\nwithout\ncontact", (1, 0.5), **AT_RIGHT, va="center", color=VERMILION
        )
    elif len(spans):
        count = f"{len(spans):,} {'time' if len(spans) == 1 else 'times'}"
        axes.annotate(
            f"no contact\n{count}, for\n{digits(1e3 * np.diff(spans).max())} ms\nat most",
            (1, 0.5),
            **AT_RIGHT,
            va="center",
            color=VERMILION,
        )
