"""Carts from Python: limits that have other answers, bad inputs, runs, files and pictures."""

import csv
import itertools
import json
import math
import os
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import pytest
import stickslip as ss
from pages import ROOT
from stickslip import cli

G = ss.STANDARD_GRAVITY
M = np.arange(161)
FADE = np.sin(np.pi * M / 160) ** 2
ALONG = 2 * FADE * (2 * np.sin(0.7 * M) + 1.3 * np.cos(1.9 * M + 0.4))
ACROSS = 2 * FADE * (1.5 * np.sin(0.9 * M + 1.1) + 0.8 * np.cos(2.3 * M))
QUAKE = ss.GroundMotion(ALONG, dt=0.05, transverse=ACROSS, name="both")
STILL = ss.GroundMotion(0 * ALONG, dt=0.05, transverse=0 * ALONG)
WALL = ((0.6, 0), (0, 1))
CORNERS = [(0.4, 0.3), (-0.4, 0.3), (-0.4, -0.3), (0.4, -0.3)]
RANDOM = (0.3, 2.0, -1.2, 2.9)


def caster(at, heading, level=0.97, reach=0.041, rolling_mu=0.01, **more):
    return ss.SwivelCaster(
        at=at, heading=heading, slip_level=level, reach=reach, rolling_mu=rolling_mu, **more
    )


def cart(headings=RANDOM, size=1.0, level=0.97, rolling_mu=0.01, **more):
    """A cart on four casters."""
    places = size * np.array([(0.3, 0.2), (0.3, -0.2), (-0.3, 0.2), (-0.3, -0.2)])
    supports = [
        caster(at, heading, level, 0.041 * size, rolling_mu)
        for at, heading in zip(places, headings)
    ]
    return ss.Cart(supports, radius_of_gyration=0.25 * size, **more)


CART = cart(outline=CORNERS)
PLAIN = ss.integrate(CART, QUAKE, settle=True, walls=[WALL])


def test_parallel_casters_are_one_caster():
    quake = QUAKE.scaled(0.5)  # under a stronger one the yaw of round-off grows to 1e-10
    four = ss.integrate(cart([0.8] * 4), quake)
    one = ss.integrate(ss.Cart([caster((0, 0), 0.8)], radius_of_gyration=1), quake)
    assert four.peak_yaw < 1e-12
    assert four.peak > 0.02
    assert np.allclose(four.displacement, one.displacement, rtol=0, atol=1e-12)


def test_lengths_and_accelerations_scale():
    large = cart(size=3, level=3 * 0.97, rolling_mu=3 * 0.01, outline=3 * np.array(CORNERS))
    r = ss.integrate(large, 3 * QUAKE)
    first = ss.integrate(CART, QUAKE)
    assert np.allclose(r.displacement, 3 * first.displacement, rtol=0, atol=1e-9)
    assert np.allclose(r.yaw, first.yaw, rtol=0, atol=1e-9)
    assert r.peak_outline == pytest.approx(3 * first.peak_outline, rel=1e-9)
    assert np.allclose(r.reach_outline, 3 * np.array(first.reach_outline), rtol=0, atol=1e-9)


def test_the_energy_closes_and_is_that_of_the_supports():
    energy = PLAIN.energy
    assert energy.dissipated > 0.1
    assert abs(energy.imbalance) < 1e-12 * energy.dissipated
    parts = energy.by_support
    total = sum(parts[name].sum() for name in ("scrub", "roll", "slide"))
    assert total == pytest.approx(energy.dissipated, rel=1e-13)
    assert (parts["slide"] == 0).all()


