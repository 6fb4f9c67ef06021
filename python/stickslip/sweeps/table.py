"""The table of results of a sweep."""

from __future__ import annotations

import csv
import io
import json
import math
import os
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._core import STANDARD_GRAVITY, Coulomb
from .._files import replacing
from .._hdf5 import as_column, creating, opening, read_columns, read_texts, write_columns
from .._optional import optional
from .._tables import json_text
from ..ensemble.sources import AnySlider

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import FigureBase

__all__ = ["SweepFailure", "SweepTable"]

_FORMAT = "stickslip sweep table 1"
QUANTITIES = {
    "peak": ("peak", "m", "largest displacement over all time"),
    "residual": ("residual", "m", "displacement at the end"),
    "sliding_distance": ("sliding distance", "m", "length of the path slid"),
    "events": ("events", "", "breakaways, reversals and arrests"),
}


class SweepFailure(NamedTuple):
    """A combination without a result, and why."""

    slider: int
    record: int
    polarity: str
    message: str


class SweepTable:
    """Responses of many sliders to many ground motions, as `sweep` returns them.

    Arrays have the shape (sliders, records, polarities). Values are NaN (`events`: 0) where a
    combination failed.

    Attributes
    ----------
    peak : ndarray
        Largest |x| over all time [m].
    residual : ndarray
        x at the end [m]; final if the slider rests.
    sliding_distance : ndarray
        Length of the path slid [m].
    events : ndarray of int
        Breakaways, reversals and arrests.
    sliders : tuple of str
        The reprs of the sliders.
    parameters : dict of ndarray
        By name, the parameters that `grid` varied, for each slider; for a list of Coulomb laws,
        `mu`.
    records : tuple of str
        Names of the ground motions.
    metadata : dict of ndarray
        Columns of the suite, with a value for each record.
    polarity : tuple of str
        'as recorded' and 'flipped', or one of them.
    settle : bool
        Whether the sweep continued until the sliders came to rest.
    contact : {'flight', 'clipped'}
        What sliders do when they lose contact with the ground.
    failures : tuple of SweepFailure
        Combinations that failed.

    Notes
    -----
    Objects compare by content; they can be copied and pickled.
    """

    def __init__(
        self,
        *,
        sliders: Sequence[str],
        parameters: Mapping[str, ArrayLike],
        records: Sequence[str],
        metadata: Mapping[str, ArrayLike],
        polarity: Sequence[str],
        settle: bool,
        contact: str,
        peak: ArrayLike,
        residual: ArrayLike,
        sliding_distance: ArrayLike,
        events: ArrayLike,
        failures: Sequence[SweepFailure] = (),
    ) -> None:
        self.sliders = tuple(sliders)
        self.parameters = {name: as_column(values) for name, values in parameters.items()}
        self.records = tuple(records)
        self.metadata = {name: as_column(values) for name, values in metadata.items()}
        self.polarity = tuple(polarity)
        self.settle = bool(settle)
        self.contact = str(contact)
        self.failures = tuple(SweepFailure(*one) for one in failures)
        self.peak: NDArray[np.float64] = np.array(peak, float)
        self.residual: NDArray[np.float64] = np.array(residual, float)
        self.sliding_distance: NDArray[np.float64] = np.array(sliding_distance, float)
        self.events: NDArray[np.int64] = np.array(events, np.int64)
        shape = (len(self.sliders), len(self.records), len(self.polarity))
        for name in QUANTITIES:
            if getattr(self, name).shape != shape:
                raise ValueError(
                    f"SweepTable: {name} must have shape {shape}, got {getattr(self, name).shape}"
                )
        for columns, length in ((self.parameters, shape[0]), (self.metadata, shape[1])):
            for name, column in columns.items():
                if column.shape != (length,):
                    raise ValueError(
                        f"SweepTable: '{name}' must have {length} values, got {column.size}"
                    )
        self.done = np.isfinite(self.peak).any(axis=(0, 2))

    @classmethod
    def empty(cls, **about: Any) -> SweepTable:
        """A table without results."""
        shape = tuple(len(about[name]) for name in ("sliders", "records", "polarity"))
        nothing = np.full(shape, np.nan)
        return cls(
            **about,
            peak=nothing,
            residual=nothing,
            sliding_distance=nothing,
            events=np.zeros(shape, int),
        )

    def put(self, records: Sequence[int], result: Mapping[str, Any]) -> None:
        """Enter the results for some records."""
        places = list(records)
        for name in QUANTITIES:
            getattr(self, name)[:, places, :] = result[name]
        self.done[places] = True
        failures = [SweepFailure(s, places[r], p, text) for s, r, p, text in result["failures"]]
        self.failures = tuple(sorted((*self.failures, *failures)))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, SweepTable):
            return NotImplemented
        mine, theirs = self.__getstate__(), other.__getstate__()
        return all(_same(mine[name], theirs[name]) for name in mine)

    __hash__ = None  # type: ignore[assignment]  # its arrays can change

    def __getstate__(self) -> dict[str, Any]:
        return dict(self.__dict__)

    def __repr__(self) -> str:
        sliders, records, polarities = self.peak.shape
        return f"SweepTable({sliders} sliders, {records} records, {polarities} polarities)"

    # ---- statistics over records and polarities

    def quantile(self, p: ArrayLike, quantity: str = "peak") -> NDArray[np.float64]:
        """Quantiles of |quantity| over all records and polarities, for each slider.

        Parameters
        ----------
        p : float or array_like
            Probabilities from 0 to 1.
        quantity : {'peak', 'residual', 'sliding_distance'}
            The residual counts by its magnitude.

        Returns
        -------
        ndarray, shape (sliders,) or (probabilities, sliders)
            Quantiles [m], without combinations that failed; NaN where all failed.
        """
        values = np.abs(getattr(self, _checked(quantity))).reshape(len(self.sliders), -1)
        found = [
            np.quantile(row[np.isfinite(row)], p)
            if np.isfinite(row).any()
            else np.full(np.shape(p), np.nan)
            for row in values
        ]
        return np.moveaxis(np.array(found), 0, -1)

    # ---- other forms

    def to_dataframe(self) -> Any:
        """A pandas DataFrame with a row for each combination.

        Returns
        -------
        pandas.DataFrame
            Slider and its parameters, record and its metadata, polarity, peak [m], residual [m],
            sliding distance [m], events.

        Raises
        ------
        ImportError
            pandas is missing.
        """
        return optional("pandas", "tables", "SweepTable.to_dataframe").DataFrame(self._columns())

    def _columns(self) -> dict[str, NDArray[Any]]:
        s, r, p = (index.ravel() for index in np.indices(self.peak.shape))
        columns: dict[str, NDArray[Any]] = {"slider": np.array(self.sliders)[s]}
        columns |= {name: column[s] for name, column in self.parameters.items()}
        columns["record"] = np.array(self.records)[r]
        columns |= {name: column[r] for name, column in self.metadata.items()}
        columns["polarity"] = np.array(self.polarity)[p]
        for name, (heading, unit, _) in QUANTITIES.items():
            columns[f"{heading} [{unit}]" if unit else heading] = getattr(self, name).ravel()
        return columns

    def to_csv(self, file: str | os.PathLike[str]) -> Path:
        """Write the rows of `to_dataframe` to a CSV file.

        Parameters
        ----------
        file : path-like
            Replaced whole or not at all.

        Returns
        -------
        Path

        Raises
        ------
        OSError
            The file cannot be written.
        """
        columns = self._columns()
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(zip(*(column.tolist() for column in columns.values())))
        with replacing(file) as stream:
            stream.write(text.getvalue().encode())
        return Path(file)

    def to_json(self) -> str:
        """The table as one JSON document, for tools on the web.

        Returns
        -------
        str
            An object: `format`; `sliders`, `records`, `polarity`, `settle`, `contact`; `parameters`
            and `metadata`, by name a list with a value for each slider or record; `units` of the
            quantities; `peak`, `residual`, `sliding_distance` and `events`, each a list over
            sliders of lists over records of lists over polarities; `failures`, each with `slider`
            and `record` (counted from 0), `polarity` and `message`.

        Notes
        -----
        Every number reads back to the same double. JSON lacks NaN and infinity: NaN (a combination
        that failed, a number that is not known) is null, infinite parameters and metadata are
        ``"Infinity"`` and ``"-Infinity"``.
        """
        document = {
            "format": _FORMAT,
            "settle": self.settle,
            "contact": self.contact,
            **{name: getattr(self, name) for name in ("sliders", "records", "polarity")},
            **{
                name: {key: _listed(column) for key, column in getattr(self, name).items()}
                for name in ("parameters", "metadata")
            },
            "units": {name: unit for name, (_, unit, _) in QUANTITIES.items() if unit},
            **{name: getattr(self, name) for name in QUANTITIES},
            "failures": [one._asdict() for one in self.failures],
        }
        return json_text(document)

    @classmethod
    def from_json(cls, text: str) -> SweepTable:
        """The table of a JSON document that `to_json` made.

        Parameters
        ----------
        text : str

        Returns
        -------
        SweepTable
            Equal to the one that was written.

        Raises
        ------
        ValueError
            It is no such document.
        """
        try:
            document = json.loads(text)
        except ValueError as error:
            raise ValueError(f"SweepTable.from_json: needs a JSON document: {error}") from None
        found = document.get("format") if isinstance(document, dict) else None
        if found != _FORMAT:
            raise ValueError(
                f"SweepTable.from_json: the document must be of format '{_FORMAT}', got {found!r}"
            )
        try:
            return cls(
                **{name: document[name] for name in ("sliders", "records", "polarity")},
                **{
                    name: {key: _unlisted(values) for key, values in document[name].items()}
                    for name in ("parameters", "metadata")
                },
                **{name: document[name] for name in QUANTITIES},  # float makes NaN of null
                settle=document["settle"],
                contact=document["contact"],
                failures=[
                    SweepFailure(*(one[name] for name in SweepFailure._fields))
                    for one in document["failures"]
                ],
            )
        except KeyError as error:
            raise ValueError(f"SweepTable.from_json: the document lacks {error}") from None
        except (AttributeError, TypeError, ValueError) as error:
            raise ValueError(f"SweepTable.from_json: the document is damaged: {error}") from None

    def to_xarray(self) -> Any:
        """An xarray Dataset over slider, record and polarity.

        Returns
        -------
        xarray.Dataset
            Parameters and metadata are coordinates.

        Raises
        ------
        ImportError
            xarray is missing.
        """
        xarray = optional("xarray", "tables", "SweepTable.to_xarray")
        dimensions = ("slider", "record", "polarity")
        coordinates: dict[str, Any] = {
            "slider": list(self.sliders),
            "record": list(self.records),
            "polarity": list(self.polarity),
        }
        coordinates |= {name: ("slider", column) for name, column in self.parameters.items()}
        coordinates |= {name: ("record", column) for name, column in self.metadata.items()}
        return xarray.Dataset(
            {
                name: (
                    dimensions,
                    getattr(self, name),
                    {"long_name": what} | ({"units": unit} if unit else {}),
                )
                for name, (_, unit, what) in QUANTITIES.items()
            },
            coords=coordinates,
            attrs={"settle": int(self.settle), "contact": self.contact},
        )

    def save(self, file: str | os.PathLike[str]) -> Path:
        """Write the table to an HDF5 file.

        Parameters
        ----------
        file : path-like
            Replaced whole or not at all.

        Returns
        -------
        Path

        Raises
        ------
        ImportError
            h5py is missing: ``pip install stickslip[suites]``.
        OSError
            The file cannot be written.
        """
        with creating(file, _FORMAT, "SweepTable.save") as h5:
            h5.attrs["settle"] = self.settle
            h5.attrs["contact"] = self.contact
            h5.attrs["failures"] = json.dumps([list(one) for one in self.failures])
            for name in ("sliders", "records", "polarity"):
                h5[name] = list(getattr(self, name))
            for name, (_, unit, what) in QUANTITIES.items():
                h5[name] = getattr(self, name)
                h5[name].attrs.update({"units": unit, "long_name": what})
            for name in ("parameters", "metadata"):
                write_columns(h5, name, getattr(self, name))
        return Path(file)

    @classmethod
    def open(cls, file: str | os.PathLike[str]) -> SweepTable:
        """Open a saved table.

        Parameters
        ----------
        file : path-like

        Returns
        -------
        SweepTable
            Equal to the one that was saved.

        Raises
        ------
        ImportError
            h5py is missing: ``pip install stickslip[suites]``.
        OSError
            The file is missing or cannot be read.
        ValueError
            The file is not a table of a sweep, or is damaged.
        """
        with opening(file, _FORMAT, "SweepTable.open") as h5:
            return cls(
                **{name: read_texts(h5[name]) for name in ("sliders", "records", "polarity")},
                **{name: read_columns(h5, name) for name in ("parameters", "metadata")},
                **{name: h5[name][:] for name in QUANTITIES},
                settle=bool(h5.attrs["settle"]),
                contact=h5.attrs["contact"],
                failures=json.loads(h5.attrs["failures"]),
            )

    def plot(
        self,
        quantity: str = "peak",
        *,
        against: str | None = None,
        ax: Axes | None = None,
        title: str | None = None,
    ) -> FigureBase:
        """Plot the median, 16 and 84 % over records and polarities, and each record as a thin line.

        Parameters
        ----------
        quantity : {'peak', 'residual', 'sliding_distance'}
            The residual counts by its magnitude.
        against : str, optional
            The parameter on the horizontal axis; default: the first one with numbers. If others
            vary too, each combination of them has its own median and band, at most six.
        ax : matplotlib Axes, optional
            Where to draw; default: a new figure of 7 x 4.5 inches.
        title : str, optional

        Returns
        -------
        matplotlib Figure

        Raises
        ------
        ValueError
            No parameter with numbers; an unknown quantity or parameter; more than six combinations.
        ImportError
            matplotlib is missing.
        """
        from ..plotting import plot_sweep

        return plot_sweep(self, quantity, against=against, ax=ax, title=title)

    def curves(self, against: str | None = None) -> Iterator[tuple[str, str, NDArray[Any]]]:
        """Groups of sliders that differ in one parameter only, sorted by it.

        Parameters
        ----------
        against : str, optional
            The parameter; default: the first one with numbers.

        Yields
        ------
        name, others, places
            The parameter's name; the values of the others, such as 'period = 2'; the indices of
            the sliders.
        """
        numeric = [n for n, c in self.parameters.items() if c.dtype.kind in "biuf"]
        if against is None and not numeric:
            raise ValueError(
                "SweepTable.curves: needs a parameter with numbers, as in sliders made by grid; the"
                f" parameters are {', '.join(self.parameters) or 'none'}"
            )
        name = numeric[0] if against is None else against
        if name not in numeric:
            raise ValueError(
                f"SweepTable.curves: against must be one of {', '.join(numeric) or 'none'}, got"
                f" {name!r}"
            )
        others = [n for n in self.parameters if n != name]
        groups: dict[tuple[Any, ...], list[int]] = {}
        for i in range(len(self.sliders)):
            groups.setdefault(tuple(self.parameters[n][i] for n in others), []).append(i)
        for values, members in groups.items():
            order = np.argsort(self.parameters[name][members], kind="stable")
            label = ", ".join(
                f"{n} = {v:g}" if isinstance(v, np.number) else f"{n} = {v}"
                for n, v in zip(others, values)
            )
            yield name, label, np.array(members)[order]


