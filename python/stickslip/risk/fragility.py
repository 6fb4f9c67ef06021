"""Fragility curves: the probability that a displacement is exceeded, given an intensity measure."""

from __future__ import annotations

import math
import os
import warnings
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, SupportsIndex, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._numbers import real, reals, whole_number
from .._optional import optional
from .._tables import Columns
from .._tabular import Tabular
from ..motions.intensity import OF_DIRECTIONS
from ..regressions import RangeWarning
from ..runs.progress import Progress, shown
from .cloud import Cloud
from .exceedance import Exceedance
from .observations import DemandTable, Event, Measure, Observations, observe

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from .hazard import Exceedances, Hazard

__all__ = ["Bands", "Fragility"]

_Array = NDArray[np.float64]
_METHODS = ("lognormal", "logit", "cloud")
_HCLPF = 0.01  # on the mean curve
_UNLIKELY = 0.01  # probability of the data below which a shared dispersion is doubted


class Bands(NamedTuple):
    """Confidence bands of fragility curves, as `Fragility.bands` returns them.

    Attributes
    ----------
    im : ndarray, shape (K,)
        Intensities.
    low, high : ndarray, shape (T, K)
        Probabilities of exceedance.
    median, beta, hclpf : ndarray, shape (T, 2)
        Intervals of the median, the dispersion and the HCLPF.
    """

    im: NDArray[np.float64]
    low: NDArray[np.float64]
    high: NDArray[np.float64]
    median: NDArray[np.float64]
    beta: NDArray[np.float64]
    hclpf: NDArray[np.float64]

    def __repr__(self) -> str:
        medians = ", ".join(f"{low:.3g} to {high:.3g}" for low, high in self.median)
        return f"<Bands: medians {medians}; curves at {len(self.im)} intensities>"


