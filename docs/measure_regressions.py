"""Measures regressions beside exact sliding, for docs/regressions.md.

    python docs/measure_regressions.py

rewrites the tables and the picture of that page. The 18 sample records come with pyslammer (the
extra `records`).
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import stickslip as ss
from measured_page import DOCS, G, rewrite, samples, spread, table
from stickslip import regressions

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PAGE = DOCS / "regressions.md"
PICTURE = DOCS / "images" / "regressions.png"

LEVELS = np.geomspace(0.02, 0.5, 50)  # ky [g]
SLIDES = 1e-3  # [m]; smaller displacements are not compared
FLEXIBLE = 0.3  # period of a flexible mass [s], where packages are compared

# Moment magnitudes of the events, as in the flatfiles of NGA, to a tenth.
MAGNITUDES = {
    "Cape Mendocino": 7.0,
    "Chi-Chi": 7.6,
    "Coalinga": 6.4,
    "Coyote Lake": 5.7,
    "Duzce": 7.1,
    "Imperial Valley": 6.5,
    "Kobe": 6.9,
    "Kocaeli": 7.5,
    "Landers": 7.3,
    "Loma Prieta": 6.9,
    "Mammoth Lakes-1": 6.1,
    "Mammoth Lakes-2": 5.7,
    "Morgan Hill": 6.2,
    "N Palm Springs": 6.1,
    "Nahanni": 6.8,
    "Nisqually": 6.8,
    "Northridge": 6.7,
}


class Form(NamedTuple):
    """A model as this page uses it, on a rigid block."""

    name: str
    model: regressions.Regression
    measures: tuple[str, ...]
    arguments: tuple[str, ...] = ()  # M, Ts, Neq, T


FORMS = (
    Form("Ambraseys, Menu 1988", regressions.AmbraseysMenu1988(), ("pga",)),
    Form("Yegian et al. 1991", regressions.YegianEtAl1991(), ("pga",), ("Neq", "T")),
    Form("Jibson et al. 2000", regressions.JibsonEtAl2000(), ("Ia",)),
    Form("Jibson 2007, (6): PGA", regressions.Jibson2007(), ("pga",)),
    Form("Jibson 2007, (7): PGA, M", regressions.Jibson2007(), ("pga",), ("M",)),
    Form("Jibson 2007, (9): Ia", regressions.Jibson2007(), ("Ia",)),
    Form("Jibson 2007, (10): PGA, Ia", regressions.Jibson2007(), ("pga", "Ia")),
    Form("Saygili, Rathje 2008: PGA", regressions.SaygiliRathje2008(), ("pga",)),
    Form("the same: PGA, PGV", regressions.SaygiliRathje2008(), ("pga", "pgv")),
    Form("the same: PGA, Ia", regressions.SaygiliRathje2008(), ("pga", "Ia")),
    Form("the same: PGA, PGV, Ia", regressions.SaygiliRathje2008(), ("pga", "pgv", "Ia")),
    Form("Rathje, Saygili 2009: PGA, M", regressions.RathjeSaygili2009(), ("pga",), ("M",)),
    Form(
        "Rathje, Antonakos 2011: PGA, M",
        regressions.RathjeAntonakos2011(),
        ("pga", "Tm"),
        ("M", "Ts"),
    ),
    Form("the same: PGA, PGV", regressions.RathjeAntonakos2011(), ("pga", "pgv", "Tm"), ("Ts",)),
    Form("Bray, Travasarou 2007", regressions.BrayTravasarou2007(), ("Sa",), ("M", "Ts")),
    Form(
        "Bray, Macedo, Travasarou 2018",
        regressions.BrayMacedoTravasarou2018(),
        ("Sa",),
        ("M", "Ts"),
    ),
    Form("Bray, Macedo 2019", regressions.BrayMacedo2019(), ("Sa", "pgv"), ("M", "Ts")),
    Form(
        "Fotopoulou, Pitilakis 2015, a",
        regressions.FotopoulouPitilakis2015("a"),
        ("pgv",),
        ("M",),
    ),
    Form("the same, b", regressions.FotopoulouPitilakis2015("b"), ("pga",), ("M",)),
    Form("the same, c", regressions.FotopoulouPitilakis2015("c"), ("pga",), ("M",)),
    Form("the same, d", regressions.FotopoulouPitilakis2015("d"), ("pga", "pgv")),
)


@cache
def arguments() -> dict[str, np.ndarray | float]:
    """What no measure of a record gives: one row for each record."""
    suite = samples()
    magnitude = np.array([[MAGNITUDES[event]] for event in suite.metadata["event"].tolist()])
    # Equivalent cycles by magnitude: Seed, Idriss, Makdisi and Banerjee 1975.
    cycles = np.interp(magnitude, [5.25, 6, 6.75, 7.5, 8.5], [2.5, 5.5, 10, 15, 26])
    period = ss.strong_motion(suite).mean_period[:, None]
    return {"M": magnitude, "Ts": 0.0, "Neq": cycles, "T": period}


@cache
def exact() -> np.ndarray:
    """Displacements of one-way sliding [m], shape (records, levels, polarities)."""
    newmark = ss.grid(ss.Coulomb, mu=LEVELS, backward=math.inf)
    found = ss.sweep(newmark, samples(), settle=True).peak
    return np.moveaxis(found, 0, 1)


def predict(form: Form, ts: float = 0.0) -> regressions.Prediction:
    """The prediction of a form for all records and levels, shape (records, levels)."""
    given = {name: {**arguments(), "Ts": ts}[name] for name in form.arguments}
    return form.model.of(samples(), ky=LEVELS, measures=form.measures, **given)


def peak_ground_acceleration() -> np.ndarray:
    """PGA [g], shape (records, 1)."""
    return ss.strong_motion(samples()).peak_acceleration[:, None] / G


# ---- the models beside exact sliding


@dataclass(frozen=True)
class Referee:
    """ln(predicted / exact) of a form where both slide, and what belongs to it."""

    form: Form
    error: np.ndarray  # (points,)
    record: np.ndarray  # index of the record of each point
    r: np.ndarray  # ky / PGA
    sigma: np.ndarray | None  # of the model

    @property
    def bias(self) -> float:
        """Geometric mean of predicted / exact."""
        return math.exp(self.error.mean())

    @property
    def scatter(self) -> float:
        return float(self.error.std())

    @property
    def uncertainty(self) -> float:
        """Standard error of ln bias: the records are the sample, not the points."""
        records = [self.error[self.record == i] for i in np.unique(self.record)]
        shift = [(one - self.error.mean()).sum() for one in records]
        return math.sqrt(sum(x * x for x in shift)) / self.error.size

    def between(self, low: float, high: float) -> float:
        """Geometric mean over points with r in a range."""
        here = self.error[(self.r >= low) & (self.r < high)]
        return math.exp(here.mean())

    @property
    def within(self) -> float | None:
        """Proportion of the points within one sigma of the model; 0.68 if sigma is right."""
        if self.sigma is None:
            return None
        return float((np.abs(self.error) <= self.sigma).mean())


def referee(form: Form) -> Referee:
    """Compare a form with exact sliding; the two polarities are two points."""
    prediction = predict(form)
    pga = peak_ground_acceleration()
    found = exact()
    median = np.broadcast_to(prediction.median[..., None], found.shape)
    use = (found >= SLIDES) & (median > 0)
    try:
        sigma = np.broadcast_to(prediction.sigma[..., None], found.shape)[use]
    except ValueError:
        sigma = None
    record = np.broadcast_to(np.arange(len(samples()))[:, None, None], found.shape)
    r = np.broadcast_to((LEVELS / pga)[..., None], found.shape)
    return Referee(form, np.log(median[use] / found[use]), record[use], r[use], sigma)


@cache
def referees() -> tuple[Referee, ...]:
    return tuple(referee(form) for form in FORMS)


def row(one: Referee) -> list[str]:
    sigma = "unknown" if one.sigma is None else f"{one.sigma.mean():.2f}"
    return [
        one.form.name,
        f"{one.bias:.2f}",
        f"{math.exp(one.uncertainty):.2f}",
        spread(np.exp(one.error))[1],
        f"{one.scatter:.2f}",
        sigma,
        "" if one.within is None else f"{100 * one.within:.0f} %",
        f"{100 * (one.error < 0).mean():.0f} %",
        *(f"{one.between(*r):.2f}" for r in ((0, 0.2), (0.2, 0.5), (0.5, 1))),
    ]


HEADING = (
    "| model | predicted / exact | factor of its standard error | 16 to 84 % | scatter (ln)"
    " | sigma of the model | within sigma | too low | r below 0.2 | 0.2 to 0.5 | above 0.5 |"
)


# ---- public packages


class Variant(NamedTuple):
    """What a package computes instead, as predicted / predicted here."""

    package: str
    model: str
    difference: str
    where: str
    ratio: Callable[[], np.ndarray | float]


def of_form(name: str, index: int = 0) -> Form:
    return [form for form in FORMS if form.name.startswith(name)][index]


def at(name: str, ts: float = FLEXIBLE, index: int = 0) -> regressions.Prediction:
    return predict(FORMS[FORMS.index(of_form(name)) + index], ts)


def other_spectral_period() -> np.ndarray:
    """Bray and Travasarou with Sa at 1.3 Ts."""
    right = at("Bray, Travasarou")
    sa = ss.response_spectrum(samples(), 1.3 * FLEXIBLE).values / G
    wrong = regressions.BrayTravasarou2007().predict(
        ky=LEVELS, Sa=np.reshape(sa, (-1, 1)), Ts=FLEXIBLE, M=arguments()["M"]
    )
    return wrong.median / right.median


def mean_period_for_period() -> np.ndarray:
    """Rathje and Antonakos with Tm in place of Ts."""
    right = at("Rathje, Antonakos")
    given = {name: value for name, value in right.arguments.items() if name != "Ts"}
    wrong = regressions.RathjeAntonakos2011().predict(Ts=given["Tm"], **given)
    both = (right.median > 0) & (wrong.median > 0)
    return wrong.median[both] / right.median[both]


def without_dimension() -> np.ndarray:
    """Yegian's D* taken as centimeters."""
    given = at("Yegian").arguments
    unit = given["pga"] * G * given["Neq"] * given["T"] ** 2
    return 0.01 / unit


