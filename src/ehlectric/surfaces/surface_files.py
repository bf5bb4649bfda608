"""Readers of measured surfaces: text profiles, ISO 25178-72 X3P and Alicona AL3D.

The content of a file is not trusted: every size is checked before a block of this size is read, and members
of ZIP archives are decompressed no further than the size that is expected. Doubtful data are refused with an
error that names the fault, such as spacings that are not uniform, slopes that are too large for the spacing,
and lines without data. Other formats are read by the package SurfaceTopography if it is installed.
"""

from __future__ import annotations

import bz2
import codecs
import io
import lzma
import math
import re
import struct
import zipfile
import zlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from types import MappingProxyType
from typing import TypeAlias
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from ehlectric.arrays import Array
from ehlectric.errors import InputError, shown, within
from ehlectric.quantities.grouped_digits import has_thousands, proven_mark, value_of
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.quantities.unit_spelling import typed
from ehlectric.quantities.units import known_factor, length_unit, to_si
from ehlectric.runtime.delimited import fields, is_void
from ehlectric.runtime.memory import in_bytes
from ehlectric.runtime.reading import read_bytes, regular
from ehlectric.runtime.sizes import check_memory_for
from ehlectric.surfaces.maps import Map, filled, without_void_borders
from ehlectric.surfaces.profiles import LEAST_POINTS, Profile

# Exceptions of Python's readers of ZIP archives and XML, and of its decompressors, for invalid content.
BROKEN = (
    zipfile.BadZipFile,
    zlib.error,
    lzma.LZMAError,
    struct.error,
    RuntimeError,
    NotImplementedError,  # compression that Python does not know
    LookupError,
    ValueError,
    OSError,
    EOFError,
    OverflowError,
    ElementTree.ParseError,
)

# Largest number of members of an archive. A surface has fewer than ten.
MOST_MEMBERS = 10_000

# Largest ratio of the size of a member to its compressed size, beyond a size that does no harm [bytes].
# Measured heights become at most some ten times smaller.
MOST_RATIO = 100
HARMLESS = 16_000_000

# Largest dictionary of LZMA [bytes]; its decompressor takes as much memory.
_MOST_DICTIONARY = 64_000_000

# Size of the header before each member, and its bytes with the lengths of the name and of the extra field.
_HEADER, _LENGTHS = 30, slice(26, 30)
_ENTRY = b"PK\x01\x02"
_ENCRYPTED = 1


def opened(content: bytes) -> zipfile.ZipFile:
    """ZIP archive of a content. Raises BadZipFile for other content or more than ``MOST_MEMBERS`` members."""
    if content.count(_ENTRY) > MOST_MEMBERS:
        raise zipfile.BadZipFile("too many members")
    return zipfile.ZipFile(io.BytesIO(content))


def member(archive: zipfile.ZipFile, content: bytes, name: str, most: int) -> bytes:
    """Content of a member of an archive, decompressed up to the largest size ``most`` [bytes].

    Raises an InputError where the stated size is more than ``MOST_RATIO`` times the compressed size, and one
    of ``BROKEN`` where the member is missing, broken, encrypted, or larger than ``most``.

    Examples
    --------
    >>> target = io.BytesIO()
    >>> with zipfile.ZipFile(target, "w") as new:
    ...     new.writestr("main.xml", b"<a/>")
    >>> content = target.getvalue()
    >>> member(opened(content), content, "main.xml", 100)
    b'<a/>'
    """
    info = archive.getinfo(name)
    if info.flag_bits & _ENCRYPTED or info.file_size > most:
        raise ValueError(name)
    allowed = HARMLESS + MOST_RATIO * info.compress_size
    if info.file_size > allowed:
        raise InputError.worded(
            None,
            f"holds {in_bytes(info.file_size)} in {in_bytes(info.compress_size)}; "
            f"expected at most {in_bytes(allowed)}, as measured heights hardly compress",
        )
    decompress = _DECOMPRESS.get(info.compress_type)
    if decompress is None:
        raise NotImplementedError(info.compress_type)
    start = info.header_offset + _HEADER
    start += sum(struct.unpack("<HH", content[info.header_offset :][:_HEADER][_LENGTHS]))
    data = decompress(content[start : start + info.compress_size], info.file_size + 1)
    if len(data) != info.file_size or zlib.crc32(data) != info.CRC:
        raise zipfile.BadZipFile(name)
    return data


def _unlzma(data: bytes, most: int) -> bytes:
    """Member compressed by LZMA: two bytes of version, the length of the properties, and five of them."""
    length, properties, dictionary = struct.unpack("<xxHBI", data[:9])
    rest, lc = divmod(properties, 9)
    pb, lp = divmod(rest, 5)
    if length != 5 or dictionary > _MOST_DICTIONARY:
        raise ValueError("unknown properties of LZMA")
    kind = {"id": lzma.FILTER_LZMA1, "dict_size": dictionary, "lc": lc, "lp": lp, "pb": pb}
    return lzma.LZMADecompressor(lzma.FORMAT_RAW, filters=[kind]).decompress(data[9:], most)


