"""Answers about cases that are compared: their results without solving, as the command `check` has them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any

from ehlectric.app.compute import axle_answers, bearing_answers, contact_answers
from ehlectric.app.compute.answer_parts import card, case_of, kind_of, page_warnings_of
from ehlectric.app.compute.bearing_answers import quick_summary, quick_verdict, solved_quickly
from ehlectric.app.view_models import Film, Number, OverSpeed, Result, Side
from ehlectric.axle import solve_axle
from ehlectric.bearing import error_text, scaled_curves
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.case import Case
from ehlectric.cases.defaults import OF_CONTACTS
from ehlectric.errors import printable
from ehlectric.quantities.results import BEARING_BOOK
from ehlectric.quantities.rows import Row
from ehlectric.quantities.sheets import COMPARED, NOT_COMPARED
from ehlectric.quantities.units import rpm
from ehlectric.readable import readable
from ehlectric.runs.preview import preview_of
from ehlectric.tables.axle_tables import axle_rows
from ehlectric.tables.bearing_tables import check_rows


def side(table: Mapping[str, Any], folder: Path | None = None, *, whole: bool = False) -> Side:
    """Answer about one case; the answer of a bearing is ``whole`` with what depends on further solutions.
    Raises InputError if the tables are no valid case, or neither the atlas nor a formula describes its films.
    """
    if kind_of(table) == "axle":
        return _axle(table, folder, whole=whole)
    case = case_of(table, folder)
    return _bearing(case, whole=whole) if isinstance(case, BearingCase) else _contact(case)


def whole_side(table: Mapping[str, Any], folder: Path | None = None) -> Side:
    """Answer about one case, with the critical speed and the effects of the inputs of a bearing."""
    return side(table, folder, whole=True)


def _bearing(case: BearingCase, *, whole: bool) -> Side:
    result = solved_quickly(case)
    verdict = result.verdict if whole else quick_verdict(result)
    summary = result.summary() if whole else quick_summary(result)
    decides, rows = bearing_answers.deciding(summary, probable=whole), check_rows(summary)
    return Side(
        kind="bearing",
        title=case.title,
        verdict=verdict,
        meaning=bearing_answers.meaning_of(verdict),
        deciding=decides,
        number=_number(rows, decides.key),
        results=tuple(_results(rows)),
        warnings=page_warnings_of(result.warnings),
        films=tuple(_over_position(summary)),
        voltages=tuple(_over_speed(result.case, summary)) if whole else (),
        method=f"{OF_CONTACTS[result.case.contacts]}: films may be {error_text(result.solution)} off",
    )


def _axle(table: Mapping[str, Any], folder: Path | None, *, whole: bool) -> Side:
    """Answer about an axle right after an edge, with its probabilities if it is whole."""
    case = axle_answers.axle_after_an_edge(table, folder)
    result = solve_axle(case, remedies=False, probable=whole)
    answer, summary = axle_answers.answer_of(result), result.summary()
    ratios = tuple(
        (printable(name), ratio) for name, ratio in result.solution.ratios().items() if ratio > 0.0
    )
    rows = axle_rows(summary)
    shafts = [
        Result(_SHAFTS, printable(row["shaft"]), row["voltage"], readable(row["voltage"]), "V", main=True)
        for row in summary["shafts"]
    ]
    first = [Result(_RATIOS, name, ratio, readable(ratio), main=True) for name, ratio in ratios]
    others = [each for each in _results(rows) if each.group not in ("", _SHAFTS)]
    return Side(
        kind="axle",
        title=case.title,
        verdict=answer.verdict,
        meaning=answer.meaning,
        deciding=replace(answer.deciding, figure=""),
        number=answer.number(answer.deciding.key),
        results=(*first, *shafts, *others),
        warnings=answer.warnings,
        ratios=ratios,
        method="films of the atlas, and voltages right after an edge",
    )


# Headings of the results of axles that decide.
_RATIOS, _SHAFTS = "voltage / breakdown voltage", "voltages of the shafts after an edge"


def _contact(case: Case) -> Side:
    preview = preview_of(case)
    verdict = contact_answers.verdict_by_formula(
        case, preview.summary.get("breakdown_by_formula"), preview.warnings
    )
    decides = contact_answers.deciding(
        contact_answers.deciding_by_formula(case, verdict), verdict, case.electric.voltage
    )
    return Side(
        kind="contact",
        title=case.title,
        verdict=verdict,
        meaning=contact_answers.meaning_of(verdict),
        deciding=decides,
        number=_number(preview.rows, decides.key),
        results=tuple(_results(_outcomes_first(preview.rows))),
        warnings=page_warnings_of(preview.warnings),
        method="films from film-thickness formulas: usually up to 40 % off a solved film",
    )


def _number(rows: Iterable[Row], key: str) -> Number | None:
    """Number of a key; None where no row has it."""
    return next((card(row) for row in rows if key and row.key == key), None)


# Voltages of a bearing that are compared over its speed.
_OVER_SPEED = ("first_break", "shaft_voltage")


def _over_speed(case: BearingCase, summary: Mapping[str, Any]) -> Iterator[OverSpeed]:
    """First breakdown voltage and shaft voltage over the speed; none where no other speed is solved."""
    curves, at = scaled_curves(case, summary), case.bearing.inner_speed
    if curves is None:
        return
    for key in _OVER_SPEED:
        speed, voltage = curves.between(key)
        yield OverSpeed(
            BEARING_BOOK[f"bearing.{key}"].label,
            tuple(rpm(float(value)) for value in speed),
            tuple(float(value) if math.isfinite(value) else None for value in voltage),
            (rpm(at), summary["bearing"][key]),
        )


def _outcomes_first(rows: Iterable[Row]) -> list[Row]:
    """Rows of a contact, with the rows of the breakdown under their own heading before the inputs."""
    rows = list(rows)
    broken = [row for row in rows if row.key.startswith("breakdown_by_formula.")]
    others = [row for row in rows if row not in broken]
    return [Row("breakdown"), *broken, *others] if broken else others


def _results(rows: Iterable[Row]) -> Iterator[Result]:
    """Results of the rows of a table; headings become groups."""
    group = ""
    for row in rows:
        if row.heading:
            group = row.name
        elif row.key not in NOT_COMPARED:
            yield Result(
                group=group,
                name=row.name,
                value=float(row.value) if isinstance(row.value, int | float) else None,
                text=row.shown,
                unit=row.unit,
                note=row.note.lstrip(",;: "),
                bound=row.bound,
                main=any(fnmatchcase(row.key, key) for key in COMPARED),
                key=row.key,
            )


def _over_position(summary: Mapping[str, Any]) -> Iterator[Film]:
    """Minimum films and gaps over the position of the elements."""
    for ring in ("inner", "outer"):
        rows = [row for row in summary["contacts"] if row["ring"] == ring]
        yield Film(
            ring,
            tuple(math.degrees(row["position"]) for row in rows),
            tuple(row["minimum_thickness"] for row in rows),
            tuple(row["load"] for row in rows),
        )
