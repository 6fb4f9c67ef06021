"""``stickslip newmark``: displacements of rigid sliding blocks, as SLAMMER tabulates them."""

from __future__ import annotations

import argparse
import math
import warnings
from collections.abc import Callable, Iterable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from ._core import STANDARD_GRAVITY, Coulomb, GroundMotion, acceleration_unit
from ._files import replacing
from ._text import printable
from .samples import sample_record

if TYPE_CHECKING:
    from .sweeps import SweepTable

__all__ = ["Tools", "add_newmark", "newmark_rows"]

_SAMPLE = "sample:"


class Tools(NamedTuple):
    """What the command line does for all its subcommands."""

    complain: Callable[[str], None]
    json: Callable[[dict], str]
    check_outputs: Callable[[Iterable[tuple[str, Path]], Iterable[Path]], None]


def add_newmark(commands: argparse._SubParsersAction, tools: Tools) -> None:
    """Add the subcommand."""
    parser = commands.add_parser(
        "newmark",
        help="one-way (Newmark) displacements of many records",
        description="Slides Newmark's block, which only slides downhill, through strong-motion"
        " records and prints its displacement [cm] for each record and yield acceleration, in both"
        " polarities, with their mean; then mean, median and standard deviation over the records."
        " The names are SLAMMER's: normal is the record turned round, n = -record, inverse the"
        " record itself.",
        epilog="A file that cannot be read is reported in one line on stderr; the others are"
        " printed, and the exit code is 1.",
    )
    add = parser.add_argument
    add(
        "records",
        nargs="+",
        type=Path,
        metavar="RECORD",
        help="file, folder or pattern; or sample:Kobe, a sample record",
    )
    add("--ky", nargs="+", type=float, required=True, help="yield accelerations [g]")
    add("--scale-pga", type=float, metavar="G", help="scale each record to this PGA [g]")
    add("--units", help="acceleration unit of files that state none: g, cm/s^2, ...")
    add("--component", help="name or number (from 1), where a file has several")
    add("--csv", type=Path, metavar="FILE", help="write the rows to a file, with all digits")
    add("--json", action="store_true", help="one JSON document, SI units, exact doubles")
    parser.set_defaults(run=partial(_newmark, tools))


def newmark_rows(table: SweepTable) -> list[dict[str, Any]]:
    """Rows of SLAMMER's table: record, ky [g], normal, inverse and mean displacement [m].

    Parameters
    ----------
    table : SweepTable
        Of one-way blocks under both polarities, with the parameter `ky` or `mu`.

    Returns
    -------
    list of dict
        Keys `record`, `ky_g`, `normal_m`, `inverse_m`, `mean_m`; record by record.
    """
    levels = table.parameters.get("ky", table.parameters.get("mu"))
    assert levels is not None
    inverse, normal = (
        table.peak[:, :, table.polarity.index(p)] for p in ("as recorded", "flipped")
    )
    return [
        {
            "record": record,
            "ky_g": float(levels[s]),
            "normal_m": float(normal[s, r]),
            "inverse_m": float(inverse[s, r]),
            "mean_m": float(normal[s, r] + inverse[s, r]) / 2,
        }
        for r, record in enumerate(table.records)
        for s in range(len(levels))
    ]


def _block(ky: float) -> Coulomb:
    return Coulomb(mu=ky, backward=math.inf)


def _newmark(tools: Tools, args: argparse.Namespace) -> str:
    from .suite import Suite, _files  # and NumPy: who slides one record waits for neither
    from .sweeps import grid, sweep

    for ky in args.ky:
        if not 0 < ky < math.inf:
            raise ValueError(f"--ky must be positive and finite, got {ky:g} g")
    if args.scale_pga is not None and not 0 < args.scale_pga < math.inf:
        raise ValueError(f"--scale-pga must be positive and finite, got {args.scale_pga:g} g")
    if args.units:
        acceleration_unit(args.units)
    samples = [r for r in args.records if str(r).startswith(_SAMPLE)]
    files = _files([r for r in args.records if r not in samples])
    if args.csv:
        tools.check_outputs([("--csv", args.csv)], files)
    motions: list[GroundMotion] = [sample_record(str(r).removeprefix(_SAMPLE)) for r in samples]
    left = []
    if files:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", RuntimeWarning)  # each is told on a line of its own
            suite = Suite.read(files, units=args.units, component=args.component, on_error="skip")
        motions += suite
        left = list(suite.left_out)
    elif not samples:
        raise ValueError(f"no files in {', '.join(map(str, args.records))}")
    for file, reason in left:
        tools.complain(f"{file}: {reason}")
    if args.scale_pga is not None:
        motions = list(Suite(motions).scaled_to(pga_g=args.scale_pga))
    args.code = 1 if left else 0
    table = sweep(grid(_block, ky=sorted(args.ky)), motions, settle=True)
    rows = newmark_rows(table)
    pga = [m.peak_acceleration / STANDARD_GRAVITY for m in motions]
    for i, row in enumerate(rows):
        row["pga_g"] = pga[i // len(args.ky)]
    if args.csv:
        _write_csv(args.csv, rows)
    if args.json:
        errors = [{"file": file, "error": reason} for file, reason in left]
        return tools.json({"results": rows, "statistics": _statistics(rows), "errors": errors})
    return "\n".join(_lines(rows))


_COLUMNS = ("normal_m", "inverse_m", "mean_m")


def _statistics(rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Mean, median and standard deviation (n - 1) over the records, for each level."""
    import statistics

    found = []
    for ky in dict.fromkeys(row["ky_g"] for row in rows):
        for name in ("mean", "median", "sd"):
            line: dict[str, Any] = {"statistic": name, "ky_g": ky}
            for column in _COLUMNS:
                values = [row[column] for row in rows if row["ky_g"] == ky]
                if name == "sd":
                    line[column] = statistics.stdev(values) if len(values) > 1 else 0.0
                else:
                    line[column] = float(getattr(statistics, name)(values))
            found.append(line)
    return found


def _lines(rows: list[dict[str, Any]]) -> Iterable[str]:
    names = [printable(row["record"]) for row in rows]
    width = max(len("record"), *map(len, names))
    yield f"{'record':{width}}  PGA [g]  ky [g]  normal [cm]  inverse [cm]  mean [cm]"
    last = None
    for name, row in zip(names, rows):
        head = f"{name:{width}}  {row['pga_g']:7.3f}" if name != last else " " * (width + 9)
        yield f"{head}  {row['ky_g']:6.4g}  {_cells(row)}"
        last = name
    if len(set(names)) > 1:
        yield ""
        for row in _statistics(rows):
            yield f"{row['statistic']:{width}}  {'':7}  {row['ky_g']:6.4g}  {_cells(row)}"


def _cells(row: dict[str, Any]) -> str:
    normal, inverse, mean = (100 * row[column] for column in _COLUMNS)
    return f"{normal:11.2f}  {inverse:12.2f}  {mean:9.2f}"


def _write_csv(file: Path, rows: list[dict[str, Any]]) -> None:
    import csv
    import io

    text = io.StringIO()
    columns = ("record", "pga_g", "ky_g", *_COLUMNS)
    writer = csv.DictWriter(text, columns, lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    with replacing(file) as stream:
        stream.write(text.getvalue().encode())
