"""The file of a contact whose roughness moves: written as it is solved, read again to go on.

Closed between two instants, it is whole whenever the run stops then. Where it stops while an instant is
written, that instant does not count: the number of those that do is written last, and what a run goes on
from is kept twice, of the last two instants in turn. Long fields are kept in single precision, what a run
goes on from in double.
"""

from __future__ import annotations

import json
import math
import tomllib
import zlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.interpolate import RegularGridInterpolator

from ehlectric.arrays import Array
from ehlectric.cases.case import Case
from ehlectric.errors import InputError
from ehlectric.field.line import Field
from ehlectric.field.point import PointField
from ehlectric.film.line import Film
from ehlectric.film.point import PointFilm
from ehlectric.film.state import State
from ehlectric.film.unsteady import History, Instant
from ehlectric.motion.motion import Motion
from ehlectric.motion.solver import MovingContact, Snapshot
from ehlectric.runtime.files import plain
from ehlectric.runtime.netcdf import check_space, opened, resize
from ehlectric.version import __version__

if TYPE_CHECKING:
    import xarray as xr


# Name: (long name, unit), of all time steps, and of the instants that are kept.
_STEPS = {
    "time": ("time since the roughness began to enter", "s"),
    "minimum_thickness": ("smallest film thickness", "m"),
    "minimum_x": ("where the film is thinnest, along entrainment", "m"),
    "minimum_y": ("where the film is thinnest, across entrainment", "m"),
    "max_pressure": ("largest pressure", "Pa"),
    "thin_gap_strength": ("voltage over the smallest film thickness", "V/m"),
    "newton_iterations": ("Newton steps of a time step", "1"),
    "krylov_iterations": ("GMRES iterations of a time step", "1"),
    "halvings": ("how often a time step was halved", "1"),
}
_FRAMES = {
    "frame_time": ("time since the roughness began to enter", "s"),
    "frame_step": ("number of the time step", "1"),
    "max_strength": ("largest field strength", "V/m"),
    "max_strength_x": ("where the field is strongest, along entrainment", "m"),
    "max_strength_y": ("where the field is strongest, across entrainment", "m"),
    "capacitance": ("capacitance within the field range", "F/m or F"),
}
_MAPS = {
    "pressure": ("pressure", "Pa"),
    "thickness": ("film thickness", "m"),
    "strength": ("largest field strength across the film", "V/m"),
    "roughness_1": ("roughness of surface 1, out of the body", "m"),
    "roughness_2": ("roughness of surface 2, out of the body", "m"),
    "cavitated": ("pressure held at ambient", "1"),
}
_OF_POINTS = ("minimum_y", "max_strength_y")
_RESUME = ("pressure", "thickness", "mass", "density", "free")
_ATTRIBUTES = {"free": "full_film"}  # of an instant, where the file has another name
_TIMES = ("t", "h00")
_PLACES = 2  # of what a run goes on from
_CHUNK = 1024

# What an instant takes at the most: a node of all maps and of what a run goes on from, and the steps besides.
_NODE_BYTES, _CHUNK_BYTES = 256, 10_000_000


@dataclass(frozen=True)
class Row:
    """What is kept of a time step."""

    values: Mapping[str, float]

    @classmethod
    def of(cls, contact: MovingContact, history: History) -> Row:
        """Of the last step of a history, SI units."""
        motion, instant = contact.motion, history.now
        thinnest, where, highest = contact.extremes(instant)
        values: dict[str, float] = {
            "time": instant.time * motion.course.time,
            "minimum_thickness": thinnest,
            "max_pressure": highest,
            "thin_gap_strength": motion.case.electric.voltage / thinnest,
            "newton_iterations": history.effort.newton,
            "krylov_iterations": history.effort.krylov,
            "halvings": history.effort.halvings,
        }
        return cls(values | _place("minimum", where))


def _place(name: str, place: float | tuple[float, ...]) -> dict[str, float]:
    """Along entrainment, and of a point contact across it."""
    places = place if isinstance(place, tuple) else (place,)
    return {f"{name}_{axis}": at for axis, at in zip("xy", places, strict=False)}


