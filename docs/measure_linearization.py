"""Measures the errors of the linearization theories against ensembles of this library.

    python docs/measure_linearization.py [table ...]

rewrites the tables of caster.md, white_noise.md, planar_white_noise.md, equivalent_linearization.md
and filtered_noise.md, or the named ones. Each row states its parameters, the simulated moments with
their standard errors, and the ratio of theory to simulation; the test recomputes the theory of
every row, and simulates some rows again with fewer members. The table of casters that roll takes
five minutes of processor time, all others together four.
"""

from __future__ import annotations

import itertools
import math
import sys
from collections.abc import Iterator

import numpy as np
import stickslip as ss
from measured_page import DOCS, rewrite, shaking, table, white

LEVEL = 1.0  # of forward sliding [m/s^2], everywhere
EL, SL = ss.theory.EquivalentLinearization, ss.theory.StationaryLinearization

# ---- numbers


def number(value: float, error: float) -> str:
    """A value with its standard error in units of the last digit: 0.397(4), 516(12)."""
    exponent = math.floor(math.log10(error))
    if error / 10**exponent < 1.95:
        exponent -= 1
    power = math.floor(math.log10(value))
    if -3 <= power < 5:
        places = max(-exponent, 0)
        return f"{value:.{places}f}({error * 10**places:.0f})"
    return f"{value / 10**power:.{power - exponent}f}({error / 10**exponent:.0f})e{power}"


def ratio(theory: float, value: float) -> str:
    r = theory / value
    return f"{r:.2g}" if r < 0.095 else f"{r:.2f}"


# ---- excitation


def kanai_tajimi(strength: float, frequency: float, damping: float) -> ss.Spectrum:
    """Of an rms acceleration of `strength` [m/s^2]."""
    unit = ss.Spectrum.kanai_tajimi(s0=1.0, frequency=frequency, damping=damping).variance
    return ss.Spectrum.kanai_tajimi(s0=strength**2 / unit, frequency=frequency, damping=damping)


def band(strength: float, low: float, high: float) -> ss.Spectrum:
    return ss.Spectrum.band_pass(s0=strength**2 / 2 / (high - low), low=low, high=high)


def ensemble(slider, excitation, members: int, seed: int, dt: float | None = None) -> ss.Ensemble:
    return ss.run_ensemble(
        slider,
        excitation,
        members=members,
        seed=seed,
        dt=dt,
        velocity_spectrum=False,
        threads=1,
    )


def beside(e: ss.Ensemble, at: list[int], theories: list[ss.theory.Moments]) -> list[str]:
    """Simulated variances of displacement and velocity at some times, and ratios of theories."""
    row = []
    for name in ("displacement_variance", "velocity_variance"):
        values, errors = getattr(e, name)[at], getattr(e, f"{name}_error")[at]
        row.append(", ".join(map(number, values, errors)))
        row += [", ".join(map(ratio, getattr(m, name), values)) for m in theories]
    return row


def z_of(reach: float, q11, q12, q22):  # (3.30)
    return reach * np.sqrt(q22 / (2 * (q11 * q22 - q12**2)))


# ---- casters under white noise

WHITE_GAMMA = (0.03, 0.01, 0.005, 0.003, 0.002, 0.001)
WHITE_STEPS = {0.03: 0.02, 0.01: 0.05, 0.005: 0.05, 0.003: 0.1, 0.002: 0.1, 0.001: 0.2}
WHITE_ROWS = {  # times in S0 / a^2
    0.03: (2, 4, 8, 16, 32, 64),
    0.01: (10, 20, 40, 60, 100, 150, 250),
    0.005: (20, 40, 70, 120, 200, 300, 500),
    0.003: (40, 80, 120, 200, 300, 450, 700, 1000),
    0.002: (60, 120, 200, 350, 600, 1000, 1500, 2000),
    0.001: (100, 300, 500, 1000, 2000, 3000, 4000),
}


def white_ensemble(gamma: float, duration: float, members: int, seed: int, dt: float | None = None):
    dt = dt or WHITE_STEPS[gamma]
    return ensemble(
        ss.Caster(slip_level=LEVEL, reach=1 / gamma),
        white(dt, round(duration / dt) + 1),
        members,
        seed,
        dt * max(1, round(duration / dt / 2000)),
    )


