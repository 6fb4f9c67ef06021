"""What the guides show runs as it stands: Python, commands of the shell, whole C++ programs."""

import math
import re
import shlex
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
import stickslip as ss
from pages import write_records
from stickslip.cli import main

DOCS = Path(__file__).parents[2] / "docs"
PAGES = [
    DOCS / "start.md",
    DOCS / "coming_from.md",
    DOCS / "trust.md",
    DOCS / "ground_motions.md",
    DOCS / "command.md",
    DOCS / "contact.md",
    DOCS / "refinements.md",
    DOCS / "sweeps.md",
    DOCS / "conventions.md",
    *sorted((DOCS / "guides").glob("*.md")),
]


def blocks(language):
    """The blocks of all pages, each as a parameter that is named after its page and line."""
    found = []
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        for block in re.finditer(rf"^```{language}\n(.*?)^```", text, re.DOTALL | re.MULTILINE):
            line = text[: block.start(1)].count("\n") + 1
            slow = [pytest.mark.slow] * ("thesis --check" in block[1])
            found.append(pytest.param(block[1], id=f"{page.stem}-{line}", marks=slow))
    return found


@pytest.fixture
def empty(tmp_path, monkeypatch, pyslammer_files, request):
    """An empty current directory: code of a page is copied and pasted, and finds nothing there.

    The pages on ground motions and on the command read files of the reader's: for them there are
    some of their names.
    """
    if "ground_motions" in request.node.name or "[command" in request.node.name:
        record = ss.read_record(next(f for f in pyslammer_files if f.name.startswith("Kobe")))
        write_records(tmp_path, "Kobe, Japan 1995, TAK", record.acceleration, record.dt)
    if "[command" in request.node.name:
        for name, twin in (("north", "RSN1_H1"), ("east", "RSN1_H2"), ("up", "RSN1_UP")):
            (tmp_path / f"{name}.AT2").rename(tmp_path / f"{twin}.AT2")
        column = (tmp_path / "column.txt").read_text()
        (tmp_path / "pairs").mkdir()
        for name in ("a.txt", "b.txt", "c.txt", "pairs/a.txt", "pairs/b.txt"):
            (tmp_path / name).write_text(column)
        (tmp_path / "pairs.csv").write_text("file,dt\na.txt,0.01\nb.txt,0.02\n")
    monkeypatch.chdir(tmp_path)


def test_every_guide_has_code():
    assert len(PAGES) == 15
    kinds = ("python", "cpp", "sh")
    pages = {param.id.rsplit("-", 1)[0] for kind in kinds for param in blocks(kind)}
    assert pages == {page.stem for page in PAGES}


@pytest.mark.parametrize("code", blocks("python"))
def test_the_python_runs(code, empty, capsys):
    if "plot" in code or "animate" in code:
        pytest.importorskip("matplotlib")
    exec(compile(code, "guide", "exec"), {"__name__": "guide"})
    assert "nan" not in capsys.readouterr().out


@pytest.mark.parametrize("block", blocks("sh"))
def test_the_commands_run(block, empty):
    for line in block.splitlines():
        words = shlex.split(line, comments=True)
        if not words or words[0] != "stickslip":
            continue
        if "--plot" in words:
            pytest.importorskip("matplotlib")
        assert main(words[1:]) == 0


def test_the_table_of_the_first_page_is_the_one_printed(empty, capsys):
    assert main(["slide", "sample:Kobe", "--mu", "0.1", "0.2", "0.3"]) == 0
    printed = capsys.readouterr().out
    shown = (DOCS / "start.md").read_text(encoding="utf-8").splitlines()
    figures = [line.split()[-6:] for line in printed.splitlines()[1:]]  # mu and what follows it
    assert len(figures) == 3
    assert all(row in [line.split()[-6:] for line in shown] for row in figures)


@pytest.mark.slow
@pytest.mark.parametrize("code", blocks("cpp"))
def test_the_cpp_compiles_and_runs(code, tmp_path):
    compiler = shutil.which("c++")
    if compiler is None:
        pytest.skip("no c++ here")
    source, program = tmp_path / "guide.cpp", tmp_path / "guide"
    source.write_text(code)
    include = f"-I{DOCS.parent / 'include'}"
    command = [compiler, "-std=c++20", "-pthread", include, source, "-o", program]
    subprocess.run(command, check=True)
    answer = subprocess.run([program], check=True, capture_output=True, text=True).stdout
    for expected in re.findall(r"printf\(.*?// (.*)$", code, re.MULTILINE):
        assert expected in answer


@pytest.mark.parametrize(
    "compiler, code",
    [
        pytest.param(compiler, *block.values, id=f"{language}-{block.id}")
        for language, compiler in (("c", "cc"), ("fortran", "gfortran"))
        for block in blocks(language)
    ],
)
def test_the_c_and_the_fortran_are_valid(compiler, code, tmp_path):
    """With the header and the module as installed, and no warning; the consumer tests run them."""
    if shutil.which(compiler) is None:
        pytest.skip(f"no {compiler} here")
    include = DOCS.parent / "include"
    source = tmp_path / ("guide.c" if compiler == "cc" else "guide.f90")
    source.write_text(code)
    files = [source] if compiler == "cc" else [include / "stickslip" / "stickslip.f90", source]
    options = ["-Wall", "-Wextra", "-Werror", "-fsyntax-only"]
    for file in files:  # the first one leaves its module in the folder
        command = [compiler, *options, f"-I{include}", f"-I{tmp_path}", file]
        subprocess.run(command, check=True, cwd=tmp_path)


