"""``stickslip slide``: how far a slider slides in records."""

from __future__ import annotations

import argparse
import math
import statistics
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from .. import (
    STANDARD_GRAVITY,
    ConvergenceError,
    GroundMotion,
    IsolatedStructure,
    PlanarResponse,
    PlanarSlider,
    Response,
    Slider,
    Stops,
    StructureResponse,
    integrate,
)
from .._text import printable
from .building import BUILDING, building_on
from .options import add_options
from .output import check_outputs, column, complain
from .reading import RECORDS, VERTICAL, Motion, Records
from .report import outputs
from .slider import (
    PLANAR,
    SLIDERS,
    any_slider_of,
    cells,
    check_planar,
    described,
    heads,
    variations,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["add_slide"]

_Response: TypeAlias = Response | PlanarResponse | StructureResponse

_COLUMNS = (
    "file",
    "record",
    "component",
    "scale",
    "pga_g",
    "law",
    "mu",
    "mu_static",
    "slip_level_forward_m_s2",
    "slip_level_backward_m_s2",
    "reach_m",
    "slope_degrees",
    "period_s",
    "damping_ratio",
    "stop_gap_m",
    "restitution",
    "contact",
    "components",
    "polarity",
    "peak_m",
    "residual_m",
    "sliding_distance_m",
    "time_sliding_s",
    "slips",
    "impacts_forward",
    "impact_speed_forward_m_s",
    "impacts_backward",
    "impact_speed_backward_m_s",
    "at_rest",
)
# With --planar; the others of impacts are then empty.
_PLANAR_COLUMNS = (
    "residual_axis_m",
    "residual_transverse_m",
    "peak_time_s",
    "peak_azimuth_degrees",
    "impacts",
    "impact_speed_m_s",
)
# With a building: the largest of all floors.
_FLOOR_COLUMNS = ("peak_base_acceleration_m_s2", "peak_floor_acceleration_m_s2", "peak_drift_m")
_OPTIONS = """
[records]
--scale ratios = 1
    factor on the ground acceleration (default 1)
[records, one of]
--polarity recorded|reversed|both
    slide each record as recorded (the default), reversed, or both; also prints the mean of both
    (for residuals, of their magnitudes)
--both polarity=both
    --polarity both
"""
_ANIMATE = """
[output]
--animate file FILE
    picture that moves (.gif, .mp4, .html): the object sliding on its shaking floor; one record and
    one slider
"""


def add_slide(commands: argparse._SubParsersAction) -> None:
    parser = commands.add_parser(
        "slide",
        help="slide blocks under records and print displacements",
        description="Slides blocks under strong-motion records and continues after the end of"
        " each record until they come to rest. Prints peak, residual and path length of the"
        " displacement relative to the ground [cm], the time spent sliding [s] and the number of"
        " slips (a reversal ends one slip and begins another). With --planar, peak and residual are"
        " distances from the start. Ground acceleration is given in g ="
        " 9.80665 m/s^2.",
        epilog="For example, `stickslip slide quakes/*.AT2 --mu 0.1 0.2 --csv slid.csv`."
        " --mu, --mu-static, --reach, --slope, --period, --damping-ratio, --stop-gap,"
        " --restitution and --scale take a number or a range START:STOP:STEP, which includes STOP,"
        " such as 0.05:0.6:0.05; every combination is computed."
        " A slider that does not come to rest (no friction; a caster that has escaped) is"
        " reported in its state at the end of the record, and its row says so. A record that cannot"
        " be read or slid is reported in one line on stderr; the others are printed, and the exit"
        " code is 1. With --json, such failures are also listed under 'errors', and null stands"
        " for an infinite value or an option that was not given. Bad options end the command with"
        " exit code 2 before any file is read.",
    )
    tables = (RECORDS, SLIDERS, BUILDING, VERTICAL, PLANAR, _OPTIONS, outputs(), _ANIMATE)
    add_options(parser, *tables)
    parser.set_defaults(horizontal=True, contact=None, run=_slide)


def _slide(args: argparse.Namespace) -> str:
    cases, several = variations(args)
    if args.planar:
        check_planar(args)
        if args.plot and len(cases) > 1:
            raise ValueError(
                f"--plot draws one slider with --planar, got {len(cases)}; stickslip sweep draws"
                " several"
            )
    if args.animate and (len(cases) > 1 or args.polarity == "both"):
        raise ValueError("--animate shows one response: give one slider and one polarity")
    sliders = [(case, any_slider_of(case)) for case in cases]
    systems = [building_on(slider, case) for case, slider in sliders]
    on_building = any(isinstance(system, IsolatedStructure) for system in systems)
    if on_building and args.contact == "flight":
        raise ValueError("a building does not leave its base: leave out --contact flight")
    if args.plot and on_building and len(cases) > 1:
        raise ValueError(f"--plot draws one slider with a building, got {len(cases)}")
    records = Records(args)
    report = records.report
    if args.animate:
        from ..plotting import check_moving_suffix

        check_moving_suffix(args.animate)
        check_outputs([("--animate", args.animate)], report.inputs)
    rows: list[dict[str, Any]] = []
    slips, remark, limit = False, "", ""
    both_ways = args.polarity == "both"
    signs = {"recorded": 1, "reversed": -1}
    polarities = signs if both_ways else {args.polarity: signs[args.polarity or "recorded"]}
    for found in records:
        responses = {}
        for (case, slider), system in zip(sliders, systems):
            label = ", ".join(described(case, several, "\u03bc"))
            who = ", ".join(described(case, several))
            with report.kept(found.file, f"{who}: "):
                both = []
                for polarity, sign in polarities.items():
                    factor = sign * case.scale
                    motion = found.motion if factor == 1 else found.motion.scaled(factor)
                    response = _settle(system, motion, case.contact)
                    responses[label + (f", {polarity}" if both_ways else "")] = response
                    slips = slips or response.time_sliding > 0
                    limit = limit or (response.remark if response.time_sliding > 0 else "")
                    remark = remark or ("" if slips else response.remark)
                    both.append(_row(case, found, slider, response, polarity))
                rows += [*both, *([_mean(both)] if both_ways else [])]
        if args.animate and responses:
            if str(args.animate) in report.figures:
                raise ValueError("--animate shows one response, got several records")
            with report.kept(found.file):
                film = next(iter(responses.values())).animate()
                report.figures.append(str(film.write(args.animate)))
        if args.plot and responses:
            with report.kept(found.file):
                report.save(_figure(responses), found)
    if args.units and remark and not slips:
        complain("warning: " + remark.replace('units="g"', "--units g"))
    if limit:
        complain(f"warning: {limit}")
    columns = (
        *_COLUMNS,
        *(["slider"] if args.slider else []),
        *(_PLANAR_COLUMNS if args.planar else ()),
        *(_FLOOR_COLUMNS if on_building else ()),
    )
    return report.answer(columns, rows, _table(rows, several))


def _figure(responses: dict[str, _Response]) -> Figure:
    from .. import plotting

    if len(responses) == 1:
        return next(iter(responses.values())).plot()
    return plotting.plot_responses(
        [one for one in responses.values() if isinstance(one, Response)], list(responses)
    )


def _settle(
    system: Slider | PlanarSlider | IsolatedStructure,
    motion: GroundMotion,
    contact: Literal["flight", "clipped"] | None,
) -> _Response:
    how: dict[str, Any] = {}
    if contact and not isinstance(system, IsolatedStructure):
        how["contact"] = contact
    try:
        return integrate(system, motion, settle=True, **how)
    except ConvergenceError:
        return integrate(system, motion, **how)


def _row(
    args: argparse.Namespace,
    found: Motion,
    slider: Slider | PlanarSlider,
    response: _Response,
    polarity: str | None,
) -> dict[str, Any]:
    """The row of one response; keys include units."""
    planar = isinstance(response, PlanarResponse)
    if isinstance(slider, PlanarSlider):
        forward = backward = slider.resist()
    else:
        forward, backward = (slider.resist(backward=back) for back in (False, True))
    return {
        "file": str(found.file),
        "record": response.motion.name,
        "component": found.component,
        "scale": args.scale,
        "pga_g": _pga(response) / STANDARD_GRAVITY,
        "law": args.law,
        "mu": args.mu,
        "mu_static": args.mu_static,
        "slip_level_forward_m_s2": forward,
        "slip_level_backward_m_s2": backward,
        "reach_m": getattr(getattr(slider.law, "sliding", slider.law), "reach", None),
        "slope_degrees": args.slope,
        "period_s": args.period,
        "damping_ratio": args.damping_ratio,
        "stop_gap_m": args.stop_gap,
        "restitution": args.restitution,
        "contact": getattr(response, "contact", "clipped"),
        "components": response.components,
        "polarity": polarity,
        "peak_m": response.peak,
        "residual_m": math.hypot(*response.residual) if planar else response.residual,
        "sliding_distance_m": response.sliding_distance,
        "time_sliding_s": response.time_sliding,
        "slips": response.slips,
        "liftoffs": _liftoffs(response),
        **_impacts(response, slider.stops),
        "at_rest": response.at_rest,
        **(_in_file(args, slider) if args.slider else {}),
        **(_in_plane(response) if isinstance(response, PlanarResponse) else {}),
        **(_of_floors(response) if isinstance(response, StructureResponse) else {}),
    }


def _of_floors(response: StructureResponse) -> dict[str, float]:
    """What a row has besides with a building."""
    floors = response.floors
    peaks = (
        response.peak_base_acceleration,
        float(floors.peak_acceleration.max()),
        float(floors.peak_drift.max()),
    )
    return dict(zip(_FLOOR_COLUMNS, peaks))


def _in_file(args: argparse.Namespace, slider: Slider | PlanarSlider) -> dict[str, Any]:
    """What the options are for the slider of a file."""
    stops, spring = slider.stops, slider.natural_frequency > 0
    return {
        "slider": args.slider,
        "law": type(slider.law).__name__,
        "slope_degrees": slider.slope_degrees,
        "period_s": slider.period if spring else None,
        "damping_ratio": slider.damping_ratio if spring else None,
        "stop_gap_m": stops and stops.gap,
        "restitution": stops and stops.restitution,
    }


def _pga(response: _Response) -> float:
    """The peak ground acceleration [m/s^2]; in the plane, of the resultant."""
    motion = response.motion
    if not isinstance(response, PlanarResponse) or motion.transverse is None:
        return float(motion.peak_acceleration)
    return max(map(math.hypot, motion.acceleration.tolist(), motion.transverse.tolist()))


def _in_plane(response: PlanarResponse) -> dict[str, Any]:
    """What a row has besides in the plane."""
    axis, transverse = response.residual.tolist()
    found = {
        "residual_axis_m": axis,
        "residual_transverse_m": transverse,
        "peak_time_s": response.peak_time,
        "peak_azimuth_degrees": response.peak_azimuth,
        "impacts": None,
        "impact_speed_m_s": None,
    }
    if response.slider.stops is not None:
        speeds = [math.hypot(*velocity) for velocity in response.impacts["velocity"].tolist()]
        found |= {"impacts": len(speeds), "impact_speed_m_s": max(speeds, default=0.0)}
    return found


def _liftoffs(response: _Response) -> int | None:
    """How often the slider left the ground; None without vertical motion."""
    if "vertical" not in response.components:  # and no array is made, which would import NumPy
        return None
    return int((response.events["kind"] == "liftoff").sum())


def _impacts(response: _Response, stops: Stops | None) -> dict[str, Any]:
    """The number of impacts on each stop and the largest speed before one; None without stops, or
    with a circular one."""
    names = ("impacts_{}", "impact_speed_{}_m_s")
    if (
        isinstance(response, PlanarResponse) or stops is None
    ):  # and no array is made, which would import NumPy
        return {name.format(side): None for side in ("forward", "backward") for name in names}
    hits = response.impacts
    found: dict[str, Any] = {}
    for side, sign in (("forward", 1), ("backward", -1)):
        speed = abs(hits["velocity"][sign * hits["displacement"] > 0])
        found |= zip(
            (name.format(side) for name in names), (speed.size, float(speed.max(initial=0)))
        )
    return found


def _mean(rows: list[dict[str, Any]]) -> dict[str, Any]:
    """The mean over both polarities; of residuals, the mean magnitude, because they have opposite
    signs for a symmetric slider."""

    def mean(name: str) -> float:
        return statistics.fmean(abs(row[name]) for row in rows)

    names = ("peak_m", "residual_m", "sliding_distance_m", "time_sliding_s", "slips")
    if rows[0]["impacts_forward"] is not None:
        names += tuple(name for name in rows[0] if name.startswith("impact"))
    names += tuple(name for name in _FLOOR_COLUMNS if name in rows[0])
    return {
        **rows[0],
        "polarity": "mean",
        **{name: mean(name) for name in names},
        "at_rest": all(row["at_rest"] for row in rows),
    }


def _table(rows: list[dict[str, Any]], several: list[str]) -> Iterable[str]:
    if not rows:
        return
    names = [_name(row) for row in rows]
    # Options that were given once would be in no column, and nothing else would tell of them.
    given = {"mu_static": "mu_static", "stop_gap": "stop_gap_m", "restitution": "restitution"}
    first = "slider" if "slider" in rows[0] else "mu"
    shown = [first, *(name for name, key in given.items() if rows[0][key] is not None)]
    shown += [name for name in several if name not in shown]
    planar, building = "impacts" in rows[0], _FLOOR_COLUMNS[0] in rows[0]
    stops = rows[0]["impacts" if planar else "impacts_forward"] is not None
    width = max(len("record"), *map(len, names))
    both = any(row["polarity"] for row in rows)
    yield (
        f"{'record':{width}}  PGA [g]{heads(shown)}{'  polarity' if both else ''}  peak [cm]"
        "  residual [cm]  distance [cm]  sliding [s]  slips"
        f"{'  impacts  at most [m/s]' if stops else ''}"
        f"{'  azimuth of peak' if planar else ''}"
        f"{'  floors at most [g]  drift at most [mm]' if building else ''}"
    )
    last: object = None
    for name, row in zip(names, rows):
        head = f"{name:{width}}  {column(row['pga_g'], 7, 3)}"
        this = row["file"], row["component"], row["scale"]
        polarity = f"  {row['polarity']:8}" if both else ""
        yield (
            f"{head if this != last else '':{width + 9}}{cells(row, shown)}{polarity}"
            f"  {column(row['peak_m'] * 100, 9)}  {column(row['residual_m'] * 100, 13)}"
            f"  {column(row['sliding_distance_m'] * 100, 13)}"
            f"  {column(row['time_sliding_s'], 11)}"
            f"  {row['slips']:5g}{_hits(row) if stops else ''}"
            f"{_azimuth(row) if planar else ''}"
            f"{_floors(row) if building else ''}"
            f"{'' if row['at_rest'] else '  never rests: at end of record'}"
        )
        last = this
    if acts := [row["liftoffs"] for row in rows if row["liftoffs"] is not None]:
        which = "all" if len(acts) == len(rows) else f"{len(acts)}"
        yield (
            f"(vertical motion acts in {which} of {len(rows)} rows; the slider leaves the ground in"
            f" {sum(count > 0 for count in acts)})"
        )


def _hits(row: dict[str, Any]) -> str:
    """The columns of impacts: those on both stops together."""
    if "impacts" in row:
        return f"  {row['impacts']:7g}  {row['impact_speed_m_s']:14.3g}"
    count = row["impacts_forward"] + row["impacts_backward"]
    speed = max(row["impact_speed_forward_m_s"], row["impact_speed_backward_m_s"])
    return f"  {count:7g}  {speed:14.3g}"


def _azimuth(row: dict[str, Any]) -> str:
    """The column of the direction of the peak, empty where it is not known."""
    azimuth = row["peak_azimuth_degrees"]
    return f"  {'' if azimuth is None else f'{azimuth:.0f}':>15}"


def _floors(row: dict[str, Any]) -> str:
    """The columns of a building."""
    return (
        f"  {column(row['peak_floor_acceleration_m_s2'] / STANDARD_GRAVITY, 18, 3)}"
        f"  {column(1000 * row['peak_drift_m'], 18)}"
    )


def _name(row: dict[str, Any]) -> str:
    component = f" ({row['component']})" if row["component"] else ""
    return printable(row["record"] or row["file"]) + component
