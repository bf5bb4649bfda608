"""Polynomials instead of a model, within a box of its inputs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.formulas.legendre_fit import LegendreFit

# Least number of points with a value from which a polynomial is fitted.
_LEAST = 8


@dataclass(frozen=True)
class Emulator:
    """Polynomials of degree 3 or less for m predictions of a model with k inputs from 0 to 1.

    The polynomial of a prediction that is positive everywhere is a polynomial for its logarithm.
    """

    low: Array  # smallest and largest input of the box, shape (k,)
    high: Array
    active: Mask  # inputs of the polynomials; the other inputs have no effect, shape (k,)
    logs: Mask  # whether the polynomial is one for the logarithm, shape (m,)
    fit: LegendreFit
    # Standard deviations of predictions from values that the polynomial was not fitted to: of the logarithm
    # or of the prediction itself, shape (m,).
    error: Array

    @classmethod
    def of(cls, at: Array, predictions: Array, low: Array, high: Array, active: Mask) -> Emulator | None:
        """Polynomials for predictions at points, shape (n, k) and (n, m); None where too few points have a
        prediction. ``low`` and ``high``, ends of the box of the points, ``active``, inputs with an effect,
        shape (k,).
        """
        known = np.all(np.isfinite(predictions), axis=1)
        if np.count_nonzero(known) < _LEAST:
            return None
        values = predictions[known]
        logs = np.all(values > 0.0, axis=0)
        transformed = np.where(logs, np.log(np.where(logs, values, 1.0)), values)
        fit = LegendreFit.of(_scaled(at[known], low, high)[:, active], transformed)
        return cls(low, high, active, logs, fit, np.sqrt(np.mean(np.square(fit.missed), axis=0)))

    def transformed(self, at: Array) -> Array:
        """Predictions or their logarithms at points, shape (n, k) -> (n, m)."""
        return self.fit.at(_scaled(at, self.low, self.high)[:, self.active])

    def at(self, at: Array) -> Array:
        """Predictions at points, shape (n, k) -> (n, m)."""
        values = self.transformed(at)
        return np.where(self.logs, np.exp(np.where(self.logs, values, 0.0)), values)

    def deviation(self, values: Array) -> Array:
        """Standard deviations of predictions near values, shape (m,), in the unit of the values."""
        return np.where(self.logs, self.error * np.abs(values), self.error)


def _scaled(at: Array, low: Array, high: Array) -> Array:
    """Points of a box from -1 to 1."""
    scaled: Array = 2.0 * (at - low) / (high - low) - 1.0
    return scaled
