"""Sweeps of random sliders: draws, their parameters, correlation, Latin hypercubes."""

import math
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import stickslip as ss

MU = ss.Lognormal(median=0.1, beta=0.3)
BLOCKS = ss.Random(ss.Coulomb, mu=MU)


def quake(seed: int) -> ss.GroundMotion:
    n = np.random.default_rng(seed).normal(0, 2, 300)
    return ss.GroundMotion(n - n.mean(), dt=0.02, name=f"quake {seed}")


QUAKES = ss.Suite([quake(i) for i in range(3)], {"magnitude": [5, 6, 7]})


def test_a_random_slider_is_drawn_once_for_all_records():
    table = ss.sweep(BLOCKS, QUAKES, members=20, seed=3, settle=True)
    drawn = [BLOCKS.sample(seed=3, member=i) for i in range(20)]
    assert table.sliders == tuple(map(repr, drawn))
    assert table.parameters["mu"] == pytest.approx(
        [one.slip_level / ss.STANDARD_GRAVITY for one in drawn], rel=1e-15
    )
    same = ss.sweep(drawn, QUAKES, settle=True)
    assert np.array_equal(table.peak, same.peak)
    assert table.peak[4, 1, 0] == pytest.approx(
        ss.integrate(drawn[4], QUAKES[1], settle=True).peak, rel=1e-12
    )
    with ThreadPoolExecutor(2) as pool:
        assert ss.sweep(BLOCKS, QUAKES, members=20, seed=3, settle=True, executor=pool) == table


def test_every_random_parameter_has_a_column():
    floors = ss.Random(
        ss.Slider,
        law=BLOCKS,
        period=ss.Uniform(1, 2),
        damping_ratio=0.05,
        stops=ss.Random(ss.Stops, gap=ss.Uniform(0.05, 0.1), restitution=0.3),
    )
    assert floors.names == ("mu", "period", "gap")
    table = ss.sweep(floors, QUAKES[:1], members=5, seed=1)
    assert set(table.parameters) == {"mu", "period", "gap"}
    assert (table.parameters["gap"] >= 0.05).all()
    assert "impacts_forward" in table.arrays()
    twice = ss.Random(lambda a, b: ss.Slider(a, b.slip_level), a=BLOCKS, b=BLOCKS)
    assert twice.names == ("a.mu", "b.mu")


def test_random_sliders_in_the_plane():
    n = QUAKES[0].acceleration
    pair = ss.GroundMotion(n, dt=0.02, transverse=n[::-1])
    table = ss.sweep(ss.Random(ss.PlanarSlider, law=BLOCKS), [pair], members=4, seed=1)
    assert table.planar
    assert len(set(table.peak[:, 0, 0])) == 4


def test_a_latin_hypercube_has_one_value_in_each_stratum():
    stats = pytest.importorskip("scipy.stats")
    floors = ss.Random(ss.Slider, law=BLOCKS, period=ss.Uniform(1, 2))
    table = ss.sweep(floors, QUAKES[:1], members=50, seed=2, stratified=True)
    scores = stats.norm.cdf(np.log(table.parameters["mu"] / 0.1) / 0.3)
    for probabilities in (scores, table.parameters["period"] - 1):
        assert sorted(np.floor(50 * probabilities)) == list(range(50))
    again = ss.sweep(floors, QUAKES[:1], members=50, seed=2, stratified=True)
    assert again == table
    other = ss.sweep(floors, QUAKES[:1], members=50, seed=3, stratified=True)
    assert not np.array_equal(other.peak, table.peak)


@pytest.mark.parametrize("stratified", [False, True])
def test_correlated_parameters_keep_their_distributions(stratified):
    stats = pytest.importorskip("scipy.stats")
    blocks = ss.Random(
        ss.StaticKinetic,
        mu_static=ss.Lognormal(median=0.4, beta=0.1),
        mu_kinetic=ss.Lognormal(median=0.1, beta=0.3),
    ).correlated("mu_static", "mu_kinetic", 0.8)
    _, values = blocks.draw(2000, seed=1, stratified=stratified)
    static, kinetic = (np.log(values[name]) for name in ("mu_static", "mu_kinetic"))
    # The correlation of 2,000 pairs has the standard error (1 - 0.8^2)/sqrt(2000) = 0.008: with
    # five of them a false alarm has a probability of 6e-7.
    assert np.corrcoef(static, kinetic)[0, 1] == pytest.approx(0.8, abs=0.04)
    for logs, median, beta in ((static, 0.4, 0.1), (kinetic, 0.1, 0.3)):
        # A false alarm has a probability of 1e-4, less for a Latin hypercube.
        assert stats.kstest((logs - math.log(median)) / beta, "norm").pvalue > 1e-4
    assert blocks.sample(seed=1, member=7) == blocks.draw(8, seed=1)[0][7]


def test_correlations_belong_to_the_description_of_random_sliders():
    pair = ss.Random(ss.StaticKinetic, mu_static=ss.Uniform(0.4, 0.5), mu_kinetic=MU)
    both = pair.correlated("mu_kinetic", "mu_static", 0.5)
    assert both == pair.correlated("mu_static", "mu_kinetic", 0.5)
    assert both != pair
    assert repr(both).endswith(").correlated('mu_static', 'mu_kinetic', 0.5)")
    assert both.configuration["correlations"] == [["mu_static", "mu_kinetic", 0.5]]
    assert "correlations" not in pair.configuration
    # A nested Random keeps its correlation.
    nested = ss.Random(ss.Slider, law=both, period=ss.Uniform(1, 2))
    _, values = nested.draw(500, seed=1)
    logs = np.log(values["mu_kinetic"])
    # The standard error is (1 - 0.5^2)/sqrt(500) = 0.03: five of them, 6e-7.
    assert np.corrcoef(logs, values["mu_static"])[0, 1] == pytest.approx(0.49, abs=0.17)


def test_what_cannot_be_drawn_is_refused():
    pair = ss.Random(ss.StaticKinetic, mu_static=ss.Uniform(0.4, 0.5), mu_kinetic=0.1)
    with pytest.raises(ValueError, match="'mu_kinetic' must be one of mu_static"):
        pair.correlated("mu_static", "mu_kinetic", 0.5)
    with pytest.raises(ValueError, match="coefficient must lie strictly between -1 and 1, got 1"):
        three = ss.Random(lambda a, b, c: ss.Coulomb(mu=a), **dict.fromkeys("abc", MU))
        three.correlated("a", "b", 1)
    with pytest.raises(ValueError, match="the correlations contradict each other"):
        three.correlated("a", "b", 0.9).correlated("b", "c", 0.9).correlated("a", "c", -0.9)
    with pytest.raises(ValueError, match="a Random needs members"):
        ss.sweep(BLOCKS, QUAKES)
    with pytest.raises(ValueError, match="a Random needs members"):
        ss.sweep(BLOCKS, QUAKES, members=3)
    with pytest.raises(ValueError, match="members must be at least 1, got 0"):
        ss.sweep(BLOCKS, QUAKES, members=0, seed=1)
    with pytest.raises(ValueError, match="are for a Random, got Coulomb"):
        ss.sweep(ss.Coulomb(mu=0.1), QUAKES, members=3)
    normal = ss.Random(ss.Coulomb, mu=ss.Normal(0.1, 0.08))
    with pytest.raises(ValueError, match=r"member \d+: Coulomb: mu"):
        ss.sweep(normal, QUAKES, members=200, seed=1)
