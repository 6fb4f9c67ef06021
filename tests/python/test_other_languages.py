"""Example 8 in Octave and Julia, and the interface in C as they see it."""

import ctypes
import math
import re
import shutil
import subprocess

import pytest
import stickslip as ss
from pages import ROOT

pytestmark = pytest.mark.slow

EXAMPLES = ROOT / "examples"
HEADER = (ROOT / "include" / "stickslip" / "stickslip.h").read_text(encoding="utf-8")
LINE = "after the earthquake the block is {:.4f} m from where it stood, at rest"


def fields(name):
    """The names and types of a struct of the header."""
    body = re.search(rf"typedef struct {name} {{\n(.*?)\n}} {name};", HEADER, re.DOTALL)[1]
    return [(n, t) for t, n in re.findall(r"^  (double|int) (\w+);", body, re.MULTILINE)]


def loop(advance):
    """The building of example 8 and the block on it; the state at the end."""
    dt, wn = 0.005, 2 * math.pi / 0.5
    x = v = before = 0.0
    block = None
    for i in range(1, 2001):
        t = i * dt
        pull = wn * wn * x + 2 * 0.05 * wn * v
        v -= (2 * math.exp(-t / 4) * math.sin(2 * math.pi * t / 0.5) + pull) * dt
        x += v * dt
        block = advance(block, dt, before, -pull)
        before = -pull
    return block


@pytest.fixture(scope="module")
def expected():
    slider = ss.Coulomb(mu=0.3)

    def advance(block, *segment):
        return ss.advance(slider, block or ss.State(), *segment)

    block = loop(advance)
    assert block.stuck and block.displacement > 1e-3
    return block.displacement


def octave(code, folder):
    done = subprocess.run(
        ["octave-cli", "--norc", "--path", str(EXAMPLES / "matlab"), "--eval", code],
        cwd=folder,
        capture_output=True,
        text=True,
        check=True,
    )
    return done.stdout.splitlines()


@pytest.fixture(scope="module")
def mex(run_page):
    """A folder with the MEX function."""
    if shutil.which("mkoctfile") is None or shutil.which("octave-cli") is None:
        pytest.skip("no Octave here: apt-get install octave-dev")
    return run_page("mkoctfile")


def test_octave(mex, expected):
    line, block = octave("time_loop; printf('%.17g ', block)", mex)
    assert line == LINE.format(expected)
    x, v, mode, *flight = map(float, block.split())
    # Octave's exp and sin may differ by their last bit: 2000 steps of them.
    assert x == pytest.approx(expected, abs=1e-12)
    assert (v, mode, *flight) == (0, 0, 0, 0, 0)


def test_the_mex_function_takes_every_field():
    source = (EXAMPLES / "matlab" / "stickslip_advance.c").read_text(encoding="utf-8")
    for name in "slider", "segment":
        taken = re.findall(rf"TAKE\({name}, (\w+)\)", source)
        assert taken == [field for field, _ in fields(f"stickslip_{name}")]


@pytest.mark.parametrize(
    "arguments, message",
    [
        ("struct('slip_level', -1), struct(), zeros(1, 6)", "slip_level must be finite and at"),
        ("struct('mu', 1), struct(), zeros(1, 6)", "stickslip_slider has no field mu"),
        ("struct(), struct('dt', 1), zeros(1, 6)", "stickslip_segment has no field dt"),
        ("struct('gap', {}), struct(), zeros(1, 6)", "two structs, 6 numbers"),
        ("struct(), struct(), zeros(1, 5)", "two structs, 6 numbers"),
    ],
)
def test_octave_says_what_is_wrong(mex, arguments, message):
    code = f"try, stickslip_advance({arguments}), catch e, disp([e.identifier ' ' e.message]), end"
    (said,) = octave(code, mex)
    assert said.startswith("stickslip:invalid") and message in said


@pytest.fixture(scope="module")
def shared_library(run_page):
    return run_page("c++ -shared stickslip.o") / "libstickslip_c.so"


def test_the_structs_of_julia_are_those_of_the_header(shared_library, expected):
    """Calls the library with the structs of the example, as Julia would lay them out."""
    source = (EXAMPLES / "julia" / "time_loop.jl").read_text(encoding="utf-8")
    kinds = {"Cdouble": ctypes.c_double, "Cint": ctypes.c_int}
    structs = []
    for name in "Slider", "Segment", "State":
        body = re.search(rf"struct {name}\n(.*?)\nend", source, re.DOTALL)[1]
        members = re.findall(r"^    (\w+)::(\w+)", body, re.MULTILINE)
        typed = [(n.rstrip("_"), t.removeprefix("C")) for n, t in members]
        assert typed == fields(f"stickslip_{name.lower()}")
        of = [(n, kinds[t]) for n, t in members]
        structs.append(type(name, (ctypes.Structure,), {"_fields_": of}))
    slider_of, segment_of, state_of = structs
    library = ctypes.CDLL(str(shared_library))
    slider = slider_of(slip_level=0.3 * ss.STANDARD_GRAVITY)

    def advance(block, *segment):
        block = block or state_of()
        references = map(ctypes.byref, (slider, segment_of(*segment), block))
        assert library.stickslip_advance(*references) == 0
        return block

    assert loop(advance).displacement == expected


def test_julia(shared_library, expected):
    if shutil.which("julia") is None:
        pytest.skip("no Julia here: its example is checked by the test above alone")
    command = ["julia", EXAMPLES / "julia" / "time_loop.jl", shared_library]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout.strip() == LINE.format(expected)
