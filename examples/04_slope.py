"""A slope: Newmark's block, one way and both ways.

    python examples/04_slope.py [RECORD] [--degrees 5] [--yield-g 0.1] [--out DIR]

Newmark's block slides downhill only. A block on a gentle slope can be pushed uphill as well: under
horizontal shaking it yields at g tan(phi - slope) downhill and at g tan(phi + slope) uphill, with
mu = tan(phi). A record does not state which way the slope faces, so the example runs both
directions. Without a record file it uses Kobe 1995, from the package pyslammer.
"""

import argparse
import math
from pathlib import Path

import numpy as np
import stickslip as ss
from matplotlib.figure import Figure
from stickslip.plotting import save, style

ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
ask.add_argument("record", nargs="?", help="a file of any format that read_record knows")
ask.add_argument("--degrees", type=float, default=5.0, help="of the slope")
ask.add_argument("--yield-g", type=float, default=0.1, help="yield acceleration downhill [g]")
ask.add_argument("--out", type=Path, default=Path(), help="folder for the picture")
args = ask.parse_args()

g = ss.STANDARD_GRAVITY
quake = ss.read_record(args.record) if args.record else ss.sample_record("Kobe")
theta = math.radians(args.degrees)


def uphill(ky):
    """The yield acceleration uphill of a block that yields at ky downhill [m/s^2]."""
    return g * math.tan(math.atan(ky / g) + 2 * theta)


def block(ky, one_way):
    """Yields at ky [m/s^2] downhill, which is forward."""
    mu = math.tan(math.atan(ky / g) + theta)
    return ss.Slider(ss.Coulomb(mu=mu), slope_degrees=args.degrees, one_way=one_way)


def one_way(ky):
    return block(ky, True)


def two_way(ky):
    return block(ky, False)


ky = args.yield_g * g
print(f"{quake.name}: yields at {ky / g:g} g downhill, {uphill(ky) / g:.3f} g uphill")
shown = {}
for facing, motion in (("recorded", quake), ("reversed", quake.scaled(-1))):
    for name, law in (("one-way", one_way(ky)), ("two-way", two_way(ky))):
        r = shown[name, facing] = ss.integrate(law, motion, settle=True)
        print(f"{name}, {facing:8} ends {100 * r.residual:7.2f} cm downhill, {r.slips} slips")

levels = np.geomspace(0.02, 0.5, 60)  # [g]
sweep = {
    (name, sign): [
        max(ss.integrate(law(k * g), quake.scaled(sign), settle=True).residual, 0) for k in levels
    ]
    for name, law in (("one-way", one_way), ("two-way", two_way))
    for sign in (1, -1)
}

with style():
    figure = Figure(figsize=(9, 3.8), layout="constrained")
    way, over = figure.subplots(1, 2)
    looks = {"one-way": "#0072b2", "two-way": "#d55e00"}
    for (name, facing), r in shown.items():
        dashes = "-" if facing == "recorded" else "--"
        way.plot(r.time, 100 * r.displacement, dashes, color=looks[name], label=f"{name}, {facing}")
    way.set(xlabel="time [s]", ylabel="displacement downhill [cm]", title=f"Yield at {ky / g:g} g")
    way.set_xlim(0, min(quake.duration, 25))
    way.legend(fontsize=8)
    for (name, sign), x in sweep.items():
        over.plot(levels, 100 * np.array(x), "-" if sign > 0 else "--", color=looks[name])
    over.set(xscale="log", yscale="log", xlabel="yield acceleration downhill [g]", ylim=(0.1, None))
    over.set(
        ylabel="final displacement downhill [cm]", title=f"A slope of {args.degrees:g} degrees"
    )
    over.set_xticks([0.02, 0.05, 0.1, 0.2, 0.5], ["0.02", "0.05", "0.1", "0.2", "0.5"])
    over.minorticks_off()
    over.yaxis.set_major_formatter(lambda value, _: f"{value:g}")
args.out.mkdir(parents=True, exist_ok=True)
print("wrote", save(figure, args.out / "04_slope.png"))
