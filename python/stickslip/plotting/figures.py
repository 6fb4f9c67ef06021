"""Figures: new ones, those that callers give, and files of them."""

from __future__ import annotations

import io
import os
import sys
from pathlib import Path
from typing import Any, TypeVar

import matplotlib
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure, FigureBase

from .._files import replacing
from .styles import style

Place = TypeVar("Place", bound=FigureBase)

SUFFIXES = (".png", ".pdf", ".svg")

# Backends in which plt.show() shows nothing, or repeats what a notebook shows anyway.
_WITHOUT_WINDOWS = (
    *("agg", "cairo", "pdf", "pgf", "ps", "svg", "template", "inline"),
    "module://matplotlib_inline.backend_inline",
)


class _Picture(Figure):
    """A figure that a notebook shows even if pyplot was never imported."""

    def _repr_png_(self) -> bytes:
        return rendered(self, "png")


def save(figure: Figure, file: str | os.PathLike[str]) -> Path:
    """Write a figure to a file, whole or not at all.

    Symbolic links are followed; an existing file keeps its mode.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    file : path-like
        The suffix, .png, .pdf or .svg, determines the format.

    Returns
    -------
    Path

    Raises
    ------
    ValueError
        An unknown suffix.
    OSError
        The folder is missing or cannot be written; the file is read-only or not a regular file.
    """
    path = Path(file)
    content = rendered(figure, check_suffix(path))
    with replacing(path) as stream:
        stream.write(content)
    return path


def check_suffix(file: Path) -> str:
    """The format 'png', 'pdf' or 'svg' from a file's suffix; ValueError for other suffixes."""
    if file.suffix.lower() not in SUFFIXES:
        raise ValueError(f"plot: the file must end in {', '.join(SUFFIXES)}, got '{file}'")
    return file.suffix.lower()[1:]


def new_figure(width: float, height: float) -> Figure:
    """An empty figure of a given size [inches].

    If pyplot has windows, plt.show() shows the figure; otherwise pyplot does not know it.
    """
    options: dict[str, Any] = {"figsize": (width, height), "layout": "constrained", "dpi": 100}
    pyplot = sys.modules.get("matplotlib.pyplot")
    if pyplot is not None and matplotlib.get_backend().lower() not in _WITHOUT_WINDOWS:
        return pyplot.figure(FigureClass=_Picture, **options)
    figure = _Picture(**options)
    FigureCanvasAgg(figure)
    return figure


def given_or_new(figure: FigureBase | None, width: float, height: float) -> FigureBase:
    """The figure of a picture: the one given, or a new one of a given size [inches]."""
    if figure is None:
        return new_figure(width, height)
    if not isinstance(figure, FigureBase):
        raise TypeError(f"plot: figure must be a matplotlib Figure or SubFigure, got {figure!r}")
    return figure


def check_axes(ax: object) -> None:
    """TypeError for what is no Axes."""
    if not isinstance(ax, Axes):
        raise TypeError(f"plot: ax must be a matplotlib Axes, got {ax!r}")


def one_panel(
    who: str, figure: FigureBase | None, ax: Axes | None, width: float, height: float
) -> tuple[FigureBase, Axes]:
    """The figure and axes of a one-panel picture: those given, or new ones."""
    if ax is not None:
        if figure is not None:
            raise ValueError(f"{who}: give figure or ax, got both")
        check_axes(ax)
        return ax.figure, ax
    figure = given_or_new(figure, width, height)
    return figure, figure.subplots()


def rendered(figure: Figure, kind: str) -> bytes:
    buffer = io.BytesIO()
    undated = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}.get(kind)
    with style():
        figure.savefig(buffer, format=kind, metadata=undated)
    return buffer.getvalue()
