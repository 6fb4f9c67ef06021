"""Arguments in a likely wrong unit warn, usual ones never do; slips of g for m/s^2 are remarked."""

import warnings

import numpy as np
import pytest
import stickslip as ss
from stickslip import cli

G = ss.STANDARD_GRAVITY
KUMAR = {"mu_ref": 0.06, "reference_pressure": 50e6, "contact_radius": 0.2}


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: ss.Coulomb(mu=20), r"Coulomb: mu = 20 .* percent, give mu=0\.2$"),
        (lambda: ss.Coulomb(mu=0.2, mu_backward=30), r"mu_backward = 30 .* mu_backward=0\.3"),
        (lambda: ss.Caster(mu=5, reach=1), r"Caster: mu = 5 .* mu=0\.05"),
        (
            lambda: ss.StaticKinetic(mu_static=50, mu_kinetic=0.3),
            r"mu_static = 50 .* mu_static=0\.5",
        ),
        (
            lambda: ss.Stribeck(mu_static=30, mu_kinetic=0.2, velocity=0.1, exponent=2),
            r"Stribeck: mu_static = 30 .* mu_static=0\.3",
        ),
        (lambda: ss.Degrading(distance=[0, 1], mu=[30, 20]), r"Degrading: mu = 30 .* mu=0\.3"),
        (lambda: ss.FrictionPendulum(radius=2, mu=4), r"FrictionPendulum: mu = 4 .* mu=0\.04"),
        (
            lambda: ss.VelocityDependent(mu_slow=0.03, mu_fast=0.06, rate=0.5),
            r"rate = 0\.5 s/m .* in s/cm, give rate=50",
        ),
        (
            lambda: ss.FrictionPendulum(radius=2, mu_slow=0.03, mu_fast=0.06, rate=0.05),
            r"rate = 0\.05 s/m .* in s/mm, give rate=50",
        ),
        (
            lambda: ss.KumarFriction(static_pressure=50, **KUMAR),
            r"static_pressure = 50 Pa .* in MPa, give static_pressure=5e\+07",
        ),
        (
            lambda: ss.KumarFriction(static_pressure=50e3, **KUMAR),
            r"static_pressure = 5e\+04 Pa .* in kPa, give static_pressure=5e\+07",
        ),
        (
            lambda: ss.KumarFriction(static_pressure=50e6, **{**KUMAR, "mu_ref": 6}),
            r"mu_ref = 6 .* mu_ref=0\.06",
        ),
        (
            lambda: ss.Slider(ss.Coulomb(mu=0.6), slope_degrees=0.35),
            r"slope_degrees = 0\.35 .* radians, give slope_degrees=20\.05",
        ),
        (
            lambda: ss.FlexibleSlope(ky_g=10, height=50, shear_velocity=600),
            r"FlexibleSlope: ky_g = 10 .* percent of g, give ky_g=0\.1$",
        ),
        (
            lambda: ss.FlexibleSlope(ky_g=0.1, height=5, shear_velocity=600, damping_ratio=5),
            r"FlexibleSlope: damping_ratio = 5 .* percent, give damping_ratio=0\.05$",
        ),
        (
            lambda: ss.Structure.shear_building(masses=[1], stiffnesses=[1], damping_ratio=3),
            r"shear_building: damping_ratio = 3 .* percent, give damping_ratio=0\.03$",
        ),
        (
            lambda: ss.Structure.from_modes(
                mass_fractions=[0.2, 0.1], frequencies=[1, 2], damping_ratios=[0.05, 5]
            ),
            r"from_modes: damping_ratios\[1\] = 5 .* percent, give damping_ratios\[1\]=0\.05$",
        ),
    ],
)
def test_a_value_in_another_unit_warns_with_the_one_that_may_be_meant(make, message):
    with pytest.warns(ss.PlausibilityWarning, match=message) as caught:
        make()
    assert caught[0].filename == __file__


