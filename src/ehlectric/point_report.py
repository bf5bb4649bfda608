"""Tables for the terminal and JSON of a point contact: what its case means."""

from __future__ import annotations

from typing import Any

from rich.table import Table

from ehlectric.case import Case
from ehlectric.point_conditions import PointConditions
from ehlectric.point_formulas import FORMULAS, regime
from ehlectric.report import plain_table
from ehlectric.result import SCHEMA

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
    table.add_row("voltage", f"{abs(case.electric.potential_2 - case.electric.potential_1):.4g}", "V")
    for name, formula in FORMULAS.items():
        for key, value in vars(formula(conditions.formulas)).items():
            if value is not None:
                film = key.removesuffix("_thickness")
                table.add_row(f"{FORMULA_NAMES[name]}, {film}", f"{value * 1e6:.4g}", "µm")
    grid = case.grid
    nodes_y = grid.nodes if grid.nodes_y is None else grid.nodes_y
    table.add_row("grid", f"{grid.nodes} x {nodes_y}", f"nodes, {grid.wedge} wedge")
    table.add_row("  sides", f"{conditions.side:.4g}", "semi-axes across")
    return table


def point_inputs(case: Case, conditions: PointConditions) -> dict[str, Any]:
    """The case as nested tables, its alternatives resolved."""
    inputs = case.to_dict()
    names = ("radius_x", "radius_y", "reduced_modulus", "load", "entrainment_speed", "slide_to_roll_ratio")
    inputs["contact"] = {"geometry": case.contact.geometry} | {
        name: getattr(conditions, name) for name in names
    }
    inputs["grid"] |= {"side": conditions.side}
    return inputs


def point_groups(conditions: PointConditions) -> dict[str, Any]:
    """Groups and dry contact, with the keys of summary.json."""
    return {
        "groups": {"moes_m": conditions.formulas.moes_m, "moes_l": conditions.formulas.moes_l},
        "hertz": {
            "semi_axis_x": conditions.semi_axis_x,
            "semi_axis_y": conditions.semi_axis_y,
            "max_pressure": conditions.max_pressure,
        },
    }


def point_summary(case: Case, conditions: PointConditions) -> dict[str, Any]:
    """What a point contact's case means, SI units, with the keys of summary.json where they are the same."""
    formulas = conditions.formulas
    return {
        "schema": SCHEMA.replace("summary", "check"),
        "title": case.title,
        "inputs": point_inputs(case, conditions),
        **point_groups(conditions),
        "velocity_parameter": conditions.velocity_parameter,
        "regime": regime(formulas),
        "film_formulas": {name: vars(formula(formulas)) for name, formula in FORMULAS.items()},
    }
