"""One BLAS thread around small and banded factorisations.

OpenBLAS spreads even a factorisation of bandwidth six over its threads, and spends tens of times the work on
handing it over.
"""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache

from threadpoolctl import ThreadpoolController

_turn = threading.RLock()


@cache
def _controller() -> ThreadpoolController:
    # Looking for the libraries takes milliseconds: once a process is enough.
    return ThreadpoolController()


@contextmanager
def one_blas_thread() -> Iterator[None]:
    """Context in which BLAS and LAPACK run on one thread.

    The limit is the whole process's, and so threads take turns: one that set it while another was about to
    lift it would leave it behind. Solving in parallel takes processes.
    """
    with _turn, _controller().limit(limits=1, user_api="blas"):
        yield
