"""pySLAMMER: the rigid, the decoupled and the coupled analysis of one mode."""

from __future__ import annotations

from importlib import import_module
from typing import Any

import numpy as np

from ..problems import Answers, NotExpressibleError, Problem

NAME = "pySLAMMER"
PURPOSE = "displacements of slopes by Newmark's method and its extensions"
PACKAGE, MODULE = "pyslammer", "pyslammer"
COSTS = ("the samples of the record", "8 steps a sample", "64 steps a sample")
PARTS = (1, 8, 64)


def solve(problem: Problem, cost: int) -> Answers:
    system = problem.system
    if problem.kind in ("rigid_block", "cart"):
        raise NotExpressibleError("what does not only slide")
    friction = system.get("friction", {})
    if not friction.get("one_way"):
        raise NotExpressibleError("sliding in both directions")
    others = {"spring", "stops", "pendulum_radius", "slope_degrees", "damping"} & set(system)
    if others or problem.has("vertical") or friction["kind"] != "coulomb":
        raise NotExpressibleError("more than a constant yield acceleration under one component")
    column = system.get("column")
    if problem.kind == "isolated" and (column is None or len(system["modes"]) != 1):
        raise NotExpressibleError("structures other than a soil column of one mode")
    slam: Any = import_module(MODULE)
    samples = np.array(problem.component("along"))
    count = (len(samples) - 1) * PARTS[cost] + 1
    finer = np.interp(np.arange(count) / PARTS[cost], np.arange(len(samples)), samples)
    g = system["gravity"]
    motion = slam.GroundMotion(finer / g, problem.dt / PARTS[cost])
    # Its positive direction of sliding is opposite to ours.
    if column is None:
        done = slam.RigidAnalysis(friction["mu"], motion, inverse=True)
    else:
        analysis = slam.Decoupled if system.get("decoupled") else slam.Coupled
        done = analysis(
            ky=friction["mu"],
            ground_motion=motion,
            height=column["height"],
            vs_slope=column["shear_velocity"],
            vs_base=1e9,
            damp_ratio=column["damping_ratio"],
            inverse=True,
        )
    peak = float(done.max_sliding_disp)
    return {"final_displacement": [peak], "peak_displacement": [peak]}
