"""Parts of the assessment of a discharge: breakdown, breakdown zone, capacitances, energies and leakage."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.constants import epsilon_0

from ehlectric.cases.discharge import Discharge
from ehlectric.cases.lubricant import Lubricant, permittivity_law
from ehlectric.discharge.capacitance import zone_capacitances
from ehlectric.discharge.laws import (
    CURRENT_DENSITY_LIMITS,
    LARGEST_PIT,
    MEAN_PIT,
    WeakestLink,
    breakdown_voltage,
    melted_volume,
    pit_diameter,
    relaxation_time,
    stored_energy,
)
from ehlectric.discharge.utilisation import FieldUtilisation
from ehlectric.field.line import Field
from ehlectric.field.point import PointField
from ehlectric.field.zones import line_zone_areas, point_zone_areas
from ehlectric.film.line import Film
from ehlectric.film.point import PointFilm


@dataclass(frozen=True)
class Size:
    """Size of the dry contact.

    Attributes
    ----------
    half_width : float
        Half-width of a line contact, or semi-axis of a point contact along entrainment [m].
    hertz : float
        Width of a dry line contact [m], or area of a dry point contact [m^2].
    length : float or None
        Length of a line contact [m], None if the case does not give it; 1 for a point contact.
    line : bool
        Whether the contact is a line contact.
    """

    half_width: float
    hertz: float
    length: float | None
    line: bool

    @classmethod
    def of(cls, semi_axes: tuple[float, ...], discharge: Discharge) -> Size:
        """Size of a dry contact from its half-width [m], or from its two semi-axes [m]."""
        b = semi_axes[0]
        if len(semi_axes) == 1:
            return cls(b, 2.0 * b, discharge.length, line=True)
        return cls(b, np.pi * b * semi_axes[1], 1.0, line=False)

    def total(self, per_length: float) -> float | None:
        """Value of the whole contact from a value per length; None for a line contact of unknown length.

        A value of a point contact is returned unchanged.
        """
        return None if self.length is None else self.length * per_length


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
    """

    strength_law: str | None = None
    dielectric_strength: float | None = None
    breakdown_voltage: float | None = None
    breakdown_voltage_low: float | None = None
    breakdown_voltage_high: float | None = None
    margin: float | None = None
    probability: float | None = None


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


@dataclass(frozen=True)
class Capacitances:
    """Capacitances of a contact: per length [F/m] for a line contact, [F] for a point contact.

    Attributes
    ----------
    capacitance : float
        Capacitance over the whole domain of the film.
    capacitance_hertz, capacitance_inlet, capacitance_outlet : float
        Capacitances of the Hertz zone, of the inlet before it, and of the outlet behind it.
    capacitance_sides : float or None
        Capacitance of the sides of a point contact; None for a line contact.
    capacitance_plate : float
        Capacitance of parallel plates over the Hertz zone, eps0 eps_r A/h(0), with eps_r at ambient pressure.
    capacitance_ratio : float
        ``capacitance`` over ``capacitance_plate``, dimensionless.
    capacitance_outlet_full, capacitance_outlet_fingers, capacitance_outlet_layers : float
        Capacitance of the outlet for each filling of the gap behind the exit.
    capacitance_full, capacitance_fingers, capacitance_layers : float
        Capacitance over the whole domain for each filling. In a point contact it affects the sides too.
    outlet : str
        Filling of the outlet on which ``capacitance`` and the energies are based.
    """

    capacitance: float
    capacitance_hertz: float
    capacitance_inlet: float
    capacitance_outlet: float
    capacitance_sides: float | None
    capacitance_plate: float
    capacitance_ratio: float
    capacitance_outlet_full: float
    capacitance_outlet_fingers: float
    capacitance_outlet_layers: float
    capacitance_full: float
    capacitance_fingers: float
    capacitance_layers: float
    outlet: str


