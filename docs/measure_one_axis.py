"""Measures how wrong sliding along one axis is, for docs/one_axis.md.

    python docs/measure_one_axis.py

With the folder of records that $STICKSLIP_RECORDS names it slides every station and writes
docs/one_axis.csv; without one it keeps that table. It then rewrites the tables and the pictures of
the page from it. The table of synthetic motions needs no records.
"""

from __future__ import annotations

import csv
from collections.abc import Iterable, Iterator
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
import stickslip as ss
from measured_page import (
    DOCS,
    PAIRS,
    STATION,
    G,
    flat,
    pairs,
    rewrite,
    spread,
    station,
    table,
    triples,
)
from numpy.typing import NDArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PAGE = DOCS / "one_axis.md"
MEASURED = DOCS / "one_axis.csv"

SLIDES = 1e-3  # [m]; a smaller displacement in the plane gives no ratio
MUS = (0.02, 0.03, 0.05, 0.07, 0.1, 0.15, 0.2, 0.3, 0.4)
FRACTIONS = (0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9)  # of the PGA
TRIPLE_MUS = (0.05, 0.1, 0.2)
PERIOD = 3.0  # of the pendulums [s]
DEGREES = range(180)
ESTIMATES = {"larger": "larger component", "srss": "SRSS", "rotd100": "RotD100"}
QUANTITIES = ("peak", "residual")


# ---- what is measured


def slider(kind: str, mu: float) -> ss.Slider:
    if kind == "block":
        return ss.Slider(ss.Coulomb(mu=mu))
    return ss.FrictionPendulum(period=PERIOD, mu=mu)


def stations() -> tuple[ss.GroundMotion, ...]:
    """Eleven pairs and a station with three components, or nothing."""
    return (*pairs(), station()[0]) if pairs() and station() else ()


def pga(station: ss.GroundMotion) -> float:
    """The larger of the peaks of both horizontal components [g]."""
    return max(np.abs(station.acceleration).max(), np.abs(station.transverse).max()) / G


def responses(
    kind: str, mus: Iterable[float], station: ss.GroundMotion
) -> Iterator[dict[str, float]]:
    """For each coefficient, sliding in the plane and what one axis makes of it [m].

    `larger` and `srss` are of the recorded axes. `larger_low` and `srss_low` are the fractions of
    the 180 directions of a pair of axes in which they are below the displacement in the plane.
    """
    sliders = [slider(kind, mu) for mu in mus]
    how: dict[str, Any] = {"settle": True, "polarity": "recorded"}
    plane = ss.sweep([ss.PlanarSlider(one) for one in sliders], station, **how)
    along = ss.sweep(sliders, [station.rotated(angle) for angle in DEGREES], **how)
    for s in range(len(sliders)):
        found: dict[str, float] = {}
        for quantity in QUANTITIES:
            exact = float(getattr(plane, quantity)[s, 0, 0])
            one = np.abs(getattr(along, quantity)[s, :, 0])
            other = np.roll(one, -90)  # at right angles
            larger, srss = np.maximum(one, other), np.hypot(one, other)
            found |= {
                quantity: exact,
                f"{quantity}_larger": float(larger[0]),
                f"{quantity}_srss": float(srss[0]),
                f"{quantity}_rotd100": float(one.max()),
                f"{quantity}_larger_low": float((larger < exact).mean()),
                f"{quantity}_srss_low": float((srss < exact).mean()),
            }
        yield found


def measure() -> list[dict[str, Any]]:
    """A row for each station, kind of slider, coefficient, and with and without the vertical."""
    rows = []
    for motion in stations():
        level = pga(motion)
        versions = {"horizontal": flat(motion)}
        if motion.vertical is not None:
            versions["all three"] = motion
        for components, acting in versions.items():
            for kind in ("block", "pendulum"):
                mus = [*MUS, *(fraction * level for fraction in FRACTIONS)]
                for place, (mu, found) in enumerate(zip(mus, responses(kind, mus, acting))):
                    relative = place >= len(MUS)
                    rows.append(
                        {
                            "station": motion.name,
                            "components": components,
                            "slider": kind,
                            "mu": mu,
                            "pga_g": level,
                            "fraction": FRACTIONS[place - len(MUS)] if relative else None,
                            **found,
                        }
                    )
    return rows


