"""What every class of the package does: pickling, copies, comparison, hash; no use before init."""

import copy
import math
import multiprocessing
import pickle
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor

import numpy as np
import pytest
import stickslip as ss
import stickslip.thesis
from stickslip import harmonic, theory, thesis

ROLLING = ss.Caster(slip_level=1.0, reach=0.5, rolling=0.1)
BLOCK, WHEEL = ss.Coulomb(slip_level=1.0, backward=1.6), ss.Caster(slip_level=1.0, reach=0.5)
CART, DAMPER = ss.Slider(WHEEL, 1.3), ss.ViscousSlider(0.5, 2.0)
ROUND = ss.Coulomb(slip_level=1.0)  # the same in all directions
PAIR = ss.GroundMotion([0, 5.0, -3.0, 0], dt=0.1, transverse=[0, -2.0, 4.0, 0])
BEARING = ss.TriplePendulum([0.4, 2, 2], [0.02, 0.04, 0.08], [0.2, 0.4, 0.4])
EVEN = ss.GroundMotion([0.0, 2.0, -2.0, 0.1], dt=0.1, name="M\u00e9xico")
UNEVEN = ss.GroundMotion([0.0, 2.0, -2.0, 0.1], times=[0, 0.1, 0.1, 7], interpolation="constant")
WHITE, BAND = ss.Spectrum.white(s0=1 / 3), ss.Spectrum.band_pass(s0=1.0, low=2.0, high=12.0)
TABLE = ss.Spectrum.from_table([0, 1, 3], [0.1, 1, 0])
SHAKING = ss.GaussianExcitation(BAND, dt=0.1, samples=256)
PULSES = ss.PoissonPulses(rate=3, half_width=1 / 6, sigma=2.5, duration=6)
LONGER = SHAKING.sample(seed=1, member=0)
TWO = ss.GroundMotion(
    LONGER.acceleration, dt=0.1, transverse=SHAKING.sample(seed=1, member=1).acceleration
)
ENSEMBLE = ss.run_ensemble(BLOCK, SHAKING, members=70, seed=1)
SMALLER = ss.run_ensemble(BLOCK, SHAKING, members=64, seed=1)
QUICK = [one for one in theory.THEORIES if one.name != "Transport"]
COMPARED = ss.compare(ss.Coulomb(slip_level=0.5), PULSES, [2, 4], members=64, theories=QUICK)
SWEPT = ss.sweep(ss.Coulomb(mu=0.1), EVEN)
RESPONSES = [
    ss.integrate(BLOCK, EVEN, displacement=0.01, velocity=-0.3, settle=True),
    ss.integrate(CART, ss.HarmonicMotion(2, 3, 4)),
    ss.integrate(DAMPER, UNEVEN),
    ss.integrate(BLOCK, EVEN),
]
BRANCH = harmonic.continuation(WHEEL, harmonic.orbits(WHEEL, 1.5, 1.0)[-1], 0.9, 1.1)
LINEARIZED = [
    theory.StationaryLinearization().predict(ss.Coulomb(slip_level=level), TABLE)
    for level in (0.5, 0.7, 50.0)
]
DRAWN = thesis.Thesis(members=100)
FIGURES = [DRAWN.figure(number) for number in ("4.3", "A.2", "Table 5.1")]
STATEMENTS = [s for figure in FIGURES for s in figure.statements]
CARRIED = [
    theory.Transport(tolerance=0.3).predict(BLOCK, level, [1.0, 2.0]) for level in (0.3, 0.5)
]
RARE = ss.PoissonPulses(rate=0.01, half_width=1, sigma=2, duration=100)

STRIPES = ss.sweep(
    ss.Coulomb(mu=0.2),
    ss.sample_records().stripes(pga_g=[0.1, 0.2, 0.4, 0.8, 1.6, 3.2]),
    settle=True,
)
CURVES = [
    ss.Fragility.fit(STRIPES, im="pga_g", thresholds=t, separate=True) for t in (0.05, [0.05, 0.1])
]
HAZARD = ss.Hazard([0.01, 0.1, 1, 10], [1, 1e-2, 1e-4, 1e-7], name="pga_g", unit="g")

BUILDING = ss.Structure.shear_building(masses=[2], stiffnesses=[30], damping_ratio=0.05)
COLUMN = ss.Structure.from_modes(mass_fractions=[0.5], frequencies=[8], damping_ratios=[0.05])
FLOORS = ss.run_ensemble(
    ss.IsolatedStructure(BLOCK, BUILDING, base_mass=1), SHAKING, members=3, seed=1
)
ON_BASE = ss.integrate(ss.IsolatedStructure(BLOCK, BUILDING, base_mass=1), EVEN)

