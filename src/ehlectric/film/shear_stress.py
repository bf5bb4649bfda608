"""Shear stress and flow in columns of the film: along one axis, along both axes, and with one rate factor
across the film.

The stress changes linearly across the film, tau(zeta) = t + q (zeta - 1/2) with q = h dp/dx. The mid-film
stress t follows from the slip of the two surfaces, and the flux from t:

    Int a phi(tau) dzeta = g,    flux = Int w a phi(tau) dzeta,    phi(r) = r f(r^2)

All quantities are dimensionless: stresses over the characteristic stress of the law, a = eta_0/eta over zeta,
g the slip over the film thickness, and w the oil mass below zeta less half of the oil mass of the film. The
flux is thereby the flux of the oil relative to the mean speed of the surfaces (integration by parts of Int
rho u dzeta). It is the generalised Reynolds equation of P. Yang and S. Wen, J. Tribol. 112 (1990) 631,
doi:10.1115/1.2920308, without its effective viscosities.

A Newtonian oil has the rate factor f = 1 across the film. At a limiting shear stress the stress law without a
correction would put all slip into a layer at one surface, and the flux would jump with the sign of the
pressure gradient. The position at which the oil shears is not known there. The slip is therefore spread
evenly: f belongs to the mean stress Int a tau dzeta/Int a dzeta, which the limit bounds. The part of the
stress that balances the pressure gradient is not limited. Stress and flux have closed forms,

    x = g/Int a,    tau_mean = r(abs(x)) x/abs(x),    f = abs(x)/r,    flux = B0 x + f K q

with B0 = Int w a dzeta, K the covariance of w and zeta with the weight a.

Along both axes of a point contact the equations hold with vectors: the stress tau(zeta) = t + q (zeta
- 1/2) has two components, and the shear rate has the direction of the stress. The mid-film stress t follows
from two conditions, the slip along both axes, by Newton's method. The two conditions are the gradient of a
convex function of t, so that there is one solution.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.film.across_film import GAUSS, Quadrature, over_columns
from ehlectric.film.shear_laws import Constants, Rheology, ShearLaw

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

    ``fluidity``, ``gradient`` and ``slip``, a, q and g, shape (...).

    Examples
    --------
    At a small stress the flux is a q/12, as in a Newtonian fluid:

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

    ``fluidity``, eta_0/eta at the points of the quadrature, shape (nq, ...) or (1, ...); ``gradient`` and
    ``slip``, stress difference q across the film, and slip g over the film thickness, shape (...). Returns
    mid-film stress, in closed form for the Eyring law, shape (...).

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
    target, _ = law.stress(slip / unit, constants)
    low, high = -reach, law.stress(slip / total, constants)[0] + reach
    t = np.clip(target, low, high)
    before = np.full_like(t, np.inf)
    for _ in range(_MOST_STEPS):
        stress = t + shape
        factor, slope = law.factor(stress**2, constants)
        rate = np.sum(weights * stress * factor, axis=0)
        rate_t = np.sum(weights * (factor + 2.0 * slope * stress**2), axis=0)
        x = rate / unit
        reached, by_rate = law.stress(np.abs(x), constants)
        difference = np.sign(x) * reached - target
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
    return sign * t


def column_flux(
    rheology: Rheology,
    fluidity: Array,
    weight: Array,
    gradient: Array,
    slip: Array,
    quadrature: Quadrature = GAUSS,
) -> Flux:
    """Flux of columns with viscosity and density that vary across the film, at the Gauss points.

    ``fluidity``, a = eta_0/eta at the Gauss points, shape (nq, ...) or (1, ...); ``weight``, w: oil mass
    below the point less half of the oil mass of the film; zeta - 1/2 for a density of one, shape (nq, ...) or
    (nq, 1,
    ...); ``gradient`` and ``slip``, q and g, shape (...). Returns flux and derivatives, exact for this
    quadrature: t follows its condition in all of them.
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


# Smallest rate that is divided by.
_TINY = 1e-300


