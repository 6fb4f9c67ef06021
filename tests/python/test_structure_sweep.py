"""Sweeps of structures, and motions of floors, against loops of `integrate`."""

from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor

import numpy as np
import pytest
import stickslip as ss


def quake(
    seed: int, strength: float = 3.0, up: bool = False, samples: int = 300
) -> ss.GroundMotion:
    random = np.random.default_rng(seed)
    t = np.arange(samples) / samples
    n = random.normal(0, strength, samples) * t * (1 - t) * 4
    vertical = random.normal(0, 2, samples) if up else None
    return ss.GroundMotion(n - n.mean(), dt=0.02, vertical=vertical, name=f"quake {seed}")


QUAKES = ss.Suite([quake(1), quake(2), quake(3)], {"magnitude": [5.5, 6.0, 7.0]})
UP = ss.Suite([quake(4, up=True), quake(5, up=True)])
BUILDING = ss.Structure.shear_building(
    masses=[1, 1, 0.8], stiffnesses=[600, 500, 400], damping_ratio=0.03
)
DASHPOT = ss.Structure(BUILDING.mass, BUILDING.damping + np.diag([2.0, 0, 0]), BUILDING.stiffness)
COLUMN = {"height": [40.0], "shear_velocity": [300.0]}
LEVELS = [0.02, 0.05, 0.1]
STOPS = ss.Slider(ss.Coulomb(mu=0.03), stops=ss.Stops(gap=0.01, restitution=0.4))


def check_equal(
    structures: Sequence, suite: ss.Suite, settle: bool = False, tolerance: float = 1e-12
) -> ss.SweepTable:
    """The table equals a loop over `integrate`, relative to the largest displacement."""
    table = ss.sweep(structures, suite, polarity="both", settle=settle)
    assert table.peak.shape == (len(structures), len(suite), 2)
    assert not table.failures
    for s, structure in enumerate(structures):
        for r, motion in enumerate(suite):
            for p, sign in enumerate((1, -1)):
                one = ss.integrate(structure, motion * sign, settle=settle)
                at = s, r, p
                allowed = tolerance * max(one.sliding_distance, 1e-3)
                assert abs(table.peak[at] - one.peak) <= allowed, (structure, motion, sign)
                assert abs(table.residual[at] - one.residual) <= allowed
                assert abs(table.sliding_distance[at] - one.sliding_distance) <= allowed
                assert table.events[at] == len(one.events) - 1
    assert table.peak.max() > 1e-3
    return table


@pytest.mark.parametrize("suite", [QUAKES, UP], ids=["level", "vertical"])
@pytest.mark.parametrize("modes", [1, 3])
def test_slopes_in_both_ways_and_polarities(suite: ss.Suite, modes: int) -> None:
    slopes = ss.grid(
        ss.FlexibleSlope,
        ky_g=LEVELS,
        **COLUMN,
        damping_ratio=[0.1],
        method=["coupled", "decoupled"],
        modes=modes,
    )
    table = check_equal(slopes, suite, settle=True)
    assert (table.residual > 0).any()
    assert (table.residual >= 0).all()  # never uphill
    assert (np.diff(table.peak[::2], axis=0) <= 0).all()  # stronger slopes slide less
    # The columns that a slope is known by, with those of the grid that vary.
    assert list(table.parameters) == ["ky_g", *COLUMN, "damping_ratio", "method"]
    mirrored = ss.sweep(slopes, [-motion for motion in suite], polarity="reversed", settle=True)
    np.testing.assert_array_equal(mirrored.peak[..., 0], table.peak[..., 0])


def test_slopes_on_rock_of_soil_and_with_a_level_that_degrades() -> None:
    rock = ss.grid(ss.FlexibleSlope, ky_g=LEVELS, **COLUMN, rock_velocity=[600.0, 1500.0])
    soil = ss.grid(
        ss.FlexibleSlope, ky_g=LEVELS, **COLUMN, soil=ss.HyperbolicSoil(reference_strain=1e-3)
    )
    laws = [ss.Degrading(distance=[0, 0.02], ky_g=[k, k / 2]) for k in LEVELS]
    softening = ss.grid(
        ss.FlexibleSlope, ky_g=laws, **COLUMN, damping_ratio=0.1, method=["coupled", "decoupled"]
    )
    check_equal(rock, QUAKES)
    check_equal(soil, QUAKES)
    table = check_equal(softening, QUAKES, settle=True)
    constant = ss.grid(
        ss.FlexibleSlope, ky_g=LEVELS, **COLUMN, damping_ratio=0.1, method=["coupled", "decoupled"]
    )
    assert (table.peak >= ss.sweep(constant, QUAKES, settle=True).peak).all()


