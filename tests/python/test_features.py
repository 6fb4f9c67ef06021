"""The tables of docs/features.md: each cell is tried, and says what the library does."""

import contextlib
import itertools
import json
import math
import pickle
import re
import warnings

import numpy as np
import pytest
import stickslip as ss
from pages import ROOT
from stickslip import harmonic, theory

G = ss.STANDARD_GRAVITY
M = np.arange(161)
FADE = np.sin(np.pi * M / 160) ** 2
AXIS = FADE * (2.5 * np.sin(0.7 * M) + 1.5 * np.cos(1.9 * M + 0.4))
UP = FADE * 14 * np.cos(0.9 * M + 0.2)
QUAKE = ss.GroundMotion(AXIS, dt=0.05)
SHAKEN = ss.GroundMotion(AXIS, dt=0.05, vertical=UP)
UNEVEN = ss.GroundMotion(AXIS, times=0.05 * M + 0.01 * np.sin(M) * np.sin(np.pi * M / 160))
HELD = ss.GroundMotion(AXIS, dt=0.05, interpolation="constant")
COSINE = ss.HarmonicMotion(2.5, 4.0, 8.0, dt=0.05)
STOPS = ss.Stops(gap=0.02, restitution=0.4)
BLOCK = ss.Coulomb(mu=0.05)


def resist(x, speed, direction):
    """A law of one's own."""
    return 0.5 + 0.3 * math.exp(-20 * speed)


# By name: the slider on a spring, the law alone (for theories), the ground motion, and options.
LAWS = {
    "`Coulomb`": BLOCK,
    "`Coulomb`, unequal levels": ss.Coulomb(mu=0.05, mu_backward=0.08),
    "`StaticKinetic`": ss.StaticKinetic(mu_static=0.07, mu_kinetic=0.05),
    "`Caster`": ss.Caster(mu=0.05, reach=0.1),
    "`VelocityDependent`": ss.VelocityDependent(mu_slow=0.03, mu_fast=0.06, rate=50),
    "`Stribeck`": ss.Stribeck(mu_static=0.08, mu_kinetic=0.05, velocity=0.1, exponent=2),
    "`Degrading`": ss.Degrading(distance=[0, 0.1], mu=[0.07, 0.04]),
    "`KumarFriction`": ss.KumarFriction(
        mu_ref=0.06, static_pressure=50e6, reference_pressure=50e6, contact_radius=0.2
    ),
    "`MultiPendulum`": ss.DoublePendulum([1.5, 3], [0.04, 0.06]),
    "`Law`": ss.Law(resist=resist),
}
SPRING = {"period": 2.0}
ROWS = {name: (ss.Slider(law, **SPRING), law, QUAKE, "flight") for name, law in LAWS.items()} | {
    "spring and damper": (
        ss.Slider(BLOCK, damping_ratio=0.05, **SPRING),
        ss.Slider(BLOCK, damping_ratio=0.05, **SPRING),
        QUAKE,
        "flight",
    ),
    "`FrictionPendulum`": (
        ss.FrictionPendulum(radius=1, mu=0.05),
        ss.FrictionPendulum(radius=1, mu=0.05),
        QUAKE,
        "flight",
    ),
    "stops": (
        ss.Slider(BLOCK, stops=STOPS, **SPRING),
        ss.Slider(BLOCK, stops=STOPS),
        QUAKE,
        "flight",
    ),
    "slope": (
        ss.Slider(ss.Coulomb(mu=0.15), slope_degrees=5, period=0.7),
        ss.Slider(ss.Coulomb(mu=0.2), slope_degrees=5),
        QUAKE,
        "flight",
    ),
    "one-way": (
        ss.Slider(BLOCK, one_way=True, **SPRING),
        ss.Slider(BLOCK, one_way=True),
        QUAKE,
        "flight",
    ),
    "vertical motion, flight": (ss.Slider(BLOCK, **SPRING), None, SHAKEN, "flight"),
    "vertical motion, clipped": (ss.Slider(BLOCK, **SPRING), None, SHAKEN, "clipped"),
    "pendulum, vertical motion": (
        ss.FrictionPendulum(radius=1, mu=0.05),
        None,
        SHAKEN,
        "clipped",
    ),
    "stops, vertical motion": (
        ss.Slider(BLOCK, stops=STOPS, **SPRING),
        None,
        SHAKEN,
        "flight",
    ),
    "uneven times": (ss.Slider(BLOCK, **SPRING), None, UNEVEN, "flight"),
    "held values": (ss.Slider(BLOCK, **SPRING), None, HELD, "flight"),
    "`HarmonicMotion`": (ss.Slider(BLOCK, **SPRING), None, COSINE, "flight"),
    "`ViscousSlider`": (ss.ViscousSlider(0.5, 3.0), ss.ViscousSlider(0.5, 3.0), QUAKE, "flight"),
}

