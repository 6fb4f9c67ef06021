"""Rigid blocks that rock, slide and fly: histories, records, sweeps, pictures, ASCE 43."""

import json
import math
import re
import warnings
from itertools import pairwise

import numpy as np
import pytest
import stickslip as ss
from pages import ROOT
from reference import rows
from stickslip import STANDARD_GRAVITY as G
from stickslip import cli


def motion_of(row):
    m = np.arange(201)
    n = row["factor"] * (2 * np.sin(0.7 * m) + 1.3 * np.cos(1.9 * m + 0.4))
    up = row.get("vertical", 0) * 2.5 * np.cos(0.5 * m + 0.2)
    return ss.GroundMotion(n, dt=0.1, vertical=up if "vertical" in row else None)


def block_of(row):
    b, h = row["b"], row["h"]
    left = row.get("b_left", b)
    return ss.RockingBlock(
        width=b + left,
        height=2 * h,
        mu=row["mu"],
        lever=row.get("lever"),
        center=((left - b) / 2, h),
        gyration_radius=math.sqrt((b**2 + h**2) / 3),
    )


ROWS = {row["id"]: row for row in rows("rocking", "rigid_blocks")}
BLOCK, QUAKE = block_of(ROWS["F.sliderock"]), motion_of(ROWS["F.sliderock"])


def test_a_history_equals_one_of_40_digits():
    row = ROWS["F.sliderock"]
    r = ss.integrate(BLOCK, QUAKE)
    assert r.peak_rotation == pytest.approx(row["peak"], abs=1e-12)
    assert r.residual == pytest.approx(row["base"], abs=1e-12)
    assert r.sliding_distance == pytest.approx(row["slid"], abs=1e-12)
    assert r.energy.friction == pytest.approx(row["friction"], abs=1e-12)
    assert (r.impacts, r.liftoffs, r.impacts_with_slip) == (row["impacts"], 0, 0)
    assert (r.block, r.motion, r.overturned) == (BLOCK, QUAKE, None)
    for i, rotation, base in row["samples"]:
        assert (r.rotation[i], r.displacement[i]) == pytest.approx((rotation, base), abs=1e-12)
    top = r.displacement + 2 * np.sin(r.rotation)
    assert r.top_displacement == pytest.approx(top, abs=1e-14)
    kinds = set(r.events["kind"].tolist())
    assert kinds == {"uplift", "slip", "stick", "impact", "end"}
    impact = r.events[r.events["kind"] == "impact"][0]
    assert impact["side"] * impact["rate"] > 0  # onto the corner toward which it turns
    assert impact["speed"] == pytest.approx(0.6 * abs(impact["rate"]), rel=1e-12)
    assert 0 < impact["rate_after"] / impact["rate"] <= BLOCK.restitution + 1e-12
    e = r.energy
    balance = e.initial + e.input - e.friction - e.impact - e.fall - e.kinetic - e.potential
    assert balance == pytest.approx(e.imbalance, abs=1e-13)
    assert abs(e.imbalance) < 1e-12
    assert math.isnan(r.condition)
    assert "m^2/s^2" in repr(e)


def test_flight_and_overturning():
    row = ROWS["F.flight.over"]
    r = ss.integrate(block_of(row), motion_of(row))
    assert r.overturned == "left"
    assert r.overturned_at == pytest.approx(row["time_overturned"], rel=1e-12)
    assert (r.liftoffs, r.rotation[-1]) == (3, -math.pi / 2)
    assert r.energy.fall > 0
    assert r.gap.max() > 0.01
    assert "not monotone" in r.remark
    assert "overturned to the left" in repr(r)
    assert r.state.overturned == "left"


@pytest.mark.parametrize("row", rows("rocking", "rigid_records"), ids=lambda row: row["record"])
def test_histories_under_records_equal_those_of_40_digits(pyslammer_files, row):
    r = ss.integrate(block_of(row), row["factor"] * ss.sample_record(row["record"]))
    assert (r.overturned, r.impacts, r.liftoffs) == (None, row["impacts"], 0)
    assert r.peak_rotation == pytest.approx(row["peak"], abs=row["compare"])
    assert r.residual == pytest.approx(row["base"], abs=row["compare"])
    assert r.energy.impact == pytest.approx(row["loss"], abs=row["compare"])
    for i, rotation, base in row["samples"]:
        assert (r.rotation[i], r.displacement[i]) == pytest.approx((rotation, base), abs=1e-12)


