"""The slider of the command line."""

from __future__ import annotations

import argparse
import itertools
import math
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any

from .. import (
    Caster,
    Coulomb,
    DoublePendulum,
    MultiPendulum,
    PlanarSlider,
    QuintuplePendulum,
    Slider,
    StaticKinetic,
    Stops,
    TriplePendulum,
)
from .output import check_not_negative

__all__ = [
    "PLANAR",
    "SLIDER",
    "SLIDERS",
    "any_slider_of",
    "cells",
    "check_planar",
    "described",
    "first_of",
    "heads",
    "keyed",
    "name_slider",
    "slider_of",
    "variations",
]

# The options that may be ranges, with their headings in tables and names in legends, and their keys
# in rows, where a name has its unit.
_VARIED = {
    "slider": ("slider", "slider"),
    "mu": ("mu", "mu"),
    "mu_static": ("static mu", "mu_static"),
    "reach": ("reach [m]", "reach_m"),
    "slope": ("slope [deg]", "slope_degrees"),
    "period": ("period [s]", "period_s"),
    "damping_ratio": ("damping", "damping_ratio"),
    "stop_gap": ("stop gap [m]", "stop_gap_m"),
    "restitution": ("restitution", "restitution"),
    "scale": ("scale", "scale"),
}


_NEITHER = "give --mu, or --slider with a file"


class _Shown:
    """What stands in a column of numbers, and is none."""

    def __format__(self, spec: str) -> str:
        width = spec.partition(".")[0]
        return f"{self!s:>{width}}" if width.isdigit() else str(self)


class _File(_Shown, str):
    """A slider from a file, shown as its name."""

    made: Slider

    def __new__(cls, path: Path) -> _File:
        found = super().__new__(cls, path.stem)
        found.made = Slider.from_json(path)
        return found


class _Surfaces(_Shown, tuple[float, ...]):
    """The coefficients of the surfaces of one bearing, where other sliders have one."""

    def __str__(self) -> str:
        return "/".join(f"{mu:g}" for mu in self)


# The bearings by their number of radii.
_PENDULUMS: dict[int, Callable[..., MultiPendulum]] = {
    2: DoublePendulum,
    3: TriplePendulum,
    5: QuintuplePendulum,
}


CONTACT = """
[mounting and ground]
--contact flight|clipped = flight
    where the ground falls faster than the block: it flies and lands (the default), or stays on the
    ground without friction
"""
PLANAR = """
[mounting and ground]
--planar
    slide in both horizontal directions at once: friction opposes the velocity vector; implies
    --station, and prints the largest and the last distance from the start
"""
_SLIDER = """
[friction]
--law {laws} = coulomb
    friction law
--mu-static {ratio} MU
    coefficient of static friction [-], at least --mu, which is then the kinetic one
--reach {number} M
    caster: distance over which the level falls [m]
--trail number M
    caster: pivot to wheel axis [m]; with --wheel-width, instead of --reach
--wheel-width number M
    caster: width of a wheel [m]; with --trail
[mounting and ground]
--period {number} S
    period of the mass on its spring [s]
--damping-ratio {ratio} Z
    damping ratio; with --period
--slope {number} DEGREES
    slope of the ground; downhill is forward
--stop-gap {number} M
    distance from the start to a stop, both ways [m]
--restitution {ratio} E
    speed after an impact on a stop over that before, from 0 to 1; with --stop-gap
"""
_LAWS = "coulomb|caster|one-way"
# What `slider_of` reads, except --mu.
SLIDER = _SLIDER.format(laws=_LAWS, number="number", ratio="ratio") + CONTACT
# What `variations` reads, except --scale.
SLIDERS = f"""
[friction]
--mu ratios*...
    coefficients of friction [-] or ranges; a repeated value is used once
--slider file... FILE
    instead of --mu and all else about friction and mounting: JSON files of sliders with any law, as
    Slider.to_json writes them
{_SLIDER.format(laws=f"{_LAWS}|pendulum", number="numbers", ratio="ratios").strip()}
[friction]
--radii number*... M
    pendulum: effective radii of a double bearing (lower, upper), a triple one (inner, lower outer,
    upper outer) or a quintuple one (inner, middle, outer) [m]; --mu then has one coefficient for
    each
--capacities number*... M
    pendulum: travel of each surface to its stop [m]; default: none
{CONTACT.strip()}
"""


def check_planar(args: argparse.Namespace) -> None:
    """Refuse options that --planar excludes; it reads both components of each station."""
    if args.law != "coulomb":
        raise ValueError(f"--planar goes with --law coulomb, got --law {args.law}")
    if args.polarity and args.slope is None:
        raise ValueError(
            "--planar has no --polarity on level ground: reversing both components mirrors the"
            f" response, got {args.polarity}"
        )
    if args.vertical is not None:
        raise ValueError("--planar takes the vertical component from the station, got --vertical")
    args.station = args.pairs = True


