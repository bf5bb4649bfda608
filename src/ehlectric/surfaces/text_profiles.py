"""Profiles in text files: position and height in two columns, below a header of any form.

A third column may have the validity of each point. A file that can be read in two ways is refused.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

import numpy as np

from ehlectric.arrays import Array
from ehlectric.errors import InputError, shown, within
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.quantities.unit_spelling import typed
from ehlectric.quantities.units import known_factor, length_unit, to_si
from ehlectric.runtime.text_table import Layout, NoTableError, decoded, layout_of
from ehlectric.surfaces.profiles import LEAST_POINTS

# Most lines of a text, of which each is looked at: twice the lines of the longest profiles of instruments.
MOST_LINES = 2_000_000

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
_VALIDITY = re.compile(r"valid(ity)?", re.IGNORECASE)

# Rows at each end of a file whose printed digits are counted.
_COUNTED = 40

# Largest position and height that are credible for a surface [m].
_FARTHEST = 10.0


@dataclass(frozen=True)
class TextProfile:
    """Profile as read from a text file."""

    heights: Array  # heights [m], NaN at points without data, shape (n,)
    spacing: float  # distance between neighbouring points [m]
    warnings: tuple[ResultWarning, ...]  # warnings about the data in the file


def read_profile(path: Path, content: bytes, x_unit: str | None, z_unit: str | None) -> TextProfile:
    """Profile in a text file, with heights and spacing in metres.

    Raises a NoTableError if the file is not two columns of numbers, so that another reader may know its
    format. Raises an InputError if the file cannot be read or can be read in two ways, or if its units are
    unknown or contradict the arguments.
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
    below, line = layout.below(text), layout.first + 1
    _check_columns(path, layout, below)
    x, z, *flags = layout.numbers(path, layout.columns, below, line, voids=layout.columns[1:])
    if x.size < LEAST_POINTS:
        raise InputError(path, f"has {x.size} points", takes=f"at least {LEAST_POINTS}")
    factors = [
        to_si(f"1 {_unit_of(path, name, unit, from_header)}", "m")
        for name, unit, from_header in zip(
            ("x_unit", "z_unit"), (x_unit, z_unit), _stated_units(layout), strict=True
        )
    ]
    z = z * factors[1]
    if max(np.max(np.abs(x)) * factors[0], np.max(np.abs(z), initial=0.0, where=~np.isnan(z))) > _FARTHEST:
        raise InputError(path, f"contains lengths above {_FARTHEST:g} m; are x_unit and z_unit right?")
    for validity in flags:
        wrong = np.flatnonzero((validity != 0.0) & (validity != 1.0))
        if wrong.size:
            number, row = next(islice(layout.rows(below, line), int(wrong[0]), None))
            raise InputError(path, f"line {number} has the validity {shown(row[2])}", takes="0 or 1")
        z[validity == 0.0] = np.nan
    rows = lines[layout.first :]
    spacing, warnings = _spacing(path, x, layout.last_digit(0, (rows[:_COUNTED], rows[-_COUNTED:])))
    return TextProfile(z, spacing * factors[0], warnings)


def _check_columns(path: Path, layout: Layout, rows: str) -> None:
    """Raise an error unless a file has two columns, or three of which the last has the validity of points."""
    if layout.columns == (0,):
        raise InputError(path, "contains one column of numbers", takes="two, position and height")
    heads = [layout.dialect.fields(line) for line in _heads(layout)[-2:]]
    valid = any(len(head) > 2 and _VALIDITY.fullmatch(head[2].strip("\"' ")) for head in heads)
    if layout.columns == (0, 1, 2)[: 2 + valid]:
        return
    try:
        layout.numbers(path, layout.columns, rows, layout.first + 1, voids=layout.columns)
    except InputError as error:
        raise NoTableError(path, error.text) from None
    takes = "two, position and height, and perhaps a third headed 'valid'"
    raise NoTableError(path, f"has {layout.width} columns", takes=takes)


def _heads(layout: Layout) -> list[str]:
    return [line.strip() for line in layout.header if line.strip()]


def _stated_units(layout: Layout) -> tuple[str | None, str | None]:
    """Units of the two columns from the line above them; None for a unit that the line does not state.

    The line must have one field per column. Examples are "Lateral um,Raw Micrometer", "[mm];[mm]" and, with
    white space as separator, "x [um] z [nm]".
    """
    line = next(reversed(_heads(layout)), "")
    fields = layout.dialect.fields(line)
    while fields and not fields[-1]:
        fields.pop()
    if len(fields) != layout.width:
        # The search would take a time with the square of the length of a line without brackets.
        fields = _BRACKETED_FIELD.findall(line) if _BRACKETED_FIELDS.fullmatch(line) else []
    return (_unit_in(fields[0]), _unit_in(fields[1])) if len(fields) == layout.width else (None, None)


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