# Functions that decompress at most so many bytes, by the kind of compression.
_DECOMPRESS: Mapping[int, Callable[[bytes, int], bytes]] = MappingProxyType(
    {
        zipfile.ZIP_STORED: lambda data, most: data[:most],
        zipfile.ZIP_DEFLATED: lambda data, most: zlib.decompressobj(-zlib.MAX_WBITS).decompress(data, most),
        zipfile.ZIP_BZIP2: lambda data, most: bz2.BZ2Decompressor().decompress(data, most),
        zipfile.ZIP_LZMA: _unlzma,
    }
)


# Text profiles: position and height in two columns, below a header of any form. The separator of the columns
# is a semicolon, a tab, a comma or white space, the same in the whole file. A comma that is not the separator
# is a decimal comma. A file that can be read in two ways is refused.

# Most lines of a text, of which each is looked at: twice those of the longest profiles of instruments.
MOST_LINES = 2_000_000

_EXPONENT = r"(?:[eE][-+]?[0-9]{1,4})?"
# Repetitions that are never given up, "++" and "*+", keep the time proportional to the length of a line.
_NUMBER = {
    ".": re.compile(r"[-+]?(?:[0-9]++\.?[0-9]*+|\.[0-9]++)" + _EXPONENT),
    ",": re.compile(r"[-+]?(?:[0-9]++,?[0-9]*+|,[0-9]++)" + _EXPONENT),
}
_SPACED_NUMBER = re.compile(r"[-+]?(?:[0-9]++(?:\.|[.,][0-9]++)?|\.[0-9]++)" + _EXPONENT)
_WHOLE_PAIR = re.compile(r"\s*+[-+]?[0-9]++,[0-9]++\s*+")

# Number of lines at the end of a file that show its separator.
_LAST = 20

# Line with a single number.
_SINGLE = re.compile(r"\s*+[-+]?(?:[0-9]++[.,]?[0-9]*+|[.,][0-9]++)(?:[eE][-+]?[0-9]++)?[;,]?\s*+")
_UTF_16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
_UNITS = ("m", "mm", "um", "µm", "nm", "Å")
_UNIT_WORDS = {
    prefix + ending: unit
    for prefix, unit in (("", "m"), ("milli", "mm"), ("micro", "um"), ("nano", "nm"))
    for ending in ("metre", "meter", "metres", "meters")
} | {"micron": "um", "microns": "um", "angstrom": "Å"}
_BRACKETED = re.compile(r"[\[(]([^\[\]()]*)[\])]")
_BRACKETED_FIELD = re.compile(r"[^\[\]()]*+[\[(][^\[\]()]*+[\])]")
_BRACKETED_FIELDS = re.compile(rf"(?:{_BRACKETED_FIELD.pattern})++")
_VALIDITY = re.compile(r"valid(ity)?", re.IGNORECASE)

# Largest number of columns of a text profile: position, height and validity.
_PROFILE_COLUMNS = 3

# Largest position and height that are credible for a surface [m].
_FARTHEST = 10.0


class NoProfileError(InputError):
    """Error of a text that has other contents than the two columns of a profile, such as a matrix."""


@dataclass(frozen=True)
class TextProfile:
    """Profile as read from a text file."""

    heights: Array  # heights [m], NaN at points without data, shape (n,)
    spacing: float  # distance between neighbouring points [m]
    warnings: tuple[ResultWarning, ...]  # warnings about the data in the file


@dataclass(frozen=True)
class _Layout:
    separator: str | None  # None is white space
    decimal: str

    def fields(self, line: str) -> list[str]:
        """Fields of a line; a field without a value is empty."""
        if self.separator is None or '"' not in line:
            # A tab at the end of a line is a separator before an empty field.
            found = [field.strip() for field in line.strip(" \r\n").split(self.separator)]
        else:
            found = fields(line.strip(), self.separator)
        return ["" if is_void(field) else field for field in found]

    def is_row(self, line: str) -> bool:
        first, *rest = self.fields(line) or [""]
        return self._is_number(first) and bool(rest) and all(not f or self._is_number(f) for f in rest)

    def _is_number(self, field: str) -> bool:
        if _NUMBER[self.decimal].fullmatch(field):
            return True
        return has_thousands(field) and proven_mark(field) == self.decimal

    def value(self, field: str) -> float:
        return value_of(field, self.decimal) if field else np.nan

    def decimals(self, field: str) -> int:
        mantissa, _, exponent = field.lower().partition("e")
        return len(mantissa.partition(self.decimal)[2]) - int(exponent or 0)


@dataclass(frozen=True)
class _Block:
    layout: _Layout
    header: list[str]
    rows: list[list[str]]  # all of the same width
    numbers: list[int]  # line numbers of the rows in the file, from 1


def is_text(content: bytes) -> bool:
    """Whether the content of a file looks like text."""
    return content[:2] in _UTF_16 or b"\0" not in content[:4096]


