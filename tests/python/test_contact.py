"""Vertical motion, slopes, stops, static friction: what Python gives of them."""

import copy
import math

import numpy as np
import pytest
import stickslip as ss

G = ss.STANDARD_GRAVITY
M = np.arange(401)
RECORD = 2 * np.sin(0.7 * M) + 1.3 * np.cos(1.9 * M + 0.4)
UPWARD = 2.5 * np.cos(0.5 * M + 0.2)


def shaken(factor=1.0):
    return ss.GroundMotion(RECORD, dt=0.1, vertical=factor * UPWARD)


def kinds(r):
    return [str(kind) for kind in r.events["kind"]]


def test_vertical_motion_acts_and_is_named():
    r = ss.integrate(ss.Coulomb(mu=0.1), shaken())
    # next_values.json A.coulomb; sines in doubles are off by 3e-14 of the record.
    assert r.residual == pytest.approx(0.4589314970216282703420498, abs=1e-11)
    assert r.components == "axis + vertical"
    assert r.contact == "flight"
    np.testing.assert_allclose(r.normal_force, G + UPWARD, rtol=1e-15)
    assert not r.gap.any()
    alone = ss.integrate(ss.Coulomb(mu=0.1), ss.GroundMotion(RECORD, dt=0.1))
    assert alone.components == "axis"
    assert (alone.normal_force == G).all()


def test_flight_and_clipped_differ_and_say_so():
    flight = ss.integrate(ss.Coulomb(mu=0.1), shaken(5))
    clipped = ss.integrate(ss.Coulomb(mu=0.1), shaken(5), contact="clipped")
    assert flight.residual == pytest.approx(0.1402816363826218557289617, abs=1e-11)
    assert clipped.residual == pytest.approx(0.2212850487541797984090716, abs=1e-11)
    assert (flight.contact, clipped.contact) == ("flight", "clipped")
    assert kinds(flight).count("liftoff") == kinds(flight).count("landing") == 32
    assert "liftoff" not in kinds(clipped)
    assert flight.gap.max() > 0.08
    assert not clipped.gap.any()
    assert (flight.normal_force[flight.gap > 0] == 0).all()
    np.testing.assert_allclose(clipped.normal_force, np.maximum(G + 5 * UPWARD, 0), rtol=1e-15)
    with pytest.raises(ValueError, match="contact must be 'flight' or 'clipped', got 'bounce'"):
        ss.integrate(ss.Coulomb(mu=0.1), shaken(), contact="bounce")


def test_forces_balance_under_vertical_motion():
    slider = ss.Slider(ss.Coulomb(mu=0.3), natural_frequency=3, damping=0.5, slope_degrees=8)
    r = ss.integrate(slider, shaken(2))
    slope = math.radians(8)
    up = 2 * UPWARD
    np.testing.assert_allclose(
        r.normal_force, (G + up) * math.cos(slope) + RECORD * math.sin(slope), rtol=1e-13
    )
    held = r.stuck
    load = (G + up) * math.sin(slope) - RECORD * math.cos(slope)
    np.testing.assert_allclose(r.force[held], load[held], atol=1e-12)
    sliding = ~held & (r.velocity != 0)
    np.testing.assert_allclose(
        r.friction[sliding], (np.sign(r.velocity) * 0.3 * r.normal_force)[sliding], rtol=1e-13
    )
    # The absolute acceleration along the slope: x'' + n cos - a_z sin.
    np.testing.assert_allclose(r.acceleration, G * math.sin(slope) - r.force, atol=1e-12)


def test_slopes_take_both_components():
    law = ss.Coulomb(mu=0.45)
    two = ss.integrate(ss.Slider(law, slope_degrees=20), shaken())
    one = ss.integrate(ss.Slider(law, slope_degrees=20, one_way=True), shaken())
    # next_values.json A.slope20.*
    assert one.residual == pytest.approx(4.528594329845685172766155, abs=1e-11)
    assert two.residual == one.residual  # at 20 degrees it never goes back
    with pytest.raises(ValueError, match="slides under its own weight unless mu is"):
        ss.Slider(ss.Coulomb(mu=0.1), slope_degrees=20)
    with pytest.raises(ValueError, match="slope_degrees must be from 0 to less than 90, got 90"):
        ss.Slider(law, slope_degrees=90)


