"""The examples that end in the loss calculations of pelicun and OpenQuake."""

import math
import runpy
import warnings
from pathlib import Path

import pytest

stats = pytest.importorskip("scipy.stats")

EXAMPLES = Path(__file__).parents[2] / "examples"


def shares(f, median, beta):
    """The probabilities of exceeding the thresholds under a lognormal PGA."""
    return [
        stats.norm.cdf(math.log(median / m) / math.hypot(b, beta)) for m, b in zip(f.median, f.beta)
    ]


@pytest.mark.slow
def test_the_cost_in_pelicun_is_that_of_the_curves(pyslammer_files):
    pytest.importorskip("pelicun.assessment")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of pelicun
        names = runpy.run_path(str(EXAMPLES / "loss_pelicun.py"))
        f = names["fragility"]()
        cost = names["losses"](f, 0.8, 0.4)
    first, second = shares(f, 0.8, 0.4)
    exact = names["CABINETS"] * ((first - second) * names["REPAIR"] + second * names["REPLACEMENT"])
    # Five standard errors of the mean: 6e-7.
    error = cost.std() / math.sqrt(names["SAMPLES"])
    assert cost.mean() == pytest.approx(exact, abs=5 * error)
    assert error < 0.02 * exact
