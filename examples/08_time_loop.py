"""Compiles and runs 08_time_loop.cpp, a block in a seismic code's time loop, and draws it.

    python examples/08_time_loop.py [--program FILE] [--out DIR]

Without --program it compiles the source next to it with $CXX or c++.
"""

import argparse
import os
import subprocess
import tempfile
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from stickslip import STANDARD_GRAVITY
from stickslip.plotting import save, style

ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
ask.add_argument("--program", type=Path, help="the compiled example, if it exists")
ask.add_argument("--out", type=Path, default=Path(), help="folder for the picture")
args = ask.parse_args()

source = Path(__file__).with_suffix(".cpp")
with tempfile.TemporaryDirectory() as folder:
    program, table = args.program or Path(folder, "example"), Path(folder, "histories.csv")
    if not args.program:
        include = source.parents[1] / "include"
        compiler = os.environ.get("CXX", "c++")
        subprocess.run([compiler, "-std=c++20", f"-I{include}", source, "-o", program], check=True)
    print(subprocess.run([program, table], check=True, capture_output=True, text=True).stdout)
    time, floor, block = np.loadtxt(table, delimiter=",", skiprows=1, unpack=True)

with style():
    figure = Figure(figsize=(7, 4.2), layout="constrained")
    shaking, way = figure.subplots(2, sharex=True, height_ratios=(1, 1.5))
    shaking.axhspan(-0.3, 0.3, color="#0072b2", alpha=0.12, linewidth=0, label="held: mu = 0.3")
    shaking.plot(time, floor / STANDARD_GRAVITY, color="#222222", linewidth=0.8)
    shaking.set_ylabel("floor acceleration\n[g]")
    shaking.set_title("A block on the floor of a building, advanced by one call per step")
    shaking.legend(fontsize=8)
    way.plot(time, 100 * block)
    way.axhline(0, color="#8a8a8a", linewidth=0.6)
    way.set(xlabel="time [s]", xlim=(0, time[-1]))
    way.set_ylabel("displacement on the floor\n[cm]")
args.out.mkdir(parents=True, exist_ok=True)
print("wrote", save(figure, args.out / "08_time_loop.png"))
