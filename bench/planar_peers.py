"""Sliding in two horizontal directions, against peers.

    pip install numba scipy openseespy
    python bench/planar_peers.py [--rounds N] [--check]

`integrate` of a `PlanarSlider` beside the return mapping that a user would write in numba, with one
step a sample and refined, `solve_ivp` (DOP853, slip by slip) and OpenSees (`flatSliderBearing` in
three dimensions), under three pairs of the noise of bench/planar.cpp: errors of peak and final
displacement, and times of one of the pairs, in turns. Every answer is checked before it is timed.
"""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, partial
from importlib import metadata

import numpy as np
import stickslip as ss
from accuracy import OURS, Answer, Errors, all_errors, print_times, times
from measure import machine, peer, versions
from opensees import AVERAGE_ACCELERATION, prepare, shake

G = ss.STANDARD_GRAVITY
DT, SAMPLES, PAIRS = 0.01, 2048, 3  # time step [s]
TOLERANCES = (1e-6, 1e-8)  # of solve_ivp
STEPS = ((1, 1e-3), (10, 1e-4), (40, 1e-5))  # of OpenSees: steps a sample, yield displacement [m]
REFINED = 1e-6  # of the peak: the error to which return mapping is refined
AT_REST = 1e-7  # of solve_ivp: speed at which a slip ends [m/s]


@dataclass(frozen=True)
class Case:
    """A slider in the plane."""

    name: str
    level: float  # [m/s^2]
    frequency: float  # of the spring [rad/s]
    motions: tuple[ss.GroundMotion, ...]

    @property
    def slider(self) -> ss.PlanarSlider:
        law = ss.Coulomb(slip_level=self.level)
        return ss.PlanarSlider(law, natural_frequency=self.frequency)


def noise(seed: int) -> list[float]:
    """That of bench/planar.cpp: correlation time 0.1 s, standard deviation 1.5 m/s^2."""
    values, value, state = [], 0.0, seed
    for _ in range(SAMPLES):
        total = -6.0
        for _ in range(12):
            state = (state * 1664525 + 1013904223) % 2**32
            total += state / 2**32
        value = 0.9 * value + 0.436 * 1.5 * total
        values.append(value)
    values[-1] = 0.0
    return values


def cases() -> list[Case]:
    pairs = tuple(
        ss.GroundMotion(noise(4 * k + 1), dt=DT, transverse=noise(4 * k + 3), name=f"pair {k}")
        for k in range(PAIRS)
    )
    return [
        Case("sliding", 0.3, 0.0, pairs),
        Case("sliding, spring of 3 rad/s", 0.3, 3.0, pairs),
        Case("short slips", 2.0, 0.0, pairs),
    ]


def components(motion: ss.GroundMotion) -> tuple[np.ndarray, np.ndarray]:
    assert motion.transverse is not None
    return np.asarray(motion.acceleration), np.asarray(motion.transverse)


# ---- the peers: peak and final displacement [m]


def by_integrate(case: Case, motion: ss.GroundMotion) -> Answer:
    r = ss.integrate(case.slider, motion)
    return r.peak, r.residual


nb = peer("numba")

if nb:

    @nb.njit
    def return_mapping(n, t, dt, level, spring, steps):
        """The trapezoidal rule; friction shrinks the velocity vector of a trial without it."""
        h = dt / steps
        soft = 0.25 * spring * h * h
        x = y = vx = vy = peak = 0.0
        for i in range(len(n) - 1):
            for k in range(steps):
                part = (k + 0.5) / steps
                tx = (1 - soft) * vx - h * (n[i] + part * (n[i + 1] - n[i]) + spring * x)
                ty = (1 - soft) * vy - h * (t[i] + part * (t[i + 1] - t[i]) + spring * y)
                trial = math.sqrt(tx * tx + ty * ty)
                left = 0.0
                if trial > h * level:
                    left = (trial - h * level) / (trial * (1 + soft))
                x += 0.5 * h * (vx + left * tx)
                y += 0.5 * h * (vy + left * ty)
                vx, vy = left * tx, left * ty
                peak = max(peak, x * x + y * y)
        return math.sqrt(peak), x, y