ROCKS = [
    ss.SlenderBlock(p=2, alpha=0.01, restitution=0.9),
    ss.SlenderBlock(p=2, alpha=0.01, alpha_left=0.02, restitution=0.9),
]
RIGID = [
    ss.RockingBlock(width=0.02, height=2),
    ss.RockingBlock(width=0.02, height=2, mu=0.3),
    ss.RockingBlock(width=0.02, height=2, mu=0.3, restitution=0.9, center=(0.001, 0.8)),
    ss.RockingBlock(width=0.02, height=2, mu=0.3, lever=0.9, gyration_radius=0.5),
]
ROCKED = [ss.integrate(block, EVEN) for block in (*ROCKS, *RIGID)]

CASTERS = [
    ss.SwivelCaster(at=(0, y), heading=h, slip_level=1, reach=0.1) for y, h in ((0, 1), (1, 2))
]
WHEELS = [ss.FixedWheel(at=(0, y), mu=0.3) for y in (-1, 1)]
FEET = [ss.Foot(at=(0, y), mu=0.3) for y in (-1, 1)]
CARTS = [
    ss.Cart(some, radius_of_gyration=1) for some in (CASTERS[:1], WHEELS, [*WHEELS, *CASTERS[:1]])
]
STRONG = 3 * PAIR
ROLLED = [ss.integrate(cart, STRONG, walls=[((9, 0), (0, 1))]) for cart in CARTS]

