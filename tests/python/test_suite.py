"""Suites of ground motions: made, filtered, scaled, read, kept in files."""

import math
import pickle
import tracemalloc
import warnings
import zipfile

import numpy as np
import pytest
import stickslip as ss
from stickslip import _hdf5
from stickslip.motions.suite import LeftOut


def quake(seed: int, samples: int = 400) -> ss.GroundMotion:
    n = np.random.default_rng(seed).normal(0, 2, samples)
    return ss.GroundMotion(n - n.mean(), dt=0.02, name=f"quake {seed}")


MOTIONS = [quake(i) for i in range(4)]
SUITE = ss.Suite(MOTIONS, {"magnitude": [5, 6, 7, math.nan], "event": ["a", "b", "b", ""]})


def write(folder, name, motion, label="Acceleration (m/s^2)"):
    rows = "".join(
        f"{t!r},{a!r}\n" for t, a in zip(motion.time.tolist(), motion.acceleration.tolist())
    )
    file = folder / name
    file.parent.mkdir(exist_ok=True)
    file.write_text(f"Time (s), {label}\n{rows}")
    return file


@pytest.fixture
def folder(tmp_path):
    for i, motion in enumerate(MOTIONS):
        write(tmp_path / ("one" if i < 2 else "two"), f"r{i}.csv", motion)
    return tmp_path


def test_a_suite_is_a_sequence_that_filters_by_its_columns():
    assert len(SUITE) == 4
    assert SUITE[1] is MOTIONS[1]
    assert list(SUITE[1:3]) == MOTIONS[1:3]
    strong = SUITE[SUITE.magnitude > 5.5]
    assert list(strong) == MOTIONS[1:3]
    assert strong.event.tolist() == ["b", "b"]
    assert SUITE[[3, 0]].names == ("quake 3", "quake 0")
    assert SUITE[SUITE.event == "b"] == SUITE[1:3]
    assert SUITE[-1] == MOTIONS[3]


def test_an_empty_selection_and_a_wrong_index_are_refused():
    with pytest.raises(ValueError, match="the selection holds none of the 4 motions"):
        SUITE[SUITE.magnitude > 9]
    with pytest.raises(IndexError, match="a mask must have one value for each of the 4 motions"):
        SUITE[np.array([True])]
    with pytest.raises(TypeError, match="an index must be"):
        SUITE[[0.5]]
    with pytest.raises(
        AttributeError, match="no column 'depth'; the columns are: magnitude, event"
    ):
        _ = SUITE.depth


def test_what_a_suite_cannot_be_made_of_is_refused():
    with pytest.raises(ValueError, match="needs at least one ground motion, got none"):
        ss.Suite([])
    with pytest.raises(TypeError, match=r"motions\[1\] must be a GroundMotion, got int"):
        ss.Suite([MOTIONS[0], 3])
    with pytest.raises(ValueError, match="'depth' must have one value for each of the 4 motions"):
        ss.Suite(MOTIONS, {"depth": [1, 2]})
    with pytest.raises(ValueError, match="must not be named 'names'"):
        ss.Suite(MOTIONS, {"names": list("abcd")})


def test_a_suite_goes_wherever_a_list_of_motions_goes():
    block = ss.Coulomb(mu=0.1)
    a = ss.run_ensemble(block, SUITE, members=64, seed=1)
    assert a == ss.run_ensemble(block, MOTIONS, members=64, seed=1)
    assert ss.sweep(block, SUITE[:2]).records == ("quake 0", "quake 1")


