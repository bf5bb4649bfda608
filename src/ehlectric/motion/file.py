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
from ehlectric.motion.kinds import AnyKind
from ehlectric.motion.resume import COARSE, keep, kept
from ehlectric.motion.solver import Snapshot, TransientSolver
from ehlectric.runtime.files import plain
from ehlectric.runtime.netcdf import changed, create, opened, resize
from ehlectric.version import __version__

# Variables by name, each with its long name and unit: over all time steps, over the recorded instants, and
# maps at the recorded instants.
_STEPS = {
    "time": ("time since the roughness began to enter", "s"),
    "minimum_thickness": ("minimum film thickness", "m"),
    "minimum_x": ("position of the minimum film thickness, along entrainment", "m"),
    "minimum_y": ("position of the minimum film thickness, across entrainment", "m"),
    "lowest_thickness": ("minimum film thickness between the nodes", "m"),
    "central_thickness": ("film thickness at the centre of the contact", "m"),
    "coarse_lowest_thickness": (
        "minimum film thickness between the nodes of the companion, NaN between its steps",
        "m",
    ),
    "coarse_central_thickness": ("film thickness at the centre of the companion, NaN between its steps", "m"),
    "max_pressure": ("maximum pressure", "Pa"),
    "thin_gap_strength": ("voltage / minimum film thickness", "V/m"),
    "newton_iterations": ("Newton steps of a time step", "1"),
    "krylov_iterations": ("GMRES iterations of a time step", "1"),
    "halvings": ("number of halvings of a time step", "1"),
}
_FRAMES = {
    "frame_time": ("time since the roughness began to enter", "s"),
    "frame_step": ("number of the time step", "1"),
    "max_strength": ("maximum field strength", "V/m"),
    "max_strength_x": ("position of the maximum field strength, along entrainment", "m"),
    "max_strength_y": ("position of the maximum field strength, across entrainment", "m"),
    "capacitance": ("capacitance within the field range", "F/m or F"),
    "max_strength_error": ("estimated relative error of the maximum field strength, NaN if unknown", "1"),
}
_MAPS = {
    "pressure": ("pressure", "Pa"),
    "thickness": ("film thickness", "m"),
    "strength": ("maximum field strength across the film", "V/m"),
    "roughness_1": ("roughness of surface 1, out of the body", "m"),
    "roughness_2": ("roughness of surface 2, out of the body", "m"),
    "cavitated": ("cavitated: pressure at ambient", "1"),
}
# Variables over the time steps that only runs have whose surfaces touch.
_TOUCHES = {
    LOAD_SHARE: ("part of the load that asperities carry", "1"),
    AREA_SHARE: ("part of the Hertz zone in which the surfaces touch", "1"),
    SPOTS: ("number of spots in which the surfaces touch", "1"),
    COARSE_SHARE: ("part of the load that asperities carry in the companion, NaN between its steps", "1"),
}
# Variables that only runs with a supply of oil have: over the time steps, and maps where it is starved.
MENISCUS = "meniscus"
_SUPPLIED = {MENISCUS: ("position on the centre line from which oil fills the gap, NaN if flooded", "m")}
_CONTENT = {"film_fraction": ("part of the gap that oil fills", "1")}
# Variables that a line contact does not have.
_OF_POINTS = ("minimum_y", "max_strength_y")

