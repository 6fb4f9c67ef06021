"""The estimate of ASCE 43-05: closed forms, the search for the lowest frequency, directions."""

import math

import numpy as np
import pytest
import stickslip as ss
from stickslip.risk import asce43 as search

G = ss.STANDARD_GRAVITY
ZETA = 0.1
ROOT = math.sqrt(1 - ZETA**2)


def noise(seed, samples=800, dt=0.02):
    """Band-limited noise under an envelope; the ground comes to rest."""
    rng = np.random.default_rng(seed)
    n = np.convolve(rng.standard_normal(samples), np.hanning(9), "same")
    t = np.arange(samples) * dt
    envelope = np.minimum(t / 2, 1) * np.exp(-np.maximum(t - 6, 0) / 3)
    return envelope * (n - (n * envelope).sum() / envelope.sum())


def spectrum(motion, frequency, kind="pseudo_acceleration"):
    return np.asarray(ss.response_spectrum(motion, 1 / frequency, ZETA, kind=kind).values)


# ---- closed forms


def test_a_jump_of_the_ground_velocity():
    """An oscillator that is hit reaches V / wn exp(-zeta acos(zeta) / sqrt(1 - zeta^2)).

    The pulse lasts 2e-4 s: the spectrum is lower by (wn dt)^2 / 12, 4e-8.
    """
    jump, dt, mu = 1.0, 1e-4, 0.3
    quake = ss.GroundMotion([0, jump / dt, 0], dt=dt)
    e = ss.asce43(mu=mu, motion=quake)
    peak = math.exp(-ZETA * math.acos(ZETA) / ROOT)
    level = 2 * mu * G
    assert e.sliding_acceleration == pytest.approx(level, rel=1e-15)
    assert e.frequency == pytest.approx(level / (2 * math.pi * jump * peak), rel=1e-6)
    assert e.displacement == pytest.approx((jump * peak) ** 2 / level, rel=2e-6)
    assert e.reached


def test_a_step_that_lasts():
    """An oscillator exceeds a constant acceleration by the factor 1 + exp(-pi zeta / root) at most.

    The end of the step is a second one, which can add as much again.
    """
    step = 3.0
    quake = ss.GroundMotion([step, step], dt=40.0, interpolation="constant")
    factor = 1 + math.exp(-math.pi * ZETA / ROOT)
    assert not ss.asce43(mu=1.001 * 2 * factor * step / (2 * G), motion=quake).reached
    assert ss.asce43(mu=0.9 * factor * step / (2 * G), motion=quake).reached


@pytest.mark.parametrize("factor", [0.3, 4.0])
def test_scaling(factor):
    n = noise(1)
    one = ss.asce43(mu=0.1, motion=ss.GroundMotion(n, dt=0.02))
    scaled = ss.asce43(mu=0.1 * factor, motion=ss.GroundMotion(factor * n, dt=0.02))
    assert scaled.frequency == pytest.approx(one.frequency, rel=1e-6)
    assert scaled.displacement == pytest.approx(factor * one.displacement, rel=2e-6)
    slow = ss.asce43(mu=0.1, motion=ss.GroundMotion(n, dt=0.02 * factor))
    assert slow.frequency == pytest.approx(one.frequency / factor, rel=1e-6)


# ---- the lowest frequency


@pytest.mark.parametrize("seed", range(6))
def test_the_rate_of_change_of_a_spectrum_is_bounded(seed):
    """|dA / d ln f| <= alpha B, |dB / d ln f| <= beta A + gamma B; B: the velocity times 2 pi f."""
    motion = ss.GroundMotion(noise(seed), dt=0.02)
    f = np.geomspace(0.02, 500, 4000)
    h = 1e-5
    wide = np.stack([f, f * math.exp(h)])
    a = spectrum(motion, wide.ravel()).reshape(2, -1)
    b = (2 * np.pi * wide) * spectrum(motion, wide.ravel(), "velocity").reshape(2, -1)
    # Differences of values that are accurate to 1e-13
    assert (np.abs(np.diff(a, axis=0)[0]) / h <= search._ALPHA * b[0] * 1.001 + 1e-6).all()
    grows = search._BETA * a[0] + search._GAMMA * b[0]
    assert (np.abs(np.diff(b, axis=0)[0]) / h <= grows * 1.001 + 1e-6).all()


