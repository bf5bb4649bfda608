"""Soundness of HDF5 files: seals, and files on which the library HDF5 crashes or never ends.

A seal is a checksum, which shows whether a byte of the file has changed. It follows the content as a last
line of fixed length. Programs that read NetCDF or HDF5 ignore bytes after the end that the header of the file
states. A program that opens the file to change it cuts the seal off, so that a file that was changed on
purpose has none.

A single changed byte can keep HDF5 in an endless loop, which no signal ends, or crash it. A file with a seal
is known to be as it was written. A file without a seal, as of a run that version 1.0.0 has stopped, is read
once in a separate process, which is ended after some time.
"""

from __future__ import annotations

import json
import math
import os
import re
import signal
import subprocess
import sys
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

    Its variables keep their HDF5 dataset, type and shape; the library looks them up in the file each time,
    the shape by all variables with the same dimensions. If a later version of the library lacks one of the
    names, only this time is lost.
    """
    import h5netcdf

    class Variable(h5netcdf.Variable):  # type: ignore[misc]
        @cached_property
        def _h5ds(self) -> Any:
            return super()._h5ds

        @cached_property
        def dtype(self) -> Any:
            return super().dtype

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

    class Group(h5netcdf.Group):  # type: ignore[misc]
        _variable_cls = Variable

        @property
        def _group_cls(self) -> Any:
            return Group

    class File(h5netcdf.File):  # type: ignore[misc]
        # If its initialisation fails halfway, the library writes a traceback to standard error when the
        # instance is deleted, as it lacks the attributes that are set here.
        _writable, _mode = False, "r"
        _variable_cls, _group_cls = Variable, Group

        def __init__(self, *given: Any, **options: Any) -> None:
            self.known_sizes: dict[Any, int] = {}
            super().__init__(*given, **options)

    return File


_SEAL = "\nehlectric crc32 {:08x}\n"
_FORM = re.compile(rb"\nehlectric crc32 ([0-9a-f]{8})\n")
_LENGTH = len(_SEAL.format(0))

# Bytes that are read at a time.
_BLOCK = 1 << 20


def seal_of(content: Iterable[bytes]) -> bytes:
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
    """Whether a file has a seal that fits its content. Returns False where the file has no seal, such as
    files of earlier versions and those that are still written. Raises DamagedError where the seal does not
    fit the content; InputError where the file cannot be read.
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

# Exit statuses of the process that reads a file.
_SOUND, _UNREADABLE, _BUSY = 0, 3, 4
_ENDLESS = "HDF5 reads it without end"
_SAYS = {_UNREADABLE: "HDF5 cannot read it", -getattr(signal, "SIGXCPU", 0): _ENDLESS}
_CODE = """
import json, sys
sys.path[:] = json.loads(sys.argv[1])
from ehlectric.runtime.hdf5_guard import read_all
sys.exit(read_all(sys.argv[2], int(sys.argv[3])))
"""

# Files without a seal that are known to be sound, the latest last, and their largest number. A key is the
# path and what changes with the content: size, time of the last change, number of the file.
_known: dict[tuple[Path, int, int, int], None] = {}
_MOST_KNOWN = 64


def refuse_damaged(path: Path) -> None:
    """Refuse a file that HDF5 cannot read, without being harmed by it. Raises DamagedError where the seal of
    the file does not fit, or HDF5 cannot read it, crashes or does not end; InputError where the file cannot
    be opened or is not a NetCDF file; BlockingIOError where another program writes to it.
    """
    with regular(path) as file:
        start = file.read(len(_SIGNATURE))
        state = os.fstat(file.fileno())
    if start != _SIGNATURE:
        raise InputError(path, "is not a NetCDF file")
    key = path.absolute(), state.st_size, state.st_mtime_ns, state.st_ino
    if key not in _known and not sealed(path):
        _try(path, state.st_size)
        _known[key] = None
        # A copy, which other threads do not change.
        for oldest in list(_known)[:-_MOST_KNOWN]:
            _known.pop(oldest, None)


def _try(path: Path, size: int) -> None:
    """Read a file in a separate process."""
    seconds = _LIMIT + size / _SPEED
    command = [sys.executable, "-I", "-c", _CODE, json.dumps(sys.path), str(path), str(math.ceil(seconds))]
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
    if status == _BUSY:
        raise BlockingIOError
    if status != _SOUND:
        raise DamagedError.of(path, _SAYS.get(status, "HDF5 crashes on it"))


def read_all(path: str, seconds: int) -> int:
    """Read all of a NetCDF file: names, attributes and values. Exit status of the process that does so.

    The kernel ends the process after some computing time, where it has such limits.
    """
    with suppress(ModuleNotFoundError):
        resource = import_module("resource")
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 5))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    try:
        with file_class()(path, "r") as file:
            check_netcdf_values(Path(path), file)
            _read_group(file)
    except BlockingIOError:
        return _BUSY
    except (InputError, MemoryError):
        return _SOUND  # too large: the reader reports it
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
