"""Blocks that rock: many of them, under many ground motions."""

from .ensemble import RockingEnsemble
from .sweep import RockingFailure, RockingTable

__all__ = [
    "RockingEnsemble",
    "RockingFailure",
    "RockingTable",
]
