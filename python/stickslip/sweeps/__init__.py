"""Sweeps: many sliders under many ground motions, in one table."""

from .directions import OrientationPercentile, Orientations, orientations
from .error import SweepError
from .parameter_grid import Grid, grid
from .run import sweep
from .spectrum import sliding_spectrum
from .table import SweepFailure, SweepTable

__all__ = [
    "Grid",
    "OrientationPercentile",
    "Orientations",
    "SweepError",
    "SweepFailure",
    "SweepTable",
    "grid",
    "orientations",
    "sliding_spectrum",
    "sweep",
]
