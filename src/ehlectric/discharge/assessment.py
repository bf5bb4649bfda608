"""The discharge of a solved contact: at what voltage its film breaks down, where, and at what cost."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from scipy.constants import epsilon_0

from ehlectric.cases.discharge import Discharge
from ehlectric.cases.lubricant import Lubricant, permittivity_law
from ehlectric.discharge.capacitance import zone_capacitances
from ehlectric.discharge.laws import (
    CURRENT_DENSITY_LIMITS,
    LARGEST_PIT,
    MEAN_PIT,
    SOURCES,
    TUNNELLING,
    WeakestLink,
    breakdown_voltage,
    melted_volume,
    pit_diameter,
    relaxation_time,
    stored_energy,
)
from ehlectric.discharge.utilisation import Stress
from ehlectric.field.line import Field
from ehlectric.field.point import PointField
from ehlectric.field.zones import line_zone_areas, point_zone_areas
from ehlectric.film.line import Film
from ehlectric.film.point import PointFilm


@dataclass(frozen=True)
class Assessment:
    """The discharge of one contact, SI units; None where the case does not say what it takes.

    Capacitances are per length [F/m] for a line contact, and of the contact [F] for a point contact.

    Attributes
    ----------
    strength_law : str or None
        "constant", "table over pressure", "table over temperature" or "weibull".
    dielectric_strength : float or None
        Of the zone that breaks first [V/m]; None for a Weibull law.
    breakdown_voltage, breakdown_voltage_low, breakdown_voltage_high : float or None
        [V]. Of a Weibull law at the probabilities 63.2, 5 and 95 %; the last two are None otherwise.
    margin : float or None
        Breakdown voltage over the voltage of the case.
    probability : float or None
        Of breakdown at the voltage of the case; 0 or 1 unless the law is Weibull's.
    zone_position : float or tuple of float
        Place where the strength is used most, x or (x, y) [m].
    zone_size : float
        Width of the zone around it where it is used to 95 % of that or more [m]; of a point contact the
        diameter of a circle of its area.
    zone_area : float or None
        Its area [m^2]; of a line contact its width times the length.
    zone_over_half_width, zone_over_largest_pit, zone_over_mean_pit : float
        ``zone_size`` over the half-width of the dry contact, or its semi-axis along entrainment, and over
        the published sizes of pits, 4 and 1.7 um.
    capacitance, capacitance_hertz, capacitance_inlet, capacitance_outlet, capacitance_sides : float
        Over the whole domain of the film, and of its zones; only a point contact has sides.
    capacitance_plate, capacitance_ratio : float
        eps0 eps_r A/h(0) of the Hertz zone, eps_r at ambient pressure; the capacitance over it.
    capacitance_outlet_full, capacitance_outlet_fingers, capacitance_outlet_layers : float
        Of the outlet by what fills the gap behind the exit.
    capacitance_full, capacitance_fingers, capacitance_layers : float
        Of all zones by what fills it; of a point contact its sides have a part in that.
    outlet : str
        What ``capacitance`` and the energies count with.
    contact_energy, discharge_energy : float or None
        C V^2/2 of the contact, and with the capacitance that is connected to it [J].
    breakdown_energy : float or None
        The second at the breakdown voltage [J].
    pit_volume, pit_diameter : float or None
        What ``discharge_energy`` melts of one surface [m^3], and the diameter of a hemisphere of it [m].
    current_density, current_density_limits : float and tuple of float, or None
        Peak current over the area of the dry contact, and published limits of it [A/m^2].
    relaxation_time, corner_frequency : float or None
        eps0 eps_r/sigma [s], and the frequency above which the film is a capacitor [Hz].
    """

    strength_law: str | None
    dielectric_strength: float | None
    breakdown_voltage: float | None
    breakdown_voltage_low: float | None
    breakdown_voltage_high: float | None
    margin: float | None
    probability: float | None
    zone_position: float | tuple[float, ...]
    zone_size: float
    zone_area: float | None
    zone_over_half_width: float
    zone_over_largest_pit: float
    zone_over_mean_pit: float
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
    contact_energy: float | None
    discharge_energy: float | None
    breakdown_energy: float | None
    pit_volume: float | None
    pit_diameter: float | None
    current_density: float | None
    current_density_limits: tuple[float, ...] | None
    relaxation_time: float | None
    corner_frequency: float | None

    def summary(self) -> dict[str, Any]:
        """All of it, as ``discharge`` in summary.json, with the sources of what is not computed."""
        found = asdict(self)
        return found | {"sources": {key: text for key, text in SOURCES.items() if found[key] is not None}}


def assess(
    given: Discharge,
    lubricant: Lubricant,
    semi_axes: tuple[float, ...],
    film: Film | PointFilm,
    field: Field | PointField,
) -> Assessment:
    """Assess the discharge of a solved contact.

    Parameters
    ----------
    given : Discharge
        Strength of the lubricant, and what is connected to the contact.
    lubricant : Lubricant
        Its permittivity.
    semi_axes : tuple of float
        Half-width of a line contact, or both semi-axes of a point contact, along and across entrainment [m].
    film, field
        The solution.

    Returns
    -------
    Assessment
        SI units.

    Examples
    --------
    >>> from ehlectric import Case, solve
    >>> contact = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa"}
    >>> contact |= {"max_hertz_pressure": "1 GPa", "entrainment_speed": "4 m/s"}
    >>> case = {"contact": contact, "lubricant": {"base": "paper"}}
    >>> result = solve(Case.from_dict(case | {"discharge": {"dielectric_strength": "15 V/um"}}))
    >>> round(result.discharge.breakdown_voltage, 1)
    11.1
    """
    size = _Size.of(semi_axes, given)
    stress = Stress.of(given, film, field)
    breakdown = _breakdown(given, stress, field.voltage, size)
    capacitances = _capacitances(given, lubricant, semi_axes, film, field)
    total = capacitances["capacitance"]
    plate = epsilon_0 * lubricant.relative_permittivity * size.hertz / film.central_thickness
    return Assessment(
        **breakdown,
        **_zone(stress, size),
        **capacitances,
        capacitance_plate=plate,
        capacitance_ratio=total / plate,
        outlet=given.outlet,
        **_costs(given, size.whole(total), field.voltage, breakdown["breakdown_voltage"]),
        **_current(given, size),
        **_leakage(given, lubricant.relative_permittivity),
    )


@dataclass(frozen=True)
class _Size:
    """Size of the dry contact: a line's width, or a point's area.

    ``length`` makes a line's whole of what is per length; None where it is not known, 1 for a point contact.
    """

    half_width: float
    hertz: float
    length: float | None
    line: bool

    @classmethod
    def of(cls, semi_axes: tuple[float, ...], given: Discharge) -> _Size:
        b = semi_axes[0]
        if len(semi_axes) == 1:
            return cls(b, 2.0 * b, given.length, line=True)
        return cls(b, np.pi * b * semi_axes[1], 1.0, line=False)

    def whole(self, per_length: float) -> float | None:
        """Of the contact, what is given per length of a line."""
        return None if self.length is None else self.length * per_length


def _breakdown(given: Discharge, stress: Stress, voltage: float, size: _Size) -> dict[str, Any]:
    """At what voltage the film breaks down."""
    names = ("strength_law", "dielectric_strength", "breakdown_voltage", "breakdown_voltage_low")
    found: dict[str, Any] = dict.fromkeys((*names, "breakdown_voltage_high", "margin", "probability"))
    if given.weibull is not None:
        law = given.weibull
        assert size.length is not None
        weakest = WeakestLink.of(
            voltage, stress.whole, size.length * stress.areas, law.scale, law.shape, law.reference_area
        )
        breaks = weakest.characteristic_voltage
        found |= {
            "strength_law": "weibull",
            "breakdown_voltage_low": weakest.voltage(0.05),
            "breakdown_voltage_high": weakest.voltage(0.95),
            "probability": weakest.probability(voltage),
        }
    elif given.has_strength:
        table = given.strength_table
        breaks = breakdown_voltage(voltage, stress.strength, stress.withstood)
        found |= {
            "strength_law": "constant" if table is None else f"table over {table.over}",
            "dielectric_strength": stress.withstood_there,
            "probability": float(voltage >= breaks),
        }
    else:
        return found
    return found | {"breakdown_voltage": breaks, "margin": breaks / voltage}


def _zone(stress: Stress, size: _Size) -> dict[str, Any]:
    """Where the film would break first."""
    extent = stress.extent
    across = extent if size.line else float(np.sqrt(4.0 * extent / np.pi))
    return {
        "zone_position": stress.position[0] if size.line else stress.position,
        "zone_size": across,
        "zone_area": size.whole(extent),
        "zone_over_half_width": across / size.half_width,
        "zone_over_largest_pit": across / LARGEST_PIT,
        "zone_over_mean_pit": across / MEAN_PIT,
    }


def _capacitances(
    given: Discharge,
    lubricant: Lubricant,
    semi_axes: tuple[float, ...],
    film: Film | PointFilm,
    field: Field | PointField,
) -> dict[str, Any]:
    """Capacitances by zone, and of the outlet by what fills it."""
    areas = line_zone_areas if len(semi_axes) == 1 else point_zone_areas
    zones = areas(film.axes, *semi_axes), areas(field.axes, *semi_axes)
    by_outlet = zone_capacitances(film, field, zones, permittivity_law(lubricant))
    chosen = by_outlet[given.outlet]
    return {
        "capacitance": sum(chosen.values()),
        **{f"capacitance_{zone}": chosen.get(zone) for zone in ("hertz", "inlet", "outlet", "sides")},
        **{f"capacitance_outlet_{outlet}": found["outlet"] for outlet, found in by_outlet.items()},
        **{f"capacitance_{outlet}": sum(found.values()) for outlet, found in by_outlet.items()},
    }


def _costs(
    given: Discharge, capacitance: float | None, voltage: float, breaks: float | None
) -> dict[str, Any]:
    """Energy of a discharge and what it melts."""
    names = ("contact_energy", "discharge_energy", "breakdown_energy", "pit_volume", "pit_diameter")
    found: dict[str, Any] = dict.fromkeys(names)
    if capacitance is None:
        return found
    found["contact_energy"] = stored_energy(capacitance, voltage)
    if given.external_capacitance is None:
        return found
    together = capacitance + given.external_capacitance
    energy = found["discharge_energy"] = stored_energy(together, voltage)
    found["breakdown_energy"] = None if breaks is None else stored_energy(together, breaks)
    if given.pit is not None:
        volume = melted_volume(energy, given.pit.efficiency, given.pit.melting_energy)
        found |= {"pit_volume": volume, "pit_diameter": pit_diameter(volume)}
    return found


def _current(given: Discharge, size: _Size) -> dict[str, Any]:
    """Apparent current density beside its published limits."""
    area = size.whole(size.hertz)
    if given.peak_current is None or area is None:
        return {"current_density": None, "current_density_limits": None}
    return {
        "current_density": given.peak_current / area,
        "current_density_limits": CURRENT_DENSITY_LIMITS,
    }


def _leakage(given: Discharge, permittivity: float) -> dict[str, Any]:
    """How fast charge leaks through the oil at ambient pressure."""
    if given.conductivity is None:
        return {"relaxation_time": None, "corner_frequency": None}
    time = relaxation_time(permittivity, given.conductivity)
    return {"relaxation_time": time, "corner_frequency": 1.0 / (2.0 * np.pi * time)}


def discharge_findings(given: Discharge | None, film: Film | PointFilm) -> Iterator[str]:
    """What a user should know of the discharge, one text each; nothing without a ``[discharge]``."""
    if given is None:
        return
    if film.minimum_thickness < TUNNELLING:
        yield (
            f"the film is {film.minimum_thickness * 1e9:.2g} nm thin: below about {TUNNELLING * 1e9:g} nm "
            "electrons tunnel through it, which is not in the model"
        )
    table = given.strength_table
    if table is not None and table.over == "pressure":
        low, high = table.places[0], table.places[-1]
        least, most = float(np.min(film.pressure)), film.max_pressure
        if least < low or most > high:
            yield (
                f"the pressure in the film, {least / 1e9:.3g} to {most / 1e9:.3g} GPa, leaves "
                f"discharge.strength_table, {low / 1e9:.3g} to {high / 1e9:.3g} GPa, whose ends hold there"
            )
