"""The models: each a table of equations, with what their sources leave open."""

from __future__ import annotations

from typing import Any, ClassVar, Literal

import numpy as np
from numpy.typing import ArrayLike

from .model import Form, Regression

__all__ = [
    "AmbraseysMenu1988",
    "BrayMacedo2019",
    "BrayMacedoTravasarou2018",
    "BrayTravasarou2007",
    "FotopoulouPitilakis2015",
    "Jibson2007",
    "JibsonEtAl2000",
    "RathjeAntonakos2011",
    "RathjeSaygili2009",
    "SaygiliRathje2008",
    "YegianEtAl1991",
]

_OF_PGA_PGV = "-1.56 - 4.58 r - 20.84 r^2 + 44.75 r^3 - 30.50 r^4 - 0.64 ln pga + 1.55 ln pgv"
_OF_PGA_M = "4.89 - 4.85 r - 19.64 r^2 + 42.49 r^3 - 29.06 r^4 + 0.72 ln pga + 0.89 (M - 6)"


class AmbraseysMenu1988(Regression):
    """Rigid blocks, from PGA (Ambraseys and Menu 1988).

    The records are from the near field of earthquakes of magnitude 6.6 to 7.3, which is not an
    argument.

    References
    ----------
    N. N. Ambraseys, J. M. Menu, Earthquake-induced ground displacements, Earthquake Engineering and
    Structural Dynamics 16 (1988), 985-1006. Coefficients as in SLAMMER and the R package newmark.
    """

    source = "Ambraseys and Menu 1988, Earthquake Eng. Struct. Dyn. 16, 985-1006"
    base = "log"
    forms = (Form("", ("pga",), "0.90 + 2.53 log(1 - r) - 1.09 log r", "0.30"),)


class YegianEtAl1991(Regression):
    """Rigid blocks, from PGA, the number of cycles and their period (Yegian et al. 1991).

    The displacement is normalized: the polynomial, D*, has no dimension, and alone is not a
    displacement in centimeters. At ky = pga it leaves log D* = -5.0.

    References
    ----------
    M. K. Yegian, E. A. Marciano, V. G. Ghahraman, Earthquake-induced permanent deformations:
    probabilistic approach, J. Geotechnical Engineering 117 (1991), 35-50. Polynomial as in the R
    package newmark.
    """

    source = "Yegian, Marciano and Ghahraman 1991, J. Geotech. Eng. 117, 35-50"
    base = "log"
    unit = "m"
    forms = (
        Form(
            "",
            ("pga", "Neq", "T"),
            "log(pga g Neq T^2) + 0.22 - 10.12 r + 16.38 r^2 - 11.48 r^3",
            "0.45",
        ),
    )


class JibsonEtAl2000(Regression):
    """Rigid blocks, from Arias intensity (Jibson, Harp and Michael 2000).

    Sigma is unverified: we have not seen it in a source. The model has no limit at ky = pga.

    References
    ----------
    R. W. Jibson, E. L. Harp, J. A. Michael, A method for producing digital probabilistic seismic
    landslide hazard maps, Engineering Geology 58 (2000), 271-289. Coefficients as in SLAMMER and
    OpenQuake.
    """

    source = "Jibson, Harp and Michael 2000, Engineering Geology 58, 271-289"
    base = "log"
    where: ClassVar[dict[str, str]] = {}
    forms = (Form("", ("Ia",), "1.521 log Ia - 1.993 log ky - 1.546", "0.375"),)

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


class Jibson2007(Regression):
    """Rigid blocks, from PGA, magnitude and Arias intensity (Jibson 2007).

    Equation (10) does not vanish at ky = pga: it steps to 0. The range of M is that of equation
    (7); that of ky, for which the records were analyzed, is unverified.

    References
    ----------
    R. W. Jibson, Regression models for estimating coseismic landslide displacement, Engineering
    Geology 91 (2007), 209-218. Coefficients as in SLAMMER and OpenSRA.
    """

    source = "Jibson 2007, Engineering Geology 91, 209-218"
    ranges: ClassVar = {"M": (5.3, 7.6), "ky": (0.05, 0.4)}
    base = "log"
    forms = (
        Form("equation 6", ("pga",), "0.215 + 2.341 log(1 - r) - 1.438 log r", "0.510"),
        Form(
            "equation 7",
            ("pga", "M"),
            "-2.710 + 2.335 log(1 - r) - 1.478 log r + 0.424 M",
            "0.454",
        ),
        Form("equation 9", ("Ia",), "2.401 log Ia - 3.481 log ky - 3.230", "0.656"),
        Form("equation 10", ("pga", "Ia"), "0.561 log Ia - 3.833 log r - 1.474", "0.616"),
    )


