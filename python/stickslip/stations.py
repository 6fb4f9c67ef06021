"""Which components of records belong to one station."""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from typing import NamedTuple, SupportsFloat

from . import _core
from ._core import GroundMotion
from .records import Component, direction

__all__ = ["Part", "Station", "stations_of"]

# What a file name may end in: an azimuth, or letters after a mark; KOBE_NIS000, NIS-UP, CPM_090.
_ENDING = re.compile(
    r"(.*?)(?:(?<=[A-Za-z])|[-_. ])([0-3]\d\d)"
    r"|(.+?)[-_. ](N|E|S|W|NS|EW|UD|UP|DN|DWN|V|VER|VERT|Z)",
    re.IGNORECASE,
)


class Part(NamedTuple):
    """A component of a file."""

    file: str
    number: int  # in the file, from 1
    component: Component


class Station(NamedTuple):
    """The ground motion of a station, or a component that fits none."""

    motion: GroundMotion
    files: list[str]
    components: int


def stations_of(
    parts: Sequence[Part], along: str | SupportsFloat | None, common_length: bool
) -> tuple[list[Station], list[tuple[str, str]]]:
    """The stations, in order of their first components, and what stays alone: file and reason."""
    axis = "" if along is None else direction(along, "along", "Suite.read")
    groups: dict[tuple[object, ...], list[Part]] = {}
    for i, part in enumerate(map(_pointed, parts)):
        known = part.component.motion.orientation
        groups.setdefault(_station_of(part) if known else (i,), []).append(part)

    found: list[Station] = []
    alone: list[tuple[str, str]] = []
    for group in groups.values():
        answer = _station(group, axis, common_length)
        if isinstance(answer, Station):
            found.append(answer)
            continue
        for part in group:
            found.append(Station(part.component.motion, [part.file], 1))
            alone.append((part.file, answer))
    return found, alone


def _station(group: Sequence[Part], axis: str, common_length: bool) -> Station | str:
    """One motion of all components of a group, or why there is none."""
    if not group[0].component.motion.orientation:
        return "neither the file nor its name says where it points"
    if len(group) == 1:
        return "no other component of its station"
    try:
        motion = _core._station_motion(
            [part.component for part in group], [None] * len(group), axis, common_length
        )
    except ValueError as error:
        return str(error).removeprefix("read_station: ")
    return Station(motion, list(dict.fromkeys(part.file for part in group)), len(group))


def _pointed(part: Part) -> Part:
    """The component with the orientation in the name of its file, where the file states none."""
    motion = part.component.motion
    ending = _ENDING.fullmatch(os.path.splitext(_place(part.file)[2])[0])
    if motion.orientation or ending is None:
        return part
    station, orientation = ending[1] or ending[3], ending[2] or ending[4]
    pointed = _core._ground_motion(
        motion.acceleration,
        **({"times": motion.time} if motion.dt is None else {"dt": motion.dt}),
        interpolation=motion.interpolation,
        name=f"{station}, {orientation}",
        orientation=orientation,
    )
    return part._replace(component=part.component._replace(motion=pointed, name=orientation))


def _station_of(part: Part) -> tuple[object, ...]:
    """What the components of one station have in common."""
    archive, folder, _ = _place(part.file)
    name = part.component.name
    # KiK-net: 1 to 3 are in the borehole, 4 to 6 at the surface.
    sensor = "borehole" if name in ("1", "2", "3") else ""
    station = part.component.motion.name.removesuffix(f", {name}")
    return archive, folder, station, sensor, part.component.start


def _place(file: str) -> tuple[str, str, str]:
    """Archive, folder and name of a file."""
    archive, _, member = file.rpartition("::")
    return archive, *os.path.split(member)
