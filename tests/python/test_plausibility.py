"""Arguments in a likely wrong unit warn, usual ones never do; slips of g for m/s^2 are remarked."""

import functools
import re
import warnings

import numpy as np
import pytest
import stickslip as ss
from stickslip import cli
from stickslip._core import _plausible_ranges
from stickslip.regressions import SaygiliRathje2008

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
        (
            lambda: ss.Degrading(distance=[0, 1], mu=[30, 20]),
            r"Degrading: mu\[0\] = 30 .* mu\[0\]=0\.3",
        ),
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


BUILDING = {"masses": [2e5, 2e5, 1.6e5], "stiffnesses": [2.4e8, 2e8, 1.6e8], "damping_ratio": 0.03}
MOTION = ss.GroundMotion(np.sin(np.linspace(0, 20, 500)), dt=0.02)


def soft(factor_of_mass=1.0, factor_of_stiffness=1.0):
    of = {"masses": factor_of_mass, "stiffnesses": factor_of_stiffness}
    return ss.Structure.shear_building(
        **BUILDING | {name: np.multiply(BUILDING[name], factor) for name, factor in of.items()}
    )


def isolated(mass):
    building = ss.Structure.shear_building(**BUILDING)
    return ss.IsolatedStructure(ss.Coulomb(mu=0.1), building, base_mass=mass)


def pendulum(make, radii, mu, unit):
    return lambda value: make(np.multiply(radii, value / unit), mu)


def spectrum(make, **given):
    return lambda name: lambda value: make(**{**given, name: value})


def slope(name):
    given = {"ky_g": 0.1, "height": 50, "shear_velocity": 600}
    return lambda value: ss.FlexibleSlope(**{**given, name: value})


LINER = {"mu_slow": 0.03, "mu_fast": 0.06}
TRAVEL = {"gap": 0.3, "restitution": 0}
kanai_tajimi = spectrum(ss.Spectrum.kanai_tajimi, s0=0.01, frequency=15, damping=0.6)
clough_penzien = spectrum(
    ss.Spectrum.clough_penzien,
    s0=0.01,
    frequency=15,
    damping=0.6,
    filter_frequency=1.5,
    filter_damping=0.6,
)
ROCK = clough_penzien("s0")(0.01)
kumar = spectrum(
    ss.KumarFriction, **{**KUMAR, "static_pressure": 50e6, "temperature": 20, "rate": 100}
)

