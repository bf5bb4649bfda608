"""Measured surfaces from the files instruments write: text profiles, ISO 25178-72 X3P and Alicona AL3D.

What is doubtful is refused by name: spacings that are not uniform, slopes absurd for the spacing, lines
without data. Other formats are read by SurfaceTopography where it is installed.
"""

from __future__ import annotations

import re
import zipfile
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from ehlectric.errors import InputError
from ehlectric.quantity import to_si
from ehlectric.roughness import LEAST_POINTS, Profile
from ehlectric.typing import Array

# Largest believable slope between neighbours: beyond 5 (79 degrees) no instrument sees a flank.
STEEPEST = 5.0

# Part of a line that may be void and is then filled by straight lines.
MOST_VOID = 0.2

_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
_UNIT_WORDS = {
    "micrometre": "um",
    "micrometer": "um",
    "nanometre": "nm",
    "nanometer": "nm",
    "millimetre": "mm",
}


@dataclass(frozen=True)
class Surface:
    """Heights as read [m], rows along the first axis, NaN where the instrument saw nothing.

    A profile is a map of one row. ``spacing_x`` is the distance of neighbours in a row, ``spacing_y`` that
    of rows.
    """

    heights: Array  # (rows, columns)
    spacing_x: float
    spacing_y: float | None
    source: str

    @property
    def voids(self) -> float:
        """Part of the points without data."""
        return float(np.mean(np.isnan(self.heights)))

    @property
    def height_step(self) -> float | None:
        """Step in which the heights are stored [m], None where they are not coarse enough to show one."""
        levels = np.unique(self.heights[np.isfinite(self.heights)])
        if levels.size < 2 or levels.size > 0.5 * self.heights.size:
            return None
        return float(np.median(np.diff(levels)))

    def line(self, index: int = 0, *, along: str = "row") -> Profile:
        """One line of the surface as a profile, its voids filled by straight lines.

        Parameters
        ----------
        index : int
            Number of the row or column, from 0.
        along : str
            "row" or "column".

        Returns
        -------
        Profile
            Ready to be processed.

        Raises
        ------
        InputError
            Where there is no such line, or too much of it is void.
        """
        lines, spacing = self.heights, self.spacing_x
        if along == "column":
            if self.spacing_y is None:
                raise InputError(f"{self.source}: is a profile and has no columns, takes along = 'row'")
            lines, spacing = self.heights.T, self.spacing_y
        if not 0 <= index < lines.shape[0]:
            raise InputError(f"line: got {index}, takes a {along} from 0 to {lines.shape[0] - 1}")
        z = lines[index]
        there = np.isfinite(z)
        if np.mean(~there) > MOST_VOID or there.sum() < LEAST_POINTS:
            raise InputError(
                f"{self.source}: {along} {index} has data at {there.sum()} of {z.size} points, takes a line "
                f"with at least {LEAST_POINTS} and {100 * (1 - MOST_VOID):.0f} %"
            )
        x = np.arange(z.size)
        # Voids at the ends hold nothing to go on: they are left out.
        first, last = x[there][[0, -1]]
        filled = np.interp(x, x[there], z[there])[first : last + 1]
        return _checked(Profile(spacing, filled), self.source)


def _checked(profile: Profile, source: str) -> Profile:
    """The profile, unless its heights cannot be those of a surface."""
    slope = float(np.max(np.abs(np.diff(profile.heights)))) / profile.spacing
    if slope > STEEPEST:
        raise InputError(
            f"{source}: the largest slope between neighbours is {slope:.3g}, takes one up to {STEEPEST:g}; "
            "are x_unit and z_unit right?"
        )
    height = float(np.ptp(profile.heights))
    if height > profile.length:
        raise InputError(
            f"{source}: the heights range over {height:.3g} m, the line over {profile.length:.3g} m, takes "
            "a surface, whose heights range over less than its length; are x_unit and z_unit right?"
        )
    return profile


def read_surface(path: str | Path, *, x_unit: str | None = None, z_unit: str | None = None) -> Surface:
    """Read a measured surface.

    Parameters
    ----------
    path : str or Path
        A text profile (.csv, .txt, .asc, .dat, .hfm), .x3p or .al3d; other formats go to SurfaceTopography.
    x_unit, z_unit : str, optional
        Units of a text file that does not state them; they may not contradict it.

    Returns
    -------
    Surface
        Heights in m.

    Raises
    ------
    InputError
        Where the file cannot be read, or what it holds cannot be a surface.
    """
    path = Path(path)
    try:
        content = path.read_bytes()
    except OSError as error:
        raise InputError(f"{path}: cannot be read, {(error.strerror or str(error)).lower()}") from None
    suffix = path.suffix.lower()
    if suffix == ".x3p" or content.startswith(b"PK"):
        return _read_x3p(path)
    if suffix == ".al3d" or content.startswith(b"AliconaImaging"):
        return _read_al3d(path, content)
    if b"\0" not in content[:4096]:
        return _read_text(path, content, x_unit, z_unit)
    return _read_other(path)


