"""The slider of the command line."""

from __future__ import annotations

import argparse
import itertools
import math
from collections.abc import Callable, Iterator
from typing import Any

from .. import Caster, Coulomb, Slider, StaticKinetic, Stops
from .parser import number, numbers, ratio, ratios

__all__ = ["add_contact", "add_slider", "described", "heading", "slider_of", "variations"]

# The options that may be ranges, with their headings in tables and names in legends.
_VARIED = {
    "mu": "mu",
    "mu_static": "static mu",
    "reach": "reach [m]",
    "slope": "slope [deg]",
    "period": "period [s]",
    "damping_ratio": "damping",
    "stop_gap": "stop gap [m]",
    "restitution": "restitution",
    "scale": "scale",
}


def add_slider(parser: argparse.ArgumentParser, ranges: bool = False) -> None:
    """Add the options that `slider_of` reads, except --mu.

    Parameters
    ----------
    parser : argparse.ArgumentParser
    ranges : bool, optional
        Whether the options accept ranges START:STOP:STEP.
    """
    length: Callable[[str], Any] = numbers if ranges else number
    part: Callable[[str], Any] = ratios if ranges else ratio
    add = parser.add_argument
    add("--law", choices=("coulomb", "caster", "one-way"), default="coulomb", help="friction law")
    add(
        "--mu-static",
        type=part,
        metavar="MU",
        help="coefficient of static friction [-], at least --mu, which is then the kinetic one",
    )
    add("--reach", type=length, metavar="M", help="caster: distance over which the level falls [m]")
    add(
        "--trail",
        type=number,
        metavar="M",
        help="caster: pivot to wheel axis [m]; with --wheel-width, instead of --reach",
    )
    add(
        "--wheel-width", type=number, metavar="M", help="caster: width of a wheel [m]; with --trail"
    )
    add("--period", type=length, metavar="S", help="period of the mass on its spring [s]")
    add("--damping-ratio", type=part, metavar="Z", help="damping ratio; with --period")
    add("--slope", type=length, metavar="DEGREES", help="slope of the ground; downhill is forward")
    add(
        "--stop-gap",
        type=length,
        metavar="M",
        help="distance from the start to a stop, both ways [m]",
    )
    add(
        "--restitution",
        type=part,
        metavar="E",
        help="speed after an impact on a stop over that before, from 0 to 1; with --stop-gap",
    )


def add_contact(parser: argparse.ArgumentParser) -> None:
    """Add --contact."""
    parser.add_argument(
        "--contact",
        choices=("flight", "clipped"),
        default="flight",
        help="where the ground falls faster than the block: it flies and lands (the default), or"
        " stays on the ground without friction",
    )


def variations(args: argparse.Namespace) -> tuple[list[argparse.Namespace], list[str]]:
    """Every combination of the given values, and the options with several values."""
    given = {
        name: list(value) if isinstance(value, list | tuple) else [value]
        for name in _VARIED
        for value in [getattr(args, name)]
    }
    every = [
        argparse.Namespace(**{**vars(args), **dict(zip(given, values))})
        for values in itertools.product(*given.values())
    ]
    return every, [name for name, values in given.items() if len(values) > 1]


def heading(name: str) -> str:
    return _VARIED[name]


def described(args: argparse.Namespace, several: list[str], mu: str = "mu") -> Iterator[str]:
    """Labels such as "mu = 0.1", for mu and the other options that vary."""
    yield f"{mu} = {args.mu:g}"
    for name in several:
        if name != "mu":
            word, _, unit = _VARIED[name].partition(" ")
            yield f"{word} = {getattr(args, name):g}{f' {unit[1:-1]}' if unit else ''}"


def slider_of(args: argparse.Namespace) -> Slider:
    """The slider of the command line."""
    mu = args.mu
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
        law: Caster | Coulomb | StaticKinetic = (
            Caster(mu=mu, reach=args.reach)
            if given == ["--reach"]
            else Caster.from_geometry(mu=mu, trail=args.trail, wheel_width=args.wheel_width)
        )
    else:
        law = Coulomb(mu=mu)
    # On level ground a level that nothing outgrows, as the tables have it.
    one_way = args.law == "one-way"
    if one_way and args.slope is None and args.mu_static is None:
        law, one_way = Coulomb(mu=mu, backward=math.inf), False
    if args.mu_static is not None:
        if not mu <= args.mu_static < math.inf:
            raise ValueError(
                f"--mu-static must be finite and at least --mu, {mu:g}, got {args.mu_static:g}"
            )
        law = StaticKinetic(law, mu_static=args.mu_static)
    ratio = args.damping_ratio
    if ratio is not None and not 0 <= ratio < math.inf:
        raise ValueError(f"--damping-ratio must be finite and at least 0, got {ratio:g}")
    if ratio is not None and args.period in (None, math.inf):
        raise ValueError(f"--damping-ratio goes with a finite --period, got {ratio:g} without")
    if args.restitution is not None and args.stop_gap is None:
        raise ValueError(f"--restitution goes with --stop-gap, got {args.restitution:g} without")
    if args.stop_gap is not None and args.restitution is None:
        raise ValueError("--stop-gap needs --restitution, from 0 to 1, got none")
    ground: dict[str, Any] = {
        "slope_degrees": args.slope or 0.0,
        "one_way": one_way,
    }
    if args.stop_gap is not None:
        ground["stops"] = Stops(gap=args.stop_gap, restitution=args.restitution)
    if args.period is None:
        return Slider(law, **ground)
    if not args.period > 0:
        raise ValueError(f"--period must be positive, got {args.period:g} s")
    if args.period == math.inf:
        return Slider(law, **ground)
    return Slider(law, period=args.period, damping_ratio=ratio, **ground)
