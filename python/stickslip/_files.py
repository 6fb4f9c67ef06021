"""Files that are written whole or not at all."""

from __future__ import annotations

import errno
import fcntl
import os
import secrets
import stat
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import BinaryIO

__all__ = ["check_regular", "check_writable", "replacing"]

_EFFECTIVE = os.access in os.supports_effective_ids
_PREFIX = ".stickslip-"

_KINDS = {
    stat.S_IFIFO: "a FIFO",
    stat.S_IFSOCK: "a socket",
    stat.S_IFCHR: "a device",
    stat.S_IFBLK: "a device",
    stat.S_IFDIR: "a folder",
}


def check_regular(file: str | os.PathLike[str]) -> os.stat_result | None:
    """The status of a regular file, or None if there is no file.

    Raises
    ------
    OSError
        The file is not a regular file (the message says what it is), or is a loop of symbolic
        links.
    TypeError
        It is not a path; a number would stand for an open file.
    """
    if not isinstance(file, str | bytes | os.PathLike):
        raise TypeError(f"a file must be given as a path, got {file!r}")
    try:
        status = os.stat(file)
    except FileNotFoundError:
        return None
    if not stat.S_ISREG(status.st_mode):
        kind = _KINDS.get(stat.S_IFMT(status.st_mode), "something else")
        number = errno.EISDIR if stat.S_ISDIR(status.st_mode) else errno.EINVAL
        raise OSError(number, f"must be a regular file, got {kind}", os.fspath(file))
    return status


def check_writable(file: str | os.PathLike[str]) -> tuple[Path, os.stat_result | None]:
    """The path that `replacing` writes to, and the status of the file there, if there is one.

    Raises
    ------
    OSError
        As `replacing` does before it writes.
    """
    status = check_regular(file)
    path = Path(os.path.realpath(os.fsdecode(file)))  # a link stays, its target is written
    if not path.parent.is_dir():
        raise FileNotFoundError(errno.ENOENT, "no such folder", str(path.parent))
    for place in (path.parent,) if status is None else (path.parent, file):
        if not os.access(place, os.W_OK, effective_ids=_EFFECTIVE):
            raise PermissionError(errno.EACCES, "must be writable, is read-only", os.fspath(place))
    return path, status


@contextmanager
def replacing(file: str | os.PathLike[str]) -> Iterator[BinaryIO]:
    """A binary stream whose content replaces a file, unless the block raises.

    Symbolic links are followed. An existing file keeps its mode, and its owner and group where the
    system permits it. A file without write permission is an error, except for root, who may write
    any file.

    A process that is killed leaves a temporary file, which the next write in that folder removes.

    Raises
    ------
    OSError
        The folder is missing or read-only; the file is read-only, or not a regular file.
    """
    path, status = check_writable(file)
    _remove_abandoned(path.parent)
    mode = 0o666 if status is None else stat.S_IMODE(status.st_mode)
    stream, part = _create(path.parent, mode)
    try:
        yield stream
        stream.flush()
        if status is not None:
            _keep(status, part)
        os.fsync(stream.fileno())  # otherwise a power failure could leave an empty file
        os.replace(part, path)
    except BaseException as error:
        with suppress(OSError):
            os.unlink(part)
        if isinstance(error, OSError) and error.filename is None:
            error.filename = os.fspath(file)
        raise
    finally:
        with suppress(OSError):  # that error was already raised
            stream.close()


def _create(folder: Path, mode: int) -> tuple[BinaryIO, Path]:
    """A new file, locked while it is open."""
    while True:
        part = folder / f"{_PREFIX}{secrets.token_hex(8)}"
        try:
            descriptor = os.open(part, os.O_WRONLY | os.O_CREAT | os.O_EXCL, mode)
        except OSError as error:  # name the folder, not the temporary file
            raise OSError(error.errno, error.strerror, str(folder)) from None
        stream = os.fdopen(descriptor, "wb")
        if not _lock(stream) or os.fstat(stream.fileno()).st_nlink:
            return stream, part
        stream.close()  # another process removed it before it was locked


def _lock(stream: BinaryIO, wait: bool = True) -> bool:
    """Lock a file; return whether that succeeded. Some file systems have no locks."""
    try:
        fcntl.flock(stream, fcntl.LOCK_EX | (0 if wait else fcntl.LOCK_NB))
    except OSError:
        return False
    return True


def _remove_abandoned(folder: Path) -> None:
    """Remove the files without a lock, which killed processes have left."""
    for left in folder.glob(f"{_PREFIX}*"):
        with suppress(OSError), left.open("r+b") as stream:
            if _lock(stream, wait=False):
                left.unlink()


def _keep(status: os.stat_result, file: Path) -> None:
    """Give a file the mode of another one, and its owner and group where permitted."""
    with suppress(OSError):
        os.chown(file, -1, status.st_gid)
    with suppress(OSError):
        os.chown(file, status.st_uid, -1)
    os.chmod(file, stat.S_IMODE(status.st_mode))