def test_each_rule_of_scaling_meets_its_target():
    g = ss.STANDARD_GRAVITY
    assert SUITE.scaled_to(pga_g=0.4).pga_g == pytest.approx(0.4, rel=1e-14)
    for motion in SUITE.scaled_to(arias=1.5):
        assert ss.strong_motion(motion).arias_intensity == pytest.approx(1.5, rel=1e-12)
    for motion in SUITE.scaled_to(pgv=0.3):
        assert ss.strong_motion(motion).peak_velocity == pytest.approx(0.3, rel=1e-12)
    for motion in SUITE.scaled_to(sa_g=0.5, period=0.6):
        values = ss.response_spectrum(motion, [0.6]).values
        assert np.ravel(values)[0] == pytest.approx(0.5 * g, rel=1e-12)
    periods = np.array([0.2, 0.5, 1.0])
    for motion in SUITE.scaled_to(spectrum=(periods, [9.0, 6.0, 3.0])):
        sa = np.ravel(ss.response_spectrum(motion, periods).values)
        assert np.log(sa / [9, 6, 3]).mean() == pytest.approx(0, abs=1e-12)
    target = ss.response_spectrum(MOTIONS[2], periods, 0.02)
    assert SUITE[2:3].scaled(3).scaled_to(spectrum=target).pga_g == pytest.approx(
        SUITE[2:3].pga_g, rel=1e-12
    )
    assert SUITE.scaled([1, 2, 3, 4]).pga_g == pytest.approx(SUITE.pga_g * [1, 2, 3, 4])
    assert SUITE.scaled(2).magnitude[1] == 6


def test_scaling_without_one_clear_target_is_refused():
    with pytest.raises(ValueError, match=r"give one of pga_g, .* got none"):
        SUITE.scaled_to()
    with pytest.raises(ValueError, match="got pga_g and arias"):
        SUITE.scaled_to(pga_g=1, arias=1)
    with pytest.raises(ValueError, match=r"sa_g needs period= \[s\]|period goes with sa_g"):
        SUITE.scaled_to(sa_g=1)
    with pytest.raises(ValueError, match="targets must be positive and finite, got -1"):
        SUITE.scaled_to(spectrum=([1, 2], [-1, 2]))
    with pytest.raises(ValueError, match="'quiet' is zero throughout"):
        ss.Suite([ss.GroundMotion([0, 0], dt=1, name="quiet")]).scaled_to(sa_g=1, period=1)


@pytest.mark.parametrize(
    "measure, levels, more",
    [
        ("pga_g", [0.1, 0.4], {}),
        ("pgv", [0.2, 0.6], {}),
        ("arias", [0.5, 2], {}),
        ("sa_g", [0.3, 0.9], {"period": 0.6}),
    ],
)
def test_stripes_scale_each_record_to_each_level(measure, levels, more):
    stripes = SUITE.stripes(**{measure: levels}, **more)
    assert stripes.record.tolist() == 2 * list(SUITE.names)
    assert stripes.stripe.tolist() == np.repeat(levels, 4).tolist()
    assert stripes.event.tolist() == 2 * SUITE.event.tolist()
    for level in levels:
        part = stripes[stripes.stripe == level]
        target = SUITE.scaled_to(**{measure: level}, **more)
        assert list(part) == list(target)
        assert part.factor == pytest.approx(target.pga_g / SUITE.pga_g, rel=1e-14)
    assert getattr(stripes, measure) == pytest.approx(stripes.stripe, rel=1e-14)
    if more:
        assert set(stripes.sa_period) == {0.6}
    table = pytest.importorskip("pandas") and stripes.to_dataframe()
    assert table.columns.tolist()[:2] == ["record", "pga_g"]
    assert "record_given" not in table


def test_stripes_scale_all_components_and_keep_the_records_apart():
    n = MOTIONS[0].acceleration
    pair = ss.GroundMotion(n, dt=0.02, transverse=n[::-1], name="A")
    stripes = ss.Suite([pair, MOTIONS[1], pair, ss.GroundMotion([0, 1], dt=1)]).stripes(pga_g=[1])
    assert stripes.record.tolist() == ["A", "quake 1", "A (2)", "record 3"]
    assert stripes[0].transverse == pytest.approx(n[::-1] * stripes.factor[0], rel=1e-15)
    of_one_station = SUITE.with_metadata({"record": [*"aabb"]}).stripes(pga_g=0.3)
    assert of_one_station.record.tolist() == [*"aabb"]


