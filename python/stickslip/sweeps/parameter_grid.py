"""Sliders on a grid of parameters."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable, Mapping
from typing import Any, TypeAlias, TypeVar

import numpy as np

from .._core import (
    EquipmentOnFloor,
    FlexibleSlope,
    IsolatedStructure,
    PlanarSlider,
    RockingBlock,
    SlenderBlock,
)
from ..ensemble.sources import AnySlider

AnySwept: TypeAlias = (
    "AnySlider | PlanarSlider | IsolatedStructure | EquipmentOnFloor | FlexibleSlope"
)
S = TypeVar("S", bound="AnySwept | SlenderBlock | RockingBlock")


class Grid(list[S]):
    """A list of sliders that knows the parameters of each.

    Attributes
    ----------
    parameters : dict of list
        By name, for each parameter that varies, its values for all sliders.
    """

    def __init__(
        self, sliders: Iterable[S], parameters: Mapping[str, list[Any]] | None = None
    ) -> None:
        super().__init__(sliders)
        self.parameters = {name: list(values) for name, values in (parameters or {}).items()}

    def __reduce__(self) -> tuple[Any, ...]:
        return Grid, (list(self), self.parameters)


def grid(kind: Callable[..., S], /, **parameters: Any) -> Grid[S]:
    """Make sliders with every combination of parameters.

    Parameters
    ----------
    kind : callable
        Makes a slider, a law, a structure or a block from keyword arguments: `Coulomb`, `Slider`,
        `PlanarSlider`, `FlexibleSlope`, `SlenderBlock.from_size`, or your own function.
    **parameters
        A list, tuple, range or array varies; any other value is the same for all sliders. A `Grid`
        of laws varies too, and adds its own parameters. The last parameter varies fastest.

    Returns
    -------
    Grid
        A list of the sliders.

    Raises
    ------
    ValueError
        A parameter without values; arguments that `kind` rejects (names their values).

    Examples
    --------
    >>> import stickslip as ss
    >>> len(ss.grid(ss.Coulomb, mu=[0.1, 0.2, 0.3]))
    3
    >>> floors = ss.grid(ss.Slider, law=ss.grid(ss.Coulomb, mu=[0.05, 0.1]), period=[2, 3, 4])
    >>> floors.parameters["period"]
    [2, 3, 4, 2, 3, 4]
    """
    if not callable(kind):
        raise TypeError(f"grid: kind must be callable, such as Coulomb, got {kind!r}")
    axes: list[list[tuple[dict[str, Any], dict[str, Any]]]] = []  # arguments, parameters to record
    for name, value in parameters.items():
        if isinstance(value, Grid):
            columns = value.parameters
            axis = [
                ({name: item}, {key: column[i] for key, column in columns.items()})
                for i, item in enumerate(value)
            ]
        elif isinstance(value, (list, tuple, range)) or np.ndim(value) == 1:
            plain = value.tolist() if isinstance(value, np.ndarray) else list(value)
            axis = [({name: item}, {name: item}) for item in plain]
        else:
            axis = [({name: value}, {})]
        if not axis:
            raise ValueError(f"grid: {name} must have at least one value, got {value!r}")
        axes.append(axis)
    sliders, rows = [], []
    for chosen in itertools.product(*axes):
        arguments = {k: v for given, _ in chosen for k, v in given.items()}
        try:
            sliders.append(kind(**arguments))
        except ValueError as error:
            raise ValueError(f"grid: with {arguments}: {error}") from error
        rows.append({k: v for _, shown in chosen for k, v in shown.items()})
    return Grid(sliders, {name: [row[name] for row in rows] for name in rows[0]})
