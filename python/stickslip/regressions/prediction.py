"""What a regression predicts: a distribution of the displacement."""

from __future__ import annotations

import math
from collections.abc import Mapping
from statistics import NormalDist
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._tabular import Tabular
from .arguments import UNITS

__all__ = ["Prediction", "normal_cdf"]

_inverse = np.frompyfunc(NormalDist().inv_cdf, 1, 1)
_erfc = np.frompyfunc(math.erfc, 1, 1)


def normal_cdf(x: ArrayLike) -> NDArray[np.float64]:
    """Standard normal distribution function, accurate in both tails."""
    return np.asarray(0.5 * _erfc(-np.asarray(x) / math.sqrt(2)), float)


class Prediction(Tabular):
    """A displacement as a regression predicts it: zero, or lognormal.

    With probability `p_zero` the displacement is zero. Otherwise ln D is normal, with the mean
    ln(median) and the standard deviation `sigma`. Attributes are numbers if all arguments are, else
    arrays of their common shape.

    Attributes
    ----------
    model : str
        Name of the regression, with the equation or form.
    arguments : dict
        The arguments of the prediction, in the units of the papers; those that `of` took from a
        record, too.
    median : float or ndarray
        Median of D [m] if D > 0; 0 where `p_zero` is 1.
    p_zero : float or ndarray
        Probability of D = 0, or of less than the model's own limit, which its page states. Models
        that do not distinguish give 0 where the ground acceleration exceeds the yield acceleration,
        and 1 where it does not.
    """

    def __init__(
        self,
        model: str,
        arguments: Mapping[str, Any],
        median: Any,
        p_zero: Any,
        sigma: Any,
    ) -> None:
        self.model = model
        self.arguments = dict(arguments)
        self.median = _number(median)
        self.p_zero = _number(p_zero)
        self._sigma = None if sigma is None else _number(sigma)

    @property
    def sigma(self) -> Any:
        """Standard deviation of ln D if D > 0.

        Raises
        ------
        ValueError
            The sources that we have seen give none for this form of the model.
        """
        if self._sigma is None:
            raise ValueError(
                f"{self.model}: no source that we have seen gives a sigma for this form"
            )
        return self._sigma

    def quantile(self, p: ArrayLike) -> Any:
        """Quantiles of the displacement, those of the whole distribution, zero included.

        D_p = 0 for p <= p_zero, else median exp(sigma Phi^-1((p - p_zero) / (1 - p_zero))).

        Parameters
        ----------
        p : float or array_like
            Above 0 and below 1.

        Returns
        -------
        float or ndarray
            [m]; the shape of `p`, followed by that of the prediction.

        Raises
        ------
        ValueError
            A p out of range; a form of a model whose sigma is not known.
        """
        wanted = np.asarray(p, float)
        wrong = ~((wanted > 0) & (wanted < 1))
        if wrong.any():
            raise ValueError(
                f"Prediction.quantile: p must be above 0 and below 1, got {wanted[wrong].flat[0]}"
            )
        sigma, p_zero = np.asarray(self.sigma), np.asarray(self.p_zero)
        wanted = wanted.reshape(wanted.shape + (1,) * p_zero.ndim)
        slides = wanted > p_zero
        of_slides = np.where(slides, wanted - p_zero, 0.5) / np.where(slides, 1 - p_zero, 1.0)
        deviates = np.asarray(_inverse(of_slides), float)
        return _number(np.where(slides, self.median * np.exp(sigma * deviates), 0.0))

    def exceedance(self, displacement: ArrayLike) -> Any:
        """Probability that the displacement exceeds a threshold, zero included.

        Parameters
        ----------
        displacement : float or array_like
            Thresholds [m], positive.

        Returns
        -------
        float or ndarray
            The shape of `displacement`, followed by that of the prediction.

        Raises
        ------
        ValueError
            A threshold that is not positive; a form of a model whose sigma is not known.
        """
        limit = np.asarray(displacement, float)
        wrong = ~((limit > 0) & np.isfinite(limit))
        if wrong.any():
            raise ValueError(
                "Prediction.exceedance: displacement must be positive and finite, got"
                f" {limit[wrong].flat[0]} m"
            )
        sigma, median = np.asarray(self.sigma), np.asarray(self.median)
        limit = limit.reshape(limit.shape + (1,) * median.ndim)
        slides = median > 0
        above = normal_cdf(np.log(np.where(slides, median, 1.0) / limit) / sigma)
        return _number(np.where(slides, (1 - np.asarray(self.p_zero)) * above, 0.0))

    def __repr__(self) -> str:
        sigma = "unknown" if self._sigma is None else _shown(self._sigma)
        values = "" if np.ndim(self.median) == 0 else f" of {np.size(self.median):,} values"
        return (
            f"<Prediction{values}, {self.model}: median {_shown(self.median)} m,"
            f" p_zero {_shown(self.p_zero)}, sigma {sigma} (ln)>"
        )

    def _table(self) -> tuple[Mapping[str, NDArray[Any]], Mapping[str, str]]:
        columns = {**self.arguments, "median": self.median, "p_zero": self.p_zero}
        if self._sigma is not None:
            columns["sigma"] = self._sigma
        spread = np.broadcast_arrays(*(np.asarray(value) for value in columns.values()))
        units = {**UNITS, "median": "m"}
        return dict(zip(columns, (column.ravel() for column in spread))), units


def _number(value: Any) -> Any:
    """A float instead of an array without dimensions."""
    return float(value) if np.ndim(value) == 0 else np.asarray(value, float)


def _shown(value: Any) -> str:
    if np.ndim(value) == 0 or np.size(value) == 0 or np.ptp(value) == 0:
        return f"{np.ravel(value)[0]:.4g}" if np.size(value) else "none"
    return f"{np.min(value):.4g} to {np.max(value):.4g}"