def parameters_of(
    sliders: Sequence[AnySlider], given: Mapping[str, Sequence[Any]]
) -> dict[str, Any]:
    """The parameters that `grid` varied; for a list of Coulomb laws, mu."""
    if given or not all(isinstance(one, Coulomb) for one in sliders):
        return dict(given)
    blocks = [one for one in sliders if isinstance(one, Coulomb)]
    return {"mu": [one.slip_level / STANDARD_GRAVITY for one in blocks]}


_INFINITE = {math.inf: "Infinity", -math.inf: "-Infinity"}


def _listed(column: NDArray[Any]) -> list[Any]:
    """The values of a column, infinite ones as text."""
    return [_INFINITE.get(value, value) for value in column.tolist()]


def _unlisted(values: list[Any]) -> list[Any]:
    """The values that `_listed` was given; a column with any other text is of texts."""
    numbers: dict[Any, Any] = {text: number for number, text in _INFINITE.items()}
    if any(isinstance(one, str) and one not in numbers for one in values):
        return values
    return [math.nan if one is None else numbers.get(one, one) for one in values]


def _checked(quantity: str) -> str:
    names = [name for name in QUANTITIES if name != "events"]
    if quantity not in names:
        raise ValueError(
            f"SweepTable: quantity must be one of {', '.join(names)}, got {quantity!r}"
        )
    return quantity


def _same(a: Any, b: Any) -> bool:
    if isinstance(a, dict):
        return a.keys() == b.keys() and all(_same(a[k], b[k]) for k in a)
    if isinstance(a, np.ndarray):
        return np.array_equal(a, b, equal_nan=a.dtype.kind == "f" and b.dtype.kind == "f")
    return bool(a == b)
