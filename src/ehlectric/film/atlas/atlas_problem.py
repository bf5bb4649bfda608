"""Dimensionless film problem of a contact of the atlas."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from ehlectric.arrays import Array
from ehlectric.film.atlas.atlas_groups import OUTLET, Groups
from ehlectric.film.deflection import point_geometry
from ehlectric.film.face_flow import Fluid
from ehlectric.film.far_field import with_far_field
from ehlectric.film.mesh import Width
from ehlectric.film.problem import FilmProblem

# Tolerance of the scaled residual, at which films change by less than 1e-5, and Newton steps on a grid.
TOLERANCE = 1e-7
_STEPS = 40


def film_problem(
    groups: Groups, laws: tuple[Callable[..., Any], Callable[..., Any]], alpha: float, nodes: int
) -> FilmProblem:
    """Dimensionless film problem of a contact with Moes' groups and an oil. ``laws``, viscosity law
    ln(eta/eta0) and density law rho/rho0 over pressure [Pa]; ``alpha``, coefficient [1/Pa] with which L is
    made.
    """
    pressure = float(groups.hertz_number) / alpha
    guess = float(groups.formula / groups.thickness_unit)
    inlet, side = map(float, groups.domain)
    fluid = Fluid(_over(laws[1], pressure), _over(laws[0], pressure), float(groups.velocity_parameter), 0.0)
    problem = FilmProblem(
        fluid,
        nodes=nodes,
        inlet=-inlet,
        outlet=OUTLET if groups.ratio is not None else 2.0,
        thickness_guess=guess,
        wedge_order=3,
        tolerance=TOLERANCE,
        max_iterations=_STEPS,
    )
    if groups.ratio is None:
        return problem
    k, moes_m, q = float(groups.ratio), float(groups.moes_m), float(groups._q)
    load: float = (q * moes_m) ** (1.0 / 3.0)
    compliance = 3.0 / math.pi**2 / k * moes_m ** (1.0 / 3.0) * q ** (-2.0 / 3.0) / load
    radius_ratio = 1.0 / float(groups.radius_ratio)
    geometry = point_geometry(radius_ratio=radius_ratio, ellipse_ratio=k, compliance=compliance)
    return with_far_field(replace(problem, geometry=geometry, width=Width(nodes=nodes, side=side)))


def _over(law: Callable[..., Any], pressure: float) -> Callable[[Array], tuple[Array, Array]]:
    """Law over P = p/``pressure`` from a law over pressure [Pa]."""

    def scaled(ratio: Array) -> tuple[Array, Array]:
        value, slope = law(pressure * ratio)
        return value, pressure * slope

    return scaled
