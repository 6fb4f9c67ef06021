"""The regressions of Jibson."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .model import CM, LN10, Form, LnDisplacement, Regression, ratio
from .prediction import Prediction

__all__ = ["Jibson2007", "JibsonEtAl2000"]


class Jibson2007(Regression):
    """Rigid blocks, from PGA, magnitude and Arias intensity (Jibson 2007).

    The arguments choose the equation. With r = ky / pga and D in cm::

        pga        (6)   log D = 0.215 + log[(1 - r)^2.341 r^-1.438]                 sigma 0.510
        pga, M     (7)   log D = -2.710 + log[(1 - r)^2.335 r^-1.478] + 0.424 M            0.454
        Ia         (9)   log D = 2.401 log Ia - 3.481 log ky - 3.230                       0.656
        pga, Ia    (10)  log D = 0.561 log Ia - 3.833 log r - 1.474                        0.616

    log is to base 10, and so are these sigmas; `Prediction.sigma` is ln 10 times as large. D = 0
    for ky >= pga. Equation (10) does not vanish there: it steps to 0. Range of equation (7): M from
    5.3 to 7.6. The records were analyzed for ky from 0.05 to 0.4 g (unverified); we know no other
    limits.

    References
    ----------
    R. W. Jibson, Regression models for estimating coseismic landslide displacement, Engineering
    Geology 91 (2007), 209-218. Coefficients as in SLAMMER and OpenSRA.
    """

    forms = (
        Form("equation 6", ("pga",)),
        Form("equation 7", ("pga", "M")),
        Form("equation 9", ("Ia",)),
        Form("equation 10", ("pga", "Ia")),
    )
    source = "Jibson 2007, Engineering Geology 91, 209-218"
    ranges: ClassVar = {"M": (5.3, 7.6), "ky": (0.05, 0.4)}

    def predict(
        self,
        *,
        ky: ArrayLike,
        pga: ArrayLike | None = None,
        M: ArrayLike | None = None,
        Ia: ArrayLike | None = None,
    ) -> Prediction:
        """Predict the displacement.

        Parameters
        ----------
        ky : float or array_like
            Yield acceleration [g].
        pga : float or array_like, optional
            Peak ground acceleration [g].
        M : float or array_like, optional
            Moment magnitude.
        Ia : float or array_like, optional
            Arias intensity [m/s].

        Returns
        -------
        Prediction

        Raises
        ------
        TypeError
            A combination of arguments that no equation takes.
        ValueError
            An argument that is not positive and finite; a measure of the motion may be 0.

        Warns
        -----
        RangeWarning
            M outside 5.3 to 7.6; ky outside 0.05 to 0.4 g.
        """
        return self._predict({"ky": ky, "pga": pga, "M": M, "Ia": Ia})

    def _ln_displacement(self, form: Form, a: Mapping[str, NDArray[Any]]) -> LnDisplacement:
        if "pga" not in a:  # (9)
            log_d = 2.401 * np.log10(a["Ia"]) - 3.481 * np.log10(a["ky"]) - 3.230
            return LnDisplacement(LN10 * log_d + CM, 0.656 * LN10)
        r, p_zero = ratio(a["ky"], a["pga"])
        if "Ia" in a:  # (10)
            log_d, sigma = 0.561 * np.log10(a["Ia"]) - 3.833 * np.log10(r) - 1.474, 0.616
        elif "M" in a:  # (7)
            log_d = -2.710 + 2.335 * np.log10(1 - r) - 1.478 * np.log10(r) + 0.424 * a["M"]
            sigma = 0.454
        else:  # (6)
            log_d, sigma = 0.215 + 2.341 * np.log10(1 - r) - 1.438 * np.log10(r), 0.510
        return LnDisplacement(LN10 * log_d + CM, sigma * LN10, p_zero)


class JibsonEtAl2000(Regression):
    """Rigid blocks, from Arias intensity (Jibson, Harp and Michael 2000).

    With D in cm and log to base 10::

        log D = 1.521 log Ia - 1.993 log ky - 1.546

    Sigma 0.375 (base 10) is unverified: we have not seen it in a source. The model has no limit at
    ky = pga. We know no limits of the arguments.

    References
    ----------
    R. W. Jibson, E. L. Harp, J. A. Michael, A method for producing digital probabilistic seismic
    landslide hazard maps, Engineering Geology 58 (2000), 271-289. Coefficients as in SLAMMER and
    OpenQuake.
    """

    forms = (Form("", ("Ia",)),)
    source = "Jibson, Harp and Michael 2000, Engineering Geology 58, 271-289"

    def predict(self, *, ky: ArrayLike, Ia: ArrayLike) -> Prediction:
        """Predict the displacement.

        Parameters
        ----------
        ky : float or array_like
            Yield acceleration [g].
        Ia : float or array_like
            Arias intensity [m/s].

        Returns
        -------
        Prediction

        Raises
        ------
        ValueError
            An argument that is not positive and finite; a measure of the motion may be 0.
        """
        return self._predict({"ky": ky, "Ia": Ia})

    def _ln_displacement(self, form: Form, a: Mapping[str, NDArray[Any]]) -> LnDisplacement:
        log_d = 1.521 * np.log10(a["Ia"]) - 1.993 * np.log10(a["ky"]) - 1.546
        return LnDisplacement(LN10 * log_d + CM, 0.375 * LN10)

    @staticmethod
    def failure_probability(displacement: ArrayLike) -> Any:
        """Probability that a slope with this displacement failed in the Northridge earthquake 1994.

        P = 0.335 (1 - exp(-0.048 D^1.565)), D in cm: at most 0.335. It is the proportion of map
        cells with this predicted displacement in which landslides were found.

        Parameters
        ----------
        displacement : float or array_like
            Predicted displacement [m], at least 0.

        Returns
        -------
        float or ndarray

        Raises
        ------
        ValueError
            A displacement that is negative or not finite.
        """
        d = np.asarray(displacement, float)
        wrong = ~(np.isfinite(d) & (d >= 0))
        if wrong.any():
            raise ValueError(
                "JibsonEtAl2000.failure_probability: displacement must be at least 0 and finite,"
                f" got {d[wrong].flat[0]} m"
            )
        p = -0.335 * np.expm1(-0.048 * (100 * d) ** 1.565)
        return float(p) if p.ndim == 0 else p
