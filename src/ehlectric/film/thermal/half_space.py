"""Surface temperature of a half-space that moves under a heat flux."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import matmul_toeplitz
from scipy.special import k0e, k1e

from ehlectric.arrays import Array
from ehlectric.film.thermal.physics import Body

# Peclet number u b/(2 kappa) above which the fast limit replaces the exact solution: they differ by less than
# 1e-3 there, and the fast limit does not act upstream.
_FAST = 1000.0

# Least Peclet number. The temperature of a body at rest under a line contact has no steady state; it rises as
# the logarithm of time.
_SLOWEST = 0.01

# Influence upstream over that downstream above which a body counts as slow.
_SLOW = 0.02


@dataclass(frozen=True, eq=False)
class Surface:
    """Surface of a moving half-space on a uniform grid along its motion.

    Attributes
    ----------
    bulk : float
        Temperature of the body far from the contact [K].
    downstream : ndarray, shape (nx,)
        Temperature rise at 0, 1, ... cells behind a cell with unit flux [K m^2/W].
    upstream : ndarray, shape (nx,)
        Temperature rise at 0, 1, ... cells before a cell with unit flux; the first is zero, as the cell
        itself belongs to ``downstream``.
    """

    bulk: float
    downstream: Array
    upstream: Array

    @property
    def is_slow(self) -> bool:
        """Whether a flux heats much of the surface upstream of itself."""
        return float(self.upstream.sum()) > _SLOW * float(self.downstream.sum())

    def rise(self, flux: Array) -> Array:
        """Temperature rise (nx, ny) [K] by a flux (nx, ny) into the body [W/m^2]."""
        return np.asarray(self.downstream[0] * flux + self.rise_behind(flux) + self.rise_ahead(flux))

    def rise_behind(self, flux: Array) -> Array:
        """Part of the temperature rise (n, ny) [K] at the first n nodes by the flux further upstream."""
        nodes = len(flux)
        column = np.concatenate([[0.0], self.downstream[1:nodes]])
        return np.asarray(matmul_toeplitz((column, np.zeros(nodes)), flux))

    def rise_ahead(self, flux: Array) -> Array:
        """Part of the temperature rise (nx, ny) [K] by the flux further downstream."""
        if not self.upstream.any():
            return np.zeros_like(flux)
        return np.asarray(matmul_toeplitz((np.zeros(self.upstream.size), self.upstream), flux))


def moving_surface(body: Body, speed: float, *, nodes: int, spacing: float, half_width: float) -> Surface:
    """Surface of a body that moves along x under a flux that is constant in each cell of a grid.

    Parameters
    ----------
    body : Body
        Thermal properties and bulk temperature.
    speed : float
        Speed along x [m/s], >= 0.
    nodes : int
        Number of nodes nx; each is the middle of its cell.
    spacing : float
        Length of a cell [m].
    half_width : float
        Half-width of the contact [m], the length of the Peclet number.

    Returns
    -------
    Surface
        Influence of the flux in a cell on the temperature at the nodes.

    Notes
    -----
    H. S. Carslaw and J. C. Jaeger, Conduction of Heat in Solids, 2nd ed., Oxford 1959, sections 2.9 (fast
    limit) and 10.7: a line source on a half-space gives T = Q/(pi k) exp(xi) K0(abs(xi)), xi = u x/(2 kappa).
    The integral over a cell is in closed form, as d/dxi [xi exp(xi) (K0 + K1)] = exp(xi) K0.

    Examples
    --------
    Far downstream of the front the fast limit is 2 q sqrt(x/(pi rho c k u)), exactly at the nodes:

    >>> steel = Body(300.0, 46.0, 470.0, 7850.0)
    >>> surface = moving_surface(steel, 50.0, nodes=100, spacing=1e-5, half_width=1e-3)
    >>> x = 1e-5 * (np.arange(100) + 0.5)
    >>> exact = 2.0 * 1e8 * np.sqrt(x / (np.pi * 7850.0 * 470.0 * 46.0 * 50.0))
    >>> bool(np.allclose(surface.rise(np.full((100, 1), 1e8))[:, 0], exact))
    True
    """
    edges = spacing * (np.arange(nodes + 1, dtype=np.float64) - 0.5)
    per_length = speed / (2.0 * body.diffusivity)
    if per_length * half_width > _FAST:
        scale = np.sqrt(np.pi * body.density * body.heat_capacity * body.thermal_conductivity * speed)
        downstream = np.diff(2.0 * np.sqrt(np.maximum(edges, 0.0))) / scale
        return Surface(body.temperature, downstream, np.zeros(nodes))
    per_length = max(per_length, _SLOWEST / half_width)
    scale = np.pi * body.thermal_conductivity * per_length
    downstream = np.diff(_line_source(per_length * edges)) / scale
    upstream = np.diff(-_line_source(-per_length * edges)) / scale
    upstream[0] = 0.0
    return Surface(body.temperature, downstream, upstream)


def _line_source(xi: Array) -> Array:
    """Integral of exp(t) K0(abs(t)) from 0 to xi, of any sign."""
    size = np.abs(xi)
    near = np.where(size > 0.0, size, 1.0)
    k0, k1 = k0e(near), k1e(near)
    behind = near * (k0 + k1) - 1.0
    ahead = -(near * np.exp(-2.0 * near) * (k0 - k1) + 1.0)
    return np.where(size > 0.0, np.where(xi > 0.0, behind, ahead), 0.0)
