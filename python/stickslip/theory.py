"""Theories: they predict without simulating what `integrate` and `run_ensemble` find.

Each has a `name`, `covers(slider, excitation)`, which says whether it applies and, if not, why,
and `predict(slider, excitation, times)`, which answers in `Moments` from rest on. Objects of your
own with these three are theories too: `stickslip.compare` asks them like the rest.

`THEORIES` lists those that `compare` asks, the best first.
"""

from ._core import (
    Coverage,
    DisplacementDistribution,
    EquivalentLinearization,
    HarmonicSolution,
    PulseChain,
    PulseResponse,
    PulseSuperposition,
    ShapingFilter,
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
    "THEORIES",
    "Coverage",
    "DisplacementDistribution",
    "EquivalentLinearization",
    "HarmonicSolution",
    "PulseChain",
    "PulseResponse",
    "PulseSuperposition",
    "ShapingFilter",
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

#: Every theory that `compare` asks if none are named, the best first.
THEORIES = (
    WhiteNoise(),
    PulseChain(),
    EquivalentLinearization(),
    EquivalentLinearization(force="laplace"),
    EquivalentLinearization(force="thesis"),
    StationaryLinearization(),
    PulseSuperposition(overlap="renewal"),
    PulseSuperposition(overlap="thesis"),
    PulseSuperposition(overlap="none"),
    SlowlyVaryingParameters(),
)
