"""The common interface of all theories: name, covers and predict."""

import math

import numpy as np
import pytest
import stickslip as ss
from stickslip import harmonic, theory

BLOCK, SLOPE = ss.Coulomb(slip_level=1.0), ss.Coulomb(slip_level=1.0, backward=1.5)
NEWMARK = ss.Coulomb(slip_level=1.0, backward=math.inf)
SPRUNG, CART = ss.Slider(BLOCK, natural_frequency=2.0), ss.Caster(slip_level=1.0, reach=2.0)
LINER = ss.VelocityDependent(mu_slow=0.03, mu_fast=0.06, rate=50)
WHITE = ss.Spectrum.white(s0=0.7)
BAND = ss.Spectrum.band_pass(s0=1.0, low=2.0, high=4.0)
SOIL = ss.Spectrum.kanai_tajimi(s0=0.02, frequency=15.0, damping=0.6)
FADING = ss.Envelope(build_up=1, strong_duration=2, decay_rate=3)
SHAKING = ss.GaussianExcitation(WHITE, 0.1, 256, zero_frequency=True)
PULSES = ss.PoissonPulses(rate=0.5, half_width=1.0, sigma=5.0, duration=60.0)
HARMONIC = ss.HarmonicMotion(4.0, 3.0, 60.0)
TIMES = np.array([1.0, 2.5, 40.0])


class Sweep:
    """An excitation of the user's own."""

    duration, dt, configuration = 4.0, 0.1, "sweep"

    def sample(self, *, seed, member):
        t = np.arange(401) * 0.01
        return ss.GroundMotion(3.0 * np.sin(5 * t * (1 + t) + member), dt=0.01)


class Mine:
    """A theory of the user's own, right for a block that is dragged along without friction."""

    name = "mine"

    def __init__(self, answer=True):
        self.answer = answer

    def covers(self, slider, excitation):
        return self.answer

    def predict(self, slider, excitation, times):
        return ss.Moments(times, displacement_variance=2 * times, growth_rate=2.0)


@pytest.mark.parametrize(
    ("slider", "excitation", "covering", "refusing"),
    [
        (BLOCK, 0.7, "WTELSs", ""),
        (BLOCK, 1, "WTELSs", ""),
        (BLOCK, np.float64(0.7), "WTELSs", ""),
        (BLOCK, WHITE, "WTELSs", ""),
        (BLOCK, SHAKING, "WTELSs", ""),
        (SPRUNG, SHAKING, "TELSs", "W"),
        (SLOPE, SHAKING, "WTELS", "s"),
        (CART, SHAKING, "TES", "WLs"),
        (BLOCK, BAND, "ELSs", ""),
        (BLOCK, ss.GaussianExcitation(BAND, 0.1, 1024), "ELSs", ""),
        (CART, BAND, "ES", "Ls"),
        (BLOCK, ss.GaussianExcitation(BAND, 0.1, 1024, envelope=FADING), "ELS", ""),
        (BLOCK, ss.GaussianExcitation(WHITE, 0.1, 256), "", ""),
        (BLOCK, math.nan, "", ""),
        (BLOCK, PULSES, "TCELSrtn", ""),
        (CART, PULSES, "ESrtn", "TCL"),
        (SPRUNG, PULSES, "TELS", "Crtn"),
        (BLOCK, HARMONIC, "V", ""),
        (SLOPE, HARMONIC, "", "V"),
        (BLOCK, Sweep(), "", ""),
        (BLOCK, "white", "", ""),
        (ss.ViscousSlider(0.5), PULSES, "ELS", "TCrtn"),
        (ss.Slider(BLOCK, damping=0.3), PULSES, "TELS", "Crtn"),
        (ss.Slider(BLOCK, damping=0.3), SHAKING, "TELS", "Ws"),
        (ss.Slider(CART, damping=0.3), HARMONIC, "", "V"),
        (LINER, SHAKING, "T", "WELSs"),
        (LINER, PULSES, "", "TCELSrtn"),
        (LINER, HARMONIC, "", "V"),
        ("block", HARMONIC, "", "V"),
    ],
)
def test_each_theory_says_what_it_covers(slider, excitation, covering, refusing):
    assert len(theory.THEORIES) == len("WTCELSsrtnV")
    for letter, asked in zip("WTCELSsrtnV", theory.THEORIES):
        answer = asked.covers(slider, excitation)
        assert isinstance(answer, theory.Coverage)
        assert bool(answer) == (letter in covering)
        assert answer.excitation == (letter in covering + refusing)
        assert answer.reason == "" or answer.reason[-1] not in " ."
        assert (answer.reason == "") == bool(answer)


def test_what_takes_laws_of_position_alone_refuses_those_of_the_speed():
    for refusing in [
        lambda: theory.EquivalentLinearization().predict(LINER, 1.0, [1.0]),
        lambda: theory.EquivalentLinearization().stationary(LINER, 1.0),
        lambda: theory.PulseSuperposition().final_rms(LINER, PULSES),
        lambda: theory.PulseSuperposition().distribution(LINER, PULSES, 1.0),
        lambda: theory.pulse_response(LINER, 1.0, 1.0),
        lambda: theory.SlowlyVaryingParameters(LINER),
        lambda: harmonic.orbits(LINER, 2.0, 1.0),
    ]:
        with pytest.raises(ValueError, match="depends on the speed is not covered"):
            refusing()


