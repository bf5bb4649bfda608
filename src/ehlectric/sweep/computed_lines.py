"""Lines of a sweep that are computed between its points: bearings whose contacts are not solved."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ehlectric.arrays import Array, IntArray
from ehlectric.bearing import columns_of, is_quick, where_it_bends
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.input_keys import is_quantity
from ehlectric.errors import InputError
from ehlectric.runtime.display import is_number
from ehlectric.sweep.result import SweepResults
from ehlectric.sweep.slices import Slice

# Table of the summary whose numbers are computed.
_TABLE = "bearing."

# Largest relative difference between a point and the same point computed again, by another processor.
_SAME = 1e-3

# Largest error of a line between two nodes, and smallest distance of two nodes: of logarithms, or of values
# divided by the range of the line.
_BEND, _CLOSEST = 3e-3, 3e-4

# Number of times that every interval between two points is halved.
_ALWAYS = 3


def computed_line(
    results: SweepResults, selection: Slice, numbers: IntArray, *, log_x: bool, log: bool
) -> tuple[Array, Array] | None:
    """Compute a line of a slice at its points and between them.

    Parameters
    ----------
    results : SweepResults
        Results of the sweep.
    selection : Slice
        Slice with the drawn value.
    numbers : ndarray, shape (n,)
        Indices of the points of the line in the slice, by increasing ``x``.
    log_x, log : bool
        Whether the line is drawn over the logarithm of ``x``, and whether its logarithm is drawn.

    Returns
    -------
    tuple of ndarray, or None
        Increasing values of ``x``, and the values there, SI units, shape (m,); NaN if a bearing has no value.
        None if a value between the points costs more than a millisecond, if a point has no result, or if the
        points of another version have other values.
    """
    points = [selection.points[k] for k in numbers.tolist()]
    x, known = selection.along[numbers], selection.values[numbers]
    usable = all(point.solved and not point.doubtful for point in points) and np.any(np.isfinite(known))
    case = _case(results, selection, points[0].inputs) if usable and len(points) > 1 else None
    if case is None:
        return None
    key, to_x = selection.x, np.exp if log_x else np.asarray

    def drawn(places: Array) -> Array:
        """Drawn values at places on the axis, shape (m,) -> (1, m)."""
        columns = columns_of(case.with_arrays({key: to_x(places)})).values
        values = columns.get(selection.value, np.full(places.size, np.nan))
        return _onto(values, log=log)[np.newaxis]

    places, drawn_values = _onto(x, log=log_x), _onto(known, log=log)
    again = drawn(places)
    same = {"rtol": 0.0, "atol": _SAME} if log else {"rtol": _SAME, "atol": 0.0}
    if not np.allclose(again[0], drawn_values, **same, equal_nan=True):
        return None
    span = 1.0 if log else max(float(np.ptp(drawn_values[np.isfinite(drawn_values)])), 1e-300)
    length = float(np.ptp(places))
    line = where_it_bends(
        drawn, places, again, tolerance=_BEND * span, closest=_CLOSEST * length, always=_ALWAYS
    )
    return to_x(line[0]), np.exp(line[1][0]) if log else line[1][0]


def _case(results: SweepResults, selection: Slice, inputs: Mapping[str, Any]) -> BearingCase | None:
    """Case of a line; None if it is not computed."""
    case = results.case
    if not isinstance(case, BearingCase) or not selection.value.startswith(_TABLE):
        return None
    if not is_quantity(selection.x) or not all(map(is_number, selection.along.tolist())):
        return None
    try:
        at_inputs = case.replace(dict(inputs))
    except InputError:
        return None
    return at_inputs if is_quick(at_inputs) else None


def _onto(values: Array, *, log: bool) -> Array:
    """Values, or their logarithms, NaN of those that are not positive."""
    if not log:
        return values
    return np.log(np.where(values > 0.0, values, np.nan))
