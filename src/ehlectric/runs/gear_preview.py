"""Preview of a gear pair: its whole answer, as films of the atlas take no time."""

from __future__ import annotations

from ehlectric.cases.gear_case import GearCase
from ehlectric.gear import check_mesh_duty, solve_gear
from ehlectric.quantities.rows import Row
from ehlectric.runs.preview import Preview
from ehlectric.tables.gear_tables import gear_rows


def preview(case: GearCase) -> Preview:
    """Preview of a gear pair, whose films are not solved."""
    check_mesh_duty(case)
    judged = case.model_copy(update={"duty": None})
    result = solve_gear(judged if case.contacts != "solved" else judged.replace({"contacts": "atlas"}))
    summary = {**result.summary(), "inputs": case.to_dict()}
    rows = gear_rows(summary)
    if case.duty is not None:
        note = "the file is checked; ehlectric gear computes its films, margins and losses"
        rows.append(Row("duty cycle", note=note))
    return Preview(case.title, tuple(rows), summary, result.warnings, result.verdict)
