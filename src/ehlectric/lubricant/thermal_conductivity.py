"""Thermal conductivity of an oil over pressure and temperature."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array
from ehlectric.errors import InputError, ResultWarning
from ehlectric.lubricant.equation_of_state import TAIT
from ehlectric.lubricant.law import Law, Parameter, required
from ehlectric.lubricant.thermal import beyond_larsson, larsson_constant, number, volume


def constant_thermal_conductivity(
    pressure: ArrayLike, temperature: ArrayLike | None = None, *, thermal_conductivity: float
) -> tuple[Array, Array]:
    """Thermal conductivity that changes neither with pressure nor with temperature.

    Parameters
    ----------
    pressure : array_like, shape (...)
        Pressure [Pa]. The law uses only its shape.
    temperature : array_like, optional
        Temperature [K]. The law ignores it.
    thermal_conductivity : float
        Thermal conductivity k [W/(m K)].

    Returns
    -------
    conductivity, slope : ndarray, shape (...)
        Thermal conductivity [W/(m K)], and its derivative by pressure, which is zero.

    Examples
    --------
    >>> float(constant_thermal_conductivity(1e9, thermal_conductivity=0.134)[0])
    0.134
    """
    p = np.asarray(pressure, dtype=float)
    return np.full_like(p, thermal_conductivity), np.zeros_like(p)


def larsson_thermal_conductivity(
    pressure: ArrayLike,
    temperature: ArrayLike | None = None,
    *,
    thermal_conductivity: float,
    larsson_c1: float,
    larsson_c2: float,
) -> tuple[Array, Array]:
    """Thermal conductivity after Larsson et al., k = k0 (1 + c1 p/(1 + c2 p)), and its derivative.

    Parameters
    ----------
    pressure : array_like, shape (...)
        Pressure p [Pa], >= 0.
    temperature : array_like, optional
        Temperature [K]. The law ignores it.
    thermal_conductivity : float
        Thermal conductivity k0 at zero pressure [W/(m K)].
    larsson_c1, larsson_c2 : float
        Constants c1 and c2 [1/Pa].

    Returns
    -------
    conductivity, slope : ndarray, shape (...)
        Thermal conductivity k [W/(m K)], and its derivative by pressure [W/(m K Pa)].

    Notes
    -----
    R. Larsson, P. O. Larsson, E. Eriksson, M. Sjoberg and E. Hoglund, Lubricant properties for input to
    hydrodynamic and elastohydrodynamic lubrication analyses, Proc. IMechE J 214 (2000) 17, as later programs
    quote it. The measurements go up to 1.1 GPa and 107 degC.

    Examples
    --------
    >>> pao = dict(thermal_conductivity=0.154, larsson_c1=1.40e-9, larsson_c2=0.34e-9)
    >>> larsson_thermal_conductivity([0.0, 0.5e9, 1e9], **pao)[0].round(3).tolist()
    [0.154, 0.246, 0.315]
    """
    p = np.asarray(pressure, dtype=float)
    return (
        thermal_conductivity * (1.0 + larsson_c1 * p / (1.0 + larsson_c2 * p)),
        thermal_conductivity * larsson_c1 / (1.0 + larsson_c2 * p) ** 2,
    )


def scaled_thermal_conductivity(
    pressure: ArrayLike,
    temperature: ArrayLike | None = None,
    *,
    scaling_k_base: float,
    scaling_k_factor: float,
    scaling_k_exponent: float,
    scaling_a: float,
    scaling_q: float,
    tait_k0_prime: float,
    tait_k00: float,
    tait_beta_k: float,
    tait_expansion: float,
    reference_temperature: float,
) -> tuple[Array, Array]:
    """Thermal conductivity as a function of temperature and volume, and its derivative by pressure.

    k = B + C kappa^-s with kappa = v (1 + A (T/T_R) v^q) and the volume v = V/V_R of Tait's equation.

    Parameters
    ----------
    pressure : array_like, shape (...)
        Pressure p [Pa], >= 0.
    temperature : array_like
        Temperature T [K].
    scaling_k_base, scaling_k_factor : float
        Constants B and C [W/(m K)].
    scaling_k_exponent, scaling_a, scaling_q : float
        Constants s, A and q, dimensionless.
    tait_k0_prime, tait_k00, tait_beta_k, tait_expansion, reference_temperature : float
        Parameters of Tait's equation, see ``equation_of_state.tait``.

    Returns
    -------
    conductivity, slope : ndarray, shape (...)
        Thermal conductivity k [W/(m K)], and its derivative by pressure [W/(m K Pa)].

    Raises
    ------
    InputError
        If the temperature is missing, or kappa is not positive.

    Notes
    -----
    Habchi and others, Tribol. Int. 43 (2010) 1842, for the mineral oil Shell T9, as later works quote it. The
    constants A and q have not been compared with the printed ones.

    Examples
    --------
    >>> t9 = dict(scaling_k_base=0.053, scaling_k_factor=0.026, scaling_k_exponent=7.66, scaling_a=-0.101)
    >>> t9 |= dict(scaling_q=3.0, tait_k0_prime=10.545, tait_k00=9.234e9, tait_beta_k=6.09e-3)
    >>> t9 |= dict(tait_expansion=7.734e-4, reference_temperature=298.15)
    >>> scaled_thermal_conductivity([0.0, 1e9], 298.15, **t9)[0].round(3).tolist()
    [0.112, 0.248]
    """
    state = {"tait_k0_prime": tait_k0_prime, "tait_k00": tait_k00, "tait_beta_k": tait_beta_k}
    state |= {"tait_expansion": tait_expansion, "reference_temperature": reference_temperature}
    at = required(temperature, "thermal_conductivity_law 'scaling'")
    v, v_slope = volume(pressure, at, state)
    part = scaling_a * at / reference_temperature * v**scaling_q
    if not np.all(part > -1.0):
        raise InputError(
            "scaling_a",
            got=f"{scaling_a:g}, with which kappa of thermal_conductivity_law 'scaling' is not positive;",
            takes="a larger value",
        )
    kappa = v * (1.0 + part)
    rise = scaling_k_factor * kappa**-scaling_k_exponent
    kappa_slope = (1.0 + (1.0 + scaling_q) * part) * v_slope
    return scaling_k_base + rise, -scaling_k_exponent * rise / kappa * kappa_slope


def _conductivity_warnings(
    max_pressure: float,
    viscosity: float,
    temperature: float | None = None,
    *,
    thermal_conductivity: float,
    larsson_c1: float,
    larsson_c2: float,
) -> Iterator[ResultWarning]:
    yield from beyond_larsson("thermal_conductivity_law", max_pressure, temperature)


THERMAL_CONDUCTIVITY = Parameter("thermal_conductivity", "W/m/K", least=0.01, most=1.0, reason="of an oil")
_C1, _C2 = (larsson_constant("c", k, "thermal conductivity") for k in (1, 2))

THERMAL_CONDUCTIVITY_LAWS = {
    "constant": Law(constant_thermal_conductivity, (THERMAL_CONDUCTIVITY,)),
    "larsson": Law(
        larsson_thermal_conductivity, (THERMAL_CONDUCTIVITY, _C1, _C2), warnings=_conductivity_warnings
    ),
    "scaling": Law(
        scaled_thermal_conductivity,
        (
            number(
                "scaling_k_base",
                "W/m/K",
                "base of the scaled thermal conductivity",
                "$B$",
                "$B$ of the scaled thermal conductivity",
                (0.0, 1.0),
                "an oil has 0.05",
            ),
            number(
                "scaling_k_factor",
                "W/m/K",
                "factor of the scaled thermal conductivity",
                "$C$",
                "$C$ of the scaled thermal conductivity",
                (0.0, 1.0),
                "an oil has 0.03",
            ),
            number(
                "scaling_k_exponent",
                "",
                "exponent of the scaled thermal conductivity",
                "$s$",
                "$s$ of the scaled thermal conductivity",
                (0.0, 30.0),
                "an oil has 7.7",
            ),
            number(
                "scaling_a",
                "",
                "temperature factor of the scaled thermal conductivity",
                "$A$",
                "$A$ of the scaled thermal conductivity",
                (-1.0, 1.0),
                "an oil has -0.1",
            ),
            number(
                "scaling_q",
                "",
                "volume exponent of the scaled thermal conductivity",
                "$q$",
                "$q$ of the scaled thermal conductivity",
                (0.0, 20.0),
                "an oil has 3",
            ),
            *TAIT.parameters,
        ),
        needs_temperature=True,
    ),
}
