"""Tables of responses and ensembles: pandas, xarray, CSV files, notebooks."""

from __future__ import annotations

import html
import json
import math
import os
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ._core import Ensemble, Estimate, Interval, Response, build_info
from ._files import replacing
from ._optional import optional
from ._text import printable

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = [
    "ensemble_html",
    "html_table",
    "response_html",
    "to_csv",
    "to_dataframe",
    "to_json",
    "to_xarray",
]

# Name, unit, description.
_HISTORIES = (
    ("ground acceleration", "m/s^2", "ground acceleration"),
    ("displacement", "m", "displacement relative to the ground"),
    ("velocity", "m/s", "velocity relative to the ground"),
    ("acceleration", "m/s^2", "absolute acceleration of the mass"),
    ("friction", "m/s^2", "friction force per unit mass"),
    ("spring", "m/s^2", "spring force per unit mass"),
    ("damper", "m/s^2", "damper force per unit mass"),
    ("force", "m/s^2", "sum of friction, spring and damper force per unit mass"),
    ("stuck", "", "whether the slider sticks"),
)
# Histories beside these where the normal force is not the weight: under vertical motion, the last
# also on a slope.
_LIFTING = (
    ("vertical ground acceleration", "m/s^2", "vertical ground acceleration, positive upward"),
    ("gap", "m", "gap between slider and ground"),
    ("normal force", "m/s^2", "normal force per unit mass"),
)
# Beside these where friction depends on it.
_HEATED = (("temperature", "degC", "temperature of the sliding surface"),)


def _histories(response: Response) -> tuple[tuple[str, str, str], ...]:
    """Name, unit and description of the histories of a response."""
    vertical = "vertical" in response.components
    first = 0 if vertical else 2 if response.slider.slope_degrees > 0 else 3
    heated = () if response.temperature is None else _HEATED
    return (*_HISTORIES[:-1], *_LIFTING[first:], *heated, _HISTORIES[-1])


def to_dataframe(response: Response) -> Any:
    """The histories of a response as a pandas DataFrame; see `Response.to_dataframe`."""
    pandas = optional("pandas", "tables", "Response.to_dataframe")
    index = pandas.Index(response.time, name="time [s]")
    return pandas.DataFrame(
        {_heading(name, unit): _history(response, name) for name, unit, _ in _histories(response)},
        index,
    )


def to_xarray(response: Response) -> Any:
    """The histories of a response as an xarray Dataset; see `Response.to_xarray`."""
    xarray = optional("xarray", "tables", "Response.to_xarray")
    variables = {
        _key(name): (
            "time",
            _history(response, name),
            {"long_name": what} | ({"units": unit} if unit else {}),
        )
        for name, unit, what in _histories(response)
    }
    return xarray.Dataset(
        variables,
        coords={"time": ("time", response.time, {"long_name": "time", "units": "s"})},
        attrs={
            "slider": repr(response.slider),
            "motion": response.motion.name,
            "peak": response.peak,
            "peak_units": "m",
            "residual": response.residual,
            "residual_units": "m",
        },
    )


def to_csv(response: Response, path: str | os.PathLike[str]) -> Path:
    """Write the histories of a response to a file; see `Response.to_csv`."""
    histories = _histories(response)
    names = ["time [s]", *(_heading(name, unit) for name, unit, _ in histories)]
    columns = [response.time, *(_history(response, name) for name, _, _ in histories)]
    columns[-1] = columns[-1].astype(int)
    with replacing(path) as stream:
        stream.write((",".join(names) + "\n").encode())
        for rows in _rows(columns):
            stream.write("".join(",".join(map(repr, row)) + "\n" for row in rows).encode())
    return Path(path)


def to_json(response: Response) -> str:
    """The results and histories of a response as JSON; see `Response.to_json`."""
    events, histories = response.events, _histories(response)
    document = {
        "stickslip": build_info()["version"],
        "slider": repr(response.slider),
        "motion": response.motion.name,
        "components": response.components,
        "contact": response.contact,
        "peak": response.peak,
        "residual": response.residual,
        "sliding_distance": response.sliding_distance,
        "at_rest": response.at_rest,
        "units": {"time": "s"} | {_key(name): unit for name, unit, _ in histories if unit},
        "time": response.time,
        **{_key(name): _history(response, name) for name, _, _ in histories},
        "events": [dict(zip(events.dtype.names or (), row)) for row in events.tolist()],
    }
    return json_text(document)


def json_text(document: Any) -> str:
    """A document as JSON: exact doubles, arrays as lists, null for NaN and infinity."""
    return json.dumps(_plain(document), allow_nan=False)


