"""Discretisation error of a film that a grid is expected to reach, before the film is solved."""

from __future__ import annotations

import numpy as np

from ehlectric.film.accuracy.patch import part_of_domain
from ehlectric.film.problem import FilmProblem

# Law of the error of smooth, flooded point contacts: e = c/(1 + c) with c = _AT_ONE s**2 and the spacing s
# over H**_OF_FILM, times the ratio of the semi-axes where the contact is longer along entrainment. It is a
# fit to the errors of benchmarks/data/reachable_errors.csv, which are those that the solver states. The
# outlet constriction is about H**(2/3) wide.
_AT_ONE, _OF_FILM = 0.55, 0.75

# Expected error from which on the grid does not see the film: stated errors are then 100 % or much too small,
# as the film is that of the grid. Stated errors below the second number are then not believed.
UNSEEN, LEAST_UNSEEN = 0.9, 0.5

# Expected error above which a grid is taken to have no estimate, so that the next grid covers the domain.
_UNKNOWN = 0.5


def expected_error(problem: FilmProblem, times: int = 1) -> float | None:
    """Discretisation error that is expected of the film of a smooth, flooded point contact.

    Parameters
    ----------
    problem : FilmProblem
        Dimensionless problem of the contact; its ``thickness_guess`` is the film by a formula.
    times : int
        Whole number by which the spacings of its grid are divided.

    Returns
    -------
    float or None
        Relative error that the solver will probably state. None for other contacts, for surfaces that touch,
        and for a wedge term of lower than third order, of which no errors were collected.
    """
    if problem.width is None or problem.added_gap is not None or problem.supply is not None:
        return None
    # The least film is about half of the central one: below the boundary film, the surfaces touch.
    if problem.wedge_order < 3 or 0.5 * problem.thickness_guess < problem.boundary_film:
        return None
    spacing = (problem.outlet - problem.inlet) / (problem.nodes - 1) / times
    scaled = spacing * min(1.0, 1.5 * problem.geometry.load / np.pi) / problem.thickness_guess**_OF_FILM
    change = _AT_ONE * scaled**2
    return float(change / (1.0 + change))


def expected_nodes(problem: FilmProblem, times: int = 1) -> float:
    """Number of nodes that are solved for on a grid whose spacings are those of the problem over ``times``.

    A grid of a point contact that follows one whose error is known covers a patch of the domain only.
    """
    if problem.width is None:
        return float(times * (problem.nodes - 1) + 1)
    across = problem.width.y.size - 1
    nodes = times**2 * (problem.nodes - 1) * across
    before = expected_error(problem, times // 2) if times > 1 else None
    if times == 1 or problem.supply is not None or (before is not None and before > _UNKNOWN):
        return float(nodes)
    return nodes * part_of_domain(problem, problem.thickness_guess)
