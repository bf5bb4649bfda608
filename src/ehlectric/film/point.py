"""The lubricant film of a loaded point contact in SI units: maps over (x, y)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import RegularGridInterpolator

from ehlectric.arrays import Array
from ehlectric.film.estimates import side_deficit
from ehlectric.film.line import COLLAPSED, Film, found, quiet_solution
from ehlectric.film.nested import nested_iteration
from ehlectric.film.problem import FilmProblem
from ehlectric.film.state import Progress

# Points of the quadrature over the Hertz ellipse, along its radius and around it.
_RADII, _ANGLES = 64, 256

# What of the missing pressure is missing in the film: 0.3 to 0.5 over four contacts, M 20 to 300, ellipse
# ratio 1 to 8, solved on domains of up to four times the length and twice the width.
_LOST = 0.4


@dataclass(frozen=True)
class PointFilm(Film):
    """Film of a point contact in SI units, with how it was obtained.

    As ``Film``, its arrays of shape (nx, ny), and beside it:

    Attributes
    ----------
    y : ndarray, shape (ny,)
        Position across entrainment [m].
    semi_axis_y : float
        Semi-axis of the dry contact across entrainment [m]; that along it is ``scales.length``.
    side_deficit : float
        Share of the reduced pressure that there would be at the sides, where the domain holds it at ambient.
    """

    y: Array
    semi_axis_y: float
    side_deficit: float

    @property
    def domain_loss(self) -> float:
        """About the part by which the film is too thin because the domain ends where it does."""
        return _LOST * (self.inlet_deficit + self.side_deficit)

    @property
    def minimum_position(self) -> tuple[float, float]:  # type: ignore[override]
        """Position (x, y) of the lowest node [m]."""
        i, j = np.unravel_index(np.argmin(self.thickness), self.thickness.shape)
        return float(self.x[i]), float(self.y[j])

    def _at(self, x: Array, y: Array) -> Array:
        """Film thickness between the nodes, by linear interpolation [m]."""
        thickness: Array = RegularGridInterpolator((self.x, self.y), self.thickness)((x, y))
        return thickness

    @property
    def central_thickness(self) -> float:
        """Film thickness at x = y = 0, interpolated [m]."""
        return float(self._at(np.zeros(1), np.zeros(1))[0])

    @property
    def mean_thickness(self) -> float:
        """Mean film thickness over the Hertz ellipse [m]."""
        points, weights = np.polynomial.legendre.leggauss(_RADII)
        radius = np.sqrt(0.5 * (points[:, np.newaxis] + 1.0))  # equal weights for equal areas
        angle = 2.0 * np.pi * np.arange(_ANGLES) / _ANGLES
        x = self.scales.length * radius * np.cos(angle)
        y = self.semi_axis_y * radius * np.sin(angle)
        return float(0.5 * weights @ np.mean(self._at(x, y), axis=1))

    @property
    def collapsed_positions(self) -> Array:
        """Where a film that was not found has gaps below a hundredth of the central one, (n, 2) [m]."""
        if self.status != "film collapsed":
            return np.empty((0, 2))
        i, j = np.nonzero(self.thickness < COLLAPSED * self.central_thickness)
        return np.column_stack([self.x[i], self.y[j]])

    @property
    def cavitates(self) -> bool:
        """Whether the film cavitates on the line y = 0 before the domain ends, behind the pressure."""
        middle = int(np.argmin(np.abs(self.y)))
        behind = int(np.argmax(self.pressure[:, middle]))
        return bool(np.any(self.cavitated[behind:-1, middle]))


def solve_point_film(problem: FilmProblem, *, progress: Progress | None = None) -> PointFilm:
    """Solve the Reynolds, film and load equations of a point contact.

    Parameters
    ----------
    problem : FilmProblem
        The contact, dimensionless, with its ``width``.
    progress : callable, optional
        Called with (nodes along x, Newton step, residual) before every Newton step.

    Returns
    -------
    PointFilm
        Whatever was reached, with its status: nothing is raised where it is not a solution.

    Notes
    -----
    As ``solve_film``, with the flow across entrainment and the deflection of a half-space under a load that
    is bounded across it too (Love 1929, doi:10.1098/rsta.1929.0009).

    Examples
    --------
    >>> from ehlectric.film.deflection import point_geometry
    >>> from ehlectric.film.mesh import Width
    >>> from ehlectric.film.flow import Fluid
    >>> constant = lambda p: (np.ones_like(p), np.zeros_like(p))
    >>> isoviscous = lambda p: (np.zeros_like(p), np.zeros_like(p))
    >>> problem = FilmProblem(
    ...     Fluid(constant, isoviscous, velocity_parameter=0.05, ambient_pressure=0.0),
    ...     nodes=49,
    ...     inlet=-4.5,
    ...     outlet=1.5,
    ...     thickness_guess=0.3,
    ...     geometry=point_geometry(radius_ratio=1.0, ellipse_ratio=1.0, compliance=2.0 / np.pi**2),
    ...     width=Width(nodes=49, side=3.0),
    ... )
    >>> solve_point_film(problem).status
    'converged'
    """
    assert problem.width is not None
    with quiet_solution():
        solutions = nested_iteration(problem, progress)
        mesh, state = solutions[-1].level.mesh, solutions[-1].state
        return PointFilm(
            **found(problem, solutions, mesh.mirrored),
            y=problem.scales.length * mesh.whole_y,
            semi_axis_y=semi_axis_across(problem),
            side_deficit=side_deficit(problem, mesh, state.pressure, state.thickness),
        )


def semi_axis_across(problem: FilmProblem) -> float:
    """Semi-axis of the dry contact across entrainment [m], of the load that its ellipse carries."""
    return problem.scales.length * 1.5 * problem.geometry.load / np.pi
