"""Draws the pictures of the page of examples: python docs/draw_examples.py [NAME...]

They are in the repository, so that the page shows them wherever it is read; with 256 colors, chosen
to cover the range of a map, each has at most 200 kB.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).parents[1]
PICTURES = ROOT / "docs" / "images" / "examples"


def draw(example: Path) -> Path:
    """The picture of one example."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, example, "--out", folder]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        (drawn,) = Path(folder).iterdir()
        picture = PICTURES / drawn.name
        Image.open(drawn).convert("RGB").quantize(
            256, method=Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE
        ).save(picture, optimize=True)
    return picture


if __name__ == "__main__":
    PICTURES.mkdir(exist_ok=True)
    names = sys.argv[1:] or sorted(file.stem for file in (ROOT / "examples").glob("[0-9]*.py"))
    for name in names:
        print(draw(ROOT / "examples" / f"{name}.py"))