# Of each class, objects that differ.
EXAMPLES = {
    ss.Coulomb: [BLOCK, ss.Coulomb(mu=0.2), ss.Coulomb(slip_level=1, backward=float("inf"))],
    ss.Caster: [WHEEL, ss.Caster(slip_level=1.0, reach=float("inf")), ROLLING],
    ss.VelocityDependent: [
        ss.VelocityDependent(slow=0.3, fast=0.6, rate=50),
        ss.VelocityDependent(slow=0.6, fast=0.3, rate=50),
        ss.VelocityDependent(slow=0.3, fast=0.6, rate=20),
    ],
    ss.Stribeck: [
        ss.Stribeck(static=2, kinetic=1, velocity=0.1, exponent=1),
        ss.Stribeck(static=2, kinetic=1, velocity=0.1, exponent=2),
        ss.Stribeck(static=2, kinetic=1, velocity=0.2, exponent=1),
    ],
    ss.Degrading: [
        ss.Degrading(distance=[0, 0.1], mu=[0.3, 0.2]),
        ss.Degrading(distance=[0, 0.2], mu=[0.3, 0.2]),
        ss.Degrading(distance=[0, 0.1], mu=[0.3, 0.2], mu_backward=[0.4, 0.2]),
        ss.Degrading(distance=[0.1], slip_level=[1]),
    ],
    ss.KumarFriction: [
        ss.KumarFriction(
            mu_ref=0.06, static_pressure=50e6, reference_pressure=50e6, contact_radius=0.2
        ),
        ss.KumarFriction(
            mu_ref=0.06, static_pressure=50e6, reference_pressure=50e6, contact_radius=0.2, rate=50
        ),
        ss.KumarFriction(
            mu_ref=0.06,
            static_pressure=50e6,
            reference_pressure=50e6,
            contact_radius=float("inf"),
            conductivity=float("inf"),
        ),
    ],
    ss.MultiPendulum: [
        BEARING,
        ss.MultiPendulum([1, 2], [0.05, 0.06], [0.1, 0.1]),
        ss.DoublePendulum([1, 2], [0.05, 0.06], [0.1, 0.1], restitution=0.3),
        ss.DoublePendulum([1, 2], [0.05, 0.06]),
    ],
    ss.PendulumLoop: [BEARING.trace([0.1]), BEARING.trace([0.1, 0.2])],
    ss.ElementMotion: [ss.integrate(BEARING, motion).elements for motion in (EVEN, EVEN.scaled(2))],
    ss.SurfaceMotion: [ss.integrate(BEARING, motion).surfaces for motion in (EVEN, EVEN.scaled(2))],
    ss.Law: [ss.Law(resist=math.hypot), ss.Law(resist=math.hypot, hold=math.fsum)],
    ss.SurfaceHeat: [ss.SurfaceHeat(), ss.SurfaceHeat(range(42))],
    ss.StaticKinetic: [
        ss.StaticKinetic(static=2, kinetic=1),
        ss.StaticKinetic(static=(2, 3), kinetic=1),
        ss.StaticKinetic(WHEEL, static=2),
        ss.StaticKinetic(ss.Degrading(distance=[0, 0.1], mu=[0.3, 0.2]), mu_static=0.4),
    ],
    ss.Stops: [
        ss.Stops(gap=0.2, restitution=0.5),
        ss.Stops(gap=0.2, restitution=0.5, backward=float("inf")),
        ss.Stops(gap=0.2, restitution=0.4),
    ],
    ss.State: [
        ss.State(),
        ss.State(1.0, 0.5),
        ss.State(1.0, 0.5, 2.0),
        ss.State(1.0, 0.5, heat=ss.SurfaceHeat(range(42))),
        ss.advance(BLOCK, ss.State(), 0.1, 9, vertical_start=-20),
        ss.advance(BEARING, ss.State(), 0.1, 9),
    ],
    ss.PlanarSlider: [
        ss.PlanarSlider(ROUND),
        ss.PlanarSlider(ROUND, 1.3),
        ss.PlanarSlider(ROUND, 1.3, pendulum=True),
        ss.PlanarSlider(ROUND, stops=ss.Stops(gap=0.2, restitution=0.5)),
    ],
    ss.PlanarState: [
        ss.PlanarState(),
        ss.PlanarState((1.0, 0.5)),
        ss.PlanarState((1.0, 0.5), (0.0, 2.0)),
    ],
    ss.PlanarResponse: [
        ss.integrate(ss.PlanarSlider(ROUND), PAIR, settle=True),
        ss.integrate(ss.PlanarSlider(ROUND, 1.3), PAIR, settle=True),
    ],
    ss.Rayleigh: [ss.Rayleigh(), ss.Rayleigh(alpha=0.1), ss.Rayleigh(beta=0.1)],
    ss.Structure: [
        BUILDING,
        ss.Structure.shear_building(masses=[2], stiffnesses=[30], damping_ratio=0.06),
        COLUMN,
    ],
    ss.IsolatedStructure: [
        ss.IsolatedStructure(BLOCK, BUILDING, base_mass=1),
        ss.IsolatedStructure(BLOCK, BUILDING, base_mass=2),
        ss.IsolatedStructure(BLOCK, COLUMN),
    ],
    ss.EquipmentOnFloor: [
        ss.EquipmentOnFloor(BLOCK, BUILDING, floor=1),
        ss.EquipmentOnFloor(BLOCK, BUILDING, floor=1, mass=0.1),
    ],
    ss.HyperbolicSoil: [
        ss.HyperbolicSoil(reference_strain=1e-3),
        ss.HyperbolicSoil(reference_strain=2e-3),
    ],
    ss.FlexibleSlope: [
        ss.FlexibleSlope(ky_g=0.1, height=50, shear_velocity=600),
        ss.FlexibleSlope(ky_g=0.1, height=50, shear_velocity=600, rock_velocity=900, modes=2),
        ss.FlexibleSlope(ky_g=0.1, height=50, shear_velocity=600, method="decoupled"),
        ss.FlexibleSlope(
            ky_g=0.1,
            height=50,
            shear_velocity=600,
            soil=ss.HyperbolicSoil(reference_strain=1e-3),
        ),
        ss.FlexibleSlope(
            ky_g=ss.Degrading(distance=[0, 0.1], ky_g=[0.1, 0.05]), height=50, shear_velocity=600
        ),
    ],
    ss.StructureResponse: [
        ON_BASE,
        ss.integrate(ss.EquipmentOnFloor(BLOCK, BUILDING, floor=1), EVEN),
    ],
    ss.StructureState: [
        ON_BASE.state,
        ss.StructureState([0.1, 0], [0, 0.2]),
        ss.StructureState([0.1, 0], [0, 0.2], displacement=0.01, velocity=-0.1),
        ss.StructureState([0.1, 0], [0, 0.2], sliding_distance=2),
    ],
    ss.Floors: [
        ON_BASE.floors,
        ss.integrate(ss.EquipmentOnFloor(BLOCK, BUILDING, floor=1), EVEN).floors,
    ],
    ss.Slider: [
        CART,
        ss.Slider(WHEEL),
        ss.Slider(BLOCK, 1.3),
        ss.Slider(BLOCK, 1.3, pendulum=True),
        ss.Slider(BLOCK, one_way=True),
        ss.Slider(BLOCK, stops=ss.Stops(gap=0.2, restitution=0.5)),
    ],
    ss.GroundMotion: [
        EVEN,
        UNEVEN,
        ss.GroundMotion([0.0, 2.0, -2.0, 0.1], dt=0.1),
        ss.GroundMotion([0.0, 2.0, -2.0, 0.1], dt=0.1, interpolation="constant"),
        ss.GroundMotion([0.0, 2.0, -2.0, 0.1], dt=0.2),
        ss.GroundMotion([0.0, 2.0, -2.0, 0.1], times=[0, 0.1, 0.2, 0.3]),
        ss.GroundMotion([0.0, 2.0, -2.0, 0.2], dt=0.1),
        ss.GroundMotion([0.0, 2.0, -2.0, 0.1], dt=0.1, transverse=[0, 1, 2, 3]),
        ss.GroundMotion([0.0, 2.0, -2.0, 0.1], dt=0.1, vertical=[0, 1, 2, 3]),
        ss.GroundMotion(
            [0.0, 2.0, -2.0, 0.1], dt=0.1, transverse=[0, 1, 2, 3], vertical=[1, 1, 1, 1]
        ),
        ss.GroundMotion([0.0, 2.0, -2.0, 0.1], dt=0.1, orientation="N28W"),
    ],
    ss.HarmonicMotion: [ss.HarmonicMotion(2, 3, 4), ss.HarmonicMotion(2, 3, 4, dt=0.1)],
    ss.Envelope: [
        ss.Envelope(build_up=1, strong_duration=float("inf"), decay_rate=1 / 3),
        ss.Envelope(build_up=2, strong_duration=2, decay_rate=3),
        ss.Envelope.from_table([0, 1 / 3], [1, 0]),
    ],
    ss.Spectrum: [
        WHITE,
        BAND,
        TABLE,
        ss.Spectrum.kanai_tajimi(s0=1, frequency=15, damping=0.6),
        ss.Spectrum.clough_penzien(
            s0=1, frequency=15, damping=0.6, filter_frequency=1.5, filter_damping=0.6
        ),
        ss.Spectrum.from_function(np.exp2, high=3.0),
    ],
    ss.GaussianExcitation: [
        SHAKING,
        SHAKING.refined(2),
        ss.GaussianExcitation(BAND, 0.1, 256, envelope=ss.Envelope.from_table([0, 9], [1, 0])),
    ],
    ss.PoissonPulses: [
        PULSES,
        ss.PoissonPulses(rate=3, half_width=1, sigma=2, duration=6, shape=([0, 1 / 3, 1], [2, -1])),
    ],
    ss.Lognormal: [ss.Lognormal(0.3, 0.3), ss.Lognormal(0.3, 0.4)],
    ss.Normal: [ss.Normal(1, 2), ss.Normal(1, 2, low=0), ss.Normal(1, 2, high=3)],
    ss.Uniform: [ss.Uniform(1, 2), ss.Uniform(1, 3)],
    ss.Drawn: [ss.Drawn([EVEN, UNEVEN]), ss.Drawn([EVEN]), ss.Drawn([BLOCK, CART])],
    ss.Random: [
        ss.Random(ss.Coulomb, mu=ss.Lognormal(0.3, 0.3)),
        ss.Random(ss.Coulomb, mu=ss.Lognormal(0.3, 0.4)),
        ss.Random(ss.Coulomb, slip_level=ss.Lognormal(0.3, 0.3)),
        ss.Random(ss.Slider, law=ss.Random(ss.Coulomb, mu=ss.Uniform(0.1, 0.2))),
    ],
    ss.Suite: [
        ss.Suite([EVEN, UNEVEN]),
        ss.Suite([EVEN, UNEVEN], {"magnitude": [6.5, float("nan")]}),
        ss.Suite([EVEN, UNEVEN], {"event": ["one", "two"]}),
    ],
    ss.Grid: [ss.grid(ss.Coulomb, mu=[0.1, 0.2]), ss.grid(ss.Coulomb, mu=[0.1])],
    ss.SweepTable: [
        SWEPT,
        ss.sweep(ss.Coulomb(mu=0.1), EVEN, settle=True),
        ss.sweep(ss.Coulomb(mu=0.2), EVEN),
    ],
    ss.IntensityMeasures: [
        ss.Suite([LONGER]).intensity_measures(),
        ss.Suite([LONGER.scaled(2)]).intensity_measures(),
    ],
    ss.SuiteSpectra: [
        ss.response_spectrum(ss.Suite([LONGER]), [0.5, 1]),
        ss.response_spectrum(ss.Suite([LONGER]), [0.5, 2]),
    ],
    ss.RotD: [ss.rotd(TWO, [0.5, 1]), ss.rotd(TWO, [0.5])],
    ss.SweepError: [ss.SweepError("no node here", range(2, 4), SWEPT)],
    ss.Energy: [r.energy for r in RESPONSES],
    ss.WithVertical: [
        ss.WithVertical(SHAKING),
        ss.WithVertical(SHAKING, ratio=0.5),
        ss.WithVertical(PULSES),
    ],
    ss.WithTransverse: [
        ss.WithTransverse(SHAKING),
        ss.WithTransverse(SHAKING, coherence=0.5),
        ss.WithTransverse(PULSES),
        ss.WithTransverse(PULSES, arrivals="independent"),
        ss.WithTransverse(ss.WithVertical(PULSES)),
    ],
    ss.ASCE43Estimate: [ss.asce43(mu=mu, motion=EVEN) for mu in (0.05, 0.1)],
    ss.ASCE43RockingEstimate: [
        ss.asce43_rocking(ss.SlenderBlock(p=2, alpha=a, restitution=0.9), EVEN) for a in (0.1, 0.2)
    ],
    ss.DesignChart: [
        ss.design_chart(ss.Suite([ss.sample_record("Kobe")]), [0.1, 0.2], pga_g=[level])
        for level in (0.4, 0.6)
    ],
    ss.IntensityEfficiency: [
        ss.intensity_efficiency(STRIPES, ["pga_g", "pgv"], periods=periods) for periods in ([], [1])
    ],
    ss.Fragility: CURVES,
    ss.Hazard: [HAZARD, ss.Hazard([0.1, 1], [1e-2, 1e-5], name="pga_g", unit="g")],
    ss.Exceedances: [curve.rate_of_exceedance(HAZARD) for curve in CURVES],
    ss.Orientations: [
        ss.orientations(BLOCK, TWO, [0, 45]),
        ss.orientations(BLOCK, TWO, [0, 46]),
        ss.orientations(BLOCK, TWO, [0, 45], settle=True),
    ],
    ss.EnsembleSensitivity: [
        ss.ensemble_sensitivity(BLOCK, SHAKING, name, members=5, seed=1)
        for name in ("mu", "damping", "scale")
    ],
    ss.Sensitivity: [RESPONSES[0].sensitivity(name) for name in ("mu", "damping", "scale")],
    ss.Response: RESPONSES,
    ss.SlenderBlock: ROCKS,
    ss.RockingBlock: RIGID,
    ss.RockingState: [ss.RockingState(), ss.RockingState(0.1), ss.RockingState(0, 0.1)],
    ss.RockingResponse: ROCKED,
    ss.RockingEnergy: [r.energy for r in ROCKED[:3]],
    ss.RockingSensitivity: [ROCKED[0].sensitivity(name) for name in ("p", "alpha", "scale")],
    ss.RockingTable: [ss.sweep(block, EVEN) for block in (*ROCKS, *RIGID)],
    ss.RockingEnsemble: [ss.run_ensemble(ROCKS[0], EVEN, members=n, seed=1) for n in (1, 2)],
    ss.RockingSpectrum: [ss.rocking_spectrum(EVEN, alpha=a, periods=[2]) for a in (0.01, 0.02)],
    ss.SwivelCaster: CASTERS,
    ss.FixedWheel: WHEELS,
    ss.Foot: FEET,
    ss.Cart: CARTS,
    ss.CartState: [ss.CartState(), ss.CartState((0, 1)), ss.CartState(yaw_rate=1)],
    ss.CartResponse: ROLLED,
    ss.CartEnergy: [r.energy for r in ROLLED],
    ss.Clearance: [ROLLED[0].clearance(((x, 0), (0, 1))) for x in (8, 9)],
    ss.CartTable: [ss.sweep(cart, PAIR) for cart in CARTS],
    ss.CartEnsemble: [ss.run_ensemble(CARTS[0], PAIR, members=n, seed=1) for n in (1, 2)],
    ss.RandomHeadings: [CARTS[i].with_random_headings() for i in (0, 2)],
    ss.ResponseSpectrum: [
        ss.response_spectrum(EVEN, [0, 0.5]),
        ss.response_spectrum(EVEN, [0, 0.5], 0.02),
        ss.response_spectrum(EVEN, [0, 0.5], [0.05, 0.02], kind="velocity"),
    ],
    ss.StrongMotion: [ss.strong_motion(PULSES.sample(seed=1, member=m)) for m in (0, 1)],
    ss.PulseFit: [ss.fit_pulses(PULSES.sample(seed=1, member=m)) for m in (0, 1)],
    ss.Estimate: [ENSEMBLE.stationary.growth_rate, COMPARED.theories["PulseChain"].growth_rate],
    ss.Interval: [ENSEMBLE.quantile(0.5), ENSEMBLE.quantile(0.999)],
    ss.Stationary: [ENSEMBLE.stationary, SMALLER.stationary],
    ss.FloorPeaks: [FLOORS.peak_floor_acceleration, FLOORS.peak_floor_drift],
    ss.VelocitySpectrum: [ENSEMBLE.velocity_spectrum, SMALLER.velocity_spectrum],
    ss.Moments: [
        ENSEMBLE.moments,
        COMPARED.theories["PulseChain"],
        COMPARED.theories["EquivalentLinearization"],
        COMPARED.theories["EquivalentLinearization, laplace"],
        LINEARIZED[0].transient([1, 2]),
    ],
    ss.Ensemble: [
        ENSEMBLE,
        SMALLER,
        ss.run_ensemble(BLOCK, SHAKING, members=70, seed=1, velocity_spectrum=False),
        ss.run_ensemble(BLOCK, SHAKING, members=70, seed=2),
        FLOORS,
    ],
    ss.Comparison: [COMPARED, ss.compare(CART.law, PULSES, [2, 4], members=64, theories=QUICK)],
    ss.ConvergenceError: [ss.ConvergenceError("not yet")],
    ss.PlausibilityWarning: [ss.PlausibilityWarning("other units")],
    ss.EnsembleError: [ss.EnsembleError("no motion here", range(64, 70), SMALLER)],
    harmonic.Orbit: [
        *harmonic.orbits(WHEEL, 0.9, 0.5),
        *harmonic.orbits(ss.Coulomb(mu=0.2), 4, 1),
    ],
    harmonic.OrbitBranch: [
        BRANCH,
        harmonic.continuation(WHEEL, BRANCH[0], 0.9, 1.1, max_step=0.1),
    ],
    theory.Coverage: [
        theory.Coverage(),
        theory.PulseChain().covers(WHEEL, PULSES),
        theory.PulseChain().covers(WHEEL, WHITE),
    ],
    theory.EquivalentLinearization: [
        theory.EquivalentLinearization(),
        theory.EquivalentLinearization("thesis", start="thesis"),
        theory.EquivalentLinearization(tolerance=1e-9),
        theory.EquivalentLinearization("laplace", filter_order=6),
        theory.EquivalentLinearization(max_misfit=0.5),
        theory.EquivalentLinearization(dimensions=2),
    ],
    theory.HarmonicSolution: theory.SlowlyVaryingParameters(CART).response(3, 1.2),
    theory.DisplacementDistribution: [
        theory.PulseSuperposition().distribution(BLOCK, RARE, 50),
        theory.PulseSuperposition().distribution(BLOCK, RARE, 60),
        theory.PulseChain().distribution(BLOCK, RARE, 50),
        CARRIED[0].displacement(2),
    ],
    theory.PulseChain: [theory.PulseChain(), theory.PulseChain(refined=True)],
    theory.Transport: [theory.Transport(), theory.Transport(tolerance=0.1)],
    theory.TransportPrediction: CARRIED,
    theory.VelocityDistribution: [CARRIED[0].velocity(t) for t in (1, 2)],
    theory.StationaryVelocity: [
        theory.StationaryVelocity(BLOCK, 0.3),
        theory.StationaryVelocity(
            ss.Stribeck(static=1.3, kinetic=0.8, velocity=0.3, exponent=1), 0.3
        ),
    ],
    theory.TransportCost: [one.cost for one in CARRIED],
    theory.TransportStationary: [one.stationary for one in CARRIED],
    theory.TransportPeak: [CARRIED[0].peak(t) for t in (1, 2)],
    theory.PulseResponse: [
        theory.pulse_response(BLOCK, 2, 0.1),
        theory.viscous_pulse_response(1, 2, 0.1, times=[]),
    ],
    theory.PulseSuperposition: [
        theory.PulseSuperposition(overlap) for overlap in ("none", "thesis", "renewal")
    ],
    theory.ShapingFilter: [
        theory.ShapingFilter(0.3),
        theory.ShapingFilter(0.3, [(0, 1, 4, 1, 4)]),
        theory.ShapingFilter.of(BAND, order=6),
    ],
    theory.SlowlyVaryingParameters: [
        theory.SlowlyVaryingParameters(CART),
        theory.SlowlyVaryingParameters(WHEEL),
    ],
    theory.StationaryLinearization: [theory.StationaryLinearization()],
    theory.StationaryPrediction: LINEARIZED,
    theory.TransitionTime: [theory.transition_time(WHEEL, s0) for s0 in (0.01, 0.02)],
    theory.WhiteNoise: [
        theory.WhiteNoise(),
        theory.WhiteNoise(BLOCK, WHITE),
        theory.WhiteNoise(BLOCK, 2),
        theory.WhiteNoise.coulomb(1, 2, dimensions=2),
    ],
    thesis.ThesisCheck: FIGURES[0].check()[:2],
    thesis.ThesisCurve: [c for figure in FIGURES for panel in figure.panels for c in panel.curves],
    thesis.ThesisFigure: FIGURES,
    thesis.ThesisPanel: [panel for figure in FIGURES for panel in figure.panels],
    thesis.ThesisStatement: STATEMENTS,
}
# No values: one draws, tells how far it is, and remembers ensembles; the other is a base class.
DOES_WORK = {thesis.Thesis, ss.FrictionLaw}

