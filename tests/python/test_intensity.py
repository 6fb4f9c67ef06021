"""Tables of a suite: intensity measures, response spectra, RotD50 and RotD100 of stations."""

import math

import numpy as np
import pytest
import stickslip as ss

G = ss.STANDARD_GRAVITY
MEASURES = [
    "peak_acceleration", "peak_velocity", "peak_displacement", "arias_intensity",
    "cumulative_absolute_velocity", "duration_5_75", "duration", "mean_period",
    "rms_acceleration", "rms_velocity", "center_frequency_hz",
]  # fmt: skip


def quake(seed, name="", samples=500, **more):
    n = np.random.default_rng(seed).normal(0, 2, samples)
    return ss.GroundMotion(n - n.mean(), dt=0.02, name=name or f"quake {seed}", **more)


SUITE = ss.Suite([quake(i) for i in range(3)], {"magnitude": [6.0, 7.0, math.nan]})


def test_the_measures_of_a_suite_are_those_of_its_records():
    table = SUITE.intensity_measures()
    for i, motion in enumerate(SUITE):
        one = ss.strong_motion(motion)
        for name in MEASURES:
            assert getattr(table, name)[i] == getattr(one, name)
    again = ss.strong_motion(SUITE)
    assert np.array_equal(again.arias_intensity, table.arias_intensity)
    assert len(table) == 3
    with pytest.raises(TypeError, match="must be a GroundMotion or a Suite, got 'x'"):
        ss.strong_motion("x")


def test_a_record_without_measures_does_not_end_the_table():
    still = ss.GroundMotion(np.zeros(10), dt=0.1, name="still")
    with pytest.warns(RuntimeWarning, match="NaN for 1 of 4 records, the first is 'still'"):
        table = ss.Suite([*SUITE, still]).intensity_measures()
    assert np.isnan(table.arias_intensity).tolist() == [False, False, False, True]
    assert table.peak_acceleration[3] == 0


def test_the_spectra_of_a_suite_are_those_of_its_records():
    periods = [0.0, 0.2, 1.0]
    for damping in (0.05, [0.02, 0.05]):
        spectra = ss.response_spectrum(SUITE, periods, damping, kind="displacement")
        each = [ss.response_spectrum(m, periods, damping, kind="displacement") for m in SUITE]
        assert np.array_equal(spectra.values, [one.values for one in each])
        assert list(spectra) == each
    assert spectra.values.shape == (3, 2, 3)
    assert np.array_equal(spectra.quantile(0.5), np.median(spectra.values, axis=0))
    with pytest.raises(ValueError, match="periods"):
        ss.response_spectrum(SUITE, [-1.0])
    with pytest.raises(TypeError, match="a Suite, or the response of a slider"):
        ss.response_spectrum(3, [1.0])


def test_the_frame_of_a_suite_has_its_metadata():
    pytest.importorskip("pandas")
    frame = SUITE.to_dataframe()
    assert list(frame.columns) == ["record", "pga_g", "duration", "magnitude"]
    assert frame.pga_g.tolist() == SUITE.pga_g.tolist()
    assert frame.attrs["units"] == {"pga_g": "g", "duration": "s"}
    measures = SUITE.intensity_measures().to_dataframe()
    assert measures.query("magnitude > 6.5").record.tolist() == ["quake 1"]
    assert measures.attrs["units"]["arias_intensity"] == "m/s"


def test_names_in_a_notebook_are_escaped():
    suite = ss.Suite([ss.GroundMotion([0, 1], dt=1, name="<script>x")] * 30)
    page = suite._repr_html_()
    assert "&lt;script&gt;x" in page and "<script" not in page
    assert page.count("<tr>") == 21 and "the first 20" in page


# ---- RotD


def test_rotd_of_one_direction_is_that_of_a_cosine():
    """All motion along 40 degrees: at each angle a, |cos(a - 40)| times the spectrum along it."""
    n = quake(3)
    a = math.radians(40)
    station = ss.GroundMotion(
        math.cos(a) * n.acceleration, dt=n.dt, transverse=math.sin(a) * n.acceleration
    )
    periods = [0.0, 0.1, 0.7, 3.0]
    full = ss.response_spectrum(n, periods).values
    found = ss.rotd(station, periods)
    assert found.rotd100 == pytest.approx(full, rel=1e-12)
    assert found.angle100.tolist() == [40.0] * 4
    cosines = np.abs(np.cos(np.radians(np.arange(180) - 40)))
    assert found.rotd50 == pytest.approx(np.median(cosines) * full, rel=1e-12)
    assert np.median(cosines) == pytest.approx(math.sqrt(0.5), abs=0.01)
    assert found.rotd00 == pytest.approx(0 * full, abs=1e-12 * full.max())
    assert found.percentile(84) == pytest.approx(np.percentile(cosines, 84) * full, rel=1e-12)


def test_rotd_does_not_depend_on_how_the_station_is_turned():
    station = quake(1, transverse=quake(2).acceleration)
    periods = [0.0, 0.15, 1.0]
    one, other = ss.rotd(station, periods), ss.rotd(station.rotated(17), periods)
    for name in ("rotd00", "rotd50", "rotd100"):
        assert getattr(one, name) == pytest.approx(getattr(other, name), rel=1e-9)
    assert ((one.angle100 - other.angle100) % 180).tolist() == [17.0] * 3
    # A peak of a vector: independent of the rotation of the axes, and never below a component.
    vector = np.hypot(station.acceleration, station.transverse).max()
    assert vector * math.cos(math.radians(0.5)) <= one.rotd100[0] <= vector
    assert ss.rotd(station).rotd100.tolist() == one.rotd100[:1].tolist()


def test_rotd_needs_two_horizontal_components():
    with pytest.raises(ValueError, match="rotd: 'quake 1' needs a transverse component"):
        ss.rotd(quake(1))
    with pytest.raises(TypeError, match="a PlanarResponse or a CartResponse, got Suite"):
        ss.rotd(SUITE)
    with pytest.raises(ValueError, match="damping must be one number"):
        ss.rotd(quake(1, transverse=quake(2).acceleration), 1.0, [0.02, 0.05])


# ---- scaling to a spectral acceleration


def test_a_motion_is_scaled_to_a_spectral_acceleration_as_a_suite_is():
    for motion, of_suite in zip(SUITE, SUITE.scaled_to(sa_g=0.5, period=0.6, damping=0.02)):
        scaled = motion.scaled_to(sa_g=0.5, period=0.6, damping=0.02)
        assert scaled == of_suite
        sa = ss.response_spectrum(scaled, 0.6, 0.02).values
        assert sa == pytest.approx([0.5 * G], rel=1e-12)
    assert SUITE[0].scaled_to(sa_g=0.3, period=0).peak_acceleration == pytest.approx(0.3 * G)
    for given, said in [
        ({"sa_g": 1}, "sa_g and period together"),
        ({"period": 1}, "sa_g and period together"),
        ({"sa_g": -1, "period": 1}, "positive and finite sa_g, got -1"),
        ({"sa_g": 1, "period": 1, "pga_g": 1}, "got several"),
        ({"sa_g": 1, "period": -1}, "got -1"),
    ]:
        with pytest.raises(ValueError, match=said):
            SUITE[0].scaled_to(**given)
