"""Regressions: the authors' examples, limits, units, and the errors of public packages."""

import itertools
import math
import warnings

import numpy as np
import pytest
import stickslip as ss
from stickslip.regressions import (
    AmbraseysMenu1988,
    BrayMacedo2019,
    BrayMacedoTravasarou2018,
    BrayTravasarou2007,
    FotopoulouPitilakis2015,
    Jibson2007,
    JibsonEtAl2000,
    RangeWarning,
    RathjeAntonakos2011,
    RathjeSaygili2009,
    SaygiliRathje2008,
    YegianEtAl1991,
)

pytestmark = pytest.mark.filterwarnings("ignore:.*ky is outside the range")

# Every form with arguments well within its range; ky comes on top.
FORMS = [
    (AmbraseysMenu1988(), {"pga": 0.5}),
    (YegianEtAl1991(), {"pga": 0.5, "Neq": 10, "T": 0.4}),
    (JibsonEtAl2000(), {"Ia": 2.0}),
    (Jibson2007(), {"pga": 0.5}),
    (Jibson2007(), {"pga": 0.5, "M": 6.5}),
    (Jibson2007(), {"Ia": 2.0}),
    (Jibson2007(), {"pga": 0.5, "Ia": 2.0}),
    (SaygiliRathje2008(), {"pga": 0.5}),
    (SaygiliRathje2008(), {"pga": 0.5, "pgv": 40}),
    (SaygiliRathje2008(), {"pga": 0.5, "Ia": 2.0}),
    (SaygiliRathje2008(), {"pga": 0.5, "pgv": 40, "Ia": 2.0}),
    (RathjeSaygili2009(), {"pga": 0.5, "M": 6.5}),
    (RathjeAntonakos2011(), {"pga": 0.5, "M": 6.5, "Ts": 0.3, "Tm": 0.5}),
    (RathjeAntonakos2011(), {"pga": 0.5, "pgv": 40, "Ts": 0.3, "Tm": 0.5}),
    (BrayTravasarou2007(), {"Sa": 0.8, "Ts": 0.3, "M": 6.5}),
    (BrayMacedoTravasarou2018(), {"Sa": 0.8, "Ts": 0.3, "M": 8.0}),
    (BrayMacedo2019(), {"Sa": 0.8, "Ts": 0.3, "M": 6.5}),
    (BrayMacedo2019(), {"Sa": 0.8, "Ts": 0.3, "M": 6.5, "pgv": 130}),
    (FotopoulouPitilakis2015("a"), {"pgv": 40, "M": 6.5}),
    (FotopoulouPitilakis2015("b"), {"pga": 0.5, "M": 6.5}),
    (FotopoulouPitilakis2015("c"), {"pga": 0.5, "M": 6.5}),
    (FotopoulouPitilakis2015("d"), {"pga": 0.5, "pgv": 40}),
]
IDS = [f"{model!r}: {', '.join(given)}" for model, given in FORMS]
every_form = pytest.mark.parametrize(("model", "given"), FORMS, ids=IDS)
RIGID = [(model, given) for model, given in FORMS if "pga" in given and "Ts" not in given]


# ---- the authors' examples


def test_the_worksheet_of_bray_and_travasarou():
    d = BrayTravasarou2007().predict(ky=0.14, Ts=0.33, M=7.5, Sa=0.483)
    assert 100 * d.median == pytest.approx(9.77, abs=0.005)
    assert d.p_zero == pytest.approx(0.01, abs=0.0005)
    assert 100 * d.quantile([0.16, 0.5, 0.84]) == pytest.approx([4.9, 9.7, 18.7], abs=0.05)
    assert d.sigma == 0.66


@pytest.mark.parametrize(
    ("model", "given", "published", "formula"),
    [  # published: rounded or read off a figure
        (RathjeSaygili2009(), {"ky": 0.1, "pga": 0.54, "M": 6.75}, 43, 43.7),
        (RathjeSaygili2009(), {"ky": 0.1, "pga": 0.88, "M": 6.75}, 113, 112.0),
        (SaygiliRathje2008(), {"ky": 0.1, "pga": 0.54, "pgv": 42}, 29, 27.5),
        (SaygiliRathje2008(), {"ky": 0.1, "pga": 0.88, "pgv": 71}, 81, 81.4),
        (
            RathjeAntonakos2011(),
            {"Ts": 0.2, "Tm": 0.45, "pga": 0.35, "ky": 0.05, "M": 7},
            87.5,
            87.7,
        ),
    ],
)
def test_examples_of_rathje_and_others(model, given, published, formula):
    d = 100 * model.predict(**given).median
    assert d == pytest.approx(formula, abs=0.05)
    assert d == pytest.approx(published, rel=0.06)