@pytest.mark.parametrize("page", ["equipment", "isolation"])
def test_what_is_printed_is_shown(page, capsys):
    """Where text follows the code, it is what the code prints."""
    text = (DOCS / "guides" / f"{page}.md").read_text(encoding="utf-8")
    shown = re.findall(r"^```python\n([^`]*)^```\n\n```text\n(.*?)^```", text, re.S | re.M)
    assert shown
    for code, printed in shown:
        exec(compile(code, page, "exec"), {"__name__": page})
        assert capsys.readouterr().out == printed


# ---- the tables, slid again


def rows(page, heading):
    """Cells of the table whose first line begins so."""
    lines = (DOCS / "guides" / page).read_text(encoding="utf-8").splitlines()
    begin = next(i for i, line in enumerate(lines) if line.startswith(heading)) + 2
    end = next(i for i in range(begin, len(lines)) if not lines[i].startswith("|"))
    return [[cell.strip(" *") for cell in line.strip("|").split("|")] for line in lines[begin:end]]


def agree(shown, found):
    """The figures of a row, each to the digits that are shown; a last digit off by one passes."""
    assert len(shown) == len(found)
    for text, value in zip(shown, found):
        places = len(text.partition(".")[2])
        assert value == pytest.approx(float(text), abs=1.01 * 10.0**-places)


@pytest.fixture(scope="module")
def quakes(pyslammer_files):
    return [ss.read_record(file) for file in pyslammer_files]


def slide(law, quakes, period=math.inf):
    """Peaks, residuals [cm] and what is transmitted [g]."""
    wn = 2 * math.pi / period
    slider = ss.Slider(law, natural_frequency=wn)
    responses = [ss.integrate(slider, quake, settle=True) for quake in quakes]
    peak = np.array([r.peak for r in responses])
    held = [0 if r.slips else quake.peak_acceleration for r, quake in zip(responses, quakes)]
    transmitted = np.where(held, held, law.slip_level + wn**2 * peak) / ss.STANDARD_GRAVITY
    return 100 * peak, 100 * np.array([abs(r.residual) for r in responses]), transmitted


def test_the_table_of_blocks(quakes):
    for mu, *shown in rows("equipment.md", "| mu | peak"):
        peak, residual, _ = slide(ss.Coulomb(mu=float(mu)), quakes)
        shown[-1] = shown[-1].split()[0]
        middle = [np.median(peak), np.percentile(peak, 84), peak.max()]
        agree(shown, [*middle, np.median(residual), residual.max(), np.sum(peak == 0)])


def test_the_table_of_casters(quakes):
    for mu, trail, width, *shown in rows("equipment.md", "| mu | trail"):
        law = ss.Caster.from_geometry(
            mu=float(mu), trail=float(trail) / 100, wheel_width=float(width) / 100
        )
        responses = [ss.integrate(law, quake) for quake in quakes]
        within = [r.peak <= law.reach for r in responses]
        rolling = [not r.at_rest for r in responses]
        counts = [sum(within), len(quakes) - sum(within) - sum(rolling), sum(rolling)]
        agree(shown, [law.slip_level / ss.STANDARD_GRAVITY, 100 * law.reach, *counts])
        assert not np.logical_and(within, rolling).any()


def test_the_table_of_slopes(quakes):
    *table, medians = rows("slopes.md", "| record |")
    both = []
    for (_, pga, *shown), quake in zip(table, quakes, strict=True):
        found = [
            100 * ss.integrate(ss.Coulomb(mu=ky, backward=math.inf), motion, settle=True).residual
            for ky in (0.05, 0.1, 0.2)
            for motion in (quake, quake.scaled(-1))
        ]
        agree([pga, *shown], [quake.peak_acceleration / ss.STANDARD_GRAVITY, *found])
        both.append(found)
    means = np.array(both).reshape(-1, 3, 2).mean(axis=2)
    agree([cell for cell in medians[1:] if cell], np.median(means, axis=0))


@pytest.mark.parametrize("heading", ["| mu | peak", "| period"])
def test_the_tables_of_floors(quakes, heading):
    for first, *shown in rows("isolation.md", heading):
        by_mu = heading.startswith("| mu")
        mu = float(first) if by_mu else 0.06
        period = 3.0 if by_mu else math.inf if first == "no spring" else float(first)
        peak, residual, transmitted = slide(ss.Coulomb(mu=mu), quakes, period)
        (p50, p84), (r50, r84), (t50, t84) = (
            np.percentile(figure, (50, 84)) for figure in (peak, residual, transmitted)
        )
        bound = 100 * mu * ss.STANDARD_GRAVITY * (period / (2 * math.pi)) ** 2
        if by_mu:
            agree(shown, [p50, p84, r50, r84, t50, t84])
        else:
            found = [p50, p84, peak.max(), r50, r84, residual.max(), bound, t84]
            agree(*zip(*((text, value) for text, value in zip(shown, found) if text)))
