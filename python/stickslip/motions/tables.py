"""Tables of ground motions, their intensity measures and response spectra."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .._core import GroundMotion, ResponseSpectrum, StrongMotion, build_info
from .._tables import frame_of, json_text, write_csv

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = [
    "MEASURES",
    "SPECTRUM_UNITS",
    "motion_to_csv",
    "motion_to_dataframe",
    "motion_to_json",
    "spectrum_to_csv",
    "spectrum_to_dataframe",
    "spectrum_to_json",
    "strong_motion_to_csv",
    "strong_motion_to_dataframe",
    "strong_motion_to_json",
]

_MOTION_UNITS = {
    "time": "s",
    "acceleration": "m/s^2",
    "transverse": "m/s^2",
    "vertical": "m/s^2",
    "velocity": "m/s",
    "displacement": "m",
}

MEASURES = {
    "peak_acceleration": "m/s^2",
    "peak_velocity": "m/s",
    "peak_displacement": "m",
    "cumulative_absolute_velocity": "m/s",
    "arias_intensity": "m/s",
    "mean_period": "s",
    "begin": "s",
    "end": "s",
    "duration": "s",
    "duration_5_75": "s",
    "rms_acceleration": "m/s^2",
    "rms_velocity": "m/s",
    "center_frequency_hz": "Hz",
}

SPECTRUM_UNITS = {
    "pseudo_acceleration": "m/s^2",
    "pseudo_velocity": "m/s",
    "displacement": "m",
    "velocity": "m/s",
    "acceleration": "m/s^2",
}


def _components(motion: GroundMotion) -> dict[str, NDArray[Any]]:
    """Times and accelerations: copies, of the components that the motion has."""
    columns = {"time": motion.time, "acceleration": np.array(motion.acceleration)}
    for name, samples in (("transverse", motion.transverse), ("vertical", motion.vertical)):
        if samples is not None:
            columns[name] = np.array(samples)
    return columns


def motion_to_dataframe(motion: GroundMotion) -> Any:
    """See `GroundMotion.to_dataframe`."""
    columns = {
        **_components(motion),
        "velocity": motion.velocity,
        "displacement": motion.displacement,
    }
    return frame_of(columns, _MOTION_UNITS, "GroundMotion.to_dataframe", index="time")


def motion_to_csv(motion: GroundMotion, path: str | os.PathLike[str]) -> Path:
    """See `GroundMotion.to_csv`."""
    return write_csv(_components(motion), _MOTION_UNITS, path)


def motion_to_json(motion: GroundMotion) -> str:
    """See `GroundMotion.to_json`."""
    columns = _components(motion)
    return json_text(
        {
            "stickslip": build_info()["version"],
            "name": motion.name,
            "orientation": motion.orientation,
            "interpolation": motion.interpolation,
            "units": {name: _MOTION_UNITS[name] for name in columns},
            **columns,
        }
    )


def _measures(measures: StrongMotion) -> dict[str, float]:
    return {name: getattr(measures, name) for name in MEASURES}


def strong_motion_to_dataframe(measures: StrongMotion) -> Any:
    """See `StrongMotion.to_dataframe`."""
    columns = {name: np.array([value]) for name, value in _measures(measures).items()}
    return frame_of(columns, MEASURES, "StrongMotion.to_dataframe")


def strong_motion_to_csv(measures: StrongMotion, path: str | os.PathLike[str]) -> Path:
    """See `StrongMotion.to_csv`."""
    columns = {name: np.array([value]) for name, value in _measures(measures).items()}
    return write_csv(columns, MEASURES, path)


def strong_motion_to_json(measures: StrongMotion) -> str:
    """See `StrongMotion.to_json`."""
    return json_text(
        {"stickslip": build_info()["version"], "units": MEASURES, **_measures(measures)}
    )


def _spectrum(spectrum: ResponseSpectrum) -> tuple[dict[str, NDArray[Any]], dict[str, str]]:
    """A row for each damping ratio and period, and the units."""
    columns = {
        "period": np.tile(spectrum.periods, len(spectrum.damping)),
        "damping": np.repeat(spectrum.damping, len(spectrum.periods)),
        spectrum.kind: np.array(spectrum.values).ravel(),
    }
    return columns, {"period": "s", spectrum.kind: SPECTRUM_UNITS[spectrum.kind]}


def spectrum_to_dataframe(spectrum: ResponseSpectrum) -> Any:
    """See `ResponseSpectrum.to_dataframe`."""
    return frame_of(*_spectrum(spectrum), "ResponseSpectrum.to_dataframe")


def spectrum_to_csv(spectrum: ResponseSpectrum, path: str | os.PathLike[str]) -> Path:
    """See `ResponseSpectrum.to_csv`."""
    return write_csv(*_spectrum(spectrum), path)


def spectrum_to_json(spectrum: ResponseSpectrum) -> str:
    """See `ResponseSpectrum.to_json`."""
    return json_text(
        {
            "stickslip": build_info()["version"],
            "kind": spectrum.kind,
            "units": {"period": "s", "values": SPECTRUM_UNITS[spectrum.kind]},
            "period": spectrum.periods,
            "damping": spectrum.damping,
            "values": np.atleast_2d(spectrum.values),
        }
    )