def read_text(path: Path, content: bytes, x_unit: str | None, z_unit: str | None) -> TextProfile:
    """Profile in a text file, with heights and spacing in metres.

    Raises a NoProfileError if the file is not two columns of numbers, so that another reader may know its
    format. Raises an InputError if the file cannot be read or can be read in two ways, or if its units are
    unknown or contradict the arguments.
    """
    block = _block(path, _decoded(path, content))
    if len(block.rows) < LEAST_POINTS:
        raise InputError(path, f"has {len(block.rows)} points", takes=f"at least {LEAST_POINTS}")
    width = len(block.rows[0])
    if width > 2 and not (width == 3 and _has_validity(block)):
        raise NoProfileError(
            path, f"has {width} columns", takes="two, position and height, and perhaps a third headed 'valid'"
        )
    stated = _stated_units(block, width)
    values = _values(path, block)
    factors = [
        to_si(f"1 {_unit_of(path, name, unit, from_header)}", "m")
        for name, unit, from_header in zip(("x_unit", "z_unit"), (x_unit, z_unit), stated, strict=True)
    ]
    x, z = values[:, 0], values[:, 1] * factors[1]
    if max(np.max(np.abs(x)) * factors[0], np.max(np.abs(z), initial=0.0, where=~np.isnan(z))) > _FARTHEST:
        raise InputError(path, f"contains lengths above {_FARTHEST:g} m; are x_unit and z_unit right?")
    if width > 2:
        z = np.where(_valid(path, block), z, np.nan)
    digits = max(block.layout.decimals(row[0]) for row in block.rows)
    spacing, warnings = _spacing(path, x, 10.0 ** -min(max(digits, -12), 30))
    return TextProfile(z, spacing * factors[0], warnings)


def _decoded(path: Path, content: bytes) -> str:
    """Text of a file in UTF-8, UTF-16 or Windows-1252."""
    codes = ("utf-16",) if content[:2] in _UTF_16 else ("utf-8-sig", "cp1252")
    for code in codes:
        try:
            return content.decode(code)
        except UnicodeDecodeError:
            continue
    raise InputError(path, "is not text in UTF-8, UTF-16 or Windows-1252")


def _block(path: Path, text: str) -> _Block:
    """Block of numbers at the end of a file, with the header above it."""
    lines = text.splitlines()
    if len(lines) > MOST_LINES:
        raise InputError(path, f"has {len(lines)} lines", takes=f"at most {MOST_LINES}")
    last = list(islice((line for line in reversed(lines) if line.strip()), _LAST))
    # The last point may be void, without a character behind its position.
    separator = _separator(max(last, key=lambda line: len(line.split()), default=""))
    marks = "." if separator == "," and '"' not in text else ".,"
    layouts = [_Layout(separator, decimal) for decimal in marks]
    rows = ((n, line) for n, line in enumerate(lines) if any(layout.is_row(line) for layout in layouts))
    first, _ = next(rows, (len(lines), ""))
    below = [(n, line) for n, line in enumerate(lines[first:], first + 1) if line.strip()]
    if not below:
        raise _no_columns(path, lines)
    if separator == "," and all(_WHOLE_PAIR.fullmatch(line) for _, line in below):
        raise InputError(
            path,
            f"line {below[0][0]} is {shown(below[0][1].strip())}, one number with a decimal comma "
            "or two whole ones;",
            takes="a semicolon or a tab between columns",
        )
    layout = next((each for each in layouts if all(each.is_row(line) for _, line in below)), None)
    if layout is None:
        raise _bad_line(path, below, layouts)
    fields = [layout.fields(line) for _, line in below]
    numbers = [number for number, _ in below]
    return _Block(layout, lines[:first], _rectangle(path, fields, numbers), numbers)


def _no_columns(path: Path, lines: list[str]) -> InputError:
    """Error of a file without two columns of numbers, which may have one column of heights."""
    single = [line for line in lines if _SINGLE.fullmatch(line)]
    if len(single) > 1:
        return InputError(path, "contains one column of numbers", takes="two, position and height")
    return NoProfileError(path, "does not contain two columns of numbers", takes="position and height")


def _separator(line: str) -> str | None:
    """Separator of the columns, from the last line of a file; None for white space."""
    for separator in (";", "\t"):
        if separator in line.strip():
            return separator
    tokens = line.split()
    spaced = len(tokens) > 1 and all(_SPACED_NUMBER.fullmatch(one) or is_void(one) for one in tokens)
    return "," if "," in line and not spaced else None


def _bad_line(path: Path, below: list[tuple[int, str]], layouts: list[_Layout]) -> InputError:
    for number, line in below:
        if not any(layout.is_row(line) for layout in layouts):
            if len(layouts[0].fields(below[0][1])) > _PROFILE_COLUMNS:
                return NoProfileError(path, f"line {number} is not of numbers only", takes="two columns")
            text = shown(line.strip())
            return InputError(path, f"line {number} is {text}", takes="numbers of one kind down to the end")
    first = next(layout for layout in layouts if layout.is_row(below[0][1]))
    number, line = next((n, line) for n, line in below if not first.is_row(line))
    return InputError(
        path,
        f"line {number} is {shown(line.strip())} and mixes decimal points and decimal commas",
        takes="one of the two",
    )


