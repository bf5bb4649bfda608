"""Error estimates of films: discretisation error, rough films between the nodes, maximum pressure, edges
of the domain.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from ehlectric.arrays import Array, largest_nearby
from ehlectric.film.deflection import Geometry
from ehlectric.film.face_flow import Fluid
from ehlectric.film.mesh import Mesh, at_centre, on_mesh
from ehlectric.film.nested import accurate_film
from ehlectric.film.newton import GridSolution, State
from ehlectric.film.patch import part_of_domain
from ehlectric.film.problem import FilmProblem
from ehlectric.formulas.polynomials import gauss_legendre, on_nodes
from ehlectric.readable import readable

# Factor by which the change of the minimum from the coarser grid exceeds its error on the finer one, with the
# scheme of third order; see ``of_three_grids``.
_MINIMUM_GAIN = 1.8

# Smallest estimate of the scheme of third order, as all grids may agree by chance.
_LEAST_ESTIMATE = 5e-5

# Points of the quadrature over what lies outside of the domain.
_POINTS = 40

# Lowest order of convergence of the minimum film thickness observed with the scheme of second order.
MINIMUM_ORDER = 1.25


def richardson(fine: tuple[Mesh, Array], coarse: tuple[Mesh, Array], *, order: int) -> float:
    """Richardson estimate of the discretisation error of a film. Returns relative error of the minimum or of
    the central film thickness, whichever is larger.

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
    on_fine, on_coarse = (key_thicknesses(*film) for film in (fine, coarse))
    return np.abs(on_fine - on_coarse) / (gains * on_fine)


def key_thicknesses(mesh: Mesh, thickness: Array) -> Array:
    """Minimum and central film thickness, shape (2,), in the unit of ``thickness`` (nx, ny)."""
    return np.array([np.min(thickness), at_centre(mesh, thickness)])


def of_three_grids(films: Sequence[tuple[Mesh, Array]]) -> float:
    """Estimate of the discretisation error of a film with the third-order wedge, from three grids. Returns
    relative error of the minimum or of the central film thickness, whichever is larger.

    Two minima may agree by chance, as the lowest node lies anywhere next to the lowest place. The change from
    the coarser to the coarsest grid, reduced by the expected order, is therefore a second estimate of the
    change, and the larger one counts. Minima are compared between the nodes, and the distance of the lowest
    node from the lowest place is added. Of 500 random line contacts 2 % exceeded the estimate, none of them
    twofold; in the median it is four to five times the true error.

    Examples
    --------
    >>> import numpy as np
    >>> found = ((9, 1.0), (5, 1.01), (3, 1.02))
    >>> films = [(Mesh.over(nodes, -1.0, 1.0), np.full((nodes, 1), film)) for nodes, film in found]
    >>> round(of_three_grids(films), 4)
    0.0056
    """
    minima, centres = np.array([[lowest(*film), at_centre(*film)] for film in films]).T
    least = float(np.min(films[0][1]))
    of_minimum = _change(minima, MINIMUM_ORDER) / _MINIMUM_GAIN + (least - minima[0])
    of_centre = _change(centres, 2.0) / 3.0
    return float(max(of_minimum / least, of_centre / centres[0], _LEAST_ESTIMATE))


def _change(values: Array, order: float) -> float:
    """Change of a value between the two finest of three grids, by both pairs of grids."""
    fine, coarse = np.abs(np.diff(values))
    return float(max(fine, coarse / 2.0**order))


def lowest(mesh: Mesh, thickness: Array) -> float:
    """Lowest film thickness between the nodes, by a parabola along each axis through the lowest node.
    ``thickness``, film thickness, in any unit, shape (nx, ny).

    Examples
    --------
    >>> mesh = Mesh.over(4, -1.0, 2.0)
    >>> round(lowest(mesh, 1.0 + (mesh.x[:, np.newaxis] - 0.4) ** 2), 12)
    1.0
    """
    whole = mesh.mirrored(thickness)
    at = np.unravel_index(int(np.argmin(whole)), whole.shape)
    least = float(whole[at])
    for axis, place in enumerate(at):
        if 0 < place < whole.shape[axis] - 1:
            before, here, after = np.take(
                np.moveaxis(whole, axis, 0)[:, at[1 - axis]], [place - 1, place, place + 1]
            )
            bend = before - 2.0 * here + after
            least -= float((after - before) ** 2 / (8.0 * bend)) if bend > 0.0 else 0.0
    return least