@dataclass(frozen=True)
class Flux:
    """Flux of columns along one axis, and its derivatives."""

    flux: Array  # int w a phi dzeta, shape (...)
    # Derivative by the stress difference q across the film, along this axis and, for d = 2, the other one,
    # shape (d, ...).
    by_gradient: Array
    by_slip: Array  # derivative by the slip g along both axes, shape (d, ...)
    # Derivative by ln eta at each Gauss point; shape (1, ...) if the viscosity is uniform, shape (nq, ...).
    by_viscosity: Array
    # Derivative by w at each Gauss point; None if the properties are uniform, shape (nq, ...).
    by_weight: Array | None = None
    # Flux without a gradient over the slip, shape (...): the stress is then the same across the film, so that
    # the shear rate goes with the fluidity, whatever the law. None if the properties are uniform.
    drift: Array | None = None
    # Step of the mid-film stress over the characteristic stress that is left: the relative error of the flux
    # is its square. None where the stress has a closed form, shape (...).
    step: Array | None = None


@dataclass(frozen=True)
class EvenStress:
    """Mid-film stress of columns with one rate factor across the film."""

    middle: Array  # mid-film stress over the characteristic stress of the law, shape (d, ...)
    # factor and slope: rate factor f, and its derivative by abs(x), shape (...).
    factor: Array
    slope: Array
    softening: Array  # d ln(tau)/d ln(eta) at a fixed shear rate, shape (...)

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

    ``fluidity``, a = eta_0/eta at the Gauss points, shape (nq, ...) or (1, ...); ``weight``, w: oil mass
    below the point less half of the oil mass of the film; zeta - 1/2 for a density of one, shape (nq, ...) or
    (nq, 1,
    ...); ``gradient`` and ``slip``, q and g along the axis of the flux and, for d = 2, along the other axis,
    shape (d, ...).

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


# Largest number of Newton steps for the mid-film stress along both axes, and its relative error: the square
# of the last step.
_MOST_PLANE_STEPS, _EXACT_PLANE = 80, 1e-16

# Largest stress difference over the characteristic stress at which an estimate of the mid-film stress is
# tried.
_NEARLY_EVEN = 0.5


def middle_stresses(
    rheology: Rheology,
    fluidity: Array,
    gradient: Array,
    slip: Array,
    quadrature: Quadrature,
    *,
    exact: float = _EXACT_PLANE,
) -> Array:
    """Mid-film stress t along both axes, over the characteristic stress of the law.

    ``fluidity``, eta_0/eta at the points of the quadrature, shape (nq, ...) or (1, ...); ``gradient`` and
    ``slip``, stress difference q across the film, and slip g over the film thickness, along both axes,
    shape (2, ...); ``exact``, relative error. Returns mid-film stress, shape (2, ...).
    """
    columns = gradient.shape[1:]
    gradient, slip = gradient.reshape(2, -1), slip.reshape(2, -1)
    fluidity = np.broadcast_to(fluidity.reshape(len(fluidity), -1), (len(fluidity), slip.shape[1]))
    stress, far = np.empty_like(slip), np.arange(slip.shape[1])
    if np.max(np.abs(gradient), initial=0.0) < _NEARLY_EVEN:
        estimate = _Plane.of(rheology, fluidity, gradient, slip, quadrature)
        stress = estimate.middle + estimate.step
        far = np.flatnonzero(_size(estimate.step) > exact**0.5)
    if far.size:
        part = fluidity[:, far], gradient[:, far], slip[:, far]
        stress[:, far] = _by_newton_in_plane(rheology, *part, quadrature, exact=exact**0.5)
    return stress.reshape(2, *columns)


def _by_newton_in_plane(
    rheology: Rheology,
    fluidity: Array,
    gradient: Array,
    slip: Array,
    quadrature: Quadrature,
    *,
    exact: float,
) -> Array:
    """Mid-film stress (2, n) of columns, from a (nq, n) or (1, n), q and g (2, n).

    Newton's method acts on the rates after the inverse of the law, which makes them nearly linear in t. A
    step that does not reduce the difference to the slip is halved. It ends with a relative step of ``exact``.
    """
    state = _Iteration.start(rheology, fluidity, gradient, slip, quadrature)
    stress = state.trial.copy()
    left = np.arange(slip.shape[1])
    for _ in range(_MOST_PLANE_STEPS):
        state = state.stepped(rheology)
        stress[:, left] = state.trial
        moving = _size(state.step) > exact * (1.0 + _size(state.middle))
        if not moving.any():
            break
        left, state = left[moving], state.only(moving)
    return stress


