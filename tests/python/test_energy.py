"""Energy: where it came from, where it went, and that none is lost."""

import math

import numpy as np
import pytest
import stickslip as ss

SLIDERS = [
    ss.Slider(ss.Coulomb(slip_level=1.0)),
    ss.Slider(ss.Coulomb(slip_level=1.0, backward=1.6), 1.3),
    ss.Slider(ss.Coulomb(slip_level=1.0, backward=math.inf)),
    ss.Slider(ss.Caster(slip_level=1.0, reach=0.5)),
    ss.Slider(ss.Caster(slip_level=1.0, reach=0.05), 1.3),
]


@pytest.fixture(params=["linear", "constant"])
def quake(request, record_a):
    return ss.GroundMotion(record_a, dt=0.1, interpolation=request.param)


@pytest.mark.parametrize("slider", SLIDERS, ids=repr)
def test_what_comes_in_goes_out_or_stays(slider, quake):
    # Each of some 500 flows balances to a few roundings of what it turns over
    e = ss.integrate(slider, quake, displacement=0.02, velocity=0.3).energy
    wn2 = slider.natural_frequency**2
    assert e.initial == pytest.approx(0.3**2 / 2 + wn2 * 0.02**2 / 2, rel=1e-15)
    assert e.initial + e.input == pytest.approx(e.dissipated + e.kinetic + e.elastic, rel=1e-13)
    assert abs(e.imbalance) <= 1e-13 * e.dissipated


@pytest.mark.parametrize("slider", SLIDERS, ids=repr)
def test_kinetic_and_elastic_energy_are_those_of_the_end(slider, quake):
    r = ss.integrate(slider, quake)
    wn2 = slider.natural_frequency**2
    assert r.energy.kinetic == pytest.approx(r.velocity[-1] ** 2 / 2, rel=1e-15)
    assert r.energy.elastic == pytest.approx(wn2 * r.residual**2 / 2, rel=1e-15)


@pytest.mark.parametrize("slider", SLIDERS, ids=repr)
def test_ground_that_holds_its_acceleration_works_along_the_way(slider, record_a):
    # input = - sum n_i (x_{i+1} - x_i), exactly; 400 terms, each rounded to 1.1e-16 of |n x|
    r = ss.integrate(slider, ss.GroundMotion(record_a, dt=0.1, interpolation="constant"))
    work = -np.sum(record_a[:-1] * np.diff(r.displacement))
    scale = np.max(np.abs(record_a)) * r.peak
    assert r.energy.input == pytest.approx(work, rel=0, abs=400 * 1.2e-16 * scale)


def test_coulomb_friction_takes_its_level_times_the_way(quake):
    r = ss.integrate(ss.Coulomb(slip_level=1.5), quake)
    assert r.energy.dissipated == pytest.approx(1.5 * r.sliding_distance, rel=1e-14)


def test_a_caster_gives_all_it_has_over_its_well():
    # From the middle to infinity: the integral of a sech(x / reach) is a reach pi / 2. It goes 38
    # reaches at about 2.7 m/s; what is left there is 4 exp(-38) / pi of all, 4e-17.
    law = ss.Caster(slip_level=2.0, reach=0.25)
    r = ss.integrate(law, ss.GroundMotion([0, 0], dt=3.5), velocity=3.0)
    assert r.residual > 38 * 0.25
    assert r.energy.dissipated == pytest.approx(2.0 * 0.25 * math.pi / 2, rel=1e-14)


def test_a_slider_that_has_settled_without_a_spring_has_given_all_away(quake):
    e = ss.integrate(ss.Coulomb(slip_level=1.0), quake, settle=True).energy
    assert e.kinetic == e.elastic == 0
    assert e.input == pytest.approx(e.dissipated, rel=1e-13)


def test_without_friction_none_is_taken():
    slider = ss.Slider(ss.Coulomb(slip_level=0.0), 2.0)
    e = ss.integrate(slider, ss.GroundMotion([0, 0], dt=10), displacement=0.5).energy
    assert e.dissipated == 0
    assert e.kinetic + e.elastic == pytest.approx(e.initial, rel=1e-13)


def test_energy_says_its_accounts_and_does_not_change():
    e = ss.integrate(ss.Coulomb(slip_level=1.0), ss.GroundMotion([2, 2], dt=1)).energy
    for name in ("initial", "input", "dissipated", "kinetic", "elastic"):
        assert f"{name} {getattr(e, name):.4g}" in repr(e)
        with pytest.raises(AttributeError):
            setattr(e, name, 0.0)
