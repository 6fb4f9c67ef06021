"""Hazard curves, and the rates at which a fragility is exceeded under them."""

from __future__ import annotations

import csv
import json
import math
import os
import re
import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._core import STANDARD_GRAVITY, to_vector
from .._numbers import real, reals
from .._optional import optional
from .._tables import Columns
from .._tabular import Tabular
from ..regressions import RangeWarning

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from .fragility import Fragility

__all__ = ["MUCH_BEYOND", "Exceedances", "Hazard", "exceedances", "read_hazard"]

Array = NDArray[np.float64]
_BLANKS = str.maketrans(",;", "  ")
MUCH_BEYOND = 0.1  # share of a rate from beyond what is known that is worth a warning
# Short names and units of the measures in hazard files, and factors: PGV is in cm/s there, CAV in
# g s.
_MEASURES = {
    "PGA": ("pga_g", "g", 1.0),
    "PGV": ("pgv", "m/s", 0.01),
    "IA": ("arias", "m/s", 1.0),
    "CAV": ("cav", "m/s", STANDARD_GRAVITY),
}


class Hazard(Tabular):
    """A hazard curve: annual rates at which intensities are exceeded.

    Interpolated linearly in log-log, and extrapolated with the slopes of the first and last piece.

    Parameters
    ----------
    im : array_like, shape (N,)
        Intensities, positive, increasing; at least 2.
    rate : array_like, shape (N,)
        Annual rates of exceedance [1/year], positive, not increasing; the last is below the one
        before.
    name : str, optional
        The intensity measure, such as 'pga_g', as in `Fragility.im`.
    unit : str, optional
        Its unit.
    period : float, optional
        Its period [s].

    Raises
    ------
    ValueError
        Values out of range; a curve that does not decrease.

    Examples
    --------
    >>> import stickslip as ss
    >>> hazard = ss.Hazard([0.1, 0.4, 1.6], [1e-2, 1e-3, 1e-4], name="pga_g", unit="g")
    >>> float(round(hazard.at(0.2), 6))
    0.003162
    """

    def __init__(
        self,
        im: ArrayLike,
        rate: ArrayLike,
        *,
        name: str = "",
        unit: str = "",
        period: float | None = None,
    ) -> None:
        self.im = np.array(to_vector(im, "Hazard: im"))
        self.rate = np.array(to_vector(rate, "Hazard: rate"))
        for what, text in (("name", name), ("unit", unit)):
            if not isinstance(text, str):
                raise TypeError(f"Hazard: {what} must be a string, got {text!r}")
        self.name, self.unit = name, unit
        self.period = None if period is None else real(period, "Hazard: period")
        if self.im.ndim != 1 or self.im.shape != self.rate.shape or len(self.im) < 2:
            raise ValueError(
                "Hazard: im and rate must be two lists of equal length, at least 2, got shapes"
                f" {self.im.shape} and {self.rate.shape}"
            )
        for what, values, of in (("im", self.im, unit), ("rate", self.rate, "1/year")):
            wrong = values[~(np.isfinite(values) & (values > 0))]
            if wrong.size:
                raise ValueError(
                    f"Hazard: {what} must be positive and finite, got {wrong[0]:g} {of}".rstrip()
                )
        if not (np.diff(self.im) > 0).all():
            i = int(np.argmin(np.diff(self.im) > 0))
            raise ValueError(
                f"Hazard: im must increase, got {self.im[i]:g} before {self.im[i + 1]:g}"
            )
        rises = np.flatnonzero(np.diff(self.rate) > 0)
        if rises.size:
            i = int(rises[0])
            raise ValueError(
                "Hazard: rates must decrease, as rates of exceedance do, got"
                f" {self.rate[i]:g} at {self.im[i]:g} and {self.rate[i + 1]:g} at"
                f" {self.im[i + 1]:g}"
            )
        if self.rate[-1] == self.rate[-2]:
            raise ValueError(
                f"Hazard: rates must decrease, got {self.rate[-1]:g} at both of the last points, so"
                " the curve cannot be extrapolated"
            )
        self.im.setflags(write=False)
        self.rate.setflags(write=False)

    @property
    def slopes(self) -> Array:
        """k of each piece, on which the rate is proportional to IM^-k, shape (N - 1,)."""
        k: Array = -np.diff(np.log(self.rate)) / np.diff(np.log(self.im))
        return k

    def at(self, im: ArrayLike) -> NDArray[np.float64]:
        """The rate at intensities [1/year].

        Parameters
        ----------
        im : float or array_like
            Intensities, positive.

        Returns
        -------
        ndarray, of the shape of `im`
        """
        x = reals(im, "Hazard.at: im")
        if not (x > 0).all():
            raise ValueError(f"Hazard.at: im must be positive, got {np.min(x):g}")
        u, known = np.log(x), np.log(self.im)
        i = np.clip(np.searchsorted(known, u, side="right") - 1, 0, len(known) - 2)
        result: Array = self.rate[i] * np.exp(-self.slopes[i] * (u - known[i]))
        return result

    def _table(self) -> tuple[Columns, Mapping[str, str]]:
        return {"im": self.im, "rate": self.rate}, {"im": self.unit, "rate": "1/year"}

    def __repr__(self) -> str:
        unit = f" {self.unit}" if self.unit else ""
        of = f" of {self.name}" if self.name else ""
        return (
            f"<Hazard{of}: {len(self.im)} points, {self.rate[0]:.3g}/year at {self.im[0]:.3g}{unit}"
            f" to {self.rate[-1]:.3g}/year at {self.im[-1]:.3g}{unit}>"
        )