def test_the_example_of_fotopoulou_and_pitilakis():
    d = FotopoulouPitilakis2015().predict(pgv=14, ky=0.02, M=6.5)
    assert d.median == pytest.approx(0.0401623, abs=5e-8)


# ---- independent evaluations of the formulas, written as in the papers


def test_jibson():
    r = 0.1 / 0.5
    cm = {
        (("pga", 0.5),): 10 ** (0.215 + math.log10((1 - r) ** 2.341 * r**-1.438)),
        (("pga", 0.5), ("M", 6.5)): 10
        ** (-2.710 + math.log10((1 - r) ** 2.335 * r**-1.478) + 0.424 * 6.5),
        (("Ia", 2.0),): 10 ** (2.401 * math.log10(2) - 3.481 * math.log10(0.1) - 3.230),
        (("pga", 0.5), ("Ia", 2.0)): 10 ** (0.561 * math.log10(2) - 3.833 * math.log10(r) - 1.474),
    }
    sigmas = (0.510, 0.454, 0.656, 0.616)
    for (given, expected), sigma in zip(cm.items(), sigmas):
        d = Jibson2007().predict(ky=0.1, **dict(given))
        assert 100 * d.median == pytest.approx(expected, rel=1e-13)
        assert d.sigma == pytest.approx(sigma * math.log(10), rel=1e-13)


def test_the_failure_probability_of_jibson_and_others():
    p = JibsonEtAl2000.failure_probability
    assert p(0.05) == pytest.approx(0.335 * (1 - math.exp(-0.048 * 5**1.565)), rel=1e-13)
    assert p(0) == 0
    assert p([1, 100]) == pytest.approx([0.335, 0.335], rel=1e-12)
    with pytest.raises(ValueError, match=r"at least 0 and finite, got -1"):
        p(-1)


def test_the_displacement_of_yegian_has_the_dimension_of_pga_neq_t_squared():
    """Twice the period is four times the displacement, in any units of length."""
    model, r = YegianEtAl1991(), 0.3
    d = model.predict(ky=r * 0.4, pga=0.4, Neq=10, T=0.5)
    normalized = 10 ** (0.22 - 10.12 * r + 16.38 * r**2 - 11.48 * r**3)
    assert d.median == pytest.approx(normalized * 0.4 * 9.80665 * 10 * 0.25, rel=1e-13)
    for change, factor in (({"T": 1.0}, 4), ({"Neq": 20}, 2), ({"pga": 0.8, "ky": 0.24}, 2)):
        other = model.predict(**{"ky": 0.12, "pga": 0.4, "Neq": 10, "T": 0.5} | change)
        assert other.median == pytest.approx(factor * d.median, rel=1e-12)
    # One-way sliding on rectangular pulses is the most that any cycle does: D* < 1/4 per cycle.
    assert normalized < 0.25


def test_the_models_of_saygili_and_rathje_agree_about_a_typical_earthquake():
    """The form of PGA alone is the form of PGA and M at the mean magnitude of the same records.

    So the magnitude that it implies must not depend on r. With 20.93 instead of 20.39 it would fall
    from 6.74 to 6.22.
    """
    r = np.linspace(0.05, 0.9, 50)
    alone = SaygiliRathje2008().predict(ky=0.4 * r, pga=0.4).median
    at_six = RathjeSaygili2009().predict(ky=0.4 * r, pga=0.4, M=6).median
    implied = 6 + np.log(alone / at_six) / 0.89
    assert np.ptp(implied) < 0.08
    assert implied.mean() == pytest.approx(6.77, abs=0.01)
    wrong = 6 + np.log(alone * np.exp(-0.54 * r**2) / at_six) / 0.89
    assert np.ptp(wrong) > 0.4


# ---- errors of public packages: each would be seen


