"""Supply of oil to the contacts of a rolling bearing: rule of a maker, and decay of a film without supply.

The rule is the kinematic replenishment factor of SKF's model of the frictional moment. The decay is that of
van Zoelen, Venner and Lugt, for a track to which no oil returns.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array

# Constant K_rs of SKF's factor, by the way in which the oil is supplied. A flooded bearing has no reduction.
SUPPLY_CONSTANTS: Mapping[str, float] = MappingProxyType(
    {"flooded": 0.0, "oil-bath": 3e-8, "oil-jet": 3e-8, "grease": 6e-8, "oil-air": 6e-8}
)

# Constant K_Z of SKF's factor for bearings with one row.
GEOMETRY_CONSTANTS: Mapping[str, float] = MappingProxyType(
    {"deep-groove ball": 3.1, "angular-contact ball": 4.4, "cylindrical roller": 5.1}
)

_RPM = 30.0 / math.pi


def replenishment_factor(
    speed: ArrayLike, viscosity: ArrayLike, *, bore: float, outer_diameter: float, supply: str, kind: str
) -> Array:
    """Kinematic replenishment factor of a rolling bearing after SKF.

    phi = exp(-K_rs nu n (d + D) sqrt(K_Z/(2 (D - d)))), with nu in mm^2/s, n in rpm, d and D in mm

    Parameters
    ----------
    speed : array_like, shape (...)
        Rotational speed n of the inner ring [rad/s], >= 0.
    viscosity : array_like, shape (...)
        Kinematic viscosity nu of the oil, or of the base oil of a grease, in operation [m^2/s].
    bore, outer_diameter : float
        Bore d and outside diameter D of the bearing [m].
    supply : str
        Key of ``SUPPLY_CONSTANTS``.
    kind : str
        Key of ``GEOMETRY_CONSTANTS``.

    Returns
    -------
    ndarray, shape (...)
        Factor from 0 to 1, dimensionless.

    Notes
    -----
    SKF, Rolling bearings, PUB BU/P1 17000, and The SKF model for calculating the frictional moment. The form,
    K_rs, and K_Z of ball bearings agree in three or more independent programs; the K_Z of cylindrical rollers
    with a cage, 5.1, is from memory. SKF reduces the rolling frictional moment by the factor, and explains it
    by a thinner film. Its model is for bearings at steady speed and temperature, at constant load above the
    minimum load, with normal clearance, below the limiting speed; its oil bath is a low one.

    Examples
    --------
    A 6208 with ISO VG 46 at 40 degC and 1000 rpm, in an oil bath and greased:

    >>> given = dict(bore=0.04, outer_diameter=0.08, kind="deep-groove ball")
    >>> round(float(replenishment_factor(104.72, 46e-6, supply="oil-bath", **given)), 3)
    0.968
    >>> round(float(replenishment_factor(104.72, 46e-6, supply="grease", **given)), 3)
    0.937
    """
    turns, nu = _RPM * np.asarray(speed, dtype=float), 1e6 * np.asarray(viscosity, dtype=float)
    inner, outer = 1e3 * bore, 1e3 * outer_diameter
    shape = (inner + outer) * math.sqrt(GEOMETRY_CONSTANTS[kind] / (2.0 * (outer - inner)))
    return np.asarray(np.exp(-SUPPLY_CONSTANTS[supply] * nu * turns * shape))


def decay_rate(
    *,
    max_pressure: float,
    semi_axes: tuple[float, float],
    viscosity: float,
    pressure_viscosity_coefficient: float,
    density_ratio: float,
    track_length: float,
) -> float:
    """Rate at which a contact presses oil out of its track, rho^2 F/6 in 1/h^2 = 1/h0^2 + rho^2 F t/6.

    F = (2/l) (p_h/b^2) (a/eta0) pi ((pi alpha p_h/2)^(3/2) + 1)^(-2/3)

    Parameters
    ----------
    max_pressure : float
        Hertz pressure p_h [Pa].
    semi_axes : tuple of float
        Semi-axes a along and b across the track [m].
    viscosity : float
        Viscosity eta0 of the oil at ambient pressure [Pa s].
    pressure_viscosity_coefficient : float
        Pressure-viscosity coefficient alpha [1/Pa].
    density_ratio : float
        Density rho of the oil at the Hertz pressure over that at ambient pressure, dimensionless.
    track_length : float
        Length l of the tracks on both surfaces together from which one contact presses oil [m].

    Returns
    -------
    float
        Rate [1/(m^2 s)].

    Notes
    -----
    M. T. van Zoelen, C. H. Venner and P. M. Lugt, Proc. IMechE J 223 (2009) 541; C. H. Venner, M. T. van
    Zoelen and P. M. Lugt, Tribol. Int. 47 (2012) 175; both second-hand, as later work on grease prints the
    law. The pressure gradient across the track drives the oil
    to its sides; nothing brings it back.

    Examples
    --------
    A ball of 19 mm on a disc with a track of 40 mm radius, after 1020 s with a film of 90 nm at the start:

    >>> rate = decay_rate(max_pressure=0.48e9, semi_axes=(141e-6, 141e-6), viscosity=0.38,
    ...     pressure_viscosity_coefficient=30e-9, density_ratio=1.1525, track_length=0.3112)
    >>> round(1e9 * (1.0 / 90e-9**2 + rate * 1020.0) ** -0.5, 1)
    22.8
    """
    along, across = semi_axes
    stiffening = (0.5 * math.pi * pressure_viscosity_coefficient * max_pressure) ** 1.5 + 1.0
    flow = (2.0 / track_length) * (max_pressure / across**2) * (along / viscosity) * math.pi
    return float(density_ratio**2 * flow * stiffening ** (-2.0 / 3.0) / 6.0)


def film_half_time(thickness: ArrayLike, rate: ArrayLike) -> Array:
    """Time after which a film without supply has half of its thickness, t = 3/(rate h0^2) [s].

    Parameters
    ----------
    thickness : array_like, shape (...)
        Central film thickness h0 at the start [m].
    rate : array_like, shape (...)
        Rate of ``decay_rate`` [1/(m^2 s)].

    Examples
    --------
    >>> round(float(film_half_time(1e-7, 1e14)), 9)
    3.0
    """
    return np.asarray(3.0 / (np.asarray(rate) * np.square(np.asarray(thickness, dtype=float))))
