"""The film equations as the paper discretises them, on one grid, with the right sides of a coarse grid.

Written without the package's own film solver, so that the two can check each other. Dimensionless, X = x/b,
P = p/p_h and H = h R/b^2, with the numbers of the paper's equations::

    (7)       L(P, H) = [eps_(i-1/2) P_(i-1) - (eps_(i-1/2) + eps_(i+1/2)) P_i + eps_(i+1/2) P_(i+1)]/dX^2
                        - (wedge of rho H)/dX = source
    (1), (5)  H = H00 + gap - (1/pi) sum K P
    (11)      sum of the trapezoidal rule over P = load

On the grid one solves for, ``source`` is zero, ``gap`` the dry gap and ``load`` pi/2.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.linalg import matmul_toeplitz, toeplitz

from ehlectric.arrays import Array, Mask
from ehlectric.film.flow import Fluid

# Nodes that a row of eq. (7) couples, relative to its own.
NEIGHBOURS = (-2, -1, 0, 1)

# Upstream differences of the wedge term, times dX: weights of nodes i, i-1 and i-2.
_UPSTREAM = {False: (1.0, -1.0, 0.0), True: (1.5, -2.0, 0.5)}


@dataclass(frozen=True)
class Iterate:
    """Pressure P, shape (n,), and integration constant H00."""

    pressure: Array
    h00: float


@dataclass(frozen=True)
class Coefficients:
    """Film, density, eps, and the derivatives of ln rho and ln eta by P at the nodes, each (n,)."""

    thickness: Array
    density: Array
    eps: Array
    log_density_p: Array
    log_viscosity_p: Array


@dataclass(frozen=True)
class FilmEquations:
    """Equations (1), (7) and (11) on one grid.

    Parameters
    ----------
    fluid : Fluid
        Laws over P, velocity parameter and ambient pressure.
    x : ndarray, shape (n,)
        Equidistant nodes.
    gap, source : ndarray, shape (n,)
        Right sides of the film and of the Reynolds equation.
    load : float
        Right side of the load equation.
    second_order : bool
        Upstream wedge of second order; the paper's is of first.
    """

    fluid: Fluid
    x: Array
    gap: Array
    source: Array
    load: float
    second_order: bool

    @property
    def dx(self) -> float:
        """Grid spacing dX."""
        return float((self.x[-1] - self.x[0]) / (self.x.size - 1))

    @cached_property
    def kernel(self) -> Array:
        """-K/pi of eq. (5) over the distance in nodes, shape (n,)."""
        right = (np.arange(self.x.size) + 0.5) * self.dx
        left = right - self.dx
        k = right * (np.log(right) - 1.0) - left * (np.log(np.abs(left)) - 1.0)
        kernel: Array = -k / np.pi
        return kernel

    @cached_property
    def kernel_matrix(self) -> Array:
        """The dense deflection operator, for a coarsest grid."""
        matrix: Array = toeplitz(self.kernel)
        return matrix

    def deflection(self, pressure: Array) -> Array:
        """Gap opened by a pressure, (n,)."""
        return np.asarray(matmul_toeplitz(self.kernel, pressure, check_finite=False), dtype=float)

    def carried(self, pressure: Array) -> float:
        """Left side of eq. (11)."""
        return float(np.trapezoid(pressure, dx=self.dx))

    def coefficients(self, at: Iterate) -> Coefficients:
        """Everything local that the equations are made of."""
        h = at.h00 + self.gap + self.deflection(at.pressure)
        pressure = np.maximum(at.pressure, self.fluid.ambient_pressure)
        rho, rho_p = self.fluid.density(pressure)
        log_eta, log_eta_p = self.fluid.log_viscosity(pressure)
        eps = rho * h**3 * np.exp(-log_eta) / self.fluid.velocity_parameter
        return Coefficients(h, rho, eps, rho_p / rho, log_eta_p)

    def operator(self, at: Iterate, c: Coefficients) -> Array:
        """L of eq. (7) at the inner nodes, zero at the two ends; shape (n,)."""
        half = 0.5 * (c.eps[1:] + c.eps[:-1])
        flow = half * np.diff(at.pressure) / self.dx
        here, before, twice = self._wedge_weights
        mass = c.density * c.thickness
        wedge = here * mass
        wedge[1:] += before[1:] * mass[:-1]
        wedge[2:] += twice[2:] * mass[:-2]
        left_side: Array = np.zeros_like(mass)
        left_side[1:-1] = (np.diff(flow) - wedge[1:-1]) / self.dx
        return left_side

    @cached_property
    def _wedge_weights(self) -> tuple[Array, Array, Array]:
        """Weights of nodes i, i-1 and i-2 in the wedge term, each (n,); of first order beside the inlet."""
        n = self.x.size
        here, before, twice = (np.full(n, weight) for weight in _UPSTREAM[self.second_order])
        here[1], before[1], twice[1] = _UPSTREAM[False]
        return here, before, twice

    def residual(self, at: Iterate, c: Coefficients) -> Array:
        """Source - L, shape (n,)."""
        return self.source - self.operator(at, c)

    def poiseuille(self, c: Coefficients) -> Array:
        """(eps_(i-1/2) + eps_(i+1/2))/dX^2, zero at the two ends; shape (n,)."""
        half = 0.5 * (c.eps[1:] + c.eps[:-1]) / self.dx**2
        weight = np.zeros_like(c.eps)
        weight[1:-1] = half[1:] + half[:-1]
        return weight

    def free(self, at: Iterate, residual: Array) -> Mask:
        """Inner nodes above ambient pressure, and those that the residual takes there."""
        above: Mask = (at.pressure > self.fluid.ambient_pressure) | (residual < 0.0)
        above[0] = above[-1] = False
        return above

    def scaled(self, at: Iterate, c: Coefficients) -> Array:
        """Residual over its local coefficient, a pressure; zero where the film cavitates rightly, (n,)."""
        local = c.density * (self.kernel[0] - self.kernel[1]) / self.dx
        residual = self.residual(at, c)
        return np.where(self.free(at, residual), residual / (self.poiseuille(c) + local), 0.0)

    def derivatives(self, at: Iterate, c: Coefficients) -> tuple[Array, Array]:
        """dL/dP at fixed H and dL/dH at fixed P by the nodes of NEIGHBOURS, each (4, n); end rows zero."""
        dx = self.dx
        half = 0.5 * (c.eps[1:] + c.eps[:-1]) / dx**2
        slope = np.diff(at.pressure) / dx**2
        # What a change of ln eps does to the flow through both faces, (n - 1,) by the node it is at.
        of_left, of_right = 0.5 * slope * c.eps[:-1], 0.5 * slope * c.eps[1:]
        weights = self._wedge_weights
        mass = c.density * c.thickness / dx

        def derivative(log_eps: Array, log_mass: Array) -> Array:
            by = np.zeros((4, self.x.size))
            by[1, 1:-1] = -(of_left * log_eps[:-1])[:-1]
            by[2, 1:-1] = (of_left * log_eps[:-1])[1:] - (of_right * log_eps[1:])[:-1]
            by[3, 1:-1] = (of_right * log_eps[1:])[1:]
            for upstream, weight in enumerate(weights):
                nodes = slice(max(1, upstream), -1)
                before = slice(nodes.start - upstream, self.x.size - 1 - upstream)
                by[2 - upstream, nodes] -= weight[nodes] * (mass * log_mass)[before]
            return by

        by_p = derivative(c.log_density_p - c.log_viscosity_p, c.log_density_p)
        by_p[1, 1:-1] += half[:-1]
        by_p[2, 1:-1] -= half[1:] + half[:-1]
        by_p[3, 1:-1] += half[1:]
        return by_p, derivative(3.0 / c.thickness, 1.0 / c.thickness)
