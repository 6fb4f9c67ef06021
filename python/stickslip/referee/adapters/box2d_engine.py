"""Box2D: sequential impulses in two dimensions, in single precision.

A block on one axis lies on the ground under its weight. In the plane, seen from above, friction
is a friction joint with a largest force.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

from ..problems import Answers, Problem
from ..time_steps import Advance, Block, Body, Tumble, march

NAME = "Box2D"
PURPOSE = "games in two dimensions, in single precision"
PACKAGE, MODULE = "box2d", "Box2D"
COSTS = ("steps of 5 ms", "steps of 1 ms", "steps of 0.2 ms")
STEPS = (5e-3, 1e-3, 2e-4)


def solve(problem: Problem, cost: int) -> Answers:
    box: Any = import_module(MODULE)
    return march(
        problem, STEPS[cost], lambda body: build(box, body), tumble=lambda one: rock(box, one)
    )


def build(box: Any, body: Body) -> Advance:
    world = box.b2World(gravity=(0, 0), doSleep=False)
    world.warmStarting = True
    x, y, vx, vy = body.start
    ground = world.CreateStaticBody(position=(0, 0))
    height = 0.05
    place = (x, y) if body.planar else (x, height)
    block = world.CreateDynamicBody(
        position=place, fixedRotation=True, allowSleep=False, bullet=True
    )
    block.linearVelocity = vx, vy
    fixture = block.CreatePolygonFixture(box=(0.5, height), density=10, friction=body.mu)
    fixture.friction = body.mu**2  # Box2D takes the root of the product; the ground has 1
    joint: Any = None
    if body.planar:
        fixture.sensor = True
        joint = world.CreateFrictionJoint(bodyA=ground, bodyB=block, maxForce=0.0, maxTorque=0.0)
    else:
        ground.CreateEdgeFixture(vertices=[(-50, 0), (50, 0)], friction=1)
    if body.stops:
        for side in (1, -1):
            at = side * (body.stops["gap"] + 0.5)
            ground.CreateEdgeFixture(
                vertices=[(at, 0.02), (at, 2)], friction=0, restitution=body.stops["restitution"]
            )

    def advance(fx: float, fy: float, fz: float) -> tuple[float, float, float, float]:
        if body.planar:
            joint.maxForce = body.mu * max(-fz, 0.0)
        block.ApplyForce((fx, fy if body.planar else fz), block.worldCenter, True)
        world.Step(body.step, 20, 10)
        world.ClearForces()
        (x, y), (vx, vy) = block.position, block.linearVelocity
        return x, y if body.planar else 0.0, vx, vy if body.planar else 0.0

    return advance


def rock(box: Any, block: Block) -> Tumble:
    world = box.b2World(gravity=(0, 0), doSleep=False)
    ground = world.CreateStaticBody(position=(0, 0))
    ground.CreateEdgeFixture(vertices=[(-50, 0), (50, 0)], friction=1)
    (width, height), (aside, up) = block.size, block.center
    at = block.at()
    body = world.CreateDynamicBody(position=at, angle=-block.rotation, allowSleep=False)
    shape = box.b2PolygonShape(box=(width / 2, height / 2, (-aside, height / 2 - up), 0))
    body.CreateFixture(shape=shape, density=1, friction=block.mu**2, restitution=0)
    body.massData = box.b2MassData(mass=1, center=(0, 0), I=block.inertia)

    def tumble(fx: float, fz: float) -> tuple[float, float]:
        body.ApplyForce((fx, fz), body.worldCenter, True)
        world.Step(block.step, 20, 10)
        world.ClearForces()
        return body.position[0] - at[0], -body.angle

    return tumble
