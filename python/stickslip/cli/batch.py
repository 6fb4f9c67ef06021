"""Batches of files: expand their names, read their motions, report failures."""

from __future__ import annotations

import argparse
import contextlib
import glob
import math
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

from .. import GroundMotion, PlausibilityWarning, read_record, read_station, sample_record
from .._core import _ground_motion as ground_motion
from .._core import _warn_if_implausible as warn_if_implausible
from .._core import acceleration_unit
from ..records import read_components
from .output import FAILURES, check_outputs, complain, reason_of
from .parser import text_argument

__all__ = ["Batch", "StrictError", "add_files", "add_vertical"]

_SAMPLE = "sample:"  # before the name of a sample record, in place of a file


def add_files(parser: argparse.ArgumentParser) -> None:
    """Add the arguments that `Batch` reads."""
    add = parser.add_argument
    add(
        "records",
        nargs="+",
        type=Path,
        metavar="RECORD",
        help="file (AT2, COSMOS, GeoNet, K-NET, CSV and others); folder (all files in it); pattern"
        " such as 'quakes/*.AT2'; or sample:Kobe, a sample record",
    )
    add(
        "--units",
        type=text_argument,
        help="acceleration unit of files that state none: g, cm/s^2, ...",
    )
    add(
        "--component",
        type=text_argument,
        help="name or number (from 1) in files with several components, or all",
    )
    add("--dt", type=float, help="time step [s] of files with one column")
    add("--gaps", action="store_true", help="accept time steps over ten times the median")
    add(
        "--strict",
        action="store_true",
        help="stop at the first failure, with exit code 2 and nothing on stdout; pictures written"
        " before it remain",
    )


def add_vertical(parser: argparse.ArgumentParser) -> None:
    """Add the arguments that let the vertical motion act, which `Batch` reads too."""
    add = parser.add_mutually_exclusive_group().add_argument
    add(
        "--station",
        action="store_true",
        help="each record is a file with all components of a station: its vertical component acts"
        " too, and --component is a horizontal component or an azimuth [degrees] (default: the"
        " first horizontal component)",
    )
    add(
        "--vertical",
        type=Path,
        metavar="FILE",
        help="vertical component of the record, from another file with the same samples",
    )


class StrictError(Exception):
    """The first failure of a batch under --strict."""


class Motion(NamedTuple):
    """A ground motion of a file."""

    motion: GroundMotion
    component: int | None  # from 1, where all are read
    units: str  # of the acceleration in the file; empty where it states none


class Batch:
    """The files of a command line.

    Attributes
    ----------
    files : list of Path
        The files given, with folders and patterns expanded.
    errors : list of dict
        Failures so far, as --json lists them.
    """

    def __init__(self, args: argparse.Namespace) -> None:
        if args.units:
            acceleration_unit(args.units)
        scale = getattr(args, "scale", None)
        for value in scale if isinstance(scale, tuple) else [scale]:
            if value is not None and not math.isfinite(value):
                raise ValueError(f"--scale must be finite, got {value:g}")
        self.args = args
        self.files = [file for given in args.records for file in _expanded(given)]
        self.station = getattr(args, "station", False)
        self.vertical: Path | None = getattr(args, "vertical", None)
        if self.station and args.component == "all":
            raise ValueError("--station slides along one direction, got --component all")
        if self.vertical is not None and len(self.files) != 1:
            raise ValueError(f"--vertical goes with one record, got {len(self.files)}")
        # What must not be written to.
        self.inputs = [*self.files, *([self.vertical] if self.vertical else [])]
        self.errors: list[dict[str, str]] = []
        self.pictures = list(self._pictures())
        outputs = [("--plot", picture) for picture in self.pictures]
        if args.csv:
            outputs.append(("--csv", args.csv))
        check_outputs(outputs, self.inputs)

    @property
    def code(self) -> int:
        """The exit code."""
        return 1 if self.errors else 0

    @contextlib.contextmanager
    def reported(self, file: Path, prefix: str = "") -> Iterator[None]:
        """Report a failure and continue, unless --strict."""
        try:
            yield
        except FAILURES as error:
            reason = prefix + reason_of(error, file)
            if self.args.strict:
                raise StrictError(f"{file}: {reason}") from error
            complain(f"{file}: {reason}")
            self.errors.append({"file": str(file), "error": reason})

    def motions(self, file: Path) -> list[Motion]:
        """The requested ground motions of a file; prints warnings about them."""
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always", PlausibilityWarning)
            found = self._read(file)
        for warning in caught:
            text = str(warning.message)
            if issubclass(warning.category, PlausibilityWarning):
                text = f"{file}: {_in_words_of_the_command(text)}"
            complain(f"warning: {text}")
        return found

    def picture(self, place: int, motion: Motion) -> Path:
        """The picture of one motion of a file."""
        picture = self.pictures[place]
        if motion.component is None:
            return picture
        picture = picture.with_stem(f"{picture.stem}-{motion.component}")
        check_outputs([("--plot", picture)], self.inputs)
        return picture

    def _read(self, file: Path) -> list[Motion]:
        found = self._read_horizontal(file)
        if self.vertical is None:
            return found
        try:
            up = read_record(self.vertical, **self._options)
        except FAILURES as error:  # else the line on stderr would name the record
            raise ValueError(f"--vertical: {reason_of(error)}") from error
        return [one._replace(motion=_with_vertical(one.motion, up)) for one in found]

    @property
    def _options(self) -> dict[str, Any]:
        """What the readers of all components are given."""
        return {"units": self.args.units, "dt": self.args.dt, "gaps": self.args.gaps}

    def _read_horizontal(self, file: Path) -> list[Motion]:
        if str(file).startswith(_SAMPLE):
            if self.station:
                raise ValueError("a sample record has one component; --station needs a file")
            return [Motion(sample_record(str(file).removeprefix(_SAMPLE)), None, "g")]
        if file.is_dir():
            raise ValueError("the folder holds no files")
        if self.station:
            return [
                Motion(read_station(file, along=self.args.component, **self._options), None, "")
            ]
        every = self.args.component == "all"
        found = read_components(
            file,
            component=None if every else self.args.component,
            only_one=self.args.component is None,
            **self._options,
        )
        for one in found:
            warn_if_implausible(one.motion, "read_record")
        several = len(found) > 1
        return [
            Motion(one.motion, k if several else None, one.units) for k, one in enumerate(found, 1)
        ]

    def _pictures(self) -> Iterator[Path]:
        """One picture for each record; a number distinguishes records of the same name."""
        plot = self.args.plot
        if not plot:
            return
        from .. import plotting  # imports matplotlib, which is slow

        plotting.check_suffix(plot)
        for place, record in enumerate(self.files, 1):
            several = f"-{place}-{record.stem}" if len(self.files) > 1 else ""
            yield plot.with_stem(f"{plot.stem}{several}")


def _expanded(given: Path) -> list[Path]:
    """The files of a folder or pattern; the path itself if it is neither, or names no file."""
    if given.is_dir():
        inside = sorted(file for file in given.rglob("*") if file.is_file())
        shown = [f for f in inside if not any(p[0] == "." for p in f.relative_to(given).parts)]
        return shown or [given]
    if glob.has_magic(str(given)) and not given.exists():
        matches = sorted(map(Path, glob.glob(str(given), recursive=True)))
        return [file for match in matches for file in _expanded(match)] or [given]
    return [given]


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
    return text.replace(", which .detrended() removes", "")
