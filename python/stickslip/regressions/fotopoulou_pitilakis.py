"""The regressions of Fotopoulou and Pitilakis."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .model import Form, LnDisplacement, Regression, ratio
from .prediction import Prediction

__all__ = ["FotopoulouPitilakis2015"]

_FORMS = {
    "a": Form("form a", ("pgv", "M")),
    "b": Form("form b", ("pga", "M")),
    "c": Form("form c", ("pga", "M")),
    "d": Form("form d", ("pga", "pgv")),
}


class FotopoulouPitilakis2015(Regression):
    """Deformable slopes, from finite elements (Fotopoulou and Pitilakis 2015).

    With r = ky / pga and D in meters::

        a)  pgv, M    ln D = -9.891 + 1.873 ln pgv - 5.964 ky + 0.285 M                sigma 0.65
        b)  pga, M    ln D = -2.965 + 2.127 ln pga - 6.583 ky + 0.535 M                      0.72
        c)  pga, M    ln D = -10.246 - 2.165 ln r + 7.844 ky + 0.654 M                       0.75
        d)  pga, pgv  ln D = -8.360 + 1.873 ln pgv - 0.347 ln r - 5.964 ky                   unknown

    The sigmas are those in OpenQuake, which we could not check against the paper; we have seen none
    for form d. D = 0 for ky >= pga where the form takes pga. We know no limits of the arguments.

    Parameters
    ----------
    form : {'a', 'b', 'c', 'd'}, optional
        Default: the arguments choose a, b or d. Form c takes the same arguments as b.

    References
    ----------
    S. D. Fotopoulou, K. D. Pitilakis, Predictive relationships for seismically induced slope
    displacements using numerical analysis results, Bull. Earthquake Eng. 13 (2015), 3207-3238.
    Coefficients as in OpenQuake.
    """

    source = "Fotopoulou and Pitilakis 2015, Bull. Earthquake Eng. 13, 3207-3238"

    def __init__(self, form: Literal["a", "b", "c", "d"] | None = None) -> None:
        if form is not None and form not in _FORMS:
            raise ValueError(
                f"FotopoulouPitilakis2015: form must be 'a', 'b', 'c' or 'd', got {form!r}"
            )
        self.form = form

    @property
    def forms(self) -> tuple[Form, ...]:  # type: ignore[override]  # of the object, not the class
        """The forms that the arguments choose from."""
        return tuple(_FORMS.values()) if self.form is None else (_FORMS[self.form],)

    def predict(
        self,
        *,
        ky: ArrayLike,
        pga: ArrayLike | None = None,
        pgv: ArrayLike | None = None,
        M: ArrayLike | None = None,
    ) -> Prediction:
        """Predict the displacement.

        Parameters
        ----------
        ky : float or array_like
            Yield acceleration [g].
        pga : float or array_like, optional
            Peak ground acceleration [g].
        pgv : float or array_like, optional
            Peak ground velocity [cm/s].
        M : float or array_like, optional
            Moment magnitude.

        Returns
        -------
        Prediction

        Raises
        ------
        TypeError
            A combination of arguments that no form takes.
        ValueError
            An argument that is not positive and finite; a measure of the motion may be 0.

        Warns
        -----
        PlausibilityWarning
            pgv below 1, probably in m/s.
        """
        return self._predict({"ky": ky, "pga": pga, "pgv": pgv, "M": M})

    def _ln_displacement(self, form: Form, a: Mapping[str, NDArray[Any]]) -> LnDisplacement:
        ky = a["ky"]
        if form is _FORMS["a"]:
            ln_d = -9.891 + 1.873 * np.log(a["pgv"]) - 5.964 * ky + 0.285 * a["M"]
            return LnDisplacement(ln_d, 0.65)
        r, p_zero = ratio(ky, a["pga"])
        if form is _FORMS["b"]:
            ln_d = -2.965 + 2.127 * np.log(a["pga"]) - 6.583 * ky + 0.535 * a["M"]
            return LnDisplacement(ln_d, 0.72, p_zero)
        if form is _FORMS["c"]:
            ln_d = -10.246 - 2.165 * np.log(r) + 7.844 * ky + 0.654 * a["M"]
            return LnDisplacement(ln_d, 0.75, p_zero)
        ln_d = -8.360 + 1.873 * np.log(a["pgv"]) - 0.347 * np.log(r) - 5.964 * ky
        return LnDisplacement(ln_d, None, p_zero)

    def __repr__(self) -> str:
        return f"FotopoulouPitilakis2015({'' if self.form is None else repr(self.form)})"
