"""A sweep of pySLAMMER's own records, against pySLAMMER; and suites: read, saved, opened.

`python bench/sweep.py`: displacements of 18 records at some yield accelerations, their difference
from pySLAMMER's and the time of both. `--files`: 2,133 files in PEER's AT2 format, 8,700 samples
each, 230 MB, read on two threads, saved and opened again.
"""

from __future__ import annotations

import argparse
import math
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import stickslip as ss
from measure import machine, peer, take_turns, versions

YIELD = (0.02, 0.05, 0.1, 0.2)  # [g]


def against_pyslammer(rounds: int) -> None:
    slam = peer("pyslammer")
    if slam is None:
        sys.exit("not installed: pyslammer")
    records = slam.sample_ground_motions()
    # Its positive direction of sliding is opposite to ours.
    suite = ss.Suite(
        ss.GroundMotion(-ss.STANDARD_GRAVITY * r.accel, dt=r.dt, name=name)
        for name, r in records.items()
    )
    blocks = ss.grid(ss.Coulomb, mu=YIELD, backward=math.inf)
    samples = len(YIELD) * sum(map(len, suite))

    def ours() -> np.ndarray:
        return ss.sweep(blocks, suite, polarity="recorded", settle=True, threads=1).peak[:, :, 0]

    def its() -> np.ndarray:
        return np.array(
            [
                [slam.RigidAnalysis(ky, record).max_sliding_disp for record in records.values()]
                for ky in YIELD
            ]
        )

    x, y = ours(), its()
    one = np.array([[ss.integrate(block, m, settle=True).peak for m in suite] for block in blocks])
    if not np.abs(x - one).max() <= 1e-12 * one.max():
        sys.exit(f"wrong answer: {np.abs(x - one).max()} m from integrate")
    print("difference of pySLAMMER, which steps from sample to sample, where it slides 0.1 mm [%]:")
    for ky, a, b in zip(YIELD, x, y):
        slides = a > 1e-4
        apart = 100 * np.abs(b[slides] / a[slides] - 1)
        print(f"  ky = {ky:g} g: median {np.median(apart):.2f}, most {apart.max():.1f}")
    hundred = ss.grid(ss.Coulomb, mu=np.arange(1, 101) / 100, backward=math.inf)
    many = 2 * len(hundred) * sum(map(len, suite))
    works = {
        "100 levels, both polarities": (
            lambda: ss.sweep(hundred, suite, settle=True, threads=1),
            many,
        ),
        "4 levels": (ours, samples),
        "pySLAMMER": (its, samples),
    }
    times = take_turns(works, rounds)
    print("ns of processor time a sample and level")
    for name, timing in times.items():
        print(f"  {name:28}{timing.median:10.3g}")
    base, *_, rival = times.values()
    print(f"  ratio {rival.ratio(base):.0f}")


def files() -> None:
    rng = np.random.default_rng(1)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        header = "PEER NGA STRONG MOTION DATABASE RECORD\nBench, {}, X, 90\n"
        units = "ACCELERATION TIME SERIES IN UNITS OF G\nNPTS=   8700, DT=   .0050 SEC\n"
        for i in range(2133):
            n = rng.normal(0, 0.1, 8700)
            n -= n.mean()
            rows = "\n".join("".join(f"{a:15.7E}" for a in row) for row in n.reshape(-1, 5))
            (folder / f"r{i:04}.AT2").write_text(header.format(i) + units + rows + "\n")
        size = sum(f.stat().st_size for f in folder.iterdir()) / 1e6

        def timed(what: str, work: Callable[[], ss.Suite]) -> ss.Suite:
            wall, own = time.perf_counter(), time.process_time()
            result = work()
            print(
                f"  {what:40} {time.perf_counter() - wall:6.2f} s,"
                f" of processors {time.process_time() - own:6.2f} s"
            )
            return result

        print(f"2,133 files, {size:.0f} MB")
        suite = timed("read, two threads", lambda: ss.Suite.read(folder, threads=2))
        timed("saved", lambda: suite.save(folder / "suite.h5") and suite)
        again = timed("opened", lambda: ss.Suite.open(folder / "suite.h5"))
        if again != suite:
            sys.exit("wrong answer: the suite that was opened is another")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--files", action="store_true", help="2,133 files instead")
    parser.add_argument("--rounds", type=int, default=3)
    args = parser.parse_args()
    print(machine())
    print(versions("numpy", "h5py" if args.files else "pyslammer"))
    files() if args.files else against_pyslammer(args.rounds)


if __name__ == "__main__":
    main()
