"""HDF5 files that are written whole or not at all, with checksums of everything in them.

Each array has the attribute `crc32`, of its type, shape and content, because HDF5 itself protects
neither texts nor the addresses of numbers. Numbers also have HDF5's own checksum `fletcher32`,
which every reader of HDF5 verifies. The file format has checksums for attributes and for types and
shapes of arrays.
"""

from __future__ import annotations

import io
import math
import os
import zlib
from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, ClassVar, TypeVar

import numpy as np
from numpy.typing import NDArray

from ._files import check_regular, replacing
from ._optional import optional

__all__ = [
    "Saved",
    "as_column",
    "creating",
    "opening",
    "read",
    "read_columns",
    "write",
    "write_columns",
    "write_joined",
]

_CHUNK = 2**20  # bytes; arrays up to this size are one chunk


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


_Saved = TypeVar("_Saved", bound="Saved")


class Saved(ABC):
    """An object that an HDF5 file can hold."""

    _format: ClassVar[str]  # named in the file

    @abstractmethod
    def _write(self, h5: Any) -> None:
        """Write the object into an empty HDF5 file."""

    @classmethod
    @abstractmethod
    def _read(cls: type[_Saved], h5: Any) -> _Saved:
        """The object of a file."""

    def save(self, file: str | os.PathLike[str]) -> Path:
        """Write all to one HDF5 file.

        Parameters
        ----------
        file : path-like
            Replaced whole or not at all.

        Returns
        -------
        Path

        Raises
        ------
        ImportError
            h5py is missing: ``pip install stickslip[suites]``.
        OSError
            The file cannot be written.
        """
        with creating(file, self._format, f"{type(self).__name__}.save") as h5:
            self._write(h5)
        return Path(os.fsdecode(file))

    @classmethod
    def open(cls: type[_Saved], file: str | os.PathLike[str]) -> _Saved:
        """Open a file that `save` wrote.

        Parameters
        ----------
        file : path-like

        Returns
        -------
        Suite or SweepTable
            Equal to the one that was saved, to the last bit.

        Raises
        ------
        ImportError
            h5py is missing: ``pip install stickslip[suites]``.
        OSError
            The file is missing or cannot be read.
        ValueError
            The file holds no such object, or is damaged: a checksum differs, arrays have different
            lengths, or one is a link.
        """
        with opening(file, cls._format, f"{cls.__name__}.open") as h5:
            return cls._read(h5)


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
    # From this version of the format on, the descriptions of arrays have checksums.
    with h5py.File(content, "w", libver=("v108", "v110"), track_order=True) as h5:
        h5.attrs["format"] = form
        yield h5
    with replacing(file) as stream:
        stream.write(content.getbuffer())


@contextmanager
def opening(file: str | os.PathLike[str], form: str, who: str) -> Iterator[Any]:
    """A file that `creating` made, of the same format.

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
    damage = (KeyError, IndexError, OSError, RuntimeError, TypeError, ValueError)
    with h5:
        try:
            found = h5.attrs.get("format")
        except damage as error:
            raise ValueError(f"{who}: '{path}' is damaged: {error}") from error
        if found != form:
            raise ValueError(f"{who}: '{path}' must be of format '{form}', got '{found}'")
        try:
            yield h5
        except damage as error:
            raise ValueError(f"{who}: '{path}' is damaged: {error}") from error


def write(h5: Any, name: str, values: Any) -> Any:
    """Write an array of numbers, or a row of texts, with its checksum; return the dataset."""
    array = np.ascontiguousarray(values)
    how: dict[str, Any] = {}
    if array.dtype.kind not in "biuf":
        array = np.array([str(one) for one in array.tolist()], object)
        how = {"dtype": optional("h5py", "suites", "write").string_dtype()}
    else:
        how = _filtered(array.shape, array.nbytes)
    data = h5.create_dataset(name, data=array, **how)
    data.attrs["crc32"] = _checksum(array)
    return data


def write_joined(h5: Any, name: str, parts: Sequence[NDArray[np.float64]]) -> None:
    """Write the parts of an array one after the other, as `write` writes them joined."""
    shape = (sum(part.size for part in parts),)
    data = h5.create_dataset(name, shape, np.float64, **_filtered(shape, 8 * shape[0]))
    checksum, begin = int(_checksum(np.empty(0), shape)), 0
    for part in parts:
        array = np.ascontiguousarray(part, np.float64)
        data[begin : begin + array.size] = array
        checksum, begin = zlib.crc32(_bytes(array), checksum), begin + array.size
    data.attrs["crc32"] = np.uint32(checksum)


def _filtered(shape: tuple[int, ...], size: int) -> dict[str, Any]:
    """How an array of that many bytes is stored: in chunks, which `fletcher32` needs."""
    if not size:
        return {}  # an empty array has no chunks
    return {"chunks": True if size > _CHUNK else shape, "fletcher32": True}


def read(h5: Any, name: str, shape: tuple[int, ...] | None = None) -> NDArray[Any]:
    """Read an array of numbers or texts that `write` wrote.

    Parameters
    ----------
    shape : tuple of int, optional
        The shape that it must have.

    Raises
    ------
    KeyError, OSError, ValueError
        It is missing, has another shape, is a link or an array outside of the file, or its checksum
        differs. `opening` makes one ValueError of all of these.
    """
    link = h5.get(name, getlink=True)
    if link is not None and type(link).__name__ != "HardLink":
        raise ValueError(f"'{name}' is a link")
    data = h5[name]
    if not hasattr(data, "dtype") or data.external or data.is_virtual:
        raise ValueError(f"'{name}' is not an array of this file")
    if shape is not None and data.shape != shape:
        raise ValueError(f"'{name}' must have shape {shape}, has {data.shape}")
    values: NDArray[Any] = data[...] if data.dtype.kind in "biuf" else data.asstr()[:]
    if data.attrs["crc32"] != _checksum(values):
        raise ValueError(f"the checksum of '{name}' differs")
    return values


def write_columns(h5: Any, name: str, columns: Mapping[str, Any]) -> None:
    """Write columns of numbers or texts as a group, in their order."""
    group = h5.create_group(name, track_order=True)
    for key, values in columns.items():
        write(group, key.replace("/", "\\"), as_column(values))  # a slash would create a group


def read_columns(h5: Any, name: str, length: int | None = None) -> dict[str, NDArray[Any]]:
    """Read the columns that `write_columns` wrote; each must have the length, if it is given."""
    shape = None if length is None else (length,)
    return {key.replace("\\", "/"): read(h5[name], key, shape) for key in h5[name]}


def _checksum(array: NDArray[Any], shape: tuple[int, ...] | None = None) -> np.uint32:
    """Of an array, or of the first part of one with another shape."""
    content: bytes | memoryview
    if array.dtype.kind == "O":
        kind, content = "texts", "".join(f"{text}\0" for text in array.tolist()).encode()
    else:
        kind, content = array.dtype.str, _bytes(array)
    about = f"{kind} {array.shape if shape is None else shape}"
    return np.uint32(zlib.crc32(content, zlib.crc32(about.encode())))


def _bytes(array: NDArray[Any]) -> memoryview:
    """The bytes of a contiguous array, not copied."""
    return array.reshape(-1).view(np.uint8).data


def _is_nothing(value: Any) -> bool:
    return value is None or (isinstance(value, float) and math.isnan(value))
