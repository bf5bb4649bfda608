"""Columns of a measurement: the quantities that are known, their names, units and bounds."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from types import MappingProxyType

from ehlectric.cases.amounts import Amount
from ehlectric.errors import InputError, short, shown
from ehlectric.quantities import units

# Amounts of a measurement by the names of their columns in the program, with SI unit and bounds.
COLUMNS: Mapping[str, Amount] = MappingProxyType(
    {
        "time": Amount("s", least=0.0, most=1e9, reason="since the start of the measurement"),
        "speed": Amount(units.ROTATION, above=0.0, most=1e5, reason="of the inner ring"),
        "entrainment_speed": Amount("m/s", above=0.0, most=1e4, reason="(u1 + u2)/2"),
        "temperature": Amount("K", least=200.0, most=600.0, reason="absolute, of the oil"),
        "frequency": Amount("Hz", above=0.0, most=1e10, reason="of the meter"),
        "capacitance": Amount("F", above=0.0, most=1e-3, reason="of a bearing or contact"),
        "impedance": Amount("ohm", above=0.0, most=1e15, reason="magnitude"),
        "phase": Amount("rad", least=-math.pi, most=math.pi, reason="negative for a capacitor"),
        "film": Amount("m", above=0.0, most=1e-3, reason="central film thickness"),
    }
)

# Names that people write over a column, in small letters and with spaces.
_NAMES = {
    "time": "time",
    "elapsed time": "time",
    "speed": "speed",
    "inner speed": "speed",
    "shaft speed": "speed",
    "rotational speed": "speed",
    "entrainment speed": "entrainment_speed",
    "rolling speed": "entrainment_speed",
    "mean speed": "entrainment_speed",
    "temperature": "temperature",
    "oil temperature": "temperature",
    "frequency": "frequency",
    "capacitance": "capacitance",
    "parallel capacitance": "capacitance",
    "cp": "capacitance",
    "impedance": "impedance",
    "impedance magnitude": "impedance",
    "|z|": "impedance",
    "z": "impedance",
    "phase": "phase",
    "phase angle": "phase",
    "film": "film",
    "film thickness": "film",
    "central film": "film",
    "central film thickness": "film",
}
_UNCERTAINTY = "uncertainty"

# Heads that an error names as examples.
EXAMPLES = "'speed [rpm]' and 'capacitance [pF]', or 'entrainment speed [m/s]' and 'film [nm]'"

# Unit that stands for each quantity in the advice of an error.
_USUAL = {"time": "s", "speed": "rpm", "entrainment_speed": "m/s", "temperature": "degC", "frequency": "Hz"}
_USUAL |= {"capacitance": "pF", "impedance": "ohm", "phase": "deg", "film": "nm"}

# Longest head of a column [characters].
_LONGEST = 200


@dataclass(frozen=True)
class Column:
    """Column of a measurement, by its head.

    Attributes
    ----------
    name : str
        Name of the quantity, one of ``COLUMNS``; of an uncertainty that of the quantity, or "" for the
        measured one.
    head : str
        Head as it is written over the column.
    unit : str
        Unit in the head; "%" of a relative uncertainty.
    uncertainty : bool
        Whether the column has standard uncertainties.
    """

    name: str
    head: str
    unit: str
    uncertainty: bool = False

    def factor(self) -> float:
        """Factor from the unit of the column to the SI unit; 0.01 for per cent.

        Raises
        ------
        ValueError
            If the unit is not one of the quantity; the message says why.
        """
        if self.unit == "%":
            return 0.01
        return _factor(_plain(self.unit), COLUMNS[self.name].unit)

    def value(self, number: float) -> float:
        """Value in SI units of a number in the unit of the column; an uncertainty stays a difference.

        Raises
        ------
        ValueError
            If the unit is not one of the quantity, or the value is out of its bounds.
        """
        if self.uncertainty:
            return self._positive(number * self.factor())
        bounds = COLUMNS[self.name]
        value = units.absolute(number, self.unit) if bounds.unit == "K" else number * self.factor()
        if not (bounds.above < value < bounds.below and bounds.least <= value <= bounds.most):
            least = f"above {bounds.above:g}" if math.isfinite(bounds.above) else f"at least {bounds.least:g}"
            unit = f" {bounds.unit}"
            raise ValueError(f"{least}{unit} and at most {bounds.most:g}{unit}: {bounds.reason}")
        return value

    def _positive(self, value: float) -> float:
        if not 0.0 < value < math.inf:
            raise ValueError("an uncertainty above 0")
        return value


@lru_cache(maxsize=64)
def _factor(written: str, unit: str) -> float:
    """Factor from a unit to an SI unit; a column asks for it once a row."""
    return units.factor(written, unit)


def column_of(head: str) -> Column | None:
    """Column by its head, such as "speed [rpm]" or "capacitance (pF)"; None for an unknown quantity.

    Parameters
    ----------
    head : str
        Head of the column: a name, and a unit in brackets. Names are not case-sensitive.

    Returns
    -------
    Column or None
        Column of a known quantity or of its uncertainty.

    Raises
    ------
    InputError
        If the quantity is known, but its unit is missing or is not one of the quantity.

    Examples
    --------
    >>> column_of("Capacitance [pF]").name, column_of("uncertainty [%]").uncertainty
    ('capacitance', True)
    >>> column_of("speed [m/s]").name
    'entrainment_speed'
    >>> column_of("remark") is None
    True
    """
    text = " ".join(head[: _LONGEST + 1].strip().strip("\"'").split())
    if len(text) > _LONGEST:
        return None
    name, unit = _parts(text)
    bare = " ".join(name.lower().replace("_", " ").split())
    uncertain = _UNCERTAINTY in bare
    words = bare.replace(_UNCERTAINTY + " of", "").replace(_UNCERTAINTY, "").strip()
    if words not in _NAMES and not (uncertain and not words):
        return None
    known = _NAMES.get(words, "")
    if unit is None:
        usual = "%" if uncertain else _USUAL[known]
        raise InputError(
            f"column {shown(text)}", "has no unit", takes=f"a unit in brackets, as '{name} [{usual}]'"
        )
    if uncertain:
        return Column(known, text, unit, uncertainty=True)
    return _checked(known, text, unit)


def _parts(text: str) -> tuple[str, str | None]:
    """Name and unit of a head: the unit stands in the last brackets."""
    for opening, closing in (("[", "]"), ("(", ")")):
        start = text.rfind(opening)
        if start >= 0 and text.endswith(closing):
            return text[:start].strip(), text[start + 1 : -1].strip()
    return text, None


def _checked(name: str, head: str, unit: str) -> Column:
    """Column whose unit belongs to its quantity; a speed in m/s is an entrainment speed."""
    reasons = []
    for candidate in (name, "entrainment_speed") if name == "speed" else (name,):
        column = Column(candidate, head, unit)
        try:
            if COLUMNS[candidate].unit == "K":
                units.absolute(0.0, unit)
            else:
                column.factor()
        except ValueError as error:
            reasons.append(str(error))
        else:
            return column
    raise InputError(
        f"column {shown(head)}", f"has the unit {shown(unit)} ({short(reasons[0])})", takes=_USUAL[name]
    )


def _plain(unit: str) -> str:
    """Unit in the spelling of pint: people write Ohm, and a degree sign for an angle."""
    text = units.plain(unit).replace("Ohm", "ohm").replace("Ω", "ohm").replace("\u2126", "ohm")
    return "deg" if text == "°" else text
