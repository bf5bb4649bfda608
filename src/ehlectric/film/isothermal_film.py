"""Stationary films of line and of point contacts in SI units, with heat and shear where they are computed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from ehlectric.arrays import Array
from ehlectric.film.far_field import lost_by_load, side_deficit
from ehlectric.film.film_solution import FilmSolution, Shaped, stationary_film
from ehlectric.film.film_solver import RefinedSolution, StarvedSolution, film_method
from ehlectric.film.heated_solution import HeatedSolution, heated_result, solve_heated_film
from ehlectric.film.newton import COLLAPSED, Progress
from ehlectric.film.problem import FilmProblem
from ehlectric.formulas.polynomials import interval
from ehlectric.quantities.field_metadata import number, stored
from ehlectric.runtime.threads import quiet_solution


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

        It is the larger share of the missing pressure and the missing load; the load is larger in thick
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
    """Solve the Reynolds, film and load equations of a line contact. Returns last iterate, with its status;
    no error is raised if it did not converge.

    The equations are (1) to (13) of Morris et al. (2022), doi:10.3390/lubricants10050087, and a
    complementarity condition for cavitation, which the paper omits. The iteration is nested as in full
    multigrid: the initial guess on every grid is the solution on the next coarser grid.

    Examples
    --------
    >>> import numpy as np
    >>> from ehlectric.film.face_flow import Fluid
    >>> incompressible = lambda p: (np.ones_like(p), np.zeros_like(p))
    >>> isoviscous = lambda p: (np.zeros_like(p), np.zeros_like(p))
    >>> fluid = Fluid(incompressible, isoviscous, velocity_parameter=0.01, ambient_pressure=0.0)
    >>> solve_film(FilmProblem(fluid, 401, -4.0, 2.0, thickness_guess=0.1)).status
    'converged'
    """
    with quiet_solution():
        if problem.physics is None:
            return _film(film_method(problem)(problem, progress))
        return _with_heat(solve_heated_film(problem, progress), _film, _on_line)


def _film(refined: RefinedSolution) -> Film:
    """Film in SI units from the dimensionless solutions on all grids."""
    return Film.of(stationary_film(refined, _on_line))


def _on_line(values: NDArray[Any]) -> NDArray[Any]:
    """Nodal values (nx,) from values with one node across (nx, 1)."""
    return values[:, 0]


# Points of the quadrature over the Hertz ellipse, along its radius and around its circumference.
_RADII, _ANGLES = 64, 256

# Relative loss of film thickness over the missing shares of the reduced pressure, upstream and at the sides,
# by the dimensionless central film thickness H. They were calibrated with 18 random contacts, with M from 0.8
# to 3200 and ellipse ratios from 1 to 4.5. Their films on domains that end at 1.5 to 4.5 semi-axes upstream
# and at 1.3 to 3 at the sides were compared with films on domains of up to 14 and 6. The loss exceeded the
# estimate in 2 % of these domains, and the median of the estimate was 1.5 times the loss.
_LOSS_AT = np.log([0.02, 0.2, 0.8, 1.5, 2.5])
_LOST_UPSTREAM = (1.2, 1.0, 0.9, 0.9, 1.4)
_LOST_AT_SIDES = (0.6, 0.6, 0.6, 0.6, 1.4)


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class PointFilm(FilmSolution):
    """Lubricant film of a point contact in SI units, with its status and residuals.

    The class adds the attributes below to the attributes of ``FilmSolution``. Nodal values have the shape
    (nx, ny).
    """

    # Positions of the nodes across entrainment [m], shape (ny,).
    y: Array = field(metadata=stored("y", "m", "increasing", "position across entrainment"))
    # semi-axis of the dry contact across entrainment [m]. The semi-axis along entrainment is
    # ``scales.length``
    semi_axis_y: float = field(metadata=number())
    # Share of the reduced pressure that is missing because the sides of the domain are at ambient pressure.
    # None for an instant of a transient film.
    side_deficit: float | None = field(default=None, metadata=number())
    # Exponent with which the expected film falls over the load. None where it is not known.
    load_exponent: float | None = field(default=None, metadata=number())

    @classmethod
    def of(
        cls,
        film: FilmSolution,
        *,
        y: Array,
        semi_axis_y: float,
        side_deficit: float | None = None,
        load_exponent: float | None = None,
    ) -> PointFilm:
        """Film of a point contact from a ``FilmSolution`` with nodal values (nx, ny)."""
        return cls(
            **vars(film),
            y=y,
            semi_axis_y=semi_axis_y,
            side_deficit=side_deficit,
            load_exponent=load_exponent,
        )

    @property
    def axes(self) -> tuple[Array, ...]:
        """Positions of the nodes along and across entrainment [m]."""
        return self.x, self.y

    @property
    def domain_loss(self) -> float | None:
        """Estimated relative loss of film thickness because the domain is too small, dimensionless.

        None for an instant of a transient film.
        """
        if self.inlet_deficit is None or self.side_deficit is None:
            return None
        flooded = None if self.starvation is None else self.starvation.flooded_central_thickness
        central = self.central_thickness if flooded is None else flooded
        thickness = central / self.scales.thickness
        lost = lost_film(thickness, self.inlet_deficit, self.side_deficit)
        by_load = float(lost_by_load(self.load_deficit or 0.0, self.load_exponent or 0.0))
        return 1.0 - max(0.0, 1.0 - lost) * (1.0 - by_load)

    @property
    def minimum_position(self) -> tuple[float, float]:
        """Position (x, y) of the node with the smallest film thickness [m]."""
        i, j = np.unravel_index(np.argmin(self.thickness), self.thickness.shape)
        return float(self.x[i]), float(self.y[j])

    def _at(self, x: Array, y: Array) -> Array:
        """Film thickness at positions x and y of one shape [m], by linear interpolation."""
        (i, part_x), (j, part_y) = interval(self.x, x), interval(self.y, y)
        before, behind = (
            (1.0 - part_y) * self.thickness[row, j] + part_y * self.thickness[row, j + 1]
            for row in (i, i + 1)
        )
        film: Array = (1.0 - part_x) * before + part_x * behind
        return film

    @property
    def central_thickness(self) -> float:
        """Film thickness at x = y = 0 [m], interpolated between nodes."""
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
        """Positions [m], shape (n, 2), where a collapsed film is thinner than 1 % of its central thickness.

        Empty unless the status is "film collapsed".
        """
        if self.status != "film collapsed":
            return np.empty((0, 2))
        i, j = np.nonzero(self.thickness < COLLAPSED * self.central_thickness)
        return np.column_stack([self.x[i], self.y[j]])

    @property
    def cavitates(self) -> bool:
        """Whether the film cavitates inside the domain on the line y = 0, behind the largest pressure."""
        middle = int(np.argmin(np.abs(self.y)))
        behind = int(np.argmax(self.pressure[:, middle]))
        return bool(np.any(self.cavitated[behind:-1, middle]))


def lost_film(thickness: float, upstream: float, sides: float) -> float:
    """Estimated relative loss of a film whose domain is too small, dimensionless."""
    at = np.log(max(thickness, 1e-12))
    lost = np.interp(at, _LOSS_AT, _LOST_UPSTREAM) * upstream
    return float(lost + np.interp(at, _LOSS_AT, _LOST_AT_SIDES) * sides)


def solve_point_film(problem: FilmProblem, *, progress: Progress | None = None) -> PointFilm:
    """Solve the Reynolds, film and load equations of a point contact. Returns last iterate, with its status;
    no error is raised if it did not converge.

    The equations are (1) to (13) of Morris et al. (2022), doi:10.3390/lubricants10050087, with two
    extensions: the flow across entrainment, and the deflection of a half-space under a pressure over (x, y)
    (Love 1929, doi:10.1098/rsta.1929.0009). A complementarity condition for cavitation is added.

    Examples
    --------
    >>> from ehlectric.film.deflection import point_geometry
    >>> from ehlectric.film.mesh import Width
    >>> from ehlectric.film.face_flow import Fluid
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
    film_of = partial(_point_film, problem)
    with quiet_solution():
        if problem.physics is None:
            return film_of(film_method(problem)(problem, progress))
        outcome = solve_heated_film(problem, progress)
        return _with_heat(outcome, film_of, outcome.refined.last.level.mesh.mirrored)


