"""The demo: every number it prints is integrate's."""

import importlib.util
import sys

import pytest
import stickslip as ss
from stickslip import demo, samples

needs_records = pytest.mark.skipif(
    importlib.util.find_spec("pyslammer") is None,
    reason="the records are pyslammer's: pip install stickslip[records]",
)


@needs_records
def test_there_are_eighteen_records_and_pyslammer_is_not_imported():
    before = "pyslammer" in sys.modules
    assert len(samples.sample_files()) == 18
    assert ("pyslammer" in sys.modules) == before


@needs_records
def test_the_table_holds_the_numbers_of_integrate():
    motions = ss.sample_records()
    _, units, *rows = demo.table(motions)
    assert units.split()[:2] == ["record", "[g]"]
    assert units.endswith("[cm]")
    assert len(rows) == len(motions)
    for motion, row in zip(motions, rows):
        assert row.startswith(motion.name)
        pga = row[len(motion.name) : -len(demo.THINGS) * demo.CELL]
        assert float(pga) == round(motion.peak_acceleration / ss.STANDARD_GRAVITY, 3)
        for i, thing in enumerate(demo.THINGS):
            begin = len(row) - (len(demo.THINGS) - i) * demo.CELL
            check(row[begin : begin + demo.CELL], thing.slider, motion)


def check(cell, slider, motion):
    if cell.strip() == "rolls":
        r = ss.integrate(slider, motion)
        assert not r.at_rest
        assert r.peak > 10 * slider.law.reach
        return
    r = ss.integrate(slider, motion, settle=True)
    if cell.strip() == "-":
        assert r.peak == 0
        return
    peak, residual = cell.replace("x", " ").split()
    assert float(peak) == pytest.approx(100 * r.peak, abs=0.0501)
    assert float(residual) == pytest.approx(100 * r.residual, abs=0.0501)
    assert not residual.startswith("-0.0")
    assert ("x" in cell) == (r.peak > getattr(slider.law, "reach", float("inf")))


@needs_records
def test_the_demo_explains_prints_and_draws(capsys, tmp_path):
    pytest.importorskip(
        "matplotlib", reason="pictures need matplotlib: pip install stickslip[plot]"
    )
    folder = tmp_path / "new" / "folder"
    assert demo.main(["--out", str(folder)]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    for thing in demo.THINGS:
        assert thing.story in out
    for name in ("one_record.png", "friction_sweep.png"):
        assert f"wrote {folder / name}" in out
        assert (folder / name).read_bytes().startswith(b"\x89PNG")


@needs_records
def test_without_matplotlib_the_table_is_printed_and_the_pictures_are_missed(
    capsys, tmp_path, monkeypatch
):
    monkeypatch.delitem(sys.modules, "stickslip.plotting", raising=False)
    monkeypatch.delattr(ss, "plotting", raising=False)
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    assert demo.main(["--out", str(tmp_path)]) == 0
    out, err = capsys.readouterr()
    assert "Kobe" in out
    assert "pip install stickslip[plot]" in err
    assert not list(tmp_path.iterdir())


def test_without_the_records_the_message_says_what_to_install(capsys, monkeypatch):
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    assert demo.main([]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert "pip install stickslip[records]" in err


@needs_records
def test_a_folder_that_is_a_file_is_refused_by_name(capsys, tmp_path):
    pytest.importorskip(
        "matplotlib", reason="pictures need matplotlib: pip install stickslip[plot]"
    )
    file = tmp_path / "taken"
    file.write_text("")
    assert demo.main(["--out", str(file)]) == 2
    assert "taken" in capsys.readouterr().err
