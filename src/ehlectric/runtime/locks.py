"""Locks of the kernel on open files, and signals that stop the program or wait until a file is written."""

from __future__ import annotations

import errno
import os
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from typing import Any, Literal

_NAMES = ("SIGINT", "SIGTERM", "SIGHUP")  # Windows does not have all of them.
_STOPPING = tuple(getattr(signal, name) for name in _NAMES if hasattr(signal, name))


def not_ignored() -> list[signal.Signals]:
    """Signals that stop the program. After ``nohup`` the signal of a closed terminal does not: it is ignored.

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


LockState = Literal["taken", "busy", "none"]

# Whether the system renames files that are open. Windows does not.
RENAMES_OPEN = os.name != "nt"

# Place of the locked byte on Windows, where others cannot write it: near the largest that it takes.
_FAR = 2**31 - 2

# Errors that mean that somebody else has the lock.
_BUSY = (errno.EWOULDBLOCK, errno.EAGAIN, errno.EACCES, errno.EDEADLK)


def try_lock(fd: int) -> LockState:
    """Try to lock an open file against every other process and every other open file of this one. Returns
    "taken"; "busy" where somebody else has the lock; "none" where the file system has no locks.

    Examples
    --------
    >>> from tempfile import NamedTemporaryFile
    >>> with NamedTemporaryFile() as one, open(one.name, "rb") as other:
    ...     try_lock(one.fileno()), try_lock(other.fileno())
    ('taken', 'busy')
    """
    try:
        _lock(fd)
    except OSError as error:
        return "busy" if error.errno in _BUSY else "none"
    return "taken"


def _lock(fd: int) -> None:
    try:
        posix = import_module("fcntl")
    except ModuleNotFoundError:
        try:
            windows = import_module("msvcrt")
        except ModuleNotFoundError:
            raise OSError(errno.ENOSYS, "no locks") from None
        os.lseek(fd, _FAR, os.SEEK_SET)
        windows.locking(fd, windows.LK_NBLCK, 1)
        os.lseek(fd, 0, os.SEEK_SET)
    else:
        posix.flock(fd, posix.LOCK_EX | posix.LOCK_NB)
