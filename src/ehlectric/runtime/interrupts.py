"""Signals that stop the program, and a context in which they wait, as until a file is written."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

_NAMES = ("SIGINT", "SIGTERM", "SIGHUP")  # Windows does not have all of them.
_STOPPING = tuple(getattr(signal, name) for name in _NAMES if hasattr(signal, name))


def not_ignored() -> list[signal.Signals]:
    """Signals that stop the program. After ``nohup`` that of a closed terminal does not: it is ignored.

    An ignored signal must keep this setting, which processes that are started inherit; they inherit no
    handler.
    """
    return [number for number in _STOPPING if signal.getsignal(number) is not signal.SIG_IGN]


@contextmanager
def held_back() -> Iterator[None]:
    """Context in which signals that stop the program are held back; they are delivered at its end.

    In other threads than the main thread the context does nothing, as no signal interrupts them.

    Examples
    --------
    >>> try:
    ...     with held_back():
    ...         signal.raise_signal(signal.SIGINT)
    ...         print("written")
    ... except KeyboardInterrupt:
    ...     print("stopped")
    written
    stopped
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    came: list[int] = []
    before: dict[int, Any] = {}
    try:
        for number in not_ignored():
            before[number] = signal.signal(number, lambda number, _: came.append(number))
        yield
    finally:
        for held, handler in before.items():
            # A handler that was not set from Python is None, and cannot be set again.
            signal.signal(held, signal.SIG_DFL if handler is None else handler)
        if came:
            signal.raise_signal(came[0])
