"""Sliders as JSON: objects with a kind, a class of this package, and its arguments by name."""

from __future__ import annotations

import ast
import json
import math
import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TypeVar

from ._core import (
    DoublePendulum,
    FrictionLaw,
    FrictionPendulum,
    Law,
    QuintuplePendulum,
    Slider,
    Stops,
    TriplePendulum,
)

T = TypeVar("T")
_KINDS: dict[str, Callable[..., Any]] = {
    made.__name__: made
    for made in (
        Slider,
        FrictionPendulum,
        *(law for law in FrictionLaw.__subclasses__() if law is not Law),
        DoublePendulum,
        TriplePendulum,
        QuintuplePendulum,
        Stops,
    )
}
# What the first argument is called where `repr` gives no name.
_FIRST = {"Slider": "law", "StaticKinetic": "sliding"}


def document(source: str | os.PathLike[str], who: str) -> tuple[dict[str, Any], str]:
    """The object of a text that begins with '{', or of a file, and how messages name it."""
    if isinstance(source, str) and source.lstrip().startswith("{"):
        text = source
    else:
        text, who = Path(source).read_text(encoding="utf-8"), f"{who}: '{source}'"
    try:
        given = json.loads(text)
    except ValueError as error:
        raise ValueError(f"{who}: not JSON: {error}") from error
    if not isinstance(given, dict):
        raise ValueError(f"{who}: must be an object, got {given!r}")
    return given, who


def made(kinds: Mapping[str, Callable[..., T]], given: dict[str, Any], who: str) -> T:
    """The object of this kind."""
    kind = given.get("kind")
    if kind not in kinds:
        raise ValueError(f"{who}: kind must be {', '.join(kinds)}, got {kind!r}")
    return called(kinds[kind], {key: one for key, one in given.items() if key != "kind"}, who)


def called(make: Callable[..., T], arguments: dict[str, Any], who: str) -> T:
    """What a class makes of the arguments; its messages name the document."""
    try:
        return make(**arguments)
    except (TypeError, ValueError) as error:
        raise ValueError(f"{who}: {error}") from error


def from_json(source: str | os.PathLike[str]) -> Slider:
    """A slider from JSON; see `Slider.from_json`."""
    given, who = document(source, "Slider.from_json")
    found = _made(given, who)
    if isinstance(found, Stops):
        raise ValueError(f"{who}: kind must be Slider, FrictionPendulum or a law, got 'Stops'")
    return found if isinstance(found, Slider) else Slider(found)


def _made(given: dict[str, Any], who: str) -> Any:
    def value(one: Any, key: str) -> Any:
        if isinstance(one, dict):
            return _made(one, f"{who}: {key}")
        if isinstance(one, list):
            return [value(each, key) for each in one]
        return math.inf if one == "inf" else one

    return made(
        _KINDS, {key: one if key == "kind" else value(one, key) for key, one in given.items()}, who
    )


def to_json(slider: Slider) -> str:
    """The arguments of a slider as JSON; see `Slider.to_json`."""
    text = repr(slider)
    try:
        call = ast.parse(text, mode="eval").body
    except SyntaxError:
        call = None
    if not isinstance(call, ast.Call):
        raise ValueError(
            f"Slider.to_json: a law from functions has no description in numbers, got {text}"
        )
    return json.dumps(_described(call))


def _described(node: ast.expr) -> Any:
    """What `repr` shows, as values of JSON."""
    if not isinstance(node, ast.Call):
        if isinstance(node, ast.List | ast.Tuple):
            return [_described(one) for one in node.elts]
        return ast.literal_eval(node)
    assert isinstance(node.func, ast.Name)
    if node.func.id == "float":
        return "inf"
    names = [_FIRST[node.func.id]] if node.args else []
    arguments = dict(zip(names, node.args)) | {str(one.arg): one.value for one in node.keywords}
    return {"kind": node.func.id} | {key: _described(one) for key, one in arguments.items()}
