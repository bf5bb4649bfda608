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

# Number of places that are written alternately.
_PLACES = 2


def keep(file: Any, history: History, frame: int) -> None:
    """Write the last two instants of a run.

    Parameters
    ----------
    file : h5netcdf.File
        File of the run, open for writing.
    history : History
        Last two instants.
    frame : int
        Number of the recorded instant, which determines the place.
    """
    values = _values_of(history)
    if "resume" not in file.groups:
        _create(file, history.now.state.pressure.shape)
    group, place = file.groups["resume"], frame % _PLACES
    for name, array in values.items():
        group.variables[name][place] = array
    group.variables["checksum"][place] = _checksum(values)


def kept(file: Any, frames: int) -> History | None:
    """Read the last two instants of a run.

    Parameters
    ----------
    file : h5netcdf.File
        File of the run, open for reading.
    frames : int
        Number of recorded instants.

    Returns
    -------
    History or None
        Last two instants; None if no instant is recorded, or its place is not complete.

    Raises
    ------
    KeyError
        If the file has no group "resume", or not all its variables.
    """
    group, place = file.groups["resume"], (frames - 1) % _PLACES
    values = {name: np.asarray(group.variables[name][place]) for name in (*_OVER_MESH, *_NUMBERS)}
    if not frames or _checksum(values) != int(group.variables["checksum"][place]):
        return None
    return History(now=_instant(values, 0), before=_instant(values, 1))


def _create(file: Any, shape: tuple[int, ...]) -> None:
    group = file.create_group("resume")
    group.dimensions = {"place": _PLACES, "instant": 2, "along": shape[0], "across": shape[1]}
    for name in (*_OVER_MESH, *_NUMBERS):
        over = ("along", "across") if name in _OVER_MESH else ()
        group.create_variable(name, ("place", "instant", *over), _type_of(name))
    group.create_variable("checksum", ("place",), "i8")


def _type_of(name: str) -> str:
    return "i1" if name == "free" else "f8"


def _checksum(values: Mapping[str, Array]) -> int:
    """CRC-32 of the values, in the order and with the types of the file."""
    total = 0
    for name in (*_OVER_MESH, *_NUMBERS):
        total = zlib.crc32(np.ascontiguousarray(values[name], dtype=_type_of(name)).tobytes(), total)
    return total


def _values_of(history: History) -> dict[str, Array]:
    """Values of both instants by the names of their variables, the last instant first."""
    instants = history.now, history.before
    return {
        "pressure": np.stack([instant.state.pressure for instant in instants]),
        "thickness": np.stack([instant.state.thickness for instant in instants]),
        "mass": np.stack([instant.mass for instant in instants]),
        "density": np.stack([instant.density for instant in instants]),
        "free": np.stack([instant.full_film for instant in instants]),
        "t": np.array([instant.time for instant in instants]),
        "h00": np.array([instant.state.h00 for instant in instants]),
    }


def _instant(values: Mapping[str, Array], k: int) -> Instant:
    state = State(values["pressure"][k], float(values["h00"][k]), values["thickness"][k])
    full = values["free"][k].astype(bool)
    return Instant(float(values["t"][k]), state, values["mass"][k], values["density"][k], full)
