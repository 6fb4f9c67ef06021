"""Design charts: displacements against the coefficient of friction, for levels of intensity."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, SupportsIndex, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._core import Coulomb, GroundMotion
from .._tables import Columns
from .._tabular import Tabular, over
from ..motions.intensity import LEVEL_UNITS, level_of
from ..motions.suite import Suite
from ..runs.progress import Progress
from ..sweeps.parameter_grid import grid
from ..sweeps.run import sweep

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["DesignChart", "design_chart"]

Array = NDArray[np.float64]
Directions = Literal["axis", "rotd50", "rotd100"]
_STEP = 10  # degrees between the directions of a pair


@dataclass(kw_only=True, eq=False, repr=False)
class DesignChart(Tabular):
    """Percentiles of displacements over records, as `design_chart` returns them.

    Attributes
    ----------
    mu : ndarray, shape (M,)
        Coefficients of friction.
    measure : str
        The intensity measure, 'pga_g' [g] or 'pgv' [m/s].
    levels : ndarray, shape (L,)
        Its levels.
    percentiles : ndarray, shape (P,)
        [%].
    peak, residual : ndarray, shape (P, L, M)
        Percentiles over records, and polarities, of the peak and of the magnitude of the residual
        [m].
    directions : {'axis', 'rotd50', 'rotd100'}
        What each record contributes: its component along the axis, or the median or the maximum
        over all directions of the pair.
    """

    mu: Array
    measure: str
    levels: Array
    percentiles: Array
    peak: Array
    residual: Array
    directions: str

    def _table(self) -> tuple[Columns, Mapping[str, str]]:
        columns = over(
            {"percentile": self.percentiles},
            {self.measure: self.levels},
            {"mu": self.mu},
            peak=self.peak,
            residual=self.residual,
        )
        units = {"percentile": "%", self.measure: LEVEL_UNITS[self.measure]}
        return columns, {**units, "peak": "m", "residual": "m"}

    def __repr__(self) -> str:
        return (
            f"<DesignChart: {len(self.mu)} coefficients of friction, {len(self.levels)} levels of"
            f" {self.measure}, {self.directions}>"
        )

    @overload
    def plot(self, quantity: str = ..., *, ax: None = None, title: str | None = ...) -> Figure: ...
    @overload
    def plot(self, quantity: str = ..., *, ax: Axes, title: str | None = ...) -> Axes: ...
    def plot(
        self, quantity: str = "peak", *, ax: Axes | None = None, title: str | None = None
    ) -> Figure | Axes:
        """Plot the percentiles against the coefficient of friction, a color for each level.

        Parameters
        ----------
        quantity : {'peak', 'residual'}
        ax : matplotlib Axes, optional
            Where to draw; default: a new figure of 7 x 4.5 inches.
        title : str, optional
            Default: the quantity; below it, why lines end.

        Returns
        -------
        matplotlib Figure or Axes
            The axes if they were given, otherwise the new figure.

        Raises
        ------
        ValueError
            Another quantity; more than six levels.
        ImportError
            matplotlib is missing.
        """
        from ..plotting import plot_design_chart

        return plot_design_chart(self, quantity, ax=ax, title=title)


def design_chart(
    suite: Suite,
    mu: ArrayLike,
    *,
    pga_g: ArrayLike | None = None,
    pgv: ArrayLike | None = None,
    percentiles: ArrayLike = (16, 50, 84),
    directions: Directions = "axis",
    threads: SupportsIndex | None = None,
    progress: bool | Progress | None = None,
) -> DesignChart:
    """Slide blocks under records scaled to levels of PGA or PGV, for a design chart.

    Parameters
    ----------
    suite : Suite
        Records.
    mu : array_like, shape (M,)
        Coefficients of Coulomb friction.
    pga_g, pgv : array_like, shape (L,)
        Levels of PGA [g] or of PGV [m/s]; exactly one.
    percentiles : array_like, shape (P,), optional
        Over records and polarities, from 0 to 100.
    directions : {'axis', 'rotd50', 'rotd100'}
        'axis' slides along the axis of each record. The others slide along each horizontal
        direction of pairs, in steps of 10 degrees, and take the median or the maximum over the
        directions, of the displacement as of the measure to which a pair is scaled.
    threads, progress : optional
        As for `sweep`.

    Returns
    -------
    DesignChart

    Raises
    ------
    ValueError
        Not exactly one measure; a value out of range; a record without a transverse component where
        directions need one; a combination that fails.

    Notes
    -----
    Blocks slide until they come to rest. 18 records at 4 levels with 50 coefficients take 0.1 s.
    """
    targets = {"pga_g": pga_g, "pgv": pgv}
    given = {name: values for name, values in targets.items() if values is not None}
    if len(given) != 1:
        raise ValueError(
            f"design_chart: give pga_g or pgv, got {' and '.join(given) or 'none of them'}"
        )
    if directions not in ("axis", "rotd50", "rotd100"):
        raise ValueError(
            f"design_chart: directions must be 'axis', 'rotd50' or 'rotd100', got {directions!r}"
        )
    ((measure, values),) = given.items()
    levels = np.atleast_1d(np.asarray(values, float))
    shares = np.atleast_1d(np.asarray(percentiles, float))
    if not ((shares >= 0) & (shares <= 100)).all():
        raise ValueError(f"design_chart: percentiles must lie from 0 to 100, got {percentiles!r}")
    coefficients = np.atleast_1d(np.asarray(mu, float))
    blocks = grid(Coulomb, mu=coefficients)
    statistic = np.max if directions == "rotd100" else np.median
    if directions == "axis":
        stripes, turns = suite.stripes(pga_g=pga_g, pgv=pgv, directions="axis"), 1
    else:
        rotated = [_directions(motion) for motion in suite]
        turns = len(rotated[0])
        stripes = _rotated_stripes(rotated, measure, levels, statistic)
    table = sweep(blocks, stripes, settle=True, threads=threads, progress=progress)
    if table.failures:
        raise ValueError(f"design_chart: {table.failures[0].message}")

    def summary(quantity: Array) -> Array:
        """Percentiles over records and polarities, after the statistic over directions."""
        shape = (len(coefficients), len(levels), len(suite), turns, 2)
        each = statistic(np.abs(quantity).reshape(shape), axis=3)
        found: Array = np.percentile(each.reshape(*shape[:2], -1), shares, axis=2)
        return np.swapaxes(found, 1, 2)

    return DesignChart(
        mu=coefficients,
        measure=measure,
        levels=levels,
        percentiles=shares,
        peak=summary(table.peak),
        residual=summary(table.residual),
        directions=directions,
    )


def _directions(motion: GroundMotion) -> list[GroundMotion]:
    """A pair along all of its horizontal directions; opposite ones are its polarities."""
    if motion.transverse is None:
        raise ValueError(
            f"design_chart: '{motion.name}' has no transverse component, which directions need;"
            " Suite.read(..., stations=True) groups the components of stations"
        )
    return [motion.rotated(float(angle)) for angle in range(0, 180, _STEP)]


def _rotated_stripes(
    rotated: Sequence[Sequence[GroundMotion]], measure: str, levels: Array, statistic: Any
) -> Suite:
    """The directions of each pair, scaled by one factor to each level of the measure."""
    own = [float(statistic([level_of(one, measure) for one in turned])) for turned in rotated]
    for turned, value in zip(rotated, own):
        if not value > 0:
            raise ValueError(f"design_chart: the {measure} of '{turned[0].name}' is zero")
    return Suite(
        one.scaled(float(level) / value)
        for level in levels
        for turned, value in zip(rotated, own)
        for one in turned
    )
