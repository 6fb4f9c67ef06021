"""Type stubs: they agree with the compiled module, and a checker accepts a user's script."""

import os
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest
import stickslip as ss
from pages import ROOT, blocks

needs_mypy = pytest.mark.skipif(find_spec("mypy") is None, reason="needs mypy")

# In its strict mode mypy also reports a `type: ignore` that ignores nothing: the lines that have
# one are lines that must be refused.
SCRIPT = """
from array import array
from concurrent.futures import ThreadPoolExecutor
from fractions import Fraction
from pathlib import Path

import numpy as np
import stickslip as ss
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray
from stickslip import plotting

block = ss.Coulomb(mu=0.2)
block = ss.Coulomb(slip_level=1, backward=float("inf"))
block = ss.Coulomb(mu=np.float32(0.2), backward=Fraction(1, 5))
slope = ss.Slider(ss.Coulomb(mu=0.6), slope_degrees=20, one_way=True)
wheel = ss.Caster(slip_level=1.0, reach=0.5)
wheel = ss.Caster.from_geometry(mu=0.2, trail=0.03, wheel_width=0.02, thesis=True)
liner = ss.VelocityDependent(mu_slow=0.03, mu_fast=0.06, rate=50)
cart = ss.Slider(wheel, natural_frequency=1.3)

quake = ss.GroundMotion([1, 2.0, 3], dt=0.01)
quake = ss.GroundMotion(range(3), 0.01, name="ramp")
quake = ss.GroundMotion(array("d", [1, 2, 3]), times=(0, 1, 2))
quake = ss.GroundMotion(np.ones(3, np.float32), times=np.arange(3), interpolation="constant")
quake = ss.read_record(Path("kobe.AT2"), units="g", component=1)
step: float | None = quake.dt
quake = ss.GroundMotion([0, 1], dt=0.01, units="g").scaled_to(pga_g=0.4).cut(0, np.float64(0.01))
quake = quake[10:-5][: np.int64(100)]
quake = -(2 * quake / np.float32(3)).resampled(0.005).detrended(order=1) * 2
ground: NDArray[np.float64] = quake.velocity + quake.displacement
picture = quake.plot(title="mine")
samples: NDArray[np.float64] = np.asarray(quake, dtype=np.float64)
quake.to_csv(Path("quake.csv"))
spectrum = ss.response_spectrum(quake, np.geomspace(0.01, 10, 20), [0.02, 0.05], kind="velocity")
sa: NDArray[np.float64] = ss.response_spectrum(quake, 1.0).values
picture = spectrum.plot()
plotting.save(picture, "spectrum.png")
table_of_sa, measures = spectrum.to_dataframe(), ss.strong_motion(quake).to_json()
warned: type[UserWarning] = ss.PlausibilityWarning

pairs = ss.WithTransverse(ss.PoissonPulses.event("great near field"), ratio=0.8, coherence=0.3)
pairs = ss.WithTransverse(pairs.transverse, None, 1, 0, arrivals="independent")
table_of_directions = ss.orientations(cart, pairs.sample(seed=1, member=0), range(0, 180, 5))
largest: float = table_of_directions.rotd100.peak + table_of_directions.percentile(84).residual
along: NDArray[np.float64] = ss.orientations(block, quake, settle=True, progress=True).peak
picture = table_of_directions.plot()
three = ss.WithVertical(pairs, ratio=0.5)

r = ss.integrate(cart, quake, displacement=0.0, velocity=0.0)
r = ss.integrate(block, quake, settle=True)
x: NDArray[np.float64] = r.displacement
kinds = r.events["kind"]
law: ss.FrictionLaw = r.slider.law
work: float = r.energy.input + r.energy.dissipated + r.energy.kinetic + r.energy.elastic
forces: NDArray[np.float64] = r.force + r.acceleration
sticking: NDArray[np.bool_] = ~r.stuck
file: Path = r.to_csv("r.csv")
table, dataset = r.to_dataframe(), r.to_xarray()
r.plot_hysteresis(title="mine").savefig("loop.png")
r.plot(time=(0, 25)).savefig("r.png")
plotting.save(r.plot(title="mine"), "r.png")
plotting.save(plotting.plot_responses([r, r]), Path("both.png"))
page = Figure()
part: object = r.plot(figure=page.add_subfigure(page.add_gridspec(1, 1)[0])).suptitle("upper")
axes: Axes = page.subplots()
panels: list[Axes] = [quake.plot(ax=axes), r.plot_hysteresis(ax=axes, time=(0, 1))]
scaled: ss.GroundMotion = r.motion.scaled(2)
blocks_of = ss.grid(ss.Coulomb, mu=[0.1, 0.2, 0.3])
swept = ss.sweep(ss.grid(ss.Slider, law=blocks_of, period=[2.0, 3.0]), [quake])
swept.plot("residual", title="mine").savefig("sweep.png")
planes = ss.grid(ss.PlanarSlider, law=blocks_of, period=[2.0, 3.0])
across: NDArray[np.float64] = ss.sweep(planes, [quake]).residual_transverse
one_plane: ss.PlanarSlider = planes[0]
hits: NDArray[np.int64] = ss.sweep([one_plane], quake).impacts
panels.append(swept.plot(ax=axes))
for interface in ss.interfaces():
    low: float = interface["mu_low"]
cabinet = ss.SlenderBlock.from_size(width=0.6, height=2)
rocked = ss.integrate(cabinet, quake, settle=True, rotation=0.01)
side: str | None = rocked.overturned
certain: float | None = rocked.overturned_at
tilt: NDArray[np.float64] = rocked.rotation
rocked.plot().savefig("tilt.png")
ends: NDArray[np.float64] = ss.critical_scales(cabinet, quake, up_to=2)
fallen: NDArray[np.int8] = ss.sweep([cabinet], quake, scale=[1, 2]).overturned
chance: ss.Interval = ss.run_ensemble(cabinet, quake, members=2, seed=1).overturning()
chances: list[ss.Interval] = ss.run_ensemble(cabinet, quake, members=2, seed=1).overturning([1])
ss.rocking_spectrum(quake, alpha=0.2, periods=[1, 2]).plot()
ss.grid(ss.SlenderBlock, p=[1, 2], alpha=0.2, restitution="housner")[0].p
rigid = ss.RockingBlock(width=0.6, height=2, mu=0.5, center=(0.05, 0.8), restitution=0.9)
walked: NDArray[np.float64] = ss.integrate(rigid, quake, settle=True).displacement
slid: NDArray[np.float64] = ss.sweep([rigid], quake, scale=[1, 2]).residual
rough: float | None = rigid.mu
ss.advance(rigid, ss.RockingState(0.1), 0.01, 1).slips
wheel_of_cart = ss.SwivelCaster(at=(0.3, 0.2), heading=1, mu=0.5, trail=0.04, wheel_width=0.03)
locked = ss.SwivelCaster(at=(-0.3, 0), heading=1, mu=0.5, trail=0.04, lock="both")
trolley = ss.Cart([wheel_of_cart, ss.Foot(at=(0, 0), mu=0.3), locked], radius_of_gyration=0.3)
rolled = ss.integrate(trolley, quake, walls=[((1.5, 0), (0, 1))])
corner: float = rolled.peak_outline + rolled.clearance(((2, 0), (0, 1))).least
turned: NDArray[np.float64] = rolled.heading
parked = trolley.with_random_headings()
reached: ss.Interval = ss.run_ensemble(parked, quake, members=2, seed=1).exceedance(0.1)
corners: NDArray[np.float64] = ss.sweep(parked, quake, members=2, seed=1).peak_outline
ss.advance(trolley, ss.CartState(yaw=1), 0.01, (0, 1)).headings.tolist()
far = max(r.peak, r.residual, r.sliding_distance, r.time_sliding)
same: bool = block == wheel or hash(block) == hash(cart)
words: dict[str, str] = ss.build_info()

soil = ss.Spectrum.kanai_tajimi(s0=1, frequency=15, damping=np.float64(0.6))
soil = ss.Spectrum.from_table([0, 1, 2], np.ones(3))
soil = ss.Spectrum.from_function(lambda omega: 1 / (1 + omega**2), high=50)
level: float = soil(3) + soil.variance + soil.band_variance(low=1)
levels: NDArray[np.float64] = soil(np.linspace(0, 9, 10))
envelope = ss.Envelope(build_up=4, strong_duration=10, decay_rate=0.5)
factors: NDArray[np.float64] = ss.Envelope.from_table([0, 1], [0, 1])([0.5, 0.7])
shaking = ss.GaussianExcitation(soil, 0.01, 4096, period=np.int64(8192), envelope=envelope)
shaking = ss.GaussianExcitation(soil, dt=0.01, samples=4096, interpolation="constant").refined(2)
quake = shaking.sample(seed=1, member=7)

pulses = ss.PoissonPulses(rate=3, half_width=1 / 6, sigma=2.5, duration=60, stationary_start=True)
pulses = ss.PoissonPulses.event(ss.PoissonPulses.events()[0], shape=([0, 1, 3], (2.0, -1)))
pulses = ss.PoissonPulses(rate=3, half_width=1, sigma=1, duration=9, quantile=lambda u: 1 - 2 * u)
quake = pulses.sample(seed=1, member=np.uint64(7))
arrivals, amplitudes = pulses.pulses(seed=1, member=7)
density: float = pulses.density(2)
densities: NDArray[np.float64] = pulses.density([2, 3])

class Mine:
    duration, configuration = 60.0, {"of": "my own"}

    def sample(self, *, seed: int, member: int) -> ss.GroundMotion:
        return quake

e = ss.run_ensemble(wheel, ss.PoissonPulses.event("great near field"), members=10, seed=1)
e = ss.run_ensemble(cart, Mine(), members=np.int64(10), seed=1, executor=ThreadPoolExecutor())
e = ss.run_ensemble(block, Mine(), members=10, seed=1, progress=print, checkpoint=Path("a.npz"))
error: NDArray[np.float64] = e.displacement_variance_error
bounds: tuple[float, float] = (e.quantile(0.95).low, e.exceedance(0.1).high)
rate: ss.Estimate = e.stationary.growth_rate
growth, its_error = rate
middle, lowest, highest = e.quantile(0.5)
several: list[ss.Interval] = sorted(e.quantile([0.5, 0.84, 0.95]))
rises: bool = several[0] < 0.3 or rate > 0 or float(rate) > several[0]
text: str = f"{rate:.3f} {several[0]:.2g}"
line: NDArray[np.float64] = e.velocity_spectrum.density / e.velocity_spectrum.error
e.merge(ss.Ensemble.load("a.npz"))
e.save(Path("b.npz"))
e.plot(title="mine")
try:
    ss.run_ensemble(block, Mine(), members=10, seed=1)
except ss.EnsembleError as failure:
    failure.partial.save(f"until-{failure.members.start}.npz")

blocks = ss.Random(ss.Coulomb, mu=ss.Lognormal(median=0.3, beta=np.float64(0.3)))
floors = ss.Random(ss.Slider, law=blocks, natural_frequency=ss.Normal(2, 0.5, low=1))
e = ss.run_ensemble(blocks, [quake, quake], members=10, seed=1)
e = ss.run_ensemble(floors, ss.Drawn([quake]), members=10, seed=1)
e = ss.run_ensemble([block, cart], quake, members=10, seed=1)
e = ss.run_ensemble(ss.Drawn([block]), (quake,), members=10, seed=1)
drawn: ss.GroundMotion = ss.Drawn([quake]).sample(seed=1, member=np.int64(7))
median: float = ss.Uniform(0, 1).quantile(0.5)
bounds_of_mu: NDArray[np.float64] = ss.Lognormal(0.3, 0.3).quantile([0.05, 0.95])

damper = ss.ViscousSlider(1, natural_frequency=np.float64(2))
r = ss.integrate(damper, quake)
e = ss.run_ensemble(damper, shaking, members=10, seed=1)
strong = ss.strong_motion(quake)
seconds: float = strong.mean_period + strong.duration_5_75
seconds = strong.duration + strong.center_frequency_hz
linearized = ss.theory.StationaryLinearization().predict(block, soil)
linearized = ss.theory.StationaryLinearization().predict(ss.Slider(block, 2), soil)
spread: float = linearized.velocity_std + linearized.velocity_spectrum(3)
moments: ss.Moments = linearized.transient([1, 2])

class MyTheory:
    name = "mine"

    def covers(self, slider: object, excitation: object) -> ss.theory.Coverage:
        return ss.theory.Coverage("mine covers pulses", excitation=False)

    def predict(self, slider: object, excitation: object, times: NDArray[np.float64]) -> ss.Moments:
        return ss.Moments(times, velocity_variance=times**2, growth_rate=3)

compared = ss.compare(block, pulses, members=10, theories=[*ss.theory.THEORIES, MyTheory()])
plotting.save(compared.plot(), "theories.png")
answer: bool = bool(ss.theory.PulseChain().covers(wheel, pulses))
moments = ss.theory.PulseChain().predict(block, pulses, [1, 2])
moments = ss.theory.StationaryLinearization().predict(block, 0.1, [1, 2])

try:
    r.plot(title="Kobe")
except ss.ConvergenceError as error:
    raise RuntimeError from error

ss.Coulomb()  # type: ignore[call-overload]
ss.Coulomb(0.2)  # type: ignore[call-overload]
ss.Coulomb(mu="0.2")  # type: ignore[call-overload]
ss.Coulomb(mu=0.2, slip_level=1.0)  # type: ignore[call-overload]
ss.Caster(mu=0.2)  # type: ignore[call-overload]
ss.Slider(0.2)  # type: ignore[arg-type]
ss.GroundMotion([1, 2])  # type: ignore[call-overload]
ss.GroundMotion([1, 2], dt=0.01, times=[0, 1])  # type: ignore[call-overload]
ss.GroundMotion([1, 2], dt=0.01, interpolation="cubic")  # type: ignore[call-overload]
ss.GroundMotion(["1", "2"], dt=0.01)  # type: ignore[list-item]
ss.GroundMotion([1j, 2], dt=0.01)  # type: ignore[list-item]
ss.GroundMotion([[1, 2], [3, 4]], dt=0.01)  # type: ignore[list-item]
ss.integrate(block, [1, 2])  # type: ignore[call-overload]
ss.integrate(block, quake, 0.0)  # type: ignore[call-overload]
ss.Spectrum.white(1.0)  # type: ignore[call-arg]
ss.Spectrum.from_function(3.0)  # type: ignore[arg-type]
ss.GaussianExcitation(soil, 0.01, 40.5)  # type: ignore[arg-type]
ss.GaussianExcitation(soil, 0.01, 4096, "linear")  # type: ignore[call-arg]
shaking.sample(1, 7)  # type: ignore[call-arg]
ss.PoissonPulses(3.0, 1.0, 1.0, 9.0)  # type: ignore[call-arg]
pulses.sample(1, 7)  # type: ignore[call-arg]
pulses.sample(seed=1, member=0.5)  # type: ignore[arg-type]
block.slip_level = 2.0  # type: ignore[misc]
r.peak = 2.0  # type: ignore[misc]
e.members = 3  # type: ignore[misc]
ss.run_ensemble(block, soil, members=10, seed=1)  # type: ignore[call-overload]
ss.run_ensemble([block, quake], quake, members=10, seed=1)  # type: ignore[list-item]
ss.run_ensemble(block, ss.Drawn([block]), members=10, seed=1)  # type: ignore[list-item]
ss.run_ensemble(block, Mine(), members=1e3, seed=1)  # type: ignore[call-overload]
ss.run_ensemble(block, Mine(), members=10)  # type: ignore[call-overload]
ss.theory.StationaryLinearization().predict(wheel, soil)  # type: ignore[call-overload]
quake[0]  # type: ignore[index]
ss.nothing  # type: ignore[attr-defined]
"""


