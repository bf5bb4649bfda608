r"""Shear stress and flow in one column of the film, for stresses along one axis.

The stress changes linearly across the film, tau(zeta) = t + q (zeta - 1/2) with q = h dp/dx. The mid-film
stress t follows from the slip of the two surfaces, and the flux from t:

    Int a phi(tau) dzeta = g,    flux = Int w a phi(tau) dzeta,    phi(r) = r f(r^2)

All quantities are dimensionless: stresses over the characteristic stress of the law, a = eta_0/eta over zeta,
g the slip over the film thickness, and w the oil mass below zeta less half of that of the film. The flux is
thereby that of the oil relative to the mean speed of the surfaces (integration by parts of Int rho u dzeta).
It is the generalised Reynolds equation of P. Yang and S. Wen, J. Tribol. 112 (1990) 631,
doi:10.1115/1.2920308, without its effective viscosities.
"""

from __future__ import annotations

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.sheared.even import Flux
from ehlectric.film.sheared.laws import Constants, Rheology, ShearLaw
from ehlectric.film.sheared.profile import GAUSS, Quadrature, over_columns

# Largest number of Newton steps for a mid-film stress, and the step at which it is exact.
_MOST_STEPS, _EXACT = 80, 1e-12

# Step below which Newton's method has converged up to rounding, so that it needs no bracket.
_CLOSE = 1e-9

# Half the stress difference over the Eyring stress beyond which hyperbolic functions would overflow.
_LARGEST = 300.0

# Half the stress difference below which the flux factor is computed by its series.
_SMALL = 0.05


def uniform_eyring(fluidity: Array, gradient: Array, slip: Array) -> Flux:
    """Flux of an Eyring fluid of uniform viscosity and density one, in closed form.

    With Y = q/2, C = sinh(Y)/Y and B = (Y cosh Y - sinh Y)/(2 Y^2), the mid-film stress is asinh(g/(a C)) and
    the flux sqrt(a^2 + (g/C)^2) B.

    Parameters
    ----------
    fluidity, gradient, slip : ndarray, shape (...)
        a, q and g.

    Returns
    -------
    Flux
        Flux and derivatives.

    Examples
    --------
    At a small stress the flux is a q/12, that of a Newtonian fluid:

    >>> one = np.ones(1)
    >>> round(float(uniform_eyring(one, 1e-3 * one, 0.0 * one).flux[0] * 12e3), 6)
    1.0
    """
    y = np.clip(0.5 * gradient, -_LARGEST, _LARGEST)
    small = np.abs(y) < _SMALL
    x = np.where(small, y**2, 0.0)
    safe = np.where(small, 1.0, y)
    sinh, cosh = np.sinh(safe), np.cosh(safe)
    c = np.where(small, 1.0 + x / 6.0 * (1.0 + x / 20.0 * (1.0 + x / 42.0)), sinh / safe)
    b = np.where(small, y / 6.0 * (1.0 + x / 10.0 * (1.0 + x / 28.0)), 0.5 * (cosh - sinh / safe) / safe)
    b_y = np.where(
        small,
        (1.0 + x * (0.3 + x / 56.0)) / 6.0,
        0.5 * (sinh - 2.0 * (cosh - sinh / safe) / safe) / safe,
    )
    # d ln C/dY = coth Y - 1/Y = 2 Y B/(Y C)
    of_c = 2.0 * b / c
    ratio = slip / c
    root = np.hypot(fluidity, ratio)
    safe_root = np.maximum(root, 1e-300)
    return Flux(
        flux=root * b,
        by_gradient=0.5 * (root * b_y - ratio * (ratio / safe_root) * of_c * b)[np.newaxis],
        by_slip=((ratio / safe_root) * b / c)[np.newaxis],
        by_viscosity=-(fluidity * (fluidity / safe_root) * b)[np.newaxis],
    )


def middle_stress(
    rheology: Rheology, fluidity: Array, gradient: Array, slip: Array, quadrature: Quadrature
) -> Array:
    """Mid-film stress t over the characteristic stress, at which the surfaces have their slip.

    Parameters
    ----------
    rheology : Rheology
        Shear-thinning law.
    fluidity : ndarray, shape (nq, ...) or (1, ...)
        eta_0/eta at the points of the quadrature.
    gradient, slip : ndarray, shape (...)
        Stress difference q across the film, and slip g over the film thickness.
    quadrature : Quadrature
        Points and weights across the film.

    Returns
    -------
    ndarray, shape (...)
        Mid-film stress, in closed form for the Eyring law.

    Notes
    -----
    The Eyring stress is t = asinh(g/sqrt(C^2 - D^2)) - artanh(D/C) with C, D the integrals of a cosh Y and
    a sinh Y over zeta, Y = q (zeta - 1/2). They are computed as C + D and C - D, in logarithms.
    """
    weights = over_columns(quadrature.weights, gradient) * fluidity
    shape = over_columns(quadrature.offset, gradient) * gradient
    if rheology.name == "eyring":
        up, down = _log_integral(weights, shape), _log_integral(weights, -shape)
        half = np.exp(-0.5 * (up + down))
        return np.asarray(np.arcsinh(slip * half) - 0.5 * (up - down))
    return _by_newton(rheology.law, rheology.constants, weights, shape, slip)


