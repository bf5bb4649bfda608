"""NetCDF files: reading them, their content in memory, and files that grow while other programs read them."""

from __future__ import annotations

import errno
import os
import shutil
import time
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager, suppress
from dataclasses import dataclass
from functools import partial
from importlib import import_module
from io import FileIO
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO, TypeVar

import numpy as np

from ehlectric.errors import DamagedError, InputError, UnreadableError
from ehlectric.runtime.drafts import Draft, finish, redo_file, write_down
from ehlectric.runtime.files import write, writing
from ehlectric.runtime.hdf5_soundness import (
    file_class,
    known_sound,
    reading_class,
    refuse_damaged,
    remember_sound,
    seal_of,
)
from ehlectric.runtime.locks import held_back, take
from ehlectric.runtime.sizes import check_netcdf_values
from ehlectric.runtime.threads import own_filters

if TYPE_CHECKING:
    import xarray as xr


F = TypeVar("F", bound=AbstractContextManager[Any])

# Longest time to wait for another program that has the file open, and time between two attempts [s].
_PATIENCE, _AGAIN = 30.0, 0.05


def read_dataset(path: Path) -> xr.Dataset:
    """All variables and attributes of a NetCDF file, which may be growing.

    Raises a DamagedError where the file is damaged, and an InputError where it cannot be read, is no NetCDF
    file, stays open in another program, or has too large values.
    """
    import xarray as xr

    try:
        with own_filters(), opened(path) as file:
            warnings.simplefilter("ignore")  # xarray warns about files that are refused below
            check_netcdf_values(path, file)
            dataset = xr.open_dataset(xr.backends.H5NetCDFStore(file)).load()
    except (InputError, MemoryError):
        raise
    except Exception:  # HDF5 and its wrappers raise errors of many types for damaged files
        raise DamagedError.of(path, "its header cannot be read") from None
    # All values are in memory. A reference to the file would prevent that the dataset is pickled.
    dataset.set_close(None)
    return dataset


def load_library() -> None:
    """Load the library of NetCDF files; raises an ImportError where it cannot be loaded.

    Whoever solves for long calls it before: afterwards there may be no memory for the library. An error of
    its own says so, which the packages above it replace by other words.
    """
    import_module("h5py")


@dataclass(frozen=True)
class Layout:
    """Variables and attributes of a NetCDF file.

    It is written without xarray, which takes longer to load than many results take to be computed.
    """

    # Dimensions and values of each variable, and its attributes if it has any.
    variables: Mapping[str, tuple[Any, ...]]
    attributes: Mapping[str, Any]
    # Variables that are coordinates, besides those with the name of a dimension.
    coordinates: tuple[str, ...] = ()

    def dataset(self) -> xr.Dataset:
        """Dataset of xarray with copies of the values."""
        import xarray as xr

        whole = xr.Dataset(dict(self.variables), attrs=dict(self.attributes))
        return whole.set_coords(self.coordinates).copy(deep=True)

    def reread(self) -> Reread:
        """Content as a reader of the file finds it, without xarray."""
        return Reread(
            {
                name: RereadVariable(_names(one[0]), np.asarray(one[1]), dict(one[2]) if len(one) > 2 else {})
                for name, one in self.variables.items()
            },
            dict(self.attributes),
        )

    def write(self, file: Any) -> None:
        """Write to an ``h5netcdf.File`` what xarray writes of ``dataset``."""
        arrays = {name: (_names(one[0]), np.asarray(one[1])) for name, one in self.variables.items()}
        for dims, values in arrays.values():
            for dim, size in zip(dims, values.shape, strict=True):
                if dim not in file.dimensions:
                    file.dimensions[dim] = size
        for name, value in self.attributes.items():
            file.attrs[name] = value if isinstance(value, str) else np.atleast_1d(value)
        for name, (dims, values) in arrays.items():
            self._write_variable(file, name, dims, values)

    def _write_variable(self, file: Any, name: str, dims: tuple[str, ...], values: Any) -> None:
        """Write one variable: NaN is the fill value of numbers, and truth is stored as 0 or 1."""
        attributes = dict(self.variables[name][2]) if len(self.variables[name]) > 2 else {}
        dtype, fill = values.dtype, None
        if dtype.kind == "f":
            fill = np.array(np.nan, dtype)[()]
        elif dtype.kind == "b":
            dtype = np.dtype("i1")
            attributes["dtype"] = "bool"
        elif dtype.kind in "UO":
            dtype, values = import_module("h5py").string_dtype(), values.astype(object)
        near = [one for one in sorted(self.coordinates) if {*_names(self.variables[one][0])} <= {*dims}]
        if near and name not in (*self.coordinates, *dims):
            attributes["coordinates"] = " ".join(near)
        variable = file.create_variable(name, dims, dtype, fillvalue=fill)
        for key, value in attributes.items():
            variable.attrs[key] = value
        if values.size:
            variable[...] = values


@dataclass(frozen=True)
class RereadVariable:
    """Variable of a ``Reread``, with the names of xarray."""

    dims: tuple[str, ...]
    values: Any
    attrs: Mapping[str, Any]

    @property
    def sizes(self) -> dict[str, int]:
        """Sizes by the names of the dimensions."""
        return dict(zip(self.dims, self.values.shape, strict=True))

    @property
    def dtype(self) -> Any:
        """Type of the values."""
        return self.values.dtype

    def get_axis_num(self, dim: str) -> int:
        """Number of the axis of a dimension."""
        return self.dims.index(dim)


