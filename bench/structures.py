"""Structures with one sliding interface, beside pySLAMMER and OpenSees.

    pip install pyslammer openseespy
    python bench/structures.py [--check] [--rounds N]

Times a sample of structures of one, ten and fifty modes, stuck and sliding; a coupled analysis of a
slope and sweeps of 100 yield accelerations in both polarities, beside pySLAMMER, whose errors it
prints; 100 light sliders on every floor of ten stories; five stories on a flat slider beside
OpenSees, with its errors. Answers are checked before they are timed. `--check` runs the checks
alone.
"""

from __future__ import annotations

import argparse
import sys
from functools import partial
from importlib import metadata

import numpy as np
import stickslip as ss
from accuracy import OURS, SLIDES, Answer, Program, all_errors, print_times, times
from measure import bar, machine, peer, take_turns, versions
from opensees import AVERAGE_ACCELERATION, prepare, shake

HEIGHT, VELOCITY, ROCK, DAMPING, STRAIN = 50, 600, 1500, 0.05, 5e-4
COLUMN = {"height": HEIGHT, "shear_velocity": VELOCITY}
LINEAR = COLUMN | {"damping_ratio": DAMPING, "rock_velocity": ROCK}
# On rigid rock: in pySLAMMER radiation takes the velocity of the strained soil, here not.
SOIL = COLUMN | {"soil": ss.HyperbolicSoil(reference_strain=STRAIN)}
RIGID = 1e9  # [m/s]
LEVELS = np.linspace(0.005, 0.5, 100).tolist()  # [g]
SLIDERS = ss.grid(ss.Coulomb, mu=np.arange(1, 101) / 100)
TEN = ss.Structure.shear_building(masses=[2e5] * 10, stiffnesses=[4e8] * 10, damping_ratio=0.03)
FIVE = {"masses": [1.0] * 5, "stiffnesses": [900.0] * 5}
BETA = 0.005  # [s], C = beta K
MU = 0.05
YIELDS = ((1, 1e-3), (10, 1e-4), (40, 1e-5))  # steps a sample, yield displacement [m]


def require(right: bool, what: str) -> None:
    if not right:
        sys.exit(f"wrong answer: {what}")


def column(modes: int, floors: bool) -> ss.Structure:
    """The modes of a shear column whose first period is 0.33 s."""
    odd = 2 * np.arange(modes) + 1
    return ss.Structure.from_modes(
        mass_fractions=8 / (odd * np.pi) ** 2,
        frequencies=6 * np.pi * odd,
        damping_ratios=[DAMPING] * modes,
        shapes=4 / (np.pi * odd) * np.sin(np.outer([0.5, 1], odd * np.pi / 2)) if floors else None,
    )


def of_modes(rounds: int, check: bool) -> None:
    """`integrate`, alone and with the peaks of two floors, and a level of a sweep of 20."""
    rng = np.random.default_rng(1)
    quake = ss.GroundMotion(np.convolve(rng.normal(0, 2, 1000), np.ones(4) / 2, "same"), dt=0.01)
    works, bars = {}, []
    for modes, stuck, sliding in ((1, 15, 700), (10, 60, 2000), (50, 300, 10000)):
        for what, level, limit in (("stuck", 1e3, stuck), ("sliding", 0.02, sliding)):
            laws = [ss.Coulomb(slip_level=level * (1 + 0.01 * k)) for k in range(20)]
            those = [ss.IsolatedStructure(law, column(modes, False)) for law in laws]
            floors = ss.IsolatedStructure(laws[0], column(modes, True))
            r = ss.integrate(those[0], quake)
            e = r.energy
            require(abs(e.imbalance) <= 1e-11 * e.input, f"{modes} modes: energy")
            again = ss.integrate(those[0], quake.resampled(quake.dt / 3))
            require(abs(again.peak - r.peak) <= 1e-11 * r.sliding_distance, f"{modes} modes, parts")
            table = ss.sweep(those, quake, polarity="recorded")
            apart = abs(table.residual[0, 0, 0] - r.residual)
            require(apart <= 1e-12 * r.sliding_distance, f"{modes} modes, sweep")
            fraction = r.time_sliding / quake.duration
            require(fraction == 0 if what == "stuck" else fraction > 0.99, f"slides {fraction}")
            for name, work, levels in (
                ("integrate", lambda s=those[0]: ss.integrate(s, quake), 1),
                ("with floors", lambda s=floors: ss.integrate(s, quake), 1),
                (
                    "a level of a sweep",
                    lambda s=those: ss.sweep(s, quake, polarity="recorded", threads=1),
                    len(those),
                ),
            ):
                claim = f"{modes:2} modes, {what}, {name}"
                works[claim] = (work, len(quake) * levels)
                bars.append((claim, limit))
    if check:
        return
    print("ns a sample of 10 ms")
    times = take_turns(works, rounds)
    for claim, limit in bars:
        print(f"{bar(claim, times[claim].median, limit)}{'' if times[claim].reliable else ' !'}")


