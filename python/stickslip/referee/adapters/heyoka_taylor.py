"""heyoka.py: Taylor series with events, compiled for each mode of a problem."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from .. import event_loop
from ..equations import Load, Model, Numbers, State
from ..problems import Answers, NotTriedError, Problem

NAME = "heyoka.py"
PURPOSE = "ordinary differential equations by Taylor series; the user writes equations and events"
PACKAGE, MODULE = "heyoka", "heyoka"
COSTS = ("tolerance 1e-5", "tolerance 1e-9", "tolerance 1e-16")
TOLERANCES = (1e-5, 1e-9, 1e-16)


def solve(problem: Problem, cost: int) -> Answers:
    hy: Any = import_module(MODULE)

    if problem.kind == "slider" and problem.system["friction"]["kind"] == "series":
        raise NotTriedError("guards that depend on where each element stands")
    if problem.kind == "rigid_block":
        raise NotTriedError("large rotations")
    if problem.kind == "cart":
        raise NotTriedError("guards that depend on where each wheel points")
    numbers = Numbers(crawl=1e-7 if cost else 1e-5, speed=1e-6)
    symbolic = Numbers(
        number=lambda one: one, value=lambda one: one, exp=hy.exp, sqrt=hy.sqrt, crawl=numbers.crawl
    )
    compiled: dict[Any, Any] = {}

    def compile_mode(model: Model, mode: Any, size: int) -> Any:
        same = type(model)(problem.system, symbolic)
        variables = list(hy.make_vars(*(f"s{k}" for k in range(size))))
        if size == 1:
            variables = [hy.make_vars("s0")]
        load = [hy.par[2 * k] + hy.par[2 * k + 1] * hy.time for k in range(3)]
        field = [hy.expression(0.0) + one for one in same.field(mode, variables, load)]
        names: list[Any] = []
        events: list[Any] = []
        for name, guard in same.guards(mode, variables, load, [0.0] * size):
            names.append(name)
            if isinstance(guard, float | int):  # constant: never reached
                guard = hy.expression(0.0) * variables[0] + float(guard)
            events.append(hy.t_event(guard, direction=hy.event_direction.negative))
        turned: list[float] = []

        def record(integrator: Any, time: float, sign: int) -> None:
            integrator.update_d_output(time)
            turned.append(abs(float(model.watched(list(integrator.d_output)))))

        turning = hy.nt_event(hy.expression(0.0) + same.turning(variables), callback=record)
        integrator = hy.taylor_adaptive(
            list(zip(variables, field, strict=True)),
            [0.0] * size,
            t_events=events,
            nt_events=[turning],
            tol=TOLERANCES[cost],
        )
        return integrator, names, turned

    def piece(
        model: Model, mode: Any, state: State, load: Load, rates: Load, left: float
    ) -> tuple[float, Any, State, float]:
        if mode not in compiled:
            compiled[mode] = compile_mode(model, mode, len(state))
        integrator, names, turned = compiled[mode]
        turned_before = len(turned)
        integrator.time = 0.0
        integrator.state[:] = state
        lines = [one for pair in zip(load, rates, strict=True) for one in pair]
        integrator.pars[:] = lines[: len(integrator.pars)]
        integrator.reset_cooldowns()
        outcome = integrator.propagate_until(left)[0]
        end = [float(one) for one in integrator.state]
        name = None
        if outcome != hy.taylor_outcome.time_limit:
            index = -int(outcome) - 1
            if not 0 <= index < len(names):
                raise ArithmeticError(f"heyoka: outcome {outcome}")
            name = names[index]
        far = max([abs(float(model.watched(end))), *turned[turned_before:]])
        return float(integrator.time), name, end, far

    return event_loop.solve(problem, numbers, piece)