@pytest.mark.parametrize(
    ("asked", "slider", "excitation", "reason"),
    [
        (theory.WhiteNoise(), CART, 1.0, "covers Coulomb friction without a spring"),
        (theory.WhiteNoise(), SPRUNG, 1.0, "natural_frequency must be 0, got 2 rad/s"),
        (theory.WhiteNoise(dimensions=2), SLOPE, 1.0, "in 2 dimensions the levels must be equal"),
        (theory.EquivalentLinearization(dimensions=2), CART, 1.0, "covers Coulomb friction"),
        (theory.EquivalentLinearization(), NEWMARK, 1.0, "both slip levels must be finite"),
        (theory.EquivalentLinearization("laplace"), CART, BAND, "density is that of Coulomb"),
        (theory.EquivalentLinearization(start="thesis"), BLOCK, BAND, "stationary white noise"),
        (theory.EquivalentLinearization(), BLOCK, HARMONIC, "covers white noise, spectra"),
        (theory.StationaryLinearization(), SLOPE, BAND, "same both ways"),
        (theory.PulseChain(), CART, PULSES, "PulseSuperposition covers other laws"),
        (theory.PulseChain(), ss.ViscousSlider(0.5), PULSES, "damping must be 0, got 0.5"),
        (theory.PulseChain(), ss.Slider(BLOCK, damping=0.3), PULSES, "damping must be 0, got 0.3"),
        (theory.PulseSuperposition(), SPRUNG, PULSES, "natural_frequency must be 0, got 2 rad/s"),
        (theory.SlowlyVaryingParameters(), SLOPE, HARMONIC, "resist both ways alike"),
        (theory.SlowlyVaryingParameters(), BLOCK, PULSES, "covers HarmonicMotion"),
        (theory.EquivalentLinearization(), LINER, 1.0, "depends on the speed is not covered"),
    ],
)
def test_the_reason_names_what_is_in_the_way(asked, slider, excitation, reason):
    assert reason in asked.covers(slider, excitation).reason


def test_every_class_with_a_prediction_is_a_theory():
    kinds = {type(asked) for asked in theory.THEORIES}
    assert kinds == {
        thing
        for thing in (getattr(theory, name) for name in theory.__all__)
        if hasattr(thing, "predict")
    }
    names = [asked.name for asked in theory.THEORIES]
    assert len(set(names)) == len(names)
    assert theory.PulseChain(refined=True).name == "PulseChain, refined"


@pytest.mark.parametrize(
    ("asked", "slider", "excitations", "before"),
    [
        (
            theory.WhiteNoise(),
            SLOPE,
            [0.7, WHITE, SHAKING],
            lambda: theory.WhiteNoise(SLOPE, 0.7).predict(TIMES),
        ),
        (
            theory.EquivalentLinearization("thesis"),
            CART,
            [WHITE, SHAKING],
            lambda: theory.EquivalentLinearization("thesis").predict(CART, 0.7, TIMES),
        ),
        (
            theory.EquivalentLinearization(),
            CART,
            [SOIL, ss.GaussianExcitation(SOIL, 0.02, 256, zero_frequency=True)],
            lambda: theory.EquivalentLinearization().predict(
                CART, theory.ShapingFilter.of(SOIL), TIMES
            ),
        ),
        (
            theory.StationaryLinearization(),
            SPRUNG,
            [BAND, ss.GaussianExcitation(BAND, 0.1, 1024)],
            lambda: theory.StationaryLinearization().predict(SPRUNG, BAND).transient(TIMES),
        ),
        (
            theory.StationaryLinearization(),
            BLOCK,
            [0.7, WHITE, SHAKING],
            lambda: theory.StationaryLinearization().predict(BLOCK, WHITE).transient(TIMES),
        ),
    ],
)
def test_all_ways_to_ask_give_the_same_bits(asked, slider, excitations, before):
    for excitation in excitations:
        assert asked.predict(slider, excitation, TIMES) == before()


def test_harmonic_ground_gives_means_without_scatter():
    moments = theory.SlowlyVaryingParameters().predict(CART, HARMONIC, TIMES)
    amplitude, phase = theory.SlowlyVaryingParameters(CART).transient(4.0, 3.0, 0.0, 0.0, TIMES)
    # The phase of the ground is reduced more exactly than here, to some roundings of omega t.
    np.testing.assert_allclose(
        moments.displacement_mean, amplitude * np.cos(3 * TIMES + phase), atol=1e-13
    )
    np.testing.assert_allclose(
        moments.velocity_mean, -3 * amplitude * np.sin(3 * TIMES + phase), atol=1e-12
    )
    assert not moments.displacement_variance.any() and moments.growth_rate.value == 0


