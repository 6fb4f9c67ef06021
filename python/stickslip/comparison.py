"""Theory and simulation side by side."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _core, theory
from ._core import Ensemble, GaussianExcitation, Moments, PoissonPulses
from .ensemble import run_ensemble

if TYPE_CHECKING:
    from matplotlib.figure import FigureBase

__all__ = ["Comparison", "compare"]

_FIGURES = ("displacement_variance", "velocity_variance", "covariance")
_FINEST = 512  # times of the statistics at least, for the stationary averages


class Comparison:
    """What `compare` returns: an ensemble, and what each theory predicts of it.

    Comparisons with equal attributes are equal; they can be copied and pickled, but not hashed.

    Attributes
    ----------
    time : ndarray, shape (T,)
        Times of the comparison [s].
    ensemble : Ensemble
        The simulation; it has more times.
    theories : dict of str to Moments
        What each theory that applies predicts at `time`, the best first.
    refused : dict of str to str
        Theories for this kind of excitation that do not cover the slider, and why.
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

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Comparison):
            return NotImplemented
        return (
            np.array_equal(self.time, other.time)
            and self.ensemble == other.ensemble
            and self.theories == other.theories
            and self.refused == other.refused
        )

    def simulated(self, figure: str) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """A figure of the ensemble at `time`, and its standard error.

        Parameters
        ----------
        figure : str
            'displacement_variance' [m^2], 'velocity_variance' [m^2/s^2] or 'covariance' [m^2/s].

        Returns
        -------
        value, error : ndarray, shape (T,)

        Raises
        ------
        ValueError
            Another figure.
        """
        if figure not in _FIGURES:
            raise ValueError(
                f"Comparison: figure must be one of {', '.join(_FIGURES)}, got {figure!r}"
            )
        value, error = (getattr(self.ensemble, figure + part) for part in ("", "_error"))
        return value[self._at], error[self._at]

    def ratio(self, name: str, figure: str) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Theory over simulation, and the standard error that the simulation lends to it.

        Parameters
        ----------
        name : str
            One of `theories`.
        figure : str
            As of `simulated`.

        Returns
        -------
        value, error : ndarray, shape (T,)
            NaN where the simulation is zero, as at time 0.

        Raises
        ------
        ValueError
            Another theory or figure.
        """
        if name not in self.theories:
            raise ValueError(
                f"Comparison: theory must be one of {', '.join(self.theories)}, got {name!r}"
            )
        value, error = self.simulated(figure)
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = np.where(value != 0, getattr(self.theories[name], figure) / value, np.nan)
            return ratio, np.abs(ratio * error / value)

    def __str__(self) -> str:
        """A table: the simulation with its standard errors, and each theory over it."""
        lines = [f"{self.ensemble.members:,} members; theory / simulation"]
        for figure, unit in zip(_FIGURES[:2], ("m^2", "(m/s)^2")):
            value, error = self.simulated(figure)
            heading = f"{figure.replace('_', ' ')} [{unit}]"
            lines += ["", _row(heading, (f"t = {t:.4g} s" for t in self.time))]
            lines.append(_row("simulation", map("{:.4g}".format, value)))
            lines.append(_row("standard error", map("{:.1g}".format, error)))
            for name in self.theories:
                lines.append(_row("  " + name, map("{:.3f}".format, self.ratio(name, figure)[0])))
        growth = self.ensemble.stationary.growth_rate
        lines += [
            "",
            _row("growth rate [m^2/s]", [f"{growth.value:.4g}", f"+- {growth.error:.1g}"]),
        ]
        for name, moments in self.theories.items():
            rate = moments.growth_rate.value
            if math.isfinite(rate) and growth.value != 0:
                lines.append(_row("  " + name, [f"{rate / growth.value:.3f}"]))
        notes = [f"{name}: {m.remark}" for name, m in self.theories.items() if m.remark]
        notes += [f"{name} does not apply: {why}" for name, why in self.refused.items()]
        return "\n".join(lines + ([""] if notes else []) + notes)

    def plot(self, figure: FigureBase | None = None, title: str | None = None) -> FigureBase:
        """Variances by time: the ensemble with its errors, and every theory as a line.

        Parameters
        ----------
        figure : matplotlib Figure or SubFigure, optional
            Where to draw; a new figure of 9 x 4.2 inches if not given.
        title : str, optional
            Instead of what slid and how many members there are.

        Returns
        -------
        matplotlib Figure or SubFigure
            Its axes: variance of x, variance of x'.

        Raises
        ------
        ImportError
            matplotlib is missing.
        """
        from .plotting import plot_comparison

        return plot_comparison(self, figure, title)


def compare(
    slider: Any,
    excitation: GaussianExcitation | PoissonPulses,
    times: Sequence[float] | NDArray[np.float64] | None = None,
    *,
    members: int = 100_000,
    seed: int = 0,
    threads: int | None = None,
    progress: bool | None = None,
) -> Comparison:
    """Every theory that applies, beside an ensemble with its errors.

    Under `PoissonPulses`: the pulse chain and the three superpositions. Under white
    `GaussianExcitation`: the exact white-noise results and equivalent linearization, with Gaussian
    expectations and with the thesis's force. Under other stationary `GaussianExcitation`:
    stationary linearization, from rest.

    Parameters
    ----------
    slider : Slider, Coulomb or Caster
    excitation : GaussianExcitation or PoissonPulses
    times : array_like, shape (T,), optional
        Where to compare [s], increasing, above 0, at most the excitation's duration; multiples of
        its dt, or, under pulses, of a common step. Six even ones if not given.
    members, seed, threads, progress
        As of `run_ensemble`.

    Returns
    -------
    Comparison
        Printed, a table of theory over simulation; `plot` draws it.

    Raises
    ------
    ValueError
        Times out of their range; Gaussian excitation with an envelope, which no theory covers, or
        white without a line at zero frequency; what `run_ensemble` refuses.
    TypeError
        Another kind of excitation: there is no theory for it.
    KeyboardInterrupt
        Within a second of Ctrl-C.

    Notes
    -----
    Takes what `run_ensemble` takes, and some milliseconds for each theory; a caster under pulses up
    to ten seconds.
    """
    rivals = _rivals(slider, excitation)
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
    for name, predict in rivals.items():
        try:
            predictions[name] = predict(time)
        except (TypeError, ValueError) as error:
            refused[name] = str(error)
    return Comparison(time, ensemble, predictions, refused)


def _rivals(slider: Any, excitation: Any) -> dict[str, Callable[[Any], Moments]]:
    """The theories for this kind of excitation, the best first."""
    if isinstance(excitation, PoissonPulses):
        rivals: dict[str, Any] = {"PulseChain": theory.PulseChain()}
        for overlap in ("renewal", "thesis", "none"):
            rivals[f"PulseSuperposition, {overlap}"] = theory.PulseSuperposition(overlap=overlap)
        return {
            name: lambda time, rival=rival: rival.predict(slider, excitation, time)
            for name, rival in rivals.items()
        }
    if not isinstance(excitation, GaussianExcitation):
        raise TypeError(
            "compare: excitation must be GaussianExcitation or PoissonPulses, got "
            f"{type(excitation).__name__}"
        )
    if excitation.envelope is not None:
        raise ValueError(
            "compare: no theory covers Gaussian excitation with an envelope, envelope must be None"
        )
    spectrum = excitation.spectrum
    if spectrum.kind != "white":
        return {
            "StationaryLinearization": lambda time: (
                theory.StationaryLinearization().predict(slider, spectrum).transient(time)
            )
        }
    if not excitation.zero_frequency:
        raise ValueError(
            "compare: white noise has a line at zero frequency, without which the ground comes "
            "back to where it was; zero_frequency must be True"
        )
    return {
        "WhiteNoise": lambda time: theory.WhiteNoise(slider, spectrum).predict(time),
        "EquivalentLinearization": lambda time: theory.EquivalentLinearization().predict(
            slider, spectrum, time
        ),
        "EquivalentLinearization, thesis": lambda time: theory.EquivalentLinearization(
            force="thesis"
        ).predict(slider, spectrum, time),
    }


def _times(times: Any, excitation: Any) -> tuple[NDArray[np.float64], float]:
    """The times [s], and a step of the statistics that has all of them."""
    end, own = excitation.duration, getattr(excitation, "dt", None)
    if times is None:
        time = np.linspace(end / 6, end, 6)
        time = time if own is None else np.maximum(np.rint(time / own), 1) * own
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


def _row(name: str, cells: Any) -> str:
    return f"{name:<34}" + "".join(f"{cell:>12}" for cell in cells)
