"""Measures a triple pendulum beside single pendulums that stand for it, for docs/pendulums.md.

    python docs/measure_pendulums.py

rewrites the tables and the picture of that page, in seconds. The 18 sample records come with
pyslammer (the extra `records`).
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

import numpy as np
import stickslip as ss
from measured_page import DOCS, G, rewrite, samples, table

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PAGE = DOCS / "pendulums.md"
PICTURE = DOCS / "images" / "pendulums.png"


def triple(factor: float = 1) -> ss.MultiPendulum:
    """The triple pendulum of the page with its friction multiplied by a factor."""
    return ss.TriplePendulum(
        radii=[0.3937, 3.7465, 3.7465],
        mu=[0.01 * factor, 0.04 * factor, 0.08 * factor],
        capacities=[0.0716, 0.5043, 0.5043],
    )


TRIPLE = triple()
LOWER, UPPER = 0.85, 1.6  # example factors on the friction
PATH = [0.5, -0.5, 0.5]  # the loop of the picture [m]
FLOOR_PERIOD = 0.5  # [s]


def equivalent(design: float) -> ss.Slider:
    """The single pendulum with the same secant stiffness and loop at a design displacement [m].

    The force at D is W (mu + D / R), and the area of the loop 4 mu W D.
    """
    loop = TRIPLE.trace([design, -design, design, -design])
    one = TRIPLE.trace([design, -design])
    mu = float((loop.dissipated - one.dissipated).sum()) / (4 * design)
    radius = design / (float(loop.force[0]) - mu)
    return ss.FrictionPendulum(radius=radius, mu=mu)


def outer() -> ss.Slider:
    """The single pendulum of the outer surfaces: R = L2 + L3, mu their mean."""
    return ss.FrictionPendulum(radius=2 * 3.7465, mu=0.06)


@cache
def exact(factor: float = 1) -> list[ss.Response]:
    """The settled responses of the triple pendulum to the sample records."""
    return [ss.integrate(triple(factor), record, settle=True) for record in samples()]


@cache
def responses() -> dict[str, list[ss.Response]]:
    """The same of single pendulums that stand for it, by name."""
    records = samples()
    at_peak = [ss.integrate(equivalent(max(r.peak, 1e-3)), r.motion, settle=True) for r in exact()]
    typical = float(np.median([r.peak for r in exact()]))
    fixed = equivalent(typical)
    return {
        "equivalent at each peak": at_peak,
        "equivalent at the median peak": [
            ss.integrate(fixed, record, settle=True) for record in records
        ],
        "outer surfaces alone": [ss.integrate(outer(), record, settle=True) for record in records],
    }


def _floor(response: ss.Response) -> float:
    return float(ss.response_spectrum(response, [FLOOR_PERIOD]).values[0])


def _force(response: ss.Response) -> float:
    return float(np.abs(response.force).max()) / G


def rows() -> list[list[str]]:
    """Ratios to the triple pendulum: median and range over the records."""
    found = []
    for name, those in responses().items():
        cells = [name]
        for measure in (lambda r: r.peak, _force, _floor):
            ratio = np.array([measure(r) / measure(e) for r, e in zip(those, exact(), strict=True)])
            cells.append(f"{np.median(ratio):.2f} ({ratio.min():.2f} to {ratio.max():.2f})")
        mean = [100 * np.mean([abs(r.residual) for r in group]) for group in (those, exact())]
        cells.append(f"{mean[0]:.2f}, {mean[1]:.2f}")
        found.append(cells)
    return found


def bounds() -> list[list[str]]:
    """The triple pendulum with each friction, and the records in which each governs."""
    values = np.array(  # (frictions, records, quantities)
        [
            [(100 * r.peak, _force(r), 100 * abs(r.residual)) for r in exact(factor)]
            for factor in (LOWER, 1, UPPER)
        ]
    )
    peak, force, residual = np.moveaxis(values, 2, 0)
    found = [
        ["median peak displacement [cm]", *(f"{v:.1f}" for v in np.median(peak, axis=1))],
        ["largest peak displacement [cm]", *(f"{v:.1f}" for v in peak.max(axis=1))],
        ["largest force over the weight", *(f"{v:.3f}" for v in force.max(axis=1))],
        ["largest residual displacement [cm]", *(f"{v:.1f}" for v in residual.max(axis=1))],
    ]
    for name, of in (("peak", peak), ("force", force), ("residual", residual)):
        second, first = np.sort(of, axis=0)[-2:]
        governs = (of == first) & (first > second * (1 + 1e-9))
        found.append([f"records in which it has the largest {name}", *map(str, governs.sum(1))])
    return found


def tables() -> dict[str, str]:
    return {
        "single": table(
            "| single pendulum | peak displacement | largest force"
            " | floor spectrum at 0.5 s | mean residual, and that of the triple [cm] |",
            rows(),
        ),
        "bounds": table(
            f"| 18 records | lower bound, {LOWER} mu | nominal | upper bound, {UPPER} mu |",
            bounds(),
        ),
    }


def figure() -> Figure:
    from stickslip import plotting

    drawn = plotting.new_figure(9, 3.6)
    left, right = drawn.subplots(1, 2)
    TRIPLE.trace(PATH).plot(ax=left, title="Imposed displacement")
    one = equivalent(PATH[0])
    mu, radius = one.law.mu, one.radius
    x = np.array([-0.5, 0.5])
    for side in (1, -1):
        left.plot(100 * x, side * mu + x / radius, "--", color=plotting.GRAY, linewidth=1)
    response = ss.integrate(TRIPLE, ss.sample_record("Kobe"), settle=True)
    response.plot_hysteresis(ax=right, title="Kobe 1995")
    return drawn


def main() -> None:
    rewrite(PAGE, tables().values(), {PICTURE: figure})


if __name__ == "__main__":
    main()
