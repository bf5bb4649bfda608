"""Labels of inputs and results: name, symbol and unit of a dotted key, and prefixed units for its values."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.bearings.case import BearingCase
from ehlectric.cases.drives.case import DriveCase
from ehlectric.cases.drives.swept import SweptCase
from ehlectric.cases.input_keys import end_and_key, kind_of, unit_of
from ehlectric.cases.keywords.names import INPUT_NAMES
from ehlectric.cases.oils.laws import law_parameters
from ehlectric.quantities.bearing_results import BEARING_KEYS
from ehlectric.quantities.contact_results import CONTACT_KEYS
from ehlectric.quantities.drive_results import DRIVE_KEYS, NAMES_OF_ENDS
from ehlectric.quantities.motion_results import MOTION_KEYS
from ehlectric.quantities.quantity import Keys, key_of

# Units without prefixes: none, angles, absolute temperatures and their inverse, and events per second.
_PLAIN = ("", "deg", "K", "rad", "1/K", "1/s")


@dataclass(frozen=True)
class Label:
    """Name, symbol and unit of a key for tables and figures.

    Attributes
    ----------
    name : str
        Name, such as "load per length"; the dotted key itself if it has no name.
    symbol : str
        Symbol, such as "$w$"; may be empty.
    unit : str
        SI unit in the notation of pint; empty for dimensionless values, or if the unit is not known.
    """

    name: str
    symbol: str
    unit: str

    def scaled(self, values: Array) -> Scale:
        """Prefixed unit that suits the largest of some SI values; values that are not finite are ignored."""
        finite = np.abs(values[np.isfinite(values)])
        return scale_for(float(np.max(finite, initial=0.0)) or 1.0, self.unit)

    def axis(self, scale: Scale) -> str:
        """Label of an axis: name, symbol and the unit of ``scale``."""
        return " ".join(filter(None, [self.name, self.symbol, f"[{scale.unit}]" if scale.unit else ""]))


@dataclass(frozen=True)
class Scale:
    """Unit in which values are shown.

    Attributes
    ----------
    factor : float
        Factor from values in SI units to values in this unit.
    unit : str
        Unit as printed, such as "µm".
    offset : float
        Number added after the multiplication, for temperatures in °C.
    """

    factor: float
    unit: str
    offset: float = 0.0

    def of(self, values: Any) -> Any:
        """Numbers of SI values in this unit.

        Examples
        --------
        >>> round(CELSIUS.of(343.15), 9), Scale(1e6, "µm").of(2e-6)
        (70.0, 2.0)
        """
        return self.factor * values + self.offset

    def text(self, value: Any) -> str:
        """Text of an SI value in this unit, with four digits; a text is returned unchanged."""
        if not isinstance(value, int | float):
            return str(value)
        return f"{self.of(value):.4g} {self.unit}".rstrip()


# Absolute temperatures in figures.
CELSIUS = Scale(1.0, "°C", -273.15)

# Other units without prefixes: limits of current density are published in A/mm^2, shaft speeds in rpm, and
# kinematic viscosities in mm^2/s.
_OWN = {
    "A/m**2": Scale(1e-6, "A/mm²"),
    "rad/s": Scale(30.0 / np.pi, "rpm"),
    "m**2/s": Scale(1e6, "mm²/s"),
}


def label_of(key: str, case: SweptCase) -> Label:
    """Name, symbol and unit of a varied key or of a value of the summary.

    Parameters
    ----------
    key : str
        Dotted key of the case or of the summary. A key of the case may have the prefix "inputs.", as in the
        summary.
    case : Case, BearingCase or DriveCase
        Case of a line or point contact, with or without motion, of a bearing or of a drive.

    Returns
    -------
    Label
        Label of the key. A key that is neither an input nor a documented result has itself as name, and no
        unit.
    """
    own = _counted_from_one(key.removeprefix("inputs.")) if key.startswith("inputs.") else key
    end, input_key = end_and_key(own)
    if kind_of(own) is not None or input_key in INPUT_NAMES:
        return _of_input(input_key, unit_of(own), NAMES_OF_ENDS.get(end, ""))
    if own != key:
        return Label(key, "", unit_of(own))
    result = key_of(result_keys(case), key)
    return Label(key, "", "") if result is None else Label(result.label or key, result.symbol, result.unit)


def _counted_from_one(key: str) -> str:
    """Key of an input from its key in the summary, whose rough surfaces are counted from zero."""
    table, _, rest = key.partition(".")
    number, dot, name = rest.partition(".")
    return f"{table}.{int(number) + 1}.{name}" if table == "roughness" and dot and number.isdecimal() else key


def _of_input(key: str, unit: str, end: str) -> Label:
    """Label of an input, with the end of a drive at which its bearing is."""
    parameter = law_parameters().get(key.removeprefix("lubricant."))
    if parameter is not None and parameter.title:
        name, symbol = parameter.title, parameter.symbol
    else:
        name, symbol = INPUT_NAMES.get(key, (key, ""))
    return Label(f"{name}, {end}" if end else name, symbol, unit)


def result_keys(case: SweptCase) -> Keys:
    """Documented keys of the summary of a case.

    Parameters
    ----------
    case : Case, BearingCase or DriveCase
        Case of a contact, of a bearing or of a drive.

    Returns
    -------
    mapping of str to Quantity
        Keys of a line or point contact, stationary or transient, of a bearing or of a drive.
    """
    if isinstance(case, BearingCase):
        return BEARING_KEYS
    if isinstance(case, DriveCase):
        return DRIVE_KEYS
    return (CONTACT_KEYS if case.motion is None else MOTION_KEYS)[case.contact.geometry]


def scale_for(largest: float, unit: str) -> Scale:
    """Prefixed unit that suits values up to ``largest``.

    Parameters
    ----------
    largest : float
        Largest of the values, in SI units, > 0.
    unit : str
        SI unit in the notation of pint.

    Returns
    -------
    Scale
        Prefixed unit as printed, and the factor from SI values to it.

    Examples
    --------
    >>> scale_for(2.2e-8, "1/Pa")
    Scale(factor=1000000000.0, unit='1/GPa', offset=0.0)
    >>> scale_for(3e-12, "m**2")
    Scale(factor=1000000000000.0, unit='µm²', offset=0.0)
    >>> scale_for(0.04, "Pa*s")
    Scale(factor=1000.0, unit='mPa s', offset=0.0)
    """
    if unit in _PLAIN:
        return Scale(1.0, unit)
    if unit in _OWN:
        return _OWN[unit]
    if unit.startswith("kg"):
        return Scale(1.0, _printed(unit))  # it has a prefix
    # Imported here because it imports matplotlib, which tables of names and units do not need.
    from ehlectric.quantities.units import unit_for

    if unit.startswith("1/"):
        # The prefix belongs to the unit in the denominator.
        factor, prefixed = unit_for(1.0 / largest, unit[2:], least=0.001)
        return Scale(round_factor(1.0 / factor), f"1/{prefixed}")
    base, power = (unit[:-3], int(unit[-1])) if unit in ("m**2", "m**3") else (unit, 1)
    if unit == "s":
        largest = min(largest, 1.0)
    factor, prefixed = unit_for(largest ** (1.0 / power), base)
    return Scale(round_factor(factor) ** power, _printed(prefixed) + {1: "", 2: "²", 3: "³"}[power])


def round_factor(factor: float) -> float:
    """Round a power of ten to nine digits, which removes the rounding error of a division.

    Examples
    --------
    >>> round_factor(1 / 1e-6)
    1000000.0
    """
    return float(f"{factor:.9g}")


def _printed(unit: str) -> str:
    """Unit in the notation of pint as printed text."""
    return unit.replace("**3", "³").replace("**2", "²").replace("*", " ").replace("ohm", "Ω")
