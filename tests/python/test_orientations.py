"""Sliding along all directions of a station: rotations, percentiles, tables, pictures."""

import csv
import math
import warnings

import numpy as np
import pytest
import stickslip as ss

G = ss.STANDARD_GRAVITY
BLOCK = ss.Coulomb(mu=0.1)
SHAKING = ss.WithTransverse(
    ss.GaussianExcitation(ss.Spectrum.band_pass(s0=0.2, low=2, high=40), dt=0.02, samples=401)
)
STATION = SHAKING.sample(seed=1, member=0)


def at(degrees, station=STATION):
    """The station with an axis of this azimuth."""
    return ss.GroundMotion(
        station.acceleration,
        dt=station.dt,
        transverse=station.transverse,
        vertical=station.vertical,
        orientation=str(degrees),
        name="north of Nowhere",
    )


@pytest.mark.parametrize(
    "slider",
    [
        BLOCK,
        ss.Slider(BLOCK, period=1.5, damping_ratio=0.05),
        ss.FrictionPendulum(radius=2.2, mu_slow=0.03, mu_fast=0.06, rate=50),
        ss.Slider(ss.Coulomb(mu=0.2), slope_degrees=5, one_way=True),
    ],
    ids=repr,
)
def test_each_direction_is_what_integrate_says(slider):
    lifted = ss.GroundMotion(
        STATION.acceleration,
        dt=STATION.dt,
        transverse=STATION.transverse,
        vertical=1.5 * STATION.acceleration[::-1],
    )
    degrees = [0, 30, 90.5, -45, 200]
    for station in (STATION, lifted):
        for settle in (False, True):
            t = ss.orientations(slider, station, degrees, settle=settle, threads=2)
            for d, peak, residual in zip(degrees, t.peak, t.residual, strict=True):
                r = ss.integrate(slider, station.rotated(d), settle=settle)
                assert (r.peak, r.residual) == (peak, residual)
            assert same(t, ss.orientations(slider, station, degrees, settle=settle, threads=1))


def same(a, b):
    return np.array_equal(a.peak, b.peak) and np.array_equal(a.residual, b.residual)


def test_a_quarter_turn_exchanges_components_and_half_a_turn_mirrors():
    t = ss.orientations(BLOCK, STATION, [0, 90, 180, 270])
    swapped = ss.GroundMotion(STATION.transverse, dt=STATION.dt, transverse=-STATION.acceleration)
    assert t.peak[1] == ss.integrate(BLOCK, swapped).peak == t.peak[3]
    assert t.peak[2] == t.peak[0]
    assert t.residual[2] == -t.residual[0] != 0
    assert t.residual[3] == -t.residual[1]
    assert t.mirrored
    uneven = ss.orientations(ss.Coulomb(mu=0.1, backward=0.2 * G), STATION, [0, 180])
    assert not uneven.mirrored
    assert uneven.peak[0] != uneven.peak[1]


def test_a_pulse_along_one_azimuth():
    # A = 4 m/s^2 along 70 degrees, held for 0.5 s, then -A. At an angle a from there the block
    # accelerates with A cos(a) - mu g to a speed v, is braked with A cos(a) + mu g, turns, and ends
    # on its way back: its peak is where it turns.
    amplitude, level, held = 4.0, 0.1 * G, 0.5
    along = np.array([amplitude, -amplitude, 0.0])
    angle = math.radians(70)
    station = ss.GroundMotion(
        along * math.cos(angle),
        dt=held,
        transverse=along * math.sin(angle),
        interpolation="constant",
    )
    t = ss.orientations(BLOCK, station)
    assert len(t) == 180
    drive = amplitude * np.abs(np.cos(np.radians(t.degrees - 70))) - level
    v = np.maximum(drive, 0) * held
    peak = v**2 / 2 * (1 / np.where(drive > 0, drive, 1) + 1 / (drive + 2 * level))
    # Products of rounded cosines: relative errors of a few 1e-16 of the amplitude in the drive.
    assert t.peak == pytest.approx(peak, rel=1e-9, abs=1e-12 * peak.max())
    assert t.rotd100.peak == pytest.approx(peak.max(), rel=1e-12)
    assert t.rotd100.peak_degrees == 70
    assert t.rotd00.peak == 0
    assert t.rotd50.peak == pytest.approx(np.median(peak), rel=1e-9)
    assert (t.peak == 0).sum() == (drive <= 0).sum()