# Why a cell is not "yes": the letter of its footnote, by what the refusal says.
REASONS = {
    "a": r"covers Coulomb friction, also with a static level|law whose level changes|law given as",
    "b": r"must not leave the ground",
    "c": r"static friction above kinetic: its response jumps",
    "d": r"got stops: near a grazing impact",
    "e": r"HarmonicMotion|must be a GroundMotion|an Excitation",
    "f": r"does not come to rest",
}
THEORY_REASONS = {
    "g": r"depends on the (speed|distance)|static friction|take power series",
    "h": r"on level ground that slide both ways|covers sliders without stops",
    "i": r"a spring is not covered|known with a spring",
    "j": r"with a damper",
    "k": r"covers Coulomb friction",
    "l": r"both ways|mirrored slip",
    "m": r"level must be positive",
    "n": r"exceeds any friction at rest",
    "o": r"laws with memory, nor functions",
    "p": r"white noise lifts a slider off a slope",
}


class Cells:
    """One row: each method is a column of the first table."""

    def __init__(self, slider, motion, contact, folder):
        self.slider, self.motion, self.contact, self.folder = slider, motion, contact, folder
        self.response = ss.integrate(slider, motion, contact=contact)

    def integrate(self):
        r = self.response
        assert r.time_sliding > 0
        scale = r.energy.initial + abs(r.energy.input) + r.energy.dissipated
        assert abs(r.energy.imbalance) < 1e-6 * scale

    def advance(self):
        if not isinstance(self.motion, ss.GroundMotion):
            raise TypeError("advance: segments of a HarmonicMotion are in C++ only")
        state, n, up = ss.State(), self.motion.acceleration, self.motion.vertical
        linear = self.motion.interpolation == "linear"
        for i, dt in enumerate(np.diff(self.motion.time)):
            j = i + 1 if linear else i
            lifts = {} if up is None else {"vertical_start": up[i], "vertical_end": up[j]}
            state = ss.advance(self.slider, state, dt, n[i], n[j], contact=self.contact, **lifts)
        r = self.response
        scale = r.peak + 1e-9
        assert abs(state.displacement - r.displacement[len(n) - 1]) < 1e-5 * scale

    def settle(self):
        r = ss.integrate(self.slider, self.motion, contact=self.contact, settle=True)
        assert r.at_rest

    def sweep(self):
        table = ss.sweep(self.slider, [self.motion], polarity="recorded", contact=self.contact)
        assert table.peak.ravel()[0] == pytest.approx(self.response.peak, rel=1e-9)

    def run_ensemble(self):
        e = ss.run_ensemble(self.slider, [self.motion], members=2, seed=1, contact=self.contact)
        assert e.quantile(0.5).value == pytest.approx(self.response.peak, rel=1e-6)

    def sensitivity(self):
        assert math.isfinite(self.response.sensitivity("scale").peak)

    def ensemble_sensitivity(self):
        s = ss.ensemble_sensitivity(
            self.slider, [self.motion], "scale", members=2, seed=1, contact=self.contact
        )
        one = self.response.sensitivity("scale").peak
        assert s.peak_mean.value == pytest.approx(one, rel=1e-9, abs=1e-12)

    def margin(self):
        assert self.response.margin >= 0

    def at(self):
        r = self.response
        scale = abs(r.displacement).max()
        there = r.at(r.time)["displacement"]
        assert np.allclose(there, r.displacement, rtol=0, atol=1e-9 * scale)

    def forces(self):
        r = self.response
        assert np.isfinite(r.force).all()
        assert np.isfinite(r.acceleration).all()
        assert r.peak_force >= abs(r.force).max() * (1 - 1e-12)
        assert r.time[0] <= r.peak_force_time <= r.time[-1]

    def floor_spectrum(self):
        values = ss.response_spectrum(self.response, [0.2, 0.5, 2.0]).values
        assert np.isfinite(values).all()
        assert (values > 0).all()

    def effective_period(self):
        r = ss.integrate(self.slider, self.motion, contact=self.contact)
        assert 0 < r.effective_period < 3
        assert 0 < r.effective_damping < 1.5

    def hysteresis(self):
        pytest.importorskip("matplotlib", reason="pictures need matplotlib")
        self.response.plot_hysteresis()

    def plot(self):
        pytest.importorskip("matplotlib", reason="pictures need matplotlib")
        self.response.plot()

    def tables(self):
        r = self.response
        document = json.loads(r.to_json())
        assert document["peak"] == r.peak
        assert r.to_csv(self.folder / "r.csv").stat().st_size > 1000
        for convert, module in ((r.to_dataframe, "pandas"), (r.to_xarray, "xarray")):
            with contextlib.suppress(ImportError):
                __import__(module)
                convert()

    def pickle(self):
        assert pickle.loads(pickle.dumps(self.response)) == self.response
        assert pickle.loads(pickle.dumps(self.slider)) == self.slider