def test_the_magnitude_term_of_bray_and_travasarou_is_there():
    d = [BrayTravasarou2007().predict(ky=0.14, Ts=0.33, M=M, Sa=0.483).median for M in (7, 7.5)]
    assert d[0] / d[1] - 1 == pytest.approx(-0.13, abs=0.005)  # what one package drops


def test_the_period_term_of_bray_and_travasarou_is_there():
    with_term = BrayTravasarou2007().predict(ky=0.14, Ts=0.33, M=7.5, Sa=0.483).median
    without = with_term * math.exp(-1.5 * 0.33)
    assert without / with_term - 1 == pytest.approx(-0.39, abs=0.002)
    assert abs(100 * without - 9.77) > 3  # the authors' example would not be met


def test_rigid_slopes_have_their_own_constant():
    given = {"ky": 0.1, "M": 7, "Sa": 0.5}
    below = BrayTravasarou2007().predict(Ts=0.05 - 1e-12, **given).median
    above = BrayTravasarou2007().predict(Ts=0.05, **given).median
    assert below / above == pytest.approx(math.exp(1.10 - 0.22), rel=1e-10)


def test_the_first_coefficient_of_subduction_is_3_353():
    """d ln D / d ln ky at Sa = 1 is -3.353 - 2 * 0.390 ln ky: digits swapped, it is 3.535."""
    ky, h = 0.1, 1e-5
    d = BrayMacedoTravasarou2018().predict(ky=[ky, ky * math.exp(h)], Sa=1.0, Ts=0.3, M=8)
    slope = np.diff(np.log(d.median))[0] / h
    assert slope == pytest.approx(-3.353 - 2 * 0.390 * math.log(ky), abs=1e-4)


def test_the_term_of_flexible_slopes_does_not_fall_beyond_its_limit():
    """min(3.69 Ts - 1.22 Ts^2, 2.78) falls again beyond 1.6 s: by 24 % at 2 s."""
    given = {"ky": 0.05, "pga": 0.35, "M": 7}
    d = [RathjeAntonakos2011().predict(Ts=Ts, Tm=Ts / 0.09, **given) for Ts in (1.6, 2.0)]
    assert d[0].median == pytest.approx(d[1].median, rel=1e-12)  # Ts / Tm < 0.1: kmax = pga
    rigid = RathjeSaygili2009().predict(**given)
    assert d[1].median / rigid.median == pytest.approx(math.exp(2.78), rel=1e-12)
    assert math.exp(3.69 * 2 - 1.22 * 4 - 2.78) - 1 == pytest.approx(-0.24, abs=0.005)


def test_each_form_of_rathje_and_antonakos_has_its_own_term():
    """With the two terms exchanged the authors' example would be off by a third."""
    given = {"Ts": 0.2, "Tm": 2.5, "pga": 0.35, "ky": 0.05}  # Ts / Tm < 0.1
    by_magnitude = RathjeAntonakos2011().predict(M=7, **given).median
    by_velocity = RathjeAntonakos2011().predict(pgv=40, **given).median
    rigid = RathjeSaygili2009().predict(ky=0.05, pga=0.35, M=7).median
    assert by_magnitude / rigid == pytest.approx(math.exp(3.69 * 0.2 - 1.22 * 0.04), rel=1e-12)
    rigid = SaygiliRathje2008().predict(ky=0.05, pga=0.35, pgv=40).median
    assert by_velocity / rigid == pytest.approx(math.exp(1.42 * 0.2), rel=1e-12)


def test_logarithms_to_base_10_are_not_natural_ones():
    given = {"ky": 0.1, "pga": 0.5}
    wrong = 0.01 * math.exp(0.215 + math.log(0.8**2.341 * 0.2**-1.438))
    right = Jibson2007().predict(**given).median
    assert right / wrong == pytest.approx(10**0.215 / math.exp(0.215), rel=1e-12)  # 1.32


def test_the_displacement_of_yegian_is_not_in_centimeters_before_it_is_multiplied():
    d = YegianEtAl1991().predict(ky=0.1, pga=0.5, Neq=10, T=0.4)
    polynomial = 0.01 * 10 ** (0.22 - 10.12 * 0.2 + 16.38 * 0.04 - 11.48 * 0.008)
    assert d.median / polynomial == pytest.approx(100 * 9.80665 * 0.5 * 10 * 0.16, rel=1e-12)


