"""A flat slider with friction that depends on speed, and one under vertical motion, against peers.

    pip install scipy openseespy
    python bench/contact.py [--rounds N] [--check]

`integrate` beside `solve_ivp` (DOP853, with events) and OpenSees (`flatSliderBearing` with the
friction models `VelDependent` and `Coulomb`), on the 18 sample records: errors of peak and final
displacement, and times of two of the records, in turns. Every answer is checked before it is timed.
"""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from importlib import metadata

import numpy as np
import stickslip as ss
from accuracy import OURS, Answer, Errors, all_errors, print_times, times
from measure import machine, peer, versions
from opensees import AVERAGE_ACCELERATION, prepare, shake

G = ss.STANDARD_GRAVITY
TIMED = ("Kobe", "PAC")
TOLERANCES = (1e-8, 1e-10)  # of solve_ivp
STEPS = ((1, 1e-3), (10, 1e-4), (40, 1e-5))  # of OpenSees: steps a sample, yield displacement [m]


@dataclass(frozen=True)
class Case:
    """A flat slider and its ground motions."""

    name: str
    mu_slow: float
    mu_fast: float
    rate: float  # [s/m]
    motions: tuple[ss.GroundMotion, ...]

    @property
    def law(self) -> ss.VelocityDependent | ss.Coulomb:
        if self.mu_slow == self.mu_fast:
            return ss.Coulomb(mu=self.mu_fast)
        return ss.VelocityDependent(mu_slow=self.mu_slow, mu_fast=self.mu_fast, rate=self.rate)


def with_vertical(motion: ss.GroundMotion) -> ss.GroundMotion:
    """The same record backward in time, times 2/3, as the vertical component: N stays positive."""
    vertical = np.asarray(motion.acceleration)[::-1] * (2 / 3)
    return ss.GroundMotion(motion.acceleration, dt=motion.dt, vertical=vertical, name=motion.name)


def cases() -> list[Case]:
    records = tuple(ss.sample_records())
    return [
        Case("speed-dependent, PTFE", 0.085, 0.163, 0.77 / 0.0254, records),
        Case("constant, vertical", 0.1, 0.1, 0.0, tuple(map(with_vertical, records))),
    ]


# ---- the peers: peak and final displacement [m]


def by_integrate(case: Case, motion: ss.GroundMotion) -> Answer:
    r = ss.integrate(case.law, motion)
    return r.peak, r.residual


def by_solve_ivp(solve_ivp, case: Case, motion: ss.GroundMotion, rtol: float) -> Answer:
    """Slip by slip, no step longer than a sample; a breakaway is found in closed form."""
    dt, times = motion.dt, np.asarray(motion.time)
    load = -np.asarray(motion.acceleration)
    normal = G + (np.zeros(len(load)) if motion.vertical is None else np.asarray(motion.vertical))
    over = np.stack([load - case.mu_slow * normal, -load - case.mu_slow * normal])
    slow, fast, rate = case.mu_slow, case.mu_fast, case.rate
    loads, normals, last, exp = load.tolist(), normal.tolist(), len(load) - 2, math.exp

    def slips(t, y, s):
        i = min(int(t / dt), last)
        u = t / dt - i
        p = loads[i] + u * (loads[i + 1] - loads[i])
        n = normals[i] + u * (normals[i + 1] - normals[i])
        return y[1], p - s * n * (fast - (fast - slow) * exp(-rate * abs(y[1])))

    def stopped(t, y, s):
        return s * y[1]

    stopped.terminal, stopped.direction = True, -1.0

    def breakaway(t: float) -> tuple[float, float]:
        """Time and direction of the next one; inf for none."""
        now = [np.interp(t, times, row) for row in over]
        for s, excess in zip((1.0, -1.0), now):
            if excess > 1e-9:
                return t, s
        first = (math.inf, 0.0)
        for s, row in zip((1.0, -1.0), over):
            later = np.flatnonzero((times > t) & (row > 0))
            if len(later):
                i = later[0]
                begin = max(times[i - 1], t)
                below = min(np.interp(begin, times, row), 0.0)
                at = begin + (times[i] - begin) * below / (below - row[i])
                first = min(first, (at, s))
        return first

    t = x = peak = 0.0
    while True:
        t, s = breakaway(t)
        if t >= times[-1]:
            return peak, x
        r = solve_ivp(
            slips,
            (t, times[-1]),
            (x, 0.0),
            method="DOP853",
            events=stopped,
            rtol=rtol,
            atol=1e-3 * rtol,
            max_step=dt,
            first_step=min(dt, times[-1] - t) / 100,
            args=(s,),
        )
        t, x = r.t[-1], float(r.y[0, -1])
        peak = max(peak, abs(x))


