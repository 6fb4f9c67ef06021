"""The command `stickslip`: the same numbers as the library, and errors that name what was wrong."""

import csv
import gc
import json
import math
import os
import re
import shlex
import signal
import subprocess
import sys
import warnings
import weakref

import numpy as np
import pytest
import stickslip as ss
from sources import waiting_for
from stickslip.cli import main
from stickslip.motions.records import tried

G = ss.STANDARD_GRAVITY


@pytest.fixture
def record(tmp_path):
    """A record of two columns, seconds and g."""
    file = tmp_path / "quake.csv"
    noise = np.random.default_rng(7).standard_normal(500)
    noise = np.convolve(noise, np.repeat([0.08, -0.08], 6), "same")
    rows = "".join(f"{0.02 * i:.2f},{a!r}\n" for i, a in enumerate(noise.tolist()))
    file.write_text(
        "# Time Series: Somewhere 2001 - ABC-090\n# Time (s),Acceleration (g's)\n" + rows
    )
    return file


def run(capsys, *arguments):
    """Exit code, stdout and stderr."""
    code = main(["slide", *map(str, arguments)])
    out, err = capsys.readouterr()
    return code, out, err


def results(capsys, *arguments):
    code, out, err = run(capsys, *arguments, "--json")
    assert (code, err) == (0, "")
    return json.loads(out)["results"]


QUAKE = ["--event", "moderate near field", "--mu", 0.02, "--members", 500]


def run_ensemble(capsys, *arguments):
    code = main(["ensemble", *map(str, arguments)])
    out, err = capsys.readouterr()
    return code, out, err


