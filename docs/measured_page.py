"""What the programs that measure a page have in common: ground motions, tables, pictures."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import stickslip as ss

if TYPE_CHECKING:
    from matplotlib.figure import Figure

DOCS = Path(__file__).parent
RECORDS = Path(os.environ.get("STICKSLIP_RECORDS", ""))
PAIRS = "usgs_pairs"
STATION = Path("geonet", "20161113_110259_WTMC_20.V2A")  # Te Mara Farm
G = ss.STANDARD_GRAVITY


# ---- ground motions


@cache
def samples() -> ss.Suite:
    """The 18 sample records, one axis each."""
    return ss.sample_records()


@cache
def pairs() -> tuple[ss.GroundMotion, ...]:
    """Eleven recorded pairs, or nothing without the files."""
    folder = RECORDS / PAIRS
    if not (folder / "pairs.csv").is_file():
        return ()
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "Suite.read: metadata renamed")  # the column pga_g
        files = sorted(folder.glob("*.txt"))
        suite = ss.Suite.read(files, stations=True, metadata=folder / "pairs.csv", units="g")
    return tuple(suite)


@cache
def station() -> tuple[ss.GroundMotion, ...]:
    """Te Mara Farm with all three components, along both horizontal axes, or nothing."""
    file = RECORDS / STATION
    return tuple(ss.read_station(file, component=k) for k in (1, 2)) if file.is_file() else ()


@cache
def triples(pga_g: float, ratio: float, count: int = 50) -> tuple[ss.GroundMotion, ...]:
    """Synthetic stations with three components.

    Filtered white noise (Clough-Penzien) in an envelope of 20 s. Each horizontal component has the
    peak acceleration pga_g, the vertical one `ratio` times that and twice the frequency.
    """
    dt, length = 0.01, 2001
    time = dt * np.arange(length)
    envelope = np.minimum(1, (time / 3) ** 2) * np.exp(-0.4 * np.maximum(0, time - 11))

    def component(frequency: float, pga: float, member: int) -> np.ndarray:
        noise = ss.Spectrum.clough_penzien(
            s0=1, frequency=frequency, damping=0.6, filter_frequency=1.5, filter_damping=0.6
        )
        stationary = ss.GaussianExcitation(noise, dt=dt, samples=length)
        n = envelope * stationary.sample(seed=19, member=member).acceleration
        return n * (pga * G / np.abs(n).max())

    return tuple(
        ss.GroundMotion(
            component(15, pga_g, 3 * k),
            dt=dt,
            transverse=component(15, pga_g, 3 * k + 1),
            vertical=component(30, ratio * pga_g, 3 * k + 2),
        )
        for k in range(count)
    )


def components(motions: Iterable[ss.GroundMotion]) -> list[ss.GroundMotion]:
    """Each horizontal component alone, with the vertical one."""
    return [
        ss.GroundMotion(n, dt=motion.dt, vertical=motion.vertical, name=motion.name)
        for motion in motions
        for n in (motion.acceleration, motion.transverse)
    ]


def flat(motion: ss.GroundMotion) -> ss.GroundMotion:
    """Without the vertical component."""
    return ss.GroundMotion(
        motion.acceleration,
        dt=motion.dt,
        transverse=motion.transverse,
        name=motion.name,
        orientation=motion.orientation,
    )


def white(dt: float, length: int) -> ss.GaussianExcitation:
    """White noise of S0 = 1 m^2/s^3, held over steps dt, with its line at zero frequency."""
    return ss.GaussianExcitation(
        ss.Spectrum.white(s0=1.0),
        dt,
        length,
        interpolation="constant",
        correct_interpolation=False,
        random_amplitudes=True,
        zero_frequency=True,
    )


def shaking(spectrum: ss.Spectrum, dt: float, length: int) -> ss.GaussianExcitation:
    """With Rayleigh amplitudes and a period of four durations: Gaussian, with a line at zero."""
    return ss.GaussianExcitation(
        spectrum, dt, length, period=4 * length, zero_frequency=True, random_amplitudes=True
    )


# ---- tables


def spread(values: Iterable[float], low: float = 16, high: float = 84) -> list[str]:
    """The median, and the percentiles `low` to `high`, of the values that exist."""
    here = np.fromiter((value for value in values if not np.isnan(value)), float)
    middle, left, right = np.percentile(here, (50, low, high))
    return [f"{middle:.2f}", f"{left:.2f} to {right:.2f}"]


def shown(rows: Iterable[list[str]]) -> Iterator[list[str]]:
    """The rows, printed as they come."""
    for cells in rows:
        print(" | ".join(cells), flush=True)
        yield cells


def table(heading: str, rows: Iterable[Iterable[str]]) -> str:
    """A table of Markdown; `heading` is its first line."""
    rule = "|" + "---|" * (heading.count("|") - 1)
    return "\n".join([heading, rule, *("| " + " | ".join(row) + " |" for row in rows)]) + "\n"


def replaced(text: str, new: str) -> str:
    """The page with the table of this heading replaced."""
    lines = text.splitlines(keepends=True)
    begin = lines.index(new.splitlines(keepends=True)[0])
    end = next((i for i in range(begin, len(lines)) if lines[i][0] != "|"), len(lines))
    return "".join([*lines[:begin], new, *lines[end:]])


def rewrite(
    page: Path, tables: Iterable[str], pictures: Mapping[Path, Callable[[], Figure]] | None = None
) -> None:
    """Replace the tables of a page, and draw its pictures."""
    text = page.read_text(encoding="utf-8")
    for new in tables:
        text = replaced(text, new)
    page.write_text(text, encoding="utf-8")
    for picture, figure in (pictures or {}).items():
        draw(picture, figure)


def draw(picture: Path, drawn: Callable[[], Figure]) -> None:
    """Save a figure in 64 colors."""
    from PIL import Image
    from stickslip import plotting

    with plotting.style():
        figure = drawn()
    plotting.save(figure, picture)
    Image.open(picture).convert("RGB").quantize(64, dither=Image.Dither.NONE).save(
        picture, optimize=True
    )
