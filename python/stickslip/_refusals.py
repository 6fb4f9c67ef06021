"""Plain-language messages for rejected calls: what the stubs require, and what was passed.

Imported only after a call has failed.
"""

from __future__ import annotations

import ast
import functools
import os
import reprlib
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

__all__ = ["explain"]

# Plain words for the type names in the stubs.
_WORDS = {
    "_Number": "a number",
    "SupportsFloat": "a number",
    "SupportsIndex": "an integer",
    "float": "a number",
    "int": "an integer",
    "complex": "a complex number",
    "bool": "True or False",
    "str": "a string",
    "None": "None",
    "_Samples": "an array of numbers",
    "NDArray": "an array of numbers",
    "Callable": "a function",
    "FrictionLaw": "a friction law",
    "PathLike": "a path",
    "Sequence": "a sequence",
    "Iterable": "a sequence",
    "tuple": "a tuple",
    "dict": "a dict",
    "Axes": "a matplotlib Axes",
    "FigureBase": "a matplotlib Figure",
    "_Trace": "an ObsPy Trace",
    "_Stream": "an ObsPy Stream",
}


def explain(function: str, given: Sequence[Any], named: Mapping[str, Any]) -> str:
    """The message of the TypeError for a rejected call.

    Parameters
    ----------
    function : str
        Such as "integrate" or "Slider.hold"; "Slider.__init__" for a constructor.
    given, named
        Positional and keyword arguments; for a method, `given` begins with the object.
    """
    owner, _, name = function.rpartition(".")
    who = owner if name == "__init__" else function
    forms = _forms().get(function, [])
    reasons = []
    for form in forms:
        values = list(given[1:] if form.bound else given)
        reasons.append(form.refusal(values, dict(named)))
    misfits = [reason for reason in reasons if isinstance(reason, _Misfit)]
    unknown = [reason for reason in reasons if isinstance(reason, _Unknown)]
    texts = [reason for reason in reasons if isinstance(reason, str) and reason]
    furthest = max((one.place for one in unknown), default=-1)
    of = f" with {_a(type(given[0]).__name__)}" if furthest > 0 and len(forms) > 1 else ""
    nearest = [one.text.format(of=of) for one in unknown if one.place == furthest]
    if misfits and furthest <= max(one.place for one in misfits):
        nearest = _merged(misfits)
    said = list(dict.fromkeys(nearest or texts))
    if len(said) == 1:
        return f"{who}: {said[0]}"
    wanted = " or ".join(dict.fromkeys(f"{who}({form.names})" for form in forms))
    values = list(given[1:] if owner and forms and forms[0].bound else given)
    got = ", ".join([*map(_shown, values), *(f"{key}={_shown(v)}" for key, v in named.items())])
    takes = f"takes {wanted}, " if wanted else ""
    units = next(filter(None, map(_of_unit, [*values, *named.values()])), "")
    return f"{who}: {takes}got {who}({got}){units}"


class _Misfit(NamedTuple):
    """An argument that does not fit a signature."""

    place: int  # among the arguments given
    name: str
    words: list[str]  # what would be right
    got: str


class _Unknown(NamedTuple):
    """An argument whose name a signature does not have."""

    place: int  # of the arguments without a name, how many fit before one that does not
    text: str  # with a place for what the first of them is


def _merged(misfits: list[_Misfit]) -> list[str]:
    """What to say of them: of the forms that fit furthest, all kinds that one argument may have."""
    furthest = max((one.place for one in misfits), default=0)
    words: dict[tuple[str, str], dict[str, None]] = {}
    for one in misfits:
        if one.place == furthest:
            words.setdefault((one.name, one.got), {}).update(dict.fromkeys(one.words))
    return [f"{name} must be {_or(list(kinds))}, got {got}" for (name, got), kinds in words.items()]


class _Form:
    """One way to call a function, from its stub."""

    def __init__(self, node: ast.FunctionDef, bound: bool) -> None:
        self.bound = bound
        a = node.args
        places = [*a.posonlyargs, *a.args][1 if bound else 0 :]
        self.places = [one.arg for one in places]
        self.kinds = {one.arg: one.annotation for one in [*places, *a.kwonlyargs]}
        self.only_by_name = [one.arg for one in a.kwonlyargs]
        optional = self.places[len(self.places) - len(a.defaults) :] if a.defaults else []
        by_name = [one for one, value in zip(self.only_by_name, a.kw_defaults) if value is not None]
        self.optional = {*optional, *by_name}

    @property
    def names(self) -> str:
        star = ["*"] if self.only_by_name else []
        return ", ".join(
            f"{name}=..." if name in self.optional else name
            for name in [*self.places, *star, *self.only_by_name]
        )

    def refusal(self, values: list[Any], named: dict[str, Any]) -> str | _Misfit | _Unknown:
        """Why this form rejects the arguments; empty if the stubs do not tell."""
        if len(values) > len(self.places):
            extra = _shown(values[len(self.places)])
            if not self.places:
                return f"takes its arguments by name, got {extra} without one"
            most = len(self.places)
            plural = "" if most == 1 else "s"
            return f"takes at most {most} argument{plural} without a name, got {len(values)}"
        for name in named:
            if name not in self.kinds:
                known = ", ".join(self.kinds) or "none"
                fit = [_fits(one, self.kinds[of]) for of, one in zip(self.places, values)]
                place = [*fit, False].index(False)
                return _Unknown(place, f"has no argument {name!r}{{of}}; its arguments are {known}")
            if name in self.places[: len(values)]:
                return f"got {name} twice"
        all_given = dict(zip(self.places, values)) | named
        missing = [n for n in self.kinds if n not in all_given and n not in self.optional]
        if missing:
            return f"needs {' and '.join(missing)}, got none"
        for place, (name, value) in enumerate(all_given.items()):
            if not _fits(value, self.kinds[name]):
                words = list(dict.fromkeys(_words(self.kinds[name])))
                return _Misfit(place, name, words, f"{_shown(value)}{_of_unit(value)}")
        return ""


