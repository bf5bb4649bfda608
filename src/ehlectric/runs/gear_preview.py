"""Preview of a gear pair: its whole answer, as films of the atlas take no time."""

from __future__ import annotations

from ehlectric.cases.gear_case import GearCase
from ehlectric.gear import solve_gear
from ehlectric.runs.preview import Preview
from ehlectric.tables.gear_tables import gear_rows


def preview(case: GearCase) -> Preview:
    """Preview of a gear pair, whose films are not solved."""
    result = solve_gear(
        case if case.contacts != "solved" else case.replace({"contacts": "atlas"}), probable=False
    )
    summary = result.summary()
    return Preview(case.title, tuple(gear_rows(summary)), summary, result.warnings, result.verdict)
