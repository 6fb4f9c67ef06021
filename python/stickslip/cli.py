"""The command ``stickslip``: slide records from the shell.

``stickslip slide kobe.AT2 --mu 0.1 0.2 0.3`` prints how far a block slides; ``stickslip slide
--help`` lists the options. ``stickslip ensemble --event "great very near field" --mu 0.2 --members
100000`` prints statistics for random earthquakes, and ``stickslip thesis`` redraws the figures of
the thesis. Each subcommand is one function that adds its arguments and one that runs it.

Exit codes: 0 on success, also for a slider that never comes to rest, which its row says; 1 where
part of the work failed and the rest is printed: a record that cannot be read or slid, a picture or
checkpoint that cannot be written, each with one line on stderr, or a number that is off in
``stickslip thesis --check``; 2 where nothing is printed on stdout: bad options, an input error
(with ``slide``, only under ``--strict``) or not enough memory, with one line on stderr, after the
usage where the options do not parse; 130 after Ctrl-C.

JSON output has no infinity: null is an infinite value (a slip level, a reach, a bound) or an option
that was not given.
"""

from __future__ import annotations

import argparse
import contextlib
import errno
import math
import os
import sys
import warnings
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any, NoReturn, TextIO

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
    sample_record,
)
from ._core import acceleration_unit
from ._files import check_writable, replacing
from ._text import printable

__all__ = ["main"]

_SAMPLE = "sample:"  # before the name of a sample record, in place of a file
_FAILURES = (ConvergenceError, ImportError, MemoryError, OSError, OverflowError, ValueError)


def main(argv: list[str] | None = None) -> int:
    """Run the command.

    Parameters
    ----------
    argv : list of str, optional
        The arguments, without the name of the command; by default those of the process.

    Returns
    -------
    int
        The exit code.

    Raises
    ------
    SystemExit
        From argparse: code 0 after --help or --version, 2 for arguments that do not parse.
    """
    parser = _Parser(
        prog="stickslip",
        description="How far things held by friction slide in earthquakes.",
        epilog="""\
exit codes:
  0    success
  1    part of the work failed, with a line on stderr each; the rest is printed
       (thesis --check: a number is off)
  2    bad options, or an input error that ends the command; nothing is printed
  130  interrupted by Ctrl-C""",
        formatter_class=argparse.RawDescriptionHelpFormatter,  # keeps the lines of --version
    )
    parser.add_argument("--version", action="version", version=_version())
    commands = parser.add_subparsers(metavar="COMMAND", required=True)
    for add in (_add_slide, _add_newmark, _add_ensemble, _add_thesis):
        add(commands)
    args = argparse.Namespace(code=0)
    try:
        parser.parse_args(argv, args)
        with warnings.catch_warnings():
            warnings.showwarning = lambda message, *_: _complain(f"warning: {message}")
            text = args.run(args)
        if text:
            _write(f"{text}\n", sys.stdout)
    except BrokenPipeError:  # the reader, such as `head`, has seen enough
        return args.code
    except (*_FAILURES, _StrictError) as error:
        _complain(_reason(error))
        return 2
    except KeyboardInterrupt:
        kept = getattr(args, "checkpoint", None)
        saved = f"; {kept} has what was done" if kept and kept.exists() else ""
        _complain(f"interrupted{saved}")
        return 130
    return args.code


class _Parser(argparse.ArgumentParser):
    """Applies one rule to repeated options, `_Store`, and prints as the rest of the command."""

    def __init__(self, **options: Any) -> None:
        super().__init__(**options)
        for action in (None, "store"):
            self.register("action", action, _Store)

    def error(self, message: str) -> NoReturn:
        # argparse prints the usage on stdout where stderr is closed
        self.exit(2, f"{self.format_usage()}{self.prog}: error: {printable(message)}\n")

    def _print_message(self, message: str, file: TextIO | None = None) -> None:
        if file is sys.stdout:
            _write(message, file)
        else:
            _write_error(message)


class _Store(argparse.Action):
    """Repeated lists add up, and an option's list has each value once; else one value is one."""

    given: Any = None

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,
    ) -> None:
        if self.nargs in ("+", "*"):
            values = [*(self.given or ()), *values]
            if self.option_strings:
                values = list(dict.fromkeys(values))
        elif self.given is not None:
            parser.error(f"{self.option_strings[0]} given twice: {self.given}, then {values}")
        self.given = values
        setattr(namespace, self.dest, values)


