"""Batches of files: expand their names, read their motions, report failures."""

from __future__ import annotations

import argparse
import contextlib
import math
import warnings
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from .. import GroundMotion, PlausibilityWarning
from .._core import _ground_motion as ground_motion
from .._core import _warn_if_implausible as warn_if_implausible
from .._failures import grouped, with_options
from .._paths import expanded, is_same_file
from .._text import printable
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
from .output import FAILURES, check_outputs, complain, json_text, reason_of, write_csv
from .parser import group, text_argument

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["Batch", "StrictError", "add_files", "add_outputs", "add_vertical"]

_SAMPLE = "sample:"  # before the name of a sample record, in place of a file


def add_files(parser: argparse.ArgumentParser) -> None:
    """Add the arguments that `Batch` reads."""
    add = group(parser, "records").add_argument
    add(
        "records",
        nargs="+",
        type=Path,
        metavar="RECORD",
        help="file (AT2, COSMOS, GeoNet, K-NET, CSV and others); folder (all files in it); pattern"
        " such as 'quakes/*.AT2'; sample:Kobe, a sample record; or sample:all",
    )
    add(
        "--units",
        type=text_argument,
        metavar="UNIT",
        help="unit of acceleration of files that state none: g, gal, ...; or column of --metadata",
    )
    add(
        "--component",
        type=text_argument,
        metavar="NAME",
        help="name or number (from 1) in files with several components; all; or vertical",
    )
    add(
        "--dt",
        type=text_argument,
        metavar="S",
        help="time step [s] of files that state none (one column); or a column of --metadata",
    )
    add(
        "--orientation",
        action="extend",  # several records may have the same
        nargs="+",
        type=text_argument,
        metavar="DIR",
        help="direction of files that do not state it: an azimuth [degrees], N28W, up, ...; one for"
        " each record; or a column of --metadata",
    )
    add(
        "--metadata",
        type=Path,
        metavar="FILE",
        help="CSV file with a row for each record, identified by a column file, record or name; its"
        " columns units, dt (or dt_s) and orientation apply",
    )
    add(
        "--detrend",
        nargs="?",
        choices=("mean", "line"),
        const="mean",
        metavar="WHAT",
        help="remove the mean of each acceleration, or the straight line that fits it best: mean"
        " (default) or line; for records without a corrected baseline, as of K-NET",
    )
    add("--gaps", action="store_true", help="accept time steps over ten times the median")
    add(
        "--strict",
        action="store_true",
        help="stop at the first failure, with exit code 2 and nothing on stdout; pictures written"
        " before it remain",
    )


def add_vertical(parser: argparse.ArgumentParser) -> None:
    """Add the arguments that let the vertical motion act, which `Batch` reads too."""
    add = group(parser, "records").add_mutually_exclusive_group().add_argument
    add(
        "--station",
        action="store_true",
        help="group the components of each station, from one file or several: the vertical one acts"
        " too, and --component is a horizontal component or an azimuth [degrees] (default: the"
        " first horizontal component)",
    )
    add(
        "--vertical",
        type=Path,
        metavar="FILE",
        help="vertical component of the record, from another file with the same samples",
    )


def add_outputs(parser: argparse.ArgumentParser, each: str = "record") -> None:
    """Add --plot, --csv and --json; `each` says of what there is a picture, if not of all."""
    add = group(parser, "output").add_argument
    several = f", one for each {each}" if each else ""
    add("--plot", type=Path, metavar="FILE", help=f"picture (.png, .pdf, .svg){several}")
    add("--csv", type=Path, metavar="FILE", help="table with units in its heading, exact doubles")
    add("--json", action="store_true", help="one JSON document, SI units, exact doubles")


class StrictError(Exception):
    """The first failure of a batch under --strict."""


class Motion(NamedTuple):
    """A ground motion of a file."""

    motion: GroundMotion
    component: int | None  # from 1, where all are read
    units: str  # of the acceleration in the file; empty where it states none
    given: str | None = None  # the unit where the file states none
    member: str = ""  # of an archive of several
    # The format of the file; where unit, time step and orientation stand.
    sources: tuple[str, str, str, str] = ("", "", "", "")


