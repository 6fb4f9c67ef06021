"""Suites from files: which, how, and what is left out."""

from __future__ import annotations

import operator
import os
import warnings
from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, Literal, NamedTuple, Protocol, TypeVar

from numpy.typing import ArrayLike

from .. import _core
from .._core import GroundMotion, PlausibilityWarning
from .._failures import grouped as grouped_reasons
from .._paths import expanded, is_same_file
from .._text import printable
from ..runs.progress import Progress, shown
from .metadata import Metadata, readings
from .records import Answer, Component, File, NotARecord, trend_order, tried, without_trend
from .stations import Part, stations_of

__all__ = ["LeftOut", "free_names", "read_suite"]

_QUANTITIES = ("pga_g", "duration")  # that a suite computes
_SHOWN = 10  # maximum number of reasons or records in one message


class LeftOut(NamedTuple):
    """A file that `Suite.read` left out, and why."""

    file: str
    reason: str


class _Suite(Protocol):
    left_out: tuple[LeftOut, ...]
    alone: tuple[LeftOut, ...]

    def __init__(self, motions: Iterable[GroundMotion], metadata: Mapping[str, Any]) -> None: ...
    @property
    def duplicates(self) -> list[tuple[int, ...]]: ...


_Kind = TypeVar("_Kind", bound=_Suite)


def read_suite(
    kind: type[_Kind],
    files: str | os.PathLike[str] | Iterable[str | os.PathLike[str]],
    *,
    units: str | None,
    component: str | int | None,
    dt: float | str | None,
    orientation: float | str | None,
    gaps: bool,
    detrend: str | None,
    stations: bool,
    along: str | float | None,
    common_length: bool,
    on_error: Literal["raise", "skip"],
    metadata: str | os.PathLike[str] | Mapping[str, ArrayLike] | Any | None,
    threads: int | None,
    progress: bool | Progress | None,
) -> _Kind:
    """Implementation of `Suite.read` (see there)."""
    if on_error not in ("raise", "skip"):
        raise ValueError(f"Suite.read: on_error must be 'raise' or 'skip', got {on_error!r}")
    if threads is not None and operator.index(threads) < 1:
        raise ValueError(f"Suite.read: threads must be at least 1, got {threads}")
    if stations and component is not None:
        raise ValueError("Suite.read: component and stations must not both be given")
    if not stations and (along is not None or common_length):
        given = "along" if along is not None else "common_length"
        raise ValueError(f"Suite.read: {given} needs stations=True")
    trend = trend_order(detrend, "Suite.read: detrend")
    table = None if metadata is None else Metadata(metadata)
    stated = readings(
        "Suite.read: {}", table, units=units, dt=dt, orientation=orientation, gaps=gaps
    )
    named = table.path if table else None
    paths = [p for p in _files(files) if named is None or not is_same_file(p, named)]
    if not paths:
        raise ValueError(f"Suite.read: no files in {_shown_source(files)}")

    every = stations or component in ("all", "vertical")
    one = None if every else component

    def components(file: File) -> list[Component]:
        return file.components(stated(file.shown), one, only_one=not every)

    def read_file(path: Path) -> list[tuple[str, Answer]]:
        try:
            return [(file.shown, answer) for file, answer in tried(path, components)]
        except (OSError, ValueError) as error:
            return [(str(path), error)]

    found: list[tuple[str, Answer]] = []
    pool = ThreadPoolExecutor(threads or os.cpu_count() or 1)
    try:
        with shown(progress, "Suite.read", "file") as report:
            for done, several in enumerate(pool.map(read_file, paths, chunksize=16), 1):
                found += several
                report(done, len(paths))
    finally:
        pool.shutdown(cancel_futures=True)
    beside = [
        LeftOut(file, _reason(answer, file))
        for file, answer in found
        if isinstance(answer, NotARecord)
    ]
    left = [
        LeftOut(file, _reason(answer, file))
        for file, answer in found
        if isinstance(answer, Exception) and not isinstance(answer, NotARecord)
    ]
    parts = [
        Part(file, number, part)
        for file, answer in found
        if not isinstance(answer, Exception)
        for number, part in enumerate(answer, 1)
    ]
    if left and (on_error == "raise" or not parts):
        raise ValueError(
            _failures("Suite.read: ", left, len(found))
            + ('\non_error="skip" leaves them out' if on_error == "raise" and parts else "")
        )
    if table:
        table.require_rows([part.file for part in parts])
    vertical: list[LeftOut] = []
    if not stations and component in (None, "all", "vertical"):
        wanted = component == "vertical"
        others = [part for part in parts if part.component.is_vertical != wanted]
        parts = [part for part in parts if part.component.is_vertical == wanted]
        if not wanted:
            vertical = [_vertical(part) for part in others]
    alone: list[LeftOut] = []
    columns: dict[str, Any]
    if stations:
        every_station = stations_of(parts, along, common_length)
        vertical = [
            _vertical(one.parts[0], f": {one.reason}") for one in every_station if one.is_vertical
        ]
        grouped = [station for station in every_station if not station.is_vertical]
        alone = [LeftOut(one.files[0], one.reason) for one in grouped if one.reason]
        motions = [station.motion for station in grouped]
        names = [station.files[0] for station in grouped]
        columns = {
            "file": names,
            "files": ["; ".join(station.files) for station in grouped],
            "components": [len(station.parts) for station in grouped],
        }
    else:
        motions = [part.component.motion for part in parts]
        names = [part.file for part in parts]
        columns = {"file": names}
        if component == "all":
            columns["component"] = [p.component.name or str(p.number) for p in parts]
    if not motions:
        which = "vertical" if component == "vertical" else "horizontal"
        other = "" if which == "vertical" else '; component="vertical" reads vertical ones'
        raise ValueError(f"Suite.read: no {which} component in {_shown_source(files)}{other}")
    motions = [without_trend(motion, trend) for motion in motions]
    for motion in motions:
        _core._warn_if_implausible(motion, "read_record", 3)
    if table:
        joined, renamed = free_names(kind, table.joined(names), every=True)
        columns |= joined
    else:
        renamed = ""
    suite = kind(motions, columns)
    suite.left_out, suite.alone = (*left, *beside, *vertical), tuple(alone)

    def say(message: str) -> None:
        warnings.warn(message, RuntimeWarning, stacklevel=4)

    if renamed:
        say(f"Suite.read: {renamed}")
    if left:
        say(_failures("Suite.read: ", left, len(found), "; they are left out"))
    if beside:
        lines = grouped_reasons((one.file, one.reason) for one in beside)
        say(f"Suite.read: left out, because they are no records:{_listed(lines)}")
    if vertical:
        lines = grouped_reasons((one.file, one.reason) for one in vertical)
        say(f"Suite.read: left out, because sliders move horizontally:{_listed(lines)}")
    if alone:
        lines = grouped_reasons((one.file, one.reason) for one in alone)
        say(
            f"Suite.read: {len(alone)} of {len(parts)} components fit no station and stay"
            f" alone:{_listed(lines)}"
        )
    if equal := suite.duplicates:
        sets = "; ".join(
            " = ".join(Path(names[i]).name for i in places) for places in equal[:_SHOWN]
        )
        warnings.warn(
            f"Suite.read: records that occur more than once: {len(equal)}: {printable(sets)}",
            PlausibilityWarning,
            stacklevel=3,
        )
    return suite


