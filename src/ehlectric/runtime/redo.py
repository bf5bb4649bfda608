"""Changes of a file that are written down before they are made, so that a kill in between can be made good.

The changes stand in a hidden file beside the file, which appears whole. Whoever opens the file next finds it,
makes the changes (once more), and removes it.
"""

from __future__ import annotations

import os
import struct
from collections.abc import Sequence
from pathlib import Path
from typing import BinaryIO

from ehlectric.runtime.files import flush, write

# Beginning of the file of changes: its kind, device and number of the file that is changed, and its new size.
_HEAD = struct.Struct("<12sQQQ")
_KIND = b"ehl redo 1\r\n"

# Place and length of a part that follows.
_PART = struct.Struct("<QQ")


def redo_file(path: Path) -> Path:
    """File in which the changes of a file are written down."""
    return path.with_name(f".{path.name}.redo")


def write_down(path: Path, number: int, size: int, parts: Sequence[tuple[int, memoryview]]) -> None:
    """Write down the changes of a file that is open for writing.

    Parameters
    ----------
    path : Path
        The file.
    number : int
        Its descriptor.
    size : int
        Its new size [bytes].
    parts : sequence of tuple of int and memoryview
        Place and content of each part that is changed.

    Raises
    ------
    WriteError
        Where the changes cannot be written down, as on a full disk.
    """
    state = os.fstat(number)

    def content(file: BinaryIO) -> None:
        file.write(_HEAD.pack(_KIND, state.st_dev, state.st_ino, size))
        for place, part in parts:
            file.write(_PART.pack(place, len(part)))
            file.write(part)

    write(redo_file(path), content)


def make(number: int, size: int, parts: Sequence[tuple[int, memoryview | bytes]]) -> None:
    """Make changes in a file that is open for writing.

    Raises
    ------
    OSError
        Where they cannot be made.
    """
    for place, part in parts:
        os.lseek(number, place, os.SEEK_SET)
        view = memoryview(part)
        while view:
            view = view[os.write(number, view) :]
    os.ftruncate(number, size)


def finish(path: Path, number: int) -> None:
    """Make the changes of a file that are written down, if there are any, and forget them.

    Changes of another file, which this one has replaced since, are forgotten.

    Parameters
    ----------
    path : Path
        The file.
    number : int
        Its descriptor, open for writing and locked.

    Raises
    ------
    OSError
        Where the changes cannot be read or made.
    """
    changes = redo_file(path)
    try:
        content = memoryview(changes.read_bytes())
    except FileNotFoundError:
        return
    state = os.fstat(number)
    if len(content) >= _HEAD.size:
        *of_file, size = _HEAD.unpack_from(content)
        if of_file == [_KIND, state.st_dev, state.st_ino]:
            make(number, size, list(_parts(content[_HEAD.size :])))
            flush(number)
    changes.unlink(missing_ok=True)


def _parts(content: memoryview) -> list[tuple[int, memoryview]]:
    parts = []
    while content:
        place, length = _PART.unpack_from(content)
        parts.append((place, content[_PART.size : _PART.size + length]))
        content = content[_PART.size + length :]
    return parts
