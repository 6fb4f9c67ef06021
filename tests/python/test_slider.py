"""A slider: a law, an optional spring and an optional damper."""

import math

import numpy as np
import pytest
import stickslip as ss

BLOCK = ss.Coulomb(slip_level=1.0, backward=1.6)
CASTER = ss.Caster(slip_level=1.0, reach=0.5)


def test_a_slider_knows_its_law_and_its_spring():
    slider = ss.Slider(BLOCK, natural_frequency=1.3)
    assert slider.law == BLOCK
    assert slider.natural_frequency == 1.3
    assert ss.Slider(law=CASTER).natural_frequency == 0


def test_period_and_damping_ratio_are_other_names_of_frequency_and_damping():
    slider = ss.Slider(BLOCK, period=0.5, damping_ratio=0.05)
    assert slider == ss.Slider(BLOCK, 4 * math.pi, 2 * 4 * math.pi * 0.05)
    assert slider.period == 0.5
    assert slider.damping_ratio == pytest.approx(0.05, rel=1e-15)
    assert slider.damping == pytest.approx(0.4 * math.pi, rel=1e-15)
    assert ss.Slider(BLOCK).period == math.inf
    assert math.isnan(ss.Slider(BLOCK).damping_ratio)


@pytest.mark.parametrize(
    "arguments, message",
    [
        ({"natural_frequency": 2, "period": 3}, "natural_frequency or period, got both"),
        ({"natural_frequency": 2, "damping": 1, "damping_ratio": 0.1}, "damping or damping_ratio"),
        ({"damping_ratio": 0.1}, "damping_ratio needs a spring"),
        ({"period": 0}, "period must be positive and finite, got 0 s"),
        ({"period": math.inf}, "period must be positive and finite, got inf s"),
        ({"period": 1, "damping_ratio": -0.1}, "damping_ratio must be finite and at least 0"),
        ({"damping": -1}, "damping and its square must be finite and at least 0, got -1 1/s"),
    ],
)
def test_what_contradicts_itself_is_refused(arguments, message):
    with pytest.raises(ValueError, match=message):
        ss.Slider(BLOCK, **arguments)


def test_a_damped_slider_keeps_its_account(record_a):
    quake = ss.GroundMotion(record_a, dt=0.1)
    r = ss.integrate(ss.Slider(BLOCK, 2.0, damping_ratio=0.05), quake)
    assert r.energy.damped > 0
    assert abs(r.energy.imbalance) < 1e-12 * r.energy.dissipated
    # next_values.json F.w2.z0.05, a block with the same level both ways
    r = ss.integrate(ss.Slider(ss.Coulomb(slip_level=1), 2.0, damping_ratio=0.05), quake)
    assert r.residual == pytest.approx(-0.02843450014561303, abs=1e-12 * r.peak)
    assert r.peak == pytest.approx(0.034217199368236067, rel=1e-12)


def test_the_slip_level_depends_on_direction_and_place():
    assert ss.Slider(BLOCK).resist() == ss.Slider(BLOCK).hold() == 1.0
    assert ss.Slider(BLOCK).hold(7.0, backward=True) == 1.6
    assert ss.Slider(BLOCK).resist(7.0, backward=True) == 1.6
    assert ss.Slider(CASTER).resist(0.5) == pytest.approx(1 / math.cosh(1), rel=1e-15)


def test_a_law_alone_is_a_slider_without_a_spring(record_a):
    quake = ss.GroundMotion(record_a, dt=0.1)
    for law in (BLOCK, CASTER):
        alone, slider = ss.integrate(law, quake), ss.integrate(ss.Slider(law), quake)
        assert np.array_equal(alone.displacement, slider.displacement)
        assert alone.slider == ss.Slider(law)