def _text(argument: str) -> str:
    """An argument that is no path: undecodable bytes, which only paths may have, are refused."""
    try:
        argument.encode()
    except UnicodeEncodeError:
        raise argparse.ArgumentTypeError(
            f"must be encoded in {sys.getfilesystemencoding()}, got {argument!r}"
        ) from None
    return argument


# ---- what is printed


def _write(text: str, stream: TextIO | None) -> None:
    try:
        if stream is None:
            raise OSError(errno.EBADF, os.strerror(errno.EBADF))
        encoding = getattr(stream, "encoding", None) or "utf-8"
        stream.write(text.encode(encoding, "backslashreplace").decode(encoding))
        stream.flush()
    except OSError as error:
        with contextlib.suppress(AttributeError, OSError):  # else Python fails again at exit
            os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
        raise OSError(error.errno, error.strerror, "standard output") from error


def _write_error(text: str) -> None:
    with contextlib.suppress(OSError):  # nobody is left to be told
        _write(text, sys.stderr)


def _complain(message: str) -> None:
    _write_error(f"stickslip: {printable(message)}\n")


def _reason(error: BaseException, file: Path | None = None) -> str:
    """What went wrong, without the name of `file`."""
    if isinstance(error, OSError) and error.strerror:
        named = error.filename is not None and str(error.filename) != str(file)
        return f"{error.filename}: {error.strerror}" if named else error.strerror
    if isinstance(error, MemoryError):
        detail = str(error).replace("std::bad_alloc", "")
        return f"not enough memory{f': {detail}' if detail else ''}"
    return str(error).removeprefix(f"read_record: {file}: ")


def _json(document: dict) -> str:
    """Exact doubles; infinity, which JSON lacks, becomes null, and NaN raises ValueError."""
    import json

    def finite(value: Any) -> Any:
        if isinstance(value, dict):
            return {key: finite(item) for key, item in value.items()}
        if isinstance(value, list):
            return [finite(item) for item in value]
        return None if value == math.inf else value

    document = {"stickslip": build_info()["version"], **finite(document)}
    return json.dumps(document, indent=2, allow_nan=False)


def _check_outputs(outputs: Iterable[tuple[str, Path]], records: Iterable[Path] = ()) -> None:
    """Raises where a file cannot be made or would replace a record or another output."""
    taken = {_identity(record): f"the record {record}" for record in records}
    for option, file in outputs:
        try:
            check_writable(file)
        except OSError as error:
            if (
                error.errno != errno.ENAMETOOLONG
            ):  # by the name of one record: no more than its picture fails
                raise
        owner = f"the file of {option}, {file}"
        if taken.setdefault(_identity(file), owner) is not owner:
            raise ValueError(f"{option} {file} would overwrite {taken[_identity(file)]}")


def _check_whole(option: str, value: int | None, least: int, most: int = 2**64 - 1) -> None:
    if value is not None and not least <= value <= most:
        bound = f"at least {least}" if value < least else f"at most {most}"
        raise ValueError(f"{option} must be {bound}, got {value}")


def _identity(file: Path) -> Any:
    """Equal for all names of one file: relative, symbolic and hard links."""
    try:
        status = file.stat()
    except OSError:
        return os.path.realpath(file)
    return status.st_dev, status.st_ino


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


# ---- slide


def _add_slide(commands: argparse._SubParsersAction) -> None:
    parser = commands.add_parser(
        "slide",
        help="slide records and print displacements",
        description="Slides a block through strong-motion records and continues after the end of"
        " each record until the block comes to rest. Prints peak, residual and path length of the"
        " displacement relative to the ground [cm], the time spent sliding [s] and the number of"
        " slips (a reversal ends one slip and begins another). Ground acceleration is given in g ="
        " 9.80665 m/s^2.",
        epilog="A slider that does not come to rest (no friction; a caster that has escaped) is"
        " reported in its state at the end of the record, and its row says so. A record that cannot"
        " be read or slid is reported in one line on stderr; the others are printed, and the exit"
        " code is 1. With --json, such failures are also listed under 'errors', and null is an"
        " infinite value or an option that was not given. Bad options end the command with exit"
        " code 2 before any file is read.",
    )
    add = parser.add_argument
    add(
        "records",
        nargs="+",
        type=Path,
        metavar="RECORD",
        help="file: AT2, COSMOS, GeoNet, CSV; or sample:Kobe, a sample record",
    )
    add(
        "--mu",
        nargs="+",
        type=float,
        required=True,
        help="coefficients of friction [-]; a repeated value is used once",
    )
    _add_slider(parser)
    add("--units", type=_text, help="acceleration unit of files that state none: g, cm/s^2, ...")
    add("--component", type=_text, help="name or number (from 1), where a file has several")
    add("--scale", type=float, default=1.0, help="factor on the ground acceleration (default 1)")
    add(
        "--strict",
        action="store_true",
        help="stop at the first failure, with exit code 2 and nothing on stdout; pictures written"
        " before it remain",
    )
    add("--plot", type=Path, metavar="FILE", help="picture (.png, .pdf, .svg), one for each record")
    add("--json", action="store_true", help="one JSON document, SI units, exact doubles")
    parser.set_defaults(run=_slide)


