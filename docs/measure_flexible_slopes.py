"""Measures SLAMMER's methods, as pySLAMMER computes them, for docs/flexible_slopes.md.

    python docs/measure_flexible_slopes.py

rewrites the tables of that page, in some four minutes, nearly all of which pySLAMMER takes. It
comes with the 18 sample records (the extra `records`).
"""

from __future__ import annotations

import warnings
from functools import cache
from typing import Any, NamedTuple

import numpy as np
import pyslammer
import stickslip as ss
from measured_page import DOCS, G, rewrite, samples, table
from numpy.typing import NDArray

PAGE = DOCS / "flexible_slopes.md"

VELOCITY, ROCK, DAMPING = 300.0, 1000.0, 0.05  # [m/s], [m/s], of the soil alone
PERIODS = [0.2, 0.5, 1.0, 2.0, 4.0]  # T_s / T_m
LEVELS = [0.1, 0.2, 0.4, 0.7]  # ky / k_max
METHODS = ["rigid", "decoupled", "coupled"]
LOWEST = 0.005  # [m]: smaller displacements are left out
PARTS = [1, 2, 4, 16]  # steps a sample
SHORTER = 4000  # samples of the records that are divided
STRAIN = 5e-4  # of reference, equivalent-linear
RIGID = 1e9  # [m/s], of rock that does not radiate


class Displacements(NamedTuple):
    """Of one record [m], shape (methods, polarities, periods, levels)."""

    exact: NDArray[np.float64]
    its: NDArray[np.float64]


def height(record: ss.GroundMotion, ratio: float) -> float:
    """Of the column with T_s = 4 H / Vs = ratio T_m."""
    return ratio * ss.strong_motion(record).mean_period * VELOCITY / 4


def column(
    record: ss.GroundMotion, ratio: float, ky_g: float, method: str = "coupled"
) -> ss.FlexibleSlope:
    return ss.FlexibleSlope(
        ky_g=ky_g,
        height=height(record, ratio),
        shear_velocity=VELOCITY,
        damping_ratio=DAMPING,
        rock_velocity=ROCK,
        method=method,
    )


def k_max(slope: ss.FlexibleSlope, record: ss.GroundMotion) -> float:
    """The largest shear at the base of a column that does not slide, over its weight."""
    return float(np.abs(slope.decoupled(record).demand).max()) / G


def levels(record: ss.GroundMotion, ratio: float) -> list[float]:
    """ky in g."""
    largest = k_max(column(record, ratio, 1e3), record)
    return [level * largest for level in LEVELS]


def exactly(record: ss.GroundMotion) -> NDArray[np.float64]:
    """Shape (methods, polarities, periods, levels)."""
    found = np.empty((len(METHODS), 2, len(PERIODS), len(LEVELS)))
    for j, ratio in enumerate(PERIODS):
        ky = levels(record, ratio)
        blocks = [ss.Coulomb(mu=k, backward=float("inf")) for k in ky]
        columns = ([column(record, ratio, k, method) for k in ky] for method in METHODS[1:])
        for i, sliders in enumerate((blocks, *columns)):
            # As recorded it slides in the direction that pySLAMMER calls inverse.
            swept: Any = ss.sweep(sliders, record, threads=1)
            found[i, :, j] = swept.residual[:, 0, :].T
    return found


def by_pyslammer(
    record: ss.GroundMotion,
    parts: int = 1,
    periods: list[float] = PERIODS,
) -> NDArray[np.float64]:
    """Shape (methods, polarities, periods, levels)."""
    divided = record.resampled(record.dt / parts)
    motion = pyslammer.GroundMotion(divided.acceleration / G, divided.dt)
    found = np.empty((len(METHODS), 2, len(periods), len(LEVELS)))
    for j, ratio in enumerate(periods):
        tall = height(record, ratio)
        for m, ky in enumerate(levels(record, ratio)):
            for p, inverse in enumerate((True, False)):
                found[0, p, j, m] = pyslammer.RigidAnalysis(
                    ky, motion, inverse=inverse
                ).max_sliding_disp
                for i, kind in ((1, pyslammer.Decoupled), (2, pyslammer.Coupled)):
                    found[i, p, j, m] = kind(
                        ky, motion, tall, VELOCITY, ROCK, DAMPING, inverse=inverse
                    ).max_sliding_disp
    return found


@cache
def exact_of_record(i: int) -> NDArray[np.float64]:
    return exactly(samples()[i])


@cache
def of_record(i: int) -> Displacements:
    return Displacements(exact_of_record(i), by_pyslammer(samples()[i]))


def ratios(exact: NDArray[np.float64], its: NDArray[np.float64]) -> NDArray[np.float64]:
    """Of its displacements to the exact ones, where these are above the lowest."""
    count = exact > LOWEST
    return its[count] / exact[count]


def errors(ratio: NDArray[np.float64]) -> str:
    """Median, 95 % quantile and largest."""
    error = 100 * np.abs(ratio - 1)
    return ", ".join(f"{v:.1f}" for v in (*np.quantile(error, [0.5, 0.95]), error.max()))


def quantiles(ratio: NDArray[np.float64]) -> str:
    """5, 50 and 95 %."""
    return ", ".join(f"{v:.3f}" for v in np.quantile(ratio, [0.05, 0.5, 0.95]))


@cache
def all_records() -> Displacements:
    """Shape (methods, records, polarities, periods, levels)."""
    those = [of_record(i) for i in range(len(samples()))]
    return Displacements(*(np.stack(each, axis=1) for each in zip(*those)))


