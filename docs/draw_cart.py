"""Draws the film of docs/carts.md: python docs/draw_cart.py

A cart on four casters under Kobe 1995, from above, as `response.animate` shows
it, in docs/images/cart.gif.
"""

from __future__ import annotations

import tempfile
from pathlib import Path

import stickslip as ss
from measured_page import DOCS
from PIL import Image

PICTURE = DOCS / "images" / "cart.gif"
TIME, FPS = (2.0, 11.0), 5  # [s], frames in a second
WIDTH, SIZE = 400, (4.4, 3.7)  # [pixels], [inches]


def response() -> ss.CartResponse:
    record = ss.sample_record("Kobe")
    quake = ss.GroundMotion(
        record.acceleration, dt=record.dt, transverse=0 * record.acceleration, name=record.name
    )
    caster = {"mu": 0.5, "trail": 0.05, "wheel_width": 0.02, "rolling_mu": 0.01}
    cart = ss.Cart(
        [
            ss.SwivelCaster(at=(0.3, 0.2), heading=0.9, **caster),
            ss.SwivelCaster(at=(0.3, -0.2), heading=-0.6, **caster),
            ss.SwivelCaster(at=(-0.3, 0.2), heading=2.2, **caster),
            ss.SwivelCaster(at=(-0.3, -0.2), heading=2.9, **caster),
        ],
        radius_of_gyration=0.25,
        outline=[(0.4, 0.3), (-0.4, 0.3), (-0.4, -0.3), (0.4, -0.3)],
    )
    return ss.integrate(cart, quake)


def draw(picture: Path) -> Path:
    """In 16 colors: a film of few colors stays small."""
    moving = response().animate(time=TIME, fps=FPS, size=SIZE, title="Cart from above, Kobe 1995")
    frames = []
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "cart.gif"
        moving.save(file, writer="pillow", fps=FPS, dpi=WIDTH / SIZE[0])
        with Image.open(file) as film:
            for i in range(film.n_frames):
                film.seek(i)
                frames.append(film.convert("RGB").quantize(16, dither=Image.Dither.NONE))
    first, *rest = frames
    first.save(
        picture, save_all=True, append_images=rest, duration=1000 // FPS, loop=0, optimize=True
    )
    return picture


if __name__ == "__main__":
    print(draw(PICTURE))
