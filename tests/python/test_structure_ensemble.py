"""Ensembles of structures with a sliding interface, as Python users see them."""

import numpy as np
import pytest
import stickslip as ss

NOISE = ss.GaussianExcitation(
    ss.Spectrum.kanai_tajimi(s0=0.01, frequency=12.0, damping=0.6), dt=0.02, samples=257
)
BUILDING = ss.Structure.shear_building(
    masses=[1, 1, 0.8], stiffnesses=[600, 500, 400], damping_ratio=0.03
)
BEARING = ss.Slider(ss.Coulomb(slip_level=0.5), natural_frequency=1.5)
ISOLATED = ss.IsolatedStructure(BEARING, BUILDING, base_mass=1)
RACK = ss.EquipmentOnFloor(ss.Coulomb(slip_level=0.7), BUILDING, floor=2, mass=0.1)
SLOPE = ss.FlexibleSlope(ky_g=0.04, height=40, shear_velocity=300, damping_ratio=0.1)


@pytest.fixture(scope="module")
def ensemble() -> ss.Ensemble:
    return ss.run_ensemble(ISOLATED, NOISE, members=70, seed=5, settle=True)


def test_members_are_those_of_integrate(ensemble: ss.Ensemble) -> None:
    assert ensemble.has_floors
    responses = [
        ss.integrate(ISOLATED, NOISE.sample(seed=5, member=i), settle=True) for i in range(70)
    ]
    for name in ("peak", "residual", "peak_base_acceleration", "peak_base_shear"):
        values = [getattr(r, name) for r in responses]
        np.testing.assert_allclose(getattr(ensemble, name), values, rtol=1e-9, atol=1e-12)
    accelerations, drifts = ensemble.peak_floor_acceleration, ensemble.peak_floor_drift
    assert accelerations.values.shape == (70, 3)
    for found, name in ((accelerations, "peak_acceleration"), (drifts, "peak_drift")):
        values = np.array([getattr(r.floors, name) for r in responses])
        np.testing.assert_allclose(found.values, values, rtol=1e-9)
        np.testing.assert_allclose(found.mean, values.mean(0), rtol=1e-12)
        np.testing.assert_allclose(found.std, values.std(0, ddof=1), rtol=1e-12)
        np.testing.assert_allclose(found.mean_error, found.std / np.sqrt(70), rtol=1e-12)
        for floor, interval in enumerate(found.quantile(0.84)):
            assert interval.value == np.quantile(values[:, floor], 0.84, method="inverted_cdf")
            assert interval.low < interval.value < interval.high
    x = np.array([r.displacement[:257] for r in responses])
    np.testing.assert_allclose(ensemble.displacement_variance, x.var(0, ddof=1), atol=1e-14)
    with pytest.raises(ValueError, match="read-only"):
        drifts.values[0, 0] = 1


def test_the_standard_error_of_the_deviation_is_that_of_many_samples() -> None:
    # Drawn again and again, the deviation of ten members scatters by its standard error.
    values = ss.run_ensemble(RACK, NOISE, members=2000, seed=1).peak_floor_drift
    parts = values.values[:, 0].reshape(200, 10).std(1, ddof=1)
    assert values.std_error[0] * np.sqrt(200) == pytest.approx(parts.std(), rel=0.2)


def test_equipment_slopes_and_pulses() -> None:
    pulses = ss.PoissonPulses(rate=2, half_width=0.5, sigma=2, duration=6)
    for system in (RACK, SLOPE, ss.FlexibleSlope(ky_g=0.04, height=40, shear_velocity=300)):
        e = ss.run_ensemble(system, pulses, members=3, seed=2, dt=0.5)
        responses = [ss.integrate(system, pulses.sample(seed=2, member=i)) for i in range(3)]
        np.testing.assert_allclose(e.peak, [r.peak for r in responses], rtol=1e-9, atol=1e-15)
        top = [r.floors.peak_acceleration[-1] for r in responses]
        np.testing.assert_allclose(e.peak_floor_acceleration.values[:, -1], top, rtol=1e-9)


