"""From event to event, segment by segment, for tools that integrate differential equations."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, Protocol

from .equations import Load, Model, Numbers, State, answers_of, model_of
from .problems import Answers, Problem

STILL = ("stuck", "held+", "held-", "rest", "over")
EVENTS = 20_000  # more of them are a loop without an end


class Piece(Protocol):
    """Integrates within one mode for at most `left`, under loads that are straight lines.

    Returns the time that passed, the name of the event or None, the state, and the largest
    |watched|.
    """

    def __call__(
        self, model: Model, mode: Any, state: State, load: Load, rates: Load, left: float
    ) -> tuple[float, Any, State, float]: ...


def solve(problem: Problem, numbers: Numbers, piece: Piece) -> Answers:
    """Answers from pieces: where the samples begin and end, every piece does."""
    model = model_of(problem.system, numbers)
    dt = problem.dt
    samples = [problem.component(name) for name in ("along", "transverse", "vertical")]
    state = model.begin(problem.start)
    mode, state = model.first(state, [one[0] for one in samples])
    peak, events = abs(float(model.watched(state))), 0
    moves = any(model.field(mode, state, [0.0, 0.0, 0.0]))
    for i in range(len(samples[0]) - 1):
        before = [one[i] for one in samples]
        rates = [(one[i + 1] - one[i]) / dt for one in samples]
        t = 0.0
        while dt - t > 1e-14 * dt:
            load = [a + b * t for a, b in zip(before, rates, strict=True)]
            moves = mode not in STILL or (mode == "stuck" and len(state) > 2 and coupled(problem))
            if moves:
                passed, name, state, far = piece(model, mode, state, load, rates, dt - t)
                peak = max(peak, far)
            else:
                passed, name = wait(model, mode, state, load, rates, dt - t)
            t += passed
            if name is not None:
                events += 1
                if events > EVENTS:
                    raise ArithmeticError(f"more than {EVENTS} events by t = {i * dt + t:g} s")
                load = [a + b * t for a, b in zip(before, rates, strict=True)]
                mode, state = model.change(mode, name, state, load)
                peak = max(peak, abs(float(model.watched(state))))
    return {
        name: [float(one) for one in values]
        for name, values in answers_of(model, state, peak).items()
    }


def coupled(problem: Problem) -> bool:
    """Whether a structure moves while its interface is stuck."""
    return problem.kind in ("isolated", "floor")


def wait(
    model: Model, mode: Any, state: State, load: Load, rates: Load, left: float
) -> tuple[float, Any]:
    """The end of a rest within a segment, where the state is constant: by bisection.

    Guards of a rest are straight lines, or quadratic and convex towards the event (the plane).
    """

    def values(t: float) -> list[tuple[Any, float]]:
        now = [a + b * t for a, b in zip(load, rates, strict=True)]
        return [(name, float(one)) for name, one in model.guards(mode, state, now, state)]

    first, found = left, None
    for k, (name, end) in enumerate(values(left)):
        if end >= 0.0:
            continue
        low, high = 0.0, left
        for _ in range(60):
            middle = (low + high) / 2
            if values(middle)[k][1] > 0.0:
                low = middle
            else:
                high = middle
        if found is None or high < first:
            first, found = high, name
    return first, found


def largest(values: Sequence[float]) -> float:
    return max((abs(one) for one in values), default=0.0) if values else math.nan
