"""Viscosity over pressure and temperature from the free volume, after Doolittle, with Tait's volume."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Unpack

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array, Mask, Numbers
from ehlectric.errors import InputError
from ehlectric.lubricant.density import LEAST_VOLUME, TaitState, tait, tait_pressure
from ehlectric.lubricant.law import (
    GLASS_VISCOSITY,
    Law,
    glass_warnings,
    is_many,
    parameters_of,
    required,
    within,
)
from ehlectric.quantities.result_warnings import ResultWarning

_NAME = "viscosity_law 'doolittle'"


def doolittle(
    pressure: ArrayLike,
    temperature: ArrayLike | None = None,
    *,
    doolittle_viscosity: Numbers,
    doolittle_b: Numbers,
    doolittle_r0: Numbers,
    doolittle_epsilon: Numbers,
    **state: Unpack[TaitState],
) -> tuple[Array, Array]:
    """Logarithm of the relative viscosity after Doolittle's free-volume law, and its derivative by pressure.

    eta = eta_R exp(B R0 (w/(v - R0 w) - 1/(1 - R0))), with the volume v = V/V_R of Tait's equation and the
    occupied volume w = 1 + epsilon (T - T_R), both over their values at the reference temperature T_R.

    ``pressure`` [Pa], shape (...); ``temperature`` [K]; ``doolittle_viscosity``, viscosity eta_R at zero
    pressure and the reference temperature [Pa s]; ``doolittle_b``, doolittle's constant B, dimensionless;
    ``doolittle_r0``, occupied volume over the volume at zero pressure and the reference temperature, R0,
    dimensionless; ``doolittle_epsilon``, thermal expansion epsilon of the occupied volume [1/K];
    ``**state``, parameters of ``tait``, with the thermal expansion a_V of the volume at zero pressure [1/K],
    V/V_R = (1 + a_V (T - T_R)) V/V0, and the reference temperature T_R [K]. Returns ln(eta/eta0),
    dimensionless, with the viscosity eta0 of ``doolittle_ambient``, and its derivative by pressure [1/Pa],
    shape (...). Raises InputError if the temperature is missing, or the oil is a glass at it and at zero
    pressure.

    A. K. Doolittle, J. Appl. Phys. 22 (1951) 1471, doi:10.1063/1.1699894, in the form of S. Bair,
    High-Pressure Rheology for Quantitative Elastohydrodynamics, Elsevier, 2007, as later works quote it. The
    law has a pole where the free volume v - R0 w vanishes. The viscosity is held at 1e12 Pa s, with a slope
    of zero, which is before the pole.

    Examples
    --------
    >>> oil = dict(doolittle_viscosity=0.0348, doolittle_b=4.336, doolittle_r0=0.6988)
    >>> oil |= dict(doolittle_epsilon=-7.679e-4, tait_k0_prime=10.4, tait_k00=9e9, tait_beta_k=6e-3)
    >>> oil |= dict(tait_expansion=8e-4, reference_temperature=323.15)
    >>> exponent, slope = doolittle([0.0, 0.5e9, 3e9], 323.15, **oil)
    >>> exponent.round(2).tolist(), round(float(slope[0]) * 1e9, 1)
    ([0.0, 9.71, 30.99], 25.8)
    """
    oil = _Doolittle(doolittle_viscosity, doolittle_b, doolittle_r0, doolittle_epsilon, **state)
    warmer = oil.warmer(temperature)
    density, density_slope = tait(pressure, temperature, **state)
    occupied, ambient = oil.occupied(warmer), oil.expanded(warmer)
    volume = ambient / density
    limit = oil.least_free(occupied)
    free = volume - doolittle_r0 * occupied
    liquid = free > limit
    free = np.maximum(free, limit)
    free_ambient = ambient - doolittle_r0 * occupied
    factor = doolittle_b * doolittle_r0 * occupied
    # w/free - w/free0, without cancellation.
    exponent = factor * (free_ambient - free) / (free * free_ambient)
    return exponent, np.where(liquid, factor * volume / density * density_slope / free**2, 0.0)


class _Doolittle:
    """Volumes of Doolittle's law over the difference to the reference temperature."""

    def __init__(
        self,
        doolittle_viscosity: Numbers,
        doolittle_b: Numbers,
        doolittle_r0: Numbers,
        doolittle_epsilon: Numbers,
        **state: Unpack[TaitState],
    ) -> None:
        self.viscosity, self.epsilon = doolittle_viscosity, doolittle_epsilon
        self.b, self.r0, self.state = doolittle_b, doolittle_r0, state
        self.expansion, self.reference = state["tait_expansion"], state["reference_temperature"]

    def occupied(self, warmer: Numbers) -> Numbers:
        """Occupied volume w."""
        return 1.0 + self.epsilon * warmer

    def expanded(self, warmer: Numbers) -> Numbers:
        """Volume v at zero pressure."""
        return 1.0 + self.expansion * warmer

    def free(self, warmer: Numbers) -> Numbers:
        """Free volume v - R0 w at zero pressure."""
        return self.expanded(warmer) - self.r0 * self.occupied(warmer)

    def share(self) -> Numbers:
        """Occupied over free volume, w/(v - R0 w), at the glass transition."""
        exponent = np.log(GLASS_VISCOSITY / self.viscosity)
        return exponent / (self.b * self.r0) + 1.0 / (1.0 - self.r0)

    def least_free(self, occupied: Numbers) -> Numbers:
        """Free volume v - R0 w at the glass transition."""
        return occupied / self.share()

    def glass(self) -> Numbers:
        """Temperature of the glass transition at zero pressure [K]."""
        share, slope = self.share(), self.expansion - self.r0 * self.epsilon
        return self.reference + (share * (1.0 - self.r0) - 1.0) / (self.epsilon - share * slope)

    def warmer(self, temperature: ArrayLike | None) -> Numbers:
        """Difference of a temperature to the reference temperature [K], where the oil is a liquid."""
        at = required(temperature, _NAME)
        falls = np.asarray(self.expansion > self.epsilon)
        if not falls.all() and (wrong := np.asarray(~(falls | np.isnan(at)))).any():
            values = (self.epsilon, self.expansion)
            epsilon, expansion = (np.broadcast_to(value, wrong.shape)[wrong][0] for value in values)
            raise InputError(
                "doolittle_epsilon",
                got=f"{epsilon:g} 1/K",
                takes=f"less than tait_expansion, {expansion:g} 1/K: viscosity falls with temperature",
            )
        reason = "its glass transition at ambient pressure, and an occupied volume"
        return within(at, _NAME, self.glass(), self.most(), reason) - self.reference

    def most(self) -> Numbers:
        """Temperature at which no occupied volume is left [K]; infinite where it does not shrink."""
        if not is_many(self.epsilon):
            return self.reference - 1.0 / self.epsilon if self.epsilon < 0.0 else math.inf
        shrinks = np.less(self.epsilon, 0.0)
        return np.where(shrinks, self.reference - 1.0 / np.where(shrinks, self.epsilon, 1.0), math.inf)


