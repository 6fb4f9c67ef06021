"""Pendulums with several surfaces, against OpenSees.

    pip install openseespy
    python bench/pendulums.py [--check] [--rounds N]

The triple pendulum of OpenSees' example 3 under pySLAMMER's 18 records: `integrate`, its time a
sample and a change of the moving surfaces, and a sweep of 100 bearings, both polarities. Beside it
OpenSees' `TripleFrictionPendulum` at three yield displacements, with its errors. Answers are
checked before they are timed.
"""

from __future__ import annotations

import argparse
import statistics
import time
from importlib import metadata

import numpy as np
import stickslip as ss
from measure import machine, peer, versions
from opensees import AVERAGE_ACCELERATION, prepare, shake

G = ss.STANDARD_GRAVITY
RADII, MU, CAPACITIES = [0.3937, 3.7465, 3.7465], [0.01, 0.04, 0.08], [0.0716, 0.5043, 0.5043]
ISOLATOR = ss.TriplePendulum(RADII, MU, CAPACITIES)
YIELDS = ((4, 1e-3), (10, 0.5e-3), (20, 0.25e-3))  # steps a sample, yield displacement [m]


def by_opensees(ops, motion: ss.GroundMotion, steps: int, yields: float) -> tuple[float, float]:
    """Peak and final displacement [m]; unit mass, Newmark's average acceleration."""
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    for node in (1, 2):
        ops.node(node, 0.0, 0.0, 0.0)
    ops.fix(1, *[1] * 6)
    ops.fix(2, 0, 1, 0, 1, 1, 1)
    ops.mass(2, 1.0, 1.0, 1.0, 1e-6, 1e-6, 1e-6)
    for k, mu in enumerate(MU):
        ops.frictionModel("Coulomb", k + 1, mu)
    vertical = (2 * np.pi * 100) ** 2
    ops.uniaxialMaterial("Elastic", 1, vertical)
    for k in (2, 3, 4):
        ops.uniaxialMaterial("Elastic", k, 1.0)
    ops.element(
        "TripleFrictionPendulum", 1, 1, 2, 1, 2, 3, 1, 2, 3, 4,
        *RADII, *CAPACITIES, G, yields, 10 * vertical, 0.01, 1e-6,
    )  # fmt: skip
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    ops.load(2, 0.0, 0.0, -G, 0.0, 0.0, 0.0)

    solver = {"test": ("NormDispIncr", 1e-10, 100), "algorithm": "KrylovNewton"}
    prepare(ops, "Static", "LoadControl", 0.1, **solver)
    if ops.analyze(10) != 0:
        return float("nan"), float("nan")
    ops.loadConst("-time", 0.0)
    ops.wipeAnalysis()
    prepare(ops, "Transient", *AVERAGE_ACCELERATION, **solver)
    return shake(ops, 2, [motion.acceleration], motion.dt, steps)


def seconds(work) -> float:
    begin = time.process_time()
    work()
    return time.process_time() - begin


def check(records: list[ss.GroundMotion]) -> None:
    for record in records:
        r = ss.integrate(ISOLATOR, record)
        assert abs(r.energy.imbalance) <= 1e-12 * r.energy.input, record.name
        finer = np.interp(
            np.linspace(0, record.duration, 3 * len(record.time) - 2),
            record.time,
            record.acceleration,
        )
        again = ss.integrate(ISOLATOR, ss.GroundMotion(finer, dt=record.dt / 3))
        assert abs(again.peak - r.peak) <= 1e-12 * r.peak, record.name


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("--check", action="store_true", help="only check the answers")
    parser.add_argument("--rounds", type=int, default=5)
    args = parser.parse_args()
    records = list(ss.sample_records())
    check(records)
    if args.check:
        return
    print(machine())
    print(versions("numpy"))
    samples = sum(len(r.acceleration) for r in records)

    def all_records() -> None:
        for record in records:
            ss.integrate(ISOLATOR, record)

    ours = statistics.median(seconds(all_records) for _ in range(args.rounds))
    changes = sum(int(ss.integrate(ISOLATOR, r).elements.slides.sum()) for r in records)
    print(f"integrate: {1e9 * ours / samples:.0f} ns per sample, 18 records, {changes} slides")
    block = ss.FrictionPendulum(radius=7.493, mu=0.06)
    plain = statistics.median(
        seconds(lambda: [ss.integrate(block, r) for r in records]) for _ in range(args.rounds)
    )
    print(f"a single pendulum: {1e9 * plain / samples:.0f} ns per sample")
    many = [
        ss.TriplePendulum(RADII, [MU[0], 0.04 + 2e-4 * k, 0.08 + 4e-4 * k], CAPACITIES)
        for k in range(100)
    ]
    swept = seconds(lambda: ss.sweep(many, records, threads=1))
    print(f"sweep of 100 bearings x 18 records x 2 polarities: {swept:.2f} s")
    ops = peer("openseespy.opensees")
    if not ops:
        print("openseespy is not installed")
        return
    print(f"openseespy {metadata.version('openseespy')}")
    # Its element has no last stop.
    chosen = [r for r in records if not len(ss.integrate(ISOLATOR, r).impacts)]
    exact = [ss.integrate(ISOLATOR, r) for r in chosen]
    mine = seconds(lambda: [ss.integrate(ISOLATOR, r) for r in chosen])
    for steps, yields in YIELDS:
        begin = time.process_time()
        found = [by_opensees(ops, r, steps, yields) for r in chosen]
        took = time.process_time() - begin
        errors = [100 * abs(p / r.peak - 1) for (p, _), r in zip(found, exact, strict=True)]
        ends = [100 * abs(x - r.residual) / r.peak for (_, x), r in zip(found, exact, strict=True)]
        print(
            f"OpenSees, {len(chosen)} records, {steps} steps a sample, yield {1e3 * yields:g} mm:"
            f" peak off by {np.nanmedian(errors):.2g} % in the median, {np.nanmax(errors):.2g} % at"
            f" most; end by {np.nanmedian(ends):.2g} and {np.nanmax(ends):.2g} % of the peak;"
            f" {np.isnan(errors).sum()} did not converge; {took / mine:,.0f} times our time"
        )


if __name__ == "__main__":
    main()