def test_peaks_and_clearances_are_those_of_the_histories():
    t = PLAIN.time
    yaw, place = PLAIN.yaw[:, None], PLAIN.displacement
    corners = np.array(CORNERS)
    x = place[:, :1] + corners[:, 0] * np.cos(yaw) - corners[:, 1] * np.sin(yaw)
    y = place[:, 1:] + corners[:, 0] * np.sin(yaw) + corners[:, 1] * np.cos(yaw)
    moved = np.hypot(x - corners[:, 0], y - corners[:, 1])
    # Between samples 0.05 s apart a peak is larger by at most a dt^2/8, with a < 10 m/s^2.
    assert 0 <= PLAIN.peak_outline - moved.max() < 10 * 0.05**2 / 8
    assert moved.argmax(axis=None) % 4 == PLAIN.peak_corner
    assert np.allclose(PLAIN.reach_outline, (x.min(), y.min(), x.max(), y.max()), atol=4e-3)
    assert t[0] <= PLAIN.peak_outline_time <= t[-1]
    (clearance,) = PLAIN.clearances
    assert clearance == PLAIN.clearance(WALL)
    assert clearance.least == pytest.approx(0.6 - PLAIN.reach_outline[2], abs=1e-12)
    near = PLAIN.clearance(((PLAIN.reach_outline[2] - 1e-3, 0), (0, -2)))
    assert near.least == pytest.approx(-1e-3, abs=1e-12)
    assert near.hit_time <= near.time
    assert near.hit_speed > 0
    assert PLAIN.clearance(((9, 0), (0, 1))).hit_time is None


def test_a_cart_holds_what_its_response_rests_under():
    limit = CART.holds((0.6, 0.8))
    assert CART.holds((3, 4)) == pytest.approx(limit, rel=1e-14)
    assert CART.with_headings([0.1] * 4).holds((0.6, 0.8)) == CART.holds((0.6, 0.8), [0.1] * 4)
    for factor, rests in ((1 - 1e-6, True), (1 + 1e-6, False)):
        push = np.full(11, -factor * limit)
        r = ss.integrate(CART, ss.GroundMotion(0.6 * push, dt=0.1, transverse=0.8 * push))
        assert (r.time_moving == 0) is rests


def test_advance_goes_where_integrate_goes():
    state = ss.CartState()
    ground = np.column_stack([ALONG, ACROSS])
    for begin, end in itertools.pairwise(ground):
        state = ss.advance(CART, state, 0.05, begin, end)
    r = ss.integrate(CART, QUAKE)
    assert np.allclose(state.displacement, r.displacement[-1], rtol=0, atol=1e-10)
    assert state.yaw == pytest.approx(r.yaw[-1], abs=1e-10)
    assert np.allclose(state.headings, r.heading[:, -1], rtol=0, atol=1e-9)
    assert ss.advance(CART, state, 100, (0, 0)).at_rest
    with pytest.raises(ValueError, match="as many headings as the cart has swivel casters, 4"):
        ss.advance(CART, ss.CartState(headings=[0.0]), 0.1, (0, 0))


def test_a_cart_on_feet_is_felt_like_a_block():
    feet = [ss.Foot(at=(x, y), mu=0.15) for x in (-0.3, 0.3) for y in (-0.2, 0.2)]
    r = ss.integrate(ss.Cart(feet, radius_of_gyration=0.25), QUAKE, settle=True)
    block = ss.integrate(ss.PlanarSlider(ss.Coulomb(mu=0.15)), QUAKE, settle=True)
    assert np.allclose(r.acceleration[:-1], block.acceleration[:-1], rtol=0, atol=1e-5)
    assert r.peak_force == pytest.approx(block.peak_force, rel=1e-5) == 0.15 * G
    assert np.linalg.norm(r.at(r.peak_force_time).displacement) <= r.peak
    periods = [0.1, 0.5, 2.0]
    floors = [ss.response_spectrum(one, periods, direction=30) for one in (r, block)]
    assert np.allclose(floors[0].values, floors[1].values, rtol=1e-4)
    assert [one.name for one in floors] == ["cart, both", "sliding mass, both"]
    spread = [ss.rotd(one, periods).rotd100 for one in (r, block)]
    assert np.allclose(*spread, rtol=1e-4)


