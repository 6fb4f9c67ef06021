"""The cost of a law that is given as Python functions: python bench/own_laws.py [--members N]

The same friction, mu = 0.15 - 0.05 exp(-50 s/m v), as a Python function, as a function that numba
compiled, and as the built-in `VelocityDependent`: processor time per sample of an ensemble, and for
one record (Kobe). Reports how often the law is called for each sample.
"""

from __future__ import annotations

import argparse
import math
import time

import numba
import stickslip as ss
from measure import take_turns

G = ss.STANDARD_GRAVITY


def level(x: float, speed: float, direction: float) -> float:
    return G * (0.15 - 0.05 * math.exp(-50 * speed))


class Counted:
    """The law, counting its calls."""

    calls = 0

    def __call__(self, x: float, speed: float, direction: float) -> float:
        self.calls += 1
        return level(x, speed, direction)


def main() -> None:
    ask = argparse.ArgumentParser(description=__doc__)
    ask.add_argument("--members", type=int, default=200)
    ask.add_argument("--rounds", type=int, default=5)
    args = ask.parse_args()

    laws = {
        "Python function": ss.Law(resist=level),
        "numba.cfunc": ss.Law(resist=numba.cfunc("float64(float64, float64, float64)")(level)),
        "built-in": ss.VelocityDependent(mu_slow=0.1, mu_fast=0.15, rate=50),
    }
    spectrum = ss.Spectrum.kanai_tajimi(s0=0.05, frequency=15.0, damping=0.6)
    shaking = ss.GaussianExcitation(spectrum, dt=0.02, samples=512)
    kobe = ss.sample_record("Kobe")

    def ensemble(law: object, members: int = args.members) -> ss.Ensemble:
        return ss.run_ensemble(law, shaking, members=members, seed=1, threads=1)

    counted = Counted()
    began = time.process_time()
    ensemble(ss.Law(resist=counted), 20)
    print(f"calls per sample in the ensemble: {counted.calls / (20 * 512):.0f}")
    counted.calls = 0
    ss.integrate(ss.Law(resist=counted), kobe)
    print(f"calls per sample of the record: {counted.calls / len(kobe):.0f}, {len(kobe)} samples")
    print(f"slides {100 * ss.integrate(laws['built-in'], kobe).time_sliding / kobe.duration:.0f} %")
    print(f"({time.process_time() - began:.1f} s)")

    many = {name: (lambda law=law: ensemble(law), args.members * 512) for name, law in laws.items()}
    one = {name: (lambda law=law: ss.integrate(law, kobe), 1) for name, law in laws.items()}
    print("\n| law | ensemble [us per sample] | Kobe [ms] |\n|---|---|---|")
    ensembles, records = take_turns(many, args.rounds), take_turns(one, args.rounds)
    for name in laws:
        print(
            f"| {name} | {ensembles[name].median / 1e3:.3g} | {records[name].median / 1e6:.3g} |"
            f" spread {ensembles[name].spread:.0%}, {records[name].spread:.0%}"
        )


if __name__ == "__main__":
    main()