class Fragility(Tabular):
    """Fragility curves of a sweep, as `fit` returns them, one for each threshold.

    Attributes
    ----------
    thresholds : tuple
        Displacements [m], of blocks that rock |theta|/alpha; or `ss.impact` or `ss.overturning`.
    median : ndarray, shape (T,)
        Intensity at which the probability of exceedance is one half, in `im_unit`.
    beta : ndarray, shape (T,)
        Dispersion: standard deviation of the ln IM at which the threshold is exceeded. Under
        'cloud', where the curve is not quite lognormal, half the distance of the ln IM at 16 and
        84 %.
    beta_records, beta_parameters : ndarray, shape (T,)
        Its parts from different records and from random parameters of the slider:
        beta^2 = beta_records^2 + beta_parameters^2. beta_parameters is the standard deviation over
        draws of the ln median fitted draw by draw, less its sampling variance.
    hclpf : ndarray, shape (T,)
        High confidence of low probability of failure: the intensity at which the mean curve, of
        dispersion `beta`, is 1 %.
    method : {'lognormal', 'logit', 'cloud'}
    quantity : str
        What exceeds the thresholds.
    im, im_unit : str
        Name and unit of the intensity measure.
    im_period : float or None
        Period [s] of `sa_g`.
    im_directions : {'axis', 'rotd50', 'rotd100', ''}
        What the measure is of: the component along the axis, or the median or the maximum over the
        directions of pairs; empty for your own columns and functions.
    im_range : tuple of float
        The lowest and the highest intensity of the ground motions. Beyond them the curves are
        extrapolated.
    p_shared : float
        The probability of dispersions that differ as much as these or more, if the thresholds have
        one; NaN if that is not tested: one threshold or record, 'cloud', or `separate`.
    """

    thresholds: tuple[float | Event, ...]

    def __init__(
        self, data: Observations, model: Exceedance | Cloud, method: str, quantity: str
    ) -> None:
        self._data, self._model = data, model
        self._found = model.estimate()
        self.thresholds = data.thresholds
        self.im, self.im_unit, self.im_period = data.im_name, data.im_unit, data.im_period
        self.im_directions = data.im_directions
        self.method, self.quantity = method, quantity
        self.median, self.beta = (one[0] for one in model.summary(self._found))
        self.beta_parameters = np.minimum(model.deviation_of_draws(), self.beta)
        self.beta_records = np.sqrt(self.beta**2 - self.beta_parameters**2)
        self.hclpf = model.quantile(self._found, _HCLPF)[0]
        self.im_range = (float(data.im.min()), float(data.im.max()))
        self.p_shared = math.nan
        if isinstance(model, Exceedance):
            self.p_shared, alone = model.shared_dispersion()
            if self.p_shared < _UNLIKELY:
                each = ", ".join(f"{n} {b:.2f}" for n, b in zip(data.labels, alone))
                warnings.warn(
                    f"Fragility.fit: the thresholds share a dispersion of {self.beta[0]:.2f}, and"
                    f" their responses contradict it (p = {self.p_shared:.1g}): alone they have"
                    f" {each}; separate=True gives each its own",
                    RuntimeWarning,
                    stacklevel=3,
                )
        outside = self._outside()
        if outside:
            warnings.warn(
                f"Fragility.fit: extrapolated: {outside}; add ground motions that reach there",
                RangeWarning,
                stacklevel=3,
            )
        for label, median in zip(data.labels, self.median):
            if math.isinf(median):
                warnings.warn(
                    f"Fragility.fit: up to 100 times the largest {data.im_name}, {label} is not"
                    " exceeded half of the time: under 'cloud' the probability of sliding at all"
                    " does not grow that far; the median is infinite",
                    RuntimeWarning,
                    stacklevel=3,
                )

    @classmethod
    def fit(
        cls,
        table: DemandTable,
        im: Measure,
        thresholds: float | Event | Sequence[float | Event],
        *,
        quantity: str = "peak",
        separate: bool = False,
        method: str = "lognormal",
        censored_below: float = 1e-4,
    ) -> Fragility:
        """Fit fragility curves to the responses of a sweep.

        'lognormal' and 'logit' maximize the binomial likelihood of the exceedances,
        P(D > d | IM) = F((ln IM - ln median)/beta), with the standard normal distribution or a
        logistic one of unit variance as F. 'cloud' fits P(D = 0 | IM) by a logistic function of
        ln IM, and ln D = a + b ln IM + e to D > 0, with a normal e of deviation sigma:
        P(D > d | IM) = P(D > 0 | IM) (1 - Phi((ln d - a - b ln IM)/sigma)).

        Parameters
        ----------
        table : SweepTable, RockingTable or CartTable
            All sliders count as equally likely draws: of a `Random`, or one slider. Polarities and
            draws of one record, and its stripes, are not independent; they belong to one record,
            by the column `record` of the metadata if there is one.
        im : str or callable
            A column of the metadata of the table; one of 'pga_g' [g], 'pgv', 'arias' and 'cav'
            [m/s], or 'sa(1.0)', the pseudo-acceleration at 1 s and 5 % damping [g], computed from
            the ground motions; or a function of a GroundMotion. Of sliders in the plane, a measure
            is RotD50, the median over all directions; of stripes, whatever `stripes` scaled:
            `im_directions` says which.
        thresholds : float, list of float, ss.impact, or ss.overturning
            Displacements [m], of blocks that rock |theta|/alpha, positive, increasing; or hitting a
            stop or a wall; or overturning, which need not grow with the intensity: the counts stand
            beside. A block that overturns exceeds every |theta|/alpha.
        quantity : {'peak', 'residual', 'sliding_distance', 'peak_outline'}
            The displacement. Of blocks 'peak'; of carts 'peak', of the center, or 'peak_outline',
            of the corner that moved farthest.
        separate : bool, optional
            Fit a dispersion for each threshold. By default they share one, so that the curves of
            different thresholds do not cross, and a test says where the responses contradict it.
            Not for 'cloud', whose curves never cross.
        method : {'lognormal', 'logit', 'cloud'}
        censored_below : float, optional
            Under 'cloud', displacements above zero and below this one [m] are left-censored: the
            likelihood only uses that they are below. Responses of zero are part of P(D = 0 | IM).

        Returns
        -------
        Fragility

        Raises
        ------
        ValueError
            An unbounded fit: all or no responses exceed a threshold, or the intensity separates
            those that do from the others; an intensity measure that the table lacks, as one from a
            file lacks those of pairs, or that is zero; a threshold at or beyond a stop; an argument
            out of range.
        ImportError
            SciPy is missing.

        Warns
        -----
        RangeWarning
            A median or an HCLPF lies beyond the intensities of the ground motions.
        RuntimeWarning
            Responses failed, and are left out; a median is infinite, because under 'cloud' no
            intensity makes the slider exceed the threshold half of the time; the thresholds share a
            dispersion although that is improbable: p is below 0.01 in a likelihood-ratio test that
            allows for responses to one record being alike (Rao and Scott 1984).

        Examples
        --------
        >>> import stickslip as ss
        >>> stripes = ss.sample_records().stripes(pga_g=[0.1, 0.2, 0.4, 0.8, 1.6])
        >>> mu = ss.Random(ss.Coulomb, mu=ss.Lognormal(median=0.2, beta=0.3))
        >>> table = ss.sweep(mu, stripes, members=50, seed=1)
        >>> f = ss.Fragility.fit(table, im="pga_g", thresholds=[0.02, 0.1])
        >>> bool(f.median[0] < f.median[1])
        True

        Notes
        -----
        Newton's method, to 1e-9. 72,000 responses with three thresholds take about 50 ms.
        """
        if not isinstance(table, DemandTable):
            raise TypeError(
                f"Fragility.fit: table must be a SweepTable, as sweep returns it, got"
                f" {type(table).__name__}"
            )
        if method not in _METHODS:
            raise ValueError(
                f"Fragility.fit: method must be one of {', '.join(_METHODS)}, got {method!r}"
            )
        if separate and method == "cloud":
            raise ValueError(
                "Fragility.fit: separate is for 'lognormal' and 'logit'; a cloud has one dispersion"
            )
        data = observe(table, im, thresholds, quantity, "Fragility.fit")
        model: Exceedance | Cloud = (
            Cloud(data, censored_below) if method == "cloud" else Exceedance(data, method, separate)
        )
        event = next((one.value for one in data.thresholds if isinstance(one, Event)), None)
        return cls(data, model, method, event or quantity)

    def probability(self, im: ArrayLike) -> NDArray[np.float64]:
        """The probability of exceedance at intensities: the mean curves.

        Parameters
        ----------
        im : float or array_like
            Intensities, at least 0, in `im_unit`.

        Returns
        -------
        ndarray, shape (T, *shape of im)

        Raises
        ------
        ValueError
            A negative intensity or NaN.
        """
        values = reals(im, "Fragility.probability: im")
        if not (values >= 0).all():
            raise ValueError(f"Fragility.probability: im must be at least 0, got {values.min():g}")
        flat = self._model.probability(self._found, values.reshape(-1))[0]
        shaped: _Array = flat.reshape(len(self.thresholds), *values.shape)
        return shaped

    def bands(
        self,
        level: float = 0.9,
        im: ArrayLike | None = None,
        *,
        samples: SupportsIndex = 1000,
        seed: SupportsIndex = 0,
        progress: bool | Progress | None = None,
    ) -> Bands:
        """Confidence bands, by resampling records.

        Each sample draws as many records as there are, with replacement; all responses to a record
        stay together: draws, polarities and stripes. More draws therefore do not narrow the bands;
        more records do.

        Parameters
        ----------
        level : float
            Confidence, above 0 and below 1.
        im : array_like, shape (K,), optional
            Intensities; default: 101, from the 0.1 % of the lowest to the 99.9 % of the highest
            curve.
        samples : int, optional
            Number of samples, at least 100.
        seed : int, optional
        progress : bool or callable, optional
            As for `run_ensemble`; a callable is called with the number of samples done and their
            total.

        Returns
        -------
        Bands

        Raises
        ------
        ValueError
            An argument out of range; a single record.

        Warns
        -----
        RuntimeWarning
            So few records that the resamples do not bound the bands: three or fewer for 90 %. More
            resamples than the bands leave out have no rising curve: the intervals are 0 to
            infinity; or no dispersion, because an intensity separates their responses: that of beta
            has no upper end.

        Notes
        -----
        Basic bootstrap intervals of ln median, ln beta, ln HCLPF and the normal score of the
        probability: percentiles of the samples, reflected at the estimate, which undoes the bias of
        a dispersion from few records. They are expanded for few records: sqrt(R/(R - 1)) times the
        quantile of Student's t with R - 1 degrees of freedom replaces the normal one, for R records
        (Hesterberg 2015). With 6 to 40 simulated records at nine levels, and dispersions of 0.25 to
        0.6, bands of 90 % cover the median in 87 to 93 % of 1,000 trials each, beta in 90 to 99 %,
        the HCLPF, whose misses are mostly true values below the band, in 85 to 94 % and the curve
        at one intensity in 91 to 100 %; plain percentiles cover 74 % for beta with 18 records.
        1,000 samples of 18 records at 20 levels take 0.1 s.
        """
        stats = optional("scipy.stats", "risk", "Fragility.bands")
        level = real(level, "Fragility.bands: level")
        if not 0 < level < 1:
            raise ValueError(f"Fragility.bands: level must lie between 0 and 1, got {level:g}")
        count = whole_number(samples, "Fragility.bands: samples", 100)
        records = self._model.records
        if records < 2:
            raise ValueError("Fragility.bands: needs at least 2 records to resample, got 1")
        where = self.grid() if im is None else np.atleast_1d(reals(im, "Fragility.bands: im"))
        if not (where >= 0).all():
            raise ValueError(f"Fragility.bands: im must be at least 0, got {where.min():g}")
        rng = np.random.default_rng(whole_number(seed, "Fragility.bands: seed", 0))
        weights = rng.multinomial(records, np.full(records, 1 / records), size=count).astype(float)
        with shown(progress, "Fragility.bands", "sample") as show:
            found = self._model.estimate(weights, show)
            show(count, count)
        wide = math.sqrt(records / (records - 1)) * stats.t.ppf((1 + level) / 2, records - 1)
        ends = [stats.norm.cdf(-wide), stats.norm.cdf(wide)]
        if ends[0] * count < 1:
            warnings.warn(
                f"Fragility.bands: {records} records do not bound bands of {100 * level:g} %: they"
                f" reach beyond what {count} resamples show, and are at least as wide as given",
                RuntimeWarning,
                stacklevel=2,
            )

        def reflected(samples: _Array, estimate: _Array) -> _Array:
            """The interval that lies about the estimate as the samples do, mirrored."""
            low, high = np.quantile(samples, ends, axis=0)
            interval: _Array = np.stack([2 * estimate - high, 2 * estimate - low])
            return interval

        def of_positive(samples: _Array, estimate: _Array, lost: NDArray[np.bool_]) -> _Array:
            with np.errstate(invalid="ignore"):  # infinite values
                interval: _Array = np.exp(reflected(np.log(samples), np.log(estimate)))
            interval[:, lost | np.isinf(estimate)] = [[0.0], [np.inf]]
            return interval.T

        def score(p: _Array) -> _Array:
            scores: _Array = stats.norm.ppf(np.clip(p, 1e-300, 1 - 1e-16))
            return scores

        mean = self._model.probability(self._found, where)[0]
        low, high = stats.norm.cdf(
            reflected(score(self._model.probability(found, where)), score(mean))
        )
        sure = (mean == 0) | (mean == 1)
        low, high = np.where(sure, mean, low), np.where(sure, mean, high)
        medians, betas = self._model.summary(found)
        hclpfs = self._model.quantile(found, _HCLPF)
        curve = np.isfinite(medians) & np.isfinite(betas) & np.isfinite(hclpfs)
        curve &= found["fitted"].reshape(count, -1)
        spread = curve & found["spread"].reshape(count, -1)
        # No end of an interval may lie among samples without a value, or next to them.
        bounded = ends[0] * count >= 1
        most = ends[0] * (count - 1) - 1 if bounded else 0
        no_curve, no_spread = ((~one).sum(axis=0) for one in (curve, spread))
        lost, sharp = no_curve > most, no_spread > most
        for i in np.flatnonzero(sharp & np.isfinite(self.median)) if bounded else ():
            missing, why, what = (
                (no_curve[i], "no rising curve", "its median, beta and HCLPF are unbounded")
                if lost[i]
                else (no_spread[i], "no dispersion", "its beta has no upper bound")
            )
            warnings.warn(
                f"Fragility.bands: {missing} of {count} resamples of {records} records have {why}"
                f" for {self.labels[i]}, more than the bands leave out: {what}",
                RuntimeWarning,
                stacklevel=2,
            )
        median = of_positive(medians, self.median, lost)
        beta = of_positive(betas, self.beta, lost)
        beta[sharp, 1] = np.inf  # samples are reflected: no dispersion bounds it from above
        hclpf = of_positive(hclpfs, self.hclpf, lost)
        return Bands(where, low, high, median, beta, hclpf)

    @property
    def labels(self) -> tuple[str, ...]:
        """The thresholds as text, such as '0.1 m'."""
        return self._data.labels

    @property
    def extrapolated(self) -> NDArray[np.bool_]:
        """Whether median and HCLPF are outside `im_range`, shape (T, 2)."""
        low, high = self.im_range
        values = np.stack([self.median, self.hclpf], axis=1)
        outside: NDArray[np.bool_] = (values < low) | (values > high)
        return outside

    def _outside(self) -> str:
        """What is outside `im_range`, as a text; empty if nothing is."""
        found = [
            f"{name} of {', '.join(n for n, beyond in zip(self.labels, column) if beyond)}"
            for name, column in zip(("median", "HCLPF"), self.extrapolated.T)
            if column.any()
        ]
        low, high = self.im_range
        where = f" outside {low:.4g} to {high:.4g} {self.im_unit}".rstrip()
        return " and ".join(found) + where if found else ""

    def grid(self) -> NDArray[np.float64]:
        """101 intensities over which the curves rise, shape (101,)."""
        low, high = (self._model.quantile(self._found, p) for p in (0.001, 0.999))
        largest = 2 * self._data.im.max()  # for a curve that never gets there
        return np.geomspace(
            min(low.min(), self._data.im.min()), np.where(np.isinf(high), largest, high).max(), 101
        )

    def rate_of_exceedance(self, hazard: Hazard) -> Exceedances:
        """The annual rates at which the thresholds are exceeded, under a hazard curve.

        rate = integral of P(D > d | IM) |d lambda(IM)|, the hazard curve lambda interpolated and
        extrapolated in log-log.

        Parameters
        ----------
        hazard : Hazard
            Annual rates against the same intensity measure, in the same unit, as `read_hazard`
            returns it.

        Returns
        -------
        Exceedances

        Raises
        ------
        TypeError
            `hazard` is not a Hazard.
        ValueError
            The hazard curve is known to be of another intensity measure, unit or period; under
            'logit', it is too steep for the lower tail of a curve: below the first point it rises
            as IM^-k with k of at least pi/(sqrt(3) beta), and the rate has no bound.

        Warns
        -----
        RuntimeWarning
            More than 10 % of a rate comes from beyond the points of the hazard curve.
        RangeWarning
            More than 10 % of a rate comes from beyond the intensities of the ground motions.
        """
        from .hazard import exceedances

        return exceedances(self, hazard)

    def to_pelicun(self, path: str | os.PathLike[str], id: str = "sliding") -> Path:
        """Write the curves as a table of fragilities of pelicun: a CSV file.

        Parameters
        ----------
        path : path-like
        id : str, optional
            Name of the component.

        Returns
        -------
        Path

        Raises
        ------
        ValueError
            Curves that are not lognormal; an intensity measure that pelicun does not know.
        """
        from .exports import to_pelicun

        return to_pelicun(self, path, id)

    def to_openquake(self, path: str | os.PathLike[str], id: str = "sliding") -> Path:
        """Write the curves as a fragility model of OpenQuake: an NRML 0.5 file.

        Lognormal curves are continuous functions, others discrete ones at 101 intensities.

        Parameters
        ----------
        path : path-like
        id : str, optional
            Taxonomy of the asset.

        Returns
        -------
        Path

        Raises
        ------
        ValueError
            An intensity measure that OpenQuake does not know.
        """
        from .exports import to_openquake

        return to_openquake(self, path, id)

    @overload
    def plot(
        self, *, level: float | None = ..., ax: None = None, title: str | None = ...
    ) -> Figure: ...
    @overload
    def plot(self, *, level: float | None = ..., ax: Axes, title: str | None = ...) -> Axes: ...
    def plot(
        self, *, level: float | None = 0.9, ax: Axes | None = None, title: str | None = None
    ) -> Figure | Axes:
        """Plot the curves with their bands, and the fractions of responses that exceed.

        Curves are dashed beyond the intensities of the ground motions.

        Parameters
        ----------
        level : float, optional
            Confidence of the bands; None for none.
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
        from ..plotting import plot_fragility

        return plot_fragility(self, level=level, ax=ax, title=title)

    def fractions(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The fractions of responses that exceed each threshold, at each level of intensity.

        Returns
        -------
        im : ndarray, shape (L,)
        fractions : ndarray, shape (T, L)
        """
        levels, place = np.unique(self._data.im, return_inverse=True)
        d = self._data.demand
        count = np.bincount(place.reshape(-1), (~np.isnan(d)).sum(axis=(0, 2)))
        hits = [
            np.bincount(place.reshape(-1), (d > level).sum(axis=(0, 2)))
            for level in self._data.levels
        ]
        return levels, np.array(hits) / np.maximum(count, 1)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Fragility):
            return NotImplemented
        return self.to_json() == other.to_json()

    __hash__ = None

    def _table(self) -> tuple[Columns, Mapping[str, str]]:
        numbers = not any(isinstance(one, Event) for one in self.thresholds)
        names = ("median", "beta", "beta_records", "beta_parameters", "hclpf")
        columns: dict[str, NDArray[Any]] = {
            "threshold": np.array(self.thresholds if numbers else self.labels),
            **{name: getattr(self, name) for name in names},
            "extrapolated": np.array(
                [
                    " ".join(n for n, out in zip(("median", "hclpf"), row) if out)
                    for row in self.extrapolated
                ]
            ),
            "im": np.full(len(self.thresholds), self.im),
            "im_directions": np.full(len(self.thresholds), self.im_directions),
            "method": np.full(len(self.thresholds), self.method),
        }
        units = {"threshold": self._data.unit, "median": self.im_unit, "hclpf": self.im_unit}
        return columns, units

    def __repr__(self) -> str:
        unit = f" {self.im_unit}" if self.im_unit else ""
        curves = ", ".join(
            f"{label}: {median:.3g}{unit} (beta {beta:.2f})"
            for label, median, beta in zip(self.labels, self.median, self.beta)
        )
        outside = self._outside()
        note = f"; extrapolated: {outside}" if outside else ""
        return f"<Fragility by {self._measure()}: {curves}{note}>"

    def _measure(self) -> str:
        """The intensity measure as a text, such as 'RotD50 of pga_g'."""
        at = "" if self.im_period is None else f" at {self.im_period:g} s"
        return f"{OF_DIRECTIONS.get(self.im_directions, '')}{self.im}{at}"
