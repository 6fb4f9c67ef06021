"""Each example runs as it stands, draws its picture, and finds what physics says it must."""

import math
import runpy
import shutil
import sys
from pathlib import Path

import numpy as np
import pytest
import stickslip as ss
from pages import assert_same_picture

pytest.importorskip("matplotlib")

EXAMPLES = Path(__file__).parents[2] / "examples"
G = ss.STANDARD_GRAVITY


PAGE = EXAMPLES.parent / "docs" / "examples.md"
PICTURES = PAGE.parent / "images" / "examples"


def assert_shown(picture):
    """The picture of the page shows what was drawn; if not, draw it with docs/draw_examples.py."""
    assert_same_picture(picture, PICTURES / picture.name)


def test_the_page_shows_the_code_and_the_pictures_of_the_examples():
    text = PAGE.read_text(encoding="utf-8")
    assert "literalinclude" not in text  # which a forge does not read
    languages = {".py": "python", ".cpp": "cpp", ".c": "c", ".f90": "fortran"}
    files = [file for file in EXAMPLES.glob("[0-9]*") if file.suffix in languages]
    assert {file.suffix for file in files} == set(languages)
    assert len(files) > 12
    for file in files:
        language = languages[file.suffix]
        code = file.read_text(encoding="utf-8").rstrip("\n")
        assert f"```{language}\n{code}\n```" in text, file.name
    for file in EXAMPLES.glob("[0-9]*.py"):
        assert f"](images/examples/{file.stem}.png)" in text
        assert 10_000 < (PICTURES / f"{file.stem}.png").stat().st_size < 200_000


@pytest.fixture
def run(tmp_path, monkeypatch, pyslammer_files):
    """Runs an example as a program in an empty folder, and returns its names at the end."""

    def run(name, *arguments):
        monkeypatch.setattr(sys, "argv", [name, *map(str, arguments), "--out", "pictures"])
        monkeypatch.chdir(tmp_path)
        names = runpy.run_path(str(EXAMPLES / f"{name}.py"), run_name="__main__")
        (picture,) = (tmp_path / "pictures").iterdir()
        assert picture.name == f"{name}.png"
        assert picture.stat().st_size > 10_000
        if not arguments:
            assert_shown(picture)
        return names

    return run


def test_all_examples_are_here():
    numbers = sorted(file.stem for file in EXAMPLES.glob("[01]*.py"))
    assert [number[:2] for number in numbers] == [f"{i:02}" for i in range(1, 14)]
    assert {f"test_{number}" for number in numbers} <= set(globals())


def test_01_one_record(run, capsys):
    r = run("01_one_record")["r"]
    assert r.motion.name.startswith("Kobe")
    assert r.at_rest
    assert abs(r.residual) <= r.peak <= r.sliding_distance
    # All that the ground put in went into friction, mu g for each meter of sliding distance.
    assert r.energy.dissipated == pytest.approx(0.2 * G * r.sliding_distance, rel=1e-12)
    assert abs(r.energy.imbalance) < 1e-12 * r.energy.input
    assert f"peak displacement      {100 * r.peak:7.2f} cm" in capsys.readouterr().out


def test_01_takes_a_record_of_ones_own(run, pyslammer_files, capsys):
    file = next(f for f in pyslammer_files if f.name.startswith("Coyote"))
    names = run("01_one_record", file, "--mu", 1.5)
    assert names["quake"].name.startswith("Coyote")
    assert names["r"].slips == 0
    assert "peak displacement         0.00 cm" in capsys.readouterr().out


def test_02_caster(run):
    names = run("02_caster")
    casters, (kobe, nahanni) = names["casters"], names["runs"]
    # Wheels that scrub hold less than brakes; with Coulomb friction all comes to rest.
    assert casters.slip_level < 0.5 * G
    for r in (*list(kobe.values())[1:], *nahanni.values()):
        assert r.at_rest
    rolling, staying = kobe["on casters"], nahanni["on casters"]
    assert not rolling.at_rest
    # Out there a caster has no friction left to speak of: it keeps its speed over the ground, and
    # the speed changes by what the ground's does.
    assert rolling.peak > 20 * casters.reach
    late = rolling.time > 20
    n, t, v = rolling.motion.acceleration[late], rolling.time[late], rolling.velocity[late]
    impulse = -np.sum((n[1:] + n[:-1]) / 2 * np.diff(t))
    assert v[-1] - v[0] == pytest.approx(impulse, abs=1e-9)
    assert staying.peak < casters.reach


