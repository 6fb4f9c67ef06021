"""One record of 100,000 samples: the cost of a sample, here and with the alternatives.

The answers are checked before they are timed, and each peer's largest error in x stands beside its
time. Peers that are not installed are left out and named. The ground accelerations are those of
long_record.cpp.
"""

from __future__ import annotations

import argparse
import json
import math
import subprocess
import sys
import warnings
from collections.abc import Callable
from functools import partial
from itertools import product
from pathlib import Path
from types import ModuleType

import numpy as np
import peers
import stickslip as ss
from command_line import SAMPLES as RECORD_SAMPLES
from command_line import seconds_of_command
from measure import UNRELIABLE, Timing, bar, machine, peer, take_turns, versions
from peers import DT, FREQUENCY, REACH, SLIP_LEVEL, Heyoka, heyoka_steps, long_double, scipy_slider

N = 100_000
DEVIATION = 2.0  # of the ground acceleration [m/s^2]


# ---- ground accelerations


def splitmix(seed: int, count: int) -> np.ndarray:
    """SplitMix64 (Steele, Lea & Flood 2014), as doubles from 0 to 1."""
    z = np.uint64(seed) + np.arange(1, count + 1, dtype=np.uint64) * np.uint64(0x9E3779B97F4A7C15)
    z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return ((z ^ (z >> np.uint64(31))) >> np.uint64(11)).astype(float) * 2.0**-53


def independent() -> np.ndarray:
    u = splitmix(1, 2 * N)
    return DEVIATION * np.sqrt(-2 * np.log(1 - u[::2])) * np.cos(2 * math.pi * u[1::2])


def band(low: float, high: float) -> np.ndarray:
    """Cosines of random phase, one at a random place in each of many strips of the band."""
    strips = 400
    u = splitmix(2, 2 * strips)
    n, t = np.zeros(N), np.arange(N) * DT
    for k in range(strips):
        omega = low + (high - low) * (k + u[2 * k]) / strips
        n += np.cos(omega * t + 2 * math.pi * u[2 * k + 1])
    return DEVIATION * math.sqrt(2 / strips) * n


def inputs() -> dict[str, np.ndarray]:
    return {
        "independent": independent(),
        "broad": band(0.5, 15),
        "narrow": band(20 / math.pi**2, 40 / math.pi**2),  # thesis (4.49)
    }


# ---- checks


def error(x: np.ndarray, reference: np.ndarray) -> float:
    """Largest, over the samples that both have [m]."""
    count = min(len(x), len(reference))
    return float(np.max(np.abs(x[:count] - reference[:count])))


def halved(n: np.ndarray) -> ss.GroundMotion:
    fine = np.empty(2 * len(n) - 1)
    fine[::2] = n
    fine[1::2] = n[:-1] + np.diff(n) / 2
    return ss.GroundMotion(fine, dt=DT / 2)


def require(what: str, found: float, allowed: float) -> None:
    if not found <= allowed:
        sys.exit(f"wrong answer: {what}: {found:.3g}, allowed {allowed:.3g}")


# ---- the run

SLIDERS = {
    "Coulomb": ss.Slider(ss.Coulomb(slip_level=SLIP_LEVEL)),
    "Coulomb, spring": ss.Slider(ss.Coulomb(slip_level=SLIP_LEVEL), natural_frequency=FREQUENCY),
    "Coulomb, one-way": ss.Slider(ss.Coulomb(slip_level=SLIP_LEVEL, backward=math.inf)),
    "Caster": ss.Slider(ss.Caster(slip_level=SLIP_LEVEL, reach=REACH)),
    "Caster, spring": ss.Slider(
        ss.Caster(slip_level=SLIP_LEVEL, reach=REACH), natural_frequency=FREQUENCY
    ),
}


# Those that peers solve too, with the spring's frequency.
SPRINGS = {"Coulomb": 0.0, "Coulomb, spring": FREQUENCY, "Caster": 0.0, "Caster, spring": FREQUENCY}

