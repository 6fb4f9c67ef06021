"""Try simulators on the problems of the referee: ``python -m stickslip.referee``."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import Any

from . import report, tools
from .problems import problems


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(prog="python -m stickslip.referee", description=__doc__)
    parser.add_argument("--tool", nargs="+", metavar="NAME", help="default: all that are installed")
    parser.add_argument("--problem", nargs="+", metavar="ID", help="default: all")
    parser.add_argument("--problems", metavar="FOLDER", help="default: those of the package")
    parser.add_argument("--results", metavar="FILE", help="write the results as JSON")
    parser.add_argument("--read", nargs="+", metavar="FILE", help="read results; run nothing")
    parser.add_argument("--picture", metavar="FILE", help="draw error against time")
    parser.add_argument("--list", action="store_true", help="list problems and tools")
    asked = parser.parse_args(arguments)
    chosen = problems(asked.problems)
    known = tools.adapters()
    if asked.list:
        for one in chosen:
            print(f"{one.id:20}  {one.group:28}  {one.description}")
        for tool in known:
            print(f"{tool.NAME:20}  {tools.missing(tool) or tool.PURPOSE}")
        return 0
    if asked.problem:
        unknown = set(asked.problem) - {one.id for one in chosen}
        if unknown:
            parser.error(f"no such problem: {', '.join(sorted(unknown))}; see --list")
        chosen = [one for one in chosen if one.id in asked.problem]
    results: list[Any] = []
    if asked.read:
        results = report.read_results(asked.read)
    else:
        names = {name.lower() for name in asked.tool or ()}
        unknown = names - {one.NAME.lower() for one in known}
        if unknown:
            parser.error(f"no such tool: {', '.join(sorted(unknown))}; see --list")
        for tool in known:
            if names and tool.NAME.lower() not in names:
                continue
            if why := tools.missing(tool):
                print(f"skipped: {tool.NAME}, {why}", file=sys.stderr)
                continue
            results.append(tools.run_all(tool, chosen))
            if asked.problem:
                show(results[-1], {one.id: one for one in chosen})
    if asked.results:
        Path(asked.results).write_text(json.dumps(results, indent=1) + "\n", encoding="utf-8")
    found = report.gather(results, chosen)
    print(report.table(found))
    print()
    print(report.settings(found))
    if asked.picture:
        figure: Any = report.plot(found)
        figure.savefig(asked.picture)
    return 0


def show(tool: dict[str, Any], known: dict[str, Any]) -> None:
    """One line for each problem and setting."""
    for one in tool["results"]:
        problem = known[one["problem"]]
        if "answers" in one:
            said = f"error {problem.error(one['answers']):.1e} in {one['seconds']:.3g} s"
        else:
            said = one.get("failed") or (
                f"not tried: {one['not_tried']}"
                if "not_tried" in one
                else f"not expressible: {one['not_expressible']}"
            )
        print(f"{tool['tool']}, {one['cost']}: {problem.id}: {said}")
    print()


if __name__ == "__main__":
    sys.exit(main())
