"""Answers about measured values: what was measured, and the calibration of the uncertain inputs with them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from time import perf_counter
from typing import Any

from ehlectric.app.charts.calibration_charts import compared_figure, ranges_figure
from ehlectric.app.compute.answer_parts import page_warnings_of, run_case_of
from ehlectric.app.form_fields.axle_fields import other_inputs
from ehlectric.app.form_fields.field_defaults import DRIVE_END, NON_DRIVE_END, end_and_key
from ehlectric.app.form_fields.field_rules import changed
from ehlectric.app.page_inputs import Inputs
from ehlectric.app.view_models import CalibrationAnswer, Table
from ehlectric.calibration import Calibration, calibrate, given_points, written_input
from ehlectric.cases.axle_case import AxleCase
from ehlectric.cases.measured_inputs import MeasuredValue
from ehlectric.cases.measurements import calibrated as calibrated_quantity
from ehlectric.cases.measurements import quantity_text
from ehlectric.discharge.breakdown_rule import Chance
from ehlectric.quantities.inputs import ENDS, REPLACED
from ehlectric.quantities.quantity import data_file
from ehlectric.readable import capital, chance_text, ratio_text, readable
from ehlectric.runtime.progress import Progress
from ehlectric.tables.calibration_tables import compared_cells, input_cells

_TEXTS = data_file("ehlectric.app", "page_texts.toml")["calibration"]

# Keys of an updated case whose values the page keeps: how its films are computed.
_KEPT = ("contacts", "drive_end.contacts", "non_drive_end.contacts")


def checked(table: Mapping[str, Any], session: Path | None = None) -> str:
    """Sentences on the measured values of a case. Raises InputError if one of them cannot be used."""
    given = given_points(run_case_of(table, session))
    of_page = [value for value in given.values if value.line is None]
    of_file = [value for value in given.values if value.line is not None]
    points = {tuple(sorted(given.points[value.point].items())) for value in of_file}
    if not of_file:
        counts = f"{_count(len(of_page), 'measured value')} at 1 operating point"
    else:
        at = _count(len(points), "operating point")
        counts = f"{_count(len(of_file), 'measured value')} at {at} of the file"
        counts += f", and {len(of_page)} at the operating point of the page" if of_page else ""
    return " ".join([f"{counts}.", *_doubts(given.values)])


def _count(number: int, name: str) -> str:
    return f"{number} {name}{'' if number == 1 else 's'}"


def _doubts(values: Iterable[MeasuredValue]) -> Iterator[str]:
    """Sentences on uncertainties above their values. A share of time or a temperature may have such an
    uncertainty.
    """
    large = (
        value
        for value in values
        if calibrated_quantity(value.quantity).relative and value.uncertainty > value.value
    )
    for name in dict.fromkeys(quantity_text(value.quantity) for value in large):
        yield f"The uncertainty of the {name} is larger than the measured value: check its unit."


def calibrated(table: Mapping[str, Any], session: Path, progress: Progress) -> CalibrationAnswer:
    """Answer about the uncertain inputs of a case after its measurement. Raises InputError if the tables are
    no valid case, or ``calibrate`` refuses its measured values.
    """
    begin = perf_counter()
    case = run_case_of(table, session)
    result = calibrate(case, progress=progress)
    figures = {"compared": compared_figure(result)}
    if result.explained:
        figures["ranges"] = ranges_figure(result)
    return CalibrationAnswer(
        explained=result.explained,
        verdict=result.verdict,
        chances=_chances(result),
        chance="" if result.after is None else f"breakdown {result.after.brief}",
        inputs=_table(_TEXTS["inputs"], input_cells(result)) if result.explained else None,
        compared=_table(_TEXTS["compared"], compared_cells(result)),
        figures=figures,
        warnings=page_warnings_of(result.warnings),
        updated=_updated(table, case, result) if result.case is not None else None,
        seconds=perf_counter() - begin,
    )


def _table(caption: str, cells: Iterator[tuple[str, ...]]) -> Table:
    heads, *rows = cells
    return Table(caption, tuple(capital(head.replace("\n", " ")) for head in heads), tuple(rows))


def _chances(result: Calibration) -> Table | None:
    """Probability of breakdown and margins before and after the measurement."""
    before, after = result.before, result.after
    if before is None or after is None:
        return None
    rows = zip(_TEXTS["chances"], _texts(before), _texts(after), strict=True)
    return Table(_TEXTS["probable"], ("", "Before", "After"), tuple(rows))


def _texts(chance: Chance) -> tuple[str, str, str]:
    low, high = chance.bounds
    probability = (
        f"{readable(100.0 * low, 2)} to {readable(100.0 * high, 2)} %"
        if chance.failed
        else chance_text(chance.probability, chance.error)
    )
    interval = " to ".join(map(ratio_text, (chance.low, chance.high)))
    return probability, ratio_text(chance.median), interval


def _updated(table: Mapping[str, Any], case: Any, result: Calibration) -> dict[str, Any]:
    """Tables of a page with the values and ranges that the measurement changed, without measured values."""
    before, after = (_flat(each) for each in (case, result.case))
    changes = {
        key: _written(key, value)
        for key, value in after.items()
        if value != before.get(key, _resolved(case, key)) and key not in _KEPT
    }
    inputs = Inputs(table).changed({"measured": None})
    return dict(changed(inputs, dict(_of_page(inputs, changes))).table)


def _of_page(inputs: Inputs, changes: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    """Changes without values of bearings that a drive gives, or that equal values of the other end."""
    if DRIVE_END in inputs.table and inputs.value(NON_DRIVE_END) is None:
        first, second = (
            {inner: value for key, value in changes.items() for at, inner in [end_and_key(key)] if at == end}
            for end in ENDS
        )
        if first == second:
            changes = {key: value for key, value in changes.items() if end_and_key(key)[0] != NON_DRIVE_END}
        else:
            yield NON_DRIVE_END, inputs.value(DRIVE_END)
    for key, value in changes.items():
        end, inner = end_and_key(key)
        of_drive = end in ENDS and inner in REPLACED and inputs.value(REPLACED[inner]) is not None
        if not of_drive or inputs.value(key) is not None:
            yield key, value


def _flat(case: Any) -> Mapping[str, Any]:
    """Inputs of a case by dotted key; tables of an axle have numbers, from 1."""
    inputs = Inputs(case.to_dict())
    return other_inputs(inputs) if isinstance(case, AxleCase) else inputs.flat()


def _resolved(case: Any, key: str) -> Any:
    """Value that a case has of a dotted key, also from the library; None where it has none."""
    value = case
    for name in key.split("."):
        listed = isinstance(value, list | tuple) and name.isdecimal() and 1 <= int(name) <= len(value)
        value = value[int(name) - 1] if listed else getattr(value, name, None)
    return value


def _written(key: str, value: Any) -> Any:
    """Value of an input, or the ends of a range, as a person writes it: with the unit of its field."""
    *_, name = _parts(key)
    return written_input(end_and_key(name)[1], value)


def _parts(key: str) -> tuple[str, str]:
    """Table of ranges before a dotted key, and the key; a range has the key of its input in quotes."""
    ranges, quote, name = key.rstrip('"').partition('"')
    return (ranges, name) if quote else ("", key)
