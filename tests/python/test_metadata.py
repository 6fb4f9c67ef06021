"""Time steps, units and directions of records from a table, and vertical components."""

import csv
import json
import warnings

import numpy as np
import pytest
import stickslip as ss
from stickslip.cli import main

G = ss.STANDARD_GRAVITY
TIMES = np.arange(600) * 0.01


def pulse(amplitude, frequency=1.5):
    """An acceleration [m/s^2] without mean."""
    n = amplitude * np.sin(2 * np.pi * frequency * TIMES) * np.exp(-TIMES)
    return n - n.mean()


def column(file, n):
    file.write_text("\n".join(map(repr, n.tolist())) + "\n")
    return file


@pytest.fixture
def folder(tmp_path):
    """Three files of one column: the same numbers [g] with steps of 5, 10 and 20 ms."""
    for name in ("fast", "middle", "slow"):
        column(tmp_path / f"{name}.txt", pulse(0.4))
    (tmp_path / "table.csv").write_text(
        "file,dt_s,unit,azimuth,magnitude\n"
        "slow.txt,0.02,g,30,7.1\nfast.txt,0.005,g,120,6.5\nmiddle.txt,0.01,g,30,6.9\n"
    )
    return tmp_path


def run(capsys, *arguments):
    code = main([str(a) for a in arguments])
    out, err = capsys.readouterr()
    return code, out, err


BLOCK = ss.Coulomb(mu=0.1, backward=float("inf"))


def slide(motion):
    return ss.integrate(BLOCK, motion, settle=True).residual


# ---- values for all, and columns


@pytest.mark.parametrize(
    "given",
    [
        {"dt": "dt_s", "units": "unit", "orientation": "azimuth"},
        {"dt": "dt_s", "units": "g"},
        {"units": "g"},  # the column dt_s applies without being named
        {"units": "g", "dt": 0.01},  # a row takes precedence over a value for all files
    ],
)
def test_each_record_has_the_time_step_of_its_row(folder, given):
    suite = ss.Suite.read(folder, metadata=folder / "table.csv", **given)
    assert [motion.dt for motion in suite] == [0.005, 0.01, 0.02]
    fast, middle, slow = map(slide, suite)
    # The same accelerations in twice the time: four times the displacement.
    assert middle == pytest.approx(4 * fast, rel=1e-12)
    assert slow == pytest.approx(16 * fast, rel=1e-12)
    directions = ["120", "30", "30"] if "orientation" in given else [""] * 3
    assert [motion.orientation for motion in suite] == directions
    assert suite.magnitude.tolist() == [6.5, 6.9, 7.1]


def test_a_number_is_a_value_and_a_text_a_unit_an_orientation_or_a_column(folder):
    table = folder / "table.csv"
    suite = ss.Suite.read(folder / "slow.txt", dt="0.04", units="m/s^2", orientation="N28W")
    assert (suite[0].dt, suite[0].orientation) == (0.04, "N28W")
    assert suite[0].acceleration[7] == pulse(0.4)[7]
    assert ss.Suite.read(folder / "slow.txt", dt=0.1, units="g", orientation=30)[0].orientation == (
        "30"
    )
    known = "file, dt_s, unit, azimuth, magnitude"
    for name, text in [("dt", "steps"), ("units", "furlong"), ("orientation", "sideways")]:
        with pytest.raises(ValueError, match=f"Suite.read: {name} must be .*{known}.*'{text}'"):
            ss.Suite.read(folder, metadata=table, **{"units": "g", name: text})
    with pytest.raises(ValueError, match=r"there is no metadata; got 'dt_s'"):
        ss.Suite.read(folder, dt="dt_s", units="g")
    with pytest.raises(ValueError, match="dt must be positive and finite, got -1 s"):
        ss.Suite.read(folder, dt=-1, units="g")


def test_an_invalid_cell_is_an_error_of_its_file(folder):
    table = {"file": ["slow", "fast", "middle"], "dt": [0.02, -1, 0.01]}
    with pytest.raises(ValueError, match=r"fast.txt: column 'dt' .* number of seconds, got -1"):
        ss.Suite.read(folder.glob("*.txt"), metadata=table, units="g")
    with pytest.warns(RuntimeWarning, match="cannot read 1 of 3 files"):
        suite = ss.Suite.read(folder.glob("*.txt"), metadata=table, units="g", on_error="skip")
    assert len(suite) == 2


