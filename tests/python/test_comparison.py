"""Theory and simulation side by side."""

import json

import numpy as np
import pytest
import stickslip as ss

# 0.5 pulses a step of the pulse, sigma five times the slip level.
PULSES = ss.PoissonPulses(rate=0.5, half_width=1.0, sigma=5.0, duration=60.0)
BLOCK = ss.Coulomb(slip_level=1.0)


def white(dt=0.1, samples=401):
    return ss.GaussianExcitation(
        ss.Spectrum.white(s0=1.0),
        dt,
        samples,
        interpolation="constant",
        correct_interpolation=False,
        random_amplitudes=True,
        zero_frequency=True,
    )


def test_pulses_bring_all_pulse_theories():
    c = ss.compare(BLOCK, PULSES, [15.0, 30.0, 60.0], members=20_000, seed=1)
    assert list(c.theories) == [
        "Transport",
        "PulseChain",
        "EquivalentLinearization",
        "EquivalentLinearization, laplace",
        "EquivalentLinearization, thesis",
        "PulseSuperposition, renewal",
        "PulseSuperposition, thesis",
        "PulseSuperposition, none",
    ]
    assert c.refused == {}
    # What the chain claims, 4 % (sigma from 1 to 20), and three standard errors: seed fixed, else a
    # false alarm in 370.
    for statistic in ("displacement_variance", "velocity_variance"):
        ratio, error = c.ratio("PulseChain", statistic)
        assert np.all(np.abs(ratio - 1) < 0.04 + 3 * error)


def test_the_statistics_are_those_of_the_ensemble():
    c = ss.compare(BLOCK, PULSES, [20.0, 50.0], members=640, seed=3)
    e = c.ensemble
    at = [int(np.argmin(np.abs(e.time - t))) for t in (20.0, 50.0)]
    np.testing.assert_allclose(e.time[at], [20.0, 50.0], rtol=1e-12)
    value, error = c.simulated("displacement_variance")
    assert np.array_equal(value, e.displacement_variance[at])
    assert np.array_equal(error, e.displacement_variance_error[at])
    ratio, relative = c.ratio("PulseChain", "displacement_variance")
    theory = c.theories["PulseChain"].displacement_variance
    np.testing.assert_allclose(ratio, theory / value, rtol=1e-15)
    np.testing.assert_allclose(relative, ratio * error / value, rtol=1e-14)


def test_progress_is_over_members_and_then_over_theories(capsys):
    theories = [t for t in ss.theory.THEORIES if t.name == "SlowlyVaryingParameters"]
    theories += [t for t in ss.theory.THEORIES if t.name == "EquivalentLinearization"]
    ss.compare(BLOCK, white(), [10.0], members=640, seed=1, progress=True, theories=theories)
    err = capsys.readouterr().err
    assert 0 < err.index("640/640") < err.index("2/2")


def test_white_noise_brings_the_exact_answer_and_linearization():
    # Loads that are held for dt differ from white noise by O(dt) near rest: here by some 1 %; the
    # rest is three standard errors, a false alarm in 370 were the seed not fixed.
    c = ss.compare(BLOCK, white(dt=0.02, samples=1001), [10.0, 20.0], members=20_000, seed=2)
    assert list(c.theories) == [
        "WhiteNoise",
        "Transport",
        "EquivalentLinearization",
        "EquivalentLinearization, laplace",
        "EquivalentLinearization, thesis",
        "StationaryLinearization",
    ]
    ratio, error = c.ratio("WhiteNoise", "velocity_variance")
    assert np.all(np.abs(ratio - 1) < 0.02 + 3 * error)
    # The transport operator predicts the loads as they are held.
    ratio, error = c.ratio("Transport", "velocity_variance")
    assert np.all(np.abs(ratio - 1) < 0.01 + 3 * error)
    # Linearization is 21 % low at last, thesis (3.48), and more than noise and step below it here.
    assert np.all(c.ratio("EquivalentLinearization", "velocity_variance")[0] < 0.95)


@pytest.mark.slow
def test_what_does_not_apply_says_why():
    cart = ss.Caster(slip_level=1.0, reach=2.0)
    c = ss.compare(cart, white(), [20.0, 40.0], members=640, seed=1)
    assert list(c.theories) == [
        "Transport",
        "EquivalentLinearization",
        "EquivalentLinearization, thesis",
    ]
    assert "Coulomb" in c.refused["WhiteNoise"]
    assert "WhiteNoise does not apply: " in str(c)


