"""Measures the errors of the transport operator against simulation, for docs/transport.md.

    python docs/measure_transport.py [MEMBERS]

rewrites the tables of that page. Takes some ten minutes with the default of 200,000 members.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import stickslip as ss
from measured_page import DOCS, rewrite, shaking, shown, table

PAGE = DOCS / "transport.md"
MEMBERS = 200_000
LAST = 60.0  # wg t
DT = 0.05  # of the simulation, wg dt: at a tenth of the theory's step


#: Laws other than Coulomb's, in units of a level.
LAWS = {
    "Coulomb": None,
    "liner 0.5 to 1": ss.VelocityDependent(slow=0.5, fast=1.0, rate=2.0),
    "Stribeck 1.3 to 0.8": ss.Stribeck(static=1.3, kinetic=0.8, velocity=0.3, exponent=1),
    "static 1.3": ss.StaticKinetic(ss.Coulomb(slip_level=1.0), static=1.3),
    "static 1.5": ss.StaticKinetic(ss.Coulomb(slip_level=1.0), static=1.5),
    "static 2": ss.StaticKinetic(ss.Coulomb(slip_level=1.0), static=2.0),
}


def level_name(backward: float) -> str:
    return {1.0: "equal", math.inf: "one-way"}.get(backward, f"1 : {backward:.2g}")


def spring_name(frequency: float) -> str:
    return f"{frequency:.2g}" if frequency else "none"


def level_on(slope: float) -> float:
    """The slip level of a block that a ground acceleration of 1 m/s^2 just moves downhill."""
    s, c = math.sin(math.radians(slope)), math.cos(math.radians(slope))
    return (c + ss.STANDARD_GRAVITY * s) / (c - s / ss.STANDARD_GRAVITY)


@dataclass(frozen=True)
class Setting:
    """A block or an isolated floor in the units of its level a and the ground's frequency wg."""

    damping: float  # of the ground
    strength: float  # rms acceleration over a
    backward: float = 1.0  # level over a
    frequency: float = 0.0  # of the spring over wg
    content: bool = True  # of the ground at zero frequency
    law: str = "Coulomb"
    reach: float = 0.0  # of a caster, over a / wg^2
    slope: float = 0.0  # degrees; a is then the lower level, of the ground acceleration

    @property
    def slider(self) -> ss.Slider:
        law = LAWS[self.law] or ss.Coulomb(slip_level=1.0, backward=self.backward)
        if self.slope:
            law = ss.Coulomb(slip_level=level_on(self.slope))
        if self.reach:
            law = ss.Caster(slip_level=1.0, reach=self.reach)
        return ss.Slider(law, natural_frequency=self.frequency or None, slope_degrees=self.slope)

    @property
    def filter(self) -> ss.theory.ShapingFilter:
        """White noise through the ground, or through its damper alone."""
        z, rms = self.damping, self.strength
        spring = 1.0 if self.content else 0.0
        s0 = rms**2 * 2 * z / (math.pi * (spring + 4 * z * z))
        return ss.theory.ShapingFilter(s0, [(0, 2 * z, spring, 2 * z, 1)])

    def spectrum(self) -> ss.Spectrum:
        f = self.filter
        if self.content:
            return ss.Spectrum.kanai_tajimi(s0=f.s0, frequency=1.0, damping=self.damping)
        return ss.Spectrum.from_function(f, high=math.inf)

    @property
    def name(self) -> str:
        ground = "" if self.content else ", none at 0"
        law = self.law if LAWS[self.law] else level_name(self.backward)
        if self.slope:
            law = f"slope of {self.slope:g} degrees"
        if self.reach:
            law = f"caster, reach {self.reach:g}"
        spring = spring_name(self.frequency)
        return f"{self.damping:.2g}{ground} | {self.strength:.2g} | {law} | {spring}"


TABLE = [
    Setting(0.6, 0.5),
    Setting(0.6, 1),
    Setting(0.3, 1.5),
    Setting(0.6, 3),
    Setting(0.4, 6),
    Setting(0.5, 1.5, backward=1.5),
    Setting(0.5, 1.5, backward=math.inf),
    Setting(0.5, 2, frequency=0.3),
    Setting(0.4, 0.8, frequency=0.5),
    Setting(0.3, 1.5, frequency=1),
    Setting(0.4, 1.2, frequency=2),
    Setting(0.4, 1.5, backward=1.5, frequency=0.7),
]


