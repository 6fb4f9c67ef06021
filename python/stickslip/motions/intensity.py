"""Intensity measures and response spectra of suites."""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any, Literal, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._core import (
    STANDARD_GRAVITY,
    GroundMotion,
    ResponseSpectrum,
    response_spectrum,
    strong_motion,
)
from .._tabular import Tabular
from .directions import rotd
from .tables import MEASURES, SPECTRUM_UNITS

__all__ = [
    "DIRECTIONS",
    "LEVEL_UNITS",
    "OF_DIRECTIONS",
    "Directions",
    "IntensityMeasures",
    "SuiteSpectra",
    "beside",
    "check_directions",
    "level_of",
    "over_directions",
    "spectra",
    "spectrum_of",
]

# Intensity measures by their short names, which the levels of stripes and fragility curves have.
LEVEL_UNITS = {"pga_g": "g", "pgv": "m/s", "arias": "m/s", "cav": "m/s", "sa_g": "g"}

# What a measure is of: the component along the axis, or a percentile over the directions of a pair.
Directions = Literal["axis", "rotd50", "rotd100"]
DIRECTIONS = {"rotd50": 50, "rotd100": 100}
OF_DIRECTIONS = {"rotd50": "RotD50 of ", "rotd100": "RotD100 of "}
_ANGLES = 180  # at steps of 1 degree, as in `rotd`; rotated by 180 more they repeat, with - for +


class _Suite(Protocol):
    @property
    def names(self) -> tuple[str, ...]: ...
    @property
    def metadata(self) -> dict[str, NDArray[Any]]: ...
    def __len__(self) -> int: ...
    def __iter__(self) -> Iterator[GroundMotion]: ...


class IntensityMeasures(Tabular):
    """Intensity measures of the records of a suite, as `Suite.intensity_measures` returns them.

    Each attribute is an array with a value for each record, as in `StrongMotion`.

    Attributes
    ----------
    record : tuple of str
        Names of the records.
    peak_acceleration, peak_velocity, peak_displacement : ndarray, shape (records,)
        PGA [m/s^2], PGV [m/s], PGD [m].
    arias_intensity, cumulative_absolute_velocity : ndarray, shape (records,)
        Arias intensity and CAV [m/s].
    duration_5_75, duration : ndarray, shape (records,)
        Significant durations D5-75 and D5-95 [s].
    mean_period : ndarray, shape (records,)
        T_m [s].
    begin, end : ndarray, shape (records,)
        Times at which the Arias intensity reaches 5 % and 95 % [s].
    rms_acceleration, rms_velocity, center_frequency_hz : ndarray, shape (records,)
        Of the strong part, D5-95 [m/s^2], [m/s], [Hz].
    metadata : dict of ndarray
        The columns of the suite, which follow in tables.
    """

    record: tuple[str, ...]
    metadata: dict[str, NDArray[Any]]
    peak_acceleration: NDArray[np.float64]
    peak_velocity: NDArray[np.float64]
    peak_displacement: NDArray[np.float64]
    arias_intensity: NDArray[np.float64]
    cumulative_absolute_velocity: NDArray[np.float64]
    duration_5_75: NDArray[np.float64]
    duration: NDArray[np.float64]
    mean_period: NDArray[np.float64]
    begin: NDArray[np.float64]
    end: NDArray[np.float64]
    rms_acceleration: NDArray[np.float64]
    rms_velocity: NDArray[np.float64]
    center_frequency_hz: NDArray[np.float64]

    def __init__(self, suite: _Suite) -> None:
        self.record = suite.names
        self.metadata = suite.metadata
        rows = np.full((len(suite), len(MEASURES)), np.nan)
        failed = []
        for i, motion in enumerate(suite):
            try:
                one = strong_motion(motion)
            except ValueError as error:
                failed.append(f"'{motion.name}': {error}")
                rows[i, 0] = motion.peak_acceleration
                continue
            rows[i] = [getattr(one, name) for name in MEASURES]
        for name, column in zip(MEASURES, rows.T.copy()):
            column.setflags(write=False)
            setattr(self, name, column)
        if failed:
            warnings.warn(
                f"Suite.intensity_measures: NaN for {len(failed)} of {len(suite)} records, the"
                f" first is {failed[0]}",
                RuntimeWarning,
                stacklevel=3,
            )

    def __len__(self) -> int:
        return len(self.record)

    def __repr__(self) -> str:
        return f"<IntensityMeasures of {len(self)} records: {', '.join(MEASURES)}>"

    def _table(self) -> tuple[Mapping[str, NDArray[Any]], Mapping[str, str]]:
        own = {"record": np.array(self.record), **{n: getattr(self, n) for n in MEASURES}}
        return beside(own, self.metadata), MEASURES


