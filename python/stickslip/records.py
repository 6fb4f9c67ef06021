"""Earthquake records from files: plain text, compressed, in archives, or as read by ObsPy."""

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
_Component: TypeAlias = "tuple[GroundMotion, str, str]"  # with the name and start time in the file

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

    The content determines the format; `record_formats` lists the known ones. ObsPy reads all other
    files if it is installed, with `units` from the caller.

    A file of columns holds times [s] and one or several accelerations, or one acceleration with
    `dt`. Columns are separated by commas, semicolons, tabs or blanks; comments and labels may
    precede them. A comma is a decimal point if something else separates the columns. Byte-order
    marks and CRLF line ends are accepted. Evenly spaced times become a step dt and start at 0;
    uneven times are kept.

    Parameters
    ----------
    file : path-like
        A plain file; a gzip file; a zip archive of one file; ``"archive.zip::member"``, a file in
        an archive; or ``"-"``, standard input.
    units : str, optional
        Unit of acceleration if the file does not state one: 'g', 'm/s^2', 'cm/s^2', 'gal',
        'mm/s^2', 'ft/s^2', 'in/s^2'. An error if the file states another one.
    component : str or int, optional
        Name in the file, or number from 1, of the component to read from a file with several;
        ``"all"`` returns a list of all components.
    dt : float, optional
        Time step [s] of a file with one column. An error if the file states another one.
    gaps : bool, optional
        Accept gaps, time steps over ten times the median, as straight lines.

    Returns
    -------
    GroundMotion, or list of GroundMotion
        The acceleration [m/s^2], linear between samples. Its name consists of event, station and
        component, as far as the file states them; otherwise it is that of the file.
        `GroundMotion.orientation` is that in the file.

    Raises
    ------
    OSError
        The file is missing (FileNotFoundError), unreadable or not a regular file.
    ValueError
        Unknown format; velocity, displacement, spectra or raw counts; missing or unknown units; no
        time step; not exactly one component selected; text, NaN or infinity among the numbers; a
        number of samples that differs from the header; a time step that is not positive; times
        that do not increase; a gap. The message names the file and the line or value.

    Warns
    -----
    PlausibilityWarning
        The maximum or mean acceleration is implausible for a record in these units.
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

    which equals u at a = b1. The transverse component is that along a + 90 degrees; the vertical
    component is positive upward.

    Parameters
    ----------
    files : path-like or sequence of path-like
        One file with all components, or several files, each as for `read_record`. Together they
        hold one or two horizontal components and at most one vertical component.
    along : str or float, optional
        Direction of the axis: the name or orientation of a horizontal component, or any azimuth
        [degrees clockwise from north]. Default: the first horizontal component.
    orientations : sequence of str or float, optional
        Direction of each component, in order, which replaces that in the file: an azimuth, 'up', or
        None for that in the file.
    common_length : bool, optional
        Cut all components to the shortest one; otherwise different lengths are an error.
    units, dt, gaps
        As for `read_record`; they apply to all files.

    Returns
    -------
    GroundMotion
        With `orientation`, and with `transverse` and `vertical` if the files hold them.

    Raises
    ------
    OSError, ValueError
        As for `read_record`. Also ValueError: a component of unknown orientation; too many or too
        few components; horizontal components more than 10 degrees from perpendicular; different
        time steps, start times or lengths.

    Warns
    -----
    PlausibilityWarning
        As for `read_record`, about the component along the axis.
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
        For each format, its ``name``, the sources of its ``units`` and ``time_step``, a
        ``reference``, and the usual file ``extension``, which does not matter for reading.
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
        # Formats of columns have no reference: they accept any file with numbers.
        known = _core._record_format(content)
        stream = None if known and known["reference"] else _by_obspy(content)
        if stream is None:
            raise
    return _of_stream(stream, shown, units, wanted, only_one)


# ---- containers


def _content(file: _File) -> tuple[bytes, str]:
    """The uncompressed bytes of a file, and its name for messages."""
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


# ---- ObsPy


def _by_obspy(content: bytes) -> Any:
    """The ObsPy stream in a file; None if ObsPy is not installed or cannot read the file."""
    import importlib
    import io
    import warnings

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            return importlib.import_module("obspy").read(io.BytesIO(content))
        except Exception:  # from any of its readers
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
