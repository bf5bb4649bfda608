"""Values on the nodes of a point contact, interpolated to a finer grid for maps and their contour lines."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import RectBivariateSpline
from scipy.ndimage import gaussian_filter

from ehlectric.arrays import Array

# Nodes along each side of a map, about: enough that no cell of the grid can be seen in print.
_NODES = 480


def refined(
    position: tuple[Array, Array], values: Array, window: tuple[tuple[float, float], tuple[float, float]]
) -> tuple[tuple[Array, Array], Array]:
    """Values on a finer grid within a window, by bicubic splines.

    Between nodes, lines of equal value are smooth instead of a chain of cells. A spline through a pressure
    spike may swing by some per cent of the spike on its flanks.

    Parameters
    ----------
    position : tuple of ndarray
        Positions x, shape (nx,), and y, shape (ny,), of the nodes [m].
    values : ndarray, shape (nx, ny)
        Values at the nodes.
    window : tuple of tuple of float
        Ranges of x and of y that are shown [m].

    Returns
    -------
    position : tuple of ndarray
        Positions x, shape (mx,), and y, shape (my,), on the finer grid [m]. It contains all nodes of the
        window and the next ones around it.
    values : ndarray, shape (mx, my)
        Values on the finer grid.
    """
    columns, rows = (_around(axis, ends) for axis, ends in zip(position, window, strict=True))
    x, y = position[0][columns], position[1][rows]
    spline = RectBivariateSpline(x, y, values[columns, rows], kx=min(3, x.size - 1), ky=min(3, y.size - 1))
    finer = _finer(x), _finer(y)
    fine: Array = spline(finer[0], finer[1])
    return finer, fine


def _around(axis: Array, ends: tuple[float, float]) -> slice:
    """Nodes within a range, and two more on either side."""
    first, last = np.searchsorted(axis, ends)
    return slice(max(int(first) - 2, 0), int(last) + 2)


def _finer(axis: Array) -> Array:
    """Nodes with further ones between them."""
    between = max(1, round(_NODES / axis.size))
    at = np.arange(between * (axis.size - 1) + 1) / between
    finer: Array = np.interp(at, np.arange(axis.size), axis)
    return finer


def smoothed(values: Array) -> Array:
    """Values at nodes (nx, ny), smoothed over about one spacing: filtered, plus the filtered rest.

    The second filtering gives back most of what the first takes off a round maximum.

    Of a mask as zeros and ones, the line of one half is the edge of the mask without the steps of the grid,
    less than a node away from it.
    """
    smooth: Array = gaussian_filter(values, 1.0, mode="nearest")
    rest: Array = gaussian_filter(values - smooth, 1.0, mode="nearest")
    return smooth + rest
