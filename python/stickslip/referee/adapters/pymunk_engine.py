"""pymunk: sequential impulses in two dimensions.

A block on one axis lies on a segment under its weight. In the plane, seen from above, friction is a
joint with a largest force, as the makers of the engine advise.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

from ..problems import Answers, Problem
from ..time_steps import Advance, Block, Body, Tumble, march

NAME = "pymunk"
PURPOSE = "games and teaching in two dimensions"
PACKAGE, MODULE = "pymunk", "pymunk"
COSTS = ("steps of 5 ms", "steps of 1 ms", "steps of 0.2 ms")
STEPS = (5e-3, 1e-3, 2e-4)


def solve(problem: Problem, cost: int) -> Answers:
    pymunk: Any = import_module(MODULE)
    return march(
        problem, STEPS[cost], lambda body: build(pymunk, body), tumble=lambda one: rock(pymunk, one)
    )


def empty_space(pymunk: Any) -> Any:
    space = pymunk.Space()
    space.iterations = 30
    space.gravity = 0, 0
    space.collision_slop = 1e-5
    space.sleep_time_threshold = float("inf")
    return space


def build(pymunk: Any, body: Body) -> Advance:
    space = empty_space(pymunk)
    block = pymunk.Body(1, float("inf"))
    x, y, vx, vy = body.start
    block.velocity = vx, vy
    block.position = (x, y) if body.planar else (x, 0.05)
    shape = pymunk.Poly.create_box(block, (1, 0.1))
    space.add(block, shape)
    static = space.static_body
    joint: Any = None
    if body.planar:
        shape.sensor = True
        joint = pymunk.PivotJoint(static, block, (0, 0), (0, 0))
        joint.max_bias = 0
        space.add(joint)
    else:
        shape.friction = body.mu
        ground = pymunk.Segment(static, (-50, -1), (50, -1), 1)
        ground.friction = 1
        space.add(ground)
    if body.stops:
        for side in (1, -1):
            at = side * (body.stops["gap"] + 1.5)
            wall = pymunk.Segment(static, (at, -1), (at, 3), 1)
            wall.elasticity = 1
            space.add(wall)
        shape.elasticity = body.stops["restitution"]

    def advance(fx: float, fy: float, fz: float) -> tuple[float, float, float, float]:
        if body.planar:
            joint.max_force = body.mu * max(-fz, 0.0)
            block.force = fx, fy
        else:
            block.force = fx, fz
        space.step(body.step)
        (x, y), (vx, vy) = block.position, block.velocity
        return x, y if body.planar else 0.0, vx, vy if body.planar else 0.0

    return advance


def rock(pymunk: Any, block: Block) -> Tumble:
    space = empty_space(pymunk)
    (width, height), (aside, up) = block.size, block.center
    at = block.at()
    body = pymunk.Body(1, block.inertia)
    body.position, body.angle = at, -block.rotation
    left, right, low, high = -width / 2 - aside, width / 2 - aside, -up, height - up
    shape = pymunk.Poly(body, [(left, low), (right, low), (right, high), (left, high)])
    shape.friction = block.mu
    ground = pymunk.Segment(space.static_body, (-50, -1), (50, -1), 1)
    ground.friction = 1
    space.add(body, shape, ground)

    def tumble(fx: float, fz: float) -> tuple[float, float]:
        body.apply_force_at_world_point((fx, fz), body.position)
        space.step(block.step)
        return body.position.x - at[0], -body.angle

    return tumble
