"""``stickslip ensemble``: many random ground motions, and their statistics."""

from __future__ import annotations

import argparse
import math
from collections.abc import Iterable
from typing import Any

from .. import (
    Ensemble,
    GaussianExcitation,
    Interval,
    PoissonPulses,
    Spectrum,
    WithTransverse,
    WithVertical,
)
from .._text import printable
from .building import BUILDING, building_on
from .options import add_options
from .output import (
    FAILURES,
    check_not_negative,
    check_outputs,
    check_whole,
    complain,
    json_text,
    reason_of,
)
from .slider import SLIDER, any_slider_of, name_slider

__all__ = ["add_ensemble"]

_LEVELS = (0.01, 0.03, 0.1, 0.3, 1.0)  # default of --level [m]
_SHARES_OF_FLOORS = (0.5, 0.95)
_SOURCE = """
[, one of, required]
--event text NAME
    a scenario from the list below
--rate number R
    Poisson pulse rate [1/s]
--band number S0 LOW HIGH
    Gaussian motion with two-sided spectral density S0 [m^2/s^3] from LOW to HIGH [rad/s]
"""
_MOTION = """
--half-width number S
    pulse half width [s] (with --rate)
--sigma number A
    rms pulse amplitude [m/s^2] (with --rate)
--duration number S
    duration [s] (with --rate)
--dt number S
    time step [s] (with --band)
--samples whole N
    number of samples (with --band)
--vertical-ratio ratio R
    add a vertical component, drawn independently of the horizontal one like it, and times this
    ratio (V/H, often near 2/3)
--planar
    slide in both horizontal directions at once, under pairs: the transverse component is drawn like
    the other one; the displacement is the distance from the start
--transverse-ratio ratio R
    factor on the transverse component (default 1; with --planar)
--coherence ratio C
    correlation of the two components, from -1 to 1 (default 0; with --planar)
--mu ratio
    coefficient of friction [-]
--slider file FILE
    instead of --mu and all else about friction and mounting: the JSON file of a slider with any
    law, as Slider.to_json writes it
"""
_RUN = """
--members whole N = 10000
    number of members (default 10000)
--seed whole N = 0
    random seed (default 0)
--threads whole N
    maximum number of threads (default: all cores)
--settle
    continue after each motion until the block rests
--level numbers... M
    peak displacements whose probability of exceedance is printed [m], at most --stop-gap (default
    0.01 0.03 0.1 0.3 1)
--confidence ratio P = 0.95
    confidence level of the bounds (default 0.95)
--checkpoint file FILE
    file to save progress in; the run resumes from it if it exists
--plot file FILE
    picture (.png, .pdf, .svg)
--json
    one JSON document, SI units, exact doubles
"""


def add_ensemble(commands: argparse._SubParsersAction) -> None:
    parser = commands.add_parser(
        "ensemble",
        help="slide through many random earthquakes and print statistics",
        description="Slides a block through many members of a random ground motion and prints the"
        " distribution of its displacement relative to the ground, with standard errors (+-) and"
        " confidence bounds (in brackets). --event, --rate or --band gives the ground motion. The"
        " block may be the base of a building: --story-masses and the options with it.",
        epilog=f"Scenarios: {', '.join(PoissonPulses.events())}.",
    )
    add_options(parser, _SOURCE, _MOTION, SLIDER, BUILDING, _RUN)
    parser.set_defaults(run=_ensemble, contact=None)  # a building is always clipped


