"""Earthquake records from files: plain text, compressed, in an archive, or what ObsPy reads."""

from __future__ import annotations

import errno
import os
import stat
import sys
import threading
from collections.abc import Callable, Iterable, Sequence
from operator import index
from typing import Any, Literal, NamedTuple, SupportsFloat, SupportsIndex, TypeAlias, overload

from . import _core
from ._core import GroundMotion

_File: TypeAlias = "str | bytes | os.PathLike[str] | os.PathLike[bytes]"

__all__ = ["read_record", "read_station", "record_formats"]


class Component(NamedTuple):
    """One component of a record, with what its file states."""

    motion: GroundMotion
    name: str  # in the file; empty where it has none
    start: str  # when it begins, in the words of the file; empty where it does not say
    units: str  # of the acceleration in the file; empty where it states none


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
        The file; one compressed by gzip; a zip or tar archive of one file (``.zip``, ``.tar``,
        ``.tar.gz``); ``"archive.zip::member"``, a file in an archive; ``"-"``, standard input.
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
    found = read_components(file, units, wanted, dt, gaps, only_one=component != "all")
    motions = [one.motion for one in found]
    for motion in motions:
        _core._warn_if_implausible(motion, "read_record", 2)
    return motions if component == "all" else motions[0]


def read_station(
    files: _File | Iterable[_File],
    *,
    along: str | SupportsFloat | None = None,
    component: str | SupportsIndex | None = None,
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
        One file with all components, or several; each as `read_record` takes it. An archive of
        several files stands for all of them. Together they have one or two horizontal components
        and at most one vertical component.
    along : str or float, optional
        Where the axis points: the name or orientation of a horizontal component, or any azimuth
        [degrees clockwise from north]. The first horizontal component if not given.
    component : str or int, optional
        The horizontal component along which the axis points, as `read_record` takes it: its name,
        or its number from 1 among all components in the order of the files. Not with `along`,
        where a number is an azimuth.
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
        time steps, starts or lengths; `component` that names none, several or a vertical one, or
        is given with `along`.

    Warns
    -----
    PlausibilityWarning
        As `read_record`, of the axis.
    """
    paths = [files] if isinstance(files, str | bytes | os.PathLike) else list(files)
    components = [
        part
        for path in paths
        for file in files_in(path, units=units, dt=dt, gaps=gaps)
        for part in file.read()
    ]
    given = [None] * len(components) if orientations is None else list(orientations)
    if len(given) != len(components):
        raise ValueError(
            f"read_station: orientations must be as many as components, {len(components)},"
            f" got {len(given)}"
        )
    directions = [None if one is None else direction(one, "orientations") for one in given]
    if component is not None and along is not None:
        raise ValueError("read_station: along and component must not both be given")
    axis = "" if along is None else direction(along, "along")
    if component is not None:
        axis = _axis_of(components, directions, component)
    motion = _core._station_motion(components, directions, axis, common_length)
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


def _axis_of(
    components: Sequence[Component],
    directions: Sequence[str | None],
    chosen: str | SupportsIndex,
) -> str:
    """The orientation of the component of that name or number, which must be horizontal."""
    names = [one.name for one in components]
    known = ", ".join(f"{i} {name}".strip() for i, name in enumerate(names, 1))
    places = _chosen(names, chosen)
    if not places:
        raise ValueError(
            "read_station: component must be the name or number of one component, available:"
            f" {known}; got {chosen!r}"
        )
    place = places[0]
    orientation = directions[place] or components[place].motion.orientation
    if not orientation or _core._azimuth_of(orientation) is None:
        raise ValueError(
            "read_station: component must be a horizontal one, but"
            f" {place + 1} {names[place]}".rstrip()
            + (f" points {orientation!r}" if orientation else " does not say where it points")
        )
    return orientation


def _chosen(names: Sequence[str], wanted: str | SupportsIndex) -> list[int]:
    """The place of the one component of that name, else of that number from 1; or none."""
    text = wanted if isinstance(wanted, str) else str(index(wanted))
    named = [i for i, name in enumerate(names) if name.lower() == text.lower()]
    found = named or [i for i in range(len(names)) if str(i + 1) == text]
    return found if len(found) == 1 else []


def direction(value: str | SupportsFloat, name: str, who: str = "read_station") -> str:
    """Where an axis points, as text."""
    if isinstance(value, str):
        if not value.strip():
            raise ValueError(f"{who}: {name} must not be empty, got {value!r}")
        return value
    number = float(value)
    if not abs(number) < float("inf"):
        raise ValueError(f"{who}: {name} must be a finite azimuth, got {number} degrees")
    return f"{number:.12g}"


def read_components(
    file: _File,
    units: str | None,
    component: str | SupportsIndex | None,
    dt: SupportsFloat | None,
    gaps: bool,
    only_one: bool = False,
) -> list[Component]:
    """The components of a file that are meant; see `read_record`."""
    wanted = None if component is None else _text(component)
    shown = _shown(file)
    return _parsed(_unpacked(*_stored(shown), shown), shown, units, wanted, dt, gaps, only_one)


def _parsed(
    content: bytes,
    shown: str,
    units: str | None,
    wanted: str | None,
    dt: SupportsFloat | None,
    gaps: bool,
    only_one: bool,
) -> list[Component]:
    options = (units or "", wanted or "", None if dt is None else float(dt), gaps, only_one)
    try:
        parts = _core._parse_components(content, os.fsencode(shown), *options)
        return [Component(*part) for part in parts]
    except ValueError:
        # A format of columns has no reference: it takes whatever has a number.
        known = _core._record_format(content)
        stream = None if known and known["reference"] else _by_obspy(content)
        if stream is None:
            raise
    return _of_stream(stream, shown, units, wanted, only_one)


# ---- what holds the text


class File(NamedTuple):
    """A file, or one in an archive, which `read` reads."""

    shown: str  # its name, as `read_record` takes it
    read: Callable[[], list[Component]]


def files_in(
    file: _File,
    *,
    units: str | None,
    dt: SupportsFloat | None,
    gaps: bool,
    component: str | SupportsIndex | None = None,
    only_one: bool = False,
) -> list[File]:
    """The files that one stands for: itself, or all in an archive of several.

    The archive is opened once; each file in it is unpacked where it is read.
    """
    shown = _shown(file)
    content, members = _stored(shown)
    content = _gunzipped(content, shown)
    wanted = None if component is None else _text(component)

    def whole() -> list[Component]:
        unpacked = _unpacked(content, members, shown)
        return _parsed(unpacked, shown, units, wanted, dt, gaps, only_one)

    archive = None if members else _archive(content, shown)
    if archive is None or len(archive.names) <= 1:
        return [File(shown, whole)]

    def reader(name: str) -> Callable[[], list[Component]]:
        inside = f"{shown}::{name}"

        def read() -> list[Component]:
            unpacked = _unpacked(archive.read(name), [], inside)
            return _parsed(unpacked, inside, units, wanted, dt, gaps, only_one)

        return read

    return [File(f"{shown}::{name}", reader(name)) for name in archive.names]


def _text(component: str | SupportsIndex) -> str:
    return component if isinstance(component, str) else str(index(component))


def _shown(file: _File) -> str:
    try:
        return os.fsdecode(file)
    except TypeError:
        raise TypeError(f"read_record: file must be a string or a path, got {file!r}") from None


def _stored(shown: str) -> tuple[bytes, list[str]]:
    """The bytes of a file as they are stored, and the members that ``::`` names in it."""
    if shown == "-":
        return sys.stdin.buffer.read(), []
    path = shown
    members: list[str] = []
    while "::" in path and not os.path.lexists(path):
        path, _, member = path.rpartition("::")
        members.insert(0, member)
    if not stat.S_ISREG(mode := os.stat(path).st_mode) and not stat.S_ISDIR(mode):
        # a pipe or a device may never end
        raise OSError(errno.ENOTSUP, os.strerror(errno.ENOTSUP), path)
    with open(path, "rb") as stream:
        return stream.read(), members


_DEEPEST = 4  # archives within archives, of which nobody has made more


def _unpacked(content: bytes, members: Sequence[str], shown: str) -> bytes:
    """The one file that is meant, out of what it is packed in."""
    left = list(members)
    for _ in range(_DEEPEST):
        content = _gunzipped(content, shown)
        archive = _archive(content, shown)
        if archive is None:
            break
        names = archive.names
        member = left.pop(0) if left else names[0] if len(names) == 1 else None
        if member is None or member not in names:
            known = ", ".join(names[:12]) + (", ..." if len(names) > 12 else "")
            which = "name one as archive.zip::member" if member is None else "no such member"
            raise ValueError(
                f"read_record: {shown}: {which}; the archive holds {len(names)} files: {known}"
            )
        content = archive.read(member)
    if left:
        path = shown[: -len("::" + "::".join(left))]
        raise ValueError(f"read_record: {shown}: {path} is not a zip archive, nor a tar archive")
    return content


class _Archive(NamedTuple):
    names: list[str]  # of the files in it
    read: Callable[[str], bytes]


def _archive(content: bytes, shown: str) -> _Archive | None:
    """What a zip or tar archive holds; None for any other file."""
    import io
    import tarfile
    import zipfile

    is_zip = content.startswith((b"PK\x03\x04", b"PK\x05\x06"))
    if not is_zip and content[257:262] != b"ustar":
        return None
    damaged = (
        *(zipfile.BadZipFile, tarfile.TarError, RuntimeError, NotImplementedError),
        *(EOFError, OSError, ValueError),
    )

    def guarded(work: Callable[[], Any]) -> Any:
        try:
            return work()
        except damaged as error:
            raise ValueError(f"read_record: {shown}: {error}") from None

    stream = io.BytesIO(content)
    if is_zip:
        archive = guarded(lambda: zipfile.ZipFile(stream))
        names = [one.filename for one in archive.infolist() if not one.is_dir()]
        read = archive.read
    else:
        # Members are read and never unpacked into the file system: their names need no filter.
        tar = guarded(lambda: tarfile.TarFile(fileobj=stream))
        names = [one.name for one in guarded(tar.getmembers) if one.isfile()]

        def read(name: str) -> bytes:
            file = tar.extractfile(name)
            assert file is not None  # it is a file
            return bytes(file.read())

    macs = [n for n in names if n.startswith("__MACOSX/") or n.rpartition("/")[2].startswith("._")]
    return _Archive([n for n in names if n not in macs], lambda name: guarded(lambda: read(name)))


def _gunzipped(content: bytes, shown: str) -> bytes:
    """What a gzip file holds; any other as it is."""
    if not content.startswith(b"\x1f\x8b"):
        return content
    import gzip
    import zlib

    try:
        for _ in range(2):  # no more layers: there are files that unpack to themselves
            if content.startswith(b"\x1f\x8b"):
                content = gzip.decompress(content)
        return content
    except (OSError, EOFError, zlib.error) as error:
        raise ValueError(f"read_record: {shown}: damaged gzip file: {error}") from None


# ---- what ObsPy reads


# One thread at a time: two that leave `catch_warnings` in the order in which they entered it leave
# all warnings silenced.
_OBSPY = threading.Lock()


def _by_obspy(content: bytes) -> Any:
    """The stream in a file, or None where ObsPy is not installed or does not know it either."""
    import importlib
    import io
    import warnings

    with _OBSPY, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            return importlib.import_module("obspy").read(io.BytesIO(content))
        except Exception:  # of any reader that had a look
            return None


def _of_stream(
    stream: Any, shown: str, units: str | None, wanted: str | None, only_one: bool
) -> list[Component]:
    who = f"read_record: {shown}"
    names = [trace.stats.channel or trace.id for trace in stream]
    places = list(range(len(names)))
    if wanted is not None:
        places = _chosen(names, wanted)
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


def _of_trace(trace: Any, units: str) -> Component:
    code = trace.stats.channel
    orientation = {"N": "N", "E": "E", "Z": "up"}.get(code[-1:], "") if len(code) == 3 else ""
    motion = _core.GroundMotion(
        trace.data, trace.stats.delta, units=units, name=trace.id, orientation=orientation
    )
    return Component(motion, code, str(trace.stats.starttime), "")
