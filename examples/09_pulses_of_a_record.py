"""Pulses like a record: its spectrum, the thesis's pulses that fit it, and pulses that have it.

    python examples/09_pulses_of_a_record.py [RECORD] [--out DIR]

The strong motion of the record is treated as a part of a stationary process. Rectangular pulses fit
its spectrum with two parameters; a pulse of minimum phase has the whole spectrum.
"""

import argparse
from pathlib import Path

import numpy as np
import stickslip as ss
from matplotlib.figure import Figure
from stickslip.plotting import save, style

ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
ask.add_argument("record", nargs="?", type=Path, help="default: Loma Prieta 1989, of pyslammer")
ask.add_argument("--out", type=Path, default=Path(), help="folder for the picture")
args = ask.parse_args()

quake = ss.read_record(args.record) if args.record else ss.sample_record("Loma_Prieta")
strong = ss.strong_motion(quake)
fit = ss.fit_pulses(quake)
spectrum = ss.estimate_spectrum(quake, fit.center_frequency_hz / 3)
print(f"{quake.name}: {strong.duration:.1f} s of strong motion")
error = fit.half_width_error / fit.half_width
print(f"f_c by the spectrum    {fit.center_frequency_hz:.2f} Hz +- {100 * error:.0f} %")
print(f"f_c by the velocity    {strong.center_frequency_hz:.2f} Hz")
print(f"misfit                 {fit.misfit:.2f}")

rectangular = ss.PoissonPulses.from_earthquake(
    rms_acceleration=fit.rms_acceleration,
    center_frequency_hz=fit.center_frequency_hz,
    duration=strong.duration,
)
shaped = ss.PoissonPulses.from_spectrum(
    spectrum, rate=rectangular.rate, duration=strong.duration, dt=0.01, tolerance=0.01
)

f = np.linspace(0, 4 * fit.center_frequency_hz, 801)
with style():
    figure = Figure(figsize=(7, 3.4), layout="constrained")
    left, right = figure.subplots(1, 2, width_ratios=(3, 2))
    left.fill_between(f, spectrum(2 * np.pi * f), color="#c9c9c9", linewidth=0, label="record")
    left.plot(f, shaped.density(2 * np.pi * f), "--", label="pulse by its spectrum")
    left.plot(f, rectangular.density(2 * np.pi * f), label="rectangular pulses")
    left.set(xlabel="frequency [Hz]", ylabel="spectral density [m²/s³]")
    left.set(xlim=(0, f[-1]), ylim=(0, None), title=quake.name)
    left.legend()
    for pulses, dashes in ((shaped, "--"), (rectangular, "-")):
        times, values = pulses.shape
        right.stairs(
            pulses.sigma * values,
            pulses.half_width * times,
            baseline=None,
            linestyle=dashes,
            color=f"C{int(pulses is rectangular)}",
        )
    right.set(xlabel="time [s]", ylabel="rms acceleration of a pulse [m/s²]")
    right.set_xlim(0, 12 * rectangular.half_width)
args.out.mkdir(parents=True, exist_ok=True)
print("wrote", save(figure, args.out / "09_pulses_of_a_record.png"))
