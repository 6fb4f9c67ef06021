"""Files as they are stored: compressed by gzip, bzip2 or xz, in zip and tar archives."""

from __future__ import annotations

import errno
import importlib
import io
import os
import re
import stat
import sys
from collections import Counter
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

__all__ = ["DEEPEST", "Archive", "archive_in", "decompressed", "stored", "unpacked"]


def stored(shown: str) -> tuple[bytes, list[str]]:
    """The bytes of a file as they are stored, and the members that ``::`` names in it."""
    if shown == "-":
        return sys.stdin.buffer.read(), []
    path = shown
    members: list[str] = []
    while "::" in path and not os.path.lexists(path):
        path, _, member = path.rpartition("::")
        members.insert(0, member)
    if not stat.S_ISREG(mode := os.stat(path).st_mode) and not stat.S_ISDIR(mode):
        # a pipe or a device may never end
        raise OSError(errno.ENOTSUP, os.strerror(errno.ENOTSUP), path)
    with open(path, "rb") as stream:
        return stream.read(), members


DEEPEST = 4  # archives within archives, of which nobody has made more
_LARGEST = 64 << 20  # bytes of a record in an archive: 500,000 samples of three components take 20
_LARGEST_TAR = 1 << 30  # bytes of a tar archive in a compressed file


def unpacked(content: bytes, members: Sequence[str], shown: str) -> bytes:
    """The one file that is meant, out of what it is packed in."""
    left = list(members)
    for _ in range(DEEPEST):
        content = decompressed(content, shown)
        archive = archive_in(content, shown)
        if archive is None:
            break
        names = archive.names
        member = left.pop(0) if left else names[0] if len(names) == 1 else None
        if member is None or member not in names:
            known = ", ".join(names[:12]) + (", ..." if len(names) > 12 else "")
            which = "no such member"
            if member is None:
                which = "name one as archive.zip::member; read_station and Suite.read read all"
            raise ValueError(
                f"read_record: {shown}: {which}; the archive holds {len(names)} files: {known}"
            )
        content = archive.read(member)
    if left:
        path = shown[: -len("::" + "::".join(left))]
        raise ValueError(f"read_record: {shown}: {path} is not a zip archive, nor a tar archive")
    return content


class Archive(NamedTuple):
    names: list[str]  # of the files in it
    read: Callable[[str], bytes]


def archive_in(content: bytes, shown: str) -> Archive | None:
    """What a zip or tar archive holds; None for any other file."""
    import tarfile
    import zipfile

    is_zip = content.startswith((b"PK\x03\x04", b"PK\x05\x06"))
    if not is_zip and content[257:262] != b"ustar":
        return None
    damaged = (
        *(zipfile.BadZipFile, tarfile.TarError, RuntimeError, NotImplementedError),
        *(EOFError, OSError, ValueError),
    )

    def guarded(work: Callable[[], Any]) -> Any:
        try:
            return work()
        except damaged as error:
            reason = str(error).removeprefix(f"read_record: {shown}: ")
            raise ValueError(f"read_record: {shown}: {reason}") from None

    stream = io.BytesIO(content)
    if is_zip:
        archive = guarded(lambda: zipfile.ZipFile(stream))
        names = [one.filename for one in archive.infolist() if not one.is_dir()]

        def read(name: str) -> bytes:
            with archive.open(name) as file:
                return _limited(file, _LARGEST, shown)
    else:
        # Members are read and never unpacked into the file system: their names need no filter.
        tar = guarded(lambda: tarfile.TarFile(fileobj=stream))
        members = guarded(tar.getmembers)
        names = [one.name for one in members if one.isfile()]
        # The end is a block of zeros; tarfile takes a header that is cut off for it.
        end = max((one.offset_data + -(-one.size // 512) * 512 for one in members), default=0)
        if len(content) < end + 512 or content[end : end + 512].strip(b"\0"):
            raise ValueError(f"read_record: {shown}: the archive is cut off")

        def read(name: str) -> bytes:
            file = tar.extractfile(name)
            assert file is not None  # it is a file
            return _limited(file, _LARGEST, shown)

    if "[Content_Types].xml" in names:
        raise ValueError(f"read_record: {shown}: a workbook or document: save its table as CSV")
    files = [name for name in names if not _OF_A_SYSTEM.search(name)]
    if twice := [name for name, count in Counter(files).items() if count > 1]:
        raise ValueError(f"read_record: {shown}: two files in the archive are named {min(twice)}")
    return Archive(files, lambda name: guarded(lambda: read(name)))


# What macOS and Windows add to folders.
_OF_A_SYSTEM = re.compile(
    r"^__MACOSX/|(^|/)(\._[^/]*|\.DS_Store|Thumbs\.db|desktop\.ini)$", re.IGNORECASE
)


def _limited(stream: Any, limit: int, shown: str) -> bytes:
    """The rest of a stream, in chunks, so that Ctrl-C ends it and no archive fills the memory."""
    chunks: list[bytes] = []
    size = 0
    while chunk := stream.read(1 << 20):
        size += len(chunk)
        if size > limit:
            raise _too_large(shown, limit)
        chunks.append(chunk)
    return b"".join(chunks)


def _too_large(shown: str, limit: int) -> ValueError:
    return ValueError(
        f"read_record: {shown}: unpacks to more than {limit >> 20} MiB; unpack it to read it"
    )


_GZIP, _XZ = b"\x1f\x8b", b"\xfd7zXZ\0"
_BZIP2 = re.compile(rb"BZh[1-9](1AY&SY|\x17rE8P\x90)")


def _decompressor(content: bytes) -> str:
    """The module that decompresses a file; empty if it is not compressed."""
    if content.startswith(_GZIP):
        return "gzip"
    if content.startswith(_XZ):
        return "lzma"
    return "bz2" if _BZIP2.match(content) else ""


def decompressed(content: bytes, shown: str) -> bytes:
    """What a file compressed by gzip, bzip2 or xz holds; any other as it is."""
    module = ""
    try:
        for _ in range(2):  # no more layers: there are files that unpack to themselves
            module = _decompressor(content)
            if not module:
                break
            stream = importlib.import_module(module).open(io.BytesIO(content))
            begin = stream.read(512)
            packed = begin[257:262] == b"ustar" or _decompressor(begin)
            content = begin + _limited(stream, _LARGEST_TAR if packed else _LARGEST, shown)
        return content
    except Exception as error:
        if not isinstance(error, _errors_of(module)):
            raise
        name = {"lzma": "xz", "bz2": "bzip2"}.get(module, module)
        reason = str(error) or type(error).__name__
        raise ValueError(f"read_record: {shown}: damaged {name} file: {reason}") from None


def _errors_of(module: str) -> tuple[type[Exception], ...]:
    """What is raised if a compressed file is damaged."""
    if module == "gzip":
        import zlib

        return (EOFError, OSError, zlib.error)
    if module == "lzma":
        import lzma

        # MemoryError: the file says how much memory it needs.
        return (EOFError, OSError, lzma.LZMAError, MemoryError)
    return (EOFError, OSError)
