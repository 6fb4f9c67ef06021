"""Carts as JSON."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Callable

from .._core import Cart, FixedWheel, Foot, SwivelCaster
from ..slider_files import called, document, made

_KINDS: dict[str, Callable[..., SwivelCaster | FixedWheel | Foot]] = {
    "SwivelCaster": SwivelCaster,
    "FixedWheel": FixedWheel,
    "Foot": Foot,
}


def to_json(cart: Cart) -> str:
    """The arguments of a cart as JSON; see `Cart.to_json`."""
    supports = [
        {
            "kind": type(one).__name__,
            **{name: "inf" if v == math.inf else v for name, v in one._arguments().items()},
        }
        for one in cart.supports
    ]
    return json.dumps({"supports": supports, **cart._arguments()})


def from_json(source: str | os.PathLike[str]) -> Cart:
    """A cart from JSON; see `Cart.from_json`."""
    given, who = document(source, "Cart.from_json")
    if not isinstance(given.get("supports"), list):
        raise ValueError(f"{who}: must be an object with a list of supports")
    supports = []
    for i, one in enumerate(given["supports"]):
        arguments = one if isinstance(one, dict) else {"kind": one}
        arguments = {name: math.inf if v == "inf" else v for name, v in arguments.items()}
        supports.append(made(_KINDS, arguments, f"{who}: support {i}"))
    return called(Cart, {**given, "supports": supports}, who)
