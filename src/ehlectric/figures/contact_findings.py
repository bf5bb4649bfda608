"""Titles of the figures of contacts: one sentence with the finding that a figure shows, from the result."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.contact import PointResult, Result, about_share
from ehlectric.discharge.film_breakdown import FieldUtilisation
from ehlectric.figures.figure_names import (
    BREAKDOWN_FIGURE,
    METER_FIGURE,
    ROUGHNESS_FIGURE,
    SHEAR_FIGURE,
    SPOTS_FIGURE,
    TEMPERATURE_FIGURE,
)
from ehlectric.quantities.units import unit_for
from ehlectric.readable import ratio_text, readable

AnyContact = Result | PointResult

# Part of the half-width of a smooth line contact behind which the film has its constriction.
_CONSTRICTION = 0.8

# Ratio of the maximum pressure to the Hertz pressure above which the maximum is the pressure spike.
_SPIKE = 1.02


def with_unit(value: float, unit: str, *, least: float = 0.1) -> str:
    """Value with three digits and a prefixed unit.

    Examples
    --------
    >>> with_unit(2.98e6, "V/m"), with_unit(0.9999e-9, "m", least=1.0)
    ('2.98 V/µm', '1 nm')
    """
    factor, prefixed = unit_for(float(f"{abs(value):.3g}"), unit, least=least)
    return signed(readable(factor * value)) + f" {prefixed}"


def signed(number: str) -> str:
    """Number with a minus sign instead of a hyphen."""
    return number.replace("-", "−")


def per_cent(part: float) -> str:
    """Share in per cent with two digits, and per mille below a tenth of a per cent.

    Examples
    --------
    >>> per_cent(1.434), per_cent(0.836), per_cent(0.00087)
    ('143 %', '84 %', '0.87 ‰')
    """
    thousandth = abs(part) < 1e-3
    scaled = (1e3 if thousandth else 1e2) * part
    number = f"{scaled:.0f}" if abs(scaled) >= 9.95 else f"{scaled:#.2g}".rstrip(".")
    return signed(number) + (" ‰" if thousandth else " %")


def place_text(result: AnyContact, position: float | tuple[float, ...]) -> str:
    """Position in half-widths, such as "x/b = 0.978" or "x/b = 0.28, y/b = ±0.77".

    The sign of y is left open where both surfaces are smooth, because the film is symmetric about y = 0.
    """
    b = result.conditions.semi_axes[0]
    x, *across = np.atleast_1d(position) / b
    text = signed(f"x/b = {readable(x + 0.0)}")
    for y in across:
        both = not result.rough and abs(y) > 1e-6
        text += ", y/b = " + (f"±{readable(abs(y))}" if both else signed(readable(round(y, 6) + 0.0)))
    return text


def strength_limit(result: AnyContact) -> Array | None:
    """Dielectric strength at the columns of the field [V/m]; None without one, or with a Weibull law."""
    discharge = result.case.discharge
    if discharge is None or discharge.weibull is not None or not discharge.has_strength:
        return None
    return FieldUtilisation.of(discharge, result.film, result.field).dielectric_strength


def film_text(result: AnyContact) -> str:
    """Minimum film, where it is, and how it compares with smooth surfaces or with the centre."""
    film, touching = result.film, result.spots
    if touching is not None:
        spots, mean = touching.spots.number, _film(result, film.mean_thickness)
        return f"Mixed lubrication, {spots} contact spot{'s' if spots > 1 else ''}; mean film {mean}"
    text = (
        f"Minimum film {_film(result, film.minimum_thickness)} at {place_text(result, film.minimum_position)}"
    )
    if result.smooth is None:
        starved = film.starvation
        ratio = None if starved is None else starved.film_ratio
        part = "" if ratio is None else f", {per_cent(ratio)} of the flooded one"
        return f"{text}; central film {_film(result, film.central_thickness)}{part}"
    change = film.minimum_thickness / result.smooth.minimum_thickness - 1.0
    return f"{text}, {_more(change, 'thicker', 'thinner')} than smooth"


def _film(result: AnyContact, thickness: float) -> str:
    """Film thickness in the unit of the figures: maps are in nanometres below a micrometre."""
    return with_unit(thickness, "m", least=1.0 if isinstance(result, PointResult) else 0.1)


def _more(change: float, more: str, less: str) -> str:
    return f"{per_cent(abs(change))} {more if change > 0.0 else less}"


def strength_text(result: AnyContact) -> str:
    """Maximum field and where it is, or that it is the field of the boundary film."""
    field = result.field
    if result.spots is not None:
        return _boundary_film_text(result)
    place = place_text(result, field.max_strength_position)
    if isinstance(result, Result) and not result.rough:
        at = result.field.max_strength_position / result.conditions.half_width
        place = f"the constriction ({place})" if _CONSTRICTION < at < 1.2 else place
    return f"Maximum field {with_unit(field.max_strength, 'V/m')} at {place}"


def _boundary_film_text(result: AnyContact) -> str:
    """Field at the contact spots, with the thickness of the boundary film, which it belongs to."""
    film, field = _film(result, result.film.minimum_thickness), with_unit(result.field.max_strength, "V/m")
    return f"Field {field} at the contact spots, in the boundary film of {film}"


def profiles_text(result: AnyContact) -> str:
    """Maximum field, its ratio to the dielectric strength, and the difference between walls and mid-film."""
    field, limit = result.field, strength_limit(result)
    if result.spots is not None:
        return f"{_boundary_film_text(result)}; walls and mid-film within {per_cent(disagreement(result))}"
    text = f"Maximum field {with_unit(field.max_strength, 'V/m')}"
    if limit is None:
        text += f" at {place_text(result, field.max_strength_position)}"
    else:
        used = field.column_strength / limit
        there = float(limit.flat[np.argmax(used)])
        text += f", {per_cent(float(np.max(used)))} of the strength {with_unit(there, 'V/m')}"
    if result.smooth is not None:
        change = field.max_strength / float(np.max(result.smooth.middle_strength)) - 1.0
        text += f", {_more(change, 'above', 'below')} smooth"
    return f"{text}; walls and mid-film within {per_cent(disagreement(result))}"


def disagreement(result: AnyContact) -> float:
    """Largest relative difference between the fields on both walls and at mid-film of one column."""
    sections = _sections(result)
    apart: Array = np.ptp(sections, axis=0) / np.max(sections, axis=0)
    return float(np.max(apart[result.field.inner]))


def _sections(result: AnyContact) -> Array:
    """Field on both walls and at mid-film [V/m], stacked along a first axis."""
    field = result.field
    return np.stack([field.strength[..., 0], field.middle_strength, field.strength[..., -1]])


def deviation_text(result: AnyContact) -> str:
    """Largest deviation of the field from the thin-gap estimate V12/h, and where it is."""
    field = result.field
    apart: Array = np.max(np.abs(_sections(result) / field.thin_gap_strength - 1.0), axis=0)
    counted = field.inner
    if isinstance(result, PointResult):
        counted = counted & result.zones["hertz"](field.x[:, np.newaxis], field.y)
        counted = counted if np.any(counted) else field.inner
    deviation = np.where(counted, apart, 0.0)
    where = np.unravel_index(np.argmax(deviation), deviation.shape)
    place = tuple(float(axis[k]) for axis, k in zip(field.axes, where, strict=True))
    text = f"The estimate V12/h is within {per_cent(float(np.max(deviation)))} of the field on this grid"
    if isinstance(result, PointResult):
        return f"{text} inside the Hertzian ellipse"
    text += f", worst at {place_text(result, place)}"
    # The faces at the ends of the field range belong to the computation, not to the contact.
    ends = float(np.max(apart, where=~counted, initial=0.0))
    more = f"; at the ends of the range, not drawn, {per_cent(ends)}"
    return text + more if ends > np.max(deviation) else text


def pressure_text(result: PointResult) -> str:
    """Pressure in the centre next to the Hertz pressure, and the pressure spike where it is higher."""
    film, hertz = result.film, result.conditions.max_pressure
    peak = with_unit(film.max_pressure, "Pa")
    what = f"Pressure spike of {peak} on this grid" if has_spike(result) else f"Maximum pressure {peak}"
    return f"{what}; maximum Hertzian pressure {with_unit(hertz, 'Pa')}"


def has_spike(result: PointResult) -> bool:
    """Whether the maximum pressure is the pressure spike of smooth surfaces.

    The height of the spike depends on the grid.
    """
    return not result.rough and result.film.max_pressure > _SPIKE * result.conditions.max_pressure


def roughness_text(result: AnyContact) -> str:
    """Roughness of the rough surfaces, and where their heights are cut off."""
    statistics: Any = result.roughness_statistics
    name = "Rq" if isinstance(result, Result) else "Sq"
    amplitudes = {1: statistics.rq_1, 2: statistics.rq_2}
    rough = [k for k in (1, 2) if np.any(result.roughness[k - 1])]
    parts = [f"{name} {with_unit(amplitudes[k], 'm', least=1.0)} on surface {k}" for k in rough]
    cut = cut_offs(result)
    ends = " and ".join(f"±{with_unit(height, 'm', least=1.0)}" for height in sorted(set(cut.values())))
    return "Roughness in the contact: " + ", ".join(parts) + (f"; heights cut off at {ends}" if cut else "")


def cut_offs(result: AnyContact) -> dict[int, float]:
    """Heights [m] at which the case cuts off the heights of a surface, by the number of the surface."""
    tables = getattr(result.case, "roughness", ())
    return {table.surface: table.truncate for table in tables if getattr(table, "truncate", None)}


def cuts_text(result: PointResult) -> str:
    """Minimum film and maximum field of a point contact."""
    field, limit = result.field, strength_limit(result)
    if result.spots is not None:
        return _boundary_film_text(result)
    film, strongest = _film(result, result.film.minimum_thickness), with_unit(field.max_strength, "V/m")
    text = f"Minimum film {film}, maximum field {strongest}"
    if limit is None:
        return text
    return f"{text}: {per_cent(float(np.max(field.column_strength / limit)))} of the dielectric strength"


def breakdown_text(result: AnyContact) -> str:
    """Whether the film breaks down at the voltage of the case, at which voltage it does, and where."""
    discharge, volts, touching = result.discharge, result.field.voltage, result.spots
    if touching is not None and touching.electrical.breakdown_5 is not None:
        around = (
            "5 % of the film around the spots breaks down at "
            f"{readable(touching.electrical.breakdown_5, 2)} V"
        )
        return f"Mixed lubrication, {touching.electrical.behaviour}: {around}"
    assert discharge is not None and discharge.breakdown_voltage is not None and discharge.margin is not None
    applied, place = f"{readable(volts)} V", place_text(result, discharge.zone_position)
    breaking = f"{readable(discharge.breakdown_voltage)} V"
    if discharge.strength_law == "weibull" and discharge.probability is not None:
        chance = f"{readable(100.0 * discharge.probability, 2)} %"
        return f"Probability of breakdown {chance} at {applied}; 63 % at {breaking}"
    verdict = result.verdict
    assert verdict is not None
    strength = discharge.dielectric_strength
    given = "by the table given" if strength is None else f"{readable(strength / 1e6)} V/µm given"
    # The panels of a point contact say where they cut the film.
    where = f" at {place}" if isinstance(result, Result) else ""
    margin = f"margin {ratio_text(discharge.margin)}, strength {given}"
    return f"{verdict.lead} at {applied}: breakdown voltage {breaking}{where} ({margin})"


def meter_text(result: AnyContact) -> str:
    """Capacitance that a meter reads, and how much of it is outside the Hertz zone and the film's domain."""
    reading = result.meter
    assert reading is not None
    parts = f"{per_cent(reading.share_of_hertz)} in the Hertzian zone"
    parts += f", {per_cent(reading.share_of_outside)} outside the film's domain"
    return f"The meter reads {with_unit(reading.capacitance, 'F', least=1.0)}: {parts}"


