"""Response spectra: against SciPy, a closed form, limits; shapes, plots, rejected arguments."""

import math

import numpy as np
import pytest
import stickslip as ss
from scipy.integrate import solve_ivp
from scipy.signal import lsim

KINDS = ("pseudo_acceleration", "pseudo_velocity", "displacement", "velocity", "acceleration")
NOISE = np.random.default_rng(5).standard_normal(200)
QUAKE = ss.GroundMotion(NOISE, dt=0.02)


def by_lsim(period, zeta):
    """Largest x, x' and x'' + n at fine times, by matrix exponentials; exact for lines."""
    wn = 2 * math.pi / period
    fine = max(1, math.ceil(0.02 / period * 400))
    t = np.arange(0, 0.02 * (len(NOISE) - 1) + 2 * period, 0.02 / fine)
    n = np.interp(t, QUAKE.time, NOISE, right=0.0)
    c, k = 2 * zeta * wn, wn**2
    system = ([[0, 1], [-k, -c]], [[0], [-1]], [[1, 0], [0, 1], [-k, -c]], [[0], [0], [0]])
    return np.abs(lsim(system, n, t)[1]).max(axis=0)


@pytest.mark.parametrize("period", [0.03, 0.2, 1.5])
@pytest.mark.parametrize("zeta", [0.02, 0.4, 1.0, 1.5])
def test_it_is_what_scipy_finds_between_the_samples(period, zeta):
    # 400 times a period or more: below the maximum by (2 pi / 400)^2 / 8 = 3e-5 of it at most for
    # x; the velocity and the acceleration have higher frequencies, of the bends. The lines' last
    # drop to 0 takes one fine step here, no time there.
    x, v, a = by_lsim(period, zeta)
    for kind, value in {"displacement": x, "velocity": v, "acceleration": a}.items():
        found = ss.response_spectrum(QUAKE, period, zeta, kind=kind).values[0]
        assert found == pytest.approx(value, rel=2e-3), kind
    wn = 2 * math.pi / period
    assert ss.response_spectrum(QUAKE, period, zeta, kind="pseudo_velocity").values[
        0
    ] == pytest.approx(wn * x, rel=2e-3)
    assert ss.response_spectrum(QUAKE, period, zeta).values[0] == pytest.approx(wn**2 * x, rel=2e-3)


def test_it_is_what_solve_ivp_finds_at_its_events():
    # The maximum is where x' = 0, which solve_ivp locates. rtol 1e-11 over 100 steps.
    period, zeta = 0.5, 0.05
    wn = 2 * math.pi / period
    motion = ss.GroundMotion(NOISE[:60], dt=0.02)

    def rate(t, y):
        n = np.interp(t, motion.time, motion.acceleration, right=0.0)
        return [y[1], -n - 2 * zeta * wn * y[1] - wn**2 * y[0]]

    def turns(t, y):
        return y[1]

    y, largest = [0.0, 0.0], 0.0
    for begin, end in zip(motion.time, [*motion.time[1:]]):
        step = solve_ivp(rate, (begin, end), y, rtol=1e-11, atol=1e-14, events=turns)
        y = step.y[:, -1]
        largest = max([largest, abs(y[0]), *(abs(e[0]) for e in step.y_events[0])])
    free = solve_ivp(
        lambda t, y: [y[1], -2 * zeta * wn * y[1] - wn**2 * y[0]],
        (0, 2 * period),
        y,
        rtol=1e-11,
        atol=1e-14,
        events=turns,
    )
    largest = max([largest, *(abs(e[0]) for e in free.y_events[0])])
    found = ss.response_spectrum(motion, period, zeta, kind="displacement").values[0]
    assert found == pytest.approx(largest, rel=1e-8)


def test_resonance_has_its_closed_form():
    # A sine at wn builds up to A / (2 zeta) as pseudo-acceleration; after 60 periods, zeta = 0.1,
    # e^(-2 pi 6) is missing. Lines stand for the sine to (wn dt)^2 / 12 of it.
    period, zeta, per_period = 0.7, 0.1, 200
    t = np.arange(60 * per_period + 1) * period / per_period
    motion = ss.GroundMotion(3 * np.sin(2 * math.pi * t / period), dt=period / per_period)
    found = ss.response_spectrum(motion, period, zeta).values[0]
    assert found == pytest.approx(3 / (2 * zeta), rel=(2 * math.pi / per_period) ** 2 / 6)


