"""Which intensity measure predicts displacements with the smallest scatter."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from .._numbers import real
from .._tables import Columns
from .._tabular import Tabular
from .cloud import Cloud
from .observations import DemandTable, Measure, observe

__all__ = ["IntensityEfficiency", "intensity_efficiency"]


class IntensityEfficiency(Tabular):
    """The scatter of displacements about each intensity measure; see `intensity_efficiency`.

    The row of the smallest `sigma` is the first.

    Attributes
    ----------
    measure : tuple of str
        Names; pseudo-accelerations with their period, such as 'sa_g(1 s)'.
    sigma : ndarray, shape (N,)
        Standard deviation of ln D about a + b ln IM: small for an efficient measure.
    slope : ndarray, shape (N,)
        b.
    beta : ndarray, shape (N,)
        sigma/b, the scatter in terms of ln IM, by which fragility curves rise.
    """

    def __init__(
        self,
        measure: Sequence[str],
        sigma: NDArray[np.float64],
        slope: NDArray[np.float64],
    ) -> None:
        order = np.argsort(sigma, kind="stable")
        self.measure = tuple(measure[i] for i in order)
        self.sigma, self.slope = sigma[order], slope[order]
        with np.errstate(divide="ignore"):
            self.beta = np.where(self.slope > 0, self.sigma / self.slope, np.inf)

    def _table(self) -> tuple[Columns, Mapping[str, str]]:
        numbers = {name: getattr(self, name) for name in ("sigma", "slope", "beta")}
        return {"measure": np.array(self.measure), **numbers}, {}

    def __repr__(self) -> str:
        rows = ", ".join(f"{m}: {s:.2f}" for m, s in zip(self.measure, self.sigma))
        return f"<IntensityEfficiency: sigma of ln D, {rows}>"


def intensity_efficiency(
    table: DemandTable,
    measures: Sequence[Measure] = ("pga_g", "pgv", "arias", "cav"),
    *,
    periods: Sequence[float] = (0.3, 1.0, 2.0),
    quantity: str = "peak",
    censored_below: float = 1e-4,
) -> IntensityEfficiency:
    """Compare intensity measures by the scatter of the displacements about them.

    ln D = a + b ln IM + e is fitted to the responses that slide, as `Fragility.fit` does under
    'cloud': displacements below a stated one are left-censored.

    Parameters
    ----------
    table : SweepTable, RockingTable or CartTable
        Responses of one slider, or of draws of a random one, to ground motions of different
        intensities: a suite as it is, or stripes.
    measures : list of str or callable, optional
        As `im` of `Fragility.fit`.
    periods : list of float, optional
        Periods of pseudo-accelerations at 5 % damping [s], which are compared, too.
    quantity, censored_below : optional
        As for `Fragility.fit`.

    Returns
    -------
    IntensityEfficiency
        A table, sorted by scatter.

    Raises
    ------
    ValueError
        As `Fragility.fit` does; periods for a table from a file, which lacks the ground motions.

    Examples
    --------
    >>> import stickslip as ss
    >>> table = ss.sweep(ss.Coulomb(mu=0.1), ss.sample_records(), settle=True)
    >>> ss.intensity_efficiency(table).measure[0]
    'pgv'
    """
    names: list[str] = []
    sigma: list[float] = []
    slope: list[float] = []

    who = "intensity_efficiency"

    def add(im: Measure, name: str | None = None) -> None:
        data = observe(table, im, 2 * censored_below, quantity, who)
        try:
            found = Cloud(data, censored_below).regression()
        except ValueError as error:
            text = (
                str(error)
                .replace("Fragility.fit: method='cloud'", who)
                .replace("Fragility.fit", who)
            )
            raise ValueError(text) from None
        names.append(name or data.im_name)
        sigma.append(found["sigma"])
        slope.append(found["b"])

    for im in measures:
        add(im)
    for period in periods:
        add(f"sa({real(period, 'intensity_efficiency: periods')!r})", f"sa_g({period:g} s)")
    return IntensityEfficiency(names, np.array(sigma), np.array(slope))
