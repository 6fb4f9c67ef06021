"""Pictures that move: the object on its shaking floor, with its history below."""

from __future__ import annotations

import math
import os
import tempfile
from collections.abc import Iterator
from html import escape
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.animation import FFMpegWriter, FuncAnimation, PillowWriter
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Polygon, Rectangle
from numpy.typing import NDArray

from .._core import (
    CartResponse,
    EquipmentOnFloor,
    FlexibleSlope,
    PlanarResponse,
    Response,
    RockingResponse,
    Slider,
    StructureResponse,
)
from .._files import replacing
from .._structure_responses import has_floors
from ..runs.progress import Progress, shown
from .carts import film_of_cart
from .figures import new_figure
from .panels import near_stops
from .planar import draw_stop, make_square, name_directions, path_of
from .player import Film, Group
from .rocking import block_on_ground
from .styles import BLUE, GRAY, INK, LATER, PALE, VERMILION, put_title, style
from .trajectory import sticks, window
from .words import describe, describe_system, unit_for

_FRAMES = 2000  # at most
_SUFFIXES = (".gif", ".mp4", ".html")


class Animation(FuncAnimation):
    """A matplotlib animation that a notebook shows, and that `write` saves."""

    _film: Film

    def _repr_html_(self) -> str:
        width, height = (96 * inches for inches in self._fig.get_size_inches())
        frame = f'width="{width:.0f}" height="{height + 40:.0f}" style="border: 0"'
        return f'<iframe srcdoc="{escape(self._page())}" {frame}></iframe>'

    def _page(self) -> str:
        return self._film.page(self._fig, 1000 / self._interval)

    def write(
        self, path: str | os.PathLike[str], *, progress: bool | Progress | None = None
    ) -> Path:
        """Save as an animated GIF, an MP4 or a page.

        Parameters
        ----------
        path : path-like
            Its suffix is .gif (needs Pillow), .mp4 (needs ffmpeg) or .html, a page that plays one
            drawing. An existing file is replaced once the new one is whole.
        progress : bool or callable, optional
            A bar while the frames of a GIF or an MP4 are drawn, as for `run_ensemble`, or what to
            call as ``progress(done, total)`` after each.

        Returns
        -------
        Path

        Raises
        ------
        ValueError
            Another suffix.
        RuntimeError
            The program ffmpeg is missing, for .mp4.
        """
        file = Path(os.fsdecode(path))
        kind = check_moving_suffix(file)
        if kind == "mp4" and not FFMpegWriter.isAvailable():
            raise RuntimeError("animate: .mp4 needs the program ffmpeg; .gif and .html do not")
        with replacing(file) as stream:
            if kind == "html":
                stream.write(self._page().encode())
            else:
                with shown(progress, "animate", "frame") as report:
                    stream.write(self._movie(kind, report))
        return file

    def save(self, filename: str | os.PathLike[str], *args: Any, **options: Any) -> None:
        """As `write`, whole or not at all; with options as of matplotlib's own `save`."""
        if args or options:
            super().save(os.fspath(filename), *args, **options)
        else:
            self.write(filename)

    def _movie(self, kind: str, report: Progress) -> bytes:
        """The content of a GIF or an MP4; matplotlib writes either into a file."""
        writer = PillowWriter if kind == "gif" else FFMpegWriter
        with tempfile.TemporaryDirectory() as folder:
            film = Path(folder) / f"film.{kind}"
            super().save(
                film,
                writer=writer(fps=1000 / self._interval),
                progress_callback=lambda i, total: report(i + 1, total),
            )
            return film.read_bytes()


def check_moving_suffix(file: Path) -> str:
    """The format 'gif', 'mp4' or 'html' from a file's suffix; ValueError for other suffixes."""
    if file.suffix.lower() not in _SUFFIXES:
        raise ValueError(f"animate: the file must end in {', '.join(_SUFFIXES)}, got '{file}'")
    return file.suffix.lower()[1:]


