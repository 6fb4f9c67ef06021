"""What the tests share: the reference's record A, and real records where there are any."""

import importlib.util
import os
import re
import shutil
import signal
import subprocess
import sys
from decimal import Decimal, localcontext
from pathlib import Path

import numpy as np
import pytest
from pages import ROOT, write_records

if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
    # So has a shell that runs the tests in the background set it, also for the programs that they
    # start: those that send Ctrl-C would wait for ever.
    signal.signal(signal.SIGINT, signal.default_int_handler)


def sine_and_cosine(x):
    """By Taylor series, to the digits of the context."""
    sine, cosine, term, k = Decimal(0), Decimal(0), Decimal(1), 0
    while abs(term) > Decimal(10) ** -60:
        if k % 2:
            sine += term if k % 4 == 1 else -term
        else:
            cosine += term if k % 4 == 0 else -term
        k += 1
        term *= x / k
    return sine, cosine


@pytest.fixture(scope="session")
def record_a():
    """n_m = 2 sin(0.7 m) + 1.3 cos(1.9 m + 0.4), m = 0 .. 400, every sample rounded once.

    Sines of doubles near 760 would be wrong by 3e-14. Here the angles are added up by rotation, in
    60 digits, of which 400 rotations lose fewer than three.
    """
    with localcontext() as context:
        context.prec = 60
        s, c = Decimal(0), Decimal(1)
        slow_s, slow_c = sine_and_cosine(Decimal("0.7"))
        fs, fc = sine_and_cosine(Decimal("0.4"))
        fast_s, fast_c = sine_and_cosine(Decimal("1.9"))
        samples = []
        for _ in range(401):
            samples.append(float(2 * s + Decimal("1.3") * fc))
            s, c = s * slow_c + c * slow_s, c * slow_c - s * slow_s
            fs, fc = fs * fast_c + fc * fast_s, fc * fast_c - fs * fast_s
    array = np.array(samples)
    array.flags.writeable = False
    return array


@pytest.fixture
def kobe(tmp_path, monkeypatch, record_a):
    """Files of the documentation's names, in the current directory."""
    write_records(tmp_path, "Record A, made for tests", record_a, 0.1)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture(scope="session")
def pyslammer_files():
    """The 18 records that the package pyslammer carries, found without the slow import of it."""
    spec = importlib.util.find_spec("pyslammer")
    if spec is None or not spec.submodule_search_locations:
        pytest.skip("real records come with pyslammer: pip install stickslip[records]")
    files = sorted(Path(spec.submodule_search_locations[0], "sample_ground_motions").glob("*.csv"))
    assert len(files) == 18
    return files


@pytest.fixture(scope="session")
def agency_files():
    """Records in the formats of agencies, in the folder that $STICKSLIP_RECORDS names."""
    folder = os.environ.get("STICKSLIP_RECORDS")
    if not folder or not Path(folder).is_dir():
        pytest.skip("no agency files: set STICKSLIP_RECORDS to a folder of them")
    return Path(folder)


@pytest.fixture(scope="session")
def compile_for_c():
    """Compiles a file of src for the interface in C."""
    compiler = os.environ.get("CXX", "c++")
    if shutil.which(compiler) is None:
        pytest.skip("no C++ compiler here")
    cache = [path] if (path := shutil.which("ccache")) else []
    flags = ["-std=c++20", "-O0", "-fPIC", f"-I{ROOT / 'include'}", f"-I{ROOT / 'src'}"]

    def compile_for_c(source, out):
        command = [*cache, compiler, *flags, "-c", ROOT / "src" / source, "-o", out]
        subprocess.run(command, check=True)

    return compile_for_c


@pytest.fixture(scope="session")
def beside_source(tmp_path_factory, compile_for_c):
    """A folder with the source of stickslip in it, and the interface in C compiled.

    That is where the commands of docs/guides/other_tools.md run.
    """
    folder = tmp_path_factory.mktemp("beside")
    (folder / "stickslip").symlink_to(ROOT)
    compile_for_c("stickslip.cpp", folder / "stickslip.o")
    return folder


@pytest.fixture(scope="session")
def run_page(beside_source):
    """Runs the commands of docs/guides/other_tools.md that have these words; returns the folder."""
    page = (ROOT / "docs" / "guides" / "other_tools.md").read_text(encoding="utf-8")

    def run_page(words):
        blocks = re.findall(r"^```text\n(.*?)^```", page, re.DOTALL | re.MULTILINE)
        lines = [line for block in blocks for line in block.splitlines() if words in line]
        assert lines, words
        for line in lines:
            line = re.sub("^python ", f"{sys.executable} ", line)
            subprocess.run(line, shell=True, cwd=beside_source, check=True)
        return beside_source

    return run_page
