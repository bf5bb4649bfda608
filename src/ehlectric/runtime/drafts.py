"""Files of HDF5 whose changes are kept in memory until they are written, so that a kill in between is made
good.

Changes of a file that are written down before they are made, so that a kill in between can be made good.
The changes stand in a hidden file beside the file, which appears whole. Whoever opens the file next finds it,
makes the changes (once more), and removes it.

The library HDF5 crashes where a write fails, as on a full disk. A write to a draft does not fail: HDF5 writes
to pages in memory, and they are written to the disk when HDF5 has closed the file.
"""

from __future__ import annotations

import io
import os
import struct
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO

from ehlectric.runtime.files import flush, write

if TYPE_CHECKING:
    from _typeshed import ReadableBuffer, WriteableBuffer

# Beginning of the file of changes: its kind, device and number of the file that is changed, and its new size.
_HEAD = struct.Struct("<12sQQQ")
_KIND = b"ehl redo 1\r\n"

# Place and length of a part that follows.
_PART = struct.Struct("<QQ")


def redo_file(path: Path) -> Path:
    """File in which the changes of a file are written down."""
    return path.with_name(f".{path.name}.redo")


def write_down(path: Path, number: int, size: int, parts: Sequence[tuple[int, memoryview]]) -> None:
    """Write down the changes of a file that is open for writing. ``size`` [bytes]. Raises WriteError where
    the changes cannot be written down, as on a full disk.
    """
    state = os.fstat(number)

    def content(file: BinaryIO) -> None:
        file.write(_HEAD.pack(_KIND, state.st_dev, state.st_ino, size))
        for place, part in parts:
            file.write(_PART.pack(place, len(part)))
            file.write(part)

    write(redo_file(path), content)


def make(number: int, size: int, parts: Sequence[tuple[int, memoryview | bytes]]) -> None:
    """Make changes in a file that is open for writing. Raises OSError where they cannot be made."""
    for place, part in parts:
        os.lseek(number, place, os.SEEK_SET)
        view = memoryview(part)
        while view:
            view = view[os.write(number, view) :]
    os.ftruncate(number, size)


def finish(path: Path, number: int) -> None:
    """Make the changes of a file that are written down, if there are any, and forget them.

    Changes of another file, which this one has replaced since, are forgotten.

    Raises OSError where the changes cannot be read or made.
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


WriteDown = Callable[[int, Sequence[tuple[int, memoryview]]], None]

# Size of a page [bytes].
_PAGE = 1 << 16


class Draft(io.RawIOBase):
    """Binary file in memory, which may be a changed copy of a file on the disk.

    It has the methods of a raw file that h5py needs.

    Examples
    --------
    >>> draft = Draft()
    >>> draft.write(b"film"), draft.seek(1), draft.read(2)
    (4, 1, b'il')
    """

    def __init__(self, number: int | None = None) -> None:
        self._number = number
        self._old = self._size = 0 if number is None else os.fstat(number).st_size
        self._pages: dict[int, bytearray] = {}
        self._at = 0
        self._failed: Exception | None = None

    def seek(self, offset: int, whence: int = io.SEEK_SET) -> int:
        """Move to a position, and return it."""
        self._at = offset + {io.SEEK_SET: 0, io.SEEK_CUR: self._at, io.SEEK_END: self._size}[whence]
        return self._at

    def truncate(self, size: int | None = None) -> int:
        """Change the size of the file, and return it."""
        size = self._at if size is None else size
        if size < self._size:
            for page in [page for page in self._pages if page * _PAGE >= size]:
                del self._pages[page]
            if size % _PAGE:
                at, kept = divmod(size, _PAGE)
                self._guarded(at)[kept:] = bytes(_PAGE - kept)
            self._old = min(self._old, size)
        self._size = size
        return size

    def readinto(self, buffer: WriteableBuffer) -> int:
        """Fill a buffer from the position on, and return the number of bytes."""
        view = memoryview(buffer).cast("B")
        done, size = 0, max(0, min(len(view), self._size - self._at))
        while done < size:
            page, start = divmod(self._at + done, _PAGE)
            count = min(size - done, _PAGE - start)
            held = self._pages.get(page)
            view[done : done + count] = (self._stored(page) if held is None else held)[start : start + count]
            done += count
        self._at += size
        return size

    def write(self, content: ReadableBuffer) -> int:
        """Write bytes at the position, and return their number."""
        view = memoryview(content).cast("B")
        done, size = 0, len(view)
        while done < size:
            page, start = divmod(self._at + done, _PAGE)
            count = min(size - done, _PAGE - start)
            self._guarded(page)[start : start + count] = view[done : done + count]
            done += count
        self._at += size
        self._size = max(self._size, self._at) if size else self._size
        return size

    def _guarded(self, page: int) -> bytearray:
        """Page to be changed. Where there is no memory for it, ``apply`` raises the error: HDF5 must not."""
        try:
            if page not in self._pages:
                self._pages[page] = self._stored(page)
            return self._pages[page]
        except (MemoryError, OSError) as error:
            self._failed = self._failed or error
            return bytearray(_PAGE)

    def _stored(self, page: int) -> bytearray:
        """Page of the file on the disk, zeros where it has none."""
        length = max(0, min(_PAGE, self._old - page * _PAGE))
        if self._number is None or not length:
            return bytearray(_PAGE)
        os.lseek(self._number, page * _PAGE, os.SEEK_SET)
        content = bytearray()
        while len(content) < length and (part := os.read(self._number, length - len(content))):
            content += part
        return content + bytes(_PAGE - len(content))

    def content(self) -> Iterator[memoryview]:
        """All bytes, part by part. Raises MemoryError where the draft had not enough memory."""
        self._check()
        for page in range(-(-self._size // _PAGE)):
            content = self._pages.get(page)
            content = self._stored(page) if content is None else content
            yield memoryview(content)[: self._size - page * _PAGE]

    def apply(self, write_down: WriteDown | None = None) -> None:
        """Write the changes to the file on the disk.

        What makes the file longer is written first: where the disk is full, the file stays as it was.

        Raises OSError where the changes cannot be written; MemoryError where the draft had not enough memory.
        """
        self._check()
        assert self._number is not None
        before = os.fstat(self._number).st_size
        # Pages behind a part that was cut off are zeros, where nothing was written to them.
        cut = range(-(-self._old // _PAGE), -(-min(before, self._size) // _PAGE))
        replaced = self._parts(sorted({*self._pages, *cut}), 0, min(before, self._size))
        try:
            # Also pages that nothing was written to: in a hole, a later change could find the disk full.
            pages = range(before // _PAGE, -(-self._size // _PAGE))
            make(self._number, max(before, self._size), self._parts(pages, before, self._size))
            flush(self._number)
            if write_down is not None:
                write_down(self._size, replaced)
        except Exception:
            os.ftruncate(self._number, before)
            raise
        make(self._number, self._size, replaced)

    def _parts(self, pages: Iterable[int], start: int, end: int) -> list[tuple[int, memoryview]]:
        """Places and content of pages, as far as they lie between two places of the file."""
        parts = []
        for page in pages:
            first, last = max(page * _PAGE, start), min((page + 1) * _PAGE, end)
            if first < last:
                content = memoryview(self._pages.get(page, bytes(_PAGE)))
                parts.append((first, content[first - page * _PAGE : last - page * _PAGE]))
        return parts

    @property
    def changed(self) -> int:
        """Upper bound of the number of bytes that ``apply`` writes."""
        return len(self._pages) * _PAGE

    def _check(self) -> None:
        if self._failed is not None:
            raise self._failed