def beside_pyslammer(rounds: int, check: bool) -> None:
    slam = peer("pyslammer")
    if slam is None:
        print("not installed: pyslammer")
        return
    records = slam.sample_ground_motions()
    # Its positive direction of sliding is opposite to ours.
    suite = ss.Suite(
        ss.GroundMotion(-ss.STANDARD_GRAVITY * r.accel, dt=r.dt, name=name)
        for name, r in records.items()
    )
    record = records[suite[8].name]
    fine = suite[8].resampled(record.dt / 16)
    fine = slam.GroundMotion(-fine.acceleration / ss.STANDARD_GRAVITY, fine.dt)
    its = slam.Coupled(0.05, fine, HEIGHT, VELOCITY, ROCK, DAMPING).max_sliding_disp
    exact = ss.FlexibleSlope(ky_g=0.05, **LINEAR).coupled(suite[8]).peak
    require(abs(its / exact - 1) < 2e-3, f"pySLAMMER with 16 steps a sample: {its}, {exact}")
    samples = sum(map(len, suite))
    kinds = {"linear": LINEAR, "equivalent-linear": SOIL}
    works = {}
    for kind, keywords in kinds.items():
        slopes = ss.grid(ss.FlexibleSlope, ky_g=LEVELS, **keywords)
        one = slopes[9]
        strain = (
            {"ref_strain": STRAIN, "soil_model": "equivalent_linear"} if kind != "linear" else {}
        )

        column = HEIGHT, VELOCITY, RIGID if strain else ROCK, DAMPING

        def its(ky: float = one.ky_g, column: tuple = column, strain: dict = strain) -> np.ndarray:
            return np.array(
                [slam.Coupled(ky, r, *column, **strain).max_sliding_disp for r in records.values()]
            )

        def ours(one: ss.FlexibleSlope = one) -> np.ndarray:
            return np.array([one.coupled(quake).peak for quake in suite])

        def table(slopes: list = slopes) -> ss.SweepTable:
            return ss.sweep(slopes, suite, settle=True, threads=1)

        swept = table()
        exact = ours()
        require(np.abs(swept.peak[9, :, 0] - exact).max() <= 1e-12, "a sweep of slopes")
        require(
            np.abs(swept.peak[9, 3, 1] - one.coupled(-suite[3]).peak) <= 1e-12, "its mirror image"
        )
        apart = 100 * np.abs(its() / exact - 1)
        # In equivalent-linear soil it also stops iterating at changes of 5 %.
        require(np.median(apart) < (1 if kind == "linear" else 2), f"{kind}: pySLAMMER, {apart}")
        print(
            f"{kind}, ky = {one.ky_g:.3g} g: pySLAMMER's displacements differ by"
            f" {np.median(apart):.1f} % (median), {apart.max():.0f} % (largest)"
        )
        works |= {
            f"{kind}: pySLAMMER": (its, samples),
            f"{kind}: coupled": (ours, samples),
            f"{kind}: a level of a sweep": (table, samples * 2 * len(slopes)),
        }
    if check:
        return
    times = take_turns(works, rounds)
    print("ns of processor time a sample and level")
    for name, timing in times.items():
        print(f"  {name:40}{timing}")
    for kind in kinds:
        rival = times[f"{kind}: pySLAMMER"]
        for claim, name, limit in (
            ("one analysis", "coupled", 10),
            ("100 levels in both polarities", "a level of a sweep", 100),
        ):
            multiple = rival.ratio(times[f"{kind}: {name}"])
            print(bar(f"{kind}, {claim}: pySLAMMER as a multiple", multiple, limit, at_least=True))


