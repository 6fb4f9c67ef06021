"""Many files: which they are, what they hold, and what went wrong with one of them."""

from __future__ import annotations

import argparse
import contextlib
import glob
import math
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from .. import GroundMotion, PlausibilityWarning, sample_record
from .._core import _warn_if_implausible as warn_if_implausible
from .._core import acceleration_unit
from ..records import read_components
from .output import FAILURES, check_outputs, complain, reason_of
from .parser import text_argument

__all__ = ["Batch", "StrictError", "add_files"]

_SAMPLE = "sample:"  # before the name of a sample record, in place of a file


def add_files(parser: argparse.ArgumentParser) -> None:
    """Add the arguments that `Batch` reads."""
    add = parser.add_argument
    add(
        "records",
        nargs="+",
        type=Path,
        metavar="RECORD",
        help="file: AT2, COSMOS, GeoNet, K-NET, CSV and others; folder, with all files in it;"
        " pattern such as 'quakes/*.AT2'; or sample:Kobe, a sample record",
    )
    add(
        "--units",
        type=text_argument,
        help="acceleration unit of files that state none: g, cm/s^2, ...",
    )
    add(
        "--component",
        type=text_argument,
        help="name or number (from 1), where a file has several, or all",
    )
    add("--dt", type=float, help="time between samples [s], of files of one column")
    add("--gaps", action="store_true", help="keep time steps over ten times the median one")
    add(
        "--strict",
        action="store_true",
        help="stop at the first failure, with exit code 2 and nothing on stdout; pictures written"
        " before it remain",
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
        Folders and patterns replaced by the files that they name.
    errors : list of dict
        What went wrong so far, as --json lists it.
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
        self.errors: list[dict[str, str]] = []
        self.pictures = list(self._pictures())
        outputs = [("--plot", picture) for picture in self.pictures]
        if args.csv:
            outputs.append(("--csv", args.csv))
        check_outputs(outputs, self.files)

    @property
    def code(self) -> int:
        """The exit code."""
        return 1 if self.errors else 0

    @contextlib.contextmanager
    def reported(self, file: Path, prefix: str = "") -> Iterator[None]:
        """Go on after a failure, unless --strict."""
        try:
            yield
        except FAILURES as error:
            reason = prefix + reason_of(error, file)
            if self.args.strict:
                raise StrictError(f"{file}: {reason}") from error
            complain(f"{file}: {reason}")
            self.errors.append({"file": str(file), "error": reason})

    def motions(self, file: Path) -> list[Motion]:
        """The ground motions of a file that were asked for, with what is odd about them said."""
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
        check_outputs([("--plot", picture)], self.files)
        return picture

    def _read(self, file: Path) -> list[Motion]:
        if str(file).startswith(_SAMPLE):
            return [Motion(sample_record(str(file).removeprefix(_SAMPLE)), None, "g")]
        if file.is_dir():
            raise ValueError("the folder holds no files")
        every = self.args.component == "all"
        found = read_components(
            file,
            units=self.args.units,
            component=None if every else self.args.component,
            dt=self.args.dt,
            gaps=self.args.gaps,
            only_one=self.args.component is None,
        )
        for one in found:
            warn_if_implausible(one.motion, "read_record")
        several = len(found) > 1
        return [
            Motion(one.motion, k if several else None, one.units) for k, one in enumerate(found, 1)
        ]

    def _pictures(self) -> Iterator[Path]:
        """One file for each record: their places tell apart records of the same name."""
        plot = self.args.plot
        if not plot:
            return
        from .. import plotting  # matplotlib: only who plots waits for it

        plotting.check_suffix(plot)
        for place, record in enumerate(self.files, 1):
            several = f"-{place}-{record.stem}" if len(self.files) > 1 else ""
            yield plot.with_stem(f"{plot.stem}{several}")


def _expanded(given: Path) -> list[Path]:
    """The files of a folder or a pattern; what is neither, and what names no file, is itself."""
    if given.is_dir():
        inside = sorted(file for file in given.rglob("*") if file.is_file())
        shown = [f for f in inside if not any(p[0] == "." for p in f.relative_to(given).parts)]
        return shown or [given]
    if glob.has_magic(str(given)) and not given.exists():
        matches = sorted(map(Path, glob.glob(str(given), recursive=True)))
        return [file for match in matches for file in _expanded(match)] or [given]
    return [given]


def _in_words_of_the_command(text: str) -> str:
    """A warning of `read_record` without the words of Python."""
    _, _, rest = text.partition(": the ")
    text = f"the {rest}" if rest else text
    text = text.replace("check the units", "check the units, with --units if the file states none")
    return text.replace(", which .detrended() takes away", "")
