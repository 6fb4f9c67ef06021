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


@pytest.mark.parametrize("name", ["acceleration", "friction", "spring", "damper", "force", "stuck"])
def test_forces_are_read_only_arrays_at_the_samples(fine, name):
    array = getattr(fine, name)
    assert array.shape == fine.time.shape
    assert array.dtype == (np.bool_ if name == "stuck" else np.float64)
    assert not array.flags.writeable


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


def away_from_events(r, steps):
    """Samples no event is within `steps` steps of."""
    times = r.events["time"][:-1]
    next_ = np.searchsorted(times, r.time)
    before = r.time - np.append(-np.inf, times)[next_]
    after = np.append(times, np.inf)[next_] - r.time
    inside = np.minimum(before, after) > (steps + 0.5) * FINE
    inside[:steps] = inside[-steps:] = False
    return inside


def corners(r, steps):
    """Samples where the ground acceleration has no corner within `steps` steps."""
    k = np.arange(r.time.size) % 128
    return (k > steps) & (k < 128 - steps)


def test_during_slips_the_acceleration_is_the_derivative_of_the_velocity(fine):
    # Central differences of h and 2 h, extrapolated: h^4 / 30 of the fifth derivative of v. The
    # liner's is largest: 5 s/m of up to 4 m/s^2 are 20 1/s, 20^4 * 4 m/s^2 = 6.4e5: 8e-9. Round-off
    # of v over h is below 1e-12.
    r, v = fine, fine.velocity
    inside = away_from_events(r, 2) & corners(r, 2) & ~r.stuck
    assert np.count_nonzero(inside) > 500
    i = np.flatnonzero(inside)
    slope = (8 * (v[i + 1] - v[i - 1]) - (v[i + 2] - v[i - 2])) / (12 * FINE)
    got = r.acceleration[i] - r.motion.acceleration[i]
    assert got == pytest.approx(slope, abs=1e-8)


def test_a_slider_that_sticks_moves_with_the_ground(fine):
    stuck = fine.stuck
    if fine.slider.hold() == 0:
        assert not stuck[1:].any()
        return
    assert stuck.any()
    assert not fine.velocity[stuck].any()
    ground = fine.motion.acceleration[stuck]
    # the spring's force is subtracted and added again
    assert fine.acceleration[stuck] == pytest.approx(ground, abs=1e-15)


def test_friction_at_rest_is_within_what_it_holds(fine):
    rest = np.flatnonzero(fine.stuck)
    for x, friction in zip(fine.displacement[rest].tolist(), fine.friction[rest].tolist()):
        assert friction <= fine.slider.hold(x) + 1e-14
        assert friction >= -fine.slider.hold(x, backward=True) - 1e-14


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


@pytest.mark.parametrize("name", SLIDERS)
def test_friction_during_slips_is_that_of_the_law(name, record_a):
    r = ss.integrate(SLIDERS[name], refined(record_a[:161], 8))
    moving = r.velocity != 0
    x, v, f = r.displacement[moving], r.velocity[moving], r.friction[moving]
    ahead = back = LEVEL
    if name in ("unequal", "one-way"):
        back = 1.6 if name == "unequal" else math.inf
    if name == "no friction":
        ahead = back = 0
    level = np.where(v > 0, ahead, back)
    if "caster" in name:
        level = LEVEL / np.cosh(x / REACH) + ROLLING
    if "liner" in name:
        level = 1.2 - 0.6 * np.exp(-5 * np.abs(v))
    assert moving.sum() > 100
    assert not r.stuck[moving].any()
    assert f == pytest.approx(np.sign(v) * level, rel=1e-14, abs=0)


# ---- energy


@pytest.mark.parametrize("name", SLIDERS)
def test_the_work_of_the_forces_approaches_the_energies(name, record_a):
    # friction x' and damper x' are continuous with corners: the trapezoidal rule converges as h^2
    misses = []
    for factor in (16, 64, 256):
        r = ss.integrate(SLIDERS[name], refined(record_a[:161], factor))
        h = 0.1 / factor
        work = [np.sum(f * r.velocity) * h for f in (r.friction, r.damper)]
        work[0] -= (r.friction[-1] * r.velocity[-1] + r.friction[0] * r.velocity[0]) * h / 2
        work[1] -= (r.damper[-1] * r.velocity[-1] + r.damper[0] * r.velocity[0]) * h / 2
        misses.append(np.abs(np.subtract(work, (r.energy.dissipated, r.energy.damped))))
    total = r.energy.dissipated + r.energy.damped
    # 256 a segment: h^2 / 12 of the integral of |(F v)''|, some (2 pi / 0.2 s)^2 of the work
    assert max(misses[-1]) < 1e-4 * total
    # corners at events make the factor of 16 uneven; a method of first order would reach 4
    for coarse, dense in zip(misses[0], misses[-1]):
        assert dense <= coarse / 40 + 1e-13


# ---- which side


def test_at_a_sample_where_a_slip_begins_it_slides():
    # held 0.5, within the level; then 3: backward with -3 + 1; then 0.5: it slows by 0.5
    r = ss.integrate(BLOCK, held(0.5, 3.0, 0.5))
    assert r.stuck.tolist() == [True, False, False, False]
    assert r.friction == pytest.approx([-0.5, -1, -1, -1])
    assert r.acceleration == pytest.approx([0.5, 1, 1, 1])
    assert r.velocity == pytest.approx([0, 0, -2, -1.5])


def test_at_a_sample_where_a_slip_stops_it_sticks():
    # -2 m/s after 1 s, which friction takes 2 s to stop: at a sample, exactly
    r = ss.integrate(BLOCK, held(3, 0, 0, 0.25))
    assert r.stuck.tolist() == [False, False, False, True, True]
    assert r.friction.tolist() == [-1, -1, -1, -0.25, -0.25]
    assert r.acceleration.tolist() == [1, 1, 1, 0.25, 0.25]


def test_at_a_sample_where_a_slip_turns_friction_points_the_new_way():
    # -1 m/s after 1 s, none after 2, where the ground pulls it forward
    r = ss.integrate(BLOCK, held(2, 0, -3))
    assert r.velocity == pytest.approx([0, -1, 0, 2])
    assert r.friction.tolist() == [-1, -1, 1, 1]
    assert not r.stuck.any()


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
