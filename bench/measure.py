"""Compare the run times of several works, and report how reliable the comparison is."""

from __future__ import annotations

import importlib
import os
import platform
import statistics
import time
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import stickslip as ss


class Timing:
    """Times of one piece of work, each round one [ns per item]."""

    def __init__(self, times: list[float]):
        self.times = times

    @property
    def median(self) -> float:
        return statistics.median(self.times)

    @property
    def spread(self) -> float:
        """Interquartile range as a fraction of the median."""
        if len(self.times) < 2:
            return float("nan")
        first, _, third = statistics.quantiles(self.times, n=4, method="inclusive")
        return (third - first) / self.median

    @property
    def reliable(self) -> bool:
        return self.spread <= 0.1

    def ratio(self, base: Timing) -> float:
        """Median of the ratios of the same round."""
        if len(self.times) != len(base.times):
            return self.median / base.median
        return statistics.median(a / b for a, b in zip(self.times, base.times))

    def __str__(self) -> str:
        return f"{self.median:9.1f} {100 * self.spread:6.0f}%{' ' if self.reliable else '!'}"


UNRELIABLE = "! unreliable: the middle half of the rounds spreads by more than 10 % of the median"


def take_turns(
    works: dict[str, tuple[Callable[[], object], int]],
    rounds: int,
    clock: Callable[[], int] = time.process_time_ns,
) -> dict[str, Timing]:
    """Times works, each given with its number of items, in turns.

    A slow spell of the machine then falls on all alike. The time is the processor's: what other
    programs get of it is not counted. One round warms up.
    """
    times: dict[str, list[float]] = {name: [] for name in works}
    for turn in range(rounds + 1):
        for name, (work, items) in works.items():
            begin = clock()
            work()
            taken = clock() - begin
            if turn:
                times[name].append(taken / items)
    return {name: Timing(t) for name, t in times.items()}


def peer(name: str) -> ModuleType | None:
    """A peer library, if it is installed."""
    try:
        return importlib.import_module(name)
    except ImportError:
        return None


def versions(*names: str) -> str:
    found = []
    for name in names:
        module = peer(name)
        found.append(f"{name} {module.__version__ if module else 'not installed'}")
    return ", ".join(found)


def machine() -> str:
    """The processor, the compiler and the commit."""
    processor = platform.processor() or "unknown processor"
    cpuinfo = Path("/proc/cpuinfo")
    if cpuinfo.exists():
        for line in cpuinfo.read_text().splitlines():
            if line.startswith("model name"):
                processor = line.split(":", 1)[1].strip()
                break
    build = ss.build_info()
    return (
        f"{processor}, 1 of {os.cpu_count()} threads\n"
        f"stickslip {build['version'] or 'unknown'}: {build['compiler'] or 'unknown compiler'},"
        f" commit {build['commit'] or 'unknown'}; Python {platform.python_version()}"
    )


def bar(claim: str, value: float, limit: float, at_least: bool = False) -> str:
    """One line: the target, the measured value, and whether the target is met."""
    met = value >= limit if at_least else value <= limit
    sign = ">=" if at_least else "<="
    return f"  {claim:78} {value:8.3g} {sign} {limit:<4g} {'met' if met else 'NOT met'}"
