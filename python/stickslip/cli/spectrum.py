"""``stickslip spectrum``: response spectra of records."""

from __future__ import annotations

import argparse
from collections.abc import Iterable, Iterator
from typing import Any

from .. import STANDARD_GRAVITY, ResponseSpectrum, response_spectrum
from .._text import printable
from .options import SCALE, add_options
from .output import column
from .reading import RECORDS, Motion, Records
from .report import outputs

__all__ = ["add_spectrum"]

# For each kind: the heading of the table, its unit in SI units, and the key in files.
_KINDS = {
    "pseudo_acceleration": ("PSA [g]", STANDARD_GRAVITY, "pseudo_acceleration_m_s2"),
    "pseudo_velocity": ("PSV [cm/s]", 0.01, "pseudo_velocity_m_s"),
    "displacement": ("SD [cm]", 0.01, "displacement_m"),
    "velocity": ("SV [cm/s]", 0.01, "velocity_m_s"),
    "acceleration": ("SA [g]", STANDARD_GRAVITY, "acceleration_m_s2"),
}
_PRINTED = [0.0, 0.1, 0.2, 0.3, 0.5, 1.0, 2.0, 3.0]  # periods [s]
_DRAWN = [10 ** (k / 33 - 2) for k in range(100)]  # 100 from 0.01 to 10 s
_OPTIONS = f"""
--periods numbers... T
    undamped natural periods [s], 0 or from 1e-6 to 1e6, such as 0.1:4:0.1
--damping ratios... Z = 0.05
    ratios of critical damping, at least 0 and below 2 (default 0.05)
--kind {"|".join(_KINDS)} = pseudo_acceleration
    spectral quantity (default pseudo_acceleration)
"""


def add_spectrum(commands: argparse._SubParsersAction) -> None:
    parser = commands.add_parser(
        "spectrum",
        help="print the response spectra of records",
        description="Computes elastic response spectra of records: the maximum response of linear"
        " oscillators, in continuous time, exact for straight lines between samples. Prints it for"
        " a few periods (0 is a rigid oscillator: the PGA), or for those of --periods. Pictures,"
        " CSV and JSON have 100 periods from 0.01 to 10 s, or those of --periods.",
        epilog="For example, `stickslip spectrum sample:Kobe --plot spectrum.png`."
        " --periods, --damping and --scale take numbers or ranges START:STOP:STEP. A file"
        " that cannot be read is reported in one line on stderr; the others are printed, and the"
        " exit code is 1.",
    )
    add_options(parser, RECORDS, _OPTIONS, SCALE, outputs())
    parser.set_defaults(horizontal=False, run=_spectrum)


def _spectrum(args: argparse.Namespace) -> str:
    for zeta in args.damping:
        if not 0 <= zeta < 2:
            raise ValueError(f"--damping must be at least 0 and below 2, got {zeta:g}")
    for period in args.periods or []:
        if not (period == 0 or 1e-6 <= period <= 1e6):
            raise ValueError(f"--periods must be 0 or from 1e-6 to 1e6 s, got {period:g} s")
    records = Records(args, scaled=True)
    report = records.report
    printed: list[dict[str, Any]] = []
    rows: list[dict[str, Any]] = []
    in_files = args.csv or args.json or args.plot
    for found in records:
        with report.kept(found.file):
            motion = found.motion
            few = response_spectrum(motion, args.periods or _PRINTED, args.damping, kind=args.kind)
            printed += _rows(args, found, few)
            if not in_files:
                continue
            many = few
            if not args.periods:
                many = response_spectrum(motion, _DRAWN, args.damping, kind=args.kind)
            rows += _rows(args, found, many)
            if args.plot:
                report.save(many.plot(title=printable(motion.name)), found)
    names = ("file", "record", "component", "scale", "damping_ratio", "period_s")
    return report.answer((*names, _KINDS[args.kind][2]), rows, _table(args, printed))


def _rows(
    args: argparse.Namespace, found: Motion, spectrum: ResponseSpectrum
) -> Iterator[dict[str, Any]]:
    key = _KINDS[args.kind][2]
    values = spectrum.values.reshape(len(args.damping), -1).tolist()
    for zeta, row in zip(args.damping, values):
        for period, value in zip(spectrum.periods.tolist(), row):
            yield {
                "file": str(found.file),
                "record": found.motion.name,
                "component": found.component,
                "scale": args.scale,
                "damping_ratio": zeta,
                "period_s": period,
                key: value,
            }


def _table(args: argparse.Namespace, rows: list[dict[str, Any]]) -> Iterable[str]:
    if not rows:
        return
    heading, unit, key = _KINDS[args.kind]

    def named(row: dict[str, Any]) -> str:
        component = f" ({row['component']})" if row["component"] else ""
        return printable(row["record"] or row["file"]) + component

    width = max(len("record"), *(len(named(row)) for row in rows))
    yield f"{'record':{width}}  damping  period [s]  {heading:>10}"
    last: object = None
    for row in rows:
        this = row["file"], row["component"], row["damping_ratio"]
        head = f"{named(row):{width}}  {row['damping_ratio']:7.4g}"
        yield (
            f"{head if this != last else '':{width + 9}}  {row['period_s']:10.4g}"
            f"  {column(row[key] / unit, 10, 3)}"
        )
        last = this
