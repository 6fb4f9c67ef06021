"""Measures the errors of the distributions and peaks that the pulse theories predict.

    python docs/measure_pulse_theories.py

rewrites the tables of docs/pulse_chain.md and docs/pulse_superposition.md that have the headings
below. The other tables of these pages come from `build/dev/bench/pulse_theories --map`.
"""

from __future__ import annotations

import math

import numpy as np
import stickslip as ss
from measured_page import DOCS, rewrite, table

CHAIN, SUPERPOSITION = DOCS / "pulse_chain.md", DOCS / "pulse_superposition.md"

BLOCK = ss.Coulomb(slip_level=1.0)
LEVELS = (0.5, 0.95, 0.99)  # quantiles of peaks
STRENGTHS = {"1/3": 1 / 3, "0.5": 0.5, "1": 1.0, "3": 3.0, "10": 10.0, "20": 20.0}

PEAKS = (
    "| p | sigma_B | 3 slips: 50 % | 95 % | 99 % | 10 slips: 50 % | 95 % | 99 % "
    "| 50 slips: 50 % | 95 % | 99 % |"
)
EVENTS = "| event | mu | sigma_B | 50 % | 95 % | 99 % |"
WEAK = (
    "| sigma_B | chain | p | largest difference | atom | simulated atom "
    "| 97.5 % quantile, theory / simulation |"
)
RARE = (
    "| lambda Dt | sigma_B | none: standard deviation | largest difference "
    "| renewal: standard deviation | largest difference |"
)


def pulses_of(p: float, sigma: float, duration: float) -> ss.PoissonPulses:
    return ss.PoissonPulses(rate=p, half_width=1.0, sigma=sigma, duration=duration)


def chain_for(sigma: float) -> ss.theory.PulseChain:
    return ss.theory.PulseChain(refined=sigma < 0.3)


def ensemble(pulses: ss.PoissonPulses, members: int, seed: int, block=BLOCK) -> ss.Ensemble:
    return ss.run_ensemble(
        block, pulses, members=members, seed=seed, dt=pulses.duration, velocity_spectrum=False
    )


def peak_ratios(p: float, sigma: float, slips: float) -> list[float] | None:
    """Theory / simulation; None if the motion for so few slips is shorter than 10 dt."""
    chain = chain_for(sigma)
    first = chain.distribution(BLOCK, pulses_of(p, sigma, 100.0), 100.0).slips
    second = chain.distribution(BLOCK, pulses_of(p, sigma, 200.0), 200.0).slips
    duration = 100 + (slips - first) * 100 / (second - first)
    if duration < 10:
        return None
    pulses = pulses_of(p, sigma, duration)
    members = int(min(20_000, 4e7 / (p * duration)))
    peaks = np.quantile(ensemble(pulses, members, seed=7).peak, LEVELS)
    return [chain.peak(BLOCK, pulses, level).value / peak for level, peak in zip(LEVELS, peaks)]


def table_of_peaks() -> list[list[str]]:
    rows = []
    for p in (0.02, 0.1, 0.5, 2.0):
        for name, sigma in STRENGTHS.items():
            row = [f"{p:g}", name]
            for slips in (3, 10, 50):
                ratios = peak_ratios(p, sigma, slips)
                row += ["-"] * 3 if ratios is None else [f"{ratio:.2f}" for ratio in ratios]
            rows.append(row)
    return rows


def table_of_events() -> list[list[str]]:
    rows = []
    for event in ss.PoissonPulses.events():
        quake = ss.PoissonPulses.event(event)
        for mu in (0.05, 0.1, 0.2, 0.3, 0.5, 0.7):
            block = ss.Coulomb(mu=mu)
            sigma = quake.sigma / block.slip_level
            if sigma < 0.199:
                continue
            peaks = np.quantile(ensemble(quake, 20_000, seed=2, block=block).peak, LEVELS)
            row = [event.capitalize(), f"{mu:g}", f"{sigma:.2f}"]
            for level, peak in zip(LEVELS, peaks):
                found = chain_for(sigma).peak(block, quake, level).value
                row.append(f"{found / peak:.3f}" if peak > 0 else f"{100 * found:.2g} cm, not 0")
                if peak == found == 0:
                    row[-1] = "0"
            rows.append(row)
    return rows


def largest_difference(law: ss.theory.DisplacementDistribution, found: np.ndarray) -> float:
    """Between the distribution functions, at the members where they differ from zero."""
    x = np.sort(found)
    below = np.searchsorted(x, x, side="left") / len(x)
    upto = np.searchsorted(x, x, side="right") / len(x)
    exact = law.cdf(x)
    before = exact - np.where(x == 0, law.atom, 0)
    return float(max(np.abs(upto - exact).max(), np.abs(below - before).max()))


def table_of_weak_pulses() -> list[list[str]]:
    rows = []
    for name, sigma, refined in (
        ("0.15", 0.15, True),
        ("0.2", 0.2, False),
        ("0.25", 0.25, False),
        ("1/3", 1 / 3, False),
    ):
        for p in (0.5, 2.0):
            pulses = pulses_of(p, sigma, 160.0)
            law = ss.theory.PulseChain(refined=refined).distribution(BLOCK, pulses, 160.0)
            found = ensemble(pulses, 40_000, seed=3).residual
            quantile = np.quantile(found, 0.975)
            ratio = f"{law.quantile(0.975) / quantile:.2f}" if quantile > 0 else "-"
            rows.append(
                [
                    name,
                    "refined" if refined else "plain",
                    f"{p:g}",
                    f"{largest_difference(law, found):.3f}",
                    f"{law.atom:.3f}",
                    f"{np.mean(found == 0):.3f}",
                    ratio,
                ]
            )
    return rows


def table_of_rare_pulses() -> list[list[str]]:
    rows = []
    for p in (0.001, 0.01, 0.1):
        for name in ("0.5", "1", "3"):
            pulses = pulses_of(p, STRENGTHS[name], 200 / p)
            found = ensemble(pulses, 20_000, seed=4).residual
            row = [f"{p:g}", name]
            for overlap in ("none", "renewal"):
                try:
                    law = ss.theory.PulseSuperposition(overlap).distribution(
                        BLOCK, pulses, pulses.duration
                    )
                except ValueError:
                    row += ["rejected", ""]
                    continue
                ratio = math.sqrt(law.variance) / found.std()
                row += [f"{ratio:.2f}", f"{largest_difference(law, found):.3f}"]
            rows.append(row)
    return rows


def main() -> None:
    for page, heading, rows in (
        (SUPERPOSITION, RARE, table_of_rare_pulses),
        (CHAIN, WEAK, table_of_weak_pulses),
        (CHAIN, EVENTS, table_of_events),
        (CHAIN, PEAKS, table_of_peaks),
    ):
        rewrite(page, [table(heading, rows()).replace("|  |", "| |")])


if __name__ == "__main__":
    main()
