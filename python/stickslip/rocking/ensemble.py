"""The members of a random run of blocks: probabilities of overturning, with bounds."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core
from .._core import Interval
from .._numbers import real, reals
from .._tables import Columns
from ..runs.outcomes import BLOCKS, OutcomeEnsemble, run_outcomes
from ..runs.progress import Progress
from .sweep import SIDES, UNITS, AnyBlock, results_of


class RockingEnsemble(OutcomeEnsemble):
    """What the members of a random run of blocks did, as `run_ensemble` returns it.

    A single history may be chaotic; these probabilities are the answer, and
    `stickslip.plotting.plot_overturning` draws them.

    Attributes
    ----------
    peak_rotation : ndarray, shape (M,)
        Largest |theta| of each member over all time [rad]; pi/2 if it overturned.
    peak_rotation_ratio : ndarray, shape (M,)
        The same over alpha; infinite if it overturned.
    overturned : ndarray of int, shape (M,)
        1 to the right, -1 to the left, 0 if the member stands.
    overturned_at : ndarray, shape (M,)
        Time from which the overturning is certain [s]; NaN if the member stands.
    impacts : ndarray of int, shape (M,)
        As of `RockingResponse`.
    margin, condition : ndarray, shape (M,)
        As of `RockingResponse`.
    seed, first_member : int
    residual, sliding_distance : ndarray, shape (M,)
        As of `RockingResponse` [m]; 0 for a `SlenderBlock`.
    blocks : tuple of SlenderBlock or of RockingBlock
        Member i has block i modulo their number.
    configuration : str
        Of the ground motions.
    duration : float or None
        Of the ground motions [s]; None if they differ.

    Notes
    -----
    Objects compare by content; they can be copied and pickled. Tables have a row for each member;
    `overturned` is 'right', 'left' or empty there.
    """

    _kind = "block"

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

    @overload
    def overturning(self, times: None = None, *, confidence: float = 0.95) -> Interval: ...
    @overload
    def overturning(self, times: ArrayLike, *, confidence: float = 0.95) -> list[Interval]: ...
    def overturning(
        self, times: ArrayLike | None = None, *, confidence: float = 0.95
    ) -> Interval | list[Interval]:
        """The fraction of members that overturn, with the bounds of Clopper and Pearson (1934).

        Parameters
        ----------
        times : array_like, shape (T,), optional
            Times [s] up to which an overturning counts once it is certain. Default: all, also those
            that become certain after the end of the ground motion.
        confidence : float, optional
            Of the bounds, between 0 and 1.

        Returns
        -------
        Interval or list of Interval
            One for each of `times`.

        Raises
        ------
        ValueError
            A confidence out of range; a time that is NaN.
        """
        level = real(confidence, "RockingEnsemble.overturning: confidence")
        if times is None:
            fell = int(np.count_nonzero(self.overturned))
            return _core._binomial_interval(fell, self.members, level)
        at = np.atleast_1d(reals(times, "RockingEnsemble.overturning: times"))
        if np.isnan(at).any():
            raise ValueError("RockingEnsemble.overturning: times must be numbers, got nan")
        when = np.sort(self.overturned_at[self.overturned != 0])
        counts = np.searchsorted(when, at, "right").tolist()
        return [_core._binomial_interval(count, self.members, level) for count in counts]

    def exceedance(self, ratio: float, *, confidence: float = 0.95) -> Interval:
        """The fraction of members whose peak |theta|/alpha exceeds a ratio, or that overturn.

        Parameters
        ----------
        ratio : float
            At least 0.
        confidence : float, optional
            Of the bounds of Clopper and Pearson (1934), between 0 and 1.

        Returns
        -------
        Interval

        Raises
        ------
        ValueError
            A value out of range.
        """
        level = real(ratio, "RockingEnsemble.exceedance: ratio")
        if not level >= 0:
            raise ValueError(f"RockingEnsemble.exceedance: ratio must be at least 0, got {level}")
        count = int(np.count_nonzero(self.peak_rotation_ratio > level))
        return _core._binomial_interval(count, self.members, confidence)

    @property
    def standing_peak_ratio(self) -> NDArray[np.float64]:
        """Peak |theta|/alpha of the members that stand: statistics of it leave out the others."""
        return self.peak_rotation_ratio[self.overturned == 0]

    def _table(self) -> tuple[Columns, Mapping[str, str]]:
        names = results_of(self.blocks)
        columns: dict[str, NDArray[Any]] = {
            "member": self.first_member + np.arange(self.members),
            **{name: getattr(self, name) for name in names},
        }
        columns["overturned"] = SIDES[columns["overturned"] + 1]
        return columns, {name: UNITS[name] for name in names if name in UNITS}

    def __repr__(self) -> str:
        fell = int(np.count_nonzero(self.overturned))
        text = f"<RockingEnsemble: {self.members:,} members, {fell:,} overturn"
        if fell < self.members:
            median = float(np.median(self.standing_peak_ratio))
            text += f"; median peak of the others {median:.3g} alpha"
        return text + ">"


def run_blocks(
    blocks: Any,
    motions: Any,
    *,
    members: int,
    first_member: int,
    seed: int,
    settle: bool,
    threads: int,
    show: Progress | None,
) -> RockingEnsemble:
    """The ensemble of blocks; see `stickslip.run_ensemble`."""
    return run_outcomes(
        RockingEnsemble,
        _core.run_blocks,
        blocks,
        BLOCKS,
        motions,
        members=members,
        first_member=first_member,
        seed=seed,
        settle=settle,
        threads=threads,
        progress=show,
    )