class SaygiliRathje2008(Regression):
    """Rigid blocks, from PGA, PGV and Arias intensity (Saygili and Rathje 2008).

    The sigmas of PGA and of PGA, PGV and Ia are those in OpenSRA, which we could not check against
    the paper. Some publications have 20.93 for 20.39; the authors' model with magnitude agrees with
    20.39. The range of ky, for which the records were analyzed, is unverified.

    References
    ----------
    G. Saygili, E. M. Rathje, Empirical predictive models for earthquake-induced sliding
    displacements of slopes, J. Geotech. Geoenviron. Eng. 134 (2008), 790-803. Coefficients as in
    SLAMMER, OpenSRA and OpenQuake.
    """

    source = "Saygili and Rathje 2008, J. Geotech. Geoenviron. Eng. 134, 790-803"
    ranges: ClassVar = {"ky": (0.05, 0.3)}
    forms = (
        Form("PGA and PGV", ("pga", "pgv"), _OF_PGA_PGV, "0.41 + 0.52 r"),
        Form(
            "PGA",
            ("pga",),
            "5.52 - 4.43 r - 20.39 r^2 + 42.61 r^3 - 28.74 r^4 + 0.72 ln pga",
            "1.13",
        ),
        Form(
            "PGA and Ia",
            ("pga", "Ia"),
            "2.39 - 5.24 r - 18.78 r^2 + 42.01 r^3 - 29.15 r^4 - 1.56 ln pga + 1.38 ln Ia",
            "0.46 + 0.56 r",
        ),
        Form(
            "PGA, PGV and Ia",
            ("pga", "pgv", "Ia"),
            "-0.74 - 4.93 r - 19.91 r^2 + 43.75 r^3 - 30.12 r^4 - 1.30 ln pga + 1.04 ln pgv"
            " + 0.67 ln Ia",
            "0.20 + 0.79 r",
        ),
    )


class RathjeSaygili2009(Regression):
    """Rigid blocks, from PGA and magnitude (Rathje and Saygili 2009).

    References
    ----------
    E. M. Rathje, G. Saygili, Probabilistic assessment of earthquake-induced sliding displacements
    of natural slopes, Bull. New Zealand Soc. Earthquake Eng. 42 (2009), 18-27. Coefficients as in
    SLAMMER, OpenQuake and pygeems.
    """

    source = "Rathje and Saygili 2009, Bull. NZ Soc. Earthquake Eng. 42, 18-27"
    forms = (Form("", ("pga", "M"), _OF_PGA_M, "0.732 + 0.789 r - 0.539 r^2"),)


class RathjeAntonakos2011(Regression):
    """Flexible sliding masses, from the models of rigid blocks (Rathje and Antonakos 2011).

    The equations are those of `RathjeSaygili2009` and `SaygiliRathje2008` with the loading of a
    mass of period Ts, and a term of this period. Tm is the mean period of the ground motion.

    References
    ----------
    E. M. Rathje, G. Antonakos, A unified model for predicting earthquake-induced sliding
    displacements of rigid and flexible slopes, Engineering Geology 122 (2011), 51-60. Coefficients
    as in pygeems and OpenSRA.
    """

    source = "Rathje and Antonakos 2011, Engineering Geology 122, 51-60"
    where: ClassVar = {
        "r": "min(ky / kmax, 1)",
        "kmax": "pga exp((0.459 - 0.702 pga) L + (-0.228 + 0.076 pga) L^2)",
        "L": "ln(max(10 Ts / Tm, 1))",
        "kvelmax": "pgv exp(0.240 K + (-0.091 - 0.171 pga) K^2)",
        "K": "ln(max(5 Ts / Tm, 1))",
        "f": "3.69 Ts - 1.22 Ts^2 for Ts <= 1.5, else 2.78",
    }
    forms = (
        Form(
            "PGA and M",
            ("pga", "Ts", "Tm", "M"),
            _OF_PGA_M.replace("pga", "kmax") + " + f",
            "0.694 + 0.322 r",
        ),
        Form(
            "PGA and PGV",
            ("pga", "Ts", "Tm", "pgv"),
            _OF_PGA_PGV.replace("pga", "kmax").replace("pgv", "kvelmax") + " + min(1.42 Ts, 0.71)",
            "0.400 + 0.284 r",
        ),
    )


class BrayTravasarou2007(Regression):
    """Flexible sliding masses, shallow crustal earthquakes (Bray and Travasarou 2007).

    D = 0 means less than 1 cm. For strong ground motions and small ky the polynomial turns: at Sa =
    1 g the median falls with decreasing ky below 0.014 g. The range of ky is unverified.

    References
    ----------
    J. D. Bray, T. Travasarou, Simplified procedure for estimating earthquake-induced deviatoric
    slope displacements, J. Geotech. Geoenviron. Eng. 133 (2007), 381-392, and the authors'
    worksheet.
    """

    source = "Bray and Travasarou 2007, J. Geotech. Geoenviron. Eng. 133, 381-392"
    ranges: ClassVar = {"ky": (0.02, 0.4)}
    degraded_period = 1.5
    where: ClassVar = {
        "a": "-0.22 for Ts < 0.05, else -1.10",
        "z": "-1.76 - 3.22 ln ky - 0.484 Ts ln ky + 3.52 ln Sa",
    }
    forms = (
        Form(
            "",
            ("Sa", "Ts", "M"),
            "a - 2.83 ln ky - 0.333 (ln ky)^2 + 0.566 ln ky ln Sa + 3.04 ln Sa - 0.244 (ln Sa)^2"
            " + 1.50 Ts + 0.278 (M - 7)",
            "0.66",
        ),
    )