def _ensemble(args: argparse.Namespace) -> str:
    if args.plot:
        from .. import plotting  # imports matplotlib, which is slow

        plotting.check_suffix(args.plot)
    files = {"--checkpoint": args.checkpoint, "--plot": args.plot}
    check_outputs((option, file) for option, file in files.items() if file)
    check_whole("--members", args.members, 2)  # for standard errors
    check_whole("--samples", args.samples, 1)
    name_slider(args)
    gap = math.inf if args.stop_gap is None else args.stop_gap
    for level in args.level or ():
        check_not_negative("--level", level, "m")
        if level > gap:
            raise ValueError(
                f"--level must be at most --stop-gap, {gap:g} m, which keeps the block from"
                f" exceeding it, got {level:g} m"
            )
    args.level = args.level or [level for level in _LEVELS if level <= gap]
    if not 0 < args.confidence < 1:
        raise ValueError(f"--confidence must lie between 0 and 1, got {args.confidence:g}")
    from ..ensemble import EnsembleError, run_ensemble  # imports NumPy, slowly

    try:
        ensemble = run_ensemble(
            building_on(any_slider_of(args), args),
            _excitation(args),
            members=args.members,
            seed=args.seed,
            threads=args.threads,
            settle=args.settle,
            contact=args.contact,
            checkpoint=args.checkpoint,
        )
    except EnsembleError as error:  # the checkpoint could not be written
        ensemble = error.partial
        if ensemble.members < 2:
            raise ValueError(str(error)) from error
        complain(str(error))
        args.code, args.checkpoint = 1, None
    result = _statistics(args, ensemble)
    written = [str(args.checkpoint)] if args.checkpoint else []
    if args.plot:
        try:
            plotting.save(plotting.plot_ensemble(ensemble), args.plot)
            written.append(str(args.plot))
        except FAILURES as error:  # the ensemble is worth more than its picture
            complain(reason_of(error))
            args.code = 1
    if args.json:
        return json_text({**result, "files": written})
    return "\n".join([*_report(args, result), *(f"wrote {printable(name)}" for name in written)])


def _excitation(
    args: argparse.Namespace,
) -> PoissonPulses | GaussianExcitation | WithTransverse | WithVertical:
    """The ground motion of the command line."""
    pair = {"--transverse-ratio": args.transverse_ratio, "--coherence": args.coherence}
    for option, value in pair.items():
        if value is not None and not args.planar:
            raise ValueError(f"{option} goes with --planar, got {value:g} without")
    one = _horizontal(args)
    horizontal: PoissonPulses | GaussianExcitation | WithTransverse = one
    if args.planar:
        given = {"ratio": args.transverse_ratio, "coherence": args.coherence}
        horizontal = WithTransverse(one, **{k: v for k, v in given.items() if v is not None})
    if args.vertical_ratio is None:
        return horizontal
    check_not_negative("--vertical-ratio", args.vertical_ratio)
    return WithVertical(horizontal, ratio=args.vertical_ratio)


def _horizontal(args: argparse.Namespace) -> PoissonPulses | GaussianExcitation:
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
    """The statistics to print; keys include units."""

    def interval(name: str, key: float, found: Interval) -> dict:
        return {name: key, "value": found.value, "low": found.low, "high": found.high}

    shares = (0.5, 0.95, 0.99)
    return {
        "configuration": ensemble.configuration,
        "members": ensemble.members,
        "confidence": args.confidence,
        "peak_m": [interval("quantile", p, ensemble.quantile(p, args.confidence)) for p in shares],
        "exceedance": [
            interval("peak_m", level, ensemble.exceedance(level, args.confidence))
            for level in args.level
        ],
        **_impacts(args, ensemble),
        "airborne": ensemble.airborne,
        **_residual(ensemble),
        **(_at_end(ensemble) if args.planar else _stationary(ensemble)),
        **({"floors": _floors(ensemble, args.confidence)} if ensemble.has_floors else {}),
    }


def _floors(ensemble: Ensemble, confidence: float) -> list[dict]:
    """Quantiles of the peaks of each floor, the lowest first."""
    of = {
        "peak_acceleration_m_s2": ensemble.peak_floor_acceleration,
        "peak_drift_m": ensemble.peak_floor_drift,
    }
    rows: list[dict] = [
        {"floor": floor, **{name: [] for name in of}}
        for floor in range(1, ensemble.peak_floor_drift.values.shape[1] + 1)
    ]
    for name, peaks in of.items():
        for p in _SHARES_OF_FLOORS:
            for row, found in zip(rows, peaks.quantile(p, confidence)):
                row[name].append(
                    {"quantile": p, "value": found.value, "low": found.low, "high": found.high}
                )
    return rows


def _stationary(ensemble: Ensemble) -> dict:
    """The stationary averages."""
    stationary = ensemble.stationary
    growth = stationary.growth_rate
    variance = stationary.velocity_variance
    return {
        "stationary": {
            "begin_s": stationary.begin,
            "end_s": stationary.end,
            "velocity_variance_m2_s2": _estimate("the velocity variance", *variance),
            "growth_rate_m2_s": _estimate("the growth rate", *growth),
            "remark": "; ".join(filter(None, (stationary.remark, ensemble.remark))),
        }
    }


