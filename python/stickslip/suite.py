"""Suites: ground motions with what is known of them, in one object, in one file."""

from __future__ import annotations

import csv
import glob
import hashlib
import io
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
from ._files import check_regular, replacing
from ._text import printable
from .records import Component, File, files_in
from .stations import Part, stations_of

__all__ = ["LeftOut", "Suite"]

_FORMAT = "stickslip suite 1"
_KEYS = ("file", "record", "name")  # columns of metadata that tell which record a row is of
_OTHERS = ("transverse", "vertical")  # components beside the axis
_SHOWN = 10  # files named in one message


class LeftOut(NamedTuple):
    """A file that `Suite.read` left out, and why."""

    file: str
    reason: str


class Suite(Sequence[GroundMotion]):
    """Ground motions with their metadata.

    A sequence: ``suite[0]`` is a GroundMotion; ``suite[2:5]``, ``suite[suite.magnitude > 6]`` and
    ``suite[[0, 3]]`` are suites. Each column of the metadata is an attribute. Whatever takes a list
    of ground motions takes a suite.

    Parameters
    ----------
    motions : iterable of GroundMotion
        At least one.
    metadata : mapping of columns or pandas DataFrame, optional
        Columns by name, each as long as the suite: numbers (NaN where one is not known) or texts.

    Attributes
    ----------
    left_out : tuple of LeftOut
        What `read` left out under ``on_error="skip"``.
    alone : tuple of LeftOut
        What fitted no station where `read` was asked for ``stations=True``, and why; these
        motions are in the suite, with one component.

    Raises
    ------
    ValueError
        No motions; a column of another length, or named like a method.
    TypeError
        Something else than a GroundMotion.

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
            column = _column(values)
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

    # ---- what is known of the motions

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
        """Largest ground acceleration of each motion [g]."""
        return np.array([m.peak_acceleration for m in self._motions]) / STANDARD_GRAVITY

    @property
    def duration(self) -> NDArray[np.float64]:
        """Of each motion [s]."""
        return np.array([m.duration for m in self._motions])

    @property
    def duplicates(self) -> list[tuple[int, ...]]:
        """The places of motions whose samples and times are the same, whatever their names.

        All components count.

        Returns
        -------
        list of tuple of int
            One tuple for each set of equals; empty where all differ.
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
        """The same motions with further columns, or others of the same name.

        Parameters
        ----------
        metadata : mapping of columns or pandas DataFrame
            As the constructor takes it.

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
        pandas = _pandas("Suite.to_dataframe")
        own = {"record": self.names, "PGA [g]": self.pga_g, "duration [s]": self.duration}
        return pandas.DataFrame({**own, **self._metadata})

    # ---- scaling

    def scaled(self, factor: ArrayLike) -> Suite:
        """The motions times a factor.

        Parameters
        ----------
        factor : float or array_like, shape (records,)
            Finite; one for all, or one for each.

        Returns
        -------
        Suite

        Raises
        ------
        ValueError
            Another number of factors; a factor that is not finite.
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
        """Each motion scaled by one factor, so that it meets a target.

        Parameters
        ----------
        pga_g : float, optional
            Largest acceleration [g], positive.
        pgv : float, optional
            Largest velocity [m/s], positive.
        arias : float, optional
            Arias intensity [m/s], positive.
        sa_g : float, optional
            Pseudo-acceleration at `period` and `damping` [g], positive.
        spectrum : ResponseSpectrum or (periods, values), optional
            Target pseudo-acceleration [m/s^2] at periods [s], positive. The factor is the one whose
            spectrum has the least mean square difference of logarithms from it:
            ln factor = mean of ln(target / Sa). A ResponseSpectrum brings its own damping.
        period : float, optional
            With `sa_g` [s], at least 0.
        damping : float, optional
            Damping ratio with `sa_g` and `spectrum`.

        Returns
        -------
        Suite

        Raises
        ------
        ValueError
            Not exactly one target; a value out of its range; a motion that is zero throughout.
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
            A folder, with all in it and below but hidden files; a pattern, as
            ``"records/**/*.AT2"``, where ``**`` is any folders; a file; or a list of these. A zip
            or tar archive of several files stands for all of them.
        units, component, dt, gaps : optional
            As `read_record` takes them, for all files. ``component="all"`` makes each component a
            motion of the suite.
        stations : bool, optional
            Group the components of each station into one GroundMotion with `transverse` and
            `vertical`, as `read_station` does. Components belong together if they are in one folder
            or archive, their names are the same but for the component, and they start at the same
            time where the files say when. Of a file that does not say where it points, the name
            does: ``CPM-090.txt``, ``TAK000.AT2``, ``TAK-UP.AT2``. What fits no station stays alone
            and is kept in `alone`. Not with `component`.
        along : str or float, optional
            With `stations`: where the axes point, as `read_station` takes it; along the first
            horizontal component of each station if not given.
        common_length : bool, optional
            With `stations`: cut the components of a station to the shortest; otherwise those of
            different lengths stay alone.
        on_error : {'raise', 'skip'}
            What becomes of files that cannot be read: 'raise' names all of them in one error;
            'skip' leaves them out, warns once at the end (RuntimeWarning), and keeps what they were
            in `left_out`.
        metadata : path-like, mapping of columns or pandas DataFrame, optional
            A table beside the records, as a CSV file with a line of names. Its column 'file',
            'record' or 'name' tells which record a row is of, by the file's path, name or stem, in
            any order. What a record has no row for is NaN or an empty text.
        threads : int, optional
            At most so many, at least 1; as many as the machine has, if not given.

        Returns
        -------
        Suite
            In order of the files' names, with the column `file` and those of the metadata. With
            ``component="all"`` also `component`, its name or number in the file. With `stations`
            also `files`, all that were grouped, parted by ``"; "``, and `components`, how many; the
            `file` is then the first, whose row of the metadata counts.

        Raises
        ------
        ValueError
            No files; files that cannot be read, all of them named, those without units first; all
            of them where they are left out; metadata without a column that names the records, or
            that names none of them; `along` or `common_length` without `stations`; `component` with
            it.
        OSError
            The folder or the metadata cannot be read.

        Warns
        -----
        RuntimeWarning
            Files were left out; components fitted no station.
        PlausibilityWarning
            Records that are the same, and what `read_record` warns of.

        Notes
        -----
        About 1 ms for 10,000 samples and thread.
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
                f"Suite.read: {len(equal)} records are there more than once: {printable(sets)}",
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
            It cannot be written.

        Notes
        -----
        8 bytes a sample. `acceleration` holds the samples of all motions one after the other
        [m/s^2], `first` where each begins, `dt` the steps [s], or NaN, where `time` holds the
        times [s]; `held` is whether values are held, `name` the names, `orientation` where the
        axes point; `transverse` and `vertical` hold the other components of the motions that have
        them, which `has_transverse` and `has_vertical` tell; `metadata` has the columns.
        """
        h5py = _h5py("Suite.save")
        content = io.BytesIO()
        with h5py.File(content, "w") as h5:
            h5.attrs["format"] = _FORMAT
            sizes = [len(m) for m in self._motions]
            h5["first"] = np.concatenate([[0], np.cumsum(sizes)])
            h5["acceleration"] = np.concatenate([m.acceleration for m in self._motions])
            h5["dt"] = [math.nan if m.dt is None else m.dt for m in self._motions]
            h5["time"] = np.concatenate([[], *(m.time for m in self._motions if m.dt is None)])
            h5["held"] = [m.interpolation == "constant" for m in self._motions]
            text = h5py.string_dtype()
            h5.create_dataset("name", data=list(self.names), dtype=text)
            h5.create_dataset("orientation", data=[m.orientation for m in self], dtype=text)
            for which in _OTHERS:
                others = [getattr(m, which) for m in self]
                h5[f"has_{which}"] = [one is not None for one in others]
                h5[which] = np.concatenate([[], *(one for one in others if one is not None)])
            group = h5.create_group("metadata", track_order=True)
            for name, column in self._metadata.items():
                key = name.replace("/", "\\")  # a slash would make a group
                if column.dtype.kind in "US":
                    group.create_dataset(key, data=column.tolist(), dtype=text)
                else:
                    group[key] = column
        with replacing(file) as stream:
            stream.write(content.getbuffer())
        return Path(file)

    @classmethod
    def open(cls, file: str | os.PathLike[str]) -> Suite:
        """Open a suite that was saved.

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
            It is no suite, or damaged.
        """
        h5py = _h5py("Suite.open")
        path = Path(os.fspath(file))
        if check_regular(path) is None:
            raise FileNotFoundError(2, "No such file or directory", str(path))
        try:
            h5 = h5py.File(path, "r")
        except OSError as error:
            raise ValueError(f"Suite.open: '{path}' is no HDF5 file, or damaged") from error
        with h5:
            if h5.attrs.get("format") != _FORMAT:
                raise ValueError(
                    f"Suite.open: '{path}' must be of format '{_FORMAT}', got"
                    f" '{h5.attrs.get('format')}'"
                )
            try:
                first, dt, held = h5["first"][:], h5["dt"][:], h5["held"][:]
                acceleration, time = h5["acceleration"][:], h5["time"][:]
                names, orientations = h5["name"].asstr()[:], h5["orientation"].asstr()[:]
                others = {which: _Taken(h5[which][:]) for which in _OTHERS}
                has = {which: h5[f"has_{which}"][:] for which in _OTHERS}
                motions, times = [], _Taken(time)
                for i, name in enumerate(names):
                    n = acceleration[first[i] : first[i + 1]]
                    about: dict[str, Any] = {
                        "interpolation": "constant" if held[i] else "linear",
                        "name": name,
                        "orientation": orientations[i],
                    }
                    about |= {w: others[w].take(n.size) for w in _OTHERS if has[w][i]}
                    about |= {"times": times.take(n.size)} if math.isnan(dt[i]) else {"dt": dt[i]}
                    motions.append(GroundMotion(n, **about))
                columns = {
                    key.replace("\\", "/"): (
                        data.asstr()[:] if h5py.check_string_dtype(data.dtype) else data[:]
                    )
                    for key, data in h5["metadata"].items()
                }
                return cls(motions, columns)
            except (KeyError, IndexError, OSError, TypeError, ValueError) as error:
                raise ValueError(f"Suite.open: '{path}' is damaged: {error}") from error


