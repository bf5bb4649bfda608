"""Breakdown of a film: voltage and probability, and the zone where the film breaks down first."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.cases.discharge import Discharge
from ehlectric.discharge.contact_size import Size
from ehlectric.discharge.laws import (
    LARGEST_PIT,
    MEAN_PIT,
    WeakestLink,
    breakdown_voltage,
)
from ehlectric.discharge.utilisation import FieldUtilisation


@dataclass(frozen=True)
class Breakdown:
    """Breakdown voltage of a film and probability of breakdown.

    All values are None if the case gives neither a dielectric strength nor a Weibull law.

    Attributes
    ----------
    strength_law : str or None
        "constant", "table over pressure", "table over temperature" or "weibull".
    dielectric_strength : float or None
        Dielectric strength in the zone that breaks down first [V/m]; None for a Weibull law.
    breakdown_voltage : float or None
        Breakdown voltage [V]; for a Weibull law at a probability of 63.2 %.
    breakdown_voltage_low, breakdown_voltage_high : float or None
        Breakdown voltage of a Weibull law at probabilities of 5 % and 95 % [V]; None for other laws.
    margin : float or None
        Breakdown voltage over the voltage of the case, dimensionless.
    probability : float or None
        Probability of breakdown at the voltage of the case; 0 or 1 unless the law is a Weibull law.
    breakdown_field_error : float or None
        Estimated relative error of the breakdown voltage that is due to the field, the error of the largest
        field strength. The error of the film comes on top. None if it is not known.
    """

    strength_law: str | None = None
    dielectric_strength: float | None = None
    breakdown_voltage: float | None = None
    breakdown_voltage_low: float | None = None
    breakdown_voltage_high: float | None = None
    margin: float | None = None
    probability: float | None = None
    breakdown_field_error: float | None = None


def breakdown(discharge: Discharge, utilisation: FieldUtilisation, voltage: float, size: Size) -> Breakdown:
    """Breakdown of a film by a Weibull law, a constant dielectric strength, or a table of it.

    Parameters
    ----------
    discharge : Discharge
        Inputs of the discharge, with the dielectric strength or the Weibull law.
    utilisation : FieldUtilisation
        Field strength and dielectric strength of the film.
    voltage : float
        Voltage of the field [V].
    size : Size
        Size of the dry contact.

    Returns
    -------
    Breakdown
        Breakdown voltage and probability; all None if the case gives neither a strength nor a Weibull law.
    """
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

    Attributes
    ----------
    zone_position : float or tuple of float
        Position of the largest utilisation, x or (x, y) [m].
    zone_size : float
        Width of the zone around this position where the utilisation is at least 95 % of its maximum [m]; for
        a point contact the diameter of a circle with the area of the zone.
    zone_area : float or None
        Area of the zone [m^2]; for a line contact its width times the length, None if the length is unknown.
    zone_over_half_width : float
        ``zone_size`` over the half-width of the dry contact, or over its semi-axis along entrainment.
    zone_over_largest_pit, zone_over_mean_pit : float
        ``zone_size`` over the largest and over the mean published size of a pit, 4 um and 1.7 um.
    """

    zone_position: float | tuple[float, ...]
    zone_size: float
    zone_area: float | None
    zone_over_half_width: float
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