def test_the_motion_at_any_times():
    rows = PLAIN.at(PLAIN.time)
    for name in ("displacement", "velocity", "yaw", "yaw_rate"):
        np.testing.assert_allclose(rows[name], getattr(PLAIN, name), rtol=0, atol=1e-9)
    fine = ss.integrate(CART, QUAKE.resampled(0.025))
    rows = PLAIN.at(fine.time)
    np.testing.assert_allclose(rows["displacement"], fine.displacement, rtol=0, atol=1e-9)
    assert np.allclose(PLAIN.at(1.02).headings, ss.integrate(CART, QUAKE).at(1.02).headings)
    with pytest.raises(ValueError, match="the start and the end of the response"):
        PLAIN.at([-1.0])


def test_a_locked_caster_is_a_foot_behind_its_pivot():
    wheel = {"at": (0.3, 0.2), "heading": 0.5, "mu": 0.5, "trail": 0.04}
    both = ss.SwivelCaster(**wheel, lock="both")
    assert repr(both).endswith("lock='both')")
    assert both.reach is None
    contact = 0.3 - 0.04 * math.cos(0.5), 0.2 - 0.04 * math.sin(0.5)
    one = ss.Cart([both], radius_of_gyration=0.3, center=contact)
    assert one.casters == 0
    swivels = ss.SwivelCaster(**wheel, lock="wheel")
    assert (swivels.slip_level, swivels.reach) == (0, 0.04)
    with pytest.raises(ValueError, match="no caster that swivels"):
        one.with_random_headings()
    with pytest.raises(ValueError, match="give mu, trail and wheel_width, or"):
        ss.SwivelCaster(**wheel)
    with pytest.raises(ValueError, match="a lock needs mu and trail"):
        ss.SwivelCaster(at=(0, 0), heading=0, slip_level=1, reach=0.1, lock="wheel")
    with pytest.raises(ValueError, match="lock must be None, 'wheel' or 'both', got 'brake'"):
        ss.SwivelCaster(**wheel, lock="brake")
    with pytest.raises(ValueError, match="trail must be positive and finite, got 0 m"):
        ss.SwivelCaster(at=(0, 0), heading=0, mu=0.5, trail=0, lock="both")


FOOT, WHEEL = ss.Foot(at=(0, 0), mu=0.3), ss.FixedWheel(at=(0.5, 0), mu=0.4)
BAD = [
    (lambda: ss.Cart([], radius_of_gyration=1), "supports must be at least 1"),
    (lambda: ss.Cart([FOOT], radius_of_gyration=0), "radius_of_gyration must be positive"),
    (lambda: ss.Foot(at=(math.nan, 0), mu=1), "Foot: at must be finite"),
    (lambda: ss.Foot(at=(0, 0), mu=-1), "Foot: mu"),
    (lambda: ss.FixedWheel(at=(1, 0), mu=1, rolling_mu=-1), "FixedWheel: rolling_mu"),
    (lambda: caster((0, 0), math.inf), "SwivelCaster: heading"),
    (lambda: caster((0, 0), 0, reach=0.0), "SwivelCaster: reach"),
    (
        lambda: ss.Cart([FOOT, ss.Foot(at=(1, 0), mu=1, share=0.5)], radius_of_gyration=1),
        "support 0: it has no share",
    ),
    (
        lambda: ss.Cart([FOOT, WHEEL], radius_of_gyration=1, center=(2, 0)),
        "support 0 would carry a negative share",
    ),
    (lambda: ss.Cart([FOOT], radius_of_gyration=1, outline=[1, 2]), "outline must be corners"),
    (lambda: CART.holds((0, 0)), "direction must be finite and not zero"),
    (lambda: CART.with_headings([1, 2]), "headings must be as many as it has swivel casters, 4"),
    (lambda: ss.integrate(CART, QUAKE.component("axis")), "needs both horizontal components"),
    (lambda: ss.integrate(CART, QUAKE, walls=[(1, 2, 3)]), "must be two vectors"),
    (lambda: ss.integrate(CART, QUAKE, walls=[((0, 0), (0, 0))]), "direction of a wall"),
    (lambda: ss.integrate(CART, QUAKE, velocity=(math.nan, 0)), "velocity must be finite"),
    (
        lambda: ss.integrate(cart(rolling_mu=0.0), QUAKE, settle=True),
        "without rolling resistance this cart may roll without end",
    ),
    (lambda: ss.Cart.from_json('{"supports": 3}'), "must be an object with a list of supports"),
    (lambda: ss.Cart.from_json('{"supports": [{"kind": "Leg"}]}'), "support 0: kind must be"),
    (
        lambda: ss.Cart.from_json('{"supports": [{"kind": "Foot", "at": [0, 0], "nu": 1}]}'),
        "support 0: Foot: has no argument 'nu'",
    ),
]