class _Taken:
    """An array of which one part after the other is taken."""

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


def _column(values: Any) -> NDArray[Any]:
    """A column as numbers, else as texts."""
    listed = list(values)
    try:
        numbers = np.array(listed)
        if numbers.dtype.kind in "biuf" and numbers.ndim == 1:
            return numbers
    except ValueError:
        pass
    return np.array(["" if _is_nothing(v) else str(v) for v in listed], dtype=str)


def _is_nothing(value: Any) -> bool:
    return value is None or (isinstance(value, float) and math.isnan(value))


def _files(source: Any) -> list[Path]:
    """The files that are meant, each once, in order of name."""
    if not isinstance(source, (str, os.PathLike)):
        return list(dict.fromkeys(path for one in source for path in _files(one)))
    path = Path(os.fspath(source))
    if path.is_dir():
        found: Iterable[Path] = path.rglob("*")
    elif glob.has_magic(os.fspath(source)) and not path.exists():
        found = map(Path, glob.glob(os.fspath(source), recursive=True))
    else:
        return [path]  # missing: read_record says so
    return sorted(
        p for p in found if not any(part.startswith(".") for part in p.parts[1:]) and p.is_file()
    )


def _same_file(a: Path, b: Path) -> bool:
    return a.name == b.name and a.exists() and b.exists() and a.samefile(b)