CASES = {
    "block": (["--mu", 0.1], ss.Coulomb(mu=0.1)),
    "caster": (["--mu", 0.1, "--law", "caster", "--reach", 0.9], ss.Caster(mu=0.1, reach=0.9)),
    "caster of a geometry": (
        ["--mu", 0.5, "--law", "caster", "--trail", 0.9, "--wheel-width", 2],
        ss.Caster.from_geometry(mu=0.5, trail=0.9, wheel_width=2.0),
    ),
    "one-way": (["--mu", 0.1, "--law", "one-way"], ss.Coulomb(mu=0.1, backward=math.inf)),
    "slope": (["--mu", 0.3, "--slope", 10], ss.Slider(ss.Coulomb(mu=0.3), slope_degrees=10)),
    "slope one-way": (
        ["--mu", 0.3, "--slope", 10, "--law", "one-way"],
        ss.Slider(ss.Coulomb(mu=0.3), slope_degrees=10, one_way=True),
    ),
    "spring": (
        ["--mu", 0.06, "--period", 2.5],
        ss.Slider(ss.Coulomb(mu=0.06), natural_frequency=2 * math.pi / 2.5),
    ),
    "spring and damper": (
        ["--mu", 0.06, "--period", 2.5, "--damping-ratio", 0.1],
        ss.Slider(ss.Coulomb(mu=0.06), period=2.5, damping_ratio=0.1),
    ),
    "static": (
        ["--mu", 0.1, "--mu-static", 0.15],
        ss.StaticKinetic(mu_static=0.15, mu_kinetic=0.1),
    ),
    "static caster": (
        ["--mu", 0.1, "--mu-static", 0.15, "--law", "caster", "--reach", 0.9],
        ss.StaticKinetic(ss.Caster(mu=0.1, reach=0.9), mu_static=0.15),
    ),
    "static one-way": (
        ["--mu", 0.1, "--mu-static", 0.15, "--law", "one-way"],
        ss.Slider(ss.StaticKinetic(mu_static=0.15, mu_kinetic=0.1), one_way=True),
    ),
    "stops": (
        ["--mu", 0.1, "--stop-gap", 0.01, "--restitution", 0.4],
        ss.Slider(ss.Coulomb(mu=0.1), stops=ss.Stops(gap=0.01, restitution=0.4)),
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_the_command_answers_exactly_as_the_library(capsys, record, case):
    options, slider = CASES[case]
    (row,) = results(capsys, record, *options)
    r = ss.integrate(slider, ss.read_record(record), settle=True)
    assert row["peak_m"] == r.peak
    assert row["residual_m"] == r.residual
    assert row["sliding_distance_m"] == r.sliding_distance
    assert row["time_sliding_s"] == r.time_sliding
    assert row["at_rest"] is True
    assert row["slips"] == np.isin(r.events["kind"], ["breakaway", "reversal"]).sum() > 0
    assert row["pga_g"] == r.motion.peak_acceleration / G
    assert row["record"] == r.motion.name
    for side, sign in (("forward", 1), ("backward", -1)):
        hits = r.impacts[sign * r.impacts["displacement"] > 0]
        stops = r.slider.stops is not None
        speed = abs(hits["velocity"]).max(initial=0)
        assert row[f"impacts_{side}"] == (len(hits) if stops else None)
        assert row[f"impact_speed_{side}_m_s"] == (speed if stops else None)


def test_the_table_shows_the_stops_that_were_given_and_the_impacts(capsys, record):
    options, slider = CASES["stops"]
    code, out, err = run(capsys, record, *options, "--mu-static", 0.15)
    assert (code, err) == (0, "")
    head, row = out.splitlines()
    for word in ("static mu", "stop gap [m]", "restitution", "impacts  at most [m/s]"):
        assert word in head
    held = ss.StaticKinetic(mu_static=0.15, mu_kinetic=0.1)
    r = ss.integrate(ss.Slider(held, stops=slider.stops), ss.read_record(record), settle=True)
    assert row.split()[-2:] == [str(len(r.impacts)), f"{abs(r.impacts['velocity']).max():.3g}"]


def test_the_options_given_have_their_columns_under_one_record_and_under_a_folder(
    capsys, record, tmp_path
):
    folder = tmp_path / "two"
    folder.mkdir()
    for name in ("a", "b"):
        (folder / name).with_suffix(record.suffix).write_bytes(record.read_bytes())
    options = ["--mu", 0.1, "--mu-static", 0.15, "--stop-gap", 0.0125, "--restitution", 0.4]
    given = {"static mu": "0.15", "stop gap [m]": "0.0125", "restitution": "0.4"}
    for files, count in ((record, 1), (folder, 2)):
        code, out, err = run(capsys, files, *options)
        head, *rows = out.splitlines()
        assert (code, err, len(rows)) == (0, "", count)
        for word, value in given.items():
            end = head.index(word) + len(word)
            assert [row[:end].split()[-1] for row in rows] == [value] * count


def test_a_scaled_record_is_the_record_scaled(capsys, record):
    (row,) = results(capsys, record, "--mu", 0.1, "--scale", 1.5)
    scaled = ss.read_record(record).scaled(1.5)
    assert row["peak_m"] == ss.integrate(ss.Coulomb(mu=0.1), scaled, settle=True).peak


def test_the_table_has_a_row_for_each_coefficient_and_says_its_units(capsys, record):
    code, out, err = run(capsys, record, "--mu", 0.1, 0.2, 3)
    assert (code, err) == (0, "")
    head, *rows = out.splitlines()
    for word in ("PGA [g]", "peak [cm]", "residual [cm]", "distance [cm]", "sliding [s]", "slips"):
        assert word in head
    assert len(rows) == 3
    motion = ss.read_record(record)
    for mu, row in zip((0.1, 0.2, 3), rows):
        r = ss.integrate(ss.Coulomb(mu=mu), motion, settle=True)
        numbers = row.split()[-6:]
        assert numbers[:3] == [f"{mu:g}", f"{100 * r.peak:.2f}", f"{100 * r.residual:.2f}"]
    assert rows[0].startswith("Somewhere 2001 - ABC-090")
    assert rows[2].split()[-1] == "0"


@pytest.mark.parametrize("factor", [1e4, 1e12, 1e90, -1e98])
def test_columns_keep_their_width_under_huge_numbers(capsys, record, factor):
    _, out, _ = run(capsys, record, "--mu", 0.1, f"--scale={factor}")
    head, row = out.splitlines()
    assert len(row.removesuffix("  never rests: at end of record")) == len(head)
    with_mu = row.split("ABC-090")[1].split()
    (exact,) = results(capsys, record, "--mu", 0.1, f"--scale={factor}")
    for text, name in ((with_mu[0], "pga_g"), (with_mu[2], "peak_m"), (with_mu[3], "residual_m")):
        value = exact[name] * (1 if name == "pga_g" else 100)
        assert float(text) == pytest.approx(value, rel=0.05, abs=0.005)  # two digits at least


@pytest.mark.filterwarnings("ignore::stickslip.PlausibilityWarning")  # without a part of it
def test_one_column_takes_a_time_step_and_a_gap_a_flag(capsys, tmp_path, record):
    quake = ss.read_record(record)
    column = tmp_path / "column.txt"
    column.write_text("\n".join(f"{a / G!r}" for a in quake.acceleration.tolist()))
    (row,) = results(capsys, column, "--mu", 0.1, "--units", "g", "--dt", 0.02)
    (same,) = results(capsys, record, "--mu", 0.1)
    assert row["peak_m"] == pytest.approx(same["peak_m"], rel=1e-12)
    code, _, err = run(capsys, column, "--mu", 0.1, "--units", "g")
    assert code == 1
    assert "no time step: give --dt" in err
    rows = record.read_text().splitlines()
    gap = tmp_path / "gap.csv"
    gap.write_text("\n".join(rows[:100] + rows[120:]))
    code, _, err = run(capsys, gap, "--mu", 0.1)
    assert code == 1
    assert "a gap of 0.42 s after 1.94 s" in err
    assert "give --gaps" in err
    code, out, _ = run(capsys, gap, "--mu", 0.1, "--gaps", "--json")
    assert code == 0
    assert len(json.loads(out)["results"]) == 1


def test_a_record_may_come_from_standard_input(record):
    command = [sys.executable, "-m", "stickslip", "slide", "-", "--mu", "0.1", "--json"]
    piped = subprocess.run(command, input=record.read_bytes(), capture_output=True, check=True)
    (row,) = json.loads(piped.stdout)["results"]
    expected = ss.integrate(ss.Coulomb(mu=0.1), ss.read_record(record), settle=True)
    assert (row["file"], row["peak_m"]) == ("-", expected.peak)


def test_a_slider_that_never_rests_is_an_answer_and_says_so(capsys, record):
    code, out, _ = run(capsys, record, "--mu", 0)
    assert code == 0
    assert "never rests" in out
    (row,) = results(capsys, record, "--mu", 0)
    assert row["at_rest"] is False
    assert row["peak_m"] == ss.integrate(ss.Coulomb(mu=0), ss.read_record(record)).peak


REFUSED = {
    "bad units": (["RECORD", "--mu", 0.1, "--units", "furlong"], "'furlong'"),
    "negative friction": (["RECORD", "--mu", -0.25], "got -0.25"),
    "one bad among good": (["RECORD", "--mu", 0.1, "nan"], "got nan"),
    "caster without reach": (["RECORD", "--mu", 0.1, "--law", "caster"], "--reach"),
    "reach without caster": (
        ["RECORD", "--mu", 0.1, "--reach", 1],
        "--law caster, got --law coulomb",
    ),
    "trail without width": (
        ["RECORD", "--mu", 0.1, "--law", "caster", "--trail", 0.04],
        "--trail and --wheel-width, in meters, got --trail",
    ),
    "too steep": (["RECORD", "--mu", 0.1, "--slope", 45], "45 degrees"),
    "no period": (["RECORD", "--mu", 0.1, "--period", 0], "got 0 s"),
    "NaN period": (["RECORD", "--mu", 0.1, "--period", "nan"], "got nan s"),
    "damping without a spring": (
        ["RECORD", "--mu", 0.1, "--damping-ratio", 0.1],
        "--damping-ratio goes with a finite --period, got 0.1 without",
    ),
    "negative damping": (
        ["RECORD", "--mu", 0.1, "--period", 2, "--damping-ratio", -0.1],
        "--damping-ratio must be finite and at least 0, got -0.1",
    ),
    "static below kinetic": (
        ["RECORD", "--mu", 0.1, "--mu-static", 0.05],
        "--mu-static must be finite and at least --mu, 0.1, got 0.05",
    ),
    "NaN static": (["RECORD", "--mu", 0.1, "--mu-static", "nan"], "at least --mu, 0.1, got nan"),
    "stops without restitution": (
        ["RECORD", "--mu", 0.1, "--stop-gap", 0.1],
        "--stop-gap needs --restitution",
    ),
    "restitution without stops": (
        ["RECORD", "--mu", 0.1, "--restitution", 0.1],
        "--restitution goes with --stop-gap, got 0.1 without",
    ),
    "restitution above 1": (
        ["RECORD", "--mu", 0.1, "--stop-gap", 0.1, "--restitution", 2],
        "restitution must be from 0 to 1, got 2",
    ),
    "all components of a station": (
        ["RECORD", "--mu", 0.1, "--station", "--component", "all"],
        "--station slides along one direction, got --component all",
    ),
    "one vertical for two records": (
        ["RECORD", "other.csv", "--mu", 0.1, "--vertical", "up.csv"],
        "--vertical goes with one record, got 2",
    ),
    "infinite scale": (
        ["RECORD", "--mu", 0.1, "--scale", "inf"],
        "--scale must be finite, got inf",
    ),
}


@pytest.mark.parametrize("strict", [[], ["--strict"]], ids=["", "strict"])
@pytest.mark.parametrize("file", ["RECORD", "nowhere.csv"])
@pytest.mark.parametrize("case", REFUSED)
def test_a_bad_option_is_named_on_stderr_with_code_2_before_any_file_is_read(
    capsys, record, case, file, strict
):
    (_, *options), message = REFUSED[case]
    file = record if file == "RECORD" else file  # options are judged before a file is read
    code, out, err = run(capsys, file, *options, *strict)
    assert (code, out) == (2, "")
    assert err.startswith("stickslip: ")
    assert message in err
    assert err.count("\n") == 1


@pytest.mark.parametrize(
    "arguments", [[], ["slide"], ["slide", "a.csv", "--mu"], ["slide", "a", "--mu", "x"]]
)
def test_arguments_that_do_not_parse_end_with_code_2(capsys, arguments):
    with pytest.raises(SystemExit) as end:
        main(arguments)
    assert end.value.code == 2


def test_the_version_says_what_the_build_contains_and_its_licence(capsys):
    with pytest.raises(SystemExit) as end:
        main(["--version"])
    assert end.value.code == 0
    out = capsys.readouterr().out
    info = ss.build_info()
    assert out.startswith(f"stickslip {info['version']}")
    assert "BSD-3-Clause" in out
    assert ("GPL-3.0-or-later" in out) == bool(info["fftw"] or info["gsl"])
    for library in ("Eigen", "FFTW", "GSL", "Highway", "SUNDIALS"):
        assert f"{library} {info[library.lower()]}" in out


# ---- vertical motion


@pytest.fixture
def station(tmp_path, record):
    """A file of all three components; the vertical one is up to 2.5 times the slider's weight."""
    quake = ss.read_record(record)
    up = 2.5 * G * np.sin(9 * quake.time) * np.sin(math.pi * quake.time / quake.duration)
    components = [quake.acceleration, quake.acceleration[::-1], up]
    rows = np.column_stack([quake.time, np.transpose(components) / G]).tolist()
    file = tmp_path / "station.csv"
    text = "".join(",".join(map(repr, row)) + "\n" for row in rows)
    file.write_text("Time (s), NS (g), EW (g), UD (g)\n" + text)
    return file


@pytest.mark.filterwarnings("ignore::stickslip.PlausibilityWarning")
def test_the_vertical_component_of_a_station_acts(capsys, station):
    motion = ss.read_station(station)
    assert motion.vertical is not None
    answers = []
    for contact in ("flight", "clipped"):
        (row,) = results(capsys, station, "--station", "--mu", 0.1, "--contact", contact)
        r = ss.integrate(ss.Coulomb(mu=0.1), motion, settle=True, contact=contact)
        assert (row["peak_m"], row["residual_m"]) == (r.peak, r.residual)
        assert (row["contact"], row["components"]) == (contact, "axis + vertical")
        assert row["liftoffs"] == (r.events["kind"] == "liftoff").sum()
        assert (row["liftoffs"] > 0) == (contact == "flight")
        main(["slide", str(station), "--station", "--mu", "0.1", "--contact", contact])
        line = capsys.readouterr().out.splitlines()[-1]
        leaves = 1 if contact == "flight" else 0
        assert line == (
            f"(vertical motion acts in all of 1 rows; the slider leaves the ground in {leaves})"
        )
        answers.append(row["peak_m"])
    assert answers[0] != answers[1]
    (row,) = results(capsys, station, "--component", "NS", "--mu", 0.1)
    assert (row["components"], row["liftoffs"]) == ("axis", None)
    (row,) = results(capsys, station, "--station", "--component", 30, "--mu", 0.1)
    r = ss.integrate(ss.Coulomb(mu=0.1), ss.read_station(station, along=30), settle=True)
    assert row["peak_m"] == r.peak


@pytest.mark.filterwarnings("ignore::stickslip.PlausibilityWarning")
@pytest.mark.filterwarnings("ignore:.*no other component of its station:RuntimeWarning")
def test_orientations_slides_along_all_directions_of_a_station(capsys, station, tmp_path):
    motion, files = ss.read_station(station), (tmp_path / "t.csv", tmp_path / "t.png")
    outputs = ["--csv", str(files[0]), "--plot", str(files[1])]
    main(["orientations", str(station), "--mu", "0.1", *outputs])
    out = capsys.readouterr().out.splitlines()
    t = ss.orientations(ss.Coulomb(mu=0.1), motion, settle=True)
    assert t.from_north
    assert out[1].split()[:2] == ["station", "mu"]
    found = [float(cell) for cell in out[2].split()[-8:]]
    most = t.rotd100
    assert found[2:4] == [pytest.approx(100 * most.peak, abs=0.006), most.peak_degrees]
    assert found[5] == pytest.approx(100 * t.rotd50.residual, abs=0.006)
    assert files[1].stat().st_size > 10_000
    with files[0].open() as stream:
        rows = list(csv.DictReader(stream))
    assert [float(row["degrees"]) for row in rows] == t.degrees.tolist()
    assert [float(row["peak_m"]) for row in rows] == t.peak.tolist()

    options = ["--mu", "0.1", "0.2", "--slope", "5", "--degrees", "0:90:30", "--json"]
    main(["orientations", str(station), *options, "--contact", "clipped"])
    document = json.loads(capsys.readouterr().out)
    slider = ss.Slider(ss.Coulomb(mu=0.2), slope_degrees=5)
    t = ss.orientations(slider, motion, [0, 30, 60, 90], settle=True, contact="clipped")
    rows = document["results"]
    assert [row["residual_m"] for row in rows[4:]] == t.residual.tolist()
    assert document["percentiles"][1]["rotd50_peak_m"] == t.rotd50.peak
    one = tmp_path / "one.csv"
    one.write_text("Time (s), NS (g)\n0,0\n0.1,1\n0.2,0\n")
    assert main(["orientations", str(one), "--mu", "0.1", "--orientation", "N"]) == 1
    assert "needs a transverse component" in capsys.readouterr().err


# ---- sweeps


def test_a_sweep_prints_the_statistics_of_the_library(capsys, record, tmp_path):
    other = tmp_path / "other.csv"
    other.write_text("".join(record.read_text().splitlines(True)[:-100]))
    motions = [ss.read_record(one).scaled(1.5) for one in (record, other)]
    files = tmp_path / "t.csv", tmp_path / "t.png"
    options = ["--period", "2:3:1", "--stop-gap", "0.03", "--restitution", "0.2", "--scale", "1.5"]
    command = ["sweep", str(record), str(other), "--mu", "0.05", "0.1", *options]
    assert main([*command, "--csv", str(files[0]), "--plot", str(files[1])]) == 0
    heads, head, *lines = capsys.readouterr().out.splitlines()
    assert main([*command, "--json"]) == 0
    document = json.loads(capsys.readouterr().out)

    stops = ss.Stops(gap=0.03, restitution=0.2)
    blocks = ss.grid(
        ss.Slider, law=ss.grid(ss.Coulomb, mu=[0.05, 0.1]), period=[2.0, 3.0], stops=stops
    )
    table = ss.sweep(blocks, motions, settle=True)
    assert table.impact_fraction.max() > 0
    assert [row["responses"] for row in document["statistics"]] == [4] * 4
    for row, line, i in zip(document["statistics"], lines[:4], range(4)):
        assert (row["mu"], row["period_s"]) == (blocks.parameters["mu"][i], 2 + i % 2)
        expected = []
        for quantity in ("peak", "residual"):
            values = np.abs(getattr(table, quantity)[i]).ravel()
            expected += [values.mean(), *np.quantile(values, [0.16, 0.5, 0.84]), values.max()]
        found = [value for name, value in row.items() if name.startswith(("peak", "residual"))]
        assert found == pytest.approx(expected, rel=1e-14)
        assert row["impact_fraction"] == table.impact_fraction[i]
        cells = [float(cell) for cell in line.split()[3:13]]
        assert cells == pytest.approx([100 * one for one in expected], abs=0.00501)
    assert head.split()[:4] == ["mu", "period", "[s]", "responses"]
    assert heads.split() == ["peak", "[cm]", "residual", "[cm]"]
    assert len(document["results"]) == table.peak.size
    first = document["results"][0]
    assert (first["file"], first["polarity"]) == (str(record), "recorded")
    assert first["peak_m"] == table.peak[0, 0, 0]
    assert first["impacts_forward"] == table.impacts_forward[0, 0, 0]
    with files[0].open() as stream:
        assert [float(row["peak_m"]) for row in csv.DictReader(stream)] == [
            row["peak_m"] for row in document["results"]
        ]
    assert files[1].stat().st_size > 10_000


@pytest.mark.filterwarnings("ignore::stickslip.PlausibilityWarning")
def test_a_sweep_in_the_plane_takes_both_components_of_stations(capsys, station, record, tmp_path):
    assert main(["sweep", str(station), "--planar", "--mu", "0.1", "0.2", "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    blocks = [ss.PlanarSlider(ss.Coulomb(mu=mu)) for mu in (0.1, 0.2)]
    table = ss.sweep(blocks, ss.read_station(station), settle=True, polarity="recorded")
    rows = document["results"]
    assert [row["peak_m"] for row in rows] == table.peak.ravel().tolist()
    assert [row["residual_axis_m"] for row in rows] == table.residual_axis.ravel().tolist()
    assert [row["peak_median_m"] for row in document["statistics"]] == table.mean().tolist()

    one = tmp_path / "one.csv"
    one.write_text("Time (s), NS (g)\n0,0\n0.1,1\n0.2,0\n")
    options = ["--planar", "--mu", "0.1", "--orientation", "N"]
    for command in ("sweep", "slide"):
        assert main([command, str(one), *options]) == 1
        out, err = capsys.readouterr()
        assert out == ""
        assert "needs a transverse component, found only 'one" in err
        assert "give the file of the other horizontal component, too" in err


def test_a_sweep_reports_blocks_that_never_rest_and_counts_the_others(capsys, record):
    assert main(["sweep", str(record), "--mu", "0", "0.1"]) == 1
    out, err = capsys.readouterr()
    assert (
        err
        == f"stickslip: {record}: mu = 0: without ground motion the slider does not come to rest\n"
    )
    (row,) = out.splitlines()[2:]
    assert row.split()[:2] == ["0.1", "2"]


@pytest.mark.parametrize("command", ["slide", "sweep"])
@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--law", "one-way"], "--planar goes with --law coulomb, got --law one-way"),
        (["--polarity", "both"], "--planar has no --polarity on level ground"),
        (["--vertical", "up.csv"], "--planar takes the vertical component from the station"),
    ],
)
def test_what_the_plane_excludes_is_refused(capsys, command, options, message):
    assert main([command, "nowhere.csv", "--planar", "--mu", "0.1", *options]) == 2
    assert message in capsys.readouterr().err


@pytest.mark.filterwarnings("ignore::stickslip.PlausibilityWarning")
def test_the_vertical_component_may_have_a_file_of_its_own(capsys, record, station, tmp_path):
    up = ss.read_station(station).component("vertical").acceleration / G
    rows = "".join(f"{0.02 * i:.2f},{a!r}\n" for i, a in enumerate(up.tolist()))
    file = tmp_path / "up.csv"
    file.write_text("# Time (s),Acceleration (g's)\n" + rows)
    options = ["--vertical", file, "--mu", 0.1]
    (row,) = results(capsys, record, *options)
    quake = ss.read_record(record)
    both = ss.GroundMotion(quake.acceleration, quake.dt, vertical=ss.read_record(file).acceleration)
    r = ss.integrate(ss.Coulomb(mu=0.1), both, settle=True)
    assert (row["peak_m"], row["residual_m"]) == (r.peak, r.residual)
    assert row["components"] == "axis + vertical"

    code, out, err = run(capsys, record, *options, "--csv", file)
    assert (code, out) == (2, "")
    assert "would overwrite the record" in err
    file.write_text("".join(file.read_text().splitlines(True)[:-1]))
    code, _, err = run(capsys, record, *options)
    assert code == 1
    assert "--vertical must have the samples of the record, 500 of 0.02 s, got 499 of 0.02 s" in err
    file.unlink()
    code, _, err = run(capsys, record, *options)
    assert code == 1
    assert "up.csv" in err
    assert err.count("\n") == 1


# ---- batches


@pytest.fixture
def bad_files(tmp_path):
    """Files that are not records, and the error message for each."""
    (tmp_path / "folder").mkdir()
    (tmp_path / "empty.csv").touch()
    (tmp_path / "picture.png").write_bytes(b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR")
    (tmp_path / "words.txt").write_text("nothing\n")
    return {
        tmp_path / "folder": "the folder holds no files",
        tmp_path / "empty.csv": "the file is empty",
        tmp_path / "nowhere.csv": "No such file or directory",
        tmp_path / "picture.png": "NUL byte",
        tmp_path / "words.txt": "no known format",
    }


def test_bad_files_are_named_and_the_good_ones_are_answered(capsys, record, bad_files):
    _, alone, _ = run(capsys, record, record, "--mu", 0.1, 0.2)
    code, out, err = run(capsys, record, *bad_files, record, "--mu", 0.1, 0.2)
    assert (code, out) == (1, alone)
    lines = err.splitlines()
    assert len(lines) == len(bad_files)
    for line, (file, reason) in zip(lines, bad_files.items()):
        assert line.startswith(f"stickslip: {file}: ")
        assert reason in line
        assert line.count(str(file)) == 1


def test_json_lists_the_bad_files_beside_the_results(capsys, record, bad_files):
    good = results(capsys, record, "--mu", 0.1)
    code, out, err = run(capsys, *bad_files, record, "--mu", 0.1, "--json")
    assert code == 1
    document = json.loads(out)
    assert document["results"] == good
    assert [error["file"] for error in document["errors"]] == [str(file) for file in bad_files]
    for error, reason, line in zip(document["errors"], bad_files.values(), err.splitlines()):
        assert reason in error["error"]
        assert line == f"stickslip: {error['file']}: {error['error']}"
    code, out, err = run(capsys, record, "--mu", 0.1, "--json")
    assert json.loads(out)["errors"] == []


def test_where_every_file_is_bad_there_is_no_table(capsys, bad_files):
    code, out, err = run(capsys, *bad_files, "--mu", 0.1)
    assert (code, out, err.count("\n")) == (1, "", len(bad_files))
    code, out, _ = run(capsys, *bad_files, "--mu", 0.1, "--json")
    document = json.loads(out)
    assert (code, document["results"], len(document["errors"])) == (1, [], len(bad_files))


@pytest.mark.parametrize("more", [[], ["--json"]])
def test_strict_ends_a_batch_at_the_first_bad_file(capsys, record, bad_files, more):
    first, *_ = bad_files
    code, out, err = run(capsys, record, *bad_files, "--mu", 0.1, "--strict", *more)
    assert (code, out) == (2, "")
    assert err == f"stickslip: {first}: the folder holds no files\n"


@pytest.fixture
def violent(tmp_path):
    """Ground whose acceleration, but not the displacement of a block on it, is a double."""
    file = tmp_path / "violent.csv"
    file.write_text("Time (s),Acceleration (g)\n0,0\n1e150,1e98\n2e150,1e98\n3e150,0\n")
    return file


def test_a_slider_that_leaves_the_range_of_doubles_is_reported_and_the_others_answered(
    capsys, record, violent
):
    options = ["--mu", 0.1, 1e99]
    good = results(capsys, record, *options)
    code, out, err = run(capsys, violent, record, *options, "--json")
    document = json.loads(out)
    assert code == 1
    (error,) = document["errors"]
    assert error["file"] == str(violent)
    assert error["error"].startswith("mu = 0.1: ")
    assert err == f"stickslip: {violent}: {error['error']}\n"
    held, *others = document["results"]
    assert others == good
    assert (held["file"], held["mu"], held["peak_m"]) == (str(violent), 1e99, 0)
    code, out, strict = run(capsys, violent, record, *options, "--strict")
    assert (code, out, strict) == (2, "", err)


@pytest.mark.parametrize("text", ["", "std::bad_alloc", "Unable to allocate 9 EiB"])
def test_without_enough_memory_there_is_one_line(capsys, record, monkeypatch, text):
    def full(*_, **__):
        raise MemoryError(text)

    said = "not enough memory" + (f": {text}" if text.startswith("U") else "")
    monkeypatch.setattr("stickslip.ensemble.run_ensemble", full)
    assert run_ensemble(capsys, *QUAKE) == (2, "", f"stickslip: {said}\n")
    monkeypatch.setattr("stickslip.cli.reading.tried", full)
    assert run(capsys, record, "--mu", 0.1) == (1, "", f"stickslip: {record}: {said}\n")


# ---- options

REPEATED = {
    "scale": ["slide", "RECORD", "--mu", "0.1", "--scale", "2", "--scale", "3"],
    "equal scales": ["slide", "RECORD", "--mu", "0.1", "--scale", "2", "--scale", "2"],
    "shortened": ["slide", "RECORD", "--mu", "0.1", "--scale", "2", "--sca", "3"],
    "law": ["slide", "RECORD", "--mu", "0.1", "--law", "coulomb", "--law", "one-way"],
    "seed": ["ensemble", "--event", "great near field", "--mu", "0.1", "--seed=1", "--seed=2"],
    "band": ["ensemble", "--mu", "0.1", "--band", *"123", "--band", *"456"],
    "out": ["thesis", "2.1", "--check", "--out", "a", "--out", "b"],
}


@pytest.mark.parametrize("case", REPEATED)
def test_an_option_of_one_value_is_given_once(capsys, record, case, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    arguments = [str(record) if a == "RECORD" else a for a in REPEATED[case]]
    with pytest.raises(SystemExit) as end:
        main(arguments)
    out, err = capsys.readouterr()
    assert (end.value.code, out) == (2, "")
    assert f"--{'scale' if 'scale' in ' '.join(arguments) else case} given twice: " in err


def test_lists_that_are_repeated_add_up_and_a_repeated_value_is_used_once(capsys, record):
    rows = results(capsys, record, "--mu", 0.1, 0.2, "--mu", 0.3, "--mu", 0.1)
    assert [row["mu"] for row in rows] == [0.1, 0.2, 0.3]
    code, out, _ = run_ensemble(
        capsys, *QUAKE, "--level", 0.02, "--level", 0.05, 0.02, "--level", 0.01, "--json"
    )
    assert code == 0
    assert [row["peak_m"] for row in json.loads(out)["exceedance"]] == [0.02, 0.05, 0.01]


@pytest.mark.parametrize("arguments", [["2.1", "--check"], ["--check", "2.1", "2.1"]])
def test_a_figure_is_named_before_or_after_the_options_and_drawn_once(capsys, arguments):
    assert main(["thesis", *arguments]) == 0
    assert capsys.readouterr().out.splitlines()[-1].startswith("1 figure, ")


@pytest.mark.skipif(os.name == "nt", reason="Windows has no bytes in arguments")
@pytest.mark.parametrize(
    "arguments",
    [
        ["slide", "a.csv", "--mu", "1", "--units", "\udcff"],
        ["slide", "a.csv", "--mu", "1", "--component", "\udcff"],
        ["ensemble", "--mu", "1", "--event", "\udcff"],
    ],
)
def test_an_option_that_is_no_text_is_named(capsys, arguments):
    with pytest.raises(SystemExit) as end:
        main(arguments)
    assert end.value.code == 2
    assert arguments[-2] in capsys.readouterr().err


def test_infinity_is_null_in_json(capsys, record):
    block = results(capsys, record, "--mu", 0.1)
    (row,) = results(capsys, record, "--mu", 0.1, "--law", "caster", "--reach", "inf")
    assert row["reach_m"] is None
    # Casters of infinite reach are a block, integrated by Taylor series.
    assert row["peak_m"] == pytest.approx(block[0]["peak_m"], rel=1e-12)
    (row,) = results(capsys, record, "--mu", 0.1, "--period", "inf")
    assert (row["period_s"], row["peak_m"]) == (None, block[0]["peak_m"])
    code, out, _ = run_ensemble(
        capsys, *QUAKE, "--law", "caster", "--reach", "inf", "--level", 0, "--json"
    )
    assert code == 0
    assert json.loads(out)["configuration"]["slider"]["reach"] is None


# ---- outputs


def links(file):
    """Other names of a file."""
    folder = file.parent
    (folder / "soft.svg").symlink_to(file)
    os.link(file, folder / "hard.svg")
    return [
        file,
        folder / "soft.svg",
        folder / "hard.svg",
        folder / "." / ".." / folder.name / file.name,
    ]


def test_no_record_is_overwritten_by_its_picture(capsys, record):
    pytest.importorskip("matplotlib")
    record = record.rename(record.with_suffix(".svg"))
    content = record.read_bytes()
    for name in links(record):
        code, out, err = run(capsys, record, "--mu", 0.1, "--plot", name)
        assert (code, out) == (2, "")
        assert err == f"stickslip: --plot {name} would overwrite the record {record}\n"
    again = record.with_name("out-1-quake.svg")
    again.write_bytes(content)
    code, out, err = run(capsys, record, again, "--mu", 0.1, "--plot", record.with_name("out.svg"))
    assert (code, out) == (2, "")
    assert "would overwrite the record" in err
    assert record.read_bytes() == again.read_bytes() == content


def test_a_checkpoint_and_a_picture_are_two_files(capsys, tmp_path):
    pytest.importorskip("matplotlib")
    kept = tmp_path / "run.svg"
    options = [*QUAKE, "--checkpoint", kept, "--plot"]
    assert run_ensemble(capsys, *options, kept)[:2] == (2, "")
    assert not kept.exists()
    assert run_ensemble(capsys, *options[:-1])[0] == 0
    content = kept.read_bytes()
    for name in links(kept):
        code, out, err = run_ensemble(capsys, *options, name)
        assert (code, out) == (2, "")
        assert "would overwrite the file of --checkpoint" in err
    assert kept.read_bytes() == content


def test_a_picture_that_fails_costs_no_result(capsys, record, tmp_path, monkeypatch):
    plotting = pytest.importorskip("stickslip.plotting", exc_type=ImportError)
    long = record.with_name(f"{'a' * 250}.csv")  # out-2-aaa....png is longer than a name may be
    long.write_bytes(record.read_bytes())
    good = results(capsys, record, long, "--mu", 0.1)
    code, out, err = run(
        capsys, record, long, "--mu", 0.1, "--json", "--plot", tmp_path / "out.png"
    )
    document = json.loads(out)
    assert (code, document["results"]) == (1, good)
    assert document["figures"] == [str(tmp_path / "out-1-quake.png")]
    assert [error["file"] for error in document["errors"]] == [str(long)]
    assert err.startswith(f"stickslip: {long}: ") and err.count("\n") == 1

    def full(_, file):
        raise OSError(28, "No space left on device", str(file))

    table = run_ensemble(capsys, *QUAKE)[1]
    monkeypatch.setattr(plotting, "save", full)
    code, out, err = run_ensemble(capsys, *QUAKE, "--plot", tmp_path / "e.png")
    assert (code, out) == (1, table)
    assert err == f"stickslip: {tmp_path / 'e.png'}: No space left on device\n"


def test_records_of_the_same_name_have_a_picture_each_of_which_one_is_in_memory(
    capsys, record, tmp_path, monkeypatch
):
    plotting = pytest.importorskip("stickslip.plotting", exc_type=ImportError)
    records = []
    for folder in "abc":
        (tmp_path / folder).mkdir()
        records.append(tmp_path / folder / "quake.csv")
        records[-1].write_bytes(record.read_bytes())
    save, figures = plotting.save, []

    def saved(figure, file):
        gc.collect()
        assert [kept for kept in figures if kept() is not None] == []
        figures.append(weakref.ref(figure))
        return save(figure, file)

    monkeypatch.setattr(plotting, "save", saved)
    code, _, err = run(capsys, *records, "--mu", 0.1, "--plot", tmp_path / "out.svg")
    assert (code, err) == (0, "")
    assert sorted(f.name for f in tmp_path.glob("*.svg")) == [
        f"out-{place}-quake.svg" for place in (1, 2, 3)
    ]


# ---- text from files, terminals and pipes

HOSTILE = {
    "escape": "\x1b[2J\x1b]0;owned\x07",
    "backspace": "a\b\b\r",
    "C1": "\x9b31m",
    "bidirectional override": "\u202egpj.\u202c",
    "isolate": "\u2066\u2069",
}


@pytest.mark.parametrize("case", HOSTILE)
def test_no_control_character_of_a_title_or_a_name_reaches_the_terminal(
    capsys, record, tmp_path, case
):
    text = HOSTILE[case]
    record.write_text(record.read_text().replace("Somewhere", f"Some{text}where"), "utf-8")
    code, out, err = run(capsys, record, "--mu", 0.1)
    assert (code, err) == (0, "")
    assert "Some" in out and "where" in out
    assert text not in out
    assert all(c.isprintable() or c == "\n" for c in out)
    head, row = out.splitlines()
    assert head.index("PGA") + len("PGA [g]") == row.index(" 0.", row.index("ABC-090")) + 6
    (row,) = results(capsys, record, "--mu", 0.1)
    blanks = re.sub(
        r"[\x00-\x1f\x7f-\x9f]", " ", f"Some{text}where 2001 - ABC-090"
    )  # as the reader has it
    assert row["record"] == " ".join(blanks.split())
    _, out, _ = run(capsys, record, "--mu", 0.1, "--json")
    assert out.isascii() and all(c.isprintable() or c == "\n" for c in out)

    bad = tmp_path / f"bad{text}.csv"
    bad.write_text(f"{text}\n{text}\n")
    nowhere = tmp_path / f"x{text}" / "out.png"
    for arguments in ([bad], [tmp_path / f"no{text}\n.csv"], [record, "--plot", nowhere]):
        code, out, err = run(capsys, *arguments, "--mu", 0.1)
        assert code > 0 and out == ""
        assert err.count("\n") == 1 and err.removesuffix("\n").isprintable()
    with pytest.raises(SystemExit):
        main(["slide", str(record), "--mu", "0.1", "--json", str(bad)])
    assert all(c.isprintable() or c == "\n" for c in capsys.readouterr().err)


@pytest.mark.skipif(sys.platform != "linux", reason="names are any bytes on Linux")
def test_file_names_that_are_no_text_are_slid_and_named(record, tmp_path):
    good, bad = os.fsencode(tmp_path) + b"/good\xff.csv", os.fsencode(tmp_path) + b"/bad\xff.csv"
    os.rename(record, good)
    options = [good, bad, "--mu", "0.1"]
    done = command("slide", *options)
    assert done.returncode == 1
    assert done.stdout.count(b"\n") == 2
    line = os.fsencode(tmp_path) + b"/bad\\udcff.csv: "
    assert done.stderr.startswith(b"stickslip: " + line) and done.stderr.count(b"\n") == 1
    document = json.loads(command("slide", *options, "--json").stdout)
    assert [os.fsencode(row["file"]) for row in document["results"]] == [good]
    assert [os.fsencode(row["file"]) for row in document["errors"]] == [bad]


def command(*arguments, **options):
    """The command in a separate process."""
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **options}
    return subprocess.run([sys.executable, "-m", "stickslip", *arguments], timeout=60, **pipes)


def test_letters_that_the_terminal_lacks_are_escaped(record):
    record.write_text(
        record.read_text().replace("Somewhere", "Stra\N{LATIN SMALL LETTER SHARP S}e")
    )
    ascii_only = {**os.environ, "PYTHONIOENCODING": "ascii"}
    done = command("slide", record, "--mu", "0.1", env=ascii_only)
    assert (done.returncode, done.stderr) == (0, b"")
    assert b"Stra\\xdfe 2001 - ABC-090" in done.stdout


ANSWERS = {
    "slide": ["slide", "RECORD", "--mu", "0.1"],
    "json": ["slide", "RECORD", "--mu", "0.1", "--json"],
    "ensemble": ["ensemble", *map(str, QUAKE)],
    "thesis": ["thesis", "2.1", "--check"],
    "help": ["slide", "--help"],
    "version": ["--version"],
}


@pytest.fixture(params=ANSWERS)
def answer(request, record):
    """Arguments that are answered on stdout."""
    return [str(record) if a == "RECORD" else a for a in ANSWERS[request.param]]


def test_a_reader_that_stops_early_is_no_error(answer):
    words = [sys.executable, "-m", "stickslip", *answer]
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as child:
        child.stdout.close()
        assert child.stderr.read() == b""
        assert child.wait() == 0


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no /dev/full")
def test_what_cannot_be_printed_is_an_error(answer):
    with open("/dev/full", "w") as full:
        done = command(*answer, stdout=full)
    assert done.returncode == 2
    assert done.stderr == b"stickslip: standard output: No space left on device\n"


@pytest.mark.skipif(os.name == "nt", reason="needs a shell")
def test_what_is_printed_nowhere_is_an_error(answer):
    words = shlex.join([sys.executable, "-m", "stickslip", *answer])
    done = subprocess.run(["sh", "-c", f"{words} >&-"], stderr=subprocess.PIPE, timeout=60)
    assert done.returncode == 2
    assert done.stderr == b"stickslip: standard output: Bad file descriptor\n"


@pytest.mark.skipif(os.name == "nt", reason="needs a shell")
@pytest.mark.parametrize("stderr", ["2>&-", "2>/dev/full"])
def test_errors_that_nobody_hears_are_told_by_the_exit_code_alone(record, stderr):
    """They are not mixed with the results on stdout."""
    start = shlex.join([sys.executable, "-m", "stickslip", "slide"])
    for arguments, code in (
        (f"{record} --mu -1", 2),
        (f"{record} --mu x", 2),
        ("nowhere.csv --mu 0.1", 1),
    ):
        done = subprocess.run(
            ["sh", "-c", f"{start} {arguments} {stderr}"], stdout=subprocess.PIPE, timeout=60
        )
        assert (done.returncode, done.stdout) == (code, b"")


def test_a_warning_is_one_line(capsys, record, monkeypatch):
    def warned(*arguments, **options):
        warnings.warn("two\nlines", stacklevel=1)
        return tried(*arguments, **options)

    monkeypatch.setattr("stickslip.cli.reading.tried", warned)
    with warnings.catch_warnings():
        warnings.simplefilter("default")
        code, _, err = run(capsys, record, "--mu", 0.1)
    assert (code, err) == (0, "stickslip: warning: two\\nlines\n")


def test_who_slides_a_record_waits_for_neither_matplotlib_nor_numpy(record):
    code = (
        "import sys; from stickslip.cli import main;"
        f"main(['slide', {str(record)!r}, '--mu', '0.1']);"
        "print([name for name in ('matplotlib', 'numpy') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "[]"


def test_a_picture_is_written_where_the_command_says(capsys, record, tmp_path):
    pytest.importorskip(
        "matplotlib", reason="pictures need matplotlib: pip install stickslip[plot]"
    )
    picture = tmp_path / "out.png"
    code, out, _ = run(capsys, record, "--mu", 0.1, "--plot", picture)
    assert code == 0
    assert out.splitlines()[-1] == f"wrote {picture}"
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_several_records_have_a_picture_each(capsys, record, tmp_path):
    pytest.importorskip(
        "matplotlib", reason="pictures need matplotlib: pip install stickslip[plot]"
    )
    run(capsys, record, record, "--mu", 0.1, 0.2, "--plot", tmp_path / "out.svg")
    assert sorted(f.name for f in tmp_path.glob("*.svg")) == ["out-1-quake.svg", "out-2-quake.svg"]


def test_a_picture_that_cannot_be_written_leaves_nothing(capsys, record, tmp_path):
    pytest.importorskip(
        "matplotlib", reason="pictures need matplotlib: pip install stickslip[plot]"
    )
    for name in ("out.jpg", "nowhere/out.png"):
        code, out, err = run(capsys, record, "--mu", 0.1, "--plot", tmp_path / name)
        assert (code, out) == (2, "")
        assert name.split("/")[0] in err
    assert list(tmp_path.iterdir()) == [record]


def test_without_matplotlib_plot_says_what_to_install(capsys, record, monkeypatch):
    monkeypatch.delitem(sys.modules, "stickslip.plotting", raising=False)
    monkeypatch.delattr(ss, "plotting", raising=False)
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    code, out, err = run(capsys, record, "--mu", 0.1, "--plot", "a.png")
    assert (code, out) == (2, "")
    assert "pip install stickslip[plot]" in err


# ---- ensembles

SOURCES = {
    "event": (["--event", "great near field"], ss.PoissonPulses.event("great near field")),
    "pulses": (
        ["--rate", 3, "--half-width", 0.1, "--sigma", 1.5, "--duration", 10],
        ss.PoissonPulses(rate=3, half_width=0.1, sigma=1.5, duration=10),
    ),
    "band": (
        ["--band", 0.05, 2, 12, "--dt", 0.1, "--samples", 256],
        ss.GaussianExcitation(ss.Spectrum.band_pass(s0=0.05, low=2, high=12), dt=0.1, samples=256),
    ),
}


@pytest.mark.parametrize("source", SOURCES)
@pytest.mark.parametrize("case", CASES)
def test_an_ensemble_is_exactly_the_librarys(capsys, case, source):
    (options, slider), (shaking, excitation) = CASES[case], SOURCES[source]
    more = ["--members", 100, "--seed", 7, "--settle", "--level", 0.005, "--threads", 1, "--json"]
    code, out, err = run_ensemble(capsys, *shaking, *options, *more)
    assert (code, err) == (0, "")
    document = json.loads(out)
    e = ss.run_ensemble(slider, excitation, members=100, seed=7, settle=True)
    assert document["members"] == 100
    assert document["configuration"] == e.configuration
    assert [q["value"] for q in document["peak_m"]] == [
        e.quantile(p).value for p in (0.5, 0.95, 0.99)
    ]
    assert [q["quantile"] for q in document["peak_m"]] == [0.5, 0.95, 0.99]
    p = e.exceedance(0.005)
    assert document["exceedance"] == [
        {"peak_m": 0.005, "value": p.value, "low": p.low, "high": p.high}
    ]
    hits = document.get("impact_probability")
    if getattr(slider, "stops", None) is None:
        assert hits is None
    else:
        assert hits == dict(zip(("value", "low", "high"), e.impact_probability))
    mean, rms = document["residual_mean_m"], document["residual_rms_m"]
    assert mean["value"] == pytest.approx(e.residual.mean(), rel=1e-12)
    assert mean["error"] == pytest.approx(e.residual.std(ddof=1) / 10, rel=1e-12)
    assert rms["value"] == pytest.approx(np.sqrt((e.residual**2).mean()), rel=1e-12)
    assert document["stationary"]["remark"] == e.stationary.remark
    growth = document["stationary"]["growth_rate_m2_s"]
    assert growth == {
        "value": e.stationary.growth_rate.value,
        "error": e.stationary.growth_rate.error,
    }


@pytest.mark.parametrize("source", SOURCES)
@pytest.mark.parametrize("contact", ["flight", "clipped"])
def test_an_ensemble_with_vertical_motion_is_exactly_the_librarys(capsys, contact, source):
    shaking, excitation = SOURCES[source]
    more = ["--members", 64, "--seed", 7, "--threads", 1, "--json", "--contact", contact]
    code, out, err = run_ensemble(capsys, *shaking, "--mu", 0.05, "--vertical-ratio", 0.5, *more)
    assert (code, err) == (0, "")
    document = json.loads(out)
    both = ss.WithVertical(excitation, ratio=0.5)
    e = ss.run_ensemble(ss.Coulomb(mu=0.05), both, members=64, seed=7, contact=contact)
    assert document["configuration"] == e.configuration
    assert document["configuration"]["excitation"]["ratio"] == 0.5
    assert document["configuration"].get("contact", "flight") == contact
    assert [q["value"] for q in document["peak_m"]] == [
        e.quantile(p).value for p in (0.5, 0.95, 0.99)
    ]


@pytest.mark.parametrize("source", SOURCES)
def test_an_ensemble_of_pairs_is_exactly_the_librarys(capsys, source):
    shaking, excitation = SOURCES[source]
    options = [*shaking, "--mu", 0.05, "--members", 64, "--seed", 7, "--threads", 1]
    pair = ["--planar", "--transverse-ratio", 0.8, "--coherence", 0.3, "--vertical-ratio", 0.5]
    code, out, err = run_ensemble(capsys, *options, *pair, "--json")
    assert (code, err) == (0, "")
    document = json.loads(out)
    pairs = ss.WithVertical(ss.WithTransverse(excitation, ratio=0.8, coherence=0.3), ratio=0.5)
    e = ss.run_ensemble(ss.PlanarSlider(ss.Coulomb(mu=0.05)), pairs, members=64, seed=7)
    assert document["configuration"] == e.configuration
    assert [q["value"] for q in document["peak_m"]] == [
        e.quantile(p).value for p in (0.5, 0.95, 0.99)
    ]
    distance = np.hypot(*e.residual.T)
    assert document["residual_mean_m"]["value"] == pytest.approx(distance.mean(), rel=1e-12)
    end = document["at_end"]
    assert end["time_s"] == e.time[-1]
    variances = [end[f"displacement_variance_{one}_m2"] for one in ("axis", "transverse")]
    assert [one["value"] for one in variances] == e.displacement_variance[-1].tolist()
    assert [one["error"] for one in variances] == e.displacement_variance_error[-1].tolist()
    assert end["velocity_covariance_m2_s2"]["value"] == e.velocity_covariance[-1]
    code, out, err = run_ensemble(capsys, *options, *pair)
    assert (code, err) == (0, "")
    lines = [line for line in out.splitlines() if "m^2" in line]
    assert [line.split()[0] for line in lines] == [
        *("displacement", "transverse", "displacement", "velocity", "transverse", "velocity")
    ]


BUILDING = ["--story-masses", "2e5", "1e5", "--story-stiffnesses", "2e8", "1.5e8"]
BUILDING += ["--base-mass", "2e5", "--story-damping-ratio", "3%"]


def test_an_ensemble_of_buildings_is_exactly_the_librarys(capsys):
    shaking, excitation = SOURCES["band"]
    options = [*shaking, "--mu", 0.02, "--period", 2, *BUILDING, "--members", 200, "--seed", 7]
    code, out, err = run_ensemble(capsys, *options, "--settle", "--json")
    assert (code, err) == (0, "")
    document = json.loads(out)
    tower = ss.Structure.shear_building(
        masses=[2e5, 1e5], stiffnesses=[2e8, 1.5e8], damping_ratio=0.03
    )
    system = ss.IsolatedStructure(ss.Slider(ss.Coulomb(mu=0.02), period=2), tower, base_mass=2e5)
    e = ss.run_ensemble(system, excitation, members=200, seed=7, settle=True)
    assert document["configuration"] == e.configuration
    assert document["peak_m"][0]["value"] == e.quantile(0.5).value
    assert [floor["floor"] for floor in document["floors"]] == [1, 2]
    for i, floor in enumerate(document["floors"]):
        for name, peaks in (
            ("peak_acceleration_m_s2", e.peak_floor_acceleration),
            ("peak_drift_m", e.peak_floor_drift),
        ):
            for p, found in zip((0.5, 0.95), floor[name], strict=True):
                q = peaks.quantile(p)[i]
                assert found == {"quantile": p, "value": q.value, "low": q.low, "high": q.high}
    code, out, err = run_ensemble(capsys, *options, "--settle")
    assert (code, err) == (0, "")
    (line,) = (line for line in out.splitlines() if line.startswith("floor 2, drift"))
    median = 1000 * e.peak_floor_drift.quantile(0.5)[1].value
    assert line.split()[3:6] == ["median", f"{median:.4g}", "mm"]
    assert "floors" not in json.loads(run_ensemble(capsys, *QUAKE, "--json")[1])


@pytest.mark.parametrize("command", ["slide", "sweep"])
def test_a_building_on_the_block_is_exactly_the_librarys(command, capsys):
    tower = ss.Structure.shear_building(
        masses=[2e5, 1e5], stiffnesses=[2e8, 1.5e8], damping_ratio=0.03
    )
    slider = ss.Slider(ss.Coulomb(mu=0.06), period=2, stops=ss.Stops(gap=0.2, restitution=0.5))
    system = ss.IsolatedStructure(slider, tower, base_mass=2e5)
    r = ss.integrate(system, ss.sample_record("Kobe"), settle=True)
    options = ["--mu", "0.06", "--period", "2", "--stop-gap", "0.2", "--restitution", "0.5"]
    run_it = [command, "sample:Kobe", *options, *BUILDING]
    assert main([*run_it, "--polarity", "recorded", "--json"]) == 0
    (row,) = json.loads(capsys.readouterr().out)["results"]
    assert row["peak_m"] == pytest.approx(r.peak, rel=1e-12)
    assert row["residual_m"] == pytest.approx(r.residual, rel=1e-9)
    if command == "slide":
        assert row["peak_base_acceleration_m_s2"] == r.peak_base_acceleration
        assert row["peak_floor_acceleration_m_s2"] == r.floors.peak_acceleration.max()
        assert row["peak_drift_m"] == r.floors.peak_drift.max()
        assert row["impacts_forward"] + row["impacts_backward"] == len(r.impacts) > 0
        assert main([*run_it, "--both"]) == 0
        assert "floors at most [g]  drift at most [mm]" in capsys.readouterr().out
        two = [command, "sample:Kobe", "--mu", "0.06", "0.1", *options[2:], *BUILDING]
        assert main([*two, "--plot", "a.png"]) == 2
        assert "one slider with a building, got 2" in capsys.readouterr().err
    assert main([*run_it, "--contact", "flight"]) == 2
    assert "leave out --contact" in capsys.readouterr().err or command == "sweep"


def test_slide_warns_of_the_limit_of_a_pendulum(tmp_path, capsys):
    file = tmp_path / "bearing.json"
    file.write_text('{"kind": "FrictionPendulum", "radius": 2.2, "mu": 0.06}')
    code, out, err = run(capsys, "sample:Kobe", "--slider", file)
    assert code == 0 and "bearing" in out
    assert err.count("beyond 0.2 of the radius of 2.2 m") == 1


def test_the_table_of_an_ensemble_has_units_errors_and_bounds(capsys):
    code, out, err = run_ensemble(capsys, *QUAKE, "--level", 0.02, 0.05, "--confidence", 0.9)
    assert (code, err) == (0, "")
    e = ss.run_ensemble(
        ss.Coulomb(mu=0.02), ss.PoissonPulses.event("moderate near field"), members=500, seed=0
    )
    lines = out.splitlines()
    assert lines[0].startswith("500 members, seed 0; 90 % bounds in brackets")
    q = e.quantile(0.95, 0.9)
    assert lines[2].split(maxsplit=4) == [
        "95",
        "%",
        f"{100 * q.value:.4g}",
        "cm",
        f"({100 * q.low:.4g} to {100 * q.high:.4g})",
    ]
    assert sum(line.startswith("peak exceeds") for line in lines) == 1
    (line,) = (line for line in lines if line.startswith("residual displacement"))
    assert line.split()[2:3] == ["mean"]
    assert line.split()[-2] == "+-"
    (line,) = (line for line in lines if line.startswith("velocity variance"))
    assert "m^2/s^2" in line
    assert float(line.split()[2]) == pytest.approx(
        e.stationary.velocity_variance.value, abs=e.stationary.velocity_variance.error / 10
    )
    assert lines[-1 - bool(e.stationary.remark)] == "(the last two from 3.75 to 11.2 s)"
    assert (lines[-1] == f"({e.stationary.remark})") == (not e.stationary.is_stationary)


REFUSED_ENSEMBLES = {
    "an unknown event": (["--event", "big", "--mu", 0.1], "got 'big'"),
    "negative friction": (["--event", "great near field", "--mu", -1], "got -1"),
    "one member": ([*QUAKE[:-2], "--members", 1], "--members must be at least 2"),
    "fewer than none": ([*QUAKE[:-2], "--members", -7], "got -7"),
    "more than are counted": ([*QUAKE[:-2], "--members", 2**64], "--members must be at most"),
    "a negative length": (
        ["--band", 1, 2, 3, "--mu", 0.1, "--dt", 0.1, "--samples", -1],
        "--samples must be at least 1, got -1",
    ),
    "an endless length": (
        ["--band", 1, 2, 3, "--mu", 0.1, "--dt", 0.1, "--samples", 2**64],
        "--samples must be at most",
    ),
    "variances beyond doubles": (
        ["--rate", 3, "--half-width", 0.1, "--duration", 9, "--sigma", 1e90, "--mu", 0.1],
        "",
    ),
    "a negative seed": ([*QUAKE, "--seed", -1], "seed must be at least 0, got -1"),
    "a base without a building": (
        [*QUAKE, "--base-mass", 1],
        "needs --story-masses and --story-stiffnesses and --story-damping-ratio, got none",
    ),
    "a story too few": (
        [*QUAKE, *BUILDING[:5], *BUILDING[6:]],
        "--story-stiffnesses needs one for each of --story-masses, 2, got 1",
    ),
    "a floor without mass": (
        [*QUAKE, *BUILDING[:2], 0, *BUILDING[3:]],
        "--story-masses must be positive and finite, got 0 kg",
    ),
    "a story that gains energy": (
        [*QUAKE, *BUILDING[:-1], -0.1],
        "--story-damping-ratio must be finite and at least 0, got -0.1",
    ),
    "a building that flies": (
        [*QUAKE, *BUILDING, "--contact", "flight"],
        "structures do not leave the ground: contact must be 'clipped' or left out, got 'flight'",
    ),
    "a building in the plane": ([*QUAKE, *BUILDING, "--planar"], "leave out --planar"),
    "a negative ratio": (
        [*QUAKE, "--vertical-ratio", -0.5],
        "--vertical-ratio must be finite and at least 0, got -0.5",
    ),
    "a pair on one axis": ([*QUAKE, "--coherence", 0.2], "--coherence goes with --planar, got 0.2"),
    "components more than alike": (
        [*QUAKE, "--planar", "--coherence", 2],
        "coherence must be from -1 to 1, got 2",
    ),
    "no threads": ([*QUAKE, "--threads", 0], "threads must be at least 1, got 0"),
    "no width": (["--rate", 3, "--mu", 0.1], "--rate needs --half-width, got none"),
    "no samples": (
        ["--band", 1, 2, 3, "--mu", 0.1, "--dt", 0.1],
        "--band needs --samples, got none",
    ),
    "a step too many": ([*QUAKE, "--dt", 0.1], "--dt goes with --band, got --event"),
    "a negative rate": (
        ["--rate", -3, "--half-width", 1, "--sigma", 1, "--duration", 1, "--mu", 0.1],
        "got -3",
    ),
    "beyond Nyquist": (
        ["--band", 1, 2, 300, "--dt", 0.1, "--samples", 64, "--mu", 0.1],
        "Nyquist",
    ),
    "a NaN level": ([*QUAKE, "--level", "nan"], "--level must be finite and at least 0, got nan m"),
    "certainty": ([*QUAKE, "--confidence", 1], "--confidence must lie between 0 and 1, got 1"),
    "reach without caster": ([*QUAKE, "--reach", 1], "--law caster, got --law coulomb"),
    "no rest": (["--event", "great near field", "--mu", 0, "--settle"], "does not come to rest"),
    "no folder": ([*QUAKE, "--checkpoint", "nowhere/run.npz"], "nowhere: no such folder"),
    "no folder for a picture": ([*QUAKE, "--plot", "nowhere/a.png"], "nowhere: no such folder"),
}


@pytest.mark.parametrize("case", REFUSED_ENSEMBLES)
def test_an_ensemble_that_is_refused_is_named_on_stderr_with_code_2(capsys, case):
    arguments, message = REFUSED_ENSEMBLES[case]
    code, out, err = run_ensemble(capsys, *arguments)
    assert (code, out) == (2, "")
    assert err.startswith("stickslip: ")
    assert message in err
    assert err.count("\n") == 1


@pytest.mark.parametrize(
    "arguments",
    [
        ["--mu", "0.1"],
        ["--event", "great near field", "--mu"],
        ["--event", "great near field", "--rate", "3", "--mu", "0.1"],
        ["--band", "1", "2", "--mu", "0.1"],
    ],
)
def test_arguments_of_an_ensemble_that_do_not_parse_end_with_code_2(capsys, arguments):
    with pytest.raises(SystemExit) as end:
        main(["ensemble", *arguments])
    assert end.value.code == 2


def test_a_checkpoint_and_a_picture_are_written_where_the_command_says(capsys, tmp_path):
    pytest.importorskip(
        "matplotlib", reason="pictures need matplotlib: pip install stickslip[plot]"
    )
    kept, picture = tmp_path / "run.npz", tmp_path / "out.png"
    code, first, _ = run_ensemble(capsys, *QUAKE, "--checkpoint", kept, "--plot", picture)
    assert code == 0
    assert first.splitlines()[-2:] == [f"wrote {kept}", f"wrote {picture}"]
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert ss.Ensemble.load(kept).members == 500
    code, again, _ = run_ensemble(capsys, *QUAKE, "--checkpoint", kept, "--plot", picture)
    assert (code, again) == (0, first)
    code, out, err = run_ensemble(capsys, *QUAKE, "--seed", 3, "--checkpoint", kept)
    assert (code, out) == (2, "")
    assert "seed 3 against seed 0" in err


@pytest.mark.parametrize("factor", [1e-170, 1e30])
def test_the_rms_of_residuals_is_their_rms_however_small_or_large(capsys, factor):
    def residuals(factor):
        pulses = ["--rate", 3, "--half-width", 0.1, "--duration", 9, "--sigma", factor]
        options = ["--mu", 0.02 * factor, "--members", 100, "--json"]
        code, out, _ = run_ensemble(capsys, *pulses, *options)
        assert code == 0
        document = json.loads(out)
        return [document[f"residual_{name}_m"][key] for name in ("mean", "rms") for key in KEYS]

    KEYS = ("value", "error")
    mean, _, rms, _ = scaled = residuals(factor)
    assert rms > abs(mean)
    # Dry friction has no scale of its own: twice the accelerations are twice the displacements.
    assert scaled == pytest.approx([factor * r for r in residuals(1)], rel=1e-9)


def test_ctrl_c_before_a_checkpoint_promises_none(capsys, tmp_path, monkeypatch):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr("stickslip.ensemble.run_ensemble", interrupted)
    answer = run_ensemble(capsys, *QUAKE, "--checkpoint", tmp_path / "run.npz")
    assert answer == (130, "", "stickslip: interrupted\n")


def test_pulses_whose_statistics_overflow_are_refused_in_one_line(capsys):
    pulses = ("--rate", 1, "--half-width", 0.5, "--sigma", 1e90, "--duration", 20, "--mu", 0.1)
    code, out, err = run_ensemble(capsys, *pulses, "--members", 100)
    assert (code, out) == (2, "")
    assert err.startswith("stickslip: run_ensemble: displacement [m] and velocity [m/s] must not")
    assert err.count("\n") == 1


def test_a_checkpoint_that_cannot_be_written_in_the_end_costs_no_result(
    capsys, tmp_path, monkeypatch
):
    def refuse(descriptor):
        raise OSError(28, "No space left on device")

    _, result, _ = run_ensemble(capsys, *QUAKE)
    monkeypatch.setattr(os, "fsync", refuse)
    code, out, err = run_ensemble(capsys, *QUAKE, "--checkpoint", tmp_path / "run.npz")
    assert (code, out) == (1, result)
    assert err.startswith("stickslip: run_ensemble: cannot write checkpoint ")
    assert "No space left on device" in err
    assert list(tmp_path.iterdir()) == []


def test_what_cannot_be_written_is_refused_before_the_run(capsys, tmp_path, monkeypatch):
    monkeypatch.setattr("stickslip._core.run_ensemble", lambda *_, **__: pytest.fail("ran"))
    for option in ("--plot", "--checkpoint"):
        folder = tmp_path / f"{option}.png"
        folder.mkdir()
        code, out, err = run_ensemble(capsys, *QUAKE, option, folder)
        assert (code, out) == (2, "")
        assert err == f"stickslip: {folder}: must be a regular file, got a folder\n"


@pytest.mark.skipif(os.name == "nt", reason="Windows has no SIGINT to send")
def test_ctrl_c_leaves_a_checkpoint_and_no_traceback(tmp_path):
    kept = tmp_path / "run.npz"
    often = """
import functools, runpy, stickslip.ensemble as module
module.run_ensemble = functools.partial(module.run_ensemble, checkpoint_every=0)
runpy.run_module("stickslip", run_name="__main__", alter_sys=True)"""
    options = ["--event", "great near field", "--mu", "0.1", "--members", "1000000000"]
    command = [sys.executable, "-c", often, "ensemble", *options, "--checkpoint", str(kept)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as child:
        try:
            waiting_for(lambda: kept.exists() and ss.Ensemble.load(kept).members, child)
            child.send_signal(signal.SIGINT)
            out, err = child.communicate(timeout=60)
        finally:
            child.kill()
    assert (child.returncode, out) == (130, b"")
    assert err.decode() == f"stickslip: interrupted; {kept} has what was done\n"
    assert ss.Ensemble.load(kept).members > 0


@pytest.mark.parametrize("command", ["slide", "sweep", "spectrum", "orientations"])
def test_help_has_groups_and_an_example(capsys, command):
    with pytest.raises(SystemExit):
        main([command, "--help"])
    lines = capsys.readouterr().out.splitlines()
    assert {"records:", "output:"} <= set(lines)
    assert any(line.startswith(f"For example, `stickslip {command} ") for line in lines)


def test_commas_between_numbers_are_no_numbers(capsys):
    with pytest.raises(SystemExit):
        main(["slide", "sample:Kobe", "--mu", "0.1,0.2"])
    assert "blanks separate several numbers" in capsys.readouterr().err
