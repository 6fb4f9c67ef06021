"""What docs/errata.md shows runs, and prints what stands there."""

import re
from pathlib import Path

import pytest

PAGE = Path(__file__).parents[2] / "docs" / "errata.md"
TEXT = PAGE.read_text(encoding="utf-8")
NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:\(\d+\))?(?:e[-+]?\d+)?(?![\w.]\d)")


def entries():
    """Of each entry its number and what follows its heading."""
    parts = re.split(r"^### (\w+) .*\n", TEXT, flags=re.MULTILINE)
    return {name: body for name, body in zip(parts[1::2], parts[2::2]) if name != "Smaller"}


def value_and_slack(token):
    """A number as shown, and how far a run may be off.

    One in the last place shown; where a standard error stands in brackets, one standard error: the
    seeds are fixed, so that only round-off differs, and that may move an event of a few members.
    """
    mantissa, error, exponent = re.fullmatch(
        r"([-+]?[\d.]+)(?:\((\d+)\))?(e[-+]?\d+)?", token
    ).groups()
    power = float("1" + (exponent or "e0"))
    last = 10.0 ** -len(mantissa.partition(".")[2]) * power
    return float(mantissa) * power, last * max(1, int(error or 0))


SLOW = {"3g", "4a", "5d", "5e", "5h"}


@pytest.mark.parametrize(
    "name",
    [pytest.param(n, marks=[pytest.mark.slow] * (n in SLOW)) for n in entries()],
)
def test_the_programs_print_what_is_shown(name, capsys):
    programs = re.findall(r"```python\n(.*?)```\n\n```text\n(.*?)```", entries()[name], re.DOTALL)
    assert len(programs) == entries()[name].count("```python") == 1
    ((code, shown),) = programs
    exec(compile(code, f"{PAGE} {name}", "exec"), {"__name__": "errata"})
    printed = capsys.readouterr().out
    assert NUMBER.sub("#", printed).split() == NUMBER.sub("#", shown).split()
    for here, there in zip(NUMBER.findall(printed), NUMBER.findall(shown), strict=True):
        value, slack = value_and_slack(there)
        # 1 + 1e-9: the difference of two decimals has its own round-off
        assert abs(value_and_slack(here)[0] - value) <= slack * (1 + 1e-9), (here, there)


def test_the_summary_quotes_what_is_printed():
    rows = re.findall(r"^\| \[(\w+)\]\(#([\w-]+)\) \|.*\| (.*) \|$", TEXT, re.MULTILINE)
    assert [name for name, *_ in rows] == list(entries())
    titles = dict(re.findall(r"^### (\w+) (.*)$", TEXT, re.MULTILINE))
    for name, link, effect in rows:
        assert link == f"{name} {titles[name]}".lower().replace(" ", "-")
        shown = "".join(re.findall(r"```text\n(.*?)```", entries()[name], re.DOTALL))
        for number in NUMBER.findall(effect):
            if "." in number:
                assert number in NUMBER.findall(shown), f"{name}: {number} is not in what it prints"
