"""Error estimates of a film: discretisation error, and pressure that is lost at the edges of the domain."""

from __future__ import annotations

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.deflection import Geometry
from ehlectric.film.flow import Fluid
from ehlectric.film.mesh import Mesh, at_centre
from ehlectric.film.nested import accurate_film
from ehlectric.film.problem import FilmProblem
from ehlectric.film.state import GridSolution, State

# Lowest order of convergence of the minimum film thickness observed with the scheme of second order.
MINIMUM_ORDER = 1.25


def richardson(fine: tuple[Mesh, Array], coarse: tuple[Mesh, Array], *, order: int) -> float:
    """Richardson estimate of the discretisation error of a film.

    Parameters
    ----------
    fine, coarse : pair of Mesh and ndarray
        Grid and film thickness (nx, ny) in any unit, for two grids over the same domain.
    order : int
        Order of the discretisation.

    Returns
    -------
    float
        Relative error of the minimum or of the central film thickness, whichever is larger.

    Notes
    -----
    The minimum lies at the constriction, where the pressure gradient jumps. With a scheme of second order it
    converges with an observed order of 1.25 or more. The estimate uses 1.25 for the minimum.

    Examples
    --------
    >>> import numpy as np
    >>> fine, coarse = Mesh.over(5, -1.0, 1.0), Mesh.over(3, -1.0, 1.0)
    >>> round(richardson((fine, np.full((5, 1), 1.01)), (coarse, np.full((3, 1), 1.02)), order=1) * 1.01, 3)
    0.01
    """
    return float(np.max(_grid_differences(fine, coarse, order=order)))


def _grid_differences(fine: tuple[Mesh, Array], coarse: tuple[Mesh, Array], *, order: int) -> Array:
    """Richardson estimates of the relative errors of the minimum and the central film thickness, (2,)."""
    gains = (coarse[0].dx / fine[0].dx) ** np.array([min(order, MINIMUM_ORDER), order]) - 1.0
    on_fine, on_coarse = (_key_thicknesses(*film) for film in (fine, coarse))
    estimates: Array = np.abs(on_fine - on_coarse) / (gains * on_fine)
    return estimates


def _key_thicknesses(mesh: Mesh, thickness: Array) -> Array:
    """Minimum and central film thickness, shape (2,), in the unit of ``thickness`` (nx, ny)."""
    return np.array([np.min(thickness), at_centre(mesh, thickness)])


def film_error(problem: FilmProblem, fine: tuple[Mesh, State], coarse: tuple[Mesh, State]) -> float | None:
    """Relative discretisation error of a film, estimated from its converged states on two grids.

    Parameters
    ----------
    problem : FilmProblem
        Dimensionless problem of the contact.
    fine, coarse : pair of Mesh and State
        Grid and state of the film, on the grid of the problem and on the next coarser grid.

    Returns
    -------
    float or None
        Relative error of the minimum or of the central film thickness, whichever is larger. None if the
        wedge term is of first order, and the third-order term does not converge on either grid.

    Notes
    -----
    With a wedge term of second or third order, this is Richardson's estimate. With the first-order term, the
    error of the wedge and the other errors may have opposite signs. The film thickness is then not monotone
    in the number of nodes, and Richardson's estimate may vanish. The film is therefore solved with the
    third-order term on both grids too, from the first-order film as initial guess. The estimate is the
    difference of both films on the fine grid plus Richardson's estimate of the third-order film.
    """
    films = [(mesh, state.thickness) for mesh, state in (fine, coarse)]
    if problem.wedge_order > 1:
        return richardson(films[0], films[1], order=2)
    better = [accurate_film(problem, mesh.x.size, state) for mesh, state in (fine, coarse)]
    if any(solution.status != "converged" for solution in better):
        return None
    accurate = [(solution.level.mesh, solution.state.thickness) for solution in better]
    first_order, third_order = (_key_thicknesses(*film) for film in (films[0], accurate[0]))
    of_wedge = np.abs(first_order - third_order) / third_order
    return float(np.max(of_wedge + _grid_differences(accurate[0], accurate[1], order=2)))


def discretisation_error(
    problem: FilmProblem, fine: GridSolution, coarse: GridSolution | None
) -> float | None:
    """Relative discretisation error of a film, estimated from its solutions on two grids.

    None if there is no coarser grid, or if either solution did not converge; see ``film_error``.
    """
    if coarse is None or fine.status != "converged" or coarse.status != "converged":
        return None
    return film_error(problem, (fine.level.mesh, fine.state), (coarse.level.mesh, coarse.state))