def _files(source: Any) -> list[Path]:
    """The files of a source, each once, sorted by name."""
    if not isinstance(source, (str, os.PathLike)):
        return list(dict.fromkeys(path for one in source for path in _files(one)))
    files = expanded(source)
    return (
        [Path(os.fspath(source))] if files is None else files
    )  # read_record says if it is missing


def _shown_source(source: Any) -> str:
    return f"'{os.fspath(source)}'" if isinstance(source, (str, os.PathLike)) else "the list"


def _reason(error: Exception, path: str) -> str:
    """The reason for an error, without the name of the file."""
    if isinstance(error, OSError) and error.strerror:
        return error.strerror
    return str(error).removeprefix(f"read_record: {path}: ")


def _failures(who: str, left: Sequence[LeftOut], total: int, end: str = "") -> str:
    """A message about all files that could not be read, with a line for each reason."""
    head = f"{who}cannot read {len(left)} of {total} files{end}:"
    return head + _listed(grouped_reasons((one.file, one.reason) for one in left))


def _listed(lines: Sequence[str]) -> str:
    """One line, or several lines that follow a colon."""
    if len(lines) == 1:
        return f" {lines[0]}"
    more = [f"and {len(lines) - _SHOWN} more reasons"] if len(lines) > _SHOWN else []
    return "".join(f"\n  {line}" for line in [*lines[:_SHOWN], *more])


def _vertical(part: Part, why: str = '; component="vertical" reads it') -> LeftOut:
    return LeftOut(part.file, f"a vertical component ({part.component.motion.orientation}){why}")


def free_names(
    suite: type, columns: Mapping[str, Any], every: bool = False
) -> tuple[dict[str, Any], str]:
    """Columns without the names of a suite's own quantities, and a sentence about those renamed.

    With `every`, the names of its methods are replaced, too.
    """
    found: dict[str, Any] = {}
    renamed = []
    for name, values in columns.items():
        taken = name in _QUANTITIES or (every and hasattr(suite, name))
        new = f"{name}_given" if taken and f"{name}_given" not in columns else name
        if new != name:
            renamed.append(f"'{name}' to '{new}'")
        found[new] = values
    if not renamed:
        return found, ""
    return found, f"metadata renamed, because a suite has these names: {', '.join(renamed)}"
