"""Theories, which predict the results of `integrate` and `run_ensemble` without simulation.

Each theory has a `name`; `covers(slider, excitation)`, which says whether the theory applies and,
if not, why; and `predict(slider, excitation, times)`, which returns the `Moments` of the response
from rest. Your own objects with these three members are theories, too: pass them to
`stickslip.compare`.

`THEORIES` lists those that `compare` uses by default on one axis, the best first, and
`PLANAR_THEORIES` those in the plane.
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
    StationaryVelocity,
    TransitionTime,
    Transport,
    TransportCost,
    TransportPeak,
    TransportPrediction,
    TransportStationary,
    VelocityDistribution,
    WhiteNoise,
    peak_from_growth,
    pulse_response,
    transition_time,
    viscous_damping_for,
    viscous_pulse_response,
)

__all__ = [
    "PLANAR_THEORIES",
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
    "StationaryVelocity",
    "TransitionTime",
    "Transport",
    "TransportCost",
    "TransportPeak",
    "TransportPrediction",
    "TransportStationary",
    "VelocityDistribution",
    "WhiteNoise",
    "peak_from_growth",
    "pulse_response",
    "transition_time",
    "viscous_damping_for",
    "viscous_pulse_response",
]

#: The theories that `compare` uses by default for sliders on one axis, the best first.
THEORIES = (
    WhiteNoise(),
    Transport(),
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

#: The theories that `compare` uses by default for sliders in the plane, the best first.
PLANAR_THEORIES = (
    WhiteNoise(dimensions=2),
    EquivalentLinearization(dimensions=2),
    EquivalentLinearization(force="laplace", dimensions=2),
)