def test_impacts_are_listed():
    slider = ss.Slider(ss.Coulomb(slip_level=0.5), stops=ss.Stops(gap=0.1, restitution=0.7))
    press = ss.GroundMotion([-2, -2], dt=3, interpolation="constant")
    r = ss.integrate(slider, press)
    # next_values.json E.zeno
    assert r.impacts["time"][0] == pytest.approx(0.3651483716701107, abs=1e-15)
    assert r.impacts["velocity"][0] == pytest.approx(0.5477225575051661, abs=1e-15)
    assert r.events["time"][-2] == pytest.approx(1.132657711007547520926875, abs=1e-13)
    assert (r.impacts["kind"] == "impact").all()
    assert r.residual == r.peak == 0.1
    assert r.at_rest
    assert r.energy.impact > 0
    assert r.energy.imbalance == pytest.approx(0, abs=1e-14)
    assert len(ss.integrate(ss.Coulomb(mu=0.1), shaken()).impacts) == 0


def test_one_sided_stops():
    stops = ss.Stops(gap=math.inf, restitution=0.5, backward=0.03)
    r = ss.integrate(ss.Slider(ss.Coulomb(slip_level=0.5), stops=stops), shaken())
    assert r.displacement.min() >= -0.03
    assert len(r.impacts) > 0
    assert (r.impacts["displacement"] == -0.03).all()


def test_friction_pendulum_is_a_slider():
    radius = 2.2
    slider = ss.FrictionPendulum(radius=radius, mu_slow=0.03, mu_fast=0.06, rate=50)
    assert slider == ss.Slider(
        ss.VelocityDependent(mu_slow=0.03, mu_fast=0.06, rate=50),
        natural_frequency=math.sqrt(G / radius),
        pendulum=True,
    )
    plain = ss.Slider(slider.law, natural_frequency=math.sqrt(G / radius))
    level = ss.GroundMotion(RECORD, dt=0.1)
    np.testing.assert_allclose(
        ss.integrate(slider, level).displacement,
        ss.integrate(plain, level).displacement,
        atol=1e-12,
    )
    r = ss.integrate(slider, shaken())
    assert r.remark == ""
    np.testing.assert_allclose(r.spring, r.displacement * r.normal_force / radius, rtol=1e-13)
    assert abs(r.energy.imbalance) < 1e-12
    far = ss.integrate(ss.FrictionPendulum(radius=0.2, mu=0.02), shaken())
    assert far.peak > 0.2 * 0.2
    assert "beyond 0.2 of the radius of 0.2" in far.remark
    assert ss.FrictionPendulum(radius=1, law=ss.Coulomb(mu=0.1)).law == ss.Coulomb(mu=0.1)
    for wrong in ({}, {"mu": 0.1, "rate": 3}, {"mu_slow": 0.1, "mu_fast": 0.2}):
        with pytest.raises(ValueError, match="give mu, or mu_slow, mu_fast and rate, or law"):
            ss.FrictionPendulum(radius=1, **wrong)
    with pytest.raises(ValueError, match="radius must be positive and finite, got 0 m"):
        ss.FrictionPendulum(radius=0, mu=0.1)


def test_static_friction():
    law = ss.StaticKinetic(static=1.3, kinetic=1)
    r = ss.integrate(law, ss.GroundMotion(RECORD, dt=0.1))
    # next_values.json B.as1.3.ak1: 30 breakaways, 29 arrests, 59 reversals
    assert (kinds(r).count("breakaway"), kinds(r).count("arrest"), kinds(r).count("reversal")) == (
        30,
        29,
        59,
    )
    assert ss.StaticKinetic(mu_static=0.5, mu_kinetic=0.35) == ss.StaticKinetic(
        ss.Coulomb(mu=0.35), mu_static=0.5
    )
    pair = ss.StaticKinetic(static=(1.2, 1.9), kinetic=(0.9, 1.5))
    assert (pair.static, pair.static_backward) == (1.2, 1.9)
    assert pair.sliding == ss.Coulomb(slip_level=0.9, backward=1.5)
    slider = ss.Slider(pair, 2)
    assert slider.hold() == 1.2
    assert slider.hold(backward=True) == 1.9
    assert slider.resist() == 0.9
    assert slider.law == pair
    for arguments, message in (
        ({"static": 0.5, "kinetic": 1}, "at least the kinetic one of 1 m/s"),
        ({"kinetic": 1}, "give either mu_static or static, got neither"),
        ({"static": 1, "mu_static": 1, "kinetic": 1}, "got both"),
        ({"static": 1}, "give either mu_kinetic or kinetic, got neither"),
        ({"sliding": ss.Coulomb(mu=0.1), "static": 2, "kinetic": 1}, "got both"),
    ):
        with pytest.raises(ValueError, match=message):
            ss.StaticKinetic(**arguments)
    with pytest.raises(TypeError, match="give mu_static= or static="):
        ss.StaticKinetic("rubber", static=1)