def animate(
    response: Response | PlanarResponse | StructureResponse | RockingResponse | CartResponse,
    *,
    time: tuple[float, float] | None = None,
    speed: float = 1.0,
    fps: float = 15.0,
    title: str | None = None,
    size: tuple[float, float] | None = None,
) -> Animation:
    """Show the object on its moving floor, with the history of its displacement below.

    A block, a cart where the law is that of a caster, or a floor on bearings where a spring or a
    pendulum draws it back. It moves by the exact displacement at each frame; the floor moves by the
    displacement of the ground, without its mean and linear trend. Both have the same scale. The
    dishes of bearings are as wide as they must be, and deeper than they are. In the plane: the path
    as on a map, with the middle of the object on it, a circular stop near it, and north; of a cart
    its outline and wheels. Of a structure, the floors and what slides, along straight lines between
    the samples.

    Parameters
    ----------
    response : Response, PlanarResponse, StructureResponse, RockingResponse or CartResponse
    time : tuple of float, optional
        Begin and end of the part to show [s]; default: all of the response.
    speed : float, optional
        Seconds of the motion in a second of the animation, positive; 1 is real time.
    fps : float, optional
        Frames in a second, from 1 to 60. There are at most 2,000 frames.
    title : str, optional
        Default: the name of the ground motion.
    size : tuple of float, optional
        Width and height [inches], positive; default: 6 x 4, and 6 x 5 in the plane and of a
        structure.

    Returns
    -------
    Animation
        A matplotlib animation; a notebook shows it. `write` saves it.

    Raises
    ------
    ValueError
        An argument out of range; a flexible slope.
    """
    if not (math.isfinite(speed) and speed > 0):
        raise ValueError(f"animate: speed must be positive and finite, got {speed}")
    if not 1 <= fps <= 60:
        raise ValueError(f"animate: fps must be from 1 to 60, got {fps}")
    begin, end = window("animate", response, time)  # type: ignore[arg-type]
    count = 1 + round((end - begin) * fps / speed)
    if count > _FRAMES:
        raise ValueError(
            f"animate: {count} frames are more than {_FRAMES}; give a part, time=(begin, end),"
            " a larger speed or a smaller fps"
        )
    times = np.linspace(begin, end, max(count, 2))
    draw, inches = _on_axis, (6.0, 4.0)
    if isinstance(response, RockingResponse):
        draw = _rocking
    elif isinstance(response, CartResponse):
        draw, inches = film_of_cart, (6.0, 5.0)
    elif isinstance(response, PlanarResponse):
        draw, inches = _in_plane, (6.0, 5.0)
    elif isinstance(response, StructureResponse):
        if isinstance(response.system, FlexibleSlope):
            raise ValueError("animate: draws buildings and equipment, got a flexible slope")
        draw, inches = _of_structure, (6.0, 5.0)
    if size is not None:
        inches = _inches(size)
    with style():
        figure, film = draw(response, times, title, inches)
        film.update(0)
        # Laid out twice, for what the first changes; not at each frame, which would take longer.
        figure.draw_without_rendering()
        figure.draw_without_rendering()
        figure.set_layout_engine("none")
    animation = Animation(figure, film.update, frames=len(times), interval=1000 / fps, blit=False)
    animation._film = film
    animation._draw_was_started = True  # or matplotlib warns where it is not shown
    return animation


def _inches(size: Any) -> tuple[float, float]:
    try:
        width, height = map(float, size)
    except (TypeError, ValueError):
        width = height = math.nan
    if not (0 < width < math.inf and 0 < height < math.inf):
        raise ValueError(f"animate: size must be a width and a height [inches], got {size!r}")
    return width, height


def _drift_free(values: NDArray[np.float64], t: NDArray[np.float64]) -> NDArray[np.float64]:
    """Without the straight line through it that has the least squares."""
    if len(t) < 3:
        return values - values.mean()
    flat: NDArray[np.float64] = values - np.polyval(np.polyfit(t, values, 1), t)
    return flat


def _ground(response: Any, times: NDArray[np.float64], component: Any) -> NDArray[np.float64]:
    motion = response.motion
    if not hasattr(motion, "displacement"):  # a HarmonicMotion
        motion = motion.sampled(min(motion.period / 40, motion.duration / 2))
    part = motion.component(component) if component else motion
    moved = _drift_free(np.asarray(part.displacement), np.asarray(part.time))
    return np.interp(times, part.time, moved)


