"""Random vertical motion: the components, ensembles under it, files, rejected arguments."""

import json
import math

import numpy as np
import pytest
import stickslip as ss
from sources import same_bits

G = ss.STANDARD_GRAVITY
BLOCK = ss.Coulomb(mu=0.1)
ENDS = ss.Envelope.from_table([0, 1, 6, 8], [0, 1, 1, 0])  # at rest, so that no member ends aloft
BAND = ss.Spectrum.band_pass(s0=0.05, low=2, high=40)
SHAKING = ss.GaussianExcitation(BAND, dt=0.02, samples=401, envelope=ENDS)
STRONG = ss.GaussianExcitation(
    ss.Spectrum.band_pass(s0=1, low=2, high=40), dt=0.01, samples=801, envelope=ENDS
)
PULSES = ss.PoissonPulses(rate=3, half_width=0.1, sigma=1.5, duration=10)
QUICKER = ss.PoissonPulses(rate=20, half_width=0.02, sigma=1, duration=10)


def test_the_horizontal_component_has_the_same_bits_as_alone():
    both = ss.WithVertical(SHAKING, STRONG, ratio=0.5)
    motion, alone = both.sample(seed=3, member=9), SHAKING.sample(seed=3, member=9)
    assert (motion.samples if hasattr(motion, "samples") else len(motion)) == 801
    assert motion.acceleration[::2] == pytest.approx(alone.acceleration, abs=1e-13)
    like = ss.WithVertical(SHAKING, ratio=2 / 3).sample(seed=3, member=9)
    assert np.array_equal(like.acceleration, alone.acceleration)
    assert like.vertical.std() == pytest.approx(2 / 3 * alone.acceleration.std(), rel=0.5)
    assert not np.array_equal(like.vertical, 2 / 3 * alone.acceleration)
    twice = ss.WithVertical(SHAKING, ratio=4 / 3).sample(seed=3, member=9)
    assert twice.vertical == pytest.approx(2 * like.vertical, rel=1e-15)


def test_what_it_holds():
    both = ss.WithVertical(SHAKING, STRONG, ratio=0.5)
    assert (both.horizontal, both.vertical, both.ratio) == (SHAKING, STRONG, 0.5)
    assert both.duration == SHAKING.duration
    assert ss.WithVertical(PULSES).vertical == PULSES
    assert repr(ss.WithVertical(PULSES)) == f"WithVertical({PULSES!r}, ratio=1)"
    known = json.loads(both.configuration)
    assert known == {
        "excitation": "WithVertical",
        "horizontal": json.loads(SHAKING.configuration),
        "vertical": json.loads(STRONG.configuration),
        "ratio": 0.5,
    }


@pytest.mark.parametrize("contact", ["flight", "clipped"])
@pytest.mark.parametrize(
    "both",
    [ss.WithVertical(SHAKING, STRONG), ss.WithVertical(PULSES, QUICKER, ratio=2)],
    ids=["lines", "pulses"],
)
def test_members_are_what_integrate_says_of_their_motions(both, contact):
    sliders = [BLOCK, ss.Slider(ss.StaticKinetic(mu_static=0.15, mu_kinetic=0.1), 2)]
    e = ss.run_ensemble(sliders, both, members=20, seed=5, contact=contact, settle=True)
    alone = [
        ss.integrate(sliders[i % 2], both.sample(seed=5, member=i), settle=True, contact=contact)
        for i in range(20)
    ]
    # To the rounding of some ten operations in each of a few hundred segments.
    assert e.peak == pytest.approx([r.peak for r in alone], rel=1e-12)
    scale = e.peak.max()
    assert e.residual == pytest.approx([r.residual for r in alone], abs=1e-12 * scale)
    assert any(r.gap.any() for r in alone) == (contact == "flight")