# ---- laws that all of them obey


@every_form
def test_the_displacement_falls_with_the_yield_acceleration(model, given):
    ky = np.geomspace(0.02, 0.45, 60)
    d = model.predict(ky=ky, **given)
    if repr(model) == "FotopoulouPitilakis2015('c')":  # + 7.844 ky: turns at ky = 2.165 / 7.844
        ky_turn = 2.165 / 7.844
        d = model.predict(ky=ky[ky < ky_turn], **given)
    falls = np.diff(d.median)
    assert (falls[d.median[:-1] > 0] < 0).all()
    assert (np.diff(d.p_zero) >= 0).all()


@every_form
def test_the_displacement_grows_with_the_ground_motion(model, given):
    ky = np.geomspace(0.02, 0.3, 20)
    measures = {name: given[name] for name in ("pga", "pgv", "Ia", "Sa") if name in given}
    stronger = {name: 1.2 * value for name, value in measures.items()}
    more = model.predict(ky=ky, **given | stronger)
    assert (more.median > model.predict(ky=ky, **given).median).all()
    assert (more.p_zero <= model.predict(ky=ky, **given).p_zero).all()


@pytest.mark.parametrize(
    ("model", "given"), RIGID, ids=[f"{m!r}: {', '.join(g)}" for m, g in RIGID]
)
def test_nothing_slides_where_the_yield_acceleration_reaches_the_pga(model, given):
    d = model.predict(ky=[0.49999, 0.5, 0.7], **given)
    assert d.median[0] > 0 and d.p_zero[0] == 0
    assert (d.median[1:] == 0).all() and (d.p_zero[1:] == 1).all()
    if model != FotopoulouPitilakis2015("d"):
        assert (d.quantile(0.99)[1:] == 0).all()
        assert (d.exceedance(1e-9)[1:] == 0).all()


@every_form
def test_arguments_broadcast(model, given):
    ky = np.array([0.05, 0.1, 0.2])
    name = next(iter(given))
    rows = {**given, name: np.array([[1.0], [1.1]]) * given[name]}
    d = model.predict(ky=ky, **rows)
    assert d.median.shape == d.p_zero.shape == (2, 3)
    for i, j in itertools.product(range(2), range(3)):
        one = model.predict(ky=ky[j], **{**given, name: rows[name][i, 0]})
        assert isinstance(one.median, float)
        assert one.median == pytest.approx(d.median[i, j], rel=1e-14)
        assert one.p_zero == pytest.approx(d.p_zero[i, j], rel=1e-14)


@every_form
def test_quantiles_and_exceedance_are_inverse(model, given):
    d = model.predict(ky=[0.05, 0.1, 0.2], **given)
    if model == FotopoulouPitilakis2015("d"):
        with pytest.raises(ValueError, match="gives a sigma for this form"):
            d.quantile(0.5)
        return
    p = np.array([0.05, 0.16, 0.5, 0.84, 0.99])
    quantiles = d.quantile(p)
    assert quantiles.shape == (5, 3)
    for j, one in enumerate(quantiles.T):
        slides = p > d.p_zero[j]
        found = d.exceedance(one[slides])[:, j]
        assert found == pytest.approx(1 - p[slides], abs=1e-12)
        assert (one[~slides] == 0).all()


def test_the_whole_distribution_includes_zero():
    d = BrayTravasarou2007().predict(ky=0.3, Ts=0.33, M=7, Sa=0.3)
    assert d.p_zero > 0.5
    assert d.quantile(0.5) == 0 and d.quantile(0.999 * d.p_zero) == 0
    middle = d.p_zero + (1 - d.p_zero) / 2
    assert d.quantile(middle) == pytest.approx(d.median, rel=1e-12)
    assert d.exceedance(1e-12) == pytest.approx(1 - d.p_zero, rel=1e-12)


