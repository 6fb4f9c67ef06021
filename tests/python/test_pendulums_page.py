"""docs/pendulums.md: its table and its picture computed again."""

import pytest
from pages import ROOT, assert_same_picture, assert_same_table, measuring

PAGE = ROOT / "docs" / "pendulums.md"
measured = measuring("measure_pendulums")


def test_the_table_is_what_comes_out(pyslammer_files):
    assert_same_table(PAGE.read_text(encoding="utf-8"), measured.tables()["single"])


def test_the_picture_is_what_comes_out(pyslammer_files, tmp_path):
    pytest.importorskip("matplotlib")
    measured.draw(tmp_path / "picture.png", measured.figure)
    assert_same_picture(tmp_path / "picture.png", measured.PICTURE)
