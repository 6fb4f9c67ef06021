"""Sliders under ground motions, against numbers computed apart from this library."""

import math
import subprocess
import sys

import numpy as np
import pytest
import stickslip as ss
from reference import rows, tuples

INF, NAN = math.inf, math.nan


def counts(response):
    kinds = response.events["kind"].tolist()
    return tuple(kinds.count(kind) for kind in ("breakaway", "arrest", "reversal"))


def line(start, end, duration):
    return ss.GroundMotion([start, end], dt=duration)


def steps(*values, duration=1.0):
    """Values held for `duration` each; the sample that closes the motion is added."""
    return ss.GroundMotion([*values, 0.0], dt=duration, interpolation="constant")


# ---- record A, whole


RUNS = [
    *(
        (run, ss.Coulomb(slip_level=1.0, backward=run["backward"]))
        for run in rows("sliders", "coulomb")
    ),
    *((run, ss.Caster(slip_level=1.0, reach=0.5)) for run in rows("sliders", "caster")),
]


@pytest.mark.parametrize("run, law", RUNS, ids=[run["id"] for run, _ in RUNS])
def test_record_a_ends_as_fifty_digits_say(run, law, record_a):
    # Coulomb: each of some 500 closed-form steps rounds a few times to 1.1e-16 of the scale of x;
    # were they all to go one way, 500 * 2 * 1.1e-16 = 1e-13. The caster: ten roundings more a step,
    # and the tolerance it promises is "near round-off" only.
    tolerance = 1e-11 if isinstance(law, ss.Caster) else 1e-13
    quake = ss.GroundMotion(record_a, dt=0.1, interpolation=run.get("interpolation", "linear"))
    r = ss.integrate(ss.Slider(law, run["natural_frequency"]), quake)
    speed = np.max(np.abs(r.velocity))
    assert r.residual == pytest.approx(run["displacement"], rel=0, abs=tolerance * run["peak"])
    assert r.velocity[-1] == pytest.approx(run["velocity"], rel=0, abs=tolerance * speed)
    assert r.peak == pytest.approx(run["peak"], rel=tolerance)
    assert r.energy.dissipated == pytest.approx(run["dissipated"], rel=tolerance)
    assert counts(r) == (run["breakaways"], run["arrests"], run["reversals"])


COLUMNS = ("nodes", "displacements", "velocities")
NODES = list(zip(*(rows("sliders", "coulomb")[0][column] for column in COLUMNS)))


@pytest.mark.parametrize("node, displacement, velocity", NODES)
def test_record_a_passes_through_its_nodes(node, displacement, velocity, record_a):
    r = ss.integrate(ss.Coulomb(slip_level=1.0), ss.GroundMotion(record_a, dt=0.1))
    assert r.time[node] == pytest.approx(node / 10, rel=1e-15)
    assert r.displacement[node] == pytest.approx(displacement, rel=0, abs=1e-13 * r.peak)
    assert r.velocity[node] == pytest.approx(velocity, rel=0, abs=1e-13)


# ---- edges


def test_friction_holds_at_its_own_level():
    # values.json edge.tangent_n_equals_a, edge.constant_n_equals_a_at_rest
    for samples in ([0, 1, 0], [1, 1, 1]):
        r = ss.integrate(ss.Coulomb(slip_level=1.0), ss.GroundMotion(samples, dt=1))
        assert r.peak == 0
        assert counts(r) == (0, 0, 0)


def test_a_block_that_slides_at_its_level_keeps_its_speed():
    # values.json edge.constant_n_equals_minus_a_moving
    r = ss.integrate(ss.Coulomb(slip_level=1.0), ss.GroundMotion([-1, -1, -1], dt=1), velocity=1.0)
    assert (r.residual, r.velocity[-1]) == (2.0, 1.0)


def test_a_velocity_that_only_touches_zero_goes_on():
    # values.json edge.graze_continue: v = (1 - t)^2. A double root moves by the root of a rounding,
    # and x with its cube.
    r = ss.integrate(ss.Coulomb(slip_level=1.0), line(1, -3, 2), velocity=1.0)
    assert r.residual == pytest.approx(2 / 3, rel=1e-14)
    assert r.velocity[-1] == pytest.approx(1.0, rel=1e-14)
    assert "reversal" not in r.events["kind"]


def test_a_velocity_that_touches_zero_where_friction_holds_stops():
    # values.json edge.graze_then_stick
    r = ss.integrate(ss.Coulomb(slip_level=1.0), ss.GroundMotion([1, -1, -1], dt=1), velocity=1.0)
    assert r.residual == pytest.approx(1 / 3, rel=1e-14)
    assert r.at_rest


