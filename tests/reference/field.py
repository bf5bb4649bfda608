"""Exact electric fields between conductors."""

import numpy as np
from scipy.constants import epsilon_0


def sinusoidal_wall(amplitude, wavenumber, gap):
    """Fields relative to V/h at the crest and on the flat wall opposite, and C/C0, to second order.

    One wall y = 0, the other y = h - A cos(q x); perturbation of Laplace's equation in A/h.
    """
    q, qh = wavenumber, wavenumber * gap
    coth = 1 / np.tanh(qh)
    a = amplitude
    crest = 1 + a * q * coth + a**2 * (q * coth / (2 * gap) + q**2 / (2 * np.sinh(qh) ** 2))
    flat = 1 + a * q / np.sinh(qh) + a**2 * q * coth / 2 * (1 / gap + 2 * q / np.sinh(2 * qh))
    capacitance = 1 + a**2 * q * coth / (2 * gap)
    return crest, flat, capacitance


def cylinder_potential(x, y, radius, gap):
    """Potential between a grounded plane y = 0 and a cylinder at 1 V, in bipolar coordinates."""
    focus = np.sqrt(gap**2 + 2 * gap * radius)
    return np.log((x**2 + (y + focus) ** 2) / (x**2 + (y - focus) ** 2)) / (2 * np.arccosh(1 + gap / radius))


def cylinder_plane_charge(x, radius, gap):
    """Charge of the plane within abs(x) per length and volt, in vacuum [F/m]."""
    focus = np.sqrt(gap**2 + 2 * gap * radius)
    return 4 * epsilon_0 * np.arctan(x / focus) / np.arccosh(1 + gap / radius)
