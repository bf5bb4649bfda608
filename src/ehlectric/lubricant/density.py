"""Density laws of the lubricant, and equations of state over pressure and temperature: Tait and Murnaghan."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypedDict

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array, Numbers
from ehlectric.lubricant.law import Law, parameters_of, required
from ehlectric.quantities.result_warnings import ResultWarning

# Smallest volume divided by the volume at zero pressure. The volume of Tait's equation vanishes at a finite
# pressure, and no contact compresses a liquid to its half.
LEAST_VOLUME = 0.5


class TaitState(TypedDict):
    """Parameters of ``tait``, which laws take that follow its volume."""

    tait_k0_prime: Numbers
    tait_k00: Numbers
    tait_beta_k: Numbers
    tait_expansion: Numbers
    reference_temperature: Numbers


def tait(
    pressure: ArrayLike,
    temperature: ArrayLike | None = None,
    *,
    tait_k0_prime: Numbers,
    tait_k00: Numbers,
    tait_beta_k: Numbers,
    tait_expansion: Numbers,
    reference_temperature: Numbers,
) -> tuple[Array, Array]:
    """Density ratio after Tait's equation of state, and its derivative by pressure.

    V/V0 = 1 - ln(1 + p (1 + K0')/K0)/(1 + K0') with the bulk modulus K0 = K00 exp(-beta_K T) at p = 0.

    ``pressure`` [Pa], shape (...); ``temperature`` [K]; ``tait_k0_prime``, pressure derivative K0' of the
    bulk modulus at zero pressure, dimensionless; ``tait_k00``, bulk modulus K00 at zero pressure,
    extrapolated to zero temperature [Pa]; ``tait_beta_k``, temperature coefficient beta_K of the bulk modulus
    [1/K]; ``tait_expansion`` and ``reference_temperature``, thermal expansion a_V [1/K] of the volume at zero
    pressure and its temperature [K]. Returns density divided by the density at zero pressure and this
    temperature, dimensionless, and its derivative by pressure [1/Pa], shape (...). Raises InputError if the
    temperature is missing.

    The form of S. Bair, High-Pressure Rheology for Quantitative Elastohydrodynamics, Elsevier, 2007, as later
    works quote it, after P. G. Tait. The volume is held at half of the volume at zero pressure, with a slope
    of zero, because the equation gives no volume at all at a finite pressure. Oils reach the half at tens of
    gigapascals.

    Examples
    --------
    >>> oil = dict(tait_k0_prime=10.545, tait_k00=9.234e9, tait_beta_k=6.09e-3)
    >>> oil |= dict(tait_expansion=7.734e-4, reference_temperature=298.15)
    >>> ratio, slope = tait([0.0, 1e9, 2e9], 298.15, **oil)
    >>> ratio.round(3).tolist(), round(1e-9 / float(slope[0]), 2)
    ([1.0, 1.23, 1.319], 1.5)
    """
    p, modulus = np.asarray(pressure, dtype=float), tait_modulus(temperature, tait_k00, tait_beta_k)
    steepness = 1.0 + tait_k0_prime
    volume = 1.0 - np.log1p(p * steepness / modulus) / steepness
    liquid = volume > LEAST_VOLUME
    volume = np.maximum(volume, LEAST_VOLUME)
    return 1.0 / volume, np.where(liquid, 1.0 / ((modulus + p * steepness) * volume**2), 0.0)


def tait_modulus(temperature: ArrayLike | None, k00: Numbers, beta_k: Numbers, law: str = "tait") -> Array:
    """Bulk modulus at zero pressure, K0 = K00 exp(-beta_K T), in Pa. ``temperature`` [K], shape (...);
    ``k00`` and ``beta_k``, constants K00 [Pa] and beta_K [1/K].

    Examples
    --------
    >>> round(float(tait_modulus(298.15, 9.234e9, 6.09e-3)) / 1e9, 3)
    1.503
    """
    return np.asarray(k00 * np.exp(-beta_k * required(temperature, f"density_law {law!r}")))


def tait_pressure(
    density_ratio: ArrayLike,
    temperature: ArrayLike | None = None,
    *,
    tait_k0_prime: Numbers,
    tait_k00: Numbers,
    tait_beta_k: Numbers,
    tait_expansion: Numbers,
    reference_temperature: Numbers,
) -> Array:
    """Pressure [Pa] at which Tait's equation has a density ratio; the inverse of ``tait``. ``density_ratio``,
    density divided by the density at zero pressure and this temperature, dimensionless, from 1 to 2, shape
    (...); ``temperature`` [K].

    Examples
    --------
    >>> oil = dict(tait_k0_prime=10.545, tait_k00=9.234e9, tait_beta_k=6.09e-3)
    >>> oil |= dict(tait_expansion=7.734e-4, reference_temperature=298.15)
    >>> round(float(tait_pressure(1.2303, 298.15, **oil)) / 1e9, 2)
    1.0
    """
    modulus, steepness = tait_modulus(temperature, tait_k00, tait_beta_k), 1.0 + tait_k0_prime
    volume = 1.0 / np.asarray(density_ratio, dtype=float)
    return np.asarray(modulus * np.expm1(steepness * (1.0 - volume)) / steepness)


def _tait_warnings(
    max_pressure: float, viscosity: float, temperature: float | None = None, **parameters: float
) -> Iterator[ResultWarning]:
    """Warning about a Hertz pressure at which the volume of the law is held."""
    cap = float(tait_pressure(1.0 / LEAST_VOLUME, temperature, **parameters))
    if max_pressure > cap:
        yield ResultWarning.of("law-range", "tait", cap=cap / 1e9)


def murnaghan(
    pressure: ArrayLike,
    temperature: ArrayLike | None = None,
    *,
    murnaghan_k0_prime: Numbers,
    murnaghan_k00: Numbers,
    murnaghan_beta_k: Numbers,
    murnaghan_expansion: Numbers,
    reference_temperature: Numbers,
) -> tuple[Array, Array]:
    """Density ratio after Murnaghan's equation of state, and its derivative by pressure.

    V/V0 = (1 + K0' p/K0)^(-1/K0') with the bulk modulus K0 = K00 exp(-beta_K T) at zero pressure.

    ``pressure`` [Pa], shape (...); ``temperature`` [K]; ``murnaghan_k0_prime``, pressure derivative K0' of
    the bulk modulus, dimensionless; ``murnaghan_k00``, bulk modulus K00 at zero pressure, extrapolated to
    zero temperature [Pa]; ``murnaghan_beta_k``, temperature coefficient beta_K of the bulk modulus [1/K];
    ``murnaghan_expansion`` and ``reference_temperature``, thermal expansion a_V [1/K] of the volume at zero
    pressure and its temperature [K]. Returns density divided by the density at zero pressure and this
    temperature, dimensionless, and its derivative by pressure [1/Pa], shape (...). Raises InputError if the
    temperature is missing.

    F. D. Murnaghan, The compressibility of media under extreme pressures, Proc. Natl. Acad. Sci. 30 (1944)
    244, doi:10.1073/pnas.30.9.244: the bulk modulus rises linearly with pressure. The law has no pole.

    Examples
    --------
    >>> oil = dict(murnaghan_k0_prime=10.545, murnaghan_k00=9.234e9, murnaghan_beta_k=6.09e-3)
    >>> oil |= dict(murnaghan_expansion=7.734e-4, reference_temperature=298.15)
    >>> murnaghan([0.0, 1e9, 2e9], 298.15, **oil)[0].round(3).tolist()
    [1.0, 1.218, 1.293]
    """
    p = np.asarray(pressure, dtype=float)
    modulus = tait_modulus(temperature, murnaghan_k00, murnaghan_beta_k, "murnaghan")
    ratio = np.exp(np.log1p(murnaghan_k0_prime * p / modulus) / murnaghan_k0_prime)
    return ratio, ratio / (modulus + murnaghan_k0_prime * p)


TAIT = Law(
    tait,
    parameters_of(tait),
    warnings=_tait_warnings,
    needs_temperature=True,
    thermal_expansion="tait_expansion",
)
MURNAGHAN = Law(
    murnaghan,
    parameters_of(murnaghan),
    needs_temperature=True,
    thermal_expansion="murnaghan_expansion",
)


def dowson_higginson(
    pressure: ArrayLike, temperature: ArrayLike | None = None, *, density_c1: Numbers, density_c2: Numbers
) -> tuple[Array, Array]:
    """Density ratio after Dowson and Higginson, and its derivative by pressure.

    rho/rho0 = (C1 + C2 p)/(C1 + p), with the density rho0 at zero pressure.

    ``pressure`` [Pa], shape (...); ``temperature`` [K]; ``density_c1`` [Pa]; ``density_c2``, constant C2, the
    density ratio at infinite pressure, dimensionless. Returns density ratio rho/rho0, dimensionless, and its
    derivative by pressure [1/Pa], shape (...).

    Eq. (12) of Morris et al. (2022), doi:10.3390/lubricants10050087.

    Examples
    --------
    >>> round(float(dowson_higginson(1e9, density_c1=0.59e9, density_c2=1.34)[0]), 4)
    1.2138
    """
    p = np.asarray(pressure, dtype=float)
    total = density_c1 + p
    return (density_c1 + density_c2 * p) / total, (density_c2 - 1.0) * density_c1 / total**2


def incompressible(pressure: ArrayLike, temperature: ArrayLike | None = None) -> tuple[Array, Array]:
    """Density ratio of an incompressible lubricant, which is one, and its derivative by pressure [1/Pa],
    which is zero, at pressures [Pa] of shape (...).

    Examples
    --------
    >>> float(incompressible(1e9)[0])
    1.0
    """
    p = np.asarray(pressure, dtype=float)
    return np.ones_like(p), np.zeros_like(p)


DENSITY_LAWS = {
    "dowson-higginson": Law(dowson_higginson, parameters_of(dowson_higginson)),
    "incompressible": Law(incompressible),
    "tait": TAIT,
    "murnaghan": MURNAGHAN,
}
