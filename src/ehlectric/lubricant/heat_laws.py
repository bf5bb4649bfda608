"""Thermal conductivity and volumetric heat capacity of an oil over pressure and temperature.

The laws of heat capacity give the heat capacity of a volume, rho c [J/(m^3 K)], which the energy equation of
the film contains and which the sources print. The specific heat capacity c is this value over the density.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import Unpack

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array, Numbers
from ehlectric.errors import InputError
from ehlectric.lubricant.density import TaitState, tait
from ehlectric.lubricant.law import Law, parameters_of, required
from ehlectric.quantities.result_warnings import ResultWarning

# Largest pressure [Pa] and temperature [K] of the measurements behind the laws of Larsson et al.
LARSSON_PRESSURE, LARSSON_TEMPERATURE = 1.1e9, 380.15

# Thermal conductivity of an oil that gives none, and the usual range of mineral oils and synthetic
# hydrocarbons at 40 to 100 degC and ambient pressure [W/(m K)]. Larsson et al., as later programs quote them,
# have 0.137 of a paraffinic mineral oil, the value here, and 0.154 of a polyalphaolefin; Wingertszahn et al.,
# doi:10.3390/lubricants11090369, have 0.134 of the mineral oil FVA 3. The range contains them; its ends are
# a judgement.
ASSUMED_CONDUCTIVITY, USUAL_CONDUCTIVITY = 0.137, (0.12, 0.16)


def volume(pressure: ArrayLike, temperature: Array, state: TaitState) -> tuple[Array, Array]:
    """Volume divided by the volume at zero pressure and reference temperature, and derivative by pressure."""
    ratio, slope = tait(pressure, temperature, **state)
    ambient = 1.0 + state["tait_expansion"] * (temperature - state["reference_temperature"])
    return ambient / ratio, -ambient * slope / ratio**2


def _beyond_larsson(
    law: str, max_pressure: float, viscosity: float, temperature: float | None = None, **parameters: float
) -> Iterator[ResultWarning]:
    """Warning that a contact is outside the measurements behind a law of Larsson et al."""
    hot = temperature is not None and temperature > LARSSON_TEMPERATURE
    if max_pressure > LARSSON_PRESSURE or hot:
        yield ResultWarning.of("law-range", "larsson", law=law, highest=LARSSON_PRESSURE / 1e9)


def constant_thermal_conductivity(
    pressure: ArrayLike, temperature: ArrayLike | None = None, *, thermal_conductivity: Numbers
) -> tuple[Array, Array]:
    """Thermal conductivity that changes neither with pressure nor with temperature. ``pressure`` [Pa],
    shape (...); ``temperature`` [K]; ``thermal_conductivity`` [W/(m K)]. Returns thermal conductivity
    [W/(m K)], and its derivative by pressure, which is zero, shape (...).

    Examples
    --------
    >>> float(constant_thermal_conductivity(1e9, thermal_conductivity=0.134)[0])
    0.134
    """
    p = np.asarray(pressure, dtype=float)
    return np.zeros_like(p) + thermal_conductivity, np.zeros_like(p)


def larsson_thermal_conductivity(
    pressure: ArrayLike,
    temperature: ArrayLike | None = None,
    *,
    thermal_conductivity: Numbers,
    larsson_c1: Numbers,
    larsson_c2: Numbers,
) -> tuple[Array, Array]:
    """Thermal conductivity after Larsson et al., k = k0 (1 + c1 p/(1 + c2 p)), and its derivative.

    ``pressure`` [Pa], shape (...); ``temperature`` [K]; ``thermal_conductivity``, thermal conductivity k0 at
    zero pressure [W/(m K)]; ``larsson_c1`` and ``larsson_c2`` [1/Pa]. Returns thermal conductivity k
    [W/(m K)], and its derivative by pressure [W/(m K Pa)], shape (...).

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
    scaling_k_base: Numbers,
    scaling_k_factor: Numbers,
    scaling_k_exponent: Numbers,
    scaling_a: Numbers,
    scaling_q: Numbers,
    **state: Unpack[TaitState],
) -> tuple[Array, Array]:
    """Thermal conductivity as a function of temperature and volume, and its derivative by pressure.

    k = B + C kappa^-s with kappa = v (1 + A (T/T_R) v^q) and the volume v = V/V_R of Tait's equation.

    ``pressure`` [Pa], shape (...); ``temperature`` [K]; ``**state``, parameters of ``tait``, with the
    reference temperature T_R [K]; ``scaling_k_base`` and ``scaling_k_factor``, constants B and C [W/(m K)];
    ``scaling_k_exponent``, ``scaling_a`` and ``scaling_q``, constants s, A and q, dimensionless. Returns
    thermal conductivity k [W/(m K)], and its derivative by pressure [W/(m K Pa)], shape (...). Raises
    InputError if the temperature is missing, or kappa is not positive; of many temperatures, those where it
    is not have NaN.

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
    at = required(temperature, "thermal_conductivity_law 'scaling'")
    v, v_slope = volume(pressure, at, state)
    part = scaling_a * at / state["reference_temperature"] * v**scaling_q
    wrong = part <= -1.0
    if np.ndim(at):
        part = np.where(wrong, np.nan, part)
    elif np.any(wrong):
        raise InputError(
            "scaling_a",
            got=f"{scaling_a:g}, with which kappa of thermal_conductivity_law 'scaling' is not positive;",
            takes="a larger value",
        )
    kappa = v * (1.0 + part)
    rise = scaling_k_factor * kappa**-scaling_k_exponent
    kappa_slope = (1.0 + (1.0 + scaling_q) * part) * v_slope
    return scaling_k_base + rise, -scaling_k_exponent * rise / kappa * kappa_slope


THERMAL_CONDUCTIVITY_LAWS = {
    "constant": Law(constant_thermal_conductivity, parameters_of(constant_thermal_conductivity)),
    "larsson": Law(
        larsson_thermal_conductivity,
        parameters_of(larsson_thermal_conductivity),
        warnings=partial(_beyond_larsson, "thermal_conductivity_law"),
    ),
    "scaling": Law(
        scaled_thermal_conductivity,
        parameters_of(scaled_thermal_conductivity, tait),
        needs_temperature=True,
    ),
}


def constant_heat_capacity(
    pressure: ArrayLike, temperature: ArrayLike | None = None, *, heat_capacity: Numbers, density: Numbers
) -> tuple[Array, Array]:
    """Volumetric heat capacity rho c that changes neither with pressure nor with temperature.

    ``pressure`` [Pa], shape (...); ``temperature`` [K]; ``heat_capacity``, specific heat capacity c
    [J/(kg K)]; ``density`` [kg/m^3]. Returns volumetric heat capacity [J/(m^3 K)], and its derivative by
    pressure, which is zero, shape (...).

    Examples
    --------
    >>> float(constant_heat_capacity(1e9, heat_capacity=2000.0, density=850.0)[0])
    1700000.0
    """
    p = np.asarray(pressure, dtype=float)
    return np.zeros_like(p) + heat_capacity * density, np.zeros_like(p)


def larsson_heat_capacity(
    pressure: ArrayLike,
    temperature: ArrayLike | None = None,
    *,
    volumetric_heat_capacity: Numbers,
    larsson_temperature: Numbers,
    larsson_beta: Numbers,
    larsson_b1: Numbers,
    larsson_b2: Numbers,
    larsson_k1: Numbers,
    larsson_k2: Numbers,
) -> tuple[Array, Array]:
    """Volumetric heat capacity after Larsson et al., and its derivative by pressure.

    rho c = (rho c)_0 (1 + beta (T - T_0)) (1 + k1 p/(1 + k2 p)) with beta = beta_0 (1 + b1 p + b2 p^2).

    ``pressure`` [Pa], shape (...); ``temperature`` [K]; ``volumetric_heat_capacity``, volumetric heat
    capacity (rho c)_0 at zero pressure and the temperature T_0 [J/(m^3 K)]; ``larsson_temperature`` [K];
    ``larsson_beta``, temperature coefficient beta_0 at zero pressure [1/K]; ``larsson_b1`` and
    ``larsson_b2``, constants b1 [1/Pa] and b2 [1/Pa^2] of the temperature coefficient; ``larsson_k1`` and
    ``larsson_k2`` [1/Pa]. Returns volumetric heat capacity [J/(m^3 K)], and its derivative by pressure
    [J/(m^3 K Pa)], shape (...). Raises InputError if the temperature is missing.

    Source of ``larsson_thermal_conductivity``. The product is the capacity of a volume: a later
    program divides it by the density ratio for the capacity of a mass. That program has the last factor
    within the brackets of the temperature. If b2 < 0, beta would become negative at pressures above those
    of the measurements; above its maximum at p = -b1/(2 b2) it is held.

    Examples
    --------
    >>> oil = dict(volumetric_heat_capacity=1.71e6, larsson_temperature=295.0, larsson_beta=9.3e-4)
    >>> oil |= dict(larsson_b1=1.4e-9, larsson_b2=-0.51e-18, larsson_k1=0.47e-9, larsson_k2=0.81e-9)
    >>> (larsson_heat_capacity([0.0, 1e9], 345.0, **oil)[0] / 1e6).round(3).tolist()
    [1.79, 2.343]
    """
    p = np.asarray(pressure, dtype=float)
    warmer = required(temperature, "heat_capacity_law 'larsson'") - larsson_temperature
    turns = np.less(larsson_b2, 0.0)
    held = np.minimum(p, np.where(turns, -larsson_b1 / (2.0 * np.where(turns, larsson_b2, -1.0)), np.inf))
    heat = 1.0 + larsson_beta * (1.0 + (larsson_b1 + larsson_b2 * held) * held) * warmer
    heat_slope = larsson_beta * (larsson_b1 + 2.0 * larsson_b2 * held) * warmer
    squeeze = 1.0 + larsson_k1 * p / (1.0 + larsson_k2 * p)
    squeeze_slope = larsson_k1 / (1.0 + larsson_k2 * p) ** 2
    return (
        volumetric_heat_capacity * heat * squeeze,
        volumetric_heat_capacity * (heat_slope * squeeze + heat * squeeze_slope),
    )


def scaled_heat_capacity(
    pressure: ArrayLike,
    temperature: ArrayLike | None = None,
    *,
    scaling_c_base: Numbers,
    scaling_c_factor: Numbers,
    scaling_c_exponent: Numbers,
    **state: Unpack[TaitState],
) -> tuple[Array, Array]:
    """Volumetric heat capacity as a function of temperature and volume, and its derivative by pressure.

    rho c = C0 + m chi with chi = (T/T_R) v^-g and the volume v = V/V_R of Tait's equation.

    ``pressure`` [Pa], shape (...); ``temperature`` [K]; ``scaling_c_base`` and ``scaling_c_factor``,
    constants C0 and m [J/(m^3 K)]; ``scaling_c_exponent``, constant g, dimensionless; ``**state``, parameters
    of ``tait``, with the reference temperature T_R [K]. Returns volumetric heat capacity [J/(m^3 K)], and its
    derivative by pressure [J/(m^3 K Pa)], shape (...). Raises InputError if the temperature is missing.

    Source of ``scaled_thermal_conductivity``; the exponent g has not been compared with the printed one.

    Examples
    --------
    >>> t9 = dict(scaling_c_base=1.17e6, scaling_c_factor=0.39e6, scaling_c_exponent=4.0)
    >>> t9 |= dict(tait_k0_prime=10.545, tait_k00=9.234e9, tait_beta_k=6.09e-3)
    >>> t9 |= dict(tait_expansion=7.734e-4, reference_temperature=298.15)
    >>> (scaled_heat_capacity([0.0, 1e9], 298.15, **t9)[0] / 1e6).round(2).tolist()
    [1.56, 2.06]
    """
    at = required(temperature, "heat_capacity_law 'scaling'")
    v, v_slope = volume(pressure, at, state)
    rise = scaling_c_factor * at / state["reference_temperature"] * v**-scaling_c_exponent
    return scaling_c_base + rise, -scaling_c_exponent * rise / v * v_slope


HEAT_CAPACITY_LAWS = {
    "constant": Law(constant_heat_capacity, parameters_of(constant_heat_capacity)),
    "larsson": Law(
        larsson_heat_capacity,
        parameters_of(larsson_heat_capacity),
        warnings=partial(_beyond_larsson, "heat_capacity_law"),
        needs_temperature=True,
    ),
    "scaling": Law(
        scaled_heat_capacity,
        parameters_of(scaled_heat_capacity, tait),
        needs_temperature=True,
    ),
}
