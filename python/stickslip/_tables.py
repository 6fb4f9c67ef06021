"""Tables for pandas, CSV files, JSON and notebooks; what a notebook shows of ensembles.

Names of columns follow one rule everywhere. A column is a plain identifier without a unit, such as
`peak` or `ground_acceleration`, in a DataFrame, a Dataset and JSON alike, so that `frame.peak` and
`frame.query("peak > 0.1")` work. Units are in `frame.attrs["units"]`, a dict by name; in the
attribute `units` of each variable of a Dataset; and in `units` of a JSON object. A CSV file has no
other place for them than its head: there a name is followed by its unit, `peak [m]`. Quantities
without a dimension have no entry and no brackets.
"""

from __future__ import annotations

import html
import json
import math
import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ._core import (
    Ensemble,
    Estimate,
    Interval,
    number_list,
    number_texts,
)
from ._files import replacing
from ._optional import optional
from ._text import no_formula

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = [
    "Columns",
    "Repeated",
    "cell",
    "ensemble_html",
    "frame_of",
    "heading",
    "html_table",
    "impact_probabilities",
    "json_text",
    "length_of",
    "write_csv",
]


class Repeated(NamedTuple):
    """A column in which many rows repeat few values; of texts, a `category` in pandas."""

    values: NDArray[Any]
    places: NDArray[np.intp]  # of the value of each row


Columns = Mapping[str, "NDArray[Any] | Repeated"]


def heading(name: str, unit: str = "") -> str:
    """The head of a column of a CSV file: the name and, in brackets, the unit."""
    return f"{name} [{unit}]" if unit else name


def frame_of(columns: Columns, units: Mapping[str, str], who: str, index: str | None = None) -> Any:
    """A pandas DataFrame of columns, with the units in `attrs`.

    Parameters
    ----------
    columns : mapping of str to ndarray or Repeated
        By name: a plain identifier without a unit.
    units : mapping of str to str
        By name; names that are not among the columns, and empty units, are left out.
    who : str
        The function that needs pandas, for the message if it is missing.
    index : str, optional
        The column that is the index; default: the rows are counted.
    """
    pandas = optional("pandas", "tables", who)

    def column(given: NDArray[Any] | Repeated) -> Any:
        if not isinstance(given, Repeated):
            return given
        if given.values.dtype.kind != "U":
            return given.values[given.places]
        texts, inverse = np.unique(given.values, return_inverse=True)
        return pandas.Categorical.from_codes(inverse[given.places], texts.astype(object))

    frame = pandas.DataFrame({name: column(given) for name, given in columns.items()})
    frame.attrs["units"] = {name: units[name] for name in columns if units.get(name)}
    return frame if index is None else frame.set_index(index)


def write_csv(columns: Columns, units: Mapping[str, str], file: str | os.PathLike[str]) -> Path:
    """Write columns to a CSV file, which replaces another one whole or not at all.

    Numbers read back to the same double; truth values are 1 and 0. Texts that a spreadsheet would
    take for formulas have an apostrophe before them.

    Parameters
    ----------
    columns, units
        As for `frame_of`.

    Raises
    ------
    OSError
        The file cannot be written.
    """
    with replacing(file) as stream:
        heads = [cell(heading(name, units.get(name, ""))) for name in columns]
        stream.write((",".join(heads) + "\n").encode())
        texts = [
            [cell(one) for one in column.values.tolist()] if isinstance(column, Repeated) else None
            for column in columns.values()
        ]
        for begin in range(0, length_of(columns), 4096):
            cells: list[Iterable[str]] = []
            for column, known in zip(columns.values(), texts):
                if isinstance(column, Repeated):
                    assert known is not None
                    cells.append(
                        map(known.__getitem__, column.places[begin : begin + 4096].tolist())
                    )
                    continue
                part = column[begin : begin + 4096]
                if part.dtype == np.float64:
                    cells.append(number_texts(part))
                    continue
                plain = part.dtype.kind in "iuf"  # no cell that would need quotation marks
                cells.append(map(repr if plain else cell, part.tolist()))
            rows = map(",".join, zip(*cells))
            stream.write(("\n".join(rows) + "\n").encode())
    return Path(os.fsdecode(file))


def length_of(columns: Columns) -> int:
    """The number of rows."""
    return max(
        (len(c.places if isinstance(c, Repeated) else c) for c in columns.values()), default=0
    )


def cell(value: Any) -> str:
    """A value as a cell of a CSV file."""
    if isinstance(value, bool):
        return str(int(value))
    if not isinstance(value, str):
        return repr(value)
    value = no_formula(value)
    if not any(mark in value for mark in ',"\r\n'):
        return value
    doubled = value.replace('"', '""')
    return f'"{doubled}"'


