"""Measures a triple pendulum beside single pendulums that stand for it, for docs/pendulums.md.

    python docs/measure_pendulums.py

rewrites the table and the picture of that page, in seconds. The 18 sample records come with
pyslammer (the extra `records`).
"""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import stickslip as ss
from measured_page import draw, rewrite, table

if TYPE_CHECKING:
    from matplotlib.figure import Figure

DOCS = Path(__file__).parent
PAGE = DOCS / "pendulums.md"
PICTURE = DOCS / "images" / "pendulums.png"

G = ss.STANDARD_GRAVITY
TRIPLE = ss.TriplePendulum(
    radii=[0.3937, 3.7465, 3.7465], mu=[0.01, 0.04, 0.08], capacities=[0.0716, 0.5043, 0.5043]
)
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
def responses() -> dict[str, list[ss.Response]]:
    """The settled responses to the sample records, by slider."""
    records = [ss.sample_record(i) if isinstance(i, str) else i for i in ss.sample_records()]
    exact = [ss.integrate(TRIPLE, record, settle=True) for record in records]
    at_peak = [ss.integrate(equivalent(max(r.peak, 1e-3)), r.motion, settle=True) for r in exact]
    typical = float(np.median([r.peak for r in exact]))
    fixed = equivalent(typical)
    return {
        "triple": exact,
        "equivalent at each peak": at_peak,
        "equivalent at the median peak": [
            ss.integrate(fixed, record, settle=True) for record in records
        ],
        "outer surfaces alone": [ss.integrate(outer(), record, settle=True) for record in records],
    }


def _floor(response: ss.Response) -> float:
    return float(ss.response_spectrum(response, [FLOOR_PERIOD]).values[0])


def rows() -> list[list[str]]:
    """Ratios to the triple pendulum: median and range over the records."""
    found = []
    exact = responses()["triple"]
    measures = (
        lambda r: r.peak,
        lambda r: float(np.abs(r.force).max()),
        _floor,
        lambda r: abs(r.residual),
    )
    for name, those in responses().items():
        if name == "triple":
            continue
        cells = [name]
        for measure in measures[:3]:
            ratio = np.array([measure(r) / measure(e) for r, e in zip(those, exact, strict=True)])
            cells.append(f"{np.median(ratio):.2f} ({ratio.min():.2f} to {ratio.max():.2f})")
        mean = [100 * np.mean([abs(r.residual) for r in group]) for group in (those, exact)]
        cells.append(f"{mean[0]:.2f}, {mean[1]:.2f}")
        found.append(cells)
    return found


def tables() -> dict[str, str]:
    return {
        "single": table(
            "| single pendulum | peak displacement | largest force"
            " | floor spectrum at 0.5 s | mean residual, and that of the triple [cm] |",
            rows(),
        )
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
    rewrite(PAGE, tables().values())
    draw(PICTURE, figure)


if __name__ == "__main__":
    main()