@dataclass(eq=False, repr=False)
class Exceedances(Tabular):
    """Annual rates at which thresholds are exceeded; see `Fragility.rate_of_exceedance`.

    Attributes
    ----------
    fragility : Fragility
    hazard : Hazard
    rate : ndarray, shape (T,)
        [1/year], for each threshold.
    beyond : ndarray, shape (T,)
        The fraction of the rate that comes from intensities below the first point of the hazard
        curve or above its last one.
    extrapolated : ndarray, shape (T,)
        The fraction that comes from beyond `Fragility.im_range`, the intensities of the ground
        motions.
    """

    fragility: Fragility
    hazard: Hazard
    rate: Array
    beyond: Array
    extrapolated: Array

    def probability(self, years: float) -> NDArray[np.float64]:
        """The probability of at least one exceedance in a time, 1 - exp(-rate years).

        Parameters
        ----------
        years : float
            At least 0.

        Returns
        -------
        ndarray, shape (T,)
        """
        years = real(years, "Exceedances.probability: years")
        if not (math.isfinite(years) and years >= 0):
            raise ValueError(
                f"Exceedances.probability: years must be at least 0 and finite, got {years}"
            )
        p: Array = -np.expm1(-self.rate * years)
        return p

    def _table(self) -> tuple[Columns, Mapping[str, str]]:
        columns, units = self.fragility._table()
        own = {name: getattr(self, name) for name in ("rate", "beyond", "extrapolated")}
        return {"threshold": columns["threshold"], **own}, {**units, "rate": "1/year"}

    def __repr__(self) -> str:
        rates = ", ".join(
            f"{label}: {rate:.3g}/year"
            + (f" ({100 * share:.0f} % extrapolated)" if share > MUCH_BEYOND else "")
            for label, rate, share in zip(self.fragility.labels, self.rate, self.extrapolated)
        )
        return f"<Exceedances: {rates}>"

    @overload
    def plot(self, *, ax: None = None, title: str | None = ...) -> Figure: ...
    @overload
    def plot(self, *, ax: Axes, title: str | None = ...) -> Axes: ...
    def plot(self, *, ax: Axes | None = None, title: str | None = None) -> Figure | Axes:
        """Plot which intensities contribute to each rate, and the hazard curve.

        Parameters
        ----------
        ax : matplotlib Axes, optional
            Where to draw; default: a new figure of 7 x 4.5 inches.
        title : str, optional

        Returns
        -------
        matplotlib Figure or Axes
            The axes if they were given, otherwise the new figure.

        Raises
        ------
        ImportError
            matplotlib is missing.
        """
        from ..plotting import plot_exceedances

        return plot_exceedances(self, ax=ax, title=title)


