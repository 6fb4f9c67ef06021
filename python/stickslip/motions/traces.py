"""Traces and streams of ObsPy: which hold acceleration, in which unit, in which direction."""

from __future__ import annotations

import re
import threading
from collections.abc import Iterable
from typing import Any, TypeAlias

from .. import _core
from .._core import GroundMotion
from .records import Component, changed, selected

_Trace: TypeAlias = Any  # of ObsPy, as are streams

__all__ = ["components_of", "in_file", "motion_of", "read_by_obspy"]

# How often an instrument integrates the acceleration, by the second letter of SEED's channel codes:
# accelerometers and gravimeters; high-gain seismometers and geophones. The low-gain ones, L, are
# seismometers or, in older networks, accelerometers.
_INSTRUMENTS = {"N": 0, "G": 0, "H": 1, "P": 1}
_OUTPUTS = {"ACC": 0, "VEL": 1, "DISP": 2}  # of `remove_response`
_SAC = {6: 2, 7: 1, 8: 0}  # `idep`
_WORDS = {0: "acceleration", 1: "velocity", 2: "displacement"}
_NO_UNITS = ("ASCII", "FLOAT", "INTEGER", "UNKNOWN")  # the word before, where there is no unit
_COUNTS = re.compile("counts?", re.IGNORECASE)
_OTHER_CALIB = ("CSS", "GSE1", "GSE2", "SAC")  # calib is no acceleration per count there
_WHAT_TO_DO = (
    'remove the response of the instrument, trace.remove_response(inventory, output="ACC"); or, if'
    " you know that these are accelerations, use GroundMotion(trace.data, trace.stats.delta)"
)


def motion_of(source: Any, units: str | None = None, name: str | None = None) -> GroundMotion:
    """The ground motion of a trace or a stream; see `GroundMotion.from_obspy`."""
    traces = list(getattr(source, "traces", [source]))
    for trace in traces:
        if not hasattr(trace, "data") or not hasattr(trace, "stats"):
            raise TypeError(
                f"GroundMotion: from_obspy needs one obspy Trace, got {type(trace).__name__}; or a"
                " Stream of the traces of one station"
            )
    try:
        parts = components_of(traces, units)
        motion = (
            parts[0].motion
            if len(parts) == 1
            else _core._station_motion(parts, [None] * len(parts), "", False)
        )
    except ValueError as error:
        reason = str(error).removeprefix("read_station: ")
        raise ValueError(f"GroundMotion.from_obspy: {reason}") from None
    return motion if name is None else changed(motion, name=name)


def components_of(
    traces: Iterable[_Trace], units: str | None, default: str | None = "m/s^2"
) -> list[Component]:
    """The components of traces, each of another channel.

    Parameters
    ----------
    units : str, optional
        Unit of acceleration, which must agree with the one that a trace states.
    default : str, optional
        Unit of traces that state none, if `units` is None.

    Raises
    ------
    ValueError
        Segments of one channel, a gap, velocity, displacement, counts, other units, or none.
    """
    listed = list(traces)
    _require_one_segment(listed)
    return [_component(trace, units, default) for trace in listed]


def in_file(
    stream: Any,
    shown: str,
    units: str | None,
    default: str | None,
    wanted: str | None,
    only_one: bool,
) -> list[Component]:
    """The components that are meant, in a file that ObsPy read; see `read_record`."""
    who = f"read_record: {shown}"
    names = [trace.stats.channel or trace.id for trace in stream]
    try:
        _require_one_segment(stream)
        places = selected(names, wanted, only_one)
        return components_of([stream[i] for i in places], units, default)
    except ValueError as error:
        raise ValueError(f"{who}: {error}") from None


# One thread at a time: two that leave `catch_warnings` in the order in which they entered it leave
# all warnings silenced.
_OBSPY = threading.Lock()


def read_by_obspy(content: bytes) -> Any:
    """The ObsPy stream in a file; None if ObsPy is not installed or cannot read the file."""
    import importlib
    import io
    import warnings

    with _OBSPY, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            return importlib.import_module("obspy").read(io.BytesIO(content))
        except Exception:  # from any of its readers
            return None


def _component(trace: _Trace, units: str | None, default: str | None) -> Component:
    stats, name = trace.stats, str(trace.id)
    code = str(getattr(stats, "channel", ""))
    stated, removed = _unit_of(stats), _response_is_removed(stats)
    _require_acceleration(trace, code, stated)
    if removed or _COUNTS.fullmatch(stated):
        stated = ""  # of what was recorded
    if units and stated and _core.acceleration_unit(units) != _core.acceleration_unit(stated):
        raise ValueError(f"{name}: the trace states the unit {stated!r}, got units={units!r}")
    unit: Any = stated or units or default
    if unit is None:
        raise ValueError(
            'ObsPy reads this file and does not state its units: pass units, such as "g" or "m/s^2"'
        )
    _require_no_gap(trace)
    samples = trace.data if removed or stated else _calibrated(trace)
    motion = _core._ground_motion(
        samples, float(stats.delta), units=unit, name=name, orientation=_core._orientation_in(code)
    )
    return Component(motion, code, str(getattr(stats, "starttime", "")), stated)


