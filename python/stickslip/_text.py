"""Text from files, for terminals and pictures."""

from __future__ import annotations

__all__ = ["printable"]


def printable(text: str) -> str:
    r"""Escape unprintable characters as `repr` does: an escape character becomes \x1b.

    Control characters drive a terminal and break an SVG; bidirectional overrides reorder a line.
    """
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)
