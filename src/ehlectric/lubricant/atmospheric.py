"""Laws of the viscosity at ambient pressure over temperature: Vogel and Roelands."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array
from ehlectric.errors import InputError
from ehlectric.lubricant.equation_of_state import REFERENCE_TEMPERATURE
from ehlectric.lubricant.law import Law, Parameter, refused, required, within
from ehlectric.lubricant.viscosity import ROELANDS_CONSTANT

# Temperature of the pole of Roelands' law [K], -135 degC.
ROELANDS_TEMPERATURE = 138.0


def vogel(temperature: ArrayLike | None, *, vogel_viscosity: float, vogel_b: float, vogel_c: float) -> Array:
    """Viscosity at ambient pressure after Vogel, eta = K exp(B/(T - C)).

    Parameters
    ----------
    temperature : array_like, shape (...)
        Temperature T [K].
    vogel_viscosity : float
        Constant K, the viscosity at unlimited temperature [Pa s].
    vogel_b : float
        Constant B [K].
    vogel_c : float
        Temperature C of the pole [K].

    Returns
    -------
    ndarray, shape (...)
        Viscosity eta [Pa s].

    Raises
    ------
    InputError
        If the temperature is missing, or not above the pole.

    Notes
    -----
    H. Vogel, Phys. Z. 22 (1921) 645.

    Examples
    --------
    >>> fva3 = dict(vogel_viscosity=6.2e-5, vogel_b=1021.7, vogel_c=171.5983)
    >>> (1e3 * vogel([313.15, 333.15, 353.15, 373.15], **fva3)).round(2).tolist()
    [84.54, 34.59, 17.24, 9.86]
    """
    return np.asarray(vogel_viscosity * np.exp(vogel_b / (_above_pole(temperature, vogel_c) - vogel_c)))


def _above_pole(temperature: ArrayLike | None, vogel_c: float) -> Array:
    """Temperature [K] above the pole of Vogel's law."""
    at = required(temperature, "atmospheric_law 'vogel'")
    within(at, "atmospheric_law 'vogel'", vogel_c, math.inf, "its pole is vogel_c")
    return at


def vogel_coefficient(
    temperature: ArrayLike, *, vogel_viscosity: float, vogel_b: float, vogel_c: float
) -> Array:
    """Temperature coefficient of the viscosity after Vogel, -d ln(eta)/dT = B/(T - C)^2, in 1/K.

    Parameters
    ----------
    temperature : array_like, shape (...)
        Temperature T [K].
    vogel_viscosity, vogel_b, vogel_c : float
        Parameters of ``vogel``.

    Examples
    --------
    >>> fva3 = dict(vogel_viscosity=6.2e-5, vogel_b=1021.7, vogel_c=171.5983)
    >>> round(float(vogel_coefficient(353.15, **fva3)), 4)
    0.031
    """
    return np.asarray(vogel_b / (_above_pole(temperature, vogel_c) - vogel_c) ** 2)


def vogel_temperature(
    viscosity: ArrayLike, *, vogel_viscosity: float, vogel_b: float, vogel_c: float
) -> Array:
    """Temperature [K] at which an oil of Vogel's law has a viscosity; the inverse of ``vogel``.

    Parameters
    ----------
    viscosity : array_like, shape (...)
        Viscosity [Pa s].
    vogel_viscosity, vogel_b, vogel_c : float
        Parameters of ``vogel``.

    Raises
    ------
    InputError
        If no temperature has the viscosity.

    Examples
    --------
    >>> fva3 = dict(vogel_viscosity=6.2e-5, vogel_b=1021.7, vogel_c=171.5983)
    >>> round(float(vogel_temperature(0.08454, **fva3)), 2)
    313.15
    """
    eta = np.asarray(viscosity, dtype=float)
    if wrong := refused(eta, eta > vogel_viscosity, "Pa s"):
        raise InputError(
            "viscosity",
            got=f"{wrong};",
            takes=f"above {vogel_viscosity:g} Pa s, the range of atmospheric_law 'vogel'",
        )
    return np.asarray(vogel_c + vogel_b / np.log(eta / vogel_viscosity))


def roelands_over_temperature(
    temperature: ArrayLike | None, *, viscosity: float, reference_temperature: float, roelands_s0: float
) -> Array:
    """Viscosity at ambient pressure after Roelands.

    ln eta + 9.67 = (ln eta_ref + 9.67) ((T - 138 K)/(T_ref - 138 K))^-S0, with viscosities in Pa s.

    Parameters
    ----------
    temperature : array_like, shape (...)
        Temperature T [K].
    viscosity : float
        Viscosity eta_ref at the reference temperature [Pa s].
    reference_temperature : float
        Reference temperature T_ref [K].
    roelands_s0 : float
        Slope index S0, dimensionless.

    Returns
    -------
    ndarray, shape (...)
        Viscosity eta [Pa s].

    Raises
    ------
    InputError
        If the temperature is missing or not above 138 K, or the viscosity is below the pole of 6.3e-5 Pa s.

    Notes
    -----
    C. J. A. Roelands, Correlational aspects of the viscosity-temperature-pressure relationship of
    lubricating oils, thesis, Delft, 1966. The pressure-viscosity coefficient at the temperature follows from
    the viscosity by ``viscosity.roelands_alpha``.

    Examples
    --------
    >>> oil = dict(viscosity=0.04, reference_temperature=313.15, roelands_s0=1.1)
    >>> roelands_over_temperature([313.15, 353.15], **oil).round(4).tolist()
    [0.04, 0.0108]
    """
    reduced = _reduced(viscosity)
    ratio = (_above_138(temperature) - ROELANDS_TEMPERATURE) / (_distance(reference_temperature))
    return np.asarray(np.exp(reduced * ratio**-roelands_s0 - ROELANDS_CONSTANT))


