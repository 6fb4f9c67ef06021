"""Tables for notebooks, of objects that hold a few numbers."""

from __future__ import annotations

import numpy as np

from ._core import (
    STANDARD_GRAVITY,
    Energy,
    GroundMotion,
    Interval,
    ResponseSpectrum,
    StrongMotion,
)
from ._tables import html_table
from ._text import printable
from .motions.tables import SPECTRUM_UNITS

__all__ = ["energy_html", "interval_html", "motion_html", "spectrum_html", "strong_motion_html"]


def _with_unit(value: float, unit: str) -> str:
    """Four significant digits, with the exponents of the unit as superscripts."""
    number = f"{value:.4g}".replace("-", "\N{MINUS SIGN}")
    return f"{number} {unit.replace('^2', chr(0xB2))}".rstrip()


def _acceleration(value: float) -> str:
    return f"{_with_unit(value, 'm/s^2')} ({_with_unit(value / STANDARD_GRAVITY, 'g')})"


def energy_html(energy: Energy) -> str:
    """The energy balance of a response; see `Energy`."""
    names = ("initial", "input", "dissipated", "damped", "impact", "kinetic", "elastic")
    rows = [(name, _with_unit(getattr(energy, name), "m^2/s^2")) for name in names]
    rows.append(("imbalance (round-off)", f"{energy.imbalance:.1g} m\xb2/s\xb2"))
    return html_table("Energy per unit mass", [], rows)


def interval_html(interval: Interval) -> str:
    """A value and its confidence bounds; see `Interval`."""
    value, low, high = (_with_unit(number, "") for number in interval)
    return html_table("Interval", [], [("value", value), ("confidence bounds", f"{low} to {high}")])


def motion_html(motion: GroundMotion) -> str:
    """The main properties of a ground motion; see `GroundMotion`."""
    step = "uneven times" if motion.dt is None else f"dt = {_with_unit(motion.dt, 's')}"
    others = [name for name in ("transverse", "vertical") if getattr(motion, name) is not None]
    rows = [
        ("peak acceleration (PGA)", _acceleration(motion.peak_acceleration)),
        ("duration", _with_unit(motion.duration, "s")),
        ("samples", f"{len(motion):,}, {step}"),
        ("between samples", motion.interpolation),
    ]
    if motion.orientation:
        rows.append(("orientation", printable(motion.orientation)))
    if others:
        rows.append(("other components", ", ".join(others)))
    return html_table(f"Ground motion {printable(motion.name)}".rstrip(), [], rows)


def strong_motion_html(measures: StrongMotion) -> str:
    """The intensity measures of a record; see `StrongMotion`."""
    span = f"{_with_unit(measures.begin, '')} to {_with_unit(measures.end, 's')}"
    rows = [
        ("PGA", _acceleration(measures.peak_acceleration)),
        ("PGV", _with_unit(measures.peak_velocity, "m/s")),
        ("PGD", _with_unit(measures.peak_displacement, "m")),
        ("CAV", _with_unit(measures.cumulative_absolute_velocity, "m/s")),
        ("Arias intensity", _with_unit(measures.arias_intensity, "m/s")),
        ("mean period", _with_unit(measures.mean_period, "s")),
        ("duration D5-95", f"{_with_unit(measures.duration, 's')}, from {span}"),
        ("duration D5-75", _with_unit(measures.duration_5_75, "s")),
        ("rms acceleration from 5 to 95 %", _acceleration(measures.rms_acceleration)),
        ("rms velocity from 5 to 95 %", _with_unit(measures.rms_velocity, "m/s")),
        ("center frequency", _with_unit(measures.center_frequency_hz, "Hz")),
    ]
    return html_table("Intensity measures", [], rows)


def spectrum_html(spectrum: ResponseSpectrum) -> str:
    """The maximum of a response spectrum for each damping ratio; see `ResponseSpectrum`."""
    periods, unit = spectrum.periods, SPECTRUM_UNITS[spectrum.kind]
    rows = []
    for zeta, values in zip(spectrum.damping, np.atleast_2d(spectrum.values)):
        at, value = periods[values.argmax()], float(values.max())
        in_g = f" ({_with_unit(value / STANDARD_GRAVITY, 'g')})" if unit == "m/s^2" else ""
        rows.append((f"{100 * zeta:.4g} %", _with_unit(value, unit) + in_g, _with_unit(at, "s")))
    title = f"{spectrum.kind.replace('_', '-')}, {len(periods):,} periods"
    if len(periods) > 1:
        title += f" from {_with_unit(periods.min(), '')} to {_with_unit(periods.max(), 's')}"
    return html_table(f"Response spectrum: {title}", ["damping", "maximum", "period"], rows)