def test_03_isolated_floor(run, pyslammer_files):
    files = [f for f in pyslammer_files if f.name.startswith(("Kobe", "Coyote", "Loma", "Kocaeli"))]
    names = run("03_isolated_floor", *files)
    mu, wn, quakes = names["mu"], names["wn"], names["quakes"]
    # At rest friction holds the spring.
    assert (names["residual"] <= mu * G / wn**2 * (1 + 1e-12)).all()
    # What is transmitted, by the histories: -(level sgn x' + wn^2 x) while it slides, n while not.
    for quake, row in zip(quakes, names["transmitted"]):
        for m, claimed in zip(mu, row):
            r = ss.integrate(ss.Slider(ss.Coulomb(mu=m), natural_frequency=wn), quake)
            sliding = np.abs(m * G * np.sign(r.velocity) + wn**2 * r.displacement)
            sampled = np.where(r.velocity != 0, sliding, np.abs(quake.acceleration)).max()
            assert 0.98 * claimed <= sampled <= claimed * (1 + 1e-12)
    # Without a slip the ground's acceleration, and never more of it for that.
    coyote = next(i for i, q in enumerate(quakes) if q.name.startswith("Coyote"))
    assert names["transmitted"][coyote, -1] == quakes[coyote].peak_acceleration


def test_04_slope(run):
    names = run("04_slope")
    for (name, _), r in names["shown"].items():
        backwards = r.velocity.min() < 0
        assert backwards == (name == "two-way")
    # A block that can go back up ends no further down.
    for sign in (1, -1):
        one, two = (np.array(names["sweep"][name, sign]) for name in ("one-way", "two-way"))
        assert (two <= one + 1e-12).all()
        assert (np.diff(one) <= 0).all()  # a higher yield, a shorter way
        # Where it never yields uphill the two are one.
        uphill = np.array([names["uphill"](level * G) for level in names["levels"]])
        never = uphill > names["quake"].peak_acceleration
        assert never.any()
        assert one[never] == pytest.approx(two[never], abs=1e-12)


def test_04_is_a_slope_of_so_many_degrees(run):
    names = run("04_slope", "--degrees", 7)
    # It yields where it says, both ways.
    for level, way in ((names["ky"], -1), (names["uphill"](names["ky"]), 1)):
        for factor, slides in ((1 - 1e-9, False), (1 + 1e-9, True)):
            ground = ss.GroundMotion([way * factor * level] * 2, dt=1, interpolation="constant")
            assert (ss.integrate(names["two_way"](names["ky"]), ground).slips > 0) == slides


def test_05_ensemble(run):
    names = run("05_ensemble", "--members", 2000)
    quakes, ensembles = names["quakes"], names["ensembles"]
    for mu, e in ensembles.items():
        assert e.members == 2000
        # A member is its number: any of them, slid alone.
        alone = ss.integrate(ss.Coulomb(mu=mu), quakes.sample(seed=1, member=77), settle=True)
        assert e.peak[77] == pytest.approx(alone.peak, rel=1e-10)
        assert e.exceedance(0.5).value == np.mean(e.peak > 0.5)
    medians = [e.quantile(0.5).value for e in ensembles.values()]
    assert medians == sorted(medians, reverse=True)


def test_06_theory(run, capsys):
    comparison = run("06_theory", "--members", 4000)["comparison"]
    # The pulse chain is within 10 % of simulations, and five standard errors of this one: beyond
    # them by chance once in a million.
    ratio, error = comparison.ratio("PulseChain", "displacement_variance")
    assert (np.abs(ratio - 1) < 0.1 + 5 * error).all()
    assert (error < 0.04).all()
    # Pulses one by one miss what overlapping ones do together.
    ratio, _ = comparison.ratio("PulseSuperposition, none", "displacement_variance")
    assert (ratio < 0.3).all()
    assert "theory / simulation" in capsys.readouterr().out


needs_compiler = pytest.mark.skipif(shutil.which("c++") is None, reason="no c++ here")


@pytest.mark.slow
@needs_compiler
def test_07_own_law(run):
    names = run("07_own_law")
    patch, rough = names["patch"], names["rough"]
    assert np.abs(patch).max() > np.abs(rough).max()  # further, where friction falls off
    # Coulomb friction by the library itself, to the six digits of the file.
    slider = ss.Slider(ss.Coulomb(slip_level=1.0), natural_frequency=2 * math.pi / 3)
    r = ss.integrate(slider, ss.GroundMotion(names["ground"], dt=0.01))
    assert rough == pytest.approx(r.displacement, abs=1e-5)


@pytest.mark.slow
@needs_compiler
def test_08_time_loop(run):
    names = run("08_time_loop")
    # Step by step in C++, and as one motion of the floor in Python, to the six digits of the file.
    r = ss.integrate(ss.Coulomb(mu=0.3), ss.GroundMotion(names["floor"], dt=0.005))
    assert names["block"] == pytest.approx(r.displacement, abs=1e-5)
    assert np.abs(names["floor"]).max() > 0.3 * G


