"""Theories: they predict without simulating what `integrate` and `run_ensemble` find.

Each takes the sliders and the sources of motion that a simulation takes, says what it covers, and
refuses the rest.
"""

from ._core import StationaryLinearization, StationaryPrediction

__all__ = ["StationaryLinearization", "StationaryPrediction"]
