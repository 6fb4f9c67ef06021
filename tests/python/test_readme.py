"""What the README shows runs as it stands."""

import math
import re
import shlex
import shutil
import subprocess

import pytest
import stickslip as ss
from pages import README, assert_same_picture, blocks, run
from stickslip.cli import main


def test_the_python_runs_and_draws_the_figure_of_the_page(tmp_path, monkeypatch, capsys):
    """If the figure is not the one that the program draws, draw it with docs/draw_readme.py."""
    plotting = pytest.importorskip("stickslip.plotting")
    monkeypatch.chdir(tmp_path)
    code, _, _ = blocks(README, "python")
    names = {}
    run(README, code, names)
    lines = capsys.readouterr().out.splitlines()
    assert re.fullmatch(r"peak \d+\.\d cm, residual -?\d+\.\d cm, \d+ slips", lines[0])
    assert len(lines) == 5
    shown = re.search(r"!\[[^\]]*\]\(([^)]*)\)", README.read_text(encoding="utf-8"))[1]
    drawn = plotting.save(names["figure"], tmp_path / "figure.png")
    assert_same_picture(drawn, README.parent / shown)
    # The text explains the cart: it is far beyond the reach of its casters.
    assert names["cart"].reach < 0.05
    assert float(lines[1].split()[-2]) == pytest.approx(4.5, abs=0.05)


def test_the_page_shows_the_second_picture_of_the_demo(tmp_path):
    """If it is not the one that the demo draws, draw it with docs/draw_readme.py."""
    pytest.importorskip("matplotlib")
    demo = pytest.importorskip("stickslip.demo")
    _, sweep = demo.draw(ss.sample_records(), tmp_path)
    assert "](docs/images/friction_sweep.png)" in README.read_text(encoding="utf-8")
    assert_same_picture(sweep, README.parent / "docs" / "images" / "friction_sweep.png")


def test_the_ensembles_run(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    _, code, _ = blocks(README, "python")
    names = {}
    run(README, code, names)
    quantile, exceedance, growth = capsys.readouterr().out.splitlines()
    assert quantile.startswith("<Interval: 0.6")
    assert exceedance.startswith("<Interval: 0.1")
    assert growth.startswith("<Estimate: ")
    assert names["e"].member_ranges == [(0, 20_000)]
    assert [file.name for file in tmp_path.iterdir()] == ["run.npz"]


def test_the_theories_run(capsys):
    *_, code = blocks(README, "python")
    run(README, code, {})
    averaged, exact, growth, rms, *table = capsys.readouterr().out.splitlines()
    assert len(averaged.split()) == 2  # a small one, unstable, and a large one
    assert float(exact.rstrip("]").split()[-1]) == pytest.approx(3.3288206151, rel=1e-9)
    assert float(growth) == pytest.approx(10 * math.pi**3, rel=1e-14)
    assert float(rms) == pytest.approx(0.278, rel=0.04)  # 20,000 members, and what the chain claims
    assert "theory / simulation" in table[0]


COMMANDS = [
    shlex.split(line, comments=True)[1:]
    for block in blocks(README, "sh")
    for line in block.splitlines()
    if line.startswith("stickslip ")
]


def test_all_command_lines_are_here():
    assert len(COMMANDS) == 8


@pytest.mark.parametrize(
    "words",
    [pytest.param(words, id=" ".join(words)) for words in COMMANDS],
)
def test_a_command_line_runs(words, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    if "--plot" in words or "thesis" in words:
        pytest.importorskip("matplotlib")
    if words[0] == "thesis":  # one figure where it would be all; all: script/docs
        words = [*words, "A.2"]
    assert main(words) == 0


@pytest.mark.slow
def test_the_cpp_compiles_and_answers(tmp_path):
    compiler = shutil.which("c++")
    if compiler is None:
        pytest.skip("no c++ here")
    (code,) = blocks(README, "cpp")
    source, program = tmp_path / "readme.cpp", tmp_path / "readme"
    source.write_text(code)
    include = f"-I{README.parent / 'include'}"
    subprocess.run([compiler, "-std=c++20", include, source, "-o", program], check=True)
    answer = subprocess.run([program], check=True, capture_output=True, text=True).stdout
    # Pushed at (4 - 1) for 0.3 s, braked at (4 + 1): V = 0.9 m/s, V^2/6 + V^2/10 m, 0.3 + 0.18 s.
    assert answer.startswith("slid 0.2160 m in 0.480 s\n")