OTHERS = [
    Setting(0.6, 1, law="liner 0.5 to 1"),
    Setting(0.4, 3, law="liner 0.5 to 1"),
    Setting(0.6, 1, frequency=0.5, law="liner 0.5 to 1"),
    Setting(0.6, 1, law="Stribeck 1.3 to 0.8"),
    Setting(0.6, 0.7, law="static 1.3"),
    Setting(0.6, 0.7, law="static 1.5"),
    Setting(0.4, 2, law="static 1.5"),
    Setting(0.6, 1, content=False),
    Setting(0.6, 3, content=False),
    Setting(0.6, 1.5, backward=1.5, content=False),
    Setting(0.6, 1.5, backward=math.inf, content=False),
    Setting(0.6, 1, slope=5),
    Setting(0.4, 3, slope=20),
    Setting(0.4, 2, slope=5, frequency=0.5),
]


LOOSE = [
    Setting(0.3, 1.5, law="static 1.5", frequency=1),
    Setting(0.4, 2, law="static 2", frequency=2),
    Setting(0.5, 1.2, law="static 1.5", frequency=3),
    Setting(0.6, 1, law="static 1.5", frequency=0.2),
    Setting(0.6, 0.8, law="static 1.3", frequency=1),
    Setting(0.6, 1.5, reach=1),
    Setting(0.9, 0.7, reach=1),
    Setting(0.3, 3, reach=3),
    Setting(0.4, 0.7, reach=10),
    Setting(0.6, 6, reach=10),
    Setting(0.3, 1.5, reach=30),
    Setting(0.6, 3, reach=100),
]


@dataclass(frozen=True)
class Pulses:
    """A block or an isolated floor in the units of its level a and the half width of a pulse."""

    rate: float
    sigma: float  # over a
    backward: float = 1.0
    frequency: float = 0.0

    LAST = 30.0

    @property
    def slider(self) -> ss.Slider:
        law = ss.Coulomb(slip_level=1.0, backward=self.backward)
        return ss.Slider(law, natural_frequency=self.frequency or None)

    @property
    def excitation(self) -> ss.PoissonPulses:
        return ss.PoissonPulses(
            rate=self.rate, half_width=1.0, sigma=self.sigma, duration=self.LAST
        )

    @property
    def name(self) -> str:
        level, spring = level_name(self.backward), spring_name(self.frequency)
        return f"{self.rate:.2g} | {self.sigma:.2g} | {level} | {spring}"


PULSES = [
    Pulses(0.1, 1),
    Pulses(0.1, 2),
    Pulses(0.5, 0.5),
    Pulses(1, 1),
    Pulses(1, 2),
    Pulses(5, 1),
    Pulses(0.5, 1, backward=2),
    Pulses(0.5, 1, backward=math.inf),
    Pulses(0.5, 0.5, frequency=0.5),
    Pulses(0.1, 2, frequency=0.5),
    Pulses(1, 1, frequency=1),
    Pulses(1, 3, frequency=0.5),
    Pulses(2, 0.7, frequency=0.3),
    Pulses(0.5, 1, backward=1.5, frequency=0.5),
]

CASTERS = {0.01: 32.8, 0.005: 64.9, 0.003: 115.6, 0.002: 192.9, 0.001: 518.0}  # gamma, first guess
DRIFTS = [0.6, 1.0, 1.5, 3.0]  # rms / a of the damper alone, levels 1 : 1.5


def drawn(count: int, seed: int = 1) -> Iterator[Setting]:
    """Settings at random, half of them with a spring."""
    rng = np.random.default_rng(seed)
    for i in range(count):
        backward = float(rng.choice([1.0, 1.0, rng.uniform(1.1, 2.5), math.inf]))
        yield Setting(
            rng.uniform(0.25, 0.9),
            0.7 * 8 ** rng.random(),
            backward if i % 2 == 0 or math.isfinite(backward) else 1.0,
            0.0 if i % 2 == 0 else 0.3 * 7 ** rng.random(),
        )