def test_a_caster_that_escapes_is_left_to_the_simulation():
    cart = ss.Caster.from_geometry(mu=0.5, trail=0.04, wheel_width=0.032, thesis=True)
    quake = ss.PoissonPulses.event("great very near field")
    c = ss.compare(cart, quake, [10.0, 60.0], members=640, seed=1)
    assert list(c.theories) == ["EquivalentLinearization", "EquivalentLinearization, thesis"]
    assert "escapes" in c.refused["PulseSuperposition, renewal"]
    assert "PulseSuperposition, none does not apply: " in str(c)


def test_other_spectra_bring_stationary_linearization():
    band = ss.GaussianExcitation(ss.Spectrum.band_pass(s0=1.0, low=2.0, high=4.0), 0.1, 1024)
    c = ss.compare(BLOCK, band, members=640, seed=1)
    assert list(c.theories) == [
        "EquivalentLinearization",
        "EquivalentLinearization, laplace",
        "EquivalentLinearization, thesis",
        "StationaryLinearization",
    ]
    assert "(misfit 12.6 % of its variance)" in c.theories["EquivalentLinearization"].remark
    assert len(c.time) == 12 and c.time[-1] == pytest.approx(band.duration)


def test_an_envelope_leaves_linearization_in_time():
    fading = ss.GaussianExcitation(
        ss.Spectrum.kanai_tajimi(s0=0.1, frequency=15, damping=0.6),
        0.02,
        1024,
        zero_frequency=True,
        envelope=ss.Envelope(build_up=4, strong_duration=10, decay_rate=0.5),
    )
    cart = ss.Slider(ss.Caster(slip_level=0.5, reach=0.3), natural_frequency=2.0)
    c = ss.compare(cart, fading, [4.0, 12.0], members=640, seed=1)
    assert list(c.theories) == ["EquivalentLinearization", "EquivalentLinearization, thesis"]
    with pytest.raises(ValueError, match="envelope must be None"):
        ss.compare(BLOCK, fading, members=64, theories=[ss.theory.StationaryLinearization()])


def test_the_table_has_theory_over_simulation():
    c = ss.compare(BLOCK, PULSES, [30.0, 60.0], members=640, seed=1)
    text = str(c)
    assert text.startswith("640 members; theory / simulation\n")
    assert "t = 30 s" in text and "growth rate [m^2/s]" in text
    ratio = c.ratio("PulseChain", "displacement_variance")[0]
    row = next(line for line in text.splitlines() if line.startswith("  PulseChain"))
    assert row.split()[1:] == [f"{r:.3f}" for r in ratio]


def test_it_draws_itself():
    pytest.importorskip("matplotlib")
    c = ss.compare(BLOCK, PULSES, [30.0, 60.0], members=640, seed=1)
    way, speed = c.plot().axes
    assert [line.get_label() for line in way.lines] == ["simulation", *c.theories]
    np.testing.assert_array_equal(speed.lines[1].get_xdata(), [30.0, 60.0])


@pytest.mark.parametrize(
    ("times", "message"),
    [
        ([], "row of finite numbers"),
        ([1.0, float("nan")], "row of finite numbers"),
        ([0.0, 1.0], "must increase, from above 0"),
        ([2.0, 1.0], "must increase"),
        ([30.0, 61.0], "duration of 60 s"),
        ([1.0, 3.14159265358979], "common step"),
    ],
)
def test_times_out_of_range_are_named(times, message):
    with pytest.raises(ValueError, match=message):
        ss.compare(BLOCK, PULSES, times, members=64)


def test_other_excitations_are_refused():
    with pytest.raises(TypeError, match="GaussianExcitation or PoissonPulses, got GroundMotion"):
        ss.compare(BLOCK, PULSES.sample(seed=1, member=0))
    periodic = ss.GaussianExcitation(ss.Spectrum.white(s0=1.0), 0.1, 401)
    with pytest.raises(ValueError, match="zero_frequency must be True"):
        ss.compare(BLOCK, periodic, [20.0])
    with pytest.raises(ValueError, match="multiples of the excitation"):
        ss.compare(BLOCK, white(), [0.25])
    c = ss.compare(BLOCK, PULSES, [60.0], members=64)
    with pytest.raises(ValueError, match="statistic must be one of"):
        c.simulated("peak")
    with pytest.raises(ValueError, match="theory must be one of"):
        c.ratio("Newmark", "covariance")


