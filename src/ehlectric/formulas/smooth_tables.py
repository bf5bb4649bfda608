"""Interpolation of smooth functions of several variables by polynomials on few nodes.

The nodes along each variable are Leja points on its range: each is where the product of the distances to the
nodes before it is largest, so that more nodes can be added to those that are known. The i-th Newton
polynomial is zero at the nodes before the i-th and one there. Polynomials of several variables are products
of these. A product is used only with all products of lower numbers, so that its coefficient is the error that
the others leave at its node. Products are added next to the products with large coefficients, until all
beyond are small.

M. A. Chkifa, A. Cohen and C. Schwab, Found. Comput. Math. 14 (2014) 601, doi:10.1007/s10208-013-9154-z.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import product

import numpy as np

from ehlectric.arrays import Array, IntArray, Mask

# Function of several variables at m points, shape (variables, m) -> (m,).
Function = Callable[[Array], Array]

# Most nodes along a variable, and most nodes in all; largest number along a variable and largest sum of the
# numbers of the first products, where none are expected; largest sum of parts of the expected numbers.
_MOST_ALONG, _MOST, _ALONG, _FIRST, _LONGEST = 60, 2500, 2, 3, 1.0 + 1e-9

# Coefficient over the tolerance beyond which products are added, its part that is expected of the next
# product, points between the nodes at which a table is compared with its function, and the largest difference
# there over the tolerance. The coefficient is lowered down to its least part of the tolerance.
_LARGE, _NEXT, _CHECKED, _ACCURATE, _LEAST = 0.5, 0.1, 24, 0.3, 1e-6

# Points that are computed together: few enough for the processor's cache; rows of a triangular system that
# are solved together.
_BLOCK, _ROWS = 512, 64


@cache
def leja_points() -> Array:
    """Leja points on -1 to 1, the first in the middle.

    Examples
    --------
    >>> leja_points()[:3].tolist()
    [0.0, -1.0, 1.0]
    """
    fine = -np.cos(np.linspace(0.0, np.pi, 4001))
    points, distances = [0.0], np.abs(fine)
    while len(points) < _MOST_ALONG:
        points.append(float(fine[np.argmax(distances)]))
        distances = distances * np.abs(fine - points[-1])
    return np.array(points)


def _newton(at: Array, number: int) -> Array:
    """Newton polynomials of the first nodes at points from -1 to 1, shape (number, m)."""
    nodes, steps = leja_points(), _steps()
    values, factor = np.empty((number, at.size)), np.empty(at.size)
    values[0] = 1.0
    for i in range(1, number):
        np.subtract(at, nodes[i - 1], out=factor)
        factor *= steps[i]
        np.multiply(values[i - 1], factor, out=values[i])
    return values


@cache
def _steps() -> Array:
    """Factors by which the inverse of the product of the distances of a node to those before it grows."""
    nodes = leja_points()
    ends = np.array([np.prod(nodes[i] - nodes[:i]) for i in range(nodes.size)])
    return np.concatenate([[1.0], ends[:-1] / ends[1:]])


@dataclass(frozen=True, eq=False)
class SmoothTable:
    """Polynomial of several variables in a box."""

    low: Array  # least value of each variable, shape (variables,)
    high: Array  # largest value of each variable, shape (variables,)
    numbers: IntArray  # numbers of the polynomials of each product, shape (products, variables)
    coefficients: Array  # coefficient of each product, shape (products,)
    error: float  # largest difference from the function at points between the nodes

    def holds(self, *variables: Array) -> Mask:
        """Whether points are in the box, shape (...)."""
        inside: Mask = np.ones((), dtype=bool)
        for value, low, high in zip(variables, self.low, self.high, strict=True):
            inside = inside & (value >= low) & (value <= high)
        return inside

    def __call__(self, *variables: Array, group: IntArray | None = None) -> Array:
        """Values at points in the box, shape (m,); variables of shape (m,).

        ``group``, for each point the place of the value of the first variable, where many points have the
        same one: the first variable then has the shape (groups,).
        """
        rows, columns, matrix = self._plan
        at = [self._scaled(values, k) for k, values in enumerate(variables)]
        counts = [matrix.shape[1], *(int(column.max()) + 1 for column in columns)]
        newton = [_newton(values, count) for values, count in zip(at, counts, strict=True)]
        # Coefficients of the products of all variables except the first, for each value of the first one.
        of_first = matrix @ newton[0]
        size = at[-1].size
        group = np.arange(size) if group is None else group
        sums, work = np.empty(size), np.empty((2, len(matrix), min(size, _BLOCK)))
        for start in range(0, size, _BLOCK):
            part = slice(start, start + _BLOCK)
            total = np.ones((1, sums[part].size))
            for row, column, values in zip(rows[:-1], columns[:-1], newton[1:-1], strict=True):
                total = total[row] * values[column, part]
            products, other = work[:, :, : total.shape[1]]
            np.take(total, rows[-1], axis=0, out=products, mode="clip")
            np.take(newton[-1][:, part], columns[-1], axis=0, out=other, mode="clip")
            products *= other
            if of_first.shape[1] == 1:
                np.dot(of_first[:, 0], products, out=sums[part])
            else:
                np.take(of_first, group[part], axis=1, out=other, mode="clip")
                np.einsum("ij,ij->j", products, other, out=sums[part])
        return sums

    def _scaled(self, values: Array, variable: int) -> Array:
        """Variable from -1 to 1; 0 where its range is a point."""
        low, high = self.low[variable], self.high[variable]
        if high <= low:
            return np.zeros(1 if variable == 0 else np.shape(values))
        scaled: Array = (2.0 * values - (low + high)) / (high - low)
        return scaled

    @cached_property
    def _plan(self) -> tuple[list[IntArray], list[IntArray], Array]:
        """How the products of all variables except the first are made, one variable after the other.

        For each of these variables, the row of the products of those before it, and the number of its
        polynomial; coefficients, shape (products of all except the first, numbers of the first).
        """
        others, place = np.unique(self.numbers[:, 1:], axis=0, return_inverse=True)
        matrix = np.zeros((len(others), int(self.numbers[:, 0].max()) + 1))
        matrix[place.ravel(), self.numbers[:, 0]] = self.coefficients
        rows, numbers, heads = [], [], others
        for _ in range(others.shape[1]):
            numbers.append(heads[:, -1])
            heads, row = np.unique(heads[:, :-1], axis=0, return_inverse=True)
            rows.append(row.ravel())
        return rows[::-1], numbers[::-1], matrix


def smooth_table(
    function: Function, low: Array, high: Array, tolerance: float, expected: Sequence[int] = ()
) -> SmoothTable | None:
    """Polynomial that meets a function in a box to a tolerance; None if that takes too many nodes, or if the
    function has no value at one of the points.

    ``function``, analytic function of points of shape (variables, m), two variables or more; ``low`` and
    ``high``, box, shape (variables,); ``tolerance``, largest difference at points between the nodes;
    ``expected``, largest number of the polynomials along each variable that is expected. The first products
    are then a simplex with these corners, and the function is called a few times less.

    Examples
    --------
    >>> table = smooth_table(lambda x: np.exp(x[0] + 2.0 * x[1]), np.zeros(2), np.ones(2), 1e-9)
    >>> abs(float(table(np.array([0.3]), np.array([0.7]))[0] - np.exp(1.7))) < 1e-8
    True
    """
    box = np.asarray(low, dtype=float), np.asarray(high, dtype=float)
    known = _Known(function, *box, expected)
    draw = np.random.default_rng(1).uniform(-1.0, 1.0, (box[0].size, _CHECKED))
    # Few different values of the first variable, which may be expensive to change.
    draw[0] = np.repeat(draw[0, :3], _CHECKED // 3)
    draw[box[1] <= box[0]] = 0.0
    values, large = known.at(draw), _LARGE * tolerance
    if not np.all(np.isfinite(values)):
        return None
    # With all products along the variables, smaller coefficients add none.
    while known.complete and len(known.numbers) <= _MOST and large > _LEAST * tolerance:
        error = float(np.max(np.abs(known.table(*draw) - values)))
        if error <= _ACCURATE * tolerance:
            return SmoothTable(*box, known.table.numbers, known.table.coefficients, error)
        if not known.grow(large):
            large *= 0.25
    return None


def _moved(number: tuple[int, ...], variable: int, step: int) -> tuple[int, ...]:
    """Product whose number for a variable is changed by a step."""
    return (*number[:variable], number[variable] + step, *number[variable + 1 :])


def _substituted(matrix: Array, right: Array) -> Array:
    """Solution of a lower triangular system with a diagonal of ones, shape (n,), in blocks of rows."""
    solution = np.empty_like(right)
    for start in range(0, right.size, _ROWS):
        rows = slice(start, start + _ROWS)
        known = right[rows] - matrix[rows, :start] @ solution[:start]
        solution[rows] = np.linalg.solve(np.tril(matrix[rows, rows]), known)
    return solution


class _Known:
    """Products of a table that grows, with the values of its function at their nodes."""

    def __init__(self, function: Function, low: Array, high: Array, expected: Sequence[int]) -> None:
        self.function, self.low, self.high = function, low, high
        self.numbers: list[tuple[int, ...]] = []
        self.coefficients = np.empty(0)
        most = expected or (_ALONG,) * len(low)
        within = (k if end > start else 0 for k, start, end in zip(most, low, high, strict=True))
        each, parts = product(*(range(k + 1) for k in within)), np.array(most, dtype=float)
        longest = _LONGEST if expected else _FIRST / _ALONG
        self._add(numbers for numbers in each if np.sum(numbers / parts) <= longest)

    def at(self, scaled: Array) -> Array:
        """Values of the function at points from -1 to 1, shape (variables, m)."""
        half = 0.5 * (self.high - self.low)
        return self.function((self.low + half + half * scaled.T).T)

    def _add(self, new: Iterable[tuple[int, ...]]) -> None:
        """Add products, each after the products of lower numbers, whose coefficients stay as they are."""
        added = sorted(new, key=sum)
        rows = np.array(added)
        values = self.at(leja_points()[rows].T)
        self.complete = bool(np.all(np.isfinite(values)))
        self.numbers += added
        if not self.complete:
            return
        # Products at the new nodes; a new product is zero at the nodes before its own, and one at its own.
        products = np.ones((rows.shape[0], len(self.numbers)))
        for at_nodes, number in zip(rows.T, np.array(self.numbers).T, strict=True):
            newton = _newton(leja_points()[: int(at_nodes.max()) + 1], int(number.max()) + 1)
            products *= newton[number][:, at_nodes].T
        known = self.coefficients.size
        missing = values - products[:, :known] @ self.coefficients
        self.coefficients = np.append(self.coefficients, _substituted(products[:, known:], missing))
        ends = np.where(self.high > self.low, 1.0, 0.0)
        self.table = SmoothTable(-ends, ends, np.array(self.numbers), self.coefficients, np.nan)

    def grow(self, large: float) -> bool:
        """Add products next to products with coefficients above ``large``; False where all have them."""
        sizes = dict(zip(self.numbers, np.abs(self.table.coefficients).tolist(), strict=True))
        known, variables = len(sizes), np.flatnonzero(self.high > self.low).tolist()
        queue = [number for number in self.numbers if sizes[number] > large]
        while queue:
            number = queue.pop()
            for beyond in (_moved(number, variable, 1) for variable in variables):
                if beyond in sizes or max(beyond) >= _MOST_ALONG:
                    continue
                lower = [sizes.get(_moved(beyond, k, -1)) for k in variables if beyond[k]]
                least = min((-1.0 if size is None else size for size in lower), default=-1.0)
                if least < 0.0:
                    continue
                sizes[beyond] = _NEXT * least
                if sizes[beyond] > large:
                    queue.append(beyond)
        new = list(sizes)[known:]
        if new:
            self._add(new)
        return bool(new)