# For each argument of each constructor: the quantity, a call, its name, a plausible value and an
# implausible one, and the words for the likely unit; or of what is computed from several.
ARGUMENTS = [
    ("coefficient of friction", lambda v: ss.Coulomb(mu=v), "mu", 0.3, 30, "percent, give mu=0.3"),
    *(
        ("slip level", make, name, 0.1, 196.1, f"cm/s^2, give {name}=1.961")
        for make, name in (
            (lambda v: ss.Coulomb(slip_level=v), "slip_level"),
            (lambda v: ss.Coulomb(mu=0.1, backward=v), "backward"),
            (lambda v: ss.Caster(slip_level=v, reach=0.1), "slip_level"),
            (lambda v: ss.Caster(mu=0.3, reach=0.1, rolling=v), "rolling"),
            (lambda v: ss.StaticKinetic(static=v, mu_kinetic=0), "static"),
            (lambda v: ss.Stribeck(static=v, mu_kinetic=0, velocity=0.1, exponent=2), "static"),
            (lambda v: ss.VelocityDependent(slow=0.1, fast=v, rate=50), "fast"),
            (lambda v: ss.Degrading(distance=[0, 1], slip_level=[0.1, v]), "slip_level[1]"),
            (lambda v: ss.Degrading(distance=[0], mu=[0.3], backward=[v]), "backward"),
        )
    ),
    ("length", lambda v: ss.Caster(mu=0.3, reach=v), "reach", 0.12, 120, "mm, give reach=0.12"),
    *(
        (
            "time in an earthquake",
            lambda v, name=name: ss.Envelope(
                **{"build_up": 2, "strong_duration": 8, "decay_rate": 1, name: v}
            ),
            name,
            10,
            10000,
            f"ms, give {name}=10",
        )
        for name in ("build_up", "strong_duration")
    ),
    (
        "time in an earthquake",
        lambda v: ss.Envelope.from_table([0, v], [1, 0]),
        "time[1]",
        20,
        20000,
        "ms, give time[1]=20",
    ),
    *(
        (
            "pulses or cycles of a motion",
            make,
            "number of",
            20,
            20000,
            "the duration is in ms, it is",
        )
        for make in (
            lambda v: ss.HarmonicMotion(1, 6, v),
            lambda v: ss.PoissonPulses(rate=3, half_width=0.2, sigma=2, duration=v),
            lambda v: ss.PoissonPulses.from_earthquake(
                rms_acceleration=1, center_frequency_hz=3, duration=v
            ),
            lambda v: ss.PoissonPulses.from_spectrum(ROCK, rate=3, duration=v, dt=0.02),
        )
    ),
    (
        "rate",
        lambda v: ss.VelocityDependent(**LINER, rate=v),
        "rate",
        50,
        0.05,
        "s/mm, give rate=50",
    ),
    (
        "rate",
        lambda v: ss.VelocityDependent(**LINER, rate=v),
        "rate",
        30,
        0.77,
        "s/inch, give rate=30.31",
    ),
    (
        "pressure",
        kumar("static_pressure"),
        "static_pressure",
        5e7,
        7250,
        "psi, give static_pressure=4.999e+07",
    ),
    ("length", kumar("contact_radius"), "contact_radius", 0.2, 200, "mm, give contact_radius=0.2"),
    ("temperature", kumar("temperature"), "temperature", 20, 293.15, "K, give temperature=20"),
    (
        "diffusivity",
        kumar("diffusivity"),
        "diffusivity",
        4.44e-6,
        4.44,
        "mm^2/s, give diffusivity=4.44e-06",
    ),
    (
        "conductivity",
        kumar("conductivity"),
        "conductivity",
        18,
        0.018,
        "W/(mm K), give conductivity=18",
    ),
    (
        "sliding velocity",
        lambda v: ss.Stribeck(mu_static=0.3, mu_kinetic=0.2, velocity=v, exponent=2),
        "velocity",
        0.1,
        100,
        "mm/s, give velocity=0.1",
    ),
    (
        "distance slid",
        lambda v: ss.Degrading(distance=[0, v], mu=[0.3, 0.2]),
        "distance[1]",
        0.5,
        500,
        "mm, give distance[1]=0.5",
    ),
    (
        "yield acceleration",
        lambda v: ss.Degrading(distance=[0], ky_g=[v]),
        "ky_g",
        0.2,
        1.96,
        "m/s^2, give ky_g=0.1999",
    ),
    (
        "length",
        lambda v: ss.Caster.from_geometry(mu=0.3, trail=v, wheel_width=0.02),
        "trail",
        0.03,
        30,
        "mm, give trail=0.03",
    ),
    (
        "length",
        lambda v: ss.Caster.from_geometry(mu=0.3, trail=0.03, wheel_width=v),
        "wheel_width",
        0.02,
        20,
        "mm, give wheel_width=0.02",
    ),
    ("length", lambda v: ss.Stops(**{**TRAVEL, "gap": v}), "gap", 0.1, 10, "cm, give gap=0.1"),
    (
        "length",
        lambda v: ss.Stops(**TRAVEL, backward=v),
        "backward",
        0.3,
        300,
        "mm, give backward=0.3",
    ),
    (
        "radius",
        lambda v: ss.FrictionPendulum(radius=v, mu=0.06),
        "radius",
        2.2,
        2200,
        "mm, give radius=2.2",
    ),
    (
        "radius",
        lambda v: ss.FrictionPendulum(radius=v, mu=0.06),
        "radius",
        2.2,
        88,
        "inches, give radius=2.235",
    ),
    (
        "period",
        lambda v: ss.FrictionPendulum(period=v, mu=0.06),
        "period",
        3,
        3000,
        "ms, give period=3",
    ),
    (
        "damper",
        lambda v: ss.FrictionPendulum(radius=2.2, mu=0.06, damping=v),
        "damping",
        1,
        1e5,
        "check its unit",
    ),
    (
        "radius",
        pendulum(ss.DoublePendulum, [1, 2], [0.03, 0.05], 2),
        "radii[1]",
        2,
        2000,
        "mm, give radii[1]=2",
    ),
    (
        "radius",
        pendulum(ss.TriplePendulum, [0.3937, 3.7465, 3.7465], [0.01, 0.04, 0.08], 3.7465),
        "radii[1]",
        3.7465,
        3746.5,
        "mm, give radii[1]=3.747",
    ),
    (
        "length",
        lambda v: ss.TriplePendulum([0.3937, 3.7465, 3.7465], [0.01, 0.04, 0.08], [v / 7, v, v]),
        "capacities[1]",
        0.5043,
        504.3,
        "mm, give capacities[1]=0.5043",
    ),
    ("radius", lambda v: ss.MultiPendulum([v], [0.03]), "radii", 2, 200, "cm, give radii=2"),
    (
        "radius",
        lambda v: ss.QuintuplePendulum(
            np.multiply([0.2, 0.5, 0.5, 1, 1], v), [0.01, 0.03, 0.03, 0.05, 0.05]
        ),
        "radii[3]",
        1,
        1000,
        "mm, give radii[3]=1",
    ),
    (
        "slope",
        lambda v: ss.Slider(ss.Coulomb(mu=0.6), slope_degrees=v),
        "slope_degrees",
        20,
        0.35,
        "radians, give slope_degrees=20.05",
    ),
    (
        "period",
        lambda v: ss.Slider(ss.Coulomb(mu=0.1), period=v),
        "period",
        2,
        2000,
        "ms, give period=2",
    ),
    (
        "angular frequency",
        lambda v: ss.Slider(ss.Coulomb(mu=0.1), v),
        "natural_frequency",
        3,
        2.4e5,
        "check its unit",
    ),
    ("damper", lambda v: ss.Slider(ss.Coulomb(mu=0.1), 3, v), "damping", 1, 1e5, "check its unit"),
    (
        "damping ratio of one mode",
        lambda v: ss.Slider(ss.Coulomb(mu=0.1), 3, damping_ratio=v),
        "damping_ratio",
        0.05,
        5,
        "percent, give damping_ratio=0.05",
    ),
    (
        "period",
        lambda v: ss.PlanarSlider(ss.Coulomb(mu=0.1), period=v),
        "period",
        2,
        2000,
        "ms, give period=2",
    ),
    (
        "radius",
        lambda v: ss.Slider.in_cup(ss.Coulomb(mu=0.1), cup_radius=v),
        "cup_radius",
        0.3,
        300,
        "mm, give cup_radius=0.3",
    ),
    ("damper", lambda v: ss.ViscousSlider(v), "damping", 1, 1e5, "check its unit"),
    (
        "first period of a building",
        lambda v: soft(factor_of_stiffness=v),
        "the first period",
        1,
        1e-3,
        "the stiffnesses are in kN/m, it is 0.4",
    ),
    (
        "first period of a building",
        lambda v: soft(factor_of_mass=v),
        "the first period",
        1,
        1e-3,
        "the masses are in t, it is 0.4",
    ),
    (
        "first period of a building",
        lambda v: ss.Structure([[2e5]], [[0]], [[v]]),
        "the first period",
        6e7,
        6e4,
        "the stiffnesses are in kN/m, it is 0.3628 s",
    ),
    (
        "first period of modes",
        lambda v: ss.Structure.from_modes(
            mass_fractions=[0.7], frequencies=[v], damping_ratios=[0.05]
        ),
        "the first period",
        3.1,
        0.5,
        "the frequencies are in Hz, it is 2 s",
    ),
    (
        "damping ratio",
        lambda v: ss.Structure.shear_building(**BUILDING | {"damping_ratio": v}),
        "damping_ratio",
        0.03,
        3,
        "percent, give damping_ratio=0.03",
    ),
    (
        "base mass over the mean mass of a floor",
        isolated,
        "base_mass over",
        2e5,
        200,
        "base_mass is in t, it is 1.071",
    ),
    ("yield acceleration", slope("ky_g"), "ky_g", 0.1, 0.98, "m/s^2, give ky_g=0.09993"),
    (
        "first period of a slope",
        lambda v: ss.FlexibleSlope(ky_g=0.1, height=30000 / v, shear_velocity=v),
        "the first period",
        600,
        50,
        "height and shear_velocity are exchanged, it is 0.3333 s",
    ),
    (
        "shear-wave velocity",
        slope("rock_velocity"),
        "rock_velocity",
        1200,
        1.2,
        "km/s, give rock_velocity=1200",
    ),
    (
        "damping ratio",
        slope("damping_ratio"),
        "damping_ratio",
        0.15,
        15,
        "percent, give damping_ratio=0.15",
    ),
    (
        "reference strain",
        lambda v: ss.HyperbolicSoil(reference_strain=v),
        "reference_strain",
        5e-4,
        0.05,
        "percent, give reference_strain=0.0005",
    ),
    (
        "spectral density",
        lambda v: ss.Spectrum.white(s0=v),
        "s0",
        0.01,
        100,
        "cm^2/s^3, give s0=0.01",
    ),
    (
        "spectral density",
        lambda v: ss.Spectrum.band_pass(s0=v, low=1, high=9),
        "s0",
        0.01,
        100,
        "cm^2/s^3, give s0=0.01",
    ),
    (
        "damping ratio of one mode",
        kanai_tajimi("damping"),
        "damping",
        0.6,
        60,
        "percent, give damping=0.6",
    ),
    ("angular frequency", kanai_tajimi("frequency"), "frequency", 15, 15000, "check its unit"),
    (
        "damping ratio of one mode",
        clough_penzien("filter_damping"),
        "filter_damping",
        0.6,
        60,
        "percent, give filter_damping=0.6",
    ),
    (
        "ground acceleration",
        lambda v: ss.HarmonicMotion(v, 3, 10),
        "amplitude",
        3,
        300,
        "cm/s^2, give amplitude=3",
    ),
    (
        "ground acceleration",
        lambda v: ss.PoissonPulses(rate=2, half_width=0.2, sigma=v, duration=9),
        "sigma",
        2,
        200,
        "cm/s^2, give sigma=2",
    ),
    (
        "period",
        lambda v: ss.PoissonPulses(rate=2, half_width=v, sigma=1, duration=9),
        "half_width",
        0.2,
        200,
        "ms, give half_width=0.2",
    ),
    (
        "frequency in Hz",
        lambda v: ss.PoissonPulses.from_earthquake(
            rms_acceleration=1, center_frequency_hz=v, duration=9
        ),
        "center_frequency_hz",
        20,
        126,
        "rad/s, give center_frequency_hz=20.05",
    ),
    (
        "ratio of components",
        lambda v: ss.WithVertical(ss.PoissonPulses.event("great near field"), ratio=v),
        "ratio",
        0.65,
        65,
        "percent, give ratio=0.65",
    ),
    (
        "ratio of components",
        lambda v: ss.WithTransverse(ss.PoissonPulses.event("great near field"), ratio=v),
        "ratio",
        0.8,
        80,
        "percent, give ratio=0.8",
    ),
    (
        "period",
        lambda v: ss.response_spectrum(MOTION, [0.1, v]),
        "periods[1]",
        2,
        2000,
        "ms, give periods[1]=2",
    ),
    (
        "ground acceleration in g",
        lambda v: MOTION.scaled_to(pga_g=v),
        "pga_g",
        0.4,
        40,
        "m/s^2, give pga_g=4.079",
    ),
    (
        "frequency parameter",
        lambda v: ss.SlenderBlock(p=v, alpha=0.2, restitution=0.9),
        "p",
        2,
        0.07,
        "width and height are in mm, it is 2.214 rad/s",
    ),
    (
        "angle of a slender block",
        lambda v: ss.SlenderBlock(p=2, alpha=v, restitution=0.9),
        "alpha",
        0.35,
        0.36,
        "no longer small",
    ),
    (
        "length of a cart",
        lambda v: ss.Foot(at=(0, -v), mu=0.3),
        "at[1]",
        2,
        2000,
        "mm, give at[1]=2",
    ),
    (
        "length of a cart",
        lambda v: ss.Cart([ss.Foot(at=(0, 0), mu=0.3)], radius_of_gyration=v),
        "radius_of_gyration",
        0.4,
        40,
        "cm, give radius_of_gyration=0.4",
    ),
    (
        "heading",
        lambda v: ss.SwivelCaster(at=(0, 0), heading=-v, slip_level=1, reach=0.1),
        "heading",
        6.28,
        90,
        "degrees, give heading=1.571",
    ),
    (
        "heading",
        lambda v: ss.FixedWheel(at=(0, 0), heading=v, mu=0.3),
        "heading",
        3,
        45,
        "degrees, give heading=0.7854",
    ),
    (
        "length",
        lambda v: ss.SwivelCaster(at=(0, 0), heading=0, mu=0.5, trail=v, wheel_width=0.03),
        "trail",
        0.04,
        40,
        "mm, give trail=0.04",
    ),
    ("ground velocity", lambda v: MOTION.scaled_to(pgv=v), "pgv", 0.4, 40, "cm/s, give pgv=0.4"),
    (
        "Arias intensity",
        lambda v: MOTION.scaled_to(arias=v),
        "arias",
        2.5,
        250,
        "cm/s, give arias=2.5",
    ),
    (
        "ground velocity in cm/s",
        lambda v: SaygiliRathje2008().predict(ky=0.1, pga=0.5, pgv=v),
        "pgv",
        42,
        0.42,
        "m/s, give pgv=42",
    ),
]