def test_a_comparison_goes_to_tables():
    pytest.importorskip("pandas")
    pulses = ss.PoissonPulses(rate=3, half_width=1 / 6, sigma=2.5, duration=6)
    c = ss.compare(ss.Coulomb(slip_level=0.5), pulses, [2, 4], members=640)
    frame = c.to_dataframe()
    assert list(dict.fromkeys(frame.source)) == ["simulation", *c.theories]
    assert frame.attrs["units"]["velocity_variance_error"] == "m^2/s^2"
    value, error = c.simulated("covariance")
    simulated = frame[frame.source == "simulation"]
    assert np.array_equal(simulated.covariance, value)
    assert np.array_equal(simulated.covariance_error, error)
    for name, moments in c.theories.items():
        mine = frame[frame.source == name]
        assert np.array_equal(mine.time, c.time)
        assert np.array_equal(
            mine.displacement_variance, moments.displacement_variance, equal_nan=True
        )
    document = json.loads(c.to_json(), parse_constant=pytest.fail)
    assert document["simulation"]["covariance"] == value.tolist()
    assert list(document["theories"]) == list(c.theories)
    assert document["refused"] == c.refused
    assert repr(c).startswith("<Comparison: 640 members, 2 times to 4 s, Transport, PulseChain, ")


def test_no_two_theories_look_alike():
    pytest.importorskip("matplotlib")
    from stickslip.plotting.comparison import _theory_style
    from stickslip.theory import THEORIES

    styles = [_theory_style(i) for i in range(len(THEORIES))]
    for keys in (("color",), ("linestyle", "marker")):  # also in gray
        assert len({tuple(style[key] for key in keys) for style in styles}) == len(styles)


# ---- in the plane

PLANE = ss.PlanarSlider(BLOCK)
IN_PLANE = [
    "WhiteNoise, 2 dimensions",
    "EquivalentLinearization, 2 dimensions",
    "EquivalentLinearization, laplace, 2 dimensions",
]


def scaled_white(dt, samples):
    """White noise with D = pi S0 = 1, so that times are in units of D / a^2."""
    return ss.GaussianExcitation(
        ss.Spectrum.white(s0=1 / np.pi),
        dt,
        samples,
        interpolation="constant",
        correct_interpolation=False,
        random_amplitudes=True,
        zero_frequency=True,
    )


@pytest.fixture(scope="module")
def in_plane():
    pairs = ss.WithTransverse(scaled_white(dt=0.02, samples=501))
    return ss.compare(PLANE, pairs, [5.0, 10.0], members=4_000, seed=2)


def test_the_theories_in_the_plane_agree_with_ensembles_of_pairs(in_plane):
    c = in_plane
    assert list(c.theories) == IN_PLANE
    assert c.refused == {}
    exact, linear, _ = IN_PLANE
    for statistic in ("displacement_variance", "velocity_variance", "covariance"):
        ratio, error = c.ratio(exact, statistic)
        assert ratio.shape == error.shape == (2, 2)
        # Loads that are held for dt differ from white noise by O(dt): here by 1 %. Three standard
        # errors in twelve ratios: a false alarm in 31 were the seed not fixed.
        assert np.all(np.abs(ratio - 1) < 0.02 + 3 * error), statistic
    # (W.18): 8 / (3 pi) of the velocity variance at last, and near it at 10 D / a^2.
    theory = c.theories[linear].velocity_variance / c.theories[exact].velocity_variance
    assert theory[-1] == pytest.approx(8 / (3 * np.pi), abs=0.03)


