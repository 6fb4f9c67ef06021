"""PyBullet: sequential impulses."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from ..problems import Answers, Problem
from ..time_steps import Advance, Block, Body, Tumble, march

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
        return march(
            problem,
            STEPS[cost],
            lambda body: build(bullet, body),
            tumble=lambda one: rock(bullet, one),
        )
    finally:
        bullet.disconnect(world)


def prepare(bullet: Any, step: float) -> int:
    """Sets the engine, and makes the ground."""
    bullet.resetSimulation()
    bullet.setPhysicsEngineParameter(
        fixedTimeStep=step,
        numSolverIterations=50,
        numSubSteps=0,
        enableConeFriction=1,
        solverResidualThreshold=0,
        restitutionVelocityThreshold=1e-4,
    )
    box = bullet.createCollisionShape(bullet.GEOM_BOX, halfExtents=[20, 20, 1])
    return int(bullet.createMultiBody(0, box, -1, [0, 0, -1]))


def build(bullet: Any, body: Body) -> Advance:
    ground = prepare(bullet, body.step)
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


def rock(bullet: Any, block: Block) -> Tumble:
    """A block on two sliders and a hinge, so that it stays in its plane."""
    ground = prepare(bullet, block.step)
    (width, height), (aside, up) = block.size, block.center
    shape = bullet.createCollisionShape(
        bullet.GEOM_BOX,
        halfExtents=[width / 2, 0.5, height / 2],
        collisionFramePosition=[-aside, 0, height / 2 - up],
    )
    # The links before the block have next to no mass.
    cart = bullet.createMultiBody(
        0,
        -1,
        -1,
        [0, 0, 0],
        linkMasses=[1e-6, 1e-6, 1],
        linkCollisionShapeIndices=[-1, -1, shape],
        linkVisualShapeIndices=[-1, -1, -1],
        linkPositions=[[0, 0, 0]] * 3,
        linkOrientations=[[0, 0, 0, 1]] * 3,
        linkInertialFramePositions=[[0, 0, 0]] * 3,
        linkInertialFrameOrientations=[[0, 0, 0, 1]] * 3,
        linkParentIndices=[0, 1, 2],
        linkJointTypes=[bullet.JOINT_PRISMATIC, bullet.JOINT_PRISMATIC, bullet.JOINT_REVOLUTE],
        linkJointAxis=[[1, 0, 0], [0, 0, 1], [0, 1, 0]],
    )
    for one, link, friction in ((ground, -1, 1.0), (cart, 2, block.mu)):
        bullet.changeDynamics(one, link, lateralFriction=friction, restitution=0)
    bullet.changeDynamics(cart, 2, localInertiaDiagonal=[1, block.inertia, 1])
    bullet.changeDynamics(cart, -1, linearDamping=0, angularDamping=0, jointDamping=0)
    at = block.at()
    for joint, value in enumerate((*at, block.rotation)):
        bullet.changeDynamics(cart, joint, jointDamping=0, linearDamping=0, angularDamping=0)
        bullet.resetJointState(cart, joint, value)
        bullet.setJointMotorControl2(cart, joint, bullet.VELOCITY_CONTROL, force=0)

    def tumble(fx: float, fz: float) -> tuple[float, float]:
        for joint, force in ((0, fx), (1, fz)):
            bullet.setJointMotorControl2(cart, joint, bullet.TORQUE_CONTROL, force=force)
        bullet.stepSimulation()
        return bullet.getJointState(cart, 0)[0] - at[0], bullet.getJointState(cart, 2)[0]

    return tumble
