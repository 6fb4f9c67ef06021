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
    Cart,
    CartEnergy,
    CartResponse,
    CartState,
    Caster,
    Clearance,
    ConvergenceError,
    Coulomb,
    Degrading,
    DoublePendulum,
    Drawn,
    ElementMotion,
    Energy,
    Ensemble,
    EnsembleSensitivity,
    Envelope,
    EquipmentOnFloor,
    Estimate,
    FixedWheel,
    FlexibleSlope,
    FloorPeaks,
    Floors,
    Foot,
    FrictionLaw,
    FrictionPendulum,
    GaussianExcitation,
    GroundMotion,
    HarmonicMotion,
    HyperbolicSoil,
    Interval,
    IsolatedStructure,
    KumarFriction,
    Law,
    Lognormal,
    Moments,
    MultiPendulum,
    Normal,
    PendulumLoop,
    PlanarResponse,
    PlanarSlider,
    PlanarState,
    PlausibilityWarning,
    PoissonPulses,
    PulseFit,
    QuintuplePendulum,
    Rayleigh,
    Response,
    ResponseSpectrum,
    RockingBlock,
    RockingEnergy,
    RockingResponse,
    RockingSensitivity,
    RockingState,
    Sensitivity,
    SlenderBlock,
    Slider,
    Spectrum,
    State,
    StaticKinetic,
    Stationary,
    Stops,
    Stribeck,
    StrongMotion,
    Structure,
    StructureResponse,
    StructureState,
    SurfaceHeat,
    SurfaceMotion,
    SwivelCaster,
    TriplePendulum,
    Uniform,
    VelocityDependent,
    VelocitySpectrum,
    ViscousSlider,
    WithTransverse,
    WithVertical,
    __version__,
    advance,
    build_info,
    critical_scales,
    estimate_spectrum,
    fit_pulses,
    histories,
    integrate,
    strong_motion,
)

TYPE_CHECKING = False  # instead of importing `typing`, which takes as long as all of this
if TYPE_CHECKING:
    from . import regressions
    from ._interfaces import interfaces
    from .carts import CartEnsemble, CartTable
    from .comparison import Comparison, compare
    from .ensemble import EnsembleError, Random, ensemble_sensitivity, run_ensemble
    from .ensemble.random_headings import RandomHeadings
    from .motions.directions import RotD, rotd
    from .motions.intensity import IntensityMeasures, SuiteSpectra
    from .motions.records import read_record, read_station, record_formats
    from .motions.samples import sample_record, sample_records
    from .motions.spectra import response_spectrum
    from .motions.suite import Suite
    from .risk.asce43 import ASCE43Estimate, asce43
    from .risk.asce43_rocking import ASCE43RockingEstimate, asce43_rocking
    from .risk.design_chart import DesignChart, design_chart
    from .risk.efficiency import IntensityEfficiency, intensity_efficiency
    from .risk.fragility import Fragility
    from .risk.hazard import Exceedances, Hazard, read_hazard
    from .risk.observations import impact, overturning
    from .risk.yield_acceleration import yield_acceleration
    from .rocking import RockingEnsemble, RockingTable
    from .sweeps import (
        Grid,
        Orientations,
        RockingSpectrum,
        SweepError,
        SweepTable,
        grid,
        orientations,
        rocking_spectrum,
        sliding_spectrum,
        sweep,
    )

