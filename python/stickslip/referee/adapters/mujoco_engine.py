"""MuJoCo: soft contact, elliptic friction cones, implicit integration of the contact impulses.

A caster of a cart is a fork on a hinge and a wheel that touches the floor at two points, HALF to
each side of its middle plane, with half of its load each. With massless forks and wheels,
minimum dissipation makes it a caster with

    side_mu = MU HALF/sqrt(TRAIL^2 + HALF^2),   reach = TRAIL + HALF^2/TRAIL.

Rolling resistance is friction in the axle. It shares the contacts with the side force, and
changes it by about rolling_mu/MU.
"""

from __future__ import annotations

import math
from importlib import import_module
from typing import Any

from ..problems import Answers, NotTriedError, Problem
from ..time_steps import Advance, Block, Body, Cart, Roll, Tumble, march

NAME = "MuJoCo"
PURPOSE = "robots and their control; contacts are soft, so that a block at rest creeps"
PACKAGE, MODULE = "mujoco", "mujoco"
COSTS = (
    "steps of 5 ms, impratio 10; carts 1e4",
    "steps of 1 ms, impratio 100; carts 1e4",
    "steps of 0.2 ms, impratio 1000, noslip; carts 1e5",
)
SETTINGS = ((5e-3, 10, 0, 1e4), (1e-3, 100, 0, 1e4), (2e-4, 1000, 10, 1e5))

MODEL = """
<mujoco><option timestep="{step}" gravity="0 0 0" cone="elliptic" impratio="{impratio}"
 noslip_iterations="{noslip}" integrator="Euler" iterations="50" tolerance="1e-12"/>
<worldbody><geom name="ground" type="plane" size="50 50 1" friction="{mu} 0 0" {contact}/>
<body name="block" pos="0 0 0.05"><joint type="slide" axis="1 0 0" name="x"/>
<joint type="slide" axis="0 1 0" name="y"/><joint type="slide" axis="0 0 1" name="z"/>
<geom type="box" size="0.5 0.5 0.05" mass="1" friction="{mu} 0 0" {contact}/></body>
</worldbody></mujoco>
"""

ROCKS = """
<mujoco><option timestep="{step}" gravity="0 0 0" cone="elliptic" impratio="{impratio}"
 noslip_iterations="{noslip}" integrator="Euler" iterations="50" tolerance="1e-12"/>
<worldbody><geom name="ground" type="plane" size="50 50 1" friction="{mu} 0 0" {contact}/>
<body name="block" pos="{x} 0 {z}"><joint type="slide" axis="1 0 0"/>
<joint type="slide" axis="0 0 1"/><joint type="hinge" axis="0 1 0"/>
<inertial pos="0 0 0" mass="1" diaginertia="1 {inertia} 1"/>
<geom type="box" pos="{aside} 0 {up}" size="{half} 0.5 {tall}" friction="{mu} 0 0" {contact}/>
</body></worldbody></mujoco>
"""

# The softness of friction grows with the inverse of the masses of forks and wheels.
CART = """
<mujoco><compiler angle="radian"/>
<option timestep="{step}" gravity="0 0 0" cone="elliptic" impratio="{impratio}"
 integrator="implicitfast" solver="Newton" iterations="100" tolerance="1e-12"/>
<default><geom condim="3" friction="{mu} 0 0" solref="{softness} 1" solimp="0.99 0.99 0.001"/>
<joint solreffriction="{softness} 1" solimpfriction="0.9999 0.9999 0.001"/></default>
<worldbody><geom type="plane" size="50 50 1" contype="0" conaffinity="1"/>
<body><joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/>
<joint type="hinge" axis="0 0 1"/>{tilts}
<inertial pos="0 0 {height}" mass="1" diaginertia="{inertia} {inertia} {inertia}"/>
{wheels}</body></worldbody></mujoco>
"""
TILTS = """<joint type="slide" axis="0 0 1"/><joint type="hinge" axis="1 0 0"/>
<joint type="hinge" axis="0 1 0"/>"""
WHEEL = """
<body pos="{x} {y} {radius}" euler="0 0 {heading}">{slide}{inertial}
<joint type="hinge" axis="0 0 1"/>
<body pos="{back} 0 0"><joint name="roll {i}" type="hinge" axis="0 1 0"/>{inertial}
<geom type="sphere" size="{radius}" pos="0 {half} 0" contype="1" conaffinity="0"/>
<geom type="sphere" size="{radius}" pos="0 -{half} 0" contype="1" conaffinity="0"/></body></body>
"""
SLIDE = '<joint name="load {i}" type="slide" axis="0 0 1" armature="0.1"/>'
INERTIAL = '<inertial pos="0 0 0" mass="1e-5" diaginertia="1e-8 1e-8 1e-8"/>'
RADIUS = 0.03  # of a wheel [m]


