"""Numbers of oils by another way than that of the package."""

import math

from scipy.special import gamma, gammaincc


def alpha_star(alpha, z=0.67, pressure=0.198e9):
    """Reciprocal asymptotic coefficient of Roelands' law [1/Pa], in closed form.

    With u = (1 + p/p0)^z and c = alpha p0/z, the integral of eta0/eta over the pressure is
    (p0/z) e^c c^(-1/z) Gamma(1/z, c), where Gamma is the upper incomplete gamma function.
    """
    c = alpha * pressure / z
    upper = gammaincc(1.0 / z, c) * gamma(1.0 / z)
    return z / (pressure * math.exp(c) * c ** (-1.0 / z) * upper)
