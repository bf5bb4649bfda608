"""Parts of the assessment of a discharge: breakdown, its zone, capacitances, energies and leakage."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.constants import epsilon_0

from ehlectric.cases.discharge import Discharge
from ehlectric.cases.lubricant import Lubricant, permittivity_law
from ehlectric.discharge.capacitance import zone_capacitances
from ehlectric.discharge.columns import axes_of
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


@dataclass(frozen=True)
class Size:
    """Size of the dry contact.

    Attributes
    ----------
    half_width : float
        Half-width of a line contact, or semi-axis of a point contact along entrainment [m].
    hertz : float
        Width of the dry contact of a line [m], or area of that of a point [m^2].
    length : float or None
        Length of a line contact [m], None where the case does not give it; 1 for a point contact.
    line : bool
        Whether it is a line contact.
    """

    half_width: float
    hertz: float
    length: float | None
    line: bool

    @classmethod
    def of(cls, semi_axes: tuple[float, ...], given: Discharge) -> Size:
        """Size of a dry contact from its half-width, or from both of its semi-axes [m]."""
        b = semi_axes[0]
        if len(semi_axes) == 1:
            return cls(b, 2.0 * b, given.length, line=True)
        return cls(b, np.pi * b * semi_axes[1], 1.0, line=False)

    def total(self, per_length: float) -> float | None:
        """Value of the contact from one per length of a line; None for a line without a length."""
        return None if self.length is None else self.length * per_length


@dataclass(frozen=True)
class Breakdown:
    """Voltage at which a film breaks down; None where the case does not give a strength.

    Attributes
    ----------
    strength_law : str or None
        "constant", "table over pressure", "table over temperature" or "weibull".
    dielectric_strength : float or None
        Dielectric strength in the zone that breaks down first [V/m]; None for a Weibull law.
    breakdown_voltage : float or None
        Breakdown voltage [V]; of a Weibull law at a probability of 63.2 %.
    breakdown_voltage_low, breakdown_voltage_high : float or None
        Breakdown voltage of a Weibull law at probabilities of 5 and 95 % [V]; None for other laws.
    margin : float or None
        Breakdown voltage over the voltage of the case.
    probability : float or None
        Probability of breakdown at the voltage of the case; 0 or 1 unless the law is Weibull's.
    """

    strength_law: str | None = None
    dielectric_strength: float | None = None
    breakdown_voltage: float | None = None
    breakdown_voltage_low: float | None = None
    breakdown_voltage_high: float | None = None
    margin: float | None = None
    probability: float | None = None


def breakdown(given: Discharge, used: FieldUtilisation, voltage: float, size: Size) -> Breakdown:
    """Breakdown of a film by a Weibull law, or by a strength that is given.

    Parameters
    ----------
    given : Discharge
        Strength of the lubricant.
    used : FieldUtilisation
        Field strength and dielectric strength of the film.
    voltage : float
        Voltage of the field [V].
    size : Size
        Size of the dry contact.
    """
    if given.weibull is not None:
        return _weibull_breakdown(given, used, voltage, size)
    if not given.has_strength:
        return Breakdown()
    table = given.strength_table
    breaks = breakdown_voltage(voltage, used.strength, used.dielectric_strength)
    return Breakdown(
        strength_law="constant" if table is None else f"table over {table.over}",
        dielectric_strength=used.dielectric_strength_there,
        breakdown_voltage=breaks,
        margin=breaks / voltage,
        probability=float(voltage >= breaks),
    )


def _weibull_breakdown(given: Discharge, used: FieldUtilisation, voltage: float, size: Size) -> Breakdown:
    law = given.weibull
    assert law is not None and size.length is not None
    areas = size.length * used.areas
    weakest = WeakestLink.of(voltage, used.over_domain, areas, law.scale, law.shape, law.reference_area)
    breaks = weakest.characteristic_voltage
    return Breakdown(
        strength_law="weibull",
        breakdown_voltage=breaks,
        breakdown_voltage_low=weakest.voltage(0.05),
        breakdown_voltage_high=weakest.voltage(0.95),
        margin=breaks / voltage,
        probability=weakest.probability(voltage),
    )


@dataclass(frozen=True)
class BreakdownZone:
    """Zone of a film that breaks down first.

    Attributes
    ----------
    zone_position : float or tuple of float
        Position at which the field uses most of the strength, x or (x, y) [m].
    zone_size : float
        Width of the zone around it in which the field uses at least 95 % of that [m]; of a point contact the
        diameter of a circle of the same area.
    zone_area : float or None
        Area of the zone [m^2]; of a line contact its width times the length, None without a length.
    zone_over_half_width : float
        ``zone_size`` over the half-width of the dry contact, or over its semi-axis along entrainment.
    zone_over_largest_pit, zone_over_mean_pit : float
        ``zone_size`` over the published sizes of pits, 4 and 1.7 um.
    """

    zone_position: float | tuple[float, ...]
    zone_size: float
    zone_area: float | None
    zone_over_half_width: float
    zone_over_largest_pit: float
    zone_over_mean_pit: float


def breakdown_zone(used: FieldUtilisation, size: Size) -> BreakdownZone:
    """Zone of a film in which the field uses most of the strength."""
    extent = used.extent
    across = extent if size.line else float(np.sqrt(4.0 * extent / np.pi))
    return BreakdownZone(
        zone_position=used.position[0] if size.line else used.position,
        zone_size=across,
        zone_area=size.total(extent),
        zone_over_half_width=across / size.half_width,
        zone_over_largest_pit=across / LARGEST_PIT,
        zone_over_mean_pit=across / MEAN_PIT,
    )


@dataclass(frozen=True)
class Capacitances:
    """Capacitances of a contact, per length [F/m] for a line contact, in [F] for a point contact.

    Attributes
    ----------
    capacitance : float
        Capacitance over the whole domain of the film.
    capacitance_hertz, capacitance_inlet, capacitance_outlet, capacitance_sides : float
        Parts of the Hertz zone, before, behind and beside it; None for the sides of a line contact.
    capacitance_plate : float
        Capacitance of parallel plates, eps0 eps_r A/h(0) of the Hertz zone, eps_r at ambient pressure.
    capacitance_ratio : float
        ``capacitance`` over ``capacitance_plate``.
    capacitance_outlet_full, capacitance_outlet_fingers, capacitance_outlet_layers : float
        Capacitance of the outlet by what fills the gap behind the exit.
    capacitance_full, capacitance_fingers, capacitance_layers : float
        Capacitance over the whole domain by what fills the outlet; of a point contact its sides differ too.
    outlet : str
        Filling of the outlet that ``capacitance`` and the energies count with.
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
    given: Discharge,
    lubricant: Lubricant,
    semi_axes: tuple[float, ...],
    film: Film,
    field: Field | PointField,
) -> Capacitances:
    """Capacitances of the zones of a contact, and of the outlet by what fills it.

    Parameters
    ----------
    given : Discharge
        Filling of the outlet.
    lubricant : Lubricant
        Permittivity of the oil.
    semi_axes : tuple of float
        Half-width of a line contact, or both semi-axes of a point contact [m].
    film, field
        The solution.
    """
    areas = line_zone_areas if len(semi_axes) == 1 else point_zone_areas
    zones = areas(axes_of(film), *semi_axes), areas(axes_of(field), *semi_axes)
    by_outlet = zone_capacitances(film, field, zones, permittivity_law(lubricant))
    chosen, total = by_outlet[given.outlet], {name: sum(parts.values()) for name, parts in by_outlet.items()}
    hertz = Size.of(semi_axes, given).hertz
    plate = epsilon_0 * lubricant.relative_permittivity * hertz / film.central_thickness
    return Capacitances(
        capacitance=total[given.outlet],
        capacitance_hertz=chosen["hertz"],
        capacitance_inlet=chosen["inlet"],
        capacitance_outlet=chosen["outlet"],
        capacitance_sides=chosen.get("sides"),
        capacitance_plate=plate,
        capacitance_ratio=total[given.outlet] / plate,
        capacitance_outlet_full=by_outlet["full"]["outlet"],
        capacitance_outlet_fingers=by_outlet["fingers"]["outlet"],
        capacitance_outlet_layers=by_outlet["layers"]["outlet"],
        capacitance_full=total["full"],
        capacitance_fingers=total["fingers"],
        capacitance_layers=total["layers"],
        outlet=given.outlet,
    )


