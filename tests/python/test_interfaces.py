"""The table of coefficients of friction."""

from pathlib import Path

import stickslip as ss

GUIDE = Path(__file__).parents[2] / "docs" / "guides" / "equipment.md"


def test_every_interface_has_a_range_and_a_source():
    table = ss.interfaces()
    assert len({row["interface"] for row in table}) == len(table) > 8
    for row in table:
        assert list(row) == ["interface", "mu_low", "mu_high", "note", "source"]
        assert 0 < row["mu_low"] <= row["mu_high"] <= 1
        assert row["source"]
        ss.Coulomb(mu=row["mu_low"])


def test_the_guide_has_the_table():
    page = GUIDE.read_text(encoding="utf-8")
    for row in ss.interfaces():
        low, high = row["mu_low"], row["mu_high"]
        mu = f"{low:g}" if low == high else f"{low:g} to {high:g}"
        line = f"| {row['interface']} | {mu} | {row['note']} | {row['source']} |"
        assert line.replace("|  |", "| |") in page


def test_a_caller_may_change_the_rows_of_its_own_copy():
    ss.interfaces()[0]["mu_low"] = 99
    assert ss.interfaces()[0]["mu_low"] < 1