def test_a_block_may_stop_exactly_at_a_sample():
    # values.json edge.stop_exactly_at_node: v = 1, 2, 1, 0
    r = ss.integrate(ss.Coulomb(slip_level=1.0), steps(-2, -2, 0, 0))
    assert np.array_equal(r.velocity, [0, 1, 2, 1, 0])
    assert r.residual == 4.0


def test_a_block_reverses_twice_within_one_line():
    # values.json edge.two_reversals_one_segment
    r = ss.integrate(ss.Coulomb(slip_level=1.0), line(4, -6, 1), velocity=1 / 50)
    assert r.residual == pytest.approx(0.01542150464203804175432394, rel=1e-13)
    assert r.velocity[-1] == pytest.approx(1.203935482821959107268082, rel=1e-13)
    assert counts(r) == (1, 0, 2)


def test_a_spring_rings_down_and_sticks_out_of_its_middle():
    # values.json edge.spring_ringdown: 3.5 -> -1.5 -> -0.5, held there by friction
    slider = ss.Slider(ss.Coulomb(slip_level=1.0), natural_frequency=1.0)
    r = ss.integrate(slider, line(0, 0, 4 * math.pi), displacement=3.5)
    assert r.events["displacement"] == pytest.approx([3.5, -1.5, -0.5, -0.5], rel=0, abs=4e-15)
    assert r.events["time"][:3] == pytest.approx([0, math.pi, 2 * math.pi], rel=1e-14)
    assert r.events["kind"].tolist() == ["breakaway", "reversal", "arrest", "end"]
    assert r.energy.elastic == pytest.approx(0.125, rel=1e-14)


def test_a_spring_that_pulls_as_hard_as_friction_holds():
    # values.json edge.spring_ringdown_tie: 3 -> -1, a tie
    slider = ss.Slider(ss.Coulomb(slip_level=1.0), natural_frequency=1.0)
    r = ss.integrate(slider, line(0, 0, 4 * math.pi), displacement=3.0)
    assert r.residual == pytest.approx(-1.0, rel=4e-15)


def test_the_two_levels_of_a_block_act_each_in_its_direction():
    # values.json edge.asym_const
    law = ss.Coulomb(slip_level=1.0, backward=1.6)
    r = ss.integrate(law, steps(2, -2, 2, -2))
    assert r.residual == pytest.approx(0.619350031329912445596030415418, rel=1e-13)
    assert r.velocity[-1] == pytest.approx(0.921810699588477366255144032922, rel=1e-13)
    assert counts(r) == (1, 0, 3)


NEXT_TO_NOTHING = {
    "pendulum": ss.FrictionPendulum(radius=2, mu=1e-300),
    "surfaces": ss.TriplePendulum([0.3, 1.8, 2.6], [1e-300] * 3, [0.09, 0.22, 0.31]),
    "caster": ss.Slider(ss.Caster(mu=1e-300, reach=1), natural_frequency=2),
    "slope": ss.Slider(ss.Coulomb(mu=1e-300), natural_frequency=2, slope_degrees=5),
    "stops": ss.Slider(ss.Coulomb(mu=1e-300), stops=ss.Stops(gap=0.1, restitution=1)),
    "plane": ss.PlanarSlider(ss.Coulomb(mu=1e-300), 2),
    "plane, slope": ss.PlanarSlider(ss.Slider(ss.Coulomb(mu=1e-300), 2, slope_degrees=5)),
}


@pytest.mark.parametrize("name", NEXT_TO_NOTHING)
def test_what_friction_cannot_stop_is_found_by_its_energy(name):
    """Not by the limit of events, a million of them later."""
    t = np.arange(0, 2, 0.02)
    pair = ss.GroundMotion(2 * np.sin(6 * t), dt=0.02, transverse=np.cos(3 * t))
    with pytest.raises(ss.ConvergenceError, match="does not come to rest") as refusal:
        ss.integrate(NEXT_TO_NOTHING[name], pair, settle=True)
    assert "events" not in str(refusal.value)