# Steps or instants in a chunk of the file.
_CHUNK = 1024


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
        self._left: tuple[Any, int] | None = None

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
        kind = self._contact.kind
        positions = dict(zip(kind.axes, first.snapshot.film.axes, strict=True))

        def fill(file: Any) -> None:
            _lay_out(file, positions, stationary, kind)
            self._lay_out_supplied(file, first, tuple(positions))
            file.attrs["frames"] = file.attrs["complete"] = 0
            for key, value in attributes.items():
                file.attrs[key] = value
            self._put(file, first)

        create(self._path, fill)

    def _lay_out_supplied(self, file: Any, first: Record, axes: tuple[str, ...]) -> None:
        """Create the variables of a run with a supply of oil."""
        if self._contact.case.inlet is not None:
            for name, about in _SUPPLIED.items():
                _add(file, name, ("step",), about)
        if first.snapshot.film.film_fraction is not None:
            for name, about in _CONTENT.items():
                _add(file, name, ("frame", *axes), about)

    def append(self, record: Record) -> None:
        """Write a recorded instant and the time steps before it.

        Raises
        ------
        InputError
            If another run has written to the file, or the disk has not enough space.
        """
        with changed(self._path) as file:
            if _state(file) != self._left:
                raise InputError(
                    self._path, "is being written to by another run", takes="a folder of its own"
                )
            self._put(file, record)

    def _put(self, file: Any, record: Record) -> None:
        """Write an instant into the open file."""
        maps, numbers = self._maps(record.snapshot), _numbers(record)
        rows, step = record.rows, record.step
        # A half-written instant of an earlier version may follow the complete ones, so the step determines
        # the place to write.
        recorded = file.variables["frame_step"][: int(file.attrs["frames"])]
        frame = int(np.searchsorted(recorded, step))
        resize(file, {"step": step + 1, "frame": frame + 1})
        if any(row.values[name] > 0.0 for row in rows for name in (SPOTS, COARSE_SHARE)):
            _add_touches(file, step + 1 - len(rows))
        for name in file.variables:
            if name in _STEPS or name in _TOUCHES or name in _SUPPLIED:
                file.variables[name][step + 1 - len(rows) :] = [row.values[name] for row in rows]
        for name, value in (*maps.items(), *numbers.items()):
            file.variables[name][frame] = value
        keep(file, record.history, frame)
        if record.coarse is not None:
            keep(file, record.coarse, frame, group=COARSE)
        file.attrs["seconds"] = float(file.attrs["seconds"]) + record.seconds
        file.attrs["frames"] = frame + 1
        file.attrs["complete"] = int(step == self._contact.schedule.steps)
        self._left = _state(file)

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
                self._left, frames = _state(file), int(file.attrs["frames"])
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


def _lay_out(
    file: Any, positions: Mapping[str, Array], stationary: Mapping[str, Array], kind: AnyKind
) -> None:
    """Create dimensions and variables; write the nodes and the maps of stationary roughness."""
    axes = tuple(positions)
    file.dimensions = {"step": None, "frame": None} | {name: positions[name].size for name in axes}
    for name, values in positions.items():
        direction = "along" if name == "x" else "across"
        _add(file, name, (name,), (f"position {direction} entrainment", "m"), values)
    for table, dimension in ((_STEPS, "step"), (_FRAMES, "frame")):
        for name, (long_name, unit) in table.items():
            if len(axes) > 1 or name not in _OF_POINTS:
                unit = kind.capacitance_unit if name == "capacitance" else unit
                _add(file, name, (dimension,), (long_name, unit))
    for name, about in _MAPS.items():
        _add(file, name, ("frame", *axes), about)
    for name, values in stationary.items():
        long_name, unit = _MAPS[name]
        _add(file, f"stationary_{name}", axes, (f"{long_name}, stationary roughness", unit), values)


def _add(
    file: Any,
    name: str,
    dimensions: Sequence[str],
    about: tuple[str, str],
    values: Array | None = None,
) -> None:
    """Create a variable; ``about`` has its long name and its unit."""
    storage: dict[str, Any] = {}
    kind = "f8"
    if dimensions[0] == "frame" and len(dimensions) > 1:
        kind = "i1" if name == "cavitated" else "f4"
        shape = tuple(file.dimensions[d].size for d in dimensions[1:])
        storage = {"chunks": (1, *shape), "compression": "gzip", "compression_opts": 1, "shuffle": True}
    elif dimensions[0] in ("step", "frame"):
        storage = {"chunks": (_CHUNK,)}
    variable = file.create_variable(name, tuple(dimensions), kind, data=values, **storage)
    variable.attrs["long_name"], variable.attrs["units"] = about


def _add_touches(file: Any, before: int) -> None:
    """Create the variables of asperities where a file has none; the steps ``before`` have no spots."""
    if SPOTS in file.variables:
        return
    for name, about in _TOUCHES.items():
        _add(file, name, ("step",), about)
        file.variables[name][:before] = 0.0
    # The companion had no spots either where it had a film.
    missing = np.isnan(file.variables["coarse_lowest_thickness"][:before])
    file.variables[COARSE_SHARE][:before] = np.where(missing, math.nan, 0.0)


def _state(file: Any) -> tuple[Any, int]:
    """Date and number of recorded instants of a file; they change if another run writes to it."""
    return file.attrs["date"], int(file.attrs["frames"])


def described(contact: TransientContact) -> str:
    """Descriptions of the rough surfaces of a contact, as JSON."""
    return json.dumps(plain([surface.describe() for surface in contact.roughness.surfaces]))