def on_all_floors(rounds: int, check: bool) -> None:
    suite = ss.sample_records()

    def work() -> ss.SweepTable:
        return ss.sweep(
            SLIDERS, [m for quake in suite for m in TEN.floor_motions(quake)], threads=1
        )

    table = work()
    # Between samples the motion of a floor is not straight.
    apart = []
    for k, floor in ((0, 10), (5, 1), (17, 5)):
        for level in (4, 14):
            exact = ss.integrate(
                ss.EquipmentOnFloor(SLIDERS[level], TEN, floor=floor), suite[k]
            ).peak
            if exact > 1e-3:
                apart.append(abs(table.peak[level, 10 * k + floor - 1, 0] / exact - 1))
    require(max(apart) < 0.02, f"light sliders on floors, {max(apart)}")
    print(
        f"light sliders on floors: {100 * max(apart):.2g} % from the exact floors between samples"
    )
    if not check:
        timing = take_turns({"floors": (work, 1)}, rounds)["floors"]
        print(
            bar("100 light sliders on each of ten floors, 18 records [s]", timing.median / 1e9, 0.5)
        )


def by_opensees(ops, steps: int, yields: float, quake: ss.GroundMotion) -> Answer:
    """Peak and final displacement of the base [m]; Newmark's average acceleration."""
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    masses, stiffnesses = [1.0, *FIVE["masses"]], FIVE["stiffnesses"]
    for node in range(len(masses) + 1):
        ops.node(node, 0.0)
    ops.fix(0, 1)
    for node, mass in enumerate(masses, 1):
        ops.mass(node, mass)
    force = MU * ss.STANDARD_GRAVITY * sum(masses)
    ops.uniaxialMaterial("ElasticPP", 1, force / yields, yields)
    ops.element("zeroLength", 1, 0, 1, "-mat", 1, "-dir", 1)
    for story, stiffness in enumerate(stiffnesses, 2):
        ops.uniaxialMaterial("Elastic", story, stiffness, BETA * stiffness)
        ops.element("zeroLength", story, story - 1, story, "-mat", story, "-dir", 1)
    prepare(ops, "Transient", *AVERAGE_ACCELERATION, test=("NormUnbalance", 1e-10, 50))
    return shake(ops, 1, [quake.acceleration], quake.dt, steps)


def beside_opensees(rounds: int, check: bool) -> None:
    ops = peer("openseespy.opensees")
    if ops is None:
        print("not installed: openseespy")
        return
    building = ss.Structure.shear_building(**FIVE, damping=ss.Rayleigh(beta=BETA))
    system = ss.IsolatedStructure(ss.Coulomb(mu=MU), building, base_mass=1)

    def ours(quake: ss.GroundMotion) -> Answer:
        r = ss.integrate(system, quake)
        return r.peak, r.residual

    programs: dict[str, Program] = {OURS: ours}
    for steps, yields in YIELDS[:1] if check else YIELDS:
        programs[f"OpenSees, {steps} a sample, yield {1e3 * yields:g} mm"] = partial(
            by_opensees, ops, steps, yields
        )
    shorter = [quake for quake in ss.sample_records() if len(quake) < 4000]
    print(f"openseespy {metadata.version('openseespy')}; five stories on a flat slider")
    print("errors [% of the peak]: peak median, largest; final median, largest")
    for name, error in all_errors(programs, shorter).items():
        require(np.median(error.peak) < 0.2, f"{name}: peaks, {error}")
    if not check:
        slide = [quake for quake in shorter if ours(quake)[0] >= SLIDES]
        print_times(times(programs, slide, rounds, repeats=20))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="only check the answers")
    parser.add_argument("--rounds", type=int, default=5)
    args = parser.parse_args()
    print(machine())
    print(versions("numpy", "pyslammer"))
    of_modes(args.rounds, args.check)
    on_all_floors(args.rounds, args.check)
    beside_pyslammer(min(args.rounds, 3), args.check)
    beside_opensees(args.rounds, args.check)


if __name__ == "__main__":
    main()