# Slow peers get the first samples only.
SCIPY_SAMPLES, HEYOKA_SAMPLES, PYSLAMMER_SAMPLES, REFERENCE_SAMPLES = 501, 5001, 20_000, 20_001

ACCOUNT = "numba, with events and energies"
BARE_STEP = "heyoka, a bare step of 0.1 s"
SAME_SAMPLES = "stickslip, the samples heyoka had"
IN_CPP = "integrate", "integrate, header-only"
PLAIN_LOOPS = {"": "plain loop", ", memory used again": "plain loop, arrays at hand"}
HISTORIES = "stickslip.histories: x and v alone"
QUICK = ("stickslip", HISTORIES, "numba", ACCOUNT)

Works = dict[str, tuple[Callable[[], object], int]]


def compiled_figures(path: Path | None, rounds: int) -> dict | None:
    found = [path] if path else sorted(Path(__file__).parents[1].glob("build/**/bench/long_record"))
    if not found:
        return None
    command = [found[0], "--json", "--rounds", str(rounds)]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


class Run:
    """One input: each slider's works with their answers and times."""

    def __init__(self, n: np.ndarray):
        self.n = n
        motion = ss.GroundMotion(n, dt=DT)
        self.ours = {name: ss.integrate(slider, motion) for name, slider in SLIDERS.items()}
        self.works: dict[str, Works] = {name: {} for name in SLIDERS}
        self.errors: dict[str, dict[str, float]] = {name: {} for name in SLIDERS}
        self.references = {}
        for name, slider in SLIDERS.items():
            r = self.ours[name]
            fine = ss.integrate(slider, halved(n)).displacement[::2]
            # An escaped caster is no longer braked: energy flows back and forth.
            energy = r.energy.dissipated + np.max(r.velocity**2) / 2
            require(f"{name}: energy that does not add up", abs(r.energy.imbalance), 1e-11 * energy)
            require(f"{name}: halved segments", error(r.displacement, fine), 1e-9 * r.peak)
            if name in SPRINGS and slider.hold() == slider.hold(1.0):
                self.references[name] = long_double(n[:REFERENCE_SAMPLES], SPRINGS[name])
            else:
                self.references[name] = fine
            self.add(name, "stickslip", partial(ss.integrate, slider, motion), N, r.displacement)
            require(f"{name}: x", self.errors[name]["stickslip"], 1e-9 * r.peak)

            if name in ("Coulomb", "Coulomb, spring"):
                work = partial(ss.histories, slider, motion)
                self.add(name, HISTORIES, work, N, work()[0])
                require(f"{name}: x of histories", self.errors[name][HISTORIES], 1e-9 * r.peak)

    def add(self, slider: str, name: str, work: Callable, items: int, x: np.ndarray) -> None:
        self.works[slider][name] = (work, items)
        self.errors[slider][name] = error(x, self.references[slider])

    def add_numba(self) -> None:
        for slider, name, loop in (
            ("Coulomb", "numba", partial(peers.numba_coulomb, self.n, DT, SLIP_LEVEL)),
            ("Coulomb", ACCOUNT, partial(peers.numba_account, self.n, DT, SLIP_LEVEL)),
            (
                "Coulomb, spring",
                "numba",
                partial(peers.numba_spring, self.n, DT, SLIP_LEVEL, FREQUENCY),
            ),
        ):
            self.add(slider, name, loop, N, loop()[0])
            require(f"{name}: {slider}", self.errors[slider][name], 1e-9 * self.ours[slider].peak)
        _, _, events, *account = peers.numba_account(self.n, DT, SLIP_LEVEL)
        r = self.ours["Coulomb"]
        require("numba's number of events", abs(len(events) - (len(r.events) - 1)), 0)
        ours = r.peak, r.sliding_distance, r.time_sliding, r.energy.input, r.energy.dissipated
        for a, b in zip(ours, account):
            require("numba's account", abs(a - b), 1e-9 * abs(a))

    def add_scipy(self, solve_ivp: Callable) -> None:
        part = self.n[:SCIPY_SAMPLES]
        for slider, wn in SPRINGS.items():
            law = slider.split(",")[0]
            work = partial(scipy_slider, solve_ivp, part, law, wn)
            self.add(slider, "scipy solve_ivp, rtol 1e-6", work, len(part) - 1, work())

    def add_heyoka(self, hy: ModuleType, compiled: dict[str, Heyoka]) -> None:
        part = self.n[:HEYOKA_SAMPLES]
        motion = ss.GroundMotion(part, dt=DT)
        for slider, wn in SPRINGS.items():
            law = slider.split(",")[0]
            if slider not in compiled:
                compiled[slider] = Heyoka(hy, law, wn)
                compiled[slider, "reference"] = Heyoka(hy, law, wn, np.longdouble)
            if law == "Caster":
                self.references[slider] = compiled[slider, "reference"](part)
                ours = self.ours[slider].displacement
                self.errors[slider]["stickslip"] = error(ours, self.references[slider])
            work = partial(compiled[slider], part)
            self.add(slider, "heyoka", work, len(part) - 1, work())
            require(f"heyoka: {slider}", self.errors[slider]["heyoka"], 1e-9 * np.ptp(work()))
            bare = partial(heyoka_steps, compiled[slider], 5000)
            self.works[slider][BARE_STEP] = (bare, 5000)
            again = partial(ss.integrate, SLIDERS[slider], motion)
            self.works[slider][SAME_SAMPLES] = (again, len(part) - 1)

    def add_pyslammer(self, slam: ModuleType) -> None:
        part = self.n[:PYSLAMMER_SAMPLES]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # it finds 0.1 s long
            ground = slam.GroundMotion(-part / ss.STANDARD_GRAVITY, DT)
        work = partial(slam.RigidAnalysis, SLIP_LEVEL / ss.STANDARD_GRAVITY, ground)
        self.add("Coulomb, one-way", "pySLAMMER, rigid", work, len(part), work().sliding_disp)

    def time(self, rounds: int) -> dict[str, dict[str, Timing]]:
        """What is compared takes turns; slow peers take fewer."""
        result = {}
        for slider, works in self.works.items():
            timings = {}
            for names, turns in (
                (QUICK, rounds),
                (("heyoka", BARE_STEP, SAME_SAMPLES), max(3, rounds // 2)),
                (("scipy solve_ivp, rtol 1e-6", "pySLAMMER, rigid"), 3),
            ):
                timings |= take_turns({k: works[k] for k in names if k in works}, turns)
            result[slider] = timings
        return result


def print_table(run: Run, timings: dict[str, dict[str, Timing]], cpp: dict | None) -> None:
    for slider, rows in timings.items():
        peak = run.ours[slider].peak
        title = f"{slider} (peak {peak:.3g} m)"
        print(f"  {title:40} {'median':>9} {'spread':>7} {'ratio':>9}   error [m]")
        for row, timing in rows.items():
            found = run.errors[slider].get(row)
            found = "" if found is None else f"{found:11.1e}"
            print(f"    {row:38} {timing} {timing.ratio(rows['stickslip']):9.3g} {found}".rstrip())
        if cpp:
            for how, more in product(IN_CPP, PLAIN_LOOPS):
                row = cpp["rows"].get(f"{how}: {slider}{more}")
                if row:
                    spread = f"{100 * row['spread']:6.0f}%{' ' if row['spread'] <= 0.1 else '!'}"
                    ratio = row["median"] / rows["stickslip"].median
                    title = f"C++ {how}{more}"
                    print(f"    {title:38} {row['median']:9.1f} {spread} {ratio:9.3g}")
    if not all(t.reliable for rows in timings.values() for t in rows.values()):
        print(UNRELIABLE)


def print_bars(run: Run, timings: dict[str, dict[str, Timing]], cpp: dict | None) -> None:
    ours = {slider: rows["stickslip"] for slider, rows in timings.items()}
    plain = timings["Coulomb"].get("numba")
    if plain:
        print(bar("Coulomb through Python / numba", ours["Coulomb"].ratio(plain), 1))
        same = timings["Coulomb"][HISTORIES].ratio(plain)
        print(bar("Coulomb, x and v alone as numba's, through Python / numba", same, 1))
        if cpp:
            for how, (more, loop) in product(IN_CPP, PLAIN_LOOPS.items()):
                in_cpp = cpp["rows"][f"{how}: Coulomb{more}"]["median"]
                print(bar(f"Coulomb, C++ {how}{more} / numba", in_cpp / plain.median, 0.9))
                ratio = in_cpp / cpp["rows"][loop]["median"]
                print(bar(f"Coulomb, C++ {how}{more} / {loop}", ratio, 1))
        with_spring = ours["Coulomb, spring"].median / plain.median
        print(bar("Coulomb with spring through Python / numba without", with_spring, 3))
    for slider in ("Caster", "Caster, spring"):
        rows, errors = timings[slider], run.errors[slider]
        if "heyoka" in rows:
            ratio = rows["heyoka"].ratio(rows[SAME_SAMPLES])
            print(bar(f"{slider}: heyoka / through Python", ratio, 8, at_least=True))
            round_off = 1e-14 * np.max(np.abs(run.references[slider]))
            ratio = errors["stickslip"] / max(errors["heyoka"], round_off)
            print(bar(f"{slider}: error / larger of heyoka's and 1e-14 of x", ratio, 1))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cpp", type=Path, help="long_record as CMake built it")
    parser.add_argument("--rounds", type=int, default=21)
    args = parser.parse_args()

    print(machine())
    print(versions("numpy", "numba", "scipy", "heyoka", "pyslammer"))
    compiled = compiled_figures(args.cpp, args.rounds)
    if compiled:
        print(f"C++: {compiled['compiler']} {compiled['flags']}, commit {compiled['commit']}")
    else:
        print("C++: left out, for no build/**/bench/long_record is there and no --cpp is given")
    print(
        f"{N} samples, dt = {DT} s, standard deviation {DEVIATION} m/s^2, slip level {SLIP_LEVEL}"
        f" m/s^2\nns of processor time per sample, over {args.rounds} rounds; ratio to stickslip;"
        " largest error in x against\nlong double (Coulomb), heyoka in long double (caster) or"
        " halved segments (one-way)"
    )
    numba, scipy = peer("numba"), peer("scipy.integrate")
    hy, slam = peer("heyoka"), peer("pyslammer")
    flows: dict = {}  # of heyoka
    bars = []
    for name, n in inputs().items():
        run = Run(n)
        cpp = compiled["inputs"][name] if compiled else None
        coulomb = run.ours["Coulomb"]
        if cpp:
            apart = abs(cpp["residual"] - coulomb.residual)
            require(f"{name}: residual in C++", apart, 1e-6 * coulomb.peak)
        if numba:
            run.add_numba()
        if scipy:
            run.add_scipy(scipy.solve_ivp)
        if hy:
            run.add_heyoka(hy, flows)
        if slam:
            run.add_pyslammer(slam)
        timings = run.time(args.rounds)
        print(f"\n{name}: {len(coulomb.events) / N:.2f} events a sample with Coulomb friction")
        print_table(run, timings, cpp)
        bars.append((name, run, timings, cpp))

    print("\nbars")
    for name, *rest in bars:
        print(name)
        print_bars(*rest)
    print("the command")
    seconds = seconds_of_command(10).median
    print(bar(f"stickslip slide, {RECORD_SAMPLES} samples, whole process [s]", seconds, 0.3))


if __name__ == "__main__":
    main()
