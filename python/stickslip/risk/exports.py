"""Fragility curves in the formats of pelicun and OpenQuake."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING
from xml.etree import ElementTree

import numpy as np

from .._files import replacing
from .._tables import cell

if TYPE_CHECKING:
    from .fragility import Fragility

__all__ = ["to_openquake", "to_pelicun"]

_NRML = "http://openquake.org/xmlns/nrml/0.5"
# Name and unit of pelicun.
_PELICUN = {
    "pga_g": ("Peak Ground Acceleration", "g"),
    "pgv": ("Peak Ground Velocity", "mps"),
    "sa_g": ("Spectral Acceleration", "g"),
}
# Name of OpenQuake, and its unit in ours: velocities are in cm/s, CAV in g s.
_OPENQUAKE = {
    "pga_g": ("PGA", 1.0),
    "pgv": ("PGV", 100.0),
    "sa_g": ("SA", 1.0),
    "arias": ("IA", 1.0),
    "cav": ("CAV", 1 / 9.80665),
}


def to_pelicun(fragility: Fragility, path: str | os.PathLike[str], id: str) -> Path:
    """See `Fragility.to_pelicun`."""
    if fragility.method != "lognormal":
        raise ValueError(
            "Fragility.to_pelicun: writes lognormal curves; fit with method='lognormal', got"
            f" {fragility.method!r}"
        )
    if fragility.im not in _PELICUN:
        raise ValueError(
            f"Fragility.to_pelicun: im must be {_names(_PELICUN)}, got {fragility.im!r}"
        )
    demand, unit = _PELICUN[fragility.im]
    if fragility.im == "sa_g":
        demand += f"|{_period(fragility, 'to_pelicun')}"
    heads = ["ID", "Demand-Type", "Demand-Unit", "Demand-Directional", "Demand-Offset"]
    # Directional: of the component of the records, without the factor of 1.2 for any direction.
    row = [id, demand, unit, "1", "0"]
    for i, (median, beta) in enumerate(zip(fragility.median, fragility.beta), 1):
        heads += [f"LS{i}-{name}" for name in ("Family", "Theta_0", "Theta_1")]
        row += ["lognormal", repr(float(median)), repr(float(beta))]
    note = _note(fragility)
    if note:
        heads.append("Comment")
        row.append(note)
    with replacing(path) as stream:
        stream.write(f"{','.join(heads)}\n{','.join(map(cell, row))}\n".encode())
    return Path(os.fsdecode(path))


def to_openquake(fragility: Fragility, path: str | os.PathLike[str], id: str) -> Path:
    """See `Fragility.to_openquake`."""
    if fragility.im not in _OPENQUAKE:
        raise ValueError(
            f"Fragility.to_openquake: im must be {_names(_OPENQUAKE)}, got {fragility.im!r}"
        )
    imt, factor = _OPENQUAKE[fragility.im]
    if imt == "SA":
        imt = f"SA({_period(fragility, 'to_openquake'):g})"
    # Names may have no point: 0p05_m.
    states = [label.replace(" ", "_").replace(".", "p") for label in fragility.labels]
    root = ElementTree.Element("nrml", {"xmlns": _NRML})
    about = {"id": id, "assetCategory": "contents", "lossCategory": "contents"}
    model = ElementTree.SubElement(root, "fragilityModel", about)
    about_it = f"stickslip: {fragility.quantity} by {fragility._measure()}"
    note = _note(fragility)
    ElementTree.SubElement(model, "description").text = about_it + (f"; {note}" if note else "")
    ElementTree.SubElement(model, "limitStates").text = " ".join(states)
    im = fragility.grid()
    if fragility.method == "lognormal":
        kind = {"id": id, "format": "continuous", "shape": "logncdf"}
        function = ElementTree.SubElement(model, "fragilityFunction", kind)
        ends = {"minIML": repr(float(im[0] * factor)), "maxIML": repr(float(im[-1] * factor))}
        ElementTree.SubElement(function, "imls", {"imt": imt, **ends})
        for state, median, beta in zip(states, fragility.median * factor, fragility.beta):
            # Mean and deviation of the intensity itself, not of its logarithm.
            mean = float(median) * math.exp(float(beta) ** 2 / 2)
            deviation = mean * math.sqrt(math.expm1(float(beta) ** 2))
            what = {"ls": state, "mean": repr(mean), "stddev": repr(deviation)}
            ElementTree.SubElement(function, "params", what)
    else:
        function = ElementTree.SubElement(
            model, "fragilityFunction", {"id": id, "format": "discrete"}
        )
        ElementTree.SubElement(function, "imls", {"imt": imt}).text = _numbers(im * factor)
        for state, row in zip(states, fragility.probability(im)):
            ElementTree.SubElement(function, "poes", {"ls": state}).text = _numbers(row)
    ElementTree.indent(root)
    with replacing(path) as stream:
        stream.write(ElementTree.tostring(root, encoding="utf-8", xml_declaration=True) + b"\n")
    return Path(os.fsdecode(path))


def _names(known: Iterable[str]) -> str:
    """What `im` of `Fragility.fit` may be, as in a sentence."""
    *first, last = ("sa(1.0)" if name == "sa_g" else name for name in known)
    return f"{', '.join(first)} or {last}"


def _note(fragility: Fragility) -> str:
    outside = fragility._outside()
    return f"extrapolated: {outside}" if outside else ""


def _period(fragility: Fragility, who: str) -> float:
    if fragility.im_period is None:
        raise ValueError(
            f"Fragility.{who}: the period of the column sa_g is unknown; fit by im='sa(1.0)', or"
            " give the suite a column sa_period, as stripes(sa_g=..., period=...) does"
        )
    return fragility.im_period


def _numbers(values: np.ndarray) -> str:
    return " ".join(repr(float(value)) for value in values)