def white_casters(members: int = 6000) -> Iterator[list[str]]:
    for gamma in WHITE_GAMMA:
        times = WHITE_ROWS[gamma]
        e = white_ensemble(gamma, times[-1], members, 3)
        at = [int(np.argmin(np.abs(e.time - t))) for t in times]
        wheel = ss.Caster(slip_level=LEVEL, reach=1 / gamma)
        m = EL().predict(wheel, 1.0, np.array(times, float))
        z = z_of(wheel.reach, m.displacement_variance, m.covariance, m.velocity_variance)
        for i, (k, t) in enumerate(zip(at, times)):
            yield [
                f"{gamma}",
                f"{t}",
                f"{z[i]:.2g}",
                number(e.displacement_variance[k], e.displacement_variance_error[k]),
                ratio(m.displacement_variance[i], e.displacement_variance[k]),
                number(e.velocity_variance[k], e.velocity_variance_error[k]),
                ratio(m.velocity_variance[i], e.velocity_variance[k]),
            ]


# ---- the plane and other numbers of dimensions, in units of a and D = pi S0

PLANE = [
    # dimensions, spring [a^2 / D], times [D / a^2], longest step
    *((d, 0.0, (1.0, 10.0, 100.0), 0.1) for d in (1, 2, 3)),
    *((d, spring, (100.0,), 0.1) for spring in (0.2, 1.0) for d in (1, 2, 3)),
]


def sliding_in(dimensions: int, spring: float, time: float, h: float, members: int, seed: int):
    """Squares of displacement and velocity of a component at a time, each as (value, error).

    From rest, by a program that shares no code with the library: the increments of the velocity are
    Gaussian, with the variance 2 D h, and friction reduces the speed by a h, not below zero. The
    same noise in steps of h and h / 2, and the limit of zero step from both.
    """
    random = np.random.default_rng(seed)
    states = [np.zeros((2, dimensions, members)) for _ in range(2)]

    def step(state, noise, h: float) -> None:
        x, v = state
        x += h / 2 * v
        moved = v + noise - spring**2 * h * x
        speed = np.sqrt((moved**2).sum(axis=0))
        moved *= np.maximum(1 - h / np.maximum(speed, 1e-300), 0)
        x += h / 2 * moved
        v[...] = moved

    for _ in range(round(time / h)):
        first, second = math.sqrt(h) * random.normal(size=(2, dimensions, members))
        step(states[0], first + second, h)
        step(states[1], first, h / 2)
        step(states[1], second, h / 2)
    squares = 2 * (states[1] ** 2).mean(axis=1) - (states[0] ** 2).mean(axis=1)
    return [(float(q.mean()), float(q.std() / math.sqrt(members))) for q in squares]


def plane(members: int = 40_000) -> Iterator[list[str]]:
    for dimensions, spring, times, longest in PLANE:
        slider = ss.Slider(ss.Coulomb(slip_level=LEVEL), natural_frequency=spring)
        exact = ss.theory.WhiteNoise(dimensions=dimensions)
        for time in times:
            h = min(longest, 0.04 * time)
            simulated = sliding_in(dimensions, spring, time, h, members, 23)
            theories = [
                EL("gaussian", dimensions=dimensions),
                EL("laplace", dimensions=dimensions),
            ]
            if spring == 0:
                theories.insert(0, exact)
            found = [t.predict(slider, LEVEL**2 / math.pi, [time]) for t in theories]
            row = [f"{dimensions}", f"{spring:g}", f"{time:g}"]
            for name, (value, error) in zip(
                ("displacement_variance", "velocity_variance"), simulated, strict=True
            ):
                ratios = [ratio(getattr(m, name)[0], value) for m in found]
                row += [number(value, error), *[""] * (3 - len(ratios)), *ratios]
            yield row


# ---- the transition time

TRANSITION_GAMMA = (0.01, 0.005, 0.003, 0.002, 0.001)
TRANSITION_UNTIL = {0.01: 60, 0.005: 110, 0.003: 190, 0.002: 320, 0.001: 800}


def last_above_one(time, z) -> float:
    """When z falls to 1 for the last time, on a straight line between samples."""
    k = int(np.flatnonzero(z > 1)[-1])
    return float(time[k] + (time[k + 1] - time[k]) * (z[k] - 1) / (z[k] - z[k + 1]))


