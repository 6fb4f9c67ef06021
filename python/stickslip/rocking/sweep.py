"""Many blocks under many ground motions and scales of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core
from .._core import GroundMotion, Interval, RockingBlock, SlenderBlock
from .._tables import Columns
from ..runs.outcomes import OutcomeTable, sweep_outcomes
from ..runs.progress import Progress

SIDES = np.array(["left", "", "right"])  # of -1, 0, 1
RESULTS = ("peak_rotation", "peak_rotation_ratio", "overturned", "overturned_at", "impacts")
OF_RIGID = ("residual", "sliding_distance")
UNITS = {
    "peak_rotation": "rad",
    "overturned_at": "s",
    "residual": "m",
    "sliding_distance": "m",
}
AnyBlock: TypeAlias = "SlenderBlock | RockingBlock"


def results_of(blocks: Sequence[AnyBlock]) -> tuple[str, ...]:
    """The columns of results."""
    rigid = isinstance(blocks[0], RockingBlock)
    return (*RESULTS, *(OF_RIGID if rigid else ()), "margin")


class RockingFailure(NamedTuple):
    """A combination without a result, and why."""

    block: int
    record: int
    scale: float
    polarity: str
    message: str


class RockingTable(OutcomeTable):
    """What many blocks did under many ground motions, as `sweep` returns it.

    Arrays have the shape (blocks, records, scales, polarities). Where a combination failed, peaks
    are NaN and counts 0.

    Attributes
    ----------
    peak_rotation : ndarray
        Largest |theta| over all time [rad]; pi/2 if the block overturned.
    peak_rotation_ratio : ndarray
        The same over alpha; infinite if the block overturned.
    overturned : ndarray of int
        1 to the right, -1 to the left, 0 if the block stands.
    overturned_at : ndarray
        Time from which the overturning is certain [s]; NaN if the block stands.
    impacts : ndarray of int
        As of `RockingResponse`.
    margin, condition : ndarray
        As of `RockingResponse`.
    residual, sliding_distance : ndarray
        As of `RockingResponse` [m]; 0 for a `SlenderBlock`.
    blocks : tuple of SlenderBlock or of RockingBlock
    parameters : dict of ndarray
        By name, the parameters that `grid` varied or that were drawn, for each block.
    records : tuple of str
        Names of the ground motions.
    metadata : dict of ndarray
        Columns of the suite, with a value for each record.
    scale : ndarray
        Factors of the ground motions.
    polarity : tuple of str
        'recorded', under n(t), and 'reversed', under -n(t), or one of them.
    motions : tuple of GroundMotion
        The ground motions.
    settle : bool
        Whether each run continued until the block came to rest or fell.
    failures : tuple of RockingFailure

    Notes
    -----
    Objects compare by content; they can be copied and pickled. Tables have a row for each
    combination: `block` and its parameters, `record` and its metadata, `scale`, `polarity`, and the
    results; `overturned` is 'right', 'left' or empty there.
    """

    _kind = "block"
    _failure = RockingFailure

    blocks: tuple[AnyBlock, ...]
    peak_rotation: NDArray[np.float64]
    peak_rotation_ratio: NDArray[np.float64]
    overturned: NDArray[np.int8]
    overturned_at: NDArray[np.float64]
    impacts: NDArray[np.int64]
    margin: NDArray[np.float64]
    condition: NDArray[np.float64]
    residual: NDArray[np.float64]
    sliding_distance: NDArray[np.float64]

    def overturning(self, *, block: int = 0, confidence: float = 0.95) -> list[Interval]:
        """The fraction of records and polarities under which a block overturns, at each scale.

        Parameters
        ----------
        block : int, optional
            Its place in `blocks`; default: the first.
        confidence : float, optional
            Of the bounds of Clopper and Pearson (1934), between 0 and 1. They hold for records that
            are independent: both polarities of one record are not quite so.

        Returns
        -------
        list of Interval
            One for each of `scale`, of the combinations that did not fail. The fractions need not
            increase with the scale.

        Raises
        ------
        ValueError
            A confidence out of range; all combinations of a scale failed.
        """
        found = []
        for k in range(len(self.scale)):
            known = np.isfinite(self.peak_rotation[block, :, k])
            fell = int(np.count_nonzero(self.overturned[block, :, k][known]))
            found.append(_core._binomial_interval(fell, int(known.sum()), confidence))
        return found

    def _table(self) -> tuple[Columns, Mapping[str, str]]:
        columns = self._axes()
        names = results_of(self.blocks)
        columns |= {name: getattr(self, name).ravel() for name in names}
        columns["overturned"] = SIDES[columns["overturned"] + 1]
        return columns, {name: UNITS[name] for name in names if name in UNITS}

    def __repr__(self) -> str:
        fell = np.count_nonzero(self.overturned)
        return f"<RockingTable: {self._size()}; {fell:,} of {self.overturned.size:,} overturn>"


def sweep_blocks(
    blocks: Sequence[AnyBlock],
    parameters: Mapping[str, ArrayLike],
    motions: Sequence[GroundMotion],
    metadata: Mapping[str, ArrayLike],
    scale: ArrayLike | None,
    polarity: Sequence[str],
    settle: bool,
    threads: int,
    show: Progress | None,
) -> RockingTable:
    """The table of blocks; see `stickslip.sweep`."""
    return sweep_outcomes(
        RockingTable,
        _core.sweep_blocks,
        blocks,
        parameters,
        motions,
        metadata,
        scale,
        polarity,
        settle,
        threads=threads,
        progress=show,
    )
