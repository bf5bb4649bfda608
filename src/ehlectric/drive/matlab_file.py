"""Arrays of numbers in files of MATLAB, version 5 to 7.2.

The reader of SciPy ends the process for some damaged files. This one reads arrays of real numbers only, and
skips all other variables. Source: MathWorks, MAT-File Format, chapter 1.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from ehlectric.errors import DamagedError

# Length of the header, and place of the mark of its order of bytes [bytes].
_HEADER, _MARK = 128, 126

# Types of elements: a matrix, a compressed element, and NumPy's types of numbers.
_MATRIX, _COMPRESSED = 14, 15
_NUMBERS = {
    1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 9: "f8", 12: "i8", 13: "u8",
}  # fmt: skip

# Classes of arrays of floating-point and of whole numbers, and flags of complex and logical arrays.
_FLOATING, _WHOLE, _FLAGS = (6, 7), range(8, 16), 0x0A00


@dataclass(frozen=True, eq=False)
class MatlabArray:
    """Variable of a file: an array of one or two dimensions of real numbers."""

    name: str
    numbers: Any
    whole: bool  # whether the class of the variable is a class of whole numbers


def matlab_arrays(path: object, content: bytes, most: int) -> Iterator[MatlabArray]:
    """Arrays of a file; compressed variables may have up to ``most`` bytes.

    Raises DamagedError if the file is damaged.
    """
    order = "<" if content[_MARK:_HEADER] == b"IM" else ">"
    try:
        for kind, data in _elements(content[_HEADER:], order):
            if kind == _COMPRESSED:
                kind, data = next(_elements(_inflated(data, most), order))
            if kind == _MATRIX:
                array = _array(data, order)
                if array is not None:
                    yield array
    except (struct.error, ValueError, KeyError, StopIteration, IndexError, zlib.error) as error:
        raise DamagedError.of(path, str(error)[:80]) from None


def _inflated(data: bytes, most: int) -> bytes:
    unpacked = zlib.decompressobj()
    content = unpacked.decompress(data, most)
    if unpacked.unconsumed_tail or not unpacked.eof:
        raise ValueError("a compressed variable is too large or cut off")
    return content


def _elements(data: bytes, order: str) -> Iterator[tuple[int, bytes]]:
    """Types and contents of elements that follow each other, each filled up to eight bytes."""
    place = 0
    while place + 8 <= len(data):
        kind, count = struct.unpack_from(f"{order}II", data, place)
        begin, small = place + 8, kind >> 16
        if small:
            kind, count, begin = kind & 0xFFFF, small, place + 4
        if begin + count > len(data) or (small and count > 4):
            raise ValueError("an element is longer than the file")
        yield kind, data[begin : begin + count]
        place = place + 8 if small else begin + count + (0 if kind == _COMPRESSED else -count % 8)


def _array(data: bytes, order: str) -> MatlabArray | None:
    """Array of a matrix; None for texts, structures, and complex, logical and empty arrays."""
    parts = _elements(data, order)
    flags = struct.unpack_from(f"{order}I", next(parts)[1])[0]
    kind = flags & 0xFF
    if (kind not in _FLOATING and kind not in _WHOLE) or flags & _FLAGS:
        return None
    shape = np.frombuffer(next(parts)[1], f"{order}i4")
    name = next(parts)[1].decode("latin-1")
    stored, content = next(parts)
    numbers = np.frombuffer(content, f"{order}{_NUMBERS[stored]}")
    if shape.size > 2 or not numbers.size:
        return None
    return MatlabArray(name, numbers.reshape(tuple(shape), order="F"), kind in _WHOLE)
