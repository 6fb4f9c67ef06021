"""What all regressions have in common."""

from __future__ import annotations

import functools
import inspect
import math
import re
import textwrap
import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from types import CodeType
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from .._core import STANDARD_GRAVITY, GroundMotion
from ..motions.suite import Suite
from .arguments import MEASURES, OF_MOTION, UNITS, checked, measured, spectral
from .prediction import Prediction, normal_cdf

__all__ = ["Form", "RangeWarning", "Regression"]

_LN10 = math.log(10)
_CM = math.log(0.01)  # ln of a centimeter in meters

_NEXT_TO_NOTHING = 1e-9  # of which the logarithm is finite; in place of a measure of 0
_TAKEN = (*MEASURES, "Sa")  # from a record
_KNOWN: dict[str, Any] = {  # in equations
    "__builtins__": {},
    "ln": np.log,
    "log": np.log10,
    "exp": np.exp,
    "max": np.maximum,
    "min": np.minimum,
    "choose": np.where,
    "g": STANDARD_GRAVITY,
}


class RangeWarning(UserWarning):
    """Warning about a value outside the range of the data that a model was fitted to."""


class Form(NamedTuple):
    """One of the equations of a model, chosen by the arguments that it takes beside ky."""

    name: str
    arguments: tuple[str, ...]
    equation: str  # of ln D or log D
    sigma: str | None = None  # of the same logarithm; None if no source gives it


class _Values(dict[str, Any]):
    """Arguments by name, and what follows from them by the equations of a model, on demand."""

    def __init__(self, arguments: Mapping[str, Any], equations: Mapping[str, str]) -> None:
        super().__init__(arguments)
        self._equations = equations

    def __missing__(self, name: str) -> Any:
        value = self[name] = self.value(self._equations[name])
        return value

    def value(self, equation: str) -> Any:
        return eval(_code(equation), _KNOWN, self)


@functools.cache
def _code(equation: str) -> CodeType:
    """An equation as the papers print it, such as "2 ln r + 3 Ts^2", compiled."""
    text = re.sub(r"^(.*) for (.*), else (.*)$", r"choose(\2, \1, \3)", equation)
    text = re.sub(r"\b(ln|log) (\w+)", r"\1(\2)", text)
    text = re.sub(r"(?<=[\w)]) (?=[\w(])", " * ", text)
    return compile(text.replace("^", "**"), equation, "eval")