def _add_slider(parser: argparse.ArgumentParser) -> None:
    """The options that `_slider` reads, except --mu."""
    add = parser.add_argument
    add("--law", choices=("coulomb", "caster", "one-way"), default="coulomb", help="friction law")
    add("--reach", type=float, metavar="M", help="caster: distance over which the level falls [m]")
    add(
        "--trail",
        type=float,
        metavar="M",
        help="caster: pivot to wheel axis [m]; with --wheel-width, instead of --reach",
    )
    add("--wheel-width", type=float, metavar="M", help="caster: width of a wheel [m]; with --trail")
    add("--period", type=float, metavar="S", help="period of the mass on its spring [s]")
    add("--damping-ratio", type=float, metavar="Z", help="damping ratio; with --period")
    add("--slope", type=float, metavar="DEGREES", help="inclined plane; downhill is forward")


class _StrictError(Exception):
    """The first failure of a batch under --strict."""


def _slide(args: argparse.Namespace) -> str:
    sliders = {mu: _slider(args, mu) for mu in args.mu}
    if not math.isfinite(args.scale):
        raise ValueError(f"--scale must be finite, got {args.scale:g}")
    if args.units:
        acceleration_unit(args.units)
    pictures = list(_pictures(args))
    _check_outputs((("--plot", picture) for picture in pictures), args.records)
    rows, errors, written = [], [], []

    @contextlib.contextmanager
    def reported(record: Path, prefix: str = "") -> Iterator[None]:
        """Goes on after a failure, unless --strict."""
        try:
            yield
        except _FAILURES as error:
            reason = prefix + _reason(error, record)
            if args.strict:
                raise _StrictError(f"{record}: {reason}") from error
            _complain(f"{record}: {reason}")
            errors.append({"file": str(record), "error": reason})

    for place, record in enumerate(args.records):
        with reported(record):
            motion = _read(record, args)
            if args.scale != 1:
                motion = motion.scaled(args.scale)
            responses = {}
            for mu, slider in sliders.items():
                with reported(record, f"mu = {mu:g}: "):
                    responses[mu] = _settle(slider, motion)
                    rows.append(_row(args, record, mu, responses[mu]))
            if pictures and responses:
                _draw(responses, pictures[place])
                written.append(str(pictures[place]))
    args.code = 1 if errors else 0
    if args.json:
        return _json({"results": rows, "errors": errors, "figures": written})
    return "\n".join([*_table(rows), *(f"wrote {printable(name)}" for name in written)])


def _read(record: Path, args: argparse.Namespace) -> GroundMotion:
    if str(record).startswith(_SAMPLE):
        return sample_record(str(record).removeprefix(_SAMPLE))
    return read_record(record, units=args.units, component=args.component)


def _pictures(args: argparse.Namespace) -> Iterator[Path]:
    """One file for each record: their places tell apart records of the same name."""
    if not args.plot:
        return
    from . import plotting  # matplotlib: only who plots waits for it

    plotting.check_suffix(args.plot)
    for place, record in enumerate(args.records, 1):
        several = f"-{place}-{record.stem}" if len(args.records) > 1 else ""
        yield args.plot.with_stem(f"{args.plot.stem}{several}")


def _draw(responses: dict[float, Response], file: Path) -> None:
    from . import plotting

    if len(responses) == 1:
        figure = plotting.plot_response(*responses.values())
    else:
        labels = [f"\u03bc = {mu:g}" for mu in responses]
        figure = plotting.plot_responses(list(responses.values()), labels)
    plotting.save(figure, file)


