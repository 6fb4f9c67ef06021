"""The documentation: its code runs, its links hold, it has the equations that the code cites."""

import ast
import itertools
import re
from html.parser import HTMLParser
from urllib.parse import unquote, urlsplit

import pytest
from pages import ROOT, blocks, run
from test_guides import PAGES as GUIDES  # whose blocks run there, one by one

DOCS = ROOT / "docs"
SITE = ROOT / "build" / "docs" / "html"
PAGES = sorted(DOCS.rglob("*.md"))
MOST_MEMBERS = 2000  # of an ensemble in a page's code, here
ELSEWHERE = {
    "errata.md",
    "examples.md",
}  # pages whose code and what it prints have a test of their own

SLOW = {"transport.md"}
NUMBER = r"(?:[2-5]|A|W)\.[1-9][0-9]?"


# ---- code


@pytest.mark.parametrize(
    "page",
    [
        pytest.param(page, marks=[pytest.mark.slow] * (page.name in SLOW or page in GUIDES))
        for page in PAGES
        if page.name not in ELSEWHERE and blocks(page, "python")
    ],
    ids=lambda page: page.relative_to(DOCS).as_posix(),
)
def test_the_python_of_a_page_runs(page, kobe):
    """All blocks of a page, one after the other, in a folder that has a record."""
    names = {"__name__": "__main__"}
    for code in blocks(page, "python"):
        if "plot(" in code or "matplotlib" in code:
            pytest.importorskip("matplotlib")
        fewer = re.sub(
            r"\bmembers=([\d_]+)(?=\s*[,)])",
            lambda m: f"members={min(int(m[1]), MOST_MEMBERS)}",
            code,
        )
        run(page, fewer, names)


# ---- structure


def test_headings_quotations_and_pictures_are_blocks_of_their_own():
    """Where lines of a page are filled anew, these must not end up inside a paragraph."""
    inside = re.compile(r"\S\s+#{2,6}\s+\S|[.:;)] +> +\S|!\[")
    picture = re.compile(r"\s*!\[[^\]]*\]\([^()]*\)\s*")
    found, pictures = [], 0
    for page in [*PAGES, ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "CHANGELOG.md"]:
        text = page.read_text(encoding="utf-8")
        text = re.sub(r"^( *)(```+).*?^\1\2 *$", "", text, flags=re.MULTILINE | re.DOTALL)
        text = re.sub(r"`[^`]*`", "code", text)
        for block in re.split(r"\n\s*\n", text):
            if picture.fullmatch(block):
                pictures += 1
            elif match := inside.search(block):
                found.append(
                    f"{page.name}: ...{block[max(match.start() - 30, 0) : match.end() + 30]}"
                )
    assert pictures > 15  # else the pages are not read as they are written
    assert not found


# ---- numbers


def test_the_number_of_tests_is_counted_and_nowhere_typed(monkeypatch):
    monkeypatch.syspath_prepend(DOCS / "_ext")
    from counts import counts

    found = counts()
    functions = 0
    for file in (ROOT / "tests" / "python").glob("test_*.py"):
        tree = ast.parse(file.read_text(encoding="utf-8"))
        functions += sum(
            isinstance(node, ast.FunctionDef) and node.name.startswith("test_")
            for node in tree.body
        )
    assert found["python_tests"] == functions
    names = set()
    for page in [ROOT / "README.md", *PAGES]:
        text = page.read_text(encoding="utf-8")
        assert not re.search(r"\d test (?:cases|functions)", text), page
        names |= set(re.findall(r"\{\{ (\w+) \}\}", text))
    assert names == set(found)


@pytest.mark.slow
def test_the_site_says_how_many_tests_there_are(site):
    text = (SITE / "validation.html").read_text(encoding="utf-8")
    words = " ".join(text.split())
    assert re.search(r"\d+ test cases in C\+\+, \d+ test functions in Python", words)


# ---- the thesis


def test_the_thesis_is_cited_by_its_title_where_its_numbers_are_used():
    title = "The Response of Stick-Slip Systems to Random Seismic Excitation"
    for file in ("README.md", "CITATION.cff", "docs/index.md", "docs/gallery.md", "docs/errata.md"):
        text = " ".join((ROOT / file).read_text(encoding="utf-8").split())
        assert title in text, file
        if file != "docs/gallery.md":
            assert re.search(r"[Nn]umbers[^.]*\b(?:its own|own|of this thesis)\.", text), file


# ---- equations


