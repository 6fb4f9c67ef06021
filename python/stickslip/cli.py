"""The command ``stickslip``: slides records from the shell.

``stickslip slide kobe.AT2 --mu 0.1 0.2 0.3`` prints how far a block slides; ``stickslip slide
--help`` tells all. A subcommand is a function that adds its arguments and one that runs them.

Exit codes: 0, also for a slider that never comes to rest, which its row says; 2 where the input was
refused, with one line on stderr and nothing on stdout.
"""

from __future__ import annotations

import argparse
import math
import os
import sys
from collections.abc import Iterable
from pathlib import Path

from . import (
    STANDARD_GRAVITY,
    Caster,
    ConvergenceError,
    Coulomb,
    GroundMotion,
    Response,
    Slider,
    build_info,
    integrate,
    read_record,
)

__all__ = ["main"]


def main(argv: list[str] | None = None) -> int:
    """Runs the command.

    Parameters
    ----------
    argv : list of str, optional
        The arguments, without the command's own name; those of the process if not given.

    Returns
    -------
    int
        The exit code.

    Raises
    ------
    SystemExit
        From argparse: code 0 after --help or --version, 2 for arguments it refuses.
    """
    parser = argparse.ArgumentParser(
        prog="stickslip",
        description="How far things held by friction slide in earthquakes.",
        formatter_class=argparse.RawDescriptionHelpFormatter,  # keeps the lines of --version
    )
    parser.add_argument("--version", action="version", version=_version())
    commands = parser.add_subparsers(metavar="COMMAND", required=True)
    for add in (_add_slide,):
        add(commands)
    args = parser.parse_args(argv)
    try:
        print(args.run(args), flush=True)
    except BrokenPipeError:  # the reader, as `head`, has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except OSError as error:
        return _refuse(f"{error.filename}: {error.strerror}" if error.filename else str(error))
    except (ImportError, OverflowError, ValueError) as error:
        return _refuse(str(error))
    return 0


def _refuse(message: str) -> int:
    print(f"stickslip: {message}", file=sys.stderr)
    return 2


