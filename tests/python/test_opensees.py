"""The recipes of examples/opensees: the element, compiled with stand-ins, and OpenSeesPy itself."""

import importlib.util
import re
import subprocess
import sys

import numpy as np
import pytest
import stickslip as ss
from pages import ROOT

pytestmark = pytest.mark.slow

RECIPES = ROOT / "examples" / "opensees"
STAND_INS = ROOT / "tests" / "opensees"
PAGE = (ROOT / "docs" / "guides" / "other_tools.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def drive(beside_source, run_page):
    """Runs the element through steps; returns what its recorder would write."""
    headers = beside_source / "OpenSees" / "SRC"
    headers.mkdir(parents=True)
    element = (RECIPES / "FloorSlider.cpp").read_text(encoding="utf-8")
    for name in re.findall(r"^#include <(\w+\.h)>", element, re.MULTILINE):
        (headers / name).write_text(f'#include "{STAND_INS}/opensees.h"\n', encoding="utf-8")
    folder = run_page("FloorSlider.cpp")
    command = ["c++", "-std=c++17", "-rdynamic", f"{STAND_INS}/drive.cpp", "./FloorSlider.so"]
    subprocess.run([*command, "-Wl,-rpath,.", "-o", "drive"], cwd=folder, check=True)

    def drive(arguments, steps=()):
        lines = "".join("{:.17g} {:.17g} {:.17g}\n".format(*step) for step in steps)
        command = ["./drive", *map(str, arguments)]
        return subprocess.run(command, cwd=folder, input=lines, capture_output=True, text=True)

    return drive


@pytest.mark.parametrize("frequency, damping", [(0, 0), (3.0, 0.2)])
def test_the_element_moves_as_integrate_says(drive, record_a, frequency, damping):
    slider = ss.Slider(ss.Coulomb(slip_level=1.1), natural_frequency=frequency, damping=damping)
    rng = np.random.default_rng(1)
    time = np.cumsum(np.r_[0, rng.uniform(0.02, 0.1, 400)])
    relative = np.r_[0, record_a[1:]]
    ground = np.r_[0, np.roll(record_a, 30)[1:]]  # both at rest at the start
    done = drive([3, 7, 2, 1.1, frequency, damping], list(zip(time, relative, ground))[1:])
    assert done.returncode == 0
    x, v, mode = np.transpose([line.split() for line in done.stdout.splitlines()]).astype(float)
    r = ss.integrate(slider, ss.GroundMotion(relative + ground, times=time))
    assert r.slips > 20
    # To round-off, with a damper 1e-12 of the scale.
    assert x == pytest.approx(r.displacement[1:], abs=1e-11 * r.peak)
    assert v == pytest.approx(r.velocity[1:], abs=1e-11 * abs(r.velocity).max())
    assert (mode == np.sign(v)).all()


@pytest.mark.parametrize(
    "arguments, message",
    [
        ([3, 7], "want: element FloorSlider"),
        ([3, 7, 2, 1, 1, 1, 1], "want: element FloorSlider"),
        ([3, 7, 2, -1], "FloorSlider 3: Coulomb: slip_level must be finite and at least 0"),
        ([3, 7, 3, 1], "FloorSlider 3: its node has 2 degrees of freedom"),
    ],
)
def test_the_element_says_what_is_wrong(drive, arguments, message):
    done = drive(arguments)
    assert done.returncode == 1
    assert message in done.stderr


def in_opensees(quake_file, dt):
    """Runs the recipe of OpenSeesPy, in a process of its own: its model is global."""
    code = (
        "import runpy, numpy as np, stickslip as ss\n"
        f"names = runpy.run_path({str(RECIPES / 'floor_slider.py')!r})\n"
        f"quake = ss.read_record({str(quake_file)!r})\n"
        "names['frame'](quake)\n"
        "ground = lambda t: float(np.interp(t, quake.time, quake.acceleration))\n"
        f"steps = round(quake.duration / {dt})\n"
        f"for t, a, s in names['follow'](ss.Coulomb(mu=0.2), 2, 1, ground, {dt}, steps):\n"
        "    print(f'{t:.17g} {a:.17g} {s.displacement:.17g}')\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    rows = [line.split() for line in done.stdout.splitlines() if line[:1].isdigit()]
    return np.transpose(rows).astype(float)


def test_a_block_in_opensees_moves_as_it_does_here(pyslammer_files):
    if importlib.util.find_spec("openseespy") is None:
        pytest.skip("openseespy is not installed")
    done = subprocess.run([sys.executable, "-c", "import openseespy.opensees"], check=False)
    if done.returncode != 0:
        pytest.skip("openseespy has no library for this Python or machine")
    file = next(f for f in pyslammer_files if f.name.startswith("Kobe"))
    quake = ss.read_record(file)
    # One story is a structure of one mode.
    wn = 2 * np.pi / 0.5
    story = ss.Structure.shear_building(masses=[1e5], stiffnesses=[1e5 * wn**2], damping_ratio=0.05)
    exact = ss.integrate(ss.EquipmentOnFloor(ss.Coulomb(mu=0.2), story, floor=1), quake)
    errors = []
    for dt in quake.dt / 2, quake.dt / 4:
        time, floor, x = in_opensees(file, dt)
        assert time[-1] == pytest.approx(quake.duration)
        # The block, under the floor that OpenSees computed.
        r = ss.integrate(ss.Coulomb(mu=0.2), ss.GroundMotion(floor, times=time))
        assert x == pytest.approx(r.displacement, abs=1e-11 * r.peak)
        errors.append(abs(abs(x).max() - exact.peak))
    # Newmark's method is of second order; the peak is that of the structure solved exactly.
    assert f"differs by {100 * errors[0] / exact.peak:.2f} % from" in " ".join(PAGE.split())
    assert errors[1] < 0.4 * errors[0]
