"""Locks of the kernel on open files, which end with the process that holds them."""

from __future__ import annotations

import errno
import os
from importlib import import_module
from typing import Literal

Taken = Literal["taken", "busy", "none"]

# Whether the system renames files that are open. Windows does not.
RENAMES_OPEN = os.name != "nt"

# Place of the locked byte on Windows, where others cannot write it: near the largest that it takes.
_FAR = 2**31 - 2

# Errors that mean that somebody else has the lock.
_BUSY = (errno.EWOULDBLOCK, errno.EAGAIN, errno.EACCES, errno.EDEADLK)


def take(number: int) -> Taken:
    """Try to lock an open file against every other process and every other open file of this one.

    Parameters
    ----------
    number : int
        Descriptor of the file. The lock ends when the file is closed, also by a kill.

    Returns
    -------
    str
        "taken"; "busy" where somebody else has the lock; "none" where the file system has no locks.

    Examples
    --------
    >>> from tempfile import NamedTemporaryFile
    >>> with NamedTemporaryFile() as one, open(one.name, "rb") as other:
    ...     take(one.fileno()), take(other.fileno())
    ('taken', 'busy')
    """
    try:
        _lock(number)
    except OSError as error:
        return "busy" if error.errno in _BUSY else "none"
    return "taken"


def _lock(number: int) -> None:
    try:
        posix = import_module("fcntl")
    except ModuleNotFoundError:
        try:
            windows = import_module("msvcrt")
        except ModuleNotFoundError:
            raise OSError(errno.ENOSYS, "no locks") from None
        os.lseek(number, _FAR, os.SEEK_SET)
        windows.locking(number, windows.LK_NBLCK, 1)
        os.lseek(number, 0, os.SEEK_SET)
    else:
        posix.flock(number, posix.LOCK_EX | posix.LOCK_NB)
