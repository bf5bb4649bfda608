"""File of a transient run, written while the run is solved and read again to resume it.

The file is closed between two recorded instants, so it is intact when the run stops there. An instant is
written whole or not at all: HDF5 changes a draft of the file in memory, which is then written to the disk.
Maps are stored in single precision.

The time integration uses the films of the last two instants, so a run is resumed from both. The group
"resume" of the file stores them in double precision, alternately in two places. If the run stops while an
instant is written, the other place is still intact. A checksum of each place tells whether it is complete.
"""

from __future__ import annotations

import json
import math
import zlib
from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass
from operator import attrgetter
from pathlib import Path
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.errors import DamagedError, InputError, UnreadableError
from ehlectric.film.newton import State
from ehlectric.film.unsteady import History, Instant
from ehlectric.motion.companion import KeyFilms
from ehlectric.motion.moving_contact import TransientContact
from ehlectric.motion.solver import Snapshot, TransientSolver
from ehlectric.motion.stored import SPOTS, Frame, Maps, Parts, TimeStep, add_touches, lay_out, resized
from ehlectric.runtime.file_rules import UnfitError
from ehlectric.runtime.files import plain
from ehlectric.runtime.netcdf import changed, create, layout_in, opened, values_in
from ehlectric.version import __version__


def time_step(solver: TransientSolver, history: History, coarse: KeyFilms) -> TimeStep:
    """Values of the last time step of a history, with the film thicknesses of the companion there."""
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
    ``coarse``, the films of its last two steps and those of its companion, None where the companion did not
    converge. ``seconds`` is the computing time since the recorded instant before.
    """

    step: int
    rows: Sequence[TimeStep]
    snapshot: Snapshot
    history: History
    coarse: History | None
    seconds: float


class MotionFile:
    """File of a transient run of a contact, to be created or resumed."""

    def __init__(self, path: Path, contact: TransientContact) -> None:
        self._path, self._contact = path, contact
        self._left: tuple[str, int] | None = None

    def create(self, first: Record, attributes: Mapping[str, Any], stationary: Maps | None) -> None:
        """Create the file with the film before the motion, and the maps of stationary roughness.

        These are None where the film of stationary roughness is not converged. Raises an InputError where the
        file cannot be written, as on a full disk.
        """
        self._check(first)
        kind = self._contact.kind
        positions = dict(zip(kind.axes, first.snapshot.film.axes, strict=True))

        def begin(file: Any) -> None:
            lay_out(file, positions, stationary, (first.rows[0], self._frame(first)), kind)
            file.attrs["frames"] = file.attrs["complete"] = 0
            for key, value in attributes.items():
                file.attrs[key] = value
            _make_room(file, first)

        create(self._path, begin, lambda file: self._put(file, first))

    def append(self, record: Record) -> None:
        """Write a recorded instant and the time steps before it.

        Raises an InputError where another run has written to the file, the disk has not enough space, or
        ``load`` would refuse the instant.
        """
        self._check(record)
        with changed(self._path) as draft:
            with values_in(draft) as file:
                if _state(file.attrs) != self._left:
                    raise InputError(
                        self._path, "is being written to by another run", takes="a folder of its own"
                    )
                has_room = _has_room(file, record)
            if not has_room:
                with layout_in(draft) as file:
                    _make_room(file, record)
            with values_in(draft) as file:
                self._put(file, record)

    def _check(self, record: Record) -> None:
        """Check that ``load`` accepts an instant; an error names what it refuses."""
        parts = Parts.of(self._contact.kind)
        try:
            for row in record.rows:
                parts.steps.check(row)
            parts.frames.check(self._frame(record))
        except UnfitError as error:
            kept = "the instants before it are complete" if record.step else "no instant is written"
            raise UnreadableError(
                self._path,
                f"does not get the instant at step {record.step}, as load would refuse it: {error}; {kept}; "
                "please report this fault of ehlectric",
            ) from None

    def _put(self, file: Any, record: Record) -> None:
        """Write an instant into the file, open as ``h5py.File``, which has room for it."""
        frame_values, rows, step, attributes = self._frame(record), record.rows, record.step, file.attrs
        # A half-written instant of an earlier version may follow the complete ones, so the step determines
        # the place to write.
        recorded = file["frame_step"][: _number_in(attributes, "frames")]
        frame = int(np.searchsorted(recorded, step))
        over_steps, over_frames = resized(file, step + 1, frame + 1)
        for name, variable in over_steps.items():
            variable[step + 1 - len(rows) :] = [getattr(row, name) for row in rows]
        for name, variable in over_frames.items():
            variable[frame] = getattr(frame_values, name)
        keep(file, record.history, frame)
        if record.coarse is not None:
            keep(file, record.coarse, frame, group=COARSE)
        attributes.modify("seconds", float(_number_in(attributes, "seconds")) + record.seconds)
        attributes.modify("frames", frame + 1)
        attributes.modify("complete", int(step == self._contact.schedule.steps))
        self._left = _state(attributes)

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

    def whole(self) -> bool:
        """Whether the file exists and contains a complete run of the same case."""
        try:
            with opened(self._path) as file:
                return bool(file.attrs["complete"]) and self._same(file.attrs)
        except (OSError, KeyError, ValueError, RuntimeError):
            return False  # there is no file, or it is damaged or has no run

    def resumed(self) -> tuple[int, History, History | None] | None:
        """Last recorded step of an unfinished run of the same case, and films to resume run and companion.

        None if the file does not exist, or does not contain such a run. A damaged file raises a DamagedError:
        it may have a run of hours, which is not replaced without a word.
        """
        film = self._contact.case.film
        if not self._path.is_file() or (film is not None and film.thermal):
            # The file does not have the heat that the surfaces have met: such a run is solved from its start.
            return None
        try:
            with opened(self._path) as file:
                if file.attrs["complete"] or not self._same(file.attrs):
                    return None
                self._left, frames = _state(file.attrs), int(file.attrs["frames"])
                history = kept(file, frames)
                if history is None:
                    return None
                coarse = kept(file, frames, group=COARSE) if COARSE in file.groups else None
                return int(file.variables["frame_step"][frames - 1]), history, coarse
        except DamagedError as error:
            text = error.text.replace("compute it again", "remove it to solve the case from its start")
            raise DamagedError(self._path, text) from None
        except (OSError, KeyError, ValueError, RuntimeError):
            return None  # the file has no run: the run is solved from the start

    def _same(self, attributes: Mapping[str, Any]) -> bool:
        """Whether the attributes of a file state the same case, the same surfaces and this version."""
        contact = self._contact
        expected = {"case": contact.case.to_toml(), "version": __version__, "rough": described(contact)}
        return all(attributes[name] == value for name, value in expected.items())


def _touch(record: Record) -> bool:
    """Whether surfaces touched at a step of an instant, in the run or in its companion."""
    return any(row.spots > 0 or row.coarse_asperity_load_share > 0.0 for row in record.rows)


def _has_room(file: Any, record: Record) -> bool:
    """Whether a file, open as ``h5py.File``, has all variables of an instant."""
    if _touch(record) and SPOTS not in file:
        return False
    coarse = record.coarse is None or has_place(file, record.coarse, group=COARSE)
    return coarse and has_place(file, record.history)


def _make_room(file: Any, record: Record) -> None:
    """Create the variables of an instant that a file, open as ``h5netcdf.File``, lacks."""
    if _touch(record):
        add_touches(file, record.step + 1 - len(record.rows))
    make_place(file, record.history)
    if record.coarse is not None:
        make_place(file, record.coarse, group=COARSE)


def _number_in(attributes: Any, name: str) -> Any:
    """Number in an attribute, which is an array of one number in a file of HDF5."""
    return np.ravel(attributes[name])[0]


def _state(attributes: Any) -> tuple[str, int]:
    """Date and number of recorded instants of a file; they change if another run writes to it."""
    return str(attributes["date"]), int(_number_in(attributes, "frames"))


def described(contact: TransientContact) -> str:
    """Descriptions of the rough surfaces of a contact, as JSON."""
    return json.dumps(plain([surface.describe() for surface in contact.roughness.surfaces]))


# Attributes of an instant by the names of their variables: values over the mesh, and its time T and rigid
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
_NUMBERS = ("t", "h00")

# Variable over the mesh that a file has from the first instant on whose surfaces touch, after the others.
_TOUCHING = "contact_pressure"

# Number of places that are written alternately.
_PLACES = 2

# Groups with the films of the run and with those of its companion.
_FINE, COARSE = "resume", "resume_coarse"


def has_place(file: Any, history: History, *, group: str = _FINE) -> bool:
    """Whether a file, open as ``h5py.File``, has the variables for the last two instants of a run."""
    return group in file and (_TOUCHING in file[group] or not _touches(history))


def make_place(file: Any, history: History, *, group: str = _FINE) -> None:
    """Create the variables for the last two instants of a run where an ``h5netcdf.File`` lacks them.

    The group is that of the run, or ``COARSE`` for the films of its companion.
    """
    if group not in file.groups:
        created = file.create_group(group)
        nx, ny = history.now.state.pressure.shape
        created.dimensions = {"place": _PLACES, "instant": 2, "along": nx, "across": ny}
        for name in _ATTRIBUTES:
            _add_state(created, name)
        created.create_variable("checksum", ("place",), "i8")
    if _touches(history) and _TOUCHING not in file.groups[group].variables:
        _add_state(file.groups[group], _TOUCHING)


def keep(file: Any, history: History, frame: int, *, group: str = _FINE) -> None:
    """Write the last two instants of a run to the variables of ``make_place`` in an ``h5py.File``.

    The number of the recorded instant determines the place.
    """
    values, variables, place = _values_of(history), file[group], frame % _PLACES
    if _TOUCHING in variables:
        values.setdefault(_TOUCHING, np.zeros_like(values["pressure"]))
    for name, array in values.items():
        variables[name][place] = array
    variables["checksum"][place] = _checksum(values)


def kept(file: Any, frames: int, *, group: str = _FINE) -> History | None:
    """Last two instants of a run in a file, open as ``h5netcdf.File``, by its number of recorded instants.

    None if no instant is recorded, or its place is not complete. A missing variable raises a KeyError.
    """
    variables, place = file.groups[group].variables, (frames - 1) % _PLACES
    values = {name: np.asarray(variables[name][place]) for name in _names(variables)}
    if not frames or _checksum(values) != int(variables["checksum"][place]):
        return None
    return History(now=_instant(values, 0), before=_instant(values, 1))


def _names(known: Container[str]) -> list[str]:
    """Names of the variables of an instant, in the order of the checksum."""
    return [*_ATTRIBUTES, *([_TOUCHING] if _TOUCHING in known else [])]


def _add_state(group: Any, variable: str) -> None:
    over = () if variable in _NUMBERS else ("along", "across")
    group.create_variable(variable, ("place", "instant", *over), _type_of(variable))


def _type_of(name: str) -> str:
    return "i1" if name == "free" else "f8"


def _checksum(values: Mapping[str, Array]) -> int:
    """CRC-32 of the values, in the order and with the types of the file."""
    total = 0
    for name in _names(values):
        total = zlib.crc32(np.ascontiguousarray(values[name], dtype=_type_of(name)).tobytes(), total)
    return total


def _touches(history: History) -> bool:
    """Whether surfaces touch at one of both instants."""
    return any(bool(instant.state.touching.any()) for instant in (history.now, history.before))


def _values_of(history: History) -> dict[str, Array]:
    """Values of both instants by the names of their variables, the last instant first."""
    instants = history.now, history.before
    values = {
        name: np.stack([attrgetter(attribute)(instant) for instant in instants])
        for name, attribute in _ATTRIBUTES.items()
    }
    if _touches(history):
        over = [np.broadcast_to(each.state.contact_pressure, each.mass.shape) for each in instants]
        values[_TOUCHING] = np.stack(over)
    return values


def _instant(values: Mapping[str, Array], k: int) -> Instant:
    touching = values[_TOUCHING][k] if _TOUCHING in values else 0.0
    state = State(values["pressure"][k], float(values["h00"][k]), values["thickness"][k], touching)
    full = values["free"][k].astype(bool)
    return Instant(float(values["t"][k]), state, values["mass"][k], values["density"][k], full)
