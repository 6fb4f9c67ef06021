"""Newmark's block under pySLAMMER's records: its displacements and run times against ours.

pySLAMMER's RigidAnalysis steps from sample to sample: at each, the block slides if it moves or the
ground acceleration exceeds the yield acceleration; velocity and displacement follow by the
trapezoidal rule. A slip that begins or ends between two samples is taken to do so at one of them:
- it begins late by up to one sample, and its first step gets the mean of nothing and the net
  acceleration at the sample: too much;
- it ends where the trapezoidal velocity first comes out negative, and that last piece is left out;
- the displacement is a trapezoid of the velocity, ours a cubic.
In all these the error goes with the step: halve it (--finer 2) and it falls.
"""

from __future__ import annotations

import argparse
import math
import sys
from functools import partial

import numpy as np
import stickslip as ss
from measure import Timing, machine, peer, take_turns, versions

YIELD = (0.02, 0.05, 0.1, 0.2, 0.3)  # [g]


def finer(samples: np.ndarray, parts: int) -> np.ndarray:
    """The same motion with each segment divided into this many parts."""
    at = np.arange((len(samples) - 1) * parts + 1) / parts
    return np.interp(at, np.arange(len(samples)), samples)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--finer", type=int, default=1, help="pySLAMMER's steps in a sample")
    parser.add_argument("--rounds", type=int, default=3)
    args = parser.parse_args()
    slam = peer("pyslammer")
    if slam is None:
        sys.exit("not installed: pyslammer")
    print(machine())
    print(versions("numpy", "pyslammer"))
    print("displacement [cm]: stickslip, one-way; pySLAMMER; difference, relative")
    print(f"{'':34}" + "".join(f"{f'ky = {ky:g} g':>26}" for ky in YIELD))

    differences: dict[float, list[float]] = {ky: [] for ky in YIELD}
    ours_times, its_times = [], []
    for name, record in sorted(slam.sample_ground_motions().items()):
        ground = record
        if args.finer > 1:
            ground = slam.GroundMotion(finer(record.accel, args.finer), record.dt / args.finer)
        # Its positive direction of sliding is opposite to ours.
        motion = ss.GroundMotion(-ss.STANDARD_GRAVITY * record.accel, dt=record.dt, name=name)
        row = f"{name:34}"
        for ky in YIELD:
            law = ss.Coulomb(slip_level=ky * ss.STANDARD_GRAVITY, backward=math.inf)
            slide = partial(ss.integrate, law, motion)
            analyze = partial(slam.RigidAnalysis, ky, ground)
            r, its = slide(), analyze().max_sliding_disp
            if not abs(r.energy.imbalance) <= 1e-11 * r.energy.dissipated:
                sys.exit(f"wrong answer: {name}, ky = {ky}: energy {r.energy.imbalance}")
            timings = take_turns(
                {"ours": (slide, len(record.accel)), "its": (analyze, len(ground.accel))},
                args.rounds,
            )
            ours_times += timings["ours"].times
            its_times += timings["its"].times
            apart = ""
            if r.residual > 1e-5:  # below 0.01 mm ratios say nothing
                differences[ky].append(its / r.residual - 1)
                apart = f"{100 * differences[ky][-1]:+.1f}%"
            row += f"{100 * r.residual:9.3f}{100 * its:9.3f}{apart:>8}"
        print(row)

    for title, of in (("median", np.median), ("largest", np.max)):
        row = "".join(f"{f'{100 * of(np.abs(d)):.2f}%':>26}" for d in differences.values())
        print(f"{f'{title} difference':34}{row}")
    ours, its = Timing(ours_times), Timing(its_times)
    print(f"ns of processor time a sample: stickslip {ours.median:.1f}, pySLAMMER {its.median:.1f}")


if __name__ == "__main__":
    main()
