"""The command ``stickslip``: slides records from the shell.

``stickslip slide kobe.AT2 --mu 0.1 0.2 0.3`` prints how far a block slides; ``stickslip slide
--help`` tells all. ``stickslip ensemble --event "great very near field" --mu 0.2 --members 100000``
does so for random earthquakes, and ``stickslip thesis`` draws the thesis's figures anew. A
subcommand is a function that adds its arguments and one that runs them.

Exit codes: 0, also for a slider that never comes to rest, which its row says; 1 where ``stickslip
thesis --check`` finds a number off, or a checkpoint cannot be written at last; 2 where the input
was refused, with one line on stderr and nothing on stdout; 130 after Ctrl-C.
"""

from __future__ import annotations

import argparse
import math
import os
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from . import (
    STANDARD_GRAVITY,
    Caster,
    ConvergenceError,
    Coulomb,
    Ensemble,
    Estimate,
    GaussianExcitation,
    GroundMotion,
    Interval,
    PoissonPulses,
    Response,
    Slider,
    Spectrum,
    build_info,
    integrate,
    read_record,
)
from ._files import check_writable, replacing

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
    for add in (_add_slide, _add_ensemble, _add_thesis):
        add(commands)
    args = parser.parse_args(argv)
    args.code = 0
    try:
        print(args.run(args), flush=True)
    except BrokenPipeError:  # the reader, as `head`, has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except OSError as error:
        return _refuse(f"{error.filename}: {error.strerror}" if error.filename else str(error))
    except (ConvergenceError, ImportError, OverflowError, ValueError) as error:
        return _refuse(str(error))
    except KeyboardInterrupt:
        kept = getattr(args, "checkpoint", None)
        print(
            f"stickslip: interrupted{f'; {kept} has what was done' if kept else ''}",
            file=sys.stderr,
        )
        return 130
    return args.code


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
    _add_slider(parser)
    add("--units", help="of acceleration, where the file states none: g, cm/s^2, ...")
    add("--component", help="where the file has several: its name, or its number from 1")
    add("--scale", type=float, default=1.0, help="factor on the ground acceleration")
    add("--plot", type=Path, metavar="FILE", help="picture (.png, .pdf, .svg), one for each record")
    add("--json", action="store_true", help="one JSON document, SI units, exact doubles")
    parser.set_defaults(run=_slide)


def _add_slider(parser: argparse.ArgumentParser) -> None:
    """What `_slider` reads, but for --mu."""
    add = parser.add_argument
    add("--law", choices=("coulomb", "caster", "one-way"), default="coulomb", help="friction law")
    add("--reach", type=float, metavar="M", help="caster: where the level, mu g, falls off [m]")
    add("--trail", type=float, metavar="M", help="caster: pivot to wheel axis [m], for --reach")
    add("--wheel-width", type=float, metavar="M", help="caster: of its wheels [m], with --trail")
    add("--period", type=float, metavar="S", help="period of the mass on its spring [s]")
    add("--slope", type=float, metavar="DEGREES", help="inclined plane; downhill is forward")


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
    lengths = {"--reach": args.reach, "--trail": args.trail, "--wheel-width": args.wheel_width}
    given = [option for option, length in lengths.items() if length is not None]
    if args.law != "caster" and given:
        raise ValueError(f"{given[0]} goes with --law caster, got --law {args.law}")
    if args.law == "caster":
        if given not in (["--reach"], ["--trail", "--wheel-width"]):
            raise ValueError(
                "--law caster needs --reach, or --trail and --wheel-width, in metres, got "
                + (" and ".join(given) or "none")
            )
        if args.slope is not None:
            raise ValueError(f"--slope goes with --law coulomb or one-way, got --law {args.law}")
        law = (
            Caster(mu=mu, reach=args.reach)
            if given == ["--reach"]
            else Caster.from_geometry(mu=mu, trail=args.trail, wheel_width=args.wheel_width)
        )
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
        "reach_m": getattr(slider.law, "reach", None),
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


