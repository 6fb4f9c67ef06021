"""A block for tools that advance in time steps: engines for rigid bodies.

The ground stays at rest, and the block feels the ground acceleration as a force (an inclined ground
turns the forces). Within a step the force is held at its mean. A block weighs 1 kg, so that forces
are accelerations.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
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


def march(
    problem: Problem,
    step: float,
    build: Callable[[Body], Advance],
    *,
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
    stops, restitution, flight : bool
        What the engine offers.
    """
    system = problem.system
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
    parts = max(1, math.ceil(problem.dt / step - 1e-9))
    body = Body(
        problem.dt / parts,
        friction["mu"],
        problem.kind == "planar",
        system.get("stops"),
        (x, y, vx, vy),
    )
    advance = build(body)
    along, across, up = (problem.component(c) for c in ("along", "transverse", "vertical"))
    g = system["gravity"]
    angle = math.radians(system.get("slope_degrees", 0.0))
    sine, cosine = math.sin(angle), math.cos(angle)
    stiffness, damping = system.get("spring", 0.0) ** 2, system.get("damping", 0.0)
    radius = system.get("pendulum_radius", math.inf)
    peak = math.hypot(x, y)
    for i in range(len(along) - 1):
        for k in range(parts):
            u = (k + 0.5) / parts
            n = along[i] + u * (along[i + 1] - along[i])
            t = across[i] + u * (across[i + 1] - across[i])
            weight = g + up[i] + u * (up[i + 1] - up[i])
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


def size() -> tuple[float, float, float]:
    """Of the block: long and flat, so that it slides and does not tip [m]."""
    return 1.0, 1.0, 0.1


def ignore(*_: Any) -> None:
    """For callbacks that an engine asks for."""
