"""One BLAS thread for small and banded factorisations.

OpenBLAS uses all of its threads even for a factorisation of bandwidth six. Starting them takes tens of times
longer than the factorisation.
"""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from typing import Any

import numpy as np
from threadpoolctl import ThreadpoolController

_turn = threading.RLock()


@cache
def _controller() -> ThreadpoolController:
    # The search for the libraries takes milliseconds and is done once in a process.
    return ThreadpoolController()


@cache
def _blas() -> list[Any]:
    """Libraries of BLAS and LAPACK in this process, with their present ``num_threads``."""
    return [each for each in _controller().lib_controllers if each.user_api == "blas"]


@contextmanager
def one_blas_thread() -> Iterator[None]:
    """Context in which BLAS and LAPACK run on one thread.

    The limit holds for the whole process. Threads therefore take turns: overlapping contexts could leave the
    limit set at their end. Solve in several processes to use several cores.
    """
    with _turn:
        # The processes of a sweep have one thread already; to set it and to set it back takes time.
        if all(library.num_threads == 1 for library in _blas()):
            yield
        else:
            with _controller().limit(limits=1, user_api="blas"):
                yield


@contextmanager
def quiet_solution() -> Iterator[None]:
    """Context manager for a solution: one BLAS thread, and no floating-point warnings.

    The warnings are off because intermediate iterates may overflow.
    """
    with one_blas_thread(), np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        yield
