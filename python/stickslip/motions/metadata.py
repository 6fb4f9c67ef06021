"""Metadata of records: a table with a row for each, and what it states for their readers."""

from __future__ import annotations

import csv
import math
import os
from collections.abc import Callable, Sequence
from numbers import Real
from pathlib import Path
from typing import Any, SupportsFloat

from .. import _core
from .records import Reading

__all__ = ["Metadata", "orientation_text", "readings"]

_KEYS = ("file", "record", "name")  # columns that identify the record of a row
# Columns that are used without being named.
_OWN = {"units": ("units",), "dt": ("dt", "dt_s"), "orientation": ("orientation",)}


class Metadata:
    """A table with a row for each record, in any order.

    Parameters
    ----------
    source : path-like, mapping of columns or pandas DataFrame
        A path names a CSV file with a line of column names.
    who : str
        The function or option, for messages.

    Attributes
    ----------
    columns : dict of list
        Including the one that identifies the record of a row.
    path : Path or None
        The file, if there is one.
    """

    def __init__(self, source: Any, who: str = "Suite.read") -> None:
        self.who = who
        self.path = Path(os.fspath(source)) if isinstance(source, (str, os.PathLike)) else None
        table = self._read(self.path) if self.path else dict(source)
        self.columns = {str(name): list(values) for name, values in table.items()}
        key = next((name for k in _KEYS for name in self.columns if name.lower() == k), None)
        if key is None:
            raise ValueError(
                f"{who}: metadata needs a column 'file', 'record' or 'name' that identifies the"
                f" record of a row, got {', '.join(self.columns)}"
            )
        self.key = key
        self._rows: dict[str, int] = {}
        for i, value in enumerate(map(str, self.columns[key])):
            if value in self._rows:
                raise ValueError(f"{who}: metadata has two rows for '{value}'")
            self._rows[value] = i

    def row(self, file: str) -> int | None:
        """The row of a file, identified by its path, name or stem; None if there is none."""
        names = (file, Path(file).name, Path(file).stem)
        return next((self._rows[name] for name in names if name in self._rows), None)

    def value(self, column: str, file: str) -> Any:
        """The cell of a column for a file; None if it is empty or the file has no row."""
        row = self.row(file)
        cell = None if row is None else self.columns[column][row]
        if isinstance(cell, str):
            cell = cell.strip()
        try:
            return None if cell == "" or cell != cell else cell  # NaN differs from itself
        except TypeError:  # pandas.NA is neither equal nor different
            return None

    def require_rows(self, files: Sequence[str]) -> None:
        """Raise ValueError if no file has a row: the table is of other records."""
        if all(self.row(file) is None for file in files):
            raise ValueError(
                f"{self.who}: metadata has a row for none of the {len(files)} records; its"
                f" '{self.key}' has '{self.columns[self.key][0]}', the first file is"
                f" '{Path(files[0]).name}'"
            )

    def joined(self, files: Sequence[str]) -> dict[str, list[Any]]:
        """The columns in the order of the files; NaN or an empty text where there is no row."""
        rows = [self.row(file) for file in files]
        found = {}
        for name, values in self.columns.items():
            if name != self.key:
                missing: Any = math.nan if all(isinstance(v, Real) for v in values) else ""
                found[name] = [missing if row is None else values[row] for row in rows]
        return found

    def named(self, column: str) -> str | None:
        """The name of a column, whatever its case."""
        if column in self.columns:
            return column
        return next((name for name in self.columns if name.lower() == column.lower()), None)

    def _read(self, file: Path) -> dict[str, list[Any]]:
        """The columns of a CSV file, as numbers if all cells are numbers or empty."""
        with file.open(newline="", encoding="utf-8-sig") as stream:
            rows = list(csv.reader(stream))
        rows = [row for row in rows if any(cell.strip() for cell in row)]
        if len(rows) < 2:
            raise ValueError(f"{self.who}: metadata '{file}' must have names and at least one row")
        names = [cell.strip() for cell in rows[0]]
        for number, row in enumerate(rows[1:], 2):
            if len(row) != len(names):
                raise ValueError(
                    f"{self.who}: metadata '{file}': row {number} must have {len(names)} cells, got"
                    f" {len(row)}"
                )
        return {name: _typed([row[i].strip() for row in rows[1:]]) for i, name in enumerate(names)}


