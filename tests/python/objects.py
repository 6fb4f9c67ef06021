"""Examples of every public class: a new class is one entry of `EXAMPLES`."""

import math
import warnings

import numpy as np
import stickslip as ss
import stickslip.thesis
from stickslip import harmonic, regressions, theory, thesis
from stickslip._rows import Rows
from stickslip._structures import Modes
from stickslip.carts.sweep import CartFailure
from stickslip.motions.reading import LeftOut
from stickslip.rocking.sweep import RockingFailure
from stickslip.sweeps.directions import OrientationPercentile
from stickslip.sweeps.table import SweepFailure


def two_sided(u):
    """Amplitudes uniform about zero, of mean square 1."""
    return math.sqrt(3) * (2 * u - 1)


ROLLING = ss.Caster(slip_level=1.0, reach=0.5, rolling=0.1)
BLOCK, WHEEL = ss.Coulomb(slip_level=1.0, backward=1.6), ss.Caster(slip_level=1.0, reach=0.5)
CART, DAMPER = ss.Slider(WHEEL, 1.3), ss.ViscousSlider(0.5, 2.0)
ROUND = ss.Coulomb(slip_level=1.0)  # the same in all directions
PAIR = ss.GroundMotion([0, 5.0, -3.0, 0], dt=0.1, transverse=[0, -2.0, 4.0, 0])
BEARING = ss.TriplePendulum([0.4, 2, 2], [0.02, 0.04, 0.08], [0.2, 0.4, 0.4])
LIFTED = ss.GroundMotion(
    [0, 5.0, -3.0, 0], dt=0.1, transverse=[0, -2.0, 4.0, 0], vertical=[0, -12.0, 3.0, 0]
)
LINER = ss.KumarFriction(
    mu_ref=0.06, static_pressure=50e6, reference_pressure=50e6, contact_radius=0.2
)
EVEN = ss.GroundMotion([0.0, 2.0, -2.0, 0.1], dt=0.1, name="M\u00e9xico")
UNEVEN = ss.GroundMotion([0.0, 2.0, -2.0, 0.1], times=[0, 0.1, 0.1, 7], interpolation="constant")
WHITE, BAND = ss.Spectrum.white(s0=1 / 3), ss.Spectrum.band_pass(s0=1.0, low=2.0, high=12.0)
TABLE = ss.Spectrum.from_table([0, 1, 3], [0.1, 1, 0])
SHAKING = ss.GaussianExcitation(BAND, dt=0.1, samples=256)
PULSES = ss.PoissonPulses(rate=3, half_width=1 / 6, sigma=2.5, duration=6)
QUICKER = ss.PoissonPulses(rate=5, half_width=1 / 6, sigma=2.5, duration=6)
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
    ss.integrate(ss.Slider(ROUND, 2, stops=ss.Stops(gap=0.02, restitution=0.5)), LIFTED),
    ss.integrate(ss.Slider(ss.Coulomb(mu=0.3), slope_degrees=5), EVEN),
    ss.integrate(ss.Slider(LINER), EVEN),
    ss.integrate(BEARING, EVEN),
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
ROCKED.append(ss.integrate(ROCKS[0], LIFTED.component("axis"), rotation=0.005, settle=True))

CASTERS = [
    ss.SwivelCaster(at=(0, y), heading=h, slip_level=1, reach=0.1) for y, h in ((0, 1), (1, 2))
]
WHEELS = [ss.FixedWheel(at=(0, y), mu=0.3) for y in (-1, 1)]
FEET = [ss.Foot(at=(0, y), mu=0.3) for y in (-1, 1)]
TRUCK = ss.Cart(
    [
        ss.SwivelCaster(at=(0.9, 0.3), heading=0.3, mu=0.5, trail=0.04, wheel_width=0.03),
        ss.SwivelCaster(
            at=(0.9, -0.3), heading=2, mu=0.5, trail=0.04, wheel_width=0.03, lock="both"
        ),
        ss.FixedWheel(at=(-0.9, 0.3), mu=0.4, rolling_mu=0.01),
        ss.Foot(at=(-0.9, -0.3), mu=0.3),
        ss.SwivelCaster(at=(0, 0), heading=0.1, slip_level=1, reach=math.inf),
    ],
    radius_of_gyration=0.65,
    center=(0, 0),
    outline=[(1, 0.4), (-1, 0.4), (-1, -0.4)],
)
CARTS = [
    ss.Cart(some, radius_of_gyration=1) for some in (CASTERS[:1], WHEELS, [*WHEELS, *CASTERS[:1]])
]
STRONG = 3 * PAIR
ROLLED = [ss.integrate(cart, STRONG, walls=[((9, 0), (0, 1))]) for cart in CARTS]

