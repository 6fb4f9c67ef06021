"""Parsing of arguments."""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Callable
from decimal import Decimal, InvalidOperation
from typing import Any, NoReturn, TextIO

from .._text import printable
from .output import write, write_error

__all__ = [
    "Parser",
    "StoreAll",
    "group",
    "number",
    "numbers",
    "ratio",
    "ratios",
    "text_argument",
    "whole",
]

_MOST_STEPS = 10_000  # in a range


class Parser(argparse.ArgumentParser):
    """A parser that treats repeated options as `Store` does, and prints like the command."""

    def __init__(self, **options: Any) -> None:
        super().__init__(**options)
        for action in (None, "store"):
            self.register("action", action, Store)

    def error(self, message: str) -> NoReturn:
        # argparse prints the usage, up to ten lines, and on stdout where stderr is closed
        self.exit(
            2, f"{self.prog}: error: {printable(message)} ({self.prog} --help: all options)\n"
        )

    def _print_message(self, message: str, file: TextIO | None = None) -> None:
        if file is sys.stdout:
            write(message, file)
        else:
            write_error(message)


def group(parser: argparse.ArgumentParser, title: str) -> argparse._ArgumentGroup:
    """The group of options under a title of the help."""
    for known in parser._action_groups:
        if known.title == title:
            return known
    return parser.add_argument_group(title)


class Store(argparse.Action):
    """Join repeated lists, with each value of an option once; reject other repeated options."""

    given: Any = None
    each_once = True

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
            if self.option_strings and self.each_once:
                values = list(dict.fromkeys(values))
        elif self.given is not None:
            parser.error(f"{self.option_strings[0]} given twice: {self.given}, then {values}")
        self.given = values
        setattr(namespace, self.dest, values)


class StoreAll(Store):
    """As Store, with equal values kept."""

    each_once = False


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
    return _numbers(argument, _decimal)


def ratios(argument: str) -> float | tuple[float, ...]:
    """As `numbers`, for quantities that may be given in percent, such as 10%."""
    return _numbers(argument, _ratio)


def number(argument: str) -> float:
    """One number."""
    return _single(numbers(argument), argument)


def ratio(argument: str) -> float:
    """One number, which may be given in percent."""
    return _single(ratios(argument), argument)


def whole(argument: str) -> int:
    """A whole number, such as 100000 or 1e5."""
    value = _decimal(argument)
    if not value.is_finite() or value != value.to_integral_value() or abs(value) >= 10**30:
        raise argparse.ArgumentTypeError(f"must be a whole number, got {argument}")
    return int(value)


def _single(value: float | tuple[float, ...], argument: str) -> float:
    if isinstance(value, tuple):
        raise argparse.ArgumentTypeError(f"takes one number, got the range {argument}")
    return value


def _decimal(text: str) -> Decimal:
    try:
        return Decimal(text.strip())
    except InvalidOperation:
        hint = "; percent is for ratios" if text.strip().endswith("%") else ""
        if "," in text:
            hint = "; blanks separate several numbers, and a point the decimals"
        raise argparse.ArgumentTypeError(f"must be a number, got {text!r}{hint}") from None


def _ratio(text: str) -> Decimal:
    text = text.strip()
    return _decimal(text[:-1]) / 100 if text.endswith("%") else _decimal(text)


def _numbers(argument: str, parse: Callable[[str], Decimal]) -> float | tuple[float, ...]:
    if ":" not in argument:
        return float(parse(argument))
    parts = argument.split(":")
    try:
        start, stop, step = map(parse, parts)
        if not all(part.is_finite() for part in (start, stop, step)):
            raise ValueError
    except (argparse.ArgumentTypeError, ValueError):
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