def test_levels_that_no_factor_reaches_are_refused():
    quiet = ss.GroundMotion([0, 0], dt=1, name="quiet")
    for bad, why in (
        ({}, "give one of pga_g, pgv, arias, sa_g, got none"),
        ({"pga_g": [1], "arias": [1]}, ".* got pga_g and arias"),
        ({"pga_g": []}, "pga_g must be a list of levels"),
        ({"pga_g": [0.1, 0]}, "pga_g must be positive and finite, got 0 g"),
        ({"pgv": [math.nan]}, "pgv must be positive and finite, got nan m/s"),
        ({"sa_g": [1]}, r"sa_g needs period= \[s\]"),
        ({"pga_g": [1], "period": 1}, "period goes with sa_g, got it with pga_g"),
    ):
        with pytest.raises(ValueError, match=f"Suite.stripes: {why}"):
            SUITE.stripes(**bad)
    for measure in ("pga_g", "pgv", "arias"):
        with pytest.raises(ValueError, match="'quiet' is zero throughout"):
            ss.Suite([*MOTIONS, quiet]).stripes(**{measure: [1]})


def scaled_pairs():
    rng = np.random.default_rng(4)
    made = []
    for i in range(5):
        smooth = np.ones(3 + 4 * i)
        a, b = (np.convolve(rng.standard_normal(1500), smooth, "same") for _ in range(2))
        made.append(ss.GroundMotion(a, dt=0.02, transverse=0.7 * b, name=f"pair {i}"))
    return ss.Suite(made)


def measured_spectrum(motion, periods, directions):
    """SRSS and RotD100 from components that are rotated here."""
    axes = {"srss": (0, 90), "rotd100": range(180), "rotd50": range(180)}[directions]
    each = [ss.response_spectrum(motion.rotated(float(a)), periods, 0.05).values for a in axes]
    if directions == "srss":
        return np.sqrt(np.square(each).sum(axis=0))
    return np.median(each, axis=0) if directions == "rotd50" else np.max(each, axis=0)


@pytest.mark.parametrize("directions", ["srss", "rotd100", "rotd50"])
def test_pairs_meet_a_target_over_a_range_of_periods(directions):
    pairs, periods = scaled_pairs(), np.array([0.1, 0.5, 1.0, 4.0])
    target = np.array([8.0, 8.0, 4.0, 1.0])  # a straight line in logarithms from 0.5 s on
    more = {"spectrum": (periods, target), "period_range": (0.6, 2.5), "directions": directions}
    fitted = pairs.scaled_to(**more)
    checked = np.union1d(np.geomspace(0.6, 2.5, 51), [1.0])
    wanted = 4 / checked
    spectra = np.array([measured_spectrum(m, checked, directions) for m in fitted])
    # Each pair is fitted: the mean of ln(target / Sa) is zero.
    assert np.log(wanted / spectra).mean(axis=1) == pytest.approx(np.zeros(5), abs=1e-12)
    assert (spectra.mean(axis=0) / wanted).min() < 1.3
    met = pairs.scaled_to(**more, at_least=1.3)
    ratio = np.mean([measured_spectrum(m, checked, directions) for m in met], axis=0) / wanted
    assert ratio.min() == pytest.approx(1.3, rel=1e-12)
    # One factor for both components, and one more for all pairs.
    more_factor = []
    for pair, one, two in zip(pairs, fitted, met):
        factor = one.peak_acceleration / pair.peak_acceleration
        assert one.transverse == pytest.approx(factor * pair.transverse, rel=1e-12)
        more_factor.append(two.peak_acceleration / one.peak_acceleration)
    assert more_factor == pytest.approx([more_factor[0]] * 5, rel=1e-12)
    assert pairs.scaled_to(**more, at_least=0.1) == fitted


def test_ranges_that_a_target_does_not_have_are_refused():
    pairs, target = scaled_pairs(), ([0.5, 1.0], [2.0, 1.0])
    for bad, why in (
        ({"period_range": (0.4, 0.9)}, "must lie within the periods of the target, got 0.4 to 0.9"),
        ({"period_range": (0.9, 0.6)}, r"two periods, positive and increasing, got \(0.9, 0.6\)"),
        ({"at_least": 0}, "at_least must be positive and finite, got 0"),
        ({"directions": "rotd00"}, "'rotd100' or 'srss' for spectrum, got 'rotd00'"),
    ):
        with pytest.raises(ValueError, match=f"Suite.scaled_to: .*{why}"):
            pairs.scaled_to(spectrum=target, **bad)
    with pytest.raises(ValueError, match="at_least goes with spectrum, got it with pga_g"):
        pairs.scaled_to(pga_g=0.4, at_least=0.9)
    with pytest.raises(ValueError, match="'rotd50' or 'rotd100' for pga_g, got 'srss'"):
        pairs.scaled_to(pga_g=0.4, directions="srss")


