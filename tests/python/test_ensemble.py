"""Ensembles: the statistics of single members, the same bits in whatever way, and files."""

import concurrent.futures
import contextlib
import json
import math
import os
import pickle
import signal
import subprocess
import sys
import threading
import time
import types
import zipfile
from itertools import pairwise

import numpy as np
import pytest
import stickslip as ss
from scipy.stats import kstatvar
from sources import BAND, BLOCK, SHAKING, Delayed, refuse, same_bits, waiting_for
from stickslip.runs import progress as progress_of_runs

CART = ss.Slider(ss.Caster(slip_level=2.0, reach=0.5), natural_frequency=1.3)
QUAKE = ss.PoissonPulses.event("moderate near field")
CASES = {
    "block, Gaussian": (BLOCK, SHAKING),
    "one-way block, Gaussian": (ss.Coulomb(slip_level=1.0, backward=math.inf), SHAKING),
    "block on a spring, Gaussian": (ss.Slider(BLOCK, natural_frequency=2.0), SHAKING),
    "cart, Gaussian": (CART, SHAKING),
    "block, pulses": (ss.Coulomb(mu=0.02), QUAKE),
    "cart, pulses": (ss.Caster(mu=0.03, reach=0.1), QUAKE),
    "block, a source in Python": (BLOCK, Delayed()),
}


@pytest.fixture(params=CASES)
def case(request):
    return CASES[request.param]


@pytest.fixture(scope="module")
def ensemble():
    return ss.run_ensemble(BLOCK, SHAKING, members=1000, seed=1)


def near(value, exact, scale=None):
    scale = np.abs(exact).max() if scale is None else scale
    assert np.abs(np.asarray(value) - exact).max() <= 1e-12 * scale


# ---- figures


@pytest.mark.parametrize("slider", [BLOCK, ss.Slider(BLOCK, natural_frequency=2.0), CART])
def test_statistics_are_those_of_the_single_members(slider):
    n = 100  # a whole block and one that is cut
    e = ss.run_ensemble(slider, SHAKING, members=n, seed=5)
    responses = [ss.integrate(slider, SHAKING.sample(seed=5, member=m)) for m in range(n)]
    x = np.array([r.displacement for r in responses])
    v = np.array([r.velocity for r in responses])
    assert (e.members, e.member_ranges, e.block) == (n, [(0, n)], 64)
    near(e.time, responses[0].time)
    near(e.peak, [r.peak for r in responses])
    near(e.residual, [r.residual for r in responses])
    near(e.displacement_mean, x.mean(0), x.std())
    near(e.displacement_mean_error, x.std(0, ddof=1) / math.sqrt(n))
    near(e.velocity_mean, v.mean(0), v.std())
    near(e.velocity_mean_error, v.std(0, ddof=1) / math.sqrt(n))
    dx, dv = x - x.mean(0), v - v.mean(0)
    for name, a, b in (
        ("displacement_variance", dx, dx),
        ("velocity_variance", dv, dv),
        ("covariance", dx, dv),
    ):
        covariance, error = covariance_of(a, b)
        scale = np.sqrt(a.var(0).max() * b.var(0).max())
        near(getattr(e, name), covariance, scale)
        near(getattr(e, f"{name}_error"), error, scale)
    assert covariance_of(dv, dv)[1][100] ** 2 == pytest.approx(kstatvar(v[:, 100], 2), rel=1e-9)


def covariance_of(a, b):
    """The unbiased covariance of deviations by time, and its standard error, by k-statistics.

    Its variance is kappa_22 / n + (kappa_20 kappa_02 + kappa_11^2) / (n - 1); unbiased estimates of
    the cumulants and their products: Kendall and Stuart, vol. 1, ch. 12 and 13.
    """
    n = len(a)
    s11, s20, s02, s22 = ((c * d).sum(0) for c, d in ((a, b), (a, a), (b, b), (a * a, b * b)))
    k11, k20, k02 = s11 / (n - 1), s20 / (n - 1), s02 / (n - 1)
    k22 = n * (n + 1) * s22 - (n - 1) * (s20 * s02 + 2 * s11**2)
    k22 /= (n - 1) * (n - 2) * (n - 3)
    squares = ((n - 3) * k11**2 + (n - 1) * k20 * k02) / ((n - 2) * (n + 1))
    return k11, np.sqrt((n - 1) / (n * (n + 1)) * k22 + squares)


