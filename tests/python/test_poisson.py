"""Poisson pulses from Python: the same motions, Python's own options, and rejected arguments."""

import json
import math
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import stickslip as ss
from scipy import stats

INF, NAN = math.inf, math.nan
USUAL = {"rate": 3.0, "half_width": 1 / 6, "sigma": 2.5, "duration": 60.0}


def two_sided(u):
    """Uniform amplitudes of mean square 1; at the top of the module, so that it can be pickled."""
    return math.sqrt(3) * (2 * u - 1)


def same(a, b):
    return np.array_equal(a.time, b.time) and np.array_equal(a.acceleration, b.acceleration)


@pytest.fixture(
    params=[
        {},
        {"stationary_start": True},
        {"shape": ([0, 1, 3], [2, -1])},
        {"quantile": two_sided},
    ],
    ids=["plain", "stationary", "shape", "quantile"],
)
def excitation(request):
    return ss.PoissonPulses(**USUAL, **request.param)


def test_a_sample_is_a_motion_of_steps():
    motion = ss.PoissonPulses(**USUAL).sample(seed=1, member=7)
    assert motion.interpolation == "constant"
    assert motion.time[0] == 0
    assert motion.duration == 60.0
    assert np.all(np.diff(motion.time) > 0)
    assert motion.name == "Poisson pulses, seed 1, member 7"


def test_a_motion_is_the_sum_of_its_pulses(excitation):
    arrivals, amplitudes = excitation.pulses(seed=2, member=0)
    assert np.all(np.diff(arrivals) > 0)
    assert arrivals[-1] < 60
    assert (arrivals[0] < 0) == excitation.stationary_start
    edges, values = excitation.shape
    t = np.random.default_rng(1).uniform(0, 60, 500)
    age = (t[:, None] - arrivals) / excitation.half_width
    piece = np.searchsorted(edges, age, side="right") - 1
    w = np.where((age >= 0) & (age < edges[-1]), values[np.clip(piece, 0, len(values) - 1)], 0)
    motion = excitation.sample(seed=2, member=0)
    n = motion.acceleration[np.searchsorted(motion.time, t, side="right") - 1]
    assert np.allclose(n, w @ amplitudes, rtol=0, atol=1e-13)


def test_numbers_of_a_member_come_again_on_any_thread(excitation):
    with ThreadPoolExecutor(4) as pool:
        motions = list(pool.map(lambda m: excitation.sample(seed=3, member=m % 8), range(64)))
    for i, motion in enumerate(motions):
        assert same(motion, motions[i % 8])
    assert not same(motions[0], motions[1])


def test_members_have_64_bits():
    excitation = ss.PoissonPulses(**USUAL)
    last = 2**64 - 1
    assert not same(excitation.sample(seed=1, member=last), excitation.sample(seed=1, member=0))
    assert same(excitation.sample(seed=last, member=2), excitation.sample(seed=last, member=2))
    for bad in (-1, 2**64, 0.5, "1"):
        with pytest.raises(TypeError):
            excitation.sample(seed=1, member=bad)


def test_table_5_1():
    rows = {  # rate, half width, sigma, duration; thesis, Table 5.1
        "great very near field": (3, 1 / 6, 2.5, 60),
        "great near field": (2.5, 1 / 5, 1, 60),
        "moderate very near field": (4, 1 / 8, 2, 15),
        "moderate near field": (3, 1 / 6, 0.5, 15),
    }
    assert ss.PoissonPulses.events() == list(rows)
    for name, row in rows.items():
        event = ss.PoissonPulses.event(name)
        assert (event.rate, event.half_width, event.sigma, event.duration) == pytest.approx(row)
    assert ss.PoissonPulses.event("great near field", stationary_start=True).stationary_start
    with pytest.raises(ValueError, match=r"'great very near field', .* got 'huge'"):
        ss.PoissonPulses.event("huge")


def test_an_earthquake_is_its_rms_acceleration_and_frequency():
    e = ss.PoissonPulses.from_earthquake(rms_acceleration=2.5, center_frequency_hz=3, duration=60)
    assert e == ss.PoissonPulses.event("great very near field")
    e = ss.PoissonPulses.from_earthquake(
        rms_acceleration=2, center_frequency_hz=4, duration=60, overlap=2, shape=([0, 1], [1])
    )
    assert e.variance == pytest.approx(4)
    assert e.rate * e.half_width == pytest.approx(2)


def test_closed_forms_are_those_of_the_thesis():
    e = ss.PoissonPulses(**USUAL)
    dt, power = 1 / 6, 3 * 2.5**2
    assert e.variance == pytest.approx(2 * power * dt)
    assert e.ground_velocity_variance == pytest.approx(2 * power * dt**3 / 3)
    assert e.ground_displacement_variance(60) == pytest.approx(power * dt**4 * 60)
    assert np.allclose(e.ground_displacement_variance([0, 1, 2]), power * dt**4 * np.arange(3))
    omega = np.array([[0.1, 1], [10, -30]])
    assert np.allclose(
        e.density(omega), 8 * power * np.sin(omega * dt / 2) ** 4 / (np.pi * omega**2)
    )
    assert e.density(0.0) == 0
    assert isinstance(e.density(1), float)
    box = ss.PoissonPulses(**USUAL, shape=([0, 1], [1]))
    assert box.ground_velocity_variance == INF