@pytest.mark.parametrize("degrees", [0.0, 5.0])
def test_little_friction_stops_a_slider_after_all_its_cycles(degrees):
    """Each half cycle takes 2 a / wn^2 of the amplitude: some 25,000 of them, over 40,000 s."""
    slider = ss.Slider(ss.Coulomb(slip_level=1e-5), natural_frequency=2, slope_degrees=degrees)
    center = ss.STANDARD_GRAVITY * math.sin(math.radians(degrees)) / 4
    motion = ss.GroundMotion([0, 0], dt=1)
    r = ss.integrate(slider, motion, displacement=center + 0.125, settle=True)
    level = 1e-5 * math.cos(math.radians(degrees))
    assert len(r.events) == pytest.approx(0.125 * 4 / (2 * level), abs=4)
    assert abs(r.residual - center) <= level / 4 * (1 + 1e-6)


@pytest.mark.parametrize("start, escape, stop", tuples("casters", "escapes"))
def test_a_caster_stops_below_its_escape_velocity_and_never_above(start, escape, stop):
    law, still = ss.Caster(slip_level=1.0, reach=0.5), line(0, 0, 1)
    r = ss.integrate(law, still, displacement=start, velocity=0.9 * escape, settle=True)
    assert r.at_rest
    assert r.residual == pytest.approx(stop, rel=1e-11)
    with pytest.raises(ss.ConvergenceError, match=r"does not come to rest: at x = .* settle"):
        ss.integrate(law, still, displacement=start, velocity=1.1 * escape, settle=True)
    away = ss.integrate(law, still, displacement=start, velocity=1.1 * escape)
    assert not away.at_rest


@pytest.mark.parametrize(
    "dt",
    [
        0.1,
        400.0,
    ],
)
def test_a_caster_that_has_escaped_goes_on_for_ever(dt):
    # From the middle, v^2 / 2 falls by a reach pi / 2, and stays; 400 s at 2.7 m/s, 4000 reaches.
    law, still = ss.Caster(slip_level=2.0, reach=0.25), np.zeros(round(400 / dt) + 1)
    r = ss.integrate(law, ss.GroundMotion(still, dt=dt), velocity=3.0)
    assert r.velocity[-1] == pytest.approx(math.sqrt(9 - 2.0 * 0.25 * math.pi), rel=1e-11)


def test_a_caster_that_comes_back_from_afar_arrives():
    # 760 reaches away the level is nothing, 740 reaches away it is above underflow: ten seconds at
    # 2 m/s are 20 m. In a process of its own, for a flow that did not end could not be interrupted.
    script = """
import stickslip as ss
law, still = ss.Caster(slip_level=1.0, reach=1.0), ss.GroundMotion([0, 0], dt=10)
print(ss.integrate(law, still, displacement=760.0, velocity=-2.0).residual)"""
    command = [sys.executable, "-c", script]
    output = subprocess.run(command, check=True, capture_output=True, text=True, timeout=60).stdout
    assert float(output) == pytest.approx(740.0, rel=1e-11)


def test_one_pulse_moves_a_block_back_and_half_of_it_forth():
    # values.json pulse.coulomb.b10 (thesis 5.7, 5.8): n = b for one second, -b for one more; a = 1
    r = ss.integrate(ss.Coulomb(slip_level=1.0), steps(10, -10), settle=True)
    assert np.allclose(r.velocity[:3], [0, -9, 1.636363636363636363636364], rtol=1e-13, atol=0)
    assert r.residual == pytest.approx(-6.694214876033057851239669, rel=1e-13)
    assert r.peak == pytest.approx(8.181818181818181818181818, rel=1e-13)
    assert r.events["kind"].tolist() == ["breakaway", "reversal", "arrest", "end"]
    assert r.events["time"][1:3] == pytest.approx(
        [1.818181818181818181818182, 3.636363636363636363636364], rel=1e-13
    )


# ---- signs, symmetry, time


def test_a_block_slides_backward_when_the_ground_accelerates_forward():
    # Half a second at 3 m/s^2 against a slip level of 1 m/s^2: v = -1 m/s, x = -1/4 m.
    r = ss.integrate(ss.Coulomb(slip_level=1.0), steps(3.0, duration=0.5))
    assert (r.residual, r.velocity[-1]) == (-0.25, -1.0)
    assert r.energy.input == pytest.approx(0.75, rel=1e-15)  # the ground drives it


def test_a_one_way_block_slides_forward_only(record_a):
    r = ss.integrate(ss.Coulomb(slip_level=1.0, backward=INF), ss.GroundMotion(record_a, dt=0.1))
    assert np.all(np.diff(r.displacement) >= 0)
    assert r.residual == r.peak > 0
    # a sum of about 50 slips, each rounded to half a unit of the total
    assert r.sliding_distance == pytest.approx(r.peak, rel=50 * 1.2e-16)


