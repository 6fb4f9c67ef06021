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