def _add_ensemble(commands: argparse._SubParsersAction) -> None:
    parser = commands.add_parser(
        "ensemble",
        help="slide many random earthquakes and print statistics",
        description="Slides a block through many members of a random ground motion and prints the"
        " distribution of its displacement relative to the ground, with standard errors (+-) and"
        " confidence bounds (in brackets). The ground motion is one of --event, --rate, --band.",
        epilog=f"Events: {', '.join(PoissonPulses.events())}.",
    )
    add = parser.add_argument
    source = parser.add_mutually_exclusive_group(required=True)
    source.add_argument("--event", metavar="NAME", help="pulses like those of an earthquake; below")
    source.add_argument("--rate", type=float, metavar="R", help="pulses, so many per second")
    source.add_argument(
        "--band",
        nargs=3,
        type=float,
        metavar=("S0", "LOW", "HIGH"),
        help="Gaussian motion of a two-sided density S0 [m^2/s^3] from LOW to HIGH [rad/s]",
    )
    add("--half-width", type=float, metavar="S", help="with --rate: of a pulse [s]")
    add("--sigma", type=float, metavar="A", help="with --rate: rms amplitude of pulses [m/s^2]")
    add("--duration", type=float, metavar="S", help="with --rate: of a motion [s]")
    add("--dt", type=float, metavar="S", help="with --band: between samples [s]")
    add("--samples", type=int, metavar="N", help="with --band: of a motion")
    add("--mu", type=float, required=True, help="coefficient of friction [-]")
    _add_slider(parser)
    add("--members", type=int, default=10_000, metavar="N", help="how many (default 10000)")
    add("--seed", type=int, default=0, metavar="N", help="names the random numbers (default 0)")
    add("--threads", type=int, metavar="N", help="as many as the machine has, if not given")
    add("--settle", action="store_true", help="go on after each motion until the block rests")
    add(
        "--level",
        nargs="+",
        type=float,
        default=[0.01, 0.03, 0.1, 0.3, 1.0],
        metavar="M",
        help="peaks whose probability of exceedance is printed [m] (default 0.01 0.03 0.1 0.3 1)",
    )
    add("--confidence", type=float, default=0.95, metavar="P", help="of the bounds (default 0.95)")
    add("--checkpoint", type=Path, metavar="FILE", help="keeps what is done; gone on from if there")
    add("--plot", type=Path, metavar="FILE", help="picture (.png, .pdf, .svg)")
    add("--json", action="store_true", help="one JSON document, SI units, exact doubles")
    parser.set_defaults(run=_ensemble)


def _ensemble(args: argparse.Namespace) -> str:
    if args.plot:
        from . import plotting  # matplotlib: only who plots waits for it

        plotting.check_suffix(args.plot)
    if args.members < 2:
        raise ValueError(f"--members must be at least 2, for standard errors, got {args.members}")
    for level in args.level:
        if not 0 <= level < math.inf:
            raise ValueError(f"--level must be finite and at least 0, got {level:g} m")
    if not 0 < args.confidence < 1:
        raise ValueError(f"--confidence must lie between 0 and 1, got {args.confidence:g}")
    from .ensemble import EnsembleError, run_ensemble  # NumPy: only who needs it waits for it

    if args.plot:
        check_writable(args.plot)
    try:
        ensemble = run_ensemble(
            _slider(args, args.mu),
            _excitation(args),
            members=args.members,
            seed=args.seed,
            threads=args.threads,
            settle=args.settle,
            progress=sys.stderr is not None and sys.stderr.isatty(),
            checkpoint=args.checkpoint,
        )
    except EnsembleError as error:  # the checkpoint could not be written
        ensemble = error.partial
        if ensemble.members < 2:
            raise ValueError(str(error)) from error
        print(f"stickslip: {error}", file=sys.stderr)
        args.code, args.checkpoint = 1, None
    result = _statistics(args, ensemble)
    written = [str(file) for file in (args.checkpoint, args.plot) if file]
    if args.plot:
        plotting.save(plotting.plot_ensemble(ensemble), args.plot)
    if args.json:
        import json

        document = {"stickslip": build_info()["version"], **result, "files": written}
        return json.dumps(document, indent=2, allow_nan=False)
    return "\n".join([*_report(args, result), *(f"wrote {name}" for name in written)])