def _rectangle(path: Path, fields: list[list[str]], numbers: list[int]) -> list[list[str]]:
    """Rows with equal numbers of fields, without surplus empty fields at their ends.

    Raises an error for a row with too few fields.
    """
    width = max(2, *(max(k for k, field in enumerate(row, 1) if field) for row in fields))
    for row, number in zip(fields, numbers, strict=True):
        if len(row) < width:
            raise InputError(
                path, f"line {number} has {len(row)} columns", takes=f"{width} as in other lines"
            )
    return [row[:width] for row in fields]


def _values(path: Path, block: _Block) -> Array:
    """Positions and heights in the units of the file, shape (n, 2), with NaN for an empty height."""
    values = np.array([[block.layout.value(field) for field in row[:2]] for row in block.rows])
    infinite = np.any(np.isinf(values), axis=1)
    if np.any(infinite):
        raise InputError(
            path, f"line {block.numbers[int(np.argmax(infinite))]} contains a number that is too large"
        )
    return values


def _head_lines(block: _Block) -> list[str]:
    """Lines of the header without comment marks."""
    return [line.strip().lstrip("#%/ ") for line in block.header if line.strip()]


def _has_validity(block: _Block) -> bool:
    """Whether the header of the third column, in one of the last two lines, is "valid" or "validity"."""
    heads = [block.layout.fields(line) for line in _head_lines(block)[-2:]]
    return any(len(head) > 2 and _VALIDITY.fullmatch(head[2].strip("\"' ")) for head in heads)


def _valid(path: Path, block: _Block) -> NDArray[np.bool_]:
    flags = [row[2] for row in block.rows]
    for flag, number in zip(flags, block.numbers, strict=True):
        if flag not in ("0", "1"):
            raise InputError(path, f"line {number} has the validity {shown(flag)}", takes="0 or 1")
    return np.array([flag == "1" for flag in flags])


def _stated_units(block: _Block, width: int) -> tuple[str | None, str | None]:
    """Units of the two columns from the line above them; None for a unit that the line does not state.

    The line must have one field per column. Examples are "Lateral um,Raw Micrometer", "[mm];[mm]" and, with
    white space as separator, "x [um] z [nm]".
    """
    lines = _head_lines(block)
    if not lines:
        return None, None
    fields = block.layout.fields(lines[-1])
    while fields and not fields[-1]:
        fields.pop()
    if len(fields) != width:
        # The search alone would take the square of the length of a line without brackets.
        whole = _BRACKETED_FIELDS.fullmatch(lines[-1])
        fields = _BRACKETED_FIELD.findall(lines[-1]) if whole else []
        if len(fields) != width:
            return None, None
    return _unit_in(fields[0]), _unit_in(fields[1])


def _unit_in(field: str) -> str | None:
    """Unit of length in the head of a column, None if there is not exactly one.

    A unit after a number does not count, as it belongs to a value.
    """
    field = typed(field)
    brackets = _BRACKETED.findall(field)
    if brackets:
        candidates = [inner.strip() for inner in brackets]
        if re.search(r"[0-9]\s*[\[(]", field):
            return None
    elif re.search(r"[0-9]", field):
        return None
    else:
        candidates = re.findall(r"[^\W\d_]+", field)
    units = [_UNIT_WORDS.get(word.lower(), word) for word in candidates]
    # Without brackets, "in" is a word; in brackets, it is an inch.
    units = [unit for unit in units if (known_factor(unit, "m") is not None if brackets else unit in _UNITS)]
    return units[0] if len(units) == 1 else None


def _unit_of(path: Path, name: str, given: str | None, stated: str | None) -> str:
    if given is not None:
        with within(name):
            length_unit(given)
    if given is not None and stated is not None and to_si(f"1 {given}", "m") != to_si(f"1 {stated}", "m"):
        raise InputError(name, got=f"{given!r}, but {path} states {stated!r}")
    unit = stated if given is None else given
    if unit is None:
        raise InputError.worded(name, f"missing; {path} does not state the unit of its column unambiguously")
    return unit


def _spacing(path: Path, x: Array, step: float) -> tuple[float, tuple[ResultWarning, ...]]:
    """Spacing of positions (n,) that are equally spaced up to rounding, and warnings about it.

    The spacing follows from the whole length, as distances of neighbours have larger rounding errors.
    ``step`` is the last decimal place of the positions in the file, in the unit of ``x``.
    """
    steps = np.diff(x)
    if not np.all(steps > 0.0):
        bad = int(np.argmin(steps > 0.0))
        raise InputError(path, f"positions {bad} and {bad + 1} do not increase")
    spacing = float((x[-1] - x[0]) / (x.size - 1))
    largest = float(np.max(np.abs(x - (x[0] + spacing * np.arange(x.size)))))
    # Rounded positions lie within one step of equal spacing, and neighbours have one of two distances.
    if largest > 1.01 * max(step, 1e-3 * spacing) or np.ptp(steps) > 1.01 * max(step, 4e-3 * spacing):
        raise InputError(
            path,
            f"the spacing is not uniform, positions deviate by up to {largest / spacing:.2g} of "
            f"it and neighbours are {np.min(steps):.4g} to {np.max(steps):.4g} apart",
        )
    # Samples may be missing only if the longer of the two distances is twice the shorter.
    long = steps > 1.5 * np.min(steps)
    if 0 < np.count_nonzero(long) <= 0.05 * steps.size:
        irregular = ResultWarning.of(
            "spacing-irregular",
            file=path,
            long=np.count_nonzero(long),
            distances=steps.size,
            point=int(np.argmax(long)),
        )
        return spacing, (irregular,)
    return spacing, ()


