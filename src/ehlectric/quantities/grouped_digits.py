"""Numbers whose point or comma may separate thousands: "3.000 rpm" is 3 rpm here, and 3000 rpm elsewhere.

A number is in doubt if exactly three digits follow its only separator, and one to three digits without a
leading zero precede it. The quantity decides. Both readings are refused as one text if the reading with
thousands is plausible, and the decimal reading is implausible or its unit usually has whole numbers.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from ehlectric.quantities.quantity import Bounds

_GROUPED = re.compile(
    r"([-+]?[1-9]\d{0,2})[.,](\d{3})(?![eE][-+]?\d)(?:\s*+((?:1\s*/|[^\d.,\s]).*))?", re.DOTALL
)

# Units of quantities that people give in whole numbers, in small letters and without spaces.
_SPEEDS = ("rpm", "r/min", "rev/min", "u/min", "1/min", "/min", "min^-1", "min-1", "min**-1")
_WHOLE = frozenset((*_SPEEDS, "n", "n/m", "lbf", "kgf", "h"))

# Units in which both readings of a load occur, so that a warning states the chosen reading.
_BOTH = frozenset({"kn"})


def readings(whole: str, part: str, unit: str) -> tuple[str, str]:
    """Texts of both readings of a number, neither of which is in doubt.

    Examples
    --------
    >>> readings("3", "000", "rpm"), readings("1", "125", "rpm")
    (('3 rpm', '3000 rpm'), ('1.1250 rpm', '1125 rpm'))
    """
    decimal = f"{whole}.{part}".rstrip("0").rstrip(".")
    kept = f"{decimal}0" if _GROUPED.fullmatch(decimal) else decimal
    return f"{kept} {unit}".rstrip(), f"{whole}{part} {unit}".rstrip()


def certain(text: str) -> str:
    """Text of a number with its unit that no rule of this module doubts: a zero follows three decimals.

    Examples
    --------
    >>> certain("123.456 N"), certain("1234.567 N"), certain("0.125 N")
    ('123.4560 N', '1234.567 N', '0.125 N')
    """
    match = _GROUPED.fullmatch(text)
    return text if match is None else f"{match[1]}.{match[2]}0 {match[3] or ''}".rstrip()


def is_grouped(text: str) -> bool:
    """Whether the separator of a number may separate thousands."""
    return _GROUPED.fullmatch(text.strip()) is not None


# Number with a separator of thousands, by its decimal mark.
_THOUSANDS = {
    ".": re.compile(r"[-+]?[1-9][0-9]{0,2}(?:,[0-9]{3})++(?:\.[0-9]*+)?"),
    ",": re.compile(r"[-+]?[1-9][0-9]{0,2}(?:\.[0-9]{3})++(?:,[0-9]*+)?"),
}


def proven_mark(number: str) -> str | None:
    """Decimal mark that the text of a number proves; None if it has no mark or may be read in two ways.

    Examples
    --------
    >>> proven_mark("1,500.5"), proven_mark("1.500.000"), proven_mark("12,5"), proven_mark("1,500")
    ('.', ',', ',', None)
    """
    marks = [mark for mark in number if mark in ".,"]
    if not marks or is_grouped(number):
        return None
    if len(marks) == 1:
        return marks[0]
    return next((mark for mark, form in _THOUSANDS.items() if form.fullmatch(number)), None)


def has_thousands(number: str) -> bool:
    """Whether the text of a number proves a separator of thousands.

    Examples
    --------
    >>> has_thousands("1,500.5"), has_thousands("1,500"), has_thousands("1500.5")
    (True, False, False)
    """
    return sum(mark in ".," for mark in number) > 1 and proven_mark(number) is not None


def ungrouped(number: str, decimal: str) -> str:
    """Text of a number with a decimal point and without separators of thousands. Raises ValueError if its
    separators do not stand between groups of three digits.

    Examples
    --------
    >>> ungrouped("1,500.5", "."), ungrouped("1.500,5", ",")
    ('1500.5', '1500.5')
    """
    thousands = "," if decimal == "." else "."
    if thousands in number:
        if _THOUSANDS[decimal].fullmatch(number) is None:
            raise ValueError(number)
        number = number.replace(thousands, "")
    return number.replace(decimal, ".")


def value_of(number: str, decimal: str) -> float:
    """Value of a number with a decimal mark, which may have separators of thousands. Raises ValueError for
    another text.

    Examples
    --------
    >>> value_of("1,500.5", "."), value_of("-2e3", ".")
    (1500.5, -2000.0)
    """
    return float(ungrouped(number, decimal))


def _is_whole(unit: str) -> bool:
    return unit.replace(" ", "").lower() in _WHOLE


def doubt(text: str, bounds: Bounds, factor: Callable[[str], float]) -> str | None:
    """Advice about a number with its unit, whose two readings are both possible.

    Parameters
    ----------
    text : str
        Number with its unit, as a person wrote it.
    bounds : Bounds
        Bounds of the quantity and, if they are known, its typical values, in its SI unit.
    factor : callable
        Factor from a unit to the SI unit.

    Returns
    -------
    str or None
        Both readings, for an error; None if the number is certain.

    Warns
    -----
    UserWarning
        If both readings of a load in kN are possible.
    """
    match = _GROUPED.fullmatch(text.strip())
    if match is None:
        return None
    whole, part, unit = match[1], match[2], (match[3] or "").strip()
    ratio = factor(unit)
    decimal, thousands = ratio * float(f"{whole}.{part}"), ratio * float(whole + part)
    low, high = bounds.typical or (0.0, float("inf"))
    if not bounds.allow(thousands) or abs(thousands) > high:
        return None
    first, second = readings(whole, part, unit)
    if _is_whole(unit) or abs(decimal) < low or not bounds.allow(decimal):
        return f"the separator may separate thousands: write '{first}' or '{second}'"
    if unit.lower() in _BOTH:
        import warnings

        warnings.warn(f"'{text.strip()}' is read as {first}, not as {second}", stacklevel=2)
    return None


def doubt_of_column(cells: Sequence[str], bounds: Bounds, factor: float) -> str | None:
    """First cell of a column in doubt: all its numbers with a separator have three digits after it, and all
    decimal readings are lower than typical values. Instruments also write three decimals.

    A leading zero, another number of decimals or four digits before the separator prove that it is decimal.
    ``factor`` converts numbers in the unit of the column to the SI unit of the bounds.
    """
    separated = [cell.strip() for cell in cells if "." in cell or "," in cell]
    if not separated or not all(map(is_grouped, separated)):
        return None
    low, high = bounds.typical or (0.0, float("inf"))
    thousands = factor * max(abs(float(re.sub("[.,]", "", cell))) for cell in separated)
    decimal = factor * max(abs(float(cell.replace(",", "."))) for cell in separated)
    doubtful = decimal < low and bounds.allow(thousands) and thousands <= high
    return separated[0] if doubtful else None
