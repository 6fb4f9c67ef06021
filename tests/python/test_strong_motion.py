"""Strong motion of a record: known motions, pulses and back, real records, rejected arguments."""

import math

import numpy as np
import pytest
import stickslip as ss


def pulses_like(s):
    return ss.PoissonPulses.from_earthquake(
        rms_acceleration=s.rms_acceleration,
        center_frequency_hz=s.center_frequency_hz,
        duration=s.duration,
    )


def test_it_says_what_numpy_says():
    n = np.random.default_rng(3).standard_normal(20_001)
    dt = 0.01
    s = ss.strong_motion(ss.GroundMotion(n, dt))
    fine = 50  # of the trapezoidal rule, between straight lines
    t = np.arange((len(n) - 1) * fine + 1) * dt / fine
    a = np.interp(t, np.arange(len(n)) * dt, n)
    husid = np.concatenate([[0], np.cumsum((a[1:] ** 2 + a[:-1] ** 2) / 2)]) * dt / fine
    assert s.arias_intensity == pytest.approx(
        math.pi / (2 * ss.STANDARD_GRAVITY) * husid[-1], rel=1e-3
    )
    begin, end = np.interp([0.05 * husid[-1], 0.95 * husid[-1]], husid, t)
    assert s.begin == pytest.approx(begin, abs=1e-3)
    assert s.end == pytest.approx(end, abs=1e-3)
    assert s.duration == s.end - s.begin
    assert s.rms_acceleration == pytest.approx(math.sqrt(0.9 * husid[-1] / (end - begin)), rel=1e-3)
    inside = (t >= begin) & (t <= end)
    v = np.cumsum(a)[inside] * dt / fine
    v -= np.polyval(np.polyfit(t[inside], v, 1), t[inside])
    assert s.rms_velocity == pytest.approx(v.std(), rel=1e-2)
    raw = s.rms_acceleration / (2 * math.sqrt(3) * s.rms_velocity)
    assert s.center_frequency_hz == pytest.approx(raw / math.sqrt(1 + 1.5 / (raw * s.duration)))


@pytest.mark.parametrize("name", ss.PoissonPulses.events())
def test_pulses_give_back_what_made_them(name):
    # 200 motions, fixed seed; the mean scatters by 0.5 % at most, and is off by 1 % at most.
    event = ss.PoissonPulses.event(name, stationary_start=True)
    found = [ss.strong_motion(event.sample(seed=2, member=i)) for i in range(200)]
    ratio = np.array([s.center_frequency_hz for s in found]) * 2 * event.half_width
    assert ratio.mean() == pytest.approx(1, abs=0.025)
    assert 0.02 < ratio.std() < 0.09
    rms = np.mean([s.rms_acceleration for s in found])
    assert 1 < rms / math.sqrt(event.variance) < 1.06


def test_it_shows_what_it_found():
    s = ss.strong_motion(ss.PoissonPulses.event("great near field").sample(seed=1, member=0))
    assert "Hz" in repr(s)
    with pytest.raises(TypeError):
        ss.strong_motion([1, 2, 3])
    with pytest.raises(ValueError, match="zeros only"):
        ss.strong_motion(ss.GroundMotion([0, 0], 0.1))
    with pytest.raises(ValueError, match="straight line over the strong part"):
        ss.strong_motion(ss.GroundMotion([1, 1], 0.1))


def check_record(record):
    s = ss.strong_motion(record)
    assert 0 < s.rms_acceleration < record.peak_acceleration
    assert record.time[0] <= s.begin < s.end <= record.time[-1]
    assert 0.1 < s.center_frequency_hz < 30
    pulses = pulses_like(s)  # of 90 % of its intensity
    assert pulses.variance * pulses.duration * math.pi / (2 * ss.STANDARD_GRAVITY) == pytest.approx(
        0.9 * s.arias_intensity, rel=1e-12
    )
    assert ss.strong_motion(record.scaled(-2)).center_frequency_hz == pytest.approx(
        s.center_frequency_hz, rel=1e-9
    )


def test_records_have_strong_motion(pyslammer_files):
    for file in pyslammer_files:
        check_record(ss.read_record(file))


def test_records_of_agencies_have_strong_motion(agency_files):
    check_record(
        ss.read_record(agency_files / "geonet/20161113_110259_WTMC_20.V2A", component="N28W")
    )
    check_record(ss.read_record(agency_files / "smc/0111a.smc"))
    check_record(ss.read_record(agency_files / "cosmos/akbmr_bnz.v2c"))


def test_intensity_measures_are_what_numpy_says():
    n = np.random.default_rng(4).standard_normal(2001)
    dt, fine = 0.01, 200  # of the trapezoidal rule, between straight lines
    motion = ss.GroundMotion(n, dt)
    s = ss.strong_motion(motion)
    t = np.arange((len(n) - 1) * fine + 1) * dt / fine
    a = np.interp(t, motion.time, n)

    def integral(y):
        return np.concatenate([[0], np.cumsum((y[1:] + y[:-1]) / 2)]) * dt / fine

    v = integral(a)
    assert s.peak_acceleration == np.abs(n).max() == motion.peak_acceleration
    assert s.peak_velocity == pytest.approx(np.abs(v).max(), rel=1e-4)
    assert s.peak_displacement == pytest.approx(np.abs(integral(v)).max(), rel=1e-4)
    assert s.cumulative_absolute_velocity == pytest.approx(integral(np.abs(a))[-1], rel=1e-4)
    husid = integral(a**2)
    begin, end = np.interp([0.05 * husid[-1], 0.75 * husid[-1]], husid, t)
    assert s.duration_5_75 == pytest.approx(end - begin, abs=1e-3)
    assert 0 < s.duration_5_75 < s.duration


def test_the_mean_period_is_that_of_rathje_and_others():
    # Rathje, Abrahamson & Bray (1998), with NumPy's FFT; 10 s with zeros up to 20 s.
    n = np.random.default_rng(4).standard_normal(1001)
    f = np.fft.rfftfreq(2000, 0.01)
    power = np.abs(np.fft.rfft(n, 2000)) ** 2
    band = (f >= 0.25) & (f <= 20)
    expected = (power[band] / f[band]).sum() / power[band].sum()
    assert ss.strong_motion(ss.GroundMotion(n, 0.01)).mean_period == pytest.approx(
        expected, rel=1e-9
    )
    steps = ss.GroundMotion(np.resize([3.0, -3.0, 1.0], 20), 3.0, interpolation="constant")
    assert math.isnan(ss.strong_motion(steps).mean_period)  # up to 1 / 6 Hz
