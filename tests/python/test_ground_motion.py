"""Ground motions: accepted and rejected arguments, and that motions keep their data."""

import math
import pickle
import warnings
from array import array

import numpy as np
import pytest
import stickslip as ss

INF, NAN = math.inf, math.nan
SAMPLES = [0.0, 2.0, -3.0, 1.0]


class Table:
    """Like a column of pandas: no array, but it can become one."""

    def __array__(self, dtype=None, copy=None):
        return np.array(SAMPLES, dtype=dtype)


def test_even_samples_start_at_zero():
    motion = ss.GroundMotion(SAMPLES, dt=0.25)
    assert np.array_equal(motion.acceleration, SAMPLES)
    assert np.array_equal(motion.time, [0, 0.25, 0.5, 0.75])
    assert (motion.dt, motion.duration, len(motion)) == (0.25, 0.75, 4)
    assert motion.interpolation == "linear"
    assert motion.peak_acceleration == 3.0


def test_uneven_samples_keep_their_times():
    t = [-1.0, 0.5, 0.75, 4.0]
    motion = ss.GroundMotion(SAMPLES, times=t)
    assert np.array_equal(motion.time, t)
    assert motion.dt is None
    assert motion.duration == 5.0


def test_values_that_are_held_may_share_a_time_and_the_last_one_does_not_act():
    motion = ss.GroundMotion([1.0, 5.0, 2.0, -9.0], times=[0, 1, 1, 3], interpolation="constant")
    assert motion.interpolation == "constant"
    assert motion.peak_acceleration == 5.0
    assert ss.integrate(ss.Coulomb(slip_level=2.5), motion).peak == 0


def test_steps_are_lines_to_the_limit():
    # Values held, and the same as lines with jumps of a microsecond: x differs by jump * a * T.
    steps = ss.GroundMotion(SAMPLES, times=[0, 1, 2, 3], interpolation="constant")
    e = 1e-6
    lines = ss.GroundMotion([0, 0, 2, 2, -3, -3], times=[0, 1, 1 + e, 2, 2 + e, 3])
    law = ss.Coulomb(slip_level=0.5)
    difference = ss.integrate(law, steps).residual - ss.integrate(law, lines).residual
    assert abs(difference) <= 2 * e * 5 * 3


def test_the_second_argument_is_the_time_step():
    assert ss.GroundMotion(SAMPLES, 0.25).dt == 0.25


def test_a_motion_has_a_name_and_a_summary():
    motion = ss.GroundMotion(SAMPLES, dt=0.25, name="Kobe")
    assert motion.name == "Kobe"
    assert ss.GroundMotion(SAMPLES, dt=0.25).name == ""
    for part in ("Kobe", "4 samples", "dt = 0.25 s", "0.75 s", "peak 3 m/s^2", "linear"):
        assert part in repr(motion)
    assert "uneven" in repr(ss.GroundMotion(SAMPLES, times=[0, 1, 2, 5]))


def test_a_scaled_motion_is_a_new_one():
    motion = ss.GroundMotion(SAMPLES, times=[0, 1, 2, 5], interpolation="constant", name="Kobe")
    mirror = motion.scaled(-2)
    assert np.array_equal(mirror.acceleration, np.multiply(SAMPLES, -2))
    assert np.array_equal(mirror.time, motion.time)
    assert (mirror.interpolation, mirror.name) == ("constant", "Kobe")
    assert np.array_equal(motion.acceleration, SAMPLES)
    with pytest.raises(ValueError, match=r"acceleration\[1\] .* got 2e\+100"):
        motion.scaled(1e100)


# ---- accepted arguments


@pytest.mark.parametrize(
    "samples",
    [
        SAMPLES,
        tuple(SAMPLES),
        [0, 2, -3, 1],
        array("d", SAMPLES),
        memoryview(array("f", SAMPLES)),
        Table(),
        np.array(SAMPLES, dtype=np.float32),
        np.array(SAMPLES, dtype=np.float16),
        np.array(SAMPLES, dtype=np.longdouble),
        np.array(SAMPLES, dtype=np.int8),
        np.array(SAMPLES, dtype=">f8"),
        np.repeat(SAMPLES, 3)[::3],
        np.array(SAMPLES[::-1])[::-1],
        np.array([SAMPLES, SAMPLES]).T[:, 1],
        np.asfortranarray([SAMPLES, SAMPLES])[0],
    ],
    ids=lambda s: getattr(getattr(s, "dtype", None), "str", type(s).__name__),
)
def test_whatever_holds_real_numbers_in_a_row_is_taken(samples):
    motion = ss.GroundMotion(samples, dt=1)
    assert np.array_equal(motion.acceleration, SAMPLES)
    assert motion.acceleration.dtype == np.float64
    sorted_times = np.cumsum(np.abs(np.asarray(samples, dtype=float)) + 1)
    assert np.array_equal(ss.GroundMotion(SAMPLES, times=sorted_times).time, sorted_times)


