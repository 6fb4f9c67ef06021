"""Responses: histories and events, whose memory they are, and what the numbers mean."""

import gc
import weakref

import numpy as np
import pytest
import stickslip as ss

LAWS = [
    ss.Coulomb(slip_level=1.0),
    ss.Coulomb(slip_level=1.0, backward=1.6),
    ss.Slider(ss.Coulomb(slip_level=1.0), 1.3),
    ss.Caster(slip_level=1.0, reach=0.5),
    ss.Slider(ss.Caster(slip_level=1.0, reach=0.5), 1.3),
]
SLIDERS = [law if isinstance(law, ss.Slider) else ss.Slider(law) for law in LAWS]


@pytest.fixture(params=SLIDERS, ids=repr)
def response(request, record_a):
    quake = ss.GroundMotion(record_a, dt=0.1)
    return ss.integrate(request.param, quake, displacement=0.01, velocity=-0.3, settle=True)


def block(samples=(0.0, 2.0, -2.0, 0.0)):
    return ss.integrate(ss.Coulomb(slip_level=1.0), ss.GroundMotion(samples, dt=0.1))


# ---- whose memory it is


@pytest.mark.parametrize("name", ["displacement", "velocity"])
def test_histories_are_views_that_cannot_be_written(name):
    r = block()
    view = getattr(r, name)
    assert view.dtype == np.float64
    assert view.shape == (4,)
    assert view.base is r
    assert np.shares_memory(view, getattr(r, name))
    assert view.ctypes.data == getattr(r, name).ctypes.data
    with pytest.raises(ValueError, match="read-only"):
        view[0] = 1
    with pytest.raises(ValueError, match="WRITEABLE"):
        view.setflags(write=True)


def test_histories_outlive_their_response():
    noise = np.random.default_rng(3).normal(0, 2, 100_000)
    r = block(noise)
    kept = r.displacement, r.velocity, r.time, r.events
    copies = [array.copy() for array in kept]
    del r
    gc.collect()
    garbage = [block(-noise) for _ in range(5)]  # would take the memory that was given back
    for array, copy in zip(kept, copies):
        assert np.array_equal(array, copy)
    del garbage


def test_a_response_goes_when_its_last_view_goes():
    class Watched(np.ndarray):
        pass

    r = block(np.random.default_rng(3).normal(0, 2, 1000))
    watch = weakref.ref(view := r.displacement.view(Watched))
    base = view.base
    del r
    assert base is not None and watch() is view
    del view, base
    gc.collect()
    assert watch() is None


def test_a_response_remembers_what_it_came_from():
    quake = ss.GroundMotion([0, 2, -2], dt=0.1)
    slider = ss.Slider(ss.Coulomb(slip_level=1.0), 1.3)
    r = ss.integrate(slider, quake)
    assert r.motion is quake
    assert r.slider == slider


# ---- histories


def test_histories_have_one_value_a_sample(response):
    assert response.time.shape == response.displacement.shape == response.velocity.shape
    assert np.array_equal(response.time[:401], response.motion.time)
    rest = response.events["time"][-1]  # settled: samples continue up to the first at or after rest
    assert response.time[-2] < rest <= response.time[-1]
    assert np.diff(response.time) == pytest.approx(response.motion.dt)
    assert (response.displacement[0], response.velocity[0]) == (0.01, -0.3)


def test_the_peak_is_over_all_time(response):
    ends = np.abs(response.events["displacement"])
    assert response.peak == max(np.max(ends), 0.01)
    assert response.peak >= np.max(np.abs(response.displacement))


def test_a_peak_between_samples_is_seen():
    # n = -3 held for 1 s, then 9 for 1 s, level 1: x = 1 + 4/20 m, 0.2 s after the first sample
    quake = ss.GroundMotion([-3, 9, 0], dt=1, interpolation="constant")
    r = ss.integrate(ss.Coulomb(slip_level=1.0), quake)
    assert r.peak > np.max(np.abs(r.displacement[:2]))
    assert r.events["displacement"][1] == pytest.approx(1.2, rel=1e-14)
    assert r.events["time"][1] == pytest.approx(1.2, rel=1e-14)


def test_the_residual_is_where_it_ends(response):
    assert response.residual == response.events["displacement"][-1]
    assert response.at_rest
    assert response.events["velocity"][-1] == 0


# ---- events


def test_events_are_a_structured_array(response):
    events = response.events
    assert events.dtype.names == ("time", "displacement", "velocity", "kind")
    assert [events.dtype[name].kind for name in events.dtype.names] == ["f", "f", "f", "U"]
    assert set(events["kind"].tolist()) <= {"breakaway", "reversal", "arrest", "end"}
    assert isinstance(events[0]["kind"].item(), str)
    assert len(events[events["kind"] == "end"]) == 1


def test_events_follow_one_another_as_they_can(response):
    sliding, last = False, -np.inf
    for i, (time, _, velocity, kind) in enumerate(response.events.tolist()):
        assert time >= last
        last = time
        if kind == "end":
            assert i == len(response.events) - 1
            break
        assert (kind == "breakaway") == (not sliding)
        sliding = kind != "arrest"
        assert velocity == 0 or i == 0  # it started on its way
    assert sliding != response.at_rest


def test_the_first_event_of_a_start_on_its_way_is_a_breakaway():
    r = ss.integrate(ss.Coulomb(mu=0.2), ss.GroundMotion([0, 0], dt=1), velocity=0.5)
    first = r.events[0]
    assert (first["time"], first["displacement"], first["velocity"]) == (0, 0, 0.5)
    assert first["kind"] == "breakaway"


def test_a_block_that_never_slips_has_nothing_but_an_end():
    r = block((0.0, 1.0, -1.0, 0.5))
    assert r.events.tolist() == [(pytest.approx(0.3), 0.0, 0.0, "end")]
    assert (r.peak, r.residual, r.sliding_distance, r.time_sliding) == (0, 0, 0, 0)


def test_the_way_slid_is_the_sum_of_the_ways_between_events(response):
    way = np.sum(np.abs(np.diff(response.events["displacement"])))
    # some hundred sums and differences, each rounded by 1.1e-16 of the largest
    assert response.sliding_distance == pytest.approx(way, rel=1e-13)


def test_the_time_sliding_runs_from_breakaways_to_arrests(response):
    times, kinds = response.events["time"], response.events["kind"]
    starts, stops = times[kinds == "breakaway"], times[kinds == "arrest"]
    assert response.time_sliding == pytest.approx(np.sum(stops - starts), rel=1e-12)


# ---- the rest


def test_a_response_says_the_main_numbers():
    r = block()
    for part in ("Response", f"peak {r.peak:.4g} m", f"{len(r.events)} events"):
        assert part in repr(r)


def test_slips_are_breakaways_and_reversals(response):
    kinds = response.events["kind"]
    assert response.slips == np.count_nonzero((kinds == "breakaway") | (kinds == "reversal")) > 0


def test_a_response_keeps_its_numbers_while_others_come_and_go(record_a):
    quake = ss.GroundMotion(record_a, dt=0.1)
    kept = ss.integrate(SLIDERS[0], quake)
    numbers = [kept.displacement.copy(), kept.velocity.copy(), kept.events.copy()]
    for slider in SLIDERS * 3:  # each in the memory of the one before
        ss.integrate(slider, quake)
    again = ss.integrate(SLIDERS[0], quake)
    for response in (kept, again):
        for now, then in zip((response.displacement, response.velocity, response.events), numbers):
            assert np.array_equal(now, then)
