"""Tables of results and cases as HTML, which notebooks show."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from html import escape as escaped
from typing import Any

from ehlectric.axle import AxleResult
from ehlectric.bearing import BearingResult
from ehlectric.calibration import Calibration
from ehlectric.cases.axle_case import AxleCase
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.case import Case
from ehlectric.cases.drive_case import DriveCase
from ehlectric.cases.film_factors import FilmFactors
from ehlectric.cases.gear_case import GearCase
from ehlectric.cases.solved_case import SolvedCase
from ehlectric.cases.table_edits import flattened
from ehlectric.contact import ContactResult
from ehlectric.drive import DriveResult
from ehlectric.errors import printable
from ehlectric.gear import GearResult
from ehlectric.motion.result import MotionResult
from ehlectric.quantities.formats import CELSIUS, Scale, scale_for, scale_of, suited
from ehlectric.quantities.palette import LIGHTS
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.quantities.rows import Row
from ehlectric.readable import readable
from ehlectric.runtime.display import is_number
from ehlectric.sweep import Range, Sweep, SweepResults, label_of, sweep_warnings
from ehlectric.tables.axle_tables import axle_rows
from ehlectric.tables.bearing_tables import total_rows
from ehlectric.tables.calibration_tables import calibration_rows
from ehlectric.tables.contact_tables import result_rows
from ehlectric.tables.drive_tables import drive_rows
from ehlectric.tables.gear_tables import gear_rows
from ehlectric.tables.measured_tables import factor_rows
from ehlectric.tables.motion_tables import run_rows
from ehlectric.tables.sweep_summary import sweep_rows

# Largest number of values of a varied key that are listed.
_LISTED = 6


def html_of(shown: Any) -> str:
    """Table of a result or a case as HTML. Returns title, verdict if there is one, the rows that the command
    prints, and warnings.
    """
    rows_of = next(rows for kind, rows in _ROWS.items() if isinstance(shown, kind))
    title = getattr(shown, "title", "") or getattr(getattr(shown, "case", None), "title", "")
    parts = [
        f"<p><b>{escape(type(shown).__name__)}</b>{f': {escape(title)}' if title else ''}</p>",
        _verdict(getattr(shown, "verdict", None)),
        "<table>",
        *map(_row, rows_of(shown)),
        "</table>",
        *(f"<p>{_word(warning)}: {escape(str(warning))}</p>" for warning in _warnings(shown)),
    ]
    return "<div>" + "".join(parts) + "</div>"


def escape(text: str) -> str:
    """Text as HTML, with the characters that are not seen as escapes."""
    return escaped(printable(text))


def _verdict(verdict: Any) -> str:
    """Sentences of a verdict with a dot of its colour; empty without one."""
    if verdict is None:
        return ""
    dot = f'<span style="color:{LIGHTS[verdict.level]}">&#9679;</span>'
    return f"<p>{dot} {escape(verdict.text)}</p>"


def _row(row: Row) -> str:
    style = f' style="color:{LIGHTS["red"]}"' if row.alarm else ""
    name = escape(row.name).replace("  ", "&emsp;")
    value, rest = escape(row.bounded), escape(f"{row.unit}{row.note}")
    return (
        f'<tr{style}><td style="text-align:left">{name}</td><td style="text-align:right">{value}</td>'
        f'<td style="text-align:left">{rest}</td></tr>'
    )


def _word(warning: ResultWarning) -> str:
    return "note" if warning.severity == "note" else "warning"


def _warnings(shown: Any) -> Iterable[ResultWarning]:
    """Warnings of a result; none of a case."""
    if isinstance(shown, SweepResults):
        return sweep_warnings(shown)
    warnings: Iterable[ResultWarning] = getattr(shown, "warnings", ())
    return warnings


def input_rows(case: SolvedCase) -> Iterator[Row]:
    """Rows of the inputs of a case that are given, without defaults."""
    given = flattened(case.model_dump(mode="json", exclude_none=True, exclude_unset=True))
    for key, value in given.items():
        if key != "title":
            yield input_row(case, key, value)
    if isinstance(case, Case) and case.user_laws is not None:
        for key, name in case.user_laws.names.items():
            yield Row(f"laws.{key}", name)


def input_row(case: SolvedCase, key: str, value: Any) -> Row:
    """Row of an input: its dotted key, and its value in a unit that suits it."""
    listed = value if isinstance(value, list) else []
    if listed and all(map(is_number, listed)) and label_of(key, case).unit:
        scale = _scale(key, case, [min(filter(None, map(abs, listed)), default=1.0)])
        return Row(key, ", ".join(readable(scale.of(number), 6) for number in listed), scale.unit)
    if not is_number(value):
        return Row(key, value if isinstance(value, str) else json.dumps(value))
    scale = _scale(key, case, [float(value)])
    return Row(key, readable(scale.of(value), 6), scale.unit)


def _scale(key: str, case: SolvedCase, values: Sequence[float]) -> Scale:
    """Unit that suits all of some values of an input: °C, rpm, per GPa, or with a prefix that it lacks."""
    label, largest = label_of(key, case), max(map(abs, values))
    unit = label.unit
    if label.absolute:
        return CELSIUS
    if unit == "rad" and label.shown == "deg":
        return scale_of("deg")
    if unit in ("rad/s", "A/m**2", "m**2/s", "1/Pa", "m**2", "m**3"):
        return scale_for(largest or 1.0, unit)
    return Scale(*suited(largest or 1.0, unit))


def _sweep_rows(sweep: Sweep) -> Iterator[Row]:
    """Rows of a sweep: its design, and the values or the range of each varied key."""
    yield Row("design", sweep.design, note=f"{sweep.size} points")
    for key, values in sweep.vary.items():
        ends = (values.start, values.stop) if isinstance(values, Range) else values
        numbers = [float(value) for value in ends if isinstance(value, int | float)]
        scale = _scale(key, sweep.case, numbers) if len(numbers) == len(ends) else Scale(1.0, "")
        texts = [readable(scale.of(value), 6) if numbers else str(value) for value in ends]
        if isinstance(values, Range):
            yield Row(key, " to ".join(texts), scale.unit, f", {values.spacing}")
        else:
            more = f", ... ({len(texts)} values)" if len(texts) > _LISTED else ""
            yield Row(key, ", ".join(texts[:_LISTED]) + more, scale.unit)


def _axle_rows(case: AxleCase) -> Iterator[Row]:
    """Rows of the inputs of an axle in SI units, with each list of tables in one row."""
    for key, value in flattened(case.to_dict()).items():
        if key != "title":
            yield Row(key, value if isinstance(value, str) else json.dumps(value))


# Rows by the class of what is shown.
_ROWS: Mapping[type, Callable[[Any], Iterable[Row]]] = {
    ContactResult: result_rows,
    BearingResult: lambda result: total_rows(result.summary()),
    DriveResult: lambda result: drive_rows(result.summary()),
    GearResult: lambda result: gear_rows(result.summary()),
    AxleResult: lambda result: axle_rows(result.summary()),
    MotionResult: lambda result: run_rows(result.summary()),
    SweepResults: sweep_rows,
    FilmFactors: factor_rows,
    Calibration: calibration_rows,
    Case: input_rows,
    BearingCase: input_rows,
    DriveCase: input_rows,
    GearCase: input_rows,
    AxleCase: _axle_rows,
    Sweep: _sweep_rows,
}
