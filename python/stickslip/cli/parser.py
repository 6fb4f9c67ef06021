"""Parsing of arguments."""

from __future__ import annotations

import argparse
import math
import sys
from decimal import Decimal, InvalidOperation
from typing import Any, NoReturn, TextIO

from .._text import printable
from .output import write, write_error

__all__ = ["Parser", "numbers", "text_argument"]

_MOST_STEPS = 10_000  # in a range


class Parser(argparse.ArgumentParser):
    """A parser that treats repeated options as `Store` does, and prints like the command."""

    def __init__(self, **options: Any) -> None:
        super().__init__(**options)
        for action in (None, "store"):
            self.register("action", action, Store)

    def error(self, message: str) -> NoReturn:
        # argparse prints the usage on stdout where stderr is closed
        self.exit(2, f"{self.format_usage()}{self.prog}: error: {printable(message)}\n")

    def _print_message(self, message: str, file: TextIO | None = None) -> None:
        if file is sys.stdout:
            write(message, file)
        else:
            write_error(message)


class Store(argparse.Action):
    """Join repeated lists, with each value of an option once; reject other repeated options."""

    given: Any = None

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,
    ) -> None:
        if self.nargs in ("+", "*"):
            flat = [v for value in values for v in (value if isinstance(value, tuple) else [value])]
            values = [*(self.given or ()), *flat]
            if self.option_strings:
                values = list(dict.fromkeys(values))
        elif self.given is not None:
            parser.error(f"{self.option_strings[0]} given twice: {self.given}, then {values}")
        self.given = values
        setattr(namespace, self.dest, values)


def text_argument(argument: str) -> str:
    """An argument that is not a path; rejects undecodable bytes, which only paths may have."""
    try:
        argument.encode()
    except UnicodeEncodeError:
        raise argparse.ArgumentTypeError(
            f"must be encoded in {sys.getfilesystemencoding()}, got {argument!r}"
        ) from None
    return argument


def numbers(argument: str) -> float | tuple[float, ...]:
    """A number, or those of a range START:STOP:STEP, including STOP, in decimal arithmetic."""
    if ":" not in argument:
        return float(argument)
    parts = argument.split(":")
    try:
        start, stop, step = map(Decimal, parts)
        if not all(part.is_finite() for part in (start, stop, step)):
            raise InvalidOperation
    except (InvalidOperation, ValueError):
        raise argparse.ArgumentTypeError(
            f"a range is START:STOP:STEP, three finite numbers, got {argument}"
        ) from None
    if step == 0 or (stop - start) * step < 0:
        raise argparse.ArgumentTypeError(f"a step must lead from START to STOP, got {argument}")
    steps = math.floor((stop - start) / step)
    if steps >= _MOST_STEPS:
        raise argparse.ArgumentTypeError(
            f"a range may have {_MOST_STEPS} numbers at most, got {steps + 1} of {argument}"
        )
    return tuple(float(start + i * step) for i in range(steps + 1))