JIBSON = regressions.Jibson2007()
with warnings.catch_warnings():
    warnings.simplefilter("ignore")
    UNSETTLED = ss.sweep(ss.Coulomb(mu=0), EVEN, settle=True)

# Of each class, objects that differ.
EXAMPLES = {
    ss.Coulomb: [
        BLOCK,
        ROUND,
        ss.Coulomb(mu=0.2),
        ss.Coulomb(slip_level=0.0),
        ss.Coulomb(slip_level=0.1, backward=1 / 3),
        ss.Coulomb(slip_level=1, backward=math.inf),
    ],
    ss.Caster: [
        WHEEL,
        ss.Caster(slip_level=1.0, reach=math.inf),
        ss.Caster(mu=1 / 7, reach=math.inf),
        ss.Caster.from_geometry(mu=0.2, trail=0.03, wheel_width=0.02),
        ROLLING,
    ],
    ss.VelocityDependent: [
        ss.VelocityDependent(slow=0.3, fast=0.6, rate=50),
        ss.VelocityDependent(slow=0.6, fast=0.3, rate=50),
        ss.VelocityDependent(slow=0.3, fast=0.6, rate=20),
        ss.VelocityDependent(mu_slow=0.03, mu_fast=0.06, rate=50),
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
        ss.Degrading(
            distance=[0.05, 1 / 3, 2], slip_level=[1, 1 / 7, 0.5], mu_backward=[0.1, 0, 1 / 3]
        ),
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
        ss.MultiPendulum([1, math.inf], [0.02, 0.05], [0.1, math.inf]),
        ss.QuintuplePendulum([0.15, 0.6, 0.7, 1.9, 2.3], [0.015, 0.03, 0.045, 0.07, 0.1]),
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
        ss.StaticKinetic(WHEEL, static=(1.5, 2.0)),
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
        ss.PlanarSlider(ss.StaticKinetic(ROUND, static=1.2)),
        ss.PlanarSlider(ss.FrictionPendulum(radius=2.2, mu=0.05)),
    ],
    ss.PlanarState: [
        ss.PlanarState(),
        ss.PlanarState((1.0, 0.5)),
        ss.PlanarState((1.0, 0.5), (0.0, 2.0)),
    ],
    ss.PlanarResponse: [
        ss.integrate(ss.PlanarSlider(ROUND), PAIR, settle=True),
        ss.integrate(ss.PlanarSlider(ROUND, 1.3), PAIR, settle=True),
        ss.integrate(ss.PlanarSlider(ROUND), LIFTED),
    ],
    ss.Rayleigh: [ss.Rayleigh(), ss.Rayleigh(alpha=0.1), ss.Rayleigh(beta=0.1)],
    ss.Structure: [
        BUILDING,
        ss.Structure.shear_building(masses=[2], stiffnesses=[30], damping_ratio=0.06),
        COLUMN,
        ss.Structure.from_modes(
            mass_fractions=[0.3, 0.1],
            frequencies=[3, 9],
            damping_ratios=[0.1, 0],
            shapes=[[0.7, 0.3], [1.3, -0.3]],
        ),
    ],
    ss.IsolatedStructure: [
        ss.IsolatedStructure(BLOCK, BUILDING, base_mass=1),
        ss.IsolatedStructure(BLOCK, BUILDING, base_mass=2),
        ss.IsolatedStructure(BLOCK, COLUMN),
        ss.IsolatedStructure(ss.FrictionPendulum(mu=0.05, radius=2.2), COLUMN),
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
        ss.Slider(BLOCK, 2, 0.1, stops=ss.Stops(gap=0.2, restitution=0.5, backward=0.1)),
        ss.Slider(ss.Coulomb(mu=0.3), slope_degrees=5, one_way=True),
        ss.Slider(ss.Degrading(distance=[0, 0.5], mu=[0.3, 0.1]), slope_degrees=5),
        ss.Slider(ss.StaticKinetic(WHEEL, static=2), damping=0.2),
        ss.FrictionPendulum(radius=2, mu=0.05, stops=ss.Stops(gap=0.4, restitution=0.2)),
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
        ss.Envelope(build_up=0, strong_duration=math.inf, decay_rate=0),
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
        ss.Spectrum.from_function(np.exp2, low=0.5, high=3.0),
    ],
    ss.GaussianExcitation: [
        SHAKING,
        SHAKING.refined(2),
        ss.GaussianExcitation(BAND, 0.1, 255),
        ss.GaussianExcitation(BAND, 0.1, 256, period=512, interpolation="constant"),
        ss.GaussianExcitation(
            ss.Spectrum.kanai_tajimi(s0=1, frequency=15, damping=0.6),
            0.02,
            300,
            correct_interpolation=False,
            random_amplitudes=True,
            zero_frequency=True,
            envelope=ss.Envelope(build_up=1, strong_duration=2, decay_rate=0.5),
        ),
        ss.GaussianExcitation(ss.Spectrum.from_function(np.exp2, high=3.0), 0.1, 1024),
        ss.GaussianExcitation(BAND, 0.1, 256, envelope=ss.Envelope.from_table([0, 9], [1, 0])),
    ],
    ss.PoissonPulses: [
        PULSES,
        ss.PoissonPulses(rate=3, half_width=1, sigma=2, duration=6, shape=([0, 1 / 3, 1], [2, -1])),
        ss.PoissonPulses(rate=3, half_width=1, sigma=2, duration=6, stationary_start=True),
        ss.PoissonPulses(rate=3, half_width=1, sigma=2, duration=6, quantile=two_sided),
        ss.PoissonPulses(
            rate=3,
            half_width=1,
            sigma=2,
            duration=6,
            envelope=ss.Envelope(build_up=4, strong_duration=5, decay_rate=0.3),
        ),
        ss.PoissonPulses.from_spectrum(
            ss.Spectrum.kanai_tajimi(s0=1, frequency=15, damping=0.6),
            rate=3,
            duration=6,
            dt=0.05,
        ),
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
        ss.sweep(ss.Slider(ROUND, stops=ss.Stops(gap=0.02, restitution=0.5)), [EVEN, UNEVEN]),
        ss.sweep(ss.PlanarSlider(ROUND, stops=ss.Stops(gap=0.02, restitution=0.5)), PAIR),
        ss.sweep(ss.IsolatedStructure(BLOCK, BUILDING, base_mass=1), EVEN),
        STRIPES,
        UNSETTLED,
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
    ss.Energy: [r.energy for r in RESPONSES[:4]],
    ss.WithVertical: [
        ss.WithVertical(SHAKING),
        ss.WithVertical(SHAKING, ratio=0.5),
        ss.WithVertical(PULSES),
        ss.WithVertical(PULSES, QUICKER, ratio=2),
        ss.WithVertical(ss.WithTransverse(PULSES), QUICKER),
    ],
    ss.WithTransverse: [
        ss.WithTransverse(SHAKING),
        ss.WithTransverse(SHAKING, coherence=0.5),
        ss.WithTransverse(PULSES),
        ss.WithTransverse(PULSES, arrivals="independent"),
        ss.WithTransverse(PULSES, arrivals="independent", coherence=-0.25),
        ss.WithTransverse(PULSES, QUICKER, ratio=2),
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
    ss.Cart: [*CARTS, TRUCK],
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
        ss.run_ensemble(ss.PlanarSlider(ROUND), ss.WithTransverse(SHAKING), members=3, seed=1),
        ss.run_ensemble(
            ss.Slider(ROUND, stops=ss.Stops(gap=0.02, restitution=0.5)), SHAKING, members=3, seed=1
        ),
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
    regressions.Prediction: [JIBSON.predict(ky=ky, pga=0.4) for ky in (0.1, [0.1, 0.2])],
    **{
        model: [model()]
        for model in map(vars(regressions).get, regressions.__all__)
        if issubclass(model, regressions.Regression) and model is not regressions.Regression
    },
    regressions.FotopoulouPitilakis2015: [
        regressions.FotopoulouPitilakis2015(form) for form in (None, "a", "d")
    ],
    regressions.RangeWarning: [regressions.RangeWarning("beyond")],
    Rows: [ss.interfaces(), ss.record_formats()],
    Modes: [BUILDING.modes(), COLUMN.modes()],
    OrientationPercentile: [ss.orientations(BLOCK, TWO, [0, 45]).percentile(p) for p in (0, 50)],
    SweepFailure: [SweepFailure(0, 1, "recorded", "never rests"), *UNSETTLED.failures],
    RockingFailure: [RockingFailure(0, n, 1.0, "recorded", "never rests") for n in (1, 2)],
    CartFailure: [CartFailure(0, n, 1.0, "recorded", "never rests") for n in (1, 2)],
    LeftOut: [LeftOut("a.txt", "no record"), LeftOut("b.txt", "no record")],
}
# Classes of the package that are not in the list, by the reason.
ELSEWHERE = {
    "do work, and hold what cannot be copied": {"Thesis", "Animation"},
    "base classes": {"FrictionLaw", "Regression", "RunError", "OutcomeEnsemble", "OutcomeTable"}
    | {"Saved", "Tabular"},
    "parts of others, which are tuples": {"Bands", "Form"},
    "protocols, which classes of a user follow": {"Excitation", "SliderSource"},
}
