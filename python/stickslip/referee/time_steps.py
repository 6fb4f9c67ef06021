"""A block for tools that advance in time steps: engines for rigid bodies.

It slides without turning, is a rigid block that rocks in a vertical plane, or a cart on wheels.

The ground stays at rest, and the block feels the ground acceleration as a force (an inclined ground
turns the forces). Within a step the force is held at its mean. A block weighs 1 kg, so that forces
are accelerations.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from .problems import Answers, NotExpressibleError, NotTriedError, Problem

Advance = Callable[[float, float, float], tuple[float, float, float, float]]
"""Applies (along, transverse, upward) forces for a step; returns x, y, vx, vy after it."""


@dataclass(frozen=True)
class Body:
    """What an engine builds."""

    step: float  # [s]
    mu: float
    planar: bool
    stops: Mapping[str, float] | None
    start: tuple[float, float, float, float]  # x, y [m], vx, vy [m/s]


Tumble = Callable[[float, float], tuple[float, float]]
"""Applies (along, upward) forces at the center of mass for a step; returns its displacement along
and the rotation, positive to the right."""


@dataclass(frozen=True)
class Block:
    """A rigid block in a vertical plane, on the ground at z = 0."""

    step: float  # [s]
    mu: float
    size: tuple[float, float]  # width and height [m]
    center: tuple[float, float]  # of mass, from the middle of the base [m]
    inertia: float  # about the center of mass [kg m^2]
    rotation: float  # at the start [rad]

    def at(self) -> tuple[float, float]:
        """Where the center of mass starts; the middle of the base was at the origin."""
        lean = self.rotation
        side = math.copysign(self.size[0] / 2, lean) if lean else 0.0
        x, z = self.center[0] - side, self.center[1]
        return (
            side + x * math.cos(lean) + z * math.sin(lean),
            z * math.cos(lean) - x * math.sin(lean),
        )

    def base(self, x: float, rotation: float) -> float:
        """Displacement of the middle of the base, from that of the center of mass along."""
        at = self.at()[0] + x
        aside, up = self.center
        return at - aside * math.cos(rotation) - up * math.sin(rotation)


Roll = Callable[[float, float, float], tuple[float, float, float]]
"""Applies (along, transverse, upward) forces for a step; returns x, y and the yaw after it."""


@dataclass(frozen=True)
class Cart:
    """A rigid body in the plane on wheels."""

    step: float  # [s]
    radius_of_gyration: float  # [m]
    supports: Sequence[Mapping[str, Any]]  # as in a problem
    velocity: tuple[float, float, float] = (0.0, 0.0, 0.0)  # vx, vy [m/s], yaw [rad/s]


def march(
    problem: Problem,
    step: float,
    build: Callable[[Body], Advance],
    *,
    tumble: Callable[[Block], Tumble] | None = None,
    roll: Callable[[Cart], Roll] | None = None,
    stops: bool = True,
    restitution: bool = True,
    flight: bool = True,
) -> Answers:
    """Step a block through a problem.

    Parameters
    ----------
    step : float
        Time step [s]; shortened so that every sample falls on one.
    build : callable
        Makes the world of the engine.
    tumble : callable, optional
        The same for a rigid block that rocks.
    roll : callable, optional
        The same for a cart.
    stops, restitution, flight : bool
        What the engine offers.
    """
    system = problem.system
    if problem.kind == "rigid_block" and tumble is None:
        raise NotTriedError("blocks that turn")
    if problem.kind == "rigid_block" and tumble is not None:
        return rock(problem, step, tumble)
    if problem.kind == "cart" and roll is None:
        raise NotTriedError("wheels with a line of contact on casters")
    if problem.kind == "cart" and roll is not None:
        return drive(problem, step, roll)
    if problem.kind not in ("slider", "planar"):
        if problem.kind == "rocking":
            raise NotExpressibleError("an impact law and small angles that are given")
        raise NotTriedError("structures of several masses")
    friction = system["friction"]
    if friction["kind"] != "coulomb":
        raise NotExpressibleError("friction other than Coulomb's")
    if friction.get("one_way") or "mu_backward" in friction:
        raise NotExpressibleError("friction that depends on the direction")
    if system.get("contact") == "clipped":
        raise NotExpressibleError("a block that keeps contact without normal force")
    if "stops" in system and not (stops and (restitution or not system["stops"]["restitution"])):
        raise NotExpressibleError("stops of a given restitution")
    if not flight and problem.id == "vertical-flight":
        raise NotExpressibleError("flight")
    start = problem.start
    x, y = (*start.get("displacement", ()), 0.0, 0.0)[:2]
    vx, vy = (*start.get("velocity", ()), 0.0, 0.0)[:2]
    parts = steps_per_sample(problem, step)
    body = Body(
        problem.dt / parts,
        friction["mu"],
        problem.kind == "planar",
        system.get("stops"),
        (x, y, vx, vy),
    )
    advance = build(body)
    angle = math.radians(system.get("slope_degrees", 0.0))
    sine, cosine = math.sin(angle), math.cos(angle)
    stiffness, damping = system.get("spring", 0.0) ** 2, system.get("damping", 0.0)
    radius = system.get("pendulum_radius", math.inf)
    peak = math.hypot(x, y)
    for n, t, weight in loads(problem, parts):
        normal = weight * cosine + n * sine
        spring = stiffness + normal / radius
        x, y, vx, vy = advance(
            weight * sine - n * cosine - spring * x - damping * vx,
            -t - spring * y - damping * vy,
            -normal,
        )
        peak = max(peak, math.hypot(x, y))
    final = [x, y] if body.planar else [x]
    return {"final_displacement": final, "peak_displacement": [peak]}


def steps_per_sample(problem: Problem, step: float) -> int:
    return max(1, math.ceil(problem.dt / step - 1e-9))


def loads(problem: Problem, parts: int) -> Iterator[tuple[float, float, float]]:
    """Means over each step: ground acceleration along and transverse, weight of a kilogram."""
    along, across, up = (problem.component(c) for c in ("along", "transverse", "vertical"))
    g = problem.system["gravity"]
    for i in range(len(along) - 1):
        for k in range(parts):
            u = (k + 0.5) / parts
            yield (
                along[i] + u * (along[i + 1] - along[i]),
                across[i] + u * (across[i + 1] - across[i]),
                g + up[i] + u * (up[i + 1] - up[i]),
            )


def rock(problem: Problem, step: float, build: Callable[[Block], Tumble]) -> Answers:
    """Step a rigid block through a problem."""
    system = problem.system
    if "lever" in system:
        raise NotExpressibleError("impacts that act within the base")
    width, height = system["width"], system["height"]
    parts = steps_per_sample(problem, step)
    block = Block(
        problem.dt / parts,
        system["mu"],
        (width, height),
        tuple(system.get("center", (0.0, height / 2))),
        system.get("gyration_radius", math.hypot(width, height) / math.sqrt(12)) ** 2,
        problem.start.get("rotation", 0.0),
    )
    tumble = build(block)
    x, rotation = 0.0, block.rotation
    peak = abs(rotation)
    for n, _, weight in loads(problem, parts):
        x, rotation = tumble(-n, -weight)
        peak = max(peak, abs(rotation))
        if abs(rotation) > math.pi / 2:
            return {"overturned": [math.copysign(1.0, rotation)]}
    return {
        "overturned": [0.0],
        "final_displacement": [block.base(x, rotation)],
        "final_rotation": [rotation],
        "peak_rotation": [peak],
    }


def drive(problem: Problem, step: float, build: Callable[[Cart], Roll]) -> Answers:
    """Step a cart through a problem."""
    system, start = problem.system, problem.start
    parts = steps_per_sample(problem, step)
    vx, vy = start.get("velocity", (0.0, 0.0))
    velocity = (vx, vy, start.get("rate", 0.0))
    roll = build(
        Cart(problem.dt / parts, system["radius_of_gyration"], system["supports"], velocity)
    )
    x = y = yaw = peak = 0.0
    for n, t, weight in loads(problem, parts):
        x, y, yaw = roll(-n, -t, -weight)
        peak = max(peak, math.hypot(x, y))
    return {"final_displacement": [x, y], "final_rotation": [yaw], "peak_displacement": [peak]}


def size() -> tuple[float, float, float]:
    """Of the block: long and flat, so that it slides and does not tip [m]."""
    return 1.0, 1.0, 0.1


def ignore(*_: Any) -> None:
    """For callbacks that an engine asks for."""
