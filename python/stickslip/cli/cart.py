"""``stickslip cart``: how far a cart rolls and turns in both horizontal components of records."""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from .. import Cart, CartResponse, FixedWheel, Foot, SwivelCaster, integrate
from .._text import printable
from .options import add_options
from .output import column
from .reading import RECORDS, Records
from .report import outputs

if TYPE_CHECKING:
    from ..carts import CartEnsemble

__all__ = ["add_cart"]

_OPTIONS = """
[cart]
cart file CART
    JSON file, as Cart.to_json writes it: supports, radius_of_gyration, center and outline
--wall number X Y DX DY
    a point on a wall, relative to the center of mass at the start [m], and its direction: also
    print how near the outline comes to it
--members whole N
    draw the headings of the casters N times, uniform over the circle, and print quantiles
--seed whole S = 1
    of --members (default 1)
[records]
--scale ratios... X = 1
    factor on the ground acceleration (default 1)
"""
_ABOUT = ("file", "station", "scale")
_PEAKS = {"peak": "peak_m", "peak_yaw": "peak_yaw_rad", "peak_outline": "peak_outline_m"}
_RESULTS = (
    *(*_PEAKS.values(), "residual_axis_m", "residual_transverse_m", "residual_yaw_rad"),
    *("clearance_m", "hit_time_s", "hit_speed_m_s", "margin"),
)
_QUANTILES = (0.05, 0.5, 0.95)
_STATISTICS = (
    *(f"{name}_{100 * q:02.0f}" for name in _PEAKS.values() for q in _QUANTILES),
    "hitting",
)


def add_cart(commands: argparse._SubParsersAction) -> None:
    """Add the subcommand."""
    parser = commands.add_parser(
        "cart",
        help="roll a cart under stations and print how far it goes and turns",
        description="Groups the components of each station, from one file or several, and rolls a"
        " cart under both horizontal ones and the vertical one, until it comes to rest (without"
        " rolling resistance, to the end of the record). Prints the peak displacement of the center"
        " of mass and of the corner that moves farthest, the peak yaw and the residual. Histories"
        " hang on the headings of the casters: --members draws them at random and prints the 5, 50"
        " and 95 % quantiles.",
        epilog="For example, `stickslip cart cart.json station.zip --members 200`. A station that"
        " cannot be read is reported in one line on stderr; the others are printed, and the exit"
        " code is 1.",
    )
    add_options(parser, _OPTIONS, RECORDS, outputs(each="station"))
    parser.set_defaults(horizontal=True, station=True, pairs=True, run=_cart)


def _cart(args: argparse.Namespace) -> str:
    from ..ensemble import run_ensemble  # imports NumPy, slowly

    cart = Cart.from_json(args.cart)
    settle = any(map(_resists, cart.supports))
    walls = [(args.wall[:2], args.wall[2:])] if args.wall else []
    if args.plot and (args.members or len(args.scale) > 1):
        raise ValueError("--plot shows one response: give one scale, and not --members")
    records = Records(args)
    report = records.report
    rows: list[dict[str, Any]] = []
    for found in records:
        for scale in args.scale:
            with report.kept(found.file):
                motion = found.motion.scaled(scale)
                row: dict[str, Any] = dict(zip(_ABOUT, (str(found.file), motion.name, scale)))
                if args.members:
                    how = {"members": args.members, "seed": args.seed, "settle": settle}
                    drawn = run_ensemble(cart.with_random_headings(), motion, walls=walls, **how)
                    rows.append(row | _statistics(drawn))
                    continue
                response = integrate(cart, motion, settle=settle, walls=walls)
                rows.append(row | _results(response))
                if args.plot:
                    report.save(response.plot(title=printable(motion.name)), found)
    columns = _STATISTICS if args.members else _RESULTS
    return report.answer((*_ABOUT, *columns), rows, _lines(rows, bool(walls)))


def _resists(support: SwivelCaster | FixedWheel | Foot) -> bool:
    """Whether the support brings a cart to rest on any path."""
    if isinstance(support, Foot) or getattr(support, "lock", None):
        return True
    return support.rolling_mu > 0


def _results(r: CartResponse) -> dict[str, Any]:
    row = {column: getattr(r, name) for name, column in _PEAKS.items()}
    row["residual_axis_m"], row["residual_transverse_m"] = r.residual.tolist()
    row["residual_yaw_rad"] = r.residual_yaw
    for one in r.clearances or [None]:
        row["clearance_m"] = one and one.least
        row["hit_time_s"] = one and one.hit_time
        row["hit_speed_m_s"] = one and one.hit_speed
    return {**row, "margin": r.margin}


def _statistics(e: CartEnsemble) -> dict[str, Any]:
    row = {
        f"{column}_{100 * q:02.0f}": e.quantile(q, of=name).value
        for name, column in _PEAKS.items()
        for q in _QUANTILES
    }
    return {**row, "hitting": e.hitting().value if e.walls else None}


def _lines(rows: list[dict[str, Any]], walled: bool) -> Iterable[str]:
    if not rows:
        return
    names = [printable(row["station"] or row["file"]) for row in rows]
    width = max(len("station"), *map(len, names))
    drawn = "margin" not in rows[0]
    heads, keys = ["center [cm]", "yaw [rad]", "corner [cm]"], list(_PEAKS.values())
    if drawn:
        heads = [f"{head} {100 * q:.0f}%" for head in heads for q in _QUANTILES]
        keys = [f"{key}_{100 * q:02.0f}" for key in keys for q in _QUANTILES]
    else:
        heads += ["left at [cm]", "across [cm]", "turned [rad]"]
        keys += ["residual_axis_m", "residual_transverse_m", "residual_yaw_rad"]
    if walled:
        heads.append("hits wall" if drawn else "clear [cm]")
        keys.append("hitting" if drawn else "clearance_m")
    yield f"{'station':{width}}  {'scale':>6}" + "".join(f"  {head}" for head in heads)
    for name, row in zip(names, rows):
        cells = (
            column(row[key] * (100 if "_m" in key else 1), len(head), 2 if "_m" in key else 3)
            for key, head in zip(keys, heads)
        )
        yield f"{name:{width}}  {row['scale']:6.3g}" + "".join(f"  {cell}" for cell in cells)
