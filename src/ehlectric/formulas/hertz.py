"""Hertz contact of two cylinders along a line, and of two bodies over an ellipse: size, pressure, approach
and gap.

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

from ehlectric.arrays import Array, N, Numbers, as_float
from ehlectric.formulas.carlson import both_rd, complete_rd, complete_rd_pair, complete_rf


def reduced_radius(radius_1: N, radius_2: N) -> N:
    """Reduced radius R of two cylinders, 1/R = 1/R1 + 1/R2. ``radius_1`` and ``radius_2``, radii R1 and R2
    [m]; negative for a concave body, infinite for a plane. Returns R [m]; it is negative if the radius of a
    concave body is smaller than the radius of the other body.

    Eq. (4) of Morris et al. (2022), doi:10.3390/lubricants10050087.

    Examples
    --------
    >>> reduced_radius(0.02, 0.02)
    0.01
    """
    return 1.0 / (1.0 / radius_1 + 1.0 / radius_2)


def body_compliance(youngs_modulus: N, poissons_ratio: N) -> N:
    """Plane-strain compliance of one body, (1 - nu^2)/E [1/Pa]. ``youngs_modulus``, Young's modulus E [Pa];
    ``poissons_ratio``, Poisson's ratio nu, dimensionless.

    Examples
    --------
    >>> body_compliance(2.0, 0.0)
    0.5
    """
    return (1.0 - poissons_ratio**2) / youngs_modulus


def reduced_modulus(compliance_1: N, compliance_2: N) -> N:
    """Reduced modulus E' of two bodies, 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2. ``compliance_1`` and
    ``compliance_2``, plane-strain compliances (1 - nu^2)/E of the two bodies [1/Pa]. Returns E' [Pa].

    Eq. (3) of Morris et al. (2022), doi:10.3390/lubricants10050087.

    Examples
    --------
    Two steel bodies, E = 206 GPa and nu = 0.3:

    >>> steel = body_compliance(206e9, 0.3)
    >>> round(reduced_modulus(steel, steel) / 1e9, 1)
    226.4
    """
    return 2.0 / (compliance_1 + compliance_2)


def line_half_width(*, load_per_length: Numbers, radius: Numbers, modulus: Numbers) -> Numbers:
    """Half-width of a dry line contact, b = sqrt(8 w R/(pi E')). ``load_per_length`` [N/m]; ``radius``,
    reduced radius R [m]; ``modulus``, reduced modulus E' [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.
    Returns b [m].

    Eq. (2) of Morris et al. (2022), doi:10.3390/lubricants10050087.

    Examples
    --------
    >>> round(line_half_width(load_per_length=1.57e6, radius=14.1e-3, modulus=226e9) * 1e6, 1)
    499.4
    """
    return as_float(np.sqrt(8.0 * load_per_length * radius / (np.pi * modulus)))


def line_max_pressure(*, load_per_length: Numbers, radius: Numbers, modulus: Numbers) -> Numbers:
    """Largest Hertz pressure of a line contact, p_h = 2 w/(pi b). ``load_per_length`` [N/m]; ``radius``,
    reduced radius R [m]; ``modulus``, reduced modulus E' [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.
    Returns p_h [Pa].

    Examples
    --------
    >>> round(line_max_pressure(load_per_length=1.57e6, radius=14.1e-3, modulus=226e9) / 1e9, 3)
    2.001
    """
    half_width = line_half_width(load_per_length=load_per_length, radius=radius, modulus=modulus)
    return 2.0 * load_per_length / (np.pi * half_width)


def line_load(max_pressure: float, radius: float, modulus: float) -> float:
    """Load per length of a line contact from its largest Hertz pressure, w = 2 pi R p_h^2/E'.
    ``max_pressure``, largest Hertz pressure p_h [Pa]; ``radius``, reduced radius R [m]; ``modulus``, reduced
    modulus E' [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2. Returns w [N/m].

    Examples
    --------
    >>> round(line_load(1e9, 14.1e-3, 226e9) / 1e5, 3)
    3.92
    """
    return 2.0 * np.pi * radius * max_pressure**2 / modulus


def line_pressure(x: ArrayLike) -> Array:
    """Hertz pressure of a line contact, P = sqrt(1 - X^2) inside the contact and zero outside. ``x``,
    position X = x/b with the half-width b, dimensionless, shape (...). Returns P = p/p_h, dimensionless,
    shape (...).

    Examples
    --------
    >>> [float(p) for p in line_pressure([0.0, 1.0, 2.0])]
    [1.0, 0.0, 0.0]
    """
    return np.sqrt(np.maximum(0.0, 1.0 - np.asarray(x, dtype=float) ** 2))


def line_gap(x: ArrayLike) -> Array:
    """Gap of a dry line contact, zero inside the contact.

    H = (abs(X) sqrt(X^2 - 1) - ln(abs(X) + sqrt(X^2 - 1)))/2 for abs(X) > 1

    ``x``, position X = x/b with the half-width b, dimensionless, shape (...). Returns H = h R/b^2,
    dimensionless, shape (...).

    K. L. Johnson, Contact Mechanics, 1985, section 4.2, doi:10.1017/CBO9781139171731.

    Examples
    --------
    >>> round(float(line_gap(2.0)), 4)
    1.0736
    """
    distance = np.maximum(1.0, np.abs(np.asarray(x, dtype=float)))
    root = np.sqrt(distance**2 - 1.0)
    gap: Array = 0.5 * (distance * root - np.log(distance + root))
    return gap


def line_opening(x: ArrayLike, half_width: Numbers, radius: Numbers) -> Array:
    """Elastic deflection of a dry line contact: the distance by which it opens the gap of two parabolas.
    ``x`` [m], shape (...); ``half_width`` and ``radius``, half-width b of the dry contact and reduced radius
    R [m]. Returns deflection [m], up to a constant: it is zero at x = 0, shape (...).

    Examples
    --------
    Inside the contact the deflection makes the parabolas flat:

    >>> round(float(line_opening(1e-4, 2e-4, 0.01) / (1e-4**2 / (2 * 0.01))), 6)
    -1.0
    """
    position = np.asarray(x, dtype=float)
    opening: Array = half_width**2 / radius * line_gap(position / half_width) - 0.5 * position**2 / radius
    return opening


# Absolute ln(Ry/Rx) below which the ratio of the semi-axes is (Ry/Rx)^(2/3) to the last digit: the next term
# is of third order.
_CIRCLE = 1e-6


@dataclass(frozen=True)
class DryContact:
    """Semi-axes, largest pressure and approach of the dry (Hertz) contact of two bodies, or of many contacts.

    Arrays broadcast with positions in ``point_deflection``.
    """

    # semi_axis_x and semi_axis_y: semi-axes of the contact ellipse, b along and a across entrainment [m].
    semi_axis_x: Numbers
    semi_axis_y: Numbers
    max_pressure: Numbers  # largest Hertz pressure p_h [Pa]
    approach: (
        Numbers  # distance by which points of the two bodies far from the contact approach each other [m]
    )


def axis_ratio(radius_x: Numbers, radius_y: Numbers) -> Numbers:
    """Ratio k of the semi-axes of the dry contact: across entrainment over along entrainment.

    The equation Ry/Rx = R_D(0, k^2, 1)/R_D(0, 1, k^2) is solved for k, with Carlson's elliptic integral R_D.

    ``radius_x`` and ``radius_y``, reduced radii Rx along and Ry across entrainment [m], shape (...). Returns
    k, dimensionless, shape (...); above 1 if ``radius_y`` is larger than ``radius_x``.

    K. L. Johnson, Contact Mechanics, 1985, eq. (4.28), doi:10.1017/CBO9781139171731.

    Examples
    --------
    >>> axis_ratio(0.01, 0.01)
    1.0
    >>> axis_ratio(np.array([0.01, 0.01]), np.array([0.01, 0.1])).round(4).tolist()
    [1.0, 4.4994]
    """
    if np.ndim(radius_x) == np.ndim(radius_y) == 0:
        return _axis_ratio(float(radius_x), float(radius_y))
    target = np.log(radius_y / radius_x)
    near = np.abs(target) < _CIRCLE
    return np.exp(np.where(near, 2.0 / 3.0 * target, _log_ratios(np.where(near, _CIRCLE, target))))


# Share of ln(Ry/Rx) that ln(k) is about, and the Newton step after which the next one is below rounding.
_USUAL_SHARE, _LAST_STEP = 0.65, 1e-9


def _log_ratios(target: Array) -> Array:
    """Return ln(k) for ln(Ry/Rx) of contacts, none of which is a circle, by Newton's method.

    With P = R_D(0, k^2, 1) and Q = R_D(0, 1, k^2), whose derivatives follow from both of them, the slope of
    ln(P/Q) over ln(k) is 3 - D (k^2/P + 1/Q), D = (P - Q)/(k^2 - 1).
    """
    log_ratio, step = _USUAL_SHARE * target, np.array(np.inf)
    while np.max(np.abs(step)) > _LAST_STEP:
        k2 = np.exp(2.0 * log_ratio)
        p, q = complete_rd_pair(k2, np.ones_like(k2))
        slope = 3.0 - (p - q) / (k2 - 1.0) * (k2 / p + 1.0 / q)
        step = (np.log(p / q) - target) / slope
        log_ratio = log_ratio - step
    return np.asarray(log_ratio)


@lru_cache(maxsize=256)
def _axis_ratio(radius_x: float, radius_y: float) -> float:
    """Ratio of the semi-axes of one contact, computed once, as all loads of a contact have the same one."""
    target = float(np.log(radius_y / radius_x))
    if abs(target) < _CIRCLE:
        return float(np.exp(2.0 / 3.0 * target))
    return float(np.exp(_log_ratios(np.array([target]))[0]))


def dry_contact(load: Numbers, radius_x: Numbers, radius_y: Numbers, modulus: Numbers) -> DryContact:
    """Contact ellipse, largest pressure and approach of two loaded bodies.

    b^3 = 2 F Rx R_D(0, k^2, 1)/(pi E') for the semi-axis b along entrainment, with Carlson's elliptic
    integral R_D. The semi-axis across entrainment is k b, and p_h = 3 F/(2 pi k b^2).

    ``load`` [N]; ``radius_x`` and ``radius_y``, reduced radii Rx along and Ry across entrainment [m];
    ``modulus``, reduced modulus E' [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2; all of shape (...).
    Returns semi-axes [m], largest pressure [Pa] and approach [m], shape (...).

    K. L. Johnson, Contact Mechanics, 1985, section 4.2, doi:10.1017/CBO9781139171731.

    Examples
    --------
    A steel ball of 10 mm radius on a plane, 20 N:

    >>> contact = dry_contact(20.0, 0.01, 0.01, 226e9)
    >>> round(contact.semi_axis_x * 1e6, 1), round(contact.max_pressure / 1e9, 4)
    (109.9, 0.7906)
    """
    k = axis_ratio(radius_x, radius_y)
    of_axes, of_approach = as_float(complete_rd(k**2, 1.0)), as_float(complete_rf(1.0, k**2))
    semi_axis = (2.0 * load * radius_x * of_axes / (np.pi * modulus)) ** (1.0 / 3.0)
    pressure = 1.5 * load / (np.pi * k * semi_axis**2)
    approach = 2.0 * pressure * k * semi_axis / modulus * of_approach
    return DryContact(semi_axis, k * semi_axis, pressure, approach)


def point_load(max_pressure: float, radius_x: float, radius_y: float, modulus: float) -> float:
    """Load of a point contact from its largest Hertz pressure.

    F = (2 pi k/3) p_h b^2 with b = 4 p_h Rx k R_D(0, k^2, 1)/(3 E'), with Carlson's elliptic integral R_D.

    ``max_pressure``, largest Hertz pressure p_h [Pa]; ``radius_x`` and ``radius_y``, reduced radii Rx along
    and Ry across entrainment [m]; ``modulus``, reduced modulus E' [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 -
    nu2^2)/E2. Returns load F [N], proportional to the cube of the pressure.

    Examples
    --------
    >>> round(point_load(1e9, 0.01, 0.01, 226e9), 2)
    40.47
    """
    k = float(axis_ratio(radius_x, radius_y))
    semi_axis = 4.0 * max_pressure * radius_x * k * float(complete_rd(k**2, 1.0)) / (3.0 * modulus)
    return 2.0 * np.pi / 3.0 * k * max_pressure * semi_axis**2


def point_pressure(x: ArrayLike, y: ArrayLike, ratio: float) -> Array:
    """Hertz pressure of a point contact, P = sqrt(1 - X^2 - (Y/k)^2) inside the contact and zero outside.

    ``x`` and ``y``, positions X = x/b and Y = y/b with the semi-axis b along entrainment, dimensionless;
    ``ratio``, k, the semi-axis across entrainment over the semi-axis along it, dimensionless. Returns P =
    p/p_h, dimensionless, shape (...).

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

    ``x`` and ``y``, positions along and across entrainment [m]; ``modulus``, reduced modulus E' [Pa], with
    2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2. Returns deflection [m], shape (...); in the middle of the contact
    it is the approach, far away 2 F/(pi E' r).

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
