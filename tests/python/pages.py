"""Pages of documentation, as the tests read them."""

import importlib
import re
import sys
import zipfile
from pathlib import Path

ROOT = Path(__file__).parents[2]
README = ROOT / "README.md"


def blocks(page, language):
    """The code of a page that is fenced as of that language."""
    return re.findall(
        rf"^```{language}\n(.*?)^```", page.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE
    )


def measuring(name):
    """The program in docs/ that measures what a page says."""
    folder = str(ROOT / "docs")
    if folder not in sys.path:
        sys.path.append(folder)
    return importlib.import_module(name)


NUMBER = re.compile(r"-?\d+(?:\.\d+)?")


def assert_same_table(text, new):
    """A page has this table: the words, and the numbers but for one in the last digit."""
    heading, _, *found = new.splitlines()
    lines = text.splitlines()
    begin = lines.index(heading) + 2
    end = next(i for i in range(begin, len(lines)) if not lines[i].startswith("|"))
    rows = lines[begin:end]
    assert len(rows) == len(found) > 0
    for here, there in zip(rows, found):
        assert NUMBER.sub("#", here) == NUMBER.sub("#", there)
        for old, now in zip(NUMBER.findall(here), NUMBER.findall(there), strict=True):
            places = len(old.partition(".")[2])
            allowed = 1.01 * 10.0**-places if places else 0  # numbers of records are equal
            assert abs(float(old) - float(now)) <= allowed, (here, there)


def rows_below(text, heading):
    """The cells of the table of a page that has this heading."""
    found = []
    for line in text.split(f"\n{heading}\n", 1)[1].splitlines()[1:]:
        if not line.startswith("|"):
            break
        found.append([cell.strip() for cell in line.split("|")[1:-1]])
    return found


def assert_same_picture(drawn, shown):
    """The picture that a page shows is the one that was drawn.

    It has 64 colors: each pixel is off by some 1 %. Letters of other fonts are off in few pixels; a
    line elsewhere is too, but in more of them.
    """
    import numpy as np
    from matplotlib.image import imread

    first, second = (imread(file)[:, :, :3] for file in (drawn, shown))
    assert first.shape == second.shape
    assert np.mean(np.abs(first - second).max(axis=2) > 0.25) < 0.004


def assert_same_figure(figure, shown, folder):
    """The picture that a page shows is the one that a function draws."""
    drawn = folder / shown.name
    measuring("measured_page").draw(drawn, figure)
    assert_same_picture(drawn, shown)


def run(page, code, names):
    exec(compile(code, str(page), "exec"), names)


def write_records(folder, name, acceleration, dt):
    """The record files of the pages' names: one record, as PEER writes it, as columns, packed.

    `name` is the second line of PEER's header but for the component, `acceleration` is in m/s^2.
    """
    samples = [f"{n / 9.80665:.7E}" for n in acceleration]
    rows = [" ".join(samples[i : i + 5]) for i in range(0, len(samples), 5)]
    for file, component in (("kobe", "90"), ("north", "0"), ("east", "90"), ("up", "UP")):
        header = [
            "PEER NGA STRONG MOTION DATABASE RECORD",
            f"{name}, {component}",
            "ACCELERATION TIME SERIES IN UNITS OF G",
            f"NPTS= {len(samples)}, DT= {dt:.4f} SEC",
        ]
        (folder / f"{file}.AT2").write_text("\n".join(header + rows) + "\n")
    (folder / "column.txt").write_text("\n".join(samples))
    table = [f"{i * dt:.4f},{n},{n},{n}" for i, n in enumerate(samples)]
    (folder / "station.csv").write_text("\n".join(["Time (s),N (g),E (g),Up (g)", *table]))
    with zipfile.ZipFile(folder / "archive.zip", "w") as archive:
        archive.write(folder / "kobe.AT2", "kobe.AT2")
        archive.writestr("notes.txt", "of Kobe")
