"""docs/flexible_slopes.md: what can be computed again in seconds."""

import re

import pytest
import stickslip as ss
from pages import ROOT, NUMBER, assert_same_table, measuring
from pages import ROOT, assert_same_table, measuring

PAGE = (ROOT / "docs" / "flexible_slopes.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def measured():
    pytest.importorskip("pyslammer")
    return measuring("measure_flexible_slopes")
