"""SciPy's `solve_ivp` with events, one segment of the record at a time."""

from __future__ import annotations

import math
from importlib import import_module
from typing import Any

from .. import event_loop
from ..equations import Load, Model, Numbers, State
from ..problems import Answers, Problem

NAME = "SciPy solve_ivp"
PURPOSE = "ordinary differential equations; the user writes the equations and the events"
PACKAGE, MODULE = "scipy", "scipy.integrate"
COSTS = ("RK45, rtol 1e-4", "DOP853, rtol 1e-8", "DOP853, rtol 1e-12")
SETTINGS = (("RK45", 1e-4, 1e-5), ("DOP853", 1e-8, 1e-7), ("DOP853", 1e-12, 3e-8))


def exponential(number: float) -> float:
    return math.exp(min(number, 700.0))  # a trial step may leave the speeds of the law


def solve(problem: Problem, cost: int) -> Answers:
    solve_ivp: Any = import_module(MODULE).solve_ivp

    method, rtol, crawl = SETTINGS[cost]
    numbers = Numbers(
        exp=exponential,
        sqrt=lambda one: math.sqrt(one) or 1e-300,
        speed=max(1e-2 * rtol, 1e-10),
        crawl=crawl,
    )

    def piece(
        model: Model, mode: Any, state: State, load: Load, rates: Load, left: float
    ) -> tuple[float, Any, State, float]:
        now = list(state)

        def at(t: float) -> list[float]:
            return [a + b * t for a, b in zip(load, rates, strict=True)]

        def rate(t: float, y: Any) -> Any:
            return model.field(mode, list(y), at(t))

        names = [name for name, _ in model.guards(mode, now, list(load), now)]

        def guard(k: int) -> Any:
            def value(t: float, y: Any) -> float:
                return float([*model.guards(mode, list(y), at(t), now)][k][1])

            value.terminal, value.direction = True, -1.0  # type: ignore[attr-defined]
            return value

        def turning(t: float, y: Any) -> float:
            return float(model.turning(list(y)))

        r = solve_ivp(
            rate,
            (0.0, left),
            now,
            method=method,
            events=[*(guard(k) for k in range(len(names))), turning],
            rtol=rtol,
            atol=1e-3 * rtol,
            first_step=None if left < 1e-6 else left / 4,
        )
        if r.status < 0:
            raise ArithmeticError(r.message)
        end = [float(one) for one in r.y[:, -1]]
        seen = [end, *(list(one) for one in r.y_events[-1])]
        found = [k for k in range(len(names)) if len(r.t_events[k])]
        name = names[found[0]] if r.status == 1 and found else None
        return float(r.t[-1]), name, end, max(abs(float(model.watched(one))) for one in seen)

    return event_loop.solve(problem, numbers, piece)