def film_error(
    problem: FilmProblem,
    fine: tuple[Mesh, State],
    coarse: tuple[Mesh, State],
    coarsest: tuple[Mesh, State] | None = None,
) -> float | None:
    """Relative discretisation error of a film, estimated from its converged states on two or three grids.
    Returns relative error of the minimum or of the central film thickness, whichever is larger; None if the
    wedge term is of first order, and the third-order term does not converge on either grid.

    With a wedge term of third order and three grids, this is the estimate ``of_three_grids``; otherwise, with
    a wedge term of second or third order, Richardson's estimate. With the first-order term, the
    error of the wedge and the other errors may have opposite signs. The film thickness is then not monotone
    in the number of nodes, and Richardson's estimate may vanish. The film is therefore solved with the
    third-order term on both grids too, from the first-order film as initial guess. The estimate is the
    difference of both films on the fine grid plus Richardson's estimate of the third-order film.
    """
    films = [(mesh, state.thickness) for mesh, state in (fine, coarse)]
    if problem.wedge_order > 2 and coarsest is not None:
        return of_three_grids([*films, (coarsest[0], coarsest[1].thickness)])
    if problem.wedge_order > 1:
        return richardson(films[0], films[1], order=2)
    better = [accurate_film(problem, mesh.x.size, state) for mesh, state in (fine, coarse)]
    if any(solution.status != "converged" for solution in better):
        return None
    accurate = [(solution.level.mesh, solution.state.thickness) for solution in better]
    first_order, third_order = (key_thicknesses(*film) for film in (films[0], accurate[0]))
    of_wedge = np.abs(first_order - third_order) / third_order
    return float(np.max(of_wedge + _grid_differences(accurate[0], accurate[1], order=2)))


def discretisation_error(
    problem: FilmProblem, fine: GridSolution, coarser: Sequence[GridSolution]
) -> float | None:
    """Relative discretisation error of a film, estimated from its solutions on up to three grids.

    None if there is no coarser grid, or if the solution on it or on the fine grid did not converge; see
    ``film_error``. A film that did not converge on the coarsest of three grids counts as zero there.
    """
    if not coarser or fine.status != "converged" or coarser[0].status != "converged":
        return None
    coarse, *others = coarser
    coarsest = _or_no_film(others[0]) if others else None
    return film_error(problem, (fine.level.mesh, fine.state), (coarse.level.mesh, coarse.state), coarsest)


def _or_no_film(grid: GridSolution) -> tuple[Mesh, State]:
    """Grid and state of a solution; one that did not converge counts as no film, whose thickness is zero."""
    state = grid.state
    if grid.status != "converged":
        state = State(state.pressure, state.h00, np.zeros_like(state.thickness))
    return grid.level.mesh, state


def upstream_deficits(
    fluid: Fluid, geometry: Geometry, mesh: Mesh, pressure: Array, mass: Array
) -> tuple[float, float]:
    """Shares of pressure and load that are missing because they would build up upstream of the domain.

    ``fluid``, lubricant over dimensionless pressure; ``pressure`` and ``mass``, pressure P and oil mass rho
    H, dimensionless, shape (nx, ny). Returns share of the reduced pressure on the line Y = 0, and share of
    the load of a line contact, both from 0 to 1; 0 for an invalid iterate.

    The reduced pressure is the integral of dP/eta. It follows from the Reynolds equation integrated once,
    dP/dX = eta lambda (rho H - q)/(rho H^3) with the flow q. Upstream of the domain P is taken as ambient and
    H as a parabola. In a point contact, with H = X^2/2 + (Rx/Ry) Y^2/2, oil also flows off to the sides. The
    pressure is then the pressure of a line contact, divided by 1 + (2/3) Rx/Ry (P. Kapitza, Zh. Tekh. Fiz. 25
    (1955) 747).

    Far upstream P falls with the cube of the distance. With P_e at the edge X_e of the domain, P_e X_e/2 is
    carried upstream of it, and the film within lacks about P_e over the length X_e. A film of rigid bodies is
    thinner by this share of the load (A. Martin 1916: the film of a given load goes with 1/w). The pressure
    at the edge is low, and the viscosity equals the viscosity of the oil at ambient pressure.
    """
    if not (np.all(np.isfinite(pressure)) and np.all(mass > 0.0)):
        return 0.0, 0.0
    middle = int(np.argmin(np.abs(mesh.y)))
    x, pressure, mass = mesh.x, pressure[:, middle], mass[:, middle]
    flow = float(mass[np.argmax(pressure)])
    inside = reduced_pressure(fluid, pressure)
    # With X = inlet/t and 0 < t < 1 the integrand is smooth: it is about t^2.
    points, weights = gauss_legendre(_POINTS)
    t = 0.5 * (points + 1.0)
    gap = float(mass[0]) + 0.5 * float(x[0]) ** 2 * (1.0 / t**2 - 1.0)
    gradient = fluid.velocity_parameter * (gap - flow) / gap**3
    before = float(np.sum(0.5 * weights * gradient * abs(float(x[0])) / t**2))
    before /= 1.0 + 2.0 * geometry.radius_ratio / 3.0
    if before <= 0.0:
        return 0.0, 0.0
    missing = 1.5 * before * abs(float(x[0])) / geometry.load
    return before / (before + inside), missing / (1.0 + missing)


