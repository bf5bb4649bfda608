"""Gaps of any shape with the field in them, as films that nothing was solved for."""

import numpy as np

from ehlectric.field.line_field import solve_field
from ehlectric.field.point_field import solve_point_field
from ehlectric.field.poisson import FieldProblem
from ehlectric.field.poisson_3d import PointFieldProblem
from ehlectric.film.isothermal_film import Film, PointFilm
from ehlectric.film.problem import Scales


def _film(kind, thickness, pressure, density, exit_node, **axes):
    """Full before a node along x and cavitated from it on."""
    cavitated = np.zeros(thickness.shape, dtype=bool)
    cavitated[0] = True
    cavitated[exit_node:] = True
    return kind(
        thickness=thickness,
        pressure=np.zeros_like(thickness) if pressure is None else pressure,
        density=np.ones_like(thickness) if density is None else density,
        deflection=np.zeros_like(thickness),
        cavitated=cavitated,
        reynolds_residual=np.zeros_like(thickness),
        scales=Scales(),
        status="converged",
        residual=0.0,
        load_residual=0.0,
        newton_iterations=0,
        steps=(),
        discretisation_error=0.0,
        inlet_deficit=0.0,
        **axes,
    )


def line_gap(x, thickness, *, pressure=None, density=None, exit_node=-1):
    """Film of a thickness [m] over x [m]."""
    return _film(Film, thickness, pressure, density, exit_node, x=x)


def point_gap(x, y, thickness, *, pressure=None, density=None, exit_node=-1):
    """Film of a thickness (nx, ny) [m] over x and y [m]."""
    axes = {"x": x, "y": y, "semi_axis_y": 1.0, "side_deficit": 0.0}
    return _film(PointFilm, thickness, pressure, density, exit_node, **axes)


def line_gap_field(film, within, *, voltage=1.0, permittivity=1.0):
    """Field above a flat wall at those of the film's nodes that are ``within``."""
    x, upper = film.x[within], film.thickness[within]
    return solve_field(FieldProblem(x, 0.0 * x, upper, permittivity + 0.0 * x, 0.0, voltage))


def point_gap_field(film, along, across, *, voltage=1.0, permittivity=1.0):
    """As ``line_gap_field``, at the nodes ``along`` and ``across``."""
    upper = film.thickness[along][:, across]
    flat = np.zeros_like(upper)
    return solve_point_field(
        PointFieldProblem(film.x[along], film.y[across], flat, upper, flat + permittivity, 0.0, voltage)
    )
