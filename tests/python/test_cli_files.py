"""The command `stickslip` and many files: folders, patterns, ranges, tables, completion."""

import csv
import json
import math
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import stickslip as ss
from stickslip.cli import main
from stickslip.cli.parser import numbers

G = ss.STANDARD_GRAVITY


def noise(seed, samples=400):
    white = np.random.default_rng(seed).standard_normal(samples)
    return np.convolve(white, np.repeat([0.08, -0.08], 6), "same")


def write_columns(file, n, dt=0.02):
    rows = "".join(f"{dt * i:.2f},{a!r}\n" for i, a in enumerate(n.tolist()))
    file.write_text("# Time (s),Acceleration (g)\n" + rows)


def write_peer(file, n, dt=0.02):
    head = [
        "PEER NGA STRONG MOTION DATABASE RECORD",
        "Somewhere 2001, ABC, 90",
        "ACCELERATION TIME SERIES IN UNITS OF G",
        f"NPTS= {len(n)}, DT= {dt:.4f} SEC",
    ]
    rows = [" ".join(f"{a:.7E}" for a in n[i : i + 5]) for i in range(0, len(n), 5)]
    file.write_text("\n".join(head + rows) + "\n")


@pytest.fixture
def folder(tmp_path):
    """Three records of two formats, one of them in a folder within, and two broken files."""
    folder = tmp_path / "quakes"
    (folder / "more").mkdir(parents=True)
    (folder / ".hidden").mkdir()
    (folder / ".hidden" / "notes").write_text("no record")
    write_columns(folder / "a.csv", noise(1))
    write_peer(folder / "b.AT2", noise(2))
    write_columns(folder / "more" / "c.csv", noise(3))
    (folder / "d.csv").write_text("Time (s),Acceleration (g)\n0,0.1\n0.01,x\n")
    (folder / "e.AT2").write_bytes((folder / "b.AT2").read_bytes()[:900])
    return folder


GOOD, BROKEN = ["a.csv", "b.AT2", "more/c.csv"], ["d.csv", "e.AT2"]


def run(capsys, *arguments):
    code = main([*map(str, arguments)])
    out, err = capsys.readouterr()
    return code, out, err


def table_of(file):
    with file.open(newline="") as stream:
        return list(csv.DictReader(stream))


def test_a_folder_of_mixed_formats_with_two_broken_files_gives_a_table_a_csv_and_code_1(
    capsys, folder, tmp_path
):
    file = tmp_path / "out.csv"
    code, out, err = run(capsys, "slide", folder, "--mu", 0.1, 0.2, "--csv", file)
    assert code == 1
    said = err.splitlines()
    assert [line.split(": ")[1] for line in said] == [str(folder / name) for name in BROKEN]
    head, *rows, wrote = out.splitlines()
    assert head.startswith("record") and wrote == f"wrote {file}"
    assert len(rows) == 6
    found = table_of(file)
    assert [(row["file"], float(row["mu"])) for row in found] == [
        (str(folder / name), mu) for name in GOOD for mu in (0.1, 0.2)
    ]
    for row in found:  # the CSV has the library's doubles
        motion = ss.read_record(row["file"])
        r = ss.integrate(ss.Coulomb(mu=float(row["mu"])), motion, settle=True)
        assert float(row["peak_m"]) == r.peak
        assert float(row["residual_m"]) == r.residual
        assert int(row["slips"]) == r.slips
        assert float(row["pga_g"]) == motion.peak_acceleration / G
        assert (row["period_s"], row["polarity"]) == ("", "")