@dataclass(frozen=True)
class _Plane:
    """Shear rates of columns (n,) along both axes at a mid-film stress, and its step to the slip."""

    middle: Array  # mid-film stress over the characteristic stress, shape (2, n)
    # rate and by_stress: rates times weight and fluidity at the points of the quadrature, shape (2, nq, n),
    # and their derivatives (xx, xy, yy) by the stress, shape (3, nq, n).
    rate: Array
    by_stress: Array
    by_t: Array  # sums of these derivatives, shape (3, n)
    missing: Array  # slip less the sum of the rates, shape (2, n)
    step: Array  # Newton step of the mid-film stress, shape (2, n)

    @classmethod
    def of(
        cls,
        rheology: Rheology,
        fluidity: Array,
        gradient: Array,
        slip: Array,
        quadrature: Quadrature,
        middle: Array | None = None,
    ) -> _Plane:
        """Rates at a mid-film stress (2, n), or at an estimate for small stress differences: the stress of
        the mean rate, with the rate factor of the root mean square of the stress that balances the gradient.

        The arguments are the arguments of ``middle_stresses``, with one axis of columns.
        """
        law, constants = rheology.law, rheology.constants
        measure = quadrature.weights[:, np.newaxis] * fluidity
        if middle is None:
            total, centre = quadrature.weights @ fluidity, (quadrature.weights * quadrature.offset) @ fluidity
            square = (gradient[0] ** 2 + gradient[1] ** 2) / 12.0
            factor, slope = law.factor(square, constants)
            mean, _ = _as_stress(law, constants, slip / (total * (factor + 2.0 * slope * square)))
            middle = mean - gradient * (centre / total)
        stress = middle[:, np.newaxis] + quadrature.offset[:, np.newaxis] * gradient[:, np.newaxis]
        x, y = stress
        factor, slope = law.factor(x * x + y * y, constants)
        factor *= measure
        slope *= measure
        slope *= 2.0
        rate = factor * stress
        by_stress = np.empty((3, *x.shape))
        along = slope * x
        np.multiply(along, x, out=by_stress[0])
        np.multiply(along, y, out=by_stress[1])
        np.multiply(slope * y, y, out=by_stress[2])
        by_stress[0] += factor
        by_stress[2] += factor
        by_t = np.sum(by_stress, axis=1)
        missing = slip - np.sum(rate, axis=1)
        return cls(middle, rate, by_stress, by_t, missing, _solved(by_t, missing))


@dataclass(frozen=True)
class _Iteration:
    """State of Newton's method in some columns, n of them."""

    # weights and shape: fluidity times weight at the points of the quadrature, and q times zeta - 1/2,
    # shapes (nq, n).
    weights: Array
    shape: Array
    # unit and target: unit of the rate, and the stress of the slip without a gradient, shapes (n,).
    unit: Array
    target: Array
    # middle, trial and step: best stress so far, the one to try next, and their difference, shape (2, n).
    middle: Array
    trial: Array
    step: Array
    before: Array  # difference to the slip at the best stress so far, shape (n,)

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
        target, _ = _as_stress(rheology.law, rheology.constants, slip / unit)
        before = np.full(unit.shape, np.inf)
        return cls(weights, shape, unit, target, target, target, np.zeros_like(target), before)

    def stepped(self, rheology: Rheology) -> _Iteration:
        """State after one step; a step that does not reduce the difference to the slip is halved."""
        law, constants = rheology.law, rheology.constants
        rate, by_t = _rates(law, constants, self.weights, self.shape + self.trial[:, np.newaxis])
        reached, undo = _as_stress(law, constants, rate / self.unit)
        difference = reached - self.target
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


def _as_stress(law: ShearLaw, constants: Constants, rate: Array) -> tuple[Array, Array]:
    """Stress (2, ...) of a reduced rate (2, ...) without a gradient, and the inverse of its derivative."""
    size = np.maximum(_size(rate), _TINY)
    stress, by_size = law.stress(size, constants)
    x, y = rate / size
    along, across = 1.0 / by_size, size / stress
    difference = along - across
    inverse = np.stack([across + difference * x**2, difference * x * y, across + difference * y**2])
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
    reduced = first / large - part * other
    return np.stack([np.where(swapped, other, reduced), np.where(swapped, reduced, other)])


