"""Quantities as texts: units in which they are shown, and prefixes that suit a value."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from ehlectric.quantities.quantity import data_file
from ehlectric.quantities.units import ZERO_CELSIUS, printed, rpm, unit_for
from ehlectric.readable import readable


@dataclass(frozen=True)
class Scale:
    """Unit in which values are shown."""

    factor: float
    unit: str  # unit as printed, such as "µm"
    offset: float = 0.0  # number added after the multiplication, for temperatures in °C

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
        return f"{readable(self.of(value), 4)} {self.unit}".rstrip()


# Absolute temperatures.
CELSIUS = Scale(1.0, "°C", -ZERO_CELSIUS)

_READ = data_file("ehlectric.quantities", "shown_units.toml")

# SI unit of each unit that is shown, in the notation of pint, and the factor from the SI unit to it.
UNITS: Mapping[str, tuple[str, float]] = MappingProxyType(
    {name: (unit, factor) for name, (unit, factor) in _READ["units"].items()}
    | {
        f"{prefix}{name}": (unit, 1.0 / size)
        for unit, name in _READ["prefixed"].items()
        for prefix, size in _READ["prefixes"].items()
    }
)

# Units in which quantities of these SI units are shown; others get the prefix that suits the value.
USUAL: Mapping[str, str] = MappingProxyType(_READ["usual"])


def scale_of(unit: str) -> Scale:
    """Scale of a unit of ``UNITS``.

    Examples
    --------
    >>> scale_of("°C").of(300.0), scale_of("nF/m").of(2e-9)
    (26.850000000000023, 2.0)
    """
    return CELSIUS if unit == "°C" else Scale(round_factor(UNITS[unit][1]), unit)


def rpm_text(speed: float) -> str:
    """Speed [rad/s] as text in revolutions per minute, rounded to three digits.

    Examples
    --------
    >>> rpm_text(144.38)
    '1380'
    """
    return readable(rpm(speed))


def speed_text(speed: float, digits: int = 3) -> str:
    """Speed [rad/s] as text with its unit, rounded to three digits, as an interpolated speed deserves.

    Examples
    --------
    >>> speed_text(144.9)
    '1380 rpm'
    """
    return f"{readable(rpm(speed), digits)} rpm"


def operating_point(speed: float, temperature: float, degree: str = "°C") -> tuple[str, str]:
    """Speed [rad/s] and temperature [K] of an operating point as texts, with four digits.

    ``degree`` is the unit of the temperature; lines of Python use "degC", which can be typed.

    Examples
    --------
    >>> operating_point(314.159265, 343.15)
    ('3000 rpm', '70 °C')
    """
    return speed_text(speed, 4), f"{readable(CELSIUS.of(temperature), 4)} {degree}"


def amount(value: float, unit: str) -> str:
    """Value in a prefixed unit that suits it, with four digits.

    Lengths and field strengths below 1 of a unit stay in it, as films do in micrometres.

    Examples
    --------
    >>> amount(7.4e-7, "m"), amount(2.5e6, "V/m"), amount(0.0, "V")
    ('0.74 µm', '2.5 V/µm', '0 V')
    """
    factor, prefixed = suited(value, unit)
    return f"{readable(factor * value, 4)} {prefixed}"


def amount_text(value: float, unit: str) -> str:
    """Value as text: a temperature in °C, a number without a unit, or a value in a prefixed unit.

    Examples
    --------
    >>> amount_text(343.15, "K"), amount_text(0.02, ""), amount_text(2.4e-10, "F")
    ('70 °C', '0.02', '240 pF')
    """
    return CELSIUS.text(value) if unit == "K" else amount(value, unit).rstrip()


def suited(value: float, unit: str) -> tuple[float, str]:
    """Factor from an SI unit to a prefixed unit that suits a value, and this unit.

    Units that have a prefix already, as kg, or a power of their own, as 1/K, get no other one.

    Examples
    --------
    >>> suited(870.0, "kg/m**3"), suited(2.3e-10, "F"), suited(1.069e8, "V/m")
    ((1.0, 'kg/m³'), (1000000000000.0, 'pF'), (1e-06, 'V/µm'))
    """
    if not unit or "**" in unit or unit.startswith(("kg", "1/", "K", "deg", "rad")):
        return 1.0, printed(unit)
    # Dielectric strengths above 100 V/µm stay in V/µm.
    size = min(abs(value), 1e6) if unit == "V/m" else abs(value)
    factor, prefixed = unit_for(size, unit, least=0.1 if unit in ("m", "V/m") else 1.0)
    return round(factor, 12), printed(prefixed)


# Units without prefixes: none, angles, absolute temperatures and their inverse, and events per second.
_PLAIN = ("", "deg", "K", "rad", "1/K", "1/s")

# Other units without prefixes: limits of current density are published in A/mm^2, shaft speeds in rpm, and
# kinematic viscosities in mm^2/s.
_ENGINEERS = ("A/mm²", "rpm", "mm²/s")


# Torque from which a prefix is usual [N m].
_LARGE_TORQUE = 1e4


def scale_for(largest: float, unit: str) -> Scale:
    """Prefixed unit that suits values up to ``largest`` > 0, in SI units, for the numbers of an axis.

    Examples
    --------
    >>> scale_for(2.2e-8, "1/Pa")
    Scale(factor=1000000000.0, unit='1/GPa', offset=0.0)
    >>> scale_for(3e-12, "m**2"), scale_for(2e9, "1/m**2")
    (Scale(factor=1000000000000.0, unit='µm²', offset=0.0), Scale(factor=1e-06, unit='1/mm²', offset=0.0))
    >>> scale_for(0.04, "Pa*s")
    Scale(factor=1000.0, unit='mPa s', offset=0.0)
    >>> scale_for(250.0, "N*m")
    Scale(factor=1.0, unit='N m', offset=0.0)
    """
    if unit in _PLAIN:
        return Scale(1.0, unit)
    if unit == "N*m" and 1.0 <= largest < _LARGE_TORQUE:
        return Scale(1.0, "N m")
    for unit_of_engineers in _ENGINEERS:
        if UNITS[unit_of_engineers][0] == unit:
            return Scale(UNITS[unit_of_engineers][1], unit_of_engineers)
    if unit.startswith("kg"):
        return Scale(1.0, printed(unit))  # it has a prefix
    if unit.startswith("1/"):
        # The prefix belongs to the unit in the denominator.
        below = _prefixed(1.0 / largest, unit[2:], least=0.001)
        return Scale(round_factor(1.0 / below.factor), f"1/{below.unit}")
    return _prefixed(min(largest, 1.0) if unit == "s" else largest, unit)


def _prefixed(value: float, unit: str, least: float = 0.1) -> Scale:
    """Prefixed unit that suits a value > 0; the prefix of an area or a volume is raised to its power."""
    base, power = (unit[:-3], int(unit[-1])) if unit in ("m**2", "m**3") else (unit, 1)
    factor, prefixed = unit_for(value ** (1.0 / power), base, least=least)
    return Scale(round_factor(factor) ** power, printed(prefixed) + {1: "", 2: "²", 3: "³"}[power])


def round_factor(factor: float) -> float:
    """Round a factor to fifteen digits, which removes the rounding error of a division.

    Examples
    --------
    >>> round_factor(1 / 1e-6)
    1000000.0
    """
    return float(f"{factor:.15g}")


# Share of time below which a text gives no number: a hundredth of a per cent.
SELDOM = 1e-4

# End of all texts.
OF_TIME = " of the time"


def time_share_text(share: float) -> str:
    """Share of time as text.

    Examples
    --------
    >>> time_share_text(0.0257), time_share_text(3e-9), time_share_text(0.99999)
    ('2.57 % of the time', 'less than 0.01 % of the time', 'more than 99.99 % of the time')
    """
    if share < SELDOM:
        return f"less than 0.01 %{OF_TIME}"
    if share > 1.0 - SELDOM:
        return f"more than 99.99 %{OF_TIME}"
    digits = ".3g" if share < 0.99 else ".4g"
    return f"{100.0 * share:{digits}} %{OF_TIME}"
