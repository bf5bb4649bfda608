"""Effect of the ranges of a case on film factors: inputs that all rows of a measurement share."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing.measured.forward import FilmState, OperatingPoint
from ehlectric.cases.bearings.case import BearingCase
from ehlectric.cases.ranges import InputRange
from ehlectric.errors import InputError
from ehlectric.quantities.rows import value_at

# Key of what is in parallel: its range is one of the background.
PARALLEL = "bearing.parallel_capacitance"

# Number of rows at which the effect of a range is computed; it is interpolated over the speed between them.
_ROWS = 4

# Keys without effect on the capacitance at a film factor, or that the measurement itself replaces.
_WITHOUT = (
    *("discharge.", "motor.", "bearing.inner_speed", "bearing.film_factor", "bearing.supply"),
    PARALLEL,
)


def shared_effects(
    case: BearingCase,
    rows: Sequence[Mapping[str, Any]],
    factors: Array,
    slopes: Array,
    corrected: Callable[[FilmState], FilmState],
) -> tuple[dict[str, Array], tuple[str, ...]]:
    """Change of ln(film factor) by one standard uncertainty of each input that has a range.

    Parameters
    ----------
    case : BearingCase
        Case of the bearing with its ``ranges``.
    rows : sequence of mapping, length n
        Changes of the case that make each row, its speed [rad/s] and temperature [K].
    factors, slopes : ndarray, shape (n,)
        Film factor of each row, and its d ln(capacitance)/d ln(factor).
    corrected : callable
        Correction of a quick state, see ``Correction.of``.

    Returns
    -------
    effects : dict of str to ndarray, shape (n,)
        Effect of each range on every row. A range is taken as a rectangular distribution: its standard
        uncertainty is its half-width over the square root of three.
    left_out : tuple of str
        Ranges that were left out, and why.
    """
    effects: dict[str, Array] = {}
    left_out: list[str] = []
    if not rows:
        return effects, ()
    speeds = np.array([math.log(row["bearing.inner_speed"]) for row in rows])
    places = _spread(speeds)
    for one in case.ranges or ():
        if one.key.startswith(_WITHOUT):
            continue
        try:
            half = [_half_width(case, one, rows[k], float(factors[k]), corrected) for k in places]
        except InputError as error:
            left_out.append(f"{one.key}: {error}")
            continue
        order = np.argsort(speeds[places])
        change = np.interp(speeds, speeds[places][order], np.array(half)[order])
        effects[one.key] = change / math.sqrt(3.0) / -slopes
    return effects, tuple(left_out)


def background_effect(case: BearingCase, targets: Array, slopes: Array) -> dict[str, Array]:
    """Change of ln(film factor) by one standard uncertainty of the parallel capacitance of a case.

    Parameters
    ----------
    case : BearingCase
        Case of the bearing with its ``ranges``.
    targets, slopes : ndarray, shape (n,)
        Capacitance without background of each row [F], and its d ln(capacitance)/d ln(factor).

    Returns
    -------
    dict of str to ndarray, shape (n,)
        Effect by the key; empty without a range of ``bearing.parallel_capacitance``.
    """
    ranges = [one for one in case.ranges or () if one.key == PARALLEL]
    return {one.key: 0.5 * (one.high - one.low) / math.sqrt(3.0) / targets / -slopes for one in ranges}


def _spread(speeds: Array) -> list[int]:
    """Places of a few rows that are spread over the speed, each speed once."""
    order = np.argsort(speeds, kind="stable")
    chosen = order[np.unique(np.linspace(0, len(order) - 1, _ROWS).round().astype(int))]
    seen: dict[float, int] = {}
    for place in chosen:
        seen.setdefault(float(speeds[place]), int(place))
    return list(seen.values())


def _half_width(
    case: BearingCase,
    one: InputRange,
    row: Mapping[str, Any],
    factor: float,
    corrected: Callable[[FilmState], FilmState],
) -> float:
    """Half of the difference of ln(capacitance) between both ends of a range, at the inputs of a row."""
    ends = []
    for end in (one.low, one.high):
        changes = dict(row)
        if one.key in row:
            # A measured temperature keeps its own value; the range is that of its error.
            end = float(row[one.key]) + end - float(value_at(case.to_dict(), one.key))
        changes[one.key] = end
        ends.append(math.log(corrected(OperatingPoint.of(case, changes).at(factor)).capacitance))
    return 0.5 * (ends[1] - ends[0])
