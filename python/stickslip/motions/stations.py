"""Which components of records belong to one station."""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from typing import NamedTuple, SupportsFloat

from .. import _core
from .._core import GroundMotion
from .records import Component, changed, direction

__all__ = ["Part", "Station", "records_of_names", "stations_of"]

# What a file name may end in: an azimuth, or letters after a mark; KOBE_NIS000, NIS-UP, CPM_090.
_ENDING = re.compile(
    r"(.*?)(?:(?<=[A-Za-z])|[-_. ])([0-3]\d\d)"
    r"|(.+?)[-_. ](N|E|S|W|NS|EW|UD|UP|DN|DWN|V|VER|VERT|Z|H1|H2)",
    re.IGNORECASE,
)
_NUMBERED = re.compile(r"[A-Z][HLGNM]([12])(?:\d\d)?")
_LONELY = "no other component of its station"
# Two perpendicular horizontal components without an azimuth, and the angles that combine them.
_UNNAMED = {"H1": "0", "H2": "90"}


class Part(NamedTuple):
    """A component of a file."""

    file: str
    number: int  # in the file, from 1
    component: Component


class Station(NamedTuple):
    """The ground motion of a station, or a component that fits none."""

    motion: GroundMotion
    parts: list[Part]
    reason: str = ""  # why a component fits none

    @property
    def files(self) -> list[str]:
        return list(dict.fromkeys(part.file for part in self.parts))

    @property
    def is_lonely(self) -> bool:
        """Whether this component would fit others, but there are none."""
        return self.reason == _LONELY

    @property
    def is_vertical(self) -> bool:
        """Whether this is a vertical component alone."""
        return len(self.parts) == 1 and self.parts[0].component.is_vertical


def stations_of(
    parts: Sequence[Part],
    along: str | SupportsFloat | None = None,
    common_length: bool = False,
    who: str = "Suite.read",
    together: bool = False,
) -> list[Station]:
    """The stations, and the components that fit none, in order of their first components.

    With `together`, all components belong to one station.
    """
    axis = "" if along is None else direction(along, "along", who)
    groups: dict[tuple[object, ...], list[Part]] = {}
    for i, part in enumerate(map(_pointed, parts)):
        known = part.component.motion.orientation or _unnamed(part)
        key = () if together else _station_of(part) if known else (i,)
        groups.setdefault(key, []).append(part)

    found: list[Station] = []
    for group in groups.values():
        answer = _station(group, axis, common_length)
        if isinstance(answer, Station):
            found.append(answer)
        else:
            found += [Station(part.component.motion, [part], answer) for part in group]
    return found


def records_of_names(names: Sequence[str]) -> list[str]:
    """The records of components by their names: a station's two perpendicular ones are one record.

    Two names that differ in an azimuth by 90 degrees, or in N and E, at their end.
    """
    ends = [_ENDING.fullmatch(name.replace(", ", " ")) for name in names]
    groups: dict[str, list[int]] = {}
    for i, end in enumerate(ends):
        if end is not None:
            groups.setdefault(end[1] or end[3], []).append(i)
    found = list(names)
    for station, group in groups.items():
        said = [(ends[i][2] or ends[i][4]).upper() for i in group]  # type: ignore[index]
        if len(group) == 2 and _are_perpendicular(*said):
            for i in group:
                found[i] = station
    return found


def _are_perpendicular(one: str, other: str) -> bool:
    if one.isdigit() and other.isdigit():
        return (int(one) - int(other)) % 180 == 90
    return {one, other} in ({"N", "E"}, {"NS", "EW"}, {"H1", "H2"})


def _station(group: Sequence[Part], axis: str, common_length: bool) -> Station | str:
    """One motion of all components of a group, or why there is none."""
    if len(group) == 1:
        if not group[0].component.motion.orientation:
            return "neither the file nor its name says where it points"
        return _LONELY
    unnamed = [_unnamed(part) for part in group]
    if any(unnamed) and _core._azimuth_of(axis) is not None:
        return f"along {axis} needs azimuths, but H1 and H2 state none"
    try:
        motion = _core._station_motion(
            [part.component for part in group], [_UNNAMED.get(h) for h in unnamed], axis,
            common_length,
        )  # fmt: skip
    except ValueError as error:
        return str(error).removeprefix("read_station: ")
    if any(unnamed):
        along = "H1" if motion.orientation == "0" else "H2"
        name = motion.name.removesuffix(f", {motion.orientation}")
        motion = changed(motion, name=f"{name}, {along}", orientation=along)
    return Station(motion, list(group))


def _unnamed(part: Part) -> str:
    """H1 or H2 for a horizontal component without an azimuth, otherwise nothing.

    SEED numbers such channels 1 and 2: BH1, HN2, also with their location, BH100.
    """
    name = part.component.name.upper()
    if channel := _NUMBERED.fullmatch(name):
        name = f"H{channel[1]}"
    return name if name in _UNNAMED and not part.component.motion.orientation else ""


def _pointed(part: Part) -> Part:
    """The component with the orientation in the name of its file, where the file states none."""
    motion, name = part.component.motion, part.component.name
    ending = _ENDING.fullmatch(os.path.splitext(_place(part.file)[2])[0])
    if name or ending is None:  # the file names the component, or nothing does
        return part
    station, said = ending[1] or ending[3], ending[2] or ending[4]
    orientation = motion.orientation or ("" if said.upper() in _UNNAMED else said)
    pointed = changed(motion, name=f"{station}, {said}", orientation=orientation)
    return part._replace(component=part.component._replace(motion=pointed, name=said))


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
