"""Sliders under a ground of one frequency, and their exact orbits."""

import math
import subprocess
import sys

import numpy as np
import pytest
import stickslip as ss
from reference import tuples

INF, NAN = math.inf, math.nan
BLOCK = ss.Coulomb(slip_level=1.0)
CASTER = ss.Caster(slip_level=1.0, reach=1.0)


def cycles(B, omega, count, samples=64):
    period = 2 * math.pi / omega
    return ss.HarmonicMotion(B, omega, count * period, period / samples)


# ---- motions


def test_a_harmonic_motion_is_a_cosine_and_says_where_it_is_sampled():
    motion = ss.HarmonicMotion(2.0, omega=math.pi, duration=5.0)
    assert (motion.amplitude, motion.omega, motion.duration) == (2.0, math.pi, 5.0)
    assert (motion.period, motion.dt, len(motion)) == (2.0, 1 / 32, 161)
    assert motion.time[0] == 0 and motion.time[-1] == 5.0
    assert motion.acceleration == pytest.approx(-2 * np.cos(math.pi * motion.time), abs=1e-14)
    assert motion.peak_acceleration == 2.0
    assert motion.interpolation == "linear"
    assert motion != ss.HarmonicMotion(2.0, math.pi, 5.0, 0.1)
    lines = motion.sampled(0.1)
    assert isinstance(lines, ss.GroundMotion)
    assert lines.acceleration == pytest.approx(-2 * np.cos(math.pi * lines.time), abs=1e-14)


@pytest.mark.parametrize("bad", [0.0, -1.0, NAN, INF])
def test_a_harmonic_motion_refuses_what_is_none(bad):
    for arguments in ((bad, 1, 1), (1, bad, 1), (1, 1, bad), (1, 1, 1, bad)):
        with pytest.raises(ValueError, match="HarmonicMotion"):
            ss.HarmonicMotion(*arguments)


def test_integrate_takes_a_harmonic_motion():
    # From rest under 3 cos t against 1: v = 3 sin t - t until its first stop.
    motion = cycles(3.0, 1.0, 0.3)
    r = ss.integrate(BLOCK, motion)
    assert r.motion is motion
    assert r.time == pytest.approx(motion.time)
    assert r.velocity == pytest.approx(3 * np.sin(r.time) - r.time, abs=1e-14)
    assert len(r.displacement) == len(motion)


def test_a_harmonic_response_settles_and_draws_itself():
    pytest.importorskip("matplotlib")
    r = ss.integrate(BLOCK, cycles(3.0, 1.0, 2.2), settle=True)
    assert r.at_rest
    assert len(r.plot().axes) == 3


def test_integrate_refuses_what_is_no_motion():
    with pytest.raises(TypeError, match="GroundMotion or a HarmonicMotion, got list"):
        ss.integrate(BLOCK, [1.0, 2.0])


@pytest.mark.skipif(sys.platform == "win32", reason="sends SIGINT")
def test_ctrl_c_ends_a_long_harmonic_motion():
    script = """
import os, signal, threading
import stickslip as ss
try:
    threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    ss.integrate(ss.Slider(ss.Coulomb(slip_level=1.0), 1.0), ss.HarmonicMotion(1.5, 0.7, 1e9, 1e9))
except KeyboardInterrupt:
    print("interrupted")"""
    command = [sys.executable, "-c", script]
    output = subprocess.run(command, check=True, capture_output=True, text=True, timeout=60).stdout
    assert output.strip() == "interrupted"


# ---- orbits


@pytest.mark.parametrize("B, exact, stops", tuples("harmonic", "coulomb"))
def test_a_block_has_one_orbit(B, exact, stops):
    (orbit,) = ss.harmonic.orbits(BLOCK, B, omega=0.5)
    assert orbit.amplitude == pytest.approx(exact / 0.25, rel=2e-14)
    assert orbit.stops_per_cycle == (2 if stops else 0)
    assert stops == (math.sqrt(1 + math.pi**2 / 4) > B)
    assert orbit.stable and orbit.mean_arbitrary
    assert orbit.multipliers[0] == pytest.approx(1, abs=1e-14)
    if orbit.stops_per_cycle == 0:
        # ERRATA (2.14): sin(phase) = -pi a / 2 B
        assert math.sin(orbit.phase) == pytest.approx(-math.pi / 2 / B, rel=1e-13)


def test_a_caster_has_three_at_once():
    # values.json orbit.caster.w2_0.0.b1.0.W0.5.root0, harm.caster.b1.0.W0.5: the rest, one that is
    # unstable, and a large one
    rest, small, large = ss.harmonic.orbits(CASTER, 1.0, 0.5)
    assert rest.amplitude == 0 and math.isnan(rest.phase) and rest.stable
    assert small.amplitude == pytest.approx(1.7667411431890223, rel=1e-9)
    assert small.phase == pytest.approx(-1.9785151333297732, abs=1e-9)
    assert not small.stable
    product = np.prod(small.half_period_multipliers)
    assert product == pytest.approx(0.08843846552934587, abs=1e-8)
    assert small.half_period_multipliers[0] == pytest.approx(4.183099, abs=1e-6)
    assert large.amplitude == pytest.approx(3.3288206151731696, rel=1e-9)
    assert large.stable


