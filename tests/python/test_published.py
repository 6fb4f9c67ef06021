"""Published problems of other programs and authors; docs/validation.md lists them."""

import math

import numpy as np
import pytest
import stickslip as ss


def test_a_released_block_on_a_spring_is_code_asters_sdnd100():
    # V5.01.100: 1 kg on a spring of 10,000 N/m, mu g = 1 m/s^2, released at 0.85 mm.
    slider = ss.Slider(ss.Coulomb(slip_level=1.0), natural_frequency=100.0)
    state = ss.State(0.85e-3)
    # It turns every pi/100 s, each time 0.2 mm nearer, and rests where the spring holds 0.5 m/s^2.
    for turn in (-0.65e-3, 0.45e-3, -0.25e-3, 0.05e-3, 0.05e-3):
        state = ss.advance(slider, state, math.pi / 100, 0.0)
        assert state.displacement == pytest.approx(turn, abs=1e-15)
    assert state.stuck
    # 4 pi/100 s after the release, not before.
    moving = ss.advance(slider, ss.State(0.85e-3), 0.1255, 0.0)
    resting = ss.advance(slider, ss.State(0.85e-3), 0.1258, 0.0)
    assert not moving.stuck
    assert resting.stuck


def test_a_block_on_a_vibrating_floor_is_code_asters_sdnd104():
    # V5.01.104: a block on a floor with n = a sin(w t). It never slides below a = mu g, and with
    # a/(mu g) above sqrt(1 + (pi/2)^2) = 1.862 it always does. Then the relative velocity turns pi
    # after each turn: the friction takes the power mu g (2/pi)(a/w) sin(turn) per unit mass.
    g, w = ss.STANDARD_GRAVITY, 2 * math.pi * 2
    block = ss.Coulomb(mu=0.1)

    def orbit(ratio):
        (found,) = ss.harmonic.orbits(block, ratio * 0.1 * g, w)
        return found

    time = np.arange(20001) * 1e-3
    shaken = ss.GroundMotion(0.999 * 0.1 * g * np.sin(w * time), dt=1e-3)
    assert ss.integrate(block, shaken).peak == 0
    assert orbit(1.86).stops_per_cycle == 2
    for ratio in (1.87, 3.0, 10.0):
        a = ratio * 0.1 * g
        half = math.cos(math.asin((math.pi / 2) / ratio))
        assert orbit(ratio).stops_per_cycle == 0
        assert orbit(ratio).dissipated * w / (2 * math.pi) == pytest.approx(
            0.1 * g * 2 / math.pi * a / w * half, rel=1e-12
        )


def test_the_corners_of_a_triple_pendulum_are_fenz_and_constantinous():
    # Earthquake Spectra 24 (2008): the displacements at which the surfaces begin to slide and reach
    # their stops, in their order: lower outer (1), inner (2 and 3), upper outer (4).
    radius = {1: 3.7465, 2: 0.3937, 3: 0.3937, 4: 3.7465}
    mu = {1: 0.04, 2: 0.01, 3: 0.01, 4: 0.08}
    travel = {1: 0.5043, 4: 0.5043}
    first = 2 * (mu[1] - mu[2]) * radius[2]
    second = first + (mu[4] - mu[1]) * (radius[1] + radius[3])
    stop1 = (
        second + travel[1] * (1 + radius[4] / radius[1]) - (mu[4] - mu[1]) * (radius[1] + radius[4])
    )
    stop4 = stop1 + (travel[4] / radius[4] + mu[4] - travel[1] / radius[1] - mu[1]) * (
        radius[2] + radius[4]
    )
    bearing = ss.TriplePendulum(
        radii=[radius[2], radius[1], radius[4]],
        mu=[mu[2], mu[1], mu[4]],
        capacities=[0.0716, travel[1], travel[4]],
    )
    displacement, force = bearing.trace([stop4 + 0.02]).corners[:5].T
    np.testing.assert_allclose(displacement, [0, first, second, stop1, stop4], rtol=1e-13, atol=0)
    np.testing.assert_allclose(
        force,
        [mu[2], mu[1], mu[4], travel[1] / radius[1] + mu[1], travel[4] / radius[4] + mu[4]],
        rtol=1e-13,
    )


def test_the_transition_density_is_touchette_van_der_straeten_and_justs():
    # J. Phys. A 43 (2010) 445002, arXiv 1008.3331, after Caughey and Dienes (1961).
    level, diffusion, t = 0.7, 0.4, 0.9
    theory = ss.theory.WhiteNoise(ss.Coulomb(slip_level=level), s0=diffusion / math.pi)
    for v0 in (-0.8, 0.0, 0.3):
        for v in (-1.5, -0.2, 0.1, 2.0):
            gauss = math.exp(
                -level * (abs(v) - abs(v0)) / (2 * diffusion)
                - level**2 * t / (4 * diffusion)
                - (v - v0) ** 2 / (4 * diffusion * t)
            ) / math.sqrt(4 * math.pi * diffusion * t)
            far = (abs(v) + abs(v0) - level * t) / (2 * math.sqrt(diffusion * t))
            there = level / (4 * diffusion) * math.exp(-level * abs(v) / diffusion)
            expected = gauss + there * math.erfc(far)
            assert theory.transition_density(v, t, v0) == pytest.approx(expected, rel=1e-12)
