"""Carts: many of them, under many ground motions."""

from .ensemble import CartEnsemble
from .sweep import CartFailure, CartTable

__all__ = [
    "CartEnsemble",
    "CartFailure",
    "CartTable",
]
