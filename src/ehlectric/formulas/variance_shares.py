"""Shares of the inputs in the variance of a function, from its values at the points of a design.

A polynomial of low degree in all inputs is fitted to the values. Its terms are products of Legendre
polynomials, which are orthogonal over independent, evenly distributed inputs, so that the squares of their
coefficients are parts of the variance.

B. Sudret, Reliab. Eng. Syst. Saf. 93 (2008) 964, doi:10.1016/j.ress.2007.04.002.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations_with_replacement

import numpy as np
from numpy.polynomial.legendre import legvander

from ehlectric.arrays import Array, IntArray

# Largest degree of the polynomial, and points that a term has to have at least.
_DEGREE, _POINTS = 3, 3


@dataclass(frozen=True)
class VarianceShares:
    """Parts of the variance of a function of independent inputs."""

    variance: float  # variance of the fitted polynomial
    # first and total: variance that would disappear if an input were known, and variance that would remain if
    # all others were known, over ``variance``; shape (k,).
    first: Array
    total: Array
    # Share of the variance of the values that the polynomial predicts where it was fitted without them.
    predicted: float


def variance_shares(at: Array, values: Array) -> VarianceShares:
    """Shares of k inputs in the variance of a function.

    ``at``, inputs from -1 to 1, evenly distributed and independent, shape (n, k); ``values`` of the function,
    shape (n,). The degree is 3, or less where there are fewer than three points for each term.

    Examples
    --------
    f = x + 2 y + 3 x y has the variance 1/3 + 4/3 + 1: x explains 1/8 of it, and x with y 1/2.

    >>> from ehlectric.formulas.sobol import sobol_points
    >>> at = 2.0 * sobol_points(2, 256, seed=1) - 1.0
    >>> shares = variance_shares(at, at[:, 0] + 2.0 * at[:, 1] + 3.0 * at[:, 0] * at[:, 1])
    >>> shares.first.round(9).tolist(), shares.total.round(9).tolist(), round(shares.predicted, 9)
    ([0.125, 0.5], [0.5, 0.875], 1.0)
    """
    number, inputs = at.shape
    terms = _terms(inputs, number)
    # Orthonormal polynomials of each input, shape (n, k, degree + 1).
    polynomials = legvander(at, _DEGREE) * np.sqrt(2.0 * np.arange(_DEGREE + 1) + 1.0)
    matrix = _matrix(polynomials, terms)
    basis, triangle = np.linalg.qr(matrix)
    coefficients = np.linalg.solve(triangle, basis.T @ values)
    parts = np.square(coefficients)
    variance = float(np.sum(parts[1:]))
    has = terms > 0
    alone = has & (np.count_nonzero(has, axis=1) == 1)[:, np.newaxis]
    missed = (values - matrix @ coefficients) / (1.0 - np.sum(np.square(basis), axis=1))
    scale, spread = (variance or 1.0), float(np.var(values))
    return VarianceShares(
        variance,
        parts @ alone / scale,
        parts @ has / scale,
        1.0 - float(np.mean(np.square(missed))) / spread if spread else 1.0,
    )


def _matrix(polynomials: Array, terms: IntArray) -> Array:
    """Products of polynomials of all inputs, shape (n, terms)."""
    matrix = np.ones((polynomials.shape[0], len(terms)))
    for k in range(polynomials.shape[1]):
        matrix *= polynomials[:, k, terms[:, k]]
    return matrix


def _terms(inputs: int, number: int) -> IntArray:
    """Degrees of the polynomials of each input in each term, shape (terms, k); the first is the constant."""
    terms = [np.zeros(inputs, dtype=int)]
    for degree in range(1, _DEGREE + 1):
        further = [
            np.bincount(chosen, minlength=inputs)
            for chosen in combinations_with_replacement(range(inputs), degree)
        ]
        if _POINTS * (len(terms) + len(further)) > number:
            break
        terms += further
    return np.array(terms)
