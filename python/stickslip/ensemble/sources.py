"""Where the members of an ensemble come from: sliders and ground motions by seed and member."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol, TypeAlias

from .._core import (
    Caster,
    Coulomb,
    Degrading,
    Drawn,
    GaussianExcitation,
    GroundMotion,
    PoissonPulses,
    Slider,
    StaticKinetic,
    Stribeck,
    VelocityDependent,
)


class Excitation(Protocol):
    """A random source of ground motions of somebody's own, as `run_ensemble` takes it.

    It may have `dt` as well [s]: between the times of the statistics, where its motions have
    samples. It is asked by several threads, one at a time; to go to other processes it must pickle.
    """

    @property
    def duration(self) -> float | None:
        """Of each motion [s], positive; None where they differ: no statistics by time then."""

    @property
    def configuration(self) -> Any:
        """All that the motions depend on, as JSON knows it: only what has the same is merged."""

    def sample(self, *, seed: int, member: int) -> GroundMotion:
        """The motion of that name, the same for ever."""


class SliderSource(Protocol):
    """A source of sliders of one's own, as `run_ensemble` takes it; `Random` is one.

    It is asked by several threads, one at a time; to go to other processes it must pickle.
    """

    @property
    def configuration(self) -> Any:
        """All that the sliders depend on, as JSON knows it: only what has the same is merged."""

    def sample(self, *, seed: int, member: int) -> AnySlider:
        """The slider of that name, the same for ever."""


AnySlider: TypeAlias = (
    "Slider | Coulomb | Caster | VelocityDependent | Stribeck | Degrading | StaticKinetic"
)
AnySliders: TypeAlias = "AnySlider | Sequence[AnySlider] | Drawn[AnySlider] | SliderSource"
Records: TypeAlias = "GroundMotion | Sequence[GroundMotion] | Drawn[GroundMotion]"
AnyMotions: TypeAlias = "GaussianExcitation | PoissonPulses | Excitation | Records"
