"""Labels of inputs and results: name, symbol and unit of a dotted key, and how values are shown."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing.keys import BEARING_KEYS
from ehlectric.cases.any_case import AnyCase
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.keys import INPUT_NAMES, kind_of, unit_of
from ehlectric.cases.lubricant import law_parameters
from ehlectric.cases.result_key import Keys, key_of
from ehlectric.contact.keys import CONTACT_KEYS
from ehlectric.motion.keys import MOTION_KEYS

# Units that are never prefixed: of none, of angles, and of absolute temperatures.
_PLAIN = ("", "deg", "K", "rad")


@dataclass(frozen=True)
class Label:
    """A key as it is shown.

    Attributes
    ----------
    name, symbol : str
        As "load per length" and "$w$"; the dotted key and none where it has no name of its own.
    unit : str
        SI unit as pint writes it; empty where there is none, or it is not known.
    """

    name: str
    symbol: str
    unit: str

    def scaled(self, values: Array) -> Scale:
        """The unit in which values, SI, are numbers that can be read; those not finite do not count."""
        finite = np.abs(values[np.isfinite(values)])
        return scale_for(float(np.max(finite, initial=0.0)) or 1.0, self.unit)

    def axis(self, scale: Scale) -> str:
        """Label of an axis in that unit."""
        return " ".join(filter(None, [self.name, self.symbol, f"[{scale.unit}]" if scale.unit else ""]))


@dataclass(frozen=True)
class Scale:
    """A unit to show values in, and what SI values are multiplied with."""

    factor: float
    unit: str

    def text(self, value: Any) -> str:
        """A value, SI, with its unit; a text as it is."""
        if not isinstance(value, int | float):
            return str(value)
        return f"{value * self.factor:.4g} {self.unit}".rstrip()


# Not prefixed either: limits of a current density are published in A/mm^2, and speeds are told in rpm.
_OWN = {"A/m**2": Scale(1e-6, "A/mm²"), "rad/s": Scale(30.0 / np.pi, "rpm")}


def label_of(key: str, case: AnyCase) -> Label:
    """Name, symbol and unit of a varied key or of a value of the summary.

    Parameters
    ----------
    key : str
        Dotted key of the case or of the summary; "inputs." before one of the case makes no difference.
    case : Case or BearingCase
        Case of a line or a point contact, with or without motion, or of a bearing.

    Returns
    -------
    Label
        A key that is neither an input nor in the tables of result keys has itself as name, and no unit.
    """
    own = key.removeprefix("inputs.")
    if kind_of(own) is not None or own in INPUT_NAMES:
        parameter = law_parameters().get(own.removeprefix("lubricant."))
        if parameter is not None and parameter.title:
            return Label(parameter.title, parameter.symbol, unit_of(own))
        return Label(*INPUT_NAMES.get(own, (own, "")), unit_of(own))
    if own != key:
        return Label(key, "", unit_of(own))
    found = key_of(result_keys(case), key)
    return Label(key, "", "") if found is None else Label(found.name or key, found.symbol, found.unit)


def result_keys(case: AnyCase) -> Keys:
    """Keys of the summary that a case leads to.

    Parameters
    ----------
    case : Case or BearingCase
        Case of a contact or of a bearing.

    Returns
    -------
    mapping of str to ResultKey
        Keys of a line or a point contact, stationary or moving, or of a bearing.
    """
    if isinstance(case, BearingCase):
        return BEARING_KEYS
    return (CONTACT_KEYS if case.motion is None else MOTION_KEYS)[case.contact.geometry]


def scale_for(largest: float, unit: str) -> Scale:
    """Prefix of a unit by the largest of the values.

    Parameters
    ----------
    largest : float
        Above 0, SI.
    unit : str
        SI unit as pint writes it.

    Returns
    -------
    Scale
        With the unit as it is printed.

    Examples
    --------
    >>> scale_for(2.2e-8, "1/Pa")
    Scale(factor=1000000000.0, unit='1/GPa')
    >>> scale_for(3e-12, "m**2")
    Scale(factor=1000000000000.0, unit='µm²')
    >>> scale_for(0.04, "Pa*s")
    Scale(factor=1000.0, unit='mPa s')
    """
    if unit in _PLAIN:
        return Scale(1.0, unit)
    if unit in _OWN:
        return _OWN[unit]
    # With it comes matplotlib, which names and units alone do not take.
    from ehlectric.cases.quantity import unit_for

    if unit.startswith("1/"):
        # One over a value in the prefixed unit: the prefix of what is below the line.
        factor, prefixed = unit_for(1.0 / largest, unit[2:], least=0.001)
        return Scale(round_factor(1.0 / factor), f"1/{prefixed}")
    base, power = (unit[:-3], int(unit[-1])) if unit in ("m**2", "m**3") else (unit, 1)
    if unit == "s":
        largest = min(largest, 1.0)
    factor, prefixed = unit_for(largest ** (1.0 / power), base)
    return Scale(round_factor(factor) ** power, _printed(prefixed) + {1: "", 2: "²", 3: "³"}[power])


def round_factor(factor: float) -> float:
    """The power of ten that a factor is, without the rounding of one over a negative power.

    Examples
    --------
    >>> round_factor(1 / 1e-6)
    1000000.0
    """
    return float(f"{factor:.9g}")


def _printed(unit: str) -> str:
    """A unit of pint's as it is printed."""
    return unit.replace("**3", "³").replace("**2", "²").replace("*", " ").replace("ohm", "Ω")
