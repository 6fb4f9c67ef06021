"""Ensembles in files: NumPy archives, every byte of which is checked."""

from __future__ import annotations

import io
import json
import os
import zipfile
from pathlib import Path

import numpy as np

from .. import _core
from .._core import Ensemble
from .._files import check_regular, replacing

_FORMAT = "stickslip ensemble 1"
_ABOUT = frozenset(("format", "library"))
_NAMES = _ABOUT | {
    *("configuration", "dt", "times", "velocity_spectrum", "ground_acceleration"),
    *("level", "number", "count", "sums", "cut_block", "cut_size"),
    *("kept_block", "kept_size", "peak", "residual", "bin", "bin_count"),
    *("airborne", "gaps", "hits", "impact_block", "impacts_forward", "impacts_backward"),
    *("impact_speed_forward", "impact_speed_backward"),
    *("in_plane", "residual_transverse", "floor_peaks"),
}


def save(ensemble: Ensemble, file: str | os.PathLike[str]) -> None:
    """Implementation of `Ensemble.save` (see there)."""
    state = ensemble.__getstate__()
    state["configuration"] = json.dumps(state["configuration"])
    with replacing(file) as stream:
        np.savez(stream, format=_FORMAT, library=_core.__version__, **state)


def load(file: str | os.PathLike[str]) -> Ensemble:
    """Implementation of `Ensemble.load` (see there)."""
    path = Path(os.fspath(file))

    def refuse(what: str) -> ValueError:
        return ValueError(f"Ensemble.load: '{path}' {what}")

    check_regular(path)
    with path.open("rb") as stream:
        if stream.read(4) != b"PK\x03\x04":
            raise refuse("is not an ensemble: not a NumPy archive (.npz)")
        try:
            archive = zipfile.ZipFile(stream)
        except zipfile.BadZipFile as error:
            raise refuse("is truncated or damaged: its table of contents is missing") from error
        except Exception as error:  # a damaged table can raise anything
            raise refuse(f"is damaged: {error}") from error
        try:
            entries = _entries(archive, path.stat().st_size)
            about = {name: _array(archive, entries[name]) for name in _ABOUT if name in entries}
        except Exception as error:
            raise refuse(f"is damaged: {error}") from error
        if not str(about.get("format")).startswith("stickslip ensemble "):
            raise refuse(f"is not an ensemble: it holds {', '.join(sorted(entries)) or 'nothing'}")
        if str(about["format"]) != _FORMAT:
            raise refuse(
                f"is of format '{about['format']}', of stickslip {about.get('library')}; this is"
                f" stickslip {_core.__version__}, which reads '{_FORMAT}'"
            )
        if entries.keys() != _NAMES:
            odd = ", ".join(sorted(entries.keys() ^ _NAMES))
            raise refuse(f"does not hold what an ensemble does: missing or unknown {odd}")
        try:
            state = {name: _array(archive, entries[name]) for name in _NAMES - _ABOUT}
        except Exception as error:
            raise refuse(f"is damaged: {error}") from error
    ensemble = Ensemble.__new__(Ensemble)
    try:
        plain = {name: array.item() if array.ndim == 0 else array for name, array in state.items()}
        plain["configuration"] = [tuple(entry) for entry in json.loads(plain["configuration"])]
        ensemble.__setstate__(plain)
    except (RuntimeError, TypeError, ValueError) as error:
        raise refuse(f"does not hold what an ensemble does: {error}") from error
    return ensemble


def _entries(archive: zipfile.ZipFile, size: int) -> dict[str, zipfile.ZipInfo]:
    """The entries of an archive by name; ValueError if they take more memory than the file."""
    entries = {info.filename.removesuffix(".npy"): info for info in archive.infolist()}
    if len(entries) < len(archive.infolist()):
        raise ValueError("two entries have the same name")
    for name, info in entries.items():
        if info.compress_type != zipfile.ZIP_STORED or info.file_size != info.compress_size:
            raise ValueError(f"{name} must not be compressed")
    if sum(info.file_size for info in entries.values()) > size:
        raise ValueError("its entries overlap")
    return entries


def _array(archive: zipfile.ZipFile, entry: zipfile.ZipInfo) -> np.ndarray:
    """Read the array of an entry; an error if its checksum or size is wrong."""
    content = archive.read(entry)
    stream = io.BytesIO(content)
    if np.lib.format.read_magic(stream) != (1, 0):
        raise ValueError(f"{entry.filename} is not an array of format 1.0")
    shape, is_fortran, dtype = np.lib.format.read_array_header_1_0(stream)
    array = np.frombuffer(content, dtype, offset=stream.tell())
    return array.reshape(shape, order="F" if is_fortran else "C")