def by_opensees(ops, case: Case, motion: ss.GroundMotion, steps: int, yields: float) -> Answer:
    """Newmark's average acceleration; the vertical spring, 100 Hz, carries the weight."""
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.node(1, 0.0, 0.0)
    ops.node(2, 0.0, 0.0)
    ops.fix(1, 1, 1, 1)
    ops.fix(2, 0, 0, 1)
    ops.mass(2, 1.0, 1.0, 1e-6)
    wv = 2 * math.pi * 100
    ops.uniaxialMaterial("Elastic", 1, wv**2, wv)  # half critically damped, N without ringing
    ops.uniaxialMaterial("Elastic", 2, 1.0)
    if case.mu_slow == case.mu_fast:
        ops.frictionModel("Coulomb", 1, case.mu_fast)
    else:
        ops.frictionModel("VelDependent", 1, case.mu_slow, case.mu_fast, case.rate)
    stiff = case.mu_fast * G / yields
    axes = ("-orient", 0, 1, 0, -1, 0, 0)
    ops.element("flatSliderBearing", 1, 1, 2, 1, stiff, "-P", 1, "-Mz", 2, *axes)

    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    ops.load(2, 0.0, -G, 0.0)
    prepare(ops, "Static", "LoadControl", 1.0)
    ops.analyze(1)
    ops.loadConst("-time", 0.0)
    ops.wipeAnalysis()
    components = [motion.acceleration] + [motion.vertical] * (motion.vertical is not None)
    prepare(ops, "Transient", *AVERAGE_ACCELERATION)
    return shake(ops, 2, components, motion.dt, steps)


def peers() -> dict[str, Callable[[Case, ss.GroundMotion], Answer]]:
    found: dict[str, Callable[[Case, ss.GroundMotion], Answer]] = {OURS: by_integrate}
    if scipy := peer("scipy.integrate"):
        for rtol in TOLERANCES:
            found[f"solve_ivp DOP853, rtol {rtol:g}"] = lambda case, motion, rtol=rtol: (
                by_solve_ivp(scipy.solve_ivp, case, motion, rtol)
            )
    if ops := peer("openseespy.opensees"):
        for steps, yields in STEPS:
            found[f"OpenSees, {steps} a sample, yield {1000 * yields:g} mm"] = (
                lambda case, motion, steps=steps, yields=yields: by_opensees(
                    ops, case, motion, steps, yields
                )
            )
    return found


# ---- errors


def check(found: dict[str, Errors]) -> None:
    """solve_ivp agrees in every record, across the kinks at the samples; OpenSees comes nearer."""
    medians = []
    for name, here in found.items():
        if name.startswith("solve_ivp"):
            if not here.largest <= 2e-5:
                sys.exit(f"wrong answer: {name}: {here.largest:.3g} of the peak")
        else:
            medians.append(float(np.nanmedian(here.peak)))
    if medians != sorted(medians, reverse=True) or not medians[-1:] <= [0.02]:
        sys.exit(f"wrong answer: OpenSees, medians {medians} of the peak")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--check", action="store_true", help="answers alone")
    asked = parser.parse_args()
    print(machine())
    print(versions("numpy", "scipy"))
    installed = metadata.version("openseespy") if peer("openseespy.opensees") else "not installed"
    print(f"openseespy {installed}")
    for case in cases():
        heading = "errors [% of the peak]: peak median, largest; final median, largest"
        print(f"\n{case.name}: {heading}")
        programs = {name: partial(answer, case) for name, answer in peers().items()}
        check(all_errors(programs, case.motions))
        if asked.check:
            continue
        timed = [m for m in case.motions if any(word in m.name for word in TIMED)]
        assert len(timed) == len(TIMED)
        print_times(times(programs, timed, asked.rounds, repeats=200))


if __name__ == "__main__":
    main()