class SuiteSpectra(Tabular, Sequence[ResponseSpectrum]):
    """Response spectra of the records of a suite, as `response_spectrum` returns them.

    A sequence: ``spectra[0]`` is the `ResponseSpectrum` of the first record.

    Attributes
    ----------
    record : tuple of str
        Names of the records.
    kind : str
        Kind of the values, as for `response_spectrum`.
    periods : ndarray, shape (P,)
        Periods [s].
    damping : ndarray, shape (D,)
        Damping ratios.
    values : ndarray, shape (records, P) or (records, D, P)
        Maximum responses [m/s^2, m/s or m]; the axis of damping is left out if there is one ratio.
    metadata : dict of ndarray
        The columns of the suite, which follow in tables.
    """

    def __init__(self, suite: _Suite, spectra: Sequence[ResponseSpectrum]) -> None:
        self.record = suite.names
        self.metadata = suite.metadata
        self.kind = spectra[0].kind
        self.periods = spectra[0].periods
        self.damping = spectra[0].damping
        self.values: NDArray[np.float64] = np.array([one.values for one in spectra])
        self.values.setflags(write=False)
        self._spectra = tuple(spectra)

    def __len__(self) -> int:
        return len(self._spectra)

    def __getitem__(self, index: Any) -> Any:
        return self._spectra[index]

    def quantile(self, p: ArrayLike) -> NDArray[np.float64]:
        """Quantiles over the records; 0.5 is the median.

        Parameters
        ----------
        p : float or array_like
            From 0 to 1.

        Returns
        -------
        ndarray
            The shape of `p`, followed by that of the values of one record.
        """
        found: NDArray[np.float64] = np.quantile(self.values, p, axis=0)
        return found

    def __repr__(self) -> str:
        return (
            f"<SuiteSpectra: {self.kind} of {len(self)} records, {len(self.periods)} periods,"
            f" {len(self.damping)} damping ratios>"
        )

    def _table(self) -> tuple[Mapping[str, NDArray[Any]], Mapping[str, str]]:
        ratios, periods = len(self.damping), len(self.periods)
        each = ratios * periods
        own = {
            "record": np.repeat(np.array(self.record), each),
            "damping": np.tile(np.repeat(self.damping, periods), len(self)),
            "period": np.tile(self.periods, len(self) * ratios),
            self.kind: self.values.ravel(),
        }
        columns = {name: np.repeat(column, each) for name, column in self.metadata.items()}
        return beside(own, columns), {"period": "s", self.kind: SPECTRUM_UNITS[self.kind]}


def spectra(suite: _Suite, periods: Any, damping: Any, kind: str) -> SuiteSpectra:
    """The response spectra of a suite; see `response_spectrum`."""

    def one(motion: Any) -> ResponseSpectrum:
        return response_spectrum(motion, periods, damping, kind=kind)  # type: ignore[arg-type]

    first, *others = suite
    found = [one(first)]  # raises for invalid arguments
    with ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        return SuiteSpectra(suite, [*found, *pool.map(one, others)])


def beside(
    own: Mapping[str, NDArray[Any]], metadata: Mapping[str, NDArray[Any]]
) -> dict[str, NDArray[Any]]:
    """The columns of a table, and those of the metadata, named ``..._given`` if they clash.

    A column of the metadata that repeats one of the table is left out.
    """
    others = {n: c for n, c in metadata.items() if n not in own or not np.array_equal(own[n], c)}
    return {**own, **{(f"{n}_given" if n in own else n): c for n, c in others.items()}}


def check_directions(directions: str | None, who: str, measure: str) -> None:
    """Raise ValueError for directions over which a measure has no value."""
    known = ["axis", *DIRECTIONS, *(["srss"] if measure in ("sa_g", "spectrum") else [])]
    if directions is not None and directions not in known:
        raise ValueError(
            f"{who}: directions must be {', '.join(map(repr, known[:-1]))} or {known[-1]!r} for"
            f" {measure}, got {directions!r}"
        )


def over_directions(motion: GroundMotion, directions: str | None) -> str:
    """The directions that count: those given, for a pair by default those of RotD50."""
    return "axis" if motion.transverse is None else directions or "rotd50"


def spectrum_of(
    motion: GroundMotion, periods: ArrayLike, damping: float, directions: str
) -> NDArray[np.float64]:
    """Pseudo-acceleration [m/s^2] of a motion over its directions, shape (P,)."""
    if directions in DIRECTIONS:
        return rotd(motion, periods, damping).percentile(DIRECTIONS[directions])
    along = np.asarray(response_spectrum(motion, periods, damping).values).reshape(-1)
    if directions == "axis":
        return along
    across = response_spectrum(motion.rotated(90.0), periods, damping)
    return np.hypot(along, np.asarray(across.values).reshape(-1))


def level_of(
    motion: GroundMotion,
    measure: str,
    period: float | None = None,
    damping: float = 0.05,
    directions: str = "axis",
) -> float:
    """An intensity measure of a motion, by its short name, in the unit of `LEVEL_UNITS`.

    RotD50 and RotD100 are the median and the maximum over the directions of a pair, SRSS the root
    of the sum of squares of both components; a motion without a transverse one has its axis alone.
    """
    directions = over_directions(motion, directions)
    if measure == "sa_g":
        assert period is not None
        return float(spectrum_of(motion, [period], damping, directions)[0]) / STANDARD_GRAVITY
    if directions != "axis":
        each = [level_of(motion.rotated(float(angle)), measure) for angle in range(_ANGLES)]
        return float(np.percentile(each, DIRECTIONS[directions]))
    if measure == "pga_g":
        return motion.peak_acceleration / STANDARD_GRAVITY
    found = strong_motion(motion)
    return {
        "pgv": found.peak_velocity,
        "arias": found.arias_intensity,
        "cav": found.cumulative_absolute_velocity,
    }[measure]
