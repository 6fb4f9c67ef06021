"""Where the members of an ensemble come from: sliders and ground motions by seed and member."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol, TypeAlias

from .._core import (
    Drawn,
    EquipmentOnFloor,
    FlexibleSlope,
    FrictionLaw,
    GaussianExcitation,
    GroundMotion,
    IsolatedStructure,
    PlanarSlider,
    PoissonPulses,
    RockingBlock,
    SlenderBlock,
    Slider,
    WithTransverse,
    WithVertical,
    _upward,
)


def check_directions(motions: Sequence[GroundMotion], who: str) -> None:
    """Reject vertical ground motions among others: a slider moves along all of them alike.

    Raises
    ------
    ValueError
        Some motions, but not all, are known to point up or down.
    """
    upright = [i for i, motion in enumerate(motions) if _upward(motion.orientation)]
    if upright and len(upright) < len(motions):
        first = motions[upright[0]]
        raise ValueError(
            f"{who}: motions must all be horizontal or all be vertical, but {len(upright)} of"
            f" {len(motions)} are known to be vertical, such as motions[{upright[0]}],"
            f" '{first.name}' ({first.orientation})"
        )


class Excitation(Protocol):
    """A user-defined random source of ground motions for `run_ensemble`.

    It may also have `dt` [s], the step of its motions, which is then the step of the statistics.
    Several threads call it, one at a time; for other processes it must pickle.
    """

    @property
    def duration(self) -> float | None:
        """Duration of each motion [s], positive; None if they differ: no statistics by time."""

    @property
    def configuration(self) -> Any:
        """Everything that determines the motions, as JSON types; must be equal to merge."""

    def sample(self, *, seed: int, member: int) -> GroundMotion:
        """The motion of a member: the same for equal arguments, always."""


class SliderSource(Protocol):
    """A user-defined source of sliders for `run_ensemble`; `Random` is one.

    Several threads call it, one at a time; for other processes it must pickle.
    """

    @property
    def configuration(self) -> Any:
        """Everything that determines the sliders, as JSON types; must be equal to merge."""

    def sample(self, *, seed: int, member: int) -> AnyMember:
        """The slider of a member: the same for equal arguments, always.

        Those of all members are in the plane (PlanarSlider), or none; all are structures, or none.
        """


AnySlider: TypeAlias = Slider | FrictionLaw | PlanarSlider
AnyStructure: TypeAlias = IsolatedStructure | EquipmentOnFloor | FlexibleSlope
AnyMember: TypeAlias = "AnySlider | AnyStructure"
Blocks: TypeAlias = "SlenderBlock | RockingBlock | Sequence[SlenderBlock] | Sequence[RockingBlock]"
AnySliders: TypeAlias = "AnyMember | Sequence[AnyMember] | Drawn[AnyMember] | SliderSource"
Records: TypeAlias = "GroundMotion | Sequence[GroundMotion] | Drawn[GroundMotion]"
AnyMotions: TypeAlias = (
    "GaussianExcitation | PoissonPulses | WithTransverse | WithVertical | Excitation | Records"
)
