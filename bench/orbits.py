"""An orbit of a caster: its cost here, and by shooting with scipy's solve_ivp.

The loop of one's own goes over half a period with events at each zero of the velocity, and Newton's
method on differences of it. It is given a guess near the answer, which `orbits` does without; so it
is set against `continuation`, which has one too. Answers are checked before they are timed.
"""

from __future__ import annotations

import argparse
import math
import sys

import numpy as np
import stickslip as ss
from measure import UNRELIABLE, machine, peer, take_turns, versions

B, OMEGA, AMPLITUDE = 1.0, 0.5, 3.3288206151731696  # values.json harm.caster.b1.0.W0.5
TOLERANCE = 1e-10
LAW = ss.Caster(slip_level=1.0, reach=1.0)


def half_period(solve_ivp, phase: float, state: np.ndarray) -> np.ndarray:
    """Minus the state half a period later; this orbit reverses without stops."""
    t, end, y = 0.0, math.pi / OMEGA, np.array(state)
    direction = math.copysign(1, y[1]) if y[1] else math.copysign(1, B * math.cos(phase))
    crossing = lambda t, y: y[1]  # noqa: E731
    crossing.terminal = True
    while t < end:
        crossing.direction = -direction

        def rate(t, y, s=direction):
            return y[1], B * math.cos(phase + OMEGA * t) - s / math.cosh(y[0])

        run = solve_ivp(rate, (t, end), y, "DOP853", events=crossing, rtol=1e-12, atol=1e-12)
        t, y = run.t[-1], run.y[:, -1]
        direction = -direction
    return -y


def shoot(solve_ivp, guess: np.ndarray, phase: float) -> np.ndarray:
    state = np.array(guess)
    for _ in range(20):
        image = half_period(solve_ivp, phase, state)
        miss = image - state
        if np.abs(miss).max() < TOLERANCE:
            return state
        step, jacobian = 1e-6, np.empty((2, 2))
        for i in range(2):
            moved = state.copy()
            moved[i] += step
            jacobian[:, i] = (half_period(solve_ivp, phase, moved) - image) / step
        state -= np.linalg.solve(jacobian - np.eye(2), miss)
    sys.exit("wrong answer: scipy's shooting does not converge")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--check", action="store_true", help="answers alone")
    args = parser.parse_args()

    orbit = ss.harmonic.orbits(LAW, B, OMEGA)[-1]
    if abs(orbit.amplitude / AMPLITUDE - 1) > 1e-9:
        sys.exit(f"wrong answer: {orbit.amplitude}, not {AMPLITUDE}")
    branch = ss.harmonic.continuation(LAW, orbit, 0.3, 2.0)
    works = {
        "stickslip orbits, all three": (lambda: ss.harmonic.orbits(LAW, B, OMEGA), 1),
        "stickslip continuation, each orbit": (
            lambda: ss.harmonic.continuation(LAW, orbit, 0.3, 2.0),
            len(branch),
        ),
    }
    scipy = peer("scipy.integrate")
    if scipy:
        phase = 0.5 * math.pi - orbit.phase
        exact = np.array([values[0] for values in orbit.histories([phase / OMEGA])])
        found = shoot(scipy.solve_ivp, exact * 1.01, phase)
        if np.abs(found - exact).max() > 10 * TOLERANCE:
            sys.exit(f"wrong answer: scipy finds {found}, not {exact}")
        works["scipy solve_ivp, shooting from 1 % off"] = (
            lambda: shoot(scipy.solve_ivp, exact * 1.01, phase),
            1,
        )
    if args.check:
        return
    print(machine())
    print(versions("numpy", "scipy"))
    print(f"us of processor time over {args.rounds} rounds; spread; ratio to continuation")
    timings = take_turns(works, args.rounds)
    base = timings["stickslip continuation, each orbit"]
    for name, timing in timings.items():
        flag = " " if timing.reliable else "!"
        print(
            f"  {name:42} {timing.median / 1e3:10.1f} {100 * timing.spread:4.0f}%{flag}"
            f" {timing.ratio(base):8.1f}"
        )
    if not all(timing.reliable for timing in timings.values()):
        print(UNRELIABLE)


if __name__ == "__main__":
    main()