def test_duplicates_are_found_whatever_their_names():
    again = ss.GroundMotion(MOTIONS[1].acceleration, dt=0.02, name="other name")
    other_step = ss.GroundMotion(MOTIONS[1].acceleration, dt=0.01)
    assert ss.Suite([*MOTIONS, again, other_step]).duplicates == [(1, 4)]
    assert SUITE.duplicates == []


def test_a_folder_a_pattern_and_a_list_are_read(folder):
    suite = ss.Suite.read(folder)
    assert list(m.acceleration.tolist() for m in suite) == [
        m.acceleration.tolist() for m in MOTIONS
    ]
    assert [f.rsplit("/", 1)[1] for f in suite.file] == ["r0.csv", "r1.csv", "r2.csv", "r3.csv"]
    assert len(ss.Suite.read(f"{folder}/**/*.csv")) == 4
    assert len(ss.Suite.read(f"{folder}/one/*")) == 2
    assert len(ss.Suite.read([folder / "two", folder / "one" / "r0.csv"], threads=2)) == 3


def test_nothing_to_read_is_refused(tmp_path):
    with pytest.raises(ValueError, match=f"no files in '{tmp_path}'"):
        ss.Suite.read(tmp_path)
    with pytest.raises(ValueError, match=r"no files in '.*AT2'"):
        ss.Suite.read(f"{tmp_path}/*.AT2")
    with pytest.raises(ValueError, match="no files in the list"):
        ss.Suite.read([])
    with pytest.raises(ValueError, match=r"cannot read 1 of 1 files: .*none.AT2: No such file"):
        ss.Suite.read(tmp_path / "none.AT2")
    with pytest.raises(ValueError, match="on_error must be 'raise' or 'skip', got 'ignore'"):
        ss.Suite.read(tmp_path, on_error="ignore")


def test_all_files_that_cannot_be_read_are_told_at_once(folder):
    (folder / "notes.txt").write_text("no record")
    for i in (5, 6):
        write(folder / "one", f"r{i}.csv", quake(i), label="Acceleration")
    with pytest.raises(ValueError) as error:
        ss.Suite.read(folder)
    text = str(error.value)
    assert "cannot read 3 of 7 files" in text
    assert text.index("r5.csv") < text.index("r6.csv") < text.index("give units=")
    assert "notes.txt: no known format of records" in text
    with pytest.warns(RuntimeWarning, match="cannot read 3 of 7 files.*they are left out"):
        suite = ss.Suite.read(folder, on_error="skip")
    assert len(suite) == 4
    assert {one.file.rsplit("/", 1)[1] for one in suite.left_out} == {
        "notes.txt",
        "r5.csv",
        "r6.csv",
    }
    (folder / "notes.txt").unlink()
    assert len(ss.Suite.read(sorted(folder.glob("one/r[56].csv")), units="m/s^2")) == 2


@pytest.mark.parametrize("pattern", ["{}", "{}/**", "{}/**/*.csv", "{}/*/*.csv"])
def test_a_loop_of_links_leaves_each_record_once(folder, pattern):
    (folder / "one" / "up").symlink_to(folder)
    (folder / "two" / "again").symlink_to(folder / "one")
    suite = ss.Suite.read(pattern.format(folder))
    assert [name.rsplit("/", 1)[1] for name in suite.file] == [f"r{i}.csv" for i in range(4)]


def test_a_link_to_a_folder_elsewhere_is_followed(folder, tmp_path_factory):
    database = tmp_path_factory.mktemp("database")
    (database / "linked").symlink_to(folder)
    assert len(ss.Suite.read(f"{database}/**/*.csv")) == 4
    assert len(ss.Suite.read(database)) == 4


def test_progress_tells_the_files_that_are_read(folder, capsys):
    told = []
    ss.Suite.read(folder, progress=lambda done, total: told.append((done, total)))
    assert told == [(i, 4) for i in range(1, 5)]
    ss.Suite.read(folder, progress=True)
    assert "4/4" in capsys.readouterr().err


