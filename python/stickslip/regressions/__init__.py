"""Displacements of slopes by regression, each model a class named after its authors and year.

    import stickslip as ss

    d = ss.regressions.BrayTravasarou2007().predict(ky=0.14, Ts=0.33, M=7.5, Sa=0.483)
    print(d.median, d.p_zero, d.quantile([0.16, 0.84]))  # meters
    ss.regressions.Jibson2007().of(ss.sample_record("Kobe"), ky=0.1)  # measures from a record

Arguments have the names and units of the papers, here alone: `ky`, `pga`, `Sa` [g], `pgv` [cm/s],
`Ia` [m/s], `Ts`, `Tm` [s], `M`. They broadcast. Displacements are in meters, and sigma is always
that of ln D.
"""

from .model import RangeWarning, Regression
from .models import (
    AmbraseysMenu1988,
    BrayMacedo2019,
    BrayMacedoTravasarou2018,
    BrayTravasarou2007,
    FotopoulouPitilakis2015,
    Jibson2007,
    JibsonEtAl2000,
    RathjeAntonakos2011,
    RathjeSaygili2009,
    SaygiliRathje2008,
    YegianEtAl1991,
)
from .prediction import Prediction

__all__ = [
    "AmbraseysMenu1988",
    "BrayMacedo2019",
    "BrayMacedoTravasarou2018",
    "BrayTravasarou2007",
    "FotopoulouPitilakis2015",
    "Jibson2007",
    "JibsonEtAl2000",
    "Prediction",
    "RangeWarning",
    "RathjeAntonakos2011",
    "RathjeSaygili2009",
    "Regression",
    "SaygiliRathje2008",
    "YegianEtAl1991",
]