def test_lists_and_random_structures() -> None:
    def isolated(mu: float) -> ss.IsolatedStructure:
        return ss.IsolatedStructure(ss.Slider(ss.Coulomb(mu=mu), 1.5), BUILDING, base_mass=1)

    options = {"members": 6, "seed": 3, "dt": 1.28}
    several = ss.run_ensemble([isolated(0.03), isolated(0.06)], NOISE, **options)
    alone = ss.run_ensemble(isolated(0.06), NOISE, **options)
    np.testing.assert_array_equal(several.peak[1::2], alone.peak[1::2])
    random = ss.Random(isolated, mu=ss.Lognormal(0.05, 0.2))
    e = ss.run_ensemble(random, NOISE, **options)
    r = ss.integrate(random.sample(seed=3, member=4), NOISE.sample(seed=3, member=4))
    assert e.peak[4] == pytest.approx(r.peak, rel=1e-9)
    two = ss.Structure.shear_building(masses=[1, 1], stiffnesses=[600, 500], damping_ratio=0.03)
    with pytest.raises(ValueError, match="same number of floors, got 3 and 2"):
        ss.run_ensemble(
            [ISOLATED, ss.IsolatedStructure(BEARING, two, base_mass=1)], NOISE, **options
        )
    with pytest.raises(TypeError, match=r"sliders\[1\] must be a structure, as the first one"):
        ss.run_ensemble([ISOLATED, BEARING], NOISE, **options)
    with pytest.raises(TypeError, match="as the first sample of sliders is a structure"):
        mixed = ss.Random(
            lambda mu: isolated(mu) if mu < 0.05 else BEARING, mu=ss.Uniform(0.049, 0.0501)
        )
        ss.run_ensemble(mixed, NOISE, members=300, seed=1)


def test_without_shapes_there_are_no_floors() -> None:
    column = ss.Structure.from_modes(mass_fractions=[0.7], frequencies=[8.0], damping_ratios=[0.05])
    e = ss.run_ensemble(ss.IsolatedStructure(BEARING, column), NOISE, members=3, seed=1)
    assert e.has_floors
    assert e.peak_floor_drift.values.size == 0
    assert e.peak_floor_drift.quantile(0.5) == []
    assert e.peak_base_acceleration.shape == (3,)
    with pytest.raises(ValueError, match=r"no floors; give Structure\.from_modes the shapes"):
        e.plot_floors()
    sliders = ss.run_ensemble(BEARING, NOISE, members=3, seed=1)
    with pytest.raises(ValueError, match="sliders have no floors"):
        _ = sliders.peak_floor_drift


def test_files_and_copies(ensemble: ss.Ensemble, tmp_path: object) -> None:
    file = f"{tmp_path}/ensemble.npz"
    ensemble.save(file)
    assert ss.Ensemble.load(file) == ensemble
    assert ensemble.configuration["slider"]["base_mass"] == 1
    state = ensemble.__getstate__()
    state["floor_peaks"] = state["floor_peaks"][:-1]
    with pytest.raises(ValueError, match="peaks of floors must be those of the members"):
        ss.Ensemble.__new__(ss.Ensemble).__setstate__(state)
    part = ss.run_ensemble(ISOLATED, NOISE, members=64, seed=5, settle=True)
    part.merge(ss.run_ensemble(ISOLATED, NOISE, members=6, first_member=64, seed=5, settle=True))
    assert part == ensemble


def test_tables(ensemble: ss.Ensemble) -> None:
    pytest.importorskip("pandas")
    frame = ensemble.to_dataframe()
    assert frame.attrs["units"]["floor_3_peak_drift"] == "m"
    np.testing.assert_array_equal(
        frame["floor_3_peak_acceleration"], ensemble.peak_floor_acceleration.values[:, 2]
    )
    np.testing.assert_array_equal(frame["peak_base_shear"], ensemble.peak_base_shear)
    pytest.importorskip("xarray")
    about = ensemble.to_xarray()["floor_1_peak_drift"].attrs
    assert about == {"units": "m", "long_name": "largest drift, floor 1"}
    assert "floor_2_peak_drift" in ensemble.to_json()


