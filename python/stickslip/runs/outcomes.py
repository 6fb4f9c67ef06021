"""Outcomes of many runs of systems other than sliders: blocks that rock, and carts."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping, Sequence
from typing import Any, ClassVar, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._core import Cart, Drawn, GroundMotion, RockingBlock, SlenderBlock
from .._numbers import reals
from .._tabular import Tabular

BLOCKS = (SlenderBlock, RockingBlock)
SYSTEMS = (*BLOCKS, Cart)
E = TypeVar("E", bound="OutcomeEnsemble")
T = TypeVar("T", bound="OutcomeTable")


def first_of(given: Any, seed: int = 0, member: int = 0) -> Any:
    """The first system of what a run takes as sliders."""
    if hasattr(given, "draw"):  # a Random
        return given.sample(seed=seed, member=member)
    if isinstance(given, Sequence) and len(given):
        return given[0]
    if isinstance(given, Drawn) and isinstance(given.items[0], SYSTEMS):
        raise TypeError(
            "run_ensemble: Drawn covers sliders; give blocks or carts as a list or a Random"
        )
    return given


def same_kind(these: Sequence[Any], who: str) -> None:
    """Raise TypeError unless all are of the type of the first."""
    kind = type(these[0])
    for i, one in enumerate(these):
        if type(one) is not kind:
            raise TypeError(
                f"{who}: as the first is a {kind.__name__}, all must be;"
                f" number {i} is of type {type(one).__name__}"
            )


class OutcomeEnsemble(Tabular):
    """Outcomes of the members of a random run."""

    configuration: str
    duration: float | None
    margin: NDArray[np.float64]
    _kind: ClassVar[str]  # of a system, as in 'block'

    def __init__(
        self,
        systems: Sequence[Any],
        seed: int,
        first_member: int,
        settle: bool,
        results: Mapping[str, Any],
    ) -> None:
        setattr(self, f"{self._kind}s", tuple(systems))
        self.seed = seed
        self.first_member = first_member
        self.settle = settle
        for name, values in results.items():
            setattr(self, name, values)

    @property
    def members(self) -> int:
        """Number of members."""
        return len(self.margin)


def run_outcomes(
    ensemble: type[E],
    compute: Callable[..., dict[str, Any]],
    given: Any,
    kinds: tuple[type, ...],
    motions: Any,
    *,
    members: int,
    first_member: int,
    seed: int,
    settle: bool,
    **how: Any,
) -> E:
    """The ensemble of a run; `compute` is the function of the compiled module.

    Member i has system i modulo their number.
    """
    if isinstance(given, kinds):
        these = [given]
    elif hasattr(given, "draw"):  # a Random
        these = [given.sample(seed=seed, member=first_member + i) for i in range(members)]
    else:
        listed = list(given)
        these = [listed[(first_member + i) % len(listed)] for i in range(min(members, len(listed)))]
    same_kind(these, "run_ensemble")
    found = compute(
        these,
        motions,
        members=members,
        first_member=first_member,
        seed=seed,
        settle=settle,
        **how,
    )
    if failures := found.pop("failures"):
        member, message = failures[0]
        raise ValueError(f"run_ensemble: member {first_member + member}: {message}")
    return ensemble(these, seed, first_member, settle, found)


class OutcomeTable(Tabular):
    """Outcomes over [system, record, scale, polarity]."""

    planar: ClassVar[bool] = False  # as of a SweepTable
    _kind: ClassVar[str]  # of a system, as in 'block'
    _failure: ClassVar[Callable[..., Any]]

    def __init__(
        self,
        *,
        systems: Sequence[Any],
        parameters: Mapping[str, ArrayLike],
        motions: Sequence[GroundMotion],
        metadata: Mapping[str, ArrayLike],
        scale: ArrayLike,
        polarity: Sequence[str],
        settle: bool,
        results: Mapping[str, NDArray[Any]],
        failures: Sequence[Any] = (),
    ) -> None:
        setattr(self, f"{self._kind}s", tuple(systems))
        self.parameters = {name: np.asarray(values) for name, values in parameters.items()}
        self.motions = tuple(motions)
        self.records = tuple(m.name or f"record {i}" for i, m in enumerate(motions))
        self.metadata = {name: np.asarray(values) for name, values in metadata.items()}
        self.scale: NDArray[np.float64] = np.asarray(scale, float)
        self.polarity = tuple(polarity)
        self.settle = bool(settle)
        self.failures = tuple(failures)
        for name, values in results.items():
            setattr(self, name, values)

    @property
    def _systems(self) -> tuple[Any, ...]:
        these: tuple[Any, ...] = getattr(self, f"{self._kind}s")
        return these

    @property
    def _shape(self) -> tuple[int, ...]:
        return len(self._systems), len(self.motions), self.scale.size, len(self.polarity)

    def _axes(self) -> dict[str, NDArray[Any]]:
        """The columns of a combination."""
        shape = self._shape

        def along(values: Any, axis: int) -> NDArray[Any]:
            at = [1] * len(shape)
            at[axis] = -1
            return np.broadcast_to(np.asarray(values).reshape(at), shape).ravel()

        columns = {self._kind: along([repr(one) for one in self._systems], 0)}
        columns |= {name: along(values, 0) for name, values in self.parameters.items()}
        columns["record"] = along(self.records, 1)
        columns |= {name: along(values, 1) for name, values in self.metadata.items()}
        return columns | {"scale": along(self.scale, 2), "polarity": along(self.polarity, 3)}

    def _size(self) -> str:
        """The axes in words."""
        return (
            f"{len(self._systems):,} {self._kind}s, {len(self.records):,} records,"
            f" {len(self.scale):,} scales, {' and '.join(self.polarity)}"
        )


def sweep_outcomes(
    table: type[T],
    compute: Callable[..., dict[str, Any]],
    systems: Sequence[Any],
    parameters: Mapping[str, ArrayLike],
    motions: Sequence[GroundMotion],
    metadata: Mapping[str, ArrayLike],
    scale: ArrayLike | None,
    polarity: Sequence[str],
    settle: bool,
    **how: Any,
) -> T:
    """The table of a sweep; `compute` is the function of the compiled module."""
    scales = np.atleast_1d(reals(1.0 if scale is None else scale, "sweep: scale"))
    if scales.ndim != 1 or not scales.size or not (np.isfinite(scales) & (scales >= 0)).all():
        raise ValueError(f"sweep: scale must hold finite numbers of at least 0, got {scale!r}")
    signs = [1.0 if name == "recorded" else -1.0 for name in polarity]
    shape = (len(systems), len(motions), scales.size, len(signs))
    found = compute(
        systems,
        motions,
        scales=np.multiply.outer(scales, signs).ravel().tolist(),
        settle=settle,
        **how,
    )
    failures = []
    for place, message in found.pop("failures"):
        system, record, k, sign = map(int, np.unravel_index(place, shape))
        failures.append(table._failure(system, record, float(scales[k]), polarity[sign], message))
    result = table(
        systems=systems,
        parameters=parameters,
        motions=motions,
        metadata=metadata,
        scale=scales,
        polarity=polarity,
        settle=settle,
        results={name: v.reshape(shape + v.shape[1:]) for name, v in found.items()},
        failures=failures,
    )
    if failures:
        first = failures[0]
        warnings.warn(
            f"sweep: {len(failures)} of {np.prod(shape)} combinations failed and are NaN; the"
            f" first, {table._kind} {first[0]} under record {first.record} {first.polarity} at"
            f" scale {first.scale:g}: {first.message}",
            RuntimeWarning,
            stacklevel=4,
        )
    return result
