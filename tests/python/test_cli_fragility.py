"""`stickslip fragility`: options, tables, files."""

import csv
import json
import warnings

import numpy as np
import pytest
import stickslip as ss
from stickslip.cli import main
from stickslip.runs import progress

pytest.importorskip("scipy")

pytestmark = pytest.mark.filterwarnings("ignore:Fragility.*extrapolated")

USUAL = ["fragility", "sample:all", "--mu", "0.2", "--thresholds", "0.02", "0.1"]
PGA = ["--pga", "0.2", "0.4", "0.8", "1.2"]


def fitted(**more):
    stripes = ss.sample_records().stripes(pga_g=[0.2, 0.4, 0.8, 1.2])
    mu = ss.Random(ss.Coulomb, mu=ss.Lognormal(median=0.2, beta=0.3))
    table = ss.sweep(mu, stripes, members=20, seed=3, settle=True)
    return ss.Fragility.fit(table, im="pga_g", thresholds=[0.02, 0.1], **more)


@pytest.mark.filterwarnings("default:.*share a dispersion")
def test_the_rows_are_those_of_the_library(capsys, tmp_path):
    more = ["--mu-beta", "0.3", "--members", "20", "--seed", "3", *PGA]
    assert main([*USUAL, *more, "--json", "--csv", str(tmp_path / "f.csv")]) == 0
    captured = capsys.readouterr()
    assert "share a dispersion" in captured.err
    document = json.loads(captured.out)
    with pytest.warns(RuntimeWarning, match="share a dispersion"):
        f = fitted()
    bands = f.bands(0.9)
    assert (document["records"], document["method"]) == (18, "lognormal")
    for i, row in enumerate(document["results"]):
        assert row["threshold_m"] == f.thresholds[i]
        assert row["median_g"] == f.median[i]
        assert [row["median_low_g"], row["median_high_g"]] == bands.median[i].tolist()
        assert row["beta_parameters"] == f.beta_parameters[i]
    with (tmp_path / "f.csv").open(newline="") as stream:
        assert [float(row["hclpf_g"]) for row in csv.DictReader(stream)] == f.hclpf.tolist()
    assert main([*USUAL, *more, "--separate"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].split()[:2] == ["exceeds", "[m]"]
    assert f"{fitted(separate=True).median[1]:.3g}" in lines[2]


def test_what_lies_beyond_the_levels_has_an_asterisk(capsys):
    levels = ["--thresholds", "0.02", "0.1", "--pga", "0.1", "0.2", "0.4", "0.8"]
    options = ["fragility", "sample:all", "--mu", "0.3", *levels]
    with warnings.catch_warnings():
        warnings.simplefilter("always")
        assert main([*options, "--json"]) == 0
        captured = capsys.readouterr()
        assert main(options) == 0
    (row,) = (r for r in json.loads(captured.out)["results"] if r["threshold_m"] == 0.1)
    assert row["extrapolated"] == ["median_g"]
    assert captured.err.count("extrapolated") == 1
    *_, line, note = capsys.readouterr().out.splitlines()
    assert f"{row['median_g']:.3g}*" in line
    assert note == "*: extrapolated, outside 0.1 to 0.8 g"


def test_without_levels_the_records_are_a_cloud(capsys, tmp_path):
    pytest.importorskip("matplotlib")
    picture = tmp_path / "f.png"
    hazard = tmp_path / "h.csv"
    hazard.write_text("PGA,rate\n0.02,1e-1\n0.2,5e-3\n0.8,2e-4\n3,1e-6\n")
    assert main([*USUAL, "--plot", str(picture), "--hazard", str(hazard), "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["method"] == "cloud"
    assert picture.stat().st_size > 10_000
    table = ss.sweep(ss.Coulomb(mu=0.2), ss.sample_records(), settle=True)
    f = ss.Fragility.fit(table, im="pga_g", thresholds=[0.02, 0.1], method="cloud")
    h = f.rate_of_exceedance(ss.read_hazard(hazard))
    assert [row["rate_per_year"] for row in document["results"]] == h.rate.tolist()
    assert [row["probability"] for row in document["results"]] == h.probability(50).tolist()
    assert main([*USUAL, "--hazard", str(hazard)]) == 0
    assert "in 50 years" in capsys.readouterr().out


@pytest.mark.parametrize(
    "more, message",
    [
        ([*PGA, "--mu-beta", "-1"], "--mu-beta must be at least 0"),
        ([*PGA, "--members", "0"], "--members must be"),
        (["--pga", "0"], "pga_g must be positive and finite, got 0 g"),
        ([*PGA, "--thresholds", "50"], "none of the 144 responses exceed 50 m"),
        ([*PGA, "--plot", "f.txt"], "must end in .png"),
    ],
)
def test_what_cannot_be_fitted_is_an_error(capsys, more, message):
    assert main([*USUAL, *more]) == 2
    captured = capsys.readouterr()
    assert message in captured.err
    assert captured.out == ""


def test_both_components_of_a_station_are_one_record(capsys, tmp_path):
    rng = np.random.default_rng(5)
    files = []
    for station in ("KOB", "TAK", "NIS"):
        for azimuth in ("090", "000"):
            file = tmp_path / f"{station}-{azimuth}.csv"
            smooth = np.ones(1 + 4 * len(files))  # slower ones slide further at the same PGA
            samples = np.convolve(rng.standard_normal(200), smooth, "same")
            file.write_text("\n".join(f"{0.02 * i:.2f}, {a:.9g}" for i, a in enumerate(samples)))
            files.append(str(file))
    levels = ["--pga", "0.15", "0.2", "0.3", "0.5", "--thresholds", "0.002", "--mu", "0.1"]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        assert main(["fragility", *files, "--units", "m/s^2", *levels, "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["records"] == 3


@pytest.mark.parametrize(
    ("more", "message"),
    [
        (["--mu", "0"], "--mu must be positive, got 0"),
        (["--mu", "0.1", "--years", "10"], "--years goes with --hazard, got 10 without"),
        (["--mu", "0.1", "--members", "10"], "--members goes with --mu-beta, got 10 without"),
    ],
)
def test_options_without_a_meaning_are_refused(capsys, more, message):
    assert main(["fragility", "sample:Kobe", "--thresholds", "0.1", *more]) == 2
    assert message in capsys.readouterr().err


@pytest.mark.filterwarnings("ignore:Fragility.bands")
def test_a_terminal_sees_the_progress(capsys, monkeypatch):
    monkeypatch.setattr("sys.stderr.isatty", lambda: True, raising=False)
    monkeypatch.setattr(progress, "_DELAY", 0.0)
    assert main([*USUAL, *PGA, "--separate"]) == 0
    captured = capsys.readouterr()
    assert "144/144" in captured.err
    assert "1000/1000" in captured.err
    assert "#" not in captured.out


def test_one_record_leaves_the_interval_unbounded(capsys):
    options = ["--mu", "0.1", "--mu-beta", "0.6", "--pga", "0.1:1.3:0.1", "--thresholds", "0.02"]
    assert main(["fragility", "sample:Kobe", *options]) == 0
    assert "0 to inf" in capsys.readouterr().out
    assert main(["fragility", "sample:Kobe", *options, "--json"]) == 0
    row = json.loads(capsys.readouterr().out)["results"][0]
    assert (row["median_low_g"], row["median_high_g"]) == (0.0, None)


def test_of_several_measures_the_command_takes_the_pga(capsys, tmp_path):
    """Files of the hazard tool hold all measures at once; the command is about PGA alone."""
    file = tmp_path / "hazard.json"
    curves = [
        {"imt": {"value": name}, "data": [{"component": "Total", "values": values}]}
        for name, values in (
            ("SA1P0", {"xs": [0.1, 1.0, 9.0], "ys": [9e-2, 9e-3, 9e-4]}),
            ("PGA", {"xs": [0.01, 0.4, 9.0], "ys": [1e-1, 1e-3, 1e-6]}),
        )
    ]
    file.write_text(json.dumps({"response": {"hazardCurves": curves}}))
    rates = []
    two = tmp_path / "two.txt"
    two.write_text("0.01 1e-1\n0.4 1e-3\n9 1e-6\n")
    for hazard in (file, two):
        options = ["--mu", "0.1", "--pga", "0.2", "0.4", "0.8", "--thresholds", "0.05"]
        assert main(["fragility", "sample:all", *options, "--hazard", str(hazard), "--json"]) == 0
        rates.append(json.loads(capsys.readouterr().out)["results"][0]["rate_per_year"])
    assert rates[0] == rates[1]
