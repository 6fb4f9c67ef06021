"""How far a thing held by friction slides in an earthquake.

A friction law makes a slider, a record or a list of numbers makes a ground motion, and
`integrate` slides the one through the other, exactly between events::

    import stickslip as ss

    quake = ss.read_record("kobe.AT2")
    r = ss.integrate(ss.Coulomb(mu=0.2), quake)
    print(r.peak, r.residual)  # metres

SI units everywhere. Displacement and velocity are relative to the ground; forward is x > 0.
"""

from ._core import (
    STANDARD_GRAVITY,
    Caster,
    ConvergenceError,
    Coulomb,
    Energy,
    Ensemble,
    Envelope,
    Estimate,
    GaussianExcitation,
    GroundMotion,
    Interval,
    PoissonPulses,
    Response,
    Slider,
    Spectrum,
    Stationary,
    VelocitySpectrum,
    __version__,
    build_info,
    integrate,
    read_record,
)
from .ensemble import EnsembleError, run_ensemble

__all__ = [
    "STANDARD_GRAVITY",
    "Caster",
    "ConvergenceError",
    "Coulomb",
    "Energy",
    "Ensemble",
    "EnsembleError",
    "Envelope",
    "Estimate",
    "GaussianExcitation",
    "GroundMotion",
    "Interval",
    "PoissonPulses",
    "Response",
    "Slider",
    "Spectrum",
    "Stationary",
    "VelocitySpectrum",
    "__version__",
    "build_info",
    "integrate",
    "read_record",
    "run_ensemble",
]
