"""The transport operator: the cost of a prediction, beside the ensemble that reaches its error.

Each prediction is checked against an ensemble before it is timed. The ensemble that would reach the
same error has (standard error of the checked one / stated error)^2 times its members; its time is
that of the checked one in that proportion.
"""

from __future__ import annotations

import argparse
import math
import sys
import time

import stickslip as ss
from measure import UNRELIABLE, bar, machine, take_turns, versions

LAST, DT, MEMBERS = 60.0, 0.1, 20_000
BLOCK = ss.Coulomb(slip_level=1.0)


def ground(damping: float, rms: float) -> ss.Spectrum:
    """Kanai and Tajimi's, of 1 rad/s."""
    s0 = rms**2 * 2 * damping / (math.pi * (1 + 4 * damping**2))
    return ss.Spectrum.kanai_tajimi(s0=s0, frequency=1.0, damping=damping)


SETTINGS = {
    "block, rms / a = 1": (ss.Slider(BLOCK), ground(0.6, 1.0)),
    "block, rms / a = 3": (ss.Slider(BLOCK), ground(0.6, 3.0)),
    "block, levels 1 : 1.5": (
        ss.Slider(ss.Coulomb(slip_level=1.0, backward=1.5)),
        ground(0.5, 1.5),
    ),
    "spring, wn / wg = 0.5": (ss.Slider(BLOCK, natural_frequency=0.5), ground(0.5, 1.5)),
    "spring, wn / wg = 1": (ss.Slider(BLOCK, natural_frequency=1.0), ground(0.5, 1.5)),
    "static friction 1.3 a": (ss.Slider(ss.StaticKinetic(BLOCK, static=1.3)), ground(0.6, 1.0)),
    "liners 0.5 to 1, wn / wg = 0.5": (
        ss.Slider(
            ss.VelocityDependent(slow=0.5, fast=1.0, rate=2.0),
            natural_frequency=0.5,
        ),
        ground(0.5, 1.5),
    ),
}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=5)
    args = parser.parse_args()

    theory = ss.theory.Transport()
    samples = round(LAST / DT) + 1
    ensembles = {}
    for name, (slider, spectrum) in SETTINGS.items():
        excitation = ss.GaussianExcitation(
            spectrum,
            DT,
            samples,
            random_amplitudes=True,
            zero_frequency=True,
            period=4 * samples,
        )
        start = time.process_time()
        e = ss.run_ensemble(slider, excitation, members=MEMBERS, seed=1, threads=1, dt=LAST / 2)
        seconds = time.process_time() - start
        p = theory.predict(slider, spectrum, [LAST])
        value, error = p.displacement_variance[0], p.error.displacement_variance[0]
        apart = abs(value - e.displacement_variance[-1])
        if not apart < error + 5 * e.displacement_variance_error[-1] + 0.01 * value:
            sys.exit(
                f"wrong answer: {name}: {value:.4g}, simulated {e.displacement_variance[-1]:.4g}"
            )
        ensembles[name] = seconds * (e.displacement_variance_error[-1] / error) ** 2, error / value

    print(machine())
    print(versions("numpy"))
    works = {
        name: (lambda s=slider, n=spectrum: theory.predict(s, n, [LAST]), 1)
        for name, (slider, spectrum) in SETTINGS.items()
    }
    timings = take_turns(works, args.rounds)
    print(f"{'seconds per prediction at 1 %':34} median spread   error   ensemble of that error")
    for name, t in timings.items():
        seconds, error = ensembles[name]
        print(
            f"  {name:32} {t.median * 1e-9:6.3f} {100 * t.spread:4.0f}%{' ' if t.reliable else '!'}"
            f" {100 * error:6.2f} % {seconds:8.1f} s, {seconds / (t.median * 1e-9):5.1f} times"
        )
    if not all(t.reliable for t in timings.values()):
        print(UNRELIABLE)
    print("bars")
    for kind, limit in (("block", 0.1), ("spring", 2.0)):
        slowest = max(t.median for name, t in timings.items() if name.startswith(kind))
        print(bar(f"{kind} under a filter of two states at 1 %, slowest, s", slowest * 1e-9, limit))


if __name__ == "__main__":
    main()
