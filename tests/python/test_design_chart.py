"""Design charts, and the scatter about intensity measures."""

import numpy as np
import pytest
import stickslip as ss
from test_fragility import cloud

pytest.importorskip("scipy")

SUITE = ss.sample_records()[:6]


def pair(i):
    a, b = (ss.sample_records()[j].acceleration[:1000] for j in (i, i + 1))
    return ss.GroundMotion(a, dt=0.01, transverse=b, name=f"pair {i}")


def test_a_chart_holds_percentiles_of_a_sweep():
    chart = ss.design_chart(SUITE, [0.05, 0.2], pgv=[0.2, 0.5], percentiles=[50, 84])
    assert chart.peak.shape == (2, 2, 2)
    for i, level in enumerate((0.2, 0.5)):
        table = ss.sweep(
            ss.grid(ss.Coulomb, mu=[0.05, 0.2]), SUITE.scaled_to(pgv=level), settle=True
        )
        for p, share in enumerate((0.5, 0.84)):
            assert chart.peak[p, i] == pytest.approx(table.quantile(share), rel=1e-9)
            assert chart.residual[p, i] == pytest.approx(table.quantile(share, "residual"))
    frame = pytest.importorskip("pandas") and chart.to_dataframe()
    row = frame[(frame.percentile == 84) & (frame.pgv == 0.5) & (frame.mu == 0.2)]
    assert row["peak"].item() == chart.peak[1, 1, 1]
    assert frame.attrs["units"] == {"percentile": "%", "pgv": "m/s", "peak": "m", "residual": "m"}


def test_pairs_count_over_all_directions():
    pairs = ss.Suite([pair(0), pair(2)])
    charts = {
        name: ss.design_chart(pairs[:1], 0.1, pga_g=0.5, percentiles=50, directions=name)
        for name in ("rotd50", "rotd100")
    }
    angles = range(0, 180, 10)
    own = [pairs[0].rotated(a).peak_acceleration for a in angles]
    for name, statistic in (("rotd50", np.median), ("rotd100", np.max)):
        factor = 0.5 * ss.STANDARD_GRAVITY / statistic(own)
        block = ss.Coulomb(mu=0.1)
        peaks = [
            ss.integrate(block, pairs[0].rotated(a).scaled(factor), settle=True).peak
            for a in angles
        ]
        assert charts[name].peak.item() == pytest.approx(statistic(peaks), rel=1e-9)
    # An isotropic pair: the same component twice, turned by 45 degrees, moves along one direction.
    n = SUITE[0].acceleration
    line = ss.Suite([ss.GroundMotion(n, dt=SUITE[0].dt, transverse=0 * n)])
    along = ss.design_chart(line, [0.1], pga_g=[0.5], directions="rotd100")
    axis = ss.design_chart(line, [0.1], pga_g=[0.5])
    assert along.peak == pytest.approx(axis.peak, rel=1e-9)


def test_a_chart_tells_its_progress(capsys):
    ss.design_chart(SUITE, [0.05, 0.2], pga_g=[0.2, 0.5], progress=True)
    assert "48/48" in capsys.readouterr().err

    def interrupt(done, total):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        ss.design_chart(SUITE, [0.05, 0.2], pga_g=[0.2, 0.5], progress=interrupt)


def test_what_no_chart_can_show_is_refused():
    for bad, why in (
        ({}, "give pga_g or pgv, got none"),
        ({"pga_g": [1], "pgv": [1]}, "got pga_g and pgv"),
        ({"pga_g": [1], "directions": "rotd00"}, "directions must be"),
        ({"pga_g": [1], "percentiles": 101}, "percentiles must lie from 0 to 100"),
        ({"pga_g": [1], "directions": "rotd50"}, "has no transverse component"),
        ({"pga_g": [0]}, "pga_g must be positive"),
    ):
        with pytest.raises(ValueError, match=why):
            ss.design_chart(SUITE, [0.1], **bad)
    pytest.importorskip("matplotlib")
    chart = ss.design_chart(SUITE[:2], [0.1, 0.2], pga_g=np.linspace(0.1, 0.7, 7))
    with pytest.raises(ValueError, match="at most 6 levels, got 7"):
        chart.plot()
    with pytest.raises(ValueError, match="quantity must be 'peak' or 'residual'"):
        chart.plot("events")
    chart = ss.design_chart(SUITE[:2], [0.1, 0.2], pga_g=[0.4, 0.8])
    (axes,) = chart.plot("residual").axes
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["0.4 g", "0.8 g"]
    assert axes.get_title(loc="left") == "Residual displacement of a block under scaled records"
    ends = "a line ends where the block does not slide"
    assert ends not in [text.get_text() for text in axes.texts]
    (axes,) = ss.design_chart(SUITE[:2], [0.1, 0.9], pga_g=[0.4]).plot().axes
    assert ends in [text.get_text() for text in axes.texts]


def test_the_scatter_is_that_of_the_regression():
    # ln D = -1 + 2 ln IM + 0.5 e: the standard errors are 0.5/sqrt(2 n) and 0.5/sqrt(n) over the
    # deviation of ln IM, 1.1: four of each, 1e-4.
    t = cloud(1, records=4000)
    found = ss.intensity_efficiency(t, ["pga_g"], periods=(), censored_below=1e-6)
    assert found.sigma[0] == pytest.approx(0.5, abs=0.03)
    assert found.slope[0] == pytest.approx(2, abs=0.04)
    assert found.beta[0] == pytest.approx(0.25, abs=0.015)


def test_measures_are_sorted_by_their_scatter():
    t = ss.sweep(ss.Coulomb(mu=0.1), ss.sample_records(), settle=True)
    found = ss.intensity_efficiency(t, periods=[1.0, 2.0])
    assert set(found.measure) == {"pga_g", "pgv", "arias", "cav", "sa_g(1 s)", "sa_g(2 s)"}
    assert (np.diff(found.sigma) >= 0).all()
    assert found.measure[0] == "pgv"  # of a block, as is known of sliding
    frame = pytest.importorskip("pandas") and found.to_dataframe()
    assert frame["measure"].tolist() == list(found.measure)
