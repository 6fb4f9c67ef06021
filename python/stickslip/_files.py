"""Files that are written whole or not at all."""

from __future__ import annotations

import errno
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

__all__ = ["replacing"]


@contextmanager
def replacing(file: str | os.PathLike[str]) -> Iterator[Path]:
    """A path beside `file` to write to, which takes its place unless the block raises.

    Raises
    ------
    OSError
        The folder is missing or cannot be written.
    """
    path = Path(file)
    if not path.parent.is_dir():
        raise FileNotFoundError(errno.ENOENT, "no such folder", str(path.parent))
    # mkstemp would leave a file that only its owner may read.
    part = Path(tempfile.mkdtemp(prefix=".stickslip-", dir=path.parent)) / path.name
    try:
        yield part
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)
        part.parent.rmdir()
