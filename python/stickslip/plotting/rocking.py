"""Blocks that rock: their rotation, their phase plane, and the block itself."""

from __future__ import annotations

from typing import Any, overload

import numpy as np
from matplotlib.figure import Figure, FigureBase
from matplotlib.patches import Polygon
from numpy.typing import NDArray

from .._core import STANDARD_GRAVITY, RockingBlock, RockingResponse, SlenderBlock
from .figures import Place, given_or_new, new_figure
from .panels import draw_ground
from .player import Film, Group
from .styles import AT_RIGHT, BLUE, GRAY, INK, PALE, VERMILION, put_title, style
from .words import digits, with_remark

_BEYOND = 1.5  # alphas that a picture of a fall shows


def describe_block(block: SlenderBlock | RockingBlock) -> str:
    """A short description, such as 'p 2.14 rad/s, alpha 0.25 rad, restitution 0.9'."""
    if isinstance(block, RockingBlock):
        mu = "no slip" if block.mu is None else f"mu {digits(block.mu)}"
        size = f"{digits(block.width)} x {digits(block.height)} m"
        return f"{size}, {mu}, restitution {digits(block.restitution)}"
    sides = digits(block.alpha)
    if block.alpha_left != block.alpha:
        sides += f" right, {digits(block.alpha_left)} left"
    return f"p {digits(block.p)} rad/s, alpha {sides} rad, restitution {digits(block.restitution)}"


def _motion(response: RockingResponse) -> tuple[NDArray[np.float64], ...]:
    """Times, theta and theta' at samples and events, sorted; at an impact before and after it."""
    events = response.events
    after = events[np.isin(events["kind"], ("impact", "landing"))].copy()
    after["rate"] = after["rate_after"]
    parts = [events, after]
    t = np.concatenate([response.time, *(part["time"] for part in parts)])
    order = np.argsort(t, kind="stable")
    theta = np.concatenate([response.rotation, *(part["rotation"] for part in parts)])
    rate = np.concatenate([response.rate, *(part["rate"] for part in parts)])
    return t[order], theta[order], rate[order]


def _over_alpha(
    block: SlenderBlock | RockingBlock, theta: NDArray[np.float64]
) -> NDArray[np.float64]:
    return theta / np.where(theta < 0, block.alpha_left, block.alpha)


def _levels(block: SlenderBlock | RockingBlock) -> tuple[float, float]:
    """The ground accelerations over g up to which a block rests, to the left and to the right."""
    if isinstance(block, SlenderBlock):
        return block.alpha, block.alpha_left
    mu = np.inf if block.mu is None else block.mu
    return min(float(np.tan(block.alpha)), mu), min(float(np.tan(block.alpha_left)), mu)


@overload
def plot_rocking_response(
    response: RockingResponse, figure: None = None, title: str | None = None
) -> Figure: ...
@overload
def plot_rocking_response(
    response: RockingResponse, figure: Place, title: str | None = None
) -> Place: ...
def plot_rocking_response(
    response: RockingResponse, figure: FigureBase | None = None, title: str | None = None
) -> FigureBase:
    """Plot ground acceleration and theta/alpha of a response, one above the other.

    The first panel shows the accelerations under which the block rests as a band, from
    -alpha g to alpha_left g. The second marks the impacts, the peak, and the time from which an
    overturning is certain; dashed lines are at theta = alpha. Rotations beyond 1.5 alpha are cut.
    A `RockingBlock` has a third, of the displacement of its base.

    Parameters
    ----------
    response : RockingResponse
    figure : matplotlib Figure or SubFigure, optional
        Where to draw; default: a new figure of 7 x 4.5 inches.
    title : str, optional
        Default: the name of the ground motion.

    Returns
    -------
    matplotlib Figure or SubFigure
        With these axes: ground acceleration [g], theta/alpha, and the base [cm].
    """
    block = response.block
    with style():
        rigid = isinstance(block, RockingBlock)
        figure = given_or_new(figure, 7, 6 if rigid else 4.5)
        ratios = (1, 1.5, 1) if rigid else (1, 1.5)
        ground, tilt, *others = figure.subplots(len(ratios), sharex=True, height_ratios=ratios)
        put_title(ground, response.motion, title, with_remark(describe_block(block), response))
        draw_ground(ground, response, 0, float(response.time[-1]))  # type: ignore[arg-type]
        right, left = _levels(block)
        ground.axhspan(-right, left, color=BLUE, alpha=0.12, linewidth=0)
        ground.annotate("shaded:\nrests", (1, 0.5), **AT_RIGHT, va="center", color=BLUE)
        t, theta, _ = _motion(response)
        ratio = _over_alpha(block, theta)
        tilt.plot(t, ratio, color=BLUE, linewidth=1.2)
        impacts = response.events[response.events["kind"] == "impact"]["time"]
        tilt.plot(impacts, 0 * impacts, "|", color=GRAY, markersize=5, label="impact")
        tilt.axhline(0, color=GRAY, linewidth=0.6, zorder=0)
        largest = float(np.abs(ratio).max())
        if largest > 0.5:
            for side in (-1, 1):
                tilt.axhline(side, color=GRAY, linewidth=0.8, linestyle="--", zorder=0)
        if response.overturned is not None:
            tilt.set_ylim(-_BEYOND, _BEYOND)
            tilt.axvline(response.overturned_at, color=VERMILION, linewidth=0.9)
            text = f"overturns to the {response.overturned}, certain at"
            tilt.set_title(
                f"{text} {digits(response.overturned_at)} s",
                color=VERMILION,
                fontsize=8,
                fontweight="normal",
            )
        elif largest > 0:
            tilt.set_title(
                f"peak {digits(response.peak_rotation)} rad, {digits(response.peak_rotation_ratio)}"
                f" alpha, at {digits(response.peak_time)} s",
                color=VERMILION,
                fontsize=8,
                fontweight="normal",
            )
            at = np.abs(theta).argmax()
            tilt.plot(t[at], ratio[at], "o", color=VERMILION, markersize=5, zorder=4)
        else:
            tilt.annotate("never rocks", (0.5, 0.6), xycoords="axes fraction", color=GRAY)
        tilt.set_xlim(response.time[0], response.time[-1])
        tilt.set_ylabel("rotation / alpha")
        for base in others:
            base.plot(response.time, 100 * response.displacement, color=BLUE, linewidth=1.2)
            base.axhline(0, color=GRAY, linewidth=0.6, zorder=0)
            base.set_ylabel("base [cm]")
        (others or [tilt])[-1].set_xlabel("time [s]")
        figure.align_ylabels()
    return figure


