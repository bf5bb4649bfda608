"""Film equations of a line contact on one grid, discretised as in the paper.

They do not use the film solver of ehlectric, so that the two solvers can check each other. The variables are
dimensionless, X = x/b, P = p/p_h and H = h R/b^2. With the equation numbers of the paper::

    (7)       L(P, H) = [eps_(i-1/2) P_(i-1) - (eps_(i-1/2) + eps_(i+1/2)) P_i + eps_(i+1/2) P_(i+1)]/dX^2
                        - (wedge of rho H)/dX = source
    (1), (5)  H = H00 + gap - (1/pi) sum K P
    (11)      sum of the trapezoidal rule over P = load

On the finest grid ``source`` is zero, ``gap`` is the dry gap and ``load`` is pi/2. On coarser grids they are
the right sides of the full approximation scheme.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy

from ehlectric.arrays import Array, Mask
from ehlectric.film import Fluid

# Nodes coupled by eq. (7) at node i, as offsets from i.
NEIGHBOURS = (-2, -1, 0, 1)

# Upstream differences of the wedge term, times dX: weights of nodes i, i-1 and i-2, by whether they are of
# second order.
_UPSTREAM = {False: (1.0, -1.0, 0.0), True: (1.5, -2.0, 0.5)}


@dataclass(frozen=True)
class Iterate:
    """Iterate of the solution: pressure P, shape (n,), and integration constant H00."""

    pressure: Array
    h00: float


@dataclass(frozen=True)
class Coefficients:
    """Local quantities of an iterate at the nodes, each of shape (n,)."""

    thickness: Array
    density: Array
    eps: Array
    # log_density_p and log_viscosity_p: derivatives of the logarithms of density and viscosity with respect
    # to P.
    log_density_p: Array
    log_viscosity_p: Array


@dataclass(frozen=True)
class FilmEquations:
    """Equations (1), (7) and (11) of the paper on one grid. ``x``, equidistant nodes X, shape (n,); ``gap``,
    right side of the film equation; the dry gap on the finest grid, shape (n,); ``source``, right side of the
    Reynolds equation (7), shape (n,).
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
        """Deflection kernel -K/pi of eq. (5) at distances of 0 to n - 1 nodes, shape (n,)."""
        right = (np.arange(self.x.size) + 0.5) * self.dx
        left = right - self.dx
        k = right * (np.log(right) - 1.0) - left * (np.log(np.abs(left)) - 1.0)
        kernel: Array = -k / np.pi
        return kernel

    @cached_property
    def kernel_matrix(self) -> Array:
        """Dense matrix of the deflection, shape (n, n), used on a coarsest grid."""
        return scipy.linalg.toeplitz(self.kernel)

    def deflection(self, pressure: Array) -> Array:
        """Elastic deflection by a pressure P, shape (n,); positive where the gap widens."""
        return np.asarray(
            scipy.linalg.matmul_toeplitz(self.kernel, pressure, check_finite=False), dtype=float
        )

    def carried(self, pressure: Array) -> float:
        """Load that a pressure P carries, the left side of eq. (11)."""
        return float(np.trapezoid(pressure, dx=self.dx))

    def coefficients(self, at: Iterate) -> Coefficients:
        """Film thickness, density and further local quantities of an iterate."""
        h = at.h00 + self.gap + self.deflection(at.pressure)
        pressure = np.maximum(at.pressure, self.fluid.ambient_pressure)
        rho, rho_p = self.fluid.density(pressure)
        log_eta, log_eta_p = self.fluid.log_viscosity(pressure)
        eps = rho * h**3 * np.exp(-log_eta) / self.fluid.velocity_parameter
        return Coefficients(h, rho, eps, rho_p / rho, log_eta_p)

    def operator(self, at: Iterate, c: Coefficients) -> Array:
        """Left side L of eq. (7) at the inner nodes, and zero at the two end nodes, shape (n,)."""
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
        """Weights of nodes i, i-1 and i-2 in the wedge term, each (n,).

        At node 1, which has a single node upstream, they are of first order.
        """
        n = self.x.size
        here, before, twice = (np.full(n, weight) for weight in _UPSTREAM[self.second_order])
        here[1], before[1], twice[1] = _UPSTREAM[False]
        return here, before, twice

    def residual(self, at: Iterate, c: Coefficients) -> Array:
        """Residual of eq. (7), ``source`` minus L, shape (n,)."""
        return self.source - self.operator(at, c)

    def poiseuille(self, c: Coefficients) -> Array:
        """Coefficient (eps_(i-1/2) + eps_(i+1/2))/dX^2 of -P_i in eq. (7), shape (n,); zero at both ends."""
        half = 0.5 * (c.eps[1:] + c.eps[:-1]) / self.dx**2
        weight = np.zeros_like(c.eps)
        weight[1:-1] = half[1:] + half[:-1]
        return weight

    def free(self, at: Iterate, residual: Array) -> Mask:
        """Mask of the full-film inner nodes: above ambient pressure, or raised above it by their residual."""
        above: Mask = (at.pressure > self.fluid.ambient_pressure) | (residual < 0.0)
        above[0] = above[-1] = False
        return above

    def scaled(self, at: Iterate, c: Coefficients) -> Array:
        """Residual divided by its local coefficient, a change of P, shape (n,); zero at cavitated nodes."""
        local = c.density * (self.kernel[0] - self.kernel[1]) / self.dx
        residual = self.residual(at, c)
        return np.where(self.free(at, residual), residual / (self.poiseuille(c) + local), 0.0)

    def derivatives(self, at: Iterate, c: Coefficients) -> tuple[Array, Array]:
        """Derivatives dL/dP at fixed H and dL/dH at fixed P by the nodes of NEIGHBOURS, each (4, n).

        They are zero at the two end nodes.
        """
        dx = self.dx
        half = 0.5 * (c.eps[1:] + c.eps[:-1]) / dx**2
        slope = np.diff(at.pressure) / dx**2
        # Derivatives of the flow through each face by ln eps at its left and its right node, each (n - 1,).
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
