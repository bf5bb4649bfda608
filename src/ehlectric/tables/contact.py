"""Rows of the tables of contacts: of a case before it is solved, and of its solution."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from ehlectric.cases.case import Case
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.contact.results import PointResult, Result
from ehlectric.film.accuracy.max_pressure import UNRESOLVED
from ehlectric.formulas.film_line import FORMULAS as LINE_FORMULAS
from ehlectric.formulas.film_line import Formula, Thickness
from ehlectric.formulas.film_line import regime as line_regime
from ehlectric.formulas.film_point import FORMULAS as POINT_FORMULAS
from ehlectric.formulas.film_point import regime as point_regime
from ehlectric.lubricant.oil import Oil
from ehlectric.quantities.rows import Row
from ehlectric.tables.asperities import asperity_rows
from ehlectric.tables.discharge import discharge_rows
from ehlectric.tables.heat import heat_rows
from ehlectric.tables.meter import meter_rows

_FORMULAS: Mapping[str, Mapping[str, Formula[Any]]] = {"line": LINE_FORMULAS, "point": POINT_FORMULAS}

# Names of the film thicknesses that formulas give, by their attribute.
_FILMS = {"minimum_thickness": "minimum film", "central_thickness": "central film"}


def case_rows(case: Case, conditions: Conditions | PointConditions) -> list[Row]:
    """Rows of a contact before it is solved: its conditions, dry contact, and film thicknesses by formulas.

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
    formulas = _FORMULAS[conditions.geometry]
    thicknesses = {name: formula(conditions.contact) for name, formula in formulas.items()}
    rows = [*condition_rows(conditions, case.electric.voltage, case.oil), *_dry_contact(conditions)]
    rows += [Row("film thickness by published formulas")]
    rows += [Row(name, value, "µm") for _, name, value in _by_formula(formulas, thicknesses)]
    rows += [Row("usual difference from a solved film", "up to 40", "%")]
    rows += [Row("numerical model"), *_GRIDS[conditions.geometry](case, conditions)]
    return [*rows, Row("dimensionless velocity parameter Λ", conditions.velocity_parameter)]


def condition_rows(conditions: Conditions | PointConditions, voltage: float, oil: Oil) -> Iterator[Row]:
    """Rows of the operating conditions that decide film and field.

    Parameters
    ----------
    conditions : Conditions or PointConditions
        Resolved conditions of a case.
    voltage : float
        Voltage across the film [V].
    oil : Oil
        Oil at the temperature of the contact.

    Yields
    ------
    Row
        Load, speeds, temperature, viscosity, radii, modulus and voltage, values in SI units.
    """
    yield Row("operating conditions")
    if isinstance(conditions, PointConditions):
        yield Row("load", conditions.load, "N")
    else:
        yield Row("load per length", conditions.load_per_length, "MN/m")
    yield Row("entrainment speed", conditions.entrainment_speed, "m/s")
    yield Row("slide-to-roll ratio", conditions.slide_to_roll_ratio, note=_surface_speeds(conditions))
    if oil.temperature is not None:
        of = f", {oil.name}" if oil.name else ""
        yield Row("temperature of the oil", f"{oil.temperature - 273.15:.4g}", "°C", of)
    yield Row("viscosity at ambient pressure", conditions.viscosity, "mPa s")
    if isinstance(conditions, PointConditions):
        yield _length("reduced radius along entrainment", conditions.radius_x)
        yield _length("reduced radius across entrainment", conditions.radius_y)
    else:
        yield _length("reduced radius", conditions.reduced_radius)
    yield Row("reduced elastic modulus E'", conditions.reduced_modulus, "GPa")
    yield Row("voltage across the film", voltage, "V")


def _surface_speeds(conditions: Conditions | PointConditions) -> str:
    """Note with the speeds of both surfaces."""
    mean, half = conditions.entrainment_speed, 0.5 * conditions.slide_to_roll_ratio
    if half == 0.0:
        return ", pure rolling"
    return f", surfaces at {mean * (1.0 + half):.4g} and {mean * (1.0 - half):.4g} m/s"


def _length(name: str, value: float) -> Row:
    """Row of a radius in mm, or in m from 1 m."""
    return Row(name, value, "m" if value >= 1.0 else "mm")


def _dry_contact(conditions: Conditions | PointConditions) -> Iterator[Row]:
    """Rows of the dry contact and its groups, in the tables of a case and of its solution."""
    yield Row("dry contact (Hertz)")
    yield Row("Hertz pressure", conditions.max_pressure, "GPa")
    if isinstance(conditions, PointConditions):
        yield Row("semi-axis b along entrainment", conditions.semi_axis_x, "µm")
        yield Row("semi-axis a across entrainment", conditions.semi_axis_y, "µm")
        yield Row("axis ratio a/b", conditions.ratio)
        regime = point_regime(conditions.contact)
    else:
        yield Row("half-width b", conditions.half_width, "µm")
        regime = line_regime(conditions.contact)
    alpha = conditions.pressure_viscosity_coefficient
    yield Row("pressure-viscosity coefficient α*", alpha, "1/GPa", ", reciprocal asymptotic")
    yield Row("load parameter M (Moes)", conditions.contact.moes_m)
    yield Row("material parameter L (Moes)", conditions.contact.moes_l)
    yield Row("lubrication regime", regime)