def stored() -> list[dict[str, Any]]:
    """The rows of the table in the repository."""
    with MEASURED.open(encoding="utf-8", newline="") as stream:
        return [
            {
                name: text
                if name in ("station", "components", "slider")
                else float(text)
                if text
                else None
                for name, text in row.items()
            }
            for row in csv.DictReader(stream)
        ]


def store(rows: list[dict[str, Any]]) -> None:
    with MEASURED.open("w", encoding="utf-8", newline="") as stream:
        out = csv.DictWriter(stream, list(rows[0]), lineterminator="\n")
        out.writeheader()
        for row in rows:
            out.writerow({k: f"{v:.4g}" if isinstance(v, float) else v for k, v in row.items()})


# ---- tables


def ratios(rows: list[dict[str, Any]], quantity: str, estimate: str) -> NDArray[np.float64]:
    """Estimate over displacement in the plane, where that is at least a millimeter."""
    here = [row for row in rows if row[quantity] >= SLIDES]
    return np.array([row[f"{quantity}_{estimate}"] / row[quantity] for row in here])


def low(rows: list[dict[str, Any]], quantity: str, estimate: str) -> float:
    """How often an estimate is low [%]: over stations, and over the directions of the axes."""
    here = [row for row in rows if row[quantity] >= SLIDES]
    if estimate == "rotd100":
        return 100 * float(np.mean([row[f"{quantity}_rotd100"] < row[quantity] for row in here]))
    return 100 * float(np.mean([row[f"{quantity}_{estimate}_low"] for row in here]))


def summary(rows: list[dict[str, Any]], quantity: str) -> list[str]:
    cells = [str(len(ratios(rows, quantity, "srss")))]
    for estimate in ESTIMATES:
        cells += spread(ratios(rows, quantity, estimate))
        cells.append(f"{low(rows, quantity, estimate):.0f}")
    return cells


def groups(
    rows: list[dict[str, Any]], kind: str = "block", fractions: bool = False
) -> Iterator[tuple[float, list[dict[str, Any]]]]:
    """The rows of all stations for each coefficient, or for each fraction of the PGA."""
    here = [r for r in rows if r["slider"] == kind and r["components"] == "horizontal"]
    for value in FRACTIONS if fractions else MUS:
        name = "fraction" if fractions else "mu"
        yield value, [r for r in here if r[name] == value and bool(r["fraction"]) == fractions]


def of_pairs(
    rows: list[dict[str, Any]], quantity: str, kind: str = "block", fractions: bool = False
) -> list[list[str]]:
    return [
        [f"{value:g}", *summary(some, quantity)] for value, some in groups(rows, kind, fractions)
    ]


def of_station(rows: list[dict[str, Any]]) -> list[list[str]]:
    """The station with a vertical component, without and with it [cm]."""
    found = []
    for mu in MUS:
        cells = [f"{mu:g}"]
        for components in ("horizontal", "all three"):
            (row,) = (
                r
                for r in rows
                if r["slider"] == "block"
                and r["components"] == components
                and r["mu"] == mu
                and not r["fraction"]
                and "WTMC" in r["station"]
            )
            names = ("peak", *(f"peak_{estimate}" for estimate in ESTIMATES))
            cells += [f"{100 * row[name]:.2f}" for name in names]
        found.append(cells)
    return found


def of_triples(ratio: float, mu: float) -> list[str]:
    """50 synthetic pairs with a vertical component of V/H = ratio, against those without it."""
    level = [one for s in triples(0.4, 1.0) for one in responses("block", [mu], flat(s))]
    if not ratio:
        return ["0", f"{mu:g}", "", "", *summary(level, "peak")[1:]]
    rows = [one for s in triples(0.4, ratio) for one in responses("block", [mu], s)]
    moved = [a["peak"] / b["peak"] for a, b in zip(rows, level) if b["peak"] >= SLIDES]
    return [f"{ratio:.2f}", f"{mu:g}", *spread(moved), *summary(rows, "peak")[1:]]


COLUMNS = " | ".join(f"{name}: median | 16 to 84 % | low [%]" for name in ESTIMATES.values())


