"""Measures what each refinement of a slider changes, for docs/refinements.md.

    python docs/measure_refinements.py

rewrites the tables and the picture of that page. The 18 sample records come with pyslammer (the
extra `records`); the table of a station with a vertical component needs GeoNet's file of Te Mara
Farm in the folder that $STICKSLIP_RECORDS names, and stays as it is without it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING

import numpy as np
import stickslip as ss
from measured_page import (
    DOCS,
    STATION,
    G,
    components,
    flat,
    rewrite,
    samples,
    spread,
    station,
    table,
    triples,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PAGE = DOCS / "refinements.md"
PICTURE = DOCS / "images" / "refinements.png"

SLIDES = 1e-3  # [m]; smaller displacements give no ratio
LAW = {"mu_slow": 0.03, "mu_fast": 0.06, "rate": 100}  # Kumar et al.
PTFE = {"mu_slow": 0.085, "mu_fast": 0.163, "rate": 0.77 / 0.0254}  # OpenSees, 0.77 s/in
PERIOD, RADIUS = 3.0, G * (3.0 / (2 * math.pi)) ** 2  # of floors and pendulums [s], [m]


# ---- ratios


@dataclass(frozen=True)
class Pair:
    """A refined slider and the plain one, whose ground motion may be changed."""

    name: str
    refined: object
    against: str
    plain: object
    plain_motion: Callable[[ss.GroundMotion], ss.GroundMotion] = lambda motion: motion
    contact: str = "flight"  # of the refined slider


@dataclass(frozen=True)
class Ratios:
    """Peaks and residuals of the refined and the plain slider [m], a row for each ground motion."""

    peak: np.ndarray  # (motions, 2)
    residual: np.ndarray

    def ratio(self, of: np.ndarray) -> np.ndarray:
        slid = of[:, 1] >= SLIDES
        return of[slid, 0] / of[slid, 1]


def measure(pair: Pair, motions: Iterable[ss.GroundMotion]) -> Ratios:
    """Both sliders, until they rest."""
    rows = []
    for motion in motions:
        refined = ss.integrate(pair.refined, motion, settle=True, contact=pair.contact)
        plain = ss.integrate(pair.plain, pair.plain_motion(motion), settle=True)
        rows.append((refined.peak, plain.peak, abs(refined.residual), abs(plain.residual)))
    found = np.array(rows)
    return Ratios(found[:, :2], found[:, 2:])


def summary(pair: Pair, motions: Iterable[ss.GroundMotion]) -> list[str]:
    found = measure(pair, motions)
    slid = (found.peak >= SLIDES).sum(axis=0)
    peak, residual = found.ratio(found.peak), found.ratio(found.residual)
    return [
        pair.name,
        pair.against,
        f"{slid[1]}, {slid[0]}",
        *spread(peak),
        f"{peak.min():.2f} to {peak.max():.2f}",
        *spread(residual),
    ]


COLUMNS = (
    "against | slide: plain, refined | peak: median | 16 to 84 % | extremes |"
    " residual: median | 16 to 84 % |"
)


def against(name: str, refined: object, mu: float, spring: bool = False) -> Pair:
    """A slider beside one with a constant coefficient."""
    plain = floor(ss.Coulomb(mu=mu)) if spring else ss.Coulomb(mu=mu)
    return Pair(name, refined, f"{mu:.3g}", plain)


def static(mu: float) -> ss.StaticKinetic:
    return ss.StaticKinetic(mu_static=mu / 0.75, mu_kinetic=mu)


def degrading(distance: float, first: float, last: float) -> ss.Degrading:
    return ss.Degrading(distance=[0, distance], mu=[first, last])


BLOCKS = (
    against("static 0.133, kinetic 0.1", static(0.1), 0.1),
    against("the same", static(0.1), 0.1 / 0.75),
    against("static 0.267, kinetic 0.2", static(0.2), 0.2),
    against("the same", static(0.2), 0.2 / 0.75),
    against(
        "Stribeck, 0.133 to 0.1, 0.05 m/s",
        ss.Stribeck(mu_static=0.1 / 0.75, mu_kinetic=0.1, velocity=0.05, exponent=1),
        0.1,
    ),
    against("PTFE, 0.085 to 0.163, 30.3 s/m", ss.VelocityDependent(**PTFE), 0.163),
    against("the same", ss.VelocityDependent(**PTFE), 0.085),
    against("falls, 0.2 to 0.133 in 10 cm", degrading(0.1, 0.2, 0.2 / 1.5), 0.2),
    against("falls, 0.2 to 0.133 in 1 cm", degrading(0.01, 0.2, 0.2 / 1.5), 0.2),
    against("steel on mortar, rises, 0.5 to 0.8 in 10 cm", degrading(0.1, 0.5, 0.8), 0.5),
)


def floor(law: object, **more: object) -> ss.Slider:
    return ss.Slider(law, period=PERIOD, **more)


LINER = ss.VelocityDependent(**LAW)
PLAIN = floor(ss.Coulomb(mu=0.06))
FLOORS = (
    against("speed, 0.03 to 0.06, 100 s/m", floor(LINER), 0.06, spring=True),
    against("the same", floor(LINER), 0.03, spring=True),
    against(
        "static 0.08, kinetic 0.06",
        floor(ss.StaticKinetic(mu_static=0.08, mu_kinetic=0.06)),
        0.06,
        spring=True,
    ),
    Pair("damping 10 %", floor(ss.Coulomb(mu=0.06), damping_ratio=0.1), "undamped", PLAIN),
    Pair(
        "stops at 10 cm, restitution 0.3",
        floor(ss.Coulomb(mu=0.06), stops=ss.Stops(gap=0.1, restitution=0.3)),
        "no stops",
        PLAIN,
    ),
    Pair("no spring", ss.Coulomb(mu=0.06), "spring", PLAIN),
)


def slope(degrees: float, ky_g: float = 0.1) -> tuple[ss.Slider, ss.Coulomb]:
    """A block on a slope that yields downhill at ky, and the same with a constant normal force.

    The second slides along x'' = -n cos(th) - level; neither slides uphill.
    """
    th = math.radians(degrees)
    mu = math.tan(th + math.atan(ky_g))
    level = G * (mu * math.cos(th) - math.sin(th))
    full = ss.Slider(ss.Coulomb(mu=mu), slope_degrees=degrees, one_way=True)
    return full, ss.Coulomb(slip_level=level, backward=math.inf)


def slope_pair(degrees: float) -> Pair:
    full, constant = slope(degrees)
    cosine = math.cos(math.radians(degrees))
    return Pair(
        f"{degrees} degrees, mu = {full.law.slip_level / G:.3f}",
        full,
        "constant normal force",
        constant,
        plain_motion=lambda motion: motion.scaled(cosine),
    )


SLOPES = tuple(slope_pair(degrees) for degrees in (10, 20, 30))


def both(motions: Iterable[ss.GroundMotion]) -> list[ss.GroundMotion]:
    """Each motion in both polarities, for sliders that move downhill alone."""
    return [m for motion in motions for m in (motion, -motion)]


# ---- vertical motion


def shaken(name: str, slider: object, plain: object = None, **more: object) -> Pair:
    """With the vertical component against without it."""
    return Pair(name, slider, "no vertical", plain or slider, plain_motion=flat, **more)


PENDULUM = ss.FrictionPendulum(radius=RADIUS, mu=0.06)
MIDDLE = ss.Coulomb(mu=0.3)
STEEP = slope(20)[0]
VERTICAL = (
    *(
        (shaken(f"block, mu = {mu}", ss.Coulomb(mu=mu)), pga, ratio)
        for pga, ratio in ((0.4, 2 / 3), (0.4, 1), (0.4, 1.5))
        for mu in (0.1, 0.2, 0.3)
    ),
    (shaken("block, mu = 0.3", MIDDLE), 1.0, 2.0),
    (Pair("block, mu = 0.3, clipped", MIDDLE, "flight", MIDDLE, contact="clipped"), 1.0, 2.0),
    (shaken("pendulum, mu = 0.06", PENDULUM), 0.4, 2 / 3),
    (shaken("pendulum, mu = 0.06", PENDULUM), 0.4, 1),
    (Pair("the same", PENDULUM, "constant spring", PLAIN), 0.4, 1),
    (shaken("slope of 20 degrees, ky = 0.1 g", STEEP), 0.4, 2 / 3),
    (shaken("slope of 20 degrees, ky = 0.1 g", STEEP), 0.4, 1),
)


def of_triples(pair: Pair, pga: float, ratio: float) -> list[str]:
    motions = components(triples(pga, ratio))
    if pair.refined is STEEP:
        motions = both(motions)
    name, *rest = summary(pair, motions)
    return [name, f"{pga:.1f}", f"{ratio:.2f}", *rest]


STATION_SLIDERS = (
    ("block, mu = 0.1", ss.Coulomb(mu=0.1)),
    ("block, mu = 0.3", ss.Coulomb(mu=0.3)),
    ("block, mu = 0.5", ss.Coulomb(mu=0.5)),
    ("pendulum, mu = 0.06", PENDULUM),
    ("slope of 20 degrees, ky = 0.1 g", STEEP),
)


def of_station() -> list[list[str]]:
    """Peak and residual [cm] without and with vertical motion, and what leaves the ground."""
    rows = []
    for motion in station():
        for name, slider in STATION_SLIDERS:
            found = [
                ss.integrate(slider, flat(motion), settle=True),
                *(
                    ss.integrate(slider, motion, settle=True, contact=contact)
                    for contact in ("flight", "clipped")
                ),
            ]
            flights = sum(event["kind"] == "liftoff" for event in found[1].events)
            cells = [f"{100 * r.peak:.1f}, {100 * r.residual:.1f}" for r in found]
            rows.append([motion.orientation, name, *cells, str(flights)])
    return rows


# ---- an isolator and a constant coefficient


@dataclass(frozen=True)
class Isolator:
    """A pendulum under motions, against one of constant mu without vertical motion."""

    name: str
    slider: ss.Slider
    fast: float  # the coefficient that a designer would take
    motions: Callable[[], Iterable[ss.GroundMotion]]


LINERS = ss.FrictionPendulum(radius=RADIUS, **LAW)
ISOLATORS = (
    Isolator("0.03 to 0.06, 18 records", LINERS, 0.06, samples),
    Isolator(
        "0.085 to 0.163, 18 records", ss.FrictionPendulum(radius=RADIUS, **PTFE), 0.163, samples
    ),
    Isolator(
        "0.03 to 0.06, triples, V/H = 2/3", LINERS, 0.06, lambda: components(triples(0.4, 2 / 3))
    ),
    Isolator("0.03 to 0.06, triples, V/H = 1", LINERS, 0.06, lambda: components(triples(0.4, 1))),
)


@dataclass(frozen=True)
class Fit:
    """One motion: what the isolator does, and constant coefficients that reproduce one part."""

    motion: ss.GroundMotion
    peak: float  # [m]
    force: float  # [g], also the peak acceleration of the floor
    mu_of_peak: float  # reproduces the peak; of several the one with the nearest force
    force_ratio: float  # its force over that of the isolator
    peak_ratio: float  # the same of the coefficient that reproduces the force
    compromise: float  # the least larger error of peak and force, of any mu
    at_fast: tuple[float, float]  # ratios of peak and force with the coefficient of fast sliding
    residual_at_fast: float
    under_normal: tuple[float, float, float]  # the three with that coefficient under N(t)


def finely(motion: ss.GroundMotion) -> ss.GroundMotion:
    """At 1 ms, so that the largest sampled force is the largest."""
    return motion.resampled(motion.dt / round(motion.dt / 1e-3))


def zeros(function: Callable[[float], float], at: np.ndarray, values: np.ndarray) -> list[float]:
    """By bisection, to 1e-7, from every change of sign of the values."""
    found = []
    for i in np.flatnonzero(np.sign(values[1:]) != np.sign(values[:-1])):
        low, high, sign = at[i], at[i + 1], np.sign(values[i])
        while high - low > 1e-7:
            middle = (low + high) / 2
            low, high = (middle, high) if np.sign(function(middle)) == sign else (low, middle)
        found.append((low + high) / 2)
    return found


def fit(isolator: Isolator, motion: ss.GroundMotion) -> Fit | None:
    """Nothing, where the isolator moves by less than 1 cm."""
    real = ss.integrate(isolator.slider, finely(motion), settle=True)
    if real.peak < 0.01:
        return None
    real_force = np.abs(real.force).max() / G
    horizontal = flat(motion)

    def constant(mu: float) -> ss.Response:
        return ss.integrate(floor(ss.Coulomb(mu=mu)), horizontal, settle=True)

    def peak(mu: float) -> float:
        return constant(mu).peak / real.peak

    def force(mu: float) -> float:
        r = constant(mu)  # at the reversal at its peak; where nothing slides, that of the ground
        held = horizontal.peak_acceleration / G
        return (mu + r.peak / RADIUS if r.slips else held) / real_force

    mus = isolator.fast * np.geomspace(0.2, 2.5, 100)
    peaks = np.array([peak(mu) for mu in mus])
    forces = np.array([force(mu) for mu in mus])
    of_peak = zeros(lambda mu: peak(mu) - 1, mus, peaks - 1)
    of_force = zeros(lambda mu: force(mu) - 1, mus, forces - 1)

    def worse(mu: float) -> float:
        here = peak(mu), force(mu)
        return max(abs(math.log(ratio)) if ratio > 0 else math.inf for ratio in here)

    best = int(np.argmin([worse(mu) for mu in mus]))
    around = np.linspace(mus[max(best - 1, 0)], mus[min(best + 1, len(mus) - 1)], 41)
    nearest = min(of_peak, key=lambda mu: abs(math.log(force(mu))), default=math.nan)
    peak_ratio = min(map(peak, of_force), key=lambda ratio: abs(math.log(ratio)), default=math.nan)
    real_left = abs(real.residual) if abs(real.residual) >= SLIDES else math.nan
    heavy = ss.FrictionPendulum(radius=RADIUS, mu=isolator.fast)
    under = ss.integrate(heavy, finely(motion), settle=True)
    return Fit(
        motion,
        real.peak,
        real_force,
        nearest,
        math.nan if math.isnan(nearest) else force(nearest),
        peak_ratio,
        math.expm1(min(map(worse, [*around, *of_peak, *of_force]))),
        (peak(isolator.fast), force(isolator.fast)),
        abs(constant(isolator.fast).residual) / real_left,
        (
            under.peak / real.peak,
            np.abs(under.force).max() / G / real_force,
            abs(under.residual) / real_left,
        ),
    )


@cache
def fits(isolator: Isolator) -> tuple[Fit, ...]:
    found = (fit(isolator, motion) for motion in isolator.motions())
    return tuple(one for one in found if one)


def extremes(values: Iterable[float]) -> list[str]:
    """Median and extremes of those that exist."""
    return spread(values, 0, 100)


def of_isolator(isolator: Isolator) -> list[str]:
    found = fits(isolator)
    mus = np.array([one.mu_of_peak for one in found]) / isolator.fast
    off = sum(abs(one.force_ratio - 1) > 0.05 for one in found)
    compromise = np.array([one.compromise for one in found])
    return [
        isolator.name,
        str(len(found)),
        f"{np.nanmin(mus):.2f} to {np.nanmax(mus):.2f}",
        *extremes(one.force_ratio for one in found),
        str(off),
        *extremes(one.peak_ratio for one in found),
        f"{100 * np.median(compromise):.1f}, {100 * compromise.max():.1f}",
        str(sum(compromise <= 0.01)),
    ]


def of_fast(isolator: Isolator) -> list[list[str]]:
    """With constant normal force, and, under vertical motion, with N(t)."""
    found = fits(isolator)
    constant = [(*one.at_fast, one.residual_at_fast) for one in found]
    rows = [[isolator.name, *(cell for ratios in zip(*constant) for cell in extremes(ratios))]]
    if found[0].motion.vertical is not None:
        under = zip(*(one.under_normal for one in found))
        rows.append(["the same, but under N(t)", *(cell for r in under for cell in extremes(r))])
    return rows


# ---- the page


def tables() -> dict[str, str]:
    """By name, the tables that this machine has the files for."""
    found = {
        "blocks": table(f"| block | {COLUMNS}", [summary(pair, samples()) for pair in BLOCKS]),
        "floors": table(f"| floor, 3 s | {COLUMNS}", [summary(pair, samples()) for pair in FLOORS]),
        "slopes": table(
            f"| slope | {COLUMNS}", [summary(pair, both(samples())) for pair in SLOPES]
        ),
        "vertical": table(
            f"| slider | PGA [g] | V/H | {COLUMNS}", [of_triples(*row) for row in VERTICAL]
        ),
        "isolators": table(
            "| isolator, motions | number | mu that gives the peak / fast mu | its force: median"
            " | extremes | off by more than 5 % | mu that gives the force, its peak: median"
            " | extremes | error with the best mu [%]: median, maximum | at most 1 % |",
            [of_isolator(isolator) for isolator in ISOLATORS],
        ),
        "fast": table(
            "| constant mu = fast mu | peak: median | extremes | force: median | extremes"
            " | residual: median | extremes |",
            [row for isolator in ISOLATORS for row in of_fast(isolator)],
        ),
    }
    if station():
        found["station"] = table(
            "| axis | slider | no vertical [cm] | flight | clipped | lift-offs |", of_station()
        )
    return found


def draw_fits() -> Figure:
    """A loop of one isolator, and both ratios of all of them."""
    from stickslip import plotting

    figure = plotting.new_figure(11, 4)
    loops, forces, peaks = figure.subplots(1, 3)
    isolator = ISOLATORS[1]
    shown = next(one for one in fits(isolator) if "PAC" in one.motion.name)
    motion = finely(shown.motion)
    pendulum = ss.FrictionPendulum(radius=RADIUS, mu=shown.mu_of_peak)
    labels = (f"constant mu = {shown.mu_of_peak:.3f}", "mu from 0.085 to 0.163")
    colors = (plotting.VERMILION, plotting.BLUE)
    for slider, label, color in zip((pendulum, isolator.slider), labels, colors):
        r = ss.integrate(slider, motion, settle=True)
        loops.plot(100 * r.displacement, r.force / G, color=color, lw=0.9, label=label)
    loops.set(
        xlabel="displacement [cm]", ylabel="force / weight [\N{MINUS SIGN}]", title="One record"
    )
    loops.legend(loc="upper left", fontsize=8, title=shown.motion.name, title_fontsize=8)
    low, high = loops.get_ylim()
    loops.set_ylim(low, high + 0.3 * (high - low))  # room for the legend
    names = [one.name.replace(", ", "\n") for one in ISOLATORS]
    for axes, attribute, title in (
        (forces, "force_ratio", "Force, if mu reproduces the peak"),
        (peaks, "peak_ratio", "Peak, if mu reproduces the force"),
    ):
        for i, one in enumerate(ISOLATORS):
            ratios = np.array([getattr(f, attribute) for f in fits(one)])
            beside = i + 0.3 * (np.arange(len(ratios)) / len(ratios) - 0.5)
            axes.plot(beside, ratios, ".", color=plotting.COLORS[i], ms=4)
        axes.axhline(1, color=plotting.GRAY, lw=0.8)
        axes.set_xticks(range(len(names)), names, fontsize=7)
        axes.set(title=title, ylabel="constant mu / isolator [\N{MINUS SIGN}]", yscale="log")
        ticks = [0.3, 0.5, 0.7, 1, 1.5, 2] if attribute == "peak_ratio" else [0.7, 0.8, 0.9, 1, 1.1]
        axes.set_yticks(ticks, [str(tick) for tick in ticks])
        axes.minorticks_off()
    return figure


def main() -> None:
    found = tables()
    rewrite(PAGE, found.values(), {PICTURE: draw_fits})
    if "station" not in found:
        print(f"no $STICKSLIP_RECORDS/{STATION}: the table of that station stays as it is")


if __name__ == "__main__":
    main()
