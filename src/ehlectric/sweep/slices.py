"""Slices of a sweep for figures: one value over one or two varied keys, and its interpolation between the
points.
"""

from __future__ import annotations

import math
import re
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy

from ehlectric.arrays import Array, IntArray, Mask
from ehlectric.cases.amounts import Amount, Count
from ehlectric.cases.axle_case import AxleCase
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.case import Case
from ehlectric.cases.drive_case import DriveCase
from ehlectric.cases.gear_case import GearCase
from ehlectric.cases.input_keys import kind_of, unit_of
from ehlectric.cases.table import nearest
from ehlectric.errors import InputError, short, shown
from ehlectric.quantities.former_keys import current_key
from ehlectric.quantities.lubrication_states import AT_TIMES, CONDUCTS, INSULATES, conducts, is_shorted
from ehlectric.quantities.results import is_text_of_points
from ehlectric.runtime.display import is_number
from ehlectric.sweep.axis_labels import result_keys
from ehlectric.sweep.points import Point, Status, as_number
from ehlectric.sweep.result import SweepResults
from ehlectric.sweep.sweep_inputs import Breakdown, breakdown_of, main_value

# Approximate number of nodes along each axis of a grid, and number of parts of the edge of a triangle.
# Contour lines are curved on logarithmic axes, and look smooth with these numbers.
_NODES, _PARTS = 160, 6
_POTENTIALS = ("electric.potential_1", "electric.potential_2")

# Smallest voltage between the surfaces that a case allows [V].
_LEAST_VOLTAGE = 1e-6


@dataclass(frozen=True)
class Surface:
    """Triangle mesh between the points of a slice, and the weights that interpolate to its nodes.

    The points are the corners of cells: rectangles of a full grid, or triangles. Each cell is divided into
    triangles of the mesh.
    """

    # x and y: positions of the nodes, in SI units, shape (nodes,).
    x: Array
    y: Array
    triangles: IntArray  # numbers of the nodes of each triangle, shape (triangles, 3)
    # Weight of each point of the slice at each node; the weights of a node add up to one,
    # shape (nodes, points).
    weights: scipy.sparse.csr_array
    # Numbers of the points at the corners of the cell that a triangle is part of, shape (triangles, 3 or 4).
    corners: IntArray

    def at_nodes(self, values: Array, *, log: bool = False) -> tuple[Array, Mask]:
        """Interpolate values from the points to the nodes.

        ``values``, values at the points, NaN where a point has none; positive if ``log``, shape (points,).
        Returns ``values``, values at the nodes, finite everywhere, but meaningless outside the triangles of
        ``whole``, shape (nodes,); ``whole``, mask of the triangles whose cell has a value at all of its
        corners, shape (triangles,).
        """
        known = np.isfinite(values)
        there = np.where(known, values, values[known][0] if np.any(known) else 1.0)
        nodes = np.asarray(self.weights @ (np.log(there) if log else there))
        # Rounding could exceed the values at the points, and so put a probability of 1 outside the colour
        # scale.
        ends = (float(np.min(there)), float(np.max(there)))
        return np.clip(np.exp(nodes) if log else nodes, *ends), self._whole(known)

    def alone(self, values: Array) -> Mask:
        """Mask of the points that have a value, but belong to no cell with a value at all of its corners.
        ``values``, values at the points, NaN where a point has none, shape (points,). Returns the mask,
        shape (points,).
        """
        left = np.isfinite(values)
        left[self.corners[self._whole(left)]] = False
        return left

    def _whole(self, known: Mask) -> Mask:
        """Mask of the triangles whose cell has a known value at all of its corners."""
        return np.asarray(np.all(known[self.corners], axis=1))


