"""The regression of Ambraseys and Menu."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .model import CM, LN10, Form, LnDisplacement, Regression, ratio
from .prediction import Prediction

__all__ = ["AmbraseysMenu1988"]


class AmbraseysMenu1988(Regression):
    """Rigid blocks, from PGA (Ambraseys and Menu 1988).

    With r = ky / pga, D in cm and log to base 10::

        log D = 0.90 + log[(1 - r)^2.53 r^-1.09]

    sigma is 0.30 (base 10). D = 0 for ky >= pga. The records are from the near field of earthquakes
    of magnitude 6.6 to 7.3, which is not an argument; we know no limits of r.

    References
    ----------
    N. N. Ambraseys, J. M. Menu, Earthquake-induced ground displacements, Earthquake Engineering and
    Structural Dynamics 16 (1988), 985-1006. Coefficients as in SLAMMER and the R package newmark.
    """

    forms = (Form("", ("pga",)),)
    source = "Ambraseys and Menu 1988, Earthquake Eng. Struct. Dyn. 16, 985-1006"

    def predict(self, *, ky: ArrayLike, pga: ArrayLike) -> Prediction:
        """Predict the displacement.

        Parameters
        ----------
        ky, pga : float or array_like
            Yield acceleration and peak ground acceleration [g].

        Returns
        -------
        Prediction

        Raises
        ------
        ValueError
            An argument that is not positive and finite; a measure of the motion may be 0.
        """
        return self._predict({"ky": ky, "pga": pga})

    def _ln_displacement(self, form: Form, a: Mapping[str, NDArray[Any]]) -> LnDisplacement:
        r, p_zero = ratio(a["ky"], a["pga"])
        log_d = 0.90 + 2.53 * np.log10(1 - r) - 1.09 * np.log10(r)
        return LnDisplacement(LN10 * log_d + CM, 0.30 * LN10, p_zero)
