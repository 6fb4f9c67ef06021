"""Blocks that rock: a history, a sweep, the same by SciPy's integrator with events, and MuJoCo.

    pip install scipy mujoco
    python bench/rocking.py [--check] [--rounds N]

Answers are checked before they are timed: closed forms, the balance of energy, and SciPy's answer.
Each run has another record. `--check` runs the checks alone. MuJoCo rocks the rigid blocks of the
referee, whose answers have 20 digits.
"""

from __future__ import annotations

import argparse
import sys
from itertools import cycle

import numpy as np
import stickslip as ss
from measure import bar, machine, peer, take_turns
from stickslip.referee import tools
from stickslip.referee.adapters import mujoco_engine, own
from stickslip.referee.problems import problems

G = ss.STANDARD_GRAVITY
BLOCK = ss.SlenderBlock(p=2, alpha=0.2, restitution=0.8)
RIGID = ss.RockingBlock(width=0.5, height=2.0, mu=0.6)
SLIPPERY = ss.RockingBlock(width=0.5, height=2.0, mu=0.26)


def records(
    rms: float, count: int = 50, samples: int = 4000, dt: float = 0.005
) -> list[ss.GroundMotion]:
    """Kanai and Tajimi's noise, that begins and ends at rest, with an rms over g."""
    soil = ss.Spectrum.kanai_tajimi(s0=1, frequency=12, damping=0.6)
    noise = ss.GaussianExcitation(soil, dt=dt, samples=samples)
    shape = np.sin(np.pi * np.arange(samples) / (samples - 1))
    made = [noise.sample(seed=1, member=i).acceleration * shape for i in range(count)]
    made = [n - shape * (n.mean() / shape.mean()) for n in made]  # leave the ground at rest
    return [ss.GroundMotion(rms * G * n / np.sqrt(np.mean(n**2)), dt=dt) for n in made]


def by_scipy(block: ss.SlenderBlock, motion: ss.GroundMotion) -> float:
    """The peak of theta/alpha as a user would compute it: legs with events, from rest to rest."""
    from scipy.integrate import solve_ivp

    p, alpha, time, n = block.p, block.alpha, motion.time, motion.acceleration
    t, y, side, peak = 0.0, [0.0, 0.0], 0, 0.0
    while t < time[-1]:
        if side == 0:
            over = np.flatnonzero((np.abs(n) > alpha * G) & (time > t))
            if not over.size:
                break
            i = over[0]
            side = -int(np.sign(n[i]))
            crossing = time[i - 1] + (time[i] - time[i - 1]) * (-side * alpha * G - n[i - 1]) / (
                n[i] - n[i - 1]
            )
            t, y = max(t, crossing), [0.0, 0.0]
        s = side

        def rate(at, state, s=s):
            return state[1], p**2 * (state[0] - s * alpha - np.interp(at, time, n) / G)

        def impact(at, state, s=s, begin=t):
            return s * state[0] + (1e-9 if at - begin < 1e-6 else 0)

        impact.terminal, impact.direction = True, -1
        leg = solve_ivp(
            rate,
            (t, time[-1]),
            y,
            "DOP853",
            events=impact,
            rtol=1e-10,
            atol=1e-12,
            max_step=motion.dt,
        )
        peak = max(peak, np.abs(leg.y[0]).max() / alpha)
        t = leg.t[-1]
        if leg.status != 1:
            break
        w = block.restitution * leg.y[1, -1]
        y, side = [0.0, w], -s
        if abs(w) < 1e-4 * p * alpha and abs(np.interp(t, time, n)) < alpha * G:
            side = 0
    return peak


def each(block: ss.SlenderBlock | ss.RockingBlock, motions: list[ss.GroundMotion]) -> None:
    for motion in motions:
        ss.integrate(block, motion)


