"""The yield acceleration of a slope, against limit equilibrium."""

import math

import numpy as np
import pytest
import stickslip as ss


def limit_equilibrium(k, slope, friction, cohesion, weight, depth):
    """Resisting minus driving stress of an infinite slope under the horizontal acceleration k."""
    normal = weight * depth * (math.cos(slope) ** 2 - k * math.sin(slope) * math.cos(slope))
    shear = weight * depth * (math.sin(slope) * math.cos(slope) + k * math.cos(slope) ** 2)
    return cohesion + normal * math.tan(friction) - shear


@pytest.mark.parametrize(
    ("slope", "friction", "cohesion"), [(20, 32, 0), (35, 30, 12e3), (0, 25, 0), (5, 0, 40e3)]
)
def test_an_infinite_slope_is_in_limit_equilibrium(slope, friction, cohesion):
    soil = {"cohesion": cohesion, "unit_weight": 19e3, "depth": 3.0}
    ky = ss.yield_acceleration(slope_degrees=slope, friction_angle_degrees=friction, **soil)
    left = limit_equilibrium(ky, math.radians(slope), math.radians(friction), cohesion, 19e3, 3.0)
    assert abs(left) < 1e-12 * 19e3 * 3


def test_without_cohesion_it_is_that_of_a_block_on_a_slope():
    """A one-way block on the slope first moves at this horizontal acceleration."""
    ky = ss.yield_acceleration(slope_degrees=20, friction_angle_degrees=32)
    block = ss.Slider(ss.Coulomb(mu=math.tan(math.radians(32))), slope_degrees=20, one_way=True)
    for factor, moves in ((0.999, False), (1.001, True)):
        n = -factor * ky * ss.STANDARD_GRAVITY  # uphill
        quake = ss.GroundMotion([0, n, 0], dt=0.1)
        assert (ss.integrate(block, quake).peak > 0) == moves


def test_from_a_factor_of_safety():
    ky = ss.yield_acceleration(factor_of_safety=1.5, slope_degrees=15)
    assert ky == pytest.approx(0.5 * math.sin(math.radians(15)), rel=1e-15)
    assert isinstance(ky, float)
    assert ss.yield_acceleration(factor_of_safety=0.9, slope_degrees=15) < 0


def test_arguments_broadcast():
    ky = ss.yield_acceleration(
        slope_degrees=np.array([[10], [20], [30]]), factor_of_safety=[1.2, 1.5]
    )
    assert ky.shape == (3, 2)
    assert (np.diff(ky, axis=1) > 0).all()


def test_a_random_strength_makes_a_law_for_each_member():
    strength = ss.Random(
        ss.yield_acceleration,
        slope_degrees=20,
        friction_angle_degrees=ss.Normal(32, 2, low=25),
    )
    slopes = ss.Random(ss.Coulomb, mu=strength, backward=math.inf)
    levels = [slopes.sample(seed=1, member=i).slip_level for i in range(400)]
    assert len(set(levels)) == 400
    median = math.tan(math.radians(12)) * ss.STANDARD_GRAVITY
    # 400 members: the median is off by 1.25 sigma / 20, and five of these in one of 2 million runs
    assert np.median(levels) == pytest.approx(median, abs=5 * 1.25 * 0.37 / 20)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({}, "needs either factor_of_safety or friction_angle_degrees, got neither"),
        ({"factor_of_safety": 2, "friction_angle_degrees": 30}, "got both"),
        ({"factor_of_safety": 2, "depth": 3}, "depth belongs to friction_angle_degrees"),
        ({"friction_angle_degrees": 30, "cohesion": 5e3, "depth": 2}, "cohesion needs unit_weight"),
    ],
)
def test_arguments_that_do_not_belong_together_are_named(given, words):
    with pytest.raises(TypeError, match=words):
        ss.yield_acceleration(slope_degrees=20, **given)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"slope_degrees": 0, "factor_of_safety": 2}, "slope_degrees must be above 0 and below 90"),
        ({"slope_degrees": 90, "friction_angle_degrees": 30}, "slope_degrees must be at least 0"),
        ({"slope_degrees": 20, "factor_of_safety": [1.2, math.nan]}, "factor_of_safety.*got nan"),
        ({"slope_degrees": 20, "friction_angle_degrees": -1}, "friction_angle_degrees.*got -1"),
    ],
)
def test_a_value_out_of_range_is_named(given, words):
    with pytest.raises(ValueError, match=words):
        ss.yield_acceleration(**given)
