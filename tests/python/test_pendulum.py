"""Pendulums with several surfaces: values, elements, loops, every call, messages."""

import json
import math
import pickle

import numpy as np
import pytest
import stickslip as ss

G = ss.STANDARD_GRAVITY
TRIPLE = {
    "radii": [0.3937, 3.7465, 3.7465],
    "mu": [0.01, 0.04, 0.08],
    "capacities": [0.0716, 0.5043, 0.5043],
}
FIVE = ss.QuintuplePendulum(
    radii=[0.15, 0.6, 0.7, 1.9, 2.3],
    mu=[0.015, 0.03, 0.045, 0.07, 0.10],
    capacities=[0.05, 0.10, 0.12, 0.30, 0.35],
)
M = np.arange(401)
RECORD = 2 * np.sin(0.7 * M) + 1.3 * np.cos(1.9 * M + 0.4)
QUAKE = ss.GroundMotion(RECORD, dt=0.1)
SHAKEN = ss.GroundMotion(RECORD, dt=0.1, vertical=2.5 * np.cos(0.5 * M + 0.2))


def test_fenz_and_constantinou_s_five_regimes():
    """Stiffness over weight by regime; their formulas for two equal outer radii, R2 = R3 there.

    Friction forces at the corners from their equations (1) to (20): the first slides at the inner
    mu; the outer surfaces join at mu2 and mu3; the lower and the upper outer stop.
    """
    isolator = ss.TriplePendulum(**TRIPLE)
    corners = isolator.trace([isolator.capacity * (1 - 1e-9)]).corners
    (inner, outer, _), (mu1, mu2, mu3) = TRIPLE["radii"], TRIPLE["mu"]
    x, force = corners.T
    stiffness = np.diff(force) / np.diff(x)
    known = [1 / (2 * inner), 1 / (inner + outer), 1 / (2 * outer), 1 / (inner + outer)]
    assert stiffness[:4] == pytest.approx(known, rel=1e-12)
    assert x[1] == pytest.approx(2 * inner * (mu2 - mu1), rel=1e-12)
    assert x[2] == pytest.approx(x[1] + (inner + outer) * (mu3 - mu2), rel=1e-12)


def test_the_isolator_of_the_issue_slides_settles_and_says_how_its_surfaces_moved():
    isolator = ss.TriplePendulum(**TRIPLE)
    r = ss.integrate(isolator, QUAKE, settle=True)
    assert r.peak == pytest.approx(0.1418561840578805, rel=1e-12)
    assert r.residual == pytest.approx(-0.04492939877512182, rel=1e-11)
    assert r.elements.displacement.shape == (4, len(r.displacement))
    assert r.surfaces.displacement.shape == (4, len(r.displacement))
    assert r.elements.displacement.sum(axis=0) == pytest.approx(r.displacement, abs=1e-14)
    assert r.surfaces.displacement.sum(axis=0) == pytest.approx(r.displacement, abs=1e-14)
    assert r.elements.dissipated.sum() == pytest.approx(r.energy.dissipated, rel=1e-12)
    assert abs(r.energy.imbalance) < 1e-12 * r.energy.dissipated
    assert (r.surfaces.peak >= abs(r.surfaces.displacement).max(axis=1) - 1e-16).all()
    assert r.elements.slides.tolist()[:2] == [r.elements.slides[0]] * 2
    assert len(r.impacts) == 0
    sliding = ss.integrate(isolator, QUAKE)
    # Nothing but the force of the bearing accelerates the mass.
    assert np.abs(sliding.force + sliding.acceleration).max() < 1e-12


def test_an_element_that_stops_stays_there_until_it_is_pulled_back():
    lab = ss.TriplePendulum([0.053, 0.435, 0.435], [0.012, 0.036, 0.09], [0.019, 0.064, 0.064])
    r = ss.integrate(lab, ss.GroundMotion(0.5 * RECORD, dt=0.3))
    assert r.elements.stops.tolist() == [0, 0, 39, 0]
    assert r.surfaces.stops.tolist() == [39, 0, 0, 0]
    assert r.surfaces.peak[0] == 0.064
    assert (r.elements.peak <= lab.element_capacities).all()


