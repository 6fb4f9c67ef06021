"""The records of a command line: expand their names, read their motions."""

from __future__ import annotations

import argparse
import contextlib
import math
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

from .. import GroundMotion, PlausibilityWarning
from .._core import _ground_motion as ground_motion
from .._core import _warn_if_implausible as warn_if_implausible
from .._paths import expanded, is_same_file
from ..motions.metadata import Metadata, orientation_text, readings
from ..motions.records import (
    Component,
    File,
    NotARecord,
    Reading,
    read_components,
    trend_order,
    tried,
    without_trend,
)
from ..motions.samples import sample_files, sample_record
from ..motions.stations import Part, stations_of
from .output import FAILURES, complain, reason_of
from .report import Report

__all__ = ["RECORDS", "VERTICAL", "Motion", "Records"]

_SAMPLE = "sample:"  # before the name of a sample record, in place of a file

RECORDS = """
[records]
records file... RECORD
    file (AT2, COSMOS, GeoNet, K-NET, CSV and others); folder (all files in it); pattern such as
    'quakes/*.AT2'; sample:Kobe, a sample record; or sample:all
--units text UNIT
    unit of acceleration of files that state none: g, gal, ...; or column of --metadata
--component text NAME
    name or number (from 1) in files with several components; all; or vertical
--dt text S
    time step [s] of files that state none (one column); or a column of --metadata
--orientation text*... DIR
    direction of files that do not state it: an azimuth [degrees], N28W, up, ...; one for each
    record; or a column of --metadata
--metadata file FILE
    CSV file with a row for each record, identified by a column file, record or name; its columns
    units, dt (or dt_s) and orientation apply
--detrend mean|line? WHAT
    remove the mean of each acceleration, or the straight line that fits it best: mean (default) or
    line; for records without a corrected baseline, as of K-NET
--gaps
    accept time steps over ten times the median
--strict
    stop at the first failure, with exit code 2 and nothing on stdout; pictures written before it
    remain
"""
VERTICAL = """
[records, one of]
--station
    group the components of each station, from one file or several: the vertical one acts too, and
    --component is a horizontal component or an azimuth [degrees] (default: the first horizontal
    component)
--vertical file FILE
    vertical component of the record, from another file with the same samples
"""


class Motion(NamedTuple):
    """A ground motion of a file."""

    place: int  # of the file given, from 0
    file: Path
    motion: GroundMotion
    component: int | None  # from 1, where all are read
    units: str  # of the acceleration in the file; empty where it states none
    given: str | None = None  # the unit where the file states none
    member: str = ""  # of an archive of several
    # The format of the file; where unit, time step and orientation stand.
    sources: tuple[str, str, str, str] = ("", "", "", "")


