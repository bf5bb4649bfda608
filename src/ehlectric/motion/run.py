"""Run a contact whose roughness moves into its file, and go on with a run that was stopped."""

from __future__ import annotations

import json
import math
import time
from collections.abc import Callable, Iterator
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.case import Case
from ehlectric.contact.case_warnings import line_case_warnings, point_case_warnings
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.contact.memory import check_memory
from ehlectric.contact.problems import domain_of, line_domain_of, spacing, spacings
from ehlectric.contact.results import PointResult, Result
from ehlectric.contact.solver import solve
from ehlectric.errors import ResultWarning
from ehlectric.field.poisson import ATOM
from ehlectric.film.point import PointFilm
from ehlectric.motion.file import MotionFile, Row, column_strength, described
from ehlectric.motion.motion import Motion
from ehlectric.motion.record import MOTION
from ehlectric.motion.solver import MovingContact
from ehlectric.runtime.files import plain, prepare
from ehlectric.runtime.stored_warnings import as_attributes
from ehlectric.surfaces.rough_maps import RoughMap
from ehlectric.surfaces.rough_profiles import RoughSurface
from ehlectric.surfaces.warnings import map_surface_warnings, profile_surface_warnings
from ehlectric.version import __version__

# Part of its height by which roughness that moves may differ from that held still, without a word.
_ALIKE = 1e-3

# Called with the steps done, all of them, and what is being done.
Progress = Callable[[int, int, str], None]


def _quiet(_done: int, _of: int, _text: str) -> None:
    pass


def run_motion(case: Case, folder: str | Path, *, again: bool = True, progress: Progress = _quiet) -> Path:
    """Solve a contact whose roughness moves, and write it as it goes.

    Parameters
    ----------
    case : Case
        With ``motion``.
    folder : str or Path
        Where motion.nc goes; made if it is not there. An unfinished run of the same case there is gone on
        with from the last instant that was kept; anything else there is replaced.
    again : bool
        Solve anew what is there whole.
    progress : callable, optional
        Called with the steps done, all of them, and what is being done.

    Returns
    -------
    Path
        The file, which ``read_motion`` reads.

    Raises
    ------
    InputError
        Where the case or the folder cannot be used.
    ConvergenceError
        Where a step is not solved; the file has what was found before.
    """
    motion = Motion(case)
    check_memory(case)
    path = prepare(folder, (MOTION,)) / MOTION
    contact = MovingContact(motion)
    file = MotionFile(path, contact)
    if not again and file.whole():
        return path
    found = file.resumed()
    if found is None:
        path.unlink(missing_ok=True)
        progress(0, motion.course.steps, "before the motion")
        _begin(file, contact)
        found = file.resumed()
        assert found is not None
    done, history = found
    progress(done, motion.course.steps, "in time")
    started, rows = time.perf_counter(), list[Row]()
    recorded = set(motion.course.recorded.tolist())
    for step, latest in contact.run(history, done):
        rows.append(Row.of(contact, latest))
        if step in recorded:
            snapshot = contact.snapshot(latest.now)
            since, started = started, time.perf_counter()
            file.append(rows, step, snapshot, latest, started - since)
            rows = []
            progress(step, motion.course.steps, "in time")
    return path


def _begin(file: MotionFile, contact: MovingContact) -> None:
    """The film before the motion as the first instant, beside the roughness held still."""
    motion, started = contact.motion, time.perf_counter()
    still = solve(motion.case.replace(motion=None), beside_smooth=False)
    history = contact.start()
    first = contact.snapshot(history.now)
    attributes = {
        "title": motion.case.title,
        "case": motion.case.to_toml(),
        "version": __version__,
        "date": datetime.now(UTC).isoformat(timespec="seconds"),
        "stationary": json.dumps(plain(_numbers(still))),
        "rough": described(motion),
        "seconds": 0.0,
    }
    attributes |= as_attributes(_warnings(motion, still))
    file.create(first, attributes | _moments(motion), _maps(still))
    file.append([Row.of(contact, history)], 0, first, history, time.perf_counter() - started)


def _moments(motion: Motion) -> dict[str, float]:
    """Times that figures mark [s], those that come."""
    moments = {"covered_from": motion.covered, "coincident": motion.coincident}
    return {name: time * motion.course.time for name, time in moments.items() if math.isfinite(time)}


def _maps(still: Result | PointResult) -> dict[str, Array]:
    """Film and field of the roughness held still; nothing where it was not solved."""
    if not still.converged:
        return {}
    film = still.film
    strength = column_strength(film, still.field)
    return {"pressure": film.pressure, "thickness": film.thickness, "strength": strength}


def _numbers(still: Result | PointResult) -> dict[str, Any] | None:
    if not still.converged:
        return None
    return {
        "minimum_thickness": still.film.minimum_thickness,
        "minimum_position": still.film.minimum_position,
        "max_pressure": still.film.max_pressure,
        "max_strength": still.field.max_strength,
        "capacitance": still.field.capacitance,
        "discretisation_error": still.film.discretisation_error,
    }


def _warnings(motion: Motion, still: Result | PointResult) -> Iterator[ResultWarning]:
    """Warnings of a run that are known before its first step."""
    case, given = motion.reached, motion.conditions
    if isinstance(given, PointConditions):
        yield from point_case_warnings(motion.case, given)
        maps = [surface for surface in motion.rough if isinstance(surface, RoughMap)]
        grid = spacings(motion.case, given)
        yield from map_surface_warnings(case.roughness, maps, domain_of(case, given), *grid)
    else:
        assert isinstance(given, Conditions)
        yield from line_case_warnings(motion.case, given)
        lines = [surface for surface in motion.rough if isinstance(surface, RoughSurface)]
        yield from profile_surface_warnings(
            case.roughness, lines, line_domain_of(case, given), spacing(case, given)
        )
    yield from _unlike(motion, still)
    if not still.converged:
        text = f"the same roughness held still is not solved: {still.film.status}"
        yield ResultWarning("stationary-not-converged", text)
    elif (error := still.film.discretisation_error) is not None and error > 0.01:
        text = f"held still, the film may be {100.0 * error:.2g} % off on this grid, and moving about as much"
        yield ResultWarning("stationary-error", text)


def _unlike(motion: Motion, still: Result | PointResult) -> Iterator[ResultWarning]:
    """Warning of moving roughness unlike the stationary one, whose form and Rq are of a shorter surface."""
    if not np.isfinite(motion.coincident):
        return
    film, b = still.film, motion.half_width
    axes = (film.x / b, film.y / b) if isinstance(film, PointFilm) else (film.x / b,)
    inside = np.abs(axes[0]) <= 1.0
    away = (motion.heights(motion.coincident, *axes) - still.roughness)[:, inside]
    part = np.max(np.abs(away)) / max(np.max(np.abs(still.roughness[:, inside])), ATOM)
    if part > _ALIKE:
        yield ResultWarning(
            "stationary-differs",
            f"the roughness that moves is up to {100.0 * part:.2g} % of its height off that held still: form "
            "and rescale_rq are of all that moves through the contact, which is longer",
        )
