"""Carts whose casters have random headings."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

from .._core import Cart, Uniform
from ..carts.casters import swivels
from .random_slider import Random


@dataclass(frozen=True)
class _Turned:
    """Makes the cart with other headings."""

    cart: Cart

    def __call__(self, **headings: float) -> Cart:
        return self.cart.with_headings(list(headings.values()))


class RandomHeadings(Random):
    """A `Random` of one cart, whose casters have independent headings uniform over the circle.

    `Cart.with_random_headings` makes it.

    Parameters
    ----------
    cart : Cart
        Casters that do not swivel (lock='both') stay as they are.

    Raises
    ------
    ValueError
        A cart without casters that swivel.
    """

    def __init__(self, cart: Cart) -> None:
        names = [f"heading_{i}" for i in swivels(cart)]
        if not names:
            raise ValueError("RandomHeadings: the cart has no caster that swivels")
        self._cart = cart
        super().__init__(_Turned(cart), **{name: Uniform(-math.pi, math.pi) for name in names})

    def __repr__(self) -> str:
        return f"RandomHeadings({self._cart!r})"


Carts: TypeAlias = "Cart | Sequence[Cart] | RandomHeadings"