COLUMNS = [name for name in vars(Cells) if not name.startswith("_")]


class SystemCells(Cells):
    """The same columns of a system that is no slider on one axis."""

    def __init__(self, system, motion, folder):
        self.slider, self.motion, self.folder = system, motion, folder
        self.contact, self.response = "clipped", ss.integrate(system, motion)

    def advance(self):
        n = self.motion.acceleration
        if self.motion.transverse is None:
            state = self.slider.rest()
        else:
            state, n = ss.PlanarState(), np.column_stack([n, self.motion.transverse])
        for begin, end in itertools.pairwise(n):
            state = ss.advance(self.slider, state, self.motion.dt, begin, end)
        last = self.response.displacement[len(n) - 1]
        assert np.allclose(state.displacement, last, atol=1e-9 * self.response.peak)

    def settle(self):
        assert ss.integrate(self.slider, self.motion, settle=True).at_rest

    def forces(self):
        r = self.response
        assert np.isfinite(r.force).all()
        sizes = np.linalg.norm(r.force.reshape(len(r.time), -1), axis=1)
        assert r.peak_force >= sizes.max() * (1 - 1e-12)

    def effective_period(self):
        r = self.response
        assert r.effective_period > 0
        assert 0 < r.effective_damping < 1.5


class RockingCells(SystemCells):
    """The same columns of a block that rocks."""

    def __init__(self, block, motion, folder):
        self.slider, self.motion, self.folder = block, motion, folder
        self.response = ss.integrate(block, motion)

    def integrate(self):
        r = self.response
        assert r.time_rocking > 0
        assert abs(r.energy.imbalance) < 1e-12

    def advance(self):
        state = ss.RockingState()
        for begin, end in itertools.pairwise(self.motion.acceleration):
            state = ss.advance(self.slider, state, self.motion.dt, begin, end)
        assert state.rotation == pytest.approx(self.response.rotation[-1], abs=1e-9)

    def sweep(self):
        table = ss.sweep(self.slider, [self.motion], polarity="recorded")
        assert table.peak_rotation.item() == self.response.peak_rotation

    def run_ensemble(self):
        e = ss.run_ensemble(self.slider, [self.motion], members=2, seed=1)
        assert (e.peak_rotation == self.response.peak_rotation).all()

    def ensemble_sensitivity(self):
        ss.ensemble_sensitivity(self.slider, [self.motion], "scale", members=2, seed=1)

    def at(self):
        r = self.response
        assert np.allclose(r.at(r.time)["rotation"], r.rotation, rtol=0, atol=1e-9)

    def forces(self):
        assert self.response.force

    def effective_period(self):
        assert self.response.effective_period

    def tables(self):
        r = self.response
        assert json.loads(r.to_json())["peak_rotation"] == r.peak_rotation
        assert r.to_csv(self.folder / "r.csv").stat().st_size > 1000
        for convert, module in ((r.to_dataframe, "pandas"), (r.to_xarray, "xarray")):
            with contextlib.suppress(ImportError):
                __import__(module)
                convert()


