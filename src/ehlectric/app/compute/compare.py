"""Answers about cases that are compared: their results without solving, as the command ``check`` has them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from ehlectric.app.answers.compare import Film, Result, Side
from ehlectric.app.compute.bearing import solved_quickly
from ehlectric.app.compute.bearing_numbers import film_is_bound, speed_bound
from ehlectric.app.compute.bearing_verdict import quick_verdict
from ehlectric.app.compute.cases import case_of
from ehlectric.app.compute.contact import verdict_by_formula
from ehlectric.app.compute.warnings import told_of
from ehlectric.bearing.accuracy import error_text
from ehlectric.bearing.summary import summary_of
from ehlectric.cases.bearings.case import BearingCase
from ehlectric.cases.bearings.ways import HOW, OF_CONTACTS
from ehlectric.cases.case import Case
from ehlectric.quantities.rows import Row
from ehlectric.runs.meaning import check
from ehlectric.tables.bearing import outcome_rows

# Rows of what a person gave, which are among the inputs, and of the computer.
_INPUTS = ("operating conditions", "numerical model")
_LEFT_OUT = ("computing time", "usual difference from a solved film", "accuracy of all that follows")

_SHAFT = "shaft voltage"

# Rows of the breakdown of a contact, by the first words of their names.
_OF_CONTACT = ("breakdown voltage", "margin (breakdown")

# Rows that decide, by the first words of their names.
_MAIN = (
    "capacitance of the bearing",
    "first breakdown voltage",
    "shaft voltage of the first breakdown",
    "margin (first breakdown / shaft voltage)",
    "minimum lambda ratio",
    "minimum film",
    "critical speed",
    "Hertz pressure",
    *_OF_CONTACT,
)

# Rows of films, which are upper bounds where the films are fully flooded, smooth ones.
_FILMS = ("minimum lambda ratio", "minimum film")


def side(table: Mapping[str, Any], folder: Path | None = None) -> Side:
    """Answer about one case, without what depends on further solutions.

    Parameters
    ----------
    table : mapping
        Inputs of the case.
    folder : Path, optional
        Folder of the session.

    Raises
    ------
    InputError
        If the tables are no valid case, or neither the atlas nor a formula describes its films.
    """
    case = case_of(table, folder)
    return _bearing(case, whole=False) if isinstance(case, BearingCase) else _contact(case)


def whole_side(table: Mapping[str, Any], folder: Path | None = None) -> Side:
    """Answer about one case, with the critical speed and the effects of the inputs of a bearing."""
    case = case_of(table, folder)
    return _bearing(case, whole=True) if isinstance(case, BearingCase) else _contact(case)


def _bearing(case: BearingCase, *, whole: bool) -> Side:
    result = solved_quickly(case)
    verdict = result.verdict if whole else quick_verdict(result.solution)
    summary = result.summary() if whole else summary_of(result.solution)
    codes = {warning.code for warning in result.warnings}
    return Side(
        kind="bearing",
        title=case.title,
        level=verdict.level,
        text=verdict.text,
        results=tuple(_results([*_films(summary), *outcome_rows(summary)], _bounds_of(summary, codes))),
        warnings=told_of(result.warnings, verdict.level),
        films=tuple(_over_position(summary)),
        method=f"{OF_CONTACTS[result.case.contacts]}: films may be {error_text(result.solution)} off",
    )


def _contact(case: Case) -> Side:
    meaning = check(case)
    level, text = verdict_by_formula(case, meaning.summary.get("breakdown_by_formula"), meaning.warnings)
    return Side(
        kind="contact",
        title=case.title,
        level=level,
        text=text,
        results=tuple(_results(_outcomes_first(meaning.rows), lambda row: row.bound)),
        warnings=told_of(meaning.warnings),
        method="films by formula: usually up to 40 % off a solved film",
    )


def _outcomes_first(rows: Iterable[Row]) -> list[Row]:
    """Rows of a contact, with those of the breakdown under a heading of their own before the inputs."""
    rows = list(rows)
    broken = [row for row in rows if row.name.startswith(_OF_CONTACT)]
    others = [row for row in rows if row not in broken]
    return [Row("breakdown"), *broken, *others] if broken else others


def _films(summary: Mapping[str, Any]) -> Iterator[Row]:
    """Rows of the most loaded contact and the thinnest film with each ring."""
    yield Row("contacts with the rings")
    for ring in ("inner", "outer"):
        loaded = [row for row in summary["contacts"] if row["ring"] == ring and row["max_pressure"]]
        if loaded:
            yield Row(f"Hertz pressure, {ring} ring", max(row["max_pressure"] for row in loaded), "GPa")
            how = HOW[summary["bearing"]["contacts"]]
            thinnest = min(row["minimum_thickness"] for row in loaded)
            yield Row(f"minimum film, {ring} ring", thinnest, "µm", f", {how}")


def _bounds_of(summary: Mapping[str, Any], codes: set[str]) -> Callable[[Row], str]:
    """Bound of a row of a bearing: its own, or that of a film or a critical speed; empty without one."""
    thinner, leaks = film_is_bound(summary), "shaft-leaks" in codes

    def bound(row: Row) -> str:
        if thinner and row.name.startswith(_FILMS) and isinstance(row.value, int | float):
            return "≤"
        return row.bound or speed_bound(row, summary, leaks=leaks)

    return bound


def _results(rows: Iterable[Row], bound: Callable[[Row], str]) -> Iterator[Result]:
    """Results of the rows of a table; headings become groups."""
    group = ""
    for row in rows:
        if row.heading:
            group = row.name
        elif group not in _INPUTS and row.name not in _LEFT_OUT:
            number = float(row.value) if isinstance(row.value, int | float) else None
            yield Result(
                group=group,
                name=row.name,
                value=number,
                text=row.shown,
                unit=row.unit,
                note=row.note.lstrip(",;: "),
                bound=bound(row),
                main=row.name == _SHAFT or row.name.startswith(_MAIN),
            )


def _over_position(summary: Mapping[str, Any]) -> Iterator[Film]:
    """Minimum films of loaded contacts over the position of their elements."""
    for ring in ("inner", "outer"):
        rows = [row for row in summary["contacts"] if row["ring"] == ring and row["max_pressure"]]
        yield Film(
            ring,
            tuple(math.degrees(row["position"]) for row in rows),
            tuple(row["minimum_thickness"] for row in rows),
        )
