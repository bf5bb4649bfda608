"""Shear stress and flow in one column of the film, for stresses along both axes of a point contact.

The equations are those of ``column`` with vectors: the stress tau(zeta) = t + q (zeta - 1/2) has two
components, and the shear rate has the direction of the stress. The mid-film stress t follows from two
conditions, the slip along both axes, by Newton's method. The two conditions are the gradient of a convex
function of t, so that there is one solution.
"""

from __future__ import annotations

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.sheared.column import Flux, over_columns
from ehlectric.film.sheared.laws import Constants, Rheology, ShearLaw
from ehlectric.film.sheared.profile import Quadrature

# Largest number of Newton steps for the mid-film stress, and the relative step at which it is exact.
_MOST_STEPS, _EXACT = 80, 1e-12

# Relative step below which Newton's method has converged up to rounding, so that it needs no damping.
_CLOSE = 1e-9

# Smallest rate that is divided by.
_TINY = 1e-300


def middle_stresses(
    rheology: Rheology, fluidity: Array, gradient: Array, slip: Array, quadrature: Quadrature
) -> Array:
    """Mid-film stress t along both axes, over the characteristic stress of the law.

    Parameters
    ----------
    rheology : Rheology
        Shear-thinning law.
    fluidity : ndarray, shape (nq, ...) or (1, ...)
        eta_0/eta at the points of the quadrature.
    gradient, slip : ndarray, shape (2, ...)
        Stress difference q across the film, and slip g over the film thickness, along both axes.
    quadrature : Quadrature
        Points and weights across the film.

    Returns
    -------
    ndarray, shape (2, ...)
        Mid-film stress.

    Notes
    -----
    Newton's method acts on the rates after the inverse of the law, which makes them nearly linear in t. A
    step that does not reduce the difference to the slip is halved.
    """
    weights = over_columns(quadrature.weights, gradient[0]) * fluidity
    shape = over_columns(quadrature.offset, gradient[0]) * gradient[:, np.newaxis]
    law, constants = rheology.law, rheology.constants
    squared = np.sum(shape**2, axis=0)
    factor, slope = law.factor(squared, constants)
    unit = np.sum(weights * (factor + 2.0 * slope * squared), axis=0)
    wanted, _ = _as_stress(law, constants, slip / unit)
    t, trial = wanted, wanted
    step, before = np.zeros_like(t), np.full(t.shape[1:], np.inf)
    for _ in range(_MOST_STEPS):
        rate, by_t = _rates(law, constants, weights, shape + trial[:, np.newaxis])
        reached, undo = _as_stress(law, constants, rate / unit)
        difference = reached - wanted
        size = np.linalg.norm(difference, axis=0)
        close = np.linalg.norm(step, axis=0) < _CLOSE * (1.0 + np.linalg.norm(t, axis=0))
        better = (size < before) | close
        following = -unit * _solved(by_t, _times(undo, difference))
        t = np.where(better, trial, t)
        before = np.where(better, size, before)
        step = np.where(better, following, 0.5 * step)
        trial = t + step
        length = np.linalg.norm(step, axis=0) / (1.0 + np.linalg.norm(t, axis=0))
        if np.max(length, initial=0.0) < _EXACT:
            break
    return np.asarray(trial)


def _rates(law: ShearLaw, constants: Constants, weights: Array, stress: Array) -> tuple[Array, Array]:
    """Rates along both axes (2, ...) of stresses (2, nq, ...), and their derivatives (xx, xy, yy) by t."""
    factor, slope = law.factor(np.sum(stress**2, axis=0), constants)
    rate = np.sum(weights * factor * stress, axis=1)
    return rate, np.sum(weights * _tangent(factor, slope, stress), axis=1)


def _tangent(factor: Array, slope: Array, stress: Array) -> Array:
    """Derivatives (xx, xy, yy) of the rate r f(r^2) by the stress r, shape (3, nq, ...)."""
    x, y = stress
    return np.stack([factor + 2.0 * slope * x**2, 2.0 * slope * x * y, factor + 2.0 * slope * y**2])