class CartCells(RockingCells):
    """The same columns of a cart."""

    def integrate(self):
        r = self.response
        assert r.time_moving > 0
        assert abs(r.energy.imbalance) < 1e-12

    def advance(self):
        state, n = ss.CartState(), np.column_stack([AXIS, AXIS[::-1]])
        for begin, end in itertools.pairwise(n):
            state = ss.advance(self.slider, state, self.motion.dt, begin, end)
        assert np.allclose(state.displacement, self.response.displacement[-1], atol=1e-9)

    def sweep(self):
        table = ss.sweep(self.slider, [self.motion], polarity="recorded")
        assert table.peak_outline.item() == self.response.peak_outline

    def run_ensemble(self):
        e = ss.run_ensemble(self.slider, [self.motion], members=2, seed=1)
        assert (e.peak_outline == self.response.peak_outline).all()

    def at(self):
        r = self.response
        assert np.allclose(r.at(r.time)["displacement"], r.displacement, rtol=0, atol=1e-9)

    def forces(self):
        r = self.response
        sizes = np.linalg.norm(r.acceleration, axis=1)
        assert r.peak_force >= sizes.max() * (1 - 1e-9)
        assert r.time[0] <= r.peak_force_time <= r.time[-1]

    def tables(self):
        r = self.response
        assert json.loads(r.to_json())["peak_outline"] == r.peak_outline
        assert r.to_csv(self.folder / "r.csv").stat().st_size > 1000


FLOORS = ss.Structure.shear_building(masses=[2e5] * 3, stiffnesses=[2.4e8] * 3, damping_ratio=0.03)
ISOLATOR = ss.Slider(BLOCK, **SPRING)
PAIR = ss.GroundMotion(AXIS, dt=0.05, transverse=AXIS[::-1])
SYSTEMS = {
    "`PlanarSlider`": (ss.PlanarSlider(ISOLATOR), PAIR),
    "`IsolatedStructure`": (ss.IsolatedStructure(ISOLATOR, FLOORS, base_mass=2e5), QUAKE),
    "`EquipmentOnFloor`": (ss.EquipmentOnFloor(ISOLATOR, FLOORS, floor=2, mass=100), QUAKE),
    "`FlexibleSlope`": (
        ss.FlexibleSlope(ky_g=0.05, height=20, shear_velocity=200, damping_ratio=0.1),
        QUAKE,
    ),
    "`SlenderBlock`": (ss.SlenderBlock(p=3, alpha=0.1, restitution=0.9), QUAKE),
    "`RockingBlock`": (ss.RockingBlock(width=0.2, height=2, mu=0.3), QUAKE),
    "`Cart`": (
        ss.Cart(
            [
                ss.SwivelCaster(at=(x, y), heading=x + y, slip_level=0.5, reach=0.04)
                for x in (-0.3, 0.3)
                for y in (-0.2, 0.2)
            ]
            + [ss.FixedWheel(at=(0, 0), mu=0.1, rolling_mu=0.05)],
            radius_of_gyration=0.25,
        ),
        PAIR,
    ),
}
NOT_OF_SYSTEMS = {
    "no": r"on one axis, got a PlanarSlider|sliders must be a Slider, a friction law|no attribute"
    r"|needs a slider on a spring"
    r"|covers a SlenderBlock|sensitivities of structures are not"
    r"|or a cart, got <RockingResponse"
}

SHAKING = ss.GaussianExcitation(ss.Spectrum.band_pass(s0=0.3, low=2, high=30), dt=0.05, samples=201)
NOISE = ss.GaussianExcitation(ss.Spectrum.white(s0=0.3), dt=0.05, samples=201, zero_frequency=True)
PULSES = ss.PoissonPulses(rate=0.5, half_width=0.5, sigma=1.0, duration=20.0)

