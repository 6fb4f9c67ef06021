"""Earthquake records from files: plain text, compressed, in archives, or as read by ObsPy."""

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
        A plain file; a gzip file; a zip or tar archive of one file (``.zip``, ``.tar``,
        ``.tar.gz``); ``"archive.zip::member"``, a file in an archive; or ``"-"``, standard input.
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

    which equals u at a = b1. The transverse component is that along a + 90 degrees; the vertical
    component is positive upward.

    Parameters
    ----------
    files : path-like or sequence of path-like
        One file with all components, or several files, each as for `read_record`. An archive of
        several files represents all of them. Together they hold one or two horizontal components
        and at most one vertical component.
    along : str or float, optional
        Direction of the axis: the name or orientation of a horizontal component, or any azimuth
        [degrees clockwise from north]. Default: the first horizontal component.
    component : str or int, optional
        The horizontal component along the axis, as for `read_record`: its name, or its number from
        1 among all components in the order of the files. Not with `along`, where a number is an
        azimuth.
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
        time steps, start times or lengths; `component` that matches none, several or a vertical
        component, or is given with `along`.

    Warns
    -----
    PlausibilityWarning
        As for `read_record`, about the component along the axis.
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
        For each format, its ``name``, the sources of its ``units`` and ``time_step``, a
        ``reference``, and the usual file ``extension``, which does not matter for reading.
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
        # Formats of columns have no reference: they accept any file with numbers.
        known = _core._record_format(content)
        stream = None if known and known["reference"] else _by_obspy(content)
        if stream is None:
            raise
    return _of_stream(stream, shown, units, wanted, only_one)


# ---- containers


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


# ---- ObsPy


# One thread at a time: two that leave `catch_warnings` in the order in which they entered it leave
# all warnings silenced.
_OBSPY = threading.Lock()


def _by_obspy(content: bytes) -> Any:
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
    motion = _core._ground_motion(
        trace.data, trace.stats.delta, units=units, name=trace.id, orientation=orientation
    )
    return Component(motion, code, str(trace.stats.starttime), "")
