"""A limit of processor time for what a benchmark solves."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager


class GivenUpError(Exception):
    """A film took longer than its limit."""


@contextmanager
def processor_limit(seconds: float) -> Iterator[None]:
    """Raise ``GivenUpError`` in the block as soon as this process has used the processor for so long [s]."""

    def give_up(*_: object) -> None:
        raise GivenUpError

    signal.signal(signal.SIGPROF, give_up)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
