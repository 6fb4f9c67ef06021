"""Ensembles: the cost of a sample of a random motion, here and with the alternatives.

The motion's making and the statistics over the members are part of it. Every answer is checked
before it is timed. Peers that are not installed are left out and named.
"""

from __future__ import annotations

import argparse
import json
import math
import subprocess
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from types import ModuleType

import numpy as np
import peers
import stickslip as ss
from measure import UNRELIABLE, Timing, bar, machine, peer, take_turns, versions

# All as in ensemble.cpp.
MEMBERS, SEED, DT = 1000, 1, 0.1
SAMPLES, S0, LOW, HIGH = 1024, 1.0, 20 / math.pi**2, 40 / math.pi**2  # thesis figures 4.4 to 4.6
SLIP_LEVEL = REACH = 1.0
RATE, HALF_WIDTH, SIGMA, DURATION = 3.0, 1 / 6, 2.5, 60.0
PULSES_LEVEL, PULSES_TIMES = 0.2 * ss.STANDARD_GRAVITY, 601

CHECKED = 20_000  # members
# heyoka gets the first records only: lanes that are many need few calls from Python, and this
# tolerance is the loosest that leaves its error well under 1e-9.
RECORDS, LANES, TOLERANCE = 256, 64, 1e-11

OURS, WITH_SPECTRUM = "stickslip", "stickslip, velocity spectrum as well"
NUMBA, HEYOKA, BARE = "numba", "heyoka, batches", "heyoka, a bare step of 0.1 s"
TITLES = {
    "Coulomb": "Coulomb, Gaussian: ns per sample",
    "Caster": "Caster, Gaussian: ns per sample",
    "Pulses": "Coulomb, pulses: ns per step",
}

Works = dict[str, tuple[Callable[[], object], int]]


def require(what: str, found: float, allowed: float) -> None:
    if not found <= allowed:
        sys.exit(f"wrong answer: {what}: {found:.3g}, allowed {allowed:.3g}")


def band() -> tuple[int, np.ndarray]:
    """The first line in the band, and the amplitudes [m/s^2] of all.

    Corrected for the straight lines between samples.
    """
    spacing = 2 * math.pi / (SAMPLES * DT)
    k = np.arange(math.ceil(LOW / spacing), math.floor(HIGH / spacing) + 1)
    return int(k[0]), math.sqrt(S0 * spacing) / np.sinc(k / SAMPLES) ** 2


