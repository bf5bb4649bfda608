"""NetCDF files that are written as it goes, and that others may look at meanwhile."""

from __future__ import annotations

import shutil
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from ehlectric.errors import InputError
from ehlectric.runtime.interrupts import held_back

# What a run waits for those who read its file, and they for it, and in which steps [s].
_PATIENCE, _AGAIN = 30.0, 0.05


@contextmanager
def opened(path: Path, mode: str) -> Iterator[Any]:
    """A file, once nobody else has it open; who stops the program waits until it is closed.

    Raises
    ------
    InputError
        Where it stays open.
    """
    import h5netcdf

    until = time.monotonic() + _PATIENCE
    while True:
        with held_back():
            try:
                file = h5netcdf.File(path, mode)
            except BlockingIOError:
                if time.monotonic() > until:
                    told = "is held open by another program, which must close it"
                    raise InputError(path, told) from None
            else:
                with file:
                    yield file
                return
        time.sleep(_AGAIN)


def check_space(path: Path, needed: int) -> None:
    """Refuse to write what a disk has no room for: HDF5 itself does not survive a full one.

    Parameters
    ----------
    path : Path
        The file.
    needed : int
        Bytes that it may grow by.

    Raises
    ------
    InputError
        Where there are fewer.
    """
    if shutil.disk_usage(path.parent).free < needed:
        raise InputError(path, "cannot be written to, the disk is full")


def resize(file: Any, sizes: Mapping[str, int]) -> None:
    """Give dimensions these sizes, those that have others."""
    for name, size in sizes.items():
        if file.dimensions[name].size != size:
            file.resize_dimension(name, size)
