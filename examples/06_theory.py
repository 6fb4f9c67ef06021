"""Theory against simulation: what each theory says of the same block under the same pulses.

    python examples/06_theory.py [--event "great near field"] [--mu 0.1] [--members 20000]
                                 [--out DIR]

A theory takes milliseconds where an ensemble takes a second; the ensemble says how far to trust it.
"""

import argparse
from pathlib import Path

import stickslip as ss
from stickslip.plotting import save

ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
ask.add_argument("--event", default="great near field", choices=ss.PoissonPulses.events())
ask.add_argument("--mu", type=float, default=0.1, help="coefficient of friction [-]")
ask.add_argument("--members", type=int, default=20_000, help="of the ensemble")
ask.add_argument("--out", type=Path, default=Path(), help="folder for the picture")
args = ask.parse_args()

block, quakes = ss.Coulomb(mu=args.mu), ss.PoissonPulses.event(args.event)
comparison = ss.compare(block, quakes, members=args.members, seed=1)
print(comparison)

title = f"{args.event}, mu = {args.mu:g}, {args.members:,} members"
args.out.mkdir(parents=True, exist_ok=True)
print("wrote", save(comparison.plot(title=title), args.out / "06_theory.png"))
