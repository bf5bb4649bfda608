"""What of a sweep a figure shows: one value over one or two varied keys, the others held."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ehlectric.arrays import Array, IntArray, Mask
from ehlectric.cases.keys import kind_of
from ehlectric.cases.quantity import Count, Quantity
from ehlectric.cases.table import nearest
from ehlectric.errors import InputError, shown
from ehlectric.sweep.breakdown import Breakdown, breakdown_of
from ehlectric.sweep.results import Point, Status, SweepResults, as_number, flat

# Names and values that a message lists at most.
_MOST_LISTED = 8


@dataclass(frozen=True)
class Slice:
    """Points of a sweep, by what they are drawn over.

    Attributes
    ----------
    x : str
        Varied key along the horizontal axis.
    y : str or None
        Second varied key.
    value : str
        Key of the summary that is drawn.
    breakdown : Breakdown
        What it is set beside.
    at : mapping
        What is held, SI, by varied key.
    free : tuple of str
        Varied keys that are neither drawn over nor held: those of a design that holds none.
    points : tuple of Point
        In the order of the design.
    along : ndarray, shape (points,)
        Value of ``x``, SI.
    across : tuple
        Value of ``y`` of each point, SI numbers or texts; empty without one.
    values : ndarray, shape (points,)
        What is drawn, SI; not a number where a point is not solved, or doubtful.
    voltage : ndarray, shape (points,)
        Applied [V]; not a number where a point is not solved, or doubtful.
    margin : ndarray, shape (points,)
        Breakdown voltage over applied voltage; not a number where there is none.
    """

    x: str
    y: str | None
    value: str
    breakdown: Breakdown
    at: Mapping[str, Any]
    free: tuple[str, ...]
    points: tuple[Point, ...]
    along: Array
    across: tuple[Any, ...]
    values: Array
    voltage: Array
    margin: Array

    def of(self, status: Status) -> Mask:
        """Which points have a status, shape (points,)."""
        return np.array([point.status == status for point in self.points])

    @property
    def doubtful(self) -> Mask:
        """Which points are solved, but have a warning not to use their film, shape (points,)."""
        return np.array([point.doubtful for point in self.points])

    @property
    def of_discharge(self) -> bool:
        """Whether its value tells of breakdown or of what goes with it."""
        return self.value.startswith("discharge.") or self.value in self.breakdown.keys

    @property
    def numeric(self) -> bool:
        """Whether ``y`` is a number in all points."""
        return self.y is not None and all(map(_is_number, self.across))

    def check_numeric(self) -> None:
        """Refuse a second key whose values are no numbers, as a map takes them.

        Raises
        ------
        InputError
            In one line.
        """
        if not self.numeric:
            raise InputError.worded(
                "y",
                f"got {shown(self.y)}, whose values are texts or lists, a map takes numbers",
                got=shown(self.y),
                takes="numbers",
            )

    def grid(self) -> tuple[Array, Array, IntArray] | None:
        """The points as a full grid.

        Returns
        -------
        tuple or None
            Increasing values of ``x``, shape (nx,), and of ``y``, shape (ny,), and the number of the point of
            each pair among ``points``, shape (nx, ny); None where some pair has no point or two.
        """
        xs, i = np.unique(self.along, return_inverse=True)
        ys, j = np.unique(np.array(self.across, dtype=float), return_inverse=True)
        if xs.size * ys.size != len(self.points) or np.unique(i * ys.size + j).size != len(self.points):
            return None
        numbers = np.empty((xs.size, ys.size), dtype=np.intp)
        numbers[i, j] = np.arange(len(self.points))
        return xs, ys, numbers

    def series(self) -> list[tuple[Any, IntArray]]:
        """Points by their value of ``y``, each by increasing ``x``.

        Returns
        -------
        list of (value, numbers)
            By increasing value where those are numbers, else in the order given. One of value None without
            ``y``.
        """
        values: list[Any] = list(dict.fromkeys(self.across)) if self.across else [None]
        values = sorted(values) if self.numeric else values
        groups = [[k for k, other in enumerate(self.across) if other == value] for value in values]
        found = [
            np.array(group if self.across else range(len(self.points)), dtype=np.intp) for group in groups
        ]
        return [(v, n[np.argsort(self.along[n], kind="stable")]) for v, n in zip(values, found, strict=True)]


def take(
    results: SweepResults, x: str, y: str | None, value: str, at: Mapping[str, str] | None = None
) -> Slice:
    """The points of a sweep that are drawn over one or two varied keys.

    Parameters
    ----------
    results : SweepResults
        What a sweep has found.
    x, y : str
        Varied keys; ``y`` may be None.
    value : str
        Dotted key of the summary.
    at : mapping, optional
        What is held, by varied key: a number in SI, a text with its unit, or the text the sweep has; the
        nearest value of the sweep is taken.

    Returns
    -------
    Slice
        In the order of the design.

    Raises
    ------
    InputError
        Where a key is not varied or no number, a value is in no summary or in none of the points that are
        drawn, or a grid has further varied keys that are not held.
    """
    for name, key in (("x", x), ("y", y)):
        if key is not None and key not in results.varied:
            near = f"; nearest is {nearest(key, results.varied)}" if results.varied else ""
            raise InputError(
                name, got=shown(key), takes=f"a key that varies: {_listed(results.varied)}{near}"
            )
    if x == y:
        raise InputError("y", got=f"{shown(y)}, which is x;", takes="another key that varies")
    if not all(_is_number(point.inputs.get(x)) for point in results.points):
        raise InputError("x", got=f"{shown(x)}, whose values are texts or lists", takes="a key of numbers")
    values = numbers_of(results, value)
    held = {key: _held(results, key, text) for key, text in (at or {}).items()}
    for key in held:
        if key in (x, y):
            raise InputError(
                "at", got=f"{key}, which is {'x' if key == x else 'y'}", takes="another varied key"
            )
    held |= _alone(results, {x, y, *held})
    free = tuple(key for key in results.varied if key not in (x, y, *held))
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
        if all(_hashable(p.inputs.get(key)) == v for key, v in held.items())
    ]
    if not chosen:
        raise InputError(
            "at", f"no point of the sweep has {', '.join(f'{k} = {v}' for k, v in held.items())}"
        )
    points = tuple(results.points[k] for k in chosen)
    # A number that is not to be used is no number of a figure.
    usable = np.where([point.doubtful for point in points], np.nan, 1.0)
    values = usable * values[chosen]
    if not np.any(np.isfinite(values)):
        raise InputError("value", f"{value} is in none of the {_drawn(points)}, there is nothing to show")
    breakdown = breakdown_of(results.case, value)
    across = () if y is None else tuple(_hashable(point.inputs.get(y)) for point in points)
    return Slice(
        x=x,
        y=y,
        value=value,
        breakdown=breakdown,
        at=held,
        free=free,
        points=points,
        along=np.array([as_number(point.inputs[x]) for point in points]),
        across=across,
        values=values,
        voltage=usable * results.values(breakdown.voltage)[chosen],
        margin=usable * breakdown.margins(results)[chosen],
    )


def _drawn(points: Sequence[Point]) -> str:
    """How many points there are, and how many of them are not to be used."""
    doubtful = sum(point.doubtful for point in points)
    text = f"{len(points)} points that are drawn"
    return text + (f', of which {doubtful} are solved but say "do not use"' if doubtful else "")


def known_values(results: SweepResults) -> list[str]:
    """Keys of the summaries that are numbers in some solved point, in their order."""
    found: dict[str, None] = {}
    for point in results.points:
        if point.solved:
            table = flat(point.summary or {})
            found |= dict.fromkeys(key for key, value in table.items() if _is_number(value))
    return list(found)


def numbers_of(results: SweepResults, value: str) -> Array:
    """One number of every point, not a number where there is none.

    Parameters
    ----------
    results : SweepResults
        What a sweep has found.
    value : str
        Dotted key of the summary.

    Returns
    -------
    ndarray, shape (points,)
        SI.

    Raises
    ------
    InputError
        Where no point is solved, or none has such a number.
    """
    if not any(point.solved for point in results.points):
        raise InputError(f"no point of {len(results.points)} is solved, there is nothing to show")
    known = known_values(results)
    if value not in known:
        within = value.partition(".")[0] + "."
        near = nearest(value, [key for key in known if key.startswith(within)] or known)
        table = "; the case has no [discharge]" if within == "discharge." and near[:9] != "discharge" else ""
        raise InputError(
            "value", got=shown(value), takes=f"a number of summary.json; nearest is {near}{table}"
        )
    return results.values(value)


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _hashable(value: Any) -> Any:
    """A number as a float, anything else as a text."""
    return float(value) if _is_number(value) else str(value)


def _axis(results: SweepResults, key: str) -> list[Any]:
    """Values of a varied key, each once, in their order."""
    return list(dict.fromkeys(_hashable(point.inputs.get(key)) for point in results.points))


def _alone(results: SweepResults, taken: set[str | None]) -> dict[str, Any]:
    """Varied keys that have but one value, with it."""
    axes = {key: _axis(results, key) for key in results.varied if key not in taken}
    return {key: values[0] for key, values in axes.items() if len(values) == 1}


def _held(results: SweepResults, key: str, text: str) -> Any:
    """The value of the sweep that is nearest to what is asked for."""
    if key not in results.varied:
        near = nearest(key, results.varied) if results.varied else "none"
        raise InputError("at", got=shown(key), takes=f"a key that varies; nearest is {near}")
    if results.design == "sobol":
        raise InputError("at", got=f"{key}, of which a sobol design has no two points alike;", takes="a grid")
    axis = _axis(results, key)
    if not all(map(_is_number, axis)):
        if text not in axis:
            raise InputError("at", got=f"{key}={text}", takes=f"one of {_listed(axis)}")
        return text
    asked = _asked(key, text)
    low, high = min(axis), max(axis)
    slack = 1e-6 * max(abs(low), abs(high))
    if not low - slack <= asked <= high + slack:
        raise InputError("at", got=f"{key}={text}", takes=f"a value from {low:g} to {high:g}{_si(key)}")
    return min(axis, key=lambda other: abs(other - asked))


def _asked(key: str, text: str) -> float:
    """SI value of a number or a text with its unit."""
    try:
        number: float | None = float(text)
    except ValueError:
        number = None
    kind = kind_of(key)
    if kind is None or isinstance(kind, Count):
        if number is None:
            raise InputError("at", got=f"{key}={text}", takes="a number")
        return number
    try:
        return kind.parse(text if number is None else number)
    except InputError as error:
        raise error.retold("at", f"{key}: {error}") from None


def _si(key: str) -> str:
    """Unit of a key of the case with a space before it."""
    kind = kind_of(key)
    unit = kind.unit if isinstance(kind, Quantity) else ""
    return f" {unit}" if unit else ""


def _listed(values: Any) -> str:
    """The first of some names or values."""
    texts = [f"{value:g}" if _is_number(value) else str(value) for value in values]
    return ", ".join(texts[:_MOST_LISTED]) + (" ..." if len(texts) > _MOST_LISTED else "")
