"""OpenSees, as the comparisons drive it: a solver, and a model that is shaken."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

AVERAGE_ACCELERATION = ("Newmark", 0.5, 0.25)


def prepare(ops, kind: str, *integrator, test=("NormUnbalance", 1e-8, 50), algorithm="Newton"):
    """An analysis, such as "Transient" with `AVERAGE_ACCELERATION`."""
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.system("BandGeneral")
    ops.test(*test)
    ops.algorithm(algorithm)
    ops.integrator(*integrator)
    ops.analysis(kind)


def shake(ops, node: int, components: Sequence[np.ndarray], dt: float, steps: int, axes: int = 1):
    """Peak of |displacement| and displacement at the end of a node [m]; NaN if a step diverges.

    `components` are ground accelerations along the first axes, `axes` those of the displacement: of
    two the end is a pair.
    """
    for direction, values in enumerate(components, 1):
        tag = 100 + direction
        ops.timeSeries("Path", tag, "-dt", dt, "-values", *np.asarray(values).tolist())
        ops.pattern("UniformExcitation", tag, direction, "-accel", tag)
    peak, place = 0.0, (0.0,) * axes
    directions = range(1, axes + 1)
    for _ in range((len(components[0]) - 1) * steps):
        if ops.analyze(1, dt / steps) != 0:
            peak, place = math.nan, (math.nan,) * axes
            break
        place = [ops.nodeDisp(node, direction) for direction in directions]
        peak = max(peak, math.hypot(*place))
    return peak, place[0] if axes == 1 else np.array(place)