def _at_end(ensemble: Ensemble) -> dict:
    """In the plane, the variances and the covariance of the components at the end."""
    found: dict[str, Any] = {"time_s": float(ensemble.time[-1])}
    for quantity, unit in (("displacement", "m2"), ("velocity", "m2_s2")):
        for i, component in enumerate(("axis", "transverse")):
            name = f"{quantity}_variance"
            pair = (float(getattr(ensemble, name + part)[-1, i]) for part in ("", "_error"))
            found[f"{name}_{component}_{unit}"] = _estimate(f"the {quantity} variance", *pair)
        name = f"{quantity}_covariance"
        pair = (float(getattr(ensemble, name + part)[-1]) for part in ("", "_error"))
        found[f"{name}_{unit}"] = _estimate(f"the {quantity} covariance", *pair)
    return {"at_end": found}


def _estimate(name: str, value: float, error: float) -> dict:
    if not (math.isfinite(value) and math.isfinite(error)):
        raise OverflowError(f"ensemble: {name} must be finite, got {value:g} +- {error:g}")
    return {"value": value, "error": error}


def _impacts(args: argparse.Namespace, ensemble: Ensemble) -> dict:
    """The fraction of members that hit a stop; nothing without stops."""
    if args.stop_gap is None:
        return {}
    value, low, high = ensemble.exceedance(args.stop_gap, args.confidence)
    return {"impact_probability": {"value": value, "low": low, "high": high}}


def _residual(ensemble: Ensemble) -> dict:
    """Mean and root mean square of the residuals, in the plane of their distances from the start;
    None if they are not stored."""
    try:
        residual = ensemble.residual
    except ValueError:
        return {"residual_mean_m": None, "residual_rms_m": None}
    if ensemble.in_plane:
        import numpy as np

        residual = np.hypot(*residual.T)
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
        return f"{name:24}{which:>10}  {text:>10} {unit:7}  {around}"

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
    if "impact_probability" in result:
        gap = f"{100 * args.stop_gap:g} cm"
        yield row("hits a stop", gap, result["impact_probability"], 100, "%")
    if result["airborne"]:
        yield f"{result['airborne']:,} members end in flight (--settle lets them land)"
    if args.planar:
        at_end = result["at_end"]
        for quantity, unit in (("displacement", "m^2"), ("velocity", "m^2/s^2")):
            key = unit.replace("^", "").replace("/", "_")
            for i, which in enumerate(("axis", "transverse")):
                found = at_end[f"{quantity}_variance_{which}_{key}"]
                yield row("" if i else f"{quantity} variance", which, found, 1, unit)
            covariance = at_end[f"{quantity}_covariance_{key}"]
            yield row(f"{quantity} covariance", "", covariance, 1, unit)
        yield f"(variances and covariances at {at_end['time_s']:.4g} s)"
        return
    for floor in result.get("floors", ()):
        for name, key, factor, unit in (
            ("acceleration", "peak_acceleration_m_s2", 1, "m/s^2"),
            ("drift", "peak_drift_m", 1000, "mm"),
        ):
            for found in floor[key]:
                median = found["quantile"] == 0.5
                which = "median" if median else f"{100 * found['quantile']:g} %"
                label = f"floor {floor['floor']}, {name}" if median else ""
                yield row(label, which, found, factor, unit)
    stationary = result["stationary"]
    yield row("velocity variance", "", stationary["velocity_variance_m2_s2"], 1, "m^2/s^2")
    yield row("growth of variance of x", "", stationary["growth_rate_m2_s"], 1, "m^2/s")
    yield f"(the last two from {stationary['begin_s']:.3g} to {stationary['end_s']:.3g} s)"
    if stationary["remark"]:
        yield f"({stationary['remark']})"


def _with_error(value: float, error: float) -> tuple[str, str]:
    """The value and its error: the error to two digits, the value to the same decimal place."""
    if not error > 0:
        return f"{value:.4g}", f"+- {error:.2g}"
    places = 1 - math.floor(math.log10(error))
    if 0 <= places <= 8:
        return f"{value:.{places}f}", f"+- {error:.{places}f}"
    digits = max(0, math.floor(math.log10(max(abs(value), error))) + places)
    return f"{value:.{digits}e}", f"+- {error:.1e}"
