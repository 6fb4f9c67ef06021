"""``stickslip orientations``: sliding along all horizontal directions of stations."""

from __future__ import annotations

import argparse
import warnings
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from .._text import printable
from .options import SCALE, add_options
from .output import column, complain
from .reading import RECORDS, Records
from .report import outputs
from .slider import (
    SLIDERS,
    cells,
    described,
    first_of,
    heads,
    keyed,
    slider_of,
    variations,
)

if TYPE_CHECKING:
    from ..sweeps import Orientations

__all__ = ["add_orientations"]

_ABOUT = ("file", "station", "scale")
_VALUES = ("degrees", "peak_m", "residual_m")
_PERCENTILES = (0, 50, 100)
_DEGREES = """
--degrees numbers... D
    directions (default 0:179:1; 0:359:1 where opposite directions differ)
"""


def add_orientations(commands: argparse._SubParsersAction) -> None:
    """Add the subcommand."""
    parser = commands.add_parser(
        "orientations",
        help="slide blocks along all horizontal directions of stations",
        description="Groups the components of each station, from one file or several, slides blocks"
        " along each horizontal direction, in steps of 1 degree, until they come to rest, and"
        " prints the minimum, median and maximum over the directions, RotD00, RotD50 and RotD100,"
        " of the peak and of the magnitude of the residual [cm], with the directions of the"
        " maxima: azimuths where the orientation is known, otherwise angles from the first"
        " component, clockwise. The vertical component acts, too.",
        epilog="For example, `stickslip orientations station.zip --mu 0.1`."
        " --mu, --degrees and the options of the slider take numbers or ranges"
        " START:STOP:STEP; every combination is computed. A station that cannot be read or slid is"
        " reported in one line on stderr; the others are printed, and the exit code is 1.",
    )
    add_options(parser, RECORDS, SLIDERS, _DEGREES, SCALE, outputs(each="station"))
    parser.set_defaults(horizontal=True, station=True, pairs=True, run=_orientations)


def _orientations(args: argparse.Namespace) -> str:
    from ..sweeps import orientations  # imports NumPy, slowly

    cases, several = variations(args)
    shown = list(dict.fromkeys([first_of(args), *several]))
    sliders = [(case, slider_of(case)) for case in cases]
    if args.plot and len(sliders) > 1:
        raise ValueError(f"--plot draws one slider, got {len(sliders)}")
    records = Records(args, scaled=True)
    report = records.report
    rows: list[dict[str, Any]] = []
    printed: list[dict[str, Any]] = []
    for found in records:
        motion = found.motion
        for case, slider in sliders:
            with report.kept(found.file):
                with warnings.catch_warnings(record=True) as caught:
                    warnings.simplefilter("always")
                    table = orientations(
                        slider, motion, args.degrees, settle=True, contact=args.contact
                    )
                if table.failures:
                    direction, reason = table.failures[0]
                    raise ValueError(f"at {direction:g} degrees: {reason}")
                for warning in caught:
                    complain(f"warning: {found.file}: {warning.message}")
                about = {
                    "file": str(found.file),
                    "station": motion.name,
                    "scale": args.scale,
                    **keyed(case, shown),
                }
                values = table.degrees.tolist(), table.peak.tolist(), table.residual.tolist()
                for row in zip(*values):
                    rows.append({**about, **dict(zip(_VALUES, row))})
                printed.append({**about, "from_north": table.from_north, **_percentiles(table)})
                if args.plot:
                    label = ", ".join(described(case, several))
                    name = printable(f"{motion.name}, {label}")
                    report.save(table.plot(title=name), found)
    columns = [*_ABOUT, *keyed(args, shown), *_VALUES]
    return report.answer(columns, rows, _lines(printed, shown), percentiles=printed)


def _percentiles(table: Orientations) -> dict[str, float]:
    found = {}
    for nn in _PERCENTILES:
        one = table.percentile(nn)
        for name in ("peak", "residual"):
            found[f"rotd{nn:02d}_{name}_m"] = getattr(one, name)
            found[f"rotd{nn:02d}_{name}_degrees"] = getattr(one, f"{name}_degrees")
    return found


def _lines(rows: list[dict[str, Any]], shown: list[str]) -> Iterable[str]:
    if not rows:
        return
    names = [printable(row["station"] or row["file"]) for row in rows]
    width = max(len("station"), *map(len, names))
    options = heads(shown)
    yield f"{' ' * (width + len(options))}  peak [cm]{'':28}  residual [cm]"
    quantities = "".join(f"  {'RotD00':>7}  {'RotD50':>7}  {'RotD100':>7}  at [deg]" for _ in "pr")
    yield f"{'station':{width}}{options}{quantities}"
    last = None
    for name, row in zip(names, rows):
        line = cells(row, shown)
        for quantity in ("peak", "residual"):
            for nn in _PERCENTILES:
                line += f"  {column(100 * row[f'rotd{nn:02d}_{quantity}_m'], 7)}"
            line += f"  {row[f'rotd100_{quantity}_degrees']:8.4g}"
        yield f"{name if name != last else '':{width}}{line}"
        last = name
