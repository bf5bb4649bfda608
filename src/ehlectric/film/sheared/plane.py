"""Shear stress and flow in one column of the film, for stresses along both axes of a point contact.

The equations are those of ``column`` with vectors: the stress tau(zeta) = t + q (zeta - 1/2) has two
components, and the shear rate has the direction of the stress. The mid-film stress t follows from two
conditions, the slip along both axes, by Newton's method. The two conditions are the gradient of a convex
function of t, so that there is one solution.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.film.sheared.even import Flux
from ehlectric.film.sheared.laws import Constants, Rheology, ShearLaw
from ehlectric.film.sheared.profile import GAUSS, Quadrature, over_columns

# Largest number of Newton steps for the mid-film stress, and the relative step at which it is exact: the
# error of Newton's method is the square of its step.
_MOST_STEPS, _EXACT = 80, 1e-8

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
    columns = gradient.shape[1:]
    gradient, slip = gradient.reshape(2, -1), slip.reshape(2, -1)
    fluidity = np.broadcast_to(fluidity.reshape(len(fluidity), -1), (len(fluidity), slip.shape[1]))
    state = _Iteration.start(rheology, fluidity, gradient, slip, quadrature)
    found = state.trial.copy()
    left = np.arange(slip.shape[1])
    for _ in range(_MOST_STEPS):
        state = state.stepped(rheology)
        found[:, left] = state.trial
        moving = _size(state.step) > _EXACT * (1.0 + _size(state.middle))
        if not moving.any():
            break
        left, state = left[moving], state.only(moving)
    return found.reshape(2, *columns)


@dataclass(frozen=True)
class _Iteration:
    """State of Newton's method in some columns, n of them.

    Attributes
    ----------
    weights, shape : ndarray, shapes (nq, n), (2, nq, n)
        Fluidity times weight at the points of the quadrature, and q times zeta - 1/2.
    unit, wanted : ndarray, shapes (n,), (2, n)
        Unit of the rate, and the stress of the slip without a gradient.
    middle, trial, step : ndarray, shape (2, n)
        Best stress so far, the one to try next, and their difference.
    before : ndarray, shape (n,)
        Difference to the slip at the best stress so far.
    """

    weights: Array
    shape: Array
    unit: Array
    wanted: Array
    middle: Array
    trial: Array
    step: Array
    before: Array

    @classmethod
    def start(
        cls, rheology: Rheology, fluidity: Array, gradient: Array, slip: Array, quadrature: Quadrature
    ) -> _Iteration:
        """Start from the stress of the slip without a gradient."""
        weights = quadrature.weights[:, np.newaxis] * fluidity
        shape = quadrature.offset[:, np.newaxis] * gradient[:, np.newaxis]
        squared = np.sum(shape**2, axis=0)
        factor, slope = rheology.law.factor(squared, rheology.constants)
        unit = np.sum(weights * (factor + 2.0 * slope * squared), axis=0)
        wanted, _ = _as_stress(rheology.law, rheology.constants, slip / unit)
        before = np.full(unit.shape, np.inf)
        return cls(weights, shape, unit, wanted, wanted, wanted, np.zeros_like(wanted), before)

    def stepped(self, rheology: Rheology) -> _Iteration:
        """State after one step; a step that does not reduce the difference to the slip is halved."""
        law, constants = rheology.law, rheology.constants
        rate, by_t = _rates(law, constants, self.weights, self.shape + self.trial[:, np.newaxis])
        reached, undo = _as_stress(law, constants, rate / self.unit)
        difference = reached - self.wanted
        size = _size(difference)
        better = size < self.before
        following = -self.unit * _solved(by_t, _times(undo, difference))
        middle = np.where(better, self.trial, self.middle)
        step = np.where(better, following, 0.5 * self.step)
        before = np.where(better, size, self.before)
        return replace(self, middle=middle, trial=middle + step, step=step, before=before)

    def only(self, columns: Mask) -> _Iteration:
        """State of some of the columns."""
        return _Iteration(**{name: values[..., columns] for name, values in vars(self).items()})


def _size(vector: Array) -> Array:
    """Length of vectors (2, ...)."""
    x, y = vector
    return np.asarray(np.sqrt(x * x + y * y))


def _rates(law: ShearLaw, constants: Constants, weights: Array, stress: Array) -> tuple[Array, Array]:
    """Rates along both axes (2, ...) of stresses (2, nq, ...), and their derivatives (xx, xy, yy) by t."""
    x, y = stress
    factor, slope = law.factor(x * x + y * y, constants)
    even, steep = weights * factor, 2.0 * weights * slope
    along, across = steep * x, steep * y
    total = np.sum(even, axis=0)
    rate = np.stack([_over(even, x), _over(even, y)])
    return rate, np.stack([total + _over(along, x), _over(along, y), total + _over(across, y)])


def _over(first: Array, second: Array) -> Array:
    """Sum over the points across the film, the first axis, of a product of two arrays."""
    return np.asarray(np.einsum("kn,kn->n", first, second))


def _tangent(factor: Array, slope: Array, stress: Array) -> Array:
    """Derivatives (xx, xy, yy) of the rate r f(r^2) by the stress r, shape (3, nq, ...)."""
    x, y = stress
    return np.stack([factor + 2.0 * slope * x**2, 2.0 * slope * x * y, factor + 2.0 * slope * y**2])


def _as_stress(law: ShearLaw, constants: Constants, rate: Array) -> tuple[Array, Array]:
    """Stress (2, ...) of a reduced rate (2, ...) without a gradient, and the inverse of its derivative."""
    size = np.maximum(_size(rate), _TINY)
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


def plane_flux(
    rheology: Rheology,
    fluidity: Array,
    weight: Array,
    gradient: Array,
    slip: Array,
    quadrature: Quadrature = GAUSS,
) -> Flux:
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
    quadrature : Quadrature
        Gauss points across the film.

    Returns
    -------
    Flux
        Flux and derivatives, exact for this quadrature.

    Examples
    --------
    At a small stress the flux along an axis is a q/12, that of a Newtonian fluid:

    >>> oil = Rheology("eyring", {"eyring_stress": 5e6})
    >>> gradient, slip = np.array([[1.2e-3], [5e-3]]), np.array([[3e-3], [4e-3]])
    >>> offset = Quadrature.gauss().offset[:, np.newaxis]
    >>> round(float(plane_flux(oil, np.ones((1, 1)), offset, gradient, slip).flux[0]), 7)
    0.0001
    """
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
