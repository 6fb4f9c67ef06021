"""Draws the figure of the README with the README's own code: python docs/draw_readme.py

The first Python program of the README runs as it stands, and its `figure` is written to
docs/images/one_record.png, which the first pages of the documentation show as well. A test
compares the picture in the repository with what the program draws.
"""

import contextlib
import io
import re
from pathlib import Path

from PIL import Image
from stickslip import plotting

ROOT = Path(__file__).parents[1]
PICTURE = ROOT / "docs" / "images" / "one_record.png"


def draw(picture: Path) -> Path:
    """Run the program and write its figure, with 64 colors."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    program = re.search(r"^```python\n(.*?)^```", text, re.DOTALL | re.MULTILINE)
    assert program is not None
    names: dict[str, object] = {}
    with contextlib.redirect_stdout(io.StringIO()):
        exec(compile(program[1], "README.md", "exec"), names)
    plotting.save(names["figure"], picture)
    Image.open(picture).convert("RGB").quantize(64, dither=Image.Dither.NONE).save(
        picture, optimize=True
    )
    return picture


if __name__ == "__main__":
    print(draw(PICTURE))
