"""The lubricant film of a loaded line contact in SI units."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.nested import nested_iteration
from ehlectric.film.problem import FilmProblem
from ehlectric.film.solution import COLLAPSED, FilmSolution, quiet_solution, stationary_film
from ehlectric.film.state import Progress


@dataclass(frozen=True)
class Film(FilmSolution):
    """Film of a line contact in SI units, with how it was obtained.

    Its attributes are those of ``FilmSolution``; nodal values have the shape (nx,).
    """

    @classmethod
    def of(cls, film: FilmSolution) -> Film:
        """Film of a line contact whose nodal values (nx,) are known."""
        return cls(**vars(film))

    @property
    def axes(self) -> tuple[Array, ...]:
        """Nodes along entrainment [m], as a tuple of one axis."""
        return (self.x,)

    @property
    def minimum_position(self) -> float:
        """Position of the lowest node [m]."""
        return float(self.x[np.argmin(self.thickness)])

    @property
    def central_thickness(self) -> float:
        """Film thickness at x = 0, interpolated [m]."""
        return float(np.interp(0.0, self.x, self.thickness))

    @property
    def mean_thickness(self) -> float:
        """Mean film thickness over the Hertz zone, by the trapezoidal rule [m]."""
        b = self.scales.length
        inside = np.abs(self.x) < b
        x = np.concatenate([[-b], self.x[inside], [b]])
        return float(np.trapezoid(np.interp(x, self.x, self.thickness), x) / (2.0 * b))

    @property
    def collapsed_positions(self) -> Array:
        """Positions where a collapsed film is thinner than a hundredth of its central thickness [m]."""
        if self.status != "film collapsed":
            return np.empty(0)
        return self.x[self.thickness < COLLAPSED * self.central_thickness]

    @property
    def cavitates(self) -> bool:
        """Whether the film cavitates before the domain ends, behind its minimum and its largest pressure.

        Not only at its end: waves of a rough surface refill pockets of a cavitated outlet.
        """
        behind = max(int(np.argmin(self.thickness)), int(np.argmax(self.pressure)))
        return bool(np.any(self.cavitated[behind:-1]))


def solve_film(problem: FilmProblem, *, progress: Progress | None = None) -> Film:
    """Solve the Reynolds, film and load equations of a line contact.

    Parameters
    ----------
    problem : FilmProblem
        The contact, dimensionless.
    progress : callable, optional
        Called with (nodes, Newton step, residual) before every Newton step.

    Returns
    -------
    Film
        Whatever was reached, with its status: nothing is raised where it is not a solution.

    Notes
    -----
    Eqs. (1) to (13) of Morris et al. (2022), doi:10.3390/lubricants10050087, and the complementarity
    condition for cavitation that they leave out. The nested iteration is that of full multigrid: every
    grid starts from the solution on the next coarser.

    Examples
    --------
    >>> import numpy as np
    >>> from ehlectric.film.flow import Fluid
    >>> incompressible = lambda p: (np.ones_like(p), np.zeros_like(p))
    >>> isoviscous = lambda p: (np.zeros_like(p), np.zeros_like(p))
    >>> fluid = Fluid(incompressible, isoviscous, velocity_parameter=0.01, ambient_pressure=0.0)
    >>> solve_film(FilmProblem(fluid, 401, -4.0, 2.0, thickness_guess=0.1)).status
    'converged'
    """
    with quiet_solution():
        solutions = nested_iteration(problem, progress)
        return Film.of(stationary_film(problem, solutions, lambda values: values[:, 0]))
