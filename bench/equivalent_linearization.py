"""Covariances by equivalent linearization, against SciPy's solve_ivp at equal error.

Two states: one caster under white noise. Six: a block on a spring under Clough-Penzien's ground
acceleration, two filters of second order. SciPy is given what its user would write: the covariance
equations in plain time, by array arithmetic; for the caster from the leading terms of the series,
each force by itself. Answers are checked before they are timed.
"""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Callable

import numpy as np
import stickslip as ss
from measure import UNRELIABLE, bar, machine, peer, take_turns, versions

# As in equivalent_linearization.cpp: thesis figures 3.1 to 3.3.
TIMES = 10 ** (np.arange(37) / 9 - 1)
GAMMA, ALLOWED = 0.01, 1e-7
START = 1e-9
FASTER, FASTER_OF_SIX = 50, 20
METHODS = ("RK45", "DOP853", "LSODA")

Slope = Callable[[float, np.ndarray], list[float]]


def thesis(q11: float, q12: float, q22: float) -> tuple[float, float]:
    """(3.29), (3.30)."""
    from scipy.special import erfcx

    z = math.sqrt(q22 / (2 * (q11 * q22 - q12**2))) / GAMMA
    return 0.0, -math.sqrt(2 / q22) * z * erfcx(z)


NODES, WEIGHTS = np.polynomial.hermite_e.hermegauss(64)
WEIGHTS = WEIGHTS / WEIGHTS.sum()


def gaussian(q11: float, q12: float, q22: float) -> tuple[float, float]:
    """(3.22), (3.25): Gauss and Hermite where the density is narrow, else trapezoids."""
    from scipy.special import erf

    det = q11 * q22 - q12**2
    rms, width = math.sqrt(q11), math.sqrt(det / q22)

    def expected(f: Callable[[np.ndarray], np.ndarray], scale: float) -> float:
        if scale * GAMMA < 0.5:
            return float(WEIGHTS @ f(scale * NODES))
        end = min(9 * scale, 30 / GAMMA)
        x = np.linspace(-end, end, 401)
        density = np.exp(-((x / scale) ** 2) / 2) / (scale * math.sqrt(2 * math.pi))
        return float((f(x) * density).sum() * (x[1] - x[0]))

    level = expected(lambda x: 1 / np.cosh(GAMMA * x), width)
    pull = expected(
        lambda x: np.tanh(GAMMA * x) / np.cosh(GAMMA * x) * erf(q12 * x / math.sqrt(2 * q11 * det)),
        rms,
    )
    return GAMMA * pull, -math.sqrt(2 / (math.pi * q22)) * level


def slope(force: Callable[[float, float, float], tuple[float, float]]) -> Slope:
    def right_side(_: float, q: np.ndarray) -> list[float]:
        a21, a22 = force(*q)
        return [
            2 * q[1],
            a21 * q[0] + a22 * q[1] + q[2],
            2 * (a21 * q[1] + a22 * q[2] + math.pi),
        ]

    return right_side


def solve_ivp(right_side: Slope, tolerance: float, method: str) -> tuple[np.ndarray, int]:
    from scipy.integrate import solve_ivp as solve

    t, root = START, math.sqrt(START)
    start = [
        2 * math.pi / 3 * t**3 - 88 / 105 * t**3 * root,
        math.pi * t**2 - 22 / 15 * t**2 * root,
        2 * math.pi * t - 8 / 3 * t * root,
    ]
    found = solve(right_side, (t, TIMES[-1]), start, method, TIMES, rtol=tolerance, atol=1e-40)
    return found.y, found.nfev


def covariance(m: ss.Moments) -> np.ndarray:
    return np.array([m.displacement_variance, m.covariance, m.velocity_variance])


# ---- six states: x, x', and two of each filter
SOIL = {"s0": 0.05, "frequency": 15.0, "damping": 0.6, "filter_frequency": 1.5}
FLOOR = ss.Slider(ss.Coulomb(slip_level=0.5), natural_frequency=2.0)
GROUND = ss.Spectrum.clough_penzien(**SOIL, filter_damping=0.6)
LATE = np.linspace(1.0, 20.0, 20)