def test_stribeck():
    r = ss.integrate(
        ss.Slider(ss.Stribeck(static=1.3, kinetic=0.8, velocity=0.1, exponent=2), 4),
        ss.GroundMotion(RECORD, dt=0.1),
    )
    # next_values.json C.stribeck2.spring4
    assert r.residual == pytest.approx(-0.04471007939987986611931486, abs=1e-11)
    with pytest.raises(ValueError, match="exponent must be a whole number from 1 to 31, got 0"):
        ss.Stribeck(static=1, kinetic=0.5, velocity=0.1, exponent=0)
    with pytest.raises(TypeError, match="give mu_static= and mu_kinetic="):
        ss.Stribeck(1, 0.5, 0.1, 2)


SLIDERS = [
    ss.Slider(ss.Coulomb(mu=0.3), slope_degrees=5, one_way=True),
    ss.Slider(ss.Coulomb(mu=0.3), 2, 0.1, stops=ss.Stops(gap=0.2, restitution=0.5, backward=0.1)),
    ss.Slider(ss.StaticKinetic(ss.Caster(mu=0.1, reach=0.2), mu_static=0.2)),
    ss.Slider(ss.StaticKinetic(static=(2, 3), kinetic=1)),
    ss.Slider(ss.Stribeck(mu_static=0.13, mu_kinetic=0.08, velocity=0.1, exponent=2)),
    ss.FrictionPendulum(radius=2, mu=0.05, stops=ss.Stops(gap=0.4, restitution=0.2)),
    ss.Slider(ss.Degrading(distance=[0, 0.5], mu=[0.3, 0.1]), slope_degrees=5, one_way=True),
    ss.Slider(ss.StaticKinetic(ss.Degrading(distance=[0, 1], mu=[0.1, 0.05]), mu_static=0.2), 2),
]


@pytest.mark.parametrize("slider", SLIDERS, ids=repr)
def test_ensembles_move_as_integrate_does(slider):
    motion = ss.GroundMotion(RECORD, dt=0.1, vertical=4 * UPWARD)
    for contact in ("flight", "clipped"):
        r = ss.integrate(slider, motion, contact=contact)
        e = ss.run_ensemble(slider, [motion], members=2, seed=1, contact=contact)
        assert e.residual == pytest.approx([r.residual] * 2, rel=1e-13)
        assert e.peak == pytest.approx([r.peak] * 2, rel=1e-13)
        assert e.displacement_mean == pytest.approx(r.displacement, abs=1e-12 * r.peak)


def test_ensembles_know_what_they_are_of():
    motion = shaken(4)
    runs = {
        (repr(slider), contact): ss.run_ensemble(
            slider, [motion], members=1, seed=1, contact=contact
        )
        for slider in SLIDERS[:2]
        for contact in ("flight", "clipped")
    }
    first = next(iter(runs.values()))
    for name, run in runs.items():
        if run is first:
            continue
        with pytest.raises(ValueError, match="merge"):
            copy.deepcopy(first).merge(run), name


def test_random_excitations_move_them_too():
    noise = ss.GaussianExcitation(ss.Spectrum.white(s0=0.05), dt=0.02, samples=512)
    for slider in SLIDERS:
        e = ss.run_ensemble(slider, noise, members=3, seed=5)
        for member in range(3):
            r = ss.integrate(slider, noise.sample(seed=5, member=member))
            assert e.residual[member] == pytest.approx(r.residual, abs=1e-9 * r.peak + 1e-300)


