"""Suites: ground motions with their metadata, in one object and one file."""

from __future__ import annotations

import csv
import glob
import hashlib
import math
import operator
import os
import warnings
from collections.abc import Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, Literal, NamedTuple, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._core import (
    STANDARD_GRAVITY,
    GroundMotion,
    PlausibilityWarning,
    ResponseSpectrum,
    response_spectrum,
)
from ._hdf5 import as_column, creating, opening, read_columns, read_texts, write_columns
from ._optional import optional
from ._text import printable
from .records import Component, File, files_in
from .stations import Part, stations_of

__all__ = ["LeftOut", "Suite"]

_FORMAT = "stickslip suite 1"
_KEYS = ("file", "record", "name")  # columns of metadata that identify the record of a row
_OTHERS = ("transverse", "vertical")  # components other than that along the axis
_SHOWN = 10  # maximum number of files named in one message


class LeftOut(NamedTuple):
    """A file that `Suite.read` left out, and why."""

    file: str
    reason: str


class Suite(Sequence[GroundMotion]):
    """Ground motions with their metadata.

    A sequence: ``suite[0]`` is a GroundMotion; ``suite[2:5]``, ``suite[suite.magnitude > 6]`` and
    ``suite[[0, 3]]`` are suites. Each column of the metadata is an attribute. Functions that take
    a list of ground motions also take a suite.

    Parameters
    ----------
    motions : iterable of GroundMotion
        At least one.
    metadata : mapping of columns or pandas DataFrame, optional
        Columns by name, each as long as the suite: numbers (NaN for missing ones) or texts.

    Attributes
    ----------
    left_out : tuple of LeftOut
        The files that `read` left out under ``on_error="skip"``.
    alone : tuple of LeftOut
        The components that fitted no station under ``stations=True``, with the reasons; these
        motions are in the suite, with one component.

    Raises
    ------
    ValueError
        No motions; a column of the wrong length, or named like a method.
    TypeError
        A motion that is not a GroundMotion.

    Notes
    -----
    Objects compare by content; they can be hashed, copied and pickled.

    Examples
    --------
    >>> import stickslip as ss
    >>> quakes = ss.Suite(
    ...     [ss.GroundMotion([0, 3, -3, 0], dt=0.5), ss.GroundMotion([0, 5, 0], dt=0.5)],
    ...     {"magnitude": [6.1, 7.2]},
    ... )
    >>> len(quakes[quakes.magnitude > 6.5])
    1
    """

    def __init__(
        self, motions: Iterable[GroundMotion], metadata: Mapping[str, ArrayLike] | Any | None = None
    ) -> None:
        self._motions = tuple(motions)
        if not self._motions:
            raise ValueError("Suite: needs at least one ground motion, got none")
        for i, motion in enumerate(self._motions):
            if not isinstance(motion, GroundMotion):
                raise TypeError(
                    f"Suite: motions[{i}] must be a GroundMotion, got {type(motion).__name__}"
                )
        self._metadata: dict[str, NDArray[Any]] = {}
        for name, values in dict({} if metadata is None else metadata).items():
            column = as_column(values)
            if column.shape != (len(self),):
                raise ValueError(
                    f"Suite: metadata '{name}' must have one value for each of the {len(self)}"
                    f" motions, got {column.size}"
                )
            if not str(name) or hasattr(type(self), str(name)):
                raise ValueError(
                    f"Suite: metadata must not be named '{name}', which a suite has already"
                )
            column.setflags(write=False)
            self._metadata[str(name)] = column
        self.left_out: tuple[LeftOut, ...] = ()
        self.alone: tuple[LeftOut, ...] = ()

    # ---- a sequence

    def __len__(self) -> int:
        return len(self._motions)

    @overload
    def __getitem__(self, index: int) -> GroundMotion: ...
    @overload
    def __getitem__(self, index: slice | Sequence[int] | NDArray[Any]) -> Suite: ...
    def __getitem__(self, index: Any) -> GroundMotion | Suite:
        if isinstance(index, slice):
            return self._of(np.arange(len(self))[index])
        if isinstance(index, (int, np.integer)):
            return self._motions[operator.index(index)]
        chosen = np.asarray(index)
        if chosen.dtype == bool and chosen.shape != (len(self),):
            raise IndexError(
                f"Suite: a mask must have one value for each of the {len(self)} motions, got shape"
                f" {chosen.shape}"
            )
        if chosen.dtype.kind not in "bi" or chosen.ndim != 1:
            raise TypeError(
                "Suite: an index must be a number, a slice, a list of numbers or a mask, got"
                f" {index!r}"
            )
        return self._of(np.arange(len(self))[chosen])

    def __iter__(self) -> Iterator[GroundMotion]:
        return iter(self._motions)

    def _of(self, places: NDArray[Any]) -> Suite:
        if not places.size:
            raise ValueError(f"Suite: the selection holds none of the {len(self)} motions")
        return Suite(
            (self._motions[i] for i in places),
            {name: column[places] for name, column in self._metadata.items()},
        )

    def __getattr__(self, name: str) -> NDArray[Any]:
        metadata = self.__dict__.get("_metadata", {})
        if name in metadata:
            column: NDArray[Any] = metadata[name]
            return column
        known = ", ".join(metadata) or "none"
        raise AttributeError(f"Suite: has no column '{name}'; the columns are: {known}")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._metadata]

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Suite):
            return NotImplemented
        return (
            self._motions == other._motions
            and self._metadata.keys() == other._metadata.keys()
            and all(
                np.array_equal(a, other._metadata[name], equal_nan=a.dtype.kind == "f")
                for name, a in self._metadata.items()
                if a.dtype.kind == other._metadata[name].dtype.kind or not a.size
            )
            and all(
                a.dtype.kind == other._metadata[name].dtype.kind
                for name, a in self._metadata.items()
            )
        )

    def __hash__(self) -> int:
        return hash(self._motions)

    def __getstate__(self) -> dict[str, Any]:
        return {
            "motions": self._motions,
            "metadata": {name: column.tolist() for name, column in self._metadata.items()},
            "left_out": self.left_out,
            "alone": self.alone,
        }

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__init__(state["motions"], state["metadata"])  # type: ignore[misc]
        self.left_out = state["left_out"]
        self.alone = state["alone"]

    def __repr__(self) -> str:
        columns = ", ".join(self._metadata)
        records = "record" if len(self) == 1 else "records"
        return f"Suite({len(self)} {records}{f', with {columns}' if columns else ''})"

    # ---- properties of the motions

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the motions."""
        return tuple(motion.name for motion in self._motions)

    @property
    def metadata(self) -> dict[str, NDArray[Any]]:
        """The columns by name."""
        return dict(self._metadata)

    @property
    def pga_g(self) -> NDArray[np.float64]:
        """Peak ground acceleration of each motion [g]."""
        return np.array([m.peak_acceleration for m in self._motions]) / STANDARD_GRAVITY

    @property
    def duration(self) -> NDArray[np.float64]:
        """Duration of each motion [s]."""
        return np.array([m.duration for m in self._motions])

    @property
    def duplicates(self) -> list[tuple[int, ...]]:
        """Indices of motions with equal samples and times; names may differ.

        All components count.

        Returns
        -------
        list of tuple of int
            One tuple for each set of equal motions; empty if all differ.
        """
        places: dict[bytes, list[int]] = {}
        for i, motion in enumerate(self._motions):
            digest = hashlib.blake2b(np.ascontiguousarray(motion.acceleration).tobytes())
            digest.update(repr(motion.dt).encode())
            for other in (motion.transverse, motion.vertical):
                digest.update(b"-" if other is None else np.ascontiguousarray(other).tobytes())
            if motion.dt is None:
                digest.update(np.ascontiguousarray(motion.time).tobytes())
            places.setdefault(digest.digest(), []).append(i)
        return [tuple(equal) for equal in places.values() if len(equal) > 1]

    def with_metadata(self, metadata: Mapping[str, ArrayLike] | Any) -> Suite:
        """Add columns of metadata, or replace those of the same name.

        Parameters
        ----------
        metadata : mapping of columns or pandas DataFrame
            As for the constructor.

        Returns
        -------
        Suite
        """
        return Suite(self._motions, {**self._metadata, **dict(metadata)})

    def to_dataframe(self) -> Any:
        """A pandas DataFrame with a row for each motion: name, PGA [g], duration [s], metadata.

        Returns
        -------
        pandas.DataFrame

        Raises
        ------
        ImportError
            pandas is missing.
        """
        pandas = optional("pandas", "tables", "Suite.to_dataframe")
        own = {"record": self.names, "PGA [g]": self.pga_g, "duration [s]": self.duration}
        return pandas.DataFrame({**own, **self._metadata})

    # ---- scaling

    def scaled(self, factor: ArrayLike) -> Suite:
        """Multiply the motions by a factor.

        Parameters
        ----------
        factor : float or array_like, shape (records,)
            Finite; one for all motions, or one for each.

        Returns
        -------
        Suite

        Raises
        ------
        ValueError
            The wrong number of factors; a factor that is not finite.
        """
        factors = np.asarray(factor, float)
        if factors.ndim and factors.shape != (len(self),):
            raise ValueError(
                f"Suite.scaled: factor must be one number or {len(self)}, got shape {factors.shape}"
            )
        each = np.broadcast_to(factors, len(self))
        return Suite((m.scaled(float(f)) for m, f in zip(self._motions, each)), self._metadata)

    def scaled_to(
        self,
        *,
        pga_g: float | None = None,
        pgv: float | None = None,
        arias: float | None = None,
        sa_g: float | None = None,
        spectrum: ResponseSpectrum | tuple[ArrayLike, ArrayLike] | None = None,
        period: float | None = None,
        damping: float = 0.05,
    ) -> Suite:
        """Scale each motion by a factor so that it meets a target.

        Parameters
        ----------
        pga_g : float, optional
            Peak acceleration [g], positive.
        pgv : float, optional
            Peak velocity [m/s], positive.
        arias : float, optional
            Arias intensity [m/s], positive.
        sa_g : float, optional
            Pseudo-acceleration at `period` and `damping` [g], positive.
        spectrum : ResponseSpectrum or (periods, values), optional
            Target pseudo-acceleration [m/s^2] at periods [s], positive. The factor minimizes the
            mean square difference of logarithms between the spectrum of the motion and the target:
            ln factor = mean of ln(target / Sa). The damping is that of a ResponseSpectrum.
        period : float, optional
            Period [s] for `sa_g`, at least 0.
        damping : float, optional
            Damping ratio for `sa_g` and for `spectrum` as arrays.

        Returns
        -------
        Suite

        Raises
        ------
        ValueError
            Not exactly one target; a value out of range; a motion that is zero throughout.
        """
        targets = {"pga_g": pga_g, "pgv": pgv, "arias": arias, "sa_g": sa_g, "spectrum": spectrum}
        given = [name for name, value in targets.items() if value is not None]
        if len(given) != 1:
            raise ValueError(
                f"Suite.scaled_to: give one of {', '.join(targets)}, got"
                f" {' and '.join(given) or 'none'}"
            )
        if (sa_g is None) != (period is None):
            raise ValueError("Suite.scaled_to: sa_g and period go together, got one of them")
        if pga_g is not None:
            return Suite((m.scaled_to(pga_g=pga_g) for m in self._motions), self._metadata)
        if pgv is not None:
            return Suite((m.scaled_to(pgv=pgv) for m in self._motions), self._metadata)
        if arias is not None:
            return Suite((m.scaled_to(arias=arias) for m in self._motions), self._metadata)
        if sa_g is not None:
            periods, target = np.array([period], float), np.array([sa_g * STANDARD_GRAVITY])
        elif isinstance(spectrum, ResponseSpectrum):
            if spectrum.kind != "pseudo_acceleration" or len(spectrum.damping) != 1:
                raise ValueError(
                    "Suite.scaled_to: spectrum must be of pseudo-acceleration at one damping, got"
                    f" {spectrum!r}"
                )
            periods, damping = np.array(spectrum.periods), float(spectrum.damping[0])
            target = np.array(spectrum.values).reshape(-1)
        else:
            assert spectrum is not None
            periods, target = (np.asarray(part, float) for part in spectrum)
        if periods.shape != target.shape or periods.ndim != 1 or not periods.size:
            raise ValueError(
                "Suite.scaled_to: spectrum must have as many values as periods, got"
                f" {target.shape} and {periods.shape}"
            )
        if not (np.isfinite(target).all() and (target > 0).all()):
            raise ValueError(
                f"Suite.scaled_to: targets must be positive and finite, got {target.min()} m/s^2"
            )
        factors = []
        for motion in self._motions:
            if not motion.peak_acceleration > 0:
                raise ValueError(f"Suite.scaled_to: '{motion.name}' is zero throughout")
            own = np.asarray(response_spectrum(motion, periods, damping).values).reshape(-1)
            factors.append(math.exp(np.mean(np.log(target / own))))
        return self.scaled(factors)

    # ---- files

    @classmethod
    def read(
        cls,
        files: str | os.PathLike[str] | Iterable[str | os.PathLike[str]],
        *,
        units: str | None = None,
        component: str | int | None = None,
        dt: float | None = None,
        gaps: bool = False,
        stations: bool = False,
        along: str | float | None = None,
        common_length: bool = False,
        on_error: Literal["raise", "skip"] = "raise",
        metadata: str | os.PathLike[str] | Mapping[str, ArrayLike] | Any | None = None,
        threads: int | None = None,
    ) -> Suite:
        """Read records from files, as `read_record` does, on several threads.

        Parameters
        ----------
        files : path-like, str or iterable of these
            A folder, including subfolders but not hidden files; a pattern, such as
            ``"records/**/*.AT2"``, where ``**`` matches any folders; a file; or a list of these. A
            zip or tar archive of several files represents all of them.
        units, component, dt, gaps : optional
            As for `read_record`; they apply to all files. ``component="all"`` makes each component
            a motion of the suite.
        stations : bool, optional
            Group the components of each station into one GroundMotion with `transverse` and
            `vertical`, as `read_station` does. Components belong together if they are in the same
            folder or archive, if their names differ only in the component, and if they start at the
            same time, where the files state it. If a file does not state its orientation, its name
            does: ``CPM-090.txt``, ``TAK000.AT2``, ``TAK-UP.AT2``. A component that fits no station
            remains a separate motion and is listed in `alone`. Not with `component`.
        along : str or float, optional
            With `stations`: direction of the axes, as for `read_station`. Default: the first
            horizontal component of each station.
        common_length : bool, optional
            With `stations`: cut the components of a station to the shortest one; otherwise
            components of different lengths remain separate.
        on_error : {'raise', 'skip'}
            What to do about files that cannot be read: 'raise' names all of them in one error;
            'skip' leaves them out, warns once at the end (RuntimeWarning), and lists them in
            `left_out`.
        metadata : path-like, mapping of columns or pandas DataFrame, optional
            A table with rows in any order, for instance a CSV file with a line of column names. Its
            column 'file', 'record' or 'name' identifies the record of a row by the path, name or
            stem of the file. A record without a row gets NaN or an empty text.
        threads : int, optional
            Maximum number of threads, at least 1; default: all cores.

        Returns
        -------
        Suite
            Sorted by file name, with the column `file` and those of the metadata. With
            ``component="all"`` also `component`, its name or number in the file. With `stations`
            also `files`, all grouped files, separated by ``"; "``, and `components`, their number;
            `file` is then the first of them, which identifies the row of the metadata.

        Raises
        ------
        ValueError
            No files; files that cannot be read (named, those without units first; with 'skip', only
            if no file can be read); metadata without a column that identifies the records, or that
            identifies none of them; `along` or `common_length` without `stations`; `component` with
            `stations`.
        OSError
            The folder or the metadata cannot be read.

        Warns
        -----
        RuntimeWarning
            Files were left out; components fitted no station.
        PlausibilityWarning
            Equal records, and the warnings of `read_record`.

        Notes
        -----
        Takes about 1 ms per 10,000 samples on each thread.
        """
        if on_error not in ("raise", "skip"):
            raise ValueError(f"Suite.read: on_error must be 'raise' or 'skip', got {on_error!r}")
        if threads is not None and operator.index(threads) < 1:
            raise ValueError(f"Suite.read: threads must be at least 1, got {threads}")
        if stations and component is not None:
            raise ValueError("Suite.read: component and stations must not both be given")
        if not stations and (along is not None or common_length):
            given = "along" if along is not None else "common_length"
            raise ValueError(f"Suite.read: {given} needs stations=True")
        table = Path(os.fspath(metadata)) if isinstance(metadata, (str, os.PathLike)) else None
        paths = [p for p in _files(files) if table is None or not _same_file(p, table)]
        if not paths:
            raise ValueError(f"Suite.read: no files in {_shown_source(files)}")

        every = stations or component == "all"
        one = None if every else component

        def read(path: Path) -> list[tuple[str, list[Component] | Exception]]:
            options: dict[str, Any] = {"units": units, "dt": dt, "gaps": gaps}
            try:
                inside = files_in(path, component=one, only_one=not every, **options)
            except (OSError, ValueError) as error:
                return [(str(path), error)]
            return [(file.shown, _tried(file)) for file in inside]

        with ThreadPoolExecutor(threads or os.cpu_count() or 1) as pool:
            found = [each for several in pool.map(read, paths, chunksize=16) for each in several]
        left = [
            LeftOut(file, _reason(answer, file))
            for file, answer in found
            if isinstance(answer, Exception)
        ]
        parts = [
            Part(file, number, part)
            for file, answer in found
            if not isinstance(answer, Exception)
            for number, part in enumerate(answer, 1)
        ]
        if left and (on_error == "raise" or not parts):
            raise ValueError(
                f"Suite.read: {_failures(left, len(found))}"
                + ('; on_error="skip" leaves them out' if on_error == "raise" and parts else "")
            )
        alone: list[LeftOut] = []
        columns: dict[str, Any]
        if stations:
            grouped, lonely = stations_of(parts, along, common_length)
            alone = [LeftOut(*one) for one in lonely]
            motions = [station.motion for station in grouped]
            names = [station.files[0] for station in grouped]
            columns = {
                "file": names,
                "files": ["; ".join(station.files) for station in grouped],
                "components": [station.components for station in grouped],
            }
        else:
            motions = [part.component.motion for part in parts]
            names = [part.file for part in parts]
            columns = {"file": names}
            if component == "all":
                columns["component"] = [p.component.name or str(p.number) for p in parts]
        for motion in motions:
            _core._warn_if_implausible(motion, "read_record", 2)
        if metadata is not None:
            columns |= _joined(names, _read_table(table) if table else dict(metadata))
        suite = cls(motions, columns)
        suite.left_out, suite.alone = tuple(left), tuple(alone)
        if left:
            warnings.warn(
                f"Suite.read: {_failures(left, len(found))}; they are left out",
                RuntimeWarning,
                stacklevel=2,
            )
        if alone:
            shown = [f"{one.file}: {one.reason}" for one in alone[:_SHOWN]]
            shown += [f"and {len(alone) - _SHOWN} more"] if len(alone) > _SHOWN else []
            warnings.warn(
                printable(
                    f"Suite.read: {len(alone)} of {len(parts)} components fit no station and stay"
                    f" alone: {'; '.join(shown)}"
                ),
                RuntimeWarning,
                stacklevel=2,
            )
        if equal := suite.duplicates:
            sets = "; ".join(
                " = ".join(Path(names[i]).name for i in places) for places in equal[:_SHOWN]
            )
            warnings.warn(
                f"Suite.read: records that occur more than once: {len(equal)}: {printable(sets)}",
                PlausibilityWarning,
                stacklevel=2,
            )
        return suite

    def save(self, file: str | os.PathLike[str]) -> Path:
        """Write all motions and their metadata to one HDF5 file.

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

        Notes
        -----
        The file takes 8 bytes per sample. `acceleration` holds the samples of all motions one after
        the other [m/s^2]; `first` the index at which each motion begins; `dt` the steps [s], or NaN
        for motions whose times [s] are in `time`; `held` whether values are constant between
        samples; `name` the names; `orientation` the directions of the axes; `transverse` and
        `vertical` the other components of the motions for which `has_transverse` and
        `has_vertical` are true; `metadata` the columns.
        """
        with creating(file, _FORMAT, "Suite.save") as h5:
            sizes = [len(m) for m in self._motions]
            h5["first"] = np.concatenate([[0], np.cumsum(sizes)])
            h5["acceleration"] = np.concatenate([m.acceleration for m in self._motions])
            h5["dt"] = [math.nan if m.dt is None else m.dt for m in self._motions]
            h5["time"] = np.concatenate([[], *(m.time for m in self._motions if m.dt is None)])
            h5["held"] = [m.interpolation == "constant" for m in self._motions]
            h5["name"] = list(self.names)
            h5["orientation"] = [m.orientation for m in self]
            for which in _OTHERS:
                others = [getattr(m, which) for m in self]
                h5[f"has_{which}"] = [one is not None for one in others]
                h5[which] = np.concatenate([[], *(one for one in others if one is not None)])
            write_columns(h5, "metadata", self._metadata)
        return Path(file)

    @classmethod
    def open(cls, file: str | os.PathLike[str]) -> Suite:
        """Open a saved suite.

        Parameters
        ----------
        file : path-like

        Returns
        -------
        Suite
            Equal to the one that was saved, to the last bit.

        Raises
        ------
        ImportError
            h5py is missing: ``pip install stickslip[suites]``.
        OSError
            The file is missing or cannot be read.
        ValueError
            The file is not a suite, or is damaged.
        """
        with opening(file, _FORMAT, "Suite.open") as h5:
            first, dt, held = h5["first"][:], h5["dt"][:], h5["held"][:]
            acceleration, times = h5["acceleration"][:], _Taken(h5["time"][:])
            orientations = read_texts(h5["orientation"])
            others = {which: _Taken(h5[which][:]) for which in _OTHERS}
            has = {which: h5[f"has_{which}"][:] for which in _OTHERS}
            motions = []
            for i, name in enumerate(read_texts(h5["name"])):
                n = acceleration[first[i] : first[i + 1]]
                about: dict[str, Any] = {
                    "interpolation": "constant" if held[i] else "linear",
                    "name": name,
                    "orientation": orientations[i],
                }
                about |= {w: others[w].take(n.size) for w in _OTHERS if has[w][i]}
                about |= {"times": times.take(n.size)} if math.isnan(dt[i]) else {"dt": dt[i]}
                motions.append(_core._ground_motion(n, **about))
            return cls(motions, read_columns(h5, "metadata"))


class _Taken:
    """An array from which consecutive parts are taken."""

    def __init__(self, values: NDArray[np.float64]) -> None:
        self.values, self.used = values, 0

    def take(self, count: int) -> NDArray[np.float64]:
        self.used += count
        return self.values[self.used - count : self.used]


def _tried(file: File) -> list[Component] | Exception:
    try:
        return file.read()
    except (OSError, ValueError) as error:
        return error


def _files(source: Any) -> list[Path]:
    """The files of a source, each once, sorted by name."""
    if not isinstance(source, (str, os.PathLike)):
        return list(dict.fromkeys(path for one in source for path in _files(one)))
    path = Path(os.fspath(source))
    if path.is_dir():
        found: Iterable[Path] = path.rglob("*")
    elif glob.has_magic(os.fspath(source)) and not path.exists():
        found = map(Path, glob.glob(os.fspath(source), recursive=True))
    else:
        return [path]  # if it is missing, read_record says so
    return sorted(
        p for p in found if not any(part.startswith(".") for part in p.parts[1:]) and p.is_file()
    )


def _same_file(a: Path, b: Path) -> bool:
    return a.name == b.name and a.exists() and b.exists() and a.samefile(b)


def _shown_source(source: Any) -> str:
    return f"'{os.fspath(source)}'" if isinstance(source, (str, os.PathLike)) else "the list"


def _reason(error: Exception, path: str) -> str:
    """The reason for an error, without the name of the file."""
    if isinstance(error, OSError) and error.strerror:
        return error.strerror
    return str(error).removeprefix(f"read_record: {path}: ")


def _failures(left: Sequence[LeftOut], total: int) -> str:
    """A message about all files that could not be read, those without units first."""
    unitless = [one for one in left if "units" in one.reason]
    others = [one for one in left if one not in unitless]
    parts = []
    if unitless:
        names = ", ".join(one.file for one in unitless[:_SHOWN])
        more = f" and {len(unitless) - _SHOWN} more" if len(unitless) > _SHOWN else ""
        parts.append(f"no usable units in {names}{more} (give units=, such as 'g')")
    parts += [f"{one.file}: {one.reason}" for one in others[:_SHOWN]]
    if len(others) > _SHOWN:
        parts.append(f"and {len(others) - _SHOWN} more")
    return printable(f"cannot read {len(left)} of {total} files: {'; '.join(parts)}")


def _read_table(file: Path) -> dict[str, list[Any]]:
    """The columns of a CSV file, as numbers if all cells are numbers or empty."""
    with file.open(newline="", encoding="utf-8-sig") as stream:
        rows = list(csv.reader(stream))
    rows = [row for row in rows if any(cell.strip() for cell in row)]
    if len(rows) < 2:
        raise ValueError(f"Suite.read: metadata '{file}' must have names and at least one row")
    names = [cell.strip() for cell in rows[0]]
    for number, row in enumerate(rows[1:], 2):
        if len(row) != len(names):
            raise ValueError(
                f"Suite.read: metadata '{file}': row {number} must have {len(names)} cells, got"
                f" {len(row)}"
            )
    return {name: _typed([row[i].strip() for row in rows[1:]]) for i, name in enumerate(names)}


def _typed(cells: list[str]) -> list[Any]:
    try:
        return [float(cell) if cell else math.nan for cell in cells]
    except ValueError:
        return list(cells)


def _joined(files: Sequence[str], table: Mapping[str, Any]) -> dict[str, list[Any]]:
    """The columns of a table, in the order of the files."""
    columns = {str(name): list(values) for name, values in table.items()}
    key = next((name for k in _KEYS for name in columns if name.lower() == k), None)
    if key is None:
        raise ValueError(
            "Suite.read: metadata needs a column 'file', 'record' or 'name' that identifies the"
            f" record of a row, got {', '.join(columns)}"
        )
    rows: dict[str, int] = {}
    for i, value in enumerate(map(str, columns[key])):
        if value in rows:
            raise ValueError(f"Suite.read: metadata has two rows for '{value}'")
        rows[value] = i
    found = [
        next((rows[n] for n in (f, Path(f).name, Path(f).stem) if n in rows), None) for f in files
    ]
    if all(place is None for place in found):
        raise ValueError(
            f"Suite.read: metadata has a row for none of the {len(files)} records; its '{key}' has"
            f" '{columns[key][0]}', the first file is '{Path(files[0]).name}'"
        )
    joined = {}
    for name, values in columns.items():
        if name == key:
            continue
        numeric = as_column(values).dtype.kind in "biuf"
        missing: Any = math.nan if numeric else ""
        joined[name] = [missing if place is None else values[place] for place in found]
    return joined
