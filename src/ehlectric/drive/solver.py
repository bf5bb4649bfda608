"""Solver of a drive: its bearings, its circuit, and what happens over time."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ehlectric.bearing import life_summary
from ehlectric.cases.drive_case import DriveCase
from ehlectric.drive.drive_record import DriveSolution
from ehlectric.drive.preparation import prepare
from ehlectric.drive.warnings import bearing_warnings
from ehlectric.quantities.inputs import ENDS
from ehlectric.runtime.files import plain
from ehlectric.runtime.progress import Progress, silent


def solve(case: DriveCase, progress: Progress = silent, *, workers: int | None = None) -> DriveSolution:
    """Solve the bearings of a drive, and simulate it over time; raises the errors of ``prepare``."""
    ready = prepare(case, workers=workers)
    record = ready.network.record(ready.source, max(ready.divider), case.drive.seed, progress)
    return DriveSolution(
        case=case,
        elements=ready.elements,
        # The values of its only shaft are in the record.
        record=replace(record, trace=record.trace[:, : 2 + len(ENDS)], shafts=np.zeros((0, 4))),
        divider=ready.divider,
        highest_source=ready.source.highest,
        converged=all(bearing.converged for bearing in ready.bearings),
        prior_warnings=(*ready.source.prior_warnings, *bearing_warnings(ready.bearings)),
        lives=tuple(plain(life_summary(bearing.solution)) for bearing in ready.bearings),
        bearings=ready.bearings,
    )
