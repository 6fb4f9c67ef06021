"""Response spectra of the floors of structures with one sliding interface."""

import warnings

import numpy as np
import pytest
import stickslip as ss

PERIODS = [0.2, 0.5, 1.0, 2.0]
NOISE = np.convolve(np.random.default_rng(5).standard_normal(600), np.ones(5) / 5, "same")
QUAKE = ss.GroundMotion(4 * NOISE * np.sin(np.linspace(0, np.pi, 600)), dt=0.02)  # from 0 to 0
BUILDING = ss.Structure.shear_building(
    masses=[1, 1, 0.8], stiffnesses=[600, 500, 400], damping_ratio=0.05
)
# With w = 2e4 rad/s it follows the base 2 zeta / w = 3e-5 s late. After a kink of the ground motion
# at a sample that is 1.5e-3 of the change over a step.
with warnings.catch_warnings():
    warnings.simplefilter("ignore", ss.PlausibilityWarning)
    RIGID = ss.Structure.shear_building(masses=[1], stiffnesses=[4e8], damping_ratio=0.3)
NEVER, SLIDES = ss.Coulomb(slip_level=1e4), ss.Coulomb(mu=0.1)


def isolated(law, structure, quake=QUAKE):
    return ss.integrate(ss.IsolatedStructure(law, structure, base_mass=1), quake, settle=True)


def values(response, floor=None, periods=PERIODS, **options):
    return ss.response_spectrum(response, periods, floor=floor, **options).values


def test_a_base_that_does_not_slide_moves_with_the_ground():
    r = isolated(NEVER, BUILDING)
    ground = ss.response_spectrum(QUAKE, PERIODS).values
    np.testing.assert_allclose(values(r, 0), ground, rtol=1e-12)
    np.testing.assert_allclose(values(r), ground, rtol=1e-12)
    assert (abs(values(r, 3) / ground - 1) > 0.2).any()


def test_the_floor_of_a_rigid_building_moves_with_the_base():
    r = isolated(NEVER, RIGID)
    np.testing.assert_allclose(values(r, 1), values(r, 0), rtol=1.5e-3)
    slides = isolated(SLIDES, RIGID)
    # As a rigid slider, whose spectrum has its jumps where they are.
    exact = values(ss.integrate(SLIDES, QUAKE, settle=True))
    np.testing.assert_allclose(values(slides), exact, rtol=0.01)
    assert (abs(exact / values(r, 0) - 1) > 0.1).all()


def test_equipment_on_a_rigid_building_is_a_slider_on_the_ground():
    law = ss.Slider(SLIDES, period=2, damping_ratio=0.1)
    quake = ss.GroundMotion(QUAKE.acceleration, dt=0.02, vertical=3 * np.sin(np.arange(600.0)))
    on_ground = ss.integrate(law, quake, settle=True, contact="clipped", velocity=0.2)
    r = ss.integrate(ss.EquipmentOnFloor(law, RIGID, floor=1), quake, settle=True, velocity=0.2)
    np.testing.assert_allclose(values(r), values(on_ground), rtol=1.5e-3)
    np.testing.assert_allclose(
        values(r, 0), ss.response_spectrum(quake, PERIODS).values, rtol=1e-12
    )


@pytest.mark.parametrize(
    ("system", "floor"),
    [
        (ss.IsolatedStructure(SLIDES, BUILDING, base_mass=1), 3),
        (ss.EquipmentOnFloor(SLIDES, BUILDING, floor=3, mass=0.1), 1),
        (ss.EquipmentOnFloor(SLIDES, BUILDING, floor=3), None),
    ],
    ids=["isolated", "floor with equipment", "equipment"],
)
def test_finer_samples_leave_less_error(system, floor):
    """Of straight lines between samples the error is of the second order."""
    coarse, fine, finest = (
        values(ss.integrate(system, QUAKE.resampled(0.02 / k), settle=True), floor)
        for k in (1, 4, 16)
    )
    error = abs(coarse / finest - 1).max()
    assert 0 < abs(fine / finest - 1).max() < error / 4
    assert error < 0.2


