"""The regressions of Bray, Travasarou and Macedo."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .model import CM, Form, LnDisplacement, Regression
from .prediction import Prediction, normal_cdf

__all__ = ["BrayMacedo2019", "BrayMacedoTravasarou2018", "BrayTravasarou2007"]


def _two_branches(a: Mapping[str, NDArray[Any]], short: Any, long: Any) -> Any:
    """P(D = 0), by one argument of the normal distribution for Ts <= 0.7 s and one above.

    Each is a tuple of the coefficients of 1, ln ky, (ln ky)^2, Ts ln ky, Ts and ln Sa.
    """
    ln_ky, period = np.log(a["ky"]), a["Ts"]
    terms = (1.0, ln_ky, ln_ky**2, period * ln_ky, period, np.log(a["Sa"]))
    first, second = (
        sum(factor * term for factor, term in zip(factors, terms)) for factors in (short, long)
    )
    return normal_cdf(-np.where(period <= 0.7, first, second))


class BrayTravasarou2007(Regression):
    """Flexible sliding masses, shallow crustal earthquakes (Bray and Travasarou 2007).

    With Sa at 1.5 Ts (the PGA for Ts = 0) and D in cm::

        ln D = a1 - 2.83 ln ky - 0.333 (ln ky)^2 + 0.566 ln ky ln Sa + 3.04 ln Sa
               - 0.244 (ln Sa)^2 + 1.50 Ts + 0.278 (M - 7)
        P(D = 0) = 1 - Phi(-1.76 - 3.22 ln ky - 0.484 Ts ln ky + 3.52 ln Sa)

    a1 is -1.10, and -0.22 for nearly rigid masses, Ts < 0.05 s. sigma is 0.66. D = 0 means less
    than 1 cm. For strong ground motions and small ky the polynomial turns: at Sa = 1 g the median
    falls with decreasing ky below 0.014 g. The model was fitted for ky from 0.02 to 0.4 g
    (unverified); we know no other limits.

    References
    ----------
    J. D. Bray, T. Travasarou, Simplified procedure for estimating earthquake-induced deviatoric
    slope displacements, J. Geotech. Geoenviron. Eng. 133 (2007), 381-392, and the authors'
    worksheet.
    """

    forms = (Form("", ("Sa", "Ts", "M")),)
    ranges: ClassVar = {"ky": (0.02, 0.4)}
    source = "Bray and Travasarou 2007, J. Geotech. Geoenviron. Eng. 133, 381-392"
    degraded_period = 1.5

    def predict(self, *, ky: ArrayLike, Sa: ArrayLike, Ts: ArrayLike, M: ArrayLike) -> Prediction:
        """Predict the displacement.

        Parameters
        ----------
        ky : float or array_like
            Yield acceleration [g].
        Sa : float or array_like
            Spectral acceleration at 1.5 Ts and 5 % damping [g]; the PGA for Ts = 0.
        Ts : float or array_like
            Initial period of the sliding mass [s]; 0 is rigid.
        M : float or array_like
            Moment magnitude.

        Returns
        -------
        Prediction

        Raises
        ------
        ValueError
            An argument that is not positive and finite; Ts or a measure of the motion may be 0.

        Warns
        -----
        RangeWarning
            ky outside 0.02 to 0.4 g.
        """
        return self._predict({"ky": ky, "Sa": Sa, "Ts": Ts, "M": M})

    def _ln_displacement(self, form: Form, a: Mapping[str, NDArray[Any]]) -> LnDisplacement:
        ln_ky, ln_sa, period = np.log(a["ky"]), np.log(a["Sa"]), a["Ts"]
        ln_d = (
            np.where(period < 0.05, -0.22, -1.10)
            + ln_ky * (-2.83 - 0.333 * ln_ky + 0.566 * ln_sa)
            + ln_sa * (3.04 - 0.244 * ln_sa)
            + 1.50 * period
            + 0.278 * (a["M"] - 7)
        )
        slides = -1.76 - 3.22 * ln_ky - 0.484 * period * ln_ky + 3.52 * ln_sa
        return LnDisplacement(ln_d + CM, 0.66, normal_cdf(-slides))


class BrayMacedoTravasarou2018(Regression):
    """Flexible sliding masses, subduction earthquakes (Bray, Macedo and Travasarou 2018).

    With Sa at 1.5 Ts (the PGA for Ts = 0) and D in cm::

        ln D = a1 - 3.353 ln ky - 0.390 (ln ky)^2 + 0.538 ln ky ln Sa + 3.060 ln Sa
               - 0.225 (ln Sa)^2 + a2 Ts + a3 Ts^2 + 0.550 M

    (a1, a2, a3) is (-5.864, -9.421, 0) for Ts < 0.1 s, else (-6.896, 3.081, -0.803). sigma is 0.73.
    P(D = 0) = 1 - Phi(z), with::

        z = -2.64 - 3.20 ln ky - 0.17 (ln ky)^2 - 0.49 Ts ln ky + 2.09 Ts + 2.91 ln Sa, Ts <= 0.7 s
        z = -3.53 - 4.78 ln ky - 0.34 (ln ky)^2 - 0.30 Ts ln ky - 0.67 Ts + 2.66 ln Sa, above

    P(D = 0) is unverified: it is that of pygeems, which we could not check against the paper or an
    example. The model was fitted for ky from 0.01 to 0.8 g (unverified); we know no other limits.

    References
    ----------
    J. D. Bray, J. Macedo, T. Travasarou, Simplified procedure for estimating seismic slope
    displacements for subduction zone earthquakes, J. Geotech. Geoenviron. Eng. 144 (2018),
    04017124. Coefficients of ln D as in the R package newmark.
    """

    forms = (Form("", ("Sa", "Ts", "M")),)
    ranges: ClassVar = {"ky": (0.01, 0.8)}
    source = "Bray, Macedo and Travasarou 2018, J. Geotech. Geoenviron. Eng. 144, 04017124"
    degraded_period = 1.5

    def predict(self, *, ky: ArrayLike, Sa: ArrayLike, Ts: ArrayLike, M: ArrayLike) -> Prediction:
        """Predict the displacement; the arguments are those of `BrayTravasarou2007`."""
        return self._predict({"ky": ky, "Sa": Sa, "Ts": Ts, "M": M})

    def _ln_displacement(self, form: Form, a: Mapping[str, NDArray[Any]]) -> LnDisplacement:
        ln_ky, ln_sa, period = np.log(a["ky"]), np.log(a["Sa"]), a["Ts"]
        of_period = np.where(
            period < 0.1,
            -5.864 - 9.421 * period,
            -6.896 + 3.081 * period - 0.803 * period**2,
        )
        ln_d = (
            of_period
            + ln_ky * (-3.353 - 0.390 * ln_ky + 0.538 * ln_sa)
            + ln_sa * (3.060 - 0.225 * ln_sa)
            + 0.550 * a["M"]
        )
        p_zero = _two_branches(
            a, (-2.64, -3.20, -0.17, -0.49, 2.09, 2.91), (-3.53, -4.78, -0.34, -0.30, -0.67, 2.66)
        )
        return LnDisplacement(ln_d + CM, 0.73, p_zero)


class BrayMacedo2019(Regression):
    """Flexible sliding masses, shallow crustal earthquakes, general form (Bray and Macedo 2019).

    With Sa at 1.3 Ts (the PGA for Ts = 0) and D in cm::

        ln D = a1 - 2.491 ln ky - 0.245 (ln ky)^2 + 0.344 ln ky ln Sa + 2.703 ln Sa
               - 0.089 (ln Sa)^2 + a2 Ts + a3 Ts^2 + 0.607 M + max(ln pgv - 4.75, 0)

    (a1, a2, a3) is (-4.551, -9.690, 0) for Ts < 0.1 s, else (-5.894, 3.152, -0.910). The term of
    pgv acts above 115 cm/s; without `pgv` it is left out. sigma is 0.74. P(D = 0) = 1 - Phi(z),
    with::

        z = -2.46 - 2.98 ln ky - 0.12 (ln ky)^2 - 0.71 Ts ln ky + 1.69 Ts + 2.76 ln Sa, Ts <= 0.7 s
        z = -3.40 - 4.95 ln ky - 0.30 (ln ky)^2 - 0.33 Ts ln ky - 0.62 Ts + 2.85 ln Sa, above

    D = 0 means less than 0.5 cm. P(D = 0) is unverified: it is that of OpenSRA, which we could not
    check against the paper or an example. The model was fitted for ky from 0.01 to 0.8 g
    (unverified); we know no other limits.

    References
    ----------
    J. D. Bray, J. Macedo, Procedure for estimating shear-induced seismic slope displacement for
    shallow crustal earthquakes, J. Geotech. Geoenviron. Eng. 145 (2019), 04019106. Coefficients of
    ln D as in OpenSRA and the R package newmark.
    """

    forms = (Form("", ("Sa", "Ts", "M", "pgv")), Form("without PGV", ("Sa", "Ts", "M")))
    ranges: ClassVar = {"ky": (0.01, 0.8)}
    source = "Bray and Macedo 2019, J. Geotech. Geoenviron. Eng. 145, 04019106"
    degraded_period = 1.3

    def predict(
        self,
        *,
        ky: ArrayLike,
        Sa: ArrayLike,
        Ts: ArrayLike,
        M: ArrayLike,
        pgv: ArrayLike | None = None,
    ) -> Prediction:
        """Predict the displacement.

        Parameters
        ----------
        ky : float or array_like
            Yield acceleration [g].
        Sa : float or array_like
            Spectral acceleration at 1.3 Ts and 5 % damping [g]; the PGA for Ts = 0.
        Ts : float or array_like
            Initial period of the sliding mass [s]; 0 is rigid.
        M : float or array_like
            Moment magnitude.
        pgv : float or array_like, optional
            Peak ground velocity [cm/s]. Default: at most 115.

        Returns
        -------
        Prediction

        Raises
        ------
        ValueError
            An argument that is not positive and finite; Ts or a measure of the motion may be 0.

        Warns
        -----
        RangeWarning
            ky outside 0.01 to 0.8 g.
        PlausibilityWarning
            pgv below 1, probably in m/s.
        """
        return self._predict({"ky": ky, "Sa": Sa, "Ts": Ts, "M": M, "pgv": pgv})

    def _ln_displacement(self, form: Form, a: Mapping[str, NDArray[Any]]) -> LnDisplacement:
        ln_ky, ln_sa, period = np.log(a["ky"]), np.log(a["Sa"]), a["Ts"]
        of_period = np.where(
            period < 0.1,
            -4.551 - 9.690 * period,
            -5.894 + 3.152 * period - 0.910 * period**2,
        )
        ln_d = (
            of_period
            + ln_ky * (-2.491 - 0.245 * ln_ky + 0.344 * ln_sa)
            + ln_sa * (2.703 - 0.089 * ln_sa)
            + 0.607 * a["M"]
        )
        if "pgv" in a:
            ln_d = ln_d + np.where(a["pgv"] > 115, np.log(a["pgv"]) - 4.75, 0.0)
        p_zero = _two_branches(
            a, (-2.46, -2.98, -0.12, -0.71, 1.69, 2.76), (-3.40, -4.95, -0.30, -0.33, -0.62, 2.85)
        )
        return LnDisplacement(ln_d + CM, 0.74, p_zero)
