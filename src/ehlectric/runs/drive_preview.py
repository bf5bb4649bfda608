"""Preview of a drive, which is not simulated, and whose contacts are not solved."""

from __future__ import annotations

from ehlectric.bearing import check_bearing
from ehlectric.cases.drive_case import ENDS, DriveCase
from ehlectric.drive import (
    bearing_warnings,
    checked_summary,
    machine_warnings,
    of_end,
    prepare,
    quick_drive,
)
from ehlectric.quantities.rows import Row
from ehlectric.runs.preview import Preview
from ehlectric.tables.drive_tables import prepared_rows


def preview(case: DriveCase) -> Preview:
    """Return the preview of a drive, whose bearings have films of the atlas or of a formula."""
    case.variants()
    for end, bearing in zip(ENDS, case.bearings, strict=True):
        with of_end(case, end):
            check_bearing(bearing)
    quick, key = quick_drive(case)
    if quick is None:
        row = Row("films and voltages", note=f"{key}: needs solved contacts; ehlectric drive solves them")
        return Preview(case.title, (row,), {"inputs": case.to_dict(), "films": None}, ())
    ready = prepare(quick, workers=1)
    summary = {**checked_summary(ready), "inputs": case.all_inputs()}
    warnings = (
        *ready.source.prior_warnings,
        *bearing_warnings(ready.bearings),
        *machine_warnings(case, ready.elements),
    )
    return Preview(case.title, tuple(prepared_rows(summary)), summary, warnings)
