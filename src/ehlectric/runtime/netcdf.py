"""NetCDF files: reading them, and their content in memory."""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import partial
from importlib import import_module
from io import SEEK_CUR, SEEK_END, SEEK_SET, RawIOBase
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO, TypeVar

import numpy as np

from ehlectric.arrays import Array
from ehlectric.errors import DamagedError, InputError, UnreadableError
from ehlectric.runtime.hdf5_guard import file_class, refuse_damaged, seal_of
from ehlectric.runtime.sizes import check_netcdf_values
from ehlectric.runtime.threads import local_filters

if TYPE_CHECKING:
    import xarray as xr
    from _typeshed import ReadableBuffer, WriteableBuffer


T = TypeVar("T")

# Bytes of a file that are read at a time for its seal.
_BLOCK = 1 << 20

# Longest time to wait for another program that has the file open, and time between two attempts [s].
_PATIENCE, _AGAIN = 30.0, 0.1


def read_dataset(path: Path) -> xr.Dataset:
    """All variables and attributes of a NetCDF file, which may be growing.

    Raises a DamagedError where the file is damaged, and an InputError where it cannot be read, is no NetCDF
    file, stays open in another program, or has too large values.
    """
    import xarray as xr

    try:
        with local_filters(), opened(path) as file:
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

    Whoever solves for long calls it before: afterwards there may be no memory for the library. This is
    reported by an error of its own, which the packages above it replace by other words.
    """
    import_module("h5py")


@dataclass(frozen=True)
class Stack:
    """Values of a variable that are read entry by entry along their first dimension, to be written so."""

    shape: tuple[int, ...]
    dtype: np.dtype[Any]
    entries: Callable[[], Iterator[Array]]  # function that begins to read the entries

    def whole(self) -> Array:
        """All values in memory."""
        values = np.empty(self.shape, self.dtype)
        for place, entry in enumerate(self.entries()):
            values[place] = entry
        return values


@dataclass(frozen=True)
class Layout:
    """Variables and attributes of a NetCDF file.

    It is written without xarray, which takes longer to load than many results take to be computed.
    """

    # Dimensions and values of each variable, and its attributes if it has any.
    variables: Mapping[str, tuple[Any, ...]]
    attributes: Mapping[str, Any]
    # Variables that are coordinates, besides variables with the name of a dimension.
    coordinates: tuple[str, ...] = ()
    # Options with which variables are created in the file, as chunks and compression.
    storage: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)

    def dataset(self) -> xr.Dataset:
        """Dataset of xarray with copies of the values."""
        import xarray as xr

        variables = {
            name: (dims, values.whole() if isinstance(values, Stack) else np.array(values), *others)
            for name, (dims, values, *others) in self.variables.items()
        }
        return xr.Dataset(variables, attrs=dict(self.attributes)).set_coords(self.coordinates)

    def reread(self) -> Reread:
        """Content as a reader of the file finds it, without xarray."""
        return Reread(
            {
                name: RereadVariable(
                    _names(variable[0]),
                    np.asarray(variable[1]),
                    dict(variable[2]) if len(variable) > 2 else {},
                )
                for name, variable in self.variables.items()
            },
            dict(self.attributes),
        )

    def write(self, file: Any) -> None:
        """Write to an ``h5netcdf.File`` what xarray writes of ``dataset``."""
        arrays = {
            name: (
                _names(variable[0]),
                variable[1] if isinstance(variable[1], Stack) else np.asarray(variable[1]),
            )
            for name, variable in self.variables.items()
        }
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
        near = [
            coordinate
            for coordinate in sorted(self.coordinates)
            if {*_names(self.variables[coordinate][0])} <= {*dims}
        ]
        if near and name not in (*self.coordinates, *dims):
            attributes["coordinates"] = " ".join(near)
        options = {"fillvalue": fill, **self.storage.get(name, {})}
        variable = file.create_variable(name, dims, dtype, **options)
        for key, value in attributes.items():
            variable.attrs[key] = value
        if isinstance(values, Stack):
            for place, entry in enumerate(values.entries()):
                variable[place] = entry
        elif values.size:
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
        return {name: size for variable in self.variables.values() for name, size in variable.sizes.items()}

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
    """Function that writes a dataset as a NetCDF file with a seal to a file that is open for reading too, or
    raises an OSError.
    """
    load_library()

    def fill(file: Any) -> None:
        if isinstance(content, Layout):
            content.write(file)
            return
        import xarray as xr

        content.dump_to_store(xr.backends.H5NetCDFStore(file))

    def write(target: BinaryIO) -> None:
        draft = Draft(target)
        with file_class()(draft, "w") as file:
            fill(file)
        if draft.failure is not None:
            raise draft.failure
        target.seek(0)
        seal = seal_of(iter(partial(target.read, _BLOCK), b""))
        target.seek(0, SEEK_END)
        target.write(seal)

    return write


class Draft(RawIOBase):
    """Open file for HDF5, which crashes where a write fails, as on a full disk or without memory.

    The first failure is kept, to be raised after HDF5 has closed the file; what is written after it is lost.
    """

    def __init__(self, target: BinaryIO) -> None:
        self._target, self._position, self._size = target, 0, 0
        self.failure: OSError | MemoryError | None = None

    def seek(self, offset: int, whence: int = SEEK_SET) -> int:
        """Move to a position, and return it."""
        start = {SEEK_SET: 0, SEEK_CUR: self._position, SEEK_END: self._size}[whence]
        self._position = start + offset
        return self._position

    def truncate(self, size: int | None = None) -> int:
        """Change the size, also to a larger one, and return it."""
        size = self._position if size is None else size
        if size > self._size:
            self._kept(lambda: self._put(size - 1, b"\0"))
        self._kept(lambda: self._target.truncate(size))
        self._size = size
        return size

    def readinto(self, buffer: WriteableBuffer) -> int:
        """Fill a buffer from the position on, and return the number of bytes."""
        view = memoryview(buffer).cast("B")
        part = self._kept(lambda: self._got(self._position, len(view))) or b""
        view[: len(part)] = part
        self._position += len(part)
        return len(part)

    def write(self, content: ReadableBuffer) -> int:
        """Write bytes at the position, and return their number."""
        view = memoryview(content).cast("B")
        if len(view):
            self._kept(lambda: self._put(self._position, view))
            self._position += len(view)
            self._size = max(self._size, self._position)
        return len(view)

    def _put(self, place: int, content: ReadableBuffer) -> None:
        self._target.seek(place)
        self._target.write(content)
        self._target.flush()

    def _got(self, place: int, size: int) -> bytes:
        self._target.seek(place)
        return self._target.read(size)

    def _kept(self, action: Callable[[], T]) -> T | None:
        """Result of an action on the file; None, and the failure is kept, if this or an earlier one fails."""
        if self.failure is None:
            try:
                return action()
            except (OSError, MemoryError) as error:
                self.failure = error
        return None


@contextmanager
def opened(path: Path) -> Iterator[Any]:
    """Context with a file that is open for reading. It waits while another program writes to the file.

    Raises a DamagedError where the file is damaged, and an InputError where it cannot be opened, is no NetCDF
    file, or another program keeps it open.
    """
    until = time.monotonic() + _PATIENCE
    while True:
        try:
            refuse_damaged(path)
            file = file_class()(path, "r")
        except BlockingIOError:
            if time.monotonic() > until:
                text = "is held open by another program, which must close it"
                raise InputError(path, text) from None
            time.sleep(_AGAIN)
        else:
            break
    with file:
        yield file
