"""Deflection under a Hertz pressure at many points around contacts that have one ratio of their semi-axes.

With lengths in semi-axes along entrainment, b = 1 and a = k, the integral of ``point_deflection`` is

    I = 2 sqrt(w/((k^2 + w)(1 + w))) + 2/3 ((1 - x^2) F(w) + (k^2 - y^2) G(w)),

where w is the root of x^2/(1 + w) + y^2/(k^2 + w) = 1, or zero inside the ellipse. F = R_D(w, k^2 + w, 1 + w)
and G = R_D(w, 1 + w, k^2 + w) depend only on w. They are analytic in v = sqrt(w), except at v = +-i and
v = +-ik, and fall with the third power of v. Their product with (1 + v/c)^3, c = sqrt(k), is therefore smooth
in s = v/(v + c) from 0 to 1, where the singular points are at the distance c/(1 + c^2) or more. On many short
pieces of s they are polynomials.
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np

from ehlectric.arrays import Array, IntArray, Numbers
from ehlectric.formulas.carlson import both_rd

# Pieces and degree of the polynomials: deflections are within 1e-13 of the deflections by elliptic integrals
# for ratios from 1/50 to 50.
_PIECES, _DEGREE = 256, 5

# Points from which on polynomials are used. They take as long as the elliptic integrals of 1500 points, but
# are kept for other points of the same contacts.
_MANY = 300

# Points that are computed together: few enough for the processor's cache.
_BLOCK = 6000

# Least divisor of a quotient that is not used where it counts.
_TINY = 1e-300


def unit_deflection(x2: Array, y2: Array, ratio: Numbers) -> Array:
    """Deflection around contacts with b = 1, over p_h a/E' with the semi-axis a across entrainment.

    ``x2`` and ``y2``, squares of the positions along and across entrainment over b^2, shape (...); ``ratio``,
    ratio k of the semi-axes, a number or an array of shape (...). Returns the integral I of
    ``point_deflection``, dimensionless, shape (...). It is accurate to 1e-13.

    Examples
    --------
    Far away it equals the deflection of a point load, 4/(3 r):

    >>> far = np.full(4000, 1e6)
    >>> round(float(unit_deflection(far, np.zeros(4000), 2.0)[0]) * 1e3 * 0.75, 5)
    1.0
    """
    several, number = np.unique(ratio, return_inverse=True)
    x2, y2, ratios = np.broadcast_arrays(x2, y2, ratio)
    if x2.size < _MANY * max(several.size, 1):
        return _by_integrals(x2, y2, ratios)
    tables = tuple(np.concatenate(rows, axis=1) for rows in zip(*map(_pieces, several.tolist()), strict=True))
    single = several.size == 1
    firsts: IntArray = np.zeros(1, dtype=np.intp)
    if not single:
        firsts = np.broadcast_to(_PIECES * number.reshape(np.shape(ratio)), x2.shape).reshape(-1)
    deflection = np.empty(x2.shape)
    flat, x2, y2, ratios = (values.reshape(-1) for values in (deflection, x2, y2, ratios))
    step = math.ceil(x2.size / math.ceil(x2.size / _BLOCK))
    for start in range(0, x2.size, step):
        part = slice(start, start + step)
        of, first = (several[0], firsts) if single else (ratios[part], firsts[part])
        flat[part] = _by_pieces(x2[part], y2[part], of, first, (tables[0], tables[1]))
    return deflection


def _root(x2: Array, y2: Array, k2: Numbers) -> Array:
    """Number w of the confocal ellipse through points; 0 inside the contact."""
    # Larger root of w^2 - p w - c = 0, without a difference of nearly equal numbers.
    p = x2 + y2
    p -= k2 + 1.0
    c = x2 * k2
    c += y2
    c -= k2
    root = p * p
    root += 4.0 * c
    root = np.sqrt(np.maximum(0.0, root, out=root), out=root)
    root += np.abs(p)
    root *= 0.5
    w = np.where(p > 0.0, root, c / np.maximum(root, _TINY))
    outside: Array = np.maximum(0.0, w, out=w)
    return outside


def _by_integrals(x2: Array, y2: Array, ratio: Array) -> Array:
    """Deflection by elliptic integrals."""
    k2 = np.square(ratio)
    w = _root(x2, y2, k2)
    first, second = both_rd(w, k2 + w, 1.0 + w)
    deflection: Array = 2.0 * np.sqrt(w / ((k2 + w) * (1.0 + w)))
    deflection += 2.0 / 3.0 * ((1.0 - x2) * first + (k2 - y2) * second)
    return deflection


def _by_pieces(
    x2: Array, y2: Array, ratio: Numbers, first_piece: IntArray, tables: tuple[Array, Array]
) -> Array:
    """Deflection by the polynomials of pieces, of each ratio from a first piece on."""
    k2, c = ratio**2, np.sqrt(ratio)
    w = _root(x2, y2, k2)
    v = np.sqrt(w)
    rest = v + c
    rest = np.divide(c, rest, out=rest)  # 1 - s
    at = 1.0 - rest
    at *= _PIECES
    piece = at.astype(np.intp)
    at -= piece
    piece += first_piece
    first, second = (_polynomial(table, piece, at) for table in tables)
    first *= 1.0 - x2
    second *= k2 - y2
    first += second
    first *= 2.0 / 3.0
    second = rest * rest
    second *= rest
    first *= second
    edge = w + k2
    edge *= w + 1.0
    v *= 2.0
    v /= np.sqrt(edge, out=edge)
    first += v
    return first


def _polynomial(table: Array, piece: IntArray, at: Array) -> Array:
    """Values of the polynomials of pieces; ``table``, coefficients by decreasing power, shape (6, pieces)."""
    total: Array = table[0].take(piece, mode="clip")
    for row in table[1:]:
        total *= at
        total += row.take(piece, mode="clip")
    return total


@lru_cache(maxsize=64)
def _pieces(ratio: float) -> tuple[Array, Array]:
    """Coefficients of F and G, times (1 + v/c)^3, over the place in each piece from 0 to 1."""
    nodes = 0.5 - 0.5 * np.cos(np.pi * (np.arange(_DEGREE + 1) + 0.5) / (_DEGREE + 1))
    s = (np.arange(_PIECES) + nodes[:, np.newaxis]) / _PIECES
    w = (np.sqrt(ratio) * s / (1.0 - s)) ** 2
    to_powers = np.linalg.inv(np.vander(nodes))
    tables = tuple(
        np.ascontiguousarray(to_powers @ (values / (1.0 - s) ** 3))
        for values in both_rd(w, ratio**2 + w, 1.0 + w)
    )
    return tables[0], tables[1]