PUBLIC = {
    thing
    for module in (ss, harmonic, theory, thesis)
    for thing in (getattr(module, name) for name in module.__all__)
    if isinstance(thing, type)
}


def content(thing):
    """All that an object shows, to the bit, in what Python compares."""
    if isinstance(thing, np.ndarray):
        return thing.dtype.str, thing.shape, thing.tobytes()
    if isinstance(thing, float | complex | np.generic):
        return content(np.asarray(thing))
    if isinstance(thing, list | tuple | range):
        return type(thing), [content(element) for element in thing]
    if hasattr(thing, "toarray"):  # a sparse matrix
        return content(thing.toarray())
    if isinstance(thing, dict):
        return {name: content(value) for name, value in thing.items()}
    if type(thing) not in EXAMPLES:
        part = type(thing).__module__.startswith("stickslip.") and hasattr(thing, "__dict__")
        return content(vars(thing)) if part and type(thing).__eq__ is object.__eq__ else thing
    shown = {"repr": repr(thing)} if type(thing) is not ss.Comparison else {}
    for name in dir(thing):
        if name.startswith("__") or name == "with_traceback":
            continue
        try:
            value = getattr(thing, name)
        except ValueError as error:
            value = str(error)
        if not callable(value):
            shown[name] = content(value)
    return shown


