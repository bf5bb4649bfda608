"""Reduction of films by heat in the inlet and by a short supply of oil, and hydrodynamic resistance to
rolling.

The supply of oil to the contacts of a rolling bearing follows the kinematic replenishment factor of SKF's
model of the frictional moment. The decay of a film without supply follows van Zoelen, Venner and Lugt, for
a track to which no oil returns.

The hydrodynamic resistance to rolling of flooded contacts in pure rolling follows Biboulet and Houpert.
The force is the integral of h/2 dp/dx over the contact: the resistance of the oil on each of both surfaces.
In pure rolling it takes the power 2 F u with the mean speed u of the surfaces. The formulas are fits to
isothermal solutions. They run from rigid bodies in thin oil, of light loads, to bodies that deform.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array, Numbers, as_float
from ehlectric.formulas.film_line import LineContact
from ehlectric.formulas.film_point import PointContact
from ehlectric.formulas.hertz import dry_contact

# Exponent of the thermal loading parameter in the reduction factor of Wilson and Sheu.
LOADING_EXPONENT = 0.64


def inlet_shear_factor(viscosity: Numbers, slope: Numbers, speed: Numbers, conductivity: Numbers) -> Numbers:
    """Reduction factor of the central film thickness due to shear heating in the inlet, in pure rolling.

    1/(1 + 0.241 L^0.64) with the thermal loading parameter L = eta0 beta u^2/k

    ``viscosity``, viscosity eta0 at the inlet temperature [Pa s]; ``slope``, temperature coefficient of
    viscosity beta = -d ln(eta0)/dT [1/K]; ``speed``, mean speed u of both surfaces [m/s]; ``conductivity``,
    thermal conductivity k of the oil [W/(m K)]; all of shape (...). Returns central film thickness over the
    isothermal one, from 0 to 1, shape (...).

    W. R. D. Wilson and S. Sheu, Effect of inlet shear heating due to sliding on elastohydrodynamic film
    thickness, ASME J. Lubr. Technol. 105 (1983) 187, doi:10.1115/1.3254563, eq. (8). It was derived for the
    inlet of a line contact, and is also used for elliptical contacts. Of three published formulas it is the
    nearest to solved films in pure rolling. Solved films contradict its term of sliding, which is omitted.

    Examples
    --------
    >>> round(inlet_shear_factor(0.0125, 0.0309, 15.1, 0.14), 3)
    0.848
    """
    loading = viscosity * slope * speed**2 / conductivity
    return as_float(1.0 / (1.0 + 0.241 * loading**LOADING_EXPONENT))


# Constant K_rs of SKF's factor, by the way in which the oil is supplied. A flooded bearing has no reduction.
SUPPLY_CONSTANTS: Mapping[str, float] = MappingProxyType(
    {"flooded": 0.0, "oil-bath": 3e-8, "oil-jet": 3e-8, "grease": 6e-8, "oil-air": 6e-8}
)

# Constant K_Z of SKF's factor for bearings with one row; SKF has none for radial needle bearings.
GEOMETRY_CONSTANTS: Mapping[str, float] = MappingProxyType(
    {
        "deep-groove ball": 3.1,
        "angular-contact ball": 4.4,
        "four-point contact ball": 3.1,
        "thrust ball": 3.8,
        "cylindrical roller": 5.1,
        "tapered roller": 6.0,
        "thrust needle roller": 4.4,
    }
)

_RPM = 30.0 / math.pi


def replenishment_factor(
    speed: ArrayLike, viscosity: ArrayLike, *, bore: Numbers, outer_diameter: Numbers, supply: str, kind: str
) -> Array:
    """Kinematic replenishment factor of a rolling bearing after SKF.

    phi = exp(-K_rs nu n (d + D) sqrt(K_Z/(2 (D - d)))), with nu in mm^2/s, n in rpm, d and D in mm

    ``speed``, rotational speed n of the inner ring [rad/s], >= 0, shape (...); ``viscosity``, kinematic
    viscosity nu of the oil, or of the base oil of a grease, in operation [m^2/s], shape (...); ``bore`` and
    ``outer_diameter``, bore d and outside diameter D of the bearing [m], shape (...). Returns factor from 0
    to 1, dimensionless, shape (...).

    SKF, Rolling bearings, PUB BU/P1 17000, and The SKF model for calculating the frictional moment. The form,
    K_rs, and K_Z of radial ball bearings agree in three or more independent programs; the other K_Z are from
    memory: 5.1 holds for cylindrical rollers with a cage, and 4.4 for cylindrical roller thrust
    bearings. SKF reduces the rolling frictional moment by the factor, and explains it by a thinner film. Its
    model is for bearings at steady speed and temperature, at constant load above the minimum load, with
    normal clearance, below the limiting speed; its oil bath is a low one.

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
    shape = (inner + outer) * np.sqrt(GEOMETRY_CONSTANTS[kind] / (2.0 * (outer - inner)))
    return np.asarray(np.exp(-SUPPLY_CONSTANTS[supply] * nu * turns * shape))


