"""The problems: small files of one format, which `referee/SCHEMA.md` describes."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

CLASSES = (
    "stick",
    "one record",
    "laws of the speed",
    "vertical motion",
    "two directions",
    "springs, stops and bearings",
    "structures",
    "rocking",
    "carts",
)
Answers = Mapping[str, Sequence[float]]


class NotExpressibleError(Exception):
    """A tool has no means to state a problem. The message names what it lacks."""


class NotTriedError(Exception):
    """An adapter does not build the system of a problem, though its tool may be able to."""


@dataclass(frozen=True)
class Asked:
    """One quantity that a problem asks for."""

    value: tuple[float, ...]
    uncertainty: float
    unit: str


@dataclass(frozen=True)
class Problem:
    """One problem. Units are SI; angles of slopes are in degrees."""

    id: str
    group: str
    description: str
    system: Mapping[str, Any]
    ground: Mapping[str, Any]
    start: Mapping[str, Any]
    answers: Mapping[str, Asked]
    scale: float
    origin: str

    @property
    def kind(self) -> str:
        return str(self.system["kind"])

    @property
    def dt(self) -> float:
        return float(self.ground["dt"])

    @property
    def duration(self) -> float:
        return self.dt * (len(self.ground["along"]) - 1)

    def component(self, name: str) -> list[float]:
        """Samples of "along", "transverse" or "vertical" [m/s^2]: zeros where it is absent."""
        samples: list[float] = self.ground.get(name) or [0.0] * len(self.ground["along"])
        return samples

    def has(self, name: str) -> bool:
        return name in self.ground

    def error(self, found: Answers) -> float:
        """Largest departure from the answers over `scale`; infinite where one is not finite.

        Raises
        ------
        ValueError
            If an answer is missing or has another number of components.
        """
        if found.get("overturned", [0.0])[0] != self.overturned:
            return 1.0
        worst = 0.0
        for name, asked in self.answers.items():
            values = found.get(name, ())
            if len(values) != len(asked.value):
                raise ValueError(
                    f"{self.id}: expected {len(asked.value)} numbers as {name}, got {list(values)}"
                )
            for one, right in zip(values, asked.value, strict=True):
                off = abs(one - right) / self.scale
                worst = max(worst, off) if math.isfinite(off) else math.inf
        return worst

    @property
    def overturned(self) -> float:
        return self.answers["overturned"].value[0] if "overturned" in self.answers else 0.0


def read(path: Path | str) -> Problem:
    """Read one problem from a file.

    Raises
    ------
    ValueError
        If the file is not a problem of this format.
    """
    return parse(Path(path).read_text(encoding="utf-8"), str(path))


def parse(text: str, name: str) -> Problem:
    """Read one problem from its text; `name` is that of errors."""
    try:
        one = json.loads(text)
        answers = {
            quantity: Asked(
                tuple(float(value) for value in asked["value"]),
                float(asked["uncertainty"]),
                asked["unit"],
            )
            for quantity, asked in one["answers"].items()
        }
        return Problem(
            id=one["id"],
            group=one["class"],
            description=one["description"],
            system=one["system"],
            ground=one["ground"],
            start=one["start"],
            answers=answers,
            scale=float(one["scale"]),
            origin=one["origin"],
        )
    except (KeyError, TypeError, ValueError) as error:
        raise ValueError(f"{name}: expected a problem of the referee, got {error!r}") from error


def folder() -> Path:
    """The folder of the problems: in an installed package, or in the source."""
    here = Path(__file__).parent
    for found in (here / "problems", *(above / "referee" / "problems" for above in here.parents)):
        if found.is_dir():
            return found
    raise FileNotFoundError(f"the problems are not in {here / 'problems'}: name their folder")


def problems(path: Path | str | None = None) -> list[Problem]:
    """All problems of a folder, in the order of their classes and ids.

    Parameters
    ----------
    path : path, optional
        The folder. Default: the problems that come with the package.
    """
    found = [read(one) for one in sorted(Path(path or folder()).glob("*.json"))]
    if not found:
        raise FileNotFoundError(f"no problems (*.json) in {path or folder()}")
    return sorted(found, key=lambda one: (CLASSES.index(one.group), one.id))
