"""How likely is it that a cabinet slides further than its clearance?

    python examples/05_ensemble.py [--event "great very near field"] [--limit 0.5]
                                   [--members 20000] [--out DIR]

Many earthquakes of one kind, drawn at random: pulses of the rate, width and strength that fit the
event. Bounds are for 95 % confidence.
"""

import argparse
from pathlib import Path

import numpy as np
import stickslip as ss
from matplotlib.figure import Figure
from stickslip.plotting import save, style

ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
ask.add_argument("--event", default="great very near field", choices=ss.PoissonPulses.events())
ask.add_argument("--limit", type=float, default=0.5, help="the clearance [m]")
ask.add_argument("--members", type=int, default=20_000, help="earthquakes")
ask.add_argument("--out", type=Path, default=Path(), help="folder for the picture")
args = ask.parse_args()

quakes = ss.PoissonPulses.event(args.event)
ensembles = {
    mu: ss.run_ensemble(
        ss.Coulomb(mu=mu),
        quakes,
        members=args.members,
        seed=1,
        settle=True,
        velocity_spectrum=False,
    )
    for mu in (0.1, 0.2, 0.3)
}

print(f"{args.event}, {quakes.duration:g} s, {args.members:,} members\n")
print("  mu      median [cm]   peak of which 5 % exceed [cm]     exceeds the limit [%]")
for mu, e in ensembles.items():
    median, high, over = e.quantile(0.5), e.quantile(0.95), e.exceedance(args.limit)
    print(
        f"{mu:4g}{100 * median.value:17.1f}"
        f"{100 * high.value:15.1f} ({100 * high.low:.1f} to {100 * high.high:.1f})"
        f"{100 * over.value:16.2f} ({100 * over.low:.2f} to {100 * over.high:.2f})"
    )

with style():
    figure = Figure(figsize=(7, 4.2), layout="constrained")
    axes = figure.subplots()
    for (mu, e), dashes in zip(ensembles.items(), ("-", "--", "-.")):
        x = np.linspace(0, e.quantile(1 - 3 / e.members).value, 200)
        low, value, high = np.array([(p.low, p.value, p.high) for p in map(e.exceedance, x)]).T
        (line,) = axes.plot(100 * x, value, dashes, label=f"mu = {mu:g}")
        axes.fill_between(100 * x, low, high, color=line.get_color(), alpha=0.25, linewidth=0)
    axes.axvline(100 * args.limit, color="#8a8a8a", linewidth=0.8)
    axes.annotate(" limit", (100 * args.limit, 1), va="top", color="#8a8a8a")
    axes.set(yscale="log", ylim=(1 / args.members, 1.1), xlim=(0, None))
    axes.set(xlabel="peak relative displacement [cm]", ylabel="probability of exceedance")
    axes.set_title(f"A block in a {args.event} event; bands: 95 % confidence")
    axes.legend()
args.out.mkdir(parents=True, exist_ok=True)
print("wrote", save(figure, args.out / "05_ensemble.png"))
