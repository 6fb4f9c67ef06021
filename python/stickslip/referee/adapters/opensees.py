"""OpenSees through OpenSeesPy: friction with an elastic stick, Newmark's average acceleration."""

from __future__ import annotations

import math
from collections.abc import Sequence
from importlib import import_module
from typing import Any

from ..problems import Answers, NotExpressibleError, NotTriedError, Problem

NAME = "OpenSees"
PURPOSE = "structures and soils in earthquakes, by finite elements; a stick is a stiff spring"
PACKAGE, MODULE = "openseespy", "openseespy.opensees"
COSTS = (
    "1 step a sample, yield displacement 1 mm",
    "10 steps, 0.1 mm",
    "40 steps, 0.01 mm",
)
SETTINGS = ((1, 1e-3), (10, 1e-4), (40, 1e-5))
FAR = 1e6  # a yield displacement that is never reached [m]


def solve(problem: Problem, cost: int) -> Answers:
    system, friction = problem.system, problem.system.get("friction", {})
    if problem.kind in ("rocking", "rigid_block"):
        raise NotExpressibleError("an impact law that is given")
    if problem.kind == "cart":
        raise NotTriedError("wheels that turn as they go")
    if friction["kind"] == "static_kinetic" or friction.get("exponent") == 2:
        raise NotExpressibleError("static friction above kinetic")
    if friction["kind"] == "series":
        raise NotTriedError("bearings of several surfaces")
    if "stops" in system:
        raise NotExpressibleError("stops of a given restitution")
    if problem.start.get("velocity") and problem.kind != "slider" and problem.kind != "planar":
        raise NotTriedError("a structure that starts in motion")
    if system.get("decoupled"):
        raise NotExpressibleError("a structure that does not feel the slider")
    if system.get("contact") == "clipped":
        raise NotExpressibleError("a block that keeps contact without normal force")
    ops: Any = import_module(MODULE)
    steps, yields = SETTINGS[cost]
    ops.wipe()
    try:
        if problem.kind in ("isolated", "floor"):
            return structure(ops, problem, steps, yields)
        plain = problem.kind == "slider" and friction["kind"] == "coulomb"
        level = not ("pendulum_radius" in system or system.get("slope_degrees"))
        if plain and level and not problem.has("vertical"):
            return spring_and_slip(ops, problem, steps, yields)
        if friction.get("one_way") or "mu_backward" in friction:
            raise NotExpressibleError(
                "friction that depends on the direction, with vertical motion"
            )
        return bearing(ops, problem, steps, yields)
    finally:
        ops.wipe()


def prepare(ops: Any, kind: str, *integrator: Any) -> None:
    ops.wipeAnalysis()
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.system("BandGeneral")
    ops.test("NormUnbalance", 1e-9, 60)
    ops.algorithm("Newton")
    ops.integrator(*integrator)
    ops.analysis(kind)


def shake(ops: Any, problem: Problem, steps: int, place: Any) -> Answers:
    """Advance and look at `place()` after every step."""
    prepare(ops, "Transient", "Newmark", 0.5, 0.25)
    where = place()
    peak = math.hypot(*where)
    for _ in range((len(problem.component("along")) - 1) * steps):
        if ops.analyze(1, problem.dt / steps) != 0 and not retry(ops, problem.dt / steps):
            raise ArithmeticError("OpenSees: a step did not converge")
        where = place()
        peak = max(peak, math.hypot(*where))
    return {"final_displacement": list(where), "peak_displacement": [peak]}


def retry(ops: Any, step: float) -> bool:
    """A step that Newton's method does not finish, by another method and in smaller steps."""
    ops.algorithm("KrylovNewton")
    done = all(ops.analyze(1, step / 20) == 0 for _ in range(20))
    ops.algorithm("Newton")
    return done


def slip_material(ops: Any, tag: int, friction: Any, g: float, mass: float, yields: float) -> None:
    """Elastic up to a yield displacement."""
    forward = mass * g * friction["mu"]
    stiffness = forward / yields
    backward = mass * g * friction.get("mu_backward", friction["mu"]) / stiffness
    if friction.get("one_way"):
        backward = FAR
    ops.uniaxialMaterial("ElasticPP", tag, stiffness, yields, -backward)


