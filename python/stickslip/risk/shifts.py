"""How far the fragility curve of each draw of the slider's parameters lies from the common one."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

__all__ = ["deviation_of_draws", "shifts"]

Array = NDArray[np.float64]


def shifts(
    start: Array, score: Callable[[Array], Array], information: Callable[[Array], Array]
) -> Array:
    """The shift of ln IM that is most likely for each draw, by Newton's method.

    Firth's penalty, half the logarithm of the information, keeps the shift of a draw finite in
    which all responses exceed a threshold, or none.

    Parameters
    ----------
    start : ndarray, shape (J,)
    score : callable
        From shifts to the derivative of the log-likelihood of each draw, shape (J,).
    information : callable
        From shifts to the expected information of each draw, shape (J,).
    """
    delta = start.copy()
    for _ in range(50):
        now = np.maximum(information(delta), 1e-12)
        above, below = (np.log(np.maximum(information(delta + h), 1e-12)) for h in (1e-4, -1e-4))
        penalty = 0.25 * (above - below) / 1e-4
        step = np.clip((score(delta) + penalty) / now, -0.3, 0.3)
        delta += step
        if np.abs(step).max() < 1e-8:
            break
    return delta


def deviation_of_draws(delta: Array, score: Array, information: Array) -> float:
    """Standard deviation of the shifts over draws, less the variance that is due to few records.

    All draws share the records, so the error of a shift that a record causes in all of them cancels
    in their differences; what remains is estimated from the influence of each record (the
    infinitesimal jackknife).

    Parameters
    ----------
    delta, information : ndarray, shape (J,)
    score : ndarray, shape (J, R)
        Derivative of the log-likelihood by the shift, at `delta`.
    """
    draws, records = score.shape
    if draws < 2:
        return 0.0
    influence = score / np.maximum(information, 1e-12)[:, np.newaxis]
    influence = influence - influence.mean(axis=1, keepdims=True)
    influence = influence - influence.mean(axis=0)
    sampling = (influence**2).sum() / (draws - 1)
    if records > 1:
        sampling *= records / (records - 1)
    return float(np.sqrt(max(delta.var(ddof=1) - sampling, 0.0)))