def test_threads_parts_files_and_executors_do_not_matter(tmp_path):
    from concurrent.futures import ThreadPoolExecutor

    both = ss.WithVertical(SHAKING, ratio=2 / 3)
    whole = ss.run_ensemble(BLOCK, both, members=192, seed=1, threads=1)
    assert same_bits(ss.run_ensemble(BLOCK, both, members=192, seed=1, threads=2), whole)
    with ThreadPoolExecutor(2) as pool:
        assert same_bits(ss.run_ensemble(BLOCK, both, members=192, seed=1, executor=pool), whole)
    part = ss.run_ensemble(BLOCK, both, members=64, seed=1, first_member=128)
    part.merge(ss.run_ensemble(BLOCK, both, members=128, seed=1))
    assert same_bits(part, whole)
    part.save(tmp_path / "e.npz")
    assert ss.Ensemble.load(tmp_path / "e.npz") == whole
    assert whole.configuration["excitation"] == json.loads(both.configuration)
    other = ss.run_ensemble(BLOCK, ss.WithVertical(SHAKING), members=64, seed=1)
    with pytest.raises(ValueError, match="excitation"):
        other.merge(whole)
    assert "vertical motion" in ss.Ensemble.load(tmp_path / "e.npz").plot().get_suptitle()


def test_a_ratio_of_zero_is_horizontal_motion():
    with_none = ss.run_ensemble(BLOCK, ss.WithVertical(SHAKING, ratio=0), members=64, seed=1)
    without = ss.run_ensemble(BLOCK, SHAKING, members=64, seed=1)
    assert with_none.peak == pytest.approx(without.peak, rel=1e-12)
    assert np.array_equal(with_none.time, without.time)
    assert with_none.displacement_variance == pytest.approx(
        without.displacement_variance, abs=1e-11 * without.displacement_variance[-1]
    )


def test_the_guide_gives_the_effect_of_vertical_motion_on_peaks():
    both = ss.WithVertical(SHAKING, ratio=2 / 3)
    e, level = (
        ss.run_ensemble(BLOCK, motions, members=2000, seed=1, settle=True)
        for motions in (both, SHAKING)
    )
    change = e.peak / level.peak - 1
    assert change.mean() == pytest.approx(0.021, abs=0.0005)
    assert change.std() == pytest.approx(0.14, abs=0.005)
    assert change.std() / np.sqrt(2000) == pytest.approx(0.003, abs=0.0005)
    alone = ss.integrate(BLOCK, both.sample(seed=1, member=7), settle=True)
    assert e.peak[7] == pytest.approx(alone.peak, rel=1e-12)


def test_what_does_not_fit_is_rejected():
    for arguments, message in (
        ({"ratio": -1}, "ratio must be finite and at least 0, got -1"),
        ({"ratio": math.nan}, "ratio must be finite"),
        ({"vertical": QUICKER}, "must last as long as the horizontal one, 8 s, got 10 s"),
    ):
        with pytest.raises(ValueError, match=message):
            ss.WithVertical(SHAKING, **arguments)
    longer = ss.GaussianExcitation(BAND, dt=0.02, samples=501)
    with pytest.raises(ValueError, match="both held values, got interpolation='linear' and 'const"):
        ss.WithVertical(longer, PULSES)
    for horizontal in (ss.WithVertical(SHAKING), ss.HarmonicMotion(1, 2, 3), BLOCK):
        with pytest.raises(TypeError, match="horizontal must be a GaussianExcitation, Poi"):
            ss.WithVertical(horizontal)
    with pytest.raises(TypeError, match="compare: excitation must be"):
        ss.compare(BLOCK, ss.WithVertical(SHAKING), members=10, seed=1)


def test_held_values_may_end_below_minus_g():
    # Held values end with that of the last step, which is below -g in some members.
    held = ss.GaussianExcitation(
        ss.Spectrum.band_pass(s0=2, low=2, high=40), dt=0.02, samples=401, interpolation="constant"
    )
    e = ss.run_ensemble(BLOCK, ss.WithVertical(held), members=64, seed=1)
    assert 0 < e.airborne < 64
