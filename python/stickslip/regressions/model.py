"""What all regressions have in common."""

from __future__ import annotations

import math
import warnings
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._core import GroundMotion
from ..motions.suite import Suite
from .arguments import MEASURES, OF_MOTION, checked, measured, spectral
from .prediction import Prediction

__all__ = ["CM", "LN10", "Form", "LnDisplacement", "RangeWarning", "Regression", "ratio"]

LN10 = math.log(10)
CM = math.log(0.01)  # ln of a centimeter in meters

_NEXT_TO_NOTHING = 1e-9  # of which the logarithm is finite; in place of a measure of 0
_TAKEN = (*MEASURES, "Sa")  # from a record


class RangeWarning(UserWarning):
    """Warning about a value outside the range of the data that a model was fitted to."""


class Form(NamedTuple):
    """One of the equations of a model, chosen by the arguments that it takes beside ky."""

    name: str
    arguments: tuple[str, ...]


class LnDisplacement(NamedTuple):
    """The distribution of the displacement of a form."""

    mean: Any  # of ln D, D in meters, if D > 0
    sigma: Any = None  # of ln D; None if no source gives it
    p_zero: Any = 0.0


class Regression(ABC):
    """A model that predicts the displacement of a slope from measures of the ground motion.

    The subclasses are listed in `stickslip.regressions`. Their method `predict` takes numbers or
    arrays; `of` takes the measures from a record. Where `pga`, `pgv`, `Ia` or `Sa` is 0, as in a
    cell of a map without shaking, nothing moves: the median is 0 and `p_zero` is 1.
    """

    forms: ClassVar[tuple[Form, ...]]
    source: ClassVar[str]
    degraded_period: ClassVar[float] = 1.0  # Sa is at this multiple of Ts
    ranges: ClassVar[Mapping[str, tuple[float, float]]] = {}

    @abstractmethod
    def _ln_displacement(self, form: Form, a: Mapping[str, NDArray[Any]]) -> LnDisplacement:
        """The distribution, from the arguments in the units of the papers."""

    def of(
        self,
        motion: GroundMotion | Suite,
        *,
        ky: ArrayLike,
        M: ArrayLike | None = None,
        Ts: ArrayLike | None = None,
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
        return self._of(motion, {"ky": ky, "M": M, "Ts": Ts}, measures)

    def _of(
        self,
        motion: GroundMotion | Suite,
        given: Mapping[str, Any],
        measures: Sequence[str] | None,
    ) -> Prediction:
        who = f"{type(self).__name__}.of"
        if not isinstance(motion, (GroundMotion, Suite)):
            raise TypeError(
                f"{who}: motion must be a GroundMotion or a Suite, got {type(motion).__name__}"
            )
        own = {name: value for name, value in given.items() if value is not None}
        form = self._form(who, own, measures)
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
        return self._predict({**own, **found}, form, stacklevel=5)

    def _form(self, who: str, own: Mapping[str, Any], measures: Sequence[str] | None) -> Form:
        """The first form whose other arguments are `own` and whose measures are those asked for."""
        for form in self.forms:
            taken = {name for name in form.arguments if name in _TAKEN and name not in own}
            rest = set(form.arguments) - taken
            if rest == own.keys() - {"ky"} and (measures is None or taken == set(measures)):
                return form
        forms = "; ".join(", ".join(("ky", *form.arguments)) for form in self.forms)
        got = ", ".join([*own, *(measures or ())])
        raise TypeError(f"{who}: takes {forms}, got {got}")

    def _predict(
        self, given: Mapping[str, Any], form: Form | None = None, stacklevel: int = 4
    ) -> Prediction:
        """Check the arguments that are not None, choose the form, and evaluate it."""
        name = type(self).__name__
        who = f"{name}.predict"
        own = {key: value for key, value in given.items() if value is not None}
        if form is None:
            form = self._exact_form(who, own)
        a = checked(name, own, stacklevel)
        for key, (low, high) in self.ranges.items():
            if key in a and (beyond := (a[key] < low) | (a[key] > high)).any():
                warnings.warn(
                    f"{name}: {key} is outside the range of the model, {low:g} to {high:g}, got"
                    f" {a[key][beyond].flat[0]:.4g}",
                    RangeWarning,
                    stacklevel=stacklevel - 1,
                )
        shape = np.broadcast_shapes(*(array.shape for array in a.values()))
        still = np.zeros(shape, bool)
        for key in OF_MOTION & a.keys():
            still |= a[key] == 0
            a[key] = np.where(a[key] == 0, _NEXT_TO_NOTHING, a[key])
        with np.errstate(divide="ignore"):  # ln 0 where nothing slides
            mean, sigma, p_zero = self._ln_displacement(form, a)
        p_zero = np.where(still, 1.0, p_zero)
        median = np.where(p_zero < 1, np.exp(mean), 0.0)
        if sigma is not None:
            sigma = np.broadcast_to(sigma, shape)
        title = f"{name}, {form.name}" if form.name else name
        return Prediction(title, own, median, p_zero, sigma)

    def _exact_form(self, who: str, own: Mapping[str, Any]) -> Form:
        for form in self.forms:
            if set(form.arguments) == own.keys() - {"ky"}:
                return form
        forms = "; ".join(", ".join(("ky", *form.arguments)) for form in self.forms)
        raise TypeError(f"{who}: takes {forms}, got {', '.join(own)}")

    def __eq__(self, other: object) -> bool:
        if type(self) is not type(other):
            return NotImplemented
        return self.__dict__ == other.__dict__

    def __hash__(self) -> int:
        return hash((type(self), *self.__dict__.items()))

    def __repr__(self) -> str:
        return f"{type(self).__name__}()"


def ratio(ky: NDArray[Any], demand: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
    """r = ky / demand, at most 1, and the probability that nothing slides: 1 where r reaches 1."""
    r = np.minimum(ky / demand, 1.0)
    return r, np.where(r >= 1, 1.0, 0.0)
