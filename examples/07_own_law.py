"""Compiles and runs 07_own_law.cpp, a friction law of your own, and draws it.

    python examples/07_own_law.py [--program FILE] [--out DIR]

Without --program it compiles the source next to it with $CXX or c++.
"""

import argparse
import os
import subprocess
import tempfile
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
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
    time, ground, patch, rough = np.loadtxt(table, delimiter=",", skiprows=1, unpack=True)

with style():
    figure = Figure(figsize=(7, 4.4), layout="constrained")
    shaking, way = figure.subplots(2, sharex=True, height_ratios=(1, 2))
    shaking.plot(time, ground, color="#222222", linewidth=0.8)
    shaking.set_ylabel("ground acceleration\n[m/s\N{SUPERSCRIPT TWO}]")
    shaking.set_title("A rough patch on a smooth floor, with a spring of period 3 s")
    way.axhspan(-10, 10, color="#e6e6e6", linewidth=0, label="reach of the patch")
    way.plot(time, 100 * patch, label="on the patch")
    way.plot(time, 100 * rough, "--", label="as rough everywhere")
    way.set(xlabel="time [s]", xlim=(0, time[-1]), ylabel="relative displacement\n[cm]")
    way.legend(fontsize=8)
args.out.mkdir(parents=True, exist_ok=True)
print("wrote", save(figure, args.out / "07_own_law.png"))