def _excitation(args: argparse.Namespace) -> PoissonPulses | GaussianExcitation:
    """The ground motion of the command line."""
    belong = {"rate": ("half_width", "sigma", "duration"), "band": ("dt", "samples"), "event": ()}
    (kind,) = (kind for kind in belong if getattr(args, kind) is not None)
    for other, names in belong.items():
        for name in names:
            given, option = getattr(args, name) is not None, f"--{name.replace('_', '-')}"
            if given and other != kind:
                raise ValueError(f"{option} goes with --{other}, got --{kind}")
            if not given and other == kind:
                raise ValueError(f"--{kind} needs {option}, got none")
    if kind == "event":
        return PoissonPulses.event(args.event)
    if kind == "rate":
        return PoissonPulses(
            rate=args.rate, half_width=args.half_width, sigma=args.sigma, duration=args.duration
        )
    s0, low, high = args.band
    spectrum = Spectrum.band_pass(s0=s0, low=low, high=high)
    return GaussianExcitation(spectrum, dt=args.dt, samples=args.samples)


def _statistics(args: argparse.Namespace, ensemble: Ensemble) -> dict:
    """What is printed: keys carry their units; what is unbounded or not kept is None."""

    def interval(name: str, key: float, found: Interval) -> dict:
        high = None if math.isinf(found.high) else found.high
        return {name: key, "value": found.value, "low": found.low, "high": high}

    def estimate(found: Estimate) -> dict:
        return {"value": found.value, "error": found.error}

    shares = (0.5, 0.95, 0.99)
    stationary = ensemble.stationary
    return {
        "configuration": ensemble.configuration,
        "members": ensemble.members,
        "confidence": args.confidence,
        "peak_m": [interval("quantile", p, ensemble.quantile(p, args.confidence)) for p in shares],
        "exceedance": [
            interval("peak_m", level, ensemble.exceedance(level, args.confidence))
            for level in args.level
        ],
        **_residual(ensemble),
        "stationary": {
            "begin_s": stationary.begin,
            "end_s": stationary.end,
            "velocity_variance_m2_s2": estimate(stationary.velocity_variance),
            "growth_rate_m2_s": estimate(stationary.growth_rate),
        },
    }


def _residual(ensemble: Ensemble) -> dict:
    """Mean and root mean square of the residuals; None where they are not kept."""
    try:
        residual = ensemble.residual
    except ValueError:
        return {"residual_mean_m": None, "residual_rms_m": None}
    n = len(residual)
    squares = residual**2
    rms = math.sqrt(squares.mean())
    return {
        "residual_mean_m": {
            "value": float(residual.mean()),
            "error": float(residual.std(ddof=1)) / math.sqrt(n),
        },
        # d(rms) = d(rms^2) / (2 rms)
        "residual_rms_m": {
            "value": rms,
            "error": float(squares.std(ddof=1)) / math.sqrt(n) / (2 * rms) if rms else 0.0,
        },
    }


def _report(args: argparse.Namespace, result: dict) -> Iterable[str]:
    def row(name: str, which: str, found: dict, factor: float, unit: str) -> str:
        value = factor * found["value"]
        if "error" in found:
            error = factor * found["error"]
            text, around = _with_error(value, error)
        else:
            low = factor * found["low"]
            high = math.inf if found["high"] is None else factor * found["high"]
            text, around = f"{value:.4g}", f"({low:.4g} to {high:.4g})"
        return f"{name:24}{which:>9}  {text:>10} {unit:7}  {around}"

    stationary = result["stationary"]
    yield (
        f"{result['members']:,} members, seed {args.seed}; {100 * args.confidence:g} % bounds in"
        f" brackets, standard errors after +-"
    )
    for i, found in enumerate(result["peak_m"]):
        share = found["quantile"]
        which = "median" if share == 0.5 else f"{100 * share:g} %"
        yield row("" if i else "peak displacement", which, found, 100, "cm")
    for name in ("mean", "rms"):
        found = result[f"residual_{name}_m"]
        if found:
            yield row("residual displacement" if name == "mean" else "", name, found, 100, "cm")
    for i, found in enumerate(result["exceedance"]):
        level = f"{100 * found['peak_m']:g} cm"
        yield row("" if i else "peak exceeds", level, found, 100, "%")
    yield row("velocity variance", "", stationary["velocity_variance_m2_s2"], 1, "m^2/s^2")
    yield row("growth of variance of x", "", stationary["growth_rate_m2_s"], 1, "m^2/s")
    yield f"(the last two from {stationary['begin_s']:.3g} to {stationary['end_s']:.3g} s)"


