"""Journal of a transient run, written while the run is solved and read again to resume it.

An instant is one transaction, so that a kill at any moment loses no instant that was recorded before. The
time integration uses the films of the last two instants, so a run is resumed from both, in double precision.
"""

from __future__ import annotations

import json
import math
import sqlite3
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from operator import attrgetter
from pathlib import Path
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.errors import DamagedError, UnreadableError
from ehlectric.film import History, Instant, State
from ehlectric.motion.coarse_run import KeyFilms
from ehlectric.motion.moving_contact import TransientContact
from ehlectric.motion.solver import Snapshot, TransientSolver
from ehlectric.motion.stored import (
    COARSE,
    FILMS,
    FORM,
    MAPS,
    STILL,
    Frame,
    Maps,
    Parts,
    TimeStep,
    add_arrays,
    add_rows,
    arrays_in,
    attributes_in,
    check_rows,
    layout_of,
    numbers_and_maps,
)
from ehlectric.runtime.file_rules import UnfitError, refusing
from ehlectric.runtime.files import plain, write
from ehlectric.runtime.journal import Journal
from ehlectric.runtime.locks import held_back
from ehlectric.runtime.netcdf import content_of, opened
from ehlectric.runtime.result_names import MOTION, MOTION_JOURNAL
from ehlectric.version import __version__


def time_step(solver: TransientSolver, history: History, coarse: KeyFilms) -> TimeStep:
    """Values of the last time step of a history, with the film thicknesses of the coarse run there."""
    contact, instant = solver.contact, history.now
    extremes, films, touch = solver.extremes(instant), solver.key_films(instant), solver.touch(instant)
    x, *y = np.atleast_1d(extremes.minimum_position).tolist()
    return TimeStep(
        time=instant.time * contact.schedule.time,
        minimum_thickness=extremes.minimum_thickness,
        minimum_x=x,
        minimum_y=y[0] if y else None,
        lowest_thickness=films.lowest,
        central_thickness=films.central,
        coarse_lowest_thickness=coarse.lowest,
        coarse_central_thickness=coarse.central,
        max_pressure=extremes.max_pressure,
        thin_gap_strength=contact.case.electric.voltage / extremes.minimum_thickness,
        newton_iterations=history.effort.newton,
        krylov_iterations=history.effort.krylov,
        halvings=history.effort.halvings,
        asperity_load_share=touch.load_share,
        contact_area_share=touch.area_share,
        spots=touch.spots,
        coarse_asperity_load_share=coarse.load_share,
        meniscus=None if contact.case.inlet is None else solver.meniscus(instant),
        temperature_rise=solver.temperature_rise(instant),
    )


@dataclass(frozen=True)
class Record:
    """Recorded instant ``snapshot``, with the time steps since the recorded instant before it.

    ``rows`` are the values of these steps in order, up to ``step``. A run is resumed from ``history`` and
    ``coarse``, the films of its last two steps and the films of its coarse run, None where the coarse run did
    not converge. ``seconds`` is the computing time since the recorded instant before.
    """

    step: int
    rows: Sequence[TimeStep]
    snapshot: Snapshot
    history: History
    coarse: History | None
    seconds: float