@pytest.mark.parametrize("isolator", [ss.TriplePendulum(**TRIPLE), FIVE], ids=["triple", "five"])
@pytest.mark.parametrize("motion", [QUAKE, SHAKEN], ids=["level", "vertical"])
def test_every_call_takes_a_pendulum(isolator, motion, tmp_path):
    r = ss.integrate(isolator, motion, settle=True)
    assert r.margin > 0
    assert r.effective_period > 0
    assert 0 < r.effective_damping < 1
    assert (ss.response_spectrum(r, [0.2, 1]).values > 0).all()
    assert eval(json.loads(r.to_json())["slider"], vars(ss)) == ss.Slider(isolator)
    state, n = ss.State(), motion.acceleration
    up = np.zeros(len(n)) if motion.vertical is None else motion.vertical
    for i in range(len(n) - 1):
        state = ss.advance(
            isolator, state, 0.1, n[i], n[i + 1], vertical_start=up[i], vertical_end=up[i + 1]
        )
        state = pickle.loads(pickle.dumps(state)) if i % 100 == 0 else state
    assert state.displacement == pytest.approx(r.displacement[400], abs=1e-12 * r.peak)
    assert isolator.element_displacements(state) == pytest.approx(
        r.elements.displacement[:, 400], abs=1e-12
    )
    assert r.at(12.34).displacement == pytest.approx(
        np.interp(12.34, r.time, r.displacement), abs=0.05
    )
    table = ss.sweep([isolator], [motion], settle=True)
    assert table.peak.max() == pytest.approx(r.peak, rel=1e-12)
    e = ss.run_ensemble(isolator, [motion], members=2, seed=1)
    assert e.quantile(0.5).value > 0


def test_the_repr_of_an_infinite_radius_or_capacity_reads_back():
    flat = ss.MultiPendulum([1, math.inf], [0.02, 0.05], [0.1, math.inf])
    assert repr(flat) == (
        "MultiPendulum(radii=[1, float('inf')], mu=[0.02, 0.05], capacities=[0.1, float('inf')])"
    )


def test_a_response_that_begins_beyond_a_jump_of_the_force_begins_there():
    """The first surface is at its stop at 0.02 m; from there the second needs more force."""
    isolator = ss.MultiPendulum([1, 2], [0.01, 0.1], [0.02, 0.1])
    elements = isolator.element_displacements(ss.State(displacement=0.05))
    assert elements == pytest.approx([0.02, 0.03], abs=1e-16)
    assert elements == pytest.approx(isolator.trace([0.05]).elements.displacement[:, 0], abs=1e-16)
    # Released, it stays within the levels of the two, of which the lower one is that of the first.
    still = ss.GroundMotion([0.0, 0.0], dt=1)
    r = ss.integrate(isolator, still, displacement=0.05, settle=True)
    assert r.elements.displacement[:, 0] == pytest.approx([0.02, 0.03], abs=1e-16)
    assert r.displacement[-1] < 0.05
    assert abs(r.energy.imbalance) < 1e-14


def test_random_pendulums_keep_what_was_drawn():
    isolators = ss.Random(
        ss.DoublePendulum,
        radii=[1.2, 2.0],
        mu=[0.03, 0.08],
        capacities=[0.3, 0.3],
        restitution=ss.Uniform(0, 0.5),
    )
    table = ss.sweep(isolators, [QUAKE], members=3, seed=1)
    assert np.isfinite(table.peak).all()


def test_a_spring_and_a_damper_in_parallel():
    bare = ss.integrate(ss.Slider(FIVE), QUAKE)
    damped = ss.integrate(ss.Slider(FIVE, damping=0.8), QUAKE, settle=True)
    assert damped.peak < bare.peak
    assert damped.energy.damped > 0
    assert abs(damped.energy.imbalance) < 1e-11 * damped.energy.input
    held = ss.integrate(ss.Slider(FIVE, natural_frequency=0.9), QUAKE, settle=True)
    assert abs(held.energy.imbalance) < 1e-11 * held.energy.input