def _with_error(value: float, error: float) -> tuple[str, str]:
    """The error to two digits and the value as far."""
    if not error > 0:
        return f"{value:.4g}", f"+- {error:.2g}"
    places = 1 - math.floor(math.log10(error))
    if 0 <= places <= 8:
        return f"{value:.{places}f}", f"+- {error:.{places}f}"
    digits = max(0, math.floor(math.log10(max(abs(value), error))) + places)
    return f"{value:.{digits}e}", f"+- {error:.1e}"


def _add_thesis(commands: argparse._SubParsersAction) -> None:
    parser = commands.add_parser(
        "thesis",
        help="draw the thesis's figures anew, theory beside simulation",
        description="Draws figures and tables of the thesis on the response of stick-slip systems"
        " to random seismic excitation: its own curves, exact answers, and ensembles with standard"
        " errors. Writes a picture and a CSV file of every curve and point for each, and a page"
        " of all of them, gallery.md; prints what the thesis says in numbers and what is found."
        " With --check it prints each number beside the one expected and by how much it may be off,"
        " exits with 1 if one is, and writes nothing unless --out is given.",
    )
    add = parser.add_argument
    add("numbers", nargs="*", metavar="NUMBER", help="as 4.6, A.2, 'Table 5.1'; all if none")
    add("--members", type=int, metavar="N", help="of an ensemble (default 100000; --check: 2000)")
    add("--seed", type=int, metavar="N", help="names the random numbers (default 1; --check: 2)")
    add("--threads", type=int, metavar="N", help="as many as the machine has, if not given")
    add("--out", type=Path, metavar="FOLDER", help="where to (default: thesis); --check: draw too")
    add("--format", choices=("png", "pdf", "svg"), default="png", help="of pictures (default png)")
    add("--check", action="store_true", help="against what is expected, quickly")
    parser.set_defaults(run=_thesis)


def _thesis(args: argparse.Namespace) -> str:
    from . import thesis

    folder = args.out or (None if args.check else Path("thesis"))
    if folder:
        from . import plotting  # matplotlib: only who plots waits for it

        folder.mkdir(parents=True, exist_ok=True)
    numbers = args.numbers or thesis.Thesis.numbers
    for number in numbers:
        if number not in thesis.Thesis.numbers:
            raise ValueError(
                f"NUMBER must be one of {', '.join(thesis.Thesis.numbers)}, got {number}"
            )
    members = args.members if args.members is not None else 2000 if args.check else 100_000
    seed = args.seed if args.seed is not None else 2 if args.check else 1
    shown = sys.stderr is not None and sys.stderr.isatty()

    def heartbeat(what: str, share: float) -> None:
        print(f"\r\33[K{what} {share:4.0%}", end="", file=sys.stderr, flush=True)

    source = thesis.Thesis(
        members=members,
        seed=seed,
        threads=args.threads,
        heartbeat=heartbeat if shown else None,
    )
    figures, lines = [], []
    try:
        for number in numbers:
            figure = source.figure(number)
            figures.append(figure)
            if folder:
                stem = folder / thesis.file_stem(number)
                with replacing(stem.with_suffix(".csv")) as stream:
                    stream.write(figure.csv().encode())
                plotting.save(thesis.plot(figure), stem.with_suffix(f".{args.format}"))
            if args.check:
                lines += [_checked(check) for check in figure.check(members)]
    finally:
        if shown:
            print("\r\33[K", end="", file=sys.stderr, flush=True)
    summary = thesis.thesis_summary(figures)
    if folder:
        with replacing(folder / "gallery.md") as stream:
            stream.write(thesis.page(figures, f".{args.format}").encode())
    if not args.check:
        return f"{summary}wrote {len(figures)} figures to {folder}"
    off = sum(line.startswith("off") for line in lines)
    args.code = 1 if off else 0
    return "\n".join([*lines, f"{len(lines)} numbers of {len(figures)} figures, {off} off"])


def _checked(check: Any) -> str:
    return (
        f"{'holds' if check.holds else 'off  '}  {check.what:28} found {check.found:<14.8g}"
        f" expected {check.expected:<14.8g} +- {check.allowed:.2g}"
    )
