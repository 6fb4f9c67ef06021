"""Events of SimCenter: JSON files with time series, and the directions in which they act."""

from __future__ import annotations

import json
from typing import Any, SupportsFloat

from .. import _core
from .records import Component, selected

__all__ = ["components_of"]

_ORIENTATIONS = {3: "up"}  # directions 1 and 2 are horizontal, without an azimuth
_NAMES = {1: "H1", 2: "H2", 3: "UP"}


def components_of(
    content: bytes,
    shown: str,
    units: str | None,
    default: str | None,
    wanted: str | None,
    only_one: bool,
    dt: SupportsFloat | None,
) -> list[Component]:
    """The components that are meant, of the one event in a file; see `read_record`."""
    try:
        event = _event(content)
        series = {str(one["name"]): one for one in event["timeSeries"]}
        patterns = event["pattern"]
        names = [_NAMES[pattern["dof"]] for pattern in patterns]
        found = [(pattern, series[str(pattern["timeSeries"])]) for pattern in patterns]
    except (KeyError, TypeError, RecursionError, UnicodeDecodeError, json.JSONDecodeError) as error:
        raise ValueError(
            f"read_record: {shown}: no event of SimCenter, which has timeSeries and pattern:"
            f" {type(error).__name__}: {error}"
        ) from None
    try:
        stated = _unit_of(event)
        if units and stated and _core.acceleration_unit(units) != _core.acceleration_unit(stated):
            raise ValueError(f"the file states the unit {stated!r}, got units={units!r}")
        unit: Any = stated or units or default
        if unit is None:
            raise ValueError(
                "the file states no units of acceleration, its units of length and time are those"
                ' of a model: pass units, such as "g" or "m/s^2"'
            )
        motions = []
        for i in selected(names, wanted, only_one):
            pattern, values = found[i]
            motion = _motion(pattern, values, unit, f"{event.get('name', '')}, {names[i]}")
            if dt is not None and float(dt) != motion.dt:
                raise ValueError(f"the file states a time step of {motion.dt} s, got dt={dt}")
            motions.append(Component(motion, names[i], "", stated))
        return motions
    except (TypeError, ValueError) as error:
        raise ValueError(f"read_record: {shown}: {error}") from None


def _event(content: bytes) -> Any:
    document = json.loads(content)
    events = document.get("Events", [document])
    if len(events) != 1:
        raise TypeError(f"holds {len(events)} events")
    return events[0]


def _unit_of(event: Any) -> str:
    """The unit of acceleration that an event states; empty if it states none."""
    units = event.get("units", "")
    return str(units.get("acceleration", "") if isinstance(units, dict) else units)


def _motion(pattern: Any, series: Any, unit: Any, name: str) -> _core.GroundMotion:
    kind = pattern.get("type", "UniformAcceleration")
    if kind != "UniformAcceleration":
        raise ValueError(f"{name}: expected UniformAcceleration, got {kind!r}")
    if not isinstance(series.get("data"), list) or series.get("type", "Value") != "Value":
        raise ValueError(f"{name}: the series has no list of values as data")
    motion = _core._ground_motion(
        series["data"],
        series.get("dT"),
        units=unit,
        name=name.removeprefix(", "),
        orientation=_ORIENTATIONS.get(pattern["dof"], ""),
    )
    factor = float(series.get("factor", 1)) * float(pattern.get("factor", 1))
    return motion if factor == 1 else motion.scaled(factor)
