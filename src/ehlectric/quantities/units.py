"""Units: numbers with units as people write them, factors to SI units, and prefixed units to show."""

from __future__ import annotations

import math
import re
from functools import cache
from typing import TYPE_CHECKING, TypeGuard

from ehlectric.errors import InputError, short, shown
from ehlectric.quantities.grouped_digits import is_grouped, readings
from ehlectric.quantities.unit_spelling import plain, typed

if TYPE_CHECKING:
    import pint

# Unit of a rotational speed, and its factor from revolutions per minute.
ROTATION = "rad/s"
RPM = math.pi / 30.0

# Products and quotients of up to eight named units with one-digit exponents. No quantity here needs other
# units, and pint would compute endlessly on nested exponents, and on long names and products.
_LETTER = "[A-Za-zµΩ°ÅΔ_]"
_NAME = rf"{_LETTER}{{1,40}}+(?:(?:\*\*|\^)?[-+]?[1-9])?"
_UNIT = re.compile(rf"(?:1?\s*+/\s*+)?{_NAME}(?:(?:\s*+[*/·]\s*+|\s++){_NAME}){{0,7}}")
_EXPONENT = re.compile(rf"(?<={_LETTER})(?:\*\*|\^)?([-+]?[1-9])")
_ANGLE = re.compile("rad|rpm|rev|turn|deg")