def _plain(value: Any) -> Any:
    if isinstance(value, dict):
        return {name: _plain(one) for name, one in value.items()}
    if isinstance(value, np.ndarray):
        if value.dtype.kind != "f" or np.isfinite(value).all():
            return value.tolist()
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return [_plain(one) for one in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def response_html(response: Response) -> str:
    """A table of the main results of a response."""
    energy = response.energy
    rows = [
        ("slider", repr(response.slider)),
        ("ground motion", printable(response.motion.name) or repr(response.motion)),
        ("peak displacement", f"{response.peak:.4g} m"),
        (
            "residual displacement" if response.at_rest else "displacement at the end, sliding",
            f"{response.residual:.4g} m",
        ),
        ("sliding distance", f"{response.sliding_distance:.4g} m"),
        ("slips", f"{response.slips:,}"),
        ("time sliding", f"{response.time_sliding:.4g} s"),
        ("dissipated by friction", f"{energy.dissipated:.4g} m²/s²"),
    ]
    if response.slider.damping > 0:
        rows.append(("dissipated by the damper", f"{energy.damped:.4g} m²/s²"))
    if response.slider.stops is not None:
        rows.append(("impacts on stops", f"{len(response.impacts):,}"))
        rows.append(("lost in impacts", f"{energy.impact:.4g} m²/s²"))
    if "vertical" in response.components:
        flights = (response.events["kind"] == "liftoff").sum()
        rows.append(("contact with the ground", f"{response.contact}, {flights:,} flights"))
    try:
        rows.append(("effective period", f"{response.effective_period:.4g} s"))
        rows.append(("effective damping", f"{100 * response.effective_damping:.3g} %"))
    except ValueError:
        pass  # no loop
    return html_table("Response", [], rows)


def ensemble_html(ensemble: Ensemble) -> str:
    """A table of the main statistics of an ensemble."""
    members = ensemble.members
    rows = [("members", f"{members:,}"), ("seed", str(ensemble.configuration.get("seed", "")))]
    if members > 1:
        for p, name in ((0.5, "median"), (0.84, "84 %"), (0.95, "95 %")):
            rows.append((f"peak displacement, {name}", _of_interval(ensemble.quantile(p))))
        if ensemble.time.size:
            s = ensemble.stationary
            rows.append(("variance of x'", _of_estimate(s.velocity_variance, "m²/s²")))
            rows.append(("growth of the variance of x", _of_estimate(s.growth_rate, "m²/s")))
            if s.remark:
                rows.append(("remark", s.remark))
    return html_table("Ensemble", [], rows)


def html_table(title: str, heading: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """An HTML table of texts for a notebook; the first column holds row headings."""

    def row(cells: Sequence[str], tag: str) -> str:
        first, *rest = map(html.escape, cells)
        return (
            f'<tr><th style="text-align: left">{first}</th>'
            + "".join(f'<{tag} style="text-align: left">{cell}</{tag}>' for cell in rest)
            + "</tr>"
        )

    head = f"<thead>{row(heading, 'th')}</thead>" if heading else ""
    body = "".join(row(cells, "td") for cells in rows)
    return f"<table><caption>{html.escape(title)}</caption>{head}<tbody>{body}</tbody></table>"


def _key(name: str) -> str:
    return name.replace(" ", "_")


def _heading(name: str, unit: str) -> str:
    return f"{name} [{unit}]" if unit else name


def _history(response: Response, name: str) -> NDArray[Any]:
    """A writable copy of a history."""
    if name.endswith("ground acceleration"):
        n = np.zeros(response.time.size)
        vertical = name.startswith("vertical")
        motion = response.motion
        n[: len(motion)] = motion.vertical if vertical else motion.acceleration
        return n
    return np.array(getattr(response, _key(name)))


def _rows(columns: Sequence[NDArray[Any]]) -> Iterable[Iterable[tuple[float, ...]]]:
    """Rows of Python numbers, in chunks of a few thousand."""
    for begin in range(0, len(columns[0]), 4096):
        yield zip(*(column[begin : begin + 4096].tolist() for column in columns))


def _of_interval(interval: Interval) -> str:
    high = f"{interval.high:.3g}" if np.isfinite(interval.high) else "∞"
    return f"{interval.value:.4g} m (95 % confidence: {interval.low:.3g} to {high})"


def _of_estimate(estimate: Estimate, unit: str) -> str:
    return f"{estimate.value:.4g} ± {estimate.error:.2g} {unit}"
