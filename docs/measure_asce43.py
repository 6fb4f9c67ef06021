"""Measures the estimate of ASCE 43 beside exact sliding, for docs/asce43.md.

    python docs/measure_asce43.py

rewrites the tables and the picture of that page, in two minutes. The 18 sample records come with
pyslammer (the extra `records`). The tables of recorded pairs, and of a station with a vertical
component, need the folder that $STICKSLIP_RECORDS names, and stay as they are without it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import cache
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import stickslip as ss
from measured_page import (
    DOCS,
    components,
    flat,
    pairs,
    rewrite,
    samples,
    spread,
    station,
    table,
    triples,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PAGE = DOCS / "asce43.md"
PICTURE = DOCS / "images" / "asce43.png"

MUS = (0.05, 0.1, 0.2, 0.3, 0.4, 0.6)
FACTORS = (1.0, 1.5, 3.0)  # of the records
EDGES = (0.0, 0.1, 0.2, 0.3, 0.45, 0.6, 1.0)  # of mu g / PGA
SLIDES = 0.01  # [m]; smaller displacements are not compared
TRIPLES = 15


class Point(NamedTuple):
    """One motion and one coefficient of friction."""

    mu: float
    relative: float  # mu g / PGA, the PGA of pairs that in the direction of the largest
    estimate: float  # [m]
    exact: float  # [m], the largest displacement
    reached: bool


# ---- estimate and exact displacement


def measure(motion: ss.GroundMotion, mu: float) -> Point:
    e = ss.asce43(mu=mu, motion=motion)
    block = ss.Coulomb(mu=mu)
    slider = block if motion.transverse is None else ss.PlanarSlider(block)
    r = ss.integrate(slider, motion, settle=True)
    t = 0.0 if motion.transverse is None else motion.transverse
    pga = np.hypot(motion.acceleration, t).max()
    return Point(mu, mu * ss.STANDARD_GRAVITY / pga, e.displacement, r.peak, e.reached)


@cache
def points(
    motions: Callable[[], tuple[ss.GroundMotion, ...]], mu: float, factor: float = 1.0
) -> tuple[Point, ...]:
    return tuple(measure(motion.scaled(factor), mu) for motion in motions())


def of_axes() -> tuple[ss.GroundMotion, ...]:
    return tuple(components(pairs()))


def gentle() -> tuple[ss.GroundMotion, ...]:
    return triples(0.4, 2 / 3)[:TRIPLES]


def strong() -> tuple[ss.GroundMotion, ...]:
    return triples(0.4, 1)[:TRIPLES]


def gentle_flat() -> tuple[ss.GroundMotion, ...]:
    return tuple(map(flat, gentle()))


def ratios(found: Iterable[Point]) -> np.ndarray:
    """Estimate / exact, where the block slides 1 cm; 0 where the spectrum never reaches c_s."""
    return np.array([one.estimate / one.exact for one in found if one.exact >= SLIDES])


def row(found: Iterable[Point]) -> list[str]:
    found = list(found)
    here = ratios(found)
    if not here.size:
        return [f"{len(found)}, 0", "", "", "", ""]
    scatter = np.log(here[here > 0]).std()
    return [
        f"{len(found)}, {here.size}",
        *spread(here),
        f"{scatter:.2f}" if here.size > 1 else "",
        f"{np.sum(here < 1)}",
    ]


def rows(
    name: str,
    motions: Callable[[], tuple[ss.GroundMotion, ...]],
    mus: Iterable[float] = MUS,
) -> list[list[str]]:
    mus = tuple(mus)
    each = [[name, f"{mu:g}", *row(points(motions, mu))] for mu in mus]
    every = [point for mu in mus for point in points(motions, mu)]
    return [*each, [name, "all", *row(every)]]


def rows_by_strength(
    name: str, motions: Callable[[], tuple[ss.GroundMotion, ...]]
) -> list[list[str]]:
    """Rows for classes of mu g / PGA, of records as they are and scaled."""
    every = [one for mu in MUS for factor in FACTORS for one in points(motions, mu, factor)]
    each = [
        [name, f"{low:g} to {high:g}", *row(one for one in every if low <= one.relative < high)]
        for low, high in pairwise(EDGES)
    ]
    return [*each, [name, "all", *row(every)]]


BY_STRENGTH = (
    "| mu g / PGA | motions, slide 1 cm | estimate / exact: median | 16 to 84 % | scatter (ln)"
    " | too low |"
)
COLUMNS = (
    "| mu | motions, slide 1 cm | estimate / exact: median | 16 to 84 % | scatter (ln) | too low |"
)


def of_station() -> list[list[str]]:
    """The station with a vertical component, both horizontal components and all three [cm]."""
    both = station()[0]
    found = []
    for mu in MUS:
        two, three = measure(flat(both), mu), measure(both, mu)
        cells = (two.estimate, two.exact, three.estimate, three.exact)
        found.append([f"{mu:g}", *(f"{100 * cell:.1f}" for cell in cells)])
    return found


# ---- the page


def tables() -> dict[str, str]:
    """By name, the tables that this machine has the files for."""
    found = {
        "samples": table(
            f"| one component {BY_STRENGTH}", rows_by_strength("18 sample records", samples)
        ),
        "vertical": table(
            f"| synthetic triples {COLUMNS}",
            [
                *rows("two components", gentle_flat, (0.1, 0.2)),
                *rows("the same, V/H = 0.67", gentle, (0.1, 0.2)),
                *rows("the same, V/H = 1", strong, (0.1, 0.2)),
            ],
        ),
    }
    if pairs():
        found["pairs"] = table(
            f"| recorded pairs {BY_STRENGTH}",
            [
                *rows_by_strength("each component alone", of_axes),
                *rows_by_strength("two components", pairs),
            ],
        )
    if station():
        found["station"] = table(
            "| mu | estimate, two components [cm] | exact | estimate, with vertical | exact |",
            of_station(),
        )
    return found


def figure() -> Figure:
    """The construction in a spectrum, and estimate against exact displacement."""
    from stickslip import plotting

    figure = plotting.new_figure(11, 4.5)
    spectrum, against = figure.subplots(1, 2)
    quake = next(motion for motion in samples() if motion.name.startswith("Loma Prieta"))
    f = np.geomspace(0.02, 50, 600)
    a = np.asarray(ss.response_spectrum(quake, 1 / f, 0.1).values) / ss.STANDARD_GRAVITY
    spectrum.plot(f, a, color=plotting.BLUE, lw=1.2, label="10 % damped")
    for mu, color in ((0.1, plotting.COLORS[2]), (0.3, plotting.VERMILION)):
        e = ss.asce43(mu=mu, motion=quake)
        level = e.sliding_acceleration / ss.STANDARD_GRAVITY
        spectrum.axhline(level, color=color, lw=0.8)
        spectrum.plot(
            e.frequency,
            level,
            "o",
            color=color,
            ms=5,
            label=f"mu = {mu:g}: {e.frequency:.2f} Hz, {100 * e.displacement:.1f} cm",
        )
    spectrum.set(
        xscale="log",
        yscale="log",
        ylim=(0.003, 2),
        xlabel="frequency [Hz]",
        ylabel="pseudo-acceleration [g]",
        title=quake.name,
    )
    spectrum.legend(loc="lower right", fontsize=8)
    line = np.array([1, 1000])
    against.plot(line, line, color=plotting.GRAY, lw=0.8)
    for i, mu in enumerate(MUS):
        found = [point for point in points(samples, mu) if point.exact >= SLIDES]
        against.plot(
            [100 * point.exact for point in found],
            [100 * point.estimate for point in found],
            ".",
            color=plotting.COLORS[i],
            ms=6,
            label=f"mu = {mu:g}",
        )
    against.set(
        xscale="log",
        yscale="log",
        xlim=(1, 1000),
        ylim=(1, 1000),
        xlabel="exact displacement [cm]",
        ylabel="estimate [cm]",
        title="18 records, one component",
    )
    against.legend(loc="lower right", fontsize=8)
    return figure


def main() -> None:
    found = tables()
    rewrite(PAGE, found.values(), {PICTURE: figure})
    for name in ("pairs", "station"):
        if name not in found:
            print(f"no files of the {name} in $STICKSLIP_RECORDS: their table stays as it is")


if __name__ == "__main__":
    main()