def _slider(args: argparse.Namespace, mu: float) -> Slider:
    """The slider of the command line for one coefficient of friction."""
    lengths = {"--reach": args.reach, "--trail": args.trail, "--wheel-width": args.wheel_width}
    given = [option for option, length in lengths.items() if length is not None]
    if args.law != "caster" and given:
        raise ValueError(f"{given[0]} goes with --law caster, got --law {args.law}")
    if args.law == "caster":
        if given not in (["--reach"], ["--trail", "--wheel-width"]):
            raise ValueError(
                "--law caster needs --reach, or --trail and --wheel-width, in meters, got "
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
    ratio = args.damping_ratio
    if ratio is not None and not 0 <= ratio < math.inf:
        raise ValueError(f"--damping-ratio must be finite and at least 0, got {ratio:g}")
    if ratio is not None and args.period in (None, math.inf):
        raise ValueError(f"--damping-ratio goes with a finite --period, got {ratio:g} without")
    if args.period is None:
        return Slider(law)
    if not args.period > 0:
        raise ValueError(f"--period must be positive, got {args.period:g} s")
    if args.period == math.inf:
        return Slider(law)
    return Slider(law, period=args.period, damping_ratio=ratio)


def _settle(slider: Slider, motion: GroundMotion) -> Response:
    try:
        return integrate(slider, motion, settle=True)
    except ConvergenceError:
        return integrate(slider, motion)


def _row(args: argparse.Namespace, file: Path, mu: float, response: Response) -> dict:
    """One response; keys carry their units."""
    slider = response.slider
    forward, backward = (slider.resist(backward=back) for back in (False, True))
    return {
        "file": str(file),
        "record": response.motion.name,
        "scale": args.scale,
        "pga_g": response.motion.peak_acceleration / STANDARD_GRAVITY,
        "law": args.law,
        "mu": mu,
        "slip_level_forward_m_s2": forward,
        "slip_level_backward_m_s2": backward,
        "reach_m": getattr(slider.law, "reach", None),
        "slope_degrees": args.slope,
        "period_s": args.period,
        "damping_ratio": args.damping_ratio,
        "peak_m": response.peak,
        "residual_m": response.residual,
        "sliding_distance_m": response.sliding_distance,
        "time_sliding_s": response.time_sliding,
        "slips": response.slips,
        "at_rest": response.at_rest,
    }


def _table(rows: list[dict]) -> Iterable[str]:
    if not rows:
        return
    names = [printable(row["record"] or row["file"]) for row in rows]
    width = max(len("record"), *map(len, names))
    yield (
        f"{'record':{width}}  PGA [g]     mu  peak [cm]  residual [cm]  distance [cm]"
        "  sliding [s]  slips"
    )
    last = None
    for name, row in zip(names, rows):
        head = f"{name:{width}}  {_column(row['pga_g'], 7, 3)}"
        yield (
            f"{head if row['file'] != last else '':{width + 9}}  {row['mu']:5.4g}"
            f"  {_column(row['peak_m'] * 100, 9)}  {_column(row['residual_m'] * 100, 13)}"
            f"  {_column(row['sliding_distance_m'] * 100, 13)}"
            f"  {_column(row['time_sliding_s'], 11)}"
            f"  {row['slips']:5d}{'' if row['at_rest'] else '  never rests: at end of record'}"
        )
        last = row["file"]


def _column(value: float, width: int, places: int = 2) -> str:
    text = f"{value:{width}.{places}f}"
    return text if len(text) <= width else f"{value:{width}.1e}"


# ---- newmark


def _add_newmark(commands: argparse._SubParsersAction) -> None:
    from .newmark import Tools, add_newmark

    add_newmark(commands, Tools(_complain, _json, _check_outputs))


# ---- ensemble


def _add_ensemble(commands: argparse._SubParsersAction) -> None:
    parser = commands.add_parser(
        "ensemble",
        help="slide through many random earthquakes and print statistics",
        description="Slides a block through many members of a random ground motion and prints the"
        " distribution of its displacement relative to the ground, with standard errors (+-) and"
        " confidence bounds (in brackets). The ground motion is one of --event, --rate, --band.",
        epilog=f"Events: {', '.join(PoissonPulses.events())}.",
    )
    add = parser.add_argument
    source = parser.add_mutually_exclusive_group(required=True)
    source.add_argument(
        "--event", metavar="NAME", type=_text, help="an earthquake of the list below"
    )
    source.add_argument("--rate", type=float, metavar="R", help="Poisson pulse rate [1/s]")
    source.add_argument(
        "--band",
        nargs=3,
        type=float,
        metavar=("S0", "LOW", "HIGH"),
        help="Gaussian motion with two-sided spectral density S0 [m^2/s^3] from LOW to HIGH"
        " [rad/s]",
    )
    add("--half-width", type=float, metavar="S", help="pulse half width [s] (with --rate)")
    add("--sigma", type=float, metavar="A", help="rms pulse amplitude [m/s^2] (with --rate)")
    add("--duration", type=float, metavar="S", help="duration of a motion [s] (with --rate)")
    add("--dt", type=float, metavar="S", help="time step [s] (with --band)")
    add("--samples", type=int, metavar="N", help="samples of a motion (with --band)")
    add("--mu", type=float, required=True, help="coefficient of friction [-]")
    _add_slider(parser)
    add(
        "--members", type=int, default=10_000, metavar="N", help="number of members (default 10000)"
    )
    add("--seed", type=int, default=0, metavar="N", help="random seed (default 0)")
    add("--threads", type=int, metavar="N", help="maximum number of threads (default: all cores)")
    add("--settle", action="store_true", help="continue after each motion until the block rests")
    add(
        "--level",
        nargs="+",
        type=float,
        default=[0.01, 0.03, 0.1, 0.3, 1.0],
        metavar="M",
        help="peak displacements whose probability of exceedance is printed [m] (default 0.01 0.03"
        " 0.1 0.3 1)",
    )
    add(
        "--confidence",
        type=float,
        default=0.95,
        metavar="P",
        help="level of the bounds (default 0.95)",
    )
    add("--checkpoint", type=Path, metavar="FILE", help="saves progress; resumed from if it exists")
    add("--plot", type=Path, metavar="FILE", help="picture (.png, .pdf, .svg)")
    add("--json", action="store_true", help="one JSON document, SI units, exact doubles")
    parser.set_defaults(run=_ensemble)


def _ensemble(args: argparse.Namespace) -> str:
    if args.plot:
        from . import plotting  # matplotlib: only who plots waits for it

        plotting.check_suffix(args.plot)
    files = {"--checkpoint": args.checkpoint, "--plot": args.plot}
    _check_outputs((option, file) for option, file in files.items() if file)
    _check_whole("--members", args.members, 2)  # for standard errors
    _check_whole("--samples", args.samples, 1)
    for level in args.level:
        if not 0 <= level < math.inf:
            raise ValueError(f"--level must be finite and at least 0, got {level:g} m")
    if not 0 < args.confidence < 1:
        raise ValueError(f"--confidence must lie between 0 and 1, got {args.confidence:g}")
    from .ensemble import EnsembleError, run_ensemble  # NumPy: only who needs it waits for it

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
        _complain(str(error))
        args.code, args.checkpoint = 1, None
    result = _statistics(args, ensemble)
    written = [str(args.checkpoint)] if args.checkpoint else []
    if args.plot:
        try:
            plotting.save(plotting.plot_ensemble(ensemble), args.plot)
            written.append(str(args.plot))
        except _FAILURES as error:  # a picture is not worth the ensemble
            _complain(_reason(error))
            args.code = 1
    if args.json:
        return _json({**result, "files": written})
    return "\n".join([*_report(args, result), *(f"wrote {printable(name)}" for name in written)])


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
    """The statistics that are printed; keys carry their units."""

    def interval(name: str, key: float, found: Interval) -> dict:
        return {name: key, "value": found.value, "low": found.low, "high": found.high}

    def estimate(name: str, found: Estimate) -> dict:
        if not (math.isfinite(found.value) and math.isfinite(found.error)):
            raise OverflowError(
                f"ensemble: {name} must be finite, got {found.value:g} +- {found.error:g}"
            )
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
            "velocity_variance_m2_s2": estimate(
                "the velocity variance", stationary.velocity_variance
            ),
            "growth_rate_m2_s": estimate("the growth rate", stationary.growth_rate),
            "remark": stationary.remark,
        },
    }


