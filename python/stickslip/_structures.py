"""Modes of structures."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ._tables import Columns
from ._tabular import Tabular

if TYPE_CHECKING:
    from matplotlib.figure import Figure, FigureBase


@dataclass(frozen=True, eq=False)
class Modes(Tabular):
    """The modes of a structure on a fixed base, in order of frequency.

    Attributes
    ----------
    frequencies : ndarray, shape (n,)
        w [rad/s]; 0 for a rigid-body mode.
    damping_ratios : ndarray, shape (n,)
        Diagonal of the modal damping, divided by 2 w.
    participation : ndarray, shape (n,)
        shape' M influence [kg^(1/2)]; with `from_modes`, the square roots of the mass fractions.
    effective_masses : ndarray, shape (n,)
        participation squared [kg]; with `from_modes`, the mass fractions.
    shapes : ndarray, shape (floors, n)
        One column per mode, with shape' M shape = 1.

    Notes
    -----
    Objects compare by content. Tables have one row per mode, counted from 1: columns `mode`,
    `frequency` [rad/s], `period` [s], `damping_ratio`, `participation`, `effective_mass` and
    `cumulative_mass`, the fraction of the mass of all modes up to this one.
    """

    frequencies: NDArray[np.float64]
    damping_ratios: NDArray[np.float64]
    participation: NDArray[np.float64]
    effective_masses: NDArray[np.float64]
    shapes: NDArray[np.float64]
    _index = "mode"

    def __repr__(self) -> str:
        count = len(self.frequencies)
        first = f", first period {self.periods.max():.4g} s" if count else ""
        return f"<Modes: {count} mode{'' if count == 1 else 's'}{first}>"

    @property
    def periods(self) -> NDArray[np.float64]:
        """2 pi / w [s], shape (n,); infinite for a rigid-body mode."""
        with np.errstate(divide="ignore"):
            return 2 * np.pi / self.frequencies

    def _table(self) -> tuple[Columns, dict[str, str]]:
        mass = self.effective_masses
        columns = {
            "mode": np.arange(1, len(mass) + 1),
            "frequency": self.frequencies,
            "period": self.periods,
            "damping_ratio": self.damping_ratios,
            "participation": self.participation,
            "effective_mass": mass,
            "cumulative_mass": np.cumsum(mass) / np.sum(mass),
        }
        return columns, {"frequency": "rad/s", "period": "s"}

    def plot(self, *, figure: FigureBase | None = None, title: str | None = None) -> Figure:
        """Plot the shapes of the first modes by height.

        Parameters
        ----------
        figure : matplotlib Figure or SubFigure, optional
            Where to draw; default: a new figure.
        title : str, optional
            Default: none.

        Returns
        -------
        matplotlib Figure or SubFigure

        Raises
        ------
        ValueError
            The structure was made by `from_modes` without shapes.
        """
        from .plotting import plot_modes

        return plot_modes(self, figure, title)