@pytest.mark.parametrize(("make", "message"), BAD)
def test_bad_input_is_refused_by_name(make, message):
    with pytest.raises(ValueError, match=message):
        make()


def test_what_is_no_support_is_refused():
    with pytest.raises(TypeError, match="support 1 must be a SwivelCaster"):
        ss.Cart([FOOT, CART], radius_of_gyration=1)
    with pytest.raises(TypeError, match="motion of a Cart must be a GroundMotion"):
        ss.integrate(CART, ss.HarmonicMotion(1, 2, 3).sampled)


def test_what_is_not_known_of_carts_is_refused():
    for call in (
        lambda: PLAIN.sensitivity("scale"),
        lambda: PLAIN.effective_period,
        lambda: ss.ensemble_sensitivity(CART, QUAKE, "scale", members=2, seed=1),
    ):
        with pytest.raises((TypeError, AttributeError), match=r"Cart|no attribute"):
            call()


def test_carts_evaluate_and_go_through_json(tmp_path):
    wheel = {"mu": 0.5, "trail": 0.04, "wheel_width": 0.032, "rolling_mu": 0.01}
    mixed = ss.Cart(
        [
            ss.SwivelCaster(at=(0.9, 0.35), heading=0.3, **wheel),
            ss.SwivelCaster(at=(0.9, -0.35), heading=2, **wheel, lock="both"),
            ss.FixedWheel(at=(-0.9, 0.35), mu=0.4, rolling_mu=0.01),
            ss.Foot(at=(-0.9, -0.35), mu=0.3),
            caster((0, 0), 0.1, reach=math.inf),
        ],
        radius_of_gyration=0.65,
        center=(0, 0),
        outline=[(1, 0.4), (-1, 0.4), (-1, -0.4)],
    )
    for one in (mixed, CART):
        file = tmp_path / "cart.json"
        file.write_text(one.to_json())
        assert ss.Cart.from_json(file) == one
    assert mixed != CART
    assert mixed.casters == 2
    assert sum(mixed.shares) == pytest.approx(1)


def test_a_sweep_equals_single_runs():
    other = cart([1.0, 2.0, 3.0, 4.0], outline=CORNERS)
    table = ss.sweep([CART, other], QUAKE, scale=[0.5, 1], walls=[WALL], settle=True)
    assert table.peak.shape == (2, 1, 2, 2)
    for i, k, s in itertools.product(range(2), repeat=3):
        motion = QUAKE.scaled((0.5, 1)[k] * (1, -1)[s])
        r = ss.integrate((CART, other)[i], motion, settle=True, walls=[WALL])
        at = i, 0, k, s
        assert table.peak_outline[at] == r.peak_outline
        assert (table.residual[at] == r.residual).all()
        assert table.clearance[(*at, 0)] == r.clearances[0].least
        assert table.rests[at] == r.rests
    with pytest.warns(RuntimeWarning, match="2 of 2 combinations failed"):
        table = ss.sweep(cart(rolling_mu=0.0), QUAKE, settle=True, walls=[WALL])
    assert np.isnan(table.peak).all()
    assert "may roll without end" in table.failures[0].message
    with pytest.raises(ValueError, match="contact does not apply to carts"):
        ss.sweep(CART, QUAKE, contact="flight")
    with pytest.raises(ValueError, match="walls are for carts"):
        ss.sweep(ss.Coulomb(mu=0.1), QUAKE, walls=[WALL])


def part(first):
    return ss.run_ensemble(
        CART.with_random_headings(), QUAKE, members=6, first_member=first, seed=3, walls=[WALL]
    )