def check() -> None:
    calm = ss.GroundMotion(np.zeros(400), dt=0.01)
    r = ss.integrate(BLOCK, calm, rotation=0.1, settle=True)
    first = r.events[r.events["kind"] == "impact"]["time"][0]
    if not abs(first - np.arccosh(2) / BLOCK.p) <= 1e-14:
        sys.exit(f"wrong answer: it lands at {first} s")
    for motion in records(0.1, 5):
        for block in (BLOCK, RIGID, SLIPPERY):
            energy = ss.integrate(block, motion).energy
            if not abs(energy.imbalance) <= 1e-11 * max(energy.input, 1):
                sys.exit(f"wrong answer: energy of {block}: {energy.imbalance}")
    r = ss.integrate(BLOCK, records(0.09, 1)[0])
    other = by_scipy(BLOCK, records(0.09, 1)[0])
    if r.overturned or not abs(r.peak_rotation_ratio - other) <= 0.01:
        sys.exit(f"wrong answer: peak {r.peak_rotation_ratio}, by SciPy {other}")
    print(f"peak {r.peak_rotation_ratio:.6f} alpha, by SciPy {other:.6f}; {r.impacts} impacts")


def against_mujoco() -> None:
    """Errors over the largest displacement of a corner, and times over ours."""
    print("rigid blocks by MuJoCo: error over the scale of the problem, time over ours")
    for problem in problems():
        if problem.kind != "rigid_block":
            continue
        ours = tools.run(own, problem, 0)
        for cost, setting in enumerate(mujoco_engine.COSTS):
            found = tools.run(mujoco_engine, problem, cost)
            if "answers" not in found:
                continue
            ratio = found["seconds"] / ours["seconds"]
            error = problem.error(found["answers"])
            print(f"  {problem.id:18} {setting:48} {error:8.2g} {ratio:8.0f}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--check", action="store_true")
    args = parser.parse_args()
    check()
    if args.check:
        print("rocking: right answers")
        return
    print(machine())
    weak, strong, hard = (records(rms) for rms in (0.02, 0.09, 0.12))
    one_by_one = cycle(strong)
    samples = 4000
    blocks = ss.grid(ss.SlenderBlock.from_size, width=np.linspace(0.3, 0.7, 20), height=2.0)
    recorded = [
        ss.GroundMotion(m.acceleration[:2000], dt=m.dt)
        for m in ss.sample_records()
        if len(m.acceleration) >= 2000
    ]
    pairs = len(blocks) * len(recorded) * 2
    works = {
        "slender, at rest, ns a sample": (lambda: each(BLOCK, weak), len(weak) * samples),
        "slender, rocking, ns a sample": (lambda: each(BLOCK, strong), len(strong) * samples),
        "rigid, ns a sample": (lambda: each(RIGID, hard), len(hard) * samples),
        "rigid, slipping, ns a sample": (lambda: each(SLIPPERY, hard), len(hard) * samples),
        "sweep, ns a pair of 2,000 samples": (lambda: ss.sweep(blocks, recorded, threads=1), pairs),
        "SciPy with events, ns a sample": (lambda: by_scipy(BLOCK, next(one_by_one)), samples),
    }
    timings = take_turns(works, args.rounds)
    for name, t in timings.items():
        print(f"  {name:40} {t.median:12.1f} {100 * t.spread:4.0f} %")
    scipy, own = timings["SciPy with events, ns a sample"], timings["slender, rocking, ns a sample"]
    print(f"  SciPy over slender: {scipy.ratio(own):.0f}")
    print("bars")
    print(bar("slender, at rest, ns a sample", timings["slender, at rest, ns a sample"].median, 2))
    print(bar("rigid, rocking, ns a sample", timings["rigid, ns a sample"].median, 500))
    print(bar("rigid, slipping, ns a sample", timings["rigid, slipping, ns a sample"].median, 1000))
    million = timings["sweep, ns a pair of 2,000 samples"].median * 1e-3
    print(bar("a million pairs of block and record of 2,000 samples, s", million, 60))
    if peer("mujoco"):
        against_mujoco()
    else:
        print("MuJoCo is not installed: not compared with it")


if __name__ == "__main__":
    main()
