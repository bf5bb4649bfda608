"""Assessment of a discharge through a solved contact: breakdown voltage and zone, capacitances, energies."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass, fields, replace
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
    strength_warning_conditions,
)
from ehlectric.discharge.film_capacitance import Capacitances, capacitances
from ehlectric.discharge.film_verdict import breakdown_warning_condition
from ehlectric.field import Field, PointField
from ehlectric.film import Film, PointFilm
from ehlectric.lubricant.oil import Oil
from ehlectric.quantities.result_warnings import ResultWarning, active
from ehlectric.readable import readable


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

    def __getattr__(self, name: str) -> Any:
        if name not in _PART_OF:
            raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")
        return getattr(getattr(self, _PART_OF[name]), name)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *_PART_OF]

    def summary(self) -> dict[str, Any]:
        """Values of all parts, with their sources and assumptions, as in ``discharge`` of summary.json."""
        values: dict[str, Any] = {}
        for part in _PARTS:
            values |= asdict(getattr(self, part))
        return values | {"sources": {key: text for key, text in SOURCES.items() if values[key] is not None}}


_PARTS = {
    "breakdown": Breakdown,
    "zone": BreakdownZone,
    "capacitances": Capacitances,
    "costs": DischargeCosts,
    "leakage": Leakage,
}

# Part that has a value, by the name of the value.
_PART_OF = {value.name: part for part, kind in _PARTS.items() for value in fields(kind)}


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
    result = breakdown(discharge, utilisation, field.voltage, size)
    condition = breakdown_warning_condition(
        "applied voltage",
        field.voltage,
        lambda: f"breakdown voltage {readable(result.breakdown_voltage or 0.0)} V",
        result.margin,
        field=None if discharge.weibull is not None else field.max_strength,
    )
    yield from active([condition, *strength_warning_conditions(discharge)])


def discharge_warnings(discharge: Discharge | None, film: Film | PointFilm) -> Iterator[ResultWarning]:
    """Warnings about the assessment of a discharge; none if the case has no table ``discharge``."""
    if discharge is None:
        return
    if film.minimum_thickness < TUNNELLING:
        yield ResultWarning.of("tunnelling", thickness=film.minimum_thickness * 1e9, least=TUNNELLING * 1e9)
    table = discharge.strength_table
    if table is not None and table.over == "pressure":
        low, high = table.places[0], table.places[-1]
        least, most = float(np.min(film.pressure)), film.max_pressure
        if least < low or most > high:
            yield ResultWarning.of(
                "strength-table-exceeded",
                least=least / 1e9,
                most=most / 1e9,
                first=low / 1e9,
                last=high / 1e9,
            )
