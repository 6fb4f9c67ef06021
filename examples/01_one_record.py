"""How far does a block slide in one earthquake?

    python examples/01_one_record.py [RECORD] [--mu 0.2] [--out DIR]

Without a record file the example uses Kobe 1995, from the package pyslammer.
"""

import argparse
from pathlib import Path

import stickslip as ss
from stickslip.plotting import save

ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
ask.add_argument("record", nargs="?", help="a file of any format that read_record knows")
ask.add_argument("--mu", type=float, default=0.2, help="coefficient of friction [-]")
ask.add_argument("--out", type=Path, default=Path(), help="folder for the picture")
args = ask.parse_args()

quake = ss.read_record(args.record) if args.record else ss.sample_record("Kobe")
r = ss.integrate(ss.Coulomb(mu=args.mu), quake, settle=True)  # until it comes to rest

print(
    f"{quake.name}: {quake.peak_acceleration / ss.STANDARD_GRAVITY:.3f} g, {quake.duration:.1f} s"
)
print(f"peak displacement      {100 * r.peak:7.2f} cm")
print(f"residual displacement  {100 * r.residual:7.2f} cm")
print(f"sliding distance       {100 * r.sliding_distance:7.2f} cm")
print(f"sliding time           {r.time_sliding:7.2f} s, in {r.slips} slips")
print(
    f"energy per unit mass: input {r.energy.input:.4f} m^2/s^2, residual {r.energy.imbalance:.0e}"
)

args.out.mkdir(parents=True, exist_ok=True)
print("wrote", save(r.plot(), args.out / "01_one_record.png"))
