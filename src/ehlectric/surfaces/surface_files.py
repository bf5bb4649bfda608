"""Readers of measured surfaces: text, ISO 25178-72 X3P, Alicona AL3D and arrays of NumPy.

The content of a file is not trusted: every size is checked before a block of this size is read, and members
of ZIP archives are decompressed no further than the size that is expected. Doubtful data are refused with an
error that names the fault, such as spacings that are not uniform, slopes that are too large for the spacing,
and lines without data. Other formats are read by the package SurfaceTopography if it is installed.
"""

from __future__ import annotations

import bz2
import io
import lzma
import math
import struct
import warnings
import zipfile
import zlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from types import MappingProxyType
from typing import NamedTuple
from xml.etree import ElementTree

import numpy as np

from ehlectric.arrays import Array
from ehlectric.errors import InputError, short, shown
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.runtime.file_kinds import is_workbook, not_text
from ehlectric.runtime.memory import in_bytes
from ehlectric.runtime.reading import read_bytes, regular
from ehlectric.runtime.sizes import check_memory_for
from ehlectric.runtime.text_table import UTF_16, NoTableError, is_text
from ehlectric.surfaces.maps import Map, filled, without_void_borders
from ehlectric.surfaces.profiles import LEAST_POINTS, Profile, rms
from ehlectric.surfaces.text_maps import read_text
from ehlectric.surfaces.text_profiles import Scale, factor_of
from ehlectric.surfaces.void_numbers import refuse_void_numbers, without_void_numbers

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
# Measured heights become at most about ten times smaller.
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
            f"expected at most {in_bytes(allowed)}, because measured heights compress little",
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


# Largest number of points of a map.
MOST_POINTS = 100_000_000

# Name of the XML description of X3P, its largest size without and with a list of heights [bytes], and memory
# of the parsed description / its size, as measured.
_MAIN = "main.xml"
_MOST_XML, _MOST_LIST = 2_000_000, 200_000_000
_XML_COPIES = 10.0


class HeightMap(NamedTuple):
    """Heights on a regular grid, as read from a file."""

    heights: Array  # heights [m], NaN at points without data, shape (rows, columns)
    spacing_x: float  # distance between neighbouring points of a row [m]
    spacing_y: float | None  # distance between neighbouring rows [m]; None for a single row
    warnings: tuple[ResultWarning, ...] = ()  # warnings about the data in the file


# Memory of each point while a map is read [bytes]: its height, and whether it is valid.
_POINT = 10

_KINDS = {"D": "<f8", "F": "<f4", "L": "<i4", "I": "<i2"}