@overload
def plot_rocking_phase(
    response: RockingResponse, figure: None = None, title: str | None = None
) -> Figure: ...
@overload
def plot_rocking_phase(
    response: RockingResponse, figure: Place, title: str | None = None
) -> Place: ...
def plot_rocking_phase(
    response: RockingResponse, figure: FigureBase | None = None, title: str | None = None
) -> FigureBase:
    """Plot theta'/(p alpha) over theta/alpha.

    Dashed: the separatrices of a still ground, |theta|/alpha + sgn(theta) theta'/(p alpha) = 1,
    beyond which a block falls. Impacts are the vertical jumps at theta = 0.

    Parameters
    ----------
    response : RockingResponse
    figure : matplotlib Figure or SubFigure, optional
        Where to draw; default: a new figure of 6 x 4.5 inches.
    title : str, optional
        Default: the name of the ground motion.

    Returns
    -------
    matplotlib Figure or SubFigure
    """
    block = response.block
    with style():
        figure = given_or_new(figure, 6, 4.5)
        axes = figure.subplots()
        _, theta, rate = _motion(response)
        way = np.where(theta != 0, theta, rate)
        alpha = np.where(way < 0, block.alpha_left, block.alpha)
        y, v = theta / alpha, rate / (block.p * alpha)
        axes.plot(y, v, color=BLUE, linewidth=0.9)
        for side in (-1, 1):
            axes.plot(
                [0, side * _BEYOND],
                [side, side * (1 - _BEYOND)],
                color=GRAY,
                linestyle="--",
                label="separatrix of a still ground" if side > 0 else None,
            )
        reach = min(max(np.abs(y).max(), 0.1) * 1.1, _BEYOND)
        fast = max(np.abs(v[np.abs(y) <= reach]).max() * 1.1, 0.1)
        axes.set_xlim(-reach, reach)
        axes.set_ylim(-fast, fast)
        axes.set_xlabel("rotation / alpha")
        axes.set_ylabel("rate / (p alpha)")
        axes.legend(loc="upper right", fontsize=8)
        put_title(axes, response.motion, title, with_remark(describe_block(block), response))
    return figure