def test_the_input_is_copied():
    samples, times = np.array(SAMPLES), np.arange(4.0)
    motion = ss.GroundMotion(samples, times=times)
    samples[:], times[:] = 9, 9
    assert np.array_equal(motion.acceleration, SAMPLES)
    assert np.array_equal(motion.time, [0, 1, 2, 3])


def test_the_acceleration_is_a_view_that_cannot_be_written_and_outlives_its_motion():
    motion = ss.GroundMotion(SAMPLES, dt=1)
    view = motion.acceleration
    assert np.shares_memory(view, motion.acceleration)
    assert view.base is motion
    assert view.ctypes.data == motion.acceleration.ctypes.data
    with pytest.raises(ValueError, match="read-only"):
        view[0] = 1
    with pytest.raises(ValueError, match="WRITEABLE"):
        view.setflags(write=True)
    del motion
    assert np.array_equal(view, SAMPLES)


# ---- rejected arguments

REFUSED = [
    (dict(acceleration=[], dt=1), "at least two samples, got 0"),
    (dict(acceleration=[1], dt=1), "at least two samples, got 1"),
    (dict(acceleration=[], times=[]), "at least two samples, got 0"),
    (dict(acceleration=[1, 2, NAN], dt=1), r"acceleration\[2\] must be finite .* got nan m/s\^2"),
    (dict(acceleration=[1, -INF, NAN], dt=1), r"acceleration\[1\] must be finite .* got -inf"),
    (
        dict(acceleration=[None, 2], dt=1),
        "must hold real numbers, got None at index 0",
    ),
    (dict(acceleration=[0, 1e300], dt=1), r"acceleration\[1\] .* at most 1e100 .* got 1e\+300"),
    (dict(acceleration=SAMPLES, dt=0), "dt must be positive and finite, got 0 s"),
    (dict(acceleration=SAMPLES, dt=-0.01), r"dt must be positive and finite, got -0\.01 s"),
    (dict(acceleration=SAMPLES, dt=INF), "dt must be positive and finite, got inf s"),
    (dict(acceleration=SAMPLES, dt=1e308), "duration must be finite, got inf s"),
    (dict(acceleration=SAMPLES), "give either dt or times, got neither"),
    (dict(acceleration=SAMPLES, dt=1, times=[0, 1, 2, 3]), "give either dt or times, got both"),
    (dict(acceleration=SAMPLES, times=[0, 1, 2]), "as many times as samples, got 3 times for 4"),
    (dict(acceleration=SAMPLES, times=[0, 1, 1, 2]), r"increase, times\[2\] .* after 1 s, got 1 s"),
    (dict(acceleration=SAMPLES, times=[0, 3, 2.5, 4]), r"times\[2\] .* after 3 s, got 2\.5 s"),
    (dict(acceleration=SAMPLES, times=[0, NAN, 1, 2]), r"times\[1\] must be finite, got nan s"),
    (dict(acceleration=SAMPLES, times=[0, 1, 2, INF]), r"times\[3\] must be finite, got inf s"),
    (dict(acceleration=SAMPLES, times=[-1e308, 0, 1, 1e308]), "duration .* got inf s"),
    (
        dict(acceleration=SAMPLES, times=[0, 2, 1, 3], interpolation="constant"),
        r"not decrease, times\[2\] must come after 2 s, got 1 s",
    ),
    (
        dict(acceleration=SAMPLES, times=[1, 1, 1, 1], interpolation="constant"),
        "duration must be positive .* got 0 s",
    ),
    (
        dict(acceleration=SAMPLES, dt=1, interpolation="cubic"),
        "'linear' or 'constant', got 'cubic'",
    ),
    (dict(acceleration=5.0, dt=1), "one-dimensional, got 0"),
    (dict(acceleration=[[1, 2], [3, 4]], dt=1), "acceleration must be one-dimensional, got 2"),
    (dict(acceleration=SAMPLES, times=[[0, 1, 2, 3]]), "times must be one-dimensional, got 2"),
]


