"""Friction laws: their parameters, the arguments that they reject, and value semantics."""

import math
import pickle

import pytest
import stickslip as ss
from reference import tuples

G = 9.80665  # m/s^2, exact by definition (CGPM 1901)
INF, NAN = math.inf, math.nan


# l/w, slip level / (mu g), reach / l, and the slip level of thesis (A.16) / (mu g).
WHEELS = tuples("casters", "wheels")


def test_standard_gravity_is_the_definition():
    assert ss.STANDARD_GRAVITY == 9.80665


def test_a_coefficient_of_friction_becomes_a_slip_level():
    assert ss.Coulomb(mu=0.2).slip_level == 0.2 * G
    assert ss.Caster(mu=0.2, reach=0.5).slip_level == 0.2 * G


def test_coulomb_friction_is_the_same_both_ways_unless_said_otherwise():
    assert ss.Coulomb(slip_level=1.5).backward == 1.5
    assert ss.Coulomb(mu=0.2).backward == 0.2 * G
    assert ss.Coulomb(mu=0.2, mu_backward=0.3) == ss.Coulomb(slip_level=0.2 * G, backward=0.3 * G)
    law = ss.Coulomb(slip_level=1.0, backward=1.6)
    assert (law.slip_level, law.backward) == (1.0, 1.6)
    assert ss.Coulomb(slip_level=1.0, backward=float("inf")).backward == INF


def test_speed_dependent_friction_is_made_of_coefficients_or_levels():
    law = ss.VelocityDependent(mu_slow=0.03, mu_fast=0.06, rate=50)
    assert (law.slow, law.fast, law.rate) == (0.03 * G, 0.06 * G, 50)
    assert law == ss.VelocityDependent(slow=0.03 * G, mu_fast=0.06, rate=50)
    slider = ss.Slider(law)
    assert slider.hold() == slider.resist(backward=True) == law.slow
    assert slider.resist(speed=0.02) == pytest.approx(G * (0.06 - 0.03 * math.exp(-1)), rel=1e-15)
    for arguments, message in [
        ({"mu_slow": 0.1, "rate": 50}, "give either mu_fast or fast, got neither"),
        ({"mu_slow": 0.1, "slow": 1, "fast": 1, "rate": 50}, "either mu_slow or slow, got both"),
        ({"mu_slow": -0.1, "fast": 1, "rate": 50}, "mu_slow must be finite and at least 0"),
        ({"slow": 1, "fast": 2, "rate": -1}, "rate must be finite and at least 0, got -1 s/m"),
    ]:
        with pytest.raises(ValueError, match=message):
            ss.VelocityDependent(**arguments)


def test_members_on_speed_dependent_friction_slide_as_alone():
    slider = ss.Slider(ss.VelocityDependent(mu_slow=0.03, mu_fast=0.06, rate=50), period=3)
    quake = ss.GaussianExcitation(ss.Spectrum.white(s0=0.01), dt=0.02, samples=500)
    ensemble = ss.run_ensemble(slider, quake, members=70, seed=5)
    alone = [ss.integrate(slider, quake.sample(seed=5, member=i)) for i in range(70)]
    scale = max(r.peak for r in alone)
    # Vector lanes leave out 1e-14 of the largest term a step.
    for got, r in zip(ensemble.residual, alone, strict=True):
        assert abs(got - r.residual) < 1e-10 * scale


def test_a_block_that_slides_under_its_own_weight_is_refused():
    with pytest.raises(ValueError, match=r"20 degrees .* weight .* at least 0\.36397.*got 0\.2"):
        ss.Slider(ss.Coulomb(mu=0.2), slope_degrees=20)


@pytest.mark.filterwarnings(
    "ignore::stickslip.PlausibilityWarning"
)  # of almost level and steep ground
def test_the_least_friction_that_a_message_names_is_enough():
    for tenths in range(1, 890):
        degrees = tenths / 10
        least = math.tan(degrees * (math.pi / 180))
        ss.Slider(ss.Coulomb(mu=least), slope_degrees=degrees)


@pytest.mark.parametrize("l_over_w, s, reach, _", WHEELS)
def test_a_caster_comes_from_the_mechanics_of_its_wheel(l_over_w, s, reach, _):
    # 4 units of the last place: three roundings of the arguments, one of the result
    law = ss.Caster.from_geometry(mu=0.2, trail=l_over_w * 0.02, wheel_width=0.02)
    assert law.slip_level == pytest.approx(0.2 * G * s, rel=1e-15)
    assert law.reach == pytest.approx(reach * l_over_w * 0.02, rel=1e-15)


