"""HDF5 files that are written whole or not at all, and columns of numbers or texts in them."""

from __future__ import annotations

import io
import math
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._files import check_regular, replacing
from ._optional import optional

__all__ = ["as_column", "creating", "opening", "read_columns", "read_texts", "write_columns"]


def as_column(values: Any) -> NDArray[Any]:
    """A column as numbers if possible, otherwise as texts; missing texts are empty."""
    listed = list(values)
    try:
        numbers = np.array(listed)
        if numbers.dtype.kind in "biuf" and numbers.ndim == 1:
            return numbers
    except ValueError:
        pass
    return np.array(["" if _is_nothing(v) else str(v) for v in listed], dtype=str)


@contextmanager
def creating(file: str | os.PathLike[str], form: str, who: str) -> Iterator[Any]:
    """An HDF5 file in memory, which replaces `file` whole when the block ends without an error.

    Raises
    ------
    ImportError
        h5py is missing.
    OSError
        The file cannot be written.
    """
    h5py = optional("h5py", "suites", who)
    content = io.BytesIO()
    with h5py.File(content, "w") as h5:
        h5.attrs["format"] = form
        yield h5
    with replacing(file) as stream:
        stream.write(content.getbuffer())


@contextmanager
def opening(file: str | os.PathLike[str], form: str, who: str) -> Iterator[Any]:
    """A file that `creating` made.

    Raises
    ------
    ImportError
        h5py is missing.
    OSError
        The file is missing or cannot be read.
    ValueError
        The file is not HDF5, has another format, or is damaged (also if the block finds that).
    """
    h5py = optional("h5py", "suites", who)
    path = Path(os.fspath(file))
    if check_regular(path) is None:
        raise FileNotFoundError(2, "No such file or directory", str(path))
    try:
        h5 = h5py.File(path, "r")
    except OSError as error:
        raise ValueError(f"{who}: '{path}' is not an HDF5 file, or is damaged") from error
    with h5:
        found = h5.attrs.get("format")
        if found != form:
            raise ValueError(f"{who}: '{path}' must be of format '{form}', got '{found}'")
        try:
            yield h5
        except (KeyError, IndexError, OSError, TypeError, ValueError) as error:
            raise ValueError(f"{who}: '{path}' is damaged: {error}") from error


def write_columns(h5: Any, name: str, columns: Mapping[str, Any]) -> None:
    """Write columns of numbers or texts as a group, in their order."""
    group = h5.create_group(name, track_order=True)
    for key, values in columns.items():
        column = as_column(values)
        # A slash would create a group.
        group[key.replace("/", "\\")] = column if column.dtype.kind in "biuf" else column.tolist()


def read_columns(h5: Any, name: str) -> dict[str, NDArray[Any]]:
    """Read the columns that `write_columns` wrote."""
    return {
        key.replace("\\", "/"): data[:] if data.dtype.kind in "biuf" else read_texts(data)
        for key, data in h5[name].items()
    }


def read_texts(data: Any) -> NDArray[Any]:
    """Read a dataset of texts."""
    texts: NDArray[Any] = data.asstr()[:]
    return texts


def _is_nothing(value: Any) -> bool:
    return value is None or (isinstance(value, float) and math.isnan(value))