def _states(response: Any, times: NDArray[np.float64]) -> NDArray[np.void]:
    """The states; at rest after the last event, which may come before the last sample."""
    states: NDArray[np.void] = response.at(np.minimum(times, response.events["time"][-1]))
    return states


def _rocking(
    response: Any, times: NDArray[np.float64], title: str | None, inches: tuple[float, float]
) -> tuple[Figure, Film]:
    return block_on_ground(response, times, _ground(response, times, None), title, inches)


def _on_axis(
    response: Any, times: NDArray[np.float64], title: str | None, inches: tuple[float, float]
) -> tuple[Figure, Film]:
    figure = new_figure(*inches)
    scene, way = figure.subplots(2, 1, height_ratios=(1, 1.1))
    moved = _states(response, times)
    x, gap, stuck = moved["displacement"], moved["gap"], moved["stuck"]
    ground = _ground(response, times, None)
    span = max(np.ptp(ground), np.ptp(x), np.abs(x).max(), 1e-3)
    size = 0.8 * span  # of the object [m]: it is drawn in the scale of its displacement
    on_floor, on_puck, on_body = Group(scene), Group(scene), Group(scene)
    scene.axhspan(-0.3 * size, 0, color=PALE, zorder=1)  # the floor, whose mark moves
    mark = Rectangle((-0.01 * size, -0.3 * size), 0.02 * size, 0.3 * size)
    on_floor.add(mark, color=GRAY, zorder=2)
    slider = response.slider
    bearings = _Bearings(response, times, x, size) if _has_bearings(slider) else None
    wheel = 0.12 * size if _law_name(slider) == "Caster" else 0.0
    width, height = (0.7 * size, 1.2 * size)
    foot, rise = 2 * wheel, np.zeros(len(times))
    if bearings:
        width, height = bearings.width, 0.45 * size
        foot, rise = bearings.height, bearings.rise
        for patch, group in bearings.patches(on_floor, on_puck, on_body):
            color = INK if group is on_puck else GRAY
            group.add(patch, facecolor=color, edgecolor=INK, linewidth=0.6, zorder=3)
    body = Rectangle((-width / 2, foot), width, height)
    on_body.add(
        body,
        edgecolor=INK,
        facecolor=BLUE,
        linewidth=0.8,
        zorder=4,
    )
    for side in (-1, 1) if wheel else ():
        roller = Circle((side * 0.3 * width, wheel), wheel)
        on_body.add(roller, facecolor=GRAY, edgecolor=INK, zorder=5)
    reach = width / 2 + np.abs(x).max()
    for place in near_stops(slider, response.peak):
        side = math.copysign(1, place)
        inside = place + side * width / 2
        left = inside if side > 0 else inside - 0.08 * size
        wall = Rectangle((left, 0), 0.08 * size, foot + 0.3 * size)
        on_floor.add(wall, color=GRAY, zorder=3, label="stop")
        reach = max(reach, abs(inside) + 0.08 * size)
    middle = float(ground.max() + ground.min()) / 2
    half = max(2.2 * span, 1.05 * (reach + np.ptp(ground) / 2))
    scene.set_xlim(middle - half, middle + half)
    scene.set_ylim(-0.3 * size, foot + height + rise.max() + 0.3 * size)
    scene.set_aspect("equal", adjustable="box")
    scene.axis("off")
    put_title(scene, response.motion, title, describe(slider))

    film = _with_history(way, response, times, x)
    film.groups = [on_floor, on_body]
    on_floor.move(ground, 0 * ground)
    on_body.move(ground + x, gap + rise)
    if bearings:
        film.groups.append(on_puck)
        on_puck.move(ground + bearings.puck, bearings.lift)
    film.body = body, [BLUE if still else VERMILION for still in stuck]
    return figure, film


