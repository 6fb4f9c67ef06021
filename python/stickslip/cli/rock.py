"""``stickslip rock``: whether blocks rock and overturn in records."""

from __future__ import annotations

import argparse
import itertools
from collections.abc import Iterable
from typing import Any

from .. import STANDARD_GRAVITY, RockingBlock, RockingResponse, SlenderBlock, integrate
from .._text import printable
from .options import add_options
from .output import check_positive, column
from .reading import RECORDS, VERTICAL, Motion, Records
from .report import outputs

__all__ = ["add_rock"]

_OPTIONS = """
[block]
--width numbers... M
    width of a uniform block [m]
--height numbers... M
    its height [m]
--mu ratios... MU
    with both sizes: coefficient of friction of a rigid block, which rocks, slides and flies
    (default: a slender block, which does not slip)
--p numbers... P
    instead of both sizes, with --alpha: the frequency parameter sqrt(m g R/I) [rad/s]
--alpha numbers... A
    angle between the side and the line from the corner to the center of mass [rad]
--restitution ratios... R
    rate after an impact over that before, from 0 to 1 (default: that of Housner)
[records]
--scale ratios... X = 1
    factor on the ground acceleration (default 1)
--polarity recorded|reversed|both
    rock under each record as recorded (the default), reversed, or both
"""
_COLUMNS = (
    *("file", "record", "component", "scale", "pga_g", "polarity"),
    *("p_rad_s", "alpha_rad", "restitution", "mu", "peak_rotation_rad", "peak_rotation_ratio"),
    *("overturned", "overturned_at_s", "impacts", "base_displacement_m", "sliding_distance_m"),
    *("margin", "condition"),
)


def add_rock(commands: argparse._SubParsersAction) -> None:
    parser = commands.add_parser(
        "rock",
        help="rock blocks under records and print whether they overturn",
        description="Rocks free-standing blocks under strong-motion records: slender ones, which do"
        " not slip, or with --mu rigid ones, which also slide and leave the ground. It"
        " continues after the end of each record until they rest or fall (not with a"
        " restitution of 1, which never comes to rest). Prints the peak rotation over alpha, or the"
        " side to which a block overturns, the number of impacts and the margin of the nearest"
        " decision: if it is tiny, the history hangs on round-off. A single history may be chaotic:"
        " compare several scales and records.",
        epilog="For example, `stickslip rock sample:all --width 0.6 --height 2 --scale 0.5 1 1.5`."
        " --width, --height, --mu, --p, --alpha, --restitution and --scale take numbers or ranges"
        " START:STOP:STEP; every combination is computed. A record that cannot be read is reported"
        " in one line on stderr; the others are printed, and the exit code is 1.",
    )
    add_options(parser, RECORDS, VERTICAL, _OPTIONS, outputs())
    parser.set_defaults(horizontal=True, run=_rock)


def _blocks(args: argparse.Namespace) -> list[SlenderBlock | RockingBlock]:
    sized = args.width is not None and args.height is not None
    if sized == (args.p is not None and args.alpha is not None) or (
        sized and (args.p is not None or args.alpha is not None)
    ):
        raise ValueError("give --width and --height, or --p and --alpha")
    if args.mu and not sized:
        raise ValueError("--mu is for a rigid block: give --width and --height")
    for name in ("width", "height", "p", "alpha"):
        for value in getattr(args, name) or []:
            check_positive(f"--{name}", value)
    first, second = (args.width, args.height) if sized else (args.p, args.alpha)
    blocks: list[SlenderBlock | RockingBlock] = []
    for one, other, mu, restitution in itertools.product(
        first, second, args.mu or [None], args.restitution or ["housner"]
    ):
        if mu is not None:
            blocks.append(RockingBlock(width=one, height=other, mu=mu, restitution=restitution))
        elif sized:
            blocks.append(SlenderBlock.from_size(width=one, height=other, restitution=restitution))
        else:
            blocks.append(SlenderBlock(p=one, alpha=other, restitution=restitution))
    return blocks


def _rock(args: argparse.Namespace) -> str:
    blocks = _blocks(args)
    signs = {"recorded": 1, "reversed": -1}
    polarities = list(signs) if args.polarity == "both" else [args.polarity or "recorded"]
    records = Records(args)
    report = records.report
    rows: list[dict[str, Any]] = []
    if args.plot and len(blocks) * len(args.scale) * len(polarities) > 1:
        raise ValueError("--plot shows one response: give one block, one scale and one polarity")
    for found in records:
        for block, scale, polarity in itertools.product(blocks, args.scale, polarities):
            with report.kept(found.file):
                motion = found.motion.scaled(scale * signs[polarity])
                response = integrate(block, motion, settle=_settles(block))
                rows.append(_row(found, response, scale, polarity))
                if args.plot:
                    report.save(response.plot(title=printable(motion.name)), found)
    return report.answer(_COLUMNS, rows, _lines(rows))


def _settles(block: SlenderBlock | RockingBlock) -> bool:
    return block.restitution < 1 and (isinstance(block, SlenderBlock) or block.mu != 0)


def _row(found: Motion, response: RockingResponse, scale: float, polarity: str) -> dict[str, Any]:
    block = response.block
    return {
        "file": str(found.file),
        "record": found.motion.name,
        "component": found.component,
        "scale": scale,
        "pga_g": response.motion.peak_acceleration / STANDARD_GRAVITY,
        "polarity": polarity,
        "p_rad_s": block.p,
        "alpha_rad": block.alpha,
        "restitution": block.restitution,
        "mu": block.mu if isinstance(block, RockingBlock) else None,
        "peak_rotation_rad": response.peak_rotation,
        "peak_rotation_ratio": response.peak_rotation_ratio,
        "overturned": response.overturned,
        "overturned_at_s": response.overturned_at,
        "impacts": response.impacts,
        "base_displacement_m": response.residual,
        "sliding_distance_m": response.sliding_distance,
        "margin": response.margin,
        "condition": response.condition if isinstance(block, SlenderBlock) else None,
    }


def _lines(rows: list[dict[str, Any]]) -> Iterable[str]:
    if not rows:
        return
    names = [
        printable(row["record"] or row["file"])
        + (f" ({row['component']})" if row["component"] else "")
        + (" reversed" if row["polarity"] == "reversed" else "")
        for row in rows
    ]
    rigid = rows[0]["mu"] is not None
    width = max(len("record"), *map(len, names))
    yield (
        f"{'record':{width}}  {'PGA [g]':>7}  p [rad/s]  alpha [rad]  restitution  peak/alpha"
        "  overturned  impacts   margin" + ("    mu  base [cm]" if rigid else "")
    )
    for name, row in zip(names, rows):
        stands = row["overturned"] is None
        ratio = f"{row['peak_rotation_ratio']:10.3g}" if stands else f"{'':10}"
        yield (
            f"{name:{width}}  {column(row['pga_g'], 7, 3)}  {row['p_rad_s']:9.4g}"
            f"  {row['alpha_rad']:11.4g}  {row['restitution']:11.4g}  {ratio}"
            f"  {row['overturned'] or 'no':>10}  {row['impacts']:7d}  {row['margin']:7.2g}"
            + (f"  {row['mu']:4.3g}  {100 * row['base_displacement_m']:9.3g}" if rigid else "")
        )
