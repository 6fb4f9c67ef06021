"""Lists of dictionaries that print as tables."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable
from typing import Any

__all__ = ["Rows"]

_WIDEST = 34  # characters in a column of a terminal


class Rows(list[dict[str, Any]]):
    """A list of dictionaries with the same keys, shown as a table."""

    def __init__(self, rows: Iterable[dict[str, Any]] = ()) -> None:
        super().__init__(rows)

    def __repr__(self) -> str:
        if not self:
            return "[]"
        rows = [
            [textwrap.wrap(text, _WIDEST) or [""] for text in cells]
            for cells in [[key.replace("_", " ") for key in self[0]], *self._cells()]
        ]
        widths = [max(len(line) for cell in column for line in cell) for column in zip(*rows)]
        lines = []
        for row in rows:
            for i in range(max(map(len, row))):
                parts = (cell[i] if i < len(cell) else "" for cell in row)
                line = "  ".join(f"{part:{width}}" for part, width in zip(parts, widths))
                lines.append(line.rstrip())
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        from ._tables import html_table

        heading = [key.replace("_", " ") for key in self[0]] if self else []
        return html_table("", heading, self._cells())

    def _cells(self) -> list[list[str]]:
        return [
            [f"{v:g}" if isinstance(v, float) else str(v) for v in row.values()] for row in self
        ]