def ground_accelerations(count: int) -> np.ndarray:
    first, amplitudes = band()
    lines = np.zeros((count, SAMPLES // 2 + 1), complex)
    phases = np.random.default_rng(SEED).random((count, len(amplitudes)))
    lines[:, first : first + len(amplitudes)] = amplitudes * np.exp(2j * math.pi * phases)
    return np.fft.irfft(lines, SAMPLES, norm="forward")


# ---- the library


def ours(job: str, members: int, **options):
    slider, excitation = {
        "Coulomb": (ss.Coulomb(slip_level=SLIP_LEVEL), shaking),
        "Caster": (ss.Caster(slip_level=SLIP_LEVEL, reach=REACH), shaking),
        "Pulses": (ss.Coulomb(slip_level=PULSES_LEVEL), pulses),
    }[job]
    options = {"threads": 1, "velocity_spectrum": False} | options
    return ss.run_ensemble(slider, excitation(), members=members, seed=SEED, dt=DT, **options)


def shaking():
    spectrum = ss.Spectrum.band_pass(s0=S0, low=LOW, high=HIGH)
    return ss.GaussianExcitation(spectrum, dt=DT, samples=SAMPLES)


def pulses():
    return ss.PoissonPulses(rate=RATE, half_width=HALF_WIDTH, sigma=SIGMA, duration=DURATION)


def check_caster() -> None:
    e = ours("Caster", 64)
    caster = ss.Caster(slip_level=SLIP_LEVEL, reach=REACH)
    for member in range(64):
        r = ss.integrate(caster, shaking().sample(seed=SEED, member=member))
        require("caster: peak from integrate's [m]", abs(e.peak[member] - r.peak), 1e-9)
        require("caster: residual from integrate's [m]", abs(e.residual[member] - r.residual), 1e-9)


def check_moments(job: str, sums: np.ndarray) -> None:
    """Against a peer's sums over as many members.

    The seeds are fixed; five standard errors would fail one seed in 500.
    """
    e, n = ours(job, CHECKED), CHECKED
    x, v, xx, xv, vv = sums
    for name, theirs in (
        ("displacement_mean", x / n),
        ("velocity_mean", v / n),
        ("displacement_variance", (xx - x * x / n) / (n - 1)),
        ("covariance", (xv - x * v / n) / (n - 1)),
        ("velocity_variance", (vv - v * v / n) / (n - 1)),
    ):
        apart = np.abs(getattr(e, name) - theirs)
        error = math.sqrt(2) * getattr(e, name + "_error")
        moved = apart > 0
        worst = np.max(apart[moved] / error[moved])
        require(f"{job}: {name} from numba's, in combined standard errors", worst, 5)


# ---- the peers


class Run:
    """Each job's works, with errors where there are any."""

    def __init__(self, peers_alone: bool):
        self.peers_alone = peers_alone
        self.works: dict[str, Works] = {job: {} for job in TITLES}
        self.errors: dict[str, float] = {}  # of the caster [m]

    def add_ours(self, steps: int) -> None:
        check_caster()
        for job in TITLES:
            items = steps if job == "Pulses" else MEMBERS * SAMPLES
            self.works[job][OURS] = partial(ours, job, MEMBERS), items
            work = partial(ours, job, MEMBERS, velocity_spectrum=True)
            self.works[job][WITH_SPECTRUM] = work, items

    def add_numba(self) -> None:
        random = np.random.default_rng(SEED)
        loop = partial(peers.numba_ensemble, random, *band(), SAMPLES, DT, SLIP_LEVEL)
        parts = [loop(CHECKED // 20) for _ in range(20)]
        # Over the central half, thesis 4.4, against 100,000 records of an independent program
        # (values.json, mc.fig44.pre2).
        variances = [np.mean(p[4, SAMPLES // 4 : SAMPLES * 3 // 4]) * 20 / CHECKED for p in parts]
        sigma = math.sqrt(np.mean(variances))
        error = np.std(variances, ddof=1) / math.sqrt(20) / (2 * sigma)
        apart = abs(sigma - 0.5970844) / math.hypot(error, 0.0002085)
        require("numba: deviation of the velocity, in combined standard errors", apart, 3)
        if not self.peers_alone:
            check_moments("Coulomb", sum(parts))
        self.works["Coulomb"][NUMBA] = partial(loop, MEMBERS), MEMBERS * SAMPLES

        loop = partial(
            peers.numba_pulses, random, RATE, HALF_WIDTH, SIGMA, DT, PULSES_TIMES, PULSES_LEVEL
        )
        sums, steps = loop(CHECKED)
        if not self.peers_alone:
            check_moments("Pulses", sums)
        self.works["Pulses"][NUMBA] = partial(loop, MEMBERS), self.steps(steps / CHECKED)

    def steps(self, each: float | None = None) -> int:
        """Of a round: three for a pulse and one for a time of the statistics.

        All but those of the last pulses that come after the end.
        """
        if each is None:
            each = 3 * RATE * (DURATION - HALF_WIDTH) + PULSES_TIMES - 1
        return round(MEMBERS * each)

    def add_heyoka(self, hy: ModuleType) -> None:
        n = ground_accelerations(RECORDS)
        heyoka = peers.HeyokaBatch(hy, LANES, SLIP_LEVEL, REACH, TOLERANCE)
        caster = ss.Caster(slip_level=SLIP_LEVEL, reach=REACH)
        reference = [ss.integrate(caster, ss.GroundMotion(row, dt=DT)).displacement for row in n]
        x, _ = heyoka(n, DT)
        self.errors[HEYOKA] = float(np.max(np.abs(x - reference)))
        require("heyoka: x from integrate's [m]", self.errors[HEYOKA], 1e-9)

        def work():
            x, v = heyoka(n, DT)
            return [np.sum(moment, axis=0) for moment in (x, v, x * x, x * v, v * v)]

        self.works["Caster"][HEYOKA] = work, n.size
        steps = 200 * LANES
        self.works["Caster"][BARE] = partial(peers.heyoka_batch_steps, heyoka, steps), steps

    def time(self, rounds: int) -> dict[str, dict[str, Timing]]:
        """Time the compared works in turns; slow ones get fewer rounds."""
        return {
            job: take_turns(works, rounds if job != "Caster" else max(3, rounds // 3))
            for job, works in self.works.items()
            if works
        }


def compiled_figures(path: Path | None, rounds: int) -> dict | None:
    found = [path] if path else sorted(Path(__file__).parents[1].glob("build/**/bench/ensemble"))
    if not found:
        return None
    command = [found[0], "--json", "--rounds", str(rounds)]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def print_table(
    job: str, rows: dict[str, Timing], errors: dict[str, float], cpp: dict | None
) -> None:
    base = rows.get(OURS)
    print(f"\n{TITLES[job]:44} {'median':>9} {'spread':>7} {'ratio':>9}   error [m]")
    for row, timing in rows.items():
        ratio = f"{timing.ratio(base):9.3g}" if base else " " * 9
        error = f"{errors[row]:11.1e}" if row in errors and job == "Caster" else ""
        print(f"  {row:42} {timing} {ratio} {error}".rstrip())
    for row, figures in cpp["tables"][job]["rows"].items() if cpp else ():
        spread = f"{100 * figures['spread']:6.0f}%{' ' if figures['spread'] <= 0.1 else '!'}"
        ratio = f"{figures['median'] / base.median:9.3g}" if base else ""
        print(f"  {'C++: ' + row:42} {figures['median']:9.1f} {spread} {ratio}".rstrip())
    if not all(timing.reliable for timing in rows.values()):
        print(UNRELIABLE)


def print_bars(timings: dict[str, dict[str, Timing]], cpp: dict | None) -> None:
    print("\nbars")
    for job, other, claim, limit in (
        ("Coulomb", NUMBA, "Coulomb, Gaussian: numba / through Python", 5),
        ("Caster", HEYOKA, "caster, Gaussian: heyoka in batches / through Python", 25),
        ("Pulses", NUMBA, "Coulomb, pulses: numba / through Python", 5),
    ):
        rows = timings.get(job, {})
        if OURS in rows and other in rows:
            print(bar(claim, rows[other].ratio(rows[OURS]), limit, at_least=True))
    if cpp:
        rows = cpp["tables"]["Coulomb"]["rows"]
        loop = rows["plain loop with FFTW"]["ratio"]
        print(bar("Coulomb, Gaussian: C++ loop with FFTW / in C++", loop, 4, at_least=True))
        print(bar("Coulomb, Gaussian: in C++ [ns]", rows["run_ensemble"]["median"], 1.9))
        threads = 1 / cpp["tables"]["Threads"]["rows"]["2 threads"]["ratio"]
        print(bar("two threads / one, in C++", threads, 1.8, at_least=True))
        print(f"  {cpp['tables']['Threads']['note']}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cpp", type=Path, help="ensemble as CMake built it")
    parser.add_argument("--rounds", type=int, default=21)
    parser.add_argument("--peers", action="store_true", help="the peers alone")
    args = parser.parse_args()

    print(machine())
    print(versions("numpy", "numba", "heyoka"))
    compiled = None if args.peers else compiled_figures(args.cpp, args.rounds)
    if compiled:
        print(f"C++: {compiled['compiler']} {compiled['flags']}, commit {compiled['commit']}")
    elif not args.peers:
        print("C++: left out, for no build/**/bench/ensemble is there and no --cpp is given")
    print(
        f"{MEMBERS} members of {SAMPLES} samples (heyoka: {RECORDS}), dt = {DT} s; pulses:"
        f" {PULSES_TIMES} times\nns of processor time, over {args.rounds} rounds; ratio to"
        " stickslip through Python; answers checked"
    )
    run = Run(args.peers)
    if not args.peers:
        run.add_ours(run.steps())
    if peer("numba"):
        run.add_numba()
        if hy := peer("heyoka"):
            run.add_heyoka(hy)
    timings = run.time(args.rounds)
    for job, rows in timings.items():
        print_table(job, rows, run.errors, compiled)
    print_bars(timings, compiled)


if __name__ == "__main__":
    main()
