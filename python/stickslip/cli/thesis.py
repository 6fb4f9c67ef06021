"""``stickslip thesis``: the figures of the thesis, redrawn."""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import Any

from .._files import replacing
from .._text import printable
from ..runs.progress import on_screen
from .options import add_options
from .output import check_whole

__all__ = ["add_thesis"]

_OPTIONS = """
--members whole N
    number of members of each ensemble (default 100000; --check: 2000)
--seed whole N
    random seed (default 1; --check: 2)
--threads whole N
    maximum number of threads (default: all cores)
--out file FOLDER
    folder for the files (default: thesis; --check: none)
--format png|pdf|svg = png
    format of the pictures (default png)
--check
    quick check against expected values
"""


def add_thesis(commands: argparse._SubParsersAction) -> None:
    parser = commands.add_parser(
        "thesis",
        help="redraw the figures of the thesis, theory beside simulation",
        description="Redraws figures and tables of the thesis, The Response of Stick-Slip Systems"
        " to Random Seismic Excitation: its curves, exact solutions, and ensembles with standard"
        " errors. For each, writes a picture and a CSV file of all curves and points; writes a page"
        " that shows them all, gallery.md; prints the numerical claims of the thesis next to our"
        " results. With --check, prints every number with its expected value and its tolerance,"
        " exits with code 1 if one is wrong, and writes nothing unless --out is given.",
    )
    parser.add_argument(
        "numbers", nargs="*", metavar="NUMBER", help="such as 4.6, A.2, 'Table 5.1' (default: all)"
    )
    add_options(parser, _OPTIONS)
    parser.set_defaults(run=_thesis)


def _thesis(args: argparse.Namespace) -> str:
    from tqdm import tqdm  # type: ignore[import-untyped, unused-ignore]

    from .. import thesis

    numbers = list(dict.fromkeys(args.numbers)) or thesis.Thesis.numbers
    for number in numbers:
        if number not in thesis.Thesis.numbers:
            raise ValueError(
                f"NUMBER must be one of {', '.join(thesis.Thesis.numbers)}, got {number}"
            )
    check_whole("--members", args.members, 1)
    check_whole("--seed", args.seed, 0)
    check_whole("--threads", args.threads, 1, 2**16)
    members = args.members if args.members is not None else 2000 if args.check else 100_000
    seed = args.seed if args.seed is not None else 2 if args.check else 1
    looks = "{l_bar}{bar}| {elapsed}"
    bar = tqdm(total=100, leave=False, bar_format=looks) if on_screen() else None

    def progress(task: str, fraction: float) -> None:
        bar.set_description_str(task, refresh=False)
        bar.n = round(100 * fraction)
        bar.refresh()

    source = thesis.Thesis(
        members=members,
        seed=seed,
        threads=args.threads,
        progress=progress if bar else None,
    )
    folder = args.out or (None if args.check else Path("thesis"))
    if folder:
        from .. import plotting  # imports matplotlib, which is slow

        folder.mkdir(parents=True, exist_ok=True)
    figures, checks = [], []
    try:
        for number in numbers:
            figure = source.figure(number)
            figures.append(figure)
            if folder:
                stem = folder / thesis.file_stem(number)
                with replacing(stem.with_suffix(".csv")) as stream:
                    stream.write(figure.csv().encode())
                plotting.save(thesis.plot(figure), stem.with_suffix(f".{args.format}"))
            if args.check:
                checks += figure.check()
    finally:
        if bar:
            bar.close()
    summary = thesis.thesis_summary(figures)
    if folder:
        with replacing(folder / "gallery.md") as stream:
            stream.write(thesis.page(figures, f".{args.format}").encode())
    written = f"{len(figures)} figure{'' if len(figures) == 1 else 's'}"
    if not args.check:
        return f"{summary}wrote {written} to {printable(str(folder))}"
    args.code = 0 if all(check.holds for check in checks) else 1
    verdict = f"{written}, {thesis.thesis_verdict(checks)}"
    return "\n".join([*map(_checked, checks), verdict])


def _checked(check: Any) -> str:
    verdict = "holds" if check.holds else "off  "
    if math.isnan(check.found) and math.isnan(check.expected):  # a text
        return f"{verdict}  {check.what}"
    return (
        f"{verdict}  {check.what:28} found {check.found:<14.8g}"
        f" expected {check.expected:<14.8g} +- {check.allowed:.2g}"
    )