def test_a_remark_beyond_a_fifth_of_a_radian():
    steep = ss.MultiPendulum([0.05, 0.05], [0.02, 0.02])
    r = ss.integrate(steep, QUAKE)
    assert "rad" in r.remark
    assert ss.integrate(ss.TriplePendulum(**TRIPLE), QUAKE).remark == ""


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: ss.TriplePendulum([1, 2], [0.1, 0.1], [1, 1]), "3 surfaces"),
        (
            lambda: ss.TriplePendulum([1, 2, 3], [0.1, 0.1], [1, 1, 1]),
            "mu must be as many as radii, 3, got 2",
        ),
        (lambda: ss.TriplePendulum([1, 0.5, 3], [0.1, 0.1, 0.1]), r"radii\[1\] must be larger"),
        (lambda: ss.TriplePendulum([1, 2, 3], [0.1, 0.05, 0.1]), r"mu\[1\] must be at least"),
        (
            lambda: ss.TriplePendulum([1, 2, 3], [0.1, 0.2, 0.2], [0.01, 1, 1]),
            r"capacities\[0\] must be at least",
        ),
        (lambda: ss.DoublePendulum([1, 2, 3], [0.1] * 3), "radii must hold 2, got 3"),
        (lambda: ss.MultiPendulum([], []), "radii must hold 1 to 8"),
        (lambda: ss.MultiPendulum([1] * 9, [0.1] * 9), "radii must hold 1 to 8"),
        (lambda: ss.MultiPendulum([1], [0.0]), r"mu\[0\] must be positive"),
        (lambda: ss.MultiPendulum([1], [math.nan]), "mu"),
        (
            lambda: ss.MultiPendulum([1], [0.1], [1], restitution=2),
            "restitution must be from 0 to 1",
        ),
        (
            lambda: ss.DoublePendulum(
                [1, 2], [0.01, ss.VelocityDependent(mu_slow=0.02, mu_fast=0.05, rate=20)]
            ),
            "DoublePendulum: mu must hold real numbers, got VelocityDepen",
        ),
        (
            lambda: ss.ensemble_sensitivity(FIVE, [QUAKE], "mu", members=2, seed=1),
            "ensemble_sensitivity: covers Coulomb friction without stops",
        ),
        (lambda: ss.Slider(FIVE, slope_degrees=3), "slope_degrees must be 0"),
        (lambda: ss.Slider(FIVE, one_way=True), "both ways"),
        (lambda: ss.FrictionPendulum(radius=2, law=FIVE), "already is a pendulum"),
        (
            lambda: ss.Slider(FIVE, stops=ss.Stops(gap=2.9, restitution=0)),
            "within its own capacity",
        ),
        (lambda: FIVE.trace([9]), r"path\[0\] must be finite and within the capacity"),
        (lambda: FIVE.trace([math.nan]), r"path"),
        (lambda: ss.integrate(FIVE, QUAKE, displacement=9), "between the stops"),
    ],
)
def test_messages_name_the_value(make, message):
    with pytest.raises(ValueError, match=message):
        make()


def test_other_sliders_have_no_elements():
    r = ss.integrate(ss.Coulomb(mu=0.1), QUAKE)
    with pytest.raises(ValueError, match="only a MultiPendulum has them"):
        _ = r.surfaces
    with pytest.raises(ValueError, match="not defined in all directions"):
        ss.PlanarSlider(FIVE)


def test_pictures_show_the_corners_and_the_surfaces():
    pytest.importorskip("matplotlib", reason="pictures need matplotlib")
    from stickslip.plotting import plot_surfaces

    loop = ss.TriplePendulum(**TRIPLE).trace([0.508, -0.508, 0.508])
    axes = loop.plot().axes[0]
    assert len(axes.lines[1].get_xdata()) == len(loop.corners)
    # The five regimes, by the surfaces that slide, from bottom to top; some occur twice.
    named = {t.get_text() for t in axes.texts}
    assert named == {
        *("2 3", "1 3", "1 4"),
        "numbers: the surfaces that slide,\ncounted from the bottom",
    }
    assert loop.moving.shape == (len(loop.corners), 4)
    assert (loop.moving.sum(axis=1) == 2).all()
    r = ss.integrate(FIVE, QUAKE)
    assert len(plot_surfaces(r).axes[0].lines) == 6
    assert "quintuple pendulum, mu" in " ".join(
        t.get_text() for t in r.plot().axes[0].texts
    ).replace("\n", " ")


