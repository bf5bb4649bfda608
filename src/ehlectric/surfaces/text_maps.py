"""Surfaces in text files: profiles, points X, Y, Z of a grid, and matrices of heights, below any header.

A row of a matrix lies along x. A file that can be read in two ways is refused.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import islice
from pathlib import Path

import numpy as np

from ehlectric.arrays import Array, IntArray
from ehlectric.errors import InputError, shown
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.quantities.unit_spelling import typed
from ehlectric.quantities.units import known_factor
from ehlectric.runtime.text_table import Layout, NoTableError, decoded, layout_of
from ehlectric.surfaces.profiles import LEAST_POINTS
from ehlectric.surfaces.text_profiles import (
    Scale,
    check_lengths,
    factor_of,
    last_digits,
    profile_of,
    roles_of,
    spacing_of,
    stated_units,
    stated_where,
    voids_of,
)
from ehlectric.surfaces.void_numbers import without_void_numbers

# Most lines of a text, of which each is looked at: twice the lines of the longest profiles of instruments.
MOST_LINES = 2_000_000

# Fewest columns of a matrix. Three columns are positions and heights.
_LEAST_COLUMNS = 4

# Most rows in which decimal commas are searched.
_TRIED = 200

# Least fraction of the points of a grid that a file contains, and largest number of points of the grid.
_LEAST_FILLED, _MOST_POINTS = 0.5, 20_000_000

# Names of the width, the height and the unit of the heights in the header that Gwyddion writes, by language.
_WIDTH = (
    "width",
    "breite",
    "largeur",
    "larghezza",
    "anchura",
    "ancho",
    "largura",
    "šířka",
    "ширина",
    "幅",
    "너비",
)
_HEIGHT = ("height", "höhe", "hauteur", "altezza", "altura", "alto", "výška", "высота", "高さ", "높이")
_VALUE = ("value", "wert", "valeur", "valor", "hodnot", "значени", "値", "값")
_FIELD = re.compile(r"([^:=]+)[:=]\s*(\S.*)")
_LENGTH = re.compile(r"([-+0-9.,eE]+)\s*([^\s\d]\S*)")


@dataclass(frozen=True)
class TextSurface:
    """Surface as read from a text file. A profile is a surface with one row."""

    heights: Array  # heights [m], NaN at points without data, shape (rows, columns)
    spacing_x: float  # distance between neighbouring points of a row [m]
    spacing_y: float | None  # distance between neighbouring rows [m]; None for a profile
    warnings: tuple[ResultWarning, ...] = ()  # warnings about the data in the file


def read_text(path: Path, content: bytes, scale: Scale) -> TextSurface:
    """Surface in a text file, with heights and spacings in metres.

    Raises a NoTableError if the file has no columns of numbers, or a matrix whose size is not known, so that
    another reader may know its format. Raises an InputError if the file cannot be read or can be read in two
    ways, or if its units are unknown or contradict ``scale``.
    """
    text = decoded(path, content)
    lines = text.removesuffix("\n").split("\n")
    if len(lines) > MOST_LINES:
        raise InputError(path, f"has {len(lines)} lines", takes=f"at most {MOST_LINES}")
    try:
        layout = layout_of(path, lines, strict=True)
    except NoTableError:
        got = "does not contain two columns of numbers"
        raise NoTableError(path, got, takes="position and height") from None
    layout = _whole_rows(layout, lines)
    if layout.width == 1:
        return _column(path, layout, text, scale)
    roles = roles_of(path, layout)
    if roles is None:
        return _matrix(path, layout, text, scale)
    scale.refuse_spacing(path)
    if "y" in roles:
        return _points(path, layout, text, lines, scale, roles)
    profile = profile_of(path, layout, text, lines, scale, roles)
    return TextSurface(profile.heights[np.newaxis], profile.spacing, None, profile.warnings)


def _whole_rows(layout: Layout, lines: Sequence[str]) -> Layout:
    """Layout with all columns of its rows, also with columns at the ends that have no data in most rows."""
    if len(layout.columns) < _LEAST_COLUMNS - 1:
        return layout
    ends = [*lines[layout.first :][:40], *lines[-40:]]
    rows = [layout.dialect.fields(line) for line in ends if line.strip()]
    width = max(
        [layout.width, *(max((k for k, field in enumerate(row, 1) if field), default=0) for row in rows)]
    )
    return replace(layout, columns=tuple(range(width)), width=width)


def _column(path: Path, layout: Layout, text: str, scale: Scale) -> TextSurface:
    """Profile of heights in a single column, whose spacing is given."""
    if scale.spacing is None:
        got = "contains one column of numbers"
        raise NoTableError(path, got, takes="two, position and height, or spacing with only heights")
    (z,) = layout.numbers(path, layout.columns, layout.below(text), layout.first + 1, voids=layout.columns)
    # Instruments such as Mitutoyo's write the number of heights, and perhaps their spacing, above them.
    z = next((z[above:] for above in (1, 2) if z.size > above and z.size - above in z[:above]), z)
    if z.size < LEAST_POINTS:
        raise InputError(path, f"has {z.size} points", takes=f"at least {LEAST_POINTS}")
    z, marked = without_void_numbers(path, z)
    (stated,) = stated_units(layout)
    heights = z * factor_of(path, "z_unit", scale.z_unit, stated)
    scale.refuse_x_unit(path)
    check_lengths(path, heights)
    return TextSurface(heights[np.newaxis], scale.spacing, None, marked)


def _points(
    path: Path, layout: Layout, text: str, lines: Sequence[str], scale: Scale, roles: dict[str, int]
) -> TextSurface:
    """Map of points X, Y, Z in any order, or profile if one of X and Y is constant."""
    places = [roles[name] for name in ("x", "y", "z", "valid") if name in roles]
    x, y, z, *flags = layout.numbers(path, places, layout.below(text), layout.first + 1, voids=places[2:])
    if x.size < LEAST_POINTS:
        raise InputError(path, f"has {x.size} points", takes=f"at least {LEAST_POINTS}")
    z, marked = without_void_numbers(path, z)
    units = stated_units(layout)
    factors = {
        name: factor_of(path, key, getattr(scale, key), units[roles[name]])
        for name, key in (("x", "x_unit"), ("y", "x_unit"), ("z", "z_unit"))
    }
    heights = z * factors["z"]
    for validity in flags:
        heights[voids_of(path, layout, text, roles["valid"], validity)] = np.nan
    check_lengths(path, x * factors["x"], y * factors["y"], heights)
    for name, along, constant in (("x", x, y), ("y", y, x)):
        if np.ptp(constant) == 0.0 and np.ptp(along) > 0.0:
            step = last_digits(layout, roles[name], lines)
            spacing, warnings = spacing_of(path, along, step)
            return TextSurface(heights[np.newaxis], spacing * factors[name], None, (*warnings, *marked))
    column, columns, dx = _axis(path, "x", x, last_digits(layout, roles["x"], lines))
    row, rows, dy = _axis(path, "y", y, last_digits(layout, roles["y"], lines))
    if rows * columns > _MOST_POINTS or x.size < _LEAST_FILLED * rows * columns:
        raise InputError(
            path,
            f"its {x.size} points lie at {columns} positions along x and {rows} along y",
            takes="points at each position of a regular grid",
        )
    place = row * columns + column
    twice = np.flatnonzero(np.bincount(place, minlength=rows * columns) > 1)
    if twice.size:
        k = int(np.flatnonzero(place == twice[0])[1])
        number = layout.line_of(layout.below(text), layout.first + 1, k)
        got = f"line {number} repeats the point of a line above"
        raise InputError(path, got, takes="one height at each point")
    grid = np.full(rows * columns, np.nan)
    grid[place] = heights
    return TextSurface(grid.reshape(rows, columns), dx * factors["x"], dy * factors["y"], marked)


def _axis(path: Path, name: str, values: Array, step: float) -> tuple[IntArray, int, float]:
    """Index of each position on an equally spaced axis, number of positions, and their spacing.

    ``step`` is the last decimal place of the positions, which may be rounded.
    """
    distinct, inverse = np.unique(values, return_inverse=True)
    for tolerance in (0.0, 1.01 * step):
        new = np.append(0, np.cumsum(np.diff(distinct) > tolerance))
        count = int(new[-1]) + 1
        if count < 2:
            continue
        centres = np.bincount(new, distinct) / np.bincount(new)
        place = np.rint((centres - centres[0]) / np.median(np.diff(centres)))
        spacing = float((centres[-1] - centres[0]) / place[-1])
        largest = float(np.max(np.abs(centres - centres[0] - place * spacing)))
        if largest <= 1.01 * max(step, 1e-3 * spacing) and np.all(np.diff(place) > 0.0):
            index: IntArray = place.astype(int)[new][inverse]
            return index, int(place[-1]) + 1, spacing
    raise InputError(
        path,
        f"its {distinct.size} positions along {name} are not equally spaced",
        takes="points of a regular grid, or the columns X, Y, Z named above the numbers",
    )


def _matrix(path: Path, layout: Layout, text: str, scale: Scale) -> TextSurface:
    """Map of a matrix of heights, whose spacing and unit are in the header of Gwyddion, or given."""
    sizes, unit = _header_of_matrix(path, layout)
    if sizes is None and scale.spacing is None:
        got = f"has {layout.width} columns of heights, and its header does not state their spacing"
        raise NoTableError(path, got, takes="spacing and z_unit with such a matrix")
    scale.refuse_x_unit(path)
    _refuse_pairs(path, layout, text)
    z = np.stack(
        layout.numbers(path, layout.columns, layout.below(text), layout.first + 1, voids=layout.columns),
        axis=1,
    )
    _refuse_positions(path, z)
    z, marked = without_void_numbers(path, z)
    if unit is None:
        unit = _unit_alone(layout)
    heights = z * factor_of(path, "z_unit", scale.z_unit, unit)
    check_lengths(path, heights)
    rows, columns = z.shape
    if sizes is not None:
        spacings = sizes[0] / columns, sizes[1] / rows
        scale.compare_spacings(path, spacings)
    else:
        assert scale.spacing is not None
        spacings = scale.spacing, scale.spacing_y or scale.spacing
    return TextSurface(heights, spacings[0], None if rows == 1 else spacings[1], marked)


def _header_of_matrix(path: Path, layout: Layout) -> tuple[tuple[float, float] | None, str | None]:
    """Width and height of a map [m] and unit of its heights, from the header that Gwyddion writes."""
    lengths: dict[str, float] = {}
    unit = None
    for line in layout.header:
        match = _FIELD.fullmatch(typed(line).strip())
        if match is None:
            continue
        name, value = match[1].strip().lower(), match[2].strip()
        key = "width" if name in _WIDTH else "height" if name in _HEIGHT else None
        length = _LENGTH.fullmatch(value)
        if key is not None and length is not None:
            number, factor = layout.dialect.number(length[1]), known_factor(length[2], "m")
            if number is None or factor is None or not 0.0 < number * factor < math.inf:
                got = f"its header states {shown(line.strip())}"
                raise InputError(path, got, takes="a length, with the decimal mark of the heights")
            lengths[key] = number * factor
        elif any(word in name for word in _VALUE) and known_factor(value, "m") is not None:
            unit = value
    return ((lengths["width"], lengths["height"]) if len(lengths) == 2 else None), unit


def _unit_alone(layout: Layout) -> str | None:
    """Unit of heights in a header that contains no other field than it, such as "z [um]"; else None."""
    heads = [line.strip() for line in layout.header if line.strip()]
    return stated_where(heads[-1]) if heads else None


def _refuse_pairs(path: Path, layout: Layout, text: str) -> None:
    """Raise an InputError if pairs of whole numbers between commas may be numbers with decimal commas.

    The second number of each pair then consists of digits only, with equally many in each pair or with zeros
    before others, and the first number does not.
    """
    if layout.dialect.separator != "," or layout.width % 2:
        return
    rows = [row for _, row in islice(layout.rows(layout.below(text), layout.first + 1), _TRIED)]
    firsts, seconds = ([field for row in rows for field in row[start::2]] for start in (0, 1))
    if any("." in field for field in firsts + seconds) or not all(field.isdigit() for field in seconds):
        return
    plain = all(field.isdigit() for field in firsts)
    lengths = {len(field) for field in seconds}
    zeros = any(len(field) > 1 and field.startswith("0") for field in seconds)
    if zeros or (len(lengths) == 1 and not (plain and {len(field) for field in firsts} == lengths)):
        number, row = next(layout.rows(layout.below(text), layout.first + 1))
        raise InputError(
            path,
            f"line {number} begins with {shown(','.join(row[:4]))}, four numbers or two with decimal commas",
            takes="a semicolon or a tab between columns",
        )


def _refuse_positions(path: Path, z: Array) -> None:
    """Raise an InputError if the first row or column of a matrix contains positions, or numbers of points."""
    inner = z[1:, 1:]
    if min(inner.shape) < 2:
        return
    for name, line, other in (("row", z[0], inner[0]), ("column", z[:, 0], inner[:, 0])):
        if any(_is_progression(each) for each in (line, line[1:])) and not _is_progression(other):
            raise InputError(
                path,
                f"its first {name} increases in equal steps, as positions or numbers of points do",
                takes=f"heights only; remove the {name} if it contains positions",
            )


def _is_progression(values: Array) -> bool:
    """Whether values increase in equal steps up to rounding."""
    steps = np.diff(values)
    if not np.all(np.isfinite(steps)) or steps.size < 3:
        return False
    return bool(np.min(steps) > 0.0 and np.ptp(steps) <= 0.02 * np.max(steps))
