"""Tables of contacts: what a case means and what its solution is."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rich.table import Table

from ehlectric.cases.case import Case
from ehlectric.commands.tables.discharge import add_discharge
from ehlectric.commands.tables.layout import plain_table
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.contact.results import PointResult, Result
from ehlectric.formulas.film_line import FORMULAS as FILM_LINE_FORMULAS
from ehlectric.formulas.film_line import Formula, Thickness
from ehlectric.formulas.film_line import regime as film_line_regime
from ehlectric.formulas.film_point import FORMULAS, regime


def result_table(result: Result | PointResult) -> Table:
    """The key figures of a solution of any contact."""
    return point_result_table(result) if isinstance(result, PointResult) else line_result_table(result)


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
    add_expected(table, case, films, FORMULAS)
    grid = case.grid
    table.add_row("grid", f"{grid.nodes} x {grid.nodes_across}", f"nodes, {grid.wedge} wedge")
    table.add_row("  sides", f"{conditions.side:.4g}", "semi-axes across")
    return table


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
    add_formulas(table, result, FORMULAS)
    return table


def _in_semi_axes(result: PointResult, position: tuple[float, float]) -> str:
    return ", ".join(f"{at / result.conditions.semi_axis_x:.3g}" for at in position)


def _add_conditions(table: Table, conditions: Conditions) -> None:
    table.add_row("Hertz pressure", f"{conditions.max_pressure / 1e9:.4g}", "GPa")
    table.add_row("half-width", f"{conditions.half_width * 1e6:.4g}", "µm")
    table.add_row("Moes M", f"{conditions.formulas.moes_m:.4g}")
    table.add_row("Moes L", f"{conditions.formulas.moes_l:.4g}")
    table.add_row("regime", film_line_regime(conditions.formulas))


def conditions_table(case: Case, conditions: Conditions) -> Table:
    """What a case means, before it is solved."""
    table = plain_table(case.title)
    table.add_row("reduced radius", f"{conditions.reduced_radius * 1e3:.4g}", "mm")
    table.add_row("reduced modulus", f"{conditions.reduced_modulus / 1e9:.4g}", "GPa")
    table.add_row("load per length", f"{conditions.load_per_length / 1e6:.4g}", "MN/m")
    table.add_row("entrainment speed", f"{conditions.entrainment_speed:.4g}", "m/s")
    table.add_row("slide-to-roll ratio", f"{conditions.slide_to_roll_ratio:.4g}")
    _add_conditions(table, conditions)
    table.add_row("velocity parameter lambda", f"{conditions.velocity_parameter:.4g}")
    films = {name: formula(conditions.formulas) for name, formula in FILM_LINE_FORMULAS.items()}
    add_expected(table, case, films, FILM_LINE_FORMULAS)
    table.add_row("grid", f"{case.grid.nodes}", f"nodes, {case.grid.wedge} wedge")
    return table


def add_expected(
    table: Table, case: Case, films: Mapping[str, Thickness], formulas: Mapping[str, Formula[Any]]
) -> None:
    """Rows of the voltage and of the films that the formulas give, before anything is solved."""
    table.add_row("voltage", f"{case.electric.voltage:.4g}", "V")
    for name, thickness in films.items():
        for key, value in vars(thickness).items():
            if value is not None:
                film = key.removesuffix("_thickness")
                table.add_row(f"{formulas[name].name}, {film}", f"{value * 1e6:.4g}", "µm")


def line_result_table(result: Result) -> Table:
    """The key figures of a solution, with the film formulas and their difference from it."""
    field, conditions = result.field, result.conditions
    table = plain_table(result.case.title)
    add_status(table, result)
    _add_conditions(table, conditions)
    add_film(table, result, ("x/b", f"{result.film.minimum_position / conditions.half_width:.4g}"))
    add_field(table, result, ("x/b", f"{field.max_strength_position / conditions.half_width:.4g}"))
    table.add_row("width above 95 %", f"{field.high_field_width * 1e6:.4g}", "µm")
    table.add_row("capacitance, field range", f"{field.capacitance * 1e9:.4g}", "nF/m")
    add_thin_gap(table, result)
    if result.rough:
        table.add_row("field solved on", f"{field.x.size}", "columns")
        add_roughness(table, result)
    add_discharge(table, result)
    add_formulas(table, result, FILM_LINE_FORMULAS)
    return table


def add_status(table: Table, result: Result | PointResult) -> None:
    """A red row where a film is no solution."""
    if not result.converged:
        status = f"{result.film.status}: do not use these numbers"
        table.add_row("NOT CONVERGED", "", status, style="red")


def add_film(table: Table, result: Result | PointResult, minimum_at: tuple[str, str]) -> None:
    """Rows of the film; where its minimum is, by name and value."""
    film = result.film
    table.add_row("minimum film", f"{film.minimum_thickness * 1e6:.4g}", "µm")
    table.add_row(f"  at {minimum_at[0]}", minimum_at[1])
    table.add_row("central film", f"{film.central_thickness * 1e6:.4g}", "µm")
    table.add_row("mean film, Hertz zone", f"{film.mean_thickness * 1e6:.4g}", "µm")
    table.add_row("maximum pressure", f"{film.max_pressure / 1e9:.4g}", "GPa")
    error = film.discretisation_error
    table.add_row("discretisation error", *(["unknown"] if error is None else [f"{100 * error:.2g}", "%"]))
    steps = "V-cycles" if result.film_solver == "paper" else "Newton steps"
    table.add_row("residual", f"{film.residual:.1e}", f"{film.newton_iterations} {steps}")
    table.add_row("load residual", f"{film.load_residual:.1e}")


def add_field(table: Table, result: Result | PointResult, maximum_at: tuple[str, str]) -> None:
    """Rows of the field; where its maximum is, by name and value."""
    field = result.field
    table.add_row("voltage", f"{field.voltage:.4g}", "V")
    table.add_row("maximum field", f"{field.max_strength / 1e6:.4g}", "V/µm")
    table.add_row(f"  at {maximum_at[0]}", maximum_at[1], field.max_strength_wall if result.rough else "")
    table.add_row("  times h_min/V12", f"{result.max_dimensionless:.4f}")


def add_thin_gap(table: Table, result: Result | PointResult) -> None:
    """A row of what the voltage over the minimum film misses."""
    if result.thin_gap_error is not None:
        table.add_row("V12/h_min below it by", f"{100 * result.thin_gap_error:.2g}", "%")


def add_roughness(table: Table, result: Result | PointResult) -> None:
    """Rows of a rough contact."""
    roughness = result.summary()["roughness"]
    for k in (1, 2):
        table.add_row(f"Rq of surface {k}, Hertz zone", f"{roughness[f'rq_{k}'] * 1e9:.3g}", "nm")
    if roughness["lambda_ratio"] is not None:
        table.add_row("lambda ratio", f"{roughness['lambda_ratio']:.3g}", "minimum film over Rq of both")
    if roughness["lambda_ratio_smooth"] is not None:
        table.add_row("  of the smooth film", f"{roughness['lambda_ratio_smooth']:.3g}")
    if result.smooth:
        table.add_row("minimum film, smooth", f"{result.smooth.minimum_thickness * 1e6:.4g}", "µm")


def add_formulas(table: Table, result: Result | PointResult, formulas: Mapping[str, Formula[Any]]) -> None:
    """Film formulas, each with its difference from the solved film of the same name, and the time."""
    table.add_section()
    about = "difference from the solved film, up to 40 % is usual" if result.converged else ""
    table.add_row("film formulas", "", about)
    for name, thickness in result.formulas().items():
        for key, value in vars(thickness).items():
            if value is not None:
                difference = 100.0 * (value / getattr(result.film, key) - 1.0)
                beside = f", {difference:+.0f} %" if result.converged else ""
                film = key.removesuffix("_thickness")
                table.add_row(f"  {formulas[name].name}, {film}", f"{value * 1e6:.4g}", f"µm{beside}")
    table.add_row("time", f"{result.film_seconds + result.field_seconds:.2g}", "s")
