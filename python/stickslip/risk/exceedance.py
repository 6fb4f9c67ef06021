"""Fragility from counts of exceedances: binomial likelihood, lognormal or logit curves."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._optional import optional
from ..runs.progress import Progress
from .levels import Levels
from .observations import Observations
from .shifts import deviation_of_draws, shifts

__all__ = ["Exceedance", "fit_parallel"]

Array = NDArray[np.float64]
_FLATTEST = 0.05  # slope below which a curve counts as flat: beta = 20
_STEEPEST = 200.0  # slope at which a curve counts as a step: beta = 0.005


class Link:
    """A distribution function, by its name: the standard normal one, or the logistic one.

    `deviation` is the standard deviation of the distribution, and beyond `farthest` a residual has
    no effect.
    """

    def __init__(self, method: str) -> None:
        special = optional("scipy.special", "risk", "Fragility.fit")
        self.method = method
        self.farthest = 8.0 if method == "lognormal" else 36.0
        self.deviation = 1.0 if method == "lognormal" else math.pi / math.sqrt(3)
        self.log_cdf = special.log_ndtr if method == "lognormal" else special.log_expit
        self.cdf = special.ndtr if method == "lognormal" else special.expit
        self.quantile = special.ndtri if method == "lognormal" else special.logit

    def density(self, eta: Array, variance: Array) -> Array:
        """The density at `eta`, where p (1 - p) is `variance`."""
        if self.method == "lognormal":
            density: Array = np.exp(-0.5 * eta**2) / math.sqrt(2 * math.pi)
            return density
        return variance


def fit_parallel(
    x: Array, k: Array, n: Array, link: Link, start: float = 1.0
) -> tuple[Array, Array]:
    """Maximum likelihood of P = F(slope x + intercept), one slope for all thresholds.

    Fisher's scoring for many samples at a time; the information is an arrowhead, so each step
    solves one equation for the slope. A sample that a step function separates ends at a steep
    slope.

    Parameters
    ----------
    x : ndarray, shape (U,)
        ln IM of each level.
    k : ndarray, shape (B, T, U)
        Exceedances, for each sample and threshold.
    n : ndarray, shape (B, U)
        Responses.
    link : Link
    start : float, optional
        Slope to begin with.

    Returns
    -------
    slope : ndarray, shape (B,)
    intercept : ndarray, shape (B, T)
    """
    total = n.sum(axis=1)
    center = float((n * x).sum() / total.sum())
    z = x - center
    reach = max(float(np.abs(z).max()), 1e-9)
    slopes = np.full(len(k), start)
    intercepts = link.quantile((k.sum(axis=2) + 0.5) / (total[:, np.newaxis] + 1))
    left = np.arange(len(k))  # samples that have not converged
    for _ in range(100):
        slope, intercept = slopes[left], intercepts[left]
        weight = n[left][:, np.newaxis, :]
        eta = slope[:, np.newaxis, np.newaxis] * z + intercept[:, :, np.newaxis]
        np.clip(eta, -link.farthest, link.farthest, out=eta)
        p = link.cdf(eta)
        variance = p * link.cdf(-eta)
        ratio = link.density(eta, variance) / variance
        residual = (k[left] - weight * p) * ratio
        w = weight * (ratio**2 * variance)
        wz = w * z
        a_grad, b_grad = residual.sum(axis=2), (residual @ z).sum(axis=1)
        aa, ab = w.sum(axis=2) + 1e-9, wz.sum(axis=2)
        schur = np.maximum((wz @ z).sum(axis=1) - (ab**2 / aa).sum(axis=1), 1e-9)
        b_step = (b_grad - (ab * a_grad / aa).sum(axis=1)) / schur
        a_step = (a_grad - ab * b_step[:, np.newaxis]) / aa
        largest = np.maximum(np.abs(a_step).max(axis=1), np.abs(b_step) * reach)
        damp = np.minimum(1, 1.5 / np.maximum(largest, 1e-300))
        slopes[left] = np.clip(slope + damp * b_step, -_STEEPEST, _STEEPEST)
        intercepts[left] = np.clip(intercept + damp[:, np.newaxis] * a_step, -1e3, 1e3)
        left = left[(largest > 1e-8) & (np.abs(slopes[left]) < _STEEPEST)]
        if not left.size:
            break
    return slopes, intercepts - slopes[:, np.newaxis] * center


def _outcomes(k: Array, n: Array) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Whether a sample has both outcomes, and whether no intensity separates them, (B, T) each."""
    some, less = k > 0, k < n[:, np.newaxis, :]
    both: NDArray[np.bool_] = np.logical_and(some.any(axis=2), less.any(axis=2))
    last = k.shape[2] - 1 - less[:, :, ::-1].argmax(axis=2)
    mixed: NDArray[np.bool_] = both & (some.argmax(axis=2) < last)
    return both, mixed


