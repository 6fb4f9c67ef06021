"""Earthquake records from files: plain text, compressed, in archives, or as read by ObsPy."""

from __future__ import annotations

import math
import os
import re
import threading
from collections.abc import Callable, Iterable, Sequence
from operator import index
from typing import (
    Any,
    Literal,
    NamedTuple,
    NoReturn,
    SupportsFloat,
    SupportsIndex,
    TypeAlias,
    overload,
)

from .. import _core
from .._core import GroundMotion
from .._rows import Rows
from .archives import DEEPEST, archive_in, decompressed, stored, unpacked

_File: TypeAlias = "str | bytes | os.PathLike[str] | os.PathLike[bytes]"
_Stream: TypeAlias = Any  # of ObsPy

__all__ = ["read_record", "read_station", "record_formats"]


class Component(NamedTuple):
    """One component of a record, with what its file states."""

    motion: GroundMotion
    name: str  # in the file; empty where it has none
    start: str  # when it begins, in the words of the file; empty where it does not say
    units: str  # of the acceleration in the file; empty where it states none
    sensor: str = ""  # where it is, such as borehole, if the file says so
    # The format of the file; where unit, time step and orientation stand.
    sources: tuple[str, str, str, str] = ("", "", "", "")

    @property
    def is_vertical(self) -> bool:
        """Whether it is known to point up or down."""
        return _core._upward(self.motion.orientation) != 0


class Reading(NamedTuple):
    """What the reader of a file is given, beside the file.

    The file's own statement takes precedence; a row of the metadata must agree with it.
    """

    units: str | None = None
    dt: float | None = None
    orientation: str | None = None  # for a file with one component
    gaps: bool = False
    row_units: str | None = None
    row_dt: float | None = None
    row_orientation: str | None = None


@overload
def read_record(
    file: _File,
    *,
    units: str | None = None,
    component: Literal["all"],
    dt: SupportsFloat | None = None,
    gaps: bool = False,
    detrend: Literal["mean", "line"] | None = None,
) -> list[GroundMotion]: ...
@overload
def read_record(
    file: _File,
    *,
    units: str | None = None,
    component: str | SupportsIndex | None = None,
    dt: SupportsFloat | None = None,
    gaps: bool = False,
    detrend: Literal["mean", "line"] | None = None,
) -> GroundMotion: ...
def read_record(
    file: _File,
    *,
    units: str | None = None,
    component: str | SupportsIndex | None = None,
    dt: SupportsFloat | None = None,
    gaps: bool = False,
    detrend: Literal["mean", "line"] | None = None,
) -> GroundMotion | list[GroundMotion]:
    """Read a strong-motion record.

    The content determines the format; `record_formats` lists the known ones. A JSON file is an
    event of SimCenter: uniform acceleration in the directions 1, 2 and 3, H1, H2 and UP. ObsPy
    reads all other files if it is installed, with `units` from the caller, under the rules of
    `GroundMotion.from_obspy`.

    A file of columns holds times [s] and one or several accelerations, or one acceleration with
    `dt`. Columns are separated by commas, semicolons, tabs or blanks; comments and labels may
    precede them. A comma is a decimal point if something else separates the columns. Byte-order
    marks and CRLF line ends are accepted. Evenly spaced times become a step dt and start at 0;
    uneven times are kept.

    Parameters
    ----------
    file : path-like
        A plain file; one compressed by gzip, bzip2 or xz; a zip or tar archive of one file
        (``.zip``, ``.tar``, ``.tar.gz``, ``.tar.xz``); ``"archive.zip::member"``, a file in an
        archive; or ``"-"``, standard input.
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
    detrend : {'mean', 'line'}, optional
        Remove the mean, or the straight line that fits best, as `GroundMotion.detrended` does: for
        records without a corrected baseline, as of K-NET.

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
    every = component == "all"
    trend = trend_order(detrend, "read_record: detrend")
    whole = file_at(file)
    found = _parsed(
        whole.content(),
        whole.shown,
        component=None if every else component,
        only_one=not every,
        units=units,
        dt=dt,
        gaps=gaps,
    )
    motions = [without_trend(one.motion, trend) for one in found]
    for motion in motions:
        _core._warn_if_implausible(motion, "read_record", 2)
    return motions if every else motions[0]


def read_station(
    files: _File | Iterable[_File] | _Stream,
    *,
    along: str | SupportsFloat | None = None,
    component: str | SupportsIndex | None = None,
    orientations: Sequence[str | SupportsFloat | None] | None = None,
    common_length: bool = False,
    units: str | None = None,
    dt: SupportsFloat | None = None,
    gaps: bool = False,
    detrend: Literal["mean", "line"] | None = None,
) -> GroundMotion:
    """Read the components of one station as one ground motion.

    With the horizontal components u along the azimuth b1 and w along b2, the motion along an
    azimuth a is

        n(a) = (u sin(b2 - a) + w sin(a - b1)) / sin(b2 - b1),

    which equals u at a = b1. The transverse component is that along a + 90 degrees; the vertical
    component is positive upward.

    Parameters
    ----------
    files : path-like, sequence of path-like or obspy.Stream
        One file with all components, or several files, each as for `read_record`. An archive of
        several files represents all records in it; velocities, lists and texts beside them are left
        out. Together they hold one or two horizontal components and at most one vertical component.
        The traces of a stream are components of acceleration, each as for
        `GroundMotion.from_obspy`.
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
    units, dt, gaps, detrend
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
    trend = trend_order(detrend, "read_station: detrend")
    if hasattr(files, "traces"):
        from .traces import components_of

        components = components_of(files.traces, units)
    else:
        paths = [files] if isinstance(files, str | bytes | os.PathLike) else list(files)
        components = []
        for path in paths:
            for _, answer in tried(
                path,
                lambda file: _parsed(file.content(), file.shown, units=units, dt=dt, gaps=gaps),
            ):
                if isinstance(answer, list):
                    components += answer
                elif not isinstance(answer, NotARecord):
                    raise answer
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
    motion = without_trend(motion, trend)
    _core._warn_if_implausible(motion, "read_station", 2)
    return motion