@pytest.mark.filterwarnings("ignore:.* periods = 1e:stickslip.PlausibilityWarning")
def test_short_periods_give_the_pga_and_long_ones_the_pgd():
    motion = ss.GroundMotion(np.sin(np.linspace(0, 6 * math.pi, 301)), dt=0.01)
    pga = motion.peak_acceleration
    for kind in ("pseudo_acceleration", "acceleration"):
        spectrum = ss.response_spectrum(motion, [0, 1e-4], kind=kind)
        assert spectrum.values[0] == pga
        assert spectrum.values[1] == pytest.approx(pga, rel=1e-3)
    assert not ss.response_spectrum(motion, 0, kind="displacement").values.any()
    # The ground must come to rest: whole periods of a sine leave it at a displacement.
    s = ss.strong_motion(motion)
    slow = ss.response_spectrum(motion, 1e5, kind="displacement").values[0]
    assert slow == pytest.approx(s.peak_displacement, rel=1e-3)
    slow = ss.response_spectrum(motion, 1e5, kind="velocity").values[0]
    assert slow == pytest.approx(s.peak_velocity, rel=1e-3)


@pytest.mark.parametrize("kind", KINDS)
def test_values_come_in_the_shape_and_order_of_the_periods(kind):
    periods, damping = np.array([2.0, 0, 0.1, 0.5]), [0.02, 0.05, 0.2]
    table = ss.response_spectrum(QUAKE, periods, damping, kind=kind)
    assert (table.kind, table.values.shape) == (kind, (3, 4))
    assert np.array_equal(table.periods, periods)
    assert np.array_equal(table.damping, damping)
    for zeta, row in zip(damping, table.values):
        spectrum = ss.response_spectrum(QUAKE, list(periods), damping=zeta, kind=kind)
        assert np.array_equal(spectrum.values, row)
        assert np.array_equal(spectrum.damping, [zeta])
    back = ss.response_spectrum(QUAKE, periods[::-1], damping, kind=kind)
    assert np.array_equal(back.values, table.values[:, ::-1])
    assert ss.response_spectrum(QUAKE, 0.5, kind=kind).values.shape == (1,)
    twice = ss.response_spectrum(2 * QUAKE, periods, damping, kind=kind)
    assert np.array_equal(twice.values, 2 * table.values)  # exact in binary
    mirrored = ss.response_spectrum(-QUAKE, periods, damping, kind=kind)
    assert np.allclose(mirrored.values, table.values, rtol=1e-14, atol=0)
    assert kind in repr(table) and "4 periods" in repr(table)


def test_the_largest_sample_misses_what_the_documentation_says():
    # (wn dt)^2 / 8 of it at most, 5 % at T = 10 dt.
    period, worst = 0.2, 0.0
    for start in range(0, 180, 5):
        motion = ss.GroundMotion(np.append(NOISE[start : start + 20], np.zeros(20)), dt=0.02)
        spring = ss.ViscousSlider(0.0, natural_frequency=2 * math.pi / period)
        at_samples = np.abs(ss.histories(spring, motion)[0]).max()
        exact = ss.response_spectrum(motion, period, 0, kind="displacement").values[0]
        worst = max(worst, 1 - at_samples / exact)
    assert 0.02 < worst <= (2 * math.pi / 10) ** 2 / 8


def test_real_records_have_spectra(pyslammer_files):
    for file in pyslammer_files[:3]:
        record = ss.read_record(file)
        spectrum = ss.response_spectrum(record, np.geomspace(0.01, 5, 30))
        assert spectrum.values.max() > 1.5 * record.peak_acceleration
        assert spectrum.values[0] == pytest.approx(record.peak_acceleration, rel=0.02)


def test_it_plots_itself():
    pytest.importorskip("matplotlib")
    spectrum = ss.response_spectrum(QUAKE, [1.0, 0.1, 0.5], [0.02, 0.05])
    (axes,) = spectrum.plot().axes
    x, y = axes.lines[1].get_data()
    assert np.array_equal(x, [0.1, 0.5, 1.0])
    assert np.allclose(y, spectrum.values[1][[1, 2, 0]] / ss.STANDARD_GRAVITY)
    assert [text.get_text() for text in axes.get_legend().get_texts()] == [
        "2 % damping",
        "5 % damping",
    ]
    (axes,) = ss.response_spectrum(QUAKE, 1.0, kind="velocity").plot().axes
    assert "velocity" in axes.get_ylabel()


def test_what_makes_no_spectrum_is_refused():
    for periods, rule in (
        ([], "at least one period"),
        ([1, -1], r"periods\[1\] must be 0 or from 1e-6 to 1e6 s, got -1 s"),
        ([math.nan], r"periods\[0\] .* got nan"),
        ([[1, 2]], "periods must be a number or one-dimensional, got 2 dimensions"),
        (["a"], "real numbers"),
    ):
        with pytest.raises(ValueError, match=rule):
            ss.response_spectrum(QUAKE, periods)
    with pytest.raises(ValueError, match=r"ratio of critical damping \(5 % is 0.05\), got 5"):
        ss.response_spectrum(QUAKE, 1, 5)
    with pytest.raises(ValueError, match=r"kind must be one of 'pseudo_acceleration'.* got 'sa'"):
        ss.response_spectrum(QUAKE, 1, kind="sa")
    with pytest.raises(TypeError):
        ss.response_spectrum(NOISE, 1)
