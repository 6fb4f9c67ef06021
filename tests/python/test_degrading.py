"""Friction that depends on the sliding distance: arguments, memory, functions that reject it."""

import pickle

import numpy as np
import pytest
import stickslip as ss
from stickslip import harmonic, theory

G = 9.80665  # m/s^2, exact by definition (CGPM 1901)
MOTION = ss.GroundMotion(
    2 * np.sin(0.7 * np.arange(401)) + 1.3 * np.cos(1.9 * np.arange(401) + 0.4), dt=0.1
)
LAW = ss.Degrading(distance=[0, 0.3, 2], slip_level=[1, 0.4, 0.5])


def test_the_level_is_linear_between_knots():
    slider = ss.Slider(ss.Degrading(distance=[0.1, 0.3], mu=[0.3, 0.2]))
    for slid, mu in ((0, 0.3), (0.1, 0.3), (0.2, 0.25), (0.3, 0.2), (7, 0.2)):
        assert slider.resist(sliding_distance=slid) == pytest.approx(mu * G, rel=1e-15)
        assert slider.hold(sliding_distance=slid, backward=True) == pytest.approx(mu * G, rel=1e-15)
    with pytest.raises(
        ValueError, match=r"sliding_distance must be finite and at least 0, got -1 m"
    ):
        slider.hold(sliding_distance=-1)


def test_levels_are_given_in_several_ways():
    given = ss.Degrading(distance=[0, 0.1], mu=[0.3, 0.2])
    assert given == ss.Degrading(distance=(0, 0.1), ky_g=np.array([0.3, 0.2]))
    assert given == ss.Degrading(distance=[0, 0.1], slip_level=[0.3 * G, 0.2 * G])
    assert given == ss.Degrading(distance=[0, 0.1], mu=[0.3, 0.2], backward=given.slip_level)
    assert given != ss.Degrading(distance=[0, 0.1], mu=[0.3, 0.2], mu_backward=[0.3, 0.3])
    np.testing.assert_array_equal(given.distance, [0, 0.1])
    np.testing.assert_array_equal(given.slip_level, [0.3 * G, 0.2 * G])


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"distance": [0, 1]}, "give one of mu, ky_g and slip_level, got none"),
        ({"distance": [0], "mu": [1], "ky_g": [1]}, "give one of .*, got mu and ky_g"),
        (
            {"distance": [0], "mu": [1], "mu_backward": [1], "backward": [1]},
            "got mu_backward and backward",
        ),
        ({"distance": [0, 1], "mu": [0.1]}, "levels must be as many as distances, 2, got 1"),
        ({"distance": [1, 0], "mu": [1, 1]}, r"distance\[1\] must be above the one before, 1 m"),
        ({"distance": [0, 1], "mu": [1, -1]}, r"mu\[1\] must be finite and at least 0, got -1"),
        ({"distance": [0, np.nan], "mu": [1, 1]}, r"distance\[1\] must be finite"),
        ({"distance": [], "mu": []}, "distance must hold at least one"),
    ],
)
def test_what_cannot_be_is_refused(arguments, message):
    with pytest.raises(ValueError, match=message):
        ss.Degrading(**arguments)


def test_numbers_without_names_are_refused():
    with pytest.raises(TypeError, match=r"Degrading: give distance= \[m\], and mu=, ky_g="):
        ss.Degrading([0, 1], [0.3, 0.2])


@pytest.mark.parametrize(
    "slider",
    [
        ss.Slider(LAW),
        ss.Slider(LAW, 2, 0.3),
        ss.Slider(LAW, slope_degrees=3, one_way=True),
        ss.Slider(ss.StaticKinetic(LAW, static=1.2), 2),
    ],
    ids=repr,
)
def test_a_run_that_is_split_has_the_same_bits(slider):
    whole = ss.integrate(slider, MOTION)
    state, x = ss.State(), [0.0]
    for start, end in zip(MOTION.acceleration[:-1], MOTION.acceleration[1:], strict=True):
        state = pickle.loads(pickle.dumps(ss.advance(slider, state, 0.1, start, end)))
        x.append(state.displacement)
    np.testing.assert_array_equal(x, whole.displacement)
    assert state == whole.state
    assert state.sliding_distance == pytest.approx(whole.sliding_distance, rel=1e-12)
    first = ss.integrate(slider, ss.GroundMotion(MOTION.acceleration[:201], dt=0.1))
    second = ss.integrate(
        slider,
        ss.GroundMotion(MOTION.acceleration[200:], dt=0.1),
        displacement=first.state.displacement,
        velocity=first.state.velocity,
        sliding_distance=first.state.sliding_distance,
    )
    assert second.state == whole.state
    # Each of 400 steps and some 100 events adds roundings of the work.
    assert abs(whole.energy.imbalance) <= 1e-12 * whole.energy.dissipated


def test_a_second_quake_finds_what_the_first_left():
    first = ss.integrate(LAW, MOTION, settle=True)
    again = ss.integrate(LAW, MOTION, sliding_distance=first.state.sliding_distance)
    assert first.state.sliding_distance > 2  # beyond the last knot: constant from there on
    constant = ss.integrate(ss.Coulomb(slip_level=0.5), MOTION)
    np.testing.assert_allclose(again.displacement, constant.displacement, atol=1e-12)
    with pytest.raises(ValueError, match="sliding_distance must be finite and at least 0"):
        ss.integrate(LAW, MOTION, sliding_distance=-1)


def test_the_friction_force_follows_the_distance():
    r = ss.integrate(ss.Slider(LAW, 2), MOTION)
    sliding = ~r.stuck & (r.velocity != 0)
    assert sliding.sum() > 100
    assert (np.abs(r.friction[sliding]) >= 0.4 - 1e-12).all()
    assert (np.abs(r.friction) <= 1 + 1e-12).all()
    assert np.abs(r.friction[sliding][-1]) == pytest.approx(0.5, rel=1e-12)


def test_theories_and_orbits_refuse_it_in_a_sentence():
    message = "a resistance that depends on the distance slid is not covered"
    pulses = ss.PoissonPulses(rate=3, half_width=1 / 6, sigma=2.5, duration=6)
    with pytest.raises(ValueError, match=message):
        harmonic.orbits(LAW, 2, 3)
    assert message in str(theory.PulseSuperposition().covers(LAW, pulses))
    assert not theory.PulseChain().covers(LAW, pulses)
    with pytest.raises(ValueError, match=message):
        theory.pulse_response(LAW, 1.0, 0.1)


def test_a_drawn_level_makes_an_ensemble():
    def soil(mu):
        return ss.Degrading(distance=[0, 0.1], mu=[mu, 0.7 * mu])

    sliders = [soil(mu) for mu in (0.05, 0.1)]
    e = ss.run_ensemble(sliders, [MOTION], members=4, seed=1)
    expected = [ss.integrate(one, MOTION).residual for one in sliders] * 2
    assert e.residual == pytest.approx(expected, rel=1e-13)
    assert "Degrading" in str(e.configuration)