@pytest.mark.parametrize("arguments, message", REFUSED)
def test_what_is_refused_is_named_with_its_value(arguments, message):
    with pytest.raises(ValueError, match="GroundMotion: .*" + message):
        ss.GroundMotion(**arguments)


@pytest.mark.parametrize(
    "samples",
    [
        ["a", "b"],
        [1j, 2],
        {0: 1.0, 1: 2.0},
        {1.0, 2.0},
        (x for x in SAMPLES),
        [[1, 2], [3]],
        "12",
        b"12",
    ],
)
def test_what_is_no_row_of_numbers_is_refused(samples):
    with pytest.raises((TypeError, ValueError)):
        ss.GroundMotion(samples, dt=1)


@pytest.mark.parametrize(
    "samples",
    [
        np.array([1 + 1j, 2]),
        np.array(["1", "2"]),
        ["1", "2"],
        np.array([1, "2"], dtype=object),
        np.array([0, 1], dtype="datetime64[s]"),
        np.ma.array([1.0, 2.0, 3.0], mask=[False, True, False]),
    ],
    ids=["complex", "strings", "list of strings", "objects", "dates", "masked"],
)
def test_an_array_that_does_not_hold_real_numbers_is_refused(samples):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        with pytest.raises((TypeError, ValueError)):
            ss.GroundMotion(samples, dt=1)


@pytest.mark.parametrize(
    "arguments", [(SAMPLES, "0.1"), (SAMPLES, [0.1]), (SAMPLES, 1, [0, 1, 2, 3]), ()]
)
def test_arguments_of_another_kind_are_a_type_error(arguments):
    with pytest.raises(TypeError):
        ss.GroundMotion(*arguments)


# ---- extremes


@pytest.mark.filterwarnings("ignore::stickslip.PlausibilityWarning")
@pytest.mark.parametrize("power", [-1000, -300, 300])
@pytest.mark.parametrize("natural_frequency", [0.0, 1.3])
def test_displacements_scale_with_accelerations_from_1e_minus_300_to_1e_90(
    record_a, power, natural_frequency
):
    # Powers of two scale without rounding, so nothing but overflow and underflow can change.
    scale = 2.0**power
    one = ss.integrate(
        ss.Slider(ss.Coulomb(slip_level=1.0), natural_frequency), ss.GroundMotion(record_a, dt=0.1)
    )
    other = ss.integrate(
        ss.Slider(ss.Coulomb(slip_level=scale), natural_frequency),
        ss.GroundMotion(record_a * scale, dt=0.1),
    )
    assert np.array_equal(other.displacement, one.displacement * scale)
    assert np.array_equal(other.events["kind"], one.events["kind"])


def test_displacements_scale_with_the_square_of_the_time_step(record_a):
    law = ss.Coulomb(slip_level=1.0)
    one = ss.integrate(law, ss.GroundMotion(record_a, dt=0.1))
    tiny = ss.integrate(law, ss.GroundMotion(record_a, dt=1e-9))
    assert tiny.displacement * 1e16 == pytest.approx(one.displacement, abs=1e-13 * one.peak)
    scaled = ss.integrate(law, ss.GroundMotion(record_a, dt=0.1 * 2.0**-30))
    assert np.array_equal(scaled.displacement * 2.0**60, one.displacement)


def test_a_million_samples_are_no_more_than_a_thousand_thousands():
    # The ground stands still for a while at the end of each thousand, so that all start at rest.
    noise = np.random.default_rng(7).normal(0, 2, 1000)
    noise[-100:] = 0
    noise[0] = 0
    law = ss.Coulomb(slip_level=1.0)
    short = ss.integrate(law, ss.GroundMotion(noise, dt=0.01))
    assert short.at_rest
    long = ss.integrate(law, ss.GroundMotion(np.tile(noise, 1000), dt=0.01))
    # A sum of a thousand equal numbers, each rounded to half a unit of the running total
    assert long.residual == pytest.approx(1000 * short.residual, rel=1000 * 1.2e-16 + 1e-13)
    assert len(long.events) - 1 == 1000 * (len(short.events) - 1)


def test_a_motion_beyond_the_range_of_doubles_is_an_overflow():
    with pytest.raises(OverflowError, match="leaves the range of doubles"):
        ss.integrate(ss.Coulomb(slip_level=1.0), ss.GroundMotion([1e100, 1e100], dt=1e200))


