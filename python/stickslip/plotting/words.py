"""Sliders, ensembles and numbers as pictures write them."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from .. import _core
from .._core import STANDARD_GRAVITY, Ensemble, EquipmentOnFloor, Estimate, FlexibleSlope

_SURFACES = {2: "double pendulum", 4: "triple pendulum", 6: "quintuple pendulum"}
_OF_LEVELS = {"slip_level", "backward", "reach", "rolling"}  # parts with words of their own


def describe(slider: Any) -> str:
    """A short description of a slider, such as 'slip level 0.06 g, period 3 s'."""
    return ", ".join(in_words(json.loads(_core.identity(slider))))


def describe_system(system: Any) -> str:
    """The same of a structure, such as 'equipment on floor 2 of 3, slip level 0.1 g'."""
    if isinstance(system, FlexibleSlope):
        level = getattr(system.ky_g, "mu", [system.ky_g])[0]
        return (
            f"flexible slope, yield acceleration {digits(level)} g, height"
            f" {digits(system.height)} m, shear velocity {digits(system.shear_velocity)} m/s,"
            f" {system.method}"
        )
    floors = system.structure.floors
    if isinstance(system, EquipmentOnFloor):
        what = f"equipment on floor {system.floor} of {floors}"
    else:
        what = "isolated structure" + (f" of {floors} floor{'s' * (floors > 1)}" if floors else "")
    return f"{what}, {describe(system.slider)}"


def with_remark(text: str, response: Any) -> str:
    """The text, and the remark of a response, if it has one, in a line below."""
    return f"{text}\nremark: {response.remark}" if response.remark else text


def describe_ensemble(ensemble: Ensemble) -> str:
    """A title such as '10,000 members of 60 s, slip level 0.2 g'."""
    configuration, times = ensemble.configuration, ensemble.time
    slider, excitation = configuration["slider"], configuration["excitation"]
    words = [f"{ensemble.members:,} members" + (f" of {times[-1]:.4g} s" if times.size else "")]
    kind = excitation.get("excitation") if isinstance(excitation, dict) else None
    if kind == "WithVertical":
        words.append("vertical motion")
    if not isinstance(slider, dict):  # the configuration of a user-defined source
        pass
    elif "random" in slider:
        words.append("random sliders")
    elif "one_of" in slider:
        words.append(f"{len(slider['one_of'])} sliders")
    elif "law" in slider:
        words += in_words(slider)
    elif "isolated_structure" in slider:
        words += ["isolated structure", *in_words(slider["slider"])]
    elif "equipment_on_floor" in slider:
        floor = slider["equipment_on_floor"]
        words += [f"equipment on floor {floor}", *in_words(slider["slider"])]
    elif "flexible_slope" in slider:
        words.append("flexible slope")
        if "ky_g" in slider:
            words.append(f"yield acceleration {digits(slider['ky_g'])} g")
    return ", ".join(words)


def in_words(slider: Mapping[str, Any]) -> list[str]:
    """The same of its configuration, as ensembles keep it."""
    words = [*_law_in_words(slider)]
    if "reach" in slider:
        words.append(f"caster, reach {digits(slider['reach'] * 100)} cm")
        if "rolling" in slider:
            words.append(f"of it rolling {_in_g(slider['rolling'])}")
    if "damping" in slider:
        words.append(f"viscous damping {digits(slider['damping'])} 1/s")
    if slider.get("natural_frequency"):
        period = f"period {digits(2 * np.pi / slider['natural_frequency'])} s"
        if "pendulum" in slider:
            words.append(f"pendulum, radius {digits(_radius(slider['natural_frequency']))} m")
        words.append(period)
    if "slope_degrees" in slider:
        words.append(f"slope {digits(slider['slope_degrees'])}\N{DEGREE SIGN}")
    if "one_way" in slider:
        words.append("one way")
    if "stops" in slider:
        ahead, back, restitution = slider["stops"]
        places = f"{digits(ahead * 100)} cm" if ahead is not None else ""
        if back != ahead:
            sides = ((ahead, "forward"), (back, "backward"))
            places = ", ".join(f"{digits(d * 100)} cm {side}" for d, side in sides if d)
        words.append(f"stops at {places}, restitution {digits(restitution)}")
    return words


def _radius(natural_frequency: float) -> float:
    """The radius [m] of a pendulum."""
    return float(STANDARD_GRAVITY / natural_frequency**2)


def _law_in_words(law: Mapping[str, Any]) -> Iterator[str]:
    parts = {name: unit for name, _, unit, _ in _core._laws().get(law["law"], [])}
    if isinstance(law.get("static"), list):
        yield from _both_ways("static level", *law["static"])
    if "slow" in law:
        yield f"slip level {_in_g(law['slow'])} slow, {_in_g(law['fast'])} fast"
    elif "kinetic" in law:
        yield f"slip level {_in_g(law['static'])} at rest, {_in_g(law['kinetic'])} fast"
    elif "static_pressure" in law:
        pressure = f"{digits(law['static_pressure'] / 1e6)} MPa"
        yield f"mu {digits(law['mu_ref'])} at reference, {pressure}, heated"
    elif "radii" in law:
        count = len(law["radii"]) + bool(law.get("nested"))
        name = _SURFACES.get(count, f"pendulum of {count} surfaces")
        yield f"{name}, mu {', '.join(digits(mu) for mu in law['mu'])}"
    elif "distances" in law:
        yield f"slip level {_in_g(law['levels'][0])}"
        if len(law["levels"]) > 1:
            length, unit = unit_for(law["distances"][-1])
            distance = f"{digits(law['distances'][-1] * length)} {unit}"
            yield f"{_in_g(law['levels'][-1])} after {distance}"
        if law["backward"] != law["levels"]:
            yield "different backward"
    elif "slip_level" not in law or set(parts) - _OF_LEVELS:
        yield from _parts_in_words(law, parts)
    elif law["slip_level"] == 0 == law.get("backward", 0):
        yield "no friction"
    else:
        yield from _both_ways(
            "slip level", law["slip_level"], law.get("backward", law["slip_level"])
        )


def _parts_in_words(law: Mapping[str, Any], units: Mapping[str, str]) -> Iterator[str]:
    """The parts of a law for which there are no better words."""
    if not units:
        yield "law from functions"
    for name, unit in units.items():
        if isinstance(value := law.get(name), int | float):
            amount = _in_g(value) if unit == "m/s^2" else f"{digits(value)} {unit}".rstrip()
            yield f"{name.replace('_', ' ')} {amount}"


def _both_ways(name: str, ahead: float | None, back: float | None) -> Iterator[str]:
    yield f"{name} {_in_g(ahead)}" + ("" if back in (ahead, None) else " forward")
    if back != ahead:
        yield "never backward" if back is None else f"{_in_g(back)} backward"


def _in_g(level: float | None) -> str:
    return "infinite" if level is None else f"{digits(level / STANDARD_GRAVITY)} g"


def with_error(estimate: Estimate, factor: float) -> str:
    """'12.34 ± 0.21': the error to two digits, the value to the same decimal place."""
    value, error = factor * estimate.value, factor * estimate.error
    if not error > 0:
        return digits(value)
    places = max(0, 1 - int(np.floor(np.log10(error))))
    text = f"{value:.{places}f} \N{PLUS-MINUS SIGN} {error:.{places}f}"
    return text.replace("-", "\N{MINUS SIGN}")


def unit_for(largest: float) -> tuple[float, str]:
    """The number of units in a meter, and the unit, for lengths up to `largest` [m]."""
    return (1e3, "mm") if 0 < largest < 0.01 else (1e2, "cm") if largest < 10 else (1, "m")


def unit_of(length: float) -> str:
    """The unit of which `length` are a meter."""
    return {1e3: "mm", 1e2: "cm", 1: "m"}[length]


def in_places(value: float, peak: float, length: float) -> str:
    """A displacement [m] in units, to three digits, but at most to 1/10,000 of the peak."""
    text = digits(value * length)
    if not peak > 0:
        return text
    places = max(0, 3 - int(np.floor(np.log10(peak * length))))
    if len(text.partition(".")[2]) <= places and "e" not in text:
        return text
    return f"{round(value * length, places) + 0.0:.{places}f}".replace("-", "\N{MINUS SIGN}")


def digits(value: float) -> str:
    """Three significant digits, with a true minus sign."""
    return f"{value:#.3g}".rstrip(".").replace("-", "\N{MINUS SIGN}")
