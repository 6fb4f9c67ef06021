"""Carts from above: their path, their outline and their wheels."""

from __future__ import annotations

from typing import Any, overload

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure, FigureBase
from matplotlib.patches import Circle, Polygon, Rectangle
from numpy.typing import NDArray

from .._core import Cart, CartResponse, FixedWheel, SwivelCaster
from ..carts.casters import swivels
from .figures import Place, given_or_new, new_figure
from .planar import make_square, name_directions
from .player import Film, Group
from .styles import AT_RIGHT, BLUE, GRAY, INK, LATER, VERMILION, put_title, style
from .words import digits, with_remark


def describe_cart(cart: Cart) -> str:
    """A short description, such as '4 swivel casters, radius of gyration 0.35 m'."""
    kinds: dict[str, int] = {}
    for one in cart.supports:
        name = "foot"
        if isinstance(one, SwivelCaster):
            locks = {None: "swivel caster", "wheel": "caster with a locked wheel"}
            name = locks.get(one.lock, "locked caster")
        elif isinstance(one, FixedWheel):
            name = "fixed wheel"
        kinds[name] = kinds.get(name, 0) + 1
    counted = [f"{count} {_plural(name, count)}" for name, count in kinds.items()]
    return f"{', '.join(counted)}, radius of gyration {digits(cart.radius_of_gyration)} m"


def _plural(name: str, count: int) -> str:
    if count == 1:
        return name
    first, *others = name.split(" with ")
    more = "feet" if first == "foot" else f"{first}s"
    return " with ".join([more, *others])


@overload
def plot_cart_response(
    response: CartResponse, figure: None = None, title: str | None = None
) -> Figure: ...
@overload
def plot_cart_response(
    response: CartResponse, figure: Place, title: str | None = None
) -> Place: ...
def plot_cart_response(
    response: CartResponse, figure: FigureBase | None = None, title: str | None = None
) -> FigureBase:
    """Plot the path of a cart as on a map, and its displacement and yaw over time.

    On the map the axis of the ground motion points upward and the transverse direction, 90 degrees
    clockwise from it, to the right. It shows the path of the center of mass, and the outline with
    its wheels at the start, where a corner is farthest from its start, and at the end. A wheel is a
    short bar at its contact, and a line leads from a caster to its pivot. The outline drawn is the
    convex hull of all corners and supports.

    Parameters
    ----------
    response : CartResponse
    figure : matplotlib Figure or SubFigure, optional
        Where to draw; default: a new figure of 7 x 8.5 inches.
    title : str, optional
        Default: the name of the ground motion.

    Returns
    -------
    matplotlib Figure or SubFigure
        With these axes: the map, the displacement [m], and the yaw [rad].
    """
    with style():
        figure = given_or_new(figure, 7, 8.5)
        plan, way, turn = figure.subplots(3, height_ratios=(3.2, 1, 1))
        turn.sharex(way)
        put_title(plan, response.motion, title, with_remark(describe_cart(response.cart), response))
        _draw_map(plan, response)
        t, place, yaw = _path(response)
        for k, (name, color) in enumerate((("axis", BLUE), ("transverse", VERMILION))):
            way.plot(t, place[:, k], color=color, linewidth=1.1, label=name)
        way.set_ylabel("center [m]")
        way.legend(loc="center left", bbox_to_anchor=(1, 0.5), fontsize=8)
        if response.peak_yaw < 1e-9:  # round-off
            yaw = 0 * yaw
            turn.set_ylim(-1, 1)
        turn.plot(t, yaw, color=BLUE, linewidth=1.1)
        turn.set_ylabel("yaw [rad]")
        if not response.peak_outline > 0:
            way.annotate("never moves", (0.5, 0.6), xycoords="axes fraction", color=GRAY)
        turn.annotate(
            f"{'residual' if response.at_rest else 'still moving, at'}\n{yaw[-1]:.3g} rad",
            (1, yaw[-1]),
            **{**AT_RIGHT, "xycoords": ("axes fraction", "data")},
            va="center",
            color=BLUE,
        )
        for panel in (way, turn):
            panel.axhline(0, color=GRAY, linewidth=0.6, zorder=0)
        way.set_xlim(t[0], t[-1])
        way.tick_params(labelbottom=False)
        turn.set_xlabel("time [s]")
        figure.align_ylabels([way, turn])
    return figure


def _draw_map(plan: Axes, response: CartResponse) -> None:
    t, place, _ = _path(response)
    plan.plot(place[:, 1], place[:, 0], color=GRAY, linewidth=1.0, label="path of the center")
    shown = [(t[0], INK, 1.2, "start")]
    if response.peak_outline > 0:
        when = response.peak_outline_time
        peak = f"peak of a corner\n{digits(response.peak_outline)} m at {digits(when)} s"
        shown.append((when, VERMILION, 2.4, peak))  # wider, for the end may lie upon it
        shown.append((t[-1], BLUE, 1.2, "end" if response.at_rest else "end, still moving"))
    for time, color, width, label in shown:
        groups = draw_cart(plan, response, np.array([time]), color, width)
        for group in groups:
            group.show(0)
        outline = groups[0].parts[0].get_xy()
        plan.update_datalim(groups[0].frame.transform(outline))
        plan.plot([], [], color=color, linewidth=width, label=label)
    make_square(plan)
    plan.set_aspect("equal", adjustable="box", anchor="W")
    name_directions(plan, response.motion, "m")
    legend = plan.legend(loc="upper left", bbox_to_anchor=(1, 0.82), fontsize=8, borderaxespad=0.4)
    legend.set_in_layout(False)  # there is room at the right of the square


