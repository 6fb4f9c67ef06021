"""Fragility curves: the sweep of random sliders, the fit, and the bands.

`python bench/fragility.py`: 18 sample records at 20 levels of PGA, 100 random coefficients of
friction, both polarities, on one thread: 72,000 responses.
"""

from __future__ import annotations

import argparse
import sys

import numpy as np
import stickslip as ss
from measure import bar, machine, take_turns, versions

THRESHOLDS = (0.05, 0.1, 0.3)  # [m]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=5)
    args = parser.parse_args()
    print(machine())
    print(versions("numpy", "scipy"))
    suite = ss.sample_records()
    stripes = suite.stripes(pga_g=np.linspace(0.05, 1.5, 20))
    mu = ss.Random(ss.Coulomb, mu=ss.Lognormal(median=0.3, beta=0.3))

    def slide() -> ss.SweepTable:
        return ss.sweep(mu, stripes, members=100, seed=1, settle=True, threads=1)

    table = slide()
    one = ss.integrate(mu.sample(seed=1, member=7), stripes[300], settle=True)
    if not abs(table.peak[7, 300, 0] - one.peak) <= 1e-12 * one.sliding_distance:
        sys.exit(f"wrong answer: {table.peak[7, 300, 0]} m, integrate gives {one.peak} m")

    def fit(method: str) -> ss.Fragility:
        return ss.Fragility.fit(table, im="pga_g", thresholds=THRESHOLDS, method=method)

    counted, cloud = fit("lognormal"), fit("cloud")
    hazard = ss.Hazard(np.geomspace(0.01, 5, 20), 1e-3 * np.geomspace(0.01, 5, 20) ** -2.0)
    works = {
        "stripes, 18 records at 20 levels": lambda: suite.stripes(pga_g=np.linspace(0.05, 1.5, 20)),
        f"sweep, {table.peak.size:,} responses": slide,
        "fit, lognormal": lambda: fit("lognormal"),
        "fit, logit": lambda: fit("logit"),
        "fit, cloud": lambda: fit("cloud"),
        "bands, 1,000 samples": counted.bands,
        "bands of the cloud, 1,000 samples": cloud.bands,
        "rates of exceedance": lambda: counted.rate_of_exceedance(hazard),
    }
    times = take_turns({name: (work, 1) for name, work in works.items()}, args.rounds)
    print("seconds of processor time")
    for name, timing in times.items():
        print(f"  {name:36}{timing.median * 1e-9:8.3f}")
    seconds = {name: timing.median * 1e-9 for name, timing in times.items()}
    print(bar("sweep [s]", seconds[f"sweep, {table.peak.size:,} responses"], 0.15))
    print(bar("bands [s]", seconds["bands, 1,000 samples"], 1.0))


if __name__ == "__main__":
    main()