THEORIES = {
    "`WhiteNoise`": (theory.WhiteNoise(), NOISE),
    "`Transport`": (theory.Transport(), NOISE),
    "`EquivalentLinearization`": (theory.EquivalentLinearization(), NOISE),
    "`StationaryLinearization`": (theory.StationaryLinearization(), SHAKING),
    "`PulseSuperposition`": (theory.PulseSuperposition(), PULSES),
    "`PulseChain`": (theory.PulseChain(), PULSES),
    "`SlowlyVaryingParameters`": (theory.SlowlyVaryingParameters(), COSINE),
}

SOIL = ss.Spectrum.kanai_tajimi(s0=0.03, frequency=15, damping=0.6)
CLOUGH = {"frequency": 15, "damping": 0.6, "filter_frequency": 1.5, "filter_damping": 0.6}
ENVELOPE = ss.Envelope(build_up=2, strong_duration=4, decay_rate=0.5)
EXCITATIONS = {
    "white noise": NOISE,
    "Kanai-Tajimi": SOIL,
    "Clough-Penzien": ss.Spectrum.clough_penzien(s0=0.03, **CLOUGH),
    "band": SHAKING,
    "Kanai-Tajimi, envelope": ss.GaussianExcitation(SOIL, dt=0.05, samples=201, envelope=ENVELOPE),
    "Poisson pulses": PULSES,
    "Poisson pulses, envelope": ss.PoissonPulses(
        rate=0.5, half_width=0.5, sigma=1.0, duration=20.0, envelope=ENVELOPE
    ),
    "harmonic": COSINE,
}
SLIDERS = {
    "block": BLOCK,
    "levels": LAWS["`Coulomb`, unequal levels"],
    "spring": ss.Slider(BLOCK, **SPRING),
    "caster": LAWS["`Caster`"],
    "speed": LAWS["`Stribeck`"],
    "static": LAWS["`StaticKinetic`"],
    "slope": ss.Slider(ss.Coulomb(mu=0.2), slope_degrees=5),
}