def test_the_constants_of_the_bound_are_integrals_of_the_impulse_response():
    u = np.linspace(0, 200, 2_000_001)
    response = np.exp(-ZETA * u) * np.sin(ROOT * u) / ROOT
    assert np.trapezoid(np.abs(response), u) == pytest.approx(search._OF_FORCE, rel=1e-6)
    assert np.abs(np.diff(response)).sum() == pytest.approx(search._OF_RATE, rel=1e-6)


def test_nearby_values_are_bounded():
    """From each frequency to those up to 10 % away."""
    motion = ss.GroundMotion(noise(3), dt=0.02)
    f = np.geomspace(0.05, 50, 300)
    a = spectrum(motion, f)
    b = 2 * np.pi * f * spectrum(motion, f, "velocity")
    for distance in (0.003, 0.03, 0.1):
        bound = search._largest_nearby(a, b, distance)
        for sign in (-1, 1):
            assert (spectrum(motion, f * math.exp(sign * distance)) <= bound).all()


@pytest.mark.parametrize("seed", range(8))
def test_it_is_the_first_crossing_of_a_dense_scan(seed):
    motion = ss.GroundMotion(noise(seed), dt=0.02)
    f = np.geomspace(0.02, 1000, 40_000)
    a = spectrum(motion, f)
    for level in np.quantile(a, [0.2, 0.5, 0.8, 0.97]):
        e = ss.asce43(mu=level / (2 * G), motion=motion)
        first = np.argmax(a >= level)
        assert f[first - 1] * (1 - 1e-6) < e.frequency <= f[first] * (1 + 1e-6)
        assert spectrum(motion, np.array([e.frequency]))[0] >= level * (1 - 1e-12)
        below = spectrum(motion, np.array([e.frequency * (1 - 1e-6)]))[0]
        assert below < level
    assert not ss.asce43(mu=1.001 * a.max() / (2 * G), motion=motion).reached


@pytest.mark.parametrize("seed", [0, 2, 5])
def test_the_tip_of_a_maximum_is_not_missed(seed):
    """A level that only the tip of the first maximum reaches, before higher ones."""
    motion = ss.GroundMotion(noise(seed), dt=0.02)
    f = np.geomspace(0.02, 50, 20_000)
    a = spectrum(motion, f)
    record = np.maximum.accumulate(a)
    tips = [
        i
        for i in range(1, f.size - 1)
        if a[i - 1] < a[i] >= a[i + 1] and a[i] == record[i] and a[i] < 0.95 * a.max()
    ]
    assert tips
    for i in tips:
        fine = np.linspace(f[i - 1], f[i + 1], 1000)
        values = spectrum(motion, fine)
        tip, place = values.max(), fine[values.argmax()]
        # 1e-5 below the tip, the crossing is narrower than the first grid
        found = ss.asce43(mu=tip * (1 - 1e-5) / (2 * G), motion=motion).frequency
        assert found == pytest.approx(place, rel=0.01) and found < place
        above = ss.asce43(mu=tip * (1 + 1e-4) / (2 * G), motion=motion).frequency
        assert above > place
        between = np.linspace(place, above * (1 - 1e-6), 5000)
        assert spectrum(motion, between).max() < tip * (1 + 1e-4)


def test_a_level_just_above_the_peak_acceleration_is_searched_up_to_the_end():
    """Stiff oscillators stay below it, by a factor of a millionth."""
    motion = ss.GroundMotion([0, 1, 0], dt=10.0)  # slow: hardly any oscillator amplifies it
    f = np.geomspace(0.02, 1000, 5000)
    largest = spectrum(motion, f).max()
    assert not ss.asce43(mu=largest * (1 + 1e-4) / (2 * G), motion=motion).reached


def test_it_is_reached_at_the_lowest_frequency_of_the_search():
    motion = ss.GroundMotion([0, 50, 0], dt=10.0)
    e = ss.asce43(mu=0.01, motion=motion)
    assert e.frequency == 0.02
    assert e.displacement == pytest.approx(0.02 * G / (0.04 * math.pi) ** 2, rel=1e-12)


# ---- components


def test_components_along_one_line_are_one_component():
    n = noise(4)
    flat = ss.GroundMotion(n, dt=0.02)
    pair = ss.GroundMotion(0.6 * n, dt=0.02, transverse=-0.8 * n)
    a, b = (ss.asce43(mu=0.15, motion=motion) for motion in (flat, pair))
    assert a.frequency == pytest.approx(b.frequency, rel=1e-6)
    assert a.spectrum == "10 % damped, along the axis"
    assert b.spectrum == "10 % damped, largest over directions"