def test_a_row_that_is_empty_leaves_the_value_for_all(folder):
    table = {"file": ["slow", "fast"], "dt": [0.02, float("nan")]}
    files = [folder / "fast.txt", folder / "slow.txt"]
    suite = ss.Suite.read(files, metadata=table, units="g", dt=0.1)
    assert [motion.dt for motion in suite] == [0.1, 0.02]


# ---- what a file states


@pytest.fixture
def mixed(folder):
    """Beside the columns a file that states everything, in other units."""
    rows = "".join(f"{t!r},{100 * a!r}\n" for t, a in zip(TIMES.tolist(), pulse(4).tolist()))
    (folder / "stated.csv").write_text("Time (s),Acceleration (cm/s^2)\n" + rows)
    return folder


def test_the_statement_of_a_file_takes_precedence_over_a_value_for_all(mixed, capsys):
    for name in ("table.csv", "fast.txt", "middle.txt"):
        (mixed / name).unlink()
    suite = ss.Suite.read(mixed, units="g", dt=0.02)
    stated = suite[suite.names.index("stated") : suite.names.index("stated") + 1][0]
    assert stated.dt == 0.01
    assert stated.acceleration == pytest.approx(pulse(4), abs=1e-12)
    code, out, err = run(capsys, "records", mixed, "--units", "g", "--dt", 0.02, "--json")
    assert (code, err) == (0, "")
    rows = {row["record"]: row for row in json.loads(out)["records"]}
    assert (rows["stated"]["units"], rows["stated"]["units_from"]) == ("cm/s^2", "file")
    assert (rows["slow"]["units"], rows["slow"]["units_from"]) == ("g", "option")
    assert rows["stated"]["pga_g"] == pytest.approx(abs(pulse(4)).max() / G)


@pytest.mark.parametrize(
    "name, value, said",
    [
        ("units", "g", "states the unit cm/s.2, its row of the metadata g"),
        ("dt", 0.02, "states a time step of 0.01 s, its row of the metadata 0.02 s"),
    ],
)
def test_a_row_that_contradicts_its_file_is_an_error_that_names_the_file(mixed, name, value, said):
    file = mixed / "stated.csv"
    with pytest.raises(ValueError, match=f"stated.csv: the file {said}"):
        ss.Suite.read(file, metadata={"file": ["stated"], name: [value]})
    agreeing = {"units": "gal", "dt": 0.01}[name]
    assert len(ss.Suite.read(file, metadata={"file": ["stated"], name: [agreeing]})) == 1


def test_a_row_that_contradicts_the_orientation_of_its_file_is_an_error(tmp_path):
    file = tmp_path / "r.csv"
    file.write_text("Time (s),NS (g),EW (g)\n0,1,2\n1,2,1\n2,0,0\n")
    with pytest.raises(ValueError, match=r"r.csv: .* the orientation EW, its row .* 30"):
        ss.Suite.read(file, component="EW", metadata={"file": ["r"], "orientation": [30]})
    ss.Suite.read(file, component="EW", metadata={"file": ["r"], "orientation": [90]})


# ---- the command


def test_the_command_takes_the_step_of_each_record_from_a_table(folder, capsys):
    table = ["--metadata", folder / "table.csv"]
    code, out, err = run(capsys, "newmark", folder, "--units", "g", "--ky", 0.1, *table, "--json")
    assert (code, err) == (0, "")
    rows = {row["record"]: row for row in json.loads(out)["results"]}
    assert len(rows) == 3  # the table is no record
    assert rows["slow"]["inverse_m"] == pytest.approx(16 * rows["fast"]["inverse_m"], rel=1e-12)
    suite = ss.Suite.read(folder, metadata=folder / "table.csv", units="g")
    assert rows["fast"]["inverse_m"] == pytest.approx(slide(suite[0]), rel=1e-12)
    code, out, err = run(
        capsys, "slide", folder, "--mu", 0.1, "--units", "unit", "--dt", "dt_s", *table
    )
    assert (code, err, len(out.splitlines())) == (0, "", 4)
    code, out, err = run(capsys, "slide", folder, "--mu", 0.1, "--dt", "steps", *table)
    assert (code, out) == (2, "")
    assert err.startswith("stickslip: --dt must be a number of seconds, or name a column")
    assert "dt_s, unit, azimuth" in err


