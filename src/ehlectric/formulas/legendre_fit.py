"""Polynomials of low degree in several inputs, fitted to values at the points of a design.

The terms are products of Legendre polynomials, which are orthogonal over independent, evenly distributed
inputs.

B. Sudret, Reliab. Eng. Syst. Saf. 93 (2008) 964, doi:10.1016/j.ress.2007.04.002.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import combinations_with_replacement

import numpy as np
from numpy.polynomial.legendre import legvander

from ehlectric.arrays import Array, IntArray

# Largest degree of the polynomial, and points that a term has to have at least.
_DEGREE, _POINTS = 3, 3


@dataclass(frozen=True)
class LegendreFit:
    """Polynomials in k inputs, fitted to m functions at n points."""

    terms: IntArray  # degrees of the polynomials of each input in each term; the first is the constant (t, k)
    coefficients: Array  # shape (t, m)
    missed: Array  # values minus the polynomial that is fitted without their point, shape (n, m)

    @classmethod
    def of(cls, at: Array, values: Array) -> LegendreFit:
        """Fit of polynomials to functions of k inputs.

        ``at``, inputs from -1 to 1, evenly distributed and independent, shape (n, k); ``values`` of the
        functions, shape (n, m). The degree is 3, or less where there are fewer than three points for each
        term. The polynomial without a point follows from the diagonal of the projection on the terms.

        Examples
        --------
        >>> from ehlectric.formulas.sobol import sobol_points
        >>> at = 2.0 * sobol_points(2, 64, seed=1) - 1.0
        >>> fit = LegendreFit.of(at, at[:, :1] * at[:, 1:] ** 2)
        >>> fit.at(np.array([[0.5, -2.0]])).round(9).tolist()
        [[2.0]]
        """
        terms = _terms(at.shape[1], len(at))
        matrix = _matrix(at, terms)
        basis, triangle = np.linalg.qr(matrix)
        coefficients = np.linalg.solve(triangle, basis.T @ values)
        left = 1.0 - np.sum(np.square(basis), axis=1)
        return cls(terms, coefficients, (values - matrix @ coefficients) / left[:, np.newaxis])

    def at(self, points: Array) -> Array:
        """Polynomials at points from -1 to 1, shape (n, k) -> (n, m)."""
        values: Array = _matrix(points, self.terms) @ self.coefficients
        return values


def points_of_full_degree(inputs: int) -> int:
    """Least number of points to which polynomials of degree 3 in k inputs are fitted.

    Examples
    --------
    >>> points_of_full_degree(6), points_of_full_degree(8)
    (252, 495)
    """
    return _POINTS * math.comb(inputs + _DEGREE, _DEGREE)


def _matrix(at: Array, terms: IntArray) -> Array:
    """Products of orthonormal polynomials of all inputs, shape (n, terms)."""
    polynomials = legvander(at, _DEGREE) * np.sqrt(2.0 * np.arange(_DEGREE + 1) + 1.0)
    matrix = np.ones((len(at), len(terms)))
    for k in range(at.shape[1]):
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
