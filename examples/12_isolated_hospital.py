"""An isolated hospital: what its floors and the equipment on them feel.

    python examples/12_isolated_hospital.py [RECORD ...] [--mu 0.06] [--radius 2] [--out DIR]

A hospital of five floors stands on friction pendulums. Its floors accelerate less and its stories
drift less than on a fixed base; but the base of the isolated building starts and stops abruptly,
which excites its higher modes, and those shake stiff equipment. The loop is that of the isolation
layer in the record with the median displacement. Without record files the example uses the 18
records of the package pyslammer.
"""

import argparse
from pathlib import Path

import numpy as np
import stickslip as ss
from matplotlib.figure import Figure
from stickslip.plotting import save, style

ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
ask.add_argument("records", nargs="*", help="files of any format that read_record knows")
ask.add_argument("--mu", type=float, default=0.06, help="coefficient of friction [-]")
ask.add_argument("--radius", type=float, default=2.0, help="of the pendulums [m]")
ask.add_argument("--out", type=Path, default=Path(), help="folder for the picture")
args = ask.parse_args()

g = ss.STANDARD_GRAVITY
quakes = [ss.read_record(f) for f in args.records] or ss.sample_records()
hospital = ss.Structure.shear_building(
    masses=[1.2e6, 1.2e6, 1.2e6, 1.2e6, 0.9e6],  # [kg]
    stiffnesses=[1.6e9, 1.5e9, 1.3e9, 1.1e9, 0.9e9],  # [N/m]
    damping_ratio=0.03,
)
designs = {
    "fixed base": ss.Coulomb(slip_level=1e3),  # never slides
    "isolated": ss.FrictionPendulum(mu=args.mu, radius=args.radius),
}
ensembles = {
    name: ss.run_ensemble(
        ss.IsolatedStructure(slider, hospital, base_mass=1.5e6),
        quakes,
        members=len(quakes),
        seed=1,
        settle=True,
    )
    for name, slider in designs.items()
}

print(f"{len(quakes)} records, first period on a fixed base {hospital.modes().periods[0]:.2f} s")
print(f"{'median':>12}{'roof [g]':>12}{'drift [mm]':>12}{'base [cm]':>12}")
for name, e in ensembles.items():
    roof = np.median(e.peak_floor_acceleration.values[:, -1]) / g
    drift = 1000 * np.median(e.peak_floor_drift.values.max(axis=1))
    print(f"{name:>12}{roof:12.3f}{drift:12.2f}{100 * np.median(e.peak):12.2f}")

responses = {
    name: [
        ss.integrate(ss.IsolatedStructure(slider, hospital, base_mass=1.5e6), quake)
        for quake in quakes
    ]
    for name, slider in designs.items()
}
floor, periods = 3, np.geomspace(0.05, 4, 60)
spectra = {
    name: [ss.response_spectrum(r, periods, floor=floor).values / g for r in of_design]
    for name, of_design in responses.items()
}
median = sorted(responses["isolated"], key=lambda r: r.peak)[len(quakes) // 2]

with style():
    figure = Figure(figsize=(7.5, 6.6), layout="constrained")
    (by_height, by_drift), (of_equipment, of_base) = figure.subplots(2, 2)
    for (name, e), color in zip(ensembles.items(), ("#d55e00", "#0072b2")):
        accelerations = np.column_stack(
            [e.peak_base_acceleration, e.peak_floor_acceleration.values]
        )
        for panel, values, first in (
            (by_height, accelerations / g, 0),
            (by_drift, 1000 * e.peak_floor_drift.values, 1),
        ):
            low, middle, high = np.percentile(values, (16, 50, 84), axis=0)
            number = np.arange(first, 6)
            panel.fill_betweenx(number, low, high, color=color, alpha=0.2, linewidth=0)
            panel.plot(middle, number, "o-", color=color, markersize=4, label=name)
        low, middle, high = np.percentile(spectra[name], (16, 50, 84), axis=0)
        of_equipment.fill_between(periods, low, high, color=color, alpha=0.2, linewidth=0)
        of_equipment.plot(periods, middle, color=color)
    by_height.set(xlabel="largest acceleration [g]", ylabel="floor", xlim=(0, None))
    by_height.legend(title="median, 16 % to 84 %", fontsize=8, title_fontsize=8)
    by_drift.set(xlabel="largest drift [mm]", ylabel="floor", xlim=(0, None), yticks=range(1, 6))
    of_equipment.set(xlabel="period of the equipment [s]", xscale="log", yscale="log")
    of_equipment.set(ylabel=f"acceleration of equipment on floor {floor} [g]")
    median.plot_hysteresis(ax=of_base, title=median.motion.name)
    title = f"A hospital of five floors in {len(quakes)} records"
    figure.suptitle(title, x=0.01, ha="left", fontsize=10, fontweight="bold")
args.out.mkdir(parents=True, exist_ok=True)
print("wrote", save(figure, args.out / "12_isolated_hospital.png"))
