"""Pages that play an animation: one drawing, and where its parts are in each frame."""

from __future__ import annotations

import io
import json
import re
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from matplotlib.transforms import Affine2D
from numpy.typing import NDArray

from .styles import style

_PAGE = """<!DOCTYPE html>
<html lang="en">
<meta charset="utf-8">
<title>stickslip</title>
<style>
body { margin: 0; font: 14px sans-serif; background: #fff; color: #222; }
svg { display: block; width: 100%; max-width: WIDTHpx; height: auto; }
div { display: flex; gap: 8px; max-width: WIDTHpx; align-items: center; }
input { flex: 1; }
</style>
SVG
<div><button>pause</button><input type="range" min="0" value="0" step="1"><output></output></div>
<script>
const film = FILM;
const button = document.querySelector("button");
const slider = document.querySelector("input");
const clock = document.querySelector("output");
const trail = document.querySelector("#trail path");
const last = film.time.length - 1;
slider.max = last;
let begin = null;
function show(i) {
  for (const [name, x, y, turn, at] of film.moves)
    document.getElementById(name).setAttribute(
      "transform", `translate(${x[i]} ${y[i]})` + (turn ? ` rotate(${turn[i]} ${at})` : ""));
  for (const [name, colors] of film.fills)
    document.querySelector(`#${name} path`).style.fill = colors[i];
  trail.setAttribute("d", "M" + film.trail.slice(0, film.shown[i]).join("L"));
  clock.textContent = film.time[i].toFixed(2) + " s";
  slider.value = i;
}
function play(now) {
  if (begin === null) return;
  const i = Math.floor(((now - begin) / 1000) * film.fps);
  if (i > last) begin = now;
  show(Math.min(Math.max(i, 0), last));
  requestAnimationFrame(play);
}
function start(i) {
  begin = performance.now() - (1000 * i) / film.fps;
  button.textContent = "pause";
  requestAnimationFrame(play);
}
function pause() {
  begin = null;
  button.textContent = "play";
}
button.onclick = () => (begin === null ? start(slider.value % last) : pause());
slider.oninput = () => { pause(); show(+slider.value); };
start(0);
</script>
</html>
"""


class Group:
    """Patches that move together.

    Parameters
    ----------
    axes : matplotlib Axes
    """

    def __init__(self, axes: Axes) -> None:
        self.axes = axes
        self.frame = Affine2D()
        self.parts: list[Any] = []

    def add(self, patch: Patch, **options: Any) -> None:
        """Draw a patch, in the coordinates of the group, with properties of matplotlib."""
        patch.set(transform=self.frame + self.axes.transData, clip_on=False, **options)
        self.parts.append(self.axes.add_patch(patch))

    def move(
        self,
        x: NDArray[np.float64],
        y: NDArray[np.float64],
        turn: NDArray[np.float64] | None = None,
    ) -> None:
        """Set the place of the group in each frame, and its angle [rad], shape (F,) each."""
        self.places = np.column_stack([x, y])
        self.turn = turn

    def show(self, i: int) -> None:
        """Put the group where it is in frame i."""
        self.frame.clear().rotate(0 if self.turn is None else self.turn[i])
        self.frame.translate(*self.places[i])


class Film:
    """What moves in an animation: groups of parts, one color, and a trail with its head.

    Both the frames of matplotlib and the page are drawn from it.

    Parameters
    ----------
    times : ndarray, shape (F,)
        Of the frames [s].
    """

    def __init__(self, times: NDArray[np.float64]) -> None:
        self.times = times
        self.groups: list[Group] = []
        self.body: tuple[Any, list[str]] | None = None
        self.clock: Any = None

    def follow(
        self, axes: Axes, line: Any, dot: Any, t: NDArray[np.float64], points: NDArray[np.float64]
    ) -> None:
        """Draw the points, shape (N, 2), at times t, which contain the frames, up to each frame."""
        self.axes, self.line, self.dot, self.points = axes, line, dot, points
        self.shown = np.searchsorted(t, self.times, "right")

    def update(self, i: int) -> list[Any]:
        """Show frame i."""
        for group in self.groups:
            group.show(i)
        if self.body:
            self.body[0].set_facecolor(self.body[1][i])
        self.line.set_data(*self.points[: self.shown[i]].T)
        self.dot.set_data(*self.points[self.shown[i] - 1 : self.shown[i]].T)
        if self.clock:
            self.clock.set_text(f"{self.times[i]:.1f} s")
        return [self.line, self.dot]

    def page(self, figure: Figure, fps: float) -> str:
        """A page with the drawing as SVG, some 0.2 MB in all."""
        height = figure.bbox.height

        def on_page(axes: Axes, places: NDArray[np.float64]) -> NDArray[np.float64]:
            x, y = axes.transData.transform(places).T
            at: NDArray[np.float64] = np.column_stack([x, height - y]) * 72 / figure.dpi
            return at.round(2)

        moves, fills = [], []
        drawn = len(self.times) - 1  # with the whole trail
        heads = self.points[self.shown - 1]
        moving = [(group.axes, group.parts, group.places, group.turn) for group in self.groups]
        head = (self.axes, [self.dot], heads, None)
        for n, (axes, parts, places, turn) in enumerate([*moving, head]):
            at = on_page(axes, places)
            x, y = (at - at[drawn]).round(2).T.tolist()
            turned: list[Any] = []
            if turn is not None:  # clockwise on the page, about the place in what is drawn
                angles = np.degrees(turn[drawn] - turn).round(2).tolist()
                turned = [angles, f"{at[drawn, 0]} {at[drawn, 1]}"]
            for k, part in enumerate(parts):
                part.set_gid(f"part-{n}-{k}")
                moves.append((part.get_gid(), x, y, *turned))
        if self.body:
            fills.append((self.body[0].get_gid(), self.body[1]))
        self.line.set_gid("trail")
        self.update(drawn)
        if self.clock:
            self.clock.set_text("")  # the page has its own
        buffer = io.StringIO()
        with style():
            figure.savefig(buffer, format="svg", metadata={"Date": None})
        drawing = buffer.getvalue()
        trail = on_page(self.axes, self.points).round(1)
        keep = np.append(True, (np.diff(trail, axis=0) != 0).any(axis=1))  # each place once
        film = {
            "fps": fps,
            "time": self.times.round(4).tolist(),
            "moves": moves,
            "fills": fills,
            "trail": trail[keep].tolist(),
            "shown": np.cumsum(keep)[self.shown - 1].tolist(),
        }
        text = {
            "WIDTH": f"{figure.bbox.width * 96 / figure.dpi:.0f}",
            "SVG": drawing[drawing.index("<svg") :],
            "FILM": json.dumps(film, separators=(",", ":")),
        }
        return re.sub("WIDTH|SVG|FILM", lambda name: text[name[0]], _PAGE)
