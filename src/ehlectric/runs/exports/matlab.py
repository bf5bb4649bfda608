"""Results as MAT files of MATLAB, which Octave reads too."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from io import BytesIO
from typing import TYPE_CHECKING, Any, Protocol, cast

import numpy as np

from ehlectric.errors import InputError
from ehlectric.version import __version__

if TYPE_CHECKING:
    import xarray as xr


class Tabled(Protocol):
    """Result with a dataset and a summary."""

    def to_xarray(self) -> xr.Dataset:
        """Dataset of all arrays."""

    def summary(self) -> dict[str, Any]:
        """Key figures as nested tables."""


# Longest name of a variable, and largest variable that version 5 of the format holds [bytes].
_LONGEST, _LARGEST = 63, 2**31 - 1

# Variables beside the arrays.
_OWN = ("summary", "units", "long_names", "dims", "keys", "about")

# Words of MATLAB that are no names.
_WORDS = frozenset(
    {"break", "case", "catch", "classdef", "continue", "else", "elseif", "end", "for", "function", "global"}
    | {"if", "otherwise", "parfor", "persistent", "return", "spmd", "switch", "try", "while"}
)


def mat_file(result: Tabled) -> bytes:
    """Content of a MAT file (version 5): all arrays of a result, and its summary as a struct.

    Each array of ``result.to_xarray()`` is a variable, with its dimensions in the same order. The structs
    ``units``, ``long_names``, ``dims`` and ``keys`` have a field for each array: unit, meaning, names of its
    dimensions, and its name in the dataset. A value of the summary that has no meaning is empty.

    Parameters
    ----------
    result : Result, PointResult, BearingResult, DriveResult, MotionResult or SweepResults
        Result.

    Raises
    ------
    InputError
        If an array is larger than 2 GB.
    """
    from scipy.io import savemat

    dataset = result.to_xarray()
    names = matlab_names([str(key) for key in dataset.variables], taken=_OWN)
    about: dict[str, dict[str, str]] = {key: {} for key in ("units", "long_names", "dims", "keys")}
    arrays = {}
    for key, values in dataset.variables.items():
        name = names[str(key)]
        arrays[name] = _array(str(key), values.values)
        about["units"][name] = str(values.attrs.get("units", ""))
        about["long_names"][name] = str(values.attrs.get("long_name", ""))
        about["dims"][name] = ", ".join(map(str, values.dims))
        about["keys"][name] = str(key)
    title = str(dataset.attrs.get("title", ""))
    own = {
        "summary": _value(result.summary()),
        "about": {"title": title, "source": f"ehlectric {__version__}, SI units"},
        **about,
    }
    file = BytesIO()
    savemat(cast("Any", file), arrays | own, long_field_names=True, do_compression=True, oned_as="column")
    return file.getvalue()


def matlab_names(keys: Iterable[str], taken: Iterable[str] = ()) -> dict[str, str]:
    """Names of variables and fields in MATLAB, by the keys that they stand for; all are different.

    Parameters
    ----------
    keys : iterable of str
        Any texts.
    taken : iterable of str
        Names that none of them gets.

    Examples
    --------
    >>> list(matlab_names(["film.minimum_thickness", "0.5", "end", "a-b", "a b"]).values())
    ['film_minimum_thickness', 'x0_5', 'xEnd', 'a_b', 'a_b_2']
    """
    found: dict[str, str] = {}
    used = set(taken)
    for key in keys:
        bare = re.sub(r"[^0-9A-Za-z_]", "_", key) or "x"
        if bare in _WORDS:
            bare = f"x{bare.capitalize()}"
        elif not bare[0].isalpha():
            bare = f"x{bare}"
        name, number = bare[:_LONGEST], 2
        while name in used:
            end = f"_{number}"
            name, number = bare[: _LONGEST - len(end)] + end, number + 1
        used.add(name)
        found[key] = name
    return found


def _array(key: str, values: Any) -> Any:
    """Array as MATLAB has it: texts are a cell array, other numbers unchanged."""
    array = np.asarray(values)
    if array.nbytes > _LARGEST:
        takes = "at most 2 GB in a MAT file; MATLAB reads the NetCDF file of the result by ncread"
        raise InputError(key, got=f"{array.nbytes / 1e9:.3g} GB", takes=takes)
    if array.dtype.kind in "biufc":
        return array
    return np.vectorize(str, otypes=[object])(array) if array.size else np.empty((0, 0), dtype=object)


def _value(value: Any) -> Any:
    """Value of a summary as savemat takes it; None is an empty matrix."""
    if isinstance(value, Mapping):
        names = matlab_names(map(str, value))
        return {names[str(key)]: _value(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return _listed(value)
    return np.empty((0, 0)) if value is None else value


def _listed(values: list[Any] | tuple[Any, ...]) -> Any:
    """List of a summary: a row of numbers, in which None is NaN, or a cell array of anything else."""
    if all(item is None or (isinstance(item, int | float) and not isinstance(item, bool)) for item in values):
        return np.array([[np.nan if item is None else float(item) for item in values]])
    cells = np.empty((1, len(values)), dtype=object)
    for k, item in enumerate(values):
        cells[0, k] = _value(item)
    return cells
