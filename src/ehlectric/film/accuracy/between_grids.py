"""Difference of a field of values between a grid and the next coarser grid, near a position."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import make_interp_spline

from ehlectric.arrays import Array
from ehlectric.film.mesh import Mesh

# Distance from a position, in spacings of the coarser grid, within which values are compared.
_REACH = 4.0

# Nodal values (nx, ny) on a grid.
Values = tuple[Mesh, Array]


def interpolated(mesh: Mesh, values: Array, x: Array, y: Array) -> Array:
    """Nodal values (nx, ny) at the positions x and y, by linear interpolation along both axes."""
    result: Array = make_interp_spline(mesh.x, values, k=1, axis=0)(x)
    if mesh.y.size > 1:
        result = make_interp_spline(mesh.y, result, k=1, axis=1)(y)
    return result


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

    Parameters
    ----------
    fine, coarse : pair of Mesh and ndarray
        Grid and nodal values (nx, ny), on a grid and on the next coarser grid over the same domain or a
        larger one.
    places : list of (float, float)
        Positions (X, Y).

    Returns
    -------
    float
        Largest absolute difference at the nodes of the coarser grid, in the unit of the values.

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
    difference = np.abs(interpolated(*fine, mesh.x, mesh.y) - values)
    largest = 0.0
    for at_x, at_y in places:
        near = np.abs(mesh.x - at_x)[:, np.newaxis] <= (_REACH + 0.01) * mesh.dx
        if mesh.dy is not None:
            near = near & (np.abs(mesh.y - at_y) <= (_REACH + 0.01) * mesh.dy)
        largest = max(largest, float(np.max(difference, where=near, initial=0.0)))
    return largest
