"""stickslip itself: exact between events."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np

import stickslip as ss

from ..problems import Answers, NotExpressibleError, Problem

NAME = "stickslip"
PURPOSE = "how far things held by friction slide in earthquakes"
PACKAGE, MODULE = "stickslip", "stickslip"
COSTS = ("its only setting",)


def law_of(friction: Any) -> ss.FrictionLaw:
    kind = friction["kind"]
    if kind == "coulomb":
        return ss.Coulomb(mu=friction["mu"], mu_backward=friction.get("mu_backward"))
    if kind == "static_kinetic":
        return ss.StaticKinetic(mu_static=friction["mu_static"], mu_kinetic=friction["mu_kinetic"])
    if kind == "velocity":
        return ss.VelocityDependent(
            mu_slow=friction["mu_slow"], mu_fast=friction["mu_fast"], rate=friction["rate"]
        )
    if kind == "stribeck":
        return ss.Stribeck(
            mu_static=friction["mu_static"],
            mu_kinetic=friction["mu_kinetic"],
            velocity=friction["velocity"],
            exponent=friction["exponent"],
        )
    if kind == "series":
        elements = friction["elements"]
        return ss.MultiPendulum(
            radii=[e["radius"] for e in elements],
            mu=[e["mu"] for e in elements],
            capacities=[e["capacity"] for e in elements],
        )
    raise NotExpressibleError(f"friction {kind!r}")


def slider_of(system: Any) -> ss.Slider:
    stops = system.get("stops")
    law = law_of(system["friction"])
    if system["friction"]["kind"] == "series":
        return ss.Slider(law)
    common: dict[str, Any] = {
        "damping": system.get("damping", 0.0),
        "stops": stops and ss.Stops(gap=stops["gap"], restitution=stops["restitution"]),
    }
    if "pendulum_radius" in system:
        return ss.FrictionPendulum(radius=system["pendulum_radius"], law=law, **common)
    return ss.Slider(
        law,
        natural_frequency=system.get("spring", 0.0),
        slope_degrees=system.get("slope_degrees", 0.0),
        one_way=system["friction"].get("one_way", False),
        **common,
    )


def motion_of(problem: Problem) -> ss.GroundMotion:
    across = problem.kind in ("planar", "cart")
    with warnings.catch_warnings():
        # Loads that are held are no records: their baseline is meant.
        warnings.simplefilter("ignore", ss.PlausibilityWarning)
        return ss.GroundMotion(
            problem.component("along"),
            dt=problem.dt,
            transverse=problem.component("transverse") if across else None,
            vertical=problem.component("vertical") if problem.has("vertical") else None,
        )


def system_of(problem: Problem) -> ss.IsolatedStructure | ss.EquipmentOnFloor | ss.FlexibleSlope:
    system = problem.system
    if problem.kind == "floor":
        floor = system["floor"]
        w = floor["frequency"]
        one = ss.Structure(
            mass=[[1.0]], damping=[[2 * floor["damping_ratio"] * w]], stiffness=[[w * w]]
        )
        return ss.EquipmentOnFloor(slider_of(system), one, floor=1, mass=floor["mass_ratio"])
    if "column" in system:
        column = system["column"]
        return ss.FlexibleSlope(
            ky_g=system["friction"]["mu"],
            height=column["height"],
            shear_velocity=column["shear_velocity"],
            damping_ratio=column["damping_ratio"],
            modes=len(system["modes"]),
            method="decoupled" if system.get("decoupled") else "coupled",
        )
    modes = ss.Structure.from_modes(
        mass_fractions=[m["mass_fraction"] for m in system["modes"]],
        frequencies=[m["frequency"] for m in system["modes"]],
        damping_ratios=[m["damping_ratio"] for m in system["modes"]],
    )
    return ss.IsolatedStructure(slider_of(system), modes)


def cart_of(system: Any) -> ss.Cart:
    supports: list[ss.SwivelCaster | ss.FixedWheel] = []
    for one in system["supports"]:
        common = {name: one[name] for name in ("at", "heading", "rolling_mu", "share")}
        if "reach" in one:
            level = one["side_mu"] * system["gravity"]
            supports.append(ss.SwivelCaster(**common, slip_level=level, reach=one["reach"]))
        else:
            supports.append(ss.FixedWheel(**common, mu=one["side_mu"]))
    return ss.Cart(supports, radius_of_gyration=system["radius_of_gyration"])


def rigid(problem: Problem, quake: ss.GroundMotion) -> Answers:
    system, start = problem.system, problem.start
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ss.PlausibilityWarning)
        block = ss.RockingBlock(
            width=system["width"],
            height=system["height"],
            mu=system.get("mu"),
            lever=system.get("lever"),
            center=system.get("center"),
            gyration_radius=system.get("gyration_radius"),
        )
    r = ss.integrate(block, quake, rotation=start.get("rotation", 0.0), rate=start.get("rate", 0.0))
    if r.overturned is not None:
        return {"overturned": [1.0 if r.overturned == "right" else -1.0]}
    return {
        "overturned": [0.0],
        "final_displacement": [r.residual],
        "final_rotation": [float(r.rotation[-1])],
        "peak_rotation": [r.peak_rotation],
    }


def solve(problem: Problem, cost: int) -> Answers:
    system, start = problem.system, problem.start
    quake = motion_of(problem)
    if problem.kind == "rocking":
        block = ss.SlenderBlock(
            p=system["p"],
            alpha=system["alpha"],
            restitution=system["restitution"],
            alpha_left=system.get("alpha_left"),
        )
        rocked = ss.integrate(
            block, quake, rotation=start.get("rotation", 0.0), rate=start.get("rate", 0.0)
        )
        fell = {None: 0.0, "right": 1.0, "left": -1.0}[rocked.overturned]
        if fell:
            return {"overturned": [fell]}
        return {
            "overturned": [fell],
            "final_rotation": [float(rocked.rotation[-1])],
            "peak_rotation": [rocked.peak_rotation],
        }
    if problem.kind == "rigid_block":
        return rigid(problem, quake)
    if problem.kind == "cart":
        rolled = ss.integrate(
            cart_of(system),
            quake,
            velocity=start.get("velocity", [0.0, 0.0]),
            yaw_rate=start.get("rate", 0.0),
        )
        return {
            "final_displacement": rolled.residual.tolist(),
            "final_rotation": [rolled.residual_yaw],
            "peak_displacement": [rolled.peak],
        }
    if problem.kind == "planar":
        r = ss.integrate(
            ss.PlanarSlider(slider_of(system)),
            quake,
            displacement=start.get("displacement", [0.0, 0.0]),
            velocity=start.get("velocity", [0.0, 0.0]),
        )
        return {"final_displacement": np.ravel(r.residual).tolist(), "peak_displacement": [r.peak]}
    place = {name: start[name][0] for name in ("displacement", "velocity") if name in start}
    if problem.kind == "slider":
        s = ss.integrate(slider_of(system), quake, contact=system.get("contact", "flight"), **place)
        return {"final_displacement": [s.residual], "peak_displacement": [s.peak]}
    if problem.kind in ("isolated", "floor"):
        integrate: Any = ss.integrate
        t = integrate(system_of(problem), quake, **place)
        return {"final_displacement": [t.residual], "peak_displacement": [t.peak]}
    raise NotExpressibleError(f"system {problem.kind!r}")
