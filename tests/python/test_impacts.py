"""Impacts on stops, and members that end in flight, in ensembles and sweeps."""

import itertools
import json
import math
import pickle
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import stickslip as ss

GAP, MEMBERS = 0.1, 320
LAW = ss.Coulomb(mu=0.15)
PULSES = ss.PoissonPulses.event("great near field")
BOTH = ss.Stops(gap=GAP, restitution=0.3)
AHEAD = ss.Stops(gap=GAP, backward=math.inf, restitution=0.3)
SIDES = ("forward", "backward")
COLUMNS = [f"{what}_{side}" for side in SIDES for what in ("impacts", "impact_speed")]


def ensemble(slider=LAW, **options):
    return ss.run_ensemble(
        slider, PULSES, **{"members": MEMBERS, "seed": 1, "settle": True} | options
    )


def walled(stops=BOTH):
    return ss.Slider(LAW, stops=stops)


@pytest.fixture(scope="module")
def free():
    return ensemble()


@pytest.fixture(scope="module")
def boxed():
    return ensemble(walled())


def test_a_member_hits_a_wall_if_without_it_it_would_go_beyond(free, boxed):
    """Up to its first impact a slider moves as without stops."""
    beyond = free.peak > GAP
    assert 0.1 < beyond.mean() < 0.9
    assert np.array_equal(boxed.impacts_forward + boxed.impacts_backward > 0, beyond)
    p = boxed.impact_probability
    assert p == free.exceedance(GAP)
    assert (p.low, p.high) == (free.exceedance(GAP).low, free.exceedance(GAP).high)
    assert boxed.exceedance(GAP) == p
    assert boxed.exceedance(GAP / 2) == free.exceedance(GAP / 2)
    ahead, behind = (getattr(boxed, f"impact_probability_{side}") for side in SIDES)
    assert ahead.value == (boxed.impacts_forward > 0).mean()
    assert max(ahead.value, behind.value) <= p.value <= ahead.value + behind.value


@pytest.mark.parametrize("stops", [BOTH, AHEAD], ids=["both", "ahead"])
def test_each_member_has_the_impacts_of_its_response(stops):
    e = ensemble(walled(stops), members=64)
    for member in range(64):
        r = ss.integrate(walled(stops), PULSES.sample(seed=1, member=member), settle=True)
        for side, sign in zip(SIDES, (1, -1)):
            hits = r.impacts[sign * r.impacts["displacement"] > 0]
            assert getattr(e, f"impacts_{side}")[member] == len(hits)
            speed = np.abs(hits["velocity"]).max(initial=0)
            assert getattr(e, f"impact_speed_{side}")[member] == pytest.approx(speed, abs=1e-12)
    assert e.impact_speed_forward.max() > 0.1


def test_a_wall_on_one_side_is_not_the_other_side(free):
    e = ensemble(walled(AHEAD))
    assert e.impact_probability == e.impact_probability_forward
    assert not e.impacts_backward.any()
    with pytest.raises(ValueError, match="no member has a stop backward"):
        _ = e.impact_probability_backward
    # At the gap: those that hit it, and those that go as far the other way.
    hit, far = e.impacts_forward > 0, e.peak > GAP
    assert far.any() and hit.any()
    assert e.exceedance(GAP).value == (hit | far).mean()
    assert e.exceedance(GAP).value > e.impact_probability.value


def test_a_level_beyond_a_stop_is_refused_and_so_are_impacts_without_stops(free, boxed):
    for level in (math.nextafter(GAP, 1), 1.0):
        with pytest.raises(ValueError, match=r"level must be at most 0.1 m, the smallest gap of a"):
            boxed.exceedance(level)
    for name in ("impact_probability", "impacts_forward", "impact_speed_backward"):
        with pytest.raises(ValueError, match="no member has a stop"):
            getattr(free, name)
    with pytest.raises(ValueError, match="at least two members"):
        _ = ensemble(walled(), members=1).impact_probability


