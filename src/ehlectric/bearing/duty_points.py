"""Operating points of a duty cycle: each is solved once, and very many are interpolated between a design."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import product

import numpy as np
import scipy

from ehlectric.arrays import Array, IntArray, Mask, Numbers
from ehlectric.bearing.bearing_discharges import shaft_voltage
from ehlectric.bearing.many_points import gathered, solved_parts
from ehlectric.bearing.rating_life import fatigue_of
from ehlectric.bearing.solution import (
    BearingSolution,
    capacitance,
    contact_limit,
    lambda_ratio,
    part_over_summits,
    touches,
)
from ehlectric.bearing.summary import breaks
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.quantities.inputs import TEMPERATURE

# Quantities of a point that rating lives need in addition.
_OF_LIFE = ("viscosity", "reference_turns")

# Quantities of a point: lambda ratio, capacitance [F], first breakdown and shaft voltage [V], and margin.
NAMES = ("lambda_ratio", "capacitance", "first_break", "shaft_voltage", "margin")

# Largest number of points that are solved, which take several seconds; more are interpolated.
MOST_SOLVED = 4000

# Quantities that touching surfaces do not have, and those that fall to 0 where summits begin to touch.
_VOLTAGES = ("first_break", "shaft_voltage", "margin")
_OVER_SUMMITS = ("first_break", "margin")

# Interpolated lambda ratio, divided by the ratio of touching surfaces, from which a point may have a voltage
# after all.
_NEARLY = 0.95

# Points at which the interpolation is compared with solved ones.
_COMPARED = 256

# Numbers of steps of a design along each input, the finest first.
_STEPS = (64, 48, 40, 32, 28, 24, 20, 17, 14, 12, 10, 8, 6, 5, 4, 3, 2, 1)


@dataclass(frozen=True)
class PointValues:
    """Quantities of n operating points."""

    # By the names in ``NAMES``, and in ``Fatigue`` if the case has rating lives, shape (n,); NaN if a point
    # has none.
    values: Mapping[str, Array]
    reasons: Mapping[int, str]  # why a point has no result, by its place
    solved: int  # number of solved bearings
    error: float | None = None  # largest relative error by interpolation, of those compared; None without it


def values_at(case: BearingCase, inputs: Mapping[str, Array]) -> PointValues:
    """Quantities of a bearing with estimated contacts at many points, equal ones computed once.

    ``inputs``, numbers by dotted key, SI units, shape (n,). More than ``MOST_SOLVED`` different points are
    interpolated.
    """
    keys = tuple(inputs)
    return values_of_rows(inputs, partial(_solved, case, keys), partial(_interpolated, case, keys))


def values_of_rows(
    inputs: Mapping[str, Array],
    solve: Callable[[Array], PointValues],
    interpolate: Callable[[Array], PointValues],
) -> PointValues:
    """Quantities at many points, equal ones computed once.

    ``inputs``, numbers by their names, shape (n,); ``solve`` gives the quantities at the rows of a table with
    a column for each input, shape (m, inputs), and ``interpolate`` replaces it for more than ``MOST_SOLVED``
    rows.
    """
    table, place = np.unique(np.column_stack(list(inputs.values())), axis=0, return_inverse=True)
    points = solve(table) if len(table) <= MOST_SOLVED else interpolate(table)
    place = place.reshape(-1)
    reasons = {k: points.reasons[p] for k, p in enumerate(place.tolist()) if p in points.reasons}
    values = {name: column[place] for name, column in points.values.items()}
    return PointValues(values, reasons, points.solved, points.error)


@dataclass(frozen=True, eq=False)
class Design:
    """Nodes around the rows of a table, between which quantities are interpolated."""

    nodes: Array  # shape (m, columns)
    corners: IntArray  # nodes around each row, shape (n, 2^d)
    weights: Array  # shape (n, 2^d)

    @classmethod
    def of(cls, table: Array, scaled: Mask) -> Design:
        """Finest regular design for the rows of a table, shape (n, columns), whose nodes are few enough.

        ``scaled``, columns that are interpolated over their logarithms, if all of their values are positive.
        """
        low, high = table.min(axis=0), table.max(axis=0)
        varied = np.flatnonzero(high > low)
        log = scaled & (low > 0.0)
        ends = [_scaled(end, log)[varied] for end in (low, high)]
        unit = (_scaled(table, log)[:, varied] - ends[0]) / (ends[1] - ends[0])
        nodes, corners, weights = _design(unit)
        points = np.repeat(low[np.newaxis], len(nodes), axis=0)
        points[:, varied] = ends[0] + nodes * (ends[1] - ends[0])
        points[:, varied] = np.where(log[varied], np.exp(points[:, varied]), points[:, varied])
        return cls(np.clip(points, low, high), corners, weights)

    def between(self, column: Array) -> Array:
        """Values of a quantity at all rows, shape (n,), from values at the nodes, shape (m,)."""
        return _between(column, self.corners, self.weights)


def places_to_compare(number: int, without: IntArray | None = None) -> IntArray:
    """Places among a number of rows at which interpolated values are compared with solved ones."""
    places = np.linspace(0, number - 1, _COMPARED).astype(int)
    return np.setdiff1d(places, [] if without is None else without)


def largest_error(
    values: Mapping[str, Array], exact: Mapping[str, Array], places: IntArray, names: Sequence[str]
) -> float:
    """Largest relative error of quantities at the compared places."""
    errors = [np.abs(values[name][places] / exact[name] - 1.0) for name in names]
    return float(np.nanmax(errors, initial=0.0))


def _solved(case: BearingCase, keys: tuple[str, ...], table: Array) -> PointValues:
    """Quantities at the rows of a table with a column for each key, shape (n, keys)."""
    reasons: dict[int, str] = {}
    many = case.with_arrays(dict(zip(keys, table.T, strict=True)))
    names = NAMES if case.bearing.life is None else (*NAMES, *_OF_LIFE)
    columns = gathered(solved_parts(many, reasons=reasons), _numbers, (len(names), len(table)))
    return PointValues(dict(zip(names, columns, strict=True)), reasons, len(table))


def _numbers(solution: BearingSolution) -> tuple[Numbers | None, ...]:
    """Quantities of solved points in the order of ``NAMES`` and ``_OF_LIFE``; None for what no point has."""
    broken, life = breaks(solution), solution.case.bearing.life
    voltages = broken["first_break"], shaft_voltage(solution), broken["margin"]
    columns = lambda_ratio(solution), capacitance(solution), *voltages
    if life is None:
        return columns
    fatigue = fatigue_of(solution, life)
    return *columns, *(getattr(fatigue, name) for name in _OF_LIFE)


def _interpolated(case: BearingCase, keys: tuple[str, ...], table: Array) -> PointValues:
    """Quantities at the rows of a table between the nodes of a design, and the error at some of the rows."""
    # Films follow powers of speed and load, which are straight lines in logarithms.
    between = Design.of(table, np.array([key != TEMPERATURE for key in keys]))
    design = _solved(case, keys, between.nodes)
    height = case.bearing.summit_height
    smooth = _smooth(design.values, height)
    values = {name: between.between(column) for name, column in smooth.items()}
    # No voltage is computed where surfaces touch. Points next to points with touching surfaces are solved.
    touching = touches(values["lambda_ratio"], height)
    for name in _VOLTAGES:
        part = part_over_summits(values["lambda_ratio"], height) if name in _OVER_SUMMITS else 1.0
        values[name] = np.where(touching, np.nan, values[name] * part)
    edge = _next_to_touching(design.values, between.corners, height)
    edge &= values["lambda_ratio"] > _NEARLY * contact_limit(height)
    places = np.flatnonzero(edge)[:MOST_SOLVED]
    compared = places_to_compare(len(table), places)
    exact = _solved(case, keys, table[np.concatenate([places, compared])])
    apart = {name: column[places.size :] for name, column in exact.values.items()}
    error = largest_error(values, apart, compared, ("lambda_ratio", "margin"))
    for name, column in exact.values.items():
        values[name][places] = column[: places.size]
    reason = next(iter({**design.reasons, **exact.reasons}.values()), "")
    unknown = np.flatnonzero(np.isnan(values["lambda_ratio"])).tolist()
    return PointValues(values, dict.fromkeys(unknown, reason), design.solved + exact.solved, error)


def _smooth(values: Mapping[str, Array], height: float) -> dict[str, Array]:
    """Quantities with the voltages of smooth films, which are powers of the inputs, instead of voltages over
    summits of a height in units of the composite Rq.
    """
    part = part_over_summits(values["lambda_ratio"], height)
    return {name: column / part if name in _OVER_SUMMITS else column for name, column in values.items()}


def _next_to_touching(design: Mapping[str, Array], corners: IntArray, height: float) -> Mask:
    """Points some of whose corners have touching surfaces and no voltage, and some have one, shape (n,)."""
    insulates = ~touches(design["lambda_ratio"], height)[corners]
    mixed: Mask = np.any(insulates, axis=-1) & ~np.all(insulates, axis=-1)
    return mixed


def _scaled(table: Array, log: Array) -> Array:
    """Numbers, or their logarithms in the columns that have one."""
    return np.where(log, np.log(np.where(log, table, 1.0)), table)


def _design(unit: Array) -> tuple[Array, IntArray, Array]:
    """Finest regular design whose used nodes are few enough, for points within the unit cube, shape (n, d).

    Returns the used nodes, shape (m, d), and the places and weights of the corners around each point, shape
    (n, 2^d).
    """
    corner = np.array(list(product((0, 1), repeat=unit.shape[1])))
    for steps in _STEPS:
        cell = np.minimum((steps * unit).astype(int), steps - 1)
        cells, place = np.unique(cell, axis=0, return_inverse=True)
        around = cells[:, np.newaxis, :] + corner
        nodes, corners = np.unique(around.reshape(-1, unit.shape[1]), axis=0, return_inverse=True)
        if len(nodes) <= MOST_SOLVED - _COMPARED:
            break
    part = (steps * unit - cell)[:, np.newaxis, :]
    weights = np.prod(np.where(corner == 1, part, 1.0 - part), axis=-1)
    return nodes / steps, corners.reshape(len(cells), -1)[place.reshape(-1)], weights


def between_places(nodes: Array, values: Array, at: Array) -> Array:
    """Values at places, shape (n, d) -> (n, k), between nodes, shape (m, d), with values of shape (m, k).

    Linear radial basis functions, within the values of the nodes; NaN where the nearest node has no value.
    """
    # They take a while to load.

    places, place_of = np.unique(nodes, axis=0, return_inverse=True)
    sums = np.zeros((len(places), values.shape[1]))
    np.add.at(sums, place_of.reshape(-1), values)
    means = sums / np.bincount(place_of.reshape(-1))[:, np.newaxis]
    known = np.isfinite(means[:, 0])
    if np.count_nonzero(known) > 1:
        interpolated = scipy.interpolate.RBFInterpolator(
            places[known], means[known], kernel="linear", degree=0
        )(at)
        interpolated = np.clip(interpolated, np.min(means[known], axis=0), np.max(means[known], axis=0))
    else:
        interpolated = np.broadcast_to(means[known] if np.any(known) else np.nan, (len(at), values.shape[1]))
    return np.where(
        known[np.argmin(scipy.spatial.distance.cdist(at, places), axis=1), np.newaxis], interpolated, np.nan
    )


def spread_places(at: Array, number: int) -> IntArray:
    """Indices of at most so many places that are spread over all of them, shape (n, d): each is the farthest
    from those before it, and the first is the nearest to the mean.

    Examples
    --------
    >>> spread_places(np.array([[0.0], [1.0], [1.1], [3.0]]), 3).tolist()
    [2, 3, 0]
    """
    chosen = [int(np.argmin(np.sum((at - np.mean(at, axis=0)) ** 2, axis=1)))]
    distance = np.full(len(at), np.inf)
    while len(chosen) < number:
        distance = np.minimum(distance, np.sum((at - at[chosen[-1]]) ** 2, axis=1))
        farthest = int(np.argmax(distance))
        if distance[farthest] == 0.0:
            break
        chosen.append(farthest)
    return np.array(chosen)


def _between(column: Array, corners: IntArray, weights: Array) -> Array:
    """Values between corners, by logarithms; corners without a value are ignored."""
    logs = np.log(np.where(column > 0.0, column, np.nan))[corners]
    known = np.isfinite(logs)
    total = np.sum(weights, axis=-1, where=known)
    mean = np.sum(np.where(known, logs, 0.0) * weights, axis=-1) / np.where(total > 0.0, total, 1.0)
    return np.where(total > 0.0, np.exp(mean), np.nan)
