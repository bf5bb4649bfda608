"""Functions that numba compiles, with their types kept."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

import numba

F = TypeVar("F", bound=Callable[..., Any])


def compiled(function: F) -> F:
    """Compile a function of numbers and arrays at its first call, and keep it on the disk for the next run."""
    fast: F = numba.njit(cache=True, error_model="numpy")(function)
    return fast


def inner(function: F) -> F:
    """Compile a function that only other compiled functions call, which takes less time."""
    fast: F = numba.njit(cache=True, error_model="numpy", no_cpython_wrapper=True, no_cfunc_wrapper=True)(
        function
    )
    return fast