def _residual(ensemble: Ensemble) -> dict:
    """Mean and root mean square of the residuals; None where they are not kept."""
    try:
        residual = ensemble.residual
    except ValueError:
        return {"residual_mean_m": None, "residual_rms_m": None}
    unit = float(abs(residual).max()) or 1.0  # squares stay within the range of doubles
    residual = residual / unit
    root_n = math.sqrt(len(residual))
    squares = residual**2
    rms = math.sqrt(squares.mean())
    return {
        "residual_mean_m": {
            "value": unit * float(residual.mean()),
            "error": unit * float(residual.std(ddof=1)) / root_n,
        },
        # d(rms) = d(rms^2) / (2 rms)
        "residual_rms_m": {
            "value": unit * rms,
            "error": unit * float(squares.std(ddof=1)) / root_n / (2 * rms) if rms else 0.0,
        },
    }


def _report(args: argparse.Namespace, result: dict) -> Iterable[str]:
    def row(name: str, which: str, found: dict, factor: float, unit: str) -> str:
        value = factor * found["value"]
        if "error" in found:
            error = factor * found["error"]
            text, around = _with_error(value, error)
        else:
            low, high = factor * found["low"], factor * found["high"]
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
    if stationary["remark"]:
        yield f"({stationary['remark']})"


