"""Sizes of files and of their values, which are checked before anything is read.

A small file can hold values that fill the memory: a sparse file takes no room on the disk, and a compressed
variable takes a thousandth of its values. Every reader therefore has a bound, and the available memory is a
second one.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from ehlectric.errors import InputError
from ehlectric.runtime.files import reading
from ehlectric.runtime.memory import available_memory, in_bytes, least_limit

# Largest size of the values of one NetCDF file [bytes]: twice the values of a point contact on the finest
# grid.
MOST_VALUES = 8_000_000_000

# Largest ratio of the size of the values to the size of their file, beyond values of a size that does no harm
# [bytes]. Files of ehlectric are not compressed; other programs compress smooth maps at most a hundredfold.
MOST_RATIO = 100
HARMLESS = 64_000_000

# Copies of its values that a reader makes, with the one that it keeps.
_COPIES = 2

# Memory of one text in Python [bytes].
_TEXT = 100


def check_size(path: Path, size: int, most: int, *, copies: float = 1.0) -> None:
    """Refuse a file that is too large to be read. ``size`` [bytes]; ``most``, largest size that a file of its
    kind has [bytes]. Raises InputError where the file is larger than ``most``, or does not fit into the
    memory.

    Examples
    --------
    >>> check_size(Path("case.toml"), 20 * 10**9, 1_000_000)
    Traceback (most recent call last):
    ehlectric.errors.InputError: case.toml: has 20 GB; expected at most 1 MB
    """
    if size > most:
        # All digits where the rounded sizes would be equal.
        sizes = [in_bytes(size), in_bytes(most)]
        has, allowed = sizes if sizes[0] != sizes[1] else [f"{size} bytes", f"{most} bytes"]
        raise InputError(path, f"has {has}", takes=f"at most {allowed}")
    check_memory_for(path, copies * size, f"has {in_bytes(size)}")


def check_memory_for(path: object, needed: float, says: str) -> None:
    """Refuse what needs more memory than is available. ``needed``, memory that its reader needs [bytes].
    Raises InputError where less memory is available.
    """
    available = available_memory()
    if needed > available:
        raise InputError(
            path,
            f"{says} and needs {in_bytes(needed)} of memory",
            takes=f"at most {in_bytes(available)}, {least_limit()}",
        )


def check_netcdf_values(path: Path, file: Any) -> None:
    """Refuse a NetCDF file whose values are too large to be read; only its header is looked at. Raises
    InputError where the values of all variables exceed ``MOST_VALUES``, are more than ``MOST_RATIO`` times
    larger than the file, or do not fit into the memory.
    """
    declared = sum(_declared(variable) for variable in _variables(file))
    with reading(path):
        size = path.stat().st_size
    says = f"holds {in_bytes(declared)} of values in {in_bytes(size)}"
    most = min(MOST_VALUES, HARMLESS + MOST_RATIO * size)
    if declared > most:
        raise InputError(path, says, takes=f"at most {in_bytes(most)} in a file of its size")
    if declared > HARMLESS:
        check_memory_for(path, _COPIES * declared, says)


def _variables(group: Any) -> Iterator[Any]:
    """Variables of a group of an open file and of all groups in it."""
    yield from group.variables.values()
    for inner in group.groups.values():
        yield from _variables(inner)


def _declared(variable: Any) -> int:
    """Return the size of a variable's values, or of one chunk where that is larger [bytes].

    A chunk is always read as a whole, so that a large one fills the memory also for a few values.
    """
    kind = variable.dtype
    each = _TEXT if kind is str or np.dtype(kind).hasobject else np.dtype(kind).itemsize
    chunk = variable.chunks or ()
    return each * max(math.prod(map(int, variable.shape)), math.prod(map(int, chunk)) if chunk else 0)