def readings(
    who: str,
    metadata: Metadata | None,
    *,
    units: str | None = None,
    dt: SupportsFloat | str | None = None,
    orientation: SupportsFloat | str | None = None,
    gaps: bool = False,
) -> Callable[[str], Reading]:
    """What the reader of each file is given, from values for all of them and from the metadata.

    Each of `units`, `dt` and `orientation` is a value, or the name of a column of the metadata. The
    file's own statement takes precedence over the row of the metadata, and the row over a value for
    all files; columns named `units`, `dt`, `dt_s` or `orientation` need not be given.

    Parameters
    ----------
    who : str
        How messages name an option: ``"Suite.read: {}"`` or ``"--{}"``.

    Raises
    ------
    ValueError
        A value out of range; a text that is neither a value nor a column. The function returned
        raises it for a row with an invalid value.
    """
    values: dict[str, Any] = {}
    columns: dict[str, str] = {}
    for name, given in (("units", units), ("dt", dt), ("orientation", orientation)):
        value = None if given is None else _VALUES[name](given)
        if given is not None and value is None:
            columns[name] = _column(who, metadata, name, str(given))
            continue
        values[name] = value
        found = [metadata.named(own) for own in _OWN[name]] if metadata else []
        if column := next((one for one in found if one is not None), None):
            columns[name] = column
    step = values.get("dt")
    if step is not None and not 0 < step < math.inf:
        raise ValueError(f"{who.format('dt')} must be positive and finite, got {step:g} s")

    def reading(file: str) -> Reading:
        row: dict[str, Any] = {}
        for name, column in columns.items():
            assert metadata is not None
            cell = metadata.value(column, file)
            row[name] = None if cell is None else _VALUES[name](cell)
            if cell is not None and (
                row[name] is None or (name == "dt" and not 0 < row[name] < math.inf)
            ):
                raise ValueError(
                    f"column '{column}' of the metadata must hold {_WHAT[name]}, got {cell!r}"
                )
        return Reading(
            units=values.get("units"),
            dt=step,
            orientation=values.get("orientation"),
            gaps=gaps,
            row_units=row.get("units"),
            row_dt=row.get("dt"),
            row_orientation=row.get("orientation"),
        )

    return reading


def _column(who: str, metadata: Metadata | None, name: str, given: str) -> str:
    """The column that a text names, which is no value."""
    column = metadata.named(given) if metadata else None
    if column is not None:
        return column
    if metadata:
        known = f"the columns are: {', '.join(metadata.columns)}"
    else:
        known = "there is no metadata"
    raise ValueError(
        f"{who.format(name)} must be {_WHAT[name]}, or name a column of the metadata, and {known};"
        f" got {given!r}"
    )


def _unit(given: Any) -> str | None:
    try:
        _core.acceleration_unit(given)
    except (TypeError, ValueError):
        return None
    return str(given)


def _step(given: Any) -> float | None:
    try:
        return float(given)
    except (TypeError, ValueError):
        return None


def orientation_text(given: Any) -> str | None:
    text = str(given)
    number = _step(given)
    if number is not None:
        text = f"{number:.12g}"
    known = _core._azimuth_of(text) is not None or _core._upward(text)
    return text if known else None


_VALUES: dict[str, Callable[[Any], Any]] = {
    "units": _unit,
    "dt": _step,
    "orientation": orientation_text,
}
_WHAT = {
    "units": "a unit of acceleration (g, m/s^2, cm/s^2, ...)",
    "dt": "a number of seconds",
    "orientation": "an azimuth in degrees, N28W, up or the like",
}


def _typed(cells: list[str]) -> list[Any]:
    try:
        return [float(cell) if cell else math.nan for cell in cells]
    except ValueError:
        return list(cells)
