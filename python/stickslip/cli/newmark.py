"""``stickslip newmark``: displacements of sliding masses, as SLAMMER tabulates them."""

from __future__ import annotations

import argparse
import itertools
import math
import statistics
import warnings
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .. import (
    STANDARD_GRAVITY,
    ConvergenceError,
    Coulomb,
    FlexibleSlope,
    GroundMotion,
    HyperbolicSoil,
    integrate,
)
from .._core import _most_modes as most_modes
from .._text import printable
from .options import add_options
from .output import check_not_negative, check_positive, check_whole
from .reading import RECORDS, Records

if TYPE_CHECKING:
    from ..sweeps import SweepTable

__all__ = ["add_newmark", "newmark_rows"]

_DISPLACEMENTS = ("normal_m", "inverse_m", "mean_m")
_FLEXIBLE = ("decoupled", "coupled")
_OPTIONS = """
--ky ratios... required
    yield accelerations [g] or ranges
--scale-pga ratio G
    scale each record to this PGA [g]
--method rigid|decoupled|coupled...
    one or more of: rigid, a rigid block (the default); decoupled, a rigid block that the base shear
    of a flexible mass drives, as if the mass did not slide; coupled, a flexible mass that vibrates
    and slides at once. Each row then names its method
--height number M
    flexible mass: height [m]
--vs number V
    flexible mass: shear-wave velocity [m/s]
--damping-ratio ratio Z
    flexible mass: damping ratio of each mode
--reference-strain ratio G
    flexible mass: equivalent-linear hyperbolic soil of this reference strain [-], which replaces
    --damping-ratio
--modes whole N
    flexible mass: number of modes (default 1)
--rock-vs number V
    flexible mass: shear-wave velocity of the rock below [m/s], for radiation damping (default:
    rigid rock)
--csv file FILE
    write the rows to a file, with all digits
--json
    one JSON document, SI units, exact doubles
"""


def add_newmark(commands: argparse._SubParsersAction) -> None:
    """Add the subcommand."""
    parser = commands.add_parser(
        "newmark",
        help="one-way (Newmark) displacements of many records",
        description="Slides Newmark's block, which only slides downhill, through strong-motion"
        " records and prints its displacement [cm] for each record and yield acceleration, in both"
        " polarities, with their mean; then mean, median and standard deviation over the records."
        " The names are SLAMMER's: normal is the reversed record, n = -record; inverse is the"
        " record itself. With --method coupled or decoupled, the sliding mass is a uniform shear"
        " column of the given height, shear-wave velocity, and damping ratio or reference strain.",
        epilog="For example, `stickslip newmark quakes --ky 0.05 0.1`."
        " A file that cannot be read, and a displacement that cannot be computed, are"
        " reported in one line on stderr; the others are printed, and the exit code is 1.",
    )
    add_options(parser, RECORDS, _OPTIONS)
    parser.set_defaults(horizontal=True, run=_newmark)


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
        _row(record, float(levels[s]), float(normal[s, r]), float(inverse[s, r]))
        for r, record in enumerate(table.records)
        for s in range(len(levels))
    ]


def _row(record: str, ky: float, normal: float, inverse: float) -> dict[str, Any]:
    return {
        "record": record,
        "ky_g": ky,
        "normal_m": normal,
        "inverse_m": inverse,
        "mean_m": (normal + inverse) / 2,
    }


def _block(ky: float) -> Coulomb:
    return Coulomb(mu=ky, backward=math.inf)


def _newmark(args: argparse.Namespace) -> str:
    from ..sweeps import grid, sweep  # imports NumPy, slowly

    for ky in args.ky:
        check_positive("--ky", ky, "g")
    check_positive("--scale-pga", args.scale_pga, "g")
    methods = args.method or ["rigid"]
    slopes = _slopes(args)
    levels = sorted(args.ky)
    records = Records(args)
    report = records.report
    files: list[Path] = []
    motions: list[GroundMotion] = []
    found: dict[tuple[int, float, str], dict[str, Any]] = {}  # by record, ky and method
    for read in records:
        with report.kept(read.file):
            motion = read.motion
            if args.scale_pga is not None:
                motion = motion.scaled_to(pga_g=args.scale_pga)
            files.append(read.file)
            motions.append(motion)
            for (ky, method), slope in slopes.items():
                with report.kept(read.file, f"{method}, ky = {ky:g} g: "):
                    inverse, normal = (_peak(slope, each) for each in (motion, -motion))
                    found[len(files) - 1, ky, method] = _row(motion.name, ky, normal, inverse)
    if motions and "rigid" in methods:
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", "sweep: .* combinations failed")  # reported below
            table = sweep(grid(_block, ky=levels), motions, settle=True)
        failed: dict[tuple[int, int], str] = {}
        for one in table.failures:
            failed.setdefault((one.record, one.slider), one.message.partition(":")[0])
        for (k, i), message in failed.items():
            with report.kept(files[k], f"rigid, ky = {levels[i]:g} g: "):
                raise ValueError(message)
        places = itertools.product(range(len(files)), range(len(levels)))
        for (k, i), row in zip(places, newmark_rows(table)):
            if (k, i) not in failed:
                found[k, levels[i], "rigid"] = row
    rows: list[dict[str, Any]] = []
    for k, ky, method in itertools.product(range(len(files)), levels, methods):
        if done := found.get((k, ky, method)):
            done["file"] = str(files[k])
            done["pga_g"] = motions[k].peak_acceleration / STANDARD_GRAVITY
            if args.method:
                done["method"] = method
            rows.append(done)
    method_column = ("method",) if args.method else ()
    columns = ("file", "record", "pga_g", "ky_g", *method_column, *_DISPLACEMENTS)
    lines = list(_lines(rows))
    answer = report.answer(columns, rows, lines, statistics=_statistics(rows))
    return answer if args.json else "\n".join(lines)


