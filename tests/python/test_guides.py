"""What the guides show runs as it stands: Python, commands of the shell, whole C++ programs."""

import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import stickslip as ss

DOCS = Path(__file__).parents[2] / "docs"
PAGES = [DOCS / "start.md", DOCS / "conventions.md", *sorted((DOCS / "guides").glob("*.md"))]


def blocks(language):
    """The blocks of all pages, each as a parameter that is named after its page and line."""
    found = []
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        for block in re.finditer(rf"^```{language}\n(.*?)^```", text, re.DOTALL | re.MULTILINE):
            line = text[: block.start(1)].count("\n") + 1
            found.append(pytest.param(block[1], id=f"{page.stem}-{line}"))
    return found


@pytest.fixture
def kobe(tmp_path, monkeypatch, pyslammer_files):
    """The file of the guides' name, in PEER's format, in the current directory; Kobe itself."""
    record = ss.read_record(next(f for f in pyslammer_files if f.name.startswith("Kobe")))
    samples = [f"{n / ss.STANDARD_GRAVITY:.7E}" for n in record.acceleration]
    header = [
        "PEER NGA STRONG MOTION DATABASE RECORD",
        "Kobe, Japan 1995, TAK, 90",
        "ACCELERATION TIME SERIES IN UNITS OF G",
        f"NPTS= {len(samples)}, DT= {record.dt:.4f} SEC",
    ]
    rows = [" ".join(samples[i : i + 5]) for i in range(0, len(samples), 5)]
    (tmp_path / "kobe.AT2").write_text("\n".join(header + rows) + "\n")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_every_guide_has_code():
    assert len(PAGES) == 7
    pages = {param.id.rsplit("-", 1)[0] for kind in ("python", "cpp") for param in blocks(kind)}
    assert pages == {page.stem for page in PAGES}


@pytest.mark.parametrize("code", blocks("python"))
def test_the_python_runs(code, kobe, capsys):
    if "plot" in code:
        pytest.importorskip("matplotlib")
    exec(compile(code, "guide", "exec"), {"__name__": "guide"})
    assert "nan" not in capsys.readouterr().out


@pytest.mark.parametrize("block", blocks("sh"))
def test_the_commands_run(block, kobe):
    for line in block.splitlines():
        words = shlex.split(line, comments=True)
        if not words or words[0] != "stickslip":
            continue
        if "--plot" in words:
            pytest.importorskip("matplotlib")
        subprocess.run([sys.executable, "-m", *words], check=True, capture_output=True)


def test_the_table_of_the_first_page_is_the_one_printed(kobe):
    command = [sys.executable, "-m", "stickslip", "slide", "kobe.AT2", "--mu", "0.1", "0.2", "0.3"]
    printed = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    shown = (DOCS / "start.md").read_text(encoding="utf-8").splitlines()
    figures = [line.split()[-6:] for line in printed.splitlines()[1:]]  # mu and what follows it
    assert len(figures) == 3
    assert all(row in [line.split()[-6:] for line in shown] for row in figures)


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
