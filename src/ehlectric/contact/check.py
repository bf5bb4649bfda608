"""What a case means in numbers, and whether it can be solved."""

from __future__ import annotations

from typing import Any

from ehlectric.cases.case import Case
from ehlectric.contact.conditions import (
    Conditions,
    PointConditions,
    point_hertz,
    point_inputs,
    resolve,
    resolve_point,
    resolved_inputs,
)
from ehlectric.contact.memory import check_memory
from ehlectric.contact.problems import domain_of, line_domain_of
from ehlectric.contact.solution import SCHEMA
from ehlectric.formulas.film_line import FORMULAS as FILM_LINE_FORMULAS
from ehlectric.formulas.film_line import regime as film_line_regime
from ehlectric.formulas.film_point import FORMULAS, regime
from ehlectric.surfaces.rough_maps import rough_maps
from ehlectric.surfaces.rough_profiles import rough_surfaces


def check_case(case: Case) -> None:
    """Refuse, before a folder is made for its results, a case that cannot be solved.

    Raises
    ------
    InputError
        As ``meaning`` does.
    """
    if case.contact.geometry == "point":
        rough_maps(case.roughness, domain_of(case, resolve_point(case)))
    else:
        rough_surfaces(case.roughness, line_domain_of(case, resolve(case)))
    check_memory(case)


def point_summary(case: Case, conditions: PointConditions) -> dict[str, Any]:
    """What a point contact's case means, SI units, with the keys of summary.json where they are the same."""
    formulas = conditions.formulas
    return {
        "schema": SCHEMA.replace("summary", "check"),
        "title": case.title,
        "inputs": point_inputs(case, conditions),
        "groups": {"moes_m": formulas.moes_m, "moes_l": formulas.moes_l},
        "hertz": point_hertz(conditions),
        "velocity_parameter": conditions.velocity_parameter,
        "regime": regime(formulas),
        "film_formulas": {name: vars(formula(formulas)) for name, formula in FORMULAS.items()},
    }


def conditions_summary(case: Case, conditions: Conditions) -> dict[str, Any]:
    """What a case means, SI units, with the keys of summary.json where they are the same."""
    formulas = conditions.formulas
    return {
        "schema": SCHEMA.replace("summary", "check"),
        "title": case.title,
        "inputs": resolved_inputs(case, conditions),
        "groups": {"moes_m": formulas.moes_m, "moes_l": formulas.moes_l},
        "hertz": {"half_width": conditions.half_width, "max_pressure": conditions.max_pressure},
        "velocity_parameter": conditions.velocity_parameter,
        "regime": film_line_regime(formulas),
        "film_formulas": {name: vars(formula(formulas)) for name, formula in FILM_LINE_FORMULAS.items()},
    }