def test_09_pulses_of_a_record(run):
    names = run("09_pulses_of_a_record")
    quake, fit, spectrum = names["quake"], names["fit"], names["spectrum"]
    assert quake.name.startswith("Loma")
    # What the strong part has in acceleration the spectrum has, but for its mean and the highest
    # frequencies; both kinds of pulses have what they were asked for.
    assert spectrum.variance == pytest.approx(names["strong"].rms_acceleration ** 2, rel=0.01)
    assert names["rectangular"].variance == pytest.approx(fit.rms_acceleration**2, rel=1e-12)
    omega = np.linspace(0.5, 300, 2000)
    asked, had = spectrum(omega), names["shaped"].density(omega)
    assert np.abs(had - asked).sum() < 0.011 * asked.sum()
    fitted = names["rectangular"].density(omega)
    # The misfit is a sum over lines, each the mean of 11; the estimate takes the mean of 9 and is
    # straight between lines, which alone changes the integral by 5 %.
    assert np.abs(fitted - asked).sum() / asked.sum() == pytest.approx(fit.misfit, rel=0.05)


def test_10_map(run):
    names = run("10_map", "--cells", 100)
    ky, displacement, bound = names["ky"], names["displacement"], names["bound"]
    # Levels that it did not compute: the displacement is within the bound.
    own = ky.ravel()[::397]
    blocks = ss.grid(ss.Coulomb, mu=own, backward=math.inf)
    exact = ss.sweep(blocks, names["suite"], settle=True).peak.mean(axis=(1, 2))
    assert (np.abs(exact - displacement.ravel()[::397]) <= bound.ravel()[::397] * (1 + 1e-9)).all()
    assert 0 < bound.max() < 0.2 * displacement.max()
    assert np.all(np.diff(names["mean"]) <= 0)


def test_11_triple_pendulum(run, capsys):
    names = run("11_triple_pendulum")
    isolator, r, loop = names["isolator"], names["r"], names["loop"]
    assert r.at_rest
    # The surfaces add up to the displacement, and each stays within its capacity.
    assert r.surfaces.displacement.sum(axis=0) == pytest.approx(r.displacement, abs=1e-14)
    inner, lower, upper = isolator.capacities
    assert (r.surfaces.peak <= [lower, inner, inner, upper]).all()
    # The loop to the peak encloses the response: its force there is the largest.
    largest = np.abs(r.force).max() / G
    assert largest == pytest.approx(np.abs(loop.force).max(), rel=1e-4)  # at samples
    assert f"peak displacement      {100 * r.peak:7.2f} cm" in capsys.readouterr().out


def test_12_isolated_hospital(run):
    names = run("12_isolated_hospital")
    fixed, isolated = names["ensembles"].values()
    assert fixed.peak.max() == 0
    assert fixed.members == len(names["quakes"]) == 18
    # Isolation pays: in the median every floor accelerates less, and every story drifts less.
    for name in ("peak_floor_acceleration", "peak_floor_drift"):
        before, after = (np.median(getattr(e, name).values, axis=0) for e in (fixed, isolated))
        assert (after < 0.7 * before).all(), name
    # The ensemble holds what integrate says of a record.
    quake, slider = names["quakes"][3], names["designs"]["isolated"]
    r = ss.integrate(
        ss.IsolatedStructure(slider, names["hospital"], base_mass=1.5e6), quake, settle=True
    )
    assert isolated.peak[3] == pytest.approx(r.peak, rel=1e-9)
    # Very stiff equipment on a floor accelerates as the floor does.
    stiff = ss.response_spectrum(r, 0.01, floor=3).values
    assert stiff == pytest.approx(r.floors.peak_acceleration[2], rel=0.05)


@pytest.mark.slow
def test_13_dam(run):
    names = run("13_dam")
    coupled, decoupled, rigid = names["coupled"], names["decoupled"], names["rigid"]
    # A low dam is nearly a rigid block; a very high one moves less than that.
    slides = names["slides"]
    assert slides.sum() > 10
    low = np.median(coupled[slides, 0] / rigid[slides])
    assert low == pytest.approx(1, abs=0.25)
    assert np.median(coupled[slides, -1] / rigid[slides]) < 0.5
    # Decoupled analysis is mostly conservative.
    moved = coupled > 0.01
    assert np.mean(decoupled[moved] > coupled[moved]) > 0.5
    quake, height = names["quakes"][2], names["heights"][4]
    both = [names["dam"](height).coupled(q).residual for q in (quake, quake.scaled(-1))]
    assert coupled[2, 4] == pytest.approx(np.mean(both), rel=1e-12)
