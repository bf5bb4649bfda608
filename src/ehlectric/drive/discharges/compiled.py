"""Functions that numba compiles, with their types kept."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba

F = TypeVar("F", bound=Callable[..., Any])

# A division by zero gives what it gives in numpy; compiled functions stay on the disk for the next run.
_OPTIONS: dict[str, Any] = {"cache": True, "error_model": "numpy"}


def compiled(function: F) -> F:
    """Compile a function of numbers and arrays at its first call."""
    return cast("F", numba.njit(**_OPTIONS)(function))


def inner(function: F) -> F:
    """Compile a function that only other compiled functions call, which takes less time."""
    alone: dict[str, Any] = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}
    return cast("F", numba.njit(**_OPTIONS, **alone)(function))
