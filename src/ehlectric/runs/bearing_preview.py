"""Preview of a bearing, whose contacts are not solved."""

from __future__ import annotations

from ehlectric.bearing import (
    check_bearing,
    clearances_of,
    error_text,
    quick_case,
    resolve_bearing,
    solve_bearing,
)
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.quantities.rows import Row, RowTexts
from ehlectric.runs.preview import Preview
from ehlectric.tables.bearing_tables import check_rows, input_rows


def preview(case: BearingCase) -> Preview:
    """Return the preview of a bearing: its result with films of the atlas or of a formula."""
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


def _without_films(case: BearingCase, reason: str) -> Preview:
    """Preview of a bearing whose contacts neither the atlas nor a formula describes: only its inputs."""
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