@dataclass(frozen=True)
class DischargeCosts:
    """Energy and current of a discharge; None where the case does not give what it takes.

    Attributes
    ----------
    contact_energy : float or None
        Energy C V^2/2 of the contact at the voltage of the case [J].
    discharge_energy : float or None
        The same energy with the capacitance that is connected to the contact [J].
    breakdown_energy : float or None
        ``discharge_energy`` at the breakdown voltage [J].
    pit_volume : float or None
        Volume that ``discharge_energy`` melts of one surface [m^3].
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
    given: Discharge, capacitance: float, voltage: float, breaks: float | None, size: Size
) -> DischargeCosts:
    """Energy of a discharge, the pit that it melts, and its apparent current density.

    Parameters
    ----------
    given : Discharge
        External capacitance, pit and peak current.
    capacitance : float
        Capacitance per length of a line contact [F/m], or of a point contact [F].
    voltage, breaks : float
        Voltage of the case, and breakdown voltage or None [V].
    size : Size
        Size of the dry contact.
    """
    total, external = size.total(capacitance), given.external_capacitance
    together = None if total is None or external is None else total + external
    energy = _energy(together, voltage)
    volume = (
        None
        if given.pit is None or energy is None
        else melted_volume(energy, given.pit.efficiency, given.pit.melting_energy)
    )
    area = None if given.peak_current is None else size.total(size.hertz)
    return DischargeCosts(
        contact_energy=_energy(total, voltage),
        discharge_energy=energy,
        breakdown_energy=_energy(together, breaks),
        pit_volume=volume,
        pit_diameter=None if volume is None else pit_diameter(volume),
        current_density=None if given.peak_current is None or area is None else given.peak_current / area,
        current_density_limits=None if area is None else CURRENT_DENSITY_LIMITS,
    )


def _energy(capacitance: float | None, voltage: float | None) -> float | None:
    return None if capacitance is None or voltage is None else stored_energy(capacitance, voltage)


@dataclass(frozen=True)
class Leakage:
    """Leakage of charge through the oil at ambient pressure; None without a conductivity.

    Attributes
    ----------
    relaxation_time : float or None
        Charge relaxation time eps0 eps_r/sigma [s].
    corner_frequency : float or None
        Frequency above which the film is a capacitor [Hz].
    """

    relaxation_time: float | None = None
    corner_frequency: float | None = None


def leakage(given: Discharge, permittivity: float) -> Leakage:
    """Leakage of charge through an oil of a relative permittivity, where its conductivity is given."""
    if given.conductivity is None:
        return Leakage()
    time = relaxation_time(permittivity, given.conductivity)
    return Leakage(relaxation_time=time, corner_frequency=1.0 / (2.0 * np.pi * time))