def test_a_pattern_names_its_matches_in_order(capsys, folder):
    code, out, _ = run(capsys, "slide", folder / "*.csv", "--mu", 0.1, "--json")
    document = json.loads(out)
    assert code == 1
    assert [row["file"] for row in document["results"]] == [str(folder / "a.csv")]
    assert [one["file"] for one in document["errors"]] == [str(folder / "d.csv")]
    code, out, _ = run(capsys, "slide", folder / "**" / "[ac].csv", "--mu", 0.1, "--json")
    assert code == 0
    assert [row["file"] for row in json.loads(out)["results"]] == [
        str(folder / "a.csv"),
        str(folder / "more" / "c.csv"),
    ]
    code, out, err = run(capsys, "slide", folder / "*.txt", "--mu", 0.1)
    assert (code, out) == (1, "")
    assert err == f"stickslip: {folder / '*.txt'}: No such file or directory\n"


def test_a_file_whose_name_looks_like_a_pattern_is_that_file(capsys, folder):
    odd = folder / "[a].csv"
    shutil.copy(folder / "b.AT2", odd)
    _, out, _ = run(capsys, "slide", odd, "--mu", 0.1, "--json")
    assert [row["file"] for row in json.loads(out)["results"]] == [str(odd)]


# ---- ranges


def test_a_range_has_the_decimal_numbers_that_it_says():
    assert numbers("0.05:0.6:0.05") == tuple(round(0.05 * k, 2) for k in range(1, 13))
    assert numbers("1:2:0.4") == (1.0, 1.4, 1.8)
    assert numbers("3:1:-1") == (3.0, 2.0, 1.0)
    assert numbers("0.1:0.1:1") == (0.1,)
    assert numbers("0.3") == 0.3


@pytest.mark.parametrize(
    "text", ["1:2", "1:2:3:4", "1:2:0", "1:2:-1", "0:1:1e-9", "0:inf:1", "nan:1:1", "a:1:1", ":::"]
)
def test_a_range_that_makes_no_sense_is_refused(capsys, text):
    with pytest.raises(SystemExit) as end:
        main(["slide", "a.csv", "--mu", text])
    out, err = capsys.readouterr()
    assert (end.value.code, out) == (2, "")
    assert "argument --mu: " in err


@pytest.mark.parametrize(
    "given, meant",
    [
        (["newmark", "--ky", ".02:.08:.02"], ["newmark", "--ky", "0.02", "0.04", "0.06", "0.08"]),
        (["newmark", "--ky", "10%"], ["newmark", "--ky", "0.1"]),
        (["newmark", "--ky", "0.1", "--scale-pga", "4e-1"],
         ["newmark", "--ky", "0.1", "--scale-pga", "0.4"]),
        (["slide", "--mu", "5%:10%:5%"], ["slide", "--mu", "0.05", "0.1"]),
        (["slide", "--mu", "0.1", "--scale", "150%"], ["slide", "--mu", "0.1", "--scale", "1.5"]),
        (["slide", "--mu", "0.1", "--period", "2e0", "--damping-ratio", "5%"],
         ["slide", "--mu", "0.1", "--period", "2", "--damping-ratio", "0.05"]),
        (["spectrum", "--damping", "5%", "--periods", "1e-1"],
         ["spectrum", "--damping", "0.05", "--periods", "0.1"]),
    ],
)  # fmt: skip
def test_options_take_numbers_as_people_write_them(capsys, folder, given, meant):
    answers = [
        run(capsys, command, folder / "a.csv", *options, "--json")
        for command, *options in (given, meant)
    ]
    assert answers[0] == answers[1]
    assert answers[0][0] == 0


def test_whole_numbers_may_have_an_exponent(capsys):
    options = ["--event", "great near field", "--mu", "10%", "--json"]
    one = run(capsys, "ensemble", *options, "--members", "1e2")
    assert one == run(capsys, "ensemble", *options, "--members", "100")
    assert json.loads(one[1])["members"] == 100


