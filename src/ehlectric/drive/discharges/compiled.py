"""Functions that numba compiles, with their types kept.

Compiled functions stay on the disk for the next run. Numba takes one as up to date if the file of its source
is, but it contains the functions that it calls, from other files too. The folder of the compiled functions is
therefore named by the contents of all files of this package.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any, TypeVar, cast

import numba

F = TypeVar("F", bound=Callable[..., Any])

# A division by zero gives what it gives in numpy.
_OPTIONS: dict[str, Any] = {"cache": True, "error_model": "numpy"}


def compiled(function: F) -> F:
    """Compile a function of numbers and arrays at its first call."""
    return cast("F", _compiled(function, **_OPTIONS))


def inner(function: F) -> F:
    """Compile a function that only other compiled functions call, which takes less time."""
    alone: dict[str, Any] = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}
    return cast("F", _compiled(function, **_OPTIONS, **alone))


def _compiled(function: Any, **options: Any) -> Any:
    # The folder is chosen when a function is decorated. Other packages keep theirs.
    config: Any = numba.config
    before = config.CACHE_DIR
    config.CACHE_DIR = str(_folder(before))
    try:
        return numba.njit(**options)(function)
    finally:
        config.CACHE_DIR = before


@cache
def _folder(chosen: str) -> Path:
    """Folder of the compiled functions: that of NUMBA_CACHE_DIR, of the package, or of the user."""
    own = Path(__file__).parent
    if chosen:
        base = Path(chosen)
    elif os.access(own, os.W_OK):
        base = own / "__pycache__"
    else:
        base = Path.home() / ".cache" / "ehlectric"
    return base / f"compiled-{contents_of(own)}"


def contents_of(folder: Path) -> str:
    """Short hash of the contents of all Python files of a folder."""
    found = hashlib.sha256()
    for path in sorted(folder.glob("*.py")):
        found.update(path.name.encode() + b"\0" + path.read_bytes() + b"\0")
    return found.hexdigest()[:16]