def _version() -> str:
    info = build_info()
    contained = [
        f"{name} {info[key]}"
        for name, key in (("FFTW", "fftw"), ("GSL", "gsl"), ("SUNDIALS", "sundials"))
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


def _add_slide(commands: argparse._SubParsersAction) -> None:
    parser = commands.add_parser(
        "slide",
        help="slide records and print displacements",
        description="Slides a block through strong-motion records, and on after their end until it"
        " rests. Prints peak, residual and path length of the displacement relative to the ground"
        " [cm], the time sliding [s] and the number of slips (a reversal ends one and begins"
        " another). Ground acceleration is given in g = 9.80665 m/s^2.",
        epilog="A slider that does not come to rest (no friction; a caster that has escaped) is"
        " reported as it is when the record ends, and its row says so.",
    )
    add = parser.add_argument
    add("records", nargs="+", type=Path, metavar="RECORD", help="file: AT2, COSMOS, GeoNet, CSV")
    add("--mu", nargs="+", type=float, required=True, help="coefficients of friction [-]")
    add("--law", choices=("coulomb", "caster", "one-way"), default="coulomb", help="friction law")
    add("--reach", type=float, metavar="M", help="caster: where the level falls off [m]")
    add("--period", type=float, metavar="S", help="period of the mass on its spring [s]")
    add("--slope", type=float, metavar="DEGREES", help="inclined plane; downhill is forward")
    add("--units", help="of acceleration, where the file states none: g, cm/s^2, ...")
    add("--component", help="where the file has several: its name, or its number from 1")
    add("--scale", type=float, default=1.0, help="factor on the ground acceleration")
    add("--plot", type=Path, metavar="FILE", help="picture (.png, .pdf, .svg), one for each record")
    add("--json", action="store_true", help="one JSON document, SI units, exact doubles")
    parser.set_defaults(run=_slide)


def _slide(args: argparse.Namespace) -> str:
    if args.plot:
        from . import plotting  # matplotlib: only who plots waits for it

        plotting.check_suffix(args.plot)
    sliders = {mu: _slider(args, mu) for mu in args.mu}
    rows, figures = [], {}
    for place, record in enumerate(args.records, 1):
        motion = read_record(record, units=args.units, component=args.component)
        if args.scale != 1:
            motion = motion.scaled(args.scale)
        responses = [_settle(slider, motion) for slider in sliders.values()]
        rows += [_row(args, record, mu, response) for mu, response in zip(sliders, responses)]
        if args.plot:
            name = args.plot
            if len(args.records) > 1:
                name = name.with_stem(f"{name.stem}-{place}-{record.stem}")
            figures[name] = (
                plotting.plot_response(responses[0])
                if len(responses) == 1
                else plotting.plot_responses(responses, [f"\u03bc = {mu:g}" for mu in sliders])
            )
    for name, figure in figures.items():
        plotting.save(figure, name)
    written = [str(name) for name in figures]
    if args.json:
        import json

        document = {"stickslip": build_info()["version"], "results": rows, "figures": written}
        return json.dumps(document, indent=2, allow_nan=False)
    return "\n".join([*_table(rows), *(f"wrote {name}" for name in written)])


def _slider(args: argparse.Namespace, mu: float) -> Slider:
    """The slider of the command line for one coefficient of friction."""
    if args.law != "caster" and args.reach is not None:
        raise ValueError(f"--reach goes with --law caster, got --law {args.law}")
    if args.law == "caster":
        if args.reach is None:
            raise ValueError("--law caster needs --reach in metres, got none")
        if args.slope is not None:
            raise ValueError(f"--slope goes with --law coulomb or one-way, got --law {args.law}")
        law = Caster(mu=mu, reach=args.reach)
    else:
        law = Coulomb(mu=mu) if args.slope is None else Coulomb.on_slope(mu=mu, degrees=args.slope)
        if args.law == "one-way":
            law = Coulomb(slip_level=law.slip_level, backward=math.inf)
    if args.period is None:
        return Slider(law)
    if not args.period > 0:
        raise ValueError(f"--period must be positive, got {args.period:g} s")
    return Slider(law, natural_frequency=2 * math.pi / args.period)


def _settle(slider: Slider, motion: GroundMotion) -> Response:
    try:
        return integrate(slider, motion, settle=True)
    except ConvergenceError:
        return integrate(slider, motion)


def _row(args: argparse.Namespace, file: Path, mu: float, response: Response) -> dict:
    """One response: keys carry their units; an infinite level is None."""
    slider = response.slider
    forward, backward = (slider.level(backward=back) for back in (False, True))
    return {
        "file": str(file),
        "record": response.motion.name,
        "scale": args.scale,
        "pga_g": response.motion.peak_acceleration / STANDARD_GRAVITY,
        "law": args.law,
        "mu": mu,
        "slip_level_forward_m_s2": forward,
        "slip_level_backward_m_s2": None if math.isinf(backward) else backward,
        "reach_m": args.reach,
        "slope_degrees": args.slope,
        "period_s": args.period,
        "peak_m": response.peak,
        "residual_m": response.residual,
        "sliding_distance_m": response.sliding_distance,
        "time_sliding_s": response.time_sliding,
        "slips": response.slips,
        "at_rest": response.at_rest,
    }


def _table(rows: list[dict]) -> Iterable[str]:
    width = max(len("record"), *(len(row["record"] or row["file"]) for row in rows))
    yield (
        f"{'record':{width}}  PGA [g]     mu  peak [cm]  residual [cm]  distance [cm]"
        "  sliding [s]  slips"
    )
    last = None
    for row in rows:
        name = row["record"] or row["file"]
        head = f"{name:{width}}  {row['pga_g']:7.3f}"
        yield (
            f"{head if row['file'] != last else '':{width + 9}}  {row['mu']:5.4g}"
            f"  {row['peak_m'] * 100:9.2f}  {row['residual_m'] * 100:13.2f}"
            f"  {row['sliding_distance_m'] * 100:13.2f}  {row['time_sliding_s']:11.2f}"
            f"  {row['slips']:5d}{'' if row['at_rest'] else '  never rests: at end of record'}"
        )
        last = row["file"]