def surface_of(selection: Slice, *, log_x: bool, log_y: bool) -> Surface | None:
    """Mesh that interpolates between the points of a slice over two varied keys. Returns bilinear
    interpolation if the points are a full grid of any spacing, else linear interpolation in a Delaunay
    triangulation of the points; None if the points lie on a line, or differ in further varied keys.
    """
    if selection.free:
        return None
    grid = selection.grid()
    if grid is None:
        return _between_points(selection, log_x=log_x, log_y=log_y)
    xs, ys, numbers = grid
    if xs.size < 2 or ys.size < 2:
        return None
    x, cell_x, part_x = _between(xs, log=log_x)
    y, cell_y, part_y = _between(ys, log=log_y)
    i, j = np.divmod(np.arange(x.size * y.size), y.size)
    ends = ((0, 0), (1, 0), (0, 1), (1, 1))
    corners = np.column_stack([numbers[cell_x[i] + p, cell_y[j] + q] for p, q in ends])
    shares = [(part_x if p else 1.0 - part_x)[i] * (part_y if q else 1.0 - part_y)[j] for p, q in ends]
    node = np.arange(i.size).reshape(x.size, y.size)
    a, b, c, d = (part.ravel() for part in (node[:-1, :-1], node[1:, :-1], node[:-1, 1:], node[1:, 1:]))
    return Surface(
        x=x[i],
        y=y[j],
        triangles=np.concatenate([np.column_stack([a, b, d]), np.column_stack([a, d, c])]),
        weights=_weights(np.column_stack(shares), corners, len(selection.points)),
        corners=np.concatenate([corners[a], corners[a]]),
    )


def _weights(shares: Array, corners: IntArray, points: int) -> scipy.sparse.csr_array:
    """Weights of the points at the nodes, shape (nodes, points).

    ``shares`` are the weights of the corners of each node's cell, ``corners`` the numbers of their points;
    both have shape (nodes, corners).
    """
    rows = np.repeat(np.arange(len(corners)), corners.shape[1])
    weights = scipy.sparse.csr_array((shares.ravel(), (rows, corners.ravel())), shape=(len(corners), points))
    weights.eliminate_zeros()
    return weights


def curve_of(x: Array, values: Array, *, log_x: bool, log: bool) -> tuple[Array, Array]:
    """Interpolate values over increasing x, at the points and at nodes between them.

    ``x``, increasing positions of at least two points; positive if ``log_x``, shape (points,); ``values``,
    values at the points, NaN where a point has none; positive where ``log``, shape (points,). Returns nodes
    and the values there; NaN between two points of which at least one has no value, shape (nodes,).

    Examples
    --------
    A power of x on logarithmic axes, between two points:

    >>> x, y = curve_of(np.array([1.0, 4.0]), np.array([1.0, 8.0]), log_x=True, log=True)
    >>> bool(np.allclose(y, x**1.5))
    True
    """
    nodes, cell, part = _between(x, log=log_x)
    ends = _onto(values, log=log)
    between = (1.0 - part) * ends[cell] + part * ends[cell + 1]
    # A node at a point has the value of this point, even if the value of the neighbouring point is NaN.
    at_nodes = np.where(part == 0.0, ends[cell], np.where(part == 1.0, ends[cell + 1], between))
    return nodes, _back(at_nodes, log=log)


def applied_at(results: SweepResults, selection: Slice, along: Array, across: Any) -> Array | None:
    """Exact applied voltage between the points of a slice over a surface potential.

    The applied voltage is an absolute difference of two potentials. It must not be interpolated linearly if
    the potentials cross.

    Returns applied voltage [V], at least the 1e-6 V that a case allows; None if neither key is a potential,
    or the sweep is one of bearings or drives; the voltage is then interpolated between the points.
    """
    if not isinstance(results.case, Case) or not {selection.x, selection.y} & set(_POTENTIALS):
        return None
    there: dict[Any, Any] = {**selection.at, selection.x: along, selection.y: across}
    electric = results.case.electric
    first = there.get(_POTENTIALS[0], electric.potential_1)
    second = there.get(_POTENTIALS[1], electric.potential_2)
    return np.asarray(np.maximum(np.abs(second - first), _LEAST_VOLTAGE))


