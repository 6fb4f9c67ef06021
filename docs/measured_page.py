"""What the programs that measure a page have in common: its tables and its picture."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def table(heading: str, rows: Iterable[Iterable[str]]) -> str:
    """A table of Markdown; `heading` is its first line."""
    rule = "|" + "---|" * (heading.count("|") - 1)
    return "\n".join([heading, rule, *("| " + " | ".join(row) + " |" for row in rows)]) + "\n"


def replaced(text: str, new: str) -> str:
    """The page with the table of this heading replaced."""
    lines = text.splitlines(keepends=True)
    begin = lines.index(new.splitlines(keepends=True)[0])
    end = next((i for i in range(begin, len(lines)) if lines[i][0] != "|"), len(lines))
    return "".join([*lines[:begin], new, *lines[end:]])


def rewrite(page: Path, tables: Iterable[str]) -> None:
    """Replace the tables of a page."""
    text = page.read_text(encoding="utf-8")
    for new in tables:
        text = replaced(text, new)
    page.write_text(text, encoding="utf-8")


def draw(picture: Path, drawn: Callable[[], Figure]) -> None:
    """Save a figure in 64 colors."""
    from PIL import Image
    from stickslip import plotting

    with plotting.style():
        figure = drawn()
    plotting.save(figure, picture)
    Image.open(picture).convert("RGB").quantize(64, dither=Image.Dither.NONE).save(
        picture, optimize=True
    )