def test_random_gaps():
    gaps = ss.Lognormal(median=GAP, beta=0.3)
    random = ss.Random(ss.Slider, law=LAW, stops=ss.Random(ss.Stops, gap=gaps, restitution=0.3))
    e = ensemble(random)
    gap = np.array([random.sample(seed=1, member=i).stops.gap for i in range(MEMBERS)])
    assert np.array_equal(e.impacts_forward + e.impacts_backward > 0, ensemble().peak > gap)
    assert e.exceedance(gap.min()).value == (e.peak >= gap.min()).mean()
    with pytest.raises(ValueError, match="the smallest gap of a stop"):
        e.exceedance(GAP)
    # Some members without stops: those hit nothing.
    mixed = ensemble([walled(), LAW])
    assert not mixed.impacts_forward[1::2].any()
    assert np.array_equal(mixed.impacts_forward[::2], ensemble(walled()).impacts_forward[::2])


def test_the_bits_do_not_depend_on_threads_parts_or_files(boxed, tmp_path):
    assert ensemble(walled(), threads=1) == ensemble(walled(), threads=3) == boxed
    with ThreadPoolExecutor(2) as pool:
        assert ensemble(walled(), executor=pool) == boxed
    part = ensemble(walled(), members=128, first_member=192)
    part.merge(ensemble(walled(), members=192))
    assert part == boxed
    boxed.save(tmp_path / "e.npz")
    for again in (ss.Ensemble.load(tmp_path / "e.npz"), pickle.loads(pickle.dumps(boxed))):
        assert again == boxed
        for name in COLUMNS:
            assert np.array_equal(getattr(again, name), getattr(boxed, name))
        assert again.exceedance(GAP) == boxed.exceedance(GAP)
    assert ensemble(walled(), checkpoint=tmp_path / "e.npz") == boxed


def test_impossible_impacts_in_a_file_are_rejected(boxed, tmp_path):
    file = tmp_path / "e.npz"
    boxed.save(file)
    with np.load(file) as kept:
        whole = {name: kept[name] for name in kept.files}
    for name, change in (
        ("impact_speed_forward", lambda a: -1 - a),
        ("impacts_forward", lambda a: a[:-1]),
        ("gaps", lambda a: a * math.inf),
        ("gaps", lambda a: -a),
        ("hits", lambda a: a + np.uint64(7)),
        ("airborne", lambda a: a + MEMBERS + 1),
    ):
        np.savez(file, **whole | {name: np.asarray(change(whole[name]), whole[name].dtype)})
        with pytest.raises(ValueError, match=r"Ensemble.load: .* does not hold what an ensemble"):
            ss.Ensemble.load(file)


@pytest.mark.parametrize("stops", [BOTH, AHEAD], ids=["both", "ahead"])
def test_the_picture_ends_at_the_first_stop(stops):
    pytest.importorskip("matplotlib")
    e = ensemble(walled(stops))
    (axes,) = [a for a in e.plot().axes if a.get_ylabel() == "probability of exceedance"]
    (curve,) = [line for line in axes.get_lines() if len(line.get_xdata()) > 2]
    unit = {"[mm]": 1e3, "[cm]": 1e2, "[m]": 1}[axes.get_xlabel().split()[-1]]
    assert 0.9 * GAP < curve.get_xdata()[-1] / unit <= GAP * (1 + 1e-12)
    for line in axes.get_lines():  # quantiles lie on the curve; those at the stop are not quantiles
        if len(line.get_xdata()) == 1:
            (x,), (y,) = line.get_data()
            assert np.interp(x, *curve.get_data()) == pytest.approx(y, rel=0.1)
    shown = [text.get_text() for text in axes.texts]
    assert any(f"{100 * e.impact_probability.value:.3g} % hit a stop" in text for text in shown)


# ---- tables of ensembles