def _with_history(
    way: Axes, response: Any, times: NDArray[np.float64], x: NDArray[np.float64]
) -> Film:
    """A film that draws the displacement, x at the frames, up to each frame."""
    curve = response._curve()
    t, values = curve["time"], curve["displacement"]
    length, unit = unit_for(np.abs(x).max())
    inside = (t > times[0]) & (t < times[-1])
    t = np.concatenate([t[inside], times])
    values = length * np.concatenate([values[inside], x])
    order = np.argsort(t, kind="stable")
    points = np.column_stack([t, values])[order]
    way.plot(*points.T, color=LATER, linewidth=1)
    line = way.plot([], [], color=BLUE, linewidth=1.4)[0]
    dot = way.plot([], [], "o", color=VERMILION, markersize=5, clip_on=False)[0]
    way.axhline(0, color=GRAY, linewidth=0.6, zorder=0)
    way.set_xlim(times[0], times[-1])
    way.set_xlabel("time [s]")
    way.set_ylabel(f"relative displacement\n[{unit}]")
    film = Film(times)
    film.follow(way, line, dot, points[:, 0], points)
    return film


def _of_structure(
    response: Any, times: NDArray[np.float64], title: str | None, inches: tuple[float, float]
) -> tuple[Figure, Film]:
    figure = new_figure(*inches)
    scene, way = figure.subplots(2, 1, height_ratios=(1.8, 1))
    system = response.system
    equipment = isinstance(system, EquipmentOnFloor)

    def at(values: Any) -> Any:
        return np.interp(times, response.time, values)

    x, ground = at(response.displacement), _ground(response, times, None)
    base = ground if equipment else ground + x
    floors = [at(u) for u in response.floors.displacement.T] if has_floors(response) else []
    span = max(np.ptp(part) for part in (x, ground, base, *floors))
    size = max(span, np.abs(x).max(), 1e-3)
    story = size * min(0.8, 3 / max(len(floors), 1))
    thick, half, post = 0.15 * story, 0.9 * size, 0.05 * size
    on_ground, on_base = Group(scene), Group(scene)
    scene.axhspan(-0.3 * size, 0, color=PALE, zorder=1)
    on_ground.add(Rectangle((-0.01 * size, -0.3 * size), 0.02 * size, 0.3 * size), color=GRAY)
    on_ground.move(ground, 0 * ground)
    on_base.move(base, 0 * base)
    moving = [on_ground, on_base]
    outlined: dict[str, Any] = {"edgecolor": INK, "linewidth": 0.6}
    foot = 0.0 if equipment else 0.2 * story
    if not equipment:
        body = Rectangle((-half, 0), 2 * half, foot)
        on_base.add(body, facecolor=BLUE, zorder=4, **outlined)
    for i, u in enumerate(floors):
        level = Group(scene)  # with the posts below it
        for side in (-1, 1):
            left = 0.85 * side * half - post / 2
            level.add(Rectangle((left, foot + i * story), post, story - thick), color=GRAY)
        slab = Rectangle((-half, foot + (i + 1) * story - thick), 2 * half, thick)
        level.add(slab, facecolor=PALE, zorder=3, **outlined)
        level.move(base + u, 0 * u)
        moving.append(level)
    under, width, place = on_ground, half, 0.0
    if equipment:
        u, place = floors[system.floor - 1], foot + system.floor * story
        under, width = moving[system.floor + 1], 0.25 * half
        on_body = Group(scene)
        body = Rectangle((-width, place), 2 * width, 0.6 * (story - thick))
        on_body.add(body, facecolor=BLUE, zorder=4, **outlined)
        on_body.move(base + u + x, 0 * x)
        moving.append(on_body)
    reach = half
    for gap in near_stops(system.slider, response.peak):
        inside = gap + math.copysign(width, gap)
        wall = 0.06 * size
        left = inside if gap > 0 else inside - wall
        under.add(Rectangle((left, place), wall, 0.3 * story), color=INK, zorder=3, label="stop")
        reach = max(reach, abs(inside) + wall)
    places = np.concatenate([group.places[:, 0] for group in moving])
    scene.set_xlim(places.min() - 1.1 * reach, places.max() + 1.1 * reach, auto=True)
    scene.set_ylim(-0.3 * size, foot + (len(floors) + 0.7) * story, auto=True)
    scene.set_aspect("equal", adjustable="datalim")  # as wide as the history
    scene.axis("off")
    put_title(scene, response.motion, title, describe_system(system))
    film = _with_history(way, response, times, x)
    film.groups = moving
    still = np.zeros(len(times), dtype=bool)
    for begin, end in sticks(response):
        still |= (times >= begin) & (times <= end)
    film.body = body, [BLUE if one else VERMILION for one in still]
    return figure, film