def by_return_mapping(steps: int | None, case: Case, motion: ss.GroundMotion) -> Answer:
    """With as many steps a sample, or as many as the refined one needs."""
    count = refined(case, motion) if steps is None else steps
    n, t = components(motion)
    peak, x, y = return_mapping(n, t, DT, case.level, case.frequency**2, count)
    return peak, np.array([x, y])


@cache
def refined(case: Case, motion: ss.GroundMotion) -> int:
    """Steps a sample, doubled until the error of the peak is at most REFINED."""
    exact, _ = by_integrate(case, motion)
    steps = 1
    while steps < 2**17 and abs(by_return_mapping(steps, case, motion)[0] / exact - 1) > REFINED:
        steps *= 2
    return steps


def by_solve_ivp(solve_ivp, rtol: float, case: Case, motion: ss.GroundMotion) -> Answer:
    """Slip by slip, no step longer than a sample; a breakaway is found in closed form.

    A slip begins with twice the speed AT_REST and ends at that speed; if the load exceeds the level
    there, another begins.
    """
    n, t = components(motion)
    end, last = motion.duration, len(n) - 2
    loads = -np.column_stack([n, t])
    px, py = loads[:, 0].tolist(), loads[:, 1].tolist()
    a, spring, hypot = case.level, case.frequency**2, math.hypot

    def pull(time, x, y):
        i = min(int(time / DT), last)
        u = time / DT - i
        return (
            px[i] + u * (px[i + 1] - px[i]) - spring * x,
            py[i] + u * (py[i + 1] - py[i]) - spring * y,
        )

    def slips(time, state):
        x, y, vx, vy = state
        qx, qy = pull(time, x, y)
        speed = hypot(vx, vy) or 1e-300
        return vx, vy, qx - a * vx / speed, qy - a * vy / speed

    def stopped(time, state):
        return hypot(state[2], state[3]) - AT_REST

    def turning(time, state):  # the distance from the origin is largest there
        return state[0] * state[2] + state[1] * state[3]

    stopped.terminal, stopped.direction = True, -1.0
    turning.direction = -1.0

    def breakaway(begin, x, y):
        """The time at which the load leaves the circle of friction; inf for never."""
        if hypot(*pull(begin, x, y)) > a * (1 + 1e-12):
            return begin
        outside = np.hypot(*(loads - spring * np.array([x, y])).T) > a
        after = int(begin / DT) + 1
        found = np.flatnonzero(outside[after:])
        if not len(found):
            return math.inf
        i = after + int(found[0])
        since = max(begin, (i - 1) * DT)
        q0, q1 = (np.array(pull(one, x, y)) for one in (since, i * DT))
        d = q1 - q0  # |q0 + u d|^2 = a^2
        half, over = q0 @ d, max(a * a - q0 @ q0, 0.0)
        root = math.sqrt(half * half + d @ d * over)
        u = over / (half + root) if half > 0 else (root - half) / (d @ d)
        return since + u * (i * DT - since)

    time, x, y, peak = 0.0, 0.0, 0.0, 0.0
    while True:
        time = breakaway(time, x, y)
        if time >= end:
            return peak, np.array([x, y])
        r = solve_ivp(
            slips,
            (time, end),
            (x, y, *(2 * AT_REST * q / a for q in pull(time, x, y))),  # along the load
            method="DOP853",
            events=(stopped, turning),
            rtol=rtol,
            atol=1e-3 * rtol,
            max_step=DT,
            first_step=min(DT, end - time) / 100,
        )
        time, x, y = r.t[-1], float(r.y[0, -1]), float(r.y[1, -1])
        far = [r.y[:2, -1], *(state[:2] for state in r.y_events[1])]
        peak = max(peak, *(hypot(*place) for place in far))


