"""Theories: they predict without simulating what `integrate` and `run_ensemble` find.

Each takes the sliders and the sources of motion that a simulation takes, says what it covers, and
refuses the rest.
"""

from ._core import HarmonicSolution, SlowlyVaryingParameters

__all__ = ["HarmonicSolution", "SlowlyVaryingParameters"]
from ._core import EquivalentLinearization, TransitionTime, WhiteNoise, transition_time

__all__ = ["EquivalentLinearization", "TransitionTime", "WhiteNoise", "transition_time"]
from ._core import (
    PulseChain,
    PulseResponse,
    PulseSuperposition,
    peak_from_growth,
    pulse_response,
    viscous_damping_for,
    viscous_pulse_response,
)

__all__ = [
    "PulseChain",
    "PulseResponse",
    "PulseSuperposition",
    "peak_from_growth",
    "pulse_response",
    "viscous_damping_for",
    "viscous_pulse_response",
]
