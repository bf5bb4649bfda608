"""The dry contact over an ellipse, beyond what the package has of it."""

import numpy as np
from scipy.integrate import quad
from scipy.special import elliprd


def radii_ratio(k):
    """Ry/Rx of an ellipse whose semi-axis across is k times that along (Johnson, eq. 4.28)."""
    return float(elliprd(0.0, k**2, 1.0) / elliprd(0.0, 1.0, k**2))


def potential_outside(x, y, k):
    """Integral of P/r of the Hertz pressure beyond its ellipse of semi-axes 1 and k.

    (pi k/2) times that of (1 - x^2/(1 + w) - y^2/(k^2 + w))/sqrt(w (1 + w) (k^2 + w)) from the w > 0 on where
    the bracket vanishes (K. L. Johnson, Contact Mechanics, 1985, section 3.5). With w = low/u^2 it is over
    0 < u < 1.
    """
    b = 1.0 + k**2 - x**2 - y**2
    low = 0.5 * (-b + np.sqrt(b**2 - 4.0 * (k**2 - x**2 * k**2 - y**2)))

    def integrand(u):
        w = low / u**2
        bracket = 1.0 - x**2 / (1.0 + w) - y**2 / (k**2 + w)
        return bracket / np.sqrt(w * (1.0 + w) * (k**2 + w)) * 2.0 * low / u**3

    return 0.5 * np.pi * k * quad(integrand, 0.0, 1.0, epsabs=1e-12, epsrel=1e-11)[0]
