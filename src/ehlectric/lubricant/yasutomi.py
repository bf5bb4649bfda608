"""Viscosity over pressure and temperature from the distance to the glass transition, after Yasutomi."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array, Mask, Numbers
from ehlectric.lubricant.law import Law, glass_warnings, parameters_of, within
from ehlectric.quantities.result_warnings import ResultWarning

_NAME = "viscosity_law 'yasutomi'"

_LN_10 = math.log(10.0)


def yasutomi(
    pressure: ArrayLike,
    temperature: ArrayLike | None = None,
    *,
    yasutomi_glass_viscosity: Numbers,
    yasutomi_glass_temperature: Numbers,
    yasutomi_a1: Numbers,
    yasutomi_a2: Numbers,
    yasutomi_b1: Numbers,
    yasutomi_b2: Numbers,
    yasutomi_c1: Numbers,
    yasutomi_c2: Numbers,
) -> tuple[Array, Array]:
    """Logarithm of the relative viscosity after the improved Yasutomi law, and its derivative by pressure.

    eta = eta_g exp(-2.303 C1 (T - Tg) F/(C2 + (T - Tg) F)) with the glass transition temperature
    Tg = Tg0 + A1 ln(1 + A2 p) and the relative thermal expansion F = (1 + b1 p)^b2 of the free volume.

    ``pressure`` [Pa], shape (...); ``temperature`` [K]; ``yasutomi_glass_viscosity``, viscosity eta_g at the
    glass transition [Pa s]; ``yasutomi_glass_temperature``, glass transition temperature Tg0 at zero pressure
    [K]; ``yasutomi_a1`` and ``yasutomi_a2``, constants A1 [K], a difference of temperatures, and A2 [1/Pa];
    ``yasutomi_b1`` and ``yasutomi_b2``, constants b1 [1/Pa] and b2, dimensionless, <= 0; ``yasutomi_c1`` and
    ``yasutomi_c2``, constants C1, dimensionless, and C2 [K], a difference of temperatures. Returns
    ln(eta/eta0), dimensionless, with the viscosity eta0 of ``yasutomi_viscosity``, and its derivative by
    pressure [1/Pa], shape (...). Raises InputError if the temperature is missing, or not above the glass
    transition at zero pressure.

    S. Yasutomi, S. Bair and W. O. Winer, J. Tribol. 106 (1984) 291, with the function F of the improved law
    of S. Bair and others (2013), as later works quote both. The original law has F = 1 - B1 ln(1 + B2 p), and
    its constants are not the constants of this law. The number 2.303 of the printed law is ln 10. Below the
    glass transition the law has a pole. There the viscosity is held at eta_g, with a slope of zero.

    Examples
    --------
    >>> oil = dict(yasutomi_glass_viscosity=1e12, yasutomi_glass_temperature=189.95, yasutomi_a1=188.86)
    >>> oil |= dict(yasutomi_a2=0.719e-9, yasutomi_b1=8.2e-9, yasutomi_b2=-0.5278)
    >>> oil |= dict(yasutomi_c1=16.09, yasutomi_c2=17.38)
    >>> exponent, slope = yasutomi([0.0, 0.5e9, 1.5e9], 298.15, **oil)
    >>> exponent.round(2).tolist(), round(float(slope[0]) * 1e9, 1)
    ([0.0, 11.54, 31.92], 24.7)
    """
    p, at = np.asarray(pressure, dtype=float), _above_glass(temperature, yasutomi_glass_temperature)
    distance = at - yasutomi_glass_temperature - yasutomi_a1 * np.log1p(yasutomi_a2 * p)
    liquid = distance > 0.0
    free = (1.0 + yasutomi_b1 * p) ** yasutomi_b2
    reduced = np.maximum(distance, 0.0) * free
    free_slope = free * yasutomi_b2 * yasutomi_b1 / (1.0 + yasutomi_b1 * p)
    fall = yasutomi_a1 * yasutomi_a2 / (1.0 + yasutomi_a2 * p)
    reduced_slope = np.where(liquid, distance * free_slope - fall * free, 0.0)
    ambient = at - yasutomi_glass_temperature
    # The difference of x/(C2 + x) at both pressures, without cancellation.
    gap = yasutomi_c2 * (ambient - reduced) / ((yasutomi_c2 + ambient) * (yasutomi_c2 + reduced))
    steep = yasutomi_c2 / (yasutomi_c2 + reduced) ** 2
    factor = _LN_10 * yasutomi_c1
    return factor * gap, -factor * steep * reduced_slope


def yasutomi_viscosity(
    temperature: ArrayLike,
    *,
    yasutomi_glass_viscosity: Numbers,
    yasutomi_glass_temperature: Numbers,
    yasutomi_a1: Numbers,
    yasutomi_a2: Numbers,
    yasutomi_b1: Numbers,
    yasutomi_b2: Numbers,
    yasutomi_c1: Numbers,
    yasutomi_c2: Numbers,
) -> Array:
    """Viscosity at zero pressure after Yasutomi, eta0 = eta_g exp(-2.303 C1 (T - Tg0)/(C2 + T - Tg0)).

    ``temperature`` [K], shape (...); ``yasutomi_glass_viscosity``, ``yasutomi_glass_temperature``,
    ``yasutomi_c1`` and ``yasutomi_c2``, constants eta_g [Pa s], Tg0 [K], C1, dimensionless, and C2 [K].
    Returns viscosity eta0 [Pa s], shape (...). Raises InputError if the temperature is not above the glass
    transition.

    Sources of ``yasutomi``.

    Examples
    --------
    >>> oil = dict(yasutomi_glass_viscosity=1e12, yasutomi_glass_temperature=189.95, yasutomi_a1=188.86)
    >>> oil |= dict(yasutomi_a2=0.719e-9, yasutomi_b1=8.2e-9, yasutomi_b2=-0.5278)
    >>> oil |= dict(yasutomi_c1=16.09, yasutomi_c2=17.38)
    >>> round(float(yasutomi_viscosity(298.15, **oil)) * 1e3, 1)
    13.7
    """
    distance = _above_glass(temperature, yasutomi_glass_temperature) - yasutomi_glass_temperature
    exponent = -_LN_10 * yasutomi_c1 * distance / (yasutomi_c2 + distance)
    return np.asarray(yasutomi_glass_viscosity * np.exp(exponent))


def _above_glass(temperature: ArrayLike | None, glass: Numbers) -> Array:
    """Temperature [K] above the glass transition at zero pressure."""
    return within(temperature, _NAME, glass, math.inf, "its glass transition at ambient pressure")


def _holds(temperature: Array, *, yasutomi_glass_temperature: Numbers, **_others: Numbers) -> Mask:
    """Whether temperatures [K] are above the glass transition at zero pressure."""
    return np.asarray(temperature > yasutomi_glass_temperature)


def _warnings(
    max_pressure: float,
    viscosity: float,
    temperature: float | None = None,
    *,
    yasutomi_glass_viscosity: float,
    yasutomi_glass_temperature: float,
    yasutomi_a1: float,
    yasutomi_a2: float,
    **_others: float,
) -> Iterator[ResultWarning]:
    """Warning about a Hertz pressure at which the oil is a glass."""
    distance = float(_above_glass(temperature, yasutomi_glass_temperature)) - yasutomi_glass_temperature
    ratio = distance / yasutomi_a1
    cap = math.expm1(ratio) / yasutomi_a2 if ratio < 100.0 else math.inf
    yield from glass_warnings("yasutomi", max_pressure, cap, f"{yasutomi_glass_viscosity:.1g} Pa s")


YASUTOMI = Law(
    yasutomi,
    parameters_of(yasutomi),
    warnings=_warnings,
    needs_temperature=True,
    holds=_holds,
    atmospheric=yasutomi_viscosity,
)
