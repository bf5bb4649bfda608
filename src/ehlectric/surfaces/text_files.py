"""Reader of text profiles: position and height in two columns, below a header of any form.

The separator of the columns is a semicolon, a tab, a comma or white space, the same in the whole file. A
comma that is not the separator is a decimal comma. A file that can be read in two ways is refused.
"""

from __future__ import annotations

import codecs
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ehlectric.arrays import Array
from ehlectric.errors import InputError, ResultWarning, shown
from ehlectric.quantities.units import length_unit, to_si
from ehlectric.surfaces.profiles import LEAST_POINTS

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

# Line with a single number.
_SINGLE = re.compile(r"\s*+[-+]?(?:[0-9]++[.,]?[0-9]*+|[.,][0-9]++)(?:[eE][-+]?[0-9]++)?[;,]?\s*+")
_UTF_16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
_UNITS = dict.fromkeys(("m", "mm", "um", "nm")) | {"µm": "um", "μm": "um"}
_UNIT_WORDS = {
    prefix + ending: unit
    for prefix, unit in (("", "m"), ("milli", "mm"), ("micro", "um"), ("nano", "nm"))
    for ending in ("metre", "meter", "metres", "meters")
}
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
    """Profile as read from a text file.

    Attributes
    ----------
    heights : ndarray, shape (n,)
        Heights [m], NaN at points without data.
    spacing : float
        Distance between neighbouring points [m].
    warnings : tuple of ResultWarning
        Warnings about the data in the file.
    """

    heights: Array
    spacing: float
    warnings: tuple[ResultWarning, ...]


@dataclass(frozen=True)
class _Layout:
    separator: str | None  # None is white space
    decimal: str

    def fields(self, line: str) -> list[str]:
        return [field.strip() for field in line.strip().split(self.separator)]

    def is_row(self, line: str) -> bool:
        first, *rest = self.fields(line) or [""]
        number = _NUMBER[self.decimal].fullmatch
        return bool(rest and number(first)) and all(not field or number(field) for field in rest)

    def value(self, field: str) -> float:
        return float(field.replace(",", ".")) if field else np.nan

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
    """Read the profile in a text file.

    Parameters
    ----------
    path : Path
        Path of the file, for error messages.
    content : bytes
        Content of the file: two columns, position and height. A third column with the head "valid" has 1 for
        points with data and 0 for others. An empty height means no data.
    x_unit, z_unit : str or None
        Units of the columns, for a header that does not state them.

    Returns
    -------
    TextProfile
        Heights and spacing in metres.

    Raises
    ------
    NoProfileError
        If the file is not two columns of numbers; another reader may know its format.
    InputError
        If the file cannot be read or can be read in two ways, or if its units are unknown or contradict the
        arguments.
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
    separator = _separator(next((line for line in reversed(lines) if line.strip()), ""))
    layouts = [_Layout(separator, decimal) for decimal in ("." if separator == "," else ".,")]
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
    spaced = len(tokens) > 1 and all(_SPACED_NUMBER.fullmatch(token) for token in tokens)
    return "," if "," in line and not spaced else None


def _bad_line(path: Path, below: list[tuple[int, str]], layouts: list[_Layout]) -> InputError:
    for number, line in below:
        if not any(layout.is_row(line) for layout in layouts):
            if len(layouts[0].fields(below[0][1])) > _PROFILE_COLUMNS:
                return NoProfileError(path, f"line {number} is not of numbers only", takes="two columns")
            text = shown(line.strip())
            return InputError(path, f"line {number} is {text}", takes="numbers of one kind down to the end")
    return InputError(path, "mixes decimal points and decimal commas", takes="one of the two")


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


def _heads(block: _Block) -> list[list[str]]:
    """Fields of the last two header lines, without comment marks."""
    lines = [line.strip().lstrip("#%/ ") for line in block.header if line.strip()]
    return [block.layout.fields(line) for line in lines[-2:]]


def _has_validity(block: _Block) -> bool:
    """Whether the header of the third column is "valid" or "validity"."""
    return any(len(head) > 2 and _VALIDITY.fullmatch(head[2].strip("\"' ")) for head in _heads(block))


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
    lines = [line.strip().lstrip("#%/ ") for line in block.header if line.strip()]
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
    units = [_UNITS[unit] or unit for unit in units if unit in _UNITS]
    return units[0] if len(units) == 1 else None


def _unit_of(path: Path, name: str, given: str | None, stated: str | None) -> str:
    if given is not None:
        try:
            length_unit(given)
        except InputError as error:
            raise error.under(name) from None
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
        where = int(np.argmax(long))
        text = (
            f"{path}: {np.count_nonzero(long)} of the {steps.size} distances between positions are twice the "
            f"others, the first after point {where}: positions are rounded, or samples are missing; all "
            "points are treated as equally spaced, check the file"
        )
        return spacing, (ResultWarning("spacing-irregular", text),)
    return spacing, ()