class Exceedance:
    """The binomial model: P(D > threshold | IM) = F((ln IM - ln median)/beta).

    Parameters
    ----------
    data : Observations
    method : 'lognormal' or 'logit'
    separate : bool
        Whether each threshold has its own dispersion.
    """

    def __init__(self, data: Observations, method: str, separate: bool) -> None:
        self.data, self.separate = data, separate
        self.link = Link(method)
        self.levels = Levels(data)
        self.x = self.levels.x
        valid = ~np.isnan(data.demand)
        # Of each draw and motion, over polarities.
        self.count = valid.sum(axis=2).astype(float)
        self.hits = np.stack([(data.demand > level).sum(axis=2) for level in data.levels]).astype(
            float
        )
        self.check()
        self._n = self.levels.table(self.count.sum(axis=0))
        self._k = [self.levels.table(hits.sum(axis=0)) for hits in self.hits]

    @property
    def records(self) -> int:
        """Number of records."""
        return self.levels.records

    def check(self) -> None:
        """Raise ValueError if the likelihood has no maximum."""
        data = self.data
        total = self.count.sum()
        steps = []
        for label, hits in zip(data.labels, self.hits):
            found = hits.sum()
            events = {"impact": "hit", "overturning": "overturn"}
            what = events.get(label, f"exceed {label}")
            if found in (0, total):
                share, other = ("none", "higher") if found == 0 else ("all", "lower")
                raise ValueError(
                    f"Fragility.fit: {share} of the {total:.0f} responses {what}, so the fit is"
                    f" unbounded: it needs ground motions with {other} {data.im_name}, or another"
                    " threshold"
                )
            some, less = hits.sum(axis=0) > 0, (self.count - hits).sum(axis=0) > 0
            # Also with both outcomes at one level alone: any steeper curve through it fits better.
            steps.append(data.im[some].min() >= data.im[less].max())
            if steps[-1] and self.separate:
                break
        if all(steps) or (self.separate and any(steps)):
            place = steps.index(True)
            hits = self.hits[place]
            at = data.im == data.im[hits.sum(axis=0) > 0].min()
            share = hits[:, at].sum() / self.count[:, at].sum()
            where = f"{data.im[at][0]:.4g} {data.im_unit}".rstrip()
            but = f" but at {where}, where {100 * share:.3g} % do" if share < 1 else ""
            also = "" if all(steps) else ", or separate=False, which lends it that of the others"
            raise ValueError(
                f"Fragility.fit: {data.im_name} separates the responses that exceed"
                f" {data.labels[place]} from all others{but}: any steeper curve fits better, so the"
                " fit is unbounded, with a dispersion of zero: it needs more levels about"
                f" {where}, or more records{also}"
            )

    def shared_dispersion(self) -> tuple[float, Array]:
        """Test whether all thresholds have one dispersion; and the dispersion of each alone.

        A likelihood ratio. Responses to one record are alike: the ratio is divided by the factor by
        which that increases the variances of the differences of slopes, on average (Rao and Scott
        1984), and compared with the distribution of F, as the factor is estimated from the records.

        Returns
        -------
        p : float
            NaN for one threshold or record, and for separate dispersions.
        beta : ndarray, shape (T,)
        """
        if self.separate or len(self.hits) < 2 or self.records < 2:
            return math.nan, np.full(len(self.hits), math.nan)
        stats = optional("scipy.stats", "risk", "Fragility.fit")
        ratio, slope, intercept, alone = self.likelihood_ratio()
        free = len(self.hits) - 1
        x, count = np.log(self.data.im), self.count.sum(axis=0)
        z = x - x.mean()
        eta = slope * x + intercept[:, np.newaxis]
        np.clip(eta, -self.link.farthest, self.link.farthest, out=eta)
        p = self.link.cdf(eta)
        variance = p * self.link.cdf(-eta)
        density = self.link.density(eta, variance)
        residual = (self.hits.sum(axis=1) - count * p) * density / variance
        weight = count * density**2 / variance
        # Influences of the records on the slopes, and the variances of slopes if all responses
        # were independent.
        scores = self.levels.by_record(np.stack([residual, residual * z], axis=1))
        moments = [(weight * z**i).sum(axis=1) for i in range(3)]
        determinant = moments[0] * moments[2] - moments[1] ** 2
        of_slopes = np.stack([-moments[1], moments[0]], axis=1) / determinant[:, np.newaxis]
        influence = (scores * of_slopes[:, :, np.newaxis]).sum(axis=1)
        independent = np.diag(moments[0] / determinant)
        differences = np.eye(free, free + 1) - np.eye(free, free + 1, 1)
        found = np.atleast_2d(np.cov(influence)) * self.records
        factor = np.trace(
            np.linalg.solve(
                differences @ independent @ differences.T, differences @ found @ differences.T
            )
        )
        score = ratio / (free * max(factor / free, 1.0))
        return float(stats.f.sf(score, free, self.records - 1)), alone

    def likelihood_ratio(self) -> tuple[float, float, Array, Array]:
        """Twice the gain in log-likelihood by separate dispersions.

        Returns
        -------
        ratio, slope : float
        intercept, beta : ndarray, shape (T,)
            The common fit, and the dispersions of the separate ones.
        """
        n = self.levels.by_level(self.count.sum(axis=0))
        k = self.levels.by_level(self.hits.sum(axis=1))

        def likelihood(slope: Array, intercept: Array) -> float:
            eta = slope[:, np.newaxis] * self.x + intercept[:, np.newaxis]
            return float((k * self.link.log_cdf(eta) + (n - k) * self.link.log_cdf(-eta)).sum())

        common, cuts = fit_parallel(self.x, k[np.newaxis], n[np.newaxis], self.link)
        each, cut = fit_parallel(
            self.x, k[:, np.newaxis], np.repeat(n[np.newaxis], len(k), axis=0), self.link
        )
        shared = likelihood(np.repeat(common, len(k)), cuts[0])
        ratio = 2 * (likelihood(each, cut[:, 0]) - shared)
        mixed = _outcomes(k[np.newaxis], n[np.newaxis])[1][0]
        beta = np.where(mixed, self.link.deviation / each, 0.0)
        return ratio, float(common[0]), cuts[0], beta

    def estimate(
        self, weights: Array | None = None, progress: Progress | None = None
    ) -> dict[str, NDArray[Any]]:
        """The median and the dispersion, for each row of weights of the records.

        Parameters
        ----------
        weights : ndarray, shape (B, R), optional
            Default: one row of ones.
        progress : callable, optional
            Called with the number of rows that are done, and all.

        Returns
        -------
        dict
            `median` and `beta`, shape (B, T); `fitted`, whether they are known, and `spread`,
            whether the likelihood has its maximum at a dispersion above zero.
        """
        rows = np.ones((1, self.records)) if weights is None else weights
        size = max(1, min(100, int(2e6 / (len(self._k) * len(self.x)))))
        slopes, intercepts, both, spread = [], [], [], []
        for begin in range(0, len(rows), size):
            if progress is not None:
                progress(begin, len(rows))
            some = rows[begin : begin + size]
            n = some @ self._n
            k = np.stack([some @ one for one in self._k], axis=1)
            outcomes, mixed = _outcomes(k, n)
            both.append(outcomes)
            spread.append(mixed if self.separate else mixed | mixed.any(axis=1, keepdims=True))
            if self.separate:
                count, thresholds, levels = k.shape
                slope, intercept = fit_parallel(
                    self.x,
                    k.reshape(-1, 1, levels),
                    np.repeat(n, thresholds, axis=0),
                    self.link,
                )
                slopes.append(slope.reshape(count, thresholds))
                intercepts.append(intercept.reshape(count, thresholds))
            else:
                slope, intercept = fit_parallel(self.x, k, n, self.link)
                slopes.append(np.repeat(slope[:, np.newaxis], k.shape[1], axis=1))
                intercepts.append(intercept)
        slope, intercept = np.concatenate(slopes), np.concatenate(intercepts)
        if weights is None and not (slope > _FLATTEST).all():
            raise ValueError(
                f"Fragility.fit: exceedances hardly become more frequent with {self.data.im_name}"
                f" (a dispersion above {self.link.deviation / _FLATTEST:.3g}), so it is no measure"
                " of intensity for them"
            )
        # A resample may lack exceedances or be flat: its curve then lies far outside.
        fitted = np.concatenate(both) & (slope > _FLATTEST)
        slope = np.maximum(slope, _FLATTEST)
        reach = 20.0
        log_median = np.clip(-intercept / slope, self.x[0] - reach, self.x[-1] + reach)
        return {
            "median": np.exp(log_median),
            "beta": self.link.deviation / slope,
            "fitted": fitted,
            "spread": np.concatenate(spread),
        }

    def probability(self, found: dict[str, Array], im: Array) -> Array:
        """The curves, shape (B, T, K), at intensities of shape (K,)."""
        with np.errstate(divide="ignore"):
            u = np.log(im) - np.log(found["median"])[:, :, np.newaxis]
        result: Array = self.link.cdf(self.link.deviation * u / found["beta"][:, :, np.newaxis])
        return result

    def quantile(self, found: dict[str, Array], p: float) -> Array:
        """The intensity at which the probability is p, shape (B, T)."""
        score = float(self.link.quantile(p)) / self.link.deviation
        result: Array = found["median"] * np.exp(score * found["beta"])
        return result

    def summary(self, found: dict[str, Array]) -> tuple[Array, Array]:
        """Median and dispersion, shape (B, T) each."""
        return found["median"], found["beta"]

    def deviation_of_draws(self) -> Array:
        """Standard deviation over draws of the ln median of each, for each threshold."""
        every = range(len(self.hits))
        groups = [[t] for t in every] if self.separate else [list(every)]
        found = [self._deviation(group) for group in groups]
        return np.array(found if self.separate else found * len(self.hits))

    def _deviation(self, which: list[int]) -> float:
        """The deviation of some thresholds, whose curves are parallel."""
        hits = self.hits[which]
        draws = hits.shape[1]
        if draws < 2:
            return 0.0
        hits, count = self.levels.by_level(hits), self.levels.by_level(self.count)
        delta, slope, intercept = np.zeros(draws), 1.0, np.zeros(len(hits))

        def mean_and_ratio(shift: Array, x: Array) -> tuple[Array, Array, Array]:
            """P at ln IM less the shift of each draw, density/(P (1 - P)), and P (1 - P)."""
            eta = slope * (x - shift[:, np.newaxis]) + intercept[:, np.newaxis, np.newaxis]
            np.clip(eta, -self.link.farthest, self.link.farthest, out=eta)
            p = self.link.cdf(eta)
            variance = p * self.link.cdf(-eta)
            return p, self.link.density(eta, variance) / variance, variance

        def score(shift: Array) -> Array:
            p, ratio, _ = mean_and_ratio(shift, self.x)
            total: Array = -slope * ((hits - count * p) * ratio).sum(axis=(0, 2))
            return total

        def information(shift: Array) -> Array:
            _, ratio, variance = mean_and_ratio(shift, self.x)
            total: Array = slope**2 * (count * ratio**2 * variance).sum(axis=(0, 2))
            return total

        for _ in range(30):
            x = (self.x - delta[:, np.newaxis]).ravel()
            k = hits.reshape(1, len(hits), -1)
            steep, cut = fit_parallel(x, k, count.reshape(1, -1), self.link, slope)
            slope, intercept = float(np.clip(steep[0], 1e-3, 20)), cut[0]
            before = delta
            delta = shifts(delta, score, information)
            delta = delta - delta.mean()
            if np.abs(delta - before).max() < 1e-4:
                break
        p, ratio, _ = mean_and_ratio(delta, np.log(self.data.im))
        by_motion = -slope * ((self.hits[which] - self.count * p) * ratio).sum(axis=0)
        return deviation_of_draws(delta, self.levels.by_record(by_motion), information(delta))