def _point_film(problem: FilmProblem, refined: RefinedSolution) -> PointFilm:
    """Film in SI units from the dimensionless solutions on all grids."""
    whole, patch = refined.whole, refined.patch
    mesh = whole.level.mesh
    y = mesh.whole_y if patch is None else patch.join(refined.last.level.mesh).y
    return PointFilm.of(
        stationary_film(refined, mesh.mirrored),
        y=problem.scales.length * y,
        semi_axis_y=semi_axis_across(problem),
        load_exponent=problem.load_exponent,
        side_deficit=refined.side_deficit
        if isinstance(refined, StarvedSolution)
        else side_deficit(problem, mesh, whole.state.pressure, whole.state.thickness),
    )


def semi_axis_across(problem: FilmProblem) -> float:
    """Semi-axis of the dry contact across entrainment [m], which follows from the dimensionless load."""
    return problem.scales.length * 1.5 * problem.geometry.load / np.pi


_Solved = TypeVar("_Solved", Film, PointFilm)


def _with_heat(
    outcome: HeatedSolution, film_of: Callable[[RefinedSolution], _Solved], shaped: Shaped
) -> _Solved:
    """Film in SI units with its heat and shear.

    ``film_of`` makes a film in SI units from solutions on all grids, and ``shaped`` brings nodal values on
    the last mesh into the shape of the film.
    """
    simple, film = film_of(outcome.simple), film_of(outcome.refined)
    status = outcome.status if film.converged else film.status
    heated = heated_result(
        outcome,
        shaped,
        status=status,
        minimum_thickness=simple.minimum_thickness if simple.converged else None,
        central_thickness=simple.central_thickness if simple.converged else None,
    )
    return replace(film, heated=heated, status=status)
