"""Output of the command: text, JSON, CSV and error messages."""

from __future__ import annotations

import argparse
import contextlib
import csv
import errno
import io
import math
import os
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, TextIO

from .. import ConvergenceError, build_info
from .._files import check_writable, replacing
from .._text import no_formula, printable

__all__ = [
    "FAILURES",
    "add_outputs",
    "check_not_negative",
    "check_outputs",
    "check_positive",
    "check_whole",
    "column",
    "complain",
    "json_text",
    "reason_of",
    "version",
    "write",
    "write_csv",
    "write_error",
]

# Errors that end the work on one file, but not on the others.
FAILURES = (ConvergenceError, ImportError, MemoryError, OSError, OverflowError, ValueError)


def write(text: str, stream: TextIO | None) -> None:
    try:
        if stream is None:
            raise OSError(errno.EBADF, os.strerror(errno.EBADF))
        encoding = getattr(stream, "encoding", None) or "utf-8"
        stream.write(text.encode(encoding, "backslashreplace").decode(encoding))
        stream.flush()
    except OSError as error:
        with contextlib.suppress(AttributeError, OSError):  # otherwise Python fails again at exit
            os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
        raise OSError(error.errno, error.strerror, "standard output") from error


def write_error(text: str) -> None:
    with contextlib.suppress(OSError):  # there is nowhere left to report it
        write(text, sys.stderr)


def complain(message: str) -> None:
    write_error(f"stickslip: {printable(message)}\n")


def reason_of(error: BaseException, file: Path | None = None) -> str:
    """The reason for an error, without the name of `file`."""
    if isinstance(error, OSError) and error.strerror:
        named = error.filename is not None and str(error.filename) != str(file)
        return f"{error.filename}: {error.strerror}" if named else error.strerror
    if isinstance(error, MemoryError):
        detail = str(error).replace("std::bad_alloc", "")
        return f"not enough memory{f': {detail}' if detail else ''}"
    return str(error).removeprefix(f"read_record: {file}: ")


def json_text(document: dict) -> str:
    """A JSON text with exact doubles; infinity becomes null, and NaN raises ValueError."""
    import json

    def finite(value: Any) -> Any:
        if isinstance(value, dict):
            return {key: finite(item) for key, item in value.items()}
        if isinstance(value, list):
            return [finite(item) for item in value]
        return None if value == math.inf else value

    document = {"stickslip": build_info()["version"], **finite(document)}
    return json.dumps(document, indent=2, allow_nan=False)


def add_outputs(parser: argparse.ArgumentParser, each: str = "record") -> None:
    """Add --plot, --csv and --json; `each` says of what there is a picture, if not of all."""
    add = parser.add_argument
    several = f", one for each {each}" if each else ""
    add("--plot", type=Path, metavar="FILE", help=f"picture (.png, .pdf, .svg){several}")
    add("--csv", type=Path, metavar="FILE", help="table with units in its heading, exact doubles")
    add("--json", action="store_true", help="one JSON document, SI units, exact doubles")


def check_outputs(outputs: Iterable[tuple[str, Path]], records: Iterable[Path] = ()) -> None:
    """Raise if a file cannot be written, or would overwrite a record or another output."""
    taken = {_identity(record): f"the record {record}" for record in records}
    for option, file in outputs:
        try:
            check_writable(file)
        except OSError as error:
            if error.errno != errno.ENAMETOOLONG:  # a long record name: only its picture fails
                raise
        owner = f"the file of {option}, {file}"
        if taken.setdefault(_identity(file), owner) is not owner:
            raise ValueError(f"{option} {file} would overwrite {taken[_identity(file)]}")


def check_whole(option: str, value: int | None, least: int, most: int = 2**64 - 1) -> None:
    if value is not None and not least <= value <= most:
        bound = f"at least {least}" if value < least else f"at most {most}"
        raise ValueError(f"{option} must be {bound}, got {value}")


def check_positive(option: str, value: float | None, unit: str = "") -> None:
    if value is not None and not 0 < value < math.inf:
        raise ValueError(f"{option} must be positive and finite, got {value:g} {unit}".rstrip())


def check_not_negative(option: str, value: float | None, unit: str = "") -> None:
    if value is not None and not 0 <= value < math.inf:
        raise ValueError(f"{option} must be finite and at least 0, got {value:g} {unit}".rstrip())


def _identity(file: Path) -> Any:
    """A key that is equal for all names of a file: relative paths, symbolic and hard links."""
    try:
        status = file.stat()
    except OSError:
        return os.path.realpath(file)
    return status.st_dev, status.st_ino


def version() -> str:
    info = build_info()
    contained = [
        f"{name} {info[key]}"
        for name, key in (
            ("Eigen", "eigen"),
            ("FFTW", "fftw"),
            ("GSL", "gsl"),
            ("Highway", "highway"),
            ("SUNDIALS", "sundials"),
        )
        if info.get(key)
    ]
    made = [f"{word} {info[word]}" for word in ("commit", "compiler") if info.get(word)]
    gpl = info.get("fftw") or info.get("gsl")
    return "\n".join(
        [
            " ".join(["stickslip", info["version"], *([f"({', '.join(made)})"] if made else [])]),
            f"contains {', '.join(contained)}" if contained else "contains no other library",
            "source: BSD-3-Clause; this build, with FFTW and GSL: GPL-3.0-or-later"
            if gpl
            else "source and this build: BSD-3-Clause",
        ]
    )


def write_csv(file: Path, names: Sequence[str], rows: Iterable[dict[str, Any]]) -> None:
    """Write rows as CSV with exact doubles, whole or not at all; None is an empty cell.

    Texts that a spreadsheet would take for formulas have an apostrophe before them.
    """
    text = io.StringIO()
    table = csv.DictWriter(text, names, extrasaction="ignore", lineterminator="\n")
    table.writerow({name: no_formula(name) for name in names})
    table.writerows(
        {n: no_formula(v) if isinstance(v, str) else v for n, v in row.items()} for row in rows
    )
    with replacing(file) as stream:
        stream.write(text.getvalue().encode("utf-8", "backslashreplace"))


def column(value: float, width: int, places: int = 2) -> str:
    text = f"{round(value, places) + 0.0:{width}.{places}f}"  # no -0.00
    return text if len(text) <= width else f"{value:{width}.1e}"