def block_on_ground(
    response: RockingResponse,
    times: NDArray[np.float64],
    ground: NDArray[np.float64],
    title: str | None,
    inches: tuple[float, float],
) -> tuple[Figure, Film]:
    """The film of a block, of a `SlenderBlock` a uniform one of its p and alpha."""
    block = response.block
    figure = new_figure(*inches)
    scene, way = figure.subplots(2, 1, height_ratios=(1.3, 1))
    theta = np.interp(times, *_motion(response)[:2])
    gap = np.zeros(len(times))
    if isinstance(block, RockingBlock):
        right = left = block.width / 2
        reach = block.height
        moves = np.interp(times, response.time, response.displacement)
        gap = np.interp(times, response.time, response.gap)
    else:
        radius = 0.75 * STANDARD_GRAVITY / block.p**2
        center = radius * np.cos((block.alpha + block.alpha_left) / 2)
        right, left = center * np.tan(block.alpha), center * np.tan(block.alpha_left)
        reach = 2 * center
        moves = np.where(theta < 0, -left, right) * (1 - np.cos(theta))
    on_floor, on_body = Group(scene), Group(scene)
    scene.axhspan(-0.15 * reach, 0, color=PALE, zorder=1)
    on_floor.add(_box(-0.01 * reach, 0.01 * reach, -0.15 * reach, 0), color=GRAY, zorder=2)
    body = _box(-left, right, 0, reach)
    on_body.add(body, facecolor=BLUE, edgecolor=INK, linewidth=0.8, zorder=3)
    swing = np.ptp(ground) / 2 if len(ground) else 0.0
    middle = float(ground.max() + ground.min()) / 2
    tilted = min(1.0, 0.2 + float(np.sin(np.abs(theta).max())))
    half = swing + np.abs(moves).max() + max(right, left) + reach * tilted
    scene.set_xlim(middle - half, middle + half)
    scene.set_ylim(-0.15 * reach, 1.15 * np.hypot(reach, max(right, left)))
    scene.set_aspect("equal", adjustable="box")
    scene.axis("off")
    put_title(scene, response.motion, title, describe_block(block))

    t, values, _ = _motion(response)
    inside = (t > times[0]) & (t < times[-1])
    t = np.concatenate([t[inside], times])
    values = _over_alpha(block, np.concatenate([values[inside], theta]))
    order = np.argsort(t, kind="stable")
    points = np.column_stack([t, np.clip(values, -_BEYOND, _BEYOND)])[order]
    way.plot(*points.T, color="#c4c4c4", linewidth=1)
    line = way.plot([], [], color=BLUE, linewidth=1.4)[0]
    dot = way.plot([], [], "o", color=VERMILION, markersize=5, clip_on=False)[0]
    way.axhline(0, color=GRAY, linewidth=0.6, zorder=0)
    way.set_xlim(times[0], times[-1])
    way.set_xlabel("time [s]")
    way.set_ylabel("rotation / alpha")

    film = Film(times)
    film.groups = [on_floor, on_body]
    on_floor.move(ground, 0 * ground)
    toe = np.where(theta < 0, -left, right)
    on_body.move(ground + moves, gap + toe * np.sin(theta), -theta)
    film.body = body, [BLUE if tilt == 0 else VERMILION for tilt in theta]
    film.follow(way, line, dot, points[:, 0], points)
    return figure, film


def _box(left: float, right: float, low: float, high: float) -> Any:
    return Polygon([(left, low), (right, low), (right, high), (left, high)])


def plot_rocking_spectrum(
    spectrum: Any, figure: FigureBase | None = None, title: str | None = None
) -> Any:
    """Plot a rocking spectrum; see `RockingSpectrum.plot`."""
    with style():
        figure = given_or_new(figure, 6, 3.5)
        axes = figure.subplots()
        stands = spectrum.overturned == 0
        ratio = np.where(stands, spectrum.peak_rotation_ratio, np.nan)
        axes.plot(spectrum.periods, ratio, color=BLUE, marker=".", markersize=3)
        fell = spectrum.periods[~stands]
        axes.plot(fell, 0 * fell + 1, "x", color=VERMILION, markersize=4, label="overturns")
        axes.axhline(1, color=GRAY, linewidth=0.8, linestyle="--", zorder=0)
        axes.set_ylim(bottom=0)
        axes.set_xlabel("period 2 pi/p [s]")
        axes.set_ylabel("peak rotation / alpha")
        if len(fell):
            axes.legend(loc="lower left", fontsize=8)
        below = f"alpha {digits(spectrum.alpha)} rad, restitution {digits(spectrum.restitution)}"
        put_title(axes, spectrum.motion, title, below)
    return figure


def plot_overturning(
    ensemble: Any, figure: FigureBase | None = None, title: str | None = None
) -> Any:
    """Plot the probability of overturning over time, with its 95 % bounds.

    Parameters
    ----------
    ensemble : RockingEnsemble
        The result of `run_ensemble` with blocks.
    figure : matplotlib Figure or SubFigure, optional
        Where to draw; default: a new figure of 6 x 3.5 inches.
    title : str, optional
        Default: the number of members.

    Returns
    -------
    matplotlib Figure or SubFigure
    """
    with style():
        figure = given_or_new(figure, 6, 3.5)
        axes = figure.subplots()
        when = ensemble.overturned_at[ensemble.overturned != 0]
        last = max([ensemble.duration or 0.0, *when], default=0.0) or 1.0
        times = np.linspace(0, last, 201)
        found = np.array([tuple(one) for one in ensemble.overturning(times)])
        axes.fill_between(times, found[:, 1], found[:, 2], color=BLUE, alpha=0.25, linewidth=0)
        axes.plot(times, found[:, 0], color=BLUE)
        axes.set_xlim(0, last)
        axes.set_ylim(bottom=0)
        axes.set_xlabel("time [s]")
        axes.set_ylabel("probability of overturning")
        axes.set_title(title or f"{ensemble.members:,} members; band: 95 % bounds")
    return figure
