"""``stickslip records``: the contents of record files."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterable
from typing import Any

from .. import STANDARD_GRAVITY, StrongMotion, record_formats, strong_motion
from .._text import printable
from .options import add_options
from .output import column, write
from .reading import RECORDS, Motion, Records

__all__ = ["add_records"]

# Of a ground motion as it was read, and its measures.
_COLUMNS: dict[str, Callable[[Motion, StrongMotion], Any]] = {
    "file": lambda found, _: str(found.file),
    "record": lambda found, _: found.motion.name,
    "component": lambda found, _: found.component,
    "orientation": lambda found, _: found.motion.orientation,
    "dt_s": lambda found, _: found.motion.dt,
    "samples": lambda found, _: len(found.motion),
    "duration_s": lambda found, _: found.motion.duration,
    "pga_g": lambda found, _: found.motion.peak_acceleration / STANDARD_GRAVITY,
    "pgv_m_s": lambda _, measures: measures.peak_velocity,
    "arias_intensity_m_s": lambda _, measures: measures.arias_intensity,
    "d5_95_s": lambda _, measures: measures.duration,
    "units": lambda found, _: found.units or found.given,
    "units_from": lambda found, _: "file" if found.units else "option",
    "format": lambda found, _: found.sources[0],
    "units_at": lambda found, _: found.sources[1],
    "dt_at": lambda found, _: found.sources[2],
    "orientation_at": lambda found, _: found.sources[3],
}
_OPTIONS = """
--csv file FILE
    table with units in its heading, exact doubles
--json
    one JSON document, exact doubles
--why
    also print the format of each file, and where it states unit, time step and orientation; always
    printed for one file
"""
_FROM = {"file": "(in the file)", "option": "(given)"}


def add_records(commands: argparse._SubParsersAction) -> None:
    parser = commands.add_parser(
        "records",
        help="list the contents of record files",
        description="Reads records and prints a line for each component: its number in the file,"
        " orientation, time step, samples, duration, peak ground acceleration and velocity, Arias"
        " intensity and the significant duration D5-95, with units in the heading, and the unit of"
        " the acceleration in the file, or that of --units if the file states none. The velocity is"
        " integrated from the record as it is, without baseline correction. For one file, or with"
        " --why, it also prints what was understood of each file, and where it stands.",
        epilog="For example, `stickslip records quakes --why`."
        " A file that cannot be read is reported in one line on stderr; the others are"
        " printed, and the exit code is 1.",
    )
    parser.add_argument("--formats", action=_Formats, help="print the known formats and exit")
    add_options(parser, RECORDS, _OPTIONS)
    parser.set_defaults(horizontal=False, run=_records, component="all")


class _Formats(argparse.Action):
    """Print the table of formats and exit, like --version."""

    def __init__(self, option_strings: list[str], dest: str, **options: Any) -> None:
        super().__init__(option_strings, dest, nargs=0, **options)

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        formats = record_formats()
        columns = ("name", "units", "time_step", "extension")
        heading = dict(zip(columns, ("format", "units", "time step", "files")))
        table = [heading, *formats]
        width = [max(len(row[name]) for row in table) for name in columns]
        lines = (
            "  ".join(f"{row[name]:{w}}" for name, w in zip(columns, width)).rstrip()
            for row in table
        )
        write("\n".join(lines) + "\n", sys.stdout)
        parser.exit()


def _records(args: argparse.Namespace) -> str:
    records = Records(args)
    report = records.report
    rows: list[dict[str, Any]] = []
    for found in records:
        with report.kept(found.file):
            measures = strong_motion(found.motion)
            rows.append({name: of(found, measures) for name, of in _COLUMNS.items()})
    why = ["", *_why(rows)] if args.why or len({row["file"] for row in rows}) == 1 else []
    return report.answer(_COLUMNS, rows, [*_table(rows), *why], key="records")


def _why(rows: list[dict[str, Any]]) -> Iterable[str]:
    """What was understood of each component, and where it stands."""
    for row in rows:
        name = printable(row["record"] or row["file"])
        number = f", component {row['component']}" if row["component"] else ""
        dt = "uneven times" if row["dt_s"] is None else f"time step {row['dt_s']:.6g} s"
        points = row["orientation"]
        pointed = (
            f"orientation {printable(points)} ({row['orientation_at']})"
            if points
            else ("orientation unknown")
        )
        yield (
            f"{name}{number}: {row['format'] or 'known without a file'};"
            f" unit {row['units']} ({row['units_at'] or 'stated'});"
            f" {dt} ({row['dt_at'] or 'stated'}); {pointed}"
        )


def _table(rows: list[dict[str, Any]]) -> Iterable[str]:
    if not rows:
        return
    names = [printable(row["record"] or row["file"]) for row in rows]
    width = max(len("record"), *map(len, names))
    yield (
        f"{'record':{width}}  component  points  {'units':20}  dt [s]  samples  duration [s]"
        "  PGA [g]  PGV [cm/s]  Arias [m/s]  D5-95 [s]"
    )
    for name, row in zip(names, rows):
        dt = "uneven" if row["dt_s"] is None else f"{row['dt_s']:.4g}"
        units = f"{row['units']} {_FROM[row['units_from']]}"
        yield (
            f"{name:{width}}  {row['component'] or 1:9d}"
            f"  {printable(row['orientation'])[:6]:6}  {units:20}  {dt:>6}  {row['samples']:7d}"
            f"  {column(row['duration_s'], 12)}  {column(row['pga_g'], 7, 3)}"
            f"  {column(row['pgv_m_s'] * 100, 10, 1)}"
            f"  {column(row['arias_intensity_m_s'], 11, 3)}  {column(row['d5_95_s'], 9)}"
        )
