"""Profiles in text files: position and height in two columns, below a header of any form.

A third column may have the validity of each point. A file that can be read in two ways is refused.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.errors import InputError, shown, within
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.quantities.unit_spelling import typed
from ehlectric.quantities.units import known_factor, length_unit, to_si
from ehlectric.runtime.text_table import Layout
from ehlectric.surfaces.profiles import LEAST_POINTS
from ehlectric.surfaces.void_numbers import without_void_numbers

_UNITS = ("m", "mm", "um", "µm", "nm", "Å")
_UNIT_WORDS = {
    prefix + ending: unit
    for prefix, unit in (("", "m"), ("milli", "mm"), ("micro", "um"), ("nano", "nm"))
    for ending in ("metre", "meter", "metres", "meters")
} | {"micron": "um", "microns": "um", "angstrom": "Å"}
# Repetitions that are never given up, "++" and "*+", keep the time proportional to the length of a line.
_BRACKETED = re.compile(r"[\[(]([^\[\]()]*)[\])]")
_BRACKETED_FIELD = re.compile(r"[^\[\]()]*+[\[(][^\[\]()]*+[\])]")
_BRACKETED_FIELDS = re.compile(rf"(?:{_BRACKETED_FIELD.pattern})++")

# Rows at each end of a file whose printed digits are counted.
_COUNTED = 40

# Largest position and height that are credible for a surface [m].
_FARTHEST = 10.0


# Names of columns in small letters, by what the column contains.
_NAMES = {
    "x": ("x", "lateral", "position", "pos", "distance", "length", "scan", "weg", "abstand", "strecke"),
    "y": ("y",),
    "z": ("z", "height", "heights", "raw", "depth", "elevation", "höhe", "hauteur"),
    "valid": ("valid", "validity"),
    "other": ("intensity", "gray", "grey", "texture"),
}
_ROLES = {name: role for role, names in _NAMES.items() for name in names}
_WORD = re.compile(r"[^\W\d_]+")


@dataclass(frozen=True)
class Scale:
    """Units and spacings that a user gives for a file without them."""

    x_unit: str | None = None
    z_unit: str | None = None
    spacing: float | None = None  # distance between neighbouring points of a row [m]
    spacing_y: float | None = None  # distance between neighbouring rows [m]; ``spacing`` if None

    def refuse_spacing(self, path: Path) -> None:
        """Raise an InputError if a spacing is given for a file with positions."""
        for name in ("spacing", "spacing_y"):
            if (value := getattr(self, name)) is not None:
                raise InputError(name, got=f"{value:g} m, but {path} contains positions")

    def refuse_x_unit(self, path: Path) -> None:
        """Raise an InputError if the unit of positions is given for a file without them."""
        if self.x_unit is not None:
            raise InputError("x_unit", got=f"{self.x_unit!r}, but {path} contains no positions")

    def compare_spacings(self, path: Path, stated: Sequence[float]) -> None:
        """Raise an InputError if a given spacing differs from the spacing that a file states [m]."""
        for name, value in zip(("spacing", "spacing_y"), stated, strict=True):
            given = getattr(self, name)
            if given is not None and abs(given - value) > 1e-3 * value:
                raise InputError(name, got=f"{given:g} m, but {path} states {value:g} m")


@dataclass(frozen=True)
class TextProfile:
    """Profile as read from a text file."""

    heights: Array  # heights [m], NaN at points without data, shape (n,)
    spacing: float  # distance between neighbouring points [m]
    warnings: tuple[ResultWarning, ...]  # warnings about the data in the file


def profile_of(
    path: Path, layout: Layout, text: str, lines: Sequence[str], scale: Scale, roles: Mapping[str, int]
) -> TextProfile:
    """Profile of columns of positions, heights and, perhaps, the validity of points.

    Raises an InputError if the columns cannot be read, or if the units are unknown or contradict ``scale``.
    """
    places = [roles[name] for name in ("x", "z", "valid") if name in roles]
    x, z, *flags = layout.numbers(path, places, layout.below(text), layout.first + 1, voids=places[1:])
    if x.size < LEAST_POINTS:
        raise InputError(path, f"has {x.size} points", takes=f"at least {LEAST_POINTS}")
    z, marked = without_void_numbers(path, z)
    units = stated_units(layout)
    factors = [
        factor_of(path, name, getattr(scale, name), units[roles[name[0]]]) for name in ("x_unit", "z_unit")
    ]
    z = z * factors[1]
    check_lengths(path, x * factors[0], z)
    for validity in flags:
        z[voids_of(path, layout, text, roles["valid"], validity)] = np.nan
    spacing, warnings = spacing_of(path, x, last_digits(layout, roles["x"], lines))
    return TextProfile(z, spacing * factors[0], (*warnings, *marked))


def voids_of(path: Path, layout: Layout, text: str, place: int, validity: Array) -> Mask:
    """Whether each point is void, from the numbers of its column of validity.

    Raises an InputError if a number is neither 0 nor 1.
    """
    wrong = np.flatnonzero((validity != 0.0) & (validity != 1.0))
    if wrong.size:
        rows = layout.rows(layout.below(text), layout.first + 1)
        number, row = next(islice(rows, int(wrong[0]), None))
        raise InputError(path, f"line {number} has the validity {shown(row[place])}", takes="0 or 1")
    void: Mask = validity == 0.0
    return void


def check_lengths(path: Path, *lengths: Array) -> None:
    """Raise an InputError if a position or height [m] is too large for a surface; NaN is no height."""
    if max(float(np.max(np.abs(each), initial=0.0, where=~np.isnan(each))) for each in lengths) > _FARTHEST:
        raise InputError(path, f"contains lengths above {_FARTHEST:g} m; are x_unit and z_unit right?")


def last_digits(layout: Layout, place: int, lines: Sequence[str]) -> float:
    """Last printed digit of a column, from the rows at both ends of the lines of a file."""
    rows = lines[layout.first :]
    return layout.last_digit(place, (rows[:_COUNTED], rows[-_COUNTED:]))


def roles_of(path: Path, layout: Layout) -> dict[str, int] | None:
    """Places of the columns x, y, z and valid; None for a matrix of heights.

    The names above the columns decide. Without names two columns are x and z, and three are x, y and z. The
    height of a profile may be named Y.

    Raises an InputError if only some columns are named X, Y, Z or valid.
    """
    named = max((_named(layout, head) for head in _heads(layout)[-2:]), key=len, default={})
    kinds = frozenset(named) - {"other"}
    whole = len(named) == layout.width
    if whole and kinds in ({"x", "y"}, {"x", "y", "valid"}):
        return {"z" if name == "y" else name: place for name, place in named.items()}
    if whole and {"x", "z"} <= kinds:
        return {name: place for name, place in named.items() if name in kinds}
    # Between spaces, a title of two or three words is no line of heads.
    unnamed = not named or layout.dialect.separator is None
    if layout.width == 2 and (unnamed or named in ({"x": 0}, {"z": 1})):
        return {"x": 0, "z": 1}
    if layout.width == 3 and unnamed:
        return {"x": 0, "y": 1, "z": 2}
    if layout.width > 3 and not {"x", "z"} <= kinds:
        return None
    takes = "two, position and height, and perhaps a third headed 'valid', or X, Y and Z"
    raise InputError(path, f"has {layout.width} columns", takes=takes)


def _named(layout: Layout, head: str) -> dict[str, int]:
    """Places of the columns that a line of heads names; empty if a name repeats or the line is no head."""
    fields = _fields(layout, head)
    words = [
        word[0].lower() if (word := _WORD.findall(_BRACKETED.sub(" ", field))) else "" for field in fields
    ]
    places = [(_ROLES[word], place) for place, word in enumerate(words) if word in _ROLES]
    return dict(places) if len({role for role, _ in places}) == len(places) else {}


def _heads(layout: Layout) -> list[str]:
    return [line.strip() for line in layout.header if line.strip()]


def _fields(layout: Layout, line: str) -> list[str]:
    """Fields of a line of heads, one for each column; empty if the line has another number of fields."""
    fields = layout.dialect.fields(line)
    while fields and not fields[-1]:
        fields.pop()
    if len(fields) != layout.width:
        # The search would take a time with the square of the length of a line without brackets.
        fields = _BRACKETED_FIELD.findall(line) if _BRACKETED_FIELDS.fullmatch(line) else []
    return fields if len(fields) == layout.width else []


def stated_units(layout: Layout) -> list[str | None]:
    """Unit of each column from the line above the columns; None for a unit that the line does not state.

    The line must have one field per column. Examples are "Lateral um,Raw Micrometer", "[mm];[mm]" and, with
    white space as separator, "x [um] z [nm]".
    """
    fields = _fields(layout, next(reversed(_heads(layout)), ""))
    return [stated_where(field) for field in fields] or [None] * layout.width


def stated_where(field: str) -> str | None:
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


def factor_of(path: Path, name: str, given: str | None, stated: str | None) -> float:
    """Factor from the unit of a column to metres. The key ``name`` or the file states the unit.

    Raises an InputError if both units are missing, or differ.
    """
    if given is not None:
        with within(name):
            length_unit(given)
    if given is not None and stated is not None and to_si(f"1 {given}", "m") != to_si(f"1 {stated}", "m"):
        raise InputError(name, got=f"{given!r}, but {path} states {stated!r}")
    unit = stated if given is None else given
    if unit is None:
        raise InputError.worded(name, f"missing; {path} does not state the unit of its column unambiguously")
    return to_si(f"1 {unit}", "m")


def spacing_of(path: Path, x: Array, step: float) -> tuple[float, tuple[ResultWarning, ...]]:
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
