"""The members of a random run of carts: how far they go, and whether they reach a wall."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from .. import _core
from .._core import Cart, Interval
from .._numbers import real
from .._tables import Columns
from ..runs.outcomes import OutcomeEnsemble, run_outcomes
from ..runs.progress import Progress
from .sweep import Walls, columns_of

Peak = Literal["peak", "peak_yaw", "peak_outline"]


class CartEnsemble(OutcomeEnsemble):
    """What the members of a random run of carts did, as `run_ensemble` returns it.

    Histories of carts hang on the headings of their casters: these distributions are the answer.

    Attributes
    ----------
    peak, peak_yaw, peak_outline : ndarray, shape (M,)
        As of `CartResponse` [m], [rad], [m].
    residual : ndarray, shape (M, 2)
        Displacement at the end [m].
    residual_yaw : ndarray, shape (M,)
        Change of the yaw at the end [rad].
    rests : ndarray of int, shape (M,)
    margin : ndarray, shape (M,)
        As of `CartResponse`.
    clearance, hit_time, hit_speed : ndarray, shape (M, W)
        As of `Clearance`, for each of W walls [m], [s], [m/s]; NaN without a hit.
    seed, first_member : int
    carts : tuple of Cart
        Member i has cart i modulo their number.
    walls : tuple
    configuration : str
        Of the ground motions.
    duration : float or None
        Of the ground motions [s]; None if they differ.

    Notes
    -----
    Objects compare by content; they can be copied and pickled. Tables have a row for each member.
    """

    _kind = "cart"

    carts: tuple[Cart, ...]
    walls: Walls
    peak: NDArray[np.float64]
    peak_yaw: NDArray[np.float64]
    peak_outline: NDArray[np.float64]
    residual: NDArray[np.float64]
    residual_yaw: NDArray[np.float64]
    rests: NDArray[np.int64]
    clearance: NDArray[np.float64]
    hit_time: NDArray[np.float64]
    hit_speed: NDArray[np.float64]

    def quantile(
        self, probability: float, *, of: Peak = "peak_outline", confidence: float = 0.95
    ) -> Interval:
        """Quantile of the peaks: the value that a fraction of the members does not exceed.

        Parameters
        ----------
        probability : float
            The fraction, between 0 and 1.
        of : {'peak_outline', 'peak', 'peak_yaw'}, optional
        confidence : float, optional
            Of the bounds, which are order statistics, between 0 and 1.

        Returns
        -------
        Interval
            [m], or [rad] of 'peak_yaw'.

        Raises
        ------
        ValueError
            A value out of range; fewer than two members.
        """
        return _core._quantile(self._peaks(of), probability, confidence)

    def exceedance(
        self, level: float, *, of: Peak = "peak_outline", confidence: float = 0.95
    ) -> Interval:
        """The fraction of members whose peak exceeds a level.

        Parameters
        ----------
        level : float
            At least 0 [m], or [rad] of 'peak_yaw'.
        of : {'peak_outline', 'peak', 'peak_yaw'}, optional
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
        limit = real(level, "CartEnsemble.exceedance: level")
        if not limit >= 0:
            raise ValueError(f"CartEnsemble.exceedance: level must be at least 0, got {limit}")
        count = int(np.count_nonzero(self._peaks(of) > limit))
        return _core._binomial_interval(count, self.members, confidence)

    def hitting(self, wall: int = 0, *, confidence: float = 0.95) -> Interval:
        """The fraction of members whose outline reaches a wall.

        Parameters
        ----------
        wall : int, optional
            Its place in `walls`; default: the first.
        confidence : float, optional
            Of the bounds of Clopper and Pearson (1934), between 0 and 1.

        Returns
        -------
        Interval

        Raises
        ------
        IndexError
            A wall that the run did not have.
        ValueError
            A confidence out of range.
        """
        if not -len(self.walls) <= wall < len(self.walls):
            raise IndexError(
                f"CartEnsemble.hitting: there is no wall {wall}: the run had {len(self.walls)}"
            )
        count = int(np.count_nonzero(self.clearance[:, wall] <= 0))
        return _core._binomial_interval(count, self.members, confidence)

    def _peaks(self, of: str) -> NDArray[np.float64]:
        if of not in ("peak_outline", "peak", "peak_yaw"):
            raise ValueError(
                f"CartEnsemble: of must be 'peak_outline', 'peak' or 'peak_yaw', got {of!r}"
            )
        peaks: NDArray[np.float64] = getattr(self, of)
        return peaks

    def _table(self) -> tuple[Columns, Mapping[str, str]]:
        columns, units = columns_of(self)
        return {"member": self.first_member + np.arange(self.members), **columns}, units

    def __repr__(self) -> str:
        half = np.median(self.peak_outline)
        text = f"<CartEnsemble: {self.members:,} members; median peak of the outline {half:.3g} m"
        for i in range(len(self.walls)):
            text += f"; wall {i} is reached by {np.count_nonzero(self.clearance[:, i] <= 0):,}"
        return text + ">"


def run_carts(
    carts: Any,
    motions: Any,
    *,
    members: int,
    first_member: int,
    seed: int,
    settle: bool,
    walls: Walls | None,
    threads: int,
    show: Progress | None,
) -> CartEnsemble:
    """The ensemble of carts; see `stickslip.run_ensemble`."""
    ensemble = run_outcomes(
        CartEnsemble,
        _core.run_carts,
        carts,
        (Cart,),
        motions,
        members=members,
        first_member=first_member,
        seed=seed,
        settle=settle,
        walls=walls or (),
        threads=threads,
        progress=show,
    )
    ensemble.walls = tuple(walls or ())
    return ensemble