@pytest.mark.parametrize("mu", [0.05, 0.15, 0.3])
def test_the_axes_do_not_matter(mu):
    pair = ss.GroundMotion(noise(5), dt=0.02, transverse=noise(6))
    frequencies = [ss.asce43(mu=mu, motion=pair.rotated(angle)).frequency for angle in (0, 37, 90)]
    assert frequencies == pytest.approx([frequencies[0]] * 3, rel=2e-7)


@pytest.mark.parametrize("mu", [0.05, 0.15, 0.3])
def test_it_is_the_largest_over_directions(mu):
    """As RotD100, in steps of 1 degree, which lies below it by less than 4e-5."""
    pair = ss.GroundMotion(noise(7), dt=0.02, transverse=0.7 * noise(8))
    e = ss.asce43(mu=mu, motion=pair)
    below = np.geomspace(0.02, e.frequency * (1 - 1e-6), 200)
    largest = ss.rotd(pair, 1 / np.append(below, e.frequency), ZETA).rotd100
    assert largest[-1] == pytest.approx(e.sliding_acceleration, rel=4e-5)
    assert (largest[:-1] < e.sliding_acceleration).all()
    one = ss.asce43(mu=mu, motion=pair.component("axis"))
    assert not one.reached or one.frequency >= e.frequency * (1 - 1e-6)


def test_a_circular_motion_has_one_spectrum_in_all_directions():
    """Every direction decides then, and the two bounds must still meet."""
    t = np.arange(0, 10, 0.01)
    pair = ss.GroundMotion(np.cos(3 * t), dt=0.01, transverse=np.sin(3 * t))
    f = ss.asce43(mu=0.2, motion=pair).frequency
    assert ss.rotd(pair, 1 / f, ZETA).rotd100[0] == pytest.approx(0.4 * G, rel=4e-5)


def test_vertical_motion_reduces_the_friction():
    n, up = noise(1), 4 * noise(2)
    flat = ss.GroundMotion(n, dt=0.02)
    e = ss.asce43(mu=0.2, motion=ss.GroundMotion(n, dt=0.02, vertical=up))
    peak = np.abs(up).max()
    assert e.peak_vertical_acceleration == peak
    assert e.effective_mu == pytest.approx(0.2 * (1 - 0.4 * peak / G), rel=1e-14)
    same = ss.asce43(mu=e.effective_mu, motion=flat)
    assert e.frequency == same.frequency and e.displacement == same.displacement
    assert same.peak_vertical_acceleration == 0


# ---- what users see


def test_what_is_never_reached():
    e = ss.asce43(mu=2, motion=ss.GroundMotion(noise(1), dt=0.02).scaled_to(pga_g=0.2))
    assert (e.displacement, e.frequency, e.reached) == (0.0, None, False)
    assert "never reached" in repr(e) and "ASCE/SEI 43-05" in repr(e)


def test_a_result_names_spectrum_and_edition():
    e = ss.asce43(mu=0.1, motion=ss.GroundMotion(noise(1), dt=0.02))
    assert isinstance(e, ss.ASCE43Estimate)
    assert e.edition == "ASCE/SEI 43-05, appendix A"
    assert f"at {e.frequency:.4g} Hz, 10 % damped, along the axis" in repr(e)
    assert e == ss.asce43(mu=0.1, motion=ss.GroundMotion(noise(1), dt=0.02))


@pytest.mark.parametrize("mu", [0, -0.1, math.nan, math.inf])
def test_a_friction_that_is_none_is_named(mu):
    with pytest.raises(ValueError, match="asce43: mu must be positive and finite, got"):
        ss.asce43(mu=mu, motion=ss.GroundMotion([0, 1, 0], dt=0.1))


def test_other_input_is_named():
    with pytest.raises(TypeError, match="motion must be a GroundMotion, got list"):
        ss.asce43(mu=0.1, motion=[1, 2])
    up = ss.GroundMotion([0, 1, 0], dt=0.1, vertical=[0, 2.6 * G, 0])
    with pytest.raises(ValueError, match=r"must be below 2\.5 g, .* got 2\.6 g"):
        ss.asce43(mu=0.1, motion=up)