def drawn_pulses(count: int, seed: int = 1) -> Iterator[Pulses]:
    """Settings at random whose rms acceleration is at least 0.3 of the level, half of them with a
    spring."""
    rng = np.random.default_rng(seed)
    while count:
        one = Pulses(
            0.05 * 100 ** rng.random(),
            0.32 * 16 ** rng.random(),
            float(rng.choice([1.0, 1.0, 1.0, rng.uniform(1.1, 2.5), math.inf])),
            0.0 if count % 2 == 0 else 0.2 * 8 ** rng.random(),
        )
        if one.sigma * (2 * one.rate) ** 0.5 >= 0.3 and (
            one.frequency == 0 or math.isfinite(one.backward)
        ):
            count -= 1
            yield one


def simulated(setting: Setting, members: int, seed: int = 1) -> ss.Ensemble:
    dt = DT / 4 if setting.law.startswith("static") else DT
    excitation = shaking(setting.spectrum(), dt, round(LAST / dt) + 1)
    return ss.run_ensemble(setting.slider, excitation, members=members, seed=seed, dt=LAST / 4)


def ratio(value: float, value_error: float, over: float, over_error: float) -> tuple[str, bool]:
    """Theory over simulation with both errors, and whether they cover the difference: the stated
    error and three standard errors."""
    part = value / over
    text = f"{part:.3f} ± {value_error / over:.3f} ({1e3 * part * over_error / over:.0f})"
    return text, abs(value - over) <= value_error + 3 * over_error


def row(setting: Setting, members: int, tolerance: float = 0.01) -> tuple[list[str], list[bool]]:
    theory = ss.theory.Transport(tolerance=tolerance).predict(
        setting.slider, setting.filter, [LAST / 4, LAST]
    )
    return beside(setting, theory, simulated(setting, members), [1, 4])


def pulse_row(setting: Pulses, members: int) -> tuple[list[str], list[bool]]:
    times = [setting.LAST / 2, setting.LAST]
    theory = ss.theory.Transport().predict(setting.slider, setting.excitation, times)
    ensemble = ss.run_ensemble(
        setting.slider, setting.excitation, members=members, seed=1, dt=setting.LAST / 2
    )
    return beside(setting, theory, ensemble, [1, 2])


def beside(
    setting: Setting | Pulses,
    theory: ss.theory.TransportPrediction,
    ensemble: ss.Ensemble,
    at: list[int],
) -> tuple[list[str], list[bool]]:
    """The cells of a row at two times of the ensemble, and whether the errors cover each."""
    cells, covered = [setting.name], []

    def add(statistic: str, k: int) -> None:
        text, holds = ratio(
            getattr(theory, statistic)[k],
            getattr(theory.error, statistic)[k],
            getattr(ensemble, statistic)[at[k]],
            getattr(ensemble, statistic + "_error")[at[k]],
        )
        covered.append(holds)
        cells.append(text)

    for statistic in ("displacement_variance", "velocity_variance"):
        for k in (0, 1):
            add(statistic, k)
    if setting.backward != 1 or getattr(setting, "slope", 0):
        add("displacement_mean", 1)
    else:
        cells.append("")
    return [*cells, f"{theory.cost.nodes:,}"], covered


@dataclass(frozen=True)
class Law:
    """A setting and the time of the law of its displacement."""

    setting: Setting
    time: float

    @property
    def name(self) -> str:
        s = self.setting
        return (
            f"{s.strength:.2g} | {level_name(s.backward)} | {spring_name(s.frequency)}"
            f" | {self.time:.2g}"
        )

    def residuals(self, dt: float, members: int) -> np.ndarray:
        samples = round(self.time / dt) + 1
        # Short motions, too, of a process that does not repeat itself within many periods.
        ground = ss.GaussianExcitation(
            self.setting.spectrum(),
            dt,
            samples,
            period=max(4 * samples, round(100 / dt)),
            zero_frequency=True,
            random_amplitudes=True,
        )
        ensemble = ss.run_ensemble(
            self.setting.slider, ground, members=members, seed=5, dt=self.time
        )
        return ensemble.residual


LAWS_OF_X = [
    Law(Setting(0.5, 0.5), 5),
    Law(Setting(0.5, 0.4), 20),
    Law(Setting(0.5, 1.5), 2),
    Law(Setting(0.5, 1.0), 5),
    Law(Setting(0.5, 1.0), 40),
    Law(Setting(0.5, 1.0, backward=2), 15),
    Law(Setting(0.5, 0.8, backward=math.inf), 10),
    Law(Setting(0.5, 0.6, frequency=0.5), 15),
    Law(Setting(0.5, 2, frequency=0.3), 15),
    Law(Setting(0.5, 1, backward=math.inf, frequency=0.5), 10),
]
PARTS = [0.3, 0.1, 0.01, 1e-3, 1e-4]


