"""Earthquake records from files: plain text, compressed, in an archive, or what ObsPy reads."""

from __future__ import annotations

import errno
import os
import stat
import sys
from collections.abc import Iterable, Sequence
from operator import index
from typing import Any, Literal, SupportsFloat, SupportsIndex, TypeAlias, overload

from . import _core
from ._core import GroundMotion

_File: TypeAlias = "str | bytes | os.PathLike[str] | os.PathLike[bytes]"
_Component: TypeAlias = "tuple[GroundMotion, str, str]"  # with its name and start in the file

__all__ = ["read_record", "read_station", "record_formats"]


@overload
def read_record(
    file: _File,
    *,
    units: str | None = None,
    component: Literal["all"],
    dt: SupportsFloat | None = None,
    gaps: bool = False,
) -> list[GroundMotion]: ...
@overload
def read_record(
    file: _File,
    *,
    units: str | None = None,
    component: str | SupportsIndex | None = None,
    dt: SupportsFloat | None = None,
    gaps: bool = False,
) -> GroundMotion: ...
def read_record(
    file: _File,
    *,
    units: str | None = None,
    component: str | SupportsIndex | None = None,
    dt: SupportsFloat | None = None,
    gaps: bool = False,
) -> GroundMotion | list[GroundMotion]:
    """Read a strong-motion record.

    The format is told by the content; `record_formats` lists those that are known. What none of
    them fits is read by ObsPy where that is installed, with `units` from the caller.

    Columns of numbers are seconds and one or several accelerations, or acceleration alone with
    `dt`; parted by a comma, a semicolon, a tab or blanks, with any comments and labels before.
    Where columns are parted by something else a comma is a decimal point. Byte-order marks and
    CRLF line ends are fine. Even times become a step dt and start at 0; uneven times are kept.

    Parameters
    ----------
    file : path-like
        The file; one compressed by gzip; a zip archive of one file; ``"archive.zip::member"``, a
        file in an archive; ``"-"``, standard input.
    units : str, optional
        Unit of acceleration where the file does not state one: 'g', 'm/s^2', 'cm/s^2', 'gal',
        'mm/s^2', 'ft/s^2', 'in/s^2'. Refused if the file states another.
    component : str or int, optional
        Where the file has several: the name in the file, or the number from 1; ``"all"`` for a
        list of all of them.
    dt : float, optional
        Time between samples [s], of a file of one column. Refused if the file states another.
    gaps : bool, optional
        Whether to keep a gap, a time step over ten times the median one, as a straight line.

    Returns
    -------
    GroundMotion, or list of GroundMotion
        The acceleration [m/s^2], linear between samples, named after event, station and component
        as far as the file says; else after the file. `GroundMotion.orientation` is that of the
        file.

    Raises
    ------
    OSError
        The file is missing (FileNotFoundError), unreadable or not a regular file.
    ValueError
        Naming the file and the line or value: no known format; velocity, displacement, spectra or
        raw counts; no or unknown units; no time step; other than one component meant; text, NaN
        or infinity among the numbers; another count of samples than the header states; a time
        step that is not positive; times that do not increase; a gap.

    Warns
    -----
    PlausibilityWarning
        The largest acceleration, or the mean, is none of a record in these units.
    """
    wanted = None if component is None or component == "all" else component
    found = _read(file, units, wanted, dt, gaps, only_one=component != "all")
    motions = [motion for motion, _, _ in found]
    for motion in motions:
        _core._warn_if_implausible(motion, "read_record", 2)
    return motions if component == "all" else motions[0]


def read_station(
    files: _File | Iterable[_File],
    *,
    along: str | SupportsFloat | None = None,
    orientations: Sequence[str | SupportsFloat | None] | None = None,
    common_length: bool = False,
    units: str | None = None,
    dt: SupportsFloat | None = None,
    gaps: bool = False,
) -> GroundMotion:
    """Read the components of one station as one ground motion.

    With the horizontal components u along the azimuth b1 and w along b2, the motion along an
    azimuth a is

        n(a) = (u sin(b2 - a) + w sin(a - b1)) / sin(b2 - b1),

    which is u itself along b1. The transverse component is that along a + 90 degrees, the vertical
    one is positive upward.

    Parameters
    ----------
    files : path-like or sequence of path-like
        One file with all components, or several; each as `read_record` takes it. Together they
        have one or two horizontal components and at most one vertical component.
    along : str or float, optional
        Where the axis points: the name or orientation of a horizontal component, or any azimuth
        [degrees clockwise from north]. The first horizontal component if not given.
    orientations : sequence of str or float, optional
        Where each component points, in their order, instead of what the files say: azimuths,
        'up', or None to keep what the file says.
    common_length : bool, optional
        Cut all components to the shortest; otherwise different lengths are refused.
    units, dt, gaps
        As `read_record` takes them, for all files.

    Returns
    -------
    GroundMotion
        With `transverse` and `vertical` as far as they were recorded, and its `orientation`.

    Raises
    ------
    OSError, ValueError
        As `read_record`. Also ValueError: a component whose orientation is not known; other
        components than those; horizontal ones more than 10 degrees from perpendicular; different
        time steps, starts or lengths.

    Warns
    -----
    PlausibilityWarning
        As `read_record`, of the axis.
    """
    paths = [files] if isinstance(files, str | bytes | os.PathLike) else list(files)
    components = [part for path in paths for part in _read(path, units, None, dt, gaps)]
    given = [None] * len(components) if orientations is None else list(orientations)
    if len(given) != len(components):
        raise ValueError(
            f"read_station: orientations must be as many as components, {len(components)},"
            f" got {len(given)}"
        )
    motion = _core._station_motion(
        components,
        [None if one is None else _direction(one, "orientations") for one in given],
        "" if along is None else _direction(along, "along"),
        common_length,
    )
    _core._warn_if_implausible(motion, "read_station", 2)
    return motion


