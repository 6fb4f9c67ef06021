"""The examples that end in the loss calculations of pelicun and OpenQuake."""

import math
import runpy
import warnings
from pathlib import Path

import numpy as np
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


@pytest.mark.slow
def test_the_loss_in_openquake_is_that_of_the_curves(pyslammer_files, tmp_path, monkeypatch):
    monkeypatch.setenv("OQ_DISTRIBUTE", "no")
    monkeypatch.setenv("OQ_DATADIR", str(tmp_path))
    monkeypatch.chdir(tmp_path)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of OpenQuake
        pytest.importorskip("openquake.calculators.base")
        from openquake.commonlib import dbapi
        from openquake.server.db import actions

        actions.upgrade_db(dbapi.db)
        names = runpy.run_path(str(EXAMPLES / "loss_openquake.py"))
        f = names["fragility"]()
        pga = 0.8 * np.exp(0.4 * np.random.default_rng(1).standard_normal(50))
        loss = names["mean_loss"](f, pga)
    first, second = f.probability(pga)
    less, all_of_it = names["RATIOS"]
    ratio = (less * (first - second) + all_of_it * second).mean()
    # OpenQuake stores fractions in single precision.
    assert loss == pytest.approx(ratio * names["CABINETS"] * names["COST"], rel=1e-5)