__all__ = [
    "STANDARD_GRAVITY",
    "ASCE43Estimate",
    "ASCE43RockingEstimate",
    "Cart",
    "CartEnergy",
    "CartEnsemble",
    "CartResponse",
    "CartState",
    "CartTable",
    "Caster",
    "Clearance",
    "Comparison",
    "ConvergenceError",
    "Coulomb",
    "Degrading",
    "DesignChart",
    "DoublePendulum",
    "Drawn",
    "ElementMotion",
    "Energy",
    "Ensemble",
    "EnsembleError",
    "EnsembleSensitivity",
    "Envelope",
    "EquipmentOnFloor",
    "Estimate",
    "Exceedances",
    "FixedWheel",
    "FlexibleSlope",
    "FloorPeaks",
    "Floors",
    "Foot",
    "Fragility",
    "FrictionLaw",
    "FrictionPendulum",
    "GaussianExcitation",
    "Grid",
    "GroundMotion",
    "HarmonicMotion",
    "Hazard",
    "HyperbolicSoil",
    "IntensityEfficiency",
    "IntensityMeasures",
    "Interval",
    "IsolatedStructure",
    "KumarFriction",
    "Law",
    "Lognormal",
    "Moments",
    "MultiPendulum",
    "Normal",
    "Orientations",
    "PendulumLoop",
    "PlanarResponse",
    "PlanarSlider",
    "PlanarState",
    "PlausibilityWarning",
    "PoissonPulses",
    "PulseFit",
    "QuintuplePendulum",
    "Random",
    "RandomHeadings",
    "Rayleigh",
    "Response",
    "ResponseSpectrum",
    "RockingBlock",
    "RockingEnergy",
    "RockingEnsemble",
    "RockingResponse",
    "RockingSensitivity",
    "RockingSpectrum",
    "RockingState",
    "RockingTable",
    "RotD",
    "Sensitivity",
    "SlenderBlock",
    "Slider",
    "Spectrum",
    "State",
    "StaticKinetic",
    "Stationary",
    "Stops",
    "Stribeck",
    "StrongMotion",
    "Structure",
    "StructureResponse",
    "StructureState",
    "Suite",
    "SuiteSpectra",
    "SurfaceHeat",
    "SurfaceMotion",
    "SweepError",
    "SweepTable",
    "SwivelCaster",
    "TriplePendulum",
    "Uniform",
    "VelocityDependent",
    "VelocitySpectrum",
    "ViscousSlider",
    "WithTransverse",
    "WithVertical",
    "__version__",
    "advance",
    "asce43",
    "asce43_rocking",
    "build_info",
    "compare",
    "critical_scales",
    "design_chart",
    "ensemble_sensitivity",
    "estimate_spectrum",
    "fit_pulses",
    "grid",
    "harmonic",
    "histories",
    "impact",
    "integrate",
    "intensity_efficiency",
    "interfaces",
    "orientations",
    "overturning",
    "read_hazard",
    "read_record",
    "read_station",
    "record_formats",
    "regressions",
    "response_spectrum",
    "rocking_spectrum",
    "rotd",
    "run_ensemble",
    "sample_record",
    "sample_records",
    "sliding_spectrum",
    "strong_motion",
    "sweep",
    "theory",
    "yield_acceleration",
]

if not TYPE_CHECKING:
    # Imported on first use: these need NumPy, which takes ten times as long as the rest.
    _LATER = {
        "_interfaces": ("interfaces",),
        "comparison": ("Comparison", "compare"),
        "ensemble": ("EnsembleError", "Random", "ensemble_sensitivity", "run_ensemble"),
        "motions.directions": ("RotD", "rotd"),
        "motions.intensity": ("IntensityMeasures", "SuiteSpectra"),
        "motions.records": ("read_record", "read_station", "record_formats"),
        "motions.samples": ("sample_record", "sample_records"),
        "motions.spectra": ("response_spectrum",),
        "motions.suite": ("Suite",),
        "risk.design_chart": ("DesignChart", "design_chart"),
        "risk.efficiency": ("IntensityEfficiency", "intensity_efficiency"),
        "risk.fragility": ("Fragility",),
        "risk.hazard": ("Exceedances", "Hazard", "read_hazard"),
        "risk.observations": ("impact", "overturning"),
        "sweeps": (
            "Grid",
            "Orientations",
            "RockingSpectrum",
            "SweepError",
            "SweepTable",
            "grid",
            "orientations",
            "rocking_spectrum",
            "sliding_spectrum",
            "sweep",
        ),
        "risk.asce43": ("ASCE43Estimate", "asce43"),
        "risk.asce43_rocking": ("ASCE43RockingEstimate", "asce43_rocking"),
        "risk.yield_acceleration": ("yield_acceleration",),
        "rocking": ("RockingEnsemble", "RockingTable"),
        "carts": ("CartEnsemble", "CartTable"),
        "ensemble.random_headings": ("RandomHeadings",),
    }

    def __getattr__(name):
        from importlib import import_module

        if name == "regressions":
            return import_module(f"{__name__}.regressions")
        for module, names in _LATER.items():
            if name in names:
                found = getattr(import_module(f"{__name__}.{module}"), name)
                return globals().setdefault(name, found)
        raise AttributeError(f"module 'stickslip' has no attribute {name!r}")

    def __dir__():
        shown = (name for name in globals() if name.startswith("__") or not name.startswith("_"))
        return sorted({*__all__, *shown})


del TYPE_CHECKING
