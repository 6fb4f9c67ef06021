"""``stickslip newmark``: displacements of rigid sliding blocks, as SLAMMER tabulates them."""

from __future__ import annotations

import argparse
import math
import statistics
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .. import STANDARD_GRAVITY, Coulomb, GroundMotion
from .._text import printable
from .batch import Batch, add_files
from .output import json_text, write_csv
from .parser import ratio, ratios

if TYPE_CHECKING:
    from ..sweeps import SweepTable

__all__ = ["add_newmark", "newmark_rows"]

_DISPLACEMENTS = ("normal_m", "inverse_m", "mean_m")
_COLUMNS = ("file", "record", "pga_g", "ky_g", *_DISPLACEMENTS)


def add_newmark(commands: argparse._SubParsersAction) -> None:
    """Add the subcommand."""
    parser = commands.add_parser(
        "newmark",
        help="one-way (Newmark) displacements of many records",
        description="Slides Newmark's block, which only slides downhill, through strong-motion"
        " records and prints its displacement [cm] for each record and yield acceleration, in both"
        " polarities, with their mean; then mean, median and standard deviation over the records."
        " The names are SLAMMER's: normal is the reversed record, n = -record; inverse is the"
        " record itself.",
        epilog="A file that cannot be read is reported in one line on stderr; the others are"
        " printed, and the exit code is 1.",
    )
    add = parser.add_argument
    add_files(parser)
    add("--ky", nargs="+", type=ratios, required=True, help="yield accelerations [g] or ranges")
    add("--scale-pga", type=ratio, metavar="G", help="scale each record to this PGA [g]")
    add("--csv", type=Path, metavar="FILE", help="write the rows to a file, with all digits")
    add("--json", action="store_true", help="one JSON document, SI units, exact doubles")
    parser.set_defaults(horizontal=True, run=_newmark, plot=None)


def newmark_rows(table: SweepTable) -> list[dict[str, Any]]:
    """Rows of SLAMMER's table: record, ky [g], normal, inverse and mean displacement [m].

    Parameters
    ----------
    table : SweepTable
        Results for one-way blocks in both polarities, with the parameter `ky` or `mu`.

    Returns
    -------
    list of dict
        Keys `record`, `ky_g`, `normal_m`, `inverse_m`, `mean_m`; ordered by record.
    """
    levels = table.parameters.get("ky", table.parameters.get("mu"))
    assert levels is not None
    inverse, normal = (table.peak[:, :, table.polarity.index(p)] for p in ("recorded", "reversed"))
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


def _newmark(args: argparse.Namespace) -> str:
    from ..sweeps import grid, sweep  # imports NumPy, slowly

    for ky in args.ky:
        if not 0 < ky < math.inf:
            raise ValueError(f"--ky must be positive and finite, got {ky:g} g")
    if args.scale_pga is not None and not 0 < args.scale_pga < math.inf:
        raise ValueError(f"--scale-pga must be positive and finite, got {args.scale_pga:g} g")
    batch = Batch(args)
    files: list[Path] = []
    motions: list[GroundMotion] = []
    for _, file, found in batch.motions():
        with batch.reported(file):
            motion = found.motion
            if args.scale_pga is not None:
                motion = motion.scaled_to(pga_g=args.scale_pga)
            files.append(file)
            motions.append(motion)
    said = batch.finish()
    rows: list[dict[str, Any]] = []
    if motions:
        rows = newmark_rows(sweep(grid(_block, ky=sorted(args.ky)), motions, settle=True))
    for i, row in enumerate(rows):
        k = i // len(args.ky)
        row["file"] = str(files[k])
        row["pga_g"] = motions[k].peak_acceleration / STANDARD_GRAVITY
    if args.csv:
        write_csv(args.csv, _COLUMNS, rows)
    if args.json:
        return json_text({"results": rows, "statistics": _statistics(rows), **said})
    return "\n".join(_lines(rows))


def _statistics(rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Mean, median and standard deviation (n - 1) over the records, for each level."""
    found = []
    for ky in dict.fromkeys(row["ky_g"] for row in rows):
        for name in ("mean", "median", "sd"):
            line: dict[str, Any] = {"statistic": name, "ky_g": ky}
            for column in _DISPLACEMENTS:
                values = [row[column] for row in rows if row["ky_g"] == ky]
                if name == "sd":
                    line[column] = statistics.stdev(values) if len(values) > 1 else 0.0
                else:
                    line[column] = float(getattr(statistics, name)(values))
            found.append(line)
    return found


def _lines(rows: list[dict[str, Any]]) -> Iterable[str]:
    if not rows:
        return
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
    normal, inverse, mean = (100 * row[column] for column in _DISPLACEMENTS)
    return f"{normal:11.2f}  {inverse:12.2f}  {mean:9.2f}"
