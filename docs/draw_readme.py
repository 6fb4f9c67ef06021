"""Draws the pictures of the README: python docs/draw_readme.py

The first Python program of the README runs as it stands, and its `figure` is written to
docs/images/one_record.png, which the first pages of the documentation show as well. The demo draws
docs/images/friction_sweep.png. Tests compare the pictures in the repository with what these
programs draw.
"""

import contextlib
import io
import re
import tempfile
from pathlib import Path

import stickslip as ss
from PIL import Image
from stickslip import demo, plotting

ROOT = Path(__file__).parents[1]
PICTURE = ROOT / "docs" / "images" / "one_record.png"
SWEEP = ROOT / "docs" / "images" / "friction_sweep.png"


def draw(picture: Path) -> Path:
    """Run the program and write its figure."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    program = re.search(r"^```python\n(.*?)^```", text, re.DOTALL | re.MULTILINE)
    assert program is not None
    names: dict[str, object] = {}
    with contextlib.redirect_stdout(io.StringIO()):
        exec(compile(program[1], "README.md", "exec"), names)
    return _small(plotting.save(names["figure"], picture), picture)


def draw_sweep(picture: Path) -> Path:
    """Write the second picture of the demo."""
    with tempfile.TemporaryDirectory() as folder:
        _, sweep = demo.draw(ss.sample_records(), Path(folder))
        return _small(sweep, picture)


def _small(drawn: Path, picture: Path) -> Path:
    """Write a picture with 64 colors."""
    small = Image.open(drawn).convert("RGB").quantize(64, dither=Image.Dither.NONE)
    small.save(picture, optimize=True)
    return picture


if __name__ == "__main__":
    print(draw(PICTURE), draw_sweep(SWEEP))