class Records:
    """The ground motions of a command line, in an iteration that prints warnings.

    Parameters
    ----------
    args : argparse.Namespace
    scaled : bool, optional
        Whether --scale, one number, applies to each motion.

    Attributes
    ----------
    report : Report
        Keeps what fails.
    """

    def __init__(self, args: argparse.Namespace, scaled: bool = False) -> None:
        scale = getattr(args, "scale", None)
        for value in scale if isinstance(scale, (tuple, list)) else [scale]:
            if value is not None and not math.isfinite(value):
                raise ValueError(f"--scale must be finite, got {value:g}")
        self.args = args
        self._factor = args.scale if scaled else 1.0
        metadata = Metadata(args.metadata, "--metadata") if args.metadata else None
        directions = args.orientation or []
        self._reading = readings(
            "--{}",
            metadata,
            units=args.units,
            dt=args.dt,
            orientation=directions[0] if len(directions) == 1 else None,
            gaps=args.gaps,
        )
        self.files = [
            file
            for given in args.records
            for file in _expanded(given)
            if not (args.metadata and is_same_file(file, args.metadata))
        ]
        if metadata and self.files:
            metadata.require_rows([str(file) for file in self.files])
        self._directions = [_direction(text) for text in directions] if directions[1:] else []
        if self._directions and len(self._directions) != len(self.files):
            raise ValueError(
                f"--orientation needs one direction for each of the {len(self.files)} records, got"
                f" {len(self._directions)}"
            )
        self._trend = trend_order(args.detrend, "--detrend")
        self.station = getattr(args, "station", False)
        self.pairs = getattr(args, "pairs", False)  # stations need both horizontal components
        self.vertical: Path | None = getattr(args, "vertical", None)
        if self.station and args.component in ("all", "vertical"):
            raise ValueError(
                f"--station slides along one direction, got --component {args.component}"
            )
        if self.vertical is not None and len(self.files) != 1:
            raise ValueError(f"--vertical goes with one record, got {len(self.files)}")
        others = [file for file in (self.vertical, args.metadata) if file]
        self.report = Report(args, self.files, [*self.files, *others])

    def __iter__(self) -> Iterator[Motion]:
        for found in self._stations() if self.station else self._records():
            self.report.found += 1
            with self.report.kept(found.file):
                if self._factor != 1:
                    found = found._replace(motion=found.motion.scaled(self._factor))
                yield found

    def _records(self) -> Iterator[Motion]:
        """The ground motions of separate files."""
        for place, file in enumerate(self.files):
            with self.report.kept(file):
                chosen = self.args.component
                which = None if chosen in ("all", "vertical") else chosen
                with self._warnings(file):
                    found = self._tried(place, file, which, only_one=chosen is None)
                if self.vertical is not None and len(found) > 1:
                    raise ValueError(f"--vertical goes with one record, got {len(found)}")
                for one, components in found:
                    path = Path(one.shown)
                    with self.report.kept(path):
                        motions = self._chosen(place, path, components)
                        if len(found) > 1:
                            member = Path(one.shown.rpartition("::")[2]).stem
                            motions = [m._replace(member=member) for m in motions]
                        for motion in motions:
                            yield self._finished(motion)

    def _tried(
        self, place: int, file: Path, component: str | None = None, only_one: bool = False
    ) -> list[tuple[File, list[Component]]]:
        """What could be read of a file, or of all in an archive; keeps the rest for the end."""
        if str(file).startswith(_SAMPLE):
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", PlausibilityWarning)  # `_finished` warns
                motion = sample_record(str(file).removeprefix(_SAMPLE))
            return [(File(str(file), bytes), [Component(motion, "", "", "g")])]
        if file.is_dir():
            raise ValueError("the folder holds no files")

        def read(one: File) -> list[Component]:
            return one.components(self._reading_of(place, one.shown), component, only_one)

        found = []
        for one, answer in tried(file, read):
            if isinstance(answer, NotARecord):
                reason = reason_of(answer, Path(one.shown))
                self.report.left_out.append({"file": one.shown, "reason": reason})
            elif isinstance(answer, Exception):
                with self.report.kept(Path(one.shown)):
                    raise answer
            else:
                found.append((one, answer))
        return found

    @contextlib.contextmanager
    def _warnings(self, file: Path) -> Iterator[None]:
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always", PlausibilityWarning)
            yield
        for warning in caught:
            text = str(warning.message)
            if issubclass(warning.category, PlausibilityWarning):
                text = f"{file}: {_in_words_of_the_command(text)}"
            complain(f"warning: {text}")

    def _finished(self, found: Motion) -> Motion:
        """A motion with --vertical and --detrend; prints warnings."""
        motion = found.motion
        if self.vertical is not None:
            try:
                reading = self._reading(str(self.vertical))._replace(orientation=None)
                (up,) = read_components(self.vertical, reading, only_one=True)
            except FAILURES as error:  # else the line on stderr would name the record
                raise ValueError(f"--vertical: {reason_of(error)}") from error
            motion = _with_vertical(motion, up.motion)
        motion = without_trend(motion, self._trend)
        with self._warnings(found.file):
            warn_if_implausible(motion, "read_record")
        return found._replace(motion=motion)

    def _reading_of(self, place: int, file: str) -> Reading:
        """What the reader of a file is given."""
        given = self._reading(file)
        return given._replace(orientation=self._directions[place]) if self._directions else given

    def _chosen(self, place: int, file: Path, found: list[Component]) -> list[Motion]:
        """The components along which the command slides."""
        chosen = self.args.component
        reading = self._reading_of(place, str(file))
        motions = []
        for k, one in enumerate(found, 1):
            if chosen == "vertical" and not one.is_vertical:
                continue
            if chosen in (None, "all") and self._leaves_out(str(file), one):
                continue
            number = k if len(found) > 1 else None
            given = reading.row_units or reading.units
            motions.append(
                Motion(place, file, one.motion, number, one.units, given, sources=one.sources)
            )
        if chosen == "vertical" and not motions:
            raise ValueError("no component is known to be vertical")
        return motions

    def _leaves_out(self, file: str, component: Component) -> bool:
        """Whether a component is vertical and the command slides along it."""
        if not (self.args.horizontal and component.is_vertical):
            return False
        reason = f"a vertical component ({component.motion.orientation}); --component vertical"
        self.report.left_out.append({"file": file, "reason": f"{reason} slides along it"})
        return True

    def _stations(self) -> Iterator[Motion]:
        """The ground motions of stations."""
        places: dict[str, int] = {}
        parts: list[Part] = []
        for place, file in enumerate(self.files):
            with self.report.kept(file):
                if str(file).startswith(_SAMPLE):
                    raise ValueError(
                        "a sample record has one component; give the files of a station"
                    )
                with self._warnings(file):
                    tried_files = self._tried(place, file)
                for one, found in tried_files:
                    parts += [Part(one.shown, k, part) for k, part in enumerate(found, 1)]
                    places[one.shown] = place
        stations = stations_of(
            parts, self.args.component, who="--component", together=bool(self._directions)
        )
        for station in stations:
            place = places[station.files[0]]
            file = self.files[place]
            with self.report.kept(file):
                only = station.parts[0].component
                if station.reason and self._leaves_out(station.files[0], only):
                    continue
                if station.reason and not station.is_lonely:
                    raise ValueError(station.reason)
                if self.pairs and station.motion.transverse is None:
                    raise ValueError(
                        f"needs a transverse component, found only '{station.motion.name}': give"
                        " the file of the other horizontal component, too"
                    )
                motion = without_trend(station.motion, self._trend)
                with self._warnings(file):
                    if station.reason:
                        warnings.warn(f"{file}: {station.reason}", RuntimeWarning, stacklevel=1)
                    warn_if_implausible(motion, "read_station")
                yield Motion(place, file, motion, None, only.units)