RECORD_HEADING = "| record | dt [ms] | cases | rigid | decoupled | coupled |"
LEVEL_HEADING = "| ky / k_max | rigid | decoupled | coupled |"
PERIOD_HEADING = "| T_s / T_m | decoupled | coupled |"
STEP_HEADING = "| steps per sample | rigid | decoupled | coupled |"
SOIL_HEADING = "| equivalent-linear | decoupled | coupled |"
METHOD_HEADING = "| T_s / T_m | rigid / coupled | decoupled / coupled |"


def record_row(i: int) -> list[str]:
    found, record = of_record(i), samples()[i]
    cases = (found.exact > LOWEST).sum(axis=(1, 2, 3))
    cells = [errors(ratios(e, i)) for e, i in zip(found.exact, found.its)]
    return [record.name, f"{1000 * record.dt:g}", ", ".join(map(str, cases)), *cells]


def level_rows() -> list[list[str]]:
    exact, its = all_records()
    rows = []
    for m, level in enumerate(LEVELS):
        rows.append(
            [f"{level}", *(quantiles(ratios(e, i)) for e, i in zip(exact[..., m], its[..., m]))]
        )
    every = [errors(ratios(e, i)) for e, i in zip(exact, its)]
    return [*rows, ["errors of all [%]", *every]]


def period_rows() -> list[list[str]]:
    exact, its = all_records()
    return [
        [
            f"{ratio}",
            *(quantiles(ratios(e, i)) for e, i in zip(exact[1:, ..., j, :], its[1:, ..., j, :])),
        ]
        for j, ratio in enumerate(PERIODS)
    ]


def step_rows(parts: list[int] = PARTS) -> list[list[str]]:
    """The shorter records, T_s = T_m / 2 and T_m, with segments divided."""
    these = [(i, r) for i, r in enumerate(samples()) if len(r) < SHORTER]
    chosen = [PERIODS.index(0.5), PERIODS.index(1.0)]
    periods = [PERIODS[j] for j in chosen]
    exact = np.stack([exact_of_record(i)[:, :, chosen] for i, _ in these], axis=1)
    rows = []
    for part in parts:
        its = np.stack([by_pyslammer(r, part, periods) for _, r in these], axis=1)
        rows.append([f"{part}", *(errors(ratios(e, i)) for e, i in zip(exact, its))])
    return rows


def radiation(rock: float, soil: float) -> float:
    """The damping ratio that pySLAMMER adds."""
    return float(pyslammer.decoupled_analysis.impedance_damping(rock, soil))


def soils(record: ss.GroundMotion, rock: float) -> NDArray[np.float64]:
    """Exact displacements, those that pySLAMMER iterates, and those of the converged properties.

    Shape (3, methods); T_s of small strains = T_m / 2, ky = 0.2 k_max.
    """
    tall = height(record, 0.5)

    def slope(ky_g: float) -> ss.FlexibleSlope:
        return ss.FlexibleSlope(
            ky_g=ky_g,
            height=tall,
            shear_velocity=VELOCITY,
            rock_velocity=rock,
            soil=ss.HyperbolicSoil(reference_strain=STRAIN),
        )

    ky = 0.2 * k_max(slope(1e3), record)
    one = slope(ky)
    properties = one.properties(record)
    velocity = properties["shear_velocity"]
    damping = properties["damping_ratio"] - radiation(rock, velocity)
    motion = pyslammer.GroundMotion(-record.acceleration / G, record.dt)
    found = [[one.decoupled(record).residual, one.coupled(record).residual], [], []]
    for kind in (pyslammer.Decoupled, pyslammer.Coupled):
        soil = {"ref_strain": STRAIN, "soil_model": "equivalent_linear"}
        found[1].append(kind(ky, motion, tall, VELOCITY, rock, DAMPING, **soil).max_sliding_disp)
        found[2].append(kind(ky, motion, tall, velocity, rock, damping).max_sliding_disp)
    return np.array(found)


def soil_rows() -> list[list[str]]:
    rows = []
    for rock, name in ((RIGID, "rigid rock"), (ROCK, "rock of 1000 m/s")):
        each = np.stack([soils(record, rock) for record in samples()], axis=2)
        exact = each[0]
        for what, its in (("iterated by pySLAMMER", each[1]), ("given converged soil", each[2])):
            rows.append([f"{name}, {what}", *(errors(ratios(e, i)) for e, i in zip(exact, its))])
    return rows


def method_rows() -> list[list[str]]:
    """The exact displacements of the simpler methods over coupled ones: 5, 50 and 95 %."""
    exact = np.stack([exact_of_record(i) for i in range(len(samples()))], axis=1)
    rows = []
    for j, ratio in enumerate(PERIODS):
        rigid, decoupled, coupled = exact[..., j, :]
        cells = []
        for other in (rigid, decoupled):
            quantile = np.quantile(ratios(coupled, other), [0.05, 0.5, 0.95])
            cells.append(", ".join(f"{v:.2f}" for v in quantile))
        rows.append([f"{ratio}", *cells])
    return rows


def tables() -> list[str]:
    return [
        table(METHOD_HEADING, method_rows()),
        table(LEVEL_HEADING, level_rows()),
        table(PERIOD_HEADING, period_rows()),
        table(RECORD_HEADING, map(record_row, range(len(samples())))),
        table(STEP_HEADING, step_rows()),
        table(SOIL_HEADING, soil_rows()),
    ]


def main() -> None:
    # pySLAMMER warns of nothing that matters here, but some of its arithmetic does.
    warnings.simplefilter("ignore", RuntimeWarning)
    rewrite(PAGE, tables())


if __name__ == "__main__":
    main()