def json_text(document: Any) -> str:
    """A document as JSON: exact doubles, arrays as lists, null for NaN and infinity.

    A structured array is a list of objects.
    """
    if isinstance(document, np.ndarray) and document.dtype.names:
        names = document.dtype.names
        text = "{" + ", ".join(f"{json.dumps(name)}: %s" for name in names) + "}"
        rows = zip(*(_texts_of(document[name]) for name in names))
        return "[" + ", ".join(text % row for row in rows) + "]"
    if isinstance(document, np.ndarray) and document.ndim < 2:
        if document.ndim == 1 and document.dtype == np.float64:
            return number_list(document)
        document = document.tolist()
    if isinstance(document, float) and not math.isfinite(document):
        return "null"
    try:
        return json.dumps(document, allow_nan=False)
    except (TypeError, ValueError):  # it holds arrays, or numbers that are null
        if isinstance(document, dict):
            pairs = (f"{json.dumps(name)}: {json_text(one)}" for name, one in document.items())
            return "{" + ", ".join(pairs) + "}"
        if isinstance(document, (list, tuple, np.ndarray)):
            return "[" + ", ".join(map(json_text, document)) + "]"
        raise


def _texts_of(column: NDArray[Any]) -> list[str]:
    """The values of a column as JSON."""
    if column.ndim > 1:
        parts = [_texts_of(column[:, i]) for i in range(column.shape[1])]
        return ["[" + ", ".join(values) + "]" for values in zip(*parts)]
    if column.dtype != np.float64:
        known = {value: json.dumps(value) for value in set(column.tolist())}
        return [known[value] for value in column.tolist()]
    texts = number_texts(column)
    for i in np.flatnonzero(~np.isfinite(column)):
        texts[i] = "null"
    return texts


def impact_probabilities(ensemble: Ensemble) -> dict[str, Interval]:
    """The probabilities of impact that exist, by name of their attribute."""
    found = {}
    for name in ("impact_probability", "impact_probability_forward", "impact_probability_backward"):
        try:
            found[name] = getattr(ensemble, name)
        except ValueError:  # no stop there
            continue
    return found


def ensemble_remark(ensemble: Ensemble) -> str:
    """A sentence about limits of an ensemble; see `Ensemble.remark`."""
    excitation: Any = ensemble.configuration.get("excitation")
    while isinstance(excitation, dict) and "horizontal" in excitation:
        excitation = excitation["horizontal"]
    if not isinstance(excitation, dict) or excitation.get("zero_frequency") is not False:
        return ""
    spectrum = excitation["spectrum"]
    reaches_zero = {
        "white": True,
        "kanai_tajimi": True,
        "band_pass": spectrum.get("low") == 0,
        "table": spectrum.get("omega", [1])[0] == 0 and spectrum.get("density", [0])[0] > 0,
    }
    returns = excitation["envelope"] is None and excitation["period"] <= excitation["samples"]
    if not (returns and reaches_zero.get(spectrum["kind"], False)):
        return ""
    return (
        "the motions have no line at zero frequency (zero_frequency is False): ground velocities"
        " return to where they began, and displacements drift less than under the spectrum"
    )


def ensemble_html(ensemble: Ensemble) -> str:
    """A table of the main statistics of an ensemble."""
    members = ensemble.members
    rows = [("members", f"{members:,}"), ("seed", str(ensemble.configuration.get("seed", "")))]
    if members > 1:
        for p, name in ((0.5, "median"), (0.84, "84 %"), (0.95, "95 %")):
            rows.append((f"peak displacement, {name}", _of_interval(ensemble.quantile(p))))
        for attribute, interval in impact_probabilities(ensemble).items():
            side = attribute.removeprefix("impact_probability").replace("_", " ")
            rows.append((f"probability of an impact{side}", _of_interval(interval, "")))
        if ensemble.airborne:
            rows.append(("members in flight at the end", f"{ensemble.airborne:,}"))
        if ensemble.time.size and not ensemble.in_plane:
            s = ensemble.stationary
            rows.append(("variance of x'", _of_estimate(s.velocity_variance, "m²/s²")))
            rows.append(("growth of the variance of x", _of_estimate(s.growth_rate, "m²/s")))
            rows += [("remark", one) for one in (s.remark, ensemble.remark) if one]
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


def _of_interval(interval: Interval, unit: str = " m") -> str:
    high = f"{interval.high:.3g}" if np.isfinite(interval.high) else "∞"
    return f"{interval.value:.4g}{unit} (95 % confidence: {interval.low:.3g} to {high})"


def _of_estimate(estimate: Estimate, unit: str) -> str:
    return f"{estimate.value:.4g} ± {estimate.error:.2g} {unit}"
