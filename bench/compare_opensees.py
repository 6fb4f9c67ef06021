"""A block with elastic stick, as in OpenSees, compared with the rigid-plastic one.

    pip install openseespy
    python bench/compare_opensees.py [--period 3] [--mu 0.1 0.2]

The stick is a spring that yields at mu g: `ElasticPP` in a `zeroLength` element, with Newmark's
average acceleration, undamped. Differences from `integrate` at the end of 18 records, where the
peak is above a centimeter: these are the tables of the guides for equipment and isolation.
"""

from __future__ import annotations

import argparse
import math
import time

import numpy as np
import openseespy.opensees as ops
import stickslip as ss
from opensees import AVERAGE_ACCELERATION, prepare, shake

CASES = ((1e-3, 1), (1e-3, 10), (1e-4, 10), (1e-4, 40), (1e-5, 10))  # yield [m], steps a sample


def slide(quake, level, yields, steps, stiffness):
    """Peak and final displacement [m]."""
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    ops.node(1, 0.0)
    ops.node(2, 0.0)
    ops.fix(1, 1)
    ops.mass(2, 1.0)
    ops.uniaxialMaterial("ElasticPP", 1, level / yields, yields)
    ops.element("zeroLength", 1, 1, 2, "-mat", 1, "-dir", 1)
    if stiffness > 0:
        ops.uniaxialMaterial("Elastic", 2, stiffness)
        ops.element("zeroLength", 2, 1, 2, "-mat", 2, "-dir", 1)
    prepare(ops, "Transient", *AVERAGE_ACCELERATION, test=("NormUnbalance", 1e-10, 50))
    peak, final = shake(ops, 2, [quake.acceleration], quake.dt, steps)
    if math.isnan(peak):
        raise RuntimeError(f"OpenSees: a step of {quake.name} did not converge")
    return peak, final


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--period", type=float, default=math.inf, help="of a spring [s]")
    parser.add_argument("--mu", type=float, nargs="+", default=[0.1, 0.2])
    args = parser.parse_args()
    wn = 2 * math.pi / args.period
    quakes = ss.sample_records()
    print("yield [mm], steps a sample, mu: peak median, largest; residual median, largest; ns")
    for yields, steps in CASES:
        for mu in args.mu:
            slider = ss.Slider(ss.Coulomb(mu=mu), natural_frequency=wn)
            peaks, residuals, taken, samples = [], [], 0.0, 0
            for quake in quakes:
                exact = ss.integrate(slider, quake)
                if exact.peak < 0.01:
                    continue
                began = time.process_time()
                peak, final = slide(quake, mu * ss.STANDARD_GRAVITY, yields, steps, wn**2)
                taken += time.process_time() - began
                samples += len(quake)
                peaks.append(abs(peak - exact.peak) / exact.peak)
                residuals.append(abs(final - exact.residual) / exact.peak)
            row = (100 * f(d) for d in (peaks, residuals) for f in (np.median, np.max))
            print(
                f"{1000 * yields:5g}{steps:4d}{mu:6g}",
                *(f"{p:7.1f} %" for p in row),
                f"{1e9 * taken / samples:9.0f}   ({len(peaks)} records)",
                flush=True,
            )


if __name__ == "__main__":
    main()