def test_files_with_the_same_problem_are_one_line_with_all_remedies(tmp_path, capsys):
    for i in range(22):
        column(tmp_path / f"r{i:02}.txt", pulse(0.4))
    code, out, err = run(capsys, "slide", tmp_path, "--mu", 0.1)
    assert (code, out, err.count("\n")) == (1, "", 1)
    assert f"22 files in {tmp_path} (r00.txt, r01.txt, r02.txt and 19 more) state no " in err
    assert "no units of acceleration and no time step: give --units, such as" in err
    assert ", and --dt, the seconds between samples" in err
    with pytest.raises(ValueError) as error:
        ss.Suite.read(tmp_path)
    text = str(error.value)
    assert "\n" not in text and "22 files" in text and "give units=" in text and ", and dt=" in text
    write_stated(tmp_path / "good.csv")
    (tmp_path / "bad.csv").write_text("no record")
    with pytest.warns(RuntimeWarning) as said:
        ss.Suite.read(tmp_path, on_error="skip")
    (warning,) = said
    head, *lines = str(warning.message).splitlines()
    assert head == "Suite.read: cannot read 23 of 24 files; they are left out:"
    assert len(lines) == 2 and all(len(line) < 400 for line in lines)


def write_stated(file, label="Acceleration (g)"):
    rows = "".join(f"{t!r},{a!r}\n" for t, a in zip(TIMES.tolist(), pulse(0.3).tolist()))
    file.write_text(f"Time (s),{label}\n{rows}")
    return file


# ---- vertical components


@pytest.fixture
def three(tmp_path):
    """A file of three components, of which the vertical one is the strongest."""
    rows = "".join(
        ",".join(map(repr, row)) + "\n"
        for row in zip(TIMES.tolist(), *(pulse(a, f).tolist() for a, f in SIZES))
    )
    file = tmp_path / "three.csv"
    file.write_text("Time (s),NS (g),EW (g),UD (g)\n" + rows)
    return file


SIZES = [(0.3, 1.0), (0.25, 1.7), (2.0, 1.1)]


def test_a_vertical_component_never_slides_unasked(three, capsys):
    code, out, err = run(capsys, "newmark", three, "--component", "all", "--ky", 0.05, "--json")
    document = json.loads(out)
    assert code == 0
    assert len(document["results"]) == 2
    assert [one["file"] for one in document["left_out"]] == [str(three)]
    assert err.count("\n") == 1 and "vertical component (UD)" in err
    horizontal = [slide_at(ss.read_record(three, component=k), 0.05) for k in (1, 2)]
    mean = document["statistics"][0]["inverse_m"]
    assert mean == pytest.approx(sum(horizontal) / 2, rel=1e-12)

    code, out, err = run(capsys, "slide", three, "--component", "all", "--mu", 0.1, "--json")
    assert [row["component"] for row in json.loads(out)["results"]] == [1, 2]
    for wanted in ("UD", "3", "vertical"):
        code, out, err = run(capsys, "slide", three, "--component", wanted, "--mu", 0.1, "--json")
        assert (code, err, len(json.loads(out)["results"])) == (0, "", 1)
    code, out, _ = run(capsys, "records", three, "--json")
    assert len(json.loads(out)["records"]) == 3  # it lists, and slides nothing


def slide_at(motion, ky):
    law = ss.Coulomb(mu=ky, backward=float("inf"))
    return ss.integrate(law, motion, settle=True).residual


def test_a_suite_holds_a_vertical_component_only_if_it_is_asked_for(three):
    with pytest.warns(RuntimeWarning, match=r"left out.*three.csv: a vertical component \(UD\)"):
        suite = ss.Suite.read(three, component="all")
    assert suite.component.tolist() == ["NS", "EW"]
    assert [one.file for one in suite.left_out] == [str(three)]
    for wanted in ("UD", 3, "vertical"):
        (only,) = ss.Suite.read(three, component=wanted)
        assert only.orientation == "UD"
    everything = ss.read_record(three, component="all")
    for use in (
        lambda: ss.sweep(BLOCK, everything),
        lambda: ss.run_ensemble(BLOCK, everything, members=10, seed=1),
        lambda: ss.sweep(BLOCK, ss.Suite(everything)),
    ):
        with pytest.raises(ValueError, match=r"1 of 3 .* vertical, such as motions\[2\]"):
            use()
    assert ss.sweep(BLOCK, everything[2:]).peak.shape == (1, 1, 2)