def _as_stress(law: ShearLaw, constants: Constants, rate: Array) -> tuple[Array, Array]:
    """Stress (2, ...) of a reduced rate (2, ...) without a gradient, and the inverse of its derivative."""
    size = np.maximum(np.linalg.norm(rate, axis=0), _TINY)
    stress, by_size = law.stress(size, constants)
    x, y = rate / size
    along, beside = 1.0 / by_size, size / stress
    difference = along - beside
    inverse = np.stack([beside + difference * x**2, difference * x * y, beside + difference * y**2])
    return stress / size * rate, inverse


def _times(matrix: Array, vector: Array) -> Array:
    """Product of symmetric matrices (xx, xy, yy) with vectors (2, ...)."""
    xx, xy, yy = matrix
    x, y = vector
    return np.stack([xx * x + xy * y, xy * x + yy * y])


def _solved(matrix: Array, vector: Array) -> Array:
    """Solutions (2, ...) of symmetric positive definite systems (xx, xy, yy).

    The larger diagonal entry is eliminated, so that the difference of products cannot overflow.
    """
    xx, xy, yy = matrix
    x, y = vector
    swapped = yy > xx
    large, small = np.where(swapped, yy, xx), np.where(swapped, xx, yy)
    first, second = np.where(swapped, y, x), np.where(swapped, x, y)
    part = xy / large
    other = (second - part * first) / np.maximum(small - part * xy, _TINY)
    one = first / large - part * other
    return np.stack([np.where(swapped, other, one), np.where(swapped, one, other)])


def plane_flux(rheology: Rheology, fluidity: Array, weight: Array, gradient: Array, slip: Array) -> Flux:
    """Flux along the first axis of columns with stresses along both axes.

    Parameters
    ----------
    rheology : Rheology
        Shear-thinning law.
    fluidity : ndarray, shape (nq, ...) or (1, ...)
        a = eta_0/eta at the Gauss points.
    weight : ndarray, shape (nq, ...) or (nq, 1, ...)
        w: oil mass below the point less half of that of the film; zeta - 1/2 for a density of one.
    gradient, slip : ndarray, shape (2, ...)
        q and g along the axis of the flux, and along the other axis.

    Returns
    -------
    Flux
        Flux and derivatives, exact for this quadrature.

    Examples
    --------
    A Newtonian fluid flows along the gradient, whatever the slip is:

    >>> gradient, slip = np.array([[1.2], [5.0]]), np.array([[3.0], [4.0]])
    >>> offset = Quadrature.gauss().offset[:, np.newaxis]
    >>> found = plane_flux(Rheology(), np.ones((1, 1)), offset, gradient, slip)
    >>> round(float(found.flux[0]), 12)
    0.1
    """
    quadrature = Quadrature.gauss()
    t = middle_stresses(rheology, fluidity, gradient, slip, quadrature)
    offset = over_columns(quadrature.offset, gradient[0])
    measure = over_columns(quadrature.weights, gradient[0]) * fluidity
    stress = t[:, np.newaxis] + offset * gradient[:, np.newaxis]
    factor, slope = rheology.law.factor(np.sum(stress**2, axis=0), rheology.constants)
    rate = measure * factor * stress
    xx, xy, yy = measure * _tangent(factor, slope, stress)
    # Multipliers of the two conditions of slip: the change of the flux with t over that of the slip with t.
    by_t = np.stack([np.sum(weight * part, axis=0) for part in (xx, xy)])
    of_slip = _solved(np.stack([np.sum(part, axis=0) for part in (xx, xy, yy)]), by_t)
    free, other = weight - of_slip[0], -of_slip[1]
    by_viscosity = -(free * rate[0] + other * rate[1])
    if fluidity.shape[0] == 1:
        by_viscosity = np.sum(by_viscosity, axis=0, keepdims=True)
    return Flux(
        flux=np.sum(weight * rate[0], axis=0),
        by_gradient=np.stack(
            [
                np.sum(offset * (free * xx + other * xy), axis=0),
                np.sum(offset * (free * xy + other * yy), axis=0),
            ]
        ),
        by_slip=of_slip,
        by_viscosity=by_viscosity,
        by_weight=rate[0],
    )
