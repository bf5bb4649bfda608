"""State of a sweep as the page shows it, read from its database while points are being solved."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from ehlectric.app.answers.sweep import Axis, Chart, ChartPoint, PointState, SweepView
from ehlectric.app.answers.told import Told
from ehlectric.app.compute.sweep import is_stored, named
from ehlectric.app.compute.warnings import told_of
from ehlectric.app.figures.sweep import figure_of
from ehlectric.bearing.accuracy import percent
from ehlectric.cases.bearings.case import BearingCase
from ehlectric.cases.bearings.ways import HOW
from ehlectric.cases.input_keys import unit_of
from ehlectric.errors import CODES
from ehlectric.quantities.formats import CELSIUS, Scale, scale_for
from ehlectric.quantities.quantity import key_of
from ehlectric.quantities.rows import value_at
from ehlectric.runtime.values import is_number
from ehlectric.sweep.breakdown_keys import Breakdown, breakdown_of
from ehlectric.sweep.labels import label_of, result_keys
from ehlectric.sweep.points import Point, flat
from ehlectric.sweep.results import SweepResults
from ehlectric.sweep.slices import known_values
from ehlectric.sweep.store import read_sweep
from ehlectric.sweep.warnings import sweep_warnings

# Number of points whose summaries say what may be shown.
_SAMPLE = 50

# Most warnings of a point that a map tells when the pointer is on it.
_MOST_TOLD = 3


def seen(folder: str, shown: str, table: Mapping[str, Any]) -> SweepView | None:
    """State of a sweep, finished, stopped or running; None where the folder still has another one.

    Parameters
    ----------
    folder : str
        Folder of the sweep.
    shown : str
        Dotted key of the summary that the map shows.
    table : mapping
        Tables of the sweep that is asked for.

    Raises
    ------
    InputError
        If the folder has no sweep.
    """
    results = read_sweep(folder)
    return view_of(results, shown) if is_stored(results, table) else None


def view_of(results: SweepResults, shown: str) -> SweepView:
    """State of a sweep as the page shows it.

    Parameters
    ----------
    results : SweepResults
        A grid over one or two inputs, finished or not.
    shown : str
        Dotted key of the summary that the map shows.
    """
    chart = _chart(results, shown)
    verdict = results.verdict
    return SweepView(
        counts=dict(Counter(point.state for point in chart.points)),
        chart=chart,
        figure=figure_of(chart),
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
        level="" if verdict is None else verdict.level,
        text="" if verdict is None else verdict.text,
        warnings=tuple(map(_without_code, told_of(sweep_warnings(results)))),
    )


def _without_code(told: Told) -> Told:
    """Warning on a kind of warnings without the code of this kind, which only files and commands need."""
    return replace(told, text=_CODE.sub(lambda found: f"{found[1]}: ", told.text))


_CODE = re.compile(rf"\b(warning|note) (?:{'|'.join(CODES)}): ")


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
    """Names of the numbers that points have; those without a name are no results to look at."""
    documented = result_keys(results.case)
    some = replace(results, points=tuple(point for point in results.points if point.solved)[:_SAMPLE])
    found = {key: key_of(documented, key) for key in known_values(some) if not key.startswith("inputs.")}
    return {
        key: f"{about.label[0].upper()}{about.label[1:]}"
        for key, about in found.items()
        if about is not None and about.label
    }


def _chart(results: SweepResults, shown: str) -> Chart:
    axes = [_axis(results, key) for key in results.varied[:2]]
    about, label = breakdown_of(results.case, shown), label_of(shown, results.case)
    name = named(shown, results.case)
    rows = [flat(point.summary) if point.solved and point.summary else {} for point in results.points]
    values = [row[shown] if is_number(row.get(shown)) else None for row in rows]
    usable = [None if point.doubtful else value for point, value in zip(results.points, values, strict=True)]
    scale = _scale(label.unit, [value for value in usable if value is not None])
    margins = [_margin(row, about) for row in rows]
    applied = [row.get(about.voltage) if shown == about.value else None for row in rows]
    if shown == about.margin:
        applied = [None if margin is None else 1.0 for margin in margins]
    points = tuple(
        _point(results, point, name_of=(name, scale), value=value, margin=margin, voltage=voltage)
        for point, value, margin, voltage in zip(results.points, values, margins, applied, strict=True)
    )
    title = _titled(name, scale)
    critical = f"margin 1: {about.name} = {about.voltage_name}"
    some = any(point.margin is not None for point in points)
    second = axes[1] if len(axes) > 1 else None
    limit = critical if shown == about.margin else about.voltage_name
    return Chart(axes[0], second, title, critical if some else "", limit, points)


def _axis(results: SweepResults, key: str) -> Axis:
    scale = _input_scale(results, key)
    # Twelve digits: 300.00000000000006 rpm would be the text of a tick.
    shown = tuple(float(f"{value:.12g}") for value in scale.of(np.array(results.axes[key], dtype=float)))
    return Axis(_titled(named(key, results.case), scale), shown, _is_log(results.axes[key]))


def _titled(name: str, scale: Scale) -> str:
    return f"{name} [{scale.unit}]" if scale.unit else name


def _is_log(values: Sequence[float]) -> bool:
    """Whether values are spaced by equal ratios, and not by equal steps."""
    if len(values) < 3 or min(values) <= 0.0:
        return False
    ratios, steps = np.diff(np.log(values)), np.diff(values)
    return bool(np.ptp(ratios) < 1e-6 * abs(ratios[0]) and np.ptp(steps) > 1e-6 * abs(steps[0]))


def _scale(unit: str, values: Sequence[float]) -> Scale:
    if unit == "K":
        return CELSIUS
    return scale_for(max(map(abs, values), default=1.0) or 1.0, unit)


def _input_scale(results: SweepResults, key: str) -> Scale:
    return _scale(unit_of(key), results.axes[key])


def _margin(row: Mapping[str, Any], about: Breakdown) -> float | None:
    """Margin of a summary, or where that has none, the ratio of its voltages."""
    margin = row.get(about.margin)
    if is_number(margin):
        return float(margin)
    value, voltage = row.get(about.value), row.get(about.voltage)
    return float(value / voltage) if is_number(value) and is_number(voltage) and voltage else None


def _point(
    results: SweepResults,
    point: Point,
    *,
    name_of: tuple[str, Scale],
    value: float | None,
    margin: float | None,
    voltage: float | None,
) -> ChartPoint:
    name, scale = name_of
    state = _state(point, value)
    texts = [
        f"{named(key, results.case)}: {_input_scale(results, key).text(item)}"
        for key, item in point.inputs.items()
    ]
    if state == "solved" and value is not None:
        texts.append(f"{name}: {scale.text(float(value))}")
        texts += [] if margin is None else [f"Margin: {margin:.3g}"]
    else:
        texts.append(f"{state}: {_reason(point, state)}".rstrip(": "))
    told = [warning for warning in told_of(point.warnings) if warning.severity != "note"]
    texts += [f"{warning.severity}: {warning.text}" for warning in told[:_MOST_TOLD]]
    texts += [f"and {len(told) - _MOST_TOLD} more warnings"] if len(told) > _MOST_TOLD else []
    if state != "solved":
        return ChartPoint(point.number, state, tuple(texts))
    return ChartPoint(
        point.number,
        state,
        tuple(texts),
        value=None if value is None else float(scale.of(value)),
        margin=margin,
        voltage=None if voltage is None else float(scale.of(voltage)),
    )


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
        if summary.get("bearing", {}).get("lubrication") == "conducting":
            return "the lambda ratio is below 1, contacts open and close, and no voltage is computed"
        return "the case has no such number"
    return point.reason


def _row(results: SweepResults, point: Point, drawn: ChartPoint) -> tuple[str, ...]:
    inputs = [_input_scale(results, key).text(item) for key, item in point.inputs.items()]
    value = "" if drawn.value is None else f"{drawn.value:.4g}"
    margin = "" if drawn.margin is None else f"{drawn.margin:.3g}"
    reason = "" if drawn.state in ("solved", "open") else _reason(point, drawn.state)
    state = f"{drawn.state}: {reason}" if reason else drawn.state
    return (str(point.number), *inputs, value, margin, state)