def test_kmax_takes_the_place_of_the_pga_in_flexible_slopes():
    """Long masses move as one: kmax falls far below the PGA, and nothing slides."""
    d = RathjeAntonakos2011().predict(ky=0.3, pga=0.5, M=7, Ts=2.0, Tm=0.4)
    assert d.median == 0 and d.p_zero == 1
    rigid = RathjeAntonakos2011().predict(ky=0.1, pga=0.5, pgv=40, Ts=0, Tm=0.4)
    assert rigid.median == pytest.approx(
        SaygiliRathje2008().predict(ky=0.1, pga=0.5, pgv=40).median, rel=1e-14
    )


def test_velocity_acts_above_115_cm_s_in_bray_and_macedo():
    given = {"ky": 0.1, "Sa": 0.8, "Ts": 0.3, "M": 6.5}
    plain = BrayMacedo2019().predict(**given).median
    assert BrayMacedo2019().predict(pgv=115, **given).median == plain
    fast = BrayMacedo2019().predict(pgv=200, **given).median
    assert fast / plain == pytest.approx(200 * math.exp(-4.75), rel=1e-13)


# ---- measures from a record


@pytest.fixture(scope="module")
def kobe(pyslammer_files):
    return ss.sample_record("Kobe")


def test_measures_come_from_the_record_in_the_units_of_the_papers(kobe):
    strong = ss.strong_motion(kobe)
    d = SaygiliRathje2008().of(kobe, ky=0.1, measures=("pga", "pgv", "Ia"))
    assert d.arguments == {
        "ky": 0.1,
        "pga": strong.peak_acceleration / ss.STANDARD_GRAVITY,
        "pgv": 100 * strong.peak_velocity,
        "Ia": strong.arias_intensity,
    }
    assert d == SaygiliRathje2008().predict(**d.arguments)
    d = RathjeAntonakos2011().of(kobe, ky=0.1, Ts=0.3, M=6.9)
    assert d.arguments["Tm"] == strong.mean_period


@pytest.mark.parametrize(
    ("model", "factor"),
    [(BrayTravasarou2007(), 1.5), (BrayMacedoTravasarou2018(), 1.5), (BrayMacedo2019(), 1.3)],
)
def test_spectral_accelerations_are_at_the_degraded_period(kobe, model, factor):
    periods = np.array([0.2, 0.0, 0.6, 0.2])
    d = model.of(kobe, ky=0.1, Ts=periods, M=7)
    spectrum = ss.response_spectrum(kobe, factor * periods, 0.05).values / ss.STANDARD_GRAVITY
    assert d.arguments["Sa"] == pytest.approx(spectrum, rel=1e-14)
    assert d.arguments["Sa"][1] == pytest.approx(
        kobe.peak_acceleration / ss.STANDARD_GRAVITY, rel=1e-14
    )


@pytest.mark.parametrize(("model", "given"), FORMS, ids=IDS)
def test_a_suite_gives_an_axis_of_records(pyslammer_files, model, given):
    suite = ss.sample_records()[:3]
    others = {name: given[name] for name in ("M", "Ts", "Neq", "T") if name in given}
    measures = set(given) - set(others)
    ky = np.array([0.05, 0.1])
    table = model.of(suite, ky=ky, measures=sorted(measures), **others)
    assert table.median.shape == (3, 2)
    for record, row in zip(suite, table.median):
        one = model.of(record, ky=ky, measures=sorted(measures), **others)
        assert row == pytest.approx(one.median, rel=1e-13)


def test_a_suite_takes_a_magnitude_for_each_record(pyslammer_files):
    suite = ss.sample_records()[:3]
    magnitude = np.array([6.0, 6.5, 7.0])
    table = BrayTravasarou2007().of(suite, ky=[0.1, 0.2], Ts=[0.2, 0.4], M=magnitude[:, None])
    assert table.median.shape == (3, 2)
    one = BrayTravasarou2007().of(suite[1], ky=[0.1, 0.2], Ts=[0.2, 0.4], M=6.5)
    assert table.median[1] == pytest.approx(one.median, rel=1e-13)
    with pytest.raises(ValueError, match="at most the dimensions of ky, 0, got 1"):
        BrayTravasarou2007().of(suite, ky=0.1, Ts=[0.2, 0.4], M=7)


def test_both_polarities_have_the_same_measures(kobe):
    d = [BrayMacedo2019().of(motion, ky=0.1, Ts=0.3, M=7) for motion in (kobe, -kobe)]
    assert d[0].median == pytest.approx(d[1].median, rel=1e-13)


