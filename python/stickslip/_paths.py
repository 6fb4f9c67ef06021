"""Files that a folder or a pattern names."""

from __future__ import annotations

import glob
import os
from collections.abc import Iterator, Sequence
from pathlib import Path

__all__ = ["expanded", "is_same_file"]


def expanded(source: str | os.PathLike[str], enter: bool = False) -> list[Path] | None:
    """The files of a folder or pattern, sorted by name, without hidden ones; None for other paths.

    Links to folders are followed, and a file with several names is listed once, under the shortest
    one. A folder includes its subfolders; those that a pattern matches are entered if `enter` is
    true, as if a shell had expanded the pattern.
    """
    path = Path(os.fspath(source))
    if path.is_dir():
        found = list(_inside(str(path)))
    elif glob.has_magic(str(path)) and not path.exists():
        found = list(_matching(path.parts, enter))
    else:
        return None
    files: dict[str, str] = {}
    for name in sorted(found, key=lambda name: (len(name), name)):
        if os.path.isfile(name):
            files.setdefault(os.path.realpath(name), name)
    return sorted(map(Path, files.values()))


def is_same_file(a: Path, b: Path) -> bool:
    return a.name == b.name and a.exists() and b.exists() and a.samefile(b)


def _matching(parts: Sequence[str], enter: bool) -> Iterator[str]:
    """The files that a pattern matches; ``**`` enters each folder once, whatever its links."""
    if "**" in parts:
        place = parts.index("**")
        entered: set[str] = set()
        for base in glob.glob(os.path.join(*parts[:place])) if place else [os.curdir]:
            for folder, names in _walk(base, entered):
                if parts[place + 1 :]:
                    yield from _matching((glob.escape(folder), *parts[place + 1 :]), enter)
                else:
                    yield from names
        return
    for name in glob.glob(os.path.join(*parts)):
        if enter and os.path.isdir(name):
            yield from _inside(name)
        else:
            yield name


def _inside(folder: str) -> Iterator[str]:
    for _, names in _walk(folder, set()):
        yield from names


def _walk(base: str, entered: set[str]) -> Iterator[tuple[str, list[str]]]:
    """Each folder from a base on, with the paths of its files, without hidden ones."""
    for folder, folders, names in os.walk(base, followlinks=True):
        real = os.path.realpath(folder)
        folders[:] = [] if real in entered else sorted(f for f in folders if f[0] != ".")
        if real not in entered:
            entered.add(real)
            yield folder, [os.path.join(folder, name) for name in names if name[0] != "."]
