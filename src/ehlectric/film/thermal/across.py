"""Differentiation and conduction across the film, on its Gauss-Lobatto nodes."""

from __future__ import annotations

from functools import cache

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.sheared.profile import Across


@cache
def derivative(degree: int) -> Array:
    """Matrix of the derivative by zeta at the nodes of ``Across.of(degree)``.

    Parameters
    ----------
    degree : int
        Degree of the polynomial across the film.

    Returns
    -------
    ndarray, shape (nz, nz)
        Exact for polynomials of this degree; its rows sum to zero.

    Notes
    -----
    J.-P. Berrut and L. N. Trefethen, SIAM Rev. 46 (2004) 501, doi:10.1137/S0036144502417715, section 9.3.

    Examples
    --------
    >>> zeta = Across.of(4).zeta
    >>> bool(np.allclose(derivative(4) @ zeta**3, 3.0 * zeta**2))
    True
    """
    zeta = Across.of(degree).zeta
    apart = zeta[:, np.newaxis] - zeta + np.eye(zeta.size)
    scale = 1.0 / np.prod(apart, axis=1)
    matrix = scale / scale[:, np.newaxis] / apart
    matrix -= np.diag(np.diag(matrix))
    return np.asarray(matrix - np.diag(matrix.sum(axis=1)))


def conduction(across: Across, conductivity: Array) -> Array:
    """Matrix of conduction across the film in its weak form, the integral of k T' phi' over zeta.

    Parameters
    ----------
    across : Across
        Nodes across the film.
    conductivity : ndarray, shape (nz, ...)
        Thermal conductivity at the nodes.

    Returns
    -------
    ndarray, shape (..., nz, nz)
        Symmetric matrix; its rows sum to zero.

    Examples
    --------
    A linear temperature conducts the same heat through both surfaces:

    >>> nodes = Across.of(4)
    >>> heat = conduction(nodes, np.full(5, 2.0)) @ nodes.zeta
    >>> bool(np.allclose(heat, [-2.0, 0.0, 0.0, 0.0, 2.0]))
    True
    """
    slope = derivative(across.zeta.size - 1)
    weighted = np.moveaxis(conductivity, 0, -1) * across.weights
    return np.asarray(slope.T @ (weighted[..., np.newaxis] * slope))
