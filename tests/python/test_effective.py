"""Effective period and damping of the largest hysteresis loop, against closed forms."""

import math

import numpy as np
import pytest
import stickslip as ss
from stickslip import harmonic

LEVEL, WN = 0.5, 2.0
FLOOR = ss.Slider(ss.Coulomb(slip_level=LEVEL), WN)


def steady(slider, amplitude, omega, cycles=3):
    """A response on a periodic orbit from its first sample, and how many samples a cycle has."""
    (orbit,) = [o for o in harmonic.orbits(slider, amplitude, omega) if o.stable]
    samples = 4096
    motion = ss.HarmonicMotion(amplitude, omega, cycles * orbit.period, dt=orbit.period / samples)
    r = ss.integrate(slider, motion, displacement=orbit.displacement, velocity=orbit.velocity)
    assert r.peak == pytest.approx(orbit.amplitude, rel=1e-9)
    return r, samples


def area(r, samples):
    """Of the last cycle, by the trapezoidal rule in x."""
    x, f = r.displacement[-samples - 1 :], r.force[-samples - 1 :]
    return np.sum((f[1:] + f[:-1]) * np.diff(x)) / 2


@pytest.mark.parametrize("omega", [1.0, 3.0, 5.0])
def test_a_bilinear_loop_under_harmonic_motion_has_its_closed_form(omega):
    # Rigid-plastic with the hardening of the spring: k_eff = wn^2 + a / D, E_d = 4 a D
    r, samples = steady(FLOOR, 2.0, omega)
    d = r.peak
    stiffness = WN**2 + LEVEL / d
    assert r.effective_period == pytest.approx(2 * math.pi / math.sqrt(stiffness), rel=1e-12)
    damping = 4 * LEVEL * d / (2 * math.pi * stiffness * d**2)
    assert r.effective_damping == pytest.approx(damping, rel=1e-9)
    # and of the loop that was slid: h^2 of 4096 samples a cycle, a corner at either end of 2 D
    measured = area(r, samples) / (2 * math.pi * stiffness * d**2)
    assert r.effective_damping == pytest.approx(measured, rel=1e-3)


@pytest.mark.parametrize("omega", [1.0, 2.0, 3.0])
def test_a_linear_loop_has_the_damping_ratio_at_resonance(omega):
    # E_d = pi c omega D^2 and k_eff = wn^2: c omega / (2 wn^2), the ratio times omega / wn
    ratio = 0.2
    slider = ss.ViscousSlider(2 * ratio * WN, WN)
    ahead = WN**2 - omega**2 + 2j * ratio * WN * omega
    x = 1 / ahead  # of -n = cos(omega t): x = Re(x e^(i omega t))
    period = 2 * math.pi / omega
    motion = ss.HarmonicMotion(1, omega, 3 * period, dt=period / 64)
    r = ss.integrate(slider, motion, displacement=x.real, velocity=(1j * omega * x).real)
    assert r.effective_period == pytest.approx(math.pi, rel=1e-12)
    assert r.effective_damping == pytest.approx(ratio * omega / WN, rel=1e-9)


@pytest.mark.parametrize(
    "slider",
    [
        ss.Slider(ss.Coulomb(slip_level=LEVEL), WN, 0.3),
        ss.Slider(ss.Caster(slip_level=LEVEL, reach=0.4), WN, 0.3),
        ss.Slider(ss.VelocityDependent(slow=0.2, fast=0.5, rate=4), WN),
        ss.Slider(ss.VelocityDependent(slow=0.2, fast=0.5, rate=4), WN, 0.3),
    ],
    ids=repr,
)
def test_the_area_is_that_of_the_loop_in_a_steady_cycle(slider):
    omega, period = 1.5, 2 * math.pi / 1.5
    samples, cycles = 2048, 40  # a start at rest has died out but for exp(-0.1 * 160)
    motion = ss.HarmonicMotion(2, omega, cycles * period, dt=period / samples)
    end = ss.integrate(slider, motion)
    x, v = end.displacement[-1], end.velocity[-1]
    motion = ss.HarmonicMotion(2, omega, 2 * period, dt=period / samples)
    r = ss.integrate(slider, motion, displacement=x, velocity=v)
    assert [r.displacement[-1], r.velocity[-1]] == pytest.approx([x, v], abs=1e-6)
    stiffness = (2 * math.pi / r.effective_period) ** 2
    measured = area(r, samples) / (2 * math.pi * stiffness * r.peak**2)
    assert r.effective_damping == pytest.approx(measured, rel=1e-3)


def test_the_loop_does_not_know_forward_from_backward(record_a):
    for law in (
        ss.Caster(slip_level=LEVEL, reach=0.1),
        ss.VelocityDependent(slow=0.1, fast=0.5, rate=9),
    ):
        slider = ss.Slider(law, WN, 0.1)
        one, other = (ss.integrate(slider, ss.GroundMotion(s * record_a, dt=0.1)) for s in (1, -1))
        assert one.effective_period == other.effective_period
        assert one.effective_damping == other.effective_damping


def test_the_swing_after_the_ground_motion_counts():
    # a push of 0.1 s: the mass slides on and stops where friction and spring have taken its energy
    quake = ss.GroundMotion([-5, -5], dt=0.1)
    slider = ss.Slider(ss.Coulomb(slip_level=LEVEL), WN, 0.2)
    r = ss.integrate(slider, quake, settle=True)
    arrival = r.events[np.abs(r.events["displacement"]) == r.peak][0]["time"]
    assert arrival > 0.1
    d = r.peak
    stiffness = WN**2 + LEVEL / d
    # up to the peak, from rest: input = a D + damped + wn^2 D^2 / 2, the input being 5 m/s^2 x(0.1)
    spent = 5 * r.displacement[1] - WN**2 * d**2 / 2
    assert r.effective_damping == pytest.approx(
        4 * spent / (2 * math.pi * stiffness * d**2), rel=1e-10
    )


def test_without_a_loop_the_reason_is_named(record_a):
    quake = ss.GroundMotion(record_a, dt=0.1)
    still = ss.GroundMotion([0, 0], dt=0.1)
    for r, message in [
        (ss.integrate(FLOOR.law, quake), "needs a slider on a spring"),
        (ss.integrate(FLOOR, still), "never slips"),
        (ss.integrate(FLOOR, still, displacement=1), r"\|x\| is largest, 1 m, .* at the start"),
        (ss.integrate(FLOOR, still, displacement=1, settle=True), "at the start"),
        (ss.integrate(FLOOR, still, velocity=1), "is not over"),
    ]:
        for name in ("effective_period", "effective_damping"):
            with pytest.raises(ValueError, match=message):
                getattr(r, name)
    moving = ss.integrate(FLOOR, still, velocity=1, settle=True)
    assert moving.effective_period < math.pi
