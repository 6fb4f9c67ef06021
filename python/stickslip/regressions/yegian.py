"""The regression of Yegian, Marciano and Ghahraman."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._core import STANDARD_GRAVITY, GroundMotion
from ..motions.suite import Suite
from .model import LN10, Form, LnDisplacement, Regression, ratio
from .prediction import Prediction

__all__ = ["YegianEtAl1991"]


class YegianEtAl1991(Regression):
    """Rigid blocks, from PGA, the number of cycles and their period (Yegian et al. 1991).

    The displacement is normalized. With r = ky / pga and log to base 10::

        D = D* pga g Neq T^2
        log D* = 0.22 - 10.12 r + 16.38 r^2 - 11.48 r^3

    sigma is 0.45 (base 10). D = 0 for ky >= pga; there the polynomial leaves log D* = -5.0. D* has
    no dimension: the formula alone is not a displacement in centimeters. We know no limits of the
    arguments.

    References
    ----------
    M. K. Yegian, E. A. Marciano, V. G. Ghahraman, Earthquake-induced permanent deformations:
    probabilistic approach, J. Geotechnical Engineering 117 (1991), 35-50. Polynomial as in the R
    package newmark.
    """

    forms = (Form("", ("pga", "Neq", "T")),)
    source = "Yegian, Marciano and Ghahraman 1991, J. Geotech. Eng. 117, 35-50"

    def predict(self, *, ky: ArrayLike, pga: ArrayLike, Neq: ArrayLike, T: ArrayLike) -> Prediction:
        """Predict the displacement.

        Parameters
        ----------
        ky, pga : float or array_like
            Yield acceleration and peak ground acceleration [g].
        Neq : float or array_like
            Number of equivalent uniform cycles, for example 10 at M 6.75 and 15 at M 7.5 (Seed et
            al. 1975).
        T : float or array_like
            Predominant period of the ground motion [s].

        Returns
        -------
        Prediction

        Raises
        ------
        ValueError
            An argument that is not positive and finite; a measure of the motion may be 0.
        """
        return self._predict({"ky": ky, "pga": pga, "Neq": Neq, "T": T})

    def of(  # type: ignore[override]  # other arguments than M and Ts
        self,
        motion: GroundMotion | Suite,
        *,
        ky: ArrayLike,
        Neq: ArrayLike,
        T: ArrayLike,
        measures: Sequence[str] | None = None,
    ) -> Prediction:
        """Predict the displacement under a record, with its PGA.

        Parameters
        ----------
        motion : GroundMotion or Suite
            As for the other models.
        ky : float or array_like
            Yield acceleration [g].
        Neq, T : float or array_like
            As for `predict`: the model defines no measure of a record for them.
        measures : sequence of str, optional
            ``("pga",)`` at most.

        Returns
        -------
        Prediction
        """
        return self._of(motion, {"ky": ky, "Neq": Neq, "T": T}, measures)

    def _ln_displacement(self, form: Form, a: Mapping[str, NDArray[Any]]) -> LnDisplacement:
        r, p_zero = ratio(a["ky"], a["pga"])
        log_d = 0.22 - 10.12 * r + 16.38 * r**2 - 11.48 * r**3
        unit = np.log(STANDARD_GRAVITY * a["pga"] * a["Neq"] * a["T"] ** 2)
        return LnDisplacement(LN10 * log_d + unit, 0.45 * LN10, p_zero)
