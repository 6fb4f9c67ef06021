"""Ensembles of sliders in the plane: shapes, the same bits everywhere, files, tables, refusals."""

import json
from concurrent.futures import ProcessPoolExecutor

import numpy as np
import pytest
import stickslip as ss

BAND = ss.Spectrum.band_pass(s0=0.05, low=2, high=40)
ALONG = ss.GaussianExcitation(BAND, dt=0.02, samples=401)
PAIRS = ss.WithTransverse(ALONG, ratio=0.8, coherence=0.6)
BLOCK = ss.PlanarSlider(ss.Coulomb(mu=0.04))


def run(slider=BLOCK, motions=PAIRS, **options):
    return ss.run_ensemble(slider, motions, **({"members": 130, "seed": 5, "dt": 0.4} | options))


@pytest.fixture(scope="module")
def ensemble():
    return run(threads=1)


def test_statistics_are_those_of_the_members(ensemble):
    responses = [ss.integrate(BLOCK, PAIRS.sample(seed=5, member=i)) for i in range(130)]
    # To the rounding of a few hundred segments.
    near = {"rtol": 1e-11, "atol": 1e-14}
    assert ensemble.in_plane
    assert ensemble.residual.shape == (130, 2)
    np.testing.assert_allclose(ensemble.peak, [r.peak for r in responses], **near)
    np.testing.assert_allclose(ensemble.residual, [r.residual for r in responses], **near)
    at = np.array([r.displacement[::20] for r in responses])  # (members, times, 2)
    assert ensemble.displacement_variance.shape == (21, 2)
    np.testing.assert_allclose(ensemble.displacement_mean, at.mean(axis=0), **near)
    np.testing.assert_allclose(ensemble.displacement_variance, at.var(axis=0, ddof=1), **near)
    covariance = [np.cov(at[:, k].T)[0, 1] for k in range(21)]
    np.testing.assert_allclose(ensemble.displacement_covariance, covariance, **near)
    speed = np.array([r.velocity[::20] for r in responses])
    np.testing.assert_allclose(ensemble.velocity_variance, speed.var(axis=0, ddof=1), **near)
    product = [np.cov(at[:, k, 1], speed[:, k, 1])[0, 1] for k in range(21)]
    np.testing.assert_allclose(ensemble.covariance[:, 1], product, **near)
    assert ensemble.displacement_covariance_error.shape == (21,)
    assert (ensemble.velocity_covariance_error[1:] > 0).all()


def test_peaks_have_quantiles_and_exceedances(ensemble):
    median = ensemble.quantile(0.5)
    assert median.low < median.value < median.high
    assert ensemble.exceedance(median.value).value == 0.5
    # The peak is at least the distance at the end.
    assert (np.hypot(*ensemble.residual.T) <= ensemble.peak * (1 + 1e-12)).all()


def test_threads_and_processes_give_the_same_bits(ensemble, tmp_path):
    assert run(threads=3) == ensemble
    with ProcessPoolExecutor(2) as pool:
        assert run(executor=pool) == ensemble
    assert run(ss.Random(ss.PlanarSlider, law=ss.Coulomb(mu=0.04))).peak == pytest.approx(
        ensemble.peak, rel=1e-15
    )
    half = run(members=64)
    half.merge(run(members=66, first_member=64))
    assert half == ensemble
    kept = tmp_path / "half.npz"
    run(members=64, checkpoint=kept)
    assert run(checkpoint=kept) == ensemble
    ensemble.save(tmp_path / "whole.npz")
    assert ss.Ensemble.load(tmp_path / "whole.npz") == ensemble


