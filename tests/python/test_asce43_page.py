"""docs/asce43.md: its tables and its picture computed again, and what its text says."""

import numpy as np
import pytest
import stickslip as ss
from pages import ROOT, assert_same_figure, assert_same_table, measuring
from stickslip.risk import asce43 as search

PAGE = ROOT / "docs" / "asce43.md"
TEXT = PAGE.read_text(encoding="utf-8")
WORDS = " ".join(TEXT.split())

measured = measuring("measure_asce43")


@pytest.fixture(scope="module")
def tables(pyslammer_files):
    return measured.tables()


def cells(heading):
    """The page's rows of the table that begins with these words."""
    lines = TEXT.splitlines()
    begin = next(i for i, line in enumerate(lines) if line.startswith(f"| {heading} |")) + 2
    end = next(i for i in range(begin, len(lines)) if not lines[i].startswith("|"))
    return [[cell.strip() for cell in line.split("|")[1:-1]] for line in lines[begin:end]]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["samples", "vertical"])
def test_a_table_is_what_comes_out(tables, name):
    assert_same_table(TEXT, tables[name])


@pytest.mark.slow
@pytest.mark.parametrize("name", ["pairs", "station"])
def test_a_table_of_agency_files_is_what_comes_out(tables, agency_files, name):
    if name not in tables:
        pytest.skip(f"no files of the {name} in $STICKSLIP_RECORDS")
    assert_same_table(TEXT, tables[name])


@pytest.mark.slow
def test_the_picture_is_what_comes_out(tables, tmp_path):
    pytest.importorskip("matplotlib")
    assert_same_figure(measured.figure, measured.PICTURE, tmp_path)


def test_the_estimate_is_a_spectral_displacement(pyslammer_files):
    quake = ss.sample_record("Loma Prieta")
    for mu in (0.05, 0.1, 0.3):
        e = ss.asce43(mu=mu, motion=quake)
        largest = ss.response_spectrum(quake, 1 / e.frequency, 0.1, kind="displacement").values[0]
        assert e.displacement == pytest.approx(largest, rel=3e-6)


def test_the_ratio_depends_on_friction_over_acceleration_alone(pyslammer_files):
    """Records and friction that grow by one factor: the ratio of the displacements is the same."""
    quake = ss.sample_record("Loma Prieta")
    one, three = measured.measure(quake, 0.1), measured.measure(quake.scaled(3), 0.3)
    assert three.relative == pytest.approx(one.relative, rel=1e-12)
    assert three.estimate / three.exact == pytest.approx(one.estimate / one.exact, rel=1e-5)


def test_what_the_page_says_in_short():
    rows = [*cells("one component"), *cells("recorded pairs")]
    every = [row for row in rows if row[1] == "all"]
    medians = [float(row[3]) for row in every]
    assert f"in the median**, {min(medians):.1f} to {max(medians):.1f} times" in WORDS
    assert all(0.7 <= round(float(row[5]), 1) <= 0.8 for row in every)
    ends = np.array([[float(x) for x in row[4].split(" to ")] for row in every])
    assert (ends[:, 0] >= 0.9).all() and (ends[:, 1] < 5.5).all()

    def of(name):
        """Medians, and the shares in % that are too low, of a class of mu g / PGA."""
        here = [row for row in rows if row[1] == name]
        assert len(here) == 3
        low = [100 * int(row[6]) / int(row[2].split(", ")[1]) for row in here]
        return [float(row[3]) for row in here], f"{min(low):.0f} to {max(low):.0f} %"

    medians, low = of("0 to 0.1")
    assert f"the median is {min(medians):.1f} to {max(medians):.1f}" in WORDS
    assert f"too low in {low} of the cases" in WORDS
    assert f"from 0.1 to 0.2 in {of('0.1 to 0.2')[1]}, from 0.2 to 0.3 in" in WORDS
    assert f"from 0.2 to 0.3 in {of('0.2 to 0.3')[1]}." in WORDS
    high = [of(name) for name in ("0.3 to 0.45", "0.45 to 0.6", "0.6 to 1")]
    assert all(low == "0 to 0 %" for _, low in high)
    assert f"the median is {min(min(medians) for medians, _ in high):.1f} and more" in WORDS
    one, two = (row for row in cells("recorded pairs") if row[1] == "all")
    assert f"is {two[3]} instead of {one[3]} for the single components" in WORDS
    flat, gentle, strong = (
        f"{float(row[3]):.1f}" for row in cells("synthetic triples") if row[1] == "all"
    )
    assert f"rises from {flat} to {gentle} for V/H = 2/3 and {strong} for V/H = 1" in WORDS


def test_the_estimate_may_grow_with_friction():
    rows = {row[0]: [float(cell) for cell in row[1:]] for row in cells("mu")}
    first, last = rows["0.1"], rows["0.4"]
    assert (
        f"grows from {first[0]:.0f} cm at mu = 0.1 to {last[0]:.0f} cm at mu = 0.4, while the exact"
        f" displacement falls from {first[1]:.0f} to {last[1]:.0f} cm"
    ) in WORDS


def test_the_constants_of_the_bound_are_those_of_the_search():
    said = (
        f"g = {search._OF_FORCE:.2f}, c = {search._OF_RATE:.2f}, alpha = {search._ALPHA:.1f},"
        f" beta = {search._BETA:.1f}, gamma = {search._GAMMA:.2f}"
    )
    assert said in WORDS
    count = int(np.ceil(np.log(search.HIGHEST / search.LOWEST) / search._SPACING)) + 1
    assert f"starts with {count} frequencies" in WORDS
