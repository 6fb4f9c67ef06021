"""Random pairs: components, directions of pulses, nesting, ensembles, files."""

import json
import math

import numpy as np
import pytest
import stickslip as ss
from sources import same_bits

BLOCK = ss.Coulomb(mu=0.1)
BAND = ss.Spectrum.band_pass(s0=0.05, low=2, high=40)
SHAKING = ss.GaussianExcitation(BAND, dt=0.02, samples=401)
STRONGER = ss.GaussianExcitation(
    ss.Spectrum.band_pass(s0=0.2, low=2, high=40), dt=0.01, samples=801
)
PULSES = ss.PoissonPulses(rate=3, half_width=0.1, sigma=1.5, duration=8)
QUICKER = ss.PoissonPulses(rate=20, half_width=0.02, sigma=1, duration=8)


def test_the_component_along_the_axis_has_the_same_bits_as_alone():
    for source in (SHAKING, PULSES):
        pair, alone = (
            one.sample(seed=3, member=9) for one in (ss.WithTransverse(source, ratio=0.5), source)
        )
        assert np.array_equal(pair.acceleration, alone.acceleration)
        assert np.array_equal(pair.time, alone.time)
        assert pair.vertical is None
        twice = ss.WithTransverse(source, ratio=1.0).sample(seed=3, member=9)
        assert np.array_equal(twice.transverse, 2 * pair.transverse)
        other = ss.WithTransverse(source, coherence=1).sample(seed=3, member=9)
        assert np.array_equal(other.transverse, alone.acceleration)
        assert ss.WithTransverse(source).sample(seed=3, member=9) == ss.WithTransverse(
            source, source
        ).sample(seed=3, member=9)


@pytest.mark.parametrize(
    ("horizontal", "transverse"),
    [(SHAKING, None), (SHAKING, STRONGER), (PULSES, None), (PULSES, QUICKER)],
    ids=["lines", "other lines", "pulses", "other pulses"],
)
@pytest.mark.parametrize("coherence", [-0.8, 0, 0.5])
def test_ratio_and_coherence_are_those_of_the_motions(horizontal, transverse, coherence):
    # At one time of 2000 independent members. The seed is fixed; 5 standard errors from 20 batches
    # fail once in 13,000 seeds (Student's t of 19 degrees of freedom).
    both = ss.WithTransverse(horizontal, transverse, ratio=0.7, coherence=coherence)
    at, pairs = 5.0, []
    for member in range(2000):
        motion = both.sample(seed=4, member=member)
        i = np.searchsorted(motion.time, at + 1e-9, side="right") - 1
        pairs.append((motion.acceleration[i], motion.transverse[i]))
    along, across = np.array(pairs).T
    v, w = horizontal.variance, 0.49 * (transverse or horizontal).variance
    for found, expected in (
        (along**2 / v, 1),
        (across**2 / w, 1),
        (along * across / math.sqrt(v * w), coherence),
    ):
        batches = found.reshape(20, 100).mean(axis=1)
        assert abs(batches.mean() - expected) < 5 * batches.std(ddof=1) / math.sqrt(20)


def test_each_pulse_has_a_random_direction():
    together = ss.WithTransverse(PULSES)
    assert together.arrivals == "common"
    motion = together.sample(seed=1, member=2)
    idle = motion.acceleration == 0
    assert idle.any()
    assert not motion.transverse[idle].any()  # both components act at the same times
    assert motion.transverse[~idle][:-1].all()
    apart = ss.WithTransverse(PULSES, arrivals="independent")
    assert apart.arrivals == "independent"
    assert apart != together
    assert (
        apart.sample(seed=1, member=2)
        .transverse[:-1][apart.sample(seed=1, member=2).acceleration[:-1] == 0]
        .any()
    )
    # The component along any azimuth is a process of the same pulses: PULSES.variance, with the
    # batches and the false-alarm rate above.
    values = []
    for member in range(2000):
        turned = together.sample(seed=8, member=member).rotated(35)
        values.append(turned.acceleration[np.searchsorted(turned.time, 5, side="right") - 1] ** 2)
    batches = np.reshape(values, (20, 100)).mean(axis=1)
    assert abs(batches.mean() - PULSES.variance) < 5 * batches.std(ddof=1) / math.sqrt(20)


def test_what_it_holds():
    both = ss.WithTransverse(SHAKING, STRONGER, ratio=0.5, coherence=0.3)
    assert (both.horizontal, both.transverse, both.ratio) == (SHAKING, STRONGER, 0.5)
    assert (both.coherence, both.arrivals) == (0.3, "independent")
    assert both.duration == SHAKING.duration
    assert ss.WithTransverse(SHAKING, STRONGER, 0.5, 0.3) == both
    assert ss.WithTransverse(ss.WithVertical(PULSES)).transverse == PULSES
    assert repr(ss.WithTransverse(PULSES)) == f"WithTransverse({PULSES!r}, ratio=1, coherence=0)"
    assert json.loads(both.configuration) == {
        "excitation": "WithTransverse",
        "horizontal": json.loads(SHAKING.configuration),
        "transverse": json.loads(STRONGER.configuration),
        "ratio": 0.5,
        "coherence": 0.3,
        "arrivals": "independent",
    }