_RAISED = str.maketrans("+-0123456789", "⁺⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_WORD = re.compile(rf"{_LETTER}+")

# Revolutions per minute as catalogues and machines print them, in small letters and without spaces.
_TURNS = (
    "rpm",
    "r/min",
    "rev/min",
    "u/min",
    "umdr/min",
    "upm",
    "tr/min",
    "1/min",
    "/min",
    "min^-1",
    "min-1",
    "min**-1",
)

# Frequent mistakes, by the SI unit of the quantity: unit of another quantity that users write, and advice.
_HINTS = {
    "Pa*s": ("m**2/s", "multiply a kinematic viscosity by the density"),
    "m/s": ("1/s", "multiply a rotational speed, in rad/s, by the radius"),
    "N/m": ("N", "divide a load by the length of the line"),
    "N": ("kg", "a mass is not a force: write N, lbf or kgf"),
}

# Zero point of the scale of Celsius [K].
ZERO_CELSIUS = 273.15

# Temperature scales, in the spelling of ``plain``: minus the number of the scale at 0 K, and size of
# a degree [K].
_SCALES = {
    "K": (0.0, 1.0),
    "degC": (ZERO_CELSIUS, 1.0),
    "degF": (459.67, 5.0 / 9.0),
    "degR": (0.0, 5.0 / 9.0),
}
_EXAMPLES = "K, °C or °F"

# Letters that mean coulomb and farad, except in a temperature.
_LETTERS = {"C": "degC", "F": "degF"}

# Units that are read without pint, which takes half a second to load: factor to SI units as a number times a
# power of ten, and the exponents of m, kg, s, A, K, rad and mol. Units of the first table take prefixes.
_PREFIXED: dict[str, tuple[float, int, tuple[int, ...]]] = {
    "m": (1.0, 0, (1, 0, 0, 0, 0, 0, 0)),
    "g": (1.0, -3, (0, 1, 0, 0, 0, 0, 0)),
    "s": (1.0, 0, (0, 0, 1, 0, 0, 0, 0)),
    "A": (1.0, 0, (0, 0, 0, 1, 0, 0, 0)),
    "K": (1.0, 0, (0, 0, 0, 0, 1, 0, 0)),
    "rad": (1.0, 0, (0, 0, 0, 0, 0, 1, 0)),
    "mol": (1.0, 0, (0, 0, 0, 0, 0, 0, 1)),
    "N": (1.0, 0, (1, 1, -2, 0, 0, 0, 0)),
    "Pa": (1.0, 0, (-1, 1, -2, 0, 0, 0, 0)),
    "bar": (1.0, 5, (-1, 1, -2, 0, 0, 0, 0)),
    "J": (1.0, 0, (2, 1, -2, 0, 0, 0, 0)),
    "W": (1.0, 0, (2, 1, -3, 0, 0, 0, 0)),
    "C": (1.0, 0, (0, 0, 1, 1, 0, 0, 0)),
    "V": (1.0, 0, (2, 1, -3, -1, 0, 0, 0)),
    "F": (1.0, 0, (-2, -1, 4, 2, 0, 0, 0)),
    "H": (1.0, 0, (2, 1, -2, -2, 0, 0, 0)),
    "S": (1.0, 0, (-2, -1, 3, 2, 0, 0, 0)),
    "ohm": (1.0, 0, (2, 1, -3, -2, 0, 0, 0)),
    "Ω": (1.0, 0, (2, 1, -3, -2, 0, 0, 0)),
    "Hz": (1.0, 0, (0, 0, -1, 0, 0, 0, 0)),
    "P": (1.0, -1, (-1, 1, -1, 0, 0, 0, 0)),
    "St": (1.0, -4, (2, 0, -1, 0, 0, 0, 0)),
}
_PLAIN_NAMES: dict[str, tuple[float, int, tuple[int, ...]]] = {
    "inch": (0.0254, 0, (1, 0, 0, 0, 0, 0, 0)),
    "in": (0.0254, 0, (1, 0, 0, 0, 0, 0, 0)),
    "thou": (2.54, -5, (1, 0, 0, 0, 0, 0, 0)),
    "microinch": (2.54, -8, (1, 0, 0, 0, 0, 0, 0)),
    "uin": (2.54, -8, (1, 0, 0, 0, 0, 0, 0)),
    "µin": (2.54, -8, (1, 0, 0, 0, 0, 0, 0)),
    "ft": (0.3048, 0, (1, 0, 0, 0, 0, 0, 0)),
    "micron": (1.0, -6, (1, 0, 0, 0, 0, 0, 0)),
    "angstrom": (1.0, -10, (1, 0, 0, 0, 0, 0, 0)),
    "Å": (1.0, -10, (1, 0, 0, 0, 0, 0, 0)),
    "lbf": (4.4482216152605, 0, (1, 1, -2, 0, 0, 0, 0)),
    "kgf": (9.80665, 0, (1, 1, -2, 0, 0, 0, 0)),
    "psi": (6894.757293168361, 0, (-1, 1, -2, 0, 0, 0, 0)),
    "ksi": (6894.757293168361, 3, (-1, 1, -2, 0, 0, 0, 0)),
    "atm": (101325.0, 0, (-1, 1, -2, 0, 0, 0, 0)),
    "min": (60.0, 0, (0, 0, 1, 0, 0, 0, 0)),
    "h": (3600.0, 0, (0, 0, 1, 0, 0, 0, 0)),
    "deg": (math.pi / 180.0, 0, (0, 0, 0, 0, 0, 1, 0)),
    "rpm": (RPM, 0, (0, 0, -1, 0, 0, 1, 0)),
}
_POWERS = {"G": 9, "M": 6, "k": 3, "c": -2, "m": -3, "u": -6, "µ": -6, "n": -9, "p": -12}

# Sign, name and exponent of each factor of a unit.
_FACTOR = re.compile(rf"([*/·\s]*)({_LETTER}+)(?:(?:\*\*|\^)?([-+]?[1-9]))?")

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


def registry() -> pint.UnitRegistry[float]:
    """Registry of units, made when it is first needed, because importing pint takes a while.

    Threads that need it for the first time at once get two registries, whose quantities cannot be combined:
    ask once for each conversion.
    """
    import pint

    return pint.UnitRegistry()


def comma_advice(text: str) -> str | None:
    """Advice for a number with a decimal comma; None for other texts.

    Examples
    --------
    >>> comma_advice("14,1 mm")
    'decimal comma: write 14.1 mm'
    >>> comma_advice("1,000 mm")
    'decimal comma: write 1 mm, or 1000 mm if the comma separates thousands'
    """
    match = _COMMA.fullmatch(typed(text))
    if match is None:
        return None
    whole, part, rest = match.groups()
    rest = rest.rstrip()
    if not is_grouped(f"{whole},{part}"):
        return f"decimal comma: write {short(f'{whole}.{part}{rest}')}"
    decimal, thousands = readings(whole, part, "")
    or_thousands = f", or {short(thousands + rest)} if the comma separates thousands"
    return f"decimal comma: write {short(decimal + rest)}{or_thousands}"


def known_factor(written: str, unit: str) -> float | None:
    """Factor from one written unit to another; None where this module does not know both, or they differ.

    Examples
    --------
    >>> known_factor("kN/mm", "MN/m"), known_factor("r/min", "rpm"), known_factor("furlong", "m")
    (1.0, 1.0, None)
    """
    written = plain(written)
    if unit in (ROTATION, "rpm") and written.replace(" ", "").lower() in _TURNS:
        written = "rpm"
    given, target = _known(written), _known(unit)
    if given is None or target is None or given[2] != target[2]:
        return None
    # A power of ten is read from its text, which rounds it once.
    return given[0] / target[0] * float(f"1e{given[1] - target[1]}")


@cache
def _known(unit: str) -> tuple[float, int, tuple[int, ...]] | None:
    """Number, power of ten and dimensions of a unit in SI units; None where a name in it is not known."""
    text = plain(unit)
    if _UNIT.fullmatch(text) is None:
        return None
    number, power = 1.0, 0
    dimensions: tuple[int, ...] = (0,) * 7
    for sign, name, raised in _FACTOR.findall(text):
        part = _named(name)
        if part is None:
            return None
        exponent = int(raised or 1) * (-1 if "/" in sign else 1)
        number *= part[0] ** exponent
        power += part[1] * exponent
        dimensions = tuple(a + exponent * b for a, b in zip(dimensions, part[2], strict=True))
    return number, power, dimensions


def _named(name: str) -> tuple[float, int, tuple[int, ...]] | None:
    """Entry of a name of a unit, with its prefix."""
    if name in _PLAIN_NAMES or name in _PREFIXED:
        return _PLAIN_NAMES.get(name) or _PREFIXED[name]
    if name[1:] not in _PREFIXED or name[0] not in _POWERS:
        return None
    number, power, dimensions = _PREFIXED[name[1:]]
    return number, power + _POWERS[name[0]], dimensions


def factor(written: str, unit: str) -> float:
    """Factor that converts a value from the unit ``written`` to the SI unit ``unit``.

    Units that this module does not know are read by pint. A ValueError says why a text is not a unit, or not
    one of this quantity.

    Examples
    --------
    >>> factor("1/GPa", "1/Pa")
    1e-09
    >>> round(factor("min^-1", "rad/s"), 6)
    0.10472
    """
    written = plain(written)
    if unit == ROTATION:
        written = _rotation(written)
    if unit == "K" and _SCALES.get(written, (0.0, 1.0))[0]:
        raise ValueError(f"{short(written)} is a temperature, not a difference of temperatures")
    known = known_factor(written, unit)
    if known is not None:
        return known
    if _UNIT.fullmatch(written) is None:
        raise ValueError(f"{shown(written)} is not a unit")
    import pint

    named = _EXPONENT.sub(r"**\1", written).removeprefix("1").lstrip()
    expression = f"1{named}" if named.startswith("/") else named
    known_units = registry()
    try:
        unit_quantity = known_units.Quantity(1.0, known_units.parse_units(expression))
        value = float(unit_quantity.to(unit).magnitude)
    except pint.DimensionalityError:
        other, hint = _HINTS.get(unit, ("", ""))
        mistaken = other and known_units.Quantity(1.0, expression).check(other)
        advice = f"; {hint}" if mistaken else ""
        raise ValueError(f"{short(written)} is not a unit of this quantity{advice}") from None
    except pint.UndefinedUnitError:
        raise ValueError(f"{shown(written)} is not a unit; units are case-sensitive") from None
    except pint.PintError:
        raise ValueError(f"{shown(written)} is not a unit") from None
    if unit == "rad":
        _check_angle(unit_quantity)
    return value


def _check_angle(quantity: pint.Quantity[float]) -> None:
    """Refuse a percentage as an angle, because pint converts 25 percent to 0.25 rad."""
    if "radian" not in str(quantity.to_root_units().units):
        raise ValueError(f"{quantity.units} is not a unit of an angle")


def _rotation(written: str) -> str:
    """Unit of a rotational speed as pint knows it.

    Angles are dimensionless in pint, which would convert 50 Hz to 50 rad/s. A reciprocal minute counts
    revolutions on every machine; hertz and reciprocal seconds are in use for both.
    """
    if written.replace(" ", "").lower() in _TURNS:
        return "rpm"
    if _UNIT.fullmatch(written) is not None and _ANGLE.search(written) is None:
        if is_unit(written, "m/s"):
            raise ValueError(
                f"{short(written)} is a speed of the vehicle or of a surface; give the speed of the shaft"
            )
        raise ValueError(
            f"{short(written)} is a frequency, which may count turns or radians: "
            "write rpm, min^-1, rad/s or deg/s"
        )
    return written


def is_unit(written: str, unit: str) -> bool:
    """Whether a text is a unit of the quantity that has an SI unit.

    Examples
    --------
    >>> is_unit("km/h", "m/s"), is_unit("Hz", "m/s")
    (True, False)
    """
    try:
        factor(written, unit)
    except ValueError:
        return False
    return True


def absolute(number: float, written: str) -> float:
    """Convert an absolute temperature to kelvin: 70 degC is 343.15 K, not a difference of 70 K. Raises
    ValueError if ``written`` is not a unit of an absolute temperature.

    Examples
    --------
    >>> absolute(70.0, "°C"), absolute(158.0, "degF")
    (343.15, 343.15)
    """
    zero, degree = _scale(written)
    return float(f"{(number + zero) * degree:.15g}")


@cache
def _scale(written: str) -> tuple[float, float]:
    """Zero point of a temperature scale, and the size of its degree [K]; pint knows further scales."""
    name = plain(written)
    if scale := _known_scale(name):
        return scale
    if "delta" in name:
        raise ValueError(f"{shown(written)} is a difference of temperatures")
    try:
        return 0.0, factor(name, "K")
    except ValueError:
        raise ValueError(
            f"{shown(written)} is not a unit of an absolute temperature, such as {_EXAMPLES}"
        ) from None


def _known_scale(name: str) -> tuple[float, float] | None:
    """Entry of ``_SCALES`` for a temperature unit in the spelling of ``plain``; None without an entry."""
    return _SCALES.get(_LETTERS.get(name, name))


def difference(text: str) -> float:
    """Convert a difference of temperatures to kelvin: 36 delta_degF are 20 K. Raises ValueError if the text
    is not such a difference.

    Examples
    --------
    >>> difference("20 K"), difference("20 delta_degC"), difference("36 delta_degF")
    (20.0, 20.0, 20.0)
    """
    number, written = _split(text)
    if not written:
        raise ValueError("it has no unit")
    return float(f"{number * factor(written, 'K'):.15g}")


def degree(written: str) -> float | None:
    """Return the size of the degree of a temperature [K] or of a difference; None for another unit.

    Examples
    --------
    >>> degree("K"), degree("°C"), round(degree("delta_degF"), 4), degree("m")
    (1.0, 1.0, 0.5556, None)
    """
    scale = _known_scale(plain(written).removeprefix("delta_"))
    return None if scale is None else scale[1]


def is_pint(entry: object) -> TypeGuard[pint.Quantity[float]]:
    """Whether an entry is a quantity of pint.

    The classes of the entry decide. Another thread may be importing pint, and ``sys.modules`` then contains a
    module without its names; an import waits until it is complete.
    """
    if not any(str(kind.__module__).partition(".")[0] == "pint" for kind in type(entry).__mro__):
        return False
    import pint

    return isinstance(entry, pint.Quantity)


def on_scale(entry: object) -> bool:
    """Whether an entry is a temperature in degrees of a scale that has a zero of its own.

    Examples
    --------
    >>> on_scale("48 degC"), on_scale("48 ℃"), on_scale("48 K"), on_scale(48.0)
    (True, True, False, False)
    """
    if isinstance(entry, str):
        parts_of_entry = split(entry)
        unit = "" if parts_of_entry is None else parts_of_entry[1]
    else:
        unit = str(entry.units) if is_pint(entry) else ""
    return _SCALES.get(plain(unit), (0.0, 1.0))[0] != 0.0


def from_pint(entry: pint.Quantity[float], unit: str, *, difference: bool = False) -> float:
    """Convert a quantity of pint, of any registry, to a value in an SI unit. ``unit``, SI unit of the
    quantity, as pint writes it; empty for a dimensionless quantity. Raises ValueError if the quantity has
    another dimension, or leaves open what is meant.
    """
    import pint

    written = str(entry.units)
    if unit == "K" and "delta" in written and not difference:
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
    if unit == "rad":
        _check_angle(entry)
    return float(f"{value:.15g}")


def unit_for(largest: float, unit: str, *, least: float = 0.1) -> tuple[float, str]:
    """Factor from ``unit`` to a prefixed unit in which ``largest`` is at least ``least``, and this unit; zero
    has no prefix.
    """
    size = 1.0 if largest == 0.0 else next((p for p in _PREFIXES if least * p <= largest), 1e-12)
    prefixed = _PREFIXES[size] + unit
    # Dielectric strengths are usually given in V/µm.
    return 1.0 / size, "V/µm" if prefixed == "MV/m" else prefixed


def to_si(text: str, unit: str) -> float:
    """Convert a string such as "1.57 MN/m" to a value in an SI unit.

    A ValueError says why a string is not a number with a unit of the right dimension.

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
    number, unit = _parts(text, otherwise)
    return float(number), unit


def _parts(text: str, otherwise: str) -> tuple[str, str]:
    """Texts of the number and of the unit in a text, which ``typed`` reads."""
    if len(text) > LONGEST:
        raise ValueError(f"it has {len(text)} characters, which is too long")
    read = typed(text)
    match = _NUMBER_AND_UNIT.fullmatch(read.strip())
    advice = comma_advice(read)
    if match is None or advice:
        raise ValueError(advice or otherwise)
    return match[1], match[2]


def parts(text: str) -> tuple[str, str] | None:
    """Texts of the number and of the unit in a text; None if the text is no number.

    Examples
    --------
    >>> parts("1.80 kN"), parts("70 ℃"), parts("1,8 kN")
    (('1.80', 'kN'), ('70', '°C'), None)
    """
    try:
        return _parts(text, "")
    except ValueError:
        return None


# Texts of an infinite number, in small letters; a plane has an infinite radius.
_INFINITE = re.compile(r"[-+]?(?:inf|infinity|infinite|∞|flat|plane)(?:\s++(.*))?")


def is_infinite(text: str, unit: str) -> bool:
    """Whether a text is an infinite number, with or without a unit that converts to an SI unit.

    Examples
    --------
    >>> is_infinite("inf", "m"), is_infinite("∞ mm", "m"), is_infinite("flat", "m"), is_infinite("inf N", "m")
    (True, True, True, False)
    """
    match = _INFINITE.fullmatch(typed(text[:LONGEST]).strip().lower())
    if match is None:
        return False
    try:
        return not match[1] or factor(match[1], unit) > 0.0
    except ValueError:
        return False


def split(text: str) -> tuple[float, str] | None:
    """Number and unit of a text, the unit as it is written; None where it is no number.

    Examples
    --------
    >>> split("1.8 kN"), split("46 mm²/s"), split("1,8 kN")
    ((1.8, 'kN'), (46.0, 'mm²/s'), None)
    """
    pair = parts(text)
    return None if pair is None else (float(pair[0]), pair[1])


def in_unit(text: str, unit: str) -> float | None:
    """Number of a text in a unit; None where it is no number, or has a unit that is not known here.

    Examples
    --------
    >>> in_unit("1.8 kN", "N"), in_unit("343.15 K", "degC"), in_unit("1800", "N")
    (1800.0, 70.0, None)
    """
    pair = split(text)
    if pair is None or not pair[1]:
        return None
    number, written = pair
    if written == unit:
        return number
    if target := _SCALES.get(plain(unit)):
        known = _known_scale(plain(written))
        kelvin = None if known is None else (number + known[0]) * known[1]
        return None if kelvin is None else float(f"{kelvin / target[1] - target[0]:.12g}")
    ratio = known_factor(written, unit)
    return None if ratio is None else float(f"{number * ratio:.12g}")


def si_unit(unit: str) -> str:
    """SI unit, without prefixes, in which a bare number stands for the same quantity.

    Examples
    --------
    >>> si_unit("mm^2/s"), si_unit("degC"), si_unit("V/um"), si_unit("rpm")
    ('m^2/s', 'K', 'V/m', 'rad/s')
    """
    if plain(unit) in _SCALES:
        return "K"
    names = {"rpm": ROTATION, "deg": "rad"}
    return names.get(unit) or _WORD.sub(lambda match: _si_name(match[0]), unit)


def _si_name(name: str) -> str:
    base = name if name in _PREFIXED or name[1:] not in _PREFIXED else name[1:]
    return "kg" if base == "g" else base


def printed(unit: str) -> str:
    """Unit with the signs that people print, instead of the signs of a keyboard.

    Examples
    --------
    >>> printed("mm^2/s"), printed("V/um"), printed("degF"), printed("1/m**2"), printed("Pa*s")
    ('mm²/s', 'V/µm', '°F', '1/m²', 'Pa s')
    """
    raised = _EXPONENT.sub(lambda match: match[1].translate(_RAISED), unit)
    return _WORD.sub(lambda match: _sign(match[0]), raised.replace("*", " "))


def _sign(name: str) -> str:
    if name in ("degC", "degF"):
        return f"°{name[-1]}"
    name = name.removesuffix("ohm") + "Ω" if name.endswith("ohm") else name
    return f"µ{name[1:]}" if name[0] == "u" and name[1:] in _PREFIXED else name


def rounded(value: float, digits: int = 3) -> str:
    """Number as text with a few digits, and without an exponent that nobody needs.

    Examples
    --------
    >>> rounded(12345.0), rounded(0.0312345), rounded(2.0), rounded(1732.050807, 8)
    ('12300', '0.0312', '2', '1732.0508')
    """
    return f"{float(f'{value:.{digits}g}'):.12g}"


def to_fraction(text: str) -> float:
    """Convert a string in percent to a fraction; a ValueError says that it is no number in percent.

    Other dimensionless units, such as rad, are refused.

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
    """Check that a string is a unit of length, and return it. Raises InputError if the string is not a unit
    of length.

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
