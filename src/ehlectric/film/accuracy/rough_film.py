"""Error estimate of a rough film: its change from the coarser grid, and the roughness between the nodes."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.accuracy.between_grids import Values, change_near, cropped, interpolated
from ehlectric.film.estimates import MINIMUM_ORDER, discretisation_error
from ehlectric.film.mesh import Mesh, at_centre
from ehlectric.film.problem import FilmProblem
from ehlectric.film.state import GridSolution

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
    """Relative discretisation error of a film with smooth or rough surfaces.

    Parameters
    ----------
    problem : FilmProblem
        Dimensionless problem of the contact.
    fine : GridSolution
        Film on the grid of the problem.
    coarser : sequence of GridSolution
        Films on the coarser grids for the same surfaces, from the finest on.

    Returns
    -------
    float or None
        Relative error of the minimum or of the central film thickness, whichever is larger. None if there is
        no coarser grid, or if either solution did not converge.

    Notes
    -----
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

    The least gap is that of the boundary film on all grids. The gap beside the spots changes from grid to
    grid irregularly, so that its change is not divided as that of a film with a known order.
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
    """Largest difference between a film on two grids at any node that it might make the minimum.

    Parameters
    ----------
    fine, coarse : pair of Mesh and ndarray
        Grid and film thickness (nx, ny), on a grid and on the next coarser grid over the same domain.

    Returns
    -------
    float
        Largest absolute difference, in the unit of the film thickness.

    Examples
    --------
    Two valleys change places, so that the minimum stays the same:

    >>> import numpy as np
    >>> fine, coarse = Mesh.over(5, -1.0, 1.0), Mesh.over(3, -1.0, 1.0)
    >>> on_fine = fine, np.array([[1.0], [2.0], [1.3], [2.0], [9.0]])
    >>> on_coarse = coarse, np.array([[1.3], [1.0], [8.0]])
    >>> round(change_of_minimum(on_fine, on_coarse), 3)
    0.3
    """
    mesh, film = cropped(coarse, fine[0])
    there = interpolated(*fine, mesh.x, mesh.y)
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

    Parameters
    ----------
    added_gap : callable
        Gap that roughness adds: function of X (nx,) and Y (ny,) -> (nx, ny).
    mesh : Mesh
        Grid.
    thickness : ndarray, shape (nx, ny)
        Film thickness H at the nodes.

    Returns
    -------
    float
        Amount by which the film between the nodes falls below its smallest node, over this smallest value;
        or the largest change near the centre over the film there, if that is more.

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
        block = Mesh(mesh.x[rows], mesh.y, mesh.symmetric)
        lowest = min(lowest, float(np.min(interpolated(block, smooth[rows], x, y) + added_gap(x, y))))
    of_minimum = 1.0 - lowest / float(np.min(thickness))
    return max(of_minimum, _near_centre(added_gap, mesh, parts) / at_centre(mesh, thickness))


def _near_centre(added_gap: Callable[[Array, Array], Array], mesh: Mesh, parts: int) -> float:
    """Largest distance of the gap between the nodes from the line through the nodes, near X = Y = 0."""
    x = mesh.x[np.abs(mesh.x) <= (_CENTRE + 1.0) * mesh.dx]
    y = mesh.y if mesh.dy is None else mesh.y[np.abs(mesh.y) <= (_CENTRE + 1.0) * mesh.dy]
    near = Mesh(x, y)
    finer = _parted(x, parts), (y if y.size == 1 else _parted(y, parts))
    through_nodes = interpolated(near, added_gap(x, y), *finer)
    return float(np.max(np.abs(added_gap(*finer) - through_nodes)))


def _parted(nodes: Array, parts: int) -> Array:
    """Equidistant positions that divide every spacing of a grid into parts."""
    return np.linspace(nodes[0], nodes[-1], parts * (nodes.size - 1) + 1)