@pytest.mark.parametrize("law", [ss.Coulomb(slip_level=1.0), ss.Caster(slip_level=1.0, reach=0.5)])
def test_a_mirrored_ground_mirrors_the_motion(law, record_a):
    quake = ss.GroundMotion(record_a, dt=0.1)
    r = ss.integrate(law, quake, displacement=0.1, velocity=-0.2)
    mirror = ss.integrate(law, quake.scaled(-1), displacement=-0.1, velocity=0.2)
    assert np.array_equal(mirror.displacement, -r.displacement)
    assert np.array_equal(mirror.events["time"], r.events["time"])


def test_a_caster_of_infinite_reach_is_a_block(record_a):
    quake = ss.GroundMotion(record_a, dt=0.1)
    block = ss.integrate(ss.Coulomb(slip_level=1.0), quake)
    caster = ss.integrate(ss.Caster(slip_level=1.0, reach=INF), quake)
    assert caster.displacement == pytest.approx(block.displacement, rel=0, abs=1e-13 * block.peak)


def test_more_samples_on_the_same_lines_change_nothing(record_a):
    # Halves of a line round once: 1e-16 of its value, and so does the velocity at each of 800 nodes
    finer = np.interp(np.arange(801) / 2, np.arange(401), record_a)
    slider = ss.Slider(ss.Coulomb(slip_level=1.0), 1.3)
    coarse = ss.integrate(slider, ss.GroundMotion(record_a, dt=0.1))
    fine = ss.integrate(slider, ss.GroundMotion(finer, dt=0.05))
    assert fine.displacement[::2] == pytest.approx(
        coarse.displacement, rel=0, abs=1e-13 * coarse.peak
    )


def test_the_clock_of_the_motion_is_kept(record_a):
    quake = ss.GroundMotion(record_a, times=np.arange(401) / 10 + 100)
    r = ss.integrate(ss.Coulomb(slip_level=1.0), quake)
    assert (r.time[0], r.time[-1]) == (100, 140)
    assert (r.events["time"][0], r.events["time"][-1]) == (100, 140)  # n(0) is over the level


# ---- settling


def test_settling_waits_for_the_final_rest():
    # Breakaway at t = 1/3; v = 2/3 at t = 1 and 7/6 at t = 2, where the ground stops: 7/6 s more
    quake = ss.GroundMotion([0, -3, 0], dt=1)
    law = ss.Coulomb(slip_level=1.0)
    short, long = ss.integrate(law, quake), ss.integrate(law, quake, settle=True)
    assert np.array_equal(short.displacement, long.displacement[:3])
    assert long.time.tolist() == [0, 1, 2, 3, 4]  # the first sample at or after rest
    assert long.displacement[-1] == long.residual
    assert long.velocity[-1] == 0
    assert not long.truncated
    assert not short.at_rest
    assert long.at_rest
    assert short.residual == short.displacement[-1]
    assert short.velocity[-1] == pytest.approx(7 / 6, rel=1e-14)
    assert long.residual == pytest.approx(short.residual + (7 / 6) ** 2 / 2, rel=1e-14)
    assert long.events["kind"][-2:].tolist() == ["arrest", "end"]
    assert long.events["time"][-2:] == pytest.approx([2 + 7 / 6] * 2, rel=1e-14)
    assert long.peak == long.residual


@pytest.mark.parametrize("even", [True, False])
def test_the_last_sample_of_a_settled_slider_is_its_residual(even):
    step = dict(dt=0.1) if even else dict(times=[0, 0.1, 0.2, 0.3])
    quake = ss.GroundMotion([0, 6, 6, 6], **step)
    r = ss.integrate(ss.Coulomb(mu=0.05), quake, settle=True)
    assert r.displacement[-1] == r.residual == pytest.approx(-2.040, abs=5e-4)
    assert len(r.time) == len(r.displacement) == len(r.velocity)
    assert np.diff(r.time) == pytest.approx(0.1, rel=1e-12)
    assert r.time[-2] < r.events["time"][-1] <= r.time[-1]


def test_samples_end_at_ten_times_the_length_of_the_motion():
    r = ss.integrate(ss.Coulomb(slip_level=0.01), line(0, 0, 1), velocity=3.0, settle=True)
    assert r.truncated
    assert len(r.time) == len(r.displacement) == 20
    assert r.residual == pytest.approx(450)  # v^2 / (2 a)
    assert r.events["time"][-1] == pytest.approx(300)
    assert "samples end before rest" in repr(r)


