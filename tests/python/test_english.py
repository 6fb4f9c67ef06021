"""Pages, docstrings and comments keep to American spelling and to the terms of the field."""

import ast
import re

import pytest
from pages import ROOT

_BESIDE = (
    *("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "bench/README.md"),
    *("CODE_OF_CONDUCT.md", "SECURITY.md", "paper.md", "RELEASE.md"),
)
PAGES = [
    *(ROOT / name for name in _BESIDE),
    *sorted((ROOT / "docs").glob("*.md")),
    *sorted((ROOT / "docs" / "guides").glob("*.md")),
    *sorted((ROOT / "docs" / "reference").rglob("*.rst")),
]
INSTEAD = {  # what not to write, as a regular expression: what to write
    r"gone on (?:with|from)": "resumed from",
    r"which see": "see",
    r"for ever": "indefinitely, always",
    r"at hand": "available",
    r"heartbeat": "progress callback",
    r"(?:which|that) lies beside": "next to",
    r"a zero at its end": "null-terminated",
    r"until it rests": "until it comes to rest",
    r"unaccounted for": "residual",
    r"meters? of way": "sliding distance",
    r"the motion to come": "the future motion",
    r"by one call a step": "by one call per step",
    r"is told": "is reported, is documented",
    r"so many": "the number itself",
    r"of one's own": "your own",
    r"nothing is to be done for": "no change is needed for",
    r"per cents?": "percent, %",
    r"drawn anew": "redrawn",
    r"(?:dis|multi)?colour\w*": "color",
    r"cent(?:red?|res|ring)": "center",
    r"behaviour\w*": "behavior",
    r"favour\w*": "favor",
    r"(?:centi|milli|kilo)?metres?": "meter",
    r"neighbour\w*": "neighbor",
    r"travell\w+": "traveled",
    r"analys(?:ed?|ing)": "analyze",
    r"licences?": "license",
    r"(?:re)?(?:label|model|cancel|signal)l(?:ed|ing)": "labeled, modeled, canceled, signaled",
    r"un(?:label|model)led": "unlabeled, unmodeled",
    r"(?:\w*(?:linear|synchron|normal)|categor|character|discret|factor|general|initial|local|maxim|minim"
    r"|optim|organ|parameter|random|recogn|sanit|serial|stabil|standard|summar|symmetr|util|vector"
    r"|visual)is(?:e[ds]?|ing|ers?|ations?)": "-ize",
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


COMMENT_OR_LITERAL = re.compile(
    r"""
    (?P<comment>//[^\n]*|/\*.*?\*/)
    |R"(?P<mark>[^(\s]*)\(.*?\)(?P=mark)"  # a raw string
    |"(?:\\.|[^"\\\n])*"
    |(?<!\w)'(?:\\.|[^'\\\n])+'  # a character; the ' between digits follows a digit
    """,
    re.DOTALL | re.VERBOSE,
)


FORTRAN_COMMENT_OR_LITERAL = re.compile(
    r"""(?P<comment>![^\n]*) | "[^"\n]*" | '[^'\n]*'""", re.VERBOSE
)


def comments(code, pattern=COMMENT_OR_LITERAL):
    """The code with all but its comments blanked; lines keep their numbers."""
    shown, end = [], 0
    for found in pattern.finditer(code):
        start = found.end() if found["comment"] is None else found.start()
        shown += [re.sub(r"[^\n]", " ", code[end:start]), code[start : found.end()]]
        end = found.end()
    text = "".join([*shown, re.sub(r"[^\n]", " ", code[end:])])
    return re.sub(
        r"^( *)(?://[/]?<?|!>?)", lambda mark: " " * len(mark[0]), text, flags=re.MULTILINE
    )


WRONG = {
    re.compile(rf"\b(?:{words})\b", re.IGNORECASE): better
    for words, better in ((old.replace(" ", r"\s+"), better) for old, better in INSTEAD.items())
}
ANY_WRONG = re.compile("|".join(pattern.pattern for pattern in WRONG), re.IGNORECASE)


def wrong(text):
    """Line, words and what to write instead, of each word or phrase to avoid."""
    text = prose(text)
    if not ANY_WRONG.search(text):  # ten times faster than each by its own
        return
    for pattern, better in WRONG.items():
        for found in pattern.finditer(text):
            yield text.count("\n", 0, found.start()) + 1, found[0], better


def test_pages_have_no_word_to_avoid():
    found = [
        f"{page.relative_to(ROOT)}:{line}: '{words}', write '{better}'"
        for page in PAGES
        for line, words, better in wrong(page.read_text(encoding="utf-8"))
    ]
    assert not found, "\n".join(found)


MODULES = sorted((ROOT / "python" / "stickslip").rglob("*.py"))


def test_modules_have_no_word_to_avoid_in_their_strings():
    """Docstrings, help texts and messages; names and keywords are not read."""
    found = [
        f"{module.relative_to(ROOT)}:{node.lineno}: '{words}', write '{better}'"
        for module in MODULES
        for node in ast.walk(ast.parse(module.read_text(encoding="utf-8")))
        if isinstance(node, ast.Constant) and isinstance(node.value, str)
        for _, words, better in wrong(node.value)
    ]
    assert not found, "\n".join(found)


SOURCES = sorted(
    file
    for folder in (
        "include",
        "src",
        "python/bindings",
        "bench",
        "reproduction",
        "examples",
        "tests",
    )
    for file in (ROOT / folder).rglob("*")
    if file.suffix in {".c", ".cpp", ".f90", ".h", ".hpp", ".inl"}
)


def comments_of(source):
    pattern = FORTRAN_COMMENT_OR_LITERAL if source.suffix == ".f90" else COMMENT_OR_LITERAL
    return comments(source.read_text(encoding="utf-8"), pattern)


def test_comments_have_no_word_to_avoid():
    found = [
        f"{source.relative_to(ROOT)}:{line}: '{words}', write '{better}'"
        for source in SOURCES
        for line, words, better in wrong(comments_of(source))
    ]
    assert not found, "\n".join(found)


def test_comments_are_read_and_literals_are_not():
    code = """int centre = 1'000;  // a coloured
    // line, for
    /// ever
auto s = "// metre", r = R"x(/* " behaviour )" */)x"; char c = '"';  /* so
many */
double so = 1;  // Neighbours
"""
    assert sorted((line, words) for line, words, _ in wrong(comments(code))) == [
        (1, "coloured"),
        (2, "for\n        ever"),
        (4, "so\nmany"),
        (6, "Neighbours"),
    ]


@pytest.mark.parametrize(
    "word", ["coloured", "Colours", "multicoloured", "relinearise", "modelling"]
)
def test_british_spelling_is_found(word):
    assert [found for _, found, _ in wrong(f"a {word} thing")] == [word]


@pytest.mark.parametrize("word", ["colored", "centered", "analyses", "modeled", "organisms"])
def test_american_spelling_is_not(word):
    assert not list(wrong(f"a {word} thing"))


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


def test_comments_of_fortran_are_read_and_literals_are_not():
    code = """x = 'a ! coloured' ! a centre
! so
! many
print *, "metre"
"""
    found = wrong(comments(code, FORTRAN_COMMENT_OR_LITERAL))
    assert [(line, words.split()) for line, words, _ in found] == [
        (2, ["so", "many"]),
        (1, ["centre"]),
    ]
