"""Draws the animation of the README: python docs/draw_animation.py

A cabinet, a cart and an isolated floor under Kobe 1995, each as `Response.animate` shows it, side
by side in docs/images/kobe.gif.
"""

from __future__ import annotations

import tempfile
from pathlib import Path

import stickslip as ss
from PIL import Image

ROOT = Path(__file__).parents[1]
PICTURE = ROOT / "docs" / "images" / "kobe.gif"
TIME, FPS = (2.0, 17.0), 8  # [s], frames in a second
WIDTH = 380  # of each [pixels]

SLIDERS = {
    "Cabinet, mu 0.2": ss.Slider(ss.Coulomb(mu=0.2)),
    "Cart on casters, mu 0.05": ss.Slider(ss.Caster(mu=0.05, reach=0.1)),
    "Isolated floor, R 2.2 m, mu 0.05": ss.FrictionPendulum(radius=2.2, mu=0.05),
}


def frames() -> list[Image.Image]:
    """The frames of all three, side by side, in 64 colors."""
    quake = ss.sample_record("Kobe")
    columns = []
    with tempfile.TemporaryDirectory() as folder:
        for name, slider in SLIDERS.items():
            response = ss.integrate(slider, quake)
            moving = response.animate(time=TIME, fps=FPS, title=name)
            column = []
            with Image.open(moving.write(Path(folder) / "one.gif")) as picture:
                for i in range(picture.n_frames):
                    picture.seek(i)
                    frame = picture.convert("RGB")
                    column.append(frame.resize((WIDTH, WIDTH * frame.height // frame.width)))
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
