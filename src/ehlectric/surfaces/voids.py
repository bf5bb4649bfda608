"""Voids of a measured map, the points without data, and their filling by a harmonic function."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ehlectric.arrays import Array, IntArray, Mask

if TYPE_CHECKING:
    from scipy import sparse


# Residual at which the solution for the filling stops, relative to the residual of the initial guess.
_TOLERANCE = 1e-8
_MOST_STEPS = 5000


def without_void_borders(heights: Array) -> Array:
    """Map without the outer rows and columns that have no data at all.

    Parameters
    ----------
    heights : ndarray, shape (nx, ny)
        Heights in any unit, NaN at voids.

    Returns
    -------
    ndarray
        Heights over the smallest rectangle that contains all points with data; empty if there are none.

    Examples
    --------
    >>> import numpy as np
    >>> heights = np.full((5, 6), np.nan)
    >>> heights[1:3, 2:6] = 0.0
    >>> without_void_borders(heights).shape
    (2, 4)
    """
    there = np.isfinite(heights)
    if not there.any():
        return heights[:0, :0]
    kept = []
    for other in (1, 0):
        lines = np.flatnonzero(there.any(axis=other))
        kept.append(slice(lines[0], lines[-1] + 1))
    return heights[kept[0], kept[1]]


def filled(heights: Array, spacing_x: float, spacing_y: float) -> Array:
    """Map with its voids filled by a harmonic function, the shape of a soap film.

    Inside a void the discrete Laplacian of the heights is zero, and the filling joins the measured heights at
    the rim of the void. It stays between the lowest and the highest height at the rim. At a side of the map
    its slope is zero.

    Parameters
    ----------
    heights : ndarray, shape (nx, ny)
        Heights [m], NaN at voids; at least one must be finite.
    spacing_x, spacing_y : float
        Distances between neighbouring points along x and y [m].

    Returns
    -------
    ndarray, shape (nx, ny)
        Heights without NaN [m].

    Examples
    --------
    The Laplacian of a plane is zero, so that a hole in a plane is filled exactly:

    >>> import numpy as np
    >>> plane = np.add.outer(np.arange(8.0), 2.0 * np.arange(9.0))
    >>> holed = plane.copy()
    >>> holed[2:5, 3:7] = np.nan
    >>> bool(np.allclose(filled(holed, 1.0, 1.0), plane))
    True
    """
    void = np.isnan(heights)
    if not void.any():
        return heights
    from scipy import ndimage
    from scipy.sparse.linalg import cg

    # The initial guess is the height of the nearest point with data: the zero of an instrument may be far
    # away.
    nearest = ndimage.distance_transform_edt(
        void, sampling=(spacing_x, spacing_y), return_distances=False, return_indices=True
    )
    whole: Array = heights[tuple(nearest)]
    laplacian, force = _laplacian(whole, void, spacing_x, spacing_y)
    change, _ = cg(laplacian, force, rtol=_TOLERANCE, maxiter=_MOST_STEPS)
    whole[void] += change
    return whole


def _laplacian(whole: Array, void: Mask, dx: float, dy: float) -> tuple[sparse.csr_array, Array]:
    """Negative Laplacian over the n void points as a matrix, and Laplacian of the initial guess there (n,).

    ``whole`` (nx, ny) has the initial guess at the ``void`` points and the measured heights elsewhere.
    """
    from scipy import sparse

    n = int(void.sum())
    number = np.full(void.shape, -1)
    number[void] = np.arange(n)
    diagonal, force = np.zeros(n), np.zeros(n)
    pairs: list[tuple[Array, IntArray, IntArray]] = []
    for axis, spacing in enumerate((dx, dy)):
        weight = (min(dx, dy) / spacing) ** 2
        halves = [(slice(None, -1), slice(1, None)) if k == axis else (slice(None),) * 2 for k in (0, 1)]
        ends = [(halves[0][k], halves[1][k]) for k in (0, 1)]
        for here, there in ((0, 1), (1, 0)):
            own, other = number[ends[here]], number[ends[there]]
            rise = (whole[ends[there]] - whole[ends[here]])[own >= 0]
            own, other = own[own >= 0], other[own >= 0]
            diagonal[own] += weight
            force[own] += weight * rise
            both = other >= 0
            pairs.append((np.full(int(both.sum()), -weight), own[both], other[both]))
    pairs.append((diagonal, np.arange(n), np.arange(n)))
    values, rows, columns = (np.concatenate(part) for part in zip(*pairs, strict=True))
    return sparse.csr_array((values, (rows, columns)), shape=(n, n)), force
