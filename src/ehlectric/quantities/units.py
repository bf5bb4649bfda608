"""Units: numbers with units as people write them, factors to SI units, and prefixed units to show."""

from __future__ import annotations

import math
import re
import sys
from functools import cache
from typing import TYPE_CHECKING, TypeGuard

from ehlectric.errors import InputError, short, shown

if TYPE_CHECKING:
    import pint

# Unit of a rotational speed, and its factor from revolutions per minute.
ROTATION = "rad/s"
RPM = math.pi / 30.0

# Products and quotients of up to eight named units with one-digit exponents. No quantity here needs other
# units, and pint would compute for ever on nested exponents, and on long names and products.
_NAME = r"[A-Za-zµμΩ°]{1,40}+(?:(?:\*\*|\^)?[-+]?[1-9])?"
_UNIT = re.compile(rf"(?:1?\s*+/\s*+)?{_NAME}(?:(?:\s*+[*/·]\s*+|\s++){_NAME}){{0,7}}")
_EXPONENT = re.compile(r"(?<=[A-Za-zµμΩ°])(?:\*\*|\^)?([-+]?[1-9])")
_ANGLE = re.compile("rad|rpm|rev|turn|deg")

# Superscript exponents as in GPa⁻¹, and the minus sign that is no hyphen.
_SUPERSCRIPT = re.compile("[⁺⁻]?[⁰¹²³⁴⁵⁶⁷⁸⁹]+")
_PLAIN = str.maketrans("⁺⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "+-0123456789")

# Revolutions per minute as catalogues and machines print them, in small letters and without spaces.
_TURNS = ("rpm", "r/min", "rev/min", "u/min", "1/min", "/min", "min^-1", "min-1", "min**-1")

# Frequent mistakes, by the SI unit of the quantity: unit of another quantity that users write, and advice.
_HINTS = {
    "Pa*s": ("m**2/s", "multiply a kinematic viscosity by the density"),
    "m/s": ("1/s", "multiply a rotational speed, in rad/s, by the radius"),
    "N/m": ("N", "divide a load by the length of the line"),
}

# Units of an absolute temperature, and the zero point of each unit [K].
_ZEROS = {"K": 0.0, "degC": 273.15, "°C": 273.15, "C": 273.15}

# Factors of the units of most files, by written unit and SI unit: pint takes half a second to load.
FREQUENT = {
    ("mm", "m"): 1e-3,
    ("um", "m"): 1e-6,
    ("nm", "m"): 1e-9,
    ("inch", "m"): 0.0254,
    ("deg", "rad"): 0.017453292519943295,
    ("N", "N"): 1.0,
    ("kN", "N"): 1e3,
    ("kN/m", "N/m"): 1e3,
    ("MN/m", "N/m"): 1e6,
    ("m/s", "m/s"): 1.0,
    ("rpm", ROTATION): 0.10471975511965977,  # as pint rounds it
    ("GPa", "Pa"): 1e9,
    ("MPa", "Pa"): 1e6,
    ("1/GPa", "1/Pa"): 1e-9,
    ("mPa s", "Pa*s"): 1e-3,
    ("Pa s", "Pa*s"): 1.0,
    ("mm^2/s", "m**2/s"): 1e-6,
    ("kg/m^3", "kg/m**3"): 1.0,
    ("1/K", "1/K"): 1.0,
    ("s", "s"): 1.0,
    ("ms", "s"): 1e-3,
    ("us", "s"): 1e-6,
    ("ns", "s"): 1e-9,
    ("V", "V"): 1.0,
    ("mV", "V"): 1e-3,
    ("kV", "V"): 1e3,
    ("V/um", "V/m"): 1e6,
    ("A", "A"): 1.0,
    ("pF", "F"): 1e-12,
    ("nF", "F"): 1e-9,
    ("pS/m", "S/m"): 1e-12,
}

# Prefixes by their factor.
_PREFIXES = {1e9: "G", 1e6: "M", 1e3: "k", 1.0: "", 1e-3: "m", 1e-6: "µ", 1e-9: "n", 1e-12: "p"}

# Groups that are never given up, "++" and the like, keep the time proportional to the length of the text.
_NUMBER_AND_UNIT = re.compile(r"([-+]?(?:\d++\.?\d*+|\.\d++)(?:[eE][-+]?\d++)?+)\s*+(.*)")

# Longest text of a number with its unit [characters].
LONGEST = 200

_COMMA = re.compile(r"\s*+([-+]?\d++),(\d++)((?:[eE][-+]?\d++)?(?![,\d]).*)", re.DOTALL)


def rpm(speed: float) -> float:
    """Rotational speed in revolutions per minute, from rad/s."""
    return speed / RPM


def rpm_text(speed: float) -> str:
    """Speed [rad/s] as text in revolutions per minute, rounded to three digits.

    Examples
    --------
    >>> rpm_text(144.38)
    '1380'
    """
    return f"{float(f'{rpm(speed):.3g}'):.10g}"


@cache
def registry() -> pint.UnitRegistry[float]:
    """Registry of units, made when it is first needed, because importing pint takes a while."""
    import pint

    return pint.UnitRegistry()


def plain(text: str) -> str:
    """Text with its superscripts as exponents and with ordinary minus signs.

    Examples
    --------
    >>> plain("22 GPa⁻¹")
    '22 GPa^-1'
    """
    return _SUPERSCRIPT.sub(lambda found: "^" + found[0].translate(_PLAIN), text).replace(
        "\N{MINUS SIGN}", "-"
    )


def comma_advice(text: str) -> str | None:
    """Advice for a number with a decimal comma; None for other texts.

    Examples
    --------
    >>> comma_advice("14,1 mm")
    'decimal comma: write 14.1 mm'
    >>> comma_advice("1,000 mm")
    'decimal comma: write 1.000 mm, or 1000 mm if the comma separates thousands'
    """
    found = _COMMA.fullmatch(text)
    if found is None:
        return None
    whole, part, rest = found.groups()
    rest = rest.rstrip()
    thousand = f", or {short(whole + part + rest)} if the comma separates thousands" if len(part) == 3 else ""
    return f"decimal comma: write {short(f'{whole}.{part}{rest}')}{thousand}"


def factor(written: str, unit: str) -> float:
    """Factor that converts a value from the unit ``written`` to the SI unit ``unit``.

    Parameters
    ----------
    written : str
        Unit that a user wrote, with superscripts replaced by ``plain``.
    unit : str
        SI unit of the quantity, as pint writes it.

    Returns
    -------
    float
        Factor, in ``unit`` per ``written``.

    Raises
    ------
    ValueError
        If the text is not a unit, or not one of this quantity; the message says why.

    Examples
    --------
    >>> factor("1/GPa", "1/Pa")
    1e-09
    >>> round(factor("min^-1", "rad/s"), 6)
    0.10472
    """
    known = FREQUENT.get((written, unit))
    if known is not None:
        return known
    import pint

    if unit == ROTATION:
        written = _rotation(written)
    if _UNIT.fullmatch(written) is None:
        raise ValueError(f"{shown(written)} is not a unit")
    named = _EXPONENT.sub(r"**\1", written).removeprefix("1").lstrip()
    expression = f"1{named}" if named.startswith("/") else named
    try:
        return float(registry().Quantity(1.0, registry().parse_units(expression)).to(unit).magnitude)
    except pint.DimensionalityError:
        other, hint = _HINTS.get(unit, ("", ""))
        mistaken = other and registry().Quantity(1.0, expression).check(other)
        advice = f"; {hint}" if mistaken else ""
        raise ValueError(f"{short(written)} is not a unit of this quantity{advice}") from None
    except pint.UndefinedUnitError:
        raise ValueError(f"{shown(written)} is not a unit; units are case-sensitive") from None
    except pint.PintError:
        raise ValueError(f"{shown(written)} is not a unit") from None


def _rotation(written: str) -> str:
    """Unit of a rotational speed as pint knows it.

    Angles are dimensionless in pint, which would convert 50 Hz to 50 rad/s. A reciprocal minute counts
    revolutions on every machine; hertz and reciprocal seconds are in use for both.
    """
    if written.replace(" ", "").lower() in _TURNS:
        return "rpm"
    if _UNIT.fullmatch(written) is not None and _ANGLE.search(written) is None:
        raise ValueError(
            f"{short(written)} is a frequency, which may count turns or radians: "
            "write rpm, min^-1, rad/s or deg/s"
        )
    return written


def absolute(number: float, written: str) -> float:
    """Convert an absolute temperature to kelvin: 70 degC is 343.15 K, not a difference of 70 K.

    Raises
    ------
    ValueError
        If ``written`` is not a unit of an absolute temperature.
    """
    if written not in _ZEROS:
        raise ValueError(f"{shown(written)} is not a unit of an absolute temperature: {', '.join(_ZEROS)}")
    return float(f"{number + _ZEROS[written]:.15g}")


def is_pint(entry: object) -> TypeGuard[pint.Quantity[float]]:
    """Whether an entry is a quantity of pint."""
    module = sys.modules.get("pint")
    return module is not None and isinstance(entry, module.Quantity)


# Parts of the names of temperature scales, in small letters.
_SCALES = ("degc", "°c", "celsius", "degree_c", "degf", "°f", "fahrenheit", "degree_f")


def on_scale(entry: object) -> bool:
    """Whether an entry is a temperature in degrees of a scale that has a zero of its own.

    Examples
    --------
    >>> on_scale("48 degC"), on_scale("48 K"), on_scale(48.0)
    (True, False, False)
    """
    unit = entry if isinstance(entry, str) else str(entry.units) if is_pint(entry) else ""
    return "delta" not in unit and any(scale in unit.casefold() for scale in _SCALES)


def from_pint(entry: pint.Quantity[float], unit: str) -> float:
    """Convert a quantity of pint, of any registry, to a value in an SI unit.

    Parameters
    ----------
    entry : pint.Quantity
        Quantity with a single number.
    unit : str
        SI unit of the quantity, as pint writes it; empty for a dimensionless quantity.

    Returns
    -------
    float
        Value in ``unit``.

    Raises
    ------
    ValueError
        If the quantity has another dimension, or leaves open what is meant.
    """
    import pint

    written = str(entry.units)
    if unit == "K" and "delta" in written:
        raise ValueError(f"{written} is a difference of temperatures")
    if not unit and written not in ("dimensionless", "percent"):
        raise ValueError(f"{written} is a unit, and this number has none")
    try:
        value = float(entry.to(unit or "dimensionless").magnitude)
    except pint.DimensionalityError:
        raise ValueError(f"{written} is not a unit of this quantity") from None
    except TypeError:
        raise ValueError("it is not a single number") from None
    if unit == ROTATION and _ANGLE.search(written) is None:
        raise ValueError(f"{written} is a frequency, which may count turns or radians: use rpm or rad/s")
    return float(f"{value:.15g}")


def unit_for(largest: float, unit: str, *, least: float = 0.1) -> tuple[float, str]:
    """Factor from ``unit`` to a prefixed unit in which ``largest`` is at least ``least``, and this unit."""
    size = next((p for p in _PREFIXES if least * p <= largest), 1e-12)
    prefixed = _PREFIXES[size] + unit
    # Dielectric strengths are usually given in V/µm.
    return 1.0 / size, "V/µm" if prefixed == "MV/m" else prefixed


def to_si(text: str, unit: str) -> float:
    """Convert a string such as "1.57 MN/m" to a value in an SI unit.

    Parameters
    ----------
    text : str
        Number and unit.
    unit : str
        SI unit of the quantity, as pint writes it.

    Returns
    -------
    float
        Value in ``unit``.

    Raises
    ------
    ValueError
        If the string is not a number with a unit of the right dimension; the message says why.

    Examples
    --------
    >>> to_si("22 1/GPa", "1/Pa")
    2.2e-08
    """
    number, written = _split(text)
    if not written:
        raise ValueError("it has no unit")
    if unit == "K":
        return absolute(number, written)
    ratio = factor(written, unit)
    # Fifteen digits remove the rounding error of factors such as 1e-3, which are not binary numbers. A number
    # in the SI unit itself stays as it is: it may have been written by ``to_toml``.
    return number if ratio == 1.0 else float(f"{number * ratio:.15g}")


def _split(text: str, otherwise: str = "it is not a number with a unit") -> tuple[float, str]:
    """Number and unit in a text; raises ValueError, with advice or the given words, if it has none."""
    if len(text) > LONGEST:
        raise ValueError(f"it has {len(text)} characters, which is too long")
    found = _NUMBER_AND_UNIT.fullmatch(plain(text).strip())
    advice = comma_advice(text)
    if found is None or advice:
        raise ValueError(advice or otherwise)
    return float(found[1]), found[2]


def to_fraction(text: str) -> float:
    """Convert a string in percent to a fraction.

    Parameters
    ----------
    text : str
        Number, followed by "%" or "percent".

    Returns
    -------
    float
        Fraction, dimensionless.

    Raises
    ------
    ValueError
        If the string is not a number in percent. Other dimensionless units, such as rad, are refused.

    Examples
    --------
    >>> to_fraction("3 %")
    0.03
    """
    number, written = _split(text, "it is not a number in percent")
    if written not in ("%", "percent"):
        raise ValueError("it is not a number in percent")
    return float(f"{number / 100.0:.15g}")


def length_unit(text: str) -> str:
    """Check that a string is a unit of length, and return it.

    Raises
    ------
    InputError
        If the string is not a unit of length.

    Examples
    --------
    >>> length_unit("um")
    'um'
    """
    try:
        to_si(f"1 {text}", "m")
    except ValueError as error:
        raise InputError(got=f"{shown(text)} ({error})", takes="a unit of length such as 'um'") from None
    return text