def test_a_block_and_its_properties():
    block = ss.RockingBlock(width=0.6, height=2, mu=0.5)
    assert (block.width, block.height, block.mu, block.lever) == (0.6, 2, 0.5, 1)
    assert block.alpha == block.alpha_left == pytest.approx(math.atan(0.3), rel=1e-15)
    assert block.p == pytest.approx(math.sqrt(3 * G / (4 * math.hypot(0.3, 1))), rel=1e-14)
    assert block.restitution == pytest.approx(1 - 1.5 * math.sin(block.alpha) ** 2, rel=1e-14)
    assert block.painleve_friction == pytest.approx(4 / 3, rel=1e-14)
    assert list(block.center) == [0, 1]
    assert ss.RockingBlock(width=0.6, height=2).mu is None
    given = {"restitution": 0.9, "center": (0.05, 0.8), "gyration_radius": 0.55}
    uneven = ss.RockingBlock(width=0.6, height=2, mu=0.5, **given)
    assert uneven.restitution == pytest.approx(0.9, rel=1e-14)
    assert uneven.restitution_left == pytest.approx(0.9, rel=1e-14)
    assert uneven.alpha < uneven.alpha_left
    assert uneven.p != uneven.p_left
    assert list(uneven.center) == pytest.approx([0.05, 0.8])


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"width": 0}, "width must be positive and finite, got 0 m"),
        ({"mu": -0.1}, "mu must be at least 0 and finite; .*got -0.1"),
        ({"restitution": 1.1}, "restitution must be from 0 to 1: .*got 1.1"),
        ({"restitution": "elastic"}, "'housner', got 'elastic'"),
        ({"lever": -1}, "lever must be at least 0: .*got -1"),
        ({"lever": 1, "restitution": 0.9}, "not both"),
        ({"center": (0.4, 1)}, "center must be above the base.*got 0.4 m"),
        ({"gyration_radius": 0}, "gyration_radius must be positive and finite, got 0 m"),
        ({"corner_restitution": 0.3}, "corner_restitution must be 0, got 0.3: corners that bounce"),
    ],
)
def test_bad_blocks_are_refused(arguments, message):
    with pytest.raises(ValueError, match=f"RockingBlock: .*{message}"):
        ss.RockingBlock(**{"width": 0.6, "height": 2, **arguments})


def test_implausible_blocks_warn():
    with pytest.warns(ss.PlausibilityWarning, match=r"mu = 1.4 is above 1.333.*Painleve"):
        ss.RockingBlock(width=0.6, height=2, mu=1.4)
    with pytest.warns(ss.PlausibilityWarning, match="p = 0.0839.*if width and height are in mm"):
        ss.RockingBlock(width=600, height=2000, mu=0.5)


def test_friction_that_decides_nothing_is_named():
    with pytest.warns(ss.PlausibilityWarning):
        block = ss.RockingBlock(width=0.6, height=2, mu=0.9, gyration_radius=math.sqrt(0.05))
    with pytest.raises(ss.ConvergenceError, match=r"theta = .* mu_P = 0.438"):
        ss.integrate(block, ss.GroundMotion([-60, -60], dt=0.1), rotation=0.1)


def test_advance_goes_where_integrate_goes():
    state, n = ss.RockingState(), QUAKE.acceleration
    slipped = False
    for start, end in pairwise(n.tolist()):
        state = ss.advance(BLOCK, state, 0.1, start, end)
        slipped |= state.slips
    r = ss.integrate(BLOCK, QUAKE)
    assert slipped
    assert state == r.state
    assert not state.in_flight
    flies = ss.advance(BLOCK, ss.RockingState(), 0.1, 0, vertical_start=-12)
    assert flies.in_flight
    assert "in flight" in repr(flies)


