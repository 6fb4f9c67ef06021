"""MuJoCo: soft contact, elliptic friction cones, implicit integration of the contact impulses."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from ..problems import Answers, Problem
from ..time_steps import Advance, Block, Body, Tumble, march

NAME = "MuJoCo"
PURPOSE = "robots and their control; contacts are soft, so that a block at rest creeps"
PACKAGE, MODULE = "mujoco", "mujoco"
COSTS = (
    "steps of 5 ms, impratio 10",
    "steps of 1 ms, impratio 100",
    "steps of 0.2 ms, impratio 1000, noslip",
)
SETTINGS = ((5e-3, 10, 0), (1e-3, 100, 0), (2e-4, 1000, 10))

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


def solve(problem: Problem, cost: int) -> Answers:
    step, impratio, noslip = SETTINGS[cost]
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

    return march(problem, step, build, tumble=tumble, stops=False)
