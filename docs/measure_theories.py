"""Measures every theory against simulation, side by side, for docs/theories.md.

    python docs/measure_theories.py [MEMBERS]

rewrites the table of that page. Takes some five minutes with the default of 20,000 members.
"""

from __future__ import annotations

import sys

import stickslip as ss
from measure_transport import Setting
from measured_page import DOCS, rewrite, shaking, shown, table, white

PAGE = DOCS / "theories.md"
MEMBERS = 20_000
SEED = 1

#: The columns: what they are called, and the theories that they show, the first one that applies.
COLUMNS = {
    "`WhiteNoise`": ["WhiteNoise"],
    "`Transport`": ["Transport"],
    "`PulseChain`": ["PulseChain"],
    "`PulseSuperposition`": ["PulseSuperposition, renewal", "PulseSuperposition, none"],
    '`EquivalentLinearization`, `"gaussian"`': ["EquivalentLinearization"],
    '`"laplace"`': ["EquivalentLinearization, laplace"],
    "`StationaryLinearization`": ["StationaryLinearization"],
}

BLOCK = ss.Coulomb(slip_level=1.0)
UNEQUAL = ss.Coulomb(slip_level=1.0, backward=1.5)
CART = ss.Caster(slip_level=1.0, reach=10.0)
LINER = ss.VelocityDependent(slow=0.5, fast=1.0, rate=2.0)
STICKY = ss.StaticKinetic(BLOCK, static=1.5)


def soil(rms: float) -> ss.GaussianExcitation:
    """A Kanai-Tajimi ground of frequency 1."""
    return shaking(Setting(0.6, rms).spectrum(), 0.05, 801)


DAMPER = Setting(0.6, 1.5, content=False)  # no content at zero frequency


def pulses(rate: float, sigma: float) -> ss.PoissonPulses:
    return ss.PoissonPulses(rate=rate, half_width=1.0, sigma=sigma, duration=40.0)


#: Slider, excitation, and what they are called, in the units of the level a, and of S0, the
#: frequency of the ground or the half width of the pulses.
SETTINGS = [
    ("block", "white noise, t = 30", BLOCK, white(0.02, 1501)),
    ("block, levels 1 : 1.5", "white noise, t = 30", UNEQUAL, white(0.02, 1501)),
    ("caster, gamma = 0.1", "white noise, t = 15", CART, white(0.02, 751)),
    ("block", "Kanai-Tajimi, rms / a = 0.6", BLOCK, soil(0.6)),
    ("block", "1.5", BLOCK, soil(1.5)),
    ("block", "6", BLOCK, soil(6.0)),
    ("block, levels 1 : 1.5", "1.5", UNEQUAL, soil(1.5)),
    ("block with static friction 1.5 a", "0.8", STICKY, soil(0.8)),
    ("floor, wn = 0.5", "1.5", ss.Slider(BLOCK, natural_frequency=0.5), soil(1.5)),
    ("floor on liners", "1.5", ss.Slider(LINER, natural_frequency=0.5), soil(1.5)),
    ("caster, reach 10", "1.5", CART, soil(1.5)),
    ("block", "nothing at zero frequency, 1.5", BLOCK, DAMPER),
    ("block, levels 1 : 1.5", "nothing at zero frequency, 1.5", UNEQUAL, DAMPER),
    ("block", "pulses, lambda Dt = 0.1, sigma / a = 2", BLOCK, pulses(0.1, 2.0)),
    ("block", "1, 2", BLOCK, pulses(1.0, 2.0)),
    ("caster, reach 10", "0.1, 2", CART, pulses(0.1, 2.0)),
    ("floor, wn = 0.5", "1, 2", ss.Slider(BLOCK, natural_frequency=0.5), pulses(1.0, 2.0)),
]


def cell(comparison: ss.Comparison, names: list[str]) -> str:
    """Theory over simulation of E[x^2] about its mean, and of E[x'^2]."""
    for name in names:
        if name in comparison.theories:
            found = []
            for statistic in ("displacement_variance", "velocity_variance"):
                ratio, _ = comparison.ratio(name, statistic)
                found.append(f"{ratio[-1]:.2f}")
            return ", ".join(found)
    return ""


def row(setting: tuple, members: int) -> list[str]:
    slider_name, excitation_name, slider, source = setting
    excitation = source
    if source is DAMPER:
        excitation = shaking(DAMPER.spectrum(), 0.05, 801)
    end = excitation.duration
    comparison = ss.compare(slider, excitation, [end], members=members, seed=SEED)
    if source is DAMPER:  # of a function `Transport` does not know the filter
        transport = ss.theory.Transport().predict(slider, DAMPER.filter, [end])
        comparison.theories["Transport"] = transport
    scatter = []
    for statistic in ("displacement_variance", "velocity_variance"):
        value, error = comparison.simulated(statistic)
        scatter.append(100 * error[-1] / value[-1])
    cells = [cell(comparison, names) for names in COLUMNS.values()]
    errors = ", ".join(f"{part:.1f}" for part in scatter)
    return [slider_name, excitation_name, *cells, errors]


HEADING = "| slider | excitation | " + " | ".join(COLUMNS) + " | error of simulation, % |"


def main(members: int) -> None:
    rewrite(PAGE, [table(HEADING, shown(row(setting, members) for setting in SETTINGS))])


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else MEMBERS)
