"""Carts on casters and feet, from a single history to a thousand random headings.

    python bench/carts.py [--check] [--rounds N]

Answers are checked before they are timed: against the values of tests/data/carts.json, and by the
balance of energy. `--check` runs the checks alone.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

import numpy as np
import stickslip as ss
from measure import bar, machine, take_turns

DATA = Path(__file__).parents[1] / "tests" / "data" / "carts.json"
OUTLINE = [(0.4, 0.3), (-0.4, 0.3), (-0.4, -0.3), (0.4, -0.3)]
PLACES = [(0.3, 0.2), (0.3, -0.2), (-0.3, 0.2), (-0.3, -0.2)]
HEADINGS = [0.3, 2.0, -2.5, -0.7]
M = np.arange(401)


def shaking(factor: float, dt: float = 0.1, parts: int = 1) -> ss.GroundMotion:
    """The ground of the values, each segment in equal parts."""
    x = factor * (2 * np.sin(0.7 * M) + 1.3 * np.cos(1.9 * M + 0.4))
    y = factor * (1.5 * np.sin(0.9 * M + 1.1) + 0.8 * np.cos(2.3 * M))
    fine = np.arange(parts * (len(M) - 1) + 1) / parts
    return ss.GroundMotion(np.interp(fine, M, x), dt=dt / parts, transverse=np.interp(fine, M, y))


def casters(locked: int = 0) -> ss.Cart:
    supports = [
        ss.Foot(at=at, mu=0.3)
        if i < locked
        else ss.SwivelCaster(at=at, heading=heading, slip_level=0.97, reach=0.041, rolling_mu=0.01)
        for i, (at, heading) in enumerate(zip(PLACES, HEADINGS))
    ]
    return ss.Cart(supports, radius_of_gyration=0.25, outline=OUTLINE)


def check() -> None:
    for row in json.loads(DATA.read_text(encoding="utf-8"))["carts"]["rows"]:
        if row["id"] != "strong":
            continue
        p, value = row["params"], row["value"]
        supports = [
            ss.SwivelCaster(
                at=(x, y), heading=heading, slip_level=level * ss.STANDARD_GRAVITY, reach=reach,
                rolling_mu=rho, share=share,
            )
            for _, x, y, share, level, rho, heading, reach in p["supports"]
        ]  # fmt: skip
        cart = ss.Cart(supports, radius_of_gyration=p["radius_of_gyration"], outline=OUTLINE)
        ground = shaking(p["factor"])
        n = p["samples"]
        short = ss.GroundMotion(
            ground.acceleration[:n], dt=ground.dt, transverse=ground.transverse[:n]
        )
        r = ss.integrate(cart, short)
        if not abs(r.peak_outline - value["peak_corner"]) <= 1e-11:
            sys.exit(f"wrong answer: {r.peak_outline} for {value['peak_corner']}")
    for locked in (0, 1, 4):
        r = ss.integrate(casters(locked), shaking(0.7))
        if not abs(r.energy.imbalance) <= 1e-9:
            sys.exit(f"wrong answer: energy of {locked} locked: {r.energy.imbalance}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--check", action="store_true")
    args = parser.parse_args()
    check()
    if args.check:
        print("carts: right answers")
        return
    print(machine())
    long, fine = shaking(0.7), shaking(0.7, parts=10)
    drawn = casters().with_random_headings()
    works = {
        "four casters, 400 segments": (lambda: ss.integrate(casters(), long), 1),
        "the same in 4,000 segments": (lambda: ss.integrate(casters(), fine), 1),
        "one caster locked": (lambda: ss.integrate(casters(1), long), 1),
        "four feet": (lambda: ss.integrate(casters(4), long), 1),
        "random headings, 4,000 segments": (
            lambda: ss.run_ensemble(drawn, fine, members=20, seed=1, threads=1),
            20,
        ),
    }
    timings = take_turns(works, args.rounds)
    for name, t in timings.items():
        print(f"  {name:40} {t.median * 1e-6:8.2f} ms {100 * t.spread:4.0f} %")
    print("bars")
    one = timings["four casters, 400 segments"].median * 1e-6
    many = timings["random headings, 4,000 segments"].median * 1e-6
    print(bar("a cart of four casters, 40 s with 1,000 events, ms", one, 25))
    print(bar("1,000 random headings over 4,000 samples, s", many, 30))


if __name__ == "__main__":
    main()
