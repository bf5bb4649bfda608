"""Preview of a contact, with or without motion, before it is solved."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from ehlectric.cases.case import Case
from ehlectric.contact import PreparedContact, breakdown_by_formula, case_summary, minimum_by_formula, prepare
from ehlectric.motion.moving_contact import TransientContact
from ehlectric.quantities.results import CONTACT_BOOK
from ehlectric.quantities.rows import Row, row_of
from ehlectric.runs.preview import Preview
from ehlectric.surfaces.profiles import FLAT
from ehlectric.tables.contact_tables import case_rows
from ehlectric.tables.motion_tables import schedule_rows


def preview(case: Case) -> Preview:
    """Return the preview of a contact: dry contact, groups, and films and breakdown voltage of formulas."""
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
