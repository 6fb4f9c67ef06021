"""Pictures that move: the object on its shaking floor, with its history below."""

from __future__ import annotations

import math
import os
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.animation import FFMpegWriter, FuncAnimation, PillowWriter
from matplotlib.axes import Axes
from matplotlib.figure import FigureBase
from matplotlib.patches import Circle, Rectangle
from numpy.typing import NDArray

from .._core import PlanarResponse, Response, Slider
from .._files import replacing
from .figures import new_figure
from .styles import BLUE, GRAY, INK, PALE, VERMILION, put_title, style
from .trajectory import window
from .words import describe, unit_for

_FRAMES = 2000  # at most
_SUFFIXES = (".gif", ".mp4", ".html")


class Animation(FuncAnimation):
    """A matplotlib animation that a notebook shows, and that `write` saves."""

    def _repr_html_(self) -> str:
        return str(self.to_jshtml())

    def write(self, path: str | os.PathLike[str]) -> Path:
        """Save as an animated GIF, an MP4 or a page.

        Parameters
        ----------
        path : path-like
            Its suffix is .gif (needs Pillow), .mp4 (needs ffmpeg) or .html. An existing file is
            replaced once the new one is whole.

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
            stream.write(self.to_jshtml().encode() if kind == "html" else self._film(kind))
        return file

    def save(self, filename: str | os.PathLike[str], *args: Any, **options: Any) -> None:
        """As `write`, whole or not at all; with options as of matplotlib's own `save`."""
        if args or options:
            super().save(os.fspath(filename), *args, **options)
        else:
            self.write(filename)

    def _film(self, kind: str) -> bytes:
        """The content of a GIF or an MP4; matplotlib writes either into a file."""
        writer = PillowWriter if kind == "gif" else FFMpegWriter
        with tempfile.TemporaryDirectory() as folder:
            film = Path(folder) / f"film.{kind}"
            super().save(film, writer=writer(fps=1000 / self._interval))
            return film.read_bytes()


def check_moving_suffix(file: Path) -> str:
    """The format 'gif', 'mp4' or 'html' from a file's suffix; ValueError for other suffixes."""
    if file.suffix.lower() not in _SUFFIXES:
        raise ValueError(f"animate: the file must end in {', '.join(_SUFFIXES)}, got '{file}'")
    return file.suffix.lower()[1:]


