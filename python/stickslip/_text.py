"""Text from files, for terminals and pictures."""

from __future__ import annotations

__all__ = ["no_formula", "printable"]

_FORMULA = tuple("=+-@\t\r")  # with which a spreadsheet takes a cell of a CSV file for a formula


def printable(text: str) -> str:
    r"""Escape unprintable characters as `repr` does: an escape character becomes \x1b.

    Control characters drive a terminal and break an SVG; bidirectional overrides reorder a line.
    """
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)


def no_formula(text: str) -> str:
    """A text for a cell of a CSV file: an apostrophe before what a spreadsheet would run."""
    if not text.startswith(_FORMULA):
        return text
    try:
        float(text)
    except ValueError:
        return f"'{text}"
    return text
