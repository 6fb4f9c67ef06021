"""docs/carts.md: its tables computed again."""

import pytest
from pages import ROOT, assert_same_table, measuring, rows_below

PAGE = ROOT / "docs" / "carts.md"
measured = measuring("measure_carts")


@pytest.mark.slow
@pytest.mark.parametrize("name", measured.SCALES)
def test_the_tables_are_what_comes_out(pyslammer_files, name):
    scale = measured.SCALES[name]
    new = measured.table(measured.HEADING.format(scale=scale), measured.rows(scale))
    assert_same_table(PAGE.read_text(encoding="utf-8"), new)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["four casters, free", "two fixed wheels behind"])
def test_the_records_move_carts_as_far_as_the_page_says(pyslammer_files, name):
    # With a caster locked the motions are chaotic over minutes: single members hang on round-off.
    here = rows_below(PAGE.read_text(encoding="utf-8"), measured.OF_RECORDS)
    (row,) = (row for row in here if row[0] == name)
    new = measured.table(measured.OF_RECORDS, [measured.of_records(name)])
    assert_same_table(measured.table(measured.OF_RECORDS, [row]) + "\n", new)