def record_formats() -> list[dict[str, str]]:
    """The formats that `read_record` knows, in the order in which it tries them.

    Returns
    -------
    list of dict
        Of each format its ``name``, where its ``units`` and ``time_step`` come from, a
        ``reference``, and the usual ``extension`` of file names, which is not looked at.
    """
    return _core._record_formats()


def _direction(value: str | SupportsFloat, name: str) -> str:
    if isinstance(value, str):
        if not value.strip():
            raise ValueError(f"read_station: {name} must not be empty, got {value!r}")
        return value
    number = float(value)
    if not abs(number) < float("inf"):
        raise ValueError(f"read_station: {name} must be a finite azimuth, got {number} degrees")
    return f"{number:.12g}"


def _read(
    file: _File,
    units: str | None,
    component: str | SupportsIndex | None,
    dt: SupportsFloat | None,
    gaps: bool,
    only_one: bool = False,
) -> list[_Component]:
    wanted = component if isinstance(component, str) else None
    if component is not None and wanted is None:
        wanted = str(index(component))  # type: ignore[arg-type]
    content, shown = _content(file)
    options = (units or "", wanted or "", None if dt is None else float(dt), gaps, only_one)
    try:
        return _core._parse_components(content, os.fsencode(shown), *options)
    except ValueError:
        # A format of columns has no reference: it takes whatever has a number.
        known = _core._record_format(content)
        stream = None if known and known["reference"] else _by_obspy(content)
        if stream is None:
            raise
    return _of_stream(stream, shown, units, wanted, only_one)


# ---- what holds the text


def _content(file: _File) -> tuple[bytes, str]:
    """The bytes of a file, out of what it is packed in; and its name for messages."""
    try:
        shown = os.fsdecode(file)
    except TypeError:
        raise TypeError(f"read_record: file must be a string or a path, got {file!r}") from None
    if shown == "-":
        return sys.stdin.buffer.read(), shown
    path, member = shown, None
    if "::" in shown and not os.path.lexists(shown):
        path, _, member = shown.rpartition("::")
    if not stat.S_ISREG(mode := os.stat(path).st_mode) and not stat.S_ISDIR(mode):
        # a pipe or a device may never end
        raise OSError(errno.ENOTSUP, os.strerror(errno.ENOTSUP), path)
    with open(path, "rb") as stream:
        content = stream.read()
    if member is not None and not _is_zip(content):
        raise ValueError(f"read_record: {shown}: {path} is not a zip archive")
    for _ in range(2):  # a compressed file in an archive
        if _is_zip(content):
            content = _unzipped(content, member, shown)
        elif content.startswith(b"\x1f\x8b"):
            content = _gunzipped(content, shown)
    return content, shown


def _is_zip(content: bytes) -> bool:
    return content.startswith((b"PK\x03\x04", b"PK\x05\x06"))


def _unzipped(content: bytes, member: str | None, shown: str) -> bytes:
    import io
    import zipfile

    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            names = [
                one.filename
                for one in archive.infolist()
                if not one.is_dir() and not one.filename.startswith("__MACOSX/")
            ]
            if member is None and len(names) == 1:
                member = names[0]
            if member not in names:
                known = ", ".join(names[:12]) + (", ..." if len(names) > 12 else "")
                which = "name one as archive.zip::member" if member is None else "no such member"
                raise ValueError(f"{which}; the archive holds {len(names)} files: {known}")
            return archive.read(member)
    except (zipfile.BadZipFile, RuntimeError, NotImplementedError, EOFError, ValueError) as error:
        raise ValueError(f"read_record: {shown}: {error}") from None


def _gunzipped(content: bytes, shown: str) -> bytes:
    import gzip
    import zlib

    try:
        return gzip.decompress(content)
    except (OSError, EOFError, zlib.error) as error:
        raise ValueError(f"read_record: {shown}: damaged gzip file: {error}") from None


# ---- what ObsPy reads


def _by_obspy(content: bytes) -> Any:
    """The stream in a file, or None where ObsPy is not installed or does not know it either."""
    import importlib
    import io
    import warnings

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            return importlib.import_module("obspy").read(io.BytesIO(content))
        except Exception:  # of any reader that had a look
            return None


def _of_stream(
    stream: Any, shown: str, units: str | None, wanted: str | None, only_one: bool
) -> list[_Component]:
    who = f"read_record: {shown}"
    names = [trace.stats.channel or trace.id for trace in stream]
    places = range(len(names))
    if wanted is not None:
        named = [i for i in places if names[i].lower() == wanted.lower()]
        places = named or [i for i in places if str(i + 1) == wanted]  # type: ignore[assignment]
    if len(places) != 1 and (only_one or wanted is not None):
        known = ", ".join(f"{i + 1} {name}" for i, name in enumerate(names))
        raise ValueError(
            f"{who}: select one component by name or number, available: {known};"
            f" got {wanted or ''!r}"
        )
    if units is None:
        raise ValueError(
            f"{who}: ObsPy reads this file and does not state its units: pass units, such as"
            ' "g" or "m/s^2"'
        )
    try:
        return [_of_trace(stream[i], units) for i in places]
    except ValueError as error:
        raise ValueError(f"{who}: {error}") from None


def _of_trace(trace: Any, units: str) -> _Component:
    code = trace.stats.channel
    orientation = {"N": "N", "E": "E", "Z": "up"}.get(code[-1:], "") if len(code) == 3 else ""
    motion = _core.GroundMotion(
        trace.data, trace.stats.delta, units=units, name=trace.id, orientation=orientation
    )
    return motion, code, str(trace.stats.starttime)
