"""Pulses by a spectrum and fitted to one: round trips, known parameters, records, refusals."""

import math

import numpy as np
import pytest
import stickslip as ss

SOIL = ss.Spectrum.clough_penzien(
    s0=0.05, frequency=15, damping=0.6, filter_frequency=1.5, filter_damping=0.6
)


def test_pulses_by_a_spectrum_have_it():
    pulses = ss.PoissonPulses.from_spectrum(SOIL, rate=3, duration=20, dt=0.02)
    omega = np.linspace(0.01, math.pi / 0.02, 5000)
    asked = SOIL(omega)
    assert np.abs(pulses.density(omega) - asked).sum() < 1.05e-3 * asked.sum()
    times, values = pulses.shape
    assert times == pytest.approx(0.02 * np.arange(len(times)), rel=1e-13)
    assert np.abs(values).max() == 1
    assert abs(values.sum()) < 1e-12  # no velocity is left
    # The autocorrelation of the pulse, by NumPy, is the transform of the spectrum.
    lag = 25  # pieces of 0.02 s
    correlation = pulses.rate * pulses.sigma**2 * 0.02 * (values[lag:] * values[:-lag]).sum()
    fine = np.arange(0.005, 2000, 0.01)
    expected = 2 * 0.01 * (SOIL(fine) * np.cos(fine * lag * 0.02)).sum()
    assert correlation == pytest.approx(expected, abs=2e-2 * pulses.variance)
    wilder = ss.PoissonPulses.from_spectrum(SOIL, rate=3, duration=20, dt=0.02, tolerance=1e-2)
    assert len(wilder.shape[1]) < len(values)


def test_pulses_by_a_spectrum_start_and_swell_as_others_do():
    envelope = ss.Envelope(build_up=1, strong_duration=5, decay_rate=1)
    pulses = ss.PoissonPulses.from_spectrum(
        SOIL, rate=3, duration=20, dt=0.05, stationary_start=True, envelope=envelope
    )
    assert pulses.stationary_start
    assert pulses.envelope == envelope
    assert pulses.sample(seed=1, member=2).duration == 20


def test_spectra_that_no_pulse_has_are_refused():
    def of(spectrum, **others):
        return ss.PoissonPulses.from_spectrum(
            spectrum, **{"rate": 1, "duration": 10, "dt": 0.01, **others}
        )

    with pytest.raises(ValueError, match="must reach pi / dt"):
        of(ss.Spectrum.band_pass(s0=1, low=2, high=12))
    with pytest.raises(ValueError, match="no pulse that begins at a time has it"):
        of(ss.Spectrum.band_pass(s0=1, low=2, high=400))
    with pytest.raises(ValueError, match="dt must be positive"):
        of(SOIL, dt=0)
    with pytest.raises(ValueError, match="tolerance must be from 1e-6"):
        of(SOIL, tolerance=1)
    with pytest.raises(TypeError):
        ss.PoissonPulses.from_spectrum(SOIL, 1, 10, 0.01)


@pytest.mark.parametrize("name", ss.PoissonPulses.events())
def test_a_fit_finds_the_pulses_that_made_a_motion(name):
    event = ss.PoissonPulses.event(name, stationary_start=True)
    exact = ss.fit_pulses(ss.Spectrum.from_function(event.density, low=0, high=2000))
    assert exact.half_width == pytest.approx(event.half_width, rel=1e-5)
    assert exact.intensity == pytest.approx(event.rate * event.sigma**2, rel=1e-5)
    assert exact.misfit < 1e-5
    assert exact.half_width_error == 0
    # 100 motions, seed 2: the mean is off by chance by less than four of its standard errors, but
    # once in 16,000 times, and by the order of the variance of one.
    found = [ss.fit_pulses(event.sample(seed=2, member=i)) for i in range(100)]
    ratio = np.array([fit.half_width for fit in found]) / event.half_width
    assert abs(ratio.mean() - 1) < 4 * ratio.std() / 10 + 2 * ratio.var()
    said = np.mean([fit.half_width_error / fit.half_width for fit in found])
    assert ratio.std() == pytest.approx(said, rel=0.4)


def test_a_fit_shows_what_it_found():
    fit = ss.fit_pulses(ss.PoissonPulses.event("great near field").sample(seed=1, member=0))
    assert "misfit" in repr(fit)
    assert fit.center_frequency_hz == pytest.approx(1 / (2 * fit.half_width))
    with pytest.raises(TypeError, match="must be a GroundMotion or a Spectrum"):
        ss.fit_pulses([1, 2, 3])
    with pytest.raises(TypeError, match="must be a GroundMotion or a Spectrum"):
        ss.fit_pulses(None)
    with pytest.raises(ValueError, match="finite variance"):
        ss.fit_pulses(ss.Spectrum.white(s0=1))
    sine = ss.GroundMotion(np.sin(np.arange(10_000) * 0.1), dt=0.01)
    with pytest.raises(ValueError, match="no pulses fit"):
        ss.fit_pulses(sine)
    with pytest.raises(ValueError, match="bandwidth must be finite"):
        ss.estimate_spectrum(sine, 1e-3)


def test_records_have_a_fit(pyslammer_files):
    # What docs/earthquakes.md says of them.
    ratios, misfits = {}, []
    for file in pyslammer_files:
        record = ss.read_record(file)
        fit, strong = ss.fit_pulses(record), ss.strong_motion(record)
        ratios[file.name] = fit.center_frequency_hz / strong.center_frequency_hz
        misfits.append(fit.misfit)
        assert ss.fit_pulses(record.scaled(-3)).half_width == pytest.approx(
            fit.half_width, rel=1e-5
        )
        spectrum = ss.estimate_spectrum(record, 1 / strong.duration)
        assert spectrum.variance == pytest.approx(strong.rms_acceleration**2, rel=0.02)
    assert 0.35 < min(misfits) < 0.36
    assert 0.76 < max(misfits) < 0.78
    landers = next(name for name in ratios if name.startswith("Landers"))
    assert ratios.pop(landers) == pytest.approx(12.6 / 5.3, rel=0.01)
    assert all(1 / 1.8 < ratio < 1.6 for ratio in ratios.values())