@dataclass(frozen=True)
class Reread:
    """Content of a file in memory. Its members have the names and values of an ``xarray.Dataset``, as far as
    readers of results use them.
    """

    variables: Mapping[str, RereadVariable]
    attrs: Mapping[str, Any]

    @property
    def sizes(self) -> dict[str, int]:
        """Sizes by the names of the dimensions."""
        return {name: size for one in self.variables.values() for name, size in one.sizes.items()}

    def __contains__(self, name: str) -> bool:
        return name in self.variables

    def __getitem__(self, name: str) -> RereadVariable:
        return self.variables[name]


def check_readable(content: xr.Dataset | Layout, path: Path, read: Callable[[Any, Path], object]) -> None:
    """Check that the reader of a kind of result accepts what was written to a path.

    Raises an UnreadableError, which names what the reader refuses.
    """
    try:
        read(content.reread() if isinstance(content, Layout) else content, path)
    except DamagedError as error:
        raise UnreadableError.of(path, error.what) from None


def _names(dims: Any) -> tuple[str, ...]:
    """Names of dimensions; a text is the name of one."""
    return (dims,) if isinstance(dims, str) else tuple(dims)


def content_of(content: xr.Dataset | Layout) -> Callable[[BinaryIO], None]:
    """Function that writes a dataset as a NetCDF file with a seal to an open file, or raises an OSError."""
    load_library()

    def fill(file: Any) -> None:
        if isinstance(content, Layout):
            content.write(file)
            return
        import xarray as xr

        content.dump_to_store(xr.backends.H5NetCDFStore(file))

    return _created(fill, None, sealed=True)


def create(path: Path, lay_out: Callable[[Any], None], fill: Callable[[Any], None] | None = None) -> None:
    """Create or replace a NetCDF file that will grow, whole or not at all; raises a WriteError.

    ``lay_out`` is called with the ``h5netcdf.File``, in which it creates variables and attributes, and then
    ``fill`` with the same file as an ``h5py.File``, to whose variables it writes.
    """
    write(path, _created(lay_out, fill))
    with suppress(OSError):  # another program may have removed it
        remember_sound(path, path.stat())


def _created(
    lay_out: Callable[[Any], None], fill: Callable[[Any], None] | None, *, sealed: bool = False
) -> Callable[[BinaryIO], None]:
    """Function that writes a new NetCDF file to an open file; a complete one ends with a seal."""

    def content(target: BinaryIO) -> None:
        draft = Draft()
        with file_class()(draft, "w") as file:
            lay_out(file)
        if fill is not None:
            with values_in(draft) as file:
                fill(file)
        for part in draft.content():
            target.write(part)
        if sealed:
            target.write(seal_of(draft.content()))

    return content


@contextmanager
def opened(path: Path) -> Iterator[Any]:
    """Context with a file that is open for reading. It waits while another program writes to the file.

    Raises a DamagedError where the file is damaged, and an InputError where it cannot be opened, is no NetCDF
    file, or another program keeps it open.
    """
    if redo_file(path).is_file() and path.is_file():
        with writing(path), _to_change(path):
            pass
    refuse_damaged(path)

    def attempt() -> Any:
        return reading_class()(path, "r")

    with _patient(path, attempt) as file:
        yield file


@contextmanager
def changed(path: Path) -> Iterator[Draft]:
    """Context with a draft of a file, whose changes are written all or not at all, also after a kill.

    It waits while another program has the file open. Interrupts are held back until the file is closed, so
    that they leave no damaged file. Raises an InputError where another program keeps the file open, or the
    disk is full.
    """
    with _to_change(path) as target:
        was_sound = known_sound(path, os.fstat(target.fileno()))
        draft = Draft(target.fileno())
        yield draft
        with writing(path):
            # Some file systems need space also for what they overwrite.
            if shutil.disk_usage(path.parent).free < draft.changed:
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
            draft.apply(partial(write_down, path, target.fileno()))
            redo_file(path).unlink()
        if was_sound:
            remember_sound(path, os.fstat(target.fileno()))


@contextmanager
def _to_change(path: Path) -> Iterator[FileIO]:
    """Context with a file that is locked for changes; those that a kill has interrupted are made."""

    def attempt() -> FileIO:
        target = FileIO(path, "r+")
        # HDF5 takes the same lock.
        if take(target.fileno()) == "busy":
            target.close()
            raise BlockingIOError
        return target

    with _patient(path, attempt) as target:
        with writing(path, redo_file(path)):
            finish(path, target.fileno())
        yield target


@contextmanager
def _patient(path: Path, attempt: Callable[[], F]) -> Iterator[F]:
    """Context with a file that is opened once no other program holds it; interrupts wait for its end."""
    until = time.monotonic() + _PATIENCE
    while True:
        with held_back():
            try:
                file = attempt()
            except BlockingIOError:
                if time.monotonic() > until:
                    told = "is held open by another program, which must close it"
                    raise InputError(path, told) from None
            else:
                with file:
                    yield file
                return
        time.sleep(_AGAIN)


def layout_in(draft: Draft) -> AbstractContextManager[Any]:
    """The ``h5netcdf.File`` in a draft, open to create variables, dimensions and groups."""
    layout: AbstractContextManager[Any] = file_class()(draft, "r+")
    return layout


def values_in(draft: Draft) -> AbstractContextManager[Any]:
    """The ``h5py.File`` in a draft, open to resize variables and to write their values.

    The library of NetCDF looks up all variables and dimensions of a file that it opens, and those that have a
    dimension whenever its size is asked for, which takes several times as long as the values of an instant.
    """
    values: AbstractContextManager[Any] = import_module("h5py").File(draft, "r+")
    return values
