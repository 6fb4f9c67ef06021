"""Carts as JSON."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

from .._core import Cart, FixedWheel, Foot, SwivelCaster

T = TypeVar("T")
_KINDS: dict[str, Callable[..., SwivelCaster | FixedWheel | Foot]] = {
    "SwivelCaster": SwivelCaster,
    "FixedWheel": FixedWheel,
    "Foot": Foot,
}


def to_json(cart: Cart) -> str:
    """The arguments of a cart as JSON; see `Cart.to_json`."""
    supports = [{"kind": type(one).__name__, **one._arguments()} for one in cart.supports]
    return json.dumps({"supports": supports, **cart._arguments()})


def from_json(source: str | os.PathLike[str]) -> Cart:
    """A cart from JSON; see `Cart.from_json`."""
    if isinstance(source, str) and source.lstrip().startswith("{"):
        text, who = source, "Cart.from_json"
    else:
        text, who = Path(source).read_text(encoding="utf-8"), f"Cart.from_json: '{source}'"
    try:
        given = json.loads(text)
    except ValueError as error:
        raise ValueError(f"{who}: not JSON: {error}") from error
    if not isinstance(given, dict) or not isinstance(given.get("supports"), list):
        raise ValueError(f"{who}: must be an object with a list of supports")
    supports = [_support(one, f"{who}: support {i}") for i, one in enumerate(given["supports"])]
    return _made(Cart, {**given, "supports": supports}, who)


def _support(given: Any, who: str) -> SwivelCaster | FixedWheel | Foot:
    if not isinstance(given, dict) or given.get("kind") not in _KINDS:
        kind = given.get("kind") if isinstance(given, dict) else given
        raise ValueError(f"{who}: kind must be {', '.join(_KINDS)}, got {kind!r}")
    others = {name: value for name, value in given.items() if name != "kind"}
    return _made(_KINDS[given["kind"]], others, who)


def _made(kind: Callable[..., T], arguments: dict[str, Any], who: str) -> T:
    try:
        return kind(**arguments)
    except (TypeError, ValueError) as error:
        raise ValueError(f"{who}: {error}") from error
