"""How many tests there are, for pages that say so: {{ cpp_tests }}, {{ python_tests }}."""

import re
from pathlib import Path

TESTS = Path(__file__).parents[2] / "tests"
MARKS = {
    "cpp_tests": ("*.cpp", re.compile(r"^(?:TEMPLATE_(?:LIST_)?)?TEST_CASE\(", re.MULTILINE)),
    "python_tests": ("test_*.py", re.compile(r"^def test_", re.MULTILINE)),
}


def counts():
    """By name: test cases in C++, test functions in Python."""
    return {
        name: sum(
            len(mark.findall(file.read_text(encoding="utf-8"))) for file in TESTS.rglob(pattern)
        )
        for name, (pattern, mark) in MARKS.items()
    }
