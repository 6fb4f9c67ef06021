"""Laws from functions, and friction that depends on pressure and temperature."""

import math
import pickle
import threading

import numpy as np
import pytest
import stickslip as ss

KOBE = ss.sample_record("Kobe")
LINER = ss.VelocityDependent(slow=0.3, fast=0.6, rate=50)
ISOLATOR = {
    "mu_ref": 0.06,
    "static_pressure": 50e6,
    "reference_pressure": 50e6,
    "contact_radius": 0.2,
}


def liner(x, speed, direction):
    return 0.6 - 0.3 * math.exp(-50 * speed)


def sticky(x, direction):
    return 0.9


def rising(x, speed, direction):
    return 1 + 0.1 * x * direction + 0.2 * speed


def same_motion(one, other, tolerance=1e-10):
    """To the accuracy of laws from functions."""
    assert len(one.events) == len(other.events)
    scale = np.abs(one.displacement).max()
    assert np.abs(one.displacement - other.displacement).max() <= tolerance * scale
    assert other.peak == pytest.approx(one.peak, rel=tolerance)


@pytest.mark.parametrize(
    "mounting",
    [
        {},
        {"natural_frequency": 2.5, "damping_ratio": 0.05},
        {"slope_degrees": 1, "one_way": True},
        {"natural_frequency": 2.5, "stops": ss.Stops(gap=0.05, restitution=0.5)},
    ],
)
def test_a_law_from_functions_moves_as_the_law_it_repeats(mounting):
    vertical = ss.GroundMotion(
        KOBE.acceleration, KOBE.dt, vertical=0.7 * KOBE.acceleration[::-1]
    ).cut(0, 15)
    for motion in (KOBE.cut(0, 15), vertical):
        one = ss.integrate(ss.Slider(LINER, **mounting), motion)
        same_motion(one, ss.integrate(ss.Slider(ss.Law(resist=liner), **mounting), motion))
        static = ss.Slider(ss.StaticKinetic(LINER, static=0.9), **mounting)
        law = ss.Law(hold=sticky, resist=liner)
        same_motion(ss.integrate(static, motion), ss.integrate(ss.Slider(law, **mounting), motion))


def test_a_law_from_functions_is_asked_what_it_says():
    slider = ss.Slider(ss.Law(hold=lambda x, d: 2 + d, resist=lambda x, v, d: 0.5 + x + v + d / 4))
    assert slider.hold() == 3
    assert slider.hold(backward=True) == 1
    assert slider.resist(0.25, speed=2) == 0.5 + 0.25 + 2 + 0.25
    assert slider.resist(0.25, speed=2, backward=True) == 0.5 + 0.25 + 2 - 0.25
    assert ss.Slider(ss.Law(resist=lambda x, v, d: 1 + v)).hold() == 1


@pytest.mark.slow
def test_compiled_functions_are_called_without_the_interpreter():
    numba = pytest.importorskip("numba")
    compiled = numba.cfunc("float64(float64, float64, float64)")(liner)
    hold = numba.cfunc("float64(float64, float64)")(sticky)
    law = ss.Law(hold=hold, resist=compiled)
    same_motion(ss.integrate(ss.StaticKinetic(LINER, static=0.9), KOBE), ss.integrate(law, KOBE))
    with pytest.raises(TypeError, match="resist must take 3 numbers"):
        ss.Law(resist=hold)
    with pytest.raises(TypeError, match="hold must take 2 numbers and return one, all float64"):
        ss.Law(hold=numba.cfunc("float32(float32, float32)")(sticky), resist=compiled)


@pytest.mark.parametrize(
    "make, error, message",
    [
        (lambda: ss.Law(resist=3), TypeError, "resist must be a function, got int"),
        (lambda: ss.Law(hold="x", resist=liner), TypeError, "hold must be a function, got str"),
        (lambda: ss.Law(), TypeError, "resist"),
        (lambda: ss.Law(liner), TypeError, "Law"),
    ],
)
def test_what_is_no_function_is_refused(make, error, message):
    with pytest.raises(error, match=message):
        make()