def _read_text(path: Path, content: bytes, x_unit: str | None, z_unit: str | None) -> Surface:
    """Two columns, position and height, under any header; a third column of 0 and 1 tells what is valid."""
    text = content.decode("utf-8", errors="replace").lstrip("\ufeff")
    rows, first, header = _numbers(path, text)
    if rows.shape[0] < LEAST_POINTS:
        raise InputError(f"{path}: has {rows.shape[0]} points, takes at least {LEAST_POINTS}")
    found = _units(header)
    units = [
        _unit_of(path, name, given, stated)
        for name, given, stated in (("x_unit", x_unit, found[0]), ("z_unit", z_unit, found[1]))
    ]
    if not np.all(np.isfinite(rows)):
        raise InputError(f"{path}: line {first} and below hold values that are not finite")
    x = rows[:, 0] * to_si(f"1 {units[0]}", "m")
    z = rows[:, 1] * to_si(f"1 {units[1]}", "m")
    if rows.shape[1] > 2 and "valid" in header[-1].lower() + (header[-2].lower() if len(header) > 1 else ""):
        z = np.where(rows[:, 2] > 0.0, z, np.nan)
    return Surface(z[np.newaxis], _spacing(path, x), None, str(path))


def _numbers(path: Path, text: str) -> tuple[Array, int, list[str]]:
    """The block of numbers, the number of its first line, and the lines before it."""
    rows: list[list[float]] = []
    header: list[str] = []
    first = 0
    for number, line in enumerate(text.splitlines(), 1):
        fields = [field.strip() for field in re.split(r"[,;\t ]+", line.strip())]
        values = [float(f) for f in fields if f and _NUMBER.fullmatch(f)]
        numeric = len(values) >= 2 and len(values) == len([f for f in fields if f])
        if numeric:
            first = first or number
            rows.append(values)
        elif not rows:
            header.append(line)
        elif line.strip():
            raise InputError(f"{path}: line {number} is {line.strip()[:40]!r}, takes numbers down to the end")
    if not rows:
        raise InputError(f"{path}: holds no two columns of numbers")
    # A header may hold a lone line of numbers, such as a size: what counts is the width of the block.
    width = min(len(row) for row in rows)
    return np.array([row[:width] for row in rows]), first, header or [""]


def _units(header: list[str]) -> tuple[str | None, str | None]:
    """Units of the two columns, from lines such as "Lateral um,Raw Micrometer" or "[mm];[mm]"."""
    for line in reversed(header[-2:]):
        separator = r"[,;\t]+" if re.search(r"[,;\t]", line) else r"\s+"
        fields = [field for field in re.split(separator, line) if field.strip()]
        if len(fields) >= 2 and (_unit_in(fields[0]) or _unit_in(fields[1])):
            return _unit_in(fields[0]), _unit_in(fields[1])
    return None, None


def _unit_in(field: str) -> str | None:
    words = re.findall(r"[A-Za-zµμ]+", field)
    for word in words:
        unit: str = _UNIT_WORDS.get(word.lower(), word)
        if unit in ("m", "mm", "um", "µm", "μm", "nm"):
            return unit
    return None


def _unit_of(path: Path, name: str, given: str | None, stated: str | None) -> str:
    if given is not None and stated is not None and to_si(f"1 {given}", "m") != to_si(f"1 {stated}", "m"):
        raise InputError(f"{name}: got {given!r}, but {path} states {stated!r}")
    unit = given or stated
    if unit is None:
        raise InputError(f"{name}: missing, {path} does not state the unit of its column")
    return unit


def _spacing(path: Path, x: Array) -> float:
    """Spacing of positions that are equal up to rounding: from the whole length, not from neighbours."""
    steps = np.diff(x)
    if not np.all(steps > 0.0):
        bad = int(np.argmin(steps > 0.0))
        raise InputError(f"{path}: positions {bad} and {bad + 1} do not increase")
    spacing = (x[-1] - x[0]) / (x.size - 1)
    # The last digit that is written bounds what rounding can do to a position.
    rounding = max(_resolution(x), 1e-3 * spacing)
    straight = x[0] + spacing * np.arange(x.size)
    largest = float(np.max(np.abs(x - straight)))
    if largest > 1.01 * rounding:
        raise InputError(
            f"{path}: the spacing is not uniform, positions deviate by up to {largest / spacing:.2g} of it"
        )
    return float(spacing)


