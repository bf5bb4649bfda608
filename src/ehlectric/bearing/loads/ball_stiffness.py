"""Stiffness of the contacts of balls, exact and as a polynomial that is quick to compute. SI units."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.polynomial import Chebyshev

from ehlectric.arrays import Array
from ehlectric.bearing.loads.geometry import BallBearing
from ehlectric.formulas.hertz_point import dry_contact

# Degree of the polynomial of log K. K changes smoothly, by a few percent over all angles: the relative error
# is below 1e-11, except where a handful of balls fill their pitch circle.
_DEGREE = 24


def contact_stiffness(bearing: BallBearing, modulus: float, angle: float, *, inner: bool) -> float:
    """Stiffness K of Q = K delta^(3/2), from the exact Hertz ellipse of a ball and a ring.

    Parameters
    ----------
    bearing : BallBearing
        Geometry of the bearing.
    modulus : float
        Reduced modulus E' of ball and ring [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.
    angle : float
        Contact angle [rad].
    inner : bool
        Whether the contact is with the inner ring.

    Returns
    -------
    float
        Stiffness K [N/m^(3/2)].

    Examples
    --------
    Approach in micrometres under a load of 870 N:

    >>> bearing = BallBearing(9, 11.906e-3, 60e-3, 0.52, 0.52, radial_clearance=10e-6)
    >>> k = contact_stiffness(bearing, 226e9, 0.0, inner=True)
    >>> round(1e6 * (870.0 / k) ** (2 / 3), 2)
    9.24
    """
    radii = bearing.radii(angle, inner=inner)
    return float(dry_contact(1.0, radii.radius_x, radii.radius_y, modulus).approach ** -1.5)


@lru_cache(maxsize=32)
def stiffness_laws(bearing: BallBearing, modulus: float) -> tuple[Chebyshev, Chebyshev]:
    """Polynomials of log K in the cosine of the contact angle, for the inner and the outer contact.

    Parameters
    ----------
    bearing : BallBearing
        Geometry of the bearing.
    modulus : float
        Reduced modulus E' of ball and ring [Pa].

    Returns
    -------
    inner, outer : Chebyshev
        Natural logarithm of K [N/m^(3/2)] over the cosine, from 0 to 1.
    """

    def law(*, inner: bool) -> Chebyshev:
        def logarithm(cosines: Array) -> Array:
            angles = np.arccos(cosines)
            return np.log([contact_stiffness(bearing, modulus, float(a), inner=inner) for a in angles])

        return Chebyshev.interpolate(logarithm, _DEGREE, domain=[0.0, 1.0])

    return law(inner=True), law(inner=False)