# ---- values


NOISE = ss.GroundMotion(np.random.default_rng(1).standard_normal(500), dt=0.02, name="noise")


def test_factors_scale_a_motion():
    two = NOISE.scaled(2)
    for product in (2 * NOISE, NOISE * 2, np.float64(2) * NOISE, np.int64(2) * NOISE, NOISE / 0.5):
        assert product == two
    mirrored = -NOISE
    assert mirrored == NOISE.scaled(-1)
    assert (2 * NOISE).name == "noise"
    for bad, rule in ((0, "not zero, got 0"), (NAN, "got nan"), (INF, "got inf")):
        with pytest.raises(ValueError, match=rule):
            NOISE / bad
    with pytest.raises(ValueError, match="must be finite, got nan"):
        NOISE * NAN
    for wrong in ("2", None, [2], NOISE):
        with pytest.raises(TypeError):
            NOISE * wrong
    with pytest.raises(TypeError):
        2 / NOISE


def test_units_of_the_acceleration():
    g = ss.GroundMotion(SAMPLES, dt=0.25, units="g")
    assert np.array_equal(g.acceleration, np.multiply(SAMPLES, ss.STANDARD_GRAVITY))
    assert ss.GroundMotion(SAMPLES, dt=0.25, units="m/s^2") == ss.GroundMotion(SAMPLES, dt=0.25)
    assert ss.GroundMotion([0, 100], dt=1, units="gal").peak_acceleration == 1
    assert pickle.loads(pickle.dumps(g)) == g
    with pytest.raises(ValueError, match="furlong"):
        ss.GroundMotion(SAMPLES, dt=0.25, units="furlong")


def test_a_motion_is_scaled_to_a_target():
    assert NOISE.scaled_to(pga_g=0.4).peak_acceleration == pytest.approx(0.4 * ss.STANDARD_GRAVITY)
    assert ss.strong_motion(NOISE.scaled_to(arias=1.5)).arias_intensity == pytest.approx(1.5)
    assert ss.strong_motion(NOISE.scaled_to(pgv=0.3)).peak_velocity == pytest.approx(0.3)
    for targets, count in (({}, 0), ({"pga_g": 1, "pgv": 1}, 2)):
        with pytest.raises(ValueError, match=f"exactly one .* got {count}"):
            NOISE.scaled_to(**targets)
    with pytest.raises(
        ValueError, match=r"peak velocity \(pgv\) must be positive and finite, got -1 m/s"
    ):
        NOISE.scaled_to(pgv=-1)
    with pytest.raises(ValueError, match="zeros only"):
        ss.GroundMotion([0, 0], dt=1).scaled_to(pga_g=1)


def test_velocity_and_displacement_are_exact_integrals():
    # n = 2 t - 1 from t = 0 to 4, at uneven times: v = t^2 - t, d = t^3 / 3 - t^2 / 2.
    t = np.array([0, 0.3, 1, 2.5, 4])
    motion = ss.GroundMotion(2 * t - 1, times=t)
    assert np.allclose(motion.velocity, t**2 - t, rtol=1e-14, atol=1e-14)
    assert np.allclose(motion.displacement, t**3 / 3 - t**2 / 2, rtol=1e-14, atol=1e-14)
    # As a slider without friction: relative to the ground it moves as the ground, backward.
    free = ss.histories(ss.ViscousSlider(0.0), NOISE)
    assert np.allclose(-free[1], NOISE.velocity, atol=1e-12)
    assert np.allclose(-free[0], NOISE.displacement, atol=1e-12)


def test_a_resampled_motion_lies_on_the_lines():
    fine = NOISE.resampled(0.005)
    assert fine.dt == 0.005
    assert np.allclose(
        fine.acceleration, np.interp(fine.time, NOISE.time, NOISE.acceleration), atol=1e-12
    )
    assert fine.velocity[-1] == pytest.approx(NOISE.velocity[-1], rel=1e-11)
    r, s = (ss.integrate(ss.Coulomb(slip_level=0.5), q, settle=True) for q in (NOISE, fine))
    assert r.residual == pytest.approx(s.residual, rel=1e-9)
    with pytest.raises(ValueError, match=r"at most the duration, 9.98 s, got 20 s"):
        NOISE.resampled(20)


def test_a_motion_is_cut():
    part = NOISE.cut(1.0, 3.0)
    assert (part.dt, part.duration, part.time[0]) == (0.02, 2.0, 0)
    assert np.array_equal(part.acceleration, NOISE.acceleration[50:151])
    odd = NOISE.cut(1.01, 3)
    assert odd.acceleration[0] == pytest.approx(NOISE.acceleration[50:52].mean())
    assert odd.duration == pytest.approx(1.99)
    with pytest.raises(ValueError, match=r"from 0 to 9.98 s, got 10 s"):
        NOISE.cut(0, 10)


def test_a_slice_of_a_motion_is_a_motion():
    part = NOISE[50:151]
    assert part == NOISE.cut(1.0, 3.0)
    assert NOISE[:] == NOISE
    assert NOISE[-20:-10].acceleration.tolist() == NOISE.acceleration[-20:-10].tolist()
    assert NOISE[450:10000] == NOISE[-50:]
    uneven = ss.GroundMotion(
        [1, 2, 3, 4, 5],
        times=[0, 1, 3, 6, 10],
        transverse=[5, 6, 7, 8, 9],
        vertical=[0, 1, 0, 1, 0],
        interpolation="constant",
        name="A",
        orientation="N28W",
    )
    assert uneven[1:4] == ss.GroundMotion(
        [2, 3, 4],
        times=[0, 2, 5],
        transverse=[6, 7, 8],
        vertical=[1, 0, 1],
        interpolation="constant",
        name="A",
        orientation="N28W",
    )
    for few in (slice(3, 4), slice(4, 3), slice(5, None), slice(0, 0)):
        with pytest.raises(ValueError, match=r"must hold at least 2 samples, got [01] of 5"):
            uneven[few]
    for step in (2, -1):
        with pytest.raises(ValueError, match=f"must have the step 1, got {step}"):
            uneven[::step]
    with pytest.raises(TypeError, match=r"must be a slice, such as .*, got 3"):
        uneven[3]
    with pytest.raises(TypeError, match="not iterable"):
        iter(uneven)
    with pytest.raises(TypeError):
        uneven["a":]


def test_a_trend_is_taken_away():
    flat = NOISE.detrended()
    assert abs(flat.velocity[-1]) <= 1e-12
    offset = ss.GroundMotion(flat.acceleration + 0.1, dt=0.02, name="noise")
    assert np.allclose(offset.detrended().acceleration, flat.acceleration, atol=1e-13)
    inclined = ss.GroundMotion(flat.acceleration + 0.1 - 0.03 * flat.time, dt=0.02)
    assert np.allclose(
        inclined.detrended(1).acceleration, flat.detrended(1).acceleration, atol=1e-12
    )
    with pytest.raises(ValueError, match="from 0 to 10, got 11"):
        NOISE.detrended(11)


def test_a_motion_plots_itself():
    pytest.importorskip("matplotlib")
    from matplotlib.figure import Figure

    (axes,) = NOISE.plot().axes
    assert axes.get_title(loc="left") == "noise"
    assert np.allclose(axes.lines[0].get_ydata() * ss.STANDARD_GRAVITY, NOISE.acceleration)
    mine = Figure().subplots()
    assert NOISE.plot(ax=mine, title="mine") is mine
    assert any("PGA" in text.get_text() for text in mine.texts)


class Stats:
    delta = 0.01


class Trace:
    data, stats, id = np.array([1, -2, 3], dtype=np.float32), Stats(), "XX.STA..HNE"


def test_a_trace_becomes_a_motion():
    motion = ss.GroundMotion.from_obspy(Trace(), units="gal")
    assert motion == ss.GroundMotion([0.01, -0.02, 0.03], dt=0.01, name="XX.STA..HNE")
    assert ss.GroundMotion.from_obspy(Trace(), name="mine").name == "mine"
    gap = Trace()
    gap.data = np.ma.masked_array([1.0, 2, 3], [0, 1, 0])
    with pytest.raises(ValueError, match="masked value at index 1"):
        ss.GroundMotion.from_obspy(gap)
    with pytest.raises(TypeError, match="needs one obspy Trace, got list"):
        ss.GroundMotion.from_obspy([1, 2, 3])


@pytest.mark.parametrize(
    "channel, orientation",
    [
        ("HNZ", "Z"),
        ("HNN", "N"),
        ("HNE", "E"),
        ("HN1", ""),
        ("", ""),
        ("UD", "UD"),
        ("NS1", "NS"),
        ("EW2", "EW"),
        ("EW3", ""),
    ],
)
def test_the_channel_of_a_trace_states_its_orientation(channel, orientation):
    trace = Trace()
    trace.stats = Stats()
    trace.stats.channel = channel
    motion = ss.GroundMotion.from_obspy(trace)
    assert motion.orientation == orientation
    assert motion.vertical is None
    both = [motion, ss.GroundMotion([0, 1, 0], dt=0.01)]
    if orientation in ("Z", "UD"):  # as is a vertical component from a file
        with pytest.raises(ValueError, match=r"1 of 2 are known to be vertical"):
            ss.sweep([ss.Coulomb(mu=0.1)], both)
    else:
        ss.sweep([ss.Coulomb(mu=0.1)], both)


@pytest.mark.slow
def test_a_trace_of_obspy_itself_becomes_a_motion():
    obspy = pytest.importorskip("obspy", reason="obspy is not installed: pip install obspy")
    header = {"delta": 0.005, "network": "XX", "station": "STA", "channel": "HNE"}
    trace = obspy.Trace(np.array([0.0, 1.5, -2.0]), header)
    motion = ss.GroundMotion.from_obspy(trace)
    assert motion == ss.GroundMotion(
        [0.0, 1.5, -2.0], dt=0.005, name="XX.STA..HNE", orientation="E"
    )
    offset = obspy.Trace(np.sin(np.arange(400)) + 0.02, header)
    with pytest.warns(ss.PlausibilityWarning, match=r"from_obspy \(XX.STA..HNE\): the mean"):
        ss.GroundMotion.from_obspy(offset)
    assert ss.GroundMotion.from_obspy(obspy.Stream([trace])) == motion


@pytest.mark.slow
def test_a_stream_of_obspy_becomes_a_station():
    obspy = pytest.importorskip("obspy", reason="obspy is not installed: pip install obspy")
    samples = np.random.default_rng(5).normal(size=(3, 40))
    header = {"delta": 0.01, "network": "XX", "station": "STA"}
    traces = [obspy.Trace(n, {**header, "channel": f"HN{last}"}) for n, last in zip(samples, "ENZ")]
    stream = obspy.Stream(traces)
    motion = ss.GroundMotion.from_obspy(stream, units="gal")
    assert np.array_equal(motion.acceleration, 0.01 * samples[0])  # the first horizontal one
    assert np.array_equal(motion.transverse, -0.01 * samples[1])  # 90 degrees clockwise of east
    assert np.array_equal(motion.vertical, 0.01 * samples[2])
    assert ss.GroundMotion.from_obspy(stream, units="gal", name="mine").name == "mine"
    assert ss.read_station(stream, units="gal") == motion
    north = ss.read_station(stream, along="N")
    assert np.array_equal(north.acceleration, samples[1])
    assert np.array_equal(north.transverse, samples[0])
    second = obspy.Trace(samples[2], {**header, "channel": "HNZ", "location": "10"})
    with pytest.raises(ValueError, match="from_obspy: needs one vertical component at most"):
        ss.GroundMotion.from_obspy(obspy.Stream([*traces, second]))
    slow = obspy.Trace(samples[1], {**header, "channel": "HNN", "delta": 0.02})
    with pytest.raises(ValueError, match="from_obspy: components must have the same time step"):
        ss.GroundMotion.from_obspy(obspy.Stream([traces[0], slow]))


@pytest.mark.parametrize(
    "times",
    [np.arange(301) * 0.005, np.linspace(0, 1.5, 301), np.cumsum([0.0] + [0.005] * 300)],
)
def test_even_times_are_a_time_step(times):
    samples = np.sin(np.arange(301.0))
    motion = ss.GroundMotion(samples, times=times)
    assert motion.dt == pytest.approx(0.005, rel=1e-12)
    assert motion.time == pytest.approx(times, abs=1e-12)
    even = ss.GroundMotion(samples, dt=0.005)
    peaks = [ss.integrate(ss.Coulomb(mu=0.02), one).peak for one in (motion, even)]
    assert peaks[0] == pytest.approx(peaks[1], rel=1e-10)
    assert ss.GroundMotion(samples, times=even.time) == even
    times = np.array(times)
    times[150] += 1e-6
    assert ss.GroundMotion(samples, times=times).dt is None
    assert ss.GroundMotion(samples, times=1 + even.time).time[0] == 1  # a start that is kept


