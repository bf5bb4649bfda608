"""Reynolds equation on a uniform grid: residual and derivatives by pressure and film thickness.

Dimensionless, with X = x/b, Y = y/b, P = p/p_h and H = h R/b^2:

    r = d(rho H)/dX - d/dX(eps dP/dX) - d/dY(eps dP/dY) = 0,   eps = rho H^3/(eta lambda)

The first term is the wedge (Couette) term, the others are the Poiseuille term. A line contact has no term in
Y. Arrays have the shape (nx, ny), with x along entrainment. The Poiseuille term is a central difference of
second order; its flux is computed in ``ehlectric.film.face_flow``. The wedge term is an upstream difference
of first order (eq. 7 of Morris et al. (2022), doi:10.3390/lubricants10050087), of second or of third order.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from ehlectric.arrays import Array, Mask
from ehlectric.film.face_flow import Flow, face_mean, gradients, with_mirror
from ehlectric.film.mesh import Mesh

# Nodes that a row of a stencil couples, as steps along x and y: four nodes along x and, in a point contact,
# two across it.
OFFSETS = ((-2, 0), (-1, 0), (0, 0), (1, 0), (0, -1), (0, 1))
ALONG, ACROSS = 4, 6


@dataclass(frozen=True)
class Stencil:
    """Linear operator on a node and its neighbours."""

    coefficients: Array  # coefficient of each neighbour, in the order of ``OFFSETS``, shape (4 or 6, nx, ny)

    def __call__(self, values: Array) -> Array:
        """Apply the operator to nodal values (nx, ny)."""
        c = self.coefficients
        product: Array = c[2] * values
        product[2:] += c[0, 2:] * values[:-2]
        product[1:] += c[1, 1:] * values[:-1]
        product[:-1] += c[3, :-1] * values[1:]
        return self.add_across(values, product)

    def add_across(self, values: Array, product: Array) -> Array:
        """Add the terms of the neighbours across entrainment to ``product`` in place, and return it."""
        c = self.coefficients
        if len(c) == ACROSS:
            product[:, 1:] += c[4, :, 1:] * values[:, :-1]
            product[:, :-1] += c[5, :, :-1] * values[:, 1:]
        return product

    def on_rows(self, rows: Mask) -> Stencil:
        """Operator with zero coefficients in all rows where the mask ``rows`` (nx, ny) is False."""
        return Stencil(np.where(rows, self.coefficients, 0.0))

    def matrix(self) -> Array:
        """Operator as a dense matrix over the nodes, y fastest, shape (nx ny, nx ny)."""
        _, nx, ny = self.coefficients.shape
        dense = np.zeros((nx, ny, nx, ny))
        # Position of the neighbours in the flattened matrix: one step along the diagonal is n + 1 entries.
        i, j = np.ogrid[:nx, :ny]
        place = (i * ny + j) * (nx * ny + 1)
        flat = dense.reshape(-1)
        for row, (q, p) in zip(self.coefficients, OFFSETS, strict=False):
            here, _ = _neighbours(q, p)
            flat[place[here] + (q * ny + p)] += row[here]
        return dense.reshape(nx * ny, nx * ny)

    def times(self, operator: Array) -> Array:
        """Product with a dense matrix over the nodes, y fastest, shape (nx ny, n)."""
        _, nx, ny = self.coefficients.shape
        blocks = operator.reshape(nx, ny, -1)
        product = self.coefficients[2, :, :, np.newaxis] * blocks
        for row, (q, p) in zip(self.coefficients, OFFSETS, strict=False):
            if q or p:
                here, there = _neighbours(q, p)
                product[here] += row[here][:, :, np.newaxis] * blocks[there]
        return product.reshape(nx * ny, -1)


def _neighbours(q: int, p: int) -> tuple[tuple[slice, slice], tuple[slice, slice]]:
    """Index of the nodes that have a neighbour q steps along x and p across it, and of these neighbours."""
    here = tuple(slice(max(0, -step), -step if step > 0 else None) for step in (q, p))
    there = tuple(slice(max(0, step), step if step < 0 else None) for step in (q, p))
    return (here[0], here[1]), (there[0], there[1])


def without_columns(stencil: Stencil, columns: Mask) -> Stencil:
    """Stencil with zero coefficients of the neighbours where the mask ``columns`` is True."""
    kept = stencil.coefficients.copy()
    for row, (q, p) in zip(kept, OFFSETS, strict=False):
        here, there = _neighbours(q, p)
        row[here][columns[there]] = 0.0
    return Stencil(kept)


def stencil_matrix(stencil: Stencil, nodes: Mask) -> scipy.sparse.csc_array:
    """Sparse matrix of a stencil over the nodes of a mask (nx, ny)."""
    number = np.full(nodes.shape, -1)
    number[nodes] = np.arange(int(nodes.sum()))
    rows, columns, values = [], [], []
    for row, (q, p) in zip(stencil.coefficients, OFFSETS, strict=False):
        here, there = _neighbours(q, p)
        both = nodes[here] & nodes[there]
        rows.append(number[here][both])
        columns.append(number[there][both])
        values.append(row[here][both])
    n = int(nodes.sum())
    entries = (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns)))
    return scipy.sparse.csc_array(entries, shape=(n, n))


# Mass rho H at the face i+1/2 from the nodes i-1, i and i+1, by the order of the wedge term: the mass of the
# upstream node, of a line through the two upstream nodes, and of a parabola through all three.
_AT_FACE = {1: (0.0, 1.0, 0.0), 2: (-0.5, 1.5, 0.0), 3: (-0.125, 0.75, 0.375)}


def wedge_stencil(shape: tuple[int, int], dx: float, *, order: int) -> Stencil:
    """Upstream-weighted difference d/dX of the wedge term; the two end rows are zero. ``dx``, grid spacing
    dX, dimensionless. Returns operator on the mass rho H.

    The difference of the masses at the two faces of a node. The first face has no second upstream node; above
    the first order it takes the mean of its two nodes. The third order follows B. P. Leonard, Comput.
    Methods Appl. Mech. Eng. 19 (1979) 59, doi:10.1016/0045-7825(79)90034-3.

    Examples
    --------
    A parabola is differentiated exactly by the third order, at the inner nodes behind the first:

    >>> x = np.linspace(0.0, 5.0, 6)[:, np.newaxis]
    >>> [wedge_stencil((6, 1), 1.0, order=order)(x**2)[2:5, 0].tolist() for order in (1, 2, 3)]
    [[3.0, 5.0, 7.0], [4.0, 6.0, 8.0], [4.0, 6.0, 8.0]]
    """
    far, near, ahead = _AT_FACE[order]
    c = np.zeros((ALONG, *shape))
    for row, part in enumerate((-far, far - near, near - ahead, ahead)):
        c[row] = part / dx
    if order > 1:
        c[:3, 1] = np.array([0.0, far - 0.5, near - 0.5])[:, np.newaxis] / dx
    c[:, 0] = c[:, -1] = 0.0
    return Stencil(c)


def _inner_lines(mesh: Mesh) -> slice:
    """Lines along x that have neighbours on both sides, mirror images included."""
    return slice(0 if mesh.symmetric else 1, -1)


def poiseuille_weight(flow: Flow, mesh: Mesh) -> Array:
    """Return the diagonal of the Poiseuille term at fixed eps: the summed conductances of a node's faces.
    Returns sum of eps/dX^2 and eps/dY^2 over the faces, zero in the end rows, shape (nx, ny).
    """
    weight = np.zeros_like(flow.coefficients.eps)
    weight[1:-1] = flow.along.weight()
    if flow.across is not None:
        weight[1:-1, _inner_lines(mesh)] += flow.across.weight().T[1:-1]
    return weight


def residual(flow: Flow, wedge: Stencil, thickness: Array, mesh: Mesh) -> Array:
    """Residual r of the Reynolds equation at the inner nodes, zero on the edges of the domain. ``thickness``,
    film thickness H, dimensionless, shape (nx, ny). Returns residual r, dimensionless; positive where more
    oil leaves a node than enters it, shape (nx, ny).
    """
    r = wedge(flow.coefficients.density * thickness)
    r[1:-1] -= flow.along.divergence()
    if flow.across is not None:
        r[1:-1, _inner_lines(mesh)] -= flow.across.divergence().T[1:-1]
        r[~mesh.inner] = 0.0
    return r


def lateral_change(flow: Flow, change: Array, mesh: Mesh) -> Array:
    """Change of the residual r (nx, ny) of a shear-thinning film by the gradients along the other axis.

    A change (nx, ny) of P changes dP/dY, and thus the viscosity, at the faces along x, and dP/dX at the faces
    across it. ``linearise`` lacks these derivatives, as they reach nodes outside its stencils.
    """
    r = np.zeros_like(change)
    if flow.across is None or flow.along.by_lateral is None or flow.across.by_lateral is None:
        return r
    by_x, by_y = gradients(change, mesh)
    r[1:-1] -= np.diff(flow.along.by_lateral * face_mean(by_y), axis=0)
    across = flow.across.by_lateral * face_mean(with_mirror(by_x, mesh).T)
    r[1:-1, _inner_lines(mesh)] -= np.diff(across, axis=0).T[1:-1]
    r[~mesh.inner] = 0.0
    return r


def linearise(flow: Flow, wedge: Stencil, thickness: Array, mesh: Mesh) -> tuple[Stencil, Stencil]:
    """Derivatives of the residual r: one stencil by P at fixed H, and one by H at fixed P.

    The Jacobian is dr = (stencil by P) dP + (stencil by H) dH, where dH is the change of the gap
    (``ehlectric.film.gap``). Its matrix is formed on the coarsest grid only.

    ``thickness``, film thickness H, dimensionless, shape (nx, ny).
    """
    k = flow.coefficients
    rows = ALONG if mesh.dy is None else ACROSS
    by_p = np.zeros((rows, *thickness.shape))
    by_h = np.zeros((rows, *thickness.shape))
    mass_p = k.density_p * thickness
    for row, (shift, _) in enumerate(OFFSETS[:ALONG]):
        here = slice(max(0, -shift), -shift if shift > 0 else None)
        there = slice(max(0, shift), shift if shift < 0 else None)
        w = wedge.coefficients[row, here]
        by_p[row, here] = w * mass_p[there]
        by_h[row, here] = w * k.density[there]

    for by, along in ((by_p, flow.along.by_pressure()), (by_h, flow.along.by_gap.outflow())):
        for row, part in zip((1, 2, 3), along, strict=True):
            by[row, 1:-1] += part
    if flow.across is not None:
        _add_across(by_p, flow.across.by_pressure(), mesh)
        _add_across(by_h, flow.across.by_gap.outflow(), mesh)
    return Stencil(by_p), Stencil(by_h)


def _add_across(by: Array, parts: tuple[Array, Array, Array], mesh: Mesh) -> None:
    """Add the derivatives of the flow across entrainment, each (lines, nx), to the coefficients ``by``."""
    lines = _inner_lines(mesh)
    for row, part in zip((4, 2, 5), parts, strict=True):
        by[row, 1:-1, lines] += part.T[1:-1]
    if mesh.symmetric:
        # The neighbour beyond the line of symmetry is the mirror image of the neighbour on this side.
        by[5, :, 0] += by[4, :, 0]
        by[4, :, 0] = 0.0
    by[:, ~mesh.inner] = 0.0
