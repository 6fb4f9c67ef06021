"""Theories: they predict without simulating what `integrate` and `run_ensemble` find.

Each takes the sliders and the sources of motion that a simulation takes, says what it covers, and
refuses the rest.
"""

from ._core import (
    EquivalentLinearization,
    HarmonicSolution,
    PulseChain,
    PulseResponse,
    PulseSuperposition,
    SlowlyVaryingParameters,
    StationaryLinearization,
    StationaryPrediction,
    TransitionTime,
    WhiteNoise,
    peak_from_growth,
    pulse_response,
    transition_time,
    viscous_damping_for,
    viscous_pulse_response,
)

__all__ = [
    "EquivalentLinearization",
    "HarmonicSolution",
    "PulseChain",
    "PulseResponse",
    "PulseSuperposition",
    "SlowlyVaryingParameters",
    "StationaryLinearization",
    "StationaryPrediction",
    "TransitionTime",
    "WhiteNoise",
    "peak_from_growth",
    "pulse_response",
    "transition_time",
    "viscous_damping_for",
    "viscous_pulse_response",
]