@pytest.mark.parametrize(
    "arguments, said",
    [
        (["ensemble", "--event", "x", "--mu", "0.1", "--members", "1.5"], "must be a whole number"),
        (["ensemble", "--event", "x", "--mu", "0.1:0.3:0.1"], "takes one number, got the range"),
        (["slide", "a", "--mu", "x"], "argument --mu: must be a number, got 'x'"),
        (["slide", "a", "--mu", "0.1", "--period", "10%"], "got '10%'; percent is for ratios"),
    ],
)
def test_an_option_that_is_no_number_is_one_line(capsys, arguments, said):
    with pytest.raises(SystemExit) as end:
        main(arguments)
    out, err = capsys.readouterr()
    assert (end.value.code, out, err.count("\n")) == (2, "", 1)
    assert said in err and "--help" in err


def test_all_sample_records_are_one_argument(capsys):
    pytest.importorskip("pyslammer")
    for name in ("sample:all", "sample:*"):
        code, out, err = run(capsys, "newmark", name, "--ky", 0.1, "--json")
        rows = json.loads(out)["results"]
        assert (code, err) == (0, "")
        assert [row["record"] for row in rows] == list(ss.sample_records().names)


def test_a_loop_of_links_leaves_each_file_once(capsys, folder):
    (folder / "up").symlink_to(folder)
    for given in (folder, f"{folder}/**", f"{folder}/*"):
        _, out, _ = run(capsys, "slide", given, "--mu", 0.1, "--json")
        assert len(json.loads(out)["results"]) == 3


def test_every_combination_of_ranges_is_slid(capsys, folder):
    record = folder / "a.csv"
    options = ["--mu", "0.04:0.08:0.04", "--period", "1:2:0.5", "--damping-ratio", "0:0.1:0.1"]
    code, out, _ = run(capsys, "slide", record, *options, "--scale", "1:2:1", "--json")
    rows = json.loads(out)["results"]
    assert (code, len(rows)) == (0, 2 * 3 * 2 * 2)
    motion = ss.read_record(record)
    for row in rows:
        law = ss.Coulomb(mu=row["mu"])
        slider = ss.Slider(law, period=row["period_s"], damping_ratio=row["damping_ratio"])
        response = ss.integrate(slider, motion.scaled(row["scale"]), settle=True)
        assert row["peak_m"] == response.peak
    _, out, _ = run(capsys, "slide", record, *options)
    head, *lines = out.splitlines()
    assert "period [s]" in head and "damping" in head and "reach" not in head
    assert {len(line) for line in lines} == {len(head)}
    code, _, err = run(capsys, "slide", record, "--mu", 0.1, "--period", "0:1:0.5")
    assert (code, err) == (2, "stickslip: --period must be positive, got 0 s\n")


# ---- components and polarities


def test_both_polarities_and_their_mean(capsys, folder, tmp_path):
    record = folder / "a.csv"
    motion = ss.read_record(record)
    law = ss.Coulomb(mu=0.05, backward=math.inf)
    forward, reverse = (ss.integrate(law, motion.scaled(s), settle=True) for s in (1, -1))
    options = ["--mu", 0.05, "--law", "one-way", "--both"]
    code, out, _ = run(capsys, "slide", record, *options, "--json")
    rows = json.loads(out)["results"]
    assert code == 0
    assert [row["polarity"] for row in rows] == ["recorded", "reversed", "mean"]
    assert [row["residual_m"] for row in rows[:2]] == [forward.residual, reverse.residual]
    assert forward.residual != reverse.residual
    for key, name in {"peak_m": "peak", "residual_m": "residual", "slips": "slips"}.items():
        mean = (getattr(forward, name) + getattr(reverse, name)) / 2
        assert rows[2][key] == pytest.approx(mean, rel=1e-15)
    # A block that slides either way mirrors its motion: the mean residual is not zero.
    _, out, _ = run(capsys, "slide", record, "--mu", 0.05, "--both", "--json")
    recorded, mirrored, mean = json.loads(out)["results"]
    assert mirrored["residual_m"] == -recorded["residual_m"] != 0
    assert mean["residual_m"] == abs(recorded["residual_m"])
    _, out, _ = run(capsys, "slide", record, *options[:-1], "--polarity", "reversed", "--json")
    (row,) = json.loads(out)["results"]
    assert (row["polarity"], row["residual_m"]) == ("reversed", reverse.residual)
    _, out, _ = run(capsys, "slide", record, *options)
    assert [line.split()[-6] for line in out.splitlines()[1:]] == ["recorded", "reversed", "mean"]