def spots_text(result: AnyContact) -> str:
    """Number of spots, the load that they carry, and the electrical behaviour."""
    spots = result.spots
    assert spots is not None
    before = None if spots.coarser is None else spots.coarser.load_share
    share = about_share(spots.touching.load_share, before)
    number = "1 spot carries" if spots.spots.number == 1 else f"{spots.spots.number} spots carry"
    return f"{number} {share} of the load on this grid: the contact is {spots.electrical.behaviour}"


def temperature_text(result: AnyContact) -> str:
    """Temperature rise in the film, and what heat and shear make of the minimum film."""
    heated = result.film.heated
    assert heated is not None and heated.max_temperature_rise is not None
    rise = f"Film up to {readable(heated.max_temperature_rise)} K hotter than the oil in the inlet"
    if not result.film.converged:
        return f"{rise} in the last iteration: not converged"
    return f"{rise}{_thinning(result)}"


def shear_text(result: AnyContact) -> str:
    """Traction coefficient, and what shear makes of the minimum film."""
    heated = result.film.heated
    assert heated is not None
    if heated.traction_coefficient is None:
        return "No traction: the film did not converge"
    return signed(f"Traction coefficient {readable(heated.traction_coefficient)}{_thinning(result)}")


def _thinning(result: AnyContact) -> str:
    """Clause about the minimum film against the isothermal one; none if that did not converge."""
    heated = result.film.heated
    assert heated is not None
    if result.film.contact.any():
        # The minimum is the boundary film with heat and without.
        return "; asperities are in contact"
    if heated.isothermal_minimum_thickness is None:
        return ""
    change = result.film.minimum_thickness / heated.isothermal_minimum_thickness - 1.0
    return f"; {_more(change, 'thicker', 'thinner')} than isothermal and Newtonian"


# Findings by the names of the files of figures; a name that line and point contacts share has one finding.
_FINDINGS: Mapping[str, Callable[[Any], str]] = {
    "film.png": film_text,
    "field_strength.png": strength_text,
    "field_profiles.png": profiles_text,
    "field_deviation.png": deviation_text,
    "film_map.png": film_text,
    "pressure_map.png": pressure_text,
    "field_map.png": strength_text,
    "field_sections.png": strength_text,
    "cuts.png": cuts_text,
    ROUGHNESS_FIGURE: roughness_text,
    BREAKDOWN_FIGURE: breakdown_text,
    METER_FIGURE: meter_text,
    SPOTS_FIGURE: spots_text,
    TEMPERATURE_FIGURE: temperature_text,
    SHEAR_FIGURE: shear_text,
}


def finding(result: AnyContact, name: str) -> str:
    """Finding that a figure of a contact shows, by the name of its file."""
    return _FINDINGS[name](result)
