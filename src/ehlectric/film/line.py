"""Solver for the stationary lubricant film of a line contact, with the result in SI units."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ehlectric.arrays import Array
from ehlectric.film.accuracy.adaptive import RefinedSolution
from ehlectric.film.accuracy.starved import supplied_solution
from ehlectric.film.heated.nested import film_of
from ehlectric.film.heated.outcome import film_status_of, heated_film
from ehlectric.film.problem import FilmProblem
from ehlectric.film.solution import FilmSolution, stationary_film
from ehlectric.film.state import COLLAPSED, Progress
from ehlectric.runtime.parallel.threads import quiet_solution


@dataclass(frozen=True, eq=False, repr=False)
class Film(FilmSolution):
    """Lubricant film of a line contact in SI units, with its status and residuals.

    The attributes are described in ``FilmSolution``; nodal values have the shape (nx,).
    """

    @classmethod
    def of(cls, film: FilmSolution) -> Film:
        """Film of a line contact from a ``FilmSolution`` with nodal values (nx,)."""
        return cls(**vars(film))

    @property
    def axes(self) -> tuple[Array, ...]:
        """Positions of the nodes along entrainment [m], as a tuple with one array."""
        return (self.x,)

    @property
    def minimum_position(self) -> float:
        """Position of the node with the smallest film thickness [m]."""
        return float(self.x[np.argmin(self.thickness)])

    @property
    def central_thickness(self) -> float:
        """Film thickness at x = 0 [m], interpolated between nodes."""
        return float(np.interp(0.0, self.x, self.thickness))

    @property
    def domain_loss(self) -> float | None:
        """Estimated relative loss of film thickness because the domain is too small, dimensionless.

        It is the share of the pressure that is missing, or that of the load where this is more, as in thick
        films of light loads. None for an instant of a transient film.
        """
        if self.inlet_deficit is None:
            return None
        return max(self.inlet_deficit, self.load_deficit or 0.0)

    @property
    def mean_thickness(self) -> float:
        """Mean film thickness over the Hertz zone [m], by the trapezoidal rule."""
        b = self.scales.length
        inside = np.abs(self.x) < b
        x = np.concatenate([[-b], self.x[inside], [b]])
        return float(np.trapezoid(np.interp(x, self.x, self.thickness), x) / (2.0 * b))

    @property
    def collapsed_positions(self) -> Array:
        """Positions [m], shape (n,), where a collapsed film is thinner than 1 % of its central thickness.

        Empty unless the status is "film collapsed".
        """
        if self.status != "film collapsed":
            return np.empty(0)
        return self.x[self.thickness < COLLAPSED * self.central_thickness]

    @property
    def cavitates(self) -> bool:
        """Whether the film cavitates inside the domain, behind its minimum thickness and largest pressure.

        All nodes behind them count, as waves of a rough surface may refill parts of a cavitated outlet.
        """
        behind = max(int(np.argmin(self.thickness)), int(np.argmax(self.pressure)))
        return bool(np.any(self.cavitated[behind:-1]))


def solve_film(problem: FilmProblem, *, progress: Progress | None = None) -> Film:
    """Solve the Reynolds, film and load equations of a line contact.

    Parameters
    ----------
    problem : FilmProblem
        Dimensionless problem of the contact.
    progress : callable, optional
        Function that is called with (nodes, Newton step, residual) before every Newton step.

    Returns
    -------
    Film
        Last iterate, with its status. No error is raised if it did not converge.

    Notes
    -----
    The equations are (1) to (13) of Morris et al. (2022), doi:10.3390/lubricants10050087, and a
    complementarity condition for cavitation, which the paper leaves out. The iteration is nested as in full
    multigrid: the initial guess on every grid is the solution on the next coarser grid.

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
        if problem.physics is None:
            return _film(supplied_solution(problem, progress))
        found = film_of(problem, progress)
        simple, film = _film(found.simple), _film(found.refined)
        status = film_status_of(found, film.status)
        heated = heated_film(
            found,
            _on_line,
            status=status,
            minimum_thickness=simple.minimum_thickness if simple.converged else None,
            central_thickness=simple.central_thickness if simple.converged else None,
        )
        return replace(film, heated=heated, status=status)


def _film(found: RefinedSolution) -> Film:
    """Film in SI units from the dimensionless solutions on all grids."""
    return Film.of(stationary_film(found, _on_line))


def _on_line(values: NDArray[Any]) -> NDArray[Any]:
    """Nodal values (nx,) from those with one node across (nx, 1)."""
    line: NDArray[Any] = values[:, 0]
    return line
