"""The discretised Reynolds equation: residual and local derivatives on a uniform grid.

Dimensionless, with X = x/b, Y = y/b, P = p/p_h and H = h R/b^2:

    r = d(rho H)/dX - d/dX(eps dP/dX) - d/dY(eps dP/dY) = 0,   eps = rho H^3/(eta lambda)

A line contact has no Y. Arrays are (nx, ny), x along entrainment. The Poiseuille term is second-order
central, the wedge term upstream of first order (eq. 7 of the paper, doi:10.3390/lubricants10050087) or of
second order.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.mesh import Mesh

# Nodes a stencil row couples, relative to its own: along x, and where the contact has a y across it.
OFFSETS = ((-2, 0), (-1, 0), (0, 0), (1, 0), (0, -1), (0, 1))
ALONG, ACROSS = 4, 6

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
    """A linear operator of the neighbours: the coefficients of those of ``OFFSETS``, four or six of them."""

    coefficients: Array  # (4 or 6, nx, ny)

    def __call__(self, values: Array) -> Array:
        """The operator applied to nodal values (nx, ny)."""
        c = self.coefficients
        product: Array = c[2] * values
        product[2:] += c[0, 2:] * values[:-2]
        product[1:] += c[1, 1:] * values[:-1]
        product[:-1] += c[3, :-1] * values[1:]
        return self.add_across(values, product)

    def add_across(self, values: Array, product: Array) -> Array:
        """Add what the neighbours across entrainment contribute, in place."""
        c = self.coefficients
        if len(c) == ACROSS:
            product[:, 1:] += c[4, :, 1:] * values[:, :-1]
            product[:, :-1] += c[5, :, :-1] * values[:, 1:]
        return product

    def matrix(self) -> Array:
        """The operator as a dense matrix on the nodes in order, shape (nx ny, nx ny)."""
        c = self.coefficients
        _, nx, ny = c.shape
        dense = np.zeros((nx, ny, nx, ny))
        i, j = np.indices((nx, ny))
        for row, (q, p) in zip(c, OFFSETS, strict=False):
            there = (i + q >= 0) & (i + q < nx) & (j + p >= 0) & (j + p < ny)
            dense[i[there], j[there], i[there] + q, j[there] + p] += row[there]
        return dense.reshape(nx * ny, nx * ny)


def wedge_stencil(shape: tuple[int, int], dx: float, *, second_order: bool) -> Stencil:
    """The upstream difference d/dX of the wedge term; the two end rows are zero.

    In flux form the second-order scheme takes (3 f_i - f_(i-1))/2 at the face i+1/2 and the mean at the
    first face, which has no second upstream node: row 1 then is the first-order difference, and the
    flux stays second-order everywhere.
    """
    c = np.zeros((ALONG, *shape))
    if second_order:
        c[0], c[1], c[2] = 0.5 / dx, -2.0 / dx, 1.5 / dx
        c[0, 1], c[1, 1], c[2, 1] = 0.0, -1.0 / dx, 1.0 / dx
    else:
        c[1], c[2] = -1.0 / dx, 1.0 / dx
    c[:, 0] = c[:, -1] = 0.0
    return Stencil(c)


def _with_mirror(values: Array, mesh: Mesh) -> Array:
    """Values with the line beyond a line of symmetry before the first."""
    return np.concatenate([values[:, 1:2], values], axis=1) if mesh.symmetric else values


def _inner_lines(mesh: Mesh) -> slice:
    """Lines along x that have neighbours on both sides."""
    return slice(0 if mesh.symmetric else 1, -1)


def poiseuille_weight(coefficients: Coefficients, mesh: Mesh) -> Array:
    """Sum of eps/dX^2 and eps/dY^2 at the faces of a node, the diagonal of the Poiseuille term.

    Zero in the end rows.
    """
    face = 0.5 * (coefficients.eps[1:] + coefficients.eps[:-1]) / mesh.dx**2
    weight = np.zeros_like(coefficients.eps)
    weight[1:-1] = face[1:] + face[:-1]
    if mesh.dy is not None:
        eps = _with_mirror(coefficients.eps, mesh)
        face = 0.5 * (eps[:, 1:] + eps[:, :-1]) / mesh.dy**2
        weight[1:-1, _inner_lines(mesh)] += (face[:, 1:] + face[:, :-1])[1:-1]
    return weight


def residual(
    coefficients: Coefficients, wedge: Stencil, pressure: Array, thickness: Array, mesh: Mesh
) -> Array:
    """The residual r at the inner nodes, zero on the edges of the domain."""
    eps = coefficients.eps
    flux = 0.5 * (eps[1:] + eps[:-1]) * np.diff(pressure, axis=0) / mesh.dx**2
    r = wedge(coefficients.density * thickness)
    r[1:-1] -= np.diff(flux, axis=0)
    if mesh.dy is not None:
        eps = _with_mirror(eps, mesh)
        gradient = np.diff(_with_mirror(pressure, mesh), axis=1) / mesh.dy**2
        flux = 0.5 * (eps[:, 1:] + eps[:, :-1]) * gradient
        r[1:-1, _inner_lines(mesh)] -= np.diff(flux, axis=1)[1:-1]
        r[~mesh.inner] = 0.0
    return r


def linearise(
    coefficients: Coefficients, wedge: Stencil, pressure: Array, thickness: Array, mesh: Mesh
) -> tuple[Stencil, Stencil]:
    """Local derivatives of r: one stencil in P at fixed H, one in H at fixed P.

    The Jacobian is dr = (stencil in P) dP + (stencil in H) dH with dH = dH00 + (deflection of dP); it
    is never formed.
    """
    k = coefficients
    rows = ALONG if mesh.dy is None else ACROSS
    by_p = np.zeros((rows, *pressure.shape))
    by_h = np.zeros((rows, *pressure.shape))
    mass_p = k.density_p * thickness
    for row, shift in ((0, 2), (1, 1), (2, 0)):
        w = wedge.coefficients[row, shift:]
        stop = -shift or None
        by_p[row, shift:] = w * mass_p[:stop]
        by_h[row, shift:] = w * k.density[:stop]

    inner = slice(1, -1)
    by_p[1:4, inner] += _poiseuille_by_p(k.eps, k.eps_p, pressure, mesh.dx)
    by_h[1:4, inner] += _poiseuille_by_h(k.eps_h, pressure, mesh.dx)
    if mesh.dy is not None:
        eps, eps_p, eps_h, p = (_with_mirror(v, mesh).T for v in (k.eps, k.eps_p, k.eps_h, pressure))
        lines = _inner_lines(mesh)
        for by, across in (
            (by_p, _poiseuille_by_p(eps, eps_p, p, mesh.dy)),
            (by_h, _poiseuille_by_h(eps_h, p, mesh.dy)),
        ):
            south, centre, north = np.swapaxes(across, 1, 2)
            by[2, inner, lines] += centre[inner]
            by[4, inner, lines] += south[inner]
            by[5, inner, lines] += north[inner]
            if mesh.symmetric:
                by[5, :, 0] += by[4, :, 0]
                by[4, :, 0] = 0.0
            by[:, ~mesh.inner] = 0.0
    return Stencil(by_p), Stencil(by_h)


def _poiseuille_by_p(eps: Array, eps_p: Array, pressure: Array, spacing: float) -> Array:
    """Derivatives of -d(eps dP)/spacing^2 along the first axis by P of the node before, at and after.

    At the inner nodes, shape (3, n - 2, m).
    """
    face = 0.5 * (eps[1:] + eps[:-1]) / spacing**2
    gradient = 0.5 * np.diff(pressure, axis=0) / spacing**2
    before, after = gradient[:-1], gradient[1:]
    return np.stack(
        [
            eps_p[:-2] * before - face[:-1],
            face[:-1] + face[1:] - eps_p[1:-1] * (after - before),
            -eps_p[2:] * after - face[1:],
        ]
    )


def _poiseuille_by_h(eps_h: Array, pressure: Array, spacing: float) -> Array:
    """The same by H of the three nodes."""
    gradient = 0.5 * np.diff(pressure, axis=0) / spacing**2
    before, after = gradient[:-1], gradient[1:]
    return np.stack([eps_h[:-2] * before, -eps_h[1:-1] * (after - before), -eps_h[2:] * after])