def test_a_folder_with_a_vertical_file_slides_the_others(tmp_path, capsys):
    write_stated(tmp_path / "level.csv")
    upright = tmp_path / "upright.AT2"
    upright.write_text(
        "PEER NGA STRONG MOTION DATABASE RECORD\nQuake, AAA, UP\n"
        "ACCELERATION TIME SERIES IN UNITS OF G\nNPTS= 600, DT= .01 SEC\n"
        + "\n".join(map(repr, pulse(2).tolist()))
    )
    code, out, err = run(capsys, "slide", tmp_path, "--mu", 0.1)
    assert (code, len(out.splitlines())) == (0, 2)
    assert err == (
        f"stickslip: left out: {upright}: a vertical component (UP); --component vertical slides"
        " along it\n"
    )
    with pytest.warns(RuntimeWarning, match="sliders move horizontally"):
        assert ss.Suite.read(tmp_path).names == ("level",)
    with pytest.raises(ValueError, match=r'no horizontal component .*component="vertical" reads'):
        ss.Suite.read(upright)
    code, out, err = run(capsys, "slide", upright, "--mu", 0.1)
    assert (code, out, err.count("\n")) == (1, "", 1)
    # Its orientation may come from the table, too.
    column(tmp_path / "silent.txt", pulse(2))
    table = {"file": ["silent"], "direction": ["up"]}
    with pytest.warns(RuntimeWarning, match=r"silent.txt: a vertical component \(up\)"):
        suite = ss.Suite.read(
            tmp_path.glob("*[lt].*"), metadata=table, orientation="direction", dt=0.01, units="g"
        )
    assert suite.names == ("level",)


# ---- stations of several files


def test_files_become_a_station_on_the_command_line(tmp_path, capsys):
    for name, (a, f) in zip(("AAA-000", "AAA-090", "AAA-UP", "BBB-045", "BBB-315"), [*SIZES] * 2):
        column(tmp_path / f"{name}.txt", pulse(a, f))
    given = ["--units", "g", "--dt", 0.01]
    code, out, err = run(capsys, "slide", tmp_path, "--mu", 0.1, "--station", *given, "--json")
    rows = json.loads(out)["results"]
    assert (code, err) == (0, "")
    assert [row["components"] for row in rows] == ["2 axis + vertical", "2 axis"] or [
        row["components"] for row in rows
    ] == ["axis + vertical", "axis"]
    suite = ss.Suite.read(tmp_path, stations=True, units="g", dt=0.01)
    law = ss.Coulomb(mu=0.1)
    for row, motion in zip(rows, suite, strict=True):
        assert row["record"] == motion.name
        assert row["peak_m"] == ss.integrate(law, motion, settle=True).peak
    code, out, _ = run(
        capsys, "slide", tmp_path, "--mu", 0.1, "--station", "--component", 30, *given, "--json"
    )
    turned = ss.Suite.read(tmp_path, stations=True, units="g", dt=0.01, along=30)
    peaks = [ss.integrate(law, motion, settle=True).peak for motion in turned]
    assert [row["peak_m"] for row in json.loads(out)["results"]] == peaks


def test_the_directions_of_a_station_may_be_given_for_each_file_or_by_a_column(tmp_path, capsys):
    files = [column(tmp_path / f"{name}.txt", pulse(*size)) for name, size in zip("abc", SIZES)]
    given = ["--units", "g", "--dt", 0.01, "--mu", 0.1, "--station", "--json"]
    code, out, err = run(capsys, "slide", *files, "--orientation", 30, 120, "up", *given)
    assert (code, err) == (0, "")
    (row,) = json.loads(out)["results"]
    whole = ss.read_station(files, orientations=[30, 120, "up"], units="g", dt=0.01)
    assert row["peak_m"] == ss.integrate(ss.Coulomb(mu=0.1), whole, settle=True).peak
    code, out, err = run(capsys, "slide", *files, "--orientation", 30, 120, *given)
    assert code == 2 and "one direction for each of the 3 records, got 2" in err
    # Without --station each file is a record; two may point the same way.
    code, out, err = run(
        capsys,
        "records",
        *files,
        "--orientation",
        30,
        30,
        "up",
        "--units",
        "g",
        "--dt",
        0.01,
        "--json",
    )
    assert [one["orientation"] for one in json.loads(out)["records"]] == ["30", "30", "up"]
    # With a column, the names say which files belong together.
    for file, name in zip(files, ("X-007", "X-097", "X-V"), strict=True):
        file.rename(tmp_path / f"{name}.txt")
    with (tmp_path / "table.csv").open("w", newline="") as stream:
        table = csv.writer(stream)
        table.writerows([("file", "azimuth"), ("X-007", 30), ("X-097", 120), ("X-V", "up")])
    code, out, err = run(
        capsys, "slide", tmp_path, "--metadata", tmp_path / "table.csv",
        "--orientation", "azimuth", "--component", 30, *given,
    )  # fmt: skip
    assert (code, err) == (0, "")
    (row,) = json.loads(out)["results"]
    assert row["peak_m"] == ss.integrate(ss.Coulomb(mu=0.1), whole, settle=True).peak