def test_the_motion_at_any_times():
    r = ss.integrate(BLOCK, QUAKE)
    rows = r.at(r.time)
    np.testing.assert_allclose(rows["rotation"], r.rotation, rtol=0, atol=1e-12)
    fine = ss.integrate(BLOCK, QUAKE.resampled(0.01))
    np.testing.assert_allclose(r.at(fine.time)["rotation"], fine.rotation, rtol=0, atol=1e-11)
    assert isinstance(r.at(0.55), ss.RockingState)


def test_a_restitution_that_slip_does_not_allow_is_counted():
    block = ss.RockingBlock(width=0.6, height=2, mu=0.2, restitution=0.98)
    r = ss.integrate(block, ss.GroundMotion([0, 0], dt=2), rotation=0.2, settle=True)
    assert r.impacts_with_slip > 0
    assert "the given restitution could not hold" in r.remark
    assert r.residual != 0
    assert r.at_rest


def test_sweeps_ensembles_and_critical_scales():
    blocks = ss.grid(ss.RockingBlock, width=[0.4, 0.6], height=2, mu=[0.15, 0.5])
    table = ss.sweep(blocks, QUAKE, scale=[0.5, 1], settle=True)
    for b, block in enumerate(blocks):
        for s, scale in enumerate((0.5, 1)):
            for k, sign in enumerate((1, -1)):
                r = ss.integrate(block, sign * scale * QUAKE, settle=True)
                at = (b, 0, s, k)
                assert table.peak_rotation[at] == r.peak_rotation
                assert table.residual[at] == r.residual
                assert table.sliding_distance[at] == r.sliding_distance
                assert table.impacts[at] == r.impacts
    assert (table.residual[0] != 0).all()  # mu below b/h: it only slides
    assert "residual" in table.to_dataframe().columns
    e = ss.run_ensemble(blocks[3], [QUAKE], members=2, seed=1)
    assert (e.residual == e.residual[0]).all()
    assert e.overturning().value in (0, 1)
    with pytest.raises(TypeError, match="as the first is a RockingBlock, all must be"):
        ss.sweep([blocks[0], ss.SlenderBlock(p=2, alpha=0.2, restitution=0.9)], QUAKE)
    ends = ss.critical_scales(blocks[3], QUAKE, up_to=3, steps=30)
    if len(ends):
        low = ends[0, 0]
        assert ss.integrate(blocks[3], 1.0001 * low * QUAKE, settle=True).overturned
        assert not ss.integrate(blocks[3], 0.9999 * low * QUAKE, settle=True).overturned


def test_tables_and_pictures(tmp_path):
    pytest.importorskip("matplotlib")
    r = ss.integrate(BLOCK, QUAKE)
    assert len(r.plot().axes) == 3
    r.plot_phase()
    r.animate(time=(0, 1), fps=4).write(tmp_path / "block.gif")
    document = json.loads(r.to_json())
    assert document["residual"] == r.residual
    assert document["displacement"] == r.displacement.tolist()
    assert "rate_after" in document["events"][0]
    assert "displacement of the base" in r._repr_html_()
    slender = ss.integrate(ss.SlenderBlock(p=2, alpha=0.2, restitution=0.9), QUAKE)
    assert not slender.displacement.any()
    with pytest.raises(ValueError, match="a SlenderBlock has no height"):
        slender.top_displacement.max()


