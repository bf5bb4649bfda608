"""Reading of files that a user names: regular files of a bounded size, and nothing that never ends."""

from __future__ import annotations

import os
import stat
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from io import BufferedReader
from pathlib import Path

from ehlectric.errors import InputError, shown
from ehlectric.runtime.file_kinds import PEEKED, kind_of, not_text
from ehlectric.runtime.files import reading
from ehlectric.runtime.sizes import check_size

# Largest size of a file that a person writes: of a case, a bearing or a sweep [bytes].
MOST_TEXT = 1_000_000

# Number of first bytes by which a file of another kind is refused.
_FIRST = 16

# Kinds of files that are not regular, as messages name them.
_SPECIAL = (
    (stat.S_ISDIR, "is a directory"),
    (stat.S_ISFIFO, "it is a pipe, not a regular file"),
    (stat.S_ISCHR, "it is a device, not a regular file"),
    (stat.S_ISBLK, "it is a device, not a regular file"),
    (stat.S_ISSOCK, "it is a socket, not a regular file"),
)

# Folders whose files the kernel makes up when they are read. Some of them have no end or never return.
_KERNEL = ("/proc/", "/sys/")


# Without O_NONBLOCK the opening of a pipe waits until somebody writes into it. Windows has no such flag, but
# opens files as text by default.
_FLAGS = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)


@contextmanager
def regular(path: str | Path) -> Iterator[BufferedReader]:
    """Context with a regular file that is open for reading in binary mode; a link is followed.

    A pipe, a device, a socket, a folder and a file of the kernel are refused before anything is read from
    them, by an InputError. The check is made on the open file, so that the file cannot change in between. An
    OSError within the context also becomes an InputError.
    """
    try:
        path = Path(path)
        with reading(path):
            # The opening of a device may already change it.
            refuse_kind(path, path.stat())
            descriptor = os.open(path, _FLAGS)
    except InputError:
        raise
    except ValueError:
        raise InputError(shown(str(path)), "is not a path") from None
    with reading(path), os.fdopen(descriptor, "rb") as file:
        refuse_kind(path, os.fstat(descriptor))
        yield file


def refuse_kind(path: Path, status: os.stat_result) -> None:
    """Refuse to read what is no regular file, or is a file that the kernel makes up, in /proc or /sys."""
    if not stat.S_ISREG(status.st_mode):
        why = (text for is_kind, text in _SPECIAL if is_kind(status.st_mode))
        raise InputError(path, f"cannot be read, {next(why, 'it is not a regular file')}")
    if os.path.realpath(path).startswith(_KERNEL):
        raise InputError(path, "cannot be read, it is a file of the kernel, not a regular file")


def refuse_unreadable(path: Path) -> None:
    """Refuse a file that does not exist, cannot be opened or is no regular file, by an InputError."""
    with regular(path):
        pass


def read_bytes(
    path: str | Path, *, most: int, copies: float = 1.0, refuse: Callable[[bytes], None] | None = None
) -> bytes:
    """Content of a regular file of at most ``most`` bytes; a larger one is refused before it is read.

    ``copies`` is the ratio of the memory that its reader needs to the size of the file, which must fit;
    ``refuse`` is called with the first bytes of the file, before its size is checked. Raises an InputError.
    """
    with regular(path) as file:
        if refuse is not None:
            refuse(file.peek(_FIRST)[:_FIRST])
        size = os.fstat(file.fileno()).st_size
        check_size(Path(path), size, most, copies=copies)
        content = file.read(size + 1)
    if len(content) > size:
        raise InputError(path, "grows while it is read")
    return content


def blocks(path: str | Path, *, most: int, size: int = 8_000_000) -> Iterator[bytes]:
    """Yield a regular file of at most ``most`` bytes in blocks of a size; nothing for an empty file.

    A larger file is refused before it is read. Raises an InputError.
    """
    with regular(path) as file:
        left = os.fstat(file.fileno()).st_size
        check_size(Path(path), left, most, copies=0.0)
        while block := file.read(min(size, left + 1)):
            if len(block) > left:
                raise InputError(path, "grows while it is read")
            left -= len(block)
            yield block


def read_text(
    path: str | Path, *, most: int = MOST_TEXT, refuse: Callable[[bytes], None] | None = None
) -> str:
    """Text of a regular file in UTF-8 of at most ``most`` bytes, without a byte order mark.

    Line ends are line feeds, as Python reads a text file; ``refuse`` as in ``read_bytes``. Raises an
    InputError.
    """
    content = read_bytes(path, most=most, refuse=refuse)
    if b"\0" in content[:PEEKED] and kind_of(content) is not None:
        raise InputError(path, not_text(content))
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise InputError(path, "is not a text file in UTF-8") from None
    return text.replace("\r\n", "\n").replace("\r", "\n")