def six_states() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A without friction, the intensity of the noise, and the covariance at the start."""
    from scipy.linalg import solve_continuous_lyapunov

    wg, zg, wf, zf = SOIL["frequency"], SOIL["damping"], SOIL["filter_frequency"], 0.6
    a = np.zeros((6, 6))
    a[0, 1] = a[2, 3] = a[4, 5] = 1
    a[1, 0] = -(FLOOR.natural_frequency**2)
    a[3, 2:4] = -(wg**2), -2 * zg * wg
    a[5, 2:6] = wg**2, 2 * zg * wg, -(wf**2), -2 * zf * wf
    a[1, 2:6] = -a[5, 2:6]  # the ground accelerates as the second filter does
    noise = np.zeros((6, 6))
    noise[3, 3] = 2 * math.pi * SOIL["s0"]
    start = np.zeros((6, 6))
    start[2:, 2:] = solve_continuous_lyapunov(a[2:, 2:], -noise[2:, 2:])
    return a, noise, start


def solve_six(tolerance: float, method: str) -> tuple[np.ndarray, int]:
    from scipy.integrate import solve_ivp as solve

    a, noise, start = six_states()
    level = FLOOR.law.slip_level

    def right_side(_: float, y: np.ndarray) -> np.ndarray:
        q = y.reshape(6, 6)
        now = a.copy()
        now[1, 1] = -level * math.sqrt(2 / (math.pi * max(q[1, 1], 1e-16)))
        product = now @ q
        return (product + product.T + noise).ravel()

    # Relative to the size of each: variances of x and x' begin at zero.
    found = solve(
        right_side, (0, LATE[-1]), start.ravel(), method, LATE, rtol=tolerance, atol=tolerance / 100
    )
    q = found.y.reshape(6, 6, -1)
    return np.array([q[0, 0], q[0, 1], q[1, 1]]), found.nfev


def error_of_six(q: np.ndarray, exact: np.ndarray) -> float:
    """The covariance's in units of the variances."""
    if q.shape != exact.shape:
        return math.inf
    scale = np.array([exact[0], np.sqrt(exact[0] * exact[2]), exact[2]])
    return float(abs((q - exact) / scale).max())


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=11)
    parser.add_argument("--check", action="store_true", help="answers alone")
    options = parser.parse_args()
    wheel = ss.Caster(slip_level=1, reach=1 / GAMMA)
    scipy = peer("scipy")

    works, rows = {}, []
    for name, force in {"gaussian": gaussian, "thesis": thesis}.items():
        exact = covariance(
            ss.theory.EquivalentLinearization(name, tolerance=1e-12).predict(wheel, 1, TIMES)
        )
        # The loosest tolerance that leaves an error no larger than allowed.
        for tolerance in (1e-7, 5e-8, 2e-8, 1e-8):
            ours = ss.theory.EquivalentLinearization(name, tolerance=tolerance)
            error = abs(covariance(ours.predict(wheel, 1, TIMES)) / exact - 1).max()
            if error < ALLOWED:
                break
        else:
            sys.exit(f"wrong answer: {name}, {error:.3g}, allowed {ALLOWED}")
        works[name] = (lambda ours=ours: ours.predict(wheel, 1, TIMES), 1)
        rows.append((name, f"{error:.0e}, tolerance {tolerance:.0e}"))
        if scipy is None:
            continue
        # Likewise by SciPy's default, by the method that it recommends for tight tolerances, and by
        # the one that is compiled.
        for method in METHODS:
            for tolerance in [m * 10.0**n for n in range(-6, -12, -1) for m in (1, 0.5, 0.2)]:
                q, evaluations = solve_ivp(slope(force), tolerance, method)
                error = abs(q / exact - 1).max() if q.shape == exact.shape else math.inf
                if error < ALLOWED:
                    break
            else:
                sys.exit(f"wrong answer: scipy {method}, {name}, {error:.3g}, allowed {ALLOWED}")
            key = f"{name}, scipy {method}"
            works[key] = (
                lambda f=force, tol=tolerance, how=method: solve_ivp(slope(f), tol, how),
                1,
            )
            rows.append((key, f"{error:.0e}, rtol {tolerance:.0e}, {evaluations} evaluations"))
    exact = covariance(
        ss.theory.EquivalentLinearization(tolerance=1e-12).predict(FLOOR, GROUND, LATE)
    )
    for tolerance in [m * 10.0**n for n in range(-5, -12, -1) for m in (1, 0.5, 0.2)]:
        ours = ss.theory.EquivalentLinearization(tolerance=tolerance)
        error = error_of_six(covariance(ours.predict(FLOOR, GROUND, LATE)), exact)
        if error < ALLOWED:
            break
    else:
        sys.exit(f"wrong answer: six states, {error:.3g}, allowed {ALLOWED}")
    works["six states"] = (lambda: ours.predict(FLOOR, GROUND, LATE), 1)
    rows.append(("six states", f"{error:.0e}, tolerance {tolerance:.0e}"))
    for method in METHODS if scipy is not None else ():
        for tolerance in [m * 10.0**n for n in range(-5, -12, -1) for m in (1, 0.5, 0.2)]:
            q, evaluations = solve_six(tolerance, method)
            error = error_of_six(q, exact)
            if error < ALLOWED:
                break
        else:
            sys.exit(f"wrong answer: scipy {method}, six states, {error:.3g}, allowed {ALLOWED}")
        key = f"six states, scipy {method}"
        works[key] = (lambda tol=tolerance, how=method: solve_six(tol, how), 1)
        rows.append((key, f"{error:.0e}, rtol {tolerance:.0e}, {evaluations} evaluations"))
    if options.check:
        return

    timings = take_turns(works, options.rounds)
    print(machine())
    print(versions("numpy", "scipy"))
    print(f"\n{'ms per solution':44} {'median':>9} {'spread':>7}  error")
    for key, note in rows:
        t = timings[key]
        flag = " " if t.reliable else "!"
        print(f"{key:44} {t.median / 1e6:9.3f} {100 * t.spread:6.0f}%{flag} {note}")
    if not all(t.reliable for t in timings.values()):
        print(UNRELIABLE)
    if scipy is not None:
        print()
        for name, faster in (
            ("gaussian", FASTER),
            ("thesis", FASTER),
            ("six states", FASTER_OF_SIX),
        ):
            for method in METHODS:
                ratio = timings[f"{name}, scipy {method}"].ratio(timings[name])
                print(bar(f"{name}: times as fast as scipy's {method}", ratio, faster, True))


if __name__ == "__main__":
    main()
