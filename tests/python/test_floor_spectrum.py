"""Floor spectra: the response spectrum of the absolute acceleration of a slider."""

import math

import numpy as np
import pytest
import stickslip as ss

PERIODS = [0.0, 0.1, 0.3, 1.0, 3.0]
QUAKE = ss.GroundMotion(
    3 * np.convolve(np.random.default_rng(5).standard_normal(600), np.ones(5) / 5, "same"), dt=0.02
)


def floor(slider, motion=QUAKE, **options):
    return ss.response_spectrum(ss.integrate(slider, motion, settle=True), PERIODS, **options)


def test_a_floor_that_never_slips_has_the_spectrum_of_the_ground():
    spectrum, ground = floor(ss.Coulomb(mu=1000)), ss.response_spectrum(QUAKE, PERIODS)
    assert np.array_equal(spectrum.values, ground.values)


def test_a_rigid_thing_on_a_sliding_floor_feels_its_friction():
    spectrum = floor(ss.Coulomb(mu=0.05), damping=[0.02, 0.05])
    assert spectrum.values.shape == (2, 5)
    assert spectrum.values[:, 0] == pytest.approx(0.05 * ss.STANDARD_GRAVITY, rel=1e-13)
    assert spectrum.values[0, 0] < QUAKE.peak_acceleration / 2


def test_it_is_that_of_the_accelerations_as_a_motion_in_many_small_steps():
    """Straight lines over the same histories, sampled finely, miss each jump by half a step."""
    slider = ss.Slider(ss.Coulomb(mu=0.05), period=2, damping_ratio=0.1)
    errors = []
    for dt in (1e-3, 2.5e-4):
        fine = QUAKE.resampled(dt)
        response = ss.integrate(slider, fine, settle=True)
        lines = ss.GroundMotion(response.acceleration, dt=dt)
        errors.append(
            np.abs(ss.response_spectrum(lines, PERIODS).values / floor(slider).values - 1).max()
        )
    assert errors[0] < 0.01
    assert errors[1] < errors[0] / 2  # of the first order in dt, or better


@pytest.mark.parametrize(
    "law", [ss.Caster(mu=0.05, reach=2), ss.VelocityDependent(mu_slow=0.03, mu_fast=0.06, rate=50)]
)
def test_any_law_has_a_floor_spectrum(law):
    values = floor(ss.Slider(law, period=2)).values
    halved = floor(ss.Slider(law, period=2), QUAKE.resampled(0.005)).values
    assert values == pytest.approx(halved, rel=1e-4)


LIFTS = 9 * np.sin(0.9 * np.arange(600)) * np.sin(np.pi * np.arange(600) / 599)


@pytest.mark.parametrize(
    ("slider", "options"),
    [
        (ss.FrictionPendulum(radius=1, mu=0.05), {"vertical": LIFTS}),
        (ss.Slider(ss.Coulomb(mu=0.05), period=2, damping_ratio=0.1), {"vertical": 2 * LIFTS}),
        (ss.Slider(ss.Coulomb(mu=0.15), slope_degrees=5), {"vertical": LIFTS}),
        (ss.Slider(ss.Coulomb(mu=0.15), slope_degrees=5, one_way=True), {}),
        (
            ss.Slider(ss.VelocityDependent(mu_slow=0.03, mu_fast=0.06, rate=50), period=2),
            {"vertical": LIFTS},
        ),
    ],
    ids=["pendulum", "clipped", "slope", "one-way", "liner"],
)
def test_any_mounting_has_the_spectrum_of_its_accelerations(slider, options):
    """Straight lines over the same histories, sampled finely, miss each jump by half a step."""
    quake = ss.GroundMotion(QUAKE.acceleration, dt=0.02, **options)
    periods = [0.1, 0.3, 1.0, 3.0]
    exact = ss.response_spectrum(
        ss.integrate(slider, quake, settle=True, contact="clipped"), periods
    ).values
    errors = []
    for dt in (1e-3, 2.5e-4):
        response = ss.integrate(slider, quake.resampled(dt), settle=True, contact="clipped")
        lines = ss.GroundMotion(response.acceleration, dt=dt)
        errors.append(np.abs(ss.response_spectrum(lines, periods).values / exact - 1).max())
    assert errors[0] < 0.02
    assert errors[1] < errors[0] / 2  # of the first order in dt, or better


def test_an_impact_is_an_impulse():
    """A block thrown against a stop gives a stiff oscillator wn times the jump of its velocity."""
    block = ss.Slider(ss.Coulomb(slip_level=1e-9), stops=ss.Stops(gap=0.1, restitution=0.5))
    response = ss.integrate(block, ss.GroundMotion([0, 0], dt=0.15), velocity=1)
    assert len(response.impacts) == 1
    period = 0.01
    (value,) = ss.response_spectrum(response, period, 0.0).values
    assert value == pytest.approx(2 * math.pi / period * 1.5, rel=1e-6)
    with pytest.raises(
        ValueError, match="an impact on a stop or a landing is an impulse; give per"
    ):
        ss.response_spectrum(response, [0.0, 1.0])
    assert ss.response_spectrum(response, 0.0, kind="displacement").values.tolist() == [0]


def test_harmonic_motions_too():
    motion = ss.HarmonicMotion(1.0, 5.0, 20.0)
    response = ss.integrate(ss.Coulomb(slip_level=2), motion)
    (value,) = ss.response_spectrum(response, [2 * math.pi / 5], damping=0.05).values
    sampled = ss.response_spectrum(motion.sampled(1e-3), [2 * math.pi / 5], damping=0.05)
    assert value == pytest.approx(sampled.values[0], rel=1e-5)