def _steps(stats: Any) -> list[tuple[str, str]]:
    """Names and arguments of the methods of ObsPy that made the trace what it is."""
    said = map(str, getattr(stats, "processing", ()))
    found = (re.search(r": (\w+)\((.*)", one, re.DOTALL) for one in said)
    return [(step[1], step[2]) for step in found if step]


def _response_is_removed(stats: Any) -> bool:
    return any(
        name in ("remove_response", "remove_sensitivity")
        or (name == "simulate" and "paz_remove=None" not in arguments)
        for name, arguments in _steps(stats)
    )


def _unit_of(stats: Any) -> str:
    """The unit in the header of SLIST and TSPAIR files; empty if there is none."""
    unit = str(getattr(getattr(stats, "ascii", None), "unit", "")).strip()
    return "" if unit.upper() in _NO_UNITS else unit


def _require_acceleration(trace: _Trace, code: str, stated: str) -> None:
    """Refuse what the header, the channel or the processing tells to be no acceleration."""
    stats, removed = trace.stats, _response_is_removed(trace.stats)
    integrals = _INSTRUMENTS.get(code[1].upper()) if len(code) == 3 else None
    why = f"the channel {code} is that of such an instrument"
    sensor = integrals
    if not removed:
        if stated and not _COUNTS.fullmatch(stated):
            _require_acceleration_unit(trace, stated)
            integrals = 0
        elif (idep := getattr(getattr(stats, "sac", None), "idep", None)) in _SAC:
            integrals, why = _SAC[idep], f"its header says idep = {idep}"
    unknown = integrals is None
    total = integrals or 0
    for method, arguments in _steps(stats):
        if method == "remove_response":
            output = re.search(r"\boutput='(\w+)'", arguments)
            known = _OUTPUTS.get(output[1].upper() if output else "VEL", sensor)
            unknown, total = known is None, known or 0
            why = f"remove_response had the output {output[1] if output else 'VEL'}"
        elif method in ("integrate", "differentiate"):
            total += 1 if method == "integrate" else -1
            why = f"{method} was the last to change it"
    if unknown and removed:
        raise ValueError(
            f"{trace.id}: may be velocity: the channel {code!r} does not tell what the instrument"
            f" measures; {_WHAT_TO_DO}"
        )
    if total > 0 or (total < 0 and not unknown):
        what = _WORDS.get(total, "no acceleration")
        raise ValueError(f"{trace.id}: {what}, not acceleration: {why}; {_WHAT_TO_DO}")


def _require_acceleration_unit(trace: _Trace, stated: str) -> None:
    try:
        _core.acceleration_unit(stated)
    except ValueError:
        raise ValueError(
            f"{trace.id}: its header states the unit {stated!r}, which is none of acceleration;"
            f" {_WHAT_TO_DO}"
        ) from None


def _calibrated(trace: _Trace) -> Any:
    """The samples of a trace whose response was not removed, counts times their calibration."""
    data, calib = trace.data, float(getattr(trace.stats, "calib", 1.0))
    kind = getattr(getattr(data, "dtype", None), "kind", "f")
    is_counts = kind in "iu" or bool(_COUNTS.fullmatch(_unit_of(trace.stats)))
    if calib == 1:
        if is_counts:
            raise ValueError(f"{trace.id}: counts, and calib is 1; {_WHAT_TO_DO}")
        return data
    form = getattr(trace.stats, "_format", "")
    if form in _OTHER_CALIB or not (is_counts or (data % 1 == 0).all()):
        meaning = (
            f"in {form} files this is no acceleration per count"
            if form in _OTHER_CALIB
            else "the samples are no whole numbers: they may have been multiplied by it"
        )
        raise ValueError(
            f"{trace.id}: calib is {calib:g}, and {meaning}; give accelerations, with"
            " trace.stats.calib = 1"
        )
    return data * calib


def _require_no_gap(trace: _Trace) -> None:
    """Refuse masked samples, which ObsPy puts where a merged trace has a gap."""
    mask: Any = getattr(trace.data, "mask", None)
    if mask is None or not mask.any():
        return
    first = int(mask.argmax())
    length = int((~mask[first:]).argmax()) or len(mask) - first
    start, delta = getattr(trace.stats, "starttime", 0), float(trace.stats.delta)
    raise ValueError(
        f"{trace.id}: a gap, masked value at index {first}: from {start + delta * first} to"
        f" {start + delta * (first + length - 1)}; stream.split() gives the parts, and"
        ' stream.merge(fill_value="interpolate") fills a short one'
    )


def _require_one_segment(traces: Iterable[_Trace]) -> None:
    """Refuse several traces of one channel, between which there is a gap or an overlap."""
    seen: dict[str, Any] = {}
    for trace in traces:
        if not getattr(trace.stats, "channel", ""):
            continue  # it has no name
        other: Any = seen.setdefault(str(trace.id), trace)
        if other is not trace:
            times = " and from ".join(
                f"{one.stats.starttime} to {one.stats.endtime}" for one in (other, trace)
            )
            raise ValueError(
                f"{trace.id}: two segments, from {times}; stream.merge() joins them,"
                " stream.select() or stream.trim() chooses one"
            )