@pytest.mark.parametrize("suite", [QUAKES, UP], ids=["level", "vertical"])
@pytest.mark.parametrize("building", [BUILDING, DASHPOT], ids=["classical", "dashpot"])
def test_isolated_buildings_and_equipment(suite: ss.Suite, building: ss.Structure) -> None:
    laws = ss.grid(ss.Coulomb, mu=LEVELS)
    sprung = ss.grid(ss.Slider, law=laws, natural_frequency=2.0, damping=0.1)
    isolated = ss.grid(
        ss.IsolatedStructure, slider=[*laws, *sprung], structure=building, base_mass=1
    )
    racks = ss.grid(
        ss.EquipmentOnFloor, slider=laws, structure=building, floor=[1, 3], mass=[0.0, 0.2]
    )
    table = check_equal([*isolated, *racks], suite)
    assert table.parameters == {}
    assert ss.sweep(racks, suite[:1]).parameters["floor"].tolist() == [1, 1, 3, 3] * 3


def test_unequal_levels_static_friction_pendulums_and_speed() -> None:
    sliders = [
        ss.Coulomb(mu=0.03, backward=0.6),
        ss.StaticKinetic(ss.Coulomb(mu=0.03), static=0.05 * ss.STANDARD_GRAVITY),
        ss.FrictionPendulum(mu=0.03, radius=2.0),
        ss.VelocityDependent(mu_slow=0.02, mu_fast=0.05, rate=20),
    ]
    check_equal([ss.IsolatedStructure(s, BUILDING, base_mass=1) for s in sliders], QUAKES)


@pytest.mark.parametrize("building", [BUILDING, DASHPOT], ids=["classical", "dashpot"])
def test_settled_structures(building: ss.Structure) -> None:
    laws = [
        ss.Coulomb(mu=0.03),
        ss.Coulomb(mu=0.02, backward=0.6),
        ss.StaticKinetic(mu_static=0.05, mu_kinetic=0.03),
        ss.Slider(ss.Coulomb(mu=0.02), natural_frequency=2.0, damping=0.1),
        ss.Slider(ss.Coulomb(mu=0.03), natural_frequency=2.0, one_way=True),
        ss.FrictionPendulum(mu=0.03, radius=2.0),
    ]
    isolated = ss.grid(ss.IsolatedStructure, slider=laws, structure=building, base_mass=1)
    racks = ss.grid(
        ss.EquipmentOnFloor, slider=laws, structure=building, floor=[1, 3], mass=[0.0, 0.2]
    )
    check_equal([*isolated, *racks], QUAKES[:1], settle=True)
    check_equal(isolated, UP[:1], settle=True)
    check_equal([ss.IsolatedStructure(STOPS, building, base_mass=1)], QUAKES, True, 1e-9)


def test_settled_slopes_of_soil() -> None:
    soil = ss.HyperbolicSoil(reference_strain=1e-3)
    methods = ["coupled", "decoupled"]
    slopes = ss.grid(ss.FlexibleSlope, ky_g=LEVELS, **COLUMN, soil=soil, method=methods)
    check_equal(slopes, QUAKES, settle=True)


def test_stops_and_their_impacts() -> None:
    structure = ss.IsolatedStructure(STOPS, BUILDING, base_mass=1)
    table = check_equal([structure], QUAKES, tolerance=1e-9)
    hits = ss.integrate(structure, QUAKES[0]).impacts
    forward = hits[hits["displacement"] > 0]
    assert table.impacts_forward[0, 0, 0] == len(forward) > 0
    assert table.impact_speed_forward[0, 0, 0] == pytest.approx(
        abs(forward["velocity"]).max(), rel=1e-9
    )
    np.testing.assert_allclose(table.impacts_forward[..., 0], table.impacts_backward[..., 1])


def test_uneven_times_and_held_values() -> None:
    times = np.cumsum(np.random.default_rng(1).uniform(0.01, 0.04, 300))
    uneven = ss.GroundMotion(QUAKES[0].acceleration, times=times - times[0])
    held = ss.GroundMotion(QUAKES[1].acceleration, dt=0.02, interpolation="constant")
    slopes = ss.grid(ss.FlexibleSlope, ky_g=LEVELS, **COLUMN, damping_ratio=0.1)
    check_equal(slopes, ss.Suite([uneven, held]))