def test_all_components_of_files_that_hold_several(capsys, agency_files):
    file = next((agency_files / "geonet").glob("*.V2A"))
    code, out, err = run(capsys, "slide", file, "--mu", 0.1, "--component", "all", "--json")
    rows = json.loads(out)["results"]
    assert (code, [row["component"] for row in rows]) == (0, [1, 2])
    assert err.startswith(f"stickslip: left out: {file}: a vertical component (Up); ")
    for row in rows:
        motion = ss.read_record(file, component=row["component"])
        assert row["peak_m"] == ss.integrate(ss.Coulomb(mu=0.1), motion, settle=True).peak
    code, out, _ = run(capsys, "records", file, "--json")
    assert [row["component"] for row in json.loads(out)["records"]] == [1, 2, 3]


def test_one_component_where_there_is_one(capsys, folder):
    _, out, _ = run(capsys, "slide", folder / "b.AT2", "--mu", 0.1, "--component", "all", "--json")
    assert [row["component"] for row in json.loads(out)["results"]] == [None]


# ---- what files hold


def test_records_says_what_files_hold(capsys, folder, tmp_path):
    file = tmp_path / "records.csv"
    code, out, err = run(capsys, "records", folder, "--csv", file)
    assert (code, err.count("\n")) == (1, 2)
    head, *rows, wrote = out.splitlines()
    for word in ("dt [s]", "samples", "duration [s]", "PGA [g]", "PGV [cm/s]", "D5-95 [s]"):
        assert word in head
    assert (len(rows), wrote) == (3, f"wrote {file}")
    for row, line in zip(table_of(file), rows, strict=True):
        motion = ss.read_record(row["file"])
        measures = ss.strong_motion(motion)
        assert int(row["samples"]) == len(motion) == 400
        assert float(row["dt_s"]) == motion.dt
        assert float(row["pgv_m_s"]) == measures.peak_velocity
        assert float(row["arias_intensity_m_s"]) == measures.arias_intensity
        assert float(row["d5_95_s"]) == measures.duration
        pga, pgv, *_ = map(float, line.split()[-4:])
        assert pga == pytest.approx(motion.peak_acceleration / G, abs=5e-4)
        assert pgv == pytest.approx(100 * measures.peak_velocity, abs=0.05)


def test_records_tells_the_unit_of_the_file_or_that_it_was_given(capsys, tmp_path):
    stated, silent = tmp_path / "a.csv", tmp_path / "b.csv"
    stated.write_text("Time (s),NS (cm/sec2),EW (g)\n0,1,2\n0.1,2,3\n")
    silent.write_text("0,1\n0.1,2\n")
    code, out, _ = run(capsys, "records", stated)
    assert code == 0
    head, first, second, blank, why, other = out.splitlines()
    assert blank == "" and why.endswith(
        "component 1: columns of numbers; unit cm/s^2 (label of column 2, line 1);"
        " time step 0.1 s (times in column 1); orientation NS (in the file)"
    )
    assert "unit g (label of column 3, line 1)" in other
    code, out, _ = run(capsys, "records", stated, silent, "--units", "g")
    assert code == 0 and "columns of numbers" not in out
    code, out, _ = run(capsys, "records", stated, silent, "--units", "g", "--why")
    assert out.count("columns of numbers; unit") == 3 and "orientation unknown" in out
    place = head.index("units")
    assert first[place:].startswith("cm/s^2 (in the file)  ")
    assert second[place:].startswith("g (in the file)  ")
    code, out, _ = run(capsys, "records", silent, "--units", "m/s^2")
    assert code == 0
    assert out.splitlines()[1][place:].startswith("m/s^2 (given)  ")
    code, out, _ = run(capsys, "records", stated, "--component", "EW", "--json")
    (row,) = json.loads(out)["records"]
    assert (row["units"], row["units_from"]) == ("g", "file")
    code, out, _ = run(capsys, "records", silent, "--units", "gal", "--json")
    (row,) = json.loads(out)["records"]
    assert (row["units"], row["units_from"]) == ("gal", "option")