def test_a_stationary_theory_needs_no_times():
    linear = theory.StationaryLinearization()
    same = [linear.predict(BLOCK, noise) for noise in (0.7, WHITE, SHAKING)]
    assert same[0] == same[1] == same[2]
    assert linear.threshold(BLOCK, ss.GaussianExcitation(BAND, 0.1, 1024)) == linear.threshold(
        BLOCK, BAND
    )


def test_moments_are_made_of_what_a_theory_predicts():
    m = ss.Moments([1, 2], velocity_variance=[3, 4], growth_rate=5, remark="roughly")
    assert list(m.velocity_variance) == [3, 4] and m.growth_rate.value == 5
    assert list(m.velocity_variance_error) == [0, 0]
    assert list(m.displacement_mean) == [0, 0] and np.isnan(m.covariance).all()
    assert m.remark == "roughly" and math.isnan(ss.Moments([1]).growth_rate.value)
    with pytest.raises(ValueError, match=r"covariance must have as many .* times, 2, got 1"):
        ss.Moments([1, 2], covariance=[1])


def test_a_theory_of_your_own_is_compared():
    c = ss.compare(BLOCK, PULSES, [20.0, 60.0], members=640, seed=1, theories=[Mine()])
    assert list(c.theories) == ["mine"] and c.refused == {}
    value, _ = c.simulated("displacement_variance")
    np.testing.assert_allclose(
        c.ratio("mine", "displacement_variance")[0], [40 / value[0], 120 / value[1]], rtol=1e-14
    )
    assert np.isnan(c.ratio("mine", "velocity_variance")[0]).all()  # not predicted
    assert str(c).count("  mine") == 2 and "nan" not in str(c)  # variance of x, growth rate
    everything = [Mine(), *theory.THEORIES]
    c = ss.compare(BLOCK, PULSES, [60.0], members=64, theories=everything)
    assert next(iter(c.theories)) == "mine" and len(c.theories) == 9


def test_an_excitation_of_your_own_has_theories_of_your_own():
    c = ss.compare(BLOCK, Sweep(), [2.0, 4.0], members=64, theories=[Mine()])
    assert list(c.theories) == ["mine"]
    with pytest.raises(TypeError, match="GaussianExcitation or PoissonPulses, got Sweep"):
        ss.compare(BLOCK, Sweep(), [2.0, 4.0], members=64)
    with pytest.raises(TypeError, match="GaussianExcitation or PoissonPulses, got Spectrum"):
        ss.compare(BLOCK, WHITE, [2.0])


def test_a_theory_that_refuses_says_why():
    far = theory.Coverage("too far", excitation=True)
    c = ss.compare(BLOCK, PULSES, [60.0], members=64, theories=[Mine(far)])
    assert c.theories == {} and c.refused == {"mine": "too far"}
    c = ss.compare(BLOCK, PULSES, [60.0], members=64, theories=[Mine(answer=False)])
    assert c.refused == {"mine": "mine: does not cover them"}
    other = theory.Coverage("covers waves", excitation=False)
    with pytest.raises(ValueError, match=r"this excitation\. covers waves"):
        ss.compare(BLOCK, PULSES, [60.0], members=64, theories=[Mine(other)])


def test_what_is_no_theory_is_named():
    class Late(Mine):
        def predict(self, slider, excitation, times):
            return ss.Moments(times + 1)

    class Bare(Mine):
        def predict(self, slider, excitation, times):
            return times

    def compare(*theories):
        return ss.compare(BLOCK, PULSES, [60.0], members=64, theories=theories)

    with pytest.raises(TypeError, match="a theory must have `name`, got 'chain'"):
        compare("chain")
    with pytest.raises(TypeError, match="return a bool or a Coverage, got 'no'"):
        compare(Mine("no"))
    with pytest.raises(TypeError, match=r"predict of mine must return Moments, got array\(\[60.\]"):
        compare(Bare())
    with pytest.raises(ValueError, match="different names, got mine, mine"):
        compare(Mine(), Mine())
    assert compare(Late()).refused["mine"].endswith("at other times than requested")


def test_a_caster_that_only_rolls_is_a_block_to_every_theory():
    wheel, block = ss.Caster(slip_level=0.0, reach=0.5, rolling=1.0), ss.Coulomb(slip_level=1.0)
    (a,), (b,) = (theory.SlowlyVaryingParameters(law).response(4.0, 3.0) for law in (wheel, block))
    assert a.amplitude == pytest.approx(b.amplitude, rel=1e-13)
    (a,), (b,) = (ss.harmonic.orbits(law, 4.0, 3.0) for law in (wheel, block))
    assert a.amplitude == pytest.approx(b.amplitude, rel=1e-9)
    rare = ss.PoissonPulses(rate=0.01, half_width=0.1, sigma=5.0, duration=100)
    a, b = (theory.PulseSuperposition().predict(law, rare, [100.0]) for law in (wheel, block))
    assert a.displacement_variance == pytest.approx(b.displacement_variance, rel=1e-6)
    linear = theory.EquivalentLinearization()
    a, b = (linear.predict(law, 1.0, [1.0, 10.0]) for law in (wheel, block))
    assert a.displacement_variance == pytest.approx(b.displacement_variance, rel=1e-5)