class BrayMacedoTravasarou2018(Regression):
    """Flexible sliding masses, subduction earthquakes (Bray, Macedo and Travasarou 2018).

    P(D = 0) is unverified: it is that of pygeems, which we could not check against the paper or an
    example. So is the range of ky.

    References
    ----------
    J. D. Bray, J. Macedo, T. Travasarou, Simplified procedure for estimating seismic slope
    displacements for subduction zone earthquakes, J. Geotech. Geoenviron. Eng. 144 (2018),
    04017124. Coefficients of ln D as in the R package newmark.
    """

    source = "Bray, Macedo and Travasarou 2018, J. Geotech. Geoenviron. Eng. 144, 04017124"
    ranges: ClassVar = {"ky": (0.01, 0.8)}
    degraded_period = 1.5
    where: ClassVar = {
        "a": "-5.864 - 9.421 Ts for Ts < 0.1, else -6.896 + 3.081 Ts - 0.803 Ts^2",
        "z": "-2.64 - 3.20 ln ky - 0.17 (ln ky)^2 - 0.49 Ts ln ky + 2.09 Ts + 2.91 ln Sa"
        " for Ts <= 0.7,"
        " else -3.53 - 4.78 ln ky - 0.34 (ln ky)^2 - 0.30 Ts ln ky - 0.67 Ts + 2.66 ln Sa",
    }
    forms = (
        Form(
            "",
            ("Sa", "Ts", "M"),
            "a - 3.353 ln ky - 0.390 (ln ky)^2 + 0.538 ln ky ln Sa + 3.060 ln Sa - 0.225 (ln Sa)^2"
            " + 0.550 M",
            "0.73",
        ),
    )


class BrayMacedo2019(Regression):
    """Flexible sliding masses, shallow crustal earthquakes, general form (Bray and Macedo 2019).

    Without `pgv` it is taken as at most 115 cm/s. D = 0 means less than 0.5 cm. P(D = 0) is
    unverified: it is that of OpenSRA, which we could not check against the paper or an example. So
    is the range of ky.

    References
    ----------
    J. D. Bray, J. Macedo, Procedure for estimating shear-induced seismic slope displacement for
    shallow crustal earthquakes, J. Geotech. Geoenviron. Eng. 145 (2019), 04019106. Coefficients of
    ln D as in OpenSRA and the R package newmark.
    """

    source = "Bray and Macedo 2019, J. Geotech. Geoenviron. Eng. 145, 04019106"
    ranges: ClassVar = {"ky": (0.01, 0.8)}
    degraded_period = 1.3
    where: ClassVar = {
        "a": "-4.551 - 9.690 Ts for Ts < 0.1, else -5.894 + 3.152 Ts - 0.910 Ts^2",
        "v": "ln pgv - 4.75 for pgv > 115, else 0",
        "z": "-2.46 - 2.98 ln ky - 0.12 (ln ky)^2 - 0.71 Ts ln ky + 1.69 Ts + 2.76 ln Sa"
        " for Ts <= 0.7,"
        " else -3.40 - 4.95 ln ky - 0.30 (ln ky)^2 - 0.33 Ts ln ky - 0.62 Ts + 2.85 ln Sa",
    }
    _OF_SA = (
        "a - 2.491 ln ky - 0.245 (ln ky)^2 + 0.344 ln ky ln Sa + 2.703 ln Sa - 0.089 (ln Sa)^2"
        " + 0.607 M"
    )
    forms = (
        Form("", ("Sa", "Ts", "M", "pgv"), _OF_SA + " + v", "0.74"),
        Form("without PGV", ("Sa", "Ts", "M"), _OF_SA, "0.74"),
    )


class FotopoulouPitilakis2015(Regression):
    """Deformable slopes, from finite elements (Fotopoulou and Pitilakis 2015).

    The sigmas are those in OpenQuake, which we could not check against the paper; we have seen none
    for form d.

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
    unit = "m"
    forms: tuple[Form, ...] = (
        Form("form a", ("pgv", "M"), "-9.891 + 1.873 ln pgv - 5.964 ky + 0.285 M", "0.65"),
        Form("form b", ("pga", "M"), "-2.965 + 2.127 ln pga - 6.583 ky + 0.535 M", "0.72"),
        Form("form c", ("pga", "M"), "-10.246 - 2.165 ln r + 7.844 ky + 0.654 M", "0.75"),
        Form("form d", ("pga", "pgv"), "-8.360 + 1.873 ln pgv - 0.347 ln r - 5.964 ky"),
    )

    def __init__(self, form: Literal["a", "b", "c", "d"] | None = None) -> None:
        self.form = form
        if form is None:
            return
        self.forms = tuple(one for one in self.forms if one.name == f"form {form}")
        if not self.forms:
            raise ValueError(
                f"FotopoulouPitilakis2015: form must be 'a', 'b', 'c' or 'd', got {form!r}"
            )

    def __repr__(self) -> str:
        return f"FotopoulouPitilakis2015({'' if self.form is None else repr(self.form)})"
