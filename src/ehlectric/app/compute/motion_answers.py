"""Runs of contacts with moving roughness, as a movie and a curve over time."""

from __future__ import annotations

import hashlib
import shutil
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ehlectric.app.charts.motion_charts import history, instants, least_films, movie, texts, units
from ehlectric.app.compute.answer_parts import case_of, page_warnings_of
from ehlectric.app.view_models import MotionAnswer
from ehlectric.cases.case import Case
from ehlectric.errors import InputError
from ehlectric.motion.result import MotionResult
from ehlectric.motion.stored_run import is_stored, read_motion
from ehlectric.quantities.result_warnings import warnings_of
from ehlectric.runs.by_kind import run_motion
from ehlectric.runtime.progress import Progress
from ehlectric.tables.motion_tables import run_rows

_PREFIX = "motion-"


def run(table: Mapping[str, Any], folder: str, progress: Progress) -> MotionAnswer:
    """Solve a contact with moving roughness into a folder of the session, as the command does.

    A run of the same inputs that was cancelled is resumed. Runs of other inputs in the folder are removed.

    Raises InputError if the tables are no valid case, or have no motion; ConvergenceError if the film before
    the motion does not converge.
    """
    case = _case(table, folder)
    place = _place(case, folder)
    for other in Path(folder).glob(f"{_PREFIX}*"):
        if other != place:
            shutil.rmtree(other, ignore_errors=True)
    outcome = run_motion(case, place, progress)
    return _answer(place, outcome.failure or "")


def stored(table: Mapping[str, Any], folder: str) -> MotionAnswer | None:
    """Solved part of the motion of a case, such as of a run that was cancelled; None where there is none."""
    place = _place(_case(table, folder), folder)
    return _answer(place, "") if is_stored(place) else None


def _case(table: Mapping[str, Any], folder: str) -> Case:
    case = case_of(table, Path(folder))
    if not isinstance(case, Case) or case.motion is None:
        raise InputError.missing("motion", "a table with the time that the roughness moves")
    return case


def _place(case: Case, folder: str) -> Path:
    """Folder of the run of a case; a run of other inputs has another one."""
    return Path(folder) / f"{_PREFIX}{hashlib.sha256(case.to_toml().encode()).hexdigest()[:16]}"


def _answer(place: Path, failure: str) -> MotionAnswer:
    dataset = read_motion(place)
    result = MotionResult.of(dataset)
    chosen = instants(result)
    summary = result.summary()
    return MotionAnswer(
        title=result.case.title,
        complete=result.complete,
        failure=failure,
        of=result.frames,
        movie=movie(result, chosen),
        history=history(result),
        times=tuple((units(result)["time"][0] * result.frame_time[chosen]).tolist()),
        texts=tuple(texts(result, chosen)),
        at_least_film=int(np.argmin(least_films(result)[chosen])),
        at_largest_field=int(np.argmax(result.values("max_strength")[chosen])),
        rows=tuple((row.name, row.text) for row in run_rows(summary)),
        warnings=page_warnings_of(warnings_of(summary)),
        folder=str(place),
    )
