"""Slowly varying parameters in Python: results, and arrays in the requested shapes."""

import math

import numpy as np
import pytest
import stickslip as ss
from scipy.integrate import solve_ivp

INF, NAN = math.inf, math.nan
SVP = ss.theory.SlowlyVaryingParameters
FOUR_OVER_PI = 4 / math.pi

BLOCK = ss.Coulomb(slip_level=1.0)
WHEEL = ss.Caster(slip_level=1.0, reach=0.5)
SPRING = math.sqrt(0.5)
SLIDERS = {
    "Coulomb": ss.Slider(BLOCK),
    "Coulomb, spring": ss.Slider(BLOCK, natural_frequency=SPRING),
    "Caster": ss.Slider(WHEEL),
    "Caster, spring": ss.Slider(WHEEL, natural_frequency=SPRING),
}
each_slider = pytest.mark.parametrize("kind", SLIDERS)


def test_solutions_are_plain_objects():
    (solution,) = SVP(BLOCK).response(2.0, 2.0)
    # values.json svp.coulomb.b2.w2: closed form, 24 digits
    assert solution.amplitude == pytest.approx(0.3855889214664527009822235, rel=1e-14)
    assert solution.phase == pytest.approx(-2.451485562215253286458265, rel=1e-14)
    assert solution.stable is True
    assert isinstance(solution, ss.theory.HarmonicSolution)
    assert "stable" in repr(solution)


def test_a_caster_below_four_over_pi_has_two_solutions_up_to_its_fold():
    # values.json svp.caster.fold.b1.0: bisection, 40 digits
    svp = SVP(ss.Caster(slip_level=1.0, reach=1.0))
    fold = 0.5326142189713826773184624
    unstable, stable = svp.response(1.0, 0.999 * fold)
    assert not unstable.stable
    assert stable.stable
    assert svp.response(1.0, 1.001 * fold) == []
    assert svp.min_amplitude(1.0) == pytest.approx(1.360590103585858371543901, rel=1e-14)
    assert svp.min_amplitude(1.3) == 0
    assert svp.rests(1.0)
    assert not svp.rests(1.3)
    assert SVP(BLOCK).min_amplitude(1.0) == INF


def test_frequencies_come_in_the_shape_of_the_amplitudes():
    svp = SVP(SLIDERS["Caster, spring"])
    amplitude = np.geomspace(1e-3, 1e3, 24).reshape(4, 6)
    for f in (lambda a: svp.frequency(1.25, a), svp.stability_boundary):
        lower, upper = f(amplitude)
        assert lower.shape == upper.shape == (4, 6)
        one = f(float(amplitude[2, 3]))
        assert [type(number) for number in one] == [float, float]
        assert one == (lower[2, 3], upper[2, 3])
        assert f(np.float32(3)) == f(3) == f(3.0)
        assert f([0.5, 1])[0].shape == (2,)
        assert f([])[0].shape == (0,)
    lower, upper = svp.frequency(1.25, amplitude)
    least = svp.min_amplitude(1.25)
    assert np.array_equal(np.isnan(upper), amplitude < least)
    for f in (svp.dissipative, svp.dissipative_slope, svp.in_phase, svp.in_phase_slope):
        assert f(amplitude).shape == (4, 6)
        assert isinstance(f(1.0), float)
    assert np.isnan(SVP(WHEEL).frequency(2.0, amplitude)[0]).all()