@functools.cache
def _stubs() -> ast.Module:
    return ast.parse(Path(__file__).with_name("_core.pyi").read_text(encoding="utf-8"))


@functools.cache
def _forms() -> dict[str, list[_Form]]:
    """The signatures of each function, by name."""
    found: dict[str, list[_Form]] = {}
    for node in _stubs().body:
        if isinstance(node, ast.FunctionDef):
            found.setdefault(node.name, []).append(_Form(node, bound=False))
        elif isinstance(node, ast.ClassDef):
            for one in node.body:
                if isinstance(one, ast.FunctionDef):
                    static = any(
                        isinstance(d, ast.Name) and d.id == "staticmethod"
                        for d in one.decorator_list
                    )
                    name = f"{node.name}.{one.name}"
                    found.setdefault(name, []).append(_Form(one, bound=not static))
    return found


@functools.cache
def _aliases() -> dict[str, ast.expr]:
    return {
        node.target.id: node.value
        for node in _stubs().body
        if isinstance(node, ast.AnnAssign)
        and isinstance(node.target, ast.Name)
        and node.value is not None
        and ast.unparse(node.annotation) == "TypeAlias"
    }


def _kinds(annotation: ast.expr | None) -> Iterator[ast.expr]:
    """The members of a union; resolves aliases that `_WORDS` does not list."""
    if isinstance(annotation, ast.BinOp):
        yield from _kinds(annotation.left)
        yield from _kinds(annotation.right)
    elif isinstance(annotation, ast.Name) and annotation.id not in _WORDS:
        alias = _aliases().get(annotation.id)
        yield from [annotation] if alias is None else _kinds(alias)
    elif annotation is not None:
        yield annotation


def _words(annotation: ast.expr | None) -> Iterator[str]:
    for kind in _kinds(annotation):
        base = kind.value if isinstance(kind, ast.Subscript) else kind
        name = base.value if isinstance(base, ast.Constant) else ast.unparse(base)
        if name == "Literal" and isinstance(kind, ast.Subscript):
            yield from ast.unparse(kind.slice).strip("()").split(", ")
        else:
            name = str(name).rpartition(".")[2]
            yield _WORDS.get(name, _a(name))


def _fits(value: Any, annotation: ast.expr | None) -> bool:
    """Whether a value may have that type; true if this cannot be decided."""
    kinds = list(_kinds(annotation))
    return not kinds or any(_is(value, kind) for kind in kinds)


def _is(value: Any, kind: ast.expr) -> bool:
    name = str(ast.unparse(kind.value if isinstance(kind, ast.Subscript) else kind))
    if name == "None":
        return value is None
    if name in ("_Number", "SupportsFloat", "float"):
        if isinstance(value, str | bytes):
            return False
        try:
            float(value)
        except (TypeError, ValueError, OverflowError):
            return False
        return True
    if name in ("SupportsIndex", "int"):
        return hasattr(value, "__index__")
    if name == "bool":
        return isinstance(value, bool) or type(value).__name__ in ("bool_", "bool")
    if name == "str":
        return isinstance(value, str)
    if name == "bytes":
        return isinstance(value, bytes)
    if name.endswith("PathLike"):
        return isinstance(value, os.PathLike)
    if name == "Callable":
        return callable(value)
    if name == "Literal" and isinstance(kind, ast.Subscript):
        return bool(isinstance(value, str))  # the function itself checks the value
    import stickslip
    from stickslip import _core

    cls = getattr(stickslip, name, None) or getattr(_core, name, None)
    return isinstance(value, cls) if isinstance(cls, type) else True


def _or(words: list[str]) -> str:
    return words[0] if len(words) < 2 else f"{', '.join(words[:-1])} or {words[-1]}"


def _a(name: str) -> str:
    return f"{'an' if name[:1] in 'AEIOU' else 'a'} {name}"


def _shown(value: Any) -> str:
    return reprlib.repr(value)


def _of_unit(value: Any) -> str:
    """Advice for a quantity that carries a unit."""
    if hasattr(value, "magnitude") and hasattr(value, "dimensionality"):
        return (
            "; for a quantity with a unit pass the number in SI units, q.to_base_units().magnitude"
        )
    if hasattr(value, "unit") and hasattr(value, "to_value"):
        return "; for a quantity with a unit pass the number in SI units, q.si.value"
    return ""