class Regression:
    """A model that predicts the displacement of a slope from measures of the ground motion.

    The subclasses are listed in `stickslip.regressions`. Their method `predict` takes numbers or
    arrays; `of` takes the measures from a record. Where `pga`, `pgv`, `Ia` or `Sa` is 0, as in a
    cell of a map without shaking, nothing moves: the median is 0 and `p_zero` is 1.
    """

    source: ClassVar[str]
    ranges: ClassVar[Mapping[str, tuple[float, float]]] = {}
    degraded_period: ClassVar[float] = 1.0  # Sa is at this multiple of Ts
    base: ClassVar[str] = "ln"  # logarithm of the equations: ln or log
    unit: ClassVar[str] = "cm"  # of D in the equations
    # What the equations name besides; P(D = 0) is Phi(-z), or 1 where r is 1.
    where: ClassVar[Mapping[str, str]] = {"r": "min(ky / pga, 1)"}
    forms: tuple[Form, ...]

    def __init_subclass__(cls) -> None:
        """Put the equations into the docstring, below its first line."""
        first, _, rest = inspect.cleandoc(cls.__doc__ or "").partition("\n\n")
        cls.__doc__ = f"{first}\n\n{_described(cls)}\n\n{rest}"

    def predict(
        self,
        *,
        ky: ArrayLike,
        pga: ArrayLike | None = None,
        pgv: ArrayLike | None = None,
        M: ArrayLike | None = None,
        Ia: ArrayLike | None = None,
        Sa: ArrayLike | None = None,
        Ts: ArrayLike | None = None,
        Tm: ArrayLike | None = None,
        Neq: ArrayLike | None = None,
        T: ArrayLike | None = None,
    ) -> Prediction:
        """Predict the displacement.

        Parameters
        ----------
        ky : float or array_like
            Yield acceleration [g].
        pga, pgv, M, Ia, Sa, Ts, Tm, Neq, T : float or array_like, optional
            Those of one of the equations of the model: peak ground acceleration [g] and velocity
            [cm/s], moment magnitude, Arias intensity [m/s], spectral acceleration at 5 % damping
            and the multiple of Ts that the model states [g] (the PGA for Ts = 0), initial period of
            the sliding mass [s] (0 is rigid), mean period of the ground motion [s], number of
            equivalent uniform cycles (for example 10 at M 6.75 and 15 at M 7.5, Seed et al. 1975)
            and predominant period of the ground motion [s].

        Returns
        -------
        Prediction

        Raises
        ------
        TypeError
            A combination of arguments that no equation takes.
        ValueError
            An argument that is not positive and finite; Ts or a measure of the motion may be 0.

        Warns
        -----
        RangeWarning
            An argument outside the range of the model.
        PlausibilityWarning
            An argument that is more probable in another unit, such as pgv below 1.
        """
        given = {"ky": ky, "pga": pga, "pgv": pgv, "M": M, "Ia": Ia, "Sa": Sa}
        given |= {"Ts": Ts, "Tm": Tm, "Neq": Neq, "T": T}
        own = {name: value for name, value in given.items() if value is not None}
        form = self._form("predict", own, lambda form: set(form.arguments) == own.keys() - {"ky"})
        return self._predict({name: own[name] for name in ("ky", *form.arguments)}, form)

    def of(
        self,
        motion: GroundMotion | Suite,
        *,
        ky: ArrayLike,
        M: ArrayLike | None = None,
        Ts: ArrayLike | None = None,
        Neq: ArrayLike | None = None,
        T: ArrayLike | None = None,
        measures: Sequence[str] | None = None,
    ) -> Prediction:
        """Predict the displacement under a record, with the measures of this record.

        `pga`, `pgv`, `Ia` and the mean period `Tm` are those of `strong_motion`. `Sa` is the
        pseudo-acceleration at 5 % damping, at the period that the model takes: 1.5 Ts or 1.3 Ts.
        For Ts = 0 it is the PGA. The second and the vertical component do not act.

        Parameters
        ----------
        motion : GroundMotion or Suite
            A record. The records of a suite are along an axis before those of `ky`: with `ky` of
            shape (K,) the result has the shape (records, K), and magnitudes for each record have
            the shape (records, 1). `Ts` is the same for all records.
        ky : float or array_like
            Yield acceleration [g].
        M : float or array_like, optional
            Moment magnitude, if the model takes it.
        Ts : float or array_like, optional
            Period of the sliding mass [s], if the model takes it.
        Neq, T : float or array_like, optional
            As for `predict`: the model defines no measure of a record for them.
        measures : sequence of str, optional
            Which measures to take from the record, such as ``("pga", "Ia")``. Default: the first
            form of the model that takes the other arguments.

        Returns
        -------
        Prediction
            Its `arguments` contain the measures.

        Raises
        ------
        TypeError
            An argument that no form of the model takes, or a missing one.
        ValueError
            A record without motion; an argument out of range.

        Warns
        -----
        RangeWarning
            An argument outside the range of the model.
        PlausibilityWarning
            A measure that is more probable in another unit.
        """
        who = f"{type(self).__name__}.of"
        if not isinstance(motion, (GroundMotion, Suite)):
            raise TypeError(
                f"{who}: motion must be a GroundMotion or a Suite, got {type(motion).__name__}"
            )
        given = {"ky": ky, "M": M, "Ts": Ts, "Neq": Neq, "T": T}
        own = {name: value for name, value in given.items() if value is not None}

        def fits(form: Form) -> bool:  # without `own`, the measures are those asked for
            taken = {name for name in form.arguments if name in _TAKEN and name not in own}
            rest = set(form.arguments) - taken
            return rest == own.keys() - {"ky"} and (measures is None or taken == set(measures))

        form = self._form("of", {**own, **dict.fromkeys(measures or ())}, fits)
        dimensions = np.ndim(own["ky"])
        if isinstance(motion, Suite) and np.ndim(own.get("Ts", 0)) > dimensions:
            raise ValueError(
                f"{who}: with a suite Ts must have at most the dimensions of ky, {dimensions}, got"
                f" {np.ndim(own['Ts'])}"
            )
        taken = [name for name in form.arguments if name not in own]
        found = measured(motion, (name for name in taken if name != "Sa"), dimensions)
        if "Sa" in taken:
            period = self.degraded_period * np.asarray(own["Ts"], float)
            found["Sa"] = spectral(motion, period, dimensions)
        return self._predict({**own, **found}, form)

    def _form(self, who: str, got: Iterable[str], fits: Callable[[Form], bool]) -> Form:
        """The first form that fits."""
        for form in self.forms:
            if fits(form):
                return form
        forms = "; ".join(", ".join(("ky", *form.arguments)) for form in self.forms)
        raise TypeError(f"{type(self).__name__}.{who}: takes {forms}, got {', '.join(got)}")

    def _predict(self, own: dict[str, Any], form: Form) -> Prediction:
        """Check the arguments and evaluate the form, for `predict` or `of`."""
        name = type(self).__name__
        a = checked(name, own, stacklevel=4)
        for key, (low, high) in self.ranges.items():
            if key in a and (beyond := (a[key] < low) | (a[key] > high)).any():
                warnings.warn(
                    f"{name}: {key} is outside the range of the model, {low:g} to {high:g}, got"
                    f" {a[key][beyond].flat[0]:.4g}",
                    RangeWarning,
                    stacklevel=3,
                )
        shape = np.broadcast_shapes(*(array.shape for array in a.values()))
        still = np.zeros(shape, bool)
        for key in OF_MOTION & a.keys():
            still |= a[key] == 0
            a[key] = np.where(a[key] == 0, _NEXT_TO_NOTHING, a[key])
        values = _Values(a, self.where)
        unit = _LN10 if self.base == "log" else 1.0
        with np.errstate(divide="ignore"):  # ln 0 where nothing slides
            mean = unit * values.value(form.equation) + (_CM if self.unit == "cm" else 0.0)
            sigma = None if form.sigma is None else unit * values.value(form.sigma)
            p_zero: Any = 0.0
            if "z" in self.where:
                p_zero = normal_cdf(-values["z"])
            elif "pga" in a:
                p_zero = np.where(values["r"] >= 1, 1.0, 0.0)
        p_zero = np.where(still, 1.0, p_zero)
        median = np.where(p_zero < 1, np.exp(mean), 0.0)
        if sigma is not None:
            sigma = np.broadcast_to(sigma, shape)
        title = f"{name}, {form.name}" if form.name else name
        return Prediction(title, own, median, p_zero, sigma)

    def __eq__(self, other: object) -> bool:
        if type(self) is not type(other):
            return NotImplemented
        return self.__dict__ == other.__dict__

    def __hash__(self) -> int:
        return hash((type(self), *self.__dict__.items()))

    def __repr__(self) -> str:
        return f"{type(self).__name__}()"


