"""DART: rigid contact as a complementarity problem in each step.

By default each direction of friction has its own bound, so that the plane is two problems of one
axis. There the cone of friction is that of its other solver (NSGS), which is slower.
"""

from __future__ import annotations

import math
from importlib import import_module
from typing import Any

from ..problems import Answers, Problem
from ..time_steps import Advance, Block, Body, Tumble, march

NAME = "DART"
PURPOSE = "robots and characters, with rigid contact"
PACKAGE, MODULE = "dartpy", "dartpy"
COSTS = ("steps of 5 ms", "steps of 1 ms", "steps of 0.2 ms")
STEPS = (5e-3, 1e-3, 2e-4)


def solve(problem: Problem, cost: int) -> Answers:
    dart: Any = import_module(MODULE)
    return march(
        problem,
        STEPS[cost],
        lambda body: build(dart, body),
        tumble=lambda one: rock(dart, one),
        stops=False,
    )


def on_ground(dart: Any, step: float, mu: float, joint: str, size: list[float]) -> tuple[Any, Any]:
    """A world with the ground, and a box on it that this kind of joint lets move."""
    world = dart.simulation.World()
    world.setGravity([0, 0, 0])
    world.setTimeStep(step)

    def box(kind: str, size: list[float], up: float, friction: float) -> Any:
        skeleton = dart.dynamics.Skeleton(kind)
        joint, node = getattr(skeleton, f"create{kind}JointAndBodyNodePair")()
        shape = node.createShapeNode(dart.dynamics.BoxShape(size))
        shape.createVisualAspect()
        shape.createCollisionAspect()
        shape.createDynamicsAspect()
        shape.getDynamicsAspect().setFrictionCoeff(friction)
        at = dart.math.Isometry3()
        at.set_translation([0, 0, up])
        joint.setTransformFromParentBodyNode(at)
        world.addSkeleton(skeleton)
        return skeleton

    box("Weld", [100, 100, 1], -0.5, 1.0)
    return world, box(joint, size, size[2] / 2, mu)


def build(dart: Any, body: Body) -> Advance:
    world, block = on_ground(dart, body.step, body.mu, "Translational", [1, 1, 0.1])
    if body.planar:
        cone = dart.constraint.NsgsFrictionSolver()
        world.getConstraintSolver().setBoxedLcpSolver(cone)
    block.getBodyNode(0).setMass(1.0)
    x, y, vx, vy = body.start
    block.setPositions([x, y, 0])
    block.setVelocities([vx, vy, 0])

    def advance(fx: float, fy: float, fz: float) -> tuple[float, float, float, float]:
        block.setForces([fx, fy, fz])
        world.step()
        x, y, _ = block.getPositions()
        vx, vy, _ = block.getVelocities()
        return float(x), float(y), float(vx), float(vy)

    return advance


def rock(dart: Any, block: Block) -> Tumble:
    (width, height), (aside, up) = block.size, block.center
    world, body = on_ground(dart, block.step, block.mu, "Planar", [width, 1, height])
    joint, node = body.getJoint(0), body.getBodyNode(0)
    joint.setZXPlane()  # z, x and a rotation that is positive to the right
    middle = [aside, 0, up - height / 2]
    node.setInertia(
        dart.dynamics.Inertia(1.0, middle, [[1, 0, 0], [0, block.inertia, 0], [0, 0, 1]])
    )
    # The joint moves the middle of the box.
    lean, at = block.rotation, block.at()

    def place(rotation: float) -> tuple[float, float]:
        sine, cosine = math.sin(rotation), math.cos(rotation)
        return (
            middle[0] * cosine + middle[2] * sine,
            middle[2] * cosine - middle[0] * sine,
        )

    x, z = place(lean)
    body.setPositions([at[1] - z - height / 2, at[0] - x, lean])

    def tumble(fx: float, fz: float) -> tuple[float, float]:
        node.addExtForce([fx, 0, fz], middle, False, True)
        world.step()
        _, x, rotation = (float(q) for q in body.getPositions())
        return x + place(rotation)[0] - at[0], rotation

    return tumble