def test_the_averaged_equations_are_solved():
    # (2.10) corrected and (2.11) as they stand, in amplitude and phase; DOP853 to 1e-11 a step
    svp, B, omega = SVP(SLIDERS["Caster, spring"]), 1.6, 1.1

    def rates(_, state):
        amplitude, phase = state
        growth = (svp.dissipative(amplitude) - B * math.sin(phase)) / (2 * omega)
        excess = svp.in_phase(amplitude) - omega**2 * amplitude
        return growth, (excess - B * math.cos(phase)) / (2 * omega * amplitude)

    times = np.linspace(0, 60, 31)
    other = solve_ivp(rates, (0, 60), (2.0, -1.0), "DOP853", times, rtol=1e-11, atol=1e-12).y
    amplitude, phase = svp.transient(B, omega, 2.0, -1.0, times)
    assert np.allclose(amplitude, other[0], rtol=1e-8, atol=0)
    assert np.allclose(np.exp(1j * phase), np.exp(1j * other[1]), rtol=0, atol=1e-8)
    (end,) = svp.response(B, omega)
    assert svp.settles_on(B, omega, 2.0, -1.0).amplitude == end.amplitude
    late = svp.transient(B, omega, 2.0, -1.0, [10_000])  # friction takes 0.4 % a second
    assert late[0][0] == pytest.approx(end.amplitude, rel=1e-7)
    assert late[1][0] == pytest.approx(end.phase, rel=1e-7)


def test_resonance_grows_linearly_and_without_bound():
    svp = SVP(ss.Slider(BLOCK, natural_frequency=1.0))
    times = np.array([1.0, 10.0, 100.0])
    amplitude, phase = svp.transient(2.0, 1.0, 0.0, 0.0, times)
    assert np.allclose(amplitude, (2 - FOUR_OVER_PI) / 2 * times, rtol=1e-8)
    assert np.allclose(phase, -math.pi / 2)
    assert svp.response(2.0, 1.0) == []
    assert svp.settles_on(2.0, 1.0, 0.0, 0.0).amplitude == INF


def test_the_start_decides_between_coexisting_solutions():
    svp = SVP(ss.Caster(slip_level=1.0, reach=1.0))
    unstable, stable = svp.response(1.0, 0.5)
    rest = svp.settles_on(1.0, 0.5, 0.9 * unstable.amplitude, unstable.phase)
    assert rest.amplitude == 0
    assert rest.stable
    assert math.isnan(rest.phase)
    found = svp.settles_on(1.0, 0.5, 1.1 * unstable.amplitude, unstable.phase)
    assert (found.amplitude, found.phase) == (stable.amplitude, stable.phase)
    amplitude, phase = svp.transient(1.0, 0.5, 0.9 * unstable.amplitude, unstable.phase, [0, 500])
    assert amplitude[1] == 0
    assert math.isnan(phase[1])


def test_what_is_out_of_range_is_named():
    with pytest.raises(ValueError, match=r"got 1 m/s\^2 forward, 1\.6 m/s\^2 backward"):
        SVP(ss.Coulomb(slip_level=1.0, backward=1.6))
    with pytest.raises(TypeError):
        SVP(1.0)
    svp = SVP(WHEEL)
    for bad in (0.0, -1.0, INF, NAN):
        with pytest.raises(ValueError, match="B must be positive and finite"):
            svp.response(bad, 1.0)
        with pytest.raises(ValueError, match="omega must be positive and finite"):
            svp.response(1.0, bad)
        with pytest.raises(ValueError, match="amplitude must be positive and finite"):
            svp.frequency(1.0, [1.0, bad])
        with pytest.raises(ValueError, match="amplitude must be positive and finite"):
            svp.stability_boundary(bad)
        with pytest.raises(ValueError, match="B must be positive and finite"):
            svp.min_amplitude(bad)
    for bad in (-1.0, INF, NAN):
        with pytest.raises(ValueError, match="amplitude must be finite and at least 0"):
            svp.transient(1.0, 1.0, bad, 0.0, [1.0])
    for times in ([-1.0], [1.0, 1.0], [NAN], [INF]):
        with pytest.raises(ValueError, match="times must be finite and increase, from 0 on"):
            svp.transient(1.0, 1.0, 1.0, 0.0, times)
    with pytest.raises(ValueError, match="times must be one-dimensional"):
        svp.transient(1.0, 1.0, 1.0, 0.0, [[1.0]])
    with pytest.raises(OverflowError):
        svp.response(1.0, 1e-170)