def min_mu(friction: Any) -> float:
    return float(min(friction["mu"], friction.get("mu_backward", friction["mu"])))


def path(ops: Any, tag: int, dt: float, values: Sequence[float]) -> None:
    ops.timeSeries("Path", tag, "-dt", dt, "-values", *values)


def spring_and_slip(ops: Any, problem: Problem, steps: int, yields: float) -> Answers:
    system = problem.system
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    ops.node(1, 0.0)
    ops.node(2, 0.0)
    ops.fix(1, 1)
    ops.mass(2, 1.0)
    slip_material(ops, 1, system["friction"], system["gravity"], 1.0, yields)
    ops.element("zeroLength", 1, 1, 2, "-mat", 1, "-dir", 1)
    stiffness, damping = system.get("spring", 0.0) ** 2, system.get("damping", 0.0)
    x = problem.start.get("displacement", [0.0])[0]
    if stiffness or damping:
        ops.uniaxialMaterial("Elastic", 2, stiffness, damping)
        ops.element("zeroLength", 2, 1, 2, "-mat", 2, "-dir", 1)
    # A start away from the origin: the slip spring is not stretched there, so that the spring's
    # pull at the start is a load.
    pull = stiffness * x
    loads = [-n - pull for n in problem.component("along")]
    first = 0.0
    if "velocity" not in problem.start and abs(loads[0]) < system["gravity"] * min_mu(
        system["friction"]
    ):
        # The load at the start acts at rest: if it came suddenly, the elastic stick would ring.
        first = loads[0]
        ops.timeSeries("Linear", 9)
        ops.pattern("Plain", 9, 9)
        ops.load(2, first)
        prepare(ops, "Static", "LoadControl", 1.0)
        ops.analyze(1)
        ops.loadConst("-time", 0.0)
    path(ops, 1, problem.dt, [load - first for load in loads])
    ops.pattern("Plain", 1, 1)
    ops.load(2, 1.0)
    if "velocity" in problem.start:
        ops.setNodeVel(2, 1, problem.start["velocity"][0], "-commit")
    return shake(ops, problem, steps, lambda: (x + ops.nodeDisp(2, 1),))


def structure(ops: Any, problem: Problem, steps: int, yields: float) -> Answers:
    system = problem.system
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    ops.node(1, 0.0)
    ops.fix(1, 1)
    ops.node(2, 0.0)
    g = system["gravity"]
    if problem.kind == "isolated":
        modes = system["modes"]
        ops.mass(2, 1.0 - sum(m["mass_fraction"] for m in modes))
        slip_material(ops, 1, system["friction"], g, 1.0, yields)
        ops.element("zeroLength", 1, 1, 2, "-mat", 1, "-dir", 1)
        if system.get("spring"):
            ops.uniaxialMaterial("Elastic", 2, system["spring"] ** 2)
            ops.element("zeroLength", 2, 1, 2, "-mat", 2, "-dir", 1)
        for k, mode in enumerate(modes, 3):
            mass, w, z = (mode[name] for name in ("mass_fraction", "frequency", "damping_ratio"))
            ops.node(k, 0.0)
            ops.mass(k, mass)
            ops.uniaxialMaterial("Elastic", k, mass * w * w, 2 * z * w * mass)
            ops.element("zeroLength", k, 2, k, "-mat", k, "-dir", 1, "-doRayleigh", 0)

        def place() -> tuple[float, ...]:
            return (ops.nodeDisp(2, 1),)
    else:
        floor = system["floor"]
        w, z, ratio = (floor[name] for name in ("frequency", "damping_ratio", "mass_ratio"))
        ratio = max(ratio, 1e-8)
        ops.mass(2, 1.0)
        ops.uniaxialMaterial("Elastic", 2, w * w, 2 * z * w)
        ops.element("zeroLength", 2, 1, 2, "-mat", 2, "-dir", 1)
        ops.node(3, 0.0)
        ops.mass(3, ratio)
        slip_material(ops, 1, system["friction"], g, ratio, yields)
        ops.element("zeroLength", 1, 2, 3, "-mat", 1, "-dir", 1)

        def place() -> tuple[float, ...]:
            return (ops.nodeDisp(3, 1) - ops.nodeDisp(2, 1),)

    path(ops, 1, problem.dt, problem.component("along"))
    ops.pattern("UniformExcitation", 1, 1, "-accel", 1)
    return shake(ops, problem, steps, place)