def test_a_slider_at_rest_has_settled(record_a):
    samples = np.append(record_a, np.zeros(50))
    quake = ss.GroundMotion(samples, dt=0.1)
    law = ss.Coulomb(slip_level=1.0)
    plain, settled = ss.integrate(law, quake), ss.integrate(law, quake, settle=True)
    assert plain.at_rest
    assert settled.residual == plain.residual
    assert np.array_equal(settled.events, plain.events)


def test_without_friction_nothing_settles():
    with pytest.raises(ss.ConvergenceError, match=r"still moves at 2\.5 m/s.* slip level of 0 m/s"):
        ss.integrate(ss.Coulomb(mu=0.0), line(0, 0, 1), velocity=2.5, settle=True)
    with pytest.raises(RuntimeError):
        ss.integrate(ss.Slider(ss.Coulomb(mu=0.0), 9.0), line(0, 0, 1), velocity=2.5, settle=True)


# ---- rejected arguments


@pytest.mark.parametrize(
    "arguments, message",
    [
        (dict(displacement=NAN), "displacement must be finite, got nan m"),
        (dict(displacement=INF), "displacement must be finite, got inf m"),
        (dict(velocity=-INF), "velocity must be finite, got -inf m/s"),
        (dict(velocity=NAN), "velocity must be finite, got nan m/s"),
        (dict(velocity=-1.5), r"infinite, got -1\.5 m/s"),
    ],
)
def test_a_start_out_of_range_is_named(arguments, message):
    law = ss.Coulomb(slip_level=1.0, backward=INF)
    with pytest.raises(ValueError, match="integrate: .*" + message):
        ss.integrate(law, line(0, 1, 1), **arguments)


@pytest.mark.parametrize(
    "slider, motion",
    [
        (ss.Coulomb(mu=0.2), [1.0, 2.0]),
        (ss.Coulomb(mu=0.2), np.ones(3)),
        (ss.Coulomb(mu=0.2), None),
        (ss.Coulomb(mu=0.2), ss.GroundMotion),
        (0.2, ss.GroundMotion([0, 1], dt=1)),
        (None, ss.GroundMotion([0, 1], dt=1)),
    ],
)
def test_what_is_no_slider_or_no_motion_is_a_type_error(slider, motion):
    with pytest.raises(TypeError):
        ss.integrate(slider, motion)


def test_the_start_is_given_by_name():
    with pytest.raises(TypeError):
        ss.integrate(ss.Coulomb(mu=0.2), ss.GroundMotion([0, 1], dt=1), 0.0)


# ---- against another integrator

CROSSED = [
    ss.Slider(ss.Coulomb(slip_level=1.0), 1.3),
    ss.Slider(ss.Coulomb(slip_level=1.0, backward=1.6), 1.3),
    ss.Slider(ss.Caster(slip_level=1.0, reach=0.05), 1.3),
    ss.Slider(ss.Caster(slip_level=1.0, reach=0.5)),
]


@pytest.mark.parametrize("slider", CROSSED, ids=repr)
def test_scipy_comes_to_the_same_with_friction_made_smooth(slider, record_a):
    # f = level tanh(v / e) instead of level sgn(v). While stuck the smooth slider creeps at
    # e atanh(load / level), less than 10 e until the load is within 4e-9 of the level: over the
    # time T, 10 e T at most; friction forgets what went before a stop. With e = 1e-6 m/s, T = 8 s
    # that is 8e-5 m.
    scipy_integrate = pytest.importorskip("scipy.integrate", reason="needs SciPy")
    e, dt, samples = 1e-6, 0.1, 81
    wn2 = slider.natural_frequency**2
    n = record_a[:samples]
    state, path = [0.0, 0.0], [0.0]
    for i in range(samples - 1):

        def motion(t, y, first=n[i], last=n[i + 1]):
            level = slider.resist(y[0], backward=y[1] < 0)
            ground = first + (last - first) * t / dt
            return [y[1], -ground - wn2 * y[0] - level * math.tanh(y[1] / e)]

        solution = scipy_integrate.solve_ivp(
            motion, (0, dt), state, method="LSODA", rtol=1e-8, atol=1e-11
        )
        assert solution.success
        state = solution.y[:, -1]
        path.append(state[0])
    tolerance = 10 * e * dt * (samples - 1)
    r = ss.integrate(slider, ss.GroundMotion(n, dt=dt))
    assert r.displacement == pytest.approx(path, rel=0, abs=tolerance)
    assert r.peak > 300 * tolerance  # or the test could not tell