def simulated_transition(gamma: float, members: int, seed: int, dt=None) -> float:
    e = white_ensemble(gamma, TRANSITION_UNTIL[gamma], members, seed, dt)
    late = slice(10, None)
    z = z_of(
        1 / gamma,
        e.displacement_variance[late],
        e.covariance[late],
        e.velocity_variance[late],
    )
    return last_above_one(e.time[late], z)


def linearized_transition(gamma: float, force: str) -> float:
    formula = ss.theory.transition_time(ss.Caster(slip_level=LEVEL, reach=1 / gamma), 1.0).thesis
    times = np.linspace(0.2 * formula, 1.5 * formula, 3000)
    m = EL(force).predict(ss.Caster(slip_level=LEVEL, reach=1 / gamma), 1.0, times)
    z = z_of(1 / gamma, m.displacement_variance, m.covariance, m.velocity_variance)
    return last_above_one(times, z)


def transitions(members: int = 4000, batches: int = 8) -> Iterator[list[str]]:
    for gamma in TRANSITION_GAMMA:
        formula = ss.theory.transition_time(ss.Caster(slip_level=LEVEL, reach=1 / gamma), 1.0)
        found = [simulated_transition(gamma, members, 100 + k) for k in range(batches)]
        mean, error = np.mean(found), np.std(found, ddof=1) / math.sqrt(batches)
        yield [
            f"{gamma}",
            f"{formula.thesis:.1f}",
            f"{formula.with_intercept:.1f}",
            f"{linearized_transition(gamma, 'thesis'):.1f}",
            f"{linearized_transition(gamma, 'gaussian'):.1f}",
            number(mean, error),
            f"{formula.thesis / mean:.2f}",
        ]


# ---- casters under filtered noise

CASTERS = [
    # soil (frequency, damping), sigma_n / a, spring [rad/s], reach [m]
    *itertools.product([(15.0, 0.6)], (1.5, 3.0), (0.0,), (0.03, 0.1, 0.3, 1.0, 3.0)),
    *itertools.product([(15.0, 0.6)], (1.5, 2.0, 3.0), (2.0,), (0.03, 0.1, 0.3, 1.0)),
    *itertools.product([(5.0, 0.3)], (1.5, 3.0), (0.0, 2.0), (0.1, 0.3, 1.0, 3.0)),
]
CASTER_TIMES = (5.0, 20.0)


def run(slider, spectrum, members, seed, times, dt=0.02):
    e = ensemble(slider, shaking(spectrum, dt, round(times[-1] / dt) + 1), members, seed)
    return e, [int(np.argmin(np.abs(e.time - t))) for t in times]


def filtered_casters(members: int = 4000) -> Iterator[list[str]]:
    for soil, strength, spring, reach in CASTERS:
        slider = ss.Slider(ss.Caster(slip_level=LEVEL, reach=reach), natural_frequency=spring)
        spectrum = kanai_tajimi(strength, *soil)
        e, at = run(slider, spectrum, members, 7, CASTER_TIMES)
        m = EL().predict(slider, spectrum, list(CASTER_TIMES))
        z = z_of(reach, m.displacement_variance, m.covariance, m.velocity_variance)
        yield [
            f"{soil[0]:g}, {soil[1]:g}",
            f"{strength:g}",
            f"{spring:g}",
            f"{reach:g}",
            ", ".join(f"{value:.2g}" for value in z),
            *beside(e, at, [m]),
        ]


# ---- the Laplacian density

SOILS = [(15.0, 0.6), (9.0, 0.4), (5.0, 0.3)]
OTHER_SOILS = [(15.0, 0.15), (15.0, 0.9), (15.0, 1.2)]
LAPLACE = [
    # soil, sigma_n / a, spring, backward level
    *itertools.product(SOILS, (1.5, 3.0, 6.0), (0.0, 2.0, 6.0), (1.0,)),
    *itertools.product(SOILS, (1.5, 3.0, 6.0), (0.0, 2.0), (1.5, 2.0, 3.0)),
    *itertools.product(SOILS, (1.5, 3.0, 6.0), (0.0,), (1000.0,)),  # as good as one-way
    *itertools.product(OTHER_SOILS, (1.5, 3.0), (0.0, 2.0), (1.0,)),
]
LAPLACE_TIMES = (5.0, 20.0)


