"""docs/refinements.md: its tables computed again, and what its text says about them."""

import math
import re

import numpy as np
import pytest
import stickslip as ss
from pages import ROOT, assert_same_table, measuring

PAGE = ROOT / "docs" / "refinements.md"
TEXT = PAGE.read_text(encoding="utf-8")
WORDS = " ".join(TEXT.split())


measured = measuring("measure_refinements")


def agree(new):
    assert_same_table(TEXT, new)


@pytest.fixture(scope="module")
def tables(pyslammer_files):
    return measured.tables()


@pytest.mark.slow
@pytest.mark.parametrize("name", ["blocks", "floors", "slopes", "vertical", "isolators", "fast"])
def test_a_table_is_what_comes_out(tables, name):
    agree(tables[name])


@pytest.mark.slow
def test_the_table_of_the_station_is_what_comes_out(tables, agency_files):
    if not (agency_files / measured.STATION).is_file():
        pytest.skip(f"no {measured.STATION} in $STICKSLIP_RECORDS")
    agree(tables["station"])
    up = measured.station()[0].vertical
    assert f"exceeds g once, by {-100 * (up.min() / measured.G + 1):.0f} %" in WORDS


def test_a_slope_is_a_level_block_with_another_yield_acceleration(pyslammer_files):
    # Exact, so that the tables' refined block is checked by one that knows nothing of slopes.
    scales, excess = [], []
    for degrees in (10, 20, 30):
        th = math.radians(degrees)
        full, constant = measured.slope(degrees, 0.1)
        phi = math.atan(full.law.slip_level / measured.G)
        assert math.tan(phi - th) == pytest.approx(0.1)
        level = ss.Coulomb(slip_level=0.1 * measured.G, backward=math.inf)
        scales.append(math.cos(phi - th) / math.cos(phi))
        excess.append(1 + math.tan(phi) * math.tan(th))
        assert constant.slip_level / math.cos(th) == pytest.approx(0.1 * measured.G * excess[-1])
        assert scales[-1] == pytest.approx(math.cos(th) * excess[-1])
        for motion in measured.samples():
            slides = ss.integrate(full, motion, settle=True).residual
            rides = ss.integrate(level, motion, settle=True).residual
            assert slides == pytest.approx(scales[-1] * rides, rel=1e-10)
    for factors in (scales, excess):
        assert "{:.2f}, {:.2f} and {:.2f}".format(*factors) in WORDS


def test_with_ptfe_the_fast_coefficient_suits_large_displacements(pyslammer_files):
    (pair,) = (p for p in measured.BLOCKS if p.against == "0.163")
    refined, plain = measured.measure(pair, measured.samples()).peak.T
    large = plain >= 0.05
    ratios = refined[large] / plain[large]
    assert f"ratio of peaks is {ratios.min():.2f} to {ratios.max():.2f}" in WORDS
    slid = np.flatnonzero(plain >= measured.SLIDES)
    assert np.argmax(refined[slid] / plain[slid]) == np.argmin(plain[slid])


def test_stops_act_where_the_floor_would_go_further(pyslammer_files):
    (pair,) = (p for p in measured.FLOORS if p.name.startswith("stops"))
    speeds = []
    for motion in measured.samples():
        free = ss.integrate(pair.plain, motion, settle=True)
        stopped = ss.integrate(pair.refined, motion, settle=True)
        assert (len(stopped.impacts) > 0) == (free.peak > pair.refined.stops.gap)
        speeds += [np.abs(stopped.impacts["velocity"]).max()] if len(stopped.impacts) else []
    assert f"Stops act in {len(speeds)} of the 18 records" in WORDS
    assert f"at up to {max(speeds):.1f} m/s" in WORDS


def test_blocks_leave_the_ground_where_the_page_says_so():
    def flights(pga, ratio):
        responses = [
            ss.integrate(ss.Coulomb(mu=0.3), m)
            for m in measured.components(measured.triples(pga, ratio))
        ]
        return [any(event["kind"] == "liftoff" for event in r.events) for r in responses]

    assert all(flights(1.0, 2.0))
    assert not any(flights(0.4, 1.5))  # 0.6 g upward and downward


