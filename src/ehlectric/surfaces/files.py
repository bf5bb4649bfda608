"""Reader of measured surfaces from instrument files: text profiles, ISO 25178-72 X3P and Alicona AL3D.

The reader refuses doubtful data with an error that names the fault, such as spacings that are not uniform,
slopes that are too large for the spacing, and lines without data. Other formats are read by the package
SurfaceTopography if it is installed.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ehlectric.arrays import Array
from ehlectric.errors import InputError, ResultWarning
from ehlectric.runtime.reading import read_bytes, regular
from ehlectric.surfaces.instrument_files import MOST_POINTS, HeightMap, read_al3d, read_x3p
from ehlectric.surfaces.maps import Map
from ehlectric.surfaces.profiles import LEAST_POINTS, Profile
from ehlectric.surfaces.text_files import NoProfileError, is_text, read_text
from ehlectric.surfaces.voids import filled, without_void_borders

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
    """Measured surface as read from a file. A profile is a surface with one row.

    Attributes
    ----------
    heights : ndarray, shape (rows, columns)
        Heights [m], NaN at points without data.
    spacing_x : float
        Distance between neighbouring points of a row [m].
    spacing_y : float or None
        Distance between neighbouring rows [m]; None for a profile.
    source : str
        Path of the file.
    warnings : tuple of ResultWarning
        Warnings about the data in the file.
    """

    heights: Array
    spacing_x: float
    spacing_y: float | None
    source: str
    warnings: tuple[ResultWarning, ...] = ()

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

        Parameters
        ----------
        index : int
            Number of the row or column, from 0.
        along : str
            Kind of line, "row" or "column".

        Returns
        -------
        Profile
            Profile of the line. Voids at its ends are cut off.

        Raises
        ------
        InputError
            If the surface has no such line, or too much of the line is void.
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

        Parameters
        ----------
        along : str
            Lines of the file that lie along x. For "row", y increases with the number of the row. For
            "column", y decreases with the number of the column, so that the surface is rotated and not
            mirrored.

        Returns
        -------
        Map
            Map without the outer rows and columns that have no data at all.

        Raises
        ------
        InputError
            If the surface is a profile, has too many points, or too much of it is void.
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
    height = float(np.ptp(profile.heights))
    if height > profile.length:
        raise InputError(
            source,
            f"the heights range over {height:.3g} m, the line over {profile.length:.3g} m",
            takes="a surface, whose heights range over less than its length; are x_unit and z_unit right?",
        )
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
    height, length = float(np.ptp(z)), max(surface.length_x, surface.length_y)
    if height > length:
        raise InputError(
            source,
            f"the heights range over {height:.3g} m, the map over {length:.3g} m",
            takes="a surface, whose heights range over less than its length; are its units right?",
        )
    return surface


def read_surface(path: str | Path, *, x_unit: str | None = None, z_unit: str | None = None) -> Surface:
    """Read a measured surface from a file.

    Parameters
    ----------
    path : str or Path
        Text profile (.csv, .txt, .asc, .dat, .hfm), .x3p or .al3d file. SurfaceTopography reads other
        formats, also text with a matrix of heights.
    x_unit, z_unit : str, optional
        Units of positions and heights in a text file that does not state them. They must not contradict the
        file.

    Returns
    -------
    Surface
        Heights [m], spacings [m] and warnings.

    Raises
    ------
    InputError
        If the file cannot be read, or its data are not credible for a surface.
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


def _content(path: Path) -> bytes:
    """Content of a file of a bounded size that its reader can keep in memory."""
    with regular(path) as file:
        text = is_text(file.read(4096))
    most, copies = (MOST_TEXT, _TEXT_COPIES) if text else (MOST_BINARY, 1.0)
    return read_bytes(path, most=most, copies=copies)


def _of_text(path: Path, content: bytes, x_unit: str | None, z_unit: str | None) -> Surface:
    """Surface of a text: a profile, or another format that the package SurfaceTopography reads."""
    try:
        text = read_text(path, content, x_unit, z_unit)
    except NoProfileError as error:
        return _of_map(path, _read_other(path, error.text), x_unit, z_unit)
    return Surface(text.heights[np.newaxis], text.spacing, None, str(path), text.warnings)


def _of_map(path: Path, heights: HeightMap, x_unit: str | None, z_unit: str | None) -> Surface:
    for name, unit in (("x_unit", x_unit), ("z_unit", z_unit)):
        if unit is not None:
            raise InputError(name, got=f"{unit!r}, but {path} is in a format that has its own unit")
    return Surface(*heights, str(path))


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
        points = math.prod(reader.channels[0].nb_grid_pts or ())
        if points > MOST_POINTS:
            raise InputError(path, f"says it has {points} points", takes=f"at most {MOST_POINTS}")
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