def doolittle_ambient(
    temperature: ArrayLike,
    *,
    doolittle_viscosity: Numbers,
    doolittle_b: Numbers,
    doolittle_r0: Numbers,
    doolittle_epsilon: Numbers,
    **state: Unpack[TaitState],
) -> Array:
    """Viscosity at zero pressure after Doolittle's free-volume law.

    eta0 = eta_R exp(B R0 (w/(1 + a_V (T - T_R) - R0 w) - 1/(1 - R0))) with w = 1 + epsilon (T - T_R).

    ``temperature`` [K], shape (...); ``doolittle_viscosity``, ``doolittle_b``, ``doolittle_r0`` and
    ``doolittle_epsilon``, constants eta_R [Pa s], B, R0, dimensionless, and epsilon [1/K]; ``**state``,
    parameters of ``tait``, with the thermal expansion a_V [1/K] and the reference temperature T_R [K].
    Returns viscosity eta0 [Pa s], shape (...). Raises InputError if the oil is a glass at the temperature.

    Sources of ``doolittle``.

    Examples
    --------
    >>> oil = dict(doolittle_viscosity=0.0348, doolittle_b=4.336, doolittle_r0=0.6988)
    >>> oil |= dict(doolittle_epsilon=-7.679e-4, tait_k0_prime=10.4, tait_k00=9e9, tait_beta_k=6e-3)
    >>> oil |= dict(tait_expansion=8e-4, reference_temperature=323.15)
    >>> doolittle_ambient([323.15, 353.15], **oil).round(4).tolist()
    [0.0348, 0.0087]
    """
    oil = _Doolittle(doolittle_viscosity, doolittle_b, doolittle_r0, doolittle_epsilon, **state)
    warmer = oil.warmer(temperature)
    share = oil.occupied(warmer) / oil.free(warmer)
    return np.asarray(
        doolittle_viscosity * np.exp(doolittle_b * doolittle_r0 * (share - 1.0 / (1.0 - doolittle_r0)))
    )


def _holds(temperature: Array, **parameters: Numbers) -> Mask:
    """Whether a liquid at the temperatures [K] has an occupied volume."""
    oil = _Doolittle(**parameters)
    falls = np.greater(oil.expansion, oil.epsilon)
    return np.asarray(falls & (temperature > oil.glass()) & (temperature < oil.most()))


def _warnings(
    max_pressure: float, viscosity: float, temperature: float | None = None, **parameters: float
) -> Iterator[ResultWarning]:
    """Warning about a Hertz pressure at which the oil is a glass."""
    oil = _Doolittle(**parameters)
    warmer = oil.warmer(temperature)
    occupied = oil.occupied(warmer)
    volume = float((oil.r0 * occupied + oil.least_free(occupied)) / oil.expanded(warmer))
    cap = float(tait_pressure(1.0 / volume, temperature, **oil.state)) if volume > LEAST_VOLUME else math.inf
    yield from glass_warnings("doolittle", max_pressure, cap, f"{GLASS_VISCOSITY:g} Pa s")


DOOLITTLE = Law(
    doolittle,
    parameters_of(doolittle, tait),
    warnings=_warnings,
    needs_temperature=True,
    holds=_holds,
    atmospheric=doolittle_ambient,
)