def sliding_ratio() -> np.ndarray:
    r = LEVELS / peak_ground_acceleration()
    return r[r < 1]


def least_ratio() -> np.ndarray:
    """Jibson's equation 6 with r of at least 0.05, where it is below."""
    r = sliding_ratio()
    low = r[r < 0.05]
    of_r = regressions.Jibson2007().predict(ky=np.append(low, 0.05), pga=1.0).median
    return of_r[-1] / of_r[:-1]


VARIANTS = (
    Variant(
        "pygeems, `slope_disp.py`",
        "Bray, Travasarou 2007",
        "no magnitude term",
        "all",
        lambda: np.exp(-0.278 * (arguments()["M"] - 7)),
    ),
    Variant(
        "newmark (R), `Dn_BT07.R`",
        "Bray, Travasarou 2007",
        "no term 1.50 Ts",
        "Ts = 0.33 s",
        lambda: math.exp(-1.50 * 0.33),
    ),
    Variant(
        "OpenSRA, `Landslide.py`",
        "Bray, Travasarou 2007",
        "Sa at 1.3 Ts for 1.5 Ts",
        "Ts = 0.3 s",
        other_spectral_period,
    ),
    Variant(
        "SLAMMER",
        "Bray, Travasarou 2007",
        "-1.10 also for rigid masses",
        "Ts < 0.05 s",
        lambda: math.exp(-1.10 + 0.22),
    ),
    Variant(
        "pygeems, `slope_disp.py`",
        "Bray, Macedo, Travasarou 2018",
        "3.535 for 3.353",
        "all",
        lambda: LEVELS ** (3.353 - 3.535),
    ),
    Variant(
        "pygeems, `slope_disp.py`",
        "Rathje, Antonakos 2011: PGA, M",
        "min(3.69 Ts - 1.22 Ts^2, 2.78)",
        "Ts = 2 s",
        lambda: math.exp(3.69 * 2 - 1.22 * 4 - 2.78),
    ),
    Variant(
        "OpenSRA, `Landslide.py`",
        "Rathje, Antonakos 2011: PGA, M",
        "Tm for Ts",
        "Ts = 0.3 s",
        mean_period_for_period,
    ),
    Variant(
        "pynewmarkdisp",
        "Saygili, Rathje 2008: PGA",
        "20.93 for 20.39",
        "r < 1",
        lambda: np.exp(-0.54 * sliding_ratio() ** 2),
    ),
    Variant(
        "OpenQuake, a branch of 2017, `gdem/scalar.py`",
        "Jibson 2007, (6)",
        "ln for log; 0.51 as sigma of ln D",
        "all",
        lambda: math.exp(0.215) / 10**0.215,
    ),
    Variant(
        "the same",
        "Jibson 2007, (9)",
        "ln for log; 0.616 as sigma of ln D",
        "all",
        lambda: math.exp(-3.230) / 10**-3.230,
    ),
    Variant(
        "OpenQuake, `sep/landslide/displacement.py`",
        "Jibson 2007, (6) and others",
        "r of at least 0.05",
        "r < 0.05, (6)",
        least_ratio,
    ),
    Variant(
        "newmark (R), `Dn_YG91.R`",
        "Yegian et al. 1991",
        "D* without its unit, as cm",
        "all",
        without_dimension,
    ),
)


