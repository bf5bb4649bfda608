"""Preview of an axle: its whole answer, with films of the atlas instead of solved films."""

from __future__ import annotations

from ehlectric.axle import solve_axle
from ehlectric.cases.axle_case import AxleCase
from ehlectric.runs.preview import Preview
from ehlectric.tables.axle_tables import axle_rows


def preview(case: AxleCase) -> Preview:
    """Preview of an axle, whose films are not solved."""
    result = solve_axle(case.quick, remedies=False, probable=False)
    summary = result.summary()
    return Preview(case.title, tuple(axle_rows(summary)), summary, result.warnings, result.verdict)