def test_random_structures() -> None:
    def isolated(mu: float) -> ss.IsolatedStructure:
        return ss.IsolatedStructure(ss.Coulomb(mu=mu), BUILDING, base_mass=1)

    random = ss.Random(isolated, mu=ss.Uniform(0.02, 0.1))
    table = ss.sweep(random, QUAKES, members=4, seed=7)
    drawn = random.sample(seed=7, member=2)
    assert table.parameters["mu"].shape == (4,)
    assert table.peak[2, 1, 1] == pytest.approx(ss.integrate(drawn, -QUAKES[1]).peak, rel=1e-12)


# ---- the table


def test_tables_go_to_frames_files_and_back(tmp_path) -> None:
    pytest.importorskip("pandas")
    slopes = ss.grid(
        ss.FlexibleSlope,
        ky_g=LEVELS,
        height=[20.0, 40.0],
        shear_velocity=[300.0],
        damping_ratio=[0.1],
        method=["coupled", "decoupled"],
    )
    table = ss.sweep(slopes, QUAKES, polarity="both", settle=True)
    frame = table.to_dataframe()
    assert len(frame) == table.peak.size == 72
    assert frame.attrs["units"] == dict.fromkeys(("peak", "residual", "sliding_distance"), "m")
    (row,) = frame[
        (frame.ky_g == 0.05)
        & (frame.height == 40)
        & (frame.method == "decoupled")
        & (frame.magnitude == 7)
        & (frame.polarity == "reversed")
    ].itertuples()
    exact = ss.FlexibleSlope(ky_g=0.05, height=40, shear_velocity=300, damping_ratio=0.1)
    assert row.residual == pytest.approx(exact.decoupled(-QUAKES[2]).residual, rel=1e-12)
    assert ss.SweepTable.from_json(table.to_json()) == table
    pytest.importorskip("xarray")
    pytest.importorskip("h5py")
    data = table.to_xarray()
    assert data.peak.dims[-2:] == ("record", "polarity")
    assert data.peak.attrs["units"] == "m"
    # A keyword `method` of `sel` is its own.
    there = data.sel({"ky_g": 0.05, "height": 40, "method": "decoupled", "polarity": "reversed"})
    assert there.residual.values[..., -1].item() == row.residual
    assert ss.SweepTable.open(table.save(tmp_path / "t.h5")) == table
    pytest.importorskip("matplotlib")
    (axes,) = table.plot(against="ky_g").axes
    assert len(axes.get_lines()) == 4  # each height by each method


def test_tables_of_racks_have_impacts_only_with_stops() -> None:
    pytest.importorskip("pandas")
    rack = ss.EquipmentOnFloor(ss.Coulomb(mu=0.1), BUILDING, floor=2)
    assert "impacts_forward" not in ss.sweep(rack, QUAKES).to_dataframe()
    with pytest.raises(ValueError, match="no slider has stops"):
        _ = ss.sweep(rack, QUAKES).impacts_forward
    stopped = ss.EquipmentOnFloor(STOPS, BUILDING, floor=2)
    frame = ss.sweep([rack, stopped], QUAKES).to_dataframe()
    assert frame.attrs["units"]["impact_speed_forward"] == "m/s"


# ---- runs


def test_progress_interruption_executors_and_checkpoints(tmp_path) -> None:
    slopes = ss.grid(ss.FlexibleSlope, ky_g=LEVELS, **COLUMN, damping_ratio=0.1)
    told: list[tuple[int, int]] = []
    whole = ss.sweep(slopes, QUAKES, progress=lambda *p: told.append(p))
    assert told[-1] == (18, 18)
    assert ss.sweep(slopes, QUAKES, threads=1) == whole
    with ProcessPoolExecutor(2) as pool:
        assert ss.sweep(slopes, QUAKES, executor=pool) == whole
    file = tmp_path / "sweep.npz"

    class Enough(Exception): ...

    def stop(done: int, total: int) -> None:
        raise Enough

    with pytest.raises(Enough):
        ss.sweep(slopes, QUAKES, progress=stop)
    with pytest.raises(Enough):
        ss.sweep(slopes, QUAKES, progress=stop, checkpoint=file)
    assert ss.sweep(slopes, QUAKES, checkpoint=file) == whole
    other = ss.grid(ss.FlexibleSlope, ky_g=LEVELS, **COLUMN, damping_ratio=0.11)
    with pytest.raises(ValueError, match="is of another sweep"):
        ss.sweep(other, QUAKES, checkpoint=file)


