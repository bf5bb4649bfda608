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
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.contact.memory import check_memory
from ehlectric.contact.problems import domain_of, line_domain_of, spacing, spacings
from ehlectric.contact.remarks import line_remarks as remarks
from ehlectric.contact.remarks import point_remarks
from ehlectric.contact.results import PointResult, Result
from ehlectric.contact.solver import solve
from ehlectric.field.poisson import ATOM
from ehlectric.motion.file import MotionFile, Row, column_strength, described
from ehlectric.motion.motion import Motion
from ehlectric.motion.record import MOTION
from ehlectric.motion.solver import MovingContact
from ehlectric.runtime.files import plain, prepare
from ehlectric.surfaces.remarks import map_surface_remarks as map_remarks
from ehlectric.surfaces.remarks import profile_surface_remarks as rough_remarks
from ehlectric.surfaces.rough_maps import RoughMap
from ehlectric.surfaces.rough_profiles import RoughSurface
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
        "warnings": json.dumps(list(_remarks(motion, still))),
        "stationary": json.dumps(plain(_numbers(still))),
        "rough": described(motion),
        "seconds": 0.0,
    }
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


def _remarks(motion: Motion, still: Result | PointResult) -> Iterator[str]:
    """What to know before using it."""
    case, given = motion.reached, motion.conditions
    if isinstance(given, PointConditions):
        yield from point_remarks(motion.case, given)
        maps = [surface for surface in motion.rough if isinstance(surface, RoughMap)]
        grid = spacings(motion.case, given)
        yield from map_remarks(case.roughness, maps, domain_of(case, given), *grid)
    else:
        assert isinstance(given, Conditions)
        yield from remarks(motion.case, given)
        lines = [surface for surface in motion.rough if isinstance(surface, RoughSurface)]
        yield from rough_remarks(case.roughness, lines, line_domain_of(case, given), spacing(case, given))
    yield from _unlike(motion, still)
    if not still.converged:
        yield f"the same roughness held still is not solved: {still.film.status}"
    elif (error := still.film.discretisation_error) is not None and error > 0.01:
        yield f"held still, the film may be {100.0 * error:.2g} % off on this grid, and moving about as much"


def _unlike(motion: Motion, still: Result | PointResult) -> Iterator[str]:
    """Roughness that is another one held still: made longer, its form and its Rq are of all that is made."""
    if not np.isfinite(motion.coincident):
        return
    film, b = still.film, motion.half_width
    axes = tuple(axis / b for axis in film.axes)
    inside = np.abs(axes[0]) <= 1.0
    away = (motion.heights(motion.coincident, *axes) - still.roughness)[:, inside]
    part = np.max(np.abs(away)) / max(np.max(np.abs(still.roughness[:, inside])), ATOM)
    if part > _ALIKE:
        yield (
            f"the roughness that moves is up to {100.0 * part:.2g} % of its height off that held still: form "
            "and rescale_rq are of all that moves through the contact, which is longer"
        )
