"""How far objects held by friction slide in an earthquake.

A friction law defines a slider; a record or a list of accelerations defines a ground motion.
`integrate` computes the response of the slider to the ground motion, exactly between events::

    import stickslip as ss

    quake = ss.sample_record("Kobe")  # or ss.read_record("your_file")
    r = ss.integrate(ss.Coulomb(mu=0.2), quake)
    print(r.peak, r.residual)  # meters

`run_ensemble` does the same for many members of a random ground motion and computes statistics of
their responses::

    e = ss.run_ensemble(ss.Coulomb(mu=0.2), ss.PoissonPulses.event("great near field"),
                        members=10_000, seed=1)
    print(e.quantile(0.95), e.stationary.growth_rate)

SI units everywhere. Displacement and velocity are relative to the ground; forward is x > 0.
"""

from . import harmonic, theory
from ._core import (
    STANDARD_GRAVITY,
    Caster,
    ConvergenceError,
    Coulomb,
    Degrading,
    Drawn,
    Energy,
    Ensemble,
    EnsembleSensitivity,
    Envelope,
    Estimate,
    FrictionPendulum,
    GaussianExcitation,
    GroundMotion,
    HarmonicMotion,
    Interval,
    KumarFriction,
    Law,
    Lognormal,
    Moments,
    Normal,
    PlausibilityWarning,
    PoissonPulses,
    PulseFit,
    Response,
    ResponseSpectrum,
    Sensitivity,
    Slider,
    Spectrum,
    State,
    StaticKinetic,
    Stationary,
    Stops,
    Stribeck,
    StrongMotion,
    SurfaceHeat,
    Uniform,
    VelocityDependent,
    VelocitySpectrum,
    ViscousSlider,
    WithVertical,
    __version__,
    advance,
    build_info,
    estimate_spectrum,
    fit_pulses,
    histories,
    integrate,
    response_spectrum,
    strong_motion,
)

TYPE_CHECKING = False  # instead of importing `typing`, which takes as long as all of this
if TYPE_CHECKING:
    from ._interfaces import interfaces
    from .comparison import Comparison, compare
    from .directions import RotD, rotd
    from .ensemble import EnsembleError, Random, ensemble_sensitivity, run_ensemble
    from .intensity import IntensityMeasures, SuiteSpectra
    from .records import read_record, read_station, record_formats
    from .samples import sample_record, sample_records
    from .suite import Suite
    from .sweeps import Grid, SweepError, SweepTable, grid, sliding_spectrum, sweep

__all__ = [
    "STANDARD_GRAVITY",
    "Caster",
    "Comparison",
    "ConvergenceError",
    "Coulomb",
    "Degrading",
    "Drawn",
    "Energy",
    "Ensemble",
    "EnsembleError",
    "EnsembleSensitivity",
    "Envelope",
    "Estimate",
    "FrictionPendulum",
    "GaussianExcitation",
    "Grid",
    "GroundMotion",
    "HarmonicMotion",
    "IntensityMeasures",
    "Interval",
    "KumarFriction",
    "Law",
    "Lognormal",
    "Moments",
    "Normal",
    "PlausibilityWarning",
    "PoissonPulses",
    "PulseFit",
    "Random",
    "Response",
    "ResponseSpectrum",
    "RotD",
    "Sensitivity",
    "Slider",
    "Spectrum",
    "State",
    "StaticKinetic",
    "Stationary",
    "Stops",
    "Stribeck",
    "StrongMotion",
    "Suite",
    "SuiteSpectra",
    "SurfaceHeat",
    "SweepError",
    "SweepTable",
    "Uniform",
    "VelocityDependent",
    "VelocitySpectrum",
    "ViscousSlider",
    "WithVertical",
    "__version__",
    "advance",
    "build_info",
    "compare",
    "ensemble_sensitivity",
    "estimate_spectrum",
    "fit_pulses",
    "grid",
    "harmonic",
    "histories",
    "integrate",
    "interfaces",
    "read_record",
    "read_station",
    "record_formats",
    "response_spectrum",
    "rotd",
    "run_ensemble",
    "sample_record",
    "sample_records",
    "sliding_spectrum",
    "strong_motion",
    "sweep",
    "theory",
]

if not TYPE_CHECKING:

    def __getattr__(name):
        # Imported on first use: these need NumPy, which takes ten times as long as the rest.
        if name in ("EnsembleError", "Random", "ensemble_sensitivity", "run_ensemble"):
            from . import ensemble

            return globals().setdefault(name, getattr(ensemble, name))
        if name == "interfaces":
            from . import _interfaces

            return globals().setdefault(name, _interfaces.interfaces)
        if name in ("Comparison", "compare"):
            from . import comparison

            return globals().setdefault(name, getattr(comparison, name))
        if name in ("RotD", "rotd"):
            from . import directions

            return globals().setdefault(name, getattr(directions, name))
        if name in ("IntensityMeasures", "SuiteSpectra"):
            from . import intensity

            return globals().setdefault(name, getattr(intensity, name))
        if name in ("read_record", "read_station", "record_formats"):
            from . import records

            return globals().setdefault(name, getattr(records, name))
        if name in ("sample_record", "sample_records"):
            from . import samples

            return globals().setdefault(name, getattr(samples, name))
        if name == "Suite":
            from . import suite

            return globals().setdefault(name, suite.Suite)
        if name in ("Grid", "SweepError", "SweepTable", "grid", "sliding_spectrum", "sweep"):
            from . import sweeps

            return globals().setdefault(name, getattr(sweeps, name))
        raise AttributeError(f"module 'stickslip' has no attribute {name!r}")

    def __dir__():
        shown = (name for name in globals() if name.startswith("__") or not name.startswith("_"))
        return sorted({*__all__, *shown})


del TYPE_CHECKING
