"""Hertz contact of two bodies over an ellipse: semi-axes, pressure and approach.

The reduced modulus E' has the factor two throughout: 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2. The x axis runs
along entrainment and the y axis across it. Either may be the longer axis of the ellipse.

The ellipse has the semi-axes b along x and a along y. Its pressure p_h sqrt(1 - (x/b)^2 - (y/a)^2) opens the
gap between the surfaces by (2/(pi E')) times the integral of p/r. This deflection is (Johnson, section 3.5)

    (p_h a b/E') I,    I = int_0^inf (1 - x^2/(b^2 + w) - y^2/(a^2 + w)) dw/sqrt(w (a^2 + w) (b^2 + w)).

The three integrals in I are complete elliptic integrals in Carlson's symmetric form: 2 R_F(0, a^2, b^2), and
(2/3) R_D(0, a^2, b^2) with a and b in both orders. This form needs no distinction of the longer axis, and
loses no accuracy for a circle.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq
from scipy.special import elliprd, elliprf

from ehlectric.arrays import Array
from ehlectric.formulas.elliptic import both_rd

# Absolute ln(Ry/Rx) below which the ratio of the semi-axes is (Ry/Rx)^(2/3) to the last digit: the next term
# is of third order.
_CIRCLE = 1e-6


@dataclass(frozen=True)
class DryContact:
    """Semi-axes, largest pressure and approach of the dry (Hertz) contact of two bodies.

    The values may be arrays that broadcast with positions, for several contacts at once.

    Attributes
    ----------
    semi_axis_x, semi_axis_y : float
        Semi-axes of the contact ellipse, b along and a across entrainment [m].
    max_pressure : float
        Largest Hertz pressure p_h [Pa].
    approach : float
        Distance by which points of the two bodies far from the contact approach each other [m].
    """

    semi_axis_x: float
    semi_axis_y: float
    max_pressure: float
    approach: float


@lru_cache(maxsize=256)
def axis_ratio(radius_x: float, radius_y: float) -> float:
    """Ratio k of the semi-axes of the dry contact: across entrainment over along entrainment.

    The equation Ry/Rx = R_D(0, k^2, 1)/R_D(0, 1, k^2) is solved for k, with Carlson's elliptic integral R_D.

    Parameters
    ----------
    radius_x, radius_y : float
        Reduced radii Rx along and Ry across entrainment [m].

    Returns
    -------
    float
        k, dimensionless; above 1 if ``radius_y`` is larger than ``radius_x``.

    Notes
    -----
    K. L. Johnson, Contact Mechanics, 1985, eq. (4.28), doi:10.1017/CBO9781139171731.

    Examples
    --------
    >>> axis_ratio(0.01, 0.01)
    1.0
    >>> round(axis_ratio(0.01, 0.1), 4)
    4.4994
    """
    target = float(np.log(radius_y / radius_x))
    if abs(target) < _CIRCLE:
        return float(np.exp(2.0 / 3.0 * target))

    def excess(log_ratio: float) -> float:
        k2 = np.exp(2.0 * log_ratio)
        return float(np.log(elliprd(0.0, k2, 1.0) / elliprd(0.0, 1.0, k2))) - target

    # k lies between 1, the value of a circle, and Ry/Rx.
    root = brentq(excess, 0.0, target, xtol=1e-15, rtol=1e-14)
    return float(np.exp(root))


def dry_contact(load: float, radius_x: float, radius_y: float, modulus: float) -> DryContact:
    """Contact ellipse, largest pressure and approach of two loaded bodies.

    b^3 = 2 F Rx R_D(0, k^2, 1)/(pi E') for the semi-axis b along entrainment, with Carlson's elliptic
    integral R_D. The semi-axis across entrainment is k b, and p_h = 3 F/(2 pi k b^2).

    Parameters
    ----------
    load : float
        Load F [N].
    radius_x, radius_y : float
        Reduced radii Rx along and Ry across entrainment [m].
    modulus : float
        Reduced modulus E' [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.

    Returns
    -------
    DryContact
        Semi-axes [m], largest pressure [Pa] and approach [m]. For equal radii R they are those of a circle
        with b^3 = 3 F R/(2 E') and the approach b^2/R.

    Notes
    -----
    K. L. Johnson, Contact Mechanics, 1985, section 4.2, doi:10.1017/CBO9781139171731.

    Examples
    --------
    A steel ball of 10 mm radius on a plane, 20 N:

    >>> contact = dry_contact(20.0, 0.01, 0.01, 226e9)
    >>> round(contact.semi_axis_x * 1e6, 1), round(contact.max_pressure / 1e9, 4)
    (109.9, 0.7906)
    """
    k = axis_ratio(radius_x, radius_y)
    semi_axis = float((2.0 * load * radius_x * elliprd(0.0, k**2, 1.0) / (np.pi * modulus)) ** (1.0 / 3.0))
    pressure = 1.5 * load / (np.pi * k * semi_axis**2)
    approach = 2.0 * pressure * k * semi_axis / modulus * float(elliprf(0.0, 1.0, k**2))
    return DryContact(semi_axis, k * semi_axis, pressure, approach)


def point_load(max_pressure: float, radius_x: float, radius_y: float, modulus: float) -> float:
    """Load of a point contact from its largest Hertz pressure.

    F = (2 pi k/3) p_h b^2 with b = 4 p_h Rx k R_D(0, k^2, 1)/(3 E'), with Carlson's elliptic integral R_D.

    Parameters
    ----------
    max_pressure : float
        Largest Hertz pressure p_h [Pa].
    radius_x, radius_y : float
        Reduced radii Rx along and Ry across entrainment [m].
    modulus : float
        Reduced modulus E' [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.

    Returns
    -------
    float
        Load F [N], proportional to the cube of the pressure.

    Examples
    --------
    >>> round(point_load(1e9, 0.01, 0.01, 226e9), 2)
    40.47
    """
    k = axis_ratio(radius_x, radius_y)
    semi_axis = 4.0 * max_pressure * radius_x * k * float(elliprd(0.0, k**2, 1.0)) / (3.0 * modulus)
    return 2.0 * np.pi / 3.0 * k * max_pressure * semi_axis**2


def point_pressure(x: ArrayLike, y: ArrayLike, ratio: float) -> Array:
    """Hertz pressure of a point contact, P = sqrt(1 - X^2 - (Y/k)^2) inside the contact and zero outside.

    Parameters
    ----------
    x, y : array_like, shapes that broadcast to (...)
        Positions X = x/b and Y = y/b with the semi-axis b along entrainment, dimensionless.
    ratio : float
        k, the semi-axis across entrainment over the semi-axis along it, dimensionless.

    Returns
    -------
    ndarray, shape (...)
        P = p/p_h, dimensionless.

    Examples
    --------
    >>> [float(p) for p in point_pressure([0.0, 0.6, 0.0], [0.0, 0.0, 2.0], 2.0)]
    [1.0, 0.8, 0.0]
    """
    inside = 1.0 - np.asarray(x, dtype=float) ** 2 - (np.asarray(y, dtype=float) / ratio) ** 2
    return np.sqrt(np.maximum(0.0, inside))


def point_deflection(x: ArrayLike, y: ArrayLike, contact: DryContact, modulus: float) -> Array:
    """Elastic deflection under a Hertz pressure: the distance by which it opens the gap of two bodies.

    The deflection is computed both inside and outside the contact ellipse.

    Parameters
    ----------
    x, y : array_like, shapes that broadcast to (...)
        Positions along and across entrainment [m].
    contact : DryContact
        Semi-axes b along and a across entrainment, and largest pressure p_h.
    modulus : float
        Reduced modulus E' [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.

    Returns
    -------
    ndarray, shape (...)
        Deflection [m]. In the middle of the contact it is the approach, far away 2 F/(pi E' r).

    Notes
    -----
    The deflection is (p_h a b/E') I with the integral
    I = int_w0^inf (1 - x^2/(b^2 + w) - y^2/(a^2 + w)) dw/sqrt(w (a^2 + w) (b^2 + w)). Inside the ellipse w0
    is zero; outside it is the positive root w of x^2/(b^2 + w) + y^2/(a^2 + w) = 1. See K. L. Johnson,
    Contact Mechanics, 1985, section 3.5, doi:10.1017/CBO9781139171731.

    Examples
    --------
    Ten semi-axes away the load acts nearly as a point load:

    >>> contact = dry_contact(20.0, 0.01, 0.01, 226e9)
    >>> far = 10.0 * contact.semi_axis_x
    >>> round(float(point_deflection(far, 0.0, contact, 226e9)) / (2 * 20.0 / (np.pi * 226e9 * far)), 3)
    1.001
    """
    x2, y2 = np.square(np.asarray(x, dtype=float)), np.square(np.asarray(y, dtype=float))
    b2, a2 = contact.semi_axis_x**2, contact.semi_axis_y**2
    # Larger root of w^2 - p w - c = 0, without a difference of nearly equal numbers.
    p, c = x2 + y2 - a2 - b2, x2 * a2 + y2 * b2 - a2 * b2
    root = np.sqrt(np.maximum(0.0, p**2 + 4.0 * c))
    with np.errstate(divide="ignore", invalid="ignore"):
        w = np.where(p > 0.0, 0.5 * (p + root), 2.0 * c / (root - p))
    w = np.maximum(0.0, w)
    # R_F follows from the two R_D, which take most of the time: 3 R_F = x R_D(y, z, x) + y R_D(z, x, y)
    # + z R_D(x, y, z), and the sum of the three R_D is 3/sqrt(x y z). No terms cancel.
    at_b, at_a = both_rd(w, a2 + w, b2 + w)
    edge = np.sqrt(w / ((a2 + w) * (b2 + w)))
    integral = 2.0 * edge + 2.0 / 3.0 * ((b2 - x2) * at_b + (a2 - y2) * at_a)
    area = contact.semi_axis_x * contact.semi_axis_y
    deflection: Array = contact.max_pressure * area / modulus * integral
    return deflection