class MotionFile:
    """The file of a run, made new or opened to go on.

    Parameters
    ----------
    path : Path
        The file.
    contact : MovingContact
        What is solved.
    """

    def __init__(self, path: Path, contact: MovingContact) -> None:
        self._path, self._contact = path, contact
        self._point = contact.motion.case.contact.geometry == "point"
        self._left: tuple[Any, int] | None = None

    def create(self, first: Snapshot, attributes: Mapping[str, Any], stationary: Mapping[str, Array]) -> None:
        """A file without instants; ``stationary`` has maps of the roughness held still."""
        nodes = ("x", "y") if self._point else ("x",)
        with opened(self._path, "w") as file:
            axes = {name: np.asarray(getattr(first.film, name)) for name in nodes}
            file.dimensions = {"step": None, "frame": None} | {name: axes[name].size for name in nodes}
            for name, values in axes.items():
                way = "along" if name == "x" else "across"
                self._add(file, name, (name,), f"position {way} entrainment", "m", values)
            for table, dimension in ((_STEPS, "step"), (_FRAMES, "frame")):
                for name, (long_name, unit) in table.items():
                    if self._point or name not in _OF_POINTS:
                        self._add(file, name, (dimension,), long_name, self._unit(name, unit))
            for name, (long_name, unit) in _MAPS.items():
                self._add(file, name, ("frame", *nodes), long_name, unit)
            for name, values in stationary.items():
                long_name, unit = _MAPS[name]
                about = f"{long_name}, the roughness held still"
                self._add(file, f"stationary_{name}", nodes, about, unit, values)
            file.attrs["frames"] = file.attrs["complete"] = 0
            for key, value in attributes.items():
                file.attrs[key] = value
            self._left = _state(file)

    def _unit(self, name: str, unit: str) -> str:
        return ("F" if self._point else "F/m") if name == "capacitance" else unit

    def _add(
        self,
        file: Any,
        name: str,
        dimensions: Sequence[str],
        long_name: str,
        unit: str,
        values: Array | None = None,
    ) -> None:
        how: dict[str, Any] = {}
        kind = "f8"
        if dimensions[0] == "frame" and len(dimensions) > 1:
            kind = "i1" if name == "cavitated" else "f4"
            shape = tuple(file.dimensions[d].size for d in dimensions[1:])
            how = {"chunks": (1, *shape), "compression": "gzip", "compression_opts": 1, "shuffle": True}
        elif dimensions[0] in ("step", "frame"):
            how = {"chunks": (_CHUNK,)}
        variable = file.create_variable(name, tuple(dimensions), kind, data=values, **how)
        variable.attrs["long_name"], variable.attrs["units"] = long_name, unit

    def append(
        self, rows: Sequence[Row], step: int, snapshot: Snapshot, history: History, seconds: float
    ) -> None:
        """The steps since the last instant, the instant, what goes on from it, and the time it took [s]."""
        film, field = snapshot.film, snapshot.field
        maps = {
            "pressure": film.pressure,
            "thickness": film.thickness,
            "strength": column_strength(film, field),
            "roughness_1": snapshot.roughness[0],
            "roughness_2": snapshot.roughness[1],
            "cavitated": film.cavitated,
        }
        numbers = {
            "frame_time": snapshot.time,
            "frame_step": step,
            "max_strength": field.max_strength,
            "capacitance": field.capacitance,
        } | _place("max_strength", field.max_strength_position)
        check_space(self._path, _NODE_BYTES * film.pressure.size + _CHUNK_BYTES)
        with opened(self._path, "a") as file:
            if _state(file) != self._left:
                raise InputError(
                    self._path, "is being written to by another run", takes="a folder of its own"
                )
            # By their numbers, not behind what there is: of an instant that was half written before.
            before = file.variables["frame_step"][: int(file.attrs["frames"])]
            frame = int(np.searchsorted(before, step))
            resize(file, {"step": step + 1, "frame": frame + 1})
            for name in file.variables:
                if name in _STEPS:
                    file.variables[name][step + 1 - len(rows) :] = [row.values[name] for row in rows]
            for name, value in (*maps.items(), *numbers.items()):
                file.variables[name][frame] = value
            self._keep(file, history, frame % _PLACES)
            file.attrs["seconds"] = float(file.attrs["seconds"]) + seconds
            file.attrs["frames"] = frame + 1
            file.attrs["complete"] = int(step == self._contact.motion.course.steps)
            self._left = _state(file)

    def _keep(self, file: Any, history: History, place: int) -> None:
        """What a run goes on from."""
        pairs = history.now, history.before
        found = {name: np.stack([_part(one, name) for one in pairs]) for name in _RESUME}
        found |= {"t": np.array([one.time for one in pairs])}
        found |= {"h00": np.array([one.state.h00 for one in pairs])}
        if "resume" not in file.groups:
            group = file.create_group("resume")
            shape = history.now.state.pressure.shape
            group.dimensions = {"place": _PLACES, "instant": 2, "along": shape[0], "across": shape[1]}
            for name in found:
                sizes = ("place", "instant") if name in _TIMES else ("place", *tuple(group.dimensions)[1:])
                group.create_variable(name, sizes, "i1" if name == "free" else "f8")
            group.create_variable("checksum", ("place",), "i8")
        group = file.groups["resume"]
        for name, values in found.items():
            group.variables[name][place] = values
        group.variables["checksum"][place] = _checksum(found)

    def whole(self) -> bool:
        """Whether there is a run of the same case that went to its end."""
        try:
            with opened(self._path, "r") as file:
                return bool(file.attrs["complete"]) and self._same(file.attrs)
        except (OSError, KeyError, ValueError, RuntimeError):
            return False  # none, not a run, or damaged

    def resumed(self) -> tuple[int, History] | None:
        """The last step of an unfinished run of the same case and the film then, None without one."""
        if not self._path.is_file():
            return None
        try:
            with opened(self._path, "r") as file:
                if file.attrs["complete"] or not self._same(file.attrs):
                    return None
                self._left, frames = _state(file), int(file.attrs["frames"])
                kept = _kept(file.groups["resume"], frames)
                return None if kept is None else (int(file.variables["frame_step"][frames - 1]), kept)
        except (OSError, KeyError, ValueError, RuntimeError):
            return None  # not a run, or damaged: solved from the start

    def _same(self, attributes: Mapping[str, Any]) -> bool:
        """Whether a file is of this case, its surfaces as they are now, by this version."""
        motion = self._contact.motion
        known = {"case": motion.case.to_toml(), "version": __version__, "rough": described(motion)}
        return all(attributes[name] == value for name, value in known.items())


