"""Blocks that rock: many of them, under many ground motions."""

from .ensemble import RockingEnsemble
from .spectrum import RockingSpectrum, rocking_spectrum
from .sweep import RockingFailure, RockingTable

__all__ = [
    "RockingEnsemble",
    "RockingFailure",
    "RockingSpectrum",
    "RockingTable",
    "rocking_spectrum",
]