def _shown_source(source: Any) -> str:
    return f"'{os.fspath(source)}'" if isinstance(source, (str, os.PathLike)) else "the list"


def _reason(error: Exception, path: str) -> str:
    """What went wrong, without the name of the file."""
    if isinstance(error, OSError) and error.strerror:
        return error.strerror
    return str(error).removeprefix(f"read_record: {path}: ")


def _failures(left: Sequence[LeftOut], total: int) -> str:
    """All files that could not be read, those without units first."""
    unitless = [one for one in left if "units" in one.reason]
    others = [one for one in left if one not in unitless]
    parts = []
    if unitless:
        names = ", ".join(one.file for one in unitless[:_SHOWN])
        more = f" and {len(unitless) - _SHOWN} more" if len(unitless) > _SHOWN else ""
        parts.append(f"no usable units in {names}{more} (give units=, as 'g')")
    parts += [f"{one.file}: {one.reason}" for one in others[:_SHOWN]]
    if len(others) > _SHOWN:
        parts.append(f"and {len(others) - _SHOWN} more")
    return printable(f"cannot read {len(left)} of {total} files: {'; '.join(parts)}")


def _read_table(file: Path) -> dict[str, list[Any]]:
    """The columns of a CSV file, as numbers where all are, or nothing."""
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
    """The columns of a table in the order of the files."""
    columns = {str(name): list(values) for name, values in table.items()}
    key = next((name for k in _KEYS for name in columns if name.lower() == k), None)
    if key is None:
        raise ValueError(
            "Suite.read: metadata needs a column 'file', 'record' or 'name' that tells which record"
            f" a row is of, got {', '.join(columns)}"
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
        numeric = _column(values).dtype.kind in "biuf"
        missing: Any = math.nan if numeric else ""
        joined[name] = [missing if place is None else values[place] for place in found]
    return joined


def _pandas(who: str) -> Any:
    try:
        import pandas
    except ImportError as error:
        raise ImportError(
            f"{who}: needs pandas, which is missing; pip install stickslip[tables]"
        ) from error
    return pandas


def _h5py(who: str) -> Any:
    try:
        import h5py
    except ImportError as error:
        raise ImportError(
            f"{who}: needs h5py, which is missing; pip install stickslip[suites]"
        ) from error
    return h5py
