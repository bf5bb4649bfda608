"""File of a transient run, written while the run is solved and read again to resume it.

The file is closed between two recorded instants, so it is intact when the run stops there. An instant is
written whole or not at all: HDF5 changes a draft of the file in memory, which is then written to the disk.
The films from which a run is resumed are stored twice (see ``ehlectric.motion.resume``). Maps are stored in
single precision. The films from which a run is resumed are stored in double precision.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.errors import DamagedError, InputError
from ehlectric.film.unsteady import History
from ehlectric.motion.asperities import AREA_SHARE, COARSE_SHARE, LOAD_SHARE, SPOTS
from ehlectric.motion.companion import KeyFilms
from ehlectric.motion.contact import TransientContact
from ehlectric.motion.layout import MENISCUS, add_touches, lay_out, lay_out_supplied, resized
from ehlectric.motion.resume import COARSE, has_place, keep, kept, make_place
from ehlectric.motion.solver import Snapshot, TransientSolver
from ehlectric.runtime.files import plain
from ehlectric.runtime.netcdf import changed, create, layout_in, opened, values_in
from ehlectric.version import __version__


@dataclass(frozen=True)
class Row:
    """Values of a time step, keyed by the names of the variables in the file, in SI units."""

    values: Mapping[str, float]

    @classmethod
    def of(cls, solver: TransientSolver, history: History, coarse: KeyFilms) -> Row:
        """Values of the last time step of a history, with the film thicknesses of the companion there."""
        contact, instant = solver.contact, history.now
        extremes, films = solver.extremes(instant), solver.key_films(instant)
        touch = solver.touch(instant)
        values: dict[str, float] = {
            "time": instant.time * contact.schedule.time,
            "minimum_thickness": extremes.minimum_thickness,
            "lowest_thickness": films.lowest,
            "central_thickness": films.central,
            "coarse_lowest_thickness": coarse.lowest,
            "coarse_central_thickness": coarse.central,
            "max_pressure": extremes.max_pressure,
            "thin_gap_strength": contact.case.electric.voltage / extremes.minimum_thickness,
            "newton_iterations": history.effort.newton,
            "krylov_iterations": history.effort.krylov,
            "halvings": history.effort.halvings,
            LOAD_SHARE: touch.load_share,
            AREA_SHARE: touch.area_share,
            SPOTS: touch.spots,
            COARSE_SHARE: coarse.load_share,
            MENISCUS: solver.meniscus(instant),
        }
        return cls(values | _place("minimum", extremes.minimum_position))


@dataclass(frozen=True)
class Record:
    """A recorded instant with the time steps since the recorded instant before it.

    Attributes
    ----------
    step : int
        Number of the time step.
    rows : sequence of Row
        Values of the time steps since the last recorded instant, in order, up to this step.
    snapshot : Snapshot
        Film, roughness and field.
    history : History
        Films of the last two time steps, from which the run can be resumed.
    coarse : History or None
        Films of the last two time steps of the companion; None if it did not converge.
    seconds : float
        Computing time since the last recorded instant [s].
    """

    step: int
    rows: Sequence[Row]
    snapshot: Snapshot
    history: History
    coarse: History | None
    seconds: float


def _place(name: str, place: float | tuple[float, ...]) -> dict[str, float]:
    """Position along each axis, by the name of its variable in the file."""
    return {f"{name}_{axis}": at for axis, at in zip("xy", np.atleast_1d(place).tolist(), strict=False)}


class MotionFile:
    """File of a transient run, to be created or resumed.

    Parameters
    ----------
    path : Path
        Path of the file.
    contact : TransientContact
        Contact of the run.
    """

    def __init__(self, path: Path, contact: TransientContact) -> None:
        self._path, self._contact = path, contact
        self._left: tuple[str, int] | None = None

    def create(self, first: Record, attributes: Mapping[str, Any], stationary: Mapping[str, Array]) -> None:
        """Create the file with its first recorded instant.

        Parameters
        ----------
        first : Record
            Film before the motion.
        attributes : mapping of str to str or float
            Attributes of the file.
        stationary : mapping of str to ndarray
            Maps of film and field with stationary roughness, by names such as ``pressure``.

        Raises
        ------
        InputError
            If the file cannot be written, as on a full disk.
        """
        positions = dict(zip(self._contact.kind.axes, first.snapshot.film.axes, strict=True))

        def begin(file: Any) -> None:
            lay_out(file, positions, stationary, self._contact.kind)
            if self._contact.case.inlet is not None:
                starved = first.snapshot.film.film_fraction is not None
                lay_out_supplied(file, tuple(positions), starved=starved)
            file.attrs["frames"] = file.attrs["complete"] = 0
            for key, value in attributes.items():
                file.attrs[key] = value
            _make_room(file, first)

        create(self._path, begin, lambda file: self._put(file, first))

    def append(self, record: Record) -> None:
        """Write a recorded instant and the time steps before it.

        Raises
        ------
        InputError
            If another run has written to the file, or the disk has not enough space.
        """
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

    def _put(self, file: Any, record: Record) -> None:
        """Write an instant into the file, open as ``h5py.File``, which has room for it."""
        maps, numbers = self._maps(record.snapshot), _numbers(record)
        rows, step, attributes = record.rows, record.step, file.attrs
        # A half-written instant of an earlier version may follow the complete ones, so the step determines
        # the place to write.
        recorded = file["frame_step"][: _number_in(attributes, "frames")]
        frame = int(np.searchsorted(recorded, step))
        over_steps, over_frames = resized(file, step + 1, frame + 1)
        for name, variable in over_steps.items():
            variable[step + 1 - len(rows) :] = [row.values[name] for row in rows]
        for name, value in (*maps.items(), *numbers.items()):
            over_frames[name][frame] = value
        keep(file, record.history, frame)
        if record.coarse is not None:
            keep(file, record.coarse, frame, group=COARSE)
        attributes.modify("seconds", float(_number_in(attributes, "seconds")) + record.seconds)
        attributes.modify("frames", frame + 1)
        attributes.modify("complete", int(step == self._contact.schedule.steps))
        self._left = _state(attributes)

    def _maps(self, snapshot: Snapshot) -> dict[str, Array]:
        film, field = snapshot.film, snapshot.field
        content = {} if film.film_fraction is None else {"film_fraction": film.film_fraction}
        return content | {
            "pressure": film.pressure,
            "thickness": film.thickness,
            "strength": self._contact.kind.column_strength(film, field),
            "roughness_1": snapshot.roughness[0],
            "roughness_2": snapshot.roughness[1],
            "cavitated": film.cavitated,
        }

    def whole(self) -> bool:
        """Whether the file exists and contains a complete run of the same case."""
        try:
            with opened(self._path) as file:
                return bool(file.attrs["complete"]) and self._same(file.attrs)
        except (OSError, KeyError, ValueError, RuntimeError):
            return False  # there is no file, or it is damaged or has no run

    def resumed(self) -> tuple[int, History, History | None] | None:
        """Last recorded step of an unfinished run of the same case, and the films to resume it from.

        The last films are those of the companion; None if the file does not have them.

        None if the file does not exist, or does not contain such a run.

        Raises
        ------
        DamagedError
            Where the file is damaged: it may have a run of hours, which is not replaced without a word.
        """
        if not self._path.is_file():
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


def _numbers(record: Record) -> dict[str, float]:
    """Values of a recorded instant other than maps, by the names of their variables."""
    field = record.snapshot.field
    return {
        "frame_time": record.snapshot.time,
        "frame_step": record.step,
        "max_strength": field.max_strength,
        "capacitance": field.capacitance,
        "max_strength_error": math.nan if field.strength_error is None else field.strength_error,
    } | _place("max_strength", field.max_strength_position)


def _touch(record: Record) -> bool:
    """Whether surfaces touched at a step of an instant, in the run or in its companion."""
    return any(row.values[name] > 0.0 for row in record.rows for name in (SPOTS, COARSE_SHARE))


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
