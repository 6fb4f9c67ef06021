"""What the package shows of itself in a fresh interpreter."""

import ast
import importlib
import subprocess
import sys
from graphlib import TopologicalSorter

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
    """Not within functions either, nor for type checkers alone."""
    files = {file.stem: file for file in (ROOT / "python" / "stickslip").glob("*.py")}
    imports = {}
    for name, file in files.items():
        imports[name] = set()
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom) and node.level == 1:
                names = [node.module] if node.module else [alias.name for alias in node.names]
                imports[name].update(set(names) & files.keys())
    assert imports["comparison"] >= {"plotting", "theory"}  # else they are not read as written
    list(TopologicalSorter(imports).static_order())  # raises CycleError
