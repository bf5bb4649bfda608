"""Key figures of a contact as nested tables, before and after the contact is solved."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from ehlectric.cases.case import Case
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.contact.contact_heat import heat_summary
from ehlectric.contact.contact_kinds import KINDS
from ehlectric.contact.contact_solution import Solution
from ehlectric.contact.setup import Setup
from ehlectric.discharge.discharge_laws import conductivity_of
from ehlectric.discharge.film_breakdown import dielectric_strength
from ehlectric.film import Starvation
from ehlectric.formulas.film_line import Thickness
from ehlectric.quantities.result_warnings import texts_and_codes
from ehlectric.quantities.sheets import BREAKDOWN_FORMULAS
from ehlectric.runtime.files import plain

SCHEMA = "ehlectric.summary/1"


def summary_of(solution: Solution[Any, Any, Any]) -> dict[str, Any]:
    """Key figures of a solved contact in SI units, as nested tables with the keys of summary.json. Returns
    numbers, texts and lists; None if a value has no meaning, never NaN.
    """
    kind, film, conditions = KINDS[solution.conditions.geometry], solution.film, solution.conditions
    verdict = solution.verdict
    summary: dict[str, Any] = {
        "schema": SCHEMA,
        "version": solution.version,
        "title": solution.case.title,
        "converged": solution.converged,
        "status": film.status,
        **texts_and_codes(solution.warnings),
        **({} if verdict is None else verdict.as_data()),
        **_on_solved_domain(_known_before(solution.case, conditions), solution),
        "film": _film(solution) | kind.film_summary(solution),
        "field": _field(solution),
        "film_formulas": {name: vars(thickness) for name, thickness in formulas_of(conditions).items()},
        "film_formula_ranges": ranges_of(conditions),
        "seconds": {"film": solution.film_seconds, "field": solution.field_seconds},
    }
    if solution.discharge is not None:
        summary["discharge"] = solution.discharge.summary()
    if solution.asperities is not None:
        summary["asperities"] = solution.asperities.summary()
    if solution.meter is not None:
        summary["meter"] = solution.meter.summary()
    if solution.rough:
        summary["roughness"] = {"surfaces": list(solution.rough)} | vars(kind.roughness(solution))
    return {key: plain(value) for key, value in summary.items()}


def _film(solution: Solution[Any, Any, Any]) -> dict[str, Any]:
    film = solution.film
    names = (
        "minimum_thickness",
        "minimum_position",
        "central_thickness",
        "mean_thickness",
        "max_pressure",
        "load_residual",
        "residual",
        "newton_iterations",
        "max_pressure_error",
    )
    more: dict[str, Any] = {
        "discretisation_error": solution.film_error,
        "target_error": solution.case.grid.target,
        "solver": solution.film_solver,
    }
    more |= _supply(film.starvation) | heat_summary(film.heated)
    return {name: getattr(film, name) for name in names} | more


def _field(solution: Solution[Any, Any, Any]) -> dict[str, Any]:
    field = solution.field
    return {
        "voltage": field.voltage,
        "max_strength": field.max_strength,
        "max_strength_position": field.max_strength_position,
        "max_dimensionless": solution.max_dimensionless,
        **KINDS[solution.conditions.geometry].field_summary(solution),
        "thin_gap_error": solution.thin_gap_error,
        "max_strength_wall": field.max_strength_wall,
        "solver": solution.field_solver,
        "max_strength_error": field.strength_error,
        "degree": field.s.size - 1,
    }


# Digits of the ends of a domain, which are chosen with fewer, and relative rounding of positions of nodes.
_DIGITS_OF_ENDS, _ROUNDING = 9, 1e-9


def _on_solved_domain(tables: dict[str, Any], solution: Solution[Any, Any, Any]) -> dict[str, Any]:
    """Tables with the domain on which the film was solved, where the solver chose it."""
    if not solution.case.grid.default_domain:
        return tables
    film, (along, *across) = solution.film, solution.conditions.semi_axes
    ends = {"inlet": film.x[0] / along, "outlet": film.x[-1] / along}
    if across:
        ends["side"] = film.y[-1] / across[0]
    grid = tables["inputs"]["grid"]
    solved = {
        name: float(f"{end:.{_DIGITS_OF_ENDS}g}")
        for name, end in ends.items()
        if not math.isclose(end, grid[name], rel_tol=_ROUNDING)
    }
    return {**tables, "inputs": {**tables["inputs"], "grid": {**grid, **solved}}}


def case_summary(case: Case | Setup, conditions: Conditions | PointConditions) -> dict[str, Any]:
    """Key figures that are known before a contact is solved, in SI units, with the keys of summary.json.
    Returns inputs, dimensionless groups, dry contact, lubrication regime, and film thickness from the
    published formulas.
    """
    return {
        "schema": SCHEMA.replace("summary", "check"),
        "title": case.title,
        **_known_before(case, conditions),
        "velocity_parameter": conditions.velocity_parameter,
        "regime": KINDS[conditions.geometry].regime(conditions.contact),
        "film_formulas": {name: vars(thickness) for name, thickness in formulas_of(conditions).items()},
        "film_formula_ranges": ranges_of(conditions),
    }


def _known_before(case: Case | Setup, conditions: Conditions | PointConditions) -> dict[str, Any]:
    """Inputs, oil, dimensionless groups and dry contact, which are known before a contact is solved."""
    contact, hertz_keys = conditions.contact, KINDS[conditions.geometry].hertz_keys
    return {
        "inputs": inputs_of(case, conditions),
        "lubricant": oil_of(case),
        "groups": {"moes_m": contact.moes_m, "moes_l": contact.moes_l},
        "hertz": {name: getattr(conditions, name) for name in hertz_keys},
    }


def inputs_of(case: Case | Setup, conditions: Conditions | PointConditions) -> dict[str, Any]:
    """Inputs of a contact as nested tables, with the resolved operating conditions as its contact."""
    kind = KINDS[conditions.geometry]
    inputs = case.plain_tables() if isinstance(case, Case) else case.to_dict()
    contact = {name: getattr(conditions, name) for name in kind.contact_keys}
    if case.oil.temperature is not None:
        contact["temperature"] = case.oil.temperature
    inputs["contact"] = {"geometry": conditions.geometry} | contact
    inputs["grid"]["inlet"], inputs["grid"]["outlet"] = case.grid.ends
    inputs["grid"] |= {name: getattr(conditions, name) for name in kind.grid_keys}
    return inputs


def oil_of(case: Case | Setup) -> dict[str, Any]:
    """Oil at the temperature of the contact; a conductivity of ``[discharge]`` replaces the conductivity of
    the oil.
    """
    oil = case.oil
    return oil.summary() | {"conductivity": conductivity_of(case.discharge, oil)}


def formulas_of(conditions: Conditions | PointConditions) -> Mapping[str, Thickness]:
    """Film thickness from each published formula [m], keyed by the name of the formula."""
    formulas = KINDS[conditions.geometry].formulas
    return {name: formula(conditions.contact) for name, formula in formulas.items()}


def ranges_of(conditions: Conditions | PointConditions) -> dict[str, dict[str, str | None]]:
    """Reason why a contact is outside the range of each published formula, for each film."""
    formulas = KINDS[conditions.geometry].formulas
    return {name: formula.ranges(conditions.contact) for name, formula in formulas.items()}


def breakdown_by_formula(
    case: Case | Setup, conditions: Conditions | PointConditions
) -> dict[str, Any] | None:
    """Breakdown voltage of the minimum film of a formula; None without a strength that is known beforehand,
    and for an oil whose viscosity does not grow with pressure.

    A strength over pressure and a Weibull law need the field in the whole film.
    """
    discharge = case.discharge
    if discharge is None or not discharge.has_strength:
        return None
    if discharge.strength_table is not None and discharge.strength_table.over == "pressure":
        return None
    films = minimum_by_formula(conditions)
    film = films["minimum_thickness"]
    if film is None:
        return None
    strength = float(dielectric_strength(discharge, np.zeros(())))
    voltage, applied = strength * film, case.electric.voltage
    return films | {
        "dielectric_strength": strength,
        "breakdown_voltage": voltage,
        "applied_voltage": applied,
        "margin": voltage / applied if applied else None,
    }


def minimum_by_formula(conditions: Conditions | PointConditions) -> dict[str, Any]:
    """Minimum film of a smooth contact by the formula that breakdown and lambda ratio use.

    Returns the name of the formula, why the contact is ``outside_range``, or None, and
    ``minimum_thickness`` [m], None if the viscosity does not grow with pressure.
    """
    formula = KINDS[conditions.geometry].formulas[BREAKDOWN_FORMULAS[conditions.geometry]]
    film = formula(conditions.contact).minimum_thickness
    return {
        "formula": formula.name,
        "outside_range": formula.ranges(conditions.contact)["minimum_thickness"],
        "minimum_thickness": None if film is None else float(film),
    }


def _supply(starvation: Starvation | None) -> dict[str, Any]:
    """Key figures of the supply of oil, for the table ``film`` of a summary; empty without a supply."""
    if starvation is None:
        return {}
    return {
        "oil_layer": starvation.oil_layer,
        "film_ratio": starvation.film_ratio,
        "meniscus": starvation.meniscus,
        "flooded": {
            "minimum_thickness": starvation.flooded_minimum_thickness,
            "central_thickness": starvation.flooded_central_thickness,
        },
    }
