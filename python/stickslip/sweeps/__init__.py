"""Sweeps: many sliders under many ground motions, in one table."""

from .error import SweepError
from .parameter_grid import Grid, grid
from .run import sweep
from .spectrum import sliding_spectrum
from .table import SweepFailure, SweepTable

__all__ = [
    "Grid",
    "SweepError",
    "SweepFailure",
    "SweepTable",
    "grid",
    "sliding_spectrum",
    "sweep",
]