def test_a_comparison_in_the_plane_has_both_components(in_plane, tmp_path):
    c, e = in_plane, in_plane.ensemble
    at = [int(np.argmin(np.abs(e.time - t))) for t in c.time]
    value, error = c.simulated("covariance")
    assert np.array_equal(value, e.covariance[at])
    assert np.array_equal(error, e.covariance_error[at])
    frame = c.to_dataframe()
    simulated = frame[frame.source == "simulation"]
    assert np.array_equal(simulated.covariance_transverse, value[:, 1])
    assert np.array_equal(simulated.covariance_error_axis, error[:, 0])
    assert frame.attrs["units"]["covariance_transverse"] == "m^2/s"
    exact = frame[frame.source == IN_PLANE[0]]
    assert np.array_equal(exact.covariance_axis, c.theories[IN_PLANE[0]].covariance)
    document = json.loads(c.to_json(), parse_constant=pytest.fail)
    growth = document["simulation"]["growth_rate_transverse"]
    assert growth == 2 * value[-1, 1]
    lines = str(c).splitlines()
    rows = [line for line in lines if line.startswith("simulation, ")]
    assert len(rows) == 4
    ratio = c.ratio(IN_PLANE[0], "displacement_variance")[0][:, 1]
    row = next(line for line in lines if line.startswith(f"  {IN_PLANE[0]}, transverse"))
    assert row.split()[-2:] == [f"{one:.3f}" for one in ratio]
    assert "transverse" in c._repr_html_()


def test_a_comparison_in_the_plane_draws_both_components(in_plane):
    pytest.importorskip("matplotlib")
    way, _ = in_plane.plot().axes
    assert [line.get_label() for line in way.lines] == [
        *("simulation, axis", "simulation, transverse"),
        *IN_PLANE,
    ]


def test_theories_of_other_dimensions_than_the_slider_are_refused():
    noise = scaled_white(dt=0.1, samples=101)
    exact, plane = ss.theory.WhiteNoise(), ss.theory.WhiteNoise(dimensions=2)
    everything = [exact, ss.theory.PulseChain(), plane, ss.theory.WhiteNoise(dimensions=3)]
    c = ss.compare(PLANE, ss.WithTransverse(noise), [10.0], members=64, theories=everything)
    assert list(c.theories) == [plane.name]
    assert c.refused == {
        "WhiteNoise": "WhiteNoise: describes motion in one dimension, and the slider moves in the"
        " plane",
        "PulseChain": "PulseChain: describes motion in one dimension, and the slider moves in the"
        " plane",
        "WhiteNoise, 3 dimensions": "WhiteNoise, 3 dimensions: describes motion in 3 dimensions,"
        " and the slider moves in the plane",
    }
    c = ss.compare(BLOCK, noise, [10.0], members=64, theories=everything)
    assert list(c.theories) == ["WhiteNoise"]
    assert "the slider moves along one axis" in c.refused[plane.name]
    sprung = ss.PlanarSlider(BLOCK, natural_frequency=1.0)
    c = ss.compare(sprung, ss.WithTransverse(noise), [10.0], members=64)
    assert list(c.theories) == IN_PLANE[1:]
    assert "natural_frequency must be 0" in c.refused[plane.name]


def test_pairs_that_no_theory_covers_are_refused():
    noise = scaled_white(dt=0.1, samples=101)
    for options, message in (
        ({"ratio": 0.5}, "got ratio 0.5 and coherence 0"),
        ({"coherence": 0.5}, "got ratio 1 and coherence 0.5"),
        (
            {"transverse": scaled_white(dt=0.05, samples=201)},
            "coherence 0 of different excitations",
        ),
    ):
        with pytest.raises(ValueError, match=f"no theory covers this excitation.*{message}"):
            ss.compare(PLANE, ss.WithTransverse(noise, **options), members=64)
    with pytest.raises(TypeError, match="WithTransverse for a slider in the plane, got Gaussian"):
        ss.compare(PLANE, noise, members=64)


def test_a_theory_of_your_own_may_be_of_the_plane():
    class Mine:
        name = "mine"

        def covers(self, slider, excitation):
            return isinstance(slider, ss.PlanarSlider) and excitation.ratio == 0.5

        def predict(self, slider, excitation, times):
            return ss.Moments(times, displacement_variance=np.full(len(times), 2.0))

    pairs = ss.WithTransverse(scaled_white(dt=0.1, samples=101), ratio=0.5)
    c = ss.compare(PLANE, pairs, [5.0, 10.0], members=64, theories=[Mine()])
    value, _ = c.simulated("displacement_variance")
    np.testing.assert_allclose(c.ratio("mine", "displacement_variance")[0], 2 / value, rtol=1e-15)
