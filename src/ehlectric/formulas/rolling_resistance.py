"""Hydrodynamic rolling resistance of flooded contacts in pure rolling, after Biboulet and Houpert.

The force is the integral of h/2 dp/dx over the contact: the resistance of the oil on each of both surfaces.
In pure rolling it takes the power 2 F u with the mean speed u of the surfaces. The formulas are fits to
isothermal solutions. They run from rigid bodies in thin oil, of light loads, to bodies that deform.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array
from ehlectric.formulas.film_line import LineContact
from ehlectric.formulas.film_point import PointContact
from ehlectric.formulas.hertz_point import dry_contact

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

    Parameters
    ----------
    contact : LineContact
        Contact; its load and its pressure-viscosity coefficient have no effect.
    load_per_length : array_like, shape (...)
        Loads per length [N/m], >= 0.

    Returns
    -------
    ndarray, shape (...)
        Force [N/m]. It goes with the square root of the load for light loads, and does not depend on heavy
        ones.

    Notes
    -----
    Equations (40) to (42) of N. Biboulet and L. Houpert, Hydrodynamic force and moment in pure rolling
    lubricated contacts, part 1: line contacts, Proc. IMechE J 224 (2010), doi:10.1243/13506501JET790. The
    fit holds for M from 0.2 to 200 and L from 4 to 16.

    Examples
    --------
    >>> contact = LineContact(4.5e-3, 226e9, 0.0, 4.5, 0.0125, 0.0)
    >>> line_rolling_force(contact, [1e3, 1e5, 2e5]).round(1).tolist()
    [15.1, 51.1, 51.1]
    """
    scale = contact.reduced_modulus * contact.reduced_radius
    speed = 2.0 * contact.viscosity * contact.entrainment_speed / scale
    root = np.sqrt(np.asarray(load_per_length, dtype=float) / scale / math.sqrt(speed))
    part = _RIGID * root / (1.0 + (_RIGID / _ELASTIC * root) ** _SHARP) ** (1.0 / _SHARP)
    return np.asarray(_SCALE * scale * speed**0.75 * part)


def point_rolling_force(contact: PointContact, load: ArrayLike) -> Array:
    """Hydrodynamic rolling force of a point contact on each surface.

    F/(E' Rx^2) = 2 a/Rx U^(3/4) (B + (A U^(-1/12) - B)/(1 + M/6.6)), A = 0.77 c^(-1/3) k^0.12,
    B = 1.8 c^(-1/4)

    with U = 2 eta0 u/(E' Rx), M = c^(1/4) k W/U^(3/4), W = Q/(E' Rx^2), c = b E'/(pi p_h Rx), and k = b/a of
    the semi-axes b along and a across entrainment.

    Parameters
    ----------
    contact : PointContact
        Contact with a load > 0; the load and the pressure-viscosity coefficient have no effect.
    load : array_like, shape (...)
        Loads Q [N], >= 0.

    Returns
    -------
    ndarray, shape (...)
        Force [N]. It goes with the cube root of the load, as the width 2 a, for light and for heavy loads.

    Notes
    -----
    Equation (32) of N. Biboulet and L. Houpert, Hydrodynamic force and moment in pure rolling lubricated
    contacts, part 2: point contacts, Proc. IMechE J 224 (2010), doi:10.1243/13506501JET791. The fit holds
    for k up to 1, M from 0.2 to 800 and L from 4 to 16.

    Examples
    --------
    >>> contact = PointContact(4.7e-3, 0.15, 226e9, 900.0, 4.5, 0.0125, 0.0)
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
