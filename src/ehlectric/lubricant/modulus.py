"""Modulus law of viscosity over pressure and temperature, after Dicke and Gold."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NoReturn

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array, Mask, Numbers
from ehlectric.errors import InputError
from ehlectric.lubricant.law import (
    LARGEST_EXPONENT,
    Law,
    glass_warnings,
    parameters_of,
    required,
)
from ehlectric.quantities.result_warnings import ResultWarning

_NAME = "viscosity_law 'modulus'"


def modulus(
    pressure: ArrayLike,
    temperature: ArrayLike | None = None,
    *,
    modulus_a1: Numbers,
    modulus_a2: Numbers,
    modulus_b1: Numbers,
    modulus_b2: Numbers,
) -> tuple[Array, Array]:
    """Logarithm of the relative viscosity after the modulus equation, and its derivative by pressure.

    ln(eta/eta0) = p/(A + B p) with A = a1 + a2 T and B = b1 + b2 T, with the viscosity eta0 at zero pressure.

    ``pressure`` [Pa], shape (...); ``temperature`` [K]; ``modulus_a1`` and ``modulus_a2``, constants a1 [Pa]
    and a2 [Pa/K], for temperatures in kelvin; ``modulus_b1`` and ``modulus_b2``, constants b1, dimensionless,
    and b2 [1/K], for temperatures in kelvin. Returns ln(eta/eta0), dimensionless, and its derivative by
    pressure [1/Pa], shape (...). Raises InputError if the temperature is missing, or A is not positive at it:
    viscosity would fall with pressure.

    Wingertszahn et al. (2023), doi:10.3390/lubricants11090369, table A1, with constants for a mineral oil.
    For B > 0 the exponent tends to 1/B at high pressure, and for B < 0 the law has a pole at p = -A/B. The
    exponent is held at 35, with a slope of zero, which is before a pole. An oil of 1 mPa s has 1.6e12 Pa s
    there.

    Examples
    --------
    >>> fva3 = dict(modulus_a1=-4.879e7, modulus_a2=2.9862e5, modulus_b1=-0.07784, modulus_b2=3.0115e-4)
    >>> exponent, slope = modulus([0.0, 1e9], 313.15, **fva3)
    >>> (exponent.round(2) + 0.0).tolist(), round(float(slope[0]) * 1e9, 1)
    ([0.0, 16.34], 22.4)
    """
    p = np.asarray(pressure, dtype=float)
    a, b = _constants(temperature, modulus_a1, modulus_a2, modulus_b1, modulus_b2)
    # p (1 - 35 B) = 35 A is the pressure of the cap.
    below = p * (1.0 - LARGEST_EXPONENT * b) < LARGEST_EXPONENT * a
    total = np.where(below, a + b * p, 1.0)
    return np.where(below, p / total, LARGEST_EXPONENT), np.where(below, a / total**2, 0.0)


def _constants(
    temperature: ArrayLike | None,
    modulus_a1: Numbers,
    modulus_a2: Numbers,
    modulus_b1: Numbers,
    modulus_b2: Numbers,
) -> tuple[Array, Array]:
    """A [Pa] and B at a temperature at which the viscosity rises with pressure."""
    at = required(temperature, _NAME)
    a = modulus_a1 + modulus_a2 * at
    wrong = a <= 0.0
    if wrong.any():
        values = (at, modulus_a1, modulus_a2)
        _refuse(*(float(np.broadcast_to(value, np.shape(a))[wrong].flat[0]) for value in values))
    return a, modulus_b1 + modulus_b2 * at


def _refuse(temperature: float, a1: float, a2: float) -> NoReturn:
    """Raise the error of a temperature [K] at which A is not positive."""
    if a2 == 0.0:
        raise InputError("modulus_a1", got=f"{a1:g} Pa", takes="above 0 Pa where modulus_a2 is 0 Pa/K")
    end, word = -a1 / a2, "above" if a2 > 0.0 else "below"
    raise InputError(
        "temperature",
        got=f"{temperature:.5g} K;",
        takes=f"{word} {end:.5g} K, the range of {_NAME}: the viscosity does not rise with pressure outside "
        "it",
    )


def _holds(temperature: Array, *, modulus_a1: Numbers, modulus_a2: Numbers, **_others: Numbers) -> Mask:
    """Whether the viscosity rises with pressure at temperatures [K]."""
    return np.asarray(modulus_a1 + modulus_a2 * temperature > 0.0)


def _warnings(
    max_pressure: float, viscosity: float, temperature: float | None = None, **parameters: float
) -> Iterator[ResultWarning]:
    """Warning about a Hertz pressure above the cap of the law."""
    a, b = _constants(temperature, **parameters)
    share = 1.0 - LARGEST_EXPONENT * float(b)
    cap = LARGEST_EXPONENT * float(a) / share if share > 0.0 else math.inf
    limit = f"{math.exp(LARGEST_EXPONENT) * viscosity:.1g} Pa s"
    yield from glass_warnings("modulus", max_pressure, cap, limit)


MODULUS = Law(
    modulus,
    parameters_of(modulus),
    warnings=_warnings,
    needs_temperature=True,
    holds=_holds,
)
