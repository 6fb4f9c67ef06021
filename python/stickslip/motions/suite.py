"""Suites: ground motions with their metadata, in one object and one file."""

from __future__ import annotations

import math
import operator
import os
import warnings
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, Literal, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core
from .._core import (
    STANDARD_GRAVITY,
    GroundMotion,
    ResponseSpectrum,
    identity,
)
from .._hdf5 import Saved, as_column, read, read_columns, write, write_columns, write_joined
from .._numbers import real, reals
from .._tabular import Tabular
from ..runs.progress import Progress
from .intensity import (
    LEVEL_UNITS,
    Directions,
    IntensityMeasures,
    beside,
    check_directions,
    level_of,
    over_directions,
    spectrum_of,
)
from .reading import LeftOut, free_names, read_suite

__all__ = ["LeftOut", "Suite"]

_OTHERS = ("transverse", "vertical")  # components other than that along the axis


class Suite(Tabular, Saved, Sequence[GroundMotion]):
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
        The files that `read` left out under ``on_error="skip"``, what archives hold beside their
        records, and vertical components.
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

    The file of `save` takes 8 bytes per sample. `acceleration` holds the samples of all motions one
    after the other [m/s^2]; `first` the index at which each motion begins; `dt` the steps [s], or
    NaN for motions whose times [s] are in `time`; `held` whether values are constant between
    samples; `name` the names; `orientation` the directions of the axes; `transverse` and `vertical`
    the other components of the motions for which `has_transverse` and `has_vertical` are true;
    `metadata` the columns.

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

    _format = "stickslip suite 1"

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
        named = {str(n): v for n, v in dict({} if metadata is None else metadata).items()}
        columns, renamed = free_names(type(self), named)
        if renamed:
            warnings.warn(f"Suite: {renamed}", RuntimeWarning, stacklevel=2)
        for name, values in columns.items():
            column = as_column(values)
            if column.shape != (len(self),):
                raise ValueError(
                    f"Suite: metadata '{name}' must have one value for each of the {len(self)}"
                    f" motions, got {column.size}"
                )
            if not name or hasattr(type(self), name):
                raise ValueError(
                    f"Suite: metadata must not be named '{name}', which a suite has already"
                )
            column.setflags(write=False)
            self._metadata[name] = column
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
        return f"<Suite: {len(self)} {records}{f', with {columns}' if columns else ''}>"

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
        places: dict[str, list[int]] = {}
        for i, motion in enumerate(self._motions):
            places.setdefault(identity(motion), []).append(i)
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

    def intensity_measures(self) -> IntensityMeasures:
        """Compute the intensity measures of each record, as `strong_motion` does.

        Returns
        -------
        IntensityMeasures
            PGA, PGV, PGD, Arias intensity, CAV, D5-75, D5-95, T_m and others as arrays, with
            `to_dataframe`, `to_csv` and `to_json`.

        Warns
        -----
        RuntimeWarning
            Records for which `strong_motion` fails, as of zeros; their values are NaN.
        """
        return IntensityMeasures(self)

    def _table(self) -> tuple[Mapping[str, NDArray[Any]], Mapping[str, str]]:
        own = {"record": np.array(self.names), "pga_g": self.pga_g, "duration": self.duration}
        return beside(own, self._metadata), {"pga_g": "g", "duration": "s"}

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
        period_range: tuple[float, float] | None = None,
        at_least: float | None = None,
        damping: float = 0.05,
        directions: Directions | Literal["srss"] | None = None,
    ) -> Suite:
        """Scale each motion by a factor so that it meets a target.

        All components of a motion have the same factor.

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
        period_range : (float, float), optional
            The periods over which `spectrum` counts [s], positive, increasing, among those of the
            target: 51 in equal ratios, and those of the target between them. The target is a
            straight line in logarithms between its points. Default: its points.
        at_least : float, optional
            For `spectrum`: where the mean of the scaled spectra over the records falls below this
            multiple of the target, all factors grow by one more factor, so that it nowhere does.
        damping : float, optional
            Damping ratio for `sa_g` and for `spectrum` as arrays.
        directions : {'axis', 'rotd50', 'rotd100', 'srss'}, optional
            What meets the target: the component along the axis; the median or the maximum over the
            horizontal directions, in steps of 1 degree; or, for `sa_g` and `spectrum`, the root of
            the sum of the squares of the spectra of both components. Default: 'rotd50' for motions
            with a transverse component, 'axis' for others, which have no choice.

        Returns
        -------
        Suite

        Raises
        ------
        ValueError
            Not exactly one target; a value out of range; a motion that is zero throughout;
            directions other than these; `period_range` or `at_least` without `spectrum`.
        """
        targets = {"pga_g": pga_g, "pgv": pgv, "arias": arias, "sa_g": sa_g, "spectrum": spectrum}
        given = [name for name, value in targets.items() if value is not None]
        if len(given) != 1:
            raise ValueError(
                f"Suite.scaled_to: give one of {', '.join(targets)}, got"
                f" {' and '.join(given) or 'none'}"
            )
        if spectrum is None:
            for what, value in (("period_range", period_range), ("at_least", at_least)):
                if value is not None:
                    raise ValueError(
                        f"Suite.scaled_to: {what} goes with spectrum, got it with {given[0]}"
                    )
            level = targets[given[0]]
            return self.scaled(
                self._factors("scaled_to", given[0], level, period, damping, directions)
            )
        if period is not None:
            raise ValueError("Suite.scaled_to: period goes with sa_g, got it with spectrum")
        if isinstance(spectrum, ResponseSpectrum):
            if spectrum.kind != "pseudo_acceleration" or len(spectrum.damping) != 1:
                raise ValueError(
                    "Suite.scaled_to: spectrum must be of pseudo-acceleration at one damping, got"
                    f" {spectrum!r}"
                )
            periods, damping = np.array(spectrum.periods), float(spectrum.damping[0])
            target = np.array(spectrum.values).reshape(-1)
        else:
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
        if period_range is not None:
            periods, target = _within(periods, target, period_range)
        self._require_motion("scaled_to")
        check_directions(directions, "Suite.scaled_to", "spectrum")
        own = np.array(
            [
                spectrum_of(m, periods, damping, over_directions(m, directions))
                for m in self._motions
            ]
        )
        factors = np.exp(np.log(target / own).mean(axis=1))
        if at_least is not None:
            floor = real(at_least, "Suite.scaled_to: at_least")
            if not 0 < floor < math.inf:
                raise ValueError(
                    f"Suite.scaled_to: at_least must be positive and finite, got {floor:g}"
                )
            mean = (factors[:, np.newaxis] * own).mean(axis=0)
            factors *= max(1.0, float((floor * target / mean).max()))
        return self.scaled(factors)

    def stripes(
        self,
        *,
        pga_g: ArrayLike | None = None,
        pgv: ArrayLike | None = None,
        arias: ArrayLike | None = None,
        sa_g: ArrayLike | None = None,
        period: float | None = None,
        damping: float = 0.05,
        directions: Directions | None = None,
    ) -> Suite:
        """Scale each motion to each of several levels of one intensity measure.

        Multiple stripe analysis evaluates the scaled motions of each level, a stripe; incremental
        dynamic analysis follows each record over the levels. A cloud is the suite as it is.

        Parameters
        ----------
        pga_g : array_like, shape (levels,), optional
            Peak accelerations [g]. Levels are positive; give exactly one intensity measure.
        pgv : array_like, shape (levels,), optional
            Peak velocities [m/s].
        arias : array_like, shape (levels,), optional
            Arias intensities [m/s].
        sa_g : array_like, shape (levels,), optional
            Pseudo-accelerations at `period` and `damping` [g].
        period : float, optional
            Period [s] for `sa_g`, at least 0.
        damping : float, optional
            Damping ratio for `sa_g`.
        directions : {'axis', 'rotd50', 'rotd100'}, optional
            As for `scaled_to`.

        Returns
        -------
        Suite
            All motions at the first level, then all at the second, and so on. The metadata of each
            motion gain `record`, the name of the record that was scaled, which is different for
            each record of this suite; `stripe`, the level; `factor`; and, if there are pairs,
            `directions`, such as 'rotd50'. The level is also in a column with the name of the
            measure: `pgv`, `arias` or `sa_g` with `sa_period`; the property `pga_g` is that of the
            axis. If the suite has a column `record` already, it is kept: motions with the same
            `record`, such as two components of one station, count as one record.

        Raises
        ------
        ValueError
            Not exactly one measure; no levels, or one that is not positive and finite; `sa_g`
            without `period`, or the reverse; a motion whose measure is zero, which is named.

        Examples
        --------
        >>> import stickslip as ss
        >>> quakes = ss.Suite([ss.GroundMotion([0, 3, -3, 0], dt=0.5, name="A")])
        >>> stripes = quakes.stripes(pga_g=[0.1, 0.2])
        >>> [(name, float(level)) for name, level in zip(stripes.record, stripes.stripe)]
        [('A', 0.1), ('A', 0.2)]
        >>> len(stripes[stripes.stripe == 0.2])
        1

        Notes
        -----
        Factors change amplitudes only; a record scaled by a large factor lacks the frequency
        content and the duration of a stronger earthquake.
        """
        targets = {"pga_g": pga_g, "pgv": pgv, "arias": arias, "sa_g": sa_g}
        given = [name for name, value in targets.items() if value is not None]
        if len(given) != 1:
            raise ValueError(
                f"Suite.stripes: give one of {', '.join(targets)}, got"
                f" {' and '.join(given) or 'none'}"
            )
        measure = given[0]
        levels = np.atleast_1d(reals(targets[measure], f"Suite.stripes: {measure}"))
        if levels.ndim != 1 or not levels.size:
            raise ValueError(f"Suite.stripes: {measure} must be a list of levels, got {levels!r}")
        if len(np.unique(levels)) < len(levels):
            twice = next(x for i, x in enumerate(levels) if x in levels[:i])
            raise ValueError(f"Suite.stripes: a level counts once, got {measure} = {twice:g} twice")
        if "stripe" in self._metadata:
            raise ValueError(
                "Suite.stripes: this suite consists of stripes already; give its levels at once"
            )
        factors = self._factors(
            "stripes", measure, levels[:, np.newaxis], period, damping, directions
        )
        count, records = len(levels), len(self)
        columns = {name: np.tile(column, count) for name, column in self._metadata.items()}
        columns.setdefault("record", np.tile(self._different_names(), count))
        columns["stripe"] = np.repeat(levels, records)
        columns["factor"] = factors.ravel()
        counted = [over_directions(motion, directions) for motion in self._motions]
        if set(counted) != {"axis"}:
            columns["directions"] = np.tile(counted, count)
        if measure != "pga_g":  # a property of every suite
            columns[measure] = columns["stripe"]
        if period is not None:
            columns["sa_period"] = np.full(count * records, float(period))
        motions = (m.scaled(float(f)) for row in factors for m, f in zip(self._motions, row))
        return Suite(motions, columns)

    def _factors(
        self,
        who: str,
        measure: str,
        levels: Any,
        period: float | None,
        damping: float,
        directions: str | None,
    ) -> NDArray[np.float64]:
        """The factors that scale each motion to a level, or, of a column of levels, to each."""
        if (measure == "sa_g") != (period is not None):
            raise ValueError(
                f"Suite.{who}: sa_g needs period= [s], the period of the pseudo-acceleration"
                if measure == "sa_g"
                else f"Suite.{who}: period goes with sa_g, got it with {measure}"
            )
        target = np.asarray(levels, float)
        wrong = target[~(np.isfinite(target) & (target > 0))]
        if wrong.size:
            raise ValueError(
                f"Suite.{who}: {measure} must be positive and finite, got {wrong[0]:g}"
                f" {LEVEL_UNITS[measure]}"
            )
        self._require_motion(who)
        check_directions(directions, f"Suite.{who}", measure)
        own = np.array(
            [
                level_of(m, measure, period, damping, over_directions(m, directions))
                for m in self._motions
            ]
        )
        zero = np.flatnonzero(~(own > 0))
        if zero.size:
            raise ValueError(
                f"Suite.{who}: the {measure} of '{self._motions[zero[0]].name}' is zero, so no"
                " factor scales it"
            )
        factors: NDArray[np.float64] = target / own
        return np.sqrt(factors) if measure == "arias" else factors  # quadratic in the amplitude

    def _different_names(self) -> list[str]:
        """The names of the motions, numbered where they are empty or occur before."""
        seen: dict[str, int] = {}
        names = []
        for i, name in enumerate(self.names):
            plain = name or f"record {i}"
            seen[plain] = seen.get(plain, 0) + 1
            names.append(plain if seen[plain] == 1 else f"{plain} ({seen[plain]})")
        return names

    def _require_motion(self, who: str) -> None:
        for motion in self._motions:
            if not motion.peak_acceleration > 0:
                raise ValueError(f"Suite.{who}: '{motion.name}' is zero throughout")

    # ---- files

    @classmethod
    def read(
        cls,
        files: str | os.PathLike[str] | Iterable[str | os.PathLike[str]],
        *,
        units: str | None = None,
        component: str | int | None = None,
        dt: float | str | None = None,
        orientation: float | str | None = None,
        gaps: bool = False,
        detrend: Literal["mean", "line"] | None = None,
        stations: bool = False,
        along: str | float | None = None,
        common_length: bool = False,
        on_error: Literal["raise", "skip"] = "raise",
        metadata: str | os.PathLike[str] | Mapping[str, ArrayLike] | Any | None = None,
        threads: int | None = None,
        progress: bool | Progress | None = None,
    ) -> Suite:
        """Read records from files, as `read_record` does, on several threads.

        Parameters
        ----------
        files : path-like, str or iterable of these
            A folder, including subfolders but not hidden files; a pattern, such as
            ``"records/**/*.AT2"``, where ``**`` matches any folders; a file; or a list of these. A
            zip or tar archive of several files represents all records in it; velocities, lists and
            texts beside them are left out, with a warning, and listed in `left_out`.
        units : str, optional
            Unit of acceleration of the files that state none, as for `read_record`; or the name of
            a column of `metadata` with a unit for each record.
        dt : float or str, optional
            Time step [s] of the files that state none; or the name of a column of `metadata`.
        orientation : float or str, optional
            Direction of the component in files that do not state it: an azimuth [degrees], a text
            such as 'N28W' or 'up', or the name of a column of `metadata`.
        component : str or int, optional
            Name or number of the component in files with several, as for `read_record`. ``"all"``
            makes each horizontal component a motion of the suite, ``"vertical"`` each vertical one.
            A component that is known to point up or down is otherwise left out, and listed in
            `left_out`, unless its name or number is given: sliders move horizontally.
        gaps, detrend
            As for `read_record`; they apply to all files.
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
            stem of the file. A record without a row gets NaN or an empty text. Columns named
            'units', 'dt' (or 'dt_s') and 'orientation' apply to their records, even if `units`,
            `dt` and `orientation` do not name them. What a file states takes precedence over its
            row, which must agree with it, and the row over a value for all files. A column with a
            name that a suite has already, such as 'pga_g', is renamed, to 'pga_g_given'.
        threads : int, optional
            Maximum number of threads, at least 1; default: all cores.
        progress : bool or callable, optional
            A bar as for `run_ensemble`; a callable is called with the number of files read and the
            total.

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
            No files; files that cannot be read (grouped by reason; with 'skip', only if no file can
            be read), among them one whose row of the metadata contradicts it; only vertical
            components; metadata without a column that identifies the records, or that identifies
            none of them; `units`, `dt` or `orientation` that is neither a value nor a column;
            `along` or `common_length` without `stations`; `component` with `stations`.
        OSError
            The folder or the metadata cannot be read.

        Warns
        -----
        RuntimeWarning
            Files, vertical components or what is no record were left out; components fitted no
            station; a column was renamed.
        PlausibilityWarning
            Equal records, and the warnings of `read_record`.

        Notes
        -----
        Takes about 1 ms per 10,000 samples on each thread.
        """
        return read_suite(
            cls,
            files,
            units=units,
            component=component,
            dt=dt,
            orientation=orientation,
            gaps=gaps,
            detrend=detrend,
            stations=stations,
            along=along,
            common_length=common_length,
            on_error=on_error,
            metadata=metadata,
            threads=threads,
            progress=progress,
        )

    def _write(self, h5: Any) -> None:
        sizes = [len(m) for m in self._motions]
        write(h5, "first", np.concatenate([[0], np.cumsum(sizes)]))
        write_joined(h5, "acceleration", [m.acceleration for m in self._motions])
        write(h5, "dt", [math.nan if m.dt is None else m.dt for m in self._motions])
        write_joined(h5, "time", [m.time for m in self._motions if m.dt is None])
        write(h5, "held", [m.interpolation == "constant" for m in self._motions])
        write(h5, "name", np.array(self.names, object))
        write(h5, "orientation", np.array([m.orientation for m in self], object))
        for which in _OTHERS:
            others = [getattr(m, which) for m in self]
            write(h5, f"has_{which}", [one is not None for one in others])
            write_joined(h5, which, [one for one in others if one is not None])
        write_columns(h5, "metadata", self._metadata)

    @classmethod
    def _read(cls, h5: Any) -> Suite:
        names = read(h5, "name").tolist()
        count = (len(names),)
        first, acceleration = read(h5, "first", (len(names) + 1,)), read(h5, "acceleration")
        if first[0] != 0 or first[-1] != acceleration.size or (np.diff(first) < 0).any():
            raise ValueError("'first' must rise from 0 to the number of samples")
        dt, held = read(h5, "dt", count), read(h5, "held", count)
        orientations = read(h5, "orientation", count)
        others = {which: _Taken(which, read(h5, which)) for which in _OTHERS}
        has = {which: read(h5, f"has_{which}", count) for which in _OTHERS}
        times = _Taken("time", read(h5, "time"))
        motions = []
        for i, name in enumerate(names):
            n = acceleration[first[i] : first[i + 1]]
            about: dict[str, Any] = {
                "interpolation": "constant" if held[i] else "linear",
                "name": name,
                "orientation": orientations[i],
            }
            about |= {w: others[w].take(n.size) for w in _OTHERS if has[w][i]}
            about |= {"times": times.take(n.size)} if math.isnan(dt[i]) else {"dt": dt[i]}
            motions.append(_core._ground_motion(n, **about))
        for part in (times, *others.values()):
            part.require_used()
        return cls(motions, read_columns(h5, "metadata", len(names)))


