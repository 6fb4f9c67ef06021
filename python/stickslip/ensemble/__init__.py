"""Ensembles: many members, each a slider under a ground motion, on threads or on any executor.

Members are simulated and summed in blocks, and the sums merge in an order fixed by the member
numbers. Results are therefore identical to the last bit on any threads, processes or cluster, also
for a run that was interrupted and resumed.
"""

from .error import EnsembleError
from .random_slider import Random
from .run import run_ensemble
from .sensitivity import ensemble_sensitivity
from .sources import Excitation, SliderSource

__all__ = [
    "EnsembleError",
    "Excitation",
    "Random",
    "SliderSource",
    "ensemble_sensitivity",
    "run_ensemble",
]