def _above_138(temperature: ArrayLike | None) -> Array:
    """Temperature [K] above the pole of Roelands' law."""
    at = required(temperature, "atmospheric_law 'roelands'")
    within(at, "atmospheric_law 'roelands'", ROELANDS_TEMPERATURE, math.inf, "its pole")
    return at


def _distance(reference_temperature: float) -> float:
    """Difference of the reference temperature to the pole of Roelands' law [K]."""
    if reference_temperature <= ROELANDS_TEMPERATURE:
        raise InputError(
            "reference_temperature",
            got=f"{reference_temperature:g} K",
            takes=f"above {ROELANDS_TEMPERATURE:g} K, the pole of atmospheric_law 'roelands'",
        )
    return reference_temperature - ROELANDS_TEMPERATURE


def _reduced(viscosity: float | Array) -> Array:
    """Ln eta + 9.67 of Roelands' laws."""
    least = math.exp(-ROELANDS_CONSTANT)
    eta = np.asarray(viscosity, dtype=float)
    if wrong := refused(eta, eta > least, "Pa s"):
        raise InputError(
            "viscosity",
            got=f"{wrong};",
            takes=f"above {least:.2g} Pa s, the range of atmospheric_law 'roelands'",
        )
    return np.asarray(np.log(eta) + ROELANDS_CONSTANT)


def roelands_coefficient(
    temperature: ArrayLike, *, viscosity: float, reference_temperature: float, roelands_s0: float
) -> Array:
    """Temperature coefficient after Roelands, -d ln(eta)/dT = S0 (ln eta + 9.67)/(T - 138 K), in 1/K.

    Parameters
    ----------
    temperature : array_like, shape (...)
        Temperature T [K].
    viscosity, reference_temperature, roelands_s0 : float
        Parameters of ``roelands_over_temperature``.

    Examples
    --------
    >>> oil = dict(viscosity=0.04, reference_temperature=313.15, roelands_s0=1.1)
    >>> round(float(roelands_coefficient(313.15, **oil)), 4)
    0.0405
    """
    at = _above_138(temperature)
    eta = roelands_over_temperature(
        at, viscosity=viscosity, reference_temperature=reference_temperature, roelands_s0=roelands_s0
    )
    return np.asarray(roelands_s0 * (np.log(eta) + ROELANDS_CONSTANT) / (at - ROELANDS_TEMPERATURE))


def roelands_temperature(
    value: ArrayLike, *, viscosity: float, reference_temperature: float, roelands_s0: float
) -> Array:
    """Temperature [K] at which an oil has a viscosity; the inverse of ``roelands_over_temperature``.

    Parameters
    ----------
    value : array_like, shape (...)
        Viscosity [Pa s].
    viscosity, reference_temperature, roelands_s0 : float
        Parameters of ``roelands_over_temperature``.

    Raises
    ------
    InputError
        If no temperature has the viscosity.

    Examples
    --------
    >>> oil = dict(viscosity=0.04, reference_temperature=313.15, roelands_s0=1.1)
    >>> round(float(roelands_temperature(0.04, **oil)), 2)
    313.15
    """
    ratio = _reduced(np.asarray(value, dtype=float)) / _reduced(viscosity)
    return np.asarray(ROELANDS_TEMPERATURE + _distance(reference_temperature) * ratio ** (-1.0 / roelands_s0))


VISCOSITY = Parameter(
    "viscosity",
    "Pa*s",
    least=1e-7,
    most=1e6,
    reason="at ambient pressure",
)

ATMOSPHERIC_LAWS = {
    "vogel": Law(
        vogel,
        (
            Parameter(
                "vogel_viscosity",
                "Pa*s",
                title="Vogel's constant of viscosity",
                symbol="$K$",
                meaning="$K$ of Vogel's law, the viscosity at unlimited temperature",
                least=1e-9,
                most=1e-1,
                reason="oils have 0.02 to 0.3 mPa s",
            ),
            Parameter(
                "vogel_b",
                "K",
                title="Vogel's constant $B$",
                symbol="$B$",
                meaning="$B$ of Vogel's law, a difference of temperatures",
                least=10.0,
                most=2e4,
                reason="oils have 600 to 2000 K",
                difference=True,
            ),
            Parameter(
                "vogel_c",
                "K",
                title="temperature of the pole of Vogel's law",
                symbol="$C$",
                meaning="$C$ of Vogel's law, the absolute temperature of its pole",
                least=0.0,
                most=400.0,
                reason="oils have 140 to 200 K",
            ),
        ),
        needs_temperature=True,
        coefficient=vogel_coefficient,
        inverse=vogel_temperature,
    ),
    "roelands": Law(
        roelands_over_temperature,
        (
            VISCOSITY,
            REFERENCE_TEMPERATURE,
            Parameter(
                "roelands_s0",
                "",
                title="Roelands' slope index",
                symbol="$S_0$",
                meaning="Roelands' slope index $S_0$ of the viscosity over temperature",
                least=0.1,
                most=5.0,
                reason="oils have 0.8 to 1.6",
            ),
        ),
        needs_temperature=True,
        coefficient=roelands_coefficient,
        inverse=roelands_temperature,
    ),
}
