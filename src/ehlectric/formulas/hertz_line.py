"""Hertz contact of two parallel cylinders: reduced radius and modulus, half-width, pressure and gap.

The reduced modulus E' has the factor two throughout: 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array


def reduced_radius(radius_1: float, radius_2: float) -> float:
    """Reduced radius R of two cylinders, 1/R = 1/R1 + 1/R2.

    Parameters
    ----------
    radius_1, radius_2 : float
        Radii R1 and R2 [m]; negative for a concave body, infinite for a plane.

    Returns
    -------
    float
        R [m]. It is negative if the radius of a concave body is smaller than that of the other body.

    Notes
    -----
    Eq. (4) of Morris et al. (2022), doi:10.3390/lubricants10050087.

    Examples
    --------
    >>> reduced_radius(0.02, 0.02)
    0.01
    """
    return 1.0 / (1.0 / radius_1 + 1.0 / radius_2)


def body_compliance(youngs_modulus: float, poissons_ratio: float) -> float:
    """Plane-strain compliance of one body, (1 - nu^2)/E [1/Pa].

    Parameters
    ----------
    youngs_modulus : float
        Young's modulus E [Pa].
    poissons_ratio : float
        Poisson's ratio nu, dimensionless.

    Returns
    -------
    float
        Compliance [1/Pa].

    Examples
    --------
    >>> body_compliance(2.0, 0.0)
    0.5
    """
    return (1.0 - poissons_ratio**2) / youngs_modulus


def reduced_modulus(compliance_1: float, compliance_2: float) -> float:
    """Reduced modulus E' of two bodies, 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.

    Parameters
    ----------
    compliance_1, compliance_2 : float
        Plane-strain compliances (1 - nu^2)/E of the two bodies [1/Pa].

    Returns
    -------
    float
        E' [Pa].

    Notes
    -----
    Eq. (3) of Morris et al. (2022), doi:10.3390/lubricants10050087.

    Examples
    --------
    Two steel bodies, E = 206 GPa and nu = 0.3:

    >>> steel = body_compliance(206e9, 0.3)
    >>> round(reduced_modulus(steel, steel) / 1e9, 1)
    226.4
    """
    return 2.0 / (compliance_1 + compliance_2)


def line_half_width(load_per_length: float, radius: float, modulus: float) -> float:
    """Half-width of a dry line contact, b = sqrt(8 w R/(pi E')).

    Parameters
    ----------
    load_per_length : float
        Load per length w [N/m].
    radius : float
        Reduced radius R [m].
    modulus : float
        Reduced modulus E' [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.

    Returns
    -------
    float
        b [m].

    Notes
    -----
    Eq. (2) of Morris et al. (2022), doi:10.3390/lubricants10050087.

    Examples
    --------
    >>> round(line_half_width(1.57e6, 14.1e-3, 226e9) * 1e6, 1)
    499.4
    """
    return float(np.sqrt(8.0 * load_per_length * radius / (np.pi * modulus)))


def line_max_pressure(load_per_length: float, radius: float, modulus: float) -> float:
    """Largest Hertz pressure of a line contact, p_h = 2 w/(pi b).

    Parameters
    ----------
    load_per_length : float
        Load per length w [N/m].
    radius : float
        Reduced radius R [m].
    modulus : float
        Reduced modulus E' [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.

    Returns
    -------
    float
        p_h [Pa].

    Examples
    --------
    >>> round(line_max_pressure(1.57e6, 14.1e-3, 226e9) / 1e9, 3)
    2.001
    """
    half_width = line_half_width(load_per_length, radius, modulus)
    return 2.0 * load_per_length / (np.pi * half_width)


def line_load(max_pressure: float, radius: float, modulus: float) -> float:
    """Load per length of a line contact from its largest Hertz pressure, w = 2 pi R p_h^2/E'.

    Parameters
    ----------
    max_pressure : float
        Largest Hertz pressure p_h [Pa].
    radius : float
        Reduced radius R [m].
    modulus : float
        Reduced modulus E' [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.

    Returns
    -------
    float
        w [N/m].

    Examples
    --------
    >>> round(line_load(1e9, 14.1e-3, 226e9) / 1e5, 3)
    3.92
    """
    return 2.0 * np.pi * radius * max_pressure**2 / modulus


def line_pressure(x: ArrayLike) -> Array:
    """Hertz pressure of a line contact, P = sqrt(1 - X^2) inside the contact and zero outside.

    Parameters
    ----------
    x : array_like, shape (...)
        Position X = x/b with the half-width b, dimensionless.

    Returns
    -------
    ndarray, shape (...)
        P = p/p_h, dimensionless.

    Examples
    --------
    >>> [float(p) for p in line_pressure([0.0, 1.0, 2.0])]
    [1.0, 0.0, 0.0]
    """
    return np.sqrt(np.maximum(0.0, 1.0 - np.asarray(x, dtype=float) ** 2))


def line_gap(x: ArrayLike) -> Array:
    """Gap of a dry line contact, zero inside the contact.

    H = (abs(X) sqrt(X^2 - 1) - ln(abs(X) + sqrt(X^2 - 1)))/2 for abs(X) > 1

    Parameters
    ----------
    x : array_like, shape (...)
        Position X = x/b with the half-width b, dimensionless.

    Returns
    -------
    ndarray, shape (...)
        H = h R/b^2, dimensionless.

    Notes
    -----
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


def line_opening(x: ArrayLike, half_width: float, radius: float) -> Array:
    """Elastic deflection of a dry line contact: the distance by which it opens the gap of two parabolas.

    Parameters
    ----------
    x : array_like, shape (...)
        Position [m].
    half_width, radius : float
        Half-width b of the dry contact and reduced radius R [m].

    Returns
    -------
    ndarray, shape (...)
        Deflection [m], up to a constant: it is zero at x = 0.

    Examples
    --------
    Inside the contact the deflection makes the parabolas flat:

    >>> round(float(line_opening(1e-4, 2e-4, 0.01) / (1e-4**2 / (2 * 0.01))), 6)
    -1.0
    """
    position = np.asarray(x, dtype=float)
    opening: Array = half_width**2 / radius * line_gap(position / half_width) - 0.5 * position**2 / radius
    return opening