def bearing(ops: Any, problem: Problem, steps: int, yields: float) -> Answers:
    """`flatSliderBearing` or `singleFPBearing` in space; a stiff vertical spring carries it."""
    system, friction = problem.system, problem.system["friction"]
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    for node in (1, 2):
        ops.node(node, 0.0, 0.0, 0.0)
    ops.fix(1, *(1,) * 6)
    ops.fix(2, 0, 0 if problem.kind == "planar" else 1, 0, 1, 1, 1)
    ops.mass(2, 1.0, 1.0, 1.0, *(1e-6,) * 3)
    g = system["gravity"]
    rigid = 2 * math.pi * 100
    ops.uniaxialMaterial("Elastic", 1, rigid**2, rigid)
    ops.uniaxialMaterial("Elastic", 2, 1.0)
    if friction["kind"] == "coulomb":
        mu = friction["mu"]
        ops.frictionModel("Coulomb", 1, mu)
    else:
        slow = friction.get("mu_slow", friction.get("mu_static"))
        fast = friction.get("mu_fast", friction.get("mu_kinetic"))
        mu = slow
        rate = friction["rate"] if "rate" in friction else 1 / friction["velocity"]
        ops.frictionModel("VelDependent", 1, slow, fast, rate)
    others = ("-P", 1, "-T", 2, "-My", 2, "-Mz", 2, "-orient", 0, 0, 1, 1, 0, 0)
    first = mu * g / yields
    if "pendulum_radius" in system:
        radius = system["pendulum_radius"]
        ops.element("singleFPBearing", 1, 1, 2, 1, radius, first, *others)
    else:
        ops.element("flatSliderBearing", 1, 1, 2, 1, first, *others)
    x, y = (*problem.start.get("displacement", ()), 0.0, 0.0)[:2]
    stiffness, damping = system.get("spring", 0.0) ** 2, system.get("damping", 0.0)
    if stiffness or damping:
        ops.uniaxialMaterial("Elastic", 3, stiffness, damping)
        ops.element("zeroLength", 2, 1, 2, "-mat", 3, 3, "-dir", 1, 2)
    angle = math.radians(system.get("slope_degrees", 0.0))
    sine, cosine = math.sin(angle), math.cos(angle)
    along, across, up = (problem.component(c) for c in ("along", "transverse", "vertical"))
    loads = (
        [(g + a) * sine - n * cosine - stiffness * x for n, a in zip(along, up, strict=True)],
        [-t - stiffness * y for t in across],
        [-(g + a) * cosine - n * sine for n, a in zip(along, up, strict=True)],
    )
    # The weight first, at rest; then what differs from it.
    weight = loads[2][0]
    ops.timeSeries("Linear", 9)
    ops.pattern("Plain", 9, 9)
    ops.load(2, 0.0, 0.0, weight, 0.0, 0.0, 0.0)
    prepare(ops, "Static", "LoadControl", 1.0)
    ops.analyze(1)
    ops.loadConst("-time", 0.0)
    for k, values in enumerate((*loads[:2], [v - weight for v in loads[2]])):
        path(ops, 20 + k, problem.dt, values)
        ops.pattern("Plain", 20 + k, 20 + k)
        ops.load(2, *(1.0 if j == k else 0.0 for j in range(6)))
    for k, speed in enumerate(problem.start.get("velocity", ()), 1):
        ops.setNodeVel(2, k, speed, "-commit")

    def place() -> tuple[float, ...]:
        if problem.kind == "planar":
            return x + ops.nodeDisp(2, 1), y + ops.nodeDisp(2, 2)
        return (x + ops.nodeDisp(2, 1),)

    return shake(ops, problem, steps, place)
