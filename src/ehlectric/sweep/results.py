"""What a sweep has found: its points with what was varied, and the summary or the reason of each."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.cases.any_case import AnyCase
from ehlectric.errors import ResultWarning
from ehlectric.runtime.stored_warnings import warnings_of

# "solved"; "not converged", whose summary is for looking at; "failed", which has none; "open", not tried yet.
Status = Literal["solved", "not converged", "failed", "open"]
Spacing = Literal["linear", "log"]


@dataclass(frozen=True)
class Range:
    """An input that varies between two SI values, evenly in itself or in its logarithm."""

    start: float
    stop: float
    spacing: Spacing = "linear"


@dataclass(frozen=True)
class Point:
    """One point of a sweep.

    Attributes
    ----------
    number : int
        From 0, in the order of the design.
    inputs : mapping
        What was varied, by dotted key of the case, SI.
    status : str
        "solved", "not converged", "failed" or "open".
    reason : str
        Why it is not solved; empty where it is, or where nothing was tried.
    summary : mapping or None
        As summary.json, nested; None where nothing was solved.
    seconds : float
        Time it took [s].
    version : str
        Of the program that solved it.
    """

    number: int
    inputs: Mapping[str, Any]
    status: Status
    reason: str = ""
    summary: Mapping[str, Any] | None = None
    seconds: float = 0.0
    version: str = ""

    @property
    def solved(self) -> bool:
        """Whether it has numbers; whether they may be used, ``doubtful`` says."""
        return self.status == "solved"

    @property
    def warnings(self) -> tuple[ResultWarning, ...]:
        """Warnings of its summary; none where it has no summary."""
        return warnings_of(self.summary or {})

    @property
    def doubtful(self) -> bool:
        """Whether it is solved, but a warning is severe: its film must not be used.

        Examples
        --------
        >>> warned = {"warnings": ["the film may be 32 % off"], "warning_codes": ["grid-far-too-coarse"]}
        >>> Point(0, {}, "solved", summary=warned).doubtful
        True
        """
        return self.solved and any(warning.severity == "severe" for warning in self.warnings)


@dataclass(frozen=True)
class SweepResults:
    """A sweep as it stands.

    Attributes
    ----------
    case : Case or BearingCase
        The base case.
    design : str
        "grid", "paired" or "sobol".
    axes : mapping
        Values of each varied key in the order given, SI; of a "sobol" design empty.
    ranges : mapping
        Of a "sobol" design, the range of each varied key in the order given.
    samples : int
        Of a "sobol" design, the base samples n: its points are the rows A, then B, then A with column k of
        B for each varied key k, n each. 0 otherwise.
    points : tuple of Point
        All points of the design, in its order; of a "grid" the last varied key runs fastest.
    seed : int
        Of a "sobol" design's random numbers.
    title : str
        Of the sweep, for figures.
    """

    case: AnyCase
    design: str
    axes: Mapping[str, tuple[Any, ...]]
    ranges: Mapping[str, Range]
    samples: int
    points: tuple[Point, ...]
    seed: int = 0
    title: str = ""

    @property
    def varied(self) -> tuple[str, ...]:
        """Keys of the case that vary, in the order given."""
        return tuple(self.ranges if self.design == "sobol" else self.axes)

    @property
    def doubtful(self) -> Mask:
        """Which points are solved, but have a warning not to use their film, shape (points,)."""
        return np.array([point.doubtful for point in self.points], dtype=bool)

    def values(self, key: str) -> Array:
        """One number of every point.

        Parameters
        ----------
        key : str
            Dotted key of the summary, as "discharge.breakdown_voltage".

        Returns
        -------
        ndarray, shape (points,)
            SI; not a number where a point is not solved or its summary has none. Those of doubtful points
            are among them.
        """
        found = [flat(point.summary or {}).get(key) if point.solved else None for point in self.points]
        return np.array([as_number(value) for value in found])


def flat(table: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Nested tables by dotted key, in their order; items of lists by their number from 0.

    Examples
    --------
    >>> flat({"film": {"minimum_thickness": 1e-7, "minimum_position": [0.0, 2e-4]}})
    {'film.minimum_thickness': 1e-07, 'film.minimum_position.0': 0.0, 'film.minimum_position.1': 0.0002}
    """
    found: dict[str, Any] = {}
    for name, value in table.items():
        if isinstance(value, Mapping):
            found |= flat(value, f"{prefix}{name}.")
        elif isinstance(value, list | tuple) and value:
            found |= flat({str(k): item for k, item in enumerate(value)}, f"{prefix}{name}.")
        else:
            found[prefix + name] = value
    return found


def as_number(value: Any) -> float:
    """A value as a float; not a number where it is none."""
    return float(value) if isinstance(value, int | float) else math.nan
