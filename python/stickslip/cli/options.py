"""Options, from tables."""

from __future__ import annotations

import argparse
import re
import textwrap
from collections.abc import Callable
from pathlib import Path
from typing import Any

from .parser import StoreAll, group, number, numbers, ratio, ratios, text_argument, whole

__all__ = ["SCALE", "add_options"]

_TYPES: dict[str, Callable[[str], Any]] = {
    "file": Path,
    "number": number,
    "numbers": numbers,
    "ratio": ratio,
    "ratios": ratios,
    "text": text_argument,
    "whole": whole,
}
SCALE = """
--scale ratio = 1
    factor on the ground acceleration (default 1)
"""


def add_options(parser: argparse.ArgumentParser, *tables: str) -> None:
    """Add the options of tables.

    Each has a line, ``--name type METAVAR = default``, and its help indented below it. The type is
    one of `_TYPES`, or the choices, such as ``mean|line``; ``name=value`` stands for this value of
    another option; a flag has none. It ends with ``...`` if the option takes several values,
    ``*...`` if equal ones count, and ``?`` if the first choice may be left out; several metavars
    are as many values. ``required`` may end the line. A line ``[title]`` begins a group of the
    help, and ``one of``, which may be there, options that exclude each other.
    """
    for table in tables:
        target: Any = parser
        for head, text in re.findall(
            r"^(\S.*)\n((?: +.*\n?)*)", textwrap.dedent(table), re.MULTILINE
        ):
            if head.startswith("["):
                title, exclusive, required = re.fullmatch(  # type: ignore[union-attr]
                    r"\[(.*?)(, one of)?(, required)?\]", head
                ).groups()
                target = group(parser, title) if title else parser
                if exclusive:
                    target = target.add_mutually_exclusive_group(required=bool(required))
            else:
                name, options = _option(head)
                target.add_argument(name, help=" ".join(text.split()), **options)


def _option(head: str) -> tuple[str, dict[str, Any]]:
    """The name of an option and the arguments of `add_argument` that its line states."""
    line, required, _ = head.partition(" required")
    line, _, default = line.partition(" = ")
    name, *rest = line.split()
    kind, metavars = rest[0] if rest else "", rest[1:]
    options: dict[str, Any] = {"required": True} if required else {}
    word = kind.rstrip("?*.")
    if "=" in word:
        options["dest"], options["const"] = word.split("=")
        return name, options | {"action": "store_const"}
    if "|" in word:
        options["choices"] = tuple(word.split("|"))
    elif word:
        options["type"] = _TYPES[word]
    else:
        options["action"] = "store_true"
    if metavars:
        options["metavar"] = metavars[0] if len(metavars) == 1 else tuple(metavars)
    if kind.endswith("..."):
        options["nargs"] = "+"
    elif kind.endswith("?"):
        options |= {"nargs": "?", "const": options["choices"][0]}
    elif len(metavars) > 1:
        options["nargs"] = len(metavars)
    if kind.endswith("*..."):
        options["action"] = StoreAll
    if default:
        value = options.get("type", str)(default)
        options["default"] = [value] if kind.endswith("...") else value
    return name, options