def laplacian(members: int = 4000) -> Iterator[list[str]]:
    for soil, strength, spring, backward in LAPLACE:
        slider = ss.Slider(
            ss.Coulomb(slip_level=LEVEL, backward=backward), natural_frequency=spring
        )
        spectrum = kanai_tajimi(strength, *soil)
        e, at = run(slider, spectrum, members, 11, LAPLACE_TIMES)
        m = EL("laplace").predict(slider, spectrum, list(LAPLACE_TIMES))
        yield [
            f"{soil[0]:g}, {soil[1]:g}",
            f"{strength:g}",
            f"{spring:g}",
            f"{backward:g}",
            *beside(e, at, [m]),
        ]


# ---- structures on a sliding base

STRUCTURES = [
    # sigma_n / a, spring, fraction of the mass in the mode, its frequency [rad/s]
    *itertools.product((1.5, 3.0), (0.0, 2.0), (0.7,), (6.0, 15.0, 40.0)),
    *itertools.product((3.0,), (0.0, 2.0), (0.4, 0.9), (15.0,)),
]
STRUCTURE_SOIL = (15.0, 0.6)
STRUCTURE_TIMES = (5.0, 20.0)


def isolated(spring: float, fraction: float, frequency: float) -> ss.IsolatedStructure:
    """One mode with a damping ratio of 5 % on a base with friction of the level 1 m/s^2."""
    column = ss.Structure.from_modes(
        mass_fractions=[fraction], frequencies=[frequency], damping_ratios=[0.05]
    )
    slider = ss.Slider(ss.Coulomb(slip_level=LEVEL), natural_frequency=spring)
    return ss.IsolatedStructure(slider, column)


def structures(members: int = 2000) -> Iterator[list[str]]:
    for strength, spring, fraction, frequency in STRUCTURES:
        system = isolated(spring, fraction, frequency)
        spectrum = kanai_tajimi(strength, *STRUCTURE_SOIL)
        e, at = run(system, spectrum, members, 17, STRUCTURE_TIMES)
        found = [EL(f).predict(system, spectrum, STRUCTURE_TIMES) for f in ("gaussian", "laplace")]
        settings = (f"{one:g}" for one in (strength, spring, fraction, frequency))
        yield [*settings, *beside(e, at, found)]


# ---- stationary linearization

GROUNDS = {  # name: spectrum of a strength, the frequency of its center [rad/s]
    "band from 0 to 2 rad/s": lambda s: band(s, 0.0, 2.0),
    "band from 2 to 4 rad/s": lambda s: band(s, 2.0, 4.0),
    "band from 1 to 10 rad/s": lambda s: band(s, 1.0, 10.0),
    "Kanai-Tajimi, 5 rad/s, 0.2": lambda s: kanai_tajimi(s, 5.0, 0.2),
    "Kanai-Tajimi, 5 rad/s, 0.6": lambda s: kanai_tajimi(s, 5.0, 0.6),
    "Kanai-Tajimi, 15 rad/s, 0.6": lambda s: kanai_tajimi(s, 15.0, 0.6),
    "Kanai-Tajimi, 30 rad/s, 0.9": lambda s: kanai_tajimi(s, 30.0, 0.9),
    "Kanai-Tajimi, 30 rad/s, 1.2": lambda s: kanai_tajimi(s, 30.0, 1.2),
    "Kanai-Tajimi, 30 rad/s, 1.5": lambda s: kanai_tajimi(s, 30.0, 1.5),
}
STRENGTHS = (1.2, 1.5, 2.0, 3.0)
SPRINGS = (0.0, 1.0, 2.0, 3.0, 5.0, 8.0)
GROUND_STEPS = {
    "band": 0.05,
    "Kanai-Tajimi, 5": 0.02,
    "Kanai-Tajimi, 15": 0.01,
    "Kanai-Tajimi, 30": 0.005,
}


def variance_below(spectrum: ss.Spectrum, frequency: float) -> float:
    """The fraction of the variance of a ground acceleration below a frequency [rad/s]."""
    omega = np.linspace(0, frequency, 20_001)
    return float(2 * np.trapezoid(spectrum(omega), omega) / spectrum.variance)