def plane_flux(
    rheology: Rheology,
    fluidity: Array,
    weight: Array,
    gradient: Array,
    slip: Array,
    quadrature: Quadrature = GAUSS,
    *,
    exact: float = 1e-24,
    estimated: bool = False,
) -> Flux:
    """Flux along the first axis of columns with stresses along both axes.

    ``fluidity``, a = eta_0/eta at the Gauss points, shape (nq, ...) or (1, ...); ``weight``, w: oil mass
    below the point less half of the oil mass of the film; zeta - 1/2 for a density of one, shape (nq, ...) or
    (nq, 1,
    ...); ``gradient`` and ``slip``, q and g along the axis of the flux, and along the other axis,
    shape (2, ...); ``exact``, relative error of the flux for this quadrature; the error of the derivatives is
    its root; ``estimated``, whether an estimate of the mid-film stress for small stress differences counts.
    Returns flux and derivatives.

    Examples
    --------
    At a small stress the flux along an axis is a q/12, as in a Newtonian fluid:

    >>> oil = Rheology("eyring", {"eyring_stress": 5e6})
    >>> gradient, slip = np.array([[1.2e-3], [5e-3]]), np.array([[3e-3], [4e-3]])
    >>> offset = Quadrature.gauss().offset[:, np.newaxis]
    >>> round(float(plane_flux(oil, np.ones((1, 1)), offset, gradient, slip).flux[0]), 7)
    0.0001
    """
    shape = gradient.shape[1:]
    gradient, slip = gradient.reshape(2, -1), slip.reshape(2, -1)
    count = quadrature.offset.size
    each = np.broadcast_to(fluidity.reshape(len(fluidity), -1), (count, slip.shape[1]))
    weight = np.broadcast_to(weight.reshape(count, -1), each.shape)

    middle = None
    if not estimated:
        middle = _by_newton_in_plane(rheology, each, gradient, slip, quadrature, exact=exact**0.25)
    plane = _Plane.of(rheology, each, gradient, slip, quadrature, middle)
    flux = _flux_in_plane(plane, weight, quadrature)
    total, by_gradient, by_slip, by_viscosity, by_weight = flux
    if fluidity.shape[0] == 1:
        by_viscosity = np.sum(by_viscosity, axis=0, keepdims=True)
    return Flux(
        flux=total.reshape(shape),
        by_gradient=by_gradient.reshape(2, *shape),
        by_slip=by_slip.reshape(2, *shape),
        by_viscosity=by_viscosity.reshape(-1, *shape),
        by_weight=by_weight.reshape(count, *shape),
        step=_size(plane.step).reshape(shape),
    )


def _flux_in_plane(
    plane: _Plane, weight: Array, quadrature: Quadrature
) -> tuple[Array, Array, Array, Array, Array]:
    """Flux of columns along the first axis (n,), and its derivatives by gradient (2, n), slip (2, n), and
    viscosity and weight at the points (nq, n), from the rates near the mid-film stress.

    ``weight`` (nq, n) is the weight of ``plane_flux``.
    """
    rate, (xx, xy, yy) = plane.rate, plane.by_stress
    weighted = weight * plane.by_stress[:2]
    # Multipliers of the two conditions of slip: the change of the flux with t divided by the change of the
    # slip with t. They also correct the flux for the slip that is missing, at second order.
    of_slip = _solved(plane.by_t, np.sum(weighted, axis=1))
    flow = weight * rate[0]
    moments = [quadrature.offset @ values for values in (weighted[0], weighted[1], xx, xy, yy)]
    flux = np.sum(flow, axis=0) + np.sum(of_slip * plane.missing, axis=0)
    first, second = of_slip
    by_gradient = np.stack(
        [
            moments[0] - first * moments[2] - second * moments[3],
            moments[1] - first * moments[3] - second * moments[4],
        ]
    )
    return flux, by_gradient, of_slip, first * rate[0] + second * rate[1] - flow, rate[0]