def read_x3p(path: Path, content: bytes) -> HeightMap:
    """Read the height map in an X3P file (ISO 25178-72).

    The file is a ZIP archive with main.xml, which may be in a folder. The heights are in a binary block, or
    in main.xml as a list. An optional block marks the valid points: each valid point is one bit, in the
    order of the heights and with the lowest bit of a byte first. An empty item of a list is a point without
    data.

    The height is Offset + Increment times the stored number if the stored numbers are integers, and Offset +
    the stored number [m] if they are floats. The schema of openGPS, iso5436_2.xsd, defines the increment for
    "incremental axis and integer data types". The library of openGPS, ``ConvertPointToCoord``, and x3ptools
    add no increment to floats either. A warning names an increment of floats that is not 1.

    Returns heights and spacings [m]. Raises InputError if the file is broken, or has other data than heights
    over a regular grid.
    """
    try:
        archive = opened(content)
        main = _main_of(archive)
        root = ElementTree.fromstring(member(archive, content, main, _most_xml(path, archive, main)))
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
    increment, unused = _increment(path, root, whole=kind.kind == "i")
    items = root.findall(".//DataList/Datum")
    if items and not _text(root, "PointDataLink"):
        heights = _listed(path, items, columns, points)
    else:
        data = _binary_block(path, archive, content, root, "PointDataLink", points * kind.itemsize)
        assert data is not None
        # NaN and infinite numbers become voids.
        with np.errstate(all="ignore"):
            heights = np.frombuffer(data, kind).astype(float)
        del data
    heights, marked = without_void_numbers(path, heights)
    with np.errstate(all="ignore"):
        # In place: each copy of a large map takes as much memory again.
        heights *= increment
        heights += _number(path, root, "CZ/Offset", 0.0)
    heights[~np.isfinite(heights)] = np.nan
    mask = _binary_block(path, archive, content, root, "ValidPointsLink", -(-points // 8))
    if mask is not None:
        bits = np.unpackbits(np.frombuffer(mask, np.uint8), count=points, bitorder="little")
        heights[bits == 0] = np.nan
    dx = _number(path, root, "CX/Increment", None)
    if unused:
        _check_floats(path, heights, abs(dx) * max(rows, columns), root)
    # A single row has no neighbour, even if the file states a distance between rows.
    dy = None if rows == 1 else _number(path, root, "CY/Increment", None)
    return HeightMap(heights.reshape(rows, columns), dx, dy, (*unused, *marked))


def _main_of(archive: zipfile.ZipFile) -> str:
    """Name of the XML description in an archive, which may be in a folder. Raises KeyError without one."""
    names = [name for name in archive.namelist() if _plain(name).rpartition("/")[2] == _MAIN]
    if not names:
        raise KeyError(_MAIN)
    return min(names, key=lambda name: (_plain(name).count("/"), name))


def _plain(name: str) -> str:
    """Name of a member with slashes and small letters, without a dot or slash at its start."""
    return name.replace("\\", "/").removeprefix("./").lstrip("/").lower()


def _most_xml(path: Path, archive: zipfile.ZipFile, main: str) -> int:
    """Largest size of the XML description that is read [bytes], as a list of heights may be in it.

    Raises an InputError if the memory for a larger description is too small.
    """
    size = archive.getinfo(main).file_size
    if size > _MOST_XML:
        check_memory_for(path, size * _XML_COPIES, f"says it has {in_bytes(size)} of XML")
    return _MOST_LIST


def _increment(
    path: Path, root: ElementTree.Element, *, whole: bool
) -> tuple[float, tuple[ResultWarning, ...]]:
    """Factor of the stored heights [m], and a warning about an increment that floats do not use."""
    increment = _number(path, root, "CZ/Increment", None if whole else 1.0)
    if increment <= 0.0:
        raise InputError(path, f"the increment of its heights is {increment:g}", takes="a positive one")
    if whole or increment == 1.0:
        return increment, ()
    return 1.0, (ResultWarning.of("increment-unused", file=path, increment=increment),)


def _check_floats(path: Path, heights: Array, length: float, root: ElementTree.Element) -> None:
    """Raise an InputError if heights as floats, whose increment is not used, are larger than the map [m]."""
    there = np.isfinite(heights)
    if not there.any() or float(np.ptp(heights[there])) <= length:
        return
    increment = shown(_text(root, "CZ/Increment"))
    raise InputError(
        path,
        f"contains floats up to {np.max(np.abs(heights[there])):.3g} and an increment of {increment}, "
        "which ISO 25178-72 defines for integers only",
        takes="floats in metres, or integers with an increment",
    )


def _listed(path: Path, items: list[ElementTree.Element], columns: int, points: int) -> Array:
    """Stored heights of a list, in its order; NaN for an empty item.

    An item is the height, or column, row and height between semicolons.
    """
    if len(items) != points:
        raise InputError(path, f"lists {len(items)} heights", takes=f"{points} for the size of the map")
    heights = np.empty(points)
    for place, item in enumerate(items):
        text = (item.text or "").strip()
        *position, height = text.split(";")
        try:
            if position and [float(each) for each in position] != [place % columns, place // columns]:
                raise ValueError(text)
            heights[place] = float(height) if text else np.nan
        except ValueError:
            takes = "a number, or column;row;number in the order of the rows"
            raise InputError(path, f"item {place + 1} of its list is {shown(text)}", takes=takes) from None
    return heights


def _check_size(path: Path, shape: tuple[int, ...], each: int = 0) -> None:
    """Raise an InputError if a map has too many points, or too little memory for ``each`` [bytes]."""
    stated = f"says it has {' x '.join(map(str, shape))} points"
    if math.prod(shape) > MOST_POINTS:
        raise InputError(path, stated, takes=f"at most {MOST_POINTS}")
    check_memory_for(path, math.prod(shape) * each, stated)


def _text(root: ElementTree.Element, place: str) -> str:
    return (root.findtext(f".//{place}") or "").strip()


def _check_axes(path: Path, root: ElementTree.Element) -> None:
    """Raise an error unless the file stores heights at equally spaced positions."""
    kind = _text(root, "FeatureType")
    if kind not in ("", "SUR", "PRF"):
        raise InputError(path, f"is of the type {shown(kind)}", takes="a surface, SUR, or a profile, PRF")
    for axis, expected in (("CX", "I"), ("CY", "I"), ("CZ", "A")):
        actual = _text(root, f"{axis}/AxisType")
        if actual != expected and not (axis == "CY" and not actual):
            what = "equally spaced positions" if expected == "I" else "heights as stored"
            raise InputError(
                path, f"its axis {axis} is of type {shown(actual)}", takes=f"{expected!r}, {what}"
            )
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
        place = _place(archive, name)
        held = archive.getinfo(place).file_size
        data = member(archive, content, place, size) if held == size else b""
    except InputError as error:
        raise InputError(path, f"{shown(name)} {error.text}") from None
    except BROKEN:
        raise InputError(path, f"its {link} is {shown(name)}, which cannot be read from it") from None
    if held != size:
        raise InputError(path, f"{shown(name)} has {held} bytes", takes=f"{size} for the size of the map")
    return data


def _place(archive: zipfile.ZipFile, link: str) -> str:
    """Name of the member to which a link of the description refers, relative to the folder of main.xml."""
    folder = _plain(_main_of(archive)).removesuffix(_MAIN)
    names = {_plain(name): name for name in archive.namelist()}
    return names.get(folder + _plain(link)) or names[_plain(link)]


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
    return HeightMap(heights, dx, None if rows == 1 else dy)


def _al3d_tags(content: bytes) -> dict[str, str]:
    tags: dict[str, str] = {}
    for start in range(17, min(len(content), 17 + 52 * 200), 52):
        name = content[start : start + 20].split(b"\0")[0].decode("latin-1").strip()
        value = content[start + 20 : start + 50].split(b"\0")[0].decode("latin-1").strip()
        if not name:
            break
        tags.setdefault(name, value)
    return tags


# First bytes of an array of NumPy.
_NPY = b"\x93NUMPY"


def read_npy(path: Path, content: bytes, scale: Scale) -> HeightMap:
    """Read the heights of a profile (n,) or a map (rows, columns) in an .npy file of NumPy.

    The file contains no spacing and no unit: ``scale`` has both. Returns heights and spacings [m]. Raises
    InputError if the file is broken or contains other data than real numbers, or if the spacing or the unit
    is missing.
    """
    file = io.BytesIO(content)
    try:
        version = np.lib.format.read_magic(file)
        header = {(1, 0): np.lib.format.read_array_header_1_0}.get(
            version, np.lib.format.read_array_header_2_0
        )
        shape, _, kind = header(file)
    except BROKEN:
        raise InputError(path, "is not a complete array of NumPy") from None
    if kind.kind not in "fiu" or len(shape) not in (1, 2) or 0 in shape:
        got = f"contains an array of shape {shape} and type {kind}"
        raise InputError(path, got, takes="real numbers of the shape (n,) or (rows, columns)")
    _check_size(path, shape, kind.itemsize + _POINT)
    size = math.prod(shape) * kind.itemsize
    if len(content) - file.tell() != size:
        raise InputError(
            path, f"has {len(content) - file.tell()} bytes of numbers", takes=f"{size} for its shape"
        )
    if scale.spacing is None:
        raise InputError.worded("spacing", f"missing; {path} contains no positions")
    scale.refuse_x_unit(path)
    with np.errstate(all="ignore"):
        heights, marked = without_void_numbers(
            path, np.load(io.BytesIO(content), allow_pickle=False).astype(float)
        )
        heights *= factor_of(path, "z_unit", scale.z_unit, None)
    heights[~np.isfinite(heights)] = np.nan
    if heights.ndim == 1 or 1 in shape:
        return HeightMap(heights.reshape(1, -1), scale.spacing, None, marked)
    return HeightMap(heights, scale.spacing, scale.spacing_y or scale.spacing, marked)


# Largest credible slope between neighbours: no instrument measures a flank steeper than 5 (79 degrees).
STEEPEST = 5.0

# Smallest credible root-mean-square height of a surface, a tenth of an atom, and a usual value [m].
SMOOTHEST, _USUAL = 1e-11, 1e-7

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


# First bytes of a ZIP archive.
_ZIP = b"PK\x03\x04"


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
        # Voids at the ends cannot be interpolated; they are removed.
        first, last = x[there][[0, -1]]
        whole = np.interp(x, x[there], z[there])[first : last + 1]
        return _checked(Profile(spacing, whole), self.source)

    def map(self, *, along: str = "row") -> Map:
        """Whole surface as a map, with voids filled by a harmonic function.

        Outer rows and columns that have no data at all are removed. Raises an InputError if the surface is a
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
    _refuse_flat("line", profile.heights, source)
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
    _refuse_flat("map", z, source)
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


def _refuse_flat(name: str, heights: Array, source: str) -> None:
    """Raise an InputError if the heights of a line or map [m] are equal, or differ by less than atoms."""
    if np.ptp(heights) == 0.0:
        got = f"is constant, all {heights.size} heights of the {name} are {heights.flat[0]:g} m"
        raise InputError(source, got, takes="heights that differ; is this line or channel the right one?")
    deviation = rms(heights)
    if deviation < SMOOTHEST:
        factor = 1000.0 ** round(math.log(_USUAL / deviation, 1000.0))
        raise InputError(
            source,
            f"the heights of the {name} have a root mean square of {deviation:.3g} m",
            takes=f"at least {SMOOTHEST:g} m; is their unit {factor:g} times larger, for "
            f"{deviation * factor * 1e9:.3g} nm?",
        )


def _check_range(name: str, length: float, heights: Array, source: str, units: str) -> None:
    """Raise an InputError if heights [m] range over more than the ``length`` of their line or map [m]."""
    height = float(np.ptp(heights))
    if height > length:
        raise InputError(
            source,
            f"the heights range over {height:.3g} m, the {name} over {length:.3g} m",
            takes=f"a surface, whose heights range over less than its length; are {units} right?",
        )


def read_surface(
    path: str | Path,
    *,
    x_unit: str | None = None,
    z_unit: str | None = None,
    spacing: float | None = None,
    spacing_y: float | None = None,
) -> Surface:
    """Read a measured surface from a file: heights [m], spacings [m] and warnings.

    Parameters
    ----------
    path : str or Path
        File of an instrument.
    x_unit, z_unit : str, optional
        Units of positions and heights, for a file that does not state them.
    spacing, spacing_y : float, optional
        Distance between neighbouring points of a row, and between rows [m], for a file without positions.
        ``spacing_y`` equals ``spacing`` by default.

    Returns
    -------
    Surface
        Heights and spacings in metres.

    Raises
    ------
    InputError
        If the file cannot be read, its data are not credible for a surface, or it states what is given.
    """
    path, scale = Path(path), Scale(x_unit, z_unit, spacing, spacing_y)
    content = _content(path)
    if is_workbook(content):
        raise InputError(path, not_text(content))
    suffix = path.suffix.lower()
    if suffix == ".x3p" or _is_x3p(content):
        surface = _of_map(path, read_x3p(path, content), scale)
    elif suffix == ".al3d" or content.startswith(b"AliconaImaging"):
        surface = _of_map(path, read_al3d(path, content), scale)
    elif content.startswith(_NPY):
        surface = _surface(path, read_npy(path, content, scale))
    elif _is_text(content):
        surface = _of_text(path, content, scale)
    else:
        surface = _of_map(path, _read_other(path), scale)
    _check_scale(surface)
    return surface


def surface_of(heights: Array, spacing: float, spacing_y: float | None = None) -> Surface:
    """Surface of an array of heights (n,) or (rows, columns) [m], NaN at points without data.

    ``spacing_y``, distance between rows, equals ``spacing`` [m] by default. Raises an InputError if the
    heights are not credible for a surface.
    """
    rows = heights.reshape(1, -1) if heights.ndim == 1 else heights
    surface = Surface(rows, spacing, None if rows.shape[0] == 1 else spacing_y or spacing, "heights")
    _check_scale(surface)
    return surface


def _is_x3p(content: bytes) -> bool:
    """Whether a content is a ZIP archive with an XML description. Other formats are also ZIP archives."""
    if not content.startswith(_ZIP):
        return False
    try:
        return bool(_main_of(opened(content)))
    except BROKEN:
        return False


def _is_text(content: bytes) -> bool:
    """Whether the whole content is text; some formats have binary heights after a head of text."""
    return is_text(content) and (content[:2] in UTF_16 or b"\0" not in content)


def _of_text(path: Path, content: bytes, scale: Scale) -> Surface:
    """Surface of a text, or of another format that the package SurfaceTopography reads."""
    try:
        text = read_text(path, content, scale)
    except NoTableError as error:
        return _of_map(path, _read_other(path, error.text, refused=(_POINTS,)), scale)
    except InputError as error:
        # Text of another format, such as SDF, may contain more than a table.
        if path.suffix.lower() in _TEXTS or error.key in {field.name for field in fields(scale)}:
            raise
        try:
            return _of_map(path, _read_other(path, refused=(_POINTS, _MATRIX)), scale)
        except InputError:
            raise error from None
    return Surface(text.heights, text.spacing_x, text.spacing_y, str(path), text.warnings)


def _of_map(path: Path, heights: HeightMap, scale: Scale) -> Surface:
    """Surface of a height map, whose file has units of its own. Raises InputError if a unit is given."""
    for field in fields(scale):
        value = getattr(scale, field.name)
        if value is not None:
            what = "spacing" if field.name.startswith("spacing") else "unit"
            got = f"{value!r}, but {path} is in a format that has its own {what}"
            raise InputError(field.name, got=got)
    return _surface(path, heights)


def _surface(path: Path, heights: HeightMap) -> Surface:
    return Surface(heights.heights, heights.spacing_x, heights.spacing_y, str(path), heights.warnings)


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
    refuse_void_numbers(surface.source, surface.heights)


# Endings of files that contain tables and no format of their own.
_TEXTS = ("", ".csv", ".txt", ".dat", ".asc", ".hfm", ".xyz", ".tsv", ".prn", ".prf")

# Formats of points and of matrices in text, by their names in SurfaceTopography.
_POINTS, _MATRIX = "xyz", "asc"


def _read_other(
    path: Path, otherwise: str = "is no text profile, X3P or AL3D", *, refused: Sequence[str] = ()
) -> HeightMap:
    """Heights and spacings of a file in a format that the package SurfaceTopography reads.

    ``otherwise`` says why the readers of this package do not read it. ``refused`` are formats whose doubtful
    files only the readers of this package read.
    """
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            from SurfaceTopography import open_topography  # type: ignore[import-not-found,import-untyped,unused-ignore]
    except ImportError:
        text = f"{otherwise}; other formats take the extra ehlectric[instruments]"
        raise InputError(path, text) from None
    try:
        # Its readers divide by zero where a format does not fit.
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            reader = open_topography(str(path))
            if refused and reader.format() in refused:
                raise InputError(path, otherwise)
            # The sizes in the header are known before the heights are read.
            _check_size(path, (math.prod(reader.channels[0].nb_grid_pts or ()),))
            topography = reader.topography().to_unit("m")
            heights: Array = np.ma.filled(np.ma.asarray(topography.heights(), dtype=float), np.nan)
            spacing = np.atleast_1d(topography.pixel_size)
    except (InputError, MemoryError):
        raise
    except Exception as error:  # the readers of forty formats raise exceptions of any kind
        why = "" if type(error).__name__ == "CannotDetectFileFormat" else f", {short(str(error))}"
        raise InputError(path, f"{otherwise}; it cannot be read by SurfaceTopography either{why}") from None
    if heights.ndim == 1:
        return HeightMap(heights[np.newaxis], float(spacing[0]), None)
    return HeightMap(heights.T, float(spacing[0]), float(spacing[1]))
