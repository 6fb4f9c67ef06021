"""Ensembles: many members, a slider under a ground motion each, on threads, on any executor.

Members are simulated and summed in blocks, and the sums merge in an order that the members' numbers
fix. So it matters to no bit of an answer who simulated what, and when: threads, processes, a
cluster, a run that was broken off and gone on with.
"""

from .error import EnsembleError
from .random_slider import Random
from .run import run_ensemble
from .sources import Excitation, SliderSource

__all__ = ["EnsembleError", "Excitation", "Random", "SliderSource", "run_ensemble"]