@pytest.mark.parametrize(("quantity", "make", "name", "plausible", "odd", "likely"), ARGUMENTS)
def test_each_argument_has_a_plausible_range(quantity, make, name, plausible, odd, likely):
    make(plausible)  # the suite turns warnings into errors
    with pytest.warns(ss.PlausibilityWarning) as caught:
        make(odd)
    (text,) = (str(one.message) for one in caught)
    assert name in text
    assert likely in text
    assert "is outside" in text
    assert caught[0].filename == __file__
    assert quantity in _plausible_ranges()
    who = text.split(":")[0].split(".")
    warns = functools.reduce(getattr, who, ss if hasattr(ss, who[0]) else ss.regressions)
    assert "PlausibilityWarning" in getattr(warns, "predict", warns).__doc__


def test_each_plausible_range_is_used():
    tried = {quantity for quantity, *_ in ARGUMENTS}
    of_records = {
        name for name in _plausible_ranges() if name.endswith("of a record")
    }  # test_records
    assert tried | of_records == _plausible_ranges().keys()


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
        ss.FlexibleSlope(ky_g=min(ratio, 0.7), height=50, shear_velocity=600, damping_ratio=ratio)
    for level in (0, 0.01, 0.1, 2, 20, 50, 1000, 1e4):  # levels are in m/s^2
        ss.Coulomb(slip_level=level)
    ss.Caster(slip_level=1, reach=1000)  # of a theory, not of a cart
    ss.Envelope(build_up=0, strong_duration=float("inf"), decay_rate=0)


@pytest.mark.filterwarnings("default::stickslip.PlausibilityWarning")
def test_the_command_names_the_likely_unit(tmp_path, capsys):
    file = tmp_path / "a.txt"
    np.savetxt(file, 9.81 * IN_G)
    command = ["slide", str(file), "--dt", "0.02", "--units", "m/s^2", "--mu", "0.1"]
    for options, likely in (
        (["--stop-gap", "10", "--restitution", "0"], "Stops: gap = 10 m .* in cm, give gap=0.1"),
        (["--law", "caster", "--reach", "120"], "Caster: reach = 120 m .* in mm, give reach=0.12"),
        (["--period", "3000"], "Slider: period = 3000 s .* in ms, give period=3"),
    ):
        assert cli.main([*command, *options]) == 0
        (line,) = (x for x in capsys.readouterr().err.splitlines() if "is outside" in x)
        assert re.search(likely, line)


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
