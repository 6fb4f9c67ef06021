"""Derivatives of pendulums with several surfaces: differences, scaling, limits, messages."""

import math

import numpy as np
import pytest
import stickslip as ss

G = ss.STANDARD_GRAVITY
M = np.arange(401)
RECORD = 2 * np.sin(0.7 * M) + 1.3 * np.cos(1.9 * M + 0.4)
QUAKE = ss.GroundMotion(RECORD, dt=0.1)
SHAKEN = ss.GroundMotion(RECORD, dt=0.1, vertical=2.5 * np.cos(0.5 * M + 0.2))
LISTS = ("radii", "mu", "capacities")
QUANTITIES = {
    "peak": lambda r: r.peak,
    "residual": lambda r: r.residual,
    "velocity": lambda r: r.state.velocity,
}


def nested(rng, surfaces, restitution):
    radii, mu = [rng.uniform(0.2, 0.6)], [rng.uniform(0.005, 0.02)]
    outer = [(radii[0], mu[0])] * 2
    for _ in range(surfaces // 2):
        for half in (0, 1):
            radius, friction = outer[half]
            outer[half] = radius * rng.uniform(1.5, 4), friction + rng.uniform(0.005, 0.04)
            radii.append(outer[half][0])
            mu.append(outer[half][1])
    needed = max(radii) * max(mu)  # no inner surface is at its stop before the next slides
    capacities = rng.uniform(0.02, 0.1, surfaces) + [
        needed * (i < surfaces - 2) for i in range(surfaces)
    ]
    return ss.MultiPendulum(radii, mu, capacities, restitution, nested=True)


def bearing(rng):
    """Of a series, or nested; some elements alike, without a stop, or flat."""
    restitution = float(rng.choice([0, 0.4, 0.8]))
    if rng.random() < 0.3:
        return nested(rng, int(rng.choice([3, 5])), restitution)
    n = int(rng.integers(1, 5))
    radii, mu, capacities = (
        rng.uniform(0.3, 3, n),
        rng.uniform(0.01, 0.1, n),
        rng.uniform(0.01, 0.12, n),
    )
    radii[rng.random(n) < 0.08] = math.inf
    capacities[rng.random(n) < 0.2] = math.inf
    if n > 1 and rng.random() < 0.2:
        radii[1], mu[1], capacities[1] = radii[0], mu[0], capacities[0]
    return ss.MultiPendulum(radii, mu, capacities, restitution)


def changed(isolator, name, index, by):
    lists = {of: getattr(isolator, of).copy() for of in LISTS}
    lists[name][index] += by
    return ss.MultiPendulum(**lists, restitution=isolator.restitution, nested=isolator.nested)


def slid(isolator, mounting, motion, options):
    """The response, and what happens in it."""
    r = ss.integrate(ss.Slider(isolator, **mounting), motion, contact="clipped", **options)
    elements = r.elements
    return r, (r.events["kind"].tolist(), elements.slides.tolist(), elements.stops.tolist())


def test_derivatives_are_the_limits_of_differences():
    """Central differences at two steps: the nearer is off by a third of what they differ by.

    Only where the events, and the slides and stops of the elements, are the same at all steps, and
    the differences have converged: near a graze they do not.
    """
    rng = np.random.default_rng(5)
    compared, left_out, jumps = 0, 0, 0
    for problem in range(400):
        isolator = bearing(rng)
        vertical = rng.uniform(-6, 6, 12) if rng.random() < 0.3 else None
        motion = ss.GroundMotion(rng.uniform(-4, 4, 12), dt=0.2, vertical=vertical)
        mounting = {}
        if rng.random() < 0.2:
            mounting["damping"] = rng.uniform(0.1, 1)
        if rng.random() < 0.2:
            mounting["natural_frequency"] = rng.uniform(0.5, 3)
        options = {"settle": bool(rng.random() < 0.3)}
        if rng.random() < 0.3:
            options["displacement"] = rng.uniform(-0.8, 0.8) * min(isolator.capacity, 0.3)
        if rng.random() < 0.3:
            options["velocity"] = rng.uniform(-0.5, 0.5)
        name = str(rng.choice(LISTS))
        index = int(rng.integers(len(isolator.radii)))
        if not math.isfinite(getattr(isolator, name)[index]):
            continue
        r, happens = slid(isolator, mounting, motion, options)
        h = 1e-6
        try:
            others = [
                slid(changed(isolator, name, index, by), mounting, motion, options)
                for by in (h / 2, -h / 2, h, -h)
            ]
        except ValueError:  # a nested bearing at the border of what is admissible
            continue
        found = r.sensitivity(f"{name}[{index}]")
        near, far = (
            {q: (of(others[i][0]) - of(others[i + 1][0])) / step for q, of in QUANTITIES.items()}
            for i, step in ((0, h), (2, 2 * h))
        )
        scale = 1 + sum(map(abs, near.values()))
        error = max(abs(far[q] - near[q]) for q in QUANTITIES)
        if any(other != happens for _, other in others) or error > 1e-5 * scale:
            left_out += 1
            continue
        compared += 1
        jumps += sum(r.elements.stops) > 0
        for q in QUANTITIES:
            # The rest is round-off of the responses, of some 1e-15, over the step.
            assert abs(getattr(found, q) - near[q]) <= error + 1e-8 * scale, (problem, name, q)
    assert compared > 4 * left_out
    assert compared > 250
    assert jumps > 100


def test_derivatives_follow_the_law_of_scaling():
    """x is homogeneous of degree one in mu, capacities and ground motion together (Euler)."""
    rng = np.random.default_rng(6)
    for problem in range(200):
        isolator = bearing(rng)
        motion = ss.GroundMotion(rng.uniform(-4, 4, 20), dt=0.2)
        damping = rng.uniform(0, 1) if rng.random() < 0.5 else 0
        r = ss.integrate(ss.Slider(isolator, damping=damping), motion)
        total = dict.fromkeys(QUANTITIES, 0.0)
        sizes = dict.fromkeys(QUANTITIES, 0.0)
        for name in ("mu", "capacities", "scale"):
            values = getattr(isolator, name, [1])
            for i, value in enumerate(values):
                if not math.isfinite(value):
                    continue
                one = r.sensitivity(name if name == "scale" else f"{name}[{i}]")
                for q in QUANTITIES:
                    total[q] += value * getattr(one, q)
                    sizes[q] += abs(value * getattr(one, q))
        for q, of in QUANTITIES.items():
            assert total[q] == pytest.approx(of(r), abs=1e-9 * (sizes[q] + r.peak)), (problem, q)


@pytest.mark.parametrize("motion", [QUAKE, SHAKEN], ids=["level", "vertical"])
def test_one_surface_is_a_friction_pendulum(motion):
    radius, mu = 1.7, 0.06
    one = ss.integrate(ss.MultiPendulum([radius], [mu]), motion, settle=True)
    known = ss.integrate(
        ss.FrictionPendulum(radius=radius, law=ss.Coulomb(mu=mu)), motion, settle=True
    )
    by_radius = -math.sqrt(G / radius) / (2 * radius)  # of the natural frequency
    for mine, its, factor in (
        ("mu[0]", "mu", 1),
        ("mu", "mu", 1),
        ("radii[0]", "natural_frequency", by_radius),
        ("scale", "scale", 1),
    ):
        found, expected = one.sensitivity(mine), known.sensitivity(its)
        for q in QUANTITIES:
            assert getattr(found, q) == pytest.approx(
                factor * getattr(expected, q), rel=1e-9, abs=1e-10
            ), (mine, q)


def test_all_surfaces_alike_are_the_sum_of_each():
    five = ss.QuintuplePendulum(
        [0.15, 0.6, 0.7, 1.9, 2.3], [0.015, 0.03, 0.045, 0.07, 0.10], [0.05, 0.10, 0.12, 0.30, 0.35]
    )
    r = ss.integrate(five, QUAKE, settle=True)
    for name in LISTS:
        each = [r.sensitivity(f"{name}[{i}]") for i in range(5)]
        for q in QUANTITIES:
            parts = [getattr(one, q) for one in each]
            assert getattr(r.sensitivity(name), q) == pytest.approx(
                sum(parts), abs=1e-12 * sum(map(abs, parts))
            )


def test_an_element_and_its_halves_have_the_same_derivatives():
    """Halves of (R/2, mu, d/2) move together, and come to their stops at one time."""
    motion = ss.GroundMotion(0.5 * RECORD, dt=0.3)
    whole = ss.integrate(ss.MultiPendulum([0.9, 2], [0.02, 0.06], [0.04, 0.5]), motion)
    halves = ss.integrate(
        ss.MultiPendulum([0.45, 0.45, 2], [0.02, 0.02, 0.06], [0.02, 0.02, 0.5]), motion
    )
    assert whole.elements.stops[0] > 10
    for name, factor in (("radii", 0.5), ("mu", 1), ("capacities", 0.5)):
        one = whole.sensitivity(f"{name}[0]")
        two = [halves.sensitivity(f"{name}[{i}]") for i in (0, 1)]
        other, same = whole.sensitivity(f"{name}[1]"), halves.sensitivity(f"{name}[2]")
        for q in QUANTITIES:
            assert factor * sum(getattr(half, q) for half in two) == pytest.approx(
                getattr(one, q), rel=1e-9, abs=1e-10
            )
            assert getattr(same, q) == pytest.approx(getattr(other, q), rel=1e-9, abs=1e-10)


def test_a_surface_that_never_slides_changes_nothing():
    isolator = ss.TriplePendulum([0.3937, 3.7465, 3.7465], [0.01, 0.04, 0.3], [0.2, 0.5043, 0.5043])
    r = ss.integrate(isolator, QUAKE)
    assert r.elements.slides[3] == 0
    for name in LISTS:
        found = r.sensitivity(f"{name}[2]")
        assert (found.peak, found.residual, found.velocity) == (0, 0, 0)


@pytest.mark.parametrize(
    ("parameter", "message"),
    [
        ("mu[3]", "the index of a surface must be from 0 to 2, got 3"),
        ("mu[-1]", r"must be one of .*'mu\[i\]', .*got 'mu\[-1\]'"),
        ("radii[one]", r"got 'radii\[one\]'"),
        ("capacities[0]", r"capacities\[0\] is infinite"),
        ("radii[1]", r"radii\[1\] is infinite"),
        ("mu_static", "one level for sliding and rest"),
        ("natural_frequency", "without a spring"),
    ],
)
def test_parameters_that_a_pendulum_does_not_have(parameter, message):
    isolator = ss.MultiPendulum([1, math.inf, 2], [0.02, 0.05, 0.07])
    with pytest.raises(ValueError, match=message):
        ss.integrate(isolator, QUAKE).sensitivity(parameter)


def test_other_sliders_have_no_surfaces():
    r = ss.integrate(ss.Coulomb(mu=0.1), QUAKE)
    with pytest.raises(ValueError, match="only a MultiPendulum has surfaces"):
        r.sensitivity("radii[0]")
    with pytest.raises(ValueError, match="covers Coulomb friction, which has no surfaces"):
        ss.ensemble_sensitivity(ss.Coulomb(mu=0.1), [QUAKE], "mu[0]", members=2, seed=1)