def test_the_hysteresis_of_a_response_names_its_regimes(pyslammer_files):
    """By the surfaces that slide: the same as of the loop under the imposed displacement."""
    pytest.importorskip("matplotlib", reason="pictures need matplotlib")
    from stickslip.plotting.pendulum import sliding_surfaces

    def names(axes):
        return sorted(t.get_text() for t in axes.texts if t.get_text().replace(" ", "").isdigit())

    quake = ss.sample_record("Kobe")
    for isolator in (ss.TriplePendulum(**TRIPLE), FIVE):
        r = ss.integrate(isolator, quake, settle=True)
        (axes,) = r.plot_hysteresis().axes
        assert names(axes) == names(isolator.trace([r.peak, -r.peak]).plot().axes[0])
        # Where surfaces are named, stiffness over weight is that of their regime: d phi / dx.
        sliding, x, force = sliding_surfaces(isolator, r), r.displacement, r.force / G
        moves = (np.abs(np.diff(x)) > 1e-6) & (r.velocity[1:] * r.velocity[:-1] > 0)
        named = moves & sliding.any(axis=1)
        assert named.sum() > 0.8 * moves.sum()
        loop = isolator.trace([r.peak, -r.peak])
        way, rise = np.diff(loop.corners, axis=0).T
        for surfaces in np.unique(sliding[named], axis=0):
            here = named & (sliding == surfaces).all(axis=1)
            there = np.flatnonzero((way != 0) & (loop.moving[:-1] == surfaces).all(axis=1))[0]
            stiffness = np.diff(force)[here] / np.diff(x)[here]
            assert stiffness == pytest.approx(rise[there] / way[there], rel=1e-8)
    # Of a part only what slides in it; where nothing slides, and of other sliders, nothing.
    assert names(r.plot_hysteresis(time=(0, 0.5)).axes[0]) == []
    assert names(ss.integrate(ss.Coulomb(mu=0.1), quake).plot_hysteresis().axes[0]) == []
    # Of two flat surfaces the one with less friction slides alone until its stop.
    flat = ss.MultiPendulum([math.inf, math.inf], [0.02, 0.05], [0.01, 1])
    r = ss.integrate(flat, quake)
    assert names(r.plot_hysteresis().axes[0]) == ["1", "2"]
    one_by_one = sliding_surfaces(flat, r)
    assert not one_by_one.all(axis=1).any()


def test_the_command_slides_a_triple_pendulum(capsys, tmp_path):
    from stickslip.cli import main

    file = tmp_path / "quake.csv"
    file.write_text("\n".join(f"{0.1 * m:.1f}, {n:.17g}" for m, n in enumerate(RECORD)))
    options = [
        "--law",
        "pendulum",
        "--radii",
        "0.3937",
        "3.7465",
        "3.7465",
        "--mu",
        "0.01",
        "0.04",
        "0.08",
    ]
    assert main(["slide", str(file), "--units", "m/s^2", *options, "--json"]) == 0
    (row,) = json.loads(capsys.readouterr().out)["results"]
    r = ss.integrate(ss.TriplePendulum(TRIPLE["radii"], TRIPLE["mu"]), QUAKE, settle=True)
    assert row["peak_m"] == pytest.approx(r.peak, rel=1e-9)
    assert row["mu"] == TRIPLE["mu"]
    assert main(["slide", str(file), "--units", "m/s^2", *options]) == 0
    assert "0.01/0.04/0.08" in capsys.readouterr().out
    assert main(["slide", str(file), "--units", "m/s^2", "--mu", "0.1", "--radii", "1", "2"]) != 0
    assert "--radii goes with --law pendulum" in capsys.readouterr().err


