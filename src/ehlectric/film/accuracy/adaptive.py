"""Film on a grid that is refined until the estimate of its error is small enough."""

from __future__ import annotations

from ehlectric.film.accuracy.rough_film import rough_film_error
from ehlectric.film.nested import nested_iteration
from ehlectric.film.problem import FilmProblem
from ehlectric.film.state import GridSolution, Progress

# Number of successive grids without an error estimate after which refinement stops. Each grid takes several
# times as long as the grid before.
UNKNOWN = 3


def refined_solutions(
    problem: FilmProblem, progress: Progress | None
) -> tuple[FilmProblem, list[GridSolution]]:
    """Solve the film, and refine its grid until the discretisation error is below the target of the problem.

    Parameters
    ----------
    problem : FilmProblem
        Dimensionless problem of the contact. Without a ``target_error`` only its own grid is solved.
    progress : callable or None
        Function that is called with (nodes, Newton step, residual) before every Newton step.

    Returns
    -------
    problem : FilmProblem
        Problem with the number of nodes of the last grid.
    solutions : list of GridSolution
        Solutions on all grids, as ``nested_iteration`` returns them.

    Notes
    -----
    The intervals are doubled along both axes. The refinement ends below the target, at ``most_nodes``, or
    after three grids in succession whose error is unknown because a film did not converge.
    """
    solutions = nested_iteration(problem, progress)
    target, unknown = problem.target_error, 0
    while target is not None:
        error = solution_error(problem, solutions)
        unknown = unknown + 1 if error is None else 0
        finer = problem.doubled()
        if (error is not None and error <= target) or unknown >= UNKNOWN or finer.nodes > problem.most_nodes:
            break
        problem, solutions = finer, nested_iteration(finer, progress, solutions)
    return problem, solutions


def solution_error(problem: FilmProblem, solutions: list[GridSolution]) -> float | None:
    """Relative discretisation error of the last solution, estimated from those on the coarser grids.

    Parameters
    ----------
    problem : FilmProblem
        Problem of the last solution.
    solutions : list of GridSolution
        Solutions on all grids, as ``nested_iteration`` returns them.

    Returns
    -------
    float or None
        Relative error of the minimum or of the central film thickness, whichever is larger; None if unknown.
    """
    return rough_film_error(problem, solutions[-1], coarser_solutions(problem, solutions))


def coarser_solutions(problem: FilmProblem, solutions: list[GridSolution]) -> list[GridSolution]:
    """Last solutions on the coarser grids for the same surfaces, from the finest on, for error estimates."""
    if any(g.status == "converged" and g.level.nodes == problem.nodes for g in solutions[:-1]):
        # The roughness was raised in steps on the finest grid, so the coarser grid's film belongs to other
        # surfaces.
        return []
    by_nodes = {solution.level.nodes: solution for solution in solutions}
    return [by_nodes[nodes] for nodes in sorted(by_nodes, reverse=True) if nodes < problem.nodes]