def exceedances(fragility: Fragility, hazard: Hazard) -> Exceedances:
    """See `Fragility.rate_of_exceedance`."""
    if not isinstance(hazard, Hazard):
        raise TypeError(
            "Fragility.rate_of_exceedance: hazard must be a Hazard, as read_hazard returns it, got"
            f" {type(hazard).__name__}"
        )
    if hazard.name and hazard.name != fragility.im:
        ours = _measure(hazard.name)[0]
        hint = f"; give name='{ours}'" if ours == fragility.im else ""
        raise ValueError(
            f"Fragility.rate_of_exceedance: the hazard curve is of {hazard.name}, the fragility of"
            f" {fragility.im}{hint}"
        )
    periods = (hazard.period, fragility.im_period)
    if None not in periods and not math.isclose(*periods, rel_tol=1e-6):  # type: ignore[arg-type]
        raise ValueError(
            f"Fragility.rate_of_exceedance: the hazard curve is at a period of {periods[0]:g} s,"
            f" the fragility at {periods[1]:g} s"
        )
    if hazard.unit and fragility.im_unit and hazard.unit != fragility.im_unit:
        raise ValueError(
            f"Fragility.rate_of_exceedance: the hazard curve is in {hazard.unit}, the fragility in"
            f" {fragility.im_unit}"
        )
    _check_bounded(fragility, hazard)
    pieces = _pieces(hazard, fragility.im_range)
    by = _lognormal_rates if fragility.method == "lognormal" else _rates_by_quadrature
    parts = by(fragility, pieces)
    rate = parts.sum(axis=1)

    def share_outside(low: float, high: float) -> Array:
        outside = (pieces.high <= math.log(low)) | (pieces.low >= math.log(high))
        return np.divide(
            parts[:, outside].sum(axis=1), rate, out=np.zeros_like(rate), where=rate > 0
        )

    beyond = share_outside(hazard.im[0], hazard.im[-1])
    for label, share in zip(fragility.labels, beyond):
        if share > MUCH_BEYOND:
            warnings.warn(
                f"Fragility.rate_of_exceedance: {100 * share:.0f} % of the rate for {label} comes"
                f" from beyond the points of the hazard curve, {hazard.im[0]:g} to"
                f" {hazard.im[-1]:g} {hazard.unit}".rstrip(),
                RuntimeWarning,
                stacklevel=3,
            )
    extrapolated = share_outside(*fragility.im_range)
    if (extrapolated > MUCH_BEYOND).any():
        low, high = fragility.im_range
        shares = ", ".join(
            f"{100 * share:.0f} % of the rate for {label}"
            for label, share in zip(fragility.labels, extrapolated)
            if share > MUCH_BEYOND
        )
        warnings.warn(
            f"Fragility.rate_of_exceedance: extrapolated: {shares} comes from outside the ground"
            f" motions, {low:.4g} to {high:.4g} {fragility.im_unit}".rstrip(),
            RangeWarning,
            stacklevel=3,
        )
    return Exceedances(fragility, hazard, rate, beyond, extrapolated)