def capacitances(
    discharge: Discharge,
    lubricant: Lubricant,
    semi_axes: tuple[float, ...],
    film: Film | PointFilm,
    field: Field | PointField,
) -> Capacitances:
    """Capacitances of the zones of a contact, for each filling of the outlet.

    Parameters
    ----------
    discharge : Discharge
        Inputs of the discharge, with the filling of the outlet.
    lubricant : Lubricant
        Lubricant, for its relative permittivity.
    semi_axes : tuple of float
        Half-width of a line contact, or semi-axes of a point contact along and across entrainment [m].
    film, field : Film and Field, or PointFilm and PointField
        Solution of the contact.

    Returns
    -------
    Capacitances
        Capacitances per length [F/m] of a line contact, or [F] of a point contact.
    """
    areas = line_zone_areas if len(semi_axes) == 1 else point_zone_areas
    zones = areas(film.axes, *semi_axes), areas(field.axes, *semi_axes)
    by_outlet = zone_capacitances(film, field, zones, permittivity_law(lubricant))
    chosen = by_outlet[discharge.outlet]
    total = {name: sum(parts.values()) for name, parts in by_outlet.items()}
    hertz = Size.of(semi_axes, discharge).hertz
    plate = epsilon_0 * lubricant.relative_permittivity * hertz / film.central_thickness
    return Capacitances(
        capacitance=total[discharge.outlet],
        capacitance_hertz=chosen["hertz"],
        capacitance_inlet=chosen["inlet"],
        capacitance_outlet=chosen["outlet"],
        capacitance_sides=chosen.get("sides"),
        capacitance_plate=plate,
        capacitance_ratio=total[discharge.outlet] / plate,
        capacitance_outlet_full=by_outlet["full"]["outlet"],
        capacitance_outlet_fingers=by_outlet["fingers"]["outlet"],
        capacitance_outlet_layers=by_outlet["layers"]["outlet"],
        capacitance_full=total["full"],
        capacitance_fingers=total["fingers"],
        capacitance_layers=total["layers"],
        outlet=discharge.outlet,
    )


@dataclass(frozen=True)
class DischargeCosts:
    """Energy of a discharge, size of the pit that it melts, and current density.

    A value is None if the case lacks an input that it needs.

    Attributes
    ----------
    contact_energy : float or None
        Energy C V^2/2 stored in the contact at the voltage of the case [J].
    discharge_energy : float or None
        Energy C V^2/2 stored in the contact and in the external capacitance, at the voltage of the case [J].
    breakdown_energy : float or None
        Energy C V^2/2 stored in the contact and in the external capacitance, at the breakdown voltage [J].
    pit_volume : float or None
        Volume of one surface that ``discharge_energy`` melts [m^3].
    pit_diameter : float or None
        Diameter of a hemisphere of that volume [m].
    current_density : float or None
        Peak current over the area of the dry contact [A/m^2].
    current_density_limits : tuple of float or None
        Published limits of the current density [A/m^2].
    """

    contact_energy: float | None = None
    discharge_energy: float | None = None
    breakdown_energy: float | None = None
    pit_volume: float | None = None
    pit_diameter: float | None = None
    current_density: float | None = None
    current_density_limits: tuple[float, ...] | None = None


def discharge_costs(
    discharge: Discharge, capacitance: float, voltage: float, breaking_voltage: float | None, size: Size
) -> DischargeCosts:
    """Energy of a discharge, size of the pit that it melts, and apparent current density.

    Parameters
    ----------
    discharge : Discharge
        Inputs of the discharge, with external capacitance, pit and peak current.
    capacitance : float
        Capacitance per length of a line contact [F/m], or of a point contact [F].
    voltage : float
        Voltage of the case [V].
    breaking_voltage : float or None
        Breakdown voltage [V]; None if it is unknown.
    size : Size
        Size of the dry contact.

    Returns
    -------
    DischargeCosts
        Values in SI units; None if the case lacks an input that a value needs.
    """
    total, external = size.total(capacitance), discharge.external_capacitance
    together = None if total is None or external is None else total + external
    energy = _energy(together, voltage)
    volume = (
        None
        if discharge.pit is None or energy is None
        else melted_volume(energy, discharge.pit.efficiency, discharge.pit.melting_energy)
    )
    current = discharge.peak_current
    area = None if current is None else size.total(size.hertz)
    return DischargeCosts(
        contact_energy=_energy(total, voltage),
        discharge_energy=energy,
        breakdown_energy=_energy(together, breaking_voltage),
        pit_volume=volume,
        pit_diameter=None if volume is None else pit_diameter(volume),
        current_density=None if current is None or area is None else current / area,
        current_density_limits=None if area is None else CURRENT_DENSITY_LIMITS,
    )


def _energy(capacitance: float | None, voltage: float | None) -> float | None:
    return None if capacitance is None or voltage is None else stored_energy(capacitance, voltage)


@dataclass(frozen=True)
class Leakage:
    """Leakage of charge through the oil at ambient pressure; None if the conductivity is unknown.

    Attributes
    ----------
    relaxation_time : float or None
        Charge relaxation time eps0 eps_r/sigma [s].
    corner_frequency : float or None
        Frequency above which the film is a capacitor, 1/(2 pi ``relaxation_time``) [Hz].
    """

    relaxation_time: float | None = None
    corner_frequency: float | None = None


def leakage(discharge: Discharge, permittivity: float) -> Leakage:
    """Leakage of charge through an oil with this relative permittivity and the conductivity of the case."""
    if discharge.conductivity is None:
        return Leakage()
    time = relaxation_time(permittivity, discharge.conductivity)
    return Leakage(relaxation_time=time, corner_frequency=1.0 / (2.0 * np.pi * time))