def cited():
    """Numbers of equations that the code cites, and a place for each."""
    places = {}
    files = itertools.chain(
        (ROOT / "include").rglob("*.hpp"),
        (ROOT / "src").rglob("*.[ch]pp"),
        (ROOT / "python").rglob("*.[ch]pp"),
        (ROOT / "python" / "stickslip").glob("*.py"),
    )
    for file in files:
        text = file.read_text(encoding="utf-8")
        if file.suffix == ".py":
            said = re.findall(r'"""(.*?)"""|#(.*)', text, re.DOTALL)
        else:
            said = re.findall(
                r'R"\((.*?)\)"|//(.*)', text, re.DOTALL if "bindings" in file.parts else 0
            )
        for first, second in said:
            words = first or second.partition("\n")[0]
            for low, high in re.findall(rf"\(({NUMBER})\) to \(({NUMBER})\)", words):
                chapter, begin = low.split(".")
                for i in range(int(begin), int(high.split(".")[1]) + 1):
                    places.setdefault(f"{chapter}.{i}", file)
            for number in re.findall(
                rf"\(({NUMBER})\)|thesis \(?((?:[2-5]|A)\.[1-9][0-9])\b", words
            ):
                places.setdefault(number[0] or number[1], file)
    return places


def tagged():
    """Numbers of the equations that the pages carry, and the page of each."""
    return [
        (number, page)
        for page in PAGES
        for tag in re.findall(r"\\tag\{([^}]*)\}", page.read_text(encoding="utf-8"))
        for number in re.findall(NUMBER, tag)
    ]


def test_every_equation_that_the_code_cites_stands_on_a_page():
    places, known = cited(), {number for number, _ in tagged()}
    assert len(places) > 90  # else the code is not read as it is written
    missing = {number: str(file) for number, file in places.items() if number not in known}
    assert not missing


def test_no_equation_stands_on_two_pages():
    numbers = [number for number, _ in tagged()]
    assert sorted(numbers) == sorted(set(numbers))


# ---- the site, where it was built: slow, as that is


LOADS = {"script": "src", "img": "src", "link": "href", "iframe": "src", "source": "src"}


class Page(HTMLParser):
    """The targets of a page, where its links go, and what it loads."""

    def __init__(self, file):
        super().__init__()
        self.ids, self.links, self.loads = set(), [], []
        self.feed(file.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.ids.update(filter(None, [values.get("id"), tag == "a" and values.get("name")]))
        if tag == "a" and values.get("href"):
            self.links.append(values["href"])
        loaded = values.get(LOADS.get(tag))
        if loaded and not loaded.startswith("data:"):
            self.loads.append(loaded)


@pytest.fixture(scope="module")
def site():
    if not (SITE / "index.html").exists():
        pytest.skip("the documentation was not built: script/docs")
    built = (SITE / "index.html").stat().st_mtime
    if any(page.stat().st_mtime > built for page in PAGES):
        pytest.skip("the documentation was edited since it was built: script/docs")
    return {file: Page(file) for file in SITE.rglob("*.html")}


@pytest.mark.slow
def test_links_within_the_site_hold(site):
    broken = []
    for file, page in site.items():
        for link in page.links + page.loads:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            target = (file.parent / unquote(parts.path)).resolve() if parts.path else file
            fragment = unquote(parts.fragment)
            lost = fragment and target in site and fragment not in site[target].ids
            if lost or not target.is_file():
                broken.append(f"{file.relative_to(SITE)}: {link}")
    assert len(site) > 20
    assert not broken


@pytest.mark.slow
def test_nothing_is_loaded_from_outside(site):
    outside = {link for page in site.values() for link in page.loads if urlsplit(link).netloc}
    for file in [*SITE.rglob("*.css"), *SITE.rglob("*.html")]:
        text = file.read_text(encoding="utf-8")
        outside.update(re.findall(r"url\(\s*['\"]?((?:https?:)?//[^)]*)\)", text))
        outside.update(re.findall(r"@import\s+['\"]((?:https?:)?//[^'\"]*)", text))
    assert not outside


@pytest.mark.slow
def test_every_public_name_stands_in_the_reference(site):
    import stickslip as ss

    reference = set().union(*(page.ids for file, page in site.items() if "python" in file.parts))
    names = [
        f"{module.__name__}.{name}"
        for module in (ss, ss.theory, ss.harmonic, ss.regressions)
        for name in module.__all__
        if name not in ("__version__", "harmonic", "regressions", "theory")
    ]
    assert not [name for name in names if name not in reference]


def test_every_public_header_stands_in_the_reference():
    said = {
        name
        for page in (DOCS / "reference" / "cpp").glob("*.rst")
        for name in re.findall(r"^\.\. header:: stickslip/(.*)$", page.read_text(), re.MULTILINE)
    }
    folder = ROOT / "include" / "stickslip"
    headers = {file.relative_to(folder).as_posix() for file in folder.rglob("*.hpp")}
    inner = ("base/", "lanes/")  # and detail/ of each folder: for the library's own use
    shown = {f"base/{name}.hpp" for name in ("error", "plausibility", "units", "vector2")}
    headers = shown | {
        header for header in headers if not header.startswith(inner) and "/detail/" not in header
    }
    # two that include all others, and one that users do not need
    assert said == headers - {"core.hpp", "stickslip.hpp", "series/dual.hpp"}
