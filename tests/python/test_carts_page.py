"""docs/carts.md: its tables computed again."""

import pytest
from pages import ROOT, assert_same_table, measuring

PAGE = ROOT / "docs" / "carts.md"
measured = measuring("measure_carts")


@pytest.mark.slow
@pytest.mark.parametrize("name", measured.SCALES)
def test_the_tables_are_what_comes_out(pyslammer_files, name):
    scale = measured.SCALES[name]
    new = measured.table(measured.HEADING.format(scale=scale), measured.rows(scale))
    assert_same_table(PAGE.read_text(encoding="utf-8"), new)
