"""Failures of many files, in few lines."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable

from ._text import printable

__all__ = ["grouped", "with_options"]

_SHOWN = 3  # files named in one line


def with_options(reason: str, option: str) -> str:
    """A reason in which options have the caller's names, such as ``"{}="`` or ``"--{}"``."""
    said = re.sub(r"\bpass (units|dt|gaps)\b", lambda m: "give " + option.format(m[1]), reason)
    said = said.replace(", and give ", ", and ")
    return said.replace("; got ''", f"; give {option.format('component')}")


def grouped(failures: Iterable[tuple[str, str]], option: str = "{}=") -> list[str]:
    """A line for each reason, with the files that share it; the most frequent reasons first.

    Parameters
    ----------
    failures : iterable of (file, reason)
    option : str, optional
        How the caller names an option, such as ``"--{}"``.
    """
    files: dict[str, list[str]] = {}
    for file, reason in failures:
        files.setdefault(with_options(reason, option), []).append(file)
    lines = []
    for reason, names in sorted(files.items(), key=lambda item: -len(item[1])):
        if len(names) == 1:
            lines.append(f"{names[0]}: {reason}")
            continue
        folders = {os.path.dirname(name) for name in names}
        where = f" in {folders.pop()}" if len(folders) == 1 and "" not in folders else ""
        more = f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else ""
        shown = ", ".join(os.path.basename(n) if where else n for n in names[:_SHOWN]) + more
        stated = reason.startswith("the file states ")
        what = f" state {reason.removeprefix('the file states ')}" if stated else f": {reason}"
        lines.append(f"{len(names)} files{where} ({shown}){what}")
    return [printable(line) for line in lines]
