"""What the README shows runs as it stands."""

import math
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

README = Path(__file__).parents[2] / "README.md"


def blocks(language):
    return re.findall(rf"```{language}\n(.*?)```", README.read_text(encoding="utf-8"), re.DOTALL)


@pytest.fixture
def kobe(tmp_path, monkeypatch, record_a):
    """A file of the README's name, in PEER's format, in the current directory."""
    samples = [f"{n / 9.80665:.7E}" for n in record_a]
    rows = [" ".join(samples[i : i + 5]) for i in range(0, len(samples), 5)]
    header = [
        "PEER NGA STRONG MOTION DATABASE RECORD",
        "Record A, made for tests",
        "ACCELERATION TIME SERIES IN UNITS OF G",
        f"NPTS= {len(samples)}, DT= .1000 SEC",
    ]
    (tmp_path / "kobe.AT2").write_text("\n".join(header + rows) + "\n")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_the_python_runs(kobe, capsys):
    code, _, _ = blocks("python")
    exec(compile(code, str(README), "exec"), {})
    lines = capsys.readouterr().out.splitlines()
    assert re.fullmatch(r"peak \d+\.\d cm, residual -?\d+\.\d cm, \d+ slips", lines[0])
    assert len(lines) == 5


def test_the_ensembles_run(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    _, code, _ = blocks("python")
    names = {}
    exec(compile(code, str(README), "exec"), names)
    quantile, exceedance, growth = capsys.readouterr().out.splitlines()
    assert quantile.startswith("<Interval: 0.6")
    assert exceedance.startswith("<Interval: 0.1")
    assert growth.startswith("<Estimate: ")
    assert names["e"].member_ranges == [(0, 10_000)]
    assert [file.name for file in tmp_path.iterdir()] == ["run.npz"]


def test_the_theories_run(capsys):
    *_, code = blocks("python")
    exec(compile(code, str(README), "exec"), {})
    averaged, exact, _, growth, rms, *table = capsys.readouterr().out.splitlines()
    assert len(averaged.split()) == 2  # a small one, unstable, and a large one
    assert float(exact.rstrip("]").split()[-1]) == pytest.approx(3.3288206151, rel=1e-9)
    assert float(growth) == pytest.approx(10 * math.pi**3, rel=1e-14)
    assert float(rms) == pytest.approx(0.278, rel=0.04)  # 20,000 members, and what the chain claims
    assert "theory / simulation" in table[0]


def test_the_command_lines_run(kobe):
    commands = [
        line
        for block in blocks("sh")
        for line in block.splitlines()
        if line.startswith("stickslip ")
    ]
    assert len(commands) == 5
    for command in commands:
        words = shlex.split(command)
        assert words[0] == "stickslip"
        if "--plot" in words:
            pytest.importorskip("matplotlib")
        subprocess.run([sys.executable, "-m", *words], check=True, capture_output=True)


def test_the_cpp_compiles_and_answers(tmp_path):
    compiler = shutil.which("c++")
    if compiler is None:
        pytest.skip("no c++ here")
    (code,) = blocks("cpp")
    source, program = tmp_path / "readme.cpp", tmp_path / "readme"
    source.write_text(code)
    include = f"-I{README.parent / 'include'}"
    subprocess.run([compiler, "-std=c++20", include, source, "-o", program], check=True)
    answer = subprocess.run([program], check=True, capture_output=True, text=True).stdout
    # Pushed at (4 - 1) for 0.3 s, braked at (4 + 1): V = 0.9 m/s, V^2/6 + V^2/10 m, 0.3 + 0.18 s.
    assert answer.startswith("slid 0.2160 m in 0.480 s\n")