def _check_bounded(fragility: Fragility, hazard: Hazard) -> None:
    """Refuse a logistic curve whose lower tail falls more slowly than the hazard curve rises."""
    if fragility.method != "logit":
        return
    slope = float(hazard.slopes[0])
    for label, beta, tail in zip(fragility.labels, fragility.beta, _logistic_tails(fragility)):
        if slope >= tail:
            raise ValueError(
                f"Fragility.rate_of_exceedance: the rate for {label} has no bound: below"
                f" {hazard.im[0]:g} {hazard.unit}".rstrip()
                + f" the hazard curve rises as IM^-{slope:.3g}, and a logistic curve with beta"
                f" {beta:.3g} falls only as IM^{tail:.3g}; use method='lognormal', or a hazard"
                " curve that flattens toward low intensities"
            )


def _logistic_tails(fragility: Fragility) -> Array:
    """The exponents with which logistic curves fall toward low intensities, shape (T,)."""
    tails: Array = math.pi / (math.sqrt(3) * fragility.beta)
    return tails


class _Pieces(NamedTuple):
    """Pieces of a hazard curve: begin and end in ln IM, slope, and ln rate at ln IM = 0."""

    low: Array
    high: Array
    k: Array
    h: Array


def _pieces(hazard: Hazard, cuts: tuple[float, float]) -> _Pieces:
    """The pieces between the points and both tails, divided at other intensities, too."""
    u = np.log(hazard.im)
    k = hazard.slopes
    k = np.concatenate([k[:1], k, k[-1:]])
    corner = np.concatenate([u[:1], u[:-1], u[-1:]])
    height = np.log(np.concatenate([hazard.rate[:1], hazard.rate[:-1], hazard.rate[-1:]]))
    edges = np.union1d(u, np.log(cuts))
    edges = np.concatenate([[-np.inf], edges, [np.inf]])
    of = np.searchsorted(u, edges[:-1], side="right")
    return _Pieces(edges[:-1], edges[1:], k[of], (height + k * corner)[of])


def _lognormal_rates(fragility: Fragility, pieces: _Pieces) -> Array:
    """The rate from each piece of the hazard curve, shape (T, pieces), in closed form.

    With the rate exp(h - k u) of u = ln IM, and the median m = ln theta, the integral of
    Phi((u - m)/beta) k exp(h - k u) du is, by parts,
        -exp(h - k u) Phi((u - m)/beta) + exp(h - k m + k^2 beta^2/2) Phi((u - m)/beta + k beta).
    """
    special = optional("scipy.special", "risk", "Fragility.rate_of_exceedance")
    low, high, k, h = pieces
    m, beta = np.log(fragility.median)[:, np.newaxis], fragility.beta[:, np.newaxis]
    # ln of exp(h - k m + k^2 beta^2/2), which may exceed the doubles that its factor makes small.
    scale = h - k * m + (k * beta) ** 2 / 2

    def product(u: Array) -> Array:
        z = (u - m) / beta
        with np.errstate(invalid="ignore"):
            value: Array = np.exp(h - k * u + special.log_ndtr(z))
        # At both ends of the axis the product is zero, or there is no slope.
        return np.where(np.isinf(u), 0.0, value)

    a, b = (low - m) / beta + k * beta, (high - m) / beta + k * beta
    upper = a > 0  # the tail that is accurate
    first, second = np.where(upper, -a, b), np.where(upper, -b, a)
    gained = np.exp(scale + special.log_ndtr(first)) - np.exp(scale + special.log_ndtr(second))
    result: Array = np.maximum(product(low) - product(high) + gained, 0.0)
    return np.where(k > 0, result, 0.0)


