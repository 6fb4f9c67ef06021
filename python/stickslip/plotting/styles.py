"""Colors, the common style, and what several pictures write and draw."""

from __future__ import annotations

from typing import Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import FigureBase
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import text_to_path

from .._core import GroundMotion
from .._text import printable

INK, GRAY, PALE = "#222222", "#8a8a8a", "#e6e6e6"
BLUE, VERMILION, GREEN = "#0072b2", "#d55e00", "#009e73"
COLORS = (BLUE, VERMILION, GREEN, "#cc79a7", "#e69f00", "#56b4e9")

LATER = "#c4c4c4"  # of an animation, what is still to come
AT_RIGHT = {
    "xycoords": "axes fraction",
    "xytext": (6, 0),
    "textcoords": "offset points",
    "ha": "left",
    "fontsize": 8,
    "annotation_clip": False,
}


def style() -> Any:
    """The style of the library's pictures, as a context: ``with style(): ...``."""
    return matplotlib.rc_context(
        {
            "font.size": 9,
            "axes.titlesize": 10,
            "axes.titleweight": "bold",
            "axes.titlelocation": "left",
            "axes.labelcolor": INK,
            "axes.edgecolor": GRAY,
            "axes.linewidth": 0.8,
            "axes.spines.top": False,
            "axes.spines.right": False,
            "axes.unicode_minus": True,
            "axes.prop_cycle": matplotlib.cycler(color=COLORS),
            "text.color": INK,
            "xtick.color": GRAY,
            "ytick.color": GRAY,
            "xtick.labelcolor": INK,
            "ytick.labelcolor": INK,
            "lines.linewidth": 1.1,
            "lines.solid_capstyle": "round",
            "legend.frameon": False,
            "savefig.dpi": 140,
            "pdf.fonttype": 42,
            "svg.hashsalt": "stickslip",
        }
    )


def put_title(axes: Axes, motion: GroundMotion, title: str | None = None, below: str = "") -> None:
    put_title_over(axes, printable(motion.name) or "ground motion", title, below)


def put_title_over(axes: Axes, default: str, title: str | None = None, below: str = "") -> None:
    """Title a panel, with smaller text below the title."""
    name = title or default
    # A caller's title may contain math; a dollar sign in a file name is literal.
    below = wrap_items(below, room_over(axes), 8)
    pad = 6 + 12 * len(below.splitlines()) if below else None
    name = name if title and "$" in title else wrapped(axes, name)
    axes.set_title(name, pad=pad, parse_math=bool(title))
    axes.annotate(
        below,
        (0, 1),
        xytext=(0, 6),
        xycoords="axes fraction",
        textcoords="offset points",
        fontsize=8,
        parse_math=False,
    )


def put_figure_title(figure: FigureBase, title: str) -> None:
    title = wrap(title, 0.97 * 72 * figure.bbox.width / figure.dpi, 10, "bold")
    figure.suptitle(title, x=0.01, ha="left", fontsize=10, fontweight="bold")


def room_over(axes: Axes) -> float:
    """The width of a panel [points], before a layout engine has widened it."""
    return float(72 * axes.bbox.width / axes.figure.dpi)


def wrapped(axes: Axes, title: str) -> str:
    """A title in lines that fit over a panel."""
    return wrap(title, room_over(axes), matplotlib.rcParams["axes.titlesize"], "bold")


def wrap_items(text: str, room: float, size: float) -> str:
    """Text in lines that end between its items, or between words where an item is too long."""
    if "\n" in text:
        return "\n".join(wrap_items(line, room, size) for line in text.splitlines())
    joined = ", ".join(item.replace(" ", "\N{NO-BREAK SPACE}") for item in text.split(", "))
    lines = wrap(joined, room, size).replace("\N{NO-BREAK SPACE}", " ")
    whole = all(line.endswith(",") for line in lines.splitlines()[:-1])
    return lines if whole else wrap(text, room, size)


def wrap(text: str, room: float, size: float, weight: str = "normal") -> str:
    """Text in lines of at most `room` points; words that are longer are divided."""
    font = FontProperties(family=matplotlib.rcParams["font.family"], size=size, weight=weight)

    def width(line: str) -> float:
        return float(text_to_path.get_text_width_height_descent(line, font, False)[0])

    if "\n" in text:
        return "\n".join(wrap(line, room, size, weight) for line in text.splitlines())
    lines, line = [], ""
    for word in filter(None, text.split(" ")):  # a no-break space does not end a word
        joined = f"{line} {word}" if line else word
        if line and width(joined) > room:
            lines.append(line)
            joined = word
        while len(joined) > 1 and width(joined) > room:  # a word that is too long
            fits = next(
                n for n in range(len(joined) - 1, 0, -1) if n == 1 or width(joined[:n]) <= room
            )
            lines.append(joined[:fits])
            joined = joined[fits:]
        line = joined
    return "\n".join([*lines, line])


def draw_band(axes: Axes, x: np.ndarray, y: np.ndarray, error: np.ndarray, color: str) -> None:
    """Draw a line in a band of plus and minus two standard errors."""
    axes.fill_between(x, y - 2 * error, y + 2 * error, color=color, alpha=0.25, linewidth=0)
    axes.plot(x, y, color=color)


def put_note(axes: Axes, text: str, band: str = "band: two standard errors") -> None:
    """Write a line of text and an explanation of the band above the panel."""
    above = {"xycoords": "axes fraction", "textcoords": "offset points", "fontsize": 8}
    axes.annotate(text, (0, 1), xytext=(0, 4), color=VERMILION, **above)
    axes.annotate(band, (1, 1), xytext=(0, 4), color=GRAY, ha="right", **above)


def dot_at_right(axes: Axes, x: float, color: str) -> None:
    """Draw a dot on the right edge, wherever the time axis ends."""
    edge = axes.get_yaxis_transform()
    axes.plot(1, x, "o", color=color, markersize=5, clip_on=False, zorder=4, transform=edge)


def is_geometric(x: np.ndarray) -> bool:
    """Whether increasing values are spaced geometrically, over more than a factor of two."""
    if len(x) < 3 or x[0] <= 0 or x[-1] <= 2 * x[0]:
        return False
    steps = np.diff(np.log(x))
    return bool(np.ptp(steps) < 0.01 * steps.mean())


def plain_ticks(axes: Axes, x: np.ndarray) -> None:
    """Label a log axis with the ends of x, and 1, 2 and 5 times the powers of ten between."""
    low, high = x.min(), x.max()
    steps = [m * 10.0**e for e in range(-6, 7) for m in (1, 2, 5)]
    # A tick so near an end that the labels would overlap gives way to it.
    ticks = [low, *(m for m in steps if 1.2 * low <= m <= high / 1.2), high]
    axes.set_xticks(ticks, [f"{m:.3g}" for m in ticks])
    axes.minorticks_off()
