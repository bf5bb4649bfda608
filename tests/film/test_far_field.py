"""Films of light point contacts with the oil around their domain."""

from dataclasses import replace

import numpy as np
import pytest

from ehlectric.film.atlas.atlas_films import OilGroups, reference_laws
from ehlectric.film.atlas.atlas_groups import Groups
from ehlectric.film.atlas.atlas_problem import film_problem
from ehlectric.film.deflection import point_geometry
from ehlectric.film.face_flow import Fluid
from ehlectric.film.far_field import load_outside, with_far_field
from ehlectric.film.isothermal_film import solve_point_film
from ehlectric.film.mesh import Width
from ehlectric.film.problem import FilmProblem

pytestmark = pytest.mark.convergence


def constant(value):
    return lambda pressure: (np.full_like(pressure, value), np.zeros_like(pressure))


def rigid(velocity_parameter, size, nodes=129):
    """Rigid ball with a constant viscosity on a domain of ``size`` lengths sqrt(2 H) of H = 1."""
    length = size * np.sqrt(2.0)
    return FilmProblem(
        Fluid(constant(1.0), constant(0.0), velocity_parameter, ambient_pressure=0.0),
        nodes=nodes,
        inlet=-length,
        outlet=2.0 * np.sqrt(2.0),
        thickness_guess=1.0,
        wedge_order=3,
        geometry=point_geometry(radius_ratio=1.0, ellipse_ratio=1.0, compliance=0.0),
        width=Width(nodes=nodes, side=length),
        load_exponent=2.0,
    )


def test_load_outside_of_a_wide_domain():
    """Over Y = -S to S, upstream of X = -A with S >> A, the pressure 4 lambda/(5 R^3) cos t carries
    2 pi lambda/(5 A) in all."""
    problem = replace(rigid(0.1, 10.0), inlet=-5.0, width=Width(nodes=129, side=5e3))
    assert load_outside(problem) * problem.geometry.load == pytest.approx(
        2.0 * np.pi * 0.1 / (5.0 * 5.0), rel=2e-3
    )


@pytest.mark.slow
def test_rigid_ball_on_any_domain():
    """With the oil around it, the film does not depend on where the domain ends.

    lambda = 2.05 gives H near 1. The limit of Nijenbanning et al. is H^(1/2) in proportion to lambda over the
    load: their 145 (1 + 0.796)^(-15/7)/1.226 of a centre is 33.7 M^-2, within the 5 % of their fit.
    """
    films = {}
    for size in (6.0, 12.0, 24.0):
        problem = rigid(2.05, size, 2 * int(16 * size) + 1)
        for name, posed in (("ambient", problem), ("far", with_far_field(problem))):
            film = solve_point_film(posed)
            assert film.converged
            films[name, size] = film.central_thickness
    for size in (6.0, 12.0):
        far, ambient = (abs(films[name, size] / films["far", 24.0] - 1.0) for name in ("far", "ambient"))
        assert far < 0.03
        assert ambient > 6.0 * far
    # lambda = 4 pi/N^(4/3) and N = M for a circle's M q^(1/4), with q = (2/pi) R_D(0, 1, 1) = 3/2;
    # H of Moes = (q M)^(2/3) H.
    moes_m = (4.0 * np.pi / 2.05) ** 0.75 / 1.5**0.25
    limit = 145.0 * 1.796 ** (-15.0 / 7.0) / 1.226 / moes_m**2 / (1.5 * moes_m) ** (2.0 / 3.0)
    assert films["far", 24.0] == pytest.approx(limit, rel=0.05)


LAWS = reference_laws()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("load", "lubricant", "ratio"),
    [
        (3.0, 0.5, 1.0),
        (5.0, 2.3, 1.24),
        (5.0, 2.3, 4.0),
        (10.0, 0.5, 1.0),
        (10.0, 10.0, 1.0),
        (60.0, 3.0, 8.0),
    ],
)
def test_smaller_domains(load, lubricant, ratio):
    """A domain of half the size: the far field leaves a third of what ambient edges lose, or 0.1 %.

    The stated loss covers both, and is not above four times that of ambient edges.
    """
    unit = Groups(1.0, lubricant, ratio)
    groups = replace(unit, moes_m=load / unit.load_group)
    wide = film_problem(groups, LAWS, OilGroups.of(*LAWS).alpha, 129)
    assert wide.outside_load > 0.0
    reference = solve_point_film(replace(wide, nodes=257, width=replace(wide.width, nodes=257)))
    small = replace(
        wide,
        inlet=0.5 * wide.inlet,
        width=Width(nodes=129, side=0.5 * wide.width.side),
        edge_pressure=None,
        outside_load=0.0,
        load_exponent=groups.load_exponent,
    )
    lost = {}
    for name, problem in (("ambient", small), ("far", with_far_field(small))):
        film = solve_point_film(problem)
        lost[name] = 1.0 - film.central_thickness / reference.central_thickness
        assert abs(lost[name]) < film.domain_loss + 2e-3
        if name == "ambient":
            assert film.domain_loss < 4.0 * abs(lost[name]) + 0.01
    assert abs(lost["far"]) < max(1e-3, abs(lost["ambient"]) / 3.0)


def test_most_of_the_load_outside():
    """Where most of the load would lie outside, a far field is no answer: the problem stays as it is."""
    problem = rigid(2.05, 3.0)
    heavy = replace(problem, fluid=replace(problem.fluid, velocity_parameter=20.0))
    assert load_outside(heavy) > 0.5
    assert with_far_field(heavy) is heavy