def _resolution(x: Array) -> float:
    """The decimal step in which positions are written [m]."""
    for digits in range(3, 13):
        if np.allclose(x, np.round(x, digits), rtol=0.0, atol=10.0 ** (-digits - 3)):
            return 10.0**-digits
    return 0.0


def _read_x3p(path: Path) -> Surface:
    """ISO 25178-72: a zip of main.xml and a binary block of heights."""
    try:
        with zipfile.ZipFile(path) as archive:
            root = ElementTree.fromstring(archive.read("main.xml"))
            link = root.findtext(".//PointDataLink") or ""
            data = archive.read(link)
    except (zipfile.BadZipFile, KeyError, ElementTree.ParseError, OSError, EOFError):
        raise InputError(f"{path}: is no whole X3P file") from None
    try:
        columns, rows = (int(root.findtext(f".//MatrixDimension/Size{axis}") or "") for axis in "XY")
        dx, dy = (float(root.findtext(f".//C{axis}/Increment") or "") for axis in "XY")
        kind = {"D": "<f8", "F": "<f4", "L": "<i4", "I": "<i2"}[root.findtext(".//CZ/DataType") or ""]
        scale = float(root.findtext(".//CZ/Increment") or 1.0)
    except (KeyError, ValueError):
        raise InputError(f"{path}: its main.xml lacks a size, an increment or a data type") from None
    if len(data) < rows * columns * np.dtype(kind).itemsize or not (dx > 0.0 and dy > 0.0):
        raise InputError(f"{path}: holds {len(data)} bytes of heights, takes {rows} x {columns} values")
    heights = np.frombuffer(data, kind, rows * columns).astype(float).reshape(rows, columns)
    return Surface(heights * (scale if kind[1] == "i" else 1.0), dx, dy, str(path))


def _read_al3d(path: Path, content: bytes) -> Surface:
    """Alicona's format: tags of 52 bytes, 20 for the name, 30 for the value, then a block of float32."""
    if not content.startswith(b"AliconaImaging"):
        raise InputError(f"{path}: is no AL3D file")
    tags: dict[str, str] = {}
    for start in range(17, min(len(content), 17 + 52 * 200), 52):
        name = content[start : start + 20].split(b"\0")[0].decode("latin-1").strip()
        value = content[start + 20 : start + 50].split(b"\0")[0].decode("latin-1").strip()
        if not name:
            break
        tags.setdefault(name, value)
    try:
        columns, rows, offset = (int(tags[name]) for name in ("Cols", "Rows", "DepthImageOffset"))
        dx, dy = float(tags["PixelSizeXMeter"]), float(tags["PixelSizeYMeter"])
        void = float(tags.get("InvalidPixelValue", "nan"))
    except (KeyError, ValueError):
        raise InputError(f"{path}: its header lacks a size, a spacing or an offset") from None
    # Rows are padded to eight bytes.
    stride = -(-columns * 4 // 8) * 8
    if min(columns, rows) < 1 or offset + stride * rows > len(content):
        raise InputError(
            f"{path}: is {len(content)} bytes long, takes {offset + stride * rows} for its header"
        )
    block = np.frombuffer(content, "<f4", stride // 4 * rows, offset).reshape(rows, stride // 4)
    heights = block[:, :columns].astype(float)
    heights[np.isclose(heights, void, rtol=1e-6) | ~np.isfinite(heights)] = np.nan
    return Surface(heights, dx, dy, str(path))


def _read_other(path: Path) -> Surface:
    """Whatever SurfaceTopography knows."""
    try:
        from SurfaceTopography import open_topography  # type: ignore[import-not-found]
    except ImportError:
        raise InputError(
            f"{path}: is neither text, X3P nor AL3D; other formats take the extra ehlectric[instruments]"
        ) from None
    try:
        topography = open_topography(str(path)).topography().to_unit("m")
        heights: Array = np.ma.filled(np.ma.asarray(topography.heights(), dtype=float), np.nan)
        spacing = np.atleast_1d(topography.pixel_size)
    except Exception as error:  # readers of forty formats raise whatever they like
        raise InputError(f"{path}: cannot be read by SurfaceTopography, {str(error)[:80]}") from None
    if heights.ndim == 1:
        return Surface(heights[np.newaxis], float(spacing[0]), None, str(path))
    return Surface(heights.T, float(spacing[0]), float(spacing[1]), str(path))