def twins(thing):
    return [
        *(pickle.loads(pickle.dumps(thing, p)) for p in range(pickle.HIGHEST_PROTOCOL + 1)),
        copy.copy(thing),
        copy.deepcopy(thing),
    ]


def is_same(twin, thing, expected):
    assert type(twin) is type(thing)
    assert twin is not thing
    assert content(twin) == expected
    if not isinstance(thing, Exception):
        assert twin == thing
        assert not twin != thing  # noqa: SIM202
        assert type(thing).__hash__ is None or hash(twin) == hash(thing)


def test_of_every_public_class_there_is_an_example():
    assert EXAMPLES.keys() | DOES_WORK == PUBLIC
    assert all(EXAMPLES.values())


# Read from a file, this class carries the motion again.
SLOW = {theory.DisplacementDistribution}


@pytest.mark.parametrize(
    "kind",
    [pytest.param(kind, marks=[pytest.mark.slow] * (kind in SLOW)) for kind in EXAMPLES],
    ids=lambda kind: kind.__name__,
)
def test_pickled_and_copied_all_is_the_same_to_the_bit(kind):
    for thing in EXAMPLES[kind]:
        expected = content(thing)
        for twin in twins(thing):
            is_same(twin, thing, expected)


@pytest.mark.slow
def test_all_go_through_other_processes():
    things = [example for examples in EXAMPLES.values() for example in examples]
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as pool:
        for twin, thing in zip(pool.map(copy.deepcopy, things), things, strict=True):
            is_same(twin, thing, content(thing))


