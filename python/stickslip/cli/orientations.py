"""``stickslip orientations``: sliding along all horizontal directions of stations."""

from __future__ import annotations

import argparse
import warnings
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .._text import printable
from .batch import Batch, add_files
from .output import column, complain, json_text, write_csv
from .parser import numbers, ratio, ratios
from .slider import add_contact, add_slider, described, heading, slider_of, variations

if TYPE_CHECKING:
    from ..sweeps import Orientations

__all__ = ["add_orientations"]

_COLUMNS = ("file", "station", "scale", "mu", "degrees", "peak_m", "residual_m")
_PERCENTILES = (0, 50, 100)


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
        epilog="--mu, --degrees and the options of the slider take numbers or ranges"
        " START:STOP:STEP; every combination is computed. A station that cannot be read or slid is"
        " reported in one line on stderr; the others are printed, and the exit code is 1.",
    )
    add = parser.add_argument
    add_files(parser)
    add(
        "--mu",
        nargs="+",
        type=ratios,
        required=True,
        help="coefficients of friction [-] or ranges; a repeated value is used once",
    )
    add_slider(parser, ranges=True)
    add_contact(parser)
    add(
        "--degrees",
        nargs="+",
        type=numbers,
        metavar="D",
        help="directions (default 0:179:1; 0:359:1 where opposite directions differ)",
    )
    add("--scale", type=ratio, default=1.0, help="factor on the ground acceleration (default 1)")
    add("--plot", type=Path, metavar="FILE", help="picture (.png, .pdf, .svg), one per station")
    add("--csv", type=Path, metavar="FILE", help="a row for each direction, exact doubles")
    add("--json", action="store_true", help="one JSON document, SI units, exact doubles")
    parser.set_defaults(horizontal=True, station=True, run=_orientations)


def _orientations(args: argparse.Namespace) -> str:
    from ..sweeps import orientations  # imports NumPy, slowly

    cases, several = variations(args)
    sliders = [(case, slider_of(case)) for case in cases]
    if args.plot and len(sliders) > 1:
        raise ValueError(f"--plot draws one slider, got {len(sliders)}")
    batch = Batch(args)
    rows: list[dict[str, Any]] = []
    printed: list[dict[str, Any]] = []
    written: list[str] = []
    for place, file, found in batch.motions():
        motion = found.motion if args.scale == 1 else found.motion.scaled(args.scale)
        for case, slider in sliders:
            with batch.reported(file):
                with warnings.catch_warnings(record=True) as caught:
                    warnings.simplefilter("always")
                    table = orientations(
                        slider, motion, args.degrees, settle=True, contact=args.contact
                    )
                if table.failures:
                    direction, reason = table.failures[0]
                    raise ValueError(f"at {direction:g} degrees: {reason}")
                for warning in caught:
                    complain(f"warning: {file}: {warning.message}")
                about = {
                    "file": str(file),
                    "station": motion.name,
                    "scale": args.scale,
                    **{name: getattr(case, name) for name in ("mu", *several)},
                }
                columns = table.degrees.tolist(), table.peak.tolist(), table.residual.tolist()
                for row in zip(*columns):
                    rows.append({**about, **dict(zip(_COLUMNS[-3:], row))})
                printed.append({**about, "from_north": table.from_north, **_percentiles(table)})
                if args.plot:
                    picture = batch.picture(place, found)
                    label = ", ".join(described(case, several))
                    _draw(table, f"{motion.name}, {label}", picture)
                    written.append(str(picture))
    if args.csv:
        names = [name for name in _COLUMNS if name != "mu"]
        write_csv(args.csv, [*names[:3], *dict.fromkeys(["mu", *several]), *names[3:]], rows)
    said = batch.finish()
    if args.json:
        return json_text({"results": rows, "percentiles": printed, **said, "figures": written})
    written += [str(args.csv)] if args.csv else []
    return "\n".join([*_lines(printed, several), *(f"wrote {printable(n)}" for n in written)])


def _percentiles(table: Orientations) -> dict[str, float]:
    found = {}
    for nn in _PERCENTILES:
        one = table.percentile(nn)
        for name in ("peak", "residual"):
            found[f"rotd{nn:02d}_{name}_m"] = getattr(one, name)
            found[f"rotd{nn:02d}_{name}_degrees"] = getattr(one, f"{name}_degrees")
    return found


def _draw(table: Orientations, name: str, file: Path) -> None:
    from .. import plotting

    plotting.save(table.plot(title=printable(name)), file)


def _lines(rows: list[dict[str, Any]], several: list[str]) -> Iterable[str]:
    if not rows:
        return
    names = [printable(row["station"] or row["file"]) for row in rows]
    width = max(len("station"), *map(len, names))
    varied = list(dict.fromkeys(["mu", *several]))
    heads = "".join(f"  {heading(name):>9}" for name in varied)
    blank = " " * (width + 11 * len(varied))
    yield f"{blank}  peak [cm]{'':29}  residual [cm]"
    quantities = "".join(f"  {'RotD00':>7}  {'RotD50':>7}  {'RotD100':>7}  at [deg]" for _ in "pr")
    yield f"{'station':{width}}{heads}{quantities}"
    last = None
    for name, row in zip(names, rows):
        cells = "".join(f"  {row[one]:9.4g}" for one in varied)
        for quantity in ("peak", "residual"):
            for nn in _PERCENTILES:
                cells += f"  {column(100 * row[f'rotd{nn:02d}_{quantity}_m'], 7)}"
            cells += f"  {row[f'rotd100_{quantity}_degrees']:8.4g}"
        yield f"{name if name != last else '':{width}}{cells}"
        last = name
