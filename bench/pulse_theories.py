"""Theories of Poisson pulses: the cost of a prediction, here and with SciPy's quadrature.

The peer integrates thesis (5.35) and (5.41) with scipy.integrate.quad and sums (5.54) and (5.55):
what a user would write. The answers are checked before they are timed.
"""

from __future__ import annotations

import argparse
import math
import sys

import numpy as np
import stickslip as ss
from measure import UNRELIABLE, bar, machine, peer, take_turns, versions

EVENTS = [ss.PoissonPulses.event(name) for name in ss.PoissonPulses.events()]
MU = np.linspace(0.01, 0.61, 31)
HARDEST = [(1 / 3, 2.0), (1.0, 2.0), (3.0, 2.0), (5.0, 2.0), (20.0, 2.0)]  # sigma / a, lambda dt


def series(sigma: float, overlap: float) -> float:
    """Growth rate in units of a and dt, thesis (5.55), with the rate corrected."""
    from scipy.integrate import quad

    def g(s: float) -> float:
        def integrand(b: float) -> float:
            return (b * ((b - 1) / (b + 1)) ** 2) ** 2 * math.exp(-b * b / (2 * s * s))

        return math.sqrt(2 / math.pi) * quad(integrand, 1, 1 + 12 * s, epsrel=1e-10, limit=200)[0]

    total, weight, m = 0.0, math.exp(-overlap), 0
    while m < 10 or weight > 1e-16:
        s = math.sqrt(m + 1) * sigma
        total += weight * overlap / s * g(s)
        m += 1
        weight *= overlap / m
    return total / (1 + overlap)


def curve_by_quadrature() -> np.ndarray:
    rms = []
    for event in EVENTS:
        dt, p = event.half_width, event.rate * event.half_width
        for mu in MU:
            a = mu * ss.STANDARD_GRAVITY
            growth = series(event.sigma / a, p) * a**2 * dt**3
            rms.append(math.sqrt(growth * event.duration))
    return np.array(rms)


def curve(theory: ss.theory.PulseChain | ss.theory.PulseSuperposition) -> np.ndarray:
    return np.array([theory.final_rms(ss.Coulomb(mu=mu), event) for event in EVENTS for mu in MU])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=7)
    args = parser.parse_args()

    superposition, chain = ss.theory.PulseSuperposition(), ss.theory.PulseChain()
    works = {
        "figure 5.7, superposition": (lambda: curve(superposition), len(EVENTS) * len(MU)),
        "figure 5.7, chain": (lambda: curve(chain), len(EVENTS) * len(MU)),
    }
    if peer("scipy"):
        apart = float(np.max(np.abs(curve_by_quadrature() / curve(superposition) - 1)))
        if not apart < 1e-6:
            sys.exit(f"wrong answer: superposition against quadrature: {apart:.3g}")
        works["figure 5.7, superposition by scipy.integrate.quad"] = (
            curve_by_quadrature,
            len(EVENTS) * len(MU),
        )
    block = ss.Coulomb(slip_level=1)
    for sigma, rate in HARDEST:
        pulses = ss.PoissonPulses(rate=rate, half_width=1, sigma=sigma, duration=1000)
        works[f"chain, sigma/a {sigma:.3g}, lambda dt {rate:g}"] = (
            lambda pulses=pulses: chain.predict(block, pulses, [1000.0]),
            1,
        )

    print(machine())
    print(versions("numpy", "scipy"))
    timings = take_turns(works, args.rounds)
    print(f"{'ms per prediction':52} median spread")
    for name, t in timings.items():
        print(
            f"  {name:50} {t.median * 1e-6:8.3f} {100 * t.spread:4.0f}%{' ' if t.reliable else '!'}"
        )
    if not all(t.reliable for t in timings.values()):
        print(UNRELIABLE)
    print("bars")
    slowest = max(t.median for name, t in timings.items() if name.startswith("chain"))
    print(bar("pulse chain, slowest point, ms", slowest * 1e-6, 100))
    ours = timings["figure 5.7, superposition"]
    other = timings.get("figure 5.7, superposition by scipy.integrate.quad")
    if other:
        print(f"  superposition is {other.ratio(ours):.0f} times as fast as scipy's quadrature")


if __name__ == "__main__":
    main()