def _log_integral(weights: Array, exponent: Array) -> Array:
    """Logarithm of the sum of ``weights`` exp(``exponent``) over the first axis, without overflow."""
    largest = np.max(exponent, axis=0)
    return np.asarray(largest + np.log(np.sum(weights * np.exp(exponent - largest), axis=0)))


def _by_newton(law: ShearLaw, constants: Constants, weights: Array, shape: Array, slip: Array) -> Array:
    """Mid-film stress by Newton's method within brackets.

    The rate Int a phi rises with t. The law's own inverse makes it nearly linear in t, so that Newton's
    method on it converges from far. For g > 0 the stress is between -max(q)/2 and the stress without a
    gradient plus max(q)/2, as the rate is then too small and too large everywhere in the column.
    """
    sign = np.where(slip < 0.0, -1.0, 1.0)
    slip, shape = sign * slip, sign * shape
    total = np.sum(weights, axis=0)
    reach = np.max(np.abs(shape), axis=0)
    factor, slope = law.factor(shape**2, constants)
    unit = np.sum(weights * (factor + 2.0 * slope * shape**2), axis=0)
    wanted, _ = law.stress(slip / unit, constants)
    low, high = -reach, law.stress(slip / total, constants)[0] + reach
    t = np.clip(wanted, low, high)
    before = np.full_like(t, np.inf)
    for _ in range(_MOST_STEPS):
        stress = t + shape
        factor, slope = law.factor(stress**2, constants)
        rate = np.sum(weights * stress * factor, axis=0)
        rate_t = np.sum(weights * (factor + 2.0 * slope * stress**2), axis=0)
        x = rate / unit
        reached, by_rate = law.stress(np.abs(x), constants)
        difference = np.sign(x) * reached - wanted
        low, high = np.where(difference < 0.0, t, low), np.where(difference > 0.0, t, high)
        following = t - difference * unit / (by_rate * rate_t)
        # A step that leaves the bracket, or follows one that gained less than half, is replaced by bisection.
        close = np.abs(following - t) < _CLOSE * (1.0 + np.abs(t))
        good = (following >= low) & (following <= high) & (np.abs(difference) < 0.5 * before)
        following = np.where(good | close, following, 0.5 * (low + high))
        before = np.abs(difference)
        step = np.max(np.abs(following - t) / (1.0 + np.abs(t)), initial=0.0)
        t = following
        if step < _EXACT:
            break
    middle: Array = sign * t
    return middle


def column_flux(
    rheology: Rheology,
    fluidity: Array,
    weight: Array,
    gradient: Array,
    slip: Array,
    quadrature: Quadrature = GAUSS,
) -> Flux:
    """Flux of columns with viscosity and density that vary across the film, at the Gauss points.

    Parameters
    ----------
    rheology : Rheology
        Shear-thinning law.
    fluidity : ndarray, shape (nq, ...) or (1, ...)
        a = eta_0/eta at the Gauss points.
    weight : ndarray, shape (nq, ...) or (nq, 1, ...)
        w: oil mass below the point less half of that of the film; zeta - 1/2 for a density of one.
    gradient, slip : ndarray, shape (...)
        q and g.
    quadrature : Quadrature
        Gauss points across the film.

    Returns
    -------
    Flux
        Flux and derivatives, exact for this quadrature: t follows its condition in all of them.
    """
    constants = rheology.constants
    t = middle_stress(rheology, fluidity, gradient, slip, quadrature)
    offset = over_columns(quadrature.offset, gradient)
    measure = over_columns(quadrature.weights, gradient) * fluidity
    stress = t + offset * gradient
    factor, slope = rheology.law.factor(stress**2, constants)
    rate = measure * stress * factor
    rate_t = measure * (factor + 2.0 * slope * stress**2)
    # Change of the flux with t over the change of the slip with t: the multiplier of the condition of slip.
    of_slip = np.sum(weight * rate_t, axis=0) / np.sum(rate_t, axis=0)
    free = weight - of_slip
    by_viscosity = -free * rate
    if fluidity.shape[0] == 1:
        by_viscosity = np.sum(by_viscosity, axis=0, keepdims=True)
    return Flux(
        flux=np.sum(weight * rate, axis=0),
        by_gradient=np.sum(free * offset * rate_t, axis=0)[np.newaxis],
        by_slip=of_slip[np.newaxis],
        by_viscosity=by_viscosity,
        by_weight=rate,
    )