def test_integrate_stays_on_an_orbit():
    slider = ss.Slider(BLOCK, 0.7)
    (orbit,) = ss.harmonic.orbits(slider, 1.5, 1.1)
    motion = ss.HarmonicMotion(orbit.B, orbit.omega, 3 * orbit.period)
    r = ss.integrate(slider, motion, displacement=orbit.displacement, velocity=orbit.velocity)
    x, v = orbit.histories(r.time)
    assert r.displacement == pytest.approx(x, abs=1e-12 * orbit.amplitude)
    assert r.velocity == pytest.approx(v, abs=1e-12 * orbit.amplitude)
    assert r.energy.dissipated == pytest.approx(3 * orbit.dissipated, rel=1e-12)
    assert r.energy.input == pytest.approx(r.energy.dissipated, rel=1e-12)
    assert r.peak == pytest.approx(orbit.amplitude, rel=1e-12)
    kinds = orbit.events["kind"].tolist()
    assert kinds.count("arrest") == orbit.stops_per_cycle


def test_an_orbit_has_neither_beginning_nor_end():
    _, orbit, _ = ss.harmonic.orbits(CASTER, 1.0, 0.5)
    t = np.linspace(-1e6, 1e6, 7)
    x, v = orbit.histories(t)
    later, slower = orbit.histories(t + orbit.period / 2)
    assert later == pytest.approx(-x, abs=1e-8)  # of 1e6 s, 1e-10 is rounded off
    assert slower == pytest.approx(-v, abs=1e-8)
    top, _ = orbit.histories([-orbit.phase / orbit.omega])
    assert top[0] == pytest.approx(orbit.amplitude, rel=1e-12)
    rest = ss.harmonic.orbits(CASTER, 1.0, 0.5)[0]
    assert not np.any(rest.histories(t))


def test_continuation_goes_round_the_fold():
    _, small, large = ss.harmonic.orbits(CASTER, 1.0, 0.5)
    branch = ss.harmonic.continuation(CASTER, large, 0.3, 2.0)
    (fold,) = branch.folds
    assert branch.omega.max() == branch.omega[fold]
    beside = np.abs(branch.omega / branch.omega[fold] - 1) > 1e-3
    assert np.array_equal(branch.stable[beside], branch.amplitude[beside] > branch.amplitude[fold])
    assert branch.half_period_multipliers[fold, 0] == pytest.approx(1, abs=1e-5)
    assert np.allclose(branch.multipliers, branch.half_period_multipliers**2, rtol=1e-14)
    assert branch.multipliers.shape == (len(branch), 2)
    assert branch[-1].amplitude == branch.amplitude[-1]
    assert branch.phase.shape == branch.stops_per_cycle.shape == branch.omega.shape
    with pytest.raises(IndexError):
        branch[len(branch)]
    # the unstable one is on it: between two of its orbits
    after = np.flatnonzero(branch.amplitude < branch.amplitude[fold])
    order = after[np.argsort(branch.omega[after])]
    between = np.interp(0.5, branch.omega[order], branch.amplitude[order])
    assert between == pytest.approx(small.amplitude, rel=1e-2)


def test_orbits_and_continuation_refuse_what_they_cannot_answer():
    for bad in (0.0, -1.0, NAN, INF):
        with pytest.raises(ValueError):
            ss.harmonic.orbits(BLOCK, bad, 1.0)
        with pytest.raises(ValueError):
            ss.harmonic.orbits(BLOCK, 2.0, bad)
    with pytest.raises(ValueError, match="drifts"):
        ss.harmonic.orbits(ss.Coulomb(slip_level=1.0, backward=2.0), 2.0, 1.0)
    (orbit,) = ss.harmonic.orbits(BLOCK, 2.0, 1.0)
    (rest,) = ss.harmonic.orbits(BLOCK, 0.5, 1.0)
    with pytest.raises(ValueError, match="must move"):
        ss.harmonic.continuation(BLOCK, rest, 0.5, 2.0)
    with pytest.raises(ValueError, match="low"):
        ss.harmonic.continuation(BLOCK, orbit, 1.5, 2.0)
    with pytest.raises(ValueError, match="finite"):
        orbit.histories([0.0, NAN])


def test_unequal_levels_on_a_spring_swing_about_another_place():
    slider = ss.Slider(ss.Coulomb(slip_level=1.0, backward=1.6), natural_frequency=0.7)
    (orbit,) = ss.harmonic.orbits(slider, 3.0, 1.0)
    assert orbit.center == pytest.approx(0.3 / 0.49, rel=1e-14)
    assert orbit.displacement == pytest.approx(-3.20727285142, rel=1e-11)  # by another program
    x, _ = orbit.histories([0.4, 0.4 + orbit.period / 2])
    assert x.mean() == pytest.approx(orbit.center, rel=1e-10)
    assert ss.theory.SlowlyVaryingParameters(slider).center == pytest.approx(orbit.center)
    with pytest.raises(ValueError, match="drifts"):
        ss.theory.SlowlyVaryingParameters(ss.Coulomb(slip_level=1.0, backward=1.6))
