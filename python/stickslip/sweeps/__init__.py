"""Sweeps: many sliders under many ground motions, in one table."""

from .directions import OrientationPercentile, Orientations, orientations
from .error import SweepError
from .parameter_grid import Grid, grid
from .rocking import RockingSpectrum, rocking_spectrum
from .run import sweep
from .spectrum import sliding_spectrum
from .table import SweepFailure, SweepTable

__all__ = [
    "Grid",
    "OrientationPercentile",
    "Orientations",
    "RockingSpectrum",
    "SweepError",
    "SweepFailure",
    "SweepTable",
    "grid",
    "orientations",
    "rocking_spectrum",
    "sliding_spectrum",
    "sweep",
]
