"""Measures a cart with its casters free, locked and fixed, for docs/carts.md.

    python docs/measure_carts.py

rewrites the tables of that page, in a minute and a half. The sample records come with pyslammer
(the extra `records`).
"""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import stickslip as ss
from measured_page import DOCS, rewrite, samples, table

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
DRAWS = 10  # of the headings, for each record and direction
OF_RECORDS = (
    "| cart, 18 records | along it: median [m] | 95 % [m] | across it: median [m] | 95 % [m] |"
    " yaw, 95 % [rad] |"
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


def of_records(name: str) -> list[str]:
    """The cart at random headings under each sample record, along it and across it."""
    draws = CARTS[name].with_random_headings()
    corners: dict[bool, list[float]] = {False: [], True: []}
    yaws: list[float] = []
    for record in samples():
        n, nothing = record.acceleration, 0 * record.acceleration
        for across, found in corners.items():
            way = (nothing, n) if across else (n, nothing)
            motion = ss.GroundMotion(way[0], dt=record.dt, transverse=way[1], name=record.name)
            e = ss.run_ensemble(draws, motion, members=DRAWS, seed=SEED, settle=True)
            found.extend(e.peak_outline)
            yaws.extend(e.peak_yaw)
    shown = [f"{x:.3f}" for found in corners.values() for x in np.quantile(found, [0.5, 0.95])]
    return [name, *shown, f"{np.quantile(yaws, 0.95):.2f}"]


def tables() -> dict[str, str]:
    found = {name: table(HEADING.format(scale=s), rows(s)) for name, s in SCALES.items()}
    found["records"] = table(OF_RECORDS, [of_records(name) for name in CARTS])
    return found


if __name__ == "__main__":
    rewrite(PAGE, tables().values())
