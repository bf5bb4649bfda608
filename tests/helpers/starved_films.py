"""Film problems with a supply of oil, and numbers of their solutions, for tests of starved contacts."""

from dataclasses import replace

import numpy as np

from ehlectric.contact.contact_kinds import KINDS
from ehlectric.contact.problems import domain_of
from ehlectric.film.film_solver import starved_solution
from ehlectric.film.mesh import at_centre
from ehlectric.film.nested import nested_iteration
from ehlectric.film.problem import OilSupply
from ehlectric.runtime.threads import quiet_solution


def posed(case):
    """Film problem of a case without a supply of oil, on the grid of its nodes."""
    kind = KINDS[case.contact.geometry]
    conditions = kind.resolve(case)
    return kind.film_problem(case, conditions, kind.rough(case.roughness, domain_of(case, conditions)))


def flooded_flow(problem):
    """Mass rho H of the flooded film at the centre, and its central film thickness H."""
    with quiet_solution():
        last = nested_iteration(problem, None)[-1]
    assert last.status == "converged"
    mesh, thickness = last.level.mesh, last.state.thickness
    return at_centre(mesh, last.final.coefficients.density * thickness), at_centre(mesh, thickness)


def supplied(problem, mass):
    """Solution of a problem with a layer of oil whose mass rho H is a number or a function of Y."""
    ambient = float(problem.fluid.density(np.full(1, problem.fluid.ambient_pressure))[0][0])
    of = mass if callable(mass) else lambda y: np.full(y.shape, mass)
    supply = OilSupply(layer=lambda y: of(y) / ambient)
    with quiet_solution():
        return starved_solution(replace(problem, supply=supply), None)
