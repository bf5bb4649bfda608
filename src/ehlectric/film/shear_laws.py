"""Shear-thinning laws of oils: shear rate over shear stress.

All laws have the form

    gamma_dot = (tau/mu) f((tau/tau_s)^2)

with the low-shear viscosity mu, a characteristic stress tau_s of the law and a rate factor f with f(0) = 1.
In terms of stress the laws are explicit, so that the shear rate at a known stress needs no iteration. A law
is one entry of ``RHEOLOGY``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TypeAlias

import numpy as np

from ehlectric.arrays import Array

# Constants of a law by name, in SI units.
Constants: TypeAlias = Mapping[str, float]

# Largest stress over the Eyring stress whose hyperbolic sine is computed; larger ones would overflow. No
# film reaches it; iterates may.
_LARGEST = 300.0

# Square of the reduced stress below which f of the Eyring law is computed by its series from there, as the
# difference cosh(r) - sinh(r)/r loses digits: f is exact to rounding, and its derivative to 1e-11.
_SMALL = 1e-4

# Exponent of the smooth transition to the limiting stress, a common choice between 1 (soft) and infinity.
_SHARPNESS = 5.0

# Pressure p_f [Pa] that keeps the limiting stress above zero at ambient pressure,
# tau_L = Lambda sqrt(p^2 + p_f^2). Measured limiting stresses extrapolate to some MPa at zero pressure, and
# Lambda p_f is as large.
LIMIT_FLOOR = 5e7


@dataclass(frozen=True)
class Rheology:
    """Shear-thinning law of an oil with its constants. Raises ValueError if there is no law of this name, or
    its constants are others.

    Examples
    --------
    >>> oil = Rheology("eyring", {"eyring_stress": 5e6})
    >>> oil.law.scale(np.array([1e9]), oil.constants)[0]
    array([5000000.])
    """

    name: str = "newtonian"
    # Constants of the law in SI units; ``RHEOLOGY[name].constants`` are their names.
    constants: Constants = field(default_factory=dict)

    def __post_init__(self) -> None:
        if self.name not in RHEOLOGY:
            raise ValueError(f"{self.name!r} is no shear-thinning law; expected one of {', '.join(RHEOLOGY)}")
        needed = RHEOLOGY[self.name].constants
        if set(self.constants) != set(needed):
            raise ValueError(
                f"the {self.name} law takes the constants {', '.join(needed) or 'none'}, "
                f"not {', '.join(self.constants) or 'none'}"
            )

    @property
    def law(self) -> ShearLaw:
        """Law of this name."""
        return RHEOLOGY[self.name]


@dataclass(frozen=True)
class ShearLaw:
    """Law of shear thinning, over the reduced stress r = tau/tau_s."""

    constants: tuple[str, ...]
    # (r^2, constants) -> (f, its derivative by r^2).
    factor: Callable[[Array, Constants], tuple[Array, Array]]
    # (pressure [Pa], constants) -> (characteristic stress tau_s [Pa], its derivative by pressure).
    scale: Callable[[Array, Constants], tuple[Array, Array]]
    # (reduced rate x = mu gamma_dot/tau_s >= 0, constants) -> (reduced stress, its derivative by x). The
    # inverse of the law, or a close upper bound of it.
    stress: Callable[[Array, Constants], tuple[Array, Array]]
    # Whether the rate factor belongs to the mean stress and is uniform across the film (``even``).
    even: bool = False
    # Stress difference across a column over tau_s below which 12 Gauss points give its flux: exact to 1e-8
    # for the Eyring law, whose factor is a power series, and to 1e-7 for Carreau's law.
    reach: float = 2.0


def newtonian_factor(squared: Array, _constants: Constants) -> tuple[Array, Array]:
    """Rate factor of a Newtonian fluid: one; no film needs it, as the law is even."""
    return np.ones_like(squared), np.zeros_like(squared)


def eyring_factor(squared: Array, _constants: Constants) -> tuple[Array, Array]:
    """Rate factor sinh(r)/r of the Ree-Eyring law, gamma_dot = (tau_0/mu) sinh(tau/tau_0). ``squared``,
    square of the reduced stress r = tau/tau_0, shape (...). Returns sinh(r)/r and its derivative by r^2,
    shape (...).

    T. Ree and H. Eyring, J. Appl. Phys. 26 (1955) 793; K. L. Johnson and J. L. Tevaarwerk, Proc. R. Soc.
    A 356 (1977) 215, doi:10.1098/rspa.1977.0129.

    Examples
    --------
    >>> factor, _ = eyring_factor(np.array([0.0, 4.0]), {})
    >>> bool(np.allclose(factor, [1.0, np.sinh(2.0) / 2.0]))
    True
    """
    large = np.maximum(squared, _SMALL)
    r = np.minimum(np.sqrt(large), _LARGEST)
    up = np.exp(r)
    down = 1.0 / up
    factor = up - down
    factor /= r
    factor *= 0.5
    # In place, as films spend much of their time here: slope = (cosh(r) - factor)/(2 r^2).
    slope = np.add(up, down, out=down)
    slope *= 0.5
    slope -= factor
    slope /= large
    slope *= 0.5
    below = large - squared
    if below.any():
        factor -= below * (1.0 / 6.0 + (large + squared) / 120.0)
        slope -= below / 60.0
    return factor, slope


def carreau_factor(squared: Array, constants: Constants) -> tuple[Array, Array]:
    """Rate factor (1 + r^2)^((1/n - 1)/2) of Carreau's law in stress, r = tau/G. ``squared``, square of the
    reduced stress, shape (...); ``constants``, ``carreau_exponent`` n, 0 < n <= 1. Returns rate factor and
    its derivative by r^2, shape (...).

    The form of S. Bair, High Pressure Rheology for Quantitative Elastohydrodynamics, 2nd ed., Elsevier 2019.
    """
    exponent = 0.5 * (1.0 / constants["carreau_exponent"] - 1.0)
    base = 1.0 + squared
    factor = base**exponent
    return factor, exponent * factor / base


def limiting_factor(squared: Array, _constants: Constants) -> tuple[Array, Array]:
    """Rate factor (1 - r^5)^(-1/5) of a Newtonian fluid below a limiting shear stress, r = tau/tau_L < 1.

    The law is even: films take its ``stress``, and the factor is a check of that.
    """
    m = _SHARPNESS
    r = np.sqrt(squared)
    left = 1.0 - r**m
    factor = left ** (-1.0 / m)
    return factor, 0.5 * r ** (m - 2.0) * factor / left


def _unit_scale(pressure: Array, _constants: Constants) -> tuple[Array, Array]:
    return np.ones_like(pressure), np.zeros_like(pressure)


def _constant_scale(name: str) -> Callable[[Array, Constants], tuple[Array, Array]]:
    def scale(pressure: Array, constants: Constants) -> tuple[Array, Array]:
        return np.full_like(pressure, constants[name]), np.zeros_like(pressure)

    return scale


def limiting_stress(pressure: Array, constants: Constants) -> tuple[Array, Array]:
    """Limiting shear stress tau_L = Lambda sqrt(p^2 + p_f^2), p_f = 50 MPa, and its derivative by pressure.
    ``pressure`` [Pa], shape (...); ``constants``, ``limiting_coefficient`` Lambda, dimensionless. Returns
    limiting stress [Pa] and its derivative, dimensionless, shape (...).

    S. Bair and W. O. Winer, J. Lubr. Technol. 101 (1979) 258: Lambda p. The floor p_f matters below some
    100 MPa only: at 0.5 GPa it adds 0.5 %.

    Examples
    --------
    >>> stress, _ = limiting_stress(np.array([1e9]), {"limiting_coefficient": 0.05})
    >>> round(float(stress[0]) / 1e6, 2)
    50.06
    """
    coefficient = constants["limiting_coefficient"]
    hypotenuse = np.hypot(pressure, LIMIT_FLOOR)
    return coefficient * hypotenuse, coefficient * pressure / hypotenuse


def _newtonian_stress(rate: Array, _constants: Constants) -> tuple[Array, Array]:
    return rate, np.ones_like(rate)


def _eyring_stress(rate: Array, _constants: Constants) -> tuple[Array, Array]:
    return np.arcsinh(rate), 1.0 / np.hypot(1.0, rate)


def _carreau_stress(rate: Array, constants: Constants) -> tuple[Array, Array]:
    """Stress of Carreau's law in rate, r = x (1 + x^2)^((n-1)/2), at least the stress of the other law."""
    n = constants["carreau_exponent"]
    base = np.hypot(1.0, rate)
    return rate * base ** (n - 1.0), base ** (n - 3.0) * (1.0 + n * rate**2)