def unmoved(law: Law, members: int) -> tuple[float, float]:
    """The part of simulated motions that have not slipped, as their time step goes to zero, and
    its error: a step misses some slips, in proportion to its root."""
    coarse, fine = (float(np.mean(law.residuals(dt, members) == 0)) for dt in (DT, DT / 4))
    scatter = math.sqrt((4 * fine * (1 - fine) + coarse * (1 - coarse)) / members)
    return max(2 * fine - coarse, 0.0), scatter + abs(coarse - fine) / 20


def law_row(law: Law, members: int) -> tuple[list[str], list[bool]]:
    """The atom, and the probabilities of |x| beyond what parts of the simulated motions exceed."""
    d = ss.theory.Transport().predict(law.setting.slider, law.setting.filter, [law.time])
    d = d.displacement(law.time)
    atom, atom_error = unmoved(law, members // 10)
    cells = [law.name, f"{d.atom:.4f} ± {d.atom_error:.4f}", f"{atom:.4f} ± {atom_error:.4f}"]
    covered = [abs(d.atom - atom) <= d.atom_error + 3 * atom_error]
    sizes = np.sort(np.abs(law.residuals(DT / 2, members)))
    for part in PARTS:
        level = float(sizes[-round(part * members) - 1])
        value = 1 - d.cdf(level) + d.cdf(-level)
        error = d.error_at(level) + d.error_at(-level)
        if error > value / 2:  # next to the start, or too far out
            cells.append("")
            continue
        text, holds = ratio(value, error, part, math.sqrt(part * (1 - part) / members))
        cells.append(text)
        covered.append(holds)
    return cells, covered


def transition(gamma: float, guess: float) -> tuple[float, float]:
    """The time of z = 1, (3.50), and its error, from times around a guess."""
    cart = ss.Caster(slip_level=1.0, reach=1 / gamma)
    times = guess * np.linspace(0.96, 1.04, 5)
    p = ss.theory.Transport().predict(cart, 1.0, times)
    rest = p.displacement_variance * p.velocity_variance - p.covariance**2
    ln_z = np.log(cart.reach * np.sqrt(p.velocity_variance / (2 * rest)))
    slope = np.polyfit(np.log(times), ln_z, 1)[0]
    time = float(np.interp(0, ln_z[::-1], times[::-1]))
    # z goes with the root of the displacement variance, which has the largest error.
    error = np.max(p.displacement_variance_error / p.displacement_variance)
    return time, float(time * error / (2 * abs(slope)))


def caster_rows() -> Iterator[list[str]]:
    before: tuple[float, float] | None = None
    for gamma, guess in CASTERS.items():
        time, error = transition(gamma, guess)
        printed = ss.theory.transition_time(ss.Caster(slip_level=1.0, reach=1 / gamma), 1.0).thesis
        power = ""
        if before:
            power = f"{math.log(time / before[1]) / math.log(gamma / before[0]):.2f}"
        before = (gamma, time)
        yield [str(gamma), f"{time:.4g} ± {error:.1g}", power, f"{printed:.1f}"]


def drift_rows(members: int) -> Iterator[list[str]]:
    for strength in DRIFTS:
        setting = Setting(0.6, strength, backward=1.5, content=False)
        p = ss.theory.Transport().stationary(setting.slider, setting.filter)
        e = simulated(setting, members)
        # The mean velocity from the displacements at three quarters and at the end.
        (x1, x2), error = e.displacement_mean[[3, 4]], e.displacement_mean_error[4]
        mean, mean_error = (x2 - x1) / (LAST / 4), error / (LAST / 4) * 2**0.5
        digits = max(0, 1 - math.floor(math.log10(mean_error)))
        yield [
            f"{strength:g}",
            f"{p.velocity_mean.value:.4g} ± {p.velocity_mean.error:.1g}",
            f"{mean:.{digits}f} ({round(mean_error * 10**digits)})",
        ]


WHITE_RATIOS = [1, 1.1, 1.5, 2, 3, 5, 8, 10, math.inf]  # of the levels
WHITE_TIMES = np.geomspace(0.1, 3000, 10)  # S0 / a^2
WHITE_TOLERANCES = [0.03, 0.01, 1e-3, 1e-4]
MOMENTS = [
    "displacement_mean",
    "displacement_variance",
    "covariance",
    "velocity_mean",
    "velocity_variance",
]


def part_of_stated(value: float, exact: float, stated: float) -> float:
    """The error over the stated one."""
    return abs(value - exact) / stated


def white_errors(ratio: float, tolerance: float) -> tuple[list[float], float]:
    """Errors of moments under white noise over those stated, and that of the growth rate."""
    block = ss.Coulomb(slip_level=1.0, backward=ratio)
    exact = ss.theory.WhiteNoise(block, 1.0)
    moments = exact.predict(WHITE_TIMES)
    p = ss.theory.Transport(tolerance=tolerance).predict(block, 1.0, WHITE_TIMES)
    parts = [
        part_of_stated(*each)
        for name in MOMENTS
        if ratio != 1 or "mean" not in name
        for each in zip(getattr(p, name), getattr(moments, name), getattr(p.error, name))
    ]
    return parts, part_of_stated(p.growth_rate.value, exact.growth_rate, p.growth_rate.error)


def white_row(tolerance: float) -> list[str]:
    """Of all level ratios: how many errors are within those stated, and the median of their
    ratios."""
    found = [white_errors(ratio, tolerance) for ratio in WHITE_RATIOS]
    moments = [part for parts, _ in found for part in parts]
    growths = [growth for _, growth in found]
    return [f"{tolerance:g}", *counted(moments), *counted(growths)]


def counted(parts: list[float]) -> list[str]:
    within = sum(part <= 1 for part in parts)
    return [f"{within} of {len(parts)}", f"{np.median(parts):.2f}"]


#: Laws of the speed, in units of a level and a speed, with the resistance as a function of the
#: speed.
SPEED_LAWS: dict[str, tuple[ss.Slider, Callable[[Any], Any]]] = {
    "damper": (ss.Slider(ss.Coulomb(slip_level=1.0), damping=0.3), lambda v: 1 + 0.3 * v),
    "hardening": (
        ss.Slider(ss.VelocityDependent(slow=0.5, fast=1.0, rate=2.0)),
        lambda v: 1 - 0.5 * np.exp(-2 * v),
    ),
    "weakening": (
        ss.Slider(ss.VelocityDependent(slow=1.0, fast=0.5, rate=2.0)),
        lambda v: 0.5 + 0.5 * np.exp(-2 * v),
    ),
    "Stribeck, exponent 1": (
        ss.Slider(ss.Stribeck(static=1.3, kinetic=0.8, velocity=0.3, exponent=1)),
        lambda v: 0.8 + 0.5 * np.exp(-v / 0.3),
    ),
    "Stribeck, exponent 2": (
        ss.Slider(ss.Stribeck(static=1.5, kinetic=1.0, velocity=0.5, exponent=2)),
        lambda v: 1 + 0.5 * np.exp(-((v / 0.5) ** 2)),
    ),
}
SPEED_LEVELS = [0.05, 0.3, 2.0]  # S0


def exact_of_speed(resistance: Callable[[Any], Any], s0: float) -> tuple[float, float]:
    """Velocity variance and growth rate under white noise of a block whose friction depends on
    the speed: with D = pi S0, the density is p(v) ~ exp(-U(v) / D), where U' is the resistance, and
    R = 4 int F^2 / (D p) dv over v > 0, where F(v) = int_v^inf u p(u) du."""
    d, last = math.pi * s0, 1.0
    while (u := potential(resistance, np.linspace(0, last, 2001)))[-1] < 60 * d:
        last *= 1.3
    v = np.linspace(0, last, 200_001)
    u = potential(resistance, v)
    step = v[1]
    weight = np.exp(-u / d)
    p = weight / (2 * step * (np.sum(weight) - weight[0] / 2))
    moment = v * p
    after = np.cumsum(((moment[1:] + moment[:-1]) / 2)[::-1])[::-1] * step
    ratio = np.append(after, 0.0) ** 2 / (d * p)
    growth = 4 * step * (np.sum(ratio) - ratio[0] / 2)
    return float(2 * step * np.sum(v * v * p)), float(growth)


def potential(resistance: Callable[[Any], Any], v: np.ndarray) -> np.ndarray:
    middle = resistance((v[1:] + v[:-1]) / 2)
    ends = resistance(v)
    return np.append(0.0, np.cumsum((ends[1:] + ends[:-1] + 4 * middle) / 6 * v[1]))


def speed_row(name: str) -> list[str]:
    """Of a law and all levels of the noise and tolerances: as `white_row`."""
    slider, resistance = SPEED_LAWS[name]
    parts: list[list[float]] = [[], []]
    for s0 in SPEED_LEVELS:
        exact = exact_of_speed(resistance, s0)
        for tolerance in WHITE_TOLERANCES[1:]:
            p = ss.theory.Transport(tolerance=tolerance).stationary(slider, s0)
            for found, value, one in zip((p.velocity_variance, p.growth_rate), exact, parts):
                one.append(part_of_stated(found.value, value, found.error))
    return [name, *counted(parts[0]), *counted(parts[1])]


WHITE_HEADING = (
    "| tolerance | moments within the stated error | median of error / stated |"
    " growth rates within | median |"
)
SPEED_HEADING = (
    "| law | velocity variances within the stated error | median of error / stated |"
    " growth rates within | median |"
)
LAW_HEADING = (
    "| rms / a | levels | wn / wg | wg t | atom | simulated | 30 % | 10 % | 1 % | 0.1 % | 0.01 % |"
)
CASTER_HEADING = "| gamma | z = 1 at | power of gamma from the line above | by (3.51) |"
DRIFT_HEADING = "| rms / a | mean velocity, theory | simulation |"
OTHER_HEADING = (
    "| damping | rms / a | law | wn / wg | E x², wg t = 15 | 60 | E x'², 15 | 60 |"
    " E x, 60 | nodes |"
)
HEADING = (
    "| damping | rms / a | levels | wn / wg | E x², wg t = 15 | 60 | E x'², 15 | 60 | E x, 60 |"
    " nodes |"
)
PULSE_HEADING = (
    "| lambda Dt | sigma / a | levels | wn Dt | E x², t = 15 Dt | 30 Dt | E x'², 15 | 30 |"
    " E x, 30 | nodes |"
)
PULSE_COVERAGE = (
    "| settings under pulses | values | within the stated error and 3 standard errors |"
)
LOOSE_HEADING = (
    "| damping | rms / a | law, tolerance 0.1 | wn / wg | E x², wg t = 15 | 60 | E x'², 15 | 60 |"
    " E x, 60 | nodes |"
)
COVERAGE = "| settings | values | within the stated error and 3 standard errors |"


def coverage(
    heading: str,
    drawn_by: Callable[[int], Iterator[Any]],
    row_of: Callable[[Any, int], tuple[list[str], list[bool]]],
    members: int,
    count: int = 40,
) -> str:
    """How many values of settings at random differ from simulation by no more than their errors."""
    holds: list[bool] = []
    for setting in drawn_by(count):
        cells, covered = row_of(setting, members)
        holds += covered
        print(" | ".join(cells), covered, flush=True)
    return table(
        heading, [[str(count), str(len(holds)), f"{sum(holds)} ({100 * np.mean(holds):.0f} %)"]]
    )


def main(members: int) -> None:
    few = members // 4
    others = (row(setting, few)[0] for setting in OTHERS)
    pulses = (pulse_row(setting, few)[0] for setting in PULSES)

    def loosely(setting: Setting, many: int) -> tuple[list[str], list[bool]]:
        return row(setting, many, tolerance=0.03)

    tables = [
        table(WHITE_HEADING, shown(map(white_row, WHITE_TOLERANCES))),
        table(SPEED_HEADING, shown(map(speed_row, SPEED_LAWS))),
        table(HEADING, shown(row(setting, members)[0] for setting in TABLE)),
        table(LAW_HEADING, shown(law_row(law, 10 * members)[0] for law in LAWS_OF_X)),
        coverage(COVERAGE, drawn, loosely, few),
        table(OTHER_HEADING, shown(others)),
        table(LOOSE_HEADING, shown(row(setting, few, 0.1)[0] for setting in LOOSE)),
        table(CASTER_HEADING, shown(caster_rows())),
        table(DRIFT_HEADING, shown(drift_rows(few))),
        table(PULSE_HEADING, shown(pulses)),
        coverage(PULSE_COVERAGE, drawn_pulses, pulse_row, few),
    ]
    rewrite(PAGE, tables)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else MEMBERS)
