"""Slides six objects under 18 earthquake records: ``python -m stickslip.demo [--out FOLDER]``.

The records are the data files of the PyPI package pyslammer (``pip install stickslip[records]``).
Prints a table and draws two pictures.
"""

from __future__ import annotations

import argparse
import math
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from . import (
    STANDARD_GRAVITY,
    Caster,
    Coulomb,
    GroundMotion,
    Slider,
    integrate,
    sample_records,
)

__all__ = ["THINGS", "Thing", "main"]


class Thing(NamedTuple):
    """An object that slides: its name in the table, a description, and its slider."""

    name: str
    story: str
    slider: Slider


_CART = Caster.from_geometry(mu=0.5, trail=0.04, wheel_width=0.032)

THINGS = (
    Thing(
        "cabinet 0.1",
        "a cabinet on a smooth floor, coefficient of friction 0.1",
        Slider(Coulomb(mu=0.1)),
    ),
    Thing("cabinet 0.2", "the same, coefficient of friction 0.2", Slider(Coulomb(mu=0.2))),
    Thing("cabinet 0.3", "the same, coefficient of friction 0.3", Slider(Coulomb(mu=0.3))),
    Thing(
        "cart",
        "a hospital cart on casters, wheels across the motion at first (trail 4 cm, wheel 3.2 cm"
        f" wide,\n{'':13}friction 0.5): slip level {_CART.slip_level / STANDARD_GRAVITY:.3f} g,"
        f" falling off over a reach of {_CART.reach * 100:.1f} cm",
        Slider(_CART),
    ),
    Thing(
        "isolated",
        "a floor isolated by friction pendulums, coefficient of friction 0.06, period 3 s",
        Slider(Coulomb(mu=0.06), natural_frequency=2 * math.pi / 3),
    ),
    Thing(
        "slope",
        "a slope that slides only downhill, above 0.1 g (Newmark's block)",
        Slider(Coulomb(mu=0.1, backward=math.inf)),
    ),
)

CELL = 14  # width of a column of the table

_NOTES = """\
Peak: largest distance from the initial position. Residual: final position at rest, positive in the
record's positive direction. A dash: it never slips; 0.0: less than half a millimeter.
(x) beyond its reach: the casters align with the motion, and the result depends on small
    disturbances that the model omits. "rolls": more than 10 reaches away and still rolling at the
    end of the record."""


def table(motions: Sequence[GroundMotion]) -> list[str]:
    """Peak and residual displacements [cm] of each object under each motion, as lines of text."""
    wide = max(len(motion.name) for motion in motions)
    names = "".join(f"{thing.name:>{CELL}}" for thing in THINGS)
    kinds = f"{'peak  resid.':>{CELL}}" * len(THINGS)
    lines = [f"{'':{wide}}    PGA{names}", f"{'record':{wide}}    [g]{kinds}  [cm]"]
    for motion in motions:
        cells = "".join(f"{_cell(thing.slider, motion):>{CELL}}" for thing in THINGS)
        lines.append(
            f"{motion.name:{wide}}{motion.peak_acceleration / STANDARD_GRAVITY:7.3f}{cells}"
        )
    return lines


def _cell(slider: Slider, motion: GroundMotion) -> str:
    reach = getattr(slider.law, "reach", math.inf)
    response = integrate(slider, motion)
    if not response.at_rest and response.peak > 10 * reach:
        return "rolls"
    response = integrate(slider, motion, settle=True)
    if response.sliding_distance == 0:
        return "-"
    # Adding 0.0 turns a rounded -0.0 into 0.0.
    residual = round(response.residual * 100, 1) + 0.0
    mark = "x" if response.peak > reach else " "
    return f"{response.peak * 100:.1f}{mark}{residual:7.1f}"


def draw(motions: Sequence[GroundMotion], folder: Path) -> list[Path]:
    """Draw both pictures into a folder, creating it if needed; return their paths."""
    import numpy as np

    from . import plotting

    folder.mkdir(parents=True, exist_ok=True)
    kobe = next(motion for motion in motions if motion.name.startswith("Kobe"))
    history = plotting.plot_response(
        integrate(Coulomb(mu=0.1), kobe, settle=True),
        title=f"A cabinet on a smooth floor in {kobe.name}",
        time=(0, 25),  # [s]; the cabinet is at rest after 20 s
    )

    mu = np.geomspace(0.02, 1, 200)
    peaks = [[integrate(Coulomb(mu=m), motion, settle=True).peak for m in mu] for motion in motions]
    names = [motion.name for motion in motions]
    telling = ("Chi-Chi", "Coyote", "Kobe", "Kocaeli", "Morgan")
    sweep = plotting.plot_friction_sweep(
        mu, peaks, names, highlight=[name for name in names if name.startswith(telling)]
    )
    return [
        plotting.save(history, folder / "one_record.png"),
        plotting.save(sweep, folder / "friction_sweep.png"),
    ]


def main(argv: list[str] | None = None) -> int:
    """Run the demo; return the exit code: 2 if records are missing or a file cannot be written."""
    parser = argparse.ArgumentParser(prog="python -m stickslip.demo", description=__doc__)
    parser.add_argument(
        "--out", type=Path, default=Path("stickslip-demo"), help="folder for the two pictures"
    )
    args = parser.parse_args(argv)
    began = time.perf_counter()
    try:
        motions = sample_records()
    except ImportError as error:
        print(error, file=sys.stderr)
        return 2
    print(f"{len(motions)} earthquake records; displacements relative to the ground.\n")
    for thing in THINGS:
        print(f"{thing.name:13}{thing.story}")
    print("", *table(motions), "", _NOTES, "", sep="\n")
    try:
        for picture in draw(motions, args.out):
            print(f"wrote {picture}")
    except ImportError as error:
        print(f"no pictures: {error}", file=sys.stderr)
    except OSError as error:
        print(f"stickslip.demo: {error.filename}: {error.strerror}", file=sys.stderr)
        return 2
    print(f"{time.perf_counter() - began:.1f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
