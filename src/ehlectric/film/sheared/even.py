"""Stress and flow in one column of the film where the rate factor f is the same across the film.

A Newtonian oil has f = 1. At a limiting shear stress the stress law alone would put all slip into a layer at
one surface, and the flux would jump with the sign of the pressure gradient. Where the oil shears is not known
there. The slip is therefore spread evenly: f is that of the mean stress Int a tau dzeta/Int a dzeta, which
the limit bounds. The part of the stress that balances the pressure gradient is not limited. Stress and flux
have closed forms,

    x = g/Int a,    tau_mean = r(abs(x)) x/abs(x),    f = abs(x)/r,    flux = B0 x + f K q

with B0 = Int w a dzeta, K the covariance of w and zeta with the weight a, and the notation of ``column``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.sheared.laws import Rheology
from ehlectric.film.sheared.profile import GAUSS, Quadrature, over_columns

# Smallest rate that is divided by.
_TINY = 1e-300


@dataclass(frozen=True)
class Flux:
    """Flux of columns along one axis, and its derivatives.

    Attributes
    ----------
    flux : ndarray, shape (...)
        Int w a phi dzeta.
    by_gradient : ndarray, shape (d, ...)
        Derivative by the stress difference q across the film, along this axis and, for d = 2, the other one.
    by_slip : ndarray, shape (d, ...)
        Derivative by the slip g along both axes.
    by_viscosity : ndarray, shape (nq, ...)
        Derivative by ln eta at each Gauss point; shape (1, ...) if the viscosity is uniform.
    by_weight : ndarray, shape (nq, ...), or None
        Derivative by w at each Gauss point; None if the properties are uniform.
    """

    flux: Array
    by_gradient: Array
    by_slip: Array
    by_viscosity: Array
    by_weight: Array | None = None


@dataclass(frozen=True)
class EvenStress:
    """Mid-film stress of columns with one rate factor across the film.

    Attributes
    ----------
    middle : ndarray, shape (d, ...)
        Mid-film stress over the characteristic stress of the law.
    factor, slope : ndarray, shape (...)
        Rate factor f, and its derivative by abs(x).
    softening : ndarray, shape (...)
        d ln(tau)/d ln(eta) at a fixed shear rate.
    """

    middle: Array
    factor: Array
    slope: Array
    softening: Array

    @classmethod
    def of(
        cls, rheology: Rheology, fluidity: Array, gradient: Array, slip: Array, quadrature: Quadrature
    ) -> EvenStress:
        """Stress of columns, from a (nq, ...) or (1, ...), q (d, ...) and g (d, ...).

        Examples
        --------
        Couette flow at a rate far above tau_L/mu has the limiting stress:

        >>> oil = Rheology("limiting", {"limiting_coefficient": 0.05})
        >>> one, gauss = np.ones((1, 1)), Quadrature.gauss()
        >>> EvenStress.of(oil, one, 0.0 * one, 1e3 * one, gauss).middle.round(6).tolist()
        [[1.0]]
        """
        measure = over_columns(quadrature.weights, slip[0]) * fluidity
        total = np.sum(measure, axis=0)
        centre = np.sum(over_columns(quadrature.offset, slip[0]) * measure, axis=0) / total
        rate = slip / total
        size = np.maximum(np.sqrt(np.sum(rate**2, axis=0)), _TINY)
        stress, by_rate = rheology.law.stress(size, rheology.constants)
        return cls(
            middle=stress / size * rate - gradient * centre,
            factor=size / stress,
            slope=(1.0 - size / stress * by_rate) / stress * (size > _TINY),
            softening=size * by_rate / stress,
        )


def even_flux(
    rheology: Rheology,
    fluidity: Array,
    weight: Array,
    gradient: Array,
    slip: Array,
    quadrature: Quadrature = GAUSS,
) -> Flux:
    """Flux along the first axis of columns with one rate factor across the film.

    Parameters
    ----------
    rheology : Rheology
        Law with ``even``.
    fluidity : ndarray, shape (nq, ...) or (1, ...)
        a = eta_0/eta at the Gauss points.
    weight : ndarray, shape (nq, ...) or (nq, 1, ...)
        w: oil mass below the point less half of that of the film; zeta - 1/2 for a density of one.
    gradient, slip : ndarray, shape (d, ...)
        q and g along the axis of the flux and, for d = 2, along the other axis.
    quadrature : Quadrature
        Gauss points across the film.

    Returns
    -------
    Flux
        Flux and derivatives.

    Examples
    --------
    A Newtonian fluid of uniform viscosity has the flux a q/12:

    >>> offset = Quadrature.gauss().offset[:, np.newaxis]
    >>> found = even_flux(Rheology(), np.ones((1, 1)), offset, np.array([[1.2]]), np.array([[3.0]]))
    >>> round(float(found.flux[0]), 12)
    0.1
    """
    state = EvenStress.of(rheology, fluidity, gradient, slip, quadrature)
    offset = over_columns(quadrature.offset, gradient[0])
    measure = over_columns(quadrature.weights, gradient[0]) * fluidity
    total = np.sum(measure, axis=0)
    centre, mean = (np.sum(values * measure, axis=0) / total for values in (offset, weight))
    product = (weight - mean) * (offset - centre)
    covariance = np.sum(product * measure, axis=0)
    rate = slip / total
    size = np.sqrt(np.sum(rate**2, axis=0))
    # The factor falls as the rate falls, which is inversely proportional to the sum of the fluidities.
    driven = covariance * gradient[0]
    by_rate = state.slope * driven
    by_slip = by_rate * rate / (np.maximum(size, _TINY) * total)
    by_slip[0] += mean
    by_gradient = np.zeros_like(gradient)
    by_gradient[0] = state.factor * covariance
    of_viscosity = (weight - mean) * rate[0] + state.factor * gradient[0] * product - by_rate * size / total
    by_viscosity = -measure * of_viscosity
    if fluidity.shape[0] == 1:
        by_viscosity = np.sum(by_viscosity, axis=0, keepdims=True)
    return Flux(
        flux=mean * slip[0] + state.factor * driven,
        by_gradient=by_gradient,
        by_slip=by_slip,
        by_viscosity=by_viscosity,
        by_weight=measure * (rate[0] + state.factor * gradient[0] * (offset - centre)),
    )
