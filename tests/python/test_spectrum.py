"""Spectra and envelopes: values, integrals, rejected arguments, and that they keep their data."""

import json
import math

import numpy as np
import pytest
import stickslip as ss
from scipy.integrate import quad

INF, NAN = math.inf, math.nan


def decaying(omega):
    return math.exp(-omega)


SPECTRA = {
    "white": ss.Spectrum.white(s0=1.5),
    "band_pass": ss.Spectrum.band_pass(s0=1.5, low=2.0, high=5.0),
    "kanai_tajimi": ss.Spectrum.kanai_tajimi(s0=2.0, frequency=15.0, damping=0.6),
    "clough_penzien": ss.Spectrum.clough_penzien(
        s0=2.0, frequency=15.0, damping=0.6, filter_frequency=1.5, filter_damping=0.6
    ),
    "from_table": ss.Spectrum.from_table([0.0, 1.0, 4.0], [1.0, 3.0, 0.0]),
    "from_function": ss.Spectrum.from_function(decaying, low=0.5, high=8.0),
}
each_spectrum = pytest.mark.parametrize("kind", SPECTRA)


@each_spectrum
def test_a_spectrum_is_even_and_takes_arrays_of_any_shape(kind):
    s = SPECTRA[kind]
    omega = np.linspace(-20, 20, 42).reshape(6, 7)
    assert s(omega).shape == (6, 7)
    assert np.array_equal(s(omega), s(-omega))
    assert s(3.0) == s(np.array([3.0]))[0]
    assert isinstance(s(3.0), float)
    assert s([1, 2, 3]).shape == (3,)


@each_spectrum
def test_variance_is_the_integral_over_the_whole_line(kind):
    s = SPECTRA[kind]
    if kind == "white":
        assert s.variance == INF
        assert s.band_variance(high=2.0) == 6.0
        return
    top = min(s.high, 2000.0)
    points = [p for p in (1.0, 1.5, 2.0, 4.0, 5.0, 15.0, 100.0) if s.low < p < top]
    one_side = quad(s, s.low, top, points=points, limit=500, epsabs=0, epsrel=1e-10)[0]
    assert s.band_variance(high=top) == pytest.approx(2 * one_side, rel=1e-9)
    rest = s.band_variance(low=top)
    assert s.variance == pytest.approx(2 * one_side + rest, rel=1e-9)


def test_kanai_tajimi_has_its_closed_form():
    # values: pi S0 wg (1 + 4 z^2) / (2 z)
    assert SPECTRA["kanai_tajimi"].variance == pytest.approx(
        math.pi * 2 * 15 * (1 + 4 * 0.36) / 1.2, rel=1e-14
    )


@each_spectrum
def test_a_spectrum_knows_what_made_it(kind):
    s = SPECTRA[kind]
    assert s.kind == kind
    assert getattr(ss.Spectrum, kind)(**s.parameters) == s
    assert json.loads(s.configuration)["kind"]


def test_a_spectrum_shows_its_numbers():
    assert repr(SPECTRA["band_pass"]) == "Spectrum.band_pass(s0=1.5, low=2, high=5)"
    assert repr(SPECTRA["from_table"]) == "<Spectrum: table of 3 points, 0 to 4 rad/s>"
    assert "decaying" in repr(SPECTRA["from_function"])


def test_a_function_has_no_need_of_edges():
    s = ss.Spectrum.from_function(decaying)
    assert (s.low, s.high) == (0.0, INF)
    assert s.variance == pytest.approx(2, rel=1e-10)
    assert s.parameters["density"] is decaying
    assert ss.Spectrum.from_function(lambda omega: np.float32(0.5), high=2).variance == 2


def test_what_a_function_raises_comes_through():
    def broken(omega):
        raise LookupError("mine")

    with pytest.raises(LookupError, match="mine"):
        ss.Spectrum.from_function(broken, high=1.0)
    with pytest.raises(TypeError):
        ss.Spectrum.from_function(lambda omega: "1", high=1.0)
    with pytest.raises(TypeError):
        ss.Spectrum.from_function(3.0, high=1.0)