@pytest.mark.parametrize("kind", EXAMPLES, ids=lambda kind: kind.__name__)
def test_what_differs_compares_different(kind):
    examples = EXAMPLES[kind]
    for i, one in enumerate(examples):
        assert [one == other for other in examples] == [i == k for k in range(len(examples))]
        assert [one != other for other in examples] == [i != k for k in range(len(examples))]
        for stranger in (None, 1.0, "", kind, EVEN if kind is not ss.GroundMotion else DAMPER):
            assert not one == stranger  # noqa: SIM201
            assert one != stranger


def test_what_can_change_has_no_hash_and_all_else_has_one():
    unhashable = {kind for kind in EXAMPLES if kind.__hash__ is None}
    tables = {ss.SweepTable, ss.IntensityMeasures, ss.SuiteSpectra, ss.RotD, ss.Orientations}
    tables |= {ss.RockingTable, ss.RockingEnsemble, ss.RockingSpectrum}
    tables |= {ss.CartTable, ss.CartEnsemble}
    tables |= {ss.Fragility, ss.Hazard, ss.Exceedances, ss.DesignChart, ss.IntensityEfficiency}
    assert unhashable == {ss.Ensemble, ss.Comparison, ss.Grid} | tables
    for kind in EXAMPLES.keys() - unhashable:
        assert len({*EXAMPLES[kind], *EXAMPLES[kind]}) == len(EXAMPLES[kind])