def reduced_pressure(fluid: Fluid, pressure: Array) -> float:
    """Largest reduced pressure, the integral of dP/eta, on a line along x with the pressure P (nx,)."""
    fluidity = np.exp(-fluid.log_viscosity(np.maximum(pressure, fluid.ambient_pressure))[0])
    return float(np.max(np.cumsum(0.5 * (fluidity[1:] + fluidity[:-1]) * np.diff(pressure))))


# Distance from a position, in spacings of the coarser grid, within which values are compared.
_REACH = 4.0

# Nodal values (nx, ny) on a grid.
Values = tuple[Mesh, Array]


def cropped(coarse: Values, fine: Mesh) -> Values:
    """Nodal values (nx, ny) of a coarse grid on its nodes within the domain of a fine grid."""
    mesh, values = coarse
    reach = 1e-9 * (fine.x[-1] - fine.x[0])
    rows = (mesh.x >= fine.x[0] - reach) & (mesh.x <= fine.x[-1] + reach)
    lines = np.abs(mesh.y) <= fine.y[-1] + reach
    return Mesh(mesh.x[rows], mesh.y[lines], mesh.symmetric), values[np.ix_(rows, lines)]


def position(mesh: Mesh, index: int) -> tuple[float, float]:
    """Position (X, Y) of a node with its index in the flattened nodal values."""
    along, across = np.unravel_index(index, mesh.shape)
    return float(mesh.x[along]), float(mesh.y[across])


def change_near(fine: Values, coarse: Values, places: list[tuple[float, float]]) -> float:
    """Largest difference between the values on two grids within a few coarse spacings of any of some places.
    Returns largest absolute difference at the nodes of the coarser grid, in the unit of the values.

    Examples
    --------
    >>> import numpy as np
    >>> fine, coarse = Mesh.over(41, -2.0, 2.0), Mesh.over(21, -2.0, 2.0)
    >>> values = fine, fine.x[:, np.newaxis] ** 2
    >>> shifted = coarse, coarse.x[:, np.newaxis] ** 2 + 0.1 * (coarse.x[:, np.newaxis] > 0.5)
    >>> [round(change_near(values, shifted, [(x, 0.0)]), 3) for x in (-1.0, 0.0)]
    [0.0, 0.1]
    """
    mesh, values = cropped(coarse, fine[0])
    difference = np.abs(on_mesh(fine[1], fine[0], mesh) - values)
    largest = 0.0
    for at_x, at_y in places:
        near = np.abs(mesh.x - at_x)[:, np.newaxis] <= (_REACH + 0.01) * mesh.dx
        if mesh.dy is not None:
            near = near & (np.abs(mesh.y - at_y) <= (_REACH + 0.01) * mesh.dy)
        largest = max(largest, float(np.max(difference, where=near, initial=0.0)))
    return largest


# Law of the error of smooth, flooded point contacts: e = c/(1 + c) with c = _AT_ONE s**2 and the spacing s
# over H**_OF_FILM, times the ratio of the semi-axes where the contact is longer along entrainment. It is a
# fit to the errors of benchmarks/data/reachable_errors.csv, which are those that the solver states. The
# outlet constriction is about H**(2/3) wide.
_COARSEST, _OF_FILM = 0.55, 0.75

