"""docs/design_displacement.md: its table of recorded pairs computed again."""

import numpy as np
import pytest
import stickslip as ss
from pages import ROOT

TEXT = (ROOT / "docs" / "design_displacement.md").read_text(encoding="utf-8")
BOUNDS = [0.04, 0.06, 0.1]


def pendulum(mu):
    return ss.FrictionPendulum(period=3.0, mu=mu)


@pytest.fixture(scope="module")
def pairs(agency_files):
    folder = agency_files / "usgs_pairs"
    if not folder.is_dir():
        pytest.skip("no usgs_pairs in $STICKSLIP_RECORDS")
    files = sorted(folder.glob("*.txt"))
    table = folder / "pairs.csv"
    with pytest.warns(RuntimeWarning, match="metadata renamed"):
        return ss.Suite.read(files, stations=True, metadata=table, units="g")


def test_the_table_of_recorded_pairs_is_what_comes_out(pairs):
    isolators = [ss.PlanarSlider(pendulum(mu)) for mu in BOUNDS]
    swept = ss.sweep(isolators, pairs, settle=True, polarity="recorded")
    force = np.array(
        [[ss.integrate(one, pair, settle=True).peak_force for one in isolators] for pair in pairs]
    )
    force /= ss.STANDARD_GRAVITY
    peaks = 100 * swept.peak[:, :, 0].T
    begin = TEXT.index("| pair |")
    rows = TEXT[begin:].partition("\n\n")[0].splitlines()[2:]
    assert len(rows) == len(pairs) + 1
    for row, pair, peak, one in zip(rows, pairs, peaks, force):
        name, *cells = (cell.strip() for cell in row.strip("|").split("|"))
        assert name == pair.name.partition(",")[0].replace("_", " ")
        assert cells == [*(f"{x:.1f}" for x in peak), *(f"{x:.3f}" for x in one)]
    _, *means = (cell.strip() for cell in rows[-1].strip("|").split("|"))
    expected = [*(100 * swept.mean()), *force.mean(axis=0)]
    assert np.array(means, float) == pytest.approx(expected, abs=0.0501)
    assert (np.argmax(force, axis=1) == 0).sum() == 2  # "as it does under two pairs here"


def test_one_axis_is_lower_by_as_much_as_the_page_says(pairs):
    larger = np.mean(
        [
            max(
                ss.integrate(pendulum(BOUNDS[0]), pair.rotated(angle), settle=True).peak
                for angle in (0, 90)
            )
            for pair in pairs
        ]
    )
    assert f"two components alone is {100 * larger:.1f} cm" in TEXT