def test_files_that_are_the_same_record_are_told(folder):
    write(folder / "two", "copy.csv", MOTIONS[0])
    with pytest.warns(ss.PlausibilityWarning, match="r0.csv = copy.csv"):
        suite = ss.Suite.read(folder)
    assert suite.duplicates == [(0, 2)]


def test_metadata_beside_the_records_are_joined_in_any_order(folder):
    table = folder / "metadata.csv"
    table.write_text("Magnitude,file,event\n7,r2,\n5.5,r0.csv,Kobe\n,r1.csv,Landers\n")
    suite = ss.Suite.read(folder, metadata=table)
    assert suite.Magnitude == pytest.approx([5.5, math.nan, 7, math.nan], nan_ok=True)
    assert suite.event.tolist() == ["Kobe", "Landers", "", ""]
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame({"record": ["r3", "r0"], "vs30": [300.0, 760.0]})
    assert ss.Suite.read(folder / "one", metadata=frame).vs30 == pytest.approx(
        [760, math.nan], nan_ok=True
    )


def test_a_column_named_like_a_quantity_of_the_suite_is_renamed(folder):
    table = {"file": ["r0", "r1", "r2", "r3"], "pga_g": [1.0, 2.0, 3.0, 4.0], "save": list("abcd")}
    with pytest.warns(RuntimeWarning, match="'pga_g' to 'pga_g_given', 'save' to 'save_given'"):
        suite = ss.Suite.read(folder, metadata=table)
    assert suite.pga_g_given.tolist() == [1, 2, 3, 4]
    assert suite.save_given.tolist() == list("abcd")
    assert suite.pga_g.tolist() == [m.peak_acceleration / ss.STANDARD_GRAVITY for m in suite]
    with pytest.warns(RuntimeWarning, match="'duration' to 'duration_given'"):
        suite = ss.Suite(MOTIONS, {"duration": [1, 2, 3, 4]})
    assert suite.duration_given.tolist() == [1, 2, 3, 4]
    assert suite.duration[0] == MOTIONS[0].duration


@pytest.mark.parametrize(
    "text, error",
    [
        ("magnitude,depth\n7,3\n", "needs a column 'file', 'record' or 'name'"),
        ("file,depth\nr7.csv,3\n", "has a row for none of the 4 records; its 'file' has 'r7.csv'"),
        ("file,depth\nr0.csv,3\nr0.csv,4\n", "two rows for 'r0.csv'"),
        ("file,depth\nr0.csv\n", "row 2 must have 2 cells, got 1"),
        ("file,depth\n", "must have names and at least one row"),
    ],
)
def test_metadata_that_cannot_be_joined_are_refused(folder, text, error):
    (folder / "metadata.csv").write_text(text)
    with pytest.raises(ValueError, match=error):
        ss.Suite.read(folder, metadata=folder / "metadata.csv")


def test_a_saved_suite_is_the_same_to_the_last_bit(tmp_path):
    pytest.importorskip("h5py")
    uneven = ss.GroundMotion([0.0, 1 / 3, 0.1], times=[0, 0.1, 0.3], name="uneven")
    held = ss.GroundMotion([0.0, 1 / 3, 0.1], dt=0.1, interpolation="constant", name="held \u03bc")
    suite = ss.Suite(
        [*MOTIONS, uneven, held],
        {"magnitude": [1, 2, 3, 4, 5, math.nan], "event": [*"abcde", ""], "a/b": range(6)},
    )
    assert ss.Suite.open(suite.save(tmp_path / "s.h5")) == suite
    assert suite != SUITE
    assert suite.with_metadata({"magnitude": [0.0] * 6}) != suite


def test_a_suite_is_saved_within_the_memory_of_its_file(tmp_path):
    pytest.importorskip("h5py")
    samples = np.random.default_rng(5).normal(size=(60, 5000))
    suite = ss.Suite(ss.GroundMotion(n, dt=0.01) for n in samples)
    suite[:1].save(tmp_path / "first.h5")  # imports h5py
    tracemalloc.start()
    try:
        file = suite.save(tmp_path / "s.h5")
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak < 1.5 * samples.nbytes
    assert ss.Suite.open(file) == suite