def test_stationary_averages_are_over_the_central_half():
    n = 80
    e = ss.run_ensemble(BLOCK, SHAKING, members=n, seed=2)
    responses = [ss.integrate(BLOCK, SHAKING.sample(seed=2, member=m)) for m in range(n)]
    v = np.array([r.velocity for r in responses])
    x = np.array([r.displacement for r in responses])
    begin, count = 64, 128
    s = e.stationary
    near([s.begin, s.end], [0.1 * begin, 0.1 * (begin + count)])
    central = slice(begin, begin + count)
    near(s.velocity_variance.value, v[:, central].var(0, ddof=1).mean())
    near(s.velocity_mean.value, v[:, central].mean(), v.std())
    near(s.velocity_mean.error, v[:, central].mean(1).std(ddof=1) / math.sqrt(n))
    half = (x[:, begin + count // 2] - x[:, begin]).var(ddof=1)
    whole = (x[:, begin + count] - x[:, begin]).var(ddof=1)
    near(s.growth_rate.value, (whole - half) / (0.1 * count / 2), whole)
    assert s.growth_rate.error > 0

    # Kaiser-Bessel, beta = 8, thesis (4.62), with a mean square of one.
    i = np.arange(count) - count / 2
    window = np.i0(8 * np.sqrt(1 - (i / (count / 2)) ** 2))
    window /= np.sqrt((window**2).mean())
    transformed = np.abs(np.fft.rfft(window * v[:, central])) ** 2 * 0.1 / (2 * np.pi * count)
    spectrum = e.velocity_spectrum
    near(spectrum.omega, 2 * np.pi * np.arange(count // 2 + 1) / (0.1 * count))
    near(spectrum.density, transformed.mean(0))
    near(spectrum.error, transformed.std(0, ddof=1) / math.sqrt(n))


def test_a_velocity_that_is_not_stationary_is_said_wherever_its_variance_is(ensemble):
    s = ensemble.stationary
    assert s.is_stationary
    assert s.remark == ""
    v = s.velocity_trend
    assert abs(v.value) < 3.29 * v.error

    # The ground dies down from 4 s on; the central half begins at 6.4 s.
    dying = ss.GaussianExcitation(
        ss.Spectrum.band_pass(s0=1.0, low=2.0, high=4.0),
        dt=0.1,
        samples=256,
        period=1024,
        envelope=ss.Envelope(build_up=2, strong_duration=2, decay_rate=0.2),
    )
    comparison = ss.compare(BLOCK, dying, members=500, seed=1, theories=[Anything()])
    e = comparison.ensemble
    s = e.stationary
    assert not s.is_stationary
    assert s.remark.startswith("the velocity is not stationary: from the first to the second half")
    assert f"simulation: {s.remark}" in str(comparison)
    assert "not shown to be stationary" in repr(s)
    assert e.moments.remark == s.remark
    for picture in (e.plot(), comparison.plot()):
        texts = [text.get_text() for axes in picture.axes for text in axes.texts]
        assert sum("not s" in text for text in texts) == 1


class Anything:
    name = "anything"

    def covers(self, slider, excitation):
        return True

    def predict(self, slider, excitation, times):
        return ss.Moments(times)


def test_peaks_and_residuals_are_those_of_integrate(case):
    slider, source = case
    for settle in (False, True):
        e = ss.run_ensemble(slider, source, members=10, seed=3, settle=settle)
        singles = [
            ss.integrate(slider, source.sample(seed=3, member=m), settle=settle) for m in range(10)
        ]
        assert e.peak == pytest.approx([r.peak for r in singles], rel=1e-12, abs=1e-13)
        scale = e.peak.max()
        assert e.residual == pytest.approx([r.residual for r in singles], abs=1e-12 * scale)
        assert scale > 0


def test_quantiles_and_exceedances_are_counts_of_peaks(ensemble):
    peaks = np.sort(ensemble.peak)
    q = ensemble.quantile(0.95)
    assert q.value == peaks[949]
    assert q.low < q.value < q.high
    level = float(peaks[899])
    p = ensemble.exceedance(level)
    assert p.value == 0.1
    # Clopper and Pearson for 100 of 1000 (SciPy 1.17: binomtest(100, 1000).proportion_ci()).
    assert (p.low, p.high) == pytest.approx((0.08210533435558, 0.12028793651869), rel=1e-9)
    assert ensemble.quantile(0.999, confidence=0.99).high == math.inf
    assert ensemble.exceedance(1e9).value == 0
    narrow, wide = ensemble.exceedance(level, 0.5), ensemble.exceedance(level, 0.999)
    assert wide.low < narrow.low < narrow.high < wide.high


def test_every_exceedance_has_bounds(ensemble):
    for peak in np.sort(ensemble.peak)[::7]:
        p = ensemble.exceedance(peak)
        assert 0 <= p.low <= p.value <= p.high <= 1
        assert p.low < p.high


def test_an_ensemble_says_what_it_is(ensemble):
    assert repr(ensemble) == "<Ensemble: 1000 members, seed 1, 256 times to 25.5 s>"
    assert repr(ensemble.quantile(0.5)).startswith("<Interval: ")
    assert repr(ensemble.velocity_spectrum) == ("<VelocitySpectrum: 65 frequencies to 31.42 rad/s>")
    variance = ensemble.stationary.velocity_variance
    text = f"{variance.value:.4f} +- {variance.error:.4f}"
    assert repr(variance) == f"<Estimate: {text}>"
    assert repr(ensemble.stationary) == (
        f"<Stationary: from 6.4 to 19.2 s, velocity_variance {text} m^2/s^2, growth_rate "
        + repr(ensemble.stationary.growth_rate)[len("<Estimate: ") : -1]
        + " m^2/s>"
    )
    told = ensemble.configuration
    assert told["slider"]["slip_level"] == 2
    assert told["excitation"] == json.loads(SHAKING.configuration)
    assert (told["seed"], told["times"], told["settle"]) == (1, 256, False)


def test_times_of_the_statistics_may_be_further_apart(ensemble):
    e = ss.run_ensemble(BLOCK, SHAKING, members=1000, seed=1, dt=0.5)
    near(e.time, 0.5 * np.arange(52))
    assert np.array_equal(e.displacement_variance, ensemble.displacement_variance[::5])
    assert np.array_equal(e.peak, ensemble.peak)


def test_two_members_are_enough_and_one_is_not():
    one = ss.run_ensemble(BLOCK, SHAKING, members=1, seed=1)
    assert (len(one.peak), one.members) == (1, 1)
    for name in ("displacement_variance", "stationary", "velocity_spectrum", "velocity_mean_error"):
        with pytest.raises(ValueError, match="two members, got 1"):
            getattr(one, name)
    two = ss.run_ensemble(BLOCK, SHAKING, members=2, seed=1)
    assert np.isfinite(two.displacement_variance_error).all()


# ---- the same bits


def test_the_bits_do_not_depend_on_threads(case):
    slider, source = case
    one, two, eight = (
        ss.run_ensemble(slider, source, members=700, seed=4, threads=threads)
        for threads in (1, 2, 8)
    )
    assert same_bits(one, two)
    assert same_bits(one, eight)
    assert len(set(one.peak)) > 600


def test_parts_merge_to_the_whole_in_any_order(ensemble):
    def run(first, members):
        return ss.run_ensemble(BLOCK, SHAKING, members=members, first_member=first, seed=1)

    for cuts in ([0, 512, 1000], [0, 64, 320, 960, 1000]):
        parts = [run(a, b - a) for a, b in pairwise(cuts)]
        for order in (parts, parts[::-1]):
            whole = pickle.loads(pickle.dumps(order[0]))
            for part in order[1:]:
                before = part.member_ranges
                assert whole.merge(part) is None
                assert part.member_ranges == before
            assert same_bits(whole, ensemble)


def test_which_members_are_there_is_told():
    def run(first, members):
        return ss.run_ensemble(BLOCK, SHAKING, members=members, first_member=first, seed=1)

    e = run(0, 80)  # ends within a block
    for first, members, ranges in (
        (640, 64, [(0, 80), (640, 704)]),
        (128, 128, [(0, 80), (128, 256), (640, 704)]),
        (256, 384, [(0, 80), (128, 704)]),
    ):
        e.merge(run(first, members))
        assert e.member_ranges == ranges
    assert e.members == sum(b - a for a, b in e.member_ranges)
    assert ss.run_ensemble(BLOCK, SHAKING, members=64, seed=1).member_ranges == [(0, 64)]


def test_another_seed_is_another_ensemble(ensemble):
    other = ss.run_ensemble(BLOCK, SHAKING, members=1000, seed=2)
    assert not np.isin(other.peak, ensemble.peak).any()


OTHERS = {
    "seed": (dict(seed=2), "seed 1 against seed 2"),
    "slider": (dict(slider=ss.Coulomb(slip_level=3.0)), '"slip_level": 2'),
    "spring": (dict(slider=ss.Slider(BLOCK, 1.0)), '"natural_frequency": 1}'),
    "excitation": (
        dict(excitation=ss.GaussianExcitation(BAND, dt=0.1, samples=256, zero_frequency=True)),
        '"zero_frequency": true',
    ),
    "times": (dict(dt=0.2), "dt 0.1 against dt 0.2"),
    "settle": (dict(settle=True), "settle false against settle true"),
    "spectrum": (dict(velocity_spectrum=False), "velocity_spectrum true against"),
    "members": (dict(first_member=0), "both hold members from 0 to "),
}


@pytest.mark.parametrize("what", OTHERS)
def test_what_does_not_belong_together_is_not_merged(what):
    e = ss.run_ensemble(BLOCK, SHAKING, members=64, seed=1)
    before = pickle.dumps(e)
    change, message = OTHERS[what]
    asked = dict(slider=BLOCK, excitation=SHAKING, members=64, first_member=64, seed=1) | change
    other = ss.run_ensemble(asked.pop("slider"), asked.pop("excitation"), **asked)
    with pytest.raises(ValueError, match="cannot merge") as refusal:
        e.merge(other)
    assert message in str(refusal.value)
    assert pickle.dumps(e) == before


def test_an_ensemble_cannot_be_merged_with_anything_else(ensemble):
    with pytest.raises(TypeError):
        ensemble.merge([ensemble])


# ---- a source in Python


def test_a_source_in_python_is_asked_for_every_member_once():
    class Counting(Delayed):
        def sample(self, *, seed, member):
            asked.append((seed, member))
            return super().sample(seed=seed, member=member)

    asked = []
    e = ss.run_ensemble(BLOCK, Counting(), members=130, seed=9, threads=3)
    assert sorted(asked) == [(9, m) for m in range(130)]
    assert e.configuration["excitation"] == {"of": "tests"}
    theirs = ss.run_ensemble(BLOCK, SHAKING, members=130, seed=9)
    assert e.peak == pytest.approx(theirs.peak, rel=1e-12)


def test_a_source_in_python_is_asked_by_one_thread_at_a_time():
    class Alone(Delayed):
        def __init__(self):
            super().__init__(1e-4)  # a sleep lets go of the interpreter
            self.turn, self.overlaps = threading.Lock(), 0

        def sample(self, *, seed, member):
            if not self.turn.acquire(blocking=False):
                self.overlaps += 1
                return super().sample(seed=seed, member=member)
            with contextlib.ExitStack() as stack:
                stack.callback(self.turn.release)
                return super().sample(seed=seed, member=member)

    source = Alone()
    e = ss.run_ensemble(BLOCK, source, members=640, seed=9, threads=4)
    assert source.overlaps == 0
    assert same_bits(e, ss.run_ensemble(BLOCK, Delayed(), members=640, seed=9, threads=1))


def test_a_run_within_a_source_does_not_wait_for_itself():
    class Nested(Delayed):
        def sample(self, *, seed, member):
            ss.run_ensemble(BLOCK, Delayed(), members=2, seed=member, threads=2)
            return super().sample(seed=seed, member=member)

    e = ss.run_ensemble(BLOCK, Nested(), members=200, seed=9, threads=4)
    assert same_bits(e, ss.run_ensemble(BLOCK, Delayed(), members=200, seed=9))


@pytest.mark.skipif(os.name == "nt", reason="Windows has no SIGINT to send")
def test_after_ctrl_c_no_thread_waits_for_its_turn_with_a_source():
    class Interrupted(Delayed):
        def sample(self, *, seed, member):
            asked.append(member)
            if len(asked) == 1:
                os.kill(os.getpid(), signal.SIGINT)
            time.sleep(1.0)
            return super().sample(seed=seed, member=member)

    asked = []
    with pytest.raises(KeyboardInterrupt):
        ss.run_ensemble(BLOCK, Interrupted(), members=16 * 64, seed=9, threads=16)
    assert len(asked) <= 2


def test_what_a_source_raises_comes_through():
    with pytest.raises(LookupError, match="no motion here"):
        ss.run_ensemble(BLOCK, Delayed(0, 77, refuse), members=200, seed=1)


def test_what_is_no_source_is_told_what_it_lacks():
    with pytest.raises(TypeError, match="Spectrum has no sample"):
        ss.run_ensemble(BLOCK, BAND, members=2, seed=1)

    class Short(Delayed):
        def sample(self, *, seed, member):
            return ss.GroundMotion([1.0, 2.0], dt=1.0)

    with pytest.raises(ValueError, match=r"must last 25.5 s, its duration; member \d lasts 1 s"):
        ss.run_ensemble(BLOCK, Short(), members=2, seed=1)

    class Nothing(Delayed):
        def sample(self, *, seed, member):
            return None

    with pytest.raises(TypeError, match="must return a GroundMotion, got NoneType"):
        ss.run_ensemble(BLOCK, Nothing(), members=2, seed=1)
    timeless = Delayed()
    timeless.duration = -1.0
    with pytest.raises(ValueError, match="duration must be positive and finite, got -1 s"):
        ss.run_ensemble(BLOCK, timeless, members=2, seed=1)


# ---- bad input

REFUSED = {
    "no members": (dict(members=0), ValueError, "members must be at least 1, got 0"),
    "fewer than none": (dict(members=-5), ValueError, "members must be at least 1, got -5"),
    "a broken number": (dict(members=1e3), TypeError, "members must be a whole number, got 1000.0"),
    "too many": (dict(members=2**64), ValueError, "members must be at most 18446744073709551615"),
    "past the end": (
        dict(members=2**63, first_member=2**63 + 64),
        ValueError,
        "less than 2^64",
    ),
    "negative seed": (dict(seed=-1), ValueError, "seed must be at least 0, got -1"),
    "a seed that is none": (dict(seed=None), TypeError, "seed must be a whole number, got None"),
    "half a block": (dict(first_member=32), ValueError, "multiple of 64"),
    "no threads": (dict(threads=0), ValueError, "threads must be at least 1, got 0"),
    "no time": (dict(dt=0), ValueError, "dt must be positive and finite, got 0 s"),
    "NaN time": (dict(dt=math.nan), ValueError, "dt must be positive and finite, got nan s"),
    "a crooked time": (dict(dt=0.15), ValueError, "multiple of the excitation's 0.1 s"),
    "too long a time": (dict(dt=100.0), ValueError, "at most the duration, 25.5 s"),
    "a strange slider": (dict(slider=0.2), TypeError, "float has no sample"),
    "a strange source": (dict(excitation=1.0), TypeError, "float has no sample"),
    "strange progress": (dict(progress="yes"), TypeError, "progress must be True, False"),
    "a strange executor": (dict(executor=4), TypeError, "must be a concurrent.futures.Executor"),
    "negative waiting": (dict(checkpoint_every=-1), ValueError, "at least 0, got -1 s"),
}


@pytest.mark.parametrize("what", REFUSED)
def test_bad_input_is_named(what):
    change, kind, message = REFUSED[what]
    asked = dict(slider=BLOCK, excitation=SHAKING, members=10, seed=1) | change
    with pytest.raises(kind) as refusal:
        ss.run_ensemble(asked.pop("slider"), asked.pop("excitation"), **asked)
    assert message in str(refusal.value)


@pytest.mark.parametrize("bad", [-0.1, 0, 1, 1.5, math.nan])
def test_a_share_lies_between_0_and_1(ensemble, bad):
    with pytest.raises(ValueError, match=f"probability must lie between 0 and 1, got {bad}"):
        ensemble.quantile(bad)
    with pytest.raises(ValueError, match=f"confidence must lie between 0 and 1, got {bad}"):
        ensemble.quantile(0.5, bad)
    with pytest.raises(ValueError, match=f"confidence must lie between 0 and 1, got {bad}"):
        ensemble.exceedance(0.5, bad)


@pytest.mark.parametrize("bad", [-1, math.inf, math.nan])
def test_a_level_is_a_length(ensemble, bad):
    with pytest.raises(ValueError, match=f"level must be finite and at least 0, got {bad} m"):
        ensemble.exceedance(bad)


def test_a_spectrum_that_was_not_asked_for_is_missed():
    e = ss.run_ensemble(BLOCK, SHAKING, members=2, seed=1, velocity_spectrum=False)
    with pytest.raises(ValueError, match="not asked for"):
        _ = e.velocity_spectrum


@pytest.mark.parametrize("sigma", [1e36, 1e80, 1e160, 1e300])
def test_motions_whose_statistics_overflow_are_refused(sigma):
    pulses = ss.PoissonPulses(rate=1, half_width=0.5, sigma=sigma, duration=20)
    with pytest.raises(OverflowError, match=r"must not exceed 1e\+34, .* in member \d+"):
        ss.run_ensemble(BLOCK, pulses, members=100, seed=1)


def test_errors_of_the_largest_motions_are_in_proportion():
    # Without friction the motion is proportional to the pulses, exactly so for powers of two.
    scale = 2.0**100

    def run(sigma):
        pulses = ss.PoissonPulses(rate=1, half_width=0.5, sigma=sigma, duration=20)
        return ss.run_ensemble(ss.Coulomb(slip_level=0), pulses, members=100, seed=1)

    one, large = run(1.0), run(scale)
    assert large.stationary.velocity_kurtosis.error == one.stationary.velocity_kurtosis.error > 0
    assert (large.displacement_variance_error == one.displacement_variance_error * scale**2).all()


def test_a_slider_that_never_rests_is_an_error_that_names_the_member():
    with pytest.raises(ss.ConvergenceError, match=r"member \d+: .*does not come to rest"):
        ss.run_ensemble(ss.Slider(ss.Coulomb(mu=0)), QUAKE, members=9, seed=1, settle=True)


# ---- files


def test_a_saved_ensemble_comes_back_to_the_bit(case, tmp_path):
    slider, source = case
    e = ss.run_ensemble(slider, source, members=100, first_member=128, seed=2**64 - 1)
    file = tmp_path / "run.npz"
    assert e.save(file) is None
    back = ss.Ensemble.load(str(file))
    assert same_bits(e, back)
    assert back.configuration == e.configuration
    assert np.array_equal(back.peak, e.peak)
    assert repr(back.stationary) == repr(e.stationary)
    assert list(tmp_path.iterdir()) == [file]
    back.merge(ss.run_ensemble(slider, source, members=128, seed=2**64 - 1))
    assert back.members == 228


def test_a_file_needs_nothing_but_numpy_to_be_read(ensemble, tmp_path):
    ensemble.save(tmp_path / "run.npz")
    with np.load(tmp_path / "run.npz", allow_pickle=False) as arrays:
        assert str(arrays["format"]) == "stickslip ensemble 1"
        assert str(arrays["library"]) == ss.__version__
        assert np.array_equal(arrays["peak"], ensemble.peak)
        assert dict(json.loads(str(arrays["configuration"])))["seed"] == "1"


def test_the_ground_acceleration_is_there_where_it_is_asked_for(ensemble, tmp_path):
    assert "ground_acceleration" not in ensemble.configuration
    for name in ("mean", "mean_error", "variance", "variance_error"):
        with pytest.raises(ValueError, match="run with ground_acceleration = true"):
            getattr(ensemble, f"ground_acceleration_{name}")
    pulses = ss.PoissonPulses(rate=3, half_width=0.25, sigma=2, duration=4, stationary_start=True)
    options = dict(seed=1, dt=0.5, ground_acceleration=True)
    e = ss.run_ensemble(BLOCK, pulses, members=200, **options)
    assert e.configuration["ground_acceleration"] is True
    n = np.zeros((200, len(e.time)))
    for member, row in enumerate(n):
        motion = pulses.sample(seed=1, member=member)
        last = len(motion.acceleration) - 2  # the last value holds no longer
        at = np.searchsorted(motion.time, e.time, side="right") - 1
        row[:] = motion.acceleration[np.minimum(at, last)]
    assert e.ground_acceleration_mean == pytest.approx(n.mean(axis=0), abs=1e-12)
    assert e.ground_acceleration_variance == pytest.approx(n.var(axis=0, ddof=1), rel=1e-12)
    error = n.std(axis=0, ddof=1) / math.sqrt(200)
    assert e.ground_acceleration_mean_error == pytest.approx(error, rel=1e-12)
    # Four standard errors at nine times: once in 1700 times by chance, were the seed another.
    off = np.abs(e.ground_acceleration_variance - pulses.variance)
    assert (off < 4 * e.ground_acceleration_variance_error).all()
    # In files, pickles, parts and other threads.
    e.save(tmp_path / "run.npz")
    assert same_bits(ss.Ensemble.load(tmp_path / "run.npz"), e)
    assert same_bits(pickle.loads(pickle.dumps(e)), e)
    parts = ss.run_ensemble(BLOCK, pulses, members=72, first_member=128, **options)
    parts.merge(ss.run_ensemble(BLOCK, pulses, members=128, threads=1, **options))
    assert same_bits(parts, e)
    with concurrent.futures.ThreadPoolExecutor(1) as executor:
        options["executor"] = executor
        assert same_bits(ss.run_ensemble(BLOCK, pulses, members=200, **options), e)
    plain = ss.run_ensemble(BLOCK, pulses, members=64, seed=1, dt=0.5, first_member=256)
    with pytest.raises(ValueError, match="cannot merge what differs: ground_acceleration true"):
        e.merge(plain)


def test_a_truncated_file_is_refused(ensemble, tmp_path):
    file = tmp_path / "run.npz"
    ensemble.save(file)
    whole = file.read_bytes()
    for length in (0, 1, 3, 4, 100, len(whole) // 2, len(whole) - 100, len(whole) - 1):
        file.write_bytes(whole[:length])
        with pytest.raises(ValueError, match=r"run\.npz' is (truncated|damaged|not an ensemble)"):
            ss.Ensemble.load(file)


def test_a_damaged_file_is_refused_or_has_the_same_bits(ensemble, tmp_path):
    # Bytes that no checksum guards (dates, paddings) may change, but no number does.
    file = tmp_path / "run.npz"
    ensemble.save(file)
    whole = file.read_bytes()
    refused = 0
    places = np.random.default_rng(1).integers(0, len(whole), 60).tolist()
    places += range(len(whole) - 120, len(whole), 2)  # the table of contents
    for place in places:
        file.write_bytes(whole[:place] + bytes([whole[place] ^ 0x10]) + whole[place + 1 :])
        try:
            assert same_bits(ss.Ensemble.load(file), ensemble)
        except ValueError as error:
            assert "run.npz' " in str(error)
            refused += 1
    assert refused > 60


def test_a_file_of_something_else_is_refused_by_name(ensemble, tmp_path):
    text = tmp_path / "text.npz"
    text.write_text("hello")
    with pytest.raises(ValueError, match=r"text\.npz' is not an ensemble: not a NumPy archive"):
        ss.Ensemble.load(text)
    np.savez(tmp_path / "other.npz", a=[1], b=[2])
    with pytest.raises(ValueError, match=r"other\.npz' is not an ensemble: it holds a, b"):
        ss.Ensemble.load(tmp_path / "other.npz")
    with zipfile.ZipFile(tmp_path / "words.npz", "w") as archive:
        archive.writestr("letter.txt", "hello")
    with pytest.raises(ValueError, match=r"words\.npz' is "):
        ss.Ensemble.load(tmp_path / "words.npz")
    for form in ("stickslip ensemble 0", "stickslip ensemble 2"):
        np.savez(tmp_path / "other.npz", format=form, library="9.0")
        with pytest.raises(ValueError, match=rf"of format '{form}', of stickslip 9\.0"):
            ss.Ensemble.load(tmp_path / "other.npz")
    with pytest.raises(FileNotFoundError):
        ss.Ensemble.load(tmp_path / "nowhere.npz")
    with pytest.raises(FileNotFoundError, match="no such folder"):
        ensemble.save(tmp_path / "nowhere" / "run.npz")
    with pytest.raises(TypeError):
        ss.Ensemble.load(3)


CROOKED = {
    "missing": lambda s: s.pop("sums"),
    "fewer peaks": lambda s: s.update(peak=s["peak"][:-1], residual=s["residual"][:-1]),
    "no residuals": lambda s: s.update(residual=s["residual"][:-1]),
    "narrow sums": lambda s: s.update(sums=s["sums"][:, :-1]),
    "fewer sums": lambda s: s.update(sums=s["sums"][:-1]),
    "no count": lambda s: s.update(count=0 * s["count"]),
    "twice": lambda s: s.update(number=0 * s["number"], level=0 * s["level"]),
    "far away": lambda s: s.update(level=s["level"] + 70),
    "no time": lambda s: s.update(dt=0.0),
    "too many times": lambda s: s.update(times=2**40),
    "words": lambda s: s.update(peak=np.array(["a"] * len(s["peak"]))),
    "a table": lambda s: s.update(peak=np.array([s["peak"]])),
    "single precision": lambda s: s.update(sums=s["sums"].astype("f4")),
    "signed counts": lambda s: s.update(count=s["count"].astype("i8")),
    "another time": lambda s: s.update(dt=0.2),
    "other times": lambda s: s.update(times=257),
    "an array besides": lambda s: s.update(more=np.zeros(3)),
    "a NaN peak": lambda s: put(s["peak"], math.nan),
    "a negative peak": lambda s: put(s["peak"], -1e-9),
    "an infinite residual": lambda s: put(s["residual"], math.inf),
    "transverse residuals on one axis": lambda s: s.update(residual_transverse=s["residual"]),
    "suddenly in the plane": lambda s: s.update(in_plane=True),
    "a NaN sum": lambda s: put(s["sums"], math.nan),
    "an infinite sum": lambda s: put(s["sums"], math.inf),
    "a negative sum of squares": lambda s: put(s["sums"], -1.0, 2 * s["times"] + 5),
    "a negative periodogram": lambda s: put(s["sums"], -1.0, 12 * s["times"] + 5),
    "a block of other members": lambda s: put(s["kept_block"], 900),
    "a block that is cut twice": lambda s: s.update(
        cut_block=np.repeat(s["cut_block"], 2), cut_size=np.repeat(s["cut_size"], 2)
    ),
    "peaks kept and counted": lambda s: s.update(
        bin=np.array([3], "i4"), bin_count=np.array([1], "u8")
    ),
    "no configuration": lambda s: s.update(configuration="[]"),
    "a configuration without end": lambda s: s.update(configuration="[" * 100_000),
}


def put(array, value, place=3):
    array.flat[place] = value


@pytest.mark.parametrize("what", CROOKED)
def test_a_file_whose_parts_do_not_fit_is_refused(what, ensemble, tmp_path):
    ensemble.save(tmp_path / "run.npz")
    with np.load(tmp_path / "run.npz") as arrays:
        state = dict(arrays)
    CROOKED[what](state)
    np.savez(tmp_path / "run.npz", **state)
    with pytest.raises(ValueError, match=r"run\.npz' does not hold what an ensemble does"):
        ss.Ensemble.load(tmp_path / "run.npz")


def deflate_zeros(file, state):
    """One GB that takes one MB in the file."""
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        for name, array in state.items():
            with archive.open(f"{name}.npy", "w", force_zip64=True) as entry:
                np.lib.format.write_array(entry, array)
                if name == "sums":
                    for _ in range(64):
                        entry.write(bytes(2**24))


def claim_a_shape(file, state):
    """A header that promises eight TB."""
    np.savez(file, **state)
    shape = str(state["sums"].shape).encode()
    huge = str((1, 10**12)).encode()
    with zipfile.ZipFile(file) as archive:
        entries = {info.filename: archive.read(info) for info in archive.infolist()}
    assert shape in entries["sums.npy"]
    entries["sums.npy"] = entries["sums.npy"].replace(shape, huge)
    with zipfile.ZipFile(file, "w") as archive:
        for name, content in entries.items():
            archive.writestr(name, content)


def overlap(file, state):
    """All entries are the same bytes."""
    state["sums"] = np.zeros(2**23)
    np.savez(file, **state)
    with zipfile.ZipFile(file, "a") as archive:
        sums = archive.getinfo("sums.npy")
        for info in archive.infolist():
            info.header_offset = sums.header_offset
            info.file_size, info.compress_size, info.CRC = (
                sums.file_size,
                sums.compress_size,
                sums.CRC,
            )
        archive.writestr("more.npy", b"")


LIMITED = """
import resource, sys
import numpy, stickslip as ss
from stickslip import ensemble
with open("/proc/self/statm") as sizes:
    size = int(sizes.read().split()[0]) * resource.getpagesize()
resource.setrlimit(resource.RLIMIT_AS, (size + 300 * 2**20, -1))
try:
    ss.Ensemble.load(sys.argv[1])
except ValueError as error:
    print(error)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="needs /proc and a limit of memory")
@pytest.mark.parametrize("bomb", [deflate_zeros, claim_a_shape, overlap])
def test_a_file_that_claims_more_than_it_has_is_refused_in_little_memory(bomb, ensemble, tmp_path):
    file = tmp_path / "bomb.npz"
    ensemble.save(file)
    with np.load(file) as arrays:
        state = dict(arrays)
    bomb(file, state)
    command = [sys.executable, "-c", LIMITED, file]
    child = subprocess.run(command, capture_output=True, text=True)
    assert (child.stderr, child.returncode) == ("", 0)
    assert child.stdout.startswith(f"Ensemble.load: '{file}' is damaged: ")


def test_a_file_is_written_whole_or_not_at_all(ensemble, tmp_path, monkeypatch):
    file = tmp_path / "run.npz"
    file.write_bytes(b"what was there")

    def fill_the_disk(stream, **arrays):
        stream.write(b"PK")
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(np, "savez", fill_the_disk)
    with pytest.raises(OSError, match="No space left"):
        ensemble.save(file)
    assert file.read_bytes() == b"what was there"
    assert list(tmp_path.iterdir()) == [file]


# ---- checkpoints, progress, Ctrl-C


def test_a_checkpoint_is_the_saved_ensemble_and_ends_a_second_run_at_once(tmp_path):
    file = tmp_path / "run.npz"
    source = Delayed()
    e = ss.run_ensemble(BLOCK, source, members=100, seed=1, checkpoint=file)
    assert same_bits(ss.Ensemble.load(file), e)
    broken = Delayed(0, 5, refuse)  # which would tell if it were asked
    assert same_bits(
        ss.run_ensemble(BLOCK, broken, members=100, seed=1, checkpoint=file),
        e,
    )


def test_a_checkpoint_of_another_run_is_refused_and_stays(tmp_path):
    file = tmp_path / "run.npz"
    ss.run_ensemble(BLOCK, SHAKING, members=100, seed=1, checkpoint=file)
    before = file.read_bytes()
    with pytest.raises(ValueError, match=r"with checkpoint '.*run\.npz': .*seed 2 against seed 1"):
        ss.run_ensemble(BLOCK, SHAKING, members=100, seed=2, checkpoint=file)
    with pytest.raises(ValueError, match=r"with checkpoint '.*run\.npz': .*block"):
        ss.run_ensemble(BLOCK, SHAKING, members=200, seed=1, checkpoint=file)
    assert file.read_bytes() == before
    file.write_bytes(before[:1000])
    with pytest.raises(ValueError, match=r"run\.npz' is truncated"):
        ss.run_ensemble(BLOCK, SHAKING, members=100, seed=1, checkpoint=file)
    with pytest.raises(FileNotFoundError, match="no such folder"):
        ss.run_ensemble(BLOCK, SHAKING, members=9, seed=1, checkpoint=tmp_path / "no" / "run.npz")


def test_a_checkpoint_of_more_members_than_asked_for_is_refused_and_stays(tmp_path):
    file = tmp_path / "run.npz"
    ss.run_ensemble(BLOCK, SHAKING, members=640, seed=1, checkpoint=file)
    before = file.read_bytes()
    for first, members in ((0, 64), (64, 576), (64, 640), (0, 639)):
        with pytest.raises(ValueError) as refusal:
            ss.run_ensemble(
                BLOCK, SHAKING, members=members, first_member=first, seed=1, checkpoint=file
            )
        assert str(refusal.value) == (
            f"run_ensemble: checkpoint '{file}' must hold members of this run only, {first} to"
            f" {first + members - 1} ({members}), got 640 members, including 0 to 639"
        )
    assert file.read_bytes() == before


def test_progress_counts_up_to_the_end():
    class Waiting(Delayed):
        def sample(self, *, seed, member):
            if member == 100:
                assert first_block_seen.wait(60)
            return super().sample(seed=seed, member=member)

    def progress(done, total):
        seen.append((done, total))
        if done:
            first_block_seen.set()

    seen, first_block_seen = [], threading.Event()
    ss.run_ensemble(BLOCK, Waiting(), members=300, seed=1, threads=1, progress=progress)
    assert (64, 300) in seen
    assert seen[-1] == (300, 300)
    assert seen == sorted(seen)


# Of these two threads do 10,000 in a minute and a half, the first 64 in a second and a half.
SLOW, MANY = Delayed(0.02), 10_000


def test_what_progress_raises_ends_the_run_and_keeps_what_is_done(tmp_path):
    def stop(done, total):
        if done:
            raise RuntimeError("enough")

    file = tmp_path / "run.npz"
    run = dict(members=2_000, seed=1, threads=2)
    with pytest.raises(RuntimeError, match="enough"):
        ss.run_ensemble(BLOCK, SLOW, **run, progress=stop, checkpoint=file)
    assert 0 < ss.Ensemble.load(file).members < 2_000
    assert same_bits(
        ss.run_ensemble(BLOCK, Delayed(), **run, checkpoint=file),
        ss.run_ensemble(BLOCK, Delayed(), **run),
    )


def test_a_bar_is_where_it_is_asked_for(capsys, monkeypatch):
    run = dict(members=300, seed=1)
    ss.run_ensemble(BLOCK, Delayed(1e-3), **run)
    assert capsys.readouterr().err == ""  # no terminal
    ss.run_ensemble(BLOCK, Delayed(1e-3), **run, progress=True)
    out, err = capsys.readouterr()
    assert out == ""
    assert "300/300" in err and "member/s" in err
    assert len(err.split("\r")) <= 5  # a line each ten seconds
    monkeypatch.setattr(sys, "stderr", None)
    ss.run_ensemble(BLOCK, SHAKING, **run, progress=True)


@pytest.mark.parametrize("where", ["terminal", "notebook"])
def test_a_long_run_has_a_bar_where_it_is_seen(where, capsys, monkeypatch):
    if where == "terminal":
        monkeypatch.setattr(sys.stderr, "isatty", lambda: True, raising=False)
    else:
        ipython = types.ModuleType("IPython")
        ipython.get_ipython = type("ZMQInteractiveShell", (), {})
        monkeypatch.setitem(sys.modules, "IPython", ipython)
    run = dict(members=300, seed=1)
    ss.run_ensemble(BLOCK, Delayed(1e-3), **run)
    assert capsys.readouterr().err == ""  # it takes less than two seconds
    monkeypatch.setattr(progress_of_runs, "_DELAY", 0.01)
    ss.run_ensemble(BLOCK, Delayed(1e-3), **run)
    assert "300/300" in capsys.readouterr().err
    ss.run_ensemble(BLOCK, Delayed(1e-3), **run, progress=False)
    assert capsys.readouterr().err == ""


SCRIPT = """
import sys
import stickslip as ss
sys.path.insert(0, {folder!r})
from sources import BAND, BLOCK, SHAKING, Delayed

long = ss.GaussianExcitation(BAND, dt=0.1, samples=2**20)
wheel = ss.Caster(slip_level=2.0, reach=0.5)
seen = []

def progress(done, total):
    seen.append(done)
    if (done > 0 or not {wait_for_members}) and "run" not in seen:
        print("run", flush=True)
        seen.append("run")

if __name__ == "__main__":
    try:
        {work}
        print("ended")
    except KeyboardInterrupt:
        print("interrupted", max(done for done in seen if done != "run"), flush=True)
"""

# Each would take ten minutes or more, and ends in a test within the minute after which it fails.
LONG = {
    "many members": "ss.run_ensemble(BLOCK, SHAKING, members=10**10, seed=1, progress=progress)",
    "long members": """ss.run_ensemble(
            ss.Slider(wheel, 1e4), long, members=64, seed=1, progress=progress)""",
    "slow members": "ss.run_ensemble(BLOCK, Delayed(1), members=10**6, seed=1, progress=progress)",
    "threads": """
        from concurrent.futures import ThreadPoolExecutor
        pool = ThreadPoolExecutor(2)
        ss.run_ensemble(
            BLOCK, SHAKING, members=10**10, seed=1, executor=pool, progress=progress)""",
}

needs_signals = pytest.mark.skipif(os.name == "nt", reason="Windows has no SIGINT to send")


def start(tmp_path, work, wait_for_members=False):
    script = tmp_path / "script.py"
    folder = os.path.dirname(__file__)
    script.write_text(SCRIPT.format(folder=folder, work=work, wait_for_members=wait_for_members))
    child = subprocess.Popen([sys.executable, script], stdout=subprocess.PIPE, text=True)
    assert child.stdout.readline() == "run\n"
    return child


@needs_signals
@pytest.mark.parametrize("work", LONG)
def test_ctrl_c_ends_a_run_that_has_begun(work, tmp_path):
    with start(tmp_path, LONG[work]) as child:
        try:
            child.send_signal(signal.SIGINT)
            word, done = child.communicate(timeout=60)[0].split()
        finally:
            child.kill()
    assert word == "interrupted"
    if work in ("long members", "slow members"):
        assert int(done) == 0  # within a member, or a block


KEPT = """ss.run_ensemble(BLOCK, Delayed({delay}), members={members}, seed=1, threads=2,
            progress=progress, checkpoint={file!r}, checkpoint_every={every})"""


@pytest.mark.slow
@needs_signals
def test_a_run_that_was_broken_off_ends_with_the_same_bits(tmp_path):
    whole = ss.run_ensemble(BLOCK, Delayed(), members=MANY, seed=1)
    file = tmp_path / "run.npz"
    for how, every in ((signal.SIGINT, 3600), (signal.SIGKILL, 0)):
        work = KEPT.format(delay=SLOW.delay, members=MANY, file=str(file), every=every)
        with start(tmp_path, work, wait_for_members=True) as child:
            try:
                if how == signal.SIGKILL:  # which leaves it no time to save
                    waiting_for(lambda: file.exists() and ss.Ensemble.load(file).members, child)
                child.send_signal(how)
                child.wait(timeout=60)
            finally:
                child.kill()
        kept = ss.Ensemble.load(file)
        assert 0 < kept.members < MANY
        assert kept.members % 64 == 0
        again = ss.run_ensemble(BLOCK, Delayed(), members=MANY, seed=1, checkpoint=file)
        assert same_bits(again, whole)
        assert same_bits(ss.Ensemble.load(file), whole)
        file.unlink()


@pytest.mark.filterwarnings("ignore:GaussianExcitation. the spectrum is carried")
def test_a_missing_line_at_zero_frequency_is_remarked():
    def remark(spectrum, **options):
        motions = ss.GaussianExcitation(spectrum, 0.02, 64, **options)
        return ss.run_ensemble(ss.Coulomb(mu=0.1), motions, members=4, seed=1)

    soil = ss.Spectrum.kanai_tajimi(s0=0.01, frequency=15, damping=0.6)
    e = remark(soil)
    assert "no line at zero frequency" in e.remark
    assert e.remark in e._repr_html_()
    for other in (
        remark(soil, zero_frequency=True),
        remark(soil, period=256),
        remark(ss.Spectrum.band_pass(s0=0.01, low=2, high=20)),
        ss.run_ensemble(
            ss.Coulomb(mu=0.1), ss.PoissonPulses.event("great near field"), members=2, seed=1
        ),
    ):
        assert other.remark == ""
    both = ss.WithVertical(ss.GaussianExcitation(soil, 0.02, 64), ratio=0.1)
    assert ss.run_ensemble(ss.Coulomb(mu=0.1), both, members=4, seed=1).remark == e.remark
