"""Pages of documentation, as the tests read them."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
README = ROOT / "README.md"


def blocks(page, language):
    """The code of a page that is fenced as of that language."""
    return re.findall(
        rf"^```{language}\n(.*?)^```", page.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE
    )


def run(page, code, names):
    exec(compile(code, str(page), "exec"), names)
