"""`stickslip newmark`: rigid and flexible sliding masses, with the numbers of the library."""

import csv
import json
import math

import numpy as np
import pytest
import stickslip as ss
from stickslip.cli import main

COLUMN = ["--height", 50, "--vs", 600, "--damping-ratio", 0.05]
METHODS = ["--method", "rigid", "decoupled", "coupled"]


def motion(seed):
    noise = np.random.default_rng(seed).standard_normal(600)
    return ss.GroundMotion(
        3 * np.convolve(noise, np.repeat([1, -1], 8) / 4, "same"), dt=0.02, name=f"r{seed}"
    )


@pytest.fixture
def folder(tmp_path):
    records = tmp_path / "records"
    records.mkdir()
    for seed in (1, 2):
        motion(seed).to_csv(records / f"r{seed}.csv")
    return records


def run(capsys, *arguments):
    code = main(["newmark", *map(str, arguments)])
    out, err = capsys.readouterr()
    return code, out, err


def test_the_numbers_are_those_of_the_library(capsys, folder, tmp_path):
    table = tmp_path / "t.csv"
    code, out, err = run(capsys, folder, "--ky", 0.1, 0.05, *METHODS, *COLUMN, "--csv", table)
    assert (code, err) == (0, "")
    rows = list(csv.DictReader(table.read_text().splitlines()))
    assert [row["method"] for row in rows] == METHODS[1:] * 4
    assert [row["ky_g"] for row in rows] == (["0.05"] * 3 + ["0.1"] * 3) * 2
    for row in rows:
        ky = float(row["ky_g"])
        block = ss.Coulomb(mu=ky, backward=math.inf)
        slope = ss.FlexibleSlope(ky_g=ky, height=50, shear_velocity=600, damping_ratio=0.05)
        slide = {
            "rigid": lambda n, block=block: ss.integrate(block, n, settle=True),
            "decoupled": slope.decoupled,
            "coupled": slope.coupled,
        }[row["method"]]
        quake = ss.read_record(row["file"])
        inverse, normal = slide(quake).peak, slide(-quake).peak
        assert normal > 0 and inverse > 0 and normal != inverse
        assert float(row["inverse_m"]) == pytest.approx(inverse, rel=1e-12)
        assert float(row["normal_m"]) == pytest.approx(normal, rel=1e-12)
        assert float(row["mean_m"]) == pytest.approx((normal + inverse) / 2, rel=1e-12)
    lines = out.splitlines()
    assert lines[0].split()[:6] == ["record", "PGA", "[g]", "ky", "[g]", "method"]
    assert lines[2].split()[:2] == ["0.05", "decoupled"]
    assert lines[2].split()[-1] == f"{100 * float(rows[1]['mean_m']):.2f}"
    assert sum(line.startswith("mean ") for line in lines) == 6  # of each ky and method


def test_modes_and_rock_act(capsys, folder):
    slopes = {
        (): {},
        ("--modes", 3): {"modes": 3},
        ("--rock-vs", 3000): {"rock_velocity": 3000},
    }
    found = set()
    for options, values in slopes.items():
        arguments = ["--ky", 0.05, "--method", "coupled", *COLUMN, *options, "--json"]
        code, out, _ = run(capsys, folder / "r1.csv", *arguments)
        assert code == 0
        (row,) = json.loads(out)["results"]
        slope = ss.FlexibleSlope(
            ky_g=0.05, height=50, shear_velocity=600, damping_ratio=0.05, **values
        )
        quake = ss.read_record(folder / "r1.csv")
        assert row["inverse_m"] == pytest.approx(slope.coupled(quake).peak, rel=1e-12)
        found.add(row["inverse_m"])
    assert len(found) == 3


def test_equivalent_linear_soil(capsys, folder):
    soil = ss.HyperbolicSoil(reference_strain=5e-4)
    options = ["--reference-strain", "0.05%", "--rock-vs", 1500]
    code, out, err = run(
        capsys, folder / "r1.csv", "--ky", 0.05, *METHODS, *COLUMN[:4], *options, "--json"
    )
    assert (code, err) == (0, "")
    _, decoupled, coupled = json.loads(out)["results"]
    slope = ss.FlexibleSlope(
        ky_g=0.05, height=50, shear_velocity=600, soil=soil, rock_velocity=1500
    )
    quake = ss.read_record(folder / "r1.csv")
    assert coupled["normal_m"] == pytest.approx(slope.coupled(-quake).peak, rel=1e-12)
    assert decoupled["inverse_m"] == pytest.approx(slope.decoupled(quake).peak, rel=1e-12)


