"""docs/one_axis.md: its tables from the measured values, some of these again, and what it says."""

import re
from functools import partial

import numpy as np
import pytest
import stickslip as ss
from pages import ROOT, assert_same_figure, measuring

PAGE = ROOT / "docs" / "one_axis.md"
TEXT = PAGE.read_text(encoding="utf-8")
WORDS = " ".join(TEXT.split())


@pytest.fixture(scope="module")
def measured():
    return measuring("measure_one_axis")


@pytest.fixture(scope="module")
def rows(measured):
    return measured.stored()


def test_the_tables_are_those_of_the_measured_values(measured, rows, monkeypatch):
    monkeypatch.setattr(measured, "of_triples", lambda ratio, mu: ["..."])  # below
    tables = measured.tables(rows)
    assert len(tables) == 8
    for name, found in tables.items():
        assert name == "triples" or found in TEXT, name


@pytest.mark.slow
def test_the_table_of_synthetic_motions_is_what_comes_out(measured):
    # The largest ratio and friction, where vertical motion matters most.
    row = measured.of_triples(1.0, 0.2)
    (shown,) = (line for line in TEXT.splitlines() if line.startswith("| 1.00 | 0.2 |"))
    cells = [cell.strip() for cell in shown.strip("|").split("|")]
    for there, here in zip(cells, row, strict=True):
        numbers = zip(*(re.findall(r"[\d.]+", one) for one in (there, here)), strict=True)
        # One in the last digit of a median; one direction of one of 50 pairs is 0.01 %.
        assert all(float(a) == pytest.approx(float(b), abs=0.0101) for a, b in numbers)


@pytest.mark.parametrize("kind", ["block", "pendulum"])
def test_the_measured_values_are_those_of_the_records(measured, rows, agency_files, kind):
    """Two stations, one with a vertical component, at the coefficients of two tables."""
    stations = {station.name: station for station in measured.stations()}
    if not stations:
        pytest.skip("no pairs in $STICKSLIP_RECORDS")
    assert set(stations) == {row["station"] for row in rows}
    chosen = [name for name in stations if "PAC" in name or "WTMC" in name]
    assert len(chosen) == 2
    for name in chosen:
        some = [r for r in rows if r["station"] == name and r["slider"] == kind][::7]
        assert {r["components"] for r in some} >= {"horizontal"}
        for row in some:
            station = stations[name]
            if row["components"] == "horizontal":
                station = measured.flat(station)
            mu = row["mu"] if row["fraction"] is None else row["fraction"] * measured.pga(station)
            (found,) = measured.responses(kind, [mu], station)
            for quantity, value in found.items():
                # Four digits; a direction more or less where one axis is nearly right.
                assert row[quantity] == pytest.approx(
                    value, rel=6e-4, abs=6e-3 * ("low" in quantity)
                )


def test_the_estimates_are_what_the_page_says_they_are(measured):
    """The last resort: two pulses at right angles, one after the other, from scratch."""
    n, t = np.zeros(401), np.zeros(401)
    n[:50], n[50:100] = 3.0, -3.0
    t[200:250], t[250:300] = 4.0, -4.0
    station = ss.GroundMotion(n, dt=0.01, transverse=t)
    (found,) = measured.responses("block", [0.1], station)
    along, across = (
        abs(ss.integrate(ss.Coulomb(mu=0.1), ss.GroundMotion(one, dt=0.01), settle=True).residual)
        for one in (n, t)
    )
    assert found["residual_larger"] == pytest.approx(max(along, across), rel=1e-9)
    assert found["residual_srss"] == pytest.approx(np.hypot(along, across), rel=1e-9)
    # The pulses do not overlap, so that the block slides along one axis at a time.
    assert found["residual"] == pytest.approx(np.hypot(along, across), rel=1e-9)
    assert found["residual_larger_low"] == 1
    # A direction between both sees parts of both pulses.
    assert found["residual_rotd100"] >= max(along, across) * (1 - 1e-9)


def test_the_summary_is_that_of_the_tables(measured, rows):
    def column(quantity, estimate, fractions=True):
        return {
            value: np.median(measured.ratios(some, quantity, estimate))
            for value, some in measured.groups(rows, "block", fractions)
        }

    def low(estimate, fractions):
        groups = measured.groups(rows, "block", fractions)
        return {value: measured.low(some, "peak", estimate) for value, some in groups}

    larger, srss, rotd = (column("peak", name) for name in measured.ESTIMATES)
    assert f"low** in {min(low('larger', False).values()):.0f} % of the cases at least" in WORDS
    beyond = [share for value, share in low("larger", True).items() if value >= 0.4]
    assert f"in {min(beyond):.0f} % and more once mu g reaches 0.4 times the PGA" in WORDS
    small = [larger[value] for value in (0.05, 0.1, 0.2)]
    assert f"{min(small):.2f} to {max(small):.2f} up to 0.2 times the PGA" in WORDS
    assert f"{larger[0.5]:.2f} at half the PGA and {larger[0.8]:.2f} at 0.8 times" in WORDS
    small = [srss[value] for value in (0.05, 0.1, 0.2)]
    assert f"({min(small):.2f} to {max(small):.2f}, with 16 to 84 %" in WORDS
    assert f"from {rotd[0.2]:.2f} at 0.2 times the PGA to {rotd[0.5]:.2f} at half of it" in WORDS
    assert f"it is low in {low('rotd100', True)[0.5]:.0f} % of the pairs" in WORDS
    pgas = [row["pga_g"] for row in rows]
    assert f"PGAs from {min(pgas):.2f} to {max(pgas):.2f} g" in WORDS


def test_the_pictures_are_those_of_the_measured_values(measured, rows, tmp_path):
    pytest.importorskip("matplotlib")
    pytest.importorskip("PIL.Image")
    for file, draw in measured.PICTURES.items():
        assert_same_figure(partial(draw, rows), file, tmp_path)