def _path(response: CartResponse) -> tuple[NDArray[np.float64], ...]:
    """Times, displacements and yaw to draw: eight in each step."""
    t = response.time
    fine = np.interp(np.arange(8 * (len(t) - 1) + 1) / 8, np.arange(len(t)), t)
    return fine, *_at(response, fine)


def _at(
    response: CartResponse, times: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Displacements and yaw at times, by cubics with the velocities at the samples."""
    t = response.time
    places = np.column_stack([response.displacement, response.yaw])
    rates = np.column_stack([response.velocity, response.yaw_rate])
    i = np.clip(np.searchsorted(t, times, "right") - 1, 0, max(len(t) - 2, 0))
    k = np.minimum(i + 1, len(t) - 1)
    step = (t[k] - t[i])[:, None]
    s = np.divide((times - t[i])[:, None], step, out=np.zeros_like(step), where=step > 0)
    s = np.clip(s, 0, 1)
    found = places[i] * (1 + 2 * s) * (1 - s) ** 2 + places[k] * s**2 * (3 - 2 * s)
    found += step * s * (1 - s) * (rates[i] * (1 - s) - rates[k] * s)
    return found[:, :2], found[:, 2]


def _hull(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """The corners of the convex hull in order (Andrew's monotone chain)."""
    ordered = [np.array(point) for point in sorted(set(map(tuple, points.tolist())))]
    if len(ordered) < 3:
        return np.array(ordered)
    halves = []
    for way in (ordered, ordered[::-1]):
        half: list[Any] = []
        for point in way:
            while len(half) > 1:
                (ax, ay), (bx, by) = half[-1] - half[-2], point - half[-1]
                if ax * by > ay * bx:
                    break
                half.pop()
            half.append(point)
        halves += half[:-1]
    return np.array(halves)


def draw_cart(
    plan: Axes,
    response: CartResponse,
    times: NDArray[np.float64],
    color: str,
    width: float = 1.2,
) -> list[Group]:
    """The outline, with its feet and fixed wheels, and each caster: groups that move on a map.

    On a map angles are clockwise. The trail is drawn no shorter than 5 % of the cart.
    """
    cart = response.cart
    center, turn = _at(response, times)
    corners = _hull(np.concatenate([cart.outline, [one.at for one in cart.supports]]))
    size = max(float(np.ptp(corners, axis=0).max()), cart.radius_of_gyration)
    length, wide = 0.08 * size, 0.025 * size  # of a wheel

    def wheel(group: Group, x: float, y: float, heading: float) -> None:
        bar = Rectangle((x - wide / 2, y - length / 2), wide, length, rotation_point="center")
        bar.set_angle(-np.degrees(heading))
        group.add(bar, color=color)

    body = Group(plan)
    body.move(center[:, 1], center[:, 0], -turn)
    outline = Polygon((corners - cart.center)[:, ::-1])
    body.add(outline, fill=False, linewidth=width, edgecolor=color)
    groups = [body]
    headings = dict(zip(swivels(cart), np.unwrap(response.heading, axis=1)))
    for i, one in enumerate(cart.supports):
        arm = np.subtract(one.at, cart.center)
        if isinstance(one, FixedWheel):
            wheel(body, arm[1], arm[0], one.heading)
        elif isinstance(one, SwivelCaster):
            heading = np.interp(
                times, response.time, headings.get(i, one.heading + 0 * response.yaw)
            )
            cos, sin = np.cos(turn), np.sin(turn)
            x = center[:, 0] + arm[0] * cos - arm[1] * sin
            y = center[:, 1] + arm[0] * sin + arm[1] * cos
            caster = Group(plan)
            caster.move(y, x, -(turn + heading))
            trail = max(one.trail or 0.0, 0.05 * size)
            caster.add(Polygon([(0, 0), (0, -trail)], closed=False), color=color, linewidth=1.0)
            wheel(caster, 0, -trail, 0)
            pivot = Circle((0, 0), 0.012 * size)
            caster.add(pivot, facecolor="white", edgecolor=color, zorder=3)
            groups.append(caster)
        else:
            body.add(Circle((arm[1], arm[0]), 0.02 * size), color=color)
    return groups


def film_of_cart(
    response: CartResponse,
    times: NDArray[np.float64],
    title: str | None,
    inches: tuple[float, float],
) -> tuple[Figure, Film]:
    """The cart from above, and the path of its center, in each frame."""
    figure = new_figure(*inches)
    plan = figure.subplots()
    t, place, _ = _path(response)
    inside = (t > times[0]) & (t < times[-1])
    when = np.concatenate([t[inside], times])
    order = np.argsort(when, kind="stable")
    points = np.concatenate([place[inside], _at(response, times)[0]])[order, ::-1]
    plan.plot(*points.T, color=LATER, linewidth=1)
    line = plan.plot([], [], color=BLUE, linewidth=1.4)[0]
    dot = plan.plot([], [], "o", color=VERMILION, markersize=5, zorder=4)[0]
    low_x, low_y, high_x, high_y = response.reach_outline
    plan.update_datalim([(low_y, low_x), (high_y, high_x)])
    make_square(plan)
    plan.set_aspect("equal", adjustable="box", anchor="W")  # north is at the right
    name_directions(plan, response.motion, "m")
    put_title(plan, response.motion, title, describe_cart(response.cart))
    film = Film(times)
    film.groups = draw_cart(plan, response, times, INK)
    film.clock = plan.text(0.02, 0.02, "", transform=plan.transAxes, color=GRAY)
    film.follow(plan, line, dot, when[order], points)
    return figure, film
