"""Exact electric fields between conductors."""

import numpy as np
import pytest
from scipy.constants import epsilon_0


def near(value, rel):
    """Approximately, by the relative difference alone: capacitances in farads and areas in square metres are
    below the absolute one that ``pytest.approx`` allows.
    """
    return pytest.approx(value, rel=rel, abs=0.0)


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


def sinusoidal_crest(amplitude, wavenumber, gap, *, waves=24):
    """Field relative to V/h at the crest of one wall y = A cos(q x), the other y = h; any slope up to 0.4.

    The potential is a sum of solutions of Laplace's equation that vanish on the flat wall and decay from the
    wavy wall; collocation on that wall gives their factors.
    """
    q, order = wavenumber, np.arange(1, waves + 1)
    x = np.arange(4 * waves) * 2 * np.pi / q / (4 * waves)
    y = (amplitude * np.cos(q * x))[:, np.newaxis]
    flat = 1 - np.exp(-2 * order * q * gap)
    parts = np.exp(-order * q * y) * (1 - np.exp(-2 * order * q * (gap - y))) / flat
    columns = np.hstack([1 - y / gap, parts * np.cos(order * q * x[:, np.newaxis])])
    factors, *_ = np.linalg.lstsq(columns, -np.ones(x.size), rcond=None)
    assert np.max(np.abs(columns @ factors + 1)) < 1e-8
    at = amplitude
    slopes = -order * q * np.exp(-order * q * at) * (1 + np.exp(-2 * order * q * (gap - at))) / flat
    return gap * abs(-factors[0] / gap + slopes @ factors[1:])


def cylinder_potential(x, y, radius, gap):
    """Potential between a grounded plane y = 0 and a cylinder at 1 V, in bipolar coordinates."""
    focus = np.sqrt(gap**2 + 2 * gap * radius)
    return np.log((x**2 + (y + focus) ** 2) / (x**2 + (y - focus) ** 2)) / (2 * np.arccosh(1 + gap / radius))


def cylinder_plane_charge(x, radius, gap):
    """Charge of the plane within abs(x) per length and volt, in vacuum [F/m]."""
    focus = np.sqrt(gap**2 + 2 * gap * radius)
    return 4 * epsilon_0 * np.arctan(x / focus) / np.arccosh(1 + gap / radius)


def sphere_images(radius, gap):
    """Heights and charges [m, C] of the images of a sphere at 1 V above a grounded plane."""
    heights, charges = [radius + gap], [4 * np.pi * epsilon_0 * radius]
    while charges[-1] > 1e-16 * charges[0]:
        height, charge = heights[-1], charges[-1]
        charges.append(charge * radius / (radius + gap + height))
        heights.append(radius + gap - radius**2 / (radius + gap + height))
    return np.array(heights), np.array(charges)


def sphere_potential(rho, y, radius, gap):
    """Potential between a grounded plane y = 0 and a sphere at 1 V, at distances and heights of one shape."""
    heights, charges = sphere_images(radius, gap)
    rho, y = np.broadcast_arrays(rho, y)
    above, below = (np.hypot(rho[..., np.newaxis], y[..., np.newaxis] + sign * heights) for sign in (-1, 1))
    return (1 / above - 1 / below) @ charges / (4 * np.pi * epsilon_0)


def sphere_plane_charge(rho, radius, gap):
    """Charge of the plane within ``rho`` of the axis [C] at 1 V, in vacuum."""
    heights, charges = sphere_images(radius, gap)
    return np.sum(charges * (1 - heights / np.hypot(heights, rho)))


def sphere_plane_capacitance(radius, gap):
    """Of a sphere over a plane [F]: 4 pi eps0 r sinh(a) sum 1/sinh(n a), cosh(a) = 1 + h/r."""
    a = np.arccosh(1 + gap / radius)
    n = np.arange(1, int(np.ceil(40 / a)) + 1)
    return 4 * np.pi * epsilon_0 * radius * np.sinh(a) * np.sum(1 / np.sinh(n * a))


def egg_crate_wall(amplitude, qx, qy, gap):
    """As ``sinusoidal_wall`` for the wall y = h - A cos(qx x) cos(qy y), at its crest x = y = 0.

    Its square is (1 + cos 2 qx x)(1 + cos 2 qy y)/4: four waves of second order in place of two.
    """
    q, a = np.hypot(qx, qy), amplitude
    coth = 1 / np.tanh(q * gap)
    waves = 2 * np.array([qx, qy, q])
    square = q * coth / 4
    crest = 1 + a * q * coth + a**2 * (square * (1 / gap + np.sum(waves / np.tanh(waves * gap))) - q**2)
    flat = 1 + a * q / np.sinh(q * gap) + a**2 * square * (1 / gap + np.sum(waves / np.sinh(waves * gap)))
    return crest, flat, 1 + a**2 * q * coth / (4 * gap)
