"""CSV files: what a spreadsheet would run as a formula is text."""

import csv

import pytest
import stickslip as ss
from stickslip._text import no_formula
from stickslip.cli.output import write_csv

EVIL = ["=cmd|' /C calc'!A0", "+1+1", "-2+3", "@SUM(A1)", "\tx", '=HYPERLINK("http://x","y")']


@pytest.mark.parametrize("text", EVIL)
def test_a_formula_becomes_a_text(tmp_path, text):
    assert no_formula(text) == f"'{text}"
    motion = ss.GroundMotion([0, 3, -3, 0], dt=0.5, name=text.strip() or text)
    suite = ss.Suite([motion], {"note": [text], text: ["-0.5"]})
    table = ss.sweep(ss.Coulomb(mu=0.1), suite)
    files = [
        suite.to_csv(tmp_path / "suite.csv"),
        table.to_csv(tmp_path / "table.csv"),
        suite.intensity_measures().to_csv(tmp_path / "measures.csv"),
    ]
    write_csv(tmp_path / "rows.csv", ["name", text], [{"name": text, text: -0.5}])
    for file in [*files, tmp_path / "rows.csv"]:
        with file.open(newline="", encoding="utf-8") as stream:
            heads, *rows = csv.reader(stream)
        assert f"'{text}" in rows[0]
        assert f"'{text}" in heads
        for cell in [*heads, *rows[0]]:
            assert not cell.startswith(("=", "+", "@", "\t"))
            assert not cell.startswith("-") or float(cell) < 0


def test_numbers_and_plain_texts_stay_as_they_are():
    for text in ("-0.5", "+1e3", "-inf", "Kobe", "a=b", ""):
        assert no_formula(text) == text


def test_an_export_quotes_its_name(tmp_path):
    pytest.importorskip("scipy")
    levels = ss.sample_records().stripes(pga_g=[0.1, 0.2, 0.4, 0.8, 1.6])
    table = ss.sweep(ss.Coulomb(mu=0.2), levels, settle=True)
    f = ss.Fragility.fit(table, im="pga_g", thresholds=0.05)
    with f.to_pelicun(tmp_path / "f.csv", id="=cmd,1").open(newline="") as stream:
        (row,) = csv.DictReader(stream)
    assert (row["ID"], row["Demand-Type"]) == ("'=cmd,1", "Peak Ground Acceleration")
