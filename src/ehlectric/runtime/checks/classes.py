"""Classes of the library h5netcdf, as files are opened with them."""

from __future__ import annotations

from contextlib import suppress
from functools import cache, cached_property
from typing import Any


@cache
def file_class() -> Any:
    """Class ``h5netcdf.File``, whose instances say nothing where a file cannot be opened.

    Where its initialisation fails halfway, the class of the library writes a traceback to standard error when
    the instance is deleted, as it lacks the attributes that are set here.

    Its variables keep what they are asked for often; the library looks it up in the file each time. Where a
    later version of the library lacks one of the names, this time is lost, no more.
    """
    import h5netcdf

    class File(h5netcdf.File):  # type: ignore[misc]  # the library has no types
        _writable = False
        _mode = "r"
        _variable_cls = _variable_class()
        _group_cls = _group_class(_variable_class())

    return File


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

    class File(file_class()):  # type: ignore[misc]
        _variable_cls = Variable
        _group_cls = _group_class(Variable)

        def __init__(self, *given: Any, **options: Any) -> None:
            self.known_sizes: dict[Any, int] = {}
            super().__init__(*given, **options)

    return File


@cache
def _variable_class() -> Any:
    import h5netcdf

    class Variable(h5netcdf.Variable):  # type: ignore[misc]
        @cached_property
        def _h5ds(self) -> Any:
            return super()._h5ds

        @cached_property
        def dtype(self) -> Any:
            return super().dtype

    return Variable


def _group_class(variable: Any) -> Any:
    """Class of groups inside a file, with the same class of variables."""
    import h5netcdf

    class Group(h5netcdf.Group):  # type: ignore[misc]
        _variable_cls = variable

        @property
        def _group_cls(self) -> Any:
            return Group

    return Group
