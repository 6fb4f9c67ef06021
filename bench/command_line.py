"""Run time of the command line: reading and sliding a record, including the start of Python."""

from __future__ import annotations

import argparse
import json
import math
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import stickslip as ss
from measure import UNRELIABLE, Timing, bar, machine, peer, take_turns

SAMPLES = 20_000
MU = (0.1, 0.2, 0.3)


def write_record(file: Path) -> None:
    """A tremor of 100 s at 200 Hz that swells and dies down, as two columns."""
    t = np.arange(SAMPLES) * 0.005
    tones = np.random.default_rng(1).uniform(0, 2 * math.pi, 40)
    n = sum(np.cos((2 + 1.3 * k) * t + phase) for k, phase in enumerate(tones))
    n *= 0.1 * t * np.exp(1 - t / 10) / 10
    lines = (f"{a:.3f},{b:.7f}\n" for a, b in zip(t, n))
    file.write_text("Time (s),Acceleration (g)\n" + "".join(lines))


def command(record: Path, *more: str) -> list[str]:
    return [sys.executable, "-m", "stickslip", "slide", str(record), "--mu", *map(str, MU), *more]


def check(record: Path, *more: str) -> None:
    """Check that the command gives the result of the library."""
    ran = subprocess.run(
        command(record, *more, "--json"), check=True, capture_output=True, text=True
    )
    motion = ss.read_record(record, **({"units": more[1]} if more else {}))
    for mu, row in zip(MU, json.loads(ran.stdout)["results"], strict=True):
        peak = ss.integrate(ss.Coulomb(mu=mu), motion, settle=True).peak
        if row["peak_m"] != peak or not peak > 0:
            sys.exit(f"wrong answer: {record.name}, mu = {mu}: {row['peak_m']}, not {peak}")


def seconds_of_command(runs: int, record: Path | None = None, *more: str) -> Timing:
    """Whole processes, by the clock on the wall [s]; the record written here if none is given."""
    with tempfile.TemporaryDirectory() as folder:
        if record is None:
            record = Path(folder) / "tremor.csv"
            write_record(record)
        check(record, *more)
        return wall(command(record, *more), runs)


def wall(arguments: list[str], runs: int) -> Timing:
    work = lambda: subprocess.run(arguments, check=True, stdout=subprocess.DEVNULL)  # noqa: E731
    timing = take_turns({"": (work, 1)}, runs, time.perf_counter_ns)[""]
    return Timing([t * 1e-9 for t in timing.times])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=10)
    args = parser.parse_args()
    print(machine())
    print(f"seconds from start to exit, median and spread of {args.runs} runs")

    rows = {
        "python -c pass": wall([sys.executable, "-c", "pass"], args.runs),
        "python -c 'import numpy'": wall([sys.executable, "-c", "import numpy"], args.runs),
        f"slide: a tremor of {SAMPLES} samples": seconds_of_command(args.runs),
    }
    slam = peer("pyslammer")
    if slam:
        folder = Path(slam.__file__).parent / "sample_ground_motions"
        record = min(folder.glob("Kobe*.csv"), default=None)
        if record:
            rows[f"slide: {record.stem}"] = seconds_of_command(args.runs, record, "--units", "g")
    else:
        print("not installed: pyslammer, whose records are left out")
    for name, t in rows.items():
        flag = " " if t.reliable else "!"
        print(f"  {name:42} {t.median:6.3f} {100 * t.spread:5.0f}%{flag} least {min(t.times):6.3f}")
    if not all(t.reliable for t in rows.values()):
        print(UNRELIABLE)
    print("bars")
    for name, t in rows.items():
        if name.startswith("slide"):
            print(bar(name, t.median, 0.3))


if __name__ == "__main__":
    main()