def by_opensees(ops, steps: int, yields: float, case: Case, motion: ss.GroundMotion) -> Answer:
    """Newmark's average acceleration; a stiff vertical spring carries the weight."""
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    ops.node(1, 0.0, 0.0, 0.0)
    ops.node(2, 0.0, 0.0, 0.0)
    ops.fix(1, *(1,) * 6)
    ops.fix(2, 0, 0, 0, 1, 1, 1)
    ops.mass(2, 1.0, 1.0, 1.0, *(1e-6,) * 3)
    wv = 2 * math.pi * 100
    ops.uniaxialMaterial("Elastic", 1, wv**2, wv)
    ops.uniaxialMaterial("Elastic", 2, 1.0)
    ops.frictionModel("Coulomb", 1, case.level / G)
    sections = ("-P", 1, "-T", 2, "-My", 2, "-Mz", 2)
    axes = ("-orient", 0, 0, 1, 1, 0, 0)  # the axis of the bearing points up
    ops.element("flatSliderBearing", 1, 1, 2, 1, case.level / yields, *sections, *axes)
    if case.frequency:
        ops.uniaxialMaterial("Elastic", 3, case.frequency**2)
        ops.element("zeroLength", 2, 1, 2, "-mat", 3, 3, "-dir", 1, 2)

    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    ops.load(2, 0.0, 0.0, -G, 0.0, 0.0, 0.0)
    prepare(ops, "Static", "LoadControl", 1.0)
    ops.analyze(1)
    ops.loadConst("-time", 0.0)
    ops.wipeAnalysis()
    prepare(ops, "Transient", *AVERAGE_ACCELERATION)
    return shake(ops, 2, components(motion), DT, steps, axes=2)


def peers() -> dict[str, Callable[[Case, ss.GroundMotion], Answer]]:
    found: dict[str, Callable[[Case, ss.GroundMotion], Answer]] = {OURS: by_integrate}
    if nb:
        found["numba, return mapping, 1 a sample"] = partial(by_return_mapping, 1)
        found["numba, return mapping, refined"] = partial(by_return_mapping, None)
    if scipy := peer("scipy.integrate"):
        for rtol in TOLERANCES:
            found[f"solve_ivp DOP853, rtol {rtol:g}"] = partial(by_solve_ivp, scipy.solve_ivp, rtol)
    if ops := peer("openseespy.opensees"):
        for steps, yields in STEPS:
            found[f"OpenSees, {steps} a sample, yield {1000 * yields:g} mm"] = partial(
                by_opensees, ops, steps, yields
            )
    return found


# ---- errors


def check(found: dict[str, Errors]) -> None:
    """Refined return mapping and solve_ivp agree in every pair; OpenSees comes nearer."""
    medians = []
    for name, here in found.items():
        if name.endswith("refined"):
            worst, limit = float(here.peak.max()), 2 * REFINED
        elif name.startswith("solve_ivp"):
            worst, limit = here.largest, 2e-4
        elif name.startswith("OpenSees"):
            medians.append(float(np.nanmedian(here.peak)))
            continue
        else:
            worst, limit = float(here.peak.max()), 0.1
        if not worst <= limit:
            sys.exit(f"wrong answer: {name}: {worst:.3g} of the peak")
    if medians != sorted(medians, reverse=True) or not medians[-1:] <= [0.02]:
        sys.exit(f"wrong answer: OpenSees, medians {medians} of the peak")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--check", action="store_true", help="answers alone")
    asked = parser.parse_args()
    print(machine())
    print(versions("numpy", "numba", "scipy"))
    installed = metadata.version("openseespy") if peer("openseespy.opensees") else "not installed"
    print(f"openseespy {installed}")
    for case in cases():
        heading = "errors [% of the peak]: peak median, largest; final median, largest"
        print(f"\n{case.name}: {heading}")
        programs = {name: partial(answer, case) for name, answer in peers().items()}
        check(all_errors(programs, case.motions))
        if nb:
            print(
                "refined: ", *(refined(case, motion) for motion in case.motions), "steps a sample"
            )
        if asked.check:
            continue
        print_times(times(programs, case.motions[:1], asked.rounds, repeats=20))


if __name__ == "__main__":
    main()