def cell(call, reasons):
    """'yes', or the letter of the reason for which the call is refused."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", RuntimeWarning)  # of figures
            call()
    except (ValueError, TypeError, AttributeError, ss.ConvergenceError) as refusal:
        text = str(refusal)
        for letter, pattern in reasons.items():
            if re.search(pattern, text):
                return letter
        raise AssertionError(f"no footnote for: {text}") from refusal
    return "yes"


def theory_cell(its_theory, slider, excitation):
    coverage = its_theory.covers(slider, excitation)
    if coverage:
        return "yes"
    for letter, pattern in THEORY_REASONS.items():
        if re.search(pattern, coverage.reason):
            return letter
    raise AssertionError(f"no footnote for: {coverage.reason}")


def orbits_cell(slider):
    def call():
        harmonic.orbits(slider, 2.0, 4.0)

    return cell(call, THEORY_REASONS)


def covered(its_theory, excitation):
    """The sliders that the theory covers under an excitation."""
    return ", ".join(name for name, s in SLIDERS.items() if its_theory.covers(s, excitation))


def page():
    return (ROOT / "docs" / "features.md").read_text()


def table(heading):
    """The cells of the table below a heading, by row and column."""
    text = page().split(f"## {heading}\n", 1)[1]
    lines = [line for line in text.split("\n## ")[0].splitlines() if line.startswith("|")]
    rows = [[part.strip() for part in line.strip("|").split("|")] for line in lines]
    names = rows[0][1:]
    return {row[0]: dict(zip(names, row[1:])) for row in rows[2:]}


def test_the_tables_have_every_row_and_column():
    analyses, theories = table("Analyses"), table("Theories")
    assert list(analyses) == list(ROWS)
    assert all(list(row) == COLUMNS for row in analyses.values())
    assert list(theories) == [name for name, row in ROWS.items() if row[1] is not None]
    assert all(list(row) == [*THEORIES, "`harmonic.orbits`"] for row in theories.values())


def test_the_tables_have_every_law():
    laws = [one for one in vars(ss).values() if isinstance(one, type)]
    laws = [one for one in laws if issubclass(one, ss.FrictionLaw) and one is not ss.FrictionLaw]
    assert {type(law) for law in LAWS.values()} == set(laws)


def test_the_parameters_of_the_laws_are_as_the_library_says():
    text = page().split("## Parameters of the laws\n", 1)[1].split("\n## ")[0]
    rows = [line for line in text.splitlines() if line.startswith("| `")]
    cells = [
        (f"`{law}`", f"`{name}`", *words)
        for law, parts in ss._core._laws().items()
        for name, *words in parts
    ]
    assert rows == ["|" + "".join(f" {cell} |" if cell else " |" for cell in row) for row in cells]


def test_every_footnote_is_used_and_explained():
    used = {c for t in ("Analyses", "Theories") for row in table(t).values() for c in row.values()}
    explained = set(re.findall(r"^- ([a-z]): ", page(), re.MULTILINE))
    assert used - {"yes"} == explained


@pytest.mark.parametrize("name", ROWS)
def test_every_analysis_of_a_row_is_as_the_table_says(name, tmp_path):
    slider, _, motion, contact = ROWS[name]
    cells = Cells(slider, motion, contact, tmp_path)
    found = {column: cell(getattr(cells, column), REASONS) for column in COLUMNS}
    assert found == table("Analyses")[name]


@pytest.mark.parametrize("name", [name for name, row in ROWS.items() if row[1] is not None])
def test_every_theory_of_a_row_is_as_the_table_says(name):
    slider = ROWS[name][1]
    found = {
        column: theory_cell(one, slider, excitation)
        for column, (one, excitation) in THEORIES.items()
    }
    found["`harmonic.orbits`"] = orbits_cell(slider)
    assert found == table("Theories")[name]


@pytest.mark.parametrize("name", SYSTEMS)
def test_every_analysis_of_a_system_is_as_the_table_says(name, tmp_path):
    rocks = dict.fromkeys(("`SlenderBlock`", "`RockingBlock`"), RockingCells)
    kind = (rocks | {"`Cart`": CartCells}).get(name, SystemCells)
    cells = kind(*SYSTEMS[name], tmp_path)
    found = {column: cell(getattr(cells, column), NOT_OF_SYSTEMS) for column in COLUMNS}
    assert found == table("Systems")[name]
    assert list(table("Systems")) == list(SYSTEMS)


@pytest.mark.parametrize("name", EXCITATIONS)
def test_every_theory_under_an_excitation_covers_what_the_table_says(name):
    found = {column: covered(one, EXCITATIONS[name]) for column, (one, _) in THEORIES.items()}
    assert found == table("Excitations")[name]
    assert list(table("Excitations")) == list(EXCITATIONS)


def test_linearization_covers_the_structures_that_the_page_names():
    one = theory.EquivalentLinearization()
    covered_ones = [name for name, (system, _) in SYSTEMS.items() if one.covers(system, SOIL)]
    assert covered_ones == ["`IsolatedStructure`", "`EquipmentOnFloor`"]
    assert f"`EquivalentLinearization` covers {' and '.join(covered_ones)}" in " ".join(
        page().split()
    )
    others = [one for one, _ in THEORIES.values() if one.name[:5] != "Equiv"]
    assert not any(one.covers(system, SOIL) for one in others for system, _ in SYSTEMS.values())


def test_the_theories_of_footnote_h_cover_sliding_one_way():
    one_way = ss.Coulomb(mu=0.05, backward=math.inf)
    found = [
        name
        for name, (one, _) in THEORIES.items()
        if any(one.covers(one_way, excitation) for excitation in EXCITATIONS.values())
    ]
    said = re.search(r"`one_way=True` on level ground:(.*?) cover it", page(), re.DOTALL)[1]
    assert re.findall(r"`\w+`", said) == found


def test_theories_of_the_plane_take_the_law():
    for one in (theory.WhiteNoise(dimensions=2), theory.EquivalentLinearization(dimensions=2)):
        assert one.covers(BLOCK, 0.3) and not one.covers(ss.PlanarSlider(BLOCK), 0.3)
