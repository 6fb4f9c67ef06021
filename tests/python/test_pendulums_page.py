"""docs/pendulums.md: its tables and its picture computed again."""

import numpy as np
import pytest
from pages import ROOT, assert_same_figure, assert_same_table, measuring

PAGE = ROOT / "docs" / "pendulums.md"
measured = measuring("measure_pendulums")


@pytest.mark.slow
@pytest.mark.parametrize("name", ["single", "bounds"])
def test_the_tables_are_what_comes_out(pyslammer_files, name):
    assert_same_table(PAGE.read_text(encoding="utf-8"), measured.tables()[name])


def test_the_picture_is_what_comes_out(pyslammer_files, tmp_path):
    pytest.importorskip("matplotlib")
    assert_same_figure(measured.figure, measured.PICTURE, tmp_path)


def test_what_the_page_says_about_the_bounds_of_friction(pyslammer_files):
    frictions = (measured.LOWER, 1, measured.UPPER)
    peak = np.array([[r.peak for r in measured.exact(f)] for f in frictions])
    residual = np.array([[abs(r.residual) for r in measured.exact(f)] for f in frictions])
    # The nominal value over the larger one of the bounds; residuals, upper bound over nominal.
    assert (peak[1] / peak[::2].max(axis=0)).max() == pytest.approx(1.03, abs=0.005)
    assert (residual[1] / residual[::2].max(axis=0)).max() == pytest.approx(1.82, abs=0.01)
    change = residual[2] / residual[1]
    assert change.min() == pytest.approx(0.10, abs=0.005)
    assert change.max() == pytest.approx(10, abs=0.5)
    # One record reaches the last stop whatever the friction.
    at_stop = peak == measured.TRIPLE.capacity
    assert at_stop.sum(axis=1).tolist() == [1, 1, 1]
    assert at_stop.all(axis=0).sum() == 1
