"""The pages keep to American spelling and to the terms of the field."""

import ast
import re

import pytest
from pages import ROOT

PAGES = [
    *(ROOT / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "bench/README.md")),
    *sorted((ROOT / "docs").glob("*.md")),
    *sorted((ROOT / "docs" / "guides").glob("*.md")),
]
INSTEAD = {  # what not to write, as a regular expression: what to write
    r"gone on (?:with|from)": "resumed from",
    r"which see": "see",
    r"for ever": "indefinitely, always",
    r"at hand": "available",
    r"heartbeat": "progress callback",
    r"is told": "is reported, is documented",
    r"so many": "the number itself",
    r"of one's own": "your own",
    r"nothing is to be done for": "no change is needed for",
    r"per cents?": "percent, %",
    r"drawn anew": "redrawn",
    r"colou?red|colours?|colour\w+": "color",
    r"centred|centres?": "center",
    r"behaviours?": "behavior",
    r"(?:centi|milli|kilo)?metres?": "meter",
    r"neighbour\w*": "neighbor",
    r"travell\w+": "traveled",
    r"analysed?": "analyze",
    r"licences?": "license",
    r"(?:label|model)led|modelling": "labeled, modeled, modeling",
    r"(?:sanit|synchron|normal|linear|general|optim|recogn)is(?:e[ds]?|ing|ers?|ation)": "-ize",
}


def prose(text):
    """The text with code, links' targets and formulas blanked; lines keep their numbers."""
    shown_as_is = r"^```.*?^```|`[^`]*`|\]\([^)]*\)|\$\$.*?\$\$|\$[^$\n]*\$"
    return re.sub(
        shown_as_is,
        lambda found: re.sub(r"[^\n]", " ", found[0]),
        text,
        flags=re.DOTALL | re.MULTILINE,
    )


def wrong(text):
    """Line, words and what to write instead, of each word or phrase to avoid."""
    for pattern, better in INSTEAD.items():
        words = pattern.replace(" ", r"\s+")
        for found in re.finditer(rf"\b(?:{words})\b", prose(text), re.IGNORECASE):
            yield text.count("\n", 0, found.start()) + 1, found[0], better


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_a_page_has_no_word_to_avoid(page):
    found = [
        f"{page.relative_to(ROOT)}:{line}: '{words}', write '{better}'"
        for line, words, better in wrong(page.read_text(encoding="utf-8"))
    ]
    assert not found, "\n".join(found)


MODULES = sorted((ROOT / "python" / "stickslip").rglob("*.py"))


@pytest.mark.parametrize("module", MODULES, ids=lambda module: module.relative_to(ROOT).as_posix())
def test_a_module_has_no_word_to_avoid_in_its_strings(module):
    """Docstrings, help texts and messages; names and keywords are not read."""
    found = [
        f"{module.relative_to(ROOT)}:{node.lineno}: '{words}', write '{better}'"
        for node in ast.walk(ast.parse(module.read_text(encoding="utf-8")))
        if isinstance(node, ast.Constant) and isinstance(node.value, str)
        for _, words, better in wrong(node.value)
    ]
    assert not found, "\n".join(found)


def test_words_to_avoid_are_found_and_code_is_not_read():
    text = (
        "A run is gone\non with.\n```\nthe centre\n```\n`centre_frequency_hz`, the Centre, analyses"
    )
    assert [(line, words) for line, words, _ in wrong(text)] == [
        (1, "gone\non with"),
        (6, "Centre"),
    ]


def test_the_terms_are_those_that_developers_read():
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    assert "`gone on with`" in text and "`heartbeat`" in text
    assert "test_english.py" in text