@pytest.mark.parametrize(
    "resist, error, message",
    [
        (lambda x, v, d: -1.0, ValueError, r"resist must be finite and at least 0, got -1 m/s\^2"),
        (lambda x, v, d: math.nan, ValueError, "resist must be finite .* got nan"),
        (lambda x, v, d: "much", TypeError, "resist must return a number, got str"),
        (lambda x, v, d: 1 / (v - v), ZeroDivisionError, "division by zero"),
        (lambda x, v: 1.0, TypeError, "positional argument"),
    ],
)
def test_what_a_function_does_wrong_is_said(resist, error, message):
    with pytest.raises(error, match=message):
        ss.integrate(ss.Law(resist=resist), KOBE)
    with pytest.raises((error, ss.ConvergenceError)):  # from a thread, without the interpreter
        ss.run_ensemble(ss.Law(resist=resist), KOBE, members=4, seed=1)


def test_a_level_that_is_not_a_number_later_on_is_refused():
    law = ss.Law(resist=lambda x, v, d: 0.5 if v < 0.05 else math.nan)
    with pytest.raises(ValueError, match=r"resist must be finite .* a speed of 0"):
        ss.integrate(law, KOBE)


@pytest.mark.parametrize(
    "resist",
    [
        lambda x, u, s: 1 + 0.5 * u**2,
        lambda x, u, s: 1 + x * x,
        lambda x, u, s: 1 + math.exp(x),
        lambda x, u, s: math.cosh(u),
    ],
)
def test_a_law_that_grows_settles_on_a_spring(resist):
    samples = [1.26, 2.68, 1.7, -0.85, -2.9, -1.5, 0.8, 2.2, 2.4, -2.3]
    motion = ss.GroundMotion(samples, dt=0.05)
    for frequency in (3.0, 15.0, 60.0):
        slider = ss.Slider(ss.Law(resist=resist), natural_frequency=frequency)
        r = ss.integrate(slider, motion, settle=True)
        assert r.state.stuck
        assert abs(r.energy.imbalance) <= 1e-9 * r.energy.input
        one = ss.advance(slider, ss.State(0.01, 0.3), 0.2, 0.0)
        parts = ss.State(0.01, 0.3)
        for _ in range(20):
            parts = ss.advance(slider, parts, 0.01, 0.0)
        assert one.displacement == pytest.approx(parts.displacement, rel=1e-7, abs=1e-12)


def test_an_exception_of_a_function_outside_the_motion_is_none():
    def within(x, u, s):
        if u > 0.35 or abs(x) > 0.1:
            raise RuntimeError("outside")
        return 1.0

    law = ss.Law(resist=within)
    slid = ss.advance(law, ss.State(0.0, 0.3), 1000.0, 0.0)
    assert slid.displacement == pytest.approx(0.045, rel=1e-9)  # v^2 / (2 a)
    with pytest.raises(RuntimeError, match="outside"):
        ss.advance(law, ss.State(0.0, 0.3), 1.0, -3.0)  # which accelerates it


def test_an_interrupt_within_a_function_is_passed_on():
    def interrupted(x, u, s):
        if u < 0.2:
            raise KeyboardInterrupt
        return 1.0

    with pytest.raises(KeyboardInterrupt):
        ss.advance(ss.Law(resist=interrupted), ss.State(0.0, 0.3), 1.0, 0.0)


def test_laws_from_functions_in_ensembles_sweeps_and_threads():
    law = ss.Law(resist=liner)
    motions = ss.GaussianExcitation(ss.Spectrum.white(s0=0.05), dt=0.02, samples=256)
    one = ss.run_ensemble(LINER, motions, members=6, seed=3)
    other = ss.run_ensemble(law, motions, members=6, seed=3)
    assert other.peak == pytest.approx(one.peak, rel=1e-10)
    table = ss.sweep([LINER, law], [KOBE.cut(0, 6), KOBE.cut(2, 8)])
    by_law = np.asarray(table.peak).reshape(2, -1)  # the sliders come first
    assert by_law[1] == pytest.approx(by_law[0], rel=1e-10)

    peaks = []
    work = [
        threading.Thread(target=lambda: peaks.append(ss.integrate(law, KOBE).peak))
        for _ in range(4)
    ]
    for thread in work:
        thread.start()
    for thread in work:
        thread.join()
    assert len(set(peaks)) == 1


def test_laws_from_functions_pickle_by_name():
    law = ss.Law(hold=sticky, resist=rising)
    again = pickle.loads(pickle.dumps(law))
    assert again == law
    assert hash(again) == hash(law)
    assert ss.integrate(again, KOBE).peak == ss.integrate(law, KOBE).peak
    assert ss.Law(resist=rising) != law
    assert "rising" in repr(law)


