"""The command `stickslip`: the same numbers as the library, and errors that name what was wrong."""

import json
import math
import os
import signal
import subprocess
import sys

import numpy as np
import pytest
import stickslip as ss
from sources import waiting_for
from stickslip.cli import main

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


CASES = {
    "block": (["--mu", 0.1], ss.Coulomb(mu=0.1)),
    "caster": (["--mu", 0.1, "--law", "caster", "--reach", 0.9], ss.Caster(mu=0.1, reach=0.9)),
    "caster of a geometry": (
        ["--mu", 0.5, "--law", "caster", "--trail", 0.9, "--wheel-width", 2],
        ss.Caster.from_geometry(mu=0.5, trail=0.9, wheel_width=2.0),
    ),
    "one-way": (["--mu", 0.1, "--law", "one-way"], ss.Coulomb(mu=0.1, backward=math.inf)),
    "slope": (["--mu", 0.3, "--slope", 10], ss.Coulomb.on_slope(mu=0.3, degrees=10)),
    "slope one-way": (
        ["--mu", 0.3, "--slope", 10, "--law", "one-way"],
        ss.Coulomb(
            slip_level=ss.Coulomb.on_slope(mu=0.3, degrees=10).slip_level, backward=math.inf
        ),
    ),
    "spring": (
        ["--mu", 0.06, "--period", 2.5],
        ss.Slider(ss.Coulomb(mu=0.06), natural_frequency=2 * math.pi / 2.5),
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


def test_a_scaled_record_is_the_record_scaled(capsys, record):
    (row,) = results(capsys, record, "--mu", 0.1, "--scale", 1.5)
    scaled = ss.read_record(record).scaled(1.5)
    assert row["peak_m"] == ss.integrate(ss.Coulomb(mu=0.1), scaled, settle=True).peak


def test_the_table_has_a_row_for_each_coefficient_and_says_its_units(capsys, record):
    code, out, err = run(capsys, record, "--mu", 0.1, 0.2, 5)
    assert (code, err) == (0, "")
    head, *rows = out.splitlines()
    for word in ("PGA [g]", "peak [cm]", "residual [cm]", "distance [cm]", "sliding [s]", "slips"):
        assert word in head
    assert len(rows) == 3
    motion = ss.read_record(record)
    for mu, row in zip((0.1, 0.2, 5), rows):
        r = ss.integrate(ss.Coulomb(mu=mu), motion, settle=True)
        numbers = row.split()[-6:]
        assert numbers[:3] == [f"{mu:g}", f"{100 * r.peak:.2f}", f"{100 * r.residual:.2f}"]
    assert rows[0].startswith("Somewhere 2001 - ABC-090")
    assert rows[2].split()[-1] == "0"


def test_a_slider_that_never_rests_is_an_answer_and_says_so(capsys, record):
    code, out, _ = run(capsys, record, "--mu", 0)
    assert code == 0
    assert "never rests" in out
    (row,) = results(capsys, record, "--mu", 0)
    assert row["at_rest"] is False
    assert row["peak_m"] == ss.integrate(ss.Coulomb(mu=0), ss.read_record(record)).peak


REFUSED = {
    "missing file": (["nowhere.csv", "--mu", 0.1], "nowhere.csv: No such file"),
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
        "--trail and --wheel-width, in metres, got --trail",
    ),
    "caster on a slope": (
        ["RECORD", "--mu", 0.1, "--law", "caster", "--reach", 1, "--slope", 5],
        "--slope goes with",
    ),
    "too steep": (["RECORD", "--mu", 0.1, "--slope", 45], "45 degrees"),
    "no period": (["RECORD", "--mu", 0.1, "--period", 0], "got 0 s"),
    "infinite scale": (["RECORD", "--mu", 0.1, "--scale", "inf"], "got inf"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_is_refused_is_named_on_stderr_with_code_2(capsys, record, case):
    arguments, message = REFUSED[case]
    code, out, err = run(capsys, *(record if a == "RECORD" else a for a in arguments))
    assert (code, out) == (2, "")
    assert err.startswith("stickslip: ")
    assert message in err
    assert err.count("\n") == 1


@pytest.mark.parametrize(
    "arguments", [[], ["slide"], ["slide", "a.csv"], ["slide", "a", "--mu", "x"]]
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
    for library in ("fftw", "gsl", "sundials"):
        assert info[library] in out


def test_a_reader_that_stops_early_is_no_error(record):
    command = [sys.executable, "-m", "stickslip", "slide", str(record), "--mu", "0.1"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as child:
        child.stdout.close()
        assert child.stderr.read() == b""
        assert child.wait() == 0


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

QUAKE = ["--event", "moderate near field", "--mu", 0.02, "--members", 500]


def run_ensemble(capsys, *arguments):
    code = main(["ensemble", *map(str, arguments)])
    out, err = capsys.readouterr()
    return code, out, err


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
    more = ["--members", 100, "--seed", 7, "--settle", "--level", 0.02, "--threads", 1, "--json"]
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
    p = e.exceedance(0.02)
    assert document["exceedance"] == [
        {"peak_m": 0.02, "value": p.value, "low": p.low, "high": p.high}
    ]
    mean, rms = document["residual_mean_m"], document["residual_rms_m"]
    assert mean["value"] == pytest.approx(e.residual.mean(), rel=1e-12)
    assert mean["error"] == pytest.approx(e.residual.std(ddof=1) / 10, rel=1e-12)
    assert rms["value"] == pytest.approx(np.sqrt((e.residual**2).mean()), rel=1e-12)
    growth = document["stationary"]["growth_rate_m2_s"]
    assert growth == {
        "value": e.stationary.growth_rate.value,
        "error": e.stationary.growth_rate.error,
    }


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
    assert lines[-1] == "(the last two from 3.75 to 11.2 s)"


REFUSED_ENSEMBLES = {
    "an unknown event": (["--event", "big", "--mu", 0.1], "got 'big'"),
    "negative friction": (["--event", "great near field", "--mu", -1], "got -1"),
    "one member": ([*QUAKE, "--members", 1], "--members must be at least 2"),
    "fewer than none": ([*QUAKE, "--members", -7], "got -7"),
    "a negative seed": ([*QUAKE, "--seed", -1], "seed must be at least 0, got -1"),
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
        ["--event", "great near field"],
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