def _nodes(case: Case, nodes: str) -> Row:
    """Nodes of the film, or the error to which its grid is refined."""
    target = case.grid.target
    if target is None:
        return Row("grid of the film", nodes, "nodes")
    return Row("grid of the film", f"refined to an error of {100.0 * target:g} %")


def _line_grid(case: Case, _: Conditions) -> Iterator[Row]:
    yield _nodes(case, str(case.grid.nodes))
    yield _wedge(case)


def _point_grid(case: Case, conditions: PointConditions) -> Iterator[Row]:
    yield _nodes(case, f"{case.first_grid.nodes_along} x {case.first_grid.nodes_across}")
    yield Row("half-width of the domain across", conditions.side, note="semi-axes a")
    yield _wedge(case)


def _wedge(case: Case) -> Row:
    return Row("discretisation of the wedge term", case.grid.wedge)


def _by_formula(
    formulas: Mapping[str, Formula[Any]], thicknesses: Mapping[str, Thickness]
) -> Iterator[tuple[str, str, float]]:
    """Attribute, name and value [m] of each film thickness that formulas give, minimum thicknesses first."""
    for key, film in _FILMS.items():
        for name, thickness in thicknesses.items():
            value = getattr(thickness, key)
            if value is not None:
                yield key, f"{film} ({formulas[name].name})", value


def result_rows(result: Result | PointResult) -> list[Row]:
    """Rows of a solved contact: its conditions, film, field and discharge, and the film by formulas.

    Parameters
    ----------
    result : Result or PointResult
        Result of ``solve``.

    Returns
    -------
    list of Row
        Values in SI units.
    """
    rows = [*_status(result), *condition_rows(result.conditions, result.field.voltage, result.case.oil)]
    rows += [*_dry_contact(result.conditions), *_film(result), *heat_rows(result)]
    rows += [*_roughness(result), *asperity_rows(result), *_field(result)]
    return [*rows, *discharge_rows(result), *meter_rows(result), *_formulas(result)]


def _status(result: Result | PointResult) -> Iterator[Row]:
    """Row that warns of a film that is not converged."""
    if not result.converged:
        yield Row("NOT CONVERGED", note=f"{result.film.status}: do not use these numbers", alarm=True)


def _film(result: Result | PointResult) -> Iterator[Row]:
    film = result.film
    zone = "Hertz zone" if isinstance(result, Result) else "Hertz ellipse"
    yield Row("film")
    at = _at(result, film.minimum_position) + _where(result)
    yield Row("minimum film thickness h_min", film.minimum_thickness, "µm", at)
    yield Row("central film thickness", film.central_thickness, "µm")
    yield from _supply(result)
    yield Row("mean film thickness", film.mean_thickness, "µm", f", in the {zone}")
    yield Row("maximum pressure", film.max_pressure, "GPa", _pressure_error(film.max_pressure_error))
    nodes = " x ".join(str(count) for count in film.thickness.shape)
    target = result.case.grid.target
    asked = "" if target is None else f", {100.0 * target:g} % asked"
    name, error = "discretisation error of the film", result.film_error
    grid = f", {nodes} nodes{asked}"
    if film.contact_pressure is not None:
        grid = f"where surfaces touch{grid}"
    yield Row(name, "unknown", note=grid) if error is None else Row(name, error, "%", grid, digits=".2g")
    steps = "V-cycles" if result.film_solver == "paper" else "Newton steps"
    after = f"after {film.newton_iterations} {steps}"
    yield Row("residual of the film equations", film.residual, note=after, digits=".1e")
    yield Row("residual of the load balance", film.load_residual, digits=".1e")


def _supply(result: Result | PointResult) -> Iterator[Row]:
    """Rows of the supply of oil of a starved contact; none where it is not given."""
    found = result.film.starvation
    if found is None:
        return
    yield _known("central film / flooded central film", found.film_ratio)
    yield _known("minimum film if flooded", found.flooded_minimum_thickness, "µm")
    yield _known("layer of oil before the contact", found.oil_layer, "µm", ", on both surfaces together")
    place, filled = found.meniscus, "none: flooded"
    if place is not None:
        filled = f"x/b = {place / result.conditions.half_width:.3g}"
    elif result.film.film_fraction is not None:
        filled = "at the inlet edge on y = 0"
    yield Row("meniscus, where oil fills the gap", filled)


def _known(name: str, value: float | None, unit: str = "", note: str = "") -> Row:
    """Row of a number that may be unknown."""
    return Row(name, "unknown") if value is None else Row(name, value, unit, note)


def _pressure_error(error: float | None) -> str:
    """Note with the error of the maximum pressure; empty if the error is unknown."""
    if error is None:
        return ""
    return f", error {100 * error:.2g} %" if error <= UNRESOLVED else ", not resolved by the grid"