def solve(problem: Problem, cost: int) -> Answers:
    step, impratio, noslip, impratio_of_wheels = SETTINGS[cost]
    mujoco: Any = import_module(MODULE)

    def build(body: Body) -> Advance:
        soft = f'condim="3" solref="{2.5 * body.step} 1" solimp="0.99 0.9999 0.0001"'
        model = mujoco.MjModel.from_xml_string(
            MODEL.format(step=body.step, impratio=impratio, noslip=noslip, mu=body.mu, contact=soft)
        )
        data = mujoco.MjData(model)
        x, y, vx, vy = body.start
        data.qpos[:2] = x, y
        data.qvel[:2] = vx, vy
        position, velocity, force, advance = data.qpos, data.qvel, data.qfrc_applied, mujoco.mj_step

        def step_once(fx: float, fy: float, fz: float) -> tuple[float, float, float, float]:
            force[:] = fx, fy, fz
            advance(model, data)
            x, y, _ = position.tolist()
            vx, vy, _ = velocity.tolist()
            return x, y, vx, vy

        return step_once

    def tumble(block: Block) -> Tumble:
        soft = f'condim="3" solref="{2.5 * block.step} 1" solimp="0.99 0.9999 0.0001"'
        (width, height), (aside, up) = block.size, block.center
        text = ROCKS.format(
            step=block.step, impratio=impratio, noslip=noslip, mu=block.mu, contact=soft,
            x=aside, z=up, inertia=block.inertia, aside=-aside, up=height / 2 - up,
            half=width / 2, tall=height / 2,
        )  # fmt: skip
        model = mujoco.MjModel.from_xml_string(text)
        data = mujoco.MjData(model)
        x, z = block.at()
        data.qpos[:] = x - aside, z - up, block.rotation
        start = x - aside

        def step_once(fx: float, fz: float) -> tuple[float, float]:
            data.qfrc_applied[:] = fx, fz, 0.0
            mujoco.mj_step(model, data)
            x, _, rotation = data.qpos.tolist()
            return x - start, rotation

        return step_once

    return march(
        problem,
        step,
        build,
        tumble=tumble,
        roll=lambda cart: roll(mujoco, cart, impratio_of_wheels),
        stops=False,
    )


def roll(
    mujoco: Any, cart: Cart, impratio: float, *, mu: float = 1.0, height: float | None = None
) -> Roll:
    """Build a cart on casters.

    Parameters
    ----------
    mu : float
        Between wheels and floor: above every side_mu.
    height : float, optional
        Of the center of mass above the floor [m], for a rigid body whose loads shift. Default: each
        fork slides along its pivot, pressed down by its share of the load; the armature adds
        inertia to this slide alone.
    """
    if not all("reach" in one for one in cart.supports):
        raise NotTriedError("wheels that do not swivel")
    wheels = ""
    for i, one in enumerate(cart.supports):
        trail = one["reach"] * (1 - (one["side_mu"] / mu) ** 2)
        x, y = one["at"]
        wheels += WHEEL.format(
            i=i, x=x, y=y, heading=one["heading"], back=-trail, radius=RADIUS,
            half=math.sqrt(trail * (one["reach"] - trail)), inertial=INERTIAL,
            slide=SLIDE.format(i=i) if height is None else "",
        )  # fmt: skip
    model = mujoco.MjModel.from_xml_string(
        CART.format(
            step=cart.step, impratio=impratio, softness=2.5 * cart.step, mu=mu, wheels=wheels,
            inertia=cart.radius_of_gyration**2, height=height or 0,
            tilts="" if height is None else TILTS,
        )
    )  # fmt: skip
    data = mujoco.MjData(model)
    data.qvel[:3] = cart.velocity
    gravity, position, advance = model.opt.gravity, data.qpos, mujoco.mj_step
    load = 0.0

    def step_once(fx: float, fy: float, fz: float) -> tuple[float, float, float]:
        nonlocal load
        if fz != load:
            load = fz
            for i, one in enumerate(cart.supports):
                force = one["share"] * fz
                axle = model.joint(f"roll {i}").dofadr[0]
                model.dof_frictionloss[axle] = one["rolling_mu"] * RADIUS * max(-force, 0.0)
                if height is None:
                    data.qfrc_applied[model.joint(f"load {i}").dofadr[0]] = force
        gravity[:] = fx, fy, 0.0 if height is None else fz
        advance(model, data)
        x, y, yaw = position[:3].tolist()
        return x, y, yaw

    return step_once