def test_all_components_are_saved_and_told_apart(tmp_path):
    pytest.importorskip("h5py")
    n, t, v = (m.acceleration for m in MOTIONS[:3])
    whole = ss.GroundMotion(n, dt=0.02, transverse=t, vertical=v, orientation="N28W", name="whole")
    flat = ss.GroundMotion(n, dt=0.02, transverse=t, name="flat")
    uneven = ss.GroundMotion(n[:3], times=[0, 0.1, 0.3], vertical=v[:3])
    suite = ss.Suite([MOTIONS[3], whole, flat, uneven, whole.scaled(2)])
    saved = ss.Suite.open(suite.save(tmp_path / "s.h5"))
    assert saved == suite
    assert saved[1].orientation == "N28W"
    assert np.array_equal(saved[1].vertical, v)
    assert saved[2].vertical is None
    assert suite.duplicates == []  # the axes of two are the same, the vertical components are not
    assert ss.Suite([whole, whole]).duplicates == [(0, 1)]


@pytest.mark.slow
def test_every_changed_byte_of_a_saved_suite_is_found_or_changes_nothing(tmp_path):
    """Bytes of padding may change; values may not."""
    pytest.importorskip("h5py")
    n, t = (m.acceleration[:60] for m in MOTIONS[:2])
    motion = ss.GroundMotion(n, dt=0.02, transverse=t, orientation="N28W", name="whole")
    suite = ss.Suite([motion, MOTIONS[2].cut(0, 1)], {"magnitude": [6.5, 7.0], "event": ["a", "b"]})
    file = suite.save(tmp_path / "s.h5")
    whole = file.read_bytes()
    found = 0
    for place in range(0, len(whole), 61):
        damaged = bytearray(whole)
        damaged[place] ^= 0x20
        file.write_bytes(damaged)
        try:
            assert ss.Suite.open(file) == suite, place
        except ValueError:
            found += 1
    assert found > (2 * n.nbytes) // 61


@pytest.mark.parametrize(
    "change, said",
    [
        (lambda h5: rewritten(h5, "name", h5["name"][:2]), "'first' must have shape"),
        (lambda h5: rewritten(h5, "first", [0, 400, 800, 1200, 1700]), "'first' must rise from 0"),
        (lambda h5: rewritten(h5, "first", [-5, 400, 800, 1200, 1600]), "'first' must rise from 0"),
        (lambda h5: rewritten(h5, "vertical", [1.0, 2.0]), "'vertical' must have 0 samples, has 2"),
        (lambda h5: rewritten(h5, "dt", [0.02]), "'dt' must have shape"),
        (lambda h5: rewritten(h5["metadata"], "event", ["a"]), "'event' must have shape"),
        (lambda h5: linked(h5, "acceleration"), "'acceleration' is a link"),
    ],
)
def test_a_suite_of_other_lengths_is_refused(tmp_path, change, said):
    h5py = pytest.importorskip("h5py")
    file = SUITE.save(tmp_path / "s.h5")
    with h5py.File(file, "a") as h5:
        change(h5)
    with pytest.raises(ValueError, match=f"is damaged: {said}"):
        ss.Suite.open(file)


def rewritten(group, name, values):
    del group[name]
    _hdf5.write(group, name, values)


def linked(h5, name):
    import h5py

    with h5py.File(h5.filename.replace("s.h5", "other.h5"), "w") as other:
        other[name] = h5[name][:]
    del h5[name]
    h5[name] = h5py.ExternalLink("other.h5", name)


# ---- stations


def component(folder, name, motion):
    """A file as PEER writes it: Event, station, component."""
    title, where = name
    samples = " ".join(f"{a / 9.80665!r}" for a in motion.acceleration.tolist())
    text = "PEER NGA STRONG MOTION DATABASE RECORD\n" + f"{title}, {where}\n"
    text += f"ACCELERATION TIME SERIES IN UNITS OF G\nNPTS= {len(motion)}, DT= .02 SEC\n{samples}\n"
    file = folder / f"{title.split(', ')[-1]}-{where}.AT2"
    file.write_text(text)
    return file


@pytest.fixture
def stations(tmp_path):
    """Two stations of three and two components, and one component alone."""
    motions = iter([quake(i) for i in range(10, 20)])
    for title, ends in {"Quake, AAA": ["000", "090", "UP"], "Quake, BBB": ["045", "315"]}.items():
        for end in ends:
            component(tmp_path, (title, end), next(motions))
    component(tmp_path, ("Quake, CCC", "120"), next(motions))
    return tmp_path