def _expanded(given: Path) -> list[Path]:
    """The files of a folder or pattern; the path itself if it is neither, or names no file."""
    if str(given) in (f"{_SAMPLE}all", f"{_SAMPLE}*"):
        return [Path(f"{_SAMPLE}{file.stem}") for file in sample_files()]
    return expanded(given, enter=True) or [given]


def _direction(text: str) -> str:
    known = orientation_text(text)
    if known is None:
        raise ValueError(
            "--orientation: with several, each must be an azimuth in degrees, N28W, up or the like,"
            f" got {text!r}"
        )
    return known


def _with_vertical(motion: GroundMotion, up: GroundMotion) -> GroundMotion:
    """A motion with the vertical component that another file holds."""
    if (
        motion.dt != up.dt
        or len(motion) != len(up)
        or (motion.dt is None and any(motion.time != up.time))
    ):

        def samples(of: GroundMotion) -> str:
            return f"{len(of)} of {'uneven times' if of.dt is None else f'{of.dt:g} s'}"

        raise ValueError(
            f"--vertical must have the samples of the record, {samples(motion)}, got {samples(up)}"
        )
    times: dict[str, Any] = {"times": motion.time} if motion.dt is None else {"dt": motion.dt}
    return ground_motion(
        motion.acceleration,
        **times,
        interpolation=motion.interpolation,
        name=motion.name,
        vertical=up.acceleration,
        orientation=motion.orientation,
    )


def _in_words_of_the_command(text: str) -> str:
    """A warning of `read_record` in terms of the command's options."""
    _, _, rest = text.partition(": the ")
    text = f"the {rest}" if rest else text
    text = text.replace("check the units", "check the units, with --units if the file states none")
    return text.replace(", which .detrended() removes", ", which --detrend removes")
