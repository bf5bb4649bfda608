"""Mean of the film factors of measured rows, with its interval."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.stats import t as student

from ehlectric.arrays import Array

# Probability of the interval.
CONFIDENCE = 0.95

# Texts that say where the statistical part of an interval is from.
STATED, RAISED, SCATTER = "stated uncertainty", "stated uncertainty, raised to the scatter", "scatter only"


@dataclass(frozen=True)
class MeanFactor:
    """Weighted mean of film factors, and its 95 % interval.

    Attributes
    ----------
    value : float
        Geometric mean, weighted with the reciprocal variances of the rows, dimensionless.
    low, high : float or None
        Ends of the 95 % interval; None for a single row without a stated uncertainty.
    statistical, systematic : float or None
        Relative standard uncertainty of the mean from the rows, and from inputs that all rows share.
    scatter : float or None
        Scatter of the rows divided by their stated uncertainty (Birge ratio), dimensionless. Without a stated
        uncertainty: relative standard deviation of the rows. None for a single row.
    basis : str
        Origin of ``statistical``: "stated uncertainty", "stated uncertainty, raised to the scatter" or
        "scatter only".
    rows : int
        Number of rows.
    """

    value: float
    low: float | None
    high: float | None
    statistical: float | None
    systematic: float
    scatter: float | None
    basis: str
    rows: int

    def summary(self) -> dict[str, Any]:
        """Values as in measured.json."""
        return {
            "mean": self.value,
            "low": self.low,
            "high": self.high,
            "statistical_uncertainty": self.statistical,
            "systematic_uncertainty": self.systematic,
            "scatter": self.scatter,
            "basis": self.basis,
            "rows": self.rows,
        }


def mean_factor(
    factors: Array, stated: Array | None = None, shared: Mapping[str, Array] | None = None
) -> MeanFactor:
    """Mean of film factors in their logarithm.

    Parameters
    ----------
    factors : ndarray, shape (n,)
        Film factors of the rows, n >= 1.
    stated : ndarray, shape (n,), optional
        Relative standard uncertainty of each factor from its measurement, independent of other rows.
    shared : mapping of str to ndarray, shape (n,), optional
        Change of ln(factor) by one standard uncertainty of an input that all rows share. Each input moves all
        rows together, so that more rows do not make its part smaller.

    Returns
    -------
    MeanFactor
        Mean and interval. Where rows scatter more than they state, the stated uncertainties are raised by
        the Birge ratio. Without stated uncertainties all rows count alike, and Student's t is used.

    Examples
    --------
    >>> mean = mean_factor(np.array([0.69, 0.71]), np.array([0.03, 0.03]))
    >>> round(mean.value, 3), round(mean.low, 3), round(mean.high, 3), mean.basis
    (0.7, 0.671, 0.73, 'stated uncertainty')
    """
    logs, n = np.log(factors), len(factors)
    weights = np.ones(n) if stated is None else stated**-2.0
    weights = weights / np.sum(weights)
    mean = float(np.vdot(weights, logs))
    if stated is None:
        deviation = float(np.std(logs, ddof=1)) if n > 1 else None
        statistical = None if deviation is None else deviation / math.sqrt(n)
        scatter, basis, degrees = deviation, SCATTER, float(n - 1)
    else:
        own = float(np.sum(stated**-2.0)) ** -0.5
        scatter = math.sqrt(float(np.sum(((logs - mean) / stated) ** 2)) / (n - 1)) if n > 1 else None
        raised = scatter is not None and scatter > 1.0
        statistical = own * (scatter or 1.0) if raised else own
        basis, degrees = RAISED if raised else STATED, math.inf
    parts = [float(np.vdot(weights, change)) for change in (shared or {}).values()]
    systematic = math.hypot(*parts) if parts else 0.0
    low, high = _interval(mean, statistical, systematic, degrees)
    return MeanFactor(math.exp(mean), low, high, statistical, systematic, scatter, basis, n)


def _interval(
    mean: float, statistical: float | None, systematic: float, degrees: float
) -> tuple[float | None, float | None]:
    """Ends of the interval of a mean in its logarithm; the systematic part is taken as normal."""
    if statistical is None:
        return None, None
    at = 0.5 * (1.0 + CONFIDENCE)
    wide = float(student.ppf(at, degrees)) if math.isfinite(degrees) else float(student.ppf(at, 1e9))
    half = math.hypot(wide * statistical, float(student.ppf(at, 1e9)) * systematic)
    return math.exp(mean - half), math.exp(mean + half)


def slope_of(x: Array, factors: Array, stated: Array | None = None) -> tuple[float, float] | None:
    """Slope d ln(factor)/d ln(x) of film factors over a speed, and its standard uncertainty.

    Parameters
    ----------
    x, factors : ndarray, shape (n,)
        Speeds and film factors, above 0.
    stated : ndarray, shape (n,), optional
        Relative standard uncertainties of the factors, as weights.

    Returns
    -------
    tuple of float or None
        Slope and its standard uncertainty from the scatter about the line, at least the stated one; None for
        fewer than three different speeds.

    Examples
    --------
    >>> u = np.array([1.0, 2.0, 4.0, 8.0])
    >>> slope, uncertainty = slope_of(u, u**-0.1)
    >>> round(slope, 6), uncertainty < 1e-9
    (-0.1, True)
    """
    if len(np.unique(x)) < 3:
        return None
    a, b = np.log(x), np.log(factors)
    weights = np.ones(len(x)) if stated is None else stated**-2.0
    a0, b0 = (float(np.average(values, weights=weights)) for values in (a, b))
    spread = float(np.sum(weights * (a - a0) ** 2))
    slope = float(np.sum(weights * (a - a0) * (b - b0))) / spread
    rest = float(np.sum(weights * (b - b0 - slope * (a - a0)) ** 2)) / (len(x) - 2)
    if stated is not None:
        rest = max(rest, 1.0)
    return slope, math.sqrt(rest / spread)
