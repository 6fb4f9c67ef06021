"""The table of results of a sweep."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._core import STANDARD_GRAVITY, Coulomb, GroundMotion
from .._hdf5 import Saved, as_column, read, write
from .._optional import optional
from .._tables import Columns, json_text
from .._tabular import Tabular, over, same
from .parameter_grid import AnySwept

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["SweepFailure", "SweepTable"]

POLARITIES = ("recorded", "reversed")
_AXES = {"slider": "sliders", "record": "records", "polarity": "polarity"}
QUANTITIES = {
    "peak": ("peak", "m", "largest displacement over all time"),
    "residual": ("residual", "m", "displacement at the end"),
    "sliding_distance": ("sliding distance", "m", "length of the path slid"),
    "events": ("events", "", "breakaways, reversals and arrests"),
}
# These exist only for sliders in the plane, whose `residual` is the length of the vector.
COMPONENTS = {
    "residual_axis": ("residual along the axis", "m", "displacement along the axis at the end"),
    "residual_transverse": (
        "transverse residual",
        "m",
        "displacement along the transverse direction at the end",
    ),
}
# These exist only if a slider has stops.
IMPACTS = {
    "impacts_forward": ("impacts forward", "", "number of impacts on the stop forward"),
    "impact_speed_forward": ("speed", "m/s", "largest speed just before an impact forward"),
    "impacts_backward": ("impacts backward", "", "number of impacts on the stop backward"),
    "impact_speed_backward": ("speed", "m/s", "largest speed just before an impact backward"),
}
PLANAR_IMPACTS = {
    "impacts": ("impacts", "", "number of impacts on the circular stop"),
    "impact_speed": ("speed", "m/s", "largest radial speed just before an impact"),
}
_AIRBORNE = {"airborne": ("airborne", "", "whether the slider is in flight at the end")}
_ALL = QUANTITIES | COMPONENTS | IMPACTS | PLANAR_IMPACTS | _AIRBORNE
UNITS = {name: unit for name, (_, unit, _) in _ALL.items() if unit}


class SweepFailure(NamedTuple):
    """A combination without a result, and why."""

    slider: int
    record: int
    polarity: str
    message: str


class _Known:
    """A quantity of sliders in the plane, or of those that have stops."""

    def __set_name__(self, owner: type[SweepTable], name: str) -> None:
        self._name = name

    def __get__(self, table: SweepTable | None, owner: type[SweepTable]) -> Any:
        if table is None:
            return self
        name, known = self._name, table._components | (table._impacts or {})
        if name in known:
            return known[name]
        if name in COMPONENTS:
            raise ValueError(
                f"SweepTable: {name} is known of sliders in the plane; these move on one axis: see"
                " residual"
            )
        if table._impacts is None:
            raise ValueError("SweepTable: no slider has stops")
        where = "in the plane" if table.planar else "on one axis"
        raise ValueError(
            f"SweepTable: {name} is not known of sliders {where}; see"
            f" {' and '.join(table._impacts)}"
        )


class SweepTable(Tabular, Saved):
    """Responses of many sliders to many ground motions, as `sweep` returns them.

    Arrays have the shape (sliders, records, polarities). Values are NaN (`events`: 0) where a
    combination failed.

    Attributes
    ----------
    peak : ndarray
        Largest |x| over all time [m]; in the plane the largest |r|.
    residual : ndarray
        x at the end [m]; final if the slider rests. In the plane |r| at the end.
    residual_axis, residual_transverse : ndarray
        In the plane, the components of r at the end [m]; the transverse direction is 90 degrees
        clockwise from the axis. ValueError for sliders on one axis.
    sliding_distance : ndarray
        Length of the path slid [m].
    events : ndarray of int
        Breakaways, reversals, arrests, and all other events.
    airborne : ndarray of bool
        Whether the slider is in flight at the end, under vertical motion without `settle`; its
        residual is then x at the end of the ground motion.
    impacts_forward, impacts_backward : ndarray of int
        Number of impacts on the stop of each side, bounces included. ValueError if no slider has
        stops; so too the next three.
    impact_speed_forward, impact_speed_backward : ndarray
        Largest speed just before an impact [m/s]; 0 without impacts.
    impacts, impact_speed : ndarray
        In the plane, instead of these four: number of impacts on the circular stop, bounces
        included, and largest radial speed just before an impact [m/s].
    sliders : tuple of str
        The reprs of the sliders.
    parameters : dict of ndarray
        By name, the parameters that `grid` varied or that were drawn from a `Random`, for each
        slider; for a list of Coulomb laws, `mu`.
    records : tuple of str
        Names of the ground motions.
    metadata : dict of ndarray
        Columns of the suite, with a value for each record, and its `pga_g` [g].
    motions : tuple of GroundMotion
        The ground motions; empty for a table from a file.
    polarity : tuple of str
        'recorded', under n(t), and 'reversed', under -n(t), or one of them.
    settle : bool
        Whether the sweep continued until the sliders came to rest.
    contact : {'flight', 'clipped'}
        What sliders do when they lose contact with the ground.
    failures : tuple of SweepFailure
        Combinations that failed.
    remark : str
        A sentence about limits of the results, once for all; empty if there are none: pendulums
        beyond their linear range; or nothing slips, but would if accelerations were in g.

    Notes
    -----
    Objects compare by content; they can be copied and pickled.

    Tables have a row for each combination: columns `slider` and its parameters, `record` and its
    metadata, `polarity`, `peak`, `residual`, `sliding_distance` [m], `events`; with stops also
    `impacts_forward`, `impact_speed_forward` [m/s] and the same backward; `airborne` if a slider
    ends in flight. In the plane also `residual_axis` and `residual_transverse` [m], and with stops
    `impacts` and `impact_speed`.

    The file of `save` is also of the format netCDF-4: ``xarray.open_dataset(file)`` opens it with
    the package netCDF4 or h5netcdf, over the dimensions `slider`, `record` and `polarity`. Every
    array has checksums; `open` rejects a damaged file.
    """

    _format = "stickslip sweep table 1"

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
        airborne: ArrayLike | None = None,
        components: Mapping[str, ArrayLike] | None = None,
        impacts: Mapping[str, ArrayLike] | None = None,
        remark: str = "",
    ) -> None:
        self.sliders = tuple(sliders)
        self.parameters = {name: as_column(values) for name, values in parameters.items()}
        self.records = tuple(records)
        self.metadata = {name: as_column(values) for name, values in metadata.items()}
        self.polarity = tuple(polarity)
        self.settle = bool(settle)
        self.contact = str(contact)
        self.remark = str(remark)
        self.failures = tuple(SweepFailure(*one) for one in failures)
        self.peak: NDArray[np.float64] = np.array(peak, float)
        self.residual: NDArray[np.float64] = np.array(residual, float)
        self.sliding_distance: NDArray[np.float64] = np.array(sliding_distance, float)
        self.events: NDArray[np.int64] = np.array(events, np.int64)
        shape = (len(self.sliders), len(self.records), len(self.polarity))
        self.airborne: NDArray[np.bool_] = np.array(
            np.zeros(shape) if airborne is None else airborne, bool
        )
        self._components: dict[str, NDArray[np.float64]] = {}  # in the plane
        if components is not None:
            self._components = {name: np.array(components[name], float) for name in COMPONENTS}
        # None if no slider has stops.
        self._impacts: dict[str, NDArray[Any]] | None = None
        if impacts is not None:
            self._impacts = {
                name: np.array(impacts[name], float if "speed" in name else np.int64)
                for name in (PLANAR_IMPACTS if self.planar else IMPACTS)
            }
        for name, values in self.arrays().items():
            if values.shape != shape:
                raise ValueError(f"SweepTable: {name} must have shape {shape}, got {values.shape}")
        for columns, length in ((self.parameters, shape[0]), (self.metadata, shape[1])):
            for name, column in columns.items():
                if column.shape != (length,):
                    raise ValueError(
                        f"SweepTable: '{name}' must have {length} values, got {column.size}"
                    )
        self.done = np.isfinite(self.peak).any(axis=(0, 2))
        self.done[[one.record for one in self.failures]] = True
        self.motions: tuple[GroundMotion, ...] = ()

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, SweepTable):
            return NotImplemented
        # A table from a file has no motions.
        mine, its = ({**table.__dict__, "motions": ()} for table in (self, other))
        return same(mine, its)

    __hash__ = None  # type: ignore[assignment]

    @classmethod
    def empty(cls, *, has_stops: bool, planar: bool, **about: Any) -> SweepTable:
        """A table without results.

        Parameters
        ----------
        has_stops, planar : bool
            Whether a slider has stops, and whether the sliders move in the plane.
        about
            The arguments of the constructor that are no results.
        """
        shape = tuple(len(about[name]) for name in ("sliders", "records", "polarity"))
        nothing = np.full(shape, np.nan)
        return cls(
            **about,
            peak=nothing,
            residual=nothing,
            sliding_distance=nothing,
            events=np.zeros(shape, int),
            components=dict.fromkeys(COMPONENTS, nothing) if planar else None,
            impacts=dict.fromkeys(IMPACTS | PLANAR_IMPACTS, np.zeros(shape)) if has_stops else None,
        )

    @classmethod
    def _of(cls, arrays: Mapping[str, Any], **about: Any) -> SweepTable:
        """The table of arrays as `arrays` returns them."""
        return cls(
            **about,
            **{name: arrays[name] for name in (*QUANTITIES, "airborne")},
            components=arrays if "residual_axis" in arrays else None,
            impacts=arrays if {"impacts_forward", "impacts"} & arrays.keys() else None,
        )

    def arrays(self, columns: bool = False) -> dict[str, NDArray[Any]]:
        """The arrays over slider, record and polarity; in columns `airborne` only if one is."""
        arrays = {name: getattr(self, name) for name in QUANTITIES}
        arrays |= self._components | (self._impacts or {})
        return (
            arrays if columns and not self.airborne.any() else arrays | {"airborne": self.airborne}
        )

    @property
    def stop_distance(self) -> NDArray[np.float64]:
        """The largest displacement [m] that the stops of each slider allow; inf without stops."""
        found = []
        for slider in self.sliders:
            stops = re.search(r"stops=Stops\(([^)]*)\)", slider)
            gaps = re.findall(r"(?:gap|backward)=([^,)]+)", stops[1]) if stops else ["inf"]
            found.append(max(map(float, gaps)))
        return np.array(found)

    @property
    def planar(self) -> bool:
        """Whether the sliders move in the plane."""
        return bool(self._components)

    residual_axis = _Known()
    residual_transverse = _Known()
    impacts_forward = _Known()
    impacts_backward = _Known()
    impact_speed_forward = _Known()
    impact_speed_backward = _Known()
    impacts = _Known()
    impact_speed = _Known()

    @property
    def impact_fraction(self) -> NDArray[np.float64]:
        """Fraction of the records and polarities in which a slider hits a stop, shape (sliders,).

        Combinations that failed do not count. ValueError if no slider has stops.
        """
        counts = self.impacts if self.planar else self.impacts_forward + self.impacts_backward
        hit = (counts > 0).sum(axis=(1, 2))
        count = np.isfinite(self.peak).sum(axis=(1, 2))
        return np.where(count > 0, hit / np.maximum(count, 1), np.nan)

    def put(self, records: Sequence[int], result: Mapping[str, Any]) -> None:
        """Enter the results for some records: in `result`, arrays by name and the failures."""
        places = list(records)
        for name, values in self.arrays().items():
            values[:, places, :] = result[name]
        self.done[places] = True
        failures = [SweepFailure(s, places[r], p, text) for s, r, p, text in result["failures"]]
        self.failures = tuple(sorted((*self.failures, *failures)))

    def __repr__(self) -> str:
        sliders, records, polarities = self.peak.shape
        remark = f"; {self.remark}" if self.remark else ""
        return (
            f"<SweepTable: {sliders} sliders, {records} records, {polarities} polarities{remark}>"
        )

    # ---- statistics over records and polarities

    def quantile(self, p: ArrayLike, quantity: str = "peak") -> NDArray[np.float64]:
        """Quantiles of |quantity| over all records and polarities, for each slider.

        Parameters
        ----------
        p : float or array_like
            Probabilities from 0 to 1.
        quantity : {'peak', 'residual', 'sliding_distance'}
            The residual counts by its magnitude. In the plane also 'residual_axis' and
            'residual_transverse'.

        Returns
        -------
        ndarray, shape (sliders,) or (probabilities, sliders)
            Quantiles [m], without combinations that failed; NaN where all failed.
        """
        found = [
            np.quantile(row, p) if row.size else np.full(np.shape(p), np.nan)
            for row in self._responses(quantity)
        ]
        return np.moveaxis(np.array(found), 0, -1)

    def mean(self, quantity: str = "peak") -> NDArray[np.float64]:
        """Mean of |quantity| over all records and polarities, for each slider.

        Parameters
        ----------
        quantity : {'peak', 'residual', 'sliding_distance'}
            As for `quantile`.

        Returns
        -------
        ndarray, shape (sliders,)
            Means [m], without combinations that failed; NaN where all failed.
        """
        found = (row.mean() if row.size else math.nan for row in self._responses(quantity))
        return np.fromiter(found, float, len(self.sliders))

    def _responses(self, quantity: str) -> Iterator[NDArray[np.float64]]:
        """For each slider, the magnitudes of a quantity where the combination did not fail."""
        values = np.abs(getattr(self, self._checked(quantity))).reshape(len(self.sliders), -1)
        return (row[np.isfinite(row)] for row in values)

    def _checked(self, quantity: str) -> str:
        names = [name for name in (*QUANTITIES, *self._components) if name != "events"]
        if quantity not in names:
            raise ValueError(
                f"SweepTable: quantity must be one of {', '.join(names)}, got {quantity!r}"
            )
        return quantity

    # ---- other forms

    def _beside(self) -> tuple[dict[str, NDArray[Any]], dict[str, NDArray[Any]]]:
        """Parameters and metadata under names that nothing else has in a table."""
        taken = {*_AXES, *_ALL}
        found: list[dict[str, NDArray[Any]]] = []
        for columns in (self.parameters, self.metadata):
            found.append({})
            for name, column in columns.items():
                free = name
                while free in taken:
                    free += "_"
                taken.add(free)
                found[-1][free] = column
        return found[0], found[1]

    def _table(self) -> tuple[Columns, Mapping[str, str]]:
        parameters, metadata = self._beside()
        records = list(self.records)  # as of stripes, metadata may repeat them
        columns = over(
            {"slider": self.sliders, **parameters},
            {
                "record": self.records,
                **{n: c for n, c in metadata.items() if c.tolist() != records},
            },
            {"polarity": self.polarity},
            **self.arrays(columns=True),
        )
        return columns, UNITS

    def to_json(self) -> str:
        """The table as one JSON document, for tools on the web.

        Returns
        -------
        str
            An object: `format`; `sliders`, `records`, `polarity`, `settle`, `contact`, `remark`;
            `parameters` and `metadata`, by name a list with a value for each slider or record;
            `units` of the quantities; `peak`, `residual`, `sliding_distance`, `events` and
            `airborne`, with stops also `impacts_forward`, `impact_speed_forward` and the same
            backward (in the plane also `residual_axis` and `residual_transverse`, and with stops
            `impacts` and `impact_speed`), each a list over sliders of lists over records of lists
            over polarities; `failures`, each with `slider` and `record` (counted from 0),
            `polarity` and `message`.

        Notes
        -----
        Every number reads back to the same double. JSON lacks NaN and infinity: NaN (a combination
        that failed, a number that is not known) is null, infinite parameters and metadata are
        ``"Infinity"`` and ``"-Infinity"``.
        """
        document = {
            "format": self._format,
            "settle": self.settle,
            "contact": self.contact,
            "remark": self.remark,
            **{name: getattr(self, name) for name in ("sliders", "records", "polarity")},
            **{
                name: {key: _listed(column) for key, column in getattr(self, name).items()}
                for name in ("parameters", "metadata")
            },
            "units": UNITS,
            **self.arrays(),
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
        if found != cls._format:
            raise ValueError(
                f"SweepTable.from_json: the document must be of format '{cls._format}', got"
                f" {found!r}"
            )
        try:
            return cls._of(
                document,  # in which float makes NaN of null
                **{name: document[name] for name in ("sliders", "records", "polarity")},
                **{
                    name: {key: _unlisted(values) for key, values in document[name].items()}
                    for name in ("parameters", "metadata")
                },
                **{name: document[name] for name in ("settle", "contact", "remark")},
                failures=[
                    SweepFailure(*(one[name] for name in SweepFailure._fields))
                    for one in document["failures"]
                ],
            )
        except KeyError as error:
            raise ValueError(f"SweepTable.from_json: the document lacks {error}") from None
        except (AttributeError, IndexError, TypeError, ValueError) as error:
            raise ValueError(f"SweepTable.from_json: the document is damaged: {error}") from None

    def to_xarray(self) -> Any:
        """An xarray Dataset over the parameters of the sliders, record and polarity.

        Returns
        -------
        xarray.Dataset
            If the sliders are a full grid, as `grid` makes it, each parameter is a dimension, and
            `slider` (the reprs) a coordinate over them; otherwise `slider` is one dimension, and
            the parameters are coordinates over it. The metadata are coordinates over `record`.

        Raises
        ------
        ImportError
            xarray is missing.
        """
        xarray = optional("xarray", "tables", "SweepTable.to_xarray")
        names, lengths, order = self._grid()
        coordinates: dict[str, Any] = {
            "slider": (names, np.array(self.sliders)[order].reshape(lengths)),
            "record": list(self.records),
            "polarity": list(self.polarity),
        }
        parameters, metadata = self._beside()
        for name, column in parameters.items():
            if name in names:
                axis = names.index(name)
                values = column[order].reshape(lengths)
                coordinates[name] = (
                    name,
                    np.moveaxis(values, axis, 0).reshape(lengths[axis], -1)[:, 0],
                )
            else:
                coordinates[name] = (names, column[order].reshape(lengths))
        coordinates |= {name: ("record", column) for name, column in metadata.items()}
        return xarray.Dataset(
            {
                name: (
                    (*names, "record", "polarity"),
                    array[order].reshape(*lengths, *array.shape[1:]),
                    _attributes(name),
                )
                for name, array in self.arrays(True).items()
            },
            coords=coordinates,
            attrs={"settle": int(self.settle), "contact": self.contact},
        )

    def _grid(self) -> tuple[list[str], list[int], NDArray[np.intp]]:
        """Dimensions of the sliders, their lengths, and the sliders in the order of the dimensions.

        The parameters if each combination of their values occurs once, otherwise one dimension.
        """
        parameters, _ = self._beside()
        names = list(parameters)
        places = []
        for column in parameters.values():
            seen: dict[Any, int] = {}
            places.append([seen.setdefault(value, len(seen)) for value in column.tolist()])
        lengths = [max(column) + 1 for column in places]
        if names and math.prod(lengths) == len(self.sliders):
            flat = np.ravel_multi_index(places, lengths)
            if np.unique(flat).size == flat.size:
                return names, lengths, np.argsort(flat)
        return ["slider"], [len(self.sliders)], np.arange(len(self.sliders))

    def _write(self, h5: Any) -> None:
        h5.attrs["settle"] = int(self.settle)
        h5.attrs["contact"] = self.contact
        h5.attrs["remark"] = self.remark
        h5.attrs["failures"] = json.dumps([list(one) for one in self.failures])
        for axis, name in _AXES.items():
            write(h5, axis, getattr(self, name)).make_scale(axis)
        beside = []
        kinds = (("slider", "parameters"), ("record", "metadata"))
        for (axis, kind), columns in zip(kinds, self._beside()):
            for (key, column), name in zip(columns.items(), getattr(self, kind)):
                key = key.replace("/", "\\")  # a slash would create a group
                data = write(h5, key, column)
                data.attrs.update({"kind": kind, "name": name})
                data.dims[0].attach_scale(h5[axis])
                beside += [key] if len(key.split()) == 1 else []
        for name, array in self.arrays().items():
            data = write(h5, name, array)
            data.attrs.update({**_attributes(name), "coordinates": " ".join(beside)})
            for place, axis in enumerate(_AXES):
                data.dims[place].attach_scale(h5[axis])

    @classmethod
    def _read(cls, h5: Any) -> SweepTable:
        about: dict[str, Any] = {
            "settle": bool(h5.attrs["settle"]),
            "contact": h5.attrs["contact"],
            "remark": h5.attrs["remark"],
            "failures": json.loads(h5.attrs["failures"]),
        }
        axes = {name: read(h5, axis) for axis, name in _AXES.items()}
        shape = tuple(len(values) for values in axes.values())
        columns: dict[str, dict[str, NDArray[Any]]] = {"parameters": {}, "metadata": {}}
        for key in h5:
            if "kind" in h5[key].attrs:
                kind = h5[key].attrs["kind"]
                length = shape[0 if kind == "parameters" else 1]
                columns[kind][h5[key].attrs["name"]] = read(h5, key, (length,))
        arrays = {name: read(h5, name, shape) for name in _ALL if name in h5}
        return cls._of(arrays, **axes, **columns, **about)

    @overload
    def plot(
        self,
        quantity: str = "peak",
        *,
        against: str | None = None,
        ax: None = None,
        title: str | None = None,
    ) -> Figure: ...
    @overload
    def plot(
        self,
        quantity: str = "peak",
        *,
        against: str | None = None,
        ax: Axes,
        title: str | None = None,
    ) -> Axes: ...
    def plot(
        self,
        quantity: str = "peak",
        *,
        against: str | None = None,
        ax: Axes | None = None,
        title: str | None = None,
    ) -> Figure | Axes:
        """Plot the median and the 16 and 84 % quantiles over records and polarities.

        Up to 200 histories are also drawn as thin lines; of more, the 5 and 95 % quantiles are. One
        record has a line for each polarity, or one line if both are the same.

        Parameters
        ----------
        quantity : {'peak', 'residual', 'sliding_distance'}
            The residual counts by its magnitude. In the plane also 'residual_axis' and
            'residual_transverse'.
        against : str, optional
            The parameter on the horizontal axis; default: the first one with numbers, or the
            sliders themselves if no parameter has any. If others vary too, each combination of
            them has its own median and band, at most six.
        ax : matplotlib Axes, optional
            Where to draw; default: a new figure of 7 x 4.5 inches.
        title : str, optional

        Returns
        -------
        matplotlib Figure or Axes
            The axes if they were given, otherwise the new figure.

        Raises
        ------
        ValueError
            An unknown quantity or parameter; more than six combinations.
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
    sliders: Sequence[AnySwept], given: Mapping[str, Sequence[Any]]
) -> dict[str, Any]:
    """The parameters that `grid` varied; for a list of Coulomb laws, mu."""
    if given or not all(isinstance(one, Coulomb) for one in sliders):
        return dict(given)
    blocks = [one for one in sliders if isinstance(one, Coulomb)]
    return {"mu": [one.slip_level / STANDARD_GRAVITY for one in blocks]}


def _attributes(name: str) -> dict[str, str]:
    _, unit, what = _ALL[name]
    return {"long_name": what} | ({"units": unit} if unit else {})


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