def stationary(members: int = 150) -> Iterator[list[str]]:
    for (name, make), spring in itertools.product(GROUNDS.items(), SPRINGS):
        dt = next(step for begin, step in GROUND_STEPS.items() if name.startswith(begin))
        cells = []
        for strength in STRENGTHS:
            slider = ss.Slider(ss.Coulomb(slip_level=LEVEL), natural_frequency=spring)
            spectrum = make(strength)
            e = ensemble(slider, shaking(spectrum, dt, 8192), members, 13, 4 * dt)
            v = e.stationary.velocity_variance
            value, error = math.sqrt(v.value), v.error / 2 / math.sqrt(v.value)
            p = SL().predict(slider, spectrum)
            r = p.velocity_std / value
            cells.append(number(r, r * error / value))
        yield [name, f"{spring:g}", f"{variance_below(make(1.0), spring):.2f}", *cells]


# ---- rolling resistance of a caster, constant instead of rolling |tanh(x / reach)|

EVENTS = (
    "moderate near field",
    "moderate very near field",
    "great near field",
    "great very near field",
)
ROLLING_MU, ROLLING_CARTS = (0.005, 0.01, 0.02), (0.1, 0.3, 0.5)


def rolling_cart(mu: float, rolling_mu: float) -> ss.Caster:
    return ss.Caster.from_geometry(mu=mu, trail=0.04, wheel_width=0.032, rolling_mu=rolling_mu)


def along_the_wheel(cart: ss.Caster) -> ss.Law:
    """The cart whose rolling resistance acts on the fraction |tanh(x / reach)| of the distance."""

    def level(x: float, speed: float, direction: int) -> float:
        y = x / cart.reach
        return cart.slip_level / math.cosh(y) + cart.rolling * abs(math.tanh(y))

    return ss.Law(resist=level)


def final_rms(law: object, event: str, members: int) -> float:
    e = ensemble(law, ss.PoissonPulses.event(event), members, 5)
    return float(np.sqrt(np.mean(e.residual**2)))


def rolling(members: int = 400) -> Iterator[list[str]]:
    for event, rolling_mu in itertools.product(EVENTS, ROLLING_MU):
        carts = [rolling_cart(mu, rolling_mu) for mu in ROLLING_CARTS]
        ratios = [
            final_rms(cart, event, members) / final_rms(along_the_wheel(cart), event, members)
            for cart in carts
        ]
        yield [event, f"{rolling_mu}", *(f"{r:.2f}" for r in ratios)]


TABLES = {
    "rolling": ("caster.md", "| event | rolling_mu | mu = 0.1 | 0.3 | 0.5 |", rolling),
    "white": (
        "white_noise.md",
        "| gamma | t a^2 / S0 | predicted z | E[x^2] | ratio | E[x'^2] | ratio |",
        white_casters,
    ),
    "plane": (
        "planar_white_noise.md",
        "| d | spring | t a^2 / D | E[x_i^2] | exact | Gaussian | Laplacian | E[v_i^2] | exact |"
        " Gaussian | Laplacian |",
        plane,
    ),
    "transition": (
        "white_noise.md",
        "| gamma | (3.51) | with the intercept | equations of the thesis | with a21 | simulated |"
        " (3.51) / simulated |",
        transitions,
    ),
    "casters": (
        "equivalent_linearization.md",
        "| soil | sigma_n / a | spring | reach | predicted z | E[x^2] | ratio | E[x'^2] | ratio |",
        filtered_casters,
    ),
    "laplace": (
        "equivalent_linearization.md",
        "| soil | sigma_n / a | spring | backward | E[x^2] | ratio | E[x'^2] | ratio |",
        laplacian,
    ),
    "structures": (
        "equivalent_linearization.md",
        "| sigma_n / a | spring | fraction | frequency | E[x^2] | Gaussian | Laplacian | E[x'^2] |"
        " Gaussian | Laplacian |",
        structures,
    ),
    "stationary": (
        "filtered_noise.md",
        "| ground | spring | variance below it | 1.2 | 1.5 | 2 | 3 |",
        stationary,
    ),
}


def main() -> None:
    for name in sys.argv[1:] or TABLES:
        page, heading, rows = TABLES[name]
        rewrite(DOCS / page, [table(heading, rows())])


if __name__ == "__main__":
    main()
