"""What a command tells of its records: failures, pictures, tables."""

from __future__ import annotations

import argparse
import contextlib
from collections.abc import Iterable, Iterator, Sequence
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .._failures import grouped, with_options
from .._text import printable
from .output import FAILURES, check_outputs, complain, json_text, reason_of, write_csv

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from .reading import Motion

__all__ = ["Report", "StrictError", "outputs"]


def outputs(each: str = "record") -> str:
    """The options --plot, --csv and --json, with a picture for each of something, or of all."""
    several = f", one for each {each}" if each else ""
    return f"""
[output]
--plot file FILE
    picture (.png, .pdf, .svg){several}
--csv file FILE
    table with units in its heading, exact doubles
--json
    one JSON document, SI units, exact doubles
"""


class StrictError(Exception):
    """The first failure under --strict."""


class Report:
    """Failures, vertical components that were left out, and pictures so far.

    Parameters
    ----------
    args : argparse.Namespace
        With `one_picture` true, there is one picture of all records.
    files, inputs : list of Path
        The records, and all files that must not be written to.
    """

    def __init__(
        self, args: argparse.Namespace, files: Sequence[Path], inputs: Sequence[Path]
    ) -> None:
        self.args = args
        self.inputs = inputs
        self.found = 0  # motions
        self.errors: list[dict[str, str]] = []
        self.left_out: list[dict[str, str]] = []
        self.figures: list[str] = []
        self._pictures: list[Path] = []
        if plot := getattr(args, "plot", None):
            from .. import plotting  # imports matplotlib, which is slow

            plotting.check_suffix(plot)
            numbered = len(files) > 1 and not getattr(args, "one_picture", False)
            self._pictures = [  # a number distinguishes records of the same name
                plot.with_stem(f"{plot.stem}-{place}-{file.stem}")
                for place, file in enumerate(files, 1)
            ]
            if not numbered:
                self._pictures = [plot]
        outputs = [("--plot", picture) for picture in self._pictures]
        check_outputs([*outputs, *([("--csv", args.csv)] if args.csv else [])], inputs)

    @contextlib.contextmanager
    def kept(self, file: Path, prefix: str = "") -> Iterator[None]:
        """Keep a failure for the end and continue, unless --strict."""
        try:
            yield
        except FAILURES as error:
            reason = prefix + with_options(reason_of(error, file), "--{}")
            if self.args.strict:
                raise StrictError(f"{file}: {reason}") from error
            self.errors.append({"file": str(file), "error": reason})

    def save(self, figure: Figure, found: Motion | None = None) -> None:
        """Save the picture of one motion, or the one picture of all."""
        from .. import plotting

        picture = self._pictures[found.place if found else 0]
        if (
            parts := [str(part) for part in (found.member, found.component) if part]
            if found
            else []
        ):
            picture = picture.with_stem("-".join([picture.stem, *parts]))
            check_outputs([("--plot", picture)], self.inputs)
        plotting.save(figure, picture)
        self.figures.append(str(picture))

    @cached_property
    def failures(self) -> dict[str, list[dict[str, str]]]:
        """What failed and what was left out, for --json; the first call reports it."""
        for line in grouped((each["file"], each["error"]) for each in self.errors):
            complain(line)
        for line in grouped((each["file"], each["reason"]) for each in self.left_out):
            complain(f"left out: {line}")
        self.args.code = 1 if self.errors or (self.left_out and not self.found) else 0
        return {"errors": self.errors, "left_out": self.left_out}

    def answer(
        self,
        columns: Iterable[str],
        rows: list[dict[str, Any]],
        lines: Iterable[str],
        key: str = "results",
        **more: Any,
    ) -> str:
        """Write the rows to --csv; the JSON document, or the lines for a person."""
        if self.args.csv:
            write_csv(self.args.csv, tuple(columns), rows)
        found = self.failures
        if self.args.json:
            figures = {"figures": self.figures} if "plot" in self.args else {}
            return json_text({key: rows, **more, **found, **figures})
        written = [*self.figures, *([str(self.args.csv)] if self.args.csv else [])]
        return "\n".join([*lines, *(f"wrote {printable(name)}" for name in written)])