def test_an_ensemble_goes_to_tables(free, boxed):
    pytest.importorskip("pandas")
    for e, more in ((free, []), (boxed, COLUMNS)):
        frame = e.to_dataframe()
        assert frame.index.name == "member"
        assert list(frame.index) == list(range(MEMBERS))
        assert sorted(frame.columns) == sorted(["peak", "residual", *more])
    assert frame.attrs["units"] == {
        **dict.fromkeys(("peak", "residual"), "m"),
        **dict.fromkeys((f"impact_speed_{side}" for side in SIDES), "m/s"),
    }
    assert len(frame.query("impacts_forward > 0")) == (boxed.impacts_forward > 0).sum()
    times = boxed.to_dataframe(by="time")
    assert np.array_equal(times.index, boxed.time)
    assert np.array_equal(times.velocity_variance_error, boxed.velocity_variance_error)
    assert times.attrs["units"]["covariance"] == "m^2/s"
    with pytest.raises(ValueError, match="by must be 'member' or 'time', got 'x'"):
        boxed.to_dataframe(by="x")
    data = pytest.importorskip("xarray") and boxed.to_xarray()
    assert data.impact_speed_forward.dims == ("member",)
    assert data.displacement_mean.attrs["units"] == "m"
    assert np.array_equal(
        data.displacement_variance.sel(time=boxed.time[3]), times.iloc[3].displacement_variance
    )
    document = json.loads(boxed.to_json(), parse_constant=pytest.fail)
    assert document["impact_probability"] == dict(
        zip(("value", "low", "high"), boxed.impact_probability)
    )
    assert document["by_time"]["time"] == boxed.time.tolist()
    assert document["members"] == MEMBERS
    assert "probability of an impact forward" in boxed._repr_html_()
    assert "impact" not in free._repr_html_()


def test_an_ensemble_without_times_has_its_members(tmp_path):
    suite = [ss.GroundMotion([0, 2, -2], dt=dt) for dt in (0.1, 0.2)]
    e = ss.run_ensemble(ss.Coulomb(mu=0.02), suite, members=9, seed=7)
    with pytest.raises(ValueError, match="differ in duration"):
        e.to_dataframe(by="time")
    assert list(pytest.importorskip("xarray") and e.to_xarray().dims) == ["member"]
    assert "by_time" not in json.loads(e.to_json())


# ---- members that end in flight

STRONG = ss.PoissonPulses.event("great very near field")
RANDOM_VERTICAL = ss.WithVertical(STRONG, STRONG, ratio=1.5)


@pytest.mark.parametrize("settle", [False, True])
def test_a_member_that_ends_in_flight_ends_no_ensemble(settle):
    e = ss.run_ensemble(LAW, RANDOM_VERTICAL, members=256, seed=1, settle=settle)
    airborne = 0
    for member in range(256):
        motion = RANDOM_VERTICAL.sample(seed=1, member=member)
        try:
            r = ss.integrate(LAW, motion, settle=settle)
        except ValueError as error:
            assert "never lands" in str(error)
            airborne += 1
            table = ss.sweep(LAW, motion, polarity="recorded")
            assert table.airborne.all()
            assert e.residual[member] == pytest.approx(table.residual[0, 0, 0], abs=1e-12)
        else:
            assert e.residual[member] == pytest.approx(r.residual, abs=1e-12)
            assert not r.state.in_flight or not settle
            airborne += r.state.in_flight
    assert e.airborne == airborne
    assert (e.airborne == 0) if settle else (e.airborne > 0)
    parts = [
        ss.run_ensemble(LAW, RANDOM_VERTICAL, members=128, first_member=f, seed=1, settle=settle)
        for f in (128, 0)
    ]
    parts[0].merge(parts[1])
    assert parts[0] == e and parts[0].airborne == e.airborne


FALLS = ss.GroundMotion([0, 1, 2, 2], dt=0.1, vertical=[0, -10, -12, -12])