def _limiting_stress(rate: Array, _constants: Constants) -> tuple[Array, Array]:
    """Stress of the limiting law, r = x/(1 + x^5)^(1/5), in powers of the smaller of x and 1/x."""
    m = _SHARPNESS
    inverse = 1.0 / np.maximum(rate, 1.0)
    low = np.minimum(rate, 1.0)
    base = 1.0 + np.minimum(low, inverse) ** m
    stress = np.where(rate > 1.0, base ** (-1.0 / m), low * base ** (-1.0 / m))
    slope = base ** (-1.0 / m - 1.0) * np.where(rate > 1.0, inverse ** (m + 1.0), 1.0)
    return stress, slope


# Laws whose shear stress grows with pressure as a power of the viscosity. The shear stress of oils does not.
UNBOUNDED = ("newtonian", "carreau")

# Shear-thinning laws by name.
RHEOLOGY: Mapping[str, ShearLaw] = {
    "newtonian": ShearLaw((), newtonian_factor, _unit_scale, _newtonian_stress, even=True),
    "eyring": ShearLaw(
        ("eyring_stress",),
        eyring_factor,
        _constant_scale("eyring_stress"),
        _eyring_stress,
        reach=16.0,
    ),
    "carreau": ShearLaw(
        ("carreau_stress", "carreau_exponent"),
        carreau_factor,
        _constant_scale("carreau_stress"),
        _carreau_stress,
    ),
    "limiting": ShearLaw(
        ("limiting_coefficient",), limiting_factor, limiting_stress, _limiting_stress, even=True
    ),
}
