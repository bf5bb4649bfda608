"""Reader of binary height maps from instruments: ISO 25178-72 X3P and Alicona AL3D.

The content of a file is not trusted: every size is checked before a block of this size is read.
"""

from __future__ import annotations

import zipfile
from pathlib import Path
from typing import TypeAlias
from xml.etree import ElementTree

import numpy as np

from ehlectric.arrays import Array
from ehlectric.errors import InputError, shown
from ehlectric.runtime.sizes import check_memory_for
from ehlectric.surfaces.archives import BROKEN, member, opened

# Largest number of points of a map, and largest size of its XML description [bytes].
MOST_POINTS = 100_000_000
_MOST_XML = 2_000_000

# Heights (rows, columns) [m] with NaN at points without data, distance between neighbours in a row [m], and
# distance between rows [m], None for a single row.
HeightMap: TypeAlias = tuple[Array, float, float | None]

# Exceptions of the readers of archives and of XML for invalid content.
_BROKEN = (*BROKEN, ElementTree.ParseError)

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

    Parameters
    ----------
    path : Path
        Path of the file, for error messages.
    content : bytes
        Content of the file.

    Returns
    -------
    HeightMap
        Heights and spacings [m].

    Raises
    ------
    InputError
        If the file is broken, or has other data than heights over a regular grid.
    """
    try:
        archive = opened(content)
        root = ElementTree.fromstring(member(archive, content, "main.xml", _MOST_XML))
    except InputError as error:
        raise error.under(str(path)) from None
    except _BROKEN:
        raise InputError(path, "is not a complete X3P file") from None
    _check_axes(path, root)
    columns, rows, layers = (_whole(path, root, f"MatrixDimension/Size{axis}") for axis in "XYZ")
    if layers != 1:
        raise InputError(path, f"has {layers} heights at each point", takes="one")
    if columns * rows > MOST_POINTS:
        raise InputError(path, f"says it has {rows} x {columns} points", takes=f"at most {MOST_POINTS}")
    kind = np.dtype(_KINDS[_text(root, "CZ/DataType")])
    points = rows * columns
    needed = points * (kind.itemsize + _POINT)
    check_memory_for(path, needed, f"says it has {rows} x {columns} points")
    data = _block(path, archive, content, root, "PointDataLink", points * kind.itemsize)
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
    mask = _block(path, archive, content, root, "ValidPointsLink", -(-points // 8))
    if mask is not None:
        bits = np.unpackbits(np.frombuffer(mask, np.uint8), count=points, bitorder="little")
        heights[bits == 0] = np.nan
    dx = _number(path, root, "CX/Increment", None)
    # A single row has no neighbour, even if the file states a distance between rows.
    dy = None if rows == 1 else _number(path, root, "CY/Increment", None)
    return heights.reshape(rows, columns), dx, dy


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
    try:
        number = int(_text(root, place))
        if not 1 <= number <= MOST_POINTS:
            raise ValueError
    except ValueError:
        raise InputError(
            path,
            f"its {place} is {shown(_text(root, place))}",
            takes=f"a whole number from 1 to {MOST_POINTS}",
        ) from None
    return number


def _number(path: Path, root: ElementTree.Element, place: str, default: float | None) -> float:
    """Finite number at a place of the description, or ``default`` where the description has none."""
    text = _text(root, place)
    if not text and default is not None:
        return default
    try:
        number = float(text)
        if not np.isfinite(number):
            raise ValueError
    except ValueError:
        raise InputError(path, f"its {place} is {shown(text)}", takes="a number") from None
    return number


def _block(
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
    except _BROKEN:
        raise InputError(path, f"its {link} is {shown(name)}, which cannot be read from it") from None
    if held != size:
        raise InputError(path, f"{shown(name)} has {held} bytes", takes=f"{size} for the size of the map")
    return data


def read_al3d(path: Path, content: bytes) -> HeightMap:
    """Read the height map in an AL3D file of Alicona.

    The header consists of tags of 52 bytes, with 20 bytes for the name and 30 for the value. A block of
    float32 heights follows.

    Parameters
    ----------
    path : Path
        Path of the file, for error messages.
    content : bytes
        Content of the file.

    Returns
    -------
    HeightMap
        Heights and spacings [m].

    Raises
    ------
    InputError
        If the header is incomplete, or the file is shorter than its header states.
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
    if columns * rows > MOST_POINTS:
        raise InputError(path, f"says it has {rows} x {columns} points", takes=f"at most {MOST_POINTS}")
    # Rows are padded to eight bytes.
    stride = -(-columns * 4 // 8) * 8
    if offset + stride * rows > len(content):
        raise InputError(
            path, f"is {len(content)} bytes long", takes=f"{offset + stride * rows} for its header"
        )
    check_memory_for(path, columns * rows * 2 * _POINT, f"says it has {rows} x {columns} points")
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
