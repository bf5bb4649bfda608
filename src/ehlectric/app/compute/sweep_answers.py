"""Sweeps of the pages: inputs that may vary, size, run, and state while points are being solved."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import tomli

from ehlectric.app.charts.plotly_panels import STRIP, STRIP_AXIS, Plot, values
from ehlectric.app.charts.sweep_charts import line_figure, map_figure
from ehlectric.app.compute import answer_parts
from ehlectric.app.compute.answer_parts import gauge_text, page_warnings_of, run_case_of
from ehlectric.app.form_fields import BEARING_GROUPS, GEAR_GROUPS
from ehlectric.app.form_fields.drive_fields import DRIVE_GROUPS
from ehlectric.app.form_fields.field import Field
from ehlectric.app.page_inputs import Inputs, number_of_text
from ehlectric.app.view_models import (
    Chart,
    ChartPoint,
    Deciding,
    Gauge,
    Number,
    PageWarning,
    PointState,
    SweepChoices,
    SweepPlan,
    SweepPoint,
    SweepView,
    Variable,
)
from ehlectric.bearing import is_quick, percent
from ehlectric.cases.amounts import Amount, Count
from ehlectric.cases.axle_case import AxleCase
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.defaults import HOW
from ehlectric.cases.drive_case import DriveCase
from ehlectric.cases.gear_case import GearCase
from ehlectric.cases.input_keys import input_of, kind_of, of_both_ends, unit_of
from ehlectric.cases.solved_case import SolvedCase, solved_case_of_dict
from ehlectric.cases.table_edits import flattened, set_keys
from ehlectric.errors import InputError
from ehlectric.figures.data import with_unit
from ehlectric.figures.sweep_panels import labelled, lines_panel, map_panel, needed_values
from ehlectric.quantities.formats import CELSIUS, Scale
from ehlectric.quantities.grouped_digits import certain
from ehlectric.quantities.inputs import BOTH, ENDS, end_and_key, input_at
from ehlectric.quantities.lubrication_states import is_shorted
from ehlectric.quantities.quantity import key_of
from ehlectric.quantities.result_warnings import CODES
from ehlectric.quantities.rows import value_at
from ehlectric.quantities.sheets import SWEEPS, at_ends
from ehlectric.quantities.units import in_unit, rounded, rpm, si_unit, split
from ehlectric.quantities.verdict import Verdict
from ehlectric.readable import capital, ratio_text, readable
from ehlectric.runs.by_kind import run_sweep
from ehlectric.runtime.display import is_number
from ehlectric.sweep import (
    FILES,
    NAME,
    Point,
    Sweep,
    SweepResults,
    breakdown_of,
    case_key,
    check_varied,
    known_values,
    label_of,
    planned_points,
    ranked_value,
    read_sweep,
    result_keys,
    seconds_of,
    sweep_warnings,
    swept_verdict,
    whole,
    write_tables,
)
from ehlectric.tables.sweep_summary import grouped_reasons

# Number of points whose summaries say what may be shown.
_SAMPLE = 50

# Most warnings of a point that a map shows when the pointer is on it.
_MOST_WARNINGS = 3


def seen(folder: str, shown: str, table: Mapping[str, Any]) -> SweepView | None:
    """State of a sweep, finished, stopped or running; None where the folder still has another one. Raises
    InputError if the folder has no sweep.
    """
    results = read_sweep(folder)
    return view_of(results, shown) if is_stored(results, table) else None


def view_of(results: SweepResults, shown: str) -> SweepView:
    """State of a sweep as the page shows it."""
    chart, figure = _chart(results, shown)
    verdict, lowest = _verdict(results), _lowest(chart)
    return SweepView(
        counts=dict(Counter(point.state for point in chart.points)),
        verdict=verdict or _NO_VERDICT,
        meaning=meaning_of(verdict or _NO_VERDICT),
        deciding=Deciding("") if lowest is None else deciding(chart),
        number=lowest,
        chart=chart,
        figure=figure,
        columns=(
            "Point",
            *(named(key, results.case) for key in results.varied),
            chart.title,
            "Margin",
            "State",
        ),
        rows=tuple(
            _row(results, point, drawn) for point, drawn in zip(results.points, chart.points, strict=True)
        ),
        values=_values(results),
        accuracy=_accuracy(results),
        warnings=(*_failures(results), *map(_without_code, page_warnings_of(sweep_warnings(results)))),
    )


def _verdict(results: SweepResults) -> Verdict | None:
    """Verdict of the command or, on drives, of their report."""
    if not isinstance(results.case, DriveCase):
        return results.verdict
    return swept_verdict(results)


# Verdict on points without margins.
_NO_VERDICT = Verdict("grey", "no-margin")


def meaning_of(verdict: Verdict) -> str:
    """First words of a verdict on a sweep where its heading has others, as a sentence.

    Examples
    --------
    >>> from ehlectric.quantities.statement import Statement
    >>> counts = Statement.of("points-margins", word="likely", below=3, known=8, low=0.5, high=2.0)
    >>> meaning_of(Verdict("yellow", "points-some-likely", counts))
    'Breakdown is likely at 3 of 8 points.'
    """
    if verdict is _NO_VERDICT:
        return "The map has the results of the points."
    return "" if verdict.heading.startswith(verdict.lead) else f"{verdict.lead}."


def _lowest(chart: Chart) -> Number | None:
    """Lowest margin of the points with the inputs of its point; None where none has a margin."""
    known = [point for point in chart.points if point.margin is not None]
    if not known:
        return None
    worst = min(known, key=lambda point: point.margin or 0.0)
    inputs = worst.texts[: len(chart.inputs)]
    return Number("sweep.margin", "Lowest margin", ratio_text(worst.margin or 0.0), note=", ".join(inputs))


def deciding(chart: Chart) -> Deciding:
    """Lowest margin of the points, with the margins of all as its interval."""
    margins = [point.margin for point in chart.points if point.margin is not None]
    ends = min(margins), max(margins)
    below = sum(margin < 1.0 for margin in margins)
    facts = (
        ("margins of the points", " to ".join(map(ratio_text, ends))),
        ("points with a margin below 1", f"{below} of {len(margins)}"),
    )
    said = ("points-margins", "breakdown-expected")
    return Deciding("sweep.margin", facts, Gauge(gauge_text(ends[0], facts), ends[0], ends), said=said)


def _failures(results: SweepResults) -> Iterator[PageWarning]:
    """Warnings with the reasons why points have no result, the most frequent one first."""
    reasons = (point.reason for point in results.points if not point.solved)
    for count, reason in grouped_reasons(reasons):
        points = "1 point has" if count == 1 else f"{count} points have"
        yield PageWarning("", "warning", f"{points} no result: {reason}")


def _without_code(warning: PageWarning) -> PageWarning:
    """Warning on a kind of warnings without the code of this kind, which only files and commands need.

    Its text says all that the meaning of its own code does.
    """
    return replace(warning, meaning="", text=_CODE.sub("At ", warning.text))


_CODE = re.compile(rf"^(?:{'|'.join(CODES)}) at ")


def _accuracy(results: SweepResults) -> str:
    """Sentence about the error of films that are not solved; empty without them."""
    case = results.case
    if not isinstance(case, BearingCase) or case.contacts == "solved":
        return ""
    how = f"Contacts are {HOW[case.contacts]}"
    errors = [value_at(point.summary or {}, "bearing.film_error") for point in results.points]
    known = [float(error) for error in errors if error is not None]
    return f"{how}, films may be {percent(max(known))} off." if known else f"{how}."


def _values(results: SweepResults) -> dict[str, str]:
    """Names of the numbers that points have; numbers without a name are no results to look at."""
    documented = result_keys(results.case)
    some = replace(results, points=tuple(point for point in results.points if point.solved)[:_SAMPLE])
    entries = {key: key_of(documented, key) for key in known_values(some) if not key.startswith("inputs.")}
    return {
        key: capital(about.label)
        for key, about in entries.items()
        if about is not None and about.label and not about.successor
    }


def _chart(results: SweepResults, shown: str) -> tuple[Chart, Plot]:
    """Points of the map or of the line of a value, and its figure."""
    selection = whole(results, shown)
    name = named(shown, results.case)
    inputs = {key: (named(key, results.case), _input_scale(results, key)) for key in results.varied}
    at = [inputs[key][1].of(results.values(key)) for key in results.varied[:2]]
    drawn = selection.values if selection.y is not None else needed_values(selection)
    scale, known = labelled(results, shown, drawn)[1], np.isfinite(selection.values)
    # None where a point has no value that may be drawn, and no margin with it.
    numbers, margins = (
        [float(number) if np.isfinite(number) else None for number in column]
        for column in (scale.of(selection.values), np.where(known, selection.margin, np.nan))
    )
    if selection.y is None:
        at.append(np.where(known, scale.of(selection.values), STRIP))
    rows = zip(zip(*values(np.array(at), 12), strict=True), numbers, margins, strict=True)
    points = [
        _point(point, *row, named_scale=(name, scale), inputs=inputs)
        for point, row in zip(results.points, rows, strict=True)
    ]
    titles = tuple(with_unit(inputs[key][0], inputs[key][1].unit) for key in results.varied[:2])
    shape = tuple(len(results.axes[key]) for key in results.varied[:2])
    chart = Chart(with_unit(name, scale.unit), titles, shape, tuple(points))
    if selection.y is None:
        return chart, line_figure(*lines_panel(results, selection), points)
    return chart, map_figure(map_panel(results, selection, limited=True), points)


def _input_scale(results: SweepResults, key: str) -> Scale:
    return labelled(results, key, results.values(key))[1]


def _point(
    point: Point,
    place: tuple[float, float],
    value: float | None,
    margin: float | None,
    *,
    named_scale: tuple[str, Scale],
    inputs: Mapping[str, tuple[str, Scale]],
) -> ChartPoint:
    """Point of a chart at a place, with the names and scales of its value and of the inputs."""
    (name, scale), state = named_scale, _state(point, value)
    texts = [f"{label}: {of_input.text(point.inputs[key])}" for key, (label, of_input) in inputs.items()]
    if value is not None:
        texts.append(f"{name}: {readable(value, 4)} {scale.unit}".rstrip())
        texts += [] if margin is None else [f"Margin: {readable(margin)}"]
    else:
        texts.append(f"{state}: {_reason(point, state)}".rstrip(": "))
    serious = [warning for warning in page_warnings_of(point.warnings) if warning.severity != "note"]
    texts += [f"{warning.severity}: {warning.text}" for warning in serious[:_MOST_WARNINGS]]
    texts += [f"and {len(serious) - _MOST_WARNINGS} more warnings"] if len(serious) > _MOST_WARNINGS else []
    axis = STRIP_AXIS if len(inputs) == 1 and value is None else "y"
    return ChartPoint(point.number, state, tuple(texts), place, axis, value, margin)


def _state(point: Point, value: float | None) -> PointState:
    if not point.solved:
        return point.status
    if point.doubtful:
        return "do not use"
    return "no value" if value is None else "solved"


def _reason(point: Point, state: PointState) -> str:
    """Why a point has no number to draw."""
    if state == "do not use":
        return "see its severe warning"
    if state == "no value":
        summary = point.summary or {}
        if is_shorted(summary):
            return "asperity contact is frequent, and no voltage is computed"
        return "the case has no such number"
    return point.reason


def _row(results: SweepResults, point: Point, drawn: ChartPoint) -> tuple[str, ...]:
    inputs = [_input_scale(results, key).text(item) for key, item in point.inputs.items()]
    value = "" if drawn.value is None else readable(drawn.value, 4)
    margin = "" if drawn.margin is None else readable(drawn.margin)
    reason = "" if drawn.state in ("solved", "open") else _reason(point, drawn.state)
    state = f"{drawn.state}: {reason}" if reason else drawn.state
    return (str(point.number), *inputs, value, margin, state)


# Most points of a sweep of a page: larger ones are for the command, which needs no open tab.
MOST_POINTS = 2500

# Tables whose numbers say how a case is computed, not what it is.
_OF_SOLUTION = ("solver", "grid", "ranges", "title")


def sweep_of(table: Mapping[str, Any]) -> Sweep:
    """Sweep of the tables of a sweep file with its base case inside. Raises InputError if the tables are no
    valid sweep, name a file, or have more points than a page may solve.
    """
    case = table.get("case")
    if not isinstance(case, Mapping):
        raise InputError.missing("case", "a table with the inputs of a bearing, drive, gear pair or contact")
    try:
        run_case_of(case)
    except InputError as error:
        raise error.under("case") from None
    sweep = answer_parts.sweep_of(table)
    if sweep.size > MOST_POINTS:
        takes = f"at most {MOST_POINTS} on this page; ehlectric sweep solves more, with the file of this page"
        raise InputError("vary", got=f"{sweep.size} points", takes=takes)
    return sweep


def choices(table: Mapping[str, Any]) -> SweepChoices:
    """Inputs of a base case that a sweep can vary, and results that a map can show. Raises InputError if the
    tables are no valid case.
    """
    case = run_case_of(table)
    kind = _kind_of_case(case)
    main = filter(None, (ranked_value(case), breakdown_of(case).value))
    keys = dict.fromkeys((*main, *at_ends(SWEEPS[kind])))
    return SweepChoices(kind, tuple(_variables(table, case)), {key: named(key, case) for key in keys})


# Paths of pages by kind of case.
_PAGES = {"bearing": "/", "drive": "/drive", "contact": "/contact", "gear": "/gear", "axle": "/axle"}

# Tables of an axle whose numbers a page offers, and keys of the bearings of each shaft.
_OF_AXLES = ("drive", "source", "circuit", "discharge", "lubricant")
_OF_SHAFTS = ("composite_rq", "radial_clearance")


def _kind_of_case(case: SolvedCase) -> str:
    if isinstance(case, DriveCase):
        return "drive"
    if isinstance(case, GearCase):
        return "gear"
    if isinstance(case, AxleCase):
        return "axle"
    return "bearing" if isinstance(case, BearingCase) else "contact"


def _variables(table: Mapping[str, Any], case: SolvedCase) -> Iterator[Variable]:
    if isinstance(case, DriveCase):
        written, resolved = _by_key(table, case), _by_key(case.to_dict(), case)
        fields = _drive_fields()
    elif isinstance(case, AxleCase):
        written, resolved, fields = _of_axle(table), _of_axle(case.to_dict()), dict[str, Field]()
        shafts = [f"bearing.{shaft.name}.{name}" for shaft in case.shaft for name in _OF_SHAFTS]
        resolved |= {key: case.value_of(key) for key in shafts}
    else:
        written, resolved = Inputs(table).flat(), flattened(case.to_dict())
        groups = GEAR_GROUPS if isinstance(case, GearCase) else BEARING_GROUPS
        fields = {field.key: field for group in groups for field in group.fields}
    numbers = [key for key, value in resolved.items() if is_number(value) and _may_vary(key, case)]

    def rank(key: str) -> tuple[int, int, int]:
        common = SWEEPS["inputs"].index(key) if key in SWEEPS["inputs"] else len(SWEEPS["inputs"])
        return common, key not in written, input_at(key) is None

    for key in sorted(numbers, key=rank):
        slider, text = fields.get(key), str(written.get(key, ""))
        if slider is not None and slider.kind != "number":
            slider = None
        ends = _ends(text, resolved[key], key)
        if ends is not None:
            yield Variable(key, named(key, case), *ends, log=slider is not None and slider.log)


def _of_axle(table: Mapping[str, Any]) -> dict[str, Any]:
    """Values of the tables of an axle that are no lists, by dotted key."""
    return flattened({name: table[name] for name in _OF_AXLES if isinstance(table.get(name), Mapping)})


def _may_vary(key: str, case: SolvedCase) -> bool:
    """Whether a sweep can vary a number of a case, which is none of how the case is computed."""
    if kind_of(key) is None or key.partition(".")[0] in _OF_SOLUTION:
        return False
    try:
        check_varied(key, case)
    except InputError:
        return False
    return True


def _by_key(table: Mapping[str, Any], case: DriveCase) -> dict[str, Any]:
    """Values of the tables of a drive by the keys of a sweep; equal bearings have one key for both."""
    rest = {key: value for key, value in table.items() if key not in (*ENDS, "remedies")}
    same = case.drive_end == case.non_drive_end
    ends = {BOTH: table[ENDS[0]]} if same else {end: table.get(end, {}) for end in ENDS}
    return flattened({**Inputs(rest).table, **ends})


def _drive_fields() -> dict[str, Field]:
    """Fields of a drive by key, with the fields of both bearings."""
    both = (replace(field, key=f"{BOTH}.{field.key}") for group in BEARING_GROUPS for field in group.fields)
    fields = (field for group in DRIVE_GROUPS for field in group.fields)
    return {field.key: field for field in (*fields, *both)}


def _in_tables(table: Mapping[str, Any], values: Mapping[str, Any]) -> dict[str, Any]:
    """Values by the keys of the tables of a drive: of both bearings at each end."""
    by_key: dict[str, Any] = {}
    for key, value in values.items():
        by_key |= {name: value for name in of_both_ends(key) if name == key or end_and_key(name)[0] in table}
    return by_key


def named(key: str, case: SolvedCase) -> str:
    """Name of an input or a result; one without a name has the last part of its key."""
    name = _NAMES.get(key) or label_of(key, case).name
    if name == key:
        name = key.rpartition(".")[2].replace("_", " ")
    return capital(name)


# Names by which people look for a result.
_NAMES = {"bearing.lambda_ratio": "lambda ratio (minimum film / roughness)"}


def _ends(text: str, value: float, key: str) -> tuple[str, str] | None:
    """Valid ends of a range around a value, in the unit in which it is written; None where there are none."""
    match = re.fullmatch(r"\s*([-+]?[\d.]+(?:[eE][-+]?\d+)?)\s*(.*)", text)
    number, unit = (float(match[1]), match[2]) if match is not None else _in_si(value, key)
    # An input that the file lacks is a dimension or a constant, which has less room than a load.
    wide = [3.0] if match is not None else []
    for ratio in (*wide, 1.2):
        low, high = _around(number, unit, ratio)
        for ends in ((low, high), (low, number), (number, high)):
            texts = [f"{_short(end, key)} {unit}".strip() for end in ends]
            if texts[0] != texts[1] and all(_is_valid(text, key) for text in texts):
                return texts[0], texts[1]
    return None


def _around(number: float, unit: str, ratio: float) -> tuple[float, float]:
    if si_unit(unit) == "K":
        return number - 10.0 * ratio, number + 10.0 * ratio
    low, high = sorted((number / ratio, number * ratio))
    return (low, high) if low < high else (0.0, 1.0)


def _is_valid(text: str, key: str) -> bool:
    kind = kind_of(key)
    try:
        if isinstance(kind, Count):
            kind.parse(int(text))
        elif kind is not None:
            kind.parse(number_of_text(text), written=True)
    except InputError:
        return False
    return True


def _short(number: float, key: str) -> str:
    """Number with two digits that count, as a file takes it; a whole number of a count."""
    if isinstance(kind_of(key), Count):
        return str(round(number))
    return rounded(number, 2)


def _in_si(value: float, key: str) -> tuple[float, str]:
    """Number and unit of an SI value that a file lacks; speeds and temperatures in the usual units."""
    unit, entry = unit_of(key), input_of(key)
    if entry is not None and entry.absolute:
        return CELSIUS.of(value), "degC"
    if unit == "rad/s":
        return rpm(value), "rpm"
    if unit == "m":
        return (value * 1e6, "um") if abs(value) < 1e-4 else (value * 1e3, "mm")
    return value, unit


def planned(table: Mapping[str, Any], workers: int) -> SweepPlan:
    """Size of a sweep, refused corners of its ranges, and its time where the contacts are not solved.

    The time follows from the time of some points, which are solved here.

    Raises InputError if the tables are no valid sweep, or no corner of the ranges is a valid case.
    """
    sweep = sweep_of(table)
    ends = {key: sorted({axis[0], axis[-1]}) for key, axis in sweep.axes.items()}
    corners = planned_points(Sweep.from_dict({"case": sweep.case, "vary": ends}))
    refused = [point.refused for point in corners if point.key is None]
    seconds = None
    if not isinstance(sweep.case, AxleCase) and is_quick(sweep.case):
        alone = seconds_of(sweep)
        seconds = None if alone is None else alone / workers
    return SweepPlan(sweep.size, seconds, workers, len(refused), len(corners), next(iter(refused), ""))


def solved(
    table: Mapping[str, Any], folder: str, workers: int, progress: Callable[[int, int, str], None]
) -> Mapping[str, int]:
    """Solve the open points of a sweep into a folder, as ``ehlectric sweep`` does; numbers by status."""
    outcome = run_sweep(sweep_of(table), folder, progress, workers=workers)
    return {key: value for key, value in outcome.summary.items() if isinstance(value, int)}


def is_stored(results: SweepResults, table: Mapping[str, Any]) -> bool:
    """Whether the stored sweep belongs to the tables, with the varied inputs in the same order."""
    requested = sweep_of(table)
    # A case compares by its file, whose numbers have all digits.
    same = (results.design, results.case.to_toml()) == (requested.design, requested.case.to_toml())
    axes = [[(key, list(axis)) for key, axis in sweep.axes.items()] for sweep in (results, requested)]
    samples = requested.uncertainty_samples or 0
    return same and axes[0] == axes[1] and samples == results.uncertainty_samples


def point(folder: str, table: Mapping[str, Any], number: int) -> SweepPoint:
    """Address of the page that shows the case of a point. Raises InputError if there is no such sweep, or the
    inputs of the point are no valid case.
    """
    results = read_sweep(folder)
    if not is_stored(results, table):
        raise InputError("the sweep has been replaced by another one; run it again")
    if not 0 <= number < len(results.points):
        raise InputError("number", got=number, takes=f"from 0 to {len(results.points) - 1}")
    inputs, vary = results.points[number].inputs, table.get("vary", {})
    units = {key: _written_unit(vary, key) for key in inputs}
    tables = point_table(results.case, table["case"], inputs, units)
    return SweepPoint(number, _PAGES[_kind_of_case(results.case)], Inputs(tables).address())


def point_table(
    case: SolvedCase,
    table: Mapping[str, Any],
    inputs: Mapping[str, Any],
    units: Mapping[str, str] | None = None,
) -> dict[str, Any]:
    """Tables of a file with the case of a point.

    Its texts are the texts of the base case, where these make the same case; else all keys are in SI units.
    ``units`` are the units in which the varied inputs are best read, by key.

    Raises InputError if the inputs of the point are no valid case.
    """
    point_case = case.replace(inputs)
    if isinstance(case, AxleCase):
        return tomli.loads(point_case.to_toml())
    changed: dict[str, Any] = tomli.loads(Inputs(table).toml())
    texts = {key: _text(key, value, (units or {}).get(key, "")) for key, value in inputs.items()}
    set_keys(changed, _in_tables(table, texts) if isinstance(case, DriveCase) else texts)
    try:
        if case_key(solved_case_of_dict(changed, written=True)) == case_key(point_case):
            return changed
    except InputError:
        # As where a load replaces a Hertz pressure: the file must not have both.
        pass
    return tomli.loads(point_case.to_toml())


def _written_unit(vary: Mapping[str, Any], key: str) -> str:
    """Unit in which a range or a list of values is written; empty without one."""
    value = vary.get(key, Inputs(vary).value(key))
    first = value.get("from") if isinstance(value, Mapping) else value
    first = first[0] if isinstance(first, list) and first else first
    parts = split(first) if isinstance(first, str) else None
    return "" if parts is None else parts[1]


def _text(key: str, value: Any, unit: str = "") -> Any:
    """Value of an input with a unit, such that it reads back as the same number.

    The unit is the wanted one where a text in it has the same value to the last digit, else the SI unit.
    """
    si, kind = unit_of(key), kind_of(key)
    if not si or not isinstance(value, float):
        return value
    if unit and isinstance(kind, Amount):
        # The server reads units without the registry; an unknown one stays with the SI unit.
        number = in_unit(f"{value!r} {si.replace('**', '^')}", unit)
        for digits in () if number is None else (6, 9, 12):
            text = certain(f"{repr(float(f'{number:.{digits}g}')).removesuffix('.0')} {unit}")
            if kind.parse(text, written=True) == value:
                return text
    return certain(f"{value!r} {si}")


def files(folder: str) -> tuple[str, ...]:
    """Names of the files of a sweep, finished or not; its tables are the tables of the command. Raises
    InputError if there is no sweep, or its folder cannot be used.
    """
    place = Path(folder)
    results = read_sweep(place)
    if not all((place / name).exists() for name in FILES[:1]):
        write_tables(results, place)
    return tuple(name for name in (NAME, *FILES) if (place / name).exists())