class Batch:
    """The files of a command line.

    Attributes
    ----------
    files : list of Path
        The files given, with folders and patterns expanded.
    errors, left_out : list of dict
        Failures and vertical components left out so far, as --json lists them.
    figures : list of str
        Pictures written so far.
    """

    def __init__(self, args: argparse.Namespace) -> None:
        scale = getattr(args, "scale", None)
        for value in scale if isinstance(scale, tuple) else [scale]:
            if value is not None and not math.isfinite(value):
                raise ValueError(f"--scale must be finite, got {value:g}")
        self.args = args
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
        # What must not be written to.
        self.inputs = [*self.files, *(f for f in (self.vertical, args.metadata) if f)]
        self.errors: list[dict[str, str]] = []
        self.left_out: list[dict[str, str]] = []
        self.figures: list[str] = []
        self.found = 0
        self.pictures = list(self._pictures())
        outputs = [("--plot", picture) for picture in self.pictures]
        if args.csv:
            outputs.append(("--csv", args.csv))
        check_outputs(outputs, self.inputs)

    def finish(self) -> dict[str, list[dict[str, str]]]:
        """Report what failed and what was left out; returns it for --json."""
        for line in grouped((each["file"], each["error"]) for each in self.errors):
            complain(line)
        for line in grouped((each["file"], each["reason"]) for each in self.left_out):
            complain(f"left out: {line}")
        self.args.code = 1 if self.errors or (self.left_out and not self.found) else 0
        return {"errors": self.errors, "left_out": self.left_out}

    def answer(
        self,
        columns: Sequence[str],
        rows: list[dict[str, Any]],
        lines: Iterable[str],
        **more: Any,
    ) -> str:
        """Write the rows to --csv and `finish`; the JSON document, or the lines for a person."""
        if self.args.csv:
            write_csv(self.args.csv, columns, rows)
        found = self.finish()
        if self.args.json:
            return json_text({"results": rows, **more, **found, "figures": self.figures})
        written = [*self.figures, *([str(self.args.csv)] if self.args.csv else [])]
        return "\n".join([*lines, *(f"wrote {printable(name)}" for name in written)])

    @contextlib.contextmanager
    def reported(self, file: Path, prefix: str = "") -> Iterator[None]:
        """Keep a failure for the end and continue, unless --strict."""
        try:
            yield
        except FAILURES as error:
            reason = prefix + with_options(reason_of(error, file), "--{}")
            if self.args.strict:
                raise StrictError(f"{file}: {reason}") from error
            self.errors.append({"file": str(file), "error": reason})

    def motions(self) -> Iterator[tuple[int, Path, Motion]]:
        """The requested ground motions, with the place of their file; prints warnings."""
        for each in self._stations() if self.station else self._records():
            self.found += 1
            yield each

    def _records(self) -> Iterator[tuple[int, Path, Motion]]:
        """The ground motions of separate files."""
        for place, file in enumerate(self.files):
            with self.reported(file):
                chosen = self.args.component
                which = None if chosen in ("all", "vertical") else chosen
                with self._warnings(file):
                    found = self._tried(place, file, which, only_one=chosen is None)
                if self.vertical is not None and len(found) > 1:
                    raise ValueError(f"--vertical goes with one record, got {len(found)}")
                for one, components in found:
                    path = Path(one.shown)
                    with self.reported(path):
                        motions = self._chosen(place, path, components)
                        if len(found) > 1:
                            member = Path(one.shown.rpartition("::")[2]).stem
                            motions = [m._replace(member=member) for m in motions]
                        for motion in motions:
                            yield place, path, self._finished(path, motion)

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
                self.left_out.append({"file": one.shown, "reason": reason})
            elif isinstance(answer, Exception):
                with self.reported(Path(one.shown)):
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

    def save(self, figure: Figure, place: int = 0, motion: Motion | None = None) -> None:
        """Save the picture of one motion of a file, or the one picture of all."""
        from .. import plotting

        picture = self.pictures[place] if motion is None else self.picture(place, motion)
        plotting.save(figure, picture)
        self.figures.append(str(picture))

    def picture(self, place: int, motion: Motion) -> Path:
        """The name of the picture of one motion of a file."""
        picture = self.pictures[place]
        parts = [part for part in (motion.member, motion.component) if part]
        if not parts:
            return picture
        picture = picture.with_stem("-".join([picture.stem, *map(str, parts)]))
        check_outputs([("--plot", picture)], self.inputs)
        return picture

    def _finished(self, file: Path, found: Motion) -> Motion:
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
        with self._warnings(file):
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
            motions.append(Motion(one.motion, number, one.units, given, sources=one.sources))
        if chosen == "vertical" and not motions:
            raise ValueError("no component is known to be vertical")
        return motions

    def _leaves_out(self, file: str, component: Component) -> bool:
        """Whether a component is vertical and the command slides along it."""
        if not (self.args.horizontal and component.is_vertical):
            return False
        reason = f"a vertical component ({component.motion.orientation}); --component vertical"
        self.left_out.append({"file": file, "reason": f"{reason} slides along it"})
        return True

    def _stations(self) -> Iterator[tuple[int, Path, Motion]]:
        """The ground motions of stations."""
        places: dict[str, int] = {}
        parts: list[Part] = []
        for place, file in enumerate(self.files):
            with self.reported(file):
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
            with self.reported(file):
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
                yield place, file, Motion(motion, None, only.units)

    def _pictures(self) -> Iterator[Path]:
        """One picture for each record, where a number distinguishes records of the same name, or
        one of all."""
        plot = self.args.plot
        if not plot:
            return
        from .. import plotting  # imports matplotlib, which is slow

        plotting.check_suffix(plot)
        if getattr(self.args, "one_picture", False):
            yield plot
            return
        for place, record in enumerate(self.files, 1):
            several = f"-{place}-{record.stem}" if len(self.files) > 1 else ""
            yield plot.with_stem(f"{plot.stem}{several}")


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
