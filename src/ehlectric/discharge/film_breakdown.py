"""Breakdown of a film: voltage, probability, position, and fields that no film of a liquid withstands."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ehlectric.arrays import Array, Numbers
from ehlectric.cases.discharge_inputs import Discharge
from ehlectric.discharge.discharge_laws import (
    BREAKING,
    LARGEST_PIT,
    MEAN_PIT,
    Size,
    WeakestLink,
    breakdown_voltage,
)
from ehlectric.discharge.film_capacitance import at_columns
from ehlectric.field import ATOM, areas
from ehlectric.quantities.result_warnings import WarningCondition

if TYPE_CHECKING:
    from ehlectric.field import Field, PointField
    from ehlectric.film import Film, PointFilm

# Field strength that no film of a liquid between rough metals carries [V/m]. By Fowler and Nordheim's law of
# field emission, in the form of Proc. R. Soc. A 124 (1929) 699, a metal with a work function of 4.5 eV emits
# 0.003 A/mm^2 at 3000 V/um, and 40 A/mm^2 at 5000 V/um. Asperities raise a field at least threefold.
MOST_OF_LIQUIDS = 1e9


def field_warning_conditions(max_strength: Numbers | None, check: str) -> Iterator[WarningCondition]:
    """Warning of a maximum field strength that no film of a liquid carries. ``max_strength``, maximum field
    strength at the applied voltage [V/m], shape (...); None where there is none.
    """
    if max_strength is not None:
        yield WarningCondition.of(
            max_strength > MOST_OF_LIQUIDS,
            "field-above-insulators",
            field=max_strength / 1e6,
            limit=MOST_OF_LIQUIDS / 1e6,
            check=check,
        )


def strength_warning_conditions(discharge: Discharge | None) -> Iterator[WarningCondition]:
    """Warning of a dielectric strength above the field that any film of a liquid carries."""
    if discharge is None:
        return
    table, law = discharge.strength_table, discharge.weibull
    strength = discharge.dielectric_strength
    if table is not None:
        strength = max(table.strength)
    elif law is not None:
        strength = law.scale
    if strength is not None:
        yield WarningCondition.of(
            strength > MOST_OF_LIQUIDS,
            "strength-above-liquids",
            strength=strength / 1e6,
            limit=MOST_OF_LIQUIDS / 1e6,
        )


@dataclass(frozen=True)
class FieldUtilisation:
    """Utilisation of the dielectric strength: the ratio of field strength to dielectric strength."""

    # Largest field strength of each column of the solved field, on either wall or at mid-film [V/m],
    # shape (nx,) or (nx, ny).
    strength: Array
    # Dielectric strength at each column [V/m]; 1 V/m if the case gives none, or gives a Weibull law,
    # shape (nx,) or (nx, ny).
    dielectric_strength: Array
    position: tuple[float, ...]  # position of the largest utilisation, (x,) or (x, y) [m]
    # Width [m], or area [m^2] for a point contact, of the zone around ``position`` where the utilisation is
    # at least 95 % of its maximum.
    extent: float
    # Field strength over the whole domain of the film [V/m]; outside the field range the strength of a thin
    # gap, shape (n,).
    over_domain: Array
    # Area that each value of ``over_domain`` stands for [m^2]; for a line contact the width [m], shape (n,).
    areas: Array

    @property
    def dielectric_strength_there(self) -> float:
        """Dielectric strength at the position of the largest utilisation [V/m]."""
        return float(self.dielectric_strength.flat[np.argmax(self.strength / self.dielectric_strength)])

    @classmethod
    def of(cls, discharge: Discharge, film: Film | PointFilm, field: Field | PointField) -> FieldUtilisation:
        """Utilisation of the dielectric strength in a solved contact."""
        strength, columns = field.column_strength, field.axes
        warm = None if film.temperature is None else at_columns(film, field, film.temperature)
        limit = dielectric_strength(discharge, at_columns(film, field, film.pressure), warm)
        utilisation = strength / limit
        place = np.unravel_index(np.argmax(utilisation), utilisation.shape)
        thin = field.voltage / np.maximum(film.thickness, ATOM)
        around = areas(film.axes) - areas(film.axes, columns)
        return cls(
            strength=strength,
            dielectric_strength=limit,
            position=tuple(float(axis[k]) for axis, k in zip(columns, place, strict=True)),
            extent=field.extent_above(utilisation, BREAKING * float(np.max(utilisation))),
            over_domain=np.concatenate([strength.ravel(), thin.ravel()]),
            areas=np.concatenate([areas(columns).ravel(), around.ravel()]),
        )


def dielectric_strength(discharge: Discharge, pressure: Array, temperature: Array | None = None) -> Array:
    """Dielectric strength of a film at given pressures. ``pressure`` [Pa], shape (...); ``temperature``,
    temperature in a film with heat [K], instead of the temperature of the discharge, shape (...). The
    discharge of many points has values of shape (n,), which are the last axis of the pressures. Returns
    dielectric strength [V/m], shape (...).

    Examples
    --------
    >>> table = {"pressure": ["0 GPa", "1 GPa"], "strength": ["15 V/um", "25 V/um"]}
    >>> discharge = Discharge.from_dict({"strength_table": table})
    >>> dielectric_strength(discharge, np.array([0.0, 0.5e9, 2e9])).tolist()
    [15000000.0, 20000000.0, 25000000.0]
    """
    table = discharge.strength_table
    if table is None:
        constant = discharge.dielectric_strength
        return np.zeros(np.shape(pressure)) + (1.0 if constant is None else constant)
    if table.over == "pressure":
        at: Numbers = pressure
    else:
        warm = discharge.temperature if temperature is None else temperature
        assert warm is not None
        at = np.zeros(np.shape(pressure)) + warm
    return np.asarray(np.interp(at, table.places, table.strength))


@dataclass(frozen=True)
class Breakdown:
    """Breakdown voltage of a film and probability of breakdown.

    All values are None if the case gives neither a dielectric strength nor a Weibull law.
    """

    # "constant", "table over pressure", "table over temperature" or "weibull"
    strength_law: str | None = None
    # Dielectric strength in the zone that breaks down first [V/m]; None for a Weibull law.
    dielectric_strength: float | None = None
    # Breakdown voltage [V]; for a Weibull law at a probability of 63.2 %
    breakdown_voltage: float | None = None
    # breakdown_voltage_low and breakdown_voltage_high: breakdown voltage of a Weibull law at probabilities of
    # 5 % and 95 % [V]; None for other laws.
    breakdown_voltage_low: float | None = None
    breakdown_voltage_high: float | None = None
    margin: float | None = None  # breakdown voltage over the voltage of the case, dimensionless
    # Probability of breakdown at the voltage of the case; 0 or 1 unless the law is a Weibull law.
    probability: float | None = None
    # Estimated relative error of the breakdown voltage that is due to the field, the error of the largest
    # field strength. The error of the film comes on top. None if it is not known.
    breakdown_field_error: float | None = None


def breakdown(discharge: Discharge, utilisation: FieldUtilisation, voltage: float, size: Size) -> Breakdown:
    """Breakdown of a film under a voltage [V] by a Weibull law, a dielectric strength, or a table of it."""
    if discharge.weibull is not None:
        return _weibull_breakdown(discharge, utilisation, voltage, size)
    if not discharge.has_strength:
        return Breakdown()
    table = discharge.strength_table
    breaking_voltage = breakdown_voltage(voltage, utilisation.strength, utilisation.dielectric_strength)
    return Breakdown(
        strength_law="constant" if table is None else f"table over {table.over}",
        dielectric_strength=utilisation.dielectric_strength_there,
        breakdown_voltage=breaking_voltage,
        margin=breaking_voltage / voltage,
        probability=float(voltage >= breaking_voltage),
    )


def _weibull_breakdown(
    discharge: Discharge, utilisation: FieldUtilisation, voltage: float, size: Size
) -> Breakdown:
    law = discharge.weibull
    assert law is not None and size.length is not None
    areas, strength = size.length * utilisation.areas, utilisation.over_domain
    weakest = WeakestLink.of(voltage, strength, areas, law.scale, law.shape, law.reference_area)
    breaking_voltage = weakest.characteristic_voltage
    return Breakdown(
        strength_law="weibull",
        breakdown_voltage=breaking_voltage,
        breakdown_voltage_low=weakest.voltage(0.05),
        breakdown_voltage_high=weakest.voltage(0.95),
        margin=breaking_voltage / voltage,
        probability=weakest.probability(voltage),
    )


@dataclass(frozen=True)
class BreakdownZone:
    """Zone of a film that breaks down first.

    Utilisation is the ratio of field strength to dielectric strength.
    """

    zone_position: float | tuple[float, ...]  # position of the largest utilisation, x or (x, y) [m]
    # Width of the zone around this position where the utilisation is at least 95 % of its maximum [m]; for a
    # point contact the diameter of a circle with the area of the zone.
    zone_size: float
    # Area of the zone [m^2]; for a line contact its width times the length, None if the length is unknown.
    zone_area: float | None
    # ``zone_size`` over the half-width of the dry contact, or over its semi-axis along entrainment.
    zone_over_half_width: float
    # zone_over_largest_pit and zone_over_mean_pit: ``zone_size`` divided by the largest and by the mean
    # published size of a pit, 4 um and 1.7 um.
    zone_over_largest_pit: float
    zone_over_mean_pit: float


def breakdown_zone(utilisation: FieldUtilisation, size: Size) -> BreakdownZone:
    """Zone of a film that breaks down first, where the utilisation is largest."""
    extent = utilisation.extent
    across = extent if size.line else float(np.sqrt(4.0 * extent / np.pi))
    return BreakdownZone(
        zone_position=utilisation.position[0] if size.line else utilisation.position,
        zone_size=across,
        zone_area=size.total(extent),
        zone_over_half_width=across / size.half_width,
        zone_over_largest_pit=across / LARGEST_PIT,
        zone_over_mean_pit=across / MEAN_PIT,
    )