def _rates_by_quadrature(fragility: Fragility, pieces: _Pieces) -> Array:
    """The rate from each piece of the hazard curve, shape (T, pieces), for curves of any form.

    Gauss's rule with 8 points on parts of at most 0.1 in ln IM. The lower tail ends 10 in ln IM
    below a probability of 0.001, the upper one where the rate has fallen by 1e-16. Below the lower
    end a logistic curve is a power of IM, and its share has a closed form; a cloud is normal there.
    """
    low, high, k, h = (part.copy() for part in pieces)
    grid = np.log(fragility.grid())
    low[0], high[-1] = min(grid[0] - 10, high[0]), max(grid[-1] + 1, low[-1] + 37 / k[-1])
    nodes, weights = np.polynomial.legendre.leggauss(8)
    parts = np.zeros((len(fragility.thresholds), len(k)))
    if fragility.method == "logit":
        p = fragility.probability(np.exp(low[:1]))[:, 0]
        below = k[0] * np.exp(h[0] - k[0] * low[0]) / (_logistic_tails(fragility) - k[0])
        parts[:, 0] = below * p
    for i in range(len(k)):
        if not high[i] > low[i] or k[i] == 0:
            continue
        edges = np.linspace(low[i], high[i], math.ceil((high[i] - low[i]) / 0.1) + 1)
        half = np.diff(edges) / 2
        u = ((edges[:-1] + half)[:, np.newaxis] + half[:, np.newaxis] * nodes).ravel()
        density = k[i] * np.exp(h[i] - k[i] * u) * (half[:, np.newaxis] * weights).ravel()
        parts[:, i] += fragility.probability(np.exp(u)) @ density
    return parts


def read_hazard(
    path: str | os.PathLike[str],
    *,
    imt: str | None = None,
    site: int | tuple[float, float] | None = None,
    years: float | None = None,
) -> Hazard:
    """Read a hazard curve from a file.

    Parameters
    ----------
    path : path-like
        A text file with two columns, intensity and annual rate [1/year], separated by commas,
        semicolons or blanks, below lines of text; lines that begin with # or % are skipped.
        OpenQuake's ``hazard_curve-*.csv``. The JSON of the USGS hazard tool: of its hazard
        services, whose total curve is taken, or of its static curves.
    imt : str, optional
        The intensity measure of a file with several, such as 'PGA' or 'SA1P0'.
    site : int or (lon, lat), optional
        The site of an OpenQuake file with several: its row, from 0, or its coordinates [degrees].
    years : float, optional
        The second column holds probabilities of exceedance in this time [years] instead of rates.
        Also for a file of OpenQuake that does not state its time.

    Returns
    -------
    Hazard
        Probabilities p in t years become rates, -ln(1 - p)/t. Points with a probability of 1, or
        with a rate of 0, have no logarithm and are left out. Velocities, which OpenQuake states in
        cm/s, and CAV, in g s there, are in m/s. Measures that have no name here keep that of the
        file.

    Raises
    ------
    ValueError
        A file that is none of these; a line that does not belong in it; several measures or sites
        without a choice, or a choice that the kind of file does not have; several curves of one
        measure in the JSON of USGS, as of two editions; another time than the file states; a curve
        that does not decrease.
    TypeError
        An argument of a wrong type.
    OSError
        The file cannot be read.
    """
    return _read(path, imt, site, years)


def read_pga_hazard(path: str | os.PathLike[str]) -> Hazard:
    """As `read_hazard`; of a file with several measures the curve of PGA."""
    return _read(path, None, None, None, usual="PGA")


def _read(path: Any, imt: str | None, site: Any, years: Any, usual: str = "") -> Hazard:
    """Read a file; `usual` is the measure of a file with several if `imt` is None."""
    if not isinstance(path, (str, bytes, os.PathLike)):
        raise TypeError(f"read_hazard: path must be a path, got {type(path).__name__}")
    if years is not None:
        years = real(years, "read_hazard: years")
    file = Path(os.fsdecode(path))
    try:
        text = file.read_text(encoding="utf-8-sig")
        if text.lstrip().startswith(("{", "[")):
            _refuse(site=site, years=years, kind="the JSON of the USGS hazard tool")
            return _from_usgs(text, imt, usual)
        if re.search(r"^lon,lat", text, re.MULTILINE) and "poe-" in text:
            _refuse(imt=imt, kind="a file of OpenQuake, which has one measure")
            return _from_openquake(text, site, years)
        _refuse(imt=imt, site=site, kind="a file of two columns")
        return _from_columns(text, years)
    except UnicodeDecodeError:
        raise ValueError(f"read_hazard: '{file}': is not a text file") from None
    except ValueError as error:
        raise ValueError(f"read_hazard: '{file}': {error}") from error