def tables(rows: list[dict[str, Any]]) -> dict[str, str]:
    """The tables of the page, by name."""
    found = {}
    for quantity in QUANTITIES:
        for fractions, head in ((False, "mu"), (True, "mu g / PGA")):
            found[f"{quantity}, {head}"] = table(
                f"| {head}, {quantity} | pairs | {COLUMNS} |",
                of_pairs(rows, quantity, fractions=fractions),
            )
        found[f"{quantity}, pendulum"] = table(
            f"| mu, {quantity} of pendulums | pairs | {COLUMNS} |",
            of_pairs(rows, quantity, "pendulum"),
        )
    names = " | ".join(ESTIMATES.values())
    found["station"] = table(
        f"| mu | without vertical: plane [cm] | {names} | with vertical: plane | {names} |",
        of_station(rows),
    )
    found["triples"] = table(
        f"| V/H | mu | with / without vertical: median | 16 to 84 % | {COLUMNS} |",
        [of_triples(ratio, mu) for ratio in (0.0, 2 / 3, 1.0) for mu in TRIPLE_MUS],
    )
    return found


# ---- pictures


def draw_estimates(axes: Axes, rows: list[dict[str, Any]], quantity: str, fractions: bool) -> None:
    """Estimate over displacement in the plane: a dot for each pair, medians, 16 to 84 %."""
    from stickslip import plotting

    found = list(groups(rows, "block", fractions))
    x = np.array([value for value, _ in found])
    for i, (estimate, name) in enumerate(ESTIMATES.items()):
        place = x * 1.045 ** (i - 1)  # beside each other
        each = [np.maximum(ratios(some, quantity, estimate), 0.05) for _, some in found]
        low_, middle, high = np.array([np.quantile(one, [0.16, 0.5, 0.84]) for one in each]).T
        color = plotting.COLORS[i]
        for at, values in zip(place, each):
            axes.plot(np.full(len(values), at), values, ".", color=color, ms=3, alpha=0.45)
        bars = middle - low_, high - middle
        style = {"color": color, "lw": 1.6, "elinewidth": 0.9, "marker": "o", "ms": 4}
        axes.errorbar(place, middle, bars, label=name, **style)
    axes.axhline(1, color=plotting.GRAY, lw=0.8)
    axes.set(xscale="log", yscale="log", ylim=(0.09, 5))
    at = [0.05, 0.1, 0.2, 0.4, 0.8] if fractions else [0.02, 0.05, 0.1, 0.2, 0.4]
    axes.set_xticks(at, [f"{one:g}" for one in at])
    ticks = [0.1, 0.2, 0.5, 1, 2, 5]
    axes.set_yticks(ticks, [f"{one:g}" for one in ticks])
    axes.minorticks_off()
    axes.set_xlabel("mu g / PGA [\N{MINUS SIGN}]" if fractions else "mu [\N{MINUS SIGN}]")
    axes.set_ylabel(f"{quantity}: estimate / in the plane")


def draw_estimates_of_blocks(rows: list[dict[str, Any]]) -> Figure:
    from stickslip import plotting

    figure = plotting.new_figure(10, 7)
    for row, fractions in zip(figure.subplots(2, 2), (False, True)):
        for axes, quantity in zip(row, QUANTITIES):
            draw_estimates(axes, rows, quantity, fractions)
    figure.axes[0].legend(loc="lower left", fontsize=9)
    return figure


def draw_low(rows: list[dict[str, Any]]) -> Figure:
    from stickslip import plotting

    figure = plotting.new_figure(10, 3.6)
    for axes, (kind, fractions) in zip(
        figure.subplots(1, 2), (("block", True), ("pendulum", False))
    ):
        for i, (estimate, name) in enumerate(ESTIMATES.items()):
            found = list(groups(rows, kind, fractions))
            shares = [low(some, "peak", estimate) for _, some in found]
            color = plotting.COLORS[i]
            axes.plot([value for value, _ in found], shares, "o-", color=color, ms=4, label=name)
        title = "Blocks" if fractions else f"Pendulums of {PERIOD:g} s"
        axes.set(ylim=(0, 104), ylabel="peak is low [%]", title=title)
        axes.set_xlabel("mu g / PGA [\N{MINUS SIGN}]" if fractions else "mu [\N{MINUS SIGN}]")
    figure.axes[0].legend(loc="lower right", fontsize=9)
    return figure


PICTURES = {
    DOCS / "images" / "one_axis_estimates.png": draw_estimates_of_blocks,
    DOCS / "images" / "one_axis_low.png": draw_low,
}


def main() -> None:
    if stations():
        store(measure())
    else:
        print(f"no $STICKSLIP_RECORDS with {PAIRS} and {STATION}: {MEASURED.name} stays as it is")
    rows = stored()
    figures = {file: partial(draw, rows) for file, draw in PICTURES.items()}
    rewrite(PAGE, tables(rows).values(), figures)


if __name__ == "__main__":
    main()