def variations(args: argparse.Namespace) -> tuple[list[argparse.Namespace], list[str]]:
    """Every combination of the given values, and the options with several values."""
    if args.slider:
        _check_alone(args)
        files = [_File(path) for path in dict.fromkeys(args.slider)]
        scales = list(args.scale) if isinstance(args.scale, list | tuple) else [args.scale]
        every = [
            argparse.Namespace(**{**vars(args), "slider": one, "scale": scale})
            for one, scale in itertools.product(files, scales)
        ]
        return every, ["slider", *(["scale"] if len(scales) > 1 else [])]
    if not args.mu:
        raise ValueError(_NEITHER)
    args.slider = None
    given = {
        name: list(value) if isinstance(value, list | tuple) else [value]
        for name in _VARIED
        if name != "slider"
        for value in [getattr(args, name)]
    }
    given["mu"] = (
        [_Surfaces(given["mu"])] if args.law == "pendulum" else list(dict.fromkeys(given["mu"]))
    )
    every = [
        argparse.Namespace(**{**vars(args), **dict(zip(given, values))})
        for values in itertools.product(*given.values())
    ]
    return every, [name for name, values in given.items() if len(values) > 1]


def _check_alone(args: argparse.Namespace) -> None:
    """Refuse what a file of a slider contains itself."""
    for name in (*_VARIED, "radii", "capacities", "trail", "wheel_width"):
        if name not in ("slider", "scale") and getattr(args, name, None) not in (None, []):
            raise ValueError(f"--{name.replace('_', '-')} belongs into the file of --slider")
    if args.law != "coulomb":
        raise ValueError("--law belongs into the file of --slider")


def name_slider(args: argparse.Namespace) -> None:
    """Read the file of the one slider, if it comes from one; its stops are then those given."""
    if args.slider:
        _check_alone(args)
        args.slider = _File(args.slider)
        stops = args.slider.made.stops
        args.stop_gap = stops.gap if stops and stops.gap == stops.backward else None
    elif args.mu is None:
        raise ValueError(_NEITHER)


def first_of(args: argparse.Namespace) -> str:
    """The option that names the sliders."""
    return "slider" if args.slider else "mu"


def keyed(args: argparse.Namespace, names: Iterable[str]) -> dict[str, Any]:
    """The values of the options of one combination, by the keys of rows."""
    return {_VARIED[name][1]: getattr(args, name) for name in names}


def heads(names: Iterable[str]) -> str:
    """The heads of the columns of options."""
    return "".join(f"  {head:>{_width(head)}}" for head, _ in map(_VARIED.__getitem__, names))


def cells(row: dict[str, Any], names: Iterable[str]) -> str:
    """The values of a row below `heads`."""
    return "".join(
        f"  {row[key]:{_width(head)}.4g}" for head, key in map(_VARIED.__getitem__, names)
    )


def _width(head: str) -> int:
    return {"mu": 5, "slider": 20}.get(head, max(11, len(head)))


def described(args: argparse.Namespace, several: list[str], mu: str = "mu") -> Iterator[str]:
    """Labels such as "mu = 0.1", for mu and the other options that vary."""
    yield str(args.slider) if args.slider else f"{mu} = {args.mu:g}"
    for name in several:
        if name != first_of(args):
            word, _, unit = _VARIED[name][0].partition(" [")
            yield f"{word} = {getattr(args, name):g}{f' {unit[:-1]}' if unit else ''}"


def any_slider_of(args: argparse.Namespace) -> Slider | PlanarSlider:
    """The slider of the command line, in the plane with --planar."""
    slider = slider_of(args)
    return PlanarSlider(slider) if args.planar else slider


def slider_of(args: argparse.Namespace) -> Slider:
    """The slider of the command line on one axis."""
    if args.slider:
        return args.slider.made
    mu = args.mu
    if args.law != "pendulum":
        for option in ("radii", "capacities"):
            if getattr(args, option, None) is not None:
                raise ValueError(f"--{option} goes with --law pendulum, got --law {args.law}")
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
        law: Caster | Coulomb | MultiPendulum | StaticKinetic = (
            Caster(mu=mu, reach=args.reach)
            if given == ["--reach"]
            else Caster.from_geometry(mu=mu, trail=args.trail, wheel_width=args.wheel_width)
        )
    else:
        law = Coulomb(mu=mu) if args.law != "pendulum" else _pendulum_of(args)
    # On level ground a level that nothing outgrows, as the tables have it.
    one_way = args.law == "one-way"
    if one_way and args.slope is None and args.mu_static is None:
        law, one_way = Coulomb(mu=mu, backward=math.inf), False
    if args.mu_static is not None:
        if isinstance(law, MultiPendulum):
            raise ValueError("--mu-static: a pendulum has one coefficient for each surface")
        if not mu <= args.mu_static < math.inf:
            raise ValueError(
                f"--mu-static must be finite and at least --mu, {mu:g}, got {args.mu_static:g}"
            )
        law = StaticKinetic(law, mu_static=args.mu_static)
    ratio = args.damping_ratio
    check_not_negative("--damping-ratio", ratio)
    if ratio is not None and args.period in (None, math.inf):
        raise ValueError(f"--damping-ratio goes with a finite --period, got {ratio:g} without")
    if args.restitution is not None and args.stop_gap is None and args.law != "pendulum":
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


def _pendulum_of(args: argparse.Namespace) -> MultiPendulum:
    """The bearing with several surfaces of the command line."""
    if args.radii is None:
        raise ValueError("--law pendulum needs --radii, one for each surface, in meters, got none")
    made = _PENDULUMS.get(len(args.radii))
    if made is None:
        raise ValueError(
            f"--radii takes 2, 3 or 5 radii, of a double, triple or quintuple bearing, got"
            f" {len(args.radii)}"
        )
    return made(args.radii, list(args.mu), args.capacities, args.restitution or 0.0)