def animate(
    response: Response | PlanarResponse,
    *,
    time: tuple[float, float] | None = None,
    speed: float = 1.0,
    fps: float = 15.0,
    title: str | None = None,
) -> Animation:
    """Show the object sliding on its moving floor, with the history of its displacement below.

    A block, a cart where the law is that of a caster, or a floor on bearings where a spring or a
    pendulum draws it back. It moves by the exact displacement at each frame; the floor moves by the
    displacement of the ground, without its mean and linear trend. Both have the same scale. In the
    plane: the path as on a map, with the object on it.

    Parameters
    ----------
    response : Response or PlanarResponse
    time : tuple of float, optional
        Begin and end of the part to show [s]; default: all of the response.
    speed : float, optional
        Seconds of the motion in a second of the animation, positive; 1 is real time.
    fps : float, optional
        Frames in a second, from 1 to 60. There are at most 2,000 frames.
    title : str, optional
        Default: the name of the ground motion.

    Returns
    -------
    Animation
        A matplotlib animation; a notebook shows it. `write` saves it.

    Raises
    ------
    ValueError
        An argument out of range.
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
    planar = isinstance(response, PlanarResponse)
    with style():
        draw = _in_plane if planar else _on_axis
        figure, update = draw(response, times, title)
        # Laid out once: every frame would take four times as long.
        figure.draw_without_rendering()
        figure.set_layout_engine("none")
    animation = Animation(figure, update, frames=len(times), interval=1000 / fps, blit=False)
    animation._draw_was_started = True  # or matplotlib warns where it is not shown
    return animation


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


def _on_axis(response: Any, times: NDArray[np.float64], title: str | None) -> tuple[Any, Any]:
    figure = new_figure(6, 4)
    scene, way = figure.subplots(2, 1, height_ratios=(1, 1.1))
    moved = _states(response, times)
    x, gap, stuck = moved["displacement"], moved["gap"], moved["stuck"]
    ground = _ground(response, times, None)
    span = max(np.ptp(ground), np.ptp(x), np.abs(x).max(), 1e-3)
    size = 0.8 * span  # of the object [m]: it is drawn in the scale of its displacement
    middle = float(ground.mean())
    scene.set_xlim(middle - 2.2 * span, middle + 2.2 * span)
    scene.set_ylim(-0.35 * size, 1.9 * size)
    scene.set_aspect("equal", adjustable="box")
    scene.axis("off")
    put_title(scene, response.motion, title, describe(response.slider))
    floor = Rectangle((0, -0.3 * size), 4 * span, 0.3 * size, color=PALE, zorder=1)
    scene.add_patch(floor)
    mark = scene.plot([0, 0], [-0.3 * size, 0], color=GRAY, linewidth=1.2, zorder=2)[0]
    parts = _object(scene, response.slider, size)
    bounds = _walls(scene, response.slider, size)

    length, unit = unit_for(np.abs(x).max())
    way.plot(response.time, length * response.displacement, color=PALE, linewidth=1)
    line = way.plot([], [], color=BLUE, linewidth=1.4)[0]
    dot = way.plot([], [], "o", color=VERMILION, markersize=5)[0]
    way.axhline(0, color=GRAY, linewidth=0.6, zorder=0)
    way.set_xlim(times[0], times[-1])
    way.set_xlabel("time [s]")
    way.set_ylabel(f"relative displacement\n[{unit}]")

    def update(i: int) -> list[Any]:
        at = ground[i] + x[i]
        floor.set_x(ground[i] - 2 * span)
        mark.set_xdata([ground[i], ground[i]])
        for patch, aside, height in parts:
            _move(patch, at + aside, height + gap[i])
        for offset, wall in bounds:
            wall.set_x(ground[i] + offset)
        parts[0][0].set_facecolor(BLUE if stuck[i] else VERMILION)
        line.set_data(times[: i + 1], length * x[: i + 1])
        dot.set_data([times[i]], [length * x[i]])
        return [floor, mark, line, dot]

    update(0)
    return figure, update


def _move(patch: Any, x: float, y: float) -> None:
    if isinstance(patch, Circle):
        patch.set_center((x, y))
    else:
        patch.set_xy((x - patch.get_width() / 2, y))


def _object(scene: Axes, slider: Slider, size: float) -> list[tuple[Any, float, float]]:
    """What slides, the body first: patches, places beside x and heights over the floor [m]."""
    law = type(getattr(slider.law, "sliding", slider.law)).__name__
    wheels = law == "Caster"
    bearings = slider.natural_frequency > 0 or law == "MultiPendulum"
    radius = 0.12 * size
    foot = 2 * radius if wheels else 0.15 * size if bearings else 0.0
    width, height = (1.4 * size, 0.5 * size) if bearings else (0.7 * size, 1.2 * size)
    body = Rectangle((0, 0), width, height, edgecolor=INK, facecolor=BLUE, linewidth=0.8, zorder=4)
    scene.add_patch(body)
    parts: list[tuple[Any, float, float]] = [(body, 0.0, foot)]
    if wheels or bearings:
        below, beside, layer = (radius, 0.3, 5) if wheels else (0.08 * size, 0.35, 3)
        for aside in (-beside * width, beside * width):
            roller = Circle((0, 0), below, facecolor=GRAY, edgecolor=INK, zorder=layer)
            scene.add_patch(roller)
            parts.append((roller, aside, below))
    return parts


def _walls(scene: Axes, slider: Slider, size: float) -> list[tuple[float, Rectangle]]:
    """The stops, by their place relative to the floor [m]."""
    found = []
    half = 0.7 * size if slider.natural_frequency > 0 else 0.35 * size
    if slider.stops is None:
        return found
    for gap, side in ((slider.stops.gap, 1), (slider.stops.backward, -1)):
        if math.isfinite(gap):
            offset = side * (gap + half) - (0 if side > 0 else 0.08 * size)
            wall = Rectangle((0, 0), 0.08 * size, 0.5 * size, color=GRAY, zorder=3)
            scene.add_patch(wall)
            found.append((offset, wall))
    return found


def _in_plane(response: Any, times: NDArray[np.float64], title: str | None) -> tuple[Any, Any]:
    figure: FigureBase = new_figure(5, 5)
    plan = figure.subplots()
    moved = _states(response, times)["displacement"]
    length, unit = unit_for(np.abs(response.displacement).max())
    # As on a map: the axis upward, the transverse component to the right.
    y, x = length * moved.T
    plan.plot(
        length * response.displacement[:, 1], length * response.displacement[:, 0], color=PALE
    )
    line = plan.plot([], [], color=BLUE, linewidth=1.4)[0]
    dot = plan.plot([], [], "s", color=VERMILION, markersize=9)[0]
    plan.set_aspect("equal", adjustable="datalim")
    plan.set_xlabel(f"transverse [{unit}]")
    plan.set_ylabel(f"along the axis [{unit}]")
    put_title(plan, response.motion, title, describe(response.slider))
    clock = plan.text(0.02, 0.02, "", transform=plan.transAxes, color=GRAY)

    def update(i: int) -> list[Any]:
        line.set_data(x[: i + 1], y[: i + 1])
        dot.set_data([x[i]], [y[i]])
        clock.set_text(f"{times[i]:.1f} s")
        return [line, dot, clock]

    update(0)
    return figure, update
