"""Estimates and intervals: they unpack, compare, and are written as the numbers they hold."""

import math
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest
import stickslip as ss

PULSES = ss.PoissonPulses.event("moderate near field")


@pytest.fixture(scope="module")
def ensemble():
    return ss.run_ensemble(ss.Coulomb(mu=0.02), PULSES, members=500, seed=1)


@pytest.fixture
def estimate(ensemble):
    return ensemble.stationary.velocity_variance


@pytest.fixture
def interval(ensemble):
    return ensemble.quantile(0.84)


def test_an_estimate_unpacks_into_value_and_error(estimate):
    value, error = estimate
    assert (value, error) == (estimate.value, estimate.error)
    assert float(estimate) == estimate.value
    assert math.isclose(math.sqrt(estimate), math.sqrt(estimate.value))


def test_an_interval_unpacks_into_value_and_bounds(interval):
    value, low, high = interval
    assert (value, low, high) == (interval.value, interval.low, interval.high)
    assert low <= value <= high
    assert float(interval) == interval.value


def test_both_are_written_by_a_format_of_their_numbers(estimate, interval):
    e, i = estimate, interval
    for spec in (".3f", "10.2e", ".4g", "+.1%"):
        assert format(e, spec) == f"{e.value:{spec}} +- {e.error:{spec}}"
        assert format(i, spec) == f"{i.value:{spec}} ({i.low:{spec}} to {i.high:{spec}})"
    assert f"{e}" == str(e)
    assert f"{i}" == str(i)
    for thing in (e, i):
        with pytest.raises(ValueError, match="format"):
            format(thing, "nonsense")


@pytest.mark.parametrize("kind", [float, np.float64, np.float32, Fraction, Decimal])
def test_both_compare_with_numbers_by_value(estimate, interval, kind):
    for thing in (estimate, interval):
        below, above = kind(float(thing) / 2), kind(float(thing) * 2)
        assert below < thing < above
        assert below <= thing <= above
        assert above > thing > below
        assert above >= thing >= below
        assert not (thing < below or thing > above or thing <= below or thing >= above)
        assert thing <= thing.value <= thing
        assert not thing < thing.value
        assert thing < 10**6


def test_both_compare_with_each_other_by_value(ensemble, estimate, interval):
    quantiles = ensemble.quantile([0.95, 0.5, 0.84])
    assert sorted(quantiles) == [quantiles[i] for i in (1, 2, 0)]
    assert max(quantiles) == quantiles[0]
    assert (estimate < interval) == (estimate.value < interval.value)
    assert (estimate >= interval) == (estimate.value >= interval.value)
    assert estimate != estimate.value  # a number has no error


def test_both_are_no_match_for_what_is_no_number(estimate, interval):
    for thing in (estimate, interval):
        for stranger in ("1", None, 1j, [1.0]):
            with pytest.raises(TypeError):
                thing < stranger  # noqa: B015
        with pytest.raises(OverflowError):
            thing < 10**400  # noqa: B015


def test_arrays_take_them_as_numbers(ensemble, interval):
    levels = np.array([0, interval.value, 1e9])
    assert (levels < interval).tolist() == [True, False, False]
    assert (interval > levels).tolist() == [True, False, False]
    quantiles = ensemble.quantile([0.5, 0.84])
    values = np.array(quantiles, float)
    assert values.tolist() == [q.value for q in quantiles]


def test_quantiles_of_several_probabilities_come_as_a_list(ensemble):
    shares = [0.5, 0.84, 0.95]
    for asked in (shares, tuple(shares), np.array(shares)):
        got = ensemble.quantile(asked)
        assert type(got) is list
        assert got == [ensemble.quantile(p) for p in shares]
    assert ensemble.quantile(shares, 0.5) == [ensemble.quantile(p, confidence=0.5) for p in shares]
    assert ensemble.quantile([]) == []
    for one in (0.5, np.float64(0.5), Fraction(1, 2), np.array(0.5)):
        assert type(ensemble.quantile(one)) is ss.Interval


@pytest.mark.parametrize(
    "asked, message",
    [
        ([0.5, 1.0], "got 1"),
        (1, "got 1"),
        ([[0.5]], "one-dimensional"),
        (["0.5"], "real numbers"),
        ("0.5", "real numbers"),
        ([0.5, math.nan], "got nan"),
    ],
)
def test_quantiles_of_other_probabilities_are_refused(ensemble, asked, message):
    with pytest.raises(ValueError, match=message):
        ensemble.quantile(asked)


def test_products_and_quotients_convert_the_unit(ensemble):
    interval = ensemble.quantile(0.5)
    for got in (100 * interval, interval * 100, np.float64(100) * interval, interval / 0.01):
        assert type(got) is ss.Interval
        assert tuple(got) == pytest.approx(tuple(100 * np.array(tuple(interval))), rel=1e-15)
    turned = -2 * interval
    assert tuple(turned) == (-2 * interval.value, -2 * interval.high, -2 * interval.low)
    assert tuple(0 * interval) == (0, 0, 0)
    estimate = ensemble.stationary.velocity_variance
    for got in (-4 * estimate, estimate * -4, estimate / -0.25):
        assert type(got) is ss.Estimate
        assert tuple(got) == (-4 * estimate.value, 4 * estimate.error)
    for one in (interval, estimate):
        negative = -one
        assert -negative == one
        for wrong in (math.nan, math.inf):
            with pytest.raises(ValueError, match="must be finite"):
                one * wrong
        with pytest.raises(ValueError, match="a divisor must be finite and not zero, got 0"):
            one / 0
        with pytest.raises(TypeError):
            one * "2"
        with pytest.raises(TypeError):
            one * one
