"""Coulomb friction under white noise: the door to the exact figures, and what they are in SciPy."""

import math

import numpy as np
import pytest
import stickslip as ss
from scipy.integrate import quad
from scipy.special import erfc, kv
from scipy.stats import gamma

NAN, INF = math.nan, math.inf
WhiteNoise = ss.theory.WhiteNoise


def test_a_number_a_spectrum_a_law_and_a_slider_say_the_same():
    noise = WhiteNoise.coulomb(0.7, 0.3)
    for other in (
        WhiteNoise.coulomb(0.7, ss.Spectrum.white(s0=0.3)),
        WhiteNoise(ss.Coulomb(slip_level=0.7), 0.3),
        WhiteNoise(ss.Slider(ss.Coulomb(slip_level=0.7)), ss.Spectrum.white(s0=0.3)),
    ):
        assert other.variance == noise.variance == pytest.approx(2 * (math.pi * 0.3 / 0.7) ** 2)
        assert other.growth_rate == pytest.approx(10 * (0.3 * math.pi) ** 3 / 0.7**4)
        assert other.s0 == 0.3
        assert other.law == ss.Coulomb(slip_level=0.7)
    assert repr(noise) == "WhiteNoise(Coulomb(slip_level=0.7), s0=0.3)"


def test_the_transition_density_is_the_published_one():
    a, s0, t, start = 1.3, 0.4, 2.0, 0.8
    d = math.pi * s0
    noise = WhiteNoise.coulomb(a, s0)
    v = np.linspace(0, 9, 50)
    root = math.sqrt(4 * math.pi * d * t)
    tail = a / (4 * d) * np.exp(-a * v / d) * erfc((v + start - a * t) / math.sqrt(4 * d * t))
    same = np.exp(-((v - start + a * t) ** 2) / (4 * d * t)) / root + tail
    beyond = np.exp(a * start / d - (v + start + a * t) ** 2 / (4 * d * t)) / root + tail
    assert noise.transition_density(v, t, start) == pytest.approx(same, rel=1e-12)
    assert noise.transition_density(-v[1:], t, start) == pytest.approx(beyond[1:], rel=1e-12)
    assert quad(noise.transition_density, 0, INF, args=(t, start))[0] + quad(
        noise.transition_density, -INF, 0, args=(t, start)
    )[0] == pytest.approx(1, rel=1e-9)


def test_figures_take_arrays_of_any_shape():
    noise = WhiteNoise.coulomb(1, 1)
    assert isinstance(noise.density(0.5), float)
    assert noise.density([[0.5, 1, 2]]).shape == (1, 3)
    assert noise.transition_density([[0.0], [1.0]], [1.0, 2.0, 3.0]).shape == (2, 3)
    assert noise.absolute_moment(2, [1.0, 2.0]).shape == (2,)
    assert noise.velocity_spectrum(np.zeros(4)).shape == (4,)
    assert math.isnan(noise.density(NAN))


def test_predictions_come_as_moments():
    noise = WhiteNoise(ss.Coulomb(slip_level=1, backward=2), 1.0)
    m = noise.predict([0, 1, 50, 500])
    assert isinstance(m, ss.Moments)
    assert m.time.tolist() == [0, 1, 50, 500]
    assert m.displacement_variance[0] == 0
    assert m.velocity_mean[-1] == pytest.approx(noise.mean) == math.pi / 2
    assert m.velocity_variance[-1] == pytest.approx(noise.variance)
    assert m.growth_rate.value == noise.growth_rate
    assert m.growth_rate.error == 0
    assert not m.displacement_variance_error.any()
    assert noise.absolute_moment(2, 50) == pytest.approx(
        m.velocity_variance[2] + m.velocity_mean[2] ** 2, rel=1e-12
    )


