"""The discretised Reynolds equation: residual and local derivatives on a uniform grid.

Dimensionless, with X = x/b, P = p/p_h and H = h R/b^2:

    r = d(rho H)/dX - d/dX(eps dP/dX) = 0,   eps = rho H^3/(eta lambda)

Arrays are (nx, ny), x along entrainment. The Poiseuille term is second-order central, the wedge term
is upstream of first order (eq. 7 of the paper, doi:10.3390/lubricants10050087) or of second order.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from ehlectric.typing import Array

# Nodes a stencil row couples along x, relative to its own.
OFFSETS = (-2, -1, 0, 1)

# A law of the fluid: dimensionless pressure -> (value, derivative).
FluidLaw: TypeAlias = Callable[[Array], tuple[Array, Array]]


@dataclass(frozen=True)
class Fluid:
    """What the Reynolds equation asks of the lubricant, over dimensionless pressure.

    ``density`` gives rho/rho_0, ``log_viscosity`` gives ln(eta/eta_0), each with its derivative.
    Below ``ambient_pressure`` both are held: an iterate may pass through pressures a liquid cannot
    have, a solution cannot.
    """

    density: FluidLaw
    log_viscosity: FluidLaw
    velocity_parameter: float
    ambient_pressure: float


@dataclass(frozen=True)
class Coefficients:
    """Density, eps and their derivatives at the nodes, each (nx, ny)."""

    density: Array
    density_p: Array
    eps: Array
    eps_p: Array
    eps_h: Array


def evaluate(fluid: Fluid, pressure: Array, thickness: Array) -> Coefficients:
    """Coefficients of the Reynolds equation at the nodes."""
    clipped = np.maximum(pressure, fluid.ambient_pressure)
    density, density_p = fluid.density(clipped)
    log_viscosity, log_viscosity_p = fluid.log_viscosity(clipped)
    eps = density * thickness**3 * np.exp(-log_viscosity) / fluid.velocity_parameter
    return Coefficients(
        density=density,
        density_p=density_p,
        eps=eps,
        eps_p=eps * (density_p / density - log_viscosity_p),
        eps_h=3.0 * eps / thickness,
    )


@dataclass(frozen=True)
class Stencil:
    """A linear operator along x: row i holds the coefficients of nodes i-2, i-1, i and i+1."""

    coefficients: Array  # (4, nx, ny)

    def __call__(self, values: Array) -> Array:
        """The operator applied to nodal values (nx, ny)."""
        c = self.coefficients
        product: Array = c[2] * values
        product[2:] += c[0, 2:] * values[:-2]
        product[1:] += c[1, 1:] * values[:-1]
        product[:-1] += c[3, :-1] * values[1:]
        return product

    def matrix(self) -> Array:
        """The operator as a dense matrix on the nodes in order, shape (nx ny, nx ny)."""
        c = self.coefficients
        _, nx, ny = c.shape
        dense = np.zeros((nx * ny, nx * ny))
        for row, q in enumerate(OFFSETS):
            dense += np.diag(c[row, max(0, -q) : nx - max(0, q)].ravel(), q * ny)
        return dense


def wedge_stencil(shape: tuple[int, int], dx: float, *, second_order: bool) -> Stencil:
    """The upstream difference d/dX of the wedge term; the two end rows are zero.

    In flux form the second-order scheme takes (3 f_i - f_(i-1))/2 at the face i+1/2 and the mean at the
    first face, which has no second upstream node: row 1 then is the first-order difference, and the
    flux stays second-order everywhere.
    """
    c = np.zeros((4, *shape))
    if second_order:
        c[0], c[1], c[2] = 0.5 / dx, -2.0 / dx, 1.5 / dx
        c[0, 1], c[1, 1], c[2, 1] = 0.0, -1.0 / dx, 1.0 / dx
    else:
        c[1], c[2] = -1.0 / dx, 1.0 / dx
    c[:, 0] = c[:, -1] = 0.0
    return Stencil(c)


def poiseuille_weight(coefficients: Coefficients, dx: float) -> Array:
    """(eps_(i-1/2) + eps_(i+1/2))/dX^2, the diagonal of the Poiseuille term; zero in the end rows."""
    face = 0.5 * (coefficients.eps[1:] + coefficients.eps[:-1]) / dx**2
    weight = np.zeros_like(coefficients.eps)
    weight[1:-1] = face[1:] + face[:-1]
    return weight


def residual(
    coefficients: Coefficients, wedge: Stencil, pressure: Array, thickness: Array, dx: float
) -> Array:
    """The residual r at the interior nodes, zero in the two end rows."""
    eps = coefficients.eps
    flux = 0.5 * (eps[1:] + eps[:-1]) * np.diff(pressure, axis=0) / dx**2
    r = wedge(coefficients.density * thickness)
    r[1:-1] -= np.diff(flux, axis=0)
    return r


def linearise(
    coefficients: Coefficients, wedge: Stencil, pressure: Array, thickness: Array, dx: float
) -> tuple[Stencil, Stencil]:
    """Local derivatives of r: one stencil in P at fixed H, one in H at fixed P.

    The Jacobian is dr = (stencil in P) dP + (stencil in H) dH with dH = dH00 + (deflection of dP); it
    is never formed.
    """
    k = coefficients
    by_p = np.zeros_like(wedge.coefficients)
    by_h = np.zeros_like(wedge.coefficients)
    mass_p = k.density_p * thickness
    for row, shift in ((0, 2), (1, 1), (2, 0)):
        w = wedge.coefficients[row, shift:]
        stop = -shift or None
        by_p[row, shift:] = w * mass_p[:stop]
        by_h[row, shift:] = w * k.density[:stop]

    inner = slice(1, -1)
    face = 0.5 * (k.eps[1:] + k.eps[:-1]) / dx**2
    gradient = 0.5 * np.diff(pressure, axis=0) / dx**2
    west, east = gradient[:-1], gradient[1:]
    by_p[1, inner] += k.eps_p[:-2] * west - face[:-1]
    by_p[2, inner] += face[:-1] + face[1:] - k.eps_p[inner] * (east - west)
    by_p[3, inner] -= k.eps_p[2:] * east + face[1:]
    by_h[1, inner] += k.eps_h[:-2] * west
    by_h[2, inner] -= k.eps_h[inner] * (east - west)
    by_h[3, inner] -= k.eps_h[2:] * east
    return Stencil(by_p), Stencil(by_h)