@pytest.mark.parametrize("l_over_w, s, _, s_thesis", WHEELS)
def test_the_casters_of_the_thesis_are_kept_to_compare(l_over_w, s, _, s_thesis):
    law = ss.Caster.from_geometry(mu=0.2, trail=l_over_w * 0.02, wheel_width=0.02, thesis=True)
    assert law.slip_level == pytest.approx(0.2 * G * s_thesis, rel=1e-15)
    assert law.reach == pytest.approx(3 * l_over_w * 0.02, rel=1e-15)


REFUSED = [
    (lambda: ss.Coulomb(), "give either mu or slip_level, got neither"),
    (lambda: ss.Coulomb(mu=0.2, slip_level=1.5), r"both \(mu = 0\.2, slip_level = 1\.5 m/s\^2\)"),
    (
        lambda: ss.Coulomb(mu=0.2, backward=1.0, mu_backward=0.3),
        r"mu_backward or backward, got both",
    ),
    (lambda: ss.Coulomb(mu=0.2, mu_backward=-0.3), "mu_backward must be finite .* got -0.3"),
    (lambda: ss.Coulomb(mu=-0.2), "Coulomb: mu must be finite and at least 0, got -0.2"),
    (lambda: ss.Coulomb(mu=INF), "Coulomb: mu .* got inf"),
    (lambda: ss.Coulomb(slip_level=-1.5), r"Coulomb: slip_level .* at least 0, got -1\.5 m/s\^2"),
    (lambda: ss.Coulomb(slip_level=INF), "Coulomb: slip_level must be finite .* got inf"),
    (lambda: ss.Coulomb(slip_level=1, backward=-2.5), r"Coulomb: backward .* got -2\.5 m/s\^2"),
    (lambda: ss.Caster(reach=0.5), "Caster: give either mu or slip_level, got neither"),
    (lambda: ss.Caster(mu=0.2, slip_level=1.5, reach=0.5), "Caster: .* got both"),
    (lambda: ss.Caster(mu=-0.2, reach=0.5), r"Caster: mu .* got -0\.2"),
    (lambda: ss.Caster(slip_level=-1.5, reach=0.5), r"Caster: slip_level .* got -1\.5"),
    (lambda: ss.Caster(slip_level=1.0, reach=0.0), "Caster: reach must be positive, got 0 m"),
    (lambda: ss.Caster(slip_level=1.0, reach=-0.5), r"Caster: reach must be positive, got -0\.5 m"),
    (lambda: ss.Caster.from_geometry(mu=-1, trail=1, wheel_width=1), "Caster: mu .* got -1"),
    (lambda: ss.Caster.from_geometry(mu=1, trail=-3, wheel_width=1), "Caster: trail .* got -3 m"),
    (lambda: ss.Caster.from_geometry(mu=1, trail=INF, wheel_width=1), "Caster: trail .* got inf"),
    (lambda: ss.Caster.from_geometry(mu=1, trail=1, wheel_width=0), "Caster: wheel_width .* got 0"),
]


@pytest.mark.parametrize("make, message", REFUSED)
def test_what_is_refused_is_named_with_its_value(make, message):
    with pytest.raises(ValueError, match=message):
        make()


def test_a_complex_number_or_a_list_is_no_level():
    for level in (0.2 + 0j, [1.0]):
        with pytest.raises(TypeError):
            ss.Coulomb(slip_level=level)


@pytest.mark.parametrize(
    "make, message",
    [
        (
            lambda: ss.Coulomb(0.2),
            r"Coulomb: give mu= or slip_level= .*by name, got Coulomb\(0\.2\)",
        ),
        (
            lambda: ss.Coulomb(mu="0.2"),
            r"Coulomb: give mu= or slip_level= .*got Coulomb\(mu='0\.2'\)",
        ),
        (
            lambda: ss.Coulomb(mew=0.2),
            r"Coulomb: give mu= or slip_level= .*got Coulomb\(mew=0\.2\)",
        ),
        (
            lambda: ss.Caster(0.2, 0.5),
            r"Caster: give mu= or slip_level= .*got Caster\(0\.2, 0\.5\)",
        ),
        (lambda: ss.Caster(mu=0.2), r"Caster: .* and reach= \[m\], .*got Caster\(mu=0\.2\)"),
        (
            lambda: ss.VelocityDependent(0.03, 0.06, rate=50),
            r"give mu_slow= and mu_fast=, .*got VelocityDependent\(0\.03, 0\.06, rate=50\)",
        ),
        (lambda: ss.VelocityDependent(mu_slow=0.03, mu_fast=0.06), r"and rate= \[s/m\]"),
    ],
)
def test_a_number_without_its_name_is_refused_with_the_names(make, message):
    with pytest.raises(TypeError, match=message) as caught:
        make()
    assert "\n" not in str(caught.value)  # no list of signatures