def test_one_record_that_fails_ends_nothing() -> None:
    # An undamped column that has once been set in motion moves a weak block for ever.
    slopes = ss.grid(
        ss.FlexibleSlope, ky_g=[0.005, 0.7], **COLUMN, method="decoupled", damping_ratio=0.0
    )
    weak, strong = quake(6, strength=5e-3), quake(7)
    with pytest.warns(RuntimeWarning, match="1 of 6 combinations failed.*slider 0 under record 1"):
        table = ss.sweep(slopes, [weak, strong, weak], polarity="recorded", settle=True)
    (failure,) = table.failures
    assert (failure.slider, failure.record, failure.polarity) == (0, 1, "recorded")
    assert "does not come to rest within 1000000 steps of 0.02 s" in failure.message
    assert "inf" not in failure.message
    assert np.isnan(table.peak[0, 1, 0])
    assert table.events[0, 1, 0] == 0
    assert np.isfinite(table.peak[0, [0, 2]]).all()
    assert np.isfinite(table.peak[1]).all()
    assert ss.SweepTable.from_json(table.to_json()) == table


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (
            lambda: ss.grid(ss.FlexibleSlope, ky_g=[0.1, -0.1], **COLUMN),
            r"grid: with \{'ky_g': -0\.1, .*ky_g must be finite and at least 0, got -0\.1 g",
        ),
        (
            lambda: ss.grid(ss.FlexibleSlope, ky_g=[0.1], height=[-3.0], shear_velocity=[300.0]),
            r"height must be positive and finite, got -3 m",
        ),
        (
            lambda: ss.grid(ss.FlexibleSlope, ky_g=[0.1], **COLUMN, method=["rigid"]),
            "method must be 'coupled' or 'decoupled', got 'rigid'",
        ),
        (
            lambda: ss.grid(
                ss.EquipmentOnFloor,
                slider=ss.grid(ss.Coulomb, mu=LEVELS),
                structure=BUILDING,
                floor=[1, 4],
            ),
            "floor must be from 1 to 3, got 4",
        ),
        (lambda: ss.sweep([], QUAKES), "needs at least one slider, got an empty list"),
        (lambda: ss.sweep(SLOPE, []), "needs at least one ground motion, got an empty list"),
        (lambda: ss.sweep(SLOPE, QUAKES, polarity="up"), "polarity must be .*, got 'up'"),
        (
            lambda: ss.sweep(SLOPE, QUAKES, contact="hop"),
            "sweep: contact must be 'flight' or 'clipped', got 'hop'",
        ),
    ],
)
def test_bad_values(make, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        make()


SLOPE = ss.FlexibleSlope(ky_g=0.05, height=40, shear_velocity=300, damping_ratio=0.1)


def test_bad_types() -> None:
    with pytest.raises(
        TypeError, match=r"sliders\[0\] is of type FlexibleSlope, sliders\[1\] of type Coulomb"
    ):
        ss.sweep([SLOPE, ss.Coulomb(mu=0.1)], QUAKES)
    with pytest.raises(TypeError, match=r"sliders\[0\] must be a .* or structure, got Structure"):
        ss.sweep([BUILDING], QUAKES)
    with pytest.raises(TypeError, match="FlexibleSlope: has no argument 'ky'"):
        ss.grid(ss.FlexibleSlope, ky=[0.1], **COLUMN)
    harmonic = ss.HarmonicMotion(amplitude=1, omega=1, duration=10)
    for motions in (harmonic, [harmonic]):
        with pytest.raises(TypeError, match=r"must be a GroundMotion.*, got HarmonicMotion"):
            ss.sweep(SLOPE, motions)


# ---- motions of floors


def test_floor_motions_are_the_accelerations_of_the_floors() -> None:
    for building in (BUILDING, DASHPOT):
        for motion in (QUAKES[0], UP[0]):
            floors = building.floor_motions(motion)
            assert isinstance(floors, ss.Suite)
            assert floors.names == tuple(f"{motion.name} floor {i}" for i in (1, 2, 3))
            assert floors.floor.tolist() == [1, 2, 3]
            # Equipment too heavy in friction to slide and too light to matter.
            bolted = ss.EquipmentOnFloor(ss.Coulomb(slip_level=1e6), building, floor=1, mass=1e-12)
            response = ss.integrate(bolted, motion)
            assert response.slips == 0
            largest = abs(response.floors.acceleration).max()
            for k, floor in enumerate(floors):
                assert floor.dt == motion.dt
                np.testing.assert_allclose(
                    floor.acceleration, response.floors.acceleration[:, k], atol=1e-10 * largest
                )
                if motion.vertical is not None:
                    np.testing.assert_array_equal(floor.vertical, motion.vertical)
            fine = building.floor_motions(motion, parts=4)
            assert len(fine[0]) == 4 * (len(motion) - 1) + 1
            np.testing.assert_allclose(
                fine[2].acceleration[::4], floors[2].acceleration, atol=1e-12 * largest
            )


def test_the_error_of_light_sliders_is_the_stated_one(pyslammer_files) -> None:
    """Errors of peaks above 1 cm in the docstring: 0.1 % in the median, 6.3 % at most."""
    tall = ss.Structure.shear_building(
        masses=[2e5] * 10, stiffnesses=[4e8] * 10, damping_ratio=0.03
    )
    blocks = ss.grid(ss.Coulomb, mu=[0.05, 0.1, 0.2, 0.3])
    racks = ss.grid(ss.EquipmentOnFloor, slider=blocks, structure=tall, floor=[1, 4, 7, 10])
    suite = ss.sample_records()
    exact = ss.sweep(racks, suite).peak.reshape(4, 4, len(suite), 2)
    medians, largest = [], []
    for parts in (1, 2):
        floors = [tall.floor_motions(motion, parts=parts) for motion in suite]
        chosen = [each[f - 1] for each in floors for f in (1, 4, 7, 10)]
        # (law, record, floor, polarity) to (law, floor, record, polarity)
        found = ss.sweep(blocks, chosen).peak.reshape(4, len(suite), 4, 2).swapaxes(1, 2)
        slid = exact > 0.01
        error = abs(found[slid] / exact[slid] - 1)
        medians.append(np.median(error))
        largest.append(error.max())
    assert medians[0] == pytest.approx(1e-3, rel=0.5)
    assert largest[0] < 0.063
    # Two parts make it a quarter, as of any error of second order.
    assert medians[1] == pytest.approx(medians[0] / 4, rel=0.15)
    assert largest[1] == pytest.approx(largest[0] / 4, rel=0.6)


def test_many_light_sliders_on_all_floors_in_one_call() -> None:
    blocks = ss.grid(ss.Coulomb, mu=np.arange(1, 101) / 200)
    floors = BUILDING.floor_motions(QUAKES[0])
    table = ss.sweep(blocks, floors)
    assert table.peak.shape == (100, 3, 2)
    assert table.metadata["floor"].tolist() == [1, 2, 3]
    assert table.metadata["pga_g"] == pytest.approx(floors.pga_g)
    frame = table.to_dataframe()
    assert len(frame[frame.floor == 3]) == 200
    for mu, floor in ((9, 1), (29, 2), (49, 3)):
        one = ss.integrate(blocks[mu], floors[floor - 1]).peak
        assert table.peak[mu, floor - 1, 0] == pytest.approx(one, rel=1e-12, abs=1e-13)
    # What does not break loose, breaks loose nowhere below that floor's largest acceleration.
    still = table.peak[:, :, 0].T == 0
    levels = np.array([block.slip_level for block in blocks])
    for k, floor in enumerate(floors):
        np.testing.assert_array_equal(still[k], levels >= abs(floor.acceleration).max())
    # Also what motions of floors are not made for: pendulums, springs, stops.
    others = [
        ss.FrictionPendulum(mu=0.05, radius=1),
        ss.Slider(ss.Coulomb(mu=0.1), stops=ss.Stops(gap=0.02, restitution=0.5)),
    ]
    several = ss.sweep(others, floors, settle=True)
    assert several.peak[1, 2, 0] == ss.integrate(others[1], floors[2], settle=True).peak


def test_bad_floor_motions() -> None:
    bare = ss.Structure.from_modes(mass_fractions=[0.7], frequencies=[8.0], damping_ratios=[0.05])
    with pytest.raises(ValueError, match="needs a structure with floors; give from_modes the shap"):
        bare.floor_motions(QUAKES[0])
    with pytest.raises(ValueError, match="parts must be at least 1, got 0"):
        BUILDING.floor_motions(QUAKES[0], parts=0)
    with pytest.raises(TypeError, match=r"parts must be an integer, got 1\.5"):
        BUILDING.floor_motions(QUAKES[0], parts=1.5)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="motion must be a GroundMotion, got 3"):
        BUILDING.floor_motions(3)  # type: ignore[arg-type]
    with pytest.warns(ss.PlausibilityWarning):
        resonant = ss.GroundMotion(9e99 * np.sin(11 * 0.1 * np.arange(100)), dt=0.1)
    with pytest.raises(OverflowError, match=r"floors exceed 1e100 m/s\^2"):
        BUILDING.floor_motions(resonant)