def test_a_stiff_mass_is_the_rigid_block_in_both_polarities(capsys, folder):
    """With w = pi Vs / (2 H) = 4712 rad/s it follows the ground 2 zeta / w = 2e-5 s late; the
    polarities differ by over 1 %."""
    stiff = ["--height", 1, "--vs", 3000, "--damping-ratio", "5%"]
    code, out, _ = run(capsys, folder, "--ky", 0.05, *METHODS, *stiff, "--json")
    assert code == 0
    rows = json.loads(out)["results"]
    for rigid, *others in zip(rows[::3], rows[1::3], rows[2::3]):
        for row in others:
            for name in ("normal_m", "inverse_m"):
                assert row[name] == pytest.approx(rigid[name], rel=1e-3)
        assert abs(rigid["normal_m"] / rigid["inverse_m"] - 1) > 0.01


def test_without_a_method_nothing_names_one(capsys, folder, tmp_path):
    table = tmp_path / "t.csv"
    _, plain, _ = run(capsys, folder, "--ky", 0.05, "--csv", table)
    assert "method" not in plain
    assert "method" not in table.read_text().partition("\n")[0]
    _, named, _ = run(capsys, folder, "--ky", 0.05, "--method", "rigid", "--csv", table)
    assert [line.split()[-3:] for line in named.splitlines()] == [
        line.split()[-3:] for line in plain.splitlines()
    ]
    assert {row["method"] for row in csv.DictReader(table.read_text().splitlines())} == {"rigid"}


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--vs", 600], "--vs goes with --method coupled or decoupled, got 600 without"),
        (["--method", "rigid", "--modes", 2], "--modes goes with --method coupled or decoupled"),
        (["--rock-vs", 3000], "--rock-vs goes with --method coupled or decoupled"),
        (
            ["--reference-strain", 1e-3],
            "--reference-strain goes with --method coupled or decoupled, got 0.001 without",
        ),
        (
            ["--method", "coupled", *COLUMN, "--reference-strain", 1e-3],
            "--damping-ratio does not go with --reference-strain, from which the damping of the"
            " soil follows, got 0.05",
        ),
        (
            ["--method", "coupled", *COLUMN[:4], "--reference-strain", 0],
            "--reference-strain must be positive and finite, got 0",
        ),
        (
            ["--method", "coupled", "--height", 50, "--reference-strain", 1e-3],
            "coupled needs --vs, got none",
        ),
        (["--method", "coupled"], "coupled needs --height and --vs and --damping-ratio, got none"),
        (["--method", "decoupled", *COLUMN[:4]], "decoupled needs --damping-ratio, got none"),
        (["--method", "coupled", *COLUMN, "--modes", 0], "--modes must be at least 1, got 0"),
        (["--method", "coupled", *COLUMN, "--modes", "1e9"], "--modes must be at most 1000"),
        (
            ["--method", "coupled", *COLUMN[2:], "--height", -1],
            "--height must be positive and finite, got -1 m",
        ),
        (
            ["--method", "coupled", *COLUMN, "--rock-vs", 0],
            "--rock-vs must be positive and finite, got 0 m/s",
        ),
        (
            ["--method", "coupled", *COLUMN[:4], "--damping-ratio", -1],
            "--damping-ratio must be finite and at least 0, got -1",
        ),
    ],
)
def test_options_that_do_not_go_together(capsys, folder, options, said):
    code, out, err = run(capsys, folder, "--ky", 0.1, *options)
    assert (code, out) == (2, "")
    assert said in err
    assert err.count("\n") == 1


def test_a_bad_record_is_reported_and_the_others_are_slid(capsys, folder):
    """One cannot be read; under the other the masses leave at 1e89 m/s and never stop."""
    (folder / "notes.txt").write_text("no record")
    (folder / "x.csv").write_text("Time (s),Acceleration (m/s^2)\n0,1e90\n0.1,-1e90\n0.2,0\n")
    arguments = [folder, "--ky", 0.1, "--method", "rigid", "coupled", *COLUMN, "--json"]
    code, out, err = run(capsys, *arguments)
    assert code == 1
    document = json.loads(out)
    assert [row["method"] for row in document["results"]] == ["rigid", "coupled"] * 2
    rows = [line for line in err.splitlines() if "warning" not in line]
    assert len(rows) == len(document["errors"]) == 3
    assert "notes.txt" in err
    for method, thing in (("rigid", "slider"), ("coupled", "interface")):
        assert (
            f"x.csv: {method}, ky = 0.1 g: without ground motion the {thing} does not come to rest"
            in err
        )
    code, out, err = run(capsys, *arguments, "--strict")
    assert (code, out) == (2, "")
