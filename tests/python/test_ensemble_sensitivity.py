"""Derivatives of the statistics of ensembles: members, Euler's theorem, differences, refusals."""

import math

import numpy as np
import pytest
import stickslip as ss
from sources import BLOCK, SHAKING, Delayed

G = ss.STANDARD_GRAVITY
FLOOR = ss.Slider(ss.Coulomb(slip_level=2), natural_frequency=1.5, damping=0.1)


@pytest.mark.parametrize("parameter", ["mu", "natural_frequency", "damping", "scale"])
def test_each_member_is_differentiated_as_its_response_is(parameter):
    s = ss.ensemble_sensitivity(FLOOR, SHAKING, parameter, members=20, seed=3, settle=True)
    alone = [
        ss.integrate(FLOOR, SHAKING.sample(seed=3, member=i), settle=True).sensitivity(parameter)
        for i in range(20)
    ]
    assert list(s.peak) == [one.peak for one in alone]
    assert list(s.residual) == [one.residual for one in alone]
    assert s.peak_mean.value == pytest.approx(s.peak.mean(), rel=1e-14)
    assert s.peak_mean.error == pytest.approx(s.peak.std(ddof=1) / math.sqrt(20), rel=1e-13)
    assert s.residual_mean.value == pytest.approx(s.residual.mean(), abs=1e-14 * s.peak.max())
    x = ss.run_ensemble(FLOOR, SHAKING, members=20, seed=3, settle=True).residual
    square = 2 * x * s.residual
    assert s.residual_mean_square.value == pytest.approx(square.mean(), rel=1e-9)
    assert s.residual_mean_square.error == pytest.approx(
        square.std(ddof=1) / math.sqrt(20), rel=1e-9
    )
    rms = math.sqrt((x**2).mean())
    assert s.residual_rms.value == pytest.approx(square.mean() / 2 / rms, rel=1e-9)
    # The error of a ratio, to first order: that of the jackknife, to the next order in 1 / members.
    left = [
        np.delete(square, i).mean() / 2 / math.sqrt(np.delete(x**2, i).mean()) for i in range(20)
    ]
    jackknife = math.sqrt(19 / 20 * ((np.array(left) - np.mean(left)) ** 2).sum())
    assert s.residual_rms.error == pytest.approx(jackknife, rel=0.3)


def test_scaled_levels_and_motions_scale_the_response():
    # Euler's theorem for a function of degree 1 in mu and the scale, to round-off.
    by_mu, by_scale = (
        ss.ensemble_sensitivity(ss.Coulomb(mu=0.2), SHAKING, name, members=50, seed=1)
        for name in ("mu", "scale")
    )
    e = ss.run_ensemble(ss.Coulomb(mu=0.2), SHAKING, members=50, seed=1)
    assert 0.2 * by_mu.peak + by_scale.peak == pytest.approx(e.peak, rel=1e-10)
    assert 0.2 * by_mu.residual_rms.value + by_scale.residual_rms.value == pytest.approx(
        math.sqrt((e.residual**2).mean()), rel=1e-10
    )
    by_level = ss.ensemble_sensitivity(
        ss.Coulomb(mu=0.2), SHAKING, "slip_level", members=50, seed=1
    )
    assert by_level.peak * G == pytest.approx(by_mu.peak, rel=1e-14)
    assert by_level.residual_mean_square.error * G == pytest.approx(
        by_mu.residual_mean_square.error, rel=1e-14
    )


def test_differences_with_the_same_seed_agree_and_serve_other_laws():
    # The recipe of the guide. A difference over 2 h is the mean of the derivative over its interval
    # that jumps where the order of events changes: the midpoint rule of n panels is off by at most
    # V / 2n of its variation V, here seen at the points of the rule alone, hence twice that.
    def peak(law):
        return ss.run_ensemble(law, SHAKING, members=300, seed=1).peak

    h, at, n = 0.02, 0.2, 16
    d = (peak(ss.Coulomb(mu=at + h)) - peak(ss.Coulomb(mu=at - h))) / (2 * h)
    slopes = [
        ss.ensemble_sensitivity(
            ss.Coulomb(mu=at + h * (2 * i + 1 - n) / n), SHAKING, "mu", members=300, seed=1
        ).peak_mean.value
        for i in range(n)
    ]
    assert abs(d.mean() - np.mean(slopes)) <= np.abs(np.diff(slopes)).sum() / n
    assert d.mean() + 3 * d.std(ddof=1) / math.sqrt(300) < 0

    def sticking(mu):
        return ss.StaticKinetic(mu_kinetic=mu, mu_static=1.5 * mu)

    d = (peak(sticking(at + h)) - peak(sticking(at - h))) / (2 * h)
    assert d.mean() + 3 * d.std(ddof=1) / math.sqrt(300) < 0


