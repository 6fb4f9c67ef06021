"""The command ``stickslip``: slide records from the shell.

``stickslip slide kobe.AT2 --mu 0.1 0.2 0.3`` prints how far a block slides; ``stickslip slide
--help`` lists the options. ``stickslip records FOLDER`` prints what files hold, ``stickslip
spectrum`` their response spectra. ``stickslip orientations`` slides along all directions of a
station, ``stickslip sweep`` prints statistics over records, and ``stickslip fragility`` fits the
probability of sliding further than thresholds. ``stickslip ensemble --event "great very near field"
--mu 0.2 --members 100000`` prints statistics for random earthquakes, and ``stickslip thesis``
redraws the figures of the thesis. ``stickslip rock`` prints whether blocks overturn, ``stickslip
cart`` how far carts roll, and
``stickslip completion bash`` a script that completes all this in a shell. Each subcommand is one
file here, with a function that adds its arguments and one that runs it.

Exit codes: 0 on success, also for a slider that never comes to rest (its row says so); 1 if part of
the work failed and the rest is printed: a record that cannot be read or slid, a picture or
checkpoint that cannot be written, each with one line on stderr, or a wrong number in
``stickslip thesis --check``; 2 if nothing is printed on stdout: bad options, an input error (of a
file, only with ``--strict``) or not enough memory, with one line on stderr, after the usage if the
options do not parse; 130 after Ctrl-C.

JSON has no infinity: null stands for an infinite value (a slip level, a reach, a bound) or an
option that was not given.
"""

from __future__ import annotations

import argparse
import sys
import warnings

from .cart import add_cart
from .completion import add_completion, complete
from .ensemble import add_ensemble
from .fragility import add_fragility
from .newmark import add_newmark
from .orientations import add_orientations
from .output import FAILURES, complain, reason_of, version, write
from .parser import Parser
from .records import add_records
from .report import StrictError
from .rock import add_rock
from .slide import add_slide
from .spectrum import add_spectrum
from .sweep import add_sweep
from .thesis import add_thesis

__all__ = ["main"]


def main(argv: list[str] | None = None) -> int:
    """Run the command.

    Parameters
    ----------
    argv : list of str, optional
        The arguments, without the name of the command; by default those of the process.

    Returns
    -------
    int
        The exit code.

    Raises
    ------
    SystemExit
        From argparse: code 0 after --help or --version, 2 for arguments that do not parse.
    """
    parser = Parser(
        prog="stickslip",
        description="How far objects held by friction slide in earthquakes.",
        epilog="""\
exit codes:
  0    success
  1    part of the work failed, with a line on stderr each; the rest is printed
       (thesis --check: a number is wrong)
  2    bad options, or an input error that ends the command; nothing is printed
  130  interrupted by Ctrl-C""",
        formatter_class=argparse.RawDescriptionHelpFormatter,  # keeps the lines of --version
    )
    parser.add_argument("--version", action="version", version=version())
    commands = parser.add_subparsers(metavar="COMMAND", required=True)
    for add in (
        add_slide,
        add_sweep,
        add_newmark,
        add_rock,
        add_cart,
        add_orientations,
        add_fragility,
        add_records,
        add_spectrum,
        add_ensemble,
        add_thesis,
        add_completion,
    ):
        add(commands)
    complete(parser)
    args = argparse.Namespace(code=0)
    try:
        parser.parse_args(argv, args)
        with warnings.catch_warnings():
            warnings.showwarning = lambda message, *_: complain(f"warning: {message}")
            text = args.run(args)
        if text:
            write(f"{text}\n", sys.stdout)
    except BrokenPipeError:  # the reader, such as `head`, has seen enough
        return args.code
    except (*FAILURES, StrictError) as error:
        complain(reason_of(error))
        return 2
    except KeyboardInterrupt:
        kept = getattr(args, "checkpoint", None)
        saved = f"; {kept} has what was done" if kept and kept.exists() else ""
        complain(f"interrupted{saved}")
        return 130
    return args.code
