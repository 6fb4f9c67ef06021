"""Theory and simulation side by side."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Protocol, TypeVar, overload

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._core import (
    ConvergenceError,
    Ensemble,
    GaussianExcitation,
    Moments,
    PlanarSlider,
    PoissonPulses,
    WithTransverse,
    build_info,
)
from ._tables import Columns, Repeated, html_table, json_text
from ._tabular import Tabular
from .ensemble import run_ensemble
from .runs.progress import on_screen, shown
from .theory import PLANAR_THEORIES, THEORIES, Coverage

if TYPE_CHECKING:
    from matplotlib.figure import Figure, FigureBase

_Place = TypeVar("_Place", bound="FigureBase")

__all__ = ["Comparison", "compare"]

_STATISTICS = ("displacement_variance", "velocity_variance", "covariance")
_COMPONENTS = ("axis", "transverse")  # in the plane
_UNITS = {"time": "s", "growth_rate": "m^2/s"}
_PLANAR_UNITS = dict(_UNITS)
for _name, _unit in zip(_STATISTICS, ("m^2", "m^2/s^2", "m^2/s")):
    for _part in ("", "_error"):
        _UNITS[_name + _part] = _unit
        _PLANAR_UNITS |= {f"{_name}{_part}_{one}": _unit for one in _COMPONENTS}
_COLUMNS = 6  # maximum number of times in a printed table
_FINEST = 512  # minimum number of times of the statistics, for the stationary averages


class Comparison(Tabular):
    """Result of `compare`: an ensemble, and the predictions of each theory.

    Comparisons with equal attributes are equal; they can be copied and pickled, but not hashed.

    Tables have a row for each time of the simulation and of each theory: columns `source`
    ('simulation' or the name of a theory), `time`, `displacement_variance`, `velocity_variance` and
    `covariance`, each followed by its standard error, as `displacement_variance_error` (NaN for
    theories). In the plane each has two columns, such as `displacement_variance_axis` and
    `displacement_variance_transverse`.

    Attributes
    ----------
    time : ndarray, shape (T,)
        Times of the comparison [s].
    ensemble : Ensemble
        The simulation, at more times.
    theories : dict of str to Moments
        The predictions at `time` of each theory that applies, in the order of `theories`; in the
        plane they are those of each component.
    refused : dict of str to str
        Theories for this kind of excitation that do not apply here, and why.
    """

    def __init__(
        self,
        time: NDArray[np.float64],
        ensemble: Ensemble,
        theories: dict[str, Moments],
        refused: dict[str, str],
    ) -> None:
        self.time = time
        self.ensemble = ensemble
        self.theories = theories
        self.refused = refused
        self._at = np.rint(time / ensemble.time[1]).astype(int)

    def simulated(self, statistic: str) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """A statistic of the ensemble at `time`, and its standard error.

        Parameters
        ----------
        statistic : str
            'displacement_variance' [m^2], 'velocity_variance' [m^2/s^2] or 'covariance' [m^2/s].

        Returns
        -------
        value, error : ndarray, shape (T,)
            In the plane (T, 2), along the axis and transverse.

        Raises
        ------
        ValueError
            An unknown statistic.
        """
        if statistic not in _STATISTICS:
            raise ValueError(
                f"Comparison: statistic must be one of {', '.join(_STATISTICS)}, got {statistic!r}"
            )
        value, error = (getattr(self.ensemble, statistic + part) for part in ("", "_error"))
        return value[self._at], error[self._at]

    def ratio(self, name: str, statistic: str) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Theory over simulation, and its standard error, which is that of the simulation.

        Parameters
        ----------
        name : str
            One of `theories`.
        statistic : str
            As for `simulated`.

        Returns
        -------
        value, error : ndarray, shape (T,)
            NaN where the simulated value is zero. In the plane (T, 2).

        Raises
        ------
        ValueError
            An unknown theory or statistic.
        """
        if name not in self.theories:
            raise ValueError(
                f"Comparison: theory must be one of {', '.join(self.theories)}, got {name!r}"
            )
        value, error = self.simulated(statistic)
        theory = self._like(getattr(self.theories[name], statistic))
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = np.where(value != 0, theory / value, np.nan)
            return ratio, np.abs(ratio * error / value)

    def _like(self, predicted: NDArray[np.float64]) -> NDArray[np.float64]:
        """Predictions in the shape of a simulated statistic: in the plane, of each component."""
        return np.repeat(predicted[:, None], 2, axis=1) if self.ensemble.in_plane else predicted

    def _named(
        self, name: str, values: NDArray[np.float64]
    ) -> Iterator[tuple[str, NDArray[np.float64]]]:
        """The columns of a statistic: one, or in the plane one for each component."""
        if self.ensemble.in_plane:
            yield from ((f"{name}_{one}", values[..., i]) for i, one in enumerate(_COMPONENTS))
        else:
            yield name, values

    def _growth(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The growth rate of the displacement variance and its standard error; in the plane, which
        has no stationary averages, 2 E[x v] of each component at the end."""
        if self.ensemble.in_plane:
            value, error = self.simulated("covariance")
            return 2 * value[-1], 2 * error[-1]
        found = self.ensemble.stationary.growth_rate
        return np.array(found.value), np.array(found.error)

    @property
    def _remark(self) -> str:
        return "" if self.ensemble.in_plane else self.ensemble.stationary.remark

    def __repr__(self) -> str:
        names = ", ".join(self.theories) or "no theory"
        refused = f"; {len(self.refused)} do not apply" if self.refused else ""
        return (
            f"<Comparison: {self.ensemble.members:,} members, {len(self.time)} times to"
            f" {self.time[-1]:.4g} s, {names}{refused}>"
        )

    def _shown(self) -> NDArray[np.int64]:
        """The times of the printed tables, at most six, the last one among them."""
        step = math.ceil(len(self.time) / _COLUMNS)
        return np.arange(len(self.time) - 1, -1, -step)[::-1]

    def _table(self) -> tuple[Columns, Mapping[str, str]]:
        names = np.array(["simulation", *self.theories])
        count = len(self.time)
        columns: dict[str, NDArray[Any] | Repeated] = {
            "source": Repeated(names, np.repeat(np.arange(len(names)), count)),
            "time": np.tile(self.time, len(names)),
        }
        for statistic in _STATISTICS:
            value, error = self.simulated(statistic)
            predicted = [self._like(getattr(one, statistic)) for one in self.theories.values()]
            columns |= self._named(statistic, np.concatenate([value, *predicted]))
            unknown = [np.full_like(error, np.nan)] * len(self.theories)
            columns |= self._named(f"{statistic}_error", np.concatenate([error, *unknown]))
        return columns, _PLANAR_UNITS if self.ensemble.in_plane else _UNITS

    def to_json(self) -> str:
        """The comparison as one JSON document.

        Returns
        -------
        str
            An object: `stickslip`, `configuration`, `members`, `units`; `time`; `simulation`, the
            statistics by name with their errors, in the plane those of each component; `theories`,
            by name of the theory its statistics, its growth rate and its remark; `refused`, by name
            the reason. Numbers read back to the same double; NaN is null.
        """
        simulation: dict[str, Any] = {}
        for statistic, pair in (
            ("growth_rate", self._growth()),
            *((name, self.simulated(name)) for name in _STATISTICS),
        ):
            for part, values in zip(("", "_error"), pair):
                simulation |= self._named(f"{statistic}{part}", values)
        return json_text(
            {
                "stickslip": build_info()["version"],
                "configuration": self.ensemble.configuration,
                "members": self.ensemble.members,
                "units": self._table()[1],
                "time": self.time,
                "simulation": simulation,
                "theories": {
                    name: {
                        **{statistic: getattr(moments, statistic) for statistic in _STATISTICS},
                        "growth_rate": moments.growth_rate.value,
                        "remark": moments.remark,
                    }
                    for name, moments in self.theories.items()
                },
                "refused": self.refused,
            }
        )

    def __str__(self) -> str:
        """A table: the simulation with its standard errors, and each theory over it."""
        shown = self._shown()
        labels = [f"  {one}, {_COMPONENTS[-1]}" for one in self.theories]
        width = max([34, *(len(one) + 1 for one in labels if self.ensemble.in_plane)])

        def row(name: str, cells: Any) -> str:
            return f"{name:<{width}}" + "".join(f"{cell:>12}" for cell in cells)

        lines = [f"{self.ensemble.members:,} members; theory / simulation"]
        for statistic, unit in zip(_STATISTICS[:2], ("m^2", "(m/s)^2")):
            value, error = self.simulated(statistic)
            heading = f"{statistic.replace('_', ' ')} [{unit}]"
            lines += ["", row(heading, (f"t = {t:.4g} s" for t in self.time[shown]))]
            for (label, values), (_, errors) in zip(
                self._named("simulation", value), self._named("", error)
            ):
                lines.append(row(_words(label), map("{:.4g}".format, values[shown])))
                lines.append(row("standard error", map("{:.1g}".format, errors[shown])))
            for label, ratio in self._ratios(statistic):
                lines.append(row("  " + label, map("{:.3f}".format, ratio[shown])))
        growth, error = (np.atleast_1d(one) for one in self._growth())
        cells = [cell for g, e in zip(growth, error) for cell in (f"{g:.4g}", f"+- {e:.1g}")]
        at_end = ", at the end" if self.ensemble.in_plane else ""
        lines += ["", row(f"growth rate [m^2/s]{at_end}", cells)]
        for name, moments in self.theories.items():
            rate = moments.growth_rate.value
            if math.isfinite(rate) and growth.all():
                cells = [cell for one in rate / growth for cell in (f"{one:.3f}", "")]
                lines.append(row("  " + name, cells).rstrip())
        notes = [f"simulation: {remark}"] if (remark := self._remark) else []
        notes += [f"{name}: {m.remark}" for name, m in self.theories.items() if m.remark]
        notes += [f"{name} does not apply: {why}" for name, why in self.refused.items()]
        return "\n".join(lines + ([""] if notes else []) + notes)

    def _ratios(self, statistic: str) -> Iterator[tuple[str, NDArray[np.float64]]]:
        """Theory over simulation of each theory that predicts a statistic, and in the plane of each
        component."""
        for name, moments in self.theories.items():
            if not np.isnan(getattr(moments, statistic)).all():
                for label, ratio in self._named("", self.ratio(name, statistic)[0]):
                    yield name + label.replace("_", ", "), ratio

    def _repr_html_(self) -> str:
        """The same table for a notebook."""
        tables = []
        shown = self._shown()
        times = [f"{t:.4g} s" for t in self.time[shown]]
        for statistic, unit in zip(_STATISTICS[:2], ("m²", "m²/s²")):
            value, error = self.simulated(statistic)
            rows = [
                (
                    f"{_words(label)} [{unit}]",
                    *(f"{v:.4g} ± {e:.1g}" for v, e in zip(values[shown], errors[shown])),
                )
                for (label, values), (_, errors) in zip(
                    self._named("simulation", value), self._named("", error)
                )
            ]
            for label, ratio in self._ratios(statistic):
                rows.append((f"{label} / simulation", *(f"{r:.3f}" for r in ratio[shown])))
            tables.append(html_table(statistic.replace("_", " "), ["time", *times], rows))
        if self.refused:
            tables.append(html_table("theories that do not apply", [], self.refused.items()))
        return "".join(tables)

    @overload
    def plot(self, figure: None = None, title: str | None = None) -> Figure: ...
    @overload
    def plot(self, figure: _Place, title: str | None = None) -> _Place: ...
    def plot(self, figure: FigureBase | None = None, title: str | None = None) -> FigureBase:
        """Plot the variances over time: the ensemble with its errors, and each theory as a line.

        Parameters
        ----------
        figure : matplotlib Figure or SubFigure, optional
            Where to draw; default: a new figure of 9 x 4.4 inches.
        title : str, optional
            Default: the number of members, and the slider.

        Returns
        -------
        matplotlib Figure or SubFigure
            With two axes: variance of x, variance of x'.

        Raises
        ------
        ImportError
            matplotlib is missing.
        """
        from .plotting import plot_comparison

        return plot_comparison(self, figure, title)


class _Theory(Protocol):
    @property
    def name(self) -> str: ...
    def covers(self, slider: Any, excitation: Any, /) -> Coverage | bool: ...
    def predict(self, slider: Any, excitation: Any, times: Any, /) -> Moments: ...


def compare(
    slider: Any,
    excitation: GaussianExcitation | PoissonPulses | WithTransverse,
    times: Sequence[float] | NDArray[np.float64] | None = None,
    *,
    members: int = 100_000,
    seed: int = 0,
    threads: int | None = None,
    progress: bool | None = None,
    theories: Sequence[_Theory] | None = None,
) -> Comparison:
    """Compare every theory that applies with an ensemble and its standard errors.

    A theory applies if its `covers` accepts the slider and the excitation. Theories in the plane
    have `dimensions` 2 and predict the moments of one component: they apply to sliders in the plane
    under two uncorrelated components of equal strength, if they cover the slider along its axis
    under one of them.

    Parameters
    ----------
    slider : Slider, friction law or PlanarSlider
    excitation : GaussianExcitation, PoissonPulses or WithTransverse
        In the plane `WithTransverse`, for the theories of this package with ratio 1 and coherence
        0. Or your own excitation, if one of your own theories covers it.
    times : array_like, shape (T,), optional
        Times of the comparison [s], increasing, above 0, at most the excitation's duration;
        multiples of its dt, or, under pulses, of a common step. Default: twelve evenly spaced
        times, of which printed tables show six.
    members, seed, threads
        As for `run_ensemble`.
    progress : bool, optional
        A bar as for `run_ensemble`, and one over the theories.
    theories : sequence, optional
        The theories to compare; default `stickslip.theory.THEORIES`, in the plane
        `stickslip.theory.PLANAR_THEORIES`. Each has a unique `name`;
        `covers(slider, excitation)`, which returns a bool or a `stickslip.theory.Coverage`; and
        `predict(slider, excitation, times)`, which returns `Moments` at the times. A theory of
        another number of dimensions than the slider is refused.

    Returns
    -------
    Comparison
        `print` shows a table of theory over simulation; `plot` draws it.

    Raises
    ------
    ValueError
        Times out of range; an excitation that no theory covers, such as Gaussian excitation with an
        envelope, white noise without a line at zero frequency, or components of different strength;
        two theories with the same name;
        arguments that `run_ensemble` rejects.
    TypeError
        A kind of excitation for which there is no theory; an object that is not a theory.
    KeyboardInterrupt
        Within a second of Ctrl-C.

    Notes
    -----
    Takes as long as `run_ensemble`, plus some milliseconds for each theory; up to ten seconds for
    a caster under pulses, and a minute for `Transport` with a spring. Give the motions of an
    ensemble a line at zero frequency and a long period (`zero_frequency=True`, `period=`) if they
    are to be those of a continuous process, as the theories assume.
    """
    default = PLANAR_THEORIES if isinstance(slider, PlanarSlider) else THEORIES
    asked = {t.name: t for t in (default if theories is None else map(_checked, theories))}
    if theories is not None and len(asked) < len(theories):
        names = ", ".join(t.name for t in theories)
        raise ValueError(f"compare: theories must have different names, got {names}")
    answers = {name: _answer(t, slider, excitation) for name, t in asked.items()}
    if not any(a.excitation for a in answers.values()) or not hasattr(excitation, "sample"):
        raise _uncovered(slider, excitation, answers)
    time, dt = _times(times, excitation)
    ensemble = run_ensemble(
        slider,
        excitation,
        members=members,
        seed=seed,
        threads=threads,
        dt=dt,
        velocity_spectrum=False,
        progress=progress,
    )
    predictions: dict[str, Moments] = {}
    refused: dict[str, str] = {}
    # At once, for one theory can take a minute.
    with shown(on_screen() if progress is None else progress, "compare", "theory") as report:
        for done, (name, answer) in enumerate(answers.items()):
            report(done, len(answers))
            if answer:
                try:
                    predictions[name] = _predicted(asked[name], slider, excitation, time)
                except (ValueError, ConvergenceError) as error:  # found only by the computation
                    refused[name] = str(error)
            elif answer.excitation:
                refused[name] = answer.reason
        report(len(answers), len(answers))
    return Comparison(time, ensemble, predictions, refused)


def _checked(theory: Any) -> _Theory:
    for part in ("name", "covers", "predict"):
        if not hasattr(theory, part):
            raise TypeError(f"compare: a theory must have `{part}`, got {theory!r}")
    return theory


def _answer(theory: _Theory, slider: Any, excitation: Any) -> Coverage:
    planar = isinstance(slider, PlanarSlider)
    dimensions = getattr(theory, "dimensions", 2 if planar and not _is_ours(theory) else 1)
    if dimensions != (2 if planar else 1):
        where = "in the plane" if planar else "along one axis"
        return Coverage(
            f"{theory.name}: describes motion in"
            f" {'one dimension' if dimensions == 1 else f'{dimensions} dimensions'}, and the slider"
            f" moves {where}"
        )
    if planar and _is_ours(theory):
        if not isinstance(excitation, WithTransverse):
            return Coverage("theories in the plane cover WithTransverse", excitation=False)
        pair = excitation.ratio, excitation.coherence
        if pair != (1, 0) or excitation.transverse != excitation.horizontal:
            return Coverage(
                "theories in the plane cover two components of the same excitation with ratio 1 and"
                f" coherence 0, got ratio {pair[0]:g} and coherence {pair[1]:g}"
                f"{'' if pair != (1, 0) else ' of different excitations'}",
                excitation=False,
            )
    answer = theory.covers(*_coordinate(theory, slider, excitation))
    if isinstance(answer, Coverage):
        return answer
    if not isinstance(answer, (bool, np.bool_)):
        raise TypeError(
            f"compare: covers of {theory.name} must return a bool or a Coverage, got {answer!r}"
        )
    return Coverage() if answer else Coverage(f"{theory.name}: does not cover them")


def _is_ours(theory: _Theory) -> bool:
    return isinstance(theory, tuple({type(one) for one in THEORIES}))


def _coordinate(theory: _Theory, slider: Any, excitation: Any) -> tuple[Any, Any]:
    """What a theory is asked about: in the plane, those of this package of one coordinate."""
    if isinstance(slider, PlanarSlider) and _is_ours(theory):
        return slider.along_axis, excitation.horizontal
    return slider, excitation


def _predicted(theory: _Theory, slider: Any, excitation: Any, time: NDArray[np.float64]) -> Moments:
    moments = theory.predict(*_coordinate(theory, slider, excitation), time)
    if not isinstance(moments, Moments):
        raise TypeError(f"compare: predict of {theory.name} must return Moments, got {moments!r}")
    if not np.array_equal(moments.time, time):
        raise ValueError(f"{theory.name} returned Moments at other times than requested")
    return moments


def _uncovered(slider: Any, excitation: Any, answers: dict[str, Coverage]) -> Exception:
    """The error for an excitation that no theory covers, or that makes no motions."""
    planar = isinstance(slider, PlanarSlider)
    kinds = (WithTransverse,) if planar else (GaussianExcitation, PoissonPulses)
    if not isinstance(excitation, kinds):
        names = " or ".join(kind.__name__ for kind in kinds)
        where = " for a slider in the plane" if planar else ""
        return TypeError(
            f"compare: excitation must be {names}{where}, got {type(excitation).__name__}"
        )
    reasons = dict.fromkeys(answer.reason for answer in answers.values())
    return ValueError("compare: no theory covers this excitation. " + ". ".join(reasons))


def _times(times: Any, excitation: Any) -> tuple[NDArray[np.float64], float]:
    """The times [s], and a step of the statistics that divides all of them."""
    one = getattr(excitation, "horizontal", excitation)  # of a pair
    end, own = excitation.duration, getattr(one, "dt", None)
    if times is None:
        time = np.linspace(end / 12, end, 12)
        time = time if own is None else np.unique(np.maximum(np.rint(time / own), 1)) * own
    else:
        time = _core.to_vector(times, "compare: times")
    if len(time) == 0 or not np.isfinite(time).all():
        raise ValueError(f"compare: times must be a row of finite numbers, got {times!r}")
    if not (np.diff(time, prepend=0) > 0).all() or time[-1] > end * (1 + 1e-12):
        raise ValueError(
            f"compare: times must increase, from above 0 to at most the duration of {end:.6g} s, "
            f"got {times!r}"
        )
    if own is not None:
        if not np.allclose(np.rint(time / own) * own, time, rtol=1e-9, atol=0):
            raise ValueError(
                f"compare: times must be multiples of the excitation's {own:.6g} s, got {times!r}"
            )
        return time, own
    parts = [Fraction(t / time[0]).limit_denominator(10_000) for t in time]
    step = time[0] / math.lcm(*(p.denominator for p in parts))
    if not np.allclose(np.rint(time / step) * step, time, rtol=1e-9, atol=0) or (
        time[-1] / step > 2**14
    ):
        raise ValueError(
            "compare: times must be multiples of a common step of at least 1/16384 of the last, "
            f"got {times!r}"
        )
    return time, step / math.ceil(_FINEST * step / end)


def _words(label: str) -> str:
    return label.replace("_", ", ")
