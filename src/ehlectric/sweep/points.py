"""Points of a sweep: their inputs, status, and summary or reason of failure."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar, Literal

import numpy as np

from ehlectric.arrays import Mask
from ehlectric.cases.solved_case import SolvedCase
from ehlectric.quantities.result_warnings import CODES, CODES_OF_TEXTS, ResultWarning, warnings_of
from ehlectric.runtime.display import Values, is_number, read_only_property

# Codes of warnings with which numbers may be used.
_HARMLESS = frozenset(code for code, cause in CODES.items() if cause.severity != "severe")

# "solved": converged; "not converged": the summary must not be used; "failed": no summary; "open": not tried
# yet.
Status = Literal["solved", "not converged", "failed", "open"]
Spacing = Literal["linear", "log"]


@dataclass(frozen=True)
class Range:
    """Range of an input between two values."""

    # start and stop: ends of the range, in SI units.
    start: float
    stop: float
    spacing: Spacing = "linear"  # "linear" if values are spaced evenly, or "log" if their logarithms are


@dataclass(frozen=True)
class Point:
    """One point of a sweep."""

    number: int
    inputs: Mapping[str, Any]  # values of the varied keys, by dotted key of the case, in SI units
    status: Status  # "solved", "not converged", "failed" or "open"
    reason: str = ""  # reason why the point is not solved; empty if it is solved or open
    # Nested tables, as in summary.json; None if the point failed or is open.
    summary: Mapping[str, Any] | None = None
    seconds: float = 0.0  # time taken by the solution [s]
    version: str = ""

    @property
    def solved(self) -> bool:
        """Whether the point converged. Its numbers must still not be used if it is ``doubtful``."""
        return self.status == "solved"

    @property
    def warnings(self) -> tuple[ResultWarning, ...]:
        """Warnings of the summary; empty if the point has no summary."""
        return warnings_of(self.summary or {})

    @property
    def doubtful(self) -> bool:
        """Whether the point is solved, but has a severe warning: its film must not be used.

        Examples
        --------
        >>> warned = {"warnings": ["the film may be 32 % off"], "warning_codes": ["grid-far-too-coarse"]}
        >>> Point(0, {}, "solved", summary=warned).doubtful
        True
        """
        # A text may state that a code of a later version is severe.
        codes = (self.summary or {}).get(CODES_OF_TEXTS, ())
        return (
            self.solved
            and not all(map(_HARMLESS.__contains__, codes))
            and any(warning.severity == "severe" for warning in self.warnings)
        )

    @property
    def usable(self) -> Mapping[str, Any]:
        """Summary of a point that is solved and not ``doubtful``; empty for another one."""
        return self.summary if self.solved and self.summary and not self.doubtful else {}


@dataclass(frozen=True, eq=False, repr=False)
class SweepPoints(Values):
    """All points of a sweep, complete or still in progress.

    Attributes
    ----------
    case : Case, BearingCase, DriveCase, AxleCase or GearCase
        Base case of the sweep.
    design : str
        "grid", "paired" or "sobol".
    axes : mapping
        Values of each varied key in the order of the input, in SI units; empty for a "sobol" design.
    ranges : mapping
        Range of each varied key of a "sobol" design, in the order of the input; empty for other designs.
    samples : int
        Base samples n of a "sobol" design; 0 for other designs. The points are the n rows of A, then the n
        rows of B. For each varied key k, the n rows of A follow with column k of B.
    points : tuple of Point
        All points in the order of the design; in a "grid" the last varied key varies fastest.
    seed : int
        Seed of the random numbers of a "sobol" design.
    title : str
        Title of the sweep, for figures.
    uncertainty_samples : int
        Samples of the probability of breakdown at each point; 0 where it is not computed.
    """

    NO_ARRAYS: ClassVar[frozenset[str]] = frozenset({"axes", "ranges", "points", "columns", "numbers"})

    case: SolvedCase
    design: str
    axes: Mapping[str, tuple[Any, ...]]
    ranges: Mapping[str, Range]
    samples: int
    points: tuple[Point, ...]
    seed: int = 0
    title: str = ""
    uncertainty_samples: int = 0

    @property
    def varied(self) -> tuple[str, ...]:
        """Dotted keys of the case that vary, in the order of the input."""
        return tuple(self.ranges if self.design == "sobol" else self.axes)

    @cached_property
    def columns(self) -> dict[str, list[Any]]:
        """Values of the summaries by dotted key, each a list over the points.

        A value is None where a point is not solved, or its summary has no such value.
        """
        columns: dict[str, list[Any]] = {}
        for place, point in enumerate(self.points):
            for key, value in flat_summary(point.summary).items() if point.solved and point.summary else ():
                if key not in columns:
                    columns[key] = [None] * len(self.points)
                columns[key][place] = value
        return columns

    @cached_property
    def numbers(self) -> dict[str, list[int | float | None]]:
        """Columns with a number at some point; None where a point has none."""
        numbers = {}
        for key, column in self.columns.items():
            kinds = kinds_of(column)
            if kinds & {int, float}:
                mixed = kinds - {int, float, type(None)}
                numbers[key] = [value if is_number(value) else None for value in column] if mixed else column
        return numbers

    @read_only_property
    def doubtful(self) -> Mask:
        """Mask of the points that are solved, but have a severe warning, shape (points,)."""
        return np.array([point.doubtful for point in self.points], dtype=bool)


def flat_summary(summary: Mapping[str, Any]) -> dict[str, Any]:
    """Values of a summary by dotted key, without the statements of its verdict, which are for programs: each
    value in them would be a column or a row of its own.
    """
    return flat({key: value for key, value in summary.items() if key != "verdict_reasons"})


def flat(table: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Values of nested tables by dotted key, in their order; items of lists are numbered from 0.

    Examples
    --------
    >>> flat({"film": {"minimum_thickness": 1e-7, "minimum_position": [0.0, 2e-4]}})
    {'film.minimum_thickness': 1e-07, 'film.minimum_position.0': 0.0, 'film.minimum_position.1': 0.0002}
    """
    values: dict[str, Any] = {}
    _add_flat(values, table, prefix)
    return values


def _add_flat(values: dict[str, Any], table: Mapping[str, Any], prefix: str) -> None:
    """Add the values of nested tables by dotted key."""
    for name, value in table.items():
        # Most values are numbers and texts, for which the question whether they are mappings takes long.
        if value is None or type(value) in _PLAIN:
            values[prefix + name] = value
        elif isinstance(value, Mapping):
            _add_flat(values, value, f"{prefix}{name}.")
        elif isinstance(value, list | tuple) and value:
            _add_flat(values, {str(k): item for k, item in enumerate(value)}, f"{prefix}{name}.")
        else:
            values[prefix + name] = value


_PLAIN = frozenset({float, int, str, bool})


def kinds_of(column: Sequence[Any]) -> set[type]:
    """Types of the values of a column; the type of NumPy's floats is float.

    Examples
    --------
    >>> kinds_of([1.0, np.float64(2.0)]) == {float}, kinds_of([1, "a"]) == {int, str}
    (True, True)
    """
    return {float if issubclass(kind, float) else kind for kind in set(map(type, column))}


def as_number(value: Any) -> float:
    """Value as a float; NaN if it is not a number."""
    return float(value) if isinstance(value, int | float) else math.nan