def test_a_block_on_a_plane():
    noise = WhiteNoise.coulomb(0.7, 0.3, dimensions=2)
    assert noise == WhiteNoise(ss.Coulomb(slip_level=0.7), 0.3, dimensions=2)
    assert noise != WhiteNoise.coulomb(0.7, 0.3)
    assert noise.dimensions == 2
    assert repr(noise) == "WhiteNoise(Coulomb(slip_level=0.7), s0=0.3, dimensions=2)"
    d, a = 0.3 * math.pi, 0.7
    assert noise.variance == pytest.approx(3 * d**2 / a**2, rel=1e-14)
    assert noise.growth_rate == pytest.approx(21 * d**3 / a**4, rel=1e-14)
    assert noise.mean_speed == pytest.approx(2 * d / a, rel=1e-14)
    assert noise.relaxation_rate == pytest.approx(2 / 9 * a**2 / d, rel=1e-14)
    v = np.linspace(0, 9, 50)
    assert noise.speed_density(v) == pytest.approx(gamma.pdf(v, 2, scale=d / a), rel=1e-12)
    y = a / d * v[1:]
    assert noise.density(v[1:]) == pytest.approx(a / d * y * kv(1, y) / math.pi, rel=1e-12)
    assert noise.velocity_autocovariance(0) == noise.variance
    assert noise.velocity_autocovariance([[0.0, 1.0]]).shape == (1, 2)
    m = noise.predict([0, 1, 500])
    assert m.velocity_variance[-1] == pytest.approx(noise.variance)
    assert m.growth_rate.value == noise.growth_rate
    plane = WhiteNoise(dimensions=2)
    again = plane.predict(ss.Coulomb(slip_level=0.7), 0.3, [0, 1, 500])
    assert again.displacement_variance.tolist() == m.displacement_variance.tolist()
    assert plane.name == "WhiteNoise, 2 dimensions"


@pytest.mark.parametrize(
    ("make", "error", "message"),
    [
        (
            lambda: WhiteNoise.coulomb(1, 1, dimensions=0),
            ValueError,
            "dimensions must be from 1 to 6, got 0",
        ),
        (
            lambda: WhiteNoise(ss.Coulomb(slip_level=1, backward=2), 1, dimensions=2),
            ValueError,
            "in 2 dimensions the levels must be equal",
        ),
        (
            lambda: WhiteNoise(dimensions=3).transition_density(0, 1),
            ValueError,
            "in one dimension only",
        ),
        (lambda: WhiteNoise.coulomb(1, 0), ValueError, "s0 must be positive and finite, got 0"),
        (lambda: WhiteNoise.coulomb(1, NAN), ValueError, "s0 must be positive"),
        (lambda: WhiteNoise.coulomb(-1, 1), ValueError, "slip_level must be finite"),
        (
            lambda: WhiteNoise.coulomb(1, ss.Spectrum.band_pass(s0=1, low=0, high=2)),
            ValueError,
            "white noise only",
        ),
        (lambda: WhiteNoise.coulomb("1", 1), TypeError, "slip_level must be a number, got '1'"),
        (
            lambda: WhiteNoise(ss.Caster(slip_level=1, reach=1), 1),
            TypeError,
            "covers Coulomb friction",
        ),
        (
            lambda: WhiteNoise(ss.Slider(ss.Coulomb(slip_level=1), natural_frequency=1), 1),
            ValueError,
            "natural_frequency must be 0",
        ),
        (lambda: WhiteNoise.coulomb(1, 1).predict([2, 1]), ValueError, "times must increase"),
        (lambda: WhiteNoise.coulomb(1, 1).predict([-1]), ValueError, "at least 0, got -1 s"),
        (lambda: WhiteNoise.coulomb(1, 1).predict([NAN]), ValueError, "times must be finite"),
        (lambda: WhiteNoise.coulomb(1, 1).predict([[1.0]]), ValueError, "one-dimensional"),
        (
            lambda: WhiteNoise.coulomb(1, 1).absolute_moment(0, 1),
            ValueError,
            "order must be from 1",
        ),
        (
            lambda: WhiteNoise(ss.Coulomb(slip_level=1, backward=2), 1).transition_density(0, 1),
            ValueError,
            "equal levels only",
        ),
    ],
)
def test_what_is_not_covered_is_refused(make, error, message):
    with pytest.raises(error, match=message):
        make()