def _state(file: Any) -> tuple[Any, int]:
    """What changes where another run writes into a file."""
    return file.attrs["date"], int(file.attrs["frames"])


def described(motion: Motion) -> str:
    """The rough surfaces as JSON."""
    return json.dumps(plain([surface.describe() for surface in motion.rough]))


def _checksum(found: Mapping[str, Array]) -> int:
    """Of what a run goes on from, in the order and kinds in which it is kept."""
    total = 0
    for name in (*_RESUME, *_TIMES):
        kind = "i1" if name == "free" else "f8"
        total = zlib.crc32(np.ascontiguousarray(found[name], dtype=kind).tobytes(), total)
    return total


def _kept(group: Any, frames: int) -> History | None:
    """The film after so many instants; None where it was not written whole."""
    place = (frames - 1) % _PLACES
    found = {name: np.asarray(group.variables[name][place]) for name in (*_RESUME, *_TIMES)}
    if not frames or _checksum(found) != int(group.variables["checksum"][place]):
        return None
    now, before = (_instant(found, k) for k in range(2))
    return History(now, before)


def _part(instant: Instant, name: str) -> Array:
    of_state = name in ("pressure", "thickness")
    values: Array = getattr(instant.state if of_state else instant, _ATTRIBUTES.get(name, name))
    return values


def _instant(found: Mapping[str, Array], k: int) -> Instant:
    parts = {name: found[name][k] for name in _RESUME}
    state = State(parts["pressure"], float(found["h00"][k]), parts["thickness"])
    return Instant(float(found["t"][k]), state, parts["mass"], parts["density"], parts["free"].astype(bool))


def column_strength(film: Film, field: Field | PointField) -> Array:
    """Largest field strength across the film at its nodes [V/m]; not a number outside the field range."""
    strength = field.column_strength
    if isinstance(film, PointFilm):
        assert isinstance(field, PointField)
        between = RegularGridInterpolator((field.x, field.y), strength, bounds_error=False)
        at: Array = between(np.stack(np.meshgrid(film.x, film.y, indexing="ij"), axis=-1))
        return at
    return np.interp(film.x, field.x, strength, left=math.nan, right=math.nan)


def motion_of(dataset: xr.Dataset) -> Motion:
    """What was solved."""
    return Motion(Case.from_dict(tomllib.loads(dataset.attrs["case"])))