def _between(values: Array, *, log: bool) -> tuple[Array, IntArray, Array]:
    """Nodes at and between increasing values, with the number of their cell and their place in it, 0 to 1."""
    parts = max(1, _NODES // values.size)
    cell, step = np.divmod(np.arange((values.size - 1) * parts + 1), parts)
    last = cell == values.size - 1
    cell, part = np.where(last, cell - 1, cell), np.where(last, 1.0, step / parts)
    places = _onto(values, log=log)
    nodes = _back((1.0 - part) * places[cell] + part * places[cell + 1], log=log)
    return nodes, cell, part


def _between_points(selection: Slice, *, log_x: bool, log_y: bool) -> Surface | None:
    """Mesh in the Delaunay triangles of the points, with both axes scaled to the same length."""
    places = np.column_stack(
        [_onto(selection.along, log=log_x), _onto(np.array(selection.across, dtype=float), log=log_y)]
    )
    extent = np.ptp(places, axis=0)
    if np.any(extent == 0.0):
        return None
    try:
        corners = scipy.spatial.Delaunay(places / extent).simplices
    except (scipy.spatial.QhullError, ValueError):  # points on a line, or fewer than three
        return None
    steps = [(a, b) for a in range(_PARTS + 1) for b in range(_PARTS + 1 - a)]
    number = {step: k for k, step in enumerate(steps)}
    share = np.array([(_PARTS - a - b, a, b) for a, b in steps]) / _PARTS
    small = [(number[a, b], number[a + 1, b], number[a, b + 1]) for a, b in steps if a + b < _PARTS]
    small += [
        (number[a + 1, b], number[a + 1, b + 1], number[a, b + 1]) for a, b in steps if a + b < _PARTS - 1
    ]
    first = len(steps) * np.arange(len(corners))
    weights = _weights(
        np.tile(share, (len(corners), 1)), np.repeat(corners, len(steps), axis=0), len(selection.points)
    )
    nodes = np.asarray(weights @ places)
    return Surface(
        x=_back(nodes[:, 0], log=log_x),
        y=_back(nodes[:, 1], log=log_y),
        triangles=(first[:, np.newaxis, np.newaxis] + np.array(small)).reshape(-1, 3),
        weights=weights,
        corners=np.repeat(corners, len(small), axis=0),
    )


def spaced_log(results: SweepResults, key: str, values: Array) -> bool:
    """Whether a varied key is drawn on a logarithmic axis. Returns in a "sobol" design, True if the range of
    the key has logarithmic spacing.
    """
    if unit_of(key) == "K":
        return False
    if key in results.ranges:
        return results.ranges[key].spacing == "log"
    axis = np.unique(values)
    if axis.size < 3 or axis[0] <= 0.0:
        return False
    even, ratios = np.diff(axis), np.diff(np.log(axis))
    return bool(np.std(ratios) / np.mean(ratios) < 0.999 * np.std(even) / np.mean(even))


def _onto(values: Array, *, log: bool) -> Array:
    """Values, or their logarithms, in which the interpolation is linear."""
    return np.log(values) if log else values


def _back(places: Array, *, log: bool) -> Array:
    """Values from the result of ``_onto``."""
    return np.exp(places) if log else places


# Largest number of names or values that a message lists.
_MOST_LISTED = 8

# Longest text of a whole number that a float can hold [characters].
_LONGEST_WHOLE = 300


@dataclass(frozen=True)
class Slice:
    """Slice of a sweep: the points with fixed values of all except one or two varied keys."""

    x: str  # varied key along the horizontal axis
    y: str | None  # second varied key, if any
    value: str  # dotted key of the summary whose values are drawn
    breakdown: Breakdown  # keys of the breakdown voltage and the applied voltage that belong to ``value``
    at: Mapping[str, Any]  # fixed values of further varied keys, in SI units
    # Further varied keys that are not fixed; none in a "grid" design, where all must be fixed.
    free: tuple[str, ...]
    points: tuple[Point, ...]
    along: Array  # values of ``x``, in SI units, shape (points,)
    across: tuple[Any, ...]  # value of ``y`` at each point, SI numbers or texts; empty if ``y`` is None
    values: Array  # drawn values, in SI units; NaN where a point is not solved, or doubtful, shape (points,)
    voltage: Array  # applied voltage [V]; NaN where a point is not solved, or doubtful, shape (points,)
    margin: Array  # breakdown voltage divided by applied voltage; NaN where a point has none, shape (points,)
    # Names of a value that is a text: ``values`` are their numbers from 0. Empty if the value is a number.
    categories: tuple[str, ...] = ()

    def of(self, status: Status) -> Mask:
        """Mask of the points that have a status, shape (points,)."""
        return np.array([point.status == status for point in self.points])

    @property
    def doubtful(self) -> Mask:
        """Mask of the points that are solved, but have a severe warning, shape (points,)."""
        return np.array([point.doubtful for point in self.points])

    @property
    def intermittent(self) -> Mask:
        """Mask of bearings whose contacts open and close, so that they have no voltage, shape (points,)."""
        return np.asarray(self.of("solved") & np.array([is_shorted(point.summary) for point in self.points]))

    @property
    def conducting(self) -> Mask:
        """Mask of gear meshes that conduct, so that they have no voltage, shape (points,)."""
        return np.asarray(self.of("solved") & np.array([conducts(point.summary) for point in self.points]))

    @property
    def of_discharge(self) -> bool:
        """Whether the drawn value is a breakdown voltage, a margin or another result of [discharge]."""
        return self.value.startswith("discharge.") or self.value in self.breakdown.keys

    @property
    def numeric(self) -> bool:
        """Whether ``y`` is a number at all points."""
        return self.y is not None and all(map(is_number, self.across))

    def check_numeric(self) -> None:
        """Check that the values of the second key are numbers, as a map needs. Raises InputError if they are
        texts or lists.
        """
        if not self.numeric:
            raise InputError.worded(
                "y",
                f"got {shown(self.y)}, whose values are strings or lists; a map needs numbers",
                got=shown(self.y),
                takes="numbers",
            )

    def grid(self) -> tuple[Array, Array, IntArray] | None:
        """Arrange the points as a full grid of ``x`` and ``y``. Returns increasing values of ``x``,
        shape (nx,), and of ``y``, shape (ny,); the third item is the index in ``points`` for each pair,
        shape (nx, ny). None if a pair has no point, or two points.
        """
        xs, i = np.unique(self.along, return_inverse=True)
        ys, j = np.unique(np.array(self.across, dtype=float), return_inverse=True)
        if xs.size * ys.size != len(self.points) or np.unique(i * ys.size + j).size != len(self.points):
            return None
        numbers = np.empty((xs.size, ys.size), dtype=np.intp)
        numbers[i, j] = np.arange(len(self.points))
        return xs, ys, numbers

    def series(self) -> list[tuple[Any, IntArray]]:
        """Group the points by their value of ``y``. Returns each value of ``y``, with the indices in
        ``points`` of its points by increasing ``x``; numbers are sorted; texts are in the order of the
        design. If ``y`` is None, there is a single group, of value None.
        """
        groups: dict[Any, list[int]] = {}
        for k, value in enumerate(self.across or [None] * len(self.points)):
            groups.setdefault(value, []).append(k)
        series = []
        for value in sorted(groups) if self.numeric else groups:
            numbers = np.array(groups[value], dtype=np.intp)
            series.append((value, numbers[np.argsort(self.along[numbers], kind="stable")]))
        return series


def select_slice(
    results: SweepResults, x: str, y: str | None, value: str, at: Mapping[str, str] | None = None
) -> Slice:
    """Select a slice of a sweep over one or two varied keys. ``y``, second varied key, if any. Returns points
    of the slice, in the order of the design; varied keys with a single value are also fixed. Raises
    InputError if a key does not vary, or the values of ``x`` are not numbers.
    """
    for name, key in (("x", x), ("y", y)):
        if key is not None and key not in results.varied:
            near = f"; nearest is {nearest(key, results.varied)}" if results.varied else ""
            raise InputError(
                name, got=shown(key), takes=f"a key that varies: {_listed(results.varied)}{near}"
            )
    if x == y:
        raise InputError("y", got=f"{shown(y)}, which is x;", takes="another key that varies")
    if not all(is_number(point.inputs.get(x)) for point in results.points):
        raise InputError("x", got=f"{shown(x)}, whose values are strings or lists", takes="a key of numbers")
    value = current_key(value, result_keys(results.case))
    _check_known(results, value)
    fixed = {key: _fixed(results, key, text) for key, text in (at or {}).items()}
    for key in fixed:
        if key in (x, y):
            raise InputError(
                "at", got=f"{key}, which is {'x' if key == x else 'y'}", takes="another varied key"
            )
    fixed |= _alone(results, {x, y, *fixed})
    free = tuple(key for key in results.varied if key not in (x, y, *fixed))
    if free and results.design == "grid":
        first = free[0]
        raise InputError(
            "at",
            f"missing, {', '.join(free)} var{'ies' if len(free) == 1 else 'y'} too;",
            takes=f"{first}=VALUE, one of {_listed(_axis(results, first))}{_si(first)}",
        )
    chosen = [
        k
        for k, p in enumerate(results.points)
        if all(_hashable(p.inputs.get(key)) == v for key, v in fixed.items())
    ]
    if not chosen:
        raise InputError(
            "at", f"no point of the sweep has {', '.join(f'{k} = {v}' for k, v in fixed.items())}"
        )
    chosen = _finite(results, chosen, x, y)
    taken = _slice(results, chosen, (x, y), value, fixed, free)
    if not np.any(np.isfinite(taken.values)):
        raise InputError(
            "value", f"{value} is in none of the {_drawn(taken.points)}, there is nothing to show"
        )
    return taken


def _check_known(results: SweepResults, value: str) -> None:
    """Raise an InputError if no point has a number or a name at a key."""
    if not categories_of(results, value):
        numbers_of(results, value)


def whole(results: SweepResults, value: str) -> Slice:
    """Slice of all points over the first two varied keys, also where no point has the value."""
    x, *others = results.varied
    return _slice(results, range(len(results.points)), (x, next(iter(others), None)), value, {}, ())


def _slice(
    results: SweepResults,
    chosen: Sequence[int],
    keys: tuple[str, str | None],
    value: str,
    fixed: Mapping[str, Any],
    free: tuple[str, ...],
) -> Slice:
    """Slice of the points with some numbers."""
    (x, y), rows = keys, list(chosen)
    points = tuple(results.points[k] for k in rows)
    # Values of points with a severe warning are not drawn in figures.
    usable = np.where([point.doubtful for point in points], np.nan, 1.0)
    names = categories_of(results, value)
    numbers = (
        [names.index(name) if name else None for name in results.columns[value]]
        if names
        else results.numbers.get(value, [None] * len(results.points))
    )
    breakdown = breakdown_of(results.case, value)
    return Slice(
        x=x,
        y=y,
        value=value,
        breakdown=breakdown,
        at=fixed,
        free=free,
        points=points,
        along=np.array([as_number(point.inputs[x]) for point in points]),
        across=() if y is None else tuple(_hashable(point.inputs.get(y)) for point in points),
        values=usable * np.array(numbers, dtype=float)[rows],
        voltage=usable * breakdown.voltages(results)[rows],
        margin=usable * breakdown.margins(results)[rows],
        categories=names,
    )


def categories_of(results: SweepResults, value: str) -> tuple[str, ...]:
    """Names that a text of the summaries has at the points of a sweep; empty for a number.

    Elements of an axle are in the order of the file, states from conducting to insulating, and other names in
    the order of the points.
    """
    if not is_text_of_points(value):
        return ()
    case = results.case
    elements = case.keys_of_elements().values() if isinstance(case, AxleCase) else ()
    present = dict.fromkeys(name for name in results.columns.get(value, ()) if name)
    known = dict.fromkeys((*elements, CONDUCTS, AT_TIMES, INSULATES))
    return tuple(name for name in (known | present) if name in present)


def _finite(results: SweepResults, chosen: Sequence[int], x: str, y: str | None) -> list[int]:
    """Numbers of the chosen points that have a place on both axes. Warns of points with an infinite input."""
    axes = [key for key in (x, y) if key is not None]
    inputs = {k: [results.points[k].inputs.get(key) for key in axes] for k in chosen}
    kept = [k for k, row in inputs.items() if not any(isinstance(v, float) and math.isinf(v) for v in row)]
    if not kept:
        raise InputError("x", got="infinite inputs only", takes="a key with finite values")
    if len(kept) < len(chosen):
        text = f"{len(chosen) - len(kept)} of {len(chosen)} points have an infinite input and are not drawn"
        warnings.warn(text, stacklevel=3)
    return kept


def _drawn(points: Sequence[Point]) -> str:
    """Text: number of points in a slice, and number of points with a severe warning."""
    doubtful = sum(point.doubtful for point in points)
    text = f"{len(points)} points that are drawn"
    return text + (f', of which {doubtful} are solved but say "do not use"' if doubtful else "")


def known_values(results: SweepResults) -> list[str]:
    """Dotted keys of the summaries that have a number at some solved point, in their order."""
    return list(results.numbers)


def numbers_of(results: SweepResults, value: str) -> Array:
    """Value of a key of the summary at every point of a sweep. Returns values in SI units; NaN where a point
    has none, shape (points,). Raises InputError if no point is solved, or no solved point has a number at
    this key.
    """
    if not any(point.solved for point in results.points):
        raise InputError(f"no point of {len(results.points)} is solved, there is nothing to show")
    known = known_values(results)
    if value not in known:
        near, cause = _near(value, known), _lacking(results, value, known)
        takes = f"a number of summary.json; nearest is {near}{cause}"
        raise InputError("value", got=shown(value), takes=takes)
    return results.values(value)


def _near(value: str, known: Sequence[str]) -> str:
    """Known key that is nearest: of the same table, else with the same name in another table, else any."""
    within, leaf = value.partition(".")[0] + ".", value.rpartition(".")[2]
    same = [key for key in known if key.startswith(within)]
    return nearest(value, same or [key for key in known if key.endswith(f".{leaf}")] or known)


def _lacking(results: SweepResults, value: str, known: Sequence[str]) -> str:
    """Why a sweep has no number of the table ``discharge``; empty for another table."""
    if not value.startswith("discharge.") or any(key.startswith("discharge.") for key in known):
        return ""
    if isinstance(results.case, DriveCase):
        return f"; a drive has {main_value(results.case)}"
    if isinstance(results.case, BearingCase):
        keys = [key for key in ("bearing.first_break", "bearing.margin") if key in known]
        names = " and ".join(keys)
        return f"; of a bearing it is {names}" if keys else "; no point has a breakdown voltage"
    if isinstance(results.case, GearCase):
        return "; of a gear pair it is mesh.breakdown_voltage and mesh.margin"
    return (
        "; the case has no [discharge]" if results.case.discharge is None else "; no point has such a number"
    )


def _hashable(value: Any) -> Any:
    """Value as a float if it is a number, else as text."""
    return float(value) if is_number(value) else str(value)


def _axis(results: SweepResults, key: str) -> list[Any]:
    """Distinct values of a varied key, in the order of the points."""
    return list(dict.fromkeys(_hashable(point.inputs.get(key)) for point in results.points))


def _alone(results: SweepResults, excluded: set[str | None]) -> dict[str, Any]:
    """Varied keys that have a single value in the whole sweep, with this value."""
    axes = {key: _axis(results, key) for key in results.varied if key not in excluded}
    return {key: values[0] for key, values in axes.items() if len(values) == 1}


def _fixed(results: SweepResults, key: str, text: str) -> Any:
    """Value of a varied key in the sweep that is nearest to a requested one."""
    if key not in results.varied:
        near = nearest(key, results.varied) if results.varied else "none"
        raise InputError("at", got=shown(key), takes=f"a key that varies; nearest is {near}")
    if results.design == "sobol":
        raise InputError("at", got=f"{key}, of which a sobol design has no two points alike;", takes="a grid")
    axis = _axis(results, key)
    if not all(map(is_number, axis)):
        if text not in axis:
            raise InputError("at", got=f"{key}={short(text)}", takes=f"one of {_listed(axis)}")
        return text
    requested = _requested(key, text)
    low, high = min(axis), max(axis)
    slack = 1e-6 * max(abs(low), abs(high))
    if not low - slack <= requested <= high + slack:
        raise InputError(
            "at", got=f"{key}={short(text)}", takes=f"a value from {low:g} to {high:g}{_si(key)}"
        )
    return min(axis, key=lambda other: abs(other - requested))


def _requested(key: str, text: str) -> float:
    """SI value of a text with a number, with or without a unit."""
    try:
        number: float | None = float(text)
    except ValueError:
        number = None
    kind = kind_of(key)
    if kind is None or isinstance(kind, Count):
        if number is None:
            raise InputError("at", got=f"{key}={short(text)}", takes="a number")
        return number
    # A longer number is infinite as a float, and Python makes no whole number of it.
    whole = len(text) <= _LONGEST_WHOLE and re.fullmatch(r"[-+]?\d+", text)
    try:
        return kind.parse(text if number is None else int(text) if whole else number, written=True)
    except InputError as error:
        raise error.with_text("at", f"{key}: {error}") from None


def _si(key: str) -> str:
    """SI unit of a key of the case with a space before it; empty if it has none."""
    kind = kind_of(key)
    unit = kind.unit if isinstance(kind, Amount) else ""
    return f" {unit}" if unit else ""


def _listed(values: Any) -> str:
    """Text that lists the first of some names or values."""
    texts = [f"{value:g}" if is_number(value) else str(value) for value in values]
    return ", ".join(texts[:_MOST_LISTED]) + (" ..." if len(texts) > _MOST_LISTED else "")
