"""A triple pendulum in an earthquake: which surfaces slide, and how far each one.

    python examples/11_triple_pendulum.py [RECORD] [--out DIR]

The inner slider moves on two surfaces between two larger ones, so the isolator has four. At small
displacements it is stiff with little friction, at large ones soft with more. The numbers in the
loops name the surfaces that slide, from bottom to top. Without a record file the example uses Kobe
1995, from the package pyslammer.
"""

import argparse
from pathlib import Path

import stickslip as ss
from matplotlib.figure import Figure
from stickslip.plotting import plot_surfaces, save, style

ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
ask.add_argument("record", nargs="?", help="a file of any format that read_record knows")
ask.add_argument("--out", type=Path, default=Path(), help="folder for the picture")
args = ask.parse_args()

quake = ss.read_record(args.record) if args.record else ss.sample_record("Kobe")
isolator = ss.TriplePendulum(
    radii=[0.3937, 3.7465, 3.7465],  # inner, lower outer, upper outer [m]
    mu=[0.01, 0.04, 0.08],
    capacities=[0.0716, 0.5043, 0.5043],  # [m]
)
r = ss.integrate(isolator, quake, settle=True)
loop = isolator.trace([r.peak, -r.peak, r.peak])  # the loop that encloses the response

print(f"{quake.name}, triple pendulum with a capacity of {100 * isolator.capacity:.1f} cm")
print(f"peak displacement      {100 * r.peak:7.2f} cm")
print(f"residual displacement  {100 * r.residual:7.2f} cm")
print(f"largest force          {abs(r.force).max() / ss.STANDARD_GRAVITY:7.3f} of the weight")
print("surfaces, from bottom to top: peak [cm], and how often at the stop")
for k, (peak, stops) in enumerate(zip(r.surfaces.peak, r.surfaces.stops), 1):
    print(f"{k:20} {100 * peak:9.2f} {stops:6}")

with style():
    figure = Figure(figsize=(9, 6.4), layout="constrained")
    above, below = figure.subfigures(2, 1, height_ratios=(1.25, 1))
    slow, fast = above.subplots(1, 2, sharey=True)
    loop.plot(ax=slow, title=f"Moved slowly to \N{PLUS-MINUS SIGN}{100 * r.peak:.1f} cm")
    r.plot_hysteresis(ax=fast, title=quake.name)
    plot_surfaces(r, ax=below.subplots())
args.out.mkdir(parents=True, exist_ok=True)
print("wrote", save(figure, args.out / "11_triple_pendulum.png"))