def test_the_files_of_each_station_become_one_motion(stations):
    with pytest.warns(RuntimeWarning, match="1 of 6 components fit no station and stay alone: .*C"):
        suite = ss.Suite.read(stations, stations=True)
    assert suite.names == ("Quake, AAA, 000", "Quake, BBB, 045", "Quake, CCC, 120")
    assert suite.components.tolist() == [3, 2, 1]
    a = [stations / f"AAA-{end}.AT2" for end in ("000", "090", "UP")]
    assert suite.files[0] == "; ".join(map(str, a))
    assert suite.file[0] == str(a[0])
    assert suite[0] == ss.read_station(a)
    b = [stations / f"BBB-{end}.AT2" for end in ("045", "315")]
    assert suite[1] == ss.read_station(b)
    assert suite[2] == ss.read_record(stations / "CCC-120.AT2")
    assert suite.alone == (
        LeftOut(str(stations / "CCC-120.AT2"), "no other component of its station"),
    )
    assert pickle.loads(pickle.dumps(suite)).alone == suite.alone
    with pytest.warns(RuntimeWarning):
        turned = ss.Suite.read(stations, stations=True, along=30)
    assert turned[0] == ss.read_station(a, along=30)
    assert turned[1] == ss.read_station(b, along=30)


def test_stations_in_an_archive_and_in_other_folders_are_kept_apart(stations, tmp_path):
    other = tmp_path / "other"
    other.mkdir()
    file = other / "all.zip"
    with zipfile.ZipFile(file, "w") as archive:
        for one in sorted(stations.glob("AAA*.AT2")):
            archive.write(one, one.name)
    with pytest.warns((RuntimeWarning, ss.PlausibilityWarning)) as said:
        suite = ss.Suite.read([stations / "*.AT2", file], stations=True)
    assert "records that occur more than once: 1: " in str(said[-1].message)
    assert suite.components.tolist() == [3, 2, 1, 3]
    assert suite.files[3].startswith(f"{file}::AAA-000.AT2; ")
    assert np.array_equal(suite[3].vertical, suite[0].vertical)
    # Without stations an archive of several files stands for all of them, too.
    with pytest.warns(RuntimeWarning, match="all.zip::AAA-UP.AT2: a vertical component"):
        assert len(ss.Suite.read(file)) == 2


def test_what_fits_no_station_stays_alone_with_its_reason(stations):
    component(stations, ("Quake, AAA", "090 "), quake(3))  # twice the same direction
    component(stations, ("Quake, BBB", "UP"), quake(4, samples=300))
    (stations / "table.csv").write_text("Time (s),a (g),b (g)\n0,1,2\n1,2,1\n")
    with pytest.warns(RuntimeWarning) as said:
        suite = ss.Suite.read(stations, stations=True)
    left, alone = (str(one.message) for one in said)
    assert "8 of 10 components" in alone
    assert set(suite.components) == {1}
    reasons = dict(suite.alone)
    # A vertical component alone is no horizontal record.
    verticals = dict(suite.left_out)
    assert [name.rsplit("/", 1)[1] for name in verticals] == ["AAA-UP.AT2", "BBB-UP.AT2"]
    assert "same number of samples" in verticals[str(stations / "BBB-UP.AT2")]
    assert "AAA-UP.AT2: a vertical component (UP): needs one or two horizontal" in left
    assert "one or two horizontal components, got 3" in reasons[str(stations / "AAA-000.AT2")]
    assert "same number of samples" in reasons[str(stations / "BBB-045.AT2")]
    assert "neither the file nor its name" in reasons[str(stations / "table.csv")]
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always", RuntimeWarning)
        warnings.simplefilter("ignore", ss.PlausibilityWarning)  # what is cut leaves an offset
        cut = ss.Suite.read(stations, stations=True, common_length=True)
    assert "6 of 10 components" in str(said[-1].message)
    (three,) = cut[cut.components == 3]
    assert len(three) == 300