@pytest.mark.parametrize(
    ("h", "t", "v"),
    [(SHAKING, STRONGER, SHAKING), (PULSES, PULSES, QUICKER)],
    ids=["lines", "pulses"],
)
def test_both_orders_of_nesting_give_the_same_bits(h, t, v):
    one = ss.WithVertical(ss.WithTransverse(h, t, coherence=0.4), v, ratio=0.6)
    other = ss.WithTransverse(ss.WithVertical(h, v, ratio=0.6), t, coherence=0.4)
    for member in range(3):
        motion = one.sample(seed=5, member=member)
        assert motion == other.sample(seed=5, member=member)
        assert motion.transverse is not None
        assert motion.vertical is not None
    assert one.configuration == other.configuration
    e, f = (ss.run_ensemble(BLOCK, m, members=64, seed=5, settle=True) for m in (one, other))
    assert same_bits(e, f)
    default = ss.WithVertical(ss.WithTransverse(h), ratio=0.6)
    assert default.vertical == h
    assert np.array_equal(
        default.sample(seed=5, member=1).vertical,
        ss.WithVertical(h, ratio=0.6).sample(seed=5, member=1).vertical,
    )
    assert "vertical motion" in e.plot().get_suptitle()


@pytest.mark.parametrize(
    "slider",
    [BLOCK, ss.Slider(BLOCK, 2.0), ss.Slider(BLOCK, slope_degrees=2), ss.Caster(mu=0.1, reach=0.1)],
    ids=repr,
)
@pytest.mark.parametrize("source", [SHAKING, PULSES], ids=["lines", "pulses"])
def test_an_ensemble_on_one_axis_has_the_bits_of_one_without_it(slider, source):
    both = ss.WithTransverse(source, coherence=0.5)
    e = ss.run_ensemble(slider, both, members=100, seed=2, ground_acceleration=True)
    alone = ss.run_ensemble(slider, source, members=100, seed=2, ground_acceleration=True)
    for name in ("peak", "residual", "displacement_variance", "velocity_variance"):
        assert np.array_equal(getattr(e, name), getattr(alone, name))
    assert e.configuration["excitation"] == json.loads(both.configuration)
    with pytest.raises(ValueError, match="excitation"):
        e.merge(ss.run_ensemble(slider, source, members=64, seed=2, ground_acceleration=True))


def test_threads_parts_files_and_executors_do_not_matter(tmp_path):
    from concurrent.futures import ThreadPoolExecutor

    both = ss.WithTransverse(PULSES, coherence=-0.5)
    whole = ss.run_ensemble(BLOCK, both, members=192, seed=1, threads=1)
    assert same_bits(ss.run_ensemble(BLOCK, both, members=192, seed=1, threads=2), whole)
    with ThreadPoolExecutor(2) as pool:
        assert same_bits(ss.run_ensemble(BLOCK, both, members=192, seed=1, executor=pool), whole)
        samples = list(pool.map(lambda i: both.sample(seed=1, member=i % 8), range(64)))
    assert all(samples[i] == samples[i % 8] for i in range(64))
    whole.save(tmp_path / "e.npz")
    assert ss.Ensemble.load(tmp_path / "e.npz") == whole
    means = ss.ensemble_sensitivity(BLOCK, both, "mu", members=20, seed=1)
    assert means == ss.ensemble_sensitivity(BLOCK, PULSES, "mu", members=20, seed=1)


def test_what_does_not_fit_is_rejected():
    for arguments, message in (
        ({"ratio": -1}, "ratio must be finite and at least 0, got -1"),
        ({"coherence": 1.5}, "coherence must be from -1 to 1, got 1.5"),
        ({"coherence": math.nan}, "coherence must be from -1 to 1"),
        ({"arrivals": "common"}, "common arrivals need the same PoissonPulses for both"),
        ({"arrivals": "random"}, "arrivals must be 'common' or 'independent', got 'random'"),
        ({"transverse": PULSES}, "both held values, got interpolation='linear' and 'const"),
    ):
        with pytest.raises(ValueError, match=message):
            ss.WithTransverse(SHAKING, **arguments)
    with pytest.raises(ValueError, match=r"must last as long as the horizontal one, 8 s, got 10 s"):
        ss.WithTransverse(SHAKING, ss.GaussianExcitation(BAND, dt=0.02, samples=501))
    for horizontal in (ss.WithTransverse(SHAKING), ss.HarmonicMotion(1, 2, 3), BLOCK):
        with pytest.raises(TypeError, match=r"horizontal must be a .*PoissonPulses or WithVert"):
            ss.WithTransverse(horizontal)
    with pytest.raises(TypeError, match=r"transverse must be a GaussianExcitation or Poisson"):
        ss.WithTransverse(SHAKING, ss.WithVertical(SHAKING))
    with pytest.raises(TypeError, match="compare: excitation must be"):
        ss.compare(BLOCK, ss.WithTransverse(SHAKING), members=10, seed=1)
