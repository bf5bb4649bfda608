"""Numbers with units as typed, in the unit of a slider; the checks of a case have the last word.

The server of the pages does not load the registry of units. A unit that is not known here leaves the slider
where it is.
"""

from __future__ import annotations

import re

_PREFIXES = {
    "": 1.0,
    "G": 1e9,
    "M": 1e6,
    "k": 1e3,
    "c": 1e-2,
    "m": 1e-3,
    "u": 1e-6,
    "µ": 1e-6,
    "n": 1e-9,
    "p": 1e-12,
}
_BASES = ("m", "s", "N", "V", "F", "H", "A", "Pa", "Hz", "K", "W", "J", "S", "ohm", "g", "rad")
_OTHERS = {
    "rpm": 3.141592653589793 / 30.0,
    "deg": 3.141592653589793 / 180.0,
    "cSt": 1e-6,
    "mP": 1e-4,
    "P": 0.1,
    "cP": 1e-3,
    "bar": 1e5,
    "inch": 0.0254,
    "in": 0.0254,
    "min": 60.0,
    "h": 3600.0,
    "Ω": 1.0,
}
_TURNS = ("r/min", "rev/min", "1/min", "min^-1", "min-1", "U/min")
_ZEROS = {"K": 0.0, "degC": 273.15, "°C": 273.15, "C": 273.15}

_AMOUNT = re.compile(r"([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(.*)")
_PART = re.compile(r"([A-Za-zµΩ]+)(?:(?:\*\*|\^)?([-+]?\d))?")
_SUPERSCRIPTS = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹μ·", "-0123456789µ ")

# Longest text that is read [characters].
_LONGEST = 200

# Digits of a number from a slider.
_DIGITS = 3


def split(text: str) -> tuple[float, str] | None:
    """Number and unit of a text; None where it is no number.

    Examples
    --------
    >>> split("1.8 kN"), split("1,8 kN")
    ((1.8, 'kN'), None)
    """
    found = _AMOUNT.fullmatch(text.strip()) if len(text) <= _LONGEST else None
    if found is None or found[2].startswith(","):
        return None
    return float(found[1]), found[2].strip()


def in_unit(text: str, unit: str) -> float | None:
    """Number of a text in a unit; None where the text or its unit is not known here.

    Examples
    --------
    >>> in_unit("1.8 kN", "N"), in_unit("343.15 K", "degC"), in_unit("1800", "N")
    (1800.0, 70.0, None)
    """
    found = split(text)
    if found is None:
        return None
    number, written = found
    if written == unit:
        return number
    if unit in _ZEROS:
        if written not in _ZEROS:
            return None
        return float(f"{number + _ZEROS[written] - _ZEROS[unit]:.12g}")
    ratio, own = _factor(written), _factor(unit)
    if not written or ratio is None or own is None:
        return None
    return float(f"{number * ratio / own:.12g}")


def si_unit(unit: str) -> str:
    """Unit in which a bare number stands for the same quantity, without prefixes.

    Examples
    --------
    >>> si_unit("mm^2/s"), si_unit("degC"), si_unit("V/um"), si_unit("rpm")
    ('m^2/s', 'K', 'V/m', 'rad/s')
    """
    if unit in _ZEROS:
        return "K"
    names = {"rpm": "rad/s", "deg": "rad"}
    return names.get(unit) or _PART.sub(lambda found: _si_name(found[1]) + found[0][len(found[1]) :], unit)


def rounded(value: float) -> str:
    """Number of a slider as text, with three digits and without an exponent that nobody needs.

    Examples
    --------
    >>> rounded(12345.0), rounded(0.0312345), rounded(2.0)
    ('12300', '0.0312', '2')
    """
    return f"{float(f'{value:.{_DIGITS}g}'):.12g}"


def _si_name(name: str) -> str:
    base, _ = _base(name)
    return "kg" if base == "g" else base


def _factor(unit: str) -> float | None:
    """Factor to SI units; None for a unit that is not known."""
    unit = unit.translate(_SUPERSCRIPTS)
    if unit in _TURNS:
        return _OTHERS["rpm"]
    factor = 1.0
    for place, part in enumerate(unit.split("/")):
        names = [name for name in re.split(r"[\s*]+", part.replace("**", "^").strip()) if name]
        for name in names:
            found = _PART.fullmatch(name)
            if name == "1" and place == 0:
                continue
            size = None if found is None else _base(found[1])[1]
            if found is None or size is None:
                return None
            exponent = int(found[2] or 1)
            factor *= size ** (-exponent if place else exponent)
    return factor


def _base(name: str) -> tuple[str, float | None]:
    """Name of a unit without its prefix, and its factor to SI units."""
    if name in _OTHERS:
        return name, _OTHERS[name]
    for base in _BASES:
        if name.endswith(base) and name[: -len(base)] in _PREFIXES:
            return base, _PREFIXES[name[: -len(base)]] * (1e-3 if base == "g" else 1.0)
    return name, None