@pytest.mark.parametrize(
    "text",
    [
        "Coulomb(mu=0.2)",
        "Coulomb(mu=0.123456)",
        "Coulomb(mu=0.2, mu_backward=0.3)",
        "Coulomb(mu=0.2, backward=float('inf'))",
        "Coulomb(mu=0.2, backward=2.5)",
        "Coulomb(slip_level=1)",
        "Coulomb(slip_level=1.5, mu_backward=0.2)",
        "Coulomb(slip_level=0)",
        "Degrading(distance=[0, 0.1], mu=[0.3, 0.2])",
        "Degrading(distance=[0.5, 1], slip_level=[1, 0], mu_backward=[0.1, 0])",
        "Caster(mu=0.2, reach=0.5)",
        "Caster(mu=0.2, reach=float('inf'), rolling=0.1)",
        "Caster(slip_level=1, reach=0.5)",
        "VelocityDependent(mu_slow=0.03, mu_fast=0.06, rate=50)",
        "VelocityDependent(slow=0.3, mu_fast=0.06, rate=50)",
    ],
)
def test_a_law_is_written_as_short_as_it_can_be_given(text):
    law = eval(text, vars(ss))
    assert repr(law) == text
    assert repr(pickle.loads(pickle.dumps(law))) == text


def test_every_coefficient_of_three_digits_is_written_as_one():
    for mu in range(1, 2000):
        law = ss.Coulomb(mu=mu / 1000)
        assert repr(law) == f"Coulomb(mu={mu / 1000:g})"
        assert eval(repr(law), vars(ss)) == law


def test_laws_are_equal_when_their_numbers_are():
    assert ss.Coulomb(mu=0.2) == ss.Coulomb(slip_level=0.2 * G, backward=0.2 * G)
    assert hash(ss.Coulomb(mu=0.2)) == hash(ss.Coulomb(slip_level=0.2 * G))


def test_rolling_resistance_is_the_same_everywhere():
    geometry = {"mu": 0.2, "trail": 0.03, "wheel_width": 0.02}
    plain = ss.Caster.from_geometry(**geometry)
    rolling = ss.Caster.from_geometry(**geometry, rolling_mu=0.01)
    assert (plain.rolling, rolling.rolling) == (0, 0.01 * G)
    assert (rolling.slip_level, rolling.reach) == (plain.slip_level, plain.reach)
    for x in (0.0, 0.1, -50.0):
        assert ss.Slider(rolling).resist(x) == ss.Slider(plain).resist(x) + 0.01 * G
    assert "rolling" not in repr(plain)
    for bad in (-1.0, NAN, INF):
        with pytest.raises(ValueError, match="rolling must be finite and at least 0, got"):
            ss.Caster(slip_level=1.0, reach=0.5, rolling=bad)
        with pytest.raises(ValueError, match="rolling_mu must be finite and at least 0, got"):
            ss.Caster.from_geometry(**geometry, rolling_mu=bad)


def test_a_cup_is_a_pendulum_of_its_radius_less_the_wheels():
    law = ss.Caster(slip_level=1.0, reach=0.5)
    cart = ss.Slider.in_cup(law, cup_radius=0.54, wheel_radius=0.04)
    assert cart == ss.Slider(law, natural_frequency=math.sqrt(G / 0.5))  # (2.49) corrected
    assert ss.Slider.in_cup(ss.Coulomb(mu=0.1), cup_radius=G, damping=0.2).damping == 0.2
    with pytest.raises(ValueError, match=r"less than the cup's 0\.5 m, got 0\.5 m"):
        ss.Slider.in_cup(law, cup_radius=0.5, wheel_radius=0.5)
    with pytest.raises(ValueError, match="without spring and damper"):
        ss.Slider.in_cup(cart, cup_radius=0.5)