def test_random_headings_are_the_same_on_threads_and_processes():
    drawn = CART.with_random_headings()
    assert drawn.names == ("heading_0", "heading_1", "heading_2", "heading_3")
    whole = [
        ss.run_ensemble(drawn, QUAKE, members=12, seed=3, walls=[WALL], threads=threads)
        for threads in (1, 2)
    ]
    assert whole[0] == whole[1]
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        parts = list(pool.map(part, (0, 6)))
    for name in ("peak", "peak_outline", "residual", "clearance", "margin"):
        joined = np.concatenate([getattr(one, name) for one in parts])
        assert np.array_equal(joined, getattr(whole[0], name))
    e = whole[0]
    member = drawn.sample(seed=3, member=7)
    assert e.carts[7] == member
    assert e.peak_outline[7] == ss.integrate(member, QUAKE).peak_outline
    headings = [one.heading for k in range(100) for one in drawn.sample(seed=1, member=k).supports]
    # 400 directions uniform over the circle: each mean has the deviation sqrt(1/800).
    assert abs(np.mean(np.exp(1j * np.array(headings)))) < 5 / math.sqrt(800)
    assert e.hitting().value == np.mean(e.clearance[:, 0] <= 0)
    assert e.exceedance(0.1).value == np.mean(e.peak_outline > 0.1)
    assert e.quantile(0.5).value == np.sort(e.peak_outline)[5]
    assert e.quantile(0.5, of="peak_yaw").low <= e.quantile(0.5, of="peak_yaw").high
    with pytest.raises(IndexError, match="there is no wall 1"):
        e.hitting(1)
    with pytest.raises(ValueError, match="of must be"):
        e.exceedance(1, of="rests")


def test_carts_under_random_ground_motions():
    band = ss.Spectrum.band_pass(s0=0.1, low=2, high=20)
    noise = ss.GaussianExcitation(band, dt=0.05, samples=64, period=256)
    pairs = ss.WithTransverse(noise)
    e = ss.run_ensemble([CART, cart([0.0] * 4)], pairs, members=4, seed=2)
    for i, one in enumerate(e.carts * 2):
        assert e.peak[i] == ss.integrate(one, pairs.sample(seed=2, member=i)).peak
    with pytest.raises(ValueError, match="member 0: a Cart needs both horizontal components"):
        ss.run_ensemble(CART, noise, members=2, seed=1)
    with pytest.raises(ValueError, match="dt does not apply to carts"):
        ss.run_ensemble(CART, pairs, members=2, seed=1, dt=0.1)
    with pytest.raises(TypeError, match="give blocks or carts as a list"):
        ss.run_ensemble(ss.Drawn([CART]), pairs, members=2, seed=1)


def test_tables_and_files(tmp_path):
    document = json.loads(PLAIN.to_json())
    assert document["peak_outline"] == PLAIN.peak_outline
    assert document["heading_3"] == PLAIN.heading[3].tolist()
    assert document["ground_acceleration_transverse"][:161] == ACROSS.tolist()
    assert document["units"]["yaw"] == "rad"
    assert "heading" in PLAIN._repr_html_()
    assert "never moves" in ss.integrate(CART, QUAKE.scaled(0.05)).remark
    assert not ss.integrate(CART, QUAKE.scaled(0.001)).remark


@pytest.mark.parametrize("factor", [1.0, 0.01])
def test_pictures(factor, tmp_path):
    pytest.importorskip("matplotlib", reason="pictures need matplotlib")
    r = ss.integrate(CART, QUAKE.scaled(factor), settle=True)
    plan, way, turn = r.plot().axes
    shown = [text.get_text() for text in plan.get_legend().get_texts()]
    assert ("end" in shown) is (factor == 1)
    assert way.get_ylabel() == "center [m]"
    assert turn.get_xlabel() == "time [s]"
    film = r.animate(time=(2, 3), speed=2)
    assert film.write(tmp_path / "cart.html").stat().st_size > 10_000


@pytest.fixture
def station(tmp_path):
    """A file with both components, and one of a cart."""
    rows = (f"{0.05 * i:.2f},{x},{y}" for i, (x, y) in enumerate(zip(ALONG, ACROSS)))
    (tmp_path / "a.csv").write_text("\n".join(["time [s],N [m/s^2],E [m/s^2]", *rows]))
    (tmp_path / "cart.json").write_text(CART.to_json())
    return [str(tmp_path / name) for name in ("cart.json", "a.csv")]