def test_uneven_times_are_said(capsys, tmp_path):
    file = tmp_path / "uneven.csv"
    file.write_text("Time (s),Acceleration (g)\n0,0.1\n0.1,0.2\n0.25,0\n")
    code, out, _ = run(capsys, "records", file)
    assert code == 0 and " uneven " in out


# ---- spectra


def test_spectrum_prints_and_writes_the_librarys_values(capsys, folder, tmp_path):
    file = tmp_path / "spectra.csv"
    record = folder / "a.csv"
    motion = ss.read_record(record)
    code, out, _ = run(
        capsys, "spectrum", record, "--damping", 0.02, 0.05, "--periods", "0.5:1.5:0.5",
        "--csv", file,
    )  # fmt: skip
    assert code == 0
    expected = ss.response_spectrum(motion, [0.5, 1.0, 1.5], [0.02, 0.05]).values
    found = table_of(file)
    assert [float(row["pseudo_acceleration_m_s2"]) for row in found] == expected.ravel().tolist()
    assert [float(row["period_s"]) for row in found] == [0.5, 1.0, 1.5] * 2
    shown = [float(line.split()[-1]) for line in out.splitlines()[1:-1]]
    assert shown == pytest.approx((expected / G).ravel(), abs=5e-4)
    _, out, _ = run(capsys, "spectrum", record, "--kind", "displacement")
    head, rigid, *_ = out.splitlines()
    assert head.endswith("SD [cm]") and rigid.endswith(" 0.000")
    code, out, _ = run(capsys, "spectrum", folder, "--json")
    document = json.loads(out)
    assert (code, len(document["results"]), len(document["errors"])) == (1, 300, 2)


@pytest.mark.parametrize(
    "options, message",
    [
        (["--damping", 5], "--damping must be at least 0 and below 2, got 5"),
        (["--periods", -1], "--periods must be 0 or from 1e-6 to 1e6 s, got -1 s"),
        (["--scale", "nan"], "--scale must be finite, got nan"),
    ],
)
def test_a_bad_option_of_a_spectrum_is_named_before_a_file_is_read(capsys, options, message):
    assert run(capsys, "spectrum", "nowhere", *options) == (2, "", f"stickslip: {message}\n")


def test_spectrum_draws_each_record(capsys, folder, tmp_path):
    pytest.importorskip("matplotlib")
    run(capsys, "spectrum", folder / "a.csv", folder / "b.AT2", "--plot", tmp_path / "s.svg")
    assert sorted(f.name for f in tmp_path.glob("s*")) == ["s-1-a.svg", "s-2-b.svg"]


# ---- what is written


def test_the_formats_are_listed(capsys):
    with pytest.raises(SystemExit) as end:
        main(["records", "--formats"])
    assert end.value.code == 0
    heading, *lines = capsys.readouterr().out.splitlines()
    assert heading.split()[:2] == ["format", "units"]
    names = [one["name"] for one in ss.record_formats()]
    assert len(lines) == len(names)
    assert all(line.startswith(name) for line, name in zip(lines, names))


