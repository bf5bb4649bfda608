"""Values that no machine has, of contacts and bearings alike: mistaken units, and factors of 2 and 1000.

Each quantity has a range in its SI unit. A value outside is allowed, and a warning asks about it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from types import MappingProxyType

import numpy as np

from ehlectric.arrays import Mask, Numbers
from ehlectric.cases.mean_heights import GAUSSIAN, rq_of
from ehlectric.lubricant.oil import Oil
from ehlectric.quantities.formats import CELSIUS, amount
from ehlectric.quantities.result_warnings import WarningCondition
from ehlectric.readable import readable


@dataclass(frozen=True)
class Plausible:
    """Range of a quantity in machines, in its SI unit, and the advice about a value outside."""

    name: str
    low: float
    high: float
    unit: str  # unit in which a text shows the value
    factor: float  # from the SI unit to this unit
    advice: str

    def shown(self, value: float) -> str:
        """Value [SI unit] with its unit."""
        return f"{readable(self.factor * value, 4)} {self.unit}".rstrip()


PLAUSIBLE: Mapping[str, Plausible] = MappingProxyType(
    {
        # Tips of force microscopes have smaller radii, and the largest rolls and gears are near 1 m.
        "radius": Plausible("the reduced radius", 2e-5, 1.0, "m", 1.0, "Check the unit of the radii"),
        # Plastics have 1 to 20 GPa; rubber carries no bearing and no gear; two diamonds have 1.2 TPa.
        "modulus": Plausible("the reduced modulus", 1e9, 1.3e12, "GPa", 1e-9, "Check the unit of the moduli"),
        # Steel on steel at 5 MPa carries less than a millionth of the load of a bearing.
        "pressure": Plausible(
            "the maximum Hertzian pressure", 5e6, 2e10, "MPa", 1e-6, "Check the unit of the load"
        ),
        "speed": Plausible(
            "the entrainment speed",
            1e-6,
            300.0,
            "m/s",
            1.0,
            "Check that it is in m/s, and no rotational speed",
        ),
        # Petrol and liquid refrigerants have 0.2 to 0.6 mPa s, and no oil flows at 10 Pa s.
        "viscosity": Plausible(
            "the viscosity of the oil", 2e-4, 10.0, "Pa s", 1.0, "Check that it is in Pa s, and not in mPa s"
        ),
        # Water has 0.5 1/GPa, and traction fluids in the cold have 60 1/GPa.
        "alpha": Plausible(
            "the pressure-viscosity coefficient",
            4e-10,
            1e-7,
            "1/GPa",
            1e9,
            "Check the unit: 1/GPa, mm²/N or 1/Pa",
        ),
        # Glycols have 40, and water has 80.
        "permittivity": Plausible(
            "the relative permittivity of the oil",
            1.0,
            90.0,
            "",
            1.0,
            "Check that it is the permittivity of the oil",
        ),
        # Ionic liquids have 1 S/m.
        "conductivity": Plausible(
            "the conductivity of the oil", 1e-17, 1.0, "S/m", 1.0, "Check that it is in S/m, and not in pS/m"
        ),
        "strength": Plausible(
            "the dielectric strength",
            1e6,
            1e9,
            "V/µm",
            1e-6,
            "Check that it is in V/µm, and not in V/mm or kV/m",
        ),
        # Ground gears have 1 µm, and polished balls have 3 nm.
        "roughness": Plausible(
            "the roughness Rq", 5e-10, 1e-5, "µm", 1e6, "Check that it is in µm, and not in nm"
        ),
        # Bearings of 300 mm bore have 0.5 mm in class C5.
        "clearance": Plausible(
            "the radial clearance",
            -2e-4,
            6e-4,
            "µm",
            1e6,
            "Check that it is in µm, and is the full diametral play",
        ),
        # Known bearings have 0.55 to 0.95, and thrust needle rollers have 0.36.
        "filling": Plausible(
            "the share of the pitch circle that the elements fill",
            0.3,
            1.1,
            "",
            1.0,
            "Check that element_diameter and pitch_diameter are diameters, and no radii",
        ),
    }
)

# Reduced modulus of steel on steel, 2/E' = 2 (1 - 0.3^2)/E with E from 190 to 215 GPa, without the factor 2
# and with it twice [Pa].
_STEEL = (208e9, 237e9)


def rq_warning_condition(key: str, ra: Numbers | None, factor: Numbers | None) -> Iterator[WarningCondition]:
    """Note that an Rq follows from an Ra [m] of a key, with a given factor or, for None, an assumed one."""
    if ra is not None:
        yield WarningCondition.of(
            np.greater(ra, 0.0),
            "rq-of-ra",
            "assumed" if factor is None else "given",
            key=key,
            rq=1e6 * rq_of(ra, factor),
            ra=1e6 * ra,
            factor=GAUSSIAN if factor is None else factor,
        )


def unusual(key: str, value: Numbers | None) -> Iterator[WarningCondition]:
    """Condition of the warning about a value, or about many, outside the range of ``PLAUSIBLE``.

    Examples
    --------
    >>> from ehlectric.quantities.result_warnings import active
    >>> print(*active(unusual("speed", 3000.0)))  # doctest: +ELLIPSIS
    the entrainment speed is 3000 m/s, above the limit of 300 m/s for machines. Check ...
    """
    if value is None:
        return
    entry = PLAUSIBLE[key]
    for side, limit, where in (
        ("below", entry.low, np.less(value, entry.low)),
        ("above", entry.high, np.greater(value, entry.high)),
    ):
        yield WarningCondition.of(
            where,
            "value-unusual",
            name=entry.name,
            value=lambda: entry.shown(float(np.ravel(value)[0])),
            side=side,
            limit=entry.shown(limit),
            advice=entry.advice,
        )


@dataclass(frozen=True)
class Usual:
    """Range of a value of a machine or its inverter, in its SI unit, and the source of the range."""

    low: float
    high: float
    unit: str
    source: str


# A plate capacitor at the air gap gives the capacitances of the rotor, with a margin of 2: from bores of
# 15 mm, stacks of 10 mm, gaps of 0.3 mm to bores and stacks of 1 m, gaps of 1.5 mm. The winding faces the
# rotor through slot openings, at most a quarter of the bore, and may be shielded.
USUAL: Mapping[str, Usual] = MappingProxyType(
    {
        "winding_rotor_capacitance": Usual(1e-13, 1e-8, "F", "plates of slot openings in bores up to 1 m"),
        "rotor_frame_capacitance": Usual(5e-12, 5e-8, "F", "plates of air gaps, bores of 15 mm to 1 m"),
        "winding_frame_capacitance": Usual(1e-11, 5e-6, "F", "estimate from slot liners"),
        "second_bearing_capacitance": Usual(1e-12, 1e-7, "F", "estimate from bearings of 5 mm to 1 m bore"),
        "cable_capacitance": Usual(5e-12, 2e-6, "F", "0.1 m to 2 km of cable with 50 to 1000 pF/m"),
        "common_mode_voltage": Usual(0.1, 1e4, "V", "half of DC links up to medium voltage"),
        "dc_link": Usual(1.0, 2e4, "V", "batteries to medium-voltage inverters"),
        # Discharges of 5 to 30 V with 0.5 to 3 A have 1.7 to 60 ohm; a factor of 100 is a mistaken unit.
        "arc_resistance": Usual(0.017, 6000.0, "ohm", "100 times either way of Muetze 2004"),
    }
)


def unusual_machine(values: Mapping[str, Numbers | None]) -> Iterator[WarningCondition]:
    """Conditions of the warning about values of a machine by key, at one or many points; see ``USUAL``.

    Examples
    --------
    >>> from ehlectric.quantities.result_warnings import active
    >>> values = {"motor.winding_rotor_capacitance": 40e-9}
    >>> [warning.code for warning in active(unusual_machine(values))]
    ['machine-unusual']
    """
    for key, value in values.items():
        entry = USUAL.get(key.rpartition(".")[2])
        if entry is None or value is None:
            continue
        outside = np.less(value, entry.low) | np.greater(value, entry.high)
        yield WarningCondition.of(
            outside,
            "machine-unusual",
            key=key,
            value=partial(_first_amount, value, outside, entry.unit),
            low=amount(entry.low, entry.unit),
            high=amount(entry.high, entry.unit),
            source=entry.source,
        )


def _first_amount(value: Numbers, where: Mask, unit: str) -> str:
    """First value at which a condition holds, with its unit."""
    values, mask = np.broadcast_arrays(value, where)
    return amount(float(values[mask][0]), unit)


# Temperatures that bearing steel and ordinary oils stand [degC]. DIN 623-1: dimensions are stable up to
# 150 degC (S0), and with the suffix S1 up to 200 degC.
_COLDEST, _HOTTEST = -40.0, 150.0


def extreme(key: str, temperature: Numbers) -> WarningCondition:
    """Condition of the warning about a temperature [K], with its key, that steel and oil do not stand.

    A temperature in kelvin that is given in degrees Celsius also has it.
    """
    celsius = CELSIUS.of(temperature)
    return WarningCondition.of(
        (celsius < _COLDEST) | (celsius > _HOTTEST),
        "temperature-extreme",
        key=key,
        celsius=celsius,
        coldest=_COLDEST,
        hottest=_HOTTEST,
    )


def modulus_of_steel(modulus: float) -> Iterator[WarningCondition]:
    """Note about a reduced modulus [Pa] that is half or twice the modulus of steel on steel.

    Examples
    --------
    >>> from ehlectric.quantities.result_warnings import active
    >>> [condition.situation for condition in modulus_of_steel(115.4e9) if condition.where]
    ['half']
    """
    low, high = _STEEL
    for name, factor in (("half", 0.5), ("twice", 2.0)):
        where = factor * low <= modulus <= factor * high
        yield WarningCondition.of(where, "modulus-factor", name, modulus=modulus / 1e9)


def oil_doubts(oil: Oil) -> Iterator[WarningCondition]:
    """Conditions of the warnings about numbers of an oil at its temperature, at one or at many points."""
    yield from unusual("viscosity", oil.viscosity)
    # An oil whose viscosity does not change with pressure has the coefficient 0.
    yield from unusual("alpha", np.where(np.equal(oil.alpha, 0.0), PLAUSIBLE["alpha"].low, oil.alpha))
    yield from unusual("permittivity", oil.relative_permittivity)
    yield from unusual("conductivity", oil.conductivity)
