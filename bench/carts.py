"""Carts on casters and feet, from a single history to a thousand random headings.

    pip install mujoco
    python bench/carts.py [--check] [--rounds N]

Answers are checked before they are timed: against the values of tests/data/carts.json, and by the
balance of energy. `--check` runs the checks alone.

With MuJoCo installed, the same four casters are also built from bodies, hinges and contacts, by the
adapter of the referee: errors for several settings, and times in turns. There is no rolling
resistance in either program.
"""

from __future__ import annotations

import argparse
import json
import sys
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from pathlib import Path

import numpy as np
import stickslip as ss
from measure import UNRELIABLE, bar, machine, peer, take_turns, versions
from stickslip.referee.adapters import mujoco_engine
from stickslip.referee.time_steps import Cart

DATA = Path(__file__).parents[1] / "tests" / "data" / "carts.json"
OUTLINE = [(0.4, 0.3), (-0.4, 0.3), (-0.4, -0.3), (0.4, -0.3)]
PLACES = [(0.3, 0.2), (0.3, -0.2), (-0.3, 0.2), (-0.3, -0.2)]
HEADINGS = [0.3, 2.0, -2.5, -0.7]
M = np.arange(401)
RADIUS_OF_GYRATION, SLIP_LEVEL, REACH = 0.25, 0.97, 0.041
G = ss.STANDARD_GRAVITY

MU = 0.5  # between wheel and floor in MuJoCo
COMPARED = 101  # samples, 10 s: later the two motions part, as any two with an error do


@dataclass(frozen=True)
class Setting:
    """Of MuJoCo."""

    step: float  # [s]
    impratio: float
    # Of the center of mass above the floor [m], for a rigid body on four wheels; None: the load of
    # each wheel is its share.
    height: float | None = None

    def __str__(self) -> str:
        text = f"MuJoCo, {1000 * self.step:g} ms, impratio {self.impratio:g}"
        return text if self.height is None else f"{text}, rigid body, {self.height:g} m"


SETTINGS = (Setting(1e-3, 10), Setting(1e-3, 1e4), Setting(2e-4, 1e5), Setting(4e-5, 1e5))
RIGID_BODIES = (Setting(2e-4, 1e5, height=0.0), Setting(2e-4, 1e5, height=0.3))
CLOSE = 0.005  # the largest error of SETTINGS[-1], over the largest displacement


def shaking(factor: float, dt: float = 0.1, parts: int = 1) -> ss.GroundMotion:
    """The ground of the values, each segment in equal parts."""
    x = factor * (2 * np.sin(0.7 * M) + 1.3 * np.cos(1.9 * M + 0.4))
    y = factor * (1.5 * np.sin(0.9 * M + 1.1) + 0.8 * np.cos(2.3 * M))
    fine = np.arange(parts * (len(M) - 1) + 1) / parts
    return ss.GroundMotion(np.interp(fine, M, x), dt=dt / parts, transverse=np.interp(fine, M, y))


def casters(locked: int = 0, rolling_mu: float = 0.01) -> ss.Cart:
    supports = [
        ss.Foot(at=at, mu=0.3)
        if i < locked
        else ss.SwivelCaster(
            at=at, heading=heading, slip_level=SLIP_LEVEL, reach=REACH, rolling_mu=rolling_mu
        )
        for i, (at, heading) in enumerate(zip(PLACES, HEADINGS))
    ]
    return ss.Cart(supports, radius_of_gyration=RADIUS_OF_GYRATION, outline=OUTLINE)


def start_of(ground: ss.GroundMotion, samples: int) -> ss.GroundMotion:
    assert ground.transverse is not None
    return ss.GroundMotion(
        ground.acceleration[:samples], dt=ground.dt, transverse=ground.transverse[:samples]
    )


# ---- MuJoCo


def by_mujoco(mujoco, setting: Setting, ground: ss.GroundMotion) -> np.ndarray:
    """Displacement of the center and yaw at the samples: one row (x, y, yaw) each.

    The ground acceleration is the gravity of each step, with its mean over the step.
    """
    supports = [
        {
            "at": at, "share": 1 / len(PLACES), "heading": heading,
            "side_mu": SLIP_LEVEL / G, "rolling_mu": 0.0, "reach": REACH,
        }
        for at, heading in zip(PLACES, HEADINGS)
    ]  # fmt: skip
    roll = mujoco_engine.roll(
        mujoco,
        Cart(setting.step, RADIUS_OF_GYRATION, supports),
        setting.impratio,
        mu=MU,
        height=setting.height,
    )
    steps = round(ground.dt / setting.step)
    within = (np.arange(steps) + 0.5) / steps
    load = -np.stack([ground.acceleration, ground.transverse], axis=1)
    found = [(0.0, 0.0, 0.0)]
    for first, last in pairwise(load):
        for x, y in (first + within[:, None] * (last - first)).tolist():
            at = roll(x, y, -G)
        found.append(at)
    return np.array(found)


def against_mujoco(mujoco, rounds: int) -> None:
    cart, ground = casters(rolling_mu=0), start_of(shaking(0.7), COMPARED)
    r = ss.integrate(cart, ground)
    peak, peak_yaw = np.linalg.norm(r.displacement, axis=1).max(), np.abs(r.yaw).max()
    print(f"\nfour casters without rolling resistance, 10 s, {len(r.events)} events:", end=" ")
    print(f"peak {1000 * peak:.1f} mm, {1000 * peak_yaw:.1f} mrad")
    print("error of the path: largest, at the end; largest of the yaw [% of the peak]")
    path = 0.0
    for setting in (*RIGID_BODIES, *SETTINGS):
        found = by_mujoco(mujoco, setting, ground)
        off = np.linalg.norm(found[:, :2] - r.displacement, axis=1)
        path, yaw = off.max() / peak, np.abs(found[:, 2] - r.yaw).max() / peak_yaw
        print(f"  {setting!s:52} {100 * path:8.2f} {100 * off[-1] / peak:8.2f} {100 * yaw:8.2f}")
    if not path <= CLOSE:
        sys.exit(f"wrong answer: {SETTINGS[-1]}: {path:.3g} of the peak")
    ours = "stickslip"
    works = {ours: (lambda: ss.integrate(cart, ground), 1)}
    works |= {str(s): (partial(by_mujoco, mujoco, s, ground), 1) for s in SETTINGS}
    timings = take_turns(works, rounds)
    print("times of the 10 s [ms], and over ours")
    for name, t in timings.items():
        milliseconds = f"{t.median * 1e-6:9.2f} {100 * t.spread:4.0f} %{' ' if t.reliable else '!'}"
        print(f"  {name:52} {milliseconds} {t.ratio(timings[ours]):8.0f}")
    print(UNRELIABLE)


# ---- ours


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
        r = ss.integrate(cart, start_of(shaking(p["factor"]), p["samples"]))
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
    print(versions("numpy", "mujoco"))
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
    if mujoco := peer("mujoco"):
        against_mujoco(mujoco, args.rounds)
    else:
        print("MuJoCo is not installed: not compared with it")


if __name__ == "__main__":
    main()