# Expected error from which on the grid does not see the film: stated errors are then 100 % or much too small,
# as the film depends on the grid. Stated errors below the second number are then not believed.
UNSEEN, LEAST_UNSEEN = 0.9, 0.5

# Expected error above which a grid is taken to have no estimate, so that the next grid covers the domain.
_UNKNOWN = 0.5


def expected_error(problem: FilmProblem, times: int = 1) -> float | None:
    """Discretisation error that is expected of the film of a smooth, flooded point contact. Returns relative
    error that the solver will probably state; None for other contacts, for surfaces that touch, and for a
    wedge term of lower than third order, of which no errors were collected.
    """
    if problem.width is None or problem.added_gap is not None or problem.supply is not None:
        return None
    # The least film is about half of the central one: below the boundary film, the surfaces touch.
    if problem.wedge_order < 3 or 0.5 * problem.thickness_guess < problem.boundary_film:
        return None
    spacing = (problem.outlet - problem.inlet) / (problem.nodes - 1) / times
    scaled = spacing * min(1.0, 1.5 * problem.geometry.load / np.pi) / problem.thickness_guess**_OF_FILM
    change = _COARSEST * scaled**2
    return float(change / (1.0 + change))


def expected_nodes(problem: FilmProblem, times: int = 1) -> float:
    """Number of nodes that are solved for on a grid whose spacings are the spacings of the problem divided by
    ``times``.

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


# Part of the fourth difference by which a peak between the nodes may exceed its node. On 692 grids of random
# rough contacts the true error exceeded the estimate in 6 % with 0.33, in 4 % with 0.4, in 2.5 % with 0.5. On
# 1055 grids of random smooth contacts a spike that grew on finer grids exceeded it by 60 % with 0.4, and by
# 11 % with 0.5.
_PART = 0.5


# Estimated relative error above which the grid does not resolve the maximum pressure.
UNRESOLVED = 0.3


def pressure_error_text(error: float | None) -> str:
    """Text with the relative error of a maximum pressure; empty if the error is unknown.

    Examples
    --------
    >>> pressure_error_text(0.012), pressure_error_text(1.17), pressure_error_text(None)
    ('error 1.2 %', 'not resolved by the grid', '')
    """
    if error is None:
        return ""
    return f"error {readable(100.0 * error, 2)} %" if error <= UNRESOLVED else "not resolved by the grid"


def max_pressure_error(fine: GridSolution, coarse: GridSolution | None) -> float | None:
    """Relative error of the maximum pressure of a film. Returns relative error, which may be above 1; a value
    above about 0.3 says that the grid does not resolve the highest peak of the pressure; None if there is no
    coarser grid, or if either solution did not converge.

    The pressure does not converge as the film does. It is a derivative of the deflection, so that short waves
    of the roughness, which change the film little, are high peaks of the pressure. The pressure spike at the
    outlet is narrower than the spacing of most grids and grows with every finer grid. Its height on two grids
    may agree by chance, and it may exceed all other peaks on the next grid only.

    The estimate is therefore also taken from one grid. If the grid resolves a peak, the fourth difference
    of the pressure falls by 16 from grid to grid. At a spike or step from one node to the next it is several
    times the height of the step. Half of it is added to the pressure of every node. An eighth of the
    second difference is added too, by which the peak of a parabola exceeds three nodes at most. The estimate
    is what the largest sum exceeds the maximum, or the change of the maximum, or of the pressure near it,
    from the coarser grid, whichever is largest.
    """
    if coarse is None or fine.status != "converged" or coarse.status != "converged":
        return None
    grids = [(grid.level.mesh, np.maximum(grid.state.pressure, 0.0)) for grid in (fine, coarse)]
    peaks = [position(mesh, int(np.argmax(pressure))) for mesh, pressure in grids]
    highest, before = (float(np.max(pressure)) for _, pressure in grids)
    change = max(abs(highest - before), change_near(grids[0], grids[1], peaks))
    return max(change / highest, between_nodes(*grids[0]) / highest, _LEAST_ESTIMATE)


def between_nodes(mesh: Mesh, pressure: Array) -> float:
    """Amount by which the pressure between the nodes may exceed its largest nodal value. ``pressure``,
    pressure P at the nodes, not negative, shape (nx, ny). Returns excess over the largest nodal value, in the
    unit of the pressure, not negative.

    Examples
    --------
    A parabola exceeds its nodes by an eighth of its second difference; a step of 0.5 is not resolved:

    >>> import numpy as np
    >>> mesh = Mesh.over(101, -1.0, 1.0)
    >>> parabola = 1.0 - mesh.x[:, np.newaxis] ** 2
    >>> round(between_nodes(mesh, parabola), 6)
    0.0001
    >>> round(between_nodes(mesh, np.where(mesh.x[:, np.newaxis] < 0.01, 1.0, 0.5)), 4)
    0.8125
    """
    whole = mesh.mirrored(pressure)
    of_parabola, difference = np.zeros_like(whole), np.zeros_like(whole)
    for values, parabola, fourth in (
        (whole, of_parabola, difference),
        (whole.T, of_parabola.T, difference.T),
    ):
        if len(values) > 4:
            parabola[1:-1] += np.abs(np.diff(values, 2, axis=0)) / 8.0
            fourth[2:-2] = np.maximum(fourth[2:-2], np.abs(np.diff(values, 4, axis=0)))
    near = largest_nearby(difference)
    return max(0.0, float(np.max(whole + of_parabola + _PART * near)) - float(np.max(whole)))


# Parts into which a spacing is divided to look at the roughness between the nodes, in a line and in a point
# contact, and the number of nodes along x that are looked at together, which bounds the memory.
_PARTS = 32
_PARTS_POINT = 4
_BLOCK = 64

# Multiple of its change from the coarser grid by which the film at a node must fall to become the minimum,
# for the node to count. With one, a point contact on 65 nodes had an error of 2.5 times its estimate. With
# three, the estimates of line contacts are no better.
_CANDIDATE = 2.0

# Distance from the centre, in spacings, within which roughness between the nodes changes the film there.
_CENTRE = 1.5


def rough_film_error(
    problem: FilmProblem, fine: GridSolution, coarser: Sequence[GridSolution]
) -> float | None:
    """Relative discretisation error of a film with smooth or rough surfaces. Returns relative error of the
    minimum or of the central film thickness, whichever is larger; None if there is no coarser grid, or if
    either solution did not converge.

    The estimate of a rough film is the sum of two parts.

    - The film at its minimum, and near the centre, on both grids. The minimum jumps from one valley of the
      roughness to another, so the two minima may agree by chance. In Richardson's estimate their difference
      is replaced by the largest difference of the two films at any node that it might make the minimum: at
      the minima themselves, and wherever the film less twice the difference is below the minimum.
    - The roughness between the nodes. Waves that are short compared with the contact are not flattened
      (amplitude reduction, doi:10.1016/S0167-8922(08)70440-1): they keep their amplitude in the film. What
      the heights of the surface between the nodes exceed the line through the nodes, the film loses.
    """
    error = discretisation_error(problem, fine, coarser)
    if fine.touches or (coarser and coarser[0].touches):
        return None if error is None else _of_mean_gap(problem, fine, coarser[0])
    if error is None or problem.added_gap is None:
        return error
    films = [(grid.level.mesh, grid.state.thickness) for grid in (fine, coarser[0])]
    between = roughness_between_nodes(problem.added_gap, *films[0])
    of_grids = _of_two_grids(films[0], films[1], order=problem.order)
    return float(max(error, of_grids)) + between


def _of_mean_gap(problem: FilmProblem, fine: GridSolution, coarse: GridSolution) -> float:
    """Relative change of the mean gap over the dry contact from the coarser grid, where the surfaces touch.

    The minimum gap is the boundary film on all grids. The gap next to the spots changes from grid to
    grid irregularly, so that its change is not divided as the change of a film with a known order.
    """

    def mean_gap(grid: GridSolution) -> float:
        mesh = grid.level.mesh
        inside = problem.geometry.dry_pressure(mesh.x, mesh.y) > 0.0
        return float(np.average(grid.state.thickness, weights=mesh.weights * inside))

    return abs(mean_gap(coarse) / mean_gap(fine) - 1.0)


def _of_two_grids(fine: Values, coarse: Values, *, order: int) -> float:
    """Richardson's estimate with the largest changes of the film near its minima and near the centre."""
    ratio = coarse[0].dx / fine[0].dx
    of_minimum = change_of_minimum(fine, coarse) / float(np.min(fine[1]))
    of_centre = change_near(fine, coarse, [(0.0, 0.0)]) / at_centre(*fine)
    of_minimum /= ratio ** min(order, MINIMUM_ORDER) - 1.0
    return float(max(of_minimum, of_centre / (ratio**order - 1.0)))


