"""The casters of a cart."""

from __future__ import annotations

from .._core import Cart, SwivelCaster


def swivels(cart: Cart) -> list[int]:
    """The numbers of the supports that swivel."""
    return [
        i
        for i, one in enumerate(cart.supports)
        if isinstance(one, SwivelCaster) and one.lock != "both"
    ]