def test_a_file_name_says_where_a_silent_file_points(tmp_path):
    for name, seed in [("XYZ-090", 1), ("XYZ-360", 2), ("XYZ-V", 3), ("KOBE_TAK000", 4)]:
        write(tmp_path, f"{name}.csv", quake(seed))
    write(tmp_path, "KOBE_TAK090.csv", quake(5))
    suite = ss.Suite.read(tmp_path, stations=True)
    assert suite.alone == ()
    assert suite.names == ("KOBE_TAK, 000", "XYZ, 090")
    assert np.array_equal(suite[1].acceleration, quake(1).acceleration)
    assert np.array_equal(suite[1].transverse, -quake(2).acceleration)  # 180 is away from 360
    assert np.array_equal(suite[1].vertical, quake(3).acceleration)


def test_all_components_are_motions_of_a_suite(tmp_path):
    (tmp_path / "three.csv").write_text(
        "Time (s),NS (g),EW (g),UD (g)\n0,1,2,3\n1,2,1,3\n2,0,0,1\n"
    )
    with pytest.warns(RuntimeWarning, match="left out, because sliders move horizontally"):
        suite = ss.Suite.read(tmp_path, component="all")
    assert suite.component.tolist() == ["NS", "EW"]
    assert list(suite) == ss.read_record(tmp_path / "three.csv", component="all")[:2]
    assert set(suite.file) == {str(tmp_path / "three.csv")}


def test_options_of_stations_are_refused_without_them(tmp_path):
    with pytest.raises(ValueError, match="along needs stations=True"):
        ss.Suite.read(tmp_path, along=30)
    with pytest.raises(ValueError, match="common_length needs stations=True"):
        ss.Suite.read(tmp_path, common_length=True)
    with pytest.raises(ValueError, match="component and stations must not both be given"):
        ss.Suite.read(tmp_path, component=1, stations=True)
    write(tmp_path, "a.csv", quake(1))
    with pytest.raises(ValueError, match=r"Suite.read: along must be a finite azimuth"):
        ss.Suite.read(tmp_path, stations=True, along=math.inf)


def test_real_stations(agency_files, tmp_path):
    pytest.importorskip("h5py")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ss.PlausibilityWarning)  # some have an offset
        pairs = ss.Suite.read(
            agency_files / "usgs_pairs" / "*.txt", stations=True, units="g", dt=0.01
        )
    assert pairs.alone == ()
    assert pairs.components.tolist() == [2] * 11
    assert "Northridge_1994_RRS, 228" in pairs.names
    geonet = ss.Suite.read(agency_files / "geonet", stations=True, along="S62W")
    assert geonet.components.tolist() == [3]
    assert geonet[0] == ss.read_station(geonet.file[0], along="S62W")
    both = ss.Suite([*pairs, *geonet])
    assert ss.Suite.open(both.save(tmp_path / "s.h5")) == both


def test_a_file_that_is_no_suite_is_refused(tmp_path):
    h5py = pytest.importorskip("h5py")
    file = tmp_path / "s.h5"
    file.write_text("text")
    with pytest.raises(ValueError, match="is not an HDF5 file, or is damaged"):
        ss.Suite.open(file)
    with h5py.File(file, "w") as h5:
        h5["x"] = 1
    with pytest.raises(ValueError, match="must be of format 'stickslip suite 1', got 'None'"):
        ss.Suite.open(file)
    SUITE.save(file)
    with h5py.File(file, "a") as h5:
        del h5["dt"]
    with pytest.raises(ValueError, match="is damaged"):
        ss.Suite.open(file)
    with pytest.raises(FileNotFoundError):
        ss.Suite.open(tmp_path / "none.h5")


def test_a_suite_is_a_table():
    pytest.importorskip("pandas")
    frame = SUITE.to_dataframe()
    assert frame["record"].tolist() == list(SUITE.names)
    assert frame.pga_g.tolist() == SUITE.pga_g.tolist()
    assert frame.attrs["units"] == {"pga_g": "g", "duration": "s"}
    assert repr(SUITE) == "<Suite: 4 records, with magnitude, event>"


def test_the_sample_records_are_a_suite():
    pytest.importorskip("pyslammer")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        suite = ss.sample_records()
    assert len(suite) == 18
    assert suite.event[suite.year == 1995].tolist() == ["Kobe"]
    assert suite.duplicates == []