def test_the_command_prints_what_the_library_finds(pyslammer_files, capsys):
    sizes = ["--width", "0.6", "--height", "2", "--mu", "0.25", "0.5"]
    assert cli.main(["rock", "sample:Kobe", *sizes, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)["results"]
    for row, mu in zip(found, (0.25, 0.5)):
        block = ss.RockingBlock(width=0.6, height=2, mu=mu)
        r = ss.integrate(block, ss.sample_record("Kobe"), settle=True)
        assert (row["mu"], row["base_displacement_m"]) == (mu, r.residual)
        assert row["peak_rotation_rad"] == r.peak_rotation
    assert cli.main(["rock", "sample:Kobe", *sizes]) == 0
    assert "base [cm]" in capsys.readouterr().out
    assert cli.main(["rock", "sample:Kobe", "--p", "2", "--alpha", "0.2", "--mu", "0.3"]) == 2
    assert "--mu is for a rigid block" in capsys.readouterr().err


def test_the_table_of_first_modes_is_what_the_blocks_do():
    page = (ROOT / "docs/guides/equipment.md").read_text()
    part = page[page.index("| b/h | mu = 0.2") :]
    lines = part[: part.index("\n\n")].splitlines()
    coefficients = [float(re.sub("mu = ", "", cell)) for cell in lines[0].split("|")[2:-1]]
    assert len(lines) > 6
    for line in lines[2:]:
        ratio, *cells = (cell.strip() for cell in line.split("|")[1:-1])
        for mu, cell in zip(coefficients, cells):
            block = ss.RockingBlock(width=2 * float(ratio), height=2, mu=mu)

            def after(load, block=block):
                return ss.advance(block, ss.RockingState(), 1e-5, -load * G)

            kind, level, *slips = cell.replace("(", "").replace(")", "").split()
            assert after(0.999 * float(level)).at_rest
            moved = after(1.001 * float(level))
            assert (moved.rotation > 0, moved.slips) == ((True, False), (False, True))[
                kind == "slides"
            ]
            if slips:
                assert not after(float(slips[0]) - 0.006).slips
                assert after(float(slips[0]) + 0.006).slips


def test_the_estimate_of_asce_43():
    quake = ss.HarmonicMotion(amplitude=4, omega=9, duration=20).sampled(0.01)
    block = ss.RockingBlock(width=0.6, height=2)
    e = ss.asce43_rocking(block, quake)
    a, theta = 0.3, e.rotation
    lift = math.cos(theta) + a * math.sin(theta) - 1
    inertia = 4 / 3 * (1 + a**2)
    gamma = -2 * math.log(1 - 2 * a**2 / inertia)
    assert 1 - 2 * a**2 / inertia == pytest.approx(block.restitution, rel=1e-14)  # Housner's
    assert e.damping_ratio == pytest.approx(gamma / math.hypot(2 * math.pi, gamma), rel=1e-12)
    f = math.sqrt(2 * G * lift / (inertia * theta**2)) / (2 * math.pi)
    assert e.frequency == pytest.approx(f, rel=1e-9)
    s = ss.response_spectrum(quake, [1 / f], e.damping_ratio, kind="pseudo_acceleration").values
    assert np.ravel(s)[0] == pytest.approx(2 * G * lift / theta, rel=1e-6)
    same = ss.asce43_rocking(ss.SlenderBlock.from_size(width=0.6, height=2), quake)
    assert same.rotation == pytest.approx(e.rotation, rel=1e-9)
    assert ss.asce43_rocking(block, 0.5 * quake).rotation == 0  # it does not rock
    assert ss.asce43_rocking(block, 30 * quake).overturns
    with pytest.raises(ValueError, match="too squat"):
        ss.asce43_rocking(ss.RockingBlock(width=2, height=1), quake)
    with pytest.raises(TypeError, match="block must be"):
        ss.asce43_rocking(ss.Coulomb(mu=0.1), quake)


def test_the_estimate_of_asce_43_beside_peaks_is_as_the_page_says(pyslammer_files):
    ratios, called_of_fallen, called_of_standing = [], [], []
    for width, height in [(0.4, 2), (0.5, 1.6), (0.6, 2), (0.8, 2), (1, 2)]:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ss.PlausibilityWarning)  # alpha above 0.35
            block = ss.SlenderBlock.from_size(width=width, height=height)
        for quake in ss.sample_records():
            r, e = ss.integrate(block, quake, settle=True), ss.asce43_rocking(block, quake)
            if r.overturned:
                called_of_fallen.append(e.overturns)
            elif r.time_rocking > 0:
                called_of_standing.append(e.overturns)
                if not e.overturns and e.rotation > 0:
                    ratios.append(e.rotation / r.peak_rotation)
    low, median, high = np.percentile(ratios, [16, 50, 84])
    fallen, standing = len(called_of_fallen), len(called_of_standing)
    page = re.sub(r"\s+", " ", (ROOT / "docs/rocking.md").read_text())
    assert f"{median:.2f} of the peak in the median, {low:.2f} and {high:.2f} at 16" in page
    assert f"Of {standing} histories that rock and stand it calls {sum(called_of_standing)}" in page
    below = fallen - sum(called_of_fallen)
    assert f"of {fallen} that overturn, {below} have an estimate below alpha" in page
