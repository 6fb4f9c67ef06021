"""Responses over time."""

from __future__ import annotations

from collections.abc import Sequence
from typing import overload

import numpy as np
from matplotlib.figure import Figure, FigureBase

from .._core import Response
from .figures import Place, given_or_new
from .panels import (
    draw_gap,
    draw_ground,
    draw_normal_force,
    draw_stops,
    mark_end,
    mark_peak,
    near_stops,
    note_levels,
    shade_sticks,
)
from .styles import (
    AT_RIGHT,
    BLUE,
    COLORS,
    GRAY,
    INK,
    dot_at_right,
    put_title,
    room_over,
    style,
    wrap,
)
from .trajectory import has_friction, slip_bounds, sticks, window, within
from .words import describe, digits, in_places, unit_for, with_remark

_LIFTED = 1e-4  # [m]; smaller gaps have no panel


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
    figure: Place,
    title: str | None = None,
    *,
    time: tuple[float, float] | None = None,
) -> Place: ...
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
    it exceeds 0.1 mm at a sample; both shade the times without contact. The remark of the response,
    if it has one, is below the title.

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
    begin, end = window("plot_response", response, time)
    lifted = response.contact == "flight" and response.gap.max() > _LIFTED
    more = 0 if "vertical" not in response.components else 2 if lifted else 1
    with style():
        figure = given_or_new(figure, 7, 6 + 1.4 * more)
        ground, speed, way, *below = figure.subplots(
            3 + more, sharex=True, height_ratios=(1, 1, 1.25, 0.8, 0.8)[: 3 + more]
        )
        curve = response._curve()
        peak = np.abs(curve["displacement"]).max()
        curve = curve[within(curve["time"], begin, end)]
        t, x, v = (curve[name] for name in ("time", "displacement", "velocity"))
        length, unit = unit_for(np.abs(x).max())
        fast, fast_unit = unit_for(np.abs(v).max())

        heading = with_remark(describe(response.slider), response)
        put_title(ground, response.motion, title, heading)
        draw_ground(ground, response, begin, end)
        lower, upper = slip_bounds(response.slider, curve)
        if "liftoff" in response.events["kind"]:  # nothing holds a slider in flight
            flies = curve["normal"] == 0
            lower, upper = np.where(flies, np.nan, lower), np.where(flies, np.nan, upper)
        if not (np.isinf(lower).any() or np.isinf(upper).any()):
            ground.fill_between(t, lower, upper, color=BLUE, alpha=0.12, linewidth=0, zorder=0)
        for bound, edge in ((lower, "forward"), (upper, "backward")):
            if not np.isinf(bound).any():
                ground.plot(t, bound, color=BLUE, linewidth=0.9, label=f"slip level {edge}")
        note_levels(ground, response)

        shade_sticks(speed, sticks(response))
        speed.plot(t, v * fast, color=INK, linewidth=0.9)
        if not v.any():
            speed.set_ylim(-1, 1)
        speed.set_ylabel(f"relative velocity\n[{fast_unit}/s]")
        if has_friction(response.slider):
            speed.annotate("shaded:\nstuck", (1, 0.5), **AT_RIGHT, va="center", color=GRAY)

        way.plot(t, x * length, color=BLUE, linewidth=1.4)
        way.axhline(0, color=GRAY, linewidth=0.6, zorder=0)
        way.set_ylabel(f"relative displacement\n[{unit}]")
        way.set_xlim(begin, end)
        stops = [length * y for y in near_stops(response.slider, np.abs(x).max())]
        mark_peak(way, t, x * length, unit, peak * length, stops)
        mark_end(way, response, t, x, length, unit, end)
        draw_stops(way, stops, unit, t[np.abs(x).argmax()])
        if below:
            draw_normal_force(below[0], response, curve, begin, end)
        if lifted:
            draw_gap(below[1], response, begin, end)
        figure.axes[-1].set_xlabel("time [s]")
        figure.align_ylabels()
    return figure


@overload
def plot_responses(
    responses: Sequence[Response], labels: Sequence[str] | None = None, figure: None = None
) -> Figure: ...
@overload
def plot_responses(
    responses: Sequence[Response], labels: Sequence[str] | None = None, *, figure: Place
) -> Place: ...
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
        labels = [describe(r.slider) for r in responses]
    if len(labels) != len(responses):
        raise ValueError(
            f"plot_responses: needs a label for each of {len(responses)} responses, got"
            f" {len(labels)}"
        )
    with style():
        figure = given_or_new(figure, 7, 5)
        ground, way = figure.subplots(2, sharex=True, height_ratios=(1, 1.7))
        length, unit = unit_for(max(r.peak for r in responses))
        put_title(ground, responses[0].motion)
        end = max(r.events["time"][-1] for r in responses)
        draw_ground(ground, responses[0], responses[0].time[0], end)
        for i, (response, label) in enumerate(zip(responses, labels)):
            color = COLORS[i % len(COLORS)]
            dashes = ("-", "--", ":")[i // len(COLORS) % 3]
            curve = response._curve()
            t, x = curve["time"], curve["displacement"]
            for bound in slip_bounds(response.slider, curve):
                if np.isfinite(bound).all():
                    ground.plot(t, bound, color=color, linestyle=dashes, linewidth=0.8)
            way.plot(
                t,
                x * length,
                color=color,
                linestyle=dashes,
                label=wrap(
                    f"{label}: peak {digits(response.peak * length)} {unit}, "
                    f"{'residual' if response.at_rest else 'still sliding at'} "
                    f"{in_places(response.residual, response.peak, length)} {unit}",
                    0.9 * room_over(way),
                    9,
                ),
            )
            dot_at_right(way, response.residual * length, color)
        way.axhline(0, color=GRAY, linewidth=0.6, zorder=0)
        way.set_ylabel(f"relative displacement\n[{unit}]")
        way.set_xlabel("time [s]")
        way.set_xlim(responses[0].time[0], end)
        way.legend(loc="upper center", bbox_to_anchor=(0.5, -0.2), alignment="left")
        figure.align_ylabels()
    return figure
