"""Soundness of HDF5 files: seals, classes of the reader, and files on which the library HDF5 crashes or
never ends.

Seals: a checksum at the end of a file, which tells later whether a byte of the file has changed.
The seal follows the content as a last line of fixed length. Programs that read NetCDF or HDF5 ignore bytes
after the end that the header of the file states. A program that opens the file to change it cuts the seal
off, so that a file that was changed on purpose has none.

Soundness of HDF5 files: files that the library HDF5 cannot read, or on which it crashes or never ends.
A single changed byte can keep HDF5 in an endless loop, which no signal ends, or crash it. A file with a seal
is known to be as it was written, and so is one that this process has written and that has not changed since.
Any other file is read once by a process of its own, whose end is awaited.
"""

from __future__ import annotations

import json
import math
import os
import re
import signal
import subprocess
import sys
import time
import zlib
from collections.abc import Iterable
from contextlib import suppress
from functools import cache, cached_property
from importlib import import_module
from io import RawIOBase
from pathlib import Path
from typing import Any, BinaryIO

from ehlectric.errors import DamagedError, InputError
from ehlectric.runtime.files import reading
from ehlectric.runtime.reading import regular
from ehlectric.runtime.sizes import check_netcdf_values


@cache
def file_class() -> Any:
    """Class ``h5netcdf.File``, whose instances say nothing where a file cannot be opened.

    Its variables keep what they are asked for often; the library looks it up in the file each time. Where a
    later version of the library lacks one of the names, this time is lost, no more.
    """
    return _file_class(_variable_class())


@cache
def reading_class() -> Any:
    """Class of files that are only read, whose variables also keep their shapes.

    For each shape with an unlimited dimension the library asks all variables that have it, which takes most
    of the time in which a small file is read.
    """

    class Variable(_variable_class()):  # type: ignore[misc]
        @cached_property
        def shape(self) -> tuple[int, ...]:
            with suppress(AttributeError):
                known, every = self._root.known_sizes, self._parent._all_dimensions
                dimensions = [every[name] for name in self.dimensions]
                for dimension in dimensions:
                    if dimension not in known:
                        known[dimension] = dimension.size
                return tuple(known[dimension] for dimension in dimensions)
            return tuple(super().shape)

    class File(_file_class(Variable)):  # type: ignore[misc]
        def __init__(self, *given: Any, **options: Any) -> None:
            self.known_sizes: dict[Any, int] = {}
            super().__init__(*given, **options)

    return File


def _variable_class() -> Any:
    """Class ``h5netcdf.Variable``, whose instances keep their HDF5 dataset and their type."""
    import h5netcdf

    class Variable(h5netcdf.Variable):  # type: ignore[misc]
        @cached_property
        def _h5ds(self) -> Any:
            return super()._h5ds

        @cached_property
        def dtype(self) -> Any:
            return super().dtype

    return Variable


def _file_class(variable: Any) -> Any:
    """Class of files whose variables, also those of groups, are of a class.

    Where its initialisation fails halfway, the class of the library writes a traceback to standard error when
    the instance is deleted, as it lacks the attributes that are set here.
    """
    import h5netcdf

    class Group(h5netcdf.Group):  # type: ignore[misc]
        _variable_cls = variable

        @property
        def _group_cls(self) -> Any:
            return Group

    class File(h5netcdf.File):  # type: ignore[misc]
        _writable, _mode = False, "r"
        _variable_cls, _group_cls = variable, Group

    return File


_SEAL = "\nehlectric crc32 {:08x}\n"
_FORM = re.compile(rb"\nehlectric crc32 ([0-9a-f]{8})\n")
_LENGTH = len(_SEAL.format(0))

# Bytes that are read at a time.
_BLOCK = 1 << 20


def seal(path: Path) -> None:
    """Append a seal to a file that is complete; a file that has one is not changed.

    Where the disk is full, the file is left without a seal: it can be read all the same.
    """
    with path.open("r+b", buffering=0) as file:
        length, found = _split(file)
        if found is None:
            total = _checksum(file, length)
            try:
                file.seek(length)
                file.write(_SEAL.format(total).encode())
            except OSError:
                file.truncate(length)


def seal_of(content: Iterable[bytes | memoryview]) -> bytes:
    r"""Seal of the content of a file, in parts, to be written after it.

    Examples
    --------
    >>> seal_of([b"fi", b"lm"])
    b'\nehlectric crc32 8244be22\n'
    """
    total = 0
    for part in content:
        total = zlib.crc32(part, total)
    return _SEAL.format(total).encode()


def sealed(path: Path) -> bool:
    """Whether a file has a seal that fits its content. Returns False where the file has no seal, as those of
    earlier versions and those that are still written. Raises DamagedError where the seal does not fit the
    content; InputError where the file cannot be read.
    """
    with reading(path), path.open("rb") as file:
        length, expected = _split(file)
        if expected is None:
            return False
        if _checksum(file, length) != expected:
            raise DamagedError.of(path, "its bytes are not those that were written")
    return True


def _split(file: BinaryIO | RawIOBase) -> tuple[int, int | None]:
    """Length of the content of a file, and the checksum in its seal; None where it has no seal."""
    size = file.seek(0, 2)
    file.seek(max(size - _LENGTH, 0))
    match = _FORM.fullmatch(file.read(_LENGTH))
    return (size, None) if match is None else (size - _LENGTH, int(match[1], 16))


def _checksum(file: BinaryIO | RawIOBase, length: int) -> int:
    """CRC-32 of the first bytes of a file."""
    file.seek(0)
    total = 0
    while length > 0 and (block := file.read(min(_BLOCK, length))):
        total = zlib.crc32(block, total)
        length -= len(block)
    return total


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
from ehlectric.runtime.hdf5_soundness import read_all
sys.exit(read_all(sys.argv[2], int(sys.argv[3])))
"""

# Path of a file, and what changes with its content: size, time of the last change, number of the file.
_State = tuple[Path, int, int, int]

# Files without a seal that are known to be sound, the latest last, and their largest number.
_known: dict[_State, None] = {}
_MOST_KNOWN = 64


def refuse_damaged(path: Path) -> None:
    """Refuse a file that HDF5 cannot read, without being harmed by it. Raises DamagedError where the seal of
    the file does not fit, or HDF5 cannot read it, crashes or does not end; InputError where the file cannot
    be opened, is not a NetCDF file, or stays open in another program.
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
    """Whether a file has not changed since it was found or written sound."""
    return _key(path, state) in _known


def remember_sound(path: Path, state: os.stat_result) -> None:
    """Remember that a file is sound: this process has read it, or written it. ``state``, its state when it
    was found or written sound.
    """
    _known[_key(path, state)] = None
    # A copy, which other threads do not change.
    for oldest in list(_known)[:-_MOST_KNOWN]:
        _known.pop(oldest, None)


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
