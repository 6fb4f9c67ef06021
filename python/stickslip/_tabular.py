"""What objects with a table have in common: pandas, CSV, JSON, notebooks."""

from __future__ import annotations

import os
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from ._core import build_info
from ._tables import (
    Columns,
    Repeated,
    frame_of,
    heading,
    html_table,
    json_text,
    length_of,
    write_csv,
)
from ._text import printable

__all__ = ["Tabular", "over", "same"]

_MOST_ROWS = 20  # in a notebook


class Tabular(ABC):
    """An object with columns of equal length, with names and units as in `docs/conventions.md`."""

    _index: ClassVar[str | None] = None  # the column that is the index of a DataFrame

    @abstractmethod
    def _table(self) -> tuple[Columns, Mapping[str, str]]:
        """The columns by name, and their units by name."""

    def __eq__(self, other: object) -> bool:
        if type(self) is not type(other):
            return NotImplemented
        return same(self.__dict__, other.__dict__)

    __hash__ = None  # type: ignore[assignment]  # a subclass whose parts cannot change may have one

    def to_dataframe(self) -> Any:
        """Convert to a pandas DataFrame, with the units in ``attrs["units"]``.

        Returns
        -------
        pandas.DataFrame

        Raises
        ------
        ImportError
            pandas is missing.
        """
        return frame_of(*self._table(), f"{type(self).__name__}.to_dataframe", self._index)

    def to_csv(self, file: str | os.PathLike[str]) -> Path:
        """Write a CSV file with the unit in each head; numbers read back to the same double.

        An apostrophe stands before texts that a spreadsheet would take for formulas, those that
        begin with =, +, - or @.

        Parameters
        ----------
        file : path-like
            Replaced whole or not at all.

        Returns
        -------
        Path

        Raises
        ------
        OSError
            The file cannot be written.
        """
        return write_csv(*self._table(), file)

    def to_json(self) -> str:
        """Convert to a JSON object: each column as a list by name, and `units`.

        Returns
        -------
        str
            Numbers read back to the same double; NaN and infinity are null.
        """
        columns, units = self._table()
        named = {name: units[name] for name in columns if units.get(name)}
        listed = {name: _first(column, None) for name, column in columns.items()}
        document = {"stickslip": build_info()["version"], "units": named, **listed}
        return json_text(document)

    def _repr_html_(self) -> str:
        columns, units = self._table()
        rows = list(zip(*(_first(column, _MOST_ROWS).tolist() for column in columns.values())))
        count = length_of(columns)
        heads = [heading(name.replace("_", " "), units.get(name, "")) for name in columns]
        title = f"{type(self).__name__}: {count:,} rows" + (
            f", the first {_MOST_ROWS}" if count > _MOST_ROWS else ""
        )
        return html_table(title, heads, ([_shown(cell) for cell in row] for row in rows))


def over(
    *axes: Mapping[str, Sequence[Any] | NDArray[Any]], **arrays: NDArray[Any]
) -> dict[str, NDArray[Any] | Repeated]:
    """The columns of arrays over axes: a row for each element, the last axis varying fastest.

    Parameters
    ----------
    axes : mapping of str to array_like
        For each axis its name with its values, and other columns along it.
    arrays : ndarray
        By name, all of the shape of the axes.
    """
    shape = tuple(len(next(iter(columns.values()))) for columns in axes)
    found: dict[str, NDArray[Any] | Repeated] = {}
    for columns, index in zip(axes, np.indices(shape)):
        places = index.ravel()
        found |= {name: Repeated(np.asarray(one), places) for name, one in columns.items()}
    return found | {name: array.ravel() for name, array in arrays.items()}


def _first(column: NDArray[Any] | Repeated, count: int | None) -> NDArray[Any]:
    """The values of the first rows, or of all."""
    if isinstance(column, Repeated):
        return column.values[column.places[:count]]
    return column[:count]


def same(a: Any, b: Any) -> bool:
    """Whether two values, arrays or dicts of them are equal; NaN equals NaN."""
    if isinstance(a, dict) and isinstance(b, dict):
        return a.keys() == b.keys() and all(same(a[k], b[k]) for k in a)
    if isinstance(a, np.ndarray) and isinstance(b, np.ndarray):
        return np.array_equal(a, b, equal_nan=a.dtype.kind == "f" and b.dtype.kind == "f")
    return bool(a == b)


def _shown(value: Any) -> str:
    """A cell as a person reads it."""
    if isinstance(value, float):
        return "" if np.isnan(value) else f"{value:.4g}"
    return printable(str(value))
