"""Answers that the pages show, as plain data, which the server reads without the physics."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from string import ascii_lowercase
from typing import Any, Literal

from ehlectric.app.page_inputs import Inputs
from ehlectric.cases.defaults import Contacts
from ehlectric.quantities.units import known_factor, si_unit, split
from ehlectric.quantities.verdict import Verdict
from ehlectric.readable import readable


@dataclass(frozen=True)
class PageWarning:
    """Warning of a result."""

    # code, severity and text: as of ``ehlectric.quantities.result_warnings.ResultWarning``
    code: str
    severity: str
    text: str
    # Keys of the quantities that it concerns, next to which a page shows it; empty for a
    # warning that concerns the whole result.
    concerns: tuple[str, ...] = ()
    meaning: str = ""  # meaning of the code in one sentence, without numbers


# Severities in the order in which they are counted.
SEVERITIES = ("severe", "warning", "note")


def concerning(warnings: Iterable[PageWarning], number: str) -> tuple[PageWarning, ...]:
    """Warnings that concern a number."""
    return tuple(warning for warning in warnings if number in warning.concerns)


def limited_to(warnings: Iterable[PageWarning], keys: Collection[str]) -> tuple[PageWarning, ...]:
    """Warnings whose ``concerns`` are limited to the quantities that a page shows."""
    return tuple(
        replace(warning, concerns=tuple(key for key in warning.concerns if key in keys))
        for warning in warnings
    )


def counts(warnings: Iterable[PageWarning]) -> str:
    """Numbers of warnings by their severity.

    Examples
    --------
    >>> counts([PageWarning("partial-film", "warning", "thin"), PageWarning("speed-high", "warning", "fast")])
    '2 warnings'
    >>> counts([])
    'no warnings'
    """
    severities = [warning.severity for warning in warnings]
    names = {"severe": "severe warning", "warning": "warning", "note": "note"}
    numbers = [(severities.count(kind), names[kind]) for kind in SEVERITIES if kind in severities]
    return ", ".join(f"{n} {name}{'' if n == 1 else 's'}" for n, name in numbers) or "no warnings"


@dataclass(frozen=True)
class Line:
    """Line of the table that the command prints; a line without text is a heading."""

    name: str
    text: str = ""  # value, unit and note
    alarm: bool = False  # whether the line says that the numbers must not be used


# Largest uploaded files: of a case, and of a surface that a case names [bytes].
MOST_CASE, MOST_SURFACE = 200_000, 20_000_000

# Files that are opened at once.
MOST_FILES = 12

# Kinds of downloads from a folder of results.
Download = Literal["csv", "netcdf", "summary", "figures", "all"]


@dataclass(frozen=True)
class Uploaded:
    """Uploaded case or sweep."""

    name: str
    kind: str  # "contact", "motion", "bearing", "drive", "gear", "axle" or "sweep"
    table: Mapping[str, Any]  # its tables; names of files are relative to the folder of the session
    # Names of files that the case names and that are still to be uploaded. The tables are checked once none
    # is missing.
    missing: tuple[str, ...] = ()


@dataclass(frozen=True)
class Written:
    """Files of a result as the command writes them."""

    folder: str
    names: tuple[str, ...]
    failure: str = ""  # what was not solved; empty where all was
    warnings: tuple[PageWarning, ...] = ()


def file_title(title: object) -> str:
    """Name of files from the title of a case: small letters, digits and hyphens.

    Examples
    --------
    >>> file_title("Ball bearing, 6208 / VG 46"), file_title("../.."), file_title(None)
    ('ball-bearing-6208-vg-46', 'case', 'case')
    """
    words = re.findall(r"[a-z0-9]+", str(title).lower()) if title else []
    return "-".join(words)[:60].strip("-") or "case"


@dataclass(frozen=True)
class Choice:
    """Entry of a list to choose from."""

    name: str  # name for a key such as ``bearing.base``
    label: str  # what the list shows
    group: str = ""  # kind, under which the list shows it


@dataclass(frozen=True)
class MotionAnswer:
    """Movie of a contact with moving roughness."""

    title: str
    complete: bool  # whether all time steps are solved
    failure: str  # reason why the run ended early; empty for a complete run and for one that was stopped
    of: int  # number of recorded instants of the file; the movie has fewer where they are many
    movie: Mapping[str, Any]  # figure as plotly.js takes it, with a frame for every instant of the movie
    # Figure of the minimum film, the maximum field and the breakdown voltage over time. Its first shape is
    # the line of the present time.
    history: Mapping[str, Any]
    times: tuple[float, ...]  # times of the instants, in the unit of the history
    # Sentence with time, minimum film, maximum field and breakdown voltage for every instant.
    texts: tuple[str, ...]
    at_least_film: int  # instant of the movie with the thinnest film
    at_largest_field: int  # instant of the movie with the largest field
    rows: tuple[tuple[str, str], ...]  # rows of the key figures: name, value and unit; a heading has no value
    warnings: tuple[PageWarning, ...]
    folder: str


@dataclass(frozen=True)
class StepFigure:
    """Figure of a surface after a processing step."""

    name: str  # name of the step, such as "form: parabola"
    figure: Mapping[str, Any]  # figure as plotly.js takes it
    label: str  # sentence about the figure for a screen reader


@dataclass(frozen=True)
class SummitsTable:
    """Spectral moments and summits of a surface, as ``ehlectric surface`` prints them."""

    title: str  # what the numbers belong to
    heads: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]  # row for every sampling interval
    note: str  # what a reader must know to use the numbers


@dataclass(frozen=True)
class SurfaceAnswer:
    """Rough surface and its processing steps."""

    kind: str  # "profile", "map" or "shape"
    # Numbers of the surface in SI units, as ``ehlectric surface --json`` gives them.
    described: Mapping[str, Any]
    size: str  # points, spacing and resolution of the surface
    heads: tuple[str, ...]  # heads of the table of statistics, with units
    rows: tuple[tuple[str, ...], ...]  # row of this table for every processing step; empty for an exact shape
    figures: tuple[StepFigure, ...]  # figure after every processing step; a single one of an exact shape
    warnings: tuple[PageWarning, ...]  # warnings about the file, the steps and the grid
    lines: Mapping[str, int]  # number of rows and of columns of a map from a file; empty for other surfaces
    # Moments and summits after the last processing step; None for an exact shape.
    summits: SummitsTable | None = None


# "no value": solved, but the summary has no such number, as the breakdown voltage where contacts open and
# close. "do not use": solved with a severe warning.
PointState = Literal["solved", "no value", "do not use", "not converged", "failed", "open"]


@dataclass(frozen=True)
class Variable:
    """Input of a case that may vary, with a range to begin with."""

    key: str
    label: str
    low: str  # ends of a range, with units
    high: str
    log: bool = False  # whether values are better spaced by logarithms


@dataclass(frozen=True)
class SweepChoices:
    """Inputs of a case that a sweep can vary, and results of its points that a map can show."""

    kind: str  # "bearing", "drive" or "contact"
    variables: tuple[Variable, ...]  # inputs that may vary, the common ones first
    values: Mapping[str, str]  # names of results by dotted key of the summary, the first to begin with


@dataclass(frozen=True)
class SweepPlan:
    """Size of a sweep before it runs."""

    points: int
    # Estimated time [s]; None where films are solved, as that time is known only when some are.
    seconds: float | None
    workers: int  # processes that solve points
    refused: int = 0  # corners of the ranges that are no valid case
    corners: int = 0  # all corners of the ranges
    reason: str = ""  # why the first of these is refused


@dataclass(frozen=True)
class ChartPoint:
    """Point of a map or a line."""

    number: int
    state: PointState
    texts: tuple[str, ...]  # lines that say what it is and what it has
    place: tuple[float, float]  # position in the figure
    axis: str = "y"  # vertical axis of the position
    # Shown number, in the unit of the chart; None where it must not be drawn or there is none.
    value: float | None = None
    margin: float | None = None  # breakdown voltage divided by applied voltage


@dataclass(frozen=True)
class Chart:
    """Content of a map or of a line."""

    title: str  # name of the shown number with its unit
    inputs: tuple[str, ...]  # names of one or two varied inputs with their units; the last varies fastest
    shape: tuple[int, ...]  # number of values of each
    points: tuple[ChartPoint, ...]


@dataclass(frozen=True)
class SweepView:
    """State of a sweep, finished or not."""

    counts: Mapping[str, int]  # number of points by state
    verdict: Verdict
    meaning: str  # what the verdict means, in plain words; empty where its heading states it
    deciding: Deciding
    number: Number | None  # lowest margin; None where no point has one
    chart: Chart  # what the map shows
    figure: Mapping[str, Any]  # the map or the line, for Plotly
    columns: tuple[str, ...]  # heads of the table of points
    rows: tuple[tuple[str, ...], ...]
    values: Mapping[str, str]  # names of all numbers that some point has, by dotted key
    # Sentence about the error of films where contacts are not solved; empty where they are.
    accuracy: str = ""
    warnings: tuple[PageWarning, ...] = ()


@dataclass(frozen=True)
class SweepPoint:
    """Point of a sweep with the address of the page that shows its case."""

    number: int
    path: str  # "/" for a bearing, "/drive" for a drive, "/contact" for a contact
    query: str  # query of the address, which holds the inputs of the point with all digits


# Change of a result that is shown as none: results are shown with four digits [%].
_NO_CHANGE = 0.005

# Smallest change that is marked [%].
_MARKED = 1.0

# Critical speeds are found along speeds that depend on the speed of the case: a smaller change means nothing
# [%].
_SPEED_ACCURACY = 1.0


class _Amount:
    """Base class of values that a page shows with their bound and unit."""

    text: str
    unit: str
    bound: str

    @property
    def with_unit(self) -> str:
        """Bound, value and unit."""
        return " ".join(filter(None, [self.bound, self.text, self.unit]))


@dataclass(frozen=True)
class Result(_Amount):
    """Result of one case."""

    group: str  # heading under which it stands
    name: str
    value: float | None  # number in its SI unit; None for a result in words
    text: str  # value as shown, without its unit
    unit: str = ""
    note: str = ""
    bound: str = ""  # "≤" for an upper bound, "≥" for a lower one; empty otherwise
    main: bool = False
    # Dotted key of the quantity, by which results are compared; empty for a result that has none.
    key: str = ""

    @property
    def number(self) -> tuple[float | None, str]:
        """Number and its unit, also of a result that is a text such as "12.1 nJ"; None of other texts."""
        if self.value is not None:
            return self.value, ""
        parts = split(self.text)
        if parts is None:
            return None, ""
        unit = parts[1] or self.unit
        base = si_unit(unit)
        factor = known_factor(unit, base)
        return (parts[0], unit) if factor is None else (factor * parts[0], base)


@dataclass(frozen=True)
class Film:
    """Minimum films or gaps at all elements of one ring, over the position of the elements [deg, m]."""

    ring: str
    position: tuple[float, ...]
    thickness: tuple[float, ...]
    load: tuple[float, ...]  # loads of the contacts [N]; 0 at a gap


@dataclass(frozen=True)
class OverSpeed:
    """Voltage of a bearing over the speed of its inner ring [rpm, V]; None where there is none."""

    name: str
    speed: tuple[float, ...]
    voltage: tuple[float | None, ...]
    at_case: tuple[float, float | None]  # at the speed of the case


@dataclass(frozen=True)
class Side:
    """Answer about one of two cases."""

    kind: str
    title: str
    verdict: Verdict  # without solving
    meaning: str  # what the verdict means, in plain words
    deciding: Deciding
    number: Number | None  # number that decides; None where there is none
    results: tuple[Result, ...]
    warnings: tuple[PageWarning, ...] = ()
    films: tuple[Film, ...] = ()
    # Voltages of the elements of an axle divided by their breakdown voltages, the first element first.
    ratios: tuple[tuple[str, float], ...] = ()
    # Voltages of a bearing over its speed; none unless the answer is whole.
    voltages: tuple[OverSpeed, ...] = ()
    method: str = ""  # how the results were obtained, and their error


@dataclass(frozen=True)
class InputRow:
    """Input of both cases."""

    key: str
    first: str  # values as they are written; empty where a case does not give them
    second: str
    sign: Literal["=", "≠", "only A", "only B"]


@dataclass(frozen=True)
class Effect:
    """Result of both cases."""

    first: Result | None  # results of both cases; None where a case has none
    second: Result | None
    # Change from the first to the second [%]; None where one has no number, or the first is zero.
    change: float | None

    @property
    def either(self) -> Result:
        """The result of a case that has it."""
        result = self.first or self.second
        if result is None:
            raise ValueError("an effect has a result")
        return result

    @property
    def same(self) -> bool:
        """Whether both cases show equal values."""
        first, second = self.first, self.second
        return first is not None and second is not None and first.with_unit == second.with_unit

    @property
    def _accuracy(self) -> float:
        """Change that is none, within the accuracy of the method and of the shown digits [%]."""
        return _SPEED_ACCURACY if self.either.unit == "rpm" else _NO_CHANGE

    @property
    def large(self) -> bool:
        """Whether it is marked among the others: it is no number, or changes by 1 % or more."""
        if self.change is None:
            return not self.same
        return abs(self.change) >= _MARKED

    @property
    def words(self) -> str:
        """Change as a text with its direction."""
        if self.same:
            return "no change"
        if self.change is None:
            return "differs" if self.first and self.second else "only A" if self.first else "only B"
        if abs(self.change) < self._accuracy:
            return "no change"
        sign, size = ("▲ +" if self.change > 0.0 else "▼ −"), abs(self.change)
        number = readable(size) if size < 1000.0 else f"{size:.0f}"
        return f"{sign}{number}\N{NO-BREAK SPACE}%"


def _flat(table: Mapping[str, Any]) -> dict[str, Any]:
    return Inputs(table).flat()


def input_rows(
    first: Mapping[str, Any],
    second: Mapping[str, Any],
    flat: Callable[[Mapping[str, Any]], Mapping[str, Any]] = _flat,
) -> list[InputRow]:
    """Inputs of two cases by the dotted keys of ``flat``, those that differ first.

    Examples
    --------
    >>> [row.sign for row in input_rows({"a": 1, "b": 2}, {"a": 1, "b": 3, "c": 4})]
    ['≠', 'only B', '=']
    """
    inputs_a, inputs_b = flat(first), flat(second)
    rows = [_input_row(key, inputs_a, inputs_b) for key in {**inputs_a, **inputs_b}]
    return sorted(rows, key=lambda row: row.sign == "=")


def _input_row(key: str, inputs_a: Mapping[str, Any], inputs_b: Mapping[str, Any]) -> InputRow:
    first, second = (str(table[key]) if key in table else "" for table in (inputs_a, inputs_b))
    if key not in inputs_b:
        return InputRow(key, first, second, "only A")
    if key not in inputs_a:
        return InputRow(key, first, second, "only B")
    same = inputs_a[key] == inputs_b[key] and type(inputs_a[key]) is type(inputs_b[key])
    return InputRow(key, first, second, "=" if same else "≠")


def effects(first: Side, second: Side) -> list[Effect]:
    """Effects on every result, in the order of the cases, under their headings."""
    first_rows, second_rows = (
        {row.key or (row.group, row.name): row for row in side.results} for side in (first, second)
    )
    changes = [_effect(first_rows.get(key), second_rows.get(key)) for key in {**first_rows, **second_rows}]
    groups = list(dict.fromkeys(effect.either.group for effect in changes))
    return sorted(changes, key=lambda effect: groups.index(effect.either.group))


def _effect(first: Result | None, second: Result | None) -> Effect:
    if first is None or second is None:
        return Effect(first, second, None)
    (before, unit), (after, other_unit) = first.number, second.number
    if before is None or after is None or before == 0.0 or unit != other_unit:
        return Effect(first, second, None)
    change = 100.0 * (after - before) / abs(before)
    return Effect(first, second, change if math.isfinite(change) else None)


def only_in(first: Side, second: Side) -> list[PageWarning]:
    """Warnings that the first case has, and the second has not in any words."""
    codes = {warning.code for warning in second.warnings}
    return [warning for warning in first.warnings if warning.code not in codes]


def in_both(first: Side, second: Side) -> list[PageWarning]:
    """Warnings of the first case that the second also has."""
    codes = {warning.code for warning in second.warnings}
    return [warning for warning in first.warnings if warning.code in codes]


@dataclass(frozen=True)
class Number(_Amount):
    """Number of an answer, which its page shows in a row, and the one that decides large."""

    key: str
    label: str
    text: str  # the number as it is shown, or why there is none
    unit: str = ""
    note: str = ""  # what a reader must know of the number
    bound: str = ""  # "≤" for an upper bound, "≥" for a lower one; empty otherwise
    known: bool = True
    warnings: tuple[PageWarning, ...] = ()

    @property
    def name(self) -> str:
        """Label without what stands behind a comma or in brackets.

        Examples
        --------
        >>> Number("bearing.margin", "Margin (first breakdown / shaft voltage)", "1.2").name
        'Margin'
        """
        return re.split(r" \(|, ", self.label)[0]


@dataclass(frozen=True)
class Note:
    """Warning with the numbers of a page that it concerns, and the letter that marks these."""

    warning: PageWarning
    letter: str = ""
    names: tuple[str, ...] = ()
    further: tuple[str, ...] = ()  # texts of further warnings of this meaning, such as of the other ring


def notes_of(
    numbers: Sequence[Number], warnings: Iterable[PageWarning], said: Collection[str] = ()
) -> tuple[Note, ...]:
    """Notes below the numbers of a page, in the order of the warnings, without notes with ``said`` codes.
    Warnings with one code and one meaning are one note.

    Examples
    --------
    >>> thin = PageWarning("partial-film", "warning", "thin", ("bearing.margin",))
    >>> numbers = [Number("bearing.margin", "Margin (voltages)", "1.2", warnings=(thin,))]
    >>> [(note.letter, note.names) for note in notes_of(numbers, [PageWarning("other", "note", ""), thin])]
    [('', ()), ('a', ('margin',))]
    """
    groups: dict[tuple[str, str], list[PageWarning]] = {}
    for warning in warnings:
        if warning.code not in said:
            groups.setdefault((warning.code, warning.meaning or warning.text), []).append(warning)
    letters = iter(ascii_lowercase)
    notes = []
    for warning, *others in groups.values():
        near = [number for number in numbers if warning.code in {each.code for each in number.warnings}]
        names = tuple(f"{number.name[:1].lower()}{number.name[1:]}" for number in near)
        letter = next(letters) if names else ""
        notes.append(Note(warning, letter, names, tuple(other.text for other in others)))
    return tuple(notes)


@dataclass(frozen=True)
class Gauge:
    """Number on a logarithmic scale with a limit at 1, and its interval."""

    label: str  # what it shows, for those who do not see it
    value: float
    interval: tuple[float, float] | None = None  # None where none is known


@dataclass(frozen=True)
class Deciding:
    """Number that decides the verdict, and the figure that shows why."""

    key: str  # key of a number of the answer; empty where none decides
    facts: tuple[tuple[str, str], ...] = ()  # names and values of its interval and its probability
    gauge: Gauge | None = None
    figure: str = ""  # name of the figure; empty without one
    # Codes of statements of the verdict and of warnings that say no more than the number.
    said: tuple[str, ...] = ()


# Texts of an immediate answer instead of what the whole answer adds: a number, and the range of the margin
# next to the margin.
PENDING = "…"
RANGE_FOLLOWS = "its range within the stated ranges follows"

# Code of the statement that an answer about a gear pair does not contain its probability of breakdown.
WITHOUT_PROBABILITY = "mesh-without-probability"

# Code of the statement that an answer about an axle does not contain the probabilities of its elements.
AXLE_WITHOUT_PROBABILITY = "axle-without-probability"


@dataclass(frozen=True)
class Table:
    """Table of texts, with the units of its columns in their heads."""

    caption: str
    heads: tuple[str, ...]  # heads of the columns, with units
    rows: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class Figure:
    """Figure of an answer."""

    title: str
    label: str  # what it shows, for those who do not see it
    plot: Mapping[str, Any]  # data and layout of Plotly
    table: Table | None = None  # its numbers; None for a map, and for curves of hundreds of nodes
    caption: str = ""  # what a reader must know of the figure


@dataclass(frozen=True)
class Difference:
    """Difference of a solved number from the quick one, as texts; ``way`` is "atlas" or "formula"."""

    name: str
    quick: str
    solved: str
    change: str
    way: str


@dataclass(frozen=True, kw_only=True)
class PageAnswer:
    """Parts that the answers about a bearing, a drive and a contact share."""

    title: str
    verdict: Verdict
    meaning: str  # what the verdict means for the machine, in plain words; empty without such words
    how: str  # how the answer was computed, and how far off it may be
    shown: tuple[Number, ...]  # main numbers
    deciding: Deciding
    lines: tuple[Line, ...]  # all rows that the command prints
    warnings: tuple[PageWarning, ...]  # warnings, with the numbers of ``shown`` that they concern
    # Of a bearing "load" and "film", and with its curves "breakdown" and "capacitance" over the speed; of
    # a simulated drive "voltages", "histogram", "spectrum", "remedies", "discharge-voltage" and others; of a
    # solved contact "profiles" and "section", or "surface" and maps. Empty where the films are not converged.
    figures: Mapping[str, Figure] = field(default_factory=dict)
    seconds: float = 0.0  # computing time [s]
    # Whether it has all that takes a moment: speeds, ranges, effects of inputs, and the final verdict.
    whole: bool = True
    solvable: bool = True  # whether the page offers its solution, which takes longer

    def number(self, key: str) -> Number | None:
        """Number of a key; None where the answer has none."""
        return next((number for number in self.shown if number.key == key), None)


@dataclass(frozen=True)
class DutyLook:
    """What the file of a duty cycle contains."""

    text: str  # sentence on rows, duration and columns
    of_vehicle: bool  # whether the file contains a vehicle speed instead of a shaft speed


@dataclass(frozen=True)
class DutyAnswer:
    """Answer about a duty cycle."""

    lines: tuple[Line, ...]  # rows that the command prints, without the stretches
    stretches: Table | None  # the worst stretches; None without any
    figure: Figure  # speed, lambda ratio and margin over the time
    warnings: tuple[PageWarning, ...]


@dataclass(frozen=True, kw_only=True)
class CalibrationAnswer:
    """Answer about the uncertain inputs of a case after a measurement."""

    explained: bool  # whether inputs within the ranges explain the measurement
    verdict: Verdict  # with the updated probability
    chances: Table | None  # probability and margins before and after; None without a margin
    chance: str  # probability of breakdown after the measurement; empty without a margin
    inputs: Table | None  # ranges of the inputs before and after; None unless explained
    compared: Table  # measured next to computed values
    figures: Mapping[str, Figure]  # "ranges" unless the measurement is not explained, and "compared"
    warnings: tuple[PageWarning, ...]
    updated: Mapping[str, Any] | None  # tables of the case with the updated ranges; None unless explained
    seconds: float  # computing time [s]


@dataclass(frozen=True, kw_only=True)
class BearingAnswer(PageAnswer):
    """Answer about a bearing, in SI units."""

    contacts: Contacts  # "atlas", "formula" or "solved"
    converged: bool  # whether the films of all contacts converged
    numbers: Mapping[str, Any]  # numbers of the table ``bearing`` of summary.json
    # Whether it has the curves over the speed; a whole answer also has what follows with ``analysed``.
    has_curves: bool
    analysed: bool  # whether it has critical speeds, effects of inputs and probability
    margin: Mapping[str, Any] | None  # table ``margin`` of summary.json; None unless ``analysed``
    contact_rows: tuple[Mapping[str, Any], ...]  # a row for each element and ring, as in ``contacts.csv``
    differences: tuple[Difference, ...] = ()
    # Margins if one input changes; None unless ``analysed``, and without a margin.
    effects: Table | None = None
    # Duty cycle of a solved bearing; None without one, and of an immediate answer, which its page asks for
    # later.
    duty: DutyAnswer | None = None


@dataclass(frozen=True)
class RemedyAnswer:
    """Answer about a bearing without and with a remedy."""

    table: Table  # what changes, now and with the remedy
    whole: bool  # whether it has the range of the margin, the probability and the critical speed


@dataclass(frozen=True)
class Reach:
    """Range of the points through which a point contact can be cut, and the first one."""

    x: tuple[float, float]  # ends of the range, in ``unit``
    y: tuple[float, float]
    at: tuple[float, float]  # first point, such as the place of the minimum film, in ``unit``
    unit: str
    turned: bool = False  # whether the maps have y along the page
    first: str = "the smallest film"


@dataclass(frozen=True, kw_only=True)
class ContactAnswer(PageAnswer):
    """Answer about a contact: before its film is solved, as of ``ehlectric check``, or solved."""

    solved: bool
    converged: bool = True  # whether a solved film converged; if not, no number may be used
    # Figures of the cuts through one point of a point contact, and the range of these points.
    cuts: Mapping[str, Figure] = field(default_factory=dict, repr=False)
    reach: Reach | None = None


@dataclass(frozen=True, kw_only=True)
class DriveAnswer(PageAnswer):
    """Answer about a drive."""

    simulated: bool  # whether the drive was simulated; otherwise a capacitive divider gives the answer
    ends: Table  # numbers of both bearings side by side
    # The drive and its remedies side by side; None before a simulation, and without remedies.
    remedies: Table | None = None


@dataclass(frozen=True, kw_only=True)
class GearAnswer(PageAnswer):
    """Answer about a gear pair."""

    solved: bool  # whether films are solved at the points of the path of contact
    geometry: Table  # contact ratios and other numbers that follow from the drawing
    points: Table  # radii, speeds, loads and films at the points A to E of the path of contact
    follows: Mapping[str, str]  # values with units that follow from other inputs, by key of the input
    # Duty cycle of a solved gear pair; None without one, and of an immediate answer, whose page asks for it
    # later.
    duty: DutyAnswer | None = None


@dataclass(frozen=True)
class NetworkPart:
    """Bearing, mesh, link or capacitance in the picture of a network."""

    name: str
    value: str  # capacitance or resistance, or that it conducts
    voltage: str  # voltage after an edge, and breakdown voltage; empty for links and capacitances
    bar: float | None  # length of the bar of U/V_b from 0 to 1, 0.5 at breakdown; None without one
    first: bool  # whether it breaks down first
    conducts: bool


@dataclass(frozen=True)
class NetworkNode:
    """Shaft in the picture of a network, with its parts to the housing and to further shafts."""

    name: str
    voltage: str
    to_housing: tuple[NetworkPart, ...]
    to_shafts: tuple[NetworkPart, ...]


@dataclass(frozen=True, kw_only=True)
class AxleAnswer(PageAnswer):
    """Answer about an axle."""

    network: tuple[NetworkNode, ...]  # shafts, those nearer to the rotor first
    elements: Table  # loads, films and voltages of all bearings and meshes
    chances: Table | None  # probabilities of all elements; None before they are computed
    shafts: Table  # speeds, torques and voltages of all shafts
    # U/V_b of all elements and voltages of all shafts, as they are and with each remedy; None before the
    # remedies are solved, and without remedies.
    remedies: Table | None
    remedied: bool  # whether the remedies are solved, or the axle has none
    effects: tuple[str, ...]  # sentence about each remedy
    simulated: bool = False  # whether the discharges over time are simulated
    # Discharges and voltages of all elements and shafts over time; None unless simulated.
    simulation: Table | None = None
