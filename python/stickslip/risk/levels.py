"""Levels of intensity: values that several ground motions share, as those of a stripe do."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._optional import optional
from .observations import Observations

__all__ = ["Levels"]

Array = NDArray[np.float64]


class Levels:
    """The different intensities of some ground motions, and sums over their motions.

    Attributes
    ----------
    x : ndarray, shape (L,)
        ln IM of each level, increasing.
    place : ndarray of int, shape (M,)
        The level of each motion.
    records : int
        Number of records.
    """

    def __init__(self, data: Observations) -> None:
        values, place = np.unique(data.im, return_inverse=True)
        self.x: Array = np.log(values)
        self.place: NDArray[np.intp] = place.reshape(-1)
        self.record = data.record
        self.records = int(data.record.max()) + 1

    def table(self, of_motions: Array) -> Any:
        """A sparse matrix of records and levels from values of the motions, shape (M,)."""
        sparse = optional("scipy.sparse", "risk", "Fragility.fit")
        shape = (self.records, len(self.x))
        return sparse.csr_matrix((of_motions, (self.record, self.place)), shape=shape)

    def by_level(self, of_motions: Array) -> Array:
        """Sums over the motions of each level, shape (..., M) to (..., L)."""
        return _sums(of_motions, self.place, len(self.x))

    def by_record(self, of_motions: Array) -> Array:
        """Sums over the motions of each record, shape (..., M) to (..., R)."""
        return _sums(of_motions, self.record, self.records)


def _sums(values: Array, groups: NDArray[np.intp], count: int) -> Array:
    result = np.zeros((*values.shape[:-1], count))
    np.add.at(np.moveaxis(result, -1, 0), groups, np.moveaxis(values, -1, 0))
    return result