def change_of_minimum(fine: Values, coarse: Values) -> float:
    """Largest difference between a film on two grids at any node that it might make the minimum. Returns
    largest absolute difference, in the unit of the film thickness.

    Examples
    --------
    Two valleys change places, so that the minimum does not change:

    >>> import numpy as np
    >>> fine, coarse = Mesh.over(5, -1.0, 1.0), Mesh.over(3, -1.0, 1.0)
    >>> on_fine = fine, np.array([[1.0], [2.0], [1.3], [2.0], [9.0]])
    >>> on_coarse = coarse, np.array([[1.3], [1.0], [8.0]])
    >>> round(change_of_minimum(on_fine, on_coarse), 3)
    0.3
    """
    mesh, film = cropped(coarse, fine[0])
    there = on_mesh(fine[1], fine[0], mesh)
    change = np.abs(there - film)
    lowest = float(np.min(fine[1]))
    candidates = there - _CANDIDATE * change <= lowest
    for whole in (there, film):
        candidates.flat[int(np.argmin(whole))] = True
    return max(abs(lowest - float(np.min(film))), float(np.max(change, where=candidates, initial=0.0)))


def roughness_between_nodes(
    added_gap: Callable[[Array, Array], Array], mesh: Mesh, thickness: Array
) -> float:
    """Relative change of the minimum or central film by the roughness between the nodes.

    ``added_gap``, gap that roughness adds: function of X (nx,) and Y (ny,) -> (nx, ny); ``thickness``, film
    thickness H at the nodes, shape (nx, ny). Returns amount by which the film between the nodes falls below
    its smallest node, over this smallest value; or the largest change near the centre over the film there, if
    that is more.

    Examples
    --------
    A wave of 1 % of the film that has its peaks between the nodes:

    >>> import numpy as np
    >>> mesh = Mesh.over(401, -2.0, 2.0)
    >>> wave = lambda x, y: -0.001 * np.sin(np.pi * x / mesh.dx)[:, np.newaxis] ** 2 + 0.0 * y
    >>> round(roughness_between_nodes(wave, mesh, np.full((401, 1), 0.1)), 4)
    0.01
    """
    parts = _PARTS if mesh.y.size == 1 else _PARTS_POINT
    # The film that smooth surfaces would leave varies little from node to node.
    smooth = thickness - added_gap(mesh.x, mesh.y)
    y = mesh.y if mesh.y.size == 1 else _parted(mesh.y, parts)
    lowest = float(np.min(thickness))
    for first in range(0, mesh.x.size - 1, _BLOCK):
        rows = slice(first, first + _BLOCK + 1)
        x = _parted(mesh.x[rows], parts)
        between = on_nodes(smooth[rows], (mesh.x[rows], mesh.y), (x, y))
        lowest = min(lowest, float(np.min(between + added_gap(x, y))))
    of_minimum = 1.0 - lowest / float(np.min(thickness))
    return max(of_minimum, _near_centre(added_gap, mesh, parts) / at_centre(mesh, thickness))


def _near_centre(added_gap: Callable[[Array, Array], Array], mesh: Mesh, parts: int) -> float:
    """Largest distance of the gap between the nodes from the line through the nodes, near X = Y = 0."""
    x = mesh.x[np.abs(mesh.x) <= (_CENTRE + 1.0) * mesh.dx]
    y = mesh.y if mesh.dy is None else mesh.y[np.abs(mesh.y) <= (_CENTRE + 1.0) * mesh.dy]
    finer = _parted(x, parts), (y if y.size == 1 else _parted(y, parts))
    through_nodes = on_nodes(added_gap(x, y), (x, y), finer)
    return float(np.max(np.abs(added_gap(*finer) - through_nodes)))


def _parted(nodes: Array, parts: int) -> Array:
    """Equidistant positions that divide every spacing of a grid into parts."""
    return np.linspace(nodes[0], nodes[-1], parts * (nodes.size - 1) + 1)
