"""Response spectra of 100 periods of a record of 10,000 samples, against numba and SciPy.

Ours is the maximum in continuous time; the peers take the largest sample, as is usual. Every answer
is checked before it is timed: on samples 64 times as dense numba's must be ours.
"""

from __future__ import annotations

import argparse
import math
import sys

import numpy as np
import stickslip as ss
from measure import UNRELIABLE, bar, machine, peer, take_turns, versions

DT, SAMPLES, DAMPING = 0.01, 10_000, 0.05
PERIODS = np.geomspace(0.02, 10, 100)
FINER = 64
OURS, NUMBA, SCIPY = "stickslip", "numba, Nigam and Jennings", "scipy.signal.lsim, 5 periods"

nb = peer("numba")


def record(samples: int) -> ss.GroundMotion:
    """Filtered noise under an envelope."""
    white = np.random.default_rng(1).standard_normal(samples)
    n = np.convolve(white, np.hanning(12), "same")
    t = np.arange(samples) * DT
    envelope = np.minimum(t / 5, 1) * np.exp(-np.maximum(t - 15, 0) / 20)
    return ss.GroundMotion(n * envelope, dt=DT).detrended(1).scaled_to(pga_g=0.3)


def step_matrices(period: float, dt: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """State, n at the beginning, n at the end: by Nigam and Jennings (1969)."""
    wn, z = 2 * math.pi / period, DAMPING
    wd = wn * math.sqrt(1 - z * z)
    e, s, c = math.exp(-z * wn * dt), math.sin(wd * dt), math.cos(wd * dt)
    r = z / math.sqrt(1 - z * z)
    a = np.array([[e * (r * s + c), e * s / wd], [-e * wn**2 * s / wd, e * (c - r * s)]])
    p, q = (2 * z * z - 1) / (wn * wn * dt), 2 * z / (wn**3 * dt)
    b0 = [
        e * ((p + z / wn) * s / wd + (q + 1 / wn**2) * c) - q,
        e * ((p + z / wn) * (c - r * s) - (q + 1 / wn**2) * (wd * s + z * wn * c))
        + 1 / (wn**2 * dt),
    ]
    b1 = [
        -e * (p * s / wd + q * c) - 1 / wn**2 + q,
        -e * (p * (c - r * s) - q * (wd * s + z * wn * c)) - 1 / (wn**2 * dt),
    ]
    return a, np.array(b0), np.array(b1)


if nb:

    @nb.njit
    def largest(n, a, b0, b1):
        x = v = most = 0.0
        for i in range(len(n) - 1):
            x, v = (
                a[0, 0] * x + a[0, 1] * v + b0[0] * n[i] + b1[0] * n[i + 1],
                a[1, 0] * x + a[1, 1] * v + b0[1] * n[i] + b1[1] * n[i + 1],
            )
            most = max(most, abs(x))
        return most

    def by_numba(motion: ss.GroundMotion) -> np.ndarray:
        n, dt = np.asarray(motion.acceleration), motion.dt
        return np.array(
            [(2 * math.pi / T) ** 2 * largest(n, *step_matrices(T, dt)) for T in PERIODS]
        )


def by_lsim(lsim, motion: ss.GroundMotion, periods: np.ndarray) -> np.ndarray:
    values = []
    for T in periods:
        wn = 2 * math.pi / T
        system = ([[0, 1], [-wn * wn, -2 * DAMPING * wn]], [[0], [-1]], [[1, 0]], [[0]])
        x = lsim(system, motion.acceleration, motion.time)[1]
        values.append(wn * wn * np.abs(x).max())
    return np.array(values)


def check(name: str, found: np.ndarray, ours: np.ndarray, step: float) -> None:
    """Of a sample nearest to the maximum (wn dt)^2 / 8 is missing, and nothing is ever added.

    But for round-off: the textbook's coefficients cancel, to 1e-8 in steps of T / 64,000.
    """
    missing = 1 - found / ours
    allowed = np.minimum((2 * math.pi * step / PERIODS[: len(found)]) ** 2 / 8 * 1.1 + 1e-7, 1)
    if not np.all((missing >= -1e-7) & (missing <= allowed)):
        sys.exit(f"wrong answer: {name}: {missing.max():.3g} below, {-missing.min():.3g} above")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=11)
    parser.add_argument("--check", action="store_true", help="answers alone")
    asked = parser.parse_args()
    motion = record(SAMPLES)
    ours = ss.response_spectrum(motion, PERIODS).values
    works = {OURS: (lambda: ss.response_spectrum(motion, PERIODS), 1000)}
    if nb:
        fine = motion.resampled(DT / FINER)
        check(f"numba, dt / {FINER}", by_numba(fine), ours, DT / FINER)
        works[NUMBA] = (lambda: by_numba(motion), 1000)
    if peer("scipy"):
        from scipy.signal import lsim

        check("lsim", by_lsim(lsim, motion.resampled(DT / 4), PERIODS[:5]), ours[:5], DT / 4)
        works[SCIPY] = (lambda: by_lsim(lsim, motion, PERIODS[::20]), 1000)
    if asked.check:
        return
    print(machine())
    print(versions("numba", "scipy"))
    rows = take_turns(works, asked.rounds)
    print(f"\n{'100 periods, 10,000 samples: us':44} {'median':>9} {'spread':>7} {'ratio':>9}")
    for name, timing in rows.items():
        print(f"{name:44} {timing} {timing.ratio(rows[OURS]):9.3g}")
    print(bar("100 periods of 10,000 samples [ms]", rows[OURS].median / 1000, 10))
    if not all(t.reliable for t in rows.values()):
        print(UNRELIABLE)


if __name__ == "__main__":
    main()