def _described(model: type[Regression]) -> str:
    """The equations of a model, and the range of its arguments."""
    lines = []
    for form in model.forms:
        named = ", ".join(filter(None, (form.name, *form.arguments)))
        taken = f"{named}: " if model.forms[1:] else ""
        lines += [f"{taken}{model.base} D = {form.equation}", f"sigma = {form.sigma or 'unknown'}"]
    lines += [f"{name} = {text}" for name, text in model.where.items()]
    notes = "With D in " + ("cm" if model.unit == "cm" else "meters")
    notes += " and log to base 10, also in sigma::" if model.base == "log" else "::"
    whole = (re.sub(r" (?!([+-]|for|else) )", "_", line) for line in lines)  # terms
    lines = [textwrap.fill(f"    {line}", 96, subsequent_indent=" " * 8) for line in whole]
    ends = {"z": "P(D = 0) is Phi(-z). ", "r": "D = 0 for r = 1. "}
    rest = next((text for name, text in ends.items() if name in model.where), "")
    if model.degraded_period != 1:
        rest += f"Sa is at {model.degraded_period:g} Ts. "
    limits = [
        f"{name} from {low:g} to {high:g} {UNITS.get(name, '')}".rstrip()
        for name, (low, high) in model.ranges.items()
    ]
    rest += f"Range: {' and '.join(limits)}; we" if limits else "We"
    rest += f" know no {'other limits' if limits else 'limits of the arguments'}."
    return "\n\n".join((notes, "\n".join(lines).replace("_", " "), textwrap.fill(rest, 100)))