REFUSED = [
    (lambda S: S.white(s0=-1), r"s0 must be positive and finite, got -1 m\^2/s\^3"),
    (lambda S: S.band_pass(s0=1, low=2, high=1), "high must be above low = 2 rad/s, got 1 rad/s"),
    (lambda S: S.band_pass(s0=1, low=-1, high=1), "low must be finite and at least 0, got -1"),
    (lambda S: S.band_pass(s0=1, low=0, high=INF), "high must be finite, got inf"),
    (lambda S: S.kanai_tajimi(s0=1, frequency=1, damping=0), "damping .* got 0"),
    (lambda S: S.from_table([0, 1, 1], [1, 1, 1]), r"omega\[2\] must come after 1 rad/s, got 1"),
    (lambda S: S.from_table([0, 1], [1, -1]), r"density\[1\] must be finite .* got -1"),
    (lambda S: S.from_table([0, 1], [1, 1, 1]), "as many density as omega values, got 3 for 2"),
    (lambda S: S.from_table([0, 1], ["1", "1"]), "density must hold real numbers"),
    (lambda S: S.from_function(lambda w: 1 - w, high=3), r"at omega = .* rad/s, got -"),
    (lambda S: S.from_function(lambda w: NAN, high=3), r"at omega = .* rad/s, got nan"),
    (lambda S: S.from_function(lambda w: 1.0), "must be integrable, but its integral from 0 to"),
    (lambda S: S.from_function(lambda w: 1 / w, high=1), "must be integrable"),
    (lambda S: S.white(s0=1).band_variance(low=2, high=1), "end above its beginning, 2 rad/s"),
]


@pytest.mark.parametrize("make, message", REFUSED)
def test_what_is_no_spectrum_is_refused_by_name(make, message):
    with pytest.raises(ValueError, match="^Spectrum: .*" + message):
        make(ss.Spectrum)


def test_a_spectrum_has_no_constructor_and_takes_names():
    with pytest.raises(TypeError):
        ss.Spectrum(1.0)
    with pytest.raises(TypeError):
        ss.Spectrum.band_pass(1.0, 2.0, 3.0)


# ---- envelopes

ENVELOPES = [
    ss.Envelope(build_up=4, strong_duration=10, decay_rate=0.5),
    ss.Envelope(build_up=0, strong_duration=INF, decay_rate=0),
    ss.Envelope.from_table([1, 2, 4], [0.5, 2, 0]),
]


def test_an_envelope_builds_up_stays_and_decays():
    t = np.array([-1, 0, 2, 4, 14, 16])
    assert np.array_equal(ENVELOPES[0](t), [0, 0, 0.25, 1, 1, math.exp(-1)])
    assert np.array_equal(ENVELOPES[2]([0, 1, 1.5, 3, 4, 5]), [0, 0.5, 1.25, 1, 0, 0])
    assert isinstance(ENVELOPES[0](2.0), float)


def test_an_envelope_tells_its_numbers():
    e, table = ENVELOPES[0], ENVELOPES[2]
    assert (e.build_up, e.strong_duration, e.decay_rate, e.table) == (4, 10, 0.5, None)
    assert (table.build_up, table.strong_duration, table.decay_rate) == (None, None, None)
    assert np.array_equal(table.table, [[1, 2, 4], [0.5, 2, 0]])
    assert repr(table) == "<Envelope: table of 3 points, 1 to 4 s>"


@pytest.mark.parametrize(
    "make, message",
    [
        (lambda: ss.Envelope(build_up=-1, strong_duration=1, decay_rate=1), "build_up .* got -1 s"),
        (
            lambda: ss.Envelope(build_up=1, strong_duration=1, decay_rate=INF),
            "decay_rate .* got inf 1/s",
        ),
        (lambda: ss.Envelope.from_table([0, 0], [1, 1]), r"time\[1\] must come after 0 s, got 0 s"),
        (lambda: ss.Envelope.from_table([0, 1], [1, NAN]), r"factor\[1\] .* got nan"),
        (lambda: ss.Envelope.from_table([0], [1]), "at least two points, got 1"),
    ],
)
def test_what_is_no_envelope_is_refused_by_name(make, message):
    with pytest.raises(ValueError, match="^Envelope: .*" + message):
        make()
