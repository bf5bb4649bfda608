"""Cavitation: which nodes of a grid have a full film, and which are cavitated.

The pressure nowhere falls below the ambient pressure. With the residual r of the Reynolds equation, positive
where more oil would leave a node than enters it, every node fulfils the complementarity condition

    P >= P_amb,   r >= 0,   (P - P_amb) r = 0.

In the full film r = 0, from which the pressure follows. If the film is cavitated, P = P_amb and the oil
does not fill the gap. At the rupture of the film, this is the Reynolds (Swift-Stieber) condition P = P_amb
and dP/dX = 0. In the wedge term of a stationary film a cavitated gap counts as full, unless the film forms
again behind it (``ehlectric.film.starved_solver``). A transient film carries the mass of the oil that is
left. Newton's method solves r = 0 at the full-film nodes and P = P_amb at the cavitated nodes. Before each
step it decides anew which nodes are cavitated. This is a primal-dual active set method (M. Hintermueller, K.
Ito and K. Kunisch, SIAM J. Optim. 13 (2002) 865, doi:10.1137/S1052623401383558).
"""

from __future__ import annotations

import numpy as np

from ehlectric.arrays import Array, Mask

# Multiple of the wedge term in 1/c. With a smaller multiple, nodes inside the Hertz zone, where eps vanishes,
# would become cavitated.
_WEDGE_PART = 20.0

# Largest number of cavitated nodes behind a rupture that are filled at a time.
_MOST_REFILLED = 200


def full_film_nodes(
    excess: Array, residual: Array, *, poiseuille: Array, rate: float, thickness: Array, inner: Mask
) -> Mask:
    """Mask of the nodes with a full film, where (P - P_amb) - c r >= 0.

    ``excess``, excess pressure P - P_amb of the iterate, shape (nx, ny); ``residual``, residual r of the
    Reynolds equation at the iterate, shape (nx, ny); ``poiseuille``, diagonal of the Poiseuille term,
    shape (nx, ny); ``thickness``, film thickness H, dimensionless, shape (nx, ny); ``inner``, nodes inside
    the domain; the nodes on its edges are at ambient pressure, shape (nx, ny). Returns True where the film is
    full, False where it is cavitated and on the edges, shape (nx, ny).

    1/c is the larger of the Poiseuille diagonal and 20 H times ``rate``.

    Examples
    --------
    Three nodes: oil under pressure; ambient pressure with more oil entering than leaving; ambient pressure
    with more oil leaving than entering:

    >>> excess, residual = np.array([0.5, 0.0, 0.0]), np.array([0.1, -1.0, 1.0])
    >>> ones, inner = np.ones(3), np.ones(3, dtype=bool)
    >>> full_film_nodes(excess, residual, poiseuille=ones, rate=1.0, thickness=ones, inner=inner)
    array([ True,  True, False])
    """
    c = 1.0 / np.maximum(_WEDGE_PART * rate * thickness, poiseuille)
    return (excess - c * residual >= 0.0) & inner


def with_refilled_nodes(full_film: Mask, residual: Array) -> Mask:
    """Mask of the full-film nodes, extended by the cavitated nodes that a surplus of oil fills.

    A cavitated node with r < 0 receives more oil than it passes on. ``full_film_nodes`` gives such a node a
    full film, but not the nodes behind it. The rupture of a film that ends too early would then move by one
    node per Newton step. This function carries the surplus -r along entrainment, and fills the cavitated
    nodes behind until they have used it up.

    ``full_film``, nodes with a full film, as ``full_film_nodes`` returns them, shape (nx, ny); ``residual``,
    residual r of the Reynolds equation at the iterate, shape (nx, ny). Returns True where the film is full;
    the nodes on the edges of the domain are unchanged, shape (nx, ny).

    Where the pressure gradient at the rupture is s instead of zero, the surplus is eps s/dX, and each node
    behind uses up d(rho H)/dX. The rupture therefore moves by eps s/(d(rho H)/dX), which is a Newton step for
    its position. At most 200 nodes are filled at a time.

    Examples
    --------
    The first cavitated node has a surplus of 0.5, which the next two nodes use up:

    >>> full = np.array([[True], [True], [False], [False], [False], [False]])
    >>> r = np.array([[0.0], [-0.5], [0.2], [0.2], [0.2], [0.0]])
    >>> with_refilled_nodes(full, r)[:, 0]
    array([ True,  True,  True,  True, False, False])
    """
    filled: Mask = full_film.copy()
    cavitated = ~full_film
    cavitated[[0, -1]] = False
    surplus = np.where(full_film, np.maximum(-residual, 0.0), 0.0)
    for _ in range(_MOST_REFILLED):
        surplus[1:] = surplus[:-1] - residual[1:]
        surplus[0] = 0.0
        surplus[~(cavitated & (surplus > 0.0))] = 0.0
        if not surplus.any():
            break
        filled |= surplus > 0.0
    return filled
