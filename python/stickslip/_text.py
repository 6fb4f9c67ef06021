"""Text from files, for terminals and pictures."""

from __future__ import annotations

__all__ = ["printable"]


def printable(text: str) -> str:
    r"""The text with what is not printable escaped as by `repr`: an escape character is \x1b.

    Control characters drive a terminal and break an SVG; bidirectional overrides reorder a line.
    """
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)
