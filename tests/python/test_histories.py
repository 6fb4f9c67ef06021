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


def test_histories_of_blocks_and_carts_are_those_of_integrate():
    rng = np.random.default_rng(1)
    n, t = rng.normal(0, 3, (2, 400))
    motion = ss.GroundMotion(n, dt=0.05, transverse=t)
    for block in (
        ss.SlenderBlock(p=2, alpha=0.3, restitution=0.8),
        ss.RockingBlock(width=0.6, height=1.5, mu=0.6),
    ):
        response = ss.integrate(block, motion)
        rotation, rate = ss.histories(block, motion)
        assert response.impacts > 5
        assert np.array_equal(rotation, response.rotation)
        assert np.array_equal(rate, response.rate)
    feet = [
        ss.Foot(at=at, mu=mu)
        for at, mu in [((0.5, 0.3), 0.1), ((-0.5, 0.3), 0.2), ((0, -0.6), 0.3)]
    ]
    cart = ss.Cart(supports=feet, radius_of_gyration=0.4)
    response = ss.integrate(cart, motion)
    place, rate = ss.histories(cart, motion)
    assert place.shape == rate.shape == (400, 3)
    assert np.abs(response.yaw).max() > 1e-3
    assert np.array_equal(place[:, :2], response.displacement)
    assert np.array_equal(place[:, 2], response.yaw)
    assert np.array_equal(rate[:, :2], response.velocity)
    assert np.array_equal(rate[:, 2], response.yaw_rate)
    with pytest.raises(TypeError, match="histories: the motion of a block"):
        ss.histories(block, [1.0, 2.0])


def test_a_motion_is_asked_for():
    with pytest.raises(TypeError, match="histories: motion must be a GroundMotion, got list"):
        ss.histories(ss.Coulomb(mu=0.1), [1.0, 2.0])