def inlet_deficit(fluid: Fluid, geometry: Geometry, mesh: Mesh, pressure: Array, mass: Array) -> float:
    """Share of the reduced pressure that is missing because it would build up upstream of the domain.

    Parameters
    ----------
    fluid : Fluid
        Lubricant over dimensionless pressure.
    geometry : Geometry
        Kind of contact.
    mesh : Mesh
        Grid.
    pressure, mass : ndarray, shape (nx, ny)
        Pressure P and oil mass rho H, dimensionless.

    Returns
    -------
    float
        Share of the reduced pressure, from 0 to 1, on the line Y = 0; 0 for an invalid iterate.

    Notes
    -----
    The reduced pressure is the integral of dP/eta. It follows from the Reynolds equation integrated once,
    dP/dX = eta lambda (rho H - q)/(rho H^3) with the flow q. Upstream of the domain P is taken as ambient and
    H as a parabola. In a point contact, with H = X^2/2 + (Rx/Ry) Y^2/2, oil also flows off to the sides. The
    pressure is then that of a line contact, divided by 1 + (2/3) Rx/Ry (P. Kapitza, Zh. Tekh. Fiz. 25 (1955)
    747).
    """
    if not (np.all(np.isfinite(pressure)) and np.all(mass > 0.0)):
        return 0.0
    middle = int(np.argmin(np.abs(mesh.y)))
    x, pressure, mass = mesh.x, pressure[:, middle], mass[:, middle]
    flow = float(mass[np.argmax(pressure)])
    fluidity = np.exp(-fluid.log_viscosity(np.maximum(pressure, fluid.ambient_pressure))[0])
    increments = 0.5 * (fluidity[1:] + fluidity[:-1]) * np.diff(pressure)
    inside = float(np.max(np.cumsum(increments)))
    # With X = inlet/t and 0 < t < 1 the integrand is smooth: it is about t^2.
    points, weights = np.polynomial.legendre.leggauss(40)
    t = 0.5 * (points + 1.0)
    gap = float(mass[0]) + 0.5 * float(x[0]) ** 2 * (1.0 / t**2 - 1.0)
    gradient = fluid.velocity_parameter * (gap - flow) / gap**3
    before = float(np.sum(0.5 * weights * gradient * abs(float(x[0])) / t**2))
    before /= 1.0 + 2.0 * geometry.radius_ratio / 3.0
    return before / (before + inside) if before > 0.0 else 0.0


def side_deficit(problem: FilmProblem, mesh: Mesh, pressure: Array, thickness: Array) -> float:
    """Share of the reduced pressure that is missing because the domain's sides are at ambient pressure.

    Parameters
    ----------
    problem : FilmProblem
        Dimensionless problem of the contact.
    mesh : Mesh
        Grid.
    pressure, thickness : ndarray, shape (nx, ny)
        Pressure P and film thickness H, dimensionless.

    Returns
    -------
    float
        Share of the reduced pressure, from 0 to 1; 0 for an invalid iterate.

    Notes
    -----
    For H = X^2/2 + (Rx/Ry) Y^2/2 + const the reduced pressure is -lambda X/((3 + 2 Rx/Ry) H^2), an exact
    solution of the Reynolds equation for constant density, without cavitation (P. Kapitza, Zh. Tekh. Fiz. 25
    (1955) 747). Its largest value on the sides is compared with the largest reduced pressure, the integral of
    dP/eta, on the line Y = 0.
    """
    fluid = problem.fluid
    if not np.all(np.isfinite(pressure)):
        return 0.0
    middle = pressure[:, int(np.argmin(np.abs(mesh.y)))]
    fluidity = np.exp(-fluid.log_viscosity(np.maximum(middle, fluid.ambient_pressure))[0])
    inside = float(np.max(np.cumsum(0.5 * (fluidity[1:] + fluidity[:-1]) * np.diff(middle))))
    upstream = np.maximum(-mesh.x, 0.0) / (3.0 + 2.0 * problem.geometry.radius_ratio)
    outside = float(np.max(fluid.velocity_parameter * upstream / thickness[:, -1] ** 2))
    return outside / (outside + inside)
