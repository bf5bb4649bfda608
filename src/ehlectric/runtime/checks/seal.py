"""Seals: a checksum at the end of a file, which tells later whether a byte of the file has changed.

The seal follows the content as a last line of fixed length. Programs that read NetCDF or HDF5 ignore bytes
after the end that the header of the file states. A program that opens the file to change it cuts the seal
off, so that a file that was changed on purpose has none.
"""

from __future__ import annotations

import re
import zlib
from collections.abc import Iterable
from io import RawIOBase
from pathlib import Path
from typing import BinaryIO

from ehlectric.errors import DamagedError
from ehlectric.runtime.files import reading

_SEAL = "\nehlectric crc32 {:08x}\n"
_FORM = re.compile(rb"\nehlectric crc32 ([0-9a-f]{8})\n")
_LENGTH = len(_SEAL.format(0))

# Bytes that are read at a time.
_BLOCK = 1 << 20


def seal(path: Path) -> None:
    """Append a seal to a file that is complete; a file that has one is not changed.

    Where the disk is full, the file is left without a seal: it can be read all the same.
    """
    with path.open("r+b", buffering=0) as file:
        length, found = _split(file)
        if found is None:
            total = _checksum(file, length)
            try:
                file.seek(length)
                file.write(_SEAL.format(total).encode())
            except OSError:
                file.truncate(length)


def seal_of(content: Iterable[bytes | memoryview]) -> bytes:
    r"""Seal of the content of a file, in parts, to be written after it.

    Examples
    --------
    >>> seal_of([b"fi", b"lm"])
    b'\nehlectric crc32 8244be22\n'
    """
    total = 0
    for part in content:
        total = zlib.crc32(part, total)
    return _SEAL.format(total).encode()


def sealed(path: Path) -> bool:
    """Whether a file has a seal that fits its content.

    Parameters
    ----------
    path : Path
        File to read.

    Returns
    -------
    bool
        False where the file has no seal, as those of earlier versions and those that are still written.

    Raises
    ------
    DamagedError
        Where the seal does not fit the content.
    InputError
        Where the file cannot be read.
    """
    with reading(path), path.open("rb") as file:
        length, expected = _split(file)
        if expected is None:
            return False
        if _checksum(file, length) != expected:
            raise DamagedError.of(path, "its bytes are not those that were written")
    return True


def _split(file: BinaryIO | RawIOBase) -> tuple[int, int | None]:
    """Length of the content of a file, and the checksum in its seal; None where it has no seal."""
    size = file.seek(0, 2)
    file.seek(max(size - _LENGTH, 0))
    match = _FORM.fullmatch(file.read(_LENGTH))
    return (size, None) if match is None else (size - _LENGTH, int(match[1], 16))


def _checksum(file: BinaryIO | RawIOBase, length: int) -> int:
    """CRC-32 of the first bytes of a file."""
    file.seek(0)
    total = 0
    while length > 0 and (block := file.read(min(_BLOCK, length))):
        total = zlib.crc32(block, total)
        length -= len(block)
    return total