# ---- components

ACROSS, UP = [4.0, 5.0, -6.0, 7.0], [-7.0, 8.0, -9.0, 0.5]
ALL = ss.GroundMotion(
    SAMPLES, dt=0.25, name="Kobe", transverse=ACROSS, vertical=UP, orientation="N28W"
)


def test_a_motion_has_the_components_that_it_was_given():
    axis = ss.GroundMotion(SAMPLES, dt=0.25)
    assert axis.transverse is None
    assert axis.vertical is None
    assert axis.orientation == ""
    assert np.array_equal(ALL.transverse, ACROSS)
    assert np.array_equal(ALL.vertical, UP)
    assert not ALL.transverse.flags.writeable
    assert not ALL.vertical.flags.writeable
    assert ALL.orientation == "N28W"
    assert repr(axis).endswith("linear>")
    assert repr(ALL).endswith("linear, with transverse and vertical>")
    in_g = ss.GroundMotion(SAMPLES, dt=0.25, units="g", transverse=ACROSS, vertical=UP)
    assert np.array_equal(in_g.vertical, np.multiply(UP, ss.STANDARD_GRAVITY))
    assert np.array_equal(in_g.transverse, np.multiply(ACROSS, ss.STANDARD_GRAVITY))


def test_one_component_alone_is_a_motion():
    assert ALL.component("transverse") == ss.GroundMotion(ACROSS, dt=0.25, name="Kobe")
    assert ALL.component("vertical").orientation == "up"
    assert ALL.component("vertical").peak_acceleration == 9
    assert ALL.component("axis").transverse is None
    with pytest.raises(ValueError, match="has no vertical component"):
        ALL.component("axis").component("vertical")
    with pytest.raises(ValueError, match="must be 'axis', 'transverse' or 'vertical', got 'up'"):
        ALL.component("up")


@pytest.mark.parametrize("array", ["transverse", "vertical"])
def test_a_component_is_checked_as_the_first_one(array):
    with pytest.raises(ValueError, match=array + r"\[1\] must be finite .* got nan m/s\^2"):
        ss.GroundMotion(SAMPLES, dt=0.25, **{array: [0, NAN, 1, 2]})
    for wrong in ([], [0, 1, 2]):
        with pytest.raises(ValueError, match=f"{array} must have as many samples .* 4, got"):
            ss.GroundMotion(SAMPLES, dt=0.25, **{array: wrong})
    with pytest.raises(ValueError, match=f"{array} must be one-dimensional"):
        ss.GroundMotion(SAMPLES, dt=0.25, **{array: [[0, 1, 2, 3]]})


def test_what_makes_a_motion_carries_all_components():
    for motion in (2 * ALL, ALL.cut(0.25, 0.75), ALL.resampled(0.125), ALL.detrended(), ALL / 2):
        assert motion.transverse is not None
        assert len(motion.vertical) == len(motion.transverse) == len(motion)
        assert motion.orientation == "N28W"
    mirror = -2 * ALL
    assert np.array_equal(mirror.transverse, np.multiply(ACROSS, -2))
    assert np.array_equal(mirror.vertical, np.multiply(UP, 2))
    assert np.array_equal((-ALL).vertical, UP)
    assert ALL.scaled_to(pga_g=0.5) == ALL * (0.5 * ss.STANDARD_GRAVITY / ALL.peak_acceleration)


def test_horizontal_axes_are_turned():
    quarter = ALL.rotated(90)
    assert np.array_equal(quarter.acceleration, ACROSS)
    assert np.array_equal(quarter.transverse, np.multiply(SAMPLES, -1))
    assert np.array_equal(quarter.vertical, UP)
    assert quarter.orientation == "62"
    half = ALL.rotated(30).rotated(150)
    np.testing.assert_allclose(half.acceleration, np.multiply(SAMPLES, -1), atol=1e-14)
    with pytest.raises(ValueError, match="needs a transverse component"):
        ALL.component("axis").rotated(30)


def test_a_response_names_the_components_that_acted():
    across = ss.GroundMotion(SAMPLES, dt=0.25, transverse=ACROSS)
    law = ss.Coulomb(slip_level=0.5)
    response = ss.integrate(law, across)
    assert response.components == "axis"
    expected = ss.integrate(law, across.component("axis")).displacement
    assert np.array_equal(response.displacement, expected)
    assert ss.integrate(law, ALL).components == "axis + vertical"