def _law_name(slider: Slider) -> str:
    return type(getattr(slider.law, "sliding", slider.law)).__name__


def _has_bearings(slider: Slider) -> bool:
    law = _law_name(slider)
    return law == "MultiPendulum" or (slider.natural_frequency > 0 and law != "Caster")


class _Bearings:
    """Two bearings, each a dish on the floor and a puck in it; an upper dish if surfaces are many.

    A dish is as wide as the displacements in it. It is drawn deeper than it is, or its curvature
    could not be seen; that of a spring that is no pendulum is flat.
    """

    def __init__(
        self, response: Response, times: NDArray[np.float64], x: NDArray[np.float64], size: float
    ) -> None:
        slider = response.slider
        self.two = _law_name(slider) == "MultiPendulum"
        self.puck = x
        widest = response.peak
        if self.two:
            surfaces = np.asarray(response.surfaces.displacement)
            lower = surfaces[: len(surfaces) // 2].sum(axis=0)
            self.puck = np.interp(times, response.time, lower)
            widest = max(np.abs(lower).max(), np.abs(response.displacement - lower).max())
        self.thick, self.size = 0.06 * size, size
        self.half = float(widest) + 0.17 * size
        self.depth = 0.14 * size if self.two or slider.pendulum else 0.0
        self.aside = self.half + 0.06 * size
        self.lift = self.depth * (self.puck / self.half) ** 2
        self.rise = self.lift + (self.depth * ((x - self.puck) / self.half) ** 2 if self.two else 0)
        self.height = self.thick + 0.16 * size + (self.thick if self.two else 0)
        self.width = 2 * self.aside + (2 * self.half if self.two else 0.4 * size)

    def _dish(self, center: float, base: float, up: int) -> Polygon:
        u = np.linspace(-1, 1, 41)
        curved = base + up * (self.thick + self.depth * u**2)
        corners = [(center + self.half, base), (center - self.half, base)]
        return Polygon([*zip(center + self.half * u, curved), *corners])

    def patches(
        self, on_floor: Group, on_puck: Group, on_body: Group
    ) -> Iterator[tuple[Any, Group]]:
        for side in (-1, 1):
            center = side * self.aside
            yield self._dish(center, 0, 1), on_floor
            if self.two:
                yield self._dish(center, self.height, -1), on_body
            u = np.linspace(-1, 1, 21)
            across, bend = center + 0.16 * self.size * u, 0.06 * self.size * u**2
            top = self.thick + 0.16 * self.size - (bend if self.two else 0 * u)
            yield Polygon([*zip(across, self.thick + bend), *zip(across[::-1], top[::-1])]), on_puck


def _in_plane(
    response: Any, times: NDArray[np.float64], title: str | None, inches: tuple[float, float]
) -> tuple[Figure, Film]:
    figure = new_figure(*inches)
    plan = figure.subplots()
    length, unit = unit_for(response.peak)
    # As on a map: the axis upward, the transverse component to the right.
    t, place = path_of(response)
    inside = (t > times[0]) & (t < times[-1])
    t = np.concatenate([t[inside], times])
    place = np.concatenate([place[inside], _states(response, times)["displacement"]])
    order = np.argsort(t, kind="stable")
    points = length * place[order, ::-1]
    plan.plot(*points.T, color=LATER, linewidth=1, label="path")
    line = plan.plot([], [], color=BLUE, linewidth=1.4)[0]
    dot = plan.plot([], [], "o", color=VERMILION, markersize=8, zorder=4, clip_on=False)[0]
    draw_stop(plan, response, length)
    if response.peak > 0:
        make_square(plan)
    plan.set_aspect("equal", adjustable="box", anchor="W")  # north is at the right
    downhill = ", downhill" if response.slider.slope_degrees > 0 else ""
    name_directions(plan, response.motion, unit, downhill)
    put_title(plan, response.motion, title, describe(response.slider.along_axis))
    film = Film(times)
    film.clock = plan.text(0.02, 0.02, "", transform=plan.transAxes, color=GRAY)
    film.follow(plan, line, dot, t[order], points)
    return figure, film
