"""Stationary linearization: against scipy, its thresholds, ensembles, rejected arguments."""

import math

import numpy as np
import pytest
import stickslip as ss
from scipy.integrate import quad
from scipy.optimize import brentq

INF = math.inf
BAND = 20 / math.pi**2
METHOD = ss.theory.StationaryLinearization()


def block(a=1.0):
    return ss.Coulomb(slip_level=a)


def band(low=BAND, high=2 * BAND, s0=1.0):
    return ss.Spectrum.band_pass(s0=s0, low=low, high=high)


SPECTRA = {
    "band_pass": band(),
    "kanai_tajimi": ss.Spectrum.kanai_tajimi(s0=0.2, frequency=15.0, damping=0.6),
    "clough_penzien": ss.Spectrum.clough_penzien(
        s0=0.2, frequency=15.0, damping=0.6, filter_frequency=1.5, filter_damping=0.6
    ),
    "from_table": ss.Spectrum.from_table([0.5, 1.0, 4.0], [1.0, 3.0, 0.0]),
    "from_function": ss.Spectrum.from_function(lambda w: w * w * math.exp(-w)),
}


@pytest.mark.parametrize("wn", [0.0, 2.5])
@pytest.mark.parametrize("kind", SPECTRA)
def test_it_solves_what_scipy_solves(kind, wn):
    s = SPECTRA[kind]
    top = min(s.high, 4000.0)
    points = [p for p in (0.5, 1, 1.5, 2.5, 4, 15, 60, 300) if s.low < p < top]

    def over(f):
        return 2 * quad(f, s.low, top, points=points, limit=800, epsabs=0, epsrel=1e-10)[0]

    def gain(w, zeta):
        return w**2 / ((w**2 - wn**2) ** 2 + zeta**2 * w**2)

    def excess(log_zeta):
        zeta = math.exp(log_zeta)
        return math.log(zeta**2 * over(lambda w: s(w) * gain(w, zeta)) * math.pi / 2 / 0.16)

    p = METHOD.predict(ss.Slider(block(0.4), wn), s)
    # Above 4000 rad/s there are 1e-7 of Kanai and Tajimi's velocity.
    assert p.damping == pytest.approx(math.exp(brentq(excess, -9, 6)), rel=1e-6)
    assert p.velocity_std == pytest.approx(math.sqrt(2 / math.pi) * 0.4 / p.damping, rel=1e-12)
    assert p.velocity_std**2 == pytest.approx(over(p.velocity_spectrum), rel=1e-6)
    if kind != "kanai_tajimi" or wn:
        assert p.displacement_std**2 == pytest.approx(
            over(lambda w: p.velocity_spectrum(w) / w**2), rel=1e-6
        )
        assert p.growth_rate == 0
    else:
        assert p.displacement_std == INF
        assert p.growth_rate == pytest.approx(2 * math.pi * s(0) / p.damping**2)


def test_the_case_of_figures_4_4_to_4_6():
    # values: eql.O1_2.0264237.dO_2.0264237 and eql.fig44.linear_transient
    p = METHOD.predict(block(), band())
    assert p.damping == pytest.approx(1.253278653954749998, rel=1e-13)
    assert p.velocity_std == pytest.approx(0.63663779661859079, rel=1e-13)
    assert p.displacement_std == pytest.approx(0.23692943741085953, rel=1e-13)
    assert p.spectrum == band()
    assert p.natural_frequency == 0
    m = p.transient([1.0, 0.5, 0.0, 51.2])
    assert isinstance(m, ss.Moments)
    assert np.sqrt(m.velocity_variance) == pytest.approx(
        [0.7904907371388612, 0.6776989844789675, 0, 0.6366377967539384], rel=1e-8
    )
    assert m.time.tolist() == [1.0, 0.5, 0.0, 51.2]
    assert m.growth_rate.value == 0
    assert m.remark == p.remark
    assert not m.displacement_mean.any()


def test_below_the_threshold_it_predicts_no_motion_and_says_so():
    assert METHOD.threshold(block(), band()) == pytest.approx(
        math.sqrt(2 / math.pi) / math.sqrt(2 * BAND)
    )
    # 10 % below and above: the ground acceleration scales with the root of s0.
    at = METHOD.threshold(block(), band()) ** 2
    below, above = (METHOD.predict(block(), band(s0=f * at)) for f in (0.81, 1.21))
    assert (below.damping, below.velocity_std, below.displacement_std) == (INF, 0, 0)
    assert below.growth_rate == 0
    assert "no motion is predicted" in below.remark
    assert below.velocity_spectrum(3.0) == 0
    assert not below.transient([1, 2]).displacement_variance.any()
    assert above.velocity_std > 0
    assert "near sqrt(2/pi)" in above.remark
    # A simulation moves all the same.
    shaking = ss.GaussianExcitation(band(s0=0.81 * at), dt=0.1, samples=512, period=4096)
    e = ss.run_ensemble(block(), shaking, members=200, seed=1)
    assert e.stationary.velocity_variance.value > 10 * e.stationary.velocity_variance.error


def test_arrays_go_in_and_come_out():
    p = METHOD.predict(block(), band())
    omega = np.linspace(-5, 5, 20).reshape(4, 5)
    assert p.velocity_spectrum(omega).shape == (4, 5)
    assert p.velocity_spectrum(omega) == pytest.approx(
        band()(omega) / (omega**2 + p.damping**2), rel=1e-14
    )
    assert isinstance(p.velocity_spectrum(3), float)
    assert p.transient(np.array([])).time.shape == (0,)
    assert "damping" in repr(p)


def test_what_is_not_covered_is_refused():
    with pytest.raises(TypeError, match="covers Coulomb friction"):
        METHOD.predict(ss.Caster(slip_level=1.0, reach=1.0), band())
    with pytest.raises(ValueError, match="same both ways"):
        METHOD.predict(ss.Coulomb(slip_level=1.0, backward=2.0), band())
    with pytest.raises(ValueError, match="same both ways"):
        METHOD.threshold(ss.Coulomb(slip_level=4.0, backward=5.7), band())
    envelope = ss.Envelope(build_up=1, strong_duration=2, decay_rate=3)
    with pytest.raises(ValueError, match="envelope must be None"):
        METHOD.predict(block(), ss.GaussianExcitation(band(), 0.1, 1024, envelope=envelope))
    with pytest.raises(TypeError):
        METHOD.predict(block(), ss.PoissonPulses.event("great near field"))
    p = METHOD.predict(block(), band())
    for times in ([-1.0], [math.nan], [INF], [[1.0]], ["a"]):
        with pytest.raises(ValueError, match="StationaryPrediction: times"):
            p.transient(times)

    def fails(omega):
        if calls and omega < 1:
            raise KeyError("mine")
        return 1.0

    calls = []
    spectrum = ss.Spectrum.from_function(fails, high=4.0)
    calls.append(1)
    with pytest.raises(KeyError, match="mine"):
        METHOD.predict(block(), spectrum)
