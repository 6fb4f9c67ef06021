"""Equivalent linearization of structures, against an integration in physical coordinates."""

import math

import numpy as np
import pytest
import stickslip as ss
from numpy.typing import NDArray

integrate = pytest.importorskip("scipy.integrate")

S0, FREQUENCY, DAMPING = 0.02, 12.0, 0.6
SOIL = ss.Spectrum.kanai_tajimi(s0=S0, frequency=FREQUENCY, damping=DAMPING)
MASSES, STIFFNESSES, BETA = [1.0, 1.0, 0.8], [600.0, 500.0, 400.0], 0.004
BUILDING = ss.Structure.shear_building(
    masses=MASSES, stiffnesses=STIFFNESSES, damping=ss.Rayleigh(alpha=0.1, beta=BETA)
)
BASE, LEVEL, WN, DAMPER = 1.2, 0.4, 2.0, 0.1


def covariance(times: list[float], density: str) -> NDArray[np.float64]:
    """Variances of x and x' by time, from the equations of motion of the masses.

    The states are x, the displacements u of the floors relative to the base, their rates, and the
    two states of the filter, f'' + 2 z w f' + w^2 f = w, whose output is w^2 f + 2 z w f'.
    """
    floors = len(MASSES)
    mass = np.diag(MASSES)
    stiffness = np.zeros((floors, floors))
    for i, k in enumerate(STIFFNESSES):
        stiffness[i, i] += k
        if i > 0:
            stiffness[i - 1, i - 1] += k
            stiffness[i, i - 1] -= k
            stiffness[i - 1, i] -= k
    damping = 0.1 * mass + BETA * stiffness
    total = BASE + sum(MASSES)
    n = floors + 1
    # Coordinates (x, u): absolute displacement of floor i is x + u_i.
    whole_mass = np.block([[np.array([[total]]), np.array([MASSES])], [np.array([MASSES]).T, mass]])
    whole_stiffness, whole_damping = np.zeros((n, n)), np.zeros((n, n))
    whole_stiffness[1:, 1:], whole_stiffness[0, 0] = stiffness, total * WN**2
    whole_damping[1:, 1:], whole_damping[0, 0] = damping, total * DAMPER
    load = np.array([total, *MASSES])
    inverse = np.linalg.inv(whole_mass)

    def matrix(friction: float) -> NDArray[np.float64]:
        """With the friction -total friction x' on the base."""
        a = np.zeros((2 * n + 2, 2 * n + 2))
        a[:n, n : 2 * n] = np.eye(n)
        a[n : 2 * n, :n] = -inverse @ whole_stiffness
        a[n : 2 * n, n : 2 * n] = -inverse @ whole_damping
        a[n : 2 * n, n] -= inverse[:, 0] * total * friction
        output = [FREQUENCY**2, 2 * DAMPING * FREQUENCY]
        a[n : 2 * n, 2 * n :] = -np.outer(inverse @ load, output)
        a[2 * n, 2 * n + 1] = 1
        a[2 * n + 1, 2 * n :] = [-(FREQUENCY**2), -2 * DAMPING * FREQUENCY]
        return a

    noise = np.zeros((2 * n + 2, 2 * n + 2))
    noise[-1, -1] = 2 * math.pi * S0
    mean_over_rms = math.sqrt(2 / math.pi) if density == "gaussian" else math.sqrt(0.5)

    def slope(_: float, q: NDArray[np.float64]) -> NDArray[np.float64]:
        q = q.reshape(2 * n + 2, -1)
        # The least rms velocity is far below what occurs: the ground moves from the first moment.
        product = matrix(mean_over_rms * LEVEL / math.sqrt(max(q[n, n], 0) + 1e-14)) @ q
        return (product + product.T + noise).ravel()

    start = np.zeros((2 * n + 2, 2 * n + 2))
    start[-2, -2] = 2 * math.pi * S0 / (4 * DAMPING * FREQUENCY**3)
    start[-1, -1] = FREQUENCY**2 * start[-2, -2]
    found = integrate.solve_ivp(
        slope, (0, times[-1]), start.ravel(), "LSODA", times, rtol=1e-10, atol=1e-15
    )
    q = found.y.reshape(2 * n + 2, 2 * n + 2, -1)
    return np.array([q[0, 0], q[n, n]])


@pytest.mark.parametrize("density", ["gaussian", "laplace"])
def test_the_covariance_is_that_of_the_masses(density: str) -> None:
    times = [0.5, 1.0, 3.0, 8.0]
    slider = ss.Slider(ss.Coulomb(slip_level=LEVEL), natural_frequency=WN, damping=DAMPER)
    method = ss.theory.EquivalentLinearization(force=density)
    moments = method.predict(ss.IsolatedStructure(slider, BUILDING, base_mass=BASE), SOIL, times)
    expected = covariance(times, density)
    # Both tolerances are 1e-10 per step; the least velocities differ, too.
    np.testing.assert_allclose(moments.displacement_variance, expected[0], rtol=1e-6)
    np.testing.assert_allclose(moments.velocity_variance, expected[1], rtol=1e-6)


def test_the_methods_take_structures() -> None:
    method = ss.theory.EquivalentLinearization()
    slider = ss.Slider(ss.Coulomb(slip_level=LEVEL), natural_frequency=WN)
    isolated = ss.IsolatedStructure(slider, BUILDING, base_mass=BASE)
    rack = ss.EquipmentOnFloor(slider, BUILDING, floor=3, mass=0.1)
    for system in (isolated, rack):
        assert method.covers(system, SOIL)
        stationary = method.stationary(system, SOIL)
        late = method.predict(system, SOIL, [150.0])
        assert late.velocity_variance[0] == pytest.approx(stationary.velocity_variance[0], 1e-6)
    slope = ss.FlexibleSlope(ky_g=0.1, height=50, shear_velocity=600)
    assert not method.covers(slope, SOIL)
    with pytest.raises(TypeError, match="IsolatedStructure or an EquipmentOnFloor, got Flexible"):
        method.predict(slope, SOIL, [1.0])
    for other in ss.theory.THEORIES:
        assert isinstance(other.covers(isolated, SOIL), ss.theory.Coverage)
        if not other.name.startswith("EquivalentLinearization"):
            assert not other.covers(isolated, SOIL)


def test_compare_sets_the_theory_beside_an_ensemble() -> None:
    quake = ss.GaussianExcitation(SOIL, dt=0.02, samples=501)
    slider = ss.Slider(ss.Coulomb(slip_level=0.2), natural_frequency=WN)
    isolated = ss.IsolatedStructure(slider, BUILDING, base_mass=BASE)
    compared = ss.compare(isolated, quake, [4.0, 8.0], members=400, seed=1)
    assert set(compared.theories) >= {
        "EquivalentLinearization",
        "EquivalentLinearization, laplace",
    }
    for name in ("EquivalentLinearization", "EquivalentLinearization, laplace"):
        ratio, error = compared.ratio(name, "velocity_variance")
        assert (abs(ratio - 1) < 0.3 + 3 * error).all()
