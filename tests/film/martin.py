"""Exact film of a rigid isoviscous line contact with the Reynolds exit condition.

Martin (1916) with the exit of Swift and Stieber. Gap h = h0 + x^2/(2 R), theta = atan(x/sqrt(2 R h0)):
the Reynolds equation integrates to p = (12 eta u sqrt(2 R h0)/h0^2) (A - c B), A and B the integrals of
cos^2 and cos^4 of theta, c = h*/h0 = 1/cos^2(theta_e), and p = dp/dx = 0 at the exit theta_e.
"""

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq


def _cos2(theta):
    return theta / 2 + np.sin(2 * theta) / 4


def _cos4(theta):
    return 3 * theta / 8 + np.sin(2 * theta) / 4 + np.sin(4 * theta) / 32


def exit_angle(inlet):
    """theta_e for an inlet at ``inlet`` = x_in/sqrt(2 R h0)."""
    start = np.arctan(inlet)

    def pressure_at_exit(end):
        return (_cos2(end) - _cos2(start)) * np.cos(end) ** 2 - (_cos4(end) - _cos4(start))

    return brentq(pressure_at_exit, 1e-9, 0.6, xtol=1e-15)


def film_coefficient(inlet=-np.inf):
    """k in h0 = k eta u R/w, u the mean speed: 4.894968... for an unlimited inlet."""
    start, end = np.arctan(inlet), exit_angle(inlet)
    c = 1 / np.cos(end) ** 2

    def antiderivative(theta):
        return (-np.cos(2 * theta) + c * np.cos(theta) ** 4) / 4

    return 24 * (antiderivative(start) - antiderivative(end))


def film_coefficient_by_quadrature(inlet):
    """The same by numerical quadrature in x, without the closed forms."""

    def gradient(x, c):
        return (1 + x * x - c) / (1 + x * x) ** 3

    def pressure_at(end):
        return quad(gradient, inlet, end, args=(1 + end * end,), epsabs=1e-14)[0]

    end = brentq(pressure_at, 1e-3, 1.0, xtol=1e-14)
    return -24 * quad(lambda x: x * gradient(x, 1 + end * end), inlet, end, epsabs=1e-14)[0]