def test_percentiles_are_those_of_the_directions():
    t = ss.orientations(BLOCK, STATION, range(180))
    assert np.array_equal(t.degrees, np.arange(180))
    for nn, one in ((0, t.rotd00), (50, t.rotd50), (100, t.rotd100), (84, t.percentile(84))):
        assert one.percentile == nn
        assert one.peak == np.percentile(t.peak, nn)
        assert one.residual == np.percentile(np.abs(t.residual), nn)
    assert t.rotd50.peak == np.median(t.peak)
    assert t.peak[t.degrees == t.rotd100.peak_degrees] == t.peak.max()
    assert np.abs(t.residual)[t.degrees == t.rotd100.residual_degrees] == t.rotd100.residual
    near = t.peak[t.degrees == t.rotd50.peak_degrees][0]
    assert abs(near - t.rotd50.peak) == np.abs(t.peak - t.rotd50.peak).min()
    with pytest.raises(ValueError, match="must be from 0 to 100, got 101"):
        t.percentile(101)


def test_directions_are_azimuths_where_the_orientation_is_known():
    assert ss.orientations(BLOCK, STATION, [10]).from_north is False
    t = ss.orientations(BLOCK, at(332), range(180))
    assert t.from_north
    assert np.array_equal(t.angle, t.degrees - 332)
    for d in (0, 62, 179):
        r = ss.integrate(BLOCK, at(332).rotated(d - 332))
        assert float(r.motion.orientation) == d % 360
        assert r.peak == t.peak[d]
    # Turning the instrument changes nothing but round-off: of some 1e-16 in each of 400 samples.
    turned = ss.orientations(BLOCK, at(332).rotated(77), range(180))
    assert turned.from_north
    assert turned.peak == pytest.approx(t.peak, rel=1e-9)
    # A north and an east pulse.
    north, none = [0.0, 5, -5, 0], [0.0] * 4
    for orientation, along, across, azimuth in (
        ("N", north, none, 0),
        ("N", none, north, 90),
        ("E", north, none, 90),
        ("E", none, north, 180),
        ("W", none, north, 0),
    ):
        pulse = ss.GroundMotion(along, dt=0.2, transverse=across, orientation=orientation)
        t = ss.orientations(BLOCK, pulse, range(360))
        assert t.rotd100.peak_degrees % 180 == azimuth % 180
        r = ss.orientations(BLOCK, pulse, [azimuth])
        assert r.residual[0] == ss.integrate(BLOCK, ss.GroundMotion(north, dt=0.2)).residual


def test_sliders_that_differ_by_direction_have_a_whole_turn_by_default():
    assert len(ss.orientations(BLOCK, STATION)) == 180
    for slider in (
        ss.Coulomb(mu=0.1, backward=0.2 * G),
        ss.Slider(BLOCK, slope_degrees=2),
        ss.Slider(BLOCK, one_way=True),
        ss.Slider(BLOCK, stops=ss.Stops(gap=0.05, backward=0.02, restitution=0.5)),
        ss.Law(resist=lambda x, v, direction: 1.0),
    ):
        t = ss.orientations(slider, STATION)
        assert len(t) == 360
        assert not t.mirrored
        half = ss.orientations(slider, STATION, range(180))
        assert np.array_equal(half.peak, t.peak[:180])
    one = ss.orientations(ss.Slider(BLOCK, one_way=True), STATION)
    assert (one.residual >= 0).all()


def test_tables_and_pictures():
    pytest.importorskip("pandas")
    pytest.importorskip("matplotlib")
    t = ss.orientations(BLOCK, at(30), range(0, 180, 5), settle=True)
    frame = t.to_dataframe()
    assert list(frame.columns) == ["degrees", "peak", "residual"]
    assert frame.attrs["units"] == {"peak": "m", "residual": "m"}
    assert "Orientations: 36 rows" in t._repr_html_()
    assert repr(t).startswith("<Orientations: 36 directions, peak ")

    axes = t.plot().axes[0]
    assert axes.name == "polar"
    assert axes.get_theta_direction() == -1  # clockwise
    assert axes.get_theta_offset() == pytest.approx(math.pi / 2)  # from the top
    assert [label.get_text() for label in axes.get_xticklabels()] == ["N", "E", "S", "W"]
    x, y = axes.get_lines()[0].get_data()
    assert len(x) == 73  # the whole turn, closed
    assert y[np.isclose(x, math.radians(215))] == pytest.approx(100 * t.peak[t.degrees == 35])
    unknown = ss.orientations(BLOCK, STATION, range(0, 180, 5)).plot().axes[0]
    assert [label.get_text() for label in unknown.get_xticklabels()][:2] == ["axis", "transverse"]
    from stickslip import plotting

    flat = plotting.new_figure(4, 3).subplots()
    assert t.plot(ax=flat) is flat
    assert flat.get_xlabel() == "azimuth [degrees]"
    for few in ([10], [10, 20], [0, 90, 180, 270]):
        assert ss.orientations(BLOCK, STATION, few).plot().axes