def run(*command, cwd):
    # mypy looks where Python does, but for what PYTHONPATH names it wants MYPYPATH.
    environment = {**os.environ, "MYPYPATH": os.environ.get("PYTHONPATH", "")}
    result = subprocess.run(
        [sys.executable, "-m", *command], cwd=cwd, env=environment, capture_output=True, text=True
    )
    assert result.returncode == 0, result.stdout + result.stderr


def test_the_package_carries_its_types():
    package = Path(ss.__file__).parent
    assert (package / "py.typed").exists()
    assert (package / "_core.pyi").exists()


@pytest.mark.slow
@needs_mypy
def test_the_stubs_say_what_the_compiled_module_is(tmp_path):
    run("mypy.stubtest", "stickslip._core", cwd=tmp_path)


@pytest.mark.slow
@needs_mypy
def test_a_strict_checker_takes_what_runs_and_refuses_what_does_not(tmp_path):
    (tmp_path / "script.py").write_text(SCRIPT)
    run("mypy", "--strict", "--cache-dir", str(tmp_path / "cache"), "script.py", cwd=tmp_path)


@pytest.fixture
def documented(tmp_path):
    """The Python of the README and of the guides, a file for each block."""
    docs = ROOT / "docs"
    names = ("start", "ground_motions", "contact", "sweeps", "coming_from", "trust")
    guides = [docs / f"{name}.md" for name in names]
    for page in [ROOT / "README.md", *guides, *(docs / "guides").glob("*.md")]:
        for number, code in enumerate(blocks(page, "python"), 1):
            (tmp_path / f"{page.stem}_{number}.py").write_text(code)
    assert len(list(tmp_path.glob("*.py"))) > 40
    return tmp_path


@pytest.mark.slow
@needs_mypy
def test_the_code_of_readme_and_guides_passes_a_strict_checker(documented):
    cache = str(documented / "cache")
    run("mypy", "--strict", "--cache-dir", cache, *os.listdir(documented), cwd=documented)


@pytest.mark.slow
def test_pyright_passes_the_code_of_readme_and_guides_and_the_stubs(documented):
    pyright = [sys.executable, "-m", "pyright"]  # fetches itself from npm's registry when first run
    if subprocess.run([*pyright, "--version"], capture_output=True, check=False).returncode:
        pytest.skip("needs pyright: pip install pyright[nodejs], and a network the first time")
    stubs = (Path(ss.__file__).parent / "_core.pyi").read_text(encoding="utf-8")
    (documented / "core.pyi").write_text(stubs.replace("\nfrom .", "\nfrom stickslip."))
    (documented / "pyrightconfig.json").write_text('{"typeCheckingMode": "strict"}')
    command = [*pyright, "--pythonpath", sys.executable, "."]
    done = subprocess.run(command, cwd=documented, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout
