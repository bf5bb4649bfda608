"""Rows of the tables of contacts: of a case before it is solved, and of its solution."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from ehlectric.cases.case import Case
from ehlectric.cases.row import Row
from ehlectric.commands.tables.discharge import discharge_rows, duty_rows
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.contact.results import PointResult, Result
from ehlectric.formulas.film_line import FORMULAS as LINE_FORMULAS
from ehlectric.formulas.film_line import Formula, Thickness
from ehlectric.formulas.film_line import regime as line_regime
from ehlectric.formulas.film_point import FORMULAS as POINT_FORMULAS
from ehlectric.formulas.film_point import regime as point_regime

_FORMULAS: Mapping[str, Mapping[str, Formula[Any]]] = {"line": LINE_FORMULAS, "point": POINT_FORMULAS}


def case_rows(case: Case, conditions: Conditions | PointConditions) -> list[Row]:
    """Rows of a contact before it is solved: its conditions, its groups, and what the formulas predict.

    Parameters
    ----------
    case : Case
        Case of a line or point contact.
    conditions : Conditions or PointConditions
        Resolved conditions of the case.

    Returns
    -------
    list of Row
        Values in SI units.
    """
    return list(_CASES[conditions.geometry](case, conditions))


def result_rows(result: Result | PointResult) -> list[Row]:
    """Rows of a solved contact: key figures of film, field and discharge, beside the film formulas.

    Parameters
    ----------
    result : Result or PointResult
        Result of ``solve``.

    Returns
    -------
    list of Row
        Values in SI units.
    """
    return list(_RESULTS[result.conditions.geometry](result))


def _line_case(case: Case, conditions: Conditions) -> Iterator[Row]:
    yield Row("reduced radius", conditions.reduced_radius, "mm")
    yield Row("reduced modulus", conditions.reduced_modulus, "GPa")
    yield Row("load per length", conditions.load_per_length, "MN/m")
    yield from _speeds(conditions)
    yield from _line_conditions(conditions)
    yield Row("velocity parameter lambda", conditions.velocity_parameter)
    yield from _expected(case, conditions)
    yield Row("grid", str(case.grid.nodes), note=f"nodes, {case.grid.wedge} wedge")


def _point_case(case: Case, conditions: PointConditions) -> Iterator[Row]:
    yield Row("reduced radius, along", conditions.radius_x, "mm")
    yield Row("reduced radius, across", conditions.radius_y, "mm")
    yield Row("reduced modulus", conditions.reduced_modulus, "GPa")
    yield Row("load", conditions.load, "N")
    yield from _speeds(conditions)
    yield from _point_conditions(conditions)
    yield Row("velocity parameter lambda", conditions.velocity_parameter)
    yield from _expected(case, conditions)
    grid = case.grid
    yield Row("grid", f"{grid.nodes} x {grid.nodes_across}", note=f"nodes, {grid.wedge} wedge")
    yield Row("  sides", conditions.side, note="semi-axes across")


def _speeds(conditions: Conditions | PointConditions) -> Iterator[Row]:
    yield Row("entrainment speed", conditions.entrainment_speed, "m/s")
    yield Row("slide-to-roll ratio", conditions.slide_to_roll_ratio)


def _line_conditions(conditions: Conditions) -> Iterator[Row]:
    """Rows of the dry contact and its groups, in the tables of a case and of its solution."""
    yield Row("Hertz pressure", conditions.max_pressure, "GPa")
    yield Row("half-width", conditions.half_width, "µm")
    yield Row("Moes M", conditions.contact.moes_m)
    yield Row("Moes L", conditions.contact.moes_l)
    yield Row("regime", line_regime(conditions.contact))


def _point_conditions(conditions: PointConditions) -> Iterator[Row]:
    """Rows of the dry contact and its groups, in the tables of a case and of its solution."""
    yield Row("Hertz pressure", conditions.max_pressure, "GPa")
    yield Row("semi-axis, along", conditions.semi_axis_x, "µm")
    yield Row("semi-axis, across", conditions.semi_axis_y, "µm")
    yield Row("  across over along", conditions.ratio)
    yield Row("Moes M", conditions.contact.moes_m)
    yield Row("Moes L", conditions.contact.moes_l)
    yield Row("regime", point_regime(conditions.contact))


def _expected(case: Case, conditions: Conditions | PointConditions) -> Iterator[Row]:
    """Rows of the voltage, and of the film thicknesses of the formulas."""
    yield Row("voltage", case.electric.voltage, "V")
    formulas = _FORMULAS[conditions.geometry]
    for name, formula in formulas.items():
        for film, value in _films(formula(conditions.contact)):
            yield Row(f"{formulas[name].name}, {film}", value, "µm")


def _films(thickness: Thickness) -> Iterator[tuple[str, float]]:
    """Film thicknesses that a formula gives [m], with their names, such as "minimum"."""
    for key, value in vars(thickness).items():
        if value is not None:
            yield key.removesuffix("_thickness"), value


def _line_result(result: Result) -> Iterator[Row]:
    field, half_width = result.field, result.conditions.half_width
    yield from _status(result)
    yield from duty_rows(result)
    yield from _line_conditions(result.conditions)
    yield from _film(result, Row("  at x/b", result.film.minimum_position / half_width))
    yield from _field(result, "  at x/b", f"{field.max_strength_position / half_width:.4g}")
    yield Row("width above 95 %", field.high_field_width, "µm")
    yield Row("capacitance, field range", field.capacitance, "nF/m")
    yield from _thin_gap(result)
    if result.rough:
        yield Row("field solved on", str(field.x.size), note="columns")
        yield from _roughness(result)
    yield from discharge_rows(result)
    yield from _formulas(result)


def _point_result(result: PointResult) -> Iterator[Row]:
    field, film = result.field, result.film
    yield from _status(result)
    yield from duty_rows(result)
    yield from _point_conditions(result.conditions)
    yield from _film(result, Row("  at x/b, y/b", _in_semi_axes(result, film.minimum_position)))
    nx, ny = film.thickness.shape
    yield Row("grid", f"{nx} x {ny}", note="nodes")
    yield from _field(result, "  at x/b, y/b", _in_semi_axes(result, field.max_strength_position))
    yield Row("area above 95 %", field.high_field_area, "µm²")
    yield Row("capacitance, field range", field.capacitance, "pF")
    for name, capacitance in result.capacitance_by_zone.items():
        yield Row(f"  {name}", capacitance, "pF")
    yield from _thin_gap(result)
    if result.rough:
        yield from _roughness(result)
    yield from discharge_rows(result)
    yield from _formulas(result)


def _in_semi_axes(result: PointResult, position: tuple[float, float]) -> str:
    """Position over the semi-axis along entrainment, as text."""
    return ", ".join(f"{at / result.conditions.semi_axis_x:.3g}" for at in position)


def _status(result: Result | PointResult) -> Iterator[Row]:
    """Row that warns of a film that is not converged."""
    if not result.converged:
        yield Row("NOT CONVERGED", note=f"{result.film.status}: do not use these numbers", alarm=True)


def _film(result: Result | PointResult, minimum_at: Row) -> Iterator[Row]:
    film = result.film
    yield Row("minimum film", film.minimum_thickness, "µm")
    yield minimum_at
    yield Row("central film", film.central_thickness, "µm")
    yield Row("mean film, Hertz zone", film.mean_thickness, "µm")
    yield Row("maximum pressure", film.max_pressure, "GPa")
    error = film.discretisation_error
    if error is None:
        yield Row("discretisation error", "unknown")
    else:
        yield Row("discretisation error", error, "%", digits=".2g")
    steps = "V-cycles" if result.film_solver == "paper" else "Newton steps"
    yield Row("residual", film.residual, note=f"{film.newton_iterations} {steps}", digits=".1e")
    yield Row("load residual", film.load_residual, digits=".1e")


def _field(result: Result | PointResult, place: str, maximum_at: str) -> Iterator[Row]:
    field = result.field
    yield Row("voltage", field.voltage, "V")
    yield Row("maximum field", field.max_strength, "V/µm")
    yield Row(place, maximum_at, note=field.max_strength_wall if result.rough else "")
    yield Row("  times h_min/V12", result.max_dimensionless, digits=".4f")


def _thin_gap(result: Result | PointResult) -> Iterator[Row]:
    """Row of the difference between the largest field and the voltage over the minimum film."""
    if result.thin_gap_error is not None:
        yield Row("V12/h_min below it by", result.thin_gap_error, "%", digits=".2g")


def _roughness(result: Result | PointResult) -> Iterator[Row]:
    roughness = result.roughness_statistics
    for k, rq in ((1, roughness.rq_1), (2, roughness.rq_2)):
        yield Row(f"Rq of surface {k}, Hertz zone", rq, "nm", digits=".3g")
    if roughness.lambda_ratio is not None:
        yield Row("lambda ratio", roughness.lambda_ratio, note="minimum film over Rq of both", digits=".3g")
    if roughness.lambda_ratio_smooth is not None:
        yield Row("  of the smooth film", roughness.lambda_ratio_smooth, digits=".3g")
    if result.smooth:
        yield Row("minimum film, smooth", result.smooth.minimum_thickness, "µm")


def _formulas(result: Result | PointResult) -> Iterator[Row]:
    """Rows of the film formulas, each with its difference from the solved film, and of the time."""
    formulas = _FORMULAS[result.conditions.geometry]
    about = "difference from the solved film, up to 40 % is usual" if result.converged else ""
    yield Row("film formulas", note=about)
    for name, thickness in result.formulas().items():
        for film, value in _films(thickness):
            difference = 100.0 * (value / getattr(result.film, f"{film}_thickness") - 1.0)
            beside = f", {difference:+.0f} %" if result.converged else ""
            yield Row(f"  {formulas[name].name}, {film}", value, "µm", beside)
    yield Row("time", result.film_seconds + result.field_seconds, "s", digits=".2g")


# Rows by the geometry of the contact: before it is solved, and of its solution.
_CASES: Mapping[str, Callable[..., Iterator[Row]]] = {"line": _line_case, "point": _point_case}
_RESULTS: Mapping[str, Callable[..., Iterator[Row]]] = {"line": _line_result, "point": _point_result}