def test_values_in_use_never_warn():
    """The suite turns warnings into errors; these are the ranges of the field."""
    for mu in (0, 0.001, 0.02, 0.06, 0.3, 0.8, 1.2, 2.5, 1000):
        ss.Coulomb(mu=mu)
        ss.Caster(mu=mu, reach=0.1)
        ss.FrictionPendulum(radius=2, mu=mu)
    for rate in (0, 12, 20, 30.3, 50, 100, 300):
        ss.VelocityDependent(mu_slow=0.03, mu_fast=0.06, rate=rate)
    for pressure in (1e6, 5e6, 13.8e6, 50e6, 100e6):
        ss.KumarFriction(static_pressure=pressure, **{**KUMAR, "reference_pressure": pressure})
    for degrees in (0, 1, 2.5, 10, 35, 60):
        ss.Slider(ss.Coulomb(mu=2), slope_degrees=degrees)
    for ratio in (0, 0.02, 0.3, 0.9):
        ss.Structure.shear_building(masses=[1], stiffnesses=[1], damping_ratio=ratio)
        ss.FlexibleSlope(ky_g=ratio, height=50, shear_velocity=600, damping_ratio=ratio)
    for level in (0.01, 2, 20, 500):  # levels are in m/s^2
        ss.Coulomb(slip_level=level)


def test_laws_tell_their_coefficients():
    assert ss.Coulomb(mu=0.3).mu == 0.3
    assert ss.Coulomb(mu=0.3, mu_backward=0.7).mu_backward == 0.7
    assert ss.Coulomb(slip_level=G).mu == 1
    assert ss.Coulomb(mu=0.1, backward=float("inf")).mu_backward == float("inf")
    assert ss.Caster(mu=0.05, reach=1).mu == 0.05
    assert ss.VelocityDependent(mu_slow=0.03, mu_fast=0.06, rate=50).mu_fast == 0.06
    stribeck = ss.Stribeck(mu_static=0.13, mu_kinetic=0.08, velocity=0.1, exponent=2.0)
    assert (stribeck.mu_static, stribeck.mu_kinetic, stribeck.exponent) == (0.13, 0.08, 2)
    assert ss.StaticKinetic(mu_static=0.5, mu_kinetic=0.35).mu_static == 0.5
    assert ss.Degrading(distance=[0, 1], mu=[0.3, 0.2]).mu.tolist() == [0.3, 0.2]
    rng = np.random.default_rng(1)
    for mu in rng.uniform(0, 2, 200):
        law = ss.Coulomb(mu=mu)
        assert ss.Coulomb(mu=law.mu) == law


def test_an_exponent_must_be_whole():
    with pytest.raises(ValueError, match=r"exponent must be a whole number from 1 to 31, got 2\.5"):
        ss.Stribeck(mu_static=0.13, mu_kinetic=0.08, velocity=0.1, exponent=2.5)


def test_a_pendulum_is_made_and_shown_by_its_radius_or_period():
    bearing = ss.FrictionPendulum(radius=2.2, mu=0.04)
    assert repr(bearing) == "FrictionPendulum(radius=2.2, mu=0.04)"
    assert bearing.radius == 2.2
    by_period = ss.FrictionPendulum(period=3, mu=0.04)
    assert repr(by_period) == "FrictionPendulum(period=3, mu=0.04)"
    assert by_period.radius == pytest.approx(G * (3 / (2 * np.pi)) ** 2, rel=1e-15)
    assert by_period.period == pytest.approx(3, rel=1e-15)
    assert ss.Slider(ss.Coulomb(mu=0.04), period=3).radius is None
    for wrong in ({}, {"radius": 2, "period": 3}):
        with pytest.raises(ValueError, match=r"give radius or period, got (neither|both)"):
            ss.FrictionPendulum(mu=0.04, **wrong)
    with pytest.raises(ValueError, match="period must be positive"):
        ss.FrictionPendulum(mu=0.04, period=0)
    liner = ss.VelocityDependent(mu_slow=0.03, mu_fast=0.06, rate=50)
    rng = np.random.default_rng(2)
    for radius in (*rng.uniform(0.3, 9, 50), 2.2, 1 / 3):
        for law in (ss.Coulomb(mu=0.04), liner):
            stops = ss.Stops(gap=0.3, restitution=0.2)
            one = ss.FrictionPendulum(radius=radius, law=law, stops=stops, damping=0.1)
            assert eval(repr(one), vars(ss)) == one