def test_the_synthetic_triples_have_the_ratio_that_is_stated():
    for motion in measured.components(measured.triples(0.4, 1.5, 3)):
        assert motion.peak_acceleration == pytest.approx(0.4 * measured.G)
        assert np.abs(motion.vertical).max() == pytest.approx(0.6 * measured.G)
    first, second = measured.components(measured.triples(0.4, 1.5, 1))
    assert np.array_equal(first.vertical, second.vertical)
    assert not np.array_equal(first.acceleration, second.acceleration)


def test_the_force_per_unit_mass_is_the_acceleration_of_the_floor(pyslammer_files):
    for isolator in measured.ISOLATORS[:3]:
        r = ss.integrate(isolator.slider, measured.finely(next(iter(isolator.motions()))))
        sliding = ~r.stuck
        assert np.count_nonzero(sliding) > 1000
        assert r.acceleration[sliding] == pytest.approx(-r.force[sliding], abs=1e-9)


def test_the_largest_force_of_a_constant_coefficient_is_that_at_its_peak(pyslammer_files):
    # As `fit` takes it; the samples, 1 ms apart, come as near as the slip changes in that time.
    slider = measured.floor(ss.Coulomb(mu=0.06))
    for motion in measured.samples()[:6]:
        r = ss.integrate(slider, measured.finely(motion), settle=True)
        largest = 0.06 * measured.G + slider.natural_frequency**2 * r.peak
        # Within half a sample of the reversal x is off by v'' dt^2 / 8 with v' below 3 g.
        near = slider.natural_frequency**2 * 3 * measured.G * 1e-6
        assert largest - near <= np.abs(r.force).max() <= largest * (1 + 1e-12)


@pytest.mark.slow
def test_the_coefficients_that_give_one_quantity_do_and_the_best_is_not_worse(tables):
    for isolator in measured.ISOLATORS:
        fits = measured.fits(isolator)
        for one in fits[:3]:
            slider = ss.FrictionPendulum(radius=measured.RADIUS, mu=one.mu_of_peak)
            peak = ss.integrate(slider, measured.flat(one.motion), settle=True).peak
            assert peak == pytest.approx(one.peak, rel=1e-4)
        for one in fits:
            others = (one.force_ratio, one.peak_ratio)
            error = min(abs(math.log(ratio)) for ratio in others if not math.isnan(ratio))
            assert math.log1p(one.compromise) <= error + 1e-4


@pytest.mark.slow
def test_what_the_text_says_of_the_isolators(tables):
    fits = [one for isolator in measured.ISOLATORS for one in measured.fits(isolator)]
    shown = next(one for one in measured.fits(measured.ISOLATORS[1]) if "PAC" in one.motion.name)
    assert f"largest force is {100 * (1 - shown.force_ratio):.0f} % too low" in WORDS
    lowest = min(one.at_fast[1] for one in fits)
    assert f"force is up to {100 * (1 - lowest):.0f} % too low" in WORDS
    under = [one.under_normal[1] for one in fits if one.motion.vertical is not None]
    furthest = max(abs(ratio - 1) for ratio in under)
    assert f"true N(t) gives the force within {100 * furthest:.0f} %" in WORDS


def test_the_summary_repeats_the_tables():
    summary = TEXT.partition("## In short")[2].partition("\n## ")[0]
    cells = {
        number
        for line in TEXT.splitlines()
        if line.startswith("|")
        for number in re.findall(r"\d+\.\d+", line)
    }
    quoted = re.findall(r"\d+\.\d\d\b", summary)
    assert len(quoted) > 12
    assert set(quoted) <= cells


def test_the_page_names_its_sources():
    sources = TEXT.partition("## Sources")[2].partition("\n## ")[0]
    for source in ("pyslammer", "GeoNet", "OpenSees", "Kumar", "Constantinou", "Ikenaga"):
        assert source in sources
    notes = " ".join(f"{row['source']} {row['note']}" for row in ss.interfaces())
    assert "Ikenaga" in notes and "OpenSees" in notes
