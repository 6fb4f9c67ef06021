"""docs/transport.md and docs/theories.md: what can be computed again in seconds."""

import math

import pytest
from pages import ROOT, measuring, rows_below

TRANSPORT = (ROOT / "docs" / "transport.md").read_text(encoding="utf-8")
THEORIES = (ROOT / "docs" / "theories.md").read_text(encoding="utf-8")
measured = measuring("measure_transport")
side_by_side = measuring("measure_theories")


SLOW = pytest.mark.slow


@pytest.mark.parametrize(
    "tolerance", [0.03, *(pytest.param(t, marks=SLOW) for t in measured.WHITE_TOLERANCES[1:])]
)
def test_errors_under_white_noise_are_within_those_stated(tolerance):
    # Against an independent closed form. The page counts how many; the last digits of a count and a
    # median are those of the machine.
    table = {row[0]: row for row in rows_below(TRANSPORT, measured.WHITE_HEADING)}
    found, shown = measured.white_row(tolerance), table[f"{tolerance:g}"]
    for counts in (found, shown):
        within, values = map(int, counts[1].split(" of "))
        assert (values, counts[3]) == (430, "9 of 9")
        assert within >= 0.98 * values
    for at in (2, 4):
        assert float(found[at]) == pytest.approx(float(shown[at]), rel=0.3, abs=0.02)


@pytest.mark.parametrize(
    "law", ["damper", *(pytest.param(n, marks=SLOW) for n in list(measured.SPEED_LAWS)[1:])]
)
def test_errors_of_laws_of_the_speed_are_within_those_stated(law):
    table = {row[0]: row for row in rows_below(TRANSPORT, measured.SPEED_HEADING)}
    found = measured.speed_row(law)
    for counts in (found, table[law]):
        assert (counts[1], counts[3]) == ("9 of 9", "9 of 9")


def test_the_closed_form_of_a_law_of_the_speed_is_that_of_a_constant_one():
    variance, growth = measured.exact_of_speed(lambda v: 1 + 0 * v, 1.0)
    assert variance == pytest.approx(2 * math.pi**2, rel=1e-6)
    assert growth == pytest.approx(10 * math.pi**3, rel=1e-6)


@SLOW
def test_casters_break_loose_when_the_page_says():
    table = rows_below(TRANSPORT, measured.CASTER_HEADING)
    assert [float(row[0]) for row in table] == list(measured.CASTERS)
    for (gamma, guess), row in list(zip(measured.CASTERS.items(), table))[:2]:
        time, error = measured.transition(gamma, guess)
        shown, shown_error = map(float, row[1].split(" ± "))
        assert time == pytest.approx(shown, rel=1e-3)
        assert error == pytest.approx(shown_error, rel=0.5)


def test_the_drift_is_that_of_the_page():
    # Theory and simulation agree within the stated error and three standard errors: one false alarm
    # in 370 for each of four rows, were the seed not fixed.
    table = rows_below(TRANSPORT, measured.DRIFT_HEADING)
    assert [float(row[0]) for row in table] == measured.DRIFTS
    for row in table:
        mean, error = map(float, row[1].split(" ± "))
        simulated, scatter = row[2].rstrip(")").split(" (")
        digit = 10.0 ** -len(simulated.partition(".")[2])
        assert abs(mean - float(simulated)) <= error + 3 * float(scatter) * digit


def test_pulses_have_the_errors_of_the_page():
    table = rows_below(TRANSPORT, measured.PULSE_HEADING)
    assert [" | ".join(row[:4]) for row in table] == [s.name for s in measured.PULSES]
    cells, covered = measured.pulse_row(measured.PULSES[3], 50_000)
    assert all(covered)
    found = " | ".join(cells).split(" | ")
    assert found in table
    ((settings, values, within),) = rows_below(TRANSPORT, measured.PULSE_COVERAGE)
    assert settings == "40"
    assert int(within.split()[0]) >= 0.95 * int(values)


def test_every_setting_has_a_row_beside_all_theories():
    table = rows_below(THEORIES, side_by_side.HEADING)
    assert [row[:2] for row in table] == [list(setting[:2]) for setting in side_by_side.SETTINGS]


@SLOW
@pytest.mark.parametrize("excitation", ["pulses, lambda Dt = 0.1, sigma / a = 2", "0.1, 2"])
def test_a_row_beside_all_theories_is_what_comes_out(excitation):
    setting = next(s for s in side_by_side.SETTINGS if s[1] == excitation)
    found = side_by_side.row(setting, side_by_side.MEMBERS)
    assert found in rows_below(THEORIES, side_by_side.HEADING)