# A record in g, taken for m/s^2: 0.35 g at most.
IN_G = np.sin(np.pi * np.arange(401) / 400) ** 2 * 0.35 * np.sin(0.7 * np.arange(401))
SLIPPED = ss.GroundMotion(IN_G, dt=0.02, name="Test")


def test_a_slip_of_g_is_remarked_where_nothing_slips():
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # the constructor cannot know
        quake = ss.GroundMotion(IN_G, dt=0.02)
    r = ss.integrate(ss.Coulomb(mu=0.2), quake)
    peak = quake.peak_acceleration
    assert r.remark == (
        f"nothing slips: the peak ground acceleration is {peak:.4g} m/s^2 ({peak / G:.4g} g); if"
        f' the accelerations are in g, give units="g": at {peak:.4g} g it slips'
    )
    assert r.remark in repr(r)
    assert "units=&quot;g&quot;" in r._repr_html_()
    right = ss.integrate(ss.Coulomb(mu=0.2), ss.GroundMotion(IN_G, dt=0.02, units="g"))
    assert right.time_sliding > 0
    assert right.remark == ""
    # not where it would not slip either, nor where numbers in g would be beyond any record
    assert ss.integrate(ss.Coulomb(mu=0.5), quake).remark == ""
    assert ss.integrate(ss.Coulomb(mu=2), 15 * quake).remark == ""
    still = ss.GroundMotion(np.zeros(200), dt=0.02)
    assert ss.integrate(ss.Coulomb(mu=0.2), still).remark == ""
    for slider, slips in (
        (ss.Slider(ss.Coulomb(mu=0.4), slope_degrees=10), True),
        (ss.Slider(ss.Coulomb(mu=0.6), slope_degrees=10), False),
        (ss.FrictionPendulum(radius=2, mu=0.2), True),
        (ss.Slider(ss.Coulomb(mu=0.2), 2, stops=ss.Stops(gap=0.1, restitution=0)), True),
    ):
        assert bool(ss.integrate(slider, quake).remark) is slips


def test_a_sweep_and_an_ensemble_warn_once():
    weak = [0.5 * SLIPPED, SLIPPED]
    with pytest.warns(ss.PlausibilityWarning, match='sweep: nothing slips.* units="g"') as caught:
        ss.sweep([ss.Coulomb(mu=0.2), ss.Coulomb(mu=0.3)], weak)
    assert [one.filename for one in caught] == [__file__]
    random = ss.Random(ss.Coulomb, mu=ss.Uniform(0.2, 0.3))
    for sliders in (ss.Coulomb(mu=0.2), [ss.Coulomb(mu=0.3)], random):
        with pytest.warns(ss.PlausibilityWarning, match=r"run_ensemble: nothing slips") as caught:
            ss.run_ensemble(sliders, weak, members=10, seed=1)
        assert [one.filename for one in caught] == [__file__]
    # one that slips is enough
    ss.sweep([ss.Coulomb(mu=0.2), ss.Coulomb(mu=0.001)], weak)
    ss.run_ensemble([ss.Coulomb(mu=0.2), ss.Coulomb(mu=0.001)], weak, members=10, seed=1)


def test_the_command_says_so_once(tmp_path, capsys):
    files = []
    for name in "ab":
        files.append(tmp_path / f"{name}.txt")
        np.savetxt(files[-1], IN_G)
    command = ["slide", *map(str, files), "--dt", "0.02", "--mu", "0.2", "0.3"]
    assert cli.main([*command, "--units", "m/s^2"]) == 0
    lines = [line for line in capsys.readouterr().err.splitlines() if "nothing slips" in line]
    assert len(lines) == 1
    assert "--units g" in lines[0]
    assert cli.main([*command, "--units", "g"]) == 0
    assert "nothing slips" not in capsys.readouterr().err


def test_a_ground_motion_shows_its_peak_in_both_units():
    text = repr(ss.GroundMotion(IN_G, dt=0.02, units="g"))
    peak = np.abs(IN_G).max()
    assert f"peak {peak * G:.4g} m/s^2 ({peak:.4g} g)" in text
