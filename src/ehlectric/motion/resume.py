"""Last two films of a transient run in its file, from which a stopped run is resumed.

The time integration uses the films of the last two instants, so a run is resumed from both. The group
"resume" of the file stores them in double precision, alternately in two places. If the run stops while an
instant is written, the other place is still intact. A checksum of each place tells whether it is complete.
"""

from __future__ import annotations

import zlib
from collections.abc import Mapping
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.state import State
from ehlectric.film.unsteady import History, Instant

# Variables of an instant over the mesh, and its scalars: time T and rigid separation H00.
_OVER_MESH = ("pressure", "thickness", "mass", "density", "free")
_NUMBERS = ("t", "h00")

# Variable over the mesh that a file has from the first instant on whose surfaces touch.
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
        _create(file, group, history.now.state.pressure.shape)
    if _touches(history) and _TOUCHING not in file.groups[group].variables:
        _add(file.groups[group], _TOUCHING)


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
    names = [*_OVER_MESH, *_NUMBERS, *([_TOUCHING] if _TOUCHING in variables else [])]
    values = {name: np.asarray(variables[name][place]) for name in names}
    if not frames or _checksum(values) != int(variables["checksum"][place]):
        return None
    return History(now=_instant(values, 0), before=_instant(values, 1))


def _create(file: Any, name: str, shape: tuple[int, ...]) -> None:
    group = file.create_group(name)
    group.dimensions = {"place": _PLACES, "instant": 2, "along": shape[0], "across": shape[1]}
    for variable in (*_OVER_MESH, *_NUMBERS):
        _add(group, variable)
    group.create_variable("checksum", ("place",), "i8")


def _add(group: Any, variable: str) -> None:
    over = () if variable in _NUMBERS else ("along", "across")
    group.create_variable(variable, ("place", "instant", *over), _type_of(variable))


def _type_of(name: str) -> str:
    return "i1" if name == "free" else "f8"


def _checksum(values: Mapping[str, Array]) -> int:
    """CRC-32 of the values, in the order and with the types of the file."""
    total = 0
    for name in (*_OVER_MESH, *_NUMBERS, *([_TOUCHING] if _TOUCHING in values else [])):
        total = zlib.crc32(np.ascontiguousarray(values[name], dtype=_type_of(name)).tobytes(), total)
    return total


def _touches(history: History) -> bool:
    """Whether surfaces touch at one of both instants."""
    return any(bool(instant.state.touching.any()) for instant in (history.now, history.before))


def _values_of(history: History) -> dict[str, Array]:
    """Values of both instants by the names of their variables, the last instant first."""
    instants = history.now, history.before
    values = {
        "pressure": np.stack([instant.state.pressure for instant in instants]),
        "thickness": np.stack([instant.state.thickness for instant in instants]),
        "mass": np.stack([instant.mass for instant in instants]),
        "density": np.stack([instant.density for instant in instants]),
        "free": np.stack([instant.full_film for instant in instants]),
        "t": np.array([instant.time for instant in instants]),
        "h00": np.array([instant.state.h00 for instant in instants]),
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
