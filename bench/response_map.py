"""The response map of the caster, thesis figure 2.2, against a solution with SciPy.

Seven curves, B/a from 0.5 to 8, of 400 points each. Along the amplitudes a curve is a formula,
which NumPy evaluates too. Along the frequencies all amplitudes are wanted: by `brentq` between the
changes of sign on a grid of 200 amplitudes, as a user's loop would find them. The answers are
compared first.
"""

from __future__ import annotations

import argparse
import math
import sys
from functools import partial

import numpy as np
import stickslip as ss
from measure import UNRELIABLE, bar, machine, take_turns, versions
from scipy.optimize import brentq

FORCES = (0.5, 1.0, 1.25, 1.3, 2.0, 4.0, 8.0)  # B/a
POINTS = 400
AMPLITUDES = np.geomspace(1e-3, 1e3, POINTS)
FREQUENCIES = np.geomspace(0.05, 5.0, POINTS).tolist()

SVP = ss.theory.SlowlyVaryingParameters(ss.Caster(slip_level=1.0, reach=1.0))

# ---- the solution with SciPy


def friction(y):
    """|S| of a caster, a = 3l = 1."""
    return 4 / math.pi * 2 * np.arctan(np.tanh(y / 2)) / y


def scalar_balance(y: float, B: float, omega: float) -> float:
    s = 8 / math.pi * math.atan(math.tanh(y / 2)) / y
    return s * s + omega**4 * y * y - B * B


def by_numpy(B: float) -> np.ndarray:
    """(2.35)."""
    with np.errstate(invalid="ignore"):
        return np.sqrt(np.sqrt(B * B - friction(AMPLITUDES) ** 2) / AMPLITUDES)


def by_brentq(B: float, omega: float) -> list[float]:
    grid = np.geomspace(1e-4, 1.001 * B / omega**2, 200)
    balance = friction(grid) ** 2 + (omega**2 * grid) ** 2 - B * B
    changes = np.flatnonzero(np.diff(np.sign(balance)))
    return [brentq(scalar_balance, grid[i], grid[i + 1], (B, omega), xtol=1e-14) for i in changes]


# ---- the run


def our_frequencies() -> list[np.ndarray]:
    return [SVP.frequency(B, AMPLITUDES)[1] for B in FORCES]


def our_amplitudes() -> list[list[float]]:
    return [[s.amplitude for s in SVP.response(B, w)] for B in FORCES for w in FREQUENCIES]


def user_frequencies() -> list[np.ndarray]:
    return [by_numpy(B) for B in FORCES]


def user_amplitudes() -> list[list[float]]:
    return [by_brentq(B, w) for B in FORCES for w in FREQUENCIES]


def require(what: str, found: float, allowed: float) -> None:
    if not found <= allowed:
        sys.exit(f"wrong answer: {what}: {found:.3g}, allowed {allowed:.3g}")


def check() -> int:
    """The two agree; returns at how many places the grid misses two solutions next to a fold."""
    for ours, users in zip(our_frequencies(), user_frequencies(), strict=True):
        both = ~(np.isnan(ours) | np.isnan(users))
        require("branches", np.count_nonzero(np.isnan(ours) != np.isnan(users)), 1)
        require("frequencies", np.max(np.abs(ours / users - 1)[both]), 1e-10)
    missed = 0
    for ours, users in zip(our_amplitudes(), user_amplitudes(), strict=True):
        if len(ours) == len(users) + 2:
            missed += 1
            continue
        require("number of amplitudes", abs(len(ours) - len(users)), 0)
        for a, b in zip(ours, users):
            require("amplitudes", abs(a / b - 1), 1e-9)
    return missed


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=11)
    args = parser.parse_args()
    missed = check()
    print(machine())
    print(versions("numpy", "scipy"))
    count = len(FORCES) * POINTS
    print(
        f"{len(FORCES)} curves of {POINTS} points; answers compared; the grid misses {missed} pairs"
    )
    works = {
        "frequency, 400 amplitudes at once": (our_frequencies, count),
        "numpy": (user_frequencies, count),
        "response, one frequency at a time": (our_amplitudes, count),
        "numpy grid and brentq": (user_amplitudes, count),
    }
    timings = take_turns(
        {name: (partial(f), items) for name, (f, items) in works.items()}, args.rounds
    )
    print("microseconds a point, median and spread; of a curve of 400 points")
    for name, t in timings.items():
        flag = " " if t.reliable else "!"
        us = t.median / 1000
        print(f"  {name:36} {us:8.3f} {100 * t.spread:5.0f}%{flag} {POINTS * us:10.0f}")
    if not all(t.reliable for t in timings.values()):
        print(UNRELIABLE)
    ours, users, points, loop = timings.values()
    print("ratios")
    print(bar("numpy / frequency", users.ratio(ours), 1, at_least=True))
    print(bar("numpy and brentq / response", loop.ratio(points), 1, at_least=True))


if __name__ == "__main__":
    main()
