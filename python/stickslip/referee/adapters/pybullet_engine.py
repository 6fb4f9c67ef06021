"""PyBullet: sequential impulses."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from ..problems import Answers, Problem
from ..time_steps import Advance, Body, march

NAME = "PyBullet"
PURPOSE = "robots, games and pictures; many bodies in contact, quickly"
PACKAGE, MODULE = "pybullet", "pybullet"
COSTS = (
    "steps of 5 ms, 50 iterations",
    "steps of 1 ms, 50 iterations",
    "steps of 0.2 ms, 50 iterations",
)
STEPS = (5e-3, 1e-3, 2e-4)


def solve(problem: Problem, cost: int) -> Answers:
    bullet: Any = import_module(MODULE)
    world = bullet.connect(bullet.DIRECT)
    try:
        return march(problem, STEPS[cost], lambda body: build(bullet, body))
    finally:
        bullet.disconnect(world)


def build(bullet: Any, body: Body) -> Advance:
    bullet.resetSimulation()
    bullet.setPhysicsEngineParameter(
        fixedTimeStep=body.step,
        numSolverIterations=50,
        numSubSteps=0,
        enableConeFriction=1,
        solverResidualThreshold=0,
        restitutionVelocityThreshold=1e-4,
    )
    ground = bullet.createMultiBody(
        0, bullet.createCollisionShape(bullet.GEOM_BOX, halfExtents=[20, 20, 1]), -1, [0, 0, -1]
    )
    block = bullet.createMultiBody(
        1,
        bullet.createCollisionShape(bullet.GEOM_BOX, halfExtents=[0.5, 0.5, 0.05]),
        -1,
        [0, 0, 0.05],
    )
    x, y, vx, vy = body.start
    bullet.resetBasePositionAndOrientation(block, [x, y, 0.05], [0, 0, 0, 1])
    bullet.resetBaseVelocity(block, [vx, vy, 0], [0, 0, 0])
    for one, friction in ((ground, 1.0), (block, body.mu)):
        bullet.changeDynamics(
            one,
            -1,
            lateralFriction=friction,
            restitution=0,
            linearDamping=0,
            angularDamping=0,
            localInertiaDiagonal=[1e9, 1e9, 1e9] if one == block else [0, 0, 0],
            activationState=bullet.ACTIVATION_STATE_DISABLE_SLEEPING if one == block else 0,
            contactProcessingThreshold=1e-3,
        )
    if body.stops:
        wall = bullet.createCollisionShape(bullet.GEOM_BOX, halfExtents=[1, 20, 5])
        for side in (1, -1):
            place = [side * (body.stops["gap"] + 1.5), 0, 0]
            one = bullet.createMultiBody(0, wall, -1, place)
            bullet.changeDynamics(one, -1, lateralFriction=0, restitution=1)
        bullet.changeDynamics(block, -1, restitution=body.stops["restitution"])
    origin = [0, 0, 0]

    def advance(fx: float, fy: float, fz: float) -> tuple[float, float, float, float]:
        bullet.applyExternalForce(block, -1, [fx, fy, fz], origin, bullet.LINK_FRAME)
        bullet.stepSimulation()
        place, _ = bullet.getBasePositionAndOrientation(block)
        speed, _ = bullet.getBaseVelocity(block)
        return place[0], place[1], speed[0], speed[1]

    return advance
