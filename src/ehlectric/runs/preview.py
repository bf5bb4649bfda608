"""Preview of a file before it is solved: dry contact, films and voltages from formulas, size of a sweep.

Nothing here solves a film, so that the answer is there at once. Films from formulas, and what follows from
them, may be far from the solution; every row and every table with them states it.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import singledispatch
from itertools import islice
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.case import Case
from ehlectric.cases.defaults import HOW, QUICK
from ehlectric.cases.drive_case import DriveCase
from ehlectric.errors import InputError
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.quantities.results import CONTACT_BOOK
from ehlectric.quantities.rows import Row, RowTexts, row_of
from ehlectric.readable import readable
from ehlectric.runtime.display import headline
from ehlectric.sweep import Sweep

if TYPE_CHECKING:
    from ehlectric.contact import PreparedContact
    from ehlectric.quantities.verdict import Verdict
    from ehlectric.sweep import Planned

# Largest number of points of a sweep that are checked one by one.
_MOST_CHECKED = 2000


@dataclass(frozen=True, repr=False)
class Preview:
    """Preview of a file before it is solved."""

    title: str
    rows: tuple[Row, ...]  # rows of a table: dry contact, films from formulas and what follows from them
    summary: dict[str, Any]  # the same numbers as nested tables, SI units
    warnings: tuple[ResultWarning, ...]  # warnings about the case and its surfaces
    # Whether the film of a bearing breaks down, from formulas; None for other files and without a strength.
    verdict: Verdict | None = None

    def __repr__(self) -> str:
        counts = f"{len(self.rows)} rows", f"{len(self.warnings)} warnings"
        return f"<Preview {headline(self.title, *counts, verdict=self.verdict)}>"


@singledispatch
def preview_of(case: Case | BearingCase | DriveCase | Sweep) -> Preview:
    """Preview of a case or of a sweep, at once: dry contact, groups, and what film formulas predict. Returns
    rows of a table, the same numbers as nested tables, and warnings. Raises InputError if the values
    contradict each other, a surface cannot be used, the grid fits into no memory or no point of a sweep is a
    valid case.

    Examples
    --------
    >>> from ehlectric import Case
    >>> contact = {"geometry": "point", "radius_x": 0.01, "radius_y": 0.01, "load": "20 N"}
    >>> contact |= {"reduced_modulus": "226 GPa", "entrainment_speed": 2.0}
    >>> preview = preview_of(Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}}))
    >>> round(preview.summary["hertz"]["max_pressure"] / 1e9, 3)
    0.791
    """
    raise TypeError(f"{type(case).__name__} is no case")


@preview_of.register
def _preview_contact(case: Case) -> Preview:
    from ehlectric.contact import breakdown_by_formula, case_summary, prepare
    from ehlectric.motion.moving_contact import TransientContact
    from ehlectric.tables.contact_tables import case_rows
    from ehlectric.tables.motion_tables import schedule_rows

    contact = prepare(case)
    summary = case_summary(case, contact.conditions)
    rows = case_rows(case, summary)
    estimate = breakdown_by_formula(case, contact.conditions)
    if estimate is not None:
        summary["breakdown_by_formula"] = estimate
        rows += _breakdown_rows(estimate)
    lambda_ratio = _lambda_by_formula(contact, case)
    if lambda_ratio is not None:
        summary["lambda_by_formula"] = lambda_ratio
        rows += _lambda_rows(
            lambda_ratio, ", in the Hertzian zone, undeformed" if contact.rough else ", as given"
        )
    if case.motion is not None:
        summary["motion"] = TransientContact.of(case, contact.rough).schedule.described()
        rows += schedule_rows(summary)
    return Preview(case.title, tuple(rows), summary, tuple(contact.warnings()))


def _lambda_by_formula(contact: PreparedContact, case: Case) -> dict[str, Any] | None:
    """Minimum film of smooth surfaces by a formula, divided by the undeformed composite Rq; None without a
    stated roughness. It is the Rq of the rough surfaces, or ``meter.rq``.
    """
    from ehlectric.contact import minimum_by_formula
    from ehlectric.surfaces.profiles import FLAT

    rq = contact.composite_roughness()
    if rq is None and case.meter is not None:
        rq = case.meter.rq
    if rq is None or rq < FLAT:
        return None
    minimum = minimum_by_formula(contact.conditions)
    film = minimum["minimum_thickness"]
    return None if film is None else {**minimum, "rq": rq, "lambda_ratio": film / rq}


def _lambda_rows(estimate: Mapping[str, Any], where: str) -> Iterator[Row]:
    ratio, reason = estimate["lambda_ratio"], estimate["outside_range"]
    yield _row("lambda_by_formula.rq", estimate["rq"], where)
    likely = "likely" if ratio < 1.0 else "possible" if ratio < 3.0 else "rare"
    formula = f"{estimate['formula']}, outside its range: {reason}" if reason else estimate["formula"]
    note = f", minimum film ({formula}) / combined Rq: asperity contact is {likely}"
    yield _row("lambda_by_formula.lambda_ratio", ratio, note)


def _breakdown_rows(estimate: Mapping[str, Any]) -> Iterator[Row]:
    reason = estimate["outside_range"]
    error = f"outside its range: {reason}" if reason else "up to 40 % off"
    about = f", film from {estimate['formula']}, {error}; isothermal, fully flooded film"
    yield _row("breakdown_by_formula.breakdown_voltage", estimate["breakdown_voltage"], about)
    if estimate["margin"] is not None:
        yield _row(
            "breakdown_by_formula.margin", estimate["margin"], f", from the film-thickness formula: {error}"
        )


def _row(key: str, value: float, note: str) -> Row:
    """Row of a number from a formula for smooth surfaces; breakdown is an upper bound then."""
    about = CONTACT_BOOK["point"][key]
    return row_of(key, about, value, note, bound=about.bound)


@preview_of.register
def _preview_bearing(case: BearingCase) -> Preview:
    from ehlectric.bearing import check_bearing, error_text, quick_case, solve_bearing
    from ehlectric.tables.bearing_tables import check_rows

    check_bearing(case)
    judged, refused = quick_case(case)
    if judged is None:
        reason = (
            "the atlas and film-thickness formulas need a piezoviscous oil; "
            "ehlectric bearing solves the contacts"
        )
        return _without_films(case, reason)
    # The file of a duty cycle is checked; it is computed by ehlectric bearing.
    result = solve_bearing(judged.model_copy(update={"duty": None}), workers=1)
    summary = {**result.summary(), "inputs": case.all_inputs(), "films": judged.contacts}
    heat = (
        ", heat by the formula of film_factor 'inlet-shear'" if case.bearing.film_factor == "solved" else ""
    )
    accuracy = f"{heat}: films may be {error_text(result.solution)} off"
    words = RowTexts(notes={"bearing.contacts": lambda _: accuracy})
    if refused is not None:
        words |= RowTexts(
            values={"bearing.first_break": lambda _: "not computed"},
            notes={"bearing.first_break": lambda _: ", needs solved contacts for this strength"},
        )
    rows = check_rows(summary, words)
    if case.duty is not None:
        rows.append(
            Row(
                "duty cycle",
                note="the file is checked; ehlectric bearing computes its films, margins and life",
            )
        )
    return Preview(case.title, tuple(rows), summary, result.all_warnings, result.verdict)


@preview_of.register
def _preview_drive(case: DriveCase) -> Preview:
    from ehlectric.drive import bearing_warnings, checked_summary, machine_warnings, prepare, quick_drive
    from ehlectric.tables.drive_tables import prepared_rows

    case.variants()
    quick, key = quick_drive(case)
    if quick is None:
        row = Row("films and voltages", note=f"{key}: needs solved contacts; ehlectric drive solves them")
        return Preview(case.title, (row,), {"inputs": case.to_dict(), "films": None}, ())
    ready = prepare(quick, workers=1)
    summary = {**checked_summary(ready), "inputs": case.all_inputs()}
    warnings = (
        *ready.prior_warnings,
        *bearing_warnings(ready.bearings),
        *machine_warnings(case, ready.elements),
    )
    return Preview(case.title, tuple(prepared_rows(summary)), summary, warnings)


def _without_films(case: BearingCase, reason: str) -> Preview:
    """Preview of a bearing whose contacts neither the atlas nor a formula describes: only its inputs."""
    from ehlectric.bearing import clearances_of, resolve_bearing
    from ehlectric.tables.bearing_tables import input_rows

    conditions = resolve_bearing(case)
    summary = {
        "inputs": case.all_inputs(),
        "lubricant": {
            "temperature": case.bearing.oil_temperature,
            "viscosity": conditions.oil.viscosity,
        },
        "bearing": clearances_of(conditions),
        "films": None,
    }
    rows = (*input_rows(summary), Row("films and voltages", note=reason))
    return Preview(case.title, rows, summary, ())


@preview_of.register
def _preview_sweep(sweep: Sweep) -> Preview:
    from ehlectric.sweep import lacking_point, plan

    started = time.perf_counter()
    planned = list(islice(plan(sweep), _MOST_CHECKED))
    first = next((point for point in planned if point.key is not None), None)
    if first is None:
        raise InputError("vary", f"no point is a case; of the first, {planned[0].refused}")
    each = (time.perf_counter() - started) / len(planned)
    begun = time.perf_counter()
    preview = preview_of(sweep.case.replace(first.inputs))
    seconds = time.perf_counter() - begun + each
    described = _described(sweep, planned, first)
    lacking = lacking_point(sweep, planned)
    described["lacking"] = None if lacking is None else str(lacking)
    rows = (*_sweep_rows(sweep, described, seconds), Row("first point:"), *preview.rows)
    summary = {"sweep": described, "first_point": preview.summary}
    return replace(preview, title=sweep.title or preview.title, rows=rows, summary=summary, verdict=None)


def _described(sweep: Sweep, planned: list[Planned], first: Planned) -> dict[str, Any]:
    """Size and inputs of a sweep as a table, and how many of its points are refused."""
    refused = [point.refused for point in planned if point.key is None]
    return {
        "points": sweep.size,
        "design": sweep.design,
        "inputs": {key: _values(value) for key, value in sweep.vary.items()},
        "points_checked": len(planned),
        "points_refused": len(refused),
        "reason": refused[0] if refused else None,
        "first_point": {"number": first.number, "inputs": dict(first.inputs)},
    }


def _values(value: Any) -> dict[str, Any]:
    """Values of a varied key: the ends of its range, or the number of values with first and last."""
    if isinstance(value, tuple):
        return {"values": len(value), "first": value[0], "last": value[-1]}
    return {"from": value.start, "to": value.stop, "spacing": value.spacing}


def _sweep_rows(sweep: Sweep, described: Mapping[str, Any], seconds: float) -> Iterator[Row]:
    from ehlectric.runtime.worker_processes import cores

    yield Row("points", str(sweep.size), note=f"{sweep.design} design")
    for key, value in described["inputs"].items():
        yield Row(f"  {key}", *_shown(key, value, sweep))
    if described["points_refused"]:
        refused = f"of {described['points_checked']} checked points are no valid case: {described['reason']}"
        yield Row("  refused", str(described["points_refused"]), note=refused, alarm=True)
    if described["lacking"] is not None:
        yield Row("  points fail", note=described["lacking"], alarm=True)
    if isinstance(sweep.case, BearingCase) and sweep.case.contacts in QUICK:
        whole = sweep.size * seconds / cores()
        yield Row(
            "time, estimated", whole, "s", f", {HOW[sweep.case.contacts]} on {cores()} cores", digits=".2g"
        )
    else:
        command = _COMMANDS.get(type(sweep.case), "run")
        note = f"that of {sweep.size} times ehlectric {command}, divided by {cores()} cores"
        yield Row("time", note=note)


# Commands that solve base cases other than contacts.
_COMMANDS = {BearingCase: "bearing", DriveCase: "drive"}


def _shown(key: str, value: Mapping[str, Any], sweep: Sweep) -> tuple[str, str, str]:
    """Value, unit and note of the row of a varied key."""
    ends = [value["from"], value["to"]] if "from" in value else [value["first"], value["last"]]
    texts, unit = _in_units(key, ends, sweep)
    if "from" in value:
        note = ", spaced by logarithms" if value["spacing"] == "log" else ""
    else:
        note = f" in {value['values']} values" if value["values"] > 1 else ""
    return " to ".join(dict.fromkeys(texts)), unit, note


def _in_units(key: str, values: list[Any], sweep: Sweep) -> tuple[list[str], str]:
    """Values as texts in the unit that an engineer uses; other values than numbers as they are."""
    from ehlectric.sweep import label_of

    if not all(isinstance(value, float) for value in values):
        return [str(value) for value in values], ""
    scale = label_of(key, sweep.case).scaled(np.array(values))
    return [readable(scale.of(value), 4) for value in values], scale.unit
