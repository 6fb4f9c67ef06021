"""Ensembles as tables: pandas, xarray, CSV and JSON."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._core import Ensemble, Interval, build_info
from .._optional import optional
from .._tables import frame_of, impact_probabilities, json_text, write_csv

# Name, unit, description.
_BY_MEMBER = (
    ("peak", "m", "largest displacement over all time"),
    ("residual", "m", "displacement at the end"),
)
_IMPACTS = (
    ("impacts_forward", "", "number of impacts on the stop forward"),
    ("impact_speed_forward", "m/s", "largest speed just before an impact forward"),
    ("impacts_backward", "", "number of impacts on the stop backward"),
    ("impact_speed_backward", "m/s", "largest speed just before an impact backward"),
)
# Of structures alone.
_BASE = (
    ("peak_base_acceleration", "m/s^2", "largest absolute acceleration of the base"),
    ("peak_base_shear", "", "largest base shear"),
)
_FLOORS = (
    ("peak_acceleration", "m/s^2", "largest absolute acceleration"),
    ("peak_drift", "m", "largest drift"),
)
# Of sliders in the plane alone.
_COVARIANCES = (
    ("displacement_covariance", "m^2", "covariance of the components of r"),
    ("velocity_covariance", "m^2/s^2", "covariance of the components of r'"),
)
_COMPONENTS = ("axis", "transverse")
_BY_TIME = (
    ("displacement_mean", "m", "mean of x"),
    ("displacement_variance", "m^2", "variance of x"),
    ("covariance", "m^2/s", "covariance of x and x'"),
    ("velocity_mean", "m/s", "mean of x'"),
    ("velocity_variance", "m^2/s^2", "variance of x'"),
)
_GROUND = (
    ("ground_acceleration_mean", "m/s^2", "mean of the ground acceleration"),
    ("ground_acceleration_variance", "m^2/s^4", "variance of the ground acceleration"),
)
_ABOUT = {
    name: (unit, what)
    for name, unit, what in (
        *_BY_MEMBER,
        *_IMPACTS,
        *_BASE,
        *(
            one
            for name, unit, what in (*_BY_TIME, *_COVARIANCES, *_GROUND)
            for one in ((name, unit, what), (f"{name}_error", unit, f"standard error, {what}"))
        ),
        ("time", "s", "time"),
        ("member", "", "number of the member"),
    )
}
_ABOUT |= {
    f"{name}_{component}": (unit, f"{what}, {component} component")
    for name, (unit, what) in _ABOUT.items()
    for component in _COMPONENTS
    if name.removesuffix("_error") in ("residual", *(name for name, _, _ in _BY_TIME))
}
_UNITS = {name: unit for name, (unit, _) in _ABOUT.items() if unit}
_PROBABILITIES = (0.05, 0.16, 0.5, 0.84, 0.95, 0.99)


def to_dataframe(ensemble: Ensemble, by: str = "member") -> Any:
    """Implementation of `Ensemble.to_dataframe` (see there)."""
    columns = _columns(ensemble, by)
    return frame_of(columns, _units(columns), "Ensemble.to_dataframe", index=by)


def to_csv(ensemble: Ensemble, path: str | os.PathLike[str], by: str = "member") -> Path:
    """Implementation of `Ensemble.to_csv` (see there)."""
    columns = _columns(ensemble, by)
    return write_csv(columns, _units(columns), path)


def to_xarray(ensemble: Ensemble) -> Any:
    """Implementation of `Ensemble.to_xarray` (see there)."""
    xarray = optional("xarray", "tables", "Ensemble.to_xarray")
    variables = {
        name: (by, column, _attributes(name))
        for by in _forms(ensemble)
        for name, column in _columns(ensemble, by).items()
    }
    coordinates = {by: variables.pop(by) for by in _forms(ensemble)}
    about = {"configuration": json.dumps(ensemble.configuration), "airborne": ensemble.airborne}
    return xarray.Dataset(variables, coordinates, about)


def to_json(ensemble: Ensemble) -> str:
    """Implementation of `Ensemble.to_json` (see there)."""
    several = ensemble.members > 1
    tables = {f"by_{by}": _columns(ensemble, by) for by in _forms(ensemble)}
    document: dict[str, Any] = {
        "stickslip": build_info()["version"],
        "configuration": ensemble.configuration,
        "members": ensemble.members,
        "airborne": ensemble.airborne,
        "units": _units(name for columns in tables.values() for name in columns),
        "quantiles": [
            {"probability": p, **_bounds(ensemble.quantile(p))} for p in _PROBABILITIES if several
        ],
    }
    if several:
        document |= {name: _bounds(one) for name, one in impact_probabilities(ensemble).items()}
    return json_text(document | tables)


def _forms(ensemble: Ensemble) -> list[str]:
    """The tables that exist; single members are not kept if there are very many."""
    forms = ["time"] if ensemble.time.size and ensemble.members > 1 else []
    try:
        _ = ensemble.peak
    except ValueError:
        return forms
    return ["member", *forms]


def _columns(ensemble: Ensemble, by: str) -> dict[str, NDArray[Any]]:
    if by == "member":
        numbers = [np.arange(*ends) for ends in ensemble.member_ranges]
        columns = {"member": np.concatenate([np.zeros(0, int), *numbers])}
        names = [name for name, _, _ in _BY_MEMBER]
        try:
            _ = ensemble.impacts_forward
            names += [name for name, _, _ in _IMPACTS]
        except ValueError:  # no stops, or not kept
            pass
        names += [name for name, _, _ in _BASE if ensemble.has_floors]
    elif by == "time":
        columns = {"time": ensemble.time}
        with_ground = ensemble.configuration.get("ground_acceleration", False)
        covariances = _COVARIANCES if ensemble.in_plane else ()
        statistics = (*_BY_TIME, *covariances, *(_GROUND if with_ground else ()))
        names = [n for name, _, _ in statistics for n in (name, f"{name}_error")]
    else:
        raise ValueError(f"Ensemble: by must be 'member' or 'time', got {by!r}")
    for name in names:
        values = np.array(getattr(ensemble, name))
        if values.ndim == 1:
            columns[name] = values
        else:  # in the plane
            columns |= {f"{name}_{one}": values[:, i] for i, one in enumerate(_COMPONENTS)}
    if by == "member" and ensemble.has_floors:
        peaks = {"peak_acceleration": ensemble.peak_floor_acceleration.values}
        with suppress(ValueError):  # no floor is above another
            peaks["peak_drift"] = ensemble.peak_floor_drift.values
        for i in range(peaks["peak_acceleration"].shape[1]):
            columns |= {f"floor_{i + 1}_{name}": values[:, i] for name, values in peaks.items()}
    return columns


def _unit_and_what(name: str) -> tuple[str, str]:
    if name.startswith("floor_"):
        _, floor, statistic = name.split("_", 2)
        for known, unit, what in _FLOORS:
            if known == statistic:
                return unit, f"{what}, floor {floor}"
    return _ABOUT[name]


def _units(columns: Iterable[str]) -> dict[str, str]:
    return _UNITS | {name: _unit_and_what(name)[0] for name in columns if name.startswith("floor_")}


def _attributes(name: str) -> dict[str, str]:
    unit, what = _unit_and_what(name)
    return {"long_name": what} | ({"units": unit} if unit else {})


def _bounds(interval: Interval) -> dict[str, float]:
    return dict(zip(("value", "low", "high"), interval))
