"""The map of thesis figure 4.1, 400 points, against SciPy's quad and brentq.

Every point's answer is checked before it is timed.
"""

from __future__ import annotations

import argparse
import math
import sys

import numpy as np
import stickslip as ss
from measure import UNRELIABLE, bar, machine, peer, take_turns, versions

SIDE = [0.1 * i for i in range(1, 21)]  # Omega1 and dOmega
OURS, CLOSED, QUAD = "stickslip", "SciPy, brentq on (4.35)", "SciPy, brentq and quad"


def ours() -> np.ndarray:
    method, block = ss.theory.StationaryLinearization(), ss.Slider(ss.Coulomb(slip_level=1.0))
    band = ss.Spectrum.band_pass
    return np.array(
        [
            [method.predict(block, band(s0=1.0, low=o, high=o + d)).velocity_std for d in SIDE]
            for o in SIDE
        ]
    )


def by_scipy(square) -> np.ndarray:
    from scipy.optimize import brentq

    def velocity(low: float, width: float) -> float:
        if math.pi * width <= 1:
            return 0.0

        def excess(y: float) -> float:
            return math.pi / 2 * math.exp(2 * y) * square(math.exp(y), low, low + width) - 1

        return math.sqrt(2 / math.pi) / math.exp(brentq(excess, -3, 5, xtol=1e-13, rtol=1e-13))

    return np.array([[velocity(o, d) for d in SIDE] for o in SIDE])


def closed(z: float, low: float, high: float) -> float:
    return 2 / z * math.atan(z * (high - low) / (z * z + low * high))


def by_quadrature(z: float, low: float, high: float) -> float:
    from scipy.integrate import quad

    return 2 * quad(lambda w: 1 / (w * w + z * z), low, high, epsabs=0, epsrel=1e-10)[0]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=11)
    parser.add_argument("--check", action="store_true", help="answers alone")
    asked = parser.parse_args()
    works = {OURS: (ours, 1000)}  # items: times come out in microseconds
    if peer("scipy"):
        works |= {
            CLOSED: (lambda: by_scipy(closed), 1000),
            QUAD: (lambda: by_scipy(by_quadrature), 1000),
        }
    for name, (work, _) in works.items():
        worst = np.max(np.abs(work() - ours()))
        if not worst <= 1e-9:
            sys.exit(f"wrong answer: {name}: {worst:.3g} from stickslip's, allowed 1e-9")
    if asked.check:
        return
    print(machine())
    print(versions("scipy"))
    rows = take_turns(works, asked.rounds)
    print(f"\n{'400 points: us':44} {'median':>9} {'spread':>7} {'ratio':>9}")
    for name, timing in rows.items():
        print(f"{name:44} {timing} {timing.ratio(rows[OURS]):9.3g}")
    if not all(t.reliable for t in rows.values()):
        print(UNRELIABLE)
    print("bars")
    print(bar("the map of figure 4.1 [ms], Python's calls included", rows[OURS].median / 1e3, 1))


if __name__ == "__main__":
    main()
