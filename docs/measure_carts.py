"""Measures a cart with its casters free, locked and fixed, for docs/carts.md.

    python docs/measure_carts.py

rewrites the table of that page, in a minute. The sample records come with pyslammer (the extra
`records`).
"""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import stickslip as ss
from measured_page import DOCS, rewrite, table

PAGE = DOCS / "carts.md"
RECORD = "Kobe"
PLACES = [(0.3, 0.2), (0.3, -0.2), (-0.3, 0.2), (-0.3, -0.2)]
OUTLINE = [(0.4, 0.3), (-0.4, 0.3), (-0.4, -0.3), (0.4, -0.3)]
MEMBERS, SEED = 100, 1
SCALES = {"moderate": 0.3, "strong": 1.0}
HEADING = (
    "| cart, {scale:g} times Kobe | center, median [m] | corner, median [m] |"
    " corner, 95 % [m] | yaw, 95 % [rad] |"
)


def caster(at, heading=0.0, lock=None):
    """A caster of 60 mm with a trail of 30 mm; locked it has the same friction everywhere."""
    rolling = {} if lock else {"rolling_mu": 0.01}
    return ss.SwivelCaster(
        at=at, heading=heading, mu=0.5, trail=0.03, wheel_width=0.02, lock=lock, **rolling
    )


def cart(supports) -> ss.Cart:
    return ss.Cart(supports, radius_of_gyration=0.25, outline=OUTLINE)


ACROSS = cart([caster(at, math.pi / 2 * (1 if at[1] > 0 else -1)) for at in PLACES])
CARTS = {
    "four casters, free": cart([caster(at) for at in PLACES]),
    "two fixed wheels behind": cart(
        [caster(at) for at in PLACES[:2]]
        + [ss.FixedWheel(at=at, mu=0.5, rolling_mu=0.01) for at in PLACES[2:]]
    ),
    "one caster locked": cart([caster(PLACES[0], lock="both")] + [caster(at) for at in PLACES[1:]]),
    "two casters locked": cart(
        [caster(at, lock="both") for at in PLACES[:2]] + [caster(at) for at in PLACES[2:]]
    ),
}


@cache
def quake(scale: float) -> ss.GroundMotion:
    """The record along the axis, with nothing across."""
    record = ss.sample_record(RECORD).scaled(scale)
    return ss.GroundMotion(
        record.acceleration, dt=record.dt, transverse=0 * record.acceleration, name=record.name
    )


@cache
def ensemble(name: str, scale: float) -> ss.CartEnsemble:
    """The cart at random headings of its free casters, settled."""
    drawn = CARTS[name].with_random_headings()
    return ss.run_ensemble(drawn, quake(scale), members=MEMBERS, seed=SEED, settle=True)


def rows(scale: float) -> list[list[str]]:
    one = ss.integrate(ACROSS, quake(scale), settle=True)
    found = [["wheels across the motion", *[f"{one.peak:.3f}"] * 3, "0.00"]]
    for name in CARTS:
        e = ensemble(name, scale)
        middle, high = np.quantile(e.peak_outline, [0.5, 0.95])
        yaw = np.quantile(e.peak_yaw, 0.95)
        center = np.median(e.peak)
        found.append([name, *(f"{x:.3f}" for x in (center, middle, high)), f"{yaw:.2f}"])
    return found


def tables() -> dict[str, str]:
    return {name: table(HEADING.format(scale=s), rows(s)) for name, s in SCALES.items()}


if __name__ == "__main__":
    rewrite(PAGE, tables().values())