def test_threads_sources_and_progress():
    seen = []
    runs = [
        ss.ensemble_sensitivity(
            BLOCK,
            SHAKING,
            "mu",
            members=40,
            seed=1,
            threads=n,
            progress=lambda done, total: seen.append((done, total)),
        )
        for n in (1, 2, 3)
    ]
    assert runs[0] == runs[1] == runs[2]
    assert seen[-1] == (40, 40)
    assert ss.ensemble_sensitivity(BLOCK, Delayed(), "mu", members=40, seed=1) == runs[0]
    part = ss.ensemble_sensitivity(BLOCK, SHAKING, "mu", members=10, seed=1, first_member=7)
    assert np.array_equal(part.peak, runs[0].peak[7:17])
    assert repr(runs[0]).startswith("<EnsembleSensitivity: 40 members, E[peak] ")
    blocks = ss.Random(ss.Coulomb, mu=ss.Lognormal(median=0.2, beta=0.3))
    records = [SHAKING.sample(seed=2, member=i) for i in range(3)]
    s = ss.ensemble_sensitivity(blocks, records, "mu", members=6, seed=1)
    one = ss.integrate(blocks.sample(seed=1, member=4), records[1]).sensitivity("mu")
    assert s.peak[4] == one.peak


def test_vertical_motion_on_the_ground():
    strong = ss.WithVertical(
        ss.GaussianExcitation(
            SHAKING.spectrum,
            dt=0.1,
            samples=256,
            envelope=ss.Envelope.from_table([0, 2, 20, 25.5], [0, 1, 1, 0]),
        ),
        ratio=2,
    )
    s = ss.ensemble_sensitivity(BLOCK, strong, "mu", members=20, seed=1, contact="clipped")
    r = ss.integrate(BLOCK, strong.sample(seed=1, member=3), contact="clipped")
    assert s.peak[3] == r.sensitivity("mu").peak
    with pytest.raises(ValueError, match=r"ensemble_sensitivity: member \d+: .* not leave the gro"):
        ss.ensemble_sensitivity(BLOCK, strong, "mu", members=20, seed=1)


@pytest.mark.parametrize(
    "slider, message",
    [
        (ss.StaticKinetic(mu_static=0.2, mu_kinetic=0.1), "static friction above kinetic: its"),
        (
            ss.Stribeck(mu_static=0.2, mu_kinetic=0.1, velocity=0.1, exponent=1),
            "static friction above kinetic: its response jumps",
        ),
        (ss.VelocityDependent(mu_slow=0.1, mu_fast=0.2, rate=20), "level changes during a slip"),
        (ss.Degrading(distance=[0, 0.5], mu=[0.2, 0.1]), "level changes during a slip"),
        (ss.Law(resist=lambda x, speed, direction: 1.0), "a law given as functions of numbers"),
        (ss.Caster(mu=0.1, reach=0.5), "level changes during a slip"),
        (
            ss.Slider(BLOCK, stops=ss.Stops(gap=0.1, restitution=0.5)),
            "stops: near a grazing impact",
        ),
    ],
    ids=lambda value: type(value).__name__,
)
def test_responses_that_jump_or_have_no_derivative_are_rejected(slider, message):
    with pytest.raises(ValueError, match=message) as caught:
        ss.ensemble_sensitivity(slider, SHAKING, "mu", members=5, seed=1)
    assert "take differences of two ensembles with the same seed" in str(caught.value)


def test_arguments_out_of_range_are_rejected():
    for changed, message in (
        ({"members": 1}, "ensemble_sensitivity: members must be at least 2, got 1"),
        ({"seed": -1}, "ensemble_sensitivity: seed must be at least 0, got -1"),
        ({"threads": 0}, "ensemble_sensitivity: threads must be at least 1, got 0"),
        ({"contact": "bounce"}, "ensemble_sensitivity: contact must be 'flight' or 'clipped'"),
        (
            {"parameter": "mass"},
            "parameter must be one of 'mu', 'slip_level', .* got 'mass'",
        ),
        ({"parameter": "natural_frequency"}, "without a spring"),
        ({"parameter": "static"}, "Coulomb friction has one level"),
    ):
        arguments = {"parameter": "mu", "members": 5, "seed": 1} | changed
        with pytest.raises(ValueError, match=message):
            ss.ensemble_sensitivity(BLOCK, SHAKING, **arguments)