# Largest number of points of a map, and largest size of its XML description [bytes].
MOST_POINTS = 100_000_000
_MOST_XML = 2_000_000

# Heights (rows, columns) [m] with NaN at points without data, distance between neighbours in a row [m], and
# distance between rows [m], None for a single row.
HeightMap: TypeAlias = tuple[Array, float, float | None]

# Memory of each point while a map is read [bytes]: its height, and whether it is valid.
_POINT = 10

_KINDS = {"D": "<f8", "F": "<f4", "L": "<i4", "I": "<i2"}


def read_x3p(path: Path, content: bytes) -> HeightMap:
    """Read the height map in an X3P file (ISO 25178-72).

    The file is a ZIP archive with main.xml, a binary block of heights and, optionally, a block that marks the
    valid points. A height is Offset + Increment times the stored number, after the schema of openGPS. The
    schema requires the increment for integers only. For floats the increment is 1 by default, and is applied
    if the file has one, as SurfaceTopography does. Each valid point is one bit, in the order of the heights
    and with the lowest bit of a byte first.

    Returns heights and spacings [m]. Raises InputError if the file is broken, or has other data than heights
    over a regular grid.
    """
    try:
        archive = opened(content)
        root = ElementTree.fromstring(member(archive, content, "main.xml", _MOST_XML))
    except InputError as error:
        raise error.under(str(path)) from None
    except BROKEN:
        raise InputError(path, "is not a complete X3P file") from None
    _check_axes(path, root)
    columns, rows, layers = (_whole(path, root, f"MatrixDimension/Size{axis}") for axis in "XYZ")
    if layers != 1:
        raise InputError(path, f"has {layers} heights at each point", takes="one")
    kind = np.dtype(_KINDS[_text(root, "CZ/DataType")])
    points = rows * columns
    _check_size(path, (rows, columns), kind.itemsize + _POINT)
    data = _binary_block(path, archive, content, root, "PointDataLink", points * kind.itemsize)
    assert data is not None
    increment = _number(path, root, "CZ/Increment", None if kind.kind == "i" else 1.0)
    if increment <= 0.0:
        raise InputError(path, f"the increment of its heights is {increment:g}", takes="a positive one")
    # NaN and infinite numbers become voids.
    with np.errstate(all="ignore"):
        # In place: each copy of a large map takes as much memory again.
        heights = np.frombuffer(data, kind).astype(float)
        heights *= increment
        heights += _number(path, root, "CZ/Offset", 0.0)
    heights[~np.isfinite(heights)] = np.nan
    del data
    mask = _binary_block(path, archive, content, root, "ValidPointsLink", -(-points // 8))
    if mask is not None:
        bits = np.unpackbits(np.frombuffer(mask, np.uint8), count=points, bitorder="little")
        heights[bits == 0] = np.nan
    dx = _number(path, root, "CX/Increment", None)
    # A single row has no neighbour, even if the file states a distance between rows.
    dy = None if rows == 1 else _number(path, root, "CY/Increment", None)
    return heights.reshape(rows, columns), dx, dy


def _check_size(path: Path, shape: tuple[int, ...], each: int = 0) -> None:
    """Raise an InputError if a map has too many points, or too little memory for ``each`` [bytes]."""
    stated = f"says it has {' x '.join(map(str, shape))} points"
    if math.prod(shape) > MOST_POINTS:
        raise InputError(path, stated, takes=f"at most {MOST_POINTS}")
    check_memory_for(path, math.prod(shape) * each, stated)


def _text(root: ElementTree.Element, place: str) -> str:
    return (root.findtext(f".//{place}") or "").strip()


def _check_axes(path: Path, root: ElementTree.Element) -> None:
    """Raise an error unless the file has stored heights over equally spaced positions."""
    kind = _text(root, "FeatureType")
    if kind not in ("", "SUR", "PRF"):
        raise InputError(path, f"is of the type {shown(kind)}", takes="a surface, SUR, or a profile, PRF")
    for axis, wanted in (("CX", "I"), ("CY", "I"), ("CZ", "A")):
        actual = _text(root, f"{axis}/AxisType")
        if actual != wanted and not (axis == "CY" and not actual):
            what = "equally spaced positions" if wanted == "I" else "heights as stored"
            raise InputError(path, f"its axis {axis} is of type {shown(actual)}", takes=f"{wanted!r}, {what}")
    if _text(root, "CZ/DataType") not in _KINDS:
        data_type = shown(_text(root, "CZ/DataType"))
        raise InputError(path, f"its heights are of type {data_type}", takes=f"one of {', '.join(_KINDS)}")


def _whole(path: Path, root: ElementTree.Element, place: str) -> int:
    text = _text(root, place)
    try:
        number = int(text)
    except ValueError:
        number = 0
    if not 1 <= number <= MOST_POINTS:
        raise InputError(
            path, f"its {place} is {shown(text)}", takes=f"a whole number from 1 to {MOST_POINTS}"
        )
    return number


def _number(path: Path, root: ElementTree.Element, place: str, default: float | None) -> float:
    """Finite number at a place of the description, or ``default`` where the description has none."""
    text = _text(root, place)
    if not text and default is not None:
        return default
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise InputError(path, f"its {place} is {shown(text)}", takes="a number")
    return number


def _binary_block(
    path: Path, archive: zipfile.ZipFile, content: bytes, root: ElementTree.Element, link: str, size: int
) -> bytes | None:
    """Binary block of the archive of ``size`` bytes; None if the file has no mask of valid points."""
    name = _text(root, link)
    if not name and link == "ValidPointsLink":
        return None
    try:
        held = archive.getinfo(name).file_size
        data = member(archive, content, name, size) if held == size else b""
    except InputError as error:
        raise InputError(path, f"{shown(name)} {error.text}") from None
    except BROKEN:
        raise InputError(path, f"its {link} is {shown(name)}, which cannot be read from it") from None
    if held != size:
        raise InputError(path, f"{shown(name)} has {held} bytes", takes=f"{size} for the size of the map")
    return data


def read_al3d(path: Path, content: bytes) -> HeightMap:
    """Read the height map in an AL3D file of Alicona.

    The header consists of tags of 52 bytes, with 20 bytes for the name and 30 for the value. A block of
    float32 heights follows.

    Returns heights and spacings [m]. Raises InputError if the header is incomplete, or the file is shorter
    than its header states.
    """
    if not content.startswith(b"AliconaImaging"):
        raise InputError(path, "is not an AL3D file")
    tags = _al3d_tags(content)
    try:
        columns, rows, offset = (int(tags[name]) for name in ("Cols", "Rows", "DepthImageOffset"))
        dx, dy = float(tags["PixelSizeXMeter"]), float(tags["PixelSizeYMeter"])
        void = float(tags.get("InvalidPixelValue", "nan"))
    except (KeyError, ValueError):
        raise InputError(path, "its header lacks a size, a spacing or an offset") from None
    if min(columns, rows) < 1 or offset < 1:
        raise InputError(
            path, f"says it has {rows} x {columns} points at the byte {offset}", takes="positive numbers"
        )
    _check_size(path, (rows, columns))
    # Rows are padded to eight bytes.
    stride = -(-columns * 4 // 8) * 8
    if offset + stride * rows > len(content):
        raise InputError(
            path, f"is {len(content)} bytes long", takes=f"{offset + stride * rows} for its header"
        )
    _check_size(path, (rows, columns), 2 * _POINT)
    block = np.frombuffer(content, "<f4", stride // 4 * rows, offset).reshape(rows, stride // 4)
    # NaN and infinite numbers become voids.
    with np.errstate(all="ignore"):
        heights = block[:, :columns].astype(float)
        heights[np.isclose(heights, void, rtol=1e-6, atol=0.0) | ~np.isfinite(heights)] = np.nan
    return heights, dx, None if rows == 1 else dy


def _al3d_tags(content: bytes) -> dict[str, str]:
    tags: dict[str, str] = {}
    for start in range(17, min(len(content), 17 + 52 * 200), 52):
        name = content[start : start + 20].split(b"\0")[0].decode("latin-1").strip()
        value = content[start + 20 : start + 50].split(b"\0")[0].decode("latin-1").strip()
        if not name:
            break
        tags.setdefault(name, value)
    return tags


# Largest credible slope between neighbours: no instrument measures a flank steeper than 5 (79 degrees).
STEEPEST = 5.0

# Largest fraction of a line or map that may be void; the voids are then filled.
MOST_VOID = 0.2

# Largest number of points of a map that is processed: every processing step keeps a copy of the map.
MOST_MAP_POINTS = 20_000_000

# Largest size of a file [bytes]: of text, some four million points of a profile; of another, a map of
# ``instrument_files.MOST_POINTS`` points in double precision, with its image.
MOST_TEXT, MOST_BINARY = 100_000_000, 1_000_000_000

# Memory of the reader of text / size of the file, as measured.
_TEXT_COPIES = 30.0

# Fraction of the slopes of a map that may exceed STEEPEST, for a few pixels of dust or noise.
_MOST_STEEP = 0.01

# Smallest and largest spacing of the points of a measured surface, and its largest height [m].
FINEST, COARSEST = 1e-12, 1e-3
_HIGHEST = 10.0


# First bytes of a workbook and a name in it: Excel since 2007, OpenDocument, and older Excel files
# with the name in UTF-16.
_WORKBOOKS = (
    (b"PK\x03\x04", b"xl/workbook."),
    (b"PK\x03\x04", b"opendocument.spreadsheet"),
    (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1", "Workbook".encode("utf-16-le")),
)


@dataclass(frozen=True)
class Surface:
    """Measured surface as read from a file. A profile is a surface with one row."""

    heights: Array  # heights [m], NaN at points without data, shape (rows, columns)
    spacing_x: float  # distance between neighbouring points of a row [m]
    spacing_y: float | None  # distance between neighbouring rows [m]; None for a profile
    source: str
    warnings: tuple[ResultWarning, ...] = ()  # warnings about the data in the file

    @property
    def voids(self) -> float:
        """Fraction of the points without data."""
        return float(np.mean(np.isnan(self.heights)))

    def line_voids(self, index: int = 0, *, along: str = "row") -> float:
        """Fraction of the points without data in one line: row or column number ``index``, from 0."""
        lines = self.heights if along == "row" else self.heights.T
        return float(np.mean(np.isnan(lines[index])))

    @property
    def height_step(self) -> float | None:
        """Step in which the heights are stored [m].

        It is None if no step is visible, as the number of distinct heights exceeds half the number of points.
        """
        levels = np.unique(self.heights[np.isfinite(self.heights)])
        if levels.size < 2 or levels.size > 0.5 * self.heights.size:
            return None
        return float(np.median(np.diff(levels)))

    def line(self, index: int = 0, *, along: str = "row") -> Profile:
        """One line of the surface as a profile, with voids filled by linear interpolation.

        Raises an InputError if the surface has no such line, or too much of the line is void.
        """
        lines, spacing = self.heights, self.spacing_x
        if along == "column":
            if self.spacing_y is None:
                raise InputError(self.source, "is a profile and has no columns", takes="along = 'row'")
            lines, spacing = self.heights.T, self.spacing_y
        if not 0 <= index < lines.shape[0]:
            raise InputError("line", got=index, takes=f"a {along} from 0 to {lines.shape[0] - 1}")
        z = lines[index]
        there = np.isfinite(z)
        if np.mean(~there) > MOST_VOID or there.sum() < LEAST_POINTS:
            raise InputError(
                self.source,
                f"{along} {index} has data at {there.sum()} of {z.size} points",
                takes=f"a line with at least {LEAST_POINTS} and {100 * (1 - MOST_VOID):.0f} %",
            )
        x = np.arange(z.size)
        # Voids at the ends cannot be interpolated; they are left out.
        first, last = x[there][[0, -1]]
        whole = np.interp(x, x[there], z[there])[first : last + 1]
        return _checked(Profile(spacing, whole), self.source)

    def map(self, *, along: str = "row") -> Map:
        """Whole surface as a map, with voids filled by a harmonic function.

        Outer rows and columns that have no data at all are left out. Raises an InputError if the surface is a
        profile, has too many points, or too much of it is void.
        """
        if self.spacing_y is None:
            raise InputError(self.source, "is a profile", takes="a map of several rows")
        if self.heights.size > MOST_MAP_POINTS:
            raise InputError(
                self.source,
                f"has {self.heights.size:.3g} points",
                takes=f"a map of at most {MOST_MAP_POINTS:.0e}; cut it where it was measured, or take a "
                "line of it",
            )
        rows = without_void_borders(self.heights)
        there = int(np.isfinite(rows).sum())
        if min(rows.shape) < LEAST_POINTS or there < (1.0 - MOST_VOID) * rows.size:
            raise InputError(
                self.source,
                f"has data at {there} of {rows.shape[0]} x {rows.shape[1]} points",
                takes=f"a map with at least {LEAST_POINTS} each way and {100 * (1 - MOST_VOID):.0f} %",
            )
        if along == "row":
            dx, dy, heights = self.spacing_x, self.spacing_y, rows.T
        else:
            dx, dy, heights = self.spacing_y, self.spacing_x, rows[:, ::-1]
        return _checked_map(Map(dx, dy, filled(np.ascontiguousarray(heights), dx, dy)), self.source)


def _checked(profile: Profile, source: str) -> Profile:
    """Return the profile; raise an error if its heights are not credible for a surface."""
    slope = float(np.max(np.abs(np.diff(profile.heights)))) / profile.spacing
    if slope > STEEPEST:
        raise InputError(
            source,
            f"the largest slope between neighbours is {slope:.3g}",
            takes=f"one up to {STEEPEST:g}; are x_unit and z_unit right?",
        )
    _check_range("line", profile.length, profile.heights, source, "x_unit and z_unit")
    return profile


def _checked_map(surface: Map, source: str) -> Map:
    """Return the map; raise an error if its heights are not credible for a surface."""
    z = surface.heights
    slopes = [np.abs(np.diff(z, axis=0)) / surface.spacing_x, np.abs(np.diff(z, axis=1)) / surface.spacing_y]
    steep = max(float(np.mean(slope > STEEPEST)) for slope in slopes)
    if steep > _MOST_STEEP:
        raise InputError(
            source,
            f"{100 * steep:.2g} % of the slopes between neighbours are above {STEEPEST:g}",
            takes=f"a map with up to {100 * _MOST_STEEP:g} %; are its units right?",
        )
    _check_range("map", max(surface.length_x, surface.length_y), z, source, "its units")
    return surface


def _check_range(name: str, length: float, heights: Array, source: str, units: str) -> None:
    """Raise an InputError if heights [m] range over more than the ``length`` of their line or map [m]."""
    height = float(np.ptp(heights))
    if height > length:
        raise InputError(
            source,
            f"the heights range over {height:.3g} m, the {name} over {length:.3g} m",
            takes=f"a surface, whose heights range over less than its length; are {units} right?",
        )


def read_surface(path: str | Path, *, x_unit: str | None = None, z_unit: str | None = None) -> Surface:
    """Read a measured surface from a file: heights [m], spacings [m] and warnings.

    Raises an InputError if the file cannot be read, or its data are not credible for a surface.
    """
    path = Path(path)
    content = _content(path)
    if any(content.startswith(magic) and mark in content for magic, mark in _WORKBOOKS):
        raise InputError(path, "is a workbook of a spreadsheet program; save the sheet as CSV")
    suffix = path.suffix.lower()
    if suffix == ".x3p" or content.startswith(b"PK\x03\x04"):
        surface = _of_map(path, read_x3p(path, content), x_unit, z_unit)
    elif suffix == ".al3d" or content.startswith(b"AliconaImaging"):
        surface = _of_map(path, read_al3d(path, content), x_unit, z_unit)
    elif is_text(content):
        surface = _of_text(path, content, x_unit, z_unit)
    else:
        surface = _of_map(path, _read_other(path), x_unit, z_unit)
    _check_scale(surface)
    return surface


def _of_text(path: Path, content: bytes, x_unit: str | None, z_unit: str | None) -> Surface:
    """Surface of a text: a profile, or another format that the package SurfaceTopography reads."""
    try:
        text = read_text(path, content, x_unit, z_unit)
    except NoProfileError as error:
        return _of_map(path, _read_other(path, error.text), x_unit, z_unit)
    return Surface(text.heights[np.newaxis], text.spacing, None, str(path), text.warnings)


def _of_map(path: Path, heights: HeightMap, x_unit: str | None, z_unit: str | None) -> Surface:
    """Surface of a height map, whose file has units of its own. Raises InputError if a unit is given."""
    for name, unit in (("x_unit", x_unit), ("z_unit", z_unit)):
        if unit is not None:
            raise InputError(name, got=f"{unit!r}, but {path} is in a format that has its own unit")
    return Surface(*heights, str(path))


def _content(path: Path) -> bytes:
    """Content of a file of a bounded size that its reader can keep in memory."""
    with regular(path) as file:
        text = is_text(file.read(4096))
    most, copies = (MOST_TEXT, _TEXT_COPIES) if text else (MOST_BINARY, 1.0)
    return read_bytes(path, most=most, copies=copies)


def _check_scale(surface: Surface) -> None:
    for axis, spacing in (("x", surface.spacing_x), ("y", surface.spacing_y)):
        if spacing is not None and not FINEST <= spacing <= COARSEST:
            raise InputError(
                surface.source,
                f"its points are {spacing:.3g} m apart along {axis}",
                takes=f"{FINEST:g} to {COARSEST:g} m; is the unit right?",
            )
    there = ~np.isnan(surface.heights)
    highest = max(
        np.max(surface.heights, initial=0.0, where=there), -np.min(surface.heights, initial=0.0, where=there)
    )
    if highest > _HIGHEST:
        raise InputError(
            surface.source,
            f"holds heights of {highest:.3g} m",
            takes=f"up to {_HIGHEST:g} m; is the unit right?",
        )


def _read_other(path: Path, otherwise: str = "is no text profile, X3P or AL3D") -> HeightMap:
    """Heights and spacings of a file in a format that the package SurfaceTopography reads.

    ``otherwise`` says why the readers of this package do not read it.
    """
    try:
        from SurfaceTopography import open_topography  # type: ignore[import-not-found]
    except ImportError:
        text = f"{otherwise}; other formats take the extra ehlectric[instruments]"
        raise InputError(path, text) from None
    try:
        reader = open_topography(str(path))
        # The sizes in the header are known before the heights are read.
        _check_size(path, (math.prod(reader.channels[0].nb_grid_pts or ()),))
        topography = reader.topography().to_unit("m")
        heights: Array = np.ma.filled(np.ma.asarray(topography.heights(), dtype=float), np.nan)
        spacing = np.atleast_1d(topography.pixel_size)
    except (InputError, MemoryError):
        raise
    except Exception as error:  # the readers of forty formats raise exceptions of any kind
        text = f"{otherwise}; it cannot be read by SurfaceTopography either, {str(error)[:80]}"
        raise InputError(path, text) from None
    if heights.ndim == 1:
        return heights[np.newaxis], float(spacing[0]), None
    return heights.T, float(spacing[0]), float(spacing[1])