def _refuse(kind: str, **given: Any) -> None:
    """Refuse an argument that a kind of file has no use for."""
    for name, value in given.items():
        if value is not None:
            shown = f"{value:g}" if isinstance(value, float) else repr(value)
            raise ValueError(f"{name}={shown} has no meaning for {kind}")


def _number(cell: str, line: int, text: str) -> float:
    try:
        return float(cell)
    except ValueError:
        raise ValueError(f"line {line}: {cell!r} is no number, in {text.strip()!r}") from None


def _rates(p: Array, years: float) -> Array:
    if not (math.isfinite(years) and years > 0):
        raise ValueError(f"years must be positive and finite, got {years}")
    if not ((p >= 0) & (p <= 1)).all():
        wrong = p[~((p >= 0) & (p <= 1))][0]
        raise ValueError(f"a probability must lie between 0 and 1, got {wrong:g}")
    with np.errstate(divide="ignore"):
        rate: Array = -np.log1p(-p) / years
    return rate


def _hazard(im: Array, rate: Array, **about: Any) -> Hazard:
    """A hazard curve of the points that have a logarithm."""
    if np.isnan(rate).any() or (rate < 0).any():
        raise ValueError("a rate must be at least 0, got a negative one or NaN")
    usable = np.isfinite(rate) & (rate > 0)
    if usable.sum() < 2:
        raise ValueError(
            f"needs at least 2 points with a rate above 0, has {usable.sum()}; for probabilities"
            " give years="
        )
    return Hazard(im[usable], rate[usable], **about)


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True


def _from_columns(text: str, years: float | None) -> Hazard:
    rows: list[list[float]] = []
    for number, line in enumerate(text.splitlines(), 1):
        cells = line.translate(_BLANKS).split()
        if not cells or cells[0].startswith(("#", "%")):
            continue
        if not rows and not any(map(_is_number, cells)):
            continue  # a head
        if len(cells) != 2:
            raise ValueError(
                f"line {number}: needs two columns, intensity and annual rate, got {line.strip()!r}"
            )
        rows.append([_number(cell, number, line) for cell in cells])
    if len(rows) < 2:
        raise ValueError(
            "needs two columns, intensity and annual rate, with at least 2 rows of numbers, got"
            f" {len(rows)}"
        )
    im, rate = np.array(rows).T
    return _hazard(im, rate if years is None else _rates(rate, years))


def _from_openquake(text: str, site: Any, years: float | None) -> Hazard:
    lines = text.splitlines()
    begin = next(i for i, line in enumerate(lines) if line.startswith("lon,lat"))
    about = " ".join(lines[:begin])
    stated = re.search(r"investigation_time=([0-9.eE+-]+)", about)
    time = float(stated[1]) if stated else years
    if time is None:
        raise ValueError("the file does not state investigation_time; give years=")
    if years is not None and years != time:
        raise ValueError(f"the file states investigation_time={time:g} years, got years={years:g}")
    heads, *rows = [row for row in csv.reader(lines[begin:]) if row]
    if not rows:
        raise ValueError("has no site")
    number: Any = site
    if site is None:
        if len(rows) > 1:
            raise ValueError(f"has {len(rows)} sites; give site=, a row or (lon, lat)")
        number = 0
    elif not isinstance(site, (int, np.integer)):
        try:
            lon, lat = map(real, number, ("lon", "lat"))
        except (TypeError, ValueError):
            raise TypeError(
                f"read_hazard: site must be a row or (lon, lat), got {site!r}"
            ) from None
        places = np.array([[float(cell) for cell in row[:2]] for row in rows])
        near = np.flatnonzero(np.abs(places - [lon, lat]).max(axis=1) < 1e-4)
        if near.size != 1:
            raise ValueError(f"has {near.size} sites at {tuple(number)} within 1e-4 degrees")
        number = near[0]
    if not 0 <= number < len(rows):
        raise ValueError(f"has {len(rows)} sites, got site={number}")
    row, line = rows[number], begin + 2 + int(number)
    if len(row) != len(heads):
        raise ValueError(
            f"line {line}: has {len(row)} values where the head has {len(heads)} columns"
        )
    points = [
        (float(h[4:]), _number(c, line, ",".join(row)))
        for h, c in zip(heads, row)
        if h[:4] == "poe-"
    ]
    im, p = np.array(points).T
    kind = re.search(r"imt='([^']+)'", about)
    name, unit, factor, period = _measure(kind[1] if kind else "")
    return _hazard(im * factor, _rates(p, time), name=name, unit=unit, period=period)