def decay_rate(
    *,
    max_pressure: Numbers,
    semi_axes: tuple[Numbers, Numbers],
    viscosity: Numbers,
    pressure_viscosity_coefficient: Numbers,
    density_ratio: Numbers,
    track_length: Numbers,
) -> Numbers:
    """Rate at which a contact presses oil out of its track, rho^2 F/6 in 1/h^2 = 1/h0^2 + rho^2 F t/6.

    F = (2/l) (p_h/b^2) (a/eta0) pi ((pi alpha p_h/2)^(3/2) + 1)^(-2/3)

    ``max_pressure``, Hertz pressure p_h [Pa]; ``semi_axes``, semi-axes a along and b across the track [m];
    ``viscosity``, viscosity eta0 of the oil at ambient pressure [Pa s]; ``pressure_viscosity_coefficient``
    [1/Pa]; ``density_ratio``, density rho of the oil at the Hertz pressure divided by the density at ambient
    pressure, dimensionless; ``track_length``, length l of the tracks on both surfaces together from which one
    contact presses oil [m]; all of shape (...). Returns rate [1/(m^2 s)], shape (...).

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
    return as_float(density_ratio**2 * flow * stiffening ** (-2.0 / 3.0) / 6.0)


def film_half_time(thickness: ArrayLike, rate: ArrayLike) -> Array:
    """Time after which a film without supply has half of its thickness, t = 3/(rate h0^2) [s]. ``thickness``,
    central film thickness h0 at the start [m], shape (...); ``rate`` [1/(m^2 s)], shape (...).

    Examples
    --------
    >>> round(float(film_half_time(1e-7, 1e14)), 9)
    3.0
    """
    return np.asarray(3.0 / (np.asarray(rate) * np.square(np.asarray(thickness, dtype=float))))


# Moment of a line contact over p_h b^2 at small M, times M, and at large M, times M^(3/2); exponent of the
# transition between both.
_RIGID, _ELASTIC, _SHARP = 1.4, 1.45, 10.0

# Moment of a line contact over E' R^2 from that over p_h b^2: (2/pi) (8/pi)^(1/2) W^(3/2).
_SCALE = 2.0 / math.pi * math.sqrt(8.0 / math.pi)

# Load parameter M at which a point contact is half way between its limits.
_HALF = 6.6


def line_rolling_force(contact: LineContact, load_per_length: ArrayLike) -> Array:
    """Hydrodynamic rolling force of a line contact on each surface, per length.

    F/(E' R) = 1.016 U^(3/4) 1.4 M^(1/2)/(1 + (0.966 M^(1/2))^10)^(1/10), U = 2 eta0 u/(E' R), M = W/U^(1/2)

    ``load_per_length`` [N/m], shape (...), broadcasts with the numbers of ``contact``. Returns force [N/m],
    shape (...).

    Equations (40) to (42) of N. Biboulet and L. Houpert, Hydrodynamic force and moment in pure rolling
    lubricated contacts, part 1: line contacts, Proc. IMechE J 224 (2010), doi:10.1243/13506501JET790. The
    fit holds for M from 0.2 to 200 and L from 4 to 16.

    Examples
    --------
    >>> contact = LineContact(
    ...     reduced_radius=4.5e-3, reduced_modulus=226e9, load_per_length=0.0, entrainment_speed=4.5,
    ...     viscosity=0.0125, pressure_viscosity_coefficient=0.0,
    ... )
    >>> line_rolling_force(contact, [1e3, 1e5, 2e5]).round(1).tolist()
    [15.1, 51.1, 51.1]
    """
    scale = contact.reduced_modulus * contact.reduced_radius
    speed = 2.0 * contact.viscosity * contact.entrainment_speed / scale
    root = np.sqrt(np.asarray(load_per_length, dtype=float) / scale / np.sqrt(speed))
    part = _RIGID * root / (1.0 + (_RIGID / _ELASTIC * root) ** _SHARP) ** (1.0 / _SHARP)
    return np.asarray(_SCALE * scale * speed**0.75 * part)


def point_rolling_force(contact: PointContact, load: ArrayLike) -> Array:
    """Hydrodynamic rolling force of a point contact on each surface.

    F/(E' Rx^2) = 2 a/Rx U^(3/4) (B + (A U^(-1/12) - B)/(1 + M/6.6)), A = 0.77 c^(-1/3) k^0.12,
    B = 1.8 c^(-1/4)

    with U = 2 eta0 u/(E' Rx), M = c^(1/4) k W/U^(3/4), W = Q/(E' Rx^2), c = b E'/(pi p_h Rx), and k = b/a of
    the semi-axes b along and a across entrainment.

    ``contact``, contact with a load > 0; the load and the pressure-viscosity coefficient have no effect;
    ``load`` [N], shape (...), broadcasts with the numbers of ``contact``. Returns force [N], shape (...); it
    goes with the cube root of the load, as the width 2 a, for light and for heavy loads.

    Equation (32) of N. Biboulet and L. Houpert, Hydrodynamic force and moment in pure rolling lubricated
    contacts, part 2: point contacts, Proc. IMechE J 224 (2010), doi:10.1243/13506501JET791. The fit holds
    for k up to 1, M from 0.2 to 800 and L from 4 to 16.

    Examples
    --------
    >>> contact = PointContact(
    ...     radius_x=4.7e-3, radius_y=0.15, reduced_modulus=226e9, load=900.0, entrainment_speed=4.5,
    ...     viscosity=0.0125, pressure_viscosity_coefficient=0.0,
    ... )
    >>> point_rolling_force(contact, [1.0, 100.0, 800.0]).round(4).tolist()
    [0.0368, 0.0911, 0.1676]
    """
    load = np.asarray(load, dtype=float)
    radius, modulus = contact.radius_x, contact.reduced_modulus
    dry = dry_contact(contact.load, radius, contact.radius_y, modulus)
    ratio = dry.semi_axis_x / dry.semi_axis_y
    shape = dry.semi_axis_x * modulus / (math.pi * dry.max_pressure * radius)
    speed = 2.0 * contact.viscosity * contact.entrainment_speed / (modulus * radius)
    heavy = replace(contact, load=1.0).moes_m * shape**0.25 * ratio * load
    rigid, elastic = 0.77 * shape ** (-1.0 / 3.0) * ratio**0.12, 1.8 * shape**-0.25
    part = elastic + (rigid * speed ** (-1.0 / 12.0) - elastic) / (1.0 + heavy / _HALF)
    width = 2.0 * dry.semi_axis_y * np.cbrt(load / contact.load)
    return np.asarray(modulus * radius * width * speed**0.75 * part)