class MotionJournal(Journal):
    """Journal of a transient run of a contact in a folder, to be begun or resumed; a context manager."""

    def __init__(self, folder: Path, contact: TransientContact) -> None:
        with _to_be_removed(folder / MOTION_JOURNAL):
            super().__init__(folder / MOTION_JOURNAL, FORM, check_rows)
        self._contact, self._parts = contact, Parts.of(contact.kind)

    def begin(self, first: Record, attributes: Mapping[str, Any], stationary: Maps | None) -> None:
        """Replace a stored run by the film before the motion, and the maps of stationary roughness.

        These are None where the film of stationary roughness is not converged. Raises an InputError where the
        file cannot be written, as on a full disk.
        """
        self._check(first)
        still = dict(zip(self._contact.kind.axes, first.snapshot.film.axes, strict=True))
        if stationary is not None:
            fields = self._parts.stationary.fields
            still |= {entry.name: getattr(stationary, name) for name, entry in fields.items()}
        steps = {"steps": self._contact.schedule.steps}
        with self.transaction(create=True) as file:
            for table in FORM.columns:
                file.execute(f"DELETE FROM {table}")
            add_rows(file, "run", ((name, json.dumps(v)) for name, v in {**attributes, **steps}.items()))
            add_arrays(file, STILL, 0, still)
            self._add(file, first)

    def append(self, record: Record) -> None:
        """Write a recorded instant and the time steps before it.

        Raises an InputError where the disk has not enough space, or ``load`` would refuse the instant.
        """
        self._check(record)
        with held_back(), self.transaction() as file:
            self._add(file, record)

    def _check(self, record: Record) -> None:
        """Check that ``load`` accepts an instant; an error names what it refuses."""
        try:
            for row in record.rows:
                self._parts.steps.check(row)
            self._parts.frames.check(self._frame(record))
        except UnfitError as error:
            kept = "the instants before it are complete" if record.step else "no instant is written"
            raise UnreadableError(
                self.path.with_name(MOTION),
                f"does not get the instant at step {record.step}, as load would refuse it: {error}; {kept}; "
                "please report this fault of ehlectric",
            ) from None

    def _add(self, file: sqlite3.Connection, record: Record) -> None:
        frame = self._frame(record)
        numbers, maps = numbers_and_maps(self._parts, frame, record.rows)
        text = json.dumps(plain(numbers))
        add_rows(file, "instants", [(record.step, float(frame.frame_time), float(record.seconds), text)])
        add_arrays(file, MAPS, record.step, maps)
        file.execute("DELETE FROM arrays WHERE part IN (?, ?)", (FILMS, COARSE))
        add_arrays(file, FILMS, record.step, _values_of(record.history))
        if record.coarse is not None:
            add_arrays(file, COARSE, record.step, _values_of(record.coarse))

    def _frame(self, record: Record) -> Frame:
        film, field = record.snapshot.film, record.snapshot.field
        x, *y = np.atleast_1d(field.max_strength_position).tolist()
        return Frame(
            pressure=film.pressure,
            thickness=film.thickness,
            strength=self._contact.kind.column_strength(film, field),
            roughness_1=record.snapshot.roughness[0],
            roughness_2=record.snapshot.roughness[1],
            cavitated=film.cavitated,
            film_fraction=film.film_fraction,
            temperature=record.snapshot.temperature,
            frame_time=record.snapshot.time,
            frame_step=record.step,
            max_strength=field.max_strength,
            max_strength_x=x,
            max_strength_y=y[0] if y else None,
            capacitance=field.capacitance,
            max_strength_error=math.nan if field.strength_error is None else field.strength_error,
        )

    def resumed(self) -> tuple[int, History, History | None] | None:
        """Last recorded step of a run of the same case, and films to resume run and coarse run.

        None if the journal is empty, or contains another run.
        """
        if self.empty or is_hot(self._contact):
            # The journal does not have the heat that the surfaces have met: the run is solved from its start.
            return None
        with self.one_line_errors(), refusing(self.path):
            if not is_run_of(self._contact, attributes_in(self.file)):
                return None
            (step,) = self.file.execute("SELECT max(step) FROM instants").fetchone()
            fine, coarse = (arrays_in(self.file, part, step) for part in (FILMS, COARSE))
            return step, _history(fine), _history(coarse) if coarse else None

    def write(self) -> bool:
        """Write motion.nc from the journal; whether the run is complete."""
        with self.one_line_errors():
            with refusing(self.path):
                layout = layout_of(self.file)
            write(self.path.with_name(MOTION), content_of(layout))
        return bool(layout.attributes["complete"])


def is_hot(contact: TransientContact) -> bool:
    """Whether a run has heat, so that it cannot be resumed."""
    return contact.case.film is not None and bool(contact.case.film.thermal)


def is_run_of(contact: TransientContact, attributes: Mapping[str, Any]) -> bool:
    """Whether the attributes of a run state the same case, the same surfaces and this version."""
    expected = {"case": contact.case.to_toml(), "version": __version__, "rough": described(contact)}
    return all(attributes.get(name) == value for name, value in expected.items())


def stored_attributes(path: Path) -> Mapping[str, Any] | None:
    """Attributes of motion.nc; None if the file is missing, or no run can be read from it.

    Raises DamagedError if the file is damaged.
    """
    if not path.is_file():
        return None
    with _to_be_removed(path):
        try:
            with opened(path) as file:
                return {"complete": file.attrs["complete"], **file.attrs}
        except DamagedError:
            raise
        except (OSError, KeyError, ValueError, RuntimeError):
            return None


@contextmanager
def _to_be_removed(path: Path) -> Iterator[None]:
    """Context in which a damaged file is not replaced, as it may be a run of hours: the user must remove it.

    Raises DamagedError with this advice.
    """
    try:
        yield
    except DamagedError as error:
        text = error.text.replace("compute it again", "remove it to solve the case from its start")
        raise DamagedError(path, text) from None


def described(contact: TransientContact) -> str:
    """Descriptions of the rough surfaces of a contact, as JSON."""
    return json.dumps(plain([surface.describe() for surface in contact.roughness.surfaces]))


# Attributes of an instant by the names of their arrays: values over the mesh, and its time T and rigid
# separation H00, which are numbers.
_ATTRIBUTES: Mapping[str, str] = {
    "pressure": "state.pressure",
    "thickness": "state.thickness",
    "mass": "mass",
    "density": "density",
    "free": "full_film",
    "t": "time",
    "h00": "state.h00",
}

# Array of instants whose surfaces touch.
_TOUCHING = "contact_pressure"


def _values_of(history: History) -> dict[str, Array]:
    """Values of both instants by the names of their arrays, the last instant first."""
    instants = history.now, history.before
    values = {
        name: np.stack([attrgetter(attribute)(instant) for instant in instants])
        for name, attribute in _ATTRIBUTES.items()
    }
    if any(bool(instant.state.touching.any()) for instant in instants):
        over = [np.broadcast_to(each.state.contact_pressure, each.mass.shape) for each in instants]
        values[_TOUCHING] = np.stack(over)
    return values


def _history(values: Mapping[str, Array]) -> History:
    return History(now=_instant(values, 0), before=_instant(values, 1))


def _instant(values: Mapping[str, Array], k: int) -> Instant:
    touching = values[_TOUCHING][k] if _TOUCHING in values else 0.0
    state = State(values["pressure"][k], float(values["h00"][k]), values["thickness"][k], touching)
    return Instant(float(values["t"][k]), state, values["mass"][k], values["density"][k], values["free"][k])
