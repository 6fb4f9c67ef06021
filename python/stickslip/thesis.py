"""Figures and tables of the thesis, recomputed: theory, exact solution and simulation.

``stickslip thesis`` draws them all; `Thesis` computes one, and `plot` draws it::

    from stickslip.thesis import Thesis, plot

    figure = Thesis(members=10_000).figure("4.6")
    plot(figure).savefig("figure_4_6.png")
    for s in figure.statements:
        print(s.where, s.claim, s.said, s.found, s.agrees)
"""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from ._core import (
    Thesis,
    ThesisCheck,
    ThesisCurve,
    ThesisFigure,
    ThesisPanel,
    ThesisStatement,
    thesis_summary,
    thesis_verdict,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = [
    "Thesis",
    "ThesisCheck",
    "ThesisCurve",
    "ThesisFigure",
    "ThesisPanel",
    "ThesisStatement",
    "file_stem",
    "page",
    "plot",
    "thesis_summary",
    "thesis_verdict",
]

_LINES = {"thesis": "--", "theory": "-.", "exact": "-", "unstable": ":"}
_WORDS = {
    "thesis": "as in the thesis",
    "theory": "other theory",
    "exact": "exact",
    "unstable": "exact, unstable",
    "points": "exact",
    "simulation": "simulation ± 2 s.e.",
}
_MARKS = {"simulation": "o", "points": "D"}
_MOST_LABELS = 8  # if there are more, or they hide a curve, the legend is beside the panel


def file_stem(number: str) -> str:
    """The name of a figure's files without suffix: 'figure_2_1', 'table_5_1'.

    Parameters
    ----------
    number : str
        One of `Thesis.numbers`.
    """
    name = number if " " in number else f"figure {number}"
    return name.lower().replace(" ", "_").replace(".", "_")


def page(figures: Sequence[ThesisFigure], suffix: str) -> str:
    """A Markdown page of figures, with captions and the claims of the thesis about them.

    Parameters
    ----------
    figures : sequence of ThesisFigure
    suffix : str
        Suffix of the pictures, such as '.png'. They are in the folder of the page, named by
        `file_stem`.

    Returns
    -------
    str
        For each figure a heading, the picture, its caption, the time taken, and two tables: claims
        of the thesis, and claims of this library.
    """
    lines = []
    for figure in figures:
        stem = file_stem(figure.number)
        cost = f"; the thesis: {figure.thesis_cost}" if figure.thesis_cost else ""
        lines += [
            f"## {_name(figure)}",
            "",
            f"![{_name(figure)}](./{stem}{suffix})",
            "",
            f"{figure.caption} [Numbers](./{stem}.csv). Took {figure.seconds:.2g} s{cost}.",
            "",
        ]
        for column in ("the thesis", "said here"):
            said = [s for s in figure.statements if bool(s.where) == (column == "the thesis")]
            if said:
                lines += [f"| | {column} | found | |", "|---|---|---|---|"]
                lines += [
                    f"| {_claim(s)} | {_said(s)} | {_found(s)} "
                    f"| {'agrees' if s.agrees else '**differs**'} |"
                    for s in said
                ]
                lines.append("")
    return "\n".join(lines)


def _name(figure: ThesisFigure) -> str:
    return figure.number if " " in figure.number else f"Figure {figure.number}"


def _claim(statement: ThesisStatement) -> str:
    where = f"{statement.where}: " if statement.where else ""
    text = where + statement.claim + (f". *{statement.why}*" if statement.why else "")
    return text.replace("|", r"\|")  # a bar would end the cell


def _said(statement: ThesisStatement) -> str:
    bound = "" if statement.bound == "about" else f"{statement.bound} "
    return f"{bound}{statement.said:.4g}"


def _found(statement: ThesisStatement) -> str:
    return f"{statement.found:.4g}" + (f" ± {statement.error:.1g}" if statement.error else "")


def plot(figure: ThesisFigure) -> Figure:
    """Draw a figure of the thesis, with its caption; needs matplotlib.

    Parameters
    ----------
    figure : ThesisFigure

    Returns
    -------
    matplotlib.figure.Figure
        With one axes for each panel, side by side; the width depends on their number.

    Raises
    ------
    ImportError
        matplotlib is missing.
    """
    from . import plotting

    panels = figure.panels
    width = {1: 6.4, 2: 9.0}.get(len(panels), 11.0)
    caption = textwrap.wrap(figure.caption, round(16.5 * width))
    with plotting.style():
        picture = plotting.new_figure(width, 4.3 + 0.16 * len(caption))
        picture.suptitle(_name(figure), x=0.01, ha="left", fontsize=11, fontweight="bold")
        for axes, panel in zip(picture.subplots(1, len(panels), squeeze=False)[0], panels):
            _draw(axes, panel)
        _legend_of_kinds(picture, panels)
        picture.text(0.01, 0.01, "\n".join(caption), fontsize=8, color=plotting.GRAY, va="bottom")
        bottom = (0.16 * len(caption) + 0.1) / (4.3 + 0.16 * len(caption))
        picture.get_layout_engine().set(rect=(0, bottom, 1, 1 - bottom))
        _clear_curves_of_legends(picture, panels)
    return picture


def _draw(axes: Axes, panel: ThesisPanel) -> None:
    from . import plotting

    colors = _colors(panel)
    named = set()
    for curve in panel.curves:
        label = curve.label if curve.label not in named else None
        named.add(curve.label)
        color = colors[curve.label]
        if curve.kind == "region":
            axes.fill(curve.x, curve.y, color=plotting.PALE, lw=0, label=label, zorder=0)
        elif curve.kind == "limit":
            axes.plot(curve.x, curve.y, ":", color=plotting.GRAY, lw=1, label=label, zorder=1)
        elif curve.kind == "simulation":
            axes.errorbar(
                curve.x,
                curve.y,
                2 * curve.error,
                fmt="o",
                ms=2.6,
                lw=0.8,
                color=color,
                label=label,
                zorder=3,
            )
        elif curve.kind == "points":
            axes.plot(curve.x, curve.y, "D", ms=3, color=color, label=label, zorder=3)
        else:
            axes.plot(curve.x, curve.y, _LINES[curve.kind], color=color, label=label, zorder=2)
    if panel.log_x:
        axes.set_xscale("log")
    if panel.log_y:
        axes.set_yscale("log")
    if panel.x_limits:
        axes.set_xlim(panel.x_limits)
    if panel.y_limits:
        axes.set_ylim(panel.y_limits)
    axes.set(title=panel.title, xlabel=panel.x, ylabel=panel.y)
    axes.grid(color=plotting.PALE, lw=0.6)
    axes.set_axisbelow(True)
    _put_legend(axes, panel, beside=len(named) > _MOST_LABELS)


def _put_legend(axes: Axes, panel: ThesisPanel, beside: bool) -> None:
    """Put the legend where it hides least, or beside the panel."""
    # Reference lines and regions come last, in whatever order they were drawn.
    reference = {curve.label for curve in panel.curves if curve.kind in ("limit", "region")}
    entries = sorted(
        zip(*axes.get_legend_handles_labels()), key=lambda entry: entry[1] in reference
    )
    if not entries:
        return
    size = 6.5 if len(entries) > _MOST_LABELS else 7.5
    where = {"loc": "center left", "bbox_to_anchor": (1, 0.5)} if beside else {}
    axes.legend(*zip(*entries), fontsize=size, handlelength=2.6, **where)


def _clear_curves_of_legends(picture: Figure, panels: list[ThesisPanel]) -> None:
    """Put legends that hide a curve beside their panels; one, if all panels have the same."""
    drawn = list(zip(picture.axes, panels))
    labels = {frozenset(axes.get_legend_handles_labels()[1]) for axes in picture.axes}
    for _ in drawn:  # a legend beside one panel makes the others narrower
        picture.draw_without_rendering()
        hiding = [pair for pair in drawn if _legend_hides_a_curve(pair[0])]
        if not hiding:
            return
        if len(labels) == 1:
            for axes in picture.axes[:-1]:
                if (legend := axes.get_legend()) is not None:
                    legend.remove()
            hiding = drawn[-1:]
        for axes, panel in hiding:
            _put_legend(axes, panel, beside=True)


def _legend_hides_a_curve(axes: Axes) -> bool:
    """Whether the legend of a drawn panel lies on a line or a point."""
    legend = axes.get_legend()
    if legend is None:
        return False
    box = legend.get_window_extent()
    for line in axes.get_lines():
        path = line.get_path().transformed(line.get_transform())
        if box.count_contains(path.vertices):
            return True
        if line.get_linestyle() != "None" and path.intersects_bbox(box, filled=False):
            return True
    return False


def _colors(panel: ThesisPanel) -> dict[str, object]:
    """A color for each label: those of `plotting`, or a color scale if there are many."""
    from matplotlib import colormaps

    from . import plotting

    labels = list(dict.fromkeys(c.label for c in panel.curves if c.kind not in ("limit", "region")))
    if len(labels) <= len(plotting.COLORS):
        colors = dict(zip(labels, plotting.COLORS))
    else:
        colors = dict(zip(labels, colormaps["viridis"](np.linspace(0, 0.92, len(labels)))))
    return {curve.label: plotting.GRAY for curve in panel.curves} | colors


def _legend_of_kinds(picture: Figure, panels: list[ThesisPanel]) -> None:
    """Add a legend of line styles and markers above the panels."""
    from matplotlib.lines import Line2D

    from . import plotting

    kinds = {curve.kind for panel in panels for curve in panel.curves}
    handles = [
        Line2D([], [], color=plotting.INK, marker=_MARKS[kind], ls="", ms=2.6, label=words)
        if kind in _MARKS
        else Line2D([], [], color=plotting.INK, ls=_LINES[kind], label=words)
        for kind, words in _WORDS.items()
        if kind in kinds
    ]
    picture.legend(
        handles=handles,
        loc="outside upper right",
        ncols=len(handles),
        fontsize=7.5,
        handlelength=2.6,
    )
