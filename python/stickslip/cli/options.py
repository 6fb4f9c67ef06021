"""Options, from tables."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Callable
from pathlib import Path
from typing import Any

from .parser import StoreAll, number, numbers, ratio, ratios, text_argument, whole

__all__ = ["add_options"]

_TYPES: dict[str, Callable[[str], Any]] = {
    "file": Path,
    "number": number,
    "numbers": numbers,
    "ratio": ratio,
    "ratios": ratios,
    "text": text_argument,
    "whole": whole,
}


def add_options(parser: Any, table: str) -> None:
    """Add the options of a table to a parser or to one of its groups.

    Each has a line, ``--name type METAVAR = default``, and its help indented below it. The type is
    one of `_TYPES`, or the choices, such as ``mean|line``; a flag has none. It ends with ``...`` if
    the option takes several values, ``*...`` if equal ones count, and ``?`` if the first choice may
    be left out; several metavars are as many values. ``required`` may end the line.
    """
    for head, text in re.findall(r"^(\S.*)\n((?: +.*\n?)+)", textwrap.dedent(table), re.MULTILINE):
        line, required, _ = head.partition(" required")
        line, _, default = line.partition(" = ")
        name, *rest = line.split()
        kind, metavars = rest[0] if rest else "", rest[1:]
        options: dict[str, Any] = {"help": " ".join(text.split())}
        word = kind.rstrip("?*.")
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
        if required:
            options["required"] = True
        parser.add_argument(name, **options)