def _within(
    periods: NDArray[np.float64], target: NDArray[np.float64], period_range: Any
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """A target spectrum at periods of a range."""
    ends = np.asarray(reals(period_range, "Suite.scaled_to: period_range"), float)
    if not (np.diff(periods) > 0).all():
        raise ValueError("Suite.scaled_to: periods must increase for a period_range")
    known = periods[periods > 0]
    if ends.shape != (2,) or not 0 < ends[0] < ends[1]:
        raise ValueError(
            "Suite.scaled_to: period_range must be two periods, positive and increasing, got"
            f" {period_range!r}"
        )
    if not known.size or ends[0] < known[0] or ends[1] > known[-1]:
        raise ValueError(
            f"Suite.scaled_to: period_range must lie within the periods of the target, got"
            f" {ends[0]:g} to {ends[1]:g} s with a target from {periods[0]:g} to"
            f" {periods[-1]:g} s"
        )
    inside = known[(known > ends[0]) & (known < ends[1])]
    chosen = np.union1d(np.geomspace(*ends, 51), inside)
    chosen[[0, -1]] = ends
    values = np.log(target[periods > 0])
    return chosen, np.exp(np.interp(np.log(chosen), np.log(known), values))


class _Taken:
    """An array from which consecutive parts are taken."""

    def __init__(self, name: str, values: NDArray[np.float64]) -> None:
        self.name, self.values, self.used = name, values, 0

    def take(self, count: int) -> NDArray[np.float64]:
        self.used += count
        return self.values[self.used - count : self.used]

    def require_used(self) -> None:
        if self.used != self.values.size:
            raise ValueError(f"'{self.name}' must have {self.used} samples, has {self.values.size}")