def test_a_response_keeps_what_it_came_from_when_it_is_pickled():
    first, *others = pickle.loads(pickle.dumps([ss.integrate(BLOCK, EVEN) for _ in range(3)]))
    assert first.motion == EVEN
    assert all(other.motion is first.motion for other in others)
    assert not first.displacement.flags.writeable


def test_zeros_of_either_sign_are_equal_and_hash_alike():
    plus, minus = (ss.GroundMotion([0, zero, 1], dt=0.1) for zero in (0.0, -0.0))
    assert plus == minus
    assert hash(plus) == hash(minus)


def test_an_ensemble_is_equal_however_it_was_put_together():
    parts = [
        ss.run_ensemble(BLOCK, SHAKING, members=n, seed=1, first_member=first)
        for first, n in ((64, 6), (0, 64))
    ]
    whole = parts[0]
    assert whole != ENSEMBLE
    whole.merge(parts[1])
    assert whole == ENSEMBLE


class OwnMotion(ss.GroundMotion):
    pass


def test_what_is_derived_from_a_class_stays_what_it_is():
    own = OwnMotion([0.0, 2.0, -2.0, 0.1], dt=0.1, name="M\u00e9xico")
    for twin in twins(own):
        assert type(twin) is OwnMotion
        assert twin == own == EVEN


