"""The tools that the referee can try, and how it runs them."""

from __future__ import annotations

import time
from collections.abc import Sequence
from importlib import import_module, metadata
from typing import Protocol, cast

from .problems import Answers, NotExpressibleError, NotTriedError, Problem

MODULES = (
    "own",
    "scipy_ivp",
    "heyoka_taylor",
    "opensees",
    "pyslammer_rigid",
    "mujoco_engine",
    "pybullet_engine",
    "pymunk_engine",
    "box2d_engine",
    "dart",
    "drake",
)
QUICK, REPEATS = 0.1, 3  # a run shorter than this [s] is repeated, and the best time counts


class Adapter(Protocol):
    """What a module of `adapters` offers."""

    NAME: str
    PURPOSE: str
    PACKAGE: str  # as pip calls it
    MODULE: str  # as Python imports it
    COSTS: Sequence[str]  # its settings, from cheap to dear, in words

    def solve(self, problem: Problem, cost: int) -> Answers: ...


class Result(dict[str, object]):
    """One problem under one setting, as a results file holds it."""


def adapters() -> list[Adapter]:
    return [cast(Adapter, import_module(f".adapters.{one}", __package__)) for one in MODULES]


def missing(adapter: Adapter) -> str:
    """Why a tool cannot run here; empty if it can."""
    try:
        import_module(adapter.MODULE)
    except ImportError as error:
        return f"not installed: pip install {adapter.PACKAGE} ({error})"
    return ""


def version(adapter: Adapter) -> str:
    try:
        return metadata.version(adapter.PACKAGE)
    except metadata.PackageNotFoundError:
        return "unknown"


def run(adapter: Adapter, problem: Problem, cost: int) -> Result:
    """Solve one problem, and say why if that is not possible."""
    one = Result(problem=problem.id, cost=adapter.COSTS[cost])
    try:
        best, answers = float("inf"), None
        for _ in range(REPEATS):
            began = time.perf_counter()
            answers = adapter.solve(problem, cost)
            best = min(best, time.perf_counter() - began)
            if best > QUICK:
                break
        one["seconds"] = float(f"{best:.3g}")
        one["answers"] = answers
    except NotExpressibleError as reason:
        one["not_expressible"] = str(reason)
    except NotTriedError as reason:
        one["not_tried"] = str(reason)
    except (ArithmeticError, RuntimeError, ValueError) as error:
        one["failed"] = f"{type(error).__name__}: {error}"
    return one


def run_all(
    adapter: Adapter, problems: Sequence[Problem], costs: Sequence[int] | None = None
) -> dict[str, object]:
    """All problems under all settings of a tool: what a results file holds."""
    chosen = range(len(adapter.COSTS)) if costs is None else costs
    return {
        "tool": adapter.NAME,
        "version": version(adapter),
        "purpose": adapter.PURPOSE,
        "results": [run(adapter, problem, cost) for problem in problems for cost in chosen],
    }
