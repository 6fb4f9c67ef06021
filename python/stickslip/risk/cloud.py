"""Fragility from a cloud: a regression of ln D on ln IM, with the responses that do not slide."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._numbers import real
from .._optional import optional
from ..runs.progress import Progress
from .exceedance import Link, fit_parallel
from .levels import Levels
from .observations import Event, Observations
from .shifts import deviation_of_draws, shifts

__all__ = ["Cloud"]

Array = NDArray[np.float64]
_FLATTEST = 1e-2  # slope of ln D below which a sample counts as flat
_SHARPEST = 1e-2  # sigma that stands for none
_FAR = math.log(100)  # in ln IM beyond the largest intensity; no curve is known there


class Cloud:
    """P(D > d | IM) = P(D > 0 | IM) (1 - Phi((ln d - a - b ln IM)/sigma)).

    P(D = 0 | IM) is a logistic function of ln IM. For D > 0, ln D = a + b ln IM + e with a normal e
    of deviation sigma. Displacements below a stated one are left-censored: the likelihood only
    uses that they are below.

    Parameters
    ----------
    data : Observations
    censored_below : float
        Demand, in its unit.
    """

    def __init__(self, data: Observations, censored_below: float) -> None:
        special = optional("scipy.special", "risk", "Fragility.fit")
        self.data = data
        self.link = Link("logit")
        self._cdf, self._log_cdf = special.ndtr, special.log_ndtr
        for one in data.thresholds:
            if isinstance(one, Event):
                raise ValueError(
                    f"Fragility.fit: {one!r} has no displacement for method='cloud'; use"
                    " 'lognormal' or 'logit'"
                )
        censored_below = real(censored_below, "Fragility.fit: censored_below")
        if not 0 < censored_below < data.levels.min():
            raise ValueError(
                "Fragility.fit: censored_below must be positive and below the lowest threshold,"
                f" {data.levels.min():g} {data.unit}, got {censored_below:g} {data.unit}"
            )
        self.censor = math.log(censored_below)
        d = data.demand
        if np.isinf(d).any():
            raise ValueError(
                "Fragility.fit: blocks that overturn have no finite peak for method='cloud'; use"
                " 'lognormal' or 'logit'"
            )
        valid, sliding = np.isfinite(d), d > 0
        seen = sliding & (d >= censored_below)
        y = np.log(np.where(seen, d, 1.0))
        # Of each draw and motion: responses, those that slide, those whose D is seen, sums of ln D.
        self.parts = {
            "n": valid.sum(axis=2).astype(float),
            "slide": sliding.sum(axis=2).astype(float),
            "seen": seen.sum(axis=2).astype(float),
            "y": y.sum(axis=2),
            "yy": (y**2).sum(axis=2),
        }
        if seen.any(axis=(0, 2)).sum() < 3:
            raise ValueError(
                "Fragility.fit: method='cloud' needs at least 3 ground motions under which the"
                f" slider moves {censored_below:g} m or more, got {seen.any(axis=(0, 2)).sum()}"
            )
        self.levels = Levels(data)
        self.x = self.levels.x
        self._pooled = {n: self.levels.table(v.sum(axis=0)) for n, v in self.parts.items()}
        if np.ptp(np.log(data.im)[seen.any(axis=(0, 2))]) < 1e-9:
            raise ValueError(
                f"Fragility.fit: method='cloud' needs different {data.im_name}; all are"
                f" {data.im[0]:g}: use method='lognormal' with stripes"
            )

    @property
    def records(self) -> int:
        """Number of records."""
        return self.levels.records

    def _fitted(self, x: Array, parts: dict[str, Array]) -> dict[str, Array]:
        """Maximum likelihood for each row of parts, shape (B, U), at ln IM of shape (U,)."""
        rows = len(parts["n"])
        if (parts["slide"] == parts["n"]).all():  # all slide
            rise, cut = np.zeros(rows), np.full(rows, np.inf)
        else:
            k = parts["slide"][:, np.newaxis, :]
            rise, cuts = fit_parallel(x, k, parts["n"], self.link)
            cut = cuts[:, 0]
        a, b, sigma = self._regression(x, parts)
        return {"rise": rise, "cut": cut, "a": a, "b": b, "sigma": sigma}

    @staticmethod
    def _determined(
        found: dict[str, Array], parts: dict[str, Array]
    ) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Whether samples determine curves that rise, and a scatter above zero, shape (B,) each."""
        levels = (parts["seen"] > 0).sum(axis=1)
        all_slide = (parts["slide"] == parts["n"]).all(axis=1)
        rises = (found["b"] > _FLATTEST) & ((found["rise"] > 0) | all_slide)
        return (levels > 1) & rises, (levels > 2) & (found["sigma"] > _SHARPEST)

    def _regression(self, x: Array, parts: dict[str, Array]) -> tuple[Array, Array, Array]:
        """The censored regression, in Olsen's parameters a/sigma, b/sigma and 1/sigma."""
        seen, y, yy = parts["seen"], parts["y"], parts["yy"]
        censored = parts["slide"] - seen
        count = seen.sum(axis=1)
        center = float((seen * x).sum() / count.sum())
        z = x - center
        # Least squares of what is seen as a start.
        sz, szz = (seen * z).sum(axis=1), (seen * z**2).sum(axis=1)
        sy, szy = y.sum(axis=1), (y * z).sum(axis=1)
        spread = np.maximum(count * szz - sz**2, 1e-12)
        b = (count * szy - sz * sy) / spread
        a = (sy - b * sz) / np.maximum(count, 1)
        left = yy.sum(axis=1) - a * sy - b * szy
        sigma = np.maximum(np.sqrt(np.maximum(left, 0) / np.maximum(count, 1)), _SHARPEST)
        if not censored.any():
            return a - b * center, b, sigma
        theta = np.stack([a / sigma, b / sigma, 1 / sigma], axis=1)
        for _ in range(60):
            g0, g1, h = (theta[:, i, np.newaxis] for i in range(3))
            mu = g0 + g1 * z
            at = np.clip(h * self.censor - mu, -30, 30)
            mills = np.exp(-0.5 * at**2 - 0.5 * math.log(2 * math.pi) - self._log_cdf(at))
            slope = -mills * (at + mills)
            dmu = h * y - seen * mu - censored * mills
            dh = seen / h - h * yy + y * mu + censored * mills * self.censor
            hmm = -seen + censored * slope
            hmh = y - censored * slope * self.censor
            hhh = -seen / h**2 - yy + censored * slope * self.censor**2
            gradient = np.stack([dmu.sum(axis=1), (dmu * z).sum(axis=1), dh.sum(axis=1)], axis=1)
            hessian = np.empty((len(theta), 3, 3))
            hessian[:, 0, 0], hessian[:, 1, 1] = hmm.sum(axis=1), (hmm * z**2).sum(axis=1)
            hessian[:, 0, 1] = hessian[:, 1, 0] = (hmm * z).sum(axis=1)
            hessian[:, 0, 2] = hessian[:, 2, 0] = hmh.sum(axis=1)
            hessian[:, 1, 2] = hessian[:, 2, 1] = (hmh * z).sum(axis=1)
            hessian[:, 2, 2] = hhh.sum(axis=1)
            hessian -= 1e-9 * np.eye(3)
            step = -np.linalg.solve(hessian, gradient[:, :, np.newaxis])[:, :, 0]
            # 1/sigma stays positive.
            damp = np.minimum(1, 0.5 * theta[:, 2] / np.maximum(np.abs(step[:, 2]), 1e-300))
            theta = theta + damp[:, np.newaxis] * step
            if np.abs(step).max() < 1e-8 * max(1.0, np.abs(theta).max()):
                break
        sigma = 1 / theta[:, 2]
        a, b = theta[:, 0] * sigma, theta[:, 1] * sigma
        return a - b * center, b, sigma

    def regression(self) -> dict[str, float]:
        """a, b and sigma of ln D = a + b ln IM + e."""
        parts = {name: values.sum(axis=0)[np.newaxis] for name, values in self.parts.items()}
        found = self._regression(np.log(self.data.im), parts)
        return {name: float(value[0]) for name, value in zip(("a", "b", "sigma"), found)}

    def estimate(
        self, weights: Array | None = None, progress: Progress | None = None
    ) -> dict[str, NDArray[Any]]:
        """The parameters of the two parts, for each row of weights of the records.

        With `fitted` and `spread` as in `Exceedance.estimate`, of shape (B,).
        """
        rows = np.ones((1, self.records)) if weights is None else weights
        size = max(1, min(100, int(1e6 / len(self.x))))
        found: list[dict[str, NDArray[Any]]] = []
        for begin in range(0, len(rows), size):
            if progress is not None:
                progress(begin, len(rows))
            some = rows[begin : begin + size]
            parts = {name: some @ values for name, values in self._pooled.items()}
            one: dict[str, NDArray[Any]] = {**self._fitted(self.x, parts)}
            one["fitted"], one["spread"] = self._determined(one, parts)
            found.append(one)
        result = {name: np.concatenate([one[name] for one in found]) for name in found[0]}
        if weights is None and (result["b"][0] <= 0 or result["rise"][0] < 0):
            raise ValueError(
                f"Fragility.fit: displacements do not grow with {self.data.im_name}, so it is no"
                " measure of intensity for them"
            )
        # A resample may be flat or fall: its curve then lies far outside.
        result["b"] = np.maximum(result["b"], _FLATTEST)
        result["rise"] = np.maximum(result["rise"], 0.0)
        return result

    def probability(self, found: dict[str, Array], im: Array) -> Array:
        """The curves, shape (B, T, K), at intensities of shape (K,)."""
        with np.errstate(divide="ignore"):
            u = np.log(im)
        return self._at(found, np.broadcast_to(u, (1, 1, len(u))))

    def _at(self, found: dict[str, Array], u: Array) -> Array:
        """The probability at ln IM of shape (B or 1, T or 1, K)."""
        a, b, sigma, rise, cut = (
            found[name][:, np.newaxis, np.newaxis] for name in ("a", "b", "sigma", "rise", "cut")
        )
        d = np.log(self.data.levels)[:, np.newaxis]
        with np.errstate(invalid="ignore"):  # 0 times infinity where all slide
            slides = np.where(np.isinf(cut), 1.0, self.link.cdf(rise * u + cut))
        result: Array = slides * self._cdf((a + b * u - d) / sigma)
        return result

    def quantile(self, found: dict[str, Array], p: float) -> Array:
        """The intensity at which the probability is p, shape (B, T), by bisection.

        Infinite where no intensity up to a hundred times the largest is enough, as when P(D > 0)
        hardly grows with the intensity.
        """
        shape = (len(found["a"]), len(self.data.levels), 1)
        low, high = np.full(shape, self.x.min() - 20), np.full(shape, self.x.max() + _FAR)
        never = self._at(found, high)[:, :, 0] < p
        for _ in range(60):
            middle = (low + high) / 2
            above = self._at(found, middle) >= p
            low, high = np.where(above, low, middle), np.where(above, middle, high)
        result: Array = np.where(never, np.inf, np.exp((low + high) / 2)[:, :, 0])
        return result

    def summary(self, found: dict[str, Array]) -> tuple[Array, Array]:
        """Median, and half the distance of the ln IM at 16 and 84 %, shape (B, T) each."""
        one = float(self._cdf(1.0))
        high, low = self.quantile(found, one), self.quantile(found, 1 - one)
        with np.errstate(invalid="ignore"):  # infinite where neither is reached
            beta = np.where(np.isinf(high), np.inf, np.log(high / low) / 2)
        return self.quantile(found, 0.5), np.maximum(beta, 1e-3)

    def deviation_of_draws(self) -> Array:
        """Standard deviation over draws of the ln median of each, for each threshold."""
        draws = len(self.parts["n"])
        thresholds = len(self.data.levels)
        if draws < 2:
            return np.zeros(thresholds)
        parts = {name: self.levels.by_level(values) for name, values in self.parts.items()}
        delta = np.zeros(draws)
        found: dict[str, float] = {}

        def at(shift: Array, x: Array = self.x) -> Array:
            return x - shift[:, np.newaxis]

        def slides(x: Array) -> Array:
            if math.isinf(found["cut"]):
                return np.ones_like(x)
            p: Array = self.link.cdf(found["rise"] * x + found["cut"])
            return p

        def slopes(x: Array, parts: dict[str, Array]) -> Array:
            """Derivative of the log-likelihood by the shift, for each draw and level or motion."""
            mu = found["a"] + found["b"] * x
            z = np.clip((self.censor - mu) / found["sigma"], -30, 30)
            mills = np.exp(-0.5 * z**2 - 0.5 * math.log(2 * math.pi) - self._log_cdf(z))
            censored = parts["slide"] - parts["seen"]
            dmu = (parts["y"] - parts["seen"] * mu) / found["sigma"] ** 2
            dmu = dmu - censored * mills / found["sigma"]
            misses = parts["slide"] - parts["n"] * slides(x)
            slope: Array = -found["rise"] * misses - found["b"] * dmu
            return slope

        def score(shift: Array) -> Array:
            total: Array = slopes(at(shift), parts).sum(axis=1)
            return total

        def information(shift: Array) -> Array:
            p = slides(at(shift))
            of_slope = (found["b"] / found["sigma"]) ** 2
            total: Array = (parts["n"] * (found["rise"] ** 2 * p * (1 - p) + of_slope * p)).sum(
                axis=1
            )
            return total

        for _ in range(30):
            flat = {name: values.reshape(1, -1) for name, values in parts.items()}
            found = {k: float(v[0]) for k, v in self._fitted(at(delta).ravel(), flat).items()}
            before = delta
            delta = shifts(delta, score, information)
            delta = delta - delta.mean()
            if np.abs(delta - before).max() < 1e-4:
                break
        of_motions = slopes(at(delta, np.log(self.data.im)), self.parts)
        by_record = self.levels.by_record(of_motions)
        deviation = deviation_of_draws(delta, by_record, information(delta))
        return np.full(thresholds, deviation)
