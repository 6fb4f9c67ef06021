"""The regressions of Saygili, Rathje and Antonakos."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .model import CM, Form, LnDisplacement, Regression, ratio
from .prediction import Prediction

__all__ = ["RathjeAntonakos2011", "RathjeSaygili2009", "SaygiliRathje2008"]


def _of_pga_pgv(r: Any, pga: Any, pgv: Any) -> Any:
    """ln D [cm] of Saygili and Rathje (2008), PGA and PGV."""
    of_r = _polynomial(r, -4.58, -20.84, 44.75, -30.50)
    return -1.56 + of_r - 0.64 * np.log(pga) + 1.55 * np.log(pgv)


def _of_pga_magnitude(r: Any, pga: Any, magnitude: Any) -> Any:
    """ln D [cm] of Rathje and Saygili (2009)."""
    of_r = _polynomial(r, -4.85, -19.64, 42.49, -29.06)
    return 4.89 + of_r + 0.72 * np.log(pga) + 0.89 * (magnitude - 6)


def _polynomial(r: Any, a: float, b: float, c: float, d: float) -> Any:
    """a r + b r^2 + c r^3 + d r^4."""
    return r * (a + r * (b + r * (c + r * d)))


class SaygiliRathje2008(Regression):
    """Rigid blocks, from PGA, PGV and Arias intensity (Saygili and Rathje 2008).

    The arguments choose the form. With r = ky / pga and D in cm::

        pga, pgv      ln D = -1.56 - 4.58 r - 20.84 r^2 + 44.75 r^3 - 30.50 r^4
                             - 0.64 ln pga + 1.55 ln pgv                    sigma 0.41 + 0.52 r
        pga           ln D = 5.52 - 4.43 r - 20.39 r^2 + 42.61 r^3 - 28.74 r^4
                             + 0.72 ln pga                                        1.13
        pga, Ia       ln D = 2.39 - 5.24 r - 18.78 r^2 + 42.01 r^3 - 29.15 r^4
                             - 1.56 ln pga + 1.38 ln Ia                           0.46 + 0.56 r
        pga, pgv, Ia  ln D = -0.74 - 4.93 r - 19.91 r^2 + 43.75 r^3 - 30.12 r^4
                             - 1.30 ln pga + 1.04 ln pgv + 0.67 ln Ia             0.20 + 0.79 r

    D = 0 for ky >= pga. The sigmas of the second and the last form are those in OpenSRA, which we
    could not check against the paper. Some publications have 20.93 for 20.39; the authors' model
    with magnitude agrees with 20.39. The records were analyzed for ky from 0.05 to 0.3 g
    (unverified); we know no other limits.

    References
    ----------
    G. Saygili, E. M. Rathje, Empirical predictive models for earthquake-induced sliding
    displacements of slopes, J. Geotech. Geoenviron. Eng. 134 (2008), 790-803. Coefficients as in
    SLAMMER, OpenSRA and OpenQuake.
    """

    forms = (
        Form("PGA and PGV", ("pga", "pgv")),
        Form("PGA", ("pga",)),
        Form("PGA and Ia", ("pga", "Ia")),
        Form("PGA, PGV and Ia", ("pga", "pgv", "Ia")),
    )
    ranges: ClassVar = {"ky": (0.05, 0.3)}
    source = "Saygili and Rathje 2008, J. Geotech. Geoenviron. Eng. 134, 790-803"

    def predict(
        self,
        *,
        ky: ArrayLike,
        pga: ArrayLike,
        pgv: ArrayLike | None = None,
        Ia: ArrayLike | None = None,
    ) -> Prediction:
        """Predict the displacement.

        Parameters
        ----------
        ky, pga : float or array_like
            Yield acceleration and peak ground acceleration [g].
        pgv : float or array_like, optional
            Peak ground velocity [cm/s].
        Ia : float or array_like, optional
            Arias intensity [m/s].

        Returns
        -------
        Prediction

        Raises
        ------
        ValueError
            An argument that is not positive and finite; a measure of the motion may be 0.

        Warns
        -----
        RangeWarning
            ky outside 0.05 to 0.3 g.
        PlausibilityWarning
            pgv below 1, probably in m/s.
        """
        return self._predict({"ky": ky, "pga": pga, "pgv": pgv, "Ia": Ia})

    def _ln_displacement(self, form: Form, a: Mapping[str, NDArray[Any]]) -> LnDisplacement:
        r, p_zero = ratio(a["ky"], a["pga"])
        ln_pga = np.log(a["pga"])
        sigma: Any
        if "pgv" in a and "Ia" in a:
            of_r = _polynomial(r, -4.93, -19.91, 43.75, -30.12)
            of_motion = -1.30 * ln_pga + 1.04 * np.log(a["pgv"]) + 0.67 * np.log(a["Ia"])
            ln_d, sigma = -0.74 + of_r + of_motion, 0.20 + 0.79 * r
        elif "pgv" in a:
            ln_d, sigma = _of_pga_pgv(r, a["pga"], a["pgv"]), 0.41 + 0.52 * r
        elif "Ia" in a:
            of_r = _polynomial(r, -5.24, -18.78, 42.01, -29.15)
            ln_d, sigma = 2.39 + of_r - 1.56 * ln_pga + 1.38 * np.log(a["Ia"]), 0.46 + 0.56 * r
        else:
            of_r = _polynomial(r, -4.43, -20.39, 42.61, -28.74)
            ln_d, sigma = 5.52 + of_r + 0.72 * ln_pga, 1.13
        return LnDisplacement(ln_d + CM, sigma, p_zero)


class RathjeSaygili2009(Regression):
    """Rigid blocks, from PGA and magnitude (Rathje and Saygili 2009).

    With r = ky / pga and D in cm::

        ln D = 4.89 - 4.85 r - 19.64 r^2 + 42.49 r^3 - 29.06 r^4 + 0.72 ln pga + 0.89 (M - 6)
        sigma = 0.732 + 0.789 r - 0.539 r^2

    D = 0 for ky >= pga. We know no limits of the arguments.

    References
    ----------
    E. M. Rathje, G. Saygili, Probabilistic assessment of earthquake-induced sliding displacements
    of natural slopes, Bull. New Zealand Soc. Earthquake Eng. 42 (2009), 18-27. Coefficients as in
    SLAMMER, OpenQuake and pygeems.
    """

    forms = (Form("", ("pga", "M")),)
    source = "Rathje and Saygili 2009, Bull. NZ Soc. Earthquake Eng. 42, 18-27"

    def predict(self, *, ky: ArrayLike, pga: ArrayLike, M: ArrayLike) -> Prediction:
        """Predict the displacement.

        Parameters
        ----------
        ky, pga : float or array_like
            Yield acceleration and peak ground acceleration [g].
        M : float or array_like
            Moment magnitude.

        Returns
        -------
        Prediction

        Raises
        ------
        ValueError
            An argument that is not positive and finite; a measure of the motion may be 0.
        """
        return self._predict({"ky": ky, "pga": pga, "M": M})

    def _ln_displacement(self, form: Form, a: Mapping[str, NDArray[Any]]) -> LnDisplacement:
        r, p_zero = ratio(a["ky"], a["pga"])
        sigma = 0.732 + 0.789 * r - 0.539 * r**2
        return LnDisplacement(_of_pga_magnitude(r, a["pga"], a["M"]) + CM, sigma, p_zero)


class RathjeAntonakos2011(Regression):
    """Flexible sliding masses, from the models of rigid blocks (Rathje and Antonakos 2011).

    The mass of period Ts changes the seismic loading; Tm is the mean period of the ground motion::

        ln(kmax / pga) = (0.459 - 0.702 pga) L + (-0.228 + 0.076 pga) L^2,  L = ln(10 Ts / Tm)
        ln(kvelmax / pgv) = 0.240 L' + (-0.091 - 0.171 pga) L'^2,          L' = ln(5 Ts / Tm)

    kmax = pga for Ts / Tm < 0.1, and kvelmax = pgv for Ts / Tm < 0.2. The arguments choose the
    form:

    - `pga`, `M`: ln D is that of `RathjeSaygili2009` with kmax, plus 3.69 Ts - 1.22 Ts^2 for Ts up
      to 1.5 s and plus 2.78 above; sigma is 0.694 + 0.322 ky / kmax.
    - `pga`, `pgv`: ln D is that of `SaygiliRathje2008` with kmax and kvelmax, plus 1.42 Ts, but at
      most 0.71; sigma is 0.400 + 0.284 ky / kmax.

    D = 0 for ky >= kmax. We know no limits of the arguments.

    References
    ----------
    E. M. Rathje, G. Antonakos, A unified model for predicting earthquake-induced sliding
    displacements of rigid and flexible slopes, Engineering Geology 122 (2011), 51-60. Coefficients
    as in pygeems and OpenSRA.
    """

    forms = (
        Form("PGA and M", ("pga", "M", "Ts", "Tm")),
        Form("PGA and PGV", ("pga", "pgv", "Ts", "Tm")),
    )
    source = "Rathje and Antonakos 2011, Engineering Geology 122, 51-60"

    def predict(
        self,
        *,
        ky: ArrayLike,
        pga: ArrayLike,
        Ts: ArrayLike,
        Tm: ArrayLike,
        M: ArrayLike | None = None,
        pgv: ArrayLike | None = None,
    ) -> Prediction:
        """Predict the displacement, from either the magnitude or PGV.

        Parameters
        ----------
        ky, pga : float or array_like
            Yield acceleration and peak ground acceleration [g].
        Ts : float or array_like
            Period of the sliding mass [s]; 0 is rigid.
        Tm : float or array_like
            Mean period of the ground motion [s].
        M : float or array_like, optional
            Moment magnitude.
        pgv : float or array_like, optional
            Peak ground velocity [cm/s].

        Returns
        -------
        Prediction

        Raises
        ------
        TypeError
            Neither or both of M and pgv.
        ValueError
            An argument that is not positive and finite; Ts or a measure of the motion may be 0.

        Warns
        -----
        PlausibilityWarning
            pgv below 1, probably in m/s.
        """
        return self._predict({"ky": ky, "pga": pga, "Ts": Ts, "Tm": Tm, "M": M, "pgv": pgv})

    def _ln_displacement(self, form: Form, a: Mapping[str, NDArray[Any]]) -> LnDisplacement:
        pga, period = a["pga"], a["Ts"]
        relative = period / a["Tm"]
        above = np.log(np.maximum(relative / 0.1, 1.0))
        kmax = pga * np.exp((0.459 - 0.702 * pga) * above + (-0.228 + 0.076 * pga) * above**2)
        r, p_zero = ratio(a["ky"], kmax)
        if "M" in a:
            flexible = np.where(period <= 1.5, 3.69 * period - 1.22 * period**2, 2.78)
            ln_d, sigma = _of_pga_magnitude(r, kmax, a["M"]) + flexible, 0.694 + 0.322 * r
        else:
            above = np.log(np.maximum(relative / 0.2, 1.0))
            kvelmax = a["pgv"] * np.exp(0.240 * above + (-0.091 - 0.171 * pga) * above**2)
            ln_d = _of_pga_pgv(r, kmax, kvelmax) + np.minimum(1.42 * period, 0.71)
            sigma = 0.400 + 0.284 * r
        return LnDisplacement(ln_d + CM, sigma, p_zero)
