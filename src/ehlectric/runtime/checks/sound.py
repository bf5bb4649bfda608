"""Soundness of HDF5 files: files that the library HDF5 cannot read, or on which it crashes or never ends.

A single changed byte can keep HDF5 in an endless loop, which no signal ends, or crash it. A file with a seal
is known to be as it was written, and so is one that this process has written and that has not changed since.
Any other file is read once by a process of its own, whose end is awaited.
"""

from __future__ import annotations

import json
import math
import os
import signal
import subprocess
import sys
import time
from contextlib import suppress
from importlib import import_module
from pathlib import Path
from typing import Any

from ehlectric.errors import DamagedError, InputError
from ehlectric.runtime.checks.classes import reading_class
from ehlectric.runtime.checks.seal import sealed
from ehlectric.runtime.reading import regular
from ehlectric.runtime.sizes import check_netcdf_values

_SIGNATURE = b"\x89HDF\r\n\x1a\n"

# Longest computing time in which a file is read in a process of its own [s], and the further time for its
# size [bytes/s]. The time on a clock is a second limit, as other programs may keep the machine busy.
_LIMIT, _SPEED, _CLOCK = 6.0, 10e6, 60.0

# Longest time to wait for another program that has the file open, and time between two attempts [s].
_PATIENCE, _AGAIN = 30.0, 0.2

# Exit statuses of the process that reads a file.
_SOUND, _UNREADABLE, _BUSY = 0, 3, 4
_ENDLESS = "HDF5 reads it without end"
_SAYS = {_UNREADABLE: "HDF5 cannot read it", -getattr(signal, "SIGXCPU", 0): _ENDLESS}
_CODE = """
import json, sys
sys.path[:] = json.loads(sys.argv[1])
from ehlectric.runtime.checks.sound import read_all
sys.exit(read_all(sys.argv[2], int(sys.argv[3])))
"""

# Path of a file, and what changes with its content: size, time of the last change, number of the file.
_State = tuple[Path, int, int, int]

# Files without a seal that are known to be sound, the latest last, and their largest number.
_known: dict[_State, None] = {}
_MOST_KNOWN = 64


def refuse_damaged(path: Path) -> None:
    """Refuse a file that HDF5 cannot read, without being harmed by it.

    Parameters
    ----------
    path : Path
        NetCDF file that will be read.

    Raises
    ------
    DamagedError
        Where the seal of the file does not fit, or HDF5 cannot read it, crashes or does not end.
    InputError
        Where the file cannot be opened, is not a NetCDF file, or stays open in another program.
    """
    with regular(path) as file:
        start = file.read(len(_SIGNATURE))
        state = os.fstat(file.fileno())
    if start != _SIGNATURE:
        raise InputError(path, "is not a NetCDF file")
    if not known_sound(path, state) and not sealed(path):
        _try(path, state.st_size)
        remember_sound(path, state)


def known_sound(path: Path, state: os.stat_result) -> bool:
    """Whether a file has not changed since it was found or written sound.

    Parameters
    ----------
    path : Path
        File without a seal.
    state : os.stat_result
        Its present state.
    """
    return _key(path, state) in _known


def remember_sound(path: Path, state: os.stat_result) -> None:
    """Remember that a file is sound: this process has read it, or written it.

    Parameters
    ----------
    path : Path
        File without a seal.
    state : os.stat_result
        Its state when it was found or written sound.
    """
    _known[_key(path, state)] = None
    while len(_known) > _MOST_KNOWN:
        _known.pop(next(iter(_known)), None)


def _key(path: Path, state: os.stat_result) -> _State:
    return path.absolute(), state.st_size, state.st_mtime_ns, state.st_ino


def _try(path: Path, size: int) -> None:
    """Read a file in a process of its own."""
    until = time.monotonic() + _PATIENCE
    seconds = _LIMIT + size / _SPEED
    command = [sys.executable, "-I", "-c", _CODE, json.dumps(sys.path), str(path), str(math.ceil(seconds))]
    while True:
        try:
            status = subprocess.run(
                command,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                timeout=_CLOCK + seconds,
                check=False,
            ).returncode
        except subprocess.TimeoutExpired:
            raise DamagedError.of(path, _ENDLESS) from None
        if status == _SOUND:
            return
        if status != _BUSY:
            raise DamagedError.of(path, _SAYS.get(status, "HDF5 crashes on it"))
        if time.monotonic() > until:
            raise InputError(path, "is held open by another program, which must close it")
        time.sleep(_AGAIN)


def read_all(path: str, seconds: int) -> int:
    """Read all of a NetCDF file: names, attributes and values. Exit status of the process that does so.

    The kernel ends the process after some computing time, where it has such limits.
    """
    with suppress(ModuleNotFoundError):
        resource = import_module("resource")
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 5))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    try:
        with reading_class()(path, "r") as file:
            check_netcdf_values(Path(path), file)
            _read_group(file)
    except BlockingIOError:
        return _BUSY
    except (InputError, MemoryError):
        return _SOUND  # too large: the reader says so
    except Exception:  # HDF5 and its wrappers raise errors of many types
        return _UNREADABLE
    return _SOUND


def _read_group(group: Any) -> None:
    dict(group.attrs)
    for variable in group.variables.values():
        dict(variable.attrs)
        _ = variable.dimensions, variable[...]
    for inner in group.groups.values():
        _read_group(inner)
