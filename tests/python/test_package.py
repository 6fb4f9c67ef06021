"""What the package shows of itself in a fresh interpreter."""

import ast
import importlib
import subprocess
import sys
import tarfile
from graphlib import TopologicalSorter
from importlib.util import find_spec

import pytest
from pages import ROOT


def shown(module):
    script = f"""
import {module} as m
print(*dir(m))
print(*(name for name in dir(m) if not hasattr(m, name)))
"""
    result = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert result.returncode == 0, result.stderr
    names, missing = result.stdout.split("\n")[:2]
    return names.split(), missing.split()


@pytest.mark.parametrize("module", ["stickslip", "stickslip.harmonic", "stickslip.theory"])
def test_a_module_shows_its_public_names_and_nothing_else(module):
    names, missing = shown(module)
    assert missing == []
    assert len(names) == len(set(names))
    assert {n for n in names if not n.startswith("__")} == {
        n for n in importlib.import_module(module).__all__ if not n.startswith("__")
    }
    assert {"__all__", "__doc__", "__file__", "__name__"} <= set(names)


def test_a_submodule_shows_once_it_is_imported():
    script = "import stickslip, stickslip.thesis; print('thesis' in dir(stickslip))"
    assert subprocess.run([sys.executable, "-c", script], capture_output=True).stdout == b"True\n"


def test_modules_do_not_import_each_other_in_a_circle():
    """Not within functions either, nor for type checkers alone. A package counts as one module."""
    folder = ROOT / "python" / "stickslip"
    imports = {}
    for file in folder.rglob("*.py"):
        *outer, name = file.relative_to(folder).with_suffix("").parts
        module = outer[0] if outer else name
        known = imports.setdefault(module, set())
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom) and node.level == len(outer) + 1:
                targets = [node.module] if node.module else [alias.name for alias in node.names]
                known.update(target.partition(".")[0] for target in targets)
    assert imports["comparison"] >= {"ensemble", "plotting", "theory"}  # else it reads nothing
    list(TopologicalSorter(imports).static_order())  # raises CycleError


@pytest.mark.skipif(
    find_spec("scikit_build_core") is None or not (ROOT / ".git").exists(),
    reason="needs scikit-build-core and the repository",
)
def test_a_source_distribution_holds_the_whole_repository(tmp_path):
    """A wheel can then be built from it as from the repository."""
    tree = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, check=True)
    make = "import sys; from scikit_build_core.build import build_sdist; build_sdist(sys.argv[1])"
    subprocess.run([sys.executable, "-c", make, tmp_path], cwd=ROOT, check=True)
    (archive,) = tmp_path.glob("stickslip-*.tar.gz")
    with tarfile.open(archive) as packed:
        names = {name.partition("/")[2] for name in packed.getnames()}
    tracked = {name for name in tree.stdout.decode().split("\0") if name}
    assert tracked - names == set()
    assert archive.stat().st_size < 5e6
