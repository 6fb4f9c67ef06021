"""A dam as a flexible slope: how wrong is the rigid block?

    python examples/13_dam.py [RECORD ...] [--ky 0.1] [--vs 300] [--out DIR]

A potential sliding mass of soil is not rigid. Coupled analysis slides a shear column on its base;
decoupled analysis computes its motion first, as if it did not slide, and then slides a rigid block
under its base shear. Whether the rigid block overestimates or underestimates the displacement
depends on the period of the mass, 4 H / Vs, over the mean period of the ground motion. Without
record files the example uses the 18 records of the package pyslammer.
"""

import argparse
from pathlib import Path

import numpy as np
import stickslip as ss
from matplotlib.figure import Figure
from stickslip.plotting import save, style

ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
ask.add_argument("records", nargs="*", help="files of any format that read_record knows")
ask.add_argument("--ky", type=float, default=0.1, help="yield acceleration [g]")
ask.add_argument("--vs", type=float, default=300.0, help="shear-wave velocity of the dam [m/s]")
ask.add_argument("--out", type=Path, default=Path(), help="folder for the picture")
args = ask.parse_args()

quakes = [ss.read_record(f) for f in args.records] or ss.sample_records()
heights = np.array([5.0, 10, 15, 20, 30, 40, 60, 80, 120])  # [m]


def dam(height):
    return ss.FlexibleSlope(
        ky_g=args.ky, height=height, shear_velocity=args.vs, damping_ratio=0.1, modes=3
    )


# Both polarities: a record does not state which way the slope faces.
rigid = np.zeros(len(quakes))  # [m]
coupled, decoupled = np.zeros((2, len(quakes), len(heights)))
block = ss.Coulomb(slip_level=args.ky * ss.STANDARD_GRAVITY, backward=np.inf)
mean_period = ss.Suite(quakes).intensity_measures().mean_period  # [s]
for i, quake in enumerate(quakes):
    for motion in (quake, quake.scaled(-1)):
        rigid[i] += ss.integrate(block, motion, settle=True).residual / 2
        for j, height in enumerate(heights):
            coupled[i, j] += dam(height).coupled(motion).residual / 2
            decoupled[i, j] += dam(height).decoupled(motion).residual / 2

slides = rigid > 0.005
ratio = 4 * heights / args.vs / mean_period[:, None]
print(f"{slides.sum()} of {len(quakes)} records move a rigid block by more than 5 mm")
print("displacement over that of the rigid block, median")
print(f"{'height [m]':>12}{'period [s]':>12}{'coupled':>12}{'decoupled':>12}")
for j, height in enumerate(heights):
    medians = (np.median(x[slides, j] / rigid[slides]) for x in (coupled, decoupled))
    print(f"{height:12g}{4 * height / args.vs:12.2f}" + "".join(f"{x:12.2f}" for x in medians))

with style():
    figure = Figure(figsize=(9, 3.8), layout="constrained")
    over_rigid, side_by_side = figure.subplots(1, 2)
    for name, x, color in (("decoupled", decoupled, "#d55e00"), ("coupled", coupled, "#0072b2")):
        quotient = x[slides] / rigid[slides, None]
        over_rigid.plot(ratio[slides].ravel(), quotient.ravel(), ".", color=color, markersize=5)
        over_rigid.plot([], [], "o", color=color, markersize=4, label=name)
    over_rigid.axhline(1, color="#222222", linewidth=0.8)
    over_rigid.set(xscale="log", xlabel="period of the dam / mean period of the record")
    over_rigid.set(ylabel="displacement / that of a rigid block", yscale="log", ylim=(0.03, 50))
    over_rigid.legend(fontsize=8)
    moved = (coupled > 1e-3) & (decoupled > 1e-3)
    side_by_side.loglog(100 * coupled[moved], 100 * decoupled[moved], ".", color="#0072b2")
    ends = 100 * np.array([coupled[moved].min(), coupled[moved].max()])
    side_by_side.plot(ends, ends, color="#222222", linewidth=0.8)
    side_by_side.set(xlabel="coupled displacement [cm]", ylabel="decoupled displacement [cm]")
    title = f"A dam that yields at {args.ky:g} g, Vs = {args.vs:g} m/s, in {len(quakes)} records"
    figure.suptitle(title, x=0.01, ha="left", fontsize=10, fontweight="bold")
args.out.mkdir(parents=True, exist_ok=True)
print("wrote", save(figure, args.out / "13_dam.png"))