def test_two_horizontal_components_without_azimuths_are_a_station(tmp_path, capsys):
    files = []
    for name, size in zip(("H1", "H2", "UP"), SIZES):
        samples = "\n".join(map(repr, pulse(*size).tolist()))
        files.append(tmp_path / f"RSN1_QUAKE_{name}.AT2")
        files[-1].write_text(
            f"PEER NGA STRONG MOTION DATABASE RECORD\nQuake, Station, {name}\n"
            f"ACCELERATION TIME SERIES IN UNITS OF G\nNPTS= 600, DT= .01 SEC\n{samples}\n"
        )
    suite = ss.Suite.read(tmp_path, stations=True)
    assert suite.components.tolist() == [3]
    assert suite[0].orientation == "H1"
    for which, file in zip(("axis", "transverse", "vertical"), files):
        assert np.array_equal(
            suite[0].component(which).acceleration, ss.read_record(file).acceleration
        )
    code, out, err = run(capsys, "slide", *files, "--station", "--mu", 0.1, "--json")
    assert (code, err) == (0, "")
    (row,) = json.loads(out)["results"]
    assert row["peak_m"] == ss.integrate(ss.Coulomb(mu=0.1), suite[0], settle=True).peak
    along = ss.Suite.read(tmp_path, stations=True, along="H2")
    assert np.array_equal(along[0].acceleration, ss.read_record(files[1]).acceleration)
    code, out, err = run(capsys, "slide", *files, "--station", "--mu", 0.1, "--component", 30)
    assert (code, out) == (1, "") and "H1 and H2 state none" in err


# ---- the real collection, if there is one


def test_real_pairs_slide_with_their_own_steps(agency_files, capsys):
    pairs = agency_files / "usgs_pairs"
    with (pairs / "pairs.csv").open() as stream:
        steps = {row["file"]: float(row["dt_s"]) for row in csv.DictReader(stream)}
    assert len(set(steps.values())) == 3
    arguments = ["newmark", pairs, "--units", "g", "--ky", 0.1, "--metadata", pairs / "pairs.csv"]
    for more in ([], ["--dt", "dt_s"], ["--dt", 0.01]):
        code, out, _ = run(capsys, *arguments, *more, "--json")
        rows = json.loads(out)["results"]
        assert (code, len(rows)) == (0, 22)
        (row,) = [row for row in rows if row["record"] == "Cape_Mendocino_1992_CPM-000"]
        # The values of an integrator of its own, in centimeters.
        both = sorted([100 * row["normal_m"], 100 * row["inverse_m"]])
        assert both == pytest.approx([32.03, 51.46], abs=0.005)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # offsets, and the column pga_g
        suite = ss.Suite.read(pairs, metadata=pairs / "pairs.csv", units="g")
    assert {name: m.dt for name, m in zip(suite.file, suite)} == {
        str(pairs / file): dt for file, dt in steps.items()
    }
    # The table has the peaks in g, to three decimal places.
    assert suite.pga_g == pytest.approx(suite.pga_g_given, abs=6e-4)


def test_a_real_vertical_component_is_left_out(agency_files, capsys):
    file = next((agency_files / "geonet").glob("*.V2A"))
    code, out, err = run(capsys, "newmark", file, "--component", "all", "--ky", 0.05, 0.1, "--json")
    document = json.loads(out)
    assert code == 0
    assert len({row["record"] for row in document["results"]}) == 2
    assert "(Up)" in document["left_out"][0]["reason"] and "(Up)" in err
    with pytest.warns(RuntimeWarning, match="a vertical component"):
        assert len(ss.Suite.read(agency_files / "geonet", component="all")) == 2
    with pytest.raises(ValueError, match="no horizontal component"):
        ss.Suite.read(agency_files / "cosmos")
