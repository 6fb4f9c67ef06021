"""docs/regressions.md: its tables and its picture computed again, and what its text says."""

import math
import re

import numpy as np
import pytest
import stickslip as ss
from pages import ROOT, assert_same_figure, assert_same_table, measuring

PAGE = ROOT / "docs" / "regressions.md"
TEXT = PAGE.read_text(encoding="utf-8")
WORDS = " ".join(TEXT.split())

measured = measuring("measure_regressions")

pytestmark = pytest.mark.filterwarnings("ignore:.*ky is outside the range")


@pytest.fixture(scope="module")
def referees(pyslammer_files):
    return {one.form: one for one in measured.referees()}


def of(referees, name, index=0):
    """The referee of the form of this name, or of one that follows it."""
    return referees[measured.FORMS[measured.FORMS.index(measured.of_form(name)) + index]]


@pytest.mark.parametrize("name", ["models", "packages"])
def test_a_table_is_what_comes_out(referees, name):
    assert_same_table(TEXT, measured.tables()[name])


def test_the_picture_is_what_comes_out(referees, tmp_path):
    pytest.importorskip("matplotlib")
    assert_same_figure(measured.figure, measured.PICTURE, tmp_path)


def test_the_exact_displacements_are_those_of_integrate(referees):
    exact = measured.exact()
    for record, level in ((1, 0), (6, 25), (17, 40)):
        motion = measured.samples()[record]
        block = ss.Coulomb(mu=measured.LEVELS[level], backward=math.inf)
        for polarity, one in enumerate((motion, -motion)):
            slid = ss.integrate(block, one, settle=True).residual
            assert exact[record, level, polarity] == pytest.approx(slid, rel=1e-12, abs=1e-15)


def test_the_points_are_counted(referees):
    exact = measured.exact()
    assert f"{(exact >= measured.SLIDES).sum():,} of {exact.size:,} remain" in WORDS
    assert {one.error.size for one in referees.values()} == {(exact >= measured.SLIDES).sum()}


def test_the_polarities_scatter_as_the_page_says(referees):
    exact = measured.exact()
    slid = (exact >= measured.SLIDES).all(axis=2)
    scatter = np.diff(np.log(exact[slid]), axis=1).std() / math.sqrt(2)
    assert f"of one record alone scatter by {scatter:.2f}" in WORDS


def test_means_are_within_two_standard_errors_where_the_page_says_so(referees):
    near = [
        of(referees, "Saygili", 2),
        of(referees, "Saygili", 3),
        of(referees, "Jibson et al."),
        of(referees, "Jibson 2007, (6)"),
        of(referees, "Bray, Macedo 2019"),
        of(referees, "Fotopoulou"),
        of(referees, "Fotopoulou", 1),
    ]
    for one in referees.values():
        within = abs(math.log(one.bias)) <= 2 * one.uncertainty
        assert within == (one in near), one.form.name
    above = [
        of(referees, "Ambraseys"),
        of(referees, "Saygili"),
        of(referees, "Saygili", 1),
        of(referees, "Rathje, Saygili"),
        of(referees, "Rathje, Antonakos"),
        of(referees, "Rathje, Antonakos", 1),
        of(referees, "Bray, Travasarou"),
    ]
    biases = [one.bias for one in above]
    assert f"by {min(biases):.1f} to {max(biases):.1f} times" in WORDS
    assert f"below by {of(referees, 'Jibson 2007, (7)').bias:.1f} times" in WORDS


def test_scatter_and_sigmas_are_what_the_page_says(referees):
    three, two = of(referees, "Saygili", 3).scatter, of(referees, "Saygili", 1).scatter
    assert f"scatters by {three:.2f}, PGA with PGV by {two:.2f}" in WORDS
    alone = [
        one.scatter
        for one in referees.values()
        if one.form.measures == ("pga",) and one.form.arguments in ((), ("M",))
    ]
    alone = [one for one in alone if one < 1.2]  # those of rigid blocks
    assert f"by {min(alone):.2f} to {max(alone):.2f}." in WORDS
    within = {name: one.within for name, one in referees.items() if one.within is not None}
    assert max(within, key=within.get) == measured.of_form("Jibson 2007, (6)")
    rest = sorted(within.values())[:-1]
    assert f"{100 * rest[0]:.0f} to {100 * rest[-1]:.0f} % of the points" in WORDS
    assert rest[-1] < 0.68 < max(within.values())


def test_power_laws_fail_at_small_r(referees):
    ninth, tenth = (of(referees, f"Jibson 2007, ({n})").between(0, 0.2) for n in (9, 10))
    assert f"below r = 0.2 they predict {ninth:.0f} and {tenth:.0f} times" in WORDS


def test_the_two_coefficients_hardly_differ_in_scatter(referees):
    one = of(referees, "Saygili")
    other = (one.error - 0.54 * one.r**2).std()
    assert f"the scatter is {one.scatter:.2f} and {other:.2f}" in WORDS


def test_the_standard_error_is_that_of_records():
    """With one point a record it is that of a mean, but for the degree of freedom."""
    error = np.random.default_rng(1).standard_normal(400)
    referee = measured.Referee(measured.FORMS[0], error, np.arange(400), error, None)
    assert referee.uncertainty == pytest.approx(error.std() / 20, rel=1e-12)
    # The same points 50 times each do not make it smaller.
    many = measured.Referee(
        measured.FORMS[0], np.repeat(error, 50), np.repeat(np.arange(400), 50), error, None
    )
    assert many.uncertainty == pytest.approx(referee.uncertainty, rel=1e-12)


def test_magnitudes_are_those_of_the_text():
    said = WORDS[WORDS.index("Magnitudes (moment magnitude") :].split("## ")[0]
    numbers = re.findall(r"\d\.\d", said)
    assert sorted(map(float, numbers)) == sorted(measured.MAGNITUDES.values())