# ---- objects that were never initialized

UNFINISHED = """
import pickle
import stickslip as ss
from stickslip import harmonic, theory, thesis

motion = ss.GroundMotion([0, 1], dt=1)

def check(kind, what, use):
    try:
        use()
    except TypeError:
        return
    except Exception as error:
        print(kind.__name__, what, "raises", repr(error))
    else:
        print(kind.__name__, what, "works")

for module in (ss, harmonic, theory, thesis):
    for kind in map(vars(module).get, module.__all__):
        if type(kind).__name__ != "pybind11_type":
            continue
        def make():
            return kind.__new__(kind)
        check(kind, "pickle", lambda: pickle.dumps(make()))
        if kind not in (thesis.Thesis, ss.FrictionLaw):
            check(kind, "repr", lambda: repr(make()))
            check(kind, "==", lambda: make() == make())
            check(kind, "hash", lambda: hash(make()))
            check(kind, "len", lambda: len(make()))
        for name, member in vars(kind).items():
            if type(member) is property:
                check(kind, name, lambda: getattr(make(), name))
        for name, member in vars(kind).items():
            if not name.startswith("__") and type(member).__name__ == "instancemethod":
                check(kind, name + "()", lambda: getattr(make(), name)(*[1] * 2))
                check(kind, name + "()", lambda: getattr(make(), name)())

class Early(ss.GroundMotion):
    def __init__(self):
        check(Early, "repr", lambda: repr(self))
        super().__init__([0, 1], dt=1)

repr(Early())
slider = ss.Slider.__new__(ss.Slider)
check(ss.Slider, "argument", lambda: ss.integrate(slider, motion))
check(ss.Coulomb, "argument", lambda: ss.integrate(ss.Coulomb.__new__(ss.Coulomb), motion))
empty = ss.GroundMotion.__new__(ss.GroundMotion)
check(ss.GroundMotion, "argument", lambda: ss.integrate(ss.Coulomb(mu=1), empty))
check(ss.Coulomb, "law", lambda: ss.Slider(ss.Coulomb.__new__(ss.Coulomb)))
print("alive")
"""


def test_an_object_that_was_never_initialized_is_a_type_error_wherever_it_is_used():
    result = subprocess.run([sys.executable, "-c", UNFINISHED], capture_output=True, text=True)
    assert (result.returncode, result.stdout, result.stderr) == (0, "alive\n", "")
