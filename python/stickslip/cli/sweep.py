"""``stickslip sweep``: statistics of many sliders over many records."""

from __future__ import annotations

import argparse
import math
import warnings
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .building import BUILDING, building_on
from .options import SCALE, add_options
from .output import column, complain
from .reading import RECORDS, VERTICAL, Records
from .report import outputs
from .slider import (
    PLANAR,
    SLIDERS,
    any_slider_of,
    cells,
    check_planar,
    described,
    first_of,
    heads,
    keyed,
    variations,
)

if TYPE_CHECKING:
    from ..sweeps import SweepTable

__all__ = ["add_sweep"]

# Statistics over the responses of a slider: key, head, probability (None: the mean).
_STATISTICS = (
    ("mean", "mean", None),
    ("p16", "16 %", 0.16),
    ("median", "median", 0.5),
    ("p84", "84 %", 0.84),
    ("largest", "largest", 1.0),
)
_QUANTITIES = ("peak", "residual")
_POLARITY = """
--polarity recorded|reversed|both
    slide each record as recorded, reversed, or both (the default; as recorded with --planar)
"""


def add_sweep(commands: argparse._SubParsersAction) -> None:
    """Add the subcommand."""
    parser = commands.add_parser(
        "sweep",
        help="slide many blocks under many records and print statistics",
        description="Slides blocks under strong-motion records until they come to rest and prints,"
        " for each block, statistics over the records of the peak and of the magnitude of the"
        " residual [cm]: mean, 16 %, median, 84 % and largest value. On one axis each record acts"
        " as recorded and reversed. With --planar, both horizontal components of each station act"
        " at once, and peak and residual are distances from the start.",
        epilog="For example, `stickslip sweep quakes/*.AT2 --mu 0.05:0.6:0.05 --plot sweep.png`."
        " --mu and the options of the slider take numbers or ranges START:STOP:STEP; every"
        " combination is computed. A record that cannot be read or slid is reported in one line on"
        " stderr; the statistics are those of the others, and the exit code is 1. CSV and JSON"
        " have every response; in JSON the statistics are listed besides.",
    )
    tables = (RECORDS, SLIDERS, BUILDING, VERTICAL, PLANAR, SCALE, _POLARITY, outputs(each=""))
    add_options(parser, *tables)
    parser.set_defaults(horizontal=True, one_picture=True, contact=None, run=_sweep)


def _sweep(args: argparse.Namespace) -> str:
    from ..sweeps import sweep  # imports NumPy, slowly
    from ..sweeps.parameter_grid import Grid

    cases, several = variations(args)
    shown = list(dict.fromkeys([first_of(args), *several]))
    if args.planar:
        check_planar(args)
    parameters = {name: [getattr(case, name) for case in cases] for name in shown}
    sliders = Grid([building_on(any_slider_of(case), case) for case in cases], parameters)
    records = Records(args, scaled=True)
    report = records.report
    found = list(records)
    if not found:
        return report.answer((), [], (), statistics=[])
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "sweep: .* combinations failed")  # reported below
        table = sweep(
            sliders,
            [one.motion for one in found],
            polarity=args.polarity or ("recorded" if args.planar else "both"),
            settle=True,
            contact=args.contact,
        )
    if table.remark and not table.remark.startswith("nothing slips"):  # of which a warning tells
        complain(f"warning: {table.remark}")
    for place, slider, message in dict.fromkeys(
        (one.record, one.slider, one.message.partition(":")[0]) for one in table.failures
    ):
        with report.kept(found[place].file):
            raise ValueError(f"{', '.join(described(cases[slider], several))}: {message}")
    rows = _rows(cases, [one.file for one in found], table, shown)
    statistics = _statistics(cases, table, shown)
    if args.plot:
        with report.kept(args.plot):
            report.save(table.plot())
    columns = dict.fromkeys(name for row in rows for name in row)
    return report.answer(columns, rows, _lines(statistics, shown), statistics=statistics)


def _rows(
    cases: list[argparse.Namespace], files: list[Path], table: SweepTable, shown: list[str]
) -> list[dict[str, Any]]:
    """A row for each response, by record; keys include units."""
    from ..sweeps.table import UNITS

    arrays = {
        f"{name}_{UNITS[name].replace('/', '_')}" if name in UNITS else name: values.tolist()
        for name, values in table.arrays(columns=True).items()
    }
    return [
        {
            "file": str(file),
            "record": table.records[r],
            "scale": case.scale,
            **keyed(case, shown),
            "polarity": polarity,
            **{name: values[s][r][p] for name, values in arrays.items()},
        }
        for r, file in enumerate(files)
        for s, case in enumerate(cases)
        for p, polarity in enumerate(table.polarity)
        if not math.isnan(table.peak[s, r, p])  # it failed, and is reported
    ]


def _statistics(
    cases: list[argparse.Namespace], table: SweepTable, shown: list[str]
) -> list[dict[str, Any]]:
    """A row for each slider that has responses."""
    import numpy as np

    counts = np.isfinite(table.peak).sum(axis=(1, 2)).tolist()
    rows = [{**keyed(case, shown), "responses": n} for case, n in zip(cases, counts)]
    for quantity in _QUANTITIES:
        for key, _, p in _STATISTICS:
            values = table.mean(quantity) if p is None else table.quantile(p, quantity)
            for row, value in zip(rows, values.tolist()):
                row[f"{quantity}_{key}_m"] = value
    if cases[0].stop_gap is not None:
        for row, value in zip(rows, table.impact_fraction.tolist()):
            row["impact_fraction"] = value
    return [row for row in rows if row["responses"]]


def _lines(statistics: list[dict[str, Any]], shown: list[str]) -> Iterable[str]:
    if not statistics:
        return
    options = heads(shown)
    stops = "impact_fraction" in statistics[0]
    yield (f"{'':{len(options) + 9}}  {'peak [cm]':{9 * len(_STATISTICS) - 2}}  residual [cm]")
    names = "".join(f"  {head:>7}" for _, head, _ in _STATISTICS)
    yield f"{options}  responses"[2:] + names * len(_QUANTITIES) + ("  hit a stop" if stops else "")
    for row in statistics:
        values = "".join(
            f"  {column(100 * row[f'{quantity}_{key}_m'], 7)}"
            for quantity in _QUANTITIES
            for key, _, _ in _STATISTICS
        )
        hits = f"  {100 * row['impact_fraction']:8.3g} %" if stops else ""
        yield f"{cells(row, shown)}  {row['responses']:9d}"[2:] + values + hits
