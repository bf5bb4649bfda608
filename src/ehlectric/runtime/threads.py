"""Threads that wait for each other, and one BLAS thread for small and banded factorisations.

OpenBLAS uses all of its threads even for a factorisation of bandwidth six. Starting them takes tens of times
longer than the factorisation.
"""

from __future__ import annotations

import os
import sys
import threading
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cached_property
from importlib import import_module
from typing import Any

import numpy as np
from threadpoolctl import ThreadpoolController


class Turn:
    """Turn that one thread of a process has at a time, and may have several times at once.

    A process that is forked while a thread has the turn begins with a free one: the thread is not in it, and
    would never give the turn back.

    Examples
    --------
    >>> turn = Turn()
    >>> with turn.taken(), turn.taken():
    ...     print("only this thread")
    only this thread
    """

    def __init__(self) -> None:
        self._renew()
        if hasattr(os, "register_at_fork"):
            os.register_at_fork(after_in_child=self._renew)

    def _renew(self) -> None:
        self._lock = threading.RLock()

    @contextmanager
    def taken(self) -> Iterator[None]:
        """Context in which this thread has the turn."""
        # The lock that is released is the one that was acquired, also where the thread forks in between.
        with self._lock:
            yield


_turn, _filters = Turn(), Turn()


@contextmanager
def local_filters() -> Iterator[None]:
    """Context whose changes of the filters of warnings end with it.

    The filters belong to the process. One thread at a time is in such a context: the end of overlapping
    contexts would leave the filters of one of them.
    """
    with _filters.taken(), warnings.catch_warnings():
        yield


def _renew_properties() -> None:
    """Renew the locks of cached properties of this package; from Python 3.12 on they have none."""
    package = __name__.partition(".")[0]
    for name, module in list(sys.modules.items()):
        if name.partition(".")[0] == package:
            for each in vars(module).values():
                if isinstance(each, type) and each.__module__ == name:
                    _renew_those_of(each)


def _renew_those_of(kind: type) -> None:
    for value in vars(kind).values():
        if isinstance(value, cached_property):
            value.lock = threading.RLock()  # type: ignore[attr-defined]


if sys.version_info < (3, 12) and hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_renew_properties)


# Libraries with threads in this process, by whether SciPy has loaded its BLAS; the search takes milliseconds.
_controllers: dict[bool, ThreadpoolController] = {}


def _controller() -> ThreadpoolController:
    loaded = "scipy.linalg" in sys.modules
    if loaded not in _controllers:
        _controllers[loaded] = ThreadpoolController()
    return _controllers[loaded]


def _blas() -> list[Any]:
    """Libraries of BLAS and LAPACK in this process, with their present ``num_threads``."""
    return [each for each in _controller().lib_controllers if each.user_api == "blas"]


@contextmanager
def one_blas_thread(*, of_scipy: bool = True) -> Iterator[None]:
    """Context in which BLAS and LAPACK run on one thread.

    The limit holds for the whole process. Threads therefore wait for each other: overlapping contexts could
    leave the limit set at their end. Solve in several processes to use several cores. A process that is
    forked meanwhile keeps one thread.

    A library that is loaded within the context would not be limited. SciPy's BLAS is therefore loaded before,
    unless the context needs only NumPy, with ``of_scipy=False``.
    """
    if of_scipy:
        import_module("scipy.linalg")
    with _turn.taken():
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