def _peak(slope: FlexibleSlope, motion: GroundMotion) -> float:
    try:
        return integrate(slope, motion, settle=True).peak
    except ConvergenceError as error:  # without what it says of settle, which is no option here
        raise ValueError(str(error).removeprefix("integrate: ").partition(";")[0]) from error


def _slopes(args: argparse.Namespace) -> dict[tuple[float, str], FlexibleSlope]:
    """The flexible masses of the command line, by ky [g] and method."""
    needed = {"--height": args.height, "--vs": args.vs}
    if args.reference_strain is None:
        needed["--damping-ratio"] = args.damping_ratio
    column = {
        **needed,
        "--damping-ratio": args.damping_ratio,
        "--reference-strain": args.reference_strain,
        "--modes": args.modes,
        "--rock-vs": args.rock_vs,
    }
    methods = [method for method in args.method or () if method in _FLEXIBLE]
    if not methods:
        for option, value in column.items():
            if value is not None:
                raise ValueError(
                    f"{option} goes with --method coupled or decoupled, got {value:g} without"
                )
        return {}
    if missing := [option for option, value in needed.items() if value is None]:
        raise ValueError(f"--method {methods[0]} needs {' and '.join(missing)}, got none")
    check_whole("--modes", args.modes, 1, most_modes)
    if args.reference_strain is not None and args.damping_ratio is not None:
        raise ValueError(
            "--damping-ratio does not go with --reference-strain, from which the damping of the"
            f" soil follows, got {args.damping_ratio:g}"
        )
    units = {"--height": "m", "--vs": "m/s", "--rock-vs": "m/s", "--reference-strain": ""}
    for option, unit in units.items():
        check_positive(option, column[option], unit)
    check_not_negative("--damping-ratio", args.damping_ratio)
    strain = args.reference_strain
    soil = None if strain is None else HyperbolicSoil(reference_strain=strain)
    return {
        (ky, method): FlexibleSlope(
            ky_g=ky,
            height=args.height,
            shear_velocity=args.vs,
            damping_ratio=args.damping_ratio or 0,
            soil=soil,
            modes=args.modes or 1,
            rock_velocity=args.rock_vs,
            method=method,
        )
        for ky in args.ky
        for method in methods
    }


def _statistics(rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Mean, median and standard deviation (n - 1) over the records, for each level and method."""
    cases = [(row["ky_g"], row.get("method")) for row in rows]
    found = []
    for case in dict.fromkeys(cases):
        for name in ("mean", "median", "sd"):
            line: dict[str, Any] = {"statistic": name, "ky_g": case[0]}
            if case[1]:
                line["method"] = case[1]
            for column in _DISPLACEMENTS:
                values = [row[column] for row, of in zip(rows, cases) if of == case]
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
    method = "  method   " if "method" in rows[0] else ""
    yield f"{'record':{width}}  PGA [g]  ky [g]{method}  normal [cm]  inverse [cm]  mean [cm]"
    last = None
    for name, row in zip(names, rows):
        head = f"{name:{width}}  {row['pga_g']:7.3f}" if name != last else " " * (width + 9)
        yield f"{head}  {_cells(row)}"
        last = name
    if len(set(names)) > 1:
        yield ""
        for row in _statistics(rows):
            yield f"{row['statistic']:{width}}  {'':7}  {_cells(row)}"


def _cells(row: dict[str, Any]) -> str:
    normal, inverse, mean = (100 * row[column] for column in _DISPLACEMENTS)
    method = f"  {row['method']:9}" if "method" in row else ""
    return f"{row['ky_g']:6.4g}{method}  {normal:11.2f}  {inverse:12.2f}  {mean:9.2f}"
