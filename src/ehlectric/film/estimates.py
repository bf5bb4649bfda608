"""How far off a film may be: by its grid, and by where its domain ends."""

from __future__ import annotations

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.deflection import Geometry
from ehlectric.film.flow import Fluid
from ehlectric.film.mesh import Mesh, at_centre
from ehlectric.film.problem import FilmProblem
from ehlectric.film.state import GridSolution

# Least observed order of the minimum film, of a scheme of second order.
MINIMUM_ORDER = 1.25


def richardson(fine: tuple[Mesh, Array], coarse: tuple[Mesh, Array], *, order: int) -> float:
    """Richardson's estimate of the discretisation error of a film.

    Parameters
    ----------
    fine, coarse : pair of Mesh and ndarray
        Nodes and film thickness (nx, ny) on two grids over one domain, in any unit.
    order : int
        Of the discretisation.

    Returns
    -------
    float
        The larger relative error of the minimum and the central thickness.

    Notes
    -----
    The minimum lies at the constriction, where the pressure gradient jumps: with a scheme of second order it
    converges with observed orders from 1.25 up, and is taken to do so with the least of them.

    Examples
    --------
    >>> import numpy as np
    >>> fine, coarse = Mesh.over(5, -1.0, 1.0), Mesh.over(3, -1.0, 1.0)
    >>> round(richardson((fine, np.full((5, 1), 1.01)), (coarse, np.full((3, 1), 1.02)), order=1) * 1.01, 3)
    0.01
    """
    gains = (coarse[0].dx / fine[0].dx) ** np.array([min(order, MINIMUM_ORDER), order]) - 1.0
    on_fine, on_coarse = (np.array([np.min(h), at_centre(mesh, h)]) for mesh, h in (fine, coarse))
    return float(np.max(np.abs(on_fine - on_coarse) / (gains * on_fine)))


def discretisation_error(
    problem: FilmProblem, fine: GridSolution, coarse: GridSolution | None
) -> float | None:
    """Estimated relative error of a film by its grid; None where either film is not converged."""
    if coarse is None or fine.status != "converged" or coarse.status != "converged":
        return None
    of_fine, of_coarse = ((g.level.mesh, g.state.thickness) for g in (fine, coarse))
    return richardson(of_fine, of_coarse, order=problem.order)


def inlet_deficit(fluid: Fluid, geometry: Geometry, mesh: Mesh, pressure: Array, mass: Array) -> float:
    """Share of the reduced pressure that would be built up before the domain begins.

    On the line Y = 0, of pressure P and mass rho H (nx, ny), dimensionless. The Reynolds equation integrated
    once, dP/dX = eta lambda (rho H - q)/(rho H^3) with the flow q, builds up the reduced pressure, the
    integral of dP/eta. Before the inlet P is about ambient and H about a parabola. Where oil also flows off
    to the sides, between H = X^2/2 + (Rx/Ry) Y^2/2, the pressure is that of a line contact over
    1 + (2/3) Rx/Ry (P. Kapitza, Zh. Tekh. Fiz. 25 (1955) 747).
    """
    if not (np.all(np.isfinite(pressure)) and np.all(mass > 0.0)):
        return 0.0
    middle = int(np.argmin(np.abs(mesh.y)))
    x, pressure, mass = mesh.x, pressure[:, middle], mass[:, middle]
    flow = float(mass[np.argmax(pressure)])
    fluidity = np.exp(-fluid.log_viscosity(np.maximum(pressure, fluid.ambient_pressure))[0])
    increments = 0.5 * (fluidity[1:] + fluidity[:-1]) * np.diff(pressure)
    inside = float(np.max(np.cumsum(increments)))
    # With X = inlet/t, 0 < t < 1, the integrand is smooth, about t^2.
    points, weights = np.polynomial.legendre.leggauss(40)
    t = 0.5 * (points + 1.0)
    gap = float(mass[0]) + 0.5 * float(x[0]) ** 2 * (1.0 / t**2 - 1.0)
    gradient = fluid.velocity_parameter * (gap - flow) / gap**3
    before = float(np.sum(0.5 * weights * gradient * abs(float(x[0])) / t**2))
    before /= 1.0 + 2.0 * geometry.radius_ratio / 3.0
    return before / (before + inside) if before > 0.0 else 0.0


def side_deficit(problem: FilmProblem, mesh: Mesh, pressure: Array, thickness: Array) -> float:
    """Share of the reduced pressure there would be where the domain ends at its sides.

    Of pressure and film thickness (nx, ny), dimensionless. Between H = X^2/2 + (Rx/Ry) Y^2/2 + const the
    pressure is -lambda X/((3 + 2 Rx/Ry) H^2) (P. Kapitza, Zh. Tekh. Fiz. 25 (1955) 747), which solves the
    Reynolds equation of a constant viscosity exactly; it is compared with the largest reduced pressure of the
    line Y = 0, the integral of dP/eta.
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
