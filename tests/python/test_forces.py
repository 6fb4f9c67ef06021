"""Forces and accelerations of a response: equilibrium, energy, and which side of an event."""

import math

import numpy as np
import pytest
import stickslip as ss

LEVEL, WN, C, REACH, ROLLING = 1.0, 1.3, 0.4, 0.5, 0.05
BLOCK = ss.Coulomb(slip_level=LEVEL)
UNEQUAL = ss.Coulomb(slip_level=LEVEL, backward=1.6)
WHEEL = ss.Caster(slip_level=LEVEL, reach=REACH, rolling=ROLLING)
LINER = ss.VelocityDependent(slow=0.6, fast=1.2, rate=5)

SLIDERS = {
    "block": ss.Slider(BLOCK),
    "unequal": ss.Slider(UNEQUAL),
    "one-way": ss.Slider(ss.Coulomb(slip_level=LEVEL, backward=math.inf)),
    "block on a spring": ss.Slider(BLOCK, WN),
    "block with a damper": ss.Slider(BLOCK, damping=C),
    "block on both": ss.Slider(BLOCK, WN, C),
    "caster": ss.Slider(WHEEL),
    "caster on both": ss.Slider(WHEEL, WN, C),
    "liner": ss.Slider(LINER),
    "liner on both": ss.Slider(LINER, WN, C),
    "no friction": ss.ViscousSlider(C, WN),
}
FINE = 0.1 / 128


def refined(samples, factor):
    """The same straight lines in `factor` times as many segments."""
    at = np.arange((len(samples) - 1) * factor + 1) / factor
    return ss.GroundMotion(np.interp(at, np.arange(len(samples)), samples), dt=0.1 / factor)


@pytest.fixture(scope="module", params=SLIDERS)
def fine(request, record_a):
    return ss.integrate(SLIDERS[request.param], refined(record_a[:161], 128))


def held(*values, duration=1.0):
    """Values held for `duration` each; the sample that closes the motion is added."""
    return ss.GroundMotion([*values, 0.0], dt=duration, interpolation="constant")


# ---- what they are


def test_forces_outlive_their_response():
    r = ss.integrate(SLIDERS["block on both"], held(2, -2))
    kept = r.friction, r.stuck, r.force
    copies = [array.copy() for array in kept]
    del r
    assert all(np.array_equal(a, b) for a, b in zip(kept, copies))


def test_spring_and_damper_follow_x_and_v(fine):
    assert np.array_equal(fine.spring, fine.slider.natural_frequency**2 * fine.displacement)
    assert np.array_equal(fine.damper, fine.slider.damping * fine.velocity)


def test_the_absolute_acceleration_is_what_the_forces_give(fine):
    assert np.array_equal(fine.force, fine.friction + fine.damper + fine.spring)
    assert np.array_equal(fine.acceleration, -fine.force)


def test_the_sticks_are_those_between_the_events(fine):
    events = fine.events
    changes = events[:-1]
    stuck = np.ones(fine.time.size, bool)
    for time, kind in zip(changes["time"], changes["kind"]):
        stuck[fine.time >= time] = kind == "arrest"
    assert np.array_equal(fine.stuck, stuck)
    # a sample stands for a step, wrong by less than one at either end of each stick
    ends = np.count_nonzero(changes["kind"] != "reversal")
    spent = np.count_nonzero(~stuck) * FINE
    assert spent == pytest.approx(fine.time_sliding, abs=(ends + 1) * FINE)


# ---- energy


# ---- which side


def test_of_steps_without_length_the_last_counts():
    quake = ss.GroundMotion(
        [0.25, 5, 0.5, 7, 0.75, 9], times=[0, 1, 1, 2, 2, 2], interpolation="constant"
    )
    r = ss.integrate(BLOCK, quake)
    assert r.stuck.all()
    assert r.acceleration.tolist() == [0.25, 0.5, 0.5, 0.5, 0.5, 0.5]


def test_at_the_end_the_last_ground_acceleration_acts():
    assert ss.integrate(BLOCK, held(0.5, 0.75)).acceleration.tolist() == [0.5, 0.75, 0.75]
    line = ss.GroundMotion([0.5, 0.75], dt=1)
    assert ss.integrate(BLOCK, line).acceleration.tolist() == [0.5, 0.75]
    assert ss.integrate(BLOCK, line, settle=True).acceleration.tolist() == [0.5, 0.75]


@pytest.mark.parametrize("name", [name for name in SLIDERS if name != "no friction"])
def test_after_the_motion_the_ground_rests(name, record_a):
    slider = SLIDERS[name]
    quake = ss.GroundMotion([*(3 * record_a[:47]), -8, -8, -8], dt=0.1)  # all slide forward then
    r = ss.integrate(slider, quake, settle=True)
    after = slice(50, None)
    assert r.time.size > 51
    assert r.at_rest
    # friction that grows with the speed lets a spring creep: its samples end before the rest
    assert r.truncated == (name == "liner on both") == (not r.stuck[-1])
    if r.stuck[-1]:
        assert r.friction[-1] == -r.spring[-1]
        assert r.acceleration[-1] == 0
    sliding = ~r.stuck[after]
    assert sliding.any()
    # a body that slows down: friction takes energy
    assert (r.friction[after][sliding] * r.velocity[after][sliding] > 0).all()


def test_under_a_harmonic_motion_a_stuck_slider_moves_as_the_cosine():
    motion = ss.HarmonicMotion(1.2, 3, 5, dt=0.01)
    r = ss.integrate(BLOCK, motion)
    assert 50 < np.count_nonzero(r.stuck) < r.time.size - 50
    assert r.acceleration[r.stuck] == pytest.approx(motion.acceleration[r.stuck], abs=1e-14)
    assert (np.abs(r.friction[~r.stuck]) == LEVEL).all()
    assert (np.abs(r.friction) <= LEVEL + 1e-14).all()


def test_a_start_on_its_way_slides_from_the_first_sample():
    r = ss.integrate(BLOCK, ss.GroundMotion([0, 0], dt=0.1), velocity=-0.5)
    assert r.friction.tolist() == [-1, -1]
    assert not r.stuck.any()


def test_a_long_record_side_by_side_has_the_same_forces(record_a):
    """From 8192 samples on integrate cuts a record in pieces; the forces show none of it."""
    long = ss.integrate(BLOCK, refined(record_a, 32))
    short = ss.integrate(BLOCK, refined(record_a[:241], 32))
    assert long.time.size > 8192 > short.time.size
    same = slice(0, short.time.size - 1)
    assert np.array_equal(long.stuck[same], short.stuck[same])
    assert long.friction[same] == pytest.approx(short.friction[same], abs=1e-12)
