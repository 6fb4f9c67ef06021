"""Sliders under ground motions, against numbers computed apart from this library."""

import math

import numpy as np
import pytest
import stickslip as ss
from reference import rows

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


# ---- edges


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


# ---- signs, symmetry, time


def test_the_clock_of_the_motion_is_kept(record_a):
    quake = ss.GroundMotion(record_a, times=np.arange(401) / 10 + 100)
    r = ss.integrate(ss.Coulomb(slip_level=1.0), quake)
    assert (r.time[0], r.time[-1]) == (100, 140)
    assert (r.events["time"][0], r.events["time"][-1]) == (100, 140)  # n(0) is over the level


# ---- settling


def test_samples_end_at_ten_times_the_length_of_the_motion():
    r = ss.integrate(ss.Coulomb(slip_level=0.01), line(0, 0, 1), velocity=3.0, settle=True)
    assert r.truncated
    assert len(r.time) == len(r.displacement) == 20
    assert r.residual == pytest.approx(450)  # v^2 / (2 a)
    assert r.events["time"][-1] == pytest.approx(300)
    assert "samples end before rest" in repr(r)


def test_without_friction_nothing_settles():
    with pytest.raises(ss.ConvergenceError, match=r"still moves at 2\.5 m/s.* slip level of 0 m/s"):
        ss.integrate(ss.Coulomb(mu=0.0), line(0, 0, 1), velocity=2.5, settle=True)
    with pytest.raises(RuntimeError):
        ss.integrate(ss.Slider(ss.Coulomb(mu=0.0), 9.0), line(0, 0, 1), velocity=2.5, settle=True)


# ---- rejected arguments


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
