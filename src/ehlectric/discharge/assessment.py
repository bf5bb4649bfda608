"""Assessment of a discharge through a solved contact: breakdown voltage and zone, capacitances, energies."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass, replace
from operator import attrgetter
from typing import Any

import numpy as np

from ehlectric.cases.discharge_inputs import Discharge
from ehlectric.discharge.discharge_laws import (
    SOURCES,
    TUNNELLING,
    DischargeCosts,
    Leakage,
    Size,
    discharge_costs,
    leakage,
)
from ehlectric.discharge.film_breakdown import (
    Breakdown,
    BreakdownZone,
    FieldUtilisation,
    breakdown,
    breakdown_zone,
    strength_warnings,
)
from ehlectric.discharge.film_capacitance import Capacitances, capacitances
from ehlectric.discharge.film_verdict import breakdown_warning
from ehlectric.errors import ResultWarning
from ehlectric.field.line_field import Field
from ehlectric.field.point_field import PointField
from ehlectric.film.isothermal_film import Film, PointFilm
from ehlectric.lubricant.oil import Oil


@dataclass(frozen=True)
class Assessment:
    """Assessment of a discharge through one contact, in five parts, SI units.

    A value is None if the case lacks an input that it needs. Every value of a part is also an attribute of
    the assessment: ``assessment.breakdown_voltage`` is ``assessment.breakdown.breakdown_voltage``.
    """

    breakdown: Breakdown
    zone: BreakdownZone  # zone of the film that breaks down first
    capacitances: Capacitances
    costs: DischargeCosts  # energy of a discharge, size of the pit that it melts, and current density
    leakage: Leakage  # charge relaxation time of the oil

    strength_law = property(attrgetter("breakdown.strength_law"))
    dielectric_strength = property(attrgetter("breakdown.dielectric_strength"))
    breakdown_voltage = property(attrgetter("breakdown.breakdown_voltage"))
    breakdown_voltage_low = property(attrgetter("breakdown.breakdown_voltage_low"))
    breakdown_voltage_high = property(attrgetter("breakdown.breakdown_voltage_high"))
    margin = property(attrgetter("breakdown.margin"))
    probability = property(attrgetter("breakdown.probability"))
    breakdown_field_error = property(attrgetter("breakdown.breakdown_field_error"))
    zone_position = property(attrgetter("zone.zone_position"))
    zone_size = property(attrgetter("zone.zone_size"))
    zone_area = property(attrgetter("zone.zone_area"))
    zone_over_half_width = property(attrgetter("zone.zone_over_half_width"))
    zone_over_largest_pit = property(attrgetter("zone.zone_over_largest_pit"))
    zone_over_mean_pit = property(attrgetter("zone.zone_over_mean_pit"))
    capacitance = property(attrgetter("capacitances.capacitance"))
    capacitance_beyond = property(attrgetter("capacitances.capacitance_beyond"))
    capacitance_hertz = property(attrgetter("capacitances.capacitance_hertz"))
    capacitance_inlet = property(attrgetter("capacitances.capacitance_inlet"))
    capacitance_outlet = property(attrgetter("capacitances.capacitance_outlet"))
    capacitance_sides = property(attrgetter("capacitances.capacitance_sides"))
    capacitance_plate = property(attrgetter("capacitances.capacitance_plate"))
    capacitance_ratio = property(attrgetter("capacitances.capacitance_ratio"))
    capacitance_outlet_full = property(attrgetter("capacitances.capacitance_outlet_full"))
    capacitance_outlet_fingers = property(attrgetter("capacitances.capacitance_outlet_fingers"))
    capacitance_outlet_layers = property(attrgetter("capacitances.capacitance_outlet_layers"))
    capacitance_full = property(attrgetter("capacitances.capacitance_full"))
    capacitance_fingers = property(attrgetter("capacitances.capacitance_fingers"))
    capacitance_layers = property(attrgetter("capacitances.capacitance_layers"))
    outlet = property(attrgetter("capacitances.outlet"))
    contact_energy = property(attrgetter("costs.contact_energy"))
    discharge_energy = property(attrgetter("costs.discharge_energy"))
    breakdown_energy = property(attrgetter("costs.breakdown_energy"))
    pit_volume = property(attrgetter("costs.pit_volume"))
    pit_diameter = property(attrgetter("costs.pit_diameter"))
    current_density = property(attrgetter("costs.current_density"))
    current_density_limits = property(attrgetter("costs.current_density_limits"))
    relaxation_time = property(attrgetter("leakage.relaxation_time"))
    corner_frequency = property(attrgetter("leakage.corner_frequency"))

    def summary(self) -> dict[str, Any]:
        """Values of all parts, with their sources and assumptions, as in ``discharge`` of summary.json."""
        values: dict[str, Any] = {}
        for part in (self.breakdown, self.zone, self.capacitances, self.costs, self.leakage):
            values |= asdict(part)
        return values | {"sources": {key: text for key, text in SOURCES.items() if values[key] is not None}}


def assess(
    discharge: Discharge,
    oil: Oil,
    semi_axes: tuple[float, ...],
    film: Film | PointFilm,
    field: Field | PointField,
) -> Assessment:
    """Assess a discharge through a solved contact. ``semi_axes``, half-width of a line contact, or semi-axes
    of a point contact along and across entrainment [m]. Returns breakdown, breakdown zone, capacitances,
    energies and leakage, SI units.

    Examples
    --------
    >>> from ehlectric import Case, solve
    >>> contact = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa"}
    >>> contact |= {"max_hertz_pressure": "1 GPa", "entrainment_speed": "4 m/s"}
    >>> case = {"contact": contact, "lubricant": {"base": "paper"}}
    >>> result = solve(Case.from_dict(case | {"discharge": {"dielectric_strength": "15 V/um"}}))
    >>> round(result.discharge.breakdown_voltage, 1)
    11.2
    """
    size = Size.of(semi_axes, discharge)
    utilisation = FieldUtilisation.of(discharge, film, field)
    voltages = breakdown(discharge, utilisation, field.voltage, size)
    if voltages.breakdown_voltage is not None:
        voltages = replace(voltages, breakdown_field_error=field.strength_error)
    by_zone = capacitances(discharge, oil, semi_axes, film, field)
    return Assessment(
        breakdown=voltages,
        zone=breakdown_zone(utilisation, size),
        capacitances=by_zone,
        costs=discharge_costs(
            discharge, by_zone.capacitance, field.voltage, voltages.breakdown_voltage, size
        ),
        leakage=leakage(discharge, oil, film, semi_axes),
    )


def margin_warnings(
    discharge: Discharge | None,
    semi_axes: tuple[float, ...],
    film: Film | PointFilm,
    field: Field | PointField,
) -> Iterator[ResultWarning]:
    """Warning of a breakdown voltage below the applied voltage; none for a film that is no solution."""
    if discharge is None or not film.converged:
        return
    size, utilisation = Size.of(semi_axes, discharge), FieldUtilisation.of(discharge, film, field)
    found = breakdown(discharge, utilisation, field.voltage, size)
    if found.margin is not None and found.margin < 1.0:
        at = f"breakdown voltage {found.breakdown_voltage:.3g} V"
        strongest = None if discharge.weibull is not None else field.max_strength
        yield breakdown_warning("applied voltage", field.voltage, at, found.margin, field=strongest)
    yield from strength_warnings(discharge)


def discharge_warnings(discharge: Discharge | None, film: Film | PointFilm) -> Iterator[ResultWarning]:
    """Warnings about the assessment of a discharge; none if the case has no table ``discharge``."""
    if discharge is None:
        return
    if film.minimum_thickness < TUNNELLING:
        yield ResultWarning(
            "tunnelling",
            f"the minimum film is {film.minimum_thickness * 1e9:.2g} nm: below about {TUNNELLING * 1e9:g} nm "
            "electrons tunnel through the film, which is not modelled; do not rely on the breakdown voltage",
        )
    table = discharge.strength_table
    if table is not None and table.over == "pressure":
        low, high = table.places[0], table.places[-1]
        least, most = float(np.min(film.pressure)), film.max_pressure
        if least < low or most > high:
            yield ResultWarning(
                "strength-table-exceeded",
                f"the pressure in the film, {least / 1e9:.3g} to {most / 1e9:.3g} GPa, exceeds the range of "
                f"discharge.strength_table, {low / 1e9:.3g} to {high / 1e9:.3g} GPa: its end values are used "
                "outside; extend the table",
            )