def test_sliders_of_lists_and_random_ones_slide_in_the_plane():
    smooth = ss.PlanarSlider(ss.Coulomb(mu=0.02))
    both = run([BLOCK, smooth], members=64)
    assert np.array_equal(both.peak[::2], run(members=64).peak[::2])
    assert np.array_equal(both.peak[1::2], run(smooth, members=64).peak[1::2])
    assert run(ss.Drawn([BLOCK, smooth]), members=64).in_plane
    law = ss.Random(ss.Coulomb, mu=ss.Lognormal(median=0.04, beta=0.3))
    blocks = ss.Random(ss.PlanarSlider, law=law)
    e = run(blocks, members=64)
    assert e.in_plane
    r = ss.integrate(blocks.sample(seed=5, member=9), PAIRS.sample(seed=5, member=9))
    assert e.peak[9] == pytest.approx(r.peak, rel=1e-11)


def test_records_keep_their_own_pairs():
    motions = [PAIRS.sample(seed=1, member=i) for i in range(3)]
    e = run(motions=motions, members=64)
    peaks = [ss.integrate(BLOCK, motion).peak for motion in motions]
    np.testing.assert_allclose(e.peak, np.resize(peaks, 64), rtol=1e-11)


def test_tables_have_a_column_for_each_component(ensemble):
    table = json.loads(ensemble.to_json())
    assert table["by_member"]["residual_axis"] == ensemble.residual[:, 0].tolist()
    assert table["by_time"]["displacement_variance_transverse"] == (
        ensemble.displacement_variance[:, 1].tolist()
    )
    assert table["by_time"]["displacement_covariance"] == ensemble.displacement_covariance.tolist()
    assert table["units"]["displacement_variance_axis"] == "m^2"
    assert "in the plane" in repr(ensemble)
    assert "growth" not in ensemble._repr_html_()


def test_a_plot_has_both_variances_and_the_peaks(ensemble):
    pytest.importorskip("matplotlib")
    from stickslip.plotting import plot_ensemble

    variances, peaks = plot_ensemble(ensemble).axes
    assert [text.get_text() for text in variances.get_legend().get_texts()] == [
        "axis",
        "transverse",
        "covariance",
    ]
    assert peaks.get_yscale() == "log"


@pytest.mark.parametrize("name", ["stationary", "velocity_spectrum", "moments"])
def test_stationary_averages_and_spectrum_are_refused(ensemble, name):
    with pytest.raises(ValueError, match="not available for sliders in the plane"):
        getattr(ensemble, name)


def test_what_does_not_fit_is_refused(ensemble):
    with pytest.raises(ValueError, match=r"ground_acceleration is not available for sliders in"):
        run(ground_acceleration=True)
    with pytest.raises(ValueError, match=r"member 0: .*transverse component"):
        run(motions=ALONG)
    with pytest.raises(TypeError, match=r"sliders\[1\] must be a PlanarSlider, as the first one"):
        run([BLOCK, ss.Coulomb(mu=0.1)])
    with pytest.raises(TypeError, match="covers sliders on one axis"):
        ss.ensemble_sensitivity(BLOCK, PAIRS, "mu", members=64, seed=1)
    axis = run(ss.Coulomb(mu=0.04), ALONG)
    assert axis.displacement_variance.shape == (21,)
    with pytest.raises(ValueError, match="no transverse displacement"):
        _ = axis.displacement_covariance
    with pytest.raises(ValueError, match="cannot merge what differs"):
        axis.merge(ensemble)


@pytest.mark.parametrize(
    "change",
    [
        lambda s: s.update(in_plane=False),
        lambda s: s.update(residual_transverse=s["residual_transverse"][:-1]),
        lambda s: s["residual_transverse"].__setitem__(3, np.nan),
        lambda s: s.update(sums=s["sums"][:, : s["sums"].shape[1] // 4]),
    ],
    ids=["on one axis", "fewer residuals", "a NaN residual", "fewer sums"],
)
def test_a_crooked_file_is_refused(ensemble, tmp_path, change):
    ensemble.save(tmp_path / "whole.npz")
    with np.load(tmp_path / "whole.npz") as kept:
        state = {name: np.array(kept[name]) for name in kept.files}
    change(state)
    np.savez(tmp_path / "odd.npz", **state)
    with pytest.raises(ValueError, match=r"odd\.npz' does not hold what an ensemble does"):
        ss.Ensemble.load(tmp_path / "odd.npz")
