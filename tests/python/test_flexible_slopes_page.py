"""docs/flexible_slopes.md: what can be computed again in seconds."""

import numpy as np
import pytest
import stickslip as ss
from pages import ROOT, assert_same_table, measuring, rows_below

PAGE = (ROOT / "docs" / "flexible_slopes.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def measured():
    pytest.importorskip("pyslammer")
    return measuring("measure_flexible_slopes")


def rows(heading):
    return rows_below(PAGE, heading)


def numbers(cells):
    return [[float(number) for number in cell.split(", ")] for cell in cells]


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::stickslip.PlausibilityWarning")  # T_s to 2 T_m, ky to k_max
def test_the_methods_differ_as_the_page_says(measured):
    """All exact displacements of the page."""
    new = measured.table(measured.METHOD_HEADING, measured.method_rows())
    assert_same_table(PAGE, new)


@pytest.mark.slow
def test_the_rows_of_short_records_are_what_comes_out(measured):
    table = rows(measured.RECORD_HEADING)
    suite = ss.sample_records()
    assert [row[0] for row in table] == list(suite.names)
    short = [i for i, record in enumerate(suite) if len(record) < 2000]
    assert len(short) == 2
    for i in short:
        name, step, cases, *errors = measured.record_row(i)
        assert table[i][:3] == [name, step, cases]
        np.testing.assert_allclose(numbers(table[i][3:]), numbers(errors), atol=0.11)


def test_errors_fall_with_the_step_of_pyslammer(measured):
    """Of one record here, as in the page's table of four."""
    record = ss.sample_records()[16]  # Northridge PAC-175, the worst
    chosen = measured.PERIODS.index(1.0)
    exact = measured.exactly(record)[:, :, [chosen]]
    largest = []
    for parts in (1, 4):
        its = measured.by_pyslammer(record, parts, [1.0])
        each = [measured.ratios(e, i) for e, i in zip(exact, its)]
        largest.append([abs(ratio - 1).max() for ratio in each])
    first, last = np.array(largest)
    assert (first > 0.02).all()
    assert (last < first / 4).all()
    steps = [numbers(row[1:]) for row in rows(measured.STEP_HEADING)]
    assert [row[0] for row in rows(measured.STEP_HEADING)] == [str(p) for p in measured.PARTS]
    medians = np.array(steps)[..., 0]
    assert (medians[-1] <= 0.1).all()  # [%]


def test_converged_soil_leaves_the_error_of_the_step(measured):
    """pySLAMMER's radiation takes the velocity of the strained soil; without rock both agree."""
    record = ss.sample_records()[16]
    fine = record.resampled(record.dt / 8)
    exact, iterated, given = measured.soils(fine, measured.RIGID)
    np.testing.assert_allclose(given, exact, rtol=3e-3)
    np.testing.assert_allclose(iterated, exact, rtol=0.1)
    exact, iterated, _ = measured.soils(ss.sample_records()[4], measured.ROCK)
    assert (abs(iterated / exact - 1) > 0.2).all()


def test_what_the_page_says_of_the_columns(measured):
    radiation = measured.radiation(measured.ROCK, measured.VELOCITY)
    assert measured.DAMPING + radiation == pytest.approx(0.217, abs=5e-4)
    first = max(abs(r.acceleration[0]) for r in ss.sample_records())
    assert first / ss.STANDARD_GRAVITY == pytest.approx(0.007, abs=5e-4)
    # The errors of all, in the text below the table and in the last row.
    every = numbers(rows(measured.LEVEL_HEADING)[-1][1:])
    by_record = np.array([numbers(row[3:]) for row in rows(measured.RECORD_HEADING)])
    assert by_record[..., 2].max(axis=0).tolist() == [cell[2] for cell in every]