def test_amplitudes_follow_a_distribution_of_scipy():
    student = stats.t(5, scale=math.sqrt(3 / 5))  # of variance 1
    e = ss.PoissonPulses(rate=100, half_width=0.1, sigma=3, duration=100, quantile=student.ppf)
    amplitudes = e.pulses(seed=4, member=0)[1]
    assert stats.kstest(amplitudes / 3, student.cdf).pvalue > 0.001  # fails once in 1000 seeds
    gaussian = ss.PoissonPulses(rate=100, half_width=0.1, sigma=3, duration=100)
    assert np.array_equal(e.pulses(seed=4, member=0)[0], gaussian.pulses(seed=4, member=0)[0])


def test_a_quantile_function_sees_arrays_and_its_errors_come_out():
    seen = []

    def watch(u):
        seen.append(u.copy())
        u[:] = 0  # its own copy: without effect
        return stats.norm.ppf(seen[-1])

    e = ss.PoissonPulses(**USUAL, quantile=watch)
    assert e.quantile is watch
    amplitudes = e.pulses(seed=5, member=0)[1]
    assert np.array_equal(amplitudes, 2.5 * stats.norm.ppf(seen[-1]))

    broken = False

    def breaks(u):
        if broken:
            raise RuntimeError("no amplitudes today")
        return two_sided(u)

    e = ss.PoissonPulses(**USUAL, quantile=breaks)
    broken = True
    with pytest.raises(RuntimeError, match="no amplitudes today"):
        e.sample(seed=1, member=1)


@pytest.mark.parametrize(
    ("quantile", "message"),
    [
        (lambda u: 0.5, "what quantile returns must be one-dimensional"),
        (lambda u: u[:-1], "one number for each it is given, got 1023 for 1024"),
        (lambda u: 1j * u, "what quantile returns must hold real numbers"),
        (lambda u: np.full(u.shape, NAN), "must be finite in .0, 1., got nan"),
        (lambda u: 3 * two_sided(u), "must have a mean square of 1.*got 8.99"),
    ],
)
def test_what_is_no_quantile_function_is_refused(quantile, message):
    with pytest.raises(ValueError, match=message):
        ss.PoissonPulses(**USUAL, quantile=quantile)


@pytest.mark.parametrize("name", ["rate", "half_width", "sigma", "duration"])
@pytest.mark.parametrize("bad", [0.0, -1.0, NAN, INF])
def test_a_value_that_is_not_positive_is_refused(name, bad):
    with pytest.raises(ValueError, match=f"PoissonPulses: {name} must be positive and finite, got"):
        ss.PoissonPulses(**{**USUAL, name: bad})


@pytest.mark.parametrize(
    ("shape", "message"),
    [
        (([0, 1], [1, -1]), "one time more than values"),
        (([0, 1, 1], [1, -1]), r"times\[2\] must be greater than 1"),
        (([1, 2], [1]), r"times\[0\] must be 0"),
        (([0, 1], [NAN]), r"values\[0\] must be finite"),
        (([0, 1], [[1]]), "PulseShape: values must be one-dimensional"),
    ],
)
def test_a_shape_that_is_no_pulse_is_refused(shape, message):
    with pytest.raises(ValueError, match=message):
        ss.PoissonPulses(**USUAL, shape=shape)


def test_more_steps_than_memory_holds_are_refused():
    with pytest.raises(ValueError, match=r"at most 3e8 steps .* got 3e\+12 steps"):
        ss.PoissonPulses(rate=1e6, half_width=1, sigma=1, duration=1e6)


def test_it_says_what_it_is(excitation):
    assert repr(ss.PoissonPulses(rate=3, half_width=0.5, sigma=2.5, duration=60)) == (
        "PoissonPulses(rate=3, half_width=0.5, sigma=2.5, duration=60)"
    )
    if excitation.quantile is not None:
        assert "quantile=<function two_sided" in repr(excitation)
    told = json.loads(excitation.configuration)
    assert told["excitation"] == "PoissonPulses"
    assert told["rate"] == 3
    assert told["stationary_start"] == excitation.stationary_start


def test_an_envelope_weighs_pulses_where_they_arrive():
    envelope = ss.Envelope(build_up=4, strong_duration=5, decay_rate=0.3)
    shaped, plain = ss.PoissonPulses(**USUAL, envelope=envelope), ss.PoissonPulses(**USUAL)
    assert shaped.envelope == envelope
    t, b = shaped.pulses(seed=6, member=0)
    factor = np.where(t < 4, (t / 4) ** 2, np.exp(-0.3 * np.clip(t - 9, 0, None)))
    assert np.allclose(b, factor * plain.pulses(seed=6, member=0)[1], rtol=1e-14)
    assert shaped != plain
    assert "envelope=Envelope(" in repr(shaped)


def test_it_shakes_a_slider():
    event = ss.PoissonPulses.event("great very near field")
    motion = event.sample(seed=1, member=0)
    assert ss.integrate(ss.Coulomb(slip_level=1e4), motion).peak == 0
    ground = -ss.integrate(ss.Coulomb(slip_level=0), motion).residual  # frictionless: stays behind
    steps, n = np.diff(motion.time), motion.acceleration[:-1]
    v = np.concatenate([[0], np.cumsum(n * steps)])[:-1]
    assert ground == pytest.approx(np.sum(steps * (v + n * steps / 2)), rel=1e-12)