def test_theories_and_sensitivities_refuse_own_laws():
    for law in (ss.Law(resist=rising), ss.KumarFriction(**ISOLATOR)):
        with pytest.raises((ValueError, TypeError), match="not cover"):
            ss.theory.EquivalentLinearization().stationary(ss.Slider(law, 2.0), 0.01)
        with pytest.raises((ValueError, TypeError), match="cover"):
            ss.integrate(law, KOBE).sensitivity("mu")


def test_a_heated_isolator():
    law = ss.KumarFriction(**ISOLATOR)
    slider = ss.Slider(law, natural_frequency=2.1, pendulum=True)
    r = ss.integrate(slider, KOBE)
    assert r.temperature.shape == r.displacement.shape
    assert r.temperature[0] == 20
    assert 40 < r.temperature.max() < 400
    cold = ss.integrate(
        ss.Slider(
            ss.KumarFriction(**ISOLATOR, conductivity=math.inf),
            natural_frequency=2.1,
            pendulum=True,
        ),
        KOBE,
    )
    assert np.all(cold.temperature == 20)
    assert r.peak > cold.peak  # hot friction is lower
    assert abs(r.energy.imbalance) <= 1e-12 * r.energy.input
    assert ss.integrate(ss.Coulomb(mu=0.1), KOBE).temperature is None
    # The equation of motion at the samples, x'' by central differences.
    sliding = ~r.stuck & (np.abs(r.velocity) > 0.02)
    sliding[1:-1] &= sliding[:-2] & sliding[2:]
    sliding[[0, -1]] = False
    steps = np.gradient(r.velocity, r.time)[sliding]
    expected = (-np.interp(r.time, KOBE.time, KOBE.acceleration) - r.force)[sliding]
    assert np.median(np.abs(steps - expected)) <= 0.02 * np.abs(expected).max()


def test_heat_continues_from_a_state():
    law = ss.KumarFriction(**ISOLATOR)
    first, second = KOBE.cut(0, 10), KOBE.cut(10, KOBE.duration)
    whole, one = ss.integrate(law, KOBE), ss.integrate(law, first)
    two = ss.integrate(
        law,
        second,
        displacement=one.displacement[-1],
        velocity=one.velocity[-1],
        heat=one.state.heat,
    )
    assert two.residual == pytest.approx(whole.residual, abs=1e-7 * whole.peak)
    assert two.temperature[-1] == pytest.approx(whole.temperature[-1], abs=1e-4)
    state = ss.State()
    for start, end in zip(KOBE.acceleration[:-1], KOBE.acceleration[1:]):
        state = ss.advance(law, state, KOBE.dt, start, end)
    assert state.displacement == pytest.approx(whole.residual, abs=1e-7 * whole.peak)
    assert pickle.loads(pickle.dumps(state)) == state
    assert state.heat.modes.shape == (42,)
    assert ss.SurfaceHeat(state.heat.modes) == state.heat
    assert ss.SurfaceHeat().half_integral == 0
    with pytest.raises(ValueError, match="modes must be 42, got 3"):
        ss.SurfaceHeat([1, 2, 3])


def test_heated_friction_in_ensembles_and_sweeps():
    law = ss.KumarFriction(**ISOLATOR)
    part = KOBE.cut(0, 10)
    ensemble = ss.run_ensemble(law, part, members=2, seed=1)
    peak = ss.integrate(law, part).peak
    assert list(ensemble.peak) == [peak, peak]
    table = ss.sweep(law, [part], polarity="recorded")
    assert list(table.peak) == [peak]


@pytest.mark.parametrize(
    "change, message",
    [
        ({"mu_ref": -1}, r"mu_ref must be from 0 to 1e\+300, got -1"),
        ({"static_pressure": 50e9}, "pressures are in Pa and must be below 1e9 Pa"),
        ({"contact_radius": 0}, "contact_radius must be positive"),
        ({"temperature": 1000}, "temperature must be from -100 to 400"),
        ({"conductivity": math.nan}, "conductivity must be positive"),
    ],
)
def test_bad_parameters_are_named(change, message):
    with pytest.raises(ValueError, match=message):
        ss.KumarFriction(**{**ISOLATOR, **change})


def test_missing_parameters_are_explained():
    with pytest.raises(TypeError, match="KumarFriction: give mu_ref="):
        ss.KumarFriction(0.06)