# ---- bad input


def test_velocities_in_meters_are_warned_of():
    with pytest.warns(ss.PlausibilityWarning, match="pgv = 0.42 cm/s .* in m/s, give pgv=42"):
        SaygiliRathje2008().predict(ky=0.1, pga=0.5, pgv=0.42)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"ky": 0.1, "pga": 5.3 * 9.8}, r"pga = 51.94 g .* in m/s\^2, give pga=5\.296"),
        ({"ky": 0.1, "Ia": 250.0}, r"Ia = 250 m/s .* in cm/s, give Ia=2\.5"),
    ],
)
def test_other_units_are_warned_of(given, words):
    with pytest.warns(ss.PlausibilityWarning, match=words):
        Jibson2007().predict(**given)


def test_an_argument_outside_the_range_is_warned_of():
    with pytest.warns(
        RangeWarning, match=r"M is outside the range of the model, 5.3 to 7.6, got 8"
    ):
        Jibson2007().predict(ky=0.1, pga=0.5, M=[6, 8])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        Jibson2007().predict(ky=0.1, pga=0.5, M=7.6)


@pytest.mark.filterwarnings("ignore:.*the range of slopes:stickslip.PlausibilityWarning")
@pytest.mark.parametrize(
    ("model", "more", "low", "high"),
    [
        (Jibson2007(), {}, 0.05, 0.4),
        (SaygiliRathje2008(), {}, 0.05, 0.3),
        (BrayTravasarou2007(), {"Ts": 0.3, "M": 7}, 0.02, 0.4),
        (BrayMacedoTravasarou2018(), {"Ts": 0.3, "M": 7}, 0.01, 0.8),
        (BrayMacedo2019(), {"Ts": 0.3, "M": 7}, 0.01, 0.8),
    ],
)
def test_each_model_warns_where_its_range_is_left(kobe, model, more, low, high):
    for ky in (0.9 * low, 1.1 * high):
        words = rf"^{type(model).__name__}: ky is outside the range of the model, {low} to {high}"
        with pytest.warns(RangeWarning, match=words) as caught:
            model.of(kobe, ky=ky, **more)
        where = [one.filename for one in caught if one.category is RangeWarning]
        assert where == [__file__]
    with warnings.catch_warnings():
        warnings.simplefilter("error", RangeWarning)
        model.of(kobe, ky=[low, high], **more)


def test_sigma_of_rathje_and_saygili_has_three_digits():
    """As in OpenQuake's `rathje_saygili_2009`: 0.732 + 0.789 r - 0.539 r^2."""
    sigma = RathjeSaygili2009().predict(ky=0.1, pga=[0.1, 0.2, 1], M=7).sigma
    r = np.array([1, 0.5, 0.1])
    assert sigma == pytest.approx(0.732 + 0.789 * r - 0.539 * r**2, rel=1e-12)


def test_a_warning_names_the_line_of_the_caller(kobe):
    with pytest.warns(RangeWarning) as caught:
        Jibson2007().predict(ky=0.1, pga=0.5, M=8)
        Jibson2007().of(kobe, ky=0.1, M=8)
    assert [one.filename for one in caught] == [__file__, __file__]


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"ky": 0, "pga": 0.5}, "ky must be positive and finite, got 0.0 g: a slope that yields"),
        ({"ky": 0.1, "pga": math.nan}, "pga must be at least 0 and finite, got nan g$"),
        ({"ky": 0.1, "pga": -0.1}, "pga must be at least 0 and finite, got -0.1 g$"),
        ({"ky": [0.1, math.inf], "pga": 0.5}, "ky must be .* finite, got inf g at index 1"),
        ({"ky": 0.1, "pga": [[0.1, 0], [math.nan, 1]]}, r"got nan g at index \(1, 0\)"),
        ({"ky": [0.1, 0], "pga": 0.5}, "got 0.0 g at index 1: a slope that yields"),
        ({"ky": [0.1, 0.2], "pga": [0.1, 0.2, 0.3]}, r"must broadcast, got the shapes ky \(2,\)"),
    ],
)
def test_a_value_out_of_range_is_named(given, words):
    with pytest.raises(ValueError, match=words):
        AmbraseysMenu1988().predict(**given)


