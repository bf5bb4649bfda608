"""Warnings about the film and the field of a solved contact."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from ehlectric.cases.case import Case
from ehlectric.cases.grid_inputs import MOST_DEGREE, Grid
from ehlectric.contact.contact_heat import unconverged_heat
from ehlectric.contact.setup import Setup
from ehlectric.contact.warnings import PERMANENT
from ehlectric.field import ATOM, Field, PointField
from ehlectric.film import UNRESOLVED, Film, PointFilm
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.readable import capital, readable

# Estimated relative error of the maximum field above which there is a warning.
FIELD_ERROR = 0.02

# Maximum number of positions that the warning about touching surfaces lists.
_NAMED = 8

# Newton steps that films at high L may need.
_MANY_STEPS = 200

# Relative loss of film thickness, caused by a domain that is too small, above which a point contact gets a
# warning. The loss in the default domain is about 0.01.
_LOSS = 0.02

# Share of the estimated error of the maximum pressure that is added to it for the warning about yielding
# steel. On 692 grids of random rough contacts it missed 4 of 48 films above the limit, and warned of 17
# others.
_LIKELY_RISE = 1.0 / 3.0

# Share of the pressure that builds up upstream of the domain, above which a line contact gets a warning.
_DEFICIT = 0.01


def film_warnings(setup: Case | Setup, film: Film | PointFilm) -> Iterator[ResultWarning]:
    """Warnings about the film of a line or point contact."""
    if not film.converged:
        yield ResultWarning.of(
            "not-converged", status=film.status, residual=film.residual, advice=_advice(setup, film)
        )
    places = film.collapsed_positions / film.scales.length
    # A film with heat or shear has a warning of its own: its surfaces must not touch at all.
    if len(places) and film.heated is None:
        if places.ndim == 1:
            axes, named = "x/b", [f"{x:.3f}" for x in places[:_NAMED]]
        else:
            axes, named = "(x/b, y/b)", [f"({x:.3f}, {y:.3f})" for x, y in places[:_NAMED]]
        more = f" and {len(places) - _NAMED} more nodes" if len(places) > _NAMED else ""
        yield ResultWarning.of("surfaces-touch", "nodes", axes=axes, places=", ".join(named), more=more)
    if film.minimum_thickness < ATOM:
        yield ResultWarning.of("thinner-than-atom")
    for check in setup.oil.film_checks:
        yield from check(film.max_pressure)
    yield from _local_pressure(film, rough=bool(setup.roughness))
    if not film.cavitates:
        yield ResultWarning.of("outlet-too-short")
    # The minimum of a film whose surfaces touch is the boundary film, whatever the grid.
    if film.contact_pressure is None:
        yield from _discretisation(setup, film)


def _discretisation(setup: Case | Setup, film: Film | PointFilm) -> Iterator[ResultWarning]:
    """Warnings about the discretisation error of a film."""
    error = film.discretisation_error
    if film.converged and error is None and setup.roughness:
        yield ResultWarning.of("error-unknown", "stationary")
    elif film.converged and error is None:
        wedge = ", or not with the third-order wedge" if setup.grid.wedge == "first-order" else ""
        yield ResultWarning.of("coarser-grid-unsolved", wedge=wedge)
    elif error is not None and error > max(0.01, setup.grid.target or 0.0):
        code = "grid-far-too-coarse" if error > 0.1 else "grid-too-coarse"
        yield ResultWarning.of(code, "stationary", percent=100 * error)


def _advice(setup: Case | Setup, film: Film | PointFilm) -> str:
    """Advice about a film that did not converge.

    A film thicker than the grid spacing, both in dimensionless units, is resolved. At high L, Newton's
    method needs more steps for such a film. Thinner films need a finer grid.
    """
    heated, rough = film.heated, bool(setup.roughness)
    if heated is not None and heated.thermal and (heated.unsettled is not None or not rough):
        return unconverged_heat(heated, film.scales.pressure, rough=rough)
    if rough:
        hardness = setup.contact.hardness if isinstance(setup, Case) else None
        soft = "" if hardness is None else "raise or omit contact.hardness, "
        advice = f"{soft}lower the roughness, or raise speed or viscosity"
        return f"{capital(advice)}; use more grid.nodes only if they do not resolve the roughness"
    spacing = float(film.x[1] - film.x[0]) / film.scales.length
    resolved = film.central_thickness > spacing * film.scales.thickness
    if film.status == "stalled" and resolved and setup.solver.max_iterations < _MANY_STEPS:
        return f"Try solver.max_iterations = {_MANY_STEPS}"
    return "Try more grid.nodes, a lower grid.inlet, or more solver.max_iterations"


def _local_pressure(film: Film | PointFilm, *, rough: bool) -> Iterator[ResultWarning]:
    """Warning about a local pressure at which bearing steel deforms permanently.

    Steel begins to yield below a smooth contact at a maximum pressure of 0.6 times its hardness
    (K. L. Johnson, Contact Mechanics, 1985, sect. 6.2), which is 4.2 GPa for the 7 GPa of hardened bearing
    steel. The limits of ISO 76 for the Hertz pressure are similar. The peak pressure of a rough film
    may lie between the nodes, so a share of its estimated error is added. A Hertz pressure above the limit
    has its own warning.
    """
    limit = PERMANENT["line" if film.thickness.ndim == 1 else "point"]
    error = (film.max_pressure_error or 0.0) if rough else 0.0
    largest = film.max_pressure * (1.0 + error)
    likely = film.max_pressure * (1.0 + _LIKELY_RISE * error)
    if not film.converged or film.scales.pressure > limit or likely <= limit:
        return
    what, advice = "the pressure spike", "Check load and radii"
    if rough:
        what = "the local pressure of the rough film"
        advice = "Use a surface after running-in, whose asperities are flatter, or a longer cutoff_short"
    reach = f", or about {readable(largest / 1e9, 2)} GPa between the nodes," if error > 0.01 else ""
    if error > UNRESOLVED:
        reach = ", or several times more, as the grid does not resolve it,"
    yield ResultWarning.of(
        "local-plastic-deformation",
        what=what,
        largest=film.max_pressure / 1e9,
        reach=reach,
        hertz=film.scales.pressure / 1e9,
        limit=limit / 1e9,
        advice=advice,
    )


def line_result_warnings(setup: Case | Setup, film: Film, field: Field) -> Iterator[ResultWarning]:
    """Warnings about the inlet of a line contact and about the grid and range of its field."""
    deficit = film.domain_loss
    if deficit is not None and deficit > _DEFICIT:
        inlet, _ = setup.grid.ends
        code = "inlet-far-too-short" if deficit > 0.2 else "inlet-too-short"
        longer = _longer_inlet(inlet, deficit)
        yield ResultWarning.of(code, percent=100 * deficit, inlet=inlet, longer=longer)
    yield from _few_columns(setup.grid, film, field)
    if not np.any(field.inner & (field.x == field.max_strength_position)):
        yield ResultWarning.of("field-range-too-narrow", "line")


def _longer_inlet(inlet: float, deficit: float) -> float:
    """Inlet in half-widths at which no more than 1 % of the pressure builds up upstream, a multiple of 0.5.

    Far upstream the gap is a parabola, the gradient of the reduced pressure falls with the fourth power of
    the distance, and so the missing pressure falls with its cube.

    The ``inlet`` of the case is negative, in half-widths.
    """
    return -math.ceil(-2.0 * inlet * math.cbrt(deficit / _DEFICIT)) / 2.0


def point_result_warnings(setup: Case | Setup, film: PointFilm, field: PointField) -> Iterator[ResultWarning]:
    """Warnings about the domain of a point contact and about the grid and range of its field."""
    loss, upstream, sides = film.domain_loss, film.inlet_deficit, film.side_deficit
    if loss is not None and upstream is not None and sides is not None and loss > _LOSS:
        code = "domain-far-too-small" if loss > 0.2 else "domain-too-small"
        yield ResultWarning.of(code, "point", upstream=100 * upstream, sides=100 * sides, loss=100 * loss)
    yield from _few_columns(setup.grid, film, field)
    x, y = field.max_strength_position
    if not field.inner[field.x == x][:, field.y == y].any():
        yield ResultWarning.of("field-range-too-narrow", "point")


def _few_columns(grid: Grid, film: Film | PointFilm, field: Field | PointField) -> Iterator[ResultWarning]:
    """Warning about a given number of field columns below the number of film nodes in the field range."""
    for key, nodes, of_field in zip(("field_nodes", "field_nodes_y"), film.axes, field.axes, strict=False):
        inside = int(np.count_nonzero((nodes >= of_field[0]) & (nodes <= of_field[-1])))
        columns = getattr(grid, key)
        if columns is not None and columns < inside:
            yield ResultWarning.of("field-grid-too-coarse", key=key, columns=columns, nodes=inside)


def accuracy_warnings(
    grid: Grid, field: Field | PointField, *, estimated: bool = True
) -> Iterator[ResultWarning]:
    """Warning about a maximum field whose estimated error is large, or unknown after an attempt."""
    if field.strength_error is not None and field.strength_error > FIELD_ERROR:
        yield inaccurate_field(grid, field.strength_error, field.s.size - 1, field.sufficient_degree)
    if field.strength_error is None and estimated:
        yield unknown_error()


def unknown_error(where: str = "") -> ResultWarning:
    """Warning about a maximum field whose error is not known, ``where`` of several fields."""
    return ResultWarning.of("field-unresolved", "unknown", where=where)


def inaccurate_field(
    grid: Grid, error: float, degree: int | None = None, sufficient: int | None = None
) -> ResultWarning:
    """Warning about an error of the maximum field."""
    advice = "use more grid.nodes" if grid.field_nodes is None else "use more grid.nodes and grid.field_nodes"
    if degree is not None and sufficient is not None and sufficient > degree:
        advice = f"raise grid.field_degree to {min(sufficient, MOST_DEGREE)}, or {advice}"
        if degree >= MOST_DEGREE:
            advice = "remove waves that are far shorter than the film is thick, as by a cutoff_short"
    return ResultWarning.of("field-unresolved", "inaccurate", percent=100 * error, advice=capital(advice))
