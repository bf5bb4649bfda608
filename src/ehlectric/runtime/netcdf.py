"""NetCDF files: reading them, and writing files that grow while other programs read them."""

from __future__ import annotations

import shutil
import time
import warnings
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ehlectric.errors import DamagedError, InputError
from ehlectric.runtime.checks.sound import file_class, refuse_damaged
from ehlectric.runtime.interrupts import held_back
from ehlectric.runtime.sizes import check_netcdf_values

if TYPE_CHECKING:
    import xarray as xr


# Longest time to wait for another program that has the file open, and time between two attempts [s].
_PATIENCE, _AGAIN = 30.0, 0.05


def read_dataset(path: Path) -> xr.Dataset:
    """Read a NetCDF file into memory.

    Parameters
    ----------
    path : Path
        File to read; it may be growing.

    Returns
    -------
    xarray.Dataset
        All variables and attributes.

    Raises
    ------
    DamagedError
        Where the file is damaged.
    InputError
        Where the file cannot be read, is no NetCDF file, stays open in another program, or has too large
        values.
    """
    import xarray as xr

    try:
        with warnings.catch_warnings(), opened(path, "r") as file:
            warnings.simplefilter("ignore")  # xarray warns about files that are refused below
            check_netcdf_values(path, file)
            return xr.open_dataset(xr.backends.H5NetCDFStore(file)).load()
    except (InputError, MemoryError):
        raise
    except Exception:  # HDF5 and its wrappers raise errors of many types for damaged files
        raise DamagedError.of(path, "its header cannot be read") from None


@contextmanager
def opened(path: Path, mode: str) -> Iterator[Any]:
    """Context with an open file. It waits while another program has the file open.

    Interrupts are held back until the file is closed, so that they leave no damaged file. A file to be read
    is refused before, where HDF5 cannot read it.

    Raises
    ------
    DamagedError
        Where a file to be read is damaged.
    InputError
        Where the file to be read cannot be opened or is no NetCDF file, or another program keeps it open.
    """
    if mode == "r":
        refuse_damaged(path)
    until = time.monotonic() + _PATIENCE
    while True:
        with held_back():
            try:
                file = file_class()(path, mode)
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
    """Refuse to write more than the disk has room for: HDF5 damages the file when the disk is full.

    Parameters
    ----------
    path : Path
        File that grows.
    needed : int
        Largest number of bytes that it may grow by.

    Raises
    ------
    InputError
        Where the disk has fewer bytes left.
    """
    if shutil.disk_usage(path.parent).free < needed:
        raise InputError(path, "cannot be written to, the disk is full")


def resize(file: Any, sizes: Mapping[str, int]) -> None:
    """Resize the dimensions of an open file whose sizes differ from the ones in ``sizes``."""
    for name, size in sizes.items():
        if file.dimensions[name].size != size:
            file.resize_dimension(name, size)