def test_what_cannot_be_integrated_is_refused_or_nan():
    with pytest.raises(ValueError, match="'alone' needs a transverse component, it has none; read"):
        ss.orientations(BLOCK, ss.GroundMotion([0, 1], dt=0.1, name="alone"))
    with pytest.raises(TypeError, match="station must be a GroundMotion, got Suite"):
        ss.orientations(BLOCK, ss.Suite([STATION]))
    with pytest.raises(TypeError, match="slider must be a Slider or friction law, got list"):
        ss.orientations([BLOCK], STATION)
    with pytest.raises(ValueError, match="must be horizontal, got orientation 'up'"):
        ss.orientations(BLOCK, at("up"))
    for degrees, message in (
        ([], "at least one direction"),
        ([0, math.inf], r"degrees\[1\] must be finite"),
    ):
        with pytest.raises(ValueError, match=message):
            ss.orientations(BLOCK, STATION, degrees)
    with pytest.raises(ValueError, match="threads must be from 1 to 65536, got 0"):
        ss.orientations(BLOCK, STATION, threads=0)
    with pytest.raises(ValueError, match="contact"):
        ss.orientations(BLOCK, STATION, contact="hover")
    with pytest.warns(RuntimeWarning, match="2 of 2 directions failed and are NaN; the first, 5 d"):
        t = ss.orientations(ss.Coulomb(mu=0), STATION, [5, 95], settle=True)
    assert [d for d, _ in t.failures] == [5, 95]
    assert np.isnan(t.peak).all()
    assert math.isnan(t.rotd100.peak)
    with pytest.warns(ss.PlausibilityWarning, match="orientations: .* in g"):
        ss.orientations(BLOCK, STATION.scaled(0.05), [0, 90])


def test_progress_is_called_and_may_stop_the_work():
    calls = []
    ss.orientations(BLOCK, STATION, progress=lambda done, total: calls.append((done, total)))
    assert calls[-1] == (180, 180)

    def enough(done, total):
        raise RuntimeError("enough")

    long = ss.GroundMotion(np.tile(STATION.acceleration, 500), dt=0.02).scaled(1)
    long = ss.GroundMotion(long.acceleration, dt=0.02, transverse=long.acceleration[::-1])
    with pytest.raises(RuntimeError, match="enough"):
        ss.orientations(BLOCK, long, progress=enough)


def test_recorded_pairs(agency_files):
    pairs = agency_files / "usgs_pairs"
    if not pairs.exists():
        pytest.skip("no usgs_pairs among the agency files")
    with (pairs / "pairs.csv").open() as stream:
        rows = list(csv.DictReader(stream))
    for first, second in zip(rows[::2], rows[1::2], strict=True):
        azimuths = [float(row["component_deg"]) for row in (first, second)]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ss.PlausibilityWarning)  # some have an offset
            one, other = (
                ss.read_station(
                    [pairs / row["file"] for row in (first, second)],
                    along=along,
                    orientations=azimuths,
                    units="g",
                    dt=float(first["dt_s"]),
                )
                for along in azimuths
            )
        t = ss.orientations(BLOCK, one, range(360), settle=True)
        assert t.from_north
        assert np.array_equal(t.peak[:180], t.peak[180:])
        assert np.array_equal(t.residual[:180], -t.residual[180:])
        # Both instruments are among the directions, and either may be the axis: reading along the
        # second one rounds each sample.
        for azimuth, motion in zip(azimuths, (one, other), strict=True):
            r = ss.integrate(BLOCK, motion, settle=True)
            assert t.peak[int(azimuth) % 360] == pytest.approx(r.peak, rel=1e-9)
        assert t.rotd00.peak < t.rotd50.peak < t.rotd100.peak
        assert t.rotd100.peak >= max(t.peak[int(a) % 360] for a in azimuths)
