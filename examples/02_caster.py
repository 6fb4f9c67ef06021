"""A cabinet on four casters: does it stay, or does it roll away?

    python examples/02_caster.py [RECORD] [--mu 0.5] [--trail 0.04] [--width 0.032] [--out DIR]

At first the wheels stand across the motion, and scrub as they pivot: the slip level falls off as
sech(x / reach). The law is reliable within about the reach; beyond it the wheels are in line with
the motion, and small disturbances that the model omits decide what follows. Without a record file
the example uses two records of the package pyslammer: under one the cabinet rolls away, under the
other it stays within the reach.
"""

import argparse
from pathlib import Path

import stickslip as ss
from matplotlib.figure import Figure
from stickslip.plotting import save, style

ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
ask.add_argument("record", nargs="?", help="a file of any format that read_record knows")
ask.add_argument("--mu", type=float, default=0.5, help="friction of wheel and floor [-]")
ask.add_argument("--trail", type=float, default=0.04, help="from pivot to wheel axis [m]")
ask.add_argument("--width", type=float, default=0.032, help="of the wheel [m]")
ask.add_argument("--out", type=Path, default=Path(), help="folder for the picture")
args = ask.parse_args()

if args.record:
    quakes = [ss.read_record(args.record)]
else:
    quakes = [ss.sample_record("Kobe"), ss.sample_record("Nahanni")]
casters = ss.Caster.from_geometry(mu=args.mu, trail=args.trail, wheel_width=args.width)
things = {
    "on casters": casters,
    "block of the casters' slip level": ss.Coulomb(slip_level=casters.slip_level),
    "brakes on": ss.Coulomb(mu=args.mu),
}
runs = [{name: ss.integrate(t, quake) for name, t in things.items()} for quake in quakes]

level = casters.slip_level / ss.STANDARD_GRAVITY
print(f"casters: slip level {level:.3f} g, reach {100 * casters.reach:.1f} cm\n")
print(f"{'':40}{'peak':>10}{'at the end':>14}   [cm]")
for quake, run in zip(quakes, runs):
    print(quake.name)
    for name, r in run.items():
        still = "" if r.at_rest else f"   moves at {100 * r.velocity[-1]:.1f} cm/s"
        print(f"    {name:36}{100 * r.peak:10.2f}{100 * r.residual:14.2f}{still}")

with style():
    figure = Figure(figsize=(4.5 * len(runs), 3.8), layout="constrained")
    for axes, quake, run in zip(figure.subplots(1, len(runs), squeeze=False)[0], quakes, runs):
        reach = 100 * casters.reach
        axes.axhspan(-reach, reach, color="#e6e6e6", linewidth=0, label="within the reach")
        for (name, r), dashes in zip(run.items(), ("-", "--", ":")):
            axes.plot(r.time, 100 * r.displacement, dashes, label=name)
        axes.set(title=quake.name, xlabel="time [s]", xlim=(0, quake.duration))
    figure.axes[0].set_ylabel("relative displacement [cm]")
    figure.axes[0].legend(fontsize=8, loc="lower left")
args.out.mkdir(parents=True, exist_ok=True)
print("wrote", save(figure, args.out / "02_caster.png"))