def test_a_time_loop_of_ones_own():
    motion = shaken(5)
    n, up = motion.acceleration, motion.vertical
    for slider in (ss.Coulomb(mu=0.1), SLIDERS[1], SLIDERS[5]):
        r = ss.integrate(slider, motion)
        state = ss.State()
        for i in range(400):
            state = ss.advance(
                slider, state, 0.1, n[i], n[i + 1], vertical_start=up[i], vertical_end=up[i + 1]
            )
            assert state.displacement == pytest.approx(r.displacement[i + 1], abs=1e-12 * r.peak)
            assert state.gap == pytest.approx(r.gap[i + 1], abs=1e-12)
    with pytest.raises(ValueError, match="dt must be finite and at least 0, got -1 s"):
        ss.advance(ss.Coulomb(mu=0.1), ss.State(), -1, 0)
    with pytest.raises(ValueError, match="must be finite"):
        ss.advance(ss.Coulomb(mu=0.1), ss.State(), 1, math.nan)
    with pytest.raises(TypeError, match="slider must be a Slider or a friction law, got str"):
        ss.advance("block", ss.State(), 1, 0)
    with pytest.raises(ValueError, match=r"between the stops, from -0\.1 to 0\.2 m, got 0\.3 m"):
        ss.advance(SLIDERS[1], ss.State(0.3), 1, 0)


def test_theories_refuse_what_they_do_not_cover():
    noise = ss.Spectrum.white(s0=0.05)
    theory = ss.theory.EquivalentLinearization()
    for slider in SLIDERS:
        coverage = theory.covers(slider, noise)
        assert not coverage
        with pytest.raises(ValueError, match=r"not covered|does not cover|covers"):
            theory.predict(slider, noise, [1])
        with pytest.raises(ValueError, match=r"not covered|does not cover|covers"):
            ss.harmonic.orbits(slider, 4, 1)
    with pytest.raises(ValueError, match="level ground"):
        ss.integrate(SLIDERS[0], ss.HarmonicMotion(1, 1, duration=10, dt=0.1))


def test_free_fall_is_refused():
    with pytest.raises(ValueError, match="never lands"):
        ss.integrate(ss.Coulomb(mu=0.1), ss.GroundMotion([0, 1, 0], dt=0.1, vertical=[0, -10, -10]))


# ---- margins and sensitivities


def test_sensitivities_are_differences_in_the_limit():
    """With respect to each parameter that Python names, by central differences at two steps."""
    record = shaken()

    def slider(static=1.2, kinetic=1.0, wn=3.0, c=0.4, slope=5.0):
        law = ss.StaticKinetic(static=static, kinetic=kinetic)
        return ss.Slider(law, natural_frequency=wn, damping=c, slope_degrees=slope)

    changed = {
        "slip_level": (1e-5, lambda d: (slider(1.2 + d, 1 + d), record)),
        "static": (1e-5, lambda d: (slider(static=1.2 + d), record)),
        "kinetic": (1e-5, lambda d: (slider(kinetic=1 + d), record)),
        "natural_frequency": (1e-5, lambda d: (slider(wn=3 + d), record)),
        "damping": (1e-5, lambda d: (slider(c=0.4 + d), record)),
        "slope_degrees": (1e-5, lambda d: (slider(slope=5 + d), record)),
        "scale": (1e-5, lambda d: (slider(), record.scaled(1 + d))),
    }
    r = ss.integrate(slider(), record)
    for name, (h, change) in changed.items():

        def difference(h, of, change=change):
            above, below = (getattr(ss.integrate(*change(d)), of) for d in (h, -h))
            return (above - below) / (2 * h)

        found = r.sensitivity(name)
        for of in ("peak", "residual"):
            near, far = difference(h / 2, of), difference(h, of)
            allowed = abs(far - near) + 1e-12 * r.peak / h  # truncation; round-off
            assert getattr(found, of) == pytest.approx(near, abs=allowed), (name, of)


def test_what_has_no_sensitivity_is_refused_with_the_reason():
    record = ss.GroundMotion(RECORD, dt=0.1)
    refused = {
        "covers Coulomb friction": (ss.Caster(mu=0.1, reach=0.5), record, "mu"),
        "has one level for sliding and rest": (ss.Coulomb(mu=0.1), record, "mu_static"),
        "without a spring": (ss.Coulomb(mu=0.1), record, "natural_frequency"),
        "must not leave the ground": (ss.Coulomb(mu=0.1), shaken(5), "mu"),
        r"motion.sampled\(dt\)": (ss.Coulomb(mu=0.1), ss.HarmonicMotion(2, 3, 4), "mu"),
        "must be one of 'mu', .*, got 'color'": (ss.Coulomb(mu=0.1), record, "color"),
    }
    for reason, (slider, motion, parameter) in refused.items():
        with pytest.raises(ValueError, match=reason):
            ss.integrate(slider, motion).sensitivity(parameter)
