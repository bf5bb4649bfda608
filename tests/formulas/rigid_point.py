"""The rigid isoviscous point contact with Reynolds' outlet, on a stretched grid: none of our methods."""

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import spsolve


def rigid_load(d, nodes=81):
    """Load integral I of div(h^3 grad p) = dh/dx, p >= 0, over a paraboloid h = 1 + x^2 + d y^2.

    Lengths are in sqrt(2 Rx h0), pressures in 6 eta0 u_s sqrt(2 Rx h0)/h0^2, so that in Moes' groups
    h0/Rx (eta0 u_s/(E' Rx))^(-1/2) = 288 I^2/M^2. Finite volumes,
    x and y the sinh of even nodes, over half of the domain.
    """
    x = np.sinh(np.linspace(-5.0, 2.2, nodes))
    y = np.sinh(np.linspace(0.0, 5.0, nodes // 2 + 1)) / np.sqrt(d)
    xm, ym = 0.5 * (x[1:] + x[:-1]), 0.5 * (y[1:] + y[:-1])
    cx, cy = np.diff([x[0], *xm, x[-1]]), np.diff([0.0, *ym, y[-1]])
    gap = 1.0 + xm[:, None] ** 2 + d * y**2
    along = gap**3 / np.diff(x)[:, None] * cy
    across = (1.0 + x[:, None] ** 2 + d * ym**2) ** 3 / np.diff(y) * cx[:, None]
    index = np.arange(x.size * y.size).reshape(x.size, y.size)
    flow = _flow(along, index[:-1], index[1:]) + _flow(across, index[:, :-1], index[:, 1:])
    wedge = np.zeros(index.shape)
    wedge[1:-1] = -np.diff(gap, axis=0) * cy
    edge = np.zeros(index.shape, dtype=bool)
    edge[[0, -1]] = edge[:, -1] = True
    wedge, edge = wedge.ravel(), edge.ravel()
    zero, p = edge | (np.repeat(x, y.size) > 0.3), np.zeros(index.size)
    for _ in range(100):
        p = np.zeros(index.size)
        p[~zero] = spsolve(flow[~zero][:, ~zero], wedge[~zero])
        new = edge | (p < 0.0) | (zero & (flow @ p - wedge >= 0.0))
        if (new == zero).all():
            return 2.0 * float((p.reshape(index.shape) * cx[:, None] * cy).sum())
        zero = new
    raise AssertionError("the cavitated nodes do not settle")


def _flow(conductance, first, second):
    g, a, b = conductance.ravel(), first.ravel(), second.ravel()
    rows, columns = np.concatenate([a, b, a, b]), np.concatenate([a, b, b, a])
    return sp.csr_matrix((np.concatenate([g, g, -g, -g]), (rows, columns)))
