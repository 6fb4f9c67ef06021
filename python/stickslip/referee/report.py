"""Tables and a picture of what tools found."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING, Any

from .problems import CLASSES, Problem

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FLOOR = 1e-16  # errors below this are drawn here


@dataclass
class Entry:
    """What a tool did in one class under one setting."""

    errors: list[float] = field(default_factory=list[float])
    seconds: list[float] = field(default_factory=list[float])
    left_out: int = 0  # not expressible, or not tried
    untried: bool = False  # the tool may be able to express one of them

    @property
    def error(self) -> float:
        return median(self.errors) if self.errors else math.nan

    @property
    def largest(self) -> float:
        return max(self.errors, default=math.nan)

    @property
    def time(self) -> float:
        return median(self.seconds) if self.seconds else math.nan


Found = dict[str, dict[str, list[Entry]]]
"""Entries by tool and class, from the cheapest setting to the dearest."""


def gather(results: Iterable[Mapping[str, Any]], problems: Sequence[Problem]) -> Found:
    """Compare the results of tools with the answers.

    Raises
    ------
    ValueError
        If results lack an answer that a problem asks for.
    """
    known = {one.id: one for one in problems}
    found: Found = {}
    for tool in results:
        costs = list(dict.fromkeys(one["cost"] for one in tool["results"]))
        by_class = {group: [Entry() for _ in costs] for group in CLASSES}
        found[str(tool["tool"])] = by_class
        for one in tool["results"]:
            problem = known.get(one["problem"])
            if problem is None:
                continue
            entry = by_class[problem.group][costs.index(one["cost"])]
            if "not_expressible" in one or "not_tried" in one:
                entry.left_out += 1
                entry.untried = entry.untried or "not_tried" in one
            elif "failed" in one:
                entry.errors.append(math.inf)
            else:
                entry.errors.append(problem.error(one["answers"]))
                entry.seconds.append(float(one["seconds"]))
    return found


def number(value: float) -> str:
    """A size of an error in two digits."""
    if math.isnan(value):
        return "-"
    if math.isinf(value):
        return "fails"
    if value == 0:
        return "0"
    return (
        f"{value:.0e}".replace("e-0", "e-").replace("e+0", "e+") if value < 1e-3 else f"{value:.2g}"
    )


def cell(entries: Sequence[Entry], cost: int = -1) -> str:
    """The median error, and of how many problems."""
    if not entries:
        return "-"
    entry = entries[cost]
    if not entry.errors:
        return "n/e" if entry.left_out and not entry.untried else "not tried"
    left = f" ({len(entry.errors)})" if entry.left_out else ""
    return f"{number(entry.error)}{left}"


def table(found: Found) -> str:
    """Median errors under the dearest setting, a row for each tool, in Markdown."""
    counts = {group: 0 for group in CLASSES}
    for tool in found.values():
        for group, entries in tool.items():
            if entries:
                counts[group] = max(counts[group], len(entries[-1].errors) + entries[-1].left_out)
    shown = [group for group in CLASSES if counts[group]]
    lines = [
        "| tool | " + " | ".join(f"{group} ({counts[group]})" for group in shown) + " | time |",
        "|---" * (len(shown) + 2) + "|",
    ]
    for name, by_class in found.items():
        times = [t for group in shown for one in by_class[group][-1:] for t in one.seconds]
        spent = f"{1e3 * median(times):.3g} ms" if times else "-"
        cells = " | ".join(cell(by_class[group]) for group in shown)
        lines.append(f"| {name} | {cells} | {spent} |")
    return "\n".join(lines)


def settings(found: Found) -> str:
    """Median error and time of every setting over all problems that a tool can express."""
    lines = [
        "| tool | setting | problems | median error | largest | median time |",
        "|---" * 6 + "|",
    ]
    for tool, by_class in found.items():
        costs = max((len(entries) for entries in by_class.values()), default=0)
        for cost in range(costs):
            entries = [one[cost] for one in by_class.values() if len(one) > cost]
            errors = [e for one in entries for e in one.errors]
            times = [t for one in entries for t in one.seconds]
            if errors:
                lines.append(
                    f"| {tool} | {cost + 1} | {len(errors)} | {number(median(errors))} | "
                    f"{number(max(errors))} | {1e3 * median(times) if times else math.nan:.3g} ms |"
                )
    return "\n".join(lines)


def read_results(paths: Sequence[str | Path]) -> list[dict[str, Any]]:
    """Results files that others sent: one tool each, or a list of tools."""
    found: list[dict[str, Any]] = []
    for path in paths:
        one = json.loads(Path(path).read_text(encoding="utf-8"))
        found += one if isinstance(one, list) else [one]
    return found


def plot(found: Found) -> Figure:
    """Error against time, a panel for each class and a line for each tool."""
    from matplotlib import colormaps
    from matplotlib.figure import Figure

    from ..plotting.styles import GRAY, style

    with style():
        figure = Figure(figsize=(11, 8.6), layout="constrained")
        panels = figure.subplots(3, 3, sharex=True, sharey=True)
        colors = colormaps["tab20"].colors  # type: ignore[attr-defined]
        markers = "o^sDvPX<>*hd"
        for axes, group in zip(panels.flat, CLASSES, strict=True):
            axes.set_title(group)
            axes.set_xscale("log")
            axes.set_yscale("log")
            axes.grid(color=GRAY, alpha=0.2)
            for k, (tool, by_class) in enumerate(found.items()):
                points = [
                    (one.time, min(max(one.error, FLOOR), 10.0))
                    for one in by_class[group]
                    if one.seconds
                ]
                if points:
                    axes.plot(
                        *zip(*points, strict=True),
                        color=colors[2 * k % 20 + k // 10],
                        marker=markers[k % len(markers)],
                        markersize=4.5,
                        label=tool,
                    )
        for axes in panels[-1]:
            axes.set_xlabel("time [s]")
        for axes in panels[:, 0]:
            axes.set_ylabel("median error / scale")
        lines = {line.get_label(): line for axes in panels.flat for line in axes.get_lines()}
        drawn: Any = figure  # of its legend only a part is typed
        drawn.legend(
            [lines[tool] for tool in found if tool in lines],
            [tool for tool in found if tool in lines],
            loc="outside lower center",
            ncols=6,
            fontsize=8,
        )
    return figure