def test_a_triple_pendulum_under_kobe(pyslammer_files):
    """Values of another program, in 34 digits: R.kobe.triple.ex3."""
    isolator = ss.TriplePendulum(**TRIPLE)
    quake = ss.sample_record("Kobe")
    r = ss.integrate(isolator, quake)
    assert r.peak == pytest.approx(0.4231874439188280956, rel=1e-12)
    assert r.residual == pytest.approx(-0.0203832981933738733514, abs=1e-13)
    assert r.displacement[1000] == pytest.approx(-0.112840893632902390, abs=1e-13)
    assert r.energy.dissipated == pytest.approx(1.980540582395944452994, rel=1e-12)
    assert r.elements.slides.tolist() == [56, 56, 24, 6]
    assert r.surfaces.displacement[:, -1].sum() == pytest.approx(r.residual, abs=1e-14)
    kinds = r.events["kind"]
    assert [(kinds == k).sum() for k in ("breakaway", "reversal", "arrest")] == [12, 44, 12]


def test_a_loop_knows_its_elements_and_surfaces():
    loop = ss.MultiPendulum([0.5, 2.0], [0.02, 0.09], [0.015, 0.20]).trace(
        [0.01, 0.05, -0.01, -0.1, 0.2, 0]
    )
    assert loop.elements.displacement[:, -1] == pytest.approx([-0.015, 0.015], abs=1e-15)
    assert loop.elements.slides.tolist() == [4, 4]
    assert loop.elements.stops.tolist() == loop.surfaces.stops.tolist() == [4, 0]
    assert loop.elements.dissipated == pytest.approx(G * loop.dissipated)
    triple = ss.TriplePendulum(**TRIPLE).trace([0.508, -0.508, 0.508, -0.508, 0])
    # Of another program, from bottom to top.
    assert triple.surfaces.displacement[:, -1] == pytest.approx(
        [0.055245, 0.011811, 0.027559, -0.094615], abs=1e-15
    )
    assert triple.surfaces.peak == pytest.approx(abs(triple.surfaces.displacement).max(axis=1))


# Halves of unequal capacity, whose last stop the bearing hits.
UNEQUAL = ss.TriplePendulum([0.3, 1.8, 2.6], [0.02, 0.05, 0.09], [0.09, 0.22, 0.31])


def test_at_the_last_stop_all_elements_are_at_theirs():
    n = np.arange(401)
    motion = ss.GroundMotion(0.9 * (2 * np.sin(0.7 * n) + 1.3 * np.cos(1.9 * n + 0.4)), dt=0.3)
    r = ss.integrate(UNEQUAL, motion)
    assert len(r.impacts) == 87  # as an independent program counts in 34 digits
    assert (r.elements.stops >= 87).all()
    assert (r.surfaces.stops >= 87).all()
    assert r.elements.stops[:2].tolist() == [87, 87]


def test_a_path_to_the_last_stop_and_back_stops_each_element_twice():
    most = UNEQUAL.capacity
    loop = UNEQUAL.trace([most, -most])
    assert loop.elements.stops.tolist() == [2, 2, 2, 2]
    assert UNEQUAL.trace([0.999 * most, -0.5 * most]).elements.stops.min() == 0


@pytest.mark.parametrize("contact", ["flight", "clipped"])
def test_the_losses_of_elements_are_those_of_the_bearing_with_landings(contact):
    rng = np.random.default_rng(11)
    n = np.arange(200)
    landings = 0
    for _ in range(20):
        w, f = rng.uniform(0.3, 2, 3), rng.uniform(0, 6, 3)
        motion = ss.GroundMotion(
            2 * np.sin(w[0] * n + f[0]) + 1.3 * np.cos(w[1] * n + f[1]),
            dt=0.1,
            vertical=14 * np.cos(w[2] * n + f[2]),
        )
        r = ss.integrate(UNEQUAL, motion, settle=True, contact=contact)
        landings += (r.events["kind"] == "landing").sum()
        assert r.elements.dissipated.sum() == pytest.approx(r.energy.dissipated, rel=1e-12)
    assert bool(landings > 100) is (contact == "flight")