def _measure(imt: str) -> tuple[str, str, float, float | None]:
    """Our name of a measure of a file, its unit, the factor to that unit, and its period."""
    if imt in _MEASURES:
        return (*_MEASURES[imt], None)
    # SA(1.0) of OpenQuake, SA1P0 of USGS.
    period = re.fullmatch(r"SA\(([0-9.]+)\)|SA([0-9]+)P([0-9]+)", imt)
    if period:
        value = float(period[1] or f"{period[2]}.{period[3]}")
        return "sa_g", "g", 1.0, value
    return imt, "", 1.0, None


def _from_usgs(text: str, imt: str | None, usual: str) -> Hazard:
    try:
        document = json.loads(text)
    except json.JSONDecodeError as error:
        raise ValueError(f"is no JSON document: {error}") from error
    except RecursionError:
        raise ValueError("is nested too deeply for the JSON of the USGS hazard tool") from None
    try:
        found = _curves_of_usgs(document)
    except (AttributeError, KeyError, TypeError):  # another document
        found = {}
    if not found:
        raise ValueError("has no hazard curve where the JSON of the USGS hazard tool has one")
    if imt is None and usual in found:
        imt = usual
    if imt is None and len(found) > 1:
        raise ValueError(f"has curves of {', '.join(found)}; give imt=")
    chosen = next(iter(found)) if imt is None else imt
    if chosen not in found:
        raise ValueError(f"has no curve of {chosen}; it has {', '.join(found)}")
    name, unit, factor, period = _measure(chosen)  # PGV is in cm/s here, too
    if len(found[chosen]) > 1:
        raise ValueError(
            f"has {len(found[chosen])} curves of {chosen}, of several editions or places; needs a"
            " file with one"
        )
    x, y = found[chosen][0]
    return _hazard(x * factor, y, name=name, unit=unit, period=period)


def _curves_of_usgs(document: Any) -> dict[str, list[tuple[Array, Array]]]:
    """The total curves of a document, by the name of the measure.

    The hazard services state the intensities as `xvalues` of the metadata and the rates as
    `yvalues` of each component, or both in `values`; the static curves as `xvals` and `yvals`,
    without components.
    """
    found: dict[str, list[tuple[Array, Array]]] = {}
    response = document.get("response") if isinstance(document, dict) else None
    curves = response.get("hazardCurves") if isinstance(response, dict) else response
    for curve in curves if isinstance(curves, list) else ():
        about = curve.get("metadata", curve)
        kind = curve.get("imt") or about.get("imt") or {}
        name = str(kind.get("value", "") if isinstance(kind, dict) else kind)
        for part in curve.get("data", ()):
            if part.get("component", "Total") == "Total":
                values = part.get("values", {})
                x = about.get("xvalues") or about.get("xvals") or values.get("xs")
                y = part.get("yvalues") or part.get("yvals") or values.get("ys")
                if x and y and len(x) == len(y):
                    found.setdefault(name, []).append((np.array(x, float), np.array(y, float)))
    return found
