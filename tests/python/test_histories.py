import numpy as np
import pytest
import stickslip as ss


def shaking(samples: int) -> ss.GroundMotion:
    return ss.GroundMotion(np.random.default_rng(samples).normal(0, 2, samples), dt=0.1)


@pytest.mark.parametrize("samples", [2, 1000, 20_000])
@pytest.mark.parametrize(
    "slider",
    [ss.Coulomb(slip_level=1), ss.Slider(ss.Coulomb(slip_level=1), 2.0)],
    ids=["free", "spring"],
)
def test_histories_are_those_of_integrate(slider, samples):
    motion = shaking(samples)
    response = ss.integrate(slider, motion)
    x, v = ss.histories(slider, motion)
    assert x.shape == v.shape == (samples,)
    # Round-off adds up over the samples like a random walk.
    room = 20 * np.finfo(float).eps * np.sqrt(samples)
    assert np.abs(x - response.displacement).max() <= room * (1e-300 + np.abs(x).max())
    assert np.abs(v - response.velocity).max() <= room * (1e-300 + np.abs(v).max())


def test_the_arrays_outlive_everything_and_are_read_only():
    x, v = ss.histories(ss.Coulomb(slip_level=1), shaking(9000))
    assert x[-1] == ss.histories(ss.Coulomb(slip_level=1), shaking(9000))[0][-1]
    for array in (x, v):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1


def test_a_motion_is_asked_for():
    with pytest.raises(TypeError, match="histories: motion must be a GroundMotion, got list"):
        ss.histories(ss.Coulomb(mu=0.1), [1.0, 2.0])
