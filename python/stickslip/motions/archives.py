"""Files as they are stored: in gzip files, zip and tar archives."""

from __future__ import annotations

import errno
import os
import stat
import sys
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

__all__ = ["Archive", "archive_in", "gunzipped", "stored", "unpacked"]


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


_DEEPEST = 4  # archives within archives, of which nobody has made more
_LARGEST = 64 << 20  # bytes of a record in an archive: 500,000 samples of three components take 20
_LARGEST_TAR = 1 << 30  # bytes of a tar archive in a gzip file


def unpacked(content: bytes, members: Sequence[str], shown: str) -> bytes:
    """The one file that is meant, out of what it is packed in."""
    left = list(members)
    for _ in range(_DEEPEST):
        content = gunzipped(content, shown)
        archive = archive_in(content, shown)
        if archive is None:
            break
        names = archive.names
        member = left.pop(0) if left else names[0] if len(names) == 1 else None
        if member is None or member not in names:
            known = ", ".join(names[:12]) + (", ..." if len(names) > 12 else "")
            which = "name one as archive.zip::member" if member is None else "no such member"
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
    import io
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
        names = [one.name for one in guarded(tar.getmembers) if one.isfile()]

        def read(name: str) -> bytes:
            file = tar.extractfile(name)
            assert file is not None  # it is a file
            return _limited(file, _LARGEST, shown)

    macs = [n for n in names if n.startswith("__MACOSX/") or n.rpartition("/")[2].startswith("._")]
    return Archive([n for n in names if n not in macs], lambda name: guarded(lambda: read(name)))


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


def gunzipped(content: bytes, shown: str) -> bytes:
    """What a gzip file holds; any other as it is."""
    if not content.startswith(b"\x1f\x8b"):
        return content
    import gzip
    import io
    import zlib

    try:
        for _ in range(2):  # no more layers: there are files that unpack to themselves
            if content.startswith(b"\x1f\x8b"):
                stream = gzip.GzipFile(fileobj=io.BytesIO(content))
                begin = stream.read(512)
                packed = begin[257:262] == b"ustar" or begin.startswith(b"\x1f\x8b")
                limit = _LARGEST_TAR if packed else _LARGEST
                content = begin + _limited(stream, limit, shown)
        return content
    except (OSError, EOFError, zlib.error) as error:
        raise ValueError(f"read_record: {shown}: damaged gzip file: {error}") from None
