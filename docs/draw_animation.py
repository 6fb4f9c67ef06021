"""Draws the animation of the README: python docs/draw_animation.py

A cabinet, a cart and an isolated floor under Kobe 1995, each as `plotting.animate` shows it, side
by side in docs/images/kobe.gif. Half as large, without a difference that can be seen:
gifsicle -O3 --lossy=80 --colors 64 -b docs/images/kobe.gif
"""

from __future__ import annotations

import tempfile
from pathlib import Path

import stickslip as ss
from PIL import Image
from stickslip import plotting

ROOT = Path(__file__).parents[1]
PICTURE = ROOT / "docs" / "images" / "kobe.gif"
TIME, FPS = (2.0, 17.0), 8  # [s], frames in a second
WIDTH = 380  # of each [pixels]
SIZE = (3.2, 2.8)  # of each [inches], so that its type can be read

SLIDERS = {
    "Cabinet": ss.Slider(ss.Coulomb(mu=0.2)),
    "Cart on casters": ss.Slider(ss.Caster(mu=0.05, reach=0.1)),
    "Isolated floor": ss.FrictionPendulum(radius=2.2, mu=0.05),
}


def frames() -> list[Image.Image]:
    """The frames of all three, side by side, in 64 colors."""
    quake = ss.sample_record("Kobe")
    columns = []
    with tempfile.TemporaryDirectory() as folder:
        for name, slider in SLIDERS.items():
            response = ss.integrate(slider, quake)
            moving = plotting.animate(response, time=TIME, fps=FPS, title=name, size=SIZE)
            column = []
            file = Path(folder) / "one.gif"
            moving.save(file, writer="pillow", fps=FPS, dpi=WIDTH / SIZE[0])
            with Image.open(file) as picture:
                for i in range(picture.n_frames):
                    picture.seek(i)
                    column.append(picture.convert("RGB"))
            columns.append(column)
    joined = []
    for row in zip(*columns, strict=True):
        frame = Image.new("RGB", (WIDTH * len(row), row[0].height), "white")
        for k, one in enumerate(row):
            frame.paste(one, (WIDTH * k, 0))
        joined.append(frame.quantize(48, dither=Image.Dither.NONE))
    return joined


def draw(picture: Path) -> Path:
    first, *rest = frames()
    first.save(
        picture, save_all=True, append_images=rest, duration=1000 // FPS, loop=0, optimize=True
    )
    return picture


if __name__ == "__main__":
    print(draw(PICTURE))
