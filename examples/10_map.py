"""A map of Newmark displacements: a million cells from a hundred levels, with a bound.

    python examples/10_map.py [--cells N] [--out DIR]

Each cell of a synthetic terrain has its own yield acceleration ky. The displacement of a record
never grows with ky. So between two levels that were computed it lies between their displacements:
the error of interpolation has a bound, and no cell needs a run of its own.
"""

import argparse
from pathlib import Path

import numpy as np
import stickslip as ss
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from stickslip.plotting import save, style

ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
ask.add_argument("--cells", type=int, default=1000, help="along each side")
ask.add_argument("--out", type=Path, default=Path(), help="folder for the picture")
args = ask.parse_args()

# Terrain: a random surface with a spectrum that falls off; 1 % of it is steeper than 0.6.
side, cell = args.cells, 10.0  # cells, m
rng = np.random.default_rng(1)
k = np.hypot(np.fft.fftfreq(side)[:, None], np.fft.rfftfreq(side)[None, :]) * side
rough = np.exp(2j * np.pi * rng.random(k.shape)) / np.maximum(k, 1) ** 2.2 * (k > 0)
height = np.fft.irfft2(rough, (side, side))
steep = np.hypot(*np.gradient(height, cell))
steep *= 0.6 / np.quantile(steep, 0.99)

# An infinite slope: ky = c / (gamma t cos) + tan(phi) cos - sin, in g.
angle = np.arctan(steep)
ky = 0.1 + np.tan(np.radians(30)) * np.cos(angle) - np.sin(angle)
ky = np.maximum(ky, 0.02)

suite = ss.sample_records().scaled_to(pga_g=0.8)
levels = np.geomspace(ky.min(), ky.max(), 100)
newmark = ss.grid(ss.Coulomb, mu=levels, backward=float("inf"))
table = ss.sweep(newmark, suite, settle=True)
mean = table.peak.mean(axis=(1, 2))  # over records and polarities [m]

above = np.clip(np.searchsorted(levels, ky), 1, len(levels) - 1)
low, high = mean[above], mean[above - 1]  # the displacement is between these
part = np.log(ky / levels[above - 1]) / np.log(levels[above] / levels[above - 1])
displacement = high + part * (low - high)
bound = np.maximum(high - displacement, displacement - low)
print(f"yield acceleration    {ky.min():8.2f} to {ky.max():.2f} g")
print(f"{ky.size:,} cells, {table.peak.size:,} analyses")
print(f"largest displacement  {100 * displacement.max():8.2f} cm")
print(f"error at most         {100 * bound.max():8.2f} cm, mean {100 * bound.mean():.3f} cm")

with style():
    figure = Figure(figsize=(7, 3.2), layout="constrained")
    axes = figure.subplots(1, 2)
    extent = (0, side * cell / 1000, 0, side * cell / 1000)
    for ax, values, title, norm in (
        (axes[0], ky, "yield acceleration [g]", None),
        (axes[1], 100 * displacement, "mean displacement [cm]", LogNorm(0.1)),
    ):
        image = ax.imshow(values, extent=extent, origin="lower", cmap="viridis", norm=norm)
        figure.colorbar(image, ax=ax, shrink=0.8)
        ax.set(title=title, xlabel="east [km]", ylabel="north [km]")
args.out.mkdir(parents=True, exist_ok=True)
print("wrote", save(figure, args.out / "10_map.png"))
