"""DART: rigid contact as a linear complementarity problem in each step."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from ..problems import Answers, Problem
from ..time_steps import Advance, Body, march

NAME = "DART"
PURPOSE = "robots and characters, with rigid contact"
PACKAGE, MODULE = "dartpy", "dartpy"
COSTS = ("steps of 5 ms", "steps of 1 ms", "steps of 0.2 ms")
STEPS = (5e-3, 1e-3, 2e-4)


def solve(problem: Problem, cost: int) -> Answers:
    dart: Any = import_module(MODULE)
    return march(problem, STEPS[cost], lambda body: build(dart, body), stops=False)


def build(dart: Any, body: Body) -> Advance:
    world = dart.simulation.World()
    world.setGravity([0, 0, 0])
    world.setTimeStep(body.step)

    def box(name: str, size: list[float], place: list[float], mobile: bool) -> Any:
        skeleton = dart.dynamics.Skeleton(name)
        if mobile:
            joint, node = skeleton.createTranslationalJointAndBodyNodePair()
        else:
            joint, node = skeleton.createWeldJointAndBodyNodePair()
        shape = node.createShapeNode(dart.dynamics.BoxShape(size))
        shape.createVisualAspect()
        shape.createCollisionAspect()
        shape.createDynamicsAspect()
        shape.getDynamicsAspect().setFrictionCoeff(body.mu if mobile else 1.0)
        at = dart.math.Isometry3()
        at.set_translation(place)
        joint.setTransformFromParentBodyNode(at)
        world.addSkeleton(skeleton)
        return skeleton

    box("ground", [100, 100, 1], [0, 0, -0.5], False)
    block = box("block", [1, 1, 0.1], [0, 0, 0.05], True)
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
