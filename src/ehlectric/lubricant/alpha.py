"""Pressure-viscosity coefficients of a viscosity law: initial, reciprocal asymptotic, and of the film."""

from __future__ import annotations

import math

import numpy as np

from ehlectric.arrays import Array
from ehlectric.lubricant.law import PressureLaw

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(8)

# Pressures among which the one is sought that raises the viscosity e times [Pa].
_SOUGHT = np.geomspace(1e5, 1e10, 101)

# Ends of the intervals of the quadrature, over the pressure that raises the viscosity e times. The last one
# is about 10 GPa for an oil: laws that saturate would never end.
_ENDS = np.concatenate([np.linspace(0.0, 40.0, 41), np.geomspace(40.0, 200.0, 17)[1:]])


def initial_alpha(law: PressureLaw) -> float:
    """Pressure-viscosity coefficient alpha at zero pressure, the slope of ln(eta), in 1/Pa.

    Parameters
    ----------
    law : callable
        ln(eta/eta0) and its derivative by pressure [1/Pa], as a function of the pressure [Pa].

    Examples
    --------
    >>> from ehlectric.lubricant.viscosity import barus
    >>> initial_alpha(lambda pressure: barus(pressure, pressure_viscosity_coefficient=2e-8))
    2e-08
    """
    return float(law(np.zeros(1))[1][0])


def reciprocal_asymptotic_alpha(law: PressureLaw) -> float:
    """Reciprocal asymptotic pressure-viscosity coefficient alpha*, in 1/Pa.

    alpha* = 1/Int_0^inf eta(0)/eta(p) dp, which film formulas take.

    Parameters
    ----------
    law : callable
        ln(eta/eta0) and its derivative by pressure [1/Pa], as a function of the pressure [Pa].

    Returns
    -------
    float
        Coefficient alpha* [1/Pa]; zero for a viscosity that does not rise with pressure.

    Notes
    -----
    S. Bair, High-Pressure Rheology for Quantitative Elastohydrodynamics, Elsevier, 2007, after Blok (1963).
    The integral ends at some 200 times the pressure that raises the viscosity e times, about 10 GPa, because
    laws that saturate or are capped have no finite integral. There the integrand of an oil is below 1e-8.

    Examples
    --------
    >>> from ehlectric.lubricant.viscosity import barus
    >>> round(reciprocal_asymptotic_alpha(lambda p: barus(p, pressure_viscosity_coefficient=2e-8)) * 1e9, 9)
    20.0
    """
    scale = _scale(law)
    return 0.0 if scale == math.inf else 1.0 / _integral(law, scale * _ENDS)


def unfinished_share(law: PressureLaw) -> float:
    """Share of the integral of alpha* that a further range of pressure of the same length would add, at most.

    Parameters
    ----------
    law : callable
        ln(eta/eta0) and its derivative by pressure [1/Pa], as a function of the pressure [Pa].

    Returns
    -------
    float
        Share, dimensionless; far below 1e-4 for an oil. For a viscosity that saturates at a small multiple
        of eta0, alpha* depends on where the integral ends, and the share says so.

    Examples
    --------
    >>> from ehlectric.lubricant.viscosity import barus
    >>> unfinished_share(lambda p: barus(p, pressure_viscosity_coefficient=2e-8)) < 1e-12
    True
    """
    scale = _scale(law)
    if scale == math.inf:
        return 0.0
    end = scale * _ENDS[-1:]
    return float(end[0] * np.exp(-np.asarray(law(end)[0], dtype=float)[0]) * reciprocal_asymptotic_alpha(law))


def _scale(law: PressureLaw) -> float:
    """Pressure that raises the viscosity about e times [Pa]; infinite if the viscosity does not rise."""
    exponent = np.asarray(law(_SOUGHT)[0], dtype=float)
    above = np.flatnonzero(exponent >= 1.0)
    if above.size:
        return float(_SOUGHT[above[0]])
    return float(_SOUGHT[-1] / exponent[-1]) if exponent[-1] > 0.0 else math.inf


def _integral(law: PressureLaw, ends: Array) -> float:
    """Integral of eta(0)/eta(p) over pressure [Pa], by Gauss-Legendre quadrature between the ends [Pa]."""
    middle, half = 0.5 * (ends[1:] + ends[:-1]), 0.5 * np.diff(ends)
    pressure = middle[:, np.newaxis] + half[:, np.newaxis] * _NODES
    exponent = np.reshape(law(pressure.ravel())[0], pressure.shape)
    return float(half @ (np.exp(-exponent) @ _WEIGHTS))
