"""Many blocks under many ground motions and scales of them."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core
from .._core import GroundMotion, Interval, RockingBlock, SlenderBlock
from .._numbers import reals
from .._tables import Columns
from .._tabular import Tabular
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
BLOCKS = (SlenderBlock, RockingBlock)


def same_kind(these: Sequence[Any], who: str) -> None:
    """Raise TypeError unless all are blocks of the type of the first."""
    kind = type(these[0])
    for i, block in enumerate(these):
        if type(block) is not kind:
            raise TypeError(
                f"{who}: as the first is a {kind.__name__}, all must be;"
                f" number {i} is of type {type(block).__name__}"
            )


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


class RockingTable(Tabular):
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

    planar = False  # as of a SweepTable on one axis

    def __init__(
        self,
        *,
        blocks: Sequence[AnyBlock],
        parameters: Mapping[str, ArrayLike],
        motions: Sequence[GroundMotion],
        metadata: Mapping[str, ArrayLike],
        scale: ArrayLike,
        polarity: Sequence[str],
        settle: bool,
        results: Mapping[str, NDArray[Any]],
        failures: Sequence[RockingFailure] = (),
    ) -> None:
        self.blocks = tuple(blocks)
        self.parameters = {name: np.asarray(values) for name, values in parameters.items()}
        self.motions = tuple(motions)
        self.records = tuple(m.name or f"record {i}" for i, m in enumerate(motions))
        self.metadata = {name: np.asarray(values) for name, values in metadata.items()}
        self.scale: NDArray[np.float64] = np.asarray(scale, float)
        self.polarity = tuple(polarity)
        self.settle = bool(settle)
        self.failures = tuple(failures)
        self.peak_rotation: NDArray[np.float64] = results["peak_rotation"]
        self.peak_rotation_ratio: NDArray[np.float64] = results["peak_rotation_ratio"]
        self.overturned: NDArray[np.int8] = results["overturned"]
        self.overturned_at: NDArray[np.float64] = results["overturned_at"]
        self.impacts: NDArray[np.int64] = results["impacts"]
        self.margin: NDArray[np.float64] = results["margin"]
        self.condition: NDArray[np.float64] = results["condition"]
        none = np.zeros(self.peak_rotation.shape)
        self.residual: NDArray[np.float64] = results.get("residual", none)
        self.sliding_distance: NDArray[np.float64] = results.get("sliding_distance", none)

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
        shape = self.peak_rotation.shape

        def along(values: Any, axis: int) -> NDArray[Any]:
            at = [1] * len(shape)
            at[axis] = -1
            return np.broadcast_to(np.asarray(values).reshape(at), shape).ravel()

        columns = {"block": along([repr(block) for block in self.blocks], 0)}
        columns |= {name: along(values, 0) for name, values in self.parameters.items()}
        columns["record"] = along(self.records, 1)
        columns |= {name: along(values, 1) for name, values in self.metadata.items()}
        columns |= {"scale": along(self.scale, 2), "polarity": along(self.polarity, 3)}
        names = results_of(self.blocks)
        columns |= {name: getattr(self, name).ravel() for name in names}
        columns["overturned"] = SIDES[columns["overturned"] + 1]
        return columns, {name: UNITS[name] for name in names if name in UNITS}

    def __repr__(self) -> str:
        fell = np.count_nonzero(self.overturned)
        return (
            f"<RockingTable: {len(self.blocks):,} blocks, {len(self.records):,} records,"
            f" {len(self.scale):,} scales, {' and '.join(self.polarity)};"
            f" {fell:,} of {self.overturned.size:,} overturn>"
        )


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
    scales = np.atleast_1d(reals(1.0 if scale is None else scale, "sweep: scale"))
    if scales.ndim != 1 or not scales.size or not (np.isfinite(scales) & (scales >= 0)).all():
        raise ValueError(f"sweep: scale must hold finite numbers of at least 0, got {scale!r}")
    signs = [1.0 if name == "recorded" else -1.0 for name in polarity]
    shape = (len(blocks), len(motions), scales.size, len(signs))
    found = _core.sweep_blocks(
        blocks,
        motions,
        scales=np.multiply.outer(scales, signs).ravel().tolist(),
        settle=settle,
        threads=threads,
        progress=show,
    )
    failures = []
    for place, message in found.pop("failures"):
        block, record, k, sign = map(int, np.unravel_index(place, shape))
        failures.append(RockingFailure(block, record, float(scales[k]), polarity[sign], message))
    table = RockingTable(
        blocks=blocks,
        parameters=parameters,
        motions=motions,
        metadata=metadata,
        scale=scales,
        polarity=polarity,
        settle=settle,
        results={name: values.reshape(shape) for name, values in found.items()},
        failures=failures,
    )
    if failures:
        first = failures[0]
        warnings.warn(
            f"sweep: {len(failures)} of {table.overturned.size} combinations failed and are NaN;"
            f" the first, block {first.block} under record {first.record} {first.polarity} at scale"
            f" {first.scale:g}: {first.message}",
            RuntimeWarning,
            stacklevel=3,
        )
    return table
