"""``stickslip completion``: completion of the command in a shell."""

from __future__ import annotations

import argparse
import os

__all__ = ["add_completion", "complete"]


def add_completion(commands: argparse._SubParsersAction) -> None:
    parser = commands.add_parser(
        "completion",
        help="print a script that completes commands, options and files in a shell",
        description="Prints a script that makes a shell complete commands, options and files."
        " Needs argcomplete (pip install stickslip[completion]).",
        epilog='bash: add   eval "$(stickslip completion bash)"   to ~/.bashrc; zsh: the same,'
        " with zsh, to ~/.zshrc after compinit; fish: stickslip completion fish >"
        " ~/.config/fish/completions/stickslip.fish",
    )
    parser.add_argument("shell", choices=("bash", "zsh", "fish"))
    parser.set_defaults(run=_completion)


def complete(parser: argparse.ArgumentParser) -> None:
    """If a shell asks for completions, print them and exit; otherwise do nothing."""
    if "_ARGCOMPLETE" not in os.environ:
        return
    import argcomplete

    argcomplete.autocomplete(parser)


def _completion(args: argparse.Namespace) -> str:
    try:
        import argcomplete
    except ImportError as error:
        raise ImportError(
            "completion needs argcomplete, which is missing; pip install stickslip[completion]"
        ) from error
    return str(argcomplete.shellcode(["stickslip"], shell=args.shell)).rstrip()
