"""Pressure-viscosity coefficient of the atlas, and the two weak groups of an oil's laws."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from ehlectric.lubricant.alpha import reciprocal_asymptotic_alpha
from ehlectric.lubricant.density import dowson_higginson
from ehlectric.lubricant.law import PressureLaw
from ehlectric.lubricant.viscosity import roelands

# Pressure at which the integral of the coefficient ends, over 1/alpha*, as in Bair's film coefficient.
_END = 3.0

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(8)
_ENDS = np.linspace(0.0, _END, 17)


@dataclass(frozen=True)
class OilGroups:
    """Coefficient and weak groups of an oil, from its laws of viscosity and density over pressure.

    Attributes
    ----------
    alpha : float
        Pressure-viscosity coefficient of the atlas [1/Pa].
    shape : float
        ln(alpha/alpha*), which grows with the curvature of the viscosity law, dimensionless.
    compressibility : float
        Slope of the density ratio at zero pressure over alpha, dimensionless.
    """

    alpha: float
    shape: float
    compressibility: float

    @classmethod
    def of(cls, viscosity: PressureLaw, density: PressureLaw) -> OilGroups:
        """Groups of an oil from ln(eta/eta0) and rho/rho0 over pressure [Pa]."""
        alpha = film_coefficient(viscosity, density)
        slope = float(np.ravel(density(np.zeros(1))[1])[0])
        return cls(alpha, math.log(alpha / reciprocal_asymptotic_alpha(viscosity)), slope / alpha)


def film_coefficient(viscosity: PressureLaw, density: PressureLaw) -> float:
    """Pressure-viscosity coefficient of the atlas: Bair's film coefficient of eta rho^2, in 1/Pa.

    alpha_m = (1 - e^-3)/Int_0^(3/alpha*) (eta(0)/eta(p)) (rho(0)/rho(p))^2 dp

    Parameters
    ----------
    viscosity : callable
        ln(eta/eta0) and its derivative by pressure [1/Pa], as a function of the pressure [Pa].
    density : callable
        rho/rho0 and its derivative by pressure [1/Pa], as a function of the pressure [Pa].

    Returns
    -------
    float
        Coefficient [1/Pa]; alpha for an incompressible oil of Barus' law.

    Notes
    -----
    With the mass per area m = rho h, the Reynolds equation of the inlet is
    dp/dx = 12 u eta rho^2 (m - m0)/m^3. The density therefore acts as a factor rho^2 of the viscosity.

    Examples
    --------
    >>> from ehlectric.lubricant.density import incompressible
    >>> from ehlectric.lubricant.viscosity import barus
    >>> law = lambda p: barus(p, pressure_viscosity_coefficient=2e-8)
    >>> round(film_coefficient(law, incompressible) * 1e9, 6)
    20.0
    """
    ends = _ENDS / reciprocal_asymptotic_alpha(viscosity)
    middle, half = 0.5 * (ends[1:] + ends[:-1]), 0.5 * np.diff(ends)
    pressure = (middle[:, np.newaxis] + half[:, np.newaxis] * _NODES).ravel()
    integrand = np.exp(-np.asarray(viscosity(pressure)[0])) / np.asarray(density(pressure)[0]) ** 2
    integral = float(half @ (np.reshape(integrand, (half.size, -1)) @ _WEIGHTS))
    return -math.expm1(-_END) / integral


# Oil of the atlas: Roelands' law and the density of Dowson and Higginson, with typical parameters. The films
# of other oils are corrected by their weak groups.
REFERENCE: dict[str, dict[str, float]] = {
    "viscosity": {"pressure_viscosity_coefficient": 20e-9, "roelands_z": 0.67, "roelands_pressure": 0.2e9},
    "density": {"density_c1": 0.59e9, "density_c2": 1.34},
}


def reference_laws() -> tuple[Callable[..., Any], Callable[..., Any]]:
    """Viscosity and density laws of the oil with which the atlas is computed."""
    return (
        partial(roelands, **REFERENCE["viscosity"]),
        partial(dowson_higginson, **REFERENCE["density"]),
    )
