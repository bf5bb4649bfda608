"""Polynomials on a few nodes: quadrature, interpolation, derivative; linear interpolation between grids."""

from __future__ import annotations

from functools import cache

import numpy as np
import scipy

from ehlectric.arrays import Array, IntArray


@cache
def gauss_legendre(number: int) -> tuple[Array, Array]:
    """Points and weights of Gauss-Legendre quadrature between -1 and 1; their search takes a millisecond."""
    points, weights = np.polynomial.legendre.leggauss(number)
    return points, weights


def lobatto_nodes(degree: int) -> Array:
    """Gauss-Lobatto-Legendre nodes on [0, 1], ascending, shape (degree + 1,).

    Examples
    --------
    >>> [float(s) for s in lobatto_nodes(2)]
    [0.0, 0.5, 1.0]
    """
    interior = scipy.special.roots_jacobi(degree - 1, 1.0, 1.0)[0] if degree > 1 else np.empty(0)
    return 0.5 * (1.0 + np.concatenate([[-1.0], interior, [1.0]]))


def lobatto_weights(nodes: Array) -> Array:
    """Weights of the quadrature on ``lobatto_nodes``, shape (n,)."""
    degree = nodes.size - 1
    return 1.0 / (degree * (degree + 1) * scipy.special.eval_legendre(degree, 2.0 * nodes - 1.0) ** 2)


def interpolation(nodes: Array, at: Array) -> Array:
    """Values at ``at`` (n,) of the Lagrange polynomials of ``nodes`` (m,), shape (n, m)."""
    columns = []
    for k, node in enumerate(nodes):
        others = np.delete(nodes, k)
        columns.append(np.prod((at[:, np.newaxis] - others) / (node - others), axis=1))
    return np.stack(columns, axis=1)


def on_nodes(values: Array, axes: tuple[Array, ...], nodes: tuple[Array, ...]) -> Array:
    """Return nodal values on the nodes of another grid within the same domain, by linear interpolation.

    ``values`` have the shape (..., n1, n2) for two axes of n1 and n2 nodes. An axis is kept where both grids
    have the same nodes, or where it has a single node. The given array is returned if all axes are kept.

    Examples
    --------
    >>> on_nodes(np.array([0.0, 1.0, 4.0]), (np.arange(3.0),), (np.array([0.5, 1.5]),)).tolist()
    [0.5, 2.5]
    """
    for axis, (old, new) in enumerate(zip(axes, nodes, strict=True), -len(axes)):
        if old.size == 1 or (old.size == new.size and np.array_equal(old, new)):
            continue
        left, part = interval(old, new)
        part = part.reshape(-1, *(1,) * (-1 - axis))
        values = (1.0 - part) * np.take(values, left, axis) + part * np.take(values, left + 1, axis)
    return values


def interval(nodes: Array, at: Array) -> tuple[IntArray, Array]:
    """Node before each position, and the distance from it as a part of the interval. ``nodes``, increasing,
    shape (n,); ``at``, positions of any shape; positions beyond the ends belong to the end intervals.

    Examples
    --------
    >>> [values.tolist() for values in interval(np.array([0.0, 1.0, 3.0]), np.array([0.5, 2.0]))]
    [[0, 1], [0.5, 0.5]]
    """
    left = np.clip(np.searchsorted(nodes, at, side="right") - 1, 0, nodes.size - 2)
    return left, (at - nodes[left]) / (nodes[left + 1] - nodes[left])


def linear_interpolation(left: IntArray, share: Array, size: int) -> scipy.sparse.csr_array:
    """Sparse matrix (n, size) of linear interpolation between the nodes ``left`` (n,) and the next ones.

    ``share`` (n,) is the weight of the next node.
    """
    rows = np.repeat(np.arange(left.size), 2)
    columns = np.stack([left, left + 1], axis=1).ravel()
    values = np.stack([1.0 - share, share], axis=1).ravel()
    matrix = scipy.sparse.csr_array((values, (rows, columns)), shape=(left.size, size))
    matrix.eliminate_zeros()
    return matrix


def derivative_matrix(nodes: Array) -> Array:
    """Matrix (n, n) of the derivative at the nodes (n,), exact for their polynomial; its rows sum to zero.

    J.-P. Berrut and L. N. Trefethen, SIAM Rev. 46 (2004) 501, doi:10.1137/S0036144502417715, section 9.3.

    Examples
    --------
    >>> s = lobatto_nodes(4)
    >>> bool(np.allclose(derivative_matrix(s) @ s**3, 3.0 * s**2))
    True
    """
    apart = nodes[:, np.newaxis] - nodes + np.eye(nodes.size)
    scale = 1.0 / np.prod(apart, axis=1)
    matrix: Array = scale / scale[:, np.newaxis] / apart
    np.fill_diagonal(matrix, 0.0)
    np.fill_diagonal(matrix, -matrix.sum(axis=1))
    return matrix