def test_a_slider_in_free_fall_keeps_its_speed_and_lands_where_the_motion_ends():
    """Without friction v(t) = -integral of n; when the ground stands still it falls back."""
    table = ss.sweep(LAW, FALLS, polarity="recorded")
    assert table.airborne.tolist() == [[[True]]]
    assert not table.failures
    settled = ss.sweep(LAW, FALLS, settle=True)
    assert not settled.airborne.any()
    r = ss.integrate(LAW, FALLS, settle=True)
    assert settled.residual[0, 0, 0] == pytest.approx(r.residual, rel=1e-12)
    # The ground goes on at a constant velocity: relative to it the slider is a projectile.
    (lift,) = r.events[r.events["kind"] == "liftoff"]["time"]
    (land,) = r.events[r.events["kind"] == "landing"]["time"]
    t = np.linspace(lift, 0.3, 20001)
    normal = np.interp(t, FALLS.time, FALLS.vertical) + ss.STANDARD_GRAVITY
    rate = np.concatenate([[0], np.cumsum((normal[1:] + normal[:-1]) / 2 * np.diff(t))])
    gap = -np.sum((rate[1:] + rate[:-1]) / 2 * np.diff(t))
    g, v = ss.STANDARD_GRAVITY, -rate[-1]
    assert land - 0.3 == pytest.approx((v + math.sqrt(v**2 + 2 * g * gap)) / g, rel=1e-6)
    with pytest.raises(ValueError, match="never lands"):
        ss.integrate(LAW, FALLS)


# ---- sweeps


def quake(seed, samples=600):
    n = np.random.default_rng(seed).normal(0, 3, samples)
    return ss.GroundMotion(n - n.mean(), dt=0.02, name=f"quake {seed}")


QUAKES = [quake(seed) for seed in range(4)]
SLIDERS = [
    ss.Slider(ss.Coulomb(mu=mu), stops=stops) for mu in (0.1, 0.2) for stops in (BOTH, AHEAD)
]
SLIDERS.append(ss.Coulomb(mu=0.1))


@pytest.fixture(scope="module")
def table():
    return ss.sweep(SLIDERS, QUAKES, settle=True)


def test_a_sweep_has_the_impacts_of_each_response(table):
    for s, r, p in itertools.product(*map(range, table.peak.shape)):
        one = ss.integrate(SLIDERS[s], QUAKES[r] * (-1) ** p, settle=True)
        for side, sign in zip(SIDES, (1, -1)):
            hits = one.impacts[sign * one.impacts["displacement"] > 0]
            assert getattr(table, f"impacts_{side}")[s, r, p] == len(hits)
            speed = np.abs(hits["velocity"]).max(initial=0)
            found = getattr(table, f"impact_speed_{side}")[s, r, p]
            assert found == pytest.approx(speed, rel=1e-9)
    hit = table.impacts_forward + table.impacts_backward > 0
    assert hit.any() and np.array_equal(table.impact_fraction, hit.mean(axis=(1, 2)))
    assert table.impact_fraction[-1] == 0
    # Alike both ways: the reversed motion swaps the stops.
    assert np.array_equal(table.impacts_forward[0, :, 0], table.impacts_backward[0, :, 1])


def test_impacts_go_wherever_a_table_goes(table, tmp_path):
    pytest.importorskip("h5py")
    frame = pytest.importorskip("pandas") and table.to_dataframe()
    assert np.array_equal(frame.impacts_forward, table.impacts_forward.ravel())
    assert "airborne" not in frame
    for again in (
        ss.SweepTable.open(table.save(tmp_path / "t.h5")),
        ss.SweepTable.from_json(table.to_json()),
        ss.sweep(SLIDERS, QUAKES, settle=True, checkpoint=tmp_path / "c.npz"),
        ss.sweep(SLIDERS, QUAKES, settle=True, checkpoint=tmp_path / "c.npz"),
        ss.sweep(SLIDERS, QUAKES, settle=True, threads=1),
    ):
        assert again == table
        assert np.array_equal(again.impact_speed_forward, table.impact_speed_forward)
    plain = ss.sweep(ss.Coulomb(mu=0.1), QUAKES)
    assert "impacts_forward" not in plain.to_dataframe()
    with pytest.raises(ValueError, match="no slider has stops"):
        _ = plain.impacts_forward
