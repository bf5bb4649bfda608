"""Answers about sweeps, as data: what may vary, how long it takes, and what is solved so far."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from ehlectric.app.answers.told import Told

# "no value": solved, but the summary has no such number, as the breakdown voltage where contacts open and
# close. "do not use": solved with a severe warning.
PointState = Literal["solved", "no value", "do not use", "not converged", "failed", "open"]


@dataclass(frozen=True)
class Variable:
    """Input of a case that may vary, with a range to begin with.

    Attributes
    ----------
    key : str
        Dotted key of the case.
    label : str
        Name of the quantity.
    low, high : str
        Ends of a range, with units.
    log : bool
        Whether values are better spaced by logarithms.
    """

    key: str
    label: str
    low: str
    high: str
    log: bool = False


@dataclass(frozen=True)
class SweepChoices:
    """Inputs of a case that a sweep can vary, and results of its points that a map can show.

    Attributes
    ----------
    kind : str
        "bearing", "drive" or "contact".
    variables : tuple of Variable
        Inputs that may vary, the common ones first.
    values : mapping of str to str
        Names of results by dotted key of the summary, the first to begin with.
    """

    kind: str
    variables: tuple[Variable, ...]
    values: Mapping[str, str]


@dataclass(frozen=True)
class SweepPlan:
    """Size of a sweep before it runs.

    Attributes
    ----------
    points : int
        Number of points.
    seconds : float or None
        Estimated time [s]; None where films are solved, as that time is known only when some are.
    workers : int
        Processes that solve points.
    refused, corners : int
        Number of corners of the ranges that are no valid case, and number of all corners.
    reason : str
        Why the first of these is refused.
    """

    points: int
    seconds: float | None
    workers: int
    refused: int = 0
    corners: int = 0
    reason: str = ""


@dataclass(frozen=True)
class Axis:
    """Axis of a map or a line.

    Attributes
    ----------
    title : str
        Name with its unit in brackets.
    values : tuple of float
        Values in the order of the design, in the shown unit.
    log : bool
        Whether the axis is logarithmic.
    """

    title: str
    values: tuple[float, ...]
    log: bool = False


@dataclass(frozen=True)
class ChartPoint:
    """Point of a map or a line.

    Attributes
    ----------
    number : int
        Number of the point in the order of the design.
    state : str
        What is known of it.
    texts : tuple of str
        Lines that say what it is and what it has.
    value : float or None
        Shown number, in the unit of the chart; None where it must not be drawn or there is none.
    margin : float or None
        Breakdown voltage divided by applied voltage.
    voltage : float or None
        Applied voltage in the unit of the chart where a breakdown voltage is shown, 1 where a margin is.
    """

    number: int
    state: PointState
    texts: tuple[str, ...]
    value: float | None = None
    margin: float | None = None
    voltage: float | None = None


@dataclass(frozen=True)
class Chart:
    """Content of a map or of a line.

    Attributes
    ----------
    x : Axis
        First varied input.
    y : Axis or None
        Second varied input, whose values vary fastest.
    title : str
        Name of the shown number with its unit.
    critical : str
        What a margin of 1 means; empty where no point has a margin.
    voltage : str
        Name of what the shown number is compared with: the applied voltage, or a margin of 1.
    points : tuple of ChartPoint
        Points in the order of the design.
    """

    x: Axis
    y: Axis | None
    title: str
    critical: str
    voltage: str
    points: tuple[ChartPoint, ...]


@dataclass(frozen=True)
class SweepView:
    """State of a sweep, finished or not.

    Attributes
    ----------
    counts : mapping of str to int
        Number of points by state.
    chart : Chart
        What the map shows.
    figure : mapping
        The map or the line, for Plotly.
    columns : tuple of str
        Heads of the table of points.
    rows : tuple of tuple of str
        Cells of each point.
    values : mapping of str to str
        Names of all numbers that some point has, by dotted key.
    accuracy : str
        Sentence about the error of films where contacts are not solved; empty where they are.
    level, text : str
        Verdict; empty where no point has a margin.
    warnings : tuple of Told
        Warnings of the points together.
    """

    counts: Mapping[str, int]
    chart: Chart
    figure: Mapping[str, Any]
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    values: Mapping[str, str]
    accuracy: str = ""
    level: str = ""
    text: str = ""
    warnings: tuple[Told, ...] = field(default=())


@dataclass(frozen=True)
class SweepPoint:
    """Point of a sweep with the address of the page that shows its case.

    Attributes
    ----------
    number : int
        Number of the point.
    path : str
        "/" for a bearing, "/drive" for a drive, "/contact" for a contact.
    query : str
        Query of the address, which holds the inputs of the point with all digits.
    """

    number: int
    path: str
    query: str