def _with_error(value: float, error: float) -> tuple[str, str]:
    """The error to two digits and the value as far."""
    if not error > 0:
        return f"{value:.4g}", f"+- {error:.2g}"
    places = 1 - math.floor(math.log10(error))
    if 0 <= places <= 8:
        return f"{value:.{places}f}", f"+- {error:.{places}f}"
    digits = max(0, math.floor(math.log10(max(abs(value), error))) + places)
    return f"{value:.{digits}e}", f"+- {error:.1e}"


# ---- thesis


def _add_thesis(commands: argparse._SubParsersAction) -> None:
    parser = commands.add_parser(
        "thesis",
        help="redraw the figures of the thesis, theory beside simulation",
        description="Redraws figures and tables of the thesis, The Response of Stick-Slip Systems"
        " to Random Seismic Excitation: its curves, exact solutions, and ensembles with standard"
        " errors. For each, writes a picture and a CSV file of all curves and points; writes a page"
        " that shows them all, gallery.md; prints the numerical claims of the thesis next to our"
        " results. With --check, prints every number with its expected value and its tolerance,"
        " exits with code 1 if one is off, and writes nothing unless --out is given.",
    )
    add = parser.add_argument
    add("numbers", nargs="*", metavar="NUMBER", help="such as 4.6, A.2, 'Table 5.1' (default: all)")
    add("--members", type=int, metavar="N", help="of an ensemble (default 100000; --check: 2000)")
    add("--seed", type=int, metavar="N", help="random seed (default 1; --check: 2)")
    add("--threads", type=int, metavar="N", help="maximum number of threads (default: all cores)")
    add(
        "--out",
        type=Path,
        metavar="FOLDER",
        help="folder for the files (default: thesis; --check: none)",
    )
    add("--format", choices=("png", "pdf", "svg"), default="png", help="of pictures (default png)")
    add("--check", action="store_true", help="quick check against expected values")
    parser.set_defaults(run=_thesis)


def _thesis(args: argparse.Namespace) -> str:
    from . import thesis

    numbers = list(dict.fromkeys(args.numbers)) or thesis.Thesis.numbers
    for number in numbers:
        if number not in thesis.Thesis.numbers:
            raise ValueError(
                f"NUMBER must be one of {', '.join(thesis.Thesis.numbers)}, got {number}"
            )
    _check_whole("--members", args.members, 1)
    _check_whole("--seed", args.seed, 0)
    _check_whole("--threads", args.threads, 1, 2**16)
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
    folder = args.out or (None if args.check else Path("thesis"))
    if folder:
        from . import plotting  # matplotlib: only who plots waits for it

        folder.mkdir(parents=True, exist_ok=True)
    figures, checks = [], []
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
                checks += figure.check()
    finally:
        if shown:
            print("\r\33[K", end="", file=sys.stderr, flush=True)
    summary = thesis.thesis_summary(figures)
    if folder:
        with replacing(folder / "gallery.md") as stream:
            stream.write(thesis.page(figures, f".{args.format}").encode())
    if not args.check:
        return f"{summary}wrote {len(figures)} figures to {printable(str(folder))}"
    args.code = 0 if all(check.holds for check in checks) else 1
    plural = "" if len(figures) == 1 else "s"
    verdict = f"{len(figures)} figure{plural}, {thesis.thesis_verdict(checks)}"
    return "\n".join([*map(_checked, checks), verdict])


def _checked(check: Any) -> str:
    return (
        f"{'holds' if check.holds else 'off  '}  {check.what:28} found {check.found:<14.8g}"
        f" expected {check.expected:<14.8g} +- {check.allowed:.2g}"
    )
