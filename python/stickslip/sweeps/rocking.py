"""Rocking spectra: the peak rotation against the period of blocks."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._core import GroundMotion, SlenderBlock
from .._numbers import reals
from .._tables import Columns
from .._tabular import Tabular
from ..rocking.sweep import SIDES, sweep_blocks

if TYPE_CHECKING:
    from matplotlib.figure import Figure, FigureBase


class RockingSpectrum(Tabular):
    """Peak rotation of blocks of one slenderness, as `rocking_spectrum` returns it.

    Attributes
    ----------
    periods : ndarray, shape (P,)
        2 pi/p [s].
    peak_rotation_ratio : ndarray, shape (P,)
        Peak |theta|/alpha; infinite where the block overturns.
    overturned : ndarray of int, shape (P,)
        1 to the right, -1 to the left, 0 if the block stands.
    impacts : ndarray of int, shape (P,)
    alpha, restitution : float
    motion : GroundMotion
    """

    def __init__(
        self,
        motion: GroundMotion,
        alpha: float,
        restitution: float,
        periods: NDArray[np.float64],
        results: Mapping[str, NDArray[Any]],
    ) -> None:
        self.motion = motion
        self.alpha = alpha
        self.restitution = restitution
        self.periods = periods
        self.peak_rotation_ratio: NDArray[np.float64] = results["peak_rotation_ratio"]
        self.overturned: NDArray[np.int8] = results["overturned"]
        self.impacts: NDArray[np.int64] = results["impacts"]

    def plot(self, *, figure: FigureBase | None = None, title: str | None = None) -> Figure:
        """Plot peak |theta|/alpha over the period 2 pi/p; crosses are blocks that overturn.

        Parameters
        ----------
        figure : matplotlib Figure or SubFigure, optional
            Where to draw; default: a new figure.
        title : str, optional
            Default: the name of the ground motion.

        Returns
        -------
        matplotlib Figure or SubFigure
        """
        from ..plotting.rocking import plot_rocking_spectrum

        return plot_rocking_spectrum(self, figure, title)

    def _table(self) -> tuple[Columns, Mapping[str, str]]:
        columns = {
            "period": self.periods,
            "peak_rotation_ratio": self.peak_rotation_ratio,
            "overturned": SIDES[self.overturned + 1],
            "impacts": self.impacts,
        }
        return columns, {"period": "s"}

    def __repr__(self) -> str:
        fell = np.count_nonzero(self.overturned)
        return (
            f"<RockingSpectrum: alpha {self.alpha:g}, restitution {self.restitution:.4g},"
            f" {len(self.periods):,} periods; {fell:,} blocks overturn>"
        )


def rocking_spectrum(
    motion: GroundMotion,
    *,
    alpha: float,
    restitution: float | Literal["housner"] = "housner",
    periods: ArrayLike,
) -> RockingSpectrum:
    """Compute the peak rotations of slender blocks in one ground motion, against 2 pi/p.

    Makris and Konstantinidis (2003): blocks of one slenderness and restitution, of all sizes. Each
    is solved as by `integrate`, until it comes to rest or falls.

    Parameters
    ----------
    motion : GroundMotion
    alpha : float
        As for `SlenderBlock` [rad].
    restitution : float or 'housner', optional
        As for `SlenderBlock`; default: 'housner'.
    periods : array_like, shape (P,)
        2 pi/p [s], positive.

    Returns
    -------
    RockingSpectrum

    Raises
    ------
    ValueError
        A value out of range.
    """
    numbers = np.atleast_1d(reals(periods, "rocking_spectrum: periods"))
    if numbers.ndim != 1 or not (np.isfinite(numbers) & (numbers > 0)).all():
        raise ValueError(f"rocking_spectrum: periods must be positive and finite, got {periods!r}")
    blocks = [
        SlenderBlock(p=2 * np.pi / period, alpha=alpha, restitution=restitution)
        for period in numbers.tolist()
    ]
    table = sweep_blocks(blocks, {}, [motion], {}, None, ("recorded",), True, 0, None)
    results = {
        name: getattr(table, name)[:, 0, 0, 0]
        for name in ("peak_rotation_ratio", "overturned", "impacts")
    }
    return RockingSpectrum(motion, alpha, blocks[0].restitution, numbers, results)