@pytest.mark.filterwarnings("ignore:.* periods = :stickslip.PlausibilityWarning")
def test_the_base_of_a_slope_has_its_velocities_and_its_peak():
    slope = ss.FlexibleSlope(ky_g=0.05, height=50, shear_velocity=600, damping_ratio=0.05)
    r = slope.coupled(QUAKE)
    assert values(r, 0, [0.0]) == pytest.approx(r.peak_base_acceleration, rel=0.05)
    assert values(r, 0, [0.0]) <= r.peak_base_acceleration
    # An oscillator of 200 s barely moves: it sees the base travel.
    times = np.arange(len(r.time)) * QUAKE.dt
    n = np.zeros(len(times))
    n[: len(QUAKE)] = QUAKE.acceleration
    velocity = np.append(0, np.cumsum((n[1:] + n[:-1]) / 2)) * QUAKE.dt + r.velocity
    travel = np.append(0, np.cumsum((velocity[1:] + velocity[:-1]) / 2)) * QUAKE.dt
    (seen,) = values(r, 0, [200.0], damping=0.0, kind="velocity")
    assert seen == pytest.approx(abs(velocity).max(), rel=0.05)
    assert abs(travel).max() < 50  # else the oscillator would not rest


@pytest.mark.parametrize("interpolation", ["linear", "constant"])
def test_uneven_times(interpolation):
    """Those of every second sample: the same motion if they are even."""
    quake = ss.GroundMotion(QUAKE.acceleration, dt=0.02, interpolation=interpolation)
    uneven = ss.GroundMotion(
        QUAKE.acceleration, times=np.arange(600) * 0.02, interpolation=interpolation
    )
    for floor in (0, 2):
        np.testing.assert_allclose(
            values(isolated(SLIDES, BUILDING, uneven), floor),
            values(isolated(SLIDES, BUILDING, quake), floor),
            rtol=1e-6,
        )


def test_what_has_no_spectrum():
    r = isolated(SLIDES, BUILDING)
    for floor in (-1, 4):
        with pytest.raises(ValueError, match=f"floor must be from 0, the base, to 3, got {floor}"):
            values(r, floor)
    with pytest.raises(TypeError):
        values(r, 1.5)
    modes = ss.Structure.from_modes(mass_fractions=[0.7], frequencies=[8.0], damping_ratios=[0.05])
    without = ss.integrate(ss.IsolatedStructure(SLIDES, modes), QUAKE)
    assert (values(without, 0) > 0).all()
    with pytest.raises(ValueError, match=r"no floors, got floor=1; give Structure\.from_modes the"):
        values(without, 1)
    with pytest.raises(ValueError, match="floor needs the response of a structure, got a GroundM"):
        values(QUAKE, 1)
    with pytest.raises(ValueError, match="direction needs a ground motion or a response with two"):
        values(r, 1, direction=90)
    slope = ss.FlexibleSlope(ky_g=0.05, height=50, shear_velocity=600, damping_ratio=0.05)
    with pytest.raises(
        ValueError, match="decoupled analysis is not part of the column; give floor"
    ):
        values(slope.decoupled(QUAKE))
    stops = ss.Slider(SLIDES, stops=ss.Stops(gap=1e-3, restitution=0.5))
    hits = isolated(stops, BUILDING)
    assert len(hits.impacts)
    with pytest.raises(ValueError, match="impacts on stops are impulses on the structure"):
        values(hits, 3)
    light = ss.integrate(ss.EquipmentOnFloor(stops, BUILDING, floor=3), QUAKE, settle=True)
    assert len(light.impacts)
    assert (values(light) > values(light, 3)).any()


def test_what_stands_on_the_ground_has_its_spectrum_under_held_values_and_jumps_too():
    held = {"interpolation": "constant"}
    jumps = ss.GroundMotion([0, 3.0, -3.0, 2.0, 0, 0], times=[0, 0.2, 0.2, 0.4, 0.4, 0.6], **held)
    even = ss.GroundMotion([0, 3.0, -3.0, 2.0, 0, 1.0, -1.0, 0], dt=0.2, name="even", **held)
    for motion in (even, jumps):
        r = ss.integrate(ss.EquipmentOnFloor(SLIDES, BUILDING, floor=2), motion)
        base = ss.response_spectrum(r, PERIODS, floor=0)
        assert np.array_equal(base.values, ss.response_spectrum(motion, PERIODS).values)
        assert base.name == ("base, even" if motion is even else "base")
        if motion is jumps:
            with pytest.raises(ValueError, match="two samples of equal time"):
                ss.response_spectrum(r, PERIODS, floor=1)
    with pytest.raises(TypeError, match="response_spectrum: floor must be"):
        ss.response_spectrum(r, PERIODS, floor=1.5)