def test_the_command_prints_what_the_library_finds(station, capsys, tmp_path):
    wall = ["--wall", "0.6", "0", "0", "1"]
    assert cli.main(["cart", *station, *wall, "--scale", "0.5", "1", "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)["results"]
    for row, scale in zip(rows, (0.5, 1), strict=True):
        r = ss.integrate(CART, QUAKE.scaled(scale), settle=True, walls=[WALL])
        assert row["peak_outline_m"] == pytest.approx(r.peak_outline, rel=1e-9)
        assert row["clearance_m"] == pytest.approx(r.clearances[0].least, abs=1e-9)
        assert row["margin"] == pytest.approx(r.margin, rel=1e-3)
    members = ["--members", "8", "--seed", "3"]
    assert cli.main(["cart", *station, *members, "--csv", str(tmp_path / "m.csv")]) == 0
    assert "corner [cm] 50%" in capsys.readouterr().out
    (found,) = csv.DictReader((tmp_path / "m.csv").read_text().splitlines())
    e = ss.run_ensemble(CART.with_random_headings(), QUAKE, members=8, seed=3, settle=True)
    median = float(found["peak_outline_m_50"])
    assert median == pytest.approx(e.quantile(0.5).value, rel=1e-6)
    assert cli.main(["cart", *station, *members, "--plot", str(tmp_path / "r.png")]) == 2
    assert "--plot shows one response" in capsys.readouterr().err
    (tmp_path / "cart.json").write_text("{}")
    assert cli.main(["cart", *station]) == 2
    assert "must be an object with a list of supports" in capsys.readouterr().err


def test_the_condition_is_the_growth_of_an_error_of_the_headings():
    off = np.array(RANDOM) + 1e-9
    other = ss.integrate(cart(off, outline=CORNERS), QUAKE, settle=True)
    n = min(len(PLAIN.time), len(other.time))
    moved = np.hypot(*(other.displacement[:n] - PLAIN.displacement[:n]).T).max()
    turned = 0.25 * abs(other.yaw[:n] - PLAIN.yaw[:n]).max()
    assert PLAIN.condition == pytest.approx(max(moved, turned) / 1e-9, rel=1e-9)
    assert PLAIN.condition > 0


@pytest.mark.parametrize(
    ("casters", "mean"), [(1, 0.0), (2, 0.40), (4, 0.53), (8, 0.58), (32, 0.62)]
)
def test_what_a_parked_cart_holds_at_random_headings(casters, mean):
    # At one point nothing turns. Of one caster a load along the axis is held only across it; of
    # many by 2/pi of mu s g. The other means were computed apart, to two digits.
    rng = np.random.default_rng(casters)
    supports = [caster((0, 0), 0, level=1.0, rolling_mu=0)] * casters
    one = ss.Cart(supports, radius_of_gyration=1)
    draws = [one.holds((1, 0), headings=rng.uniform(0, 2 * math.pi, casters)) for _ in range(2000)]
    # Five standard errors: a false alarm in 2e6 seeds.
    assert np.mean(draws) == pytest.approx(mean, abs=0.005 + 5 * np.std(draws) / 2000**0.5)
    assert np.mean(draws) < 2 / math.pi
    if casters == 4:
        low, middle, high = np.quantile(draws, [0.05, 0.5, 0.95])
        assert (low, middle, high) == pytest.approx((0.27, 0.53, 0.76), abs=0.03)


def entries():
    """Numbers computed apart from this library, of tests/data and of a file that is named."""
    found = json.loads((ROOT / "tests" / "data" / "carts.json").read_text())["carts"]["rows"]
    file = os.environ.get("STICKSLIP_CARTS_VALUES")
    return found + (json.loads(Path(file).read_text())["entries"] if file else [])


@pytest.mark.parametrize("entry", entries(), ids=lambda entry: entry["id"])
def test_values_computed_apart_from_this_library(entry):
    p, value = entry["params"], entry["value"]
    supports = []
    for kind, x, y, share, level, rho, heading, *reach in p["supports"]:
        if kind == "caster":
            one = caster((x, y), heading, level * G, *reach, rho, share=share)
        elif kind == "fixed":
            one = ss.FixedWheel(at=(x, y), heading=heading, mu=level, rolling_mu=rho, share=share)
        else:
            one = ss.Foot(at=(x, y), mu=level, share=share)
        supports.append(one)
    m, factor = np.arange(p["samples"]), p.get("factor", 0.0)
    x = factor * (2 * np.sin(0.7 * m) + 1.3 * np.cos(1.9 * m + 0.4))
    y = factor * (1.5 * np.sin(0.9 * m + 1.1) + 0.8 * np.cos(2.3 * m))
    if p.get("components") == "x":
        y = 0 * y
    up = 2.5 * p.get("vertical_factor", 1) * np.cos(0.5 * m + 0.2) if p.get("vertical") else None
    motion = ss.GroundMotion(x, dt=p["dt"], transverse=y, vertical=up)
    vx, vy, rate, yaw = p.get("start", (0, 0, 0, 0))
    one = ss.Cart(supports, radius_of_gyration=p["radius_of_gyration"], outline=CORNERS)
    how = {"settle": p.get("settle", False)}
    r = ss.integrate(one, motion, velocity=(vx, vy), yaw_rate=rate, yaw=yaw, **how)
    within = max(1e-9, float(entry["uncertainty"]))
    times = [(f"at {i}", i) for i in (25, 50, 75, 100)]
    for name, i in (*times, ("end", len(m) - 1)):
        if name in value:
            place = np.array(value[name][:3], float)
            found = [*r.displacement[i], r.yaw[i]]
            assert np.allclose(found, place, rtol=0, atol=within)
            room = np.array(value[name][3:], float)
            off = np.exp(1j * (r.heading[:, i] + r.yaw[i])) - np.exp(1j * room[: one.casters])
            assert np.abs(off).max(initial=0) < within
    assert r.peak == pytest.approx(float(value["peak"]), abs=within)
    assert r.peak_yaw == pytest.approx(float(value["peak_yaw"]), abs=within)
    assert r.peak_outline == pytest.approx(float(value["peak_corner"]), abs=within)
    assert r.energy.dissipated == pytest.approx(float(value["friction"]), abs=within)
    assert r.rests == value["rests"]


def test_fragility_of_the_worst_corner_and_of_a_wall(pyslammer_files):
    pytest.importorskip("scipy")
    quakes = [
        ss.GroundMotion(m.acceleration, dt=m.dt, transverse=0.6 * np.roll(m.acceleration, 40))
        for m in ss.sample_records()
    ]
    stripes = ss.Suite(quakes).stripes(pga_g=[0.02, 0.05, 0.1, 0.2, 0.4, 0.8])
    table = ss.sweep(CART, stripes, settle=True, walls=[((0.43, 0), (0, 1))])
    f = ss.Fragility.fit(table, im="pga_g", thresholds=[0.01, 0.03], quantity="peak_outline")
    assert f.labels == ("0.01 m", "0.03 m")
    assert f.im_directions == "rotd50"
    levels, fractions = f.fractions()
    stripe = table.metadata["stripe"]
    counted = [np.mean(table.peak_outline[0, stripe == at] > 0.03) for at in levels]
    assert fractions[1] == pytest.approx(counted)
    walls = ss.Fragility.fit(table, im="pga_g", thresholds=ss.impact)
    reached = [np.isfinite(table.hit_time[0, stripe == at]).mean() for at in levels]
    assert walls.fractions()[1][0] == pytest.approx(reached)
    assert 0 < reached[3] < 1
    with pytest.raises(ValueError, match="needs a sweep of carts with walls"):
        ss.Fragility.fit(ss.sweep(CART, stripes), im="pga_g", thresholds=ss.impact)
    with pytest.raises(ValueError, match="must be one of 'peak', 'peak_outline'"):
        ss.Fragility.fit(table, im="pga_g", thresholds=0.1, quantity="residual")
