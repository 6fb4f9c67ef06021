"""The motion between samples."""

import numpy as np
import pytest
import stickslip as ss

QUAKE = ss.GroundMotion(2 * np.sin(np.arange(60) ** 1.3), dt=0.1)
SLIDERS = [
    ss.Coulomb(slip_level=1),
    ss.Slider(ss.Caster(slip_level=1, reach=0.2), period=1.5),
    ss.Slider(ss.Degrading(distance=[0, 0.1], slip_level=[1.2, 0.6]), slope_degrees=1),
    ss.Slider(
        ss.Stribeck(static=1.2, kinetic=0.8, velocity=0.1, exponent=2),
        stops=ss.Stops(gap=0.05, restitution=0.4),
    ),
    ss.FrictionPendulum(radius=2, mu=0.05),
    ss.Law(resist=lambda x, speed, direction: 1 + 0.2 * speed),
]


@pytest.mark.parametrize("slider", SLIDERS, ids=lambda s: type(s).__name__)
def test_the_motion_passes_through_samples_and_events(slider):
    r = ss.integrate(slider, QUAKE, settle=True)
    at = r.at(r.time[r.time <= r.events["time"][-1]])
    scale = max(r.peak, 1e-3)
    assert at.dtype.names == ("time", "displacement", "velocity", "gap", "stuck")
    assert np.abs(at["displacement"] - r.displacement[: len(at)]).max() <= 1e-8 * scale
    assert (
        np.abs(r.at(r.events["time"])["displacement"] - r.events["displacement"]).max()
        <= 1e-8 * scale
    )


def test_one_time_gives_a_state():
    r = ss.integrate(ss.Coulomb(slip_level=1), ss.GroundMotion([0.0, -2.0, 0.0], dt=1.0))
    state = r.at(0.75)
    assert isinstance(state, ss.State)
    assert not state.stuck
    # From t = 0.5 on x'' = 2 t - 1.
    assert state.velocity == pytest.approx(0.25**2, abs=1e-15)
    assert state.displacement == pytest.approx(0.25**3 / 3, abs=1e-15)
    assert r.at(np.float64(0.75)) == state
    assert r.at([0.75])["velocity"][0] == state.velocity
    assert len(r.at([])) == 0


def test_the_order_of_times_does_not_matter():
    r = ss.integrate(SLIDERS[1], QUAKE)
    times = np.random.default_rng(1).uniform(0, r.time[-1], 200)
    shuffled, in_order = r.at(times), r.at(np.sort(times))
    assert np.abs(shuffled[np.argsort(times)]["displacement"] - in_order["displacement"]).max() == 0


@pytest.mark.parametrize("time", [-0.1, 6.0, np.nan, np.inf])
def test_a_time_outside_is_refused_with_the_range(time):
    r = ss.integrate(ss.Coulomb(slip_level=1), QUAKE)
    with pytest.raises(ValueError, match=r"from 0 to 5\.9 s"):
        r.at(time)
    with pytest.raises(ValueError, match=r"from 0 to 5\.9 s"):
        r.at([1, time])


def test_something_else_than_times_is_refused():
    r = ss.integrate(ss.Coulomb(slip_level=1), QUAKE)
    with pytest.raises(ValueError, match="times must hold real numbers"):
        r.at("early")


def test_flight_has_a_gap():
    ground = ss.GroundMotion([1.0] * 5, dt=0.2, vertical=[0.0, -12.0, -12.0, 10.0, 0.0])
    r = ss.integrate(ss.Coulomb(slip_level=2), ground, settle=True)
    lift = r.events[r.events["kind"] == "liftoff"]["time"][0]
    down = r.events[r.events["kind"] == "landing"]["time"][0]
    assert (r.at(np.linspace(lift, down, 12)[1:-1])["gap"] > 0).all()
    assert r.at(down).gap == 0
