"""An isolated floor, friction and a spring: which coefficient of friction?

    python examples/03_isolated_floor.py [RECORD ...] [--period 3] [--out DIR]

With more friction the floor moves less on its isolators, but its contents are shaken more. The
largest acceleration of a floor that slips is mu g + wn^2 peak, just before it turns back at its
largest displacement; a floor that never slips has the acceleration of the ground.
Without record files the example uses the 18 records of the package pyslammer.
"""

import argparse
import math
from pathlib import Path

import numpy as np
import stickslip as ss
from matplotlib.figure import Figure
from stickslip.plotting import save, style

ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
ask.add_argument("records", nargs="*", help="files of any format that read_record knows")
ask.add_argument("--period", type=float, default=3.0, help="of the floor without friction [s]")
ask.add_argument("--out", type=Path, default=Path(), help="folder for the picture")
args = ask.parse_args()

g, wn = ss.STANDARD_GRAVITY, 2 * math.pi / args.period
quakes = [ss.read_record(f) for f in args.records] or ss.sample_records()
mu = np.array([0.02, 0.03, 0.04, 0.05, 0.06, 0.08, 0.1, 0.12, 0.15, 0.2, 0.25, 0.3])

peak, residual, transmitted = np.zeros((3, len(quakes), len(mu)))  # [m], [m], [m/s^2]
for i, quake in enumerate(quakes):
    for j, m in enumerate(mu):
        r = ss.integrate(ss.Slider(ss.Coulomb(mu=m), natural_frequency=wn), quake, settle=True)
        peak[i, j], residual[i, j] = r.peak, abs(r.residual)
        transmitted[i, j] = m * g + wn**2 * r.peak if r.slips else quake.peak_acceleration

figures = {
    "peak displacement [cm]": 100 * peak,
    "residual displacement [cm]": 100 * residual,
    "transmitted acceleration [g]": transmitted / g,
}
print(f"{len(quakes)} records, period {args.period:g} s; median and 84th percentile\n")
print(f"{'mu':>6}" + "".join(f"{name:>31}" for name in figures))
for j, m in enumerate(mu):
    row = (np.percentile(f[:, j], (50, 84)) for f in figures.values())
    print(f"{m:6.2f}" + "".join(f"{low:21.3g}{high:10.3g}" for low, high in row))
best = mu[np.percentile(transmitted, 84, axis=0).argmin()]
print(f"\nleast transmitted, 84th percentile: mu = {best:g}")

with style():
    figure = Figure(figsize=(9, 3.6), layout="constrained")
    for axes, (name, f) in zip(figure.subplots(1, 3), figures.items()):
        axes.plot(mu, f.T, ".", color="#b0b0b0", markersize=3)
        axes.plot(mu, np.percentile(f, 50, axis=0), color="#222222", linewidth=2.5, label="median")
        axes.plot(mu, np.percentile(f, 84, axis=0), "--", color="#d55e00", label="84th percentile")
        axes.set(xscale="log", yscale="log", xlabel="coefficient of friction [\N{MINUS SIGN}]")
        axes.set(ylabel=name, ylim=(max(0.8 * f.min(), 0.03), 1.5 * f.max()))
        axes.set_xticks([0.02, 0.05, 0.1, 0.2, 0.3], ["0.02", "0.05", "0.1", "0.2", "0.3"])
        ticks = [t for k in range(-2, 3) for t in (10.0**k, 3 * 10.0**k)]
        low, high = axes.get_ylim()
        axes.set_yticks([t for t in ticks if low <= t <= high])
        axes.minorticks_off()
        axes.yaxis.set_major_formatter(lambda value, _: f"{value:g}")
    peaks, residuals, _ = figure.axes
    peaks.legend(fontsize=8, loc="lower left")
    held = 100 * mu * g / wn**2  # at rest friction holds the spring: no residual beyond
    residuals.plot(mu, held, ":", color="#0072b2")
    residuals.set_ylim(top=1.5 * held.max())
    residuals.annotate(
        "mu g / wn\N{SUPERSCRIPT TWO}", (mu[5], 1.3 * held[5]), ha="right", color="#0072b2"
    )
    title = f"A floor of period {args.period:g} s in {len(quakes)} records"
    figure.suptitle(title, x=0.01, ha="left", fontsize=10, fontweight="bold")
args.out.mkdir(parents=True, exist_ok=True)
print("wrote", save(figure, args.out / "03_isolated_floor.png"))
