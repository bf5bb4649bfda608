"""Tables of the atlas: interpolation between its nodes, its error, its range, and nodes filled from their
neighbours.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache, reduce
from importlib.resources import files
from itertools import product
from operator import and_
from typing import Any

import numpy as np

from ehlectric.arrays import Array, IntArray, Mask, Numbers
from ehlectric.errors import InputError
from ehlectric.formulas.tensor_spline import TensorSpline

# Numbers of each film, in this order.
#   central: rho(0) h(0)/rho0 in Moes' unit.           minimum: h_min in Moes' unit.
#   mean: mean of h over the Hertz zone in Moes' unit. pressure: p(0)/p_h.
#   zone: mean of rho(0) h(0)/(rho h) over the Hertz zone.
#   inlet, outlet: integral of dA/h before and behind the middle of the contact, outside the Hertz zone and
#   inside x from -4.5 b to 1.5 b (lines: -4 b to 2 b) and 1.6 a + 1.4 b (at most 4.5 a) at the sides, over
#   the same integral of the dry gap plus h(0).
#   minimum_x, minimum_y: place of the minimum in semi-axes b and a.
NAMES = ("central", "minimum", "mean", "pressure", "zone", "inlet", "outlet", "minimum_x", "minimum_y")

# The error of a spline through every node divided by the error of a spline through every second node: a
# sixteenth for smooth values; kinks, where the minimum changes its place or a spike passes the centre, do
# worse.
HALVED = 1.0 / 5.0

# Relative distance within which a coordinate equals the coordinate of a node.
_ALIKE = 1e-9

# Growth of the relative errors outside the table below and above each coordinate, for each change of it by a
# factor of e. A table without its first or its last one to three nodes has such errors in 95 % of the nodes
# without which it is; films lighter than all others approach the films of rigid bodies.
_GROWTH = {
    "points": ((0.45, 0.15), (0.25, 0.15), (0.9, 0.1)),
    "lines": ((0.12, 0.03), (0.03, 0.05)),
}
_MOST_OF_LIGHT = 0.4

# What a coordinate is that is not a group of Moes.
_MEANING = {"moes_n": " in N, which is M times a function of k", "moes_y": " in Y, which is L N^(1/6)"}


@dataclass(frozen=True, eq=False)
class Table:
    """Films of one kind of contact on a tensor grid in the logarithms of its coordinates.

    Attributes
    ----------
    names : tuple of str
        Names of the coordinates, for messages.
    axes : tuple of ndarray
        Nodes along each axis.
    values, errors : ndarray, shape (..., n)
        Stored numbers at the nodes, and the errors of their discretisation.
    solved : ndarray of bool, shape (...)
        Nodes with a converged film.
    growth : tuple of two floats for each axis
        Growth of the errors below and above its nodes, for a change of the coordinate by a factor of e.
    """

    names: tuple[str, ...]
    axes: tuple[Array, ...]
    values: Array
    errors: Array
    solved: Mask
    growth: tuple[tuple[float, float], ...]

    @cached_property
    def _spline(self) -> TensorSpline:
        return TensorSpline.through([np.log(axis) for axis in self.axes], self.values)

    @cached_property
    def _error(self) -> TensorSpline:
        """Error of discretisation and interpolation, and its growth towards nodes without a film, which is
        the last number; linear between nodes.
        """
        total, (nearest, more) = self.errors + self.interpolation_errors, self._without_film
        total[~self.solved] = total[self.solved][nearest]
        growth = np.zeros((*self.solved.shape, 1))
        growth[~self.solved, 0] = more
        both = np.concatenate([total, growth], axis=-1)
        return TensorSpline.through([np.log(axis) for axis in self.axes], both, degree=1)

    @cached_property
    def _without_film(self) -> tuple[IntArray, Array]:
        """Number of the solved node nearest to each node without a film, and growth of the error from it."""
        scaled = [max(rates) * np.log(axis) for axis, rates in zip(self.axes, self.growth, strict=True)]
        places = np.stack(np.meshgrid(*scaled, indexing="ij"), axis=-1)
        # Coordinate by coordinate: an array of all differences does not fit into the processor's cache.
        pairs = zip(places[~self.solved].T, places[self.solved].T, strict=True)
        growth = sum(np.abs(np.subtract.outer(*pair)) for pair in pairs)
        return np.argmin(growth, axis=1), np.min(growth, axis=1)

    @cached_property
    def interpolation_errors(self) -> Array:
        """Estimated error of interpolation near each node, from a spline through every second node.

        At a node of the coarser grid it is the largest one of its neighbours.
        """
        logs = [np.log(axis) for axis in self.axes]
        # Both ends of an axis belong to every second node, so that nothing is extrapolated.
        every = [np.unique(np.append(np.arange(0, axis.size, 2), axis.size - 1)) for axis in logs]
        nodes = [axis[index] for axis, index in zip(logs, every, strict=True)]
        coarse = TensorSpline.through(nodes, self.values[np.ix_(*every)])
        at = np.stack(np.meshgrid(*logs, indexing="ij"), axis=-1)
        missed = np.where(self.solved[..., np.newaxis], np.abs(coarse(at) - self.values), 0.0)
        return HALVED * _largest_near(missed)

    def __call__(self, *at: Numbers) -> tuple[Array, Array]:
        """Stored numbers and their errors at points of shape (...), each of shape (numbers, ...).

        Points that ``has`` does not contain have no meaningful numbers; a single one of them, of shape (), is
        refused with an InputError.
        """
        if np.ndim(at[0]) == 0:
            self.check(*map(float, at))
        points = np.stack(np.broadcast_arrays(*at), axis=-1)
        logs = np.log(points)
        return np.moveaxis(self._spline(logs), -1, 0), np.moveaxis(self._error(logs)[..., :-1], -1, 0)

    def continued(self, *at: Numbers) -> tuple[Array, Array, Array]:
        """Stored numbers, their errors in the table and the growth of these errors outside the table.

        Outside the table they continue the numbers at its nearest point: the numbers of heavier films follow
        powers of the first coordinate, and all others are constant. The numbers of a point that is not finite
        have no meaning. Returns arrays of shape (numbers, ...), (numbers, ...) and (...).
        """
        at = np.broadcast_arrays(*at)
        usable = reduce(and_, [np.isfinite(value) & (value > 0.0) for value in at])
        logs = [
            np.log(np.where(usable, value, middle)) for value, middle in zip(at, self.middle, strict=True)
        ]
        inside = [np.log(value) for value in self.nearest(*map(np.exp, logs))]
        points = np.stack(inside, axis=-1)
        numbers, both = (np.moveaxis(law(points), -1, 0) for law in (self._spline, self._error))
        heavier = logs[0] > inside[0]
        if np.any(heavier):
            # The last two nodes have the power of the load.
            step = np.log(self.axes[0][-1] / self.axes[0][-2])
            before = np.moveaxis(self._spline(points[heavier] - [step, *np.zeros(len(logs) - 1)]), -1, 0)
            steps = (logs[0] - inside[0])[heavier] / step
            numbers[:, heavier] += steps * (numbers[:, heavier] - before)
        return numbers, both[:-1], both[-1] + self._grown(logs, inside)

    def _grown(self, logs: list[Array], inside: list[Array]) -> Array:
        """Growth of the errors from the nearest points ``inside`` the table, both as logarithms."""
        total = np.zeros(logs[0].shape)
        for number, (log, near, (low, high)) in enumerate(zip(logs, inside, self.growth, strict=True)):
            below, above = low * np.maximum(0.0, near - log), high * np.maximum(0.0, log - near)
            total += above + (np.minimum(below, _MOST_OF_LIGHT) if number == 0 else below)
        return total

    def nearest(self, *at: Numbers) -> tuple[Numbers, ...]:
        """Coordinates of points, of shapes that broadcast, within the range of the table."""
        return tuple(np.clip(value, axis[0], axis[-1]) for axis, value in zip(self.axes, at, strict=True))

    @cached_property
    def middle(self) -> tuple[float, ...]:
        """Point in the middle of the table, which stands for points that it does not have."""
        return tuple(float(axis[axis.size // 2]) for axis in self.axes)

    def has(self, *at: Numbers) -> Mask:
        """Whether points of shape (...) lie in the table, in a cell whose nodes all have a film."""
        return self._within(*at) & self._in_solved_cell(*at)

    def _within(self, *at: Numbers) -> Mask:
        """Whether points of shape (...) lie in the range of the table."""
        inside = [(axis[0] <= value) & (value <= axis[-1]) for axis, value in zip(self.axes, at, strict=True)]
        return np.asarray(reduce(and_, inside))

    def _in_solved_cell(self, *at: Numbers) -> Mask:
        """Whether all nodes of the cells of points of shape (...) have a film."""
        cells = [self._cell(axis, value) for axis, value in zip(self.axes, at, strict=True)]
        return np.asarray(reduce(and_, (self.solved[corner] for corner in product(*cells))))

    @staticmethod
    def _cell(axis: Array, value: Numbers) -> tuple[IntArray, IntArray]:
        """Places of the nodes below and above values; on a node, as round contacts are, both are it."""
        upper = np.clip(np.searchsorted(axis, value), 1, axis.size - 1)
        lower = upper - 1
        on_lower = np.abs(axis[lower] - value) <= _ALIKE * value
        on_upper = np.abs(axis[upper] - value) <= _ALIKE * value
        return np.where(on_upper, upper, lower), np.where(on_lower, lower, upper)

    def check_range(self, *at: float) -> None:
        """Raise an InputError for a point outside the table."""
        for name, axis, value in zip(self.names, self.axes, at, strict=True):
            if not axis[0] <= value <= axis[-1]:
                said = f"{axis[0]:.4g} to {axis[-1]:.4g}, the range of the atlas{_MEANING.get(name, '')}"
                raise InputError(name, got=f"{value:.4g}", takes=said)

    def check(self, *at: float) -> None:
        """Raise an InputError for a point outside the table, or in a cell with a node without a film."""
        self.check_range(*at)
        if not self._in_solved_cell(*at):
            where = ", ".join(f"{name} = {value:.4g}" for name, value in zip(self.names, at, strict=True))
            raise InputError(
                "atlas", got=where, takes="a contact near solved ones; the atlas has no film there: solve it"
            )


def _largest_near(values: Array) -> Array:
    """Largest value of a node and its neighbours along each axis except the last."""
    for axis in range(values.ndim - 1):
        ends = [(1, 1) if i == axis else (0, 0) for i in range(values.ndim)]
        wide = np.pad(values, ends, mode="edge")
        n = values.shape[axis]
        values = np.maximum.reduce([np.take(wide, range(i, i + n), axis) for i in range(3)])
    return values


@lru_cache(maxsize=1)
def _file() -> dict[str, Any]:
    """Content of the data file, read at the first use."""
    with files(__package__).joinpath("films.npz").open("rb") as file, np.load(file) as arrays:
        return {name: arrays[name] for name in arrays.files}


@lru_cache(maxsize=2)
def table(kind: str) -> Table:
    """Table of "points" or "lines"."""
    data, names = _file(), ("moes_n", "moes_y", "ratio") if kind == "points" else ("moes_m", "moes_y")
    parts = ("load", "lubricant", "ratio")[: len(names)]
    return Table(
        names,
        tuple(data[f"{kind}_{part}"] for part in parts),
        np.asarray(data[f"{kind}_values"], dtype=float),
        np.asarray(data[f"{kind}_errors"], dtype=float),
        data[f"{kind}_solved"],
        _GROWTH[kind],
    )