def test_pictures(ensemble: ss.Ensemble) -> None:
    pytest.importorskip("matplotlib")
    figure = ensemble.plot_floors()
    accelerations, drifts = figure.axes
    floors = accelerations.lines[0].get_ydata()
    np.testing.assert_array_equal(floors, range(4))  # the base is 0
    median = [one.value for one in ensemble.peak_floor_acceleration.quantile(0.5)]
    shown = ss.STANDARD_GRAVITY * accelerations.lines[0].get_xdata()[1:]
    np.testing.assert_allclose(shown, median, rtol=1e-14)
    np.testing.assert_array_equal(drifts.lines[0].get_ydata(), range(1, 4))
    assert "isolated structure" in figure._suptitle.get_text()
    assert len(ensemble.plot().axes) == 4
    rack = ss.run_ensemble(RACK, NOISE, members=4, seed=1)
    assert "equipment on floor 2" in rack.plot_floors()._suptitle.get_text()
    slope = ss.run_ensemble(SLOPE, NOISE, members=4, seed=1)
    assert "flexible slope" in slope.plot_floors()._suptitle.get_text()


def test_the_floors_of_several_records_are_drawn_by_height() -> None:
    plotting = pytest.importorskip("stickslip.plotting")
    responses = [ss.integrate(ISOLATED, NOISE.sample(seed=1, member=i)) for i in range(9)]
    accelerations, drifts = plotting.plot_floors(responses).axes
    peaks = np.array([[r.peak_base_acceleration, *r.floors.peak_acceleration] for r in responses])
    median, *records = accelerations.lines
    peaks /= ss.STANDARD_GRAVITY
    np.testing.assert_array_equal(median.get_xdata(), np.median(peaks, axis=0))
    assert len(records) == 9
    np.testing.assert_array_equal([line.get_xdata() for line in records], peaks)
    outer, inner = (band.get_paths()[0].vertices[:, 0] for band in accelerations.collections)
    # Of nine values, the second and the eighth bound the 16 and 84 % quantiles.
    ordered = np.sort(peaks, axis=0)
    assert {*ordered[1], *ordered[7]} <= {*inner}
    assert {*ordered[0], *ordered[8]} <= {*outer}
    labels = [text.get_text() for text in drifts.get_legend().get_texts()]
    assert labels == ["5 to 95 %", "16 to 84 %", "median"]
    assert (
        len(plotting.plot_floors(responses * 6).axes[0].lines) == 1
    )  # 54 are not drawn one by one
    figure = plotting.plot_floors(responses, title="9 records")
    assert figure._suptitle.get_text() == "9 records"

    two = ss.Structure.shear_building(masses=[1, 1], stiffnesses=[600, 500], damping_ratio=0.03)
    low = ss.integrate(ss.IsolatedStructure(BEARING, two, base_mass=1), responses[0].motion)
    bare = ss.Structure.from_modes(mass_fractions=[0.7], frequencies=[8.0], damping_ratios=[0.05])
    column = ss.integrate(ss.IsolatedStructure(BEARING, bare), responses[0].motion)
    for given, message in (
        (responses[:1], "at least two members or responses, got 1"),
        ([], "at least two members or responses, got 0"),
        ([*responses, low], "same number of floors, got 3 and, in response 9, 2"),
        ([column, column], r"no floors; give Structure\.from_modes the shapes"),
        (ss.run_ensemble(ISOLATED, NOISE, members=1, seed=1), "at least two members .*, got 1"),
    ):
        with pytest.raises(ValueError, match=f"plot_floors: .*{message}"):
            plotting.plot_floors(given)
    with pytest.raises(TypeError, match="item 1 must be a StructureResponse, got Response"):
        plotting.plot_floors([responses[0], ss.integrate(BEARING, responses[0].motion)])
    with pytest.raises(TypeError, match="an Ensemble or a list of StructureResponse, got int"):
        plotting.plot_floors(3)


@pytest.mark.filterwarnings("ignore:GaussianExcitation. the spectrum is carried")
def test_peaks_of_more_floors_than_the_structure_has_are_refused() -> None:
    building = ss.Structure.shear_building(
        masses=[1, 1], stiffnesses=[600, 500], damping_ratio=0.05
    )
    system = ss.EquipmentOnFloor(ss.Coulomb(mu=0.1), building, floor=2)
    noise = ss.GaussianExcitation(ss.Spectrum.white(s0=0.01), dt=0.02, samples=64)
    e = ss.run_ensemble(system, noise, members=4, seed=1)
    state = dict(e.__getstate__())
    assert len(state["floor_peaks"]) == 4 * (2 + 2 * 2)
    state["floor_peaks"] = np.tile(state["floor_peaks"], 2)
    with pytest.raises(ValueError, match="peaks of floors must be those of the structure"):
        ss.Ensemble.__new__(ss.Ensemble).__setstate__(state)