OF_MOTION = ("pga", "pgv", "Ia", "Sa")


@every_form
def test_where_nothing_shakes_nothing_moves(model, given):
    d = model.predict(ky=0.05, **given)
    for name in set(OF_MOTION) & given.keys():
        cells = model.predict(ky=0.05, **given | {name: np.array([[given[name], 0]])})
        assert cells.median.tolist() == [[d.median, 0]]
        assert cells.p_zero.tolist() == [[d.p_zero, 1]]
        still = model.predict(ky=0.05, **given | {name: 0})
        assert (still.median, still.p_zero) == (0, 1)
        if cells._sigma is not None:
            assert cells.exceedance(1e-6).tolist() == [[d.exceedance(1e-6), 0]]
            assert cells.quantile(0.99).tolist() == [[d.quantile(0.99), 0]]


def test_a_combination_that_no_form_takes_is_named(kobe):
    with pytest.raises(TypeError, match=r"takes ky, pga; ky, pga, M; .* got ky, M, Ia"):
        Jibson2007().predict(ky=0.1, M=7, Ia=2)
    with pytest.raises(TypeError, match=r"BrayTravasarou2007.of: takes ky, Sa, Ts, M, got ky, M"):
        BrayTravasarou2007().of(kobe, ky=0.1, M=7)
    with pytest.raises(TypeError, match="must be a GroundMotion or a Suite, got list"):
        Jibson2007().of([1, 2], ky=0.1)


@pytest.mark.parametrize("p", [0, 1, math.nan, -0.1])
def test_a_probability_out_of_range_is_named(p):
    with pytest.raises(ValueError, match="p must be above 0 and below 1"):
        AmbraseysMenu1988().predict(ky=0.1, pga=0.5).quantile(p)


def test_a_threshold_out_of_range_is_named():
    with pytest.raises(ValueError, match=r"displacement must be positive and finite, got 0.0 m"):
        AmbraseysMenu1988().predict(ky=0.1, pga=0.5).exceedance(0)


# ---- what users see


def test_a_prediction_says_its_units():
    d = BrayTravasarou2007().predict(ky=0.14, Ts=0.33, M=7.5, Sa=0.483)
    assert repr(d) == (
        "<Prediction, BrayTravasarou2007: median 0.09768 m, p_zero 0.01008, sigma 0.66 (ln)>"
    )
    d = Jibson2007().predict(ky=[0.1, 0.2], pga=0.5)
    assert "of 2 values, Jibson2007, equation 6: median 0.01" in repr(d)
    d = FotopoulouPitilakis2015().predict(ky=0.1, pga=0.5, pgv=40)
    assert "form d" in repr(d) and "sigma unknown" in repr(d)


def test_a_prediction_is_a_table():
    pytest.importorskip("pandas")
    d = Jibson2007().predict(ky=[0.1, 0.2], pga=0.5)
    frame = d.to_dataframe()
    assert list(frame.columns) == ["ky", "pga", "median", "p_zero", "sigma"]
    assert frame.attrs["units"] == {"ky": "g", "pga": "g", "median": "m"}
    assert len(frame) == 2


def test_models_are_values():
    assert BrayTravasarou2007() == BrayTravasarou2007() != BrayMacedo2019()
    assert FotopoulouPitilakis2015("a") != FotopoulouPitilakis2015("b")
    assert len({Jibson2007(), Jibson2007(), FotopoulouPitilakis2015("a")}) == 2
    with pytest.raises(ValueError, match="form must be 'a', 'b', 'c' or 'd', got 'e'"):
        FotopoulouPitilakis2015("e")


def test_each_model_is_public():
    public = {getattr(ss.regressions, name) for name in ss.regressions.__all__}
    assert {type(model) for model, _ in FORMS} <= public
    assert ss.regressions.__name__ == "stickslip.regressions"


@every_form
def test_the_docstring_shows_what_is_computed(model, given):
    text = " ".join(type(model).__doc__.split())
    for form in model.forms:
        assert f"{model.base} D = {form.equation} sigma = {form.sigma or 'unknown'}" in text
    for name, equation in model.where.items():
        assert f"{name} = {equation}" in text
    assert text.endswith(f"References ---------- {model.source}")