def number(ratio: float) -> str:
    """Two decimals, or two digits."""
    if 0.1 <= ratio < 10:
        return f"{ratio:.2f}"
    return np.format_float_positional(ratio, precision=2, fractional=False, trim="-")


def compared(one: Variant) -> list[str]:
    ratios = np.ravel(one.ratio())
    spread = "" if ratios.size == 1 else f"{number(ratios.min())} to {number(ratios.max())}"
    middle = number(float(np.median(ratios)))
    return [one.package, one.model, one.difference, one.where, middle, spread]


# ---- the page


def tables() -> dict[str, str]:
    return {
        "models": table(HEADING, [row(one) for one in referees()]),
        "packages": table(
            "| package, file | model | difference | where | its D / ours: median | extremes |",
            [compared(one) for one in VARIANTS],
        ),
    }


def figure() -> Figure:
    """One record with all rigid models; predicted / exact of all models."""
    from stickslip import plotting

    figure = plotting.new_figure(11, 5.5)
    curves, intervals = figure.subplots(1, 2, width_ratios=(1, 1.25))
    record = next(i for i, name in enumerate(samples().names) if name.startswith("Kobe"))
    found = 100 * exact()[record]
    curves.fill_between(
        LEVELS,
        found.min(axis=1),
        found.max(axis=1),
        color=plotting.GRAY,
        alpha=0.5,
        lw=0,
        label="exact, both polarities",
    )
    shown = [of_form("Saygili", index) for index in (0,)]
    shown += [FORMS[FORMS.index(shown[0]) + 1], of_form("Ambraseys"), of_form("Jibson 2007, (7)")]
    shown += [of_form("Bray, Travasarou"), of_form("Fotopoulou")]
    styles = ("-", "--")
    for i, form in enumerate(shown):
        name = form.name.replace("the same", "Saygili, Rathje 2008")
        curves.plot(
            LEVELS,
            100 * predict(form).median[record],
            styles[i % 2],
            color=plotting.COLORS[i % len(plotting.COLORS)],
            lw=1.1,
            label=name,
        )
    curves.set(
        xscale="log",
        yscale="log",
        ylim=(1, 2000),
        xlabel="yield acceleration [g]",
        ylabel="displacement [cm]",
        title=samples().names[record],
    )
    curves.set_xticks([0.02, 0.05, 0.1, 0.2, 0.5], ["0.02", "0.05", "0.1", "0.2", "0.5"])
    curves.minorticks_off()
    curves.legend(loc="lower left", fontsize=7)
    for i, one in enumerate(referees()):
        low, left, right, high = np.exp(np.percentile(one.error, (2.5, 16, 84, 97.5)))
        intervals.plot([low, high], [i, i], color=plotting.BLUE, lw=0.8)
        intervals.plot([left, right], [i, i], color=plotting.BLUE, lw=3.5, solid_capstyle="butt")
        intervals.plot(one.bias, i, "o", color=plotting.VERMILION, ms=4)
    labels = [form.name.replace("the same", "    same") for form in FORMS]
    intervals.set_yticks(range(len(FORMS)), labels, fontsize=7)
    intervals.invert_yaxis()
    intervals.axvline(1, color=plotting.GRAY, lw=0.8)
    intervals.set(
        xscale="log",
        xlabel="predicted / exact [\N{MINUS SIGN}]",
        title="18 records, 50 levels, both polarities",
    )
    ticks = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 200]
    intervals.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    intervals.minorticks_off()
    return figure


def main() -> None:
    warnings.simplefilter("ignore", regressions.RangeWarning)  # of the smallest and largest ky
    rewrite(PAGE, tables().values(), {PICTURE: figure})


if __name__ == "__main__":
    main()