_TRENDS = {"mean": 0, "line": 1}


def trend_order(detrend: str | None, who: str) -> int | None:
    """The order of the polynomial that is removed; None for none."""
    if detrend is not None and detrend not in _TRENDS:
        raise ValueError(f"{who} must be 'mean' or 'line', got {detrend!r}")
    return None if detrend is None else _TRENDS[detrend]


def without_trend(motion: GroundMotion, order: int | None) -> GroundMotion:
    return motion if order is None else motion.detrended(order)


def record_formats() -> Rows:
    """The formats that `read_record` knows, in the order in which it tries them.

    Returns
    -------
    list of dict
        For each format, its ``name``, the sources of its ``units`` and ``time_step``, a
        ``reference``, and the usual file ``extension``, which does not matter for reading. It
        prints as a table.
    """
    return Rows(_core._record_formats())


def _axis_of(
    components: Sequence[Component],
    directions: Sequence[str | None],
    wanted: str | SupportsIndex,
) -> str:
    """The orientation of the component of that name or number, which must be horizontal."""
    names = [one.name for one in components]
    known = ", ".join(f"{i} {name}".strip() for i, name in enumerate(names, 1))
    places = chosen(names, wanted)
    if not places:
        raise ValueError(
            "read_station: component must be the name or number of one component, available:"
            f" {known}; got {wanted!r}"
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


def chosen(names: Sequence[str], wanted: str | SupportsIndex) -> list[int]:
    """The place of the one component of that name, else of that number from 1; or none."""
    text = wanted if isinstance(wanted, str) else f"#{index(wanted)}"
    if text.startswith("#"):
        return [i for i in range(len(names)) if f"#{i + 1}" == text]
    named = [i for i, name in enumerate(names) if name.lower() == text.lower()]
    found = named or [i for i in range(len(names)) if str(i + 1) == text]
    return found if len(found) == 1 else []


def selected(names: Sequence[str], wanted: str | None, only_one: bool) -> list[int]:
    """The places of the components that are meant, all of them by default."""
    places = list(range(len(names))) if wanted is None else chosen(names, wanted)
    if len(places) != 1 and (only_one or wanted is not None):
        known = ", ".join(f"{i} {name}" for i, name in enumerate(names, 1))
        given = (wanted or "").removeprefix("#")
        raise ValueError(
            f"select one component by name or number, available: {known}; got {given!r}"
        )
    return places


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


def _parsed(
    content: bytes,
    shown: str,
    *,
    component: str | SupportsIndex | None = None,
    only_one: bool = False,
    units: str | None = None,
    dt: SupportsFloat | None = None,
    gaps: bool = False,
    default_units: str | None = None,
    default_dt: float | None = None,
) -> list[Component]:
    """The components in the content of a file; a default applies if the file states nothing."""
    wanted = None if component is None else _text(component)
    if units is not None and not isinstance(units, str):
        raise TypeError(f'read_record: units must be text, such as "g" or "m/s^2", got {units!r}')

    if content[:64].lstrip().startswith(b"{") and b'"timeSeries"' in content:
        from .simcenter import components_of

        return components_of(content, shown, units, default_units, wanted, only_one, dt)

    def parse() -> list[Any]:
        return _core._parse_components(
            content,
            os.fsencode(shown),
            units or "",
            wanted or "",
            None if dt is None else float(dt),
            gaps,
            only_one,
            default_units or "",
            default_dt,
        )

    try:
        parts = parse() if len(content) < _LONG else _interruptible(parse)
        return [Component(*part) for part in parts]
    except ValueError:
        from .traces import in_file, read_by_obspy  # which few files need

        stream = None if _is_of_an_agency(content) else read_by_obspy(content)
        if stream is None:
            raise
    return in_file(stream, shown, units, default_units, wanted, only_one)


def _is_of_an_agency(content: bytes) -> bool:
    """Whether an agency's format explains a file; columns of numbers, any file may have."""
    known = _core._record_format(content)
    return bool(known and known["reference"])


_LONG = 8 << 20  # bytes that take about a second


def _interruptible(work: Callable[[], Any]) -> Any:
    """The result of work without the GIL, in a thread: Ctrl-C ends the wait for it."""
    answers: list[Any] = []
    errors: list[BaseException] = []

    def run() -> None:
        try:
            answers.append(work())
        except BaseException as error:
            errors.append(error)

    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    while thread.is_alive():
        thread.join(0.1)
    if errors:
        raise errors[0]
    return answers[0]


def _agreeing(component: Component, reading: Reading, alone: bool) -> Component:
    """The component with its orientation, checked against the row of the metadata."""

    def refuse(what: str, stated: str, row: str) -> NoReturn:
        raise ValueError(f"the file states {what} {stated}, its row of the metadata {row}")

    units, dt, orientation = reading.row_units, reading.row_dt, reading.row_orientation
    motion = component.motion
    if units and component.units:
        stated, row = map(_core.acceleration_unit, (component.units, units))
        if stated != row:
            refuse("the unit", component.units, units)
    if dt and motion.dt and not math.isclose(motion.dt, dt, rel_tol=1e-6):
        refuse("a time step of", f"{motion.dt:.9g} s", f"{dt:.9g} s")
    given = orientation or reading.orientation
    if not given:
        return component
    if not motion.orientation:
        if not alone:
            raise ValueError(
                "an orientation can be given for a file with one component, this file has several"
            )
        return component._replace(motion=_core._with_orientation(motion, given))
    if orientation and not same_direction(orientation, motion.orientation):
        refuse("the orientation", motion.orientation, orientation)
    return component


def same_direction(a: str, b: str) -> bool:
    """Whether two orientations point the same way."""
    azimuths = _core._azimuth_of(a), _core._azimuth_of(b)
    if None in azimuths:
        return azimuths == (None, None) and _core._upward(a) == _core._upward(b)
    return abs((azimuths[0] - azimuths[1] + 180) % 360 - 180) < 1


# ---- containers


class File(NamedTuple):
    """A file, or one in an archive."""

    shown: str  # its name, as `read_record` takes it
    content: Callable[[], bytes]
    member: str = ""  # of an archive that holds nothing else

    def components(
        self,
        reading: Reading,
        component: str | SupportsIndex | None = None,
        only_one: bool = False,
    ) -> list[Component]:
        """The components that are meant, all of them by default; see `read_record`."""
        found = _parsed(
            self.content(),
            self.shown,
            component=component,
            only_one=only_one,
            gaps=reading.gaps,
            default_units=reading.row_units or reading.units,
            default_dt=reading.row_dt or reading.dt,
        )
        if self.member and len(found) == 1 and not found[0].motion.orientation:
            said = _core._orientation_in_file_name(self.member)
            found = [found[0]._replace(motion=_core._with_orientation(found[0].motion, said))]
        try:
            return [_agreeing(one, reading, len(found) == 1) for one in found]
        except ValueError as error:
            raise ValueError(f"read_record: {self.shown}: {error}") from None


def file_at(file: _File) -> File:
    """A file that stands for itself: an archive must hold one file."""
    shown = _shown(file)
    return File(shown, lambda: unpacked(*stored(shown), shown))


def read_components(
    file: _File,
    reading: Reading,
    component: str | SupportsIndex | None = None,
    only_one: bool = False,
) -> list[Component]:
    """The components of a file that are meant; see `read_record`."""
    return file_at(file).components(reading, component, only_one)


def files_in(file: _File) -> list[File]:
    """The files that one stands for: itself, or all in an archive of several.

    The archive is opened once; each file in it is unpacked where it is read.
    """
    shown = _shown(file)
    content, members = stored(shown)
    if members:
        return [File(shown, lambda: unpacked(content, members, shown))]
    return _packed_in(content, shown, DEEPEST)


_PACKED = (".zip", ".tar", ".tgz", ".tar.gz", ".tar.bz2", ".tar.xz")


def _packed_in(packed: bytes, shown: str, deepest: int) -> list[File]:
    """The files in the content of one, also in archives within an archive."""
    content = decompressed(packed, shown)
    archive = archive_in(content, shown)
    if archive is None:
        return [File(shown, lambda: content)]
    names = archive.names
    if len(names) <= 1 and not (names and names[0].lower().endswith(_PACKED)):
        return [File(shown, lambda: unpacked(content, [], shown), names[0] if names else "")]

    def inside(name: str) -> list[File]:
        path = f"{shown}::{name}"
        if deepest > 1 and name.lower().endswith(_PACKED):
            try:
                return _packed_in(archive.read(name), path, deepest - 1)
            except ValueError:
                pass  # raised again where it is read
        return [File(path, lambda: unpacked(archive.read(name), [], path))]

    return [file for name in names for file in inside(name)]


class NotARecord(ValueError):
    """A file that is none of the records that an archive holds: velocity, a list, a text."""


Answer: TypeAlias = "list[Component] | Exception"


def tried(file: _File, read: Callable[[File], list[Component]]) -> list[tuple[File, Answer]]:
    """The components in each of the files that one stands for, or why they cannot be read."""

    files = files_in(file)

    def answer(one: File) -> Answer:
        if len(files) > 1 and one.shown.endswith("::_SearchResults.csv"):  # of PEER: spectra
            return NotARecord("the list of a search")
        try:
            return read(one)
        except (OSError, ValueError) as error:
            return error

    found = [(one, answer(one)) for one in files]
    records = [one for one, answered in found if isinstance(answered, list)]
    if len(records) in (0, len(found)):
        return found
    known = any(_is_of_an_agency(one.content()) for one in records)

    def marked(one: File, answered: Answer) -> Answer:
        if isinstance(answered, list) or not _is_no_record(one, known):
            return answered
        return NotARecord(str(answered))

    return [(one, marked(one, answered)) for one, answered in found]


# In the headings of PEER's and ESM's files.
_NO_ACCELERATION = re.compile(
    rb"(VELOCITY|DISPLACEMENT) TIME (SERIES|HISTORY)|DATA_TYPE: *(VELOCITY|DISPLACEMENT)"
)


def _is_no_record(file: File, beside_known: bool) -> bool:
    """Whether a file that cannot be read is none of acceleration, a text or picture, or columns
    beside records of an agency."""
    try:
        content = file.content()
    except ValueError:
        return False
    if not _is_of_an_agency(content):
        return beside_known or not _core._record_format(content)
    return bool(_NO_ACCELERATION.search(content[:4096].upper()))


def _text(component: str | SupportsIndex) -> str:
    """A component as `_core._parse_components` takes it: #1 is a number, and never a name."""
    if isinstance(component, bool):
        raise TypeError(f"read_record: component must be a name or a number, got {component}")
    return component if isinstance(component, str) else f"#{index(component)}"


def _shown(file: _File) -> str:
    try:
        return os.fsdecode(file)
    except TypeError:
        raise TypeError(f"read_record: file must be a string or a path, got {file!r}") from None


def changed(motion: GroundMotion, **about: Any) -> GroundMotion:
    """A motion with another `name` or `orientation`."""
    times: dict[str, Any] = {"times": motion.time} if motion.dt is None else {"dt": motion.dt}
    kept = ("interpolation", "name", "transverse", "vertical", "orientation")
    return _core._ground_motion(
        motion.acceleration, **times, **({name: getattr(motion, name) for name in kept} | about)
    )