def _at(result: Result | PointResult, position: float | tuple[float, float]) -> str:
    """Note with a position in half-widths, or in semi-axes b of a point contact."""
    if isinstance(position, tuple):
        x, y = (place / result.conditions.half_width for place in position)
        return f" at x/b, y/b = {x:.3g}, {y:.3g}"
    return f" at x/b = {position / result.conditions.half_width:.4g}"


def _where(result: Result | PointResult) -> str:
    """Note of a value in the boundary film; empty where the surfaces do not touch."""
    return "" if result.spots is None else ", in the boundary film"


def _roughness(result: Result | PointResult) -> Iterator[Row]:
    """Rows of the roughness within the Hertz zone; none for smooth surfaces."""
    if not result.rough:
        return
    roughness = result.roughness_statistics
    yield Row("roughness")
    for k, rq in ((1, roughness.rq_1), (2, roughness.rq_2)):
        yield Row(f"Rq of surface {k}", rq, "nm", ", in the Hertz zone", digits=".3g")
    if roughness.lambda_ratio is not None:
        least = "minimum film" if result.spots is None else "boundary film"
        about = f", {least} / combined Rq"
        yield Row("lambda ratio", roughness.lambda_ratio, note=about, digits=".3g")
    if roughness.lambda_ratio_smooth is not None:
        about = ", smooth film / combined Rq"
        yield Row("lambda ratio of the smooth film", roughness.lambda_ratio_smooth, note=about, digits=".3g")
    if result.smooth:
        yield Row("minimum film with smooth surfaces", result.smooth.minimum_thickness, "µm")


def _field(result: Result | PointResult) -> Iterator[Row]:
    field = result.field
    at = _at(result, field.max_strength_position) + _where(result)
    if result.rough:
        at += f", {field.max_strength_wall}"
    yield Row("electric field")
    if result.spots is None:
        yield Row("maximum field", field.max_strength, "V/µm", at, bound="≥")
        yield from _accuracy_of_maximum(result)
    else:
        # The voltage over a given gap: nothing of it is computed, and no error is to be stated.
        yield Row("maximum field", field.max_strength, "V/µm", at, digits=".3g")
    if isinstance(result, Result):
        yield from _line_field(result)
    else:
        yield from _point_field(result)


def _accuracy_of_maximum(result: Result | PointResult) -> Iterator[Row]:
    """Rows of the error of the maximum field, and of its ratio to that of parallel plates."""
    name, error = "error of the maximum field", result.field.strength_error
    yield Row(name, "unknown") if error is None else Row(name, error, "%", digits=".1g")
    name = "maximum field / parallel-plate field"
    yield Row(name, result.max_dimensionless, note="(parallel plates: V/h_min)", digits=".4f")
    if result.thin_gap_error is not None:
        yield Row("error of the estimate V/h_min", result.thin_gap_error, "%", digits=".2g")


def _line_field(result: Result) -> Iterator[Row]:
    field = result.field
    yield Row("width of the high-field zone", field.high_field_width, "µm", ", above 95 % of maximum")
    yield Row("capacitance per length", field.capacitance, "nF/m", ", over the field range")
    if result.rough:
        yield Row("grid of the field", str(field.x.size), "columns")


def _point_field(result: PointResult) -> Iterator[Row]:
    field = result.field
    yield Row("area of the high-field zone", field.high_field_area, "µm²", ", above 95 % of maximum")
    yield Row("capacitance", field.capacitance, "pF", ", over the field range")
    for zone, capacitance in result.capacitance_by_zone.items():
        yield Row(f"capacitance of the {_ZONES.get(zone, zone)}", capacitance, "pF")


def _formulas(result: Result | PointResult) -> Iterator[Row]:
    """Rows of the film formulas, each with its difference from the solved film, and of the time."""
    yield Row("film thickness by published formulas")
    formulas = _FORMULAS[result.conditions.geometry]
    for key, name, value in _by_formula(formulas, result.formulas()):
        yield Row(name, value, "µm", _beside_formula(result, key, value))
    if result.spots is None:
        yield Row("usual difference from a solved film", "up to 40", "%")
    else:
        yield Row(
            "difference from the solved film", "none: surfaces touch", note=", formulas are of smooth ones"
        )
    yield Row("run")
    yield Row("computing time", result.film_seconds + result.field_seconds, "s", digits=".2g")


def _beside_formula(result: Result | PointResult, key: str, value: float) -> str:
    """Note with the difference of a film by formula from the solved one, or from that of smooth surfaces.

    Where surfaces touch, the minimum film is the boundary film, and the centre may lie in a spot.
    """
    if not result.converged:
        return ""
    if result.spots is None:
        return f", {100.0 * (value / getattr(result.film, key) - 1.0):+.0f} % vs. solved film"
    if result.smooth is None or key != "minimum_thickness":
        return ""
    return f", {100.0 * (value / result.smooth.minimum_thickness - 1.0):+.0f} % vs. film of smooth surfaces"


# Names of the zones of a point contact, and rows of the grid by the geometry of the contact.
_ZONES = {"hertz": "Hertz ellipse"}
_GRIDS: Mapping[str, Callable[..., Iterator[Row]]] = {"line": _line_grid, "point": _point_grid}
