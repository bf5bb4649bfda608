"""Shares of the inputs in the variance of a function, from its values at the points of a design.

A polynomial of low degree in all inputs is fitted to the values. Its terms are products of Legendre
polynomials, which are orthogonal over independent, evenly distributed inputs, so that the squares of their
coefficients are parts of the variance.

B. Sudret, Reliab. Eng. Syst. Saf. 93 (2008) 964, doi:10.1016/j.ress.2007.04.002.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array
from ehlectric.formulas.legendre_fit import LegendreFit


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
    fit = LegendreFit.of(at, values[:, np.newaxis])
    parts = np.square(fit.coefficients[:, 0])
    variance = float(np.sum(parts[1:]))
    has = fit.terms > 0
    alone = has & (np.count_nonzero(has, axis=1) == 1)[:, np.newaxis]
    scale, spread = (variance or 1.0), float(np.var(values))
    return VarianceShares(
        variance,
        parts @ alone / scale,
        parts @ has / scale,
        1.0 - float(np.mean(np.square(fit.missed))) / spread if spread else 1.0,
    )
