"""Tables for the terminal and JSON of a point contact: what its case means and what its solution is."""

from __future__ import annotations

from typing import Any

from rich.table import Table

from ehlectric.case import Case
from ehlectric.discharge_report import add_discharge
from ehlectric.point_conditions import PointConditions
from ehlectric.point_formulas import FORMULAS, regime
from ehlectric.point_result import PointResult, point_hertz, point_inputs
from ehlectric.report import (
    add_expected,
    add_field,
    add_film,
    add_formulas,
    add_roughness,
    add_status,
    add_thin_gap,
    plain_table,
)
from ehlectric.solution import SCHEMA

FORMULA_NAMES = {
    "hamrock_dowson": "Hamrock-Dowson",
    "chittenden": "Chittenden et al.",
    "nijenbanning_venner_moes": "Nijenbanning et al.",
}


def add_point_conditions(table: Table, conditions: PointConditions) -> None:
    """Rows of the dry contact and the groups, that a case and its solution share."""
    table.add_row("Hertz pressure", f"{conditions.max_pressure / 1e9:.4g}", "GPa")
    table.add_row("semi-axis, along", f"{conditions.semi_axis_x * 1e6:.4g}", "µm")
    table.add_row("semi-axis, across", f"{conditions.semi_axis_y * 1e6:.4g}", "µm")
    table.add_row("  across over along", f"{conditions.ratio:.4g}")
    table.add_row("Moes M", f"{conditions.formulas.moes_m:.4g}")
    table.add_row("Moes L", f"{conditions.formulas.moes_l:.4g}")
    table.add_row("regime", regime(conditions.formulas))


def point_table(case: Case, conditions: PointConditions) -> Table:
    """What a case of a point contact means, before it is solved."""
    table = plain_table(case.title)
    table.add_row("reduced radius, along", f"{conditions.radius_x * 1e3:.4g}", "mm")
    table.add_row("reduced radius, across", f"{conditions.radius_y * 1e3:.4g}", "mm")
    table.add_row("reduced modulus", f"{conditions.reduced_modulus / 1e9:.4g}", "GPa")
    table.add_row("load", f"{conditions.load:.4g}", "N")
    table.add_row("entrainment speed", f"{conditions.entrainment_speed:.4g}", "m/s")
    table.add_row("slide-to-roll ratio", f"{conditions.slide_to_roll_ratio:.4g}")
    add_point_conditions(table, conditions)
    table.add_row("velocity parameter lambda", f"{conditions.velocity_parameter:.4g}")
    films = {name: formula(conditions.formulas) for name, formula in FORMULAS.items()}
    add_expected(table, case, films, FORMULA_NAMES)
    grid = case.grid
    table.add_row("grid", f"{grid.nodes} x {grid.nodes_across}", f"nodes, {grid.wedge} wedge")
    table.add_row("  sides", f"{conditions.side:.4g}", "semi-axes across")
    return table


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


def point_result_table(result: PointResult) -> Table:
    """The key figures of a solution, with the film formulas and their difference from it."""
    field, conditions = result.field, result.conditions
    table = plain_table(result.case.title)
    add_status(table, result)
    add_point_conditions(table, conditions)
    add_film(table, result, ("x/b, y/b", _in_semi_axes(result, result.film.minimum_position)))
    nx, ny = result.film.thickness.shape
    table.add_row("grid", f"{nx} x {ny}", "nodes")
    add_field(table, result, ("x/b, y/b", _in_semi_axes(result, field.max_strength_position)))
    table.add_row("area above 95 %", f"{field.high_field_area * 1e12:.4g}", "µm²")
    table.add_row("capacitance, field range", f"{field.capacitance * 1e12:.4g}", "pF")
    for name, capacitance in result.capacitance_by_zone.items():
        table.add_row(f"  {name}", f"{capacitance * 1e12:.4g}", "pF")
    add_thin_gap(table, result)
    if result.rough:
        add_roughness(table, result)
    add_discharge(table, result)
    add_formulas(table, result, FORMULA_NAMES)
    return table


def _in_semi_axes(result: PointResult, position: tuple[float, float]) -> str:
    return ", ".join(f"{at / result.conditions.semi_axis_x:.3g}" for at in position)
