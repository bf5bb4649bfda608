"""Film on a grid that is refined until the estimate of its error is small enough."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from ehlectric.arrays import Array
from ehlectric.film.accuracy.expected import LEAST_UNSEEN, UNSEEN, expected_error
from ehlectric.film.accuracy.patch import Patch
from ehlectric.film.accuracy.rough_film import rough_film_error
from ehlectric.film.nested import nested_iteration
from ehlectric.film.problem import FilmProblem
from ehlectric.film.state import GridSolution, Progress

# Number of successive grids without an error estimate after which refinement stops. Each grid takes several
# times as long as the grid before.
UNKNOWN = 3


@dataclass(frozen=True)
class RefinedSolution:
    """Solution of a film on its last grid, which may be a patch of a coarser grid over the whole domain.

    Attributes
    ----------
    problem : FilmProblem
        Problem of the last grid.
    solutions : list of GridSolution
        Solutions on all grids, as ``nested_iteration`` returns them.
    patch : Patch or None
        Patch that the last grid covers; None if it covers the whole domain.
    """

    problem: FilmProblem
    solutions: list[GridSolution]
    patch: Patch | None = None

    @property
    def last(self) -> GridSolution:
        """Solution on the last grid."""
        return self.solutions[-1]

    @property
    def whole(self) -> GridSolution:
        """Solution on the last grid over the whole domain."""
        return self.last if self.patch is None else self.patch.coarse

    @property
    def fraction(self) -> Array | None:
        """Part of the gap that oil fills on the last grid, shape (nx, ny); None if it is not carried."""
        return self.last.fraction

    @cached_property
    def error(self) -> float | None:
        """Relative discretisation error, estimated from the last grids; None if unknown.

        A grid that is far too coarse has a film of its own, of which successive grids differ little. The
        estimate is then at least 0.5.
        """
        error = rough_film_error(self.problem, self.last, self.coarser)
        posed = self.problem if self.patch is None else self.patch.problem
        times = 1 if self.patch is None else self.patch.times(self.last.level.mesh)
        expected = expected_error(posed, times)
        if error is not None and expected is not None and expected > UNSEEN:
            return max(error, LEAST_UNSEEN)
        return error

    @cached_property
    def coarser(self) -> list[GridSolution]:
        """Last solutions on the coarser grids for the same surfaces, from the finest on."""
        if any(g.status == "converged" and _alike(g, self.last) for g in self.solutions[:-1]):
            # The roughness was raised in steps on the finest grid, so the film of the coarser grid belongs to
            # other surfaces.
            return []
        found = [self.last]
        for solution in reversed(self.solutions):
            if solution.level.mesh.dx > 1.1 * found[-1].level.mesh.dx:
                found.append(solution)
        return found[1:]


def refined_solution(problem: FilmProblem, progress: Progress | None) -> RefinedSolution:
    """Solve the film, and refine its grid until the discretisation error is below the target of the problem.

    Parameters
    ----------
    problem : FilmProblem
        Dimensionless problem of the contact. Without a ``target_error`` only its own grid is solved.
    progress : callable or None
        Function that is called with (nodes, Newton step, residual) before every Newton step.

    Returns
    -------
    RefinedSolution
        Solutions on all grids.

    Notes
    -----
    The spacings are halved along both axes, in a point contact only on a patch where its film is decided.
    The refinement ends below the target, where surfaces touch, at ``most_nodes`` over the whole domain, or
    after three grids in succession whose error is unknown because a film did not converge.
    """
    found = RefinedSolution(problem, nested_iteration(problem, progress))
    target, unknown, times = problem.target_error, 0, 1
    while target is not None:
        error, times = found.error, 2 * times
        problem.tell(found.last.level.mesh, error)
        unknown = unknown + 1 if error is None else 0
        if (error is not None and error <= target) or unknown >= UNKNOWN:
            break
        if times * (problem.nodes - 1) + 1 > problem.most_nodes:
            break
        # A finer grid has other spots of a rough contact. A smooth one may touch on a coarse grid only.
        if found.last.touches and problem.added_gap is not None:
            break
        found = _finer(found, progress)
    return found


def _finer(found: RefinedSolution, progress: Progress | None) -> RefinedSolution:
    """Solution with half of the spacings, on a patch where there is one."""
    patch = found.patch
    if patch is None and found.error is not None:
        patch = Patch.around(found.problem, found.last)
    if patch is None:
        finer = found.problem.doubled()
    else:
        finer = patch.refined(2 * patch.times(found.last.level.mesh))
    return RefinedSolution(finer, nested_iteration(finer, progress, found.solutions), patch)


def _alike(solution: GridSolution, other: GridSolution) -> bool:
    """Whether two solutions have the same grid."""
    return (
        solution.level.mesh.shape == other.level.mesh.shape and solution.level.mesh.dx == other.level.mesh.dx
    )