@pytest.mark.parametrize("command", [["slide", "--mu", "0.1"], ["records"], ["spectrum"]])
def test_results_are_never_half_written(capsys, folder, tmp_path, command):
    file = tmp_path / "out.csv"
    file.write_text("old\n")
    arguments = [command[0], folder, *command[1:], "--csv", file]
    code, out, _ = run(capsys, *arguments, "--strict")
    assert (code, out, file.read_text()) == (2, "", "old\n")
    code, out, err = run(capsys, command[0], folder / "a.csv", *command[1:], "--csv", folder)
    assert (code, out) == (2, "") and str(folder) in err
    code, out, err = run(
        capsys, command[0], folder / "a.csv", *command[1:], "--csv", folder / "a.csv"
    )
    assert (code, out) == (2, "") and "would overwrite the record" in err
    assert ss.read_record(folder / "a.csv").duration > 0
    code, _, _ = run(capsys, *arguments)
    assert code == 1 and len(table_of(file)) >= 3
    assert [f.name for f in tmp_path.iterdir() if f.name.startswith(".")] == []


# ---- warnings


def test_what_is_implausible_is_said_in_the_words_of_the_command(capsys, tmp_path):
    small, off = tmp_path / "small.csv", tmp_path / "off.csv"
    write_columns(small, noise(1) * 1e-6)
    write_columns(off, noise(1) + 0.01)
    code, _, err = run(capsys, "slide", small, small, off, "--mu", 0.1)
    assert code == 0
    first, again, last = err.splitlines()
    assert first == again  # of each file
    assert first.startswith(f"stickslip: warning: {small}: the largest acceleration = ")
    assert first.endswith("; check the units, with --units if the file states none")
    assert last.startswith(f"stickslip: warning: {off}: the mean acceleration, ")
    for word in ("read_record", "detrended", "Warning", ".py"):
        assert word not in err


# ---- completion


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_a_script_completes_the_command_in_a_shell(capsys, shell):
    pytest.importorskip("argcomplete")
    code, out, err = run(capsys, "completion", shell)
    assert (code, err) == (0, "")
    assert "_ARGCOMPLETE" in out and "stickslip" in out
    if shutil.which(shell):
        assert subprocess.run([shell, "-n"], input=out, text=True).returncode == 0


@pytest.mark.parametrize(
    "line, expected, never",
    [
        ("stickslip sp", {"spectrum "}, "slide"),
        ("stickslip slide --dam", {"--damping-ratio"}, "--mu"),
        ("stickslip slide a.csv --law ", {"coulomb", "caster", "one-way"}, "--mu"),
        ("stickslip completion ", {"bash", "zsh", "fish"}, "tcsh"),
    ],
)
def test_commands_options_and_choices_are_completed(tmp_path, line, expected, never):
    pytest.importorskip("argcomplete")
    answer = tmp_path / "answer"
    asked = {
        **os.environ,
        "_ARGCOMPLETE": "1",
        "_ARGCOMPLETE_STDOUT_FILENAME": str(answer),
        "_ARGCOMPLETE_SHELL": "bash",
        "_ARGCOMPLETE_IFS": "\n",
        "COMP_LINE": line,
        "COMP_POINT": str(len(line)),
    }
    script = "import sys; sys.argv[0] = 'stickslip'; from stickslip.cli import main; main([])"
    done = subprocess.run([sys.executable, "-c", script], env=asked, cwd=tmp_path, timeout=60)
    assert done.returncode == 0
    found = {word.strip() for word in answer.read_text().split("\n")}
    assert {word.strip() for word in expected} <= found
    assert never not in found


def test_without_argcomplete_it_says_what_to_install(capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "argcomplete", None)
    code, out, err = run(capsys, "completion", "bash")
    assert (code, out) == (2, "")
    assert err.endswith("pip install stickslip[completion]\n")


def test_the_page_shows_every_command_and_option(capsys):
    page = (Path(__file__).parents[2] / "docs" / "command.md").read_text(encoding="utf-8")
    for command in ("slide", "sweep", "newmark", "orientations", "records", "spectrum", "ensemble"):
        with pytest.raises(SystemExit):
            main([command, "--help"])
        options = set(re.findall(r"(?<!\w)--[a-z][a-z-]*", capsys.readouterr().out)) - {"--help"}
        for option in options:
            assert f"`{option}" in page, (command, option)
